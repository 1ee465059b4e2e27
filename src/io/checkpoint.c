/* Checkpoints as files: checkpoint.zps. Numbers are little-endian on every machine.
 *
 *   bytes 0 .. 7    89 5a 50 53 0d 0a 1a 0a: no text, and a transfer as text would spoil it
 *   8 .. 11         version, 2
 *   12 .. 15        CRC-32 (as zlib's) of all that follows
 *   16 .. 23        T, bytes of text
 *   24 .. 31        n, count of numbers
 *   then T bytes    the keys that make the model, one a line: ribbon.length = 100 mm
 *   then 8 n bytes  the state, doubles, in the order of sim/checkpoint.c; the first is the time in s
 */
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/report.h"
#include "io/value.h"
#include "io/writers.h"

enum { MAGIC = 8, SUMMED = 16, HEADER = 32, VERSION = 2, TEXT_MOST = 1 << 20, NUMBERS_MOST = 1 << 22 };

static const unsigned char magic[MAGIC] = {0x89, 'Z', 'P', 'S', '\r', '\n', 0x1A, '\n'};

/* A file in memory. */
typedef struct Bytes {
  unsigned char *byte;
  size_t size;
} Bytes;

static void put(unsigned char *byte, int width, uint64_t value) {
  for (int k = 0; k < width; k++)
    byte[k] = (unsigned char)(value >> (8 * k));
}

static uint64_t get(const unsigned char *byte, int width) {
  uint64_t value = 0;
  for (int k = 0; k < width; k++)
    value |= (uint64_t)byte[k] << (8 * k);
  return value;
}

static uint32_t checksum(const unsigned char *byte, size_t size) {
  uint32_t sum = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++) {
    sum ^= byte[i];
    for (int bit = 0; bit < 8; bit++)
      sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
  }
  return ~sum;
}

/* -- out ------------------------------------------------------------------------------------------- */

/* The lines of keys, to be freed; NULL if there is no memory. */
static char *keys_text(const ZpActuatorDef *def, size_t *size) {
  char *text = NULL, value[ZP_VALUE_SIZE];
  FILE *file = open_memstream(&text, size);
  if (!file) return NULL;
  for (int i = 0; i < zp_key_count(); i++) {
    if (!zp_checkpoint_holds(i)) continue;
    zp_value_print(i, zp_def_get(def, i), value, sizeof value);
    fprintf(file, "%s = %s\n", zp_key(i)->name, value);
  }
  bool whole = !ferror(file);
  if (fclose(file) == 0 && whole) return text;
  free(text);
  return NULL;
}

/* => the whole file; byte is NULL if there is no memory. */
static Bytes encode(const ZpCheckpoint *checkpoint) {
  Bytes all = {NULL, 0};
  size_t length;
  char *text = keys_text(&checkpoint->def, &length);
  if (!text) return all;
  all.size = HEADER + length + 8 * checkpoint->count;
  all.byte = malloc(all.size);
  if (all.byte) {
    memcpy(all.byte, magic, MAGIC);
    put(all.byte + 8, 4, VERSION);
    put(all.byte + 16, 8, length);
    put(all.byte + 24, 8, checkpoint->count);
    memcpy(all.byte + HEADER, text, length);
    for (size_t k = 0; k < checkpoint->count; k++) {
      uint64_t bits;
      memcpy(&bits, &checkpoint->number[k], sizeof bits);
      put(all.byte + HEADER + length + 8 * k, 8, bits);
    }
    put(all.byte + 12, 4, checksum(all.byte + SUMMED, all.size - SUMMED));
  }
  free(text);
  return all;
}

ZpStatus zp_checkpoint_write(const ZpCheckpoint *checkpoint, FILE *file, ZpError *err) {
  Bytes all = encode(checkpoint);
  if (!all.byte) return zp_fail_memory(err);
  bool written = fwrite(all.byte, 1, all.size, file) == all.size && fflush(file) == 0;
  free(all.byte);
  return written ? ZP_OK : zp_fail(err, ZP_MACHINE, "the checkpoint cannot be written: %s", strerror(errno));
}

static const char name[] = "checkpoint.zps";

/* Did the runs of the report begin with the checkpoint in its own folder? */
static bool began_there(const ZpReport *report) {
  ZpActuatorDef def;
  struct stat there, start;
  char *path = zp_path_join(report->directory, name);
  bool same = path && zp_scenario_def(report->scenario, 0, &def, NULL) == ZP_OK &&
              stat(def.initial.file, &start) == 0 && stat(path, &there) == 0 && start.st_dev == there.st_dev &&
              start.st_ino == there.st_ino;
  free(path);
  return same;
}

/* A report without a checkpoint removes that of an earlier one, but never what its own runs began with. */
ZpStatus zp_checkpoint_report(const ZpReport *report, ZpError *err) {
  const ZpResult *result = zp_report_single(report);
  if (!result || !result->checkpoint) return began_there(report) ? ZP_OK : zp_remove_file(report->directory, name, err);
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, name, err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_checkpoint_write(result->checkpoint, out.file, err), err) : status;
}

