/* Lengths over which a ribbon bends at rest, and how many elements lie on them. */
#ifndef ZP_ACTUATOR_RESOLUTION_H
#define ZP_ACTUATOR_RESOLUTION_H

#include "actuator/model.h"

/* Length over which closed faces separate by the range of their attraction, m, eq. (9.4). INFINITY if none zip. */
double zp_front_length(const ZpModel *model, double voltage);

/* Number of elements on the shortest length over which a ribbon bends at `voltage`, V. INFINITY: there is no such
 * length. */
double zp_mesh_resolution(const ZpModel *model, double voltage);

#endif
