#include "io/guard.h"

#include <sys/mman.h>

#include <zipact/io.h>

#include "base/fail.h"

static _Thread_local const char *at_work; /* NULL: none of these libraries */

const char *zp_library_at_work(void) {
  return at_work;
}

/* By mmap and not by malloc, which remembers large blocks and then handles later requests differently. */
bool zp_has_room(size_t bytes) {
  void *room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return room != MAP_FAILED && munmap(room, bytes) == 0;
}

ZpStatus zp_guard_enter(ZpGuard *guard, const char *library, size_t room, ZpError *err) {
  if (!zp_has_room(room)) return zp_fail(err, ZP_MACHINE, "no memory for %s", library);
  guard->before = at_work;
  at_work = library;
  return ZP_OK;
}

void zp_guard_leave(const ZpGuard *guard) {
  at_work = guard->before;
}
