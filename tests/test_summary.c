/* summary.json and the data of pictures, of results that are made up: which case, key and number stands where. */
#include "files_util.h"

#include <jansson.h>
#include <sys/stat.h>

#include "io/plan.h"
#include "io/report.h"

/* -- results and what is written of them -------------------------------------------------------------- */

static ZpResult *result_of(ZpStudy study, ZpOutcome outcome, const char *name, double value) {
  ZpResult *result = new_result(study);
  ck_assert_ptr_nonnull(result);
  result->outcome = outcome;
  zp_result_add(result, name, "1", value);
  return result;
}

static json_t *summary_of(const ZpReport *report) {
  char *text = NULL;
  size_t size = 0;
  json_error_t error;
  FILE *file = open_memstream(&text, &size);
  ck_ok(zp_summary_write(report, file, &err));
  fclose(file);
  json_t *summary = json_loads(text, 0, &error);
  ck_assert_msg(summary != NULL, "%s", error.text);
  free(text);
  return summary;
}

static json_t *summary_of_cases(const ZpScenario *scenario, ZpResult *const *result, size_t count) {
  const ZpReport report = {.scenario = scenario, .result = result, .count = count};
  return summary_of(&report);
}

static double number_in(const json_t *object, const char *name) {
  const json_t *value = json_object_get(object, name);
  ck_assert_msg(json_is_number(value), "%s is not a number", name);
  return json_number_value(value);
}

static const char *word_in(const json_t *object, const char *name) {
  const char *word = json_string_value(json_object_get(object, name));
  ck_assert_msg(word != NULL, "%s is no text", name);
  return word;
}

/* -- summary.json ----------------------------------------------------------------------------------- */

/* A sweep that was stopped says so, although all its cases so far are good. */
TEST(interrupted_sweep_counts_its_cases) {
  ZpScenario *scenario = SCENARIO("load.mass=[1 g, 2 g, 3 g]");
  ZpResult *result[] = {result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1),
                        result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 0.5)};
  json_t *summary = summary_of_cases(scenario, result, 2);
  ck_assert_str_eq(word_in(summary, "outcome"), "interrupted");
  ck_assert_str_eq(word_in(summary, "message"), "stopped after 2 of 3 cases");
  json_t *row = json_array_get(json_object_get(summary, "rows"), 0);
  ck_assert(json_is_real(json_object_get(row, "contraction"))); /* also where it is whole */
  json_decref(summary);
}

/* Keys of a group that others come between are in one object: ribbon.young_modulus, medium.permittivity,
 * ribbon.thickness. */
TEST(group_is_one_object) {
  ZpResult *result = result_of(ZP_STUDY_CALIBRATE, ZP_CONVERGED, "ribbon.young_modulus", 3);
  zp_result_add(result, "medium.permittivity", "1", 4);
  zp_result_add(result, "ribbon.thickness", "1", 5);
  json_t *summary = summary_of_cases(new_scenario(), &result, 1), *ribbon = json_object_get(summary, "ribbon");
  ck_assert_double_eq(number_in(ribbon, "young_modulus"), 3);
  ck_assert_double_eq(number_in(ribbon, "thickness"), 5);
  ck_assert_double_eq(number_in(json_object_get(summary, "medium"), "permittivity"), 4);
  json_decref(summary);
}

TEST(rows_say_which_values_are_automatic) {
  ZpScenario *scenario = SCENARIO("solver.tolerance=[auto, 1e-5]");
  ZpResult *result[] = {result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1),
                        result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1)};
  json_t *summary = summary_of_cases(scenario, result, 2), *rows = json_object_get(summary, "rows");
  ck_assert_str_eq(word_in(json_array_get(rows, 0), "solver.tolerance"), "auto");
  ck_assert_double_eq(number_in(json_array_get(rows, 1), "solver.tolerance"), 1e-5);
  json_decref(summary);
}

