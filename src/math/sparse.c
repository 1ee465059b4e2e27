#include "math/sparse.h"

#include <math.h>
#include <string.h>

/* -- order of elimination -------------------------------------------------------------------------- */

/* Groups of unknowns that meet: at first those given; an unknown that is eliminated makes one group of all in which it
 * was, without itself. */
typedef struct Groups {
  size_t n, count;
  size_t *first, *size; /* [n + cliques] of each group: place of its first member; 0 members: it is no more */
  size_t *member;
  size_t *next; /* at the place of a member: its place in another group; NONE: there is none */
  size_t *of;   /* [places] the group there */
  size_t *in;   /* [n] the place of an unknown in the last group that it has joined */
  size_t used, room;
  size_t *degree;   /* [n] how many others an unknown meets */
  bool *gone, *met; /* [n] is eliminated; is counted */
} Groups;

static const size_t NONE = (size_t)-1;

static void close_groups(Groups *g) {
  size_t *const all[] = {g->first, g->size, g->member, g->next, g->of, g->in, g->degree};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
    zp_free(all[k]);
  zp_free(g->gone);
  zp_free(g->met);
}

static bool grow(size_t **array, size_t used, size_t room) {
  size_t *larger = zp_calloc(room, sizeof *larger);
  if (!larger) return false;
  if (used > 0) memcpy(larger, *array, used * sizeof *larger);
  zp_free(*array);
  *array = larger;
  return true;
}

static bool make_room(Groups *g, size_t more) {
  if (g->used + more <= g->room) return true;
  g->room = 2 * (g->used + more);
  return grow(&g->member, g->used, g->room) && grow(&g->next, g->used, g->room) && grow(&g->of, g->used, g->room);
}

/* Of the group that is made. */
static void add_member(Groups *g, size_t unknown) {
  const size_t place = g->used++;
  g->member[place] = unknown;
  g->of[place] = g->count;
  g->next[place] = g->in[unknown];
  g->in[unknown] = place;
}

static void end_group(Groups *g, size_t first) {
  g->first[g->count] = first;
  g->size[g->count++] = g->used - first;
}

/* Count an unknown's neighbours, which all its groups have; with `join`, they become the group that is made, and those
 * groups are no more. */
static size_t neighbours(Groups *g, size_t unknown, bool join) {
  const size_t before = g->used;
  size_t count = 0;
  for (int pass = 0; pass < 2; pass++) /* the second one forgets what the first has met */
    for (size_t at = g->in[unknown]; at != NONE; at = g->next[at]) {
      const size_t group = g->of[at];
      for (size_t k = g->first[group]; k < g->first[group] + g->size[group]; k++) {
        const size_t i = g->member[k];
        if (i == unknown || g->met[i] == (pass == 0)) continue;
        g->met[i] = pass == 0;
        count += pass == 0;
        if (join && pass == 0) add_member(g, i);
      }
      if (join && pass == 1) g->size[group] = 0;
    }
  if (join && count > 0) end_group(g, before);
  return count;
}

static bool open_groups(size_t n, const ZpClique *clique, size_t cliques, Groups *g) {
  *g = (Groups){.n = n};
  size_t **of_groups[] = {&g->first, &g->size}, **of_unknowns[] = {&g->in, &g->degree};
  bool made = true;
  for (size_t k = 0; k < 2; k++) {
    made &= (*of_groups[k] = zp_calloc(n + cliques, sizeof **of_groups)) != NULL;
    made &= (*of_unknowns[k] = zp_calloc(n + 1, sizeof **of_unknowns)) != NULL;
  }
  g->gone = zp_calloc(n + 1, sizeof *g->gone);
  g->met = zp_calloc(n + 1, sizeof *g->met);
  if (!made || !g->gone || !g->met || !make_room(g, n + 1)) return false;
  for (size_t i = 0; i < n; i++)
    g->in[i] = NONE;
  for (const ZpClique *of = clique; of < clique + cliques; of++) {
    const size_t first = g->used;
    if (!make_room(g, of->count)) return false;
    for (size_t k = 0; k < of->count; k++)
      add_member(g, of->member[k]);
    end_group(g, first);
  }
  for (size_t i = 0; i < n; i++)
    g->degree[i] = neighbours(g, i, false);
  return true;
}

