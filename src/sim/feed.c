/* The supply at the electrodes, docs/theory.md, section 23. Its inner voltage V follows from the command alone
 * (drive/supply.c), so its events are corners in time. Limits of the current depend on what the electrodes take: a step
 * that passes one is taken again, so that it ends there. */
#include "sim/feed.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"
#include "sim/sim_internal.h"

static const double least_capacitance = 1e-15; /* F, of a wire: a capped charge has no capacitance */
static const double at_limit = 1e-7;           /* of the scale: a limit is reached, */
static const double past_limit = 1e-6;         /* or passed */
static const double shortest = 1e-12;          /* s: a limit is passed at once; */
static const double shortest_held = 1e-9;      /* under a held voltage: shorter steps are rounding of positions */

bool zp_sim_is_fed(const ZpSim *sim) {
  return sim->model->supply.acts;
}

/* -- what the supply is told, and its inner voltage ------------------------------------------------ */

static ZpCommand command_of(const ZpSim *sim) {
  const ZpState *state = sim->state;
  return (ZpCommand){&sim->model->waveform, state->by_hand ? &state->voltage_input : NULL};
}

double zp_sim_command(const ZpSim *sim) {
  ZpCommand command = command_of(sim);
  return zp_command_voltage(&command, sim->state->t);
}

static ZpSupplyState followed(const ZpSim *sim, const ZpState *from, double to) {
  ZpCommand command = command_of(sim);
  return zp_supply_follow(&sim->model->supply, &command, from->t, to, from->supply);
}

/* Inner voltage at the end of a step of h. */
static double inner_after(const ZpSim *sim, double h) {
  double t = sim->state->t, latest = sim->dynamics.latest;
  return followed(sim, sim->state, h == latest - t ? latest : t + h).voltage;
}

double zp_feed_event(const ZpSim *sim, double latest) {
  static const double far = 1; /* s */
  ZpCommand command = command_of(sim);
  double t = sim->state->t;
  return zp_supply_event(&sim->model->supply, &command, t, fmin(latest, t + far), sim->state->supply);
}

double zp_feed_resolution(const ZpSim *sim, double least) {
  ZpCommand command = command_of(sim);
  const ZpState *state = sim->state;
  double V = state->supply.voltage, rate = zp_supply_rate(&sim->model->supply, &command, state->t, state->supply);
  double inner = zp_ramp_resolution(fmax(least, fabs(V)), rate);
  return fmin(inner, zp_ramp_resolution(fmax(least, fabs(state->U)), state->U_rate));
}

/* -- the law of the current ------------------------------------------------------------------------ */

static double cable_of(const ZpSim *sim) {
  return fmax(sim->model->supply.capacitance, least_capacitance);
}

double zp_feed_cable_energy(const ZpSim *sim, double U) {
  return 0.5 * cable_of(sim) * U * U;
}

static bool holds_voltage(const ZpSim *sim) {
  return sim->state->supply_mode == ZP_FEED_FREE && sim->model->supply.resistance == 0;
}

/* Weight of a step's end in the drop over the resistance: with it a constant capacitance charges exactly, whatever the
 * step, eq. (23.5). */
static double weight_of_end(const ZpSim *sim, double h) {
  return zp_decay_weight(h / (sim->model->supply.resistance * sim->feed.capacitance));
}

/* Mean current over a step, A. */
static double current_over(const ZpSim *sim, double h, double U0, double U1) {
  const ZpSupply *supply = &sim->model->supply;
  if (sim->state->supply_mode == ZP_FEED_GIVES_MOST) return supply->most;
  if (sim->state->supply_mode == ZP_FEED_SINKS_MOST) return -supply->sinks;
  double end = weight_of_end(sim, h), V0 = sim->state->supply.voltage;
  return ((1 - end) * (V0 - U0) + end * (inner_after(sim, h) - U1)) / supply->resistance;
}

