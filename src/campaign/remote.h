/* Results of cases as bytes for another process: names, then a record of each result. */
#ifndef ZP_CAMPAIGN_REMOTE_H
#define ZP_CAMPAIGN_REMOTE_H

#include "campaign/record.h"

/* The names to which received results point, each kept once. */
typedef struct ZpRemote {
  ZpNames names;
} ZpRemote;

/* Read the bytes of zp_campaign_compute => `count` new results of `study` in result [count], which the caller frees.
 * False if the bytes are not such results, or there is no memory; then there are none. */
bool zp_remote_read(ZpRemote *remote, const unsigned char *byte, size_t size, ZpStudy study, size_t count,
                    ZpResult **result);

/* Free the names. */
void zp_remote_free(ZpRemote *remote);

#endif
