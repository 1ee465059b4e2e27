/* The two functions of each study, which its file defines: zp_check_WORD says what it asks of a Def that zp_def_check
 * has passed, zp_study_WORD fills a result. */
#ifndef ZP_STUDY_STUDIES_H
#define ZP_STUDY_STUDIES_H

#include <zipact/study.h>

#include "rest/statics.h"

/* What a study is given. */
typedef struct ZpTask {
  const ZpActuatorDef *def; /* checked */
  ZpStudyInput input;
  const ZpHooks *hooks; /* may be NULL */
} ZpTask;

/* Tell the caller how far the study is. => Is it to stop? */
bool zp_task_stops(const ZpTask *task, const char *stage, double fraction);

/* Let a hanging equilibrium that is looked for ask so. `task` must outlive it. */
void zp_task_watches(const ZpTask *task, ZpStatics *statics);

/* Does a result have a number of this name? It may be null. */
bool zp_result_has(const ZpResult *result, const char *name);

/* What fills a result: a zp_study_WORD. */
typedef ZpStatus (*ZpStudyRun)(const ZpTask *task, ZpResult *result, ZpError *err);

/* The zip time of study actuate and nothing else, in less time: no rows and no shapes, and energy does not balance. */
ZpStatus zp_study_zip_time(const ZpTask *task, ZpResult *result, ZpError *err);

#define ZP_STUDY(enumerator, word, shows, files, help)                                                                 \
  ZpStatus zp_check_##word(const ZpActuatorDef *def, ZpError *err);                                                    \
  ZpStatus zp_study_##word(const ZpTask *task, ZpResult *result, ZpError *err);
#include <zipact/studies.def>

#endif
