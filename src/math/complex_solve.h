/* Dense linear systems with complex entries. */
#ifndef ZP_MATH_COMPLEX_SOLVE_H
#define ZP_MATH_COMPLEX_SOLVE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ZpComplex {
  double re, im;
} ZpComplex;

/* Solve a x = b by elimination with pivots from the columns: a [n * n], row by row, which is destroyed; b [n] => x.
 * False if a is singular. */
bool zp_complex_solve(size_t n, ZpComplex *a, ZpComplex *b);

#endif
