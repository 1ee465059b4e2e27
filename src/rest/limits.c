/* The largest load that a voltage lifts follows its definition: the largest under which a voltage that rises from 0
 * closes the actuator at most at this voltage. A candidate is the answer only if the voltage that rises under this load
 * closes the actuator there, and does not close it under larger loads. If it closes elsewhere, its limit leads to the
 * next candidate. */
#include "rest/limits.h"

#include <math.h>
#include <string.h>

#include "actuator/resolution.h"

typedef struct Finder {
  ZpRest *rest;
  const ZpModel *model;
  const ZpLimits *near; /* of a neighbour; NULL: none */
  ZpLimits *limits;
  double top;              /* drive.voltage, V */
  double least, most;      /* loads; it closes under the former, but not under the latter; 0, INFINITY: not known, kg */
  ZpQuasistaticEnd raised; /* how the last rise of the voltage under such a load ended */
  double at_least, at_most; /* voltages that close it under these, V; NAN: not known */
  bool follows;             /* closing was taken to be at the pull-in, as in the neighbour */
} Finder;

/* Hang without voltage, from close by => state, gap; this determines when it counts as closed. */
static bool hang(Finder *f, double *state, double *gap) {
  ZpStatics *s = &f->rest->statics;
  f->limits->info = zp_statics_find_rest(s);
  if (!zp_newton_good(f->limits->info.end) || !zp_statics_bias(s) || !zp_statics_stable(s)) return false;
  zp_rest_save(f->rest, state);
  *gap = zp_closing_gap(s, NULL);
  zp_quasistatic_start(f->rest);
  return true;
}

static const double far = 1.2;   /* times the voltage asked for: as far as a closing voltage matters */
static const double same = 1e-7; /* of the voltage */

static bool is_at_top(const Finder *f, double within) {
  return fabs(f->limits->at.value / f->top - 1) < within;
}

/* Does the voltage asked for close it under this load? At most at `voltage`, V, or at least there; NAN: not known. */
static void narrow(Finder *f, double load, bool closes, double voltage) {
  if (closes ? load <= f->least : load >= f->most) return;
  *(closes ? &f->least : &f->most) = load;
  *(closes ? &f->at_least : &f->at_most) = voltage;
}

/* Hang without voltage under this load, kg; from then on the actuator counts as closed as under this load. False if it
 * does not hang. From the state under another load, ribbons that weigh more than the load could end up lying on each
 * other. */
static bool hang_under(Finder *f, double load) {
  zp_statics_lay_straight(&f->rest->statics);
  f->rest->statics.load = load;
  double gap;
  return hang(f, f->limits->hung, &gap);
}

/* -- the largest load: a voltage that rises under a load ----------------------------------------------- */

/* A limit point is at the voltage, as accurately as it was solved: if the actuator falls closed from there, this is
 * where it closes. Else the next limit is above. */
static ZpQuasistaticEnd fall_at_top(Finder *f) {
  bool closes = zp_quasistatic_falls_closed(f->rest, &f->limits->at);
  if (closes) zp_rest_save(f->rest, f->limits->lifted);
  if (closes) return ZP_QUASISTATIC_CHANGED;
  if (zp_quasistatic_is_closed(f->rest)) return ZP_QUASISTATIC_LOST;
  zp_limit_none(&f->limits->at, NULL);
  return zp_quasistatic_close_at(f->rest, far * f->top, f->top, &f->limits->at);
}

/* Raise the voltage under this load until it closes, or to the first limit that is not below the voltage asked for.
 * That limit is `at`. */
static ZpQuasistaticEnd raise(Finder *f, double load) {
  zp_limit_none(&f->limits->at, NULL);
  if (!hang_under(f, load)) return ZP_QUASISTATIC_LOST;
  if (zp_quasistatic_is_closed(f->rest)) zp_quasistatic_note(f->rest, &f->limits->at, ZP_TRACK_ARRIVED);
  if (zp_quasistatic_is_closed(f->rest)) return ZP_QUASISTATIC_CHANGED;
  ZpQuasistaticEnd end = zp_quasistatic_close_at(f->rest, far * f->top, (1 - same) * f->top, &f->limits->at);
  return end == ZP_QUASISTATIC_BEYOND && is_at_top(f, same) ? fall_at_top(f) : end;
}

