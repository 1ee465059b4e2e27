/* Bodies in the plane, and members that stand on them: where bodies are, where a member sees them in its own frame, and
 * the unknowns of both. docs/theory.md, section 34.
 *
 * A body is at its centre of mass, with the platforms that are fixed to it, and has turned by an angle from the
 * drawing. A member's frame is fixed to its upper body: its nodes are where they are seen from there, so that all laws
 * hold as for an actuator whose upper platform is held. Vectors are those of the drawing: x to the right, y up. */
#ifndef ZP_ACTUATOR_PLANE_H
#define ZP_ACTUATOR_PLANE_H

#include "actuator/assemble.h"

/* Of a body: its centre, m, and how far it has turned from the drawing, rad. */
typedef struct ZpPose {
  double x, y, turn;
} ZpPose;

typedef struct ZpVector {
  double x, y;
} ZpVector;

typedef struct ZpPlaneBody {
  ZpPose drawn;          /* in the drawing */
  ZpVector place;        /* its place, from its centre, m */
  double mass, inertia;  /* kg; about the centre, kg m2 */
  long unknown[ZP_WAYS]; /* in the border; below 0: it does not move this way */
} ZpPlaneBody;

/* A member on its bodies. */
typedef struct ZpStand {
  size_t upper, lower;
  ZpVector axis;    /* direction of its x axis in the drawing */
  ZpVector arm;     /* middle of its upper platform, from the centre of the upper body in the drawing, m */
  ZpVector node[2]; /* left and right end of its lower platform, from the centre of the lower body, m */
  double middle;    /* x of the middle of its upper platform in its own frame, m */
  bool still;       /* its upper body is held */
} ZpStand;

typedef struct ZpPlanar {
  const ZpModel *first;
  size_t bodies, members; /* 0: no body moves in the plane, and nothing else is used */
  ZpPlaneBody *body;      /* [bodies] */
  ZpStand *stand;         /* [members] */
  double length;          /* the unknown of a turn is this times the angle, m, so that its equation is a force */
} ZpPlanar;

/* Is a node part of a platform, and so of a body? */
static inline bool zp_is_of_platform(const ZpTopology *t, size_t node) {
  return node / t->ribbons == t->platform.first || node / t->ribbons == t->platform.last;
}

/* Does each member of a system reach from its upper to its lower end in the drawing? */
ZpStatus zp_plane_check(const ZpModel *first, ZpError *err);

/* Of a system. False if there is no memory. */
bool zp_plane_create(const ZpModel *first, ZpPlanar *plane);
void zp_plane_destroy(ZpPlanar *plane);

/* -- vectors --------------------------------------------------------------------------------------- */

static inline ZpVector zp_sum(ZpVector a, ZpVector b) {
  return (ZpVector){a.x + b.x, a.y + b.y};
}

static inline ZpVector zp_difference(ZpVector a, ZpVector b) {
  return (ZpVector){a.x - b.x, a.y - b.y};
}

static inline ZpVector zp_times(double factor, ZpVector a) {
  return (ZpVector){factor * a.x, factor * a.y};
}

static inline double zp_along(ZpVector a, ZpVector b) {
  return a.x * b.x + a.y * b.y;
}

/* Turned by a quarter, anticlockwise. */
static inline ZpVector zp_across(ZpVector a) {
  return (ZpVector){-a.y, a.x};
}

/* Turned as the x axis to `axis`, and back. */
static inline ZpVector zp_turned(ZpVector axis, ZpVector a) {
  return (ZpVector){axis.x * a.x - axis.y * a.y, axis.y * a.x + axis.x * a.y};
}

static inline ZpVector zp_turned_back(ZpVector axis, ZpVector a) {
  return (ZpVector){axis.x * a.x + axis.y * a.y, axis.x * a.y - axis.y * a.x};
}

/* The direction at an angle, rad. */
ZpVector zp_direction(double angle);

/* -- where things are ------------------------------------------------------------------------------ */

/* Where a point is that is `arm` from the centre of a body in the drawing, m. */
ZpVector zp_pose_point(const ZpPose *pose, ZpVector arm);

/* Mean rate of that point, or of a direction `arm`, by the turn of the body over a span, m/rad: its way is this times
 * the angle, eq. (34.4). At rest both ends are the same. */
ZpVector zp_pose_sweep(const ZpPose *from, const ZpPose *to, ZpVector arm);

/* The place of a body, as its keys give it, and its angle. */
ZpPose zp_plane_place(const ZpPlanar *plane, size_t body, const ZpPose *pose);

/* Poses of all bodies in the drawing; by the unknowns x of a system whose border begins with `inner`, and back. */
void zp_plane_drawn(const ZpPlanar *plane, ZpPose *pose);
void zp_plane_poses(const ZpPlanar *plane, size_t inner, const double *x, ZpPose *pose);
void zp_plane_gather(const ZpPlanar *plane, size_t inner, const ZpPose *pose, double *x);

