/* State => energies and electric totals, of one modelled part. Read at records only. */
#include "actuator/eval.h"

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
  if (!model->field) return energies;
  zp_plates_gaps(&model->plates, m.x, m.y, &e->plates);
  ZpPlatesTotals totals = zp_plates_totals(&model->plates, &e->plates, state->U);
  const ZpActuatorDef *def = &model->def;
  energies.force = totals.force;
  energies.charge = totals.charge;
  energies.field = totals.charge * state->U + totals.potential;
  energies.capacitance = ZP_EPS0 * def->medium.permittivity * def->ribbon.width * totals.inverse_gap;
  return energies;
}
