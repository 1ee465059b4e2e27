/* Left-looking Cholesky, a block of rows at a time. Letters:
 *   L   the factor, A = L L'       l  a column of it in one block of rows
 *   I   number of such a block     y  solution of L y = b
 * Diagonal places hold 1 / l_jj once they are factored, because a product costs less than a division. */
#include "math/skyline.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/memory.h"

enum {
  LANES = ZP_LANES,
  TILE = LANES * LANES,
  COLUMNS = 4,    /* found at once: their sums, LANES each, are what the registers of AVX2 hold */
  SECOND = LANES, /* where the columns after the first begin */
  THIRD = 2 * LANES,
  FOURTH = 3 * LANES
};

static inline size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

/* Column with which block I begins. */
static size_t block_first(size_t n, const size_t *first, size_t I) {
  size_t begin = I * LANES;
  for (size_t i = I * LANES; i < least(n, (I + 1) * LANES); i++)
    begin = least(begin, first[i]);
  return begin / LANES * LANES;
}

bool zp_skyline_create(ZpSkyline *s, size_t n, const size_t *first) {
  uint64_t tiles = 0; /* more than a size_t of 32 bits may hold */
  *s = (ZpSkyline){.n = n, .blocks = zp_round_up(n) / LANES};
  s->block = zp_calloc(s->blocks, sizeof *s->block);
  if (!s->block) return false;
  for (size_t I = 0; I < s->blocks; I++) {
    s->block[I].first = block_first(n, first, I);
    tiles += I + 1 - s->block[I].first / LANES;
  }
  s->tiles = (size_t)tiles;
  if (s->tiles == tiles) s->a = zp_calloc(s->tiles, TILE * sizeof *s->a);
  if (!s->a) {
    zp_skyline_destroy(s);
    return false;
  }
  double *next = s->a;
  for (size_t I = 0; I < s->blocks; I++) {
    s->block[I].a = next;
    next += (I + 1) * TILE - s->block[I].first * LANES;
  }
  return true;
}

void zp_skyline_destroy(ZpSkyline *s) {
  zp_free(s->a);
  zp_free(s->block);
  *s = (ZpSkyline){0};
}

void zp_skyline_clear(ZpSkyline *s) {
  memset(s->a, 0, s->tiles * TILE * sizeof *s->a);
}

/* Column j of a block. */
static inline double *column(const ZpSkylineBlock *block, size_t j) {
  return block->a + (j - block->first) * LANES;
}

/* COLUMNS columns c of a block, less `count` columns p of it times the same columns of the rows q, which are the
 * rows that cross c on the diagonal. Here the time goes. */
ZP_CHECKED_WHOLE static inline void subtract(size_t count, const double *restrict p, const double *restrict q,
                                             double *restrict c) {
  zp_check_numbers(p, count * LANES);
  zp_check_numbers(q, count ? (count - 1) * LANES + COLUMNS : 0);
  zp_check_numbers(c, TILE / 2);
  double s0[LANES], s1[LANES], s2[LANES], s3[LANES];
  ZP_SIMD
  for (size_t r = 0; r < LANES; r++) {
    s0[r] = c[r];
    s1[r] = c[SECOND + r];
    s2[r] = c[THIRD + r];
    s3[r] = c[FOURTH + r];
  }
  for (size_t k = 0; k < count; k++, p += LANES, q += LANES) {
    double q0 = q[0], q1 = q[1], q2 = q[2], q3 = q[3];
    ZP_SIMD
    for (size_t r = 0; r < LANES; r++) {
      double x = p[r];
      s0[r] -= x * q0;
      s1[r] -= x * q1;
      s2[r] -= x * q2;
      s3[r] -= x * q3;
    }
  }
  ZP_SIMD
  for (size_t r = 0; r < LANES; r++) {
    c[r] = s0[r];
    c[SECOND + r] = s1[r];
    c[THIRD + r] = s2[r];
    c[FOURTH + r] = s3[r];
  }
}

