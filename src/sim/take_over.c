/* One simulation continues where another was: a model whose values change while it runs. */
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "ribbon/rod_plastic.h"
#include "sim/sim_internal.h"

ZpStatus zp_sim_take_over(ZpSim *sim, const ZpSim *from, ZpError *err) {
  const ZpModel *model = sim->model, *other = from->model;
  if (model->s != other->s || model->nodes != other->nodes)
    return zp_fail(err, ZP_BAD_INPUT,
                   "mesh.nodes = %zu: the simulation to take over from has %zu nodes on each of %zu ribbons",
                   model->nodes, other->nodes, other->s);
  ZpState *state = sim->state;
  double opening0 = state->opening0, stretch = model->L / other->L;
  size_t size = zp_state_size(model), known = zp_state_size(other);
  memcpy(state, from->state, size < known ? size : known);
  if (known < size) memset((char *)state + known, 0, size - known); /* a liquid that comes is at rest */
  double *moving[] = {zp_state_v(model, state), zp_state_mean_v(model, state), zp_state_mean_a(model, state)};
  if (model->own != other->own)
    memset(zp_state_own(model, state), 0, (zp_own_unknowns(model) + model->kept) * sizeof(double));
  if (model->plastic_at != other->plastic_at || model->kept != other->kept)
    memset(zp_state_strain(model, state), 0, zp_rod_plastic_count(&model->rod) * sizeof(double));
  zp_stretch(model, stretch, zp_state_q(model, state));
  for (size_t k = 0; k < sizeof moving / sizeof moving[0]; k++)
    for (size_t j = 0; j < 2 * model->stride; j++)
      moving[k][j] *= stretch;
  state->opening0 = opening0;
  zp_sim_lay_beads(sim);
  double voltage = zp_sim_is_fed(from) ? zp_sim_command(from) : state->U;
  if (!state->by_hand) state->voltage_input = (ZpRamp){voltage, 0, state->t, INFINITY};
  state->by_hand = true;
  if (!zp_sim_is_fed(from)) state->supply = (ZpSupplyState){voltage, voltage};
  state->refreshed = NAN;
  if (zp_held_due(model, state)) zp_held_refresh(model, state, &sim->eval);
  zp_control_restart(&model->control, state->t, &state->control);
  zp_sim_start_account(sim);
  zp_sim_resume(sim);
  return ZP_OK;
}
