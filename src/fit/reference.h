/* A reference curve y(x) from a CSV file. */
#ifndef ZP_FIT_REFERENCE_H
#define ZP_FIT_REFERENCE_H

#include <stddef.h>

#include <zipact/table.h>

#include "base/fail.h"

typedef struct ZpReference {
  size_t count;
  double *x, *y; /* [count] m, x rising */
} ZpReference;

/* Read the columns x and y (x_m, y_mm, ...). ZP_BAD_INPUT if they are not there or x does not rise. To be freed
 * whatever the status. */
ZpStatus zp_reference_read(const char *path, ZpReference *reference, ZpError *err);
void zp_reference_free(ZpReference *reference);

/* Area between the reference and the columns x_m, y_m of `table` over the x that both have: integral of the
 * distance in y, both curves straight between their points, m2. NAN if they share no x or the table's turns back. */
double zp_reference_area(const ZpReference *reference, const ZpTable *table);

#endif
