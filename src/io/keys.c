/* The table of keys: as text for people, as JSON for programs, as a scenario to start from, as a JSON schema. */
#include <zipact/io.h>

#include <errno.h>
#include <math.h>
#include <string.h>

#include <jansson.h>

#include "base/fail.h"
#include "def/check.h"
#include "io/names.h"
#include "io/range.h"
#include "io/value.h"
#include "io/yaml.h"

enum { COMMENT_COLUMN = 34 }; /* column of the comments in the starter scenario */

/* The allowed values: a range, or words separated by `between`. */
static void allowed(int index, const char *between, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  if (zp_value_is_number(key)) {
    zp_value_range(index, text, size);
    return;
  }
  if (key->type == ZP_KEY_TEXT) {
    snprintf(text, size, "text");
    return;
  }
  snprintf(text, size, "%s", key->choices ? key->choices[0].word : "true");
  int words = key->choices ? (int)key->max + 1 : 0;
  size_t used = strlen(text);
  if (!words && used < size) snprintf(text + used, size - used, "%sfalse", between);
  for (int i = 1; i < words && (used = strlen(text)) < size; i++)
    snprintf(text + used, size - used, "%s%s", between, key->choices[i].word);
}

/* Widths of the columns before the help. */
typedef struct Widths {
  int name, value, range;
} Widths;

static int longer(int width, const char *text) {
  int length = (int)strlen(text);
  return length > width ? length : width;
}

/* The range column is for numbers; the words of a choice have their own lines. */
static void row_texts(int index, char value[ZP_VALUE_SIZE], char range[ZP_RANGE_SIZE]) {
  zp_value_print(index, zp_key(index)->def, value, ZP_VALUE_SIZE);
  range[0] = 0;
  if (!zp_key(index)->choices) allowed(index, ", ", range, ZP_RANGE_SIZE);
}

static Widths find_widths(void) {
  char value[ZP_VALUE_SIZE], range[ZP_RANGE_SIZE];
  Widths w = {(int)strlen("key"), (int)strlen("default"), (int)strlen("range")};
  for (int i = 0; i < zp_key_count(); i++) {
    row_texts(i, value, range);
    w.name = longer(w.name, zp_key(i)->name);
    w.value = longer(w.value, value);
    w.range = longer(w.range, range);
  }
  return w;
}

static void write_text(FILE *file) {
  char value[ZP_VALUE_SIZE], range[ZP_RANGE_SIZE];
  Widths w = find_widths();
  fprintf(file, "%-*s  %-*s  %-*s  help\n", w.name, "key", w.value, "default", w.range, "range");
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    row_texts(i, value, range);
    fprintf(file, "%-*s  %-*s  %-*s  %s\n", w.name, key->name, w.value, value, w.range, range, key->help);
    for (int j = 0; key->choices && j <= (int)key->max; j++)
      fprintf(file, "%*s    %s: %s\n", w.name, "", key->choices[j].word, key->choices[j].help);
  }
}

static void write_yaml(FILE *file) {
  char value[ZP_VALUE_SIZE], range[ZP_VALUE_SIZE];
  const char *before = NULL;
  fputs("# A scenario with every key at its default. Keep the lines that you change and delete the others:\n# a line "
        "in this file overrides a preset.\n",
        file);
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    zp_value_print(i, key->def, value, sizeof value);
    allowed(i, " | ", range, sizeof range);
    if (zp_key_is_row(i)) {
      int shown = fprintf(file, "# %s: ", key->name);
      fprintf(file, "%s%*s  # %s (%s)\n", value, longer(COMMENT_COLUMN - shown, value) - (int)strlen(value), "",
              key->help, range);
      continue;
    }
    int width = zp_yaml_write_key(file, key->name, before);
    fprintf(file, "%s%*s  # %s (%s)\n", value, longer(COMMENT_COLUMN - width, value) - (int)strlen(value), "",
            key->help, range);
    before = key->name;
  }
}

/* -- as JSON --------------------------------------------------------------------------------------- */