/* Frequencies and their errors are two arrays, and not numbers of their own besides. */
TEST(errors_of_frequencies_are_an_array) {
  ZpScenario *scenario = SCENARIO("study=modes");
  ZpResult *result = result_of(ZP_STUDY_MODES, ZP_CONVERGED, "frequency_1_Hz", 20);
  zp_result_add(result, "frequency_2_Hz", "Hz", 50);
  zp_result_add(result, "frequency_1_error_Hz", "Hz", 0.25);
  zp_result_add(result, "frequency_2_error_Hz", "Hz", 0.5);
  json_t *summary = summary_of_cases(scenario, &result, 1);
  const json_t *value = json_object_get(summary, "frequencies_Hz"),
               *error = json_object_get(summary, "frequencies_error_Hz");
  ck_assert(json_array_size(value) == 2 && json_array_size(error) == 2);
  ck_assert_double_eq(json_number_value(json_array_get(value, 1)), 50);
  ck_assert_double_eq(json_number_value(json_array_get(error, 0)), 0.25);
  ck_assert_ptr_null(json_object_get(summary, "frequency_1_Hz"));
  ck_assert_ptr_null(json_object_get(summary, "frequency_1_error_Hz"));
  json_decref(summary);
}

TEST(derivatives_stand_by_output_and_key) {
  const int mass = zp_key_find("load.mass"), width = zp_key_find("ribbon.width");
  ZpScenario *scenario = SCENARIO("study=stationary");
  ZpResult *result = result_of(ZP_STUDY_STATIONARY, ZP_CONVERGED, "stroke_m", 0.01);
  zp_result_add_sensitivity(result, "stroke_m", mass, 1.5);
  zp_result_add_sensitivity(result, "opening_m", mass, 3);
  zp_result_add_sensitivity(result, "stroke_m", width, -0.25);
  json_t *summary = summary_of_cases(scenario, &result, 1), *all = json_object_get(summary, "sensitivity");
  ck_assert_double_eq(number_in(json_object_get(all, "stroke_m"), "load.mass"), 1.5);
  ck_assert_double_eq(number_in(json_object_get(all, "stroke_m"), "ribbon.width"), -0.25);
  ck_assert_double_eq(number_in(json_object_get(all, "opening_m"), "load.mass"), 3);
  json_decref(summary);
}

/* The best cases are those of the rows that the optimum names, in its order. */
TEST(optimum_shows_its_own_cases) {
  static const size_t best[] = {2, 0};
  ZpScenario *scenario = SCENARIO("load.mass=[1 g, 2 g, 3 g]");
  ZpResult *result[3];
  for (size_t i = 0; i < 3; i++)
    result[i] = result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 0.25 * (double)i);
  const ZpOptimum optimum = {.row = best, .count = 2, .feasible = true, .excluded = NAN, .outcome = ZP_CONVERGED};
  const ZpReport report = {.scenario = scenario, .result = result, .count = 3, .optimum = &optimum};
  json_t *summary = summary_of(&report);
  const json_t *cases = json_object_get(json_object_get(summary, "optimum"), "cases");
  ck_assert_uint_eq(json_array_size(cases), 2);
  for (size_t i = 0; i < 2; i++) {
    ck_assert_double_eq(number_in(json_array_get(cases, i), "load.mass"), 1e-3 * (double)(best[i] + 1));
    ck_assert_double_eq(number_in(json_array_get(cases, i), "contraction"), 0.25 * (double)best[i]);
  }
  json_decref(summary);
}

/* The largest number of a sweep is that of the cases to which it applies. */
TEST(largest_is_of_the_cases_where_it_holds) {
  ZpScenario *scenario = SCENARIO("load.mass=[1 g, 2 g, 3 g]");
  ZpResult *result[3];
  for (size_t i = 0; i < 3; i++) {
    result[i] = result_of(ZP_STUDY_LIMITS, ZP_CONVERGED, "load_kg", (double)i);
    zp_result_add(result[i], "lifts", "1", i < 2);
  }
  const ZpReport report = {.scenario = scenario, .result = result, .count = 3};
  ck_assert_double_eq(zp_report_largest(&report, "load_kg", "lifts"), 1);
}

/* -- statistics of samples ---------------------------------------------------------------------------- */

