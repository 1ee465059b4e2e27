/* Study `isometric`: the platform is held at isometric.separation and the voltage raised from 0 to drive.voltage; the
 * ribbons zip to an equilibrium. Which force holds the platform?
 *
 * The state at a voltage is the first one there on the branch of equilibria that starts from the unpowered shape. While
 * that branch rises, this is the state to which a slowly rising voltage leads. Where it turns back (a limit point), the
 * state jumps. The branch is followed through the turn until it is stable and above the voltage of the turn again:
 * there the jump lands. If the branch never gets there, the state is released at the turn and lands where slow motion
 * against a resistance ends. Theory, section 13. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/check.h"
#include "def/device.h"
#include "rest/crossing.h"
#include "study/equilibria.h"
#include "study/sensitivity.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "voltage between the electrodes"},
    {"force_N", "N", "what the voltage adds to the force that holds the platform"},
    ZP_ELECTRIC_COLUMNS,
    {"stable", "1", "1: stable, 0: unstable"},
    {"passed", "1", "1: a rising voltage passes through this state, 0: it jumps over it"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0], MOST_POINTS = 5000, MOST_BEYOND = 2000, TAKEN = 50 };

/* The branch is searched for other states at drive.voltage up to this multiple of it. */
static const double look_beyond = 1.25;

typedef struct Holder {
  ZpEquilibria at;
  double *before, *after; /* points of the branch: before and after its last step */
  double *edge;           /* before its last turn */
  double *answer;         /* the state found */
  double *unpowered_state;
  double unpowered;        /* force that holds the platform without voltage, N, whole actuator; NAN: not found */
  double unpowered_moment; /* of a fold: its moment about the hinge, N m */
  double highest;          /* voltage that the branch has reached, V */
  double force;            /* at the last state that was passed, N */
  double leap;             /* the largest change of force in a jump, N */
  int jumps, points;
  int others; /* more stable states at drive.voltage; the force of the last, N */
  double other_force;
  const char *fault; /* why the state found is impossible; NULL: no reason is known */
  bool cross;        /* a stable state at drive.voltage has been found, but its faces cross each other */
  ZpOutcome outcome;
} Holder;

static void reserve(void *user, ZpArena *arena) {
  Holder *h = user;
  double **const point[] = {&h->before, &h->after, &h->edge, &h->answer, &h->unpowered_state};
  for (size_t k = 0; k < sizeof point / sizeof point[0]; k++)
    *point[k] = zp_arena_take(arena, zp_rest_save_size(&h->at.rest));
}

/* The force that holds the platform, whole actuator, N. */
static double holding(Holder *h) {
  return zp_parts_abreast(h->at.model) * zp_statics_holding(&h->at.rest.statics);
}

/* The force under voltage, whole actuator, N; exact enough for comparisons of states. */
static double force(const Holder *h) {
  return zp_parts_abreast(h->at.model) * h->at.rest.statics.reaction - h->unpowered;
}

/* Distance of the held end of a fold to the right of the hinge, m. */
static double lever(ZpStatics *s, void *user) {
  const ZpTopology *t = &s->member->model->topology;
  (void)user;
  return s->member->q[zp_load_node(t)] - s->member->q[zp_lower(t, 0)];
}

/* Moment of the force on that end about the hinge, N m. */
static double moment(Holder *h) {
  return holding(h) * lever(&h->at.rest.statics, NULL);
}

static bool is_stable(Holder *h) {
  return zp_statics_stable(&h->at.rest.statics);
}

static void record(Holder *h, bool passed, bool last) {
  ZpStatics *s = &h->at.rest.statics;
  bool stable = is_stable(h);
  double force = holding(h) - h->unpowered;
  zp_equilibria_add(&h->at, (double[COLUMNS]){s->U, force, ZP_ELECTRIC_VALUES(s), stable, passed}, h->points++, last);
}

/* The largest attraction of closed faces, of a series that of one member, N. */
static double strongest(const ZpStatics *s) {
  double most = 0;
  for (size_t k = 0; k < s->members; k++) {
    const ZpModel *model = s->member[k].model;
    if (model->topology.along) return INFINITY; /* the films pull like a lever */
    double closed = zp_plates_law(&model->plates, zp_statics_member_voltage(s, k), 0).W * zp_contact_length(model);
    most = s->shared ? most + closed : fmax(most, closed);
  }
  return most;
}

