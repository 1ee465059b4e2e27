/* The paper's area error. */
#ifndef ZP_REPRODUCE_AREA_H
#define ZP_REPRODUCE_AREA_H

#include <zipact/study.h>

/* (chain at rest, Def of the finite elements under the same load, stroke that is published for them, m) => m2 between
 * the chain and the finite elements hung at that stroke; NAN if there is none.
 *
 * The published curves are not converged and not printed. What is taken in their place is the converged curve, with all
 * weights scaled such that it hangs at the published stroke. */
double zp_area_error(const ZpResult *chain, ZpActuatorDef elements, double stroke);

#endif
