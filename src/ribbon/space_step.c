/* Letters of docs/theory.md, section 41. Of two edges a and b, before and after a joint:
 *   x  scalar product of a unit vector of a and one of b; its change is (omega_b - omega_a) . (mean of b x mean of a)
 *   c = t_a . t_b    T = (t_b . m1_a - t_a . m1_b) / 2, or (t_a . m2_b - t_b . m2_a) / 2; a strain of bending is g T
 *   N, M  the tangent of half the twist is N / M
 */
#include "ribbon/space_step.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"
#include "math/gauss.h"

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void add_cross(double factor, const double a[3], const double b[3], double out[3]) {
  out[0] += factor * (a[1] * b[2] - a[2] * b[1]);
  out[1] += factor * (a[2] * b[0] - a[0] * b[2]);
  out[2] += factor * (a[0] * b[1] - a[1] * b[0]);
}

static void add(double factor, const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] += factor * v[i];
}

/* -- edges ----------------------------------------------------------------------------------------- */

/* Turn a unit vector by omega. */
static void turn_vector(const double omega[3], const double v[3], double out[3]) {
  const double quarter = 0.25 * dot(omega, omega), over = 1 / (1 + quarter);
  memset(out, 0, 3 * sizeof *out);
  add((1 - quarter) * over, v, out);
  add_cross(over, omega, v, out);
  add(0.5 * dot(omega, v) * over, omega, out);
}

static void mean(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] = 0.5 * (a[i] + b[i]);
}

static void take_means(const ZpSpaceEdge *start, const ZpSpaceEdge *end, ZpSpaceTurn *turn) {
  mean(start->t, end->t, turn->t);
  mean(start->normal, end->normal, turn->normal);
  mean(start->width, end->width, turn->width);
}

/* The edge at the end of the step, from its vector there and its roll. */
static void turn_edge(const ZpSpaceEdge *start, const double vector[3], double roll, ZpSpaceEdge *end,
                      ZpSpaceTurn *turn) {
  memset(turn, 0, sizeof *turn);
  end->length = sqrt(dot(vector, vector));
  for (int i = 0; i < 3; i++) {
    end->t[i] = vector[i] / end->length;
    turn->t[i] = 0.5 * (start->t[i] + end->t[i]);
    turn->change[i] = end->t[i] - start->t[i];
    turn->vector[i] = 0.5 * (start->length * start->t[i] + vector[i]);
  }
  turn->along = dot(turn->t, turn->t);
  turn->over = 1 / (start->length * end->length * turn->along);
  add_cross(1 / turn->along, turn->t, turn->change, turn->omega);
  add(roll / turn->along, turn->t, turn->omega);
  turn_vector(turn->omega, start->normal, end->normal);
  add(-dot(end->normal, end->t), end->t, end->normal);
  const double size = sqrt(dot(end->normal, end->normal));
  for (int i = 0; i < 3; i++)
    end->normal[i] /= size;
  memset(end->width, 0, sizeof end->width);
  add_cross(1, end->t, end->normal, end->width);
  take_means(start, end, turn);
}

/* -- strains --------------------------------------------------------------------------------------- */

/* Scalar products at one end of the step. */
typedef struct Products {
  double c, g, T[2], N, M;
} Products;

static Products products_of(const ZpSpaceEdge *a, const ZpSpaceEdge *b) {
  Products p = {.c = dot(a->t, b->t)};
  p.g = (4 / (1 + p.c) + 1) / 3;
  p.T[ZP_SPACE_BEND] = 0.5 * (dot(b->t, a->normal) - dot(a->t, b->normal));
  p.T[ZP_SPACE_SWAY] = 0.5 * (dot(a->t, b->width) - dot(b->t, a->width));
  p.N = dot(a->width, b->normal) - dot(a->normal, b->width);
  p.M = 1 + p.c + dot(a->normal, b->normal) + dot(a->width, b->width);
  return p;
}

