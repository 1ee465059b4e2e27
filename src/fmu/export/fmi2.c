/* FMI 2.0 for co-simulation. */
#include "fmu/export/fmi2.h"

#include <math.h>

#include "fmu/export/slave.h"

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

/* -- what the table of functions calls ------------------------------------------------------------- */

/* FMI 2 passes enumerations as integers. */
static ZpKeyType integer_type(fmi2ValueReference reference) {
  ZpFmuVariable variable;
  bool words = zp_fmu_find(reference, &variable) && zp_fmu_type(variable) == ZP_KEY_ENUM;
  return words ? ZP_KEY_ENUM : ZP_KEY_INT;
}

static ZpSlaveStatus set_rates(const ZpSlave *slave, const fmi2ValueReference reference[], size_t count,
                               const fmi2Integer order[], const fmi2Real value[]) {
  ZpError err;
  ZpSlaveStatus worst = ZP_SLAVE_OK;
  for (size_t k = 0; k < count; k++) {
    if (order[k] != 1) return zp_slave_say(slave, ZP_SLAVE_ERROR, "only first derivatives of inputs are supported");
    ZpStatus status = zp_fmu_set_rate(slave->fmu, reference[k], value[k], &err);
    worst = zp_slave_worse(worst, zp_slave_after(slave, status, &err));
  }
  return worst;
}

static ZpSlaveStatus step(ZpSlave *slave, fmi2Real now, fmi2Real size) {
  ZpFmuStep step;
  ZpSlaveStatus status = zp_slave_step(slave, now, size, &step);
  return status == ZP_SLAVE_OK && step.terminate ? ZP_SLAVE_DISCARD : status;
}

static ZpSlaveStatus no_status(const ZpSlave *slave) {
  return zp_slave_say(slave, ZP_SLAVE_DISCARD, "no such status, because a step is never pending");
}

static ZpSlaveStatus real_status(const ZpSlave *slave, fmi2StatusKind kind, fmi2Real *value) {
  if (kind != fmi2LastSuccessfulTime) return no_status(slave);
  *value = slave->fmu->time;
  return ZP_SLAVE_OK;
}

static ZpSlaveStatus boolean_status(const ZpSlave *slave, fmi2StatusKind kind, fmi2Boolean *value) {
  if (kind != fmi2Terminated) return no_status(slave);
  *value = slave->terminates ? fmi2True : fmi2False;
  return ZP_SLAVE_OK;
}

/* The standard gives the functions their parameters. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define ZP_FMI_VERSION    2
#define ZP_FMI_NAME(name) fmi2##name
#define ZP_FMI_DEFINES
#include "fmu/export/functions.def"
