/* Study `limits`: pull-in, closing, release and the largest load. Each is solved as the limit point or event that it
 * is, without following the curve, by rest/limits.h. Theory, section 10. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/device.h"
#include "study/sensitivity.h"

static const ZpColumn columns[] = {
    {"limit", "1", "0: pull-in, 1: closing, 2: release, 3: largest load"},
    {"voltage_V", "V", "voltage between the electrodes"},
    {"load_kg", "kg", "mass hung on the actuator"},
    ZP_STATE_COLUMNS,
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static const ZpLimitKind order[] = {ZP_LIMIT_PULL_IN, ZP_LIMIT_CLOSING, ZP_LIMIT_RELEASE, ZP_LIMIT_LOAD};

typedef struct Finder {
  ZpEquilibria at;
  ZpLimits *limits;
} Finder;

/* -- the actuator ----------------------------------------------------------------------------------- */

static double mass_of_one(const ZpModel *model) {
  const bool rigid = zp_def_has(&model->def, ZP_DEVICE_RIGID); /* its nodes have the mass of its platform */
  double sum = -zp_load_share(model) * model->def.load.mass - zp_series_inertia(model), platform = 0;
  for (size_t j = 0; j < model->count; j++)
    sum += model->mass[j];
  for (size_t i = 0; zp_has_platform(&model->topology) && !rigid && i < model->s; i++)
    platform += zp_ribbon_section(model, i).mu * model->def.platform.length;
  return model->parts * sum + model->def.stack.parallel * platform;
}

/* Mass of an actuator's strips and insulators, clips and platforms, kg. */
static double mass_of(const ZpModel *model) {
  double sum = 0;
  for (const ZpModel *m = model; m < zp_lowest(model) && !zp_is_network(model); m++)
    sum += m->def.load.mass; /* of the link on which the next one hangs */
  for (const ZpModel *m = model; m < model + model->members; m++)
    sum += mass_of_one(m);
  return sum;
}

/* Opening of a state, m. */
static double opening_at(Finder *f, const double *state) {
  zp_rest_go_to(&f->at.rest, state);
  return zp_statics_opening(&f->at.rest.statics);
}

void zp_limits_destroy(ZpLimits *limits) {
  if (!limits) return;
  zp_free(limits->memory);
  zp_free(limits);
}

/* -- the study ------------------------------------------------------------------------------------- */

/* Go to one of the states between which a voltage that rises slowly to drive.voltage leads. */
static void look(Finder *f, bool exists, const double *state) {
  if (exists) zp_rest_go_to(&f->at.rest, state);
  if (exists) zp_equilibria_look(&f->at);
}

static void record(Finder *f, int kind) {
  ZpStatics *s = &f->at.rest.statics;
  if (isnan(f->limits->limit[kind].value)) return;
  zp_rest_go_to(&f->at.rest, f->limits->limit[kind].state);
  zp_equilibria_add(&f->at, (double[COLUMNS]){kind, s->U, s->load, ZP_STATE_VALUES(s)}, kind, false);
}

/* The derivative of the opening of a state. */
static double slope_of_opening(Finder *f, ZpRestSensitivity *slope, const double *state, int inputs) {
  zp_rest_go_to(&f->at.rest, state);
  if (!zp_rest_sensitivity_solve(slope, inputs)) return NAN;
  return zp_rest_sensitivity_of(slope, zp_output_opening, NULL);
}

/* Derivatives of travel_m and mass_kg; the latter follow from the definition alone. `user` is a Finder. */
static void derive(void *user, ZpRestSensitivity *slope, ZpResult *result) {
  Finder *f = user;
  double mass = 0, travel = NAN;
  zp_derive_limits(&f->at.rest, f->limits, order, ZP_LIMIT_KINDS, slope, result);
  for (int k = 0; k < slope->by.count; k++)
    mass += slope->by.near[k].weight * mass_of(slope->by.near[k].model);
  if (f->limits->closes)
    travel = slope_of_opening(f, slope, f->limits->start, ZP_SETS_LOAD) -
             slope_of_opening(f, slope, f->limits->closed, ZP_SETS_LOAD | ZP_SETS_VOLTAGE);
  zp_result_add_sensitivity(result, "travel_m", slope->key, travel);
  zp_result_add_sensitivity(result, "mass_kg", slope->key, mass);
}

