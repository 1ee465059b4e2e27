/* The table of keys, made from keys.def, and its functions: defaults, presets, checks. */
#include "def/def.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/device.h"
#include "def/instances.h"

/* The words of each choice type. */
#define ZP_CHOICES(type)                  static const ZpChoice words_of_##type[] = {
#define ZP_CHOICE(enumerator, word, help) {word, help},
#define ZP_CHOICES_END(type)                                                                                           \
  }                                                                                                                    \
  ;
#include <zipact/choices.def>
#undef ZP_CHOICES
#undef ZP_CHOICE
#undef ZP_CHOICES_END

#define ZP_REAL(path, name, unit, shown, def, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL, unit, shown, def, min, max, help, NULL, NULL},
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help)                                                \
  {#path #name, ZP_KEY_REAL, unit, shown, def, min, max, help, NULL, NULL},
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL_AUTO, unit, shown, NAN, min, max, help, NULL, "auto"},
#define ZP_REAL_OR_AUTO(path, name, unit, shown, def, min, max, help)                                                  \
  {#path #name, ZP_KEY_REAL_AUTO, unit, shown, def, min, max, help, NULL, "auto"},
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL_AUTO, unit, shown, NAN, min, max, help, NULL, "none"},
#define ZP_INT(path, name, def, min, max, help) {#path #name, ZP_KEY_INT, "1", "", def, min, max, help, NULL, NULL},
#define ZP_BOOL(path, name, def, help)          {#path #name, ZP_KEY_BOOL, "1", "", def, 0, 1, help, NULL, NULL},
#define ZP_ENUM(path, name, type, def, help)                                                                           \
  {#path #name, ZP_KEY_ENUM, "1", "", def, 0, type##_COUNT - 1, help, words_of_##type, NULL},
#define ZP_TEXT(path, name, def, help) {#path #name, ZP_KEY_TEXT, "1", "", NAN, 0, ZP_TEXT_SIZE - 1, help, NULL, def},
#define ZP_OF_SCENARIO(name, type, def, help)                                                                          \
  {#name, ZP_KEY_ENUM, "1", "", def, 0, type##_COUNT - 1, help, words_of_##type, NULL},
static const ZpKey keys[] = {
#include "def/keys.def"
};

enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

/* The place of each key's field in a Def; NO_FIELD: a key of the scenario. */
#define NO_FIELD                              ((size_t)-1)
#define ZP_EACH_KEY(path, field, text)        offsetof(ZpActuatorDef, path field),
#define ZP_OF_SCENARIO(name, type, def, help) NO_FIELD,
#define segment_K                             segment_K[0]
static const size_t offsets[] = {
#include "def/keys.def"
};
#undef segment_K

/* Every key at its default. */
#define ZP_GROUP(group) .group = {
#define ZP_GROUP_END(group)                                                                                            \
  }                                                                                                                    \
  ,
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           .name = (def),
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) .field = (def),
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           .name = NAN,
#define ZP_REAL_OR_AUTO(path, name, unit, shown, def, min, max, help)   .name = (def),
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           .name = NAN,
#define ZP_INT(path, name, def, min, max, help)                         .name = (def),
#define ZP_BOOL(path, name, def, help)                                  .name = (def),
#define ZP_ENUM(path, name, type, def, help)                            .name = (def),
#define ZP_TEXT(path, name, def, help)                                  .name = def,
#define ZP_OF_SCENARIO(name, type, def, help)
#define ZP_EIGHT(...)       __VA_ARGS__ __VA_ARGS__ __VA_ARGS__ __VA_ARGS__ __VA_ARGS__ __VA_ARGS__ __VA_ARGS__ __VA_ARGS__
#define ZP_MANY(group, ...) .group = {ZP_EIGHT(ZP_EIGHT({__VA_ARGS__}, ))},
static const ZpActuatorDef plain = {
#include "def/keys.def"
};

/* Values that a preset or a supply sets, for one number of nodes or (nodes 0) for any. */
typedef struct PresetValue {
  bool is_supply;
  int selector; /* ZpPreset or ZpSupplyName */
  const char *key;
  int nodes;
  double value;
} PresetValue;

#define ZP_PRESET_VALUE(preset, key, value)     {false, preset, key, 0, value},
#define ZP_PRESET_AT(preset, key, nodes, value) {false, preset, key, nodes, value},
#define ZP_SUPPLY_VALUE(supply, key, value)     {true, supply, key, 0, value},
static const PresetValue preset_values[] = {
#include "def/presets.def"
};
enum { PRESET_VALUES = sizeof preset_values / sizeof preset_values[0] };

/* Values that the materials of a group of keys set. */
typedef struct MaterialRow {
  enum { OF_STRIP, OF_INSULATOR, OF_MEDIUM } group;
  ZpMaterialValue value;
} MaterialRow;

#define ZP_STRIP(...)     {OF_STRIP, {__VA_ARGS__}},
#define ZP_INSULATOR(...) {OF_INSULATOR, {__VA_ARGS__}},
#define ZP_MEDIUM(...)    {OF_MEDIUM, {__VA_ARGS__}},
static const MaterialRow material_rows[] = {
#include "def/materials.def"
};

int zp_key_count(void) {
  return KEY_COUNT;
}

