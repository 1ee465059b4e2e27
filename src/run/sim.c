/* A run: its creation, its steps one after the other, records, and the reasons why it ends. */
#include "run/info.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "actuator/place.h"
#include "actuator/ties.h"
#include "base/fail.h"
#include "def/check.h"
#include "rest/crossing.h"
#include "run/hooks.h"
#include "run/margins.h"
#include "run/run.h"
#include "run/sensitivity.h"
#include "run/snapshot.h"

const char *zp_outcome_name(ZpOutcome outcome) {
  static const char *const names[] = {"end_time",      "zipped",       "interrupted", "not_settled", "diverged",
                                      "step_limit",    "converged",    "followed",    "branch_lost", "bad_argument",
                                      "short_circuit", "pulled_in",    "event",       "at_bound",    "time_limit",
                                      "reopened",      "beyond_model", "doubtful"};
  size_t index = (size_t)outcome;
  return index < sizeof names / sizeof names[0] ? names[index] : "unknown";
}

bool zp_outcome_good(ZpOutcome outcome) {
  return outcome == ZP_REACHED_END || outcome == ZP_ZIPPED || outcome == ZP_CONVERGED || outcome == ZP_FOLLOWED ||
         outcome == ZP_SHORT_CIRCUIT || outcome == ZP_PULLED_IN || outcome == ZP_EVENT || outcome == ZP_AT_BOUND ||
         outcome == ZP_REOPENED || outcome == ZP_DOUBTFUL;
}

const char *zp_step_limit_name(ZpStepLimit limit) {
  static const char *const names[] = {"time_step", "stability", "drag", "event", "error", "end"};
  return (size_t)limit < sizeof names / sizeof names[0] ? names[limit] : "unknown";
}

/* -- creation ------------------------------------------------------------------------------------- */

static bool make_shape_room(ZpSim *sim) {
  ZpArena arena = {NULL, 0};
  zp_shape_reserve(sim->model, &sim->shape_room, &arena);
  sim->shape_memory = zp_calloc(1, arena.used);
  arena = (ZpArena){sim->shape_memory, 0};
  if (sim->shape_memory) zp_shape_reserve(sim->model, &sim->shape_room, &arena);
  return sim->shape_memory != NULL;
}

static void reserve_liquid(const ZpModel *model, ZpLiquidRoom *room, ZpArena *arena) {
  size_t members = model->members;
  room->thickness = zp_arena_take(arena, members * model->nodes);
  room->pressure = zp_arena_take(arena, members * model->nodes);
  room->wet_length = zp_arena_take(arena, members * ZP_BEADS);
}

static bool make_liquid_room(ZpSim *sim) {
  ZpArena arena = {NULL, 0};
  reserve_liquid(sim->model, &sim->liquid, &arena);
  sim->liquid.memory = zp_calloc(1, arena.used);
  arena = (ZpArena){sim->liquid.memory, 0};
  if (sim->liquid.memory) reserve_liquid(sim->model, &sim->liquid, &arena);
  return sim->liquid.memory != NULL;
}

/* One member alone. */
static bool allocate(ZpSim *sim) {
  const ZpModel *model = sim->model;
  size_t signals = zp_sim_row_size(sim);
  sim->state = zp_calloc(1, zp_state_size(model));
  sim->kept = zp_calloc(1, zp_state_size(model));
  sim->before = zp_calloc(1, zp_state_size(model));
  sim->relax_work = zp_calloc(6 * zp_coordinates(model), sizeof(double));
  sim->pose = zp_calloc(model->network->bodies, sizeof *sim->pose);
  sim->row = zp_calloc(signals, sizeof(double));
  zp_sim_place_rows(sim);
  sim->seen = zp_margins_none();
  sim->stepping = zp_stepping_of(model);
  return zp_system_create(model, true, &sim->eval) && sim->state && sim->kept && sim->before && sim->relax_work &&
         sim->pose && sim->row && make_shape_room(sim);
}

void zp_sim_lay_beads(ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  double reach[ZP_BEADS];
  ZpMotion now = zp_state_motion(model, state);
  if (!model->has_bead) return;
  zp_plates_gaps(&model->plates, now.x, now.y, &sim->eval.plates);
  zp_eval_reach(model, sim->eval.plates.gap, state->bead, reach);
  for (int half = 0; half < zp_beads(&model->film); half++)
    state->bead[half].reach = reach[half], state->bead[half].rate = 0;
}