/* A failure: free the tree. */
static void drop(json_t **tree) {
  json_decref(*tree);
  *tree = NULL;
}

/* Put a member into an object, or an item into a list, which takes ownership of it. If there is no memory for one of
 * them, both are freed and the object or list becomes NULL: so a tree that is not NULL is complete. */
static void set(json_t **object, const char *name, json_t *value) {
  if (json_object_set_new(*object, name, value)) drop(object);
}

static void add(json_t **list, json_t *value) {
  if (json_array_append_new(*list, value)) drop(list);
}

static json_t *json_of_value(int index, double value) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_TEXT || (key->type == ZP_KEY_REAL_AUTO && isnan(value))) return json_string(key->text);
  if (key->type == ZP_KEY_BOOL) return json_boolean(value != 0);
  if (key->type == ZP_KEY_ENUM) return json_string(key->choices[(int)value].word);
  if (!isfinite(value)) return json_null();
  return key->type == ZP_KEY_INT ? json_integer((json_int_t)value) : json_real(value);
}

/* One key; NULL if there is no memory. json_pack takes ownership of the values and frees them on failure. */
static json_t *json_of_key(int index) {
  static const char *const type[] = {"real", "real_auto", "int", "bool", "enum", "text"};
  const ZpKey *key = zp_key(index);
  json_t *least = zp_value_is_number(key) ? json_of_value(index, key->min) : json_null();
  json_t *most = zp_value_is_number(key) ? json_of_value(index, key->max) : json_null();
  json_t *choices = json_array();
  for (int i = 0; key->choices && i <= (int)key->max; i++)
    add(&choices, json_pack("{s:s, s:s}", "word", key->choices[i].word, "help", key->choices[i].help));
  return json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:s}", "key", key->name, "type", type[key->type], "unit",
                   key->unit, "default", json_of_value(index, key->def), "min", least, "max", most, "choices", choices,
                   "help", key->help);
}

/* -- as a JSON schema --------------------------------------------------------------------------------
 *
 * Each key has a definition, to which its dotted name and its place in its group refer. The schema accepts what the
 * reader of scenarios accepts, and more in one respect: it checks units of a single dimension only (length, mass, ...).
 * A compound unit, such as kg/m3, is any text, because a schema cannot multiply units. */

/* Customary units of a single dimension, as a regular expression. */
static const struct {
  const char *unit, *names;
} unit_names[] = {
    {"m", "[npuµmcdk]?m|(?:nano|micro|milli|centi|kilo)?met(?:er|re)s?|in|inch(?:es)?|ft|feet|mil"},
    {"m3", "[uµmcd]?m[\\\\^]?3|[nuµmcd]?[lL]|(?:micro|milli)?lit(?:er|re)s?"},
    {"kg", "[nuµmk]?g|(?:micro|milli|kilo)?grams?|t|lb|oz|pounds?|ounces?"},
    {"s", "[npuµm]?s|(?:nano|micro|milli)?seconds?|min|minutes?|h|hours?|d|days?"},
    {"Hz", "[mkM]?Hz|(?:milli|kilo)?hertz|1/s"},
    {"V", "[nuµmkM]?V|(?:milli|kilo)?volts?"},
    {"A", "[pnuµmk]?A|(?:micro|milli)?amperes?"},
    {"F", "[pnuµm]?F|(?:pico|nano|micro)?farads?"},
    {"ohm", "[mkMGT]?(?:ohms?|Ω)"},
    {"N", "[nuµmk]?N|(?:micro|milli|kilo)?newtons?|lbf|kgf|gf"},
    {"Pa", "[mkhMG]?Pa|[mkMG]?N/[mc]?m[\\\\^]?2|m?bar|psi|atm|(?:kilo|mega|giga)?pascals?"},
    {"rad", "[uµm]?rad(?:ians?)?|deg(?:rees?)?|°|grade"},
};

#define BLANK   "[ \u00A0\u2007\u2009\u202F]*"
#define DECIMAL "[-+]?(?:[0-9]+[.]?[0-9]*|[.][0-9]+)(?:[eE][-+]?[0-9]+)?"

