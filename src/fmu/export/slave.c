/* Common functions of FMI 2 and FMI 3. */
#include "fmu/export/slave.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* -- messages and life ----------------------------------------------------------------------------- */

ZpSlaveStatus zp_slave_say(const ZpSlave *slave, ZpSlaveStatus status, const char *message) {
  static const char *const category[] = {ZP_LOG_EVENTS, ZP_LOG_EVENTS, ZP_LOG_DISCARD, ZP_LOG_ERROR};
  if (slave->log && (slave->logging || status >= ZP_SLAVE_DISCARD))
    slave->log(slave, status, category[status], message);
  return status;
}

ZpSlaveStatus zp_slave_after(const ZpSlave *slave, ZpStatus status, const ZpError *err) {
  if (status == ZP_OK) return ZP_SLAVE_OK;
  return zp_slave_say(slave, status == ZP_BAD_INPUT ? ZP_SLAVE_DISCARD : ZP_SLAVE_ERROR, err->message);
}

bool zp_slave_allows(const ZpSlave *slave, unsigned phases, const char *what) {
  char text[96];
  if (!slave) return false;
  if (slave->fmu->phase & phases) return true;
  snprintf(text, sizeof text, "%s is not allowed in this phase", what);
  zp_slave_say(slave, ZP_SLAVE_ERROR, text);
  return false;
}

/* The data of an importer, for an instance of that name. */
static ZpSlave named(const ZpSlave *like, const char *name) {
  ZpSlave slave = *like;
  slave.stop = INFINITY;
  snprintf(slave.name, sizeof slave.name, "%s", name ? name : "");
  return slave;
}

ZpSlave *zp_slave_refuse(const ZpSlave *like, const char *name, const char *why) {
  const ZpSlave slave = named(like, name);
  zp_slave_say(&slave, ZP_SLAVE_ERROR, why);
  return NULL;
}

ZpSlaveStatus zp_slave_exchange(const ZpSlave *slave, const char *what) {
  char text[160];
  snprintf(text, sizeof text, "%s is for model exchange; this FMU is for co-simulation and has no continuous states",
           what);
  return zp_slave_say(slave, ZP_SLAVE_ERROR, text);
}

ZpSlave *zp_slave_create(const ZpSlave *like, const char *name, const char *token) {
  ZpError err;
  ZpFmuStart start = zp_fmu_start;
  if (!token || strcmp(token, start.token) != 0)
    return zp_slave_refuse(like, name, "the token differs from that in modelDescription.xml of this FMU");
  ZpSlave *slave = zp_calloc(1, sizeof *slave);
  if (!slave) return zp_slave_refuse(like, name, "no memory");
  *slave = named(like, name);
  if (zp_fmu_create(&start, &slave->fmu, &err) == ZP_OK) return slave;
  zp_free(slave);
  return zp_slave_refuse(like, name, err.message);
}

void zp_slave_destroy(ZpSlave *slave) {
  if (!slave) return;
  zp_fmu_destroy(slave->fmu);
  zp_free(slave);
}

static ZpSlaveStatus use_tolerance(ZpSlave *slave, double tolerance) {
  ZpError err;
  if (zp_def_set(&slave->fmu->def, zp_key_find("solver.tolerance"), tolerance, &err) == ZP_OK) return ZP_SLAVE_OK;
  return zp_slave_say(slave, ZP_SLAVE_WARNING, err.message);
}

ZpSlaveStatus zp_slave_setup(ZpSlave *slave, double start, double tolerance, double stop) {
  if (!isfinite(start) || !(stop > start))
    return zp_slave_say(slave, ZP_SLAVE_ERROR, "the start time must be finite and before the stop time");
  slave->fmu->start_time = slave->fmu->time = start;
  slave->stop = stop;
  return isnan(tolerance) ? ZP_SLAVE_OK : use_tolerance(slave, tolerance);
}

ZpSlaveStatus zp_slave_set_logging(ZpSlave *slave, bool on) {
  slave->logging = on;
  return ZP_SLAVE_OK;
}

ZpSlaveStatus zp_slave_move(ZpSlave *slave, ZpFmuPhase next) {
  slave->fmu->phase = next;
  return ZP_SLAVE_OK;
}

ZpSlaveStatus zp_slave_exit_initialization(ZpSlave *slave) {
  ZpError err;
  ZpFmuPhase next = slave->uses_events ? ZP_FMU_AT_EVENT : ZP_FMU_STEPPING;
  slave->fmu->phase = zp_fmu_begin(slave->fmu, &err) == ZP_OK ? next : ZP_FMU_FAILED;
  return slave->fmu->phase == next ? ZP_SLAVE_OK : zp_slave_say(slave, ZP_SLAVE_ERROR, err.message);
}

ZpSlaveStatus zp_slave_reset(ZpSlave *slave) {
  ZpError err;
  slave->terminates = false;
  slave->stop = INFINITY;
  return zp_slave_after(slave, zp_fmu_reset(slave->fmu, &err), &err);
}

/* -- steps and variables --------------------------------------------------------------------------- */