/* Estimated errors; `user` is a Finder. */
static void estimate(void *user, const ZpOtherMesh *other) {
  Finder *f = user;
  zp_estimate_limits(&f->at.rest, f->limits, order, ZP_LIMIT_KINDS, other);
}

static void describe(Finder *f, ZpResult *r) {
  ZpStatics *statics = &f->at.rest.statics;
  bool stopped = statics->stopped, hangs = f->limits->hangs, lost = zp_limits_lost(f->limits);
  r->outcome = stopped ? ZP_INTERRUPTED : !hangs ? ZP_NOT_SETTLED : lost ? ZP_BRANCH_LOST : ZP_CONVERGED;
  if (stopped || !hangs)
    snprintf(r->message, sizeof r->message, "%s",
             stopped ? "interrupted; the results so far are kept"
                     : zp_statics_no_rest(statics, (char[ZP_NO_REST_SIZE]){0}));
  else
    zp_describe_limits(statics, f->limits, true, r);
}

static void run(Finder *f, ZpResult *r) {
  const ZpResult *neighbour = f->at.task->input.neighbour;
  const ZpLimits *near = neighbour ? neighbour->limits : NULL;
  bool alike = near && near->save == f->limits->save && near->equations == f->limits->equations; /* in their states */
  zp_limits_find(&f->at.rest, alike ? near : NULL, true, f->limits);
  bool hangs = f->limits->hangs;
  zp_add_limits(f->limits, order, ZP_LIMIT_KINDS, r);
  bool travels = hangs && f->limits->closes; /* from hanging without voltage to closed at drive.voltage */
  zp_result_add(r, "travel_m", "m",
                travels ? opening_at(f, f->limits->start) - opening_at(f, f->limits->closed) : (double)NAN);
  zp_result_add(r, "mass_kg", "kg", mass_of(f->at.model));
  zp_result_add(r, "warm_starts", "count", f->limits->warm);
  describe(f, r);
  for (int k = 0; hangs && k < ZP_LIMIT_KINDS; k++)
    record(f, k);
  look(f, hangs, f->limits->start);
  look(f, f->limits->closes, f->limits->closed);
  look(f, f->limits->arrives, f->limits->top);
  zp_equilibria_note(&f->at, zp_drive_voltage(f->at.model));
  if (hangs) zp_note_start(r, f->at.model, f->limits->hanging);
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ANY, ZP_HAS(ELECTRODES), "a single ribbon has no electrodes"),
    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_AT_LEAST(drive.voltage, 0),
            "limits are those of a rising voltage; give the curvature the other sign"),
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
  Finder f = {.at = {.task = task,
                     .result = result,
                     .stage = "limits",
                     .column = columns,
                     .columns = COLUMNS,
                     .rows = ZP_LIMIT_KINDS,
                     .shapes = ZP_LIMIT_KINDS}};
  ZpStatus status = zp_equilibria_open(&f.at, task->def, NULL, NULL, err);
  if (status == ZP_OK) result->limits = f.limits = zp_limits_create(&f.at.rest);
  if (status == ZP_OK && !f.limits) status = zp_fail_memory(err);
  if (status == ZP_OK) run(&f, result);
  if (status == ZP_OK && f.limits->hangs) status = zp_sensitivity_of(&f.at.rest, derive, &f, result, err);
  if (status == ZP_OK && f.limits->hangs) status = zp_estimate_from_there(&f.at, true, estimate, &f, err);
  zp_equilibria_close(&f.at);
  return status;
}
