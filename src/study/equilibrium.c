/* Study `equilibrium`: all equilibria between no voltage and drive.voltage: the hanging branch, the closed branch, the
 * branches that connect them, and the voltages at which the state jumps from one to the other.
 *
 * Both branches are followed for the table. The voltages are those of study limits: of a slowly rising and a slowly
 * falling voltage, rest/limits.h. Theory, section 10. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "study/equilibria.h"
#include "study/sensitivity.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "voltage between the electrodes"},
    ZP_STATE_COLUMNS,
    {"stable", "1", "1: stable, 0: unstable"},
    {"branch", "1", "0: followed from hanging without voltage, 1: from closed at drive.voltage"},
};
static const ZpLimitKind order[] = {ZP_LIMIT_PULL_IN, ZP_LIMIT_RELEASE, ZP_LIMIT_CLOSING};
enum { COLUMNS = sizeof columns / sizeof columns[0], ORDER = sizeof order / sizeof order[0], MOST_POINTS = 5000 };

/* A state hangs if the distance of the faces that close last is within this share of the one without voltage. */
static const double hanging_part = 0.01;

typedef struct Follower {
  ZpEquilibria at;
  ZpLimits *limits;
  int points;
  double shorted; /* voltage at which electrodes without an insulator touched first, V; NAN: they did not */
  bool ran_back;  /* the hanging branch turned back into itself */
  int turns;      /* limit points on the present branch */
  double left;    /* voltage at which a branch was not followed further beyond a limit point, V; NAN: none */
  ZpOutcome outcome;
} Follower;

static void record(Follower *f, int branch) {
  ZpStatics *s = &f->at.rest.statics;
  bool stable = zp_statics_stable(s), last = s->U == f->at.model->def.drive.voltage && f->points > 0;
  zp_equilibria_add(&f->at, (double[COLUMNS + ZP_BEHIND]){s->U, ZP_STATE_VALUES(s), stable, branch}, f->points, last);
  f->points++;
}

static bool is_beyond_top(void *user) {
  const Follower *f = user;
  return f->at.rest.statics.U > f->at.model->def.drive.voltage;
}

/* The equilibrium at drive.voltage, which the last step passed. */
static bool arrive(Follower *f) {
  zp_branch_approach(&f->at.rest.branch, is_beyond_top, f);
  return zp_newton_good(zp_rest_settle(&f->at.rest, f->at.model->def.drive.voltage).end);
}

/* -- branches ------------------------------------------------------------------------------------- */

/* Without voltage there is only the hanging state: has the branch returned to it? */
static bool is_hanging(Follower *f) {
  double hanging = f->limits->hanging;
  return hanging > 0 && fabs(zp_closing_gap(&f->at.rest.statics, NULL) / hanging - 1) < hanging_part;
}

/* Follow the branch from the present equilibrium until the voltage leaves [0, drive.voltage] or makes a short circuit.
 * => false if it was lost on the way. */
static bool follow(Follower *f, bool growing, int mark) {
  double top = f->at.model->def.drive.voltage;
  record(f, mark);
  if (!zp_rest_follow(&f->at.rest, growing)) return false;
  for (int k = 0; k < MOST_POINTS; k++) {
    double direction = f->at.rest.branch.direction_m;
    if (!zp_branch_advance(&f->at.rest.branch) || zp_statics_fault_of_stations(&f->at.rest.statics)) return false;
    f->turns += direction * f->at.rest.branch.direction_m < 0;
    if (f->at.rest.statics.U < 0) f->ran_back = growing && is_hanging(f);
    if (f->at.rest.statics.U < 0) return !f->ran_back;
    if (zp_statics_shorted(&f->at.rest.statics)) {
      f->shorted = f->at.rest.statics.U;
      return true;
    }
    if (f->at.rest.statics.U > top) {
      if (!arrive(f)) return false;
      record(f, mark);
      return true;
    }
    record(f, mark);
    if (zp_statics_asked_to_stop(&f->at.rest.statics)) return true;
  }
  return false;
}

/* Beyond its first limit point a branch need not be followed: the voltages do not depend on what is there. */
static void follow_whole(Follower *f, bool growing, int mark) {
  f->turns = 0;
  if (follow(f, growing, mark)) return;
  if (f->turns > 0 && !f->ran_back)
    f->left = f->at.rest.statics.U;
  else
    f->outcome = ZP_BRANCH_LOST;
}

/* -- the study ------------------------------------------------------------------------------------ */

/* Both branches; if the hanging and the closed state are connected, the first one contains all. */
static void follow_both(Follower *f) {
  if (!f->limits->hangs) f->outcome = ZP_NOT_SETTLED;
  if (!f->limits->hangs || f->at.rest.statics.stopped) return;
  zp_rest_go_to(&f->at.rest, f->limits->start);
  follow_whole(f, true, 0);
  bool whole =
      f->outcome == ZP_FOLLOWED && isnan(f->left) && f->at.model->field && zp_quasistatic_is_closed(&f->at.rest);
  if (whole || !f->limits->closes || f->at.rest.statics.stopped) return;
  zp_rest_go_to(&f->at.rest, f->limits->closed);
  follow_whole(f, false, 1);
}

