/* The layout of one ribbon, which several devices have, and rules on the paper's numerics. */
#include "device/device.h"

void zp_lay_ribbon(const ZpActuatorDef *def, ZpTopology *t) {
  static const ZpJointKind right[] = {
      [ZP_END_GUIDED] = ZP_JOINT_GUIDE, [ZP_END_FREE] = ZP_JOINT_FREE, [ZP_END_CLAMPED] = ZP_JOINT_CLAMP};
  t->stations = (size_t)def->mesh.nodes;
  zp_join(t, ZP_JOINT_CLAMP, 0, 0);
  zp_join(t, right[def->actuator.right_end], t->stations - 1, t->stations - 1);
  t->platform = t->joint[1];
}

static const ZpRule rule[] = {
    ZP_RULE(EQUATION, ZP_CONDITION(actuator.kind, HAS, ZP_DEVICE_OPEN | ZP_DEVICE_POUCH),
            ZP_IS(ribbon.model, ZP_RIBBON_ROD), "the paper's springs end at a clip; use actuator.kind electro_ribbon"),
    ZP_RULE(EQUATION, ZP_CONDITION(actuator.kind, HAS, ZP_DEVICE_OPEN | ZP_DEVICE_POUCH),
            ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's Bezier surface begins at a clip; use actuator.kind electro_ribbon"),
    ZP_RULE(EQUATION, ZP_HAS(OPEN), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping begins at a clip; use actuator.kind electro_ribbon"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_LACKS(PAPERS), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of the paper's actuator and of one ribbon"),
    ZP_MOTION_RULE(EQUATION, ZP_IS(contact.model, ZP_CONTACT_SEQUENTIAL), ZP_HAS(PAPERS),
                   "the paper's zipping begins at a clip; use contact.model unilateral"),
    ZP_MOTION_RULE(EQUATION, ZP_IS(electro.surface, ZP_SURFACE_BEZIER), ZP_HAS(PAPERS),
                   "the paper's Bezier surface begins at a clip; use electro.surface polyline"),
};

static const ZpRules rules = ZP_RULES_OF(rule);
#define ZP_KIND(kind, name, help) &zp_device_##name.rules,
const ZpRules *const zp_rules_of_devices[] = {
#include <zipact/devices.def>
    &rules, NULL};
