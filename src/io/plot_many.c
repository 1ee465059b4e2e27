/* Pictures of many cases at once: parallel.svg, an axis for each key and each answer and a line for each case;
 * pareto.svg, the objectives of an optimisation against each other, with the front. */
#include <math.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"

/* Axes of a picture; lines: more hide each other. */
enum { AXES_MOST = 12, LINES_MOST = 400 };

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

/* The unit of an output; none of a pure number. */
static const char *unit_of(const ZpPlot *plot, const char *output) {
  const ZpResult *result = zp_report_result(plot->report, 0);
  const char *unit = "1";
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, output) == 0) unit = result->scalar[i].unit;
  return strcmp(unit, "1") == 0 || strcmp(unit, "count") == 0 ? "" : unit;
}

/* "mass" of mass_kg, whose unit is kg. */
static void name_output(const char *output, const char *unit, char *words, size_t size) {
  snprintf(words, size, "%.90s", output);
  char *last = strrchr(words, '_');
  if (*unit && last) *last = 0;
  for (char *c = words; *c; c++)
    if (*c == '_') *c = ' ';
}

/* An axis k: axis_name[k], axis_low[k], axis_high[k]; of an output its unit, axis_si[k], of a key, whose values are in
 * the unit of its name, none. */
static void define_axis(const ZpPlot *plot, FILE *file, const Axis *axis, size_t k) {
  const char *unit = axis->output ? unit_of(plot, axis->output) : "";
  char name[128];
  if (axis->output)
    name_output(axis->output, unit, name, sizeof name);
  else
    zp_sweep_label(axis->key, name, sizeof name);
  zp_plot_define_text(file, zp_plot_entry("axis_name", k).text, name);
  zp_plot_define_text(file, zp_plot_entry("axis_si", k).text, unit);
  zp_plot_define(file, zp_plot_entry("axis_low", k).text, axis->low);
  zp_plot_define(file, zp_plot_entry("axis_high", k).text, axis->high);
}

static void define_parallel(const ZpPlot *plot, FILE *file) {
  const Many many = look(plot);
  zp_plot_define_count(file, "cases", plot->report->count);
  zp_plot_define_count(file, "objectives", plot->report->optimum ? plot->report->optimum->objectives : 0);
  zp_plot_define_count(file, "colour_axis", many.colour + 1);
  zp_plot_define_array(file, "axis_name", many.axes);
  zp_plot_define_array(file, "axis_si", many.axes);
  zp_plot_define_array(file, "axis_low", many.axes);
  zp_plot_define_array(file, "axis_high", many.axes);
  for (size_t i = 0; i < many.axes; i++)
    define_axis(plot, file, &many.axis[i], i + 1);
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

static void define_objective(const ZpPlot *plot, FILE *file, size_t k) {
  const char *output = plot->report->optimum->objective[k], *unit = unit_of(plot, output);
  double largest = 0;
  char words[128];
  name_output(output, unit, words, sizeof words);
  for (size_t run = 0; run < plot->report->count; run++)
    largest = fmax(largest, fabs(objective(plot, run, k)));
  zp_plot_define_text(file, zp_plot_entry("objective", k + 1).text, words);
  zp_plot_define_text(file, zp_plot_entry("si", k + 1).text, unit);
  zp_plot_define(file, zp_plot_entry("largest_value", k + 1).text, largest);
}

static void define_pareto(const ZpPlot *plot, FILE *file) {
  zp_plot_define_count(file, "cases", plot->report->count);
  zp_plot_define_count(file, "best", plot->report->optimum->count);
  zp_plot_define_count(file, "objectives", plot->report->optimum->objectives);
  zp_plot_define_array(file, "objective", 2);
  zp_plot_define_array(file, "si", 2);
  zp_plot_define_array(file, "largest_value", 2);
  for (size_t k = 0; k < 2; k++)
    define_objective(plot, file, k);
}

const ZpPicture zp_many_pictures[] = {
    {"parallel", "svg", has_parallel, define_parallel, data_parallel, "parallel.gp"},
    {"pareto", "svg", has_pareto, define_pareto, data_pareto, "pareto.gp"},
    {0},
};
