/* Pictures of a sweep: contraction.svg, all runs over time, bode.svg against the frequency of a drive, and what a study
 * asks for against the list key that varies fastest: zip_time.svg, strokes.svg, voltages.svg, frequencies.svg,
 * factors.svg; forces.svg and torques.svg, a curve for each value of the others. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"
#include "io/units.h"

/* Curves that the legend names, and rows that all curves together may have: a picture of more is slow to
 * look at and shows no more. */
#define LEGEND 10
#define ROWS   200000

static bool is_sweep(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_motion && !plot->single && plot->report->count > 0;
}

static bool is_ribbon(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON;
}

/* What is drawn over time. */
static const char *column(const ZpPlot *plot) {
  return is_ribbon(plot) ? "stroke_m" : "contraction";
}

static const ZpTable *series(const ZpPlot *plot, size_t run) {
  return zp_report_result(plot->report, run)->series;
}

static bool has_contraction(const ZpPlot *plot) {
  for (size_t i = 0; is_sweep(plot) && i < plot->report->count; i++)
    if (zp_plot_has(series(plot, i), column(plot))) return true;
  return false;
}

/* A block per run: time, value, number of the run; NaN between them (plot_shapes.c says why). */
static void data_contraction(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# time_s %s run; NaN between runs\n", column(plot));
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = series(plot, run);
    size_t rows = table ? table->rows : 0, step = rows * plot->report->count / ROWS + 1;
    for (size_t row = 0; row < rows; row++) {
      double value = zp_table_get(table, row, column(plot));
      if (!isfinite(value) || (row % step && row + 1 < rows)) continue;
      zp_plot_put(file, zp_table_get(table, row, "time_s"), ' ');
      zp_plot_put(file, value, ' ');
      fprintf(file, "%zu\n", run);
    }
    fprintf(file, "NaN NaN %zu\n", run);
  }
}

/* Largest of a column over all runs. */
static double largest_of(const ZpPlot *plot, const char *name) {
  double largest = 0;
  for (size_t run = 0; run < plot->report->count; run++) {
    if (!zp_plot_has(series(plot, run), name)) continue;
    for (size_t row = 0; row < series(plot, run)->rows; row++) {
      const double value = fabs(zp_table_get(series(plot, run), row, name));
      if (isfinite(value)) largest = fmax(largest, value);
    }
  }
  return largest;
}

/* "8 kV, 21": the values of the list keys of a run, but of the last `without` of them. */
static void run_name(const ZpPlot *plot, size_t run, size_t without, char *text, size_t size) {
  size_t keys, used = 0;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef def;
  text[0] = 0;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return;
  for (size_t i = 0; i + without < keys && used < size; i++) {
    char value[64];
    zp_value_print(key[i], zp_def_get(&def, key[i]), value, sizeof value);
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", value);
  }
}

/* The names of the list keys but the last `without`, each on a line so that it fits over the legend. */
static void define_legend(const ZpPlot *plot, FILE *file, size_t without) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  fputs("legend = \"", file);
  for (size_t i = 0; i + without < keys; i++) {
    fputs(i ? ",\\n" : "", file);
    for (const char *c = zp_key(key[i])->name; *c; c++)
      fprintf(file, "%s%c", *c == '_' ? "\\\\" : "", *c);
  }
  fputs("\"\n", file);
}

/* All runs are drawn, some of them named. */
static void define_contraction(const ZpPlot *plot, FILE *file) {
  const size_t count = plot->report->count, named = count < LEGEND ? count : LEGEND;
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_key(plot, file, "actuator.kind");
  zp_plot_define(file, "largest_time_s", largest_of(plot, "time_s"));
  zp_plot_define(file, "largest_stroke_m", largest_of(plot, "stroke_m"));
  define_legend(plot, file, 0);
  zp_plot_define_count(file, "runs", count);
  zp_plot_define_array(file, "run", named);
  zp_plot_define_array(file, "name", named);
  for (size_t i = 0; i < named; i++) {
    const size_t run = named > 1 ? i * (count - 1) / (named - 1) : 0;
    char name[256];
    run_name(plot, run, 0, name, sizeof name);
    zp_plot_define_count(file, zp_plot_entry("run", i + 1).text, run);
    zp_plot_define_text(file, zp_plot_entry("name", i + 1).text, name);
  }
}

int zp_sweep_key(const ZpPlot *plot, size_t back) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  return back < keys ? key[keys - 1 - back] : -1;
}

/* The list key against which numbers are drawn. */
static int x_key(const ZpPlot *plot) {
  return zp_sweep_key(plot, 0);
}

/* Does another curve begin at this run: has any other list key changed? */
static bool begins_curve(const ZpPlot *plot, size_t run) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef before, now;
  if (run == 0 || zp_scenario_def(plot->report->scenario, run - 1, &before, NULL) != ZP_OK) return false;
  if (zp_scenario_def(plot->report->scenario, run, &now, NULL) != ZP_OK) return false;
  for (size_t i = 0; i + 1 < keys; i++)
    if (zp_def_get(&before, key[i]) != zp_def_get(&now, key[i])) return true;
  return false;
}

