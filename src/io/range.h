/* Texts that may stand instead of a value or a list: a range, with first and last value, number of values, equal steps
 * or equal ratios; an interval; a distribution. */
#ifndef ZP_IO_RANGE_H
#define ZP_IO_RANGE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/def.h>

#include "sample/distribution.h"

/* The parts of a range, {from: 10 um, to: 200 um, count: 20, spacing: log}, and of a distribution, {normal: 50 um,
 * sigma: 1 um}: the words of distributions, by kind, are the last ones. */
enum {
  ZP_PART_FROM,
  ZP_PART_TO,
  ZP_PART_COUNT,
  ZP_PART_SPACING, /* "linear", the default, or "log" */
  ZP_PART_SIGMA,
  ZP_PART_NORMAL,
  ZP_PARTS = ZP_PART_NORMAL + ZpDistributionKind_COUNT - 1
};
extern const char *const zp_part_name[ZP_PARTS];

/* As written; NULL: not given. */
typedef struct ZpParts {
  char *text[ZP_PARTS];
} ZpParts;

/* The distribution whose first number is given; ZP_DISTRIBUTION_NONE: the parts are of a range. */
ZpDistributionKind zp_parts_kind(const ZpParts *parts);

/* The parts with the two numbers of a distribution: mean, median or lower end, then sigma or the upper end. */
size_t zp_part_first(ZpDistributionKind kind);
size_t zp_part_second(ZpDistributionKind kind);

/* Is a value written as a range: "10 um .. 200 um : 20"? */
bool zp_range_is(const char *text);

/* Split such a text into its parts, in place. ZP_BAD_INPUT shows the correct form. */
ZpStatus zp_range_split(char *text, ZpParts *parts, ZpError *err);

/* The values of a range of key `index`, both ends included, the others rounded to 12 digits, so that tables show
 * 0.00002 and not 0.000019999999999999998 => *value [*count], to be freed. ZP_BAD_INPUT names the wrong part. */
ZpStatus zp_range_read(int index, const ZpParts *parts, double **value, size_t *count, ZpError *err);

/* The text without blanks at its ends, modified in place. */
char *zp_trim(char *text);

/* An interval of a key: "ribbon.thickness = 20 um .. 200 um log". */
typedef struct ZpInterval {
  int key;
  double from, to; /* SI */
  bool by_factors; /* log: equal ratios, both ends above 0 */
} ZpInterval;

/* Read an interval, in place; messages name the key `setting` that contains it. ZP_BAD_INPUT gives the reason. */
ZpStatus zp_interval_read(const char *setting, char *text, ZpInterval *interval, ZpError *err);

/* -- distributions ------------------------------------------------------------------------------------- */

/* Is a value written as a distribution: one of the words and a parenthesis? */
bool zp_spread_is(const char *text);

/* Split such a text into its parts, in place. ZP_BAD_INPUT shows the correct form. */
ZpStatus zp_spread_split(char *text, ZpParts *parts, ZpError *err);

/* The distribution of key `index`, whose mean, median or ends must be values of the key. ZP_BAD_INPUT gives the reason.
 */
ZpStatus zp_spread_read(int index, const ZpParts *parts, ZpDistribution *distribution, ZpError *err);

/* Write it as a text that reads back to the same bits. */
void zp_spread_print(int index, const ZpDistribution *distribution, char *text, size_t size);

#endif