/* The allowed text after the number of a value. */
static const char *units_of(const ZpKey *key) {
  if (key->type == ZP_KEY_INT) return NULL;
  for (size_t i = 0; i < sizeof unit_names / sizeof unit_names[0]; i++)
    if (strcmp(key->unit, unit_names[i].unit) == 0) return unit_names[i].names;
  return "[^0-9 ].*|1/.*"; /* a compound unit; per cent or the unit of a signal after a number without a unit */
}

/* A pattern for "8 g", a range "1 g .. 9 g : 5", a distribution "normal(8 g, 1 g)", and the word of the key. */
static void write_pattern(const ZpKey *key, char *text, size_t size) {
  const char *units = units_of(key);
  snprintf(text, size, "^" BLANK "(?:" DECIMAL BLANK "(?:%s)?|.*[.][.].*:.*%s%s%s)" BLANK "$", units ? units : "",
           key->type == ZP_KEY_INT ? "" : "|[a-z]+[(].*,.*[)]", key->type == ZP_KEY_REAL_AUTO ? "|" : "",
           key->type == ZP_KEY_REAL_AUTO ? key->text : "");
}

/* The message of an editor for a text that is not a value. */
static void write_advice(int index, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  char range[ZP_RANGE_SIZE];
  zp_value_range(index, range, sizeof range);
  snprintf(text, size, "give a %s%s from %s", key->type == ZP_KEY_INT ? "whole number" : "number",
           *key->shown ? " with a unit" : "", range);
}

/* One value of a number key: a number in SI, or a text. Limits apply to numbers, the pattern to texts. */
static json_t *value_schema(int index) {
  const ZpKey *key = zp_key(index);
  char pattern[640], advice[ZP_RANGE_SIZE + 64];
  write_pattern(key, pattern, sizeof pattern);
  write_advice(index, advice, sizeof advice);
  return json_pack("{s:[s, s], s:f, s:f, s:s, s:s}", "type", key->type == ZP_KEY_INT ? "integer" : "number", "string",
                   "minimum", key->min, "maximum", key->max, "pattern", pattern, "patternErrorMessage", advice);
}

static json_t *reference(const char *definition) {
  char path[160];
  snprintf(path, sizeof path, "#/definitions/%s", definition);
  return json_pack("{s:s}", "$ref", path);
}

/* Add the members of `more`, which is freed, to an object, which becomes NULL on failure. */
static void merge(json_t **object, json_t *more) {
  if (!more || json_object_update(*object, more)) drop(object);
  json_decref(more);
}

/* A value, a list of values, a range or a distribution. */
static json_t *number_schema(int index) {
  json_t *schema = value_schema(index), *any = json_pack("[{s:[s, s, s]}]", "type", "number", "string", "array");
  add(&any, reference("range"));
  if (zp_key(index)->type != ZP_KEY_INT) add(&any, reference("distribution"));
  merge(&schema, json_pack("{s:o, s:i, s:o}", "items", value_schema(index), "minItems", 1, "anyOf", any));
  json_t *type = json_object_get(schema, "type");
  if (json_array_append_new(type, json_string("array")) || json_array_append_new(type, json_string("object")))
    drop(&schema);
  return schema;
}

/* In YAML true and false are not texts. */
static json_t *words_schema(const ZpKey *key) {
  json_t *words = json_array();
  for (int i = 0; i <= (int)key->max; i++) {
    const char *word = key->choices[i].word;
    add(&words, json_string(word));
    if (strcmp(word, "true") == 0 || strcmp(word, "false") == 0) add(&words, json_boolean(*word == 't'));
  }
  return json_pack("{s:o}", "enum", words);
}

