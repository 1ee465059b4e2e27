/* Parts of an actuator: how many ribbons, how many stations along them, what joins and holds them at their ends, and
 * where the platform is. The one place that says so: all others ask for the platform, the clip or the nodes of a
 * station. docs/theory.md, section 19.
 *
 * Stations are numbered from left to right. Node j = station * ribbons + ribbon; of two ribbons, 0 is the upper one.
 * Coordinate k = 2 j is x of node j, 2 j + 1 its y; behind those of all nodes are 2 j its z and 2 j + 1 the angle of
 * the edge from it to the right, of a model in space. */
#ifndef ZP_ACTUATOR_TOPOLOGY_H
#define ZP_ACTUATOR_TOPOLOGY_H

#include "def/def.h"
#include <math.h>

#include "math/level.h"

typedef enum ZpJointKind {
  ZP_JOINT_CLIP,     /* both nodes are one; horizontal */
  ZP_JOINT_CLAMP,    /* held; horizontal */
  ZP_JOINT_HINGE,    /* both nodes are one, held; the upper ribbon horizontal, the lower one free to turn */
  ZP_JOINT_GUIDE,    /* free to move; horizontal */
  ZP_JOINT_FREE,     /* free to move and to turn */
  ZP_JOINT_PLATFORM, /* rigid and horizontal; the upper one is held, the lower one slides vertically */
  ZP_JOINT_SEAM,     /* horizontal; free to move along x */
  ZP_JOINT_TURNING,  /* rigid; the upper one is held and horizontal, the lower one moves and turns in the plane */
  ZP_JOINT_KINDS
} ZpJointKind;

/* Ways in which a joint acts on the nodes of its stations; [0]: on the upper or only ribbon, [1]: on the lower one. */
typedef struct ZpJointWay {
  bool level[2];   /* the ribbon stays horizontal there */
  bool held[2][2]; /* x and y are held; other ones move with those of the first station */
  bool unites;     /* upper and lower node are one */
  bool turns;      /* nodes that are not held keep only their distance */
} ZpJointWay;
extern const ZpJointWay zp_joint_way[ZP_JOINT_KINDS];

/* One body holds the stations first .. last. */
typedef struct ZpJoint {
  ZpJointKind kind;
  size_t first, last;
} ZpJoint;

enum { ZP_MOST_JOINTS = 3 };

typedef struct ZpTopology {
  size_t ribbons;  /* 1 or 2 */
  size_t stations; /* of each ribbon */
  size_t nodes;    /* of all */
  size_t joints;
  ZpJoint joint[ZP_MOST_JOINTS];
  ZpJoint platform; /* the one that the load hangs on; of one ribbon and of a hinge the right end. Of a half, a half of
                       the platform */
  bool along;       /* the load pulls along the ribbon, to the right, instead of down */
} ZpTopology;

/* Views of coordinates of all nodes, or of velocities. Those of a node are at zp_upper and zp_lower of its station. */
typedef struct ZpNodes {
  const double *x, *y;
} ZpNodes;

/* (def) => its topology. */
ZpTopology zp_topology_of(const ZpActuatorDef *def);

/* In words, why no model can have this topology; NULL: it can. Devices lay it out, so this is a fault of a device. */
const char *zp_topology_fault(const ZpTopology *topology);

/* Does what is at this station, if anything, keep this ribbon horizontal? */
bool zp_topology_holds_slope(const ZpTopology *topology, size_t station, size_t ribbon);

/* Elements beside a clip, a clamp, a guide, a platform, which keeps ribbons first .. last horizontal. */
ZpLevelEnds zp_topology_level_ends(const ZpTopology *topology, size_t first, size_t last);

/* The station, or element (by its left station), of the left half that mirrors this one; itself if it is there. */
size_t zp_topology_station_image(const ZpTopology *topology, size_t station);
size_t zp_topology_element_image(const ZpTopology *topology, size_t element);

/* Nodes of a station; of one ribbon both are the only one. */
static inline size_t zp_upper(const ZpTopology *t, size_t station) {
  return t->ribbons * station;
}

static inline size_t zp_lower(const ZpTopology *t, size_t station) {
  return t->ribbons * station + t->ribbons - 1;
}

/* Coordinates of a node. */
static inline size_t zp_x_of(size_t node) {
  return 2 * node;
}

static inline size_t zp_y_of(size_t node) {
  return 2 * node + 1;
}

enum { ZP_PLANE_AXES = 2, ZP_SPACE_AXES = 4 };

/* Axes of a node, in the order in which arrays hold them. */
enum { ZP_AXIS_Z = 2, ZP_AXIS_ROLL = 3 };

/* Coordinate of a node along an axis: x (0), y (1), in space z and the angle of the edge to the right. */
static inline size_t zp_coordinate_of(size_t nodes, size_t node, size_t axis) {
  return 2 * node + axis % 2 + (axis < 2 ? 0 : 2 * nodes);
}

/* Where coordinate k stands in arrays that hold all x, then all y, all z and all angles, `stride` apart. */
static inline size_t zp_place_of(size_t k, size_t nodes, size_t stride) {
  const size_t behind = k < 2 * nodes ? 0 : 2;
  return (k - behind * nodes) / 2 + (behind + k % 2) * stride;
}

