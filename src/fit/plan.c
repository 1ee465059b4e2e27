/* Study `plan`: which of the possible measurements in plan.candidates limit the keys of calibrate.fit most, beside the
 * measurements in data.file. */
#include "fit/plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/cholesky.h"
#include "fit/selection.h"
#include "io/report.h"
#include "study/result.h"

/* A possible measurement that has a value: in which file it is, and in which row of it, both from 1. */
typedef struct Place {
  const ZpFitSet *set; /* the first of its columns */
  size_t at;           /* its row among those of the set */
} Place;

typedef struct Plan {
  ZpFit data, list;         /* what was measured, and what could be */
  bool has_data, limited;   /* there are data; they limit all keys */
  ZpFitPoint best, at;      /* of both, at the same values of the keys */
  ZpFitJudgement judgement; /* of the data */
  double freedom;           /* of the residuals that tell the standard deviation; INFINITY: it is given */
  ZpSelection selection;
  ZpMeasurement *among; /* [selection.count] */
  Place *place;         /* likewise */
  size_t listed;        /* rows of the candidates, with and without a value */
  size_t number;        /* of measurements that are chosen, */
  size_t *chosen;       /* these, in the order of their gain, */
  size_t *even;         /* and room for as many, or all, evenly spaced ones */
} Plan;

/* -- input ----------------------------------------------------------------------------------------- */

/* Rows of all files: those of their first columns. */
static size_t count_rows(const ZpFit *list) {
  size_t rows = 0;
  for (size_t s = 0; s < list->sets; s++)
    if (s == 0 || list->set[s].file != list->set[s - 1].file) rows += list->set[s].rows;
  return rows;
}

/* Standard deviations of planned values: given, or as the present residuals of the same quantity. */
static ZpStatus check_deviations(const Plan *plan, ZpError *err) {
  const ZpFitNumber *of = &zp_fit_number[plan->list.set->kind];
  const bool like_data = plan->has_data && !plan->data.sigma && plan->data.set->kind == plan->list.set->kind;
  if (!plan->list.sigma && !like_data)
    return zp_fail(err, ZP_BAD_INPUT,
                   "plan.candidates: the standard deviation of %s is not known; add a column sigma_%s_%s, or give "
                   "calibrate.sigma = \"%s = ... %s\"",
                   of->column, of->column, of->unit, of->column, of->unit);
  if (plan->has_data && !plan->data.sigma && plan->data.rows <= (size_t)plan->data.n)
    return zp_fail(err, ZP_BAD_INPUT,
                   "data.file: %zu rows for %d fitted values tell no standard deviation; give calibrate.sigma = \"%s = "
                   "... %s\"",
                   plan->data.rows, plan->data.n, of->column, of->unit);
  return ZP_OK;
}

static ZpStatus check_budget(const Plan *plan, const ZpActuatorDef *def, ZpError *err) {
  if ((size_t)def->plan.budget <= plan->listed) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "plan.budget = %d: plan.candidates has %zu row%s; give at most as many",
                 def->plan.budget, plan->listed, plan->listed == 1 ? "" : "s");
}

static ZpStatus open_plan(Plan *plan, const ZpActuatorDef *def, const ZpHooks *hooks, ZpError *err) {
  ZpStatus status = ZP_OK;
  if (!def->calibrate.fit[strspn(def->calibrate.fit, " ")])
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: empty; study plan needs the keys that the measurements are for");
  plan->has_data = *def->data.file != 0;
  if (plan->has_data) status = zp_fit_open_present(def, &plan->data, err);
  if (status == ZP_OK) status = zp_fit_open_candidates(def, plan->has_data ? &plan->data : NULL, &plan->list, err);
  if (status == ZP_OK) status = check_deviations(plan, err);
  plan->data.hooks = plan->list.hooks = hooks;
  plan->listed = count_rows(&plan->list);
  return status == ZP_OK ? check_budget(plan, def, err) : status;
}

