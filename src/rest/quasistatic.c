#include "rest/quasistatic.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

/* -- closed ---------------------------------------------------------------------------------------- */

/* Gap of a member that closes last in it, m. */
static double gap_of(const ZpRestMember *m) {
  if (!m->model->field) return 0;
  ZpLast last = zp_last_to_close(m->model);
  const double *gap = m->eval.plates.gap;
  return 0.5 * (gap[last.station[0]] + gap[last.station[1]]);
}

size_t zp_quasistatic_deciding(const ZpStatics *s) {
  size_t found = 0;
  for (size_t k = 1; k < s->members; k++) {
    const ZpRestMember *m = &s->member[k], *best = &s->member[found];
    bool nearer = gap_of(m) - m->closed < gap_of(best) - best->closed;
    if (nearer == s->opposed) found = k;
  }
  return found;
}

double zp_member_gap(const ZpStatics *s, size_t which, double *row) {
  const ZpRestMember *m = &s->member[which];
  const ZpTopology *t = &m->model->topology;
  ZpLast last = zp_last_to_close(m->model);
  if (row) memset(row, 0, s->n * sizeof *row);
  for (size_t k = 0; k < 2 && row; k++) {
    zp_assembly_add_one(&m->assembly, zp_y_of(zp_lower(t, last.station[k])), -0.5, row);
    if (zp_is_pair(t)) zp_assembly_add_one(&m->assembly, zp_y_of(zp_upper(t, last.station[k])), 0.5, row);
  }
  return gap_of(m);
}

double zp_closing_gap(void *self, double *row) {
  const ZpStatics *s = self;
  const size_t which = zp_quasistatic_deciding(s);
  double gap = zp_member_gap(s, which, row);
  return which == 0 ? gap : gap - s->member[which].closed + s->member->closed;
}

/* The sum of these gaps of members in series, m; else that of the first member. */
static double open_gap(const ZpStatics *s) {
  double sum = gap_of(s->member);
  for (size_t k = 1; k < s->members && !s->shared; k++)
    sum += gap_of(&s->member[k]);
  return sum;
}

size_t zp_closed_members(const ZpStatics *s) {
  size_t closed = 0;
  for (size_t k = 0; k < s->members; k++)
    closed += gap_of(&s->member[k]) <= s->member[k].closed;
  return closed;
}

void zp_quasistatic_start(ZpRest *r) {
  ZpStatics *s = &r->statics;
  for (size_t k = 0; k < s->members; k++)
    s->member[k].closed = zp_closed_opening(s->member[k].model, gap_of(&s->member[k]));
  r->falls = 0;
  r->track.limit = s->member->closed;
  r->track.fold.tolerance = zp_statics_tolerance(s);
}

bool zp_quasistatic_is_closed(ZpRest *r) {
  return zp_closing_gap(&r->statics, NULL) <= r->track.limit || zp_statics_shorted(&r->statics);
}

double zp_quasistatic_closed_by_load(ZpRest *r, size_t which) {
  static const double step = 1e-3; /* of the gap: the law is linear but for a corner */
  ZpStatics *s = &r->statics;
  ZpFold *fold = &r->track.fold;
  fold->system = &r->load;
  if (!zp_fold_tangent(fold)) return NAN;
  const ZpModel *model = s->member[which].model;
  double gap = zp_member_gap(s, which, fold->x), by_load = zp_dot(s->n, fold->x, fold->along);
  double change = zp_closed_opening(model, (1 + step) * gap) - zp_closed_opening(model, (1 - step) * gap);
  return by_load * change / (2 * step * gap);
}

/* -- limits --------------------------------------------------------------------------------------- */

void zp_limit_reserve(ZpLimit *limit, size_t save_size, size_t equations, ZpArena *arena) {
  limit->state = zp_arena_take(arena, save_size);
  limit->null = zp_arena_take(arena, equations);
}

void zp_limit_none(ZpLimit *limit, const char *reason) {
  *limit = (ZpLimit){ZP_TRACK_ARRIVED, NAN, reason, limit->state, limit->null, 0};
}

/* Mark it as one that was not found. */
static void lose(ZpLimit *limit, const char *reason) {
  zp_limit_none(limit, reason);
  limit->end = ZP_TRACK_LOST;
}

static bool along_load(ZpRest *r) {
  return r->track.fold.system == &r->load;
}

static void choose(ZpRest *r, const ZpBranchSystem *along) {
  r->track.fold.system = along;
  r->track.event = zp_closing_gap;
}

