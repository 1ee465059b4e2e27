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

static void script_profiles(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = film(plot);
  const ZpPlotBox box = zp_plot_box(shapes);
  const bool tall = zp_plot_fits_same_scale(&box);
  ZpPlotUnit length = zp_plot_box_unit(&box);
  ZpPlotUnit time = zp_plot_unit(time_of(shapes, shapes->frames - 1), "s");
  zp_plot_head_of_shapes(plot, file, "profiles", shapes->ribbons > 1 ? "Shapes of the ribbons" : "Shapes of the ribbon",
                         0.82);
  zp_plot_foot(plot, file, tall ? NULL : "x and y have different scales");
  fprintf(file,
          "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#c8d020')\n"
          "set cblabel 'time / %s' offset 0.5\nset cbrange [%.17g:%.17g]\n"
          "set colorbox user origin screen 0.85, screen 0.17 size screen 0.025, screen 0.69\n"
          "set xlabel 'x / %s'\nset ylabel 'y / %s' offset 0.5\n",
          time.text, time_of(shapes, 0) * time.factor, time_of(shapes, shapes->frames - 1) * time.factor, length.text,
          length.text);
  if (tall) fputs("set size ratio -1\n", file);
  fprintf(file,
          "set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04\n"
          "plot 'profiles.dat' using ($1*%g):($2*%g):($3*%g) with lines lw 2 lc palette z notitle\n",
          length.factor, length.factor, time.factor);
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
  double unit;   /* a length to size clip, load and margins with */
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
  s.unit = 0.1 * s.half;
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

/* "slowed down 60 times": how the time of the film goes. */
static void print_pace(const ZpPlot *plot, const Stage *stage, char *text, size_t size) {
  const ZpShapes *shapes = film(plot);
  double span = time_of(shapes, shapes->frames - 1) - time_of(shapes, 0);
  double factor = stage->delay / 100 * (double)(stage->frames - 1) / span;
  if (is_path(plot))
    snprintf(text, size, "states of rest one after the other, stable or not");
  else if (!isfinite(factor))
    snprintf(text, size, "still picture");
  else if (factor >= 1)
    snprintf(text, size, "slow motion, %.3g times slower than real", factor);
  else
    snprintf(text, size, "fast motion, %.3g times faster than real", 1 / factor);
}

static void animation_head(const ZpPlot *plot, FILE *file, const Stage *s, ZpPlotUnit mm) {
  char pace[96];
  print_pace(plot, s, pace, sizeof pace);
  fprintf(file,
          "# Draw again with: gnuplot animation.gp\n"
          "if (!exists('out')) out = 'animation.gif'\n"
          "set encoding utf8\n"
          "set terminal gif animate delay %g loop 0 size 640,480 noenhanced background '#ffffff'\n"
          "set output out\nunset key\nset grid lc rgb '#dddddd' lw 1 lt 1\nset border lc rgb '#333333'\n"
          "set tics nomirror\nset size ratio -1\nset tmargin 5\nset bmargin 5\n"
          "set xlabel 'x / %s'\nset ylabel 'y / %s'\n"
          "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n",
          s->delay, mm.text, mm.text, -(s->half + 1.8 * s->unit) * mm.factor, (s->half + 1.8 * s->unit) * mm.factor,
          (s->box.bottom - 3 * s->unit) * mm.factor, (s->box.top + 1.2 * s->unit) * mm.factor);
  fputs("set label 2 ", file);
  zp_plot_text(file, plot->subtitle);
  fprintf(file, " at screen 0.5,0.91 center\nset label 3 '%s' at screen 0.5,0.865 center\n", pace);
  if (is_path(plot)) return;
  fputs("set label 4 ", file);
  zp_plot_text(file, zp_plot_drag_note(plot));
  fputs(" at screen 0.5,0.025 center font ',10' tc rgb '#555555'\n", file);
}

/* Clip and holder, which stay where they are, or a wall for other kinds. */
static void animation_scene(const ZpPlot *plot, FILE *file, const Stage *s, ZpPlotUnit mm) {
  const double plat = plot->def.platform.length / 2, thick = 0.35 * s->unit;
  if (has_platform(plot))
    fprintf(file,
            "set object 1 rectangle from %.6g,0 to %.6g,%.6g fc rgb '#555555' fs solid noborder\n"
            "set arrow 1 from 0,%.6g to 0,graph 1 nohead lw 3 lc rgb '#555555'\n",
            -plat * mm.factor, plat * mm.factor, thick * mm.factor, thick * mm.factor);
  else
    fprintf(file, "set object 1 rectangle from %.6g,%.6g to %.6g,%.6g fc rgb '#555555' fs solid noborder\n",
            (s->clamp - thick) * mm.factor, -s->unit * mm.factor, s->clamp * mm.factor, s->unit * mm.factor);
}

/* Settings that move with the platform (other kinds: the right end): the platform itself, a string and
 * the load on it. h, v: where the load hangs. */
static void animation_load(const ZpPlot *plot, FILE *file, const Stage *s, ZpPlotUnit mm) {
  const double u = s->unit * mm.factor, plat = plot->def.platform.length / 2 * mm.factor;
  const bool pair = has_platform(plot);
  char load[64];
  if (pair) fputs("  h = 0\n", file);
  if (!pair) fprintf(file, "  h = end_x[i]*%g - %.6g\n", mm.factor, s->middle * mm.factor);
  fprintf(file, "  v = end_y[i]*%g\n", mm.factor);
  if (pair)
    fprintf(file, "  set object 2 rectangle from %.6g,v-%.6g to %.6g,v fc rgb '#555555' fs solid noborder\n", -plat,
            0.35 * u, plat);
  if (is_held(plot)) fputs("  set arrow 2 from h,v to h,graph 0 nohead lw 3 lc rgb '#555555'\n", file);
  if (is_held(plot) || plot->def.load.mass <= 0) return;
  zp_value_print(zp_key_find("load.mass"), plot->def.load.mass, load, sizeof load);
  fprintf(file,
          "  set arrow 2 from h,v to h,v-%.6g nohead lw 2 lc rgb '#555555'\n"
          "  set object 3 rectangle from h-%.6g,v-%.6g to h+%.6g,v-%.6g fc rgb '#e69f00' fs solid noborder\n"
          "  set label 5 '%s' at h,v-%.6g center front\n",
          u, 1.2 * u, 2.6 * u, 1.2 * u, u, load, 1.8 * u);
}

static void path_caption(const ZpPlot *plot, FILE *file, ZpPlotUnit mm) {
  const ZpPlotUnit voltage = zp_plot_unit(plot->def.drive.voltage, "V");
  if (is_held(plot))
    fprintf(file, "  caption = sprintf('%%.2f %s', potential[i]*%g)\n", voltage.text, voltage.factor);
  else
    fprintf(file, "  caption = sprintf('%%.2f %s    stroke %%.2f %s', potential[i]*%g, stroke[i]*%g)\n", voltage.text,
            mm.text, voltage.factor, mm.factor);
  fputs("  set label 1 caption at screen 0.5,0.96 center\n", file);
}

static void animation_caption(const ZpPlot *plot, FILE *file, ZpPlotUnit time, ZpPlotUnit mm) {
  if (is_path(plot)) {
    path_caption(plot, file, mm);
    return;
  }
  fprintf(file, "  caption = sprintf('t = %%.1f %s', now[i]*%g)\n", time.text, time.factor);
  if (zp_plot_has(plot->single->series, "contraction"))
    fputs("  if (contraction[i] == contraction[i]) { caption = caption . sprintf('    contraction %.0f %%', "
          "contraction[i]*100) }\n",
          file);
  else if (zp_plot_has(plot->single->series, "stroke_m"))
    fprintf(file,
            "  if (stroke[i] == stroke[i]) { caption = caption . sprintf('    stroke %%.2f %s', stroke[i]*%g) }\n",
            mm.text, mm.factor);
  if (film(plot)->ribbons > 1) fputs("  caption = caption . sprintf('    %.4g kV', potential[i]/1000)\n", file);
  fputs("  set label 1 caption at screen 0.5,0.96 center\n", file);
}

/* A bath is behind everything. */
static void animation_bath(const ZpPlot *plot, FILE *file) {
  if (!zp_plot_has_liquid(plot) || zp_def_liquid(&plot->def) == ZP_LIQUID_BEAD) return;
  fputs("set object 4 rectangle from graph 0,0 to graph 1,1 behind fc rgb '#e2f1fa' fs solid noborder\n"
        "set label 6 'liquid' at graph 0.02,0.07 front\n",
        file);
}

/* Ribbons over their beads. */
static void plot_frame(const ZpPlot *plot, FILE *file, ZpPlotUnit mm) {
  const ZpShapes *shapes = film(plot);
  const bool bead = zp_plot_has_bead(plot);
  const char *index = bead ? "2*i-2" : "i-1";
  if (bead)
    fprintf(file,
            "  set key bottom left samplen 1.5\n"
            "  plot 'animation.dat' index 2*i-1 using ($1*%g):($2*%g):($3*%g) with filledcurves fc rgb '#56b4e9' "
            "title 'liquid', \\\n    ''",
            mm.factor, mm.factor, mm.factor);
  else
    fputs("  plot 'animation.dat'", file);
  fprintf(file, " index %s using ($1*%g):($2*%g) with lines lw 2 lc rgb '%s' notitle", index, mm.factor, mm.factor,
          zp_plot_colour(0));
  if (shapes->ribbons > 1)
    fprintf(file,
            ", \\\n    '' index %s using ($3*%g):($4*%g) with lines lw 2 lc rgb '%s' notitle"
            ", \\\n    '' index %s every %zu using ($3*%g):($4*%g) with points pt 5 ps 1.5 lc rgb '#555555' notitle",
            index, mm.factor, mm.factor, zp_plot_colour(1), index,
            (zp_plot_is_half(plot) ? 2 : 1) * shapes->nodes / shapes->members - 1, mm.factor, mm.factor);
}

static void script_animation(const ZpPlot *plot, FILE *file) {
  const Stage s = stage_of(plot);
  const ZpShapes *shapes = film(plot);
  ZpPlotUnit mm = zp_plot_unit(s.half, "m"), time = zp_plot_unit(time_of(shapes, shapes->frames - 1), "s");
  animation_head(plot, file, &s, mm);
  animation_scene(plot, file, &s, mm);
  animation_bath(plot, file);
  put_array(plot, file, &s, "now", CAPTION_TIME);
  put_array(plot, file, &s, "potential", CAPTION_VOLTAGE);
  put_array(plot, file, &s, "contraction", CAPTION_CONTRACTION);
  put_array(plot, file, &s, "stroke", CAPTION_STROKE);
  put_array(plot, file, &s, "end_x", CAPTION_END_X);
  put_array(plot, file, &s, "end_y", CAPTION_END_Y);
  fprintf(file, "do for [k=1:%zu] {\n  i = k > %zu ? %zu : k\n", s.frames + FILM_HOLD, s.frames, s.frames);
  animation_caption(plot, file, time, mm);
  animation_load(plot, file, &s, mm);
  plot_frame(plot, file, mm);
  fputs("\n}\n", file);
}

const ZpPicture zp_shape_pictures[] = {
    {"profiles", "svg", has_shapes, script_profiles, data_profiles},
    {"animation", "gif", has_animation, script_animation, data_animation},
    {0},
};
