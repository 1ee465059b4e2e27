/* A run with a controller: its samples, and how the signal has answered. */
#ifndef ZP_STUDY_LOOP_H
#define ZP_STUDY_LOOP_H

#include "sim/sim_internal.h"
#include "study/studies.h"

/* From now on a simulation keeps all its samples here: its owner's; NULL if there is no memory. */
ZpTable *zp_loop_watch(ZpSim *sim);

/* (a simulation at the end of its run, its samples) => numbers and notes of the summary. */
void zp_loop_summarize(ZpSim *sim, ZpTable *samples, ZpResult *result);

#endif