const ZpKey *zp_key(int index) {
  if (index >= 0 && index < KEY_COUNT) return &keys[index];
  const int row = zp_key_instance(index).row;
  return row < 0 ? NULL : &keys[row];
}

const char *zp_key_name(int index, char text[ZP_KEY_NAME_SIZE]) {
  if (index < KEY_COUNT) return index < 0 ? NULL : keys[index].name;
  return zp_key(index) ? zp_instance_key_name(index, text) : NULL;
}

int zp_key_find(const char *name) {
  for (int i = 0; i < KEY_COUNT; i++) /* called some twenty times per case; most names differ in the first letter */
    if (keys[i].name[0] == name[0] && strcmp(keys[i].name, name) == 0) return i;
  return zp_instance_find(name);
}

int zp_def_next_key(const ZpActuatorDef *def, int index) {
  const int next = index + 1;
  if (!def || next == ZP_KEYS) return -1;
  return zp_key_is_row(next) ? zp_instance_next(def, next) : index >= ZP_KEYS ? zp_instance_next(def, index) : next;
}

/* ASCII only: names of keys have no other letters. */
static char lower(char c) {
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Length of a text, at most `most`. */
static int length_within(const char *text, int most) {
  int length = 0;
  while (length < most && text[length])
    length++;
  return length;
}

int zp_word_distance(const char *a, const char *b) {
  enum { LONGEST = 64 };
  int row[3][LONGEST] = {{0}}; /* of the letters of `a` before the last, before this one, with this one */
  int len = length_within(b, LONGEST - 1);
  for (int j = 0; j <= len; j++)
    row[1][j] = row[2][j] = j;
  for (int i = 1; i < LONGEST && a[i - 1]; i++) {
    memcpy(row[0], row[1], sizeof row[0]);
    memcpy(row[1], row[2], sizeof row[1]);
    row[2][0] = i;
    for (int j = 1; j <= len; j++) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      int least = row[1][j - 1] + !same;
      if (row[1][j] + 1 < least) least = row[1][j] + 1;
      if (row[2][j - 1] + 1 < least) least = row[2][j - 1] + 1;
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped && row[0][j - 2] + 1 < least) least = row[0][j - 2] + 1;
      row[2][j] = least;
    }
  }
  return row[2][len];
}

/* The first key of the group in `name` whose last word contains `word`, or NULL. */
static const char *first_with(const char *name, const char *word) {
  const char *dot = strchr(name, '.');
  for (int i = 0; dot && i < KEY_COUNT; i++)
    if (strncmp(keys[i].name, name, (size_t)(dot - name) + 1) == 0 && strstr(strrchr(keys[i].name, '.') + 1, word))
      return keys[i].name;
  return NULL;
}

/* A name that resembles no key may be a part of one (medium.viscosity). If it is not, the main key of its group is the
 * most likely one (load.mass for load.weight). */
static const char *first_of_group(const char *name) {
  const char *dot = strrchr(name, '.');
  const char *first = dot && dot[1] ? first_with(name, dot + 1) : NULL;
  return first ? first : first_with(name, "");
}

int zp_key_distance(const char *name, const char *key) {
  const char *dot = strrchr(key, '.');
  int whole = zp_word_distance(name, key), last = dot ? zp_word_distance(name, dot + 1) + 1 : whole;
  return whole < last ? whole : last;
}

/* Does the key stand for those of all members, bodies or springs, and the name for none of them? */
static bool is_of_others(int key, const char *name) {
  const char *number = strchr(keys[key].name, 'K');
  return zp_key_is_row(key) && strncmp(keys[key].name, name, (size_t)(number - keys[key].name)) != 0;
}

const char *zp_key_nearest(const char *name) {
  const char *nearest = keys[0].name;
  int least = 1000;
  for (int i = 0; i < KEY_COUNT; i++) {
    int distance = zp_key_distance(name, keys[i].name);
    if (distance < least && !is_of_others(i, name)) {
      least = distance;
      nearest = keys[i].name;
    }
  }
  bool alike = 4 * least <= (int)strlen(name);
  const char *first = alike ? NULL : first_of_group(name);
  return first ? first : nearest;
}

int zp_key_choice(int index, const char *word) {
  const ZpKey *key = zp_key(index);
  for (int i = 0; key && key->choices && i <= (int)key->max; i++)
    if (strcmp(key->choices[i].word, word) == 0) return i;
  return -1;
}

static size_t offset_of(const ZpKey *key) {
  return offsets[key - keys];
}

static bool has_field(const ZpKey *key) {
  return offset_of(key) != NO_FIELD && !zp_key_is_row((int)(key - keys));
}

bool zp_key_in_def(int index) {
  const ZpKey *key = zp_key(index);
  return key && (index >= KEY_COUNT || has_field(key));
}

/* Write a value, which has been checked, into its field. */
static void store(ZpActuatorDef *def, const ZpKey *key, double value) {
  void *field = (char *)def + offset_of(key);
  switch (key->type) {
  case ZP_KEY_REAL:
  case ZP_KEY_REAL_AUTO:
    memcpy(field, &value, sizeof value);
    break;
  case ZP_KEY_BOOL:
    *(bool *)field = value != 0;
    break;
  case ZP_KEY_INT:
  case ZP_KEY_ENUM:
    memcpy(field, &(int){(int)value}, sizeof(int));
    break;
  case ZP_KEY_TEXT: /* a text has no number */
    break;
  }
}

