/* What there is to draw of a report, and result.gp, which defines it for the templates. */
#include "io/plot.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/cases.h"
#include "io/number.h"
#include "io/sampled.h"
#include "io/units.h"

/* -- columns --------------------------------------------------------------------------------------- */

/* Add a number to column `i`, if it is one. */
static void add_number(ZpPlot *plot, size_t i, double value) {
  ZpPlotColumn *column = &plot->column[i];
  if (!isfinite(value)) return;
  column->low = fmin(column->low, value);
  column->high = fmax(column->high, value);
  column->count++;
}

/* Append a column. The key that a column shows is the one whose column has the same name. */
static void add_column(ZpPlot *plot, const char *name, const char *unit) {
  ZpPlotColumn column = {.unit = unit, .key = zp_key_count() - 1, .low = NAN, .high = NAN};
  for (; column.key >= 0; column.key--) {
    zp_key_column(column.key, column.name, sizeof column.name);
    if (strcmp(column.name, name) == 0) break;
  }
  snprintf(column.name, sizeof column.name, "%s", name);
  plot->column[plot->columns++] = column;
}

/* False if there is no memory. */
static bool add_series(ZpPlot *plot, const ZpTable *table) {
  plot->column = calloc(table->columns + 1, sizeof *plot->column);
  for (size_t i = 0; plot->column && i < table->columns; i++) {
    add_column(plot, table->column[i].name, table->column[i].unit);
    for (size_t row = 0; row < table->rows; row++)
      add_number(plot, i, table->value[row * table->columns + i]);
  }
  return plot->column != NULL;
}

/* List keys, then the numbers of the summary, as in table.csv. False if there is no memory. */
static bool add_cases(ZpPlot *plot) {
  const ZpReport *report = plot->report;
  ZpScalarNames names;
  size_t keys;
  const int *key = zp_scenario_lists(report->scenario, &keys);
  if (!zp_report_scalars(report, false, &names)) return false;
  double *value = calloc(keys + 1, sizeof *value);
  plot->column = calloc(keys + names.count + 1, sizeof *plot->column);
  const bool done = value && plot->column;
  for (size_t i = 0; done && i < keys; i++) {
    char name[ZP_KEY_COLUMN_SIZE];
    zp_key_column(key[i], name, sizeof name);
    add_column(plot, name, zp_key(key[i])->unit);
  }
  for (size_t i = 0; done && i < names.count; i++)
    add_column(plot, names.item[i].name, names.item[i].unit);
  for (size_t run = 0; done && run < report->count; run++) {
    zp_scenario_values(report->scenario, run, value);
    for (size_t i = 0; i < plot->columns; i++)
      add_number(plot, i, i < keys ? value[i] : zp_scalar_at(zp_report_result(report, run), &names, i - keys));
  }
  free(names.item);
  free(value);
  return done;
}

const ZpPlotColumn *zp_plot_column(const ZpPlot *plot, const char *name) {
  for (size_t i = 0; i < plot->columns; i++)
    if (strcmp(plot->column[i].name, name) == 0) return &plot->column[i];
  return NULL;
}

/* -- shapes ---------------------------------------------------------------------------------------- */

/* Is there a number in the first frame? A run may diverge later. */
static bool can_be_drawn(const ZpShapes *shapes) {
  return shapes && shapes->frames > 0 && isfinite(zp_shapes_get(shapes, 0).x[0]);
}

size_t zp_plot_frames(const ZpShapes *shapes, size_t frame[ZP_PLOT_FRAMES]) {
  const double start = zp_shapes_get(shapes, 0).time, end = zp_shapes_get(shapes, shapes->frames - 1).time;
  const size_t most = shapes->frames < ZP_PLOT_FRAMES ? shapes->frames : ZP_PLOT_FRAMES;
  size_t count = 0, near = 0;
  for (size_t k = 0; k < most; k++) {
    const double wanted = start + (end - start) * (double)k / (double)(most > 1 ? most - 1 : 1);
    if (most == shapes->frames) near = k; /* all of them */
    while (near + 1 < shapes->frames &&
           fabs(zp_shapes_get(shapes, near + 1).time - wanted) < fabs(zp_shapes_get(shapes, near).time - wanted))
      near++;
    frame[count++] = near;
  }
  return count;
}

