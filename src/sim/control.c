/* A controller of the program's own, asked at equal intervals. Its samples are corners: a step ends there, as it does
 * where a waveform turns, so the run needs no other steps for it. */
#include <math.h>

#include "base/fail.h"
#include "sim/sim_internal.h"

static const double rounding = 1e-9; /* of a period: a time that is meant to be that of a sample */

double zp_control_due(const ZpSim *sim) {
  const ZpControl *control = &sim->control;
  return control->controller.voltage ? control->since + control->taken * control->controller.period : INFINITY;
}

/* A simulation that is set to the voltage that it has anyway keeps its steps. */
bool zp_control_sample(ZpSim *sim) {
  ZpControl *control = &sim->control;
  const ZpController *controller = &control->controller;
  double t = sim->state->t;
  if (t < zp_control_due(sim)) return true;
  control->taken++;
  return zp_sim_set_voltage(sim, controller->voltage(controller->user, sim, t), &control->fault) == ZP_OK;
}

void zp_control_resume(ZpSim *sim) {
  ZpControl *control = &sim->control;
  if (!control->controller.voltage) return;
  control->taken = fmax(0, ceil((sim->state->t - control->since) / control->controller.period - rounding));
}

ZpStatus zp_sim_set_controller(ZpSim *sim, const ZpController *controller, ZpError *err) {
  static const double shortest = 1e-9, longest = 1e4; /* s */
  if (!controller) {
    sim->control = (ZpControl){.since = 0};
    return ZP_OK;
  }
  if (!controller->voltage) return zp_fail(err, ZP_BAD_INPUT, "controller: it has no function voltage");
  if (!(controller->period >= shortest && controller->period <= longest))
    return zp_fail(err, ZP_BAD_INPUT, "controller: a period of %g s is out of range; %g s to %g s", controller->period,
                   shortest, longest);
  sim->control = (ZpControl){.controller = *controller, .since = sim->state->t};
  return ZP_OK;
}
