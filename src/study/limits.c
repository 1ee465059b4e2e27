/* Study `limits`: pull-in, closing, release and the largest load, each solved as the limit point or event that it is,
 * without following the curve. Theory, section 10.
 *
 * The voltage (its square) or the load is changed slowly: zp_march goes to the next limit point or to where the
 * actuator counts as closed; from a limit point the state falls to what is beyond, and it goes on until the actuator
 * has closed or opened. */
#include "study/limits.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "study/notes.h"
#include "study/studies.h"

static const ZpColumn columns[] = {
    {"limit", "1", "0: pull-in, 1: closing, 2: release, 3: largest load"},
    {"voltage_V", "V", "potential difference of the electrodes"},
    {"load_kg", "kg", "mass hung on the actuator"},
    {"stroke_m", "m", "height of the clip over the lower platform, signed"},
    {"opening_m", "m", "distance of the platforms' faces"},
    {"zipped_length_m", "m", "closed length from the clip, one half"},
    {"charge_C", "C", "charge on the electrodes"},
    {"capacitance_F", "F", "capacitance of the electrodes"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

typedef struct Scalar {
  const char *name, *unit;
} Scalar;

static const Scalar scalars[] = {
    {"pull_in_voltage_V", "V"}, {"closing_voltage_V", "V"}, {"release_voltage_V", "V"}, {"max_load_kg", "kg"}};

typedef struct Finder {
  const ZpModel *model;
  const ZpHooks *hooks;
  ZpRest rest;
  ZpBranchSystem square, load; /* along the voltage's square, along the load */
  ZpMarch march;
  ZpLimits *limits;
  const ZpLimits *near; /* of a neighbour; NULL: none */
  double closed;        /* gap at which it counts as closed, m */
  void *held;           /* a state to come back to */
  void *top;            /* the state at drive.voltage under the own load, where it hangs there */
  bool interrupted;
} Finder;

static void carve(void *user, ZpCarver *carver) {
  Finder *f = user;
  ZpStatics *s = &f->rest.statics;
  f->square = zp_closing_by_square(s);
  f->load = zp_statics_branch(s, ZP_ALONG_LOAD);
  zp_march_carve(&f->march, &f->square, s->assembly.bandwidth, s->assembly.symmetric, &f->rest.branch.newton, carver);
  f->held = zp_carve(carver, zp_rest_save_size(&f->rest));
  f->top = zp_carve(carver, zp_rest_save_size(&f->rest));
}

static bool asked_to_stop(Finder *f) {
  const ZpHooks *hooks = f->hooks;
  if (hooks && hooks->progress && hooks->progress(hooks->user, "limits", 0)) f->interrupted = true;
  return f->interrupted;
}

static bool is_closed(Finder *f) {
  return zp_closing_gap(&f->rest.statics, NULL) <= f->closed;
}

static void go_to(Finder *f, const double *state) {
  f->square.restore(&f->rest.statics, state);
  zp_statics_stable(&f->rest.statics, &f->rest.branch.newton);
}

/* -- a slow change ---------------------------------------------------------------------------------- */

static bool along_load(const Finder *f) {
  return f->march.fold.system == &f->load;
}

/* The parameter, changed by this share of the voltage or of the load. */
static double changed(const Finder *f, double m, double share) {
  double factor = 1 + share;
  return along_load(f) ? m * factor : m * factor * factor;
}

static double parameter(Finder *f) {
  return f->march.fold.system->get(&f->rest.statics);
}

/* The present point, which a march ended at, is this limit. */
static void note(Finder *f, ZpLimitKind kind, ZpMarchEnd end) {
  ZpLimit *limit = &f->limits->limit[kind];
  const ZpStatics *s = &f->rest.statics;
  limit->end = end;
  limit->value = kind == ZP_LIMIT_LOAD ? s->load : s->U;
  limit->reason = NULL;
  f->square.save(&f->rest.statics, limit->state);
  memcpy(limit->null, f->march.fold.null, s->assembly.n * sizeof *limit->null);
}

/* One limit is another, too. */
static void copy(Finder *f, ZpLimitKind kind, ZpLimitKind other) {
  ZpLimit *from = &f->limits->limit[kind], *to = &f->limits->limit[other];
  memcpy(to->state, from->state, f->square.save_size);
  memcpy(to->null, from->null, f->rest.statics.assembly.n * sizeof *to->null);
  *to = (ZpLimit){from->end, from->value, NULL, to->state, to->null};
}

static void none(Finder *f, ZpLimitKind kind, const char *reason) {
  f->limits->limit[kind] =
      (ZpLimit){ZP_MARCH_ARRIVED, NAN, reason, f->limits->limit[kind].state, f->limits->limit[kind].null};
}

static void lost(Finder *f, ZpLimitKind kind, const char *reason) {
  none(f, kind, reason);
  f->limits->limit[kind].end = ZP_MARCH_LOST;
}

/* Fall from the limit point that the march ended at to what is beyond it. */
static bool fall(Finder *f, double sign) {
  const ZpBranchSystem *sys = f->march.fold.system;
  bool was_closed = is_closed(f);
  sys->set(&f->rest.statics, changed(f, parameter(f), sign * ZP_CLOSING_BEYOND));
  return zp_closing_fall(&f->rest.statics, f->closed, was_closed, false, &f->rest.branch.newton);
}

/* Does the branch that the state fell to, from the limit point at m and `gap`, end so close below it that both are a
 * ripple of the mesh? Down there it may come back to where it was before the limit point without noticing. */
static bool is_ripple(Finder *f, double m, double gap, double sign) {
  ZpStatics *s = &f->rest.statics;
  double fallen = zp_closing_gap(s, NULL) - gap;
  f->square.save(s, f->held);
  ZpEvent event = f->march.event;
  f->march.event = NULL;
  ZpMarchEnd end = zp_march(&f->march, changed(f, m, -sign * ZP_FOLD_RIPPLE));
  bool ripple = end != ZP_MARCH_ARRIVED || (zp_closing_gap(s, NULL) - gap) * fallen < 0;
  f->march.event = event;
  go_to(f, f->held);
  return ripple;
}

/* What is along the branch, on both sides of the limit point at the present point, as far as a ripple may go? Its
 * highest crest is where the parameter goes furthest. */
typedef enum Around { NOTHING_HIGHER, STABLE_HIGHER, CREST_HIGHER, OUT_OF_SIGHT } Around;

/* At the present point the parameter goes further than m. */
static Around climb_on(Finder *f, double m, double sign) {
  ZpFold *fold = &f->march.fold;
  if (zp_statics_stable(&f->rest.statics, &f->rest.branch.newton)) return STABLE_HIGHER;
  zp_fold_guess(fold);
  bool found = zp_fold_solve(fold) && fold->negative == 0 && sign * (parameter(f) - m) > 0;
  return found ? CREST_HIGHER : OUT_OF_SIGHT;
}

/* On one side, in steps of the gap. */
static Around look(Finder *f, double sign, double step) {
  enum { MOST = 12 };
  static const double rough = 1e-7, higher = 1e-6; /* of the parameter */
  const double m = parameter(f), gap = zp_closing_gap(&f->rest.statics, NULL);
  const double deep = changed(f, m, -sign * ZP_FOLD_RIPPLE);
  for (int k = 1; k <= MOST; k++) {
    f->march.fold.small = rough;
    bool found = zp_fold_event(&f->march.fold, zp_closing_gap, gap + k * step);
    f->march.fold.small = ZP_FOLD_EXACT;
    if (!found) return OUT_OF_SIGHT;
    if (sign * (parameter(f) - m) > higher * m) return climb_on(f, m, sign);
    if (sign * (parameter(f) - deep) < 0) return NOTHING_HIGHER;
  }
  return NOTHING_HIGHER;
}

static Around look_around(Finder *f, ZpLimitKind kind, double sign) {
  static const double when_open = 4e-3, when_closed = 0.08; /* of the gap */
  double step = zp_closing_gap(&f->rest.statics, NULL) * (is_closed(f) ? when_closed : when_open);
  Around beyond = look(f, sign, -step);
  if (beyond == STABLE_HIGHER || beyond == CREST_HIGHER) return beyond;
  go_to(f, f->limits->limit[kind].state);
  Around before = look(f, sign, step);
  return before == NOTHING_HIGHER ? beyond : before;
}

/* From a limit point to the highest crest of the ripple that it may be part of. => where a stable state is higher, that
 * is where a march goes on */
static Around climb(Finder *f, ZpLimitKind kind, double sign) {
  enum { MOST = 20 };
  Around around = CREST_HIGHER;
  for (int k = 0; k < MOST && around == CREST_HIGHER; k++) {
    note(f, kind, ZP_MARCH_FOLD);
    around = look_around(f, kind, sign);
  }
  if (around != STABLE_HIGHER) go_to(f, f->limits->limit[kind].state);
  return around;
}

typedef enum Slow { ARRIVED, CHANGED, LOST, STOPPED } Slow;

/* Change the parameter slowly to `target`, or until the actuator closes or opens: that limit is noted as `kind`. The
 * first limit point on the way that is no ripple is noted as `first`, if that is another. */
static Slow change_slowly(Finder *f, double target, ZpLimitKind kind, ZpLimitKind first) {
  enum { MOST = 40 };
  double sign = target > parameter(f) ? 1 : -1;
  bool was_closed = is_closed(f);
  for (int k = 0; k < MOST; k++) {
    if (asked_to_stop(f)) return STOPPED;
    ZpMarchEnd end = zp_march(&f->march, target);
    if (end == ZP_MARCH_ARRIVED) return ARRIVED;
    if (end == ZP_MARCH_LOST) return LOST;
    note(f, kind, end);
    if (end == ZP_MARCH_EVENT) return CHANGED;
    if (climb(f, kind, sign) == STABLE_HIGHER) continue;
    double m = parameter(f), gap = zp_closing_gap(&f->rest.statics, NULL);
    bool found = fall(f, sign), jumped = is_closed(f) != was_closed;
    bool is_first = first != kind && f->limits->limit[first].end == ZP_MARCH_ARRIVED;
    if (is_first && (!found || jumped || !is_ripple(f, m, gap, sign))) copy(f, kind, first);
    if (!found) return LOST;
    if (jumped) return CHANGED;
  }
  return LOST;
}

/* -- from a neighbour ------------------------------------------------------------------------------- */

/* A state of the neighbour, of the size of this actuator, under its own load. */
static void take(Finder *f, const double *state) {
  ZpStatics *s = &f->rest.statics;
  double own = s->load, ratio = f->model->L / f->near->L;
  f->square.restore(s, state);
  for (size_t k = 0; k < 2 * f->model->stride; k++)
    s->q[k] *= ratio;
  s->load = own;
  zp_statics_stable(s, &f->rest.branch.newton);
}

/* Solve for a limit from where the neighbour has it. True if that is the limit: what is across its null vector is
 * stable, it is closed if the neighbour's is, and it is not far away. */
static bool from_neighbour(Finder *f, ZpLimitKind kind) {
  static const double farthest = 0.3;
  if (!f->near) return false;
  const ZpLimit *near = &f->near->limit[kind];
  ZpStatics *s = &f->rest.statics;
  if (near->end != ZP_MARCH_FOLD && near->end != ZP_MARCH_EVENT) return false;
  bool load = kind == ZP_LIMIT_LOAD, fold = near->end == ZP_MARCH_FOLD;
  f->march.fold.system = load ? &f->load : &f->square;
  take(f, near->state);
  double near_gap = zp_closing_gap(s, NULL);
  if (load) s->load = near->value;
  if (load) s->U = f->model->def.drive.voltage;
  memcpy(f->march.fold.null, near->null, s->assembly.n * sizeof *near->null);
  if (!(fold ? zp_fold_solve(&f->march.fold) : zp_fold_event(&f->march.fold, zp_closing_gap, f->closed))) return false;
  double value = load ? s->load : s->U;
  bool sided = !fold || (near_gap <= 2 * f->closed) == (zp_closing_gap(s, NULL) <= 2 * f->closed);
  bool within = load ? value > 0 : value <= f->model->def.drive.voltage;
  if (f->march.fold.negative > 0 || !sided || !within || fabs(value / near->value - 1) > farthest) return false;
  note(f, kind, near->end);
  if (fold && look_around(f, kind, load || kind == ZP_LIMIT_RELEASE ? -1 : 1) != NOTHING_HIGHER) return false;
  f->limits->warm++;
  return true;
}

/* Closing is by the fold of the pull-in, in the neighbour and here. */
static bool closes_as_neighbour(Finder *f) {
  const ZpLimit *near = f->near ? f->near->limit : NULL;
  if (!near || near[ZP_LIMIT_CLOSING].value != near[ZP_LIMIT_PULL_IN].value) return false;
  if (!from_neighbour(f, ZP_LIMIT_PULL_IN)) return false;
  copy(f, ZP_LIMIT_PULL_IN, ZP_LIMIT_CLOSING);
  return true;
}

/* -- the limits ------------------------------------------------------------------------------------- */

static bool hang(Finder *f) {
  ZpStatics *s = &f->rest.statics;
  ZpNewtonWork *work = &f->rest.branch.newton;
  if (f->near && f->near->hangs) take(f, f->near->start);
  if (!zp_newton_good(zp_statics_hang(s, work).end)) return false;
  if (!zp_statics_stable(s, work)) return false;
  f->limits->hanging = f->model->field ? zp_closing_gap(s, NULL) : 0;
  f->limits->hangs = true;
  f->closed = zp_closing_limit(s, f->limits->hanging);
  f->march.limit = f->closed;
  f->square.save(s, f->limits->start);
  return true;
}

/* It has closed gradually: is there a limit point further up? */
static void seek_pull_in(Finder *f, double target) {
  ZpLimit *pull_in = &f->limits->limit[ZP_LIMIT_PULL_IN];
  f->march.event = NULL;
  if (pull_in->end == ZP_MARCH_ARRIVED && zp_march(&f->march, target) == ZP_MARCH_FOLD)
    note(f, ZP_LIMIT_PULL_IN, ZP_MARCH_FOLD);
  f->march.event = zp_closing_gap;
}

/* A voltage that rises to drive.voltage. */
static Slow raise_voltage(Finder *f) {
  double top = f->model->def.drive.voltage;
  f->march.fold.system = &f->square;
  f->march.event = zp_closing_gap;
  if (closes_as_neighbour(f)) return CHANGED;
  none(f, ZP_LIMIT_PULL_IN, "no limit point on the way up to drive.voltage");
  none(f, ZP_LIMIT_CLOSING, "it does not close up to drive.voltage");
  f->march.fold.system = &f->square;
  go_to(f, f->limits->start);
  Slow end = change_slowly(f, top * top, ZP_LIMIT_CLOSING, ZP_LIMIT_PULL_IN);
  if (end == LOST) lost(f, ZP_LIMIT_CLOSING, "the hanging state was lost on the way up");
  if (end == LOST && isnan(f->limits->limit[ZP_LIMIT_PULL_IN].value))
    lost(f, ZP_LIMIT_PULL_IN, "the hanging state was lost on the way up");
  if (end == ARRIVED) none(f, ZP_LIMIT_CLOSING, "it does not close up to drive.voltage");
  if (end == ARRIVED) f->square.save(&f->rest.statics, f->top);
  if (end == CHANGED && f->limits->limit[ZP_LIMIT_CLOSING].end == ZP_MARCH_EVENT) seek_pull_in(f, top * top);
  return end;
}

/* From closed at drive.voltage down to 0. */
static void lower_voltage(Finder *f) {
  ZpStatics *s = &f->rest.statics;
  ZpLimit *release = &f->limits->limit[ZP_LIMIT_RELEASE];
  if (from_neighbour(f, ZP_LIMIT_RELEASE)) return;
  f->march.fold.system = &f->square;
  f->march.event = zp_closing_gap;
  none(f, ZP_LIMIT_RELEASE, "it is not closed at drive.voltage");
  ZpNewtonInfo info = zp_statics_close(s, f->model->def.drive.voltage, &f->rest.branch.newton);
  if (!zp_newton_good(info.end) || !is_closed(f) || zp_statics_fault(s)) return;
  Slow end = change_slowly(f, 0, ZP_LIMIT_RELEASE, ZP_LIMIT_RELEASE);
  if (end == ARRIVED) none(f, ZP_LIMIT_RELEASE, "it stays closed down to 0 V");
  if (end == LOST) lost(f, ZP_LIMIT_RELEASE, "the closed state was lost on the way down");
  double closing = f->limits->limit[ZP_LIMIT_CLOSING].value;
  if (end == CHANGED && release->value > closing) release->value = closing;
}

/* Hang at drive.voltage under a load so large that it does not close. False if none was found. */
static bool hang_heavy(Finder *f) {
  enum { MOST = 12 };
  static const double lightest = 1e-3; /* kg */
  ZpStatics *s = &f->rest.statics;
  double top = f->model->def.drive.voltage, closing = f->limits->limit[ZP_LIMIT_CLOSING].value;
  double load = fmax(f->model->def.load.mass, lightest) * 3 * (top / closing) * (top / closing);
  for (int k = 0; k < MOST; k++, load *= 4) {
    f->march.fold.system = &f->square;
    f->square.restore(s, f->limits->start);
    s->load = load;
    if (!zp_newton_good(zp_statics_hang(s, &f->rest.branch.newton).end)) return false;
    if (!zp_statics_stable(s, &f->rest.branch.newton)) return false;
    Slow end = change_slowly(f, top * top, ZP_LIMIT_LOAD, ZP_LIMIT_LOAD);
    if (end == ARRIVED) return !is_closed(f);
    if (end != CHANGED) return false;
  }
  return false;
}

/* A load that falls at drive.voltage until it is lifted. */
static void lower_load(Finder *f, bool closes) {
  if (from_neighbour(f, ZP_LIMIT_LOAD)) return;
  f->march.event = zp_closing_gap;
  bool hangs = closes ? hang_heavy(f) : true;
  none(f, ZP_LIMIT_LOAD, "no load was found that it cannot lift");
  if (!hangs) return;
  if (!closes) go_to(f, f->top);
  f->march.fold.system = &f->load;
  Slow end = change_slowly(f, 0, ZP_LIMIT_LOAD, ZP_LIMIT_LOAD);
  if (end == ARRIVED) none(f, ZP_LIMIT_LOAD, "it does not close at drive.voltage even without load");
  if (end == LOST) lost(f, ZP_LIMIT_LOAD, "the hanging state was lost as the load fell");
}

static void none_closed(Finder *f, const char *reason) {
  none(f, ZP_LIMIT_CLOSING, reason);
  none(f, ZP_LIMIT_RELEASE, reason);
  none(f, ZP_LIMIT_LOAD, reason);
}

/* False if it does not hang. */
static bool find(Finder *f) {
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    none(f, (ZpLimitKind)k, "without a voltage there is none");
  if (!hang(f)) return false;
  if (!f->model->field || f->model->def.drive.voltage == 0) return true;
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    none(f, (ZpLimitKind)k, "it hangs closed");
  if (f->limits->hanging <= zp_closing_limit(&f->rest.statics, 0)) return true;
  Slow up = raise_voltage(f);
  bool shorts = f->model->def.insulator.thickness == 0;
  if (shorts) none_closed(f, "closed it is a short circuit");
  if (shorts) return true;
  none(f, ZP_LIMIT_RELEASE, "it was not looked for");
  none(f, ZP_LIMIT_LOAD, "it was not looked for");
  if (up == STOPPED || up == LOST) return true;
  lower_voltage(f);
  f->rest.statics.load = f->model->def.load.mass;
  if (f->model->def.gravity > 0)
    lower_load(f, up == CHANGED);
  else
    none(f, ZP_LIMIT_LOAD, "without gravity a mass is no load");
  return true;
}

/* -- limits that outlive their model ------------------------------------------------------------------ */

void zp_limits_destroy(ZpLimits *limits) {
  if (!limits) return;
  zp_free(limits->memory);
  zp_free(limits);
}

static size_t carve_limits(ZpLimits *limits, size_t save, size_t equations, void *block) {
  ZpCarver carver = {block, 0};
  limits->start = zp_carve(&carver, save);
  for (int k = 0; k < ZP_LIMIT_KINDS; k++) {
    limits->limit[k].state = zp_carve(&carver, save);
    limits->limit[k].null = zp_carve(&carver, equations);
  }
  return carver.used;
}

static ZpLimits *create(const Finder *f) {
  const ZpStatics *s = &f->rest.statics;
  ZpLimits *limits = zp_calloc(1, sizeof *limits);
  if (!limits) return NULL;
  *limits = (ZpLimits){.ribbons = f->model->s, .nodes = f->model->nodes, .L = f->model->L};
  size_t save = zp_rest_save_size(&f->rest);
  limits->memory = zp_calloc(1, carve_limits(limits, save, s->assembly.n, NULL));
  if (limits->memory) {
    carve_limits(limits, save, s->assembly.n, limits->memory);
    return limits;
  }
  zp_free(limits);
  return NULL;
}

/* -- the study ------------------------------------------------------------------------------------- */

static void record(Finder *f, ZpTable *table, ZpShapes *shapes, int kind) {
  ZpStatics *s = &f->rest.statics;
  if (isnan(f->limits->limit[kind].value)) return;
  go_to(f, f->limits->limit[kind].state);
  double row[COLUMNS] = {kind,
                         s->U,
                         s->load,
                         zp_statics_stroke(s),
                         zp_statics_opening(s),
                         (double)zp_statics_front(s) * f->model->l,
                         zp_statics_charge(s),
                         zp_statics_capacitance(s)};
  ZpShape shape = zp_statics_shape(s, kind, f->rest.line_force);
  zp_table_offer(table, row);
  zp_shapes_offer(shapes, &shape);
}

/* ", releases at 855 V" or "; no release: why". */
static void say(char *text, size_t size, const ZpLimit *limit, const char *found, const char *unit,
                const char *missing) {
  size_t used = strlen(text);
  if (isnan(limit->value))
    snprintf(text + used, size - used, "; no %s: %s", missing, limit->reason);
  else
    snprintf(text + used, size - used, ", %s %.4g %s", found, limit->value, unit);
}

static void describe(Finder *f, ZpResult *r) {
  const ZpLimit *limit = f->limits->limit, *pull_in = &limit[ZP_LIMIT_PULL_IN], *closing = &limit[ZP_LIMIT_CLOSING];
  size_t size = sizeof r->message;
  const char *trouble = zp_statics_trouble(&f->rest.statics);
  if (isnan(pull_in->value))
    snprintf(r->message, size, "no pull-in up to %g V", f->model->def.drive.voltage);
  else
    snprintf(r->message, size, "pulls in at %.4g V", pull_in->value);
  if (closing->value != pull_in->value && !isnan(closing->value))
    say(r->message, size, closing, "closes at", "V", "closing");
  say(r->message, size, &limit[ZP_LIMIT_RELEASE], "releases at", "V", "release");
  say(r->message, size, &limit[ZP_LIMIT_LOAD], "lifts at most", "kg", "largest load");
  size_t used = strlen(r->message);
  if (trouble) snprintf(r->message + used, size - used, ": %s", trouble);
}

static ZpOutcome outcome_of(const Finder *f) {
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    if (f->limits->limit[k].end == ZP_MARCH_LOST) return ZP_BRANCH_LOST;
  return f->interrupted ? ZP_INTERRUPTED : ZP_CONVERGED;
}

static void run(Finder *f, ZpResult *r) {
  f->march.fold.tolerance = zp_statics_tolerance(&f->rest.statics);
  bool hangs = find(f);
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_result_add(r, scalars[k].name, scalars[k].unit, f->limits->limit[k].value);
  zp_result_add(r, "warm_starts", "count", f->limits->warm);
  r->outcome = hangs ? outcome_of(f) : ZP_NOT_SETTLED;
  describe(f, r);
  if (!hangs) snprintf(r->message, sizeof r->message, "no hanging equilibrium found");
  for (int k = 0; hangs && k < ZP_LIMIT_KINDS; k++)
    record(f, r->series, r->shapes, k);
  zp_result_note_model(r, f->model, f->model->def.drive.voltage, r->shapes->frames);
  if (hangs) zp_note_start(r, f->model, f->limits->hanging);
}

/* A neighbour of another mesh or kind is none. */
static const ZpLimits *neighbour_of(const ZpTask *task, const ZpModel *model) {
  const ZpLimits *near = task->input.neighbour ? task->input.neighbour->limits : NULL;
  return near && near->ribbons == model->s && near->nodes == model->nodes ? near : NULL;
}

ZpStatus zp_check_limits(const ZpActuatorDef *def, ZpError *err) {
  if (def->actuator.kind == ZP_KIND_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT,
                   "actuator.kind = ribbon: study limits requires electrodes: kind electro_ribbon or flange");
  return zp_def_check_voltage(def, def->drive.voltage, err);
}

ZpStatus zp_study_limits(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Finder f = {.model = model, .hooks = task->hooks, .near = neighbour_of(task, model)};
  result->series = zp_table_create(columns, COLUMNS, ZP_LIMIT_KINDS);
  result->shapes = zp_shapes_create(model->s, model->nodes, ZP_LIMIT_KINDS);
  bool open = result->series && result->shapes && zp_rest_open(&f.rest, model, carve, &f);
  if (open) result->limits = f.limits = create(&f);
  if (f.limits)
    run(&f, result);
  else
    status = zp_fail_memory(err);
  zp_rest_close(&f.rest);
  zp_model_destroy(model);
  return status;
}
