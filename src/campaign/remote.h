/* Results of cases as bytes from another process. */
#ifndef ZP_CAMPAIGN_REMOTE_H
#define ZP_CAMPAIGN_REMOTE_H

#include "study/result.h"

/* Read the bytes of zp_campaign_compute, which must outlive the results => `count` new results of `study` in result
 * [count], which the caller frees. False if the bytes are not such results, or there is no memory; then there are none.
 */
bool zp_remote_read(const unsigned char *byte, size_t size, ZpStudy study, size_t count, ZpResult **result);

#endif
