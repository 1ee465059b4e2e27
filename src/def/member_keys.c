/* Keys of members: their names and order, and their values, which a Def has only where they are given. */
#include "def/member_keys.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"

static const ZpKeyGroup of_member = ZP_KEY_GROUP(member_K);

int zp_key_order(int one, int other) {
  const int rows[] = {one < ZP_KEYS ? one : of_member.first, other < ZP_KEYS ? other : of_member.first};
  return rows[0] == rows[1] ? one - other : rows[0] - rows[1];
}

int zp_key_with_value(const char *name) {
  const int index = zp_key_find(name);
  return index >= of_member.first && index < of_member.end ? -1 : index;
}

int zp_key_of_member(int row, int number) {
  return ZP_KEYS + (number - 1) * ZP_MEMBER_KEYS + row - of_member.first;
}

int zp_member_named(const char *name, const char **rest) {
  static const char before[] = "member_";
  int number = 0;
  if (strncmp(name, before, sizeof before - 1) != 0 || name[sizeof before - 1] == '0') return 0;
  const char *digit = name + sizeof before - 1;
  for (; *digit >= '0' && *digit <= '9' && number <= ZP_MOST_MEMBERS; digit++)
    number = 10 * number + (*digit - '0');
  *rest = digit;
  return number <= ZP_MOST_MEMBERS ? number : 0;
}

size_t zp_member_keys_from(const ZpActuatorDef *def, int index) {
  size_t low = 0, high = def->members ? def->members->count : 0;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (def->members->value[middle].key < index)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The value of a key; NULL: it is not given. */
static ZpAssignment *find(const ZpActuatorDef *def, int index) {
  const size_t at = zp_member_keys_from(def, index);
  return def->members && at < def->members->count && def->members->value[at].key == index ? &def->members->value[at]
                                                                                          : NULL;
}

double zp_member_keys_get(const ZpActuatorDef *def, int index) {
  const ZpAssignment *found = find(def, index);
  return found ? found->value : (double)NAN;
}

static bool owns(const ZpActuatorDef *def) {
  return def->members && def->members->of == def;
}

void zp_def_clear(ZpActuatorDef *def) {
  if (owns(def)) zp_free(def->members);
  def->members = NULL;
}

/* A copy of these values, or of none, with room for others. NULL if there is no memory. */
static ZpMemberKeys *copy(const ZpActuatorDef *of, const ZpMemberKeys *from, size_t room) {
  const size_t count = from ? from->count : 0;
  ZpMemberKeys *keys = zp_calloc(1, sizeof *keys + room * sizeof *keys->value);
  if (!keys) return NULL;
  *keys = (ZpMemberKeys){of, count, room};
  if (count > 0) memcpy(keys->value, from->value, count * sizeof *keys->value);
  return keys;
}

ZpStatus zp_def_assign(ZpActuatorDef *def, const ZpActuatorDef *from, ZpError *err) {
  ZpMemberKeys *keys = from->members ? copy(def, from->members, from->members->count) : NULL;
  if (from->members && !keys) return zp_fail_memory(err);
  zp_def_clear(def);
  *def = *from;
  def->members = keys;
  return ZP_OK;
}

/* Values of its own, with room for one more. */
static ZpStatus make_own(ZpActuatorDef *def, ZpError *err) {
  const size_t count = def->members ? def->members->count : 0;
  if (owns(def) && count < def->members->room) return ZP_OK;
  ZpMemberKeys *keys = copy(def, def->members, 2 * count + ZP_MEMBER_KEYS);
  if (!keys) return zp_fail_memory(err);
  zp_def_clear(def);
  def->members = keys;
  return ZP_OK;
}

ZpStatus zp_member_keys_set(ZpActuatorDef *def, int index, double value, ZpError *err) {
  if (isnan(value) && !find(def, index)) return ZP_OK;
  ZpStatus status = make_own(def, err);
  if (status != ZP_OK) return status;
  ZpMemberKeys *keys = def->members;
  ZpAssignment *at = keys->value + zp_member_keys_from(def, index), *end = keys->value + keys->count;
  const bool given = at < end && at->key == index;
  if (isnan(value)) {
    memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
    keys->count--;
    return ZP_OK;
  }
  if (!given) memmove(at + 1, at, (size_t)(end - at) * sizeof *at);
  keys->count += !given;
  *at = (ZpAssignment){index, value};
  return ZP_OK;
}
