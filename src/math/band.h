/* Banded linear systems, square, general or symmetric: factor in place, solve.
 *
 * Storage: row i holds the columns i - lower .. i + upper + lower (room for what pivoting fills in), entry
 * (i, j) at [i * stride + (j - i + lower)], stride = 2 lower + upper + 1. */
#ifndef ZP_MATH_BAND_H
#define ZP_MATH_BAND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

typedef struct ZpBand {
  size_t n;            /* equations */
  size_t lower, upper; /* diagonals below and above the main one */
  size_t stride;       /* of a row */
  double *a;           /* [n * stride] */
  size_t *pivot;       /* [n] row that was exchanged with row i */
} ZpBand;

/* Cut the arrays from `carver`. */
void zp_band_carve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpCarver *carver);

/* All entries 0. */
void zp_band_clear(ZpBand *band);

/* Entry (i, j) inside the band. */
static inline double *zp_band_at(const ZpBand *band, size_t i, size_t j) {
  return band->a + i * band->stride + (j + band->lower - i);
}

/* LU with row pivoting, in place. False if a pivot is 0 or not finite. `negative` (may be NULL) gets the
 * sign of the determinant: true if it is negative. */
bool zp_band_factor(ZpBand *band, bool *negative);

/* Solve with the factors: b => x, in place. */
void zp_band_solve(const ZpBand *band, double *b);

enum { ZP_BAND_MOST = 15 };

/* A symmetric matrix of which only the upper triangle is kept (lower == 0, upper <= ZP_BAND_MOST): U' D U in place,
 * without pivoting, so for matrices that are definite or nearly so. False if a pivot is 0 or not finite. */
bool zp_band_factor_symmetric(ZpBand *band);

/* Solve with those factors: b => x, in place. */
void zp_band_solve_symmetric(const ZpBand *band, double *b);

/* L D L' of a symmetric matrix (lower == upper) without pivoting, on a copy `work` [n (lower + 1)]. => how
 * many pivots are negative, which is how many eigenvalues are; -1 if a pivot is 0 or not finite. */
int zp_band_negative_pivots(const ZpBand *band, double *work);

#endif