/* Is there a Def? zp_def_create returns none if there is no memory. */
static ZpStatus check_there(const ZpActuatorDef *def, ZpError *err) {
  return def ? ZP_OK : zp_fail_memory(err);
}

/* The value of a key that has a field; NAN for a text. */
static double number_of(const ZpActuatorDef *def, const ZpKey *key) {
  const void *field = (const char *)def + offset_of(key);
  double real;
  int whole;
  switch (key->type) {
  case ZP_KEY_REAL:
  case ZP_KEY_REAL_AUTO:
    memcpy(&real, field, sizeof real);
    return real;
  case ZP_KEY_BOOL:
    return *(const bool *)field;
  case ZP_KEY_TEXT:
    return NAN;
  case ZP_KEY_INT:
  case ZP_KEY_ENUM:
    break;
  }
  memcpy(&whole, field, sizeof whole);
  return whole;
}

/* Has a field this value, or is it an empty text? */
static bool has_value(const ZpActuatorDef *def, const ZpKey *key, double plain) {
  if (key->type == ZP_KEY_TEXT) return *((const char *)def + offset_of(key)) == 0;
  const double value = number_of(def, key);
  return value == plain || (isnan(value) && isnan(plain));
}

void zp_def_find_set(const ZpActuatorDef *def, bool set[ZP_KEYS]) {
  const ZpDevice *device = zp_device_of(def->actuator.kind);
  for (int i = 0; i < KEY_COUNT; i++)
    set[i] = offset_of(&keys[i]) != NO_FIELD && !has_value(def, &keys[i], keys[i].def);
  for (size_t k = 0; k < device->given_count; k++)
    set[device->given[k].key] = !has_value(def, &keys[device->given[k].key], device->given[k].value);
  zp_instances_find_set(def, set);
}

double zp_def_get(const ZpActuatorDef *def, int index) {
  const ZpKey *key = zp_key(index);
  if (!def || !key) return NAN;
  if (index >= KEY_COUNT) return zp_instances_get(def, index);
  if (zp_key_is_row(index)) return key->def;
  return offset_of(key) != NO_FIELD ? number_of(def, key) : (double)NAN;
}

const char *zp_def_text(const ZpActuatorDef *def, int index) {
  const ZpKey *key = zp_key(index);
  return def && key && key->type == ZP_KEY_TEXT ? (const char *)def + offset_of(key) : NULL;
}

/* Is there such a key? zp_key_find gives -1 for an unknown name. */
static ZpStatus check_known(int index, ZpError *err) {
  return zp_key(index) ? ZP_OK : zp_fail(err, ZP_BAD_INPUT, "key %d: there is no such key", index);
}

static ZpStatus check_text(const ZpKey *key, const char *text, ZpError *err) {
  int length = length_within(text, ZP_TEXT_SIZE);
  if (length == ZP_TEXT_SIZE)
    return zp_fail(err, ZP_BAD_INPUT, "%s: longer than %d bytes", key->name, ZP_TEXT_SIZE - 1);
  for (int i = 0; i < length; i++)
    if ((unsigned char)text[i] < 0x20 || text[i] == 0x7F)
      return zp_fail(err, ZP_BAD_INPUT, "%s: character %d is a control character", key->name, i + 1);
  return ZP_OK;
}

ZpStatus zp_def_set_text(ZpActuatorDef *def, int index, const char *text, ZpError *err) {
  if (check_known(index, err) != ZP_OK) return ZP_BAD_INPUT;
  const ZpKey *key = zp_key(index);
  if (key->type != ZP_KEY_TEXT) return zp_fail(err, ZP_BAD_INPUT, "%s: takes a number, not a text", ZP_KEY_NAME(index));
  ZpStatus status = check_there(def, err);
  if (status == ZP_OK) status = check_text(key, text, err);
  if (status != ZP_OK) return status;
  char *field = (char *)def + offset_of(key);
  memset(field, 0, ZP_TEXT_SIZE);
  memcpy(field, text, strlen(text) + 1);
  return ZP_OK;
}

static ZpStatus refuse_range(int index, double value, ZpError *err) {
  const ZpKey *key = zp_key(index);
  const char *unit = strcmp(key->unit, "1") == 0 ? "" : key->unit;
  const char *space = *unit ? " " : "";
  return zp_fail(err, ZP_BAD_INPUT, "%s = %g%s%s: out of range; %g to %g%s%s", ZP_KEY_NAME(index), value, space, unit,
                 key->min, key->max, space, unit);
}

static ZpStatus check_value(int index, double value, ZpError *err) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_TEXT) return zp_fail(err, ZP_BAD_INPUT, "%s: takes a text, not a number", key->name);
  if (key->type == ZP_KEY_REAL_AUTO && isnan(value)) return ZP_OK;
  if (!isfinite(value)) return zp_fail(err, ZP_BAD_INPUT, "%s: not a finite number", ZP_KEY_NAME(index));
  bool whole = key->type != ZP_KEY_REAL && key->type != ZP_KEY_REAL_AUTO;
  if (whole && value != floor(value))
    return zp_fail(err, ZP_BAD_INPUT, "%s = %g: not a whole number", ZP_KEY_NAME(index), value);
  return value < key->min || value > key->max ? refuse_range(index, value, err) : ZP_OK;
}

