/* SI units as powers of base units. */
#ifndef ZP_FMUPACK_BASE_UNITS_H
#define ZP_FMUPACK_BASE_UNITS_H

#include <stdbool.h>

typedef struct ZpBaseUnits {
  int kg, m, s, A; /* exponents */
} ZpBaseUnits;

/* (an SI unit in the tables of keys and signals, "N s2/m2", "1/m", "1") => its powers. False if it is not such a unit.
 */
bool zp_base_units(const char *unit, ZpBaseUnits *powers);

#endif
