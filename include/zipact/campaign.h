/* A campaign: the cases of a scenario, computed by several threads and kept in a journal, so that it can be resumed
 * after whatever ended it. Part of the io library; needs SQLite. */
#ifndef ZIPACT_CAMPAIGN_H
#define ZIPACT_CAMPAIGN_H

#include <zipact/api.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpCampaign ZpCampaign;

/* How far a campaign is. */
typedef struct ZpCampaignState {
  size_t cases;    /* of the scenario */
  size_t done;     /* cases that have a row, those of an earlier process included */
  size_t resumed;  /* of these, those of an earlier process */
  size_t failed;   /* of those done, how many have no answer (zp_outcome_good) */
  double fraction; /* of all cases, with what has been computed of those that run now, 0 .. 1 */
} ZpCampaignState;

/* How it is run. */
typedef struct ZpCampaignOptions {
  int jobs;    /* threads that compute, 1 or more; 0: as many as there are processors. Results do not depend on it */
  bool resume; /* keep the rows of the journal that is there; else it is replaced, if its campaign is finished */
  void *user;  /* handed to the functions below */
  /* Called some times a second, by the thread that runs the campaign; true stops it. May be NULL. */
  bool (*progress)(void *user, const ZpCampaignState *state);
  double (*clock)(void *user); /* wall clock in s; called by all threads. NULL: wall times are NAN */
  /* Have cases from .. to - 1 computed by process `worker`, below `jobs`, by zp_campaign_compute there => what that has
   * written, to be freed; *byte NULL: that process is lost, and others take its cases. Called by a thread per worker.
   * NULL: threads of this process compute. */
  ZpStatus (*remote)(void *remote_user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                     ZpError *err);
  void *remote_user; /* handed to it */
} ZpCampaignOptions;

/* Compute cases from .. to - 1 of `scenario`, one after the other, for a campaign of another process (`remote`) =>
 * bytes that this reads, to be freed. `from` must be where a call of `remote` says. `hooks` may be NULL. */
ZP_API ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                                    unsigned char **byte, size_t *size, ZpError *err);

/* Open DIRECTORY/journal.sqlite for `scenario`, which must have passed zp_batch_check and outlive the campaign.
 * `directory` must exist and be the caller's own (zp_folder_open). ZP_BAD_INPUT if `resume` finds a file that is no
 * journal, or a campaign without `resume` finds the journal of an unfinished one; ZP_MACHINE if it cannot be written.
 * *out is NULL on failure. */
ZP_API ZpStatus zp_campaign_open(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                                 ZpCampaign **out, ZpError *err);

/* Compute the cases that have no row of the same case and version yet. Rows are on the disk within a second. A case
 * whose solver fails, or whose input turns out to be impossible, is a row with its outcome. ZP_MACHINE if the machine
 * fails: rows are kept. */
ZP_API ZpStatus zp_campaign_run(ZpCampaign *campaign, ZpError *err);

/* How far it is. */
ZP_API ZpCampaignState zp_campaign_state(const ZpCampaign *campaign);

/* How many of the first cases have rows without a gap: those that a report shows. */
ZP_API size_t zp_campaign_count(const ZpCampaign *campaign);

/* The rows, for ZpReport; valid as long as the campaign. */
ZP_API const ZpRows *zp_campaign_rows(const ZpCampaign *campaign);

/* Close the journal; NULL is allowed. */
ZP_API void zp_campaign_close(ZpCampaign *campaign);

#ifdef __cplusplus
}
#endif

#endif
