/* A system may consist of several like parts, as two halves that mirror each other, which have some unknowns in common.
 * Its lengths and means count a common unknown once for each part: then they are those of one part alone, and a solver
 * takes the same steps for both. */
#ifndef ZP_MATH_PARTS_H
#define ZP_MATH_PARTS_H

#include <stddef.h>

typedef struct ZpParts {
  size_t more;    /* parts beyond the first: 0 where the system is one */
  size_t count;   /* of unknowns that all parts have in common */
  size_t *common; /* [count] these; they belong to who fills them in */
} ZpParts;

/* How many unknowns the parts have, each for itself, of a system of n. */
static inline double zp_parts_unknowns(const ZpParts *parts, size_t n) {
  return (double)(n + parts->more * parts->count);
}

/* Addition of the other parts to a sum of a[i] b[i] over all unknowns. */
static inline double zp_parts_dot(const ZpParts *parts, const double *a, const double *b) {
  double sum = 0;
  for (size_t k = 0; k < parts->count; k++)
    sum += (double)parts->more * a[parts->common[k]] * b[parts->common[k]];
  return sum;
}

#endif
