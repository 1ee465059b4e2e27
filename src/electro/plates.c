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

/* The gap at which the edges' law is evaluated. From there it continues as a straight line: into the range of the cap,
 * and beyond the ends of the fit. */
static inline double edge_gap(const ZpPlatesParams *p, double h_c, double gap) {
  double start = p->edges->least, least = h_c - p->d > start ? h_c - p->d : start, bounded = gap > least ? gap : least;
  return bounded < p->edges->largest ? bounded : p->edges->largest;
}

/* Eqs. (16.3) to (16.5). Where the cap acts, its gap depends on the voltage, and so the charge does, too. */
static void add_edges_to_law(const ZpPlatesParams *p, double U, double gap, ZpPlatesLaw *law) {
  double K = p->k * U * U, cap = p->h_per_volt * fabs(U) - p->d, at = edge_gap(p, zp_plates_least_h(p, U), gap);
  ZpEdgeValue v = zp_edges_value(p->edges, at);
  law->W -= K * v.slope;
  law->P -= K * (v.e + v.slope * (gap - at));
  law->q += 2 * p->k * U * (v.e + v.slope * (gap - at));
  if (cap > p->edges->least && gap < cap && cap < p->edges->largest)
    law->q += p->k * U * (cap + p->d) * v.bend * (gap - cap);
}

ZpPlatesLaw zp_plates_law(const ZpPlatesParams *p, double U, double gap) {
  double h = gap + p->d, h_c = zp_plates_least_h(p, U), K = p->k * U * U;
  double inverse = 1 / (h > h_c ? h : h_c);
  ZpPlatesLaw law = {.W = K * inverse * inverse, .P = -K * inverse * (2 - h * inverse), .q = 2 * p->k * U * inverse};
  if (p->edges) add_edges_to_law(p, U, gap, &law);
  return law;
}

double zp_plates_slope(const ZpPlatesParams *p, double U, double gap) {
  double h = gap + p->d, h_c = zp_plates_least_h(p, U), K = p->k * U * U, slope = h > h_c ? -2 * K / (h * h * h) : 0;
  if (p->edges && edge_gap(p, h_c, gap) == gap) slope -= K * zp_edges_value(p->edges, gap).bend;
  return slope;
}

void zp_plates_reserve(const ZpPlatesParams *p, ZpPlatesEval *e, ZpArena *arena) {
  e->gap = zp_arena_take(arena, p->nodes);
  e->dx = zp_arena_take(arena, p->nodes);
}

ZP_KERNEL static void gaps(size_t nodes, const double *restrict x, const double *restrict y, double *restrict gap,
                           double *restrict dx) {
  ZP_SIMD
  for (size_t i = 0; i < nodes; i++)
    gap[i] = zp_apart(y, i);
  size_t elements = nodes - 1;
  ZP_SIMD
  for (size_t i = 0; i < elements; i++)
    dx[i] = 0.5 * ((x[zp_up(i + 1)] - x[zp_up(i)]) + (x[zp_down(i + 1)] - x[zp_down(i)]));
}

static void gaps_below_flat(const ZpPlatesParams *p, const double *x, const double *y, ZpPlatesEval *e) {
  for (size_t i = 0; i < p->nodes; i++)
    e->gap[i] = p->face[i] - y[i];
  for (size_t i = 0; i + 1 < p->nodes; i++)
    e->dx[i] = x[i + 1] - x[i];
}

void zp_plates_gaps(const ZpPlatesParams *p, const double *x, const double *y, ZpPlatesEval *e) {
  if (p->flat)
    gaps_below_flat(p, x, y, e);
  else
    gaps(p->nodes, x, y, e->gap, e->dx);
  for (size_t i = p->platform; i < p->platform_end; i++)
    e->dx[i] = 0;
}

double zp_plates_least_gap(const ZpPlatesParams *p, const double *y) {
  double least = INFINITY;
  for (size_t i = 0; i < p->nodes; i++)
    least = fmin(least, zp_plates_gap(p, y, i));
  return least;
}

int zp_plates_pieces(const ZpPlatesParams *p, double wet, size_t i, ZpPlatesPiece piece[2]) {
  bool right = i >= p->platform_end; /* wet from its right end on */
  int count = 0;
  if (wet > 0) piece[count++] = (ZpPlatesPiece){p, right ? 1 - wet : 0, right ? 1 : wet};
  if (wet < 1) piece[count++] = (ZpPlatesPiece){p->air, right ? 0 : wet, right ? 1 - wet : 1};
  return count;
}

double zp_plates_share(const ZpPlatesParams *p, const ZpPlatesPiece *piece, size_t i, int q) {
  if (piece->from == 0 && piece->to == 1) return zp_gauss_shares(&p->level, i)[q];
  return zp_gauss_share(&p->level, i, piece->from + (piece->to - piece->from) * gauss_at[q]);
}

