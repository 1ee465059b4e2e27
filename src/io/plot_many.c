/* Pictures of many cases at once: parallel.svg, an axis for each key and each answer and a line for each case;
 * pareto.svg, the objectives of an optimisation against each other, with the front. */
#include <math.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"

/* Axes of a picture; lines: more hide each other. */
enum { AXES_MOST = 12, LINES_MOST = 400 };

/* Right edge of the plot area. */
#define RIGHT 0.80

/* A key, or an output where `key` is -1. */
typedef struct Axis {
  int key;
  const char *output;
  double low, high; /* of all cases; NAN where none has a value */
} Axis;

typedef struct Many {
  Axis axis[AXES_MOST];
  size_t axes;
  size_t colour; /* axis that says the colour */
} Many;

static double value_at(const ZpPlot *plot, const Axis *axis, size_t run) {
  if (axis->output) return zp_result_get(zp_report_result(plot->report, run), axis->output);
  return zp_sweep_value(plot, run, axis->key) * zp_sweep_factor(axis->key);
}

static void add_axis(const ZpPlot *plot, Many *many, Axis axis) {
  if (many->axes == AXES_MOST) return;
  axis.low = axis.high = NAN;
  for (size_t run = 0; run < plot->report->count; run++) {
    axis.low = fmin(axis.low, value_at(plot, &axis, run));
    axis.high = fmax(axis.high, value_at(plot, &axis, run));
  }
  if (axis.high > axis.low) many->axis[many->axes++] = axis;
}

/* Names of the outputs that are drawn: objectives, else the answers of the study => how many. */
static size_t outputs_of(const ZpPlot *plot, const char *output[AXES_MOST]) {
  const ZpOptimum *optimum = plot->report->optimum;
  const ZpAnswer *a = zp_sweep_answer(plot);
  size_t count = 0;
  for (size_t i = 0; optimum && i < optimum->objectives; i++)
    output[count++] = optimum->objective[i];
  for (size_t i = 0; !optimum && a && i < 2; i++)
    if (a->scalar[i]) output[count++] = a->scalar[i];
  return count;
}

static Many look(const ZpPlot *plot) {
  const char *output[AXES_MOST];
  Many many = {.axes = 0};
  size_t keys;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  for (size_t i = 0; i < keys; i++)
    add_axis(plot, &many, (Axis){.key = key[i]});
  many.colour = many.axes;
  const size_t outputs = outputs_of(plot, output);
  for (size_t i = 0; i < outputs; i++)
    add_axis(plot, &many, (Axis){.key = -1, .output = output[i]});
  return many;
}

/* Of three keys at least, or of two that are drawn or optimised; with an output, which says the colour. */
static bool has_parallel(const ZpPlot *plot) {
  if (plot->single || plot->report->count < 3) return false;
  const bool chosen = plot->report->optimum || zp_scenario_design(plot->report->scenario);
  const Many many = look(plot);
  return many.colour >= (chosen ? 2 : 3) && many.colour < many.axes;
}

static bool is_best(const ZpPlot *plot, size_t run) {
  const ZpOptimum *optimum = plot->report->optimum;
  for (size_t i = 0; optimum && i < optimum->count; i++)
    if (optimum->row[i] == run) return true;
  return false;
}

/* A line of a case: axis, place on it, colour; a blank line behind it. A case that lacks a value has none. */
static void put_line(const ZpPlot *plot, FILE *file, const Many *many, size_t run) {
  for (size_t i = 0; i < many->axes; i++)
    if (!isfinite(value_at(plot, &many->axis[i], run))) return;
  for (size_t i = 0; i < many->axes; i++) {
    const Axis *axis = &many->axis[i];
    fprintf(file, "%zu ", i);
    zp_plot_put(file, (value_at(plot, axis, run) - axis->low) / (axis->high - axis->low), ' ');
    zp_plot_put(file, value_at(plot, &many->axis[many->colour], run), '\n');
  }
  fputc('\n', file);
}

/* Two indices: all cases, evenly chosen where there are many; the best. */
static void data_parallel(const ZpPlot *plot, FILE *file) {
  const Many many = look(plot);
  const size_t step = (plot->report->count + LINES_MOST - 1) / LINES_MOST;
  fputs("# axis, place on it from 0 to 1, value on the first axis of an output; a block per case\n", file);
  for (size_t run = 0; run < plot->report->count; run += step)
    put_line(plot, file, &many, run);
  fputs("\n", file);
  for (size_t run = 0; plot->report->optimum && run < plot->report->count; run++)
    if (is_best(plot, run)) put_line(plot, file, &many, run);
}

/* "max_load_kg", or "ribbon.thickness / um". */
static void put_name(FILE *file, const Axis *axis) {
  if (axis->output)
    zp_plot_text(file, axis->output);
  else
    zp_sweep_label(file, axis->key);
}

/* Names below, ends of the ranges at both ends, every second name lower so that they do not meet. */
static void put_axes(FILE *file, const Many *many) {
  fputs("unset grid\nunset xtics\nunset ytics\nset border 0\nset yrange [-0.02:1.02]\n", file);
  fprintf(file, "set xrange [-0.15:%g]\n", (double)many->axes - 0.85);
  for (size_t i = 0; i < many->axes; i++) {
    const Axis *axis = &many->axis[i];
    fprintf(file,
            "set arrow %zu from %zu,0 to %zu,1 nohead lw 1.2 lc rgb '#333333' front\n"
            "set label %zu '%.4g' at %zu,1 center offset 0,0.7 font ',11'\n"
            "set label %zu '%.4g' at %zu,0 center offset 0,-0.7 font ',11'\nset label %zu ",
            i + 10, i, i, 3 * i + 10, axis->high, i, 3 * i + 11, axis->low, i, 3 * i + 12);
    put_name(file, axis);
    fprintf(file, " at %zu,0 center offset 0,%g font ',11'\n", i, i % 2 ? -3.2 : -2);
  }
}

