/* The table of keys as text for people, as JSON for programs, as a scenario to start from. */
#include <zipact/io.h>

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "io/schema.h"
#include "io/summary.h"
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
    int width = zp_yaml_write_key(file, key->name, before);
    zp_value_print(i, key->def, value, sizeof value);
    allowed(i, " | ", range, sizeof range);
    fprintf(file, "%s%*s  # %s (%s)\n", value, longer(COMMENT_COLUMN - width, value) - (int)strlen(value), "",
            key->help, range);
    before = key->name;
  }
}

static const char *type_word(ZpKeyType type) {
  static const char *const words[] = {"real", "real_auto", "int", "bool", "enum", "text"};
  return words[type];
}

static const char *unit_of(const ZpKey *key) {
  return key->type == ZP_KEY_INT ? "count" : key->unit;
}

static void put_key(ZpJson *json, int index) {
  const ZpKey *key = zp_key(index);
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "key", key->name);
  zp_json_text(json, "type", type_word(key->type));
  zp_json_text(json, "unit", key->unit);
  zp_json_key(json, "default", index, key->def);
  zp_json_number(json, "min", zp_value_is_number(key) ? key->min : NAN, unit_of(key));
  zp_json_number(json, "max", zp_value_is_number(key) ? key->max : NAN, unit_of(key));
  zp_json_open(json, "choices", '[');
  for (int i = 0; key->choices && i <= (int)key->max; i++) {
    zp_json_open(json, NULL, '{');
    zp_json_text(json, "word", key->choices[i].word);
    zp_json_text(json, "help", key->choices[i].help);
    zp_json_close(json, '}');
  }
  zp_json_close(json, ']');
  zp_json_text(json, "help", key->help);
  zp_json_close(json, '}');
}

static void put_keys(ZpJson *json) {
  zp_json_open(json, NULL, '[');
  for (int i = 0; i < zp_key_count(); i++)
    put_key(json, i);
  zp_json_close(json, ']');
}

ZpStatus zp_keys_write(ZpKeysFormat format, FILE *file, ZpError *err) {
  ZpJson json = {.file = file, .terse = true};
  if (format == ZP_KEYS_TEXT) write_text(file);
  if (format == ZP_KEYS_YAML) write_yaml(file);
  if (format == ZP_KEYS_JSON) put_keys(&json);
  if (format == ZP_KEYS_SCHEMA) zp_schema_put(&json);
  if (json.begun) return zp_json_end(&json, "the keys", err);
  if (fflush(file) || ferror(file)) return zp_fail(err, ZP_MACHINE, "the keys cannot be written: %s", strerror(errno));
  return ZP_OK;
}
