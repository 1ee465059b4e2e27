#include "solve/track.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

static const double little = 5e-3; /* of the scale of q: a smaller motion does not matter */

void zp_track_reserve(ZpTrack *track, const ZpBranchSystem *system, const ZpArrowForm *form, ZpNewtonWork *newton,
                      ZpArena *arena) {
  size_t n = system->at_rest.n, saved = (system->save_size + sizeof(double) - 1) / sizeof(double);
  zp_fold_reserve(&track->fold, system, form, newton, arena);
  double **vectors[] = {&track->q, &track->before, &track->guess};
  for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++)
    *vectors[k] = zp_arena_take(arena, n);
  track->good = zp_arena_take(arena, saved);
  track->start = zp_arena_take(arena, saved);
}

/* -- points ---------------------------------------------------------------------------------------- */

static double parameter(const ZpTrack *m) {
  const ZpBranchSystem *sys = m->fold.system;
  return zp_branch_parameter(sys);
}

/* Is the present equilibrium stable? Then dq/dm is in fold.along. */
static bool is_stable(ZpTrack *m) {
  return zp_fold_tangent(&m->fold) && m->fold.negative == 0;
}

/* The present point is good: store it, and its distance from a limit point. `first`: there is none before it. */
static void keep(ZpTrack *m, bool first) {
  const ZpBranchSystem *sys = m->fold.system;
  const ZpStaticSystem *rest = &sys->at_rest;
  double flat = 1 / zp_static_dot(rest, m->fold.along, m->fold.along), gone = fabs(parameter(m) - m->m);
  m->to_fold = !first && flat < m->flat ? gone * flat / (m->flat - flat) : (double)INFINITY;
  if (2 * m->to_fold < little * sys->q_scale * sqrt(flat))
    m->to_fold = INFINITY; /* what moves that little is at rest */
  m->tried = false;
  m->flat = flat;
  m->m = parameter(m);
  memcpy(m->before, m->fold.along, rest->n * sizeof *m->before);
  sys->position(rest->self, m->q);
  sys->save(rest->self, m->good);
  if (!m->event) return;
  m->value = m->event(rest->self, m->guess);
  m->slope = zp_dot(rest->n, m->guess, m->before);
}

static void go_back(ZpTrack *m) {
  const ZpStaticSystem *rest = &m->fold.system->at_rest;
  m->fold.system->restore(rest->self, m->good);
  rest->residual(rest->self, m->fold.newton->r, NULL);
}

/* From the last good point by `way` along its tangent, to parameter m.m + dm. False if that is too far for a
 * tangent. */
static bool predict(ZpTrack *m, double way, double dm) {
  static const double farthest = 0.6; /* of what linearisation stands */
  const ZpBranchSystem *sys = m->fold.system;
  const ZpStaticSystem *rest = &sys->at_rest;
  for (size_t i = 0; i < rest->n; i++)
    m->guess[i] = m->before[i] * way;
  if (!(rest->length(rest->self, m->guess) < farthest)) return false;
  rest->move(rest->self, m->guess, 1);
  zp_branch_set(sys, m->m + dm);
  return true;
}

/* Is the present point where the tangents from the last good point lead: `from` times the tangent there and `to` times
 * its own? After a jump to another branch it is not. */
static bool agrees(ZpTrack *m, double from, double to) {
  static const double part = 0.25; /* of what moved */
  const ZpBranchSystem *sys = m->fold.system;
  size_t n = sys->at_rest.n;
  double off = 0, all = 0;
  sys->position(sys->at_rest.self, m->guess);
  for (size_t i = 0; i < n; i++) {
    double moved = m->guess[i] - m->q[i], left = moved - from * m->before[i] - to * m->fold.along[i];
    all += moved * moved;
    off += left * left;
  }
  return sqrt(off) <= fmax(part * sqrt(all), little * sys->q_scale);
}

/* Does the value of the event change as its slopes at both ends say? This detects a jump that hardly moves the rest. */
static bool value_agrees(ZpTrack *m, double dm) {
  static const double part = 0.25, least = 1e-3; /* of its change; of its limit */
  if (!m->event) return true;
  double change = m->event(m->fold.system->at_rest.self, m->guess) - m->value;
  double slope = zp_dot(m->fold.system->at_rest.n, m->guess, m->fold.along);
  return fabs(change - 0.5 * dm * (m->slope + slope)) <= fmax(part * fabs(change), least * fabs(m->limit));
}

