/* Threads beside each other get the bits that each would get alone: runs on one model, studies, scenarios with units.
 * Under ThreadSanitizer (.ci/run) also what they share without a lock is found. */
#include <pthread.h>

#include "check_util.h"

#include <zipact/io.h>

enum { THREADS = 4, SIGNALS_MOST = 64 };

/* Four calls at once, each with its part of `job`, `size` bytes. */
static void at_once(void *(*call)(void *), void *job, size_t size) {
  pthread_t thread[THREADS];
  for (size_t k = 0; k < THREADS; k++)
    ck_assert_int_eq(pthread_create(&thread[k], NULL, call, (char *)job + k * size), 0);
  for (size_t k = 0; k < THREADS; k++)
    ck_assert_int_eq(pthread_join(thread[k], NULL), 0);
}

typedef struct Run {
  const ZpModel *model;
  ZpOutcome outcome;
  double row[SIGNALS_MOST];
} Run;

static void *run_on_model(void *job) {
  Run *run = job;
  ZpSim *sim = NULL;
  if (zp_sim_create(run->model, NULL, &sim, NULL) == ZP_OK) run->outcome = zp_sim_run(sim, 1e-3, false, NULL, NULL);
  if (sim) zp_sim_read(sim, run->row);
  zp_sim_destroy(sim);
  return NULL;
}

TESTS(test_runs_share_a_model, 0, 2) {
  static const ZpElectroModel laws[] = {ZP_ELECTRO_PLATES, ZP_ELECTRO_FIELD};
  ZpActuatorDef def = DEF({"mesh.nodes", 9}, {"electro.model", laws[_i]});
  ZpModel *model = model_of(&def);
  Run alone = {.model = model, .outcome = ZP_DIVERGED}, run[THREADS];
  for (size_t k = 0; k < THREADS; k++)
    run[k] = alone;
  at_once(run_on_model, run, sizeof(Run));
  run_on_model(&alone);
  ck_assert_int_eq(alone.outcome, ZP_REACHED_END);
  for (size_t k = 0; k < THREADS; k++) {
    ck_assert_int_eq(run[k].outcome, ZP_REACHED_END);
    ck_assert_mem_eq(run[k].row, alone.row, sizeof alone.row);
  }
  zp_model_destroy(model);
}

typedef struct Study {
  ZpStudy name;
  ZpActuatorDef def;
  ZpResult *result;
} Study;

static void *run_study(void *job) {
  Study *study = job;
  zp_study_run(study->name, &study->def, NULL, NULL, &study->result, NULL);
  return NULL;
}

static void expect_same_numbers(const ZpResult *one, const ZpResult *two) {
  ck_assert(one && two);
  ck_assert_int_eq(one->outcome, two->outcome);
  ck_assert_uint_eq(one->scalars, two->scalars);
  for (size_t i = 0; i < one->scalars; i++)
    if (!one->scalar[i].timing) ck_assert_mem_eq(&one->scalar[i].value, &two->scalar[i].value, sizeof(double));
}

TEST(test_studies_beside_each_other) {
  static const ZpStudy name[THREADS] = {ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_ISOMETRIC, ZP_STUDY_MODES};
  Study study[THREADS];
  for (size_t k = 0; k < THREADS; k++)
    study[k] = (Study){.name = name[k], .def = DEF({"mesh.nodes", 9})};
  at_once(run_study, study, sizeof(Study));
  for (size_t k = 0; k < THREADS; k++) {
    Study alone = {.name = study[k].name, .def = study[k].def};
    run_study(&alone);
    expect_same_numbers(study[k].result, alone.result);
    zp_result_destroy(alone.result);
    zp_result_destroy(study[k].result);
  }
}

static void *parse_units(void *job) {
  static const char text[] = "load: {mass: 9 g}\nribbon: {length: 12 cm, thickness: 50 um}\ndrive: {voltage: 7 kV}\n";
  ZpActuatorDef *def = job;
  ZpScenario *scenario = zp_scenario_create();
  if (zp_scenario_parse(scenario, text, sizeof text - 1, "text", NULL) == ZP_OK)
    zp_scenario_def(scenario, 0, def, NULL);
  zp_scenario_destroy(scenario);
  return NULL;
}

/* The first units of the process: one thread reads the database, the others wait for it. */
TEST(test_units_parsed_at_once) {
  ZpActuatorDef def[THREADS];
  memset(def, 0, sizeof def);
  at_once(parse_units, def, sizeof(ZpActuatorDef));
  for (size_t k = 0; k < THREADS; k++) {
    ck_assert_double_eq(def[k].load.mass, 9e-3);
    ck_assert_double_eq(def[k].ribbon.length, 0.12);
    ck_assert_double_eq(def[k].ribbon.thickness, 50e-6);
    ck_assert_double_eq(def[k].drive.voltage, 7e3);
  }
}