/* Nothing in an actuator is as fast as sound in its steel; numbers beyond this have diverged. */
static bool has_diverged(const ZpModel *model, const ZpState *state) {
  static const double speed_of_sound = 1e4; /* m/s, rounded up */
  const double *q = state->data, *v = q + zp_coordinates(model);
  for (size_t j = 0; j < zp_coordinates(model); j++)
    if (!(fabs(v[j]) < speed_of_sound) || !isfinite(q[j])) return true;
  return false;
}

static bool diverged(const ZpSim *sim) {
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    if (has_diverged(m->model, m->state)) return true;
  return false;
}

void zp_sim_passed(const ZpSim *sim, ZpState *state[]) {
  bool off = sim->cut || diverged(sim);
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    *state++ = off ? m->kept : m->state;
}

/* A longer run passes through the present state, too, unless the end of this run has cut its last step short. */
static void keep(ZpSim *sim) {
  zp_sim_book_links(sim);
  if (sim->cut || diverged(sim)) return;
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    memcpy(m->kept, m->state, zp_state_size(m->model));
}

/* A model may also be built from a Def that supports equilibria only. */
static ZpStatus check_creation(const ZpModel *model, ZpError *err) {
  const ZpActuatorDef *def = &model->def;
  bool drive = def->drive.waveform == ZP_WAVEFORM_TABLE && model->waveform.table.rows == 0;
  bool setpoint = def->setpoint.waveform == ZP_WAVEFORM_TABLE && model->setpoint.table.rows == 0;
  if (drive || setpoint)
    return zp_fail(err, ZP_BAD_INPUT, "%s.waveform = table: the model has no table; zp_model_create_driven takes it",
                   drive ? "drive" : "setpoint");
  ZpStatus status = zp_def_check_motion(model->whole, err);
  for (const ZpModel *m = model; m < model + model->members && status == ZP_OK; m++)
    status = zp_def_check_voltage(&m->def, zp_waveform_largest(&m->waveform), err);
  return status;
}

/* For the shape of all members. */
static bool make_room(ZpSim *sim, size_t members) {
  const ZpModel *model = sim->model;
  ZpArena size = {NULL, 0};
  zp_many_reserve(&sim->all, members, model->count, model->nodes, &size);
  sim->all_memory = zp_calloc(1, size.used);
  ZpArena arena = {sim->all_memory, 0};
  zp_many_reserve(&sim->all, members, model->count, model->nodes, &arena);
  return sim->all_memory != NULL;
}

/* One member, straight. False if there is no memory. */
static bool create_one(const ZpModel *model, ZpSim *sim) {
  sim->model = model;
  sim->drive = zp_key_find("drive.voltage");
  sim->signal = zp_key_find("control.signal");
  if (!allocate(sim)) return false;
  ZpState *state = sim->state;
  state->zip_time = state->closed_from = state->refreshed = state->starved_time = NAN;
  zp_place_straight(model, zp_state_q(model, state));
  return true;
}

/* All members, straight. NULL: there is no memory. */
static ZpSim *create_straight(const ZpModel *model) {
  const size_t members = model->members;
  ZpSim *sim = zp_calloc(members, sizeof *sim);
  if (!sim) return NULL;
  sim->members = members;
  sim->states = zp_calloc(members, sizeof(ZpState *));
  bool made = sim->states != NULL;
  for (size_t k = 0; k < members && made; k++) {
    made = create_one(model + k, sim + k);
    sim->states[k] = sim[k].state;
  }
  made = made && sim->stepping->create(sim) && make_liquid_room(sim);
  if (made && ((members == 1 && !model->network->plane) || make_room(sim, members))) return sim;
  zp_sim_destroy(sim);
  return NULL;
}

double zp_sim_voltage_now(const ZpSim *m) {
  const ZpState *state = m->state;
  return state->by_hand ? zp_ramp_value(&state->voltage_input, state->t)
                        : zp_waveform_voltage(&m->model->waveform, state->t);
}

/* Initial state of a simulation. */
static void start(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    zp_sim_lay_beads(m);
    zp_sim_start_balance(m);
  }
  zp_sim_start_control(sim);
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    if (!zp_sim_is_fed(m))
      zp_sim_jump(m, zp_sim_voltage_now(m));
    else if (zp_leads_port(m->model))
      zp_supply_coupling_start(m);
  }
}

