/* Films of the shapes of one run, animation.gif, and of the liquid between them, film.svg. */
#include <math.h>

#include "io/plot.h"

/* animation.gif: frames at most. */
enum { FILM_FRAMES = 80 };

static const ZpShapes *film(const ZpPlot *plot) {
  return plot->single->shapes;
}

/* -- the liquid ------------------------------------------------------------------------------------ */

/* Is it a run of two ribbons with liquid between them? */
static bool has_liquid(const ZpPlot *plot) {
  if (plot->shows != ZP_SHOWS_motion || !zp_plot_has_frames(plot, 1) || film(plot)->ribbons < 2) return false;
  return zp_def_liquid(&plot->def) != ZP_LIQUID_NONE && zp_plot_has(plot->table, "film_thickness_m");
}

static bool has_bead(const ZpPlot *plot) {
  return has_liquid(plot) && zp_def_liquid(&plot->def) == ZP_LIQUID_BEAD && film(plot)->members == 1;
}

/* Nodes of one ribbon of a half. */
static size_t half_nodes(const ZpPlot *plot) {
  return zp_plot_is_half(plot) ? film(plot)->nodes : film(plot)->nodes / 2;
}

/* How far from its clip liquid wets a half, m. */
static double reach_at(const ZpPlot *plot, double time) {
  return has_bead(plot) ? zp_plot_at_time(plot->table, "wet_length_m", time) : (double)INFINITY;
}

/* How a half is drawn: x counts from `middle` (m), times `sign`; of the whole actuator, from its right end on. */
typedef struct Side {
  double middle, sign;
  bool from_right;
} Side;

/* x and both y at `place` elements from the clip of the left half or of the right one. */
static void put_place(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Side *side, double place) {
  size_t last = half_nodes(plot) - 1, k = place < (double)last ? (size_t)place : last;
  size_t near = side->from_right ? film(plot)->nodes - 1 - k : k;
  size_t far = k == last ? near : side->from_right ? near - 1 : near + 1;
  double part = k == last ? 0 : place - (double)k;
  double x = shape->x[2 * near] + part * (shape->x[2 * far] - shape->x[2 * near]);
  zp_plot_put(file, side->sign * (x - side->middle), ' ');
  for (size_t r = 0; r < 2; r++) {
    double y = shape->y[2 * near + r], beyond = shape->y[2 * far + r];
    zp_plot_put(file, y + part * (beyond - y), r ? '\n' : ' ');
  }
}

/* Lines of x and both y where there is liquid between the ribbons of one half, from its clip on, `parts` an element. */
static void put_liquid(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Side *side, size_t parts) {
  double length = (plot->def.ribbon.length - plot->def.platform.length) / 2, reach = reach_at(plot, shape->time);
  size_t last = half_nodes(plot) - 1;
  double end = fmin(reach / length, 1) * (double)last;
  if (!isfinite(end)) return;
  for (size_t k = 0; (double)k < end * (double)parts; k++)
    put_place(plot, file, shape, side, (double)k / (double)parts);
  put_place(plot, file, shape, side, end);
}

/* Of a bead only where it is known how far it reaches. */
static bool has_film(const ZpPlot *plot) {
  if (!has_liquid(plot) || film(plot)->members > 1 || film(plot)->frames < 2) return false;
  return !has_bead(plot) || zp_plot_has(plot->table, "wet_length_m");
}

/* One index per snapshot. */
static void data_film(const ZpPlot *plot, FILE *file) {
  const Side left = {.sign = 1};
  size_t frame[ZP_PLOT_SNAPSHOTS], count = zp_plot_snapshots(film(plot), frame);
  fputs("# x_m y_upper_m y_lower_m where there is liquid, of the left half; one index per snapshot\n", file);
  for (size_t k = 0; k < count; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), frame[k]);
    put_liquid(plot, file, &shape, &left, 1);
    fputs("\n\n", file);
  }
}

static void define_film(const ZpPlot *plot, FILE *file) {
  size_t frame[ZP_PLOT_SNAPSHOTS], count = zp_plot_snapshots(film(plot), frame);
  zp_plot_define_count(file, "bead", has_bead(plot));
  zp_plot_define_array(file, "now", count);
  for (size_t k = 0; k < count; k++)
    zp_plot_define(file, zp_plot_entry("now", k + 1).text, zp_shapes_get(film(plot), frame[k]).time);
}

