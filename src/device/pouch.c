/* A pouch, Peano-HASEL: two films sealed at both ends around a fixed volume of liquid. The films mirror each other; the
 * upper one is modelled, over the middle plane, with its left end at the top and the load at its right end. Section
 * 40. */
#include <math.h>

#include "device/device.h"

static void lay(const ZpActuatorDef *def, ZpTopology *t) {
  t->stations = (size_t)def->mesh.nodes;
  t->along = true;
  zp_join(t, ZP_JOINT_CLAMP, 0, 0);
  zp_join(t, ZP_JOINT_SEAM, t->stations - 1, t->stations - 1);
  t->platform = t->joint[1];
}

/* A polyester film of 18 um, which is its own insulator, and an ester. */
static const ZpAssignment given[] = {{ZP_KEY(ribbon.length), 20e-3},
                                     {ZP_KEY(ribbon.width), 50e-3},
                                     {ZP_KEY(ribbon.thickness), 18e-6},
                                     {ZP_KEY(ribbon.young_modulus), 4e9},
                                     {ZP_KEY(ribbon.poisson_ratio), 0.38},
                                     {ZP_KEY(ribbon.density), 1390},
                                     {ZP_KEY(ribbon.yield_stress), 100e6},
                                     {ZP_KEY(insulator.thickness), NAN},
                                     {ZP_KEY(insulator.permittivity), 3.3},
                                     {ZP_KEY(insulator.breakdown_field), 300e6},
                                     {ZP_KEY(electro.breakdown_cap), 0},
                                     {ZP_KEY(mesh.nodes), 401},
                                     {ZP_KEY(liquid.model), ZP_LIQUID_SUBMERGED},
                                     {ZP_KEY(liquid.lateral_flow), 0},
                                     {ZP_KEY(drive.voltage), 6e3},
                                     {ZP_KEY(load.mass), 0.2}};

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(pouch.electrode_length, pouch.count), ZP_HAS(POUCH),
            "the other kinds have no pouch"),
    ZP_RULE(PHYSICS, ZP_SET(isometric.strain), ZP_HAS(POUCH), "the other kinds are held at isometric.separation"),
    ZP_RULE(PHYSICS, ZP_HAS(POUCH), ZP_NOT(initial.state, ZP_INITIAL_STRAIGHT), "straight films enclose no liquid"),
    ZP_RULE(PHYSICS, ZP_HAS(POUCH), ZP_IS(liquid.lateral_flow, false), "a pouch is sealed at its sides"),
    ZP_RULE(NOT_MODELLED, ZP_HAS(POUCH), ZP_IS(electro.edges, false),
            "the liquid beside the edges of a sealed pouch is not known"),
    ZP_RULE_IF(NOT_MODELLED, ZP_HAS(POUCH), ZP_SET(load.change_mass), ZP_AT_MOST(pouch.count, 1),
               "an impact on several pouches in series sends a wave through them"),
    ZP_RULE_IF(PHYSICS, ZP_SET(isometric.strain), ZP_NETWORK, ZP_NEVER, "a body is held at isometric.separation"),
    ZP_RULE_IF(NOT_MODELLED, ZP_HAS(POUCH), ZP_NETWORK, ZP_AT_MOST(pouch.count, 1),
               "each pouch of a network is a member"),
};

const ZpDevice zp_device_pouch = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_POUCH,
                                  .touches = "seam",
                                  .lay = lay,
                                  ZP_GIVEN(given),
                                  .rules = ZP_RULES_OF(rule)};