/* An actuator that does not open has no contraction, which a controller could measure. */
static ZpStatus check_one(const ZpSim *sim, ZpError *err) {
  const ZpActuatorDef *def = &sim->model->def;
  bool measured = def->control.kind != ZP_CONTROL_NONE && def->control.signal == ZP_CONTROL_CONTRACTION;
  if (!measured || zp_sim_first(sim)->settled != ZP_REACHED_END || sim->state->opening0 > 0) return ZP_OK;
  return zp_fail(
      err, ZP_BAD_INPUT,
      "control.signal = contraction: with this load, gravity and mount.tilt the actuator is closed at rest, so "
      "it has no contraction; use opening or stroke");
}

static ZpStatus check_controlled(const ZpSim *sim, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (const ZpSim *m = sim; m < sim + sim->members && status == ZP_OK; m++)
    status = check_one(m, err);
  return status;
}

ZpStatus zp_sim_create(const ZpModel *model, const ZpHooks *hooks, ZpSim **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = check_creation(model, err);
  if (status != ZP_OK) return status;
  ZpSim *sim = create_straight(model);
  if (!sim || !zp_sim_settle(sim, hooks)) {
    zp_sim_destroy(sim);
    return zp_fail_memory(err);
  }
  status = check_controlled(sim, err);
  if (status != ZP_OK) {
    zp_sim_destroy(sim);
    return status;
  }
  start(sim);
  zp_sim_start_row(sim);
  *out = sim;
  return ZP_OK;
}

/* Where one member of these begins, as settling puts it. */
static void start_near(const ZpSim *m, const ZpState *rate, double offset, ZpSim *near) {
  ZpState *state = near->state, *at = near->before;
  zp_state_along(m->model, m->state, rate, offset, at);
  state->opening0 = at->opening0;
  memcpy(zp_state_bodies(near->model, state), zp_state_bodies(near->model, at),
         zp_state_bodies_size(near->model) * sizeof(double));
  if (m->model->def.initial.state != ZP_INITIAL_STRAIGHT)
    zp_sim_start_at(near, zp_state_q(near->model, at),
                    zp_memory_pressure(near->model, zp_state_memory(near->model, at)));
}

ZpSim *zp_sim_create_near(const ZpSim *sim, const ZpModel *model, ZpState *const rate[], double offset) {
  ZpSim *near = create_straight(model);
  if (!near) return NULL;
  for (size_t k = 0; k < sim->members; k++)
    start_near(sim + k, rate[k], offset, near + k);
  zp_sim_hang(near);
  near->settled = ZP_REACHED_END;
  start(near);
  return near;
}

static void destroy_one(ZpSim *sim) {
  zp_system_destroy(&sim->eval);
  zp_free(sim->state);
  zp_free(sim->kept);
  zp_free(sim->before);
  zp_free(sim->relax_work);
  zp_free(sim->pose);
  zp_free(sim->row);
  zp_free(sim->shape_memory);
}

void zp_sim_destroy(ZpSim *sim) {
  if (!sim) return;
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    destroy_one(m);
  zp_dynamics_destroy(&sim->dynamics);
  zp_paper_motion_destroy(&sim->paper);
  zp_free(sim->states);
  zp_free(sim->all_memory);
  zp_free(sim->liquid.memory);
  zp_free(sim);
}

ZpSim *zp_sim_loaded(ZpSim *sim) {
  return zp_shares_load(sim->model) ? sim : sim + sim->members - 1;
}

void zp_sim_record(ZpSim *sim, ZpTable *series, ZpShapes *shapes) {
  sim->series = series;
  sim->shapes = shapes;
}

/* -- a run ---------------------------------------------------------------------------------------- */

/* Fine enough for a fast zip and for a wave; the records of a long run are thinned. */
static double sampling_interval(const ZpModel *model) {
  static const double finest = 1e-4; /* s */
  double least = finest;
  for (const ZpModel *m = model; m < model + model->members; m++)
    least = fmin(least, zp_waveform_period(&m->waveform) / 40);
  return fmin(least, model->def.solver.end_time / model->def.output.samples);
}

static void note_bounds(const ZpSim *sim, ZpRunInfo *info) {
  ZpStepBounds bounds = zp_eval_step_bounds(sim->model, sim->state, &sim->eval);
  info->smallest_bound[0] = fmin(info->smallest_bound[0], bounds.drag);
  info->smallest_bound[1] = fmin(info->smallest_bound[1], bounds.axial);
  info->smallest_bound[2] = fmin(info->smallest_bound[2], bounds.shear);
}