/* Does the voltage close the actuator under this load? */
static bool closes_under(Finder *f, double load) {
  f->raised = raise(f, load);
  bool closes = f->raised == ZP_QUASISTATIC_CHANGED && !(f->limits->at.value > (1 + same) * f->top);
  narrow(f, load, closes, f->limits->at.value);
  return closes;
}

/* Raise the voltage to the one asked for under this load. ZP_QUASISTATIC_ARRIVED if the actuator then hangs. */
static ZpQuasistaticEnd hang_at_top(Finder *f, double load) {
  if (!hang_under(f, load)) return ZP_QUASISTATIC_LOST;
  ZpQuasistaticEnd end = zp_quasistatic_close_at(f->rest, f->top, INFINITY, &f->limits->at);
  narrow(f, load, end == ZP_QUASISTATIC_CHANGED, NAN);
  return end;
}

/* -- gradual closing -------------------------------------------------------------------------------- */

/* To the load at which the gap is `closed` => the gap at which it counts as closed under that load; NAN: not found */
static double closed_beyond(Finder *f, double closed) {
  ZpRest *rest = f->rest;
  if (!zp_quasistatic_event_of_load(rest, closed)) return NAN;
  zp_rest_save(rest, f->limits->at.state);
  bool hangs = hang_under(f, rest->statics.load);
  zp_rest_go_to(rest, f->limits->at.state);
  return hangs ? rest->track.limit : (double)NAN;
}

/* From the present point, at the voltage, to the load at which the actuator closes gradually, by the gap at which it
 * counts as closed under this load, about `closed`, m, which the secant method solves. False if there is none nearby.
 */
static bool go_to_event(Finder *f, double closed) {
  enum { MOST = 12 };
  static const double exact = 1e-9; /* of the gap */
  double before = NAN, off_before = NAN;
  for (int k = 0; k < MOST; k++) {
    double off = closed_beyond(f, closed) - closed;
    if (isnan(off)) return false;
    if (fabs(off) <= exact * closed) return true;
    double slope = k > 0 ? (off - off_before) / (closed - before) : -1;
    before = closed;
    off_before = off;
    closed -= off / slope;
  }
  return false;
}

/* Does the voltage close the actuator gradually under this load, without a limit point before? */
static bool closes_gradually(Finder *f, double load) {
  return hang_under(f, load) && zp_quasistatic_first(f->rest, (1 + same) * f->top, &f->limits->at) == ZP_TRACK_EVENT;
}

/* Is the limit point under this load, at the voltage asked for, the first that a rising voltage meets? */
static bool is_met_first(Finder *f, double load) {
  return hang_under(f, load) && zp_quasistatic_first(f->rest, far * f->top, &f->limits->at) == ZP_TRACK_FOLD &&
         is_at_top(f, same);
}

/* From the present point, at the voltage under a large load, lower the load => its first limit, a candidate, if there
 * is one. The load falls on until the gap is what counts as closed under the load itself; under a larger one it is
 * larger. */
static void drop_load(Finder *f, ZpLimit *limit) {
  enum { MOST = 30 };
  static const double near = 0.8; /* of the gap: the rest is solved directly */
  ZpRest *rest = f->rest;
  zp_quasistatic_drop_load(rest, limit);
  for (int k = 0; k < MOST && limit->end == ZP_TRACK_EVENT; k++) {
    double closed = rest->track.limit;
    if (!hang_under(f, limit->value)) return;
    zp_rest_go_to(rest, limit->state);
    if (rest->track.limit > near * closed) break;
    zp_quasistatic_drop_load(rest, limit);
  }
  if (limit->end == ZP_TRACK_EVENT && go_to_event(f, rest->track.limit))
    zp_quasistatic_note(rest, limit, ZP_TRACK_EVENT);
}

/* -- by definition ---------------------------------------------------------------------------------- */

