/* Writes the definitions (result.gp) and the plain columns from which the templates draw a report. */
#include "io/plot.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/table.h"
#include "def/check.h"
#include "io/number.h"
#include "io/plan.h"
#include "io/units.h"
#include "study/result.h"

/* -- columns --------------------------------------------------------------------------------------- */

/* The key whose column has this name, -1: there is none. */
static int find_key(const ZpPlot *plot, const char *column) {
  size_t lists;
  const int *list = zp_scenario_lists(plot->report->scenario, &lists);
  for (size_t k = 0; k < lists + (size_t)zp_key_count(); k++) {
    const int key = k < lists ? list[k] : (int)(k - lists);
    char name[ZP_KEY_COLUMN_SIZE];
    zp_key_column(plot->report->scenario, key, name, sizeof name);
    if (strcmp(name, column) == 0) return key;
  }
  return -1;
}

/* The columns of table.csv, or of a series. */
static ZpStatus add_columns(ZpPlot *plot, const ZpTable *series, ZpError *err) {
  ZpCases cases;
  const bool open = zp_cases_open(plot->report, series, &cases);
  if (open) plot->column = calloc(cases.columns + 1, sizeof *plot->column);
  for (; plot->column && plot->columns < cases.columns; plot->columns++) {
    const ZpCaseColumn *from = &cases.column[plot->columns];
    ZpPlotColumn column = {.unit = from->unit,
                           .help = series ? from->help : "",
                           .key = find_key(plot, from->name),
                           .low = NAN,
                           .high = NAN};
    memcpy(column.name, from->name, sizeof column.name);
    plot->column[plot->columns] = column;
  }
  for (size_t row = 0; plot->column && row < cases.rows; row++) {
    zp_cases_read(&cases, row);
    for (size_t i = 0; i < plot->columns; i++) {
      ZpPlotColumn *column = &plot->column[i];
      if (!isfinite(cases.value[i])) continue;
      column->low = fmin(column->low, cases.value[i]);
      column->high = fmax(column->high, cases.value[i]);
      column->count++;
    }
  }
  zp_cases_close(&cases);
  return plot->column ? ZP_OK : zp_fail_memory(err);
}

const ZpPlotColumn *zp_plot_column(const ZpPlot *plot, const char *name) {
  for (size_t i = 0; i < plot->columns; i++)
    if (strcmp(plot->column[i].name, name) == 0) return &plot->column[i];
  return NULL;
}

/* -- opening --------------------------------------------------------------------------------------- */

ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err) {
  const ZpResult *first = zp_report_result(report, 0);
  plot->report = report;
  plot->single = zp_report_single(report);
  plot->study = first->study;
  plot->axis = zp_scenario_axes(report->scenario, &plot->axes);
  const bool of_cases = !plot->single && zp_study_shows(plot->study) != ZP_SHOWS_fit;
  return of_cases || first->series ? add_columns(plot, of_cases ? NULL : first->series, err) : ZP_OK;
}

/* -- result.gp ------------------------------------------------------------------------------------- */

/* A variable named `before` and `name`, which has letters, digits and underscores only. */
static void put_name(FILE *file, const char *before, const char *name) {
  fputs(before, file);
  for (; *name; name++)
    fputc(isalnum((unsigned char)*name) ? *name : '_', file);
  fputs(" = ", file);
}

/* NaN where there is no number. */
static void define(FILE *file, const char *before, const char *name, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  const bool whole = text[strspn(text, "-0123456789")] == 0; /* gnuplot would divide it as a whole number */
  put_name(file, before, name);
  fprintf(file, "%s%s\n", isfinite(value) ? text : "NaN", isfinite(value) && whole ? ".0" : "");
}

static void define_count(FILE *file, const char *before, const char *name, size_t value) {
  put_name(file, before, name);
  fprintf(file, "%zu\n", value);
}

static void define_text(FILE *file, const char *before, const char *name, const char *text) {
  put_name(file, before, name);
  fputc('\'', file);
  for (; *text; text++) {
    if (*text == '\'') fputc('\'', file);
    fputc(iscntrl((unsigned char)*text) ? ' ' : *text, file); /* a new line would begin a command */
  }
  fputs("'\n", file);
}

