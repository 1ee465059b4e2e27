/* A mouth: two ribbons in one clamp at their left ends; their right ends are free, and the load hangs on the lower one.
 * Section 30.1. */
#include "device/device.h"

static void lay(const ZpActuatorDef *def, ZpTopology *t) {
  t->stations = (size_t)def->mesh.nodes;
  zp_join(t, ZP_JOINT_CLAMP, 0, 0);
  zp_join(t, ZP_JOINT_FREE, t->stations - 1, t->stations - 1);
  t->platform = t->joint[1];
}

static const ZpAssignment given[] = {{ZP_KEY(load.share), 1}};

const ZpDevice zp_device_mouth = {
    .has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_PAIR | ZP_DEVICE_OPEN, .touches = "clamp", .lay = lay, ZP_GIVEN(given)};
