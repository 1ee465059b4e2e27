/* A run: steps, events, records, and the reasons why it ends. */
#include <zipact/sim.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "sim/sim_internal.h"
#include "sim/snapshot.h"

const char *zp_outcome_name(ZpOutcome outcome) {
  static const char *const names[] = {"end_time",    "zipped",       "interrupted",   "not_settled",
                                      "diverged",    "step_limit",   "converged",     "followed",
                                      "branch_lost", "bad_argument", "short_circuit", "pulled_in"};
  size_t index = (size_t)outcome;
  return index < sizeof names / sizeof names[0] ? names[index] : "unknown";
}

bool zp_outcome_good(ZpOutcome outcome) {
  return outcome == ZP_REACHED_END || outcome == ZP_ZIPPED || outcome == ZP_CONVERGED || outcome == ZP_FOLLOWED ||
         outcome == ZP_SHORT_CIRCUIT || outcome == ZP_PULLED_IN;
}

const char *zp_step_limit_name(ZpStepLimit limit) {
  static const char *const names[] = {"time_step", "stability", "drag", "event", "error", "end"};
  return (size_t)limit < sizeof names / sizeof names[0] ? names[limit] : "unknown";
}

/* -- creation ------------------------------------------------------------------------------------- */

static bool allocate(ZpSim *sim) {
  const ZpModel *model = sim->model;
  size_t signals;
  zp_signal_columns(&signals);
  sim->state = zp_calloc(1, zp_state_size(model));
  sim->kept = zp_calloc(1, zp_state_size(model));
  sim->a = zp_calloc(2 * model->stride, sizeof(double));
  sim->relax_work = zp_calloc(12 * model->stride, sizeof(double));
  sim->row = zp_calloc(signals, sizeof(double));
  sim->line_force = zp_calloc(model->nodes, sizeof(double));
  bool implicit = model->def.solver.integrator == ZP_INTEGRATOR_IMPLICIT;
  if (implicit && !zp_dynamics_create(model, &sim->dynamics)) return false;
  return zp_system_create(model, true, &sim->eval) && sim->state && sim->kept && sim->a && sim->relax_work &&
         sim->row && sim->line_force;
}

static void lay_straight(const ZpModel *model, double *q) {
  for (size_t j = 0; j < model->stride; j++)
    q[j] = zp_straight_x(model, j / model->s);
}

/* Nothing in an actuator is as fast as sound in its steel; beyond, numbers have left all bounds. */
static bool diverged(const ZpModel *model, const ZpState *state) {
  static const double speed_of_sound = 1e4; /* m/s, rounded up */
  const double *q = state->data, *v = q + 2 * model->stride;
  for (size_t j = 0; j < 2 * model->stride; j++)
    if (!(fabs(v[j]) < speed_of_sound) || !isfinite(q[j])) return true;
  return false;
}

const ZpState *zp_sim_passed(const ZpSim *sim) {
  return sim->cut || diverged(sim->model, sim->state) ? sim->kept : sim->state;
}

/* A longer run passes through the present state, too, unless the end of this one has cut a step. */
static void keep(ZpSim *sim) {
  if (!sim->cut && !diverged(sim->model, sim->state)) memcpy(sim->kept, sim->state, zp_state_size(sim->model));
}

/* A model may be built of a Def that can only be at rest. */
static ZpStatus check_creation(const ZpModel *model, ZpError *err) {
  if (model->def.drive.waveform == ZP_WAVEFORM_TABLE && model->waveform.table.rows == 0)
    return zp_fail(err, ZP_BAD_INPUT, "drive.waveform = table: the model has none; zp_model_create_driven takes it");
  ZpStatus status = zp_def_check_motion(&model->def, err);
  if (status != ZP_OK) return status;
  return zp_def_check_voltage(&model->def, zp_waveform_largest(&model->waveform), err);
}

ZpStatus zp_sim_create(const ZpModel *model, const ZpHooks *hooks, ZpSim **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = check_creation(model, err);
  if (status != ZP_OK) return status;
  ZpSim *sim = zp_calloc(1, sizeof *sim);
  if (!sim) return zp_fail_memory(err);
  sim->model = model;
  sim->even = INFINITY;
  sim->drive = zp_key_find("drive.voltage");
  if (!allocate(sim)) {
    zp_sim_destroy(sim);
    return zp_fail_memory(err);
  }
  ZpState *state = sim->state;
  state->zip_time = state->refreshed = NAN;
  lay_straight(model, zp_state_q(model, state));
  if (!zp_sim_settle(sim, hooks)) {
    zp_sim_destroy(sim);
    return zp_fail_memory(err);
  }
  zp_sim_start_account(sim);
  zp_sim_jump(sim, zp_waveform_voltage(&model->waveform, 0));
  sim->row_charge = zp_eval_electric_now(model, state, state->U, &sim->eval).charge;
  *out = sim;
  return ZP_OK;
}

