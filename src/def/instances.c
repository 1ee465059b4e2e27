/* Keys of members, bodies, springs and joints: their names and order, and their values, which a Def has only where they
 * are given. */
#include "def/instances.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/rule.h"

/* A kind of them: their rows in the table of keys, what their names begin with, how many there can be, and the first of
 * their indices. */
typedef struct Kind {
  ZpKeyGroup rows;
  const char *begins;
  int most, first;
} Kind;

#define ROWS(group)  ((int)sizeof(((ZpKeyNumbers *)0)->group))
#define AFTER(group) (ZP_MOST_MEMBERS * ROWS(group))
enum {
  SEGMENTS = ZP_KEYS + AFTER(member_K) + AFTER(body_K) + AFTER(spring_K) + AFTER(joint_K),
  LOWER_SEGMENTS = SEGMENTS + ZP_MOST_SEGMENTS * ROWS(segment_K),
  END = LOWER_SEGMENTS + ZP_MOST_SEGMENTS * ROWS(lower.segment_K)
};
static const Kind kind[ZP_INSTANCE_KINDS] = {
    [ZP_OF_MEMBER] = {ZP_KEY_GROUP(member_K), "member_", ZP_MOST_MEMBERS, ZP_KEYS},
    [ZP_OF_BODY] = {ZP_KEY_GROUP(body_K), "body_", ZP_MOST_MEMBERS, ZP_KEYS + AFTER(member_K)},
    [ZP_OF_SPRING] = {ZP_KEY_GROUP(spring_K), "spring_", ZP_MOST_MEMBERS, ZP_KEYS + AFTER(member_K) + AFTER(body_K)},
    [ZP_OF_JOINT] = {ZP_KEY_GROUP(joint_K), "joint_", ZP_MOST_MEMBERS, SEGMENTS - AFTER(joint_K)},
    [ZP_OF_SEGMENT] = {ZP_KEY_GROUP(segment_K), "segment_", ZP_MOST_SEGMENTS, SEGMENTS},
    [ZP_OF_LOWER_SEGMENT] = {ZP_KEY_GROUP(lower.segment_K), "lower.segment_", ZP_MOST_SEGMENTS, LOWER_SEGMENTS},
};

static int rows_of(const Kind *k) {
  return k->rows.end - k->rows.first;
}

static int end_of(const Kind *k) {
  return k->first + k->most * rows_of(k);
}

/* The kind that a row belongs to; NULL: it belongs to none. */
static const Kind *kind_of_row(int row) {
  for (const Kind *k = kind; k < kind + ZP_INSTANCE_KINDS; k++)
    if (row >= k->rows.first && row < k->rows.end) return k;
  return NULL;
}

ZpInstance zp_key_instance(int index) {
  int of = ZP_INSTANCE_KINDS - 1;
  if (index < ZP_KEYS || index >= END) return (ZpInstance){ZP_OF_MEMBER, 0, index < END ? index : -1};
  while (index < kind[of].first)
    of--;
  const int from = index - kind[of].first, rows = rows_of(&kind[of]);
  return (ZpInstance){(ZpInstanceKind)of, 1 + from / rows, kind[of].rows.first + from % rows};
}

int zp_key_of_instance(int row, int number) {
  const Kind *k = kind_of_row(row);
  return k->first + (number - 1) * rows_of(k) + row - k->rows.first;
}

bool zp_key_is_row(int index) {
  return kind_of_row(index) != NULL;
}

int zp_instance_most(int row) {
  return kind_of_row(row)->most;
}

bool zp_key_is_of_segment(int index) {
  return index >= SEGMENTS && index < END;
}

int zp_key_next_field(int index) {
  const int next = index + 1;
  return next == ZP_KEYS ? SEGMENTS : next == END ? -1 : next;
}

int zp_key_order(int one, int other) {
  const ZpInstance a = zp_key_instance(one), b = zp_key_instance(other);
  if (a.number > 0 && b.number > 0 && a.kind == b.kind) return one - other;
  return a.row != b.row ? a.row - b.row : one - other;
}

int zp_key_with_value(const char *name) {
  const int index = zp_key_find(name);
  return zp_key_is_row(index) ? -1 : index;
}

/* A name of this kind => the number, and where the name goes on; 0: it is of another kind. */
static int number_in(const Kind *k, const char *name, const char **rest) {
  const size_t length = strlen(k->begins);
  int number = 0;
  if (strncmp(name, k->begins, length) != 0 || name[length] == '0') return 0;
  const char *digit = name + length;
  for (; *digit >= '0' && *digit <= '9' && number <= k->most; digit++)
    number = 10 * number + (*digit - '0');
  *rest = digit;
  return number <= k->most ? number : 0;
}

