/* Study `limits`: pull-in, closing, release and the largest load. Each is solved as the limit point or event that it
 * is, without following the curve, by rest/slow.h. Theory, section 10. */
#include "study/limits.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "actuator/resolution.h"
#include "base/fail.h"
#include "def/check.h"
#include "study/members.h"
#include "study/notes.h"
#include "study/sensitivity.h"
#include "study/studies.h"

static const ZpColumn columns[] = {
    {"limit", "1", "0: pull-in, 1: closing, 2: release, 3: largest load"},
    {"voltage_V", "V", "voltage between the electrodes"},
    {"load_kg", "kg", "mass hung on the actuator"},
    {"stroke_m", "m", "height of the clip over the lower platform, signed"},
    {"opening_m", "m", "distance between the platforms' faces"},
    {"zipped_length_m", "m", "closed length of one half, from the clip"},
    {"charge_C", "C", "charge on the electrodes"},
    {"capacitance_F", "F", "capacitance of the electrodes"},
    ZP_MARGIN_COLUMNS,
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

typedef struct Scalar {
  const char *name, *unit;
} Scalar;

static const Scalar scalars[] = {
    {"pull_in_voltage_V", "V"}, {"closing_voltage_V", "V"}, {"release_voltage_V", "V"}, {"max_load_kg", "kg"}};

typedef struct Finder {
  const ZpModel *model;
  const ZpTask *task;
  ZpRest rest;
  ZpSlow slow;
  ZpLift lift;
  ZpLimits *limits;
  const ZpLimits *near; /* of a neighbour; NULL: none */
  void *top;            /* the hanging state at drive.voltage under its own load, if it hangs there */
  bool arrived;         /* that state is known */
  ZpMargins margins;
  ZpLimitList list; /* of what is differentiated */
} Finder;

static void carve(void *user, ZpCarver *carver) {
  Finder *f = user;
  zp_slow_carve(&f->slow, &f->rest, carver);
  zp_lift_carve(&f->lift, &f->slow, &f->rest, carver);
  f->top = zp_carve(carver, zp_rest_save_size(&f->rest));
}

static bool asked_to_stop(void *finder) {
  const Finder *f = finder;
  return zp_task_stops(f->task, "limits", 0);
}

/* -- from a neighbour ------------------------------------------------------------------------------- */

/* A state of the neighbour, scaled to this actuator, under its own load. */
static void take(Finder *f, const double *state) {
  ZpStatics *s = &f->rest.statics;
  double own = s->load, ratio = f->model->L / f->near->L;
  f->slow.square.restore(s, state);
  for (size_t k = 0; k < s->members; k++)
    zp_stretch(s->member[k].model, ratio, s->member[k].q);
  s->load = own;
  zp_statics_stable(s, &f->rest.branch.newton);
}

/* Solve for a limit, starting from the neighbour's. True if this is the limit: it is stable except along its null
 * vector, it is closed if the neighbour's is, and it is not far away. */
static bool from_neighbour(Finder *f, ZpLimitKind kind) {
  static const double farthest = 0.3;
  if (!f->near) return false;
  const ZpLimit *near = &f->near->limit[kind];
  ZpStatics *s = &f->rest.statics;
  if (near->end != ZP_MARCH_FOLD && near->end != ZP_MARCH_EVENT) return false;
  bool load = kind == ZP_LIMIT_LOAD, fold = near->end == ZP_MARCH_FOLD;
  f->slow.march.fold.system = load ? &f->slow.load : &f->slow.square;
  take(f, near->state);
  double near_gap = zp_closing_gap(s, NULL);
  if (load) s->load = near->value;
  if (load) s->U = f->model->def.drive.voltage;
  memcpy(f->slow.march.fold.null, near->null, s->n * sizeof *near->null);
  ZpFold *solver = &f->slow.march.fold;
  bool found = fold   ? zp_fold_solve(solver)
               : load ? zp_lift_event(&f->lift, near_gap)
                      : zp_fold_event(solver, zp_closing_gap, f->slow.closed, ZP_FOLD_EXACT);
  if (!found) return false;
  double value = load ? s->load : s->U;
  bool sided = !fold || (near_gap <= 2 * f->slow.closed) == (zp_closing_gap(s, NULL) <= 2 * f->slow.closed);
  bool within = load ? value > 0 : value <= f->model->def.drive.voltage;
  if (f->slow.march.fold.negative > 0 || !sided || !within || fabs(value / near->value - 1) > farthest) return false;
  ZpLimit *limit = &f->limits->limit[kind];
  double sign = kind == ZP_LIMIT_RELEASE ? -1 : 1;
  zp_slow_note(&f->slow, limit, near->end);
  limit->room = zp_slow_room_left(&f->slow, near, near_gap);
  solver->system = &f->slow.square; /* crests under this load */
  bool highest = !fold || limit->room > 0 || zp_slow_look_around(&f->slow, limit, sign) == ZP_NOTHING_HIGHER;
  if (!highest) return false;
  f->limits->warm++;
  return true;
}

/* Closing is by the fold of the pull-in, in the neighbour and here. */
static bool closes_as_neighbour(Finder *f) {
  const ZpLimit *near = f->near ? f->near->limit : NULL;
  if (!near || near[ZP_LIMIT_CLOSING].value != near[ZP_LIMIT_PULL_IN].value) return false;
  if (!from_neighbour(f, ZP_LIMIT_PULL_IN)) return false;
  zp_slow_copy(&f->slow, &f->limits->limit[ZP_LIMIT_PULL_IN], &f->limits->limit[ZP_LIMIT_CLOSING]);
  return true;
}

/* -- the limits ------------------------------------------------------------------------------------- */

static bool hang(Finder *f) {
  ZpStatics *s = &f->rest.statics;
  ZpNewtonWork *work = &f->rest.branch.newton;
  if (f->near && f->near->hangs) take(f, f->near->start);
  if (!zp_newton_good(zp_statics_hang(s, work).end) || !zp_statics_bias(s, work)) return false;
  if (!zp_statics_stable(s, work)) return false;
  f->limits->hanging = f->model->field ? zp_closing_gap(s, NULL) : 0;
  f->limits->hangs = true;
  zp_slow_start(&f->slow);
  f->slow.square.save(s, f->limits->start);
  return true;
}

/* A voltage that rises to drive.voltage. */
static ZpSlowEnd raise_voltage(Finder *f) {
  ZpLimit *limit = f->limits->limit;
  if (closes_as_neighbour(f)) return ZP_SLOW_CHANGED;
  zp_slow_go_to(&f->slow, f->limits->start);
  ZpSlowEnd end =
      zp_slow_raise(&f->slow, f->model->def.drive.voltage, &limit[ZP_LIMIT_PULL_IN], &limit[ZP_LIMIT_CLOSING]);
  f->arrived = end == ZP_SLOW_ARRIVED;
  if (f->arrived) f->slow.square.save(&f->rest.statics, f->top);
  return end;
}

/* The closed state at drive.voltage, from the neighbour's, from the state to which the voltage has led, or from the
 * straight shape. False if there is none. */
static bool find_closed(Finder *f) {
  ZpLimits *limits = f->limits;
  if (f->near && f->near->closes) take(f, f->near->closed);
  limits->closes = zp_slow_close(&f->slow, f->model->def.drive.voltage);
  if (limits->closes) f->slow.square.save(&f->rest.statics, limits->closed);
  return limits->closes;
}

/* May closed faces slide along each other? Then only the way down tells whether they do before they open. */
static bool faces_slide(const ZpModel *model) {
  return zp_is_pair(&model->topology) && zp_ends_free(&model->topology);
}

/* From closed at drive.voltage down to 0. */
static void lower_voltage(Finder *f) {
  ZpLimit *limit = f->limits->limit;
  bool closes = find_closed(f);
  if (!faces_slide(f->model) && from_neighbour(f, ZP_LIMIT_RELEASE)) return;
  zp_limit_none(&limit[ZP_LIMIT_RELEASE], "it is not closed at drive.voltage");
  if (!closes) return;
  zp_slow_go_to(&f->slow, f->limits->closed);
  zp_slow_lower(&f->slow, &limit[ZP_LIMIT_CLOSING], &limit[ZP_LIMIT_RELEASE]);
}

/* Hang at drive.voltage under a load so large that it does not close. False if none was found. */
static bool hang_heavy(Finder *f) {
  enum { MOST = 12 };
  static const double lightest = 1e-3, heavier = 3; /* kg; than what forces as the voltage's square could lift */
  double top = f->lift.top, closing = f->limits->limit[ZP_LIMIT_CLOSING].value;
  double load = fmax(f->task->def->load.mass, lightest) * heavier * (top / closing) * (top / closing);
  for (int k = 0; k < MOST; k++, load *= 4) {
    ZpSlowEnd end = zp_lift_hang_at_top(&f->lift, load);
    if (end == ZP_SLOW_ARRIVED) return true;
    if (end == ZP_SLOW_LOST || end == ZP_SLOW_STOPPED) return false;
  }
  return false;
}

/* Is the state to which the neighbour falls from its limit point closed here, too? If it closes gradually, does it
 * without a jump before? */
static bool falls_as_neighbour(Finder *f) {
  const ZpLimit *limit = &f->limits->limit[ZP_LIMIT_LOAD];
  if (limit->end == ZP_MARCH_EVENT) return zp_lift_closes_gradually(&f->lift, limit->value);
  if (!zp_lift_hang(&f->lift, limit->value)) return false;
  take(f, f->near->lifted);
  bool closed = zp_slow_close(&f->slow, f->lift.top);
  f->slow.square.save(&f->rest.statics, f->limits->lifted);
  return closed;
}

/* From a neighbour: only if the voltage meets no other limit point before, and the mesh is too fine to hold a front
 * between nodes, to which the actuator might fall. */
static bool lift_as_neighbour(Finder *f) {
  static const double fine = 3; /* elements */
  bool trusted = f->near && f->near->first && zp_mesh_resolution(f->model, f->model->def.drive.voltage) > fine;
  bool found = trusted && from_neighbour(f, ZP_LIMIT_LOAD);
  f->limits->first = found && falls_as_neighbour(f);
  if (found && !f->limits->first) f->limits->warm--;
  return f->limits->first;
}

/* The largest load. The search starts where a load that falls at drive.voltage meets its first limit. */
static void lift(Finder *f, bool closes) {
  ZpLimit *limit = &f->limits->limit[ZP_LIMIT_LOAD];
  memcpy(f->limits->hung, f->limits->start, f->slow.square.save_size);
  zp_lift_start(&f->lift, f->model->def.drive.voltage, f->limits->hung, f->limits->lifted);
  if (lift_as_neighbour(f)) return;
  zp_lift_narrow(&f->lift, f->task->def->load.mass, closes, f->limits->limit[ZP_LIMIT_CLOSING].value);
  bool hangs = closes ? hang_heavy(f) : zp_lift_hang(&f->lift, f->task->def->load.mass);
  zp_limit_none(limit, "no load was found that it cannot lift");
  if (!hangs) return;
  if (!closes) zp_slow_go_to(&f->slow, f->top);
  zp_lift_drop(&f->lift, limit);
  f->limits->first = zp_lift_settle(&f->lift, limit);
  if (limit->end == ZP_MARCH_EVENT) zp_lift_hang(&f->lift, limit->value);
}

static void none_closed(Finder *f, const char *reason) {
  zp_limit_none(&f->limits->limit[ZP_LIMIT_CLOSING], reason);
  zp_limit_none(&f->limits->limit[ZP_LIMIT_RELEASE], reason);
  zp_limit_none(&f->limits->limit[ZP_LIMIT_LOAD], reason);
}

/* False if it does not hang. */
static bool find(Finder *f) {
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_limit_none(&f->limits->limit[k], "without a voltage there is none");
  if (!hang(f)) return false;
  if (!f->model->field || f->model->def.drive.voltage == 0) return true;
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_limit_none(&f->limits->limit[k], "it hangs closed");
  if (f->limits->hanging <= zp_closed_opening(f->rest.statics.member->model, 0)) return true;
  ZpSlowEnd up = raise_voltage(f);
  bool shorts = zp_insulation(&f->model->def) == 0;
  if (shorts) none_closed(f, "when closed, it is a short circuit");
  if (shorts) return true;
  zp_limit_none(&f->limits->limit[ZP_LIMIT_RELEASE], "it was not searched");
  zp_limit_none(&f->limits->limit[ZP_LIMIT_LOAD], "it was not searched");
  if (up == ZP_SLOW_STOPPED || up == ZP_SLOW_LOST) return true;
  lower_voltage(f);
  f->rest.statics.load = f->task->def->load.mass;
  if (zp_is_opposed(f->model))
    zp_limit_none(&f->limits->limit[ZP_LIMIT_LOAD], "a heavy load closes the lower antagonist");
  else if (f->model->def.gravity > 0 && f->model->fall[1] < 0)
    lift(f, up == ZP_SLOW_CHANGED);
  else
    zp_limit_none(&f->limits->limit[ZP_LIMIT_LOAD], "gravity does not pull the platform down, so a mass is no load");
  return true;
}

/* -- the actuator ----------------------------------------------------------------------------------- */

static double mass_of_one(const ZpModel *model) {
  double sum = -zp_load_share(model) * model->def.load.mass, platform = 0;
  for (size_t j = 0; j < model->count; j++)
    sum += model->mass[j];
  for (size_t i = 0; zp_has_platform(&model->topology) && i < model->s; i++)
    platform += zp_ribbon_section(model, i).mu * model->def.platform.length;
  return model->parts * sum + model->def.stack.parallel * platform;
}

double zp_limits_mass(const ZpModel *model) {
  double sum = 0;
  for (const ZpModel *m = model; m < zp_lowest(model); m++)
    sum += m->def.load.mass; /* of the link on which the next one hangs */
  for (const ZpModel *m = model; m < model + model->members; m++)
    sum += mass_of_one(m);
  return sum;
}

/* Opening of a state, m. */
static double opening_at(Finder *f, const double *state) {
  zp_slow_go_to(&f->slow, state);
  return zp_statics_opening(&f->rest.statics);
}

/* How far the load rises from hanging without voltage to closed at drive.voltage, m. NAN where it does not close. */
static double travel_of(Finder *f) {
  const ZpLimits *limits = f->limits;
  return limits->hangs && limits->closes ? opening_at(f, limits->start) - opening_at(f, limits->closed) : (double)NAN;
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
  limits->closed = zp_carve(&carver, save);
  limits->hung = zp_carve(&carver, save);
  limits->lifted = zp_carve(&carver, save);
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_limit_carve(&limits->limit[k], save, equations, &carver);
  return carver.used;
}

static ZpLimits *create(const Finder *f) {
  const ZpStatics *s = &f->rest.statics;
  ZpLimits *limits = zp_calloc(1, sizeof *limits);
  if (!limits) return NULL;
  *limits = (ZpLimits){.ribbons = f->model->s, .nodes = s->members * f->model->nodes, .L = f->model->L};
  size_t save = zp_rest_save_size(&f->rest);
  limits->memory = zp_calloc(1, carve_limits(limits, save, s->n, NULL));
  if (limits->memory) {
    carve_limits(limits, save, s->n, limits->memory);
    return limits;
  }
  zp_free(limits);
  return NULL;
}

/* -- the study ------------------------------------------------------------------------------------- */

/* Go to a state => the fields and stresses there, which count. */
static ZpMargins look(Finder *f, const double *state) {
  zp_slow_go_to(&f->slow, state);
  ZpMargins margins;
  zp_rest_shape(&f->rest, 0, &margins);
  zp_margins_join(&f->margins, margins);
  return margins;
}

/* The states between which a voltage that rises slowly to drive.voltage leads, and their fields. */
static void look_at_ends(Finder *f) {
  if (f->limits->hangs) look(f, f->limits->start);
  if (f->limits->closes) look(f, f->limits->closed);
  if (f->arrived) look(f, f->top);
  zp_margins_join(&f->margins, zp_margins_at_clip(f->model, f->model->def.drive.voltage));
}

static void record(Finder *f, ZpTable *table, ZpShapes *shapes, int kind) {
  ZpStatics *s = &f->rest.statics;
  if (isnan(f->limits->limit[kind].value)) return;
  ZpMargins margins = look(f, f->limits->limit[kind].state);
  double row[COLUMNS + ZP_MEMBER_COLUMNS] = {kind,
                                             s->U,
                                             s->load,
                                             zp_statics_stroke(s),
                                             zp_statics_opening(s),
                                             zp_statics_closed_length(s),
                                             zp_statics_charge(s),
                                             zp_statics_capacitance(s),
                                             ZP_MARGIN_VALUES(margins)};
  zp_members_values(&f->rest, row + COLUMNS);
  ZpShape shape = zp_rest_shape(&f->rest, kind, NULL);
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
  if (f->rest.statics.stopped) return ZP_INTERRUPTED;
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    if (f->limits->limit[k].end == ZP_MARCH_LOST) return ZP_BRANCH_LOST;
  return ZP_CONVERGED;
}

static void pose_closed(const ZpActuatorDef *def, ZpStatics *s) {
  s->load = s->own_load;
  s->U = def->drive.voltage;
}

/* The derivative of the opening of a state. */
static double slope_of_opening(Finder *f, ZpSlope *slope, const double *state, ZpPose pose) {
  zp_slow_go_to(&f->slow, state);
  if (!zp_slope_solve(slope, pose)) return NAN;
  return zp_slope_of(slope, pose, zp_output_opening, NULL);
}

/* Derivatives of travel_m and mass_kg; the latter follow from the definition alone. `user` is a Finder. */
static void derive_all(void *user, ZpSlope *slope, ZpResult *result) {
  Finder *f = user;
  double mass = 0, travel = NAN;
  zp_derive_limits(&f->list, slope, result);
  for (int k = 0; k < ZP_NEAR_POINTS; k++)
    if (slope->by.model[k]) mass += slope->by.weight[k] * zp_limits_mass(slope->by.model[k]);
  if (f->limits->closes)
    travel = slope_of_opening(f, slope, f->limits->start, zp_pose_load) -
             slope_of_opening(f, slope, f->limits->closed, pose_closed);
  zp_result_add_sensitivity(result, "travel_m", slope->key, travel);
  zp_result_add_sensitivity(result, "mass_kg", slope->key, mass);
}

static ZpStatus derive(Finder *f, ZpResult *r, ZpError *err) {
  f->list =
      (ZpLimitList){.slow = &f->slow, .hanging = f->limits->start, .hung = f->limits->hung, .count = ZP_LIMIT_KINDS};
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    f->list.item[k] = (ZpNamedLimit){scalars[k].name, &f->limits->limit[k], k == ZP_LIMIT_LOAD};
  return zp_sensitivity_of(&f->rest, derive_all, f, r, err);
}

static void run(Finder *f, ZpResult *r) {
  f->rest.statics.stop = asked_to_stop;
  f->rest.statics.caller = f;
  bool hangs = find(f);
  for (int k = 0; k < ZP_LIMIT_KINDS; k++)
    zp_result_add(r, scalars[k].name, scalars[k].unit, f->limits->limit[k].value);
  zp_result_add(r, "travel_m", "m", travel_of(f));
  zp_result_add(r, "mass_kg", "kg", zp_limits_mass(f->model));
  zp_result_add(r, "warm_starts", "count", f->limits->warm);
  r->outcome = hangs || f->rest.statics.stopped ? outcome_of(f) : ZP_NOT_SETTLED;
  describe(f, r);
  if (!hangs) snprintf(r->message, sizeof r->message, "%s", zp_statics_no_rest(&f->rest.statics));
  if (f->rest.statics.stopped) snprintf(r->message, sizeof r->message, "interrupted; the results so far are kept");
  for (int k = 0; hangs && k < ZP_LIMIT_KINDS; k++)
    record(f, r->series, r->shapes, k);
  look_at_ends(f);
  zp_add_margins(r, f->model, &f->margins);
  zp_note_mesh(r, f->model, f->model->def.drive.voltage);
  zp_note_rest(r, f->model);
  zp_note_no_controller(r, f->model);
  if (hangs) zp_note_start(r, f->model, f->limits->hanging);
}

/* A case with another mesh or kind does not count as a neighbour. */
static const ZpLimits *neighbour_of(const ZpTask *task, const ZpModel *model) {
  const ZpLimits *near = task->input.neighbour ? task->input.neighbour->limits : NULL;
  return near && near->ribbons == model->s && near->nodes == model->members * model->nodes ? near : NULL;
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ANY, ZP_NOT(actuator.kind, ZP_KIND_RIBBON), "a single ribbon has no electrodes"),
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
};
const ZpRules zp_rules_limits = ZP_RULES_OF(rule);

ZpStatus zp_check_limits(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_check_sensitivity(def, err);
  return status == ZP_OK ? zp_def_check_voltage(def, def->drive.voltage, err) : status;
}

ZpStatus zp_study_limits(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Finder f = {.model = model, .task = task, .near = neighbour_of(task, model), .margins = zp_margins_none()};
  result->series = zp_members_table(model, columns, COLUMNS, ZP_LIMIT_KINDS);
  result->shapes = zp_model_shapes(model, ZP_LIMIT_KINDS);
  bool open = result->series && result->shapes && zp_rest_open(&f.rest, model, carve, &f);
  if (open) result->limits = f.limits = create(&f);
  if (f.limits)
    run(&f, result);
  else
    status = zp_fail_memory(err);
  if (f.limits && f.limits->hangs) status = derive(&f, result, err);
  zp_rest_close(&f.rest);
  zp_model_destroy(model);
  return status;
}
