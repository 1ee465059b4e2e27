#include "base/pack.h"

#include <math.h>
#include <string.h>

#include <zipact/version.h>

enum { KIND = 3, VERSION = 8, SUM = 12, LENGTH = 16, PROGRAM = 24, HEADER = 32, HEAD = 10, OLD = 9 };

static const unsigned char mark[VERSION] = {0x89, 'Z', 'P', 0, '\r', '\n', 0x1A, '\n'};

static uint64_t get4(const unsigned char *b) {
  return b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24;
}

static uint64_t get8(const unsigned char *b) {
  return get4(b) | get4(b + 4) << 32;
}

static void put4(unsigned char *b, uint64_t value) {
  b[0] = (unsigned char)value;
  b[1] = (unsigned char)(value >> 8);
  b[2] = (unsigned char)(value >> 16);
  b[3] = (unsigned char)(value >> 24);
}

static void put8(unsigned char *b, uint64_t value) {
  put4(b, value);
  put4(b + 4, value >> 32);
}

double zp_pack_real(const unsigned char *items, size_t k) {
  const uint64_t bits = get8(items + 8 * k);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* CRC-32 of a byte is the sum of those of its bits, and bits add without carry. */
#define BIT(n, bit, sum) ((n)&bit ? (uint32_t)sum : 0)
#define ONE(n)                                                                                                         \
  (BIT(n, 1, 0x77073096) ^ BIT(n, 2, 0xEE0E612C) ^ BIT(n, 4, 0x076DC419) ^ BIT(n, 8, 0x0EDB8832) ^                     \
   BIT(n, 16, 0x1DB71064) ^ BIT(n, 32, 0x3B6E20C8) ^ BIT(n, 64, 0x76DC4190) ^ BIT(n, 128, 0xEDB88320))
#define FOUR(n)    ONE(n), ONE((n) + 1), ONE((n) + 2), ONE((n) + 3)
#define SIXTEEN(n) FOUR(n), FOUR((n) + 4), FOUR((n) + 8), FOUR((n) + 12)
#define QUARTER(n) SIXTEEN(n), SIXTEEN((n) + 16), SIXTEEN((n) + 32), SIXTEEN((n) + 48)
static const uint32_t of_byte[256] = {QUARTER(0), QUARTER(64), QUARTER(128), QUARTER(192)};

static uint32_t checksum(const unsigned char *byte, size_t size) {
  uint32_t sum = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++)
    sum = sum >> 8 ^ of_byte[(sum ^ byte[i]) & 255];
  return ~sum;
}

uint32_t zp_pack_sum(const void *bytes) {
  return (uint32_t)get4((const unsigned char *)bytes + SUM);
}

/* Bytes of an item in the record. */
static size_t width_of(ZpFieldType type) {
  return type == ZP_TEXT || type == ZP_FLAG ? 1 : 8;
}

/* -- writing --------------------------------------------------------------------------------------- */

ZpPack zp_pack_count(void) {
  return (ZpPack){.used = HEADER};
}

ZpPack zp_pack_write(const ZpPackKind *kind, void *bytes) {
  unsigned char *byte = bytes;
  memset(byte, 0, HEADER);
  memcpy(byte, mark, sizeof mark);
  byte[KIND] = (unsigned char)kind->letter;
  put4(byte + VERSION, (uint64_t)kind->version);
  _Static_assert(sizeof ZP_VERSION - 1 <= HEADER - PROGRAM, "the header has room for the version");
  memcpy(byte + PROGRAM, ZP_VERSION, sizeof ZP_VERSION - 1);
  return (ZpPack){.out = byte, .used = HEADER};
}

void zp_pack_seal(const ZpPack *p) {
  put8(p->out + LENGTH, p->used);
  put4(p->out + SUM, checksum(p->out + LENGTH, p->used - LENGTH));
}

void zp_pack_open(ZpPack *p, const char *name, ZpFieldType type) {
  const size_t length = strlen(name);
  unsigned char *head = p->out ? p->out + p->used : NULL;
  if (head) {
    head[0] = (unsigned char)length;
    for (size_t i = 0; i < length; i++)
      head[1 + i] = (unsigned char)name[i];
    head[1 + length] = (unsigned char)type;
  }
  p->used = p->begin = p->used + HEAD + length;
  p->type = type;
}

static void copy_out(ZpFieldType type, const void *items, size_t count, unsigned char *byte) {
  const double *real = items;
  const size_t *size = items;
  if (width_of(type) == 1) memcpy(byte, items, count);
  for (size_t k = 0; type == ZP_REAL && k < count; k++) {
    uint64_t bits;
    memcpy(&bits, &real[k], sizeof bits);
    put8(byte + 8 * k, isnan(real[k]) ? UINT64_C(0x7FF8000000000000) : bits);
  }
  for (size_t k = 0; type == ZP_SIZE && k < count; k++)
    put8(byte + 8 * k, size[k]);
}