/* Changes of the strains are by [strain] . (omega_b - omega_a). */
static void changes_of_strains(const ZpSpaceEdge *edge0, const ZpSpaceEdge *edge1, const ZpSpaceTurn *a,
                               const ZpSpaceTurn *b, double by[ZP_SPACE_STRAINS][3]) {
  const Products start = products_of(&edge0[0], &edge0[1]), end = products_of(&edge1[0], &edge1[1]);
  const double g = 0.5 * (start.g + end.g), g_by_c = -4.0 / 3 / ((1 + start.c) * (1 + end.c));
  double by_c[3] = {0}, by_T[2][3] = {{0}}, by_N[3] = {0}, by_M[3] = {0};
  add_cross(1, b->t, a->t, by_c);
  add_cross(0.5, b->t, a->normal, by_T[ZP_SPACE_BEND]);
  add_cross(-0.5, b->normal, a->t, by_T[ZP_SPACE_BEND]);
  add_cross(0.5, b->width, a->t, by_T[ZP_SPACE_SWAY]);
  add_cross(-0.5, b->t, a->width, by_T[ZP_SPACE_SWAY]);
  add_cross(1, b->normal, a->width, by_N);
  add_cross(-1, b->width, a->normal, by_N);
  add(1, by_c, by_M);
  add_cross(1, b->normal, a->normal, by_M);
  add_cross(1, b->width, a->width, by_M);
  memset(by, 0, ZP_SPACE_STRAINS * sizeof *by);
  for (int s = 0; s < 2; s++) {
    add(g, by_T[s], by[s]);
    add(0.5 * (start.T[s] + end.T[s]) * g_by_c, by_c, by[s]);
  }
  const double whole = start.M * end.M + start.N * end.N, part = (end.N * start.M - start.N * end.M) / whole;
  const double factor = 2 * (fabs(part) > 1e-9 ? zp_angle(part, 1) / part : 1) / whole;
  add(factor * 0.5 * (start.M + end.M), by_N, by[ZP_SPACE_TWIST]);
  add(-factor * 0.5 * (start.N + end.N), by_M, by[ZP_SPACE_TWIST]);
}

/* -- forces ---------------------------------------------------------------------------------------- */

void zp_space_bend(size_t edge, const double moment[3], ZpSpaceStep *step) {
  const ZpSpaceTurn *turn = &step->turn[edge + 1];
  double force[3] = {0};
  add_cross(turn->over, moment, turn->vector, force);
  add(-1, force, step->force[edge]);
  add(1, force, step->force[edge + 1]);
}

/* A moment that the joint bears turns the edge before it forwards and the one after it back. */
static void bear(const ZpSpaceRodParams *p, size_t joint, const double moment[3], ZpSpaceStep *step) {
  for (size_t e = 0; e < 2; e++) {
    if (joint + e == 0 || joint + e == p->nodes) continue; /* a held slope */
    const size_t edge = joint + e - 1;
    const ZpSpaceTurn *turn = &step->turn[edge + 1];
    const double sign = e == 0 ? 1 : -1, about = sign * dot(moment, turn->t) / turn->along;
    double across[3] = {0};
    add(sign, moment, across);
    add(-about, turn->t, across);
    step->torque[edge] += about;
    zp_space_bend(edge, across, step);
  }
}

static double curvature_at(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, const ZpSpacePoint *point, int s) {
  const bool twists = s != ZP_SPACE_TWIST || point->twist[0] != 0 || point->twist[1] != 0;
  double k = twists ? -p->natural[s] : 0;
  for (size_t j = 0; j < point->joints; j++)
    k += (s == ZP_SPACE_TWIST ? point->twist[j] : point->bend[j]) * rod->joint[point->joint[j]].strain[s];
  return k;
}

