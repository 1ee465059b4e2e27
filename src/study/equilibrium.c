/* Study `equilibrium`: all states of rest between no voltage and drive.voltage: the branch that hangs, the one
 * that is closed, what connects them, and the voltages at which one jumps to the other. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/statics.h"
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
enum { COLUMNS = sizeof columns / sizeof columns[0], MOST_POINTS = 20000, MOST_LIMITS = 256 };

/* Steps along the branch: 0.01 L of mean movement or drive.voltage count 1. */
static const double first_step = 0.01, longest_step = 0.1;

/* Two neighbouring limit points closer than this, relative, are a ripple of the mesh: the front passing a node
 * of an unstable branch. Measured at N = 61 without breakdown cap, where it is largest: 0.35 %. */
static const double ripple = 5e-3;

typedef struct Follower {
  const ZpModel *model;
  const ZpHooks *hooks;
  ZpResult *result;
  ZpStatics statics;
  ZpBranch branch;
  ZpBranchSystem system;
  void *memory;
  double *line_force;
  double limit[MOST_LIMITS]; /* voltages at the limit points of the branch under way */
  int limits, points;
  double shorted; /* voltage at which electrodes without an insulator touched first, V; NAN: they did not */
  ZpOutcome outcome;
} Follower;

static bool allocate(Follower *f) {
  if (!zp_statics_create(f->model, &f->statics)) return false;
  f->system = zp_statics_branch(&f->statics, ZP_ALONG_VOLTAGE);
  ZpCarver carver = {NULL, 0};
  for (int pass = 0; pass < 2; pass++) {
    if (pass) {
      f->memory = zp_calloc(1, carver.used);
      carver = (ZpCarver){f->memory, 0};
      if (!f->memory) return false;
    }
    zp_branch_carve(&f->branch, &f->system, f->statics.assembly.bandwidth, &carver);
    f->line_force = zp_carve(&carver, f->model->nodes);
  }
  return true;
}

static void record(Follower *f, int branch) {
  const ZpModel *model = f->model;
  ZpStatics *s = &f->statics;
  bool stable = zp_statics_stable(s, &f->branch.newton);
  double row[COLUMNS] = {s->U,
                         zp_statics_stroke(s),
                         zp_statics_opening(s),
                         (double)zp_statics_front(s) * model->l,
                         zp_statics_charge(s),
                         zp_statics_capacitance(s),
                         stable,
                         branch};
  bool last = s->U == model->def.drive.voltage && f->points > 0;
  ZpShape shape = zp_statics_shape(s, f->points++, f->line_force);
  zp_table_offer(f->result->series, row);
  zp_shapes_offer(f->result->shapes, &shape);
  if (!last) return;
  zp_table_keep_last(f->result->series, row);
  zp_shapes_keep_last(f->result->shapes, &shape);
}

static bool asked_to_stop(const Follower *f) {
  const ZpHooks *hooks = f->hooks;
  double fraction = fabs(f->statics.U) / fmax(f->model->def.drive.voltage, 1);
  return hooks && hooks->progress && hooks->progress(hooks->user, "following", fmin(fraction, 1));
}

static void note_limit(Follower *f, double voltage) {
  if (f->limits < MOST_LIMITS) f->limit[f->limits++] = voltage;
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
    if (height > ripple) return;
    for (int i = least; i + 2 < f->limits; i++)
      f->limit[i] = f->limit[i + 2];
    f->limits -= 2;
  }
}

/* The last point exactly at the highest voltage. */
static bool end_at(Follower *f, double voltage, int mark) {
  ZpStaticSystem system = zp_statics_system(&f->statics);
  enum { MOST = 30 };
  f->statics.U = voltage;
  if (!zp_newton_good(zp_newton(&system, zp_statics_tolerance(&f->statics), MOST, &f->branch.newton).end)) return false;
  record(f, mark);
  return true;
}

/* Follow the branch from the present equilibrium until the voltage leaves [0, drive.voltage] or makes a short circuit.
 * => false if it was lost on the way. */
static bool follow(Follower *f, bool growing, int mark) {
  double top = f->model->def.drive.voltage;
  double tolerance = 2 * zp_statics_tolerance(&f->statics);
  f->limits = 0;
  record(f, mark);
  if (!zp_branch_start(&f->branch, growing, first_step, longest_step, tolerance)) return false;
  double direction = f->branch.direction_m;
  for (int k = 0; k < MOST_POINTS; k++) {
    if (!zp_branch_advance(&f->branch)) return false;
    if (f->branch.direction_m * direction < 0) note_limit(f, zp_branch_limit(&f->branch));
    direction = f->branch.direction_m;
    if (f->statics.U < 0) return true;
    if (zp_statics_shorted(&f->statics)) {
      f->shorted = f->statics.U;
      return true;
    }
    if (f->statics.U > top) return end_at(f, top, mark);
    record(f, mark);
    if (asked_to_stop(f)) {
      f->outcome = ZP_INTERRUPTED;
      return true;
    }
  }
  return false;
}

