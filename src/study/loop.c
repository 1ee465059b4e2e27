#include "study/loop.h"

#include <math.h>

#include "drive/response.h"
#include "study/notes.h"

_Static_assert(sizeof(ZpResponseSample) == ZP_SAMPLE_COLUMNS * sizeof(double), "a row of the table is a sample");

ZpTable *zp_loop_watch(ZpSim *sim) {
  const ZpActuatorDef *def = zp_model_def(sim->model);
  size_t columns;
  const ZpColumn *column = zp_sample_columns(&columns);
  ZpTable *samples = zp_table_create(column, columns, (size_t)(def->solver.end_time / def->control.period) + 4);
  zp_sim_keep_samples(sim, samples);
  return samples;
}

/* A setpoint that the controller asks for in vain. */
static void note_limit(const ZpSim *sim, const ZpResponse *response, ZpResult *result) {
  static const double little = 0.02; /* of the setpoint */
  double highest = sim->model->control.highest, command = zp_sim_is_fed(sim) ? zp_sim_command(sim) : sim->state->U;
  bool at_limit = command == 0 || command == highest;
  if (at_limit && fabs(response->error) > little * fabs(zp_sim_setpoint(sim)))
    zp_result_note(
        result,
        "the setpoint is not held: the run ends with the controller at its limit of %g V (its range is 0 V to "
        "drive.voltage)",
        command);
}

void zp_loop_summarize(ZpSim *sim, ZpTable *samples, ZpResult *result) {
  zp_table_offer(samples, (double[ZP_SAMPLE_COLUMNS]){sim->state->t, zp_sim_setpoint(sim), zp_sim_controlled(sim)});
  ZpResponse response = zp_response_of((const ZpResponseSample *)(const void *)samples->value, samples->rows);
  const char *unit = zp_control_unit(zp_model_def(sim->model));
  zp_result_add(result, "rise_time_s", "s", response.rise_time);
  zp_result_add(result, "overshoot", "1", response.overshoot);
  zp_result_add(result, "steady_state_error", unit, response.error);
  zp_result_add(result, "steady_state_ripple", unit, response.ripple);
  zp_result_add(result, "settling_time_s", "s", response.settling_time);
  note_limit(sim, &response, result);
}
