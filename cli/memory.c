/* malloc, calloc and realloc of the command: those of the C library, except that if one fails inside a library that
 * would crash, the command prints a message and ends. All computed results are on the disk by then: libraries read
 * scenarios before there are results, and table.csv is written before results.h5. Our own code gets NULL and handles
 * it.
 *
 * They forward to the next function of their name, so that memory tools see every call. A build with sanitizers, which
 * have their own malloc, does not include this file (CMakeLists.txt). */
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

#define FOR_LIBRARIES __attribute__((visibility("default"))) /* instead of those of the C library */

static void say(const char *text) {
  ssize_t ignored = write(STDERR_FILENO, text, strlen(text));
  (void)ignored;
}

/* Return `memory`; end the program if it is NULL and the caller would crash. Allocates nothing. */
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
