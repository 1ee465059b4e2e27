/* Pictures of the states of rest along the voltage: stroke.svg or (isometric) force.svg, charge.svg, zipped_length.svg,
 * shapes.svg. */
#include <math.h>
#include <string.h>

#include "io/plot.h"

/* Right edge of the plot area; the legend is to the right of it. */
#define RIGHT 0.76

/* Curves of shapes.svg, as many as can be told apart. */
#define SNAPSHOTS 9

/* The kinds of curve; a curve of each kind that a table has is one index of the .dat. */
enum { STABLE, UNSTABLE, CLOSED_STABLE, CLOSED_UNSTABLE, KINDS };

static const struct {
  const char *legend, *look;
} kind_of_curve[KINDS] = {{"stable", "lw 2.5 lc rgb '#0072b2'"},
                          {"unstable", "lw 1.5 dt 2 lc rgb '#d55e00'"},
                          {"stable, closed", "lw 2.5 lc rgb '#009e73'"},
                          {"unstable, closed", "lw 1.5 dt 2 lc rgb '#b8a800'"}};

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

static ZpPlotUnit voltage_unit(const ZpPlot *plot) {
  return zp_plot_unit(plot->def.drive.voltage, "V");
}

static void begin(const ZpPlot *plot, FILE *file, ZpPlotUnit voltage) {
  fprintf(file, "set xrange [0:%.17g]\nset xlabel 'voltage / %s'\n", plot->def.drive.voltage * voltage.factor,
          voltage.text);
}

/* The curves of column `column` of NAME.dat. */
static void plot_path(const ZpPlot *plot, FILE *file, const char *name, int column, ZpPlotUnit unit) {
  int index = 0;
  for (int k = 0; k < KINDS; k++) {
    if (!has_kind(plot, k)) continue;
    fprintf(file, "%s'%s.dat' index %d using ($1*%g):($%d*%g) with lines %s title \"%s\"",
            index ? ", \\\n     " : "plot ", name, index, voltage_unit(plot).factor, column, unit.factor,
            kind_of_curve[k].look, kind_of_curve[k].legend);
    index++;
  }
  fputc('\n', file);
}

/* A jump from one stable part to another at a voltage. */
typedef struct Jump {
  double voltage, from, to; /* V; m of the travel, NAN if unknown */
} Jump;

/* Travel at the limit point nearest to a voltage: where stability changes. */
static double travel_at_limit(const ZpPlot *plot, double voltage) {
  double least = INFINITY, found = NAN;
  for (size_t row = 0; row < series(plot)->rows; row++) {
    if (!goes_on(plot, row) || kind(plot, row) == kind(plot, row + 1)) continue;
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

static Jump jump_at(const ZpPlot *plot, const char *scalar) {
  Jump jump = {.voltage = zp_result_get(plot->single, scalar), .from = NAN, .to = NAN};
  if (isnan(jump.voltage)) return jump;
  jump.from = travel_at_limit(plot, jump.voltage);
  jump.to = stable_travel(plot, jump.voltage, jump.from);
  return jump;
}

/* A thin arrow with its voltage beside it; a point where it is not known where the jump ends. */
static void mark_jump(const ZpPlot *plot, FILE *file, int tag, const char *scalar, const char *name,
                      ZpPlotUnit length) {
  const Jump jump = jump_at(plot, scalar);
  const ZpPlotUnit voltage = voltage_unit(plot);
  const bool left = jump.voltage > 0.78 * plot->def.drive.voltage, whole = isfinite(jump.to);
  double at = jump.voltage * voltage.factor, from = jump.from * length.factor, to = jump.to * length.factor;
  if (!isfinite(at) || !isfinite(from)) return;
  if (whole)
    fprintf(file,
            "set arrow %d from %.17g,%.17g to %.17g,%.17g front head filled size screen 0.012,18 lw 1.2 "
            "lc rgb '#333333'\n",
            tag, at, from, at, to);
  fprintf(file, "set label %d at %.17g,%.17g point pt 7 ps 0.6 lc rgb '#333333' front\n", tag + 20, at, from);
  fprintf(file, "set label %d '%s %.4g %s' at %.17g,%.17g %s offset char %d,0 front font ',12'\n", tag + 10, name, at,
          voltage.text, at, whole ? (from + to) / 2 : from, left ? "right" : "left", left ? -1 : 1);
}

static bool has_stroke(const ZpPlot *plot) {
  return is_path(plot) && !is_held(plot) && zp_plot_has(series(plot), travel(plot));
}

static void script_stroke(const ZpPlot *plot, FILE *file) {
  const bool opens = strcmp(travel(plot), "opening_m") == 0;
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){travel(plot), NULL}, "m");
  zp_plot_head(plot, file, "stroke", opens ? "Opening at rest against voltage" : "Stroke at rest against voltage",
               RIGHT);
  begin(plot, file, voltage_unit(plot));
  mark_jump(plot, file, 11, "pull_in_voltage_V", "pull-in", length);
  mark_jump(plot, file, 12, "release_voltage_V", "release", length);
  fprintf(file, "set ylabel '%s / %s' offset 0.5\nset autoscale y noextend\nset offsets 0, 0, graph 0.05, graph 0.03\n",
          opens ? "opening" : "stroke", length.text);
  plot_path(plot, file, "stroke", 2, length);
}

