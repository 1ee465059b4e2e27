/* To be preloaded into the command: makes its allocations fail, those inside libraries, too.
 *
 *   FAIL_AT=N    the N-th allocation fails; with FAIL_ON=1 all that follow, too
 *   FAIL_COUNT=FILE   how many there were goes to FILE
 *
 * Counting begins when the program is loaded and ends when it exits. */
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#pragma GCC visibility push(default) /* seen by the command and its libraries */

/* glibc's own, under names that nobody replaces. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static long calls, failing;
static bool counting, on;

static bool fails_now(void) {
  if (!counting) return false;
  calls++;
  bool fails = failing > 0 && (on ? calls >= failing : calls == failing);
  if (fails) errno = ENOMEM;
  return fails;
}

void *malloc(size_t size) {
  return fails_now() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
  return fails_now() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size) {
  return fails_now() ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return fails_now() ? NULL : __libc_memalign(alignment, size);
}

static long number_of(const char *name) {
  const char *text = getenv(name);
  return text ? strtol(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void begin(void) {
  failing = number_of("FAIL_AT");
  on = number_of("FAIL_ON") != 0;
  counting = true;
}

__attribute__((destructor)) static void end(void) {
  const char *path = getenv("FAIL_COUNT");
  char text[32];
  counting = false;
  if (!path) return;
  int length = snprintf(text, sizeof text, "%ld\n", calls);
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (fd < 0 || write(fd, text, (size_t)length) != length) _exit(99);
}
