/* What tests of files share: a folder of their own, scenarios from assignments, reports of results. */
#ifndef ZP_TESTS_FILES_UTIL_H
#define ZP_TESTS_FILES_UTIL_H

#include "data_util.h"

#include <unistd.h>

#include <zipact/io.h>

static char folder[64]; /* of the test that runs */

static void make_folder(void) {
  snprintf(folder, sizeof folder, "files-XXXXXX");
  ck_assert_ptr_nonnull(mkdtemp(folder));
}

static void remove_folder(void) {
  char command[128];
  snprintf(command, sizeof command, "rm -r %s", folder);
  ck_assert_int_eq(system(command), 0); // NOLINT: the command is the test's own
}

AROUND_EACH(make_folder, remove_folder)

/* "FOLDER/name". */
static inline char *path_of(const char *name) {
  char *path = memory_of(strlen(folder) + strlen(name) + 2);
  sprintf(path, "%s/%s", folder, name);
  return path;
}

/* A scenario without pictures. */
#define SCENARIO(...) scenario_with((const char *const[]){"output.plots=false", __VA_ARGS__, NULL})

static inline void write_files(const ZpScenario *scenario, ZpResult *const *result, size_t count) {
  ZpError err = {ZP_OK, ""};
  const ZpReport report = {.directory = folder, .scenario = scenario, .result = result, .count = count};
  ck_assert_msg(zp_report_write(&report, NULL, &err) == ZP_OK, "%s", err.message);
}

#endif
