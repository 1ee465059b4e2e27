/* The layouts that files of devices build from. */
#ifndef ZP_DEVICE_DEVICE_H
#define ZP_DEVICE_DEVICE_H

#include "actuator/topology.h"
#include "def/device.h"

/* One body holds the stations first .. last from now on. */
static inline void zp_join(ZpTopology *t, ZpJointKind kind, size_t first, size_t last) {
  t->joint[t->joints++] = (ZpJoint){kind, first, last};
}

/* The layout of one ribbon, clamped at its left end, whose right end is as actuator.right_end says. The load hangs
 * there. */
void zp_lay_ribbon(const ZpActuatorDef *def, ZpTopology *t);

#endif
