/* Inputs: what a program changes while a simulation runs. Their work is booked: of the voltage by energy_balance.c, of
 * the load step by step. docs/theory.md, section 17. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/instances.h"
#include "def/rule.h"
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

/* -- of a network ---------------------------------------------------------------------------------- */

/* An input beyond those of one actuator: of member 1 .. or of body 1 .. */
typedef struct Named {
  int member, body; /* 0: it is none of them */
  int which;        /* 0: voltage, 1: setpoint; a ZpWay */
} Named;

enum { OF_MEMBER = 2 };

static Named named(const ZpActuatorDef *def, int input) {
  const int members = zp_def_members(def), from = input - ZP_INPUT_COUNT, beyond = from - OF_MEMBER * members;
  const int bodies = zp_instance_count(def, ZP_OF_BODY);
  if (from < 0 || !zp_def_network(def) || beyond >= ZP_WAYS * bodies) return (Named){0};
  if (beyond < 0) return (Named){.member = 1 + from / OF_MEMBER, .which = from % OF_MEMBER};
  return (Named){.body = 1 + beyond / ZP_WAYS, .which = beyond % ZP_WAYS};
}

static int last_input(const ZpActuatorDef *def) {
  if (!zp_def_network(def)) return ZP_INPUT_COUNT;
  return ZP_INPUT_COUNT + OF_MEMBER * zp_def_members(def) + ZP_WAYS * zp_instance_count(def, ZP_OF_BODY);
}

static bool is_controlled(const ZpActuatorDef *def, int member) {
  return zp_def_member(def, member).control.kind != ZP_CONTROL_NONE;
}

/* Does a member have a port of its own, or its first one, whose voltage is set, or whose setpoint? */
static bool has_port(const ZpActuatorDef *def, int member, bool setpoint) {
  return zp_def_port(def, member) == member && is_controlled(def, member) == setpoint;
}

/* Is a member on the port of all? */
static bool has_common_port(const ZpActuatorDef *def, bool controlled) {
  bool has = false;
  for (int k = 1; k <= zp_def_members(def); k++)
    has |= zp_def_port(def, k) == 0;
  return has && (def->control.kind != ZP_CONTROL_NONE) == controlled;
}

static bool exists(const ZpActuatorDef *def, int input) {
  const bool network = zp_def_network(def);
  if (input < 0) return false;
  if (input == ZP_INPUT_LOAD) return !network;
  if (input < ZP_INPUT_COUNT)
    return network ? has_common_port(def, input == ZP_INPUT_SETPOINT)
                   : (input == ZP_INPUT_SETPOINT) == (def->control.kind != ZP_CONTROL_NONE);
  const Named of = named(def, input);
  if (of.member > 0) return has_port(def, of.member, of.which == 1);
  if (of.body == 0) return false;
  const double moves = zp_def_get(def, zp_key_of_instance(ZP_KEY(body_K.moves), of.body));
  return moves == ZP_MOVES_PLANE || (moves == ZP_MOVES_VERTICAL && of.which == ZP_WAY_UP);
}

int zp_def_input_next(const ZpActuatorDef *def, int input) {
  for (int next = input + 1; def && next < last_input(def); next++)
    if (exists(def, next)) return next;
  return -1;
}

static const Input of_member[] = {{"voltage", "V"}, {"setpoint", "1"}};
static const Input of_body[] = {{"force_x", "N"}, {"force_y", "N"}, {"torque", "N m"}};

const char *zp_def_input_name(const ZpActuatorDef *def, int input, char text[ZP_INPUT_NAME_SIZE]) {
  char called[ZP_NAME_SIZE];
  if (!def || !exists(def, input)) return NULL;
  if (input < ZP_INPUT_COUNT) {
    snprintf(text, ZP_INPUT_NAME_SIZE, "%s", inputs[input].name);
    return text;
  }
  const Named of = named(def, input);
  if (of.member > 0)
    snprintf(text, ZP_INPUT_NAME_SIZE, "%s.%s", zp_def_name(def, ZP_OF_MEMBER, of.member, called),
             of_member[of.which].name);
  else
    snprintf(text, ZP_INPUT_NAME_SIZE, "%s.%s", zp_def_name(def, ZP_OF_BODY, of.body, called), of_body[of.which].name);
  return text;
}