/* From the limit at a higher or lower voltage => the load with a limit at this voltage, kg; NAN: it was not found. A
 * load that is known may itself be the largest. */
static double follow(Finder *f) {
  ZpRest *rest = f->rest;
  zp_rest_go_to(rest, f->limits->at.state);
  rest->statics.U = f->top;
  bool found = f->limits->at.end == ZP_TRACK_FOLD ? zp_quasistatic_fold_of_load(rest, f->limits->at.null)
                                                  : go_to_event(f, rest->track.limit);
  double load = rest->statics.load;
  return found && load > (1 - same) * f->least && load < (1 + same) * f->most ? load : (double)NAN;
}

/* Between the loads that are known, by the voltages that close it under them if these are known, too. */
static double middle(const Finder *f) {
  static const double wide = 2, margin = 0.1;
  if (f->least == 0 || isinf(f->most)) return f->least > 0 ? wide * f->least : f->most / wide;
  double part = (f->top - f->at_least) / (f->at_most - f->at_least);
  if (!(part > 0 && part < 1)) return sqrt(f->least * f->most);
  return f->least + fmin(fmax(part, margin), 1 - margin) * (f->most - f->least);
}

/* The closing voltage jumps above the load under which it last closed: this is no limit point. */
static bool settle_at_jump(Finder *f, ZpLimit *limit) {
  raise(f, f->least);
  zp_quasistatic_copy(f->rest, &f->limits->at, limit);
  limit->end = ZP_TRACK_ARRIVED;
  limit->value = f->least;
  return true;
}

/* The largest load below `most`: where the voltage closes it, or below which its closing voltage jumps. False if there
 * is none. */
static bool find_below_most(Finder *f, double load, ZpLimit *limit) {
  enum { MOST = 100 };
  static const double near = 0.1; /* of the voltage: a limit nearer than this leads to the one asked for */
  static const double narrowest = 3e-7, lightest = 1e-12; /* of the load; kg */
  static const double exact = 1e-10;                      /* of the voltage: a limit is as accurate */
  bool nearer = false;                                    /* is this load nearer to one that was found? */
  for (int k = 0; k < MOST && !zp_statics_asked_to_stop(&f->rest->statics) && f->most > lightest; k++) {
    if (f->most / f->least - 1 < narrowest && !nearer) return settle_at_jump(f, limit);
    bool found = closes_under(f, load) && is_at_top(f, same);
    if (found) zp_quasistatic_copy(f->rest, &f->limits->at, limit);
    if (found) limit->value = load;
    if (nearer || (found && is_at_top(f, exact))) return true;
    bool follows = found || (k % 2 == 0 && is_at_top(f, near));
    load = follows ? follow(f) : (double)NAN;
    if (found && isnan(load)) return true;
    nearer = found;
    if (isnan(load)) load = middle(f);
  }
  return false;
}

/* Does it close under any of these larger loads? Then `least` is that one. Where the voltage does not even meet a limit
 * point, but for lower crests of the ripple of one that is above it, it meets none under larger loads. */
static bool closes_above(Finder *f, double load, bool *first) {
  static const double more[] = {1e-3, 1e-2, 3e-2, 0.1, 0.3};
  bool closes = false, none = false;
  for (size_t k = 0; k < sizeof more / sizeof more[0] && !closes && !none; k++) {
    bool hangs = hang_under(f, load * (1 + more[k]));
    none = hangs && (zp_quasistatic_first(f->rest, far * f->top, &f->limits->at) == ZP_TRACK_ARRIVED ||
                     f->limits->at.value > f->top);
    closes = !none && closes_under(f, load * (1 + more[k]));
    none = none || (!closes && f->raised == ZP_QUASISTATIC_BEYOND && f->rest->falls == 0);
    *first = none && k == 0;
  }
  f->most = INFINITY;
  return closes;
}

