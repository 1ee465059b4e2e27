#include "io/json.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "io/number.h"
#include "io/source.h"

/* Largest integer that a double represents exactly. */
#define LARGEST_COUNT 9007199254740992.0

static void begin_line(const ZpJson *json) {
  if (!json->flat) fprintf(json->file, "\n%*s", 2 * json->depth, "");
}

static void begin_member(ZpJson *json, const char *name) {
  if (json->begun) fputs(json->flat ? ", " : ",", json->file);
  if (json->depth > 0) begin_line(json);
  if (name) fprintf(json->file, "\"%s\": ", name);
  json->begun = true;
}

void zp_json_open(ZpJson *json, const char *name, char bracket) {
  begin_member(json, name);
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

/* 1e-05 => 1e-5, 1e+20 => 1e20 */
static void shorten_exponent(char *text) {
  char *sign = strchr(text, 'e');
  if (!sign) return;
  char *from = sign + 1 + strspn(sign + 1, "+-"), *to = sign + 1 + (sign[1] == '-');
  from += strspn(from, "0");
  memmove(to, from, strlen(from) + 1);
}

void zp_json_number(ZpJson *json, const char *name, double value, const char *unit) {
  const bool whole = strcmp(unit, "count") == 0 && fabs(value) <= LARGEST_COUNT;
  char text[ZP_NUMBER_SIZE];
  begin_member(json, name);
  if (!isfinite(value))
    snprintf(text, sizeof text, "null");
  else if (whole)
    snprintf(text, sizeof text, "%lld", (long long)value);
  else
    zp_number_print(value, text, sizeof text);
  if (json->terse) shorten_exponent(text);
  fputs(text, json->file);
  if (isfinite(value) && !whole && !strpbrk(text, ".e"))
    fputs(".0", json->file); /* readers must not take 75.0 for 75 */
}

void zp_json_text(ZpJson *json, const char *name, const char *text) {
  static const char special[] = "\"\\\b\f\n\r\t", *const escape = "\"\\bfnrt";
  begin_member(json, name);
  if (!text) {
    fputs("null", json->file);
    return;
  }
  fputc('"', json->file);
  for (size_t left = strlen(text), length; left > 0; text += length, left -= length) {
    const char *found = strchr(special, *text);
    length = zp_text_character(text, left);
    if (found)
      fprintf(json->file, "\\%c", escape[found - special]);
    else if (length > 0)
      fwrite(text, 1, length, json->file);
    else
      fputc('?', json->file);
    if (length == 0) length = 1;
  }
  fputc('"', json->file);
}

void zp_json_bool(ZpJson *json, const char *name, bool value) {
  begin_member(json, name);
  fputs(value ? "true" : "false", json->file);
}

ZpStatus zp_json_end(ZpJson *json, const char *what, ZpError *err) {
  errno = 0;
  fputc('\n', json->file);
  if (fflush(json->file) == 0 && !ferror(json->file)) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%s cannot be written: %s", what, strerror(errno ? errno : EIO));
}
