/* The part of units that does not need UDUNITS. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/fail.h"
#include "io/number.h"
#include "io/units.h"
#include "io/value.h"

/* The name of a quantity in a unit, to say that a value is not such a quantity. */
static const struct {
  const char *unit, *noun;
} nouns[] = {
    {"m", "a length"},
    {"Pa", "a pressure"},
    {"kg/m3", "a density"},
    {"V/m", "an electric field"},
    {"kg", "a mass"},
    {"m/s2", "an acceleration"},
    {"N/m", "a force per length"},
    {"V", "a voltage"},
    {"s", "a time"},
    {"Hz", "a frequency"},
    {"N", "a force"},
    {"N s2/m2", "a drag coefficient"},
    {"V/s", "a slew rate"},
    {"A", "a current"},
    {"F", "a capacitance"},
    {"ohm", "a resistance"},
    {"rad", "an angle"},
    {"N m/rad", "a torsional stiffness"},
};

ZpStatus zp_unit_fail_dimension(const char *to, ZpError *err) {
  for (size_t i = 0; i < sizeof nouns / sizeof nouns[0]; i++)
    if (strcmp(nouns[i].unit, to) == 0) return zp_fail(err, ZP_BAD_INPUT, "not %s", nouns[i].noun);
  return zp_fail(err, ZP_BAD_INPUT, "not in a unit like %s", to);
}

double zp_unit_apply(const ZpUnitScale *scale, double number, double per) {
  if (scale->decimal && scale->exponent < 0) return number / (pow(10, -scale->exponent) * per);
  return number * (scale->decimal ? pow(10, scale->exponent) : scale->factor) / per;
}

ZpStatus zp_quantity_read(const char *text, const char *unit, double *value, ZpError *err) {
  char number[64] = "";
  ZpUnitScale scale = {.decimal = true};
  const size_t length = strspn(text, "+-.0123456789eE");
  const char *given = text + length + strspn(text + length, " \t");
  const bool pure = strcmp(unit, "1") == 0 || strcmp(unit, "count") == 0;
  if (length < sizeof number) memcpy(number, text, length);
  if (!zp_number_read(number, value)) {
    *value = NAN;
    return ZP_OK;
  }
  if (pure && strcmp(given, "%") == 0)
    scale.exponent = -2;
  else if (pure && *given)
    return zp_fail(err, ZP_BAD_INPUT, "this output has no unit");
  ZpStatus status = *given && !pure ? zp_unit_scale(given, unit, &scale, err) : ZP_OK;
  *value = zp_rounded(zp_unit_apply(&scale, *value, 1));
  return status;
}
