/* Letters of docs/theory.md, section 18; 0 and 1 are the step's start and end:
 *   d      an edge, m                              t   (d0 + d1) / (|d0| + |d1|)
 *   turn   angle from d0 to d1, = g . (d1 - d0)    k   discrete curvature of a joint
 *   T      S ((|d0| + |d1|) / 2 - l)               M   B ((k0 + k1) / 2 - k_nat) (k1 - k0) / (phi1 - phi0)
 * so that T (|d1| - |d0|) and M (phi1 - phi0) are the changes of the energies.
 */
#include "ribbon/rod_step.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "ribbon/rod_curl.h"
#include "ribbon/rod_maxwell.h"
#include "ribbon/rod_plastic.h"

static size_t edge_count(const ZpRodParams *p) {
  return p->ribbons * (p->nodes - 1);
}

void zp_rod_step_reserve(const ZpRodParams *p, ZpRodStep *s, ZpArena *arena) {
  double **plain[] = {&s->tx, &s->ty, &s->T, &s->M, &s->slope, &s->stiffness, &s->tension, &s->endx, &s->endy};
  for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++)
    *plain[i] = zp_arena_take(arena, p->lanes);
  size_t margin = ZP_ALIGNMENT / sizeof(double); /* one edge more before the first: a held slope, that never turns */
  double **with_margin[] = {&s->gx, &s->gy, &s->turn, &s->Rx, &s->Ry};
  for (size_t i = 0; i < sizeof with_margin / sizeof with_margin[0]; i++) {
    double *array = zp_arena_take(arena, margin + p->lanes);
    *with_margin[i] = array ? array + margin : NULL;
  }
}

/* atan(y) / y for y^2 up to 0.17, to rounding below 0.04: twelve terms of its series. */
static inline double atan_over(double y2) {
  double sum = 1.0 / 25;
  for (int k = 23; k >= 1; k -= 2)
    sum = 1.0 / k - y2 * sum;
  return sum;
}

/* sin(x) / x for |x| up to pi / 2 to rounding, to 1e-11 up to pi. */
static inline double sine_over(double x) {
  double x2 = x * x, sum = 1;
  for (int k = 22; k >= 2; k -= 2)
    sum = 1 - x2 / (k * (k + 1)) * sum;
  return sum;
}

/* An angle over its sine, from both: y is the tangent of an eighth of it. */
static inline double angle_over_sine(double sine, double cosine) {
  double t = sine / (1 + cosine), half = 1 + sqrt(1 + t * t), z = t / half, quarter = 1 + sqrt(1 + z * z);
  double y = z / quarter;
  return 8 * atan_over(y * y) / (quarter * half * (1 + cosine));
}

/* `still`: both ends are one point, where nothing turns; a constant where this is inlined. */
ZP_INLINE void mean_edges(const ZpRodParams *p, size_t padded, const ZpRodEval *e0, const ZpRodEval *e1, double damping,
                          bool still, const ZpRodStep *s) {
  const double *restrict x0 = e0->dpx, *restrict y0 = e0->dpy, *restrict x1 = e1->dpx, *restrict y1 = e1->dpy;
  const double *restrict ux0 = e0->ux, *restrict uy0 = e0->uy, *restrict ux1 = e1->ux, *restrict uy1 = e1->uy;
  const double *restrict over0 = e0->inverse, *restrict over1 = e1->inverse, *restrict S = p->S, *restrict T0 = e0->T,
                         *restrict T1 = e1->T;
  double *restrict tx = s->tx, *restrict ty = s->ty, *restrict turn = s->turn, *restrict gx = s->gx,
                   *restrict gy = s->gy, *restrict T = s->T;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double sx = x0[j] + x1[j], sy = y0[j] + y1[j];
    double L0 = x0[j] * ux0[j] + y0[j] * uy0[j], L1 = x1[j] * ux1[j] + y1[j] * uy1[j], over = 1 / (L0 + L1);
    double sine = ux0[j] * uy1[j] - uy0[j] * ux1[j], cosine = ux0[j] * ux1[j] + uy0[j] * uy1[j];
    double ratio = still ? 1 : angle_over_sine(sine, cosine), per_area = 0.5 * over0[j] * over1[j] * ratio;
    tx[j] = sx * over;
    ty[j] = sy * over;
    turn[j] = still ? 0 : ratio * sine;
    gx[j] = -per_area * sy;
    gy[j] = per_area * sx;
    T[j] = 0.5 * (T0[j] + T1[j]) + damping * S[j] * (L1 - L0);
  }
}

