/* What solver.tolerance means. */
#ifndef ZP_DEF_TOLERANCE_H
#define ZP_DEF_TOLERANCE_H

#include <zipact/def.h>

/* Relative error at which the time steps of a motion aim; eq. (18.13) if it is auto. */
double zp_tolerance_in_motion(const ZpActuatorDef *def);

/* Relative error at which equilibria are solved. */
double zp_tolerance_at_rest(const ZpActuatorDef *def);

#endif
