#include "rest/lift.h"

#include <math.h>
#include <string.h>

static const double far = 1.2;   /* times the voltage asked for: as far as a closing voltage matters */
static const double same = 1e-7; /* of the voltage */

static bool is_at_top(const ZpLift *l) {
  return fabs(l->at.value / l->top - 1) < same;
}

void zp_lift_carve(ZpLift *l, ZpSlow *slow, const ZpRest *rest, ZpCarver *carver) {
  l->slow = slow;
  zp_limit_carve(&l->at, zp_rest_save_size(rest), rest->statics.n, carver);
}

void zp_lift_start(ZpLift *l, double top, double *hung, double *lifted) {
  l->top = top;
  l->hung = hung;
  l->lifted = lifted;
  l->least = 0;
  l->most = INFINITY;
  l->at_least = l->at_most = NAN;
}

void zp_lift_narrow(ZpLift *l, double load, bool closes, double voltage) {
  if (closes ? load <= l->least : load >= l->most) return;
  *(closes ? &l->least : &l->most) = load;
  *(closes ? &l->at_least : &l->at_most) = voltage;
}

bool zp_lift_hang(ZpLift *l, double load) {
  ZpStatics *s = l->slow->statics;
  l->slow->square.restore(s, l->hung);
  s->load = load;
  if (!zp_newton_good(zp_statics_hang(s, l->slow->newton).end) || !zp_statics_bias(s, l->slow->newton)) return false;
  if (!zp_statics_stable(s, l->slow->newton)) return false;
  l->slow->square.save(s, l->hung);
  zp_slow_start(l->slow);
  return true;
}

/* -- a voltage that rises under a load ---------------------------------------------------------------- */

/* A limit point is at the voltage, as accurately as it was solved: if the actuator falls closed from there, this is
 * where it closes. Else the next limit is above. */
static ZpSlowEnd fall_at_top(ZpLift *l) {
  bool closes = zp_slow_falls_closed(l->slow, &l->at);
  if (closes) l->slow->square.save(l->slow->statics, l->lifted);
  if (closes) return ZP_SLOW_CHANGED;
  if (zp_slow_is_closed(l->slow)) return ZP_SLOW_LOST;
  zp_limit_none(&l->at, NULL);
  return zp_slow_close_at(l->slow, far * l->top, l->top, &l->at);
}

/* Raise the voltage under this load until it closes, or to the first limit that is not below the voltage asked for.
 * That limit is `at`. */
static ZpSlowEnd raise(ZpLift *l, double load) {
  zp_limit_none(&l->at, NULL);
  if (!zp_lift_hang(l, load)) return ZP_SLOW_LOST;
  if (zp_slow_is_closed(l->slow)) zp_slow_note(l->slow, &l->at, ZP_MARCH_ARRIVED);
  if (zp_slow_is_closed(l->slow)) return ZP_SLOW_CHANGED;
  ZpSlowEnd end = zp_slow_close_at(l->slow, far * l->top, (1 - same) * l->top, &l->at);
  return end == ZP_SLOW_BEYOND && is_at_top(l) ? fall_at_top(l) : end;
}

/* Does the voltage close the actuator under this load? */
static bool closes_under(ZpLift *l, double load) {
  bool closes = raise(l, load) == ZP_SLOW_CHANGED && !(l->at.value > (1 + same) * l->top);
  zp_lift_narrow(l, load, closes, l->at.value);
  return closes;
}

ZpSlowEnd zp_lift_hang_at_top(ZpLift *l, double load) {
  if (!zp_lift_hang(l, load)) return ZP_SLOW_LOST;
  ZpSlowEnd end = zp_slow_close_at(l->slow, l->top, INFINITY, &l->at);
  zp_lift_narrow(l, load, end == ZP_SLOW_CHANGED, NAN);
  return end;
}

/* -- gradual closing -------------------------------------------------------------------------------- */

/* To the load at which the gap is `closed` => the gap at which it counts as closed under that load; NAN: not found */
static double closed_beyond(ZpLift *l, double closed) {
  ZpSlow *slow = l->slow;
  if (!zp_slow_event_of_load(slow, closed)) return NAN;
  slow->square.save(slow->statics, l->at.state);
  bool hangs = zp_lift_hang(l, slow->statics->load);
  zp_slow_go_to(slow, l->at.state);
  return hangs ? slow->closed : (double)NAN;
}

/* The gap is solved by the secant method. */
bool zp_lift_event(ZpLift *l, double closed) {
  enum { MOST = 12 };
  static const double exact = 1e-9; /* of the gap */
  double before = NAN, off_before = NAN;
  for (int k = 0; k < MOST; k++) {
    double off = closed_beyond(l, closed) - closed;
    if (isnan(off)) return false;
    if (fabs(off) <= exact * closed) return true;
    double slope = k > 0 ? (off - off_before) / (closed - before) : -1;
    before = closed;
    off_before = off;
    closed -= off / slope;
  }
  return false;
}

bool zp_lift_closes_gradually(ZpLift *l, double load) {
  return zp_lift_hang(l, load) && zp_slow_first(l->slow, (1 + same) * l->top, &l->at) == ZP_MARCH_EVENT;
}

