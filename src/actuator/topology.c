#include "actuator/topology.h"

#include "def/device.h"
#include "math/elementary.h"

/* The constraints of a joint on the nodes of its stations. */
typedef struct Hold {
  bool unites;   /* upper and lower node are one */
  bool x[2];     /* held: of the upper or only ribbon, of the lower one */
  bool y[2];     /* the same */
  bool slope[2]; /* horizontal */
  bool turns;    /* coordinates that are not held are free: only the length between them is kept */
} Hold;

static const Hold hold_of[ZP_JOINT_KINDS] = {
    [ZP_JOINT_CLIP] = {.unites = true, .slope = {true, true}},
    [ZP_JOINT_HELD] = {.unites = true, .x = {true, true}, .y = {true, true}, .slope = {true, true}},
    [ZP_JOINT_CLAMP] = {.x = {true, true}, .y = {true, true}, .slope = {true, true}},
    [ZP_JOINT_HINGE] = {.unites = true, .x = {true, true}, .y = {true, true}, .slope = {true, false}},
    [ZP_JOINT_GUIDE] = {.slope = {true, true}},
    [ZP_JOINT_FREE] = {0},
    [ZP_JOINT_PLATFORM] = {.x = {true, true}, .y = {true, false}, .slope = {true, true}},
    [ZP_JOINT_TURNING] = {.x = {true, false}, .y = {true, false}, .slope = {true, false}, .turns = true},
    [ZP_JOINT_LINK] = {.x = {true, true}, .slope = {true, true}},
};

ZpTopology zp_topology_of(const ZpActuatorDef *def) {
  ZpTopology t = {.ribbons = zp_def_has(def, ZP_DEVICE_PAIR) ? 2 : 1, .halves = 1};
  zp_device_of(def->actuator.kind)->lay(def, &t);
  t.nodes = t.ribbons * t.stations;
  return t;
}

void zp_topology_hang(ZpTopology *t) {
  for (size_t k = 0; k < t->joints; k++)
    if (t->joint[k].kind == ZP_JOINT_PLATFORM) t->joint[k].kind = ZP_JOINT_LINK;
  t->platform.kind = ZP_JOINT_LINK;
}

/* The joint that holds a station; NULL if none does. */
static const ZpJoint *joint_at(const ZpTopology *t, size_t station) {
  for (size_t k = 0; k < t->joints; k++)
    if (t->joint[k].first <= station && station <= t->joint[k].last) return &t->joint[k];
  return NULL;
}

bool zp_topology_is_held(const ZpTopology *t, size_t k) {
  const ZpJoint *joint = joint_at(t, k / 2 / t->ribbons);
  if (!joint) return false;
  const Hold *hold = &hold_of[joint->kind];
  const bool *held = k % 2 == 1 ? hold->y : hold->x;
  return held[k / 2 % t->ribbons];
}

size_t zp_topology_leader(const ZpTopology *t, size_t k) {
  const ZpJoint *joint = joint_at(t, k / 2 / t->ribbons);
  if (!joint || hold_of[joint->kind].turns) return k;
  size_t ribbon = hold_of[joint->kind].unites ? 0 : k / 2 % t->ribbons;
  return 2 * (t->ribbons * joint->first + ribbon) + k % 2;
}

bool zp_topology_holds_slope(const ZpTopology *t, size_t station, size_t ribbon) {
  const ZpJoint *joint = joint_at(t, station);
  return joint && hold_of[joint->kind].slope[ribbon];
}

static void add_level(size_t element, bool right, ZpLevelEnds *ends) {
  ends->of[ends->count++] = (ZpLevelEnd){element, right};
}

/* Elements beside joints that keep ribbons first .. last horizontal. */
static ZpLevelEnds level_beside(const ZpTopology *t, size_t first, size_t last) {
  ZpLevelEnds ends = {0};
  for (size_t k = 0; k < t->joints; k++) {
    const ZpJoint *joint = &t->joint[k];
    const bool *slope = hold_of[joint->kind].slope;
    if (!slope[first] || !slope[last]) continue;
    if (joint->first > 0) add_level(joint->first - 1, true, &ends);
    if (joint->last + 1 < t->stations) add_level(joint->last, false, &ends);
  }
  return ends;
}

ZpLevelEnds zp_topology_level_ends(const ZpTopology *t, size_t ribbon) {
  return level_beside(t, ribbon, ribbon);
}

ZpLevelEnds zp_topology_level_faces(const ZpTopology *t) {
  return level_beside(t, 0, t->ribbons - 1);
}

/* Direction of the line from node `from` to node `to`, rad. */
static double direction(const double *x, const double *y, size_t from, size_t to) {
  return zp_angle(y[to] - y[from], x[to] - x[from]);
}

double zp_topology_angle(const ZpTopology *t, const double *x, const double *y) {
  size_t last = t->stations - 1;
  if (zp_platform_turns(t)) return direction(x, y, zp_lower(t, t->platform.first), zp_lower(t, t->platform.last));
  if (!zp_is_hinge(t)) return NAN;
  return direction(x, y, zp_upper(t, 0), zp_upper(t, last)) - direction(x, y, zp_lower(t, 0), zp_lower(t, last));
}

size_t zp_topology_station_image(const ZpTopology *t, size_t station) {
  return station <= t->platform.first ? station : t->stations - 1 - station;
}

size_t zp_topology_element_image(const ZpTopology *t, size_t element) {
  return element < t->platform.first ? element : t->stations - 2 - element;
}