/* -- the limit point ahead -------------------------------------------------------------------------- */

/* Solve for the limit point at the distance `far` from the last good one. */
static bool try_fold(ZpTrack *m, double sign, double far) {
  static const double part = 0.3;
  if (!predict(m, 2 * sign * far, sign * far)) return false;
  memcpy(m->fold.along, m->before, m->fold.system->at_rest.n * sizeof *m->before);
  zp_fold_guess(&m->fold);
  if (!zp_fold_solve(&m->fold) || m->fold.negative > 0) return false;
  double found = sign * (parameter(m) - m->m);
  return found > 0 && fabs(found - far) < part * far && agrees(m, 2 * sign * found, 0);
}

/* Converge from nearby to the equilibrium at the present parameter. Is it stable? */
static bool polish(ZpTrack *m) {
  enum { MOST = 12 };
  const ZpStaticSystem *rest = &m->fold.system->at_rest;
  return zp_newton_good(zp_newton(rest, m->fold.tolerance, MOST, m->fold.newton).end) && is_stable(m);
}

/* One step along m. */
static bool try_step(ZpTrack *m, double dm, double way) {
  if (!predict(m, way, dm)) return false;
  bool stable = m->to == ZP_FOLD_EXACT ? polish(m) : zp_fold_rest(&m->fold) && m->fold.negative == 0;
  return stable && agrees(m, 0.5 * dm, 0.5 * dm) && value_agrees(m, dm);
}

/* -- along the event's value ------------------------------------------------------------------------ */

/* The scale of the event's value: below a thousandth of its limit it does not count. */
static double scale(const ZpTrack *m) {
  return fmax(fabs(m->value), 1e-3 * fabs(m->limit));
}

static bool solve_at(ZpTrack *m, double value, ZpFoldTo to) {
  return zp_fold_event(&m->fold, m->event, value, to);
}

/* dm/d(value) at the present point. */
static double turn_of(ZpTrack *m) {
  m->event(m->fold.system->at_rest.self, m->guess);
  return 1 / zp_dot(m->fold.system->at_rest.n, m->guess, m->fold.along);
}

/* Is the branch as at the last good point, and not behind it: stable, with m in the same direction? */
static bool is_before_fold(ZpTrack *m, double sign) {
  static const double rounding = 1e-10; /* of m, which is flat at a limit point */
  bool behind = sign * (parameter(m) - m->m) < -rounding * fabs(m->m);
  return !behind && is_stable(m) && turn_of(m) * m->slope > 0;
}

/* At the last good point, which differs from a limit point by less than the accuracy of m. If that is flat, beside a
 * corner, it is smooth itself: solved as such m hardly changes, but the state does, and with it the derivatives of m by
 * keys. False if the point is not stable. */
static bool refine(ZpTrack *m) {
  /* of m: another limit point is farther away; one unknown has only one */
  const double near = m->fold.system->at_rest.n > 1 ? 1e-8 : 1e-4;
  go_back(m);
  if (!is_stable(m)) return false;
  zp_fold_guess(&m->fold);
  if (zp_fold_solve(&m->fold) && m->fold.negative == 0 && fabs(parameter(m) - m->m) <= near * fabs(m->m)) return true;
  go_back(m);
  is_stable(m);
  zp_fold_guess(&m->fold);
  return true;
}

/* Halve the distance to a limit point between the last good point and `value`. It is a corner, where the stiffness
 * jumps. The last good point is then accurate enough. */
static bool halve(ZpTrack *m, double sign, double value) {
  enum { MOST = 60 };
  static const double enough = 1e-10;
  double step = value - m->value, before = INFINITY;
  for (int k = 0; k < MOST; k++) {
    step *= 0.5;
    go_back(m);
    if (!solve_at(m, m->value + step, ZP_FOLD_EXACT) || !is_before_fold(m, sign)) continue;
    before = m->m;
    keep(m, false);
    if (fabs(m->m - before) <= enough * fabs(m->m)) break;
  }
  go_back(m);
  return isfinite(before);
}

/* Solve a smooth limit point as such, starting where the tangents at both ends make the branch turn. If a parabola does
 * not lead there from the last good point, it is the crest of a ripple beyond the one that was passed. */
