/* Studies `stationary`, `equilibrium` and `limits` of members that share one load: where it is at rest, how stiffly
 * they hold it, and where it jumps. Numbers without a name of their own are of the first one: of antagonists the upper
 * one, which the voltage is of; those side by side have one opening and one voltage. */
#include "study/together.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/together.h"
#include "solve/fold.h"
#include "study/limits.h"
#include "study/notes.h"

#define COMMON                                                                                                         \
  {"voltage_V", "V", "voltage between the electrodes; antagonists: of the upper one"},                                 \
      {"stroke_m", "m", "height of the clip over the load, signed; antagonists: of the upper one"},                    \
      {"opening_m", "m", "distance between the platforms' faces; antagonists: of the upper one"},                      \
      {"zipped_length_m", "m",                                                                                         \
       "closed length of one half, from the clip, of all members; antagonists: of the upper one"},                     \
      {"charge_C", "C", "charge on the electrodes of all members"},                                                    \
      {"capacitance_F", "F", "capacitance of the electrodes of all members"},                                          \
      {"stable", "1", "1: stable, 0: unstable"}, {"branch", "1", "0: followed from the state without voltage"},        \
      ZP_MARGIN_COLUMNS
#define STIFFNESS                                                                                                      \
  { "stiffness_N_per_m", "N/m", "restoring force per displacement of the load" }
static const ZpColumn columns_opposed[] = {
    COMMON,
    {"lower_voltage_V", "V", "voltage between the electrodes of the lower one"},
    {"lower_opening_m", "m", "distance between the platforms' faces of the lower one"},
    {"lower_zipped_length_m", "m", "closed length of one half of the lower one, from the clip"},
    STIFFNESS,
};
#define OF_MEMBER(k)                                                                                                   \
  {"member_" #k "_force_N", "N", "force with which member " #k " pulls the load up"}, {                                \
    "member_" #k "_zipped_length_m", "m", "closed length of one half of member " #k                                    \
  }
static const ZpColumn columns_abreast[] = {COMMON,       STIFFNESS,    OF_MEMBER(1), OF_MEMBER(2), OF_MEMBER(3),
                                           OF_MEMBER(4), OF_MEMBER(5), OF_MEMBER(6), OF_MEMBER(7), OF_MEMBER(8)};
static const ZpColumn columns_limits[] = {
    {"limit", "1", "0: pull-in, 1: closing, 2: release"},
    {"voltage_V", "V", "voltage between the electrodes; antagonists: of the upper one"},
    {"load_kg", "kg", "mass hung on the actuators"},
    {"stroke_m", "m", "height of the clip over the load, signed; antagonists: of the upper one"},
    {"opening_m", "m", "distance between the platforms' faces; antagonists: of the upper one"},
    {"zipped_length_m", "m", "closed length of one half, from the clip, of all members; antagonists: of the upper one"},
    {"charge_C", "C", "charge on the electrodes of all members"},
    {"capacitance_F", "F", "capacitance of the electrodes of all members"},
    ZP_MARGIN_COLUMNS,
    {"lower_voltage_V", "V", "voltage between the electrodes of the lower one"},
    {"lower_opening_m", "m", "distance between the platforms' faces of the lower one"},
};
enum {
  OF_LOWER = 2, /* columns of limits that only antagonists have */
  LIMIT_COLUMNS = sizeof columns_limits / sizeof columns_limits[0],
  OPPOSED = sizeof columns_opposed / sizeof columns_opposed[0],
  MOST_COLUMNS = sizeof columns_abreast / sizeof columns_abreast[0],
  OF_EACH = 2, /* numbers of each member side by side */
  MOST_POINTS = 5000
};
_Static_assert((int)MOST_COLUMNS > (int)OPPOSED, "a row has room for the columns of either");

/* States that are kept: where the limits are, limit points of which it is not yet known whether they are one, and where
 * the last step began. */
typedef enum Kept { PULL_IN, CLOSING, RELEASE, PASSED, CREST, HIGHEST, BEFORE, KEPT } Kept;
enum { LIMITS = RELEASE + 1 };

