/* Pictures of many cases at once: parallel.svg, an axis for each key and each answer and a line for each case;
 * pareto.svg, the objectives of an optimisation against each other, with the front. */
#include <math.h>
#include <string.h>

#include "io/plot.h"
#include "io/sampled.h"

/* Axes of a picture; lines: more hide each other. */
enum { AXES_MOST = 12, LINES_MOST = 400 };

/* A column of the table: a list key, or an output where `key` is -1. */
typedef struct Axis {
  int key;
  size_t column;
  ZpPlotRange range; /* of all cases; NAN where none has a value */
} Axis;

typedef struct Many {
  Axis axis[AXES_MOST];
  size_t axes;
  size_t colour; /* axis that says the colour */
} Many;

static double value_at(const ZpPlot *plot, const Axis *axis, size_t run) {
  return plot->table->value[run * plot->table->columns + axis->column];
}

/* Columns that are the same in all cases are left out. */
static void add_axis(const ZpPlot *plot, Many *many, int key, size_t column) {
  if (many->axes == AXES_MOST || column >= plot->table->columns) return;
  const Axis axis = {key, column, zp_plot_range(plot->table, plot->table->column[column].name)};
  if (axis.range.high > axis.range.low) many->axis[many->axes++] = axis;
}

/* Names of the outputs that are drawn: objectives, else the answers of the study => how many. */
static size_t outputs_of(const ZpPlot *plot, const char *output[AXES_MOST]) {
  const ZpOptimum *optimum = plot->report->optimum;
  const ZpAnswer *a = plot->answer;
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
    add_axis(plot, &many, key[i], i);
  many.colour = many.axes;
  const size_t outputs = outputs_of(plot, output);
  for (size_t i = 0; i < outputs; i++)
    add_axis(plot, &many, -1, zp_plot_column(plot->table, output[i]));
  return many;
}

/* Three keys at least, or two that are drawn or optimised, and an output, which determines the colour. */
static bool has_parallel(const ZpPlot *plot) {
  if (plot->report->count < 3) return false;
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
    zp_plot_put(file, (value_at(plot, axis, run) - axis->range.low) / (axis->range.high - axis->range.low), ' ');
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

/* NAME_name[k] and NAME_unit[k] of an output: "mass" and "kg" of mass_kg; a pure number has no unit. */
static void define_output(const ZpPlot *plot, FILE *file, const char *name, size_t k, size_t column) {
  const char *unit = plot->table->column[column].unit;
  const bool pure = strcmp(unit, "1") == 0 || strcmp(unit, "count") == 0;
  char words[128], variable[32];
  snprintf(words, sizeof words, "%.90s", plot->table->column[column].name);
  char *last = strrchr(words, '_');
  if (!pure && last) *last = 0;
  for (char *c = words; *c; c++)
    if (*c == '_') *c = ' ';
  snprintf(variable, sizeof variable, "%s_name", name);
  zp_plot_define_text(file, zp_plot_entry(variable, k).text, words);
  snprintf(variable, sizeof variable, "%s_si", name);
  zp_plot_define_word(file, zp_plot_entry(variable, k).text, pure ? "" : unit);
}

/* An axis k: axis_name[k], axis_low[k], axis_high[k] in SI; of an output its unit, axis_si[k]; of a key axis_unit[k],
 * in which it is shown, and axis_factor[k]. */
static void define_axis(const ZpPlot *plot, FILE *file, const Axis *axis, size_t k) {
  zp_plot_define_word(file, zp_plot_entry("axis_si", k).text, "");
  zp_plot_define_word(file, zp_plot_entry("axis_unit", k).text, "");
  zp_plot_define(file, zp_plot_entry("axis_factor", k).text, 1);
  if (axis->key < 0)
    define_output(plot, file, "axis", k, axis->column);
  else
    zp_plot_define_key_axis(file, "axis", k, axis->key);
  zp_plot_define(file, zp_plot_entry("axis_low", k).text, axis->range.low);
  zp_plot_define(file, zp_plot_entry("axis_high", k).text, axis->range.high);
}

static void define_parallel(const ZpPlot *plot, FILE *file) {
  static const char *const array[] = {"axis_name", "axis_si", "axis_unit", "axis_factor", "axis_low", "axis_high"};
  const Many many = look(plot);
  zp_plot_define_count(file, "objectives", plot->report->optimum ? plot->report->optimum->objectives : 0);
  zp_plot_define_count(file, "colour_axis", many.colour + 1);
  for (size_t i = 0; i < sizeof array / sizeof array[0]; i++)
    zp_plot_define_array(file, array[i], many.axes);
  for (size_t i = 0; i < many.axes; i++)
    define_axis(plot, file, &many.axis[i], i + 1);
}

/* -- pareto ----------------------------------------------------------------------------------------- */

static bool has_pareto(const ZpPlot *plot) {
  const ZpOptimum *optimum = plot->report->optimum;
  return optimum && optimum->objectives > 1 && optimum->count > 1;
}

/* The columns of the first two objectives; the rows on the front, in its order. */
static void define_pareto(const ZpPlot *plot, FILE *file) {
  static const char *const array[] = {"objective", "objective_name", "objective_si"};
  const ZpOptimum *optimum = plot->report->optimum;
  zp_plot_define_count(file, "objectives", optimum->objectives);
  for (size_t i = 0; i < sizeof array / sizeof array[0]; i++)
    zp_plot_define_array(file, array[i], 2);
  for (size_t k = 1; k <= 2; k++) {
    const char *name = optimum->objective[k - 1];
    zp_plot_define_word(file, zp_plot_entry("objective", k).text, name);
    define_output(plot, file, "objective", k, zp_plot_column(plot->table, name));
  }
  zp_plot_define_array(file, "front", optimum->count);
  for (size_t i = 0; i < optimum->count; i++)
    zp_plot_define_count(file, zp_plot_entry("front", i + 1).text, optimum->row[i]);
}

const ZpPicture zp_many_pictures[] = {
    {"parallel", "svg", "parallel.gp", .many = ZP_OF_ANY, .has = has_parallel, .define = define_parallel,
     .data = data_parallel},
    {"pareto", "svg", "pareto.gp", .many = ZP_OF_ANY, .has = has_pareto, .define = define_pareto},
    {0},
};
