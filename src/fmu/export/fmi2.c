/* FMI 2.0 for co-simulation. */
#include "fmu/export/fmi2.h"

#include <math.h>

#include "fmu/export/slave.h"

enum {
  SETTABLE = ZP_FMU_INSTANTIATED | ZP_FMU_INITIALIZING | ZP_FMU_STEPPING,
  READABLE = ZP_FMU_INITIALIZING | ZP_FMU_STEPPING | ZP_FMU_TERMINATED
};

const char *fmi2GetTypesPlatform(void) {
  return "default";
}

const char *fmi2GetVersion(void) {
  return "2.0";
}

/* -- life ------------------------------------------------------------------------------------------ */

/* The logger takes a format with further arguments, which few importers written in other languages can read: the
 * message comes without. */
static void hand_over(const ZpSlave *slave, ZpSlaveStatus status, const char *category, const char *message) {
  const fmi2CallbackFunctions *functions = slave->functions;
  char format[2 * sizeof((ZpError *)0)->message];
  size_t length = 0;
  for (; *message && length + 2 < sizeof format; message++) {
    if (*message == '%') format[length++] = '%';
    format[length++] = *message;
  }
  format[length] = 0;
  functions->logger(functions->componentEnvironment, slave->name, (fmi2Status)status, category, format);
}

fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
  (void)resources, (void)visible;
  const ZpSlave like = {.log = functions && functions->logger ? hand_over : NULL,
                        .logging = logging != fmi2False,
                        .functions = functions};
  if (type == fmi2CoSimulation) return zp_slave_create(&like, instance, guid);
  return zp_slave_refuse(&like, instance, "this FMU is for co-simulation, not for model exchange");
}

