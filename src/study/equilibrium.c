/* Study `equilibrium`: all states of rest between no voltage and drive.voltage: the branch that hangs, the one
 * that is closed, what connects them, and the voltages at which one jumps to the other.
 *
 * Both branches are followed for the table; pull-in is the first limit point of the one that hangs. Where a slowly
 * rising voltage closes the actuator, and where a slowly falling one opens it, is found by changing the voltage slowly:
 * along a branch while that is stable, and from each limit point to the state in which slow motion ends. Theory,
 * section 10. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/closing.h"
#include "rest/rest.h"
#include "study/notes.h"
#include "study/studies.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "potential difference of the electrodes"},
    {"stroke_m", "m", "height of the clip over the lower platform, signed"},
    {"opening_m", "m", "distance of the platforms' faces"},
    {"zipped_length_m", "m", "closed length from the clip, one half"},
    {"charge_C", "C", "charge on the electrodes"},
    {"capacitance_F", "F", "capacitance of the electrodes"},
    {"stable", "1", "1: comes back when pushed, 0: does not"},
    {"branch", "1", "0: followed from hanging without voltage, 1: from closed at drive.voltage"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0], MOST_POINTS = 20000 };

/* Hanging: the faces that close last are within this part of where they hang without voltage. */
static const double hanging_part = 0.01;

/* The voltages asked for; NAN: there is none, and `no_release` says why. */
typedef struct Voltages {
  double pull_in, closing, release;
  const char *no_release;
} Voltages;

typedef struct Follower {
  const ZpModel *model;
  const ZpHooks *hooks;
  ZpResult *result;
  ZpRest rest;
  ZpFold fold;   /* a limit point or event that was passed, solved as such */
  double *limit; /* [MOST_POINTS] voltages at the limit points of the branch under way */
  int limits, points;
  double shorted;  /* voltage at which electrodes without an insulator touched first, V; NAN: they did not */
  void *start;     /* of the branch under way */
  void *before;    /* the point before the last step */
  void *here;      /* the present point, while a limit point is solved for */
  double hanging;  /* distance of the faces that close last, without voltage, m */
  double end;      /* voltage at which the way under way ends, V */
  bool growing;    /* towards it */
  bool was_closed; /* before the last step */
  bool jumped;     /* the last change of state was a fall from a limit point */
  bool ran_back;   /* the branch that hangs turned back into itself */
  ZpOutcome outcome;
} Follower;

static void carve(void *user, ZpCarver *carver) {
  Follower *f = user;
  const ZpAssembly *a = &f->rest.statics.assembly;
  f->limit = zp_carve(carver, MOST_POINTS);
  zp_fold_carve(&f->fold, &f->rest.system, a->bandwidth, a->symmetric, &f->rest.branch.newton, carver);
  f->here = zp_carve(carver, zp_rest_save_size(&f->rest));
  f->start = zp_carve(carver, zp_rest_save_size(&f->rest));
  f->before = zp_carve(carver, zp_rest_save_size(&f->rest));
}

static double opening(Follower *f) {
  return zp_closing_gap(&f->rest.statics, NULL);
}

static bool is_closed(Follower *f) {
  return opening(f) <= zp_closing_limit(&f->rest.statics, f->hanging);
}

static void record(Follower *f, int branch) {
  const ZpModel *model = f->model;
  ZpStatics *s = &f->rest.statics;
  bool stable = zp_statics_stable(s, &f->rest.branch.newton);
  double row[COLUMNS] = {s->U,
                         zp_statics_stroke(s),
                         zp_statics_opening(s),
                         (double)zp_statics_front(s) * model->l,
                         zp_statics_charge(s),
                         zp_statics_capacitance(s),
                         stable,
                         branch};
  bool last = s->U == model->def.drive.voltage && f->points > 0;
  ZpShape shape = zp_statics_shape(s, f->points++, f->rest.line_force);
  zp_table_offer(f->result->series, row);
  zp_shapes_offer(f->result->shapes, &shape);
  if (!last) return;
  zp_table_keep_last(f->result->series, row);
  zp_shapes_keep_last(f->result->shapes, &shape);
}

static bool asked_to_stop(const Follower *f) {
  const ZpHooks *hooks = f->hooks;
  double fraction = fabs(f->rest.statics.U) / fmax(f->model->def.drive.voltage, 1);
  return hooks && hooks->progress && hooks->progress(hooks->user, "following", fmin(fraction, 1));
}