/* From a candidate, if there is one, to the largest load. True if its limit is the first that the voltage meets. */
static bool settle_load(Finder *f, ZpLimit *limit) {
  enum { MOST = 10 };
  double least = (1 - same) * f->least; /* the load known to close may itself be the largest */
  bool candidate = limit->end != ZP_TRACK_ARRIVED && limit->value > least && limit->value < f->most, first = false;
  double load = candidate ? limit->value : middle(f);
  zp_limit_none(limit, "it does not close at drive.voltage even without load");
  if (!candidate && f->least == 0 && !closes_under(f, 0)) return false;
  for (int k = 0; k < MOST && find_below_most(f, load, limit) && closes_above(f, limit->value, &first); k++)
    load = middle(f);
  return first;
}

/* -- from a neighbour ------------------------------------------------------------------------------- */

/* A state of the neighbour, scaled to this actuator, under its own load. */
static void take(Finder *f, const double *state) {
  ZpStatics *s = &f->rest->statics;
  double own = s->load, ratio = f->model->L / f->near->L;
  f->rest->system.restore(s, state);
  for (size_t k = 0; k < s->members; k++)
    zp_stretch(s->member[k].model, ratio, s->member[k].q);
  s->load = own;
  zp_statics_evaluate(s);
}

/* The neighbour's limit, under its load at drive.voltage if it is the largest load. */
static void take_limit(Finder *f, const ZpLimit *near, bool load) {
  ZpStatics *s = &f->rest->statics;
  take(f, near->state);
  if (load) s->load = near->value;
  if (load) s->U = f->top;
  memcpy(f->rest->track.fold.null, near->null, s->n * sizeof *near->null);
}

/* Is the mesh too fine to hold a front between nodes, where the actuator could stop although the neighbour does not? */
static bool is_fine(const Finder *f, double voltage) {
  static const double fine = 3; /* elements */
  return zp_mesh_resolution(f->model, voltage) > fine;
}

/* Is the present point the limit? It is not far from the neighbour's. A limit point is met before the gap at which the
 * actuator counts as closed. */
static bool is_limit(Finder *f, const ZpLimit *near, ZpLimitKind kind) {
  static const double farthest = 0.5;
  ZpStatics *s = &f->rest->statics;
  const bool load = kind == ZP_LIMIT_LOAD, closed = zp_closing_gap(s, NULL) <= f->rest->track.limit;
  const double value = load ? s->load : s->U;
  const bool before = near->end == ZP_TRACK_EVENT || closed == (kind == ZP_LIMIT_RELEASE);
  const bool within = load ? value > 0 : value <= f->top;
  return before && within && fabs(value / near->value - 1) <= farthest;
}

/* Is the largest load so far from the neighbour's that another limit point may come before it? */
static bool is_far(const Finder *f) {
  static const double farthest = 0.02; /* of the load */
  return fabs(f->limits->limit[ZP_LIMIT_LOAD].value / f->near->limit[ZP_LIMIT_LOAD].value - 1) > farthest;
}

/* Is the limit point at the present point the highest crest of its ripple? The largest load must be; a voltage goes on
 * to that crest. */
static bool goes_to_crest(Finder *f, const ZpLimit *near, ZpLimitKind kind) {
  ZpLimit *limit = &f->limits->limit[kind];
  f->rest->track.fold.system = &f->rest->square; /* crests under this load */
  if (limit->room > 0) return true;
  if (kind == ZP_LIMIT_LOAD) return zp_quasistatic_look_around(f->rest, limit, 1) == ZP_NOTHING_HIGHER;
  const double target = kind == ZP_LIMIT_RELEASE ? 0 : f->top;
  return zp_quasistatic_climb(f->rest, target, limit) && is_limit(f, near, kind);
}

/* Solve for a limit, starting from the neighbour's. True if this is the limit: it is stable except along its null
 * vector, and no crest of its ripple is higher. */
