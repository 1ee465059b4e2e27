/* Which values of some keys are best: optimize.* of a scenario, computed by several threads and kept in a journal. Part
 * of the io library; needs NLopt and SQLite. */
#ifndef ZIPACT_OPTIMIZE_H
#define ZIPACT_OPTIMIZE_H

#include <zipact/api.h>
#include <zipact/campaign.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpOptimization ZpOptimization;

/* Look for the best values of optimize.variables. The journal in `directory`, which must be the caller's own
 * (zp_folder_open), makes it resumable as a campaign is; options->progress may stop it: then there is the best so far.
 * The same scenario gives the same cases for any number of threads. Lists are allowed for keys of optimize.variables
 * only, whose values in the scenario do not count. `scenario` and `options` must outlive *out.
 *
 * ZP_BAD_INPUT names the key and the part of its text; ZP_MACHINE as zp_campaign_run. *out is NULL on failure. */
ZP_API ZpStatus zp_optimize(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                            ZpOptimization **out, ZpError *err);

/* What was found: all cases that were computed as rows, in their order, and which of them are best. `directory`,
 * `folder`, `hooks`, `jobs` and `wall_time` are the caller's to set in a copy. Valid as long as the optimisation. */
ZP_API const ZpReport *zp_optimization_report(const ZpOptimization *optimization);

/* How far it came. */
ZP_API ZpCampaignState zp_optimization_state(const ZpOptimization *optimization);

/* Close the journal and free it; NULL is allowed. */
ZP_API void zp_optimization_destroy(ZpOptimization *optimization);

#ifdef __cplusplus
}
#endif

#endif