/* -- the animation --------------------------------------------------------------------------------- */

/* Shapes along the voltage, whose time is the number of the state. */
static bool is_path(const ZpPlot *plot) {
  return plot->shows != ZP_SHOWS_motion;
}

static bool has_animation(const ZpPlot *plot) {
  return zp_plot_has_frames(plot, 2) && (!is_path(plot) || plot->def.drive.voltage > 0);
}

static bool has_platform(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_ELECTRO_RIBBON;
}

/* The node of the lower ribbon at the platform's left end, or the right end of the lower or only ribbon. */
static size_t load_node(const ZpPlot *plot) {
  const ZpShapes *shapes = film(plot);
  bool whole = has_platform(plot) && !zp_plot_is_half(plot);
  return shapes->ribbons * (whole ? shapes->nodes / 2 : shapes->nodes) - 1;
}

/* The stage of the film: x counts from the middle of what is drawn, m. */
typedef struct Stage {
  ZpPlotBox box; /* of the shapes */
  double middle; /* x of the platform's middle (other kinds: of the middle of the box) */
  double half;   /* half of the width of all that moves */
  double clamp;  /* x of the left end, from the middle */
  size_t frames; /* different ones */
} Stage;

static Stage stage_of(const ZpPlot *plot) {
  const ZpShapes *shapes = film(plot);
  Stage s = {.box = zp_plot_box(shapes)};
  s.middle = (s.box.left + s.box.right) / 2;
  if (has_platform(plot)) s.middle = zp_shapes_get(shapes, 0).x[load_node(plot)] + plot->def.platform.length / 2;
  s.half = fmax(s.middle - s.box.left, s.box.right - s.middle);
  s.clamp = zp_shapes_get(shapes, 0).x[0] - s.middle;
  s.frames = shapes->frames < FILM_FRAMES ? shapes->frames : FILM_FRAMES;
  return s;
}

static size_t film_frame(const ZpShapes *shapes, const Stage *stage, size_t index) {
  return zp_plot_frame_at(shapes, (double)index / (double)(stage->frames - 1));
}

/* Points of a member's ribbons as they are drawn: `parts` an element. */
typedef struct Points {
  size_t first, parts, count; /* its first node; how many points in all */
} Points;

/* Each point of a pair colours a bar of what is between them, 5 pixels wide. So many leave no gaps between the bars. */
static size_t parts_of(const ZpPlot *plot) {
  enum { ELEMENTS = 60 };
  const size_t elements = half_nodes(plot) / film(plot)->members - 1;
  return (ELEMENTS + elements - 1) / elements;
}

static Points points_of(const ZpPlot *plot, size_t member) {
  const size_t nodes = film(plot)->nodes / film(plot)->members, parts = parts_of(plot);
  return (Points){member * nodes, parts, (nodes - 1) * parts + 1};
}

static double between(const double *value, size_t ribbons, const Points *points, size_t i, size_t ribbon) {
  const size_t near = points->first + i / points->parts, far = near + (i % points->parts > 0);
  const double part = (double)(i % points->parts) / (double)points->parts, at = value[near * ribbons + ribbon];
  return at + part * (value[far * ribbons + ribbon] - at);
}

static void put_point(FILE *file, const ZpShape *shape, const Stage *stage, size_t ribbons, const Points *points,
                      size_t i, double side) {
  for (size_t r = 0; r < ribbons; r++) {
    zp_plot_put(file, side * (between(shape->x, ribbons, points, i, r) - stage->middle), ' ');
    zp_plot_put(file, between(shape->y, ribbons, points, i, r), r + 1 < ribbons ? ' ' : '\n');
  }
}

/* A member from clip to clip, and a blank line. */
static void put_member(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Stage *stage, size_t member) {
  const size_t ribbons = film(plot)->ribbons;
  const Points points = points_of(plot, member);
  for (size_t i = 0; i < points.count; i++)
    put_point(file, shape, stage, ribbons, &points, i, 1);
  for (size_t i = points.count; zp_plot_is_half(plot) && i-- > 0;)
    put_point(file, shape, stage, ribbons, &points, i, -1);
  fputc('\n', file);
}

