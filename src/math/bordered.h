/* Banded linear systems with a border: a few unknowns that couple with all others,
 *   [A B] [x]   [f]
 *   [C D] [z] = [g]
 * by block elimination with two steps of iterative refinement, which makes it accurate even where A alone is singular
 * or, with a border of one, nearly so (Govaerts and Pryce, BIT 30, 1990). Without a border it is the band alone, at its
 * cost. */
#ifndef ZP_MATH_BORDERED_H
#define ZP_MATH_BORDERED_H

#include "math/band.h"

typedef struct ZpBordered {
  size_t n, border; /* equations in all; the last of them, which are the border's */
  ZpBand A;         /* n - border equations */
  double *B, *C;    /* [border][n - border] columns and rows of the border */
  double *D;        /* [border][border] */
  ZpBand LU;        /* of A, which refinement still needs; with a border only, as all below */
  ZpBand S;         /* D - C V, a full matrix, factored */
  double *V;        /* [border][n - border] A^-1 B */
  double *b, *left; /* [n] what is to be solved, and what is left of it */
} ZpBordered;

/* Cut the arrays from `arena`: n equations, the last `border` < n of them the border's; lower, upper: diagonals of A.
 * lower == 0: A is symmetric, with groups, and keeps its upper triangle; B, C and D are whole all the same. */
void zp_bordered_reserve(ZpBordered *matrix, size_t n, size_t border, size_t lower, size_t upper, ZpBandGroups groups,
                         ZpArena *arena);

/* All entries 0. */
void zp_bordered_clear(ZpBordered *matrix);

/* Of a symmetric matrix: rows of the border = its columns, which were written above the diagonal. */
void zp_bordered_mirror(ZpBordered *matrix);

/* Entry (i, j), inside the band or in the border. */
static inline double *zp_bordered_at(const ZpBordered *m, size_t i, size_t j) {
  size_t inner = m->n - m->border;
  if (i < inner && j < inner) return zp_band_at(&m->A, i, j);
  if (i < inner) return m->B + (j - inner) * inner + i;
  if (j < inner) return m->C + (i - inner) * inner + j;
  return m->D + (i - inner) * m->border + (j - inner);
}

/* The matrix, not factored, times x [n] => y [n]. */
void zp_bordered_multiply(const ZpBordered *matrix, const double *x, double *y);

/* Factor; without a border in place. False if it is singular, or not finite. */
bool zp_bordered_factor(ZpBordered *matrix);

/* Solve with the factors: b [n] => x, in place. */
void zp_bordered_solve(ZpBordered *matrix, double *b);

#endif
