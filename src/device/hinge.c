/* A fold: two ribbons on a hinge, which clamps the upper one; their right ends are free. Section 30. */
#include "device/device.h"

static void lay(const ZpActuatorDef *def, ZpTopology *t) {
  t->stations = (size_t)def->mesh.nodes;
  zp_join(t, ZP_JOINT_HINGE, 0, 0);
  zp_join(t, ZP_JOINT_FREE, t->stations - 1, t->stations - 1);
  t->platform = t->joint[1];
}

static const ZpAssignment given[] = {{ZP_KEY(load.share), 1}};

const ZpDevice zp_device_hinge = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_PAIR | ZP_DEVICE_OPEN | ZP_DEVICE_HINGE,
                                  .touches = "hinge",
                                  .lay = lay,
                                  ZP_GIVEN(given)};