static double flow(const void *self, double t, double h, double U0, double U1) {
  const ZpSim *sim = self;
  (void)t;
  double bleeds = 0.5 * (U0 + U1) * sim->model->supply.conductance;
  return h * (current_over(sim, h, U0, U1) - bleeds) - cable_of(sim) * (U1 - U0);
}

static double slope(const void *self, double t, double h, double U0, double U1) {
  const ZpSim *sim = self;
  const ZpSupply *supply = &sim->model->supply;
  (void)t, (void)U0, (void)U1;
  double through = sim->state->supply_mode == ZP_FEED_FREE ? weight_of_end(sim, h) / supply->resistance : 0;
  return -h * (through + 0.5 * supply->conductance) - cable_of(sim);
}

/* Without a resistance the electrodes have the inner voltage, except for the difference that the end of a limit has
 * left. */
static bool holds(const void *self, double t, double h, double *U1) {
  const ZpSim *sim = self;
  const ZpState *state = sim->state;
  (void)t;
  if (!holds_voltage(sim)) return false;
  double left = state->U - state->supply.voltage;
  *U1 = inner_after(sim, h) + (fabs(left) > 1e-2 * at_limit * sim->feed.scale ? left : 0);
  return true;
}

void zp_feed_create(ZpSim *sim) {
  static const double usual = 1e3; /* V: scale where the waveform has none */
  double largest = zp_waveform_largest(&sim->model->waveform);
  sim->feed.scale = largest > 0 ? largest : usual;
  sim->feed.source = (ZpSource){.self = sim, .flow = flow, .slope = slope, .holds = holds, .scale = sim->feed.scale};
}

/* -- limits ---------------------------------------------------------------------------------------- */

/* Drop over the resistance at which a limit of the current begins, V. */
static double drop_at(const ZpSupply *supply, double limit) {
  return supply->resistance > 0 ? supply->resistance * limit : 0;
}

/* Scale of currents of a supply without a resistance, A. */
static double usual_current(const ZpSupply *supply) {
  static const double usual = 1e-3;
  if (isfinite(supply->most)) return supply->most;
  return isfinite(supply->sinks) && supply->sinks > 0 ? supply->sinks : usual;
}

/* Distance of a mean current from the nearer limit => that limit. */
static double within(const ZpSupply *supply, double current, ZpFeedMode *nearer) {
  double out = supply->most - current, in = supply->sinks + current;
  *nearer = out < in ? ZP_FEED_GIVES_MOST : ZP_FEED_SINKS_MOST;
  return fmin(out, in);
}

/* Distance of the supply from the end of its mode, in its scale; negative beyond. `left`: V - U; `current`: the mean of
 * the step, of a supply without a resistance. */
static double margin(ZpSim *sim, double left, double current) {
  const ZpSupply *supply = &sim->model->supply;
  switch (sim->state->supply_mode) {
  case ZP_FEED_GIVES_MOST:
    return (left - drop_at(supply, supply->most)) / sim->feed.scale;
  case ZP_FEED_SINKS_MOST:
    return (-left - drop_at(supply, supply->sinks)) / sim->feed.scale;
  default:
    break;
  }
  if (supply->resistance == 0) return within(supply, current, &sim->feed.beyond) / usual_current(supply);
  return within(supply, left / supply->resistance, &sim->feed.beyond) * supply->resistance / sim->feed.scale;
}

static void change_mode(ZpSim *sim) {
  ZpState *state = sim->state;
  state->supply_mode = state->supply_mode == ZP_FEED_FREE ? sim->feed.beyond : ZP_FEED_FREE;
}

/* -- books ----------------------------------------------------------------------------------------- */

/* Work on the electrodes until now, including the part that is not yet in state->work; of one part. */
static double given(const ZpState *state, double charge) {
  return state->work + state->U * (charge - state->base_charge);
}

