/* Eigenvalues of dense matrices without symmetry. */
#ifndef ZP_MATH_EIGEN_GENERAL_H
#define ZP_MATH_EIGEN_GENERAL_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ZpEigenvalue {
  double re, im;
} ZpEigenvalue;

/* a [n * n], row by row, which is destroyed => value [n], conjugates beside each other; work [n]. False if an
 * entry is not finite or the iteration does not converge: then `value` is good for nothing. */
bool zp_eigenvalues(size_t n, double *a, double *work, ZpEigenvalue *value);

#endif
