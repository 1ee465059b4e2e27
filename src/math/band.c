#include "math/band.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "math/vector.h"

static void reserve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpBandGroups groups, ZpArena *arena) {
  bool symmetric = lower == 0;
  size_t blocks = (groups.lead + n + ZP_BAND_BLOCK - 1) / ZP_BAND_BLOCK;
  *band = (ZpBand){.n = n, .lower = lower, .upper = upper, .lead = symmetric ? groups.lead : 0};
  /* Groups must be blocks, or else rows have room for all diagonals wherever their block begins. */
  size_t reach = groups.reach > 0 ? groups.reach : upper / ZP_BAND_BLOCK + 2;
  band->stride = symmetric ? reach * ZP_BAND_BLOCK : 2 * lower + upper + 1;
  band->entries = (symmetric ? blocks * ZP_BAND_BLOCK : n) * band->stride;
  band->a = zp_arena_take(arena, band->entries);
  band->pivot = symmetric ? NULL : zp_arena_take_of(arena, n, sizeof *band->pivot);
}

void zp_band_reserve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpArena *arena) {
  reserve(band, n, lower, upper, (ZpBandGroups){0, 0}, arena);
}

void zp_band_reserve_form(ZpBand *band, size_t n, ZpBandForm form, ZpArena *arena) {
  reserve(band, n, form.symmetric ? 0 : form.bandwidth, form.bandwidth, form.groups, arena);
  band->rank = form.rank;
  band->border = form.border;
  band->beside = zp_arena_take(arena, form.border * n);
  band->corner = zp_arena_take(arena, form.border * form.border);
  band->u = zp_arena_take(arena, form.rank * (n + form.border));
  band->v = zp_arena_take(arena, form.rank * (n + form.border));
  band->w = zp_arena_take(arena, form.rank ? (form.rank + 1) * n : 0);
  band->s = zp_arena_take(arena, form.rank);
}

void zp_band_clear(ZpBand *band) {
  size_t terms = band->rank * (band->n + band->border);
  memset(band->a + band->lead * band->stride, 0, band->n * band->stride * sizeof *band->a);
  if (terms == 0) return;
  memset(band->u, 0, terms * sizeof *band->u);
  memset(band->v, 0, terms * sizeof *band->v);
}

static size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

/* -- general: LU ----------------------------------------------------------------------------------- */

/* Row of the largest entry of column k among rows k .. last. */
static size_t pivot_row(const ZpBand *band, size_t k, size_t last) {
  size_t best = k;
  double largest = fabs(*zp_band_at(band, k, k));
  for (size_t i = k + 1; i <= last; i++) {
    double size = fabs(*zp_band_at(band, i, k));
    if (size > largest) {
      largest = size;
      best = i;
    }
  }
  return best;
}

static bool factor_lu(ZpBand *band) {
  size_t n = band->n;
  band->odd = false;
  for (size_t k = 0; k < n; k++) {
    size_t last_row = least(k + band->lower, n - 1), last_column = least(k + band->lower + band->upper, n - 1);
    size_t width = last_column - k + 1, p = pivot_row(band, k, last_row);
    double *row_k = zp_band_at(band, k, k);
    band->pivot[k] = p;
    if (p != k) {
      double *row_p = zp_band_at(band, p, k);
      for (size_t j = 0; j < width; j++) {
        double kept = row_k[j];
        row_k[j] = row_p[j];
        row_p[j] = kept;
      }
      band->odd = !band->odd;
    }
    if (row_k[0] == 0 || !isfinite(row_k[0])) return false;
    double inverse = 1 / row_k[0];
    for (size_t i = k + 1; i <= last_row; i++) {
      double *row_i = zp_band_at(band, i, k), factor = row_i[0] * inverse;
      row_i[0] = factor;
      if (factor == 0) continue;
      for (size_t j = 1; j < width; j++)
        row_i[j] -= factor * row_k[j];
    }
  }
  return true;
}

static void solve_lu(const ZpBand *band, double *b) {
  size_t n = band->n;
  for (size_t k = 0; k < n; k++) {
    size_t p = band->pivot[k], last_row = least(k + band->lower, n - 1);
    double value = b[p];
    b[p] = b[k];
    b[k] = value;
    for (size_t i = k + 1; i <= last_row; i++)
      b[i] -= *zp_band_at(band, i, k) * value;
  }
  for (size_t k = n; k-- > 0;) {
    size_t last_column = least(k + band->lower + band->upper, n - 1);
    const double *row = zp_band_at(band, k, k);
    double sum = b[k];
    for (size_t j = 1; j <= last_column - k; j++)
      sum -= row[j] * b[k + j];
    b[k] = sum / row[0];
  }
}

