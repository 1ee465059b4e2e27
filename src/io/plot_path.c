/* Pictures of the states of rest along the voltage: stroke.svg or (isometric) force.svg, charge.svg, zipped_length.svg,
 * shapes.svg. */
#include <math.h>

#include "io/plot.h"

/* Curves of shapes.svg, as many as can be told apart. */
#define SNAPSHOTS 9

/* The kinds of curve; a curve of each kind that a table has is one index of the .dat. */
enum { STABLE, UNSTABLE, CLOSED_STABLE, CLOSED_UNSTABLE, KINDS };

static const ZpTable *series(const ZpPlot *plot) {
  return plot->single->series;
}

static double get(const ZpPlot *plot, size_t row, const char *column) {
  return zp_table_get(series(plot), row, column);
}

static bool is_held(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_held_branch;
}

static bool is_path(const ZpPlot *plot) {
  return (plot->shows == ZP_SHOWS_branch || is_held(plot)) && plot->single && zp_plot_has(series(plot), "voltage_V") &&
         plot->def.drive.voltage > 0;
}

/* What tells how far it is closed: the opening, or the stroke of a kind that has none; of a held one, its force. */
static const char *travel(const ZpPlot *plot) {
  if (is_held(plot)) return "force_N";
  return zp_plot_has(series(plot), "opening_m") ? "opening_m" : "stroke_m";
}

static int kind(const ZpPlot *plot, size_t row) {
  return 2 * (get(plot, row, "branch") > 0) + !(get(plot, row, "stable") > 0);
}

static bool has_kind(const ZpPlot *plot, int wanted) {
  for (size_t row = 0; row < series(plot)->rows; row++)
    if (kind(plot, row) == wanted) return true;
  return false;
}

/* Whether the next row is on the same branch. */
static bool goes_on(const ZpPlot *plot, size_t row) {
  return row + 1 < series(plot)->rows && kind(plot, row) / 2 == kind(plot, row + 1) / 2;
}

static void put_row(const ZpPlot *plot, FILE *file, size_t row) {
  zp_plot_put(file, get(plot, row, "voltage_V"), ' ');
  zp_plot_put(file, get(plot, row, travel(plot)), ' ');
  zp_plot_put(file, get(plot, row, "zipped_length_m"), ' ');
  zp_plot_put(file, get(plot, row, "charge_C"), ' ');
  zp_plot_put(file, get(plot, row, "capacitance_F"), '\n');
}

/* An index per kind of curve. Where the kind changes, the curve continues to the first row of the other. */
static void data_path(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# voltage_V %s zipped_length_m charge_C capacitance_F; NaN ends a piece, an index is\n", travel(plot));
  fputs("# stable, unstable, stable on the closed branch, unstable there: those that there are\n", file);
  for (int wanted = 0; wanted < KINDS; wanted++) {
    if (!has_kind(plot, wanted)) continue;
    for (size_t row = 0; row < series(plot)->rows; row++) {
      if (kind(plot, row) != wanted) continue;
      put_row(plot, file, row);
      bool ends = !goes_on(plot, row) || kind(plot, row + 1) != wanted;
      if (ends && goes_on(plot, row)) put_row(plot, file, row + 1);
      if (ends) fputs("NaN NaN NaN NaN NaN\n", file);
    }
    fputs("\n\n", file);
  }
}

/* A jump from one stable part to another at a voltage. */
typedef struct Jump {
  double voltage, from, to; /* V; m of the travel, NAN if unknown */
} Jump;

/* Does stability change behind a row: `rising`, does it end there as the curve is followed from hanging? */
static bool is_limit(const ZpPlot *plot, size_t row, bool rising) {
  if (!goes_on(plot, row) || kind(plot, row) == kind(plot, row + 1)) return false;
  return !rising || kind(plot, row) % 2 == 0;
}

