/* Units of the page and of the command for Windows (web/units.c) against UDUNITS. */
#include "check_util.h"

#include "io/units.h"

ZpStatus page_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err);
#define zp_unit_scale page_scale
#include "../web/units.c"
#undef zp_unit_scale

static const char *const prefix[] = {"", "f", "p", "n", "u", "µ", "m", "c", "d", "h", "k", "M", "G", "T"};

static bool same_scale(const ZpUnitScale *a, const ZpUnitScale *b) {
  if (a->decimal || b->decimal) return a->decimal == b->decimal && a->exponent == b->exponent;
  return fabs(a->factor / b->factor - 1) < 1e-15;
}

/* One conversion by both: equal scales, or refused with equal words. */
static void compare(const char *from, const char *to, bool known) {
  ZpUnitScale page = {0}, command = {0};
  ZpError error[2] = {{ZP_OK, ""}, {ZP_OK, ""}};
  ZpStatus status = page_scale(from, to, &page, &error[0]);
  ck_assert_msg(status == zp_unit_scale(from, to, &command, &error[1]), "%s in %s: \"%s\", by UDUNITS \"%s\"", from, to,
                error[0].message, error[1].message);
  ck_assert_str_eq(error[0].message, error[1].message);
  ck_assert_msg(!known || status == ZP_OK, "%s in %s: %s", from, to, error[0].message);
  if (status != ZP_OK) return;
  ck_assert_msg(same_scale(&page, &command), "%s in %s: 1e%d * %.17g, by UDUNITS 1e%d * %.17g", from, to, page.exponent,
                page.factor, command.exponent, command.factor);
}

static void compare_both_ways(const char *a, const char *b, bool known) {
  compare(a, b, known);
  compare(b, a, known);
}

/* Every unit of a key, and its parts, with every prefix: a prefix belongs to its symbol, so that 1 mm3 is 1e-9 m3. */
TEST(prefixes_belong_to_symbols) {
  for (int k = 0; k < zp_key_count(); k++) {
    const char *unit = zp_key(k)->unit;
    if (!unit || !*unit || strcmp(unit, "1") == 0) continue;
    const char *shown = zp_key(k)->shown, *bare = unit + (strncmp(unit, "kg", 2) == 0);
    if (*shown) compare_both_ways(shown, unit, true);
    for (size_t p = 0; bare[0] != '1' && p < LENGTH_OF(prefix); p++) {
      char text[32];
      snprintf(text, sizeof text, "%s%s", prefix[p], bare);
      compare_both_ways(text, unit, true);
    }
  }
}

TEST(powers_and_products) {
  static const struct {
    const char *from, *to;
  } pairs[] = {{"cm3", "m3"},          {"mm3", "m3"},
               {"um^3", "m3"},         {"mL", "m3"},
               {"uL", "m3"},           {"cm2/s", "m2/s"},
               {"cSt", "m2/s"},        {"mm^2/ms", "m2/s"},
               {"g/cm3", "kg/m3"},     {"N/mm2", "Pa"},
               {"mN/mm", "N/m"},       {"1/mm", "1/m"},
               {"mm-1", "1/m"},        {"mm^-1", "1/m"},
               {"V/um", "V/m"},        {"kV/mm", "V/m"},
               {"V/us", "V/s"},        {"mm/s2", "m/s2"},
               {"um/ms^2", "m/s2"},    {"1/ms", "Hz"},
               {"Mohm cm", "ohm m"},   {"kN/m.ms2/m", "N s2/m2"},
               {"N*m/rad", "N m/rad"}, {"N m/degree", "N m/rad"},
               {"deg", "rad"},         {"mrad", "rad"},
               {"V/mm/s", "V/m/s"},    {"V/pF", "V/F"},
               {"mW s", "J"},          {"uA s", "C"},
               {"V A", "W"},           {"C/V", "F"}};
  for (size_t i = 0; i < LENGTH_OF(pairs); i++)
    compare(pairs[i].from, pairs[i].to, true);
}

TEST(other_units_are_refused) {
  static const char *const wrong[] = {"m2",       "s",  "Hz",   "mm3/s",     "kV",  "xyz", "m m",
                                      "m/",       "/m", "2 m",  "5 mm",      "m 5", "1",   "mm2.",
                                      "kg extra", "m^", "m--2", "mm^999999", "mm@3"};
  for (size_t i = 0; i < LENGTH_OF(wrong); i++)
    compare(wrong[i], "m", false);
  compare("s", "Hz", false);
  compare("m/1", "1/m", false);
}
