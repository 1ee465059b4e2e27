#include "sim/run_rates.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "rest/rest.h"
#include "rest/slope.h"
#include "sim/snapshot.h"

/* Steps of a key: small enough that hardly ever the first touch of two faces, where (9.6) has a corner, is between the
 * points of a difference; above rounding. */
static const double part = 1e-7;

/* -- where the runs begin ---------------------------------------------------------------------------- */

/* How the hanging equilibrium goes with a key => rate, of coordinates and opening0. */
static ZpStatus rate_of_hanging(ZpRest *rest, int key, ZpState *rate, ZpError *err) {
  const ZpModel *model = rest->statics.model;
  ZpSlope slope;
  ZpStatus status = zp_slope_open(&slope, &rest->statics, &rest->branch.newton, key, err);
  if (status == ZP_OK && zp_slope_solve(&slope, zp_pose_load)) {
    memcpy(zp_state_q(model, rate), slope.rate, 2 * model->stride * sizeof *slope.rate);
    rate->opening0 = zp_is_pair(&model->topology) ? zp_slope_of(&slope, zp_pose_load, zp_output_opening, NULL) : 0;
  }
  zp_slope_close(&slope);
  return status;
}

static ZpStatus create_near(ZpRunRates *rates, ZpKeyRates *of, ZpError *err) {
  const ZpModel *model = rates->sim->model;
  bool straight = model->def.initial.state == ZP_INITIAL_STRAIGHT;
  for (int k = 0; k < ZP_NEAR_POINTS; k++) {
    if (!of->by.model[k]) continue;
    zp_state_along(model, rates->sim->state, of->rate, of->by.offset[k], rates->before);
    double *q = straight ? NULL : zp_state_q(model, rates->before);
    of->near[k] = zp_sim_create_at(of->by.model[k], q, rates->before->opening0);
    if (!of->near[k]) return zp_fail_memory(err);
    of->near[k]->dynamics.lead = &rates->sim->dynamics;
  }
  return ZP_OK;
}

static void take_rate(const ZpRunRates *rates, const ZpKeyRates *of) {
  const ZpModel *model = rates->sim->model;
  memset(of->rate, 0, zp_state_size(model));
  for (int k = 0; k < ZP_NEAR_POINTS; k++)
    if (of->near[k]) zp_state_add_rate(model, rates->sim->state, of->near[k]->state, of->by.weight[k], of->rate);
}

static ZpStatus open_key(ZpRunRates *rates, ZpRest *rest, int key, ZpKeyRates *of, ZpError *err) {
  const ZpModel *model = rates->sim->model;
  bool hangs = zp_is_pair(&model->topology) || model->def.initial.state == ZP_INITIAL_EQUILIBRIUM;
  of->lost = INFINITY;
  of->rate = zp_calloc(1, zp_state_size(model));
  if (!of->rate) return zp_fail_memory(err);
  ZpStatus status = zp_near_open(&of->by, model, key, part, err);
  if (status == ZP_OK && hangs) status = rate_of_hanging(rest, key, of->rate, err);
  if (status == ZP_OK) status = create_near(rates, of, err);
  if (status == ZP_OK) take_rate(rates, of);
  return status;
}

static bool allocate(ZpRunRates *rates) {
  const ZpModel *model = rates->sim->model;
  size_t n = rates->sim->dynamics.system.n;
  rates->key = zp_calloc(rates->keys, sizeof *rates->key);
  rates->before = zp_calloc(1, zp_state_size(model));
  rates->wet = zp_calloc(model->nodes, sizeof *rates->wet);
  rates->work = zp_calloc(7 * n, sizeof *rates->work);
  rates->motion = rates->work + 6 * n;
  return rates->key && rates->before && rates->wet && rates->work;
}

ZpStatus zp_run_rates_open(ZpRunRates *rates, ZpSim *sim, const int *key, size_t keys, ZpError *err) {
  *rates = (ZpRunRates){.sim = sim, .keys = keys};
  ZpRest rest;
  bool opened = zp_rest_open(&rest, sim->model, NULL, NULL);
  ZpStatus status = opened && allocate(rates) ? ZP_OK : zp_fail_memory(err);
  if (status == ZP_OK) zp_statics_hang(&rest.statics, &rest.branch.newton);
  for (size_t k = 0; k < keys && status == ZP_OK; k++)
    status = open_key(rates, &rest, key[k], &rates->key[k], err);
  zp_rest_close(&rest);
  if (status == ZP_OK) sim->rates = rates;
  return status;
}

void zp_run_rates_close(ZpRunRates *rates) {
  for (size_t k = 0; rates->key && k < rates->keys; k++) {
    for (int i = 0; i < ZP_NEAR_POINTS; i++)
      zp_sim_destroy(rates->key[k].near[i]);
    zp_near_close(&rates->key[k].by);
    zp_free(rates->key[k].rate);
  }
  zp_free(rates->key);
  zp_free(rates->before);
  zp_free(rates->wet);
  zp_free(rates->work);
  rates->sim->rates = NULL;
}

/* -- a step begins ----------------------------------------------------------------------------------- */

/* Between two corners steps end at the same share of the way, so corners that a key moves are ends of steps, too. */
static double time_of(const ZpRunRates *rates, const ZpKeyRates *of, int k, double t) {
  double share = (t - rates->from) / (rates->to - rates->from);
  return t == rates->to ? of->to[k] : of->from[k] + share * (of->to[k] - of->from[k]);
}

static double corner_of(ZpSim *sim, double end_time) {
  return fmin(zp_sim_next_corner(sim), end_time);
}

