/* malloc, calloc and realloc of the command: those of the C library, but where one fails inside a library that would
 * crash on that, the command says so and ends. What was computed is on the disk by then: libraries read scenarios
 * before there are results, and table.csv is written before results.h5. Our own code gets its NULL and deals with it.
 *
 * They forward to the next function of their name, so that memory tools see every call. Under sanitizers, which bring
 * a malloc of their own, this file is left out (CMakeLists.txt). */
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

#define FOR_LIBRARIES __attribute__((visibility("default"))) /* in place of those of the C library */

static void say(const char *text) {
  ssize_t ignored = write(STDERR_FILENO, text, strlen(text));
  (void)ignored;
}

/* `memory`, unless there is none and who asked would crash on that. Nothing is allocated on the way out. */
static void *checked(void *memory) {
  const char *library = memory ? NULL : zp_library_at_work();
  if (!library) return memory;
  say("zipact: no memory for ");
  say(library);
  say("\n");
  _exit(EXIT_MACHINE);
}

FOR_LIBRARIES void *malloc(size_t size) {
  static void *(*next)(size_t);
  if (!next) next = (void *(*)(size_t))dlsym(RTLD_NEXT, "malloc");
  return checked(next(size));
}

FOR_LIBRARIES void *calloc(size_t count, size_t size) {
  static void *(*next)(size_t, size_t);
  if (!next) next = (void *(*)(size_t, size_t))dlsym(RTLD_NEXT, "calloc");
  return checked(next(count, size));
}

FOR_LIBRARIES void *realloc(void *old, size_t size) {
  static void *(*next)(void *, size_t);
  if (!next) next = (void *(*)(void *, size_t))dlsym(RTLD_NEXT, "realloc");
  void *memory = next(old, size);
  return size > 0 ? checked(memory) : memory; /* of size 0: freed */
}