void zp_sim_destroy(ZpSim *sim) {
  if (!sim) return;
  zp_dynamics_destroy(&sim->dynamics);
  zp_eval_destroy(&sim->eval);
  zp_free(sim->state);
  zp_free(sim->kept);
  zp_free(sim->a);
  zp_free(sim->relax_work);
  zp_free(sim->row);
  zp_free(sim->line_force);
  zp_free(sim);
}

void zp_sim_record(ZpSim *sim, ZpTable *series, ZpShapes *shapes) {
  sim->series = series;
  sim->shapes = shapes;
}

/* -- the voltage ----------------------------------------------------------------------------------- */

static double next_corner(const ZpSim *sim) {
  const ZpState *state = sim->state;
  double voltage = state->by_hand ? zp_ramp_corner(&state->voltage_input, state->t)
                                  : zp_waveform_next_corner(&sim->model->waveform, state->t);
  return fmin(voltage, zp_ramp_corner(&state->load_input, state->t));
}

/* Longest step for an input by hand whose size matters from `least` on, s; never so short that time stands still. */
static double hand_resolution(const ZpRamp *ramp, double least, double t) {
  static const double shortest = 1e-9; /* s */
  double largest = fmax(least, fabs(zp_ramp_value(ramp, t)));
  return fmax(zp_ramp_resolution(largest, zp_ramp_rate(ramp, t)), shortest);
}

/* Longest step for all that changes from outside, s. */
static double resolution(const ZpSim *sim) {
  static const double least_voltage = 1e3; /* V */
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  const ZpWaveform *waveform = &model->waveform;
  double t = state->t, usual = fmax(least_voltage, zp_waveform_largest(waveform));
  double voltage =
      state->by_hand ? hand_resolution(&state->voltage_input, usual, t) : zp_waveform_resolution(waveform, t);
  return fmin(voltage, hand_resolution(&state->load_input, zp_eval_weight_scale(model), t));
}

/* The voltage at the time that a step has reached. By explicit steps it was that of the step's start all the way. */
static void follow_voltage(ZpSim *sim) {
  const ZpWaveform *waveform = &sim->model->waveform;
  ZpState *state = sim->state;
  if (state->by_hand) {
    zp_sim_glide(sim, zp_ramp_value(&state->voltage_input, state->t));
    return;
  }
  zp_sim_glide(sim, zp_waveform_voltage_before(waveform, state->t));
  zp_sim_jump(sim, zp_waveform_voltage(waveform, state->t));
}

/* Before anything moves: a jump of the voltage is over, and what is held is up to date. Without that there is no step:
 * a field that cannot be solved ends the run. */
static bool prepare_step(ZpSim *sim) {
  ZpState *state = sim->state;
  if (state->U != state->base_U) zp_sim_close_account(sim);
  bool due = zp_held_due(sim->model, state);
  sim->stuck = due && zp_held_refresh(sim->model, state, &sim->eval) != ZP_END_FOUND;
  return !sim->stuck;
}

/* -- one step ------------------------------------------------------------------------------------- */

/* How many stations from the clip on are in touch, the clip not counted; the platform is if all are. */
static ZpZipState touching(const ZpModel *model, const double *gap) {
  size_t front = zp_faces_front(&model->faces, gap);
  return (ZpZipState){front, front == model->topology.platform.first};
}

static const ZpZipState clip_only = {0, false};

static bool is_sequential(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_SEQUENTIAL;
}

static bool is_unilateral(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_UNILATERAL;
}

/* The damper takes relative velocity from station i => the loss, J: its kinetic energy, and half of
 * what attraction and ribbons do over the step with the velocity taken, since symplectic steps keep the energy of
 * velocities half a step later. */
