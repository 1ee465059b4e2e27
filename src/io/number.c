/* Numbers as text, with a decimal point, which files must have in the locale of any user.
 *
 * 15 digits are enough for every double that came from a short decimal, 17 for any. So the first of 15, 16, 17 digits
 * that reads back gives the shortest text, once "%g" has dropped its trailing zeros. Subnormal numbers have fewer
 * digits, so the search starts at one there. */
#include "io/number.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Fewest digits that read back of a number from 1e-7 to 1e15, decided without printing, which takes longer. Other
 * numbers: 0. */
#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 Wide;

/* Is m 2^e, of which 10^f is the leading digit, the nearest double to itself rounded to so many digits? In units of
 * 2^-s of the last digit it is an integer, m 5^k, and so is the distance to the next double, 5^k. Below a power of two
 * that is half of it, but none of fewest_digits() is between a quarter and a half of 5^k from its rounded value. */
static bool reads_back(uint64_t m, int e, int f, int digits) {
  const int k = digits - 1 - f, s = -(e + k);
  uint64_t fives = 1;
  for (int i = 0; i < k; i++)
    fives *= 5;
  const Wide one = (Wide)1 << s, down = (Wide)m * fives & (one - 1), up = one - down;
  return (down < up ? down : up) * 2 < fives;
}

static int fewest_digits(double a) {
  static const double ten_to[] = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1,    1e1,  1e2,  1e3, 1e4,
                                  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  int e, f = -7;
  if (!(a >= 1e-7 && a < 1e15)) return 0;
  const uint64_t m = (uint64_t)ldexp(frexp(a, &e), DBL_MANT_DIG);
  while (a >= ten_to[f + 8])
    f++;
  e -= DBL_MANT_DIG;
  return reads_back(m, e, f, 15) ? 15 : reads_back(m, e, f, 16) ? 16 : 17;
}
#else
static int fewest_digits(double a) {
  (void)a;
  return 0;
}
#endif

/* Print with a decimal point or, below 1e-4 and from 1e16 on, with an exponent. */
static void print_shortest(double value, char *text) {
  const double a = fabs(value);
  int digits = fewest_digits(a);
  if (digits > 0) {
    snprintf(text, ZP_NUMBER_SIZE, "%.*g", digits, value);
    return;
  }
  digits = a < DBL_MIN ? 1 : a < 1e15 || a >= 1e16 ? DBL_DIG : 16; /* "%.15g" would write 1e15 with an exponent */
  do
    snprintf(text, ZP_NUMBER_SIZE, "%.*g", digits, value);
  while (digits++ < 17 && strtod(text, NULL) != value);
  if (digits > 17 && a >= 1e16 && a < 1e17)
    snprintf(text, ZP_NUMBER_SIZE, "%.16e", value); /* "%.17g" would write none */
}

/* The decimal sign of the user's locale, which may have several bytes, becomes a point. */
static void put_point(char *text) {
  char *sign = text + (*text == '-');
  while (*sign >= '0' && *sign <= '9')
    sign++;
  if (*sign == 0 || *sign == '.' || *sign == 'e') return;
  const char *fraction = strpbrk(sign, "0123456789");
  *sign = '.';
  memmove(sign + 1, fraction, strlen(fraction) + 1);
}

void zp_number_print(double value, char *text, size_t size) {
  char whole[ZP_NUMBER_SIZE] = "nan";
  if (isinf(value)) snprintf(whole, sizeof whole, "%s", value < 0 ? "-inf" : "inf");
  if (isfinite(value)) {
    print_shortest(value, whole);
    put_point(whole);
  }
  const size_t length = strlen(whole), room = length < size ? length : size - 1;
  memcpy(text, whole, room);
  text[room] = 0;
}

/* The point becomes the decimal sign of the user's locale. False if there is no room. */
static bool put_sign(const char *text, const char *sign, char *copy, size_t size) {
  const char *point = strchr(text, '.');
  const int before = point ? (int)(point - text) : (int)strlen(text);
  const int length = snprintf(copy, size, "%.*s%s%s", before, text, point ? sign : "", point ? point + 1 : "");
  return length < (int)size && !strstr(text, sign);
}

bool zp_number_read(const char *text, double *value) {
  enum { LONGEST = 1100 }; /* digits of any double, and more */
  char copy[LONGEST], *end;
  const char *sign = localeconv()->decimal_point;
  const bool plain = strcmp(sign, ".") == 0;
  if (!plain && !put_sign(text, sign, copy, sizeof copy)) return false;
  const char *from = plain ? text : copy;
  *value = strtod(from, &end);
  return end > from && *(end + strspn(end, " ")) == 0;
}
