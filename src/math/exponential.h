/* A linear system x' = A x + b u over a time in which u is held. */
#ifndef ZP_MATH_EXPONENTIAL_H
#define ZP_MATH_EXPONENTIAL_H

#include <stddef.h>

/* A [n * n], row by row => exp(A) [n * n]; work [2 n n]. By its series for a small part of A, squared again and again.
 */
void zp_exponential(size_t n, const double *A, double *exponential, double *work);

#endif