/* Called before a step that the end of the run may cut short: a longer run would take other steps from there. */
static void keep_before_cut(ZpSim *sim, double end_time) {
  static const double rounding = 1e-5;
  double longest = sim->stepping->longest(sim);
  if (sim->cut || end_time - sim->state->t > (1 + rounding) * longest) return;
  keep(sim);
  sim->cut = true;
}

static bool nothing_recorded(const ZpSim *sim) {
  return (sim->series && sim->series->rows == 0) || (sim->shapes && sim->shapes->frames == 0);
}

static bool asked_to_stop(const ZpHooks *hooks, double fraction) {
  return zp_hooks_stop(hooks, "simulating", fraction);
}

/* => why the model does not describe the present state of one of the members; NULL: it does. Faces overlap for a moment
 * where they meet, but by less than the strips are thick. */
static const char *fault_of(const ZpSim *sim) {
  for (const ZpSim *m = sim; m < sim + sim->members; m++) {
    const ZpModel *model = m->model;
    const ZpActuatorDef *def = &model->def;
    bool parted = model->field && def->contact.model == ZP_CONTACT_UNILATERAL;
    if (m->negative) return "a ribbon folds back until the capacitance is negative";
    if (parted && zp_crosses(model, zp_state_q(model, m->state), zp_insulation(def) + def->ribbon.thickness))
      return ZP_FACES_CROSS;
  }
  return NULL;
}

static ZpOutcome advance(ZpSim *sim, double end_time, const ZpHooks *hooks, ZpRunInfo *info) {
  enum { BETWEEN_LOOKS = 1024 }; /* steps between looks at divergence */
  const ZpModel *model = sim->model;
  const int64_t between = sim->stepping->between_questions;
  ZpState *state = sim->state;
  double start = state->t, interval = sampling_interval(model), next_sample = start + interval;
  bool recording = sim->series || sim->shapes;
  if (nothing_recorded(sim)) zp_sim_offer_record(sim);
  while (state->t < end_time) {
    if (info->steps >= model->def.solver.max_steps) return ZP_STEP_LIMIT;
    if (sim->rates) zp_run_sensitivity_begin(sim->rates);
    if (!zp_sim_control(sim)) return ZP_BAD_ARGUMENT;
    keep_before_cut(sim, end_time);
    zp_sim_advance(sim, end_time, info);
    if (sim->step_failed) return ZP_DIVERGED;
    if (!sim->stepping->fine && fault_of(sim)) return ZP_BEYOND_MODEL;
    bool sample = recording && state->t >= next_sample;
    if (!sample && !sim->stepping->fine) zp_sim_see(sim); /* a record sees, too */
    if (sample || info->steps % BETWEEN_LOOKS == 0) {
      if (diverged(sim)) return ZP_DIVERGED;
      keep(sim);
    }
    bool question = sample || info->steps % between == 0;
    if (question && asked_to_stop(hooks, (state->t - start) / (end_time - start)))
      return diverged(sim) ? ZP_DIVERGED : ZP_INTERRUPTED;
    if (sample) {
      zp_sim_offer_record(sim);
      note_bounds(sim, info);
      if (sim->negative) return ZP_BEYOND_MODEL;
      next_sample += interval * ceil((state->t - next_sample) / interval + 1e-9);
    }
    const ZpOutcome end = zp_sim_end(sim);
    if (end != ZP_REACHED_END) return end;
    if (sim->stops_at_events && sim->at_event) return diverged(sim) ? ZP_DIVERGED : ZP_EVENT;
  }
  return diverged(sim) ? ZP_DIVERGED : ZP_REACHED_END;
}

static void describe_unsettled(const ZpSim *sim, char *text, size_t size) {
  if (*sim->falls)
    snprintf(text, size, "%s", sim->falls);
  else
    snprintf(text, size,
             "no hanging equilibrium was found: after %lld steps the unbalanced force is still %g of the weight",
             (long long)sim->settle_steps, sim->settle_residual);
}

