/* Letters as in plates.c; 0 and 1 are the step's start and end. Over the step a piece of length dx has the force
 * (P1 - P0) / (g1 - g0) on its gap, times the mean dx, and the mean P on its length: together their work is P1 dx1 -
 * P0 dx0. */
#include "electro/plates_step.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "math/gauss.h"

void zp_plates_step_reserve(const ZpPlatesParams *p, ZpPlatesStep *s, ZpArena *arena) {
  s->Fx = zp_arena_take(arena, p->lanes);
  s->Fy = zp_arena_take(arena, p->lanes);
  double **arrays[] = {&s->own, &s->next, &s->along0, &s->along1, &s->A, &s->B, &s->P, &s->own_A, &s->own_B};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_arena_take(arena, p->nodes);
}

/* The laws whose mean a step takes: one if the voltages of both ends attract alike. */
typedef struct Laws {
  int count;
  double share; /* of each in the mean */
  double U[2];
  double K[2], h_c[2]; /* as in plates.c; K with that share */
} Laws;

static Laws laws_of(const ZpPlatesParams *p, double U0, double U1) {
  int count = fabs(U0) == fabs(U1) ? 1 : 2;
  Laws laws = {.count = count, .share = 1.0 / count, .U = {U0, U1}};
  for (int k = 0; k < count; k++) {
    laws.K[k] = laws.share * p->k * laws.U[k] * laws.U[k];
    laws.h_c[k] = zp_plates_least_h(p, laws.U[k]);
  }
  return laws;
}

/* The law between two gaps. */
typedef struct Between {
  double W;     /* (P1 - P0) / (g1 - g0) */
  double slope; /* its derivative by g1 */
  double P;     /* (P0 + P1) / 2 */
  double W1;    /* dP/dg at g1 */
} Between;

/* P = -K (2 / h* - h / h*^2). Where both ends are on one side of the cap the quotient has no difference in it:
 * K / (h0 h1) above, K / h_c^2 below. `still`: they are one point; a constant where this is inlined. */
ZP_INLINE Between between(double K, double h_c, double h0, double h1, bool still) {
  if (still) {
    double b = 1 / (h1 > h_c ? h1 : h_c), W = K * b * b;
    return (Between){W, h1 > h_c ? -W * b : 0, -K * b * (2 - h1 * b), W};
  }
  double c0 = h0 > h_c ? h0 : h_c, c1 = h1 > h_c ? h1 : h_c, b0 = 1 / c0, b1 = 1 / c1;
  double P0 = -K * b0 * (2 - h0 * b0), P1 = -K * b1 * (2 - h1 * b1), W1 = K * b1 * b1;
  bool open0 = h0 > h_c, open1 = h1 > h_c, across = open0 != open1;
  double over = 1 / (across ? h1 - h0 : 1), W = K * b0 * b1, slope = open1 ? -W * b1 : 0;
  W = across ? (P1 - P0) * over : W;
  slope = across ? (W1 - W) * over : slope;
  return (Between){W, slope, 0.5 * (P0 + P1), W1};
}

/* Is the difference of the potential at two gaps rounding? Then the mean force is exact to the square of theirs. */
static bool are_near(const ZpPlatesParams *p, double g0, double g1) {
  static const double near = 1e-8, part = 6e-5; /* m; of the distance of the metals in liquid */
  return fabs(g1 - g0) < fmin(near, part * fmax(g1 + p->d, p->h_least));
}

/* Force between two gaps by the law with lateral edges, for which there is no such quotient in closed form. */
static Between between_with_edges(const ZpPlatesParams *p, double U, double share, double g0, double g1) {
  ZpPlatesLaw law0 = zp_plates_law(p, U, g0), law1 = zp_plates_law(p, U, g1);
  law0.P *= share, law0.W *= share, law1.P *= share, law1.W *= share;
  Between law = {.P = 0.5 * (law0.P + law1.P), .W1 = law1.W, .W = 0.5 * (law0.W + law1.W)};
  if (are_near(p, g0, g1)) {
    law.slope = 0.5 * share * zp_plates_slope(p, U, g1);
    return law;
  }
  law.W = (law1.P - law0.P) / (g1 - g0);
  law.slope = (law1.W - law.W) / (g1 - g0);
  return law;
}

