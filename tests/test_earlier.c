/* Files of zipact 0.1.0, in tests/data: its scenarios give its numbers; its checkpoint, its journal and the state of
 * its FMU are refused by a message that names it. Python's tests do the same with its pickles. */
#include "files_util.h"

#include <sys/stat.h>

#include <zipact/campaign.h>
#include <zipact/version.h>

#include "fmu/instance.h"

#define DATA ZP_SOURCE_DIR "/tests/data/0.1.0/"

/* The bytes of a file, ended by a 0; to be freed. */
static char *bytes_of(const char *path, size_t *size) {
  enum { MOST = 1 << 16 };
  FILE *file = fopen(path, "rb");
  ck_assert_msg(file != NULL, "%s", path);
  char *byte = calloc(MOST, 1);
  *size = fread(byte, 1, MOST - 1, file);
  fclose(file);
  ck_assert_uint_lt(*size, MOST - 1);
  return zp_test_owns(byte, free);
}

/* -- scenarios ------------------------------------------------------------------------------------- */

static double number_in(const char *json, const char *name) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": ", name);
  const char *found = strstr(json, quoted);
  ck_assert_msg(found != NULL, "no %s", name);
  return strncmp(found + strlen(quoted), "null", 4) == 0 ? NAN : strtod(found + strlen(quoted), NULL);
}

/* Errors are estimates, residuals are rounding, and iterations are the way; what a number is not, it was not before. */
static void same_numbers(const ZpResult *result, const char *json) {
  size_t compared = 0;
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *s = &result->scalar[i];
    const bool of_way = strcmp(s->name, "residual") == 0 || strcmp(s->name, "iterations") == 0;
    if (s->timing || strstr(s->name, "error") || of_way) continue;
    const double was = number_in(json, s->name);
    ck_assert_msg(isnan(was) ? isnan(s->value) : fabs(s->value - was) <= 1e-9 * fabs(was), "%s: %.17g, was %.17g",
                  s->name, s->value, was);
    compared++;
  }
  ck_assert_uint_ge(compared, 5);
}

TESTS(scenarios_give_the_same_numbers, 0, 5) {
  static const char *const name[] = {"actuate", "stationary", "limits", "isometric", "cycle"};
  char path[256];
  size_t size;
  ZpActuatorDef def = {0};
  ZpScenario *scenario = new_scenario();
  snprintf(path, sizeof path, DATA "%s.yaml", name[_i]);
  ck_ok(zp_scenario_read(scenario, path, &err));
  ck_ok(zp_scenario_def(scenario, 0, &def, &err));
  ZpResult *result = study_of(zp_scenario_study(scenario), &def);
  snprintf(path, sizeof path, DATA "%s.json", name[_i]);
  char *json = bytes_of(path, &size);
  same_numbers(result, json);
}

/* -- states and rows -------------------------------------------------------------------------------- */

static void says(const ZpError *err, const char *reason) {
  ck_assert_int_eq(err->status, ZP_BAD_INPUT);
  ck_assert_msg(strstr(err->message, reason) != NULL, "no '%s' in: %s", reason, err->message);
}

TEST(checkpoint_names_its_version) {
  ZpError err = {ZP_OK, ""};
  ZpCheckpoint *checkpoint;
  ck_assert_int_eq(zp_checkpoint_read(DATA "checkpoint.zps", &checkpoint, &err), ZP_BAD_INPUT);
  says(&err, "checkpoint.zps: of version 9 of the format, by zipact 0.1.0; ");
}

TEST(state_of_an_fmu_names_its_version) {
  ZpError err = {ZP_OK, ""};
  ZpFmu *fmu;
  size_t size;
  const ZpActuatorDef def = DEF({"mesh.nodes", 5}, {"liquid.model", ZP_LIQUID_NONE});
  ZpFmuStart start = {.layout = zp_fmu_keys_mark(), .token = "test"};
  for (int key = 0; key < ZP_KEYS; key++)
    start.value[key] = zp_fmu_has_number(key) ? zp_def_get(&def, key) : 0;
  char *byte = bytes_of(DATA "state.fmu", &size);
  ck_assert_int_eq(zp_fmu_create(&start, &fmu, NULL), ZP_OK);
  ck_assert_int_eq(zp_fmu_load(fmu, byte, size, &err), ZP_BAD_INPUT);
  says(&err, "by an FMU of zipact 0.1.0");
  ck_assert_int_eq(fmu->phase, ZP_FMU_INSTANTIATED);
  zp_fmu_destroy(fmu);
}

/* A journal of an unfinished sweep: it is not continued, and not replaced either. */
TEST(journal_names_its_version) {
  ZpError err = {ZP_OK, ""};
  ZpCampaign *campaign;
  size_t size;
  struct stat kept;
  ZpScenario *scenario = new_scenario();
  char *byte = bytes_of(DATA "journal.sqlite", &size), *path;
  path = path_of("journal.sqlite");
  FILE *file = fopen(path, "wb");
  ck_assert_uint_eq(fwrite(byte, 1, size, file), size);
  ck_assert_int_eq(fclose(file), 0);
  ck_assert_int_eq(zp_scenario_set(scenario, "study=limits", NULL), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(scenario, "load.mass=[8 g, 12 g, 16 g, 20 g]", NULL), ZP_OK);
  for (int resume = 0; resume < 2; resume++) {
    const ZpCampaignOptions options = {.jobs = 1, .resume = resume};
    zp_campaign_open(scenario, folder, &options, &campaign, &err);
    says(&err, resume ? "a journal of zipact 0.1.0" : "3 of 4 cases of an unfinished campaign");
    ck_assert_ptr_null(campaign);
    ck_assert(stat(path, &kept) == 0 && (size_t)kept.st_size == size);
  }
}
