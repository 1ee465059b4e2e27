/* Pictures of a sweep: contraction.svg, all runs over time; bode.svg, against the frequency of a drive; and the results
 * of a study against the list key that varies fastest: zip_time.svg, strokes.svg, voltages.svg, frequencies.svg,
 * factors.svg; forces.svg and torques.svg, a curve for each value of the others. All but the first read
 * ../table.csv. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/plot.h"
#include "io/sampled.h"

/* Curves that the legend names, and rows that all curves together may have: a picture of more is slow to view and shows
 * no more. */
enum { LEGEND = 10, ROWS = 200000 };

/* -- axes and curves ------------------------------------------------------------------------------- */

int zp_sweep_key(const ZpPlot *plot, size_t back) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  return back < keys ? key[keys - 1 - back] : -1;
}

double zp_sweep_value(const ZpPlot *plot, size_t run, int key) {
  size_t keys;
  const int *list = zp_scenario_lists(plot->report->scenario, &keys);
  for (size_t i = 0; i < keys; i++)
    if (list[i] == key) return plot->table->value[run * plot->table->columns + i];
  return NAN;
}

bool zp_sweep_has_axis(const ZpPlot *plot) {
  return zp_sweep_key(plot, 0) >= 0 && !zp_scenario_design(plot->report->scenario) && !plot->report->optimum;
}

void zp_sweep_run_name(const ZpPlot *plot, size_t run, size_t without, char *text, size_t size) {
  size_t keys, used = 0;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  text[0] = 0;
  for (size_t i = 0; i + without < keys && used < size; i++) {
    char value[64];
    if (zp_scenario_spread(plot->report->scenario, key[i])) continue;
    zp_plot_print_value(key[i], zp_sweep_value(plot, run, key[i]), value, sizeof value);
    used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", value);
  }
}

/* Does any list key, except the one that varies fastest, have another value than in the run before? */
static bool begins_curve(const ZpPlot *plot, size_t run) {
  for (size_t back = 1; run > 0 && zp_sweep_key(plot, back) >= 0; back++) {
    const int key = zp_sweep_key(plot, back);
    if (zp_sweep_value(plot, run, key) != zp_sweep_value(plot, run - 1, key)) return true;
  }
  return run == 0;
}

static size_t last_of_curve(const ZpPlot *plot, size_t run) {
  while (run + 1 < plot->report->count && !begins_curve(plot, run + 1))
    run++;
  return run;
}

static bool has_number(const ZpPlot *plot, size_t run, const char *scalar) {
  return scalar && isfinite(zp_table_get(plot->table, run, scalar));
}

/* Does the run have a point in a picture, by the result of its study or in one of the pictures without? */
static bool has_point(const ZpPlot *plot, size_t run) {
  static const char *const other[] = {"force_N", "torque_N_m", "stroke_amplitude_m"};
  bool has = false;
  for (size_t i = 0; plot->answer && i < 2; i++)
    has |= has_number(plot, run, plot->answer->scalar[i]);
  for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
    has |= has_number(plot, run, other[i]);
  return has;
}

/* Does a curve with points begin with this run? One without would only be a name in the legend. */
static bool begins_drawn(const ZpPlot *plot, size_t first) {
  if (!begins_curve(plot, first)) return false;
  size_t run = first, last = last_of_curve(plot, first);
  while (run < last && !has_point(plot, run))
    run++;
  return has_point(plot, run);
}

/* The values of a key that curves with points have, in the order of the runs. */
typedef struct Values {
  int key;
  double *value; /* [count] */
  size_t count;
  size_t kept; /* so many of them are drawn */
} Values;

static void add_value(Values *v, double value) {
  for (size_t i = 0; i < v->count; i++)
    if (v->value[i] == value) return;
  v->value[v->count++] = value;
}

/* Is the value among those kept, which are evenly chosen and have both ends? */
static bool keeps(const Values *v, double value) {
  size_t i = 0;
  while (i < v->count && v->value[i] != value)
    i++;
  if (v->kept == 1) return i == v->count / 2;
  for (size_t k = 0; k < v->kept; k++)
    if ((2 * k * (v->count - 1) + v->kept - 1) / (2 * (v->kept - 1)) == i) return true;
  return false;
}

/* How many values of each key are drawn: together at most LEGEND curves, and of each key about the same share. */
static void share_out(Values *v, size_t keys) {
  for (size_t i = 0; i < keys; i++)
    v[i].kept = 1;
  for (;;) {
    size_t curves = 1, next = keys;
    for (size_t i = 0; i < keys; i++)
      curves *= v[i].kept;
    for (size_t i = 0; i < keys; i++) {
      bool fits = v[i].kept < v[i].count && curves / v[i].kept * (v[i].kept + 1) <= LEGEND;
      if (fits && (next == keys || v[i].kept * v[next].count < v[next].kept * v[i].count)) next = i;
    }
    if (next == keys) return;
    v[next].kept++;
  }
}