/* -- in -------------------------------------------------------------------------------------------- */

static ZpStatus load(const char *path, Bytes *all, ZpError *err) {
  enum { LARGEST = HEADER + TEXT_MOST + 8 * NUMBERS_MOST };
  FILE *file = fopen(path, "rb");
  if (!file)
    return zp_fail(err, errno == ENOENT || errno == ENOTDIR ? ZP_BAD_INPUT : ZP_MACHINE, "%.300s: cannot be opened: %s",
                   path, strerror(errno));
  all->byte = malloc(LARGEST + 1);
  all->size = all->byte ? fread(all->byte, 1, LARGEST + 1, file) : 0;
  bool failed = ferror(file) != 0;
  int error = errno;
  fclose(file); /* nothing was written */
  if (!all->byte) return zp_fail_memory(err);
  return failed ? zp_fail(err, ZP_MACHINE, "%.300s: cannot be read: %s", path, strerror(error)) : ZP_OK;
}

static ZpStatus check_frame(const char *path, const Bytes *all, ZpError *err) {
  size_t known = all->size < MAGIC ? all->size : MAGIC;
  if (known == 0 || memcmp(all->byte, magic, known) != 0)
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: not a checkpoint of zipact", path);
  if (all->size < HEADER)
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: cut short: %zu bytes, not even a header", path, all->size);
  uint64_t version = get(all->byte + 8, 4), length = get(all->byte + 16, 8), count = get(all->byte + 24, 8);
  if (version != VERSION)
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: a checkpoint of version %llu; this program reads version %d", path,
                   (unsigned long long)version, VERSION);
  uint64_t whole = HEADER + length + 8 * count;
  if (length > TEXT_MOST || count > NUMBERS_MOST || all->size > whole)
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: damaged: its length is not what its header says", path);
  if (all->size < whole)
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: cut short: %zu of %llu bytes", path, all->size,
                   (unsigned long long)whole);
  if (get(all->byte + 12, 4) != checksum(all->byte + SUMMED, all->size - SUMMED))
    return zp_fail(err, ZP_BAD_INPUT, "%.300s: damaged: its checksum is wrong", path);
  return ZP_OK;
}

/* "ribbon.length = 100 mm" => def. ZP_BAD_INPUT if this program has no such key or value. */
static ZpStatus take_line(char *line, ZpActuatorDef *def, ZpError *err) {
  char *equals = strstr(line, " = ");
  if (!equals) return zp_fail(err, ZP_BAD_INPUT, "no value");
  *equals = 0;
  double value;
  int key = zp_key_find(line);
  if (key < 0 || !zp_checkpoint_holds(key)) return zp_fail(err, ZP_BAD_INPUT, "unknown key");
  ZpStatus status = zp_value_read(key, equals + 3, &value, err);
  return status == ZP_OK ? zp_def_set(def, key, value, err) : status;
}

/* All keys that make a model, and no others. */
static ZpStatus take_keys(char *text, ZpActuatorDef *def, ZpError *err) {
  int lines = 0, keys = 0;
  ZpStatus status = ZP_OK;
  for (char *line = strsep(&text, "\n"); text && status == ZP_OK; line = strsep(&text, "\n"), lines++)
    status = take_line(line, def, err);
  for (int i = 0; i < zp_key_count(); i++)
    keys += zp_checkpoint_holds(i);
  return status != ZP_OK || lines == keys ? status : zp_fail(err, ZP_BAD_INPUT, "%d keys, not %d", lines, keys);
}

static ZpStatus decode(const char *path, const Bytes *all, ZpCheckpoint *checkpoint, ZpError *err) {
  size_t length = get(all->byte + 16, 8);
  const unsigned char *number = all->byte + HEADER + length;
  for (size_t k = 0; k < checkpoint->count; k++) {
    uint64_t bits = get(number + 8 * k, 8);
    memcpy(&checkpoint->number[k], &bits, sizeof bits);
  }
  char *text = strndup((const char *)all->byte + HEADER, length);
  if (!text) return zp_fail_memory(err);
  ZpError reason;
  ZpStatus status = take_keys(text, &checkpoint->def, &reason);
  free(text);
  if (status == ZP_BAD_INPUT)
    return zp_fail(err, status, "%.300s: of a version of zipact with other keys than %s: %.150s", path, ZP_VERSION,
                   reason.message);
  return status == ZP_OK ? ZP_OK : zp_fail(err, status, "%s", reason.message);
}

ZpStatus zp_checkpoint_read(const char *path, ZpCheckpoint **out, ZpError *err) {
  Bytes all = {NULL, 0};
  *out = NULL;
  ZpStatus status = load(path, &all, err);
  if (status == ZP_OK) status = check_frame(path, &all, err);
  if (status == ZP_OK) *out = zp_checkpoint_create(get(all.byte + 24, 8));
  if (status == ZP_OK) status = *out ? decode(path, &all, *out, err) : zp_fail_memory(err);
  free(all.byte);
  if (status == ZP_OK) return ZP_OK;
  zp_checkpoint_destroy(*out);
  *out = NULL;
  return status;
}
