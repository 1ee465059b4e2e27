/* Letters: K stiffness, r residual forces, c resistance per coordinate. */
#include "solve/descend.h"

#include <math.h>

/* K + c, factored, with a c that makes it positive definite. *c becomes 0 if K alone is so. => false if no c is
 * enough */
static bool resist(const ZpStaticSystem *system, double least, double *c, ZpNewtonWork *work) {
  for (int k = 0; k < 100; k++) {
    system->stiffness(system->self, &work->K, NULL);
    for (size_t i = 0; i < system->n; i++)
      *work->K.diagonal[i] += *c;
    for (size_t k = 0; k < system->parts.count; k++)
      *work->K.diagonal[system->parts.common[k]] += (double)system->parts.more * *c;
    if (zp_arrow_factor(&work->K) && zp_arrow_negative(&work->K) == 0) return true;
    *c = fmax(4 * *c, least);
  }
  return false;
}

ZpNewtonInfo zp_descend_until(const ZpStaticSystem *system, double longest, double tolerance, int most,
                              bool (*enough)(void *user), void *user, ZpNewtonWork *work) {
  static const double at_first = 1e-6, least = 1e-14; /* of the stiffest: slow; below, nothing is changed by it */
  static const double quickest = 1.0 / 32; /* how c may fall in a step: the next one is hardly longer than 1 */
  static const double shorter = 0.1; /* from a quarter of all steps on: longer ones jump to and fro across a corner */
  ZpNewtonInfo info = {ZP_NEWTON_SLOW, 0, INFINITY};
  ZpClosing closing;
  zp_closing_start(&closing);
  double c = 0, stiffest = 0;
  bool fresh = !system->refresh;
  for (; info.iterations < most; info.iterations++) {
    if (system->residual(system->self, work->r, &info.residual) != ZP_END_FOUND)
      return (ZpNewtonInfo){ZP_NEWTON_DIVERGED, info.iterations, INFINITY};
    if (enough && enough(user)) return (ZpNewtonInfo){ZP_NEWTON_CONVERGED, info.iterations, info.residual};
    bool close = zp_closing_done(&closing, info.residual, tolerance);
    bool floor = !close && zp_closing_stalled(&closing, info.residual, tolerance);
    if (info.iterations == 0) {
      system->stiffness(system->self, &work->K, NULL);
      for (size_t i = 0; i < system->n; i++)
        stiffest = fmax(stiffest, fabs(*work->K.diagonal[i]));
      c = at_first * stiffest;
    }
    info.end = ZP_NEWTON_SINGULAR;
    if (c < least * stiffest) c = 0;
    if (!resist(system, least * stiffest, &c, work)) return info;
    info.end = floor ? ZP_NEWTON_FLOOR : ZP_NEWTON_CONVERGED;
    if (c == 0 && (close || floor)) {
      if (fresh) return info;
      fresh = system->refresh(system->self) == ZP_END_FOUND;
      info.end = ZP_NEWTON_DIVERGED;
      if (!fresh) return info;
      continue;
    }
    zp_arrow_solve(&work->K, work->r);
    zp_closing_correct(&closing, system, work->r);
    double length = system->length(system->self, work->r) / (info.iterations < most / 4 ? longest : shorter * longest);
    system->move(system->self, work->r, length > 1 ? 1 / length : 1);
    c *= length > 1 ? 2 : fmin(fmax(length, quickest), 0.5);
    fresh = !system->refresh;
  }
  info.end = ZP_NEWTON_SLOW;
  return info;
}
