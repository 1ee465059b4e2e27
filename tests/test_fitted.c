/* Fitted values from calibrate to other studies: the file, the layer, the joint distribution, a design with margins. */
#include "files_util.h"

#include "def/rule.h"
#include "io/fitted.h"
#include "io/plan.h"
#include "io/report.h"
#include "sample/statistics.h"
#include "study/result.h"

static const char of_two[] = "ribbon:\n"
                             "  thickness: 50 um\n"
                             "  young_modulus: 200 GPa\n"
                             "fitted:\n"
                             "  outcome: converged\n"
                             "  ribbon.young_modulus: {standard_error: 20 GPa, interval_95: [160 GPa, 240 GPa]}\n"
                             "  ribbon.thickness:\n"
                             "    standard_error: 1.6 um\n"
                             "    interval_95: [47 um, 53 um]\n"
                             "    correlation: {ribbon.young_modulus: -0.98}\n";

/* The folder has a file of this text. => "base.file=PATH" */
static char *base_of(const char *name, const char *text) {
  char *path = path_of(name), *set = memory_of(strlen(path) + 11);
  write_file(path, text);
  sprintf(set, "base.file=%s", path);
  return set;
}

/* -- the file ---------------------------------------------------------------------------------------- */

/* Of three keys: the second at a bound, so without errors; an end of the interval of the third is not limited. */
static const ZpFitted awkward = {3,
                                 {{.key = ZP_KEY(ribbon.young_modulus),
                                   .value = 0.1 + 1.880000000000001e11,
                                   .error = 1e9 / 3,
                                   .low = 1.87e11 / 7 * 6.9,
                                   .high = 1.9e11},
                                  {.key = ZP_KEY(insulator.permittivity),
                                   .value = 4.62,
                                   .error = NAN,
                                   .low = NAN,
                                   .high = NAN,
                                   .correlation = {NAN}},
                                  {.key = ZP_KEY(ribbon.thickness),
                                   .value = 50e-6 / 3 * 3.1,
                                   .error = 1e-6 / 3,
                                   .low = NAN,
                                   .high = 51e-6,
                                   .correlation = {-1.0 / 3, NAN}}},
                                 ZP_DOUBTFUL};

static void assert_same_number(double a, double b) {
  ck_assert_msg(memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b)), "%.17g became %.17g", a, b);
}

static void assert_same(const ZpFitted *one, const ZpFitted *two) {
  ck_assert_uint_eq(one->count, two->count);
  ck_assert_int_eq(one->outcome, two->outcome);
  for (size_t i = 0; i < one->count; i++) {
    const ZpFittedKey *a = &one->key[i], *b = &two->key[zp_fitted_place(two, a->key)];
    assert_same_number(a->value, b->value);
    assert_same_number(a->error, b->error);
    assert_same_number(a->low, b->low);
    assert_same_number(a->high, b->high);
    for (size_t k = 0; k < one->count; k++)
      assert_same_number(
          zp_fitted_correlation(one, i, k),
          zp_fitted_correlation(two, zp_fitted_place(two, a->key), zp_fitted_place(two, one->key[k].key)));
  }
}

/* A result with the numbers of a fit. */
static ZpResult *result_of(const ZpFitted *fitted) {
  ZpResult *result = zp_result_create(ZP_STUDY_CALIBRATE);
  result->outcome = fitted->outcome;
  snprintf(result->message, sizeof result->message, "3 rows \"fitted\":\nribbon.width: 1 m");
  zp_result_note(result, "residuals are not noise");
  for (size_t i = 0; i < fitted->count; i++) {
    const ZpFittedKey *key = &fitted->key[i];
    const char *name = ZP_KEY_NAME(key->key);
    zp_result_add_of(result, "#", name, "1", key->value);
    zp_result_add_of(result, "#_standard_error", name, "1", key->error);
    zp_result_add_of(result, "#_interval_95_low", name, "1", key->low);
    zp_result_add_of(result, "#_interval_95_high", name, "1", key->high);
    if (i > 0) zp_result_add_of(result, "#_correlation_1", name, "1", key->correlation[0]);
    if (i > 1) zp_result_add_of(result, "#_correlation_2", name, "1", key->correlation[1]);
  }
  return zp_test_owns(result, destroy_result);
}

