#include "liquid/outer.h"

#include "math/elementary.h"

/* F / (1 + F) of eq. (22.12), a fit to potential flow around two plates; q = g / w. */
static double open_part(double q) {
  return 2.7 * q + 2.1 * q * q;
}

double zp_outer_side(const ZpOuterParams *p) {
  return zp_pi / 8 * p->rho * p->w * p->w;
}

double zp_outer_pair(const ZpOuterParams *p, double gap) {
  double F = open_part(gap / p->w);
  return 2 * zp_outer_side(p) * F / (1 + F);
}

double zp_outer_pair_slope(const ZpOuterParams *p, double g0, double g1) {
  double q0 = g0 / p->w, q1 = g1 / p->w;
  return 2 * zp_outer_side(p) / p->w * (2.7 + 2.1 * (q0 + q1)) / ((1 + open_part(q0)) * (1 + open_part(q1)));
}
