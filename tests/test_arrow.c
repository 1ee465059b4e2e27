/* Matrices of blocks with a border, against full ones: products, solutions, prescribed unknowns, negative eigenvalues;
 * and the sparse matrix of the border. */
#include "arrow_util.h"

#include "math/eigen.h"
#include "math/vector.h"

enum { MOST = 64, BLOCKS = 7, BORDER = 6 };

static uint64_t seed;

/* Which unknowns of the border each block meets; -1 ends a list. */
typedef struct Graph {
  const char *name;
  int border, blocks, meets[BLOCKS][BORDER + 1];
} Graph;

static const Graph graphs[] = {
    {"no border", 0, 3, {{-1}, {-1}, {-1}}},
    {"one block", 3, 1, {{0, 1, 2, -1}}},
    {"chain", 4, 5, {{0, -1}, {0, 1, -1}, {1, 2, -1}, {2, 3, -1}, {3, -1}}},
    {"star", 2, 4, {{0, 1, -1}, {1, 0, -1}, {0, 1, -1}, {0, 1, -1}}},
    {"tree", 4, 7, {{0, -1}, {0, 1, -1}, {0, 2, -1}, {1, -1}, {1, -1}, {2, 3, -1}, {2, -1}}},
    {"loop", 4, 5, {{0, 1, -1}, {1, 2, -1}, {2, 3, -1}, {3, 0, -1}, {-1}}},
    {"tree with a source", 5, 6, {{4, 0, -1}, {0, 1, 4, -1}, {0, 2, 4, -1}, {1, 4, -1}, {2, 3, 4, -1}, {3, 4, -1}}},
};

typedef struct Case {
  const Graph *graph;
  bool symmetric;
  size_t bandwidth, rank;
  ZpArrowForm form;
  ZpArrow m;
  double full[MOST][MOST];
  void *memory;
} Case;

/* Blocks of different sizes. */
static void open_case(Case *c, size_t which, bool symmetric, size_t rank) {
  const Graph *g = &graphs[which];
  ZpArrowBlock block[BLOCKS];
  size_t to[BLOCKS][BORDER];
  *c = (Case){.graph = g, .symmetric = symmetric, .bandwidth = 2, .rank = rank};
  for (int k = 0; k < g->blocks; k++) {
    size_t border = 0;
    for (; g->meets[k][border] >= 0; border++)
      to[k][border] = (size_t)g->meets[k][border];
    const ZpBandForm band = {.bandwidth = 2, .symmetric = symmetric, .rank = rank, .border = border};
    block[k] = (ZpArrowBlock){4 + (size_t)k % 3, band, to[k]};
  }
  ck_assert(zp_arrow_form_create(block, (size_t)g->blocks, (size_t)g->border, NULL, 0, &c->form));
  c->memory = zero_arrow(&c->m, &c->form);
}

static void close_case(Case *c) {
  zp_arrow_form_destroy(&c->form);
  zp_free(c->memory);
}

/* An entry of a block or beside it, and the one that mirrors it. */
static void set(Case *c, const ZpArrowPart *p, size_t i, size_t j, double value) {
  const size_t row = i < p->n ? p->first + i : c->form.inner + p->to[i - p->n],
               column = j < p->n ? p->first + j : c->form.inner + p->to[j - p->n];
  c->full[row][column] += value;
  if (i < p->n && j < p->n) {
    if (i <= j || !c->symmetric) *zp_band_at(&p->A, i, j) += value;
  } else if (i >= p->n && j >= p->n) {
    p->A.corner[(i - p->n) * p->border + (j - p->n)] += value;
  } else if (j >= p->n) {
    p->A.beside[(j - p->n) * p->n + i] += value;
  } else {
    p->C[(i - p->n) * p->n + j] += value;
  }
}