double zp_sweep_value(const ZpPlot *plot, size_t run, int key) {
  ZpActuatorDef def;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return NAN;
  return zp_def_get(&def, key);
}

static double key_value(const ZpPlot *plot, size_t run) {
  return zp_sweep_value(plot, run, x_key(plot));
}

static const ZpAnswer answers[] = {
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {enumerator, #picture, title, axis, unit, {scalar, scalar2}, {legend, legend2}, count},
#include <zipact/studies.def>
};

const ZpAnswer *zp_sweep_answer(const ZpPlot *plot) {
  for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++)
    if (answers[i].study == plot->study) return &answers[i];
  return NULL;
}

/* How many runs have the scalar and a number of the list key; none where `name` is NULL. */
static size_t points_of(const ZpPlot *plot, const char *name) {
  size_t count = 0;
  for (size_t run = 0; name && run < plot->report->count; run++)
    count += isfinite(zp_result_get(zp_report_result(plot->report, run), name)) && isfinite(key_value(plot, run));
  return count;
}

/* How many runs have a point on the curve. */
static size_t points(const ZpPlot *plot, size_t curve) {
  return points_of(plot, zp_sweep_answer(plot)->scalar[curve]);
}

/* Are there runs to draw against a key? */
static bool has_axis(const ZpPlot *plot) {
  return !plot->single && plot->report->count > 0 && x_key(plot) >= 0 && !zp_scenario_design(plot->report->scenario) &&
         !plot->report->optimum;
}

static bool has_answer(const ZpPlot *plot, ZpStudy study) {
  if (plot->study != study || !has_axis(plot)) return false;
  return points(plot, 0) >= 2 || points(plot, 1) >= 2;
}

/* has_zip_time, has_strokes, ...: is there something to draw for the picture of a study? */
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  static bool has_##picture(const ZpPlot *plot) {                                                                      \
    return has_answer(plot, enumerator);                                                                               \
  }
#include <zipact/studies.def>

/* Runs that begin a curve, at most LEGEND evenly chosen. => how many */
static size_t choose_curves(const ZpPlot *plot, size_t chosen[LEGEND]) {
  size_t curves = 0, kept = 0, at = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    curves += run == 0 || begins_curve(plot, run);
  for (size_t run = 0; run < plot->report->count && kept < LEGEND; run++) {
    if (run > 0 && !begins_curve(plot, run)) continue;
    if (curves <= LEGEND || at * (LEGEND - 1) >= kept * (curves - 1)) chosen[kept++] = run;
    at++;
  }
  return kept;
}

/* Runs of the curve that begins at `run`: up to this one. */
static size_t end_of_curve(const ZpPlot *plot, size_t run) {
  do
    run++;
  while (run < plot->report->count && !begins_curve(plot, run));
  return run;
}

/* An index per curve: the key, then numbers of the summary (`scalar`, ended by NULL). */
static void put_curves(const ZpPlot *plot, FILE *file, const char *const *scalar) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  fprintf(file, "# %s", zp_key(x_key(plot))->name);
  for (size_t i = 0; scalar[i]; i++)
    fprintf(file, " %s", scalar[i]);
  fputs("; an index per curve\n", file);
  for (size_t k = 0; k < curves; k++) {
    for (size_t run = chosen[k]; run < end_of_curve(plot, chosen[k]); run++) {
      zp_plot_put(file, key_value(plot, run), ' ');
      for (size_t i = 0; scalar[i]; i++)
        zp_plot_put(file, zp_result_get(zp_report_result(plot->report, run), scalar[i]), scalar[i + 1] ? ' ' : '\n');
    }
    fputs("\n\n", file);
  }
}

static void data_answer(const ZpPlot *plot, FILE *file) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  put_curves(plot, file, (const char *const[]){a->scalar[0], a->scalar[1], NULL});
}

double zp_sweep_factor(int index) {
  const ZpKey *key = zp_key(index);
  ZpUnitScale scale;
  if (!*key->shown || zp_unit_scale(key->shown, key->unit, &scale, NULL) != ZP_OK) return 1;
  return scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor;
}

void zp_sweep_label(int index, char *label, size_t size) {
  const ZpKey *key = zp_key(index);
  snprintf(label, size, *key->shown ? "%s / %s" : "%s", key->name, key->shown);
}

/* What the x axis is, which curves there are and what the legend calls them. */
static void define_curves(const ZpPlot *plot, FILE *file) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  char text[256];
  zp_sweep_label(x_key(plot), text, sizeof text);
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_text(file, "x_label", text);
  zp_plot_define(file, "x_factor", zp_sweep_factor(x_key(plot)));
  zp_plot_define_count(file, "many", zp_sweep_key(plot, 1) >= 0);
  define_legend(plot, file, 1);
  zp_plot_define_array(file, "curve", curves);
  for (size_t k = 0; k < curves; k++) {
    run_name(plot, chosen[k], 1, text, sizeof text);
    zp_plot_define_text(file, zp_plot_entry("curve", k + 1).text, text);
  }
}