static void put_palette(FILE *file) {
  enum { STEPS = 4 };
  fputs("set palette defined (", file);
  for (int i = 0; i <= STEPS; i++)
    fprintf(file, "%s%d '#%06x'", i ? ", " : "", i, zp_plot_shade((double)i / STEPS));
  fputs(")\nset colorbox user origin 0.85,0.2 size 0.025,0.5\n", file);
}

static void script_parallel(const ZpPlot *plot, FILE *file) {
  const Many many = look(plot);
  char remark[96];
  zp_plot_head(plot, file, "parallel", "All cases: a line for each", RIGHT);
  snprintf(remark, sizeof remark, "%zu cases; those without a value on an axis are left out", plot->report->count);
  zp_plot_remark(file, remark);
  put_axes(file, &many);
  put_palette(file);
  fputs("set bmargin at screen 0.20\nset tmargin at screen 0.81\nset cblabel ", file);
  put_name(file, &many.axis[many.colour]);
  fputs(" offset 0.5\nplot 'parallel.dat' index 0 using 1:2:3 with lines lw 0.8 lc palette notitle", file);
  if (plot->report->optimum)
    fprintf(file, ", \\\n     '' index 1 using 1:2 with lines lw 3 lc rgb '%s' title '%s'", zp_plot_colour(1),
            plot->report->optimum->objectives > 1 ? "front" : "best");
  fputc('\n', file);
}

/* -- pareto ----------------------------------------------------------------------------------------- */

static bool has_pareto(const ZpPlot *plot) {
  const ZpOptimum *optimum = plot->report->optimum;
  return optimum && optimum->objectives > 1 && optimum->count > 1;
}

static double objective(const ZpPlot *plot, size_t run, size_t k) {
  return zp_result_get(zp_report_result(plot->report, run), plot->report->optimum->objective[k]);
}

static void put_objectives(const ZpPlot *plot, FILE *file, size_t run) {
  zp_plot_put(file, objective(plot, run, 0), ' ');
  zp_plot_put(file, objective(plot, run, 1), '\n');
}

/* Two indices: all cases; the front, in its order. */
static void data_pareto(const ZpPlot *plot, FILE *file) {
  const ZpOptimum *optimum = plot->report->optimum;
  fprintf(file, "# %s %s\n", optimum->objective[0], optimum->objective[1]);
  for (size_t run = 0; run < plot->report->count; run++)
    put_objectives(plot, file, run);
  fputs("\n\n", file);
  for (size_t i = 0; i < optimum->count; i++)
    put_objectives(plot, file, optimum->row[i]);
}

/* The unit of an objective over all cases; without one, of a pure number. */
static ZpPlotUnit unit_of(const ZpPlot *plot, size_t k) {
  const ZpResult *result = zp_report_result(plot->report, 0);
  const char *unit = "1";
  double largest = 0;
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, plot->report->optimum->objective[k]) == 0) unit = result->scalar[i].unit;
  for (size_t run = 0; run < plot->report->count; run++)
    largest = fmax(largest, fabs(objective(plot, run, k)));
  if (strcmp(unit, "1") == 0 || strcmp(unit, "count") == 0) return (ZpPlotUnit){.factor = 1};
  return zp_plot_unit(largest, unit);
}

/* "mass / g" of mass_kg. */
static void put_label(FILE *file, const char *output, const ZpPlotUnit *unit) {
  char label[128];
  snprintf(label, sizeof label, "%.90s", output);
  char *last = strrchr(label, '_');
  if (*unit->text && last) *last = 0;
  for (char *c = label; *c; c++)
    if (*c == '_') *c = ' ';
  const size_t used = strlen(label);
  snprintf(label + used, sizeof label - used, "%s%s", *unit->text ? " / " : "", unit->text);
  zp_plot_text(file, label);
}

static void script_pareto(const ZpPlot *plot, FILE *file) {
  const ZpOptimum *optimum = plot->report->optimum;
  const ZpPlotUnit x = unit_of(plot, 0), y = unit_of(plot, 1);
  char remark[128];
  zp_plot_head(plot, file, "pareto", "Pareto front", RIGHT);
  snprintf(remark, sizeof remark, "%zu of %zu cases are on the front; others are worse, or miss a constraint",
           optimum->count, plot->report->count);
  zp_plot_remark(file, remark);
  fputs("set xlabel ", file);
  put_label(file, optimum->objective[0], &x);
  fputs("\nset ylabel ", file);
  put_label(file, optimum->objective[1], &y);
  fprintf(
      file,
      " offset 0.5\nset offsets graph 0.03, graph 0.03, graph 0.05, graph 0.03\n"
      "plot 'pareto.dat' index 0 using ($1*%g):($2*%g) with points pt 7 ps 0.4 lc rgb '#999999' title 'others', \\\n"
      "     '' index 1 using ($1*%g):($2*%g) with %s lw 2 pt 7 ps 0.8 lc rgb '%s' title 'front'\n",
      x.factor, y.factor, x.factor, y.factor, optimum->objectives == 2 ? "linespoints" : "points", zp_plot_colour(1));
}

const ZpPicture zp_many_pictures[] = {
    {"parallel", "svg", has_parallel, script_parallel, data_parallel},
    {"pareto", "svg", has_pareto, script_pareto, data_pareto},
    {0},
};