const char *zp_instance_begins(ZpInstanceKind of) {
  return kind[of].begins;
}

int zp_instance_named(const char *name, ZpInstanceKind *of, const char **rest) {
  int number = 0;
  for (int k = 0; number == 0 && k < ZP_INSTANCE_KINDS; k++) {
    *of = (ZpInstanceKind)k;
    number = number_in(&kind[k], name, rest);
  }
  return number;
}

/* The rest of the name of a row: of member_K.ribbon.thickness ".ribbon.thickness". */
static const char *rest_of_row(const Kind *k, int row) {
  return zp_key(row)->name + strlen(k->begins) + 1;
}

int zp_instance_find(const char *name) {
  const char *rest;
  ZpInstanceKind of;
  const int number = zp_instance_named(name, &of, &rest);
  for (int row = kind[of].rows.first; number > 0 && row < kind[of].rows.end; row++)
    if (strcmp(rest_of_row(&kind[of], row), rest) == 0) return zp_key_of_instance(row, number);
  return -1;
}

const char *zp_instance_key_name(int index, char text[ZP_KEY_NAME_SIZE]) {
  const ZpInstance at = zp_key_instance(index);
  const Kind *k = &kind[at.kind];
  snprintf(text, ZP_KEY_NAME_SIZE, "%s%d%s", k->begins, at.number, rest_of_row(k, at.row));
  return text;
}

const char *zp_key_of_one(const char *name) {
  static const char begin[] = "member_K.";
  return strncmp(name, begin, sizeof begin - 1) == 0 ? name + sizeof begin - 1 : name;
}

ZpInstanceKind zp_key_names(int key) {
  const ZpInstance at = zp_key_instance(key);
  if (at.row == ZP_KEY(member_K.port)) return ZP_OF_PORT;
  if (key == ZP_KEY(profile.member)) return ZP_OF_MEMBER;
  const bool body = key == ZP_KEY(isometric.body) || at.row == ZP_KEY(member_K.upper) ||
                    at.row == ZP_KEY(member_K.lower) || at.row == ZP_KEY(spring_K.first) ||
                    at.row == ZP_KEY(spring_K.second) || at.row == ZP_KEY(joint_K.first) ||
                    at.row == ZP_KEY(joint_K.second);
  return body ? ZP_OF_BODY : ZP_NAMED_KINDS;
}

size_t zp_instances_from(const ZpActuatorDef *def, int index) {
  size_t low = 0, high = def->given ? def->given->count : 0;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (def->given->value[middle].key < index)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

size_t zp_instances_of(const ZpActuatorDef *def, ZpInstanceKind of, int number, const ZpAssignment **value) {
  const int first = zp_key_of_instance(kind[of].rows.first, number);
  const size_t from = zp_instances_from(def, first);
  *value = def->given ? def->given->value + from : NULL;
  return zp_instances_from(def, first + rows_of(&kind[of])) - from;
}

int zp_instance_count(const ZpActuatorDef *def, ZpInstanceKind of) {
  const size_t end = zp_instances_from(def, end_of(&kind[of]));
  const ZpInstance last = end > 0 ? zp_key_instance(def->given->value[end - 1].key) : (ZpInstance){0};
  return end > 0 && last.kind == of ? last.number : 0;
}

bool zp_def_plane(const ZpActuatorDef *def) {
  bool plane = false;
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY); b++)
    plane |= zp_instances_get(def, zp_key_of_instance(ZP_KEY(body_K.moves), b)) == ZP_MOVES_PLANE;
  return plane;
}

/* Where a Def has the number of a segment's key. */
static size_t field_of(int index) {
  _Static_assert(sizeof((ZpActuatorDef *)0)->segment_K == (LOWER_SEGMENTS - SEGMENTS) * sizeof(double),
                 "one number each");
  _Static_assert(sizeof((ZpActuatorDef *)0)->lower.segment_K == (END - LOWER_SEGMENTS) * sizeof(double),
                 "one number each");
  if (index < LOWER_SEGMENTS) return offsetof(ZpActuatorDef, segment_K) + (size_t)(index - SEGMENTS) * sizeof(double);
  return offsetof(ZpActuatorDef, lower.segment_K) + (size_t)(index - LOWER_SEGMENTS) * sizeof(double);
}

static double of_segment(const ZpActuatorDef *def, int index) {
  double value;
  memcpy(&value, (const char *)def + field_of(index), sizeof value);
  return value;
}

/* Does the number of a segment's key differ from its default? */
static bool differs(const ZpActuatorDef *def, int index, double plain) {
  const double value = of_segment(def, index);
  return value != plain && !(isnan(value) && isnan(plain));
}