static void close_plan(Plan *plan) {
  free(plan->best.fitted);
  free(plan->at.fitted);
  free(plan->among);
  free(plan->place);
  free(plan->chosen);
  zp_fit_close(&plan->data);
  zp_fit_close(&plan->list);
}

/* -- what is known ------------------------------------------------------------------------------------ */

/* Do the data tell the keys apart, and leave each with a standard error below its value? */
static bool data_limit_keys(const Plan *plan) {
  double C[ZP_FIT_MOST][ZP_FIT_MOST];
  bool limit = zp_fit_covariance(&plan->data, plan->best.J, NULL, 0, 1e-10, C);
  for (int k = 0; k < plan->data.keys && limit; k++)
    limit = sqrt(plan->judgement.variance * C[k][k]) < zp_fit_size(plan->best.z[k]);
  return limit;
}

/* Information of the data about all parameters, times their variance: J^T J. */
static ZpInformation information_of_data(const Plan *plan) {
  ZpInformation of = {{{0}}};
  for (size_t i = 0; i < plan->data.rows; i++)
    zp_information_add(plan->data.n, plan->best.J + i * (size_t)plan->data.n, 1, &of);
  return of;
}

/* A step to the best values where each key is known to its given value, beside the data. False if there is none. */
static bool step_to_given(const Plan *plan, double *step) {
  const size_t n = (size_t)plan->data.n;
  ZpInformation of = information_of_data(plan);
  memset(step, 0, n * sizeof *step);
  for (int k = 0; k < plan->data.keys; k++) {
    of.of[k][k] += plan->judgement.variance;
    step[k] = plan->judgement.variance * (1 - plan->best.z[k]);
  }
  for (size_t i = 0; i < plan->data.rows; i++)
    for (size_t k = 0; k < n; k++)
      step[k] -= plan->best.J[i * n + k] * zp_fit_residual(&plan->data, plan->best.fitted, i);
  if (!zp_cholesky_factor(plan->data.n, 0, of.of)) return false;
  zp_cholesky_solve(plan->data.n, of.of, step);
  return true;
}

/* Keys that the data do not limit would be anywhere after a fit: let them be near their given values. => whether there
 * are values for all rows. */
static bool approach_given(Plan *plan) {
  enum { STEPS = 5 };
  ZpFit *data = &plan->data;
  double step[ZP_FIT_MOST];
  for (int i = 0; i < STEPS && plan->best.good && step_to_given(plan, step); i++) {
    for (int k = 0; k < data->n; k++)
      plan->best.z[k] = fmin(fmax(plan->best.z[k] + step[k], data->lower[k]), data->upper[k]);
    zp_fit_go_to(data, &plan->best);
  }
  return plan->best.good;
}

/* Fit the keys to the data that there are. False if there is no fit. */
static bool fit_data(Plan *plan) {
  ZpFitStarts starts;
  if (!plan->has_data) return true;
  if (!zp_fit_open_point(&plan->data, &plan->best) || !zp_fit_solve(&plan->data, &plan->best, &starts)) return false;
  plan->judgement = zp_fit_judge(&plan->data, &plan->best);
  if (!plan->data.sigma) plan->freedom = (double)plan->data.rows - plan->data.n;
  plan->limited = data_limit_keys(plan);
  return plan->limited || approach_given(plan);
}

/* Each key is known to its given value: what is assumed where no data limit it. */
static void assume(const ZpSelection *selection, ZpInformation *information) {
  for (int k = 0; k < selection->keys; k++)
    information->of[k][k] += 1;
}

/* Information of the data about the keys, where their shifts are unknown. */
static void learn_from_data(const Plan *plan, ZpInformation *information) {
  *information = information_of_data(plan);
  for (int a = 0; a < plan->data.n; a++)
    for (int b = 0; b < plan->data.n; b++)
      information->of[a][b] /= plan->judgement.variance;
  if (!plan->limited) assume(&plan->selection, information);
  zp_information_eliminate(plan->data.keys, plan->data.n, information);
}

