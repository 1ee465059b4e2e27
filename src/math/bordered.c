/* x = A^-1 f - V z with V = A^-1 B and S z = g - C A^-1 f, S = D - C V. */
#include "math/bordered.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

void zp_bordered_reserve(ZpBordered *m, size_t n, size_t border, size_t lower, size_t upper, ZpBandGroups groups,
                         ZpArena *arena) {
  size_t inner = n - border;
  *m = (ZpBordered){.n = n, .border = border};
  zp_band_reserve_groups(&m->A, inner, lower, upper, groups, arena);
  if (border == 0) return;
  zp_band_reserve_groups(&m->LU, inner, lower, upper, groups, arena);
  zp_band_reserve(&m->S, border, border - 1, border - 1, arena);
  m->B = zp_arena_take(arena, border * inner);
  m->C = zp_arena_take(arena, border * inner);
  m->D = zp_arena_take(arena, border * border);
  m->V = zp_arena_take(arena, border * inner);
  m->b = zp_arena_take(arena, n);
  m->left = zp_arena_take(arena, n);
  m->A.border = border;
  m->A.beside = m->B;
  m->A.corner = m->D;
}

void zp_bordered_clear(ZpBordered *m) {
  size_t inner = m->n - m->border;
  zp_band_clear(&m->A);
  if (m->border == 0) return;
  memset(m->B, 0, m->border * inner * sizeof *m->B);
  memset(m->C, 0, m->border * inner * sizeof *m->C);
  memset(m->D, 0, m->border * m->border * sizeof *m->D);
}

void zp_bordered_mirror(ZpBordered *m) {
  memcpy(m->C, m->B, m->border * m->A.n * sizeof *m->C);
  for (size_t i = 0; i < m->border; i++)
    for (size_t j = 0; j < i; j++)
      m->D[i * m->border + j] = m->D[j * m->border + i];
}

/* y -= a x */
static void take(size_t n, double a, const double *x, double *y) {
  for (size_t i = 0; i < n; i++)
    y[i] -= a * x[i];
}

void zp_bordered_multiply(const ZpBordered *m, const double *x, double *y) {
  size_t inner = m->n - m->border;
  zp_band_multiply(&m->A, x, y);
  for (size_t k = 0; k < m->border; k++) {
    take(inner, -x[inner + k], m->B + k * inner, y);
    y[inner + k] = zp_dot(inner, m->C + k * inner, x) + zp_dot(m->border, m->D + k * m->border, x + inner);
  }
}

/* -- factors -------------------------------------------------------------------------------------- */

static double largest(size_t n, const double *a) {
  double most = 0;
  for (size_t i = 0; i < n; i++)
    most = fmax(most, fabs(a[i]));
  return most;
}

/* An A that is singular alone may be regular with its border. It is shifted by the root of rounding: what the shift
 * changes and what rounding makes of its inverse are then alike, and each refinement takes out all but as little. */
static bool factor_inner(ZpBordered *m) {
  static const double shift = 0x1p-26;
  size_t inner = m->A.n, entries = m->A.entries;
  memcpy(m->LU.a, m->A.a, entries * sizeof *m->A.a);
  if (zp_band_factor(&m->LU)) return true;
  double size = largest(entries, m->A.a), some = shift * (size > 0 ? size : largest(m->border * inner, m->B));
  memcpy(m->LU.a, m->A.a, entries * sizeof *m->A.a);
  for (size_t i = 0; i < inner; i++)
    *zp_band_at(&m->LU, i, i) += some;
  return zp_band_factor(&m->LU);
}

bool zp_bordered_factor(ZpBordered *m) {
  size_t inner = m->n - m->border, k = m->border;
  if (k == 0) return zp_band_factor(&m->A);
  if (!factor_inner(m)) return false;
  memcpy(m->V, m->B, k * inner * sizeof *m->V);
  for (size_t j = 0; j < k; j++)
    zp_band_solve(&m->LU, m->V + j * inner);
  zp_band_clear(&m->S);
  for (size_t i = 0; i < k; i++)
    for (size_t j = 0; j < k; j++)
      *zp_band_at(&m->S, i, j) = m->D[i * k + j] - zp_dot(inner, m->C + i * inner, m->V + j * inner);
  return zp_band_factor(&m->S);
}

/* -- solution ------------------------------------------------------------------------------------- */

static void eliminate(const ZpBordered *m, double *b) {
  size_t inner = m->n - m->border;
  double *g = b + inner;
  zp_band_solve(&m->LU, b);
  for (size_t k = 0; k < m->border; k++)
    g[k] -= zp_dot(inner, m->C + k * inner, b);
  zp_band_solve(&m->S, g);
  for (size_t k = 0; k < m->border; k++)
    take(inner, g[k], m->V + k * inner, b);
}

void zp_bordered_solve(ZpBordered *m, double *b) {
  enum { REFINEMENTS = 2 };
  if (m->border == 0) {
    zp_band_solve(&m->A, b);
    return;
  }
  memcpy(m->b, b, m->n * sizeof *b);
  eliminate(m, b);
  for (int k = 0; k < REFINEMENTS; k++) {
    zp_bordered_multiply(m, b, m->left);
    for (size_t i = 0; i < m->n; i++)
      m->left[i] = m->b[i] - m->left[i];
    eliminate(m, m->left);
    take(m->n, -1, m->left, b);
  }
}