ZpStatus zp_def_set(ZpActuatorDef *def, int index, double value, ZpError *err) {
  ZpStatus status = check_there(def, err);
  if (status == ZP_OK) status = check_known(index, err);
  if (status == ZP_OK) status = check_value(index, value, err);
  if (status != ZP_OK) return status;
  if (index >= KEY_COUNT) return zp_instances_set(def, index, value, err);
  if (zp_key_is_row(index))
    return zp_fail(err, ZP_BAD_INPUT, "%s: give a number, 1 to %d, in the place of K", keys[index].name,
                   zp_instance_most(index));
  if (!has_field(&keys[index]))
    return zp_fail(err, ZP_BAD_INPUT, "%s: is a key of a scenario, not of a definition", keys[index].name);
  store(def, &keys[index], value);
  return ZP_OK;
}

static bool is_given(int key, const ZpAssignment *list, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (list[i].key == key) return true;
  return false;
}

static ZpStatus apply_assignments(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < count && status == ZP_OK; i++)
    status = zp_def_set(def, list[i].key, list[i].value, err);
  return status;
}

/* Apply the values of a preset, including those for `nodes`, or of a supply. */
static void apply_values(ZpActuatorDef *def, bool is_supply, int selector, int nodes) {
  for (int i = 0; i < PRESET_VALUES; i++) {
    const PresetValue *p = &preset_values[i];
    if (p->is_supply == is_supply && p->selector == selector && (p->nodes == 0 || p->nodes == nodes))
      store(def, &keys[zp_key_find(p->key)], p->value);
  }
}

/* Groups that a material fills: the prefix of their keys, the key that names the material, and their rows. */
typedef struct MaterialGroup {
  const char *prefix;
  size_t offset;
  int rows;
} MaterialGroup;

static const MaterialGroup material_groups[] = {
    {"ribbon.", offsetof(ZpActuatorDef, ribbon.material), OF_STRIP},
    {"insulator.", offsetof(ZpActuatorDef, insulator.material), OF_INSULATOR},
    {"medium.", offsetof(ZpActuatorDef, medium.material), OF_MEDIUM},
    {"lower.ribbon.", offsetof(ZpActuatorDef, lower.ribbon.material), OF_STRIP},
    {"lower.insulator.", offsetof(ZpActuatorDef, lower.insulator.material), OF_INSULATOR},
};

static const MaterialGroup *material_group_of(const char *key) {
  for (size_t g = 0; g < sizeof material_groups / sizeof material_groups[0]; g++)
    if (strncmp(key, material_groups[g].prefix, strlen(material_groups[g].prefix)) == 0) return &material_groups[g];
  return NULL;
}

bool zp_key_is_material(int index) {
  const ZpKey *key = zp_key(index);
  const char *last = key ? strrchr(key->name, '.') : NULL;
  return last && strcmp(last, ".material") == 0;
}

void zp_def_take_supply(ZpActuatorDef *def) {
  apply_values(def, true, (int)def->source.supply, 0);
}

static int material_of(const ZpActuatorDef *def, const MaterialGroup *group) {
  int material;
  memcpy(&material, (const char *)def + group->offset, sizeof material);
  return material;
}

const ZpMaterialValue *zp_material_value(const ZpActuatorDef *def, int index) {
  const MaterialGroup *group = def && index >= 0 && index < KEY_COUNT ? material_group_of(keys[index].name) : NULL;
  if (!group) return NULL;
  int material = material_of(def, group);
  const char *name = keys[index].name + strlen(group->prefix);
  for (size_t i = 0; i < sizeof material_rows / sizeof material_rows[0]; i++) {
    const ZpMaterialValue *value = &material_rows[i].value;
    if ((int)material_rows[i].group == group->rows && value->material == material && strcmp(value->name, name) == 0)
      return strcmp(name, "resistivity") == 0 ? NULL : value; /* which would add leakage: the user must set it */
  }
  return NULL;
}

static void apply_materials(ZpActuatorDef *def, const ZpActuatorDef *given) {
  bool any = false;
  for (size_t g = 0; g < sizeof material_groups / sizeof material_groups[0]; g++)
    any |= material_of(given, &material_groups[g]) != 0;
  for (int i = 0; any && i < KEY_COUNT; i++) {
    const ZpMaterialValue *filled = zp_material_value(given, i);
    if (filled) store(def, &keys[i], filled->value);
  }
}

/* A key that the preset defines for some N only must be given for any other N. */
static ZpStatus check_preset_complete(ZpPreset preset, int nodes, const ZpAssignment *list, size_t count,
                                      ZpError *err) {
  for (int i = 0; i < PRESET_VALUES; i++) {
    const PresetValue *p = &preset_values[i];
    if (p->selector != (int)preset || p->nodes == 0) continue;
    bool has_n = false;
    for (int j = 0; j < PRESET_VALUES; j++)
      has_n |= preset_values[j].selector == (int)preset && strcmp(preset_values[j].key, p->key) == 0 &&
               preset_values[j].nodes == nodes;
    if (!has_n && !is_given(zp_key_find(p->key), list, count))
      return zp_fail(err, ZP_BAD_INPUT, "%s: preset %s has no value of this key for mesh.nodes = %d; give one", p->key,
                     words_of_ZpPreset[preset].word, nodes);
  }
  return ZP_OK;
}

