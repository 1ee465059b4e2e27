/* Status of a call: was it right, and could the machine do it?
 *
 * How the *numerics* ended is not a status but an outcome (study.h): a run that diverges returns
 * ZP_OK and says "diverged".
 */
#ifndef ZIPACT_ERROR_H
#define ZIPACT_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

/* The kinds of failure. Their values are the exit statuses of the command where it has one. */
typedef enum ZpStatus {
  ZP_OK = 0,        /* the call did what it says */
  ZP_BAD_INPUT = 2, /* a value, key, unit, file content or argument is wrong; nothing was done */
  ZP_MACHINE = 3    /* no memory, disk full, no permission, a library failed */
} ZpStatus;

/* Why a call failed. Filled only when the call does not return ZP_OK; may be NULL where the caller
 * does not care. */
typedef struct ZpError {
  ZpStatus status;   /* same as the value returned */
  char message[512]; /* one sentence naming key, value, unit and range; no newline at its end */
} ZpError;

#ifdef __cplusplus
}
#endif

#endif