/* Energy that a jump of the voltage takes at once. The part that the electrodes do not keep is their charging loss. */
static void jump(ZpSim *sim, double V) {
  ZpState *state = sim->state;
  double parts = sim->model->parts, C = cable_of(sim), U0 = state->U;
  double charge0 = zp_system_electric_now(sim->model, state, U0, &sim->eval).charge, work0 = given(state, charge0);
  zp_sim_jump(sim, V);
  if (state->U != state->base_U) zp_sim_close_account(sim);
  double work = parts * (given(state, state->base_charge) - work0);
  state->source_charge += parts * (state->base_charge - charge0) + C * (V - U0);
  state->source_energy += work + C * V * (V - U0);
  state->source_loss += 0.5 * C * (V - U0) * (V - U0);
  sim->feed.peak = sim->feed.square = INFINITY;
}

/* Charge that the supply has delivered over the last step, C. */
static double charge_given(const ZpSim *sim) {
  const ZpState *state = sim->state, *before = sim->before;
  double taken = sim->model->parts * (sim->dynamics.charge1 - sim->dynamics.charge0 + (state->leaked - before->leaked));
  double bled = (state->t - before->t) * sim->model->supply.conductance * 0.5 * (before->U + state->U);
  return taken + cable_of(sim) * (state->U - before->U) + bled;
}

void zp_feed_note_current(ZpSim *sim, double current, double h) {
  sim->feed.square += current * current * h;
  sim->feed.peak = fmax(sim->feed.peak, fabs(current));
}

/* Behind a resistance the current is largest at the start or the end of a step, A; at a limit it is constant. */
static double through(const ZpSim *sim, double drop, double mean) {
  const ZpState *state = sim->state;
  const bool varies = state->supply_mode == ZP_FEED_FREE && sim->model->supply.resistance > 0;
  return varies ? drop / sim->model->supply.resistance : mean;
}

static void note_currents(ZpSim *sim, double mean, double h) {
  const ZpState *state = sim->state, *before = sim->before;
  ZpFeed *feed = &sim->feed;
  feed->current[ZP_CURRENT_MEAN] = mean;
  feed->current[ZP_CURRENT_AT_START] = through(sim, before->supply.voltage - before->U, mean);
  feed->current[ZP_CURRENT_AT_END] = through(sim, state->supply.voltage - state->U, mean);
  feed->largest = ZP_FEED_CURRENTS;
  feed->square += mean * mean * h;
  for (int k = 0; k < ZP_FEED_CURRENTS; k++)
    if (fabs(feed->current[k]) > feed->peak) feed->peak = fabs(feed->current[k]), feed->largest = k;
}

/* The books of a step, eqs. (23.6) and (23.7). */
static void book(ZpSim *sim) {
  ZpState *state = sim->state;
  const ZpState *before = sim->before;
  const ZpDynamics *d = &sim->dynamics;
  const double h = state->t - before->t, charge = charge_given(sim), U = 0.5 * (before->U + state->U);
  double electrodes = sim->model->parts * (given(state, d->charge1) - given(before, d->charge0));
  double bled = h * sim->model->supply.conductance * U * U;
  double taken = electrodes + cable_of(sim) * U * (state->U - before->U) + bled;
  double energy = holds_voltage(sim) ? taken : 0.5 * (before->supply.voltage + state->supply.voltage) * charge;
  state->source_charge += charge;
  state->source_energy += energy;
  state->source_loss += energy - taken;
  state->bleeder_loss += bled;
  note_currents(sim, charge / h, h);
}

/* -- a step ---------------------------------------------------------------------------------------- */

void zp_feed_arrive(ZpSim *sim) {
  ZpCommand command = command_of(sim);
  const ZpSupply *supply = &sim->model->supply;
  ZpState *state = sim->state;
  state->supply = zp_supply_jump(supply, &command, state->t, state->supply);
  double left = state->supply.voltage - state->U, little = past_limit * sim->feed.scale;
  double out = left - drop_at(supply, supply->most), in = -left - drop_at(supply, supply->sinks);
  size_t mode = state->supply_mode;
  bool goes_on = mode == ZP_FEED_GIVES_MOST ? out > -little : mode == ZP_FEED_SINKS_MOST && in > -little;
  state->supply_mode = out > little  ? ZP_FEED_GIVES_MOST
                       : in > little ? ZP_FEED_SINKS_MOST
                       : goes_on     ? mode
                                     : ZP_FEED_FREE;
  double limit = state->supply_mode == ZP_FEED_GIVES_MOST ? supply->most : supply->sinks;
  if (state->supply_mode == ZP_FEED_FREE || isfinite(limit)) return;
  state->supply_mode = ZP_FEED_FREE;
  jump(sim, state->supply.voltage);
}

