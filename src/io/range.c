#include "io/range.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "def/check.h"
#include "io/number.h"
#include "io/value.h"

/* Largest number of values of a range; io/scenario.c limits all lists together. */
enum { COUNT_MOST = 20000 };

const char *const zp_part_name[ZP_PARTS] = {"from",   "to",        "count",   "spacing",    "sigma",
                                            "normal", "lognormal", "uniform", "log_uniform"};

bool zp_range_is(const char *text) {
  return strstr(text, "..") != NULL;
}

char *zp_trim(char *text) {
  while (isspace((unsigned char)*text))
    text++;
  for (size_t length = strlen(text); length > 0 && isspace((unsigned char)text[length - 1]);)
    text[--length] = 0;
  return text;
}

ZpStatus zp_range_split(char *text, ZpParts *parts, ZpError *err) {
  char *dots = strstr(text, ".."), *colon = dots ? strchr(dots, ':') : NULL;
  *parts = (ZpParts){{NULL}};
  if (!colon) /* or YAML has taken the colon, where there were no quotes */
    return zp_fail(err, ZP_BAD_INPUT,
                   "not a range; write \"%.60s : 20\" or \"%.60s : 20 log\", with the number of values and the quotes",
                   zp_trim(text), zp_trim(text));
  *dots = *colon = 0;
  parts->text[ZP_PART_FROM] = zp_trim(text);
  parts->text[ZP_PART_TO] = zp_trim(dots + 2);
  parts->text[ZP_PART_COUNT] = zp_trim(colon + 1);
  char *blank = strpbrk(colon + 1 + strspn(colon + 1, " \t"), " \t");
  if (!blank) return ZP_OK;
  *blank = 0;
  parts->text[ZP_PART_SPACING] = zp_trim(blank + 1);
  return ZP_OK;
}

