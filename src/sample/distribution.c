#include "sample/distribution.h"

#include <math.h>
#include <stdbool.h>

double zp_normal_share(double x) {
  return 0.5 * erfc(-x / sqrt(2));
}

/* Newton's method for the tail's share p(x) = erfc(x / sqrt(2)) / 2 from x = 0: where x > 0 it is convex and falls, so
 * that every step stays on the near side of the root, and goes on until rounding turns it back. */
double zp_normal_quantile(double share) {
  enum { STEPS_MOST = 100 };
  const double tail = fmin(share, 1 - share), per_density = sqrt(2 * acos(-1.0));
  double x = 0, step = 1;
  for (int i = 0; i < STEPS_MOST && step > 1e-16 * (1 + x); i++) {
    step = (zp_normal_share(-x) - tail) * per_density * exp(0.5 * x * x);
    x += step;
  }
  return share < 0.5 ? -x : x;
}

static bool is_cut(const ZpDistribution *d) {
  return d->low < d->high;
}

double zp_conditional_score(const ZpDistribution *d, double mean, double deviation, double share) {
  if (!is_cut(d)) return zp_normal_quantile(share);
  const double below = zp_normal_share(((d->low - d->a) / d->b - mean) / deviation);
  const double up_to = zp_normal_share(((d->high - d->a) / d->b - mean) / deviation);
  return zp_normal_quantile(below + share * (up_to - below));
}

double zp_conditional_value(const ZpDistribution *d, double mean, double deviation, double score) {
  const double value = d->a + d->b * (mean + deviation * score);
  return is_cut(d) ? fmin(fmax(value, d->low), d->high) : value;
}

double zp_quantile(const ZpDistribution *d, double share) {
  switch (d->kind) {
  case ZP_DISTRIBUTION_NORMAL:
    return zp_conditional_value(d, 0, 1, zp_conditional_score(d, 0, 1, share));
  case ZP_DISTRIBUTION_LOGNORMAL:
    return d->a * exp(d->b * zp_normal_quantile(share));
  case ZP_DISTRIBUTION_LOG_UNIFORM:
    return d->a * pow(d->b / d->a, share);
  default:
    return d->a + (d->b - d->a) * share;
  }
}
