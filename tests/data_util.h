/* Scenarios, and studies and simulations of a Def that names files. */
#ifndef ZP_TESTS_DATA_UTIL_H
#define ZP_TESTS_DATA_UTIL_H

#include "check_util.h"

#include <zipact/calibrate.h>
#include <zipact/io.h>

#define zp_scenario_destroy(scenario) zp_scenario_destroy(zp_test_releases(scenario))

static inline void destroy_scenario(void *scenario) {
  (zp_scenario_destroy)(scenario);
}

static inline ZpScenario *new_scenario(void) {
  ZpScenario *scenario = zp_scenario_create();
  ck_assert_ptr_nonnull(scenario);
  return zp_test_owns(scenario, destroy_scenario);
}

static inline ZpActuatorDef case_of(const ZpScenario *scenario, size_t index) {
  ZpActuatorDef def = {0};
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_scenario_def(scenario, index, &def, &err) == ZP_OK, "%s", err.message);
  lend_members(&def);
  return def;
}

static inline ZpResult *data_study_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_study_run(study, def, NULL, &result, &err) == ZP_OK, "%s", err.message);
  return zp_test_owns(result, destroy_result);
}

/* The study is refused, by a message with these words, before it runs and as it runs. */
static inline void refuse_study(ZpStudy study, const ZpActuatorDef *def, const char *words) {
  ZpError err = {0};
  ZpResult *result = NULL;
  ck_assert_msg(zp_data_check(study, def, &err) == ZP_BAD_INPUT, "not refused: %s", words);
  ck_assert_msg(strstr(err.message, words) != NULL, "%s", err.message);
  ck_assert_int_eq(zp_data_study_run(study, def, NULL, &result, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(result);
}

static inline ZpSim *data_sim_of(const ZpActuatorDef *def) {
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_sim_create(def, NULL, &model, &sim, &err) == ZP_OK, "%s", err.message);
  zp_test_owns(model, destroy_model);
  return zp_test_owns(sim, destroy_sim);
}

static inline ZpScenario *scenario_with(const char *const *set) {
  ZpError err = {ZP_OK, ""};
  ZpScenario *scenario = new_scenario();
  for (; *set; set++)
    ck_assert_msg(zp_scenario_set(scenario, *set, &err) == ZP_OK, "%s", err.message);
  return scenario;
}

#endif
