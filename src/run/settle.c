/* The hanging equilibrium, loaded and without voltage, from the straight shape: by Newton's method, and by
 * damped stepping where that finds nothing. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "actuator/place.h"
#include "def/tolerance.h"
#include "rest/rest.h"
#include "run/hooks.h"
#include "run/run.h"
#include "solve/relax.h"

typedef struct Settling {
  ZpSim *sim;
  const ZpHooks *hooks;
  double *a; /* that of the last call */
  double tolerance, first_residual;
} Settling;

static void accelerate(void *self, const double *q, double *a) {
  Settling *settling = self;
  ZpSim *sim = settling->sim;
  static const ZpZipState hanging = {0, false};
  ZpSpan hanging_still = zp_span_at(q);
  hanging_still.faces_pass = true;
  zp_system_accelerations(sim->model, &hanging_still, &sim->model->pseudo, &sim->eval, a);
  zp_ties_share(sim->model, &sim->model->pseudo, &hanging, a);
  settling->a = a;
}

static double residual(void *self) {
  Settling *settling = self;
  return zp_eval_imbalance(settling->sim->model, settling->a);
}

static bool stop(void *self, int64_t steps, double left) {
  enum { BETWEEN = 4096 }; /* steps between two calls of the caller's check: about a millisecond */
  Settling *settling = self;
  if (steps % BETWEEN) return false;
  if (steps == 0) settling->first_residual = left;
  double decades = log10(settling->first_residual / settling->tolerance);
  double fraction = decades > 0 ? log10(settling->first_residual / left) / decades : 0;
  return zp_hooks_stop(settling->hooks, "settling", fmax(fraction, 0));
}

static ZpOutcome outcome_of(ZpRelaxEnd end) {
  switch (end) {
  case ZP_RELAX_AT_REST:
    return ZP_REACHED_END;
  case ZP_RELAX_STOPPED:
    return ZP_INTERRUPTED;
  case ZP_RELAX_DIVERGED:
  case ZP_RELAX_STEP_LIMIT:
    break;
  }
  return ZP_NOT_SETTLED;
}

/* The imbalance that rounding of positions in stiff axial springs causes, measured at N = 130; relative to the same
 * weight as zp_eval_imbalance. */
static double rounding_floor(const ZpModel *model) {
  return 3 * DBL_EPSILON * model->L * model->spring.K_D / zp_eval_weight_scale(model);
}

static bool stop_hanging(const void *hooks) {
  return zp_hooks_stop(hooks, "settling", 0);
}

/* The equilibrium of all members, by Newton's method => rest, which is closed in any case. *found is false if it finds
 * nothing (a chain without bending stiffness has no stiffness when straight). => false if there is no memory. */
static bool find_rest(ZpSim *sim, const ZpHooks *hooks, ZpRest *rest, bool *found) {
  if (!zp_rest_open(rest, sim->model, NULL, NULL)) return false;
  rest->statics.stop = stop_hanging;
  rest->statics.caller = hooks;
  const ZpNewtonInfo info = zp_statics_find_rest(&rest->statics);
  *found = zp_newton_good(info.end);
  if (!*found) zp_statics_fallen(&rest->statics, sim->falls);
  sim->settle_steps = info.iterations;
  sim->settle_residual = info.residual;
  if (rest->statics.stopped) sim->settled = ZP_INTERRUPTED;
  return true;
}

static bool solve(ZpSim *sim, const ZpHooks *hooks, double *q, double *pressure, bool *found) {
  ZpRest rest;
  const bool opened = find_rest(sim, hooks, &rest, found);
  if (opened) memcpy(q, rest.statics.member->q, zp_coordinates(sim->model) * sizeof *q);
  if (opened) *pressure = rest.statics.member->eval.pressure;
  zp_rest_close(&rest);
  return opened;
}

/* By damped stepping. */
static void relax(ZpSim *sim, const ZpHooks *hooks, double *q) {
  const ZpModel *model = sim->model;
  size_t n = zp_coordinates(model);
  /* the stroke's error is of the order of the imbalance times the number of nodes */
  double tolerance = fmax(zp_tolerance_at_rest(&model->def), rounding_floor(model));
  Settling settling = {.sim = sim, .hooks = hooks, .tolerance = tolerance};
  ZpRelaxSystem system = {n, &settling, accelerate, residual, stop};
  memcpy(q, zp_state_q(model, sim->state), n * sizeof *q);
  ZpRelaxInfo info = zp_relax(&system, tolerance, model->def.solver.max_steps, q, q + n);
  sim->settled = outcome_of(info.end);
  sim->settle_steps = info.steps;
  sim->settle_residual = info.residual;
}

