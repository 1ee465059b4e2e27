/* Two ribbons from the left clip to the platform and, of a whole actuator, on to the right clip. */
#include "device/device.h"

static void lay(const ZpActuatorDef *def, ZpTopology *t) {
  ZpHeldClip held = def->actuator.held_clip;
  size_t nodes = (size_t)def->mesh.nodes, halves = def->actuator.symmetry == ZP_SYMMETRY_NONE ? 2 : 1;
  t->stations = halves * nodes;
  zp_join(t, held == ZP_HELD_LEFT ? ZP_JOINT_CLAMP : ZP_JOINT_CLIP, 0, 0);
  zp_join(t, def->platform.rotates ? ZP_JOINT_TURNING : ZP_JOINT_PLATFORM, nodes - 1, nodes + halves - 2);
  t->platform = t->joint[1];
  if (halves == 2) zp_join(t, held == ZP_HELD_RIGHT ? ZP_JOINT_CLAMP : ZP_JOINT_CLIP, t->stations - 1, t->stations - 1);
}

static const ZpRule rule[] = {
    /* halves */
    ZP_RULE(PHYSICS, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_HAS(PLATFORM),
            "the other kinds have no halves; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the paper's equations are those of one half; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's Bezier surface is that of one half; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping has the order of one half; use actuator.symmetry half"),
    ZP_RULE(NOT_MODELLED, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(electro.model, ZP_ELECTRO_PLATES),
            "the grid of the field covers one half; use actuator.symmetry half"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE),
                   ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of one half; use actuator.symmetry half"),
    ZP_RULE(PHYSICS, ZP_ABOVE(clip.mass, 0), ZP_HAS(PLATFORM), "the other kinds have no clips"),
    ZP_RULE(PHYSICS, ZP_ABOVE(platform.mass, 0), ZP_HAS(PLATFORM),
            "the other kinds have no platform; use load.mass for what hangs on the end"),
    /* a platform that turns */
    ZP_RULE(PHYSICS, ZP_IS(platform.rotates, true), ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE),
            "the platform of a symmetric half is level"),
    ZP_RULE(PHYSICS, ZP_IS(platform.rotates, true), ZP_ABOVE(platform.length, 0),
            "a platform without length has no angle"),
    ZP_RULE(NOT_MODELLED, ZP_IS(platform.rotates, true), ZP_IS(platform.electrode, false),
            "the attraction of platforms is modelled for level ones only"),
    ZP_RULE(NOT_MODELLED, ZP_IS(platform.rotates, true), ZP_IS(liquid.model, ZP_LIQUID_NONE),
            "the liquid between the platforms is modelled for level ones only"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_IS(platform.rotates, true), ZP_IS(load.change_mass, 0),
                   "an impact is modelled on a level platform"),
    /* what a platform that turns makes possible */
    ZP_RULE(PHYSICS, ZP_NOT(actuator.held_clip, ZP_HELD_NONE), ZP_IS(platform.rotates, true),
            "between a held clip and a guided platform the ribbons could only stretch"),
    ZP_RULE(PHYSICS, ZP_SET(load.offset), ZP_IS(platform.rotates, true),
            "on a guided platform the place of the load has no effect"),
};

const ZpDevice zp_device_electro_ribbon = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_PAIR | ZP_DEVICE_PLATFORM |
                                                  ZP_DEVICE_PAPERS,
                                           .touches = "clip",
                                           .lay = lay,
                                           .rules = ZP_RULES_OF(rule)};