static json_t *type_schema(int index) {
  const ZpKey *key = zp_key(index);
  if (zp_key_is_name(index)) return json_pack("{s:[s, s]}", "type", "string", "integer");
  if (zp_value_is_number(key)) return number_schema(index);
  if (key->type == ZP_KEY_ENUM) return words_schema(key);
  if (key->type == ZP_KEY_BOOL)
    return json_pack("{s:[{s:s}, {s:s, s:s}]}", "anyOf", "type", "boolean", "type", "string", "pattern",
                     "^(?:[yY][eE][sS]|[nN][oO]|[oO][nN]|[oO][fF][fF])$");
  return json_pack("{s:[s, s]}", "type", "string", "number");
}

/* "mass hung on the actuator. From 0 g to 1000000 g, default 8 g." with the words of a choice. */
static json_t *description(int index) {
  const ZpKey *key = zp_key(index);
  char text[4096], value[ZP_VALUE_SIZE], range[ZP_RANGE_SIZE] = "";
  zp_value_print(index, key->def, value, sizeof value);
  if (zp_value_is_number(key)) zp_value_range(index, range, sizeof range);
  int used = snprintf(text, sizeof text, "%s. %s%s%sDefault: %s.", key->help, *range ? "Range: " : "", range,
                      *range ? ". " : "", value);
  for (int i = 0; key->choices && i <= (int)key->max && used < (int)sizeof text; i++)
    used += snprintf(text + used, sizeof text - (size_t)used, "\n%s: %s", key->choices[i].word, key->choices[i].help);
  return json_string(text);
}

/* The text that an editor inserts. */
static json_t *default_of(int index) {
  const ZpKey *key = zp_key(index);
  char value[ZP_VALUE_SIZE];
  if (key->type == ZP_KEY_BOOL) return json_boolean(key->def != 0);
  if (key->type == ZP_KEY_TEXT) return json_string(key->text);
  if (key->type == ZP_KEY_INT) return json_integer((json_int_t)key->def);
  zp_value_print(index, key->def, value, sizeof value);
  return json_string(value);
}

static json_t *key_schema(int index) {
  const ZpKey *key = zp_key(index);
  json_t *schema = json_pack("{s:o, s:o}", "description", description(index), "default", default_of(index));
  merge(&schema, type_schema(index));
  if (zp_value_is_number(key)) set(&schema, "x-unit", json_string(key->unit));
  return schema;
}

/* The parts of a range or a distribution. */
static json_t *range_schema(void) {
  return json_pack("{s:s, s:s, s:b, s:[s, s, s], s:{s:{s:[s, s]}, s:{s:[s, s]}, s:{s:s, s:i, s:i}, s:{s:[s, s]}}}",
                   "description", "values in equal steps or with equal ratios, both ends included", "type", "object",
                   "additionalProperties", 0, "required", "from", "to", "count", "properties", "from", "type", "number",
                   "string", "to", "type", "number", "string", "count", "type", "integer", "minimum", 2, "maximum",
                   20000, "spacing", "enum", "linear", "log");
}

static json_t *distribution_schema(void) {
  json_t *kinds = json_array();
  for (int k = 1; k < ZpDistributionKind_COUNT; k++) {
    const char *first = zp_part_name[zp_part_first((ZpDistributionKind)k)],
               *second = zp_part_name[zp_part_second((ZpDistributionKind)k)];
    add(&kinds, json_pack("{s:s, s:b, s:[s, s], s:{s:{s:[s, s]}, s:{s:[s, s]}}}", "type", "object",
                          "additionalProperties", 0, "required", first, second, "properties", first, "type", "number",
                          "string", second, "type", "number", "string"));
  }
  return json_pack("{s:s, s:o}", "description", "values are drawn", "anyOf", kinds);
}

/* The name of a property, of those of all members, bodies, springs or joints a pattern: in the place of K stands a
 * number. */