const char *zp_def_input_unit(const ZpActuatorDef *def, int input) {
  if (!def || input < 0 || !exists(def, input)) return NULL;
  const Named of = named(def, input);
  return input < ZP_INPUT_COUNT ? inputs[input].unit
         : of.member > 0        ? of_member[of.which].unit
                                : of_body[of.which].unit;
}

int zp_def_input_find(const ZpActuatorDef *def, const char *name) {
  char text[ZP_INPUT_NAME_SIZE];
  for (int input = zp_def_input_next(def, -1); input >= 0; input = zp_def_input_next(def, input))
    if (strcmp(zp_def_input_name(def, input, text), name) == 0) return input;
  return -1;
}

int zp_def_input_member(const ZpActuatorDef *def, int input, int *which) {
  *which = input;
  if (input < ZP_INPUT_COUNT) return 0;
  const Named of = named(def, input);
  if (of.member > 0) *which = of.which == 0 ? ZP_INPUT_VOLTAGE : ZP_INPUT_SETPOINT;
  return of.member > 0 ? of.member : -1;
}

static ZpStatus forget_port(ZpActuatorDef *def, int member, ZpError *err) {
  const ZpActuatorDef one = zp_def_member(def, member);
  const ZpDriveTable none = {0};
  const ZpWaveform voltage = zp_waveform_of(&one, &none), setpoint = zp_setpoint_of(&one, &none);
  const bool scaled = zp_def_get(def, zp_key_of_instance(ZP_KEY(member_K.drive.scaled), member)) != 0,
             controlled = one.control.kind != ZP_CONTROL_NONE;
  const ZpAssignment as_ramp[] = {{ZP_KEY(member_K.drive.voltage), zp_waveform_largest(&voltage)},
                                  {ZP_KEY(member_K.drive.waveform), ZP_WAVEFORM_RAMP},
                                  {ZP_KEY(member_K.drive.offset), zp_waveform_voltage(&voltage, 0)},
                                  {ZP_KEY(member_K.drive.rise_time), 1},
                                  {ZP_KEY(member_K.drive.scaled), scaled}};
  ZpStatus status =
      zp_instances_take_away(def, member, ZP_KEY(member_K.drive.voltage), ZP_KEY(member_K.source.model) - 1, err);
  if (status == ZP_OK)
    status = zp_instances_take_away(def, member, ZP_KEY(member_K.setpoint.value), ZP_KEY(member_K.setpoint.duty), err);
  for (size_t k = 0; k < (controlled ? 1 : sizeof as_ramp / sizeof as_ramp[0]) && status == ZP_OK; k++)
    status = zp_instances_set(def, zp_key_of_instance(as_ramp[k].key, member), as_ramp[k].value, err);
  if (status != ZP_OK || !controlled) return status;
  return zp_instances_set(def, zp_key_of_instance(ZP_KEY(member_K.setpoint.value), member),
                          zp_waveform_voltage(&setpoint, 0), err);
}

ZpStatus zp_def_forget_ports(ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int k = 1; k <= zp_def_members(def) && status == ZP_OK; k++)
    if (zp_def_port(def, k) == k) status = forget_port(def, k, err);
  return status;
}

/* -- setting --------------------------------------------------------------------------------------- */

/* The ramp from now on, which ends at the end of the input's range. */
static ZpRamp ramp_within(double value, double rate, double t, double least, double most) {
  double left = rate == 0 ? INFINITY : ((rate > 0 ? most : least) - value) / rate;
  return (ZpRamp){value, rate, t, t + left};
}

/* The lowest voltage of a member's port: below 0 V only where one on it depends on the sign. */
static double least_voltage(const ZpSim *lead) {
  double least = 0;
  for (const ZpSim *m = lead; m; m = zp_sim_next(m) > 0 ? m + zp_sim_next(m) : NULL)
    if (zp_def_drives(&m->model->def, true)) least = zp_key(lead->drive)->min;
  return least;
}