/* The load falls on until the gap is what counts as closed under the load itself; under a larger one it is larger. */
void zp_lift_drop(ZpLift *l, ZpLimit *limit) {
  enum { MOST = 30 };
  static const double near = 0.8; /* of the gap: the rest is solved directly */
  ZpSlow *slow = l->slow;
  zp_slow_drop_load(slow, limit);
  for (int k = 0; k < MOST && limit->end == ZP_MARCH_EVENT; k++) {
    double closed = slow->closed;
    if (!zp_lift_hang(l, limit->value)) return;
    zp_slow_go_to(slow, limit->state);
    if (slow->closed > near * closed) break;
    zp_slow_drop_load(slow, limit);
  }
  if (limit->end == ZP_MARCH_EVENT && zp_lift_event(l, slow->closed)) zp_slow_note(slow, limit, ZP_MARCH_EVENT);
}

/* -- by definition ---------------------------------------------------------------------------------- */

/* From the limit at a higher or lower voltage => the load with a limit at this voltage, kg; NAN: it was not found. */
static double follow(ZpLift *l) {
  ZpSlow *slow = l->slow;
  zp_slow_go_to(slow, l->at.state);
  slow->statics->U = l->top;
  bool found = l->at.end == ZP_MARCH_FOLD ? zp_slow_fold_of_load(slow, l->at.null) : zp_lift_event(l, slow->closed);
  double load = slow->statics->load;
  return found && load > l->least && load < l->most ? load : (double)NAN;
}

/* Between the loads that are known, by the voltages that close it under them if these are known, too. */
static double middle(const ZpLift *l) {
  static const double wide = 2, margin = 0.1;
  if (l->least == 0 || isinf(l->most)) return l->least > 0 ? wide * l->least : l->most / wide;
  double part = (l->top - l->at_least) / (l->at_most - l->at_least);
  if (!(part > 0 && part < 1)) return sqrt(l->least * l->most);
  return l->least + fmin(fmax(part, margin), 1 - margin) * (l->most - l->least);
}

/* The closing voltage jumps above the load under which it last closed: this is no limit point. */
static bool settle_at_jump(ZpLift *l, ZpLimit *limit) {
  raise(l, l->least);
  zp_slow_copy(l->slow, &l->at, limit);
  limit->end = ZP_MARCH_ARRIVED;
  limit->value = l->least;
  return true;
}

/* The largest load below `most`: where the voltage closes it, or below which its closing voltage jumps. False if there
 * is none. */
static bool find_below_most(ZpLift *l, double load, ZpLimit *limit) {
  enum { MOST = 100 };
  static const double near = 0.1; /* of the voltage: a limit nearer than this leads to the one asked for */
  static const double narrowest = 3e-7, lightest = 1e-12; /* of the load; kg */
  for (int k = 0; k < MOST && !zp_statics_asked_to_stop(l->slow->statics) && l->most > lightest; k++) {
    if (l->most / l->least - 1 < narrowest) return settle_at_jump(l, limit);
    if (closes_under(l, load) && is_at_top(l)) {
      zp_slow_copy(l->slow, &l->at, limit);
      limit->value = load;
      return true;
    }
    bool follows = k % 2 == 0 && fabs(l->at.value / l->top - 1) < near;
    load = follows ? follow(l) : (double)NAN;
    if (isnan(load)) load = middle(l);
  }
  return false;
}

/* Is the first limit that the voltage meets under this load, if there is any, above the one asked for? */
static bool meets_none(ZpLift *l, double load) {
  if (!zp_lift_hang(l, load)) return false;
  return zp_slow_first(l->slow, far * l->top, &l->at) == ZP_MARCH_ARRIVED || l->at.value > l->top;
}

/* Does it close under any of these larger loads? Then `least` is that one. Where the voltage does not even meet a limit
 * point, it meets none under larger loads. */
static bool closes_above(ZpLift *l, double load, bool *first) {
  static const double more[] = {1e-3, 1e-2, 3e-2, 0.1, 0.3};
  bool closes = false, none = false;
  for (size_t k = 0; k < sizeof more / sizeof more[0] && !closes && !none; k++) {
    none = meets_none(l, load * (1 + more[k]));
    *first = none && k == 0;
    closes = !none && closes_under(l, load * (1 + more[k]));
  }
  l->most = INFINITY;
  return closes;
}

bool zp_lift_settle(ZpLift *l, ZpLimit *limit) {
  enum { MOST = 10 };
  double least = (1 - same) * l->least; /* the load known to close may itself be the largest */
  bool candidate = limit->end != ZP_MARCH_ARRIVED && limit->value > least && limit->value < l->most, first = false;
  double load = candidate ? limit->value : middle(l);
  zp_limit_none(limit, "it does not close at drive.voltage even without load");
  if (!candidate && l->least == 0 && !closes_under(l, 0)) return false;
  for (int k = 0; k < MOST && find_below_most(l, load, limit) && closes_above(l, limit->value, &first); k++)
    load = middle(l);
  return first;
}