/* Random entries, with `large` on the diagonal: of each block, of what is beside it, and of D. */
static void fill(Case *c, double large) {
  memset(c->full, 0, sizeof c->full);
  zp_arrow_clear(&c->m);
  for (const ZpArrowPart *p = c->m.part; p < c->m.part + c->form.blocks; p++) {
    for (size_t i = 0; i < p->n + p->border; i++)
      for (size_t j = i; j < p->n + p->border; j++) {
        if (j < p->n && j > i + c->bandwidth) continue;
        double one = noise(&seed), other = c->symmetric ? one : noise(&seed);
        set(c, p, i, j, one + (i == j ? large : 0));
        if (i != j) set(c, p, j, i, other);
      }
    for (size_t k = 0; k < c->rank; k++) {
      double *u = zp_band_term(&p->A, p->A.u, k), *v = zp_band_term(&p->A, p->A.v, k);
      for (size_t i = 0; i < p->n + p->border; i++)
        v[i] = 0.3 * (u[i] = noise(&seed));
      for (size_t i = 0; i < p->n + p->border; i++)
        for (size_t j = 0; j < p->n + p->border; j++)
          c->full[i < p->n ? p->first + i : c->form.inner + p->to[i - p->n]]
                 [j < p->n ? p->first + j : c->form.inner + p->to[j - p->n]] += u[i] * v[j];
    }
  }
  for (size_t i = c->form.inner; i < c->form.n; i++) {
    *c->m.diagonal[i] += large;
    c->full[i][i] += large;
  }
  zp_arrow_close(&c->m);
}

static void multiply(const Case *c, const double *x, double *y) {
  for (size_t i = 0; i < c->form.n; i++)
    y[i] = zp_dot(c->form.n, c->full[i], x);
}

static double apart(size_t n, const double *a, const double *b) {
  double most = 0;
  for (size_t i = 0; i < n; i++)
    most = fmax(most, fabs(a[i] - b[i]));
  return most;
}

static void draw(size_t n, double *x) {
  for (size_t i = 0; i < n; i++)
    x[i] = noise(&seed);
}

/* Error of the solution for a known x. */
static double solution_error(Case *c) {
  double x[MOST], b[MOST];
  draw(c->form.n, x);
  multiply(c, x, b);
  ck_assert(zp_arrow_factor(&c->m));
  zp_arrow_solve(&c->m, b);
  return apart(c->form.n, x, b);
}

/* Products and solutions are those of the full matrix; all three kinds of entries have the right place. */
TESTS(arrow_is_as_full, 0, LENGTH_OF(graphs)) {
  for (size_t kind = 0; kind < 4; kind++) {
    Case c;
    double x[MOST], y[MOST], expected[MOST];
    seed = 1 + kind;
    open_case(&c, (size_t)_i, kind % 2 == 0, kind / 2);
    fill(&c, 9);
    draw(c.form.n, x);
    zp_arrow_multiply(&c.m, x, y);
    multiply(&c, x, expected);
    ck_below(apart(c.form.n, y, expected), 1.5e-14); /* 5.3e-15 measured */
    for (size_t i = c.form.inner; i < c.form.n && c.rank == 0; i++)
      ck_assert_double_eq_tol(*c.m.diagonal[i], c.full[i][i], 8e-16 * c.full[i][i]); /* 2.7e-16 measured */
    ck_assert(zp_arrow_is_symmetric(&c.m) == (kind == 0));
    ck_below(solution_error(&c), 1.5e-15); /* 5.0e-16 measured */
    close_case(&c);
  }
}

/* The solution with a prescribed unknown obeys all other equations as they were, and the row that was replaced is that
 * of the matrix. */
TESTS(prescribed_unknown_of_an_arrow, 0, LENGTH_OF(graphs)) {
  for (size_t kind = 0; kind < 4; kind++) {
    Case c;
    open_case(&c, (size_t)_i, kind % 2 == 0, kind / 2);
    for (size_t unknown = 0; unknown < c.form.n; unknown++) {
      const double diagonal = 2, move = 0.7;
      double b[MOST], x[MOST], product[MOST], row[MOST];
      seed = 1 + kind;
      fill(&c, 9);
      draw(c.form.n, b);
      memcpy(x, b, sizeof x);
      x[unknown] = diagonal * move;
      zp_arrow_prescribe(&c.m, unknown, diagonal, move, x, row);
      ck_below(apart(c.form.n, row, c.full[unknown]), 2e-14); /* 7.1e-15 measured, of 35 */
      ck_assert(zp_arrow_factor(&c.m));
      zp_arrow_solve(&c.m, x);
      multiply(&c, x, product);
      product[unknown] = b[unknown];
      ck_assert_double_eq_tol(x[unknown], move, 3e-16); /* 1.1e-16 measured */
      ck_below(apart(c.form.n, product, b), 2.7e-15);   /* 8.9e-16 measured */
    }
    close_case(&c);
  }
}

