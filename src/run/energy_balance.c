/* The account of energy: what the source has delivered, and the part of it that the field did not keep. docs/theory.md,
 * section 17.
 *
 * It was last closed at the voltage base_U; since then positions have moved at that voltage. It counts charge from
 * base_charge. A jump to another voltage stays open until the next motion. So a voltage that is replaced before then,
 * which lasted no time, does not count, and reading the account changes nothing. The account is closed at once only if
 * what is held over several steps must be computed again for the new voltage. */
#include <math.h>
#include <string.h>

#include "def/rule.h"
#include "run/run.h"

/* Work of ideal sources at U0 during the motion and of their jump to U1, between the states `before` and `after` the
 * jump. */
static ZpBalance charged(const ZpSim *sim, ZpElectric before, ZpElectric after) {
  const ZpState *state = sim->state;
  double lost = *zp_state_row(sim->model, sim->state, &zp_row_charging_loss);
  double U0 = state->base_U, U1 = state->U, given = U1 * (after.charge - before.charge);
  double kept = zp_field_energy(after, U1) - zp_field_energy(before, U0);
  return (ZpBalance){state->work + U0 * (before.charge - state->base_charge) + given,
                     lost + (U1 == U0 ? 0 : given - kept)};
}

ZpBalance zp_sim_energy_balance(ZpSim *sim, ZpElectric now) {
  const ZpState *state = sim->state;
  if (state->U == state->base_U) return charged(sim, now, now);
  return charged(sim, zp_system_electric_now(sim->model, state, state->base_U, &sim->eval), now);
}

ZpLeakNow zp_sim_leak(ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  if (!model->leaks) return (ZpLeakNow){0, 0, 0, 0};
  ZpMotion m = zp_state_motion(model, state);
  ZpSpan now = zp_span_of(model, state, m.x, m.vx);
  zp_term_gaps(model, &now, &sim->eval);
  return zp_leak_now(&model->leak, &model->plates, &sim->eval.plates, state->U,
                     zp_law_memory(model, &zp_term_leak, zp_state_memory(model, state)));
}

const ZpPose *zp_sim_poses(const ZpSim *first) {
  zp_plane_poses(&first->dynamics.plane, 0, zp_state_bodies(first->model, first->state), first->pose);
  return first->pose;
}

/* Of one that moves up and down. */
static double height_of(const ZpSim *first, size_t body) {
  const ZpNetwork *network = first->model->network;
  if (network->body[body].held) return network->body[body].y;
  const ZpSight at = zp_sight_of_body(first->model, body);
  const ZpSim *leader = first + at.member;
  return at.origin + at.sign * *zp_coordinate(leader->model, zp_state_q(leader->model, leader->state), at.coordinate);
}

ZpPose zp_sim_place(const ZpSim *first, size_t body) {
  const ZpNetwork *network = first->model->network;
  if (network->plane) return zp_plane_place(&first->dynamics.plane, body, zp_sim_poses(first));
  return (ZpPose){network->body[body].x, height_of(first, body), network->body[body].angle};
}

double zp_sim_lifted(const ZpSim *first) {
  const ZpNetwork *network = first->model->network;
  double work = 0;
  for (size_t b = 1; b < network->bodies; b++) {
    const ZpBody *body = &network->body[b];
    const ZpPose at = zp_sim_place(first, b);
    if (body->held) continue;
    work += (body->mass * first->model->whole->gravity - body->force[1]) * at.y;
    if (network->plane) work -= body->force[0] * at.x + body->torque * at.turn;
  }
  return work;
}

/* Kinetic energy of bodies without the platforms on them, whose nodes have theirs, J. */
static double bodies_in_motion(const ZpSim *sim) {
  const ZpPlanar *plane = &sim->dynamics.plane;
  const ZpNetwork *network = sim->model->network;
  const double *rate = zp_state_bodies(sim->model, sim->state) + network->unknowns;
  const ZpPose *pose = zp_sim_poses(sim);
  double sum = 0;
  for (size_t b = 0; b < network->bodies; b++) {
    const ZpVector v = zp_plane_rate(plane, b, pose, plane->body[b].place, 0, rate);
    const double turns = zp_plane_change(plane, b, ZP_WAY_TURNS, 0, rate);
    sum += 0.5 * (network->body[b].mass * zp_along(v, v) + network->body[b].inertia * turns * turns);
  }
  return sum;
}

