/* State => energies and electric totals, of one modelled part. */
#include "actuator/eval.h"

/* What a solved field has beyond plates: since the last refresh its co-energy changed by the held force's work. */
static void add_beyond_plates(const ZpModel *model, const ZpState *state, const double *q, double U, ZpElectric *sum) {
  const double *held = state->data + 4 * model->stride, *then = state->data + 6 * model->stride;
  double work = 0;
  for (size_t k = 0; k < 2 * model->stride; k++)
    work += held[k] * (q[k] - then[k]);
  for (size_t i = 0; i < model->nodes; i++)
    sum->force += 0.5 * U * U * (held[model->stride + 2 * i + 1] - held[model->stride + 2 * i]);
  sum->charge += U * (state->held_charge + 2 * work);
  sum->potential -= U * U * (state->held_energy + work);
  sum->capacitance += state->held_capacitance + 2 * work / model->field_scale;
}

ZpElectric zp_eval_electric(const ZpModel *model, const ZpState *state, const double *q, const ZpPlatesEval *gaps,
                            double U) {
  const ZpActuatorDef *def = &model->def;
  if (!model->field) return (ZpElectric){0};
  ZpPlatesTotals totals = zp_plates_totals(&model->plates, gaps, U);
  double capacitance = ZP_EPS0 * def->medium.permittivity * def->ribbon.width * totals.inverse_gap;
  ZpElectric sum = {totals.force, totals.charge, totals.potential, capacitance};
  if (model->field_solved) add_beyond_plates(model, state, q, U, &sum);
  return sum;
}

ZpElectric zp_eval_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *e) {
  ZpMotion m = zp_state_motion(model, state);
  if (model->field) zp_plates_gaps(&model->plates, m.x, m.y, &e->plates);
  return zp_eval_electric(model, state, m.x, &e->plates, U);
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
  return energies;
}
