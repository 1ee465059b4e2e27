/* Least squares. NLopt's COBYLA first approaches the minimum within the bounds; it needs no derivatives and tolerates
 * trial values without an equilibrium. Gauss-Newton then converges to the minimum, with exact derivatives of equilibria
 * if they are available, otherwise with finite differences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <nlopt.h>
#include <zipact/rest.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/fit.h"
#include "run/hooks.h"
#include "study/result.h"

enum { POLISH_MOST = 30, HALVINGS = 12 };

/* Relative step of the finite differences: far above the tolerance of Newton's method, small enough to neglect the
 * curvature. */
static const double difference = 1e-4;

/* Size of a key with which its changes are compared, in multiples of its start. The key may be negative or pass 0. */
static double size_of(double z) {
  static const double least = 1e-3;
  return fmax(fabs(z), least);
}

static double measure(ZpFit *fit, ZpFitKind kind, const ZpModel *model, double voltage) {
  ZpRest *rest;
  double value = NAN;
  if (zp_rest_create(model, &rest, fit->err) != ZP_OK)
    fit->status = ZP_MACHINE;
  else if (zp_rest_hang(rest, voltage))
    value = kind == ZP_FIT_CAPACITANCE ? zp_rest_capacitance(rest)
            : kind == ZP_FIT_OPENING   ? zp_rest_opening(rest)
                                       : zp_rest_stroke(rest);
  zp_rest_destroy(rest);
  return value;
}

/* The definition with the fitted keys at z; false if a value is out of its key's range. */
static bool set_fitted(const ZpFit *fit, const double *z, ZpActuatorDef *def) {
  bool set = true;
  *def = *fit->def;
  for (int i = 0; i < fit->n && set; i++)
    set = zp_def_set(def, fit->key[i], z[i] * fit->start[i], NULL) == ZP_OK;
  return set;
}