/* The voltage or the load at the present point. */
static double value_at(ZpRest *r) {
  return along_load(r) ? r->statics.load : r->statics.U;
}

void zp_quasistatic_note(ZpRest *r, ZpLimit *limit, ZpTrackEnd end) {
  const ZpStatics *s = &r->statics;
  limit->end = end;
  limit->value = value_at(r);
  limit->reason = NULL;
  limit->room = 0;
  zp_rest_save(r, limit->state);
  memcpy(limit->null, r->track.fold.null, s->n * sizeof *limit->null);
}

void zp_quasistatic_copy(const ZpRest *r, const ZpLimit *from, ZpLimit *to) {
  memcpy(to->state, from->state, r->system.save_size);
  memcpy(to->null, from->null, r->statics.n * sizeof *to->null);
  *to = (ZpLimit){from->end, from->value, NULL, to->state, to->null, from->room};
}

/* The parameter, changed by this share of the voltage or of the load. */
static double changed(ZpRest *r, double m, double share) {
  double factor = 1 + share;
  return r->track.fold.system->square ? m * factor * factor : m * factor;
}

static double parameter(ZpRest *r) {
  return zp_branch_parameter(r->track.fold.system);
}

/* -- ripples of the mesh ------------------------------------------------------------------------------ */

/* The step of the gap for a search along the branch. */
static double look_step(ZpRest *r) {
  static const double when_open = 4e-3, when_closed = 0.08; /* of the gap */
  return zp_closing_gap(&r->statics, NULL) * (zp_quasistatic_is_closed(r) ? when_closed : when_open);
}

/* An actuator that was closed has opened once it is clear of the limit, because motion with resistance does not come
 * back. (This does not hold for one that closes: its faces overlap for a moment on the way.) */
static bool has_opened(ZpRest *r) {
  static const double clear = 3;
  return r->was_closed && zp_closing_gap(&r->statics, NULL) > clear * r->track.limit;
}

/* The end of a fall: it has opened, or bare faces meet, whose force has no bound. */
static bool has_fallen(void *user) {
  ZpRest *r = user;
  return has_opened(r) || zp_statics_shorted(&r->statics);
}

/* Shares of the voltage or of the load by which a fall goes beyond the present point. The first is for limit points: a
 * crest that is higher by more than it is still met. */
static const double beyond[] = {1e-6, 1e-4, 3e-4, 1e-3};
enum { FROM_LIMIT, FROM_LOST, SHARES = sizeof beyond / sizeof beyond[0] };

/* Fall from the present point to the state beyond it. A fall that does not converge is tried again from further on. */
static bool fall(ZpRest *r, double sign, size_t first) {
  double m = parameter(r);
  bool found = false;
  r->falls++;
  zp_rest_save(r, r->held);
  for (size_t k = first; k < SHARES && !found; k++) {
    if (k > first) zp_rest_go_to(r, r->held);
    zp_branch_set(r->track.fold.system, changed(r, m, sign * beyond[k]));
    found = zp_newton_good(zp_statics_relax_until(&r->statics, has_fallen, r).end);
  }
  return found;
}

/* Fall from a limit point at the present point. An open actuator begins with a small step along the null vector,
 * without which it would be slow at first. A closed one does not: a front that gives way hardly moves the opening, by
 * which this step is measured. */
static bool fall_from(ZpRest *r, const ZpLimit *limit, double sign) {
  static const double part = 0.25; /* of a step along the branch */
  if (!r->was_closed) zp_fold_leave(&r->track.fold, limit->null, zp_closing_gap, -sign * part * look_step(r));
  return fall(r, sign, FROM_LIMIT);
}

/* Does the branch to which the state fell, from the limit point at m and `gap`, end so little below it that both belong
 * to a ripple of the mesh? Going down, the track may come back unnoticed to the side on which it was before the limit
 * point. */
static bool is_ripple(ZpRest *r, double m, double gap, double sign) {
  ZpStatics *s = &r->statics;
  double fallen = open_gap(s) - gap;
  zp_rest_save(r, r->held);
  ZpEvent event = r->track.event;
  r->track.event = NULL;
  ZpTrackEnd end = zp_track(&r->track, changed(r, m, -sign * ZP_FOLD_RIPPLE));
  bool ripple = end != ZP_TRACK_ARRIVED || (open_gap(s) - gap) * fallen < 0;
  r->track.event = event;
  zp_rest_go_to(r, r->held);
  return ripple;
}

