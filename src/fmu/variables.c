/* Tables of keys, signals and inputs => variables. */
#include "fmu/variables.h"

#include <math.h>
#include <string.h>

#include <zipact/checkpoint.h>

#include "def/purpose.h"
#include "fmu/start.h"

/* First value references: far enough apart for all tables. */
enum { FIRST_INPUT = 1, FIRST_OUTPUT = 100, FIRST_PARAMETER = 1000 };

static bool is_one_of(const char *name, const char *const *list, size_t count) {
  for (size_t k = 0; k < count; k++)
    if (strcmp(name, list[k]) == 0) return true;
  return false;
}

bool zp_fmu_is_output(int index) {
  static const char *const others[] = {"time", "setpoint", "sensed_capacitance", "sensed_stroke"};
  return !is_one_of(zp_signal_name((size_t)index), others, sizeof others / sizeof others[0]);
}

bool zp_fmu_is_input(int index, bool controlled) {
  return index == ZP_INPUT_LOAD || (index == ZP_INPUT_SETPOINT) == controlled;
}

bool zp_fmu_follows(int index, ZpInput input) {
  static const char *const electric[] = {"voltage",       "force",         "charge",          "electric_work",
                                         "field_energy",  "charging_loss", "command",         "source_voltage",
                                         "source_energy", "leak_current",  "insulator_field", "energy_imbalance"};
  return input == ZP_INPUT_VOLTAGE &&
         is_one_of(zp_signal_name((size_t)index), electric, sizeof electric / sizeof electric[0]);
}

bool zp_fmu_is_parameter(int index, double value) {
  if (!zp_fmu_has_number(index) || zp_key_is_material(index) || isnan(value)) return false;
  return !(zp_key_purposes(index) & ZP_NO_PARAMETER);
}

bool zp_fmu_is_tunable(int index) {
  return !zp_checkpoint_holds(index);
}

bool zp_fmu_find(uint32_t reference, ZpFmuVariable *variable) {
  int place = reference < 1U << 30 ? (int)reference : -1;
  if (place == 0)
    *variable = (ZpFmuVariable){ZP_FMU_TIME, 0};
  else if (place >= FIRST_INPUT && place < FIRST_INPUT + ZP_INPUT_COUNT)
    *variable = (ZpFmuVariable){ZP_FMU_INPUT, place - FIRST_INPUT};
  else if (place >= FIRST_OUTPUT && place < FIRST_OUTPUT + ZP_FMU_SIGNALS && zp_fmu_is_output(place - FIRST_OUTPUT))
    *variable = (ZpFmuVariable){ZP_FMU_OUTPUT, place - FIRST_OUTPUT};
  else if (place >= FIRST_PARAMETER && place < FIRST_PARAMETER + ZP_KEYS)
    *variable = (ZpFmuVariable){ZP_FMU_PARAMETER, place - FIRST_PARAMETER};
  else
    return false;
  return true;
}

uint32_t zp_fmu_reference(ZpFmuVariable variable) {
  static const int first[] = {0, FIRST_INPUT, FIRST_OUTPUT, FIRST_PARAMETER};
  return (uint32_t)(first[variable.role] + variable.index);
}

ZpFmuText zp_fmu_text(ZpFmuVariable variable) {
  static const ZpFmuText of_input[ZP_INPUT_COUNT] = {
      {NULL, "V",
       "commanded voltage of the source; it starts at the value that the scenario's waveform has at t = 0, and the "
       "waveform is not played"},
      {NULL, "N",
       "force on the whole actuator in addition to load.mass, without inertia; positive pulls the lower platform down"},
      {NULL, "1",
       "setpoint of the controller, in the SI unit of control.signal; it starts at the value that the scenario's "
       "waveform has at t = 0, and the waveform is not played"}};
  size_t count;
  if (variable.role == ZP_FMU_TIME) return (ZpFmuText){"time", "s", "time since the start"};
  if (variable.role == ZP_FMU_INPUT) {
    ZpFmuText text = of_input[variable.index];
    text.name = zp_input_name((ZpInput)variable.index);
    return text;
  }
  if (variable.role == ZP_FMU_PARAMETER) {
    const ZpKey *key = zp_key(variable.index);
    return (ZpFmuText){key->name, key->unit, key->help};
  }
  const ZpColumn *column = &zp_signal_columns(&count)[variable.index];
  const char *name = zp_signal_name((size_t)variable.index);
  return (ZpFmuText){strcmp(name, zp_input_name(ZP_INPUT_VOLTAGE)) == 0 ? "electrode_voltage" : name, column->unit,
                     column->help};
}

ZpKeyType zp_fmu_type(ZpFmuVariable variable) {
  ZpKeyType type = variable.role == ZP_FMU_PARAMETER ? zp_key(variable.index)->type : ZP_KEY_REAL;
  return type == ZP_KEY_REAL_AUTO ? ZP_KEY_REAL : type;
}
