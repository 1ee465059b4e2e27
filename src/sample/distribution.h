/* Distributions that a key may have in place of a value. */
#ifndef ZP_SAMPLE_DISTRIBUTION_H
#define ZP_SAMPLE_DISTRIBUTION_H

typedef enum ZpDistributionKind {
  ZP_DISTRIBUTION_NONE,
  ZP_DISTRIBUTION_NORMAL,      /* a: mean, b: standard deviation */
  ZP_DISTRIBUTION_LOGNORMAL,   /* a: median, b: standard deviation of the natural logarithm */
  ZP_DISTRIBUTION_UNIFORM,     /* from a to b */
  ZP_DISTRIBUTION_LOG_UNIFORM, /* its logarithm is uniform, from a to b */
  ZpDistributionKind_COUNT
} ZpDistributionKind;

typedef struct ZpDistribution {
  ZpDistributionKind kind;
  double a, b;
} ZpDistribution;

/* The value below which a share (0 .. 1, both excluded) of the distribution lies. */
double zp_quantile(const ZpDistribution *distribution, double share);

/* The quantile of the normal distribution of mean 0 and standard deviation 1. */
double zp_normal_quantile(double share);

#endif
