/* Pictures of the shapes of one run: profiles.svg over time, shapes.svg along the voltage, shape.svg in equilibrium,
 * and modes.svg for its vibrations. */
#include <math.h>

#include "io/plot.h"

/* Curves of shapes.svg and panels of modes.svg, as many as a reader can distinguish. */
enum { STATES = 9, MODES = 6 };

static const ZpShapes *film(const ZpPlot *plot) {
  return plot->single->shapes;
}

/* Blocks of x, y, time and ribbon, one per frame. A row of NaN ends a ribbon, not an empty row: with an empty one,
 * gnuplot 5.4 uses a colour that was never set, and the picture varies. */
static void put_frames(const ZpPlot *plot, FILE *file, const size_t *frame, size_t count) {
  const ZpShapes *shapes = film(plot);
  const size_t nodes = shapes->nodes / shapes->members; /* of a member of a series */
  fputs("# x_m y_m time_s ribbon (0 upper, 1 lower); an index per shape; NaN after each ribbon\n", file);
  for (size_t k = 0; k < count; k++) {
    const ZpShape shape = zp_shapes_get(shapes, frame[k]);
    for (size_t i = 0; i < shapes->nodes * shapes->ribbons; i++) {
      const size_t ribbon = i / shapes->nodes, node = i % shapes->nodes, at = node * shapes->ribbons + ribbon;
      zp_plot_put(file, shape.x[at], ' ');
      zp_plot_put(file, shape.y[at], ' ');
      zp_plot_put(file, shape.time, ' ');
      fprintf(file, "%zu\n", ribbon);
      if ((node + 1) % nodes == 0) fprintf(file, "NaN NaN NaN %zu\n", ribbon);
    }
    fputs("\n\n", file);
  }
}

/* -- over time ------------------------------------------------------------------------------------- */

static bool has_profiles(const ZpPlot *plot) {
  return zp_plot_has_frames(plot, 2);
}

static void data_profiles(const ZpPlot *plot, FILE *file) {
  size_t frame[ZP_PLOT_SNAPSHOTS];
  put_frames(plot, file, frame, zp_plot_snapshots(film(plot), frame));
}

/* -- along the voltage ------------------------------------------------------------------------------ */

/* How much the shape moves from a frame to the next: the largest movement of a node, m. */
static double movement(const ZpShapes *shapes, size_t frame) {
  const ZpShape a = zp_shapes_get(shapes, frame), b = zp_shapes_get(shapes, frame + 1);
  double most = 0;
  for (size_t i = 0; i < shapes->nodes * shapes->ribbons; i++)
    most = fmax(most, hypot(b.x[i] - a.x[i], b.y[i] - a.y[i]));
  return most;
}

/* Choose frames that differ by about equal movements, fewer where a jump to another branch is longer => how many. */
static size_t choose_states(const ZpShapes *shapes, size_t chosen[STATES]) {
  double total = 0, way = 0;
  size_t count = 0;
  for (size_t i = 0; i + 1 < shapes->frames; i++)
    total += movement(shapes, i);
  const double part = total / (STATES - 1);
  double next = part;
  chosen[count++] = 0;
  for (size_t i = 1; i + 1 < shapes->frames && count + 1 < STATES; i++) {
    way += movement(shapes, i - 1);
    if (way < next) continue;
    chosen[count++] = i;
    next = part * (floor(way / part) + 1);
  }
  chosen[count++] = shapes->frames - 1;
  return count;
}

static bool has_states(const ZpPlot *plot) {
  return plot->def.drive.voltage > 0 && zp_plot_has_frames(plot, 2);
}

static void data_states(const ZpPlot *plot, FILE *file) {
  size_t chosen[STATES];
  put_frames(plot, file, chosen, choose_states(film(plot), chosen));
}

/* Voltage and stability of each; the time of a shape is the number of its row among all. */
static void define_states(const ZpPlot *plot, FILE *file) {
  size_t chosen[STATES], count = choose_states(film(plot), chosen);
  zp_plot_define_array(file, "voltage_at", count);
  zp_plot_define_array(file, "stable", count);
  for (size_t k = 0; k < count; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), chosen[k]);
    const size_t row = (size_t)fmin(shape.time / (double)plot->table->stride, (double)plot->table->rows - 1);
    zp_plot_define(file, zp_plot_entry("voltage_at", k + 1).text, shape.voltage);
    zp_plot_define_count(file, zp_plot_entry("stable", k + 1).text, zp_table_get(plot->table, row, "stable") > 0);
  }
}

/* -- at rest --------------------------------------------------------------------------------------- */

static bool has_shape(const ZpPlot *plot) {
  return zp_plot_has_frames(plot, 1);
}

static void data_shape(const ZpPlot *plot, FILE *file) {
  put_frames(plot, file, (const size_t[]){0}, 1);
}

/* Frames have the number of their mode as time; 0 is the equilibrium itself. */
static bool starts_at_rest(const ZpPlot *plot) {
  return zp_shapes_get(film(plot), 0).time == 0;
}

static bool has_modes(const ZpPlot *plot) {
  return zp_plot_has_frames(plot, 1) && film(plot)->frames > starts_at_rest(plot);
}

/* How many modes are drawn. */
static size_t modes(const ZpPlot *plot) {
  const size_t count = film(plot)->frames - starts_at_rest(plot);
  return count < MODES ? count : MODES;
}

static void data_modes(const ZpPlot *plot, FILE *file) {
  put_frames(plot, file, (const size_t[]){0, 1, 2, 3, 4, 5, 6}, modes(plot) + starts_at_rest(plot));
}

static void define_modes(const ZpPlot *plot, FILE *file) {
  zp_plot_define_count(file, "at_rest", starts_at_rest(plot));
  zp_plot_define_array(file, "frequency", modes(plot));
  for (size_t k = 0; k < modes(plot); k++)
    zp_plot_define(file, zp_plot_entry("frequency", k + 1).text, zp_table_get(plot->table, k, "frequency_Hz"));
}

const ZpPicture zp_shape_pictures[] = {
    {"profiles", "svg", "profiles.gp", ZP_OF(motion), .has = has_profiles, .data = data_profiles},
    {"shapes", "svg", "shapes_rest.gp", ZP_OF(branch) | ZP_OF(held_branch), .needs = "voltage_V", .has = has_states,
     .define = define_states, .data = data_states},
    {"shape", "svg", "shape.gp", ZP_OF(shape), .has = has_shape, .data = data_shape},
    {"modes", "svg", "modes.gp", ZP_OF(modes), .has = has_modes, .define = define_modes, .data = data_modes},
    {0},
};
