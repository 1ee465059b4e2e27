#include "math/band.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "math/vector.h"

void zp_band_carve(ZpBand *band, size_t n, size_t lower, size_t upper, ZpCarver *carver) {
  band->n = n;
  band->lower = lower;
  band->upper = upper;
  band->stride = 2 * lower + upper + 1;
  band->a = zp_carve(carver, n * band->stride);
  band->pivot = lower > 0 ? (size_t *)(void *)zp_carve(carver, n) : NULL; /* a size_t is no larger than a double */
  band->rank = 0;
}

void zp_band_carve_form(ZpBand *band, size_t n, ZpBandForm form, ZpCarver *carver) {
  zp_band_carve(band, n, form.symmetric ? 0 : form.bandwidth, form.bandwidth, carver);
  band->rank = form.rank;
  band->u = zp_carve(carver, form.rank * n);
  band->v = zp_carve(carver, form.rank * n);
  band->w = zp_carve(carver, form.rank * n);
  band->s = zp_carve(carver, form.rank);
}

void zp_band_clear(ZpBand *band) {
  size_t terms = band->rank * band->n;
  memset(band->a, 0, band->n * band->stride * sizeof(double));
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

/* -- symmetric: U' D U, row by row ----------------------------------------------------------------- */

static bool is_pivot(double value) {
  return value != 0 && isfinite(value);
}

/* What row k, scaled to its pivot, takes off the `below` rows that it meets; a copy of it with zeros behind makes all
 * these loops as long as a row. */
ZP_INLINE bool eliminate(double *restrict row_k, size_t width, size_t below) {
  double r[2 * (ZP_BAND_MOST + 1)] = {0};
  if (!is_pivot(row_k[0])) return false;
  double inverse = 1 / row_k[0];
  memcpy(r, row_k, width * sizeof *r);
  for (size_t i = 1; i <= below; i++) {
    double factor = r[i] * inverse, *restrict row_i = row_k + i * width;
    ZP_SIMD
    for (size_t j = 0; j < width; j++)
      row_i[j] -= factor * r[i + j];
    row_k[i] = factor;
  }
  return true;
}

/* A row, and zeros behind it. */
typedef double Padded[2 * (ZP_BAND_MOST + 1)];

/* What four rows, r before they were scaled to their pivots, take off group `group` of the rows below: those which have
 * so many columns in common with them that they take the same number of vectors of four. */
ZP_INLINE void take_from_group(const Padded r[4], double *restrict row_k, size_t width, size_t group) {
  size_t vectors = (width + 3) / 4;
  if (group >= vectors) return;
  size_t reach = 4 * (vectors - group), end = width + 7 - reach, begin = group == 0 ? 4 : end - 4;
  if (reach > width) reach = width;
  for (size_t i = begin; i < end; i++) {
    double *restrict row_i = row_k + i * width, f[4];
    for (size_t p = 0; p < 4; p++)
      f[p] = i - p < width ? row_k[p * width + i - p] : 0;
    ZP_SIMD
    for (size_t j = 0; j < reach; j++)
      row_i[j] = (((row_i[j] - f[0] * r[0][i + j]) - f[1] * r[1][i - 1 + j]) - f[2] * r[2][i - 2 + j]) -
                 f[3] * r[3][i - 3 + j];
  }
}

/* The same of rows k .. k + 3 at once, so that each row below is loaded and stored once for all four. */
ZP_INLINE bool eliminate_four(double *restrict row_k, size_t width) {
  Padded r[4];
  for (size_t p = 0; p < 4; p++) {
    double *restrict row_p = row_k + p * width;
    if (!is_pivot(row_p[0])) return false;
    double inverse = 1 / row_p[0];
    ZP_SIMD
    for (size_t j = 0; j < width; j++) {
      r[p][j] = row_p[j];
      r[p][width + j] = 0;
    }
    ZP_SIMD
    for (size_t j = 1; j < width; j++)
      row_p[j] *= inverse;
    for (size_t i = 1; i < 4 - p; i++) {
      double factor = row_p[i], *restrict row_i = row_p + i * width;
      ZP_SIMD
      for (size_t j = 0; j < width; j++)
        row_i[j] -= factor * r[p][i + j];
    }
  }
  take_from_group(r, row_k, width, 0);
  take_from_group(r, row_k, width, 1);
  take_from_group(r, row_k, width, 2);
  take_from_group(r, row_k, width, 3);
  take_from_group(r, row_k, width, 4);
  take_from_group(r, row_k, width, 5);
  return true;
}

ZP_INLINE bool factor_rows(ZpBand *band, size_t width) {
  size_t n = band->n, k = 0;
  for (; width > 3 && k + width + 3 <= n; k += 4)
    if (!eliminate_four(band->a + k * width, width)) return false;
  for (; k < n; k++)
    if (!eliminate(band->a + k * width, width, least(width - 1, n - 1 - k))) return false;
  return true;
}

/* The same of rows of any width: nothing is copied, so that a row is scaled last. */
static bool eliminate_wide(double *restrict row_k, size_t width, size_t below) {
  if (!is_pivot(row_k[0])) return false;
  double inverse = 1 / row_k[0];
  for (size_t i = 1; i <= below; i++) {
    double factor = row_k[i] * inverse, *restrict row_i = row_k + i * width;
    ZP_SIMD
    for (size_t j = 0; j < width - i; j++)
      row_i[j] -= factor * row_k[i + j];
  }
  for (size_t i = 1; i <= below; i++)
    row_k[i] *= inverse;
  return true;
}

static bool factor_wide(ZpBand *band) {
  size_t n = band->n, width = band->stride;
  for (size_t k = 0; k < n; k++)
    if (!eliminate_wide(band->a + k * width, width, least(width - 1, n - 1 - k))) return false;
  return true;
}

/* What `count` entries, `stride` apart, take off *b with the values `step` apart: in four sums, whatever the processor;
 * the nearest value, found last, comes last, as the next row waits for it. */
ZP_INLINE void substitute(const double *entry, ptrdiff_t stride, size_t count, ptrdiff_t step, double *b) {
  double sum[4] = {0};
  for (size_t i = 3; i <= count; i++)
    sum[i % 4] += entry[(ptrdiff_t)i * stride] * b[(ptrdiff_t)i * step];
  double known = *b - ((sum[0] + sum[1]) + (sum[2] + sum[3]));
  if (count >= 2) known -= entry[2 * stride] * b[2 * step];
  if (count >= 1) known -= entry[stride] * b[step];
  *b = known;
}

/* U' y = b, y / D, U x = y. */
ZP_INLINE void solve_rows(const ZpBand *band, size_t width, double *b) {
  const double *a = band->a;
  size_t n = band->n, most = width - 1, ends = least(most, n);
  ptrdiff_t column = 1 - (ptrdiff_t)width; /* from an entry to that above it */
  for (size_t k = 0; k < ends; k++)
    substitute(a + k * width, column, k, -1, b + k);
  for (size_t k = ends; k < n; k++)
    substitute(a + k * width, column, most, -1, b + k);
  for (size_t k = 0; k < n; k++)
    b[k] /= a[k * width];
  for (size_t k = n; k-- > n - ends;)
    substitute(a + k * width, 1, n - 1 - k, 1, b + k);
  for (size_t k = n - ends; k-- > 0;)
    substitute(a + k * width, 1, most, 1, b + k);
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
  size_t n = band->n, whole = n - least(width - 1, n);
  memset(y, 0, n * sizeof *y);
  for (size_t i = 0; i < whole; i++)
    multiply_row(band->a + i * width, width, x + i, y + i);
  for (size_t i = whole; i < n; i++)
    multiply_row(band->a + i * width, n - i, x + i, y + i);
}

/* The widths of one ribbon and of two are compiled on their own. */
enum { ONE_RIBBON = 6, TWO_RIBBONS = 12 };

ZP_KERNEL static bool factor_symmetric(ZpBand *band) {
  if (band->stride == TWO_RIBBONS) return factor_rows(band, TWO_RIBBONS);
  if (band->stride == ONE_RIBBON) return factor_rows(band, ONE_RIBBON);
  return band->upper > ZP_BAND_MOST ? factor_wide(band) : factor_rows(band, band->stride);
}

ZP_KERNEL static void solve_symmetric(const ZpBand *band, double *b) {
  if (band->stride == TWO_RIBBONS)
    solve_rows(band, TWO_RIBBONS, b);
  else if (band->stride == ONE_RIBBON)
    solve_rows(band, ONE_RIBBON, b);
  else
    solve_rows(band, band->stride, b);
}

ZP_KERNEL static void multiply_symmetric(const ZpBand *band, const double *x, double *y) {
  if (band->stride == TWO_RIBBONS)
    multiply_rows(band, TWO_RIBBONS, x, y);
  else
    multiply_rows(band, band->stride, x, y);
}

/* -- what is on top: Sherman and Morrison's formula, term by term ------------------------------------ */

/* b is solved with the band and `terms` terms on top of it, if it was with the band. */
static void solve_top(const ZpBand *band, size_t terms, double *b) {
  size_t n = band->n;
  for (size_t k = 0; k < terms; k++) {
    double part = zp_dot(n, band->v + k * n, b) / band->s[k];
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
    memcpy(w, band->u + k * n, n * sizeof *w);
    solve_band(band, w);
    solve_top(band, k, w);
    band->s[k] = 1 + zp_dot(n, band->v + k * n, w);
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
    double part = zp_dot(n, band->v + k * n, x);
    for (size_t i = 0; i < n; i++)
      y[i] += band->u[k * n + i] * part;
  }
}

static size_t negative_of_band(const ZpBand *band) {
  size_t negative = 0;
  for (size_t i = 0; i < band->n; i++)
    negative += *zp_band_at(band, i, i) < 0;
  return band->lower == 0 ? negative : (negative + band->odd) % 2;
}

size_t zp_band_negative(const ZpBand *band) {
  size_t negative = negative_of_band(band);
  for (size_t k = 0; k < band->rank; k++)
    if (band->s[k] < 0) negative = negative > 0 ? negative - 1 : 1;
  return negative;
}