/* At most one a step, so there is room. */
static void note_limit(Follower *f, double voltage) {
  f->limit[f->limits++] = voltage;
}

/* The voltage of the limit point, or of the event that the actuator closes or opens, which the last step passed: solved
 * as such from the present point, or, where that leads elsewhere, `near`, which stepping towards it has found. */
static double exactly(Follower *f, double near, bool turned) {
  static const double same = 1e-4;
  const ZpBranchSystem *sys = &f->rest.system;
  ZpStatics *s = &f->rest.statics;
  sys->save(s, f->here);
  s->U = near;
  memcpy(f->fold.null, f->rest.branch.direction, s->assembly.n * sizeof *f->fold.null);
  bool found =
      turned ? zp_fold_solve(&f->fold) : zp_fold_event(&f->fold, zp_closing_gap, zp_closing_limit(s, f->hanging));
  double voltage = s->U;
  sys->restore(s, f->here);
  sys->at_rest.residual(s, f->rest.branch.newton.r, NULL);
  return found && f->fold.negative == 0 && fabs(voltage - near) <= same * fabs(near) ? voltage : near;
}

/* Take out ripples, the smallest first, so that what is left are the turns of the branch itself. */
static void smooth_limits(Follower *f) {
  for (;;) {
    int least = -1;
    double height = INFINITY;
    for (int i = 0; i + 1 < f->limits; i++) {
      double rise = fabs(f->limit[i + 1] - f->limit[i]) / fabs(f->limit[i]);
      if (rise < height) {
        height = rise;
        least = i;
      }
    }
    if (height > ZP_FOLD_RIPPLE) return;
    for (int i = least; i + 2 < f->limits; i++)
      f->limit[i] = f->limit[i + 2];
    f->limits -= 2;
  }
}

static bool is_beyond(void *user) {
  const Follower *f = user;
  return f->growing ? f->rest.statics.U > f->end : f->rest.statics.U < f->end;
}

/* The equilibrium at `voltage`, which the last step passed. */
static bool arrive(Follower *f, bool growing, double voltage) {
  f->growing = growing;
  f->end = voltage;
  zp_branch_approach(&f->rest.branch, is_beyond, f);
  return zp_newton_good(zp_rest_settle(&f->rest, voltage).end);
}

/* -- branches ------------------------------------------------------------------------------------- */

/* Without voltage there is the hanging state only: has the branch come back to it? */
static bool is_hanging(Follower *f) {
  return f->hanging > 0 && fabs(opening(f) / f->hanging - 1) < hanging_part;
}

/* Follow the branch from the present equilibrium until the voltage leaves [0, drive.voltage] or makes a short circuit.
 * => false if it was lost on the way. */
static bool follow(Follower *f, bool growing, int mark) {
  double top = f->model->def.drive.voltage;
  f->limits = 0;
  record(f, mark);
  if (!zp_rest_follow(&f->rest, growing)) return false;
  double direction = f->rest.branch.direction_m;
  for (int k = 0; k < MOST_POINTS; k++) {
    if (!zp_branch_advance(&f->rest.branch)) return false;
    if (f->rest.branch.direction_m * direction < 0) note_limit(f, exactly(f, zp_branch_limit(&f->rest.branch), true));
    direction = f->rest.branch.direction_m;
    if (f->rest.statics.U < 0) f->ran_back = growing && is_hanging(f);
    if (f->rest.statics.U < 0) return !f->ran_back;
    if (zp_statics_shorted(&f->rest.statics)) {
      f->shorted = f->rest.statics.U;
      return true;
    }
    if (f->rest.statics.U > top) {
      if (!arrive(f, true, top)) return false;
      record(f, mark);
      return true;
    }
    record(f, mark);
    if (asked_to_stop(f)) {
      f->outcome = ZP_INTERRUPTED;
      return true;
    }
  }
  return false;
}

static void follow_whole(Follower *f, bool growing, int mark) {
  if (!follow(f, growing, mark)) f->outcome = ZP_BRANCH_LOST;
  smooth_limits(f);
}

/* -- a voltage that changes slowly ---------------------------------------------------------------- */

/* How a slow change ends. */
typedef enum Slow { ARRIVED, CHANGED, LOST, STOPPED } Slow;

static bool has_changed(void *user) {
  Follower *f = user;
  return is_closed(f) != f->was_closed;
}

