#include "io/range.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/value.h"

/* Most values of a range; all lists together are bounded by io/scenario.c. */
enum { COUNT_MOST = 20000 };

bool zp_range_is(const char *text) {
  return strstr(text, "..") != NULL;
}

/* The text without blanks at its ends, in place. */
static char *trim(char *text) {
  text += strspn(text, " \t");
  for (size_t length = strlen(text); length > 0 && strchr(" \t", text[length - 1]);)
    text[--length] = 0;
  return text;
}

ZpStatus zp_range_split(char *text, ZpRange *range, ZpError *err) {
  char *dots = strstr(text, ".."), *colon = dots ? strchr(dots, ':') : NULL;
  if (!colon)
    return zp_fail(err, ZP_BAD_INPUT, "not a range; write \"10 um .. 200 um : 20\", with \"log\" at its end if wanted");
  *dots = *colon = 0;
  *range = (ZpRange){.from = trim(text), .to = trim(dots + 2), .count = trim(colon + 1)};
  char *blank = strpbrk(colon + 1 + strspn(colon + 1, " \t"), " \t");
  if (!blank) return ZP_OK;
  *blank = 0;
  range->spacing = trim(blank + 1);
  return ZP_OK;
}

static ZpStatus read_end(int index, const char *name, const char *text, double *value, ZpError *err) {
  ZpError reason;
  if (!text) return zp_fail(err, ZP_BAD_INPUT, "a range has no \"%s\"; give from, to and count", name);
  ZpStatus status = zp_value_read(index, text, value, &reason);
  if (status != ZP_OK) return zp_fail(err, status, "%s = \"%.60s\": %.300s", name, text, reason.message);
  return isnan(*value) ? zp_fail(err, ZP_BAD_INPUT, "%s = \"%.60s\": give a number", name, text) : ZP_OK;
}

static ZpStatus read_count(const char *text, size_t *count, ZpError *err) {
  char *end = NULL;
  const long value = text ? strtol(text, &end, 10) : 0;
  if (!text) return zp_fail(err, ZP_BAD_INPUT, "a range has no \"count\"; give from, to and count");
  if (end == text || *end || value < 2 || value > COUNT_MOST)
    return zp_fail(err, ZP_BAD_INPUT, "count = \"%.60s\": give a whole number from 2 to %d", text, COUNT_MOST);
  *count = (size_t)value;
  return ZP_OK;
}

static ZpStatus read_spacing(const char *text, double from, double to, bool *by_factors, ZpError *err) {
  *by_factors = text && strcmp(text, "log") == 0;
  if (text && !*by_factors && strcmp(text, "linear") != 0)
    return zp_fail(err, ZP_BAD_INPUT, "spacing = \"%.60s\": give linear or log", text);
  if (*by_factors && !(from > 0 && to > 0))
    return zp_fail(err, ZP_BAD_INPUT, "spacing = \"log\": both ends must be above 0");
  return ZP_OK;
}

double zp_rounded(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.11e", value);
  return strtod(text, NULL);
}

static double value_at(double from, double to, double share, bool by_factors) {
  return zp_rounded(by_factors ? from * pow(to / from, share) : from + (to - from) * share);
}

static ZpStatus fill(int index, double from, double to, bool by_factors, double *value, size_t count, ZpError *err) {
  const bool whole = zp_key(index)->type == ZP_KEY_INT;
  for (size_t i = 0; i < count; i++) {
    value[i] = i == 0 ? from : i + 1 == count ? to : value_at(from, to, (double)i / (double)(count - 1), by_factors);
    if (whole && value[i] != floor(value[i]))
      return zp_fail(err, ZP_BAD_INPUT, "a range with %g in it, which is not a whole number", value[i]);
  }
  return ZP_OK;
}

ZpStatus zp_range_read(int index, const ZpRange *range, double **value, size_t *count, ZpError *err) {
  double from = 0, to = 0;
  bool by_factors = false;
  *value = NULL;
  ZpStatus status = read_end(index, "from", range->from, &from, err);
  if (status == ZP_OK) status = read_end(index, "to", range->to, &to, err);
  if (status == ZP_OK) status = read_count(range->count, count, err);
  if (status == ZP_OK) status = read_spacing(range->spacing, from, to, &by_factors, err);
  if (status == ZP_OK && from == to) status = zp_fail(err, ZP_BAD_INPUT, "a range from a value to itself");
  if (status != ZP_OK) return status;
  *value = calloc(*count, sizeof **value);
  if (!*value) return zp_fail_memory(err);
  status = fill(index, from, to, by_factors, *value, *count, err);
  if (status == ZP_OK) return ZP_OK;
  free(*value);
  *value = NULL;
  return status;
}
