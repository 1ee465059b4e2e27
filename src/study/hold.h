/* Can a controller hold its setpoint? Small motions about the equilibrium that the setpoint determines, with the
 * controller and without it. docs/theory.md, section 28. */
#ifndef ZP_STUDY_HOLD_H
#define ZP_STUDY_HOLD_H

#include "study/studies.h"

/* Add its numbers and what they say to a result; nothing without a controller. */
ZpStatus zp_add_hold(const ZpActuatorDef *def, ZpResult *result, ZpError *err);

#endif
