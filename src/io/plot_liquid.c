/* The liquid of one run: where it is in the animation, and film.svg. */
#include <math.h>

#include "io/plot.h"

/* Curves of film.svg, as many as can be told apart. */
#define SNAPSHOTS 8

static const ZpShapes *shapes(const ZpPlot *plot) {
  return plot->single->shapes;
}

bool zp_plot_has_liquid(const ZpPlot *plot) {
  if (plot->shows != ZP_SHOWS_motion || !plot->single || !shapes(plot) || shapes(plot)->ribbons < 2) return false;
  return zp_def_liquid(&plot->def) != ZP_LIQUID_NONE && zp_plot_has(plot->single->series, "film_thickness_m");
}

bool zp_plot_has_bead(const ZpPlot *plot) {
  return zp_plot_has_liquid(plot) && zp_def_liquid(&plot->def) == ZP_LIQUID_BEAD && shapes(plot)->members == 1;
}

/* Nodes of one ribbon of a half. */
static size_t half_nodes(const ZpPlot *plot) {
  return zp_plot_is_half(plot) ? shapes(plot)->nodes : shapes(plot)->nodes / 2;
}

/* How far from its clip liquid wets a half, m. */
static double reach_at(const ZpPlot *plot, double time) {
  return zp_plot_has_bead(plot) ? zp_plot_at_time(plot->single->series, "wet_length_m", time) : (double)INFINITY;
}

/* x and both y at `place` elements from the clip of the left half or of the right one. */
static void put_place(const ZpPlot *plot, FILE *file, const ZpShape *shape, const ZpPlotSide *side, double place) {
  size_t last = half_nodes(plot) - 1, k = place < (double)last ? (size_t)place : last;
  size_t near = side->from_right ? shapes(plot)->nodes - 1 - k : k;
  size_t far = k == last ? near : side->from_right ? near - 1 : near + 1;
  double part = k == last ? 0 : place - (double)k;
  double x = shape->x[2 * near] + part * (shape->x[2 * far] - shape->x[2 * near]);
  zp_plot_put(file, side->sign * (x - side->middle), ' ');
  for (size_t r = 0; r < 2; r++) {
    double y = shape->y[2 * near + r], beyond = shape->y[2 * far + r];
    zp_plot_put(file, y + part * (beyond - y), r ? '\n' : ' ');
  }
}

void zp_plot_put_liquid(const ZpPlot *plot, FILE *file, const ZpShape *shape, const ZpPlotSide *side) {
  double length = (plot->def.ribbon.length - plot->def.platform.length) / 2, reach = reach_at(plot, shape->time);
  size_t last = half_nodes(plot) - 1;
  double end = fmin(reach / length, 1) * (double)last;
  if (!isfinite(end)) return;
  for (size_t k = 0; (double)k < end; k++)
    put_place(plot, file, shape, side, (double)k);
  put_place(plot, file, shape, side, end);
}

/* -- film.svg -------------------------------------------------------------------------------------- */

static bool has_film(const ZpPlot *plot) {
  if (zp_plot_has_bead(plot) && !zp_plot_has(plot->single->series, "wet_length_m")) return false;
  return zp_plot_has_liquid(plot) && shapes(plot)->members == 1 && shapes(plot)->frames >= 2 &&
         isfinite(zp_plot_box(shapes(plot)).left);
}

static size_t frame_of(const ZpPlot *plot, size_t k) {
  return zp_plot_frame_at(shapes(plot), (double)k / (SNAPSHOTS - 1));
}

/* One index per snapshot. */
static void data_film(const ZpPlot *plot, FILE *file) {
  const ZpPlotSide left = {.sign = 1};
  fputs("# x_m y_upper_m y_lower_m where there is liquid, of the left half; one index per snapshot\n", file);
  for (size_t k = 0; k < SNAPSHOTS; k++) {
    if (k > 0 && frame_of(plot, k) == frame_of(plot, k - 1)) continue;
    const ZpShape shape = zp_shapes_get(shapes(plot), frame_of(plot, k));
    zp_plot_put_liquid(plot, file, &shape, &left);
    fputs("\n\n", file);
  }
}

static void define_film(const ZpPlot *plot, FILE *file) {
  const ZpPlotBox box = zp_plot_box(shapes(plot));
  size_t count = 0, frame[SNAPSHOTS] = {0};
  for (size_t k = 0; k < SNAPSHOTS; k++)
    if (k == 0 || frame_of(plot, k) != frame_of(plot, k - 1)) frame[count++] = k;
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_key(plot, file, "film.roughness");
  zp_plot_define_count(file, "bead", zp_plot_has_bead(plot));
  zp_plot_define_box(file, &box);
  zp_plot_define_array(file, "now", count);
  zp_plot_define_array(file, "part", count);
  for (size_t i = 0; i < count; i++) {
    zp_plot_define(file, zp_plot_entry("now", i + 1).text, zp_shapes_get(shapes(plot), frame_of(plot, frame[i])).time);
    zp_plot_define(file, zp_plot_entry("part", i + 1).text, (double)frame[i] / (SNAPSHOTS - 1));
  }
  zp_plot_define(file, "end", zp_shapes_get(shapes(plot), shapes(plot)->frames - 1).time);
}

const ZpPicture zp_liquid_pictures[] = {
    {"film", "svg", has_film, define_film, data_film, "film.gp"},
    {0},
};