/* More outputs than are read at a time, of two keys with a distribution and of one with a list between them. */
enum { OUTPUTS = 10 };
static const char *const output[OUTPUTS] = {"y_0", "y_1", "y_2", "y_3", "y_4", "y_5", "y_6", "y_7", "y_8", "y_9"};

/* Output k of a case: of the first key alone, of the product of both, or of the last key alone; a list value is a
 * factor. */
static double output_of(size_t k, const double value[3]) {
  const double first = value[0] - 50e-6, last = value[2] - 8000, list = value[1];
  return list * (k % 3 == 0 ? 1e6 * first + 3 : k % 3 == 1 ? 1e3 * first * last + 5 : last) * (double)(k + 1);
}

/* Of the samples of a point the first two are independent of each other; each of the others has one key of the second.
 */
static double mean_of(ZpResult *const *result, size_t points, const char *name) {
  double sum = 0;
  for (size_t i = 0; i < 4 * points; i++)
    if (i % 4 < 2) sum += zp_result_get(result[i], name);
  return sum / (2 * (double)points);
}

static void expect_index(const json_t *about, const char *order, const char *key, double value) {
  char name[64];
  snprintf(name, sizeof name, "%s_indices", order);
  const double index = number_in(json_object_get(about, name), key);
  ck_assert_msg(fabs(index - value) < 0.25, "%s of %s: %g, not %g", order, key, index, value);
  snprintf(name, sizeof name, "%s_interval_95", strcmp(order, "total") == 0 ? "total" : "first_order");
  const json_t *pair = json_object_get(json_object_get(about, name), key);
  const double low = json_number_value(json_array_get(pair, 0)), high = json_number_value(json_array_get(pair, 1));
  ck_assert_msg(low <= index && index <= high, "%s of %s: %g is not between %g and %g", order, key, index, low, high);
}

/* Mean and indices of each output are those of the samples of this combination. An output that depends on one key has
 * the indices 1 and 0; one of a product has hardly any of first order, and 1 in total. */
TEST(statistics_are_of_their_samples) {
  ZpScenario *scenario =
      SCENARIO("ribbon.thickness=uniform(40 um, 60 um)", "load.mass=[2 g, 3 g]", "drive.voltage=uniform(6 kV, 10 kV)",
               "sampling.count=256", "sampling.indices=true", "sampling.method=sobol");
  const size_t count = zp_scenario_count(scenario), half = count / 2;
  ZpResult **result = memory_of(count * sizeof(ZpResult *));
  size_t keys;
  zp_scenario_lists(scenario, &keys);
  ck_assert_uint_eq(keys, 3);
  for (size_t i = 0; i < count; i++) {
    double value[3];
    zp_scenario_values(scenario, i, value);
    result[i] = result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, output[0], output_of(0, value));
    for (size_t k = 1; k < OUTPUTS; k++)
      zp_result_add(result[i], output[k], "1", output_of(k, value));
  }
  json_t *summary = summary_of_cases(scenario, result, count), *list = json_object_get(summary, "statistics");
  ck_assert_uint_eq(json_array_size(list), 2);
  for (size_t c = 0; c < 2; c++) {
    const json_t *combination = json_array_get(list, c), *outputs = json_object_get(combination, "outputs");
    ck_assert_double_eq(number_in(combination, "load.mass"), c == 0 ? 2e-3 : 3e-3);
    for (size_t k = 0; k < OUTPUTS; k++) {
      const json_t *about = json_object_get(outputs, output[k]);
      ck_assert_double_eq(number_in(about, "count"), 2 * 256);
      ck_below(fabs(number_in(about, "mean") - mean_of(result + c * half, 256, output[k])),
               1e-12 * number_in(about, "standard_deviation")); /* 1.6e-15 measured */
      expect_index(about, "first_order", "ribbon.thickness", k % 3 == 0);
      expect_index(about, "total", "ribbon.thickness", k % 3 != 2);
      expect_index(about, "first_order", "drive.voltage", k % 3 == 2);
      expect_index(about, "total", "drive.voltage", k % 3 != 0);
    }
  }
  json_decref(summary);
}

