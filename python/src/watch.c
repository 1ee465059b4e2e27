/* The interpreter lock and the hooks of the library. */
#include "binding.h"

#include <math.h>
#include <time.h>

static double wall_clock(void *user) {
  (void)user;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Requires the lock: true to stop. */
static bool ask(Watch *watch, const char *stage, double fraction) {
  if (PyErr_CheckSignals() != 0) return true;
  if (!watch->progress) return false;
  PyObject *answer = PyObject_CallFunction(watch->progress, "sd", stage, fraction);
  int stop = answer ? PyObject_IsTrue(answer) : 1;
  Py_XDECREF(answer);
  return stop != 0;
}

static bool look(void *user, const char *stage, double fraction) {
  static const double between_looks = 0.05; /* s: acquiring the lock is slow if many threads run */
  Watch *watch = user;
  double now = wall_clock(NULL);
  if (now < watch->next) return false;
  watch->next = now + between_looks;
  PyEval_RestoreThread(watch->thread);
  bool stop = ask(watch, stage, fraction);
  watch->failed = PyErr_Occurred() != NULL;
  watch->thread = PyEval_SaveThread();
  return stop;
}

void watch_begin(Watch *watch, PyObject *progress) {
  *watch = (Watch){.progress = progress};
  watch->thread = PyEval_SaveThread();
}

void watch_end(Watch *watch) {
  PyEval_RestoreThread(watch->thread);
}

ZpHooks watch_hooks(Watch *watch) {
  return (ZpHooks){.user = watch, .progress = look, .clock = wall_clock};
}