/* From near a limit point at `voltage`, descend to the state beyond it; the branch is followed from that state. */
static bool fall(Follower *f, bool growing, double voltage) {
  ZpStatics *s = &f->rest.statics;
  f->rest.system.restore(s, f->before);
  s->U = voltage * (growing ? 1 + ZP_CLOSING_BEYOND : 1 - ZP_CLOSING_BEYOND);
  double limit = zp_closing_limit(s, f->hanging);
  return zp_closing_fall(s, limit, f->was_closed, true, &f->rest.branch.newton) && zp_rest_follow(&f->rest, growing);
}

/* Continue along a stable branch: change the voltage slowly to `end`, or until the actuator closes or opens. => *at:
 * the voltage that was reached */
static Slow change_slowly(Follower *f, bool growing, double end, double *at) {
  f->was_closed = is_closed(f);
  for (int k = 0; k < MOST_POINTS; k++) {
    f->rest.system.save(&f->rest.statics, f->before);
    if (!zp_branch_advance(&f->rest.branch)) return LOST;
    bool turned = growing ? f->rest.branch.direction_m < 0 : f->rest.branch.direction_m > 0;
    bool passed = turned || has_changed(f);
    *at = passed ? exactly(f, zp_branch_where(&f->rest.branch, has_changed, f), turned) : f->rest.statics.U;
    if (growing ? *at >= end : *at <= end) return arrive(f, growing, end) ? ARRIVED : LOST;
    if (turned && !fall(f, growing, *at)) return LOST;
    f->jumped = turned;
    if (has_changed(f)) return CHANGED;
    if (asked_to_stop(f)) {
      f->outcome = ZP_INTERRUPTED;
      return STOPPED;
    }
  }
  return LOST;
}

/* From hanging without voltage to drive.voltage. A ripple from which the state falls to closed is no ripple, but the
 * pull-in. => closed there? */
static bool raise_voltage(Follower *f, Voltages *v) {
  double at;
  Slow end = CHANGED;
  f->rest.system.restore(&f->rest.statics, f->start);
  if (!zp_rest_follow(&f->rest, true)) return false;
  while (end == CHANGED) {
    end = change_slowly(f, true, f->model->def.drive.voltage, &at);
    if (end == CHANGED) v->closing = is_closed(f) ? at : (double)NAN;
    if (end == CHANGED && is_closed(f) && f->jumped) v->pull_in = fmin(v->pull_in, at);
  }
  return end == ARRIVED && is_closed(f);
}

/* From closed at drive.voltage down to 0. */
static void lower_voltage(Follower *f, Voltages *v) {
  double at;
  Slow end = zp_rest_follow(&f->rest, false) ? change_slowly(f, false, 0, &at) : LOST;
  if (end == CHANGED) v->release = isnan(v->closing) ? at : fmin(at, v->closing);
  v->no_release = end == ARRIVED ? "it stays closed down to 0 V" : end == LOST ? "the closed state was lost" : NULL;
}

/* The closed state at drive.voltage: that to which a rising voltage leads, or else the one next to straight ribbons. =>
 * is there one? */
static bool find_closed(Follower *f, Voltages *v) {
  const ZpStatics *s = &f->rest.statics;
  bool closed = raise_voltage(f, v);
  if (f->outcome == ZP_INTERRUPTED) return false;
  if (!closed)
    closed =
        zp_newton_good(zp_statics_close(&f->rest.statics, f->model->def.drive.voltage, &f->rest.branch.newton).end) &&
        is_closed(f);
  return closed && !zp_statics_fault(s);
}

/* -- the study ------------------------------------------------------------------------------------ */

static bool hang(Follower *f) {
  ZpNewtonInfo info = zp_statics_hang(&f->rest.statics, &f->rest.branch.newton);
  zp_result_add(f->result, "iterations", "count", info.iterations);
  zp_result_add(f->result, "residual", "1", info.residual);
  f->rest.system.save(&f->rest.statics, f->start);
  f->hanging = f->model->field ? opening(f) : 0;
  return zp_newton_good(info.end);
}