/* Direction of the x axis of a member's frame, and where its origin, the middle of the upper platform, is. */
ZpVector zp_stand_axis(const ZpStand *stand, const ZpPose *pose);
ZpVector zp_stand_origin(const ZpStand *stand, const ZpPose *pose);

/* A point of a member's frame in the drawing, and back, m. */
ZpVector zp_stand_outside(const ZpStand *stand, const ZpPose *pose, ZpVector inside);
ZpVector zp_stand_inside(const ZpStand *stand, const ZpPose *pose, ZpVector outside);

/* Where nodes of a member that it sees at x and y are in the drawing, in place. */
void zp_plane_draw(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t count, double *x, double *y);

/* Put the ends of a member's lower platform where its bodies are; `nearer`: that share of their way from where the
 * straight member has them. */
void zp_plane_put_platform(const ZpPlanar *plane, size_t member, const ZpPose *pose, double nearer, double *nodes);

/* Where an unknown of the lower or of the upper body of a member is in its block; below 0: it does not move that way.
 */
int zp_plane_border(const ZpPlanar *plane, size_t member, bool upper, ZpWay way, const ZpAssembly *assembly);

/* Factors of the lower platform's coordinates by the unknowns of bodies at these poses, eq. (34.2). */
void zp_plane_swing(const ZpPlanar *plane, size_t member, const ZpPose *pose, ZpAssembly *assembly);

/* Nodes of a member that are not part of a body, where it sees them: moved += what the motion u [n] of its upper body
 * adds to their motion, as the member sees it; u [n] += what forces on them, as it sees them, do to that body. Vectors
 * of the member stay those of its frame, eq. (34.5). */
void zp_plane_carry(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *nodes,
                    const double *u, double *moved);
void zp_plane_carry_back(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *nodes,
                         const double *force, double *u);

/* Masses of bodies: mass [n] +=, of a turn its inertia over length^2; mu [n] += mass times u. */
void zp_plane_add_masses(const ZpPlanar *plane, size_t inner, double *mass);
void zp_plane_weigh(const ZpPlanar *plane, size_t inner, const double *u, double *mu);

/* -- motion ---------------------------------------------------------------------------------------- */

/* In motion the unknowns of nodes are their places in the frame in which the member stands in the drawing, which does
 * not move, so that masses are constant. `nodes` as the member sees them => as they stand there, and back. */
void zp_plane_to_drawing(const ZpPlanar *plane, size_t member, const ZpPose *pose, double *nodes);
void zp_plane_from_drawing(const ZpPlanar *plane, size_t member, const ZpPose *pose, double *nodes);

/* Velocities or forces of nodes, turned in the same way. */
void zp_plane_turn(const ZpPlanar *plane, size_t member, const ZpPose *pose, bool to_drawing, double *vectors);

/* The change of a body's pose, m or rad, by changes or rates u [n] of unknowns; velocity of a point of it, `arm` from
 * its centre in the drawing. */
double zp_plane_change(const ZpPlanar *plane, size_t body, int way, size_t inner, const double *u);
ZpVector zp_plane_rate(const ZpPlanar *plane, size_t body, const ZpPose *pose, ZpVector arm, size_t inner,
                       const double *u);

/* f [n] += a force along a way of a body, about its centre, N or N m; the mean force over a span on a point of it. */
void zp_plane_push(const ZpPlanar *plane, size_t body, int way, double force, size_t inner, double *f);
void zp_plane_push_at(const ZpPlanar *plane, size_t body, ZpVector arm, ZpVector force, const ZpPose *from,
                      const ZpPose *to, size_t inner, double *f);

/* Velocities of the ends of both platforms, as the member sees them, by rates u [n] of bodies. */
void zp_plane_put_rates(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *u,
                        double *rates);

/* Mean forces of laws on nodes over a span, as the member sees them => f [n] +=: on its nodes, which are taken to the
 * drawing in `force`, and on its bodies, eq. (34.6). Their work is that of the forces along the way of the nodes as the
 * member sees it. */
void zp_plane_add_force(const ZpPlanar *plane, size_t member, const ZpPose *from, const ZpPose *to, size_t inner,
                        const double *start, const double *end, const ZpAssembly *assembly, double *force, double *f);

/* K += inertia of nodes that move with the frame of the upper body; `of_mass` 1/s2. */
void zp_plane_add_inertia(const ZpPlanar *plane, size_t member, const ZpPose *pose, const ZpAssembly *assembly,
                          double of_mass, const double *nodes, ZpBand *K);

/* K += what turns of a member's bodies change of the forces on its lower platform's ends, as it sees them; `share` of
 * it: 1 at rest, eq. (34.3). */
void zp_plane_add_turns(const ZpPlanar *plane, size_t member, const ZpPose *pose, const ZpAssembly *assembly,
                        const ZpVector force[2], double share, ZpBand *K);

#endif
