/* Shortest decimal text of a double that reads back to the same bits.
 *
 * 15 digits are enough for every double that came from a short decimal, 17 for any; so the first of 15, 16, 17 that
 * reads back is the shortest once its trailing zeros are dropped. For numbers of usual size, all integers of the search
 * fit in 128 bits: it is made there, exactly. For others the C library prints and reads back: from its "%e" digits and
 * exponent are taken and laid out here, because printf writes the decimal sign of the user's locale and files must not.
 * Subnormal numbers have fewer digits, so the search starts at one there. */
#include "io/number.h"

#include <ctype.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_DIGITS 17

/* A decimal: 0.d1d2d3... times 10^point. */
typedef struct Decimal {
  char digit[MAX_DIGITS + 1]; /* no trailing zeros; at least one digit */
  int digits;
  int point;
  bool negative;
} Decimal;

static Decimal decimal_of_text(const char *text) {
  Decimal d = {.negative = text[0] == '-'};
  const char *exponent = strchr(text, 'e');
  for (const char *c = text; c < exponent; c++)
    if (isdigit((unsigned char)*c)) d.digit[d.digits++] = *c;
  while (d.digits > 1 && d.digit[d.digits - 1] == '0')
    d.digits--;
  d.digit[d.digits] = 0;
  d.point = (int)strtol(exponent + 1, NULL, 10) + 1;
  return d;
}