void fmi2FreeInstance(fmi2Component c) {
  zp_slave_destroy(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String category[]) {
  ZpSlave *slave = c;
  (void)count, (void)category;
  if (!zp_slave_allows(slave, ZP_FMU_ANY, "fmi2SetDebugLogging")) return fmi2Error;
  slave->logging = on != fmi2False;
  return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  if (!zp_slave_allows(c, ZP_FMU_INSTANTIATED, "fmi2SetupExperiment")) return fmi2Error;
  return (fmi2Status)zp_slave_setup(c, start, has_tolerance ? tolerance : NAN, has_stop ? stop : INFINITY);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  ZpSlave *slave = c;
  if (!zp_slave_allows(slave, ZP_FMU_INSTANTIATED, "fmi2EnterInitializationMode")) return fmi2Error;
  slave->fmu->phase = ZP_FMU_INITIALIZING;
  return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  if (!zp_slave_allows(c, ZP_FMU_INITIALIZING, "fmi2ExitInitializationMode")) return fmi2Error;
  return (fmi2Status)zp_slave_exit_initialization(c, ZP_FMU_STEPPING);
}

fmi2Status fmi2Terminate(fmi2Component c) {
  ZpSlave *slave = c;
  if (!zp_slave_allows(slave, ZP_FMU_STEPPING, "fmi2Terminate")) return fmi2Error;
  slave->fmu->phase = ZP_FMU_TERMINATED;
  return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
  return zp_slave_allows(c, ZP_FMU_ANY, "fmi2Reset") ? (fmi2Status)zp_slave_reset(c) : fmi2Error;
}

/* -- variables ------------------------------------------------------------------------------------- */

/* The functions of one type: they differ only in the type of the values. All values are processed; the worst status is
 * returned. */
#define VARIABLES_OF_TYPE(Type, type)                                                                                  \
  fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2##Type value[]) {  \
    ZpSlaveStatus worst = ZP_SLAVE_OK;                                                                                 \
    if (!zp_slave_allows(c, READABLE, "fmi2Get" #Type)) return fmi2Error;                                              \
    for (size_t k = 0; k < count; k++) {                                                                               \
      double number = 0;                                                                                               \
      ZpSlaveStatus status = zp_slave_get(c, reference[k], type, &number);                                             \
      value[k] = (fmi2##Type)number;                                                                                   \
      worst = status > worst ? status : worst;                                                                         \
    }                                                                                                                  \
    return (fmi2Status)worst;                                                                                          \
  }                                                                                                                    \
  fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference reference[], size_t count,                        \
                           const fmi2##Type value[]) {                                                                 \
    ZpSlaveStatus worst = ZP_SLAVE_OK;                                                                                 \
    if (!zp_slave_allows(c, SETTABLE, "fmi2Set" #Type)) return fmi2Error;                                              \
    for (size_t k = 0; k < count; k++) {                                                                               \
      ZpSlaveStatus status = zp_slave_set(c, reference[k], type, (double)value[k]);                                    \
      worst = status > worst ? status : worst;                                                                         \
    }                                                                                                                  \
    return (fmi2Status)worst;                                                                                          \
  }

/* FMI 2 passes enumerations as integers. */
static ZpKeyType integer_type(fmi2ValueReference reference) {
  ZpFmuVariable variable;
  bool words = zp_fmu_find(reference, &variable) && zp_fmu_type(variable) == ZP_KEY_ENUM;
  return words ? ZP_KEY_ENUM : ZP_KEY_INT;
}

VARIABLES_OF_TYPE(Real, ZP_KEY_REAL)
VARIABLES_OF_TYPE(Integer, integer_type(reference[k]))
VARIABLES_OF_TYPE(Boolean, ZP_KEY_BOOL)

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2String value[]) {
  (void)reference, (void)value;
  if (!zp_slave_allows(c, READABLE, "fmi2GetString")) return fmi2Error;
  return count == 0 ? fmi2OK : (fmi2Status)zp_slave_say(c, ZP_SLAVE_ERROR, "there is no variable of type String");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                         const fmi2String value[]) {
  (void)reference, (void)value;
  if (!zp_slave_allows(c, SETTABLE, "fmi2SetString")) return fmi2Error;
  return count == 0 ? fmi2OK : (fmi2Status)zp_slave_say(c, ZP_SLAVE_ERROR, "there is no variable of type String");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns,
                                        const fmi2ValueReference known[], size_t knowns, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
  if (!zp_slave_allows(c, READABLE, "fmi2GetDirectionalDerivative")) return fmi2Error;
  return (fmi2Status)zp_slave_derivative(c, false, unknown, unknowns, known, knowns, seed, sensitivity);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  const ZpSlave *slave = c;
  ZpError err;
  ZpSlaveStatus worst = ZP_SLAVE_OK;
  if (!zp_slave_allows(slave, SETTABLE, "fmi2SetRealInputDerivatives")) return fmi2Error;
  for (size_t k = 0; k < count; k++) {
    if (order[k] != 1)
      return (fmi2Status)zp_slave_say(slave, ZP_SLAVE_ERROR, "only first derivatives of inputs are supported");
    ZpSlaveStatus status = zp_slave_after(slave, zp_fmu_set_rate(slave->fmu, reference[k], value[k], &err), &err);
    worst = status > worst ? status : worst;
  }
  return (fmi2Status)worst;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                        const fmi2Integer order[], fmi2Real value[]) {
  (void)reference, (void)order, (void)value;
  if (!zp_slave_allows(c, READABLE, "fmi2GetRealOutputDerivatives")) return fmi2Error;
  return count == 0 ? fmi2OK
                    : (fmi2Status)zp_slave_say(c, ZP_SLAVE_ERROR,
                                               "derivatives of outputs with respect to time are not available");
}

/* -- states ---------------------------------------------------------------------------------------- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
  return zp_slave_allows(c, ZP_FMU_ANY, "fmi2GetFMUstate") ? (fmi2Status)zp_slave_get_state(c, state) : fmi2Error;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return zp_slave_allows(c, ZP_FMU_ANY, "fmi2SetFMUstate") ? (fmi2Status)zp_slave_set_state(c, state) : fmi2Error;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
  if (!zp_slave_allows(c, ZP_FMU_ANY, "fmi2FreeFMUstate")) return fmi2Error;
  zp_slave_free_state(state);
  return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
  if (!zp_slave_allows(c, ZP_FMU_ANY, "fmi2SerializedFMUstateSize")) return fmi2Error;
  return (fmi2Status)zp_slave_state_size(c, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  if (!zp_slave_allows(c, ZP_FMU_ANY, "fmi2SerializeFMUstate")) return fmi2Error;
  return (fmi2Status)zp_slave_serialize(c, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  if (!zp_slave_allows(c, ZP_FMU_ANY, "fmi2DeSerializeFMUstate")) return fmi2Error;
  return (fmi2Status)zp_slave_deserialize(c, bytes, size, state);
}

/* -- steps ----------------------------------------------------------------------------------------- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real size, fmi2Boolean no_return_before) {
  ZpFmuStep step;
  (void)no_return_before;
  if (!zp_slave_allows(c, ZP_FMU_STEPPING, "fmi2DoStep")) return fmi2Error;
  fmi2Status status = (fmi2Status)zp_slave_step(c, now, size, &step);
  return status == fmi2OK && step.terminate ? fmi2Discard : status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
  zp_slave_allows(c, 0, "fmi2CancelStep"); /* no step is ever pending */
  return fmi2Error;
}

static fmi2Status no_status(fmi2Component c, const char *what) {
  if (!zp_slave_allows(c, ZP_FMU_ANY, what)) return fmi2Error;
  return (fmi2Status)zp_slave_say(c, ZP_SLAVE_DISCARD, "no such status, because a step is never pending");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real *value) {
  const ZpSlave *slave = c;
  if (kind != fmi2LastSuccessfulTime || !slave) return no_status(c, "fmi2GetRealStatus");
  *value = slave->fmu->time;
  return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean *value) {
  const ZpSlave *slave = c;
  if (kind != fmi2Terminated || !slave) return no_status(c, "fmi2GetBooleanStatus");
  *value = slave->terminates ? fmi2True : fmi2False;
  return fmi2OK;
}

/* -- what is refused -------------------------------------------------------------------------------- */

/* The standard gives these functions their parameters. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define ZP_STATUS(name, parameters)                                                                                    \
  fmi2Status fmi2##name parameters {                                                                                   \
    return no_status(c, "fmi2" #name);                                                                                 \
  }
#define ZP_EXCHANGE(name, parameters)                                                                                  \
  fmi2Status fmi2##name parameters {                                                                                   \
    return (fmi2Status)zp_slave_exchange(c, "fmi2" #name);                                                             \
  }
#include "fmu/export/fmi2_refused.def"
