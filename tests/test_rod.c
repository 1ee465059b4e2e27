/* The discrete elastic rod and the algebra under its statics: forces and stiffness as differences of the energy,
 * momentum of a free rod; band LU and LDL' against dense elimination; eigenvalues against closed forms;
 * the mass-spring chain's stiffness against differences of its forces. */
#include "check_util.h"

#include "base/kernel.h"
#include "math/band.h"
#include "math/eigen.h"
#include "math/eigen_general.h"
#include "math/vector.h"
#include "paper/massspring.h"
#include "ribbon/rod_step.h"

/* -- a rod of no particular shape ------------------------------------------------------------------ */

enum { NODES = 9, MOST = 2 * NODES, PLACES = 32 };

typedef struct Rod {
  ZpRodParams params;
  ZpRodEval eval;
  ZpRodStep forces; /* at rest */
  double l[PLACES], S[PLACES], B[PLACES], k0[PLACES], turn[PLACES];
  double x[PLACES], y[PLACES];
  void *memory;
} Rod;

static void reserve(Rod *r, ZpArena *arena) {
  zp_rod_reserve(&r->params, &r->eval, arena);
  zp_rod_step_reserve(&r->params, &r->forces, arena);
}

/* Unequal edges and joints, naturally curved, bent up to 0.5 rad a joint and stretched by a few percent.
 * `free_ends`: no slope is held. */
static void make_rod(Rod *r, size_t ribbons, bool free_ends, uint64_t seed) {
  *r = (Rod){
      .params = {.ribbons = ribbons, .nodes = NODES, .lanes = PLACES, .l = r->l, .S = r->S, .B = r->B, .k0 = r->k0}};
  size_t count = ribbons * NODES;
  for (size_t j = 0; j < PLACES; j++) {
    size_t station = j / ribbons;
    bool end = station == 0 || station == NODES - 1;
    r->l[j] = 1 + 0.3 * noise(&seed);
    r->S[j] = j < count - ribbons ? 5 + 2 * noise(&seed) : 0;
    r->B[j] = j < count && !(end && free_ends) ? 2 + noise(&seed) : 0;
    r->turn[j] = 0.3 * noise(&seed);
    r->k0[j] = zp_rod_curvature(tan(0.5 * r->turn[j]));
    double angle = 0.4 * noise(&seed), length = r->l[j] * (1 + 0.05 * noise(&seed));
    if (j + ribbons >= PLACES) continue;
    r->x[j + ribbons] = r->x[j] + length * cos(angle);
    r->y[j + ribbons] = r->y[j] + length * sin(angle);
  }
  for (size_t j = 0; j < ribbons && !free_ends; j++) {
    size_t last = count - ribbons + j;
    r->params.end[r->params.ends++] = (ZpRodEnd){j, j + ribbons, j, j + ribbons, -0.7};
    r->params.end[r->params.ends++] = (ZpRodEnd){last, last - ribbons, last - ribbons, last - 2 * ribbons, -0.4};
  }
  ZpArena arena = {NULL, 0};
  reserve(r, &arena);
  r->memory = zp_calloc(1, arena.used);
  arena = (ZpArena){r->memory, 0};
  reserve(r, &arena);
}

static double *coordinate(Rod *r, size_t k) {
  return k % 2 ? &r->y[k / 2] : &r->x[k / 2];
}

static double energy_of(Rod *r) {
  zp_rod_eval(&r->params, r->x, r->y, &r->eval);
  return zp_rod_stretching_energy(&r->params, &r->eval) + zp_rod_bending_energy(&r->params, &r->eval);
}

/* Forces on nodes from those of edges: coordinates x and y of node j at 2 j and 2 j + 1. */
static void gather(const double *Rx, const double *Ry, size_t ribbons, double *force) {
  size_t count = ribbons * NODES, edges = count - ribbons;
  for (size_t j = 0; j < count; j++) {
    force[2 * j] = (j >= ribbons ? Rx[j - ribbons] : 0) - (j < edges ? Rx[j] : 0);
    force[2 * j + 1] = (j >= ribbons ? Ry[j - ribbons] : 0) - (j < edges ? Ry[j] : 0);
  }
}