/* -- symmetric: block by block --------------------------------------------------------------------- */

/* With the block rows (A X) of four equations each, A the diagonal block when its turn comes: the matrix is L A L',
 * where L' has unit blocks on its diagonal and A^-1 X beside them. A itself is U' D U. Kept are U, with D on its
 * diagonal, and A^-1 X. */

static bool is_pivot(double value) {
  return value != 0 && isfinite(value);
}

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi" /* no call passes a vector: all functions that have one are inlined */
#endif

/* Four columns of a row, or four values of a vector, at any address of a double. */
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long FourPlaces __attribute__((vector_size(32)));

/* Of both, eight values, those at four places. */
#if defined(__clang__)
#define SHUFFLE(one, other, a, b, c, d) __builtin_shufflevector(one, other, a, b, c, d)
#else
#define SHUFFLE(one, other, a, b, c, d) __builtin_shuffle(one, other, (FourPlaces){a, b, c, d})
#endif

/* Of a row, in blocks. */
enum { BLOCKS_MOST = ZP_BAND_MOST / ZP_BAND_BLOCK + 2 };

/* A block row. */
typedef Four Row[4][BLOCKS_MOST];

/* Eliminate within a block row r: its rows scaled to their pivots => f. */
ZP_INLINE bool eliminate_within(size_t blocks, Row r, Row f) {
  for (size_t p = 0; p < 4; p++) {
    const double pivot = r[p][0][p];
    if (!is_pivot(pivot)) return false;
    const double inverse = 1 / pivot;
    for (size_t m = 0; m < blocks; m++)
      f[p][m] = r[p][m] * inverse;
    for (size_t i = p + 1; i < 4; i++)
      for (size_t m = 0; m < blocks; m++)
        r[i][m] -= f[p][0][i] * r[p][m];
  }
  return true;
}

/* U and D => the diagonal block; A^-1 X, by the scaled rows f, => the blocks beside it. */
ZP_INLINE void keep_factors(Four *restrict a, size_t blocks, Row r, Row f) {
  for (size_t p = 0; p < 4; p++) {
    a[p * blocks] = f[p][0];
    a[p * blocks][p] = r[p][0][p];
  }
  for (size_t m = 1; m < blocks; m++) {
    Four x3 = f[3][m], x2 = f[2][m] - f[2][0][3] * x3;
    Four x1 = (f[1][m] - f[1][0][3] * x3) - f[1][0][2] * x2;
    a[m] = ((f[0][m] - f[0][0][3] * x3) - f[0][0][2] * x2) - f[0][0][1] * x1;
    a[blocks + m] = x1;
    a[2 * blocks + m] = x2;
    a[3 * blocks + m] = x3;
  }
}

/* Factor a block row, and take it off those of the `below` blocks that it meets. */
ZP_INLINE bool eliminate(Four *restrict a, size_t blocks, size_t below) {
  Row r, f;
  for (size_t p = 0; p < 4; p++)
    for (size_t m = 0; m < blocks; m++)
      r[p][m] = a[p * blocks + m];
  if (!eliminate_within(blocks, r, f)) return false;
  keep_factors(a, blocks, r, f);
  for (size_t m = 1; m <= below; m++)
    for (size_t i = 0; i < 4; i++) {
      Four *restrict row = a + (4 * m + i) * blocks;
      const double f0 = f[0][m][i], f1 = f[1][m][i], f2 = f[2][m][i], f3 = f[3][m][i];
      for (size_t j = 0; j < blocks - m; j++)
        row[j] = (((row[j] - f0 * r[0][m + j]) - f1 * r[1][m + j]) - f2 * r[2][m + j]) - f3 * r[3][m + j];
    }
  return true;
}

static size_t block_rows(const ZpBand *band) {
  return band->entries / (band->stride * ZP_BAND_BLOCK);
}

ZP_INLINE bool factor_blocks(const ZpBand *band, size_t blocks) {
  const size_t rows = block_rows(band);
  Four *a = (Four *)band->a;
  for (size_t k = 0; k < rows; k++, a += 4 * blocks)
    if (!eliminate(a, blocks, k + blocks <= rows ? blocks - 1 : rows - 1 - k)) return false;
  return true;
}

