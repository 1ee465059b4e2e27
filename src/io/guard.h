/* Libraries that do not survive a failed allocation.
 *
 * libfyaml crashes or reports bad YAML, UDUNITS-2 crashes, calls exit(2) or forgets a unit, HDF5 crashes or loops. None
 * of them accepts an allocator, and this cannot be repaired from outside. So their calls are enclosed by zp_guard_enter
 * and zp_guard_leave. zp_guard_enter ensures that the memory that they usually need is available. If this is not
 * enough, zp_library_at_work (zipact/io.h) allows a program with its own malloc, such as the command, to end in order
 * instead of returning NULL. */
#ifndef ZP_IO_GUARD_H
#define ZP_IO_GUARD_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* The enclosing library: guards may be nested. */
typedef struct ZpGuard {
  const char *before;
} ZpGuard;

/* (name of a library, bytes that its calls may need) => guard, which must be left in every case. ZP_MACHINE if this
 * memory is not available; then there is nothing to leave. */
ZpStatus zp_guard_enter(ZpGuard *guard, const char *library, size_t room, ZpError *err);
void zp_guard_leave(const ZpGuard *guard);

/* Are `bytes` of memory available? */
bool zp_has_room(size_t bytes);

#endif
