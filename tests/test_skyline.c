/* Skyline Cholesky against factors that were there first, against LAPACK, and on a grid whose eigenvectors are
 * known. */
#include "check_util.h"

#include "base/memory.h"
#include "math/skyline.h"

/* -- random matrices, made as L L' so that L is known ------------------------------------------------- */

typedef enum Shape { DIAGONAL, BAND, RAGGED, SPIKES, FULL, LAST_FULL, SHAPES } Shape;

typedef struct Case {
  size_t n, *first;
  double *L, *A; /* [n * n], row by row; A symmetric */
  ZpSkyline s;
} Case;

static double *numbers(size_t count) {
  double *array = zp_calloc(count, sizeof *array);
  ck_assert_ptr_nonnull(array);
  return array;
}

/* How many entries row i has before its diagonal. */
static size_t profile(Shape shape, size_t n, size_t i, uint64_t *seed) {
  size_t random = (size_t)((noise(seed) + 1) * 0.5 * (double)(i + 1)), length = 0;
  if (shape == BAND) length = 11;
  if (shape == RAGGED) length = random;
  if (shape == SPIKES) length = i % 23 == 5 ? random : 9 + i % 3;
  if (shape == FULL || (shape == LAST_FULL && i == n - 1)) length = i;
  return length < i ? length : i;
}

static void assemble(Case *c) {
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = c->first[i]; j <= i; j++)
      *zp_skyline_at(&c->s, i, j) = c->A[i * c->n + j];
}

/* Diagonal of L 1 to 2, the sum of the others of a row below 1: condition of A below a few hundred. */
static Case random_case(Shape shape, size_t n, uint64_t seed) {
  Case c = {.n = n, .first = zp_calloc(n, sizeof *c.first), .L = numbers(n * n), .A = numbers(n * n)};
  for (size_t i = 0; i < n; i++) {
    c.first[i] = i - profile(shape, n, i, &seed);
    c.L[i * n + i] = 1.5 + 0.5 * noise(&seed);
    for (size_t j = c.first[i]; j < i; j++)
      c.L[i * n + j] = noise(&seed) / (double)(i - c.first[i]);
  }
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j <= i; j++) {
      double sum = 0;
      for (size_t k = 0; k <= j; k++)
        sum += c.L[i * n + k] * c.L[j * n + k];
      c.A[i * n + j] = c.A[j * n + i] = sum;
    }
  ck_assert(zp_skyline_create(&c.s, n, c.first));
  assemble(&c);
  return c;
}

static void destroy(Case *c) {
  zp_skyline_destroy(&c->s);
  zp_free(c->first);
  zp_free(c->L);
  zp_free(c->A);
}

static const size_t sizes[] = {1, 2, 7, 8, 9, 15, 16, 17, 31, 40, 65, 120};

/* Largest |value - expected|; expected NULL: largest |value|. */
static double distance(size_t n, const double *value, const double *expected) {
  double largest = 0;
  for (size_t i = 0; i < n; i++)
    largest = fmax(largest, fabs(value[i] - (expected ? expected[i] : 0)));
  return largest;
}

static double factor_error(const Case *c) {
  double error = 0;
  for (size_t i = 0; i < c->n; i++)
    for (size_t j = c->first[i]; j <= i; j++) {
      double l = *zp_skyline_at(&c->s, i, j);
      error = fmax(error, fabs((i == j ? 1 / l : l) - c->L[i * c->n + j]));
    }
  return error;
}

static double residual(const Case *c, const double *x, const double *b) {
  double largest = 0;
  for (size_t i = 0; i < c->n; i++) {
    double sum = -b[i];
    for (size_t j = 0; j < c->n; j++)
      sum += c->A[i * c->n + j] * x[j];
    largest = fmax(largest, fabs(sum));
  }
  return largest;
}

TEST(test_known_factor) {
  double worst_factor = 0, worst_residual = 0;
  for (Shape shape = 0; shape < SHAPES; shape++)
    for (size_t k = 0; k < LENGTH_OF(sizes); k++)
      for (uint64_t seed = 1; seed <= 5; seed++) {
        Case c = random_case(shape, sizes[k], seed);
        double *b = numbers(c.n), *x = numbers(c.n);
        for (size_t i = 0; i < c.n; i++)
          x[i] = b[i] = noise(&seed);
        ck_assert(zp_skyline_factor(&c.s));
        zp_skyline_solve(&c.s, x);
        worst_factor = fmax(worst_factor, factor_error(&c));
        worst_residual = fmax(worst_residual, residual(&c, x, b) / distance(c.n, x, NULL));
        zp_free(b);
        zp_free(x);
        destroy(&c);
      }
  printf("factor off by %.2e, residual %.2e\n", worst_factor, worst_residual);
  ck_below(worst_factor, 1e-14);   /* measured: 9e-16 */
  ck_below(worst_residual, 1e-14); /* 1.3e-15 */
}

/* LAPACK's Cholesky of a dense matrix, by its Fortran name. */
void dposv_(const char *uplo, const int *n, const int *nrhs, double *a, const int *lda, double *b, const int *ldb,
            int *info);

