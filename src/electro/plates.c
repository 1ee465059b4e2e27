/* Plates law. Letters of docs/theory.md, section 4:
 *   g   gap between the insulator faces, m          h   g + d, liquid thickness of the same capacitance, m
 *   h_c h at which the liquid's field reaches its breakdown field, m
 *   W   attraction per length, N/m                  P   its potential per length, J/m
 *   K   k U^2, so that W = K / h^2 above h_c, N m
 * Below h_c the surface charge stays, and with it W: W = K / h_c^2, P = -K / h_c (2 - h / h_c). Both
 * branches are one formula with h* = max(h, h_c). Lateral edges add e / w to 1 / h, section 16; in the code `e` is
 * that e / w, m^-1.
 */
#include "electro/plates.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "electro/edges.h"
#include "math/gauss.h"

double zp_plates_least_h(const ZpPlatesParams *p, double U) {
  double h_c = p->h_per_volt * fabs(U);
  return h_c > p->h_least ? h_c : p->h_least;
}

/* The gap from which the edges' law goes on straight to where there is a cap below h_c, or beyond its ends. */
static inline double edge_gap(const ZpPlatesParams *p, double h_c, double gap) {
  double least = h_c - p->d > 0 ? h_c - p->d : 0, bounded = gap > least ? gap : least;
  return bounded < p->edges->largest ? bounded : p->edges->largest;
}

/* Eqs. (16.3) to (16.5). Where the cap acts its gap goes with the voltage, and the charge with that. */
static void add_edges_to_law(const ZpPlatesParams *p, double U, double gap, ZpPlatesLaw *law) {
  double K = p->k * U * U, cap = p->h_per_volt * fabs(U) - p->d, at = edge_gap(p, zp_plates_least_h(p, U), gap);
  ZpEdgeValue v = zp_edges_value(p->edges, at);
  law->W -= K * v.slope;
  law->P -= K * (v.e + v.slope * (gap - at));
  law->q += 2 * p->k * U * (v.e + v.slope * (gap - at));
  if (cap > 0 && gap < cap && cap < p->edges->largest) law->q += p->k * U * (cap + p->d) * v.bend * (gap - cap);
}

ZpPlatesLaw zp_plates_law(const ZpPlatesParams *p, double U, double gap) {
  double h = gap + p->d, h_c = zp_plates_least_h(p, U), K = p->k * U * U;
  double inverse = 1 / (h > h_c ? h : h_c);
  ZpPlatesLaw law = {.W = K * inverse * inverse, .P = -K * inverse * (2 - h * inverse), .q = 2 * p->k * U * inverse};
  if (p->edges) add_edges_to_law(p, U, gap, &law);
  return law;
}

void zp_plates_carve(const ZpPlatesParams *p, ZpPlatesEval *e, ZpCarver *carver) {
  e->Fx = zp_carve(carver, p->stride);
  e->Fy = zp_carve(carver, p->stride);
  double **arrays[] = {&e->gap, &e->A, &e->B, &e->P, &e->dx};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_carve(carver, p->nodes);
}

ZP_KERNEL static void gaps(size_t nodes, const double *restrict x, const double *restrict y, double *restrict gap,
                           double *restrict dx) {
  ZP_SIMD
  for (size_t i = 0; i < nodes; i++)
    gap[i] = y[2 * i] - y[2 * i + 1];
  size_t elements = nodes - 1;
  ZP_SIMD
  for (size_t i = 0; i < elements; i++)
    dx[i] = 0.5 * ((x[2 * i + 2] - x[2 * i]) + (x[2 * i + 3] - x[2 * i + 1]));
}

static void gaps_below_flat(const ZpPlatesParams *p, const double *x, const double *y, ZpPlatesEval *e) {
  for (size_t i = 0; i < p->nodes; i++)
    e->gap[i] = p->flat_height - y[i];
  for (size_t i = 0; i + 1 < p->nodes; i++)
    e->dx[i] = x[i + 1] - x[i];
}