/* Nothing is known of the shifts of further files: their information is a millionth of that of a row, so that numbers
 * stay finite. */
static void assume_shifts(ZpSelection *selection, size_t rows) {
  static const double little = 1e-6;
  const size_t n = (size_t)selection->n;
  for (size_t s = (size_t)selection->keys; s < n; s++) {
    double most = 0;
    for (size_t i = 0; i < rows; i++)
      most = fmax(most, fabs(selection->J[i * n + s]));
    selection->start.of[s][s] = most > 0 ? little * most * most : 1;
  }
}

/* The information before the plan. */
static void start_selection(Plan *plan) {
  ZpSelection *selection = &plan->selection;
  ZpInformation of_data = {{{0}}};
  if (plan->has_data)
    learn_from_data(plan, &of_data);
  else
    assume(selection, &of_data);
  for (int a = 0; a < selection->keys; a++)
    memcpy(selection->start.of[a], of_data.of[a], (size_t)selection->keys * sizeof(double));
  assume_shifts(selection, plan->list.rows);
}

/* -- what could be known --------------------------------------------------------------------------------- */

/* Planned values at the keys' values, with derivatives over standard deviations. */
static bool predict(Plan *plan) {
  ZpFit *list = &plan->list;
  if (!zp_fit_open_point(list, &plan->at)) return false;
  memcpy(plan->at.z, list->first, sizeof plan->at.z);
  for (int k = 0; k < list->keys && plan->has_data; k++)
    plan->at.z[k] = plan->best.z[k];
  for (size_t i = 0; i < list->rows; i++)
    plan->at.fitted[i] = NAN;
  zp_fit_evaluate(list, plan->at.z, plan->at.fitted, plan->at.J);
  for (size_t i = 0; i < list->rows * (size_t)list->n && !list->sigma; i++)
    plan->at.J[i] /= sqrt(plan->judgement.variance);
  return zp_fit_goes_on(list);
}

/* Has one of its columns a value? */
static bool has_value(const Plan *plan, const ZpMeasurement *of) {
  for (int k = 0; k < of->count; k++)
    if (isfinite(plan->at.fitted[of->first + (size_t)k * of->step])) return true;
  return false;
}

/* The rows of a file that have a value; `columns`: its measured ones. */
static void list_file(Plan *plan, const ZpFitSet *set, int columns) {
  for (size_t i = 0; i < set->rows; i++) {
    const ZpMeasurement of = {set->first + i, set->rows, columns};
    if (!has_value(plan, &of)) continue;
    plan->place[plan->selection.count] = (Place){set, i};
    plan->among[plan->selection.count++] = of;
  }
}

/* A row of a file is a measurement: all its columns are read together. */
static bool list_measurements(Plan *plan) {
  const ZpFit *list = &plan->list;
  plan->place = calloc(plan->listed, sizeof *plan->place);
  plan->among = calloc(plan->listed, sizeof *plan->among);
  plan->chosen = calloc(2 * plan->listed, sizeof *plan->chosen);
  if (!plan->place || !plan->among || !plan->chosen) return false;
  plan->even = plan->chosen + plan->listed;
  for (size_t s = 0, next; s < list->sets; s = next) {
    for (next = s + 1; next < list->sets && list->set[next].file == list->set[s].file;)
      next++;
    list_file(plan, &list->set[s], (int)(next - s));
  }
  return true;
}

/* -- results ------------------------------------------------------------------------------------------- */

/* Standard errors of the keys after these measurements => error [keys], SI; of one value each, to 95 %, => half. */
static void find_errors(const Plan *plan, const size_t *chosen, size_t number, double *error, double *half) {
  const ZpSelection *selection = &plan->selection;
  ZpInformation sum = selection->start, covariance;
  double values = 0;
  for (size_t k = 0; k < number; k++) {
    zp_selection_add(selection, chosen[k], 1, &sum);
    values += plan->list.sigma ? 0 : plan->among[chosen[k]].count;
  }
  const bool known = zp_selection_covariance(selection, &sum, &covariance);
  const double shifts = values > 0 ? selection->n - selection->keys : 0;
  const double t = zp_fit_student(fmax(plan->freedom + values - shifts, 1));
  for (int k = 0; k < selection->keys; k++) {
    error[k] = known ? fabs(plan->list.start[k]) * sqrt(covariance.of[k][k]) : (double)NAN;
    half[k] = t * error[k];
  }
}