ZP_KERNEL static void edges_over_step(const ZpRodParams *p, size_t padded, const ZpRodEval *e0, const ZpRodEval *e1,
                                      double damping, const ZpRodStep *s) {
  mean_edges(p, padded, e0, e1, damping, false, s);
}

ZP_KERNEL static void edges_at_rest(const ZpRodParams *p, size_t padded, const ZpRodEval *e, const ZpRodStep *s) {
  mean_edges(p, padded, e, e, 0, true, s);
}

/* Restore places beyond the last edges, where the kernel over whole lanes has written: held slopes never turn; and
 * rigid edges, which do not stretch either: they have the length 1 and no tension at both ends. */
static void hold_slopes(const ZpRodParams *p, const ZpRodStep *s) {
  for (size_t j = edge_count(p); j < edge_count(p) + p->ribbons; j++)
    s->turn[j] = s->gx[j] = s->gy[j] = 0;
  for (size_t j = p->ribbons * p->rigid; j < p->ribbons * p->rigid_end; j++)
    if (zp_rod_is_rigid(p, j)) s->turn[j] = s->gx[j] = s->gy[j] = s->tx[j] = s->ty[j] = 0;
}

ZP_INLINE void mean_joints(const ZpRodParams *p, size_t padded, const ZpRodEval *e0, const ZpRodEval *e1,
                           double damping, bool still, const ZpRodStep *s) {
  const double *restrict turn = s->turn, *restrict before = turn - p->ribbons, *restrict half0 = e0->half,
                         *restrict half1 = e1->half, *restrict k0 = e0->k, *restrict k1 = e1->k, *restrict B = p->B,
                         *restrict natural = p->k0;
  double *restrict M = s->M, *restrict slope = s->slope, *restrict stiffness = s->stiffness;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double q1 = 1 + half1[j] * half1[j], over1 = 1 / q1;
    double root = still ? q1 : sqrt((1 + half0[j] * half0[j]) * q1);
    double turned = still ? 1 : sine_over(0.5 * (turn[j] - before[j]));
    slope[j] = turned * (2 * root + (1 - half0[j] * half1[j]) / root) * (1.0 / 3);
    double moment = B[j] * (0.5 * (k0[j] + k1[j]) - natural[j] + damping * (k1[j] - k0[j]));
    M[j] = moment * slope[j];
    /* half of how the slope changes with the angle; what it changes with the turn vanishes with the step */
    stiffness[j] = B[j] * (0.5 + damping) * slope[j] * slope[j] + moment * half1[j] * (q1 - over1) * (1.0 / 3);
  }
}

ZP_KERNEL static void joints_over_step(const ZpRodParams *p, size_t padded, const ZpRodEval *e0, const ZpRodEval *e1,
                                       double damping, const ZpRodStep *s) {
  mean_joints(p, padded, e0, e1, damping, false, s);
}

ZP_KERNEL static void joints_at_rest(const ZpRodParams *p, size_t padded, const ZpRodEval *e, const ZpRodStep *s) {
  mean_joints(p, padded, e, e, 0, true, s);
}

/* Two joints that bend together: each adds to the other's moment. */
static void bend_together(const ZpRodEnd *end, const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1,
                          double damping, ZpRodStep *s) {
  const size_t joint[2] = {end->held, end->next};
  for (int k = 0; k < 2; k++) {
    size_t j = joint[k], other = joint[1 - k];
    double half = e1->half[j], q = 1 + half * half;
    double moment =
        end->B * (0.5 * (e0->k[other] + e1->k[other]) - p->k0[other] + damping * (e1->k[other] - e0->k[other]));
    s->M[j] += moment * s->slope[j];
    s->stiffness[j] += moment * half * (q - 1 / q) * (1.0 / 3);
  }
}

static void bend_ends(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping, ZpRodStep *s) {
  for (size_t i = 0; i < p->ends; i++) {
    const ZpRodEnd *end = &p->end[i];
    bend_together(end, p, e0, e1, damping, s);
    s->across[i] = end->B * (0.5 + damping) * s->slope[end->held] * s->slope[end->next];
  }
}