void zp_sim_add_springs(const ZpSim *sim, double *ledger) {
  const ZpNetwork *network = sim->model->network;
  if (network->plane) {
    const ZpSim *first = sim - sim->model->number;
    const ZpLinks *links = &first->dynamics.links;
    const ZpPose *pose = zp_sim_poses(first);
    double *weight = zp_ledger_at(sim->model, ledger, &zp_row_gravity_energy);
    *weight += zp_links_ribbons_energy(links, sim->model->number, pose, zp_state_q(sim->model, sim->state));
    if (sim != first) return;
    *weight += zp_links_weight_energy(links, pose);
    *zp_ledger_at(sim->model, ledger, &zp_row_spring_energy) +=
        zp_links_energy(links, pose, zp_state_strains(sim->model, sim->state));
    ledger[0] += bodies_in_motion(sim);
    return;
  }
  for (size_t k = 0; sim->model->number == 0 && k < network->springs; k++) {
    const ZpLink *link = &network->spring[k];
    const double length = height_of(sim, link->body[0]) - height_of(sim, link->body[1]);
    *zp_ledger_at(sim->model, ledger, &zp_row_spring_energy) += zp_link_energy(link, length) / sim->model->parts;
  }
}

void zp_sim_start_balance(ZpSim *sim) {
  ZpState *state = sim->state;
  double *ledger = zp_state_ledger(sim->model, state);
  memset(ledger, 0, sim->model->ledger.rows * sizeof *ledger);
  zp_system_now(sim->model, state, &sim->eval, ledger);
  zp_sim_add_springs(sim, ledger);
  ZpElectric now = zp_system_electric_now(sim->model, state, state->U, &sim->eval);
  state->work = state->load_work = 0;
  state->source_energy = 0;
  *zp_ledger_at(sim->model, ledger, &zp_row_field_energy) = zp_field_energy(now, state->U);
  state->base_charge = now.charge;
  state->base_U = state->U;
}

/* A field that cannot be solved remains due, and ends the run before the next step. */
void zp_sim_close_balance(ZpSim *sim) {
  ZpState *state = sim->state;
  ZpElectric before = zp_system_electric_now(sim->model, state, state->base_U, &sim->eval);
  if (zp_cached_field_due(sim->model, state)) zp_cached_field_refresh(sim->model, state, &sim->eval);
  ZpElectric after = zp_system_electric_now(sim->model, state, state->U, &sim->eval);
  ZpBalance account = charged(sim, before, after);
  state->work = account.work;
  *zp_state_row(sim->model, state, &zp_row_charging_loss) = account.charging_loss;
  state->base_charge = after.charge;
  state->base_U = state->U;
}

void zp_sim_jump(ZpSim *sim, double voltage) {
  ZpState *state = sim->state;
  if (voltage == state->U) return;
  state->U = voltage;
  if (!zp_cached_field_outdated(sim->model, state)) return;
  state->refreshed = NAN;
  zp_sim_close_balance(sim);
}

void zp_sim_glide(ZpSim *sim, double voltage) {
  ZpState *state = sim->state;
  if (voltage == state->U) return;
  if (state->U != state->base_U) zp_sim_close_balance(sim);
  ZpElectric before = zp_system_electric_now(sim->model, state, state->U, &sim->eval),
             after = zp_system_electric_now(sim->model, state, voltage, &sim->eval);
  state->work += state->U * (before.charge - state->base_charge) + zp_field_energy(after, voltage) -
                 zp_field_energy(before, state->U);
  state->base_charge = after.charge;
  state->base_U = state->U = voltage;
}
