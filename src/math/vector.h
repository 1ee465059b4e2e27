/* Arithmetic of vectors. */
#ifndef ZP_MATH_VECTOR_H
#define ZP_MATH_VECTOR_H

#include <stddef.h>

/* => a . b, summed from the first member to the last. */
static inline double zp_dot(size_t n, const double *a, const double *b) {
  double sum = 0;
  for (size_t i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

#endif
