/* Tables of keys, signals and inputs => variables. */
#include "fmu/variables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/checkpoint.h>

#include "def/purpose.h"
#include "def/rule.h"
#include "fmu/start.h"

/* First value references: far enough apart for all tables. */
enum {
  FIRST_INPUT = 1,
  FIRST_OUTPUT = 100,
  FIRST_PARAMETER = 1000,
  FIRST_INPUT_OF_NETWORK = 100000,
  FIRST_OUTPUT_OF_NETWORK = 200000,
  FIRST_PARAMETER_OF_NETWORK = 1000000
};
_Static_assert(FIRST_PARAMETER + ZP_KEYS <= FIRST_INPUT_OF_NETWORK, "references are different");

static bool is_one_of(const char *name, const char *const *list, size_t count) {
  for (size_t k = 0; k < count; k++)
    if (strcmp(name, list[k]) == 0) return true;
  return false;
}

/* Numbers of a member in a row, and of a body, behind the signals. */
static const ZpColumn of_member[] = {{"opening", "m", "distance between the platforms' faces of this member"},
                                     {"zipped_length", "m", "closed length of one half of this member"},
                                     {"electrode_voltage", "V", "voltage between the electrodes of this member"}};
enum { OF_MEMBER = sizeof of_member / sizeof of_member[0], VOLTAGE_OF_MEMBER = OF_MEMBER - 1 };

static const ZpColumn of_body[] = {{"x", "m", "place of the body, to the right"},
                                   {"y", "m", "height of the body"},
                                   {"angle", "rad", "angle of the body, anticlockwise"}};
enum { IN_PLANE = sizeof of_body / sizeof of_body[0], UP = 1 };

/* A body that moves up and down has a height alone. */
static int of_each_body(const ZpActuatorDef *def) {
  return zp_def_plane(def) ? IN_PLANE : 1;
}

int zp_fmu_outputs(const ZpActuatorDef *def) {
  if (!zp_def_network(def)) return ZP_FMU_SIGNALS;
  return ZP_FMU_SIGNALS + OF_MEMBER * zp_def_members(def) + of_each_body(def) * zp_instance_count(def, ZP_OF_BODY);
}

bool zp_fmu_is_output(int index) {
  static const char *const others[] = {"time", "setpoint", "sensed_capacitance", "sensed_stroke"};
  return index >= ZP_FMU_SIGNALS || !is_one_of(zp_signal_name((size_t)index), others, sizeof others / sizeof others[0]);
}

/* Does it set a voltage? */
static bool is_voltage(const ZpActuatorDef *def, int input) {
  int which;
  return zp_def_input_member(def, input, &which) >= 0 && which == ZP_INPUT_VOLTAGE;
}

bool zp_fmu_follows(const ZpActuatorDef *def, int index, int input) {
  static const char *const electric[] = {"voltage",       "force",         "charge",          "electric_work",
                                         "field_energy",  "charging_loss", "command",         "source_voltage",
                                         "source_energy", "leak_current",  "insulator_field", "energy_imbalance"};
  const int beyond = index - ZP_FMU_SIGNALS;
  const bool of_members = beyond >= 0 && beyond < OF_MEMBER * zp_def_members(def);
  if (!is_voltage(def, input)) return false;
  if (beyond >= 0) return of_members && beyond % OF_MEMBER == VOLTAGE_OF_MEMBER;
  return is_one_of(zp_signal_name((size_t)index), electric, sizeof electric / sizeof electric[0]);
}

bool zp_fmu_is_parameter(int index, double value) {
  const int row = zp_key_instance(index).row;
  const bool meters = row >= ZP_KEY(member_K.sense.frequency) && row <= ZP_KEY(member_K.sense.seed);
  const bool shapes = meters || zp_key_is_name(index) || row == ZP_KEY(body_K.moves); /* the outputs, too */
  if (index >= ZP_KEYS) return !shapes && !isnan(value);
  if (!zp_fmu_has_number(index) || zp_key_is_material(index) || isnan(value)) return false;
  return !(zp_key_purposes(index) & ZP_NO_PARAMETER);
}

bool zp_fmu_is_tunable(int index) {
  return index < ZP_KEYS && !zp_checkpoint_holds(index);
}

/* Of each role: its first references, of one actuator and of what is beyond it in a network, and where that begins. */
typedef struct Range {
  int first, of_network, beyond, most;
} Range;
static const Range range[] = {[ZP_FMU_TIME] = {0, 0, 1, 0},
                              [ZP_FMU_INPUT] = {FIRST_INPUT, FIRST_INPUT_OF_NETWORK, ZP_INPUT_COUNT, ZP_FMU_INPUTS},
                              [ZP_FMU_OUTPUT] = {FIRST_OUTPUT, FIRST_OUTPUT_OF_NETWORK, ZP_FMU_SIGNALS, ZP_FMU_OUTPUTS},
                              [ZP_FMU_PARAMETER] = {FIRST_PARAMETER, FIRST_PARAMETER_OF_NETWORK, ZP_KEYS, 1 << 29}};

