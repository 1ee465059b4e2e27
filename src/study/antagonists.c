/* Studies `stationary` and `equilibrium` of antagonists: where the load is at rest between both, how stiffly they hold
 * it, and where it jumps. Numbers without a name of their own are of the upper one, which the voltage is of. */
#include "study/antagonists.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/antagonists.h"
#include "rest/closing.h"
#include "solve/fold.h"
#include "study/notes.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "potential difference of the upper one's electrodes"},
    {"stroke_m", "m", "height of the upper one's clip over the load, signed"},
    {"opening_m", "m", "distance of the upper one's platforms' faces"},
    {"zipped_length_m", "m", "closed length of the upper one from the clip, one half"},
    {"charge_C", "C", "charge on the electrodes of both"},
    {"capacitance_F", "F", "capacitance of the electrodes of both"},
    {"stable", "1", "1: comes back when pushed, 0: does not"},
    {"branch", "1", "0: followed from the state without voltage"},
    ZP_MARGIN_COLUMNS,
    {"lower_voltage_V", "V", "potential difference of the lower one's electrodes"},
    {"lower_opening_m", "m", "distance of the lower one's platforms' faces"},
    {"lower_zipped_length_m", "m", "closed length of the lower one from the clip, one half"},
    {"stiffness_N_per_m", "N/m", "force per way by which the load comes back, all else at rest"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0], MOST_POINTS = 5000 };

typedef struct Follower {
  const ZpModel *model;
  const ZpTask *task;
  ZpResult *result;
  ZpAntagonists both;
  int points;
  bool was_stable; /* at the last point */
  bool crossed;    /* the branch ends where another one crosses it */
  double crest;    /* of the voltage, a limit point from which it has not yet gone far down, V; NAN: there is none */
  double highest;  /* of the voltage on the way, V, */
  double before;   /* and until the last step */
  double trough;   /* of the voltage, from which it has not yet gone far up, V; NAN: there is none */
  double pull_in;  /* V; NAN: there is none */
  double release;  /* V; the last trough: where one that is closed opens as the voltage falls */
  double closing;  /* V; NAN: neither has closed */
  double start[2]; /* openings without voltage, m */
  ZpMargins margins;
  ZpManyShapes shapes; /* of both */
} Follower;

static void carve(void *user, ZpCarver *carver) {
  Follower *f = user;
  zp_many_carve(&f->shapes, 2, f->model->count, f->model->nodes, carver);
}

/* -- a point ---------------------------------------------------------------------------------------- */

static ZpStatics *upper(Follower *f) {
  return &f->both.of[0].statics;
}

static ZpStatics *lower(Follower *f) {
  return &f->both.of[1].statics;
}

static ZpShape shape_of(Follower *f) {
  ZpShape shape = {0};
  for (size_t which = 0; which < 2; which++) {
    ZpRest *rest = &f->both.of[which];
    ZpShape one = zp_statics_shape(&rest->statics, f->points, &rest->shape_room);
    zp_margins_join(&f->margins, zp_margins_of(rest->statics.model, &one));
    double *y = zp_many_put(&f->shapes, which, &one);
    if (which == 0) shape = one;
    if (which == 1) zp_shape_turn_over(f->model->below, y);
  }
  zp_many_give(&f->shapes, &shape);
  return shape;
}

static double zipped_length(const ZpStatics *s) {
  return (double)zp_statics_front(s) * s->model->l;
}

static void record(Follower *f) {
  ZpMargins all = f->margins;
  f->margins = zp_margins_none();
  f->was_stable = zp_antagonists_stable(&f->both);
  double stiffness = zp_antagonists_stiffness(&f->both);
  ZpShape shape = shape_of(f);
  double row[COLUMNS] = {upper(f)->U,
                         zp_statics_stroke(upper(f)),
                         zp_statics_opening(upper(f)),
                         zipped_length(upper(f)),
                         zp_statics_charge(upper(f)) + zp_statics_charge(lower(f)),
                         zp_statics_capacitance(upper(f)) + zp_statics_capacitance(lower(f)),
                         f->was_stable,
                         0,
                         ZP_MARGIN_VALUES(f->margins),
                         lower(f)->U,
                         zp_statics_opening(lower(f)),
                         zipped_length(lower(f)),
                         stiffness};
  f->points++;
  zp_margins_join(&f->margins, all);
  zp_table_offer(f->result->series, row);
  zp_shapes_offer(f->result->shapes, &shape);
}

/* Numbers of the present point. */
static void add_point(Follower *f) {
  ZpResult *r = f->result;
  zp_result_add(r, "stroke_m", "m", zp_statics_stroke(upper(f)));
  zp_result_add(r, "opening_m", "m", zp_statics_opening(upper(f)));
  zp_result_add(r, "lower_opening_m", "m", zp_statics_opening(lower(f)));
  zp_result_add(r, "stiffness_N_per_m", "N/m", zp_antagonists_stiffness(&f->both));
}

