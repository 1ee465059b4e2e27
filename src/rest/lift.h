/* The largest load that a voltage lifts, by its definition: the largest under which a voltage that rises from 0 closes
 * the actuator at most at this voltage. Theory, section 10.
 *
 * A candidate is the answer only if the voltage that rises under this load closes the actuator there, and does not
 * close it under larger loads. If it closes elsewhere, its limit leads to the next candidate. */
#ifndef ZP_REST_LIFT_H
#define ZP_REST_LIFT_H

#include "rest/slow.h"

typedef struct ZpLift {
  ZpSlow *slow;
  double top;         /* the voltage, V */
  double *hung;       /* state that hangs without voltage under the last load */
  double *lifted;     /* closed state to which it last fell at the voltage */
  ZpLimit at;         /* where the voltage closes it under that load */
  double least, most; /* loads; it closes under the former, but not under the latter; 0 and INFINITY: not known, kg */
  double at_least, at_most; /* voltages that close it under these, V; NAN: not known */
} ZpLift;

void zp_lift_carve(ZpLift *lift, ZpSlow *slow, const ZpRest *rest, ZpCarver *carver);

/* States in the caller's memory; `hung` hangs under any load. */
void zp_lift_start(ZpLift *lift, double top, double *hung, double *lifted);

/* Does the voltage asked for close it under this load? At most at `voltage`, V, or at least there; NAN: not known. */
void zp_lift_narrow(ZpLift *lift, double load, bool closes, double voltage);

/* Hang without voltage under this load, kg; from then on the actuator counts as closed as under this load. False if it
 * does not hang. */
bool zp_lift_hang(ZpLift *lift, double load);

/* Raise the voltage to the one asked for under this load. ZP_SLOW_ARRIVED if the actuator then hangs. */
ZpSlowEnd zp_lift_hang_at_top(ZpLift *lift, double load);

/* From the present point, at the voltage, to the load at which the actuator closes gradually, by the gap at which it
 * counts as closed under this load, about `closed`, m. False if there is none nearby. */
bool zp_lift_event(ZpLift *lift, double closed);

/* Does the voltage close the actuator gradually under this load, without a limit point before? */
bool zp_lift_closes_gradually(ZpLift *lift, double load);

/* From the present point, at the voltage under a large load, lower the load => its first limit, a candidate, if there
 * is one */
void zp_lift_drop(ZpLift *lift, ZpLimit *limit);

/* From a candidate, if there is one, to the largest load. True if its limit is the first that the voltage meets. */
bool zp_lift_settle(ZpLift *lift, ZpLimit *limit);

#endif
