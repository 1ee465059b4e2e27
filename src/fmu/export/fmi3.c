/* FMI 3.0 for co-simulation. */
#include "fmu/export/fmi3.h"

#include <math.h>

#include "fmu/export/slave.h"

enum {
  RUNNING = ZP_FMU_STEPPING | ZP_FMU_AT_EVENT,
  SETTABLE = ZP_FMU_INSTANTIATED | ZP_FMU_INITIALIZING | RUNNING,
  READABLE = ZP_FMU_INITIALIZING | RUNNING | ZP_FMU_TERMINATED
};

const char *fmi3GetVersion(void) {
  return "3.0";
}

/* -- life ------------------------------------------------------------------------------------------ */

static void hand_over(const ZpSlave *slave, ZpSlaveStatus status, const char *category, const char *message) {
  fmi3LogMessageCallback hand = (fmi3LogMessageCallback)slave->callback;
  hand(slave->environment, (fmi3Status)status, category, message);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean uses_events, fmi3Boolean returns_early,
                                         const fmi3ValueReference intermediate[], size_t count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  const ZpSlave like = {.log = log ? hand_over : NULL,
                        .logging = logging,
                        .uses_events = uses_events,
                        .returns_early = returns_early,
                        .environment = environment,
                        .callback = (void (*)(void))log};
  (void)resources, (void)visible, (void)intermediate, (void)update;
  if (count == 0) return zp_slave_create(&like, name, token);
  return zp_slave_refuse(&like, name, "this FMU has no intermediate update: it needs no intermediate variables");
}

static fmi3Instance refuse(fmi3String name, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                           const char *why) {
  const ZpSlave like = {.log = log ? hand_over : NULL, .environment = environment, .callback = (void (*)(void))log};
  return zp_slave_refuse(&like, name, why);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  (void)token, (void)resources, (void)visible, (void)logging;
  return refuse(name, environment, log, "this FMU is for co-simulation, not for model exchange");
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
  (void)token, (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
  return refuse(name, environment, log, "this FMU is for co-simulation, not for scheduled execution");
}

void fmi3FreeInstance(fmi3Instance instance) {
  zp_slave_destroy(instance);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t count, const fmi3String category[]) {
  ZpSlave *slave = instance;
  (void)count, (void)category;
  if (!zp_slave_allows(slave, ZP_FMU_ANY, "fmi3SetDebugLogging")) return fmi3Error;
  slave->logging = on;
  return fmi3OK;
}

/* Change from one of `phases` to another phase. */
static fmi3Status move(ZpSlave *slave, unsigned phases, ZpFmuPhase next, const char *what) {
  if (!slave || !zp_slave_allows(slave, phases, what)) return fmi3Error;
  slave->fmu->phase = next;
  return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop) {
  if (!zp_slave_allows(instance, ZP_FMU_INSTANTIATED, "fmi3EnterInitializationMode")) return fmi3Error;
  ZpSlaveStatus status = zp_slave_setup(instance, start, has_tolerance ? tolerance : NAN, has_stop ? stop : INFINITY);
  if (status >= ZP_SLAVE_DISCARD) return (fmi3Status)status;
  ((ZpSlave *)instance)->fmu->phase = ZP_FMU_INITIALIZING;
  return (fmi3Status)status;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  const ZpSlave *slave = instance;
  if (!zp_slave_allows(slave, ZP_FMU_INITIALIZING, "fmi3ExitInitializationMode")) return fmi3Error;
  ZpFmuPhase next = slave->uses_events ? ZP_FMU_AT_EVENT : ZP_FMU_STEPPING;
  return (fmi3Status)zp_slave_exit_initialization(instance, next);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  const ZpSlave *slave = instance;
  unsigned phases = slave && slave->uses_events ? ZP_FMU_STEPPING : 0;
  return move(instance, phases, ZP_FMU_AT_EVENT, "fmi3EnterEventMode");
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return move(instance, ZP_FMU_AT_EVENT, ZP_FMU_STEPPING, "fmi3EnterStepMode");
}

/* There are no structural parameters. */
fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return move(instance, 0, ZP_FMU_INSTANTIATED, "fmi3EnterConfigurationMode");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return move(instance, 0, ZP_FMU_INSTANTIATED, "fmi3ExitConfigurationMode");
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return move(instance, RUNNING, ZP_FMU_TERMINATED, "fmi3Terminate");
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return zp_slave_allows(instance, ZP_FMU_ANY, "fmi3Reset") ? (fmi3Status)zp_slave_reset(instance) : fmi3Error;
}

/* -- variables ------------------------------------------------------------------------------------- */

