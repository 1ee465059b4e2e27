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

const ZpDevice zp_device_plate = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_PAIR | ZP_DEVICE_PLATFORM |
                                         ZP_DEVICE_COUNTER | ZP_DEVICE_RIGID,
                                  .touches = "faces (plate.stop_gap = 0 m)",
                                  .lay = lay,
                                  ZP_GIVEN(given)};