static bool has_force(const ZpPlot *plot) {
  return is_path(plot) && is_held(plot) && zp_plot_has(series(plot), "force_N");
}

static void script_force(const ZpPlot *plot, FILE *file) {
  ZpPlotUnit unit = zp_plot_table_unit(series(plot), (const char *const[]){"force_N", NULL}, "N");
  zp_plot_head(plot, file, "force", "Force on the held platform against voltage", RIGHT);
  begin(plot, file, voltage_unit(plot));
  fprintf(file,
          "set ylabel 'force / %s' offset 0.5\nset autoscale y noextend\nset offsets 0, 0, graph 0.05, graph 0.03\n",
          unit.text);
  plot_path(plot, file, "force", 2, unit);
}

static bool has_zipped_length(const ZpPlot *plot) {
  return is_path(plot) && plot->def.actuator.kind != ZP_KIND_RIBBON && zp_plot_has(series(plot), "zipped_length_m");
}

static void script_zipped_length(const ZpPlot *plot, FILE *file) {
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"zipped_length_m", NULL}, "m");
  const char *title = plot->def.actuator.kind == ZP_KIND_ELECTRO_RIBBON
                          ? "Closed length from the clip, one half, against voltage"
                          : "Closed length at rest against voltage";
  zp_plot_head(plot, file, "zipped_length", title, RIGHT);
  begin(plot, file, voltage_unit(plot));
  fprintf(file, "set yrange [0:*]\nset ylabel 'zipped length / %s' offset 0.5\nset offsets 0, 0, graph 0.05, 0\n",
          length.text);
  plot_path(plot, file, "zipped_length", 3, length);
}

static bool has_charge(const ZpPlot *plot) {
  return has_zipped_length(plot) && zp_plot_has(series(plot), "charge_C") && zp_plot_has(series(plot), "capacitance_F");
}

static void script_charge(const ZpPlot *plot, FILE *file) {
  ZpPlotUnit charge = zp_plot_table_unit(series(plot), (const char *const[]){"charge_C", NULL}, "C");
  ZpPlotUnit capacitance = zp_plot_table_unit(series(plot), (const char *const[]){"capacitance_F", NULL}, "F");
  ZpPlotUnit voltage = voltage_unit(plot);
  char label[32];
  snprintf(label, sizeof label, "voltage / %s", voltage.text);
  zp_plot_head(plot, file, "charge", "Charge and capacitance at rest against voltage", RIGHT);
  begin(plot, file, voltage);
  fputs("set yrange [0:*]\nset offsets 0, 0, graph 0.05, 0\n", file);
  zp_plot_upper_panel(file);
  fprintf(file, "set ylabel 'charge / %s' offset 0.5\n", charge.text);
  plot_path(plot, file, "charge", 4, charge);
  zp_plot_lower_panel(file, RIGHT, label);
  fprintf(file, "unset key\nset ylabel 'capacitance / %s' offset 0.5\n", capacitance.text);
  plot_path(plot, file, "charge", 5, capacitance);
  fputs("unset multiplot\n", file);
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

static void script_shapes(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(film(plot));
  const ZpPlotUnit length = zp_plot_box_unit(&box), voltage = voltage_unit(plot);
  size_t chosen[SNAPSHOTS], count = choose(plot, chosen);
  zp_plot_head_of_shapes(plot, file, "shapes", "Shapes at rest", 0.78);
  if (!zp_plot_fits_same_scale(&box)) zp_plot_remark(file, "x and y have different scales");
  fprintf(file,
          "set key title 'along the path' left font ',12'\n"
          "set xlabel 'x / %s'\nset ylabel 'y / %s' offset 0.5\nset autoscale noextend\n"
          "set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04\n",
          length.text, length.text);
  if (zp_plot_fits_same_scale(&box)) zp_plot_same_scale(file, &box, length, 10);
  for (size_t k = 0; k < count; k++) {
    bool stable = kind(plot, row_of(plot, chosen[k])) % 2 == 0;
    fprintf(file,
            "%s'shapes.dat' index %zu using ($1*%g):($2*%g) with lines lw 2 %slc rgb '#%06x' "
            "title '%.3g %s%s'",
            k ? ", \\\n     " : "plot ", k, length.factor, length.factor, stable ? "" : "dt 2 ",
            zp_plot_shade((double)k / (double)(count - 1)),
            zp_shapes_get(film(plot), chosen[k]).voltage * voltage.factor, voltage.text, stable ? "" : ", unstable");
  }
  fputc('\n', file);
}

const ZpPicture zp_path_pictures[] = {
    {"stroke", "svg", has_stroke, script_stroke, data_path},
    {"force", "svg", has_force, script_force, data_path},
    {"zipped_length", "svg", has_zipped_length, script_zipped_length, data_path},
    {"charge", "svg", has_charge, script_charge, data_path},
    {"shapes", "svg", has_shapes, script_shapes, data_shapes},
    {0},
};
