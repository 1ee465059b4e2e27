/* Checks all cases before the first one runs, in several threads. */
#include <zipact/batch.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/fail.h"
#include "fit/data.h"

/* Number of cases that a thread checks before it looks at the progress of the others. */
enum { BLOCK = 256 };

typedef struct Check {
  const ZpScenario *scenario;
  atomic_size_t next, wrong; /* first case that no thread has taken; smallest number of a wrong case so far */
} Check;

typedef struct Checker {
  Check *check;
  pthread_t thread;
  size_t wrong; /* its wrong case, SIZE_MAX: none */
  ZpError err;  /* the reason */
} Checker;

static ZpStatus check_case(const ZpScenario *scenario, size_t index, ZpError *err) {
  ZpActuatorDef def;
  ZpStatus status = zp_scenario_def(scenario, index, &def, err);
  return status == ZP_OK ? zp_data_check_files(zp_scenario_study(scenario), &def, err) : status;
}

static void note_wrong(Checker *checker, size_t index) {
  size_t least = atomic_load(&checker->check->wrong);
  checker->wrong = index;
  while (index < least && !atomic_compare_exchange_weak(&checker->check->wrong, &least, index))
    continue;
}

/* No thread takes a block after a wrong case, and all blocks before it are checked: so the first wrong case is found.
 */
static void *check_blocks(void *user) {
  Checker *checker = user;
  Check *check = checker->check;
  const size_t count = zp_scenario_count(check->scenario);
  for (size_t from; (from = atomic_fetch_add(&check->next, BLOCK)) < count && from < atomic_load(&check->wrong);)
    for (size_t i = from; i < from + BLOCK && i < count && checker->wrong == SIZE_MAX; i++)
      if (check_case(check->scenario, i, &checker->err) != ZP_OK) note_wrong(checker, i);
  return NULL;
}

/* Run all checkers, the first one in the thread of the caller. If threads are not available, fewer run. */
static void check_all(Checker *checker, size_t jobs) {
  size_t started = 1;
  for (; started < jobs; started++)
    if (pthread_create(&checker[started].thread, NULL, check_blocks, &checker[started]) != 0) break;
  check_blocks(&checker[0]);
  for (size_t k = 1; k < started; k++)
    pthread_join(checker[k].thread, NULL);
}

ZpStatus zp_batch_check_jobs(const ZpScenario *scenario, int jobs, ZpError *err) {
  const size_t most = (zp_scenario_count(scenario) + BLOCK - 1) / BLOCK;
  const size_t asked = (size_t)(jobs > 0 ? jobs : zp_processors()), threads = asked < most ? asked : most;
  Check check = {.scenario = scenario, .wrong = SIZE_MAX};
  Checker *checker = calloc(threads + 1, sizeof *checker);
  if (!checker) return zp_fail_memory(err);
  for (size_t k = 0; k < threads + 1; k++)
    checker[k] = (Checker){.check = &check, .wrong = SIZE_MAX};
  check_all(checker, threads);
  ZpStatus status = ZP_OK;
  for (size_t k = 0; k < threads; k++)
    if (checker[k].wrong != SIZE_MAX && checker[k].wrong == atomic_load(&check.wrong))
      status = zp_fail(err, checker[k].err.status, "%s", checker[k].err.message);
  free(checker);
  return status;
}

ZpStatus zp_batch_check(const ZpScenario *scenario, ZpError *err) {
  return zp_batch_check_jobs(scenario, 1, err);
}