static void rod_forces(Rod *r, double *force) {
  zp_rod_eval(&r->params, r->x, r->y, &r->eval);
  zp_rod_step(&r->params, &r->eval, &r->eval, 0, &r->forces);
  gather(r->forces.Rx, r->forces.Ry, r->params.ribbons, force);
}

/* Central difference of the fourth order. */
static double difference(const double *at, double h) {
  return (8 * (at[2] - at[1]) - (at[3] - at[0])) / (12 * h);
}

static const double offsets[4] = {-2, -1, 1, 2};

TESTS(test_force_is_gradient, 0, 4) {
  const double h = 1e-3;
  size_t ribbons = (size_t)_i % 2 + 1;
  for (uint64_t seed = 1; seed <= 5; seed++) {
    Rod r;
    make_rod(&r, ribbons, _i / 2, seed);
    double force[2 * MOST];
    rod_forces(&r, force);
    for (size_t k = 0; k < 2 * ribbons * NODES; k++) {
      double at[4], kept = *coordinate(&r, k);
      for (int m = 0; m < 4; m++) {
        *coordinate(&r, k) = kept + offsets[m] * h;
        at[m] = energy_of(&r);
      }
      *coordinate(&r, k) = kept;
      ck_assert_double_eq_tol(force[k], -difference(at, h), 5e-10); /* 9.1e-11 measured */
    }
    zp_free(r.memory);
  }
}

/* -- stiffness ------------------------------------------------------------------------------------- */

/* What edges feel of edges, as actuator/assemble.c puts it together: K[row][column] of node coordinates. */
static void assemble(const double (*D)[4], size_t ribbons, double (*K)[2 * MOST]) {
  memset(K, 0, 2 * MOST * sizeof *K);
  ptrdiff_t s = (ptrdiff_t)ribbons, edges = s * (NODES - 1);
  for (ptrdiff_t j = 0; j < edges; j++)
    for (ptrdiff_t m = 0; m < 3; m++)
      for (int entry = 0; entry < 4; entry++) {
        ptrdiff_t k = j + (m - 1) * s, row = entry / 2, column = entry % 2;
        if (k < 0 || k >= edges) continue;
        double value = D[3 * j + m][entry];
        K[2 * (j + s) + row][2 * (k + s) + column] += value;
        K[2 * (j + s) + row][2 * k + column] -= value;
        K[2 * j + row][2 * (k + s) + column] -= value;
        K[2 * j + row][2 * k + column] += value;
      }
}

static double stiffness_error(double (*K)[2 * MOST], const double (*at)[2 * MOST], size_t n, size_t column, double h) {
  double most = 0;
  for (size_t row = 0; row < n; row++) {
    double of_row[4] = {at[0][row], at[1][row], at[2][row], at[3][row]};
    most = fmax(most, fabs(K[row][column] + difference(of_row, h)));
  }
  return most;
}

TESTS(test_stiffness_is_second_derivative, 0, 4) {
  const double h = 1e-3;
  size_t ribbons = (size_t)_i % 2 + 1, n = 2 * ribbons * NODES;
  static double K[2 * MOST][2 * MOST], at[4][2 * MOST], D[3 * PLACES][4];
  for (uint64_t seed = 1; seed <= 5; seed++) {
    Rod r;
    make_rod(&r, ribbons, _i / 2, seed);
    zp_rod_eval(&r.params, r.x, r.y, &r.eval);
    zp_rod_step(&r.params, &r.eval, &r.eval, 0, &r.forces);
    zp_rod_stiffness(&r.params, &r.eval, &r.eval, 0, &r.forces, r.eval.T, D);
    for (size_t j = 0; j < 3 * PLACES; j++)
      for (int entry = 0; entry < 4; entry++)
        D[j][entry] *= 2; /* both ends move */
    assemble(D, ribbons, K);
    for (size_t k = 0; k < n; k++) {
      double kept = *coordinate(&r, k);
      for (int m = 0; m < 4; m++) {
        *coordinate(&r, k) = kept + offsets[m] * h;
        rod_forces(&r, at[m]);
      }
      *coordinate(&r, k) = kept;
      ck_below(stiffness_error(K, at, n, k, h), 5e-9); /* 5.7e-10 measured */
      for (size_t m = 0; m < n; m++)
        ck_assert_double_eq_tol(K[m][k], K[k][m], 1e-12);
    }
    zp_free(r.memory);
  }
}

