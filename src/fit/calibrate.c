/* Study `calibrate`: keys fitted to measurements. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fail.h"
#include "fit/fit.h"

/* Names for summary.json that are made from those of the keys, and the columns of the table by the key that is x. */
typedef struct Names {
  const char *error;
  const char *correlation[ZP_FIT_MOST - 1]; /* with the first, second, ... key of calibrate.fit */
  ZpColumn column[ZP_FIT_KINDS][4];
} Names;

#define ZP_GROUP(group)
#define ZP_GROUP_END(group)
#define TABLE(x, unit, help, of, what, computed)                                                                       \
  {                                                                                                                    \
    {x, unit, help}, {"measured_" of, of, what " in data.file"}, {"fitted_" of, of, computed},                         \
        {"residual_" of, of, "fitted minus measured"},                                                                 \
  }
#define TABLE_OF_NUMBER(key, unit, of, what, number, none)                                                             \
  TABLE(key "_" unit, unit, "value set on the bench", of, what, number ", computed with the fitted values; nan: " none)
#define NAMES(key, unit)                                                                                               \
  {key "_standard_error",                                                                                              \
   {key "_correlation_1", key "_correlation_2", key "_correlation_3", key "_correlation_4"},                           \
   {[ZP_FIT_LENGTH] = TABLE_OF_NUMBER(key, unit, "m", "stroke or opening", "the same", "no equilibrium"),              \
    [ZP_FIT_CAPACITANCE] = TABLE_OF_NUMBER(key, unit, "F", "capacitance", "the same", "no equilibrium"),               \
    [ZP_FIT_FORCE] = TABLE_OF_NUMBER(key, unit, "N", "force", "force_N of study isometric", "no equilibrium"),         \
    [ZP_FIT_TIME] = TABLE_OF_NUMBER(key, unit, "s", "zip time", "zip_time_s of study actuate", "not closed"),          \
    [ZP_FIT_PULL_IN] =                                                                                                 \
        TABLE_OF_NUMBER(key, unit, "V", "pull-in voltage", "pull_in_voltage_V of study limits", "no pull-in"),         \
    [ZP_FIT_RELEASE] =                                                                                                 \
        TABLE_OF_NUMBER(key, unit, "V", "release voltage", "release_voltage_V of study limits", "no release"),         \
    [ZP_FIT_FREQUENCY] =                                                                                               \
        TABLE_OF_NUMBER(key, unit, "Hz", "frequency", "frequency_1_Hz of study modes", "no stable equilibrium")}},
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           NAMES(#path #name, unit)
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) NAMES(#path #name, unit)
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           NAMES(#path #name, unit)
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           NAMES(#path #name, unit)
#define ZP_INT(path, name, def, min, max, help)                         NAMES(#path #name, "1")
#define ZP_BOOL(path, name, def, help)                                  NAMES(#path #name, "1")
#define ZP_ENUM(path, name, type, def, help)                            NAMES(#path #name, "1")
#define ZP_TEXT(path, name, def, help)                                  NAMES(#path #name, "1")
#define ZP_OF_SCENARIO(name, type, def, help)                           NAMES(#name, "1")
static const Names names[] = {
#include <zipact/keys.def>
};

/* Inverse of J^T J in units of z, by Cholesky; false if the data do not tell the keys apart. */
static bool covariance(const ZpFit *fit, const double *J, double C[ZP_FIT_MOST][ZP_FIT_MOST]) {
  int n = fit->n;
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}, M[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}};
  for (int a = 0; a < n; a++)
    for (int b = 0; b <= a; b++) {
      double sum = 0, whole = 0;
      for (size_t i = 0; i < fit->rows; i++)
        sum += J[i * (size_t)n + (size_t)a] * J[i * (size_t)n + (size_t)b];
      whole = sum;
      for (int k = 0; k < b; k++)
        sum -= L[a][k] * L[b][k];
      if (a == b && !(sum > 1e-10 * whole)) return false;
      L[a][b] = a == b ? sqrt(sum) : sum / L[b][b];
    }
  for (int a = 0; a < n; a++) /* M = L^-1 */
    for (int b = 0; b <= a; b++) {
      double sum = a == b;
      for (int k = b; k < a; k++)
        sum -= L[a][k] * M[k][b];
      M[a][b] = sum / L[a][a];
    }
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++) {
      C[a][b] = 0;
      for (int k = a > b ? a : b; k < n; k++)
        C[a][b] += M[k][a] * M[k][b];
    }
  return true;
}

