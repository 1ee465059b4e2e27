/* Bezier surface. Letters of docs/theory.md, section 4.4:
 *   h_on, h_switched  h where the authors' breakdown switch acts, and whose force it then takes, m
 *   t  curve parameter of a station, (i - front) / (N - 1 - front)     g, h, W, K as in plates.c
 */
#include "electro/surface.h"

#include "base/kernel.h"

enum { GAUSS = 2 };
static const double gauss_at[GAUSS] = {0.21132486540518712, 0.78867513459481287}; /* weights 1/2 */

/* The sum of weight * value over interleaved points of two curves => sum[0] upper, sum[1] lower. */
ZP_KERNEL static void moments(size_t points, const double *restrict weight, const double *restrict value, double *sum) {
  double lane[ZP_LANES] = {0};
  size_t whole = points / ZP_LANES * ZP_LANES;
  for (size_t j = 0; j < whole; j += ZP_LANES) {
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++)
      lane[k] += weight[j + k] * value[j + k];
  }
  for (size_t j = whole; j < points; j++)
    lane[j - whole] += weight[j] * value[j];
  sum[0] = (lane[0] + lane[2]) + (lane[4] + lane[6]);
  sum[1] = (lane[1] + lane[3]) + (lane[5] + lane[7]);
}

/* gap(t) and x'(t) of the pair of curves. */
static void fit(const ZpBezierBasis *basis, const double *x, const double *y, size_t front, size_t end,
                const double direction[2], double gap[4], double slope[3]) {
  static const double horizontal[2] = {1, 0};
  size_t points = 2 * basis->count;
  double sum_x1[2], sum_x2[2], sum_y1[2], sum_y2[2];
  moments(points, basis->B1, x + 2 * front, sum_x1);
  moments(points, basis->B1, y + 2 * front, sum_y1);
  moments(points, basis->B2, x + 2 * front, sum_x2);
  moments(points, basis->B2, y + 2 * front, sum_y2);
  ZpCubic cx[2], cy[2];
  for (size_t r = 0; r < 2; r++) {
    double moment[4] = {sum_x1[r], sum_y1[r], sum_x2[r], sum_y2[r]};
    double first[2] = {x[2 * front + r], y[2 * front + r]}, last[2] = {x[2 * end + r], y[2 * end + r]};
    zp_bezier_fit(basis, moment, first, last, direction, horizontal, &cx[r], &cy[r]);
  }
  for (int k = 0; k < 4; k++)
    gap[k] = cy[0].c[k] - cy[1].c[k];
  for (int k = 0; k < 3; k++)
    slope[k] = 0.5 * (k + 1) * (cx[0].c[k + 1] + cx[1].c[k + 1]);
}

/* Force of the interval left of each free station but the first. */
ZP_KERNEL static void intervals(size_t count, const double *restrict gap, const double *restrict slope, double d,
                                double K, double h_c, double h_on, double h_switched, double *restrict Fy) {
  double dt = 1 / (double)count;
  double g0 = gap[0] + d, g1 = gap[1], g2 = gap[2], g3 = gap[3], s0 = slope[0], s1 = slope[1], s2 = slope[2];
  ZP_SIMD
  for (int i = 0; i < (int)count; i++) {
    double sum = 0;
    for (int q = 0; q < GAUSS; q++) {
      double t = (i + gauss_at[q]) * dt;
      double h = g0 + t * (g1 + t * (g2 + t * g3));
      double h_law = h > h_c ? h : h_c;
      double inverse = 1 / (h < h_on ? h_switched : h_law);
      sum += K * inverse * inverse * (s0 + t * (s1 + t * s2));
    }
    Fy[i] = sum * (dt / GAUSS);
  }
}

void zp_surface_bezier(const ZpPlatesParams *p, const ZpBezierBasis *basis, const double *x, const double *y,
                       size_t front, const double direction[2], double U, ZpPlatesEval *e) {
  size_t end = p->nodes - 1;
  for (size_t i = 0; i < p->nodes; i++)
    e->Fx[i] = 0;
  for (size_t i = 0; i <= front; i++)
    e->Fy[i] = 0;
  if (front == end) return;
  double gap[4], slope[3];
  fit(basis, x, y, front, end, direction, gap, slope);
  double h_switched = p->h_switch_per_volt * U; /* where the switch believes breakdown to be, at h_on in truth */
  double h_on = h_switched - p->switch_offset + p->d;
  intervals(end - front, gap, slope, p->d, p->k * U * U, zp_plates_least_h(p, U), h_switched > 0 ? h_on : 0, h_switched,
            e->Fy + front + 1);
  e->Fy[end] += p->flat_length * zp_plates_law(p, U, y[2 * end] - y[2 * end + 1]).W;
}
