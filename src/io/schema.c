/* A JSON schema of scenarios, with which editors complete and check them.
 *
 * Each key has a definition, to which its dotted name and its place in its group refer. The schema accepts what the
 * reader of scenarios accepts, and more in one respect: it checks units of a single dimension only (length, mass, ...).
 * A compound unit, such as kg/m3, is any text, because a schema cannot multiply units. */
#include "io/schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/def.h>
#include <zipact/io.h>

#include "io/spread.h"
#include "io/summary.h"
#include "io/value.h"

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

/* A list of words, which `words` has with blanks between them. */
static void put_words(ZpJson *json, const char *name, const char *words) {
  char word[64];
  zp_json_open(json, name, '[');
  for (size_t length; *words; words += length + (words[length] == ' ')) {
    length = strcspn(words, " ");
    snprintf(word, sizeof word, "%.*s", (int)length, words);
    zp_json_text(json, NULL, word);
  }
  zp_json_close(json, ']');
}

static void put_reference(ZpJson *json, const char *name, const char *definition) {
  char path[160];
  snprintf(path, sizeof path, "#/definitions/%s", definition);
  zp_json_open(json, name, '{');
  zp_json_text(json, "$ref", path);
  zp_json_close(json, '}');
}

/* Of which types a value may be: {"type": [...]}. */
static void put_type(ZpJson *json, const char *name, const char *types) {
  zp_json_open(json, name, '{');
  put_words(json, "type", types);
  zp_json_close(json, '}');
}

/* A value of a number key: a number in SI, or a text. Limits apply to numbers, the pattern to texts. `more`: further
 * types. */
static void put_value(ZpJson *json, int index, const char *more) {
  const ZpKey *key = zp_key(index);
  char pattern[640], advice[ZP_RANGE_SIZE + 64], types[64];
  write_pattern(key, pattern, sizeof pattern);
  write_advice(index, advice, sizeof advice);
  snprintf(types, sizeof types, "%s string%s", key->type == ZP_KEY_INT ? "integer" : "number", more);
  put_words(json, "type", types);
  zp_json_number(json, "minimum", key->min, "1");
  zp_json_number(json, "maximum", key->max, "1");
  zp_json_text(json, "pattern", pattern);
  zp_json_text(json, "patternErrorMessage", advice);
}

/* A value, a list of values, a range or a distribution. */
static void put_number(ZpJson *json, int index) {
  put_value(json, index, " array object");
  zp_json_open(json, "items", '{');
  put_value(json, index, "");
  zp_json_close(json, '}');
  zp_json_number(json, "minItems", 1, "count");
  zp_json_open(json, "anyOf", '[');
  put_type(json, NULL, "number string array");
  put_reference(json, NULL, "range");
  if (zp_key(index)->type != ZP_KEY_INT) put_reference(json, NULL, "distribution");
  zp_json_close(json, ']');
  zp_json_text(json, "x-unit", zp_key(index)->unit);
}

/* In YAML true and false are not texts. */
static void put_choices(ZpJson *json, const ZpKey *key) {
  zp_json_open(json, "enum", '[');
  for (int i = 0; i <= (int)key->max; i++) {
    const char *word = key->choices[i].word;
    zp_json_text(json, NULL, word);
    if (strcmp(word, "true") == 0 || strcmp(word, "false") == 0) zp_json_bool(json, NULL, *word == 't');
  }
  zp_json_close(json, ']');
}

static void put_bool(ZpJson *json) {
  zp_json_open(json, "anyOf", '[');
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "type", "boolean");
  zp_json_close(json, '}');
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "type", "string");
  zp_json_text(json, "pattern", "^(?:[yY][eE][sS]|[nN][oO]|[oO][nN]|[oO][fF][fF])$");
  zp_json_close(json, '}');
  zp_json_close(json, ']');
}

/* "mass hung on the actuator. From 0 g to 1000000 g, default 8 g." with the words of a choice. */
static void put_description(ZpJson *json, int index) {
  const ZpKey *key = zp_key(index);
  char text[4096], value[ZP_VALUE_SIZE], range[ZP_RANGE_SIZE] = "";
  zp_value_print(index, key->def, value, sizeof value);
  if (zp_value_is_number(key)) zp_value_range(index, range, sizeof range);
  int used = snprintf(text, sizeof text, "%s. %s%s%sDefault: %s.", key->help, *range ? "Range: " : "", range,
                      *range ? ". " : "", value);
  for (int i = 0; key->choices && i <= (int)key->max && used < (int)sizeof text; i++)
    used += snprintf(text + used, sizeof text - (size_t)used, "\n%s: %s", key->choices[i].word, key->choices[i].help);
  zp_json_text(json, "description", text);
}

