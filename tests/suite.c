/* Compiled into every test: its main(), and a limit of CPU time. Check's own limit is of wall time, which a busy
 * machine uses up, so it is switched off; ctest's is for what hangs without using the processor. */
#include "suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static TestEntry *first;
static void (*before_each)(void), (*after_each)(void), (*before_all)(void), (*after_all)(void);

void zp_test_add(TestEntry *entry) {
  TestEntry **place = &first;
  while (*place && (*place)->test.line < entry->test.line) /* the compiler orders constructors as it likes */
    place = &(*place)->next;
  entry->next = *place;
  *place = entry;
}

void zp_test_around_each(void (*before)(void), void (*after)(void)) {
  before_each = before;
  after_each = after;
}

void zp_test_around_all(void (*before)(void), void (*after)(void)) {
  before_all = before;
  after_all = after;
}

static struct {
  void *object;
  void (*destroy)(void *);
} owned[1 << 16]; /* not allocated: tests count allocations */
static size_t owned_count;

void *zp_test_owns(void *object, void (*destroy)(void *)) {
  ck_assert_uint_lt(owned_count, sizeof owned / sizeof *owned);
  owned[owned_count].object = object;
  owned[owned_count++].destroy = destroy;
  return object;
}

void *zp_test_releases(void *object) {
  for (size_t k = owned_count; k-- > 0;)
    if (owned[k].object == object) owned[k].object = NULL;
  return object;
}

static void destroy_owned(void) {
  while (owned_count > 0) {
    owned_count--;
    if (owned[owned_count].object) owned[owned_count].destroy(owned[owned_count].object);
  }
}

__attribute__((constructor)) static void limit_cpu(void) {
  static const rlim_t most = 600; /* s of each process: Check runs each test in one of its own */
  struct rlimit limit;
  setenv("CK_TIMEOUT_MULTIPLIER", "0", 1);
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  setrlimit(RLIMIT_CPU, &limit);
}

/* Each test is a case of its own: cases have tags. What runs before all goes with the first one of a kind, since
 * nothing can be asserted outside a case. */
static void add_case(Suite *suite, const TestEntry *entry) {
  static bool begun[2];
  TCase *tcase = tcase_create(entry->test.name);
  if (before_all && !begun[entry->nightly]) tcase_add_unchecked_fixture(tcase, before_all, NULL);
  begun[entry->nightly] = true;
  if (entry->nightly) tcase_set_tags(tcase, "nightly");
  tcase_add_checked_fixture(tcase, NULL, destroy_owned);
  if (before_each) tcase_add_checked_fixture(tcase, before_each, after_each);
  _tcase_add_test(tcase, &entry->test, entry->signal, 0, entry->from, entry->to);
  suite_add_tcase(suite, tcase);
}

int main(int count, char **argument) {
  (void)count;
  setvbuf(stdout, NULL, _IOLBF, 0); /* measured values are printed before a test fails */
  const char *chosen = getenv("ZP_TEST");
  Suite *suite = suite_create(argument[0]);
  int cases = 0;
  for (const TestEntry *entry = first; entry; entry = entry->next) {
    if (chosen && strcmp(chosen, entry->test.name) != 0) continue;
    add_case(suite, entry);
    cases++;
  }
  if (cases == 0) {
    fprintf(stderr, "%s has no test %s\n", argument[0], chosen ? chosen : "");
    return 2;
  }
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  if (after_all) after_all();
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