static bool from_neighbour(Finder *f, ZpLimitKind kind) {
  const ZpLimit *near = f->near ? &f->near->limit[kind] : NULL;
  if (!near || (near->end != ZP_TRACK_FOLD && near->end != ZP_TRACK_EVENT)) return false;
  ZpRest *rest = f->rest;
  ZpFold *solver = &rest->track.fold;
  if (!is_fine(f, kind == ZP_LIMIT_LOAD ? f->top : near->value)) return false;
  const bool load = kind == ZP_LIMIT_LOAD, fold = near->end == ZP_TRACK_FOLD;
  solver->system = load ? &rest->load : &rest->square;
  take_limit(f, near, load);
  const double near_gap = zp_closing_gap(&rest->statics, NULL);
  bool found = fold   ? zp_fold_approach(solver)
               : load ? go_to_event(f, near_gap)
                      : zp_fold_event(solver, zp_closing_gap, rest->track.limit, ZP_FOLD_EXACT);
  if (!found || solver->negative > 0 || !is_limit(f, near, kind)) return false;
  ZpLimit *limit = &f->limits->limit[kind];
  zp_quasistatic_note(rest, limit, near->end);
  limit->room = zp_quasistatic_room_left(rest, near, near_gap);
  bool highest = !fold || goes_to_crest(f, near, kind);
  f->limits->warm += highest;
  return highest;
}

/* Is the pull-in at a shape like the neighbour's, by the part of the gap that is left? */
static bool pulls_in_alike(Finder *f) {
  static const double farthest = 0.1;
  const double left = zp_closing_gap(&f->rest->statics, NULL) / f->limits->hanging;
  take(f, f->near->limit[ZP_LIMIT_PULL_IN].state);
  const double near_left = zp_closing_gap(&f->rest->statics, NULL) * f->near->L / (f->near->hanging * f->model->L);
  return fabs(left - near_left) <= farthest;
}

/* The first limit point on the own way, where the neighbour's is. */
static bool pulls_in(Finder *f) {
  ZpLimit *limit = &f->limits->limit[ZP_LIMIT_PULL_IN];
  zp_rest_go_to(f->rest, f->limits->start);
  bool found = zp_quasistatic_first(f->rest, f->top, limit) == ZP_TRACK_FOLD &&
               zp_quasistatic_climb(f->rest, f->top, limit) && pulls_in_alike(f);
  f->limits->warm += found;
  return found;
}

/* Closing is by the limit point of the pull-in, in the neighbour and here: it falls closed from there as the neighbour
 * does. */
static bool closes_as_neighbour(Finder *f) {
  const ZpLimit *near = f->near ? f->near->limit : NULL;
  ZpLimit *limit = f->limits->limit;
  if (!near || near[ZP_LIMIT_CLOSING].value != near[ZP_LIMIT_PULL_IN].value) return false;
  if (!is_fine(f, near[ZP_LIMIT_PULL_IN].value)) return false;
  if (!from_neighbour(f, ZP_LIMIT_PULL_IN) && !pulls_in(f)) return false;
  zp_quasistatic_copy(f->rest, &limit[ZP_LIMIT_PULL_IN], &limit[ZP_LIMIT_CLOSING]);
  return true;
}

/* -- the limits ------------------------------------------------------------------------------------- */

/* A voltage that rises to drive.voltage, step by step. */
static ZpQuasistaticEnd ramp_voltage(Finder *f) {
  ZpLimit *limit = f->limits->limit;
  zp_rest_go_to(f->rest, f->limits->start);
  ZpQuasistaticEnd end =
      zp_quasistatic_ramp_voltage(f->rest, f->top, &limit[ZP_LIMIT_PULL_IN], &limit[ZP_LIMIT_CLOSING]);
  f->limits->arrives = end == ZP_QUASISTATIC_ARRIVED;
  if (f->limits->arrives) zp_rest_save(f->rest, f->limits->top);
  return end;
}

static ZpQuasistaticEnd raise_voltage(Finder *f) {
  f->follows = closes_as_neighbour(f);
  return f->follows ? ZP_QUASISTATIC_CHANGED : ramp_voltage(f);
}

/* The closed state at drive.voltage, from the neighbour's, from the state to which the voltage has led, or from the
 * straight shape. False if there is none. */
static bool find_closed(Finder *f) {
  ZpLimits *limits = f->limits;
  if (f->near && f->near->closes) take(f, f->near->closed);
  limits->closes = zp_quasistatic_close(f->rest, f->top);
  if (limits->closes) zp_rest_save(f->rest, limits->closed);
  return limits->closes;
}

