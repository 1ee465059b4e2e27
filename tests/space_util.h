/* A rod in space that stands alone, and its equilibria, by Newton's method on a band. */
#ifndef ZP_TESTS_SPACE_UTIL_H
#define ZP_TESTS_SPACE_UTIL_H

#include "check_util.h"

#include "ribbon/space_rod.h"

enum { ROD_MOST = 161, ROD_UNKNOWNS = ZP_SPACE_OF_NODE * ROD_MOST, ROD_WIDE = ZP_SPACE_BAND + 1 };

typedef struct Rod {
  ZpSpaceRodParams params;
  ZpSpaceRod rod;
  ZpSpacePoint point[3 * ROD_MOST];
  ZpSpaceWarp warp[2 * ROD_MOST];
  double at[ROD_MOST][3];
  ZpSpaceEdge edge[ROD_MOST + 1];
  ZpSpaceJoint joint[ROD_MOST];
  bool fixed[ROD_UNKNOWNS];
  double load[ROD_UNKNOWNS], gradient[ROD_UNKNOWNS], K[ROD_UNKNOWNS * ROD_WIDE];
  size_t negative; /* eigenvalues of the last stiffness */
} Rod;

static inline size_t rod_unknowns(const Rod *r) {
  return ZP_SPACE_OF_NODE * r->params.nodes;
}

/* An edge along x with this normal, which is orthogonal to x. */
static inline ZpSpaceEdge edge_along_x(double length, double normal_y, double normal_z) {
  return (ZpSpaceEdge){
      .length = length, .t = {1, 0, 0}, .normal = {0, normal_y, normal_z}, .width = {0, -normal_z, normal_y}};
}

/* A straight rod from the origin along x; the slopes at its ends are held, or not, and so are the nodes there. */
static inline void rod_straight(Rod *r, size_t nodes, double length, const ZpSpaceSection *section, double EA,
                                const bool held[2], bool flat, double normal_y, double normal_z) {
  memset(r, 0, sizeof *r);
  const double l = length / (double)(nodes - 1);
  r->params = (ZpSpaceRodParams){.nodes = nodes, .l = l, .S = EA / l, .section = *section};
  zp_space_points(&r->params, held, flat, r->point, r->warp);
  r->rod = (ZpSpaceRod){.at = r->at, .edge = r->edge, .joint = r->joint};
  for (size_t i = 0; i <= nodes; i++)
    r->edge[i] = edge_along_x(l, normal_y, normal_z);
  for (size_t i = 0; i < nodes; i++)
    r->at[i][0] = l * (double)i;
  for (int end = 0; end < 2; end++)
    for (size_t c = 0; c < 3; c++)
      r->fixed[ZP_SPACE_OF_NODE * (end ? nodes - 1 : 0) + c] = held[end];
  r->fixed[rod_unknowns(r) - 1] = true; /* there is no edge after the last node */
}

/* Factor K in place and solve. */
static inline void rod_solve_linear(Rod *r, double *x) {
  const size_t n = rod_unknowns(r);
  r->negative = 0;
  for (size_t i = 0; i < n; i++) {
    const double *row = r->K + i * ROD_WIDE;
    r->negative += row[0] < 0;
    for (size_t a = 1; a < ROD_WIDE && i + a < n; a++) {
      const double factor = row[a] / row[0];
      for (size_t b = a; b < ROD_WIDE && i + b < n; b++)
        r->K[(i + a) * ROD_WIDE + b - a] -= factor * row[b];
      x[i + a] -= factor * x[i];
    }
  }
  for (size_t i = n; i-- > 0;) {
    const double *row = r->K + i * ROD_WIDE;
    for (size_t a = 1; a < ROD_WIDE && i + a < n; a++)
      x[i] -= row[a] * x[i + a];
    x[i] /= row[0];
  }
}

/* The stiffness without what is fixed. */
static inline void rod_stiffness(Rod *r) {
  const size_t n = rod_unknowns(r);
  memset(r->K, 0, sizeof r->K);
  zp_space_stiffness(&r->params, &r->rod, r->K);
  for (size_t i = 0; i < n; i++)
    for (size_t a = 0; a < ROD_WIDE && i + a < n; a++)
      if (r->fixed[i] || r->fixed[i + a]) r->K[i * ROD_WIDE + a] = a == 0;
}

/* Move by a step. */
static inline void rod_move(Rod *r, const double *step) {
  double angle[ROD_MOST];
  for (size_t i = 0; i < r->params.nodes; i++) {
    for (size_t c = 0; c < 3; c++)
      r->at[i][c] += step[ZP_SPACE_OF_NODE * i + c];
    angle[i] = step[ZP_SPACE_OF_NODE * i + 3];
  }
  zp_space_place(&r->params, &r->rod, angle);
}

/* Solve for rest under the load => the last change, m or rad. */
static inline double rod_settle(Rod *r) {
  enum { MOST = 30 };
  double change = INFINITY, step[ROD_UNKNOWNS];
  for (int k = 0; k < MOST && !(change < 1e-12 * r->params.l * (double)r->params.nodes); k++) {
    zp_space_energy(&r->params, &r->rod, r->gradient);
    rod_stiffness(r);
    change = 0;
    for (size_t i = 0; i < rod_unknowns(r); i++)
      step[i] = r->fixed[i] ? 0 : r->load[i] - r->gradient[i];
    rod_solve_linear(r, step);
    for (size_t i = 0; i < rod_unknowns(r); i++)
      change = fmax(change, fabs(step[i]));
    rod_move(r, step);
  }
  return change;
}

static inline void rod_rest(Rod *r) {
  const double change = rod_settle(r);
  ck_assert_msg(change < 1e-9, "no rest: last change %g", change);
}

/* Move what is free by random steps of at most `size` m, and 400 rad for a m. */
static inline void rod_shake(Rod *r, double size, uint64_t *seed) {
  double step[ROD_UNKNOWNS];
  for (size_t i = 0; i < rod_unknowns(r); i++)
    step[i] = r->fixed[i] ? 0 : size * noise(seed) * (i % ZP_SPACE_OF_NODE == 3 ? 400 : 1);
  rod_move(r, step);
}

#endif
