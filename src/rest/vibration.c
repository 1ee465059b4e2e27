#include "rest/vibration.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "math/eigen.h"

/* Relative change of omega^2 in a round: far above what rounding leaves at N = 2001, far below what a mesh gives. */
static const double settled_to = 1e-7;

void zp_vibration_reserve(ZpVibration *v, size_t n, size_t most, ZpArena *arena) {
  v->n = n;
  v->m = n < most ? n : most;
  v->mass = zp_arena_take(arena, n);
  v->weighed = zp_arena_take(arena, n);
  v->u = zp_arena_take(arena, v->m * n);
  v->mu = zp_arena_take(arena, v->m * n);
  v->next = zp_arena_take(arena, v->m * n);
  v->reduced = zp_arena_take(arena, v->m * v->m);
  v->turn = zp_arena_take(arena, v->m * v->m);
  v->omega2 = zp_arena_take(arena, v->m);
  v->before = zp_arena_take(arena, v->m);
}

/* Multiples of the golden ratio, which scatter over -1 .. 1. */
static double scattered(size_t k) {
  double x = 0.6180339887498949 * (double)k;
  return 2 * (x - floor(x)) - 1;
}

/* m u => mu */
static void weigh(const ZpVibration *v, const double *u, double *mu) {
  if (v->weigh) {
    v->weigh(v->self, u, mu);
    return;
  }
  for (size_t i = 0; i < v->n; i++)
    mu[i] = v->mass[i] * u[i];
}

double zp_vibration_inner(const ZpVibration *v, const double *a, const double *b) {
  double sum = 0;
  weigh(v, b, v->weighed);
  for (size_t i = 0; i < v->n; i++)
    sum += a[i] * v->weighed[i];
  return sum;
}

void zp_vibration_take_out(const ZpVibration *v, const double *rows, size_t count, double *row) {
  for (int twice = 0; twice < 2; twice++) /* once leaves what rounding makes */
    for (size_t k = 0; k < count; k++) {
      const double *other = rows + k * v->n;
      double part = zp_vibration_inner(v, other, row);
      for (size_t i = 0; i < v->n; i++)
        row[i] -= part * other[i];
    }
}

/* a . b, by partial sums. */
ZP_KERNEL static double product(size_t n, const double *restrict a, const double *restrict b) {
  double lane[ZP_LANES] = {0};
  size_t i = 0;
  for (; i + ZP_LANES <= n; i += ZP_LANES)
    for (size_t k = 0; k < ZP_LANES; k++)
      lane[k] += a[i + k] * b[i + k];
  for (; i < n; i++)
    lane[i % ZP_LANES] += a[i] * b[i];
  return zp_sum_lanes(lane);
}

/* to += a x */
ZP_KERNEL static void add(size_t n, double a, const double *restrict x, double *restrict to) {
  for (size_t i = 0; i < n; i++)
    to[i] += a * x[i];
}

/* Make the vectors orthogonal and of length 1 with respect to the masses, and weigh them. */
static void orthonormalize(ZpVibration *v) {
  const size_t n = v->n;
  for (size_t j = 0; j < v->m; j++) {
    double *row = v->u + j * n, *heavy = v->mu + j * n;
    for (int twice = 0; twice < 2; twice++) /* once leaves what rounding makes */
      for (size_t k = 0; k < j; k++)
        add(n, -product(n, v->mu + k * n, row), v->u + k * n, row);
    weigh(v, row, heavy);
    const double scale = 1 / sqrt(product(n, row, heavy));
    for (size_t i = 0; i < n; i++) {
      row[i] *= scale;
      heavy[i] *= scale;
    }
  }
}

void zp_vibration_start(ZpVibration *v) {
  for (size_t j = 0; j < v->m; j++)
    for (size_t i = 0; i < v->n; i++)
      v->u[j * v->n + i] = scattered((i + 1) * (j + 1)) + (i % v->m == j);
  orthonormalize(v);
}

/* K^-1 m u of vector j => its row of next. */
static double *deflect(ZpVibration *v, size_t j) {
  double *next = v->next + j * v->n;
  memcpy(next, v->mu + j * v->n, v->n * sizeof *next);
  zp_arrow_solve(v->K, next);
  return next;
}

/* Each new vector is the sum of all rows of next, with its column of `turn`. Pieces of all fit the cache together. */
static void recombine(ZpVibration *v) {
  enum { PIECE = 1024 };
  const size_t n = v->n, m = v->m;
  memset(v->u, 0, m * n * sizeof *v->u);
  for (size_t first = 0; first < n; first += PIECE) {
    const size_t piece = n - first < PIECE ? n - first : PIECE;
    for (size_t j = 0; j < m; j++)
      for (size_t k = 0; k < m; k++)
        add(piece, v->turn[k * m + j], v->next + k * n + first, v->u + j * n + first);
  }
}

void zp_vibration_iterate(ZpVibration *v) {
  size_t n = v->n, m = v->m;
  for (size_t j = 0; j < m; j++)
    deflect(v, j);
  /* of u, orthonormal in m: u' m K^-1 m u has the eigenvalues 1 / omega^2 */
  for (size_t j = 0; j < m; j++)
    for (size_t k = 0; k <= j; k++)
      v->reduced[j * m + k] = v->reduced[k * m + j] = -product(n, v->mu + j * n, v->next + k * n);
  zp_eigen_symmetric(m, v->reduced, v->turn);
  for (size_t j = 0; j < m; j++)
    v->omega2[j] = -1 / v->reduced[j * m + j];
  recombine(v);
  orthonormalize(v);
}

double zp_vibration_residual(ZpVibration *v, size_t j) {
  double *left = deflect(v, j);
  for (size_t i = 0; i < v->n; i++)
    left[i] = v->u[j * v->n + i] - v->omega2[j] * left[i];
  return sqrt(zp_vibration_inner(v, left, left));
}

static bool settled(const ZpVibration *v, size_t modes) {
  for (size_t j = 0; j < modes; j++)
    if (!(fabs(v->omega2[j] - v->before[j]) < settled_to * fabs(v->omega2[j]))) return false;
  return true;
}

bool zp_vibration_solve(ZpVibration *v, size_t modes) {
  enum { MOST_ROUNDS = 200 };
  for (int round = 0; round < MOST_ROUNDS; round++) {
    memcpy(v->before, v->omega2, v->m * sizeof *v->before);
    zp_vibration_iterate(v);
    if (round > 0 && settled(v, modes)) return true;
  }
  return false;
}
