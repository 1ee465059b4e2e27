/* Equilibria and limits that were found on one mesh are solved again on another one, from there. Theory, section 21. */
#ifndef ZP_REST_REFINE_H
#define ZP_REST_REFINE_H

#include "rest/limits.h"

/* From the present point of `at`, an equilibrium, to that of `other`, of the same actuator, nearby. It determines when
 * the actuator counts as closed. False if there is none nearby. */
bool zp_refine_rest(const ZpStatics *at, ZpRest *other);

/* By how much a limit is further on the mesh of `other`, V or kg: of a limit point the larger one of what the branch
 * is further by where the gap that closes last is the same, and of what its own limit point nearby is. NAN: it was not
 * found. The present points are then others. */
double zp_refine_limit(ZpRest *at, const ZpLimits *limits, ZpLimitKind kind, ZpRest *other);

#endif
