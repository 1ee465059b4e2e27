/* Tests are limited in CPU time, not in wall time: tests/limit_cpu.c. */
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "check_util.h"

/* Longer than the 4 s of wall time that Check gives a test by itself, which a busy machine used up. */
START_TEST(test_waiting_takes_no_time) {
  ck_assert_uint_eq(sleep(5), 0);
}
END_TEST

START_TEST(test_a_loop_is_ended) {
  struct rlimit limit;
  ck_assert_int_eq(getrlimit(RLIMIT_CPU, &limit), 0);
  ck_assert_uint_le(limit.rlim_cur, 600);
  limit.rlim_cur = 1; /* shows how a test that goes on for ever ends */
  ck_assert_int_eq(setrlimit(RLIMIT_CPU, &limit), 0);
  for (volatile int k = 0;; k = !k)
    ;
}
END_TEST

int main(void) {
  Suite *suite = suite_create("limit_cpu");
  TCase *limits = tcase_create("limits");
  tcase_add_test(limits, test_waiting_takes_no_time);
  tcase_add_test_raise_signal(limits, test_a_loop_is_ended, SIGXCPU);
  suite_add_tcase(suite, limits);
  return run_suite(suite);
}
