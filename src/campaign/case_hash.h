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

/* The hash of bytes that follow those of the hash `before`; the first follow ZP_HASH_START. Two texts that differ in
 * one byte have different hashes. */
#define ZP_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t zp_hash_bytes(uint64_t before, const void *data, size_t size);

#endif