ZP_KERNEL static void edge_forces(const ZpRodParams *p, size_t edges, const ZpRodStep *s) {
  const double *restrict M = s->M, *restrict next = M + p->ribbons, *restrict T = s->T, *restrict gx = s->gx,
                         *restrict gy = s->gy, *restrict tx = s->tx, *restrict ty = s->ty;
  double *restrict Rx = s->Rx, *restrict Ry = s->Ry;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double m = M[j] - next[j];
    Rx[j] = -m * gx[j] - T[j] * tx[j];
    Ry[j] = -m * gy[j] - T[j] * ty[j];
  }
}

/* Tension of the step that ends with these edges if it goes with them as at the last end: the present one has in it
 * what edges that turn are too long by until the iteration has shortened them, and that is far from what is to come. */
ZP_KERNEL static void foresee(const ZpRodParams *p, size_t padded, const ZpRodEval *e1, double damping,
                              const ZpRodStep *s) {
  const double *restrict dpx = e1->dpx, *restrict dpy = e1->dpy, *restrict tx = s->tx, *restrict ty = s->ty,
                         *restrict T = s->T, *restrict S = p->S;
  double *restrict endx = s->endx, *restrict endy = s->endy, *restrict tension = s->tension;
  double share = s->begun ? 0.5 + damping : 0;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    tension[j] = T[j] + share * S[j] * (tx[j] * (dpx[j] - endx[j]) + ty[j] * (dpy[j] - endy[j]));
    endx[j] = dpx[j];
    endy[j] = dpy[j];
  }
}

void zp_rod_step_begin(const ZpRodParams *p, const ZpRodEval *e0, ZpRodStep *s) {
  memcpy(s->T, e0->T, p->lanes * sizeof *s->T);
  s->begun = false;
}

void zp_rod_step(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping, ZpRodStep *s) {
  size_t edges = edge_count(p), padded = zp_round_up(edges), joints = zp_round_up(edges + p->ribbons);
  if (e0 == e1) {
    edges_at_rest(p, padded, e1, s);
    hold_slopes(p, s);
    joints_at_rest(p, joints, e1, s);
  } else {
    foresee(p, padded, e1, damping, s);
    s->begun = true;
    edges_over_step(p, padded, e0, e1, damping, s);
    hold_slopes(p, s);
    joints_over_step(p, joints, e0, e1, damping, s);
  }
  bend_ends(p, e0, e1, damping, s);
  zp_rod_curl_step(p, e0, e1, s);
  zp_rod_plastic_step(p, e1, e0 == e1, s);
  zp_rod_maxwell_step(p, e0, e1, e0 == e1, s);
  edge_forces(p, edges, s);
}

void zp_rod_step_scale(const ZpRodParams *p, const double axial[2], const double bending[2], ZpRodStep *s) {
  for (size_t j = 0; j < edge_count(p); j++)
    s->T[j] *= axial[j % p->ribbons];
  for (size_t j = 0; j < edge_count(p) + p->ribbons; j++)
    s->M[j] *= bending[j % p->ribbons];
  edge_forces(p, edge_count(p), s);
}

double zp_rod_step_loss(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping) {
  double sum = 0;
  for (size_t j = 0; j < edge_count(p); j++) {
    double stretched = (e1->T[j] - e0->T[j]);
    sum += stretched * stretched / p->S[j];
  }
  for (size_t j = 0; j < edge_count(p) + p->ribbons; j++) {
    double bent = e1->k[j] - e0->k[j];
    sum += p->B[j] * bent * bent;
  }
  for (const ZpRodEnd *end = p->end; end < p->end + p->ends; end++)
    sum += 2 * end->B * (e1->k[end->held] - e0->k[end->held]) * (e1->k[end->next] - e0->k[end->next]);
  return damping * sum;
}

/* c times g of one edge by g of another. */
ZP_INLINE void put_product(double c, double gx, double gy, double other_gx, double other_gy, double *restrict D) {
  D[0] = c * gx * other_gx;
  D[1] = c * gx * other_gy;
  D[2] = c * gy * other_gx;
  D[3] = c * gy * other_gy;
}

/* Each edge with that before it, with itself (stretching, bending of both joints, tension, and what moments do as the
 * edge turns) and with the next one: 12 numbers of D. */
