#include "sample/statistics.h"

#include <math.h>
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

/* Sums over the points of a design that have all three values of a dimension. */
typedef struct Sums {
  size_t count;
  double base;           /* a value, so that what follows are sums of deviations */
  double value, square;  /* of A and B */
  double from_A, from_B; /* squares of what changes if one coordinate is that of B, or all others are those of A */
} Sums;

static void add(Sums *s, double A, double B, double mixed) {
  if (!(isfinite(A) && isfinite(B) && isfinite(mixed))) return;
  if (s->count++ == 0) s->base = A;
  s->value += A - s->base + (B - s->base);
  s->square += (A - s->base) * (A - s->base) + (B - s->base) * (B - s->base);
  s->from_A += (A - mixed) * (A - mixed);
  s->from_B += (B - mixed) * (B - mixed);
}

ZpIndices zp_sobol_indices(const ZpDesign *design, const double *value, int dimension) {
  const size_t blocks = zp_design_blocks(design);
  Sums s = {0};
  for (size_t point = 0; point < design->count; point++) {
    const double *of_point = value + point * blocks;
    add(&s, of_point[ZP_BLOCK_A], of_point[ZP_BLOCK_B], of_point[ZP_BLOCK_FIRST + dimension]);
  }
  const double n = (double)s.count, mean = s.value / (2 * n), variance = s.square / (2 * n) - mean * mean;
  if (!(variance > 0)) return (ZpIndices){NAN, NAN, s.count};
  return (ZpIndices){1 - s.from_B / (2 * n) / variance, s.from_A / (2 * n) / variance, s.count};
}