/* From closed at drive.voltage down to 0. Only the way down tells whether closed faces of free ends slide along each
 * other before they open. */
static void lower_voltage(Finder *f) {
  ZpLimit *limit = f->limits->limit;
  const ZpTopology *t = &f->model->topology;
  bool closes = find_closed(f), slides = zp_is_open_pair(t);
  f->limits->opens_first = f->near && f->near->opens_first && !slides && from_neighbour(f, ZP_LIMIT_RELEASE);
  if (f->limits->opens_first) return;
  zp_limit_none(&limit[ZP_LIMIT_RELEASE], "it is not closed at drive.voltage");
  if (!closes) return;
  zp_rest_go_to(f->rest, f->limits->closed);
  const int before = f->rest->falls;
  zp_quasistatic_lower(f->rest, &limit[ZP_LIMIT_CLOSING], &limit[ZP_LIMIT_RELEASE]);
  const int at_limit = limit[ZP_LIMIT_RELEASE].end == ZP_TRACK_FOLD; /* it falls open, or opens gradually */
  f->limits->opens_first = f->rest->falls == before + at_limit;
}

/* Closing is not at the pull-in, where that of the neighbour is: it opens above, or is not closed at drive.voltage. */
static bool closes_later(const Finder *f) {
  const ZpLimit *limit = f->limits->limit;
  return f->follows && (!f->limits->closes || limit[ZP_LIMIT_RELEASE].value >= limit[ZP_LIMIT_CLOSING].value);
}

/* Hang at drive.voltage under a load so large that it does not close. False if none was found. */
static bool hang_heavy(Finder *f) {
  enum { MOST = 12 };
  static const double lightest = 1e-3, heavier = 3; /* kg; than what forces as the voltage's square could lift */
  double top = f->top, closing = f->limits->limit[ZP_LIMIT_CLOSING].value;
  double load = fmax(f->model->whole->load.mass, lightest) * heavier * (top / closing) * (top / closing);
  for (int k = 0; k < MOST; k++, load *= 4) {
    ZpQuasistaticEnd end = hang_at_top(f, load);
    if (end == ZP_QUASISTATIC_ARRIVED) return true;
    if (end == ZP_QUASISTATIC_LOST || end == ZP_QUASISTATIC_STOPPED) return false;
  }
  return false;
}

/* Is its limit point the first that the voltage meets, and is the state to which the neighbour falls from there closed
 * here, too? If it closes gradually, does it without a jump before? */
static bool falls_as_neighbour(Finder *f) {
  const ZpLimit *limit = &f->limits->limit[ZP_LIMIT_LOAD];
  if (limit->end == ZP_TRACK_EVENT) return closes_gradually(f, limit->value);
  if (is_far(f) ? !is_met_first(f, limit->value) : !hang_under(f, limit->value)) return false;
  take(f, f->near->lifted);
  bool closed = zp_quasistatic_close(f->rest, f->top);
  zp_rest_save(f->rest, f->limits->lifted);
  return closed;
}

/* From a neighbour: only if the voltage meets no other limit point before. */
static bool lift_as_neighbour(Finder *f) {
  bool trusted = f->near && f->near->first;
  bool found = trusted && from_neighbour(f, ZP_LIMIT_LOAD);
  f->limits->first = found && falls_as_neighbour(f);
  if (found && !f->limits->first) f->limits->warm--;
  return f->limits->first;
}

/* The largest load. The search starts where a load that falls at drive.voltage meets its first limit. */
static void lift(Finder *f, bool closes) {
  ZpLimit *limit = &f->limits->limit[ZP_LIMIT_LOAD];
  f->least = 0;
  f->most = INFINITY;
  f->at_least = f->at_most = NAN;
  if (lift_as_neighbour(f)) return;
  narrow(f, f->model->whole->load.mass, closes, f->limits->limit[ZP_LIMIT_CLOSING].value);
  bool hangs = closes ? hang_heavy(f) : hang_under(f, f->model->whole->load.mass);
  zp_limit_none(limit, "no load was found that it cannot lift");
  if (!hangs) return;
  if (!closes) zp_rest_go_to(f->rest, f->limits->top);
  drop_load(f, limit);
  f->limits->first = settle_load(f, limit);
  if (limit->end == ZP_TRACK_EVENT) hang_under(f, limit->value);
}