ZP_KERNEL static void edge_stiffness(const ZpRodParams *p, size_t edges, const ZpRodEval *e0, const ZpRodEval *e1,
                                     double damping, const ZpRodStep *s, const double *restrict tensions,
                                     double *restrict D) {
  size_t r = p->ribbons;
  const double *restrict x0 = e0->dpx, *restrict y0 = e0->dpy, *restrict ux0 = e0->ux, *restrict uy0 = e0->uy,
                         *restrict x1 = e1->dpx, *restrict y1 = e1->dpy, *restrict ux1 = e1->ux, *restrict uy1 = e1->uy,
                         *restrict S = p->S, *restrict M = s->M, *restrict c = s->stiffness;
  const double *restrict all_tx = s->tx, *restrict all_ty = s->ty, *restrict all_gx = s->gx, *restrict all_gy = s->gy;
  const double *restrict next_M = M + r, *restrict next_c = c + r, *restrict before_gx = all_gx - r,
                         *restrict before_gy = all_gy - r, *restrict next_gx = all_gx + r,
                         *restrict next_gy = all_gy + r;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double L0 = x0[j] * ux0[j] + y0[j] * uy0[j], L1 = x1[j] * ux1[j] + y1[j] * uy1[j];
    double tx = all_tx[j], ty = all_ty[j], gx = all_gx[j], gy = all_gy[j];
    double tension = tensions[j] * (1 / (L0 + L1)), stretch = (0.5 + damping) * S[j] - tension;
    double bend = c[j] + next_c[j], twist = -0.5 * (M[j] - next_M[j]);
    put_product(-c[j], gx, gy, before_gx[j], before_gy[j], D + 12 * j);
    /* 0.5 dg/dd of g = n / L turned with the edge: -(t n + n t) / L^2, and (gy, -gx) is t / L */
    double across = stretch * tx * ty + bend * gx * gy + twist * (gy * gy - gx * gx);
    D[12 * j + 4] = stretch * tx * tx + tension + bend * gx * gx + twist * 2 * gy * gx;
    D[12 * j + 5] = across;
    D[12 * j + 6] = across;
    D[12 * j + 7] = stretch * ty * ty + tension + bend * gy * gy - twist * 2 * gx * gy;
    put_product(-next_c[j], gx, gy, next_gx[j], next_gy[j], D + 12 * j + 8);
  }
}

/* D += factor times g of edge a by g of edge b. */
static void add_product(const ZpRodStep *s, double factor, size_t a, size_t b, double D[4]) {
  D[0] += factor * s->gx[a] * s->gx[b];
  D[1] += factor * s->gx[a] * s->gy[b];
  D[2] += factor * s->gy[a] * s->gx[b];
  D[3] += factor * s->gy[a] * s->gy[b];
}

/* Joints that bend together: the held one turns as the near edge does, the next one against it and with the far edge.
 */
static void end_stiffness(const ZpRodStep *s, const ZpRodEnd *end, double across, double (*D)[4]) {
  size_t near = end->near, far = end->far;
  int right = far > near;
  add_product(s, -2 * across, near, near, D[3 * near + 1]);
  add_product(s, across, near, far, D[3 * near + (right ? 2 : 0)]);
  add_product(s, across, far, near, D[3 * far + (right ? 0 : 2)]);
}

void zp_rod_stiffness(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping,
                      const ZpRodStep *s, const double *tension, double (*D)[4]) {
  edge_stiffness(p, edge_count(p), e0, e1, damping, s, tension, &D[0][0]);
  for (size_t i = 0; i < p->ends; i++)
    end_stiffness(s, &p->end[i], s->across[i], D);
  zp_rod_plastic_stiffness(p, s, D);
  if (e0 != e1) zp_rod_maxwell_stiffness(p, s, D);
}

void zp_rod_damping(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s, double (*spare)[4],
                    double (*D)[4]) {
  zp_rod_step(p, e0, e1, 0, s);
  zp_rod_stiffness(p, e0, e1, 0, s, e1->T, spare);
  zp_rod_step(p, e0, e1, 1, s);
  zp_rod_stiffness(p, e0, e1, 1, s, e1->T, D);
  for (size_t k = 0; k < 3 * edge_count(p); k++)
    for (size_t c = 0; c < 4; c++)
      D[k][c] -= spare[k][c];
}
