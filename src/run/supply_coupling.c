/* The supply at the electrodes of a port, of which `sim` is the first member. docs/theory.md, section 23. Its inner
 * voltage V follows from the command alone (drive/supply.c), so its events are corners in time. A limit of the current
 * depends on what the electrodes take: it is part of the step's equations. */
#include "run/supply_coupling.h"

#include <math.h>

#include "math/elementary.h"
#include "run/run.h"

static const double least_capacitance = 1e-15; /* F: a capped charge has none, and a law needs a scale */
static const double undecided = 1e-13;         /* F: with less, charge that cannot leave would raise any voltage */
static const double past_limit = 1e-6;         /* of the scale: a limit is passed */
static const double instant = 1e-8;            /* s: what voltages do in less time happens at once, */
static const double mechanical = 1e-3;         /* and in less than this it hardly moves an actuator */

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
  double t = sim->state->t, latest = zp_sim_first(sim)->dynamics.latest;
  return followed(sim, sim->state, h == latest - t ? latest : t + h).voltage;
}

double zp_supply_coupling_event(const ZpSim *sim, double latest) {
  ZpCommand command = command_of(sim);
  return zp_supply_event(&sim->model->supply, &command, sim->state->t, latest, sim->state->supply);
}

double zp_supply_coupling_resolution(const ZpSim *sim, double least) {
  ZpCommand command = command_of(sim);
  const ZpState *state = sim->state;
  double V = state->supply.voltage, rate = zp_supply_rate(&sim->model->supply, &command, state->t, state->supply);
  double inner = zp_ramp_resolution(fmax(least, fabs(V)), rate);
  double outer = zp_ramp_resolution(fmax(least, fabs(state->U)), state->U_rate);
  return fmax(fmin(inner, outer), instant); /* U_rate may be that of a jump in the last step */
}

/* -- the law of the current ------------------------------------------------------------------------ */

double zp_supply_coupling_cable_energy(const ZpSim *sim, double U) {
  return 0.5 * sim->model->supply.capacitance * U * U;
}

/* Share of an error of the voltage that lasts so long, s, in what it does to the motion. */
static double share_of(double lasts) {
  return fmax(lasts - instant, 0) / (lasts + mechanical);
}

/* A step behind the resistance R and beside the bleeder. The voltages V - U over the one and U over the other have the
 * weights `end` and `bleeds` at the step's end: a constant capacitance then charges, or discharges, exactly, whatever
 * the step, eq. (23.5). */
typedef struct Drop {
  double tau;       /* R C, s */
  double end;       /* theta */
  double bleeds;    /* that of the bleeder */
  double start, V1; /* V - U at the start; V at the end, V */
} Drop;

/* Weight of a decay within tau at the end of a step. */
static double weight_of(double h, double tau) {
  return zp_decay_weight(tau > 0 ? h / tau : INFINITY);
}

static Drop drop_over(const ZpSim *sim, const ZpSourceStep *s) {
  const ZpSupply *supply = &sim->model->supply;
  double C = s->C + supply->capacitance, tau = supply->resistance * C;
  double slope = zp_supply_bled_slope(supply, s->U0), bleeds = slope > 0 ? weight_of(s->h, C / slope) : 0.5;
  return (Drop){tau, weight_of(s->h, tau), bleeds, sim->state->supply.voltage - s->U0, inner_after(sim, s->h)};
}

/* Mean voltage at the bleeder if the voltage ends at U, V. */
static double bleeds_at(const ZpSourceStep *s, const Drop *drop, double U) {
  return (1 - drop->bleeds) * s->U0 + drop->bleeds * U;
}

/* A cable and a bleeder are parallel to the electrodes: the charge that all take over a step, C, if the voltage ends at
 * U; its derivative by the voltage beside that of the electrodes, F. */
static double taken_by_all(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop, double electrodes,
                           double U) {
  double bled = s->h * zp_supply_bled(supply, bleeds_at(s, drop, U));
  return electrodes + supply->capacitance * (U - s->U0) + bled;
}

static double parallel(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop) {
  return supply->capacitance + drop->bleeds * s->h * zp_supply_bled_slope(supply, bleeds_at(s, drop, s->U1));
}

/* The law without limits of the current: the mean of V - U is R I. As a charge that falls with U1 like that of the
 * electrodes. */
