/* Status of a call: whether its arguments were right and the machine could do it.
 *
 * How the *solver* ended is not a status but an outcome (sim.h): a study whose run diverges returns ZP_OK, with outcome
 * "diverged".
 */
#ifndef ZIPACT_ERROR_H
#define ZIPACT_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

/* The kinds of failure. Their values are exit statuses of the command. */
typedef enum ZpStatus {
  ZP_OK = 0,        /* the call did what it says */
  ZP_BAD_INPUT = 2, /* a value, key, unit, file content or argument is wrong; nothing was done */
  ZP_MACHINE = 3    /* no memory, disk full, no permission, a library failed */
} ZpStatus;

/* The reason why a call failed. Filled only if the call does not return ZP_OK. Callers may pass NULL instead. */
typedef struct ZpError {
  ZpStatus status;   /* the returned status */
  char message[512]; /* one sentence that names key, value, unit and range; no newline at its end */
} ZpError;

#ifdef __cplusplus
}
#endif

#endif
