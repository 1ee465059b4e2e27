#include "solve/newton.h"

#include <math.h>

void zp_newton_carve(ZpNewtonWork *work, size_t n, size_t bandwidth, ZpCarver *carver) {
  zp_band_carve(&work->K, n, bandwidth, bandwidth, carver);
  work->r = zp_carve(carver, n);
  work->LDL = zp_carve(carver, n * (bandwidth + 1));
}

bool zp_newton_good(ZpNewtonEnd end) {
  return end == ZP_NEWTON_CONVERGED || end == ZP_NEWTON_FLOOR;
}

enum { MOST_REFRESHES = 40 };

ZpNewtonInfo zp_newton(const ZpStaticSystem *system, double tolerance, int most, ZpNewtonWork *work) {
  ZpNewtonInfo info = {ZP_NEWTON_SLOW, 0, INFINITY};
  double least = INFINITY;
  int stalled = 0;
  bool fresh = !system->refresh;
  int since = 0; /* linear solves since the last refresh: each gets as many as it takes without */
  for (int refreshes = 0;;) {
    info.residual = system->residual(system->self, work->r);
    info.end = ZP_NEWTON_SLOW;
    if (info.residual < tolerance) info.end = ZP_NEWTON_CONVERGED;
    if (!isfinite(info.residual)) info.end = ZP_NEWTON_DIVERGED;
    stalled = info.residual < 0.5 * least ? 0 : stalled + 1;
    least = fmin(least, info.residual);
    if (stalled >= 3 && info.residual < 100 * tolerance) info.end = ZP_NEWTON_FLOOR;
    if (zp_newton_good(info.end) && !fresh) {
      fresh = refreshes++ < MOST_REFRESHES && system->refresh(system->self);
      least = INFINITY;
      stalled = since = 0;
      if (fresh) continue;
      info.end = ZP_NEWTON_DIVERGED;
    }
    if (info.end != ZP_NEWTON_SLOW || since == most) return info;
    system->stiffness(system->self, &work->K);
    if (!zp_band_factor(&work->K, NULL)) {
      info.end = ZP_NEWTON_SINGULAR;
      return info;
    }
    zp_band_solve(&work->K, work->r);
    double length = system->length(system->self, work->r);
    system->move(system->self, work->r, length > 1 ? 1 / length : 1);
    fresh = !system->refresh;
    info.iterations++;
    since++;
  }
}
