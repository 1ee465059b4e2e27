/* State => energies and electric totals, of one modelled part. Read at records only. */
#include "actuator/eval.h"

/* What a solved field has beyond plates: since the last refresh its co-energy changed by the held force's work. */
static void add_beyond_plates(const ZpModel *model, const ZpState *state, ZpEnergies *energies) {
  const double *q = state->data, *held = q + 4 * model->stride, *then = q + 6 * model->stride;
  double U = state->U, work = 0;
  for (size_t k = 0; k < 2 * model->stride; k++)
    work += held[k] * (q[k] - then[k]);
  for (size_t i = 0; i < model->nodes; i++)
    energies->force += 0.5 * U * U * (held[model->stride + 2 * i + 1] - held[model->stride + 2 * i]);
  double charge = state->held_charge + 2 * work; /* per volt */
  energies->charge += charge * U;
  energies->field += U * U * (charge - state->held_energy - work);
  energies->capacitance += state->held_capacitance;
}

/* The electric part. */
static void add_field(const ZpModel *model, const ZpState *state, ZpEval *e, ZpEnergies *energies) {
  ZpMotion m = zp_state_motion(model, state);
  const ZpActuatorDef *def = &model->def;
  zp_plates_gaps(&model->plates, m.x, m.y, &e->plates);
  ZpPlatesTotals totals = zp_plates_totals(&model->plates, &e->plates, state->U);
  energies->force = totals.force;
  energies->charge = totals.charge;
  energies->field = totals.charge * state->U + totals.potential;
  energies->capacitance = ZP_EPS0 * def->medium.permittivity * def->ribbon.width * totals.inverse_gap;
  if (model->field_solved) add_beyond_plates(model, state, energies);
}

double zp_eval_charge(const ZpModel *model, const ZpState *state, ZpEval *e) {
  ZpEnergies energies = {0};
  if (model->field) add_field(model, state, e, &energies);
  return energies.charge;
}

ZpEnergies zp_eval_energies(const ZpModel *model, const ZpState *state, ZpEval *e) {
  ZpMotion m = zp_state_motion(model, state);
  ZpEnergies energies = {0};
  if (model->is_rod) {
    zp_rod_eval(&model->rod, m.x, m.y, &e->rod);
    energies.axial = zp_rod_stretching_energy(&model->rod, &e->rod);
    energies.bending = zp_rod_bending_energy(&model->rod, &e->rod);
  } else {
    zp_massspring_eval(&model->spring, m.x, m.y, &e->spring);
    energies.axial = zp_massspring_axial_energy(&model->spring, &e->spring);
    energies.bending = zp_massspring_shear_energy(&model->spring, &e->spring);
  }
  for (size_t j = 0; j < model->count; j++) {
    energies.kinetic += 0.5 * model->mass[j] * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
    energies.gravity += model->weight[j] * m.y[j];
  }
  if (model->field) add_field(model, state, e, &energies);
  return energies;
}