void zp_plates_gaps(const ZpPlatesParams *p, const double *x, const double *y, ZpPlatesEval *e) {
  if (p->flat)
    gaps_below_flat(p, x, y, e);
  else
    gaps(p->nodes, x, y, e->gap, e->dx);
}

double zp_plates_least_gap(const ZpPlatesParams *p, const double *y) {
  double least = INFINITY;
  for (size_t i = 0; i < p->nodes; i++)
    least = fmin(least, p->flat ? p->flat_height - y[i] : y[2 * i] - y[2 * i + 1]);
  return least;
}

/* Law at the Gauss points of each element, weighted to its two ends. Error of the force on the paper's wedges up to
 * 4 mm, measured (test_electro): 3e-6, 1e-8, 3e-9 at N = 21, 61, 130 without cap; its kink makes it 2e-3, 6e-5, 3e-5.
 */
ZP_KERNEL static void elements(const ZpPlatesParams *p, double K, double h_c, ZpPlatesEval *e) {
  size_t elements = p->nodes - 1;
  double d = p->d;
  const double *restrict gap = e->gap, *restrict dx = e->dx;
  double *restrict A = e->A, *restrict B = e->B, *restrict P = e->P;
  ZP_SIMD
  for (size_t i = 0; i < elements; i++) {
    double h[GAUSS], bounded[GAUSS], left = 0, right = 0, potential = 0;
    for (int q = 0; q < GAUSS; q++) {
      h[q] = gap[i] + d + (gap[i + 1] - gap[i]) * gauss_at[q];
      bounded[q] = h[q] > h_c ? h[q] : h_c;
    }
    /* the three reciprocals from one division, which is what costs here */
    double h01 = bounded[0] * bounded[1], all = 1 / (h01 * bounded[2]);
    double inverse[GAUSS] = {all * (bounded[1] * bounded[2]), all * (bounded[0] * bounded[2]), all * h01};
    for (int q = 0; q < GAUSS; q++) {
      double W = gauss_weight[q] * K * inverse[q] * inverse[q];
      left += W * (1 - gauss_at[q]);
      right += W * gauss_at[q];
      potential -= gauss_weight[q] * K * inverse[q] * (2 - h[q] * inverse[q]);
    }
    A[i] = left * dx[i];
    B[i] = right * dx[i];
    P[i] = potential;
  }
}

/* e and e' at some gaps within the ends of the law. */
static inline void edge_lanes(const ZpEdgeLaw *law, const double *restrict at, double *restrict e,
                              double *restrict e1) {
  ZP_SIMD
  for (int l = 0; l < ZP_LANES; l++) {
    double s = sqrt(at[l] + law->d), sum = s + law->s0, inverse = 1 / (s * sum);
    double z = law->stretch * (s - law->s0) * s * inverse, z1 = law->stretch * law->s0 * s * inverse * inverse;
    double p = law->p[ZP_EDGE_TERMS - 1], p1 = 0;
    for (int k = ZP_EDGE_TERMS - 1; k-- > 0;) {
      p1 = p1 * z + p;
      p = p * z + law->p[k];
    }
    e[l] = p;
    e1[l] = p1 * z1;
  }
}

/* What the edges add to each element: a pass of its own, so that without them nothing is slower. */
ZP_KERNEL static void add_edges(const ZpPlatesParams *p, double K, double h_c, ZpPlatesEval *out) {
  size_t elements = p->nodes - 1;
  double least = h_c - p->d > 0 ? h_c - p->d : 0, most = p->edges->largest;
  for (size_t block = 0; block < elements; block += ZP_LANES) {
    size_t count = elements - block < ZP_LANES ? elements - block : ZP_LANES;
    double from[ZP_LANES] = {0}, rise[ZP_LANES] = {0}, left[ZP_LANES] = {0}, right[ZP_LANES] = {0},
           potential[ZP_LANES] = {0}, g[ZP_LANES], at[ZP_LANES], e[ZP_LANES], e1[ZP_LANES];
    for (size_t l = 0; l < count; l++) {
      from[l] = out->gap[block + l];
      rise[l] = out->gap[block + l + 1] - from[l];
    }
    for (int q = 0; q < GAUSS; q++) {
      ZP_SIMD
      for (int l = 0; l < ZP_LANES; l++) {
        g[l] = from[l] + rise[l] * gauss_at[q];
        double bounded = g[l] > least ? g[l] : least;
        at[l] = bounded < most ? bounded : most;
      }
      edge_lanes(p->edges, at, e, e1);
      ZP_SIMD
      for (int l = 0; l < ZP_LANES; l++) {
        double W = -gauss_weight[q] * K * e1[l];
        left[l] += W * (1 - gauss_at[q]);
        right[l] += W * gauss_at[q];
        potential[l] += W * (g[l] - at[l]) - gauss_weight[q] * K * e[l];
      }
    }
    for (size_t l = 0; l < count; l++) {
      out->A[block + l] += left[l] * out->dx[block + l];
      out->B[block + l] += right[l] * out->dx[block + l];
      out->P[block + l] += potential[l];
    }
  }
}

