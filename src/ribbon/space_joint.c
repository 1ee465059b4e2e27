/* Letters of docs/theory.md, section 41:
 *   t0, t1  tangents before and after the joint      b = t0 x t1,  c = t0 . t1
 *   K = g b  vector of the turn,  g = (4 / (1 + c) + 1) / 3, as in the plane, eq. (8.2)
 *   a       mean of a frame vector of both edges; a strain of bending is a . K
 */
#include "ribbon/space_joint.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"
#include "math/vector.h"

/* -- edges ----------------------------------------------------------------------------------------- */

/* Carry a unit vector that is orthogonal to the unit vector `from` by the shortest rotation from it to `to`, which is
 * not opposite. */
static void carry(const double from[3], const double to[3], double vector[3]) {
  const double part = -zp_space_dot(vector, to) / (1 + zp_space_dot(from, to));
  zp_space_add(part, from, vector);
  zp_space_add(part, to, vector);
}

ZpSpaceEdge zp_space_move(const ZpSpaceEdge *before, const double vector[3], double angle) {
  ZpSpaceEdge edge = {.length = sqrt(zp_space_dot(vector, vector))};
  double normal[3], width[3];
  zp_space_add(1 / edge.length, vector, edge.t);
  memcpy(normal, before->normal, sizeof normal);
  carry(before->t, edge.t, normal);
  zp_space_add(-zp_space_dot(normal, edge.t), edge.t, normal);
  const double over = 1 / sqrt(zp_space_dot(normal, normal));
  zp_space_cross(edge.t, normal, width);
  const double half = zp_tangent(0.5 * angle), share = over / (1 + half * half);
  zp_space_add((1 - half * half) * share, normal, edge.normal);
  zp_space_add(2 * half * share, width, edge.normal);
  zp_space_cross(edge.t, edge.normal, edge.width);
  return edge;
}

/* -- strains --------------------------------------------------------------------------------------- */

ZpSpaceProducts zp_space_products(const ZpSpaceEdge *a, const ZpSpaceEdge *b) {
  ZpSpaceProducts p = {.c = zp_space_dot(a->t, b->t)};
  p.g = (4 / (1 + p.c) + 1) / 3;
  p.T[ZP_SPACE_BEND] = 0.5 * (zp_space_dot(b->t, a->normal) - zp_space_dot(a->t, b->normal));
  p.T[ZP_SPACE_SWAY] = 0.5 * (zp_space_dot(a->t, b->width) - zp_space_dot(b->t, a->width));
  p.N = zp_space_dot(a->width, b->normal) - zp_space_dot(a->normal, b->width);
  p.M = 1 + p.c + zp_space_dot(a->normal, b->normal) + zp_space_dot(a->width, b->width);
  return p;
}

/* Between two tangents. */
typedef struct Turn {
  const ZpSpaceEdge *edge[2];
  ZpSpaceProducts product;
  double b[3], over; /* 1 / (1 + c) */
  double g1, g2;     /* derivatives of g by c */
  double K[3];
} Turn;

static Turn turn_of(const ZpSpaceEdge *before, const ZpSpaceEdge *after) {
  const ZpSpaceProducts product = zp_space_products(before, after);
  Turn turn = {.edge = {before, after}, .product = product};
  zp_space_cross(before->t, after->t, turn.b);
  turn.over = 1 / (1 + product.c);
  turn.g1 = -4.0 / 3 * turn.over * turn.over;
  turn.g2 = -2 * turn.g1 * turn.over;
  zp_space_add(product.g, turn.b, turn.K);
  return turn;
}

/* A strain of bending: about the mean of one vector of both frames, which a change of the angle of an edge turns
 * towards `turned`. */
typedef struct Axis {
  const double *of[2], *turned[2];
  double sense; /* 1, or -1 against `turned` */
  double a[3];
} Axis;

static Axis axis_of(const Turn *turn, ZpSpaceStrain strain) {
  Axis axis = {.sense = strain == ZP_SPACE_BEND ? -1 : 1};
  for (int e = 0; e < 2; e++) {
    const ZpSpaceEdge *edge = turn->edge[e];
    axis.of[e] = strain == ZP_SPACE_BEND ? edge->width : edge->normal;
    axis.turned[e] = strain == ZP_SPACE_BEND ? edge->normal : edge->width;
    zp_space_add(0.5, axis.of[e], axis.a);
  }
  return axis;
}