/* Is the present state possible, as a point on the way? */
static bool is_possible(Holder *h) {
  const ZpStatics *s = &h->at.rest.statics;
  h->fault = zp_statics_fault_of_stations(&h->at.rest.statics);
  if (!h->fault && force(h) > strongest(s)) h->fault = "the force is above the attraction of closed faces";
  return !h->fault;
}

/* May the present state be the answer? */
static bool is_answer(Holder *h) {
  bool cross = zp_statics_faces_cross(&h->at.rest.statics);
  h->cross |= cross;
  return is_possible(h) && !cross;
}

/* A rising voltage leads to the present point: has it jumped there? */
static void pass(Holder *h, bool jumped) {
  double now = force(h);
  if (jumped) {
    h->jumps++;
    if (fabs(now - h->force) > fabs(h->leap)) h->leap = now - h->force;
  }
  h->force = now;
  h->highest = h->at.rest.statics.U;
}

/* Where is the branch after a step? */
static void look_at(Holder *h, double direction, bool *turned) {
  if (direction > 0 && h->at.rest.branch.direction_m < 0) {
    if (!*turned) memcpy(h->edge, h->before, h->at.rest.system.save_size);
    *turned = true;
    h->highest = fmax(h->highest, zp_branch_limit(&h->at.rest.branch));
  }
  if (h->at.rest.statics.U <= h->highest || !is_stable(h)) return;
  pass(h, *turned);
  *turned = false;
}

static bool is_unstable(void *user) {
  return !is_stable(user);
}

/* After a step in which the branch became unstable but did not turn: back to the last stable state. */
static void go_to_edge(Holder *h) {
  zp_branch_approach(&h->at.rest.branch, is_unstable, h);
  zp_rest_save(&h->at.rest, h->edge);
  pass(h, false);
  record(h, true, false);
}

/* Follow the branch until it has reached `top` within its last step. Else it has turned back or was lost: `edge` is the
 * state from which it is released. Several members have many branches, and move to one that is near: they are released
 * where their state becomes unstable, at a turn or where equal members cease to be alike. */
static bool follow(Holder *h, bool *turned) {
  ZpStatics *s = &h->at.rest.statics;
  *turned = false;
  zp_rest_save(&h->at.rest, h->edge);
  if (!zp_rest_follow(&h->at.rest, true)) return false;
  for (int k = 0; k < MOST_POINTS; k++) {
    double direction = h->at.rest.branch.direction_m;
    zp_rest_save(&h->at.rest, h->before);
    bool further = zp_branch_advance(&h->at.rest.branch) && s->U >= 0 && is_possible(h);
    if (further) look_at(h, direction, turned);
    if (further && fmax(h->highest, s->U) > h->at.top) return true;
    bool unstable = further && s->members > 1 && s->U != h->highest;
    if (!*turned && !further) memcpy(h->edge, h->before, h->at.rest.system.save_size);
    if (!*turned && unstable) go_to_edge(h);
    *turned |= unstable;
    if (!further || unstable) return false;
    record(h, s->U == h->highest, false);
    if (zp_statics_asked_to_stop(s)) return false;
  }
  return false;
}

/* Release at the last turn, or where the branch was lost, just above the voltage there. A fall that does not converge,
 * or that ends in an impossible state, is tried again from further above. Without a jump the force would grow as the
 * square of the voltage, by 2 % at most. */
static bool fall(Holder *h, bool turned) {
  static const double above[] = {1e-3, 3e-3, 1e-2}, least = 1e-5; /* of that voltage, of drive.voltage */
  static const double smooth = 0.05;
  ZpStatics *s = &h->at.rest.statics;
  bool found = false;
  for (size_t k = 0; k < sizeof above / sizeof above[0] && !found; k++) {
    zp_rest_go_to(&h->at.rest, h->edge);
    double U = fmin((1 + above[k]) * h->highest + least * zp_drive_voltage(h->at.model), h->at.top);
    found = zp_newton_good(zp_statics_relax(s, U).end) && is_possible(h);
  }
  if (!found) return false;
  pass(h, turned || fabs(force(h) - h->force) > smooth * fabs(h->force));
  record(h, true, false);
  return true;
}

