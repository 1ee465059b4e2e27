/* Pictures of the shapes of one run: profiles.svg and animation.gif. */
#include <math.h>
#include <stdlib.h>

#include "io/number.h"
#include "io/plot.h"

/* Curves of profiles.svg, as many as can be told apart. */
#define SNAPSHOTS 8

/* The film: frames at most, hundredths of a second that it takes, and how often the last is repeated. */
#define FILM_FRAMES 80
#define FILM_LENGTH 480
#define FILM_HOLD   12

static const ZpShapes *film(const ZpPlot *plot) {
  return plot->single->shapes;
}

static double time_of(const ZpShapes *shapes, size_t frame) {
  return zp_shapes_get(shapes, frame).time;
}

static bool has_shapes(const ZpPlot *plot) {
  if (plot->shows != ZP_SHOWS_motion || !plot->single || !plot->single->shapes) return false;
  return film(plot)->frames >= 2 && isfinite(zp_plot_box(film(plot)).left);
}

/* Shapes along the voltage, whose time is the number of the state. */
static bool is_path(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_branch || plot->shows == ZP_SHOWS_held_branch;
}

/* The platform is held, no load hangs on it. */
static bool is_held(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_held_branch;
}

static bool has_animation(const ZpPlot *plot) {
  if (!plot->def.output.animation) return false;
  if (!is_path(plot)) return has_shapes(plot);
  if (!plot->single || !film(plot) || plot->def.drive.voltage <= 0) return false;
  return film(plot)->frames >= 2 && isfinite(zp_plot_box(film(plot)).left);
}

/* Blocks of x, y, time: one per snapshot and ribbon. */
static void data_profiles(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = film(plot);
  size_t before = shapes->frames;
  fputs("# x_m y_m time_s; NaN between the lines of each snapshot and ribbon (upper, lower)\n", file);
  for (size_t k = 0; k < SNAPSHOTS; k++) {
    size_t frame = zp_plot_frame_at(shapes, (double)k / (SNAPSHOTS - 1));
    if (frame == before) continue;
    before = frame;
    const ZpShape shape = zp_shapes_get(shapes, frame);
    zp_plot_put_shape(file, shapes, &shape, shape.time);
  }
}

static void define_profiles(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = film(plot);
  const ZpPlotBox box = zp_plot_box(shapes);
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_count(file, "half", zp_plot_is_half(plot));
  zp_plot_define_count(file, "ribbons", shapes->ribbons);
  zp_plot_define_box(file, &box);
  zp_plot_define(file, "begin", time_of(shapes, 0));
  zp_plot_define(file, "end", time_of(shapes, shapes->frames - 1));
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
  double delay;  /* of a frame, hundredths of a second, whole */
} Stage;

static Stage stage_of(const ZpPlot *plot) {
  const ZpShapes *shapes = film(plot);
  Stage s = {.box = zp_plot_box(shapes)};
  s.middle = (s.box.left + s.box.right) / 2;
  if (has_platform(plot)) s.middle = zp_shapes_get(shapes, 0).x[load_node(plot)] + plot->def.platform.length / 2;
  s.half = fmax(s.middle - s.box.left, s.box.right - s.middle);
  s.clamp = zp_shapes_get(shapes, 0).x[0] - s.middle;
  s.frames = shapes->frames < FILM_FRAMES ? shapes->frames : FILM_FRAMES;
  s.delay = fmin(fmax(round(FILM_LENGTH / (double)s.frames), 2), 40);
  return s;
}

static size_t film_frame(const ZpShapes *shapes, const Stage *stage, size_t index) {
  return zp_plot_frame_at(shapes, (double)index / (double)(stage->frames - 1));
}

static void put_node(FILE *file, const ZpShape *shape, const ZpShapes *shapes, const Stage *stage, size_t node,
                     double side) {
  for (size_t r = 0; r < shapes->ribbons; r++) {
    zp_plot_put(file, side * (shape->x[node * shapes->ribbons + r] - stage->middle), ' ');
    zp_plot_put(file, shape->y[node * shapes->ribbons + r], r + 1 < shapes->ribbons ? ' ' : '\n');
  }
}

/* All nodes of a member from clip to clip, and a blank line. */
static void put_member(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Stage *stage, size_t member) {
  const ZpShapes *shapes = film(plot);
  size_t nodes = shapes->nodes / shapes->members, first = member * nodes;
  for (size_t i = first; i < first + nodes; i++)
    put_node(file, shape, shapes, stage, i, 1);
  for (size_t i = first + nodes; zp_plot_is_half(plot) && i-- > first;)
    put_node(file, shape, shapes, stage, i, -1);
  fputc('\n', file);
}

/* Of one frame where a bead is: a block of the left half, one of the right. */
static void put_beads(const ZpPlot *plot, FILE *file, const ZpShape *shape, const Stage *stage) {
  const bool half = zp_plot_is_half(plot);
  zp_plot_put_liquid(plot, file, shape, &(ZpPlotSide){stage->middle, 1, false});
  fputc('\n', file);
  zp_plot_put_liquid(plot, file, shape, &(ZpPlotSide){stage->middle, half ? -1 : 1, !half});
  fputs("\n\n", file);
}

