/* The stroke from a measured capacitance, and how far from the true one it is. docs/theory.md, section 26. */
#ifndef ZP_STUDY_SENSE_H
#define ZP_STUDY_SENSE_H

#include "run/run.h"
#include "study/studies.h"

/* Is a meter asked for? */
bool zp_senses(const ZpActuatorDef *def);

/* Record that a simulation keeps for the meter, from its start on; NULL if there is no memory. */
ZpTable *zp_sense_trace(void);

/* (trace of a whole run, sim at its end) => numbers of the summary, columns of the series. Finds the
 * equilibria along which the capacitance determines the stroke. */
ZpStatus zp_sense(const ZpTask *task, const ZpModel *model, const ZpTable *trace, ZpResult *result, ZpError *err);

#endif