/* Mean moments over the step. */
static void moments_at(const ZpSpaceRodParams *p, const ZpSpaceRod *start, const ZpSpaceRod *end,
                       const ZpSpacePoint *point, double moment[ZP_SPACE_STRAINS]) {
  double from[ZP_SPACE_STRAINS], to[ZP_SPACE_STRAINS];
  memset(moment, 0, ZP_SPACE_STRAINS * sizeof *moment);
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    from[s] = curvature_at(p, start, point, s);
    to[s] = curvature_at(p, end, point, s);
  }
  for (int g = 0; g < GAUSS; g++) {
    const double at = gauss_at[g];
    const ZpSpaceLaw law = zp_space_law(&p->section, from[0] + at * (to[0] - from[0]), from[1] + at * (to[1] - from[1]),
                                        from[2] + at * (to[2] - from[2]));
    for (int s = 0; s < ZP_SPACE_STRAINS; s++)
      moment[s] += gauss_weight[g] * law.moment[s];
  }
}

static double twist_between(const ZpSpaceRod *rod, const ZpSpaceWarp *warp) {
  double twist = 0;
  for (size_t j = 0; j < warp->joints; j++)
    twist += warp->twist[j] * rod->joint[warp->joint[j]].strain[ZP_SPACE_TWIST];
  return twist;
}

void zp_space_step(const ZpSpaceRodParams *p, const ZpSpaceRod *start, ZpSpaceRod *end, const double *roll,
                   ZpSpaceStep *step) {
  memset(step->force, 0, p->nodes * sizeof *step->force);
  memset(step->torque, 0, (p->nodes - 1) * sizeof *step->torque);
  for (size_t e = 0; e <= p->nodes; e += p->nodes) { /* held slopes */
    end->edge[e] = start->edge[e];
    memset(&step->turn[e], 0, sizeof step->turn[e]);
    take_means(&start->edge[e], &end->edge[e], &step->turn[e]);
  }
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    double vector[3];
    for (int c = 0; c < 3; c++)
      vector[c] = end->at[i + 1][c] - end->at[i][c];
    ZpSpaceTurn *turn = &step->turn[i + 1];
    turn_edge(&start->edge[i + 1], vector, roll[i], &end->edge[i + 1], turn);
    const double length = 0.5 * (start->edge[i + 1].length + end->edge[i + 1].length), T = p->S * (length - p->l);
    add(T / length, turn->vector, step->force[i]);
    add(-T / length, turn->vector, step->force[i + 1]);
  }
  for (size_t j = 0; j < p->nodes; j++)
    zp_space_joint(&end->edge[j], &end->edge[j + 1], &end->joint[j]);
  for (const ZpSpacePoint *point = p->point; point < p->point + p->points; point++) {
    double moment[ZP_SPACE_STRAINS];
    moments_at(p, start, end, point, moment);
    for (size_t j = 0; j < point->joints; j++) {
      const size_t at = point->joint[j];
      double by[ZP_SPACE_STRAINS][3], borne[3] = {0};
      changes_of_strains(&start->edge[at], &end->edge[at], &step->turn[at], &step->turn[at + 1], by);
      for (int s = 0; s < ZP_SPACE_STRAINS; s++)
        add(point->weight * (s == ZP_SPACE_TWIST ? point->twist[j] : point->bend[j]) * moment[s], by[s], borne);
      bear(p, at, borne, step);
    }
  }
  for (const ZpSpaceWarp *warp = p->warp; warp < p->warp + p->warps; warp++) {
    const double between = 0.5 * (twist_between(start, warp) + twist_between(end, warp));
    for (size_t j = 0; j < warp->joints; j++) {
      const size_t at = warp->joint[j];
      double by[ZP_SPACE_STRAINS][3], borne[3] = {0};
      changes_of_strains(&start->edge[at], &end->edge[at], &step->turn[at], &step->turn[at + 1], by);
      add(p->section.D / warp->length * between * warp->twist[j], by[ZP_SPACE_TWIST], borne);
      bear(p, at, borne, step);
    }
  }
}
