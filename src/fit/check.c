/* Checks all cases before the first one runs, in several threads. */
#include <zipact/batch.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/data.h"

/* Number of cases that a thread checks before it looks at the progress of the others. */
enum { BLOCK = 256 };

typedef struct Check {
  const ZpScenario *scenario;
  atomic_size_t next, wrong; /* first case that no thread has taken; smallest number of a wrong case so far */
  pthread_mutex_t lock;      /* guards `err` and changes of `wrong` */
  ZpError err;               /* the reason */
} Check;

static void check_case(Check *check, size_t index) {
  ZpActuatorDef def = {0};
  ZpError err;
  ZpStatus status = zp_scenario_def(check->scenario, index, &def, &err);
  if (status == ZP_OK) status = zp_data_check_files(zp_scenario_study(check->scenario), &def, &err);
  zp_def_clear(&def);
  if (status == ZP_OK) return;
  pthread_mutex_lock(&check->lock);
  if (index < atomic_load(&check->wrong)) {
    check->err = err;
    atomic_store(&check->wrong, index);
  }
  pthread_mutex_unlock(&check->lock);
}

/* No thread takes a block after a wrong case, and all blocks before it are checked: so the first wrong case is found.
 */
static void *check_blocks(void *user) {
  Check *check = user;
  const size_t count = zp_scenario_count(check->scenario);
  for (size_t from; (from = atomic_fetch_add(&check->next, BLOCK)) < count && from < atomic_load(&check->wrong);)
    for (size_t i = from; i < from + BLOCK && i < count && i < atomic_load(&check->wrong); i++)
      check_case(check, i);
  return NULL;
}

/* If threads are not available, fewer run. */
ZpStatus zp_batch_check_jobs(const ZpScenario *scenario, int jobs, ZpError *err) {
  const size_t most = (zp_scenario_count(scenario) + BLOCK - 1) / BLOCK;
  const size_t asked = (size_t)(jobs > 0 ? jobs : zp_processors()), threads = asked < most ? asked : most;
  Check check = {.scenario = scenario, .wrong = SIZE_MAX, .lock = PTHREAD_MUTEX_INITIALIZER};
  pthread_t *thread = calloc(threads + 1, sizeof *thread);
  size_t started = 1;
  if (!thread) return zp_fail_memory(err);
  while (started < threads && pthread_create(&thread[started], NULL, check_blocks, &check) == 0)
    started++;
  check_blocks(&check);
  for (size_t k = 1; k < started; k++)
    pthread_join(thread[k], NULL);
  free(thread);
  return check.wrong == SIZE_MAX ? ZP_OK : zp_fail(err, check.err.status, "%s", check.err.message);
}

ZpStatus zp_batch_check(const ZpScenario *scenario, ZpError *err) {
  return zp_batch_check_jobs(scenario, 1, err);
}