/* Forces and moments of a free rod add up to zero, ribbon by ribbon. */
TEST(test_free_rod_keeps_momentum) {
  for (uint64_t seed = 1; seed <= 5; seed++) {
    Rod r;
    make_rod(&r, 2, true, seed);
    double force[2 * MOST];
    rod_forces(&r, force);
    for (size_t ribbon = 0; ribbon < 2; ribbon++) {
      double sum[3] = {0}, size = 0;
      for (size_t j = ribbon; j < 2 * NODES; j += 2) {
        sum[0] += force[2 * j];
        sum[1] += force[2 * j + 1];
        sum[2] += r.x[j] * force[2 * j + 1] - r.y[j] * force[2 * j];
        size += fabs(force[2 * j]) + fabs(force[2 * j + 1]);
      }
      ck_assert_double_gt(size, 0.1);
      for (int k = 0; k < 3; k++)
        ck_below(fabs(sum[k]), 1e-13 * NODES * size);
    }
    zp_free(r.memory);
  }
}

/* A rod in its natural shape has no forces. */
TEST(test_natural_shape) {
  Rod r;
  make_rod(&r, 1, true, 7);
  double angle = 0.2, force[2 * MOST];
  for (size_t j = 0; j + 1 < PLACES; j++) {
    angle += j > 0 ? r.turn[j] : 0;
    r.x[j + 1] = r.x[j] + r.l[j] * cos(angle);
    r.y[j + 1] = r.y[j] + r.l[j] * sin(angle);
  }
  rod_forces(&r, force);
  for (size_t k = 0; k < 2 * NODES; k++)
    ck_below(fabs(force[k]), 1e-13);
  ck_below(energy_of(&r), 1e-25);
  zp_free(r.memory);
}

/* -- the mass-spring chain's stiffness ------------------------------------------------------------- */

typedef struct Chain {
  ZpMassSpringParams params;
  ZpMassSpringEval eval;
  Rod shape;
  void *memory;
} Chain;

static void make_chain(Chain *c, size_t ribbons, bool slopes, uint64_t seed) {
  make_rod(&c->shape, ribbons, false, seed);
  c->params = (ZpMassSpringParams){ribbons, NODES, PLACES, 1, 5, 2, slopes, slopes};
  ZpArena arena = {NULL, 0};
  zp_massspring_reserve(&c->params, &c->eval, &arena);
  c->memory = zp_calloc(1, arena.used);
  arena = (ZpArena){c->memory, 0};
  zp_massspring_reserve(&c->params, &c->eval, &arena);
}

static void chain_forces(Chain *c, double *force) {
  zp_massspring_eval(&c->params, c->shape.x, c->shape.y, &c->eval);
  gather(c->eval.Rx, c->eval.Ry, c->params.ribbons, force);
}

