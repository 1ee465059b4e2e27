/* Ctrl-C during long calls. Octave blocks SIGINT for its interpreter, so a separate thread waits for it. MATLAB sends
 * no signal, so this has no effect there. */
#include "binding.h"

#include <pthread.h>
#include <signal.h>

static volatile sig_atomic_t interrupted;
static struct sigaction interpreters_action;
static sigset_t interpreters_mask;

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
  struct sigaction ours = {.sa_handler = note};
  sigset_t interrupt;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, SIGINT);
  interrupted = 0;
  sigaction(SIGINT, &ours, &interpreters_action);
  pthread_sigmask(SIG_UNBLOCK, &interrupt, &interpreters_mask);
}

bool watch_end(void) {
  pthread_sigmask(SIG_SETMASK, &interpreters_mask, NULL);
  sigaction(SIGINT, &interpreters_action, NULL);
  return interrupted;
}
