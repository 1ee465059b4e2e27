/* Matrices of math/arrow.h for tests. */
#ifndef ARROW_UTIL_H
#define ARROW_UTIL_H

#include "check_util.h"

#include "math/arrow.h"

/* Of one block: n unknowns, of which the last `band.border` are the border. */
static inline ZpArrowForm form_of_block(size_t n, ZpBandForm band) {
  size_t to[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  ZpArrowForm form;
  ZpArrowBlock block = {n - band.border, band, to};
  ck_assert_uint_le(band.border, LENGTH_OF(to));
  ck_assert(zp_arrow_form_create(&block, 1, band.border, NULL, 0, &form));
  return form;
}

/* A matrix of zeros, and its memory. */
static inline void *zero_arrow(ZpArrow *m, const ZpArrowForm *form) {
  ZpArena arena = {NULL, 0};
  zp_arrow_reserve(m, form, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_arrow_reserve(m, form, &arena);
  zp_arrow_clear(m);
  return memory;
}

/* Entry (i, j) of a matrix of one block, with all that is in the border written to D. */
static inline double *entry_at(const ZpArrow *m, size_t i, size_t j) {
  const ZpArrowPart *p = m->part;
  const size_t n = p->n;
  if (i >= n && j >= n) return zp_sparse_at(&m->D, i - n, j - n);
  if (j >= n) return p->A.beside + (j - n) * n + i;
  return i >= n ? p->C + (i - n) * n + j : zp_band_at(&p->A, i, j);
}

#endif