/* Attraction `closing` and pull along x on both nodes of station i. */
static inline void act(ZpPlatesEval *e, size_t i, double along, double closing) {
  e->Fx[2 * i] = e->Fx[2 * i + 1] = along;
  e->Fy[2 * i] = -closing;
  e->Fy[2 * i + 1] = closing;
}

/* Element parts gathered at the stations, eq. (4.7): dE/dg, and -dE/dx of each ribbon. */
ZP_KERNEL static void stations(size_t nodes, const double *restrict A, const double *restrict B,
                               const double *restrict P, double *restrict Fx, double *restrict Fy) {
  size_t last = nodes - 1;
  ZP_SIMD
  for (size_t i = 1; i < last; i++) {
    double closing = A[i] + B[i - 1], along = 0.5 * (P[i] - P[i - 1]);
    Fx[2 * i] = along;
    Fx[2 * i + 1] = along;
    Fy[2 * i] = -closing;
    Fy[2 * i + 1] = closing;
  }
}

/* The same on the one ribbon below a flat electrode, which takes all of the pull along x. */
static void stations_below_flat(const ZpPlatesParams *p, ZpPlatesEval *e) {
  size_t last = p->nodes - 1;
  for (size_t i = 0; i <= last; i++) {
    e->Fy[i] = (i < last ? e->A[i] : 0) + (i > 0 ? e->B[i - 1] : 0);
    e->Fx[i] = (i < last ? e->P[i] : 0) - (i > 0 ? e->P[i - 1] : 0);
  }
}

void zp_plates_polyline(const ZpPlatesParams *p, const double *x, const double *y, double U, ZpPlatesEval *e) {
  size_t last = p->nodes - 1;
  zp_plates_gaps(p, x, y, e);
  elements(p, p->k * U * U, zp_plates_least_h(p, U), e);
  if (p->edges) add_edges(p, p->k * U * U, zp_plates_least_h(p, U), e);
  if (p->flat) {
    stations_below_flat(p, e);
    return;
  }
  stations(p->nodes, e->A, e->B, e->P, e->Fx, e->Fy);
  act(e, 0, 0.5 * e->P[0], e->A[0]);
  act(e, last, -0.5 * e->P[last - 1], e->B[last - 1] + p->flat_length * zp_plates_law(p, U, e->gap[last]).W);
}

/* dW/dg: the force of a capped piece does not change with its gap. */
static double slope(const ZpPlatesParams *p, double K, double h_c, double gap) {
  double h = gap + p->d, sum = h > h_c ? -2 * K / (h * h * h) : 0;
  if (p->edges && edge_gap(p, h_c, gap) == gap) sum -= K * zp_edges_value(p->edges, gap).bend;
  return sum;
}

