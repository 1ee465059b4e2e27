/* The supply at the electrodes, docs/theory.md, section 23. Its inner voltage V follows from the command alone
 * (drive/supply.c), so its events are corners in time. A limit of the current depends on what the electrodes take: it
 * is part of the step's equations. */
#include "sim/feed.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"
#include "sim/sim_internal.h"

static const double least_capacitance = 1e-15; /* F, of a wire: a capped charge has no capacitance */
static const double undecided = 1e-13;         /* F: with less, charge that cannot leave would raise any voltage */
static const double past_limit = 1e-6;         /* of the scale: a limit is passed */
static const double shortest = 1e-12;          /* s: in shorter ones only time advances */
static const double instant = 1e-9;            /* s: the electrodes charge at once */

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

/* A wire and a bleeder are parallel to the electrodes: the charge that all take over a step, C, and its derivative by
 * the voltage at the end beside that of the electrodes, F. */
static double taken_by_all(const ZpSim *sim, const ZpSourceStep *s) {
  double bleeds = 0.5 * (s->U0 + s->U1) * sim->model->supply.conductance;
  return s->taken + cable_of(sim) * (s->U1 - s->U0) + s->h * bleeds;
}

static double parallel(const ZpSim *sim, double h) {
  return cable_of(sim) + 0.5 * h * sim->model->supply.conductance;
}

/* The law without limits of the current: s = 0 for the mean s over the step of V - U less the drop R I. With the weight
 * theta of the step's end a constant capacitance charges exactly, whatever the step, eq. (23.5). As a charge that falls
 * with U1 like that of the electrodes. */
static ZpSourceLaw follows_voltage(const ZpSim *sim, const ZpSourceStep *s) {
  double R = sim->model->supply.resistance, beside = parallel(sim, s->h), C = s->C + beside;
  double x = s->h / (R * (s->C + cable_of(sim))), end = zp_decay_weight(x), scale = C / (end + R * C / s->h);
  double drop = (1 - end) * (sim->state->supply.voltage - s->U0) + end * (inner_after(sim, s->h) - s->U1);
  return (ZpSourceLaw){.lacks = scale * (drop - R * taken_by_all(sim, s) / s->h),
                       .by_voltage = -scale * (end + R * beside / s->h),
                       .by_taken = -scale * R / s->h,
                       .resolved = 1 / (1 + x)};
}

static ZpSourceLaw has_current(const ZpSim *sim, const ZpSourceStep *s, double current) {
  return (ZpSourceLaw){.lacks = s->h * current - taken_by_all(sim, s),
                       .by_voltage = -parallel(sim, s->h),
                       .by_taken = -1,
                       .resolved = 1};
}

/* Would the charge that lacks raise a voltage without capacitance? The charge that the cap holds cannot grow. */
static bool is_undecided(const ZpSim *sim, const ZpSourceStep *s, double lacks) {
  return s->C + parallel(sim, s->h) < undecided && lacks * s->U1 > 0;
}

/* Of the laws "the voltage follows", "the current is the largest" and "the current is the smallest", all of which lack
 * less the higher U1 is, the middle one holds, eq. (23.3). */
static ZpFeedMode mode_of(const ZpSim *sim, const ZpSourceStep *s, double follows) {
  const ZpSupply *supply = &sim->model->supply;
  double taken = taken_by_all(sim, s), most = s->h * supply->most - taken, least = -s->h * supply->sinks - taken;
  ZpFeedMode mode = follows > most ? ZP_FEED_GIVES_MOST : follows < least ? ZP_FEED_SINKS_MOST : ZP_FEED_FREE;
  if (mode == ZP_FEED_FREE) return mode;
  return is_undecided(sim, s, mode == ZP_FEED_GIVES_MOST ? most : least) ? ZP_FEED_FREE : mode;
}

static ZpSourceLaw law(const void *self, const ZpSourceStep *s) {
  ZpSim *sim = (ZpSim *)self;
  const ZpSupply *supply = &sim->model->supply;
  ZpSourceLaw follows = follows_voltage(sim, s);
  sim->feed.mode = mode_of(sim, s, follows.lacks);
  if (sim->feed.mode == ZP_FEED_GIVES_MOST) return has_current(sim, s, supply->most);
  if (sim->feed.mode == ZP_FEED_SINKS_MOST) return has_current(sim, s, -supply->sinks);
  if (sim->state->supply_mode != ZP_FEED_FREE) follows.resolved = 1; /* where a limit ends, the rate has a corner */
  return follows;
}

void zp_feed_create(ZpSim *sim) {
  static const double usual = 1e3; /* V: scale where the waveform has none */
  double largest = zp_waveform_largest(&sim->model->waveform);
  sim->feed.scale = largest > 0 ? largest : usual;
  sim->feed.source = (ZpSource){.self = sim, .law = law, .scale = sim->feed.scale};
}

/* -- books ----------------------------------------------------------------------------------------- */

/* Work on the electrodes until now, including the part that is not yet in state->work; of one part. */
static double given(const ZpState *state, double charge) {
  return state->work + state->U * (charge - state->base_charge);
}

