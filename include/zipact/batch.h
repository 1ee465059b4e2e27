/* The runs of a scenario, one after the other: what the command and `reproduce` do with every scenario. Part of the io
 * library. */
#ifndef ZIPACT_BATCH_H
#define ZIPACT_BATCH_H

#include <zipact/api.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Check every Def of `scenario`. ZP_BAD_INPUT as zp_scenario_def and zp_data_check. */
ZP_API ZpStatus zp_batch_check(const ZpScenario *scenario, ZpError *err);

/* The same in `jobs` threads; 0: as many as there are processors. The first wrong case is the one that is named. */
ZP_API ZpStatus zp_batch_check_jobs(const ZpScenario *scenario, int jobs, ZpError *err);

/* A scenario at work. */
typedef struct ZpBatch {
  const ZpScenario *scenario;
  ZpResult **result; /* [done] */
  size_t count;      /* to run */
  size_t done;
  size_t numbers;   /* in all results */
  bool interrupted; /* by a hook: the last result is what was reached */
} ZpBatch;

/* Check every Def of `scenario` (zp_batch_check), which must outlive the batch, before the first is run. To be freed
 * whatever the status. */
ZP_API ZpStatus zp_batch_create(const ZpScenario *scenario, ZpBatch *batch, ZpError *err);
ZP_API void zp_batch_free(ZpBatch *batch);

/* True while there is something to run. */
ZP_API bool zp_batch_open(const ZpBatch *batch);

/* Run the next Def. `hooks` may be NULL. The results of a sweep keep their series, not their shapes. ZP_MACHINE, too,
 * when there would be no memory to write the report afterwards: what is done can be written. */
ZP_API ZpStatus zp_batch_next(ZpBatch *batch, const ZpHooks *hooks, ZpError *err);

/* True if every outcome is an answer (zp_outcome_good). */
ZP_API bool zp_batch_good(const ZpBatch *batch);

#ifdef __cplusplus
}
#endif

#endif