/* The parameter at the present point is further than m. */
static ZpAround climb_on(ZpRest *r, double m, double sign) {
  ZpFold *fold = &r->track.fold;
  if (zp_statics_stable(&r->statics)) return ZP_STABLE_HIGHER;
  zp_fold_guess(fold);
  bool found = zp_fold_solve(fold) && fold->negative == 0 && sign * (parameter(r) - m) > 0;
  return found ? ZP_CREST_HIGHER : ZP_OUT_OF_SIGHT;
}

/* Along one side of a limit, in steps of the gap. */
typedef struct Side {
  double m, gap, sign, step; /* of the limit; where the parameter goes further: 1 or -1; of the gap */
  double deepest;            /* how far below the limit it has been, relative to the value */
} Side;

/* Is the parameter further than the limit's by more than the accuracy? */
static bool is_higher(const Side *side, double m) {
  static const double higher = 1e-6; /* of the parameter */
  return side->sign * (m - side->m) > higher * side->m;
}

/* How far a parameter is below the limit's, relative to the value; for a square of the voltage, relative to the
 * voltage. */
static double depth_of(ZpRest *r, const Side *side, double m) {
  double ratio = fmax(m / side->m, 0);
  return side->sign * (1 - (r->track.fold.system->square ? sqrt(ratio) : ratio));
}

/* A point of the branch, `at` steps from the limit: the parameter and its derivative by the steps. */
typedef struct Place {
  double at, m, slope;
} Place;

/* Pass the point that is `step` steps after another one. Its m is NAN if it was not found. */
static Place pass(ZpRest *r, const Side *side, Place from, double step) {
  enum { MOST = 6 };
  double at = from.at + step, here = side->gap + at * side->step, m, slope;
  ZpPass end = ZP_PASS_AGAIN;
  for (int tries = 0; tries < MOST && end == ZP_PASS_AGAIN; tries++)
    end = zp_fold_pass(&r->track.fold, zp_closing_gap, here, here + step * side->step, &m, &slope);
  return end == ZP_PASS_ON ? (Place){at, m, slope * side->step} : (Place){at, NAN, NAN};
}

/* The cubic through two points: above the first one it is (slope + (bend + turn t) t) t, with t from 0 to 1. For a
 * parabola turn is 0. */
typedef struct Cubic {
  double slope, end_slope, bend, turn;
} Cubic;

static Cubic cubic_through(Place from, Place to) {
  double length = to.at - from.at, a = from.slope * length, b = to.slope * length, rise = to.m - from.m;
  return (Cubic){a, b, 3 * rise - 2 * a - b, a + b - 2 * rise};
}

/* => how far the highest crest of a cubic is above its first point, and where it is: at, from 0 to 1. NAN: there is
 * none. */
static double crest_of(const Cubic *c, double sign, double *at) {
  double t = c->slope / (sign * sqrt(c->bend * c->bend - 3 * c->turn * c->slope) - c->bend);
  *at = t;
  return t > 0 && t < 1 ? t * (c->slope + t * (c->bend + t * c->turn)) : (double)NAN;
}

/* May a crest above the limit be hidden between two points? Where the stiffness jumps the branch has corners, which are
 * valleys: the cubic then is no parabola. With the slopes at its ends it could rise above the limit. */
static bool may_hide_crest(const Side *side, Place from, Place to) {
  static const double part = 1.0 / 3;
  Cubic c = cubic_through(from, to);
  double before = side->sign * (from.m - side->m) + fmax(side->sign * c.slope, 0),
         after = side->sign * (to.m - side->m) + fmax(-side->sign * c.end_slope, 0);
  bool rises = is_higher(side, side->m + side->sign * fmax(before, after));
  return rises && !is_higher(side, to.m) && fabs(c.turn) > part * fmax(fabs(c.slope), fabs(c.end_slope));
}

/* Is there a crest between two points that may be higher than the limit? => where, in steps from it; NAN: none */
static double seek_crest(ZpRest *r, const Side *side, ZpLimit *limit, Place from, Place to) {
  static const double part = 0.3; /* of the depth there: a cubic through two points is that accurate */
  Cubic c = cubic_through(from, to);
  double at, above = crest_of(&c, side->sign, &at);
  if (isnan(above)) return NAN;
  double lowest = fmax(side->deepest, fmax(depth_of(r, side, from.m), depth_of(r, side, to.m)));
  double below = depth_of(r, side, from.m + above);
  limit->room = fmin(limit->room, fmax(below, 0));
  return below < part * lowest ? from.at + at * (to.at - from.at) : (double)NAN;
}

