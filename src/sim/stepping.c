/* How a run advances: by implicit steps, or by the paper's explicit ones. */
#include "sim/sim_internal.h"

static bool create_implicit(ZpSim *sim) {
  bool fed = zp_sim_is_fed(sim);
  if (fed) zp_feed_create(sim);
  return zp_dynamics_create(sim->model, fed ? &sim->feed.source : NULL, &sim->dynamics);
}

/* Take an implicit step. If rounding, a pulse or a steep rise has put the next corner closer than `shortest`, only time
 * advances. */
static bool step_implicit(ZpSim *sim, double latest, ZpStepLimit *limit) {
  static const double shortest = 1e-13; /* s: less than a nanometre at the speed of sound */
  ZpState *state = sim->state;
  *limit = sim->dynamics.stepper.fixed > 0 ? ZP_LIMIT_TIME_STEP : ZP_LIMIT_ERROR;
  if (zp_sim_is_fed(sim)) return zp_feed_step(sim, latest);
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
  return zp_dynamics_create(sim->model, source, &sim->dynamics);
}
