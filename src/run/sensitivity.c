#include "run/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "rest/rest.h"
#include "rest/sensitivity.h"
#include "run/snapshot.h"

/* Steps of a key. They are so small that the first touch of two faces, where (9.6) has a corner, is hardly ever between
 * the points of a difference, but they are above rounding. */
static const double part = 1e-7;

/* -- where the runs begin ---------------------------------------------------------------------------- */

/* Derivative of the hanging equilibrium by a key => rate, of coordinates and opening0. */
static ZpStatus rate_of_hanging(ZpRest *rest, int key, ZpState *rate, ZpError *err) {
  const ZpModel *model = rest->statics.member->model;
  ZpRestSensitivity slope;
  ZpStatus status = zp_rest_sensitivity_open(&slope, &rest->statics, key, err);
  if (status == ZP_OK && zp_rest_sensitivity_solve(&slope, ZP_SETS_LOAD)) {
    memcpy(zp_state_q(model, rate), slope.rate, zp_coordinates(model) * sizeof *slope.rate);
    rate->opening0 = zp_is_pair(&model->topology) ? zp_rest_sensitivity_of(&slope, zp_output_opening, NULL) : 0;
  }
  zp_rest_sensitivity_close(&slope);
  return status;
}

static ZpStatus create_near(ZpRunSensitivity *rates, ZpKeyRates *of, ZpError *err) {
  const ZpModel *model = rates->sim->model;
  bool straight = model->def.initial.state == ZP_INITIAL_STRAIGHT;
  for (int k = 0; k < of->by.count; k++) {
    zp_state_along(model, rates->sim->state, of->rate, of->by.near[k].offset, rates->before);
    double *q = straight ? NULL : zp_state_q(model, rates->before);
    of->near[k] = zp_sim_create_at(of->by.near[k].model, q, rates->before->opening0);
    if (!of->near[k]) return zp_fail_memory(err);
    of->near[k]->dynamics.lead = &rates->sim->dynamics;
  }
  return ZP_OK;
}

static void take_rate(const ZpRunSensitivity *rates, const ZpKeyRates *of) {
  const ZpModel *model = rates->sim->model;
  memset(of->rate, 0, zp_state_size(model));
  for (int k = 0; k < of->by.count; k++)
    zp_state_add_rate(model, rates->sim->state, of->near[k]->state, of->by.near[k].weight, of->rate);
}

static ZpStatus open_key(ZpRunSensitivity *rates, ZpRest *rest, int key, ZpKeyRates *of, ZpError *err) {
  const ZpModel *model = rates->sim->model;
  bool hangs = zp_is_pair(&model->topology) || model->def.initial.state == ZP_INITIAL_EQUILIBRIUM;
  of->lost = INFINITY;
  of->last[0].t = of->last[1].t = NAN;
  of->rate = zp_calloc(1, zp_state_size(model));
  if (!of->rate) return zp_fail_memory(err);
  ZpStatus status = zp_finite_difference_open(&of->by, model, key, part, err);
  if (status == ZP_OK && hangs) status = rate_of_hanging(rest, key, of->rate, err);
  if (status == ZP_OK) status = create_near(rates, of, err);
  if (status == ZP_OK) take_rate(rates, of);
  return status;
}

