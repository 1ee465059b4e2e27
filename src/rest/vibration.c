#include "rest/vibration.h"

#include <math.h>
#include <string.h>

#include "math/eigen.h"

/* Relative change of omega^2 in a round: far above what rounding leaves at N = 2001, far below what a mesh gives. */
static const double settled_to = 1e-7;

void zp_vibration_reserve(ZpVibration *v, size_t n, size_t most, ZpArena *arena) {
  v->n = n;
  v->m = n < most ? n : most;
  v->mass = zp_arena_take(arena, n);
  v->weighed = zp_arena_take(arena, n);
  v->u = zp_arena_take(arena, v->m * n);
  v->next = zp_arena_take(arena, v->m * n);
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

/* Make the rows of `rows` orthogonal and of length 1 with respect to the masses. */
static void orthonormalize(const ZpVibration *v, double *rows) {
  for (size_t j = 0; j < v->m; j++) {
    double *row = rows + j * v->n;
    zp_vibration_take_out(v, rows, j, row);
    double scale = 1 / sqrt(zp_vibration_inner(v, row, row));
    for (size_t i = 0; i < v->n; i++)
      row[i] *= scale;
  }
}

void zp_vibration_start(ZpVibration *v) {
  for (size_t j = 0; j < v->m; j++)
    for (size_t i = 0; i < v->n; i++)
      v->u[j * v->n + i] = scattered((i + 1) * (j + 1)) + (i % v->m == j);
  orthonormalize(v, v->u);
}

/* K^-1 m u of vector j => its row of next. */
static double *deflect(ZpVibration *v, size_t j) {
  double *next = v->next + j * v->n;
  weigh(v, v->u + j * v->n, next);
  zp_arrow_solve(v->K, next);
  return next;
}

void zp_vibration_iterate(ZpVibration *v) {
  size_t n = v->n, m = v->m;
  for (size_t j = 0; j < m; j++)
    deflect(v, j);
  /* of u, orthonormal in m: u' m K^-1 m u has the eigenvalues 1 / omega^2 */
  for (size_t j = 0; j < m; j++)
    for (size_t k = 0; k < m; k++)
      v->reduced[j * m + k] = -0.5 * (zp_vibration_inner(v, v->u + j * n, v->next + k * n) +
                                      zp_vibration_inner(v, v->u + k * n, v->next + j * n));
  zp_eigen_symmetric(m, v->reduced, v->turn);
  for (size_t j = 0; j < m; j++) {
    v->omega2[j] = -1 / v->reduced[j * m + j];
    double *to = v->u + j * n;
    memset(to, 0, n * sizeof *to);
    for (size_t k = 0; k < m; k++)
      for (size_t i = 0; i < n; i++)
        to[i] += v->turn[k * m + j] * v->next[k * n + i];
  }
  orthonormalize(v, v->u);
}

double zp_vibration_residual(ZpVibration *v, size_t j) {
  double *left = deflect(v, j);
  for (size_t i = 0; i < v->n; i++)
    left[i] = v->u[j * v->n + i] - v->omega2[j] * left[i];
  return sqrt(zp_vibration_inner(v, left, left));
}

static bool settled(const ZpVibration *v, const double *before, size_t modes) {
  for (size_t j = 0; j < modes; j++)
    if (!(fabs(v->omega2[j] - before[j]) < settled_to * fabs(v->omega2[j]))) return false;
  return true;
}

bool zp_vibration_solve(ZpVibration *v, size_t modes) {
  enum { MOST_ROUNDS = 200 };
  double before[ZP_VIBRATIONS] = {0};
  for (int round = 0; round < MOST_ROUNDS; round++) {
    memcpy(before, v->omega2, sizeof before);
    zp_vibration_iterate(v);
    if (round > 0 && settled(v, before, modes)) return true;
  }
  return false;
}
