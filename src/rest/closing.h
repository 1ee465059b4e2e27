/* The gap by which an actuator at rest counts as closed, as an event for solve/march.h; and the actuator along the
 * square of the voltage. */
#ifndef ZP_REST_CLOSING_H
#define ZP_REST_CLOSING_H

#include "rest/statics.h"
#include "solve/march.h"

/* Distance between the faces that close last, m: at the platform or the right end; between two clamps in the middle. Of
 * the last residual. `self` is a ZpStatics; row [n] gets the derivative by the coordinates (NULL: not needed). */
double zp_closing_gap(void *self, double *row);

/* At the present point all hang without a voltage => the gap at which the first member counts as closed, m; those of
 * the others are kept in the members. */
double zp_mark_closed(ZpStatics *statics);

/* The sum of these gaps of members in series, m; else that of the first member. */
double zp_open_gap(const ZpStatics *statics);

/* How many members count as closed? */
size_t zp_closed_members(const ZpStatics *statics);

/* The static system along the square of the voltage (V^2), because forces are proportional to it: along the voltage
 * itself nothing moves at first. */
ZpBranchSystem zp_closing_by_square(ZpStatics *statics);

#endif
