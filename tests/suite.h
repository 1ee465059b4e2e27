/* What ends a test's main(): its suite run, and the tests that are left to `make nightly`. */
#ifndef ZP_TESTS_SUITE_H
#define ZP_TESTS_SUITE_H

#include <check.h>
#include <stdio.h>

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
