/* Devices: what the kinds of actuators consist of. A device is one file of src/device/ and a row of devices.def; all
 * others ask what a device has, not which one it is. docs/theory.md, section 19. */
#ifndef ZP_DEF_DEVICE_H
#define ZP_DEF_DEVICE_H

#include "def/rule.h"

struct ZpTopology;

typedef struct ZpDevice {
  unsigned has;        /* bits ZP_DEVICE_* of def/rule.h */
  const char *touches; /* where its electrodes touch at rest: "clip"; NULL: it has none */
  /* Stations, joints, and the joint that the load hangs on; the rest is 0 before. */
  void (*lay)(const ZpActuatorDef *def, struct ZpTopology *topology);
  const ZpAssignment *given; /* its defaults, where they differ from keys.def */
  size_t given_count;
  ZpRules rules; /* combinations of keys that it refuses */
} ZpDevice;

/* Defaults of a device: an array of {ZP_KEY(load.share), 1}. */
#define ZP_GIVEN(array) .given = array, .given_count = sizeof(array) / sizeof(array)[0]

#define ZP_KIND(kind, name, help) extern const ZpDevice zp_device_##name;
#include <zipact/devices.def>

const ZpDevice *zp_device_of(ZpActuatorKind kind);

/* Has the device of this Def any of these? */
bool zp_def_has(const ZpActuatorDef *def, unsigned bits);

#endif