/* Solve the rest of c with the triangle t of the rows q. */
static inline void divide(const double *restrict t, double *restrict c) {
  const double *t0 = t, *t1 = t + SECOND, *t2 = t + THIRD, *t3 = t + FOURTH;
  ZP_SIMD
  for (size_t r = 0; r < LANES; r++) {
    double x0 = c[r] * t0[0];
    double x1 = (c[SECOND + r] - x0 * t0[1]) * t1[1];
    double x2 = (c[THIRD + r] - x0 * t0[2] - x1 * t1[2]) * t2[2];
    double x3 = (c[FOURTH + r] - x0 * t0[3] - x1 * t1[3] - x2 * t2[3]) * t3[3];
    c[r] = x0;
    c[SECOND + r] = x1;
    c[THIRD + r] = x2;
    c[FOURTH + r] = x3;
  }
}

/* Factor c where it meets the diagonal, in row `row` of the block. Rows above it get numbers that nothing uses. */
static inline bool factor_triangle(size_t row, double *c) {
  for (size_t j = 0; j < COLUMNS; j++) {
    double *l = c + j * LANES, pivot = l[row + j];
    if (!(pivot > 0) || !isfinite(pivot)) return false;
    double inverse = 1 / sqrt(pivot);
    for (size_t r = 0; r < LANES; r++)
      l[r] *= inverse;
    for (size_t m = j + 1; m < COLUMNS; m++)
      for (size_t r = 0; r < LANES; r++)
        c[m * LANES + r] -= l[r] * l[row + m];
    l[row + j] = inverse;
  }
  return true;
}

/* Block I of L from those before it. */
ZP_KERNEL static bool factor_block(const ZpSkylineBlock *blocks, size_t I) {
  const ZpSkylineBlock *own = &blocks[I];
  size_t top = I * LANES;
  for (size_t j = own->first; j < top; j += COLUMNS) {
    const ZpSkylineBlock *other = &blocks[j / LANES];
    size_t first = own->first > other->first ? own->first : other->first, row = j % LANES;
    subtract(j - first, column(own, first), column(other, first) + row, column(own, j));
    divide(column(other, j) + row, column(own, j));
  }
  for (size_t row = 0; row < LANES; row += COLUMNS) {
    double *c = column(own, top + row);
    subtract(top + row - own->first, own->a, own->a + row, c);
    if (!factor_triangle(row, c)) return false;
  }
  return true;
}

bool zp_skyline_factor(ZpSkyline *s) {
  for (size_t i = s->n; i < s->blocks * LANES; i++) /* rows that fill up the last block */
    *zp_skyline_at(s, i, i) = 1;
  for (size_t I = 0; I < s->blocks; I++)
    if (!factor_block(s->block, I)) return false;
  return true;
}

/* L y = b, in place. */
ZP_KERNEL static void forward(const ZpSkyline *s, double *b) {
  for (size_t I = 0; I < s->blocks; I++) {
    const ZpSkylineBlock *block = &s->block[I];
    size_t top = I * LANES, bytes = least(LANES, s->n - top) * sizeof *b;
    double y[LANES] = {0};
    memcpy(y, b + top, bytes);
    for (size_t k = block->first; k < top; k++) {
      const double *l = column(block, k);
      double y_k = b[k];
      ZP_SIMD
      for (size_t r = 0; r < LANES; r++)
        y[r] -= l[r] * y_k;
    }
    for (size_t j = 0; j < LANES; j++) {
      const double *l = column(block, top + j);
      y[j] *= l[j];
      for (size_t r = j + 1; r < LANES; r++)
        y[r] -= l[r] * y[j];
    }
    memcpy(b + top, y, bytes);
  }
}

/* L' x = y, in place: a block of x, once known, goes out of the equations before it. */
ZP_KERNEL static void backward(const ZpSkyline *s, double *b) {
  for (size_t I = s->blocks; I-- > 0;) {
    const ZpSkylineBlock *block = &s->block[I];
    size_t top = I * LANES, bytes = least(LANES, s->n - top) * sizeof *b;
    double x[LANES] = {0};
    memcpy(x, b + top, bytes);
    for (size_t j = LANES; j-- > 0;) {
      x[j] *= column(block, top + j)[j];
      for (size_t r = 0; r < j; r++)
        x[r] -= column(block, top + r)[j] * x[j];
    }
    memcpy(b + top, x, bytes);
    for (size_t k = block->first; k < top; k++) {
      const double *l = column(block, k);
      double product[LANES];
      ZP_SIMD
      for (size_t r = 0; r < LANES; r++)
        product[r] = l[r] * x[r];
      b[k] -= zp_sum_lanes(product);
    }
  }
}

void zp_skyline_solve(const ZpSkyline *s, double *b) {
  forward(s, b);
  backward(s, b);
}