static ZpSourceLaw follows_voltage(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop) {
  double R = supply->resistance, beside = parallel(supply, s, drop), C = fmax(s->C + beside, least_capacitance);
  double scale = C / (drop->end + R * C / s->h), taken = taken_by_all(supply, s, drop, s->taken, s->U1);
  double mean = (1 - drop->end) * drop->start + drop->end * (drop->V1 - s->U1);
  return (ZpSourceLaw){.lacks = scale * (mean - R * taken / s->h),
                       .by_voltage = -scale * (drop->end + R * beside / s->h),
                       .by_taken = -scale * R / s->h,
                       .bound = NAN,
                       .resolved = share_of(drop->tau * drop->tau / (drop->tau + s->h))};
}

/* The voltage that a mean current leaves behind the resistance at the end, V. */
static double behind(const ZpSupply *supply, const Drop *drop, double current) {
  return drop->V1 - (supply->resistance * current - (1 - drop->end) * drop->start) / drop->end;
}

/* Charge that a current brings over the step less the charge taken if the voltage ends at U, C. */
static double left_at(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop, double current, double U) {
  return s->h * current - taken_by_all(supply, s, drop, s->taken_at(s->electrodes, U), U);
}

/* Charge that a current brings over the step less the charge taken if the voltage ends where the current leaves it, C.
 */
static double left_by(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop, double current) {
  return left_at(supply, s, drop, current, behind(supply, drop, current));
}

/* Full faces: the cap holds their whole charge, which is the same at all voltages beyond some one. */
typedef struct Full {
  double far;    /* V: a voltage at which faces are full if they ever are, that the current would lower */
  double charge; /* taken there, C */
  double apart;  /* from there to the opposite voltage, C */
} Full;

static Full full_for(const ZpSim *sim, const ZpSourceStep *s, double current) {
  static const double far = 1e3; /* times the scale */
  Full full = {.far = -copysign(far * sim->feed.scale, current)};
  full.charge = s->taken_at(s->electrodes, full.far);
  full.apart = fabs(full.charge - s->taken_at(s->electrodes, -full.far));
  return full;
}

static bool is_full(const ZpSourceStep *s, const Full *full, double U) {
  static const double rounding = 1e-9;
  return fabs(full->charge - s->taken_at(s->electrodes, U)) <= rounding * full->apart;
}

/* Is the charge that a current leaves, exactly or almost, more than faces can hold? */
static bool is_too_much(const Full *full, double left) {
  static const double rounding = 1e-14;
  return left * copysign(1, full->far) >= -rounding * full->apart;
}

/* The least voltage at which faces are full, from that of the step's start on. */
static double full_from(const ZpSourceStep *s, const Full *full) {
  enum { HALVINGS = 60 };
  double least = s->U0, most = full->far;
  if (is_full(s, full, least)) return least;
  for (int k = 0; k < HALVINGS; k++) {
    double middle = 0.5 * (least + most);
    if (is_full(s, full, middle))
      most = middle;
    else
      least = middle;
  }
  return most;
}

/* The limit that acts in a step, if one does. */
typedef struct Limit {
  ZpSupplyMode mode;
  double current; /* A */
  double voltage; /* of faces that spill charge, V */
} Limit;

/* A current at its limit. The charge that faces can hold at most may fall faster, as they move, than the current takes
 * it. Without a capacitance beside them this charge would raise any voltage. So the breakdown takes it and the voltage
 * stays; or it follows, if faces are full at the voltage that follows, too. */
static Limit limit_of(const ZpSim *sim, const ZpSourceStep *s, const Drop *drop, double current, ZpSupplyMode mode) {
  const ZpSupply *supply = &sim->model->supply;
  Limit limit = {.mode = mode, .current = current};
  if (supply->capacitance >= undecided) return limit;
  Full full = full_for(sim, s, current);
  if (!is_too_much(&full, s->h * current - full.charge)) return limit;
  limit.voltage = full_from(s, &full);
  if (!is_too_much(&full, left_at(supply, s, drop, current, limit.voltage))) return limit;
  limit.mode = is_full(s, &full, behind(supply, drop, current)) ? ZP_SUPPLY_FREE : ZP_SUPPLY_SPILLS;
  return limit;
}

/* Charges grow with the voltage. So the current is the largest if the electrodes take more at the voltage that it
 * leaves, and the smallest if they take less; otherwise the voltage follows, eq. (23.3). */