/* The least number of evenly spaced rows that limit the keys as much; 0: none does. */
static size_t count_even(const Plan *plan, double value) {
  for (size_t number = 1; number <= plan->selection.count; number++) {
    zp_selection_even(&plan->selection, number, plan->even);
    if (zp_selection_value_of(&plan->selection, plan->even, number) >= value) return number;
  }
  return 0;
}

static void report_keys(const Plan *plan, ZpResult *result) {
  static const char *const error_of[] = {"#_standard_error", "#_planned_standard_error", "#_even_standard_error"};
  static const char *const half_of[] = {"#_half_width_95", "#_planned_half_width_95", "#_even_half_width_95"};
  const size_t *const chosen[] = {plan->chosen, plan->chosen, plan->even}, number[] = {0, plan->number, plan->number};
  double error[3][ZP_FIT_KEYS], half[3][ZP_FIT_KEYS];
  zp_selection_even(&plan->selection, plan->number, plan->even);
  for (int i = 0; i < 3; i++)
    find_errors(plan, chosen[i], number[i], error[i], half[i]);
  for (int k = 0; k < plan->selection.keys; k++) {
    const char *name = plan->list.name[k], *unit = plan->list.unit[k];
    zp_result_add_of(result, "#", name, unit, plan->at.z[k] * plan->list.start[k]);
    for (int i = 0; i < 3; i++) {
      zp_result_add_of(result, error_of[i], name, unit, error[i][k]);
      zp_result_add_of(result, half_of[i], name, unit, half[i][k]);
    }
  }
}

static size_t file_of(const Plan *plan, size_t k) {
  return plan->place[k].set->file + 1;
}

static size_t row_of(const Plan *plan, size_t k) {
  return plan->place[k].set->before + plan->place[k].at + 1;
}

static void report_rows(const Plan *plan, ZpResult *result) {
  char number[24];
  for (size_t k = 0; k < plan->number; k++) {
    snprintf(number, sizeof number, "%zu", k + 1);
    zp_result_add_of(result, "file_#", number, "count", (double)file_of(plan, plan->chosen[k]));
    zp_result_add_of(result, "row_#", number, "count", (double)row_of(plan, plan->chosen[k]));
  }
}

/* "4 of 60 rows: 3, 17, 41, 60; relative error 12 % now, 0.41 % after them, 1.2 % after as many even rows"; of several
 * files, "2:17" is row 17 of the second. */
static void say(const Plan *plan, const double *error, ZpResult *result) {
  enum { SHOWN = 5 };
  char rows[SHOWN * 24] = "";
  const bool several = plan->list.set[plan->list.sets - 1].file > 0;
  for (size_t k = 0; k < plan->number && k < SHOWN; k++) {
    const size_t used = strlen(rows), which = plan->chosen[k];
    char file[16] = "";
    if (several) snprintf(file, sizeof file, "%zu:", file_of(plan, which));
    snprintf(rows + used, sizeof rows - used, "%s%s%zu", k ? ", " : "", file, row_of(plan, which));
  }
  snprintf(result->message, sizeof result->message,
           "%zu of %zu rows: %s%s; relative error %.3g %% now, %.3g %% after them, %.3g %% after as many even rows",
           plan->number, plan->listed, rows, plan->number > SHOWN ? ", ..." : "", 100 * error[0], 100 * error[1],
           100 * error[2]);
}

