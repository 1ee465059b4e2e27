/* Eigenvalues of small dense symmetric matrices. */
#ifndef ZP_MATH_EIGEN_H
#define ZP_MATH_EIGEN_H

#include <stddef.h>

/* Jacobi's method: symmetric a [n * n] => eigenvalues on its diagonal, in rising order, and the eigenvectors
 * as the columns of v [n * n]. */
void zp_eigen_symmetric(size_t n, double *a, double *v);

#endif
