/* Units of measurement, by UDUNITS-2. */
#ifndef ZP_IO_UNITS_H
#define ZP_IO_UNITS_H

#include <stdbool.h>

#include <zipact/error.h>

/* Conversion of a number to another unit: times 10^exponent if `decimal`, otherwise times `factor`. Powers of ten are
 * separate because they can be applied to the text of a number without rounding: "50 um" is then the same double as
 * 50e-6, while 50 * 1e-6 is not. */
typedef struct ZpUnitScale {
  bool decimal;
  int exponent;
  double factor;
} ZpUnitScale;

/* A number in that unit, over `per`, in SI. */
double zp_unit_apply(const ZpUnitScale *scale, double number, double per);

/* "20 um": a number and a unit like `unit`, or without one in SI; per cent for the units "1" and "count" => SI, rounded
 * to 12 digits; NAN if it does not begin with a number. ZP_BAD_INPUT as zp_unit_scale. */
ZpStatus zp_quantity_read(const char *text, const char *unit, double *value, ZpError *err);

/* (unit as people write it, SI unit) => scale. ZP_BAD_INPUT with a message that is a part of a sentence, "unknown unit
 * "xyz"" or "not a length"; ZP_MACHINE if the UDUNITS database cannot be read. Several threads may call it. */
ZpStatus zp_unit_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err);

/* ZP_BAD_INPUT, "not a length": the quantity of the unit differs from that of the SI unit `to`. */
ZpStatus zp_unit_fail_dimension(const char *to, ZpError *err);

#endif
