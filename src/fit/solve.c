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

double zp_fit_size_of(const ZpFit *fit, int k, double z) {
  return k < fit->keys ? zp_fit_size(z) : fmax(fabs(z), 1);
}

double zp_fit_way(const ZpFit *fit, int k, double from, double to) {
  return fit->lower[k] > 0 ? from * log(to / from) : to - from;
}

double zp_fit_end(const ZpFit *fit, int k, double from, double way) {
  const double end = fit->lower[k] > 0 ? from * exp(way / from) : from + way;
  return fmin(fmax(end, fit->lower[k]), fit->upper[k]);
}

/* Where a step may go: within the bounds, and not so far that the model means nothing. */
typedef struct Box {
  double low[ZP_FIT_MOST], high[ZP_FIT_MOST];
} Box;

static Box box_of(const ZpFit *fit, const double *z) {
  static const double farthest = 0.7; /* times a key's size: a factor of 2 */
  Box box = {{0}, {0}};
  for (int k = 0; k < fit->n; k++) {
    const double most = k < fit->keys ? farthest * zp_fit_size(z[k]) : INFINITY;
    box.low[k] = fmax(zp_fit_way(fit, k, z[k], fit->lower[k]), -most);
    box.high[k] = fmin(zp_fit_way(fit, k, z[k], fit->upper[k]), most);
  }
  return box;
}

/* The parameter whose step leaves the box farthest, by its size; -1: none does. */
static int farthest_out(const ZpFit *fit, const double *z, const Box *box, const double *step) {
  int found = -1;
  double most = 0;
  for (int k = 0; k < fit->n; k++) {
    const double out = fmax(step[k] - box->high[k], box->low[k] - step[k]) / zp_fit_size_of(fit, k, z[k]);
    if (out > most) most = out, found = k;
  }
  return found;
}

/* Solve (H + damping diag H) step = g for the free parameters; the others have their steps. False if H is singular. */
static bool solve_free(const ZpFit *fit, const Normal *normal, const bool *free, double damping, double *step) {
  double L[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}, right[ZP_FIT_MOST];
  const int n = fit->n;
  for (int a = 0; a < n; a++) {
    right[a] = free[a] ? normal->g[a] : step[a];
    for (int b = 0; b < n; b++) {
      if (b <= a) L[a][b] = free[a] && free[b] ? normal->H[a][b] * (a == b ? 1 + damping : 1) : a == b;
      if (free[a] && !free[b]) right[a] -= normal->H[a][b] * step[b];
    }
  }
  if (!zp_cholesky_factor(n, 0, L)) return false;
  zp_cholesky_solve(n, L, right);
  memcpy(step, right, (size_t)n * sizeof *step);
  return true;
}

/* The damped step within the box: what would leave it goes to its edge, and the others follow. */
static bool damped_step(const ZpFit *fit, const Normal *normal, const double *z, double damping, double *step) {
  const Box box = box_of(fit, z);
  bool free[ZP_FIT_MOST];
  memcpy(free, normal->free, sizeof free);
  for (int k = 0; k < fit->n; k++)
    step[k] = 0;
  for (int out = 0; out >= 0;) {
    if (!solve_free(fit, normal, free, damping, step)) return false;
    out = farthest_out(fit, z, &box, step);
    if (out >= 0) step[out] = fmin(fmax(step[out], box.low[out]), box.high[out]), free[out] = false;
  }
  return true;
}

/* By how much the squares fall over a step if the model is linear. */
static double fall_over(const ZpFit *fit, const Normal *normal, const double *step) {
  double falls = 0;
  for (int a = 0; a < fit->n; a++) {
    falls += 2 * normal->g[a] * step[a];
    for (int b = 0; b < fit->n; b++)
      falls -= step[a] * normal->H[a][b] * step[b];
  }
  return falls;
}

/* Take a step => how far it goes, in multiples of the parameters' sizes. */
static double go(const ZpFit *fit, const double *from, const double *step, double *to) {
  double moved = 0;
  for (int k = 0; k < fit->n; k++) {
    to[k] = zp_fit_end(fit, k, from[k], step[k]);
    moved = fmax(moved, fabs(to[k] - from[k]) / zp_fit_size_of(fit, k, from[k]));
  }
  return moved;
}

bool zp_fit_step(const ZpFit *fit, const ZpFitPoint *at, const bool *held, double *to, double *falls) {
  const Normal normal = normal_of(fit, at, held);
  double step[ZP_FIT_MOST];
  if (!damped_step(fit, &normal, at->z, 0, step)) return false;
  go(fit, at->z, step, to);
  *falls = fall_over(fit, &normal, step);
  return true;
}

