#include "rest/setpoint.h"

#include <math.h>

enum { MOST_POINTS = 5000 };

double zp_setpoint_signal(const ZpRest *rest, const ZpSetpointSignal *signal) {
  const ZpStatics *s = &rest->statics;
  switch (signal->kind) {
  case ZP_CONTROL_STROKE:
    return zp_statics_stroke(s);
  case ZP_CONTROL_CAPACITANCE:
    return zp_statics_capacitance(s);
  case ZP_CONTROL_ANGLE:
    return NAN; /* of a network, which has no equilibrium of one setpoint */
  case ZP_CONTROL_CONTRACTION:
    return 1 - zp_statics_opening(s) / signal->hanging;
  default:
    return zp_statics_opening(s);
  }
}

typedef struct Way {
  const ZpRest *rest;
  const ZpSetpointSignal *signal;
  double start, value; /* of the signal where it hangs, and where it ends */
} Way;

static double left(const Way *way) {
  return zp_setpoint_signal(way->rest, way->signal) - way->value;
}

static bool has_passed(void *user) {
  const Way *way = user;
  return left(way) * (way->start - way->value) <= 0;
}

bool zp_setpoint_find(ZpRest *rest, ZpSetpointSignal *signal, double value) {
  static const double near = 1e-5, finer = 1e-3; /* near: of the way */
  ZpStatics *s = &rest->statics;
  ZpBranch *branch = &rest->branch;
  if (!zp_newton_good(zp_statics_find_rest(s).end) || !zp_statics_bias(s)) return false;
  signal->hanging = zp_statics_opening(s);
  Way way = {rest, signal, zp_setpoint_signal(rest, signal), value};
  if (way.start == value || !zp_rest_follow(rest, true)) return false;
  for (int k = 0; k < MOST_POINTS; k++) {
    if (!zp_branch_advance(branch) || s->U < 0) return false;
    if (!has_passed(&way)) continue;
    zp_branch_approach(branch, has_passed, &way);
    if (fabs(left(&way)) <= near * fabs(way.start - value)) return zp_newton_good(zp_rest_settle(rest, s->U).end);
    branch->step *= finer; /* a limit point came before, or the distance is short */
  }
  return false;
}
