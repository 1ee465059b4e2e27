#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "drive/control_loop.h"
#include "rest/loops.h"
#include "study/studies.h"

enum { TOLD = 4 };

static const char *const growth_name[TOLD] = {"loop_growth_1_per_s", "loop_growth_2_per_s", "loop_growth_3_per_s",
                                              "loop_growth_4_per_s"},
                         *const frequency_name[TOLD] = {"loop_frequency_1_Hz", "loop_frequency_2_Hz",
                                                        "loop_frequency_3_Hz", "loop_frequency_4_Hz"},
                         *const factor_name[TOLD] = {"loop_factor_1", "loop_factor_2", "loop_factor_3",
                                                     "loop_factor_4"};

/* Held: 0, or NAN where that is not known. */
static void add_none(ZpResult *result, double held) {
  zp_result_add(result, "held", "count", held);
  zp_result_add(result, "held_voltage_V", "V", NAN);
}

/* The eigenvalue of a loop that decays least, in words. */
static const char *in_words(const ZpGrowth *worst, char *text, size_t size) {
  const char *does = worst->rate > 0 ? "grow" : "decay";
  if (worst->frequency > 0)
    snprintf(text, size, "swing at %.3g Hz and %s at %.3g 1/s", worst->frequency, does, fabs(worst->rate));
  else
    snprintf(text, size, "%s at %.3g 1/s", does, fabs(worst->rate));
  return text;
}

/* Small motions without and with controllers. */
typedef struct Motions {
  size_t count;
  const ZpGrowth *open, *closed;
} Motions;

static void add_motions(const Motions *found, ZpResult *result) {
  const ZpGrowth *open = found->open, *closed = found->closed;
  zp_result_add(result, "open_loop_growth_per_s", "1/s", open->rate);
  zp_result_add(result, "open_loop_frequency_Hz", "Hz", open->frequency);
  for (size_t k = 0; k < TOLD && k < found->count; k++) {
    zp_result_add(result, growth_name[k], "1/s", closed[k].rate);
    zp_result_add(result, frequency_name[k], "Hz", closed[k].frequency);
    zp_result_add(result, factor_name[k], "1", closed[k].factor);
  }
}

static void report(const ZpRest *rest, const Motions *found, ZpResult *result) {
  const double U = rest->statics.U, highest = rest->statics.member->model->control.highest;
  bool held = found->closed->rate < 0 && U <= highest;
  char alone[96], looped[96];
  zp_result_add(result, "held", "count", held);
  zp_result_add(result, "held_voltage_V", "V", U);
  add_motions(found, result);
  zp_result_note(result,
                 "control: the setpoint is an equilibrium at %.5g V%s; small motions about it %s without the "
                 "controller, %s with it: %s",
                 U, U > highest ? ", above drive.voltage" : "", in_words(found->open, alone, sizeof alone),
                 in_words(found->closed, looped, sizeof looped), held ? "held" : "not held");
}

/* If the actuator should close further, the boost acts as proportional gain. */
static double gain(const ZpControl *c, double setpoint, bool closing) {
  return c->proportional + (closing && c->boost > 0 ? c->boost / (c->band * fabs(setpoint)) : 0);
}

static void note_unknown(const ZpControl *c, ZpResult *result) {
  zp_result_note(
      result,
      "control: the eigenvalues of the loop were not found, so it is not known whether the setpoint is held; "
      "small motions may overflow within control.period = %g s: try a shorter period",
      c->period);
}

/* Motions about an equilibrium: the open ones, then those with the gains of either side [2][inputs], of which the side
 * that decays less counts => growth [3][n + inputs ZP_LOOP_OWN]. Without any: count 0. False if there is no memory. */
static bool find_motions(const ZpControl *c, const ZpPlant *plant, const double *gains, ZpGrowth *growth,
                         Motions *found) {
  const ZpLinear system = {plant->n, plant->inputs, plant->A, plant->b, plant->c};
  const size_t most = plant->n + plant->inputs * ZP_LOOP_OWN;
  ZpGrowth *closed = growth + most, *boosted = closed + most;
  double *work = zp_calloc(zp_loop_work(plant->n, plant->inputs), sizeof *work);
  *found = (Motions){0};
  if (!work) return false;
  const size_t alone = zp_open_loop(c, &system, plant->neutral, growth, work),
               count = zp_closed_loop(c, &system, gains, plant->neutral, closed, work),
               others = zp_closed_loop(c, &system, gains + plant->inputs, plant->neutral, boosted, work);
  const bool worse = boosted->rate > closed->rate;
  if (alone > 0 && count > 0 && others > 0)
    *found = (Motions){worse ? others : count, growth, worse ? boosted : closed};
  zp_free(work);
  return true;
}