TEST(test_is_lapack) {
  double worst = 0;
  for (Shape shape = 0; shape < SHAPES; shape++)
    for (size_t k = 0; k < LENGTH_OF(sizes); k++) {
      Case c = random_case(shape, sizes[k], 99);
      double *b = numbers(c.n), *expected = numbers(c.n);
      int n = (int)c.n, one = 1, info;
      for (size_t i = 0; i < c.n; i++)
        b[i] = expected[i] = cos((double)i);
      dposv_("L", &n, &one, c.A, &n, expected, &n, &info);
      ck_assert_int_eq(info, 0);
      ck_assert(zp_skyline_factor(&c.s));
      zp_skyline_solve(&c.s, b);
      worst = fmax(worst, distance(c.n, b, expected) / distance(c.n, expected, NULL));
      zp_free(b);
      zp_free(expected);
      destroy(&c);
    }
  printf("solution off LAPACK's by %.2e\n", worst);
  ck_below(worst, 1e-14); /* measured: 7e-16 */
}

/* -- a grid, its rows one after the other: (-1 -1 4 -1 -1), sin sin is an eigenvector -------------------- */

TEST(test_grid) {
  enum { NX = 61, NY = 97, N = NX * NY };
  static size_t first[N];
  static double b[N], expected[N];
  ZpSkyline s;
  for (size_t i = 0; i < N; i++)
    first[i] = i >= NX ? i - NX : 0;
  ck_assert(zp_skyline_create(&s, N, first));
  double ax = acos(-1) / (NX + 1), ay = acos(-1) / (NY + 1), eigenvalue = 4 - 2 * cos(ax) - 2 * cos(2 * ay);
  for (size_t i = 0; i < N; i++) {
    *zp_skyline_at(&s, i, i) = 4;
    if (i % NX > 0) *zp_skyline_at(&s, i, i - 1) = -1;
    if (i >= NX) *zp_skyline_at(&s, i, i - NX) = -1;
    expected[i] = sin(ax * (double)(i % NX + 1)) * sin(2 * ay * (double)(i / NX + 1));
    b[i] = eigenvalue * expected[i];
  }
  ck_assert(zp_skyline_factor(&s));
  zp_skyline_solve(&s, b);
  printf("grid of %d: off by %.2e\n", N, distance(N, b, expected));
  ck_below(distance(N, b, expected), 5e-13); /* measured: 5e-14; the condition is 2500 */
  zp_skyline_destroy(&s);
}

/* -- what is no such matrix ------------------------------------------------------------------------------ */

/* One wrong number anywhere in a good matrix is detected, and the matrix can be used again afterwards. */
TEST(test_not_positive) {
  static const double wrong[] = {-1, 0, -0.0, NAN, INFINITY, -INFINITY};
  Case c = random_case(SPIKES, 37, 5);
  for (size_t i = 0; i < c.n; i++)
    for (size_t k = 0; k < LENGTH_OF(wrong); k++) {
      zp_skyline_clear(&c.s);
      assemble(&c);
      *zp_skyline_at(&c.s, i, i) = wrong[k];
      ck_assert_msg(!zp_skyline_factor(&c.s), "row %zu: took %g", i, wrong[k]);
      if (c.first[i] == i) continue;
      zp_skyline_clear(&c.s);
      assemble(&c);
      *zp_skyline_at(&c.s, i, c.first[i]) = isfinite(wrong[k]) ? 1e3 : wrong[k]; /* larger than its diagonals */
      ck_assert_msg(!zp_skyline_factor(&c.s), "row %zu: took %g before the diagonal", i, wrong[k]);
    }
  zp_skyline_clear(&c.s);
  assemble(&c);
  ck_assert(zp_skyline_factor(&c.s));
  ck_below(factor_error(&c), 1e-14);
  destroy(&c);
}

/* (1 1, 1 1) is exactly singular: as the last rows of a block, where no later row could notice. */
TEST(test_singular) {
  static const size_t first[] = {0, 1, 2, 3, 4, 5, 6, 6};
  ZpSkyline s;
  ck_assert(zp_skyline_create(&s, LENGTH_OF(first), first));
  for (size_t i = 0; i < s.n; i++)
    *zp_skyline_at(&s, i, i) = *zp_skyline_at(&s, i, first[i]) = 1;
  ck_assert(!zp_skyline_factor(&s));
  zp_skyline_destroy(&s);
}

/* Places of entries do not overlap, and a block holds no more than its rows need, rounded to whole blocks. */
TEST(test_places) {
  static const size_t first[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 10, 9, 12, 12, 14, 14, 15, 16, 17};
  ZpSkyline s;
  ck_assert(zp_skyline_create(&s, LENGTH_OF(first), first));
  ck_assert_uint_eq(s.tiles, 1 + 1 + 2);
  size_t set = 0, found = 0;
  for (size_t i = 0; i < s.n; i++)
    for (size_t j = first[i]; j <= i; j++)
      *zp_skyline_at(&s, i, j) = (double)++set;
  for (size_t i = 0; i < s.n; i++)
    for (size_t j = first[i]; j <= i; j++)
      ck_assert_double_eq(*zp_skyline_at(&s, i, j), (double)++found);
  zp_skyline_destroy(&s);
  zp_skyline_destroy(&s); /* harmless */
}
