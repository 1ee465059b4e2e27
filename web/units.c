/* Units of the page and of the command for Windows, instead of src/io/units.c with UDUNITS: products of powers of the
 * units below with SI prefixes, such as "N s2/mm2". */
#include "io/units.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/fail.h"

enum { BASES = 4 };

/* A power of ten, a factor and powers of m, g, s and A; angles are pure numbers. */
typedef struct Unit {
  int ten;
  double factor;
  int power[BASES];
} Unit;

static const struct {
  const char *text;
  int ten;
} prefixes[] = {{"", 0},   {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6}, {"m", -3},
                {"c", -2}, {"d", -1},  {"h", 2},   {"k", 3},  {"M", 6},  {"G", 9},  {"T", 12}};

static const struct {
  const char *text;
  Unit unit;
} symbols[] = {{"m", {0, 1, {1}}},
               {"L", {-3, 1, {3}}},
               {"g", {0, 1, {0, 1}}},
               {"s", {0, 1, {0, 0, 1}}},
               {"Hz", {0, 1, {0, 0, -1}}},
               {"St", {-4, 1, {2, 0, -1}}},
               {"A", {0, 1, {0, 0, 0, 1}}},
               {"N", {3, 1, {1, 1, -2}}},
               {"Pa", {3, 1, {-1, 1, -2}}},
               {"V", {3, 1, {2, 1, -3, -1}}},
               {"ohm", {3, 1, {2, 1, -3, -2}}},
               {"F", {-3, 1, {-2, -1, 4, 2}}},
               {"J", {3, 1, {2, 1, -2}}},
               {"W", {3, 1, {2, 1, -3}}},
               {"C", {0, 1, {0, 0, 1, 1}}},
               {"rad", {0, 1, {0}}},
               {"deg", {0, 0.017453292519943295, {0}}},
               {"degree", {0, 0.017453292519943295, {0}}}};

static bool is_word(const char *text, size_t length, const char *prefix, const char *symbol) {
  size_t before = strlen(prefix);
  return before + strlen(symbol) == length && strncmp(text, prefix, before) == 0 &&
         strncmp(text + before, symbol, length - before) == 0;
}

/* (symbol with its prefix) => unit; false of one that is not known. */
static bool read_word(const char *text, size_t length, Unit *unit) {
  for (size_t s = 0; s < sizeof symbols / sizeof symbols[0]; s++)
    for (size_t p = 0; p < sizeof prefixes / sizeof prefixes[0]; p++)
      if (is_word(text, length, prefixes[p].text, symbols[s].text)) {
        *unit = symbols[s].unit;
        unit->ten += prefixes[p].ten;
        return true;
      }
  return false;
}

/* Of "2", "-2", "^2", "^-2" at `text`, which moves beyond it; 1 where there is none. */
static int read_power(const char **text) {
  const char *c = *text + (**text == '^');
  bool negative = *c == '-';
  c += negative;
  if (!isdigit((unsigned char)*c)) return 1;
  *text = c + 1;
  return negative ? '0' - *c : *c - '0';
}

/* The prefix belongs to its symbol: a mm2 is (1e-3 m)^2. */
static void multiply(Unit *product, const Unit *unit, int power) {
  product->ten += power * unit->ten;
  product->factor *= pow(unit->factor, power);
  for (int i = 0; i < BASES; i++)
    product->power[i] += power * unit->power[i];
}

static bool read_unit(const char *text, Unit *product) {
  *product = (Unit){.factor = 1};
  int sign = 1;
  if (strncmp(text, "1/", 2) == 0) sign = -1, text += 2;
  for (;;) {
    Unit unit;
    size_t length = strcspn(text, " .*/^-0123456789");
    if (!read_word(text, length, &unit)) return false;
    text += length;
    multiply(product, &unit, sign * read_power(&text));
    if (*text == 0) return true;
    if (!strchr(" .*/", *text)) return false;
    sign = *text++ == '/' ? -1 : 1;
  }
}

ZpStatus zp_unit_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  Unit given, wanted;
  if (!read_unit(to, &wanted)) return zp_fail(err, ZP_MACHINE, "no unit %s", to);
  if (!read_unit(from, &given)) return zp_fail(err, ZP_BAD_INPUT, "unknown unit \"%s\"", from);
  if (memcmp(given.power, wanted.power, sizeof given.power) != 0) return zp_unit_fail_dimension(to, err);
  int ten = given.ten - wanted.ten;
  double factor = given.factor / wanted.factor;
  *scale = (ZpUnitScale){.decimal = factor == 1, .exponent = ten, .factor = factor == 1 ? 1 : factor * pow(10, ten)};
  return ZP_OK;
}
