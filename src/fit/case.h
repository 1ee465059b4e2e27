/* One case of a scenario: what a batch and a campaign do with each. */
#ifndef ZP_FIT_CASE_H
#define ZP_FIT_CASE_H

#include <zipact/io.h>

/* Most cases of a chunk. */
enum { ZP_CHUNK_MOST = 64 };

/* Cases come in chunks of this length: those of a study that follows (zp_study_follows) start from the case before
 * them, but the first of a chunk does not. It depends on the scenario alone, so results do not depend on who runs what.
 */
size_t zp_case_chunk(const ZpScenario *scenario);

/* Run case `index`. `before` is the result of the case before it, NULL at the first of a chunk; the states that only
 * its successor needs are freed. A result of several cases has a series, but no shapes and no checkpoint. */
ZpStatus zp_case_run(const ZpScenario *scenario, size_t index, ZpResult *before, const ZpHooks *hooks,
                     ZpResult **result, ZpError *err);

/* The same, but a case whose input turns out to be impossible has a result that says why. */
ZpStatus zp_case_run_or_say(const ZpScenario *scenario, size_t index, ZpResult *before, const ZpHooks *hooks,
                            ZpResult **result, ZpError *err);

/* A result of `study` that says why there is none. NULL if there is no memory. */
ZpResult *zp_case_impossible(ZpStudy study, const ZpError *why);

#endif
