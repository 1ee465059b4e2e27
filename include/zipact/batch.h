/* The runs of a scenario, one after the other. Part of the io library. */
#ifndef ZIPACT_BATCH_H
#define ZIPACT_BATCH_H

#include <zipact/api.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Check every Def of `scenario`. ZP_BAD_INPUT as zp_scenario_def and zp_data_check. */
ZP_API ZpStatus zp_batch_check(const ZpScenario *scenario, ZpError *err);

/* zp_batch_check in `jobs` threads; 0: as many as there are processors. The error is that of the first wrong case. */
ZP_API ZpStatus zp_batch_check_jobs(const ZpScenario *scenario, int jobs, ZpError *err);

/* The runs of a scenario. */
typedef struct ZpBatch {
  const ZpScenario *scenario;
  ZpResult **result; /* [done] */
  size_t count;      /* to run */
  size_t done;
  size_t numbers;   /* in all results */
  bool interrupted; /* a hook stopped the last run, whose result ends there */
} ZpBatch;

/* Check every Def of `scenario` (zp_batch_check), which must outlive the batch, before the first run. To be freed
 * whatever the status is. */
ZP_API ZpStatus zp_batch_create(const ZpScenario *scenario, ZpBatch *batch, ZpError *err);
ZP_API void zp_batch_free(ZpBatch *batch);

/* Are there more runs? */
ZP_API bool zp_batch_open(const ZpBatch *batch);

/* Run the next Def. `hooks` may be NULL. The results of a sweep keep their series, but not their shapes. ZP_MACHINE
 * also if there would be no memory to write the report afterwards; the finished results can be written. */
ZP_API ZpStatus zp_batch_next(ZpBatch *batch, const ZpHooks *hooks, ZpError *err);

/* Did every run succeed (zp_outcome_good)? */
ZP_API bool zp_batch_good(const ZpBatch *batch);

#ifdef __cplusplus
}
#endif

#endif