/* Derivative of a . K by both tangents, as if they were free. */
static void by_tangents(const Turn *turn, const Axis *axis, double A[2][3]) {
  const double *t0 = turn->edge[0]->t, *t1 = turn->edge[1]->t, ab = zp_space_dot(axis->a, turn->b);
  double across[2][3];
  zp_space_cross(t1, axis->a, across[0]);
  zp_space_cross(axis->a, t0, across[1]);
  for (int e = 0; e < 2; e++) {
    memset(A[e], 0, sizeof A[e]);
    zp_space_add(turn->g1 * ab, e == 0 ? t1 : t0, A[e]);
    zp_space_add(turn->product.g, across[e], A[e]);
  }
}

static void bending(const Turn *turn, ZpSpaceStrain strain, ZpSpaceJoint *joint) {
  const Axis axis = axis_of(turn, strain);
  double A[2][3], *gradient = joint->gradient[strain];
  joint->strain[strain] = turn->product.g * turn->product.T[strain];
  by_tangents(turn, &axis, A);
  for (int e = 0; e < 2; e++) {
    const ZpSpaceEdge *edge = turn->edge[e];
    const double along = zp_space_dot(edge->t, A[e]);
    for (int i = 0; i < 3; i++)
      gradient[3 * e + i] = (A[e][i] - along * edge->t[i]) / edge->length;
    gradient[ZP_SPACE_ANGLE_BEFORE + e] = 0.5 * axis.sense * zp_space_dot(axis.turned[e], turn->K);
  }
}

static void twist(const Turn *turn, ZpSpaceJoint *joint) {
  const ZpSpaceEdge *before = turn->edge[0], *after = turn->edge[1];
  double *gradient = joint->gradient[ZP_SPACE_TWIST];
  joint->strain[ZP_SPACE_TWIST] = 2 * zp_angle(turn->product.N, turn->product.M);
  for (int i = 0; i < 3; i++) {
    gradient[ZP_SPACE_BEFORE + i] = turn->over * turn->b[i] / before->length;
    gradient[ZP_SPACE_AFTER + i] = turn->over * turn->b[i] / after->length;
  }
  gradient[ZP_SPACE_ANGLE_BEFORE] = -1;
  gradient[ZP_SPACE_ANGLE_AFTER] = 1;
}

void zp_space_joint(const ZpSpaceEdge *before, const ZpSpaceEdge *after, ZpSpaceJoint *joint) {
  const Turn turn = turn_of(before, after);
  bending(&turn, ZP_SPACE_BEND, joint);
  bending(&turn, ZP_SPACE_SWAY, joint);
  twist(&turn, joint);
}

/* -- second derivatives ---------------------------------------------------------------------------- */

/* Of a strain by the tangents of both edges, as if they were free. A frame that is carried along two changes, one after
 * the other, turns about t by half the area between them, one way or the other: these are means of both orders. */
typedef struct Second {
  double A[2][3];                     /* first derivatives */
  double M[2][3][3], mixed[3][3];     /* by one tangent; by that before (rows) and that after */
  double by_angle[2][2][3], angle[2]; /* by the angle of an edge and a tangent; by an angle twice */
} Second;