/* Says that, and why, it is out of range. */
static ZpStatus check_voltage(const ZpSim *sim, double voltage, ZpError *err) {
  const ZpKey *key = zp_key(sim->drive);
  bool within = voltage >= key->min && voltage <= key->max;
  ZpStatus status = ZP_OK;
  for (const ZpSim *m = sim; m < sim + sim->members && within && status == ZP_OK; m++) {
    status = zp_check_sign(&m->model->def, "drive.voltage", voltage, err);
    if (status == ZP_OK) status = zp_def_check_voltage(&m->model->def, zp_member_voltage(m->model, voltage), err);
  }
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

void zp_sim_hold_common_port(ZpSim *sim, ZpRamp voltage) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (!m->model->apart && zp_leads_port(m->model)) zp_sim_hold_port(m, voltage);
}

ZpSim *zp_sim_port_of(ZpSim *sim, int input) {
  if (input == ZP_INPUT_VOLTAGE) return sim;
  const Named of = named(sim->model->whole, input);
  return of.member > 0 && of.which == 0 ? sim + of.member - 1 : NULL;
}

/* Whoever holds the voltage. */
static ZpStatus check_free(const ZpSim *sim, ZpInput input, ZpError *err) {
  if (zp_is_network(sim->model)) {
    if (exists(sim->model->whole, (int)input)) return ZP_OK;
    return zp_fail(err, ZP_BAD_INPUT, "%s: the network has no such input; name the member or the body",
                   zp_input_name(input));
  }
  if (input == ZP_INPUT_VOLTAGE && zp_sim_any_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "voltage: the controller sets it (control.kind); set the setpoint");
  if (input == ZP_INPUT_SETPOINT && !zp_sim_is_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "setpoint: there is no controller; set control.kind");
  return ZP_OK;
}

/* By one of two ways to hold it. */
static ZpStatus hold(ZpSim *sim, double voltage, double rate, void (*way)(ZpSim *sim, ZpRamp voltage), ZpError *err) {
  const ZpKey *key = zp_key(sim->drive);
  ZpStatus status = check_voltage(sim, voltage, err);
  if (status == ZP_OK && rate > 0) status = check_voltage(sim, key->max, err);
  if (status == ZP_OK) way(sim, ramp_within(voltage, rate, sim->state->t, least_voltage(sim), key->max));
  return status;
}

