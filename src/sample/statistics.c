#include "sample/statistics.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

const double zp_quantile_share[ZP_QUANTILES] = {0.05, 0.25, 0.5, 0.75, 0.95};

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Linear between the samples in their order, the least at share 0, the largest at 1. */
static double quantile_of(const double *sorted, size_t count, double share) {
  const double place = share * (double)(count - 1);
  const size_t below = (size_t)place, above = below + 1 < count ? below + 1 : below;
  return sorted[below] + (sorted[above] - sorted[below]) * (place - (double)below);
}

/* Mean and standard deviation, of deviations from the first value: outputs may vary by little. */
static void moments(const double *value, ZpStatistics *s) {
  double sum = 0, squares = 0;
  for (size_t i = 0; i < s->count; i++)
    sum += value[i] - value[0];
  const double shift = sum / (double)s->count;
  s->mean = value[0] + shift;
  for (size_t i = 0; i < s->count; i++)
    squares += (value[i] - value[0] - shift) * (value[i] - value[0] - shift);
  s->deviation = s->count > 1 ? sqrt(squares / (double)(s->count - 1)) : (double)NAN;
}

ZpStatistics zp_statistics(const ZpDesign *design, const double *value, double *work) {
  const size_t samples = zp_design_samples(design), blocks = zp_design_blocks(design);
  ZpStatistics s = {.mean = NAN, .deviation = NAN, .least = NAN, .most = NAN};
  for (size_t i = 0; i < samples; i++) {
    if (i % blocks > ZP_BLOCK_B) continue;
    if (isfinite(value[i]))
      work[s.count++] = value[i];
    else
      s.missing++;
  }
  if (s.count > 0) {
    qsort(work, s.count, sizeof *work, compare);
    moments(work, &s);
    s.least = work[0];
    s.most = work[s.count - 1];
  }
  for (int k = 0; k < ZP_QUANTILES; k++)
    s.quantile[k] = s.count > 0 ? quantile_of(work, s.count, zp_quantile_share[k]) : (double)NAN;
  return s;
}

/* Squared differences of the values of a point: of A and B, and of either from the block that has one coordinate of B.
 * Their means estimate 2 V, 2 V T and 2 V (1 - S), with V the variance, S the first-order and T the total index (Jansen
 * 1999). The variance is that of the same pairs, so that a dimension without influence has indices of exactly 0, and
 * one that alone has influence, of exactly 1. */
typedef struct Squares {
  double whole, from_A, from_B;
} Squares;

static double square(double x) {
  return x * x;
}

/* False if a value is missing. */
static bool squares_of(const double *of_point, int dimension, Squares *s) {
  const double A = of_point[ZP_BLOCK_A], B = of_point[ZP_BLOCK_B], mixed = of_point[ZP_BLOCK_FIRST + dimension];
  *s = (Squares){square(A - B), square(A - mixed), square(B - mixed)};
  return isfinite(s->whole) && isfinite(s->from_A) && isfinite(s->from_B);
}

/* A ratio of two means with the interval that their scatter over n points leaves. `scatter`: the sum of the squares of
 * numerator - ratio * denominator; `whole`: the sum of the denominators. */
static ZpIndex with_interval(double ratio, double scatter, double whole, double n) {
  static const double deviations = 1.959963984540054; /* of a normal distribution, for 95 % */
  const double half = n > 1 ? deviations * sqrt(scatter * n / (n - 1)) / whole : (double)NAN;
  return (ZpIndex){ratio, ratio - half, ratio + half};
}

ZpIndices zp_sobol_indices(const ZpDesign *design, const double *value, int dimension) {
  const size_t blocks = zp_design_blocks(design);
  const ZpIndex none = {NAN, NAN, NAN};
  Squares sum = {0}, s;
  size_t count = 0;
  for (size_t point = 0; point < design->count; point++) {
    if (!squares_of(value + point * blocks, dimension, &s)) continue;
    count++;
    sum.whole += s.whole;
    sum.from_A += s.from_A;
    sum.from_B += s.from_B;
  }
  if (!(sum.whole > 0)) return (ZpIndices){none, none, count};
  const double total = sum.from_A / sum.whole, rest = sum.from_B / sum.whole;
  double scatter_A = 0, scatter_B = 0;
  for (size_t point = 0; point < design->count; point++) {
    if (!squares_of(value + point * blocks, dimension, &s)) continue;
    scatter_A += square(s.from_A - total * s.whole);
    scatter_B += square(s.from_B - rest * s.whole);
  }
  return (ZpIndices){with_interval(1 - rest, scatter_B, sum.whole, (double)count),
                     with_interval(total, scatter_A, sum.whole, (double)count), count};
}
