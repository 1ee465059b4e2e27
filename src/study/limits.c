/* Study `limits`: pull-in, closing, release and the largest load. Each is solved as the limit point or event that it
 * is, without following the curve, by rest/limits.h. Theory, section 10. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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

static const ZpLimitKind order[] = {ZP_LIMIT_PULL_IN, ZP_LIMIT_CLOSING, ZP_LIMIT_RELEASE, ZP_LIMIT_LOAD};

typedef struct Finder {
  const ZpModel *model;
  const ZpTask *task;
  ZpRest rest;
  ZpLimits *limits;
  ZpMargins margins;
} Finder;

static bool asked_to_stop(void *finder) {
  const Finder *f = finder;
  return zp_task_stops(f->task, "limits", 0);
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

/* Mass of an actuator's strips and insulators, the platform's included, kg. */
static double mass_of(const ZpModel *model) {
  double sum = 0;
  for (const ZpModel *m = model; m < zp_lowest(model); m++)
    sum += m->def.load.mass; /* of the link on which the next one hangs */
  for (const ZpModel *m = model; m < model + model->members; m++)
    sum += mass_of_one(m);
  return sum;
}

/* Opening of a state, m. */
static double opening_at(Finder *f, const double *state) {
  zp_rest_go_to(&f->rest, state);
  return zp_statics_opening(&f->rest.statics);
}

/* How far the load rises from hanging without voltage to closed at drive.voltage, m. NAN where it does not close. */
static double travel_of(Finder *f) {
  const ZpLimits *limits = f->limits;
  return limits->hangs && limits->closes ? opening_at(f, limits->start) - opening_at(f, limits->closed) : (double)NAN;
}

void zp_limits_destroy(ZpLimits *limits) {
  if (!limits) return;
  zp_free(limits->memory);
  zp_free(limits);
}

/* -- the study ------------------------------------------------------------------------------------- */

/* Go to a state => the fields and stresses there, which count. */
static ZpMargins look(Finder *f, const double *state) {
  zp_rest_go_to(&f->rest, state);
  ZpMargins margins;
  zp_rest_shape(&f->rest, 0, &margins);
  zp_margins_join(&f->margins, margins);
  return margins;
}

/* The states between which a voltage that rises slowly to drive.voltage leads, and their fields. */
static void look_at_ends(Finder *f) {
  if (f->limits->hangs) look(f, f->limits->start);
  if (f->limits->closes) look(f, f->limits->closed);
  if (f->limits->arrives) look(f, f->limits->top);
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
  return zp_limits_lost(f->limits) ? ZP_BRANCH_LOST : ZP_CONVERGED;
}

static void pose_closed(const ZpActuatorDef *def, ZpStatics *s) {
  s->load = s->own_load;
  s->U = def->drive.voltage;
}

/* The derivative of the opening of a state. */
static double slope_of_opening(Finder *f, ZpSlope *slope, const double *state, ZpPose pose) {
  zp_rest_go_to(&f->rest, state);
  if (!zp_slope_solve(slope, pose)) return NAN;
  return zp_slope_of(slope, pose, zp_output_opening, NULL);
}

/* Derivatives of travel_m and mass_kg; the latter follow from the definition alone. `user` is a Finder. */
static void derive(void *user, ZpSlope *slope, ZpResult *result) {
  Finder *f = user;
  double mass = 0, travel = NAN;
  zp_derive_limits(&f->rest, f->limits, order, ZP_LIMIT_KINDS, slope, result);
  for (int k = 0; k < ZP_NEAR_POINTS; k++)
    if (slope->by.model[k]) mass += slope->by.weight[k] * mass_of(slope->by.model[k]);
  if (f->limits->closes)
    travel = slope_of_opening(f, slope, f->limits->start, zp_pose_load) -
             slope_of_opening(f, slope, f->limits->closed, pose_closed);
  zp_result_add_sensitivity(result, "travel_m", slope->key, travel);
  zp_result_add_sensitivity(result, "mass_kg", slope->key, mass);
}

/* A case with another mesh or kind does not count as a neighbour. */
static const ZpLimits *neighbour_of(const Finder *f) {
  const ZpResult *neighbour = f->task->input.neighbour;
  const ZpLimits *near = neighbour ? neighbour->limits : NULL;
  return near && near->ribbons == f->limits->ribbons && near->nodes == f->limits->nodes ? near : NULL;
}

static void run(Finder *f, ZpResult *r) {
  f->rest.statics.stop = asked_to_stop;
  f->rest.statics.caller = f;
  zp_limits_find(&f->rest, neighbour_of(f), true, f->limits);
  bool hangs = f->limits->hangs;
  zp_add_limits(f->limits, order, ZP_LIMIT_KINDS, r);
  zp_result_add(r, "travel_m", "m", travel_of(f));
  zp_result_add(r, "mass_kg", "kg", mass_of(f->model));
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
  Finder f = {.model = model, .task = task, .margins = zp_margins_none()};
  result->series = zp_members_table(model, columns, COLUMNS, ZP_LIMIT_KINDS);
  result->shapes = zp_model_shapes(model, ZP_LIMIT_KINDS);
  bool open = result->series && result->shapes && zp_rest_open(&f.rest, model, NULL, NULL);
  if (open) result->limits = f.limits = zp_limits_create(&f.rest);
  if (f.limits)
    run(&f, result);
  else
    status = zp_fail_memory(err);
  if (f.limits && f.limits->hangs) status = zp_sensitivity_of(&f.rest, derive, &f, result, err);
  zp_rest_close(&f.rest);
  zp_model_destroy(model);
  return status;
}