/* Their mean at one piece. */
static Between mean_between(const ZpPlatesParams *p, const Laws *laws, double g0, double g1) {
  Between mean = {0, 0, 0, 0};
  for (int k = 0; k < laws->count; k++) {
    Between law = p->edges ? between_with_edges(p, laws->U[k], laws->share, g0, g1)
                           : between(laws->K[k], laws->h_c[k], g0 + p->d, g1 + p->d, false);
    mean = (Between){mean.W + law.W, mean.slope + law.slope, mean.P + law.P, mean.W1 + law.W1};
  }
  return mean;
}

/* Parts of an element: sums over its Gauss points. */
typedef struct Parts {
  double A, B, P, own_A, own_B, next, along0, along1;
} Parts;

/* r: the share of the right station in what is sampled at a point of weight w. */
static inline void add_point(Parts *of, Between law, double dx, double r, double w) {
  double l = 1 - r;
  of->A += w * l * law.W * dx;
  of->B += w * r * law.W * dx;
  of->P += w * law.P;
  of->own_A += w * dx * l * l * law.slope;
  of->own_B += w * dx * r * r * law.slope;
  of->next += w * dx * l * r * law.slope;
  of->along0 += 0.5 * w * l * law.W1;
  of->along1 += 0.5 * w * r * law.W1;
}

static inline void put(const ZpPlatesStep *s, size_t i, Parts of) {
  s->A[i] = of.A;
  s->B[i] = of.B;
  s->P[i] = of.P;
  s->own_A[i] = of.own_A;
  s->own_B[i] = of.own_B;
  s->next[i] = of.next;
  s->along0[i] = of.along0;
  s->along1[i] = of.along1;
}

/* The sum of `laws` laws: a constant where this is inlined. */
ZP_INLINE void element_parts(size_t count, int laws, bool still, const Laws *law, double d, const ZpPlatesEval *e0,
                             const ZpPlatesEval *e1, const ZpPlatesStep *s) {
  const double *restrict g0 = e0->gap, *restrict g1 = e1->gap, *restrict dx0 = e0->dx, *restrict dx1 = e1->dx;
  ZpPlatesStep out = *s;
  Laws of = *law;
  ZP_SIMD
  for (size_t i = 0; i < count; i++) {
    double dx = 0.5 * (dx0[i] + dx1[i]);
    Parts parts = {0};
    for (int q = 0; q < GAUSS; q++) {
      double r = gauss_at[q], l = 1 - r, h0 = l * g0[i] + r * g0[i + 1] + d, h1 = l * g1[i] + r * g1[i + 1] + d;
      for (int k = 0; k < laws; k++)
        add_point(&parts, between(of.K[k], of.h_c[k], h0, h1, still), dx, r, gauss_weight[q]);
    }
    put(&out, i, parts);
  }
}

ZP_KERNEL static void elements_at_one(size_t count, const Laws *law, double d, const ZpPlatesEval *e0,
                                      const ZpPlatesEval *e1, const ZpPlatesStep *s) {
  element_parts(count, 1, false, law, d, e0, e1, s);
}

ZP_KERNEL static void elements_at_two(size_t count, const Laws *law, double d, const ZpPlatesEval *e0,
                                      const ZpPlatesEval *e1, const ZpPlatesStep *s) {
  element_parts(count, 2, false, law, d, e0, e1, s);
}

ZP_KERNEL static void elements_at_rest(size_t count, const Laws *law, double d, const ZpPlatesEval *e,
                                       const ZpPlatesStep *s) {
  element_parts(count, 1, true, law, d, e, e, s);
}

/* Any element, with edges or not. */
static void element(const ZpPlatesParams *p, const Laws *laws, const ZpPlatesEval *e0, const ZpPlatesEval *e1, size_t i,
                    const ZpPlatesStep *s) {
  const double *at = zp_gauss_shares(&p->level, i);
  double dx = 0.5 * (e0->dx[i] + e1->dx[i]);
  Parts parts = {0};
  for (int q = 0; q < GAUSS; q++) {
    double r = at[q], l = 1 - r;
    double g0 = l * e0->gap[i] + r * e0->gap[i + 1], g1 = l * e1->gap[i] + r * e1->gap[i + 1];
    add_point(&parts, mean_between(p, laws, g0, g1), dx, r, gauss_weight[q]);
  }
  put(s, i, parts);
}

