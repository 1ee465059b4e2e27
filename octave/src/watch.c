/* Ctrl-C during long calls. */
#include "binding.h"

#include <signal.h>

static volatile sig_atomic_t interrupted;
static void (*interpreters)(int);

static void note(int number) {
  (void)number;
  interrupted = 1;
}

static bool asked_to_stop(void *user, const char *stage, double fraction) {
  (void)user, (void)stage, (void)fraction;
  return interrupted;
}

const ZpHooks watch_hooks = {.progress = asked_to_stop};

void watch_begin(void) {
  interrupted = 0;
  interpreters = signal(SIGINT, note);
}

bool watch_end(void) {
  signal(SIGINT, interpreters);
  return interrupted;
}