/* A report of calibrate has it, with all numbers to the last bit; one of another study removes it. */
TEST(report_is_read_back) {
  ZpScenario *s = SCENARIO("study=calibrate", "data.file=none.csv",
                           "calibrate.fit=ribbon.young_modulus, insulator.permittivity, ribbon.thickness");
  ZpResult *result = result_of(&awkward), *other = zp_test_owns(zp_result_create(ZP_STUDY_MODES), destroy_result);
  ZpFitted back;
  write_files(s, &result, 1);
  ck_ok(zp_fitted_read(path_of("fitted.yaml"), &back, &err));
  assert_same(&awkward, &back);
  write_files(SCENARIO("study=modes"), &other, 1);
  ck_says(zp_fitted_read(path_of("fitted.yaml"), &back, &err), ZP_BAD_INPUT, "cannot be opened");
}

/* It is a scenario, too, which has the values. */
TEST(file_is_a_scenario) {
  ZpScenario *s = new_scenario();
  ck_ok(zp_scenario_parse(s, of_two, strlen(of_two), "fitted.yaml", &err));
  ck_assert_uint_eq(zp_scenario_count(s), 1);
  ck_assert_double_eq(case_of(s, 0).ribbon.thickness, 50e-6);
  ck_says(zp_scenario_parse(s, "fitted: 3", 9, "test.yaml", &err), ZP_BAD_INPUT, "fitted: unknown key");
}

/* -- the layer --------------------------------------------------------------------------------------- */

/* What the scenario gives wins over base.file, that over a material and a preset. */
TEST(values_are_below_the_scenario) {
  ZpScenario *s = SCENARIO(base_of("two.yaml", of_two), "ribbon.material=brass", "preset=paper-code", "mesh.nodes=21");
  ck_assert_uint_eq(zp_scenario_count(s), 1);
  ck_assert_double_eq(case_of(s, 0).ribbon.young_modulus, 200e9);
  ck_assert_double_eq(case_of(s, 0).ribbon.thickness, 50e-6);
  ck_assert_double_eq(case_of(s, 0).ribbon.density, 8440);
  ck_ok(zp_scenario_set(s, "ribbon.thickness=[60 um, 70 um]", &err));
  ck_assert_double_eq(case_of(s, 1).ribbon.thickness, 70e-6);
  ck_assert_double_eq(case_of(s, 1).ribbon.young_modulus, 200e9);
  ck_ok(zp_scenario_set(s, "base.file=\"\"", &err));
  ck_assert_double_eq(case_of(s, 1).ribbon.young_modulus, 110e9);
}

/* A path is relative to the file of the scenario. */
TEST(path_is_that_of_the_scenario) {
  ZpScenario *s = new_scenario();
  base_of("two.yaml", of_two);
  write_file(path_of("own.yaml"), "base.file: two.yaml\n");
  ck_ok(zp_scenario_read(s, path_of("own.yaml"), &err));
  ck_assert_double_eq(case_of(s, 0).ribbon.thickness, 50e-6);
}

/* Files that are refused, and how. */
static const struct {
  const char *text, *message;
} wrong[] = {
    {"ribbon.thickness: 50 um\n", "not a fitted file: it has no section \"fitted\""},
    {"fitted: {outcome: converged}\n", "not a fitted file"},
    {"study: limits\n", "wrong.yaml:1: study: not a real number of an actuator, which alone can be fitted (is this a"},
    {"ribbon.thickness: 50 K\nfitted: {outcome: converged}\n",
     "wrong.yaml:1: ribbon.thickness = \"50 K\": not a length"},
    {"ribbon.thickness: 1 km\nfitted: {outcome: converged}\n", "out of range; 1 um to 5000 um"},
    {"solver.time_step: auto\nfitted: {outcome: converged}\n", "a fitted key has a number"},
    {"ribbon.thickness: [1 um, 2 um]\nfitted: {outcome: converged}\n", "a fitted key has one value"},
    {"ribbon.thickness: 50 um\nfitted:\n  outcome: good\n", "wrong.yaml:3: fitted.outcome: not an outcome"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {error: 1 um}\n", "unknown; a fitted file has"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {standard_error: 0 um}\n", "give a number above 0"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {standard_error: 1 s}\n", "not a length"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {interval_95: 1 um}\n", "takes two numbers"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {correlation: {ribbon.width: 2}}\n",
     "from -1 to 1, or null"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {correlation: {ribbon.thickness: 1}}\n",
     "with another key"},
    {"ribbon.thickness: 50 um\nfitted:\n  ribbon.width: {standard_error: 1 um}\n", "ribbon.width: no value"},
    {"ribbon.tickness: 50 um\nfitted: {outcome: converged}\n", "did you mean ribbon.thickness"},
};