/* Laws have the state that they have at rest: strain that has become plastic on the way is permanent. */
void zp_sim_start_at(ZpSim *sim, const double *q, double pressure) {
  const ZpModel *model = sim->model;
  ZpSpan there = zp_span_at(q);
  there.pressure = pressure;
  memcpy(zp_state_q(model, sim->state), q, zp_coordinates(model) * sizeof *q);
  zp_system_force(model, &there, &sim->eval, sim->relax_work + zp_coordinates(model));
  for (const ZpLaw *law = model->law; law < model->law + model->laws; law++)
    if (law->term->state_at_rest && law->state > 0)
      memcpy(zp_law_state(model, law->term, sim->state), sim->eval.memory_end + law->at, law->state * sizeof *q);
}

/* The only member. */
static bool settle_one(ZpSim *sim, const ZpHooks *hooks) {
  const ZpModel *model = sim->model;
  double *q = sim->relax_work;
  /* a straight ribbon that cannot close needs neither a start nor a reference */
  if (!model->field && model->def.initial.state == ZP_INITIAL_STRAIGHT) return true;
  bool found;
  double pressure = 0;
  if (!solve(sim, hooks, q, &pressure, &found)) return false;
  if (!found && sim->settled == ZP_REACHED_END) relax(sim, hooks, q);
  if (sim->settled != ZP_REACHED_END) return true;
  if (model->field) sim->state->opening0 = zp_last_gap(model, zp_nodes(model, q).y);
  if (model->def.initial.state == ZP_INITIAL_EQUILIBRIUM) zp_sim_start_at(sim, q, pressure);
  return true;
}

/* One of several, at their common equilibrium. */
static void start_member(ZpSim *sim, ZpStatics *rest, size_t which) {
  const ZpModel *model = sim->model;
  const double *q = rest->member[which].q;
  sim->state->opening0 = zp_last_gap(model, zp_nodes(model, q).y);
  if (model->def.initial.state != ZP_INITIAL_EQUILIBRIUM) return;
  zp_sim_start_at(sim, q, rest->member[which].eval.pressure);
  if (zp_abreast(model) > 1)
    sim->state->link_force = (zp_load_pull(model) - zp_statics_member_force(rest, which)) / model->parts;
}

/* Bodies in the plane. */
static void start_bodies(ZpSim *sim, const ZpStatics *rest) {
  double *to = zp_state_bodies(sim->model, sim->state);
  memset(to, 0, zp_state_bodies_size(sim->model) * sizeof *to);
  zp_plane_gather(&rest->plane, 0, rest->pose, to);
  zp_links_hold(&rest->links, rest->pose, zp_state_strains(sim->model, sim->state));
}

void zp_sim_hang(ZpSim *sim) {
  const ZpNetwork *network = sim->model->network;
  for (size_t i = 0; i < sim->members && !zp_shares_load(sim->model); i++) {
    ZpSim *m = sim + network->order[i];
    const ZpBody *upper = &network->body[network->ends[m->model->number].upper];
    const ZpSim *above = sim + upper->leader;
    if (!upper->held)
      zp_place_below(above->model, zp_state_q(above->model, above->state), m->model, zp_state_q(m->model, m->state));
  }
}

static bool settle_members(ZpSim *sim, const ZpHooks *hooks) {
  ZpRest rest;
  bool found = false;
  const bool opened = find_rest(sim, hooks, &rest, &found);
  if (!found && sim->settled == ZP_REACHED_END) sim->settled = ZP_NOT_SETTLED;
  for (size_t k = 0; opened && k < sim->members; k++)
    start_member(sim + k, &rest.statics, k);
  if (opened && sim->model->network->plane) start_bodies(sim, &rest.statics);
  if (opened) zp_sim_hang(sim);
  zp_rest_close(&rest);
  return opened;
}

bool zp_sim_settle(ZpSim *sim, const ZpHooks *hooks) {
  bool goes_on = sim->model->def.initial.state == ZP_INITIAL_CHECKPOINT; /* which has start and reference */
  sim->settled = goes_on ? ZP_BAD_ARGUMENT : ZP_REACHED_END;             /* until a state is given */
  if (goes_on) return true;
  return sim->members > 1 || sim->model->network->plane ? settle_members(sim, hooks) : settle_one(sim, hooks);
}
