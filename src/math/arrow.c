/* x = A^-1 f - V z with V = A^-1 B and S z = g - C A^-1 f, S = D - C V, where A consists of all blocks. */
#include "math/arrow.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

static size_t border_of(const ZpArrowForm *form) {
  return form->n - form->inner;
}

/* -- form ------------------------------------------------------------------------------------------ */

static bool copy_block(const ZpArrowBlock *from, ZpArrowBlock *to) {
  *to = *from;
  to->to = zp_calloc(from->band.border + 1, sizeof *to->to);
  if (to->to && from->band.border > 0) memcpy(to->to, from->to, from->band.border * sizeof *to->to);
  return to->to != NULL;
}

static bool find_sparsity(ZpArrowForm *form, const ZpClique *more, size_t count) {
  ZpClique *clique = zp_calloc(form->blocks + count, sizeof *clique);
  for (size_t k = 0; clique && k < form->blocks; k++)
    clique[k] = (ZpClique){form->block[k].band.border, form->block[k].to};
  for (size_t k = 0; clique && k < count; k++)
    clique[form->blocks + k] = more[k];
  bool found = clique && zp_sparsity_create(border_of(form), clique, form->blocks + count, &form->sparsity);
  zp_free(clique);
  return found;
}

bool zp_arrow_form_create(const ZpArrowBlock *block, size_t blocks, size_t border, const ZpClique *more, size_t count,
                          ZpArrowForm *form) {
  *form = (ZpArrowForm){0};
  form->block = zp_calloc(blocks, sizeof *form->block);
  bool made = form->block != NULL;
  for (size_t k = 0; k < blocks && made; k++) {
    made = copy_block(&block[k], &form->block[k]);
    form->blocks++;
    form->inner += block[k].n;
  }
  form->n = form->inner + border;
  made = made && find_sparsity(form, more, count);
  if (!made) zp_arrow_form_destroy(form);
  return made;
}

void zp_arrow_form_destroy(ZpArrowForm *form) {
  for (size_t k = 0; form->block && k < form->blocks; k++)
    zp_free(form->block[k].to);
  zp_free(form->block);
  zp_sparsity_destroy(&form->sparsity);
  *form = (ZpArrowForm){0};
}

/* -- memory ---------------------------------------------------------------------------------------- */

static void reserve_part(ZpArrowPart *part, const ZpArrowBlock *form, size_t first, bool borders, ZpArena *arena) {
  size_t coupling = form->band.border * form->n;
  *part = (ZpArrowPart){.first = first, .n = form->n, .border = form->band.border, .to = form->to};
  zp_band_reserve_form(&part->A, form->n, form->band, arena);
  part->LU = part->A;
  if (borders) part->LU.a = zp_arena_take(arena, part->A.entries);
  part->C = zp_arena_take(arena, coupling);
  part->V = zp_arena_take(arena, coupling);
}

static void find_diagonal(ZpArrow *m) {
  for (size_t k = 0; k < m->form->blocks; k++)
    for (size_t i = 0; i < m->part[k].n; i++)
      m->diagonal[m->part[k].first + i] = zp_band_at(&m->part[k].A, i, i);
  for (size_t i = 0; i < border_of(m->form); i++)
    m->diagonal[m->form->inner + i] = zp_sparse_at(&m->D, i, i);
}

void zp_arrow_reserve(ZpArrow *m, const ZpArrowForm *form, ZpArena *arena) {
  size_t first = 0;
  *m = (ZpArrow){.form = form};
  m->part = zp_arena_take_of(arena, form->blocks, sizeof *m->part);
  for (size_t k = 0; k < form->blocks; k++) {
    ZpArrowPart unused;
    reserve_part(arena->base ? &m->part[k] : &unused, &form->block[k], first, border_of(form) > 0, arena);
    first += form->block[k].n;
  }
  zp_sparse_reserve(&m->D, &form->sparsity, arena);
  zp_sparse_reserve(&m->S, &form->sparsity, arena);
  m->diagonal = zp_arena_take_of(arena, form->n, sizeof *m->diagonal);
  m->b = zp_arena_take(arena, form->n);
  m->left = zp_arena_take(arena, form->n);
  if (arena->base) find_diagonal(m);
}

/* -- entries --------------------------------------------------------------------------------------- */

void zp_arrow_clear(ZpArrow *m) {
  for (ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++) {
    for (size_t i = 0; p->idle && i < p->n; i++)
      *m->diagonal[p->first + i] = 0;
    if (p->idle) continue;
    zp_band_clear(&p->A);
    if (p->border == 0) continue;
    memset(p->A.beside, 0, p->border * p->n * sizeof *p->A.beside);
    memset(p->C, 0, p->border * p->n * sizeof *p->C);
    memset(p->A.corner, 0, p->border * p->border * sizeof *p->A.corner);
  }
  zp_sparse_clear(&m->D);
}

