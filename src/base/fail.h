/* Filling a ZpError: the one way in which a function says why it failed. */
#ifndef ZP_BASE_FAIL_H
#define ZP_BASE_FAIL_H

#include <zipact/error.h>

/* (status, printf format) => err filled if not NULL; returns status, so that one can `return zp_fail(...)`. */
__attribute__((format(printf, 3, 4))) ZpStatus zp_fail(ZpError *err, ZpStatus status, const char *format, ...);

/* The same for the failure that needs no words of its own. */
ZpStatus zp_fail_memory(ZpError *err);

#endif
