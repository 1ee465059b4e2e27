/* FMI 3.0 for co-simulation. */
#include "fmu/export/fmi3.h"

#include <math.h>

#include "fmu/export/slave.h"

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

/* -- what the table of functions calls ------------------------------------------------------------- */

static ZpSlaveStatus enter_initialization(ZpSlave *slave, double start, double tolerance, double stop) {
  ZpSlaveStatus status = zp_slave_setup(slave, start, tolerance, stop);
  return status < ZP_SLAVE_DISCARD ? zp_slave_worse(status, zp_slave_move(slave, ZP_FMU_INITIALIZING)) : status;
}

static bool uses_events(const ZpSlave *slave) {
  return slave && slave->uses_events;
}

/* Every variable is a scalar. */
static ZpSlaveStatus wrong_length(const ZpSlave *slave) {
  return zp_slave_say(slave, ZP_SLAVE_ERROR, "seeds and sensitivities must be one number for each variable");
}

static ZpSlaveStatus step(ZpSlave *slave, fmi3Float64 now, fmi3Float64 size, fmi3Boolean *event, fmi3Boolean *terminate,
                          fmi3Boolean *early, fmi3Float64 *reached) {
  ZpFmuStep step;
  ZpSlaveStatus status = zp_slave_step(slave, now, size, &step);
  *event = step.event;
  *terminate = step.terminate;
  *reached = slave->fmu->time;
  *early = status == ZP_SLAVE_OK && *reached < now + size;
  return status;
}

/* There are no discrete states: an event ends as soon as it is handled. */
static ZpSlaveStatus end_event(const ZpSlave *slave, fmi3Boolean *again, fmi3Boolean *terminate,
                               fmi3Boolean *nominals_changed, fmi3Boolean *states_changed, fmi3Boolean *next_defined,
                               fmi3Float64 *next) {
  *again = *nominals_changed = *states_changed = *next_defined = false;
  *terminate = slave->terminates;
  *next = INFINITY;
  return ZP_SLAVE_OK;
}

/* The standard gives the functions their parameters. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define ZP_FMI_VERSION    3
#define ZP_FMI_NAME(name) fmi3##name
#define ZP_FMI_DEFINES
#include "fmu/export/functions.def"
