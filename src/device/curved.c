/* One ribbon, clamped at its left end beside a rigid electrode that curves away from it. Section 35. */
#include "device/device.h"

/* A strip of steel on a cam, each with a tape, in oil: it zips from the clamp on, at some 250 V all the way. */
static const ZpAssignment given[] = {{ZP_KEY(actuator.right_end), ZP_END_FREE},
                                     {ZP_KEY(counter.height), 10e-3},
                                     {ZP_KEY(drive.voltage), 2e3},
                                     {ZP_KEY(electro.breakdown_cap), false},
                                     {ZP_KEY(gravity), 0},
                                     {ZP_KEY(load.mass), 0},
                                     {ZP_KEY(load.share), 1}};

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET(counter.height), ZP_HAS(SHAPED), "the other kinds have no counter electrode with a shape"),
    ZP_RULE(PHYSICS, ZP_SET(counter.power), ZP_HAS(SHAPED), "the other kinds have no counter electrode with a shape"),
};

const ZpDevice zp_device_curved = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_COUNTER | ZP_DEVICE_SHAPED,
                                   .touches = "clamp (electro.gap_offset = 0 m)",
                                   .lay = zp_lay_ribbon,
                                   ZP_GIVEN(given),
                                   .rules = ZP_RULES_OF(rule)};
