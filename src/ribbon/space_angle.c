/* Letters of docs/theory.md, section 41:
 *   r, t    fixed and present tangent of an edge     l       its length
 *   phi     angle that a change of t adds            a       t x r
 */
#include "ribbon/space_angle.h"

#include "base/kernel.h"
#include "math/vector.h"

ZpSpaceAngle zp_space_angle(const double r[3], const ZpSpaceEdge *edge) {
  const double *t = edge->t, c = zp_space_dot(r, t), over = 1 / (1 + c), by = over / edge->length;
  ZpSpaceAngle angle = {{0}, {{0}}};
  double a[3], across[3] = {r[0], r[1], r[2]};
  zp_space_cross(t, r, a);
  zp_space_add(-c, t, across);
  zp_space_add(by, a, angle.first);
  zp_space_add_symmetric(-by * by, a, across, angle.second);
  zp_space_add_symmetric(-2 / edge->length, angle.first, t, angle.second);
  return angle;
}

/* Of a function of `ways` directions, of which the edge's vector begins at `at`, and its angle is `turn`. */
ZP_INLINE void count_first(const ZpSpaceAngle *angle, size_t at, size_t turn, double *first) {
  for (size_t i = 0; i < 3; i++)
    first[at + i] += first[turn] * angle->first[i];
}

/* The second derivatives [ways][ways], with the first one by the angle. */
ZP_INLINE void count_second(const ZpSpaceAngle *angle, size_t ways, size_t at, size_t turn, double by_turn,
                            double *second) {
  for (size_t b = 0; b < ways; b++)
    count_first(angle, at, turn, second + ways * b);
  for (size_t i = 0; i < 3; i++)
    for (size_t b = 0; b < ways; b++)
      second[ways * (at + i) + b] += angle->first[i] * second[ways * turn + b];
  for (size_t i = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++)
      second[ways * (at + i) + at + j] += by_turn * angle->second[i][j];
}

void zp_space_count_from(const ZpSpaceAngle *angle, double first[ZP_SPACE_OF_EDGE],
                         double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]) {
  enum { ANGLE = ZP_SPACE_OF_EDGE - 1 };
  count_first(angle, 0, ANGLE, first);
  if (second) count_second(angle, ZP_SPACE_OF_EDGE, 0, ANGLE, first[ANGLE], second[0]);
}

void zp_space_count_joint(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint) {
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    count_first(before, ZP_SPACE_BEFORE, ZP_SPACE_ANGLE_BEFORE, joint->gradient[s]);
    count_first(after, ZP_SPACE_AFTER, ZP_SPACE_ANGLE_AFTER, joint->gradient[s]);
  }
}

void zp_space_count_joint_second(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint) {
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    const double *first = joint->gradient[s];
    double *second = joint->second[s][0];
    count_second(before, ZP_SPACE_WAYS, ZP_SPACE_BEFORE, ZP_SPACE_ANGLE_BEFORE, first[ZP_SPACE_ANGLE_BEFORE], second);
    count_second(after, ZP_SPACE_WAYS, ZP_SPACE_AFTER, ZP_SPACE_ANGLE_AFTER, first[ZP_SPACE_ANGLE_AFTER], second);
  }
}

void zp_space_beside(const ZpSpaceEdge *edge, const double force[3], double across, double first[ZP_SPACE_OF_EDGE],
                     double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]) {
  const double *t = edge->t, *width = edge->width, over = 1 / edge->length;
  const double along = across * zp_space_dot(force, t), normal = across * zp_space_dot(force, edge->normal),
               beside = across * zp_space_dot(force, width);
  double flat[3] = {across * force[0], across * force[1], across * force[2]}, by[3][3] = {{0}};
  zp_space_add(-along, t, flat);
  for (int i = 0; i < 3; i++)
    first[i] = -along * over * width[i];
  first[3] = -normal;
  if (!second) return;
  zp_space_add_symmetric(2 * along * over * over, t, width, by);
  zp_space_add_symmetric(-over * over, width, flat, by);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++)
      second[i][j] = by[i][j];
    second[i][3] = second[3][i] = along * over * edge->normal[i];
  }
  second[3][3] = -beside;
}
