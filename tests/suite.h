/* What ends a test's main(): its suite run, and the tests that are left to `make nightly`. */
#ifndef ZP_TESTS_SUITE_H
#define ZP_TESTS_SUITE_H

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ZP_TEST=NAME runs the test function of this name alone. */
static inline void add_if_chosen(TCase *tcase, const TTest *test, int from, int to) {
  const char *chosen = getenv("ZP_TEST");
  if (!chosen || !strcmp(chosen, test->name)) _tcase_add_test(tcase, test, 0, 0, from, to);
}
#undef tcase_add_test
#define tcase_add_test(tcase, test) add_if_chosen(tcase, test, 0, 1)
#undef tcase_add_loop_test
#define tcase_add_loop_test(tcase, test, from, to) add_if_chosen(tcase, test, from, to)

/* Tests that take long and find little that shorter ones do not: `make check` leaves them out by their tag. */
static inline TCase *nightly_case(Suite *suite) {
  TCase *nightly = tcase_create("nightly");
  tcase_set_tags(nightly, "nightly");
  suite_add_tcase(suite, nightly);
  return nightly;
}

/* => the status of the program */
static inline int run_suite(Suite *suite) {
  setvbuf(stdout, NULL, _IOLBF, 0); /* measured values are printed before a test fails */
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}

#endif