static void note(const Plan *plan, ZpResult *result) {
  const char *const bare[] = {plan->data.bare, plan->list.bare};
  for (int i = 0; i < 2; i++)
    if (*bare[i]) zp_result_note(result, "columns without a unit in their name are read in SI: %s", bare[i]);
  if (!plan->has_data)
    zp_result_note(result, "without data.file each key counts as known to a relative standard error of 100 %%");
  else if (!plan->limited)
    zp_result_note(result,
                   "the data in data.file do not limit all keys, so that each key counts as known to a relative "
                   "standard error of 100 %% beside them");
  if (plan->has_data && !zp_fit_is_noise(&plan->judgement))
    zp_result_note(result, "the model does not fit the data in data.file (see study calibrate), so that the plan is "
                           "for a model that is wrong");
  if (plan->selection.count < plan->listed)
    zp_result_note(result,
                   "rows of plan.candidates without a value at these values of the keys: %zu; they count for "
                   "nothing",
                   plan->listed - plan->selection.count);
  if (*plan->list.idle) zp_result_note(result, "columns that are not used: %s", plan->list.idle);
}

/* -- the table: a row for each chosen measurement -------------------------------------------------------- */

enum { PLACE_COLUMNS = 3, NAME_SIZE = ZP_KEY_COLUMN_SIZE + 24 };

static const ZpColumn first_columns[PLACE_COLUMNS] = {{"rank", "1", "the measurement that tells most is the first"},
                                                      {"file", "1", "number of its file in plan.candidates"},
                                                      {"row", "1", "number of its row in this file"}};
static const ZpColumn last_columns[] = {
    {"gain", "1", "what it adds to the criterion: ln of the determinant (D) or trace (A)"},
    {"share", "1", "its part of the gain of all"},
    {"relative_error", "1", "expected relative standard error of the keys together, after it"},
    {"even_relative_error", "1", "the same after as many evenly spaced rows"}};
enum { LAST_COLUMNS = sizeof last_columns / sizeof last_columns[0] };

/* Its columns in turn: places, what is set, what is predicted, gains, errors of keys. */
typedef struct Columns {
  size_t count, room;
  ZpColumn *column;
  char (*name)[NAME_SIZE];
  int *key;                  /* [count] that the column sets; -1: time; -2: none */
  size_t kind[ZP_FIT_KINDS]; /* the column of a kind; 0: none yet */
  size_t gains, errors;      /* the first ones of these */
} Columns;

static void add_column(Columns *c, int key, const ZpColumn *column) {
  c->key[c->count] = key;
  c->column[c->count++] = *column;
}

static void add_named(Columns *c, int key, const char *before, const char *name, const char *unit, const char *help) {
  char *text = c->name[c->count];
  snprintf(text, sizeof c->name[0], "%s%s", before, name);
  add_column(c, key, &(ZpColumn){text, unit, help});
}

static void add_set(Columns *c, int key) {
  char name[ZP_KEY_COLUMN_SIZE] = "time_s";
  for (size_t i = 0; i < c->count; i++)
    if (c->key[i] == key) return;
  if (key >= 0) zp_key_column(NULL, key, name, sizeof name);
  add_named(c, key, "", name, key < 0 ? "s" : zp_key(key)->unit, "value to set");
}

static void add_sets(const ZpFit *list, Columns *c) {
  for (size_t s = 0; s < list->sets; s++) {
    const ZpFitSet *set = &list->set[s];
    add_set(c, set->x_key);
    for (int i = 0; i < set->others; i++)
      add_set(c, set->other_key[i]);
    for (int i = 0; i < (set->x_key < 0 ? list->run[set->run].keys : 0); i++)
      add_set(c, list->run[set->run].key[i]);
  }
}

static void add_kinds(const ZpFit *list, Columns *c) {
  for (size_t s = 0; s < list->sets; s++) {
    const ZpFitNumber *of = &zp_fit_number[list->set[s].kind];
    char name[64];
    if (c->kind[list->set[s].kind]) continue;
    c->kind[list->set[s].kind] = c->count;
    snprintf(name, sizeof name, "%s_%s", of->column, of->unit);
    add_named(c, -2, "predicted_", name, of->unit, "value that the model expects");
  }
}