static void begin_near(const ZpRunRates *rates, ZpKeyRates *of, int k, bool at_corner, double end_time) {
  const ZpSim *sim = rates->sim;
  ZpSim *near = of->near[k];
  double t = time_of(rates, of, k, sim->state->t);
  zp_state_along(sim->model, sim->state, of->rate, of->by.offset[k], near->state);
  near->state->t = t;
  if (t >= zp_sim_load_due(near)) zp_sim_change_load(near);
  if (zp_sim_is_fed(near)) zp_feed_arrive(near);
  if (!at_corner) return;
  of->from[k] = t;
  of->to[k] = corner_of(near, end_time);
}

void zp_run_rates_begin(ZpRunRates *rates, double end_time) {
  ZpSim *sim = rates->sim;
  bool at_corner = sim->state->t >= rates->to;
  memcpy(rates->before, sim->state, zp_state_size(sim->model));
  rates->taken = sim->dynamics.stepper.counts.steps;
  for (size_t j = 0; j < rates->keys; j++)
    for (int k = 0; k < ZP_NEAR_POINTS; k++)
      if (rates->key[j].near[k] && !isfinite(rates->key[j].lost))
        begin_near(rates, &rates->key[j], k, at_corner, end_time);
  if (!at_corner) return;
  rates->from = sim->state->t;
  rates->to = corner_of(sim, end_time);
}

/* -- and ends ---------------------------------------------------------------------------------------- */

static void lose(const ZpRunRates *rates, ZpKeyRates *of, const char *cause) {
  of->lost = rates->before->t;
  of->cause = cause;
}

/* Does the liquid of a bead fill a station that it did not fill in the step before, or the other way round? */
static bool meniscus_passes(ZpRunRates *rates) {
  const ZpDynamics *d = &rates->sim->dynamics;
  bool passes = false;
  for (size_t i = 1; i < d->model->nodes && d->model->has_bead; i++) {
    bool wet = zp_film_fills(&d->model->film, &d->eval.film, i);
    passes |= wet != rates->wet[i] && rates->before->t > 0;
    rates->wet[i] = wet;
  }
  return passes;
}

/* What has happened in the run's step that has no derivative: what a meniscus leaves to a station that it passes, and
 * how long a supply is at its limit, depend on where within a step that is. NULL: nothing. */
static const char *cause_of_loss(ZpRunRates *rates) {
  if (rates->sim->state->supply_mode != rates->before->supply_mode)
    return "a limit of the supply's current begins or ends";
  return meniscus_passes(rates) ? "the meniscus of a bead passes a station" : NULL;
}

/* Are velocities smoothed by the matrix of the step, for faces or for menisci? */
static bool takes_matrix(const ZpRunRates *rates) {
  return rates->sim->model->has_bead || rates->sim->dynamics.filters;
}

/* The dynamics of all points of a key, from where they are to where the run's step ends. */
static bool move(ZpRunRates *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  ZpNearSteps steps = {.q1 = sim->dynamics.q, .lead = &sim->dynamics.history, .work = rates->work};
  for (int k = 0; k < ZP_NEAR_POINTS; k++) {
    ZpSim *near = of->near[k];
    if (!near) continue;
    double latest = time_of(rates, of, k, sim->state->t);
    ZpDynamics *d = &near->dynamics;
    if (!zp_sim_prepare(near)) return false;
    if (zp_sim_is_fed(near)) zp_feed_begin(near);
    zp_dynamics_begin(d, near->states, latest);
    steps.near[steps.count++] =
        (ZpNearStep){&d->stepper, of->by.offset[k], of->by.weight[k], latest - near->state->t, d->q, d->v, &d->history};
  }
  return zp_implicit_follow(&steps, takes_matrix(rates), rates->motion);
}

static void arrive(ZpSim *near) {
  zp_dynamics_end(&near->dynamics, near->states);
  if (zp_sim_is_fed(near)) zp_feed_end(near);
  zp_sim_arrive(near);
}

/* The zip time of an actuator near, where the run's step has ended: of the same step, wherever its own path passes the
 * limit. A platform that touches, or a front that arrives, is found at the end of a step only: that is no instant. */
static double zip_time_near(const ZpRunRates *rates, const ZpSim *near) {
  const ZpState *state = rates->sim->state;
  if (!isnan(rates->before->zip_time)) return near->state->zip_time;
  return state->zip_time < state->t ? zp_sim_crossing(near) : NAN;
}

static bool follow_key(ZpRunRates *rates, ZpKeyRates *of) {
  const ZpSim *sim = rates->sim;
  bool moves = sim->dynamics.stepper.counts.steps > rates->taken;
  if (moves && !move(rates, of)) return false;
  for (int k = 0; k < ZP_NEAR_POINTS; k++) {
    if (!of->near[k]) continue;
    if (moves)
      arrive(of->near[k]);
    else
      of->near[k]->state->t = time_of(rates, of, k, sim->state->t);
    of->near[k]->state->zip_time = zip_time_near(rates, of->near[k]);
  }
  take_rate(rates, of);
  return true;
}

void zp_run_rates_follow(ZpRunRates *rates) {
  const char *cause = cause_of_loss(rates);
  for (size_t k = 0; k < rates->keys; k++) {
    ZpKeyRates *of = &rates->key[k];
    if (isfinite(of->lost)) continue;
    if (cause)
      lose(rates, of, cause);
    else if (!follow_key(rates, of))
      lose(rates, of, "the derivative of a step was not found");
  }
}

double zp_run_rate_of(const ZpRunRates *rates, size_t k, double (*number)(ZpSim *sim, void *user), void *user) {
  const ZpKeyRates *of = &rates->key[k];
  double sum = 0;
  for (int i = 0; i < ZP_NEAR_POINTS; i++)
    if (of->near[i]) sum += of->by.weight[i] * number(of->near[i], user);
  return sum;
}
