/* The best values of some keys: optimize.* of a scenario, computed by several threads and kept in a journal. Part of
 * the io library; needs NLopt and SQLite. */
#ifndef ZIPACT_OPTIMIZE_H
#define ZIPACT_OPTIMIZE_H

#include <zipact/api.h>
#include <zipact/campaign.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpOptimization ZpOptimization;

/* Find the best values of optimize.variables. The journal in `directory`, which must be locked by the caller
 * (zp_folder_open), makes the search resumable like a campaign; options->progress may stop it: then the result is the
 * best case so far. The same scenario gives the same cases for any number of threads. Lists are allowed only for keys
 * of optimize.variables, whose values in the scenario are ignored. Where keys have distributions, a design has a case
 * for each sample, the same samples for all designs, and goals are numbers of the distribution of an output. `scenario`
 * and `options` must outlive *out.
 *
 * ZP_BAD_INPUT names the key and the part of its text; ZP_MACHINE as zp_campaign_run. *out is NULL on failure. */
ZP_API ZpStatus zp_optimize(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                            ZpOptimization **out, ZpError *err);

/* The result: all computed cases as rows, in order, and the best of them. The caller sets `directory`, `folder`,
 * `hooks`, `jobs` and `wall_time` in a copy. Valid as long as the optimisation. */
ZP_API const ZpReport *zp_optimization_report(const ZpOptimization *optimization);

/* Progress of the optimisation. */
ZP_API ZpCampaignState zp_optimization_state(const ZpOptimization *optimization);

/* Close the journal and free it; NULL is allowed. */
ZP_API void zp_optimization_destroy(ZpOptimization *optimization);

#ifdef __cplusplus
}
#endif

#endif
