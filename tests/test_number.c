/* Numbers as text: short, exact, and those of the C library, which prints all digits and reads them. */
#include "check_util.h"

#include <locale.h>

#include "io/number.h"

TEST(numbers_are_short_and_exact) {
  const struct {
    double value;
    const char *text;
  } known[] = {{0.1, "0.1"},
               {0, "0"},
               {-0.0, "-0"},
               {75e-3, "0.075"},
               {130e-6, "0.00013"},
               {1e-6, "1e-06"},
               {10e3, "10000"},
               {1e16, "1e+16"},
               {200e9, "200000000000"},
               {-12.5, "-12.5"},
               {1.5e-9, "1.5e-09"},
               {5e-324, "5e-324"},
               {0.1 + 0.2, "0.30000000000000004"},
               {NAN, "nan"},
               {-INFINITY, "-inf"},
               {1e15, "1000000000000000"},
               {12345678901234568, "1.2345678901234568e+16"}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    char text[ZP_NUMBER_SIZE];
    zp_number_print(known[i].value, text, sizeof text);
    ck_assert_str_eq(text, known[i].text);
  }
}

TEST(numbers_read_back) {
  uint64_t bits = 88172645463325252u;
  for (int i = 0; i < 200000; i++) {
    char text[ZP_NUMBER_SIZE];
    double value, again;
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    memcpy(&value, &bits, sizeof value);
    if (!isfinite(value)) continue;
    if (i % 2) value = (double)(int64_t)bits * 1e-12;
    zp_number_print(value, text, sizeof text);
    again = strtod(text, NULL);
    ck_assert_msg(memcmp(&value, &again, sizeof value) == 0, "%.17g became %s", value, text);
  }
}

/* The digits and the exponent of what the C library prints with the fewest of 15, 16, 17 digits that read back, zeros
 * at the end left out; of 0.00123 and 1.23e-03 alike. */
static void digits_of(const char *text, char *digits, size_t size, int *exponent) {
  size_t used = 0, point = strcspn(text, ".e");
  const char *e = strchr(text, 'e'), *end = e ? e : text + strlen(text);
  *exponent = e ? (int)strtol(e + 1, NULL, 10) : 0;
  *exponent += (int)point - 1;
  bool begun = false;
  for (const char *c = text; c < end; c++) {
    if (*c == '.') continue;
    begun |= *c != '0';
    if (!begun) *exponent -= 1;
    if (begun && used + 1 < size) digits[used++] = *c;
  }
  while (used > 1 && digits[used - 1] == '0')
    used--;
  digits[used] = 0;
}

static void same_as_library(double value) {
  char text[ZP_NUMBER_SIZE], library[ZP_NUMBER_SIZE], ours[ZP_NUMBER_SIZE], theirs[ZP_NUMBER_SIZE];
  int digits = 15, our_exponent, their_exponent;
  do {
    snprintf(library, sizeof library, "%.*e", digits - 1, value);
  } while (digits++ < 17 && strtod(library, NULL) != value);
  zp_number_print(value, text, sizeof text);
  digits_of(text, ours, sizeof ours, &our_exponent);
  digits_of(library, theirs, sizeof theirs, &their_exponent);
  ck_assert_msg(strcmp(ours, theirs) == 0 && our_exponent == their_exponent, "%s, but the C library: %s", text,
                library);
}

TEST(numbers_are_those_of_the_library) {
  for (int e = -1021; e < 1024; e++) /* about powers of two, below which doubles are denser */
    for (int side = -1; side < 2; side++)
      same_as_library(nextafter(ldexp(1, e), side < 0 ? 0 : side > 0 ? INFINITY : ldexp(1, e)));
  uint64_t bits = 88172645463325252u;
  for (int i = 0; i < 250000; i++) {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    const double power = ldexp(1, (int)(bits % 120) - 60), ten = pow(10, (int)(bits % 40) - 20);
    switch (i % 4) {
    case 0: /* any digits, sizes 1e-11 .. 1e11 */
      same_as_library(ldexp((double)(bits >> 11), -53 - 36 + (int)(bits % 73)));
      break;
    case 1: /* short decimals */
      same_as_library((double)(bits >> 44) / pow(10, (double)(bits % 14)));
      break;
    case 2: /* many end in 5, a half of some digit */
      same_as_library((double)(bits >> 38) * power);
      break;
    default: /* about powers of ten, which 9.99... is rounded to */
      same_as_library(bits % 3 == 0 ? ten : nextafter(ten, bits % 3 == 1 ? 0 : INFINITY));
    }
  }
}

/* A locale of our own, with a decimal comma; on a machine that cannot make one, that of the caller. */
static void take_a_comma(void) {
  FILE *file = fopen("comma", "w");
  ck_assert_ptr_nonnull(file);
  fputs("LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \"\"\ngrouping -1\nEND LC_NUMERIC\n", file);
  ck_assert_int_eq(fclose(file), 0);
  if (system("localedef -c -i ./comma ./xx_XX 2>localedef.log") < 0) return; // NOLINT: the command is the test's own
  setenv("LOCPATH", ".", 1);
  setlocale(LC_NUMERIC, "xx_XX");
}

TEST(numbers_have_a_point_in_any_locale) {
  char text[ZP_NUMBER_SIZE], own[ZP_NUMBER_SIZE];
  double value;
  take_a_comma();
  snprintf(own, sizeof own, "%g", 0.5);
  printf("one half here: %s\n", own);
  zp_number_print(0.1 + 0.2, text, sizeof text);
  ck_assert_str_eq(text, "0.30000000000000004");
  ck_assert(zp_number_read(" 2.5 ", &value) && value == 2.5);
  ck_assert(!zp_number_read("2,5", &value) && !zp_number_read("", &value));
  snprintf(text, sizeof text, "%g", 0.5); /* the locale of the caller is as before */
  ck_assert_str_eq(text, own);
}