static void add_errors(const ZpFit *list, Columns *c) {
  c->errors = c->count;
  for (int k = 0; k < list->keys; k++) {
    char name[ZP_KEY_COLUMN_SIZE];
    zp_key_column(NULL, list->key[k], name, sizeof name);
    add_named(c, -2, "standard_error_", name, list->unit[k], "expected after it");
    add_named(c, -2, "even_standard_error_", name, list->unit[k], "expected after as many evenly spaced rows");
  }
}

static bool open_columns(const ZpFit *list, Columns *c) {
  const size_t room =
      PLACE_COLUMNS + LAST_COLUMNS + list->sets * (2 * ZP_FIT_OTHERS + 2) + ZP_FIT_KINDS + (size_t)2 * ZP_FIT_KEYS;
  *c = (Columns){.room = room};
  c->column = calloc(room, sizeof *c->column);
  c->name = calloc(room, sizeof *c->name);
  c->key = calloc(room, sizeof *c->key);
  if (!c->column || !c->name || !c->key) return false;
  for (int i = 0; i < PLACE_COLUMNS; i++)
    add_column(c, -2, &first_columns[i]);
  add_sets(list, c);
  add_kinds(list, c);
  c->gains = c->count;
  for (int i = 0; i < LAST_COLUMNS; i++)
    add_column(c, -2, &last_columns[i]);
  add_errors(list, c);
  return true;
}

static void put(const Columns *c, int key, double value, double *row) {
  for (size_t i = 0; i < c->count; i++)
    if (c->key[i] == key) row[i] = value;
}

/* The settings of a measurement, and the values that are expected of it. */
static void fill_settings(const Plan *plan, const Columns *c, size_t which, double *row) {
  const ZpFit *list = &plan->list;
  const ZpFitSet *set = plan->place[which].set;
  const size_t at = plan->place[which].at;
  put(c, set->x_key, list->x[set->first + at], row);
  for (int i = 0; i < set->others; i++)
    put(c, set->other_key[i], set->other[i][at], row);
  for (int i = 0; i < (set->x_key < 0 ? list->run[set->run].keys : 0); i++)
    put(c, list->run[set->run].key[i], list->run[set->run].value[i], row);
  for (int i = 0; i < plan->among[which].count; i++)
    row[c->kind[set[i].kind]] = plan->at.fitted[set[i].first + at];
}

/* The expected errors after the first `rank` measurements, and after as many even ones. */
static void fill_errors(const Plan *plan, const Columns *c, size_t rank, double *row) {
  double error[ZP_FIT_KEYS], even[ZP_FIT_KEYS], half[ZP_FIT_KEYS];
  const ZpSelection *selection = &plan->selection;
  zp_selection_even(selection, rank, plan->even);
  find_errors(plan, plan->chosen, rank, error, half);
  find_errors(plan, plan->even, rank, even, half);
  for (int k = 0; k < selection->keys; k++) {
    row[c->errors + 2 * (size_t)k] = error[k];
    row[c->errors + 2 * (size_t)k + 1] = even[k];
  }
  const double before = zp_selection_value_of(selection, plan->chosen, rank - 1),
               after = zp_selection_value_of(selection, plan->chosen, rank);
  const double all =
      zp_selection_value_of(selection, plan->chosen, plan->number) - zp_selection_value(selection, &selection->start);
  double *gain = row + c->gains;
  gain[0] = after - before;
  gain[1] = gain[0] / all;
  gain[2] = zp_selection_error(selection, after);
  gain[3] = zp_selection_error(selection, zp_selection_value_of(selection, plan->even, rank));
}