TESTS(wrong_files_are_refused, 0, LENGTH_OF(wrong)) {
  ZpScenario *s = SCENARIO(base_of("wrong.yaml", wrong[_i].text));
  ZpActuatorDef def = {0};
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, wrong[_i].message);
  ck_ok(zp_scenario_set(s, base_of("two.yaml", of_two), &err)); /* a later --set mends it */
  ck_assert_double_eq(case_of(s, 0).ribbon.thickness, 50e-6);
}

static void refuse(ZpScenario *s, const char *message) {
  ZpActuatorDef def = {0};
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, message);
}

/* A missing file with the line that names it, a distribution without a file, keys without errors, indices of correlated
 * keys, and values that a scenario cannot have. */
TEST(wrong_uses_are_refused) {
  ZpScenario *s = new_scenario();
  const char text[] = "study: limits\nbase.file: none.yaml\n";
  ck_ok(zp_scenario_parse(s, text, strlen(text), "test.yaml", &err));
  refuse(s, "test.yaml:2: base.file: ");
  refuse(s, "none.yaml: cannot be opened");
  refuse(SCENARIO("sampling.tolerances=base"), "base.file is not given");
  s = SCENARIO(base_of("two.yaml", of_two), "sampling.tolerances=base", "sampling.indices=true");
  refuse(s, "Sobol indices are defined for independent keys");
  const char unknown[] =
      "ribbon.width: 10 mm\nfitted:\n  ribbon.width: {standard_error: null, interval_95: [null, null]}\n";
  s = SCENARIO(base_of("unknown.yaml", unknown));
  ck_assert_double_eq(case_of(s, 0).ribbon.width, 10e-3);
  ck_ok(zp_scenario_set(s, "sampling.tolerances=base", &err));
  refuse(s, "ribbon.width has no standard error in base.file; give it a value or a distribution");
  ck_ok(zp_scenario_set(s, "ribbon.width=normal(10 mm, 1 mm)", &err));
  ck_assert(case_of(s, 0).ribbon.width != case_of(s, 1).ribbon.width);
  const char long_platform[] = "platform.length: 150 mm\nfitted: {outcome: converged}\n";
  s = SCENARIO(base_of("long.yaml", long_platform));
  refuse(s, "base.file: a value of it is refused: platform.length");
}

/* -- the joint distribution -------------------------------------------------------------------------- */

/* Samples have the means, errors and correlation of the file; the written scenario gives the same. A key that the
 * scenario gives itself is no part of it any more. */
TESTS(samples_are_those_of_the_fit, 0, 3) {
  static const char *const method[] = {"sampling.method=sobol", "sampling.method=latin_hypercube",
                                       "sampling.method=random"};
  static const double error[] = {4.3e-3, 1.9e-2, 2.8e-2}; /* 1.4e-3, 6.2e-3, 9.4e-3 measured */
  enum { SAMPLES = 2048 };
  ZpScenario *s = SCENARIO(base_of("two.yaml", of_two), "sampling.tolerances=base", "sampling.count=2048", method[_i]);
  double modulus = 0, thickness = 0, square = 0, product = 0;
  ck_assert_uint_eq(zp_scenario_count(s), SAMPLES);
  for (size_t i = 0; i < SAMPLES; i++) {
    const ZpActuatorDef def = case_of(s, i);
    const double a = (def.ribbon.young_modulus - 200e9) / 20e9, b = (def.ribbon.thickness - 50e-6) / 1.6e-6;
    modulus += a / SAMPLES;
    thickness += b / SAMPLES;
    square += a * a / SAMPLES;
    product += a * b / SAMPLES;
  }
  ck_below(fabs(modulus), error[_i]);
  ck_below(fabs(thickness), error[_i]);
  ck_below(fabs(square - 1), error[_i]);
  ck_below(fabs(product + 0.98), error[_i]);
  char *text = NULL;
  size_t size;
  ck_ok(zp_scenario_text(s, &text, &size, &err));
  zp_test_owns(text, free);
  ZpScenario *back = new_scenario();
  ck_ok(zp_scenario_parse(back, text, size, "back.yaml", &err));
  ck_assert_double_eq(case_of(back, 77).ribbon.thickness, case_of(s, 77).ribbon.thickness);
  ck_assert_uint_eq(zp_scenario_count(back), SAMPLES);
}

/* One key has the plain normal distribution, to the last bit. */
TEST(one_key_is_plainly_normal) {
  ZpScenario *joint = SCENARIO(base_of("two.yaml", of_two), "sampling.tolerances=base", "ribbon.thickness=50 um"),
             *plain = SCENARIO("ribbon.young_modulus=normal(200 GPa, 20 GPa)");
  for (size_t i = 0; i < zp_scenario_count(plain); i++)
    ck_assert_double_eq(case_of(joint, i).ribbon.young_modulus, case_of(plain, i).ribbon.young_modulus);
}