/* The functions of a type that has variables: every variable has one value. */
#define VARIABLES_OF_TYPE(Type, type)                                                                                  \
  fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference reference[], size_t count,                  \
                           fmi3##Type value[], size_t values) {                                                        \
    ZpSlaveStatus worst = values == count ? ZP_SLAVE_OK : ZP_SLAVE_ERROR;                                              \
    if (!zp_slave_allows(instance, READABLE, "fmi3Get" #Type)) return fmi3Error;                                       \
    for (size_t k = 0; k < count && values == count; k++) {                                                            \
      double number = 0;                                                                                               \
      ZpSlaveStatus status = zp_slave_get(instance, reference[k], type, &number);                                      \
      value[k] = (fmi3##Type)number;                                                                                   \
      worst = status > worst ? status : worst;                                                                         \
    }                                                                                                                  \
    return (fmi3Status)worst;                                                                                          \
  }                                                                                                                    \
  fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference reference[], size_t count,                  \
                           const fmi3##Type value[], size_t values) {                                                  \
    ZpSlaveStatus worst = values == count ? ZP_SLAVE_OK : ZP_SLAVE_ERROR;                                              \
    if (!zp_slave_allows(instance, SETTABLE, "fmi3Set" #Type)) return fmi3Error;                                       \
    for (size_t k = 0; k < count && values == count; k++) {                                                            \
      ZpSlaveStatus status = zp_slave_set(instance, reference[k], type, (double)value[k]);                             \
      worst = status > worst ? status : worst;                                                                         \
    }                                                                                                                  \
    return (fmi3Status)worst;                                                                                          \
  }

VARIABLES_OF_TYPE(Float64, ZP_KEY_REAL)
VARIABLES_OF_TYPE(Int32, ZP_KEY_INT)
VARIABLES_OF_TYPE(Int64, ZP_KEY_ENUM)
VARIABLES_OF_TYPE(Boolean, ZP_KEY_BOOL)

/* A call for a type without variables: it is correct only if it requests none. */
static fmi3Status of_none(ZpSlave *slave, unsigned phases, const char *what, size_t count) {
  if (!zp_slave_allows(slave, phases, what)) return fmi3Error;
  return count == 0 ? fmi3OK : (fmi3Status)zp_slave_say(slave, ZP_SLAVE_ERROR, "there is no variable of this type");
}

/* Every variable is a scalar. */
static fmi3Status wrong_length(const ZpSlave *slave) {
  return (fmi3Status)zp_slave_say(slave, ZP_SLAVE_ERROR,
                                  "seeds and sensitivities must be one number for each variable");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknown[], size_t unknowns,
                                        const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[],
                                        size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities) {
  if (!zp_slave_allows(instance, READABLE, "fmi3GetDirectionalDerivative")) return fmi3Error;
  if (seeds != knowns || sensitivities != unknowns) return wrong_length(instance);
  return (fmi3Status)zp_slave_derivative(instance, false, unknown, unknowns, known, knowns, seed, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknown[], size_t unknowns,
                                    const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[],
                                    size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities) {
  if (!zp_slave_allows(instance, READABLE, "fmi3GetAdjointDerivative")) return fmi3Error;
  if (seeds != unknowns || sensitivities != knowns) return wrong_length(instance);
  return (fmi3Status)zp_slave_derivative(instance, true, unknown, unknowns, known, knowns, seed, sensitivity);
}

/* -- states ---------------------------------------------------------------------------------------- */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3GetFMUState")) return fmi3Error;
  return (fmi3Status)zp_slave_get_state(instance, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3SetFMUState")) return fmi3Error;
  return (fmi3Status)zp_slave_set_state(instance, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3FreeFMUState")) return fmi3Error;
  zp_slave_free_state(state);
  return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3SerializedFMUStateSize")) return fmi3Error;
  return (fmi3Status)zp_slave_state_size(instance, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3SerializeFMUState")) return fmi3Error;
  return (fmi3Status)zp_slave_serialize(instance, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
  if (!zp_slave_allows(instance, ZP_FMU_ANY, "fmi3DeserializeFMUState")) return fmi3Error;
  return (fmi3Status)zp_slave_deserialize(instance, bytes, size, state);
}

/* -- steps ----------------------------------------------------------------------------------------- */

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 now, fmi3Float64 size, fmi3Boolean no_return_before,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached) {
  const ZpSlave *slave = instance;
  ZpFmuStep step;
  (void)no_return_before;
  if (!zp_slave_allows(slave, ZP_FMU_STEPPING, "fmi3DoStep")) return fmi3Error;
  fmi3Status status = (fmi3Status)zp_slave_step(instance, now, size, &step);
  *event = step.event;
  *terminate = step.terminate;
  *reached = slave->fmu->time;
  *early = status == fmi3OK && *reached < now + size;
  return status;
}

/* There are no discrete states: an event ends as soon as it is handled. */
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return of_none(instance, ZP_FMU_INITIALIZING | ZP_FMU_AT_EVENT, "fmi3EvaluateDiscreteStates", 0);
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *next_defined, fmi3Float64 *next) {
  const ZpSlave *slave = instance;
  if (!zp_slave_allows(slave, ZP_FMU_AT_EVENT, "fmi3UpdateDiscreteStates")) return fmi3Error;
  *again = *nominals_changed = *states_changed = *next_defined = false;
  *terminate = slave->terminates;
  *next = INFINITY;
  return fmi3OK;
}

/* -- what is refused -------------------------------------------------------------------------------- */

/* The standard gives these functions their parameters. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define ZP_NO_TYPE(Type)                                                                                               \
  ZP_NONE(                                                                                                             \
      Get##Type, READABLE, count,                                                                                      \
      (fmi3Instance instance, const fmi3ValueReference reference[], size_t count, fmi3##Type value[], size_t values))  \
  ZP_NONE(Set##Type, SETTABLE, count,                                                                                  \
          (fmi3Instance instance, const fmi3ValueReference reference[], size_t count, const fmi3##Type value[],        \
           size_t values))
#define ZP_NONE(name, phases, asked, parameters)                                                                       \
  fmi3Status fmi3##name parameters {                                                                                   \
    return of_none(instance, phases, "fmi3" #name, asked);                                                             \
  }
#define ZP_EXCHANGE(name, parameters)                                                                                  \
  fmi3Status fmi3##name parameters {                                                                                   \
    return (fmi3Status)zp_slave_exchange(instance, "fmi3" #name);                                                      \
  }
#include "fmu/export/fmi3_refused.def"