static Limit limit_over(const ZpSim *sim, const ZpSourceStep *s, const Drop *drop) {
  const ZpSupply *supply = &sim->model->supply;
  if (isfinite(supply->most) && left_by(supply, s, drop, supply->most) < 0)
    return limit_of(sim, s, drop, supply->most, ZP_SUPPLY_GIVES_MOST);
  if (isfinite(supply->sinks) && left_by(supply, s, drop, -supply->sinks) > 0)
    return limit_of(sim, s, drop, -supply->sinks, ZP_SUPPLY_SINKS_MOST);
  return (Limit){.mode = ZP_SUPPLY_FREE};
}

/* The charge is exact: errors are those of the voltage's path within the step. */
static ZpSourceLaw has_current(const ZpSupply *supply, const ZpSourceStep *s, const Drop *drop, double current) {
  return (ZpSourceLaw){.lacks = s->h * current - taken_by_all(supply, s, drop, s->taken, s->U1),
                       .by_voltage = -parallel(supply, s, drop),
                       .by_taken = -1,
                       .bound = behind(supply, drop, current),
                       .resolved = share_of(s->h)};
}

/* The voltage stays. The law is that of a charge, as the others are. */
static ZpSourceLaw has_voltage(const ZpSourceStep *s, double voltage) {
  double C = fmax(s->C, least_capacitance);
  return (ZpSourceLaw){.lacks = C * (voltage - s->U1), .by_voltage = -C, .bound = NAN, .resolved = share_of(s->h)};
}

static ZpSourceLaw law(void *self, const ZpSourceStep *s) {
  ZpSim *sim = self;
  const ZpSupply *supply = &sim->model->supply;
  Drop drop = drop_over(sim, s);
  Limit limit = limit_over(sim, s, &drop);
  sim->feed.mode = limit.mode;
  sim->feed.bleeds = drop.bleeds;
  if (limit.mode == ZP_SUPPLY_SPILLS) return has_voltage(s, limit.voltage);
  if (limit.mode != ZP_SUPPLY_FREE) return has_current(supply, s, &drop, limit.current);
  ZpSourceLaw follows = follows_voltage(supply, s, &drop);
  bool corner = sim->state->supply_mode != ZP_SUPPLY_FREE; /* where a limit ends */
  if (corner) follows.resolved = fmax(follows.resolved, share_of(s->h));
  return follows;
}

void zp_supply_coupling_create(ZpSim *sim) {
  static const double usual = 1e3; /* V: scale where the waveform has none */
  double largest = zp_waveform_largest(&sim->model->waveform);
  sim->feed.scale = largest > 0 ? largest : usual;
  sim->feed.source = (ZpSource){.self = sim, .law = law, .scale = sim->feed.scale};
}

/* -- books ----------------------------------------------------------------------------------------- */

static double *lost_in_source(ZpSim *sim) {
  return zp_state_row(sim->model, sim->state, &zp_row_source_loss);
}

/* Work on the electrodes until now, including the part that is not yet in state->work; of one part. */
static double given(const ZpState *state, double charge) {
  return state->work + state->U * (charge - state->base_charge);
}

/* A jump of voltages of all members: charge from the supply, C; its work, and the part of it that the electrodes do not
 * keep, J. */
typedef struct Jump {
  double charge, work, lost;
} Jump;

/* The voltage of one member jumps, unless it is constant. If the part that its electrodes do not keep is `heat`, it is
 * that of the source, else their charging loss. */
static void jump_one(ZpSim *m, double U, bool heat, Jump *jump) {
  ZpState *state = m->state;
  if (U == state->U) return;
  double charge0 = zp_system_electric_now(m->model, state, state->U, &m->eval).charge, work0 = given(state, charge0);
  double *charging = zp_state_row(m->model, state, &zp_row_charging_loss), loss0 = *charging;
  zp_sim_jump(m, U);
  if (state->U != state->base_U) zp_sim_close_balance(m);
  double lost = *charging - loss0;
  jump->charge += zp_source_share(m->model) * (state->base_charge - charge0);
  jump->work += m->model->parts * (given(state, state->base_charge) - work0);
  jump->lost += m->model->parts * lost;
  if (!heat) return;
  state->work -= lost;
  *charging -= lost;
}

void zp_supply_coupling_start(ZpSim *sim) {
  Jump all = {0};
  for (size_t k = 0, next = 1; next > 0; next = zp_sim_next(sim + k), k += next)
    jump_one(sim + k, zp_voltage_at_port(sim[k].model, 0), false, &all);
  sim->state->source_energy += all.work;
}