static void describe(const ZpSim *sim, ZpRunInfo *info) {
  char *text = info->message;
  size_t size = sizeof info->message;
  double t = sim->state->t;
  switch (info->outcome) {
  case ZP_REACHED_END:
    snprintf(text, size, "ran to %g s", t);
    break;
  case ZP_ZIPPED:
    snprintf(text, size, "closed after %.4g ms", 1e3 * zp_sim_zip_time(sim));
    break;
  case ZP_INTERRUPTED:
    snprintf(text, size, "interrupted at %g s; the results so far are kept", t);
    break;
  case ZP_NOT_SETTLED:
    describe_unsettled(sim, text, size);
    break;
  case ZP_DIVERGED:
    if (sim->eval.fault)
      snprintf(text, size, "the field could not be solved before %g s: %s; the results so far are kept", t,
               sim->eval.fault);
    else if (sim->step_failed)
      snprintf(text, size,
               "the solver failed at %g s: no time step converges, however short; the results so far are kept", t);
    else
      snprintf(text, size, "diverged before %g s; the results so far are kept; try a smaller solver.time_step", t);
    break;
  case ZP_BEYOND_MODEL:
    snprintf(text, size, "ended at %g s: %s; " ZP_LESS_STEEP "; the results so far are kept", t, sim->fault);
    break;
  case ZP_STEP_LIMIT:
    snprintf(text, size, "stopped at %g s after solver.max_steps = %d steps; raise solver.max_steps to run to the end",
             t, sim->model->def.solver.max_steps);
    break;
  case ZP_SHORT_CIRCUIT:
    snprintf(text, size,
             "short circuit at %.4g ms: electrodes without an insulator touch at %g V; give insulator.thickness",
             1e3 * t, sim->state->U);
    break;
  case ZP_CONVERGED:
  case ZP_FOLLOWED:
  case ZP_BRANCH_LOST:
  case ZP_PULLED_IN:
  case ZP_AT_BOUND:
  case ZP_TIME_LIMIT:
  case ZP_REOPENED:
  case ZP_DOUBTFUL:
    break; /* of studies */
  case ZP_EVENT:
    snprintf(text, size, "an event at %g s", t);
    break;
  case ZP_BAD_ARGUMENT:
    if (sim->settled == ZP_REACHED_END)
      snprintf(text, size, "the controller's voltage at %g s: %.200s", t, sim->control.fault.message);
    else
      snprintf(text, size, "initial.state = checkpoint: no checkpoint was given; zp_sim_continue takes it");
    break;
  }
}

/* The request is impossible: nothing is done, and `info` says why. */
static ZpOutcome refuse(const ZpSim *sim, const char *name, double value, const char *need, ZpRunInfo *info) {
  if (!info) return ZP_BAD_ARGUMENT;
  *info = (ZpRunInfo){.outcome = ZP_BAD_ARGUMENT,
                      .smallest_bound = {INFINITY, INFINITY, INFINITY},
                      .wall_time = NAN,
                      .settle_steps = sim->settle_steps,
                      .settle_residual = sim->settle_residual};
  snprintf(info->message, sizeof info->message, "%s = %g s: %s; the simulation stays at %.9g s", name, value, need,
           sim->state->t);
  return ZP_BAD_ARGUMENT;
}

ZpOutcome zp_sim_run_until(ZpSim *sim, double end_time, ZpStop stop, const ZpHooks *hooks, ZpRunInfo *out) {
  if (!(end_time >= sim->state->t))
    return refuse(sim, "end_time", end_time, "must not be earlier than the present time", out);
  ZpRunInfo info = {.settle_steps = sim->settle_steps,
                    .settle_residual = sim->settle_residual,
                    .smallest_bound = {INFINITY, INFINITY, INFINITY}};
  bool clock = hooks && hooks->clock;
  ZpImplicitCounts before = sim->dynamics.stepper.counts;
  double start_time = sim->state->t, start_clock = clock ? hooks->clock(hooks->user) : NAN;
  info.outcome = sim->settled;
  sim->cut = false;
  sim->landing = ZP_LANDS_NOWHERE;
  if (info.outcome == ZP_REACHED_END) {
    keep(sim);
    sim->stop = stop;
    info.outcome = advance(sim, end_time, hooks, &info);
    zp_sim_book_links(sim);
    if (info.outcome != ZP_DIVERGED) zp_sim_close_record(sim);
    sim->fault = diverged(sim) || sim->step_failed ? NULL : fault_of(sim);
    if (sim->fault) info.outcome = ZP_BEYOND_MODEL;
  }
  info.wall_time = clock ? hooks->clock(hooks->user) - start_clock : NAN;
  info.simulated_time = sim->state->t - start_time;
  const ZpImplicitCounts *counts = &sim->dynamics.stepper.counts;
  info.rejected = counts->rejected - before.rejected;
  info.failures = counts->failures - before.failures;
  info.iterations = counts->iterations - before.iterations;
  describe(sim, &info);
  if (out) *out = info;
  return info.outcome;
}