/* Go to the crest near a point. If it is not higher than the limit, continue to the point `next`. */
static ZpAround visit_crest(ZpRest *r, ZpLimit *limit, const Side *side, double at, double next) {
  ZpFold *fold = &r->track.fold;
  bool found = zp_fold_event(fold, zp_closing_gap, side->gap + at * side->step, ZP_FOLD_ROUGH);
  if (found) zp_fold_guess(fold);
  if (!found || !zp_fold_solve(fold)) return ZP_OUT_OF_SIGHT;
  if (is_higher(side, parameter(r)) && fold->negative == 0) return ZP_CREST_HIGHER;
  limit->room = fmin(limit->room, fmax(depth_of(r, side, parameter(r)), 0));
  double left = side->gap + next * side->step - zp_closing_gap(&r->statics, NULL);
  zp_fold_leave(fold, fold->null, zp_closing_gap, left);
  return ZP_NOTHING_HIGHER;
}

/* Go step by step to the equilibrium at a point, which seems to be higher. */
static bool go_to_point(ZpRest *r, const ZpLimit *limit, const Side *side, double at) {
  int steps = (int)ceil(at);
  double step = at / steps * side->step;
  bool found = true;
  zp_rest_go_to(r, limit->state);
  zp_fold_leave(&r->track.fold, limit->null, zp_closing_gap, step);
  for (int i = 1; i <= steps && found; i++)
    found = zp_fold_event(&r->track.fold, zp_closing_gap, side->gap + i * step, ZP_FOLD_ROUGH);
  return found;
}

/* From the limit on. */
static ZpAround look(ZpRest *r, ZpLimit *limit, double sign, double whole) {
  enum { FARTHEST = 12, MOST = 40 };
  static const double shortest = 0.1;
  Side side = {parameter(r), zp_closing_gap(&r->statics, NULL), sign, whole, 0};
  Place last = {0, side.m, 0};
  double step = 1;
  zp_fold_leave(&r->track.fold, limit->null, zp_closing_gap, whole);
  for (int k = 0; k < MOST && last.at < FARTHEST && side.deepest <= ZP_FOLD_RIPPLE; k++) {
    Place here = pass(r, &side, last, step);
    if (isnan(here.m)) return ZP_OUT_OF_SIGHT;
    bool halve = step > shortest && may_hide_crest(&side, last, here);
    if (halve) step *= 0.5;
    if (halve) continue;
    double crest = seek_crest(r, &side, limit, last, here), next = here.at + step;
    ZpAround around = isnan(crest) ? ZP_NOTHING_HIGHER : visit_crest(r, limit, &side, crest, next);
    if (around != ZP_NOTHING_HIGHER) return around;
    if (is_higher(&side, here.m))
      return go_to_point(r, limit, &side, here.at) ? climb_on(r, side.m, sign) : ZP_OUT_OF_SIGHT;
    double below = depth_of(r, &side, here.m);
    if (below < side.deepest) limit->room = fmin(limit->room, below); /* it rises again after its lowest point */
    side.deepest = fmax(side.deepest, below);
    step = fmin(2 * step, 1);
    last = here;
  }
  return ZP_NOTHING_HIGHER;
}

ZpAround zp_quasistatic_look_around(ZpRest *r, ZpLimit *limit, double sign) {
  double step = look_step(r);
  limit->room = ZP_FOLD_RIPPLE;
  ZpAround beyond = look(r, limit, sign, -step);
  if (beyond == ZP_STABLE_HIGHER || beyond == ZP_CREST_HIGHER) return beyond;
  zp_rest_go_to(r, limit->state);
  ZpAround before = look(r, limit, sign, step);
  ZpAround both = before == ZP_NOTHING_HIGHER ? beyond : before;
  if (both != ZP_NOTHING_HIGHER) limit->room = 0;
  return both;
}

double zp_quasistatic_room_left(ZpRest *r, const ZpLimit *near, double gap) {
  static const double sides = 4; /* steps from a crest to where the branch is deep below it, about */
  double value = fabs(value_at(r) / near->value - 1);
  double moved = fabs((zp_closing_gap(&r->statics, NULL) - gap) / (sides * look_step(r)));
  return near->room - fmax(value, moved * ZP_FOLD_RIPPLE);
}

/* Go from a limit point to the highest crest of the ripple to which it may belong. => where; if a stable state is
 * higher, a track continues from it */
