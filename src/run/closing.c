/* Events of a run: an actuator closes, opens again, rests, has a short circuit, or its zip front overtakes a bead. */
#include <math.h>

#include "def/check.h"
#include "run/run.h"

static double opening(const ZpModel *model, const ZpState *state) {
  return zp_last_gap(model, zp_state_motion(model, state).y);
}

static bool is_open(const ZpModel *model, const ZpState *state) {
  return opening(model, state) > zp_closed_opening(model, state->opening0);
}

static bool started_open(const ZpSim *sim) {
  return sim->step_start.opening > zp_closed_opening(sim->model, sim->state->opening0);
}

/* Is it closed, after it was open? An actuator that starts closed, as straight ribbons do, has to open first. */
static bool is_zipped(const ZpModel *model, const ZpState *state) {
  size_t margin = (size_t)model->def.contact.complete_margin;
  if (!state->was_open) return false;
  if (margin) return state->zip.front + margin >= model->topology.platform.first;
  return state->opening0 > 0 && (state->zip.platform || !is_open(model, state));
}

/* Has it closed for the first time? In sequential contact without a margin also the platform has to arrive or turn
 * back. */
static bool has_closed(const ZpModel *model, const ZpState *state) {
  if (isnan(state->zip_time)) return false;
  if (model->def.contact.complete_margin || model->def.contact.model != ZP_CONTACT_SEQUENTIAL) return true;
  return state->zip.platform || zp_platform_middle(&model->topology, zp_state_motion(model, state).vy) <= 0;
}

/* A run ends once its actuator has stayed closed, and hardly moved, for a while => how far it is from that, m;
 * INFINITY: it is open. */
static double left_to_rest(const ZpState *state) {
  static const double at_rest = 1e-4; /* of the contraction */
  const double least = at_rest * state->opening0, due = state->closed_from + ZP_STILL_TIME;
  if (isnan(state->closed_from)) return INFINITY;
  double range = zp_still_range(&state->still, state->closed_from, state->t);
  return fmax(range - least, least * (due - state->t) / ZP_STILL_TIME);
}

/* Has it stayed closed, and hardly moved, for a while? Sequential contact never opens, so there closing is enough. */
static bool stays_closed(const ZpModel *model, const ZpState *state) {
  if (model->def.contact.model == ZP_CONTACT_SEQUENTIAL) return has_closed(model, state);
  return left_to_rest(state) <= 0;
}

/* Members have closed when all have; antagonists when one has. */
static bool is_true_of(const ZpSim *sim, bool (*holds)(const ZpModel *model, const ZpState *state)) {
  size_t held = 0;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    held += holds(m->model, m->state);
  return held >= (sim->model->network->opposed ? 1 : sim->members);
}

/* Of one of two antagonists, the earlier; else of all members, the last. */
static double time_of(const ZpSim *sim, double (*instant)(const ZpState *state)) {
  const bool first = sim->model->network->opposed;
  double time = instant(sim->state);
  for (const ZpSim *m = sim + 1; m < sim + sim->members; m++) {
    double other = instant(m->state);
    if (first)
      time = fmin(time, other);
    else if (other > time || isnan(other))
      time = other;
  }
  return time;
}

bool zp_sim_stops(const ZpSim *sim, ZpStop stop) {
  if (stop == ZP_STOP_AT_END || !sim->model->field) return false;
  return is_true_of(sim, stop == ZP_STOP_CLOSED ? has_closed : stays_closed);
}

/* Distance of bare electrodes from a touch, m; INFINITY where none matters. */
static double left_to_short(const ZpModel *model, const ZpState *state) {
  if (state->U == 0 || !model->field || zp_insulation(&model->def) > 0) return INFINITY;
  return zp_plates_least_gap(&model->plates, zp_state_motion(model, state).y) - model->faces.depth;
}

/* Do electrodes without an insulator touch under a voltage? Members of a stack are pairs, which are refused without
 * one: they touch at the clip. */
static bool shorted(const ZpSim *sim) {
  return left_to_short(sim->model, sim->state) <= 0;
}

/* When the actuator closes: on the parabola of the midpoint rule, which has the opening and its rate at the start and
 * the opening at the end. */
static double crossing(const ZpModel *model, const ZpState *state, ZpStepStart start) {
  double now = opening(model, state), left = start.opening - zp_closed_opening(model, state->opening0),
         taken = state->t - start.t;
  double bend = ((now - start.opening) / taken - start.rate) / taken;
  return start.t + 2 * left / (sqrt(fmax(start.rate * start.rate - 4 * bend * left, 0)) - start.rate);
}

double zp_sim_crossing(const ZpSim *sim) {
  return crossing(sim->model, sim->state, sim->step_start);
}

/* Was that instant within the last step? */
static bool crosses(const ZpModel *model, const ZpState *state, ZpStepStart start) {
  return start.opening > zp_closed_opening(model, state->opening0) && !is_open(model, state);
}

void zp_sim_close(ZpSim *sim, ZpOpeningAt start) {
  ZpState *state = sim->state;
  state->closed_from = start.t;
  zp_still_begin(&state->still, start.opening);
  zp_still_follow(&state->still, start.t, start, (ZpOpeningAt){state->t, opening(sim->model, state)});
}

