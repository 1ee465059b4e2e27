/* Distribution of an output from its samples, and the keys from which it follows. */
#ifndef ZP_SAMPLE_STATISTICS_H
#define ZP_SAMPLE_STATISTICS_H

#include <stdbool.h>

#include "sample/design.h"

/* Numbers that describe a distribution. Quantiles are linear between the samples in their order: the least is that of
 * share 0, the largest that of 1. */
typedef enum ZpStatistic {
  ZP_MEAN,
  ZP_STANDARD_DEVIATION, /* of the distribution; NAN below two samples */
  ZP_LEAST,
  ZP_QUANTILE_05,
  ZP_QUANTILE_25,
  ZP_MEDIAN,
  ZP_QUANTILE_75,
  ZP_QUANTILE_95,
  ZP_MOST,
  ZP_STATISTICS
} ZpStatistic;

/* Their names in files and scenarios. */
extern const char *const zp_statistic_name[ZP_STATISTICS];

/* A value of an output, and its derivative. */
typedef struct ZpSample {
  double value, slope;
} ZpSample;

/* A number of the distribution of samples, and its derivative; changes their order. A value that is infinite belongs to
 * the distribution: the number is infinite or NAN if it follows from that value. count >= 1. */
ZpSample zp_statistic(ZpStatistic which, ZpSample *sample, size_t count);

/* Does a sample of a design belong to the distribution? With indices, only those of the independent blocks A and B. */
bool zp_design_is_drawn(const ZpDesign *design, size_t sample);

typedef struct ZpStatistics {
  size_t count, missing; /* samples with a value; without one, which are left out */
  double number[ZP_STATISTICS];
} ZpStatistics;

/* Of `value` [samples of the design], NAN where there is none. `work` has the same length. Without a sample all numbers
 * but the counts are NAN. */
ZpStatistics zp_statistics(const ZpDesign *design, const double *value, ZpSample *work);

/* An estimate and its confidence interval of 95 %, for points that are independent; those of a Sobol sequence scatter
 * less. */
typedef struct ZpIndex {
  double value, low, high;
} ZpIndex;

/* The indices of Sobol of one dimension: shares of the variance of the output. */
typedef struct ZpIndices {
  ZpIndex first; /* caused by this dimension alone */
  ZpIndex total; /* left if all but this dimension were fixed, interactions included */
  size_t count;  /* points of the design that have all values */
} ZpIndices;

/* NAN where the output does not vary. The design must have indices. */
ZpIndices zp_sobol_indices(const ZpDesign *design, const double *value, int dimension);

#endif
