#include "system/cached_field.h"

#include <math.h>
#include <string.h>

#include "system/system.h"

/* Has any gap, insulators included, changed by more than this share since the last refresh? */
static bool gaps_changed(const ZpModel *model, const ZpState *state, double share) {
  const double *y = zp_state_motion(model, state).y, *then = zp_nodes(model, zp_state_beyond(model, state).at).y;
  for (size_t i = 0; i < model->nodes; i++) {
    double gap = zp_plates_gap(&model->plates, y, i), before = zp_plates_gap(&model->plates, then, i);
    if (fabs(gap - before) > share * (before + model->plates.d)) return true;
  }
  return false;
}

/* A gap with its insulators counts at least as the one where breakdown sets in: has this changed as much? */
static bool cap_changed(const ZpModel *model, const ZpState *state, double share) {
  double d = model->plates.d, before = fmax(d, zp_plates_least_h(&model->plates, state->held_U));
  return fabs(fmax(d, zp_plates_least_h(&model->plates, state->U)) - before) > share * before;
}

bool zp_cached_field_outdated(const ZpModel *model, const ZpState *state) {
  if (!model->field_solved) return model->def.electro.refresh_period > 0;
  return isnan(state->refreshed) || cap_changed(model, state, model->def.electro.refresh_change);
}

bool zp_cached_field_due(const ZpModel *model, const ZpState *state) {
  const ZpActuatorDef *def = &model->def;
  if (!model->field) return false;
  if (model->field_solved)
    return zp_cached_field_outdated(model, state) || gaps_changed(model, state, def->electro.refresh_change);
  return def->electro.refresh_period > 0 && !(state->t - state->refreshed < def->electro.refresh_period);
}

static ZpEnd refresh_beyond_plates(const ZpModel *model, ZpState *state, const double *q, ZpEval *e) {
  size_t bytes = zp_coordinates(model) * sizeof(double);
  zp_eval_cover(model, (const double[ZP_BEADS]){state->bead[0].reach, state->bead[1].reach}, e);
  if (!zp_system_solve(model, q, state->U, e)) return ZP_END_STOP;
  state->refreshed = state->t;
  memcpy(zp_state_held(model, state), e->correction.F, bytes);
  memcpy(zp_state_held_at(model, state), q, bytes);
  state->held_U = state->U;
  state->held_energy = e->correction.energy;
  state->held_charge = e->correction.charge;
  state->held_capacitance = e->correction.capacitance;
  return ZP_END_FOUND;
}

ZpEnd zp_cached_field_refresh(const ZpModel *model, ZpState *state, ZpEval *e) {
  double *q = zp_state_q(model, state);
  if (model->field_solved) return refresh_beyond_plates(model, state, q, e);
  state->refreshed = state->t;
  if (model->is_rod) /* the curve begins where the closed part points to */
    zp_rod_eval(&model->rod, q, zp_nodes(model, q).y, &e->rod);
  else
    zp_massspring_eval(&model->spring, q, zp_nodes(model, q).y, &e->spring);
  zp_bezier_attract(model, state, q, e);
  memcpy(zp_forces(model, zp_state_held(model, state)).y, e->attraction.Fy, zp_lanes(model) * sizeof(double));
  return ZP_END_FOUND;
}
