/* The stroke from a measured capacitance, and how far from the true one it is. docs/theory.md, section 26. */
#ifndef ZP_STUDY_SENSE_H
#define ZP_STUDY_SENSE_H

#include "run/run.h"
#include "study/studies.h"

/* Is a meter asked for, on any port of the system of which this is the first member? */
bool zp_senses(const ZpModel *first);

/* From now on a simulation keeps a record for the meter of each port; false if there is no memory. To be ended in any
 * case. */
bool zp_sense_begin(ZpSim *sim);
void zp_sense_end(ZpSim *sim);

/* (sim at the end of a whole run) => numbers of the summary, columns of the series. Finds the equilibria along which
 * the capacitance determines the stroke. */
ZpStatus zp_sense(const ZpTask *task, const ZpSim *sim, ZpResult *result, ZpError *err);

#endif
