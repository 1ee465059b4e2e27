/* Units of the page, in place of src/io/units.c, which asks UDUNITS: those of keys.def with SI prefixes. */
#include "io/units.h"

#include <stddef.h>
#include <string.h>

#include "base/fail.h"

static const struct {
  const char *prefix;
  int exponent;
} prefixes[] = {{"n", -9}, {"u", -6}, {"µ", -6}, {"m", -3}, {"c", -2}, {"", 0}, {"k", 3}, {"M", 6}, {"G", 9}};

ZpStatus zp_unit_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  const char *base = strcmp(to, "kg") == 0 ? "g" : to;
  int shift = base == to ? 0 : -3;
  *scale = (ZpUnitScale){.decimal = true, .factor = 1};
  if (strcmp(from, to) == 0) return ZP_OK;
  for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
    size_t length = strlen(prefixes[i].prefix);
    if (strncmp(from, prefixes[i].prefix, length) != 0 || strcmp(from + length, base) != 0) continue;
    scale->exponent = prefixes[i].exponent + shift;
    return ZP_OK;
  }
  return zp_fail(err, ZP_BAD_INPUT, "unknown unit %s", from);
}
