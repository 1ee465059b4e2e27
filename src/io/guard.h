/* Libraries that do not survive a failed allocation.
 *
 * libfyaml crashes or calls the text bad YAML, UDUNITS-2 crashes, calls exit(2) or forgets a unit, HDF5 crashes or
 * loops. None of them takes an allocator, and nobody can mend that from outside. So their calls stand between
 * zp_guard_enter and zp_guard_leave. The first makes sure that there is the memory that they usually need. Where this
 * is not enough, zp_library_at_work (zipact/io.h) tells a program that has a malloc of its own, as the command has, to
 * end in order instead of returning NULL. */
#ifndef ZP_IO_GUARD_H
#define ZP_IO_GUARD_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* The library that was at work before: guards may lie inside each other. */
typedef struct ZpGuard {
  const char *before;
} ZpGuard;

/* (name of a library, bytes that its calls may need) => guard, to be left whatever follows. ZP_MACHINE if there is no
 * such memory; then there is nothing to leave. */
ZpStatus zp_guard_enter(ZpGuard *guard, const char *library, size_t room, ZpError *err);
void zp_guard_leave(const ZpGuard *guard);

/* Whether there are `bytes` of memory to be had. */
bool zp_has_room(size_t bytes);

#endif
