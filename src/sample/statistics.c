#include "sample/statistics.h"

#include <math.h>
#include <stdlib.h>

const char *const zp_statistic_name[ZP_STATISTICS] = {
    "mean", "standard_deviation", "min", "quantile_05", "quantile_25", "median", "quantile_75", "quantile_95", "max",
};

/* The shares of those that are quantiles. */
static const double share_of[ZP_STATISTICS] = {
    [ZP_LEAST] = 0,          [ZP_QUANTILE_05] = 0.05, [ZP_QUANTILE_25] = 0.25, [ZP_MEDIAN] = 0.5,
    [ZP_QUANTILE_75] = 0.75, [ZP_QUANTILE_95] = 0.95, [ZP_MOST] = 1,
};

static int compare(const void *a, const void *b) {
  const double x = ((const ZpSample *)a)->value, y = ((const ZpSample *)b)->value;
  return (x > y) - (x < y);
}

/* Linear between two samples; one of them alone may be infinite. */
static ZpSample quantile_of(const ZpSample *sorted, size_t count, double share) {
  const double place = share * (double)(count - 1);
  const size_t below = (size_t)place;
  const double part = place - (double)below;
  const ZpSample *low = &sorted[below], *high = low + (part > 0);
  if (part == 0) return *low;
  return (ZpSample){low->value + (high->value - low->value) * part, low->slope + (high->slope - low->slope) * part};
}

/* From the first value: outputs may vary by little. */
static ZpSample mean_of(const ZpSample *sample, size_t count) {
  ZpSample sum = {0, 0};
  for (size_t i = 0; i < count; i++) {
    sum.value += sample[i].value - sample[0].value;
    sum.slope += sample[i].slope;
  }
  return (ZpSample){sample[0].value + sum.value / (double)count, sum.slope / (double)count};
}

static ZpSample deviation_of(const ZpSample *sample, size_t count) {
  const double mean = mean_of(sample, count).value;
  double squares = 0, products = 0;
  for (size_t i = 0; i < count; i++) {
    squares += (sample[i].value - mean) * (sample[i].value - mean);
    products += (sample[i].value - mean) * sample[i].slope;
  }
  const double deviation = count > 1 ? sqrt(squares / (double)(count - 1)) : (double)NAN;
  return (ZpSample){deviation, products / ((double)(count - 1) * deviation)};
}

static ZpSample of_sorted(ZpStatistic which, const ZpSample *sorted, size_t count) {
  if (which == ZP_MEAN) return mean_of(sorted, count);
  if (which == ZP_STANDARD_DEVIATION) return deviation_of(sorted, count);
  return quantile_of(sorted, count, share_of[which]);
}

ZpSample zp_statistic(ZpStatistic which, ZpSample *sample, size_t count) {
  qsort(sample, count, sizeof *sample, compare);
  return of_sorted(which, sample, count);
}

bool zp_design_is_drawn(const ZpDesign *design, size_t sample) {
  return sample % zp_design_blocks(design) <= ZP_BLOCK_B;
}

ZpStatistics zp_statistics(const ZpDesign *design, const double *value, ZpSample *work) {
  const size_t samples = zp_design_samples(design);
  ZpStatistics s = {0};
  for (size_t i = 0; i < samples; i++) {
    if (!zp_design_is_drawn(design, i)) continue;
    if (isfinite(value[i]))
      work[s.count++] = (ZpSample){.value = value[i]};
    else
      s.missing++;
  }
  qsort(work, s.count, sizeof *work, compare);
  for (int k = 0; k < ZP_STATISTICS; k++)
    s.number[k] = s.count > 0 ? of_sorted((ZpStatistic)k, work, s.count).value : (double)NAN;
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
