/* Mass-spring ribbon. Letters of docs/theory.md, section 3 (equations of the paper in brackets):
 *   dp     node i+1 - node i, m [1]                 u   unit vector along dp
 *   T      tension of the axial spring, N [3]       n   u turned left by 90 degrees
 *   dy_b   shear displacement of node i+1 in the frame of the edge before, m [4]
 *   dy_a   the same of node i, sign turned, in the frame of the edge after, m [4]
 *   R      force of the edge on its right node, N; its left node gets -R
 */
#include "paper/massspring.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"

static size_t edge_count(const ZpMassSpringParams *p) {
  return p->ribbons * (p->nodes - 1);
}

void zp_massspring_reserve(const ZpMassSpringParams *p, ZpMassSpringEval *e, ZpArena *arena) {
  size_t margin = ZP_ALIGNMENT / sizeof(double);
  e->dpx = zp_arena_take(arena, p->lanes);
  e->dpy = zp_arena_take(arena, p->lanes);
  e->T = zp_arena_take(arena, p->lanes);
  double **with_margin[] = {&e->ux, &e->uy, &e->Rx, &e->Ry};
  for (int k = 0; k < 4; k++) {
    double *array = zp_arena_take(arena, margin + p->lanes);
    *with_margin[k] = array ? array + margin : NULL;
  }
  if (!arena->base) return;
  for (size_t r = 0; r < p->ribbons; r++) /* the directions before the first edges, which stay constant */
    (e->ux - p->ribbons)[r] = p->left_slope ? 1 : 0;
}

/* Kernels process a whole number of lanes, beyond the last edge, where nodes lie on the extended ribbon. Two lengths
 * are inverted with one division, which is the expensive operation here. */
ZP_KERNEL static void edge_directions(const ZpMassSpringParams *p, size_t padded, const double *restrict x,
                                      const double *restrict y, const ZpMassSpringEval *e) {
  enum { HALF = ZP_LANES / 2 };
  size_t s = p->ribbons;
  double l = p->l, K_D = p->K_D;
  double *restrict dpx = e->dpx, *restrict dpy = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy, *restrict T = e->T;
  for (size_t block = 0; block < padded; block += ZP_LANES) {
    double dx[ZP_LANES], dy[ZP_LANES], length[ZP_LANES], inverse[ZP_LANES];
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++) {
      dx[k] = x[block + k + s] - x[block + k];
      dy[k] = y[block + k + s] - y[block + k];
      length[k] = sqrt(dx[k] * dx[k] + dy[k] * dy[k]);
    }
    ZP_SIMD
    for (size_t k = 0; k < HALF; k++) {
      double both = 1 / (length[k] * length[k + HALF]);
      inverse[k] = both * length[k + HALF];
      inverse[k + HALF] = both * length[k];
    }
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++) {
      dpx[block + k] = dx[k];
      dpy[block + k] = dy[k];
      ux[block + k] = dx[k] * inverse[k];
      uy[block + k] = dy[k] * inverse[k];
      T[block + k] = K_D * (length[k] - l);
    }
  }
}

ZP_KERNEL static void edge_forces(const ZpMassSpringParams *p, size_t padded, const ZpMassSpringEval *e) {
  size_t s = p->ribbons;
  double K_S = p->K_S;
  const double *restrict dpx = e->dpx, *restrict dpy = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy,
                         *restrict T = e->T;
  const double *restrict bx = ux - s, *restrict by = uy - s, *restrict ax = ux + s, *restrict ay = uy + s;
  double *restrict Rx = e->Rx, *restrict Ry = e->Ry;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double dy_b = bx[j] * dpy[j] - by[j] * dpx[j];
    double dy_a = ax[j] * dpy[j] - ay[j] * dpx[j];
    Rx[j] = K_S * (dy_b * by[j] + dy_a * ay[j]) - T[j] * ux[j];
    Ry[j] = -K_S * (dy_b * bx[j] + dy_a * ax[j]) - T[j] * uy[j];
  }
}

/* Restore the directions after the last edges, which the kernel has overwritten. */
static void hold_right_ends(const ZpMassSpringParams *p, const ZpMassSpringEval *e) {
  size_t edges = edge_count(p);
  for (size_t r = 0; r < p->ribbons; r++) {
    e->ux[edges + r] = p->right_slope ? 1 : 0;
    e->uy[edges + r] = 0;
  }
}

