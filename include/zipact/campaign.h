/* A campaign: the cases of a scenario, computed by several threads and kept in a journal, so that it can be resumed
 * after any interruption. Part of the io library; needs SQLite. */
#ifndef ZIPACT_CAMPAIGN_H
#define ZIPACT_CAMPAIGN_H

#include <zipact/api.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpCampaign ZpCampaign;

/* Progress of a campaign. */
typedef struct ZpCampaignState {
  size_t cases;    /* cases of the scenario */
  size_t done;     /* cases with a row, including those of an earlier process */
  size_t resumed;  /* rows of an earlier process */
  size_t failed;   /* rows whose run failed (not zp_outcome_good) */
  double fraction; /* share of all cases, including the progress of running ones, 0 .. 1 */
} ZpCampaignState;

/* Options of a campaign. */
typedef struct ZpCampaignOptions {
  int jobs;    /* computing threads, 1 or more; 0: as many as there are processors. Results do not depend on it */
  bool resume; /* keep the rows of an existing journal; otherwise it is replaced if its campaign is finished */
  void *user;  /* argument of the functions below */
  /* Called some times a second by the thread that runs the campaign; true stops it. May be NULL. */
  bool (*progress)(void *user, const ZpCampaignState *state);
  double (*clock)(void *user); /* wall clock in s; called by all threads. NULL: wall times are NAN */
  /* Let process `worker`, below `jobs`, compute cases from .. to - 1 by zp_campaign_compute => its bytes, to be freed;
   * *byte NULL: that process is lost, and others take its cases. Called by one thread per worker. NULL: threads of this
   * process compute. */
  ZpStatus (*remote)(void *remote_user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                     ZpError *err);
  void *remote_user; /* argument of remote */
} ZpCampaignOptions;

/* Compute cases from .. to - 1 of `scenario`, one after the other, for a campaign of another process (`remote`) =>
 * bytes for that process, to be freed. `from` must be a start that a call of `remote` has given. `hooks` may be NULL.
 */
ZP_API ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                                    unsigned char **byte, size_t *size, ZpError *err);

/* Open DIRECTORY/journal.sqlite for `scenario`, which must have passed zp_batch_check and outlive the campaign.
 * `directory` must exist and be locked by the caller (zp_folder_open). ZP_BAD_INPUT if `resume` finds a file that is
 * not a journal, or a campaign without `resume` finds the journal of an unfinished one; ZP_MACHINE if it cannot be
 * written. *out is NULL on failure. */
ZP_API ZpStatus zp_campaign_open(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                                 ZpCampaign **out, ZpError *err);

/* Compute the cases that have no row of the same case and version yet. Rows are on the disk within a second. A case
 * whose solver fails, or whose input turns out to be impossible, is a row with its outcome. ZP_MACHINE if the machine
 * fails: rows are kept. */
ZP_API ZpStatus zp_campaign_run(ZpCampaign *campaign, ZpError *err);

/* How far it is. */
ZP_API ZpCampaignState zp_campaign_state(const ZpCampaign *campaign);

/* Number of rows without a gap from the first case on: those that a report shows. */
ZP_API size_t zp_campaign_count(const ZpCampaign *campaign);

/* The rows, for ZpReport; valid as long as the campaign. */
ZP_API const ZpRows *zp_campaign_rows(const ZpCampaign *campaign);

/* Close the journal; NULL is allowed. */
ZP_API void zp_campaign_close(ZpCampaign *campaign);

#ifdef __cplusplus
}
#endif

#endif
