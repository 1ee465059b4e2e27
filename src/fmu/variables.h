/* The variables of an FMU: inputs that a program can change, outputs from the table of signals, parameters from the
 * table of keys. Their value references encode their role. */
#ifndef ZP_FMU_VARIABLES_H
#define ZP_FMU_VARIABLES_H

#include <stdint.h>

#include "def/def.h"
#include "run/info.h"

/* Positions of the signals in a row, and their number. */
#define ZP_SIGNAL(name, unit, suffix, help) ZP_FMU_SIGNAL_##name,
#define ZP_ROW(name)                        ZP_FMU_SIGNAL_##name,
enum {
#include "run/columns.def"
  ZP_FMU_SIGNALS
};

/* Largest number of members and of bodies of a network in an FMU, of its inputs, and of its outputs, which are the
 * signals, then numbers of members and bodies. */
enum {
  ZP_FMU_MEMBERS = 256,
  ZP_FMU_INPUTS = ZP_INPUT_COUNT + 5 * ZP_FMU_MEMBERS,
  ZP_FMU_OUTPUTS = ZP_FMU_SIGNALS + 6 * ZP_FMU_MEMBERS
};
#undef ZP_SIGNAL
#undef ZP_ROW

typedef enum ZpFmuRole { ZP_FMU_TIME, ZP_FMU_INPUT, ZP_FMU_OUTPUT, ZP_FMU_PARAMETER } ZpFmuRole;

/* A variable: its role, and its input, output or key. */
typedef struct ZpFmuVariable {
  ZpFmuRole role;
  int index;
} ZpFmuVariable;

/* value reference <=> variable. False if no variable has that reference. Whether a key is a parameter also depends on
 * its value: zp_fmu_is_parameter. */
bool zp_fmu_find(uint32_t reference, ZpFmuVariable *variable);
uint32_t zp_fmu_reference(ZpFmuVariable variable);

/* Its name, "voltage", "opening" or "ribbon.length", of a network "left.opening", "hand.y" or
 * "members.left.ribbon.length"; its unit, "1" of keys without one and of words; a line of help. The voltage between the
 * electrodes is called electrode_voltage, because the input has the name voltage. */
enum { ZP_FMU_NAME_SIZE = ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE };
typedef struct ZpFmuText {
  char name[ZP_FMU_NAME_SIZE];
  const char *unit, *help;
} ZpFmuText;
ZpFmuText zp_fmu_text(const ZpActuatorDef *def, ZpFmuVariable variable);

/* Numbers in a row: signals and, of a network, those of members and bodies. */
int zp_fmu_outputs(const ZpActuatorDef *def);

/* The type of its values, which selects the getter and setter of the standards: ZP_KEY_REAL, _INT, _BOOL or _ENUM. */
ZpKeyType zp_fmu_type(ZpFmuVariable variable);

/* Is number `index` of a row an output? All are, except the time, the setpoint, which is an input, and signals that
 * only a study computes. */
bool zp_fmu_is_output(int index);

/* Does output `index` respond to the input at once, without motion? */
bool zp_fmu_follows(const ZpActuatorDef *def, int index, int input);

/* Is key `index` a parameter if its value is `value`? Parameters are keys of the actuator and its solver with a number
 * or a word; not the drive and the setpoint, which the inputs replace, and not `auto` and `none`, which a tool cannot
 * represent. */
bool zp_fmu_is_parameter(int index, double value);

/* Can parameter `index` change during a simulation? Gains and noise of the controller and the tolerance of steps can.
 * Parameters of the actuator, its supply or its liquid cannot, because they define the state. */
bool zp_fmu_is_tunable(int index);

#endif
