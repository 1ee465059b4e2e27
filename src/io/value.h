/* Values as people write them: internal functions beside zp_value_parse and zp_value_print of io.h. */
#ifndef ZP_IO_VALUE_H
#define ZP_IO_VALUE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/def.h>

#include "io/units.h"

enum {
  ZP_VALUE_SIZE = 256, /* size of the longest value that can be read, with the final 0 */
  ZP_RANGE_SIZE = 160  /* size for zp_value_range */
};

/* As zp_value_parse, but the message is the reason only, "not a length; give a value in um from ...", for callers that
 * add the place of the value. */
ZpStatus zp_value_read(int index, const char *text, double *value, ZpError *err);

/* Read a part of a value or a setting, such as the end of a range, in the unit of key `index`: a finite number.
 * Messages call the part `name`: `to = "10": not a length; ...`. */
ZpStatus zp_value_read_part(int index, const char *name, const char *text, double *value, ZpError *err);

/* A number with a unit of key `index`, which may be out of its range, infinite, or NAN if there is no memory: for
 * quantities that are not values of the key itself, such as a standard deviation. ZP_BAD_INPUT: as zp_value_read. */
ZpStatus zp_value_quantity(int index, const char *text, double *value, ZpError *err);

/* Are the values of a key numbers: no words, no text? */
bool zp_value_is_number(const ZpKey *key);

/* Are they real numbers, which can be fitted and drawn? */
bool zp_value_is_real(const ZpKey *key);

/* Whether a text key is the path of a file, or of several that are separated by semicolons. */
typedef enum ZpPaths { ZP_PATHS_NONE, ZP_PATHS_ONE, ZP_PATHS_SEVERAL } ZpPaths;
ZpPaths zp_key_paths(int index);

/* Is `text` a number without a unit, other than 0, for a key that has a unit? */
bool zp_value_is_bare(int index, const char *text);

/* (key) => "1 um to 5000 um", with " or auto" if that is allowed; the range of a number key. */
void zp_value_range(int index, char *text, size_t size);

/* The customary unit of a key. `known`: it has one. */
typedef struct ZpShownUnit {
  bool known;
  ZpUnitScale scale;
} ZpShownUnit;

/* Look up the unit, which takes longer than printing a number. */
ZpShownUnit zp_value_unit(int index);

/* As zp_value_print, with the given unit of the key. */
void zp_value_print_in(int index, const ZpShownUnit *shown, double value, char *text, size_t size);

/* Round to 12 digits: more than any key needs, and fewer than rounding errors affect. */
double zp_rounded(double value);

#endif