/* Raise the voltage over all turns. */
static bool rise(Holder *h) {
  enum { MOST = 100 };
  bool turned, arrived = follow(h, &turned);
  for (int k = 0; k < MOST && !arrived && fall(h, turned); k++)
    arrived = follow(h, &turned);
  return arrived;
}

/* Further along the branch: other stable states at `top`. */
static void count_others(Holder *h) {
  ZpStatics *s = &h->at.rest.statics;
  h->at.rest.system.restore(s, h->after);
  for (int k = 0; k < MOST_BEYOND; k++) {
    bool below = s->U < h->at.top;
    if (!zp_branch_advance(&h->at.rest.branch) || s->U < 0 || s->U > look_beyond * h->at.top) return;
    if (!below || s->U < h->at.top || !is_stable(h) || zp_statics_fault(s)) continue;
    h->others++;
    h->other_force = force(h);
  }
}

/* A pouch is held before it contracts, and moves under voltage: its force without voltage is not sought. */
static bool is_slack(const Holder *h) {
  return h->at.model->topology.along;
}

static void summarize(Holder *h, const ZpNewtonInfo *info) {
  ZpResult *r = h->at.result;
  const ZpStatics *s = &h->at.rest.statics;
  bool found = h->outcome == ZP_CONVERGED, held = !isnan(h->unpowered);
  zp_result_add(r, "force_N", "N", found ? holding(h) - h->unpowered : NAN);
  zp_result_add(r, "force_unpowered_N", "N", held && !is_slack(h) ? h->unpowered : NAN);
  zp_result_add(r, "opening_m", "m", held ? zp_statics_opening(s) : NAN);
  if (zp_is_hinge(&h->at.model->topology)) {
    zp_result_add(r, "angle_rad", "rad", held ? zp_statics_angle(s) : NAN);
    zp_result_add(r, "torque_N_m", "N m", found ? moment(h) - h->unpowered_moment : NAN);
  }
  zp_result_add(r, "zipped_length_m", "m", found ? zp_statics_closed_length(s) : NAN);
  zp_result_add(r, "charge_C", "C", found ? zp_statics_charge(s) : NAN);
  zp_result_add(r, "capacitance_F", "F", found ? zp_statics_capacitance(s) : NAN);
  zp_result_add(r, "other_states", "count", found ? (double)h->others : (double)NAN);
  zp_result_add(r, "jumps", "count", held ? (double)h->jumps : (double)NAN);
  zp_result_add(r, "iterations", "count", info->iterations);
  zp_result_add(r, "residual", "1", isfinite(info->residual) ? info->residual : NAN);
  if (found) zp_equilibria_add_members(&h->at);
}

static void note(Holder *h) {
  ZpResult *r = h->at.result;
  if (is_slack(h)) zp_result_note(r, "force_unpowered_N is not sought: force_N is the whole force");
  zp_equilibria_note(&h->at, zp_drive_voltage(h->at.model));
  if (h->jumps > 0)
    zp_result_note(
        r, "%d jump%s as the voltage rises, the largest by %.3g N; %s", h->jumps, h->jumps == 1 ? "" : "s", h->leap,
        h->at.rest.statics.linked ? "where a member of a series closes, the others open"
                                  : "a wedge shorter than an element causes such jumps: increase mesh.nodes to see "
                                    "whether they are real");
  if (h->others > 0)
    zp_result_note(
        r,
        "%d more stable state%s at drive.voltage (force %.4g N in the last): a voltage that is higher at first, or "
        "applied suddenly, may lead there",
        h->others, h->others == 1 ? "" : "s", h->other_force);
}

/* => message [size] */
static void describe(const Holder *h, char *message, size_t size) {
  double top = zp_drive_voltage(h->at.model);
  const char *trouble = h->fault ? h->fault : zp_statics_trouble(&h->at.rest.statics);
  if (h->outcome == ZP_NOT_SETTLED)
    snprintf(message, size, "no equilibrium without voltage found at isometric.separation = %g m",
             h->at.model->def.isometric.separation);
  else if (h->outcome == ZP_INTERRUPTED)
    snprintf(message, size, "interrupted at %.4g V", h->at.rest.statics.U);
  else if (h->outcome == ZP_BEYOND_MODEL)
    snprintf(message, size,
             "no force at drive.voltage = %g V: " ZP_FACES_CROSS "; " ZP_LESS_STEEP "; the results so far are kept",
             top);
  else if (h->outcome == ZP_BRANCH_LOST)
    snprintf(message, size,
             "the rising voltage was followed to %.4g V only, of drive.voltage = %g V%s%s; set more mesh.nodes; the "
             "results so far are kept",
             h->highest, top, trouble ? "; there " : "", trouble ? trouble : "");
  else
    snprintf(message, size, "%g V pull with %.4g N", top, zp_result_get(h->at.result, "force_N"));
}