/* -- opening --------------------------------------------------------------------------------------- */

ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err) {
  *plot = (ZpPlot){.report = report, .single = zp_report_single(report)};
  ZpStatus status = zp_scenario_def(report->scenario, 0, &plot->def, err);
  if (status != ZP_OK) return status;
  const ZpResult *first = zp_report_result(report, 0);
  const ZpTable *series = first->series;
  plot->study = first->study;
  plot->axis = zp_scenario_axes(report->scenario, &plot->axes);
  if (plot->single && can_be_drawn(first->shapes)) plot->shapes = first->shapes;
  bool done = true;
  if (plot->single || zp_study_shows(plot->study) == ZP_SHOWS_fit)
    done = !series || add_series(plot, series);
  else
    done = add_cases(plot);
  return done ? ZP_OK : zp_fail_memory(err);
}

void zp_plot_close(ZpPlot *plot) {
  free(plot->column);
}

double zp_plot_percent(const ZpPlot *plot, const ZpSensitivity *s) {
  const double key = zp_def_get(&plot->def, s->key), output = zp_result_get(plot->single, s->output);
  const bool passing = plot->single->outcome == ZP_ZIPPED && strcmp(s->output, "zip_time_s") != 0;
  const double percent = s->value * key / output;
  return key != 0 && output != 0 && isfinite(percent) && !passing ? percent : (double)NAN;
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

static void define_count(FILE *file, const char *name, size_t value) {
  fprintf(file, "%s = %zu\n", name, value);
}

/* A word of the program, to be compared and not to be shown. */
static void define_word(FILE *file, const char *before, const char *name, const char *word) {
  put_name(file, before, name);
  fprintf(file, "'%s'\n", word);
}

/* `text` inside quotes, shown as it is in enhanced mode, too. */
static void put_text(FILE *file, const char *text) {
  for (; *text; text++) {
    if (strchr("_^@&~{}\\", *text)) fputc('\\', file);
    if (*text == '\'') fputc('\'', file);
    fputc(iscntrl((unsigned char)*text) ? ' ' : *text, file); /* a new line would begin a command */
  }
}

static void define_text(FILE *file, const char *before, const char *name, const char *text) {
  put_name(file, before, name);
  fputc('\'', file);
  put_text(file, text);
  fputs("'\n", file);
}

/* A unit as pictures show it: "um" of the tables is "µm", "m2/s" is "m²/s". */
static void print_unit(const char *unit, char *text, size_t size) {
  size_t used = 0;
  text[0] = 0;
  for (const char *c = unit; *c && used < size; c++) {
    const char plain[2] = {*c, 0};
    const bool micro = *c == 'u' && c == unit && c[1];
    used += (size_t)snprintf(text + used, size - used, "%s", micro ? "µ" : *c == '2' ? "²" : *c == '3' ? "³" : plain);
  }
}

/* The value of a key for people: "6.667 kV", "50 µm". */
static void print_value(int key, double value, char *text, size_t size) {
  enum { EXACT_MOST = 6 }; /* letters: a longer number is rounded */
  char exact[64], unit[40], *end;
  zp_value_print(key, value, exact, sizeof exact);
  const double number = strtod(exact, &end);
  const int length = (int)(end - exact), digits = length > EXACT_MOST ? 4 : EXACT_MOST;
  print_unit(*end == ' ' ? end + 1 : "", unit, sizeof unit);
  if (length == 0) /* a word */
    snprintf(text, size, "%s", exact);
  else
    snprintf(text, size, "%.*g%s%s", digits, number, *unit ? " " : "", unit);
}

/* drive_voltage in SI or as a word, and said_drive_voltage for people. */
static void define_key(const ZpPlot *plot, int index, FILE *file) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_TEXT || key->offset == ZP_NO_FIELD) return;
  const double value = zp_def_get(&plot->def, index);
  const char *word = zp_key_word(index, value);
  char said[64];
  print_value(index, value, said, sizeof said);
  if (word && key->type == ZP_KEY_ENUM)
    define_word(file, "", key->name, word);
  else
    define(file, "", key->name, value);
  define_text(file, "said_", key->name, said);
}

/* Its name, the unit in which it is shown, and the factor to this unit. */
static void define_axis(const ZpPlotColumn *column, FILE *file) {
  const ZpKey *key = zp_key(column->key);
  ZpUnitScale scale = {.factor = 1};
  char unit[40];
  const bool shown = *key->shown && zp_unit_scale(key->shown, key->unit, &scale, NULL) == ZP_OK;
  print_unit(shown ? key->shown : "", unit, sizeof unit);
  define_text(file, "name_", column->name, key->name);
  define_text(file, "unit_", column->name, unit);
  define(file, "factor_", column->name, scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor);
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
    put_name(file, "count_", column->name);
    fprintf(file, "%zu\n", column->count);
    define_word(file, "si_", column->name, column->unit);
    if (column->key >= 0) define_axis(column, file);
  }
}

