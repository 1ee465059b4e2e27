#include "solve/newton.h"

#include <math.h>

#include "math/vector.h"

void zp_newton_reserve(ZpNewtonWork *work, const ZpArrowForm *form, ZpArena *arena) {
  zp_arrow_reserve(&work->K, form, arena);
  work->r = zp_arena_take(arena, form->n);
}

bool zp_newton_good(ZpNewtonEnd end) {
  return end == ZP_NEWTON_CONVERGED || end == ZP_NEWTON_FLOOR;
}

double zp_static_dot(const ZpStaticSystem *system, const double *a, const double *b) {
  return zp_dot(system->n, a, b) + zp_parts_dot(&system->parts, a, b);
}

/* -- closing in ----------------------------------------------------------------------------------- */

void zp_closing_start(ZpClosing *c) {
  *c = (ZpClosing){INFINITY, INFINITY, INFINITY, INFINITY, 0};
}

void zp_closing_correct(ZpClosing *c, const ZpStaticSystem *system, const double *step) {
  c->before = c->change;
  c->change = system->change(system->self, step);
}

bool zp_closing_done(ZpClosing *c, double residual, double tolerance) {
  bool better = residual < 0.5 * c->least_residual || c->change < 0.5 * c->least_change;
  c->stalled = better ? 0 : c->stalled + 1;
  c->least_residual = fmin(c->least_residual, residual);
  c->least_change = fmin(c->least_change, c->change);
  double rate = isinf(c->before) ? 1 : fmin(c->change / c->before, 1);
  return residual == 0 || (residual < tolerance && (c->change == 0 || c->change * rate < 1));
}

bool zp_closing_stalled(const ZpClosing *c, double residual, double tolerance) {
  static const double near = 100;
  return c->stalled >= 3 && residual < near * tolerance && c->change < near;
}

void zp_closing_renew(ZpClosing *c) {
  c->least_residual = INFINITY;
  c->stalled = 0;
}

/* -- Newton's method ------------------------------------------------------------------------------ */

enum { MOST_REFRESHES = 40 };

ZpNewtonInfo zp_newton(const ZpStaticSystem *system, double tolerance, int most, ZpNewtonWork *work) {
  ZpNewtonInfo info = {ZP_NEWTON_SLOW, 0, INFINITY};
  ZpClosing closing;
  zp_closing_start(&closing);
  bool fresh = !system->refresh;
  int since = 0; /* linear solves since the last refresh: each gets as many as it takes without */
  for (int refreshes = 0;;) {
    if (system->residual(system->self, work->r, &info.residual) != ZP_END_FOUND)
      return (ZpNewtonInfo){ZP_NEWTON_DIVERGED, info.iterations, INFINITY};
    info.end = ZP_NEWTON_SLOW;
    if (zp_closing_done(&closing, info.residual, tolerance)) info.end = ZP_NEWTON_CONVERGED;
    if (zp_closing_stalled(&closing, info.residual, tolerance)) info.end = ZP_NEWTON_FLOOR;
    if (zp_newton_good(info.end) && !fresh) {
      fresh = refreshes++ < MOST_REFRESHES && system->refresh(system->self) == ZP_END_FOUND;
      zp_closing_renew(&closing);
      since = 0;
      if (fresh) continue;
      info.end = ZP_NEWTON_DIVERGED;
    }
    if (info.end != ZP_NEWTON_SLOW || since == most) return info;
    system->stiffness(system->self, &work->K, work->r);
    if (!zp_arrow_factor(&work->K)) {
      info.end = ZP_NEWTON_SINGULAR;
      return info;
    }
    zp_arrow_solve(&work->K, work->r);
    zp_closing_correct(&closing, system, work->r);
    double length = system->length(system->self, work->r);
    system->move(system->self, work->r, length > 1 ? 1 / length : 1);
    fresh = !system->refresh;
    info.iterations++;
    since++;
  }
}
