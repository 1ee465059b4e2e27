/* FNV-1a with 64 bits, eight bytes at a time. A row is found by its number and compared by its hash: after a change of
 * the scenario, a wrong row counts only if two cases with the same number collide, with a probability of 1 in 2^64. */
#include "campaign/case_hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "def/check.h"
#include "def/purpose.h"
#include "io/file.h"
#include "io/range.h"
#include "io/value.h"

static const uint64_t fnv_start = 0xcbf29ce484222325, fnv_prime = 0x100000001b3;

static uint64_t add_bytes(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ byte[i]) * fnv_prime;
  return hash;
}

/* Including the final 0, so that "a", "b" differs from "ab". */
static uint64_t add_text(uint64_t hash, const char *text) {
  return add_bytes(hash, text, strlen(text) + 1);
}

/* All eight bytes at once; the high half is folded into the low one, which the product does not reach. */
static uint64_t add_number(uint64_t hash, double value) {
  uint64_t bits;
  if (isnan(value)) value = (double)NAN; /* an arbitrary bit */
  memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * fnv_prime;
  return hash ^ hash >> 32;
}

static ZpStatus add_file(const char *key, const char *path, uint64_t *hash, ZpError *err) {
  char *text;
  size_t size;
  ZpError reason;
  if (zp_file_read(path, SIZE_MAX / 2, &text, &size, &reason) != ZP_OK)
    return zp_fail(err, ZP_MACHINE, "%s: %s", key, reason.message);
  *hash = add_bytes(*hash, text, size);
  free(text);
  return ZP_OK;
}

/* The files of a key. */
static ZpStatus add_files(int key, const char *paths, uint64_t *hash, ZpError *err) {
  char *copy = strdup(paths), *rest = copy;
  const char *separator = zp_key_paths(key) == ZP_PATHS_SEVERAL ? ";" : "";
  ZpStatus status = copy ? ZP_OK : zp_fail_memory(err);
  while (rest && status == ZP_OK)
    status = add_file(zp_key(key)->name, zp_trim(strsep(&rest, separator)), hash, err);
  free(copy);
  return status;
}

ZpStatus zp_campaign_hash(ZpStudy study, const ZpActuatorDef *def, uint64_t *hash, ZpError *err) {
  ZpStatus status = ZP_OK;
  *hash = add_text(add_text(fnv_start, ZP_VERSION), zp_study_name(study));
  for (int i = 0; i < zp_key_count() && status == ZP_OK; i++) {
    const char *path = zp_key_paths(i) != ZP_PATHS_NONE ? zp_def_text(def, i) : NULL;
    if (path && *path) status = add_files(i, path, hash, err);
  }
  return status;
}

/* Pictures and a time limit are not part of a result, and the values of a case include how it was chosen. */
uint64_t zp_case_hash(uint64_t before, const ZpActuatorDef *def) {
  uint64_t hash = before;
  for (int i = zp_def_next_key(def, -1); i >= 0; i = zp_def_next_key(def, i)) {
    const char *text = zp_def_text(def, i);
    if (zp_key_purposes(i) & ZP_NO_RESULT) continue;
    if (zp_key_instance(i).number > 0)
      hash = add_number(hash, i); /* of which member: only keys that are given are walked through */
    hash = text ? add_text(hash, text) : add_number(hash, zp_def_get(def, i));
  }
  return hash ? hash : 1;
}
