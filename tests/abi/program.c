/* A program that was compiled with the headers of abi-2.h and runs with a later library: it reads and sets what it knew
 * then, all by name. Prints what it found, for comparison, and exits with 1 if anything was wrong. With -DWITH_FILES it
 * also uses the library of files. */
#include "abi-2.h"

#include <math.h>
#include <string.h>

static int failures;

static void check(bool good, const char *what) {
  failures += !good;
  if (!good) printf("FAILED: %s\n", what);
}

/* Every key takes its default, its bounds and its words again. */
static void set_all_keys(void) {
  ZpActuatorDef *def = zp_def_create(), *plain = zp_def_copy(def);
  for (int k = 0; k < zp_key_count(); k++) {
    const ZpKey *key = zp_key(k);
    check(zp_key_find(key->name) == k, key->name);
    if (!zp_key_in_def(k)) continue;
    bool text = key->type == ZP_KEY_TEXT;
    check((text ? zp_def_set_text(def, k, "a", NULL) : zp_def_set(def, k, key->max, NULL)) == ZP_OK, key->name);
    check(text ? !strcmp(zp_def_text(def, k), "a") : zp_def_get(def, k) == key->max, key->name);
    if (!text) check(zp_def_set(def, k, key->max * 2 + 1, NULL) == ZP_BAD_INPUT, key->name);
    for (int word = 0; key->choices && word <= (int)key->max; word++)
      check(zp_key_choice(k, key->choices[word].word) == word, key->choices[word].word);
    if (!text) zp_def_set(def, k, zp_def_get(plain, k), NULL);
  }
  check(zp_def_set_word(def, "actuator.kind", "flange", NULL) == ZP_OK, "a word");
  check((int)zp_def_number(def, "actuator.kind") == ZP_KIND_FLANGE, "the number of a word");
  check((int)zp_def_number(plain, "contact.model") == ZP_CONTACT_UNILATERAL, "the number of another word");
  zp_def_destroy(def);
  zp_def_destroy(plain);
}

/* A Def that has been given, and beside it memory that nobody may write. */
static ZpActuatorDef *short_run(void) {
  ZpActuatorDef *def = zp_def_create();
  zp_def_set_number(def, "mesh.nodes", 11, NULL);
  zp_def_set_number(def, "solver.end_time", 2e-3, NULL);
  zp_def_set_number(def, "output.errors", 0, NULL);
  return def;
}

static void run_a_simulation(void) {
  ZpActuatorDef *def = short_run();
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  struct {
    unsigned char before[64];
    ZpError err;
    unsigned char behind[64];
  } guarded;
  memset(&guarded, 0x5A, sizeof guarded);
  ZpRunInfo *info = zp_run_info_create();
  check(zp_model_create(def, &model, &guarded.err) == ZP_OK, "a model");
  check(zp_sim_create(model, NULL, &sim, &guarded.err) == ZP_OK, "a simulation");
  check(zp_def_set_number(def, "load.mass", -1, &guarded.err) == ZP_BAD_INPUT, "a refusal");
  for (size_t k = 0; k < sizeof guarded.before; k++)
    check(guarded.before[k] == 0x5A && guarded.behind[k] == 0x5A, "memory beside an error");
  check(zp_sim_run(sim, 2e-3, false, NULL, info) == ZP_REACHED_END, "a run");
  printf("steps %g, stroke %.17g m, nodes %g\n", zp_run_info_get(info, "steps"), zp_sim_get(sim, "stroke"),
         zp_model_get(model, "nodes"));
  size_t signals;
  zp_signal_columns(&signals);
  double row[1024];
  if (signals <= sizeof row / sizeof row[0]) zp_sim_read(sim, row);
  check(row[zp_signal_find("stroke")] == zp_sim_get(sim, "stroke"), "a signal of a row");
  ZpShape shape = zp_sim_shape(sim);
  printf("gap in the middle %.17g m\n", shape.gap[10]);
  zp_run_info_destroy(info);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  zp_def_destroy(def);
}

static void run_a_study(void) {
  ZpActuatorDef *def = short_run();
  ZpResult *result = NULL;
  check(zp_study_run(ZP_STUDY_ACTUATE, def, NULL, NULL, &result, NULL) == ZP_OK, "a study");
  printf("%s, %s: %s\n", zp_study_name(zp_result_study(result)), zp_outcome_name(zp_result_outcome(result)),
         zp_result_message(result));
  const ZpTable *table = zp_result_series(result);
  const ZpShapes *shapes = zp_result_shapes(result);
  size_t last = zp_table_rows(table) - 1;
  printf("%zu rows, the last opening %.17g m, %zu shapes\n", last + 1, zp_table_get(table, last, "opening_m"),
         zp_shapes_frames(shapes));
  for (size_t c = 0; c < zp_table_columns(table); c++)
    if (!strcmp(zp_table_column(table, c)->name, "opening_m"))
      check(zp_table_row(table, last)[c] == zp_table_get(table, last, "opening_m"), "a column");
  for (size_t k = 0; k < zp_result_scalars(result); k++)
    check(!isnan(zp_result_get(result, zp_result_scalar(result, k)->name)) || isnan(zp_result_scalar(result, k)->value),
          zp_result_scalar(result, k)->name);
  zp_result_destroy(result);
  zp_def_destroy(def);
}

#ifdef WITH_FILES
static void read_a_scenario(void) {
  static const char text[] = "load: {mass: [8 g, 20 g]}\nmesh: {nodes: 11}\n";
  ZpScenario *scenario = zp_scenario_create();
  ZpActuatorDef *def = zp_def_create();
  ZpError err;
  check(zp_scenario_parse(scenario, text, sizeof text - 1, "text", &err) == ZP_OK, "a scenario");
  check(zp_scenario_count(scenario) == 2, "two Defs");
  check(zp_scenario_def(scenario, 1, def, &err) == ZP_OK && zp_def_number(def, "load.mass") == 0.02, "the second");
  check(zp_def_set_value(def, "load.mass", "30 g", &err) == ZP_OK && zp_def_number(def, "load.mass") == 0.03, "a unit");
  ZpResult *result = NULL;
  check(zp_data_study_run(ZP_STUDY_STATIONARY, def, NULL, &result, &err) == ZP_OK, "a study with files");
  zp_result_destroy(result);
  zp_def_destroy(def);
  zp_scenario_destroy(scenario);
}
#endif

int main(void) {
  set_all_keys();
  run_a_simulation();
  run_a_study();
#ifdef WITH_FILES
  read_a_scenario();
#endif
  return failures > 0;
}
