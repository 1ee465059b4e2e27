/* Least squares from several starts, by the method of Levenberg and Marquardt within bounds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/def.h"
#include "fit/fit.h"
#include "sample/sobol.h"

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

/* Solve (H + damping diag H) step = g by Cholesky. False if H is singular. */
static bool damped_step(const ZpFit *fit, const Normal *normal, double damping, double *step) {
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}, x[ZP_FIT_MOST] = {0};
  const int n = fit->n;
  for (int a = 0; a < n; a++) {
    for (int b = 0; b <= a; b++) {
      const bool both = normal->free[a] && normal->free[b];
      double sum = both ? normal->H[a][b] : a == b;
      if (a == b && both) sum *= 1 + damping;
      for (int k = 0; k < b; k++)
        sum -= L[a][k] * L[b][k];
      if (a == b && !(sum > 0)) return false;
      L[a][b] = a == b ? sqrt(sum) : sum / L[b][b];
    }
    x[a] = normal->free[a] ? normal->g[a] : 0;
    for (int k = 0; k < a; k++)
      x[a] -= L[a][k] * x[k];
    x[a] /= L[a][a];
  }
  for (int a = n; a-- > 0;) {
    for (int k = a + 1; k < n; k++)
      x[a] -= L[k][a] * x[k];
    x[a] /= L[a][a];
  }
  memcpy(step, x, (size_t)n * sizeof *step);
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
  static const double least = 1e-3; /* a key may be negative or pass 0 */
  double moved = 0, d[ZP_FIT_MOST];
  *falls = 0;
  for (int k = 0; k < fit->n; k++) {
    to[k] = fmin(fmax(from[k] + step[k], fit->lower[k]), fit->upper[k]);
    d[k] = to[k] - from[k];
    moved = fmax(moved, fabs(d[k]) / fmax(fabs(from[k]), k < fit->keys ? least : 1));
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

static bool goes_on(const ZpFit *fit) {
  return !fit->stopped && fit->status == ZP_OK;
}

bool zp_fit_descend(ZpFit *fit, const bool *held, int most, ZpFitPoint *point) {
  static const double near = 1e-9, flat = 1e-9, weakest = 1e-12, strongest = 1e8;
  ZpFitPoint trial = {0};
  double damping = 1e-3;
  bool found = fit->n == 0, moves = zp_fit_open_point(fit, &trial);
  for (int k = 0; k < most && moves && !found && goes_on(fit); k++) {
    const Normal normal = normal_of(fit, point, held);
    double step[ZP_FIT_MOST], falls, moved = 0;
    for (moves = false; !moves && !found && damping < strongest && goes_on(fit); damping *= moves ? 0.2 : 8) {
      if (!damped_step(fit, &normal, damping, step)) continue;
      moved = go(fit, &normal, point->z, step, trial.z, &falls);
      found = moved < near || falls < flat * flat * point->square;
      if (found) break;
      zp_fit_go_to(fit, &trial);
      moves = trial.square < point->square && (trial.good || !point->good);
      found = !moves && falls < flat * point->square; /* what is left is rounding of the runs */
    }
    damping = fmax(damping, weakest);
    if (!moves) break;
    found |= moved < near || point->square - trial.square < flat * flat * point->square;
    copy_point(fit, &trial, point);
  }
  free(trial.fitted);
  return found;
}

/* -- several starts --------------------------------------------------------------------------------- */

/* Start `which`: the given values, then points spread evenly over the bounds, by their ratio where both are positive.
 * Shifts start at 0. */
static void start_at(const ZpFit *fit, int which, double *z) {
  for (int k = 0; k < fit->n; k++) {
    const double low = fit->lower[k], high = fit->upper[k];
    const double part = (zp_sobol((uint32_t)which, k % ZP_SOBOL_DIMENSIONS) + 0.5) / 4294967296.0;
    z[k] = fmin(fmax(fit->first[k], low), high);
    if (which == 0 || k >= fit->keys) continue;
    z[k] = low > 0 ? low * pow(high / low, part) : low + part * (high - low);
  }
}

/* Do two points differ by more than the fit leaves open? By the values of the model there. */
static bool differ(const ZpFit *fit, const double *a, const double *b) {
  static const double apart = 1e-3;
  for (int k = 0; k < fit->keys; k++)
    if (fabs(a[k] - b[k]) > apart * fmax(fabs(a[k]), fabs(b[k]))) return true;
  return false;
}

typedef struct Start {
  double z[ZP_FIT_MOST], square;
  bool good, ended;
} Start;

/* Points with a value for all rows first, then by their sums of squares. */
static int by_square(const void *a, const void *b) {
  const Start *first = a, *second = b;
  if (first->good != second->good) return first->good ? -1 : 1;
  return first->square < second->square ? -1 : first->square > second->square;
}

static void keep(const ZpFitPoint *point, Start *start) {
  memcpy(start->z, point->z, sizeof start->z);
  start->square = point->square;
  start->good = point->good;
}

/* The sum of squares at each start. */
static void look(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  double *J = point->J;
  point->J = NULL;
  for (int k = 0; k < count; k++) {
    start_at(fit, k, point->z);
    point->square = INFINITY, point->good = false;
    if (goes_on(fit)) zp_fit_go_to(fit, point);
    keep(point, &start[k]);
  }
  point->J = J;
}

static void descend_from(ZpFit *fit, int most, Start *start, ZpFitPoint *point) {
  memcpy(point->z, start->z, sizeof point->z);
  zp_fit_go_to(fit, point);
  start->ended = zp_fit_descend(fit, NULL, most, point);
  keep(point, start);
}

/* How many of the starts lead to the same point as the best of them. */
static int agreeing(const ZpFit *fit, const Start *start, int count) {
  int best = 0, agree = 0;
  for (int k = 1; k < count; k++)
    if (by_square(&start[k], &start[best]) < 0) best = k;
  for (int k = 0; k < count; k++)
    agree += !differ(fit, start[k].z, start[best].z);
  return agree;
}

/* Has the best of them residuals like noise? */
static bool point_is_noise(ZpFit *fit, const Start *start, int count, ZpFitPoint *point) {
  int best = 0;
  for (int k = 1; k < count; k++)
    if (by_square(&start[k], &start[best]) < 0) best = k;
  if (best != count - 1) { /* the last one is still there */
    memcpy(point->z, start[best].z, sizeof point->z);
    double *J = point->J;
    point->J = NULL;
    zp_fit_go_to(fit, point);
    point->J = J;
  }
  const ZpFitJudgement judgement = zp_fit_judge(fit, point);
  return zp_fit_is_noise(&judgement);
}

/* Descend from the given values, then from the others, the most promising first, until two of three or more agree on
 * the best, and its residuals are noise. */
static int descend_all(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  enum { SCOUT = 20, LEAST = 3 };
  int tried = 0;
  look(fit, start, count, point);
  if (count > 1) qsort(start + 1, (size_t)count - 1, sizeof *start, by_square);
  while (tried < count && goes_on(fit)) {
    descend_from(fit, SCOUT, &start[tried++], point);
    if (tried >= LEAST && agreeing(fit, start, tried) > 1 && point_is_noise(fit, start, tried, point)) break;
  }
  return tried;
}

/* Accuracy of the time steps with which their error is a small part of the standard error of a mean of all rows. */
static double tolerance_for(const ZpFit *fit, const ZpFitPoint *at) {
  static const double part = 0.2, least = 2.5e-5, most = 1e-3;
  double noise = INFINITY;
  for (size_t s = 0; s < fit->sets; s++) {
    const ZpFitSet *of = &fit->set[s];
    double low = INFINITY, high = -INFINITY, sum = 0;
    if (of->x_key >= 0) continue;
    for (size_t i = of->first; i < of->first + of->rows; i++) {
      const double r = at->fitted[i] - fit->y[i];
      low = fmin(low, fit->y[i]), high = fmax(high, fit->y[i]);
      sum += r * r;
    }
    const double rms = sqrt(sum / (double)of->rows);
    if (high > low) noise = fmin(noise, rms / (high - low) / sqrt((double)of->rows));
  }
  return isfinite(noise) ? fmin(fmax(part * noise, least), most) : (double)NAN;
}

/* The best minimum with accurate time steps. */
static void refine(ZpFit *fit, ZpFitPoint *best) {
  enum { MOST = 60 };
  fit->tolerance = tolerance_for(fit, best);
  zp_fit_go_to(fit, best);
  best->ended = zp_fit_descend(fit, NULL, MOST, best);
}

bool zp_fit_solve(ZpFit *fit, ZpFitPoint *best, ZpFitStarts *starts) {
  const int count = fit->keys > 0 ? fit->def->calibrate.starts : 1;
  Start *start = calloc((size_t)count, sizeof *start);
  *starts = (ZpFitStarts){.next = INFINITY};
  if (!start) fit->status = zp_fail_memory(fit->err);
  if (start) starts->tried = descend_all(fit, start, count, best);
  if (starts->tried > 1) qsort(start, (size_t)starts->tried, sizeof *start, by_square);
  for (int k = 0; k < starts->tried; k++) {
    const bool same = !differ(fit, start[k].z, start->z);
    starts->agree += same;
    if (same || !start[k].good || !start[k].ended || start[k].square >= starts->next) continue;
    starts->next = start[k].square;
    memcpy(starts->other, start[k].z, sizeof starts->other);
  }
  if (start && goes_on(fit)) {
    memcpy(best->z, start->z, sizeof best->z);
    zp_fit_go_to(fit, best);
    starts->best = best->square;
    refine(fit, best);
  }
  free(start);
  return best->good && fit->status == ZP_OK;
}
