/* What values are called that have a unit of another kind than asked for. Apart from units.c, since it needs no
 * UDUNITS. */
#include <stddef.h>
#include <string.h>

#include "base/fail.h"
#include "io/units.h"

/* What a value in a unit is called, to say what another value is not. */
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
