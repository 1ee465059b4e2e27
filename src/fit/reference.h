/* A reference curve y(x) from a CSV file. */
#ifndef ZP_FIT_REFERENCE_H
#define ZP_FIT_REFERENCE_H

#include <stddef.h>

#include "base/table.h"

#include "base/fail.h"

typedef struct ZpReference {
  size_t count;
  double *x, *y; /* [count] m, x rising */
} ZpReference;

/* Read the columns x and y (x_m, y_mm, ...). ZP_BAD_INPUT if one is missing or x does not increase. To be freed
 * whatever the status is. */
ZpStatus zp_reference_read(const char *path, ZpReference *reference, ZpError *err);
void zp_reference_free(ZpReference *reference);

/* Area between the reference and the columns x_m, y_m of `table` over their common range of x: the integral of the
 * distance in y, with straight lines between the points of both curves, m2. NAN if they have no common x or the x of
 * the table decreases. */
double zp_reference_area(const ZpReference *reference, const ZpTable *table);

#endif