void zp_plates_stiffness(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, double *own, double *next,
                         double *along0, double *along1) {
  double K = p->k * U * U, h_c = zp_plates_least_h(p, U);
  size_t last = p->nodes - 1;
  memset(own, 0, p->nodes * sizeof *own);
  for (size_t i = 0; i < last; i++) {
    next[i] = 0;
    for (int q = 0; q < GAUSS; q++) {
      double gap = e->gap[i] + (e->gap[i + 1] - e->gap[i]) * gauss_at[q], right = gauss_at[q], left = 1 - right;
      double c = gauss_weight[q] * e->dx[i] * slope(p, K, h_c, gap);
      own[i] += c * left * left;
      own[i + 1] += c * right * right;
      next[i] += c * left * right;
    }
    along0[i] = e->A[i] / e->dx[i];
    along1[i] = e->B[i] / e->dx[i];
  }
  own[last] += p->flat_length * slope(p, K, h_c, e->gap[last]);
}

double zp_plates_inverse_gap(const ZpPlatesParams *p, double gap) {
  double h = gap + p->d, inverse = 1 / (h > p->h_least ? h : p->h_least);
  if (!p->edges) return inverse;
  double at = edge_gap(p, p->h_least, gap);
  ZpEdgeValue v = zp_edges_value(p->edges, at);
  return inverse + v.e + v.slope * (gap - at);
}

static void add_piece(const ZpPlatesParams *p, double U, double gap, double length, ZpPlatesTotals *totals) {
  ZpPlatesLaw law = zp_plates_law(p, U, gap);
  totals->force += law.W * length;
  totals->potential += law.P * length;
  totals->charge += law.q * length;
  totals->inverse_gap += length * zp_plates_inverse_gap(p, gap);
}

/* What add_piece adds, without edges, at the Gauss points of some elements. */
typedef struct Pieces {
  double W[GAUSS][ZP_LANES], P[GAUSS][ZP_LANES], q[GAUSS][ZP_LANES], inverse[GAUSS][ZP_LANES];
} Pieces;

ZP_INLINE void pieces_of(const ZpPlatesParams *p, double U, double h_c, const double *restrict gap, size_t count,
                         Pieces *restrict out) {
  double K = p->k * U * U, per_volt = 2 * p->k * U, d = p->d, least = p->h_least;
  for (int q = 0; q < GAUSS; q++) {
    ZP_SIMD
    for (size_t l = 0; l < count; l++) {
      double h = gap[l] + (gap[l + 1] - gap[l]) * gauss_at[q] + d;
      double inverse = 1 / (h > h_c ? h : h_c);
      out->W[q][l] = K * inverse * inverse;
      out->P[q][l] = -K * inverse * (2 - h * inverse);
      out->q[q][l] = per_volt * inverse;
      out->inverse[q][l] = 1 / (h > least ? h : least);
    }
  }
}

/* Summed in the order of the pieces, so that no vector width changes the result. */
ZP_KERNEL static void add_elements(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, double h_c,
                                   ZpPlatesTotals *totals) {
  size_t elements = p->nodes - 1;
  Pieces pieces;
  for (size_t block = 0; block < elements; block += ZP_LANES) {
    size_t count = elements - block < ZP_LANES ? elements - block : ZP_LANES;
    pieces_of(p, U, h_c, e->gap + block, count, &pieces);
    for (size_t l = 0; l < count; l++)
      for (int q = 0; q < GAUSS; q++) {
        double length = gauss_weight[q] * e->dx[block + l];
        totals->force += pieces.W[q][l] * length;
        totals->potential += pieces.P[q][l] * length;
        totals->charge += pieces.q[q][l] * length;
        totals->inverse_gap += length * pieces.inverse[q][l];
      }
  }
}

static void add_elements_with_edges(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, ZpPlatesTotals *totals) {
  for (size_t i = 0; i + 1 < p->nodes; i++)
    for (int q = 0; q < GAUSS; q++)
      add_piece(p, U, e->gap[i] + (e->gap[i + 1] - e->gap[i]) * gauss_at[q], gauss_weight[q] * e->dx[i], totals);
}

ZpPlatesTotals zp_plates_totals(const ZpPlatesParams *p, const ZpPlatesEval *e, double U) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  if (p->edges)
    add_elements_with_edges(p, e, U, &totals);
  else
    add_elements(p, e, U, zp_plates_least_h(p, U), &totals);
  if (p->flat_length > 0) add_piece(p, U, e->gap[p->nodes - 1], p->flat_length, &totals);
  return totals;
}
