/* What the materials of a simulated actuator have seen. */
#ifndef ZP_SIM_MARGINS_H
#define ZP_SIM_MARGINS_H

#include <zipact/sim.h>

#include "actuator/shape.h"

/* The worst over all rows and shapes that were recorded, thinned out or not. */
const ZpMargins *zp_sim_margins(const ZpSim *sim);

#endif
