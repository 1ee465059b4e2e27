/* A result as bytes in a row of the journal: numbers, notes, derivatives and series. */
#ifndef ZP_CAMPAIGN_RECORD_H
#define ZP_CAMPAIGN_RECORD_H

#include <stdint.h>

#include <zipact/study.h>

/* A name in results: of a scalar or of a column. */
typedef struct ZpName {
  char *name, *unit, *help; /* help is NULL for a scalar */
  bool timing;
} ZpName;

/* Numbered names: rows contain the numbers, the journal has each name once. */
typedef struct ZpNames {
  ZpName *item;
  size_t count;
} ZpNames;

/* Append a name, copied; false if there is no memory. */
bool zp_names_add(ZpNames *names, const ZpName *name);

/* => the number of a name, which is appended if it is new; names->count if there is no memory. */
size_t zp_names_number(ZpNames *names, const ZpName *name);
void zp_names_free(ZpNames *names);

/* The bytes of a record, which grow while it is written. */
typedef struct ZpRecord {
  unsigned char *byte;
  size_t used, room;
  bool bad; /* no memory */
} ZpRecord;

/* Write `result` in place of the previous record; names that are missing in `names` are appended to it. False if there
 * is no memory. */
bool zp_record_write(ZpRecord *record, ZpNames *names, const ZpResult *result);

/* Read a record of `size` bytes => numbers, notes, derivatives and series of `row`; the caller sets its outcome,
 * message and study. The names must outlive `row`, whose previous content is freed. False if the bytes are not a
 * record, or there is no memory. */
bool zp_record_read(const unsigned char *byte, size_t size, const ZpNames *names, ZpResult *row);

/* Free the memory of zp_record_read. */
void zp_record_clear(ZpResult *row);

#endif
