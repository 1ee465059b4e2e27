#include "rest/lift.h"

#include <math.h>
#include <string.h>

void zp_lift_carve(ZpLift *l, ZpSlow *slow, const ZpRest *rest, ZpCarver *carver) {
  l->slow = slow;
  zp_limit_carve(&l->at, zp_rest_save_size(rest), rest->statics.assembly.n, carver);
}

void zp_lift_start(ZpLift *l, double top, double *hung) {
  l->top = top;
  l->hung = hung;
  l->least = 0;
  l->most = INFINITY;
  l->at_least = l->at_most = NAN;
}

void zp_lift_narrow(ZpLift *l, double load, double voltage) {
  bool closes = voltage <= l->top;
  if (closes ? load <= l->least : load >= l->most) return;
  *(closes ? &l->least : &l->most) = load;
  *(closes ? &l->at_least : &l->at_most) = voltage;
}

bool zp_lift_hang(ZpLift *l, double load) {
  ZpStatics *s = l->slow->statics;
  l->slow->square.restore(s, l->hung);
  s->load = load;
  if (!zp_newton_good(zp_statics_hang(s, l->slow->newton).end) || !zp_statics_stable(s, l->slow->newton)) return false;
  l->slow->square.save(s, l->hung);
  zp_slow_start(l->slow, zp_closing_gap(s, NULL));
  return true;
}

/* -- a voltage that rises under a load ---------------------------------------------------------------- */

/* Voltage that closes the actuator under this load, not above `far` => at; 0: it hangs closed, NAN: there is none. */
static double closing_under(ZpLift *l, double load, double far, ZpSlowEnd *end) {
  *end = ZP_SLOW_LOST;
  zp_limit_none(&l->at, NULL);
  if (!zp_lift_hang(l, load)) return NAN;
  *end = ZP_SLOW_CHANGED;
  if (zp_slow_is_closed(l->slow)) zp_slow_note(l->slow, &l->at, ZP_MARCH_ARRIVED);
  if (zp_slow_is_closed(l->slow)) return 0;
  *end = zp_slow_close_at(l->slow, far, &l->at);
  return *end == ZP_SLOW_CHANGED ? l->at.value : (double)NAN;
}

ZpSlowEnd zp_lift_raise(ZpLift *l, double load) {
  ZpSlowEnd end;
  double voltage = closing_under(l, load, l->top, &end);
  zp_lift_narrow(l, load, voltage);
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

/* From where a higher or lower voltage closes it to the load under which this one does => limit */
static bool follow(ZpLift *l, ZpLimit *limit) {
  ZpSlow *slow = l->slow;
  zp_slow_go_to(slow, l->at.state);
  slow->statics->U = l->top;
  bool found = l->at.end == ZP_MARCH_FOLD ? zp_slow_fold_of_load(slow, l->at.null) : zp_lift_event(l, slow->closed);
  double load = slow->statics->load;
  if (!found || !(load > l->least && load < l->most)) return false;
  zp_slow_note(slow, limit, l->at.end);
  return true;
}

/* Between the loads that are known, by the voltages that close it under them if these are known, too. */
static double middle(const ZpLift *l) {
  static const double wide = 2, margin = 0.1;
  if (l->least == 0 || isinf(l->most)) return l->least > 0 ? wide * l->least : l->most / wide;
  double part = log(l->top / l->at_least) / log(l->at_most / l->at_least);
  part = part > 0 && part < 1 ? fmin(fmax(part, margin), 1 - margin) : 0.5;
  return l->least * pow(l->most / l->least, part);
}

/* The largest load below `most`: where the voltage closes it, or below which its closing voltage jumps, which is no
 * limit point. False if there is none. */
static bool find_below_most(ZpLift *l, double load, ZpLimit *limit) {
  enum { MOST = 100 };
  static const double same = 1e-7, near = 0.1; /* of the voltage; a limit nearer than this leads to the one asked for */
  static const double narrowest = 3e-7, lightest = 1e-12, far = 1.2; /* of the load; kg; of the voltage */
  for (int k = 0; k < MOST && !zp_statics_asked_to_stop(l->slow->statics) && l->most > lightest; k++) {
    ZpSlowEnd end;
    bool jumps = l->most / l->least - 1 < narrowest;
    double voltage = closing_under(l, jumps ? l->least : load, far * l->top, &end), off = fabs(voltage / l->top - 1);
    if (jumps || off < same) {
      zp_slow_copy(l->slow, &l->at, limit);
      limit->value = jumps ? l->least : load;
      if (jumps) limit->end = ZP_MARCH_ARRIVED;
      return true;
    }
    zp_lift_narrow(l, load, voltage);
    load = k % 2 == 0 && off < near && follow(l, limit) ? limit->value : middle(l);
  }
  return false;
}

/* Does it close under any of these larger loads? Then `least` is that one. Where the voltage does not even meet a limit
 * point, it meets none under larger loads. */
static bool closes_above(ZpLift *l, double load, bool *first) {
  static const double more[] = {1e-3, 1e-2, 3e-2, 0.1, 0.3};
  *first = false;
  l->most = INFINITY;
  for (size_t k = 0; k < sizeof more / sizeof more[0]; k++) {
    double larger = load * (1 + more[k]);
    bool hangs = zp_lift_hang(l, larger);
    if (hangs && zp_slow_first(l->slow, l->top, &l->at) == ZP_MARCH_ARRIVED) {
      *first = k == 0;
      return false;
    }
    bool closes = zp_lift_raise(l, larger) == ZP_SLOW_CHANGED;
    l->most = INFINITY;
    if (closes) return true;
  }
  return false;
}

bool zp_lift_settle(ZpLift *l, ZpLimit *limit) {
  enum { MOST = 10 };
  bool candidate = limit->end != ZP_MARCH_ARRIVED && limit->value > l->least && limit->value < l->most, first = false;
  double load = candidate ? limit->value : middle(l);
  zp_limit_none(limit, "it does not close at drive.voltage even without load");
  if (!candidate && l->least == 0 && zp_lift_raise(l, 0) != ZP_SLOW_CHANGED) return false;
  for (int k = 0; k < MOST && find_below_most(l, load, limit) && closes_above(l, limit->value, &first); k++)
    load = middle(l);
  return first;
}
