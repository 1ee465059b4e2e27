/* Distributions instead of values: {normal: 50 um, sigma: 1 um}, or "normal(50 um, 1 um)". */
#ifndef ZP_IO_SPREAD_H
#define ZP_IO_SPREAD_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/def.h>

#include "sample/distribution.h"

/* The parts of a distribution as written; NULL: not given. */
typedef struct ZpSpread {
  const char *word; /* "normal" */
  const char *a;    /* its first number, after this word: mean, median or lower end */
  const char *b;    /* the second, after "sigma" or "to" */
} ZpSpread;

/* The words of distributions, "normal", ..., by kind; NULL for ZP_DISTRIBUTION_NONE. */
extern const char *const zp_spread_word[ZpDistributionKind_COUNT];

/* The word before the second number in a mapping: "sigma" or "to". */
const char *zp_spread_second(ZpDistributionKind kind);

/* Is a value written as a distribution: one of the words and a parenthesis? */
bool zp_spread_is(const char *text);

/* Split such a text into its parts, in place. ZP_BAD_INPUT shows the correct form. */
ZpStatus zp_spread_split(char *text, ZpSpread *spread, ZpError *err);

/* The distribution of key `index`, whose mean, median or ends must be values of the key. ZP_BAD_INPUT gives the reason.
 */
ZpStatus zp_spread_read(int index, const ZpSpread *spread, ZpDistribution *distribution, ZpError *err);

/* Write it as a text that reads back to the same bits. */
void zp_spread_print(int index, const ZpDistribution *distribution, char *text, size_t size);

#endif