/* The first case that failed speaks for all; keys of whole numbers are whole; a note of several cases stands once. */
TEST(failed_case_speaks_for_the_sweep) {
  ZpScenario *scenario = SCENARIO("mesh.nodes=[21, 61]");
  ZpResult *result[] = {result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1),
                        result_of(ZP_STUDY_ACTUATE, ZP_DIVERGED, "contraction", 0)};
  for (size_t i = 0; i < 2; i++)
    zp_result_note(result[i], "the mesh is coarse");
  json_t *summary = summary_of_cases(scenario, result, 2);
  ck_assert_str_eq(word_in(summary, "outcome"), "diverged");
  ck_assert_uint_eq(json_array_size(json_object_get(summary, "notes")), 1);
  const json_t *nodes = json_object_get(json_array_get(json_object_get(summary, "rows"), 1), "mesh.nodes");
  ck_assert(json_is_integer(nodes) && json_integer_value(nodes) == 61);
  json_decref(summary);
}

/* -- files that go, and one that stays ----------------------------------------------------------------- */

static bool is_there(const char *name) {
  char *path = path_of(name);
  return access(path, F_OK) == 0;
}

static ZpShapes *shapes_of(size_t frames) {
  const double x[2] = {0, 1}, y[2] = {0, 0};
  ZpShapes *shapes = zp_shapes_create(1, 2, 4);
  ck_assert_ptr_nonnull(shapes);
  for (size_t i = 0; i < frames; i++)
    zp_shapes_offer(shapes, &(ZpShape){.time = (double)i, .x = x, .y = y});
  return shapes;
}

/* A result over one that had more: its table, its field and its later frames go. */
TEST(files_go_with_their_results) {
  const ZpColumn column = {"time_s", "s", "time"};
  ZpScenario *scenario = SCENARIO("mesh.nodes=9");
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1);
  result->series = zp_table_create(&column, 1, 2);
  result->shapes = shapes_of(4);
  result->map = zp_field_map_create(2, 2);
  write_files(scenario, &result, 1);
  ck_assert(is_there("table.csv") && is_there("field.vts") && is_there("shapes/shape_0003.vtp"));
  zp_table_destroy(result->series);
  zp_shapes_destroy(result->shapes);
  zp_field_map_destroy(result->map);
  result->series = NULL;
  result->map = NULL;
  result->shapes = shapes_of(2);
  write_files(scenario, &result, 1);
  ck_assert(!is_there("table.csv") && !is_there("field.vts"));
  ck_assert(is_there("shapes/shape_0001.vtp") && !is_there("shapes/shape_0002.vtp"));
}

/* A summary says that all files are complete: an old one goes first, and none comes where another file fails. */
TEST(summary_goes_before_files_are_written) {
  ZpScenario *scenario = SCENARIO("mesh.nodes=9");
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, ZP_ZIPPED, "contraction", 1);
  ZpError err;
  const ZpReport report = {.directory = folder, .scenario = scenario, .result = &result, .count = 1};
  char *path = path_of("results.h5");
  write_files(scenario, &result, 1);
  ck_assert(is_there("summary.json"));
  ck_assert(remove(path) == 0 && mkdir(path, 0777) == 0);
  ck_assert_int_eq(zp_report_write(&report, NULL, &err), ZP_MACHINE);
  ck_assert(!is_there("summary.json"));
}

/* The state at the end of a run in time is a file from which that model can continue. */
TEST(state_at_the_end_is_a_file) {
  ZpScenario *scenario = SCENARIO("mesh.nodes=9", "liquid.model=none", "output.errors=false", "solver.end_time=1 ms");
  ZpActuatorDef def = {0};
  ZpCheckpoint *read = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_scenario_def(scenario, 0, &def, &err), ZP_OK);
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  char *path = path_of("checkpoint.zps");
  write_files(scenario, &result, 1);
  ck_ok(zp_checkpoint_read(path, &read, &err));
  ck_ok(zp_checkpoint_check(read, &def, &err));
  zp_checkpoint_destroy(read);
}