/* Of one frame where a bead is: a block of the left half, one of the right. */
static void put_beads(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Stage *stage) {
  const bool half = zp_plot_is_half(plot);
  put_liquid(plot, file, shape, &(Side){stage->middle, 1, false}, parts_of(plot));
  fputc('\n', file);
  put_liquid(plot, file, shape, &(Side){stage->middle, half ? -1 : 1, !half}, parts_of(plot));
  fputs("\n\n", file);
}

/* One index per frame: points of the left half, then those of its mirror image. Of a bead one more. */
static void data_animation(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = film(plot);
  const Stage stage = stage_of(plot);
  fputs(shapes->ribbons > 1 ? "# x_upper_m y_upper_m x_lower_m y_lower_m, from the middle; one index per frame\n"
                            : "# x_m y_m, from the middle; one index per frame\n",
        file);
  if (has_bead(plot)) fputs("# and after it one of x_m y_upper_m y_lower_m where its beads are\n", file);
  for (size_t k = 0; k < stage.frames; k++) {
    const ZpShape shape = zp_shapes_get(shapes, film_frame(shapes, &stage, k));
    for (size_t member = 0; member < shapes->members; member++)
      put_member(plot, file, &shape, &stage, member);
    fputc('\n', file);
    if (has_bead(plot)) put_beads(plot, file, &shape, &stage);
  }
}

/* What the caption of a frame says, and where its load hangs. */
typedef struct Caption {
  double now, potential, contraction, stroke, end_x, end_y;
} Caption;

static Caption caption_of(const ZpPlot *plot, const ZpShape *shape) {
  const size_t end = load_node(plot);
  Caption c = {shape->time, shape->voltage, NAN, shape->y[0] - shape->y[end], shape->x[end], shape->y[end]};
  if (is_path(plot)) return c;
  c.contraction = zp_plot_at_time(plot->table, "contraction", shape->time);
  c.stroke = zp_plot_at_time(plot->table, "stroke_m", shape->time);
  return c;
}

static void define_captions(const ZpPlot *plot, FILE *file, const Stage *stage) {
  static const char *const name[] = {"now", "potential", "contraction", "stroke", "end_x", "end_y"};
  enum { NAMES = sizeof name / sizeof name[0] };
  for (size_t i = 0; i < NAMES; i++)
    zp_plot_define_array(file, name[i], stage->frames);
  for (size_t k = 0; k < stage->frames; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), film_frame(film(plot), stage, k));
    const Caption c = caption_of(plot, &shape);
    const double value[NAMES] = {c.now, c.potential, c.contraction, c.stroke, c.end_x, c.end_y};
    for (size_t i = 0; i < NAMES; i++)
      zp_plot_define(file, zp_plot_entry(name[i], k + 1).text, value[i]);
  }
}

/* What is drawn of the actuator: its ends, its platform and what hangs on it; and how the film goes. */
static void define_animation(const ZpPlot *plot, FILE *file) {
  const Stage stage = stage_of(plot);
  char load[64];
  zp_plot_print_value(zp_key_find("load.mass"), plot->def.load.mass, load, sizeof load);
  zp_plot_define_text(file, "load", load);
  zp_plot_define_count(file, "path", is_path(plot));
  zp_plot_define_count(file, "has_platform", has_platform(plot));
  zp_plot_define_count(file, "bead", has_bead(plot));
  zp_plot_define_count(file, "field_known", film(plot)->members == 1 || zp_def_liquid(&plot->def) != ZP_LIQUID_BEAD);
  zp_plot_define_count(file, "bath", has_liquid(plot) && zp_def_liquid(&plot->def) != ZP_LIQUID_BEAD);
  zp_plot_define_count(file, "platform_point", (zp_plot_is_half(plot) ? 2 : 1) * points_of(plot, 0).count - 1);
  zp_plot_define(file, "middle", stage.middle);
  zp_plot_define(file, "reach", stage.half);
  zp_plot_define(file, "clamp", stage.clamp);
  zp_plot_define_count(file, "frames", stage.frames);
  define_captions(plot, file, &stage);
}

const ZpPicture zp_film_pictures[] = {
    {"film", "svg", "film.gp", ZP_OF(motion), .has = has_film, .define = define_film, .data = data_film},
    {"animation", "gif", "animation.gp", ZP_OF(motion) | ZP_OF(branch) | ZP_OF(held_branch), .keys = "output.animation",
     .has = has_animation, .define = define_animation, .data = data_animation},
    {0},
};
