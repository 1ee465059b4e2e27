/* Linear systems of many blocks that meet in a few unknowns, the border:
 *   [A_1         B_1] [x_1]   [f_1]
 *   [     A_2    B_2] [x_2] = [f_2]
 *   [C_1  C_2    D  ] [z  ]   [g  ]
 * Each A is a band, and each block meets a few unknowns of the border only, so that the cost is linear in the number of
 * blocks. Blocks are eliminated one by one, then the border, which is sparse. Where an A alone is singular, or nearly
 * so, iterative refinement regains what that loses (Govaerts and Pryce, BIT 30, 1990); elsewhere it would lose digits:
 * its residuals have the rounding of stiff edges, which factors do not have. Without a border the blocks are bands
 * alone, at their cost. */
#ifndef ZP_MATH_ARROW_H
#define ZP_MATH_ARROW_H

#include "math/band.h"
#include "math/sparse.h"

/* Form of a block. `band.border` of its columns are in the border. */
typedef struct ZpArrowBlock {
  size_t n; /* unknowns of its own */
  ZpBandForm band;
  size_t *to; /* [band.border] which unknowns of the border these are, counted from its first one */
} ZpArrowBlock;

/* Unknowns are numbered block by block, then come those of the border. */
typedef struct ZpArrowForm {
  size_t n, inner; /* unknowns in all, and of blocks */
  size_t blocks;
  ZpArrowBlock *block; /* [blocks] */
  ZpSparsity sparsity; /* of the border */
} ZpArrowForm;

/* Of blocks, which are copied, and a border with so many unknowns, of which `count` groups also meet without a block.
 * False if there is no memory. */
bool zp_arrow_form_create(const ZpArrowBlock *block, size_t blocks, size_t border, const ZpClique *more, size_t count,
                          ZpArrowForm *form);
void zp_arrow_form_destroy(ZpArrowForm *form);

typedef struct ZpArrowPart {
  size_t first, n; /* its first unknown, and how many */
  size_t border;
  const size_t *to;
  ZpBand A;     /* with the columns B in the border: A.beside [border][n]; A.corner is its part of D */
  ZpBand LU;    /* factors of A: in its place if the matrix has no border; else refinement still needs A */
  bool idle;    /* it takes no part, as in a matrix without it; set by the caller before entries are cleared */
  bool shifted; /* A is singular: these are of its neighbour */
  double *C;    /* [border][n] rows */
  double *V;    /* [border][n] A^-1 B */
} ZpArrowPart;

typedef struct ZpArrow {
  const ZpArrowForm *form;
  ZpArrowPart *part; /* [form->blocks] */
  ZpSparse D, S;     /* S = D - the sum of C V, factored */
  double **diagonal; /* [n] where the entries of the diagonal are, of A and D */
  double *b, *left;  /* [n] what is to be solved, and what is left of it */
} ZpArrow;

/* Cut the arrays from `arena`. `form` must outlive the matrix. */
void zp_arrow_reserve(ZpArrow *arrow, const ZpArrowForm *form, ZpArena *arena);

/* All entries 0. Of idle parts, which the caller has named before, only the diagonal is cleared. */
void zp_arrow_clear(ZpArrow *arrow);

/* Entries are written in this order: A, B and A.corner of blocks, of a symmetric A only its upper triangles;
 * zp_arrow_mirror, which makes rows of columns; then what is not symmetric in B, C and A.corner, and D;
 * zp_arrow_close, which adds corners to D, and terms of low rank to B, C and D. */
void zp_arrow_mirror(ZpArrow *arrow);
void zp_arrow_close(ZpArrow *arrow);

/* Is it symmetric? */
bool zp_arrow_is_symmetric(const ZpArrow *arrow);

/* The matrix, closed and not factored, times x [n] => y [n]. */
void zp_arrow_multiply(const ZpArrow *arrow, const double *x, double *y);

/* Prescribe an unknown of a matrix that is closed and not factored, as zp_band_prescribe. */
void zp_arrow_prescribe(ZpArrow *arrow, size_t unknown, double diagonal, double move, double *r, double *row);

/* Factor; without a border in place. False if the matrix is singular, or not finite. */
bool zp_arrow_factor(ZpArrow *arrow);

/* Solve with the factors: b [n] => x, in place. */
void zp_arrow_solve(const ZpArrow *arrow, double *b);

/* As zp_band_negative: the negative eigenvalues of all blocks, and those of S (Haynsworth). */
size_t zp_arrow_negative(const ZpArrow *arrow);

#endif