static void property_name(const char *name, size_t size, char *text) {
  static const char number[] = "_K", segment[] = "segment_K", to_64[] = "_(?:[1-9]|[1-5][0-9]|6[0-4])",
                    to_1024[] = "_(?:[1-9][0-9]{0,2}|10[01][0-9]|102[0-4])";
  const char *at = strstr(name, number), *numbers = strstr(name, segment) ? to_64 : to_1024;
  if (!at || at >= name + size) {
    snprintf(text, ZP_VALUE_SIZE, "%.*s", (int)size, name);
    return;
  }
  size_t used = (size_t)snprintf(text, ZP_VALUE_SIZE, "^");
  for (const char *letter = name; letter < name + size; letter++) {
    if (letter == at) used += (size_t)snprintf(text + used, ZP_VALUE_SIZE - used, "%s", numbers);
    if (letter == at) letter += sizeof number - 1;
    if (letter < name + size)
      used += (size_t)snprintf(text + used, ZP_VALUE_SIZE - used, *letter == '.' ? "[.]" : "%c", *letter);
  }
  snprintf(text + used, ZP_VALUE_SIZE - used, "$");
}

static void put_property(json_t **properties, const char *name, size_t size, json_t *schema) {
  char text[ZP_VALUE_SIZE];
  property_name(name, size, text);
  set(properties, text, schema);
}

static bool has_property(json_t **properties, const char *name, size_t size) {
  char text[ZP_VALUE_SIZE];
  property_name(name, size, text);
  return json_object_get(*properties, text) != NULL;
}

/* Where a name of `size` bytes stands: with a number in the place of K it is a pattern. */
static json_t **those_of(const char *name, size_t size, json_t **properties, json_t **patterns) {
  const char *number = strstr(name, "_K");
  return number && number < name + size ? patterns : properties;
}

/* The group `path` of `size` bytes ("" for the root): its keys, by the rest of their names, and its groups. */
static json_t *group_schema(const char *path, size_t size) {
  json_t *properties = json_object(), *patterns = json_object();
  for (int i = 0; i < zp_key_count(); i++) {
    const char *name = zp_key(i)->name, *rest = name + size + (size > 0);
    if (strncmp(name, path, size) != 0 || (size > 0 && name[size] != '.')) continue;
    put_property(those_of(rest, strlen(rest), &properties, &patterns), rest, strlen(rest), reference(name));
    for (const char *dot = strchr(rest, '.'); dot; dot = strchr(dot + 1, '.')) {
      json_t **these = those_of(rest, (size_t)(dot - rest), &properties, &patterns);
      if (*these && !has_property(these, rest, (size_t)(dot - rest)))
        put_property(these, rest, (size_t)(dot - rest), group_schema(name, (size_t)(dot - name)));
    }
  }
  json_t *schema =
      json_pack("{s:[s, s], s:b, s:o}", "type", "object", "null", "additionalProperties", 0, "properties", properties);
  if (!patterns || json_object_size(patterns) > 0) set(&schema, "patternProperties", json_incref(patterns));
  json_decref(patterns);
  return schema;
}

/* A pair, such as [0 mm, -50 mm] or [frame, hand], in the place of a group or a key. */
static void add_pair(json_t **properties, const char *name) {
  json_t *either = json_array(), *group = json_object_get(*properties, name);
  if (group) add(&either, json_incref(group));
  add(&either, json_pack("{s:s, s:i, s:i, s:{s:[s, s]}}", "type", "array", "minItems", 2, "maxItems", 2, "items",
                         "type", "number", "string"));
  set(properties, name, json_pack("{s:o}", "anyOf", either));
}

