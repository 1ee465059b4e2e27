/* One case of a scenario: what a batch and a campaign do with each case. */
#ifndef ZP_FIT_CASE_H
#define ZP_FIT_CASE_H

#include <zipact/io.h>

/* Largest number of cases in a chunk; chunks in a block. */
enum { ZP_CHUNK_MOST = 64, ZP_BLOCK_CHUNKS = 16 };

/* Number of cases in a chunk. In a study that follows (zp_study_follows) cases start from others of their chunk, and
 * the first of a chunk from that of another one of its block. The number depends on the scenario alone, so results do
 * not depend on the number of workers. */
size_t zp_case_chunk(const ZpScenario *scenario);

/* The case from which case `index` starts: the one before it along the list that varies fastest of those in which it is
 * not the first. If that one is in another chunk: the first of its own chunk, or if it is the first itself, the first
 * of that other chunk. Itself if it starts from scratch, as does the first of a block. */
size_t zp_case_neighbour(const ZpScenario *scenario, size_t index);

/* The last of cases from .. to - 1 that start from each of them => last [to - from]; a case from which none starts
 * itself. `from` is the first of a chunk. */
void zp_case_last(const ZpScenario *scenario, size_t from, size_t to, size_t *last);

/* Run case `index` from the result of its neighbour (NULL: from scratch). In a sweep the result has a series, but no
 * shapes and no checkpoint. */
ZpStatus zp_case_run(const ZpScenario *scenario, size_t index, const ZpResult *neighbour, const ZpHooks *hooks,
                     ZpResult **result, ZpError *err);

/* zp_case_run, except that a case with impossible input has a result that gives the reason. */
ZpStatus zp_case_run_or_say(const ZpScenario *scenario, size_t index, const ZpResult *neighbour, const ZpHooks *hooks,
                            ZpResult **result, ZpError *err);

/* A result of `study` whose message says why it has no numbers. NULL if there is no memory. */
ZpResult *zp_case_impossible(ZpStudy study, const ZpError *why);

#endif
