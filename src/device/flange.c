/* One ribbon, clamped at its left end below a flat electrode that does not move. */
#include "device/device.h"

static const ZpAssignment given[] = {{ZP_KEY(load.share), 1}};

const ZpDevice zp_device_flange = {.has = ZP_DEVICE_ELECTRODES | ZP_DEVICE_COUNTER,
                                   .touches = "clamp (electro.gap_offset = 0 m)",
                                   .lay = zp_lay_ribbon,
                                   ZP_GIVEN(given)};