/* Element i, one law where liquid is, another beyond. */
static Parts covered_element(const ZpPlatesParams *p, const Laws *wet, const Laws *dry, double covered,
                             const ZpPlatesEval *e0, const ZpPlatesEval *e1, size_t i) {
  double dx = 0.5 * (e0->dx[i] + e1->dx[i]);
  Parts parts = {0};
  ZpPlatesPiece piece[2];
  int pieces = zp_plates_pieces(p, covered, i, piece);
  for (int k = 0; k < pieces; k++)
    for (int q = 0; q < GAUSS; q++) {
      double r = zp_plates_share(p, &piece[k], i, q), l = 1 - r;
      double g0 = l * e0->gap[i] + r * e0->gap[i + 1], g1 = l * e1->gap[i] + r * e1->gap[i + 1];
      Between law = mean_between(piece[k].law, piece[k].law == p ? wet : dry, g0, g1);
      add_point(&parts, law, dx, r, gauss_weight[q] * (piece[k].to - piece[k].from));
    }
  return parts;
}

/* Number of elements from i on that are all wet, or all dry. 0: the liquid ends in element i. */
static size_t alike_from(const ZpPlatesParams *p, const ZpCover *cover, size_t i) {
  size_t end = i;
  double part = cover->part[i];
  while ((part == 0 || part == 1) && end + 1 < p->nodes && cover->part[end] == part)
    end++;
  return end - i;
}

static ZpPlatesEval eval_from(const ZpPlatesEval *e, size_t i) {
  ZpPlatesEval from = *e;
  from.gap += i;
  from.dx += i;
  return from;
}

static ZpPlatesStep step_from(const ZpPlatesStep *s, size_t i) {
  return (ZpPlatesStep){.own = s->own,
                        .next = s->next + i,
                        .along0 = s->along0 + i,
                        .along1 = s->along1 + i,
                        .A = s->A + i,
                        .B = s->B + i,
                        .P = s->P + i,
                        .own_A = s->own_A + i,
                        .own_B = s->own_B + i};
}

/* `count` elements from i on under one law that attracts alike at both ends. */
static void alike_elements(size_t i, size_t count, const Laws *law, double d, const ZpPlatesEval *e0,
                           const ZpPlatesEval *e1, const ZpPlatesStep *s) {
  ZpPlatesEval from0 = eval_from(e0, i), from1 = eval_from(e1, i);
  ZpPlatesStep to = step_from(s, i);
  if (e0 == e1)
    elements_at_rest(count, law, d, &from1, &to);
  else
    elements_at_one(count, law, d, &from0, &from1, &to);
}

static void covered_elements(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U0,
                             double U1, const ZpPlatesStep *s) {
  Laws wet = laws_of(p, U0, U1), dry = laws_of(p->air, U0, U1);
  for (size_t i = 0, count; i + 1 < p->nodes; i += count > 0 ? count : 1) {
    double part = e1->cover->part[i];
    count = wet.count == 1 && !p->edges ? alike_from(p, e1->cover, i) : 0;
    if (count > 0)
      alike_elements(i, count, part == 1 ? &wet : &dry, part == 1 ? p->d : p->air->d, e0, e1, s);
    else
      put(s, i, covered_element(p, &wet, &dry, part, e0, e1, i));
  }
  for (size_t k = 0; k < p->level.count; k++) {
    size_t i = p->level.of[k].element;
    put(s, i, covered_element(p, &wet, &dry, e1->cover->part[i], e0, e1, i));
  }
}

/* A central difference, near the ends of the element one that stays inside: the sums over points are smooth. */
ZpPlatesByCover zp_plates_by_cover(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, size_t i) {
  static const double little = 1e-5;
  Laws wet = laws_of(p, U, U), dry = laws_of(p->air, U, U);
  double at = e->cover->part[i], less = fmax(at - little, 0), more = fmin(at + little, 1), over = 1 / (more - less);
  Parts before = covered_element(p, &wet, &dry, less, e, e, i), after = covered_element(p, &wet, &dry, more, e, e, i);
  return (ZpPlatesByCover){(after.A - before.A) * over, (after.B - before.B) * over, (after.P - before.P) * over};
}

static void elements_with_edges(const ZpPlatesParams *p, const Laws *laws, const ZpPlatesEval *e0,
                                const ZpPlatesEval *e1, const ZpPlatesStep *s) {
  for (size_t i = 0; i + 1 < p->nodes; i++)
    element(p, laws, e0, e1, i, s);
}