static bool allocate(ZpRunSensitivity *rates) {
  const ZpModel *model = rates->sim->model;
  size_t n = rates->sim->dynamics.system.n;
  rates->key = zp_calloc(rates->keys, sizeof *rates->key);
  rates->before = zp_calloc(1, zp_state_size(model));
  rates->wet = zp_calloc(model->nodes, sizeof *rates->wet);
  rates->work = zp_calloc(7 * n, sizeof *rates->work);
  rates->motion = rates->work + 6 * n;
  return rates->key && rates->before && rates->wet && rates->work;
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

void zp_run_sensitivity_close(ZpRunSensitivity *rates) {
  for (size_t j = 0; rates->key && j < rates->keys; j++) {
    ZpKeyRates *of = &rates->key[j];
    for (int k = 0; k < of->by.count; k++)
      zp_sim_destroy(of->near[k]);
    zp_finite_difference_close(&of->by);
    zp_free(of->rate);
  }
  zp_free(rates->key);
  zp_free(rates->before);
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

static double corner_of(ZpSim *sim, double end_time) {
  return fmin(zp_sim_next_corner(sim), end_time);
}

/* An ideal source gives a neighbour exactly the voltage of its own waveform: a rounding would be a jump, at which the
 * account of the work closes. Neighbours' accounts close where the run's does. */
static void set_voltage(const ZpSim *sim, ZpSim *near) {
  if (zp_sim_is_fed(sim)) return;
  near->state->U = zp_waveform_voltage(&near->model->waveform, near->state->t);
  if (sim->state->U == sim->state->base_U) near->state->base_U = near->state->U;
}

static void begin_near(const ZpRunSensitivity *rates, ZpKeyRates *of, int k, bool at_corner, double end_time) {
  const ZpSim *sim = rates->sim;
  ZpSim *near = of->near[k];
  double t = time_of(rates, of, k, sim->state->t);
  zp_state_along(sim->model, sim->state, of->rate, of->by.near[k].offset, near->state);
  near->state->t = t;
  set_voltage(sim, near);
  if (t >= zp_sim_load_due(near)) zp_sim_change_load(near);
  if (zp_sim_is_fed(near)) zp_supply_coupling_arrive(near);
  memcpy(near->before, near->state, zp_state_size(near->model));
  if (!at_corner) return;
  of->from[k] = t;
  of->to[k] = corner_of(rates->sim, end_time) < end_time ? corner_of(near, end_time) : end_time;
}

void zp_run_sensitivity_begin(ZpRunSensitivity *rates, double end_time) {
  ZpSim *sim = rates->sim;
  bool at_corner = sim->state->t >= rates->to;
  memcpy(rates->before, sim->state, zp_state_size(sim->model));
  rates->taken = sim->dynamics.stepper.counts.steps;
  for (ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    for (int k = 0; k < of->by.count && !isfinite(of->lost); k++)
      begin_near(rates, of, k, at_corner, end_time);
  if (!at_corner) return;
  rates->from = sim->state->t;
  rates->to = corner_of(sim, end_time);
}

/* -- and ends ---------------------------------------------------------------------------------------- */

static void lose(const ZpRunSensitivity *rates, ZpKeyRates *of, const char *cause) {
  of->lost = rates->before->t;
  of->cause = cause;
}

/* Has the bead covered a station in this step that it did not cover in the step before, or the reverse? */
static bool meniscus_passes(ZpRunSensitivity *rates) {
  const ZpMovingMember *m = rates->sim->dynamics.member;
  bool passes = false;
  for (size_t i = 1; i < m->model->nodes && m->model->has_bead; i++) {
    bool wet = zp_film_covers(&m->model->film, &m->eval.film, i);
    passes |= wet != rates->wet[i] && rates->before->t > 0;
    rates->wet[i] = wet;
  }
  return passes;
}

/* Does the run end at the end of this step, although its state ended it before? */
static bool ends_late(const ZpSim *sim) {
  return sim->landing == ZP_LANDS_NOWHERE && zp_sim_stops(sim, sim->stop);
}

/* An event in the run's step that has no derivative. What a meniscus leaves at a station that it passes, and how long a
 * supply is at its limit, depend on when within the step it happens. NULL: none. */
static const char *cause_of_loss(ZpRunSensitivity *rates) {
  if (rates->sim->state->supply_mode != rates->before->supply_mode)
    return "a limit of the supply's current begins or ends";
  if (ends_late(rates->sim)) return "the run ends at the end of a step, not at the instant that ends it";
  return meniscus_passes(rates) ? "the meniscus of a bead passes a node; liquid.model none or submerged has them"
                                : NULL;
}

/* Does the step's matrix filter velocities, because of faces or menisci? */
static bool takes_matrix(const ZpRunSensitivity *rates) {
  return rates->sim->model->has_bead || rates->sim->dynamics.filters;
}

/* Does the step end where a slew rate begins or ceases to limit the supply? */
static bool ends_at_event(const ZpRunSensitivity *rates) {
  return zp_sim_is_fed(rates->sim) && rates->sim->state->t >= rates->event;
}

/* There the neighbours' steps end at their own events. */
static double end_near(const ZpRunSensitivity *rates, const ZpKeyRates *of, int k) {
  const ZpSim *near = of->near[k];
  double h = rates->sim->state->t - rates->before->t;
  if (ends_at_event(rates)) return zp_supply_coupling_event(near, near->state->t + 2 * h);
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
  if (zp_sim_is_fed(near)) zp_supply_coupling_end(near);
  zp_sim_arrive(near);
}

/* When a neighbouring actuator closes, if the run closes in this step: where the neighbour's path of the same step
 * passes the limit, even outside the step. A front that arrives is detected only at the end of a step, which is not the
 * exact instant. `now` and `before` are of the run, at the end and the start of the step. */
static double closing_near(const ZpRunSensitivity *rates, const ZpSim *near, double before, double now,
                           double carried) {
  const ZpSim *sim = rates->sim;
  if (isnan(now)) return NAN;
  if (now == before) return carried;
  if (sim->landing == ZP_LANDS_CLOSED) return near->state->t;
  return now < sim->state->t ? zp_sim_crossing(near) : NAN;
}

/* Take the neighbours from the start of the run's step to its end. */
static bool follow_step(ZpRunSensitivity *rates, ZpKeyRates *of, bool moves) {
  const ZpState *now = rates->sim->state, *before = rates->before;
  for (int k = 0; k < of->by.count; k++)
    memcpy(of->near[k]->state, of->near[k]->before, zp_state_size(of->near[k]->model));
  if (moves && !move(rates, of)) return false;
  for (int k = 0; k < of->by.count; k++) {
    ZpSim *near = of->near[k];
    if (moves)
      arrive(near);
    else
      near->state->t = end_near(rates, of, k);
    ZpState *state = near->state;
    const ZpState *start = near->before;
    state->zip_time = closing_near(rates, near, before->zip_time, now->zip_time, start->zip_time);
    double closed = closing_near(rates, near, before->closed_from, now->closed_from, start->closed_from);
    if (now->closed_from != before->closed_from && !isnan(closed))
      zp_sim_close(near, (ZpOpeningAt){closed, zp_closed_opening(near->model, state->opening0)});
    state->closed_from = closed;
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

/* Until the run ends. */
static double left_of(ZpSim *near, const void *landing) {
  return zp_sim_left(near, *(const ZpLanding *)landing);
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
  if (!follow_step(rates, of, true)) return false;
  double first = rate_of(of, left_of, &sim->landing),
         trial = first * (sim->state->t - rates->before->t) / sim->left_before;
  if (first == 0) return true;
  of->late = trial;
  if (!follow_step(rates, of, true)) return false;
  of->late = trial * first / (first - rate_of(of, left_of, &sim->landing));
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
  double start = rates->before->t, end = sim->state->t;
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
  double mean = rates->sim->feed.current[of_step], h = rates->sim->state->t - rates->before->t;
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
    if (cause)
      lose(rates, of, cause);
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
  double by_T = now.rms * now.rms * of->rate->t;
  return (ZpCurrents){of->peak, now.rms > 0 ? (of->square - by_T) / (2 * now.rms * T) : 0};
}
