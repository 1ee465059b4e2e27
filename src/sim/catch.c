/* A mass that is caught or dropped while the actuator moves, at load.change_time. What is caught comes with a velocity
 * and shares its momentum with the platform at once: what that takes is catch_loss. What it brings or takes away with
 * it, kinetic energy, counts as if it had never been there. docs/theory.md, eqs. (27.6) and (27.7). */
#include <math.h>

#include "sim/sim_internal.h"

/* Where a change of the load is still to come: when, s; else INFINITY. */
double zp_sim_load_due(const ZpSim *sim) {
  const ZpActuatorDef *def = &sim->model->def;
  return sim->state->load_changed || isnan(def->load.change_time) ? INFINITY : def->load.change_time;
}

/* Kinetic energy of the mass that comes or goes, of one part, J: what is caught has fallen from load.drop_height, what
 * is dropped moves as the platform does. */
static double energy_of_mass(const ZpModel *model, const ZpState *state) {
  const ZpActuatorDef *def = &model->def;
  size_t j = zp_load_node(&model->topology);
  ZpMotion m = zp_state_motion(model, state);
  double mass = zp_load_share(model) * def->load.change_mass;
  if (mass > 0) return mass * def->gravity * def->load.drop_height;
  return 0.5 * mass * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
}

void zp_sim_change_load(ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  size_t j = zp_load_node(&model->topology);
  ZpEnergies before = zp_system_energies(model, state, &sim->eval);
  double brought = energy_of_mass(model, state);
  zp_dynamics_change_load(&sim->dynamics, state);
  state->load_changed = true;
  state->changed_x = zp_state_motion(model, state).x[j];
  state->changed_y = zp_state_motion(model, state).y[j];
  ZpEnergies after = zp_system_energies(model, state, &sim->eval);
  state->catch_loss += zp_energy_without_field(&before) + brought - zp_energy_without_field(&after);
  state->base_energy += brought;
}
