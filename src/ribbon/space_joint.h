/* A joint of a rod in space: how far the strip turns from one edge to the next, about its width, its normal and its
 * tangent, with first and second derivatives. docs/theory.md, section 41.
 *
 * An edge has a tangent t and a frame of unit vectors: the normal m1 and the width m2 of the strip, t = m1 x m2. A
 * change of an edge carries its frame by the shortest rotation from the old tangent to the new one; a change of its
 * angle turns the frame about t, from m1 towards m2. */
#ifndef ZP_RIBBON_SPACE_JOINT_H
#define ZP_RIBBON_SPACE_JOINT_H

/* An edge. */
typedef struct ZpSpaceEdge {
  double length;    /* m */
  double t[3];      /* unit tangent */
  double normal[3]; /* unit vector m1, orthogonal to t */
  double width[3];  /* t x m1 */
} ZpSpaceEdge;

/* The edge from its vector, m, with the frame that it had at the tangent of `before`, turned by `angle`, rad,
 * below half a turn. */
ZpSpaceEdge zp_space_move(const ZpSpaceEdge *before, const double vector[3], double angle);

/* Strains of a joint: about the width, the normal and the tangent, rad. */
typedef enum ZpSpaceStrain { ZP_SPACE_BEND, ZP_SPACE_SWAY, ZP_SPACE_TWIST, ZP_SPACE_STRAINS } ZpSpaceStrain;

/* Scalar products of the unit vectors of two edges, eqs. (41.2) and (41.3): c and g, of a strain of bending g T, of
 * half the twist the tangent N / M. */
typedef struct ZpSpaceProducts {
  double c, g, T[2], N, M;
} ZpSpaceProducts;

ZpSpaceProducts zp_space_products(const ZpSpaceEdge *before, const ZpSpaceEdge *after);

/* Directions of derivatives: the vectors of the edge before and after the joint, then the angles of both. */
enum { ZP_SPACE_BEFORE = 0, ZP_SPACE_AFTER = 3, ZP_SPACE_ANGLE_BEFORE = 6, ZP_SPACE_ANGLE_AFTER, ZP_SPACE_WAYS };

typedef struct ZpSpaceJoint {
  double strain[ZP_SPACE_STRAINS];
  double gradient[ZP_SPACE_STRAINS][ZP_SPACE_WAYS];
  double second[ZP_SPACE_STRAINS][ZP_SPACE_WAYS][ZP_SPACE_WAYS];
  double moment[ZP_SPACE_STRAINS], stiffness[ZP_SPACE_STRAINS][ZP_SPACE_STRAINS]; /* of a rod's energy by its strains,
                                                                                     N m: space_rod.h */
} ZpSpaceJoint;

/* Strains between two edges, which do not turn back, and their gradients, eqs. (41.2) and (41.3). */
void zp_space_joint(const ZpSpaceEdge *before, const ZpSpaceEdge *after, ZpSpaceJoint *joint);

/* Their second derivatives, after zp_space_joint. */
void zp_space_joint_second(const ZpSpaceEdge *before, const ZpSpaceEdge *after, ZpSpaceJoint *joint);

#endif