/* Keys of members, bodies, springs and joints determine no value of another key. */
static ZpStatus apply_common(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < count && status == ZP_OK; i++)
    if (list[i].key < KEY_COUNT) status = zp_def_set(def, list[i].key, list[i].value, err);
  return status;
}

/* Does a gap withstand far more than the strength of its medium? */
static bool is_small(double gap) {
  static const double most = 20e-6; /* m */
  return gap > 0 && gap < most;
}

ZpStatus zp_def_resolve(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err) {
  ZpActuatorDef given = plain;
  ZpStatus status = check_there(def, err);
  if (status == ZP_OK) status = apply_common(&given, list, count, err);
  if (status == ZP_OK) status = check_preset_complete(given.preset, given.mesh.nodes, list, count, err);
  if (status != ZP_OK) return status;

  ZpActuatorDef with_preset = plain;
  apply_values(&with_preset, false, (int)given.preset, given.mesh.nodes);
  ZpActuatorKind kind =
      is_given(zp_key_find("actuator.kind"), list, count) ? given.actuator.kind : with_preset.actuator.kind;

  zp_def_clear(def);
  *def = plain;
  const ZpDevice *device = zp_device_of(kind);
  status = apply_assignments(def, device->given, device->given_count, err);
  if (status != ZP_OK) return status;
  apply_values(def, false, (int)given.preset, given.mesh.nodes);
  apply_values(def, true, (int)given.source.supply, 0);
  apply_materials(def, &given);
  given.actuator.kind = kind;
  if (is_small(zp_def_gap(&given))) def->electro.breakdown_cap = false;
  return apply_assignments(def, list, count, err);
}

static ZpStatus check_square(const char *group, double duty, double frequency, double rise_time, ZpError *err) {
  double shorter = fmin(duty, 1 - duty) / frequency;
  if (rise_time <= shorter) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s.rise_time = %g s: longer than the shorter part of the square wave, %g s (%s.duty / %s.frequency)",
                 group, rise_time, shorter, group, group);
}

static ZpStatus check_waveforms(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  if (def->drive.waveform == ZP_WAVEFORM_SQUARE)
    status = check_square("drive", def->drive.duty, def->drive.frequency, def->drive.rise_time, err);
  if (status == ZP_OK && def->setpoint.waveform == ZP_WAVEFORM_SQUARE)
    status = check_square("setpoint", def->setpoint.duty, def->setpoint.frequency, def->setpoint.rise_time, err);
  return status;
}

bool zp_def_shorts(const ZpActuatorDef *def) {
  return zp_insulation(def) == 0 && !(zp_def_has(def, ZP_DEVICE_RIGID) && def->plate.stop_gap > 0);
}

double zp_platform_length(const ZpActuatorDef *def) {
  return zp_def_has(def, ZP_DEVICE_RIGID) ? def->ribbon.length : def->platform.length;
}

double zp_def_gap(const ZpActuatorDef *def) {
  if (zp_def_has(def, ZP_DEVICE_RIGID)) return def->plate.gap;
  if (!zp_def_has(def, ZP_DEVICE_COUNTER)) return 0;
  return def->electro.gap_offset + (def->counter.power == 0 ? def->counter.height : 0);
}

double zp_def_roughness(const ZpActuatorDef *def) {
  static const double usual = 2e-6, part = 0.01;
  const double gap = zp_def_gap(def);
  if (!isnan(def->film.roughness)) return def->film.roughness;
  return gap > 0 ? fmin(usual, part * gap) : usual;
}

int zp_def_count(const ZpActuatorDef *def) {
  return zp_def_has(def, ZP_DEVICE_RIGID) ? def->plate.count : 1;
}

bool zp_def_takes_table(const ZpActuatorDef *def) {
  if (!def) return false;
  bool controlled = def->control.kind != ZP_CONTROL_NONE;
  return (controlled ? def->setpoint.waveform : def->drive.waveform) == ZP_WAVEFORM_TABLE;
}

/* Refuse a setpoint that no actuator can reach. */
static ZpStatus check_reach(const ZpActuatorDef *def, ZpError *err) {
  static const double most = 1;
  double value = def->setpoint.value;
  bool moves = def->setpoint.waveform != ZP_WAVEFORM_STEP && def->setpoint.waveform != ZP_WAVEFORM_TABLE;
  double low = moves ? fmin(value, def->setpoint.offset) : value,
         high = moves ? fmax(value, def->setpoint.offset) : value;
  ZpControlSignal signal = def->control.signal;
  if (def->setpoint.waveform == ZP_WAVEFORM_TABLE) return ZP_OK;
  if (signal == ZP_CONTROL_CONTRACTION && high > most)
    return zp_fail(err, ZP_BAD_INPUT, "setpoint.value = %g: a contraction is at most %g", high, most);
  if ((signal == ZP_CONTROL_OPENING || signal == ZP_CONTROL_CAPACITANCE) && low < 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "setpoint.value = %g: must be at least 0, because control.signal = %s is never negative", low,
                   words_of_ZpControlSignal[signal].word);
  return ZP_OK;
}

