/* Compiled into every test: a test may take this much CPU time, however busy the machine is. Check's own limit is of
 * wall time, so it is switched off; ctest's is for what hangs without using the processor. */
#include <stdlib.h>
#include <sys/resource.h>

__attribute__((constructor)) static void limit_cpu(void) {
  static const rlim_t most = 600; /* s of each process: Check runs each test in one of its own */
  struct rlimit limit;
  setenv("CK_TIMEOUT_MULTIPLIER", "0", 1);
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_CPU, &limit);
}
