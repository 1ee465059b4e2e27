/* Letters of docs/theory.md, section 41:
 *   r, t    fixed and present tangent of an edge     l       its length
 *   phi     angle that a change of t adds            a       t x r
 */
#include "ribbon/space_angle.h"

#include "math/vector.h"

/* M += factor (u v' + v u'). */
static void add_pair(double factor, const double u[3], const double v[3], double M[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      M[i][j] += factor * (u[i] * v[j] + v[i] * u[j]);
}

ZpSpaceAngle zp_space_angle(const double r[3], const ZpSpaceEdge *edge) {
  const double *t = edge->t, c = zp_space_dot(r, t), over = 1 / (1 + c), by = over / edge->length;
  ZpSpaceAngle angle = {{0}, {{0}}};
  double a[3], across[3] = {r[0], r[1], r[2]};
  zp_space_cross(t, r, a);
  zp_space_add(-c, t, across);
  zp_space_add(by, a, angle.first);
  add_pair(-0.5 * by * by, a, across, angle.second);
  add_pair(-1 / edge->length, angle.first, t, angle.second);
  return angle;
}

void zp_space_count_from(const ZpSpaceAngle *angle, double first[ZP_SPACE_OF_EDGE],
                         double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]) {
  enum { ANGLE = 3 };
  for (int i = 0; i < ANGLE; i++)
    first[i] += first[ANGLE] * angle->first[i];
  if (!second) return;
  for (int b = 0; b < ZP_SPACE_OF_EDGE; b++)
    for (int i = 0; i < ANGLE; i++)
      second[b][i] += second[b][ANGLE] * angle->first[i];
  for (int i = 0; i < ANGLE; i++)
    for (int b = 0; b < ZP_SPACE_OF_EDGE; b++)
      second[i][b] += angle->first[i] * second[ANGLE][b];
  for (int i = 0; i < ANGLE; i++)
    for (int j = 0; j < ANGLE; j++)
      second[i][j] += first[ANGLE] * angle->second[i][j];
}

/* One edge of a joint, whose vector and angle are directions `at` and `turn`. */
static void count_edge(const ZpSpaceAngle *angle, int at, int turn, double first[ZP_SPACE_WAYS]) {
  for (int i = 0; i < 3; i++)
    first[at + i] += first[turn] * angle->first[i];
}

void zp_space_count_joint(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint) {
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    count_edge(before, ZP_SPACE_BEFORE, ZP_SPACE_ANGLE_BEFORE, joint->gradient[s]);
    count_edge(after, ZP_SPACE_AFTER, ZP_SPACE_ANGLE_AFTER, joint->gradient[s]);
  }
}

static void count_edge_second(const ZpSpaceAngle *angle, int at, int turn, double by_turn,
                              double second[ZP_SPACE_WAYS][ZP_SPACE_WAYS]) {
  for (int b = 0; b < ZP_SPACE_WAYS; b++)
    count_edge(angle, at, turn, second[b]);
  for (int i = 0; i < 3; i++)
    for (int b = 0; b < ZP_SPACE_WAYS; b++)
      second[at + i][b] += angle->first[i] * second[turn][b];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      second[at + i][at + j] += by_turn * angle->second[i][j];
}

void zp_space_count_joint_second(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint) {
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    const double *first = joint->gradient[s];
    count_edge_second(before, ZP_SPACE_BEFORE, ZP_SPACE_ANGLE_BEFORE, first[ZP_SPACE_ANGLE_BEFORE], joint->second[s]);
    count_edge_second(after, ZP_SPACE_AFTER, ZP_SPACE_ANGLE_AFTER, first[ZP_SPACE_ANGLE_AFTER], joint->second[s]);
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
  add_pair(along * over * over, t, width, by);
  add_pair(-0.5 * over * over, width, flat, by);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++)
      second[i][j] = by[i][j];
    second[i][3] = second[3][i] = along * over * edge->normal[i];
  }
  second[3][3] = -beside;
}