static void fill_row(const ZpBand *band, size_t place) {
  double *row = band->a + place * band->stride;
  memset(row, 0, band->stride * sizeof *row);
  row[place % ZP_BAND_BLOCK] = 1;
}

/* Rows that only fill the first and the last block are those of a unit matrix. */
static void fill_blocks(const ZpBand *band) {
  size_t end = band->entries / band->stride;
  for (size_t place = 0; place < band->lead; place++)
    fill_row(band, place);
  for (size_t place = band->lead + band->n; place < end; place++)
    fill_row(band, place);
}

/* The four values of block k; 0 where rows only fill it. */
ZP_INLINE Four get(const ZpBand *band, const double *b, size_t k) {
  size_t place = k * ZP_BAND_BLOCK, end = band->lead + band->n;
  if (place >= band->lead && place + 4 <= end) return *(const Four *)(b + (place - band->lead));
  Four values = {0};
  for (size_t i = 0; i < 4; i++)
    if (place + i >= band->lead && place + i < end) values[i] = b[place + i - band->lead];
  return values;
}

ZP_INLINE void put(const ZpBand *band, Four values, double *b, size_t k) {
  size_t place = k * ZP_BAND_BLOCK, end = band->lead + band->n;
  if (place >= band->lead && place + 4 <= end) {
    *(Four *)(b + (place - band->lead)) = values;
    return;
  }
  for (size_t i = 0; i < 4; i++)
    if (place + i >= band->lead && place + i < end) b[place + i - band->lead] = values[i];
}

/* x' times a block. */
ZP_INLINE Four through(Four x, const Four *block, size_t blocks) {
  return (x[0] * block[0] + x[1] * block[blocks]) + (x[2] * block[2 * blocks] + x[3] * block[3 * blocks]);
}

/* The sum of each of four. */
ZP_INLINE Four sums(const Four of[4]) {
  Four first = SHUFFLE(of[0], of[1], 0, 4, 2, 6) + SHUFFLE(of[0], of[1], 1, 5, 3, 7);
  Four second = SHUFFLE(of[2], of[3], 0, 4, 2, 6) + SHUFFLE(of[2], of[3], 1, 5, 3, 7);
  return SHUFFLE(first, second, 0, 1, 4, 5) + SHUFFLE(first, second, 2, 3, 6, 7);
}

/* A^-1 b of a diagonal block. */
ZP_INLINE Four solve_within(const Four *a, size_t blocks, Four b) {
  const Four u0 = a[0], u1 = a[blocks], u2 = a[2 * blocks], u3 = a[3 * blocks];
  double x0 = b[0], x1 = b[1] - u0[1] * x0, x2 = (b[2] - u0[2] * x0) - u1[2] * x1,
         x3 = ((b[3] - u0[3] * x0) - u1[3] * x1) - u2[3] * x2;
  x3 /= u3[3];
  x2 = x2 / u2[2] - u2[3] * x3;
  x1 = (x1 / u1[1] - u1[3] * x3) - u1[2] * x2;
  x0 = ((x0 / u0[0] - u0[3] * x3) - u0[2] * x2) - u0[1] * x1;
  return (Four){x0, x1, x2, x3};
}

/* L A z = b: what is left of the next blocks waits in `ahead`. */
ZP_INLINE void solve_down(const ZpBand *band, size_t blocks, double *b) {
  const size_t rows = block_rows(band);
  const Four *a = (const Four *)band->a;
  Four ahead[BLOCKS_MOST];
  for (size_t m = 0; m + 1 < blocks; m++)
    ahead[m] = m < rows ? get(band, b, m) : (Four){0};
  for (size_t k = 0; k < rows; k++, a += 4 * blocks) {
    const Four left = ahead[0];
    for (size_t m = 1; m + 1 < blocks; m++)
      ahead[m - 1] = ahead[m] - through(left, a + m, blocks);
    const Four next = k + blocks - 1 < rows ? get(band, b, k + blocks - 1) : (Four){0};
    ahead[blocks - 2] = next - through(left, a + blocks - 1, blocks);
    put(band, solve_within(a, blocks, left), b, k);
  }
}