double zp_plates_flat(const ZpPlatesParams *p, const ZpCover *cover, size_t i) {
  return cover ? cover->flat[i > p->platform] : 1;
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

/* Sums of add_piece, without edges, at the Gauss points of some elements. */
typedef struct Pieces {
  double W[GAUSS][ZP_LANES], P[GAUSS][ZP_LANES], q[GAUSS][ZP_LANES], inverse[GAUSS][ZP_LANES];
} Pieces;

/* `at`: shares of the right station. */
ZP_INLINE void pieces_of(const ZpPlatesParams *p, double U, double h_c, const double *restrict gap, size_t count,
                         const double *at, Pieces *restrict out) {
  double K = p->k * U * U, per_volt = 2 * p->k * U, d = p->d, least = p->h_least;
  for (int q = 0; q < GAUSS; q++) {
    ZP_SIMD
    for (size_t l = 0; l < count; l++) {
      double h = gap[l] + (gap[l + 1] - gap[l]) * at[q] + d;
      double inverse = 1 / (h > h_c ? h : h_c);
      out->W[q][l] = K * inverse * inverse;
      out->P[q][l] = -K * inverse * (2 - h * inverse);
      out->q[q][l] = per_volt * inverse;
      out->inverse[q][l] = 1 / (h > least ? h : least);
    }
  }
}

/* Pieces of elements with a level end among `count` from `block` on. */
ZP_INLINE void level_pieces(const ZpPlatesParams *p, double U, double h_c, const double *gap, size_t block,
                            size_t count, Pieces *out) {
  for (size_t k = 0; k < p->level.count; k++) {
    size_t element = p->level.of[k].element, l = element - block;
    if (element < block || l >= count) continue;
    Pieces one;
    pieces_of(p, U, h_c, gap + element, 1, zp_gauss_shares(&p->level, element), &one);
    for (int q = 0; q < GAUSS; q++) {
      out->W[q][l] = one.W[q][0];
      out->P[q][l] = one.P[q][0];
      out->q[q][l] = one.q[q][0];
      out->inverse[q][l] = one.inverse[q][0];
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
    pieces_of(p, U, h_c, e->gap + block, count, gauss_at, &pieces);
    level_pieces(p, U, h_c, e->gap, block, count, &pieces);
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
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const double *at = zp_gauss_shares(&p->level, i);
    for (int q = 0; q < GAUSS; q++)
      add_piece(p, U, e->gap[i] + (e->gap[i + 1] - e->gap[i]) * at[q], gauss_weight[q] * e->dx[i], totals);
  }
}

/* Capacitance relative to that of the liquid. */
static void add_part(const ZpPlatesParams *law, double U, double gap, double length, ZpPlatesTotals *totals) {
  ZpPlatesTotals part = {0, 0, 0, 0};
  add_piece(law, U, gap, length, &part);
  totals->force += part.force;
  totals->potential += part.potential;
  totals->charge += part.charge;
  totals->inverse_gap += law->relative * part.inverse_gap;
}

static void add_covered(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, size_t first, size_t end,
                        ZpPlatesTotals *totals) {
  for (size_t i = first; i < end; i++) {
    ZpPlatesPiece piece[2];
    int pieces = zp_plates_pieces(p, zp_cover_part(e->cover, i), i, piece);
    for (int k = 0; k < pieces; k++)
      for (int q = 0; q < GAUSS; q++) {
        double gap = e->gap[i] + (e->gap[i + 1] - e->gap[i]) * zp_plates_share(p, &piece[k], i, q);
        double length = gauss_weight[q] * (piece[k].to - piece[k].from) * e->dx[i];
        add_part(piece[k].law, U, gap, length, totals);
      }
  }
}

static void add_platform(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, ZpPlatesTotals *totals) {
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++) {
    double wet = zp_plates_flat(p, e->cover, i);
    add_piece(p, U, e->gap[i], wet * p->flat_length, totals);
    if (wet < 1) add_part(p->air, U, e->gap[i], (1 - wet) * p->flat_length, totals);
  }
}

ZpPlatesTotals zp_plates_totals(const ZpPlatesParams *p, const ZpPlatesEval *e, double U) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  if (e->cover)
    add_covered(p, e, U, 0, p->nodes - 1, &totals);
  else if (p->edges)
    add_elements_with_edges(p, e, U, &totals);
  else
    add_elements(p, e, U, zp_plates_least_h(p, U), &totals);
  add_platform(p, e, U, &totals);
  return totals;
}

ZpPlatesTotals zp_plates_totals_among(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, size_t first,
                                      size_t end) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  add_covered(p, e, U, first, end, &totals);
  add_platform(p, e, U, &totals);
  return totals;
}
