/* Several starts, which go on a horizon that widens, and the best minimum with accurate time steps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/def.h"
#include "fit/fit.h"
#include "sample/sobol.h"

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

/* Values at a point, without derivatives. */
static void find_values(ZpFit *fit, ZpFitPoint *point) {
  double *J = point->J;
  point->J = NULL;
  zp_fit_go_to(fit, point);
  point->J = J;
}

/* The sum of squares at each start, over the closing. */
static void look(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  fit->horizon = fit->runs > 0 ? 0 : 1;
  for (int k = 0; k < count; k++) {
    start_at(fit, k, point->z);
    point->square = INFINITY, point->good = false;
    if (zp_fit_goes_on(fit)) find_values(fit, point);
    keep(point, &start[k]);
  }
  fit->horizon = 1;
}

/* First to the minimum over the closing, where the runs are short and depend smoothly on the keys, then on. */
static void descend_from(ZpFit *fit, int most, Start *start, ZpFitPoint *point) {
  static const double horizon[] = {0, 0.3, 1};
  memcpy(point->z, start->z, sizeof point->z);
  for (size_t k = fit->runs > 0 ? 0 : 2; k < sizeof horizon / sizeof horizon[0]; k++) {
    fit->horizon = horizon[k];
    zp_fit_go_to(fit, point);
    start->ended = zp_fit_descend(fit, NULL, most, point);
  }
  keep(point, start);
}

static int best_of(const Start *start, int count) {
  int best = 0;
  for (int k = 1; k < count; k++)
    if (by_square(&start[k], &start[best]) < 0) best = k;
  return best;
}

/* How many of the starts lead to the same point as the best of them. */
static int agreeing(const ZpFit *fit, const Start *start, int count) {
  int best = best_of(start, count), agree = 0;
  for (int k = 0; k < count; k++)
    agree += !differ(fit, start[k].z, start[best].z);
  return agree;
}

/* Has the best of them residuals like noise? The last one is still at `point`. */
static bool is_noise(ZpFit *fit, const Start *start, int count, ZpFitPoint *point) {
  int best = best_of(start, count);
  if (best != count - 1) {
    memcpy(point->z, start[best].z, sizeof point->z);
    find_values(fit, point);
  }
  const ZpFitJudgement judgement = zp_fit_judge(fit, point);
  return zp_fit_is_noise(&judgement);
}

/* Descend from the given values, then from the others, the most promising first, until two agree on the best, and its
 * residuals are noise. */
static int descend_all(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  enum { SCOUT = 20, LEAST = 2 };
  int tried = 0;
  look(fit, start, count, point);
  if (count > 1) qsort(start + 1, (size_t)count - 1, sizeof *start, by_square);
  while (tried < count && zp_fit_goes_on(fit)) {
    descend_from(fit, SCOUT, &start[tried++], point);
    if (tried >= LEAST && agreeing(fit, start, tried) > 1 && is_noise(fit, start, tried, point)) break;
  }
  return tried;
}

/* When a column of a record has first done half of what it does. */
static double closing_of(const ZpFit *fit, const ZpFitSet *of) {
  const double *y = fit->y + of->first;
  double low = y[0], high = y[0];
  size_t row = 0;
  for (size_t i = 1; i < of->rows; i++)
    low = fmin(low, y[i]), high = fmax(high, y[i]);
  const double half = 0.5 * fmax(high - y[0], y[0] - low);
  while (row + 1 < of->rows && fabs(y[row] - y[0]) < half)
    row++;
  return fit->x[of->first + row];
}

static void find_closings(ZpFit *fit) {
  for (size_t s = 0; s < fit->sets; s++) {
    const ZpFitSet *of = &fit->set[s];
    if (of->x_key >= 0) continue;
    ZpFitRun *run = &fit->run[of->run];
    const bool first = run->last == 0 && run->closing == 0;
    const double last = fit->x[of->first + of->rows - 1], closing = closing_of(fit, of);
    run->last = first ? last : fmax(run->last, last);
    run->closing = first ? closing : fmin(run->closing, closing);
  }
}

/* Sum of squares of what the errors of the time steps add to the residuals, by steps of a quarter of the tolerance,
 * with which the point then has its values. */
static double error_of_steps(ZpFit *fit, ZpFitPoint *at, double *before) {
  double sum = 0;
  memcpy(before, at->fitted, fit->rows * sizeof *before);
  fit->tolerance /= 4;
  at->good = zp_fit_evaluate(fit, at->z, at->fitted, NULL);
  at->square = zp_fit_square(fit, at->fitted);
  for (size_t i = 0; i < fit->rows && at->good; i++) {
    const double change = zp_fit_residual(fit, at->fitted, i) - zp_fit_residual(fit, before, i);
    sum += change * change;
  }
  return sum;
}

/* A tolerance with which the errors of the steps are small beside the standard errors: the last step to it changes all
 * rows together by less than a part of the noise of one. */
static void find_tolerance(ZpFit *fit, ZpFitPoint *at) {
  static const double part = 0.5, least = 1e-5;
  double *before = fit->runs > 0 ? calloc(fit->rows, sizeof *before) : NULL;
  if (fit->runs > 0 && !before) fit->status = zp_fail_memory(fit->err);
  while (before && zp_fit_goes_on(fit) && at->good && fit->tolerance > least) {
    const double error = error_of_steps(fit, at, before);
    if (error < part * part * zp_fit_judge(fit, at).variance) break;
  }
  free(before);
}

/* The best minimum with accurate time steps. */
static void refine(ZpFit *fit, ZpFitPoint *best) {
  enum { MOST = 60 };
  fit->enough = fit->runs > 0 ? 1e-6 : 0;
  find_tolerance(fit, best);
  zp_fit_go_to(fit, best);
  best->ended = zp_fit_descend(fit, NULL, MOST, best);
}

bool zp_fit_solve(ZpFit *fit, ZpFitPoint *best, ZpFitStarts *starts) {
  static const double searching = 1e-4; /* of the time steps of a search */
  const int count = fit->keys > 0 ? fit->def->calibrate.starts : 1;
  Start *start = calloc((size_t)count, sizeof *start);
  *starts = (ZpFitStarts){.next = INFINITY};
  find_closings(fit);
  fit->tolerance = searching;
  fit->enough = 0.02;
  if (!start) {
    fit->status = zp_fail_memory(fit->err);
    return false;
  }
  starts->tried = descend_all(fit, start, count, best);
  if (starts->tried > 1) qsort(start, (size_t)starts->tried, sizeof *start, by_square);
  for (int k = 0; k < starts->tried; k++) {
    const bool same = !differ(fit, start[k].z, start->z);
    starts->agree += same;
    if (same || !start[k].good || !start[k].ended || start[k].square >= starts->next) continue;
    starts->next = start[k].square;
    memcpy(starts->other, start[k].z, sizeof starts->other);
  }
  if (zp_fit_goes_on(fit)) {
    memcpy(best->z, start->z, sizeof best->z);
    zp_fit_go_to(fit, best);
    starts->best = best->square;
    refine(fit, best);
  }
  free(start);
  return best->good && fit->status == ZP_OK;
}
