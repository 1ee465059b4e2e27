/* Banded linear systems, square: factor in place, solve. On top of the band there may be a matrix of low rank, the sum
 * of u v': what couples many equations through one scalar each.
 *
 * Storage with both triangles: row i holds the columns i - lower .. i + upper + lower (room for what pivoting fills
 * in), entry (i, j) at [i * stride + (j - i + lower)], stride = 2 lower + upper + 1.
 * A matrix with lower == 0 is symmetric and keeps its upper triangle only, in blocks of four rows. The rows of a block
 * begin at the same column, that of the block's diagonal, so that rows meet in whole vectors. */
#ifndef ZP_MATH_BAND_H
#define ZP_MATH_BAND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

/* Structure of a symmetric matrix beside its bandwidth: its equations come in groups of four, of which the first one
 * has `lead` fewer, and a group meets the `reach` - 1 groups that follow it at most. reach = 0: that is not known. */
typedef struct ZpBandGroups {
  size_t lead, reach;
} ZpBandGroups;

typedef struct ZpBand {
  size_t n;            /* equations */
  size_t lower, upper; /* diagonals below and above the main one */
  size_t lead;         /* of a symmetric matrix: rows before the first equation, of zeros */
  size_t stride;       /* of a row */
  size_t entries;      /* of all rows, those that only fill blocks included */
  double *a;           /* [entries] */
  size_t *pivot;       /* [n] row that was exchanged with row i; not of a symmetric matrix */
  bool odd;            /* an odd number of rows was exchanged */
  size_t rank;         /* of what is on top: */
  double *u, *v;       /* [rank * (n + border)] its terms u v' */
  double *w;           /* [rank * n] factored: u solved with the band and the terms before it; then n for work */
  double *s;           /* [rank] factored: 1 + v' w, by which a term changes the determinant */
  size_t border;       /* of a block of a larger matrix (arrow.h): equations n .. n + border - 1 beside it, */
  double *beside;      /* [border * n] their columns, */
  double *corner;      /* [border * border] and rows among themselves */
} ZpBand;

/* Form of a matrix, whatever its size. */
typedef struct ZpBandForm {
  size_t bandwidth; /* diagonals above the main one, and below */
  bool symmetric;   /* the band is: only its upper triangle is kept */
  size_t rank;      /* of what is on top of it */
  ZpBandGroups groups;
  size_t border; /* equations beside it */
} ZpBandForm;

/* Rows of a block of a symmetric matrix; diagonals above the main one that such a matrix may have. */
enum { ZP_BAND_BLOCK = 4, ZP_BAND_MOST = 127 };

/* Cut the arrays from `arena`: of a band alone, of one of a form. */
void zp_band_reserve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpArena *arena);
void zp_band_reserve_form(ZpBand *band, size_t n, ZpBandForm form, ZpArena *arena);

/* All entries 0. */
void zp_band_clear(ZpBand *band);

/* Row i of a symmetric matrix: entry (i, j) at [j - i]. */
static inline double *zp_band_row(const ZpBand *band, size_t i) {
  size_t place = i + band->lead;
  return band->a + place * band->stride + place % ZP_BAND_BLOCK;
}

/* Entry (i, j) inside the band. */
static inline double *zp_band_at(const ZpBand *band, size_t i, size_t j) {
  return band->lower == 0 ? zp_band_row(band, i) + (j - i) : band->a + i * band->stride + (j + band->lower - i);
}

/* Of the vectors u or v of its terms, that of term k. */
static inline double *zp_band_term(const ZpBand *band, double *vectors, size_t k) {
  return vectors + k * (band->n + band->border);
}

/* Entry (i, j) inside the band, or in a column of the border, j >= n. */
static inline double *zp_band_entry(const ZpBand *band, size_t i, size_t j) {
  if (j < band->n) return zp_band_at(band, i, j);
  return i < band->n ? band->beside + (j - band->n) * band->n + i
                     : band->corner + (i - band->n) * band->border + (j - band->n);
}

/* The column after the last one that row i may have. */
static inline size_t zp_band_end(const ZpBand *band, size_t i) {
  size_t end = i + band->upper + 1, place = i + band->lead;
  size_t stored = place - place % ZP_BAND_BLOCK + band->stride - band->lead;
  if (band->lower == 0 && stored < end) end = stored;
  return end < band->n ? end : band->n;
}

/* Factor in place: LU with row pivoting; of a symmetric matrix by blocks without pivoting, several times cheaper, for
 * matrices that are definite or have few negative eigenvalues. False if a pivot is 0 or not finite. */
bool zp_band_factor(ZpBand *band);

/* The matrix, not factored, times x [n] => y [n]. */
void zp_band_multiply(const ZpBand *band, const double *x, double *y);

/* Prescribe an unknown of a matrix that is not factored: its row becomes `diagonal` at the unknown and 0 elsewhere. If
 * the unknown changes by `move`, its column times that is subtracted from r [n] and becomes 0; r NULL: it becomes 0.
 * => the row as it was, [n]. */
void zp_band_prescribe(ZpBand *band, size_t unknown, double diagonal, double move, double *r, double *row);

/* Solve with the factors: b => x, in place. */
void zp_band_solve(const ZpBand *band, double *b);

/* Of a factored symmetric band: how many eigenvalues are negative (Sylvester's law of inertia), with the terms on top
 * if they are symmetric, v = d u (Haynsworth's inertia of the matrix bordered by u and -1/d), or while none of the real
 * eigenvalues of the sum turns complex. Of another band: 1 if the determinant is negative, else 0. */
size_t zp_band_negative(const ZpBand *band);

#endif