/* Those from `first` on do not exist. */
static void none_from(Finder *f, int first, const char *reason) {
  for (int k = first; k < ZP_LIMIT_KINDS; k++)
    zp_limit_none(&f->limits->limit[k], reason);
}

/* Why no load is searched; NULL: it is. */
static const char *no_load(const ZpModel *model, bool load) {
  if (!load) return "it was not searched";
  if (zp_is_network(model)) return "each body has a mass of its own";
  if (model->network->opposed) return "a heavy load closes the lower antagonist";
  return model->def.gravity > 0 && model->fall[1] < 0 ? NULL
                                                      : "gravity does not pull the platform down, so a mass is no load";
}

void zp_limits_find(ZpRest *rest, const ZpLimits *near, bool load, ZpLimits *limits) {
  const ZpModel *model = rest->statics.member->model;
  Finder f = {.rest = rest, .model = model, .near = near, .limits = limits, .top = zp_drive_voltage(model)};
  none_from(&f, 0, "without a voltage there is none");
  if (near && near->hangs) take(&f, near->start);
  limits->hangs = hang(&f, limits->start, &limits->hanging);
  if (!limits->hangs || !model->field || f.top == 0) return;
  none_from(&f, 0, "a pouch zips steadily");
  if (model->pouch.w > 0) return;
  none_from(&f, 0, "it hangs closed");
  if (limits->hanging <= zp_closed_opening(model, 0)) return;
  ZpQuasistaticEnd up = raise_voltage(&f);
  if (zp_def_shorts(&model->def)) none_from(&f, ZP_LIMIT_CLOSING, "when closed, it is a short circuit");
  if (zp_def_shorts(&model->def)) return;
  none_from(&f, ZP_LIMIT_RELEASE, "it was not searched");
  if (up == ZP_QUASISTATIC_STOPPED) return;
  lower_voltage(&f);
  if (closes_later(&f)) { /* neither limit is that of the neighbour */
    limits->warm = 0;
    up = ramp_voltage(&f);
    lower_voltage(&f);
  }
  rest->statics.load = model->whole->load.mass;
  const char *reason = up == ZP_QUASISTATIC_LOST ? "it was not searched" : no_load(model, load);
  if (reason)
    zp_limit_none(&limits->limit[ZP_LIMIT_LOAD], reason);
  else
    lift(&f, up == ZP_QUASISTATIC_CHANGED);
}

bool zp_limits_lost(const ZpLimits *limits) {
  bool lost = false;
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    lost |= limits->limit[k].end == ZP_TRACK_LOST;
  return lost;
}

/* -- limits that outlive their model ------------------------------------------------------------------ */

static size_t reserve(ZpLimits *limits, void *block) {
  ZpArena arena = {block, 0};
  double **states[] = {&limits->start, &limits->top, &limits->closed, &limits->hung, &limits->lifted};
  for (size_t k = 0; k < sizeof states / sizeof states[0]; k++)
    *states[k] = zp_arena_take(&arena, limits->save);
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_limit_reserve(&limits->limit[k], limits->save, limits->equations, &arena);
  zp_limit_reserve(&limits->at, limits->save, limits->equations, &arena);
  return arena.used;
}

ZpLimits *zp_limits_create(const ZpRest *rest) {
  ZpLimits *limits = zp_calloc(1, sizeof *limits);
  if (!limits) return NULL;
  *limits =
      (ZpLimits){.save = zp_rest_save_size(rest), .equations = rest->statics.n, .L = rest->statics.member->model->L};
  limits->memory = zp_calloc(1, reserve(limits, NULL));
  if (limits->memory) reserve(limits, limits->memory);
  if (limits->memory) return limits;
  zp_free(limits);
  return NULL;
}
