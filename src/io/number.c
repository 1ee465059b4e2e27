/* Numbers as text, in the C locale, because files must have a decimal point in the locale of any user.
 *
 * 15 digits are enough for every double that came from a short decimal, 17 for any. So the first of 15, 16, 17 digits
 * that reads back gives the shortest text, once "%g" has dropped its trailing zeros. Subnormal numbers have fewer
 * digits, so the search starts at one there. */
#include "io/number.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Do 15 digits of a number from 1e-7 to 1e15 read back? Decided without printing: the 15 digits as an integer D are
 * exact, a power of ten up to 1e22 is exact, so D / 10^k is the double that reading them gives. */
static bool has_15_digits(double a) {
  static const double ten_to[] = {1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  int e;
  frexp(a, &e);
  int k = 14 - (int)floor((e - 1) * 0.30102999566398120); /* log10 of 2: D has 15 digits, or 16 */
  double D = nearbyint(a * ten_to[k]);
  if (D >= 1e15 && k > 0) D = nearbyint(a * ten_to[--k]);
  return D / ten_to[k] == a;
}

/* Print with a decimal point or, below 1e-4 and from 1e16 on, with an exponent. */
static void print_shortest(double value, char *text) {
  const double a = fabs(value);
  const bool usual = a >= 1e-7 && a < 1e15;
  int digits = a < DBL_MIN ? 1 : a < 1e15 || a >= 1e16 ? DBL_DIG : 16; /* "%.15g" would write 1e15 with an exponent */
  if (usual && has_15_digits(a)) {
    snprintf(text, ZP_NUMBER_SIZE, "%.15g", value);
    return;
  }
  if (usual) digits = 16;
  do
    snprintf(text, ZP_NUMBER_SIZE, "%.*g", digits, value);
  while (digits++ < 17 && strtod(text, NULL) != value);
  if (digits > 17 && a >= 1e16 && a < 1e17)
    snprintf(text, ZP_NUMBER_SIZE, "%.16e", value); /* "%.17g" would write none */
}

void zp_number_print(double value, char *text, size_t size) {
  char whole[ZP_NUMBER_SIZE];
  const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0), before = uselocale(plain);
  print_shortest(value, whole);
  uselocale(before);
  freelocale(plain);
  snprintf(text, size, "%s", isnan(value) ? "nan" : whole);
}

bool zp_number_read(const char *text, double *value) {
  char *end;
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!plain) return false;
  *value = strtod_l(text, &end, plain);
  freelocale(plain);
  return end > text && *(end + strspn(end, " ")) == 0;
}
