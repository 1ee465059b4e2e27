/* Units of the page, instead of src/io/units.c with UDUNITS: those of keys.def with SI prefixes. */
#include "io/units.h"

#include <stddef.h>
#include <string.h>

#include "base/fail.h"

static const struct {
  const char *prefix;
  int exponent;
} prefixes[] = {{"", 0},   {"p", -12}, {"n", -9}, {"u", -6}, {"µ", -6},
                {"m", -3}, {"c", -2},  {"k", 3},  {"M", 6},  {"G", 9}};

/* Units whose prefix applies to a part of them, or that have their own name. */
static const struct {
  const char *unit, *base;
  int exponent;
} named[] = {{"mm2/s", "m2/s", -6}, {"cSt", "m2/s", -6}, {"uL", "m3", -9},
             {"mL", "m3", -6},      {"V/us", "V/s", 6},  {"V/ms", "V/s", 3}};

static const char *const others[] = {"m",   "g",       "s",    "V",  "Pa",  "N", "Hz",  "V/m", "kg/m3", "m/s2",   "N/m",
                                     "1/m", "N s2/m2", "m2/s", "m3", "V/s", "A", "ohm", "F",   "ohm m", "N m/rad"};

/* (unit with its prefix, unit without) => do they match? Then also the power of ten. */
static bool read_prefix(const char *unit, const char *base, int *exponent) {
  for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
    size_t length = strlen(prefixes[i].prefix);
    *exponent = prefixes[i].exponent;
    if (strncmp(unit, prefixes[i].prefix, length) == 0 && strcmp(unit + length, base) == 0) return true;
  }
  return false;
}

ZpStatus zp_unit_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  bool mass = strcmp(to, "kg") == 0;
  int exponent;
  for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
    if (strcmp(from, named[i].unit) == 0) {
      if (strcmp(to, named[i].base) != 0) return zp_unit_fail_dimension(to, err);
      *scale = (ZpUnitScale){.decimal = true, .exponent = named[i].exponent, .factor = 1};
      return ZP_OK;
    }
  if (read_prefix(from, mass ? "g" : to, &exponent)) {
    *scale = (ZpUnitScale){.decimal = true, .exponent = exponent - (mass ? 3 : 0), .factor = 1};
    return ZP_OK;
  }
  if (strcmp(to, "rad") == 0 && (strcmp(from, "degree") == 0 || strcmp(from, "deg") == 0)) {
    *scale = (ZpUnitScale){.factor = 0.017453292519943295};
    return ZP_OK;
  }
  for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
    if (read_prefix(from, others[i], &exponent)) return zp_unit_fail_dimension(to, err);
  return zp_fail(err, ZP_BAD_INPUT, "unknown unit \"%s\"", from);
}
