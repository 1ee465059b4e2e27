/* The angle of an edge in space that is counted from a fixed start: an edge at its tangent has the frame that the
 * shortest rotation from a fixed tangent carries there, turned by the angle. Changes as space_joint.h counts them begin
 * at the present tangent. The difference of both is an angle that depends on the edge's vector alone. docs/theory.md,
 * section 41. */
#ifndef ZP_RIBBON_SPACE_ANGLE_H
#define ZP_RIBBON_SPACE_ANGLE_H

#include "ribbon/space_joint.h"

/* By how much a change of the edge's vector turns the frame: first derivatives, 1/m, and second ones, 1/m^2. */
typedef struct ZpSpaceAngle {
  double first[3], second[3][3];
} ZpSpaceAngle;

/* (fixed unit tangent, an edge whose tangent is not opposite to it), eqs. (41.6) and (41.7). */
ZpSpaceAngle zp_space_angle(const double from[3], const ZpSpaceEdge *edge);

/* Of a function of one edge: directions of its derivatives are the edge's vector, then its angle. */
enum { ZP_SPACE_OF_EDGE = 4 };

/* Derivatives by an edge whose angle is counted from its present tangent => by one that is counted from a fixed one.
 * second: NULL: not needed. */
void zp_space_count_from(const ZpSpaceAngle *angle, double first[ZP_SPACE_OF_EDGE],
                         double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]);

/* Those of the strains of a joint: the first ones, and the second ones. */
void zp_space_count_joint(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint);
void zp_space_count_joint_second(const ZpSpaceAngle *before, const ZpSpaceAngle *after, ZpSpaceJoint *joint);

/* A force, N, on a point of the strip that is `across` m beside the middle of an edge, along the edge's width: its
 * moment on the edge. Derivatives of F . width times `across`, N m per m and rad, eq. (41.8). */
void zp_space_beside(const ZpSpaceEdge *edge, const double force[3], double across, double first[ZP_SPACE_OF_EDGE],
                     double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]);

#endif