/* Both branches; where hanging and closed are connected, the first holds all. */
static Voltages find(Follower *f) {
  Voltages v = {NAN, NAN, NAN, NULL};
  if (!hang(f)) {
    f->outcome = ZP_NOT_SETTLED;
    return v;
  }
  follow_whole(f, true, 0);
  if (f->limits > 0) v.pull_in = f->limit[0];
  bool whole = f->outcome == ZP_FOLLOWED && f->model->field && is_closed(f);
  if (f->outcome == ZP_INTERRUPTED || !f->model->field) return v;
  v.no_release = "closed it is a short circuit";
  if (f->model->def.insulator.thickness == 0) return v;
  v.no_release = "it hangs closed";
  if (f->hanging <= zp_closing_limit(&f->rest.statics, 0)) return v;
  v.no_release = "it is not closed at drive.voltage";
  if (!find_closed(f, &v)) return v;
  f->rest.system.save(&f->rest.statics, f->start);
  if (!whole) follow_whole(f, false, 1);
  if (f->outcome == ZP_INTERRUPTED) return v;
  f->rest.system.restore(&f->rest.statics, f->start);
  lower_voltage(f, &v);
  return v;
}

static void note(Follower *f) {
  ZpResult *r = f->result;
  zp_result_note_model(r, f->model, f->model->def.drive.voltage, r->shapes->frames);
  if (f->model->def.drive.voltage > 0) zp_note_start(r, f->model, zp_table_get(r->series, 0, "opening_m"));
  if (!isnan(f->shorted))
    zp_result_note(r, "at %.4g V electrodes without an insulator touch, a short circuit: the branch ends there",
                   f->shorted);
}

static void describe(Follower *f, const Voltages *v) {
  ZpResult *r = f->result;
  char pull_in[96], release[128] = "";
  const char *trouble = f->ran_back ? "it turned back to hanging" : zp_statics_trouble(&f->rest.statics);
  if (!isnan(v->pull_in))
    snprintf(pull_in, sizeof pull_in, "pulls in at %.4g V", v->pull_in);
  else if (!isnan(f->shorted))
    snprintf(pull_in, sizeof pull_in, "short circuit at %.4g V: electrodes without an insulator touch", f->shorted);
  else if (!isnan(v->closing))
    snprintf(pull_in, sizeof pull_in, "no pull-in: closes gradually at %.4g V", v->closing);
  else
    snprintf(pull_in, sizeof pull_in, "no pull-in up to %g V", f->model->def.drive.voltage);
  if (!isnan(v->release))
    snprintf(release, sizeof release, ", releases at %.4g V", v->release);
  else if (v->no_release && isnan(f->shorted))
    snprintf(release, sizeof release, "; no release: %s", v->no_release);
  if (f->outcome == ZP_NOT_SETTLED)
    snprintf(r->message, sizeof r->message, "no hanging equilibrium found");
  else
    snprintf(r->message, sizeof r->message, "%s%s%s%s%s", pull_in, release,
             f->outcome == ZP_BRANCH_LOST ? "; a branch could not be followed to its end" : "", trouble ? ": " : "",
             trouble ? trouble : "");
}

static ZpStatus run(Follower *f, ZpError *err) {
  const ZpActuatorDef *def = &f->model->def;
  f->result->series = zp_table_create(columns, COLUMNS, (size_t)def->output.samples);
  f->result->shapes = zp_shapes_create(f->model->s, f->model->nodes, (size_t)def->output.shapes);
  if (!f->result->series || !f->result->shapes || !zp_rest_open(&f->rest, f->model, carve, f))
    return zp_fail_memory(err);
  const size_t first = f->result->scalars;
  zp_result_add(f->result, "pull_in_voltage_V", "V", NAN);
  zp_result_add(f->result, "release_voltage_V", "V", NAN);
  zp_result_add(f->result, "closing_voltage_V", "V", NAN);
  Voltages v = find(f);
  f->result->scalar[first].value = v.pull_in;
  f->result->scalar[first + 1].value = v.release;
  f->result->scalar[first + 2].value = v.closing;
  zp_result_add(f->result, "points", "count", f->points);
  f->result->outcome = f->outcome;
  describe(f, &v);
  note(f);
  return ZP_OK;
}

ZpStatus zp_check_equilibrium(const ZpActuatorDef *def, ZpError *err) {
  return zp_def_check_voltage(def, def->drive.voltage, err);
}

ZpStatus zp_study_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Follower f = {.model = model, .hooks = task->hooks, .result = result, .shorted = NAN, .outcome = ZP_FOLLOWED};
  status = run(&f, err);
  zp_rest_close(&f.rest);
  zp_model_destroy(model);
  return status;
}
