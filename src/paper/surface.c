/* Bezier surface. Letters of docs/theory.md, section 4.4:
 *   h_on, h_switched  h where the authors' breakdown switch acts, and whose force it then takes, m
 *   t  curve parameter of a station, (i - front) / (N - 1 - front)     g, h, W, K as in plates.c
 */
#include "paper/surface.h"

#include <math.h>
#include <string.h>

#include "base/pair.h"

enum { GAUSS = 2 };
static const double gauss_at[GAUSS] = {0.21132486540518712, 0.78867513459481287}; /* weights 1/2 */

void zp_surface_reserve(size_t nodes, ZpBezierSurface *surface, ZpArena *arena) {
  surface->fit.B1 = zp_arena_take(arena, 2 * nodes);
  surface->fit.B2 = zp_arena_take(arena, 2 * nodes);
  surface->t0 = zp_arena_take(arena, nodes);
  surface->t1 = zp_arena_take(arena, nodes);
  surface->closing = zp_arena_take(arena, nodes);
}

void zp_surface_prepare(ZpBezierSurface *surface, size_t stations) {
  if (surface->stations == stations) return;
  surface->stations = stations;
  zp_bezier_basis(&surface->fit, stations);
  for (size_t i = 0; i + 1 < stations; i++) {
    surface->t0[i] = ((double)i + gauss_at[0]) / (double)(stations - 1);
    surface->t1[i] = ((double)i + gauss_at[1]) / (double)(stations - 1);
  }
}

/* The sums of a fit over interleaved points of two curves: of B1 x, B1 y, B2 x, B2 y, for each curve. */
typedef struct Moments {
  double of[2][4];
} Moments;

ZP_KERNEL static void sum_moments(size_t points, const double *restrict B1, const double *restrict B2,
                                  const double *restrict x, const double *restrict y, Moments *moments) {
  double x1[ZP_LANES] = {0}, y1[ZP_LANES] = {0}, x2[ZP_LANES] = {0}, y2[ZP_LANES] = {0};
  size_t whole = points / ZP_LANES * ZP_LANES;
  for (size_t j = 0; j < whole; j += ZP_LANES) {
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++) {
      x1[k] += B1[j + k] * x[j + k];
      y1[k] += B1[j + k] * y[j + k];
      x2[k] += B2[j + k] * x[j + k];
      y2[k] += B2[j + k] * y[j + k];
    }
  }
  for (size_t j = whole; j < points; j++) {
    x1[j - whole] += B1[j] * x[j];
    y1[j - whole] += B1[j] * y[j];
    x2[j - whole] += B2[j] * x[j];
    y2[j - whole] += B2[j] * y[j];
  }
  const double *lanes[4] = {x1, y1, x2, y2};
  for (int r = 0; r < 2; r++)
    for (int m = 0; m < 4; m++)
      moments->of[r][m] = (lanes[m][r] + lanes[m][r + 2]) + (lanes[m][r + 4] + lanes[m][r + 6]);
}

/* gap(t) and x'(t) of the pair of curves. */
static void fit(const ZpBezierBasis *basis, const double *x, const double *y, size_t front, size_t end,
                const double direction[2], double gap[4], double slope[3]) {
  static const double horizontal[2] = {1, 0};
  Moments moments;
  sum_moments(2 * basis->count, basis->B1, basis->B2, x + 2 * front, y + 2 * front, &moments);
  ZpCubic cx[2], cy[2];
  for (size_t r = 0; r < 2; r++) {
    double first[2] = {x[2 * front + r], y[2 * front + r]}, last[2] = {x[2 * end + r], y[2 * end + r]};
    zp_bezier_fit(basis, moments.of[r], first, last, direction, horizontal, &cx[r], &cy[r]);
  }
  for (int k = 0; k < 4; k++)
    gap[k] = cy[0].c[k] - cy[1].c[k];
  for (int k = 0; k < 3; k++)
    slope[k] = 0.5 * (k + 1) * (cx[0].c[k + 1] + cx[1].c[k + 1]);
}

/* The constants of the law at one voltage. */
typedef struct Law {
  double d, K, h_c, h_on, h_switched;
} Law;

/* Attraction of each interval, from the left neighbour to a free station. `padded` >= count intervals are computed, a
 * whole number of vectors; those beyond count have no meaning. */
ZP_KERNEL static void intervals(size_t count, size_t padded, const double *gap, const double *slope, Law law,
                                const double *restrict t0, const double *restrict t1, double *restrict closing) {
  double h_c = law.h_c, h_on = law.h_on, h_switched = law.h_switched;
  double g0 = gap[0] + law.d, g1 = gap[1], g2 = gap[2], g3 = gap[3], s0 = slope[0], s1 = slope[1], s2 = slope[2];
  double K = law.K / (double)(GAUSS * count);
  ZP_SIMD
  for (size_t i = 0; i < padded; i++) {
    double hh[GAUSS], dx[GAUSS];
    for (int q = 0; q < GAUSS; q++) {
      double t = q == 0 ? t0[i] : t1[i];
      double h = g0 + t * (g1 + t * (g2 + t * g3));
      double h_law = h > h_c ? h : h_c, h_of = h < h_on ? h_switched : h_law;
      hh[q] = h_of * h_of;
      dx[q] = s0 + t * (s1 + t * s2);
    }
    /* dx0 / hh0 + dx1 / hh1 with one division, which is the expensive operation here */
    closing[i] = K * (dx[0] * hh[1] + dx[1] * hh[0]) / (hh[0] * hh[1]);
  }
}

ZP_KERNEL static void spread(size_t count, const double *restrict closing, double *restrict Fy) {
  ZP_SIMD
  for (size_t i = 0; i < count; i++)
    zp_set_pair(Fy, i, -closing[i], closing[i]);
}

void zp_surface_bezier(const ZpPlatesParams *p, const ZpBezierSurface *surface, const double *x, const double *y,
                       size_t front, const double direction[2], double U, double *Fy) {
  size_t end = p->nodes - 1;
  memset(Fy, 0, 2 * (front + 1) * sizeof(double)); /* a force between joined nodes moves nothing */
  if (front == end) return;
  double gap[4], slope[3];
  fit(&surface->fit, x, y, front, end, direction, gap, slope);
  /* h_switched: the gap at which the switch of the authors assumes breakdown; h_on: the gap at which it occurs */
  double h_switched = p->h_switch_per_volt * fabs(U), h_on = h_switched > 0 ? h_switched - p->switch_offset + p->d : 0;
  Law law = {p->d, p->k * U * U, zp_plates_least_h(p, U), h_on, h_switched};
  size_t count = end - front, padded = zp_round_up(count);
  intervals(count, padded, gap, slope, law, surface->t0, surface->t1, surface->closing);
  spread(count, surface->closing, Fy + 2 * (front + 1));
  double platform = p->flat_length * zp_plates_law(p, U, y[2 * end] - y[2 * end + 1]).W;
  Fy[2 * end] -= platform;
  Fy[2 * end + 1] += platform;
}
