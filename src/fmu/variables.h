/* The variables of an FMU: inputs that a program can change, outputs from the table of signals, parameters from the
 * table of keys. Their value references say what they are. */
#ifndef ZP_FMU_VARIABLES_H
#define ZP_FMU_VARIABLES_H

#include <stdint.h>

#include <zipact/sim.h>

/* Places of the signals in a row, and their number. */
#define ZP_SIGNAL(name, unit, suffix, help) ZP_FMU_SIGNAL_##name,
enum {
#include <zipact/signals.def>
  ZP_FMU_SIGNALS
};
#undef ZP_SIGNAL

typedef enum ZpFmuRole { ZP_FMU_TIME, ZP_FMU_INPUT, ZP_FMU_OUTPUT, ZP_FMU_PARAMETER } ZpFmuRole;

/* A variable: its role, and which input, signal or key it is. */
typedef struct ZpFmuVariable {
  ZpFmuRole role;
  int index;
} ZpFmuVariable;

/* value reference <=> variable. False if there is none with that reference. Whether a key is a parameter also depends
 * on its value: zp_fmu_is_parameter. */
bool zp_fmu_find(uint32_t reference, ZpFmuVariable *variable);
uint32_t zp_fmu_reference(ZpFmuVariable variable);

/* Its name: "voltage", "opening", "ribbon.length". The voltage between the electrodes is called electrode_voltage,
 * because the input has its name. */
const char *zp_fmu_name(ZpFmuVariable variable);

/* Its unit and one line about it. Keys without a unit and words: "1". */
const char *zp_fmu_unit(ZpFmuVariable variable);
const char *zp_fmu_help(ZpFmuVariable variable);

/* The type of its values, which getters and setters of the standards have in their names: ZP_KEY_REAL, _INT, _BOOL or
 * _ENUM. */
ZpKeyType zp_fmu_type(ZpFmuVariable variable);

/* Is signal `index` an output? All but the time, the setpoint, which is an input, and what only a study finds. */
bool zp_fmu_is_output(int index);

/* Has an FMU of these keys that input? With a controller the setpoint takes the place of the voltage. */
bool zp_fmu_is_input(int index, bool controlled);

/* Does output `index` follow the input at once, while nothing moves? */
bool zp_fmu_follows(int index, ZpInput input);

/* Is key `index` a parameter where its value is `value`? Keys of the actuator and its solver with a number or a word;
 * not the drive nor the setpoint, which the inputs replace, nor `auto` and `none`, for which no tool has a number. */
bool zp_fmu_is_parameter(int index, double value);

/* Can parameter `index` change while the simulation runs? Gains of the controller, its noise and what steps may err by
 * can. What makes the actuator, its supply or its liquid cannot, since the state is one of these. */
bool zp_fmu_is_tunable(int index);

#endif
