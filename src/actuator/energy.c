/* State => energies and electric totals, of one modelled part. Read at records only. */
#include "actuator/eval.h"

ZpEnergies zp_eval_energies(const ZpModel *model, const ZpState *state, ZpEval *e) {
  size_t count = model->count;
  const double *q = state->data, *y = q + count, *v = q + 2 * count;
  zp_massspring_eval(&model->spring, q, y, &e->spring);
  ZpEnergies energies = {.axial = zp_massspring_axial_energy(&model->spring, &e->spring),
                         .bending = zp_massspring_shear_energy(&model->spring, &e->spring)};
  for (size_t j = 0; j < count; j++) {
    energies.kinetic += 0.5 * model->mass[j] * (v[j] * v[j] + v[count + j] * v[count + j]);
    energies.gravity += model->weight[j] * y[j];
  }
  if (!model->field) return energies;
  zp_plates_gaps(&model->plates, q, y, &e->plates);
  ZpPlatesTotals totals = zp_plates_totals(&model->plates, &e->plates, state->U);
  const ZpActuatorDef *def = &model->def;
  energies.force = totals.force;
  energies.charge = totals.charge;
  energies.field = totals.charge * state->U + totals.potential;
  energies.capacitance = ZP_EPS0 * def->medium.permittivity * def->ribbon.width * totals.inverse_gap;
  return energies;
}
