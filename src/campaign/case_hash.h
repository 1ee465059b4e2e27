/* Hashes of cases: a row of the journal counts only for the same case and version. */
#ifndef ZP_CAMPAIGN_CASE_HASH_H
#define ZP_CAMPAIGN_CASE_HASH_H

#include <stdint.h>

#include <zipact/io.h>

/* Hash of the version, the study and the files that `def` names: the same for all cases of a scenario. ZP_MACHINE if a
 * file cannot be read. */
ZpStatus zp_campaign_hash(ZpStudy study, const ZpActuatorDef *def, uint64_t *hash, ZpError *err);

/* Hash of a case with all its keys. `before` is zp_campaign_hash, or the hash of the case from which it starts. Never
 * 0. */
uint64_t zp_case_hash(uint64_t before, const ZpActuatorDef *def);

#endif
