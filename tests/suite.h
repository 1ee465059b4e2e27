/* A test is a function that its program runs by itself, without a list of them: main() is in suite.c.
 *   TEST(name) {...}                once
 *   TESTS(name, from, to) {...}     for each _i from `from` to below `to`
 *   NIGHTLY_TEST, NIGHTLY_TESTS     take long and find little that shorter ones do not: their tag keeps them out of
 *                                   `make check`
 *   ALSO, ALSO_NIGHTLY(name, from, to)   further _i of a test
 *
 * ZP_TEST=NAME runs the test of this name alone. */
#ifndef ZP_TESTS_SUITE_H
#define ZP_TESTS_SUITE_H

#include <stdbool.h>

#include <check.h>

typedef struct TestEntry {
  TTest test;
  bool nightly;
  int signal; /* that ends the test; 0 for none */
  int from, to;
  struct TestEntry *next;
} TestEntry;

void zp_test_add(TestEntry *entry);

/* Functions that run before and after each test of the program, and before the first and after the last one, when
 * nothing can be asserted any more. */
void zp_test_around_each(void (*before)(void), void (*after)(void));
void zp_test_around_all(void (*before)(void), void (*after)(void));

/* An object of the test that runs, to be destroyed when it ends, the last one first. => the object */
void *zp_test_owns(void *object, void (*destroy)(void *object));

/* The test destroys it by itself. => the object */
void *zp_test_releases(void *object);

#define ADD_TEST(name, unique, at_night, ended_by, first, past)                                                        \
  __attribute__((constructor)) static void name##unique(void) {                                                        \
    static TestEntry entry = {{#name, name, __FILE__, __LINE__}, at_night, ended_by, 0, 0, NULL};                      \
    entry.from = (int)(first);                                                                                         \
    entry.to = (int)(past);                                                                                            \
    zp_test_add(&entry);                                                                                               \
  }
#define DEFINE_TEST(name, at_night, ended_by, first, past)                                                             \
  static void name(int _i);                                                                                            \
  ADD_TEST(name, _added, at_night, ended_by, first, past)                                                              \
  static void name(__attribute__((unused)) int _i)

#define TEST(name)                    DEFINE_TEST(name, false, 0, 0, 1)
#define TESTS(name, from, to)         DEFINE_TEST(name, false, 0, from, to)
#define NIGHTLY_TEST(name)            DEFINE_TEST(name, true, 0, 0, 1)
#define NIGHTLY_TESTS(name, from, to) DEFINE_TEST(name, true, 0, from, to)
#define TEST_ENDED_BY(name, signal)   DEFINE_TEST(name, false, signal, 0, 1)
#define ALSO(name, from, to)          ADD_TEST(name, _from_##from, false, 0, from, to)
#define ALSO_NIGHTLY(name, from, to)  ADD_TEST(name, _from_##from, true, 0, from, to)
#define AROUND_EACH(before, after)                                                                                     \
  __attribute__((constructor)) static void around_each(void) {                                                         \
    zp_test_around_each(before, after);                                                                                \
  }
#define AROUND_ALL(before, after)                                                                                      \
  __attribute__((constructor)) static void around_all(void) {                                                          \
    zp_test_around_all(before, after);                                                                                 \
  }

#endif
