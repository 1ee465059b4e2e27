/* A record: named fields as bytes that mean the same on every machine, with a version and a checksum.
 *
 *   bytes 0 .. 7    89, "ZP", a letter for the kind, 0d 0a 1a 0a: no text, and a transfer as text would spoil it
 *   8 .. 11         version of the kind
 *   12 .. 15        CRC-32 (as zlib's) of all that follows
 *   16 .. 23        length of the record, bytes
 *   24 .. 31        version of the program that wrote it, filled up with 0
 *
 * Each field follows: length of its name (1 byte), name, type (1 byte), number of items (8 bytes), items. All numbers
 * are little-endian. Records may follow each other.
 *
 * One function walks through the fields of a kind, one line each. It counts the bytes, writes them or reads them,
 * whatever the ZpPack does:
 *
 *   ZpPack p = zp_pack_count();              walk(&p, ...);  size = p.used;
 *   ZpPack p = zp_pack_write(&kind, bytes);  walk(&p, ...);  zp_pack_seal(&p);
 *   zp_pack_read(&kind, bytes, size, &p, err) == ZP_OK;  walk(&p, ...);  status = zp_pack_end(&p, err);
 *
 * Nothing here allocates memory. */
#ifndef ZP_BASE_PACK_H
#define ZP_BASE_PACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fail.h"

/* A kind of record. Versions begin at 10: those up to 9 are files of zipact 0.1.0, with another header. */
typedef struct ZpPackKind {
  const char *name; /* in messages: "snapshot" */
  char letter;
  int version;
} ZpPackKind;

/* Types of items, in memory and in the record. */
typedef enum ZpFieldType {
  ZP_TEXT = 'T', /* char; 1 byte */
  ZP_FLAG = 'F', /* bool; 1 byte, 0 or 1 */
  ZP_SIZE = 'N', /* size_t; 8 bytes */
  ZP_REAL = 'R'  /* double; 8 bytes, NAN always the same ones */
} ZpFieldType;

/* A walk through the fields of a record. */
typedef struct ZpPack {
  unsigned char *out;      /* the record, if it is written */
  const unsigned char *in; /* if it is read */
  size_t size, used;       /* bytes of the record that is read; bytes until now */
  size_t begin;            /* of the items of the open field */
  ZpFieldType type;
  const char *lacks; /* the first field that was read and is not there, with this type and this number of items */
} ZpPack;

ZpPack zp_pack_count(void);
ZpPack zp_pack_write(const ZpPackKind *kind, void *bytes);

/* Add length and checksum. */
void zp_pack_seal(const ZpPack *p);

/* Begin to read `size` bytes. ZP_BAD_INPUT says what is wrong: another kind or version, cut short, damaged. */
ZpStatus zp_pack_read(const ZpPackKind *kind, const void *bytes, size_t size, ZpPack *p, ZpError *err);

/* ZP_BAD_INPUT names a field that was not there, if there is one, or says that there are more. */
ZpStatus zp_pack_end(const ZpPack *p, ZpError *err);

/* A field of `count` items. Reading does not change `items` if a field before was not there, or this one is not. */
void zp_pack_field(ZpPack *p, const char *name, ZpFieldType type, void *items, size_t count);

/* A field whose items are counted and written one after the other. */
void zp_pack_open(ZpPack *p, const char *name, ZpFieldType type);
void zp_pack_add(ZpPack *p, const void *items, size_t count);
void zp_pack_close(ZpPack *p);

/* Read a field of any number of items => their bytes in the record; NULL, and *count is 0, if it is not there. */
const unsigned char *zp_pack_find(ZpPack *p, const char *name, ZpFieldType type, size_t *count);

/* Item `k` of the doubles there. */
double zp_pack_real(const unsigned char *items, size_t k);

/* The length of the first of several records; `size` if there is only one, or none. */
size_t zp_pack_first(const void *bytes, size_t size);

/* The checksum of a record. */
uint32_t zp_pack_sum(const void *bytes);

#endif
