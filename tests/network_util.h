/* Scenarios of networks as Defs, and numbers of their results. */
#ifndef ZP_TEST_NETWORK_UTIL_H
#define ZP_TEST_NETWORK_UTIL_H

#include "data_util.h"

#include "study/studies.h"

/* A scenario as a Def, without errors unless it says so. */
static inline ZpActuatorDef def_of(const char *text) {
  ZpActuatorDef def = {0};
  ZpScenario *s = new_scenario();
  ck_ok(zp_scenario_parse(s, text, strlen(text), "network.yaml", &err));
  ck_ok(zp_scenario_override(s, "output.errors: false", 20, "errors", &err));
  ck_ok(zp_scenario_def(s, 0, &def, &err));
  lend_members(&def);
  return def;
}

/* A scenario is refused, when it is read or by the study, with these words. */
static inline void ck_scenario_refused(ZpStudy study, const char *text, const char *says) {
  ZpScenario *s = new_scenario();
  ZpActuatorDef def = {0};
  ZpError err = {ZP_OK, ""};
  ZpStatus status = zp_scenario_parse(s, text, strlen(text), "network.yaml", &err);
  if (status == ZP_OK) status = zp_scenario_def(s, 0, &def, &err);
  ZpModel *model = NULL;
  if (status == ZP_OK) status = zp_study_check(study, &def, &err);
  if (status == ZP_OK) status = zp_model_create(&def, &model, &err);
  zp_model_destroy(model);
  zp_def_clear(&def);
  printf("%s\n", err.message);
  ck_assert_int_eq(status, ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, says) != NULL, "no '%s' in: %s", says, err.message);
}

static inline double number(const ZpResult *result, const char *name) {
  ck_assert_msg(zp_result_has(result, name), "no %s", name);
  return zp_result_get(result, name);
}

/* A number of the table of a run. */
static inline double column_of(ZpSim *sim, const ZpActuatorDef *def, const char *name) {
  ZpTable *table = zp_signal_table(def, 1);
  double *row = calloc(zp_sim_columns(sim), sizeof *row), found = NAN;
  zp_sim_read_columns(sim, zp_sim_columns(sim), row);
  for (size_t c = 0; c < zp_table_columns(table); c++)
    if (strcmp(zp_table_column(table, c)->name, name) == 0) found = row[c];
  free(row);
  zp_table_destroy(table);
  return found;
}

#endif