/* Has this led to the answer? */
static bool is_settled(Holder *h, ZpNewtonInfo found, ZpNewtonInfo *info) {
  *info = found;
  return zp_newton_good(found.end) && is_stable(h) && is_answer(h);
}

/* To the state at `top`, which the branch has reached within its last step: from the nearer end of the step, along the
 * step, or, where a limit point is just below, by a fall. */
static bool settle(Holder *h, ZpNewtonInfo *info) {
  ZpRest *rest = &h->at.rest;
  zp_rest_save(rest, h->after);
  if (rest->statics.U < h->at.top) rest->system.restore(&rest->statics, h->before); /* reached and turned back */
  if (is_settled(h, zp_rest_settle(rest, h->at.top), info)) return true;
  bool found = is_settled(h, zp_rest_reach(rest, h->at.top), info);
  if (!found) zp_rest_go_to(rest, h->before);
  if (!found && !is_settled(h, zp_statics_relax(&rest->statics, h->at.top), info)) return false;
  zp_rest_save(rest, h->after);
  zp_rest_follow(rest, true);
  return true;
}

/* From the unpowered state to the one at the top voltage, the first time that a rising voltage reaches it; then look
 * for others there. */
static void raise_voltage(Holder *h, ZpNewtonInfo *info) {
  ZpRest *rest = &h->at.rest;
  bool arrived = rise(h), found = arrived && settle(h, info);
  if (!found) h->outcome = arrived && h->cross ? ZP_BEYOND_MODEL : ZP_BRANCH_LOST;
  if (!found) return;
  record(h, true, true);
  zp_rest_save(rest, h->answer);
  count_others(h);
  rest->system.restore(&rest->statics, h->answer);
  if (rest->system.at_rest.refresh) rest->system.at_rest.refresh(&rest->statics);
}

/* To the unpowered state. */
static void hold_unpowered(Holder *h, ZpNewtonInfo *info) {
  ZpStatics *s = &h->at.rest.statics;
  s->bias = 0;
  *info = zp_statics_hold(s, zp_held_opening(h->at.model));
  if (!zp_newton_good(info->end)) {
    h->outcome = ZP_NOT_SETTLED;
    return;
  }
  h->unpowered = is_slack(h) ? 0 : holding(h);
  h->unpowered_moment = moment(h);
  zp_quasistatic_start(&h->at.rest); /* from now on a gap tells which members are closed */
  zp_rest_save(&h->at.rest, h->unpowered_state);
  record(h, true, false);
}

static void record_passed(void *user) {
  Holder *h = user;
  record(h, true, h->at.rest.statics.taken == 1);
}

/* A pouch contracts to where it is held, under voltage. */
static void take_up(Holder *h, ZpNewtonInfo *info) {
  ZpStatics *s = &h->at.rest.statics;
  const bool there = zp_statics_take_up(s, record_passed, h);
  if (!there) h->outcome = ZP_BRANCH_LOST;
  *info = zp_statics_solve(s, TAKEN);
  zp_rest_save(&h->at.rest, h->answer);
}

/* Raise constant voltages that members have of their own, over all turns. */
static void raise_bias(Holder *h) {
  bool jumped = false, raised = zp_statics_bias_held(&h->at.rest.statics, &jumped);
  if (!raised) h->outcome = ZP_BRANCH_LOST;
  if (!raised) return;
  pass(h, jumped);
  record(h, true, false);
}

/* -- derivatives ---------------------------------------------------------------------------------- */

static double charge(ZpStatics *s, void *user) {
  (void)user;
  return zp_statics_charge(s);
}

static double capacitance(ZpStatics *s, void *user) {
  (void)user;
  return zp_statics_capacitance(s);
}

