/* Names of quantities with a unit of another kind than required. Separate from units.c, because it does not need
 * UDUNITS. */
#include <stddef.h>
#include <string.h>

#include "base/fail.h"
#include "io/units.h"

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
