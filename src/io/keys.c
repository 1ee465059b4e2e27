/* The table of keys as text for people, as JSON for programs, as a scenario to start from. */
#include <zipact/io.h>

#include <errno.h>
#include <math.h>
#include <string.h>

#include <jansson.h>

#include "base/fail.h"
#include "io/schema.h"
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

static json_t *json_of_value(int index, double value) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_TEXT || (key->type == ZP_KEY_REAL_AUTO && isnan(value))) return json_string(key->text);
  if (key->type == ZP_KEY_BOOL) return json_boolean(value != 0);
  if (key->type == ZP_KEY_ENUM) return json_string(key->choices[(int)value].word);
  if (!isfinite(value)) return json_null();
  return key->type == ZP_KEY_INT ? json_integer((json_int_t)value) : json_real(value);
}

static json_t *json_of_choices(const ZpKey *key) {
  json_t *list = json_array();
  for (int i = 0; key->choices && i <= (int)key->max; i++)
    zp_json_add(&list, json_pack("{s:s, s:s}", "word", key->choices[i].word, "help", key->choices[i].help));
  return list;
}

/* One key; NULL if there is no memory. json_pack takes ownership of the values and frees them on failure. */
static json_t *json_of_key(int index) {
  static const char *const type[] = {"real", "real_auto", "int", "bool", "enum", "text"};
  const ZpKey *key = zp_key(index);
  json_t *least = zp_value_is_number(key) ? json_of_value(index, key->min) : json_null();
  json_t *most = zp_value_is_number(key) ? json_of_value(index, key->max) : json_null();
  return json_pack("{s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:s}", "key", key->name, "type", type[key->type], "unit",
                   key->unit, "default", json_of_value(index, key->def), "min", least, "max", most, "choices",
                   json_of_choices(key), "help", key->help);
}

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
      zp_json_add(&list, json_of_key(i));
    status = write_json(list, file, err);
    break;
  }
  case ZP_KEYS_SCHEMA:
    status = write_json(zp_schema_make(), file, err);
    break;
  case ZP_KEYS_YAML:
    write_yaml(file);
    break;
  }
  if (status == ZP_OK && (fflush(file) || ferror(file)))
    return zp_fail(err, ZP_MACHINE, "the keys cannot be written: %s", strerror(errno));
  return status;
}