typedef struct Follower {
  const ZpModel *model;
  const ZpTask *task;
  ZpResult *result;
  ZpTogether all;
  int points;
  bool limits_only; /* rows are of limits, not of the branch */
  bool was_stable;  /* at the last point */
  bool crossed;     /* the branch ends where another one crosses it */
  double crest;     /* of the voltage, a limit point from which it has not yet gone far down, V; NAN: there is none */
  double highest;   /* of the voltage on the way, V, */
  double before;    /* and until the last step */
  double trough;    /* of the voltage, where one that is closed opens as it falls slowly, V; NAN: there is none */
  double summit;    /* highest voltage of a point since then, V */
  double pull_in;   /* V; NAN: there is none */
  double release;   /* V; NAN: none is closed at drive.voltage */
  double closing;   /* V; NAN: neither has closed */
  double start;     /* opening of the first one without voltage, m */
  double *kept[KEPT], *here;
  ZpMargins margins;
  ZpManyShapes shapes; /* of all */
} Follower;

static void carve(void *user, ZpCarver *carver) {
  Follower *f = user;
  zp_many_carve(&f->shapes, zp_members(f->model), f->model->count, f->model->nodes, carver);
  for (int k = 0; k < KEPT; k++)
    f->kept[k] = zp_carve(carver, zp_together_save_size(&f->all));
  f->here = zp_carve(carver, zp_together_save_size(&f->all));
}

/* -- a point ---------------------------------------------------------------------------------------- */

static ZpStatics *member(Follower *f, size_t which) {
  return &f->all.of[which].statics;
}

static ZpStatics *upper(Follower *f) {
  return member(f, 0);
}

static ZpStatics *lower(Follower *f) {
  return member(f, 1);
}

static ZpShape shape_of(Follower *f) {
  ZpShape shape = {0};
  for (size_t which = 0; which < f->all.count; which++) {
    ZpRest *rest = &f->all.of[which];
    ZpShape one = zp_statics_shape(&rest->statics, f->points, &rest->shape_room);
    zp_margins_join(&f->margins, zp_margins_of(rest->statics.model, &one));
    double *y = zp_many_put(&f->shapes, which, &one);
    if (which == 0) shape = one;
    if (which == 1 && !f->model->abreast) zp_shape_turn_over(f->model->below, y);
  }
  zp_many_give(&f->shapes, &shape);
  return shape;
}

static double zipped_length(const ZpStatics *s) {
  return (double)zp_statics_front(s) * s->model->l;
}

static double charge_of(Follower *f) {
  double sum = 0;
  for (size_t which = 0; which < f->all.count; which++)
    sum += zp_statics_charge(member(f, which));
  return sum;
}

static double capacitance_of(Follower *f) {
  double sum = 0;
  for (size_t which = 0; which < f->all.count; which++)
    sum += zp_statics_capacitance(member(f, which));
  return sum;
}

/* Of the upper antagonist; of those side by side as far as all are closed. */
static double common_length(Follower *f) {
  double least = zipped_length(upper(f));
  for (size_t which = 1; which < f->all.count && f->model->abreast; which++)
    least = fmin(least, zipped_length(member(f, which)));
  return least;
}

/* Behind what all have in common. */
static void put_members(Follower *f, double stiffness, double *place) {
  const double of_lower[] = {lower(f)->U, zp_statics_opening(lower(f)), zipped_length(lower(f)), stiffness};
  if (!f->model->abreast) memcpy(place, of_lower, sizeof of_lower);
  if (f->model->abreast) *place++ = stiffness;
  for (size_t which = 0; which < f->all.count && f->model->abreast; which++, place += OF_EACH) {
    place[0] = zp_together_force(&f->all, which);
    place[1] = zipped_length(member(f, which));
  }
}

static void record(Follower *f) {
  f->was_stable = zp_together_stable(&f->all);
  if (f->limits_only) { /* materials see the whole branch */
    shape_of(f);
    return;
  }
  ZpMargins all = f->margins;
  f->margins = zp_margins_none();
  double stiffness = zp_together_stiffness(&f->all);
  ZpShape shape = shape_of(f);
  const double common[] = {upper(f)->U,
                           zp_statics_stroke(upper(f)),
                           zp_statics_opening(upper(f)),
                           common_length(f),
                           charge_of(f),
                           capacitance_of(f),
                           f->was_stable,
                           0,
                           ZP_MARGIN_VALUES(f->margins)};
  double row[MOST_COLUMNS];
  memcpy(row, common, sizeof common);
  put_members(f, stiffness, row + sizeof common / sizeof common[0]);
  f->points++;
  zp_margins_join(&f->margins, all);
  zp_table_offer(f->result->series, row);
  zp_shapes_offer(f->result->shapes, &shape);
}

static void add_forces(Follower *f) {
  static const char *const names[] = {"member_1_force_N", "member_2_force_N", "member_3_force_N", "member_4_force_N",
                                      "member_5_force_N", "member_6_force_N", "member_7_force_N", "member_8_force_N"};
  for (size_t which = 0; which < f->all.count; which++)
    zp_result_add(f->result, names[which], "N", zp_together_force(&f->all, which));
}