/* drive_voltage in SI or as a word, and said_drive_voltage in its unit. */
static void define_key(const ZpPlot *plot, int index, FILE *file) {
  const ZpKey *key = zp_key(index);
  const char *name = ZP_KEY_NAME(index);
  if (!zp_key_in_def(index) || key->type == ZP_KEY_TEXT) return;
  const double value = zp_def_get(&plot->def, index);
  char said[64];
  zp_value_print(index, value, said, sizeof said);
  if (key->type == ZP_KEY_ENUM)
    define_text(file, "", name, zp_key_word(index, value));
  else
    define(file, "", name, value);
  define_text(file, "said_", name, said);
}

/* The name of a key that is a column, the unit in which it is shown, and the factor to this unit. */
static void define_shown(const ZpPlotColumn *column, FILE *file) {
  const ZpKey *key = zp_key(column->key);
  const bool percent = strcmp(key->shown, "%") == 0;
  ZpUnitScale scale = {.decimal = true, .exponent = percent ? -2 : 0, .factor = 1};
  const bool shown = percent || (*key->shown && zp_unit_scale(key->shown, key->unit, &scale, NULL) == ZP_OK);
  define_text(file, "name_", column->name, ZP_KEY_NAME(column->key));
  define_text(file, "unit_", column->name, shown ? key->shown : "");
  define(file, "factor_", column->name, scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor);
}

/* Name, unit and meaning of a column. */
static void define_column(const ZpPlotColumn *column, FILE *file) {
  define_text(file, "si_", column->name, column->unit);
  define_text(file, "help_", column->name, column->help);
  if (column->key >= 0) define_shown(column, file);
}

/* The columns of the further tables of one run: `likelihood_columns`, `regions_columns`. */
static void define_further(const ZpPlot *plot, FILE *file) {
  for (int k = 0; k < ZP_FURTHER; k++) {
    const ZpTable *table = plot->single->further[k];
    if (!table) continue;
    fprintf(file, "%s_columns = ' ", zp_further_name[k]);
    for (size_t i = 0; i < table->columns; i++)
      fprintf(file, "%s ", table->column[i].name);
    fputs("'\n", file);
    for (size_t i = 0; i < table->columns; i++) {
      ZpPlotColumn column = {.unit = table->column[i].unit, .help = table->column[i].help};
      snprintf(column.name, sizeof column.name, "%s", table->column[i].name);
      column.key = find_key(plot, column.name);
      define_column(&column, file);
    }
  }
}

/* `all_columns`, and `columns`, those with two numbers at least. */
static void define_columns(const ZpPlot *plot, FILE *file) {
  for (size_t least = 0; least <= 2; least += 2) {
    fputs(least ? "'\ncolumns = ' " : "all_columns = ' ", file);
    for (size_t i = 0; i < plot->columns; i++)
      if (plot->column[i].count >= least) fprintf(file, "%s ", plot->column[i].name);
  }
  fputs("'\n", file);
  for (size_t i = 0; i < plot->columns; i++) {
    const ZpPlotColumn *column = &plot->column[i];
    define(file, "lowest_", column->name, column->low);
    define(file, "highest_", column->name, column->high);
    define_count(file, "count_", column->name, column->count);
    define_column(column, file);
  }
}

/* A list key, whose column is in `lists`, and, of those whose lists are combined, in `axes`, with its values. */
static void define_lists(const ZpPlot *plot, FILE *file) {
  char name[ZP_KEY_COLUMN_SIZE], said[64];
  size_t keys, count;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  fputs("lists = ''\naxes = ''\n", file);
  for (size_t i = 0, axis = 0; i < keys; i++) {
    zp_key_column(plot->report->scenario, key[i], name, sizeof name);
    fprintf(file, "lists = lists.'%s '\n", name);
    if (axis >= plot->axes || plot->axis[axis] != key[i]) continue;
    const double *value = zp_scenario_axis(plot->report->scenario, plot->axis[axis++], &count);
    fprintf(file, "axes = axes.'%s '\n", name);
    put_name(file, "values_", name);
    for (size_t k = 0; k < count; k++) {
      zp_value_print(key[i], value[k], said, sizeof said);
      fprintf(file, "%s\"%s\"", k ? " " : "'", said);
    }
    fputs("'\n", file);
  }
}

