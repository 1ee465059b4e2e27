/* Results of cases as bytes that another process can read: names, then a record of each. */
#ifndef ZP_CAMPAIGN_REMOTE_H
#define ZP_CAMPAIGN_REMOTE_H

#include "campaign/record.h"

/* What results that were read point to: names, each kept once. */
typedef struct ZpRemote {
  ZpNames names;
} ZpRemote;

/* Read what zp_campaign_compute has written => `count` new results of `study`, result [count], the caller's. False if
 * the bytes are no such results, or there is no memory; then there are none. */
bool zp_remote_read(ZpRemote *remote, const unsigned char *byte, size_t size, ZpStudy study, size_t count,
                    ZpResult **result);

/* Free the names. */
void zp_remote_free(ZpRemote *remote);

#endif
