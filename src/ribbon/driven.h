/* Natural curvature that voltage drives: of each segment kappa, which follows its aim a U + b U^2 with a first-order
 * lag; the natural turn of a joint is the sum of those of the segments beside it. docs/theory.md, section 38. */
#ifndef ZP_RIBBON_DRIVEN_H
#define ZP_RIBBON_DRIVEN_H

#include "ribbon/rod_step.h"

/* A driven segment. */
typedef struct ZpDrivenPlace {
  double a, b;        /* aim of kappa: 1/(m V) and 1/(m V^2), positive upwards to the right */
  double lag;         /* s; 0: none */
  size_t first, end;  /* joints that it bends */
  const double *turn; /* [lanes] their natural turn per kappa, m */
} ZpDrivenPlace;

typedef struct ZpDriven {
  size_t places; /* 0: voltage drives no curvature */
  const ZpDrivenPlace *place;
  const double *turn; /* [lanes] natural turn of joints with all kappa 0, rad */
} ZpDriven;

/* Aim of kappa at voltage U, V, and its derivative by U. */
static inline double zp_driven_aim(const ZpDrivenPlace *p, double U) {
  return (p->a + p->b * U) * U;
}

static inline double zp_driven_aim_rate(const ZpDrivenPlace *p, double U) {
  return p->a + 2 * p->b * U;
}

/* kappa at the end of a step of length h >= 0, s, whose aim goes linearly from g0 to g1, eq. (38.2); its derivative by
 * g1. h = 0 is an instant: a lag keeps kappa. */
double zp_driven_after(const ZpDrivenPlace *place, double kappa, double g0, double g1, double h);
double zp_driven_share(const ZpDrivenPlace *place, double h);

/* Discrete natural curvature of a joint by its natural turn, |turn| < pi, eq. (8.6). */
double zp_driven_natural(double turn);

/* (kappa [places]) => k0 of the joints that driven segments bend; other places stay. */
void zp_driven_bend(const ZpDriven *driven, const double *kappa, double *k0);

/* (kappa and its rates [places]) => by [joints]: rates of k0 of these joints; other places stay. */
void zp_driven_bend_rate(const ZpDriven *driven, const double *kappa, const double *rate, double *by);

/* Work -sum M (after - before) while natural curvatures change at a curvature of the joints that is the mean of both
 * evals, J, eq. (38.4); the same eval: of an instant. M has no damping in it. */
double zp_driven_work(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, const double *before,
                      const double *after);

/* Forces of edges on their right nodes, by joints whose moments change with `by`, at the last zp_rod_step => Rx, Ry
 * [lanes], as those of a ZpRodStep. */
void zp_driven_edges(const ZpRodParams *params, const ZpRodStep *step, const double *by, double share, double *Rx,
                     double *Ry);

#endif