/* Where the kernels over all elements have sampled straight pieces. */
static void level_elements(const ZpPlatesParams *p, const Laws *laws, const ZpPlatesEval *e0, const ZpPlatesEval *e1,
                           const ZpPlatesStep *s) {
  for (size_t k = 0; k < p->level.count; k++)
    element(p, laws, e0, e1, p->level.of[k].element, s);
}

/* Forces on both nodes of station i, or on the one below a rigid electrode. */
static void act(const ZpPlatesParams *p, ZpPlatesStep *s, size_t i, double along, double closing) {
  if (p->flat) {
    s->Fx[i] = 2 * along;
    s->Fy[i] = closing;
    return;
  }
  zp_set_pair(s->Fx, i, along, along);
  zp_set_pair(s->Fy, i, -closing, closing);
}

/* Between the ends of a platform there is no element: what the kernels over all elements have sampled there has no
 * length, and none to change. */
static void leave_out_platform(const ZpPlatesParams *p, double *of) {
  for (size_t i = p->platform; i < p->platform_end; i++)
    of[i] = 0;
}

static void act_all(const ZpPlatesParams *p, ZpPlatesStep *s) {
  leave_out_platform(p, s->P);
  size_t last = p->nodes - 1;
  act(p, s, 0, 0.5 * s->P[0], s->A[0]);
  for (size_t i = 1; i < last; i++)
    act(p, s, i, 0.5 * (s->P[i] - s->P[i - 1]), s->A[i] + s->B[i - 1]);
  act(p, s, last, -0.5 * s->P[last - 1], s->B[last - 1]);
}

static void stations(const ZpPlatesParams *p, ZpPlatesStep *s) {
  size_t last = p->nodes - 1;
  act_all(p, s);
  leave_out_platform(p, s->along0);
  leave_out_platform(p, s->along1);
  s->own[0] = s->own_A[0];
  for (size_t i = 1; i < last; i++)
    s->own[i] = s->own_A[i] + s->own_B[i - 1];
  s->own[last] = s->own_B[last - 1];
}

/* The platform's electrode at station i pulls the ribbons together. */
static void attract(double *Fy, size_t i, double W) {
  zp_part_pair(Fy, i, -W);
}

/* The platform's electrode, at both its ends where it has two. */
static void add_platform_of(const ZpPlatesParams *law, const Laws *laws, double length, size_t i,
                            const ZpPlatesEval *e0, const ZpPlatesEval *e1, ZpPlatesStep *s) {
  Between mean = mean_between(law, laws, e0->gap[i], e1->gap[i]);
  attract(s->Fy, i, length * mean.W);
  s->own[i] += length * mean.slope;
}

static void add_platform(const ZpPlatesParams *p, double U0, double U1, const ZpPlatesEval *e0, const ZpPlatesEval *e1,
                         ZpPlatesStep *s) {
  Laws wet = laws_of(p, U0, U1);
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++) {
    double part = zp_plates_flat(p, e1->cover, i);
    add_platform_of(p, &wet, part * p->flat_length, i, e0, e1, s);
    if (part == 1) continue;
    Laws dry = laws_of(p->air, U0, U1);
    add_platform_of(p->air, &dry, (1 - part) * p->flat_length, i, e0, e1, s);
  }
}

void zp_plates_step(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U0, double U1,
                    ZpPlatesStep *s) {
  Laws laws = laws_of(p, U0, U1);
  size_t last = p->nodes - 1;
  if (e1->cover)
    covered_elements(p, e0, e1, U0, U1, s);
  else if (p->edges)
    elements_with_edges(p, &laws, e0, e1, s);
  else if (e0 == e1)
    elements_at_rest(last, &laws, p->d, e1, s);
  else if (laws.count == 1)
    elements_at_one(last, &laws, p->d, e0, e1, s);
  else
    elements_at_two(last, &laws, p->d, e0, e1, s);
  if (!p->edges && !e1->cover) level_elements(p, &laws, e0, e1, s);
  stations(p, s);
  add_platform(p, U0, U1, e0, e1, s);
}

/* -- by the voltage ------------------------------------------------------------------------------- */

void zp_plates_by_voltage_reserve(const ZpPlatesParams *p, ZpPlatesByVoltage *by, ZpArena *arena) {
  double **arrays[] = {&by->Fx, &by->Fy, &by->Qx, &by->Qy};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_arena_take(arena, p->lanes);
}