static double damp(const ZpSim *sim, size_t i, const double *ay, double dt, double *vy) {
  const double *inverse = sim->model->masses.y.inverse;
  double upper = inverse[2 * i], lower = inverse[2 * i + 1], both = upper + lower;
  if (both == 0) return 0;
  double apart = vy[2 * i] - vy[2 * i + 1];
  double lost = (1 - zp_faces_kept(&sim->eval.faces, i, 1 / both, dt)) * apart;
  double other = (ay[2 * i] - ay[2 * i + 1]) / both - sim->eval.faces.push[i];
  vy[2 * i] -= lost * upper / both;
  vy[2 * i + 1] += lost * lower / both;
  return 0.5 * ((apart - lost) + apart) * lost / both + 0.5 * dt * other * lost;
}

/* After a step dt: what the push of overlapping faces does at the mean velocity is lost, and what the damper takes. How
 * far faces are closed goes into the state. */
static void damp_faces(ZpSim *sim, double dt) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  const double *x = zp_state_q(model, state), *y = x + model->stride, *ay = sim->a + model->stride;
  const double *gap = sim->eval.plates.gap, *push = sim->eval.faces.push;
  double *vy = zp_state_v(model, state) + model->stride;
  for (size_t i = 1; i < model->nodes; i++) {
    if (!(push[i] > 0)) continue;
    double apart = vy[2 * i] - vy[2 * i + 1] - 0.5 * dt * (ay[2 * i] - ay[2 * i + 1]);
    state->contact_loss -= push[i] * apart * dt;
    state->contact_loss += damp(sim, i, ay, dt, vy);
  }
  zp_plates_gaps(&model->plates, x, y, &sim->eval.plates);
  state->zip = touching(model, gap);
}

static double accelerate(void *self, const double *q, const double *v, double *a) {
  ZpSim *sim = self;
  const ZpModel *model = sim->model;
  ZpSpan now = zp_span_of(model, sim->state, q, v);
  zp_system_accelerations(model, &now, &model->masses, &sim->eval, a);
  sim->opened = sim->state->zip;
  if (is_sequential(model) && sim->state->U == 0)
    sim->opened = zp_zip_open(sim->opened, model->nodes, a + model->stride);
  zp_eval_share(model, &model->masses, is_unilateral(model) ? &clip_only : &sim->state->zip, a);

  double dt = fmin(model->stable_step, sim->even), asked = model->def.solver.time_step;
  /* Half of the first bound of eq. (9): at the bound itself drag would turn a speed round, undiminished.
   * Infinite without drag. */
  double drag = 1 / (model->def.damping.drag * sim->eval.drag_rate);
  sim->bound = ZP_LIMIT_STABILITY;
  if (asked < dt) {
    dt = asked;
    sim->bound = ZP_LIMIT_TIME_STEP;
  }
  if (drag < dt) {
    dt = drag;
    sim->bound = ZP_LIMIT_DRAG;
  }
  return dt;
}

static double next_event(void *self, const double *q, const double *v, const double *a, double dt) {
  ZpSim *sim = self;
  size_t stride = sim->model->stride;
  return zp_zip_next(&sim->state->zip, sim->model->nodes, q + stride, v + stride, a + stride, dt, &sim->met);
}

/* Pair sim->met has met: it moves as one from now on, and a held electric force is out of date. */
static void meet(ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  double *v = zp_state_v(model, state);
  state->contact_loss += zp_zip_merge(sim->met, &model->masses.x, v);
  state->contact_loss += zp_zip_merge(sim->met, &model->masses.y, v + model->stride);
  state->zip = zp_zip_after(state->zip, model->nodes, sim->met);
  state->refreshed = NAN;
}

static double opening(const ZpModel *model, const ZpState *state) {
  return zp_opening(&model->topology, zp_state_motion(model, state).y);
}

static bool is_open(const ZpModel *model, const ZpState *state) {
  return opening(model, state) > 0.01 * state->opening0;
}

/* From open to closed, or, where it started closed, held there by the platforms' faces. */
static bool reached_zip(const ZpModel *model, const ZpState *state) {
  size_t margin = (size_t)model->def.contact.complete_margin;
  if (margin) return state->zip.front + margin >= model->topology.platform.first;
  return state->opening0 > 0 && (state->zip.platform || (state->was_open && !is_open(model, state)));
}

/* Closed for good: with a margin as soon as it is zipped, else when the platform has arrived or turns back. */
static bool closed(const ZpModel *model, const ZpState *state) {
  if (isnan(state->zip_time)) return false;
  if (model->def.contact.complete_margin) return true;
  return state->zip.platform || zp_state_motion(model, state).vy[zp_load_node(&model->topology)] <= 0;
}