static ZpAround climb(ZpRest *r, ZpLimit *limit, double sign) {
  enum { MOST = 20 };
  ZpAround around = ZP_CREST_HIGHER;
  for (int k = 0; k < MOST && around == ZP_CREST_HIGHER; k++) {
    zp_quasistatic_note(r, limit, ZP_TRACK_FOLD);
    around = zp_quasistatic_look_around(r, limit, sign);
  }
  if (around != ZP_STABLE_HIGHER) zp_rest_go_to(r, limit->state);
  return around;
}

bool zp_quasistatic_climb(ZpRest *r, double target, ZpLimit *limit) {
  enum { MOST = 20 };
  const double m = zp_branch_parameter_at(&r->square, target), sign = m > parameter(r) ? 1 : -1;
  choose(r, &r->square);
  for (int k = 0; k < MOST; k++) {
    ZpAround around = climb(r, limit, sign);
    if (around != ZP_STABLE_HIGHER) return around == ZP_NOTHING_HIGHER;
    if (zp_track(&r->track, m) != ZP_TRACK_FOLD) return false;
  }
  return false;
}

/* -- a slow change -------------------------------------------------------------------------------- */

/* Is the present point a closed state that cannot be? Beyond it nothing tells when the actuator opens. */
static bool has_become_impossible(ZpRest *r) {
  return r->was_closed && zp_quasistatic_is_closed(r) && zp_statics_fault(&r->statics);
}

/* Change the parameter slowly to `target`, or until the actuator closes or opens: that limit is `at`. The first limit
 * point on the way that is not a ripple is `first` (NULL: not requested). A limit point further than `enough` ends the
 * search. */
static ZpQuasistaticEnd change(ZpRest *r, double target, double enough, ZpLimit *at, ZpLimit *first) {
  enum { MOST = 1000 }; /* limit points; there are many ripples where a front passes node by node */
  double sign = target > parameter(r) ? 1 : -1;
  r->was_closed = zp_quasistatic_is_closed(r);
  for (int k = 0; k < MOST; k++) {
    if (zp_statics_asked_to_stop(&r->statics)) return ZP_QUASISTATIC_STOPPED;
    ZpTrackEnd end = zp_track(&r->track, target);
    if (end == ZP_TRACK_ARRIVED) return ZP_QUASISTATIC_ARRIVED;
    if (end == ZP_TRACK_LOST) { /* while it was stable: resume from a state a little further */
      if (!fall(r, sign, FROM_LOST) || zp_quasistatic_is_closed(r) != r->was_closed) return ZP_QUASISTATIC_LOST;
      continue;
    }
    zp_quasistatic_note(r, at, end);
    if (has_become_impossible(r)) return ZP_QUASISTATIC_IMPOSSIBLE;
    if (end == ZP_TRACK_EVENT) return ZP_QUASISTATIC_CHANGED;
    if (climb(r, at, sign) == ZP_STABLE_HIGHER) continue;
    if (sign * (parameter(r) - enough) >= 0) return ZP_QUASISTATIC_BEYOND;
    if (sign * (parameter(r) - target) > 0) { /* a lower crest of this ripple is before it: fall from there */
      zp_branch_set(r->track.fold.system, target);
      bool stays = zp_newton_good(zp_statics_relax_until(&r->statics, NULL, NULL).end);
      return stays ? ZP_QUASISTATIC_ARRIVED : ZP_QUASISTATIC_LOST;
    }
    double m = parameter(r), gap = open_gap(&r->statics);
    bool found = fall_from(r, at, sign), jumped = zp_quasistatic_is_closed(r) != r->was_closed;
    bool is_first = first && first->end == ZP_TRACK_ARRIVED;
    if (is_first && (!found || jumped || !is_ripple(r, m, gap, sign))) zp_quasistatic_copy(r, at, first);
    if (!found) return ZP_QUASISTATIC_LOST;
    if (jumped) return ZP_QUASISTATIC_CHANGED;
    if (has_become_impossible(r)) return ZP_QUASISTATIC_IMPOSSIBLE;
  }
  return ZP_QUASISTATIC_LOST;
}

bool zp_quasistatic_fold_of_load(ZpRest *r, const double *null) {
  choose(r, &r->load);
  memcpy(r->track.fold.null, null, r->statics.n * sizeof *null);
  return zp_fold_solve(&r->track.fold) && r->track.fold.negative == 0;
}

bool zp_quasistatic_event_of_load(ZpRest *r, double gap) {
  choose(r, &r->load);
  return zp_fold_event(&r->track.fold, zp_closing_gap, gap, ZP_FOLD_EXACT) && r->track.fold.negative == 0;
}

