/* Study `equilibrium`: all equilibria between no voltage and drive.voltage: the hanging branch, the closed branch, the
 * branches that connect them, and the voltages at which the state jumps from one to the other.
 *
 * Both branches are followed for the table. The voltages are those of study limits: of a slowly rising and a slowly
 * falling voltage, rest/limits.h. Theory, section 10. */
#include <math.h>
#include <stdio.h>

#include "base/fail.h"
#include "def/check.h"
#include "study/sensitivity.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "voltage between the electrodes"},
    ZP_STATE_COLUMNS,
    {"stable", "1", "1: stable, 0: unstable"},
    {"branch", "1", "0: followed from hanging without voltage, 1: from closed at drive.voltage"},
};
static const ZpLimitKind order[] = {ZP_LIMIT_PULL_IN, ZP_LIMIT_RELEASE, ZP_LIMIT_CLOSING};
enum { COLUMNS = sizeof columns / sizeof columns[0], ORDER = sizeof order / sizeof order[0], MOST_POINTS = 5000 };

typedef struct Follower {
  ZpEquilibria at;
  ZpLimits *limits;
  int points;
  double shorted; /* voltage at which electrodes without an insulator touched first, V; NAN: they did not */
  double left;    /* voltage at which a branch was not followed further, V; NAN: none */
} Follower;

static void record(Follower *f, int branch) {
  ZpStatics *s = &f->at.rest.statics;
  bool stable = zp_statics_stable(s), last = s->U == zp_drive_voltage(f->at.model) && f->points > 0;
  zp_equilibria_add(&f->at, (double[COLUMNS]){s->U, ZP_STATE_VALUES(s), stable, branch}, f->points, last);
  f->points++;
}

/* -- branches ------------------------------------------------------------------------------------- */

/* Follow the branch from the present equilibrium until the voltage leaves 0 to drive.voltage or makes a short circuit.
 * `growing`: its size, which has the sign of drive.voltage, grows.
 * => false if it was lost on the way. */
static bool follow(Follower *f, bool growing, int mark) {
  const double top = zp_drive_voltage(f->at.model), sign = top < 0 ? -1 : 1; /* of all voltages on the way */
  ZpBranch *branch = &f->at.rest.branch;
  ZpStatics *s = &f->at.rest.statics;
  record(f, mark);
  if (!zp_rest_follow(&f->at.rest, growing == (sign > 0))) return false;
  for (int k = 0; k < MOST_POINTS; k++) {
    if (!zp_branch_advance(branch) || zp_statics_fault_of_stations(s)) return false;
    if (sign * s->U < 0) return true;
    if (zp_statics_shorted(s)) f->shorted = s->U;
    if (zp_statics_shorted(s)) return true;
    bool passed = sign * s->U > sign * top;
    if (passed && !zp_newton_good(zp_rest_reach(&f->at.rest, top).end)) return false;
    record(f, mark);
    if (passed || zp_statics_asked_to_stop(s)) return true;
  }
  return false;
}

/* A branch need not be followed to its end: the voltages do not depend on it. */
static void follow_whole(Follower *f, bool growing, int mark) {
  if (!follow(f, growing, mark)) f->left = f->at.rest.statics.U;
}

/* -- the study ------------------------------------------------------------------------------------ */

/* Both branches; if the hanging and the closed state are connected, the first one contains all. */
static void follow_both(Follower *f) {
  if (!f->limits->hangs || f->at.rest.statics.stopped) return;
  zp_rest_go_to(&f->at.rest, f->limits->start);
  follow_whole(f, true, 0);
  if (f->at.model->pouch.w > 0 && isnan(f->left)) zp_equilibria_add_members(&f->at); /* those at drive.voltage */
  bool whole = isnan(f->left) && f->at.model->field && zp_quasistatic_is_closed(&f->at.rest);
  if (whole || !f->limits->closes || f->at.rest.statics.stopped) return;
  zp_rest_go_to(&f->at.rest, f->limits->closed);
  follow_whole(f, false, 1);
}