/* Do electrodes without an insulator touch under a voltage? */
static bool shorted(const ZpModel *model, const ZpState *state) {
  if (state->U == 0 || !model->field || model->def.insulator.thickness > 0) return false;
  return zp_plates_least_gap(&model->plates, zp_state_motion(model, state).y) < ZP_CLOSED_GAP;
}

static ZpStepLimit limit_of(const ZpSim *sim, ZpExplicitLimit limit, bool corner) {
  if (limit == ZP_EXPLICIT_EVENT || corner) return ZP_LIMIT_EVENT;
  return limit == ZP_EXPLICIT_END ? ZP_LIMIT_END : sim->bound;
}

/* Where the load hangs, m. */
static double height(const ZpSim *sim) {
  return zp_state_motion(sim->model, sim->state).y[zp_load_node(&sim->model->topology)];
}

static void explicit_step(ZpSim *sim, double end_time, ZpRunInfo *info) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  ZpExplicitSystem system = {2 * model->stride, sim, accelerate, is_sequential(model) ? next_event : NULL};
  if (!prepare_step(sim)) return;
  double corner = next_corner(sim), stop = fmin(end_time, corner), before = height(sim),
         load = zp_state_load(model, state, state->t);
  ZpExplicitStep taken =
      zp_explicit_step(&system, stop - state->t, zp_state_q(model, state), zp_state_v(model, state), sim->a);
  state->t = taken.limit == ZP_EXPLICIT_END ? stop : state->t + taken.dt;
  state->drag_loss += sim->eval.drag_power * taken.dt;
  state->load_work += load * (before - height(sim));
  info->steps++;
  info->limited[limit_of(sim, taken.limit, state->t >= corner)]++;
  if (is_unilateral(model)) damp_faces(sim, taken.dt);
  follow_voltage(sim);
  if (!model->field) return;
  if (taken.limit == ZP_EXPLICIT_EVENT)
    meet(sim);
  else if (is_sequential(model))
    state->zip = sim->opened;
  state->was_open |= is_open(model, state);
  if (isnan(state->zip_time) && state->U != 0 && reached_zip(model, state)) state->zip_time = state->t;
}

/* When within the step that has just been taken the opening fell to 1 %: on the straight line between its ends. */
static double zipped_at(const ZpModel *model, const ZpState *state, double before, double taken) {
  double now = opening(model, state), limit = 0.01 * state->opening0;
  return before > limit ? state->t - taken * (limit - now) / (before - now) : state->t;
}

static ZpStepLimit implicit_limit(const ZpSim *sim, bool corner, bool end) {
  if (corner) return ZP_LIMIT_EVENT;
  if (end) return ZP_LIMIT_END;
  return sim->dynamics.stepper.fixed > 0 ? ZP_LIMIT_TIME_STEP : ZP_LIMIT_ERROR;
}

/* A step that ends at `latest` or before => its length, 0 if none was found. Of the shortest, where rounding, a pulse
 * or a steep rise has put the next corner, only time takes notice. */
static double advance_implicit(ZpSim *sim, double latest) {
  static const double shortest = 1e-13; /* s: less than a nanometre at the speed of sound */
  ZpState *state = sim->state;
  double left = latest - state->t, before = height(sim), load = zp_state_load(sim->model, state, state->t);
  if (left < shortest) {
    state->t = latest;
    return left;
  }
  double taken = zp_dynamics_step(&sim->dynamics, state, latest);
  if (!(taken > 0)) return 0;
  state->load_work += 0.5 * (load + zp_state_load(sim->model, state, state->t)) * (before - height(sim));
  if (zp_is_pair(&sim->model->topology)) state->zip = touching(sim->model, sim->dynamics.eval.plates.gap);
  return taken;
}

static void implicit_step(ZpSim *sim, double end_time, ZpRunInfo *info) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  double corner = next_corner(sim), latest = fmin(fmin(end_time, corner), state->t + resolution(sim));
  double before = opening(model, state);
  if (!prepare_step(sim)) return;
  double taken = advance_implicit(sim, latest);
  sim->stuck = !(taken > 0);
  if (sim->stuck) return;
  info->steps++;
  info->limited[implicit_limit(sim, state->t >= corner, state->t >= end_time)]++;
  follow_voltage(sim);
  if (!zp_is_pair(&model->topology)) return;
  state->was_open |= is_open(model, state);
  if (isnan(state->zip_time) && state->U != 0 && reached_zip(model, state))
    state->zip_time = zipped_at(model, state, before, taken);
}