static size_t least_degree(const Groups *g) {
  size_t best = g->n;
  for (size_t i = 0; i < g->n; i++)
    if (!g->gone[i] && (best == g->n || g->degree[i] < g->degree[best])) best = i;
  return best;
}

/* => how many unknowns it meets, the last members; NONE: there is no memory. */
static size_t eliminate(Groups *g, size_t unknown) {
  if (!make_room(g, g->degree[unknown])) return NONE;
  const size_t first = g->used;
  neighbours(g, unknown, true);
  g->gone[unknown] = true;
  for (size_t k = first; k < g->used; k++)
    g->degree[g->member[k]] = neighbours(g, g->member[k], false);
  return g->used - first;
}

/* Groups that elimination has made => columns, by place and growing. */
static void fill_columns(const Groups *g, const size_t *made, ZpSparsity *s) {
  for (size_t place = 0; place < s->n; place++) {
    size_t *column = s->column + s->start[place];
    for (size_t k = 0; k < s->start[place + 1] - s->start[place]; k++) {
      size_t at = k, later = s->place[g->member[made[place] + k]];
      for (; at > 0 && column[at - 1] > later; at--)
        column[at] = column[at - 1];
      column[at] = later;
    }
  }
}

/* => `made`, where the members of each place's group begin. */
static bool find_order(Groups *g, size_t *made, ZpSparsity *s) {
  for (size_t place = 0; place < s->n; place++) {
    size_t unknown = least_degree(g), met = eliminate(g, unknown);
    if (met == NONE) return false;
    made[place] = g->used - met;
    s->place[unknown] = place;
    s->unknown[place] = unknown;
    s->start[place + 1] = s->start[place] + met;
  }
  s->entries = s->start[s->n];
  s->column = zp_calloc(s->entries + 1, sizeof *s->column);
  if (s->column) fill_columns(g, made, s);
  return s->column != NULL;
}

bool zp_sparsity_create(size_t n, const ZpClique *clique, size_t cliques, ZpSparsity *s) {
  Groups groups;
  size_t *made = zp_calloc(n + 1, sizeof *made);
  *s = (ZpSparsity){.n = n};
  s->place = zp_calloc(n + 1, sizeof *s->place);
  s->unknown = zp_calloc(n + 1, sizeof *s->unknown);
  s->start = zp_calloc(n + 1, sizeof *s->start);
  bool opened = open_groups(n, clique, cliques, &groups);
  bool found = made && s->place && s->unknown && s->start && opened && find_order(&groups, made, s);
  close_groups(&groups);
  zp_free(made);
  if (!found) zp_sparsity_destroy(s);
  return found;
}

void zp_sparsity_destroy(ZpSparsity *s) {
  zp_free(s->place);
  zp_free(s->unknown);
  zp_free(s->start);
  zp_free(s->column);
  *s = (ZpSparsity){0};
}

/* -- values ---------------------------------------------------------------------------------------- */

void zp_sparse_reserve(ZpSparse *m, const ZpSparsity *sparsity, ZpArena *arena) {
  m->of = sparsity;
  m->diagonal = zp_arena_take(arena, sparsity->n);
  m->upper = zp_arena_take(arena, sparsity->entries);
  m->lower = zp_arena_take(arena, sparsity->entries);
  m->x = zp_arena_take(arena, sparsity->n);
}

void zp_sparse_clear(ZpSparse *m) {
  memset(m->diagonal, 0, m->of->n * sizeof *m->diagonal);
  memset(m->upper, 0, m->of->entries * sizeof *m->upper);
  memset(m->lower, 0, m->of->entries * sizeof *m->lower);
}

void zp_sparse_copy(ZpSparse *m, const ZpSparse *from) {
  memcpy(m->diagonal, from->diagonal, m->of->n * sizeof *m->diagonal);
  memcpy(m->upper, from->upper, m->of->entries * sizeof *m->upper);
  memcpy(m->lower, from->lower, m->of->entries * sizeof *m->lower);
}