/* Largest absolute value of a number of the summary over all runs; 0 of none. */
static double largest_scalar(const ZpPlot *plot, const char *scalar) {
  double largest = 0;
  for (size_t run = 0; scalar && run < plot->report->count; run++) {
    const double value = fabs(zp_result_get(zp_report_result(plot->report, run), scalar));
    if (isfinite(value)) largest = fmax(largest, value);
  }
  return largest;
}

static void define_answer(const ZpPlot *plot, FILE *file) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  char counted[96];
  snprintf(counted, sizeof counted, "%zu of %zu runs %s", points(plot, 0), plot->report->count, a->count);
  zp_plot_define_text(file, "title", a->title);
  zp_plot_define_text(file, "quantity", a->axis);
  zp_plot_define_word(file, "si", a->unit ? a->unit : "");
  zp_plot_define_text(file, "remark", counted);
  zp_plot_define_word(file, "data", a->picture);
  zp_plot_define_count(file, "motion", plot->shows == ZP_SHOWS_motion);
  zp_plot_define_count(file, "numbers", a->scalar[1] ? 2 : 1);
  zp_plot_define(file, "largest_value", fmax(largest_scalar(plot, a->scalar[0]), largest_scalar(plot, a->scalar[1])));
  fprintf(file, "drawn = '%s%s'\n", points(plot, 0) ? "1 " : "", points(plot, 1) ? "2 " : "");
  zp_plot_define_array(file, "number_name", 2);
  for (size_t i = 0; i < 2; i++)
    zp_plot_define_text(file, zp_plot_entry("number_name", i + 1).text, a->legend[i] ? a->legend[i] : "");
  define_curves(plot, file);
}

/* -- what is held --------------------------------------------------------------------------------- */

static bool has_forces(const ZpPlot *plot) {
  if (plot->shows == ZP_SHOWS_held_branch) return has_axis(plot) && points_of(plot, "force_N") >= 2;
  return plot->shows == ZP_SHOWS_field && has_answer(plot, plot->study);
}

static bool has_torques(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_held_branch && has_axis(plot) && points_of(plot, "torque_N_m") >= 2;
}

static void data_forces(const ZpPlot *plot, FILE *file) {
  put_curves(plot, file, (const char *const[]){"force_N", NULL});
}

/* Against the angle of the fold, which follows from the list key that varies fastest. */
static void data_torques(const ZpPlot *plot, FILE *file) {
  put_curves(plot, file, (const char *const[]){"angle_rad", "torque_N_m", NULL});
}

/* Of many curves the first list key has a line style, the others together a colour. */
static size_t curves_of_a_style(const ZpPlot *plot, const size_t *chosen, size_t curves) {
  size_t keys, alike = 1;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef first, other;
  if (keys < 3 || zp_scenario_def(plot->report->scenario, chosen[0], &first, NULL) != ZP_OK) return curves;
  while (alike < curves && zp_scenario_def(plot->report->scenario, chosen[alike], &other, NULL) == ZP_OK &&
         zp_def_get(&other, key[0]) == zp_def_get(&first, key[0]))
    alike++;
  return alike;
}

static void define_held(const ZpPlot *plot, FILE *file, const char *scalar) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  zp_plot_define_key(plot, file, "actuator.kind");
  zp_plot_define_count(file, "held", plot->shows != ZP_SHOWS_field);
  zp_plot_define(file, "largest_value", largest_scalar(plot, scalar));
  zp_plot_define_count(file, "alike", curves_of_a_style(plot, chosen, curves));
  define_curves(plot, file);
}

static void define_forces(const ZpPlot *plot, FILE *file) {
  define_held(plot, file, "force_N");
}

static void define_torques(const ZpPlot *plot, FILE *file) {
  define_held(plot, file, "torque_N_m");
}

/* -- bode ------------------------------------------------------------------------------------------ */

/* Amplitude and phase against the frequency of a drive. */
static bool has_bode(const ZpPlot *plot) {
  return has_axis(plot) && strcmp(zp_key(x_key(plot))->name, "drive.frequency") == 0 &&
         points_of(plot, "phase_rad") >= 2;
}

static void data_bode(const ZpPlot *plot, FILE *file) {
  put_curves(plot, file, (const char *const[]){"stroke_amplitude_m", "phase_rad", NULL});
}

static void define_bode(const ZpPlot *plot, FILE *file) {
  zp_plot_define(file, "largest_amplitude_m", largest_scalar(plot, "stroke_amplitude_m"));
  define_curves(plot, file);
}

const ZpPicture zp_sweep_pictures[] = {
    {"bode", "svg", has_bode, define_bode, data_bode, "bode.gp"},
    {"contraction", "svg", has_contraction, define_contraction, data_contraction, "contraction.gp"},
    {"forces", "svg", has_forces, define_forces, data_forces, "forces.gp"},
    {"torques", "svg", has_torques, define_torques, data_torques, "torques.gp"},
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {#picture, "svg", has_##picture, define_answer, data_answer, "sweep.gp"},
#include <zipact/studies.def>
    {0},
};