/* Energy that a jump of the voltage takes at once. The part that the electrodes do not keep is their charging loss, or
 * heat of the resistance. */
static void jump(ZpSim *sim, double V) {
  ZpState *state = sim->state;
  double parts = sim->model->parts, C = cable_of(sim), R = sim->model->supply.resistance, U0 = state->U;
  double charge0 = zp_system_electric_now(sim->model, state, U0, &sim->eval).charge, work0 = given(state, charge0);
  double loss0 = state->charging_loss;
  zp_sim_jump(sim, V);
  if (state->U != state->base_U) zp_sim_close_account(sim);
  double work = parts * (given(state, state->base_charge) - work0), lost = state->charging_loss - loss0;
  state->source_charge += parts * (state->base_charge - charge0) + C * (V - U0);
  state->source_energy += work + C * V * (V - U0);
  state->source_loss += 0.5 * C * (V - U0) * (V - U0);
  if (!(R > 0)) {
    sim->feed.peak = sim->feed.square = INFINITY;
    return;
  }
  state->work -= lost;
  state->charging_loss -= lost;
  state->source_loss += parts * lost;
  sim->feed.square += (parts * lost + 0.5 * C * (V - U0) * (V - U0)) / R;
  sim->feed.peak = fmax(sim->feed.peak, fabs(V - U0) / R);
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

/* Behind a resistance the current is largest at the start or the end of a step, A, or at its limit. */
static double current_at(const ZpSim *sim, const ZpState *state) {
  const ZpSupply *supply = &sim->model->supply;
  if (supply->resistance == 0) return 0;
  return fabs(fmin(fmax((state->supply.voltage - state->U) / supply->resistance, -supply->sinks), supply->most));
}

/* The books of a step, eqs. (23.6) and (23.7). */
static void book(ZpSim *sim) {
  ZpState *state = sim->state;
  const ZpState *before = sim->before;
  const ZpDynamics *d = &sim->dynamics;
  double h = state->t - before->t, charge = charge_given(sim), U = 0.5 * (before->U + state->U);
  double electrodes = sim->model->parts * (given(state, d->charge1) - given(before, d->charge0));
  double bled = h * sim->model->supply.conductance * U * U;
  double taken = electrodes + cable_of(sim) * U * (state->U - before->U) + bled;
  bool ideal = state->supply_mode == ZP_FEED_FREE && sim->model->supply.resistance == 0;
  double energy = ideal ? taken : 0.5 * (before->supply.voltage + state->supply.voltage) * charge;
  state->source_charge += charge;
  state->source_energy += energy;
  state->source_loss += energy - taken;
  state->bleeder_loss += bled;
  zp_feed_note_current(sim, charge / h, h);
  sim->feed.peak = fmax(sim->feed.peak, fmax(current_at(sim, before), current_at(sim, state)));
}

/* -- a step ---------------------------------------------------------------------------------------- */

/* Capacitance of electrodes and cable while they charge towards the inner voltage. */
static double capacitance_now(ZpSim *sim) {
  const ZpState *state = sim->state;
  double V = state->supply.voltage, now = zp_system_electric_now(sim->model, state, state->U, &sim->eval).charge,
         then = zp_system_electric_now(sim->model, state, V, &sim->eval).charge;
  return cable_of(sim) + sim->model->parts * (then - now) / (V - state->U);
}

/* A jump of the command that no limit of the current holds back, through a resistance too small to last. */
void zp_feed_arrive(ZpSim *sim) {
  ZpCommand command = command_of(sim);
  const ZpSupply *supply = &sim->model->supply;
  ZpState *state = sim->state;
  state->supply = zp_supply_jump(supply, &command, state->t, state->supply);
  double left = state->supply.voltage - state->U, limit = left > 0 ? supply->most : supply->sinks;
  if (fabs(left) <= past_limit * sim->feed.scale || supply->resistance * limit < fabs(left)) return;
  if (supply->resistance * capacitance_now(sim) < instant) jump(sim, state->supply.voltage);
}

void zp_feed_begin(ZpSim *sim) {
  memcpy(sim->before, sim->state, zp_state_size(sim->model));
}

void zp_feed_end(ZpSim *sim) {
  sim->state->supply = followed(sim, sim->before, sim->state->t);
  sim->state->supply_mode = sim->feed.mode;
  book(sim);
}

bool zp_feed_step(ZpSim *sim, double latest) {
  ZpState *state = sim->state;
  if (latest - state->t < shortest) {
    state->supply = followed(sim, state, latest);
    state->t = latest;
    return true;
  }
  zp_feed_begin(sim);
  if (!(zp_dynamics_step(&sim->dynamics, &state, latest) > 0)) return false;
  zp_feed_end(sim);
  return true;
}

/* -- what came of it ------------------------------------------------------------------------------- */

ZpCurrents zp_sim_currents(ZpSim *sim, double duration) {
  bool jumped = isinf(sim->feed.peak) || zp_sim_get(sim, "charging_loss") > 0;
  if (jumped || !(duration > 0)) return (ZpCurrents){NAN, NAN};
  return (ZpCurrents){sim->feed.peak, sqrt(sim->feed.square / duration)};
}