TESTS(test_chain_stiffness, 0, 4) {
  const double h = 1e-3;
  size_t ribbons = (size_t)_i % 2 + 1, n = 2 * ribbons * NODES;
  static double K[2 * MOST][2 * MOST], at[4][2 * MOST], D[3 * PLACES][4];
  for (uint64_t seed = 1; seed <= 5; seed++) {
    Chain c;
    make_chain(&c, ribbons, _i / 2, seed);
    zp_massspring_eval(&c.params, c.shape.x, c.shape.y, &c.eval);
    zp_massspring_stiffness(&c.params, &c.eval, c.eval.T, D);
    assemble(D, ribbons, K);
    for (size_t k = 0; k < n; k++) {
      double kept = *coordinate(&c.shape, k);
      for (int m = 0; m < 4; m++) {
        *coordinate(&c.shape, k) = kept + offsets[m] * h;
        chain_forces(&c, at[m]);
      }
      *coordinate(&c.shape, k) = kept;
      ck_below(stiffness_error(K, at, n, k, h), 1e-9); /* 1e-10 measured */
    }
    zp_free(c.memory);
    zp_free(c.shape.memory);
  }
}

/* -- band matrices --------------------------------------------------------------------------------- */

enum { EQUATIONS = 40 };

typedef double Dense[EQUATIONS][EQUATIONS];