/* One index per frame: all nodes, of the left half then those of its mirror image. Of a bead one more. */
static void data_animation(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = film(plot);
  const Stage stage = stage_of(plot);
  fputs(shapes->ribbons > 1 ? "# x_upper_m y_upper_m x_lower_m y_lower_m, from the middle; one index per frame\n"
                            : "# x_m y_m, from the middle; one index per frame\n",
        file);
  if (zp_plot_has_bead(plot)) fputs("# and after it one of x_m y_upper_m y_lower_m where its beads are\n", file);
  for (size_t k = 0; k < stage.frames; k++) {
    const ZpShape shape = zp_shapes_get(shapes, film_frame(shapes, &stage, k));
    for (size_t member = 0; member < shapes->members; member++)
      put_member(plot, file, &shape, &stage, member);
    fputc('\n', file);
    if (zp_plot_has_bead(plot)) put_beads(plot, file, &shape, &stage);
  }
}

/* What the caption of a frame says. */
typedef enum Caption {
  CAPTION_TIME,
  CAPTION_VOLTAGE,
  CAPTION_CONTRACTION,
  CAPTION_STROKE,
  CAPTION_END_X,
  CAPTION_END_Y
} Caption;

static double caption_value(const ZpPlot *plot, Caption what, const ZpShape *shape) {
  const size_t end = load_node(plot);
  switch (what) {
  case CAPTION_TIME:
    return shape->time;
  case CAPTION_VOLTAGE:
    return shape->voltage;
  case CAPTION_CONTRACTION:
    return zp_plot_at_time(plot->single->series, "contraction", shape->time);
  case CAPTION_STROKE:
    return is_path(plot) ? shape->y[0] - shape->y[end] : zp_plot_at_time(plot->single->series, "stroke_m", shape->time);
  case CAPTION_END_X:
    return shape->x[end];
  default:
    return shape->y[end];
  }
}

static void put_array(const ZpPlot *plot, FILE *file, const Stage *stage, const char *name, Caption what) {
  fprintf(file, "array %s[%zu] = [", name, stage->frames);
  for (size_t k = 0; k < stage->frames; k++) {
    const ZpShape shape = zp_shapes_get(film(plot), film_frame(film(plot), stage, k));
    double value = caption_value(plot, what, &shape);
    char text[ZP_NUMBER_SIZE];
    zp_number_print(value, text, sizeof text);
    fprintf(file, "%s%s", k ? ", " : "", isfinite(value) ? text : "NaN");
  }
  fputs("]\n", file);
}

/* What is drawn of the actuator: its ends, its platform and what hangs on it. */
static void define_stage(const ZpPlot *plot, FILE *file, const Stage *stage) {
  char load[64];
  zp_value_print(zp_key_find("load.mass"), plot->def.load.mass, load, sizeof load);
  zp_plot_define_text(file, "load", load);
  zp_plot_define_key(plot, file, "load.mass");
  zp_plot_define_key(plot, file, "platform.length");
  zp_plot_define_count(file, "ribbons", film(plot)->ribbons);
  zp_plot_define_count(file, "members", film(plot)->members);
  zp_plot_define_count(file, "has_platform", has_platform(plot));
  zp_plot_define_count(file, "held", is_held(plot));
  zp_plot_define_count(file, "bead", zp_plot_has_bead(plot));
  zp_plot_define_count(file, "bath", zp_plot_has_liquid(plot) && zp_def_liquid(&plot->def) != ZP_LIQUID_BEAD);
  zp_plot_define_count(file, "platform_point",
                       (zp_plot_is_half(plot) ? 2 : 1) * film(plot)->nodes / film(plot)->members - 1);
  zp_plot_define_box(file, &stage->box);
  zp_plot_define(file, "middle", stage->middle);
  zp_plot_define(file, "reach", stage->half);
  zp_plot_define(file, "clamp", stage->clamp);
}

/* What the field between the faces follows from, and the layers that the lens shows. */
static void define_field(const ZpPlot *plot, FILE *file) {
  static const char *const keys[] = {"actuator.kind",          "platform.electrode",     "ribbon.thickness",
                                     "insulator.thickness",    "insulator.permittivity", "medium.permittivity",
                                     "medium.breakdown_field", "electro.breakdown_cap",  "electro.insulator_offset"};
  for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
    zp_plot_define_key(plot, file, keys[k]);
}

/* How the film goes. */
static void define_animation(const ZpPlot *plot, FILE *file) {
  const Stage stage = stage_of(plot);
  const ZpShapes *shapes = film(plot);
  const bool path = is_path(plot);
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_count(file, "path", path);
  zp_plot_define_count(file, "contracts", !path && zp_plot_has(plot->single->series, "contraction"));
  zp_plot_define_count(file, "strokes", !path && zp_plot_has(plot->single->series, "stroke_m"));
  zp_plot_define_key(plot, file, "drive.voltage");
  zp_plot_define_count(file, "frames", stage.frames);
  zp_plot_define_count(file, "hold", FILM_HOLD);
  zp_plot_define(file, "delay", stage.delay);
  zp_plot_define(file, "begin", time_of(shapes, 0));
  zp_plot_define(file, "end", time_of(shapes, shapes->frames - 1));
  define_stage(plot, file, &stage);
  define_field(plot, file);
  put_array(plot, file, &stage, "now", CAPTION_TIME);
  put_array(plot, file, &stage, "potential", CAPTION_VOLTAGE);
  put_array(plot, file, &stage, "contraction", CAPTION_CONTRACTION);
  put_array(plot, file, &stage, "stroke", CAPTION_STROKE);
  put_array(plot, file, &stage, "end_x", CAPTION_END_X);
  put_array(plot, file, &stage, "end_y", CAPTION_END_Y);
}

const ZpPicture zp_shape_pictures[] = {
    {"profiles", "svg", has_shapes, define_profiles, data_profiles, "profiles.gp"},
    {"animation", "gif", has_animation, define_animation, data_animation, "animation.gp"},
    {0},
};
