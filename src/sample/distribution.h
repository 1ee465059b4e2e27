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
  double low, high; /* where a normal distribution is cut; both 0: it is not */
} ZpDistribution;

/* The value below which a share (0 .. 1, both excluded) of the distribution lies. */
double zp_quantile(const ZpDistribution *distribution, double share);

/* Of a normal distribution, given others with which it is correlated, theory (12.13): its score (value minus mean, over
 * the standard deviation) is then normal with this mean and this standard deviation, and is cut where the value is. The
 * number of these standard deviations beyond that mean below which a share lies, and the value there. */
double zp_conditional_score(const ZpDistribution *distribution, double mean, double deviation, double share);
double zp_conditional_value(const ZpDistribution *distribution, double mean, double deviation, double score);

/* The share of the normal distribution of mean 0 and standard deviation 1 below x. */
double zp_normal_share(double x);

/* The quantile of the normal distribution of mean 0 and standard deviation 1. */
double zp_normal_quantile(double share);

#endif
