/* A reed: one ribbon, clamped at its left end below a flat electrode that does not move. Its right end is free and
 * hangs on a return spring (term_reed.c). In the library: src/device/reed.c. */
#include "device/device.h"

/* A reed of steel with a thin coating, 10 mm long, 50 um below its electrode; nothing hangs on it. */
static const ZpAssignment given[] = {{ZP_KEY(actuator.right_end), ZP_END_FREE},
                                     {ZP_KEY(ribbon.length), 10e-3},
                                     {ZP_KEY(ribbon.width), 2e-3},
                                     {ZP_KEY(ribbon.thickness), 50e-6},
                                     {ZP_KEY(insulator.thickness), 5e-6},
                                     {ZP_KEY(electro.gap_offset), 50e-6},
                                     {ZP_KEY(load.mass), 0},
                                     {ZP_KEY(load.share), 1},
                                     {ZP_KEY(drive.voltage), 200},
                                     {ZP_KEY(liquid.model), ZP_LIQUID_NONE}};

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ABOVE(reed.stiffness, 0), ZP_IS(actuator.kind, ZP_KIND_REED),
            "the other kinds have no return spring"),
    ZP_RULE(PHYSICS, ZP_ABOVE(reed.stiffness, 0), ZP_NOT(actuator.right_end, ZP_END_CLAMPED),
            "a clamped end moves no spring"),
};

const ZpDevice zp_device_reed = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_COUNTER,
                                 .touches = "clamp (electro.gap_offset = 0 m)",
                                 .lay = zp_lay_ribbon,
                                 ZP_GIVEN(given),
                                 .rules = ZP_RULES_OF(rule)};