void zp_pack_add(ZpPack *p, const void *items, size_t count) {
  if (p->out && count) copy_out(p->type, items, count, p->out + p->used);
  p->used += width_of(p->type) * count;
}

void zp_pack_close(ZpPack *p) {
  if (p->out) put8(p->out + p->begin - 8, (p->used - p->begin) / width_of(p->type));
}

/* -- reading --------------------------------------------------------------------------------------- */

ZpStatus zp_pack_read(const ZpPackKind *kind, const void *bytes, size_t size, ZpPack *p, ZpError *err) {
  const unsigned char *byte = bytes;
  bool ours = size > 0;
  for (size_t k = 0; k < sizeof mark && k < size; k++)
    ours = ours && byte[k] == (k == KIND ? (unsigned char)kind->letter : mark[k]);
  if (!ours) return zp_fail(err, ZP_BAD_INPUT, "not a %s of zipact", kind->name);
  if (size < HEADER) return zp_fail(err, ZP_BAD_INPUT, "cut short: %zu bytes, not even a header", size);
  const uint64_t version = get4(byte + VERSION), whole = get8(byte + LENGTH);
  if (version != (uint64_t)kind->version)
    return zp_fail(err, ZP_BAD_INPUT, "of version %llu of the format, by zipact %.8s; zipact %s reads version %d",
                   (unsigned long long)version, version <= OLD ? "0.1.0" : (const char *)byte + PROGRAM, ZP_VERSION,
                   kind->version);
  if (size < whole) return zp_fail(err, ZP_BAD_INPUT, "cut short: %zu of %llu bytes", size, (unsigned long long)whole);
  if (size > whole) return zp_fail(err, ZP_BAD_INPUT, "damaged: its length is not what its header says");
  if (zp_pack_sum(byte) != checksum(byte + LENGTH, size - LENGTH))
    return zp_fail(err, ZP_BAD_INPUT, "damaged: its checksum is wrong");
  *p = (ZpPack){.in = byte, .size = size, .used = HEADER};
  return ZP_OK;
}

ZpStatus zp_pack_end(const ZpPack *p, ZpError *err) {
  if (!p->lacks && p->used == p->size) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "of a version of zipact with other fields: of %.8s, %s %s; this is %s",
                 (const char *)p->in + PROGRAM, p->lacks ? "without" : "with", p->lacks ? p->lacks : "more",
                 ZP_VERSION);
}

const unsigned char *zp_pack_find(ZpPack *p, const char *name, ZpFieldType type, size_t *count) {
  const size_t length = strlen(name), left = p->size - p->used;
  const unsigned char *head = p->in + p->used;
  const bool there = !p->lacks && left >= HEAD + length && head[0] == length && memcmp(head + 1, name, length) == 0 &&
                     head[1 + length] == (unsigned char)type;
  const uint64_t most = there ? (left - HEAD - length) / width_of(type) : 0;
  const uint64_t found = there ? get8(head + HEAD + length - 8) : 0;
  *count = 0;
  if (!there || found > most) {
    p->lacks = p->lacks ? p->lacks : name;
    return NULL;
  }
  *count = (size_t)found;
  p->used += HEAD + length + width_of(type) * *count;
  return head + HEAD + length;
}

static void copy_in(ZpFieldType type, const unsigned char *byte, size_t count, void *items) {
  double *real = items;
  size_t *size = items;
  bool *flag = items;
  if (type == ZP_TEXT) memcpy(items, byte, count);
  for (size_t k = 0; type == ZP_FLAG && k < count; k++)
    flag[k] = byte[k] != 0;
  for (size_t k = 0; type == ZP_REAL && k < count; k++)
    real[k] = zp_pack_real(byte, k);
  for (size_t k = 0; type == ZP_SIZE && k < count; k++)
    size[k] = (size_t)get8(byte + 8 * k);
}

void zp_pack_field(ZpPack *p, const char *name, ZpFieldType type, void *items, size_t count) {
  if (!p->in) {
    zp_pack_open(p, name, type);
    zp_pack_add(p, items, count);
    zp_pack_close(p);
    return;
  }
  size_t found;
  const unsigned char *byte = zp_pack_find(p, name, type, &found);
  if (byte && found != count) p->lacks = name;
  if (byte && found == count) copy_in(type, byte, count, items);
}

size_t zp_pack_first(const void *bytes, size_t size) {
  const unsigned char *byte = bytes;
  if (size < HEADER || memcmp(byte, mark, KIND) != 0) return size;
  const uint64_t whole = get8(byte + LENGTH);
  const bool more = whole >= HEADER && whole < size && size - whole >= KIND && memcmp(byte + whole, mark, KIND) == 0;
  return more ? (size_t)whole : size;
}