/* Capacitance of electrodes and cable while they charge towards the inner voltage. */
static double capacitance_now(ZpSim *sim) {
  static const double share = 1e-3;
  const ZpState *state = sim->state;
  double step = copysign(share * sim->feed.scale, state->supply.voltage - state->U);
  double now = zp_system_electric_now(sim->model, state, state->U, &sim->eval).charge,
         then = zp_system_electric_now(sim->model, state, state->U + step, &sim->eval).charge;
  return cable_of(sim) + sim->model->parts * (then - now) / step;
}

void zp_feed_begin(ZpSim *sim) {
  sim->feed.capacitance = capacitance_now(sim);
  memcpy(sim->before, sim->state, zp_state_size(sim->model));
}

void zp_feed_end(ZpSim *sim) {
  sim->state->supply = followed(sim, sim->before, sim->state->t);
  book(sim);
}

/* => its margin at the end; NAN: no step was found. */
static double try_step(ZpSim *sim, double latest) {
  ZpState *state = sim->state;
  memcpy(sim->before, state, zp_state_size(sim->model));
  if (!(zp_dynamics_step(&sim->dynamics, &state, latest) > 0)) return NAN;
  state->supply = followed(sim, sim->before, state->t);
  return margin(sim, state->supply.voltage - state->U, charge_given(sim) / (state->t - sim->before->t));
}

/* Where in a step of h the margin is 0, as a share of the step: on a straight line, if the margin at its start is
 * known. */
static double crossing(double at_start, double at_end) {
  static const double least = 0.02, most = 0.98, blind = 0.25;
  return at_start > 0 ? fmin(fmax(at_start / (at_start - at_end), least), most) : blind;
}

/* The mode ends at the start of the step. At the end of a limit without a resistance the voltage jumps. */
static void leave_at_once(ZpSim *sim) {
  bool limited = sim->state->supply_mode != ZP_FEED_FREE;
  change_mode(sim);
  if (limited && sim->model->supply.resistance == 0) jump(sim, sim->state->supply.voltage);
}

bool zp_feed_step(ZpSim *sim, double latest) {
  enum { MOST_TRIES = 100, MOST_CHANGES = 4 };
  ZpState *state = sim->state;
  if (latest - state->t < shortest) {
    state->supply = followed(sim, state, latest);
    state->t = latest;
    return true;
  }
  double until = latest, at_end = NAN;
  sim->feed.capacitance = capacitance_now(sim);
  for (int tries = 0, changes = 0;; tries++) {
    bool known = !holds_voltage(sim);
    double at_start = known ? margin(sim, state->supply.voltage - state->U, 0) : NAN;
    at_end = try_step(sim, until);
    if (isnan(at_end)) return false;
    if (at_end >= -at_limit || tries == MOST_TRIES || changes == MOST_CHANGES) break;
    double h = (state->t - sim->before->t) * crossing(at_start, at_end);
    memcpy(state, sim->before, zp_state_size(sim->model));
    until = state->t + h;
    if (h > (known ? shortest : shortest_held)) continue;
    leave_at_once(sim);
    changes++;
    until = latest;
  }
  book(sim);
  if (at_end <= at_limit) change_mode(sim);
  return true;
}

/* -- what came of it ------------------------------------------------------------------------------- */

ZpCurrents zp_sim_currents(ZpSim *sim, double duration) {
  bool jumped = isinf(sim->feed.peak) || zp_sim_get(sim, "charging_loss") > 0;
  if (jumped || !(duration > 0)) return (ZpCurrents){NAN, NAN};
  return (ZpCurrents){sim->feed.peak, sqrt(sim->feed.square / duration)};
}