/* Numbers of the present point. */
static void add_point(Follower *f) {
  ZpResult *r = f->result;
  zp_result_add(r, "stroke_m", "m", zp_statics_stroke(upper(f)));
  zp_result_add(r, "opening_m", "m", zp_statics_opening(upper(f)));
  if (!f->model->abreast) zp_result_add(r, "lower_opening_m", "m", zp_statics_opening(lower(f)));
  zp_result_add(r, "stiffness_N_per_m", "N/m", zp_together_stiffness(&f->all));
  if (f->model->abreast) add_forces(f);
}

/* -- the way there ---------------------------------------------------------------------------------- */

static bool asked_to_stop(void *follower) {
  Follower *f = follower;
  return zp_task_stops(f->task, "following", fabs(upper(f)->U) / fmax(f->model->def.drive.voltage, 1));
}

/* From the straight ribbons to the state without a voltage. */
static bool hang(Follower *f) {
  ZpNewtonInfo info = zp_together_hang(&f->all);
  bool found = zp_newton_good(info.end);
  zp_result_add(f->result, "iterations", "count", info.iterations);
  zp_result_add(f->result, "residual", "1", isfinite(info.residual) ? info.residual : NAN);
  f->result->outcome = found ? ZP_CONVERGED : zp_together_stopped(&f->all) ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(f->result->message, sizeof f->result->message, "%s",
           !found              ? "no equilibrium of all members found"
           : f->model->abreast ? "all members at rest under their load"
                               : "both members at rest against each other");
  return found;
}

static bool open_follower(Follower *f, size_t rows, size_t frames) {
  size_t members = zp_members(f->model), count = MOST_COLUMNS - OF_EACH * (ZP_MOST_MEMBERS - members);
  bool abreast = f->model->abreast;
  if (f->limits_only)
    f->result->series = zp_table_create(columns_limits, LIMIT_COLUMNS - (abreast ? OF_LOWER : 0), rows);
  else
    f->result->series = zp_table_create(abreast ? columns_abreast : columns_opposed, abreast ? count : OPPOSED, rows);
  f->result->shapes = zp_shapes_create(f->model->s, members * f->model->nodes, frames);
  if (!f->result->series || !f->result->shapes) return false;
  f->result->shapes->members = members;
  if (!zp_together_open(&f->all, f->model, carve, f)) return false;
  zp_together_watch(&f->all, asked_to_stop, f);
  return true;
}

/* What a study does once there is a place for its results, and how large that is. */
typedef struct Plan {
  void (*find)(Follower *f);
  size_t rows, frames;
  bool limits_only;
} Plan;