/* Gauss with row pivoting: the solution in b; returns the determinant. */
static double eliminate(Dense a, double *b) {
  double determinant = 1;
  for (size_t k = 0; k < EQUATIONS; k++) {
    size_t p = k;
    for (size_t i = k; i < EQUATIONS; i++)
      if (fabs(a[i][k]) > fabs(a[p][k])) p = i;
    for (size_t j = 0; j < EQUATIONS; j++) {
      double kept = a[k][j];
      a[k][j] = a[p][j];
      a[p][j] = kept;
    }
    double kept = b[k];
    b[k] = b[p];
    b[p] = kept;
    determinant *= p == k ? a[k][k] : -a[k][k];
    for (size_t i = 0; i < EQUATIONS; i++) {
      double factor = i == k ? 0 : a[i][k] / a[k][k];
      for (size_t j = k; j < EQUATIONS; j++)
        a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (size_t k = 0; k < EQUATIONS; k++)
    b[k] /= a[k][k];
  return determinant;
}

/* A band of random numbers, as such and dense; symmetric with `shift` on the diagonal if asked. */
static void *random_band(ZpBand *band, Dense a, size_t lower, size_t upper, bool symmetric, double shift,
                         uint64_t seed) {
  ZpArena arena = {NULL, 0};
  zp_band_reserve(band, EQUATIONS, lower, upper, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_band_reserve(band, EQUATIONS, lower, upper, &arena);
  zp_band_clear(band);
  memset(a, 0, sizeof(Dense));
  for (size_t i = 0; i < EQUATIONS; i++)
    for (size_t j = 0; j < EQUATIONS; j++) {
      if (j + lower < i || i + upper < j) continue;
      a[i][j] = symmetric && j < i ? a[j][i] : noise(&seed) + (i == j ? shift : 0);
      *zp_band_at(band, i, j) = a[i][j];
    }
  return memory;
}

TEST(test_band_lu) {
  static const size_t diagonals[][2] = {{1, 1}, {5, 5}, {11, 11}, {2, 7}, {7, 2}, {EQUATIONS - 1, 3}};
  for (size_t c = 0; c < LENGTH_OF(diagonals); c++)
    for (uint64_t seed = 1; seed <= 10; seed++) {
      ZpBand band;
      Dense a;
      void *memory = random_band(&band, a, diagonals[c][0], diagonals[c][1], false, 0, seed);
      double b[EQUATIONS], expected[EQUATIONS], size = 0;
      for (size_t i = 0; i < EQUATIONS; i++)
        b[i] = expected[i] = sin(1 + (double)i);
      ck_assert(zp_band_factor(&band));
      zp_band_solve(&band, b);
      double determinant = eliminate(a, expected);
      ck_assert_uint_eq(zp_band_negative(&band), determinant < 0);
      for (size_t i = 0; i < EQUATIONS; i++)
        size = fmax(size, fabs(expected[i]));
      for (size_t i = 0; i < EQUATIONS; i++)
        ck_assert_double_eq_tol(b[i], expected[i], 5e-11 * size); /* condition up to 1e6; 5.2e-12 measured */
      zp_free(memory);
    }
}

/* LAPACK's banded LU, by its Fortran name. */
void dgbsv_(const int *n, const int *kl, const int *ku, const int *nrhs, double *ab, const int *ldab, int *ipiv,
            double *b, const int *ldb, int *info);

TEST(test_band_is_lapack) {
  enum { KL = 11, KU = 11, LD = 2 * KL + KU + 1 };
  static const int n = EQUATIONS, kl = KL, ku = KU, one = 1, ld = LD;
  for (uint64_t seed = 1; seed <= 10; seed++) {
    ZpBand band;
    Dense a;
    void *memory = random_band(&band, a, KL, KU, false, 0, seed);
    double ab[EQUATIONS * LD] = {0}, b[EQUATIONS], expected[EQUATIONS], size = 0;
    int pivots[EQUATIONS], info;
    for (size_t i = 0; i < EQUATIONS; i++) {
      b[i] = expected[i] = cos((double)i);
      for (size_t j = 0; j < EQUATIONS; j++)
        if (j + KL >= i && i + KU >= j) ab[j * LD + KL + KU + i - j] = a[i][j];
    }
    dgbsv_(&n, &kl, &ku, &one, ab, &ld, pivots, expected, &n, &info);
    ck_assert_int_eq(info, 0);
    ck_assert(zp_band_factor(&band));
    zp_band_solve(&band, b);
    for (size_t i = 0; i < EQUATIONS; i++)
      size = fmax(size, fabs(expected[i]));
    for (size_t i = 0; i < EQUATIONS; i++)
      /* the same pivots: rounding times the condition; 1.5e-15 measured */
      ck_assert_double_eq_tol(b[i], expected[i], 1e-12 * size);
    zp_free(memory);
  }
}

TEST(test_band_singular) {
  ZpBand band;
  Dense a;
  void *memory = random_band(&band, a, 2, 2, false, 0, 1);
  for (size_t i = 3; i <= 7; i++) /* a column of zeros */
    *zp_band_at(&band, i, 5) = 0;
  ck_assert(!zp_band_factor(&band));
  zp_band_clear(&band);
  *zp_band_at(&band, 0, 0) = NAN;
  ck_assert(!zp_band_factor(&band));
  zp_free(memory);
}

/* The upper triangle of the same matrix, alone. */
static void *upper_of(const ZpBand *band, ZpBand *half) {
  ZpArena arena = {NULL, 0};
  zp_band_reserve(half, band->n, 0, band->upper, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_band_reserve(half, band->n, 0, band->upper, &arena);
  zp_band_clear(half);
  for (size_t i = 0; i < band->n; i++)
    for (size_t j = i; j < band->n && j <= i + band->upper; j++)
      *zp_band_at(half, i, j) = *zp_band_at(band, i, j);
  return memory;
}

/* Definite matrices of either sign: without pivoting, the same solution. Measured: within 4e-16. */
TEST(test_band_symmetric) {
  static const size_t widths[] = {0, 1, 2, 3, 4, 5, 11, 23, 24, EQUATIONS - 1};
  double worst = 0;
  for (size_t c = 0; c < LENGTH_OF(widths); c++)
    for (uint64_t seed = 1; seed <= 20; seed++) {
      ZpBand band, half;
      Dense a;
      double shift = (seed % 2 ? 1.5 : -1.5) * (double)(widths[c] + 1), b[EQUATIONS], expected[EQUATIONS], size = 0;
      void *memory = random_band(&band, a, widths[c], widths[c], true, shift, seed), *other = upper_of(&band, &half);
      for (size_t i = 0; i < EQUATIONS; i++)
        b[i] = expected[i] = noise(&seed);
      ck_assert(zp_band_factor(&band) && zp_band_factor(&half));
      zp_band_solve(&band, expected);
      zp_band_solve(&half, b);
      for (size_t i = 0; i < EQUATIONS; i++)
        size = fmax(size, fabs(expected[i]));
      for (size_t i = 0; i < EQUATIONS; i++)
        worst = fmax(worst, fabs(b[i] - expected[i]) / size);
      zp_free(memory);
      zp_free(other);
    }
  printf("symmetric band: off by %.1e\n", worst);
  ck_below(worst, 1e-13);
}

/* One equation; a pivot of 0 or that is no number, also one that comes up on the way. */
TEST(test_band_symmetric_limits) {
  ZpBand one;
  double store[64] = {0}, b = 6;
  one = (ZpBand){.n = 1, .upper = 3, .stride = 8, .entries = 32, .a = store};
  *zp_band_at(&one, 0, 0) = -4;
  ck_assert(zp_band_factor(&one));
  zp_band_solve(&one, &b);
  ck_assert_double_eq(b, -1.5);
  *zp_band_at(&one, 0, 0) = 0;
  ck_assert(!zp_band_factor(&one));
  *zp_band_at(&one, 0, 0) = NAN;
  ck_assert(!zp_band_factor(&one));
  ZpBand two = {.n = 2, .upper = 1, .stride = 8, .entries = 32, .a = store};
  *zp_band_at(&two, 0, 0) = *zp_band_at(&two, 0, 1) = *zp_band_at(&two, 1, 1) = 2;
  ck_assert(!zp_band_factor(&two)); /* 2 - 2 * 2 / 2 */
}

/* A symmetric band with `rank` random terms u v' on top, and the same dense. If they are symmetric, v is u with a
 * random factor of either sign. */
static void *random_top(ZpBand *K, Dense a, size_t rank, bool symmetric, double shift, uint64_t seed) {
  ZpBand band;
  ZpArena arena = {NULL, 0};
  const ZpBandForm form = {.bandwidth = 4, .symmetric = true, .rank = rank};
  void *other = random_band(&band, a, 4, 4, true, shift, seed);
  zp_band_reserve_form(K, EQUATIONS, form, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_band_reserve_form(K, EQUATIONS, form, &arena);
  for (size_t i = 0; i < EQUATIONS; i++)
    for (size_t j = i; j < EQUATIONS && j <= i + 4; j++)
      *zp_band_at(K, i, j) = a[i][j];
  for (size_t k = 0; k < rank * EQUATIONS; k++)
    K->u[k] = noise(&seed), K->v[k] = noise(&seed);
  for (size_t k = 0; symmetric && k < rank * EQUATIONS; k += EQUATIONS) {
    const double factor = noise(&seed);
    for (size_t i = k; i < k + EQUATIONS; i++)
      K->v[i] = factor * K->u[i];
  }
  for (size_t k = 0; k < rank * EQUATIONS * EQUATIONS; k++) {
    size_t term = k / (EQUATIONS * EQUATIONS), i = k / EQUATIONS % EQUATIONS, j = k % EQUATIONS;
    a[i][j] += K->u[term * EQUATIONS + i] * K->v[term * EQUATIONS + j];
  }
  zp_free(other);
  return memory;
}

/* Low-rank terms on a band change solution, product and sign of the determinant as in the dense matrix; when cleared,
 * they have no effect. */
TEST(test_terms_on_top_of_a_band) {
  int seen[2] = {0};
  for (size_t rank = 0; rank <= 3; rank++)
    for (uint64_t seed = 1; seed <= 20; seed++) {
      ZpBand K;
      Dense a;
      void *memory = random_top(&K, a, rank, false, 6, seed);
      double b[EQUATIONS], expected[EQUATIONS], product[EQUATIONS];
      for (size_t i = 0; i < EQUATIONS; i++)
        b[i] = expected[i] = sin(1 + (double)i);
      zp_band_multiply(&K, b, product);
      for (size_t i = 0; i < EQUATIONS; i++)
        ck_near(product[i], zp_dot(EQUATIONS, a[i], b), 1e-12);
      ck_assert(zp_band_factor(&K));
      zp_band_solve(&K, b);
      bool negative = eliminate(a, expected) < 0;
      ck_assert_uint_eq(zp_band_negative(&K) % 2, negative);
      seen[negative] = 1;
      for (size_t i = 0; i < EQUATIONS; i++)
        ck_assert_double_eq_tol(b[i], expected[i], 1e-12); /* 5.6e-15 measured */
      zp_band_clear(&K);
      for (size_t i = 0; i < rank * EQUATIONS; i++)
        ck_assert(K.u[i] == 0 && K.v[i] == 0);
      zp_free(memory);
    }
  ck_assert(seen[0] && seen[1]);
}

/* A term that makes a definite matrix indefinite adds a negative eigenvalue, one that makes up for one takes it away.
 */
TEST(test_negative_eigenvalues_with_a_term) {
  static const double weights[][3] = {{-3, 1, 1}, {-0.5, 1, 0}, {3, -1, 0}, {0.5, -1, 1}}; /* u v, first pivot, which */
  for (size_t c = 0; c < LENGTH_OF(weights); c++) {
    ZpBand K;
    double a[32] = {weights[c][1], 0, 0, 0, 0, 0, 0, 0, 0, 1}, u[2] = {weights[c][0], 0}, v[2] = {1, 0}, w[4], s[1];
    K = (ZpBand){.n = 2, .stride = 8, .entries = 32, .a = a, .rank = 1, .u = u, .v = v, .w = w, .s = s};
    ck_assert(zp_band_factor(&K));
    ck_assert_uint_eq(zp_band_negative(&K), (size_t)weights[c][2]);
  }
}

/* Several symmetric terms of either sign on bands that are definite or not: as many negative eigenvalues as the dense
 * matrix has. */
TEST(test_negative_eigenvalues_with_several_terms) {
  static const double shifts[] = {-6, 0.5, 6};
  static Dense vectors;
  int seen[EQUATIONS + 1] = {0};
  for (size_t c = 0; c < 3 * LENGTH_OF(shifts); c++)
    for (uint64_t seed = 1; seed <= 20; seed++) {
      ZpBand K;
      Dense a;
      size_t negative = 0, rank = 1 + c / LENGTH_OF(shifts) * 2;
      void *memory = random_top(&K, a, rank, true, shifts[c % LENGTH_OF(shifts)], seed);
      zp_eigen_symmetric(EQUATIONS, &a[0][0], &vectors[0][0]);
      for (size_t i = 0; i < EQUATIONS; i++)
        negative += a[i][i] < 0;
      ck_assert(zp_band_factor(&K));
      ck_assert_uint_eq(zp_band_negative(&K), negative);
      seen[negative] = 1;
      zp_free(memory);
    }
  ck_assert(seen[0] && seen[1] && seen[2] && seen[3]);
}

/* Two parts without a common unknown, each with a term u v' that is not symmetric. Each part has a negative
 * eigenvalue. */
TEST(test_negative_eigenvalues_of_two_parts) {
  double a[32] = {0}, u[8] = {-3, -1, 0, 0, 0, 0, -5, 0.5}, v[8] = {1, 0.2, 0, 0, 0, 0, 1, -0.3}, w[12], s[2];
  ZpBand K = {.n = 4, .upper = 3, .stride = 8, .entries = 32, .a = a, .rank = 2, .u = u, .v = v, .w = w, .s = s};
  for (size_t i = 0; i < 4; i++)
    *zp_band_at(&K, i, i) = 1 + (double)(i % 2);
  double dense[16] = {0}, work[4];
  ZpEigenvalue value[4];
  for (size_t i = 0; i < 4; i++) {
    dense[5 * i] = 1 + (double)(i % 2);
    for (size_t j = 0; j < 4; j++)
      dense[4 * i + j] += u[i] * v[j] + u[4 + i] * v[4 + j];
  }
  ck_assert(zp_eigenvalues(4, dense, work, value));
  size_t negative = 0;
  for (size_t i = 0; i < 4; i++)
    negative += value[i].re < 0 && value[i].im == 0;
  ck_assert_uint_eq(negative, 2);
  ck_assert(zp_band_factor(&K));
  ck_assert_uint_eq(zp_band_negative(&K), negative);
}

/* Sylvester: the number of negative pivots is that of negative eigenvalues; elimination with and without pivoting
 * solves equally well. */
TEST(test_negative_pivots) {
  static const double shifts[] = {-20, -1, 0, 0.5, 2, 20};
  static Dense v;
  int seen[EQUATIONS + 1] = {0};
  double worst = 0;
  for (size_t c = 0; c < LENGTH_OF(shifts); c++)
    for (uint64_t seed = 1; seed <= 5; seed++) {
      ZpBand band, half;
      Dense a;
      void *memory = random_band(&band, a, 4, 4, true, shifts[c], seed), *other = upper_of(&band, &half);
      double b[EQUATIONS], expected[EQUATIONS], size = 0;
      size_t eigenvalues = 0;
      for (size_t i = 0; i < EQUATIONS; i++)
        b[i] = expected[i] = noise(&seed);
      ck_assert(zp_band_factor(&half) && zp_band_factor(&band));
      zp_band_solve(&half, b);
      zp_band_solve(&band, expected);
      for (size_t i = 0; i < EQUATIONS; i++)
        size = fmax(size, fabs(expected[i]));
      for (size_t i = 0; i < EQUATIONS; i++)
        worst = fmax(worst, fabs(b[i] - expected[i]) / size);
      zp_eigen_symmetric(EQUATIONS, &a[0][0], &v[0][0]);
      for (size_t i = 0; i < EQUATIONS; i++)
        eigenvalues += a[i][i] < 0;
      ck_assert_uint_eq(zp_band_negative(&half), eigenvalues);
      seen[eigenvalues] = 1;
      zp_free(memory);
      zp_free(other);
    }
  ck_assert(seen[0] && seen[EQUATIONS]);
  printf("indefinite band without pivoting: off by %.1e\n", worst);
  ck_below(worst, 1e-12); /* 9.3e-14 measured */
}

/* -- eigenvalues ----------------------------------------------------------------------------------- */

/* 2 on the diagonal and -1 beside it: 2 - 2 cos(k pi / (n + 1)), vectors sin(i k pi / (n + 1)). */
TEST(test_eigen_chain) {
  Dense a = {{0}};
  static Dense v;
  for (size_t i = 0; i < EQUATIONS; i++) {
    a[i][i] = 2;
    if (i > 0) a[i][i - 1] = a[i - 1][i] = -1;
  }
  zp_eigen_symmetric(EQUATIONS, &a[0][0], &v[0][0]);
  for (size_t k = 0; k < EQUATIONS; k++) {
    double angle = M_PI * (double)(k + 1) / (EQUATIONS + 1), scale = sqrt(2.0 / (EQUATIONS + 1));
    ck_assert_double_eq_tol(a[k][k], 2 - 2 * cos(angle), 1e-13);
    double sign = v[0][k] < 0 ? -1 : 1;
    for (size_t i = 0; i < EQUATIONS; i++)
      ck_assert_double_eq_tol(sign * v[i][k], scale * sin((double)(i + 1) * angle), 1e-12);
  }
}

/* Equal eigenvalues, and one row. */
TEST(test_eigen_limits) {
  double same[9] = {2, 1, 1, 1, 2, 1, 1, 1, 2}, v[9], one = -3, w;
  zp_eigen_symmetric(3, same, v);
  ck_assert_double_eq_tol(same[0], 1, 1e-14);
  ck_assert_double_eq_tol(same[4], 1, 1e-14);
  ck_assert_double_eq_tol(same[8], 4, 1e-14);
  for (size_t i = 0; i < 3; i++)
    for (size_t j = 0; j < 3; j++)
      ck_assert_double_eq_tol(v[i] * v[j] + v[3 + i] * v[3 + j] + v[6 + i] * v[6 + j], i == j, 1e-14);
  zp_eigen_symmetric(1, &one, &w);
  ck_assert_double_eq(one, -3);
  ck_assert_double_eq(w, 1);
}