static void step(ZpSim *sim, double end_time, ZpRunInfo *info) {
  if (sim->model->def.solver.integrator == ZP_INTEGRATOR_IMPLICIT)
    implicit_step(sim, end_time, info);
  else
    explicit_step(sim, end_time, info);
}

/* -- a run ---------------------------------------------------------------------------------------- */

/* Fine enough for a fast zip and for a wave; the records thin themselves where a run is long. */
static double sampling_interval(const ZpModel *model) {
  static const double finest = 1e-4; /* s */
  double least = fmin(finest, zp_waveform_period(&model->waveform) / 40);
  return fmin(least, model->def.solver.end_time / model->def.output.samples);
}

static void note_bounds(const ZpSim *sim, ZpRunInfo *info) {
  ZpStepBounds bounds = zp_eval_step_bounds(sim->model, sim->state, &sim->eval);
  info->smallest_bound[0] = fmin(info->smallest_bound[0], bounds.drag);
  info->smallest_bound[1] = fmin(info->smallest_bound[1], bounds.axial);
  info->smallest_bound[2] = fmin(info->smallest_bound[2], bounds.shear);
}

/* Before a step that the end of the run may cut: from there on a longer run would take others. */
static void keep_before_cut(ZpSim *sim, double end_time) {
  static const double rounding = 1e-5;
  const ZpModel *model = sim->model;
  double fixed = sim->dynamics.stepper.fixed, longest = fixed > 0 ? fixed : sim->state->next_step;
  if (model->def.solver.integrator == ZP_INTEGRATOR_EXPLICIT) longest = model->stable_step;
  if (sim->cut || end_time - sim->state->t > (1 + rounding) * longest) return;
  keep(sim);
  sim->cut = true;
}

static bool nothing_recorded(const ZpSim *sim) {
  return (sim->series && sim->series->rows == 0) || (sim->shapes && sim->shapes->frames == 0);
}

static bool asked_to_stop(const ZpHooks *hooks, double fraction) {
  return hooks && hooks->progress && hooks->progress(hooks->user, "simulating", fmin(fraction, 1));
}

/* Steps between questions to the caller, about a millisecond. An implicit step costs as much as a hundred explicit
 * ones. */
static int64_t between_questions(const ZpModel *model) {
  return model->def.solver.integrator == ZP_INTEGRATOR_IMPLICIT ? 8 : 1024;
}

static ZpOutcome advance(ZpSim *sim, double end_time, bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *info) {
  enum { BETWEEN_LOOKS = 1024 }; /* steps between looks at divergence */
  const ZpModel *model = sim->model;
  const int64_t between = between_questions(model);
  ZpState *state = sim->state;
  double start = state->t, interval = sampling_interval(model), next_sample = start + interval;
  bool recording = sim->series || sim->shapes;
  if (nothing_recorded(sim)) zp_sim_offer_record(sim);
  while (state->t < end_time) {
    if (info->steps >= model->def.solver.max_steps) return ZP_STEP_LIMIT;
    keep_before_cut(sim, end_time);
    step(sim, end_time, info);
    if (sim->stuck) return ZP_DIVERGED;
    bool sample = recording && state->t >= next_sample;
    if (sample || info->steps % BETWEEN_LOOKS == 0) {
      if (diverged(model, state)) return ZP_DIVERGED;
      keep(sim);
    }
    bool question = sample || info->steps % between == 0;
    if (question && asked_to_stop(hooks, (state->t - start) / (end_time - start)))
      return diverged(model, state) ? ZP_DIVERGED : ZP_INTERRUPTED;
    if (sample) {
      zp_sim_offer_record(sim);
      note_bounds(sim, info);
      next_sample += interval * ceil((state->t - next_sample) / interval + 1e-9);
    }
    if (shorted(model, state)) return ZP_SHORT_CIRCUIT;
    if (stop_when_zipped && model->field && closed(model, state)) return ZP_ZIPPED;
  }
  return diverged(model, state) ? ZP_DIVERGED : ZP_REACHED_END;
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
    snprintf(text, size, "closed after %.4g ms", 1e3 * sim->state->zip_time);
    break;
  case ZP_INTERRUPTED:
    snprintf(text, size, "interrupted at %g s; what was done is kept", t);
    break;
  case ZP_NOT_SETTLED:
    snprintf(text, size, "no hanging equilibrium found: %g of the weight is still unbalanced after %lld steps",
             sim->settle_residual, (long long)sim->settle_steps);
    break;
  case ZP_DIVERGED:
    if (sim->eval.surplus.end != ZP_FIELD_SOLVED)
      snprintf(text, size, "the field could not be solved before %g s: %s; what was recorded until then is kept", t,
               zp_field_words(sim->eval.surplus.end));
    else if (sim->stuck)
      snprintf(text, size, "no time step converges at %g s, however short; what was recorded until then is kept", t);
    else
      snprintf(text, size, "diverged before %g s; what was recorded until then is kept; try a smaller solver.time_step",
               t);
    break;
  case ZP_STEP_LIMIT:
    snprintf(text, size, "stopped at %g s after solver.max_steps = %d steps", t, sim->model->def.solver.max_steps);
    break;
  case ZP_SHORT_CIRCUIT:
    snprintf(text, size, "short circuit at %.4g ms: electrodes without an insulator touch at %g V", 1e3 * t,
             sim->state->U);
    break;
  case ZP_CONVERGED:
  case ZP_FOLLOWED:
  case ZP_BRANCH_LOST:
  case ZP_PULLED_IN:
    break; /* of studies of rest */
  case ZP_BAD_ARGUMENT:
    snprintf(text, size, "initial.state = checkpoint: none was given; zp_sim_continue takes it");
    break;
  }
}