static ZpStatus run(Plan plan, const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Follower f = {.model = model,
                .task = task,
                .result = result,
                .limits_only = plan.limits_only,
                .crest = NAN,
                .trough = NAN,
                .release = NAN,
                .pull_in = NAN,
                .closing = NAN,
                .margins = zp_margins_none()};
  if (open_follower(&f, plan.rows, plan.frames))
    plan.find(&f);
  else
    status = zp_fail_memory(err);
  zp_together_close(&f.all);
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

ZpStatus zp_together_stationary(const ZpTask *task, ZpResult *result, ZpError *err) {
  return run((Plan){find_rest, 2, 2, false}, task, result, err);
}

/* -- equilibrium ------------------------------------------------------------------------------------ */

static void keep(Follower *f, Kept from, Kept to) {
  memcpy(f->kept[to], f->kept[from], zp_together_save_size(&f->all) * sizeof *f->here);
}

static void visit_limit(void *user) {
  Follower *f = user;
  zp_together_limit(&f->all);
  zp_together_save(&f->all, f->kept[PASSED]);
}

/* The limit point that the last step passed => PASSED; its voltage, V. */
static double pass_limit(Follower *f) {
  return zp_branch_limit(&f->all.branch, visit_limit, f);
}

/* A limit point is a crest of the voltage. The load pulls in at the first one from which the branch goes down by more
 * than the ripple of a mesh => pull_in. */
static void look_for_crest(Follower *f, bool rose) {
  double voltage = upper(f)->U, crest = rose && f->all.branch.direction_m < 0 ? pass_limit(f) : NAN;
  if (crest > f->highest) keep(f, PASSED, HIGHEST);
  f->highest = fmax(f->highest, fmax(voltage, crest));
  if (!isnan(f->pull_in)) return;
  if (fmax(voltage, crest) > f->crest) f->crest = NAN;
  if (isnan(f->crest) && !isnan(crest)) {
    f->crest = crest;
    keep(f, PASSED, CREST);
  }
  if (!(voltage < (1 - ZP_FOLD_RIPPLE) * f->crest)) return;
  f->pull_in = f->crest;
  keep(f, CREST, PULL_IN);
}

/* Is a trough of the voltage, from which the branch came down, another one than the last, and no ripple of a mesh above
 * it? Way back from here the voltage first rises to the summit between both. */
static bool is_next_trough(const Follower *f, double trough) {
  return isnan(f->trough) || trough < f->trough || trough < (1 - ZP_FOLD_RIPPLE) * f->summit;
}

/* A limit point may be a trough of the voltage, too. Where one of both is closed at drive.voltage, a slowly falling
 * voltage comes to the last one, of a group that only ripples of a mesh part to the lowest. */
static void look_for_trough(Follower *f, bool rose) {
  double voltage = upper(f)->U, trough = !rose && f->all.branch.direction_m > 0 ? pass_limit(f) : NAN;
  bool next = !isnan(trough) && is_next_trough(f, trough);
  f->summit = next ? voltage : fmax(f->summit, voltage);
  if (!next) return;
  f->trough = trough;
  keep(f, PASSED, RELEASE);
}

/* Solve for where one has closed, from the end of the last step, or else from its beginning. */
static bool solve_closing(Follower *f, double last, double here) {
  double least = fmin(last, here), most = fmax(last, here);
  if (zp_together_closing(&f->all, least, most)) return true;
  zp_together_go_to(&f->all, f->kept[BEFORE]);
  return zp_together_closing(&f->all, least, most);
}

/* Within the last step, which began with so much left, one has closed => CLOSING; the voltage there, V. */
static double voltage_of_closing(Follower *f, double last, double was_left) {
  double here = upper(f)->U, share = was_left / (was_left - zp_together_left(&f->all));
  zp_together_save(&f->all, f->here);
  bool solved = solve_closing(f, last, here);
  double voltage = solved ? upper(f)->U : last + share * (here - last);
  zp_together_save(&f->all, f->kept[CLOSING]);
  zp_together_go_to(&f->all, f->here);
  return voltage;
}

/* As the voltage rises slowly one has closed once it is as high as it was anywhere on the way to there => closing. */
static void look_for_closing(Follower *f, double last, double was_left) {
  if (!isnan(f->closing) || zp_together_left(&f->all) > 0 || !(was_left > 0)) return;
  f->closing = voltage_of_closing(f, last, was_left);
  if (f->before <= f->closing) return;
  f->closing = f->before;
  keep(f, HIGHEST, CLOSING);
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
  zp_branch_approach(&f->all.branch, is_beyond_top, f);
  if (!zp_newton_good(zp_together_settle(&f->all, f->model->def.drive.voltage).end))
    f->result->outcome = ZP_BRANCH_LOST;
}

/* The branch does not go on: another one crosses it where the state loses its stability, or it was lost. */
static void end_at_crossing(Follower *f) {
  f->crossed = f->all.branch.reversed && f->was_stable;
  if (f->crossed) zp_together_save(&f->all, f->kept[PULL_IN]);
  if (f->crossed)
    f->pull_in = upper(f)->U;
  else
    f->result->outcome = ZP_BRANCH_LOST;
}

/* One step along the branch. => has it come to its end? */
static bool advance(Follower *f) {
  double last = upper(f)->U, left = zp_together_left(&f->all);
  bool rose = f->all.branch.direction_m > 0;
  f->before = f->highest;
  zp_together_save(&f->all, f->kept[BEFORE]);
  if (!zp_branch_advance(&f->all.branch)) {
    end_at_crossing(f);
    return true;
  }
  if (upper(f)->U < 0) return true;
  look_for_crest(f, rose);
  look_for_trough(f, rose);
  look_for_closing(f, last, left);
  bool top = is_beyond_top(f);
  if (top) arrive(f);
  record(f);
  return top || zp_together_stopped(&f->all);
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
    snprintf(r->message + used, sizeof r->message - used, "%s at %.4g V",
             f->model->abreast ? ", closes" : ", one of both closes", f->closing);
  used = strlen(r->message);
  if (!isnan(f->release))
    snprintf(r->message + used, sizeof r->message - used, "%s at %.4g V",
             f->model->abreast ? ", releases" : " and opens again", f->release);
  if (f->crossed)
    zp_result_note(
        r,
        "at %.4g V another branch crosses this one, and the table ends: at higher voltages the load moves to one "
        "side",
        f->pull_in);
}

static void follow(Follower *f) {
  f->result->outcome = ZP_FOLLOWED;
  f->start = zp_statics_opening(upper(f));
  zp_together_start(&f->all);
  record(f);
  bool ends = f->model->def.drive.voltage == 0 || !zp_together_follow(&f->all);
  for (int k = 0; k < MOST_POINTS && !ends; k++)
    ends = advance(f);
  bool arrived = f->result->outcome == ZP_FOLLOWED && is_at_top(f);
  if (arrived && zp_together_left(&f->all) <= 0) f->release = f->trough;
  describe(f);
  if (zp_together_stopped(&f->all)) f->result->outcome = ZP_INTERRUPTED;
}

static void find_branch(Follower *f) {
  if (!hang(f)) return;
  if (zp_together_bias(&f->all))
    follow(f);
  else {
    f->result->outcome = ZP_NOT_SETTLED;
    snprintf(f->result->message, sizeof f->result->message, "the lower one pulls in below stack.lower_voltage");
  }
}

/* The branch, and the voltages of its limits. */
static void find_voltages(Follower *f) {
  ZpResult *r = f->result;
  const size_t first = r->scalars;
  zp_result_add(r, "pull_in_voltage_V", "V", NAN);
  zp_result_add(r, "closing_voltage_V", "V", NAN);
  zp_result_add(r, "release_voltage_V", "V", NAN);
  find_branch(f);
  r->scalar[first].value = f->pull_in;
  r->scalar[first + 1].value = f->closing;
  r->scalar[first + 2].value = f->release;
}

static void note(Follower *f) {
  ZpResult *r = f->result;
  for (size_t which = 0; which < f->all.count; which++) {
    const ZpStatics *s = member(f, which);
    zp_margins_join(&f->margins, zp_margins_at_clip(s->model, which == 0 ? f->model->def.drive.voltage : s->U));
  }
  zp_add_margins(r, f->model, &f->margins);
  zp_note_mesh(r, f->model, f->model->def.drive.voltage);
  zp_note_rest(r, f->model);
}

static void find_equilibria(Follower *f) {
  find_voltages(f);
  zp_result_add(f->result, "points", "count", f->points);
  note(f);
}

ZpStatus zp_together_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err) {
  const ZpActuatorDef *def = task->def;
  const Plan plan = {find_equilibria, (size_t)def->output.samples, (size_t)def->output.shapes, false};
  return run(plan, task, result, err);
}

