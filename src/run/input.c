/* Inputs: what a program changes while a simulation runs. Their work is booked: of the voltage by energy_balance.c, of
 * the load step by step. docs/theory.md, section 17. */
#include <math.h>

#include "base/fail.h"
#include "run/run.h"

typedef struct Input {
  const char *name, *unit;
} Input;

static const Input inputs[ZP_INPUT_COUNT] = {
    [ZP_INPUT_VOLTAGE] = {"voltage", "V"}, [ZP_INPUT_LOAD] = {"load", "N"}, [ZP_INPUT_SETPOINT] = {"setpoint", "1"}};

static const double most_load = 1e4;     /* N: the weight of the largest load.mass */
static const double most_setpoint = 1e3; /* in its unit: as setpoint.value */
static const double most_rate = 1e12;    /* per second: too fast for any time step to distinguish from a jump */

const char *zp_input_name(ZpInput input) {
  return (size_t)input < ZP_INPUT_COUNT ? inputs[input].name : "unknown";
}

/* The ramp from now on, which ends at the end of the input's range. */
static ZpRamp ramp_within(double value, double rate, double t, double least, double most) {
  double left = rate == 0 ? INFINITY : ((rate > 0 ? most : least) - value) / rate;
  return (ZpRamp){value, rate, t, t + left};
}

/* Says that, and why, it is out of range. */
static ZpStatus check_voltage(const ZpSim *sim, double voltage, ZpError *err) {
  const ZpKey *key = zp_key(sim->drive);
  bool within = voltage >= key->min && voltage <= key->max;
  ZpStatus status = ZP_OK;
  for (const ZpSim *m = sim; m < sim + sim->members && within && status == ZP_OK; m++)
    status = zp_def_check_voltage(&m->model->def, zp_member_voltage(m->model, voltage), err);
  if (within) return status;
  ZpActuatorDef scratch = sim->model->def;
  return zp_def_set(&scratch, sim->drive, voltage, err);
}

void zp_sim_hold_port(ZpSim *lead, ZpRamp voltage) {
  const ZpRamp all = voltage;
  for (size_t next = 1; next > 0; next = zp_sim_next(lead), lead += next) {
    voltage.value = zp_voltage_at_port(lead->model, all.value);
    voltage.rate = zp_part_of_port(lead->model) * all.rate;
    lead->state->by_hand = true;
    lead->state->voltage_input = voltage;
    if (!zp_sim_is_fed(lead)) zp_sim_jump(lead, voltage.value);
  }
}

void zp_sim_hold_voltage(ZpSim *sim, ZpRamp voltage) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    ZpRamp at_port = voltage;
    at_port.value = zp_port_voltage(m->model, voltage.value);
    if (m->model->apart) at_port.rate = m->model->ratio * voltage.rate;
    if (zp_leads_port(m->model)) zp_sim_hold_port(m, at_port);
  }
}

/* Whoever holds the voltage. */
static ZpStatus check_free(const ZpSim *sim, ZpInput input, ZpError *err) {
  if (input == ZP_INPUT_VOLTAGE && zp_sim_any_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "voltage: the controller sets it (control.kind); set the setpoint");
  if (input == ZP_INPUT_SETPOINT && !zp_sim_is_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "setpoint: there is no controller; set control.kind");
  return ZP_OK;
}

static ZpStatus set_voltage(ZpSim *sim, double voltage, double rate, ZpError *err) {
  const ZpKey *key = zp_key(sim->drive);
  ZpStatus status = check_voltage(sim, voltage, err);
  if (status == ZP_OK && rate > 0) status = check_voltage(sim, key->max, err);
  if (status != ZP_OK) return status;
  zp_sim_hold_voltage(sim, ramp_within(voltage, rate, sim->state->t, key->min, key->max));
  return ZP_OK;
}

static ZpStatus set_setpoint(ZpSim *sim, double setpoint, double rate, ZpError *err) {
  if (!(fabs(setpoint) <= most_setpoint))
    return zp_fail(err, ZP_BAD_INPUT, "setpoint = %g is out of range; %g to %g", setpoint, -most_setpoint,
                   most_setpoint);
  sim->state->setpoint_by_hand = true;
  sim->state->setpoint_input = ramp_within(setpoint, rate, sim->state->t, -most_setpoint, most_setpoint);
  return ZP_OK;
}

static ZpStatus set_load(ZpSim *sim, double load, double rate, ZpError *err) {
  if (!(fabs(load) <= most_load))
    return zp_fail(err, ZP_BAD_INPUT, "load = %g N is out of range; %g N to %g N", load, -most_load, most_load);
  zp_sim_loaded(sim)->state->load_input = ramp_within(load, rate, sim->state->t, -most_load, most_load);
  return ZP_OK;
}

ZpStatus zp_sim_set_input(ZpSim *sim, ZpInput input, double value, double rate, ZpError *err) {
  if ((size_t)input >= ZP_INPUT_COUNT)
    return zp_fail(err, ZP_BAD_INPUT, "input %d: there is no such input", (int)input);
  if (!(fabs(rate) <= most_rate))
    return zp_fail(err, ZP_BAD_INPUT, "%s: a rate of %g %s/s is out of range; %g to %g %s/s", inputs[input].name, rate,
                   inputs[input].unit, -most_rate, most_rate, inputs[input].unit);
  static ZpStatus (*const set[ZP_INPUT_COUNT])(ZpSim *, double, double, ZpError *) = {
      [ZP_INPUT_VOLTAGE] = set_voltage, [ZP_INPUT_LOAD] = set_load, [ZP_INPUT_SETPOINT] = set_setpoint};
  ZpStatus status = check_free(sim, input, err);
  if (status == ZP_OK) status = set[input](sim, value, rate, err);
  if (status == ZP_OK) sim->cut = false;
  return status;
}

ZpStatus zp_sim_set_voltage(ZpSim *sim, double voltage, ZpError *err) {
  return zp_sim_set_input(sim, ZP_INPUT_VOLTAGE, voltage, 0, err);
}