/* To the inner voltage of the supply. */
static void jump(ZpSim *sim, double V) {
  ZpState *state = sim->state;
  double C = sim->model->supply.capacitance, R = sim->model->supply.resistance, rise = V - state->U;
  Jump all = {0};
  for (size_t k = 0, next = 1; next > 0; next = zp_sim_next(sim + k), k += next)
    jump_one(sim + k, zp_voltage_at_port(sim[k].model, V), R > 0, &all);
  state->source_charge += all.charge + C * rise;
  state->source_energy += all.work + C * V * rise;
  *lost_in_source(sim) += 0.5 * C * rise * rise;
  if (!(R > 0)) {
    sim->feed.peak = sim->feed.square = INFINITY;
    return;
  }
  *lost_in_source(sim) += all.lost;
  sim->feed.square += (all.lost + 0.5 * C * rise * rise) / R;
  sim->feed.peak = fmax(sim->feed.peak, fabs(rise) / R);
}

void zp_supply_coupling_renew(ZpSim *m, double before) {
  ZpSim *sim = zp_sim_lead(m);
  ZpState *state = sim->state;
  double change = zp_system_electric_now(m->model, m->state, m->state->U, &m->eval).charge - before;
  double charge = zp_source_share(m->model) * change, V = state->supply.voltage;
  state->source_charge += charge;
  state->source_energy += V * charge + zp_beside_port(m->model) * m->model->parts * change;
  *lost_in_source(sim) += (V - state->U) * charge;
}

/* Mean voltage at the bleeder over the last step, V. */
static double at_bleeder(const ZpSim *sim) {
  return sim->before->U + sim->feed.bleeds * (sim->state->U - sim->before->U);
}

static const ZpMovingMember *moved_of(const ZpSim *m) {
  return zp_sim_first(m)->dynamics.member + m->model->number;
}

/* Charge that one part of a member has taken over the last step, C. */
static double taken_by(const ZpSim *m) {
  const ZpMovingMember *moved = moved_of(m);
  return moved->charge1 - moved->charge0 + (m->state->leaked - m->before->leaked);
}

/* Charge that the supply has delivered over the last step, C. */
static double charge_given(const ZpSim *sim) {
  const ZpState *state = sim->state, *before = sim->before;
  const ZpSupply *supply = &sim->model->supply;
  double h = state->t - before->t, taken = 0;
  for (size_t k = 0, next = 1; next > 0; next = zp_sim_next(sim + k), k += next)
    taken += zp_source_share(sim[k].model) * taken_by(sim + k);
  double bled = h * zp_supply_bled(supply, at_bleeder(sim));
  double given = taken + supply->capacitance * (state->U - before->U) + bled;
  return state->supply_mode == ZP_SUPPLY_SPILLS ? fmin(fmax(given, -supply->sinks * h), supply->most * h) : given;
}

void zp_supply_coupling_note_current(ZpSim *sim, double current, double h) {
  sim->feed.square += current * current * h;
  sim->feed.peak = fmax(sim->feed.peak, fabs(current));
}

/* Current where the supply and the actuator have a state, A: behind a resistance that of the drop over it, within the
 * limits; without one the mean of the step. */
static double current_at(const ZpSim *sim, const ZpState *state, double mean) {
  const ZpSupply *supply = &sim->model->supply;
  if (supply->resistance == 0) return mean;
  return fmin(fmax((state->supply.voltage - state->U) / supply->resistance, -supply->sinks), supply->most);
}

/* Behind a resistance the current is largest at the start or the end of a step, or at its limit. */
static void note_currents(ZpSim *sim, double mean, double h) {
  ZpSupplyCoupling *feed = &sim->feed;
  feed->current[ZP_CURRENT_MEAN] = mean;
  feed->current[ZP_CURRENT_AT_START] = current_at(sim, sim->before, mean);
  feed->current[ZP_CURRENT_AT_END] = current_at(sim, sim->state, mean);
  feed->largest = ZP_SUPPLY_CURRENTS;
  feed->square += mean * mean * h;
  for (int k = 0; k < ZP_SUPPLY_CURRENTS; k++)
    if (fabs(feed->current[k]) > feed->peak) feed->peak = fabs(feed->current[k]), feed->largest = k;
}