/* The entry of a row for a later place that it meets. */
static size_t entry_of(const ZpSparsity *s, size_t row, size_t column) {
  size_t k = s->start[row];
  while (s->column[k] < column)
    k++;
  return k;
}

double *zp_sparse_at(const ZpSparse *m, size_t i, size_t j) {
  size_t row = m->of->place[i], column = m->of->place[j];
  if (row == column) return m->diagonal + row;
  return row < column ? m->upper + entry_of(m->of, row, column) : m->lower + entry_of(m->of, column, row);
}

void zp_sparse_add_product(const ZpSparse *m, const double *x, double *y) {
  const ZpSparsity *s = m->of;
  for (size_t row = 0; row < s->n; row++) {
    const size_t i = s->unknown[row];
    y[i] += m->diagonal[row] * x[i];
    for (size_t k = s->start[row]; k < s->start[row + 1]; k++) {
      const size_t j = s->unknown[s->column[k]];
      y[i] += m->upper[k] * x[j];
      y[j] += m->lower[k] * x[i];
    }
  }
}

/* Take an entry of the prescribed row and the one of its column out. */
static void uncouple(double *in_row, double *in_column, size_t other, double move, double *r, double *row) {
  row[other] += *in_row;
  if (r) r[other] -= *in_column * move;
  *in_row = *in_column = 0;
}

void zp_sparse_prescribe(ZpSparse *m, size_t unknown, double diagonal, double move, double *r, double *row) {
  const ZpSparsity *s = m->of;
  const size_t at = s->place[unknown];
  for (size_t k = s->start[at]; k < s->start[at + 1]; k++)
    uncouple(m->upper + k, m->lower + k, s->unknown[s->column[k]], move, r, row);
  for (size_t before = 0; before < at; before++)
    for (size_t k = s->start[before]; k < s->start[before + 1]; k++)
      if (s->column[k] == at) uncouple(m->lower + k, m->upper + k, s->unknown[before], move, r, row);
  row[unknown] += m->diagonal[at];
  m->diagonal[at] = diagonal;
}

/* -- factors --------------------------------------------------------------------------------------- */

/* Take an eliminated row, whose lower entries are factors, off the later rows that it meets. */
static void take_off(ZpSparse *m, size_t row) {
  const ZpSparsity *s = m->of;
  const size_t end = s->start[row + 1];
  for (size_t a = s->start[row]; a < end; a++) {
    const size_t i = s->column[a];
    size_t at = s->start[i];
    m->diagonal[i] -= m->lower[a] * m->upper[a];
    for (size_t b = a + 1; b < end; b++, at++) {
      while (s->column[at] < s->column[b])
        at++;
      m->upper[at] -= m->lower[a] * m->upper[b];
      m->lower[at] -= m->lower[b] * m->upper[a];
    }
  }
}

bool zp_sparse_factor(ZpSparse *m) {
  for (size_t row = 0; row < m->of->n; row++) {
    const double pivot = m->diagonal[row];
    if (pivot == 0 || !isfinite(pivot)) return false;
    for (size_t k = m->of->start[row]; k < m->of->start[row + 1]; k++)
      m->lower[k] /= pivot;
    take_off(m, row);
  }
  return true;
}

void zp_sparse_solve(const ZpSparse *m, double *b) {
  const ZpSparsity *s = m->of;
  for (size_t row = 0; row < s->n; row++)
    m->x[row] = b[s->unknown[row]];
  for (size_t row = 0; row < s->n; row++)
    for (size_t k = s->start[row]; k < s->start[row + 1]; k++)
      m->x[s->column[k]] -= m->lower[k] * m->x[row];
  for (size_t row = s->n; row-- > 0;) {
    for (size_t k = s->start[row]; k < s->start[row + 1]; k++)
      m->x[row] -= m->upper[k] * m->x[s->column[k]];
    m->x[row] /= m->diagonal[row];
    b[s->unknown[row]] = m->x[row];
  }
}

size_t zp_sparse_negative(const ZpSparse *m) {
  size_t negative = 0;
  for (size_t row = 0; row < m->of->n; row++)
    negative += m->diagonal[row] < 0;
  return negative;
}
