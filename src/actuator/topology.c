#include "actuator/topology.h"

#include "def/device.h"
#include "math/elementary.h"

const ZpJointWay zp_joint_way[ZP_JOINT_KINDS] = {
    [ZP_JOINT_CLIP] = {.level = {true, true}, .unites = true},
    [ZP_JOINT_CLAMP] = {.level = {true, true}, .held = {{true, true}, {true, true}}, .unites = true},
    [ZP_JOINT_HINGE] = {.level = {true, false}, .held = {{true, true}, {true, true}}, .unites = true},
    [ZP_JOINT_SEAM] = {.level = {true, true}, .held = {{false, true}, {false, true}}},
    [ZP_JOINT_GUIDE] = {.level = {true, true}},
    [ZP_JOINT_PLATFORM] = {.level = {true, true}, .held = {{true, true}, {true, false}}},
    [ZP_JOINT_TURNING] = {.level = {true, false}, .held = {{true, true}, {false, false}}, .turns = true},
};

ZpTopology zp_topology_of(const ZpActuatorDef *def) {
  ZpTopology t = {.ribbons = zp_def_has(def, ZP_DEVICE_PAIR) ? 2 : 1};
  const ZpDevice *device = zp_device_of(def->actuator.kind);
  if (device->lay) device->lay(def, &t);
  t.nodes = t.ribbons * t.stations;
  return t;
}

static bool is_joint(const ZpTopology *t, const ZpJoint *one) {
  for (const ZpJoint *joint = t->joint; joint < t->joint + t->joints; joint++)
    if (joint->kind == one->kind && joint->first == one->first && joint->last == one->last) return true;
  return false;
}

const char *zp_topology_fault(const ZpTopology *t) {
  if (t->joints == 0 || t->joint[0].first != 0 || t->joint[t->joints - 1].last != t->stations - 1)
    return "it needs a joint at the first station and one at the last, from left to right";
  if (!is_joint(t, &t->platform)) return "the load has to hang on one of its joints";
  if (!zp_has_platform(t) && t->platform.last != t->stations - 1)
    return "the load has to hang on the joint at the last station; lay out the left half of what is its own mirror "
           "image, with a guide there";
  return NULL;
}

bool zp_topology_holds_slope(const ZpTopology *t, size_t station, size_t ribbon) {
  for (const ZpJoint *joint = t->joint; joint < t->joint + t->joints; joint++)
    if (joint->first <= station && station <= joint->last) return zp_joint_way[joint->kind].level[ribbon];
  return false;
}

static void add_level(size_t element, bool right, ZpLevelEnds *ends) {
  ends->of[ends->count++] = (ZpLevelEnd){element, right};
}

ZpLevelEnds zp_topology_level_ends(const ZpTopology *t, size_t first, size_t last) {
  ZpLevelEnds ends = {0};
  for (size_t k = 0; k < t->joints; k++) {
    const ZpJoint *joint = &t->joint[k];
    const bool *level = zp_joint_way[joint->kind].level;
    if (!level[first] || !level[last]) continue;
    if (joint->first > 0) add_level(joint->first - 1, true, &ends);
    if (joint->last + 1 < t->stations) add_level(joint->last, false, &ends);
  }
  return ends;
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
