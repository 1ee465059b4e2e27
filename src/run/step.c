/* A step of a run. To be read from the end: what is due and how long the step may be; the motion; the instant at which
 * the run ends, if it is in the step; what is counted. The motion is prepared, taken by implicit steps
 * (run/dynamics.c) or by the paper's explicit ones (paper_motion.c), and arrives. */
#include <math.h>

#include "base/memory.h"
#include "run/run.h"
#include "run/sensitivity.h"

/* -- the two methods ------------------------------------------------------------------------------- */

static bool create_implicit(ZpSim *sim) {
  const size_t members = sim->members;
  const ZpSource **source = zp_calloc(members, sizeof(ZpSource *));
  for (size_t k = 0; source && k < members; k++) {
    if (!zp_sim_has_supply(sim + k)) continue;
    zp_supply_coupling_create(sim + k);
    source[k] = &sim[k].feed.source;
    sim->fed++;
  }
  const bool made = source && zp_dynamics_create(sim->model, source, &sim->dynamics);
  zp_free(source);
  return made;
}

/* Take an implicit step. If rounding, a pulse or a steep rise has put the next corner closer than `shortest`, only time
 * advances. */
static bool step_implicit(ZpSim *sim, double latest, ZpStepLimit *limit) {
  static const double shortest = 1e-13; /* s: less than a nanometre at the speed of sound */
  ZpState *state = sim->state;
  *limit = sim->dynamics.stepper.fixed > 0 ? ZP_LIMIT_TIME_STEP : ZP_LIMIT_ERROR;
  if (sim->fed > 0) return zp_supply_coupling_step(sim, latest);
  if (latest - state->t < shortest) {
    for (ZpSim *m = sim; m < sim + sim->members; m++)
      m->state->t = latest;
    return true;
  }
  return zp_dynamics_step(&sim->dynamics, sim->states, latest) > 0;
}

static double longest_implicit(const ZpSim *sim) {
  double fixed = sim->dynamics.stepper.fixed;
  return fixed > 0 ? fixed : sim->state->next_step;
}

static bool create_explicit(ZpSim *sim) {
  return zp_paper_motion_create(sim->model, &sim->eval, &sim->paper);
}

static bool step_explicit(ZpSim *sim, double latest, ZpStepLimit *limit) {
  static const ZpStepLimit limits[] = {[ZP_PAPER_STABILITY] = ZP_LIMIT_STABILITY,
                                       [ZP_PAPER_ASKED] = ZP_LIMIT_TIME_STEP,
                                       [ZP_PAPER_DRAG] = ZP_LIMIT_DRAG,
                                       [ZP_PAPER_MEETING] = ZP_LIMIT_EVENT,
                                       [ZP_PAPER_END] = ZP_LIMIT_END};
  *limit = limits[zp_paper_motion_step(&sim->paper, sim->state, latest)];
  return true;
}

static double longest_explicit(const ZpSim *sim) {
  return sim->model->stable_step;
}

/* An implicit step costs as much as a hundred explicit ones. */
static const ZpStepping implicit = {create_implicit, step_implicit, longest_implicit, 8, false};
static const ZpStepping explicit = {create_explicit, step_explicit, longest_explicit, 1024, true};

const ZpStepping *zp_stepping_of(const ZpModel *model) {
  return model->def.solver.integrator == ZP_INTEGRATOR_IMPLICIT ? &implicit : &explicit;
}

bool zp_sim_connect(ZpSim *sim, const ZpSource *source) {
  zp_dynamics_destroy(&sim->dynamics);
  const ZpSource **of = zp_calloc(sim->members, sizeof(ZpSource *));
  if (of) of[0] = source;
  const bool made = of && zp_dynamics_create(sim->model, of, &sim->dynamics);
  zp_free(of);
  return made;
}

/* -- how long a step may be ------------------------------------------------------------------------ */

/* A change of the load that is due now comes before the next step. */
static double next_change(const ZpSim *sim) {
  double due = zp_sim_load_due(sim);
  return due > sim->state->t ? due : INFINITY;
}