/* Is no key of these segments given, as in most designs? Then all are like the first one. */
static bool none_given(const ZpActuatorDef *def, const Kind *k) {
  const size_t size = (size_t)rows_of(k) * sizeof(double);
  const char *first = (const char *)def + field_of(k->first);
  bool none = memcmp(first, first + size, (size_t)(k->most - 1) * size) == 0;
  for (int row = k->rows.first; row < k->rows.end && none; row++)
    none = !differs(def, zp_key_of_instance(row, 1), zp_key(row)->def);
  return none;
}

/* The first key of segments from `index` on that is given; -1: none. */
static int next_of_segments(const ZpActuatorDef *def, const Kind *k, int index) {
  if (none_given(def, k)) return -1;
  while (index < end_of(k) && !differs(def, index, zp_key(index)->def))
    index++;
  return index < end_of(k) ? index : -1;
}

int zp_segment_key_next(const ZpActuatorDef *def, int index) {
  const Kind *upper = &kind[ZP_OF_SEGMENT], *lower = &kind[ZP_OF_LOWER_SEGMENT];
  const int from = index < SEGMENTS ? SEGMENTS : index + 1;
  const int next = from < end_of(upper) ? next_of_segments(def, upper, from) : -1;
  return next >= 0 ? next : next_of_segments(def, lower, from < lower->first ? lower->first : from);
}

/* The first key of a kind from `index` on that has a value; -1: none. */
static int next_given(const ZpActuatorDef *def, const Kind *k, int index) {
  if (zp_key_is_of_segment(k->first)) return next_of_segments(def, k, index);
  const size_t at = zp_instances_from(def, index);
  const int next = def->given && at < def->given->count ? def->given->value[at].key : -1;
  return next >= 0 && next < end_of(k) ? next : -1;
}

int zp_instance_given(const ZpActuatorDef *def, int row) {
  const Kind *k = kind_of_row(row);
  int key = next_given(def, k, k->first);
  while (key >= 0 && zp_key_instance(key).row != row)
    key = next_given(def, k, key + 1);
  return key;
}

void zp_instances_find_set(const ZpActuatorDef *def, bool set[ZP_KEYS]) {
  for (const Kind *k = kind; k < kind + ZP_INSTANCE_KINDS; k++)
    for (int row = k->rows.first; row < k->rows.end; row++)
      set[row] = false;
  for (size_t i = 0; def->given && i < def->given->count; i++)
    set[zp_key_instance(def->given->value[i].key).row] = true;
  for (int i = zp_segment_key_next(def, -1); i >= 0; i = zp_segment_key_next(def, i))
    set[zp_key_instance(i).row] = true;
}

int zp_instance_next(const ZpActuatorDef *def, int index) {
  const bool is_row = zp_key_is_row(index);
  const Kind *k = is_row ? kind_of_row(index) : &kind[zp_key_instance(index).kind];
  const int next = next_given(def, k, is_row ? k->first : index + 1);
  if (next >= 0) return next;
  return zp_key_is_row(k->rows.end) ? zp_instance_next(def, k->rows.end) : k->rows.end;
}

/* The value of a key; NULL: it is not given. */
static ZpAssignment *find(const ZpActuatorDef *def, int index) {
  const size_t at = zp_instances_from(def, index);
  return def->given && at < def->given->count && def->given->value[at].key == index ? &def->given->value[at] : NULL;
}

double zp_instances_get(const ZpActuatorDef *def, int index) {
  if (zp_key_is_of_segment(index)) return of_segment(def, index);
  const ZpAssignment *found = find(def, index);
  return found ? found->value : zp_key(index)->def;
}

static bool owns(const ZpActuatorDef *def) {
  return def->given && def->given->of == def;
}

void zp_def_clear(ZpActuatorDef *def) {
  ZpInstances *own = owns(def) ? def->given : NULL;
  if (own) zp_free(own->name);
  zp_free(own);
  def->given = NULL;
}

/* A copy of these values and names, or of none, with room for others. NULL if there is no memory. */
static ZpInstances *copy(const ZpActuatorDef *of, const ZpInstances *from, size_t room) {
  static const ZpInstances none = {0};
  if (!from) from = &none;
  ZpInstances *given = zp_calloc(1, sizeof *given + room * sizeof *given->value);
  ZpGivenName *name = from->names > 0 ? zp_calloc(from->names, sizeof *name) : NULL;
  if (!given || (from->names > 0 && !name)) {
    zp_free(given);
    zp_free(name);
    return NULL;
  }
  *given = (ZpInstances){of, from->count, room, from->names, name};
  if (from->count > 0) memcpy(given->value, from->value, from->count * sizeof *given->value);
  if (from->names > 0) memcpy(name, from->name, from->names * sizeof *name);
  return given;
}

