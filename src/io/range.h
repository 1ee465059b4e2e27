/* Ranges of values, in place of a list: from, to, how many, in equal steps or by equal factors. */
#ifndef ZP_IO_RANGE_H
#define ZP_IO_RANGE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/def.h>

/* The parts of a range as written; NULL: not given. */
typedef struct ZpRange {
  const char *from, *to, *count;
  const char *spacing; /* "linear", the default, or "log" */
} ZpRange;

/* Whether a value is written as a range: "10 um .. 200 um : 20". */
bool zp_range_is(const char *text);

/* Cut such a text into its parts, in place. ZP_BAD_INPUT says how it is written. */
ZpStatus zp_range_split(char *text, ZpRange *range, ZpError *err);

/* The values of a range of key `index`, both ends among them, the others rounded to 12 digits, so that tables show
 * 0.00002 and not 0.000019999999999999998 => *value [*count], to be freed. ZP_BAD_INPUT says which part is wrong. */
ZpStatus zp_range_read(int index, const ZpRange *range, double **value, size_t *count, ZpError *err);

/* To 12 digits: more than any key needs, and fewer than the rounding of what is computed reaches. */
double zp_rounded(double value);

#endif
