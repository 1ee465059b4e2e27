/* The table of devices. */
#include "def/device.h"

static const ZpDevice *const devices[ZpActuatorKind_COUNT] = {
#define ZP_KIND(kind, name) [kind] = &zp_device_##name,
#include "def/devices.def"
#undef ZP_KIND
};
#define ZP_KIND(kind, name) +1
enum {
  LISTED = 0
#include "def/devices.def"
};
#undef ZP_KIND
_Static_assert(LISTED == (int)ZpActuatorKind_COUNT, "each kind of choices.def has its line");

const ZpDevice *zp_device_of(ZpActuatorKind kind) {
  return devices[kind];
}

bool zp_def_has(const ZpActuatorDef *def, unsigned bits) {
  return (zp_device_of(def->actuator.kind)->has & bits) != 0;
}
