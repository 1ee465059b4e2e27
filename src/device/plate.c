/* Two rigid plates, which are all platform: the upper one is held, the lower one moves up and down on the springs and
 * stops of term/spring.c. Section 37. */
#include <math.h>

#include "device/device.h"

static void lay(const ZpActuatorDef *def, ZpTopology *t) {
  (void)def;
  t->stations = 2;
  zp_join(t, ZP_JOINT_PLATFORM, 0, 1);
  t->platform = t->joint[0];
}

/* Bare silicon in air, from which gravity hardly moves it. */
static const ZpAssignment given[] = {{ZP_KEY(ribbon.length), 500e-6},
                                     {ZP_KEY(ribbon.width), 100e-6},
                                     {ZP_KEY(ribbon.thickness), 20e-6},
                                     {ZP_KEY(ribbon.density), 2330},
                                     {ZP_KEY(insulator.thickness), 0},
                                     {ZP_KEY(plate.gap), 4e-6},
                                     {ZP_KEY(plate.stop_gap), 1e-6},
                                     {ZP_KEY(medium.permittivity), 1.0006},
                                     {ZP_KEY(medium.breakdown_field), 3e6},
                                     {ZP_KEY(medium.kinematic_viscosity), 1.51e-5},
                                     {ZP_KEY(medium.density), 1.204},
                                     {ZP_KEY(medium.surface_tension), 0},
                                     {ZP_KEY(medium.mean_free_path), 6.7e-8},
                                     {ZP_KEY(load.mass), 0},
                                     {ZP_KEY(gravity), 0},
                                     {ZP_KEY(electro.breakdown_cap), false},
                                     {ZP_KEY(drive.voltage), 30},
                                     {ZP_KEY(isometric.separation), 2e-6},
                                     {ZP_KEY(solver.end_time), 1e-2}};

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(plate.gap, plate.floor_gap), ZP_HAS(RIGID), "they describe a plate and its spring"),
    ZP_RULE(PHYSICS, ZP_HAS(RIGID), ZP_IS(actuator.symmetry, ZP_SYMMETRY_HALF), "a plate has no halves"),
    ZP_RULE(NOT_MODELLED, ZP_HAS(RIGID), ZP_IS(platform.rotates, false), "plates stay parallel"),
    ZP_RULE(PHYSICS, ZP_HAS(RIGID), ZP_IS(platform.electrode, true), "without electrodes nothing attracts a plate"),
    ZP_RULE(PHYSICS, ZP_HAS(RIGID), ZP_IS(ribbon.model, ZP_RIBBON_ROD), "a plate is no chain of springs"),
    ZP_RULE(PHYSICS, ZP_HAS(RIGID), ZP_IS(ribbon.plasticity, false), "a rigid plate does not yield"),
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(segment_K.length, segment_K.curvature_lag), ZP_LACKS(RIGID),
            "a plate does not bend"),
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(lower.segment_K.length, lower.segment_K.curvature_lag), ZP_LACKS(RIGID),
            "a plate does not bend"),
    ZP_RULE(PHYSICS, ZP_HAS(RIGID), ZP_NOT(initial.state, ZP_INITIAL_STRAIGHT), "its faces would lie on each other"),
    ZP_RULE(NOT_MODELLED, ZP_HAS(RIGID), ZP_IS(electro.model, ZP_ELECTRO_PLATES),
            "the grid of the field ends in the wedge at a clip; use plates"),
    ZP_RULE(NOT_MODELLED, ZP_HAS(RIGID), ZP_NOT(liquid.model, ZP_LIQUID_BEAD),
            "a film between plates is modelled up to their edges; use liquid.model submerged or none"),
    ZP_RULE(NOT_MODELLED, ZP_IS(electro.edges, true), ZP_UNSET(plate.back_gap),
            "the field beyond the edges is that of a plate without an electrode behind it"),
};

const ZpDevice zp_device_plate = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_PAIR | ZP_DEVICE_PLATFORM |
                                         ZP_DEVICE_COUNTER | ZP_DEVICE_RIGID,
                                  .touches = "faces (plate.stop_gap = 0 m)",
                                  .lay = lay,
                                  ZP_GIVEN(given),
                                  .rules = ZP_RULES_OF(rule)};
