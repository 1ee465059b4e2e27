/* A result as bytes, as a row of the journal has it: numbers, notes, derivatives and series. */
#ifndef ZP_CAMPAIGN_RECORD_H
#define ZP_CAMPAIGN_RECORD_H

#include <stdint.h>

#include <zipact/study.h>

/* A name that results have: of a scalar or of a column. */
typedef struct ZpName {
  char *name, *unit, *help; /* help is NULL of a scalar */
  bool timing;
} ZpName;

/* Names by number: rows have the number, the journal has each name once. */
typedef struct ZpNames {
  ZpName *item;
  size_t count;
} ZpNames;

/* Append a name, copied; false if there is no memory. */
bool zp_names_add(ZpNames *names, const ZpName *name);

/* => its number, appended if needed; names->count if there is no memory. */
size_t zp_names_number(ZpNames *names, const ZpName *name);
void zp_names_free(ZpNames *names);

/* Bytes that grow as a record is written. */
typedef struct ZpRecord {
  unsigned char *byte;
  size_t used, room;
  bool bad; /* no memory */
} ZpRecord;

/* Write `result` in place of what the record has; names that are not among `names` are appended there. False if there
 * is no memory. */
bool zp_record_write(ZpRecord *record, ZpNames *names, const ZpResult *result);

/* Read a record of `size` bytes => numbers, notes, derivatives and series of `row`, whose outcome, message and study
 * are the caller's to set. Its names live as long as `names`; what it had before is freed. False if the
 * bytes are no record, or there is no memory. */
bool zp_record_read(const unsigned char *byte, size_t size, const ZpNames *names, ZpResult *row);

/* Free what zp_record_read has made. */
void zp_record_clear(ZpResult *row);

#endif