static bool at_bound(const ZpFit *fit, const double *z, int k) {
  return z[k] <= fit->lower[k] * (1 + 1e-6) || z[k] >= fit->upper[k] * (1 - 1e-6);
}

/* The first key at a bound; NULL if there is none. */
static const char *key_at_bound(const ZpFit *fit, const double *z) {
  for (int k = 0; k < fit->n; k++)
    if (at_bound(fit, z, k)) return zp_key(fit->key[k])->name;
  return NULL;
}

/* What the summary says of the keys; `square`: sum of squared weighted residuals. */
static void report_keys(const ZpFit *fit, const double *z, const double *J, double square, ZpResult *result) {
  double C[ZP_FIT_MOST][ZP_FIT_MOST];
  bool told_apart = J && covariance(fit, J, C);
  size_t n = (size_t)fit->n;
  double reduced = fit->rows > n ? square / (double)(fit->rows - n) : NAN;
  double variance = fit->sigma ? 1 : reduced; /* of a weighted residual */
  for (int k = 0; k < fit->n; k++) {
    const ZpKey *key = zp_key(fit->key[k]);
    bool known = told_apart && !at_bound(fit, z, k);
    zp_result_add(result, key->name, key->unit, z[k] * fit->start[k]);
    zp_result_add(result, names[fit->key[k]].error, key->unit,
                  known ? fabs(fit->start[k]) * sqrt(variance * C[k][k]) : NAN);
    for (int j = 0; j < k; j++)
      zp_result_add(result, names[fit->key[k]].correlation[j], "1",
                    told_apart ? C[k][j] / sqrt(C[k][k] * C[j][j]) : NAN);
    if (at_bound(fit, z, k))
      zp_result_note(result, "%s is at a bound of its range: it has no standard error", key->name);
  }
  if (fit->sigma) zp_result_add(result, "reduced_chi_square", "1", reduced);
  if (!told_apart && n > 0)
    zp_result_note(result, "the data cannot distinguish the fitted keys: they have no standard errors");
}

#define TABLE_OVER_TIME(of, what)                                                                                      \
  TABLE("time_s", "s", "time since the voltage was switched on", of, what, "the same, computed with the fitted values")

static const ZpColumn length_over_time[4] = TABLE_OVER_TIME("m", "stroke or opening"),
                      capacitance_over_time[4] = TABLE_OVER_TIME("F", "capacitance");

static const ZpColumn *columns_of(const ZpFit *fit) {
  if (fit->x_key >= 0) return names[fit->x_key].column[fit->kind];
  return fit->kind == ZP_FIT_CAPACITANCE ? capacitance_over_time : length_over_time;
}

static bool fill_table(const ZpFit *fit, const double *fitted, ZpResult *result) {
  result->series = zp_table_create(columns_of(fit), 4, fit->rows < 2 ? 2 : fit->rows);
  if (!result->series) return false;
  for (size_t i = 0; i < fit->rows; i++)
    zp_table_offer(result->series, (double[]){fit->x[i], fit->y[i], fitted[i], fitted[i] - fit->y[i]});
  return true;
}

/* The notes of the model as fitted, at the highest voltage of all rows. */
static ZpStatus note(const ZpFit *fit, const double *z, ZpResult *result, ZpError *err) {
  ZpActuatorDef def = *fit->def, row;
  double highest = fit->x_key < 0 ? fmax(def.drive.voltage, fabs(def.drive.offset)) : -1, voltage;
  for (size_t i = 0; i < fit->rows && fit->x_key >= 0; i++) {
    if (!zp_fit_row(fit, z, i, &row, &voltage)) continue;
    if (zp_fit_number[fit->kind].number)
      voltage = fit->kind == ZP_FIT_FREQUENCY ? row.modes.voltage : row.drive.voltage;
    if (voltage <= highest) continue;
    highest = voltage;
    def = row;
  }
  ZpModel *model;
  if (zp_model_create(&def, &model, err) == ZP_MACHINE) return ZP_MACHINE;
  if (model) zp_result_note_model(result, model, fmax(highest, 0));
  zp_model_destroy(model);
  return ZP_OK;
}

