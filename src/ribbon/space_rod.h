/* A rod in space: edges that stretch, joints that turn about the width, the normal and the tangent of a strip. Its
 * energy, forces and stiffness at a point; docs/theory.md, section 41. In the plane it is the rod of rod.h.
 *
 * Unknown numbers of node i: x, y, z, and the angle of the edge from it to the next node, at [4 i]. A change moves the
 * nodes and turns the frames (space_joint.h), which are part of the state. */
#ifndef ZP_RIBBON_SPACE_ROD_H
#define ZP_RIBBON_SPACE_ROD_H

#include <stdbool.h>
#include <stddef.h>

#include "ribbon/space_joint.h"
#include "ribbon/space_section.h"

enum { ZP_SPACE_OF_NODE = 4 };

/* A place of the rod with an energy: `weight` m of rod at curvatures and a twist that are so many 1/m per rad of the
 * strains of one or two joints. */
typedef struct ZpSpacePoint {
  double weight;
  size_t joints, joint[2];
  double bend[2], twist[2];
} ZpSpacePoint;

/* Two places between which the warping energy acts: D (twist1 - twist0)^2 / (2 length); without a joint: twist 0. */
typedef struct ZpSpaceWarp {
  double length;
  size_t joints, joint[2];
  double twist[2];
} ZpSpaceWarp;

/* Joint i stands at node i: between the edges before and after it, or a held slope. Joints 0 and nodes - 1 exist where
 * the slope is held. */
typedef struct ZpSpaceRodParams {
  size_t nodes, points, warps;
  double l, S; /* rest length of edges, m; their stretching stiffness, N/m */
  ZpSpaceSection section;
  double natural[ZP_SPACE_STRAINS]; /* curvatures and twist of the rod at rest, 1/m */
  const ZpSpacePoint *point;
  const ZpSpaceWarp *warp;
  const double *from; /* [3] the tangent from which the angles of all edges are counted (space_angle.h); NULL: its own
                         present one */
} ZpSpaceRodParams;

/* Of a rod of four nodes or more, with slopes held at its ends or not, and the section held flat where they are held or
 * not => point [3 nodes at most], warp [2 nodes at most], and their numbers. */
void zp_space_points(ZpSpaceRodParams *params, const bool held[2], bool flat, ZpSpacePoint *point, ZpSpaceWarp *warp);

/* Tangent of a straight ribbon, from which angles of edges are counted. */
extern const double zp_space_along_x[3];

typedef struct ZpSpaceRod {
  double (*at)[3];     /* [nodes] positions, m */
  ZpSpaceEdge *edge;   /* [nodes + 1] edge i + 1 from node i to the next; the first and the last: held slopes */
  ZpSpaceJoint *joint; /* [nodes] */
  double *tension;     /* [nodes - 1] with which the stiffness is found, N; NULL: that of the edges */
  double *sway;        /* [nodes] moments about the normal likewise, N m; NULL: those of the joints */
} ZpSpaceRod;

/* From positions, with the frames that the edges have at their present tangents, turned by angles [nodes - 1] (NULL:
 * not) => edges. */
void zp_space_place(const ZpSpaceRodParams *params, ZpSpaceRod *rod, const double *angle);

/* Strains of all joints between placed edges, and their gradients, 0 along what is held; their moments become 0. */
void zp_space_turn_joints(const ZpSpaceRodParams *params, ZpSpaceRod *rod);

/* Curvatures and twist at a point, less the natural ones, 1/m; how many 1/m per rad of a strain of its joint j. */
void zp_space_curvatures(const ZpSpaceRodParams *params, const ZpSpaceRod *rod, const ZpSpacePoint *point,
                         double k[ZP_SPACE_STRAINS]);
double zp_space_factor(const ZpSpacePoint *point, size_t j, int strain);

/* Difference of the twists at both places of a warp, 1/m. */
double zp_space_warped(const ZpSpaceRod *rod, const ZpSpaceWarp *warp);

/* Energy, J, of placed edges => joints; their gradient [4 nodes], N and N m (NULL: not needed). */
double zp_space_energy(const ZpSpaceRodParams *params, ZpSpaceRod *rod, double *gradient);

/* By how much a change [4 nodes] of the unknowns would change the moments of joints about the normal, to first order, N
 * m
 * => change [nodes]. After zp_space_energy. */
void zp_space_sway_changes(const ZpSpaceRodParams *params, const ZpSpaceRod *rod, const double *step, double *change);

/* Add the second derivatives, after zp_space_energy, to K: that by unknowns i and j >= i at K[i * (ZP_SPACE_BAND + 1) +
 * j - i]. */
enum { ZP_SPACE_BAND = 4 * ZP_SPACE_OF_NODE - 1 };
void zp_space_stiffness(const ZpSpaceRodParams *params, ZpSpaceRod *rod, double *K);

#endif