/* Since dP/dU = -q, eq. (18.3) by the voltage has differences of the charge in place of those of the potential. */
typedef struct Charges {
  double W; /* -(q1 - q0) / (g1 - g0): derivative of the force on the gap by the voltage, N/V per length */
  double P; /* -(q0 + q1) / 2 */
} Charges;

/* A change of the voltage over which laws are differentiated: a part of it, or of a volt. */
static double little_voltage(double U) {
  static const double part = 1e-4;
  return part * fmax(fabs(U), 1);
}

/* For the law with edges, the difference of charges at gaps that are too close is rounding: that of forces at the two
 * sides of the voltage counts. */
static Charges charges_with_edges(const ZpPlatesParams *p, double U, double g0, double g1) {
  double q0 = zp_plates_law(p, U, g0).q, q1 = zp_plates_law(p, U, g1).q, by = little_voltage(U);
  double W = are_near(p, g0, g1) ? (zp_plates_law(p, U + by, g1).W - zp_plates_law(p, U - by, g1).W) / (2 * by)
                                 : -(q1 - q0) / (g1 - g0);
  return (Charges){W, -0.5 * (q0 + q1)};
}

static Charges charges_between(const ZpPlatesParams *p, double U, double g0, double g1) {
  if (p->edges) return charges_with_edges(p, U, g0, g1);
  double h_c = zp_plates_least_h(p, U), h0 = g0 + p->d, h1 = g1 + p->d, per_volt = 2 * p->k * U;
  double b0 = 1 / fmax(h0, h_c), b1 = 1 / fmax(h1, h_c);
  bool across = (h0 > h_c) != (h1 > h_c);
  double W = across ? (b0 - b1) / (h1 - h0) : h1 > h_c ? b0 * b1 : 0;
  return (Charges){per_volt * W, -0.5 * per_volt * (b0 + b1)};
}

/* dq/dU at a gap, F/m: 0 where the cap holds the charge. */
static double capacitance_at(const ZpPlatesParams *p, double U, double g) {
  double little = little_voltage(U);
  if (p->edges) return (zp_plates_law(p, U + little, g).q - zp_plates_law(p, U - little, g).q) / (2 * little);
  double h = g + p->d, h_c = p->h_per_volt * fabs(U);
  if (h < p->h_least) h = p->h_least;
  return h > h_c ? 2 * p->k / h : 0;
}

/* Parts of element i, of `share` of the charges between two ends => A, B, P. */
static void parts_of_charges_at(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U,
                                double share, size_t i, ZpPlatesStep *s) {
  double dx = 0.5 * (e0->dx[i] + e1->dx[i]), A = 0, B = 0, P = 0;
  ZpPlatesPiece piece[2];
  int pieces = zp_plates_pieces(p, zp_cover_part(e1->cover, i), i, piece);
  for (int k = 0; k < pieces * GAUSS; k++) {
    const ZpPlatesPiece *of = &piece[k / GAUSS];
    double r = zp_plates_share(p, of, i, k % GAUSS), l = 1 - r, w = gauss_weight[k % GAUSS] * (of->to - of->from);
    double g0 = l * e0->gap[i] + r * e0->gap[i + 1], g1 = l * e1->gap[i] + r * e1->gap[i + 1];
    Charges at = charges_between(of->law, U, g0, g1);
    A += w * l * at.W * dx;
    B += w * r * at.W * dx;
    P += w * at.P;
  }
  s->A[i] = share * A;
  s->B[i] = share * B;
  s->P[i] = share * P;
}

/* Parts of the charges of all elements in equilibrium, under the law of plates alone. */
ZP_KERNEL static void parts_of_charges_at_rest(size_t count, double d, double h_c, double per_volt,
                                               const ZpPlatesEval *e, const ZpPlatesStep *s) {
  const double *restrict gap = e->gap, *restrict dx = e->dx;
  double *restrict to_A = s->A, *restrict to_B = s->B, *restrict to_P = s->P;
  ZP_SIMD
  for (size_t i = 0; i < count; i++) {
    double A = 0, B = 0, P = 0;
    for (int q = 0; q < GAUSS; q++) {
      double r = gauss_at[q], l = 1 - r, w = gauss_weight[q], h = (l * gap[i] + r * gap[i + 1]) + d;
      double b = 1 / (h > h_c ? h : h_c), W = h > h_c ? per_volt * (b * b) : 0;
      A += w * l * W * dx[i];
      B += w * r * W * dx[i];
      P -= w * (per_volt * b);
    }
    to_A[i] = A;
    to_B[i] = B;
    to_P[i] = P;
  }
}

