/* Pictures of one state of rest: shape.svg, the loaded shape, and modes.svg, how it vibrates. */
#include <math.h>

#include "io/plot.h"

/* Modes drawn. */
#define MODES 6

static const ZpShapes *film(const ZpPlot *plot) {
  return plot->single->shapes;
}

static bool has_film(const ZpPlot *plot, ZpShows shows) {
  if (plot->shows != shows || !plot->single || !film(plot) || film(plot)->frames == 0) return false;
  return isfinite(zp_plot_box(film(plot)).left);
}

static bool has_shape(const ZpPlot *plot) {
  return has_film(plot, ZP_SHOWS_shape);
}

static void data_shape(const ZpPlot *plot, FILE *file) {
  const ZpShape shape = zp_shapes_get(film(plot), 0);
  fputs("# x_m y_m ribbon; an index per ribbon (upper, lower)\n", file);
  for (size_t r = 0; r < film(plot)->ribbons; r++) {
    for (size_t i = 0; i < film(plot)->nodes; i++) {
      zp_plot_put(file, shape.x[i * film(plot)->ribbons + r], ' ');
      zp_plot_put(file, shape.y[i * film(plot)->ribbons + r], ' ');
      fprintf(file, "%zu\n", r);
      if (zp_plot_ends_member(film(plot), i)) fputc('\n', file);
    }
    fputc('\n', file);
  }
}

static void define_shapes(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(film(plot));
  zp_plot_define_count(file, "half", zp_plot_is_half(plot));
  zp_plot_define_count(file, "ribbons", film(plot)->ribbons);
  zp_plot_define_box(file, &box);
}

static void define_shape(const ZpPlot *plot, FILE *file) {
  define_shapes(plot, file);
  zp_plot_define_scalar(plot, file, "stroke_m");
}

/* -- modes ---------------------------------------------------------------------------------------- */

/* Frames have the number of their mode as time; 0 is the equilibrium itself. */
static bool starts_at_rest(const ZpPlot *plot) {
  return zp_shapes_get(film(plot), 0).time == 0;
}

static bool has_modes(const ZpPlot *plot) {
  return has_film(plot, ZP_SHOWS_modes) && film(plot)->frames > starts_at_rest(plot);
}

/* How many modes are drawn. */
static size_t modes(const ZpPlot *plot) {
  size_t count = film(plot)->frames - starts_at_rest(plot);
  return count < MODES ? count : MODES;
}

static void data_modes(const ZpPlot *plot, FILE *file) {
  const size_t count = modes(plot) + starts_at_rest(plot);
  fputs("# x_m y_m mode (0: at rest); an index per mode, NaN after each ribbon (upper, lower)\n", file);
  for (size_t k = 0; k < count; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), k);
    zp_plot_put_shape(file, film(plot), &shape, shape.time);
    fputs("\n\n", file);
  }
}

static void define_modes(const ZpPlot *plot, FILE *file) {
  define_shapes(plot, file);
  zp_plot_define_count(file, "at_rest", starts_at_rest(plot));
  zp_plot_define_array(file, "frequency", modes(plot));
  for (size_t k = 0; k < modes(plot); k++)
    zp_plot_define(file, zp_plot_entry("frequency", k + 1).text, zp_table_get(plot->single->series, k, "frequency_Hz"));
}

const ZpPicture zp_rest_pictures[] = {
    {"shape", "svg", has_shape, define_shape, data_shape, "shape.gp"},
    {"modes", "svg", has_modes, define_modes, data_modes, "modes.gp"},
    {0},
};