static bool solve_between(ZpTrack *m, double sign, double value) {
  static const double part = 0.3;
  double here = 1 / m->slope, there = turn_of(m), at = m->value + (value - m->value) * here / (here - there);
  if (!(here * there < 0)) return false;
  bool near = fabs(at - m->value) < fabs(at - value);
  if (near) go_back(m);
  if (near && !predict(m, (at - m->value) * here, 0)) return false;
  if (!solve_at(m, at, m->to)) return false;
  zp_fold_guess(&m->fold);
  if (!zp_fold_solve(&m->fold) || m->fold.negative > 0) return false;
  double found = m->event(m->fold.system->at_rest.self, m->guess), gone = parameter(m) - m->m;
  double parabola = 0.5 * (found - m->value) * here;
  bool between = (found - m->value) * (found - value) < 0 && sign * gone > 0;
  return between && fabs(gone - parabola) < part * fabs(gone);
}

typedef enum Step { STEP_GOOD, STEP_TOO_LONG, STEP_FOLD, STEP_EVENT } Step;

/* One step along the value of the event, which changes to `value`. */
static Step step_along_value(ZpTrack *m, double sign, double value) {
  static const double close = 1e-3; /* of m: nearer to a limit point, halving is surer */
  static const double off = 0.25;   /* of the change of m: with more, it has turned twice on the way */
  static const double tiny = 1e-6;  /* of m: less does not matter, and where the stiffness jumps no step agrees */
  double far = (value - m->value) / m->slope;
  if (!predict(m, far, far) || !solve_at(m, value, value == m->limit ? ZP_FOLD_EXACT : m->to)) return STEP_TOO_LONG;
  double gone = parameter(m) - m->m, half = 0.5 * (value - m->value);
  if (m->fold.negative > 0 || sign * gone < 0) { /* it has passed the limit point */
    bool found =
        solve_between(m, sign, value) || (fabs(gone) <= close * fabs(m->m) && halve(m, sign, value) && refine(m));
    return found ? STEP_FOLD : STEP_TOO_LONG;
  }
  if (m->to == ZP_FOLD_EXACT && !is_stable(m)) return STEP_TOO_LONG;
  m->event(m->fold.system->at_rest.self, m->guess);
  double slope = zp_dot(m->fold.system->at_rest.n, m->guess, m->fold.along), from = half / m->slope, to = half / slope;
  bool straight = fabs(gone - from - to) <= off * fabs(gone) && agrees(m, from, to);
  if (!straight && fabs(gone) > tiny * fabs(m->m)) return STEP_TOO_LONG;
  return value == m->limit ? STEP_EVENT : STEP_GOOD;
}

/* The value to which a step along it goes: `part` of a factor of 3, not past the limit. */
static double next_value(const ZpTrack *m, double sign, double part) {
  static const double turn = 0.05;
  const ZpStaticSystem *rest = &m->fold.system->at_rest;
  double towards = sign * m->slope > 0 ? 1 : -1, longest = turn / rest->length(rest->self, m->before) * fabs(m->slope);
  double change = fmin((towards > 0 ? 1 : 0.5) * scale(m) * part, longest), left = towards * (m->limit - m->value);
  return left > 0 && change > 0.8 * left ? m->limit : m->value + towards * change;
}

/* -- the way --------------------------------------------------------------------------------------- */

/* The longest allowed step along m; its rotation has `grown` while steps were good. */
static double longest_step(ZpTrack *m, double target, double grown) {
  static const double part = 0.7, turn = 0.03, most = 0.75; /* of the way; of what linearisation stands; towards 0 */
  const ZpStaticSystem *rest = &m->fold.system->at_rest;
  double left = fabs(target - m->m), h = fmin(left, grown * turn / rest->length(rest->self, m->before));
  bool to_zero = fabs(target) < most * fabs(m->m) && left > 1e-4 * m->fold.system->m_scale;
  if (to_zero) h = fmin(h, most * left);
  return fmin(h, part * m->to_fold);
}