ZpSlaveStatus zp_slave_step(ZpSlave *slave, double now, double size, ZpFmuStep *step) {
  static const double rounding = 1e-9; /* tolerance for times that importers sum up */
  ZpError err;
  ZpFmu *fmu = slave->fmu;
  *step = (ZpFmuStep){false, false};
  if (!(size > 0) || isinf(size)) return zp_slave_say(slave, ZP_SLAVE_ERROR, "the step size must be above 0 s");
  if (!(fabs(now - fmu->time) <= rounding * fmax(size, fabs(now))))
    return zp_slave_say(slave, ZP_SLAVE_ERROR, "the communication point differs from the time of the simulation");
  if (now + size > slave->stop + rounding * fmax(size, fabs(slave->stop)))
    return zp_slave_say(slave, ZP_SLAVE_ERROR, "the step ends after the stop time of the experiment");
  ZpStatus status = zp_fmu_step(fmu, now + size, slave->uses_events && slave->returns_early, step, &err);
  slave->terminates = step->terminate;
  if (status != ZP_OK) return zp_slave_say(slave, ZP_SLAVE_ERROR, err.message);
  if (step->event) zp_slave_say(slave, ZP_SLAVE_OK, "an event has ended the step");
  if (step->terminate) zp_slave_say(slave, ZP_SLAVE_OK, "short circuit: electrodes without an insulator touch");
  return ZP_SLAVE_OK;
}

ZpSlaveStatus zp_slave_none(const ZpSlave *slave, size_t count) {
  return count == 0 ? ZP_SLAVE_OK : zp_slave_say(slave, ZP_SLAVE_ERROR, "there is no variable of this type");
}

ZpSlaveStatus zp_slave_no_rates(const ZpSlave *slave, size_t count) {
  if (count == 0) return ZP_SLAVE_OK;
  return zp_slave_say(slave, ZP_SLAVE_ERROR, "derivatives of outputs with respect to time are not available");
}

ZpSlaveStatus zp_slave_derivative(ZpSlave *slave, bool adjoint, const uint32_t *unknown, size_t unknowns,
                                  const uint32_t *known, size_t knowns, const double *seed, double *sensitivity) {
  ZpError err;
  ZpStatus status = ZP_OK;
  double slope[ZP_FMU_OUTPUTS];
  for (size_t k = 0; k < (adjoint ? knowns : unknowns); k++)
    sensitivity[k] = 0;
  for (size_t j = 0; j < knowns && status == ZP_OK; j++) {
    status = zp_fmu_slopes(slave->fmu, known[j], slope, &err);
    for (size_t i = 0; i < unknowns && status == ZP_OK; i++) {
      int signal = 0;
      status = zp_fmu_signal(slave->fmu, unknown[i], &signal, &err);
      sensitivity[adjoint ? j : i] += slope[signal] * seed[adjoint ? i : j];
    }
  }
  return zp_slave_after(slave, status, &err);
}

/* -- states ---------------------------------------------------------------------------------------- */

typedef struct State {
  size_t size;
  unsigned char byte[];
} State;

ZpSlaveStatus zp_slave_free_state(void **place) {
  if (!place) return ZP_SLAVE_OK;
  zp_free(*place);
  *place = NULL;
  return ZP_SLAVE_OK;
}

/* A state of that size in *place; NULL, with a message, if there is no memory. */
static State *need_state(const ZpSlave *slave, void **place, size_t size) {
  State *state = *place;
  if (state && state->size == size) return state;
  zp_free(state);
  *place = state = zp_calloc(1, sizeof *state + size);
  if (state)
    state->size = size;
  else
    zp_slave_say(slave, ZP_SLAVE_ERROR, "no memory");
  return state;
}

ZpSlaveStatus zp_slave_get_state(ZpSlave *slave, void **place) {
  State *state = place ? need_state(slave, place, zp_fmu_state_size(slave->fmu)) : NULL;
  if (!state) return ZP_SLAVE_ERROR;
  zp_fmu_save(slave->fmu, state->byte);
  return ZP_SLAVE_OK;
}

static ZpSlaveStatus refuse_state(const ZpSlave *slave) {
  return zp_slave_say(slave, ZP_SLAVE_ERROR, "there is no state, or the buffer has another size");
}

ZpSlaveStatus zp_slave_set_state(ZpSlave *slave, const void *place) {
  ZpError err;
  const State *state = place;
  if (!state) return refuse_state(slave);
  ZpStatus status = zp_fmu_load(slave->fmu, state->byte, state->size, &err);
  return status == ZP_OK ? ZP_SLAVE_OK : zp_slave_say(slave, ZP_SLAVE_ERROR, err.message);
}

ZpSlaveStatus zp_slave_state_size(const ZpSlave *slave, const void *place, size_t *size) {
  const State *state = place;
  if (!state || !size) return refuse_state(slave);
  *size = state->size;
  return ZP_SLAVE_OK;
}

ZpSlaveStatus zp_slave_serialize(const ZpSlave *slave, const void *place, void *bytes, size_t size) {
  const State *state = place;
  if (!state || !bytes || size < state->size) return refuse_state(slave);
  memcpy(bytes, state->byte, state->size);
  return ZP_SLAVE_OK;
}

/* zp_slave_set_state checks whether the bytes are a state. */
ZpSlaveStatus zp_slave_deserialize(ZpSlave *slave, const void *bytes, size_t size, void **place) {
  if (!bytes || !place) return refuse_state(slave);
  State *state = need_state(slave, place, size);
  if (!state) return ZP_SLAVE_ERROR;
  memcpy(state->byte, bytes, size);
  return ZP_SLAVE_OK;
}