/* L' x = z: the blocks that follow are `behind`, the nearest one first. */
ZP_INLINE void solve_up(const ZpBand *band, size_t blocks, double *b) {
  Four behind[BLOCKS_MOST];
  for (size_t m = 0; m < blocks; m++)
    behind[m] = (Four){0};
  for (size_t k = block_rows(band); k-- > 0;) {
    const Four *a = (const Four *)band->a + 4 * k * blocks;
    Four products[4];
    for (size_t p = 0; p < 4; p++) {
      products[p] = a[p * blocks + blocks - 1] * behind[blocks - 2];
      for (size_t m = blocks - 2; m >= 1; m--)
        products[p] += a[p * blocks + m] * behind[m - 1];
    }
    const Four x = get(band, b, k) - sums(products);
    for (size_t m = blocks - 2; m >= 1; m--)
      behind[m] = behind[m - 1];
    behind[0] = x;
    put(band, x, b, k);
  }
}

ZP_INLINE void solve_blocks(const ZpBand *band, size_t blocks, double *b) {
  solve_down(band, blocks, b);
  solve_up(band, blocks, b);
}

/* Each entry beside the diagonal counts twice: y, which starts at 0, gets its own row and what it is in the column of.
 */
ZP_INLINE void multiply_row(const double *restrict row, size_t width, const double *x, double *restrict y) {
  double sum[4] = {row[0] * x[0]}, first = x[0];
  for (size_t j = 1; j < width; j++)
    sum[j % 4] += row[j] * x[j];
  y[0] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
  ZP_SIMD
  for (size_t j = 1; j < width; j++)
    y[j] += row[j] * first;
}

ZP_INLINE void multiply_rows(const ZpBand *band, size_t width, const double *x, double *y) {
  size_t n = band->n;
  memset(y, 0, n * sizeof *y);
  for (size_t i = 0; i < n; i++) {
    size_t c = (i + band->lead) % ZP_BAND_BLOCK;
    multiply_row(zp_band_row(band, i), least(width - c, n - i), x + i, y + i);
  }
}

/* The blocks of rows of one ribbon, of two, and of two with a film are compiled on their own. */
enum { ONE_RIBBON = 2, TWO_RIBBONS = 3, WITH_FILM = 5 };

static size_t blocks_of(const ZpBand *band) {
  return band->stride / ZP_BAND_BLOCK;
}

ZP_KERNEL static bool factor_symmetric(const ZpBand *band) {
  fill_blocks(band);
  if (blocks_of(band) == TWO_RIBBONS) return factor_blocks(band, TWO_RIBBONS);
  if (blocks_of(band) == ONE_RIBBON) return factor_blocks(band, ONE_RIBBON);
  if (blocks_of(band) == WITH_FILM) return factor_blocks(band, WITH_FILM);
  return factor_blocks(band, blocks_of(band));
}

ZP_KERNEL static void solve_symmetric(const ZpBand *band, double *b) {
  if (blocks_of(band) == TWO_RIBBONS)
    solve_blocks(band, TWO_RIBBONS, b);
  else if (blocks_of(band) == ONE_RIBBON)
    solve_blocks(band, ONE_RIBBON, b);
  else if (blocks_of(band) == WITH_FILM)
    solve_blocks(band, WITH_FILM, b);
  else
    solve_blocks(band, blocks_of(band), b);
}

ZP_KERNEL static void multiply_symmetric(const ZpBand *band, const double *x, double *y) {
  if (blocks_of(band) == TWO_RIBBONS)
    multiply_rows(band, (size_t)TWO_RIBBONS * ZP_BAND_BLOCK, x, y);
  else
    multiply_rows(band, band->stride, x, y);
}

/* -- what is on top: Sherman and Morrison's formula, term by term ------------------------------------ */

/* b is solved with the band and `terms` terms on top of it, if it was with the band. */
static void solve_top(const ZpBand *band, size_t terms, double *b) {
  size_t n = band->n;
  for (size_t k = 0; k < terms; k++) {
    double part = zp_dot(n, zp_band_term(band, band->v, k), b) / band->s[k];
    for (size_t i = 0; i < n; i++)
      b[i] -= band->w[k * n + i] * part;
  }
}

static void solve_band(const ZpBand *band, double *b) {
  if (band->lower == 0)
    solve_symmetric(band, b);
  else
    solve_lu(band, b);
}

static bool factor_top(ZpBand *band) {
  size_t n = band->n;
  for (size_t k = 0; k < band->rank; k++) {
    double *w = band->w + k * n;
    memcpy(w, zp_band_term(band, band->u, k), n * sizeof *w);
    solve_band(band, w);
    solve_top(band, k, w);
    band->s[k] = 1 + zp_dot(n, zp_band_term(band, band->v, k), w);
    if (!is_pivot(band->s[k])) return false;
  }
  return true;
}

