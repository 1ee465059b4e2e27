/* Symmetric positive definite systems whose rows begin somewhere and reach to the diagonal (skyline, envelope),
 * as grids give them: Cholesky in place, then solve. Only places between a row's first entry and its diagonal
 * fill in.
 *
 * Storage: ZP_LANES rows make a block. It begins with the column where its longest row begins, rounded down to
 * whole blocks, ends with its diagonal, and keeps its entries column by column, ZP_LANES in each. So vectors are
 * always whole and aligned, and every entry of the factor is a sum of its own, in the order of the columns: no
 * compiler and no vector width changes its bits. */
#ifndef ZP_MATH_SKYLINE_H
#define ZP_MATH_SKYLINE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/kernel.h"

/* ZP_LANES rows. */
typedef struct ZpSkylineBlock {
  size_t first; /* column with which they begin, a multiple of ZP_LANES */
  double *a;    /* entry (i, j) at [(j - first) * ZP_LANES + i % ZP_LANES] */
} ZpSkylineBlock;

typedef struct ZpSkyline {
  size_t n;              /* equations */
  size_t blocks;         /* of ZP_LANES rows */
  size_t tiles;          /* squares of ZP_LANES * ZP_LANES entries, of all blocks */
  ZpSkylineBlock *block; /* [blocks] */
  double *a;             /* [tiles * ZP_LANES * ZP_LANES] entries of all blocks */
} ZpSkyline;

/* n equations, all entries 0. first[i] <= i is the first column of row i that may be other than 0. False if
 * there is no memory; then nothing is left to destroy. */
bool zp_skyline_create(ZpSkyline *s, size_t n, const size_t *first);
void zp_skyline_destroy(ZpSkyline *s);

/* All entries 0. */
void zp_skyline_clear(ZpSkyline *s);

/* Entry (i, j) of the lower triangle, first[i] <= j <= i. */
static inline double *zp_skyline_at(const ZpSkyline *s, size_t i, size_t j) {
  const ZpSkylineBlock *block = &s->block[i / ZP_LANES];
  return block->a + (j - block->first) * ZP_LANES + i % ZP_LANES;
}

/* A = L L', in place; the diagonal then holds the reciprocals of L's. False if a pivot is not positive and
 * finite: then the entries are good for nothing. */
bool zp_skyline_factor(ZpSkyline *s);

/* Solve with the factor: b [n] => x, in place. */
void zp_skyline_solve(const ZpSkyline *s, double *b);

#endif