/* A standard error of half the value reaches below the least value of the key, where it is cut. */
TEST(values_stay_in_their_range) {
  const char wide[] = "ribbon.thickness: 50 um\nfitted:\n  ribbon.thickness: {standard_error: 25 um}\n";
  ZpScenario *s = SCENARIO(base_of("wide.yaml", wide), "sampling.tolerances=base", "sampling.count=1024");
  const ZpKey *key = zp_key(ZP_KEY(ribbon.thickness));
  double least = INFINITY;
  for (size_t i = 0; i < 1024; i++) {
    const double thickness = case_of(s, i).ribbon.thickness;
    ck_assert(thickness >= key->min && thickness <= key->max);
    least = fmin(least, thickness);
  }
  ck_below(least, 2e-6);
}

/* -- what other studies make of it ------------------------------------------------------------------- */

static ZpResult *run(const ZpScenario *s, size_t index) {
  const ZpActuatorDef def = case_of(s, index);
  return data_study_of(zp_scenario_study(s), &def);
}

/* A good fit needs no note. A doubtful one gets one, and so does a distribution of a key whose interval has no end. */
TEST(doubts_are_noted) {
  const char doubtful[] = "ribbon.width: 10 mm\nfitted:\n  outcome: doubtful\n"
                          "  ribbon.width: {standard_error: 1 mm, interval_95: [8 mm, null]}\n";
  ZpScenario *s = SCENARIO("study=stationary", "liquid.model=none", "mesh.nodes=11", "output.errors=false",
                           base_of("two.yaml", of_two));
  ck_assert_uint_eq(notes_with(run(s, 0), "base.file"), 0);
  ck_ok(zp_scenario_set(s, base_of("doubtful.yaml", doubtful), &err));
  ck_assert_uint_eq(notes_with(run(s, 0), "base.file: outcome doubtful of the fit in"), 1);
  ck_assert_uint_eq(notes_with(run(s, 0), "ribbon.width"), 0);
  ck_ok(zp_scenario_set(s, "sampling.tolerances=base", &err));
  ck_assert_uint_eq(notes_with(run(s, 1), "do not limit ribbon.width, so its normal distribution is a guess"), 1);
}

/* Standard deviation of the pull-in voltage over the samples of a scenario. */
static double deviation_of(const ZpScenario *s) {
  enum { SAMPLES = 64 };
  double value[SAMPLES];
  ZpSample work[SAMPLES];
  ck_assert_uint_eq(zp_scenario_count(s), SAMPLES);
  for (size_t i = 0; i < SAMPLES; i++)
    value[i] = zp_result_get(run(s, i), "pull_in_voltage_V");
  return zp_statistics(zp_scenario_design(s), value, work).number[ZP_STANDARD_DEVIATION];
}

/* A fit that tells the stiffness E h^3 but neither factor: with the correlation the pull-in voltage is known well,
 * without it it seems not to be. To first order its variance is g C g, with g from sensitivity.by. */
TEST(margins_need_the_correlation) {
  ZpScenario *s = SCENARIO("study=limits", "liquid.model=none", "mesh.nodes=21", "output.errors=false",
                           base_of("two.yaml", of_two), "sensitivity.by=ribbon.young_modulus, ribbon.thickness");
  const ZpResult *at = run(s, 0);
  double g[2];
  for (size_t i = 0; i < at->sensitivities; i++)
    if (strcmp(at->sensitivity[i].output, "pull_in_voltage_V") == 0)
      g[at->sensitivity[i].key == ZP_KEY(ribbon.thickness)] = at->sensitivity[i].value;
  const double a = g[0] * 20e9, b = g[1] * 1.6e-6;
  ck_ok(zp_scenario_set(s, "sensitivity.by=\"\"", &err));
  ck_ok(zp_scenario_set(s, "sampling.tolerances=base", &err));
  ck_ok(zp_scenario_set(s, "sampling.count=64", &err));
  const double together = deviation_of(s);
  ck_near(together, sqrt(a * a + b * b - 2 * 0.98 * a * b), 0.15); /* 0.064 measured: thickness is not linear */
  ck_ok(zp_scenario_set(s, "ribbon.young_modulus=normal(200 GPa, 20 GPa)", &err));
  const double apart = deviation_of(s);
  ck_near(apart, sqrt(a * a + b * b), 0.1); /* 0.036 */
  ck_below(together, 0.3 * apart);
}