/* -- limits ------------------------------------------------------------------------------------------- */

static void record_limit(Follower *f, Kept limit) {
  ZpMargins all = f->margins;
  zp_together_go_to(&f->all, f->kept[limit]);
  f->margins = zp_margins_none();
  f->points = (int)limit; /* the number of the frame */
  ZpShape shape = shape_of(f);
  const double row[LIMIT_COLUMNS] = {limit,
                                     upper(f)->U,
                                     f->task->def->load.mass,
                                     zp_statics_stroke(upper(f)),
                                     zp_statics_opening(upper(f)),
                                     common_length(f),
                                     charge_of(f),
                                     capacitance_of(f),
                                     ZP_MARGIN_VALUES(f->margins),
                                     lower(f)->U,
                                     zp_statics_opening(lower(f))};
  zp_margins_join(&f->margins, all);
  zp_table_offer(f->result->series, row);
  zp_shapes_offer(f->result->shapes, &shape);
}

/* By which the load moves from rest without voltage to drive.voltage, where one is closed, m; NAN where none is. */
static double travel_of(Follower *f) {
  bool closed = f->result->outcome == ZP_FOLLOWED && is_at_top(f) && zp_together_left(&f->all) <= 0;
  return closed ? fabs(f->start - zp_statics_opening(upper(f))) : NAN;
}

static void find_limits(Follower *f) {
  ZpResult *r = f->result;
  double mass = zp_limits_mass(f->model);
  find_voltages(f);
  zp_result_add(r, "travel_m", "m", travel_of(f));
  for (const ZpModel *m = f->model->below; m; m = m->below)
    mass += zp_limits_mass(m);
  zp_result_add(r, "mass_kg", "kg", mass);
  for (int k = 0; k < LIMITS; k++)
    if (!isnan(r->scalar[k].value)) record_limit(f, (Kept)k);
  if (r->outcome == ZP_FOLLOWED) r->outcome = ZP_CONVERGED;
  note(f);
}

ZpStatus zp_together_limits(const ZpTask *task, ZpResult *result, ZpError *err) {
  return run((Plan){find_limits, LIMITS, LIMITS, true}, task, result, err);
}
