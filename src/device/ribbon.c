/* A single ribbon, clamped at its left end, without electrodes. */
#include "device/device.h"

static const ZpAssignment given[] = {{ZP_KEY(load.share), 1}};

const ZpDevice zp_device_ribbon = {.has = ZP_DEVICE_PAPERS, .lay = zp_lay_ribbon, ZP_GIVEN(given)};