/* Of the drive of one member. */
static double corner_of(const ZpSim *m) {
  const ZpState *state = m->state;
  return state->by_hand ? zp_ramp_corner(&state->voltage_input, state->t)
                        : zp_waveform_next_corner(&m->model->waveform, state->t);
}

/* Of what a program sets on bodies. */
static double corner_of_pushes(const ZpSim *sim) {
  double corner = INFINITY;
  for (size_t k = 0; k < zp_state_pushes_size(sim->model) / ZP_RAMP_NUMBERS; k++)
    corner = fmin(corner, zp_ramp_corner(zp_state_push(sim->model, sim->state, 0, k), sim->state->t));
  return corner;
}

static void add_corner(double t, ZpCorner *next) {
  static const double rounding = 1e-12;
  if (fabs(t - next->t) <= rounding * next->t)
    next->inputs++;
  else if (t < next->t)
    next->inputs = 1;
  next->t = fmin(next->t, t);
}

ZpCorner zp_sim_next_corner(ZpSim *sim) {
  ZpCorner next = {INFINITY, 0};
  for (const ZpSim *m = sim; m < sim + sim->members; m++) {
    if (zp_leads_port(m->model)) add_corner(corner_of(m), &next);
    add_corner(zp_sim_control_due(m), &next);
  }
  add_corner(corner_of_pushes(sim), &next);
  add_corner(next_change(sim), &next);
  add_corner(zp_ramp_corner(&zp_sim_loaded(sim)->state->load_input, sim->state->t), &next);
  return next;
}

/* Longest step, s, for an input that a program sets and whose size matters from `least` on; never so short that time
 * stands still. */
static double hand_resolution(const ZpRamp *ramp, double least, double t) {
  static const double shortest = 1e-9; /* s */
  double largest = fmax(least, fabs(zp_ramp_value(ramp, t)));
  return fmax(zp_ramp_resolution(largest, zp_ramp_rate(ramp, t)), shortest);
}

/* For the voltage of a port. */
static double resolution_of(ZpSim *lead) {
  static const double least_voltage = 1e3; /* V */
  const ZpState *state = lead->state;
  const ZpWaveform *waveform = &lead->model->waveform;
  double t = state->t, usual = fmax(least_voltage, zp_waveform_largest(waveform));
  double voltage =
      state->by_hand ? hand_resolution(&state->voltage_input, usual, t) : zp_waveform_resolution(waveform, t);
  if (zp_sim_is_fed(lead)) voltage = fmin(voltage, zp_supply_coupling_resolution(lead, usual));
  return lead->model->leaks ? fmin(voltage, zp_ramp_resolution(usual, zp_sim_leak(lead).fastest)) : voltage;
}

/* Longest step for all that changes from outside the actuator, s. */
static double resolution(ZpSim *sim) {
  double longest =
      hand_resolution(&zp_sim_loaded(sim)->state->load_input, zp_eval_weight_scale(sim->model), sim->state->t);
  for (size_t k = 0; k < zp_state_pushes_size(sim->model) / ZP_RAMP_NUMBERS; k++)
    longest = fmin(longest, hand_resolution(zp_state_push(sim->model, sim->state, 0, k),
                                            zp_eval_weight_scale(sim->model), sim->state->t));
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_leads_port(m->model)) longest = fmin(longest, resolution_of(m));
  return longest;
}

/* -- a motion -------------------------------------------------------------------------------------- */

/* Before a motion of one member: complete a jump of the voltage, and update what is held over several steps. If this
 * fails there is no step: a field that cannot be solved ends the run. */
static bool prepare_step(ZpSim *m) {
  ZpState *state = m->state;
  if (state->U != state->base_U) zp_sim_close_balance(m);
  if (!zp_cached_field_due(m->model, state)) return true;
  double charge = zp_sim_is_fed(m) ? zp_system_electric_now(m->model, state, state->U, &m->eval).charge : 0;
  if (zp_cached_field_refresh(m->model, state, &m->eval) != ZP_END_FOUND) return false;
  if (zp_sim_is_fed(m)) zp_supply_coupling_renew(m, charge);
  return true;
}

