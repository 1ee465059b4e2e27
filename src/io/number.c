/* Shortest decimal text of a double that reads back to the same bits.
 *
 * 15 digits are enough for every double that came from a short decimal, 17 for any; so the first of 15,
 * 16, 17 that reads back is the shortest once its trailing zeros are dropped. Digits and exponent are
 * taken from "%e" and laid out here, because printf writes the decimal sign of the user's locale and
 * files must not. Subnormal numbers have fewer digits, so the search starts at one there. */
#include "io/number.h"

#include <ctype.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_DIGITS 17

/* A decimal: 0.d1d2d3... with the point moved `point` places to the right. */
typedef struct Decimal {
  char digit[MAX_DIGITS + 1]; /* no zeros at its end; at least one digit */
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

static Decimal decimal_shortest(double value) {
  char text[ZP_NUMBER_SIZE];
  int digits = fabs(value) < DBL_MIN ? 1 : DBL_DIG;
  do {
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
  } while (digits++ < MAX_DIGITS && strtod(text, NULL) != value);
  return decimal_of_text(text);
}

/* 0.00123: zeros stand between the point and the digits. */
static void print_small(const Decimal *d, char *text, size_t size) {
  snprintf(text, size, "%s0.%.*s%s", d->negative ? "-" : "", -d->point, "0000000000", d->digit);
}

/* 123.4 or 123000. */
static void print_plain(const Decimal *d, char *text, size_t size) {
  const char *sign = d->negative ? "-" : "";
  if (d->point >= d->digits)
    snprintf(text, size, "%s%s%.*s", sign, d->digit, d->point - d->digits, "0000000000000000");
  else
    snprintf(text, size, "%s%.*s.%s", sign, d->point, d->digit, d->digit + d->point);
}

/* 1.234e-09 */
static void print_exponent(const Decimal *d, char *text, size_t size) {
  snprintf(text, size, "%s%c%s%se%+03d", d->negative ? "-" : "", d->digit[0], d->digits > 1 ? "." : "", d->digit + 1,
           d->point - 1);
}

void zp_number_print(double value, char *text, size_t size) {
  if (isnan(value)) {
    snprintf(text, size, "nan");
    return;
  }
  if (isinf(value)) {
    snprintf(text, size, "%s", value < 0 ? "-inf" : "inf");
    return;
  }
  Decimal d = decimal_shortest(value);
  if (d.point > 16 || d.point < -3)
    print_exponent(&d, text, size);
  else if (d.point > 0)
    print_plain(&d, text, size);
  else
    print_small(&d, text, size);
}

bool zp_number_read(const char *text, double *value) {
  char *end;
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!plain) return false;
  *value = strtod_l(text, &end, plain);
  freelocale(plain);
  return end > text && *(end + strspn(end, " ")) == 0;
}