static ZpStatus check_control(const ZpActuatorDef *def, ZpError *err) {
  static const double periods = 8, most = 1e6; /* largest delay in periods; largest number of samples in a run */
  if (def->control.kind == ZP_CONTROL_NONE) return ZP_OK;
  double period = def->control.period;
  if (def->control.delay > periods * period)
    return zp_fail(err, ZP_BAD_INPUT, "control.delay = %g s: at most %g periods, %g s", def->control.delay, periods,
                   periods * period);
  if (period > def->solver.end_time)
    return zp_fail(err, ZP_BAD_INPUT, "control.period = %g s: longer than the run, solver.end_time = %g s", period,
                   def->solver.end_time);
  if (def->solver.end_time > most * period)
    return zp_fail(err, ZP_BAD_INPUT, "control.period = %g s: more than %g samples until solver.end_time = %g s",
                   period, most, def->solver.end_time);
  return check_reach(def, err);
}

ZpStatus zp_check_mass(const ZpActuatorDef *def, ZpError *err) {
  const bool given = zp_def_has(def, ZP_DEVICE_RIGID) && !isnan(def->plate.mass);
  if (given && def->plate.mass == 0)
    return zp_fail(err, ZP_BAD_INPUT, "plate.mass = 0 kg: a moving plate needs a mass");
  if (given) return ZP_OK;
  ZpActuatorDef room;
  const ZpActuatorDef *of[] = {def, zp_def_lower(def, &room)};
  static const char *const key[] = {"ribbon.density", "lower.ribbon.density"};
  for (int k = 0; k < 2; k++)
    if (of[k]->ribbon.density == 0 &&
        (isnan(of[k]->insulator.thickness) || of[k]->insulator.density * of[k]->insulator.thickness == 0))
      return zp_fail(err, ZP_BAD_INPUT, "%s = 0 kg/m3: a moving ribbon needs a mass", key[k]);
  return ZP_OK;
}

ZpStatus zp_def_check_motion(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_there(def, err);
  if (status == ZP_OK) status = zp_rule_fail(zp_rule_refusing(true, def), "motion ", def, err);
  if (status == ZP_OK) status = zp_check_motion_of_bodies(def, err);
  return status == ZP_OK ? zp_check_mass(def, err) : status;
}

/* Two ribbons touch at their joint; one over a counter electrode touches at its clamp if its gap there is 0, otherwise
 * only beyond pull-in. */
ZpStatus zp_def_check_voltage(const ZpActuatorDef *def, double voltage, ZpError *err) {
  ZpStatus ours = check_there(def, err);
  if (ours != ZP_OK) return ours;
  if (zp_def_members(def) > 1) return zp_check_members_voltage(def, voltage, err);
  if (def->source.model == ZP_SOURCE_AMPLIFIER && fabs(voltage) > def->source.voltage_limit)
    return zp_fail(err, ZP_BAD_INPUT, "drive.voltage: %g V exceeds source.voltage_limit = %g V", voltage,
                   def->source.voltage_limit);
  bool touches = zp_def_has(def, ZP_DEVICE_PAIR) || (zp_def_has(def, ZP_DEVICE_COUNTER) && zp_def_gap(def) == 0);
  if (voltage == 0 || !zp_def_shorts(def) || !touches) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "insulator.thickness = 0 m: %g V is a short circuit, because the electrodes touch at the %s; give an "
                 "insulator, or 0 V",
                 voltage, zp_device_of(def->actuator.kind)->touches);
}

ZpStatus zp_check_bead(const ZpActuatorDef *def, ZpError *err) {
  ZpActuatorDef wet = *def;
  wet.liquid.model = ZP_LIQUID_BEAD;
  return zp_rule_fail(zp_rule_against(ZP_KEY(liquid.model), ZP_LIQUID_BEAD, def), "", &wet, err);
}

ZpLiquidModel zp_def_liquid(const ZpActuatorDef *def) {
  if (!def) return ZP_LIQUID_NONE;
  if (def->liquid.model != ZP_LIQUID_AUTO) return def->liquid.model;
  if (def->medium.density == 0) return ZP_LIQUID_NONE;
  if (zp_def_has(def, ZP_DEVICE_RIGID)) return ZP_LIQUID_SUBMERGED;
  if (def->medium.mean_free_path > 0) return ZP_LIQUID_NONE; /* no beads of a gas */
  if (def->electro.edges || !isnan(def->insulator.resistivity) || !isnan(def->medium.resistivity))
    return ZP_LIQUID_NONE; /* edges and leakage are in a bath unless the scenario asks for a bead */
  return zp_rule_against(ZP_KEY(liquid.model), ZP_LIQUID_BEAD, def) ? ZP_LIQUID_NONE : ZP_LIQUID_BEAD;
}

/* A reading takes whole periods, and a period whole samples. */
static ZpStatus check_meter(const ZpActuatorDef *def, ZpError *err) {
  static const double fewest = 4, most = 1e8; /* samples in a period; samples in a run */
  double samples = def->sense.sampling_rate / def->sense.frequency;
  if (isnan(def->sense.frequency)) return ZP_OK;
  if (samples < fewest || fabs(samples - round(samples)) > 1e-9 * samples)
    return zp_fail(err, ZP_BAD_INPUT,
                   "sense.sampling_rate = %g Hz: must be a whole multiple, at least %g, of sense.frequency = %g Hz",
                   def->sense.sampling_rate, fewest, def->sense.frequency);
  if (def->sense.sampling_rate * def->solver.end_time > most)
    return zp_fail(err, ZP_BAD_INPUT, "sense.sampling_rate = %g Hz: more than %g samples until solver.end_time = %g s",
                   def->sense.sampling_rate, most, def->solver.end_time);
  if (def->sense.bandwidth > def->sense.frequency / 2)
    return zp_fail(err, ZP_BAD_INPUT, "sense.bandwidth = %g Hz: at most half of sense.frequency = %g Hz",
                   def->sense.bandwidth, def->sense.frequency);
  if (!isnan(def->sense.bits) && def->sense.bits != floor(def->sense.bits))
    return zp_fail(err, ZP_BAD_INPUT, "sense.bits = %g: not a whole number", def->sense.bits);
  return ZP_OK;
}

