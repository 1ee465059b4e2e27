/* Discrete elastic rod. Letters of docs/theory.md, section 8:
 *   u, n   unit vector of an edge, and turned left       phi   angle between the edges at a joint
 *   k      2 tan(phi / 2), the discrete curvature        M     moment dE/dphi, N m
 *   T      tension, N                                    R     force of an edge on its right node, N
 */
#include "ribbon/rod.h"

#include <math.h>

#include "base/kernel.h"

static size_t edge_count(const ZpRodParams *p) {
  return p->ribbons * (p->nodes - 1);
}

void zp_rod_carve(const ZpRodParams *p, ZpRodEval *e, ZpCarver *carver) {
  size_t margin = ZP_ALIGNMENT / sizeof(double);
  double **plain[] = {&e->dpx, &e->dpy, &e->T, &e->k, &e->M};
  for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++)
    *plain[i] = zp_carve(carver, p->stride);
  double **with_margin[] = {&e->ux, &e->uy, &e->inverse, &e->Rx, &e->Ry};
  for (size_t i = 0; i < sizeof with_margin / sizeof with_margin[0]; i++) {
    double *array = zp_carve(carver, margin + p->stride);
    *with_margin[i] = array ? array + margin : NULL;
  }
  if (!carver->base) return;
  for (size_t r = 0; r < p->ribbons; r++)
    (e->ux - p->ribbons)[r] = 1;
}

ZP_KERNEL static void edge_directions(const ZpRodParams *p, size_t padded, const double *restrict x,
                                      const double *restrict y, const ZpRodEval *e) {
  size_t s = p->ribbons;
  const double *restrict l = p->l, *restrict S = p->S;
  double *restrict dpx = e->dpx, *restrict dpy = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy,
                   *restrict inverse = e->inverse, *restrict T = e->T;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double dx = x[j + s] - x[j], dy = y[j + s] - y[j];
    double length = sqrt(dx * dx + dy * dy), over = 1 / length;
    dpx[j] = dx;
    dpy[j] = dy;
    inverse[j] = over;
    ux[j] = dx * over;
    uy[j] = dy * over;
    T[j] = S[j] * (length - l[j]);
  }
}

ZP_KERNEL static void joint_moments(const ZpRodParams *p, size_t padded, const ZpRodEval *e) {
  const double *restrict ux = e->ux, *restrict uy = e->uy, *restrict bx = ux - p->ribbons,
                         *restrict by = uy - p->ribbons;
  const double *restrict B = p->B, *restrict k0 = p->k0;
  double *restrict k_of = e->k, *restrict M = e->M;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double sine = bx[j] * uy[j] - by[j] * ux[j], cosine = bx[j] * ux[j] + by[j] * uy[j];
    double k = 2 * sine / (1 + cosine);
    k_of[j] = k;
    M[j] = B[j] * (k - k0[j]) * (1 + 0.25 * k * k);
  }
}

ZP_KERNEL static void edge_forces(const ZpRodParams *p, size_t padded, const ZpRodEval *e) {
  size_t s = p->ribbons;
  const double *restrict ux = e->ux, *restrict uy = e->uy, *restrict inverse = e->inverse, *restrict T = e->T,
                         *restrict M = e->M;
  double *restrict Rx = e->Rx, *restrict Ry = e->Ry;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double Q = (M[j] - M[j + s]) * inverse[j]; /* shear force that turns the edge */
    Rx[j] = Q * uy[j] - T[j] * ux[j];
    Ry[j] = -Q * ux[j] - T[j] * uy[j];
  }
}

/* What lies beyond the last edges, where kernels over whole lanes have written. */
static void hold_right_ends(const ZpRodParams *p, const ZpRodEval *e) {
  size_t edges = edge_count(p);
  for (size_t j = edges; j < edges + p->ribbons; j++) {
    e->ux[j] = 1;
    e->uy[j] = e->inverse[j] = 0;
  }
}

void zp_rod_eval(const ZpRodParams *p, const double *x, const double *y, ZpRodEval *e) {
  size_t edges = edge_count(p), padded = zp_round_up(edges);
  edge_directions(p, padded, x, y, e);
  hold_right_ends(p, e);
  joint_moments(p, zp_round_up(edges + p->ribbons), e);
  edge_forces(p, padded, e);
  for (size_t j = edges; j < padded; j++)
    e->Rx[j] = e->Ry[j] = 0;
}

double zp_rod_stretching_energy(const ZpRodParams *p, const ZpRodEval *e) {
  double sum = 0;
  for (size_t j = 0; j < edge_count(p); j++)
    sum += e->T[j] * e->T[j] / p->S[j];
  return sum / 2;
}

double zp_rod_bending_energy(const ZpRodParams *p, const ZpRodEval *e) {
  double sum = 0;
  for (size_t j = 0; j < edge_count(p) + p->ribbons; j++)
    sum += p->B[j] * (e->k[j] - p->k0[j]) * (e->k[j] - p->k0[j]);
  return sum / 2;
}

/* Second derivative of a joint's energy by its angle. */
static double joint_stiffness(const ZpRodParams *p, const ZpRodEval *e, size_t j) {
  double k = e->k[j], q = 1 + 0.25 * k * k;
  return p->B[j] * q * (q + 0.5 * k * (k - p->k0[j]));
}

/* The edge with itself: stretching, bending of both joints, and what tension and shear force do to it. */
static void own_stiffness(const ZpRodParams *p, const ZpRodEval *e, double T, size_t j, double D[4]) {
  size_t s = p->ribbons;
  double ux = e->ux[j], uy = e->uy[j], nx = -uy, ny = ux, over = e->inverse[j], S = p->S[j];
  double turn = (joint_stiffness(p, e, j) + joint_stiffness(p, e, j + s)) * over * over + T * over;
  double twist = (e->M[j] - e->M[j + s]) * over * over;
  D[0] = S * ux * ux + turn * nx * nx - 2 * twist * ux * nx;
  D[1] = D[2] = S * ux * uy + turn * nx * ny - twist * (ux * ny + nx * uy);
  D[3] = S * uy * uy + turn * ny * ny - 2 * twist * uy * ny;
}

/* The edge j with the edge k on the other side of joint `joint`. */
static void coupling(const ZpRodParams *p, const ZpRodEval *e, size_t joint, ptrdiff_t j, ptrdiff_t k, double D[4]) {
  double c = -joint_stiffness(p, e, joint) * e->inverse[j] * e->inverse[k];
  double jx = -e->uy[j], jy = e->ux[j], kx = -e->uy[k], ky = e->ux[k];
  D[0] = c * jx * kx;
  D[1] = c * jx * ky;
  D[2] = c * jy * kx;
  D[3] = c * jy * ky;
}

void zp_rod_stiffness(const ZpRodParams *p, const ZpRodEval *e, const double *tension, double (*D)[4]) {
  size_t edges = edge_count(p), s = p->ribbons;
  for (size_t j = 0; j < edges; j++) {
    ptrdiff_t here = (ptrdiff_t)j, step = (ptrdiff_t)s;
    coupling(p, e, j, here, here - step, D[3 * j]);
    own_stiffness(p, e, tension[j], j, D[3 * j + 1]);
    coupling(p, e, j + s, here, here + step, D[3 * j + 2]);
  }
}
