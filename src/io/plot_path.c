/* Pictures of the equilibria along the voltage, from ../table.csv: stroke.svg or (isometric) force.svg, charge.svg,
 * zipped_length.svg. */
#include <math.h>

#include "io/plot.h"

/* The kinds of curve: stable, unstable, stable on the closed branch, unstable there. */
enum { KINDS = 4 };

static double get(const ZpPlot *plot, size_t row, const char *column) {
  return zp_table_get(plot->table, row, column);
}

/* The column that shows how far it has closed: the opening, or the stroke of a kind without one; of a held one, its
 * force. */
static const char *travel(const ZpPlot *plot) {
  if (plot->shows == ZP_SHOWS_held_branch) return "force_N";
  return zp_plot_has(plot->table, "opening_m") ? "opening_m" : "stroke_m";
}

static int kind(const ZpPlot *plot, size_t row) {
  return 2 * (get(plot, row, "branch") > 0) + !(get(plot, row, "stable") > 0);
}

static bool has_kind(const ZpPlot *plot, int wanted) {
  for (size_t row = 0; row < plot->table->rows; row++)
    if (kind(plot, row) == wanted) return true;
  return false;
}

/* Whether the next row is on the same branch. */
static bool goes_on(const ZpPlot *plot, size_t row) {
  return row + 1 < plot->table->rows && kind(plot, row) / 2 == kind(plot, row + 1) / 2;
}

/* A jump from one stable part to another at a voltage. */
typedef struct Jump {
  double voltage, from, to; /* V; m of the travel, NAN if unknown */
} Jump;

/* Does stability change after a row? `rising`: does it end there when the curve is followed from the hanging state? */
static bool is_limit(const ZpPlot *plot, size_t row, bool rising) {
  if (!goes_on(plot, row) || kind(plot, row) == kind(plot, row + 1)) return false;
  return !rising || kind(plot, row) % 2 == 0;
}

/* Travel at the limit point nearest to a voltage; NAN where none is near. */
static double travel_at_limit(const ZpPlot *plot, double voltage, bool rising) {
  static const double near = 0.02; /* of the voltage: rows are no closer */
  double least = near * voltage, found = NAN;
  for (size_t row = 0; row < plot->table->rows; row++) {
    if (!is_limit(plot, row, rising)) continue;
    for (size_t i = row; i <= row + 1; i++) {
      double distance = fabs(get(plot, i, "voltage_V") - voltage);
      if (distance >= least) continue;
      least = distance;
      found = get(plot, i, travel(plot));
    }
  }
  return found;
}

/* Travel of the stable state at a voltage that is farthest from `from`. */
static double stable_travel(const ZpPlot *plot, double voltage, double from) {
  double found = NAN;
  for (size_t row = 0; row < plot->table->rows; row++) {
    if (!goes_on(plot, row) || kind(plot, row) % 2 || kind(plot, row) != kind(plot, row + 1)) continue;
    double a = get(plot, row, "voltage_V"), b = get(plot, row + 1, "voltage_V");
    if ((a - voltage) * (b - voltage) > 0 || a == b) continue;
    double part = (voltage - a) / (b - a), first = get(plot, row, travel(plot));
    double value = first + part * (get(plot, row + 1, travel(plot)) - first);
    if (isnan(found) || fabs(value - from) > fabs(found - from)) found = value;
  }
  return found;
}

static Jump jump_at(const ZpPlot *plot, const char *scalar, bool rising) {
  Jump jump = {.voltage = zp_result_get(plot->single, scalar), .from = NAN, .to = NAN};
  if (isnan(jump.voltage)) return jump;
  jump.from = travel_at_limit(plot, jump.voltage, rising);
  jump.to = stable_travel(plot, jump.voltage, jump.from);
  return jump;
}

/* The jump at the first limit point; one that does not close the actuator ends at a nearby state. */
static Jump pull_in(const ZpPlot *plot) {
  static const double same = 1e-6;
  Jump jump = jump_at(plot, "pull_in_voltage_V", true);
  if (zp_result_get(plot->single, "closing_voltage_V") > (1 + same) * jump.voltage) jump.to = NAN;
  return jump;
}

/* The jump that closes it, if that is another one. */
static Jump closing(const ZpPlot *plot) {
  Jump jump = {NAN, NAN, NAN};
  return isnan(pull_in(plot).to) ? jump_at(plot, "closing_voltage_V", true) : jump;
}

/* NAME_at, NAME_from, NAME_to. */
static void define_jump(FILE *file, const char *name, Jump jump) {
  const double value[] = {jump.voltage, jump.from, jump.to};
  static const char *const part[] = {"at", "from", "to"};
  for (size_t i = 0; i < 3; i++) {
    char variable[32];
    snprintf(variable, sizeof variable, "%s_%s", name, part[i]);
    zp_plot_define(file, variable, value[i]);
  }
}

static void define_path(const ZpPlot *plot, FILE *file) {
  static const char *const kind_name[KINDS] = {"stable", "unstable", "closed_stable", "closed_unstable"};
  zp_plot_define_word(file, "travel", travel(plot));
  fputs("kinds = '", file);
  for (int k = 0; k < KINDS; k++)
    if (has_kind(plot, k)) fprintf(file, "%s ", kind_name[k]);
  fputs("'\n", file);
  define_jump(file, "pull_in", pull_in(plot));
  define_jump(file, "closing", closing(plot));
  define_jump(file, "release", jump_at(plot, "release_voltage_V", false));
}

static bool has_path(const ZpPlot *plot) {
  return plot->def.drive.voltage > 0 && zp_plot_has(plot->table, travel(plot));
}

/* A single ribbon has no electrodes. */
static bool has_electrodes(const ZpPlot *plot) {
  return has_path(plot) && plot->def.actuator.kind != ZP_KIND_RIBBON;
}

static bool has_zipped_length(const ZpPlot *plot) {
  return has_electrodes(plot) && zp_plot_range(plot->table, "zipped_length_m").high > 0;
}

enum { BRANCHES = ZP_OF(branch) | ZP_OF(held_branch) };

const ZpPicture zp_path_pictures[] = {
    {"stroke", "svg", "stroke_rest.gp", ZP_OF(branch), .needs = "voltage_V", .has = has_path, .define = define_path},
    {"force", "svg", "force_rest.gp", ZP_OF(held_branch), .needs = "voltage_V", .has = has_path, .define = define_path},
    {"zipped_length", "svg", "zipped_length_rest.gp", BRANCHES, .needs = "voltage_V zipped_length_m",
     .has = has_zipped_length, .define = define_path},
    {"charge", "svg", "charge_rest.gp", BRANCHES, .needs = "voltage_V charge_C capacitance_F", .has = has_electrodes,
     .define = define_path},
    {0},
};