/* Derivative of the moment of a fold at the present point, along the last solution. */
static double moment_slope(Holder *h, ZpRestSensitivity *slope) {
  ZpStatics *s = &h->at.rest.statics;
  if (!zp_is_hinge(&h->at.model->topology)) return NAN;
  double arm = lever(s, NULL), reaction = s->reaction;
  return zp_parts_abreast(h->at.model) *
         (slope->reaction * arm + reaction * zp_rest_sensitivity_of(slope, lever, NULL));
}

static void derive(void *user, ZpRestSensitivity *slope, ZpResult *r) {
  static const struct {
    const char *name;
    ZpOutput output;
  } others[] = {{"opening_m", zp_output_opening}, {"charge_C", charge}, {"capacitance_F", capacitance}};
  Holder *h = user;
  const double parts = zp_parts_abreast(h->at.model);
  zp_rest_go_to(&h->at.rest, h->unpowered_state);
  bool rests = !is_slack(h) && zp_rest_sensitivity_solve(slope, ZP_SETS_OPENING);
  double unpowered = rests ? parts * slope->reaction : NAN, less = is_slack(h) ? 0 : unpowered;
  double moment_without = rests ? moment_slope(h, slope) : NAN;
  zp_rest_go_to(&h->at.rest, h->answer);
  bool found = zp_rest_sensitivity_solve(slope, ZP_SETS_OPENING | ZP_SETS_VOLTAGE);
  double torque = found ? moment_slope(h, slope) - moment_without : NAN;
  zp_result_add_sensitivity(r, "force_N", slope->key, found ? parts * slope->reaction - less : NAN);
  zp_result_add_sensitivity(r, "force_unpowered_N", slope->key, unpowered);
  for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
    zp_result_add_sensitivity(r, others[k].name, slope->key,
                              found ? zp_rest_sensitivity_of(slope, others[k].output, NULL) : NAN);
  if (!zp_is_hinge(&h->at.model->topology)) return;
  zp_result_add_sensitivity(r, "torque_N_m", slope->key, torque);
  zp_result_add_sensitivity(r, "angle_rad", slope->key,
                            found ? zp_rest_sensitivity_of(slope, zp_output_angle, NULL) : NAN);
}

static void run(Holder *h) {
  ZpStatics *s = &h->at.rest.statics;
  ZpNewtonInfo info;
  double voltage = zp_drive_voltage(h->at.model);
  hold_unpowered(h, &info);
  if (h->outcome == ZP_CONVERGED && h->at.rest.statics.biased) raise_bias(h);
  if (h->outcome == ZP_CONVERGED && voltage > 0) raise_voltage(h, &info);
  if (h->outcome == ZP_CONVERGED && s->taken < 1) take_up(h, &info);
  if (s->stopped) h->outcome = ZP_INTERRUPTED;
  summarize(h, &info);
  describe(h, h->at.result->message, sizeof h->at.result->message);
  note(h);
  h->at.result->outcome = h->outcome;
  zp_rest_save(&h->at.rest, h->answer);
}

static ZpStatus check_reach(double separation, double longest, const char *of, ZpError *err) {
  const double most = zp_most_opening * longest;
  if (separation <= most) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "isometric.separation = %g m: out of reach; at most %g %s = %g m", separation,
                 zp_most_opening, of, most);
}

/* The largest opening, about. */
static double length_of(const ZpActuatorDef *def) {
  if (zp_def_has(def, ZP_DEVICE_RIGID))
    return isnan(def->plate.back_gap) ? INFINITY : def->plate.gap + def->plate.back_gap;
  return def->ribbon.length - (zp_def_has(def, ZP_DEVICE_PLATFORM) ? zp_platform_length(def) : 0);
}

ZpStatus zp_check_held(const ZpActuatorDef *def, ZpError *err) {
  const char *of = zp_def_has(def, ZP_DEVICE_RIGID)      ? "(plate.gap + plate.back_gap)"
                   : zp_def_has(def, ZP_DEVICE_PLATFORM) ? "(ribbon.length - platform.length)"
                                                         : "ribbon.length";
  return check_reach(def->isometric.separation, length_of(def), of, err);
}

