/* Least squares from one point, by the method of Levenberg and Marquardt within bounds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "fit/cholesky.h"

bool zp_fit_covariance(const ZpFit *fit, const double *J, const bool *stays, double ridge, double least,
                       double C[ZP_FIT_MOST][ZP_FIT_MOST]) {
  int n = fit->n;
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}; /* J^T J = L L^T */
  for (int a = 0; a < n; a++)
    for (int b = 0; b <= a; b++) {
      bool both = !stays || (!stays[a] && !stays[b]);
      double sum = both ? 0 : a == b;
      for (size_t i = 0; i < fit->rows && both; i++)
        sum += J[i * (size_t)n + (size_t)a] * J[i * (size_t)n + (size_t)b];
      L[a][b] = sum * (a == b ? 1 + ridge : 1);
    }
  if (!zp_cholesky_factor(n, least, L)) return false;
  zp_cholesky_invert(n, L, C);
  return true;
}

/* -- one minimum ------------------------------------------------------------------------------------ */

/* J^T J and minus J^T r, of the parameters that are free to move. */
typedef struct Normal {
  double H[ZP_FIT_MOST][ZP_FIT_MOST], g[ZP_FIT_MOST];
  bool free[ZP_FIT_MOST];
} Normal;

/* A parameter at its bound stays there if it would leave it. */
static Normal normal_of(const ZpFit *fit, const ZpFitPoint *at, const bool *held) {
  Normal normal = {0};
  const size_t n = (size_t)fit->n;
  for (size_t i = 0; i < fit->rows; i++) {
    const double r = isfinite(at->fitted[i]) ? zp_fit_residual(fit, at->fitted, i) : 0, *row = at->J + i * n;
    for (size_t a = 0; a < n; a++) {
      normal.g[a] -= row[a] * r;
      for (size_t b = 0; b <= a; b++)
        normal.H[a][b] += row[a] * row[b];
    }
  }
  for (size_t a = 0; a < n; a++) {
    const double z = at->z[a], g = normal.g[a];
    const bool leaves = (z <= fit->lower[a] && g < 0) || (z >= fit->upper[a] && g > 0);
    normal.free[a] = !(held && held[a]) && !leaves && normal.H[a][a] > 0;
    for (size_t b = 0; b < a; b++)
      normal.H[b][a] = normal.H[a][b];
  }
  return normal;
}

/* Solve (H + damping diag H) step = g. False if H is singular. */
static bool damped_step(const ZpFit *fit, const Normal *normal, double damping, double *step) {
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}};
  const int n = fit->n;
  for (int a = 0; a < n; a++) {
    for (int b = 0; b <= a; b++) {
      const bool both = normal->free[a] && normal->free[b];
      L[a][b] = both ? normal->H[a][b] * (a == b ? 1 + damping : 1) : a == b;
    }
    step[a] = normal->free[a] ? normal->g[a] : 0;
  }
  if (!zp_cholesky_factor(n, 0, L)) return false;
  zp_cholesky_solve(n, L, step);
  return true;
}

bool zp_fit_step(const ZpFit *fit, const ZpFitPoint *at, const bool *held, double damping, double *step) {
  const Normal normal = normal_of(fit, at, held);
  return damped_step(fit, &normal, damping, step);
}

/* A step within the bounds => how far it goes, in multiples of the parameters' sizes, and by how much the squares fall
 * if the model is linear. */
static double go(const ZpFit *fit, const Normal *normal, const double *from, const double *step, double *to,
                 double *falls) {
  double moved = 0, d[ZP_FIT_MOST];
  *falls = 0;
  for (int k = 0; k < fit->n; k++) {
    to[k] = fmin(fmax(from[k] + step[k], fit->lower[k]), fit->upper[k]);
    d[k] = to[k] - from[k];
    moved = fmax(moved, fabs(d[k]) / (k < fit->keys ? zp_fit_size(from[k]) : fmax(fabs(from[k]), 1)));
    *falls += 2 * normal->g[k] * d[k];
  }
  for (int a = 0; a < fit->n; a++)
    for (int b = 0; b < fit->n; b++)
      *falls -= d[a] * normal->H[a][b] * d[b];
  return moved;
}

/* Both have arrays of their own, J behind the fitted values. */
static void copy_point(const ZpFit *fit, const ZpFitPoint *from, ZpFitPoint *to) {
  memcpy(to->z, from->z, sizeof to->z);
  memcpy(to->fitted, from->fitted, fit->rows * (size_t)(fit->n + 1) * sizeof *to->fitted);
  to->square = from->square;
  to->good = from->good;
}

bool zp_fit_open_point(ZpFit *fit, ZpFitPoint *point) {
  *point = (ZpFitPoint){.square = INFINITY};
  point->fitted = calloc(fit->rows * (size_t)(fit->n + 1), sizeof *point->fitted);
  point->J = point->fitted ? point->fitted + fit->rows : NULL;
  if (!point->fitted) fit->status = zp_fail_memory(fit->err);
  return point->fitted != NULL;
}

void zp_fit_go_to(ZpFit *fit, ZpFitPoint *point) {
  point->good = zp_fit_evaluate(fit, point->z, point->fitted, point->J);
  point->square = zp_fit_square(fit, point->fitted);
}

bool zp_fit_goes_on(const ZpFit *fit) {
  return !fit->stopped && fit->status == ZP_OK;
}

bool zp_fit_descend(ZpFit *fit, const bool *held, int most, ZpFitPoint *point) {
  static const double near = 1e-9, flat = 1e-9, weakest = 1e-12, strongest = 1e8;
  const double rough = fit->enough > 0 ? 0.02 : 0;
  ZpFitPoint trial = {0};
  double damping = 1e-3;
  bool found = fit->n == 0, moves = zp_fit_open_point(fit, &trial);
  for (int k = 0; k < most && moves && !found && zp_fit_goes_on(fit); k++) {
    const double variance = point->square / (double)fit->rows;
    const Normal normal = normal_of(fit, point, held);
    double step[ZP_FIT_MOST], falls, moved = 0;
    for (moves = false; !moves && !found && damping < strongest && zp_fit_goes_on(fit); damping *= moves ? 0.2 : 8) {
      if (!damped_step(fit, &normal, damping, step)) continue;
      moved = go(fit, &normal, point->z, step, trial.z, &falls);
      found = moved < near || falls < fmax(flat * flat * point->square, fit->enough * variance);
      if (found) break;
      zp_fit_go_to(fit, &trial);
      moves = trial.square < point->square && (trial.good || !point->good);
      found = !moves && falls < rough * variance;
    }
    damping = fmax(damping, weakest);
    if (!moves) break;
    found |= moved < near || point->square - trial.square < flat * flat * point->square;
    copy_point(fit, &trial, point);
  }
  free(trial.fitted);
  return found;
}