void zp_arrow_mirror(ZpArrow *m) {
  for (ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++) {
    if (p->border == 0 || p->A.lower > 0) continue;
    memcpy(p->C, p->A.beside, p->border * p->n * sizeof *p->C);
    for (size_t i = 0; i < p->border; i++)
      for (size_t j = 0; j < i; j++)
        p->A.corner[i * p->border + j] = p->A.corner[j * p->border + i];
  }
}

/* y -= a x */
static void take(size_t n, double a, const double *x, double *y) {
  for (size_t i = 0; i < n; i++)
    y[i] -= a * x[i];
}

/* Of a term u v' on top of a band, what is in the border. */
static void spread_term(const ZpArrowPart *p, const double *u, const double *v) {
  for (size_t k = 0; k < p->border; k++) {
    take(p->n, -v[p->n + k], u, p->A.beside + k * p->n);
    take(p->n, -u[p->n + k], v, p->C + k * p->n);
    for (size_t j = 0; j < p->border; j++)
      p->A.corner[k * p->border + j] += u[p->n + k] * v[p->n + j];
  }
}

void zp_arrow_close(ZpArrow *m) {
  for (const ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++) {
    for (size_t k = 0; k < p->A.rank; k++)
      spread_term(p, zp_band_term(&p->A, p->A.u, k), zp_band_term(&p->A, p->A.v, k));
    for (size_t i = 0; i < p->border; i++)
      for (size_t j = 0; j < p->border; j++)
        *zp_sparse_at(&m->D, p->to[i], p->to[j]) += p->A.corner[i * p->border + j];
  }
}

static const ZpArrowPart *part_of(const ZpArrow *m, size_t i) {
  const ZpArrowPart *p = m->part;
  while (i >= p->first + p->n)
    p++;
  return p;
}

/* Which column of a part an unknown of the border is; its border if it is none. */
static size_t column_of(const ZpArrowPart *p, size_t unknown) {
  size_t k = 0;
  while (k < p->border && p->to[k] != unknown)
    k++;
  return k;
}

bool zp_arrow_is_symmetric(const ZpArrow *m) {
  const ZpArrowPart *end = m->part + m->form->blocks;
  for (const ZpArrowPart *p = m->part; p < end; p++)
    if (p->A.lower > 0 || p->A.rank > 0) return false;
  return true;
}

void zp_arrow_multiply(const ZpArrow *m, const double *x, double *y) {
  const double *z = x + m->form->inner;
  double *of_border = y + m->form->inner;
  memset(of_border, 0, border_of(m->form) * sizeof *of_border);
  for (const ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++) {
    zp_band_multiply(&p->A, x + p->first, y + p->first);
    for (size_t k = 0; k < p->border; k++) {
      take(p->n, -z[p->to[k]], p->A.beside + k * p->n, y + p->first);
      of_border[p->to[k]] += zp_dot(p->n, p->C + k * p->n, x + p->first);
    }
  }
  zp_sparse_add_product(&m->D, z, of_border);
}

/* Take out the entries between unknown i of a part and column k of its border. */
static void uncouple(const ZpArrowPart *p, size_t i, size_t k, double *in_row, double *in_column) {
  double *row = p->A.beside + k * p->n + i, *column = p->C + k * p->n + i;
  *in_row = *row;
  *in_column = *column;
  *row = *column = 0;
}

void zp_arrow_prescribe(ZpArrow *m, size_t unknown, double diagonal, double move, double *r, double *row) {
  const size_t inner = m->form->inner;
  double in_row, in_column;
  memset(row, 0, m->form->n * sizeof *row);
  if (unknown < inner) {
    ZpArrowPart *p = m->part + (part_of(m, unknown) - m->part);
    const size_t i = unknown - p->first;
    zp_band_prescribe(&p->A, i, diagonal, move, r ? r + p->first : NULL, row + p->first);
    for (size_t k = 0; k < p->border; k++) {
      uncouple(p, i, k, &in_row, &in_column);
      row[inner + p->to[k]] += in_row;
      if (r) r[inner + p->to[k]] -= in_column * move;
    }
    return;
  }
  for (const ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++) {
    const size_t k = column_of(p, unknown - inner);
    for (size_t i = 0; k < p->border && i < p->n; i++) {
      uncouple(p, i, k, &in_column, &in_row); /* seen from the border */
      row[p->first + i] += in_row;
      if (r) r[p->first + i] -= in_column * move;
    }
  }
  zp_sparse_prescribe(&m->D, unknown - inner, diagonal, move, r ? r + inner : NULL, row + inner);
}