/* By kind: name of what is left, and how the message says it. */
static const struct {
  const char *residual, *shown;
  double factor;
} of_kind[ZP_FIT_KINDS] = {
    [ZP_FIT_LENGTH] = {"residual_rms_m", "mm", 1e3},   [ZP_FIT_CAPACITANCE] = {"residual_rms_F", "pF", 1e12},
    [ZP_FIT_FORCE] = {"residual_rms_N", "mN", 1e3},    [ZP_FIT_TIME] = {"residual_rms_s", "ms", 1e3},
    [ZP_FIT_PULL_IN] = {"residual_rms_V", "V", 1},     [ZP_FIT_RELEASE] = {"residual_rms_V", "V", 1},
    [ZP_FIT_FREQUENCY] = {"residual_rms_Hz", "Hz", 1},
};

/* The static pull-in of the model as fitted, of the last row: zip times just above it show where it is. */
static ZpStatus note_pull_in(const ZpFit *fit, const double *z, ZpResult *result) {
  ZpActuatorDef def;
  ZpResult *limits = NULL;
  double voltage;
  zp_fit_row(fit, z, fit->rows - 1, &def, &voltage);
  def.output.errors = false;
  ZpStatus status = zp_study_run(ZP_STUDY_LIMITS, &def, NULL, NULL, &limits, NULL);
  zp_result_add(result, "pull_in_voltage_V", "V", limits ? zp_result_get(limits, "pull_in_voltage_V") : NAN);
  zp_result_destroy(limits);
  return status == ZP_MACHINE ? status : ZP_OK;
}

static ZpStatus solve_and_report(ZpFit *fit, double *fitted, double *J, ZpResult *result, ZpError *err) {
  double z[ZP_FIT_MOST] = {0}, square = 0, weighted = 0;
  for (int k = 0; k < fit->n; k++)
    z[k] = fmin(fmax(1, fit->lower[k]), fit->upper[k]);
  if (!zp_fit_solve(fit, z, fitted) && fit->status != ZP_OK) return fit->status;
  for (size_t i = 0; i < fit->rows; i++) {
    square += (fitted[i] - fit->y[i]) * (fitted[i] - fit->y[i]);
    weighted += zp_fit_residual(fit, fitted, i) * zp_fit_residual(fit, fitted, i);
  }
  const char *bound = key_at_bound(fit, z);
  bool good = isfinite(square) && !fit->stopped;
  bool has_J = good && zp_fit_jacobian(fit, z, J);
  if (fit->status != ZP_OK) return fit->status;
  result->outcome = good ? (bound ? ZP_AT_BOUND : ZP_CONVERGED) : fit->stopped ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  double rms = isfinite(square) ? sqrt(square / (double)fit->rows) : NAN;
  if (good)
    snprintf(result->message, sizeof result->message, "%zu rows %s, residual %.3g %s rms%s%s", fit->rows,
             fit->n > 0 ? "fitted" : "compared", of_kind[fit->kind].factor * rms, of_kind[fit->kind].shown,
             bound ? "; at its bound: " : "", bound ? bound : "");
  else
    snprintf(result->message, sizeof result->message,
             fit->stopped ? "interrupted" : "the model gives no value for some rows within the bounds");
  report_keys(fit, z, has_J ? J : NULL, weighted, result);
  if (note(fit, z, result, err) != ZP_OK) return ZP_MACHINE;
  if (good && fit->kind == ZP_FIT_TIME && note_pull_in(fit, z, result) != ZP_OK) return zp_fail_memory(err);
  zp_result_add(result, of_kind[fit->kind].residual, zp_fit_number[fit->kind].unit, rms);
  zp_result_add(result, "data_rows", "count", (double)fit->rows);
  zp_result_add(result, "evaluations", "count", fit->evaluations);
  return fill_table(fit, fitted, result) ? ZP_OK : zp_fail_memory(err);
}

ZpStatus zp_fit_check(const ZpActuatorDef *def, ZpError *err) {
  ZpFit fit;
  ZpStatus status = zp_fit_open(def, &fit, err);
  zp_fit_close(&fit);
  return status;
}

ZpStatus zp_fit_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err) {
  ZpFit fit;
  ZpStatus status = zp_fit_open(def, &fit, err);
  fit.hooks = hooks;
  ZpResult *result = status == ZP_OK ? zp_result_create(ZP_STUDY_CALIBRATE) : NULL;
  double *fitted = status == ZP_OK ? calloc(fit.rows, sizeof *fitted) : NULL;
  double *J = status == ZP_OK ? calloc(fit.rows * (size_t)(fit.n + 1), sizeof *J) : NULL;
  if (status == ZP_OK && (!result || !fitted || !J)) status = zp_fail_memory(err);
  if (status == ZP_OK) status = solve_and_report(&fit, fitted, J, result, err);
  free(fitted);
  free(J);
  zp_fit_close(&fit);
  if (status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}