static void note(Follower *f) {
  ZpResult *r = f->at.result;
  zp_equilibria_note(&f->at, f->at.model->def.drive.voltage);
  if (f->at.model->def.drive.voltage > 0) zp_note_start(r, f->at.model, zp_table_get(r->series, 0, "opening_m"));
  if (!isnan(f->left))
    zp_result_note(
        r,
        "a branch of the table ends at %.4g V, beyond its first limit point, so equilibria are missing there; "
        "pull-in, closing and release do not depend on them",
        f->left);
  if (!isnan(f->shorted))
    zp_result_note(
        r,
        "short circuit at %.4g V: electrodes without an insulator touch, and the branch ends; give insulator.thickness",
        f->shorted);
}

/* Add words to the end of a message. */
__attribute__((format(printf, 2, 3))) static void add(ZpResult *r, const char *format, ...) {
  const size_t length = strlen(r->message);
  va_list values;
  va_start(values, format);
  vsnprintf(r->message + length, sizeof r->message - length, format, values);
  va_end(values);
}

static void describe_way_up(const Follower *f) {
  ZpResult *r = f->at.result;
  const ZpLimit *closed = &f->limits->limit[ZP_LIMIT_CLOSING];
  const double pull_in = f->limits->limit[ZP_LIMIT_PULL_IN].value, closing = closed->value;
  if (!isnan(pull_in))
    add(r, "pulls in at %.4g V", pull_in);
  else if (!isnan(f->shorted))
    add(r, "short circuit at %.4g V: electrodes without an insulator touch", f->shorted);
  else if (!isnan(closing))
    add(r, "no pull-in: closes gradually at %.4g V", closing);
  else
    add(r, "no pull-in up to %g V", f->at.model->def.drive.voltage);
  if (closed->end == ZP_TRACK_LOST)
    add(r, "; %s", closed->reason);
  else if (!isnan(pull_in) && closing > pull_in)
    add(r, ", closes at %.4g V", closing);
}

static void describe_way_down(const Follower *f) {
  ZpResult *r = f->at.result;
  const ZpLimit *release = &f->limits->limit[ZP_LIMIT_RELEASE];
  const char *trouble = f->ran_back ? "it turned back to hanging" : zp_statics_trouble(&f->at.rest.statics);
  if (!isnan(release->value))
    add(r, ", releases at %.4g V", release->value);
  else if (isnan(f->shorted))
    add(r, "; no release: %s", release->reason);
  if (f->outcome == ZP_BRANCH_LOST) add(r, "; a branch could not be followed to its end");
  if (trouble) add(r, ": %s", trouble);
}

static void describe(const Follower *f) {
  f->at.result->message[0] = 0;
  if (f->at.rest.statics.stopped) {
    add(f->at.result, "interrupted at %.4g V; the results so far are kept", fabs(f->at.rest.statics.U));
  } else if (f->outcome == ZP_NOT_SETTLED) {
    add(f->at.result, "%s", zp_statics_no_rest(&f->at.rest.statics));
  } else {
    describe_way_up(f);
    describe_way_down(f);
  }
}

static ZpOutcome outcome_of(const Follower *f) {
  if (f->at.rest.statics.stopped) return ZP_INTERRUPTED;
  return f->outcome == ZP_FOLLOWED && zp_limits_lost(f->limits) ? ZP_BRANCH_LOST : f->outcome;
}

static void derive(void *user, ZpRestSensitivity *slope, ZpResult *result) {
  Follower *f = user;
  zp_derive_limits(&f->at.rest, f->limits, order, ORDER, slope, result);
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
  f->at.result->outcome = outcome_of(f);
  describe(f);
  note(f);
  if (f->outcome == ZP_NOT_SETTLED || f->at.rest.statics.stopped) return ZP_OK;
  return zp_sensitivity_of(&f->at.rest, derive, f, f->at.result, err);
}

static const ZpRule rule[] = {
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
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
                       .top = fmax(def->drive.voltage, 1),
                       .column = columns,
                       .columns = COLUMNS,
                       .rows = (size_t)def->output.samples,
                       .shapes = (size_t)def->output.shapes},
                .shorted = NAN,
                .left = NAN,
                .outcome = ZP_FOLLOWED};
  ZpStatus status = zp_equilibria_open(&f.at, def, NULL, NULL, err);
  if (status == ZP_OK) status = run(&f, err);
  zp_limits_destroy(f.limits);
  zp_equilibria_close(&f.at);
  return status;
}