/* Both have arrays of their own, J behind the fitted values. */
static void copy_values(const ZpFit *fit, const ZpFitPoint *from, ZpFitPoint *to) {
  memcpy(to->z, from->z, sizeof to->z);
  memcpy(to->fitted, from->fitted, fit->rows * sizeof *to->fitted);
  to->square = from->square;
  to->good = from->good;
}

void zp_fit_copy_point(const ZpFit *fit, const ZpFitPoint *from, ZpFitPoint *to) {
  copy_values(fit, from, to);
  memcpy(to->J, from->J, fit->rows * (size_t)fit->n * sizeof *to->J);
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

void zp_fit_find_values(ZpFit *fit, ZpFitPoint *point) {
  point->good = zp_fit_evaluate(fit, point->z, point->fitted, NULL);
  point->square = zp_fit_square(fit, point->fitted);
}

bool zp_fit_goes_on(const ZpFit *fit) {
  return !fit->stopped && fit->status == ZP_OK;
}

/* A descent under way. Derivatives of runs cost several times as much as values, so they are kept as long as they
 * foresee how far the squares fall. */
typedef struct Descent {
  ZpFitPoint *point, trial; /* where it is, with derivatives, and where it may go, with values */
  bool keeps;               /* derivatives may be those of an earlier point, */
  bool kept;                /* and are */
  double foreseen;          /* fall of the squares since they were found */
  double damping, growth;   /* of the damping after the next step that is not taken */
} Descent;

void zp_fit_reset_ways(ZpFit *fit) {
  static const double part = 1e-3;
  memset(fit->way, 0, sizeof fit->way);
  for (int k = 0; k < ZP_FIT_KEYS; k++)
    fit->way[k][k] = part;
}

/* Steps of the next differences: independent changes of the keys, each of two standard errors where the shifts are
 * known. So what is accurate enough to find the keys is accurate enough for their derivatives, also along a valley. */
static void turn_ways(ZpFit *fit, const Descent *d) {
  static const double most = 0.03; /* of a key's size */
  const Normal normal = normal_of(fit, d->point, NULL);
  double L[ZP_FIT_MOST][ZP_FIT_MOST], C[ZP_FIT_MOST][ZP_FIT_MOST];
  memcpy(L, normal.H, sizeof L);
  if (!zp_cholesky_factor(fit->keys, 1e-12, L)) return;
  zp_cholesky_invert(fit->keys, L, C);
  if (!zp_cholesky_factor(fit->keys, 0, C)) return;
  for (int way = 0; way < fit->keys; way++) {
    double step = 2 * sqrt(d->point->square / (double)fit->rows);
    for (int k = way; k < fit->keys; k++)
      step = fmin(step, most * zp_fit_size(d->point->z[k]) / fabs(C[k][way]));
    for (int k = way; k < fit->keys; k++)
      fit->way[k][way] = step * C[k][way];
  }
}

static void renew(ZpFit *fit, Descent *d) {
  turn_ways(fit, d);
  zp_fit_go_to(fit, d->point);
  d->kept = false;
  d->foreseen = 0;
}

/* More damping, the more so the more often. */
static void damp(Descent *d) {
  d->damping *= d->growth;
  d->growth *= 2;
}

/* After a step: more damping or less, as the squares fell by less or more than half of what was foreseen (Nielsen). */
static void relax(Descent *d, double ratio) {
  const double off = 2 * fmin(ratio, 2) - 1;
  d->damping = fmax(d->damping * fmax(1 - off * off * off, 1. / 3), 1e-12);
  d->growth = 2;
}

void zp_fit_carry_slopes(const ZpFit *fit, const double *from, const double *to, double *J) {
  for (int k = 0; k < fit->n; k++)
    for (size_t i = 0; i < fit->rows && fit->lower[k] > 0 && from[k] != to[k]; i++)
      J[i * (size_t)fit->n + (size_t)k] *= from[k] / to[k];
}

/* Let the kept derivatives agree with the change of the values to the trial, along the step there (Broyden). */
static void learn(const ZpFit *fit, Descent *d) {
  double along[ZP_FIT_MOST] = {0}, step[ZP_FIT_MOST] = {0}, squares = 0;
  for (int k = 0; k < fit->n; k++) {
    const double from = d->point->z[k], size = zp_fit_size_of(fit, k, from);
    step[k] = zp_fit_way(fit, k, from, d->trial.z[k]);
    along[k] = step[k] / (size * size);
    squares += step[k] * along[k];
  }
  for (size_t i = 0; i < fit->rows; i++) {
    double *row = d->point->J + i * (size_t)fit->n;
    double off = zp_fit_residual(fit, d->trial.fitted, i) - zp_fit_residual(fit, d->point->fitted, i);
    for (int k = 0; k < fit->n; k++)
      off -= row[k] * step[k];
    for (int k = 0; k < fit->n && isfinite(off); k++)
      row[k] += off * along[k] / squares;
  }
  zp_fit_carry_slopes(fit, d->point->z, d->trial.z, d->point->J);
}

/* To the trial, if it is better => whether something has changed. */
static bool take(ZpFit *fit, Descent *d, double falls) {
  static const double poor = 0.5; /* part of the fall foreseen, below which kept derivatives are renewed */
  const double fell = d->point->square - d->trial.square;
  const bool better = fell > 0 && (d->trial.good || !d->point->good);
  const bool renews = d->keeps && (better ? fell < poor * falls : d->kept);
  if (better) {
    if (d->keeps) {
      learn(fit, d);
      copy_values(fit, &d->trial, d->point);
    } else {
      zp_fit_copy_point(fit, &d->trial, d->point);
    }
    d->kept = d->keeps;
    d->foreseen += falls;
    relax(d, fell / falls);
  } else if (!renews) {
    damp(d);
  }
  if (renews) renew(fit, d);
  return better || renews;
}

/* A step so short, in multiples of the parameters' sizes, or a fall so small, as a part of the squares, is none. */
static const double near = 1e-9, flat = 1e-9;

/* Is the point the minimum, as far as the model says? Damped steps do not tell: along a valley they are short. */
static bool is_lowest(const ZpFit *fit, const Normal *normal, const ZpFitPoint *point) {
  double step[ZP_FIT_MOST], to[ZP_FIT_MOST];
  if (!damped_step(fit, normal, point->z, 0, step)) return false;
  const double falls = fall_over(fit, normal, step), least = fit->enough * point->square / (double)fit->rows;
  return go(fit, point->z, step, to) < near || falls < fmax(flat * flat * point->square, least);
}

/* One step => whether the search ends. */
static bool descend(ZpFit *fit, const bool *held, Descent *d) {
  const double variance = d->point->square / (double)fit->rows;
  const Normal normal = normal_of(fit, d->point, held);
  double step[ZP_FIT_MOST], before = d->point->square;
  if (is_lowest(fit, &normal, d->point)) return true;
  if (!damped_step(fit, &normal, d->point->z, d->damping, step)) {
    damp(d);
    return false;
  }
  const double moved = go(fit, d->point->z, step, d->trial.z), falls = fall_over(fit, &normal, step);
  if (moved < near) return true;
  if (d->keeps)
    zp_fit_find_values(fit, &d->trial);
  else
    zp_fit_go_to(fit, &d->trial);
  if (!take(fit, d, falls)) return falls < fit->rough * variance;
  return before > d->point->square && before - d->point->square < flat * flat * before;
}

/* => whether the search has ended at the minimum. */
static bool descend_all(ZpFit *fit, const bool *held, int most, Descent *d) {
  static const double strongest = 1e8;
  bool found = fit->n == 0;
  const bool opened = zp_fit_open_point(fit, &d->trial);
  for (int k = 0; k < most && opened && !found && d->damping < strongest && zp_fit_goes_on(fit); k++)
    found = descend(fit, held, d);
  free(d->trial.fitted);
  return found;
}

bool zp_fit_descend(ZpFit *fit, const bool *held, int most, ZpFitPoint *point) {
  static const double far = 0.1; /* how far the squares may have fallen with derivatives kept to the end */
  Descent d = {.point = point, .keeps = fit->runs > 0, .damping = 1e-3, .growth = 2};
  const bool found = descend_all(fit, held, most, &d);
  if (d.foreseen > far * point->square / (double)fit->rows && zp_fit_goes_on(fit)) renew(fit, &d);
  return found;
}

bool zp_fit_descend_kept(ZpFit *fit, const bool *held, int most, bool kept, ZpFitPoint *point) {
  Descent d = {.point = point, .keeps = fit->runs > 0, .kept = kept, .damping = 1e-3, .growth = 2};
  return descend_all(fit, held, most, &d);
}
