/* Common functions of FMI 2 and FMI 3: which calls are allowed in which phase, messages, states with an owner. Both
 * standards number their statuses alike. */
#ifndef ZP_FMU_EXPORT_SLAVE_H
#define ZP_FMU_EXPORT_SLAVE_H

#include "fmu/instance.h"

typedef enum ZpSlaveStatus { ZP_SLAVE_OK, ZP_SLAVE_WARNING, ZP_SLAVE_DISCARD, ZP_SLAVE_ERROR } ZpSlaveStatus;

/* Categories of messages, as in modelDescription.xml. */
#define ZP_LOG_EVENTS  "logEvents"
#define ZP_LOG_DISCARD "logStatusDiscard"
#define ZP_LOG_ERROR   "logStatusError"

typedef struct ZpSlave ZpSlave;

/* Passes a message to the importer. */
typedef void (*ZpSlaveLog)(const ZpSlave *slave, ZpSlaveStatus status, const char *category, const char *message);

struct ZpSlave {
  ZpFmu *fmu;
  char name[128];
  ZpSlaveLog log; /* NULL: no messages */
  bool logging;   /* also messages that are not errors */
  bool uses_events, returns_early;
  bool terminates; /* the last step asked for the end of the simulation */
  double stop;     /* s: no step goes beyond; INFINITY: there is no stop time */
  /* Data of the importer that `log` uses: */
  const void *functions;  /* FMI 2: its callbacks */
  void *environment;      /* FMI 3: the argument of its function, */
  void (*callback)(void); /* and that function */
};

/* A slave in phase instantiated, with the importer data of `like`; NULL, with a message, if the token differs or there
 * is no memory. */
ZpSlave *zp_slave_create(const ZpSlave *like, const char *name, const char *token);
void zp_slave_destroy(ZpSlave *slave);

/* No instance: logs why with the importer data of `like` => NULL. */
ZpSlave *zp_slave_refuse(const ZpSlave *like, const char *name, const char *why);

/* A function `what` for model exchange, which an FMU has to have and this one refuses => ZP_SLAVE_ERROR, with a
 * message. */
ZpSlaveStatus zp_slave_exchange(const ZpSlave *slave, const char *what);

/* The worse of two. */
static inline ZpSlaveStatus zp_slave_worse(ZpSlaveStatus a, ZpSlaveStatus b) {
  return a > b ? a : b;
}

/* Is the call `what` allowed now? If not, logs a message. */
bool zp_slave_allows(const ZpSlave *slave, unsigned phases, const char *what);

/* Logs the error and returns `status`. */
ZpSlaveStatus zp_slave_say(const ZpSlave *slave, ZpSlaveStatus status, const char *message);

/* ZP_SLAVE_OK, or logs the reason: a wrong call is discarded, a failure is an error. */
ZpSlaveStatus zp_slave_after(const ZpSlave *slave, ZpStatus status, const ZpError *err);

/* Set start time and tolerance (NAN: none given) of an experiment that ends at `stop` (INFINITY: never). */
ZpSlaveStatus zp_slave_setup(ZpSlave *slave, double start, double tolerance, double stop);

ZpSlaveStatus zp_slave_set_logging(ZpSlave *slave, bool on);

/* Change to phase `next`; from initialization to the phase that follows. */
ZpSlaveStatus zp_slave_move(ZpSlave *slave, ZpFmuPhase next);
ZpSlaveStatus zp_slave_exit_initialization(ZpSlave *slave);

ZpSlaveStatus zp_slave_reset(ZpSlave *slave);

/* Step from the current time, which must be `now`, by `size`. */
ZpSlaveStatus zp_slave_step(ZpSlave *slave, double now, double size, ZpFmuStep *step);

/* Calls for variables of a type that has none, and for derivatives of outputs with respect to time: correct only if
 * they request none. */
ZpSlaveStatus zp_slave_none(const ZpSlave *slave, size_t count);
ZpSlaveStatus zp_slave_no_rates(const ZpSlave *slave, size_t count);

/* sensitivity = derivatives of unknowns with respect to knowns, times seed; adjoint: seed times derivatives. */
ZpSlaveStatus zp_slave_derivative(ZpSlave *slave, bool adjoint, const uint32_t *unknown, size_t unknowns,
                                  const uint32_t *known, size_t knowns, const double *seed, double *sensitivity);

/* The current state => *state, which is created if it is NULL and reused otherwise. */
ZpSlaveStatus zp_slave_get_state(ZpSlave *slave, void **state);
ZpSlaveStatus zp_slave_set_state(ZpSlave *slave, const void *state);
ZpSlaveStatus zp_slave_free_state(void **state);
ZpSlaveStatus zp_slave_state_size(const ZpSlave *slave, const void *state, size_t *size);
ZpSlaveStatus zp_slave_serialize(const ZpSlave *slave, const void *state, void *bytes, size_t size);
ZpSlaveStatus zp_slave_deserialize(ZpSlave *slave, const void *bytes, size_t size, void **state);

#endif
