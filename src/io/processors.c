#include <zipact/io.h>

#include <sched.h>
#include <unistd.h>

/* The processors that taskset or a batch system allows this process; if there are more than a cpu_set_t holds, all of
 * them. */
int zp_processors(void) {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
  const long online = sysconf(_SC_NPROCESSORS_ONLN);
  return online > 0 ? (int)online : 1;
}
