/* Letters of docs/theory.md, sections 2 and 8:
 *   T   tension of an edge, N                        N   tension at a node, N
 *   k   discrete curvature of a joint                M   its moment, dU/dphi = (dU/dk) (dk/dphi), N m
 */
#include "ribbon/stress.h"

#include <math.h>
#include <stdbool.h>

#include "ribbon/rod_point.h"

/* An edge: its direction and its tension. */
typedef struct Edge {
  double ux, uy, T;
} Edge;

static Edge edge_of(const ZpRodParams *p, const double *x, const double *y, size_t j) {
  double dx = x[j + p->ribbons] - x[j], dy = y[j + p->ribbons] - y[j], length = sqrt(dx * dx + dy * dy);
  return (Edge){dx / length, dy / length, p->S[j] * (length - p->l[j])};
}

/* tan(phi / 2) of the joint between two edges. */
static double half_between(Edge before, Edge after) {
  double sine = before.ux * after.uy - before.uy * after.ux, cosine = before.ux * after.ux + before.uy * after.uy;
  return sine / (1 + cosine);
}

/* Of a joint beside which only one edge is not held. */
static double half_at_end(const ZpRodParams *p, const double *x, const double *y, const ZpRodEnd *end) {
  static const Edge held = {1, 0, 0};
  Edge edge = edge_of(p, x, y, end->near);
  return end->far > end->near ? half_between(held, edge) : half_between(edge, held);
}

/* Of the joint beside that. */
static double half_beside(const ZpRodParams *p, const double *x, const double *y, const ZpRodEnd *end) {
  Edge near = edge_of(p, x, y, end->near), far = edge_of(p, x, y, end->far);
  return end->far > end->near ? half_between(near, far) : half_between(far, near);
}

/* dU/dk of joint j by the joints that bend together with it. */
static double added_at_ends(const ZpRodParams *p, const double *x, const double *y, size_t j) {
  double sum = 0;
  for (const ZpRodEnd *end = p->end; end < p->end + p->ends; end++) {
    if (j == end->held) sum += end->B * (zp_rod_curvature(half_beside(p, x, y, end)) - p->k0[end->next]);
    if (j == end->next) sum += end->B * (zp_rod_curvature(half_at_end(p, x, y, end)) - p->k0[end->held]);
  }
  return sum;
}

static double moment_of(const ZpStressParams *params, const double *x, const double *y, size_t j, Edge before,
                        Edge after) {
  const ZpRodParams *p = &params->rod;
  double half = half_between(before, after), q = 1 + half * half;
  if (params->springs) return p->B[j] * 2 * half * q;
  double by_k = p->B[j] * (zp_rod_curvature(half) - p->k0[j]) + added_at_ends(p, x, y, j);
  return by_k * (2 * q + 2 / q - 1) * (1.0 / 3);
}

/* At the end of a ribbon half an edge lies between the node and the middle of the edge, whose tension is known. */
static double tension_at_end(Edge last, Edge next) {
  return 1.5 * last.T - 0.5 * next.T;
}

/* Where the metal may yield the elastic moment tells the curvature, and the elastic tension the strain. */
static double stress_at(const ZpStressParams *p, const double *strain, size_t j, double moment, double tension) {
  if (!p->rod.plastic) return p->per_moment[j] * fabs(moment) + p->per_force[j] * fabs(tension);
  const ZpPlastic *plastic = &p->rod.plastic[j % p->rod.ribbons];
  const double *before = strain ? strain + ZP_FIBRES * zp_rod_point_at(&p->rod, j) : NULL;
  return zp_plastic_stress(plastic, before, moment / plastic->EI, tension / (plastic->share * plastic->EA));
}

/* From node j to node `last` of a ribbon, between which no edge is rigid. */
static void stress_between(const ZpStressParams *params, const double *x, const double *y, const double *strain,
                           size_t j, size_t last, double *stress) {
  static const Edge held = {1, 0, 0}; /* the slope beyond an end */
  const ZpRodParams *p = &params->rod;
  size_t s = p->ribbons;
  Edge before = edge_of(p, x, y, j), after = edge_of(p, x, y, j + s);
  stress[j] = stress_at(params, strain, j, moment_of(params, x, y, j, held, before), tension_at_end(before, after));
  for (j += s; j < last; j += s) {
    after = edge_of(p, x, y, j);
    stress[j] = stress_at(params, strain, j, moment_of(params, x, y, j, before, after), 0.5 * (before.T + after.T));
    if (j + s < last) before = after;
  }
  stress[last] =
      stress_at(params, strain, last, moment_of(params, x, y, last, after, held), tension_at_end(after, before));
}

void zp_stress(const ZpStressParams *params, const double *x, const double *y, const double *strain, double *stress) {
  const ZpRodParams *p = &params->rod;
  for (size_t r = 0; r < p->ribbons; r++) {
    bool whole = p->rigid == p->rigid_end || !zp_rod_is_rigid(p, r);
    size_t last = (p->nodes - 1) * p->ribbons + r;
    stress_between(params, x, y, strain, r, whole ? last : p->rigid * p->ribbons + r, stress);
    if (!whole) stress_between(params, x, y, strain, p->rigid_end * p->ribbons + r, last, stress);
  }
}
