/* Letters: r = G(x) - x; R the differences of r between pairs, as columns; g their coefficients for which |r - R g| is
 * least. */
#include "solve/fixed_point.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

enum { DEPTH = ZP_FIXED_POINT_DEPTH };
static const double dependent = 1e-10; /* share of a column whose remainder is rounding */

void zp_fixed_point_reserve(ZpFixedPoint *f, size_t n, size_t judged, ZpArena *arena) {
  f->n = n;
  f->judged = judged;
  f->pairs = -1;
  f->x = zp_arena_take(arena, n);
  f->left = zp_arena_take(arena, n);
  f->rest = zp_arena_take(arena, judged);
  for (int k = 0; k < DEPTH; k++) {
    f->moved[k] = zp_arena_take(arena, n);
    f->changed[k] = zp_arena_take(arena, n);
    f->q[k] = zp_arena_take(arena, judged);
  }
}

void zp_fixed_point_forget(ZpFixedPoint *f) {
  f->pairs = -1;
}

static void subtract(size_t n, double share, const double *b, double *a) {
  for (size_t i = 0; i < n; i++)
    a[i] -= share * b[i];
}

/* Put the newest differences in the place of the oldest. */
static void remember(ZpFixedPoint *f, const double *x, const double *mapped) {
  if (f->pairs >= 0) {
    double *moved = f->moved[DEPTH - 1], *changed = f->changed[DEPTH - 1];
    memmove(f->moved + 1, f->moved, (DEPTH - 1) * sizeof *f->moved);
    memmove(f->changed + 1, f->changed, (DEPTH - 1) * sizeof *f->changed);
    f->moved[0] = moved;
    f->changed[0] = changed;
    for (size_t i = 0; i < f->n; i++) {
      changed[i] = mapped[i] - x[i] - f->left[i];
      moved[i] = mapped[i] - (f->x[i] + f->left[i]);
    }
  }
  if (f->pairs < DEPTH) f->pairs++;
  memcpy(f->x, x, f->n * sizeof *x);
  for (size_t i = 0; i < f->n; i++)
    f->left[i] = mapped[i] - x[i];
}

/* R = Q T by Gram and Schmidt, twice; column k is made orthogonal to those before. False if it depends on them. */
static bool orthogonal(ZpFixedPoint *f, int k, double T[DEPTH][DEPTH]) {
  double *q = f->q[k], size = sqrt(zp_dot(f->judged, f->changed[k], f->changed[k]));
  memcpy(q, f->changed[k], f->judged * sizeof *q);
  for (int j = 0; j < k; j++)
    T[j][k] = 0;
  for (int twice = 0; twice < 2; twice++)
    for (int j = 0; j < k; j++) {
      double share = zp_dot(f->judged, f->q[j], q);
      T[j][k] += share;
      subtract(f->judged, share, f->q[j], q);
    }
  T[k][k] = sqrt(zp_dot(f->judged, q, q));
  if (!(T[k][k] > dependent * size)) return false;
  for (size_t i = 0; i < f->judged; i++)
    q[i] /= T[k][k];
  return true;
}

void zp_fixed_point_next(ZpFixedPoint *f, const double *x, const double *mapped, double *next) {
  double T[DEPTH][DEPTH], g[DEPTH];
  int used = 0;
  remember(f, x, mapped);
  while (used < f->pairs && orthogonal(f, used, T))
    used++;
  memcpy(f->rest, f->left, f->judged * sizeof *f->rest);
  for (int k = 0; k < used; k++) {
    g[k] = zp_dot(f->judged, f->q[k], f->rest);
    subtract(f->judged, g[k], f->q[k], f->rest);
  }
  memcpy(next, mapped, f->n * sizeof *next);
  for (int k = used - 1; k >= 0; k--) {
    for (int j = k + 1; j < used; j++)
      g[k] -= T[k][j] * g[j];
    g[k] /= T[k][k];
    subtract(f->n, g[k], f->moved[k], next);
  }
}
