/* The equilibrium at a setpoint, stable or not: it has a given value of the controlled signal. */
#ifndef ZP_REST_SETPOINT_H
#define ZP_REST_SETPOINT_H

#include "rest/rest.h"

/* The measured signal. */
typedef struct ZpSetpointSignal {
  ZpControlSignal kind;
  double hanging; /* opening without voltage, m, to which contraction refers */
} ZpSetpointSignal;

/* The signal at the present point. */
double zp_setpoint_signal(const ZpRest *rest, const ZpSetpointSignal *signal);

/* From any point to the equilibrium where the signal is `value`, on the branch from the hanging state through its limit
 * points; accurate to 1e-5 of the way. Sets signal->hanging. False if there is none, or the branch was lost. */
bool zp_setpoint_find(ZpRest *rest, ZpSetpointSignal *signal, double value);

#endif