/* Checks of the mass that is caught or dropped. */
static ZpStatus check_change(const ZpActuatorDef *def, ZpError *err) {
  if (-def->load.change_mass > def->load.mass)
    return zp_fail(err, ZP_BAD_INPUT, "load.change_mass = %g kg: cannot drop more than load.mass = %g kg",
                   def->load.change_mass, def->load.mass);
  return ZP_OK;
}

ZpActuatorDef zp_def_unloaded(const ZpActuatorDef *def) {
  ZpActuatorDef bare = *def;
  bare.load = zp_actuator_def_default().load;
  bare.load.mass = 0;
  bare.load.share = def->load.share;
  bare.load.offset = def->load.offset;
  return bare;
}

/* The halves are mirror images only if gravity is vertical. */
static ZpStatus check_tilt(const ZpActuatorDef *def, ZpError *err) {
  static const double half_turn = 3.14159265358979323846;
  bool mirrored = zp_def_has(def, ZP_DEVICE_PLATFORM) && !zp_def_has(def, ZP_DEVICE_RIGID) &&
                  def->actuator.symmetry == ZP_SYMMETRY_HALF;
  double tilt = fabs(def->mount.tilt);
  if (!mirrored || tilt < zp_tilt_rounding || half_turn - tilt < zp_tilt_rounding) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "mount.tilt = %g degree: requires actuator.symmetry none, but it is half; the halves are mirror "
                 "images only at 0 and 180 degree",
                 def->mount.tilt * 180 / half_turn);
}

/* Checks of the place of the load. */
static ZpStatus check_offset(const ZpActuatorDef *def, ZpError *err) {
  double most = zp_platform_length(def) / 2, offset = def->load.offset;
  const double side = def->ribbon.width / 2;
  if (fabs(def->load.across) > side)
    return zp_fail(err, ZP_BAD_INPUT, "load.across = %g m: beside the ribbon; allowed are %g to %g m", def->load.across,
                   -side, side);
  if (fabs(offset) <= most) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "load.offset = %g m: outside the platform; allowed are %g to %g m", offset, -most,
                 most);
}

/* Is this clearly a value in its range, or an empty text? A quick test for all keys of every case; any other value gets
 * the full check. */
static bool is_in_range(const ZpActuatorDef *def, const ZpKey *key) {
  if (key->type == ZP_KEY_TEXT) return *((const char *)def + offset_of(key)) == 0;
  const double value = number_of(def, key);
  return (value >= key->min && value <= key->max) || (key->type == ZP_KEY_REAL_AUTO && isnan(value));
}

/* Keys of members and so on have been checked when they were set. */
static ZpStatus check_fields(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int i = 0; i < KEY_COUNT && status == ZP_OK; i++) {
    if (offset_of(&keys[i]) == NO_FIELD || is_in_range(def, &keys[i]) || zp_key_is_row(i)) continue;
    status = keys[i].type == ZP_KEY_TEXT ? check_text(&keys[i], (const char *)def + offset_of(&keys[i]), err)
                                         : check_value(i, zp_def_get(def, i), err);
  }
  return status;
}

/* Two faces that touch without an insulator and without a limit of the field. */
static ZpStatus check_bare(const ZpActuatorDef *def, ZpError *err) {
  double offset = def->electro.insulator_offset;
  bool bare = isnan(offset) || zp_def_has(def, ZP_DEVICE_RIGID) ? zp_def_shorts(def) : offset == 0;
  if (!zp_def_has(def, ZP_DEVICE_PAIR) || !bare || def->electro.breakdown_cap) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "insulator.thickness = 0 m: requires electro.breakdown_cap true; otherwise the force between bare "
                 "faces that touch is infinite");
}

/* Checks of a counter electrode with a shape. */
static ZpStatus check_counter(const ZpActuatorDef *def, ZpError *err) {
  const double height = def->counter.height, least = -def->electro.gap_offset, steepest = 1;
  const double slope = fabs(height) * fmax(def->counter.power, 1) / def->ribbon.length;
  if (height < least)
    return zp_fail(
        err, ZP_BAD_INPUT,
        "counter.height = %g m: the counter electrode cuts the ribbon; with electro.gap_offset = %g m give at "
        "least %g m",
        height, def->electro.gap_offset, least + 0.0); /* no -0 */
  if (def->counter.power > 0 && slope > steepest)
    return zp_fail(err, ZP_BAD_INPUT,
                   "counter.height = %g m: the counter electrode is too steep for a ribbon to lie on it; with "
                   "ribbon.length = %g m and counter.power = %g at most %g m",
                   height, def->ribbon.length, def->counter.power, height * steepest / slope);
  if (def->electro.edges && zp_def_has(def, ZP_DEVICE_COUNTER) && zp_insulation(def) == 0 && zp_def_gap(def) == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.edges = true: requires an insulator where the faces touch at the clamp; the field at the "
                   "edges of bare faces that touch is infinite");
  return ZP_OK;
}

