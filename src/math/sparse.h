/* Sparse linear systems without pivoting. Where the rows of the matrix are may be given by the groups of unknowns that
 * meet; its pattern is symmetric, its values need not be. Unknowns are eliminated by least degree, so that a tree of
 * groups stays as sparse as it is. */
#ifndef ZP_MATH_SPARSE_H
#define ZP_MATH_SPARSE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

/* Some unknowns, all of which meet each other. */
typedef struct ZpClique {
  size_t count;
  const size_t *member; /* [count] */
} ZpClique;

/* The entries of a matrix and of its factors. */
typedef struct ZpSparsity {
  size_t n, entries;
  size_t *place;   /* [n] when an unknown is eliminated: 0 first */
  size_t *unknown; /* [n] which is eliminated at a place */
  size_t *start;   /* [n + 1] of each place: its first entry in `column` */
  size_t *column;  /* [entries] the later places that it meets, growing */
} ZpSparsity;

/* Of n unknowns. False if there is no memory. */
bool zp_sparsity_create(size_t n, const ZpClique *clique, size_t cliques, ZpSparsity *sparsity);
void zp_sparsity_destroy(ZpSparsity *sparsity);

typedef struct ZpSparse {
  const ZpSparsity *of;
  double *diagonal;      /* [n] by place */
  double *upper, *lower; /* [entries] above the diagonal; below it, transposed */
  double *x;             /* [n] work space */
} ZpSparse;

/* Cut the arrays from `arena`. `sparsity` must outlive the matrix. */
void zp_sparse_reserve(ZpSparse *matrix, const ZpSparsity *sparsity, ZpArena *arena);

/* All entries 0; those of another matrix of the same sparsity. */
void zp_sparse_clear(ZpSparse *matrix);
void zp_sparse_copy(ZpSparse *matrix, const ZpSparse *from);

/* Entry (i, j) of two unknowns that meet. */
double *zp_sparse_at(const ZpSparse *matrix, size_t i, size_t j);

/* The matrix, not factored, times x [n]: added to y [n]. */
void zp_sparse_add_product(const ZpSparse *matrix, const double *x, double *y);

/* Prescribe an unknown of a matrix that is not factored, as zp_band_prescribe: its row is added to `row` [n]. */
void zp_sparse_prescribe(ZpSparse *matrix, size_t unknown, double diagonal, double move, double *r, double *row);

/* Factor in place. False if a pivot is 0 or not finite. */
bool zp_sparse_factor(ZpSparse *matrix);

/* Solve with the factors: b [n] => x, in place. */
void zp_sparse_solve(const ZpSparse *matrix, double *b);

/* Of a factored matrix: negative pivots. So many eigenvalues of a symmetric one are negative. */
size_t zp_sparse_negative(const ZpSparse *matrix);

#endif