static Decimal decimal_by_library(double value) {
  char text[ZP_NUMBER_SIZE];
  int digits = fabs(value) < DBL_MIN ? 1 : DBL_DIG;
  do {
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
  } while (digits++ < MAX_DIGITS && strtod(text, NULL) != value);
  return decimal_of_text(text);
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 Wide;

static const uint64_t ten_to_16 = UINT64_C(10000000000000000), ten_to_17 = UINT64_C(100000000000000000);

/* A positive double as X / 2^shift: its 17 digits as an integer, D, and below them a fraction of `shift` bits, exactly.
 * The distance to the next double is `step` in units of X. */
typedef struct Scaled {
  Wide X;
  int shift, point; /* D is in units of 10^(point - 17) */
  uint64_t step;
  bool lowest; /* it is a power of two: doubles below it are twice as dense */
} Scaled;

static uint64_t power_of_5(int k) {
  uint64_t power = 1;
  for (uint64_t base = 5; k > 0; k >>= 1, base *= base)
    if (k & 1) power *= base;
  return power;
}

static uint64_t digits_of(const Scaled *s) {
  return (uint64_t)(s->X >> s->shift);
}

/* 10^point is the power of ten above the number, if `point` is right. False if 128 bits are not enough. */
static bool scale(uint64_t m, int e, int point, Scaled *s) {
  enum { MOST_FIVES = 27 };
  const int k = MAX_DIGITS - point;
  if (k < 0 || k > MOST_FIVES) return false;
  const int shift = -(e + k);
  if (shift < 1 || shift > 64) return false;
  const uint64_t fives = power_of_5(k);
  *s = (Scaled){(Wide)m * fives, shift, point, fives, m == UINT64_C(1) << (DBL_MANT_DIG - 1)};
  return true;
}

static bool scale_number(double value, Scaled *s) {
  int e;
  const uint64_t m = (uint64_t)ldexp(frexp(value, &e), DBL_MANT_DIG);
  e -= DBL_MANT_DIG;
  const int least =
      (int)floor((e + DBL_MANT_DIG - 1) * 0.30102999566398120) + 1; /* log10 of 2: the exponent is this, or one more */
  if (!scale(m, e, least, s)) return false;
  return digits_of(s) < ten_to_17 || scale(m, e, least + 1, s);
}

/* The number rounded to a multiple of `unit` of its digits, ties to even. */
static uint64_t rounded(const Scaled *s, uint64_t unit) {
  const uint64_t D = digits_of(s), down = D / unit;
  const Wide rest = s->X - ((Wide)(down * unit) << s->shift), half = ((Wide)unit << s->shift) / 2;
  return rest > half || (rest == half && down % 2 == 1) ? down + 1 : down;
}

/* Is this double the nearest one to a decimal, D in its units? A tie between two doubles cannot occur: it would make an
 * odd number of steps even. */
static bool reads_back(const Scaled *s, uint64_t D) {
  const Wide C = (Wide)D << s->shift;
  const bool below = C < s->X;
  return (below ? s->X - C : C - s->X) * (below && s->lowest ? 4 : 2) < s->step;
}

/* False if the number is too large or too small for this. */
static bool decimal_exactly(double value, Decimal *d) {
  Scaled s;
  uint64_t unit = 100;
  if (!isnormal(value) || !scale_number(fabs(value), &s) || digits_of(&s) < ten_to_16) return false;
  while (unit > 1 && !reads_back(&s, rounded(&s, unit) * unit))
    unit /= 10;
  uint64_t D = rounded(&s, unit) * unit;
  *d = (Decimal){.digits = MAX_DIGITS, .point = s.point + (D == ten_to_17), .negative = value < 0};
  if (D == ten_to_17) D = ten_to_16;
  for (int i = MAX_DIGITS; i-- > 0; D /= 10)
    d->digit[i] = (char)('0' + D % 10);
  while (d->digits > 1 && d->digit[d->digits - 1] == '0')
    d->digits--;
  d->digit[d->digits] = 0;
  return true;
}
#else
static bool decimal_exactly(double value, Decimal *d) {
  (void)value, (void)d;
  return false;
}
#endif

static Decimal decimal_shortest(double value) {
  Decimal d;
  return decimal_exactly(value, &d) ? d : decimal_by_library(value);
}

/* Append `count` characters. */
static char *put(char *end, const char *text, int count) {
  memcpy(end, text, (size_t)count);
  return end + count;
}

static char *put_zeros(char *end, int count) {
  memset(end, '0', (size_t)count);
  return end + count;
}

/* 0.00123: zeros stand between the point and the digits. */
static char *put_small(char *end, const Decimal *d) {
  end = put_zeros(put(end, "0.", 2), -d->point);
  return put(end, d->digit, d->digits);
}

/* 123.4 or 123000. */
static char *put_plain(char *end, const Decimal *d) {
  if (d->point >= d->digits) return put_zeros(put(end, d->digit, d->digits), d->point - d->digits);
  end = put(put(end, d->digit, d->point), ".", 1);
  return put(end, d->digit + d->point, d->digits - d->point);
}

enum { EXPONENT_SIZE = sizeof "e-324" };

/* 1.234e-09 */
static char *put_exponent(char *end, const Decimal *d) {
  end = put(end, d->digit, 1);
  if (d->digits > 1) end = put(end, ".", 1);
  end = put(end, d->digit + 1, d->digits - 1);
  return end + snprintf(end, EXPONENT_SIZE, "e%+03d", d->point - 1);
}

static char *put_decimal(char *end, const Decimal *d) {
  if (d->negative) end = put(end, "-", 1);
  if (d->point > 16 || d->point < -3) return put_exponent(end, d);
  return d->point > 0 ? put_plain(end, d) : put_small(end, d);
}

static const char *word_of(double value) {
  return isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
}

void zp_number_print(double value, char *text, size_t size) {
  char whole[ZP_NUMBER_SIZE];
  if (!isfinite(value)) {
    snprintf(text, size, "%s", word_of(value));
    return;
  }
  const Decimal d = decimal_shortest(value);
  const size_t length = (size_t)(put_decimal(whole, &d) - whole), room = length < size ? length : size - 1;
  memcpy(text, whole, room);
  text[room] = 0;
}

bool zp_number_read(const char *text, double *value) {
  char *end;
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!plain) return false;
  *value = strtod_l(text, &end, plain);
  freelocale(plain);
  return end > text && *(end + strspn(end, " ")) == 0;
}