static ZpModel *build(ZpFit *fit, const ZpActuatorDef *def) {
  ZpModel *model;
  if (zp_model_create(def, &model, NULL) == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  return model;
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
  for (int k = 0; k < fit->n && used < size; k++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", k ? "," : "", ZP_KEY_NAME(fit->key[k]));
}

/* Of runs with derivatives, so that those are of the values; a search before them has coarser steps. */
static double tolerance_of(const ZpFit *fit, ZpActuatorDef def) {
  if (!fit->searches) name_keys(fit, &def);
  return zp_def_tolerance(&def);
}

/* The result of the study whose number is measured; NULL if it cannot be run. */
static ZpResult *run_study(ZpFit *fit, ZpFitKind kind, ZpActuatorDef *def) {
  ZpResult *result = NULL;
  def->output.samples = 10; /* only the numbers are needed */
  def->output.shapes = 2;
  def->output.errors = false;
  def->solver.stop_when_zipped = ZP_WHEN_TRUE; /* of a motion only the zip time */
  if (kind == ZP_FIT_TIME && fit->n > 0) def->solver.tolerance = tolerance_of(fit, *def);
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

/* One run in time over all rows of a set => fitted [its rows]; NAN after the solver fails. */
static void predict_run(ZpFit *fit, const ZpFitSet *of, const double *z, double *fitted) {
  ZpActuatorDef def;
  bool set = set_fitted(fit, z, &def), runs;
  ZpModel *model = set ? build(fit, &def) : NULL;
  ZpSim *sim = NULL;
  ZpStatus status = model ? zp_sim_create(model, NULL, &sim, NULL) : ZP_BAD_INPUT;
  runs = status == ZP_OK;
  if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  for (size_t i = 0; i < of->rows; i++) {
    const double time = fit->x[of->first + i];
    if (runs && time > 0) runs = zp_outcome_good(zp_sim_run(sim, time, false, fit->hooks, NULL));
    fitted[i] = runs ? zp_sim_get(sim, zp_fit_number[of->kind].column) : (double)NAN;
  }
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}

static bool ask(ZpFit *fit) {
  double fraction = 1 - 1 / (1 + 0.02 * fit->evaluations);
  if (zp_hooks_stop(fit->hooks, "fitting", fraction)) fit->stopped = true;
  return fit->stopped || fit->status != ZP_OK;
}

/* Values of the model at z for the rows of a set => fitted [its rows]; false if one of them does not exist. */
static bool predict_set(ZpFit *fit, const ZpFitSet *of, const double *z, double *fitted) {
  bool all = true;
  if (of->x_key < 0 && !ask(fit)) predict_run(fit, of, z, fitted);
  for (size_t i = 0; i < of->rows; i++) {
    if (of->x_key >= 0 || fit->stopped) fitted[i] = ask(fit) ? NAN : zp_fit_predict(fit, z, of->first + i);
    all &= isfinite(fitted[i]) != 0;
  }
  return all;
}

/* Fitted values at z; false if one of them does not exist. */
static bool predict_all(ZpFit *fit, const double *z, double *fitted) {
  bool all = true;
  fit->evaluations++;
  for (size_t i = 0; i < fit->sets; i++)
    all &= predict_set(fit, &fit->set[i], z, fitted + fit->set[i].first);
  return all;
}

static double weight(const ZpFit *fit, size_t row) {
  return fit->sigma ? 1 / fit->sigma[row] : 1;
}

double zp_fit_residual(const ZpFit *fit, const double *fitted, size_t row) {
  return (fitted[row] - fit->y[row]) * weight(fit, row);
}

/* Sum of squares. A row without a value counts as twice the largest measured value of its set. */
static double squares(const ZpFit *fit, const double *fitted) {
  double sum = 0;
  for (size_t k = 0; k < fit->sets; k++) {
    const ZpFitSet *of = &fit->set[k];
    double largest = 0;
    for (size_t i = of->first; i < of->first + of->rows; i++)
      largest = fmax(largest, fabs(fit->y[i]));
    for (size_t i = of->first; i < of->first + of->rows; i++) {
      double r = isfinite(fitted[i]) ? zp_fit_residual(fit, fitted, i) : 2 * largest * weight(fit, i);
      sum += r * r;
    }
  }
  return sum;
}

typedef struct Search {
  ZpFit *fit;
  double *fitted;
  nlopt_opt opt;
} Search;

/* An nlopt_func: the logarithm of the sum of squares, so that tolerances are relative. */
static double objective(unsigned n, const double *z, double *gradient, void *user) {
  Search *search = user;
  (void)n, (void)gradient;
  predict_all(search->fit, z, search->fitted);
  if (search->fit->stopped || search->fit->status != ZP_OK) nlopt_force_stop(search->opt);
  return log(squares(search->fit, search->fitted) + 1e-30);
}

/* Close enough for Gauss-Newton to start, which with exact derivatives costs one evaluation per step. */
static double near_enough(const ZpFit *fit) {
  for (size_t i = 0; i < fit->sets; i++)
    if (fit->set[i].x_key < 0) return 1e-3;
  return 3e-2;
}

static bool search_within_bounds(ZpFit *fit, double *z, double *fitted) {
  Search search = {fit, fitted, nlopt_create(NLOPT_LN_COBYLA, (unsigned)fit->n)};
  double best;
  if (!search.opt) return false;
  nlopt_set_lower_bounds(search.opt, fit->lower);
  nlopt_set_upper_bounds(search.opt, fit->upper);
  nlopt_set_min_objective(search.opt, objective, &search);
  nlopt_set_xtol_rel(search.opt, near_enough(fit));
  nlopt_set_maxeval(search.opt, 60 * fit->n);
  nlopt_set_initial_step1(search.opt, 0.1);
  fit->searches = true;
  nlopt_result end = nlopt_optimize(search.opt, z, &best);
  fit->searches = false;
  nlopt_destroy(search.opt);
  return end != NLOPT_OUT_OF_MEMORY && end != NLOPT_INVALID_ARGS;
}

/* -- derivatives ---------------------------------------------------------------------------------- */

/* Derivatives of a stroke or an opening with respect to the fitted keys => row [n]. */
static bool slopes_of_rest(ZpFit *fit, ZpFitKind kind, const ZpActuatorDef *def, double voltage, double *row) {
  ZpModel *model = build(fit, def);
  ZpRest *rest = NULL;
  if (model && zp_rest_create(model, &rest, fit->err) != ZP_OK) fit->status = ZP_MACHINE;
  bool good = rest && zp_rest_hang(rest, voltage);
  for (int k = 0; k < fit->n && good; k++) {
    double stroke, opening;
    ZpStatus status = zp_rest_sensitivity(rest, fit->key[k], &stroke, &opening, NULL);
    if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
    row[k] = kind == ZP_FIT_OPENING ? opening : stroke;
    good = status == ZP_OK && isfinite(row[k]);
  }
  zp_rest_destroy(rest);
  zp_model_destroy(model);
  return good;
}

/* Derivatives of the number of a study with respect to the fitted keys => row [n]. */
static bool slopes_of_number(ZpFit *fit, ZpFitKind kind, ZpActuatorDef *def, double *row) {
  int found = 0;
  name_keys(fit, def);
  ZpResult *result = run_study(fit, kind, def);
  for (size_t i = 0; result && i < result->sensitivities && found < fit->n; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (strcmp(s->output, zp_fit_number[kind].number) == 0) row[found++] = s->value;
  }
  zp_result_destroy(result);
  for (int k = 0; k < found; k++)
    if (!isfinite(row[k])) return false;
  return found == fit->n;
}

/* Are exact derivatives available for the rows of a set? */
static bool has_slopes(const ZpFitSet *of) {
  return of->x_key >= 0 && zp_fit_number[of->kind].has_slopes;
}

/* Exact derivatives, if they are available for all fitted keys => rows of J of this set. */
static bool differentiate(ZpFit *fit, const ZpFitSet *of, const double *z, double *J) {
  bool is_number = zp_fit_number[of->kind].number != NULL, good = has_slopes(of);
  for (size_t i = 0; i < of->rows && good; i++) {
    ZpActuatorDef def;
    double voltage, *row = J + i * (size_t)fit->n;
    good = !ask(fit) && zp_fit_row(fit, z, of->first + i, &def, &voltage);
    good = good &&
           (is_number ? slopes_of_number(fit, of->kind, &def, row) : slopes_of_rest(fit, of->kind, &def, voltage, row));
    for (int k = 0; k < fit->n && good; k++)
      row[k] *= fit->start[k];
  }
  return good;
}

/* Derivatives by finite differences => rows of J of this set. */
static bool difference_set(ZpFit *fit, const ZpFitSet *of, const double *z, double *J) {
  double *up = calloc(2 * of->rows, sizeof *up), *down = up ? up + of->rows : NULL;
  bool good = up != NULL;
  for (int k = 0; k < fit->n && good; k++) {
    double at[ZP_FIT_MOST];
    memcpy(at, z, sizeof at);
    double step = difference * size_of(z[k]);
    double high = fmin(z[k] + step, fit->upper[k]), low = fmax(z[k] - step, fit->lower[k]);
    at[k] = high;
    good = predict_set(fit, of, at, up);
    at[k] = low;
    good = good && predict_set(fit, of, at, down) && high > low;
    for (size_t i = 0; i < of->rows && good; i++)
      J[i * (size_t)fit->n + (size_t)k] = (up[i] - down[i]) / (high - low);
  }
  free(up);
  return good;
}

bool zp_fit_jacobian(ZpFit *fit, const double *z, double *J) {
  bool exact = false, differenced = false, good = true;
  for (size_t i = 0; i < fit->sets && good; i++) {
    const ZpFitSet *of = &fit->set[i];
    double *rows = J + of->first * (size_t)fit->n;
    exact = exact || has_slopes(of);
    if (differentiate(fit, of, z, rows)) continue;
    differenced = true;
    good = difference_set(fit, of, z, rows);
  }
  fit->evaluations += exact + (differenced ? 2 * fit->n : 0);
  for (size_t i = 0; i < fit->rows && good; i++)
    for (int k = 0; k < fit->n; k++)
      J[i * (size_t)fit->n + (size_t)k] *= weight(fit, i);
  return good;
}

bool zp_fit_covariance(const ZpFit *fit, const double *J, const bool *stays, double ridge, double least,
                       double C[ZP_FIT_MOST][ZP_FIT_MOST]) {
  int n = fit->n;
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}, M[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}; /* J^T J = L L^T, M = L^-1 */
  for (int a = 0; a < n; a++)
    for (int b = 0; b <= a; b++) {
      bool both = !stays || (!stays[a] && !stays[b]);
      double sum = both ? 0 : a == b;
      for (size_t i = 0; i < fit->rows && both; i++)
        sum += J[i * (size_t)n + (size_t)a] * J[i * (size_t)n + (size_t)b];
      double whole = sum *= a == b ? 1 + ridge : 1;
      for (int k = 0; k < b; k++)
        sum -= L[a][k] * L[b][k];
      if (a == b && !(sum > least * whole)) return false;
      L[a][b] = a == b ? sqrt(sum) : sum / L[b][b];
    }
  for (int a = 0; a < n; a++)
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

/* The Gauss-Newton step; a key at its bound stays there if the step would leave the bound. */
static bool gauss_newton(const ZpFit *fit, const double *z, const double *fitted, const double *J, double *step) {
  static const double ridge = 1e-10;
  double C[ZP_FIT_MOST][ZP_FIT_MOST], g[ZP_FIT_MOST] = {0};
  bool stays[ZP_FIT_MOST];
  for (int k = 0; k < fit->n; k++) {
    for (size_t i = 0; i < fit->rows; i++)
      g[k] -= J[i * (size_t)fit->n + (size_t)k] * zp_fit_residual(fit, fitted, i);
    stays[k] = (z[k] <= fit->lower[k] && g[k] < 0) || (z[k] >= fit->upper[k] && g[k] > 0);
    if (stays[k]) g[k] = 0;
  }
  if (!zp_fit_covariance(fit, J, stays, ridge, 0, C)) return false;
  for (int a = 0; a < fit->n; a++) {
    step[a] = 0;
    for (int b = 0; b < fit->n; b++)
      step[a] += C[a][b] * g[b];
  }
  return true;
}

/* Follow a step as far as the sum of squares decreases; => the change of z, 0 if it does not decrease. */
static double take_step(ZpFit *fit, double *z, double *fitted, const double *step, double *trial) {
  double before = squares(fit, fitted), fraction = 1;
  for (int h = 0; h < HALVINGS; h++, fraction /= 2) {
    double at[ZP_FIT_MOST] = {0}, moved = 0;
    for (int k = 0; k < fit->n; k++) {
      at[k] = fmin(fmax(z[k] + fraction * step[k], fit->lower[k]), fit->upper[k]);
      moved = fmax(moved, fabs(at[k] - z[k]) / size_of(z[k]));
    }
    if (!predict_all(fit, at, trial) || squares(fit, trial) >= before) continue;
    memcpy(z, at, (size_t)fit->n * sizeof *z);
    memcpy(fitted, trial, fit->rows * sizeof *fitted);
    return moved;
  }
  return 0;
}

bool zp_fit_solve(ZpFit *fit, double *z, double *fitted) {
  double *J = calloc(fit->rows * (size_t)(fit->n + 1), sizeof *J), step[ZP_FIT_MOST] = {0};
  double *trial = J ? J + fit->rows * (size_t)fit->n : NULL;
  bool good = J && (fit->n == 0 || search_within_bounds(fit, z, fitted));
  if (!good) fit->status = zp_fail_memory(fit->err);
  good = good && predict_all(fit, z, fitted);
  for (int k = 0; k < POLISH_MOST && good && fit->n > 0 && !fit->stopped; k++) {
    if (!zp_fit_jacobian(fit, z, J) || !gauss_newton(fit, z, fitted, J, step)) break;
    if (take_step(fit, z, fitted, step, trial) < 1e-9) break;
  }
  free(J);
  return good && fit->status == ZP_OK;
}