/* The text that an editor inserts. */
static void put_default(ZpJson *json, int index) {
  const ZpKey *key = zp_key(index);
  char value[ZP_VALUE_SIZE];
  zp_value_print(index, key->def, value, sizeof value);
  if (key->type == ZP_KEY_BOOL || key->type == ZP_KEY_TEXT || key->type == ZP_KEY_INT)
    zp_json_key(json, "default", index, key->def);
  else
    zp_json_text(json, "default", value);
}

static void put_key(ZpJson *json, int index) {
  const ZpKey *key = zp_key(index);
  zp_json_open(json, key->name, '{');
  put_description(json, index);
  put_default(json, index);
  if (zp_value_is_number(key))
    put_number(json, index);
  else if (key->type == ZP_KEY_ENUM)
    put_choices(json, key);
  else if (key->type == ZP_KEY_BOOL)
    put_bool(json);
  else
    put_words(json, "type", "string number");
  zp_json_close(json, '}');
}

/* An object with these parts and no other ones. */
static void open_parts(ZpJson *json, const char *name, const char *help, const char *required) {
  zp_json_open(json, name, '{');
  if (help) zp_json_text(json, "description", help);
  zp_json_text(json, "type", "object");
  zp_json_bool(json, "additionalProperties", false);
  put_words(json, "required", required);
  zp_json_open(json, "properties", '{');
}

static void close_parts(ZpJson *json) {
  zp_json_close(json, '}');
  zp_json_close(json, '}');
}

static void put_range(ZpJson *json) {
  open_parts(json, "range", "values in equal steps or with equal ratios, both ends included", "from to count");
  put_type(json, "from", "number string");
  put_type(json, "to", "number string");
  zp_json_open(json, "count", '{');
  zp_json_text(json, "type", "integer");
  zp_json_number(json, "minimum", 2, "count");
  zp_json_number(json, "maximum", 20000, "count");
  zp_json_close(json, '}');
  zp_json_open(json, "spacing", '{');
  put_words(json, "enum", "linear log");
  zp_json_close(json, '}');
  close_parts(json);
}

static void put_distribution(ZpJson *json) {
  zp_json_open(json, "distribution", '{');
  zp_json_text(json, "description", "values are drawn");
  zp_json_open(json, "anyOf", '[');
  for (int k = 1; k < ZpDistributionKind_COUNT; k++) {
    const char *first = zp_spread_word[k], *second = zp_spread_second((ZpDistributionKind)k);
    char both[64];
    snprintf(both, sizeof both, "%s %s", first, second);
    open_parts(json, NULL, NULL, both);
    put_type(json, first, "number string");
    put_type(json, second, "number string");
    close_parts(json);
  }
  zp_json_close(json, ']');
  zp_json_close(json, '}');
}

/* Is key `index` the first one whose name begins with these bytes? */
static bool is_first(int index, const char *path, size_t size) {
  int first = 0;
  while (strncmp(zp_key(first)->name, path, size) != 0)
    first++;
  return first == index;
}

/* The members of group `path` of `size` bytes, with its last point ("" for the root): its keys, by the rest of their
 * names, and its groups. */
static void put_group(ZpJson *json, const char *path, size_t size) {
  put_words(json, "type", "object null");
  zp_json_bool(json, "additionalProperties", false);
  zp_json_open(json, "properties", '{');
  for (int i = 0; i < zp_key_count(); i++) {
    const char *name = zp_key(i)->name, *rest = name + size;
    if (strncmp(name, path, size) != 0) continue;
    put_reference(json, rest, name);
    for (const char *dot = strchr(rest, '.'); dot; dot = strchr(dot + 1, '.')) {
      const size_t length = (size_t)(dot - name) + 1;
      char group[ZP_VALUE_SIZE];
      if (!is_first(i, name, length)) continue;
      snprintf(group, sizeof group, "%.*s", (int)(dot - rest), rest);
      zp_json_open(json, group, '{');
      put_group(json, name, length);
      zp_json_close(json, '}');
    }
  }
  zp_json_close(json, '}');
}

void zp_schema_put(ZpJson *json) {
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "$schema", "http://json-schema.org/draft-07/schema#");
  zp_json_text(json, "title", "zipact scenario");
  zp_json_text(json, "description", "Values take units (\"130 um\", \"10 kV\"); a number without a unit is in SI.");
  zp_json_open(json, "definitions", '{');
  put_range(json);
  put_distribution(json);
  for (int i = 0; i < zp_key_count(); i++)
    put_key(json, i);
  zp_json_close(json, '}');
  put_group(json, "", 0);
  zp_json_close(json, '}');
}
