/* The area error of the paper. */
#ifndef ZP_REPRODUCE_AREA_H
#define ZP_REPRODUCE_AREA_H

#include <zipact/study.h>

/* (chain at rest, Def of the finite elements under the same load, their published stroke, m) => area between the chain
 * and the finite elements hung at that stroke, m2; NAN if there is none.
 *
 * The published curves are neither converged nor printed. The converged curve replaces them, with all weights scaled
 * such that it hangs at the published stroke. */
double zp_area_error(const ZpResult *chain, ZpActuatorDef elements, double stroke);

#endif
