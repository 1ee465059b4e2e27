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

/* The text without blanks at its ends, in place. */
char *zp_trim(char *text);

/* An interval of a key: "ribbon.thickness = 20 um .. 200 um log". */
typedef struct ZpInterval {
  int key;
  double from, to; /* SI */
  bool by_factors; /* log: in equal factors, both ends above 0 */
} ZpInterval;

/* Read one, in place; `setting` is the key that has it, for messages. ZP_BAD_INPUT says what is wrong. */
ZpStatus zp_interval_read(const char *setting, char *text, ZpInterval *interval, ZpError *err);

#endif
