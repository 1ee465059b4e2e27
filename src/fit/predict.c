/* Values of the model for the measured rows, and their derivatives by the parameters: exact ones, if they are
 * available, otherwise finite differences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/rest.h>
#include <zipact/trace.h>

#include "actuator/model.h"
#include "base/fail.h"
#include "def/check.h"
#include "fit/fit.h"
#include "run/hooks.h"
#include "study/result.h"

/* Relative step of the finite differences: far above the tolerance of Newton's method, small enough to neglect the
 * curvature. */
static const double difference = 1e-4;

double zp_fit_size(double z) {
  static const double least = 1e-3;
  return fmax(fabs(z), least);
}

double zp_fit_closing(const ZpModel *model) {
  return model->stroke_by > 0 ? -1 : 1;
}

static double measured_at(ZpRest *rest, ZpFitKind kind) {
  return kind == ZP_FIT_CAPACITANCE ? zp_rest_capacitance(rest)
         : kind == ZP_FIT_OPENING   ? zp_rest_opening(rest)
                                    : zp_rest_stroke(rest);
}

static double measure(ZpFit *fit, ZpFitKind kind, const ZpModel *model, double voltage) {
  ZpRest *rest;
  double value = NAN, start = 0;
  if (zp_rest_create(model, &rest, fit->err) != ZP_OK)
    fit->status = ZP_MACHINE;
  else if (kind == ZP_FIT_DISPLACEMENT)
    start = zp_rest_hang(rest, 0) ? zp_rest_stroke(rest) : (double)NAN;
  if (rest && zp_rest_hang(rest, voltage)) value = measured_at(rest, kind);
  zp_rest_destroy(rest);
  return kind == ZP_FIT_DISPLACEMENT ? zp_fit_closing(model) * (value - start) : value;
}

/* The definition with the fitted keys at z; false if a value is out of its key's range. */
static bool set_fitted(const ZpFit *fit, const double *z, ZpActuatorDef *def) {
  bool set = true;
  *def = *fit->def;
  for (int i = 0; i < fit->keys && set; i++)
    set = zp_def_set(def, fit->key[i], z[i] * fit->start[i], NULL) == ZP_OK;
  return set;
}

