/* The table of keys, made from keys.def, and its functions: defaults, presets, checks. */
#include <zipact/def.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"

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

#define OFFSET(path, name) offsetof(ZpActuatorDef, path name)
#define ZP_GROUP(group)
#define ZP_GROUP_END(group)
#define ZP_REAL(path, name, unit, shown, def, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL, unit, shown, def, min, max, help, NULL, OFFSET(path, name), NULL},
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help)                                                \
  {#path #name, ZP_KEY_REAL, unit, shown, def, min, max, help, NULL, OFFSET(path, field), NULL},
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL_AUTO, unit, shown, NAN, min, max, help, NULL, OFFSET(path, name), "auto"},
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)                                                          \
  {#path #name, ZP_KEY_REAL_AUTO, unit, shown, NAN, min, max, help, NULL, OFFSET(path, name), "none"},
#define ZP_INT(path, name, def, min, max, help)                                                                        \
  {#path #name, ZP_KEY_INT, "1", "", def, min, max, help, NULL, OFFSET(path, name), NULL},
#define ZP_BOOL(path, name, def, help)                                                                                 \
  {#path #name, ZP_KEY_BOOL, "1", "", def, 0, 1, help, NULL, OFFSET(path, name), NULL},
#define ZP_ENUM(path, name, type, def, help)                                                                           \
  {#path #name, ZP_KEY_ENUM, "1", "", def, 0, type##_COUNT - 1, help, words_of_##type, OFFSET(path, name), NULL},
#define ZP_TEXT(path, name, def, help)                                                                                 \
  {#path #name, ZP_KEY_TEXT, "1", "", NAN, 0, ZP_TEXT_SIZE - 1, help, NULL, OFFSET(path, name), def},
#define ZP_OF_SCENARIO(name, type, def, help)                                                                          \
  {#name, ZP_KEY_ENUM, "1", "", def, 0, type##_COUNT - 1, help, words_of_##type, ZP_NO_FIELD, NULL},
static const ZpKey keys[] = {
#include <zipact/keys.def>
};

enum { KEY_COUNT = sizeof keys / sizeof keys[0] };

/* Values that a kind or a preset sets, for one number of nodes or (nodes 0) for any. */
typedef struct PresetValue {
  int selector; /* ZpActuatorKind or ZpPreset */
  const char *key;
  int nodes;
  double value;
} PresetValue;

#define ZP_KIND_VALUE(kind, key, value) {kind, key, 0, value},
#define ZP_SUPPLY_VALUE(supply, key, value)
#define ZP_PRESET_VALUE(preset, key, value)
#define ZP_PRESET_AT(preset, key, nodes, value)
static const PresetValue kind_values[] = {
#include <zipact/presets.def>
};
#undef ZP_KIND_VALUE
#undef ZP_SUPPLY_VALUE
#define ZP_KIND_VALUE(kind, key, value)
#define ZP_SUPPLY_VALUE(supply, key, value) {supply, key, 0, value},
static const PresetValue supply_values[] = {
#include <zipact/presets.def>
};
#undef ZP_SUPPLY_VALUE
#undef ZP_PRESET_VALUE
#undef ZP_PRESET_AT
#define ZP_SUPPLY_VALUE(supply, key, value)
#define ZP_PRESET_VALUE(preset, key, value)     {preset, key, 0, value},
#define ZP_PRESET_AT(preset, key, nodes, value) {preset, key, nodes, value},
static const PresetValue preset_values[] = {
#include <zipact/presets.def>
};
#undef ZP_KIND_VALUE
#undef ZP_SUPPLY_VALUE
#undef ZP_PRESET_VALUE
#undef ZP_PRESET_AT

#define ZP_STRIP(material, name, value, spread, source) {material, name, value, spread, source},
#define ZP_INSULATOR(material, name, value, spread, source)
#define ZP_MEDIUM(material, name, value, spread, source)
static const ZpMaterialValue strip_values[] = {
#include <zipact/materials.def>
};
#define ZP_STRIP(material, name, value, spread, source)
#define ZP_INSULATOR(material, name, value, spread, source) {material, name, value, spread, source},
#define ZP_MEDIUM(material, name, value, spread, source)
static const ZpMaterialValue insulator_values[] = {
#include <zipact/materials.def>
};
#define ZP_STRIP(material, name, value, spread, source)
#define ZP_INSULATOR(material, name, value, spread, source)
#define ZP_MEDIUM(material, name, value, spread, source) {material, name, value, spread, source},
static const ZpMaterialValue medium_values[] = {
#include <zipact/materials.def>
};

enum {
  KIND_VALUES = sizeof kind_values / sizeof kind_values[0],
  SUPPLY_VALUES = sizeof supply_values / sizeof supply_values[0],
  PRESET_VALUES = sizeof preset_values / sizeof preset_values[0]
};

int zp_key_count(void) {
  return KEY_COUNT;
}

const ZpKey *zp_key(int index) {
  return &keys[index];
}

int zp_key_find(const char *name) {
  for (int i = 0; i < KEY_COUNT; i++) /* called some twenty times per case; most names differ in the first letter */
    if (keys[i].name[0] == name[0] && strcmp(keys[i].name, name) == 0) return i;
  return -1;
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

const char *zp_key_nearest(const char *name) {
  const char *nearest = keys[0].name;
  int least = 1000;
  for (int i = 0; i < KEY_COUNT; i++) {
    int distance = zp_key_distance(name, keys[i].name);
    if (distance < least) {
      least = distance;
      nearest = keys[i].name;
    }
  }
  bool alike = 4 * least <= (int)strlen(name);
  const char *first = alike ? NULL : first_of_group(name);
  return first ? first : nearest;
}

int zp_key_choice(int index, const char *word) {
  const ZpKey *key = &keys[index];
  for (int i = 0; key->choices && i <= (int)key->max; i++)
    if (strcmp(key->choices[i].word, word) == 0) return i;
  return -1;
}

static bool has_field(const ZpKey *key) {
  return key->offset != ZP_NO_FIELD;
}

/* Write a value, which has been checked, into its field. */
static void store(ZpActuatorDef *def, const ZpKey *key, double value) {
  void *field = (char *)def + key->offset;
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

static ZpActuatorDef defaults(void) {
  ZpActuatorDef def;
  memset(&def, 0, sizeof def);
  def.layout = zp_def_layout();
  for (int i = 0; i < KEY_COUNT; i++)
    if (keys[i].type == ZP_KEY_TEXT)
      memcpy((char *)&def + keys[i].offset, keys[i].text, strlen(keys[i].text));
    else if (has_field(&keys[i]))
      store(&def, &keys[i], keys[i].def);
  return def;
}

/* To be called before any field but the first is read. */
static bool is_ours(const ZpActuatorDef *def) {
  return def->layout == zp_def_layout();
}

static ZpStatus check_layout(const ZpActuatorDef *def, ZpError *err) {
  if (is_ours(def)) return ZP_OK;
  return zp_fail(
      err, ZP_BAD_INPUT,
      "ZpActuatorDef does not match this library, zipact %s: either the program was compiled with headers of another "
      "version, or it did not start from zp_actuator_def_default; compile it again with the headers of this library",
      ZP_VERSION);
}

/* The value of a key that has a field; NAN for a text. */
static double number_of(const ZpActuatorDef *def, const ZpKey *key) {
  const void *field = (const char *)def + key->offset;
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

double zp_def_get(const ZpActuatorDef *def, int index) {
  const ZpKey *key = &keys[index];
  return is_ours(def) && has_field(key) ? number_of(def, key) : (double)NAN;
}

const char *zp_def_text(const ZpActuatorDef *def, int index) {
  return is_ours(def) && keys[index].type == ZP_KEY_TEXT ? (const char *)def + keys[index].offset : NULL;
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
  const ZpKey *key = &keys[index];
  if (key->type != ZP_KEY_TEXT) return zp_fail(err, ZP_BAD_INPUT, "%s: takes a number, not a text", key->name);
  ZpStatus status = check_layout(def, err);
  if (status == ZP_OK) status = check_text(key, text, err);
  if (status != ZP_OK) return status;
  char *field = (char *)def + key->offset;
  memset(field, 0, ZP_TEXT_SIZE);
  memcpy(field, text, strlen(text) + 1);
  return ZP_OK;
}

static ZpStatus refuse_range(const ZpKey *key, double value, ZpError *err) {
  const char *unit = strcmp(key->unit, "1") == 0 ? "" : key->unit;
  const char *space = *unit ? " " : "";
  return zp_fail(err, ZP_BAD_INPUT, "%s = %g%s%s: out of range; %g to %g%s%s", key->name, value, space, unit, key->min,
                 key->max, space, unit);
}

static ZpStatus check_value(const ZpKey *key, double value, ZpError *err) {
  if (key->type == ZP_KEY_TEXT) return zp_fail(err, ZP_BAD_INPUT, "%s: takes a text, not a number", key->name);
  if (key->type == ZP_KEY_REAL_AUTO && isnan(value)) return ZP_OK;
  if (!isfinite(value)) return zp_fail(err, ZP_BAD_INPUT, "%s: not a finite number", key->name);
  bool whole = key->type != ZP_KEY_REAL && key->type != ZP_KEY_REAL_AUTO;
  if (whole && value != floor(value))
    return zp_fail(err, ZP_BAD_INPUT, "%s = %g: not a whole number", key->name, value);
  return value < key->min || value > key->max ? refuse_range(key, value, err) : ZP_OK;
}

ZpStatus zp_def_set(ZpActuatorDef *def, int index, double value, ZpError *err) {
  ZpStatus status = check_layout(def, err);
  if (status == ZP_OK) status = check_value(&keys[index], value, err);
  if (status == ZP_OK && !has_field(&keys[index]))
    return zp_fail(err, ZP_BAD_INPUT, "%s: is a key of a scenario, not of a ZpActuatorDef", keys[index].name);
  if (status == ZP_OK) store(def, &keys[index], value);
  return status;
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

/* Apply the values of a preset, including those for `nodes`. */
static void apply_preset(ZpActuatorDef *def, ZpPreset preset, int nodes) {
  for (int i = 0; i < PRESET_VALUES; i++) {
    const PresetValue *p = &preset_values[i];
    if (p->selector == (int)preset && (p->nodes == 0 || p->nodes == nodes))
      store(def, &keys[zp_key_find(p->key)], p->value);
  }
}

/* Apply those of `count` values that belong to `selector`. */
static void apply_values(ZpActuatorDef *def, const PresetValue *value, int count, int selector) {
  for (int i = 0; i < count; i++)
    if (value[i].selector == selector) store(def, &keys[zp_key_find(value[i].key)], value[i].value);
}

#define VALUES_OF(array) array, sizeof(array) / sizeof(array)[0]

/* Groups that a material fills: the prefix of their keys, the key that names the material, and the table of values. */
typedef struct MaterialGroup {
  const char *prefix;
  size_t offset;
  const ZpMaterialValue *value;
  size_t values;
} MaterialGroup;

static const MaterialGroup material_groups[] = {
    {"ribbon.", offsetof(ZpActuatorDef, ribbon.material), VALUES_OF(strip_values)},
    {"insulator.", offsetof(ZpActuatorDef, insulator.material), VALUES_OF(insulator_values)},
    {"medium.", offsetof(ZpActuatorDef, medium.material), VALUES_OF(medium_values)},
    {"lower.ribbon.", offsetof(ZpActuatorDef, lower.ribbon.material), VALUES_OF(strip_values)},
    {"lower.insulator.", offsetof(ZpActuatorDef, lower.insulator.material), VALUES_OF(insulator_values)},
};

static const MaterialGroup *material_group_of(const char *key) {
  for (size_t g = 0; g < sizeof material_groups / sizeof material_groups[0]; g++)
    if (strncmp(key, material_groups[g].prefix, strlen(material_groups[g].prefix)) == 0) return &material_groups[g];
  return NULL;
}

/* A resistivity would add the law of leakage, which not every model supports: it is listed in the table, but the user
 * must set it. */
static bool is_filled(const char *name) {
  return strcmp(name, "resistivity") != 0;
}

bool zp_key_is_material(int index) {
  const char *last = strrchr(keys[index].name, '.');
  return last && strcmp(last, ".material") == 0;
}

static int material_of(const ZpActuatorDef *def, const MaterialGroup *group) {
  int material;
  memcpy(&material, (const char *)def + group->offset, sizeof material);
  return material;
}

const ZpMaterialValue *zp_material_value(const ZpActuatorDef *def, int index) {
  const MaterialGroup *group = is_ours(def) ? material_group_of(keys[index].name) : NULL;
  if (!group) return NULL;
  int material = material_of(def, group);
  const char *name = keys[index].name + strlen(group->prefix);
  for (size_t i = 0; i < group->values; i++)
    if (group->value[i].material == material && strcmp(group->value[i].name, name) == 0)
      return is_filled(name) ? &group->value[i] : NULL;
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

ZpStatus zp_def_fill(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err) {
  const ZpActuatorDef plain = defaults();
  ZpActuatorDef given = plain;
  ZpStatus status = check_layout(def, err);
  if (status == ZP_OK) status = apply_assignments(&given, list, count, err);
  if (status == ZP_OK) status = check_preset_complete(given.preset, given.mesh.nodes, list, count, err);
  if (status != ZP_OK) return status;

  ZpActuatorDef with_preset = plain;
  apply_preset(&with_preset, given.preset, given.mesh.nodes);
  ZpActuatorKind kind =
      is_given(zp_key_find("actuator.kind"), list, count) ? given.actuator.kind : with_preset.actuator.kind;

  *def = plain;
  apply_values(def, kind_values, KIND_VALUES, (int)kind);
  apply_preset(def, given.preset, given.mesh.nodes);
  apply_values(def, supply_values, SUPPLY_VALUES, (int)given.source.supply);
  apply_materials(def, &given);
  return apply_assignments(def, list, count, err);
}

const char *zp_word_of(const char *key, int choice) {
  return zp_key(zp_key_find(key))->choices[choice].word;
}

ZpStatus zp_check_insulator_of_field(const ZpActuatorDef *def, ZpError *err) {
  static const double thinnest = 1e-6; /* then a nanometre changes the force by 0.2 % */
  if (def->insulator.thickness >= thinnest) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "insulator.thickness = %g m: electro.model field needs at least %g m, because its grid keeps closed "
                 "faces a nanometre "
                 "apart",
                 def->insulator.thickness, thinnest);
}

/* Is the two-dimensional field in this build? */
#ifdef ZP_WITHOUT_FIELD
static const bool knows_field = false;
#else
static const bool knows_field = true;
#endif

/* Conditions of electro.model field on other keys. */
static ZpStatus check_field(const ZpActuatorDef *def, ZpError *err) {
  if (!knows_field)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.model = field: this build does not include the two-dimensional field; use plates");
  if (def->actuator.kind != ZP_KIND_ELECTRO_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.model = field: requires actuator.kind electro_ribbon; use plates, which is accurate within "
                   "1 %% if the gap changes slowly along the ribbon");
  if (def->electro.surface != ZP_SURFACE_POLYLINE)
    return zp_fail(err, ZP_BAD_INPUT, "electro.model = field: requires electro.surface polyline");
  if (def->insulator.thickness == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "insulator.thickness = 0 m: electro.model field requires an insulator between faces that touch");
  ZpStatus status = zp_check_like_sections(def, "electro.model = field", err);
  return status == ZP_OK ? zp_check_insulator_of_field(def, err) : status;
}

static const ZpKeyGroup drive = ZP_KEY_GROUP(drive), setpoint = ZP_KEY_GROUP(setpoint), control = ZP_KEY_GROUP(control),
                        source = ZP_KEY_GROUP(source);

/* The name without its group and point. */
static const char *name_in(int key, ZpKeyGroup group) {
  return keys[key].name + strlen(group.name) + 1;
}

static int key_in(ZpKeyGroup group, const char *name) {
  for (int i = group.first; i < group.end; i++)
    if (strcmp(name_in(i, group), name) == 0) return i;
  return -1;
}

static double value_in(const ZpActuatorDef *def, ZpKeyGroup group, const char *name) {
  return zp_def_get(def, key_in(group, name));
}

/* Does a key differ from its default? */
static bool is_set(const ZpActuatorDef *def, int key) {
  const char *text = zp_def_text(def, key);
  double value = text ? 0 : zp_def_get(def, key);
  return text ? *text != 0 : value != keys[key].def && !(isnan(value) && isnan(keys[key].def));
}

static ZpStatus check_square(const ZpActuatorDef *def, ZpKeyGroup group, ZpError *err) {
  double duty = value_in(def, group, "duty"), rise_time = value_in(def, group, "rise_time");
  double shorter = fmin(duty, 1 - duty) / value_in(def, group, "frequency");
  if (rise_time <= shorter) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s.rise_time = %g s: longer than the shorter part of the square wave, %g s (%s.duty / %s.frequency)",
                 group.name, rise_time, shorter, group.name, group.name);
}

/* A key of a waveform, and the waveforms that use it. */
typedef struct WaveformKey {
  const char *name, *goes_with;
  bool used[ZpWaveformKind_COUNT];
} WaveformKey;

/* NULL if every waveform uses it */
static const WaveformKey *waveform_key(const char *name) {
  static const WaveformKey of[] = {{"offset", "ramp, sine or square", {0, 1, 1, 1, 0}},
                                   {"rise_time", "ramp or square", {0, 1, 0, 1, 0}},
                                   {"frequency", "sine or square", {0, 0, 1, 1, 0}},
                                   {"duty", "square", {0, 0, 0, 1, 0}},
                                   {"table", "table", {0, 0, 0, 0, 1}},
                                   {"file", "table", {0, 0, 0, 0, 1}}};
  for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
    if (strcmp(name, of[i].name) == 0) return &of[i];
  return NULL;
}

/* A key that the waveform does not use must not be given: either the key or the waveform would be a mistake. */
static ZpStatus check_waveform(const ZpActuatorDef *def, ZpKeyGroup group, ZpWaveformKind kind, ZpError *err) {
  for (int i = group.first; i < group.end; i++) {
    const WaveformKey *key = waveform_key(name_in(i, group));
    if (key && !key->used[kind] && is_set(def, i))
      return zp_fail(err, ZP_BAD_INPUT, "%s: requires %s.waveform %s, but it is %s", keys[i].name, group.name,
                     key->goes_with, words_of_ZpWaveformKind[kind].word);
  }
  if (kind == ZP_WAVEFORM_TABLE && is_set(def, key_in(group, "table")) && is_set(def, key_in(group, "file")))
    return zp_fail(err, ZP_BAD_INPUT, "%s.table: %s.file is given as well; give only one of them", group.name,
                   group.name);
  if (kind == ZP_WAVEFORM_RAMP && value_in(def, group, "rise_time") == 0)
    return zp_fail(err, ZP_BAD_INPUT, "%s.rise_time = 0 s: a ramp needs a rise time above 0; or use %s.waveform step",
                   group.name, group.name);
  return kind == ZP_WAVEFORM_SQUARE ? check_square(def, group, err) : ZP_OK;
}

bool zp_def_takes_table(const ZpActuatorDef *def) {
  bool controlled = def->control.kind != ZP_CONTROL_NONE;
  return (controlled ? def->setpoint.waveform : def->drive.waveform) == ZP_WAVEFORM_TABLE;
}

/* Keys of a controller have no effect without one. */
static ZpStatus check_none_set(const ZpActuatorDef *def, ZpKeyGroup group, ZpError *err) {
  for (int i = group.first; i < group.end; i++)
    if (is_set(def, i))
      return zp_fail(err, ZP_BAD_INPUT, "%s: requires control.kind pi or boost_pi, but it is none", keys[i].name);
  return ZP_OK;
}

static ZpStatus check_no_control(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_none_set(def, setpoint, err);
  return status == ZP_OK ? check_none_set(def, control, err) : status;
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
  if (isnan(value)) return zp_fail(err, ZP_BAD_INPUT, "setpoint.value: missing; control.kind requires it");
  if (signal == ZP_CONTROL_CONTRACTION && high > most)
    return zp_fail(err, ZP_BAD_INPUT, "setpoint.value = %g: a contraction is at most %g", high, most);
  if ((signal == ZP_CONTROL_OPENING || signal == ZP_CONTROL_CAPACITANCE) && low < 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "setpoint.value = %g: must be at least 0, because control.signal = %s is never negative", low,
                   zp_word_of("control.signal", (int)signal));
  return ZP_OK;
}

/* Conditions of a controller on the actuator and on the drive. */
static ZpStatus check_plant(const ZpActuatorDef *def, ZpError *err) {
  bool two = zp_def_has_two(def);
  ZpControlSignal signal = def->control.signal;
  if (def->actuator.kind == ZP_KIND_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT, "control.kind: requires electrodes, which actuator.kind ribbon does not have");
  if (!two && (signal == ZP_CONTROL_OPENING || signal == ZP_CONTROL_CONTRACTION))
    return zp_fail(err, ZP_BAD_INPUT, "control.signal = %s: requires actuator.kind electro_ribbon or hinge; use stroke",
                   zp_word_of("control.signal", (int)signal));
  if (def->drive.waveform != ZP_WAVEFORM_STEP)
    return zp_fail(err, ZP_BAD_INPUT,
                   "drive.waveform = %s: with control.kind the controller sets the voltage, up to drive.voltage; use "
                   "step, and setpoint.waveform for the setpoint over time",
                   zp_word_of("drive.waveform", (int)def->drive.waveform));
  return ZP_OK;
}

static ZpStatus check_control(const ZpActuatorDef *def, ZpError *err) {
  static const double periods = 8, most = 1e6; /* largest delay in periods; largest number of samples in a run */
  if (def->control.kind == ZP_CONTROL_NONE) return check_no_control(def, err);
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
  ZpStatus status = check_plant(def, err);
  if (status == ZP_OK) status = check_waveform(def, setpoint, def->setpoint.waveform, err);
  return status == ZP_OK ? check_reach(def, err) : status;
}

/* Keys of a source that have no effect. */
static ZpStatus check_unused_source(const ZpActuatorDef *def, ZpError *err) {
  static const char *const of_amplifier[] = {"slew_rate",   "current_limit", "sink_limit", "resistance",
                                             "capacitance", "bleeder",       "bandwidth",  "voltage_limit"};
  for (int key = source.first; key < source.end; key++) {
    if (!is_set(def, key)) continue;
    for (size_t i = 0; i < sizeof of_amplifier / sizeof of_amplifier[0]; i++)
      if (strcmp(name_in(key, source), of_amplifier[i]) == 0)
        return zp_fail(err, ZP_BAD_INPUT, "%s: requires source.model amplifier, but it is ideal", keys[key].name);
  }
  return ZP_OK;
}

/* Values with which an amplifier would never charge the electrodes, or faster than time steps resolve. */
static ZpStatus check_amplifier(const ZpActuatorDef *def, ZpError *err) {
  static const double fastest = 1e9; /* Hz: a time constant has a thousand of the shortest steps */
  if (def->source.slew_rate == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "source.slew_rate = 0 V/s: the source would never leave 0 V; give a rate above 0 or none");
  if (def->source.current_limit == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "source.current_limit = 0 A: the source could never charge the electrodes; give a current above 0 "
                   "or none");
  if (def->source.bandwidth > fastest)
    return zp_fail(err, ZP_BAD_INPUT,
                   "source.bandwidth = %g Hz: time steps resolve at most %g Hz; give none for an unlimited bandwidth",
                   def->source.bandwidth, fastest);
  if (def->solver.integrator != ZP_INTEGRATOR_IMPLICIT)
    return zp_fail(err, ZP_BAD_INPUT, "source.model = amplifier: requires solver.integrator implicit");
  if (def->actuator.kind == ZP_KIND_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT,
                   "source.model = amplifier: requires electrodes, which actuator.kind ribbon does not have");
  return ZP_OK;
}

static ZpStatus check_source(const ZpActuatorDef *def, ZpError *err) {
  return def->source.model == ZP_SOURCE_IDEAL ? check_unused_source(def, err) : check_amplifier(def, err);
}

/* Conditions of electro.edges on other keys. */
static ZpStatus check_edges(const ZpActuatorDef *def, ZpError *err) {
  if (!knows_field)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.edges = true: this build does not include the two-dimensional field, from which the edges "
                   "are computed");
  if (def->actuator.kind == ZP_KIND_FLANGE)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.edges: requires actuator.kind electro_ribbon, two strips of the same width; the width of "
                   "a flange's flat electrode is not known");
  if (def->electro.surface != ZP_SURFACE_POLYLINE)
    return zp_fail(err, ZP_BAD_INPUT, "electro.edges: requires electro.surface polyline");
  if (def->insulator.thickness == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "insulator.thickness = 0 m: electro.edges requires an insulator between faces that touch");
  return zp_check_like_sections(def, "electro.edges", err);
}

ZpStatus zp_check_mass(const ZpActuatorDef *def, ZpError *err) {
  ZpActuatorDef lower = zp_def_lower(def);
  const ZpActuatorDef *of[] = {def, &lower};
  static const char *const key[] = {"ribbon.density", "lower.ribbon.density"};
  for (int k = 0; k < 2; k++)
    if (of[k]->ribbon.density == 0 && of[k]->insulator.density * of[k]->insulator.thickness == 0)
      return zp_fail(err, ZP_BAD_INPUT, "%s = 0 kg/m3: a moving ribbon needs a mass", key[k]);
  return ZP_OK;
}

/* Conditions of motion for a flange and a hinge. */
static ZpStatus check_implicit_in_motion(const ZpActuatorDef *def, ZpError *err) {
  if (def->solver.integrator == ZP_INTEGRATOR_EXPLICIT)
    return zp_fail(err, ZP_BAD_INPUT, "actuator.kind = %s: motion requires solver.integrator implicit",
                   zp_word_of("actuator.kind", (int)def->actuator.kind));
  if (def->contact.model == ZP_CONTACT_SEQUENTIAL)
    return zp_fail(err, ZP_BAD_INPUT, "contact.model = sequential: motion requires actuator.kind electro_ribbon");
  if (def->electro.surface == ZP_SURFACE_BEZIER)
    return zp_fail(err, ZP_BAD_INPUT, "electro.surface = bezier: motion requires actuator.kind electro_ribbon");
  return ZP_OK;
}

ZpStatus zp_def_check_motion(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus ours = check_layout(def, err);
  if (ours != ZP_OK) return ours;
  bool implicit = def->solver.integrator == ZP_INTEGRATOR_IMPLICIT, two = def->actuator.kind == ZP_KIND_ELECTRO_RIBBON;
  bool sequential = def->contact.model == ZP_CONTACT_SEQUENTIAL;
  if (def->actuator.kind == ZP_KIND_FLANGE || def->actuator.kind == ZP_KIND_HINGE) {
    ZpStatus status = check_implicit_in_motion(def, err);
    if (status != ZP_OK) return status;
  }
  if (two && sequential && implicit)
    return zp_fail(err, ZP_BAD_INPUT, "contact.model = sequential: requires solver.integrator explicit");
  if (two && !sequential && def->electro.surface == ZP_SURFACE_BEZIER)
    return zp_fail(err, ZP_BAD_INPUT,
                   "electro.surface = bezier: requires contact.model sequential and solver.integrator explicit");
  if (!implicit && def->damping.internal > 0)
    return zp_fail(err, ZP_BAD_INPUT, "damping.internal = %g s: requires solver.integrator implicit",
                   def->damping.internal);
  if (!implicit && def->load.change_mass != 0)
    return zp_fail(err, ZP_BAD_INPUT, "load.change_mass = %g kg: requires solver.integrator implicit",
                   def->load.change_mass);
  if (!implicit && def->ribbon.plasticity)
    return zp_fail(err, ZP_BAD_INPUT, "ribbon.plasticity = true: requires solver.integrator implicit");
  if (def->ribbon.model != ZP_RIBBON_ROD && def->damping.internal > 0)
    return zp_fail(err, ZP_BAD_INPUT, "damping.internal = %g s: requires ribbon.model rod", def->damping.internal);
  return zp_check_mass(def, err);
}

/* Where electrodes touch at rest. */
static const char *touches_at(const ZpActuatorDef *def) {
  switch (def->actuator.kind) {
  case ZP_KIND_ELECTRO_RIBBON:
    return "clip";
  case ZP_KIND_HINGE:
    return "hinge";
  default:
    return "clamp (electro.gap_offset = 0 m)";
  }
}

/* Two ribbons touch at their joint; a flange touches at its clamp if its gap there is 0, otherwise only beyond pull-in.
 */
ZpStatus zp_def_check_voltage(const ZpActuatorDef *def, double voltage, ZpError *err) {
  ZpStatus ours = check_layout(def, err);
  if (ours != ZP_OK) return ours;
  if (zp_def_members(def) > 1) return zp_check_members_voltage(def, voltage, err);
  bool two = zp_def_has_two(def);
  if (def->source.model == ZP_SOURCE_AMPLIFIER && fabs(voltage) > def->source.voltage_limit)
    return zp_fail(err, ZP_BAD_INPUT, "drive.voltage: %g V exceeds source.voltage_limit = %g V", voltage,
                   def->source.voltage_limit);
  bool touches = two || (def->actuator.kind == ZP_KIND_FLANGE && def->electro.gap_offset == 0);
  if (voltage == 0 || zp_insulation(def) > 0 || !touches) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "insulator.thickness = 0 m: %g V is a short circuit, because the electrodes touch at the %s; give an "
                 "insulator, or 0 V",
                 voltage, touches_at(def));
}

static ZpStatus check_initial(const ZpActuatorDef *def, ZpError *err) {
  if (*def->initial.file && def->initial.state != ZP_INITIAL_CHECKPOINT)
    return zp_fail(err, ZP_BAD_INPUT, "initial.file: requires initial.state checkpoint, but it is %s",
                   zp_word_of("initial.state", (int)def->initial.state));
  return ZP_OK;
}

/* A choice that another key requires. */
typedef struct Need {
  const char *key;
  size_t offset; /* offset of its field */
  int word;
} Need;
#define NEED(group, name, word)                                                                                        \
  { #group "." #name, offsetof(ZpActuatorDef, group.name), word }

/* `what` is the key that requires it, `instead` the alternative. */
static ZpStatus check_needs(const ZpActuatorDef *def, const char *what, const Need *needs, size_t count,
                            const char *instead, ZpError *err) {
  for (size_t i = 0; i < count; i++) {
    int given;
    memcpy(&given, (const char *)def + needs[i].offset, sizeof given);
    if (given != needs[i].word)
      return zp_fail(err, ZP_BAD_INPUT, "%s: requires %s %s, but it is %s; use %s", what, needs[i].key,
                     zp_word_of(needs[i].key, needs[i].word), zp_word_of(needs[i].key, given), instead);
  }
  return ZP_OK;
}

/* Conditions of the whole actuator: the numerics of the paper and the computed field support a half only. */
static ZpStatus check_symmetry(const ZpActuatorDef *def, ZpError *err) {
  static const Need needs[] = {
      NEED(actuator, kind, ZP_KIND_ELECTRO_RIBBON), NEED(ribbon, model, ZP_RIBBON_ROD),
      NEED(electro, model, ZP_ELECTRO_PLATES),      NEED(electro, surface, ZP_SURFACE_POLYLINE),
      NEED(contact, model, ZP_CONTACT_UNILATERAL),  NEED(solver, integrator, ZP_INTEGRATOR_IMPLICIT)};
  if (def->actuator.symmetry != ZP_SYMMETRY_NONE) return ZP_OK;
  return check_needs(def, "actuator.symmetry = none", needs, sizeof needs / sizeof needs[0], "actuator.symmetry half",
                     err);
}

/* Conditions of the film of liquid: it lies between two ribbons, and its pressures are unknowns of implicit steps. */
static const Need film_needs[] = {NEED(actuator, kind, ZP_KIND_ELECTRO_RIBBON), NEED(ribbon, model, ZP_RIBBON_ROD),
                                  NEED(electro, surface, ZP_SURFACE_POLYLINE),
                                  NEED(contact, model, ZP_CONTACT_UNILATERAL),
                                  NEED(solver, integrator, ZP_INTEGRATOR_IMPLICIT)};
enum { FILM_NEEDS = sizeof film_needs / sizeof film_needs[0] };

/* Conditions of a bead, beyond which there is air. */
ZpStatus zp_check_bead(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_needs(def, "liquid.model = bead", film_needs, FILM_NEEDS, "liquid.model none", err);
  if (status != ZP_OK) return status;
  if (def->electro.edges)
    return zp_fail(err, ZP_BAD_INPUT,
                   "liquid.model = bead: requires electro.edges false, but it is true: lateral edges are modelled in a "
                   "single liquid only; use liquid.model submerged");
  if (!isnan(def->insulator.resistivity) || !isnan(def->medium.resistivity))
    return zp_fail(err, ZP_BAD_INPUT,
                   "liquid.model = bead: requires %s none: leakage in the air beyond a bead is not modelled; use "
                   "liquid.model none or submerged",
                   isnan(def->insulator.resistivity) ? "medium.resistivity" : "insulator.resistivity");
  return ZP_OK;
}

ZpLiquidModel zp_def_liquid(const ZpActuatorDef *def) {
  if (!is_ours(def)) return ZP_LIQUID_NONE;
  if (def->liquid.model != ZP_LIQUID_AUTO) return def->liquid.model;
  return zp_check_bead(def, NULL) == ZP_OK ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE;
}

static ZpStatus check_liquid(const ZpActuatorDef *def, ZpError *err) {
  switch (zp_def_liquid(def)) {
  case ZP_LIQUID_SUBMERGED:
    return check_needs(def, "liquid.model = submerged", film_needs, FILM_NEEDS, "liquid.model none", err);
  case ZP_LIQUID_BEAD:
    return zp_check_bead(def, err);
  default:
    return ZP_OK;
  }
}

/* Interface charge is modelled with the plates law in implicit steps, for real insulators and a real liquid. */
static ZpStatus check_leak(const ZpActuatorDef *def, ZpError *err) {
  static const Need needs[] = {NEED(electro, model, ZP_ELECTRO_PLATES), NEED(electro, surface, ZP_SURFACE_POLYLINE),
                               NEED(solver, integrator, ZP_INTEGRATOR_IMPLICIT)};
  const char *given = isnan(def->insulator.resistivity) ? "medium.resistivity" : "insulator.resistivity";
  if (isnan(def->insulator.resistivity) && isnan(def->medium.resistivity)) return ZP_OK;
  if (def->actuator.kind == ZP_KIND_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT, "%s: requires electrodes, which actuator.kind ribbon does not have", given);
  if (def->insulator.thickness == 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "insulator.thickness = 0 m: %s requires an insulator, on whose face charge accumulates", given);
  if (def->electro.force_scale != 1 || def->electro.voltage_share != 1 || !isnan(def->electro.insulator_offset))
    return zp_fail(err, ZP_BAD_INPUT,
                   "%s: requires electro.force_scale 1, electro.voltage_share 1 and electro.insulator_offset auto",
                   given);
  if (def->electro.edges)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%s: requires electro.edges false; interface charge at the lateral edges is not modelled", given);
  ZpStatus alike = zp_check_like_insulators(def, given, err);
  return alike == ZP_OK ? check_needs(def, given, needs, sizeof needs / sizeof needs[0], "none", err) : alike;
}

/* A ribbon that yields has a history. A meter and a controller are judged by equilibria of elastic ribbons, which have
 * none. */
static ZpStatus check_plasticity(const ZpActuatorDef *def, ZpError *err) {
  static const Need needs[] = {NEED(ribbon, model, ZP_RIBBON_ROD), NEED(control, kind, ZP_CONTROL_NONE)};
  bool hardens = def->ribbon.hardening_modulus > 0 || def->lower.ribbon.hardening_modulus > 0;
  if (!def->ribbon.plasticity && hardens)
    return zp_fail(err, ZP_BAD_INPUT, "%sribbon.hardening_modulus: requires ribbon.plasticity true",
                   def->ribbon.hardening_modulus > 0 ? "" : "lower.");
  if (!def->ribbon.plasticity) return ZP_OK;
  if (def->ribbon.plane == ZP_PLANE_ANTICLASTIC)
    return zp_fail(err, ZP_BAD_INPUT,
                   "ribbon.plane = anticlastic: ribbon.plasticity requires ribbon.plane strain or stress");
  if (!isnan(def->sense.frequency))
    return zp_fail(err, ZP_BAD_INPUT,
                   "sense.frequency: requires ribbon.plasticity false, because the meter converts its reading by "
                   "equilibria of elastic ribbons");
  return check_needs(def, "ribbon.plasticity = true", needs, sizeof needs / sizeof needs[0], "ribbon.plasticity false",
                     err);
}

/* Refuse keys of a meter without a meter, and a meter without its required keys. */
static ZpStatus check_meter_keys(const ZpActuatorDef *def, ZpError *err) {
  const struct {
    const char *name;
    double value;
    bool needed;
  } of[] = {{"sense.amplitude", def->sense.amplitude, true},
            {"sense.sampling_rate", def->sense.sampling_rate, true},
            {"sense.bits", def->sense.bits, false},
            {"sense.noise", def->sense.noise > 0 ? def->sense.noise : NAN, false}};
  bool on = !isnan(def->sense.frequency);
  for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
    bool given = !isnan(of[i].value);
    if (given && !on) return zp_fail(err, ZP_BAD_INPUT, "%s: requires sense.frequency", of[i].name);
    if (on && of[i].needed && !given)
      return zp_fail(err, ZP_BAD_INPUT, "%s: missing; sense.frequency requires it", of[i].name);
  }
  return ZP_OK;
}

/* A reading takes whole periods, and a period whole samples. */
static ZpStatus check_meter(const ZpActuatorDef *def, ZpError *err) {
  static const double fewest = 4, most = 1e8; /* samples in a period; samples in a run */
  double samples = def->sense.sampling_rate / def->sense.frequency;
  ZpStatus status = check_meter_keys(def, err);
  if (status != ZP_OK || isnan(def->sense.frequency)) return status;
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
  if (def->actuator.kind == ZP_KIND_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT, "sense.frequency: requires electrodes, which actuator.kind ribbon does not have");
  return ZP_OK;
}

/* Checks of the stop that limits the opening. */
static ZpStatus check_stop(const ZpActuatorDef *def, ZpError *err) {
  bool given = def->load.stop_stiffness != keys[zp_key_find("load.stop_stiffness")].def && def->load.stop_stiffness > 0;
  if (isnan(def->load.stop_opening))
    return given ? zp_fail(err, ZP_BAD_INPUT, "load.stop_stiffness: requires load.stop_opening") : ZP_OK;
  if (def->actuator.kind != ZP_KIND_ELECTRO_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT,
                   "load.stop_opening: requires actuator.kind electro_ribbon, because the stop acts on its platforms");
  if (def->contact.model == ZP_CONTACT_SEQUENTIAL)
    return zp_fail(err, ZP_BAD_INPUT, "load.stop_opening: requires contact.model unilateral");
  return ZP_OK;
}

/* Checks of the mass that is caught or dropped. */
static ZpStatus check_change(const ZpActuatorDef *def, ZpError *err) {
  bool timed = !isnan(def->load.change_time);
  if (def->load.change_mass != 0 && !timed)
    return zp_fail(err, ZP_BAD_INPUT, "load.change_time: missing; load.change_mass requires it");
  if (def->load.drop_height > 0 && (def->load.change_mass < 0 || !timed))
    return zp_fail(err, ZP_BAD_INPUT,
                   "load.drop_height: requires a load.change_mass of 0 kg or more that is caught at "
                   "load.change_time");
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
  bool mirrored = def->actuator.kind == ZP_KIND_ELECTRO_RIBBON && def->actuator.symmetry == ZP_SYMMETRY_HALF;
  double tilt = fabs(def->mount.tilt);
  if (!mirrored || tilt < zp_tilt_rounding || half_turn - tilt < zp_tilt_rounding) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "mount.tilt = %g degree: requires actuator.symmetry none, but it is half; the halves are mirror "
                 "images only at 0 and 180 degree",
                 def->mount.tilt * 180 / half_turn);
}

/* Conditions of a platform that turns: the other laws assume that it is horizontal. */
static ZpStatus check_rotates(const ZpActuatorDef *def, ZpError *err) {
  const struct {
    bool acts;
    const char *needed, *reason;
  } refused[] = {
      {def->actuator.symmetry != ZP_SYMMETRY_NONE, "actuator.symmetry none",
       "the platform of a symmetric half is level"},
      {def->platform.length == 0, "platform.length above 0 m", "a platform without length has no angle"},
      {def->platform.electrode, "platform.electrode false",
       "the attraction of platforms is modelled for level ones only"},
      {zp_def_liquid(def) != ZP_LIQUID_NONE, "liquid.model none",
       "the liquid between the platforms is modelled for level ones only"},
      {def->ribbon.plane == ZP_PLANE_ANTICLASTIC, "ribbon.plane strain or stress",
       "the curl across the strip is modelled with level platforms only"},
      {def->ribbon.plasticity, "ribbon.plasticity false", "yielding is modelled with level platforms only"},
      {def->load.stiffness > 0, "load.stiffness 0 N/m", "the spring is modelled for level platforms only"},
      {!isnan(def->load.stop_opening), "load.stop_opening none", "the stop is modelled for level platforms only"},
      {def->load.change_mass != 0, "load.change_mass 0 kg", "the impact is modelled for level platforms only"}};
  for (size_t k = 0; def->platform.rotates && k < sizeof refused / sizeof refused[0]; k++)
    if (refused[k].acts)
      return zp_fail(err, ZP_BAD_INPUT, "platform.rotates = true: requires %s; %s", refused[k].needed,
                     refused[k].reason);
  return ZP_OK;
}

/* Checks of a held clip. */
static ZpStatus check_held_clip(const ZpActuatorDef *def, ZpError *err) {
  if (def->actuator.held_clip == ZP_HELD_NONE || def->platform.rotates) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "actuator.held_clip = %s: requires platform.rotates true; between a held clip and a guided platform "
                 "the ribbons could only stretch",
                 zp_word_of("actuator.held_clip", (int)def->actuator.held_clip));
}

/* Checks of the place of the load. */
static ZpStatus check_offset(const ZpActuatorDef *def, ZpError *err) {
  double most = def->platform.length / 2, offset = def->load.offset;
  if (offset == 0) return ZP_OK;
  if (!def->platform.rotates)
    return zp_fail(
        err, ZP_BAD_INPUT,
        "load.offset = %g m: requires platform.rotates true; on a guided platform the place of the load has no effect",
        offset);
  if (fabs(offset) <= most) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "load.offset = %g m: outside the platform; allowed are %g to %g m", offset, -most,
                 most);
}

/* Checks of the spring in parallel with the load. */
static ZpStatus check_spring(const ZpActuatorDef *def, ZpError *err) {
  if (def->load.stiffness == 0) return ZP_OK;
  if (isnan(def->load.rest_opening))
    return zp_fail(err, ZP_BAD_INPUT, "load.rest_opening: missing; load.stiffness requires it");
  if (def->actuator.kind != ZP_KIND_ELECTRO_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT,
                   "load.stiffness: requires actuator.kind electro_ribbon, because the spring acts on its platforms");
  if (def->contact.model == ZP_CONTACT_SEQUENTIAL)
    return zp_fail(err, ZP_BAD_INPUT, "load.stiffness: requires contact.model unilateral");
  return ZP_OK;
}

/* Checks of the keys of a hinge, and its conditions on other keys. */
static ZpStatus check_hinge(const ZpActuatorDef *def, ZpError *err) {
  static const Need needs[] = {NEED(ribbon, model, ZP_RIBBON_ROD), NEED(electro, surface, ZP_SURFACE_POLYLINE),
                               NEED(contact, model, ZP_CONTACT_UNILATERAL)};
  if (def->actuator.kind == ZP_KIND_HINGE) {
    if (def->hinge.stiffness == 0 && def->hinge.rest_angle != 0)
      return zp_fail(err, ZP_BAD_INPUT, "hinge.rest_angle: requires hinge.stiffness above 0 N m/rad");
    return check_needs(def, "actuator.kind = hinge", needs, sizeof needs / sizeof needs[0],
                       "actuator.kind electro_ribbon", err);
  }
  if (def->hinge.stiffness != 0 || def->hinge.rest_angle != 0)
    return zp_fail(err, ZP_BAD_INPUT, "hinge.%s: requires actuator.kind hinge, but it is %s",
                   def->hinge.stiffness != 0 ? "stiffness" : "rest_angle",
                   zp_word_of("actuator.kind", (int)def->actuator.kind));
  return ZP_OK;
}

/* Checks of the electric model. */
static ZpStatus check_electro(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = def->electro.model == ZP_ELECTRO_FIELD ? check_field(def, err) : ZP_OK;
  return status == ZP_OK && def->electro.edges ? check_edges(def, err) : status;
}

/* Is this clearly a value in its range, or an empty text? A quick test for all keys of every case; any other value gets
 * the full check. */
static bool is_in_range(const ZpActuatorDef *def, const ZpKey *key) {
  if (key->type == ZP_KEY_TEXT) return *((const char *)def + key->offset) == 0;
  double value = number_of(def, key);
  return key->type != ZP_KEY_BOOL && value >= key->min && value <= key->max;
}

static ZpStatus check_fields(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int i = 0; i < KEY_COUNT && status == ZP_OK; i++) {
    if (!has_field(&keys[i]) || is_in_range(def, &keys[i])) continue;
    status = keys[i].type == ZP_KEY_TEXT ? check_text(&keys[i], (const char *)def + keys[i].offset, err)
                                         : check_value(&keys[i], zp_def_get(def, i), err);
  }
  return status;
}

ZpStatus zp_def_check(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus fields = check_layout(def, err);
  if (fields == ZP_OK) fields = check_fields(def, err);
  if (fields != ZP_OK) return fields;
  bool two = zp_def_has_two(def);
  if (def->actuator.kind == ZP_KIND_ELECTRO_RIBBON && def->platform.length > 0.9 * def->ribbon.length)
    return zp_fail(err, ZP_BAD_INPUT, "platform.length = %g m: at most 0.9 of ribbon.length, %g m",
                   def->platform.length, 0.9 * def->ribbon.length);
  double offset = def->electro.insulator_offset;
  bool bare = isnan(offset) ? zp_insulation(def) == 0 : offset == 0;
  if (two && bare && !def->electro.breakdown_cap)
    return zp_fail(err, ZP_BAD_INPUT,
                   "insulator.thickness = 0 m: requires electro.breakdown_cap true; otherwise the force between bare "
                   "faces that touch is infinite");
  if (two && def->contact.complete_margin > def->mesh.nodes - 2)
    return zp_fail(err, ZP_BAD_INPUT, "contact.complete_margin = %d: at most mesh.nodes - 2 = %d",
                   def->contact.complete_margin, def->mesh.nodes - 2);
  if (def->electro.switch_offset > 0 && def->electro.surface != ZP_SURFACE_BEZIER)
    return zp_fail(err, ZP_BAD_INPUT, "electro.switch_offset = %g m: requires electro.surface bezier",
                   def->electro.switch_offset);
  if (def->electro.refresh_period > 0 && def->electro.surface != ZP_SURFACE_BEZIER)
    return zp_fail(err, ZP_BAD_INPUT, "electro.refresh_period = %g s: requires electro.surface bezier",
                   def->electro.refresh_period);
  ZpStatus status = zp_check_ribbons(def, err);
  if (status == ZP_OK) status = zp_check_stack(def, err);
  if (status == ZP_OK) status = check_hinge(def, err);
  if (status == ZP_OK) status = check_rotates(def, err);
  if (status == ZP_OK) status = check_held_clip(def, err);
  if (status == ZP_OK) status = check_offset(def, err);
  if (status == ZP_OK) status = check_spring(def, err);
  if (status == ZP_OK) status = check_stop(def, err);
  if (status == ZP_OK) status = check_change(def, err);
  if (status == ZP_OK) status = check_tilt(def, err);
  if (status == ZP_OK) status = check_waveform(def, drive, def->drive.waveform, err);
  if (status == ZP_OK) status = check_control(def, err);
  if (status == ZP_OK) status = check_source(def, err);
  if (status == ZP_OK) status = check_initial(def, err);
  if (status == ZP_OK) status = check_symmetry(def, err);
  if (status == ZP_OK) status = check_liquid(def, err);
  if (status == ZP_OK) status = check_leak(def, err);
  if (status == ZP_OK) status = check_plasticity(def, err);
  if (status == ZP_OK) status = check_meter(def, err);
  return status == ZP_OK ? check_electro(def, err) : status;
}