/* -- the way there ---------------------------------------------------------------------------------- */

static bool asked_to_stop(void *follower) {
  Follower *f = follower;
  return zp_task_stops(f->task, "following", fabs(upper(f)->U) / fmax(f->model->def.drive.voltage, 1));
}

/* From the straight ribbons to the state without a voltage. */
static bool hang(Follower *f) {
  ZpNewtonInfo info = zp_antagonists_hang(&f->both);
  bool found = zp_newton_good(info.end);
  zp_result_add(f->result, "iterations", "count", info.iterations);
  zp_result_add(f->result, "residual", "1", isfinite(info.residual) ? info.residual : NAN);
  f->result->outcome = found ? ZP_CONVERGED : zp_antagonists_stopped(&f->both) ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(f->result->message, sizeof f->result->message, "%s",
           found ? "both at rest against each other" : "no equilibrium of both found");
  return found;
}

static bool open_follower(Follower *f, size_t rows, size_t frames) {
  f->result->series = zp_table_create(columns, COLUMNS, rows);
  f->result->shapes = zp_shapes_create(f->model->s, 2 * f->model->nodes, frames);
  if (!f->result->series || !f->result->shapes) return false;
  f->result->shapes->members = 2;
  if (!zp_antagonists_open(&f->both, f->model, carve, f)) return false;
  zp_antagonists_watch(&f->both, asked_to_stop, f);
  return true;
}

/* What a study does once there is a place for its results. */
static ZpStatus run(const ZpTask *task, size_t rows, size_t frames, void (*find)(Follower *f), ZpResult *result,
                    ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Follower f = {.model = model,
                .task = task,
                .result = result,
                .crest = NAN,
                .trough = NAN,
                .release = NAN,
                .pull_in = NAN,
                .closing = NAN,
                .margins = zp_margins_none()};
  if (open_follower(&f, rows, frames))
    find(&f);
  else
    status = zp_fail_memory(err);
  zp_antagonists_close(&f.both);
  zp_model_destroy(model);
  return status;
}

/* -- stationary ------------------------------------------------------------------------------------- */

static void find_rest(Follower *f) {
  bool found = hang(f);
  if (found) record(f);
  if (found) add_point(f);
  zp_add_stress(f->result, f->model, &f->margins);
  zp_note_mesh(f->result, f->model, 0);
}

ZpStatus zp_opposed_stationary(const ZpTask *task, ZpResult *result, ZpError *err) {
  return run(task, 2, 2, find_rest, result, err);
}

/* -- equilibrium ------------------------------------------------------------------------------------ */

/* Where the voltage was highest before it began to fall, V; NAN: it does not fall. */
static double crest_of(Follower *f, double last, bool rose) {
  if (!(f->both.branch.direction_m < 0)) return NAN;
  return rose ? zp_branch_limit(&f->both.branch) : last;
}

/* A limit point is a crest of the voltage. The load pulls in at the first one from which the branch goes down by more
 * than the ripple of a mesh => pull_in. */
static void look_for_crest(Follower *f, double last, bool rose) {
  double voltage = upper(f)->U, crest = crest_of(f, last, rose);
  f->highest = fmax(f->highest, fmax(voltage, crest));
  if (!isnan(f->pull_in)) return;
  if (isnan(f->crest)) f->crest = crest;
  if (voltage > f->crest) f->crest = NAN;
  if (voltage < (1 - ZP_FOLD_RIPPLE) * f->crest) f->pull_in = f->crest;
}

/* A limit point may be a trough of the voltage, too. Where one of both is closed at drive.voltage, a slowly falling
 * voltage comes to the last one from which the branch goes up by more than the ripple of a mesh => release. */
static void look_for_trough(Follower *f, double last, bool rose) {
  double voltage = upper(f)->U;
  bool turned = !rose && f->both.branch.direction_m > 0;
  if (turned) f->trough = fmin(zp_branch_limit(&f->both.branch), fmin(last, voltage));
  if (voltage < f->trough) f->trough = NAN;
  if (voltage * (1 - ZP_FOLD_RIPPLE) > f->trough) f->release = f->trough;
}

/* How far the nearer of both is from counting as closed, m. */
static double left_to_close(Follower *f) {
  double left[2];
  for (int which = 0; which < 2; which++) {
    const ZpStatics *s = &f->both.of[which].statics;
    left[which] = zp_statics_opening(s) - zp_closing_limit(s, f->start[which]);
  }
  return fmin(left[0], left[1]);
}

/* As the voltage rises slowly one has closed once it is as high as it was anywhere on the way to there => closing. */
static void look_for_closing(Follower *f, double last, double was_left) {
  double left = left_to_close(f), share = was_left / (was_left - left);
  if (!isnan(f->closing) || left > 0 || !(was_left > 0)) return;
  f->closing = fmax(f->before, last + share * (upper(f)->U - last));
}

