/* Discrete elastic rod. Letters of docs/theory.md, section 8:
 *   u   unit vector of an edge, T its tension, N         phi   angle between the edges at a joint
 *   k   (4 tan(phi / 2) + sin(phi)) / 3, the discrete curvature
 */
#include "ribbon/rod.h"

#include <math.h>

#include "base/kernel.h"
#include "ribbon/rod_curl.h"

static size_t edge_count(const ZpRodParams *p) {
  return p->ribbons * (p->nodes - 1);
}

void zp_rod_reserve(const ZpRodParams *p, ZpRodEval *e, ZpArena *arena) {
  size_t margin = ZP_ALIGNMENT / sizeof(double);
  double **plain[] = {&e->dpx, &e->dpy, &e->T, &e->half, &e->k};
  for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++)
    *plain[i] = zp_arena_take(arena, p->lanes);
  double **with_margin[] = {&e->ux, &e->uy, &e->inverse};
  for (size_t i = 0; i < sizeof with_margin / sizeof with_margin[0]; i++) {
    double *array = zp_arena_take(arena, margin + p->lanes);
    *with_margin[i] = array ? array + margin : NULL;
  }
  if (!arena->base) return;
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

ZP_KERNEL static void joint_curvatures(size_t s, size_t padded, const ZpRodEval *e) {
  const double *restrict ux = e->ux, *restrict uy = e->uy, *restrict bx = ux - s, *restrict by = uy - s;
  double *restrict half = e->half, *restrict k = e->k;
  ZP_SIMD
  for (size_t j = 0; j < padded; j++) {
    double sine = bx[j] * uy[j] - by[j] * ux[j], cosine = bx[j] * ux[j] + by[j] * uy[j];
    half[j] = sine / (1 + cosine);
    k[j] = (4 * half[j] + sine) * (1.0 / 3);
  }
}

/* Restore places beyond the last edges, and rigid edges, where kernels over whole lanes have written. */
static void hold_slopes(const ZpRodParams *p, const ZpRodEval *e) {
  size_t edges = edge_count(p);
  for (size_t j = edges; j < edges + p->ribbons; j++) {
    e->ux[j] = 1;
    e->uy[j] = e->inverse[j] = 0;
  }
  for (size_t j = p->ribbons * p->rigid; j < p->ribbons * p->rigid_end; j++) {
    if (!zp_rod_is_rigid(p, j)) continue;
    e->dpx[j] = e->ux[j] = 1;
    e->dpy[j] = e->uy[j] = e->inverse[j] = e->T[j] = 0;
  }
}

void zp_rod_eval(const ZpRodParams *p, const double *x, const double *y, ZpRodEval *e) {
  size_t edges = edge_count(p);
  edge_directions(p, zp_round_up(edges), x, y, e);
  hold_slopes(p, e);
  joint_curvatures(p->ribbons, zp_round_up(edges + p->ribbons), e);
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
  for (const ZpRodEnd *end = p->end; end < p->end + p->ends; end++)
    sum += 2 * end->B * (e->k[end->held] - p->k0[end->held]) * (e->k[end->next] - p->k0[end->next]);
  return sum / 2 - zp_rod_curl_energy(p, e);
}