static bool look(ZpRest *rest, const ZpSetpointSignal *signal, double setpoint, ZpResult *result) {
  const ZpControl *c = &rest->statics.member->model->control;
  const double gains[] = {gain(c, setpoint, false), gain(c, setpoint, true)};
  ZpPlant plant;
  Motions found;
  bool done = zp_plant_create(rest, signal, &plant);
  ZpGrowth *growth = done ? zp_calloc(3 * (plant.n + ZP_LOOP_OWN), sizeof *growth) : NULL;
  done = growth && find_motions(c, &plant, gains, growth, &found);
  if (done && found.count > 0) {
    report(rest, &found, result);
  } else if (done) {
    add_none(result, NAN);
    note_unknown(c, result);
  }
  zp_free(growth);
  zp_plant_destroy(&plant);
  return done;
}

/* -- several controllers --------------------------------------------------------------------------- */

/* Their work space. */
typedef struct Loops {
  size_t count;
  ZpLoop *loop;
  ZpControl *control; /* [count] of those that act */
  double *gain;       /* [2][of those that act] */
  double *voltage;    /* [members] */
  void *memory;
} Loops;

static size_t reserve(size_t members, Loops *l, void *block) {
  ZpArena arena = {block, 0};
  l->loop = zp_arena_take_of(&arena, members, sizeof *l->loop);
  l->control = zp_arena_take_of(&arena, members, sizeof *l->control);
  l->gain = zp_arena_take(&arena, 2 * members);
  l->voltage = zp_arena_take(&arena, members);
  return arena.used;
}

static bool open_loops(const ZpModel *first, Loops *l) {
  *l = (Loops){.memory = zp_calloc(1, reserve(first->members, l, NULL))};
  if (!l->memory) return false;
  reserve(first->members, l, l->memory);
  for (const ZpModel *model = first; model < first + first->members; model++)
    if (model->control.kind != ZP_CONTROL_NONE)
      l->loop[l->count++] = (ZpLoop){.lead = model->number, .setpoint = model->def.setpoint.value};
  return true;
}

/* Controllers that act, with the gains of either side. => how many */
static size_t take_controls(const ZpModel *first, const Loops *l) {
  size_t acting = 0, k = 0;
  for (size_t i = 0; i < l->count; i++)
    acting += l->loop[i].acts;
  for (size_t i = 0; i < l->count; i++) {
    if (!l->loop[i].acts) continue;
    const ZpControl *c = &first[l->loop[i].lead].control;
    l->control[k] = *c;
    l->gain[k] = gain(c, l->loop[i].setpoint, false);
    l->gain[acting + k++] = gain(c, l->loop[i].setpoint, true);
  }
  return acting;
}

/* The voltage of each controller; NAN where there is no equilibrium. */
static void add_voltages(const ZpModel *first, const Loops *l, bool found, ZpResult *result) {
  const bool network = zp_is_network(first);
  char room[ZP_NAME_SIZE];
  for (size_t i = 0; i < l->count; i++)
    zp_result_add_of(result, network ? "members.#.held_voltage_V" : "member_#_held_voltage_V",
                     zp_member_called(first->whole, l->loop[i].lead + 1, room), "V",
                     found ? l->voltage[l->loop[i].lead] : (double)NAN);
}

/* No controller misses its setpoint, or needs more than it may give. */
static bool are_there(const Loops *l) {
  bool there = true;
  for (size_t i = 0; i < l->count; i++)
    there &= !l->loop[i].misses;
  return there;
}

static bool are_within(const ZpModel *first, const Loops *l) {
  bool within = true;
  for (size_t i = 0; i < l->count; i++)
    within &= l->voltage[l->loop[i].lead] <= first[l->loop[i].lead].control.highest;
  return within;
}