/* Curves of a picture, by the runs that begin them. If there are none, the first run, because a gnuplot array needs an
 * entry. `all`: those with points, drawn or not. */
typedef struct Curves {
  size_t first[LEGEND], count, all;
} Curves;

enum { KEYS_MOST = 16 };

static void choose_kept(const ZpPlot *plot, const Values *v, size_t keys, Curves *curves) {
  for (size_t run = 0; run < plot->report->count && curves->count < LEGEND; run++) {
    bool kept = begins_drawn(plot, run);
    for (size_t i = 0; kept && i < keys; i++)
      kept = keeps(&v[i], zp_sweep_value(plot, run, v[i].key));
    if (kept) curves->first[curves->count++] = run;
  }
}

/* Of too many curves some values of each key are drawn, each with all that are drawn of the others. */
static Curves choose_curves(const ZpPlot *plot) {
  Curves curves = {.count = 0};
  Values v[KEYS_MOST] = {0};
  size_t keys = 0, runs = plot->report->count;
  double *room = calloc(KEYS_MOST * (runs + 1), sizeof *room);
  while (keys < KEYS_MOST && zp_sweep_key(plot, keys + 1) >= 0) {
    v[keys] = (Values){.key = zp_sweep_key(plot, keys + 1), .value = room + keys * runs};
    keys++;
  }
  for (size_t run = 0; room && run < runs; run++) {
    if (!begins_drawn(plot, run)) continue;
    curves.all++;
    for (size_t i = 0; i < keys; i++)
      add_value(&v[i], zp_sweep_value(plot, run, v[i].key));
  }
  share_out(v, keys);
  if (room) choose_kept(plot, v, keys, &curves);
  free(room);
  if (curves.count == 0) curves.count = 1;
  return curves;
}

/* With more than two keys: the number of successive curves in which the first key has one value; all, if that key
 * varies. */
static size_t curves_alike(const ZpPlot *plot, const size_t *chosen, size_t curves) {
  size_t keys, alike = 1;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  if (keys < 3) return curves;
  while (alike < curves && zp_sweep_value(plot, chosen[alike], key[0]) == zp_sweep_value(plot, chosen[0], key[0]))
    alike++;
  for (size_t k = alike; k < curves; k++) /* where curves are left out, not all values have as many */
    if ((zp_sweep_value(plot, chosen[k], key[0]) != zp_sweep_value(plot, chosen[k - 1], key[0])) != (k % alike == 0))
      return curves;
  return alike;
}

/* Curve k is curve[k], in the rows first[k] to last[k] of the table, from 0. */
static void define_curves(const ZpPlot *plot, FILE *file) {
  const Curves chosen = choose_curves(plot);
  const size_t curves = chosen.count;
  static const char *const array[] = {"curve", "first", "last"};
  for (size_t i = 0; i < 3; i++)
    zp_plot_define_array(file, array[i], curves);
  for (size_t k = 0; k < curves; k++) {
    char text[256];
    zp_sweep_run_name(plot, chosen.first[k], 1, text, sizeof text);
    zp_plot_define_text(file, zp_plot_entry("curve", k + 1).text, text);
    zp_plot_define_count(file, zp_plot_entry("first", k + 1).text, chosen.first[k]);
    zp_plot_define_count(file, zp_plot_entry("last", k + 1).text, last_of_curve(plot, chosen.first[k]));
  }
  zp_plot_define_count(file, "alike", curves_alike(plot, chosen.first, curves));
  zp_plot_define_count(file, "curves", chosen.all);
}

/* x, y and z: x is the key that varies fastest; its values are in the column x_column of the table. */
static void define_axes(const ZpPlot *plot, FILE *file) {
  static const char *const axis[] = {"x", "y", "z"};
  char column[ZP_KEY_COLUMN_SIZE];
  for (size_t i = 0; i < 3 && zp_sweep_key(plot, i) >= 0; i++)
    zp_plot_define_key_axis(file, axis[i], 0, zp_sweep_key(plot, i));
  zp_key_column(zp_sweep_key(plot, 0), column, sizeof column);
  zp_plot_define_word(file, "x_column", column);
}

/* Runs that have closed and are open at the end. */
static size_t count_reopened(const ZpPlot *plot) {
  size_t reopened = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    reopened += has_number(plot, run, "zip_time_s") && !has_number(plot, run, "closed_from_s") &&
                zp_table_get(plot->table, run, "contraction") < 0.99;
  return reopened;
}

static void define_answer(const ZpAnswer *a, const ZpPlot *plot, FILE *file) {
  char counted[128];
  int size = snprintf(counted, sizeof counted, "%zu of %zu runs %s", zp_plot_count(plot->table, a->scalar[0]),
                      plot->report->count, a->count);
  size_t reopened = count_reopened(plot);
  if (reopened > 0) snprintf(counted + size, sizeof counted - (size_t)size, ", %zu of them end open", reopened);
  zp_plot_define_text(file, "answer", a->title);
  zp_plot_define_text(file, "answers", counted);
  zp_plot_define_text(file, "quantity", a->axis);
  zp_plot_define_word(file, "si", a->unit ? a->unit : "");
  zp_plot_define_array(file, "number_name", 2);
  zp_plot_define_array(file, "number", 2);
  for (size_t i = 0; i < 2; i++) {
    zp_plot_define_text(file, zp_plot_entry("number_name", i + 1).text, a->legend[i] ? a->legend[i] : "");
    zp_plot_define_word(file, zp_plot_entry("number", i + 1).text, a->scalar[i] ? a->scalar[i] : "");
  }
}

