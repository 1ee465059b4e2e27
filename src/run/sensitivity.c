#include "run/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "rest/rest.h"
#include "rest/sensitivity.h"
#include "run/snapshot.h"

/* Steps of a key, as a part of it. They are so small that the first touch of two faces, where (9.6) has a corner, is
 * hardly ever between the points of a difference, but they are above rounding. In the plane the rounding of positions
 * stretches ribbons, whose forces then push bodies along the ways in which these are free. */
static double part_of(const ZpModel *first) {
  return first->network->plane ? 1e-6 : 1e-7;
}

/* -- where the runs begin ---------------------------------------------------------------------------- */

static double opening_of(ZpStatics *s, void *which) {
  const ZpRestMember *m = &s->member[*(const size_t *)which];
  return zp_last_gap(m->model, zp_nodes(m->model, m->q).y);
}

/* Derivative of the hanging equilibrium by a key => rate [members], of coordinates, opening0 and bodies. */
static ZpStatus rate_of_hanging(ZpRest *rest, int key, ZpState *const rate[], ZpError *err) {
  const ZpModel *first = rest->statics.model;
  ZpRestSensitivity slope;
  ZpStatus status = zp_rest_sensitivity_open(&slope, &rest->statics, key, err);
  const bool found = status == ZP_OK && zp_rest_sensitivity_solve(&slope, ZP_SETS_LOAD);
  for (size_t which = 0; found && which < first->members; which++) {
    const ZpModel *model = first + which;
    memcpy(zp_state_q(model, rate[which]), zp_rest_sensitivity_member(&slope, which),
           zp_coordinates(model) * sizeof *slope.rate);
    rate[which]->opening0 = model->field ? zp_rest_sensitivity_of(&slope, opening_of, &which) : 0;
  }
  if (found && first->network->plane)
    memcpy(zp_state_bodies(first, rate[0]), zp_rest_sensitivity_bodies(&slope),
           first->network->unknowns * sizeof *slope.by_key);
  zp_rest_sensitivity_close(&slope);
  return status;
}

static ZpStatus create_near(ZpRunSensitivity *rates, ZpKeyRates *of, ZpError *err) {
  for (int k = 0; k < of->by.count; k++) {
    of->near[k] = zp_sim_create_near(rates->sim, of->by.near[k].model, of->rate, of->by.near[k].offset);
    if (!of->near[k]) return zp_fail_memory(err);
    of->near[k]->dynamics.lead = &rates->sim->dynamics;
  }
  return ZP_OK;
}

/* Of the state of one member, in which the neighbours are now. */
static void take_rate_of(const ZpSim *sim, const ZpKeyRates *of, size_t which) {
  const ZpSim *m = sim + which;
  memset(of->rate[which], 0, zp_state_size(m->model));
  for (int k = 0; k < of->by.count; k++)
    zp_state_add_rate(m->model, m->state, of->near[k][which].state, of->by.near[k].weight, of->rate[which]);
}

static void take_rate(const ZpRunSensitivity *rates, const ZpKeyRates *of) {
  for (size_t which = 0; which < rates->sim->members; which++)
    take_rate_of(rates->sim, of, which);
}

static bool allocate_key(const ZpSim *sim, ZpKeyRates *of) {
  of->rate = zp_calloc(sim->members, sizeof(ZpState *));
  bool made = of->rate != NULL;
  for (size_t which = 0; which < sim->members && made; which++)
    made = (of->rate[which] = zp_calloc(1, zp_state_size(sim[which].model))) != NULL;
  return made;
}

static ZpStatus open_key(ZpRunSensitivity *rates, ZpRest *rest, int key, ZpKeyRates *of, ZpError *err) {
  const ZpModel *model = rates->sim->model;
  bool hangs = model->field || model->def.initial.state == ZP_INITIAL_EQUILIBRIUM;
  of->lost = INFINITY;
  of->last[0].t = of->last[1].t = NAN;
  if (!allocate_key(rates->sim, of)) return zp_fail_memory(err);
  ZpStatus status = zp_finite_difference_open(&of->by, model, key, part_of(model), err);
  if (status == ZP_OK && hangs) status = rate_of_hanging(rest, key, of->rate, err);
  if (status == ZP_OK) status = create_near(rates, of, err);
  if (status == ZP_OK) take_rate(rates, of);
  return status;
}