static void report_all(const ZpModel *first, const Loops *l, const Motions *found, ZpResult *result) {
  const bool within = are_within(first, l), there = are_there(l), held = found->closed->rate < 0 && within && there;
  char alone[96], looped[96];
  zp_result_add(result, "held", "count", held);
  add_voltages(first, l, true, result);
  add_motions(found, result);
  zp_result_note(result,
                 "control: %s an equilibrium%s; small motions about it %s without controllers, %s with them: %s",
                 there ? "the setpoints are" : "the setpoints that voltages can reach are",
                 within ? "" : " above drive.voltage", in_words(found->open, alone, sizeof alone),
                 in_words(found->closed, looped, sizeof looped), held ? "held" : "not held");
}

/* None acts, so each stays at 0 V. */
static void report_none(const ZpModel *first, const Loops *l, ZpResult *result) {
  zp_result_add(result, "held", "count", are_there(l));
  add_voltages(first, l, true, result);
  zp_result_note(result, "control: all setpoints ask for no voltage");
}

static bool look_at_all(ZpRest *rest, const Loops *l, ZpResult *result) {
  const ZpModel *first = rest->statics.model;
  const size_t acting = take_controls(first, l);
  ZpPlant plant;
  Motions found = {0};
  bool done = zp_loops_plant(rest, l->loop, l->count, &plant);
  ZpGrowth *growth = done ? zp_calloc(3 * (plant.n + acting * ZP_LOOP_OWN) + 1, sizeof *growth) : NULL;
  done = growth && (plant.n == 0 || acting == 0 || find_motions(l->control, &plant, l->gain, growth, &found));
  if (done && acting == 0) {
    report_none(first, l, result);
  } else if (done && found.count > 0) {
    report_all(first, l, &found, result);
  } else if (done) {
    zp_result_add(result, "held", "count", NAN);
    add_voltages(first, l, true, result);
    note_unknown(l->control, result);
  }
  zp_free(growth);
  zp_plant_destroy(&plant);
  return done;
}

static bool add_holds(ZpRest *rest, ZpResult *result) {
  Loops l;
  bool found = false, done = open_loops(rest->statics.model, &l);
  done = done && zp_loops_find(rest, l.loop, l.count, l.voltage, &found);
  if (done && found) {
    done = look_at_all(rest, &l, result);
  } else if (done) {
    zp_result_add(result, "held", "count", NAN);
    add_voltages(rest->statics.model, &l, false, result);
    zp_result_note(result,
                   "control: no equilibrium was found on the way from the hanging state to the setpoints, so it is not "
                   "known whether they are held; try more mesh.nodes");
  }
  zp_free(l.memory);
  return done;
}

/* -- the study ------------------------------------------------------------------------------------- */

static bool is_controlled(const ZpActuatorDef *def) {
  bool any = def->control.kind != ZP_CONTROL_NONE;
  for (size_t k = 0; def->given && k < def->given->count; k++)
    any |= zp_key_instance(def->given->value[k].key).row == ZP_KEY(member_K.control.kind);
  return any;
}

ZpStatus zp_add_hold(const ZpActuatorDef *def, ZpResult *result, ZpError *err) {
  ZpModel *model;
  if (!is_controlled(def)) return ZP_OK;
  ZpStatus status = zp_model_create(def, &model, err);
  if (status != ZP_OK) return status;
  ZpRest *rest = zp_calloc(1, sizeof *rest);
  bool done = rest && zp_rest_open(rest, model, NULL, NULL);
  ZpSetpointSignal signal = {.kind = def->control.signal};
  if (done && (zp_is_network(model) || zp_has_ports(model))) {
    done = add_holds(rest, result);
  } else if (done && zp_setpoint_find(rest, &signal, def->setpoint.value)) {
    done = look(rest, &signal, def->setpoint.value, result);
  } else if (done) {
    add_none(result, 0);
    zp_result_note(
        result, "control: no equilibrium on the branch from the hanging state has the setpoint, so it cannot be held");
  }
  if (rest) zp_rest_close(rest);
  zp_free(rest);
  zp_model_destroy(model);
  return done ? ZP_OK : zp_fail_memory(err);
}