static inline bool zp_is_pair(const ZpTopology *t) {
  return t->ribbons == 2;
}

/* (heights of nodes of two ribbons) => by how much the upper one is above the lower one at a station. */
static inline double zp_gap_of(const ZpTopology *t, const double *y, size_t station) {
  return y[zp_upper(t, station)] - y[zp_lower(t, station)];
}

/* (rates of nodes along y) => how fast the gap of a station grows. A counter electrode stands still. */
static inline double zp_parting(const ZpTopology *t, const double *v, size_t station) {
  return zp_is_pair(t) ? zp_gap_of(t, v, station) : -v[zp_lower(t, station)];
}

/* Two ribbons on a hinge? It is the left end, and their right ends are free. */
static inline bool zp_is_hinge(const ZpTopology *t) {
  return t->joint[0].kind == ZP_JOINT_HINGE;
}

/* Has a ribbon a free end? It is the right one. */
static inline bool zp_ends_free(const ZpTopology *t) {
  return t->platform.kind == ZP_JOINT_FREE;
}

/* Two ribbons whose right ends are free? */
static inline bool zp_is_open_pair(const ZpTopology *t) {
  return zp_is_pair(t) && zp_ends_free(t);
}

/* May the lower platform turn? Then its two ends are nodes of their own. */
static inline bool zp_platform_turns(const ZpTopology *t) {
  return t->platform.kind == ZP_JOINT_TURNING;
}

/* Is there a rigid platform between the ribbons? */
static inline bool zp_has_platform(const ZpTopology *t) {
  return t->platform.kind == ZP_JOINT_PLATFORM || zp_platform_turns(t);
}

/* Is there an angle to tell of: of a fold, or of a platform that turns? */
static inline bool zp_has_angle(const ZpTopology *t) {
  return zp_is_hinge(t) || zp_platform_turns(t);
}

/* Does a clip join the ribbons at a station? The platform is no end of a whole actuator, and the right one of a half.
 */
static inline bool zp_is_clip(const ZpTopology *t, size_t station) {
  return zp_has_platform(t) && (station == 0 || (station == t->stations - 1 && station > t->platform.last));
}

/* The nodes that the load hangs on. Where there are two and the platform does not turn, one tells of both. */
static inline size_t zp_load_node(const ZpTopology *t) {
  return zp_lower(t, t->platform.first);
}

/* The node that holds the whole: of the upper platform, or of the left end. */
static inline size_t zp_top_node(const ZpTopology *t) {
  return zp_upper(t, zp_has_platform(t) ? t->platform.first : 0);
}

/* How many halves are modelled, each with an end of ribbons on which the load hangs: 2 from clip to clip, else 1. */
static inline size_t zp_halves(const ZpTopology *t) {
  return t->platform.last - t->platform.first + 1;
}

/* (one coordinate of all nodes) => that of the middle of the lower platform, or of the right end. */
static inline double zp_platform_middle(const ZpTopology *t, const double *q) {
  return 0.5 * (q[zp_lower(t, t->platform.first)] + q[zp_lower(t, t->platform.last)]);
}

/* (x and y of all nodes) => rad: with a hinge the angle between the straight lines from it to both right ends, positive
 * where the lower one is below; of a platform that turns its own, anticlockwise; NAN without either. */
double zp_topology_angle(const ZpTopology *topology, const double *x, const double *y);

/* The first station whose nodes no joint unites: that after a clip. */
static inline size_t zp_first_apart(const ZpTopology *t) {
  return t->platform.first > 0;
}

/* Elements of a ribbon from its left end to the platform, or to its right end; none of a plate, which is all
 * platform. */
static inline size_t zp_half_elements(const ZpTopology *t) {
  return t->platform.first;
}

/* The coordinate of a node along which the load pulls. */
static inline size_t zp_pulled(const ZpTopology *t, size_t node) {
  return t->along ? zp_x_of(node) : zp_y_of(node);
}

/* 1 where that coordinate grows against the load, -1 where it grows with it. */
static inline double zp_rises(const ZpTopology *t) {
  return t->along ? -1 : 1;
}

/* How far a node is lifted against the load, m. */
static inline double zp_lifted(const ZpTopology *t, ZpNodes n, size_t node) {
  return zp_rises(t) * (t->along ? n.x[node] : n.y[node]);
}

/* How far the lower platform or the right end is from the clip, the hinge, the left end or the upper one of two plates
 * in the direction in which the load pulls, m. */
static inline double zp_hangs_by(const ZpTopology *t, ZpNodes n) {
  return t->along ? zp_platform_middle(t, n.x) - n.x[zp_upper(t, 0)] : n.y[zp_upper(t, 0)] - zp_platform_middle(t, n.y);
}

/* Distance of the platforms' faces, of a hinge that of the faces at the right ends, m; NAN for one ribbon. */
static inline double zp_opening(const ZpTopology *t, const double *y) {
  return zp_is_pair(t) ? y[zp_upper(t, t->platform.first)] - zp_platform_middle(t, y) : NAN;
}

/* How far its lower end is below its upper one, which bodies of a network hold, m: its opening; of ribbons without a
 * platform as the load hangs. */
static inline double zp_reach(const ZpTopology *t, ZpNodes n) {
  return zp_has_platform(t) ? zp_opening(t, n.y) : zp_hangs_by(t, n);
}

#endif
