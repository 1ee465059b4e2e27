/* Distribution of an output from its samples, and the keys from which it follows. */
#ifndef ZP_SAMPLE_STATISTICS_H
#define ZP_SAMPLE_STATISTICS_H

#include "sample/design.h"

enum { ZP_QUANTILES = 5 };

/* The shares whose quantiles are given. */
extern const double zp_quantile_share[ZP_QUANTILES];

typedef struct ZpStatistics {
  size_t count, missing; /* samples with a value; without one, which are left out */
  double mean;
  double deviation; /* standard deviation, of the distribution; NAN below two samples */
  double least, most;
  double quantile[ZP_QUANTILES];
} ZpStatistics;

/* Of `value` [samples of the design], NAN where there is none; with indices, of the independent blocks A and B. `work`
 * has the same length. Without a sample all numbers but the counts are NAN. */
ZpStatistics zp_statistics(const ZpDesign *design, const double *value, double *work);

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