/* The names of the list keys, from the one that varies slowest. */
static void define_legend(const ZpPlot *plot, FILE *file) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  zp_plot_define_array(file, "list_key", keys);
  for (size_t i = 0; i < keys; i++)
    zp_plot_define_text(file, zp_plot_entry("list_key", i + 1).text, zp_key(key[i])->name);
}

void zp_sweep_define(const ZpPlot *plot, FILE *file) {
  zp_plot_define_count(file, "cases", plot->report->count);
  if (plot->answer) define_answer(plot->answer, plot, file);
  if (zp_sweep_key(plot, 0) < 0) return;
  define_legend(plot, file);
  define_axes(plot, file);
  if (zp_sweep_has_axis(plot)) define_curves(plot, file);
}

/* -- all runs over time ----------------------------------------------------------------------------- */

static const char *over_time(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON ? "stroke_m" : "contraction";
}

static const ZpTable *series(const ZpPlot *plot, size_t run) {
  return zp_report_result(plot->report, run)->series;
}

static bool has_contraction(const ZpPlot *plot) {
  for (size_t run = 0; run < plot->report->count; run++)
    if (zp_plot_has(series(plot, run), over_time(plot))) return true;
  return false;
}

/* A block per run: time, value, number of the run; NaN between them (plot_shapes.c says why). */
static void data_contraction(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# time_s %s run; NaN between runs\n", over_time(plot));
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = series(plot, run);
    size_t rows = table ? table->rows : 0, step = rows * plot->report->count / ROWS + 1;
    for (size_t row = 0; row < rows; row++) {
      double value = zp_table_get(table, row, over_time(plot));
      if (!isfinite(value) || (row % step && row + 1 < rows)) continue;
      zp_plot_put(file, zp_table_get(table, row, "time_s"), ' ');
      zp_plot_put(file, value, ' ');
      fprintf(file, "%zu\n", run);
    }
    fprintf(file, "NaN NaN %zu\n", run);
  }
}

/* Some of the runs are named: run[i], from 0, is name[i]. */
static void define_contraction(const ZpPlot *plot, FILE *file) {
  const size_t count = plot->report->count, named = count < LEGEND ? count : LEGEND;
  zp_plot_define_array(file, "run", named);
  zp_plot_define_array(file, "name", named);
  for (size_t i = 0; i < named; i++) {
    const size_t run = named > 1 ? i * (count - 1) / (named - 1) : 0;
    char name[256];
    zp_sweep_run_name(plot, run, 0, name, sizeof name);
    zp_plot_define_count(file, zp_plot_entry("run", i + 1).text, run);
    zp_plot_define_text(file, zp_plot_entry("name", i + 1).text, name);
  }
}

/* -- which there are -------------------------------------------------------------------------------- */

static bool has_bode(const ZpPlot *plot) {
  return zp_sweep_has_axis(plot) && strcmp(zp_key(zp_sweep_key(plot, 0))->name, "drive.frequency") == 0;
}

/* Is it the picture of this study, and is there something to draw? */
static bool has_answer(const ZpPlot *plot, ZpStudy study) {
  if (!plot->answer || plot->answer->study != study || !zp_sweep_has_axis(plot)) return false;
  const char *const *scalar = plot->answer->scalar;
  return zp_plot_has(plot->table, scalar[0]) || (scalar[1] && zp_plot_has(plot->table, scalar[1]));
}

/* has_zip_time, has_strokes, ... */
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  static bool has_##picture(const ZpPlot *plot) {                                                                      \
    return has_answer(plot, enumerator);                                                                               \
  }
#include <zipact/studies.def>

const ZpPicture zp_sweep_pictures[] = {
    {"bode", "svg", "bode.gp", .many = ZP_OF(motion), .needs = "stroke_amplitude_m phase_rad", .has = has_bode},
    {"contraction", "svg", "contraction.gp", .many = ZP_OF(motion), .has = has_contraction,
     .define = define_contraction, .data = data_contraction},
    {"forces", "svg", "forces.gp", .many = ZP_OF(held_branch) | ZP_OF(field), .needs = "force_N",
     .has = zp_sweep_has_axis},
    {"torques", "svg", "torques.gp", .many = ZP_OF(held_branch), .needs = "angle_rad torque_N_m",
     .has = zp_sweep_has_axis},
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {#picture, "svg", "sweep.gp", .many = ZP_OF_ANY, .has = has_##picture},
#include <zipact/studies.def>
    {0},
};
