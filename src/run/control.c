/* Controllers: the one of the model (control.kind), or one of the program's own, asked at equal intervals. Samples and
 * outputs are corners: a step ends there, as it does where a waveform turns, so the run needs no other steps for them.
 */
#include <math.h>

#include "base/fail.h"
#include "run/run.h"

static const double rounding = 1e-9; /* of a period: a time that is meant to be that of a sample */

bool zp_sim_any_controlled(const ZpSim *sim) {
  bool any = false;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    any |= zp_sim_is_controlled(m);
  return any;
}

/* -- of the model ---------------------------------------------------------------------------------- */

double zp_sim_setpoint(const ZpSim *sim) {
  const ZpState *state = sim->state;
  if (!zp_sim_is_controlled(sim)) return 0;
  return state->setpoint_by_hand ? zp_ramp_value(&state->setpoint_input, state->t)
                                 : zp_waveform_voltage(&sim->model->setpoint, state->t);
}

static double capacitance_at_port(ZpSim *lead, int signal) {
  ZpSim *m = lead;
  double sum = zp_sim_own_signal(m, signal);
  while (zp_sim_next(m) > 0)
    sum += zp_sim_own_signal(m += zp_sim_next(m), signal);
  return sum;
}

double zp_sim_controlled(ZpSim *sim) {
  const ZpModel *model = sim->model;
  if (model->def.control.signal == ZP_CONTROL_ANGLE && model->network->plane)
    return zp_sim_place(sim - model->number, model->network->ends[model->number].lower).turn;
  const char *name = zp_key(sim->signal)->choices[sim->model->def.control.signal].word;
  if (model->def.control.signal == ZP_CONTROL_CAPACITANCE) return capacitance_at_port(sim, zp_signal_find(name));
  const bool alone = sim->model->apart || zp_is_network(sim->model);
  return alone ? zp_sim_own_signal(sim, zp_signal_find(name)) : zp_sim_get(sim, name);
}

void zp_sim_start_control(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    if (!zp_sim_is_controlled(m)) continue;
    m->state->control = zp_control_start();
    zp_sim_hold_port(m, (ZpRamp){0, 0, m->state->t, INFINITY});
  }
}

const ZpColumn *zp_sample_columns(size_t *count) {
  static const ZpColumn column[ZP_SAMPLE_COLUMNS] = {{"time_s", "s", "time of the sample"},
                                                     {"setpoint", "1", "setpoint of the controller"},
                                                     {"signal", "1", "measured signal, without noise"}};
  *count = ZP_SAMPLE_COLUMNS;
  return column;
}

void zp_sim_keep_samples(ZpSim *sim, ZpTable *samples) {
  sim->samples = samples;
}

static void take_sample(ZpSim *sim) {
  double setpoint = zp_sim_setpoint(sim), signal = zp_sim_controlled(sim);
  zp_control_sample(&sim->model->control, setpoint, signal, &sim->state->control);
  if (sim->samples) zp_table_offer(sim->samples, (double[ZP_SAMPLE_COLUMNS]){sim->state->t, setpoint, signal});
}

static void give_output(ZpSim *sim) {
  const ZpControl *c = &sim->model->control;
  ZpState *state = sim->state;
  while (state->t >= zp_control_output_time(c, &state->control))
    zp_sim_hold_port(sim, (ZpRamp){zp_control_output(&state->control), 0, state->t, INFINITY});
}

/* -- of the program -------------------------------------------------------------------------------- */

static double own_sample_time(const ZpOwnControl *own) {
  return own->controller.voltage ? own->since + own->taken * own->controller.period : INFINITY;
}

/* A simulation that is set to its present voltage keeps its steps. */
static bool ask(ZpSim *sim) {
  ZpOwnControl *own = &sim->control;
  const ZpController *controller = &own->controller;
  double t = sim->state->t;
  if (t < own_sample_time(own)) return true;
  own->taken++;
  return zp_sim_set_voltage(sim, controller->voltage(controller->user, sim, t), &own->fault) == ZP_OK;
}

void zp_sim_resume_control(ZpSim *sim) {
  ZpOwnControl *own = &sim->control;
  if (!own->controller.voltage) return;
  own->taken = fmax(0, ceil((sim->state->t - own->since) / own->controller.period - rounding));
}

ZpStatus zp_sim_set_controller(ZpSim *sim, const ZpController *controller, ZpError *err) {
  static const double shortest = 1e-9, longest = 1e4; /* s */
  if (!controller) {
    sim->control = (ZpOwnControl){.since = 0};
    return ZP_OK;
  }
  if (zp_sim_any_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "controller: the model already has that of control.kind; use control.kind none");
  if (!controller->voltage) return zp_fail(err, ZP_BAD_INPUT, "controller: its function `voltage` is missing");
  if (!(controller->period >= shortest && controller->period <= longest))
    return zp_fail(err, ZP_BAD_INPUT, "controller: a period of %g s is out of range; %g s to %g s", controller->period,
                   shortest, longest);
  sim->control = (ZpOwnControl){.controller = *controller, .since = sim->state->t};
  return ZP_OK;
}

/* -- both ------------------------------------------------------------------------------------------ */

double zp_sim_control_due(const ZpSim *m) {
  const ZpControl *c = &m->model->control;
  const ZpControlState *state = &m->state->control;
  if (!zp_sim_is_controlled(m)) return own_sample_time(&m->control);
  return fmin(zp_control_sample_time(c, state), zp_control_output_time(c, state));
}

/* Controllers of several ports sample before any of them gives its output. */
bool zp_sim_control(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_sim_is_controlled(m) && m->state->t >= zp_control_sample_time(&m->model->control, &m->state->control))
      take_sample(m);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (zp_sim_is_controlled(m)) give_output(m);
  return ask(sim);
}