/* Do the shapes show the left half only, the right half being its mirror image? */
static bool is_half(const ZpPlot *plot) {
  return plot->shapes->ribbons > 1 && plot->def.actuator.kind == ZP_KIND_ELECTRO_RIBBON &&
         plot->def.actuator.symmetry == ZP_SYMMETRY_HALF;
}

static void define_shapes(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = plot->shapes;
  size_t frame[ZP_PLOT_FRAMES], frames = zp_plot_frames(shapes, frame);
  define_count(file, "half", is_half(plot));
  define_count(file, "ribbons", shapes->ribbons);
  define_count(file, "members", shapes->members);
  define_count(file, "nodes", shapes->nodes / shapes->members);
  define_count(file, "stride", plot->single->series ? plot->single->series->stride : 1);
  fprintf(file, "array frame_time[%zu]\narray frame_voltage[%zu]\n", frames, frames);
  for (size_t k = 0; k < frames; k++) {
    const ZpShape shape = zp_shapes_get(shapes, frame[k]);
    fprintf(file, "frame_time[%zu] = %.9g\nframe_voltage[%zu] = ", k + 1, shape.time, k + 1);
    fprintf(file, isfinite(shape.voltage) ? "%.9g\n" : "NaN\n", shape.voltage);
  }
}

/* The list keys of a sweep as columns, `lists`; of those whose lists are combined, `axes`, the number of values and
 * what they are called. */
static void define_lists(const ZpPlot *plot, FILE *file) {
  char name[ZP_KEY_COLUMN_SIZE], said[64];
  size_t keys, count;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  for (int axes = 0; axes < 2; axes++) {
    fputs(axes ? "axes = '" : "lists = '", file);
    for (size_t i = 0; i < (axes ? plot->axes : keys); i++) {
      zp_key_column(axes ? plot->axis[i] : key[i], name, sizeof name);
      fprintf(file, "%s ", name);
    }
    fputs("'\n", file);
  }
  for (size_t i = 0; i < plot->axes; i++) {
    const double *value = zp_scenario_axis(plot->report->scenario, plot->axis[i], &count);
    zp_key_column(plot->axis[i], name, sizeof name);
    put_name(file, "values_", name);
    for (size_t k = 0; k < count; k++) {
      fputs(k ? " \"" : "'\"", file);
      print_value(plot->axis[i], value[k], said, sizeof said);
      put_text(file, said);
      fputc('"', file);
    }
    fputs("'\n", file);
  }
}

/* Samples of a combination of the lists' values; of `blocks` successive rows the first `independent` are independent.
 */
static void define_samples(const ZpDesign *design, FILE *file) {
  define_count(file, "samples", zp_design_samples(design));
  define_count(file, "blocks", zp_design_blocks(design));
  define_count(file, "independent", design->indices ? ZP_BLOCK_FIRST : 1);
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

static void define_scalar(const ZpScalar *scalar, FILE *file) {
  define(file, "", scalar->name, scalar->value);
  define_word(file, "si_", scalar->name, scalar->unit);
}

void zp_plot_define(const void *of, FILE *file) {
  const ZpPlot *plot = of;
  const ZpDesign *design = zp_scenario_design(plot->report->scenario);
  const char *liquid = zp_key_word(zp_key_find("liquid.model"), zp_def_liquid(&plot->def));
  fputs("# What the pictures in this folder show, in SI. Data are in the .dat files here and in ../table.csv.\n", file);
  define_word(file, "", "study", zp_study_name(plot->study));
  define_word(file, "", "kind", zp_study_kind(plot->study));
  define_word(file, "", "outcome", zp_outcome_name(zp_report_result(plot->report, 0)->outcome));
  define_word(file, "", "liquid", liquid);
  define_count(file, "cases", plot->report->count);
  define_count(file, "fitted", plot->def.calibrate.fit[strspn(plot->def.calibrate.fit, " ")] != 0);
  for (int key = 0; key < zp_key_count(); key++)
    define_key(plot, key, file);
  for (size_t i = 0; plot->single && i < plot->single->scalars; i++)
    define_scalar(&plot->single->scalar[i], file);
  define_columns(plot, file);
  define_count(file, "rows", plot->single && plot->single->series ? plot->single->series->rows : 1);
  if (plot->shapes) define_shapes(plot, file);
  define_lists(plot, file);
  if (design) define_samples(design, file);
  if (plot->report->optimum) define_optimum(plot->report->optimum, file);
}
