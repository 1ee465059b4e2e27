/* Results as bytes: a record (base/pack.h) of names, which results of one study share, then one of the numbers, as the
 * journal and other processes have them; then one of shapes, field and checkpoint, as pickles have. */
#ifndef ZP_IO_PACKED_H
#define ZP_IO_PACKED_H

#include <zipact/io.h>

/* Names and numbers of a result. */
typedef struct ZpPacked {
  ZpOutcome outcome;
  size_t names, size; /* bytes of the record of names, and of both */
  unsigned char byte[];
} ZpPacked;

/* => to be freed; NULL if there is no memory. */
ZpPacked *zp_packed_of(const ZpResult *result);

/* Texts one after the other, each with its 0. */
typedef struct ZpTexts {
  const char *at;
  size_t size;
} ZpTexts;

/* A record of names; its texts are those of the record. */
typedef struct ZpNames {
  ZpStudy study;
  ZpTexts scalars;     /* name, unit, "timing" or "" of each */
  ZpTexts derivatives; /* output, key of each */
  ZpTexts columns;     /* name, unit, help of each */
  double sum;          /* the checksum of the record */
} ZpNames;

/* ZP_BAD_INPUT if the record is damaged or of another version. */
ZpStatus zp_names_read(const void *bytes, size_t size, ZpNames *names, ZpError *err);

/* Read a record of numbers that have these names => `result`, in place of what it had; the record of names must outlive
 * it. ZP_BAD_INPUT, and the result is empty, if the record is damaged, of another version or belongs to other names;
 * ZP_MACHINE if there is no memory. */
ZpStatus zp_numbers_read(const ZpNames *names, const void *bytes, size_t size, ZpResult *result, ZpError *err);

/* Read the bytes of zp_campaign_compute, which must outlive the results => `count` new results of `study` in result
 * [count], which the caller frees. False if the bytes are not such results, or there is no memory; then there are none.
 */
bool zp_results_read(const unsigned char *byte, size_t size, ZpStudy study, size_t count, ZpResult **result);

#endif