ZpOutcome zp_sim_run(ZpSim *sim, double end_time, bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *info) {
  return zp_sim_run_until(sim, end_time, stop_when_zipped ? ZP_STOP_CLOSED : ZP_STOP_AT_END, hooks, info);
}

ZpOutcome zp_sim_step(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info) {
  static const double rounding = 1e-9; /* above the rounding of time: the end leaves no tiny step */
  double longest = fmin(sim->model->stable_step, sim->model->def.solver.time_step); /* NAN, auto, does not count */
  double end = sim->state->t + dt;
  if (!(end > sim->state->t) || isinf(dt)) return refuse(sim, "dt", dt, "must be a finite time step above 0", info);
  sim->paper.longest = dt / ceil(dt / longest) * (1 + rounding);
  ZpOutcome outcome = zp_sim_run(sim, end, false, hooks, info);
  sim->paper.longest = INFINITY;
  return outcome;
}

ZpOutcome zp_sim_step_to_event(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info) {
  sim->stops_at_events = true;
  ZpOutcome outcome = zp_sim_step(sim, dt, hooks, info);
  sim->stops_at_events = false;
  return outcome;
}

/* -- state ---------------------------------------------------------------------------------------- */

static void resume_one(ZpSim *sim) {
  zp_sim_resume_control(sim);
  if (sim->settled == ZP_BAD_ARGUMENT) sim->settled = ZP_REACHED_END;
  if (!zp_sim_is_fed(sim)) zp_sim_jump(sim, zp_sim_voltage_now(sim));
  sim->cut = sim->negative = false;
}

void zp_sim_resume(ZpSim *sim) {
  zp_sim_start_row(sim);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    resume_one(m);
}

size_t zp_sim_state_size(const ZpSim *sim) {
  return zp_snapshot_size(sim->model);
}

void zp_sim_save(const ZpSim *sim, void *bytes) {
  zp_snapshot_write(sim->model, sim->states, bytes);
}

static double coordinate_of(const ZpSim *m, size_t k) {
  return *zp_coordinate(m->model, zp_state_q(m->model, m->state), k);
}

/* Are coordinates tied in all states as they are in the model? */
static bool is_joined(const ZpSim *sim) {
  static const double same = 1e-9; /* of the length */
  bool joined = true;
  for (const ZpSim *m = sim; m < sim + sim->members; m++) {
    const ZpTies ties = zp_ties_of(sim->model, sim->members, (size_t)(m - sim));
    for (const ZpTie *t = ties.tie; t < ties.tie + ties.count; t++) {
      double follows = t->factor * coordinate_of(sim + t->to_member, t->to) + t->offset;
      joined &= fabs(coordinate_of(m, t->coordinate) - follows) < same * sim->model->L;
    }
  }
  return joined;
}

void zp_sim_keep_states(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    memcpy(m->before, m->state, zp_state_size(m->model));
}

void zp_sim_take_states_back(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    memcpy(m->state, m->before, zp_state_size(m->model));
}

/* => the states; if they do not fit, they do not change. */
static ZpStatus read_states(ZpSim *sim, const void *bytes, size_t size, ZpError *reason) {
  zp_sim_keep_states(sim);
  ZpStatus status = zp_snapshot_read(sim->model, bytes, size, sim->states, reason);
  if (status == ZP_OK && !is_joined(sim))
    status = zp_fail(reason, ZP_BAD_INPUT, "of another model: its nodes are held or joined in another way");
  if (status != ZP_OK) zp_sim_take_states_back(sim);
  return status;
}

ZpStatus zp_sim_restore(ZpSim *sim, const void *bytes, size_t size, ZpError *err) {
  ZpError reason;
  ZpStatus status = read_states(sim, bytes, size, &reason);
  if (status != ZP_OK) return zp_fail(err, status, "state: %.500s", reason.message);
  zp_sim_resume(sim);
  return ZP_OK;
}
