#include "sample/distribution.h"

#include <math.h>

/* Newton's method for the tail's share p(x) = erfc(x / sqrt(2)) / 2 from x = 0: where x > 0 it is convex and falls, so
 * that every step stays on the near side of the root, and goes on until rounding turns it back. */
double zp_normal_quantile(double share) {
  enum { STEPS_MOST = 100 };
  const double tail = fmin(share, 1 - share), per_density = sqrt(2 * acos(-1.0));
  double x = 0, step = 1;
  for (int i = 0; i < STEPS_MOST && step > 1e-16 * (1 + x); i++) {
    step = (0.5 * erfc(x / sqrt(2)) - tail) * per_density * exp(0.5 * x * x);
    x += step;
  }
  return share < 0.5 ? -x : x;
}

double zp_quantile(const ZpDistribution *d, double share) {
  switch (d->kind) {
  case ZP_DISTRIBUTION_NORMAL:
    return d->a + d->b * zp_normal_quantile(share);
  case ZP_DISTRIBUTION_LOGNORMAL:
    return d->a * exp(d->b * zp_normal_quantile(share));
  case ZP_DISTRIBUTION_LOG_UNIFORM:
    return d->a * pow(d->b / d->a, share);
  default:
    return d->a + (d->b - d->a) * share;
  }
}