/* What was asked for cannot be: nothing is done, and `info` says so. */
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

ZpOutcome zp_sim_run(ZpSim *sim, double end_time, bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *out) {
  if (!(end_time >= sim->state->t)) return refuse(sim, "end_time", end_time, "not a time from the present one on", out);
  ZpRunInfo info = {.settle_steps = sim->settle_steps,
                    .settle_residual = sim->settle_residual,
                    .smallest_bound = {INFINITY, INFINITY, INFINITY}};
  bool clock = hooks && hooks->clock;
  ZpImplicitCounts before = sim->dynamics.stepper.counts;
  double start_time = sim->state->t, start_clock = clock ? hooks->clock(hooks->user) : NAN;
  info.outcome = sim->settled;
  sim->cut = false;
  if (info.outcome == ZP_REACHED_END) {
    keep(sim);
    info.outcome = advance(sim, end_time, stop_when_zipped, hooks, &info);
    if (info.outcome != ZP_DIVERGED) zp_sim_close_record(sim);
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

ZpOutcome zp_sim_step(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info) {
  static const double rounding = 1e-9; /* above that of the time reached: no sliver of a step is left at the end */
  double longest = fmin(sim->model->stable_step, sim->model->def.solver.time_step); /* NAN, auto, does not count */
  double end = sim->state->t + dt;
  if (!(end > sim->state->t) || isinf(dt)) return refuse(sim, "dt", dt, "not a finite time that moves on", info);
  sim->even = dt / ceil(dt / longest) * (1 + rounding);
  ZpOutcome outcome = zp_sim_run(sim, end, false, hooks, info);
  sim->even = INFINITY;
  return outcome;
}

/* -- state ---------------------------------------------------------------------------------------- */

double zp_sim_zip_time(const ZpSim *sim) {
  return sim->state->zip_time;
}

void zp_sim_resume(ZpSim *sim) {
  ZpState *state = sim->state;
  double voltage = state->by_hand ? state->U : zp_waveform_voltage(&sim->model->waveform, state->t);
  sim->row_time = state->t;
  sim->row_charge = zp_eval_electric_now(sim->model, state, state->U, &sim->eval).charge;
  if (sim->settled == ZP_BAD_ARGUMENT) sim->settled = ZP_REACHED_END;
  zp_sim_jump(sim, voltage);
  sim->cut = false;
}

size_t zp_sim_state_size(const ZpSim *sim) {
  return zp_snapshot_size(sim->model);
}

void zp_sim_save(const ZpSim *sim, void *bytes) {
  zp_snapshot_write(sim->model, sim->state, bytes);
}

ZpStatus zp_sim_restore(ZpSim *sim, const void *bytes, size_t size, ZpError *err) {
  ZpError reason;
  ZpStatus status = zp_snapshot_read(sim->model, bytes, size, sim->state, &reason);
  if (status != ZP_OK) return zp_fail(err, status, "state: %.500s", reason.message);
  zp_sim_resume(sim);
  return ZP_OK;
}