/* -- either ----------------------------------------------------------------------------------------- */

bool zp_band_factor(ZpBand *band) {
  return (band->lower == 0 ? factor_symmetric(band) : factor_lu(band)) && factor_top(band);
}

void zp_band_solve(const ZpBand *band, double *b) {
  solve_band(band, b);
  solve_top(band, band->rank, b);
}

static void multiply_general(const ZpBand *band, const double *x, double *y) {
  size_t n = band->n;
  for (size_t i = 0; i < n; i++) {
    size_t last = least(i + band->upper, n - 1);
    y[i] = 0;
    for (size_t j = i - least(i, band->lower); j <= last; j++)
      y[i] += *zp_band_at(band, i, j) * x[j];
  }
}

void zp_band_multiply(const ZpBand *band, const double *x, double *y) {
  size_t n = band->n;
  if (band->lower == 0)
    multiply_symmetric(band, x, y);
  else
    multiply_general(band, x, y);
  for (size_t k = 0; k < band->rank; k++) {
    const double *u = zp_band_term(band, band->u, k);
    double part = zp_dot(n, zp_band_term(band, band->v, k), x);
    for (size_t i = 0; i < n; i++)
      y[i] += u[i] * part;
  }
}

/* Prescribe an unknown of the terms on top of the band. */
static void prescribe_top(ZpBand *band, size_t unknown, double move, double *r, double *row) {
  size_t n = band->n;
  for (size_t k = 0; k < band->rank; k++) {
    double *u = zp_band_term(band, band->u, k), *v = zp_band_term(band, band->v, k), factor = u[unknown];
    for (size_t i = 0; i < n; i++)
      row[i] += factor * v[i];
    u[unknown] = 0;
    for (size_t i = 0; r && i < n; i++)
      r[i] -= u[i] * v[unknown] * move;
    v[unknown] = 0;
  }
}

void zp_band_prescribe(ZpBand *band, size_t unknown, double diagonal, double move, double *r, double *row) {
  size_t first = unknown - least(unknown, band->upper), end = zp_band_end(band, unknown);
  memset(row, 0, band->n * sizeof *row);
  prescribe_top(band, unknown, move, r, row);
  for (size_t i = first; i < end; i++) {
    if (i == unknown || zp_band_end(band, i) <= unknown) continue;
    bool kept = band->lower > 0 || i < unknown; /* only the upper triangle of a symmetric matrix is stored */
    double *in_column = kept ? zp_band_at(band, i, unknown) : zp_band_at(band, unknown, i);
    double *in_row = band->lower > 0 ? zp_band_at(band, unknown, i) : in_column;
    if (r) r[i] -= *in_column * move;
    row[i] += *in_row;
    *in_column = *in_row = 0;
  }
  row[unknown] += *zp_band_at(band, unknown, unknown);
  *zp_band_at(band, unknown, unknown) = diagonal;
}

static size_t negative_pivots(const ZpBand *band) {
  size_t negative = 0;
  for (size_t i = 0; i < band->n; i++)
    negative += *zp_band_at(band, i, i) < 0;
  return negative;
}

/* While term k grows from 0 to its size, an eigenvalue passes 0 where 1 + v' w does. With B, the matrix before, its
 * vectors there are w = B^-1 u and B^-T v, so its rate has the sign of v' B^-2 u. Does it rise? */
static bool raises_eigenvalue(const ZpBand *band, size_t k) {
  size_t n = band->n;
  double *twice = band->w + band->rank * n;
  memcpy(twice, band->w + k * n, n * sizeof *twice);
  solve_band(band, twice);
  solve_top(band, k, twice);
  return zp_dot(n, zp_band_term(band, band->v, k), twice) > 0;
}

static bool has_negative_determinant(const ZpBand *band) {
  size_t changes = negative_pivots(band) + band->odd;
  for (size_t k = 0; k < band->rank; k++)
    changes += band->s[k] < 0;
  return changes % 2 == 1;
}

size_t zp_band_negative(const ZpBand *band) {
  if (band->lower > 0) return has_negative_determinant(band);
  size_t negative = negative_pivots(band);
  for (size_t k = 0; k < band->rank; k++)
    if (band->s[k] < 0) negative = negative > 0 && raises_eigenvalue(band, k) ? negative - 1 : negative + 1;
  return negative;
}
