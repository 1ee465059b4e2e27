/* Largest stresses and fields that the materials of a simulated actuator have seen. */
#ifndef ZP_RUN_MARGINS_H
#define ZP_RUN_MARGINS_H

#include "run/info.h"

#include "actuator/shape.h"

/* From now on the worst counts: of every implicit step that is taken, and of every row that is recorded, thinned out or
 * not. Explicit steps are shorter than what a material sees changes in, and hardly dearer than a look at it. */
void zp_sim_watch(ZpSim *sim);

/* The present state counts, if any does. */
void zp_sim_see(ZpSim *sim);

/* The worst since zp_sim_watch. */
ZpMargins zp_sim_margins(const ZpSim *sim);

#endif
