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
    const double part = (zp_sobol((uint32_t)which + 1, k % ZP_SOBOL_DIMENSIONS) + 0.5) / 4294967296.0;
    z[k] = fmin(fmax(fit->first[k], low), high);
    if (which == 0 || k >= fit->keys) continue;
    z[k] = low > 0 ? low * pow(high / low, part) : low + part * (high - low);
  }
}

/* Do two points differ in a key by more than a part of it? */
static bool differ(const ZpFit *fit, const double *a, const double *b, double apart) {
  for (int k = 0; k < fit->keys; k++)
    if (fabs(a[k] - b[k]) > apart * fmax(fabs(a[k]), fabs(b[k]))) return true;
  return false;
}

typedef struct Start {
  double z[ZP_FIT_MOST], square;
  double tolerance; /* of the time steps with which it was found */
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

/* The sum of squares at each start, over the closing. */
static void look(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  fit->horizon = fit->runs > 0 ? 0 : 1;
  for (int k = 0; k < count; k++) {
    start_at(fit, k, point->z);
    point->square = INFINITY, point->good = false;
    if (zp_fit_goes_on(fit)) zp_fit_find_values(fit, point);
    keep(point, &start[k]);
  }
  fit->horizon = 1;
}

static int best_of(const Start *start, int count) {
  int best = 0;
  for (int k = 1; k < count; k++)
    if (by_square(&start[k], &start[best]) < 0) best = k;
  return best;
}

static const double searching = 1e-4; /* tolerance of the time steps of a search over a part of the time */

/* Go from a start to the minimum over a part of the time. */
static void descend_from(ZpFit *fit, double horizon, Start *start, ZpFitPoint *point) {
  enum { MOST = 20 };
  zp_fit_reset_ways(fit);
  fit->horizon = horizon;
  memcpy(point->z, start->z, sizeof point->z);
  zp_fit_go_to(fit, point);
  start->ended = zp_fit_descend(fit, NULL, MOST, point);
  keep(point, start);
  start->tolerance = fit->tolerance;
  fit->horizon = 1;
}

/* Have two of the starts come to the best sum of squares? In a valley they may be far apart. */
static bool is_reached_twice(const ZpFit *fit, const Start *start, int count) {
  static const double little = 4; /* times their mean */
  const double best = start[best_of(start, count)].square;
  int reached = 0;
  for (int k = 0; k < count; k++)
    reached += start[k].square <= best * (1 + little / (double)fit->rows);
  return reached > 1;
}

/* From the given values, then from the others, the most promising first, to the minima over the closing, where the runs
 * are short and depend smoothly on the keys, until two agree => how many. */
static int descend_closing(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  int tried = 0;
  if (count > 1) qsort(start + 1, (size_t)count - 1, sizeof *start, by_square);
  while (tried < count && zp_fit_goes_on(fit) && !(tried > 1 && is_reached_twice(fit, start, tried)))
    descend_from(fit, 0, &start[tried++], point);
  qsort(start, (size_t)tried, sizeof *start, by_square);
  return tried;
}

/* By how much the errors of the time steps move the parameters, at most, in standard errors: steps of a quarter of the
 * tolerance change the values, and the point then has those. What is left is a third of the change. */
static double error_of_steps(ZpFit *fit, ZpFitPoint *at, double *change) {
  static const double left = 1. / 3;
  double C[ZP_FIT_MOST][ZP_FIT_MOST], moved = 0, squares = 0;
  for (size_t i = 0; i < fit->rows; i++)
    change[i] = -zp_fit_residual(fit, at->fitted, i);
  fit->tolerance /= 4;
  zp_fit_find_values(fit, at);
  for (size_t i = 0; i < fit->rows; i++) {
    change[i] += zp_fit_residual(fit, at->fitted, i);
    squares += change[i] * change[i];
  }
  if (!zp_fit_covariance(fit, at->J, NULL, 1e-10, 1e-12, C)) return INFINITY;
  const double variance = zp_fit_judge(fit, at).variance;
  fit->scatter = 2 * left * sqrt(squares * variance);
  for (int a = 0; a < fit->n; a++) {
    double move = 0;
    for (size_t i = 0; i < fit->rows; i++)
      for (int b = 0; b < fit->n; b++)
        move += C[a][b] * at->J[i * (size_t)fit->n + (size_t)b] * change[i];
    moved = fmax(moved, fabs(move) / sqrt(variance * C[a][a]));
  }
  return left * moved;
}

/* A tolerance with which the errors of the steps are small beside the standard errors. */
static void find_tolerance(ZpFit *fit, ZpFitPoint *at) {
  static const double little = 0.1, least = 1e-5;
  double *change = calloc(fit->rows, sizeof *change), error = INFINITY;
  if (!change) fit->status = zp_fail_memory(fit->err);
  while (change && zp_fit_goes_on(fit) && at->good && fit->tolerance > least && !(error < little))
    error = error_of_steps(fit, at, change);
  free(change);
}

/* Are residuals noise beyond doubt? Doubt costs no more than another start. */
static bool is_clean(const ZpFit *fit, const ZpFitPoint *point) {
  static const double unlikely = 0.05;
  const ZpFitJudgement of = zp_fit_judge(fit, point);
  return zp_fit_is_noise(&of) && !(of.runs < unlikely) && !(of.succession < unlikely);
}

/* From a minimum over the closing on, over more and more of the time. Over all of it faces touch and part so often that
 * only accurate steps give a sum of squares that is smooth => whether the residuals are noise. */
static bool follow_motion(ZpFit *fit, Start *start, ZpFitPoint *point) {
  static const double horizon[] = {0.15, 0.4};
  for (size_t k = 0; k < sizeof horizon / sizeof horizon[0]; k++)
    descend_from(fit, horizon[k], start, point);
  memcpy(point->z, start->z, sizeof point->z);
  zp_fit_go_to(fit, point);
  find_tolerance(fit, point);
  descend_from(fit, 1, start, point);
  return point->good && is_clean(fit, point);
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

/* The best minimum by the derivatives of which its intervals are. */
static void refine(ZpFit *fit, ZpFitPoint *best) {
  enum { MOST = 60 };
  fit->enough = fit->runs > 0 ? 1e-3 : 0;
  fit->rough = fit->runs > 0 ? 0.1 : 0;
  fit->slopes = ZP_FIT_CENTRAL;
  zp_fit_go_to(fit, best);
  best->ended = zp_fit_descend(fit, NULL, MOST, best);
}

/* Is a minimum over the closing as good as the best one, and far from those that were followed? */
static bool is_rival(const ZpFit *fit, const Start *closing, int followed, int which) {
  static const double little = 4, far = 0.1; /* times the mean square; of a key */
  const double best = closing[0].square;
  if (!closing[which].good || closing[which].square > best * (1 + little / (double)fit->rows)) return false;
  for (int k = 0; k < followed; k++)
    if (!differ(fit, closing[k].z, closing[which].z, far)) return false;
  return true;
}

/* The next one to follow takes place `followed` => whether there is one. After residuals that are noise only rivals are
 * followed, without them all starts. */
static bool choose_next(const ZpFit *fit, Start *start, Start *closing, int followed, int minima, int count,
                        bool clean) {
  int next = followed;
  while (clean && next < minima && !is_rival(fit, closing, followed, next))
    next++;
  if (next >= (clean ? minima : count)) return false;
  const Start one = start[next], other = closing[next];
  start[next] = start[followed], closing[next] = closing[followed];
  start[followed] = one, closing[followed] = other;
  return true;
}

/* Follow the minima over the closing, then those of further starts, until the residuals of a record are noise, and all
 * rivals of that one => how many. Where nothing moves, there is nothing to follow. */
static int follow_all(ZpFit *fit, Start *start, int count, ZpFitPoint *point) {
  enum { MOST = 4 };
  const int minima = descend_closing(fit, start, count, point);
  if (fit->runs == 0) return minima;
  Start *closing = calloc((size_t)count, sizeof *closing);
  int followed = 0;
  bool clean = false;
  if (!closing) {
    fit->status = zp_fail_memory(fit->err);
    return 0;
  }
  memcpy(closing, start, (size_t)count * sizeof *closing);
  while (followed < MOST && zp_fit_goes_on(fit) && choose_next(fit, start, closing, followed, minima, count, clean)) {
    fit->tolerance = searching;
    if (followed >= minima) descend_from(fit, 0, &start[followed], point);
    clean |= follow_motion(fit, &start[followed++], point);
  }
  free(closing);
  return followed;
}

/* The best of the minima, and the best other one. */
static void compare(const ZpFit *fit, Start *start, ZpFitStarts *starts) {
  static const double apart = 1e-3;
  if (starts->tried > 1) qsort(start, (size_t)starts->tried, sizeof *start, by_square);
  starts->best = start->square;
  for (int k = 1; k < starts->tried; k++) {
    if (!differ(fit, start[k].z, start->z, apart) || !start[k].good || !start[k].ended ||
        start[k].square >= starts->next)
      continue;
    starts->next = start[k].square;
    memcpy(starts->other, start[k].z, sizeof starts->other);
  }
}

/* How a search goes over the motion. Its values are rough where faces touch and part. */
static void prepare(ZpFit *fit) {
  const bool moves = fit->runs > 0;
  find_closings(fit);
  fit->tolerance = searching;
  fit->slopes = ZP_FIT_ONE_SIDED;
  fit->enough = moves ? 0.3 : 0.02;
  fit->rough = moves ? 10 : 0.02;
}

bool zp_fit_solve(ZpFit *fit, ZpFitPoint *best, ZpFitStarts *starts) {
  const int count = fit->keys > 0 ? fit->def->calibrate.starts : 1;
  Start *start = calloc((size_t)count, sizeof *start);
  *starts = (ZpFitStarts){.next = INFINITY};
  if (!start) {
    fit->status = zp_fail_memory(fit->err);
    return false;
  }
  prepare(fit);
  look(fit, start, count, best);
  starts->tried = follow_all(fit, start, count, best);
  compare(fit, start, starts);
  if (zp_fit_goes_on(fit)) {
    memcpy(best->z, start->z, sizeof best->z);
    fit->tolerance = start->tolerance;
    refine(fit, best);
  }
  free(start);
  return best->good && fit->status == ZP_OK;
}
