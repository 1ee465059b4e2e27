/* Letters of docs/theory.md, section 18; 0 and 1 are the step's start and end:
 *   d      an edge, m                              t   (d0 + d1) / (|d0| + |d1|)
 *   turn   angle from d0 to d1, = g . (d1 - d0)    k   2 tan(phi / 2) of a joint
 *   T      S ((|d0| + |d1|) / 2 - l)               M   B ((k0 + k1) / 2 - k_nat) (k1 - k0) / (phi1 - phi0)
 * so that T (|d1| - |d0|) and M (phi1 - phi0) are the changes of the energies.
 */
#include "ribbon/rod_step.h"

#include <math.h>
#include <string.h>

static size_t edge_count(const ZpRodParams *p) {
  return p->ribbons * (p->nodes - 1);
}

void zp_rod_step_carve(const ZpRodParams *p, ZpRodStep *s, ZpCarver *carver) {
  double **plain[] = {&s->tx, &s->ty, &s->T, &s->M, &s->stiffness};
  for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++)
    *plain[i] = zp_carve(carver, p->stride);
  size_t margin = ZP_ALIGNMENT / sizeof(double); /* one edge more before the first: a held slope, that never turns */
  double **with_margin[] = {&s->gx, &s->gy, &s->turn, &s->Rx, &s->Ry};
  for (size_t i = 0; i < sizeof with_margin / sizeof with_margin[0]; i++) {
    double *array = zp_carve(carver, margin + p->stride);
    *with_margin[i] = array ? array + margin : NULL;
  }
}

/* sin(x) / x and x / sin(x)-like quotients near 0. */
static double sine_over(double x) {
  return fabs(x) < 1e-4 ? 1 - x * x / 6 : sin(x) / x;
}

static void step_edges(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping, ZpRodStep *s) {
  for (size_t j = 0; j < edge_count(p); j++) {
    double sx = e0->dpx[j] + e1->dpx[j], sy = e0->dpy[j] + e1->dpy[j];
    double L0 = e0->dpx[j] * e0->ux[j] + e0->dpy[j] * e0->uy[j], L1 = e1->dpx[j] * e1->ux[j] + e1->dpy[j] * e1->uy[j];
    double over = 1 / (L0 + L1), change = L1 - L0;
    double sine = e0->ux[j] * e1->uy[j] - e0->uy[j] * e1->ux[j], cosine = e0->ux[j] * e1->ux[j] + e0->uy[j] * e1->uy[j];
    double turn = atan2(sine, cosine);
    double per_area = 0.5 * e0->inverse[j] * e1->inverse[j] * (fabs(sine) > 1e-8 ? turn / sine : 1 / cosine);
    s->tx[j] = sx * over;
    s->ty[j] = sy * over;
    s->turn[j] = turn;
    s->gx[j] = -per_area * sy;
    s->gy[j] = per_area * sx;
    s->T[j] = 0.5 * (e0->T[j] + e1->T[j]) + damping * p->S[j] * change;
    s->loss += damping * p->S[j] * change * change;
  }
  for (size_t j = edge_count(p); j < edge_count(p) + p->ribbons; j++)
    s->turn[j] = s->gx[j] = s->gy[j] = 0;
}

static void step_joints(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping, ZpRodStep *s) {
  const double *turn_before = s->turn - p->ribbons;
  for (size_t j = 0; j < edge_count(p) + p->ribbons; j++) {
    double k0 = e0->k[j], k1 = e1->k[j], change = k1 - k0, B = p->B[j];
    double slope = sine_over(0.5 * (s->turn[j] - turn_before[j])) * sqrt((1 + 0.25 * k0 * k0) * (1 + 0.25 * k1 * k1));
    double moment = B * (0.5 * (k0 + k1) - p->k0[j] + damping * change);
    s->M[j] = moment * slope;
    /* the slope itself changes by k1 / 4 of it; what it changes with the turn vanishes with the step */
    s->stiffness[j] = (B * (0.5 + damping) * slope + moment * 0.25 * k1) * slope;
    s->loss += damping * B * change * change;
  }
}

void zp_rod_step(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping, ZpRodStep *s) {
  s->loss = 0;
  step_edges(p, e0, e1, damping, s);
  step_joints(p, e0, e1, damping, s);
  for (size_t j = 0; j < edge_count(p); j++) {
    double M = s->M[j] - s->M[j + p->ribbons];
    s->Rx[j] = -M * s->gx[j] - s->T[j] * s->tx[j];
    s->Ry[j] = -M * s->gy[j] - s->T[j] * s->ty[j];
  }
}

/* The edge with itself: stretching, bending of both joints, tension, and what moments do as the edge turns. */
static void own_stiffness(const ZpRodParams *p, const ZpRodStep *s, double damping, double over, size_t j,
                          double D[4]) {
  size_t next = j + p->ribbons;
  double tx = s->tx[j], ty = s->ty[j], gx = s->gx[j], gy = s->gy[j];
  double tension = s->T[j] * over, stretch = (0.5 + damping) * p->S[j] - tension;
  double bend = s->stiffness[j] + s->stiffness[next], twist = -0.5 * (s->M[j] - s->M[next]);
  /* 0.5 dg/dd of g = n / L turned with the edge: -(t n + n t) / L^2, and (gy, -gx) is t / L */
  D[0] = stretch * tx * tx + tension + bend * gx * gx + twist * 2 * gy * gx;
  D[1] = D[2] = stretch * tx * ty + bend * gx * gy + twist * (gy * gy - gx * gx);
  D[3] = stretch * ty * ty + tension + bend * gy * gy - twist * 2 * gx * gy;
}

static void coupling(const ZpRodStep *s, size_t joint, ptrdiff_t j, ptrdiff_t k, double D[4]) {
  double c = -s->stiffness[joint];
  D[0] = c * s->gx[j] * s->gx[k];
  D[1] = c * s->gx[j] * s->gy[k];
  D[2] = c * s->gy[j] * s->gx[k];
  D[3] = c * s->gy[j] * s->gy[k];
}

void zp_rod_step_stiffness(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, double damping,
                           const ZpRodStep *s, double (*D)[4]) {
  for (size_t j = 0; j < edge_count(p); j++) {
    ptrdiff_t here = (ptrdiff_t)j, step = (ptrdiff_t)p->ribbons;
    double L0 = e0->dpx[j] * e0->ux[j] + e0->dpy[j] * e0->uy[j], L1 = e1->dpx[j] * e1->ux[j] + e1->dpy[j] * e1->uy[j];
    coupling(s, j, here, here - step, D[3 * j]);
    own_stiffness(p, s, damping, 1 / (L0 + L1), j, D[3 * j + 1]);
    coupling(s, j + p->ribbons, here, here + step, D[3 * j + 2]);
  }
}
