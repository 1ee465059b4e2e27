#include "io/spread.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "io/number.h"
#include "io/value.h"

const char *const zp_spread_word[ZpDistributionKind_COUNT] = {[ZP_DISTRIBUTION_NORMAL] = "normal",
                                                              [ZP_DISTRIBUTION_LOGNORMAL] = "lognormal",
                                                              [ZP_DISTRIBUTION_UNIFORM] = "uniform",
                                                              [ZP_DISTRIBUTION_LOG_UNIFORM] = "log_uniform"};

static bool has_ends(ZpDistributionKind kind) {
  return kind == ZP_DISTRIBUTION_UNIFORM || kind == ZP_DISTRIBUTION_LOG_UNIFORM;
}

const char *zp_spread_second(ZpDistributionKind kind) {
  return has_ends(kind) ? "to" : "sigma";
}

static ZpDistributionKind kind_of(const char *word, size_t length) {
  for (int k = 1; k < ZpDistributionKind_COUNT; k++)
    if (strlen(zp_spread_word[k]) == length && strncmp(zp_spread_word[k], word, length) == 0)
      return (ZpDistributionKind)k;
  return ZP_DISTRIBUTION_NONE;
}

bool zp_spread_is(const char *text) {
  text += strspn(text, " ");
  const size_t length = strcspn(text, " (");
  return kind_of(text, length) != ZP_DISTRIBUTION_NONE && *(text + length + strspn(text + length, " ")) == '(';
}

ZpStatus zp_spread_split(char *text, ZpSpread *spread, ZpError *err) {
  char *open = strchr(text, '('), *comma = open ? strchr(open, ',') : NULL, *close = comma ? strchr(comma, ')') : NULL;
  if (!close || *(close + 1 + strspn(close + 1, " ")))
    return zp_fail(err, ZP_BAD_INPUT, "not a distribution; write \"normal(50 um, 1 um)\"");
  text += strspn(text, " ");
  text[strcspn(text, " (")] = 0;
  while (close[-1] == ' ')
    close--;
  *comma = *close = 0;
  *spread = (ZpSpread){text, open + 1, comma + 1};
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

static ZpStatus check(const ZpDistribution *d, ZpError *err) {
  const bool positive = d->kind == ZP_DISTRIBUTION_LOGNORMAL || d->kind == ZP_DISTRIBUTION_LOG_UNIFORM;
  if (positive && !(d->a > 0)) return zp_fail(err, ZP_BAD_INPUT, "%s takes values above 0", zp_spread_word[d->kind]);
  if (has_ends(d->kind) && !(d->a < d->b))
    return zp_fail(err, ZP_BAD_INPUT, "%s: the second number must be larger than the first", zp_spread_word[d->kind]);
  return ZP_OK;
}

ZpStatus zp_spread_read(int index, const ZpSpread *spread, ZpDistribution *d, ZpError *err) {
  *d = (ZpDistribution){.kind = kind_of(spread->word, strlen(spread->word))};
  const char *second = zp_spread_second(d->kind);
  if (!spread->a || !spread->b)
    return zp_fail(err, ZP_BAD_INPUT, "write {%s: ..., %s: ...}", zp_spread_word[d->kind], second);
  ZpStatus status = zp_value_read_part(index, zp_spread_word[d->kind], spread->a, &d->a, err);
  if (status != ZP_OK) return status;
  status = has_ends(d->kind) ? zp_value_read_part(index, second, spread->b, &d->b, err)
                             : read_sigma(index, d->kind, spread->b, &d->b, err);
  return status == ZP_OK ? check(d, err) : status;
}

void zp_spread_print(int index, const ZpDistribution *d, char *text, size_t size) {
  char a[ZP_VALUE_SIZE], b[ZP_VALUE_SIZE];
  zp_value_print(index, d->a, a, sizeof a);
  if (d->kind == ZP_DISTRIBUTION_LOGNORMAL)
    zp_number_print(d->b, b, sizeof b);
  else
    zp_value_print(index, d->b, b, sizeof b);
  snprintf(text, size, "%s(%.100s, %.100s)", zp_spread_word[d->kind], a, b);
}
