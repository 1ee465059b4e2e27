/* Filling a ZpError: the one way in which a function says why it failed. */
#ifndef ZP_BASE_FAIL_H
#define ZP_BASE_FAIL_H

#include <zipact/error.h>

/* (err, status, printf format, ...) => err filled if not NULL; is the status, so that one can
 * `return zp_fail(...)`. A macro around an inline function, so that readers and analysers see that it is. */
#define zp_fail(err, status, ...) zp_status_after(status, (zp_fail_fill(err, status, __VA_ARGS__), 0))
__attribute__((format(printf, 3, 4))) void zp_fail_fill(ZpError *err, ZpStatus status, const char *format, ...);

static inline ZpStatus zp_status_after(ZpStatus status, int filled) {
  (void)filled;
  return status;
}

/* zp_fail where memory is missing. */
#define zp_fail_memory(err) zp_fail(err, ZP_MACHINE, "no memory")

#endif
