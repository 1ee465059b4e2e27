/* By how much the numbers of a result may be wrong for their mesh and their time steps: the study once more on coarser
 * meshes. docs/theory.md, section 21. */
#ifndef ZP_STUDY_ESTIMATE_H
#define ZP_STUDY_ESTIMATE_H

#include "study/studies.h"

/* (a task, what has filled its result, whether that is a motion in time, the result) => an estimated error behind the
 * numbers of the result that studies.def names, NAN where a coarser mesh has no such number. ZP_MACHINE: no memory. */
ZpStatus zp_estimate_errors(const ZpTask *task, ZpStudyRun run, bool moves, ZpResult *result, ZpError *err);

#endif
