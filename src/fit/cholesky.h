/* Symmetric positive definite matrices of the parameters of a fit: A = L L^T. Of n rows and columns. */
#ifndef ZP_FIT_CHOLESKY_H
#define ZP_FIT_CHOLESKY_H

#include "fit/fit.h"

/* L => the lower triangle of A, whose lower triangle is read. False if a pivot is at most `least` times its diagonal:
 * A is not positive definite. */
bool zp_cholesky_factor(int n, double least, double A[ZP_FIT_MOST][ZP_FIT_MOST]);

/* Solve A x = b => x, which holds b. */
void zp_cholesky_solve(int n, double L[ZP_FIT_MOST][ZP_FIT_MOST], double *x);

/* The inverse of A => C. */
void zp_cholesky_invert(int n, double L[ZP_FIT_MOST][ZP_FIT_MOST], double C[ZP_FIT_MOST][ZP_FIT_MOST]);

#endif