/* Jump to a voltage. Fields and stresses before a jump count, like those after it. */
static void jump_to(ZpSim *sim, double voltage) {
  if (voltage != sim->state->U) zp_sim_see_one(sim);
  zp_sim_jump(sim, voltage);
}

/* The voltage at the time that a step has reached. An explicit step has used the voltage of its start throughout. */
static void follow_voltage(ZpSim *sim) {
  const ZpWaveform *waveform = &sim->model->waveform;
  ZpState *state = sim->state;
  if (state->by_hand) {
    zp_sim_glide(sim, zp_ramp_value(&state->voltage_input, state->t));
    return;
  }
  zp_sim_glide(sim, zp_waveform_voltage_before(waveform, state->t));
  jump_to(sim, zp_waveform_voltage(waveform, state->t));
}

/* Opening and rate at the start of the step. */
static void note_start(ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpMotion motion = zp_state_motion(model, sim->state);
  if (!model->field) return;
  sim->step_start =
      (ZpStepStart){sim->state->t, zp_last_gap(model, motion.y), zp_last_gap_rate(model, motion.y, motion.vy)};
}

bool zp_sim_prepare(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    note_start(m);
    sim->step_failed = !prepare_step(m);
    if (sim->step_failed) return false;
  }
  return true;
}

void zp_sim_arrive(ZpSim *sim) {
  for (size_t k = 0; k < sim->members; k++) {
    if (sim->stepping->fine || !sim->dynamics.member[k].port) follow_voltage(sim + k);
    zp_sim_note_end(sim + k, sim->dynamics.member + k);
  }
}

static void keep_start(ZpSim *sim) {
  zp_sim_keep_states(sim);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    m->feed_before = m->feed;
}

static void return_to_start(ZpSim *sim) {
  zp_sim_take_states_back(sim);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    m->feed = m->feed_before;
}

/* A step that ends at `latest` or before; false if none was found. */
static bool take(ZpSim *sim, double latest, ZpStepLimit *limit) {
  sim->links_due = false;
  if (!zp_sim_prepare(sim)) return false;
  sim->step_failed = !sim->stepping->step(sim, latest, limit);
  if (!sim->step_failed) zp_sim_arrive(sim);
  sim->links_due = !sim->step_failed && zp_abreast(sim->model) > 1 && !sim->stepping->fine;
  return !sim->step_failed;
}

void zp_sim_book_links(ZpSim *sim) {
  for (size_t k = 0; sim->links_due && k < sim->members; k++)
    zp_dynamics_book_link(&sim->dynamics, k, sim[k].before, sim[k].state);
  sim->links_due = false;
}

/* Instants in a step, s, and what is left at them: before and at or after the end of the run. */
typedef struct Bracket {
  double early, late, left_early, left_late;
  double aim; /* a trial aims so far beyond the end, m: an aim at the end itself would often end before it */
  int stayed; /* the instant that stayed in the last trial: 1 `early`, -1 `late`, 0 none yet */
} Bracket;

/* One trial of the method of false position, in which a point that stays again counts half => whether a step was found.
 */
static bool narrow(ZpSim *sim, ZpLanding landing, Bracket *b, ZpStepLimit *limit) {
  const double share = (b->left_late + b->aim) / (b->left_late - b->left_early);
  if (!take(sim, b->late - share * (b->late - b->early), limit)) return false;
  double left = zp_sim_left(sim, landing);
  if (left > 0)
    *b = (Bracket){sim->state->t, b->late, left, (b->stayed < 0 ? 0.5 : 1) * b->left_late, b->aim, -1};
  else
    *b = (Bracket){b->early, sim->state->t, (b->stayed > 0 ? 0.5 : 1) * b->left_early, left, b->aim, 1};
  return true;
}