static ZpStatus read_end(int index, const char *name, const char *text, double *value, ZpError *err) {
  if (!text) return zp_fail(err, ZP_BAD_INPUT, "a range has no \"%s\"; give from, to and count", name);
  return zp_value_read_part(index, name, text, value, err);
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

static ZpStatus fill(int index, double from, double to, bool by_factors, double *value, size_t count, ZpError *err) {
  const bool whole = zp_key(index)->type == ZP_KEY_INT;
  for (size_t i = 0; i < count; i++) {
    const double share = (double)i / (double)(count - 1);
    value[i] = i == 0           ? from
               : i + 1 == count ? to
                                : zp_rounded(by_factors ? from * pow(to / from, share) : from + (to - from) * share);
    if (whole && value[i] != floor(value[i]))
      return zp_fail(err, ZP_BAD_INPUT, "the range contains %g, which is not a whole number", value[i]);
  }
  return ZP_OK;
}

ZpStatus zp_range_read(int index, const ZpParts *parts, double **value, size_t *count, ZpError *err) {
  double from = 0, to = 0;
  bool by_factors = false;
  *value = NULL;
  ZpStatus status = read_end(index, "from", parts->text[ZP_PART_FROM], &from, err);
  if (status == ZP_OK) status = read_end(index, "to", parts->text[ZP_PART_TO], &to, err);
  if (status == ZP_OK) status = read_count(parts->text[ZP_PART_COUNT], count, err);
  if (status == ZP_OK) status = read_spacing(parts->text[ZP_PART_SPACING], from, to, &by_factors, err);
  if (status == ZP_OK && from == to) status = zp_fail(err, ZP_BAD_INPUT, "both ends of the range are equal");
  if (status != ZP_OK) return status;
  *value = calloc(*count, sizeof **value);
  if (!*value) return zp_fail_memory(err);
  status = fill(index, from, to, by_factors, *value, *count, err);
  if (status == ZP_OK) return ZP_OK;
  free(*value);
  *value = NULL;
  return status;
}

/* -- intervals --------------------------------------------------------------------------------------- */

static ZpStatus check_interval(const char *setting, const ZpInterval *i, ZpError *err) {
  const char *name = ZP_KEY_NAME(i->key);
  if (!(i->from < i->to))
    return zp_fail(err, ZP_BAD_INPUT, "%s: %s: the upper end must be larger than the lower", setting, name);
  if (i->by_factors && !(i->from > 0))
    return zp_fail(err, ZP_BAD_INPUT, "%s: %s: with log, both ends must be above 0", setting, name);
  return ZP_OK;
}

ZpStatus zp_interval_read(const char *setting, char *text, ZpInterval *interval, ZpError *err) {
  char *equals = strchr(text, '='), *dots = equals ? strstr(equals, "..") : NULL;
  *interval = (ZpInterval){0};
  if (!dots)
    return zp_fail(err, ZP_BAD_INPUT, "%s: \"%.80s\": write \"ribbon.thickness = 20 um .. 200 um\"", setting, text);
  *equals = *dots = 0;
  char *name = zp_trim(text), *to = zp_trim(dots + 2), *blank = strrchr(to, ' ');
  interval->by_factors = blank && strcmp(blank + 1, "log") == 0;
  if (interval->by_factors) *blank = 0;
  interval->key = zp_key_named(setting, name, err);
  if (interval->key < 0) return ZP_BAD_INPUT;
  if (zp_key(interval->key)->type != ZP_KEY_REAL && zp_key(interval->key)->type != ZP_KEY_REAL_AUTO)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %s is not a real number", setting, name);
  char part[ZP_VALUE_SIZE];
  snprintf(part, sizeof part, "%s: %s", setting, ZP_KEY_NAME(interval->key));
  ZpStatus status = zp_value_read_part(interval->key, part, zp_trim(equals + 1), &interval->from, err);
  if (status == ZP_OK) status = zp_value_read_part(interval->key, part, zp_trim(to), &interval->to, err);
  return status == ZP_OK ? check_interval(setting, interval, err) : status;
}

/* -- distributions ------------------------------------------------------------------------------------- */

static bool has_ends(ZpDistributionKind kind) {
  return kind == ZP_DISTRIBUTION_UNIFORM || kind == ZP_DISTRIBUTION_LOG_UNIFORM;
}

size_t zp_part_first(ZpDistributionKind kind) {
  return ZP_PART_NORMAL + (size_t)kind - 1;
}

size_t zp_part_second(ZpDistributionKind kind) {
  return has_ends(kind) ? ZP_PART_TO : ZP_PART_SIGMA;
}

ZpDistributionKind zp_parts_kind(const ZpParts *parts) {
  for (int k = 1; k < ZpDistributionKind_COUNT; k++)
    if (parts->text[zp_part_first((ZpDistributionKind)k)]) return (ZpDistributionKind)k;
  return ZP_DISTRIBUTION_NONE;
}

static ZpDistributionKind kind_of(const char *word, size_t length) {
  for (int k = 1; k < ZpDistributionKind_COUNT; k++) {
    const char *name = zp_part_name[zp_part_first((ZpDistributionKind)k)];
    if (strlen(name) == length && strncmp(name, word, length) == 0) return (ZpDistributionKind)k;
  }
  return ZP_DISTRIBUTION_NONE;
}

bool zp_spread_is(const char *text) {
  text += strspn(text, " ");
  const size_t length = strcspn(text, " (");
  return kind_of(text, length) != ZP_DISTRIBUTION_NONE && *(text + length + strspn(text + length, " ")) == '(';
}

ZpStatus zp_spread_split(char *text, ZpParts *parts, ZpError *err) {
  char *open = strchr(text, '('), *comma = open ? strchr(open, ',') : NULL, *close = comma ? strchr(comma, ')') : NULL;
  *parts = (ZpParts){{NULL}};
  if (!close || *(close + 1 + strspn(close + 1, " ")))
    return zp_fail(err, ZP_BAD_INPUT, "not a distribution; write \"normal(50 um, 1 um)\"");
  text += strspn(text, " ");
  const ZpDistributionKind kind = kind_of(text, strcspn(text, " ("));
  while (close[-1] == ' ')
    close--;
  *comma = *close = 0;
  parts->text[zp_part_first(kind)] = open + 1;
  parts->text[zp_part_second(kind)] = comma + 1;
  return ZP_OK;
}

/* A standard deviation: in the unit of the key, or of a logarithm without a unit. */
static ZpStatus read_sigma(int index, ZpDistributionKind kind, const char *text, double *sigma, ZpError *err) {
  ZpError reason = {ZP_BAD_INPUT, "give a number above 0"};
  ZpStatus status = ZP_OK;
  text += strspn(text, " ");
  if (kind == ZP_DISTRIBUTION_NORMAL)
    status = zp_value_quantity(index, text, sigma, &reason);
  else if (!zp_number_read(text, sigma))
    status = zp_fail(
        &reason, ZP_BAD_INPUT,
        "with lognormal sigma is the standard deviation of the natural logarithm; give a number without a unit");
  if (status == ZP_OK && isfinite(*sigma) && *sigma > 0) return ZP_OK;
  return zp_fail(err, reason.status, "sigma = \"%.60s\": %.300s", text, reason.message);
}

static ZpStatus check_spread(const ZpDistribution *d, ZpError *err) {
  const bool positive = d->kind == ZP_DISTRIBUTION_LOGNORMAL || d->kind == ZP_DISTRIBUTION_LOG_UNIFORM;
  if (positive && !(d->a > 0))
    return zp_fail(err, ZP_BAD_INPUT, "%s takes values above 0", zp_part_name[zp_part_first(d->kind)]);
  if (has_ends(d->kind) && !(d->a < d->b))
    return zp_fail(err, ZP_BAD_INPUT, "%s: the second number must be larger than the first",
                   zp_part_name[zp_part_first(d->kind)]);
  return ZP_OK;
}

ZpStatus zp_spread_read(int index, const ZpParts *parts, ZpDistribution *d, ZpError *err) {
  *d = (ZpDistribution){.kind = zp_parts_kind(parts)};
  const size_t first = zp_part_first(d->kind), second = zp_part_second(d->kind);
  const char *b = parts->text[second];
  if (!b) return zp_fail(err, ZP_BAD_INPUT, "write {%s: ..., %s: ...}", zp_part_name[first], zp_part_name[second]);
  ZpStatus status = zp_value_read_part(index, zp_part_name[first], parts->text[first], &d->a, err);
  if (status != ZP_OK) return status;
  status = has_ends(d->kind) ? zp_value_read_part(index, zp_part_name[second], b, &d->b, err)
                             : read_sigma(index, d->kind, b, &d->b, err);
  return status == ZP_OK ? check_spread(d, err) : status;
}

void zp_spread_print(int index, const ZpDistribution *d, char *text, size_t size) {
  char a[ZP_VALUE_SIZE], b[ZP_VALUE_SIZE];
  zp_value_print(index, d->a, a, sizeof a);
  if (d->kind == ZP_DISTRIBUTION_LOGNORMAL)
    zp_number_print(d->b, b, sizeof b);
  else
    zp_value_print(index, d->b, b, sizeof b);
  snprintf(text, size, "%s(%.100s, %.100s)", zp_part_name[zp_part_first(d->kind)], a, b);
}
