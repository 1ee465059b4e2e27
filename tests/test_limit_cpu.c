/* Tests are limited in CPU time, not in wall time: tests/suite.c. */
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "check_util.h"

/* Longer than the 4 s of wall time that Check gives a test by itself, which a busy machine used up. */
TEST(test_waiting_takes_no_time) {
  ck_assert_uint_eq(sleep(5), 0);
}

TEST_ENDED_BY(test_a_loop_is_ended, SIGXCPU) {
  struct rlimit limit;
  ck_assert_int_eq(getrlimit(RLIMIT_CPU, &limit), 0);
  ck_assert_uint_le(limit.rlim_cur, 600);
  limit.rlim_cur = 1; /* shows how a test that goes on for ever ends */
  ck_assert_int_eq(setrlimit(RLIMIT_CPU, &limit), 0);
  for (volatile int k = 0;; k = !k)
    ;
}
