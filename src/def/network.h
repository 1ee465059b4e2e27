/* The bodies of a system, and the members between them. docs/theory.md, sections 29 and 31. */
#ifndef ZP_DEF_NETWORK_H
#define ZP_DEF_NETWORK_H

#include <zipact/table.h>

#include "def/def.h"

/* Ways in which a body in the plane moves. */
typedef enum ZpWay { ZP_WAY_ALONG, ZP_WAY_UP, ZP_WAY_TURNS, ZP_WAYS } ZpWay;

/* Rigid. Where all bodies move up and down, its height is 0 where all members above it are closed. */
typedef struct ZpBody {
  bool held;
  double y;       /* its place in the drawing, m; of one that moves up and down it counts in the plane only */
  size_t leader;  /* of one that moves up and down: the first member with its lower end there, or else its upper one */
  ZpMoves moves;  /* the rest counts in the plane: */
  double x;       /* its place in the drawing, m */
  double angle;   /* and that of its own axes, rad */
  double mass;    /* kg */
  double inertia; /* about its place, kg m2 */
  double force[2], torque; /* constant, at its place: N, N m */
  size_t unknown;          /* number of its first unknown among those of all bodies */
} ZpBody;

/* The bodies at the ends of a member. */
typedef struct ZpEnds {
  size_t upper, lower;
  bool turned;    /* it is upside down: it opens upwards */
  bool on_path;   /* it is one of those that lead from the frame to the load */
  size_t depth;   /* where all hang: members between it and what is held */
  size_t abreast; /* members between these two bodies that open the same way, this one included */
  size_t port;    /* the first member of those on its port, which have one voltage and one source */
  size_t next;    /* the next one on it; 0: none */
  double angle;   /* in the plane: direction in which it opens in the drawing, anticlockwise from straight down, rad, */
  double at[2][2]; /* and the points of the upper and of the lower body that it is fixed to, m */
} ZpEnds;

/* A spring between two bodies; the first one is the upper. */
typedef struct ZpLink {
  size_t body[2];
  double stiffness; /* N/m */
  double rest;      /* difference of their heights, in the plane distance of both points, without a force, m */
  ZpSpringKind kind;
  double direction; /* in the plane: in which it measures that distance, in the drawing, rad, fixed to the first body;
                       NAN: that of the line between both points */
  double friction;  /* coefficient, across the direction; 0: none */
  double at[2][2];  /* in the plane: the points of both bodies, m */
} ZpLink;

/* A joint between two bodies in the plane, at a point of the drawing. */
typedef struct ZpBodyJoint {
  ZpJointType type;
  size_t body[2];
  double at[2]; /* m */
} ZpBodyJoint;

typedef struct ZpNetwork {
  size_t bodies, members, springs, joints;
  size_t unknowns; /* in the plane: of all bodies */
  bool plane;      /* a body moves in the plane, so that members stand on bodies as they turn (theory, section 34) */
  size_t load;     /* the body that the load hangs on; `bodies`: none, as each has its own */
  size_t watched;  /* the body that study isometric holds; 0: none */
  bool pulled;     /* a force acts on a body */
  bool opposed;    /* a member is upside down: it pulls the load the other way */
  bool hangs;      /* each body that moves hangs on one member alone, so that weights give the force in all members */
  ZpBody *body;    /* [bodies]; the first one is the frame, to which the uppermost members are fixed */
  ZpEnds *ends;    /* [members] */
  ZpLink *spring;  /* [springs] */
  ZpBodyJoint *joint; /* [joints] */
  size_t *order;      /* [members] from the frame on: where all hang, a member comes after the one that it hangs on */
} ZpNetwork;

/* That of an actuator, a stack or a network; NULL if there is no memory. Freed as one block, by zp_free. */
ZpNetwork *zp_network_create(const ZpActuatorDef *def);

/* Are two members side by side: between the same bodies, and opening the same way? */
bool zp_network_abreast(const ZpNetwork *network, size_t one, size_t other);

/* Columns of a table for each body: where it is. */
const ZpColumn *zp_body_columns(bool plane, size_t *count);

/* In the plane: number of the unknown with which a body moves in a way; below 0: it does not. */
long zp_network_unknown(const ZpNetwork *network, size_t body, ZpWay way);

/* Do the same bodies hold the same members? Mounts may be at other heights. */
bool zp_network_alike(const ZpNetwork *one, const ZpNetwork *other);

/* How far below the frame the lowest mount is, m; 0: there is none. */
double zp_network_depth(const ZpNetwork *network);

/* A member's own frame is upright or upside down, and begins at its upper body if that is held, else at the frame. */
static inline double zp_network_sign(const ZpNetwork *network, size_t member) {
  return network->ends[member].turned ? -1 : 1;
}

static inline double zp_network_origin(const ZpNetwork *network, size_t member) {
  const ZpBody *upper = &network->body[network->ends[member].upper];
  return upper->held ? upper->y : 0;
}

#endif