ZpStatus zp_def_assign(ZpActuatorDef *def, const ZpActuatorDef *from, ZpError *err) {
  ZpInstances *given = from->given ? copy(def, from->given, from->given->count) : NULL;
  if (from->given && !given) return zp_fail_memory(err);
  zp_def_clear(def);
  *def = *from;
  def->given = given;
  return ZP_OK;
}

/* Replace what is given by a copy of its own. */
static ZpStatus renew(ZpActuatorDef *def, size_t room, ZpError *err) {
  ZpInstances *given = copy(def, def->given, room);
  if (!given) return zp_fail_memory(err);
  zp_def_clear(def);
  def->given = given;
  return ZP_OK;
}

/* Values of its own, with room for one more. */
static ZpStatus make_own(ZpActuatorDef *def, ZpError *err) {
  enum { ROOM = 8 };
  const size_t count = def->given ? def->given->count : 0;
  return owns(def) && count < def->given->room ? ZP_OK : renew(def, 2 * count + ROOM, err);
}

const char *zp_def_name(const ZpActuatorDef *def, ZpInstanceKind of, int number, char text[ZP_NAME_SIZE]) {
  for (size_t k = 0; def->given && k < def->given->names; k++)
    if (def->given->name[k].kind == (int)of && def->given->name[k].number == number) return def->given->name[k].text;
  if (of == ZP_OF_BODY && number == 0) return "frame";
  snprintf(text, ZP_NAME_SIZE, "%s%d", of == ZP_OF_PORT ? "port_" : kind[of].begins, number);
  return text;
}

const char *zp_def_key_shown(const ZpActuatorDef *def, int key, char text[ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE]) {
  static const char *const group[ZP_INSTANCE_KINDS] = {
      [ZP_OF_MEMBER] = "members", [ZP_OF_BODY] = "bodies", [ZP_OF_SPRING] = "springs", [ZP_OF_JOINT] = "joints"};
  const ZpInstance at = zp_key_instance(key);
  if (at.number == 0 || !group[at.kind] || !zp_def_network(def)) return zp_key_name(key, text);
  char name[ZP_NAME_SIZE];
  snprintf(text, ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE, "%s.%s%s", group[at.kind],
           zp_def_name(def, at.kind, at.number, name), rest_of_row(&kind[at.kind], at.row));
  return text;
}

const char *zp_member_called(const void *def, size_t member, char text[ZP_NAME_SIZE]) {
  if (zp_def_network(def)) return zp_def_name(def, ZP_OF_MEMBER, (int)member, text);
  snprintf(text, ZP_NAME_SIZE, "%zu", member);
  return text;
}

const char *zp_body_called(const void *def, size_t body, char text[ZP_NAME_SIZE]) {
  return zp_def_name(def, ZP_OF_BODY, (int)body, text);
}

ZpStatus zp_def_set_names(ZpActuatorDef *def, const ZpGivenName *name, size_t count, ZpError *err) {
  ZpGivenName *own = zp_calloc(count + 1, sizeof *own);
  ZpStatus status = own ? renew(def, def->given ? def->given->count : 0, err) : zp_fail_memory(err);
  if (status != ZP_OK) {
    zp_free(own);
    return status;
  }
  memcpy(own, name, count * sizeof *own);
  zp_free(def->given->name);
  def->given->name = own;
  def->given->names = count;
  return ZP_OK;
}

ZpStatus zp_instances_set(ZpActuatorDef *def, int index, double value, ZpError *err) {
  if (zp_key_is_of_segment(index)) {
    memcpy((char *)def + field_of(index), &value, sizeof value);
    return ZP_OK;
  }
  if (isnan(value) && !find(def, index)) return ZP_OK;
  ZpStatus status = make_own(def, err);
  if (status != ZP_OK) return status;
  ZpInstances *given = def->given;
  ZpAssignment *at = given->value + zp_instances_from(def, index), *end = given->value + given->count;
  const bool known = at < end && at->key == index;
  if (isnan(value)) {
    memmove(at, at + 1, (size_t)(end - at - 1) * sizeof *at);
    given->count--;
    return ZP_OK;
  }
  if (!known) memmove(at + 1, at, (size_t)(end - at) * sizeof *at);
  given->count += !known;
  *at = (ZpAssignment){index, value};
  return ZP_OK;
}

ZpStatus zp_instances_take_away(ZpActuatorDef *def, int member, int first, int last, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int row = first; row <= last && status == ZP_OK; row++)
    status = zp_instances_set(def, zp_key_of_instance(row, member), NAN, err);
  return status;
}
