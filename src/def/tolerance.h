/* Meaning of solver.tolerance at rest; zp_def_tolerance has that in motion. */
#ifndef ZP_DEF_TOLERANCE_H
#define ZP_DEF_TOLERANCE_H

#include "def/def.h"

/* Relative error at which equilibria are solved. */
double zp_tolerance_at_rest(const ZpActuatorDef *def);

#endif