static ZpStatus set_voltage(ZpSim *sim, double voltage, double rate, ZpError *err) {
  return hold(sim, voltage, rate, zp_is_network(sim->model) ? zp_sim_hold_common_port : zp_sim_hold_voltage, err);
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

/* Voltage of a port of its own, in the range of drive.voltage. */
static ZpStatus set_port(ZpSim *lead, double voltage, double rate, ZpError *err) {
  const ZpKey *key = zp_key(lead->drive);
  const double worst = rate > 0 ? key->max : voltage;
  ZpActuatorDef scratch = lead->model->def;
  ZpStatus status = zp_def_set(&scratch, lead->drive, voltage, err);
  for (ZpSim *m = lead; m && status == ZP_OK; m = zp_sim_next(m) > 0 ? m + zp_sim_next(m) : NULL) {
    status = zp_check_sign(&m->model->def, ZP_KEY_NAME(lead->drive), voltage, err);
    if (status == ZP_OK) status = zp_def_check_voltage(&m->model->def, worst, err);
  }
  if (status == ZP_OK)
    zp_sim_hold_port(lead, ramp_within(voltage, rate, lead->state->t, least_voltage(lead), key->max));
  return status;
}

/* An input of a member or a body. */
static ZpStatus set_named(ZpSim *sim, int input, double value, double rate, ZpError *err) {
  const Named of = named(sim->model->whole, input);
  if (of.member > 0 && of.which == 0) return set_port(sim + of.member - 1, value, rate, err);
  if (of.member > 0) return set_setpoint(sim + of.member - 1, value, rate, err);
  if (!(fabs(value) <= most_load))
    return zp_fail(err, ZP_BAD_INPUT, "%s = %g is out of range; %g to %g",
                   zp_def_input_name(sim->model->whole, input, (char[ZP_INPUT_NAME_SIZE]){0}), value, -most_load,
                   most_load);
  *zp_state_push(sim->model, sim->state, (size_t)of.body, (size_t)of.which) =
      ramp_within(value, rate, sim->state->t, -most_load, most_load);
  return ZP_OK;
}

ZpStatus zp_sim_set_input(ZpSim *sim, ZpInput input, double value, double rate, ZpError *err) {
  char text[ZP_INPUT_NAME_SIZE];
  const ZpActuatorDef *def = sim->model->whole;
  const bool beyond = (size_t)input >= ZP_INPUT_COUNT;
  const char *name = beyond ? zp_def_input_name(def, (int)input, text) : inputs[input].name,
             *unit = beyond ? zp_def_input_unit(def, (int)input) : inputs[input].unit;
  if (!name) return zp_fail(err, ZP_BAD_INPUT, "input %d: there is no such input", (int)input);
  if (!(fabs(rate) <= most_rate))
    return zp_fail(err, ZP_BAD_INPUT, "%s: a rate of %g %s/s is out of range; %g to %g %s/s", name, rate, unit,
                   -most_rate, most_rate, unit);
  if (beyond) {
    ZpStatus status = set_named(sim, (int)input, value, rate, err);
    if (status == ZP_OK) sim->cut = false;
    return status;
  }
  static ZpStatus (*const set[ZP_INPUT_COUNT])(ZpSim *, double, double, ZpError *) = {
      [ZP_INPUT_VOLTAGE] = set_voltage, [ZP_INPUT_LOAD] = set_load, [ZP_INPUT_SETPOINT] = set_setpoint};
  ZpStatus status = check_free(sim, input, err);
  if (status == ZP_OK) status = set[input](sim, value, rate, err);
  if (status == ZP_OK) sim->cut = false;
  return status;
}

/* The reason why `name` is not an input: with the nearest one, or the few of an actuator. */
static ZpStatus refuse_name(const ZpActuatorDef *def, const char *name, ZpError *err) {
  char one[ZP_INPUT_NAME_SIZE], nearest[ZP_INPUT_NAME_SIZE] = "";
  int least = INT_MAX;
  for (int input = zp_def_input_next(def, -1); input >= 0; input = zp_def_input_next(def, input)) {
    const int distance = zp_word_distance(zp_def_input_name(def, input, one), name);
    if (distance < least) memcpy(nearest, one, sizeof one);
    least = distance < least ? distance : least;
  }
  if (zp_def_network(def)) return zp_fail(err, ZP_BAD_INPUT, "%.80s: unknown input; did you mean %s?", name, nearest);
  return zp_fail(err, ZP_BAD_INPUT, "%.80s: unknown input; use %s or load", name,
                 zp_input_name(is_controlled(def, 1) ? ZP_INPUT_SETPOINT : ZP_INPUT_VOLTAGE));
}

ZpStatus zp_sim_set_input_named(ZpSim *sim, const char *name, double value, double rate, ZpError *err) {
  const ZpActuatorDef *def = sim->model->whole;
  int input = zp_def_input_find(def, name);
  for (int k = 0; k < ZP_INPUT_COUNT && input < 0; k++) /* not of this one: the refusal says why */
    if (strcmp(inputs[k].name, name) == 0) input = k;
  return input < 0 ? refuse_name(def, name, err) : zp_sim_set_input(sim, (ZpInput)input, value, rate, err);
}

ZpStatus zp_sim_set_voltage(ZpSim *sim, double voltage, ZpError *err) {
  if (!zp_is_network(sim->model)) return zp_sim_set_input(sim, ZP_INPUT_VOLTAGE, voltage, 0, err);
  if (zp_sim_any_controlled(sim))
    return zp_fail(err, ZP_BAD_INPUT, "voltage: a controller sets that of a channel (control.kind); set each input");
  sim->cut = false;
  return hold(sim, voltage, 0, zp_sim_hold_voltage, err);
}
