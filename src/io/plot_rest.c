/* Pictures of one state of rest: shape.svg, the loaded shape, and modes.svg, how it vibrates. */
#include <math.h>

#include "io/plot.h"

/* Modes drawn, in rows of as many panels. */
#define MODES  6
#define ACROSS 3
#define DOWN   2

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

static void script_shape(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(film(plot));
  const ZpPlotUnit length = zp_plot_box_unit(&box);
  const bool pair = film(plot)->ribbons > 1, tall = zp_plot_fits_same_scale(&box);
  double stroke = zp_result_get(plot->single, "stroke_m");
  zp_plot_head_of_shapes(plot, file, "shape", "Shape at rest", pair ? 0.82 : 0.96);
  if (!tall) zp_plot_remark(file, "x and y have different scales");
  fprintf(file,
          "set xlabel 'x / %s'\nset ylabel 'y / %s' offset 0.5\nset autoscale noextend\n"
          "set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04\n",
          length.text, length.text);
  if (tall) zp_plot_same_scale(file, &box, length, 10);
  if (isfinite(stroke))
    fprintf(file, "set label 5 'stroke %.4g %s' at screen %g,0.905 right font ',12' tc rgb '#555555'\n",
            stroke * length.factor, length.text, 0.985);
  for (size_t r = 0; r < film(plot)->ribbons; r++)
    fprintf(file, "%s'shape.dat' index %zu using ($1*%g):($2*%g) with lines lw 2.5 lc rgb '%s' %s",
            r ? ", \\\n     " : "plot ", r, length.factor, length.factor, zp_plot_colour(r),
            !pair ? "notitle"
            : r   ? "title 'lower'"
                  : "title 'upper'");
  fputc('\n', file);
}

/* -- modes ---------------------------------------------------------------------------------------- */

/* Frames have the number of their mode as time; 0 is the equilibrium itself. */
static bool is_rest(const ZpPlot *plot, size_t frame) {
  return zp_shapes_get(film(plot), frame).time == 0;
}

static bool starts_at_rest(const ZpPlot *plot) {
  return is_rest(plot, 0);
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

/* Edges of panel k on the screen and its title. */
static void panel(const ZpPlot *plot, FILE *file, size_t k) {
  const size_t column = k % ACROSS, row = k / ACROSS;
  const double left = 0.09 + 0.305 * (double)column, top = 0.82 - 0.37 * (double)row;
  double frequency = zp_table_get(plot->single->series, k, "frequency_Hz");
  if (k == 1) fputs("unset label\n", file);
  fprintf(file,
          "set lmargin at screen %.4g\nset rmargin at screen %.4g\n"
          "set tmargin at screen %.4g\nset bmargin at screen %.4g\n"
          "set label 6 '%zu: %.4g Hz' at graph 0.5,1.09 center font ',13'\n",
          left, left + 0.275, top, top - 0.29, k + 1, frequency);
}

static void plot_mode(const ZpPlot *plot, FILE *file, size_t k, ZpPlotUnit length) {
  const bool rest = starts_at_rest(plot);
  fputs("plot ", file);
  if (rest)
    fprintf(file, "'modes.dat' index 0 using ($1*%g):($2*%g) with lines lw 1.5 lc rgb '#999999', \\\n     ",
            length.factor, length.factor);
  fprintf(file, "'modes.dat' index %zu using ($1*%g):($2*%g) with lines lw 2 lc rgb '%s'\n", k + rest, length.factor,
          length.factor, zp_plot_colour(0));
}

static void script_modes(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(film(plot));
  const ZpPlotUnit length = zp_plot_box_unit(&box);
  const double edge = 0.04 * (box.right - box.left), bottom = box.bottom - edge, top = box.top + edge;
  const size_t count = modes(plot);
  zp_plot_head_of_shapes(plot, file, "modes", "Modes about the loaded equilibrium", 0.96);
  zp_plot_remark(file, starts_at_rest(plot) ? "grey: at rest; the size of a mode is arbitrary"
                                            : "the size of a mode is arbitrary");
  fprintf(file,
          "unset key\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n"
          "set xtics font ',11'\nset ytics font ',11'\n",
          (box.left - edge) * length.factor, (box.right + edge) * length.factor, bottom * length.factor,
          top * length.factor);
  zp_plot_same_scale(file, &box, length, 6);
  fputs("set multiplot\n", file);
  for (size_t k = 0; k < count; k++) {
    panel(plot, file, k);
    fprintf(file, k + ACROSS >= count ? "set xlabel 'x / %s'\nset format x '%%g'\n" : "unset xlabel\nset format x ''\n",
            length.text);
    fprintf(file,
            k % ACROSS == 0 ? "set ylabel 'y / %s' offset 0.5\nset format y '%%g'\n"
                            : "unset ylabel\nset format y ''\n",
            length.text);
    plot_mode(plot, file, k, length);
  }
  fputs("unset multiplot\n", file);
}

const ZpPicture zp_rest_pictures[] = {
    {"shape", "svg", has_shape, script_shape, data_shape},
    {"modes", "svg", has_modes, script_modes, data_modes},
    {0},
};