static bool allocate(ZpRunSensitivity *rates) {
  const ZpSim *sim = rates->sim;
  size_t n = sim->dynamics.system.n;
  rates->key = zp_calloc(rates->keys, sizeof *rates->key);
  rates->wet = zp_calloc(sim->members * sim->model->nodes, sizeof *rates->wet);
  rates->work = zp_calloc(7 * n, sizeof *rates->work);
  rates->motion = rates->work + 6 * n;
  return rates->key && rates->wet && rates->work;
}

ZpStatus zp_run_sensitivity_open(ZpRunSensitivity *rates, ZpSim *sim, const int *key, size_t keys, ZpError *err) {
  *rates = (ZpRunSensitivity){.sim = sim, .keys = keys};
  ZpRest rest;
  bool opened = zp_rest_open(&rest, sim->model, NULL, NULL);
  ZpStatus status = opened && allocate(rates) ? ZP_OK : zp_fail_memory(err);
  if (status == ZP_OK) zp_statics_find_rest(&rest.statics);
  for (size_t k = 0; k < keys && status == ZP_OK; k++)
    status = open_key(rates, &rest, key[k], &rates->key[k], err);
  zp_rest_close(&rest);
  if (status == ZP_OK) sim->rates = rates;
  return status;
}

static void close_key(const ZpSim *sim, ZpKeyRates *of) {
  for (int k = 0; k < of->by.count; k++)
    zp_sim_destroy(of->near[k]);
  zp_finite_difference_close(&of->by);
  for (size_t which = 0; of->rate && which < sim->members; which++)
    zp_free(of->rate[which]);
  zp_free(of->rate);
}

void zp_run_sensitivity_close(ZpRunSensitivity *rates) {
  for (size_t j = 0; rates->key && j < rates->keys; j++)
    close_key(rates->sim, &rates->key[j]);
  zp_free(rates->key);
  zp_free(rates->wet);
  zp_free(rates->work);
  rates->sim->rates = NULL;
}

/* -- a step begins ----------------------------------------------------------------------------------- */

/* Between two corners steps end at the same share of the interval, so steps also end at corners that a key moves. At
 * the end of the run, also if it is a corner, all end at once. */
static double time_of(const ZpRunSensitivity *rates, const ZpKeyRates *of, int k, double t) {
  double share = (t - rates->from) / (rates->to - rates->from);
  return t == rates->to ? of->to[k] : of->from[k] + share * (of->to[k] - of->from[k]);
}

/* The end of the run is one of its inputs. */
static ZpCorner corner_of(ZpSim *sim, double end_time) {
  const ZpCorner corner = zp_sim_next_corner(sim);
  return corner.t < end_time ? corner : (ZpCorner){end_time, 1};
}

/* An ideal source gives a neighbour exactly the voltage of its own waveform or controller: a rounding would be a jump,
 * at which the account of the work closes. Neighbours' accounts close where the run's does. */
static void set_voltage(const ZpSim *sim, ZpSim *near) {
  if (zp_sim_is_fed(sim)) return;
  near->state->U = zp_sim_voltage_now(near);
  if (sim->state->U == sim->state->base_U) near->state->base_U = near->state->U;
}

static void begin_near(const ZpRunSensitivity *rates, const ZpKeyRates *of, int k) {
  const ZpSim *sim = rates->sim;
  ZpSim *near = of->near[k];
  double t = time_of(rates, of, k, sim->state->t);
  for (size_t which = 0; which < sim->members; which++) {
    zp_state_along(sim[which].model, sim[which].state, of->rate[which], of->by.near[k].offset, near[which].state);
    near[which].state->t = t;
    set_voltage(sim + which, near + which);
  }
  zp_sim_control(near);
  if (t >= zp_sim_load_due(near)) zp_sim_change_load(near);
  zp_supply_coupling_arrive(near);
  zp_sim_keep_states(near);
}