/* Both branches; where hanging and closed are connected, the first holds all. */
static void follow_both(Follower *f, double *pull_in, double *release) {
  *pull_in = *release = NAN;
  ZpNewtonInfo info = zp_statics_hang(&f->statics, &f->branch.newton);
  zp_result_add(f->result, "iterations", "count", info.iterations);
  zp_result_add(f->result, "residual", "1", info.residual);
  if (!zp_newton_good(info.end)) {
    f->outcome = ZP_NOT_SETTLED;
    return;
  }
  if (!follow(f, true, 0)) f->outcome = ZP_BRANCH_LOST;
  smooth_limits(f);
  if (f->limits > 0) *pull_in = f->limit[0];
  if (f->limits > 1) *release = f->limit[f->limits - 1];
  if (f->limits > 1 || !f->model->field || f->outcome != ZP_FOLLOWED) return;
  if (f->model->def.insulator.thickness == 0) return; /* closed is a short circuit */
  if (!zp_newton_good(zp_statics_close(&f->statics, f->model->def.drive.voltage, &f->branch.newton).end)) return;
  if (!zp_statics_stable(&f->statics, &f->branch.newton)) return;
  if (!follow(f, false, 1)) f->outcome = ZP_BRANCH_LOST;
  smooth_limits(f);
  if (f->limits > 0) *release = f->limit[0];
}

static void note(Follower *f) {
  ZpResult *r = f->result;
  zp_note_model(r, f->model, f->model->def.drive.voltage, r->shapes->frames);
  if (f->model->def.drive.voltage > 0) zp_note_start(r, f->model, zp_table_get(r->series, 0, "opening_m"));
  if (!isnan(f->shorted))
    zp_result_note(r, "at %.4g V electrodes without an insulator touch, a short circuit: the branch ends there",
                   f->shorted);
}

static void describe(Follower *f, double pull_in, double release) {
  ZpResult *r = f->result;
  size_t size = sizeof r->message;
  const char *trouble = zp_statics_trouble(&f->statics);
  if (f->outcome == ZP_NOT_SETTLED)
    snprintf(r->message, size, "no hanging equilibrium found");
  else if (f->outcome == ZP_BRANCH_LOST)
    snprintf(r->message, size, "lost the branch at %.4g V%s%s; what was found is kept", f->statics.U,
             trouble ? ": " : "", trouble ? trouble : "");
  else if (isnan(pull_in) && !isnan(f->shorted))
    snprintf(r->message, size, "short circuit at %.4g V: electrodes without an insulator touch", f->shorted);
  else if (isnan(pull_in))
    snprintf(r->message, size, "no pull-in up to %g V", f->model->def.drive.voltage);
  else if (isnan(release))
    snprintf(r->message, size, "pulls in at %.4g V", pull_in);
  else
    snprintf(r->message, size, "pulls in at %.4g V, releases at %.4g V", pull_in, release);
}

static ZpStatus run(Follower *f, ZpError *err) {
  const ZpActuatorDef *def = &f->model->def;
  f->result->series = zp_table_create(columns, COLUMNS, (size_t)def->output.samples);
  f->result->shapes = zp_shapes_create(f->model->s, f->model->nodes, (size_t)def->output.shapes);
  if (!f->result->series || !f->result->shapes || !allocate(f)) return zp_fail_memory(err);
  double pull_in, release;
  zp_result_add(f->result, "pull_in_voltage_V", "V", NAN);
  zp_result_add(f->result, "release_voltage_V", "V", NAN);
  follow_both(f, &pull_in, &release);
  f->result->scalar[0].value = pull_in;
  f->result->scalar[1].value = release;
  zp_result_add(f->result, "points", "count", f->points);
  f->result->outcome = f->outcome;
  describe(f, pull_in, release);
  note(f);
  return ZP_OK;
}

ZpStatus zp_study_equilibrium(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(def, &model, err);
  if (status != ZP_OK) return status;
  Follower f = {.model = model, .hooks = hooks, .result = result, .shorted = NAN, .outcome = ZP_FOLLOWED};
  status = run(&f, err);
  zp_free(f.memory);
  zp_statics_destroy(&f.statics);
  zp_model_destroy(model);
  return status;
}
