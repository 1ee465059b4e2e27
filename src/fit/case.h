/* One case of a scenario: what a batch and a campaign do with each case. */
#ifndef ZP_FIT_CASE_H
#define ZP_FIT_CASE_H

#include <zipact/io.h>

/* Largest number of cases in a chunk. */
enum { ZP_CHUNK_MOST = 64 };

/* Number of cases in a chunk. In a study that follows (zp_study_follows) a case starts from the one before it, except
 * the first of a chunk. The number depends on the scenario alone, so results do not depend on the number of workers. */
size_t zp_case_chunk(const ZpScenario *scenario);

/* Run case `index`. `before` is the result of the preceding case, NULL for the first of a chunk; its states that only
 * this case needs are freed. In a sweep the result has a series, but no shapes and no checkpoint. */
ZpStatus zp_case_run(const ZpScenario *scenario, size_t index, ZpResult *before, const ZpHooks *hooks,
                     ZpResult **result, ZpError *err);

/* zp_case_run, except that a case with impossible input has a result that gives the reason. */
ZpStatus zp_case_run_or_say(const ZpScenario *scenario, size_t index, ZpResult *before, const ZpHooks *hooks,
                            ZpResult **result, ZpError *err);

/* A result of `study` whose message says why it has no numbers. NULL if there is no memory. */
ZpResult *zp_case_impossible(ZpStudy study, const ZpError *why);

#endif