/* `count` of them from i on under one law. */
static void alike_charges(const ZpPlatesParams *law, const ZpPlatesEval *e, double U, double share, size_t i,
                          size_t count, const ZpPlatesStep *s) {
  ZpPlatesEval from = eval_from(e, i);
  ZpPlatesStep to = step_from(s, i);
  parts_of_charges_at_rest(count, law->d, zp_plates_least_h(law, U), share * (2 * law->k * U), &from, &to);
}

/* Charges with liquid where the cover has it. */
static void covered_charges(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, double share, ZpPlatesStep *s) {
  for (size_t i = 0, count; i + 1 < p->nodes; i += count > 0 ? count : 1) {
    count = alike_from(p, e->cover, i);
    if (count > 0)
      alike_charges(e->cover->part[i] == 1 ? p : p->air, e, U, share, i, count, s);
    else
      parts_of_charges_at(p, e, e, U, share, i, s);
  }
}

static void parts_of_charges(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U,
                             double share, ZpPlatesStep *s) {
  size_t elements = p->nodes - 1;
  if (p->edges || e0 != e1) {
    for (size_t i = 0; i < elements; i++)
      parts_of_charges_at(p, e0, e1, U, share, i, s);
    return;
  }
  if (e1->cover)
    covered_charges(p, e1, U, share, s);
  else
    alike_charges(p, e1, U, share, 0, elements, s);
  for (size_t k = 0; k < p->level.count; k++)
    parts_of_charges_at(p, e0, e1, U, share, p->level.of[k].element, s);
}

/* Forces of `share` of the charges between two ends => Fx, Fy. */
static void forces_of_charges(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U,
                              double share, ZpPlatesStep *s) {
  parts_of_charges(p, e0, e1, U, share, s);
  act_all(p, s);
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++) {
    double part = zp_plates_flat(p, e1->cover, i), W = part * charges_between(p, U, e0->gap[i], e1->gap[i]).W;
    if (part < 1) W += (1 - part) * charges_between(p->air, U, e0->gap[i], e1->gap[i]).W;
    attract(s->Fy, i, share * p->flat_length * W);
  }
}

static double capacitance(const ZpPlatesParams *p, const ZpPlatesEval *e, double U) {
  double sum = 0;
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    ZpPlatesPiece piece[2];
    int pieces = zp_plates_pieces(p, zp_cover_part(e->cover, i), i, piece);
    for (int k = 0; k < pieces * GAUSS; k++) {
      const ZpPlatesPiece *of = &piece[k / GAUSS];
      double gap = e->gap[i] + (e->gap[i + 1] - e->gap[i]) * zp_plates_share(p, of, i, k % GAUSS);
      sum += gauss_weight[k % GAUSS] * (of->to - of->from) * e->dx[i] * capacitance_at(of->law, U, gap);
    }
  }
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++) {
    double part = zp_plates_flat(p, e->cover, i);
    sum += part * p->flat_length * capacitance_at(p, U, e->gap[i]);
    if (part < 1) sum += (1 - part) * p->flat_length * capacitance_at(p->air, U, e->gap[i]);
  }
  return sum;
}

/* F = -dP/dq at one voltage and dP/dU = -q, so dF/dU = dq/dq. */
void zp_plates_rest_by_voltage(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, ZpPlatesStep *step, double *Fx,
                               double *Fy) {
  ZpPlatesStep lent = *step;
  lent.Fx = Fx;
  lent.Fy = Fy;
  forces_of_charges(p, e, e, U, 1, &lent);
}

/* The law is one of g + d: d grows as all gaps do at once. */
void zp_plates_rest_by_offset(const ZpPlatesParams *p, const ZpPlatesEval *e, double U, ZpPlatesStep *step, double *Fx,
                              double *Fy) {
  ZpPlatesStep lent = *step;
  lent.Fx = Fx;
  lent.Fy = Fy;
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    lent.A[i] = 2 * (lent.own_A[i] + lent.next[i]); /* the step's are half of the derivatives */
    lent.B[i] = 2 * (lent.own_B[i] + lent.next[i]);
    lent.P[i] = 2 * (lent.along0[i] + lent.along1[i]);
  }
  act_all(p, &lent);
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++)
    attract(Fy, i, p->flat_length * zp_plates_slope(p, U, e->gap[i]));
}