/* Take the last step again until it ends where the run does. */
static void land(ZpSim *sim, ZpLanding landing, ZpStepLimit *limit) {
  enum { MOST_TRIES = 50 };
  const double shortest = 1e-15 * sim->state->t, least = 1e-14 * sim->model->L;
  Bracket b = {.late = sim->state->t, .left_late = zp_sim_left(sim, landing), .aim = 0.5 * least};
  bool landed = b.left_late >= -least;
  return_to_start(sim);
  b.early = sim->state->t;
  b.left_early = sim->left_before = zp_sim_left(sim, landing);
  bool inside = b.left_early > 0 && isfinite(b.left_early);
  for (int k = 0; k < MOST_TRIES && inside && !landed && b.late - b.early > shortest; k++) {
    if (!narrow(sim, landing, &b, limit)) break;
    landed = sim->state->t == b.late && b.left_late >= -least;
    if (!landed) return_to_start(sim);
  }
  if (inside) sim->landing = landing;
  if (sim->state->t == b.late && !sim->step_failed) return;
  return_to_start(sim);
  take(sim, b.late, limit);
}

static ZpStepLimit limit_of(const ZpSim *sim, ZpStepLimit limit, double corner, double end_time) {
  if (sim->state->t >= corner) return ZP_LIMIT_EVENT;
  return limit != ZP_LIMIT_EVENT && sim->state->t >= end_time ? ZP_LIMIT_END : limit;
}

/* -- a step ---------------------------------------------------------------------------------------- */

/* The begin of a step: the next corner of the inputs or event of the supply, s; the step's latest end, s; and what
 * tells afterwards whether an event has happened. */
typedef struct Step {
  double corner, latest;
  size_t supply_mode;
  bool unzipped;
  ZpStepLimit limit;
} Step;

/* Changes that are due now, and how long nothing from outside stops the motion. */
static Step begin(ZpSim *sim, double end_time) {
  const ZpState *state = sim->state;
  if (sim->rates) zp_run_sensitivity_look_ahead(sim->rates, end_time);
  if (state->t >= zp_sim_load_due(sim)) zp_sim_change_load(sim);
  zp_supply_coupling_arrive(sim);
  double corner = zp_sim_next_corner(sim).t, latest = fmin(end_time, corner);
  if (!sim->stepping->fine) latest = fmin(latest, state->t + resolution(sim));
  if (sim->fed > 0) {
    const ZpSupplyEvent event = zp_supply_coupling_next(sim, latest);
    corner = fmin(corner, event.t);
    latest = fmin(latest, corner);
    if (sim->rates) sim->rates->event = event;
  }
  return (Step){.corner = corner,
                .latest = latest,
                .supply_mode = state->supply_mode,
                .unzipped = sim->stops_at_events && isnan(zp_sim_zip_time(sim))};
}

/* Where the run ends within the step, the step ends there. */
static void end_at_event(ZpSim *sim, Step *step) {
  ZpLanding landing = sim->stepping->fine ? ZP_LANDS_NOWHERE : zp_sim_landing(sim);
  if (landing != ZP_LANDS_NOWHERE) land(sim, landing, &step->limit);
}

static void count(ZpSim *sim, const Step *step, double end_time, ZpRunInfo *info) {
  const ZpStepLimit limit = limit_of(sim, step->limit, step->corner, end_time);
  info->steps++;
  info->limited[limit]++;
  if (sim->rates) zp_run_sensitivity_follow(sim->rates);
  if (sim->stepped) sim->stepped(sim, sim->stepped_user);
  sim->at_event = limit == ZP_LIMIT_EVENT || sim->state->supply_mode != step->supply_mode ||
                  (step->unzipped && !isnan(zp_sim_zip_time(sim)));
}

void zp_sim_advance(ZpSim *sim, double end_time, ZpRunInfo *info) {
  Step step = begin(sim, end_time);
  if (!sim->stepping->fine) keep_start(sim);
  take(sim, step.latest, &step.limit);
  if (!sim->step_failed) end_at_event(sim, &step);
  if (!sim->step_failed) count(sim, &step, end_time, info);
}