static ZpModel *build(ZpFit *fit, const ZpActuatorDef *def) {
  ZpModel *model;
  if (zp_model_create(def, &model, NULL) == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  return model;
}

bool zp_fit_run_def(const ZpFit *fit, const ZpFitRun *run, const double *z, ZpActuatorDef *def) {
  bool set = set_fitted(fit, z, def);
  for (int k = 0; k < run->keys && set; k++)
    set = zp_def_set(def, run->key[k], run->value[k], NULL) == ZP_OK;
  if (run->rows > 0) def->drive.waveform = ZP_WAVEFORM_TABLE;
  if (isnan(def->solver.tolerance)) def->solver.tolerance = fit->tolerance;
  return set;
}

bool zp_fit_row(const ZpFit *fit, const double *z, size_t row, ZpActuatorDef *def, double *voltage) {
  int drive = zp_key_find("drive.voltage");
  const ZpFitSet *of = zp_fit_set_of(fit, row);
  bool set = set_fitted(fit, z, def) && zp_def_set(def, of->x_key, fit->x[row], NULL) == ZP_OK;
  *voltage = of->x_key == drive ? fit->x[row] : 0;
  for (int k = 0; k < of->others && set; k++) {
    const double value = of->other[k][row - of->first];
    set = zp_def_set(def, of->other_key[k], value, NULL) == ZP_OK;
    if (of->other_key[k] == drive) *voltage = value;
  }
  return set;
}

static void name_keys(const ZpFit *fit, ZpActuatorDef *def) {
  char *text = def->sensitivity.by;
  size_t size = sizeof def->sensitivity.by, used = 0;
  for (int k = 0; k < fit->keys && used < size; k++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", k ? "," : "", ZP_KEY_NAME(fit->key[k]));
}

/* Of runs with derivatives, so that those are of the values. */
static double tolerance_of(const ZpFit *fit, ZpActuatorDef def) {
  name_keys(fit, &def);
  return zp_def_tolerance(&def);
}

/* The result of the study whose number is measured; NULL if it cannot be run. */
static ZpResult *run_study(ZpFit *fit, ZpFitKind kind, ZpActuatorDef *def) {
  ZpResult *result = NULL;
  def->output.samples = 10; /* only the numbers are needed */
  def->output.shapes = 2;
  def->output.errors = false;
  def->solver.stop_when_zipped = ZP_WHEN_TRUE; /* of a motion only the zip time */
  if (kind == ZP_FIT_TIME && fit->keys > 0) def->solver.tolerance = tolerance_of(fit, *def);
  ZpStatus status = zp_study_run(zp_fit_number[kind].study, def, NULL, NULL, &result, NULL);
  if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  return result;
}

double zp_fit_predict(ZpFit *fit, const double *z, size_t row) {
  ZpActuatorDef def;
  double voltage;
  const ZpFitKind kind = zp_fit_set_of(fit, row)->kind;
  bool set = zp_fit_row(fit, z, row, &def, &voltage);
  const bool is_number = zp_fit_number[kind].number != NULL;
  ZpResult *result = set && is_number ? run_study(fit, kind, &def) : NULL;
  ZpModel *model = set && !is_number ? build(fit, &def) : NULL;
  double value = result  ? zp_result_get(result, zp_fit_number[kind].number)
                 : model ? measure(fit, kind, model, voltage)
                         : (double)NAN;
  zp_result_destroy(result);
  zp_model_destroy(model);
  return value;
}

static bool ask(ZpFit *fit) {
  double fraction = 1 - 1 / (1 + 0.02 * fit->evaluations);
  if (zp_hooks_stop(fit->hooks, "fitting", fraction)) fit->stopped = true;
  return fit->stopped || fit->status != ZP_OK;
}

/* Values of the model at z for the rows of a set at rest => fitted [its rows]. */
static void predict_set(ZpFit *fit, const ZpFitSet *of, const double *z, double *fitted) {
  for (size_t i = 0; i < of->rows; i++)
    fitted[i] = ask(fit) ? NAN : zp_fit_predict(fit, z, of->first + i);
}

/* -- records ---------------------------------------------------------------------------------------- */

static double value_of(int parameter, const ZpFit *fit, const double *z) {
  return parameter < 0 ? 0 : z[parameter] * fit->start[parameter];
}

/* Time of the run at a row of a record. */
static double run_time(const ZpFit *fit, const ZpFitRun *run, const double *z, size_t row) {
  return fit->x[row] - run->from - value_of(run->late, fit, z);
}

/* File time of the last row that counts. */
static double horizon_of(const ZpFit *fit, const ZpFitRun *run) {
  return run->closing + fit->horizon * (run->last - run->closing);
}

bool zp_fit_is_beyond(const ZpFit *fit, const ZpFitSet *of, size_t row) {
  return of->x_key < 0 && fit->horizon < 1 && fit->x[row] > horizon_of(fit, &fit->run[of->run]);
}

static double end_of(const ZpFit *fit, size_t which, const double *z) {
  double end = 0;
  for (size_t i = 0; i < fit->sets; i++) {
    const ZpFitSet *of = &fit->set[i];
    size_t row = of->first + of->rows;
    if (of->x_key >= 0 || of->run != which) continue;
    while (row > of->first + 1 && zp_fit_is_beyond(fit, of, row - 1))
      row--;
    end = fmax(end, run_time(fit, &fit->run[which], z, row - 1));
  }
  return end;
}

static const char *signal_of_kind(ZpFitKind kind) {
  return kind == ZP_FIT_DISPLACEMENT ? "stroke" : zp_fit_number[kind].column;
}

/* The rows of a set => fitted, and rows of J. `closing`: sign of a change of the stroke as the actuator closes. */
static void read_trace(const ZpFit *fit, const ZpFitSet *of, const double *z, const ZpTrace *trace, size_t signal,
                       double closing, double *fitted, double *J) {
  const ZpFitRun *run = &fit->run[of->run];
  const bool change = of->kind == ZP_FIT_DISPLACEMENT;
  const double sign = change ? closing : 1;
  const ZpTraceValue start = change ? zp_trace_at(trace, signal, 0) : (ZpTraceValue){0};
  for (size_t i = of->first; i < of->first + of->rows; i++) {
    const ZpTraceValue at = zp_trace_at(trace, signal, run_time(fit, run, z, i));
    fitted[i] = sign * (at.value - start.value) + value_of(of->zero, fit, z);
    if (!J) continue;
    double *row = J + i * (size_t)fit->n;
    memset(row, 0, (size_t)fit->n * sizeof *row);
    for (int k = 0; k < fit->keys; k++)
      row[k] = fit->slopes != ZP_FIT_EXACT ? NAN : sign * (at.by_key[k] - start.by_key[k]) * fit->start[k];
    if (run->late >= 0) row[run->late] = -sign * at.rate * fit->start[run->late];
    if (of->zero >= 0) row[of->zero] = fit->start[of->zero];
  }
}

/* The rows of all sets of a record have no value. */
static void miss_run(const ZpFit *fit, size_t which, double *fitted) {
  for (size_t i = 0; i < fit->sets; i++) {
    const ZpFitSet *of = &fit->set[i];
    for (size_t row = of->first; of->x_key < 0 && of->run == which && row < of->first + of->rows; row++)
      fitted[row] = NAN;
  }
}

/* The rows of a record => fitted, and rows of J. */
static void follow_run(ZpFit *fit, size_t which, const double *z, double *fitted, double *J) {
  const ZpFitRun *record = &fit->run[which];
  const ZpDriveTable table = {record->rows, record->time, record->voltage};
  const double end = fmax(end_of(fit, which, z), 1e-9);
  const char *signal[ZP_TRACE_SIGNALS];
  size_t signals = 0;
  const size_t keys = J && fit->slopes == ZP_FIT_EXACT ? (size_t)fit->keys : 0;
  ZpActuatorDef def;
  ZpModel *model = NULL;
  ZpTrace *trace = NULL;
  for (size_t i = 0; i < fit->sets; i++)
    if (fit->set[i].x_key < 0 && fit->set[i].run == which) signal[signals++] = signal_of_kind(fit->set[i].kind);
  miss_run(fit, which, fitted);
  ZpStatus status = zp_fit_run_def(fit, record, z, &def) ? ZP_OK : ZP_BAD_INPUT;
  def.solver.end_time = end;
  if (status == ZP_OK) status = zp_model_create_driven(&def, record->rows > 0 ? &table : NULL, &model, NULL);
  if (status == ZP_OK) status = zp_trace_create(model, signal, signals, fit->key, keys, end, fit->hooks, &trace, NULL);
  if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  size_t k = 0;
  for (size_t i = 0; i < fit->sets && trace; i++) {
    const ZpFitSet *of = &fit->set[i];
    if (of->x_key < 0 && of->run == which) read_trace(fit, of, z, trace, k++, zp_fit_closing(model), fitted, J);
  }
  zp_trace_destroy(trace);
  zp_model_destroy(model);
}

static double weight(const ZpFit *fit, size_t row) {
  return fit->sigma ? 1 / fit->sigma[row] : 1;
}

double zp_fit_residual(const ZpFit *fit, const double *fitted, size_t row) {
  return (fitted[row] - fit->y[row]) * weight(fit, row);
}

/* Sum of squares. A row without a value counts as twice the largest measured value of its set. */
double zp_fit_square(const ZpFit *fit, const double *fitted) {
  double sum = 0;
  for (size_t k = 0; k < fit->sets; k++) {
    const ZpFitSet *of = &fit->set[k];
    double largest = 0;
    for (size_t i = of->first; i < of->first + of->rows; i++)
      largest = fmax(largest, fabs(fit->y[i]));
    for (size_t i = of->first; i < of->first + of->rows; i++) {
      if (zp_fit_is_beyond(fit, of, i)) continue;
      double r = isfinite(fitted[i]) ? zp_fit_residual(fit, fitted, i) : 2 * largest * weight(fit, i);
      sum += r * r;
    }
  }
  return sum;
}

/* -- derivatives at rest ---------------------------------------------------------------------------- */

/* Derivatives of a stroke or an opening with respect to a fitted key, where `rest` hangs. */
static double slope_of(ZpFit *fit, ZpRest *rest, ZpFitKind kind, int key) {
  double stroke, opening;
  ZpStatus status = zp_rest_sensitivity(rest, key, &stroke, &opening, NULL);
  if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  return status != ZP_OK ? (double)NAN : kind == ZP_FIT_OPENING ? opening : stroke;
}

/* The value of a row at rest, and its derivatives with respect to all fitted keys => row [keys]; false if one of them
 * is not available. */
static bool slopes_of_rest(ZpFit *fit, ZpFitKind kind, const ZpActuatorDef *def, double voltage, double *value,
                           double *row) {
  ZpModel *model = build(fit, def);
  ZpRest *rest = NULL;
  const bool change = kind == ZP_FIT_DISPLACEMENT;
  if (model && zp_rest_create(model, &rest, fit->err) != ZP_OK) fit->status = ZP_MACHINE;
  double start = 0, slope[ZP_FIT_KEYS] = {0}, sign = change && model ? zp_fit_closing(model) : 1;
  bool good = rest && (!change || zp_rest_hang(rest, 0));
  if (good && change) start = zp_rest_stroke(rest);
  for (int k = 0; k < fit->keys && good && change; k++)
    slope[k] = slope_of(fit, rest, kind, fit->key[k]);
  good = good && zp_rest_hang(rest, voltage);
  if (good) *value = sign * (measured_at(rest, kind) - start);
  for (int k = 0; k < fit->keys && good; k++) {
    row[k] = sign * (slope_of(fit, rest, kind, fit->key[k]) - slope[k]);
    good = isfinite(row[k]);
  }
  zp_rest_destroy(rest);
  zp_model_destroy(model);
  return good;
}

/* Likewise of the number of a study. */
static bool slopes_of_number(ZpFit *fit, ZpFitKind kind, ZpActuatorDef *def, double *value, double *row) {
  int found = 0;
  name_keys(fit, def);
  ZpResult *result = run_study(fit, kind, def);
  if (result) *value = zp_result_get(result, zp_fit_number[kind].number);
  for (size_t i = 0; result && i < result->sensitivities && found < fit->keys; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (strcmp(s->output, zp_fit_number[kind].number) == 0) row[found++] = s->value;
  }
  zp_result_destroy(result);
  for (int k = 0; k < found; k++)
    if (!isfinite(row[k])) return false;
  return found == fit->keys;
}

/* A row with exact derivatives => value, row [n] of J; false if they are not available. */
static bool differentiate(ZpFit *fit, const ZpFitSet *of, const double *z, size_t i, double *value, double *row) {
  const ZpFitNumber *number = &zp_fit_number[of->kind];
  ZpActuatorDef def;
  double voltage;
  if (!number->has_slopes || fit->keys == 0 || !zp_fit_row(fit, z, i, &def, &voltage)) return false;
  const bool good = number->number ? slopes_of_number(fit, of->kind, &def, value, row)
                                   : slopes_of_rest(fit, of->kind, &def, voltage, value, row);
  for (int k = 0; k < fit->keys && good; k++)
    row[k] *= fit->start[k];
  return good;
}

/* A row with derivatives by finite differences, 0 where there are none. */
static void differ(ZpFit *fit, const double *z, size_t i, double *value, double *row) {
  *value = zp_fit_predict(fit, z, i);
  for (int k = 0; k < fit->keys && isfinite(*value) && !ask(fit); k++) {
    double at[ZP_FIT_MOST];
    memcpy(at, z, sizeof at);
    const double step = difference * zp_fit_size(z[k]);
    const double high = at[k] = fmin(z[k] + step, fit->upper[k]), low = fmax(z[k] - step, fit->lower[k]);
    const double up = zp_fit_predict(fit, at, i);
    at[k] = low;
    row[k] = (up - zp_fit_predict(fit, at, i)) / (high - low);
  }
}

/* Values of a set at rest, and their derivatives => fitted, rows of J. => whether there were differences. */
static bool differentiate_set(ZpFit *fit, const ZpFitSet *of, const double *z, double *fitted, double *J) {
  bool differed = false;
  memset(J, 0, of->rows * (size_t)fit->n * sizeof *J);
  for (size_t i = 0; i < of->rows; i++) {
    double *row = J + i * (size_t)fit->n;
    fitted[i] = NAN;
    if (ask(fit) || differentiate(fit, of, z, of->first + i, &fitted[i], row)) continue;
    differed = true;
    differ(fit, z, of->first + i, &fitted[i], row);
  }
  for (size_t i = 0; i < of->rows && of->zero >= 0; i++)
    J[i * (size_t)fit->n + (size_t)of->zero] = fit->start[of->zero];
  return differed;
}

/* Has the record a value in some row whose derivative by some key is missing? */
static bool lacks_slope(const ZpFit *fit, size_t which, const double *fitted, const double *J) {
  for (size_t s = 0; s < fit->sets; s++) {
    const ZpFitSet *of = &fit->set[s];
    for (size_t i = of->first; of->x_key < 0 && of->run == which && i < of->first + of->rows; i++)
      for (int k = 0; k < fit->keys; k++)
        if (isfinite(fitted[i]) && !isfinite(J[i * (size_t)fit->n + (size_t)k])) return true;
  }
  return false;
}

/* The part of a step from z, at most 1, that is within the bounds. */
static double part_within(const ZpFit *fit, const double *z, int way, double sign) {
  double part = 1;
  for (int k = 0; k < fit->keys; k++) {
    const double step = sign * fit->way[k][way], room = step > 0 ? fit->upper[k] - z[k] : z[k] - fit->lower[k];
    if (fabs(step) > room) part = fmin(part, room / fabs(step));
  }
  return part;
}

/* A run at a part of a step from z => its values. */
static void follow_along(ZpFit *fit, size_t which, const double *z, int way, double part, double *values) {
  double at[ZP_FIT_MOST];
  memcpy(at, z, sizeof at);
  for (int k = 0; k < fit->keys; k++)
    at[k] += part * fit->way[k][way];
  fit->evaluations++;
  follow_run(fit, which, at, values, NULL);
}

/* Changes of the values along a way, whose rows of J have those of all ways behind it: D = J W, where W is a lower
 * triangle. */
static void set_slopes(const ZpFit *fit, size_t which, int way, const double *up, const double *down, double parts,
                       double *J) {
  for (size_t s = 0; s < fit->sets; s++) {
    const ZpFitSet *of = &fit->set[s];
    for (size_t i = of->first; of->x_key < 0 && of->run == which && i < of->first + of->rows; i++) {
      double *row = J + i * (size_t)fit->n, change = (up[i] - down[i]) / parts;
      for (int k = way + 1; k < fit->keys; k++)
        change -= row[k] * fit->way[k][way];
      row[way] = change / fit->way[way][way];
    }
  }
}

/* The keys' derivatives of a record by finite differences of whole runs. One-sided ones go to the side where more of
 * the step is within the bounds. */
static bool difference_run(ZpFit *fit, size_t which, const double *z, const double *fitted, double *J) {
  double *up = calloc(2 * fit->rows, sizeof *up), *down = up ? up + fit->rows : NULL;
  if (!up) fit->status = zp_fail_memory(fit->err);
  for (int way = fit->keys; way-- > 0 && up && !ask(fit);) {
    double high = part_within(fit, z, way, 1), low = part_within(fit, z, way, -1);
    if (fit->slopes == ZP_FIT_ONE_SIDED) *(high < low ? &high : &low) = 0;
    if (high > 0) follow_along(fit, which, z, way, high, up);
    if (low > 0) follow_along(fit, which, z, way, -low, down);
    set_slopes(fit, which, way, high > 0 ? up : fitted, low > 0 ? down : fitted, high + low, J);
  }
  const bool good = up && !fit->stopped && fit->status == ZP_OK;
  free(up);
  return good;
}

static bool follow_record(ZpFit *fit, size_t which, const double *z, double *fitted, double *J) {
  if (ask(fit)) return false;
  follow_run(fit, which, z, fitted, J);
  const bool differs = J && fit->keys > 0 && lacks_slope(fit, which, fitted, J);
  return differs ? difference_run(fit, which, z, fitted, J) : fit->status == ZP_OK;
}

/* -- all rows --------------------------------------------------------------------------------------- */

bool zp_fit_evaluate(ZpFit *fit, const double *z, double *fitted, double *J) {
  bool all = true, good = true, differed = false;
  fit->evaluations++;
  for (size_t which = 0; which < fit->runs && good; which++)
    good = follow_record(fit, which, z, fitted, J);
  for (size_t s = 0; s < fit->sets && good; s++) {
    const ZpFitSet *of = &fit->set[s];
    if (of->x_key < 0) continue;
    if (J)
      differed |= differentiate_set(fit, of, z, fitted + of->first, J + of->first * (size_t)fit->n);
    else
      predict_set(fit, of, z, fitted + of->first);
    for (size_t i = of->first; i < of->first + of->rows; i++)
      fitted[i] += value_of(of->zero, fit, z);
  }
  if (differed) fit->evaluations += 2 * fit->keys;
  for (size_t i = 0; i < fit->rows; i++) {
    all &= isfinite(fitted[i]) || zp_fit_is_beyond(fit, zp_fit_set_of(fit, i), i);
    for (int k = 0; k < fit->n && J; k++) {
      double *entry = &J[i * (size_t)fit->n + (size_t)k];
      *entry = isfinite(*entry) && isfinite(fitted[i]) ? *entry * weight(fit, i) : 0;
    }
  }
  return good && all && !fit->stopped && fit->status == ZP_OK;
}