/* Films that hold the volume, with electrodes on a part of them. */
static ZpStatus check_pouch(const ZpActuatorDef *def, ZpError *err) {
  static const double longest = 0.95;
  const double length = def->ribbon.length, open = length - def->pouch.electrode_length;
  const double most = length * length / (open * open); /* a circle */
  const double upright = 1.5707963267948966 * (1 + 1e-12);
  if (!zp_def_has(def, ZP_DEVICE_POUCH))
    return isnan(def->insulator.thickness)
               ? zp_fail(err, ZP_BAD_INPUT,
                         "insulator.thickness = auto: requires actuator.kind pouch, whose film is "
                         "its own insulator; give a thickness")
               : ZP_OK;
  if (def->pouch.electrode_length > longest * length)
    return zp_fail(err, ZP_BAD_INPUT,
                   "pouch.electrode_length = %g m: the electrodes leave no room for the liquid; at most %g of "
                   "ribbon.length = %g m",
                   def->pouch.electrode_length, longest, length);
  if (def->load.force + def->load.mass * def->gravity < 0 || fabs(def->mount.tilt) > upright)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%s: the films of actuator.kind = pouch do not bear a load that pushes; give a load that pulls, and "
                   "mount.tilt from -90 to 90 degree",
                   fabs(def->mount.tilt) > upright ? "mount.tilt" : "load.force");
  if (def->pouch.fill > most)
    return zp_fail(err, ZP_BAD_INPUT,
                   "pouch.fill = %g: the films cannot hold that much liquid; at most %g, a pouch that is round",
                   def->pouch.fill, most);
  return ZP_OK;
}

/* Checks of lengths and numbers of nodes. */
static ZpStatus check_sizes(const ZpActuatorDef *def, ZpError *err) {
  const bool rigid = zp_def_has(def, ZP_DEVICE_RIGID);
  if (zp_def_has(def, ZP_DEVICE_PLATFORM) && !rigid && def->platform.length > 0.9 * def->ribbon.length)
    return zp_fail(err, ZP_BAD_INPUT, "platform.length = %g m: at most 0.9 of ribbon.length, %g m",
                   def->platform.length, 0.9 * def->ribbon.length);
  if (zp_def_has(def, ZP_DEVICE_PAIR) && def->contact.complete_margin > def->mesh.nodes - 2)
    return zp_fail(err, ZP_BAD_INPUT, "contact.complete_margin = %d: at most mesh.nodes - 2 = %d",
                   def->contact.complete_margin, def->mesh.nodes - 2);
  return ZP_OK;
}

/* The stops of a plate are between its place without voltage and the electrodes. */
static ZpStatus check_plate(const ZpActuatorDef *def, ZpError *err) {
  if (!zp_def_has(def, ZP_DEVICE_RIGID)) return ZP_OK;
  if (def->plate.stop_gap >= def->plate.gap)
    return zp_fail(err, ZP_BAD_INPUT, "plate.stop_gap = %g m: must be below plate.gap = %g m", def->plate.stop_gap,
                   def->plate.gap);
  if (isnan(def->plate.back_gap)) return ZP_OK;
  if (def->plate.back_stop_gap >= def->plate.back_gap)
    return zp_fail(err, ZP_BAD_INPUT, "plate.back_stop_gap = %g m: must be below plate.back_gap = %g m",
                   def->plate.back_stop_gap, def->plate.back_gap);
  if (zp_insulation(def) == 0 && def->plate.back_stop_gap == 0)
    return zp_fail(
        err, ZP_BAD_INPUT,
        "plate.back_stop_gap = 0 m: without an insulator the plate would touch the electrode behind it; give "
        "a stop below plate.back_gap = %g m",
        def->plate.back_gap);
  return ZP_OK;
}

/* Does this build have the two-dimensional field, where it is asked for? */
static ZpStatus check_build(const ZpActuatorDef *def, ZpError *err) {
#ifdef ZP_WITHOUT_FIELD
  if (def->electro.model == ZP_ELECTRO_FIELD)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.model = field: this build does not include the two-dimensional field; use plates");
  if (def->electro.edges)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.edges = true: this build does not include the two-dimensional field, from which the edges "
                   "are computed");
#else
  (void)def, (void)err;
#endif
  return ZP_OK;
}

/* Checks of numbers that depend on each other, in the order in which they are asked: of the mass that members of a
 * stack share before those of the members. */
static ZpStatus (*const checks[])(const ZpActuatorDef *def, ZpError *err) = {
    check_build,  check_sizes,    check_counter, check_plate, check_pouch,     check_bare,    zp_check_ribbons,
    check_change, zp_check_stack, check_offset,  check_tilt,  check_waveforms, check_control, check_meter};

ZpStatus zp_def_check(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_there(def, err);
  if (status == ZP_OK) status = check_fields(def, err);
  if (status == ZP_OK) status = zp_rule_fail(zp_rule_refusing(false, def), "", def, err);
  for (size_t k = 0; k < sizeof checks / sizeof checks[0] && status == ZP_OK; k++)
    status = checks[k](def, err);
  return status;
}