/* A block that is singular without the border, or nearly singular and meets one unknown of it, gives the solution:
 * refinement recovers what elimination loses. */
TESTS(arrow_of_singular_blocks, 1, LENGTH_OF(graphs)) {
  static const double left[] = {0, 0, 1e-18, 1e-14, 1e-9};
  for (size_t k = 0; k < LENGTH_OF(left); k++) {
    const double holds = k > 0; /* else the first unknown meets the border only, as a multiplier does */
    Case c;
    seed = 3;
    open_case(&c, (size_t)_i, true, 0);
    fill(&c, 9);
    const ZpArrowPart *p = c.m.part;
    if (left[k] > 0 && p->border > 1) {
      close_case(&c);
      continue;
    }
    const double floating[2][4] = {{holds, -holds}, {-holds, 1 + left[k]}}; /* two that hold on to each other only */
    for (size_t i = 0; i < 2; i++)
      for (size_t j = i; j <= i + c.bandwidth && j < p->n; j++)
        *zp_band_at(&p->A, i, j) = c.full[i][j] = c.full[j][i] = floating[i][j];
    ck_below(solution_error(&c), 2.2e-14); /* 7.4e-15 measured */
    close_case(&c);
  }
}

/* Haynsworth: the negative eigenvalues of a symmetric matrix are those of its blocks and of what is left of the
 * border. */
TESTS(negative_eigenvalues_of_an_arrow, 0, LENGTH_OF(graphs)) {
  size_t some = 0;
  for (size_t k = 0; k < 20; k++) {
    Case c;
    double a[MOST * MOST], turn[MOST * MOST];
    size_t negative = 0;
    seed = 10 + k;
    open_case(&c, (size_t)_i, true, 0);
    fill(&c, 0.15 * (double)k);
    const size_t n = c.form.n;
    for (size_t i = 0; i < n * n; i++)
      a[i] = c.full[i / n][i % n];
    zp_eigen_symmetric(n, a, turn);
    for (size_t i = 0; i < n; i++)
      negative += a[i * n + i] < 0;
    ck_assert(zp_arrow_factor(&c.m));
    ck_assert_uint_eq(zp_arrow_negative(&c.m), negative);
    some += negative;
    close_case(&c);
  }
  ck_assert_uint_gt(some, 20);
}

/* A matrix that is singular with its border says so. */
TEST(singular_arrow) {
  ZpArrow m;
  ZpArrowForm form = form_of_block(3, (ZpBandForm){.symmetric = true, .border = 1});
  void *memory = zero_arrow(&m, &form);
  for (size_t i = 0; i < 2; i++)
    *m.diagonal[i] = 1;
  zp_arrow_close(&m);
  ck_assert(!zp_arrow_factor(&m));
  zp_free(memory);
  zp_arrow_form_destroy(&form);
}

/* A tree of groups is eliminated without new entries, also if all meet one unknown more; a ring gets N - 3 new
 * entries. */
TESTS(trees_stay_sparse, 0, 3) {
  enum { N = 200 };
  size_t pair[N][3];
  ZpClique clique[N];
  ZpSparsity s;
  const bool common = _i == 1, ring = _i == 2;
  for (size_t k = 1; k < N; k++) {
    pair[k][0] = k;
    pair[k][1] = ring ? k - 1 : (k - 1) / 2;
    pair[k][2] = N;
    clique[k] = (ZpClique){common ? 3 : 2, pair[k]};
  }
  pair[0][0] = 0;
  pair[0][1] = N - 1;
  clique[0] = (ZpClique){ring ? 2 : 1, pair[0]};
  ck_assert(zp_sparsity_create(N + common, clique, N, &s));
  ck_assert_uint_eq(s.entries, common ? 2 * N - 1 : ring ? 2 * N - 3 : N - 1);
  for (size_t place = 0; place < s.n; place++) {
    ck_assert_uint_eq(s.place[s.unknown[place]], place);
    for (size_t k = s.start[place]; k < s.start[place + 1]; k++)
      ck_assert(s.column[k] > (k > s.start[place] ? s.column[k - 1] : place));
  }
  zp_sparsity_destroy(&s);
}
