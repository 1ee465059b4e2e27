/* The table of devices. */
#include "def/device.h"

static const ZpDevice *const devices[ZpActuatorKind_COUNT] = {
#define ZP_KIND(kind, name, help) [kind] = &zp_device_##name,
#include <zipact/devices.def>
};

const ZpDevice *zp_device_of(ZpActuatorKind kind) {
  return devices[kind];
}

bool zp_def_has(const ZpActuatorDef *def, unsigned bits) {
  return (zp_device_of(def->actuator.kind)->has & bits) != 0;
}
