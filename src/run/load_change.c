/* A mass that is caught or dropped during the motion, at load.change_time. A caught mass arrives with a velocity and
 * shares its momentum with the platform at once; the energy lost is catch_loss. The kinetic energy that the mass adds
 * or removes changes the initial value of the energy balance. docs/theory.md, eqs. (27.6) and (27.7). */
#include <math.h>

#include "run/run.h"

/* The instant of a change of the load that is still to come, s; else INFINITY. */
double zp_sim_load_due(const ZpSim *sim) {
  const ZpActuatorDef *def = sim->model->whole;
  const bool waits = def->load.change_mass != 0 && !isnan(def->load.change_time) && !sim->state->load_changed;
  return waits ? def->load.change_time : INFINITY;
}

/* Kinetic energy that the change of the load adds or removes, of one part, J: a caught mass has fallen from
 * load.drop_height, a dropped one moves with the platform. */
static double energy_of_mass(const ZpModel *model, const ZpState *state) {
  const ZpActuatorDef *def = &model->def;
  size_t j = zp_load_node(&model->topology);
  ZpMotion m = zp_state_motion(model, state);
  double mass = zp_load_share(model) * def->load.change_mass;
  if (mass > 0) return mass * def->gravity * def->load.drop_height;
  return 0.5 * mass * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
}

/* Energy that one member stores, J per part. */
static double stored(ZpSim *m) {
  double row[ZP_MOST_ROWS] = {0};
  zp_system_now(m->model, m->state, &m->eval, row);
  return zp_system_stored(m->model, row);
}

void zp_sim_change_load(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    double brought = energy_of_mass(m->model, m->state);
    *zp_state_row(m->model, m->state, &zp_row_catch_loss) += stored(m) + brought;
    *zp_state_row(m->model, m->state, &zp_row_kinetic_energy) += brought;
  }
  zp_dynamics_change_load(&sim->dynamics, sim->states);
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    size_t j = zp_load_node(&m->model->topology);
    m->state->load_changed = true;
    m->state->changed_x = zp_state_motion(m->model, m->state).x[j];
    m->state->changed_y = zp_state_motion(m->model, m->state).y[j];
    *zp_state_row(m->model, m->state, &zp_row_catch_loss) -= stored(m);
  }
}