static bool is_beyond_top(void *user) {
  Follower *f = user;
  return upper(f)->U > f->model->def.drive.voltage;
}

static bool is_at_top(Follower *f) {
  return upper(f)->U == f->model->def.drive.voltage;
}

/* The equilibrium at drive.voltage, which the last step passed. */
static void arrive(Follower *f) {
  zp_branch_approach(&f->both.branch, is_beyond_top, f);
  if (!zp_newton_good(zp_antagonists_settle(&f->both, f->model->def.drive.voltage).end))
    f->result->outcome = ZP_BRANCH_LOST;
}

/* The branch does not go on: another one crosses it where the state loses its stability, or it was lost. */
static void end_at_crossing(Follower *f) {
  f->crossed = f->both.branch.reversed && f->was_stable;
  if (f->crossed)
    f->pull_in = upper(f)->U;
  else
    f->result->outcome = ZP_BRANCH_LOST;
}

/* One step along the branch. => has it come to its end? */
static bool advance(Follower *f) {
  double last = upper(f)->U, left = left_to_close(f);
  bool rose = f->both.branch.direction_m > 0;
  f->before = f->highest;
  if (!zp_branch_advance(&f->both.branch)) {
    end_at_crossing(f);
    return true;
  }
  if (upper(f)->U < 0) return true;
  look_for_crest(f, last, rose);
  look_for_trough(f, last, rose);
  look_for_closing(f, last, left);
  bool top = is_beyond_top(f);
  if (top) arrive(f);
  record(f);
  return top || zp_antagonists_stopped(&f->both);
}

static void describe(Follower *f) {
  ZpResult *r = f->result;
  double top = f->model->def.drive.voltage;
  const char *how = f->crossed ? "loses the middle" : "pulls in";
  if (isnan(f->pull_in))
    snprintf(r->message, sizeof r->message, "no pull-in up to %g V%s", top,
             r->outcome == ZP_BRANCH_LOST ? "; the branch could not be followed to its end" : "");
  else
    snprintf(r->message, sizeof r->message, "%s at %.4g V", how, f->pull_in);
  size_t used = strlen(r->message);
  if (!isnan(f->closing))
    snprintf(r->message + used, sizeof r->message - used, ", one of both closes at %.4g V", f->closing);
  used = strlen(r->message);
  if (!isnan(f->release))
    snprintf(r->message + used, sizeof r->message - used, " and opens again at %.4g V", f->release);
  if (f->crossed)
    zp_result_note(
        r,
        "at %.4g V another branch crosses this one, and the table ends: at higher voltages the load moves to one "
        "side",
        f->pull_in);
}

static void follow(Follower *f) {
  f->result->outcome = ZP_FOLLOWED;
  f->start[0] = zp_statics_opening(upper(f));
  f->start[1] = zp_statics_opening(lower(f));
  record(f);
  bool ends = f->model->def.drive.voltage == 0 || !zp_antagonists_follow(&f->both);
  for (int k = 0; k < MOST_POINTS && !ends; k++)
    ends = advance(f);
  bool arrived = f->result->outcome == ZP_FOLLOWED && is_at_top(f);
  if (!arrived || left_to_close(f) > 0) f->release = NAN;
  describe(f);
  if (zp_antagonists_stopped(&f->both)) f->result->outcome = ZP_INTERRUPTED;
}

static void find_branch(Follower *f) {
  if (!hang(f)) return;
  if (zp_antagonists_bias(&f->both))
    follow(f);
  else {
    f->result->outcome = ZP_NOT_SETTLED;
    snprintf(f->result->message, sizeof f->result->message, "the lower one pulls in below stack.lower_voltage");
  }
}

static void find_equilibria(Follower *f) {
  ZpResult *r = f->result;
  const size_t first = r->scalars;
  zp_result_add(r, "pull_in_voltage_V", "V", NAN);
  zp_result_add(r, "closing_voltage_V", "V", NAN);
  zp_result_add(r, "release_voltage_V", "V", NAN);
  find_branch(f);
  r->scalar[first].value = f->pull_in;
  r->scalar[first + 1].value = f->closing;
  r->scalar[first + 2].value = f->release;
  zp_result_add(r, "points", "count", f->points);
  zp_margins_join(&f->margins, zp_margins_at_clip(f->model, f->model->def.drive.voltage));
  zp_margins_join(&f->margins, zp_margins_at_clip(f->model->below, lower(f)->U));
  zp_add_margins(r, f->model, &f->margins);
  zp_note_mesh(r, f->model, f->model->def.drive.voltage);
  zp_note_rest(r, f->model);
}

ZpStatus zp_opposed_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err) {
  const ZpActuatorDef *def = task->def;
  return run(task, (size_t)def->output.samples, (size_t)def->output.shapes, find_equilibria, result, err);
}
