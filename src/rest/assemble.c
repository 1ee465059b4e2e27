#include "rest/assemble.h"

/* Makes the lists: with `terms` NULL it counts only. */
typedef struct Maker {
  const ZpModel *model;
  const ZpAssembly *assembly;
  ZpTerms *list;
} Maker;

static size_t number(const ZpModel *model, int *equation) {
  int next = 0;
  for (size_t j = 0; j < model->count; j++) {
    bool joined = model->s == 2 && j == 1;
    bool free_x = model->masses.x.inverse[j] > 0, free_y = model->masses.y.inverse[j] > 0;
    equation[2 * j] = joined ? equation[0] : free_x ? next++ : -1;
    equation[2 * j + 1] = joined ? equation[1] : free_y ? next++ : -1;
  }
  return (size_t)next;
}

/* The derivative `from` of the force on coordinate `row` by coordinate `column`. */
static void add(const Maker *to, size_t row, size_t column, size_t from, double weight) {
  const ZpAssembly *a = to->assembly;
  int i = a->equation[row], j = a->equation[column];
  if (i < 0 || j < 0 || (a->symmetric && i > j)) return;
  int lower = a->symmetric ? 0 : (int)a->bandwidth, stride = 2 * lower + (int)a->bandwidth + 1;
  if (to->list->term) to->list->term[to->list->count] = (ZpTerm){i * stride + j + lower - i, (int)from, weight};
  to->list->count++;
}

/* A 2 x 2 block d(force on a)/d(position of b), sign turned. */
static void add_block(const Maker *to, size_t a, size_t b, size_t from, double sign) {
  for (size_t k = 0; k < 4; k++)
    add(to, 2 * a + k / 2, 2 * b + k % 2, from + k, sign);
}

/* Edge j (nodes j, j + s) feels edge k (nodes k, k + s): the force R_j acts on its right node, -R_j on its left. */
static void list_edges(const Maker *to) {
  ptrdiff_t step = (ptrdiff_t)to->model->s, edges = (ptrdiff_t)(to->model->count - to->model->s);
  for (ptrdiff_t j = 0; j < edges; j++)
    for (ptrdiff_t m = 0; m < 3; m++) {
      ptrdiff_t k = j + (m - 1) * step;
      if (k < 0 || k >= edges) continue;
      size_t left = (size_t)j, right = (size_t)(j + step), start = (size_t)k, end = (size_t)(k + step);
      size_t block = 4 * (size_t)(3 * j + m);
      add_block(to, right, end, block, 1);
      add_block(to, right, start, block, -1);
      add_block(to, left, end, block, -1);
      add_block(to, left, start, block, 1);
    }
}

/* By the gaps of stations i and k: gap = y upper - y lower. */
static void add_gaps(const Maker *to, size_t i, size_t k, size_t from) {
  size_t s = to->model->s;
  for (size_t a = 0; a < s; a++)
    for (size_t b = 0; b < s; b++)
      add(to, 2 * (s * i + a) + 1, 2 * (s * k + b) + 1, from, a == b ? 1 : -1);
}

static void list_own(const Maker *to) {
  for (size_t i = 0; i < to->model->nodes; i++)
    add_gaps(to, i, i, i);
}

static void list_next(const Maker *to) {
  for (size_t i = 0; i + 1 < to->model->nodes; i++) {
    add_gaps(to, i, i + 1, i);
    add_gaps(to, i + 1, i, i);
  }
}

/* By the mean x-length of each element and the gap of its station `side`, both orders. */
static void list_along(const Maker *to, size_t side) {
  size_t s = to->model->s;
  for (size_t i = 0; i + 1 < to->model->nodes; i++)
    for (size_t a = 0; a < 2 * s; a++) /* nodes of station i, then of i + 1 */
      for (size_t b = 0; b < s; b++) {
        size_t x = 2 * (s * i + a), y = 2 * (s * (i + side) + b) + 1;
        double rises = s == 2 && b == 0 ? 1 : -1; /* how the gap goes with this y */
        double weight = (a < s ? -1 : 1) * rises / (double)s;
        add(to, x, y, i, weight);
        add(to, y, x, i, weight);
      }
}

/* => terms in all lists. */
static size_t list_all(const ZpModel *model, ZpAssembly *a) {
  list_edges(&(Maker){model, a, &a->list[ZP_EDGES]});
  if (model->field) {
    list_own(&(Maker){model, a, &a->list[ZP_OWN]});
    list_next(&(Maker){model, a, &a->list[ZP_NEXT]});
    list_along(&(Maker){model, a, &a->list[ZP_ALONG_LEFT]}, 0);
    list_along(&(Maker){model, a, &a->list[ZP_ALONG_RIGHT]}, 1);
  }
  size_t all = 0;
  for (size_t k = 0; k < ZP_TERM_LISTS; k++)
    all += a->list[k].count;
  return all;
}

/* The lists are counted first, then share one block. */
static bool make_lists(const ZpModel *model, ZpAssembly *a) {
  a->terms = zp_calloc(list_all(model, a), sizeof *a->terms);
  if (!a->terms) return false;
  ZpTerm *next = a->terms;
  for (size_t k = 0; k < ZP_TERM_LISTS; k++) {
    a->list[k].term = next;
    next += a->list[k].count;
    a->list[k].count = 0;
  }
  list_all(model, a);
  return true;
}

bool zp_assembly_create(const ZpModel *model, bool symmetric, ZpAssembly *a) {
  *a = (ZpAssembly){.bandwidth = 6 * model->s - 1, .symmetric = symmetric};
  a->equation = zp_calloc(2 * model->count, sizeof *a->equation);
  if (!a->equation) return false;
  a->n = number(model, a->equation);
  if (make_lists(model, a)) return true;
  zp_assembly_destroy(a);
  return false;
}

void zp_assembly_destroy(ZpAssembly *a) {
  zp_free(a->equation);
  zp_free(a->terms);
  *a = (ZpAssembly){0};
}

void zp_assemble(const ZpAssembly *a, ZpTermList list, const double *derivatives, ZpBand *K) {
  const ZpTerms *terms = &a->list[list];
  double *entries = K->a;
  for (size_t k = 0; k < terms->count; k++) {
    ZpTerm term = terms->term[k];
    entries[term.place] += term.weight * derivatives[term.from];
  }
}
