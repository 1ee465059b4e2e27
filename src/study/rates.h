/* Derivatives of a run in time by the keys of sensitivity.by. */
#ifndef ZP_STUDY_RATES_H
#define ZP_STUDY_RATES_H

#include "run/sensitivity.h"
#include "study/studies.h"

/* Follow the derivatives of a run, which has not begun, by the keys that its definition names; nothing where it names
 * none. In any case to be closed, before the run. */
ZpStatus zp_rates_open(ZpRunSensitivity *rates, ZpSim *sim, ZpError *err);

/* A signal where a run has ended; NAN if it has not settled, or ended in a state that is none of an actuator. */
double zp_at_end(ZpSim *sim, const ZpResult *result, const char *signal);

/* Where the run has ended: add its derivatives, the numbers that they are of where the summary lacks them, and a note
 * on what has none. */
void zp_rates_add(const ZpRunSensitivity *rates, ZpResult *result);

/* (a task, what has filled its result, the result) => derivatives that the time steps do not determine are null, with a
 * note: the run once more with a larger tolerance shows which. Nothing where solver.time_step sets the steps. */
ZpStatus zp_rates_settle(const ZpTask *task, ZpStudyRun run, ZpResult *result, ZpError *err);

#endif
