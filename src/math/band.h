/* Banded linear systems, square: factor in place, solve. On top of the band there may be a matrix of low rank, the sum
 * of u v': what couples many equations through one scalar each.
 *
 * Storage: row i holds the columns i - lower .. i + upper + lower (room for what pivoting fills in), entry
 * (i, j) at [i * stride + (j - i + lower)], stride = 2 lower + upper + 1. A matrix with lower == 0 is symmetric and
 * keeps its upper triangle only. */
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
  size_t *pivot;       /* [n] row that was exchanged with row i; not of a symmetric matrix */
  bool odd;            /* an odd number of rows was exchanged */
  size_t rank;         /* of what is on top: */
  double *u, *v;       /* [rank * n] its terms u v' */
  double *w;           /* [rank * n] factored: u solved with the band and the terms before it */
  double *s;           /* [rank] factored: 1 + v' w, by which a term changes the determinant */
} ZpBand;

/* What a matrix looks like, whatever its size. */
typedef struct ZpBandForm {
  size_t bandwidth; /* diagonals above the main one, and below */
  bool symmetric;   /* the band is: only its upper triangle is kept */
  size_t rank;      /* of what is on top of it */
} ZpBandForm;

/* Symmetric matrices with more diagonals are factored by simpler, slower code. */
enum { ZP_BAND_MOST = 23 };

/* Cut the arrays from `carver`: of a band alone, of one of a form. */
void zp_band_carve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpCarver *carver);
void zp_band_carve_form(ZpBand *band, size_t n, ZpBandForm form, ZpCarver *carver);

/* All entries 0. */
void zp_band_clear(ZpBand *band);

/* Entry (i, j) inside the band. */
static inline double *zp_band_at(const ZpBand *band, size_t i, size_t j) {
  return band->a + i * band->stride + (j + band->lower - i);
}

/* Factor in place: LU with row pivoting; of a symmetric matrix U' D U without pivoting, three times cheaper, for
 * matrices that are definite or have few negative eigenvalues. False if a pivot is 0 or not finite. */
bool zp_band_factor(ZpBand *band);

/* The matrix, not factored, times x [n] => y [n]. */
void zp_band_multiply(const ZpBand *band, const double *x, double *y);

/* Solve with the factors: b => x, in place. */
void zp_band_solve(const ZpBand *band, double *b);

/* Of a factored symmetric matrix: how many of its eigenvalues are negative (Sylvester's law of inertia). Of another: 1
 * if its determinant is negative, else 0. Each term on top that changes the sign of the determinant takes one of them
 * away, or adds one where there is none. */
size_t zp_band_negative(const ZpBand *band);

#endif
