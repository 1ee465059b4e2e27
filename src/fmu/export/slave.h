/* What the functions of FMI 2 and FMI 3 have in common: which calls are allowed when, messages, states with an owner.
 * Both standards number their statuses alike. */
#ifndef ZP_FMU_EXPORT_SLAVE_H
#define ZP_FMU_EXPORT_SLAVE_H

#include "fmu/instance.h"

typedef enum ZpSlaveStatus { ZP_SLAVE_OK, ZP_SLAVE_WARNING, ZP_SLAVE_DISCARD, ZP_SLAVE_ERROR } ZpSlaveStatus;

/* Categories of messages, as in modelDescription.xml. */
#define ZP_LOG_EVENTS  "logEvents"
#define ZP_LOG_DISCARD "logStatusDiscard"
#define ZP_LOG_ERROR   "logStatusError"

typedef struct ZpSlave ZpSlave;

/* Hands a message to the importer. */
typedef void (*ZpSlaveLog)(const ZpSlave *slave, ZpSlaveStatus status, const char *category, const char *message);

struct ZpSlave {
  ZpFmu *fmu;
  char name[128];
  ZpSlaveLog log; /* NULL: nobody listens */
  bool logging;   /* messages besides those of errors */
  bool uses_events, returns_early;
  bool terminates; /* the last step asked for the end of the simulation */
  /* The importer's, which `log` needs: */
  const void *functions;  /* FMI 2: its callbacks */
  void *environment;      /* FMI 3: what its function gets, */
  void (*callback)(void); /* and that function */
};

/* A state of an instance, with an owner. */
typedef struct ZpSlaveState {
  size_t size;
  unsigned char *byte;
} ZpSlaveState;

/* A slave in phase instantiated, with what `like` has of an importer; NULL, with a message, if the token is another or
 * there is no memory. */
ZpSlave *zp_slave_create(const ZpSlave *like, const char *name, const char *token);
void zp_slave_destroy(ZpSlave *slave);

/* Is the call `what` allowed now? If not, says so. */
bool zp_slave_allows(const ZpSlave *slave, unsigned phases, const char *what);

/* Says what is wrong, and gives `status`. */
ZpSlaveStatus zp_slave_say(const ZpSlave *slave, ZpSlaveStatus status, const char *message);

/* ZP_SLAVE_OK, or says why not: what was wrong with the call is discarded, what failed is an error. */
ZpSlaveStatus zp_slave_after(const ZpSlave *slave, ZpStatus status, const ZpError *err);

/* Start time and tolerance (NAN: none given) of an experiment that ends at `stop` (INFINITY: at no time). */
ZpSlaveStatus zp_slave_setup(ZpSlave *slave, double start, double tolerance, double stop);

/* From initialization on to `next`. */
ZpSlaveStatus zp_slave_exit_initialization(ZpSlave *slave, ZpFmuPhase next);

ZpSlaveStatus zp_slave_reset(ZpSlave *slave);

/* From the present time, which must be `now`, on by `size`. */
ZpSlaveStatus zp_slave_step(ZpSlave *slave, double now, double size, ZpFmuStep *step);

/* Values of variables of one type. */
ZpSlaveStatus zp_slave_get(ZpSlave *slave, uint32_t reference, ZpKeyType type, double *value);
ZpSlaveStatus zp_slave_set(ZpSlave *slave, uint32_t reference, ZpKeyType type, double value);

/* sensitivity = derivatives of unknowns by knowns times seed; adjoint: seed times derivatives. */
ZpSlaveStatus zp_slave_derivative(ZpSlave *slave, const uint32_t *unknown, size_t unknowns, const uint32_t *known,
                                  size_t knowns, const double *seed, double *sensitivity);
ZpSlaveStatus zp_slave_adjoint(ZpSlave *slave, const uint32_t *unknown, size_t unknowns, const uint32_t *known,
                               size_t knowns, const double *seed, double *sensitivity);

/* The present state => *state, which is made if it is NULL, else used again. */
ZpSlaveStatus zp_slave_get_state(ZpSlave *slave, void **state);
ZpSlaveStatus zp_slave_set_state(ZpSlave *slave, const void *state);
void zp_slave_free_state(void **state);
ZpSlaveStatus zp_slave_state_size(const ZpSlave *slave, const void *state, size_t *size);
ZpSlaveStatus zp_slave_serialize(const ZpSlave *slave, const void *state, void *bytes, size_t size);
ZpSlaveStatus zp_slave_deserialize(ZpSlave *slave, const void *bytes, size_t size, void **state);

#endif