/* March to `target` => the limit at which this ends, if there is one. */
static ZpTrackEnd go_to_first(ZpRest *r, double target, ZpLimit *at) {
  ZpTrackEnd end = zp_track(&r->track, target);
  zp_limit_none(at, NULL);
  if (end == ZP_TRACK_FOLD || end == ZP_TRACK_EVENT) zp_quasistatic_note(r, at, end);
  return end;
}

ZpTrackEnd zp_quasistatic_drop_load(ZpRest *r, ZpLimit *at) {
  choose(r, &r->load);
  return go_to_first(r, 0, at);
}

ZpTrackEnd zp_quasistatic_first(ZpRest *r, double top, ZpLimit *at) {
  choose(r, &r->square);
  return go_to_first(r, zp_branch_parameter_at(&r->square, top), at);
}

ZpQuasistaticEnd zp_quasistatic_close_at(ZpRest *r, double top, double enough, ZpLimit *at) {
  choose(r, &r->square);
  return change(r, zp_branch_parameter_at(&r->square, top), zp_branch_parameter_at(&r->square, enough), at, NULL);
}

bool zp_quasistatic_falls_closed(ZpRest *r, const ZpLimit *limit) {
  return fall_from(r, limit, 1) && zp_quasistatic_is_closed(r);
}

/* The gap that closes, above minus twice the one that counts as closed. */
static double gap_above_overlap(void *self, double *row) {
  const ZpStatics *s = self;
  return zp_closing_gap(self, row) + 2 * s->member->closed;
}

ZpQuasistaticEnd zp_quasistatic_ramp_voltage(ZpRest *r, double top, ZpLimit *pull_in, ZpLimit *closing) {
  static const char *const lost = "the hanging state was lost as the voltage rose";
  zp_limit_none(pull_in, "no limit point up to drive.voltage");
  zp_limit_none(closing, "it does not close up to drive.voltage");
  choose(r, &r->square);
  ZpQuasistaticEnd end = change(r, zp_branch_parameter_at(&r->square, top), INFINITY, closing, pull_in);
  if (end == ZP_QUASISTATIC_LOST) lose(closing, lost);
  if (end == ZP_QUASISTATIC_LOST && isnan(pull_in->value)) lose(pull_in, lost);
  if (end == ZP_QUASISTATIC_ARRIVED) zp_limit_none(closing, "it does not close up to drive.voltage");
  bool gradually = end == ZP_QUASISTATIC_CHANGED && closing->end == ZP_TRACK_EVENT;
  if (!gradually || !isnan(pull_in->value)) return end;
  /* Is there a limit point further up, before faces overlap by as much as they were apart? Two that are close to each
   * other are seen along the gap only. */
  r->track.event = gap_above_overlap;
  if (zp_track(&r->track, zp_branch_parameter_at(&r->square, top)) == ZP_TRACK_FOLD)
    zp_quasistatic_note(r, pull_in, ZP_TRACK_FOLD);
  return end;
}

/* Is the state found closed, possible and stable? */
static bool has_closed(ZpRest *r, ZpNewtonInfo info) {
  return zp_newton_good(info.end) && zp_quasistatic_is_closed(r) && !zp_statics_fault(&r->statics) &&
         zp_statics_stable(&r->statics);
}

bool zp_quasistatic_close(ZpRest *r, double top) {
  enum { MOST = 30 };
  r->statics.U = top;
  bool near = zp_quasistatic_is_closed(r);
  if (near && has_closed(r, zp_statics_solve(&r->statics, MOST))) return true;
  return has_closed(r, zp_statics_close(&r->statics, top));
}

ZpQuasistaticEnd zp_quasistatic_lower(ZpRest *r, const ZpLimit *closing, ZpLimit *release) {
  zp_limit_none(release, "it stays closed down to 0 V");
  choose(r, &r->square);
  ZpQuasistaticEnd end = change(r, 0, -INFINITY, release, NULL);
  if (end == ZP_QUASISTATIC_ARRIVED) zp_limit_none(release, "it stays closed down to 0 V");
  if (end == ZP_QUASISTATIC_LOST) lose(release, "the closed state was lost as the voltage fell");
  if (end == ZP_QUASISTATIC_IMPOSSIBLE)
    zp_limit_none(release, "as the voltage fell, faces of the closed state came to lie inside each other");
  if (end == ZP_QUASISTATIC_CHANGED && release->value > closing->value) release->value = closing->value;
  return end;
}
