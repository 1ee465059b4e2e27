/* Fuzzing of the scenario reader (libFuzzer): no bytes may crash it, and what it takes must be written so
 * that it reads back to the same Defs, bit by bit. Build with clang -fsanitize=fuzzer,address,undefined. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/io.h>

#include "def/check.h"

enum { DEFS_MOST = 8, ROWS_MOST = 100 /* written scenarios resolve all rows: keep it fast */ };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int condition, const char *what, const ZpError *err) {
  if (condition) return;
  fprintf(stderr, "fuzz_scenario: %s: %s\n", what, err->message);
  abort();
}

static void compare_defs(const ZpActuatorDef *a, const ZpActuatorDef *b) {
  for (int i = 0; zp_key(i); i++) {
    double x = zp_def_get(a, i), y = zp_def_get(b, i);
    if ((isnan(x) && isnan(y)) || memcmp(&x, &y, sizeof x) == 0) continue;
    ZpError where;
    snprintf(where.message, sizeof where.message, "%s: %.17g, %.17g", ZP_KEY_NAME(i), x, y);
    require(false, "value changed", &where);
  }
}

static void compare(const ZpScenario *a, const ZpScenario *b) {
  ZpError err = {0};
  require(zp_scenario_count(a) == zp_scenario_count(b), "count changed", &err);
  require(zp_scenario_study(a) == zp_scenario_study(b), "study changed", &err);
  for (size_t i = 0; i < zp_scenario_count(a) && i < DEFS_MOST; i++) {
    ZpActuatorDef x = {0}, y = {0};
    ZpStatus status = zp_scenario_def(a, i, &x, &err);
    require(zp_scenario_def(b, i, &y, &err) == status, "status changed", &err);
    if (status == ZP_OK) compare_defs(&x, &y);
    zp_def_clear(&x);
    zp_def_clear(&y);
  }
}

static void write_and_compare(const ZpScenario *scenario) {
  char *text = NULL;
  size_t size = 0;
  ZpError err = {0};
  FILE *file = open_memstream(&text, &size);
  if (!file) abort();
  ZpStatus status = zp_scenario_write(scenario, file, &err);
  if (fclose(file)) abort();
  if (status == ZP_OK) {
    ZpScenario *back = zp_scenario_create();
    require(back != NULL, "no memory", &err);
    require(zp_scenario_parse(back, text, size, "written", &err) == ZP_OK, "written text refused", &err);
    compare(scenario, back);
    zp_scenario_destroy(back);
  }
  free(text);
}

/* The bytes as an argument of --set, too, where they have the form of one. */
static void set_from(ZpScenario *scenario, const uint8_t *data, size_t size) {
  char *argument = calloc(size + 1, 1);
  if (!argument) abort();
  memcpy(argument, data, size);
  ZpError err = {0};
  ZpStatus status = zp_scenario_set(scenario, argument, &err);
  require(status == ZP_OK || (err.status == status && *err.message), "no reason given", &err);
  free(argument);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  ZpScenario *scenario = zp_scenario_create();
  ZpError err = {0};
  if (!scenario) abort();
  set_from(scenario, data, size);
  ZpStatus status = zp_scenario_parse(scenario, (const char *)data, size, "fuzz", &err);
  require(status == ZP_OK || (err.status == status && *err.message), "no reason given", &err);
  if (zp_scenario_count(scenario) <= ROWS_MOST) write_and_compare(scenario);
  zp_scenario_destroy(scenario);
  return 0;
}