bool zp_fmu_find(uint32_t reference, ZpFmuVariable *variable) {
  const int place = reference < 1U << 30 ? (int)reference : -1;
  *variable = (ZpFmuVariable){ZP_FMU_TIME, 0};
  if (place == 0) return true;
  for (int role = ZP_FMU_INPUT; role <= ZP_FMU_PARAMETER; role++) {
    const int one = place - range[role].first, other = place - range[role].of_network + range[role].beyond;
    const bool is_one = one >= 0 && one < range[role].beyond,
               is_other = other >= range[role].beyond && other < range[role].most;
    if (!is_one && !is_other) continue;
    *variable = (ZpFmuVariable){(ZpFmuRole)role, is_one ? one : other};
    return role != ZP_FMU_OUTPUT || zp_fmu_is_output(variable->index);
  }
  return false;
}

uint32_t zp_fmu_reference(ZpFmuVariable variable) {
  const int beyond = variable.index - range[variable.role].beyond;
  if (beyond >= 0) return (uint32_t)(range[variable.role].of_network + beyond);
  return (uint32_t)(range[variable.role].first + variable.index);
}

static ZpFmuText text_of_input(const ZpActuatorDef *def, int input) {
  static const char *const help[ZP_INPUT_COUNT] = {
      "commanded voltage of the source; it starts at the value that the scenario's waveform has at t = 0, and the "
      "waveform is not played",
      "force on the whole actuator in addition to load.mass, without inertia; positive pulls the lower platform down",
      "setpoint of the controller, in the SI unit of control.signal; it starts at the value that the scenario's "
      "waveform has at t = 0, and the waveform is not played"};
  static const char of_body[] = "on the body, in addition to its force and torque, without inertia; forces act at its "
                                "place, torques anticlockwise";
  int which;
  const bool port = zp_def_input_member(def, input, &which) >= 0;
  ZpFmuText text = {.unit = zp_def_input_unit(def, input), .help = port ? help[which] : of_body};
  char name[ZP_INPUT_NAME_SIZE];
  const char *found = zp_def_input_name(def, input, name);
  snprintf(text.name, sizeof text.name, "%s", found ? found : zp_input_name((ZpInput)input));
  return text;
}

/* A number of a member or of a body. */
static ZpFmuText text_beyond(const ZpActuatorDef *def, int index) {
  const int at = index - OF_MEMBER * zp_def_members(def), each = of_each_body(def);
  const bool member = at < 0;
  const ZpColumn *column = member ? &of_member[index % OF_MEMBER] : &of_body[each == 1 ? UP : at % each];
  char room[ZP_NAME_SIZE];
  ZpFmuText text = {.unit = column->unit, .help = column->help};
  snprintf(text.name, sizeof text.name, "%s.%s",
           member ? zp_def_name(def, ZP_OF_MEMBER, index / OF_MEMBER + 1, room)
                  : zp_def_name(def, ZP_OF_BODY, at / each + 1, room),
           column->name);
  return text;
}

/* "members.left.ribbon.length" */
static ZpFmuText text_of_key(const ZpActuatorDef *def, int index) {
  const ZpKey *key = zp_key(index);
  ZpFmuText text = {.unit = key->unit, .help = key->help};
  snprintf(text.name, sizeof text.name, "%s", ZP_KEY_SHOWN(def, index));
  return text;
}

ZpFmuText zp_fmu_text(const ZpActuatorDef *def, ZpFmuVariable variable) {
  size_t count;
  if (variable.role == ZP_FMU_TIME) return (ZpFmuText){.name = "time", .unit = "s", .help = "time since the start"};
  if (variable.role == ZP_FMU_INPUT) return text_of_input(def, variable.index);
  if (variable.role == ZP_FMU_PARAMETER) return text_of_key(def, variable.index);
  if (variable.index >= ZP_FMU_SIGNALS) return text_beyond(def, variable.index - ZP_FMU_SIGNALS);
  const ZpColumn *column = &zp_signal_columns(&count)[variable.index];
  const char *name = zp_signal_name((size_t)variable.index);
  ZpFmuText text = {.unit = column->unit, .help = column->help};
  snprintf(text.name, sizeof text.name, "%s",
           strcmp(name, zp_input_name(ZP_INPUT_VOLTAGE)) == 0 ? "electrode_voltage" : name);
  return text;
}

ZpKeyType zp_fmu_type(ZpFmuVariable variable) {
  ZpKeyType type = variable.role == ZP_FMU_PARAMETER ? zp_key(variable.index)->type : ZP_KEY_REAL;
  return type == ZP_KEY_REAL_AUTO ? ZP_KEY_REAL : type;
}
