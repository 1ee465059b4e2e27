/* The state of rest that a controller is asked to hold: stable or not, it has a given value of the controlled signal.
 */
#ifndef ZP_REST_SETPOINT_H
#define ZP_REST_SETPOINT_H

#include "rest/rest.h"

/* What is measured. */
typedef struct ZpSetpointSignal {
  ZpControlSignal kind;
  double hanging; /* opening without voltage, m, which contraction is measured by */
} ZpSetpointSignal;

/* At the present point. */
double zp_setpoint_signal(const ZpRest *rest, const ZpSetpointSignal *signal);

/* From any point to the state on the branch from the hanging one, through its limit points, where the signal is
 * `value`, to 1e-5 of the way; fills signal->hanging. False: it is nowhere, or the branch was lost. */
bool zp_setpoint_find(ZpRest *rest, ZpSetpointSignal *signal, double value);

#endif