static bool fill_table(const Plan *plan, ZpResult *result) {
  Columns c;
  double *row = open_columns(&plan->list, &c) ? calloc(c.count, sizeof *row) : NULL;
  if (row) result->series = zp_table_create(c.column, c.count, plan->number < 2 ? 2 : plan->number);
  for (size_t k = 0; row && result->series && k < plan->number; k++) {
    for (size_t i = 0; i < c.count; i++)
      row[i] = NAN;
    row[0] = (double)(k + 1);
    row[1] = (double)file_of(plan, plan->chosen[k]);
    row[2] = (double)row_of(plan, plan->chosen[k]);
    fill_settings(plan, &c, plan->chosen[k], row);
    fill_errors(plan, &c, k + 1, row);
    zp_table_offer(result->series, row);
  }
  free(row);
  free(c.column);
  free(c.name);
  free(c.key);
  return result->series != NULL;
}

/* -- the study ------------------------------------------------------------------------------------------- */

static bool report(Plan *plan, ZpResult *result) {
  const ZpSelection *selection = &plan->selection;
  const double value = zp_selection_value_of(selection, plan->chosen, plan->number);
  report_keys(plan, result);
  const double error[] = {zp_selection_error(selection, zp_selection_value(selection, &selection->start)),
                          zp_selection_error(selection, value),
                          zp_selection_error(selection, zp_selection_value_of(selection, plan->even, plan->number))};
  const size_t even = count_even(plan, value);
  zp_result_add(result, "relative_error", "1", error[0]);
  zp_result_add(result, "planned_relative_error", "1", error[1]);
  zp_result_add(result, "even_relative_error", "1", error[2]);
  zp_result_add(result, "even_rows", "count", even > 0 ? (double)even : (double)NAN);
  zp_result_add(result, "candidates", "count", (double)plan->listed);
  report_rows(plan, result);
  note(plan, result);
  say(plan, error, result);
  const bool noise = !plan->has_data || zp_fit_is_noise(&plan->judgement);
  result->outcome = noise ? ZP_CONVERGED : ZP_DOUBTFUL;
  return fill_table(plan, result) && !result->incomplete;
}

/* There is no plan. */
static ZpStatus give_up(const Plan *plan, const char *why, ZpResult *result) {
  const bool stopped = plan->data.stopped || plan->list.stopped;
  result->outcome = stopped ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(result->message, sizeof result->message, "%s", stopped ? "interrupted" : why);
  return plan->data.status == ZP_OK ? plan->list.status : plan->data.status;
}

static ZpStatus make_plan(Plan *plan, const ZpActuatorDef *def, ZpResult *result, ZpError *err) {
  ZpSelection *selection = &plan->selection;
  if (!fit_data(plan)) return give_up(plan, "the model gives no value for some rows of data.file", result);
  if (plan->has_data && !(plan->judgement.variance > 0))
    return give_up(plan, "the data have no residuals, so the standard deviation is not known", result);
  if (!predict(plan)) return give_up(plan, "interrupted", result);
  if (!list_measurements(plan)) return zp_fail_memory(err);
  if (selection->count == 0) return give_up(plan, "no row of plan.candidates has a value", result);
  *selection = (ZpSelection){.keys = plan->list.keys,
                             .n = plan->list.n,
                             .criterion = def->plan.criterion,
                             .J = plan->at.J,
                             .among = plan->among,
                             .count = selection->count};
  for (int k = 0; k < selection->keys; k++)
    selection->size[k] = zp_fit_size(plan->at.z[k]);
  start_selection(plan);
  plan->number = (size_t)def->plan.budget < selection->count ? (size_t)def->plan.budget : selection->count;
  if (!zp_selection_best(selection, plan->number, plan->chosen)) return zp_fail_memory(err);
  return report(plan, result) ? ZP_OK : zp_fail_memory(err);
}

ZpStatus zp_plan_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err) {
  Plan plan = {.freedom = INFINITY, .judgement = {.variance = 1}};
  ZpStatus status = open_plan(&plan, def, hooks, err);
  ZpResult *result = status == ZP_OK && out ? zp_result_create(ZP_STUDY_PLAN) : NULL;
  if (status == ZP_OK && out) status = result ? make_plan(&plan, def, result, err) : zp_fail_memory(err);
  close_plan(&plan);
  if (result && status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}