void zp_massspring_eval(const ZpMassSpringParams *p, const double *x, const double *y, ZpMassSpringEval *e) {
  size_t edges = edge_count(p), padded = zp_round_up(edges);
  edge_directions(p, padded, x, y, e);
  hold_right_ends(p, e);
  edge_forces(p, padded, e);
  for (size_t j = edges; j < padded; j++)
    e->Rx[j] = e->Ry[j] = 0;
}

/* -dR/d(edge k) from the frame that edge k defines for edge j: it turns by n_k . d(edge k) / length. */
static void frame_stiffness(const ZpMassSpringEval *e, double K_S, size_t j, ptrdiff_t k, double D[4]) {
  double ux = e->ux[k], uy = e->uy[k], nx = -uy, ny = ux, x = e->dpx[j], y = e->dpy[j];
  double ahead = ux * x + uy * y, off = nx * x + ny * y;
  double over = K_S / sqrt(e->dpx[k] * e->dpx[k] + e->dpy[k] * e->dpy[k]);
  double rx = -over * (ahead * nx + off * ux), ry = -over * (ahead * ny + off * uy);
  D[0] = rx * nx;
  D[1] = rx * ny;
  D[2] = ry * nx;
  D[3] = ry * ny;
}

static void own_stiffness(const ZpMassSpringParams *p, const ZpMassSpringEval *e, double T, size_t j, double D[4]) {
  ptrdiff_t here = (ptrdiff_t)j, s = (ptrdiff_t)p->ribbons;
  double ux = e->ux[j], uy = e->uy[j], length = e->dpx[j] * ux + e->dpy[j] * uy, turn = T / length;
  D[0] = p->K_D * ux * ux + turn * uy * uy;
  D[1] = D[2] = (p->K_D - turn) * ux * uy;
  D[3] = p->K_D * uy * uy + turn * ux * ux;
  for (ptrdiff_t k = here - s; k <= here + s; k += 2 * s) {
    double nx = -e->uy[k], ny = e->ux[k];
    D[0] += p->K_S * nx * nx;
    D[1] += p->K_S * nx * ny;
    D[2] += p->K_S * nx * ny;
    D[3] += p->K_S * ny * ny;
  }
}

void zp_massspring_stiffness(const ZpMassSpringParams *p, const ZpMassSpringEval *e, const double *tension,
                             double (*D)[4]) {
  size_t edges = edge_count(p), s = p->ribbons;
  memset(D, 0, 3 * edges * sizeof *D);
  for (size_t j = 0; j < edges; j++) {
    if (j >= s) frame_stiffness(e, p->K_S, j, (ptrdiff_t)(j - s), D[3 * j]);
    own_stiffness(p, e, tension[j], j, D[3 * j + 1]);
    if (j + s < edges) frame_stiffness(e, p->K_S, j, (ptrdiff_t)(j + s), D[3 * j + 2]);
  }
}

double zp_massspring_axial_energy(const ZpMassSpringParams *p, const ZpMassSpringEval *e) {
  double sum = 0;
  for (size_t j = 0; j < edge_count(p); j++)
    sum += e->T[j] * e->T[j];
  return sum / (2 * p->K_D);
}

double zp_massspring_shear_energy(const ZpMassSpringParams *p, const ZpMassSpringEval *e) {
  size_t edges = edge_count(p), s = p->ribbons;
  const double *bx = e->ux - s, *by = e->uy - s, *ax = e->ux + s, *ay = e->uy + s;
  double sum = 0;
  for (size_t j = 0; j < edges; j++) {
    double dy_b = bx[j] * e->dpy[j] - by[j] * e->dpx[j];
    double dy_a = ax[j] * e->dpy[j] - ay[j] * e->dpx[j];
    /* an inner joint appears in the frames of both its edges, an end joint in one */
    sum += (j < s ? 1 : 0.5) * dy_b * dy_b + (j + s >= edges ? 1 : 0.5) * dy_a * dy_a;
  }
  return p->K_S * sum / 2;
}

double zp_massspring_shear_coefficient(double EI, double l, int nodes) {
  double N = nodes;
  return EI / (l * l * l) * N * (N + 1) / ((N - 1) * (N - 1));
}

double zp_massspring_frequency_bound(const ZpMassSpringParams *p, double mass) {
  return sqrt((4 * p->K_D + 16 * p->K_S) / mass);
}