void zp_run_sensitivity_begin(ZpRunSensitivity *rates) {
  rates->taken = rates->sim->dynamics.stepper.counts.steps;
  for (ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    for (int k = 0; k < of->by.count && !isfinite(of->lost); k++)
      begin_near(rates, of, k);
}

/* Of several inputs that have the next corner together a key may move some, and then in a neighbour these are before or
 * behind the others. */
static void begin_interval(ZpKeyRates *of, ZpCorner corner, double end_time) {
  of->splits = false;
  for (int k = 0; k < of->by.count; k++) {
    const ZpCorner own = corner_of(of->near[k], end_time);
    of->from[k] = of->near[k]->state->t;
    of->to[k] = corner.t < end_time ? own.t : end_time;
    of->splits |= corner.t < end_time && own.inputs != corner.inputs;
  }
}

void zp_run_sensitivity_look_ahead(ZpRunSensitivity *rates, double end_time) {
  ZpSim *sim = rates->sim;
  if (sim->state->t < rates->to) return;
  const ZpCorner corner = corner_of(sim, end_time);
  for (ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    if (!isfinite(of->lost)) begin_interval(of, corner, end_time);
  rates->from = sim->state->t;
  rates->to = corner.t;
}

/* -- and ends ---------------------------------------------------------------------------------------- */

static void lose(const ZpRunSensitivity *rates, ZpKeyRates *of, const char *cause) {
  of->lost = rates->sim->before->t;
  of->cause = cause;
}

/* Has the bead of a member covered a station in this step that it did not cover in the step before, or the reverse? */
static bool meniscus_passes(const ZpMovingMember *m, bool *wet) {
  bool passes = false;
  for (size_t i = 1; i < m->model->nodes && m->model->has_bead; i++) {
    const bool covers = zp_film_covers(&m->model->film, &m->eval.film, i);
    passes |= covers != wet[i];
    wet[i] = covers;
  }
  return passes;
}

static bool any_meniscus_passes(ZpRunSensitivity *rates) {
  const ZpDynamics *d = &rates->sim->dynamics;
  const bool has_begun = rates->sim->before->t > 0;
  bool passes = false;
  for (size_t k = 0; k < d->members; k++)
    passes |= meniscus_passes(&d->member[k], rates->wet + k * d->member->model->nodes);
  return passes && has_begun;
}

/* Has a limit of the current begun or ended at any port? */
static bool any_mode_changes(const ZpSim *sim) {
  bool changes = false;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    changes |= m->state->supply_mode != m->before->supply_mode;
  return changes;
}

/* Does the run end at the end of this step, although its state ended it before? */
static bool ends_late(const ZpSim *sim) {
  return sim->landing == ZP_LANDS_NOWHERE && zp_sim_stops(sim, sim->stop);
}

/* An event in the run's step that has no derivative. What a meniscus leaves at a station that it passes, and how long a
 * supply is at its limit, depend on when within the step it happens. NULL: none. */
static const char *cause_of_loss(ZpRunSensitivity *rates) {
  if (any_mode_changes(rates->sim)) return "a limit of the supply's current begins or ends";
  if (ends_late(rates->sim)) return "the run ends at the end of a step, not at the instant that ends it";
  return any_meniscus_passes(rates) ? "the meniscus of a bead passes a node; liquid.model none or submerged has them"
                                    : NULL;
}

/* An event that has no derivative by one key: a corner of several inputs of which it moves some. NULL: none. */
static const char *cause_of_key(const ZpRunSensitivity *rates, const ZpKeyRates *of) {
  return of->splits && rates->sim->state->t >= rates->to
             ? "the key moves one of several corners of inputs that coincide"
             : NULL;
}

/* Does the step's matrix filter velocities, because of faces or menisci? */
static bool takes_matrix(const ZpRunSensitivity *rates) {
  return rates->sim->model->has_bead || rates->sim->dynamics.filters;
}

/* Does the step end where a slew rate begins or ceases to limit a supply? */
static bool ends_at_event(const ZpRunSensitivity *rates) {
  return rates->sim->fed > 0 && rates->sim->state->t >= rates->event.t;
}

/* There the neighbours' steps end at their own events. */
static double end_near(const ZpRunSensitivity *rates, const ZpKeyRates *of, int k) {
  const ZpSim *near = of->near[k];
  double h = rates->sim->state->t - rates->sim->before->t;
  if (ends_at_event(rates)) return zp_supply_coupling_event(near + rates->event.lead, near->state->t + 2 * h);
  return time_of(rates, of, k, rates->sim->state->t) + of->by.near[k].offset * of->late;
}

/* The dynamics of all points of a key, from their present states to the end of the run's step. */
static bool move(ZpRunSensitivity *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  _Static_assert((int)ZP_DIFFERENCE_STEPS == (int)ZP_DIFFERENCE_POINTS, "one step per point");
  ZpDifferenceSteps steps = {.q1 = sim->dynamics.q, .lead = &sim->dynamics.history, .work = rates->work};
  for (int k = 0; k < of->by.count; k++) {
    ZpSim *near = of->near[k];
    double latest = end_near(rates, of, k);
    ZpDynamics *d = &near->dynamics;
    if (!isfinite(latest) || !zp_sim_prepare(near)) return false;
    zp_dynamics_begin(d, near->states, latest);
    steps.near[steps.count++] = (ZpDifferenceStep){
        &d->stepper, of->by.near[k].offset, of->by.near[k].weight, latest - near->state->t, d->q, d->v, &d->history};
  }
  return zp_implicit_follow(&steps, takes_matrix(rates), rates->motion);
}

static void arrive(ZpSim *near) {
  zp_dynamics_end(&near->dynamics, near->states);
  zp_supply_coupling_end(near);
  zp_sim_arrive(near);
}

/* When a neighbouring member closes, if that of the run closes in this step: where the neighbour's path of the same
 * step passes the limit, even outside the step. A front that arrives is detected only at the end of a step, which is
 * not the exact instant. `now` and `before` are of the run, at the end and the start of the step. */
static double closing_near(const ZpSim *sim, const ZpSim *near, double before, double now, double carried) {
  if (isnan(now)) return NAN;
  if (now == before) return carried;
  if (sim->landing == ZP_LANDS_CLOSED && now == zp_sim_zip_time(sim)) return near->state->t;
  return now < sim->state->t ? zp_sim_crossing(near) : NAN;
}

static void note_closing(const ZpSim *sim, size_t which, ZpSim *near) {
  const ZpState *now = sim[which].state, *before = sim[which].before, *start = near->before;
  ZpState *state = near->state;
  state->zip_time = closing_near(sim, near, before->zip_time, now->zip_time, start->zip_time);
  double closed = closing_near(sim, near, before->closed_from, now->closed_from, start->closed_from);
  if (now->closed_from != before->closed_from && !isnan(closed))
    zp_sim_close(near, (ZpOpeningAt){closed, zp_closed_opening(near->model, state->opening0)});
  state->closed_from = closed;
}

/* Nothing moves in so short a step. */
static void pass_time(ZpSim *near, double t) {
  for (ZpSim *m = near; m < near + near->members; m++)
    m->state->t = t;
}

/* Take the neighbours from the start of the run's step to its end. */
static bool follow_step(ZpRunSensitivity *rates, ZpKeyRates *of, bool moves) {
  for (int k = 0; k < of->by.count; k++)
    zp_sim_take_states_back(of->near[k]);
  if (moves && !move(rates, of)) return false;
  for (int k = 0; k < of->by.count; k++) {
    ZpSim *near = of->near[k];
    if (moves)
      arrive(near);
    else
      pass_time(near, end_near(rates, of, k));
    for (size_t which = 0; which < near->members; which++)
      note_closing(rates->sim, which, near + which);
  }
  take_rate(rates, of);
  return true;
}

/* Derivative of a number of the neighbours at the end of the step. */
static double rate_of(const ZpKeyRates *of, double (*number)(ZpSim *near, const void *user), const void *user) {
  double sum = 0;
  for (int k = 0; k < of->by.count; k++)
    sum += of->by.near[k].weight * number(of->near[k], user);
  return sum;
}

/* The end of a run, and the member that decides on it. */
typedef struct End {
  ZpLanding landing;
  size_t decides;
} End;

/* Until then. */
static double left_of(ZpSim *near, const void *end) {
  const End *e = end;
  return zp_sim_left_of(near + e->decides, e->landing);
}

static double length_of(ZpSim *near, const void *unused) {
  (void)unused;
  return near->state->t - near->before->t;
}

static double current_of(ZpSim *near, const void *which) {
  return near->feed.current[*(const int *)which];
}

/* The last step of a run that ends at an event, eq. (20.10): it ends where nothing is left in the neighbours, too. What
 * is left there is linear in the derivative of the end. */
static bool follow_landing(ZpRunSensitivity *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  const End end = {sim->landing, zp_sim_decides(sim, sim->landing)};
  if (!follow_step(rates, of, true)) return false;
  double first = rate_of(of, left_of, &end), trial = first * (sim->state->t - sim->before->t) / sim->left_before;
  if (first == 0) return true;
  of->late = trial;
  if (!follow_step(rates, of, true)) return false;
  of->late = trial * first / (first - rate_of(of, left_of, &end));
  return isfinite(of->late) && follow_step(rates, of, true);
}

/* (three currents, the largest in the middle) => the derivative at the vertex of the parabola through them. */
static double rate_at_vertex(ZpCurrentRate a, ZpCurrentRate b, ZpCurrentRate c) {
  double left = b.t - a.t, right = c.t - b.t, both = c.t - a.t;
  double bend = ((c.I - b.I) / right - (b.I - a.I) / left) / both, slope = (b.I - a.I) / left + bend * left;
  double bent = ((c.rate - b.rate) / right - (b.rate - a.rate) / left) / both,
         along = (b.rate - a.rate) / left + bent * left;
  double to = bend != 0 ? fmin(fmax(-0.5 * slope / bend, -left), right) : 0;
  return b.rate + (along + bent * to) * to;
}

/* Derivative of the peak. It is mostly at the end of a step, or without a resistance in the middle of one. At a corner
 * of the drive it stays there; otherwise the next step shows where between them it is. */
static void follow_peak(const ZpRunSensitivity *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  const ZpSupplyCoupling *feed = &sim->feed;
  const int which = sim->model->supply.resistance > 0 ? ZP_CURRENT_AT_END : ZP_CURRENT_MEAN;
  double start = sim->before->t, end = sim->state->t;
  ZpCurrentRate now = {which == ZP_CURRENT_MEAN ? 0.5 * (start + end) : end, feed->current[which],
                       rate_of(of, current_of, &which)};
  bool passed = of->at_peak && feed->largest == ZP_SUPPLY_CURRENTS && start != rates->from && !isnan(of->last[1].t);
  if (passed) of->peak = copysign(1, of->last[0].I) * rate_at_vertex(of->last[1], of->last[0], now);
  if (feed->largest < ZP_SUPPLY_CURRENTS)
    of->peak = copysign(1, feed->current[feed->largest]) * rate_of(of, current_of, &feed->largest);
  of->at_peak = feed->largest == which;
  of->last[1] = of->last[0];
  of->last[0] = now;
}

/* Derivatives of the square's integral and of the peak, from those of the currents of the run's step. A difference of
 * the neighbours' peaks would compare instants at which only one of them has a peak. */
static void follow_currents(const ZpRunSensitivity *rates, ZpKeyRates *of) {
  const int of_step = ZP_CURRENT_MEAN;
  double mean = rates->sim->feed.current[of_step], h = rates->sim->state->t - rates->sim->before->t;
  of->square += 2 * mean * rate_of(of, current_of, &of_step) * h + mean * mean * rate_of(of, length_of, NULL);
  follow_peak(rates, of);
}

static bool follow_key(ZpRunSensitivity *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  bool moves = sim->dynamics.stepper.counts.steps > rates->taken, lands = sim->landing != ZP_LANDS_NOWHERE;
  of->late = 0;
  if (lands ? !follow_landing(rates, of) : !follow_step(rates, of, moves)) return false;
  if (moves && zp_sim_is_fed(sim)) follow_currents(rates, of);
  return true;
}

/* From an event of the supply on, steps are shares of the time from there to the next corner. */
static void begin_at_event(ZpRunSensitivity *rates) {
  rates->from = rates->sim->state->t;
  for (ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    for (int k = 0; k < of->by.count; k++)
      of->from[k] = of->near[k]->state->t;
}

void zp_run_sensitivity_follow(ZpRunSensitivity *rates) {
  const char *cause = cause_of_loss(rates);
  for (size_t k = 0; k < rates->keys; k++) {
    ZpKeyRates *of = &rates->key[k];
    if (isfinite(of->lost)) continue;
    const char *own = cause ? cause : cause_of_key(rates, of);
    if (own)
      lose(rates, of, own);
    else if (!follow_key(rates, of))
      lose(rates, of, "the derivative of a step was not found");
  }
  if (ends_at_event(rates)) begin_at_event(rates);
}

double zp_run_rate_of(const ZpRunSensitivity *rates, size_t k, double (*number)(ZpSim *sim, const void *user),
                      const void *user) {
  return rate_of(&rates->key[k], number, user);
}

ZpCurrents zp_run_rate_of_currents(const ZpRunSensitivity *rates, size_t k) {
  const ZpKeyRates *of = &rates->key[k];
  double T = rates->sim->state->t;
  ZpCurrents now = zp_sim_currents(rates->sim, T);
  if (isnan(now.peak)) return now;
  double by_T = now.rms * now.rms * of->rate[0]->t;
  return (ZpCurrents){of->peak, now.rms > 0 ? (of->square - by_T) / (2 * now.rms * T) : 0};
}