/* Has the last step closed the actuator, or opened it again? */
static void note_closing(ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  state->was_open |= started_open(sim) || is_open(model, state);
  const bool zipped = is_zipped(model, state), begins = zipped && isnan(state->closed_from);
  if (!zipped) state->closed_from = NAN;
  bool within = !sim->stepping->fine && crosses(model, state, sim->step_start);
  double since = within ? zp_sim_crossing(sim) : state->t;
  if (zipped && isnan(state->zip_time) && state->U != 0) state->zip_time = since;
  if (!zipped || isnan(state->zip_time)) return;
  const ZpOpeningAt start = {sim->step_start.t, sim->step_start.opening}, now = {state->t, opening(model, state)};
  if (begins)
    zp_sim_close(sim, within ? (ZpOpeningAt){since, zp_closed_opening(model, state->opening0)} : now);
  else
    zp_still_follow(&state->still, state->closed_from, start, now);
}

/* Has a zip front overtaken its bead? The meniscus is then where the film is thinner than the liquid equivalent to the
 * insulators. Ribbons that have been closed from the start have no front, and a bead that reaches the platform has none
 * behind it. */
static void note_starving(ZpSim *sim, const ZpMovingMember *moved) {
  const ZpModel *model = sim->model;
  ZpState *state = sim->state;
  bool zips = state->U != 0 && state->was_open && isnan(state->zip_time);
  if (!isnan(state->starved_time) || !zips) return;
  const double *gap = moved->eval.plates.gap;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    ZpBeadPlace end = zp_bead_place(&model->film, half, state->bead[half].reach);
    const bool ends_before_platform = end.near != end.far;
    if (ends_before_platform && zp_bead_at(&end, gap) < model->plates.d) state->starved_time = state->t;
  }
}

void zp_sim_note_end(ZpSim *sim, const ZpMovingMember *moved) {
  if (sim->model->field) note_closing(sim);
  if (sim->model->has_bead) note_starving(sim, moved);
}

/* -- where a run ends within a step --------------------------------------------------------------- */

static double left_to_close(const ZpModel *model, const ZpState *state) {
  return opening(model, state) - zp_closed_opening(model, state->opening0);
}

double zp_sim_left_of(const ZpSim *m, ZpLanding landing) {
  if (landing == ZP_LANDS_SHORTED) return left_to_short(m->model, m->state);
  if (landing == ZP_LANDS_RESTED) return left_to_rest(m->state);
  return left_to_close(m->model, m->state);
}

/* After closing a member may have opened again. */
static bool may_be_last(const ZpSim *m, ZpLanding landing) {
  return landing == ZP_LANDS_RESTED || isnan(m->before->zip_time);
}

size_t zp_sim_decides(const ZpSim *sim, ZpLanding landing) {
  const bool first = landing == ZP_LANDS_SHORTED || sim->model->network->opposed;
  double left = first ? INFINITY : -INFINITY;
  size_t which = 0;
  for (size_t k = 0; k < sim->members; k++) {
    const double own = zp_sim_left_of(sim + k, landing);
    if (first ? !(own < left) : !may_be_last(sim + k, landing) || !(own > left)) continue;
    left = own;
    which = k;
  }
  return which;
}

double zp_sim_left(const ZpSim *sim, ZpLanding landing) {
  return zp_sim_left_of(sim + zp_sim_decides(sim, landing), landing);
}

ZpOutcome zp_sim_end(const ZpSim *sim) {
  if (shorted(sim)) return ZP_SHORT_CIRCUIT;
  return zp_sim_stops(sim, sim->stop) ? ZP_ZIPPED : ZP_REACHED_END;
}

/* The instant within the last step at which the run ends. Where pairs join one by one it is the step's end. */
ZpLanding zp_sim_landing(const ZpSim *sim) {
  if (shorted(sim)) return ZP_LANDS_SHORTED;
  if (!zp_sim_stops(sim, sim->stop)) return ZP_LANDS_NOWHERE;
  const ZpActuatorDef *def = &sim->model->def;
  if (sim->stop == ZP_STOP_CLOSED) return def->contact.complete_margin == 0 ? ZP_LANDS_CLOSED : ZP_LANDS_NOWHERE;
  return def->contact.model == ZP_CONTACT_SEQUENTIAL ? ZP_LANDS_NOWHERE : ZP_LANDS_RESTED;
}

/* -- instants that are known ----------------------------------------------------------------------- */

double zp_sim_starved_time(const ZpSim *sim) {
  return sim->state->starved_time;
}

static double zip_time(const ZpState *state) {
  return state->zip_time;
}

static double closed_from(const ZpState *state) {
  return state->closed_from;
}

double zp_sim_zip_time(const ZpSim *sim) {
  return time_of(sim, zip_time);
}

double zp_sim_closed_from(const ZpSim *sim) {
  return time_of(sim, closed_from);
}

double zp_sim_member_zip_time(const ZpSim *sim, size_t member) {
  return sim[member - 1].state->zip_time;
}