static void note(Follower *f) {
  ZpResult *r = f->at.result;
  zp_equilibria_note(&f->at, zp_drive_voltage(f->at.model));
  if (zp_drive_voltage(f->at.model) > 0) zp_note_start(r, f->at.model, zp_table_get(r->series, 0, "opening_m"));
  if (!isnan(f->left))
    zp_result_note(
        r,
        "a branch of the table ends at %.4g V, so equilibria are missing there; pull-in, closing and release do not "
        "depend on them",
        f->left);
  if (!isnan(f->shorted))
    zp_result_note(
        r,
        "short circuit at %.4g V: electrodes without an insulator touch, and the branch ends; give insulator.thickness",
        f->shorted);
}

static void describe(Follower *f) {
  ZpResult *r = f->at.result;
  ZpStatics *statics = &f->at.rest.statics;
  size_t size = sizeof r->message;
  bool stopped = statics->stopped, lost = zp_limits_lost(f->limits);
  r->outcome = stopped ? ZP_INTERRUPTED : !f->limits->hangs ? ZP_NOT_SETTLED : lost ? ZP_BRANCH_LOST : ZP_FOLLOWED;
  if (stopped)
    snprintf(r->message, size, "interrupted at %.4g V; the results so far are kept", fabs(statics->U));
  else if (!f->limits->hangs)
    snprintf(r->message, size, "%s", zp_statics_no_rest(statics, (char[ZP_NO_REST_SIZE]){0}));
  else if (!isnan(f->shorted) && isnan(f->limits->limit[ZP_LIMIT_PULL_IN].value))
    snprintf(r->message, size, "short circuit at %.4g V: electrodes without an insulator touch", f->shorted);
  else
    zp_describe_limits(statics, f->limits, false, r);
}

static void derive(void *user, ZpRestSensitivity *slope, ZpResult *result) {
  Follower *f = user;
  zp_derive_limits(&f->at.rest, f->limits, order, ORDER, slope, result);
}

static void estimate(void *user, const ZpOtherMesh *other) {
  Follower *f = user;
  zp_estimate_limits(&f->at.rest, f->limits, order, ORDER, other);
}

static ZpStatus run(Follower *f, ZpError *err) {
  f->limits = zp_limits_create(&f->at.rest);
  if (!f->limits) return zp_fail_memory(err);
  zp_limits_find(&f->at.rest, NULL, false, f->limits);
  zp_add_limits(f->limits, order, ORDER, f->at.result);
  zp_result_add(f->at.result, "iterations", "count", f->limits->info.iterations);
  zp_result_add(f->at.result, "residual", "1", f->limits->info.residual);
  follow_both(f);
  zp_result_add(f->at.result, "points", "count", f->points);
  describe(f);
  note(f);
  if (!f->limits->hangs || f->at.rest.statics.stopped) return ZP_OK;
  ZpStatus status = zp_sensitivity_of(&f->at.rest, derive, f, f->at.result, err);
  return status == ZP_OK ? zp_estimate_from_there(&f->at, true, estimate, f, err) : status;
}

static const ZpRule rule[] = {
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_NOT(ribbon.model, ZP_RIBBON_SPATIAL),
            "voltages act on ribbons in a plane; use study stationary"),
};
const ZpRules zp_rules_equilibrium = ZP_RULES_OF(rule);

ZpStatus zp_check_equilibrium(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_check_sensitivity(def, err);
  return status == ZP_OK ? zp_def_check_voltage(def, def->drive.voltage, err) : status;
}

ZpStatus zp_study_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err) {
  const ZpActuatorDef *def = task->def;
  Follower f = {.at = {.task = task,
                       .result = result,
                       .stage = "following",
                       .top = fmax(fabs(def->drive.voltage), 1),
                       .column = columns,
                       .columns = COLUMNS,
                       .rows = (size_t)def->output.samples,
                       .shapes = (size_t)def->output.shapes},
                .shorted = NAN,
                .left = NAN};
  ZpStatus status = zp_equilibria_open(&f.at, def, NULL, NULL, err);
  if (status == ZP_OK) status = run(&f, err);
  zp_limits_destroy(f.limits);
  zp_equilibria_close(&f.at);
  return status;
}