void zp_plates_by_voltage(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U1,
                          ZpPlatesStep *step, ZpPlatesByVoltage *by) {
  ZpPlatesStep lent = *step;
  lent.Fx = by->Fx;
  lent.Fy = by->Fy;
  forces_of_charges(p, e0, e1, U1, 0.5, &lent); /* the law at the end is half of the mean */
  zp_plates_rest_by_voltage(p, e1, U1, step, by->Qx, by->Qy);
  by->capacitance = capacitance(p, e1, U1);
}

void zp_plates_rest(const ZpPlatesParams *p, const double *x, const double *y, double U, ZpPlatesEval *e,
                    ZpPlatesStep *s) {
  zp_plates_gaps(p, x, y, e);
  zp_plates_step(p, e, e, U, U, s);
}

/* -- pieces from outside --------------------------------------------------------------------------- */

_Static_assert(ZP_PLATES_PLACES == GAUSS + 1, "the sampled points of an element and the platform's electrode");

ZpPlatesMean zp_plates_between(const ZpPlatesParams *p, double U0, double U1, double g0, double g1) {
  Laws laws = laws_of(p, U0, U1);
  Between law = mean_between(p, &laws, g0, g1);
  return (ZpPlatesMean){law.W, law.slope, law.P, law.W1};
}

ZpPlatesMean zp_plates_between_by_voltage(const ZpPlatesParams *p, double U1, double g0, double g1) {
  Charges at = charges_between(p, U1, g0, g1); /* the law at the end is half of the mean */
  return (ZpPlatesMean){0.5 * at.W, 0, 0.5 * at.P, 0};
}

double zp_plates_capacitance(const ZpPlatesParams *p, double U, double g) {
  return capacitance_at(p, U, g);
}

/* Where the part of an element begins that its sampled point q stands for, 0 .. 1. */
static double begin_of_place(size_t q) {
  double sum = 0;
  for (size_t k = 0; k < q; k++)
    sum += gauss_weight[k];
  return sum;
}

/* A place is wet by the share of its part of the element that the cover has. */
static double wet_share(const ZpPlatesParams *p, const ZpCover *cover, size_t i, size_t q) {
  double part = zp_cover_part(cover, i);
  if (part == 0 || part == 1) return part;
  double begin = begin_of_place(q), weight = gauss_weight[q];
  double before = i >= p->platform_end ? 1 - begin - weight : begin;
  return fmin(fmax((part - before) / weight, 0), 1);
}

ZpPlatesPlace zp_plates_place(const ZpPlatesParams *p, const ZpCover *cover, size_t at) {
  size_t i = at / ZP_PLATES_PLACES, q = at % ZP_PLATES_PLACES;
  if (q == GAUSS) return (ZpPlatesPlace){i, 0, 0, p->flat_length, zp_plates_flat(p, cover, i)};
  return (ZpPlatesPlace){i, zp_gauss_shares(&p->level, i)[q], gauss_weight[q], 0, wet_share(p, cover, i, q)};
}

size_t zp_plates_place_at(size_t left, double part) {
  size_t q = 0;
  while (q + 1 < GAUSS && part >= begin_of_place(q + 1))
    q++;
  return ZP_PLATES_PLACES * left + q;
}

size_t zp_plates_flat_place(size_t station) {
  return ZP_PLATES_PLACES * station + GAUSS;
}

void zp_plates_step_of(const ZpPlatesParams *p, const ZpPlatesMean *piece, const ZpPlatesEval *e0,
                       const ZpPlatesEval *e1, ZpPlatesStep *s) {
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    Parts parts = {0};
    const double *at = zp_gauss_shares(&p->level, i);
    for (int q = 0; q < GAUSS; q++) {
      ZpPlatesMean of = piece[ZP_PLATES_PLACES * i + (size_t)q];
      add_point(&parts, (Between){of.W, of.slope, of.P, of.W1}, 0.5 * (e0->dx[i] + e1->dx[i]), at[q], gauss_weight[q]);
    }
    put(s, i, parts);
  }
  stations(p, s);
  for (size_t i = p->platform; p->flat_length > 0 && i <= p->platform_end; i++) {
    ZpPlatesMean of = piece[ZP_PLATES_PLACES * i + GAUSS];
    attract(s->Fy, i, p->flat_length * of.W);
    s->own[i] += p->flat_length * of.slope;
  }
}