/* M += factor a b'; M v += factor a x v */
static void add_outer(double factor, const double a[3], const double b[3], double M[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      M[i][j] += factor * a[i] * b[j];
}

static void add_skew(double factor, const double a[3], double M[3][3]) {
  M[0][1] -= factor * a[2];
  M[0][2] += factor * a[1];
  M[1][0] += factor * a[2];
  M[1][2] -= factor * a[0];
  M[2][0] -= factor * a[1];
  M[2][1] += factor * a[0];
}

static void second_of_bending(const Turn *turn, ZpSpaceStrain strain, Second *second) {
  const Axis axis = axis_of(turn, strain);
  const double *t[] = {turn->edge[0]->t, turn->edge[1]->t}, ab = zp_space_dot(axis.a, turn->b);
  double across[2][3];
  *second = (Second){0};
  by_tangents(turn, &axis, second->A);
  zp_space_cross(t[1], axis.a, across[0]);
  zp_space_cross(axis.a, t[0], across[1]);
  for (int e = 0; e < 2; e++) {
    const double *other = t[1 - e], turned = 0.5 * axis.sense * zp_space_dot(axis.turned[e], turn->b);
    add_outer(turn->g2 * ab, other, other, second->M[e]);
    zp_space_add_symmetric(2 * turn->g1, other, across[e], second->M[e]);
    zp_space_add_symmetric(0.5 * turn->product.g, axis.of[e], turn->b, second->M[e]);
    for (int by = 0; by < 2; by++) {
      double part[3];
      zp_space_cross(by == 0 ? t[1] : axis.turned[e], by == 0 ? axis.turned[e] : t[0], part);
      zp_space_add(turn->g1 * turned, t[1 - by], second->by_angle[e][by]);
      zp_space_add(0.5 * axis.sense * turn->product.g, part, second->by_angle[e][by]);
    }
    second->angle[e] = -0.5 * turn->product.g * zp_space_dot(axis.of[e], turn->b);
  }
  add_outer(turn->g2 * ab, t[1], t[0], second->mixed);
  add_outer(turn->g1, t[1], across[1], second->mixed);
  add_outer(turn->g1, across[0], t[0], second->mixed);
  add_skew(-turn->product.g, axis.a, second->mixed);
  for (int i = 0; i < 3; i++)
    second->mixed[i][i] += turn->g1 * ab;
}

static void second_of_twist(const Turn *turn, Second *second) {
  const double *t[] = {turn->edge[0]->t, turn->edge[1]->t}, over2 = turn->over * turn->over;
  *second = (Second){0};
  for (int e = 0; e < 2; e++) {
    zp_space_add(turn->over, turn->b, second->A[e]);
    zp_space_add_symmetric(-over2, turn->b, t[1 - e], second->M[e]);
    add_skew(0.5 * turn->over, t[e], second->mixed);
  }
  add_outer(-0.5 * over2, turn->b, t[0], second->mixed);
  add_outer(-0.5 * over2, t[1], turn->b, second->mixed);
}

/* (1 - t0 t0') M (1 - t1 t1') / (lengths) */
static void project(const ZpSpaceEdge *rows, const ZpSpaceEdge *columns, const double M[3][3], double out[3][3]) {
  double right[3], left[3] = {0};
  const double over = 1 / (rows->length * columns->length);
  for (int i = 0; i < 3; i++) {
    right[i] = zp_space_dot(M[i], columns->t);
    zp_space_add(rows->t[i], M[i], left);
  }
  const double both = zp_space_dot(rows->t, right);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[i][j] = over * (M[i][j] - right[i] * columns->t[j] - rows->t[i] * (left[j] - both * columns->t[j]));
}

/* By the vectors and angles of the edges. */
static void by_edges(const Turn *turn, const Second *second, double out[ZP_SPACE_WAYS][ZP_SPACE_WAYS]) {
  double block[3][3];
  for (int e = 0; e < 2; e++) {
    const ZpSpaceEdge *edge = turn->edge[e];
    const double over2 = 1 / (edge->length * edge->length), along = zp_space_dot(edge->t, second->A[e]);
    project(edge, edge, second->M[e], block);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        const double *t = edge->t, *A = second->A[e];
        const double turned = (A[i] - along * t[i]) * t[j] + t[i] * (A[j] - along * t[j]);
        out[3 * e + i][3 * e + j] = block[i][j] - over2 * (along * ((i == j) - t[i] * t[j]) + turned);
      }
    for (int by = 0; by < 2; by++) {
      const ZpSpaceEdge *other = turn->edge[by];
      const double part = zp_space_dot(other->t, second->by_angle[e][by]);
      for (int i = 0; i < 3; i++)
        out[ZP_SPACE_ANGLE_BEFORE + e][3 * by + i] = out[3 * by + i][ZP_SPACE_ANGLE_BEFORE + e] =
            (second->by_angle[e][by][i] - part * other->t[i]) / other->length;
    }
    out[ZP_SPACE_ANGLE_BEFORE + e][ZP_SPACE_ANGLE_BEFORE + e] = second->angle[e];
    out[ZP_SPACE_ANGLE_BEFORE + e][ZP_SPACE_ANGLE_AFTER - e] = 0;
  }
  project(turn->edge[0], turn->edge[1], second->mixed, block);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out[ZP_SPACE_BEFORE + i][ZP_SPACE_AFTER + j] = out[ZP_SPACE_AFTER + j][ZP_SPACE_BEFORE + i] = block[i][j];
}

void zp_space_joint_second(const ZpSpaceEdge *before, const ZpSpaceEdge *after, ZpSpaceJoint *joint) {
  const Turn turn = turn_of(before, after);
  for (int strain = 0; strain < ZP_SPACE_STRAINS; strain++) {
    Second second;
    if (strain == ZP_SPACE_TWIST)
      second_of_twist(&turn, &second);
    else
      second_of_bending(&turn, (ZpSpaceStrain)strain, &second);
    by_edges(&turn, &second, joint->second[strain]);
  }
}