/* Travel at the limit point nearest to a voltage; NAN where none is near. */
static double travel_at_limit(const ZpPlot *plot, double voltage, bool rising) {
  static const double near = 0.02; /* of the voltage: rows are no closer */
  double least = near * voltage, found = NAN;
  for (size_t row = 0; row < series(plot)->rows; row++) {
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
  for (size_t row = 0; row < series(plot)->rows; row++) {
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

/* The jump at the first limit point: one that does not close the actuator ends at a state close by. */
static Jump pull_in(const ZpPlot *plot) {
  static const double same = 1e-6;
  Jump jump = jump_at(plot, "pull_in_voltage_V", true);
  if (zp_result_get(plot->single, "closing_voltage_V") > (1 + same) * jump.voltage) jump.to = NAN;
  return jump;
}

/* The jump that closes it, where that is another one. */
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
  zp_plot_define_key(plot, file, "actuator.kind");
  zp_plot_define_key(plot, file, "drive.voltage");
  zp_plot_define_word(file, "travel", travel(plot));
  fputs("kinds = '", file);
  for (int k = 0; k < KINDS; k++)
    if (has_kind(plot, k)) fprintf(file, "%s ", kind_name[k]);
  fputs("'\n", file);
  define_jump(file, "pull_in", pull_in(plot));
  define_jump(file, "closing", closing(plot));
  define_jump(file, "release", jump_at(plot, "release_voltage_V", false));
  zp_plot_define_table(file, series(plot));
}

static bool has_stroke(const ZpPlot *plot) {
  return is_path(plot) && !is_held(plot) && zp_plot_has(series(plot), travel(plot));
}

static bool has_force(const ZpPlot *plot) {
  return is_path(plot) && is_held(plot) && zp_plot_has(series(plot), "force_N");
}

static bool has_zipped_length(const ZpPlot *plot) {
  return is_path(plot) && plot->def.actuator.kind != ZP_KIND_RIBBON && zp_plot_has(series(plot), "zipped_length_m");
}

static bool has_charge(const ZpPlot *plot) {
  return has_zipped_length(plot) && zp_plot_has(series(plot), "charge_C") && zp_plot_has(series(plot), "capacitance_F");
}

/* -- shapes --------------------------------------------------------------------------------------- */

static const ZpShapes *film(const ZpPlot *plot) {
  return plot->single->shapes;
}

/* Row of the state that a frame shows, which has its number as time. */
static size_t row_of(const ZpPlot *plot, size_t frame) {
  const ZpTable *table = series(plot);
  double row = zp_shapes_get(film(plot), frame).time / (double)table->stride;
  return row < (double)table->rows ? (size_t)row : table->rows - 1;
}

/* How much the shape moves from a frame to the next: the largest movement of a node, m. */
static double movement(const ZpPlot *plot, size_t frame) {
  const ZpShapes *shapes = film(plot);
  const ZpShape a = zp_shapes_get(shapes, frame), b = zp_shapes_get(shapes, frame + 1);
  double most = 0;
  for (size_t i = 0; i < shapes->nodes * shapes->ribbons; i++)
    most = fmax(most, hypot(b.x[i] - a.x[i], b.y[i] - a.y[i]));
  return most;
}

/* Choose frames that differ by about equal movements, fewer where a jump to another branch is longer. => how
 * many, at most SNAPSHOTS */
static size_t choose(const ZpPlot *plot, size_t chosen[SNAPSHOTS]) {
  const size_t frames = film(plot)->frames;
  double total = 0, way = 0, next;
  size_t count = 0;
  for (size_t i = 0; i + 1 < frames; i++)
    total += movement(plot, i);
  const double part = total / (SNAPSHOTS - 1);
  chosen[count++] = 0;
  next = part;
  for (size_t i = 1; i + 1 < frames && count + 1 < SNAPSHOTS; i++) {
    way += movement(plot, i - 1);
    if (way < next) continue;
    chosen[count++] = i;
    next = part * (floor(way / part) + 1);
  }
  chosen[count++] = frames - 1;
  return count;
}

static bool has_shapes(const ZpPlot *plot) {
  return is_path(plot) && film(plot) && film(plot)->frames >= 2 && isfinite(zp_plot_box(film(plot)).left);
}

/* An index per frame. */
static void data_shapes(const ZpPlot *plot, FILE *file) {
  size_t chosen[SNAPSHOTS], count = choose(plot, chosen);
  fputs("# x_m y_m voltage_V; an index per state, NaN after each ribbon (upper, lower)\n", file);
  for (size_t k = 0; k < count; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), chosen[k]);
    zp_plot_put_shape(file, film(plot), &shape, shape.voltage);
    fputs("\n\n", file);
  }
}

static void define_shapes(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(film(plot));
  size_t chosen[SNAPSHOTS], count = choose(plot, chosen);
  zp_plot_define_key(plot, file, "drive.voltage");
  zp_plot_define_count(file, "half", zp_plot_is_half(plot));
  zp_plot_define_box(file, &box);
  zp_plot_define_array(file, "voltage_at", count);
  zp_plot_define_array(file, "stable", count);
  for (size_t k = 0; k < count; k++) {
    zp_plot_define(file, zp_plot_entry("voltage_at", k + 1).text, zp_shapes_get(film(plot), chosen[k]).voltage);
    zp_plot_define_count(file, zp_plot_entry("stable", k + 1).text, kind(plot, row_of(plot, chosen[k])) % 2 == 0);
  }
}

const ZpPicture zp_path_pictures[] = {
    {"stroke", "svg", has_stroke, define_path, data_path, "stroke_rest.gp"},
    {"force", "svg", has_force, define_path, data_path, "force_rest.gp"},
    {"zipped_length", "svg", has_zipped_length, define_path, data_path, "zipped_length_rest.gp"},
    {"charge", "svg", has_charge, define_path, data_path, "charge_rest.gp"},
    {"shapes", "svg", has_shapes, define_shapes, data_shapes, "shapes_rest.gp"},
    {0},
};
