/* What every study asks that holds the platform at isometric.separation. */
#ifndef ZP_STUDY_HELD_H
#define ZP_STUDY_HELD_H

#include "def/def.h"

/* isometric.separation is within their reach. */
ZpStatus zp_check_held(const ZpActuatorDef *def, ZpError *err);

#endif
