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
#include "math/vector.h"

/* -- edges ----------------------------------------------------------------------------------------- */

/* Turn a unit vector by omega. */
static void turn_vector(const double omega[3], const double v[3], double out[3]) {
  const double quarter = 0.25 * zp_space_dot(omega, omega), over = 1 / (1 + quarter);
  memset(out, 0, 3 * sizeof *out);
  zp_space_add((1 - quarter) * over, v, out);
  zp_space_add_cross(over, omega, v, out);
  zp_space_add(0.5 * zp_space_dot(omega, v) * over, omega, out);
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
  end->length = sqrt(zp_space_dot(vector, vector));
  for (int i = 0; i < 3; i++) {
    end->t[i] = vector[i] / end->length;
    turn->t[i] = 0.5 * (start->t[i] + end->t[i]);
    turn->change[i] = end->t[i] - start->t[i];
    turn->vector[i] = 0.5 * (start->length * start->t[i] + vector[i]);
  }
  turn->along = zp_space_dot(turn->t, turn->t);
  turn->over = 1 / (start->length * end->length * turn->along);
  zp_space_add_cross(1 / turn->along, turn->t, turn->change, turn->omega);
  zp_space_add(roll / turn->along, turn->t, turn->omega);
  turn_vector(turn->omega, start->normal, end->normal);
  zp_space_add(-zp_space_dot(end->normal, end->t), end->t, end->normal);
  const double size = sqrt(zp_space_dot(end->normal, end->normal));
  for (int i = 0; i < 3; i++)
    end->normal[i] /= size;
  memset(end->width, 0, sizeof end->width);
  zp_space_add_cross(1, end->t, end->normal, end->width);
  take_means(start, end, turn);
}

/* -- strains --------------------------------------------------------------------------------------- */

/* Changes of the strains are by [strain] . (omega_b - omega_a). */
static void changes_of_strains(const ZpSpaceEdge *edge0, const ZpSpaceEdge *edge1, const ZpSpaceTurn *a,
                               const ZpSpaceTurn *b, double by[ZP_SPACE_STRAINS][3]) {
  const ZpSpaceProducts start = zp_space_products(&edge0[0], &edge0[1]), end = zp_space_products(&edge1[0], &edge1[1]);
  const double g = 0.5 * (start.g + end.g), g_by_c = -4.0 / 3 / ((1 + start.c) * (1 + end.c));
  double by_c[3] = {0}, by_T[2][3] = {{0}}, by_N[3] = {0}, by_M[3] = {0};
  zp_space_add_cross(1, b->t, a->t, by_c);
  zp_space_add_cross(0.5, b->t, a->normal, by_T[ZP_SPACE_BEND]);
  zp_space_add_cross(-0.5, b->normal, a->t, by_T[ZP_SPACE_BEND]);
  zp_space_add_cross(0.5, b->width, a->t, by_T[ZP_SPACE_SWAY]);
  zp_space_add_cross(-0.5, b->t, a->width, by_T[ZP_SPACE_SWAY]);
  zp_space_add_cross(1, b->normal, a->width, by_N);
  zp_space_add_cross(-1, b->width, a->normal, by_N);
  zp_space_add(1, by_c, by_M);
  zp_space_add_cross(1, b->normal, a->normal, by_M);
  zp_space_add_cross(1, b->width, a->width, by_M);
  memset(by, 0, ZP_SPACE_STRAINS * sizeof *by);
  for (int s = 0; s < 2; s++) {
    zp_space_add(g, by_T[s], by[s]);
    zp_space_add(0.5 * (start.T[s] + end.T[s]) * g_by_c, by_c, by[s]);
  }
  const double whole = start.M * end.M + start.N * end.N, part = (end.N * start.M - start.N * end.M) / whole;
  const double factor = 2 * (fabs(part) > 1e-9 ? zp_angle(part, 1) / part : 1) / whole;
  zp_space_add(factor * 0.5 * (start.M + end.M), by_N, by[ZP_SPACE_TWIST]);
  zp_space_add(-factor * 0.5 * (start.N + end.N), by_M, by[ZP_SPACE_TWIST]);
}

/* -- forces ---------------------------------------------------------------------------------------- */

void zp_space_bend(size_t edge, const double moment[3], ZpSpaceStep *step) {
  const ZpSpaceTurn *turn = &step->turn[edge + 1];
  double force[3] = {0};
  zp_space_add_cross(turn->over, moment, turn->vector, force);
  zp_space_add(-1, force, step->force[edge]);
  zp_space_add(1, force, step->force[edge + 1]);
}

/* The mean moments of a joint turn the edge before it forwards and the one after it back. */
static void bear(const ZpSpaceRodParams *p, const ZpSpaceRod *start, const ZpSpaceRod *end, size_t joint,
                 ZpSpaceStep *step) {
  double by[ZP_SPACE_STRAINS][3], moment[3] = {0};
  changes_of_strains(&start->edge[joint], &end->edge[joint], &step->turn[joint], &step->turn[joint + 1], by);
  for (int s = 0; s < ZP_SPACE_STRAINS; s++)
    zp_space_add(end->joint[joint].moment[s], by[s], moment);
  for (size_t e = 0; e < 2; e++) {
    if (joint + e == 0 || joint + e == p->nodes) continue; /* a held slope */
    const size_t edge = joint + e - 1;
    const ZpSpaceTurn *turn = &step->turn[edge + 1];
    const double sign = e == 0 ? 1 : -1, about = sign * zp_space_dot(moment, turn->t) / turn->along;
    double across[3] = {0};
    zp_space_add(sign, moment, across);
    zp_space_add(-about, turn->t, across);
    step->torque[edge] += about;
    zp_space_bend(edge, across, step);
  }
}

/* Mean moments over the step, of what a point and a warp store => joints at the end. */
static void take_moments(const ZpSpaceRodParams *p, const ZpSpaceRod *start, ZpSpaceRod *end) {
  for (const ZpSpacePoint *point = p->point; point < p->point + p->points; point++) {
    double from[ZP_SPACE_STRAINS], to[ZP_SPACE_STRAINS];
    zp_space_curvatures(p, start, point, from);
    zp_space_curvatures(p, end, point, to);
    for (int g = 0; g < GAUSS; g++) {
      const double at = gauss_at[g];
      const ZpSpaceLaw law = zp_space_law(&p->section, from[0] + at * (to[0] - from[0]),
                                          from[1] + at * (to[1] - from[1]), from[2] + at * (to[2] - from[2]));
      for (size_t j = 0; j < point->joints; j++)
        for (int s = 0; s < ZP_SPACE_STRAINS; s++)
          end->joint[point->joint[j]].moment[s] +=
              gauss_weight[g] * point->weight * zp_space_factor(point, j, s) * law.moment[s];
    }
  }
  for (const ZpSpaceWarp *warp = p->warp; warp < p->warp + p->warps; warp++) {
    const double between = 0.5 * (zp_space_warped(start, warp) + zp_space_warped(end, warp));
    for (size_t j = 0; j < warp->joints; j++)
      end->joint[warp->joint[j]].moment[ZP_SPACE_TWIST] += p->section.D / warp->length * between * warp->twist[j];
  }
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
    zp_space_add(T / length, turn->vector, step->force[i]);
    zp_space_add(-T / length, turn->vector, step->force[i + 1]);
  }
  zp_space_turn_joints(p, end);
  take_moments(p, start, end);
  for (size_t j = 0; j < p->nodes; j++)
    bear(p, start, end, j, step);
}