/* The books of a step, eqs. (23.6) and (23.7). */
static void book(ZpSim *sim) {
  ZpState *state = sim->state;
  const ZpState *before = sim->before;
  const double h = state->t - before->t, charge = charge_given(sim), U = 0.5 * (before->U + state->U);
  double electrodes = 0, biased = 0; /* work on those of all; the part of it of constant sources of members */
  for (size_t k = 0, next = 1; next > 0; next = zp_sim_next(sim + k), k += next) {
    const ZpSim *m = sim + k;
    const ZpMovingMember *moved = moved_of(m);
    electrodes += m->model->parts * (given(m->state, moved->charge1) - given(m->before, moved->charge0));
    biased += zp_beside_port(m->model) * m->model->parts * taken_by(m);
  }
  double bled = h * zp_supply_bled(&sim->model->supply, at_bleeder(sim)) * at_bleeder(sim);
  double taken = electrodes + sim->model->supply.capacitance * U * (state->U - before->U) + bled;
  bool ideal = state->supply_mode == ZP_SUPPLY_FREE && sim->model->supply.resistance == 0;
  double energy = ideal ? taken : 0.5 * (before->supply.voltage + state->supply.voltage) * charge + biased;
  state->source_charge += charge;
  state->source_energy += energy;
  *lost_in_source(sim) += energy - taken;
  *zp_state_row(sim->model, state, &zp_row_bleeder_loss) += bled;
  note_currents(sim, charge / h, h);
}

/* -- a step ---------------------------------------------------------------------------------------- */

/* Capacitance of electrodes and cable while they charge towards the inner voltage. */
static double capacitance_now(ZpSim *sim) {
  double V = sim->state->supply.voltage, taken = 0;
  for (size_t k = 0, next = 1; next > 0; next = zp_sim_next(sim + k), k += next) {
    ZpSim *m = sim + k;
    double U = zp_voltage_at_port(m->model, V), now = m->state->U;
    taken += zp_source_share(m->model) * (zp_system_electric_now(m->model, m->state, U, &m->eval).charge -
                                          zp_system_electric_now(m->model, m->state, now, &m->eval).charge);
  }
  return sim->model->supply.capacitance + taken / (V - sim->state->U);
}

/* A jump of the command that no limit of the current holds back, through a resistance too small to last. */
static void arrive(ZpSim *sim) {
  ZpCommand command = command_of(sim);
  const ZpSupply *supply = &sim->model->supply;
  ZpState *state = sim->state;
  state->supply = zp_supply_jump(supply, &command, state->t, state->supply);
  double left = state->supply.voltage - state->U, limit = left > 0 ? supply->most : supply->sinks;
  if (fabs(left) <= past_limit * sim->feed.scale || supply->resistance * limit < fabs(left)) return;
  if (supply->resistance * capacitance_now(sim) < instant) jump(sim, state->supply.voltage);
}

static void end(ZpSim *sim) {
  sim->state->supply = followed(sim, sim->before, sim->state->t);
  sim->state->supply_mode = sim->feed.mode;
  book(sim);
}

/* -- of all ports ---------------------------------------------------------------------------------- */

void zp_supply_coupling_arrive(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_sim_has_supply(m)) arrive(m);
}

ZpSupplyEvent zp_supply_coupling_next(const ZpSim *sim, double latest) {
  ZpSupplyEvent next = {0, INFINITY};
  for (size_t k = 0; k < sim->members; k++) {
    const double t = zp_sim_has_supply(sim + k) ? zp_supply_coupling_event(sim + k, latest) : INFINITY;
    if (t < next.t) next = (ZpSupplyEvent){k, t};
  }
  return next;
}

void zp_supply_coupling_end(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_sim_has_supply(m)) end(m);
}

/* Only time advances. */
static void stay(ZpSim *sim, double latest) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_sim_has_supply(m)) m->state->supply = followed(m, m->state, latest);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    m->state->t = latest;
}

bool zp_supply_coupling_step(ZpSim *sim, double latest) {
  if (latest - sim->state->t < ZP_SUPPLY_SHORTEST) {
    stay(sim, latest);
    return true;
  }
  if (!(zp_dynamics_step(&sim->dynamics, sim->states, latest) > 0)) return false;
  zp_supply_coupling_end(sim);
  return true;
}

/* -- what came of it ------------------------------------------------------------------------------- */

ZpCurrents zp_sim_currents(ZpSim *sim, double duration) {
  bool apart = sim->fed > 1; /* currents of several sources have no common peak */
  for (ZpSim *m = sim; m < sim + sim->members && sim->fed > 0; m++)
    apart |= !zp_sim_is_fed(m);
  bool jumped = isinf(sim->feed.peak) || (sim->fed == 0 && zp_sim_get(sim, "charging_loss") > 0);
  if (apart || jumped || !(duration > 0)) return (ZpCurrents){NAN, NAN};
  return (ZpCurrents){sim->feed.peak, sqrt(sim->feed.square / duration)};
}