/* `front`: the rows of the best cases, from 0. */
static void define_optimum(const ZpOptimum *optimum, FILE *file) {
  fputs("objectives = '", file);
  for (size_t i = 0; i < optimum->objectives; i++)
    fprintf(file, "%s ", optimum->objective[i]);
  fprintf(file, "'\narray front[%zu]\n", optimum->count ? optimum->count : 1);
  for (size_t i = 0; i < optimum->count; i++)
    fprintf(file, "front[%zu] = %zu\n", i + 1, optimum->row[i]);
}

/* The numbers of the summary of one run but for wall times, and of its table the rows and how many states each stands
 * for. */
static void define_run(const ZpResult *result, FILE *file) {
  for (size_t i = 0; i < result->scalars; i++) {
    if (result->scalar[i].timing) continue;
    define(file, "", result->scalar[i].name, result->scalar[i].value);
    define_text(file, "si_", result->scalar[i].name, result->scalar[i].unit);
  }
  if (result->series) define_count(file, "", "rows", result->series->rows);
  if (result->series) define_count(file, "", "stride", result->series->stride);
}

/* The names of all of a kind, between spaces. */
static void define_names(const ZpActuatorDef *def, const char *name, ZpInstanceKind kind, FILE *file) {
  char room[ZP_NAME_SIZE];
  fprintf(file, "%s = '", name);
  for (int k = 1; k <= zp_instance_count(def, kind); k++)
    fprintf(file, "%s%s", k > 1 ? " " : "", zp_def_name(def, kind, k, room));
  fputs("'\n", file);
}

void zp_plot_define(const void *of, FILE *file) {
  const ZpPlot *plot = of;
  const ZpDesign *design = zp_scenario_design(plot->report->scenario);
  fputs("# What the pictures in this folder show, in SI. Data are in the .dat files here and in ../table.csv.\n", file);
  define_text(file, "", "study", zp_study_name(plot->study));
  define_text(file, "", "kind", zp_study_kind(plot->study));
  define_text(file, "", "liquid", zp_key_word(zp_key_find("liquid.model"), zp_def_liquid(&plot->def)));
  define_count(file, "", "cases", plot->report->count);
  define_count(file, "", "fitted", plot->def.calibrate.fit[strspn(plot->def.calibrate.fit, " ")] != 0);
  for (int key = zp_def_next_key(&plot->def, -1); key >= 0; key = zp_def_next_key(&plot->def, key))
    define_key(plot, key, file);
  fprintf(file, "film_roughness = %.9g # whatever auto means\n", zp_def_roughness(&plot->def));
  if (zp_def_network(&plot->def)) {
    define_names(&plot->def, "members_named", ZP_OF_MEMBER, file);
    define_names(&plot->def, "bodies_named", ZP_OF_BODY, file);
    define_names(&plot->def, "springs_named", ZP_OF_SPRING, file);
    define_names(&plot->def, "joints_named", ZP_OF_JOINT, file);
    if (zp_def_plane(&plot->def)) define_count(file, "", "in_plane", 1);
  }
  define_columns(plot, file);
  define_lists(plot, file);
  if (plot->single) define_run(plot->single, file);
  if (plot->single) define_further(plot, file);
  if (design) { /* samples of a combination of the lists' values, of which in `blocks` rows the first are independent */
    define_count(file, "", "samples", zp_design_samples(design));
    define_count(file, "", "blocks", zp_design_blocks(design));
    define_count(file, "", "independent", design->indices ? ZP_BLOCK_FIRST : 1);
  }
  if (plot->report->optimum) define_optimum(plot->report->optimum, file);
}
