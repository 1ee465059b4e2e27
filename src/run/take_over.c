/* Continue one simulation from the state of another: a model whose values change while it runs. */
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "run/run.h"

/* Ends, halves and platforms of the same kinds? */
static bool are_alike(const ZpTopology *a, const ZpTopology *b) {
  if (zp_halves(a) != zp_halves(b) || a->joints != b->joints || a->platform.kind != b->platform.kind) return false;
  for (size_t k = 0; k < a->joints; k++)
    if (a->joint[k].kind != b->joint[k].kind) return false;
  return true;
}

static ZpStatus check_one(const ZpModel *model, const ZpModel *other, ZpError *err) {
  if (model->s != other->s || model->nodes != other->nodes)
    return zp_fail(err, ZP_BAD_INPUT,
                   "mesh.nodes = %zu: the simulation to take over from has %zu nodes on each of %zu ribbons",
                   model->nodes, other->nodes, other->s);
  if (!are_alike(&model->topology, &other->topology))
    return zp_fail(err, ZP_BAD_INPUT,
                   "the ends or the platforms differ from those of the simulation to take over from");
  return ZP_OK;
}

/* Members that share a load fit together only at the lengths that they had. */
static ZpStatus check_all(const ZpSim *sim, const ZpSim *from, ZpError *err) {
  const ZpModel *model = sim->model, *other = from->model;
  if (!zp_network_alike(model->network, other->network))
    return zp_fail(err, ZP_BAD_INPUT, "stack: the simulation to take over from has other members");
  if (zp_shares_load(model) &&
      (model->L != other->L || zp_network_depth(model->network) != zp_network_depth(other->network)))
    return zp_fail(err, ZP_BAD_INPUT,
                   "ribbon.length, platform.length, stack.distance: members that share a load must keep them");
  ZpStatus status = ZP_OK;
  for (size_t k = 0; k < model->members && status == ZP_OK; k++)
    status = check_one(model + k, other + k, err);
  return status;
}

/* Copy numbers of one kind if both models have as many; else they begin at 0. */
static void take_numbers(double *to, size_t count, const double *old, size_t known) {
  for (size_t i = 0; i < count; i++)
    to[i] = count == known ? old[i] : 0;
}

/* A law that both models have keeps its numbers; those of one that comes begin at 0: a liquid at rest, faces without
 * charge, a strip that has not yielded. */
static void take_own(ZpSim *sim, const ZpSim *from) {
  const ZpModel *model = sim->model;
  take_numbers(zp_state_own(model, sim->state), zp_extra_unknowns(model), zp_state_own(from->model, from->state),
               zp_extra_unknowns(from->model));
  for (const ZpLaw *law = model->law; law < model->law + model->laws; law++) {
    const ZpLaw *known = zp_law(from->model, law->term);
    take_numbers(zp_law_state(model, law->term, sim->state), law->state,
                 zp_law_state(from->model, law->term, from->state), known ? known->state : 0);
  }
}

/* The state of one member, scaled to its length. */
static void take_state(ZpSim *sim, const ZpSim *from) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  double opening0 = state->opening0, stretch = model->L / from->model->L;
  memcpy(state, from->state, sizeof *state + (size_t)(zp_state_own(model, state) - state->data) * sizeof(double));
  take_own(sim, from);
  memcpy(zp_state_bodies(model, state), zp_state_bodies(from->model, from->state),
         zp_state_bodies_size(model) * sizeof(double));
  double *moving[] = {zp_state_v(model, state), zp_state_mean_v(model, state), zp_state_mean_a(model, state)};
  zp_stretch(model, stretch, zp_state_q(model, state));
  for (size_t k = 0; k < sizeof moving / sizeof moving[0]; k++)
    for (size_t j = 0; j < zp_coordinates(model); j++)
      moving[k][j] *= stretch;
  state->opening0 = opening0;
}

/* Take over the drive of a member. */
static void take_drive(ZpSim *sim, const ZpSim *from) {
  ZpState *state = sim->state;
  zp_sim_lay_beads(sim);
  double voltage = zp_sim_is_fed(from) ? zp_sim_command(from) : state->U;
  if (!state->by_hand) state->voltage_input = (ZpRamp){voltage, 0, state->t, INFINITY};
  state->by_hand = true;
  if (!zp_sim_is_fed(from)) state->supply = zp_supply_at(voltage);
  state->refreshed = NAN;
  if (zp_cached_field_due(sim->model, state)) zp_cached_field_refresh(sim->model, state, &sim->eval);
  zp_control_restart(&sim->model->control, state->t, &state->control);
  zp_sim_start_balance(sim);
}

ZpStatus zp_sim_take_over(ZpSim *sim, const ZpSim *from, ZpError *err) {
  ZpStatus status = check_all(sim, from, err);
  if (status != ZP_OK) return status;
  for (size_t k = 0; k < sim->members; k++) {
    take_state(sim + k, from + k);
    take_drive(sim + k, from + k);
  }
  zp_sim_resume(sim);
  return ZP_OK;
}
