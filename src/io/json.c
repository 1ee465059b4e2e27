#include "io/json.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include <jansson.h>

#include "base/fail.h"
#include "io/number.h"
#include "io/report.h"

/* Largest integer that a double represents exactly. */
#define LARGEST_COUNT 9007199254740992.0

/* Two blanks per level. */
static void begin_line(const ZpJson *json) {
  if (!json->flat) fprintf(json->file, "\n%*s", 2 * json->depth, "");
}

/* Comma, line break and name before a member. */
static void begin(ZpJson *json, const char *name) {
  if (json->begun) fputs(json->flat ? ", " : ",", json->file);
  if (json->depth > 0) begin_line(json);
  if (name) fprintf(json->file, "\"%s\": ", name);
  json->begun = true;
}

void zp_json_open(ZpJson *json, const char *name, char bracket) {
  begin(json, name);
  fputc(bracket, json->file);
  json->depth++;
  json->begun = false;
}

void zp_json_close(ZpJson *json, char bracket) {
  json->depth--;
  if (json->begun) begin_line(json);
  fputc(bracket, json->file);
  json->begun = true;
}

/* A real number keeps a point or an exponent, so that readers do not take 75.0 for an integer. */
void zp_json_number(ZpJson *json, const char *name, double value, const char *unit) {
  char text[ZP_NUMBER_SIZE] = "null";
  begin(json, name);
  const bool whole = strcmp(unit, "count") == 0 && fabs(value) <= LARGEST_COUNT;
  if (whole)
    snprintf(text, sizeof text, "%lld", (long long)value);
  else if (isfinite(value))
    zp_number_print(value, text, sizeof text);
  fprintf(json->file, "%s%s", text, whole || !isfinite(value) || strpbrk(text, ".e") ? "" : ".0");
}

/* jansson escapes it. */
void zp_json_text(ZpJson *json, const char *name, const char *text) {
  begin(json, name);
  json_t *string = text ? json_string(text) : json_null();
  json->bad |= !string || json_dumpf(string, json->file, JSON_ENCODE_ANY) != 0;
  json_decref(string);
}

void zp_json_bool(ZpJson *json, const char *name, bool value) {
  begin(json, name);
  fputs(value ? "true" : "false", json->file);
}

void zp_json_key(ZpJson *json, const char *name, int key, double value) {
  const ZpKey *k = zp_key(key);
  if (k->type == ZP_KEY_BOOL)
    zp_json_bool(json, name, value != 0);
  else if (k->type == ZP_KEY_ENUM)
    zp_json_text(json, name, zp_key_word(key, value));
  else if (k->type == ZP_KEY_REAL_AUTO && isnan(value))
    zp_json_text(json, name, k->text);
  else
    zp_json_number(json, name, value, k->type == ZP_KEY_INT ? "count" : k->unit);
}

ZpStatus zp_json_finish(ZpJson *json, ZpError *err) {
  errno = 0;
  const bool written = fputc('\n', json->file) != EOF && fflush(json->file) == 0 && !ferror(json->file);
  if (!written) return zp_fail(err, ZP_MACHINE, "cannot write summary.json: %s", strerror(errno ? errno : EIO));
  return json->bad ? zp_fail_memory(err) : ZP_OK;
}