/* One step along m, of at most `part` of the best estimate. */
static Step step_along_m(ZpTrack *m, double sign, double target, double part) {
  static const double close = 0.35; /* of m at the limit point */
  double left = sign * (target - m->m);
  if (!m->tried && m->to_fold < close * fabs(m->m) && m->to_fold < 1.5 * left) {
    m->tried = true;
    if (try_fold(m, sign, m->to_fold) && sign * (target - parameter(m)) > 0) return STEP_FOLD;
    go_back(m);
  }
  double h = fmin(part, 1) * longest_step(m, target, fmax(part, 1)), x = h / m->to_fold, before = m->value;
  double way = x < 0.9 ? h * 2 / (1 + sqrt(1 - x)) : h; /* along the parabola of the limit point ahead */
  if (!try_step(m, sign * h, sign * way)) return STEP_TOO_LONG;
  bool past = m->event && (before - m->limit) * (m->event(m->fold.system->at_rest.self, m->guess) - m->limit) < 0;
  if (!past) return STEP_GOOD;
  go_back(m);
  return step_along_value(m, sign, m->limit);
}

/* No step was short enough: is the last good point, within the accuracy, a corner, where the stiffness jumps and beyond
 * which there is no stable state? The limit point there cannot be solved as a smooth one. */
static bool is_at_corner(ZpTrack *m, double sign) {
  enum { MOST = 200 };
  static const double first = 1e-4, enough = 1e-10; /* of m */
  double step = first;
  go_back(m);
  for (int k = 0; k < MOST && step > enough; k++) {
    double dm = sign * step * fabs(m->m);
    if (try_step(m, dm, dm)) {
      keep(m, false);
    } else {
      go_back(m);
      step *= 0.5;
    }
  }
  return step <= enough && refine(m);
}

/* Has it lost its way? Forces that are not smooth, as those of a computed field, can hide the limit point ahead. */
static bool creeps(const ZpTrack *m) {
  return m->short_steps >= 120; /* on the way to corners 82 were seen */
}

static ZpTrackEnd track(ZpTrack *m, double target) {
  enum { MOST = 400 };
  static const double longest = 8, shortest = 1e-9, rounding = 1e-14, little_part = 1e-3;
  double sign = target > parameter(m) ? 1 : -1, part = 1;
  m->short_steps = 0;
  if (!is_stable(m)) return ZP_TRACK_LOST;
  keep(m, true);
  for (int k = 0; k < MOST && part > shortest && !creeps(m); k++) {
    if (sign * (target - m->m) <= rounding * fabs(target)) return polish(m) ? ZP_TRACK_ARRIVED : ZP_TRACK_LOST;
    bool steep = m->event && fabs(m->slope * m->m) > scale(m); /* the value changes faster, relative to both */
    Step step =
        steep ? step_along_value(m, sign, next_value(m, sign, fmin(part, 1))) : step_along_m(m, sign, target, part);
    bool beyond = step != STEP_TOO_LONG && sign * (parameter(m) - target) > 0;
    if (beyond) {
      go_back(m);
      if (try_step(m, target - m->m, target - m->m)) return polish(m) ? ZP_TRACK_ARRIVED : ZP_TRACK_LOST;
      step = STEP_TOO_LONG; /* the branch bends before it gets there */
    }
    if (step == STEP_FOLD) return ZP_TRACK_FOLD;
    if (step == STEP_EVENT) return ZP_TRACK_EVENT;
    if (step == STEP_GOOD) keep(m, false);
    if (step == STEP_TOO_LONG) go_back(m);
    part = step == STEP_GOOD ? fmin(2 * part, longest) : 0.4 * fmin(part, 1);
    m->short_steps = part < little_part ? m->short_steps + 1 : 0;
  }
  if (!creeps(m) && is_at_corner(m, sign)) return ZP_TRACK_FOLD;
  go_back(m);
  return ZP_TRACK_LOST;
}

ZpTrackEnd zp_track(ZpTrack *m, double target) {
  const ZpBranchSystem *sys = m->fold.system;
  sys->save(sys->at_rest.self, m->start);
  m->to = sys->at_rest.n > 1 ? ZP_FOLD_ROUGH : ZP_FOLD_EXACT; /* one unknown is cheap, as of a plate on a hard stop */
  ZpTrackEnd end = track(m, target);
  if (end != ZP_TRACK_LOST || creeps(m)) return end;
  sys->restore(sys->at_rest.self, m->start);
  m->to = ZP_FOLD_EXACT;
  return track(m, target);
}