/* -- factors --------------------------------------------------------------------------------------- */

static double largest(size_t n, const double *a) {
  double most = 0;
  for (size_t i = 0; i < n; i++)
    most = fmax(most, fabs(a[i]));
  return most;
}

/* An A that is singular alone may be regular with the border. It is shifted by the root of rounding: what the shift
 * changes and what rounding makes of its inverse are then alike, and each refinement takes out all but as little. */
static bool factor_inner(ZpArrowPart *p) {
  static const double shift = 0x1p-26;
  size_t entries = p->A.entries;
  p->shifted = false;
  if (p->LU.a == p->A.a) return zp_band_factor(&p->LU);
  memcpy(p->LU.a, p->A.a, entries * sizeof *p->A.a);
  if (zp_band_factor(&p->LU)) return true;
  double size = largest(entries, p->A.a), some = shift * (size > 0 ? size : largest(p->border * p->n, p->A.beside));
  memcpy(p->LU.a, p->A.a, entries * sizeof *p->A.a);
  p->shifted = true;
  for (size_t i = 0; i < p->n; i++)
    *zp_band_at(&p->LU, i, i) += some;
  return zp_band_factor(&p->LU);
}

/* Eliminate a block: its part of C V is taken off S. */
static bool factor_part(ZpArrowPart *p, ZpSparse *S) {
  if (!factor_inner(p)) return false;
  if (p->border == 0) return true;
  memcpy(p->V, p->A.beside, p->border * p->n * sizeof *p->V);
  for (size_t j = 0; j < p->border; j++)
    zp_band_solve(&p->LU, p->V + j * p->n);
  for (size_t i = 0; i < p->border; i++)
    for (size_t j = 0; j < p->border; j++)
      *zp_sparse_at(S, p->to[i], p->to[j]) -= zp_dot(p->n, p->C + i * p->n, p->V + j * p->n);
  return true;
}

bool zp_arrow_factor(ZpArrow *m) {
  zp_sparse_copy(&m->S, &m->D);
  for (ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++)
    if (!p->idle && !factor_part(p, &m->S)) return false;
  return zp_sparse_factor(&m->S);
}

/* -- solution -------------------------------------------------------------------------------------- */

/* Size of a vector, with the diagonal as the weight of what its unknowns count. */
static double size_of(const ZpArrowPart *p, double *const *diagonal, const double *x) {
  double sum = 0;
  for (size_t i = 0; i < p->n; i++)
    sum += fabs(*diagonal[i]) * x[i] * x[i];
  return sqrt(sum);
}

/* => how many times larger the solutions of blocks alone were than those with the border: so much of their accuracy is
 * lost. INFINITY of a block that is singular alone. */
static double eliminate(const ZpArrow *m, double *b) {
  const ZpArrowPart *end = m->part + m->form->blocks;
  double *z = b + m->form->inner, alone = 0, joined = 0;
  for (const ZpArrowPart *p = m->part; p < end; p++) {
    if (p->idle) continue;
    zp_band_solve(&p->LU, b + p->first);
    if (p->shifted) alone = INFINITY;
    if (p->border > 0) alone = fmax(alone, size_of(p, m->diagonal + p->first, b + p->first));
    for (size_t k = 0; k < p->border; k++)
      z[p->to[k]] -= zp_dot(p->n, p->C + k * p->n, b + p->first);
  }
  zp_sparse_solve(&m->S, z);
  for (const ZpArrowPart *p = m->part; p < end; p++) {
    for (size_t k = 0; k < p->border; k++)
      take(p->n, z[p->to[k]], p->V + k * p->n, b + p->first);
    if (p->border > 0) joined = fmax(joined, size_of(p, m->diagonal + p->first, b + p->first));
  }
  return alone / joined;
}

void zp_arrow_solve(const ZpArrow *m, double *b) {
  enum { REFINEMENTS = 2 };
  static const double lost = 1e3;
  const size_t n = m->form->n;
  if (border_of(m->form) > 0) memcpy(m->b, b, n * sizeof *b);
  if (!(eliminate(m, b) > lost)) return;
  for (int k = 0; k < REFINEMENTS; k++) {
    zp_arrow_multiply(m, b, m->left);
    for (size_t i = 0; i < n; i++)
      m->left[i] = m->b[i] - m->left[i];
    eliminate(m, m->left);
    take(n, -1, m->left, b);
  }
}

size_t zp_arrow_negative(const ZpArrow *m) {
  size_t negative = zp_sparse_negative(&m->S);
  for (const ZpArrowPart *p = m->part; p < m->part + m->form->blocks; p++)
    negative += p->idle ? 0 : zp_band_negative(&p->LU);
  return negative;
}
