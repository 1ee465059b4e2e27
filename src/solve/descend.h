/* Way down from a point that is no equilibrium to a stable one, as slow motion against a resistance would go: implicit
 * steps (K + c) dq = r of c dq/dt = r, with the resistance c taken back as the motion gets slower. In the end they are
 * Newton's. Knows no physics. */
#ifndef ZP_SOLVE_DESCEND_H
#define ZP_SOLVE_DESCEND_H

#include "solve/newton.h"

/* From the present point in at most `most` steps, none longer than `longest` of the system's length, until rest or
 * until `enough` (of `user`, who knows the present point; NULL: only rest will do) is true; the present point is then
 * no equilibrium. At rest a good end is a stable one: no pivot of the stiffness is negative. */
ZpNewtonInfo zp_descend_until(const ZpStaticSystem *system, double longest, double tolerance, int most,
                              bool (*enough)(void *user), void *user, ZpNewtonWork *work);

#endif
