/* What every study asks that holds the platform at isometric.separation. */
#ifndef ZP_STUDY_HELD_H
#define ZP_STUDY_HELD_H

#include <zipact/def.h>

/* Two ribbons, and a separation within their reach; `study` is the word for messages. */
ZpStatus zp_check_held(const ZpActuatorDef *def, const char *study, ZpError *err);

#endif