/* The end of a series is held within the reach of all together. */
static ZpStatus check_series(const ZpActuatorDef *def, ZpError *err) {
  double longest = 0;
  for (int member = 1, last = zp_def_members(def); member <= last; member++) {
    ZpActuatorDef one = zp_def_member(def, member);
    longest += length_of(&one);
  }
  return check_reach(def->isometric.separation, longest, "(ribbon.length - platform.length) of all members", err);
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ANY, ZP_HAS(ENDS),
            "it holds a platform, the free end of the lower of two ribbons, or the lower end of a pouch"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_IS(platform.rotates, false), "it holds the platform level"),
    ZP_RULE(PHYSICS, ZP_NETWORK, ZP_ABOVE(isometric.body, 0), "it holds one of the bodies"),
    ZP_RULE(PHYSICS, ZP_ABOVE(isometric.body, 0), ZP_NETWORK, "there are no bodies; it holds the lower platform"),
    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_AT_LEAST(drive.voltage, 0),
            "the force is that of a rising voltage; give the curvature the other sign"),
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
};
const ZpRules zp_rules_isometric = ZP_RULES_OF(rule);

/* One of several alone, at the opening that it has while the lower platform is held. */
static ZpActuatorDef alone(const ZpActuatorDef *def, int member) {
  ZpActuatorDef one = zp_def_member(def, member);
  if (zp_def_antagonist(def) && member == 2) one.isometric.separation = def->stack.distance - def->isometric.separation;
  return one;
}

/* A lower platform that members share is held within the reach of each. */
static ZpStatus check_all_held(const ZpActuatorDef *def, ZpError *err) {
  const double least = zp_key(ZP_KEY(isometric.separation))->min;
  ZpStatus status = ZP_OK;
  if (zp_def_network(def)) return zp_check_held_body(def, err);
  if (zp_def_members(def) == 1) return zp_check_held(def, err);
  if (!zp_def_antagonist(def) && !zp_def_parallel(def)) return check_series(def, err);
  if (zp_def_antagonist(def) && !(def->stack.distance - def->isometric.separation > least))
    return zp_fail(err, ZP_BAD_INPUT,
                   "isometric.separation = %g m: below stack.distance = %g m, so that the lower one opens",
                   def->isometric.separation, def->stack.distance);
  for (int member = 1, last = zp_def_members(def); member <= last && status == ZP_OK; member++) {
    ZpActuatorDef one = alone(def, member);
    ZpError reason;
    status = zp_check_held(&one, &reason);
    if (status != ZP_OK) zp_fail_member(def, member, status, &reason, err);
  }
  return status;
}

ZpStatus zp_check_isometric(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_all_held(def, err);
  if (status == ZP_OK) status = zp_check_sensitivity(def, err);
  return status == ZP_OK ? zp_def_check_voltage(def, def->drive.voltage, err) : status;
}

/* The load of the body that is held does not count, nor does a force on it. */
static ZpStatus unload_body(const ZpActuatorDef *def, ZpActuatorDef *bare, ZpError *err) {
  const int row[] = {ZP_KEY(body_K.mass), ZP_KEY(body_K.force.y)};
  ZpStatus status = ZP_OK;
  for (int k = 0; k < 2 && def->isometric.body > 0 && status == ZP_OK; k++)
    status = zp_def_set(bare, zp_key_of_instance(row[k], def->isometric.body), 0, err);
  return status;
}

/* The load does not count: it is removed before anything is scaled by it. */
ZpStatus zp_study_isometric(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpActuatorDef bare = zp_def_network(task->def) ? *task->def : zp_def_unloaded(task->def);
  ZpStatus status = unload_body(task->def, &bare, err);
  Holder h = {.at = {.held = true,
                     .task = task,
                     .result = result,
                     .stage = "raising the voltage",
                     .top = bare.drive.voltage,
                     .column = columns,
                     .columns = COLUMNS,
                     .rows = (size_t)bare.output.samples,
                     .shapes = (size_t)bare.output.shapes},
              .unpowered = NAN,
              .outcome = ZP_CONVERGED};
  if (status == ZP_OK) status = zp_equilibria_open(&h.at, &bare, reserve, &h, err);
  if (status == ZP_OK) run(&h);
  if (status == ZP_OK && h.outcome == ZP_CONVERGED) status = zp_sensitivity_of(&h.at.rest, derive, &h, result, err);
  zp_equilibria_close(&h.at);
  zp_def_clear(&bare);
  return status;
}