/* Members, bodies, springs and joints by their names: in their group, or with a dotted name. */
static void add_named(json_t **schema, ZpInstanceKind kind) {
  static const struct {
    ZpInstanceKind kind;
    const char *name;
  } pair[] = {{ZP_OF_MEMBER, "upper_at"}, {ZP_OF_MEMBER, "lower_at"}, {ZP_OF_BODY, "at"},
              {ZP_OF_BODY, "force"},      {ZP_OF_SPRING, "between"},  {ZP_OF_SPRING, "from_at"},
              {ZP_OF_SPRING, "to_at"},    {ZP_OF_JOINT, "between"},   {ZP_OF_JOINT, "at"}};
  static const char name[] = "[a-z][a-z0-9_]{0,30}";
  const char *plural = zp_names_plural(kind);
  char one[ZP_VALUE_SIZE], pattern[ZP_VALUE_SIZE];
  snprintf(one, sizeof one, "%sK", zp_instance_begins(kind));
  json_t *keys = group_schema(one, strlen(one)), *properties = json_object_get(keys, "properties");
  for (size_t k = 0; k < sizeof pair / sizeof pair[0]; k++)
    if (pair[k].kind == kind) add_pair(&properties, pair[k].name);
  snprintf(pattern, sizeof pattern, "^%s$", name);
  json_t *all = json_object_get(*schema, "properties"), *dotted = json_object_get(*schema, "patternProperties");
  set(&all, plural,
      json_pack("{s:[s, s], s:b, s:{s:O}}", "type", "object", "null", "additionalProperties", 0, "patternProperties",
                pattern, keys));
  const char *key;
  json_t *value;
  json_object_foreach(properties, key, value) {
    size_t used = (size_t)snprintf(pattern, sizeof pattern, "^%s[.]%s[.]", plural, name);
    for (const char *letter = key; *letter; letter++)
      used += (size_t)snprintf(pattern + used, sizeof pattern - used, *letter == '.' ? "[.]" : "%c", *letter);
    snprintf(pattern + used, sizeof pattern - used, "$");
    set(&dotted, pattern, json_incref(value));
  }
  snprintf(pattern, sizeof pattern, "^%s[.]%s$", plural, name);
  set(&dotted, pattern, keys);
  if (!all || !dotted) drop(schema);
}

static json_t *make_schema(void) {
  json_t *definitions = json_pack("{s:o, s:o}", "range", range_schema(), "distribution", distribution_schema());
  for (int i = 0; i < zp_key_count(); i++)
    set(&definitions, zp_key(i)->name, key_schema(i));
  json_t *schema = json_pack("{s:s, s:s, s:s, s:o}", "$schema", "http://json-schema.org/draft-07/schema#", "title",
                             "zipact scenario", "description",
                             "Values take units (\"130 um\", \"10 kV\"); a number without a unit is in SI.",
                             "definitions", definitions);
  merge(&schema, group_schema("", 0));
  json_t *fitted = json_pack("{s:s, s:s}", "type", "object", "description",
                             "Of a file that calibrate has written: how sure its values are. Read by base.file.");
  if (json_object_set_new(json_object_get(schema, "properties"), "fitted", fitted)) drop(&schema);
  for (int kind = 0; schema && kind < ZP_CALLED_KINDS; kind++)
    add_named(&schema, (ZpInstanceKind)kind);
  return schema;
}

/* -- all of them ------------------------------------------------------------------------------------- */

/* Write `json`, which is freed; NULL: there was no memory for it. */
static ZpStatus write_json(json_t *json, FILE *file, ZpError *err) {
  if (!json) return zp_fail_memory(err);
  /* 16 digits reproduce every number of keys.def; 17 digits would print 0.1 as 0.10000000000000001. */
  const int failed = json_dumpf(json, file, JSON_INDENT(2) | JSON_REAL_PRECISION(16));
  json_decref(json);
  if (failed) return zp_fail(err, ZP_MACHINE, "the keys cannot be written: %s", strerror(errno));
  fputc('\n', file);
  return ZP_OK;
}

ZpStatus zp_keys_write(ZpKeysFormat format, FILE *file, ZpError *err) {
  ZpStatus status = ZP_OK;
  switch (format) {
  case ZP_KEYS_TEXT:
    write_text(file);
    break;
  case ZP_KEYS_JSON: {
    json_t *list = json_array();
    for (int i = 0; i < zp_key_count(); i++)
      add(&list, json_of_key(i));
    status = write_json(list, file, err);
    break;
  }
  case ZP_KEYS_SCHEMA:
    status = write_json(make_schema(), file, err);
    break;
  case ZP_KEYS_YAML:
    write_yaml(file);
    break;
  }
  if (status == ZP_OK && (fflush(file) || ferror(file)))
    return zp_fail(err, ZP_MACHINE, "the keys cannot be written: %s", strerror(errno));
  return status;
}
