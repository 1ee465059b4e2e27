/* Estimated errors of results. Against: the closed form of a cantilever, whose discretisation error is known; what
 * much finer meshes and shorter steps give. */
#include "check_util.h"

static double value_of(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  ZpResult *result = study_of(study, def);
  double value = zp_result_get(result, name);
  zp_result_destroy(result);
  return value;
}

static bool has(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, name) == 0) return true;
  return false;
}

/* A cantilever that bends little under its own weight sags by q L^4 / (8 EI) (1 + 1 / (3 n^3)) with n elements, by what
 * weight the clamped one hands on: elements four times as long add 63 times that second term, of which (21.1) takes
 * 2 / 15, more than 2 / 3 of the 7 times that elements twice as long add. */
START_TEST(cantilever_in_closed_form) {
  static const int nodes[] = {21, 41, 61};
  int n = nodes[_i] - 1;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE},
                          {"gravity", 1e-3}, {"load.mass", 0}, {"ribbon.length", 50e-3}, {"mesh.nodes", nodes[_i]});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  double cube = pow(n, 3), exact = zp_result_get(result, "stroke_m") / (1 + 1 / (3 * cube));
  ck_near(zp_result_get(result, "stroke_error_m"), 2.0 / 15 * 63 * exact / (3 * cube), 1e-3);
  ck_assert(!has(result, "opening_error_m"));
  zp_result_destroy(result);
}
END_TEST

typedef struct Number {
  ZpStudy study;
  const char *value, *error;
  double most; /* times the error that the estimate may be */
} Number;

static const Number numbers[] = {
    {ZP_STUDY_LIMITS, "pull_in_voltage_V", "pull_in_voltage_error_V", 12},
    {ZP_STUDY_LIMITS, "closing_voltage_V", "closing_voltage_error_V", 12},
    {ZP_STUDY_LIMITS, "release_voltage_V", "release_voltage_error_V", 12},
    {ZP_STUDY_STATIONARY, "opening_m", "opening_error_m", 2.5},
    {ZP_STUDY_ISOMETRIC, "force_N", "force_error_N", 12},
    {ZP_STUDY_MODES, "frequency_3_Hz", "frequency_3_error_Hz", 2.5},
    {ZP_STUDY_ACTUATE, "zip_time_s", "zip_time_error_s", 20},
};

/* The default actuator against four times as many elements, and in motion a hundredth of the tolerance: the estimate
 * covers the error. Measured: 2.1 times (opening, frequency), 9 to 10 times (limits; the held force, whose error
 * depends on where among the nodes the front is), 14 times (zip time). */
START_TEST(estimate_covers_the_error) {
  const Number *number = &numbers[_i];
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 61});
  ZpResult *result = study_of(number->study, &def);
  double value = zp_result_get(result, number->value), error = zp_result_get(result, number->error);
  zp_result_destroy(result);
  def.output.errors = false;
  def.mesh.nodes = 241;
  if (number->study == ZP_STUDY_ACTUATE) def.solver.tolerance = 7e-5;
  double truth = fabs(value - value_of(number->study, &def, number->value));
  printf("%s: error %.3g, estimated %.3g, %.2f times\n", number->value, truth, error, error / truth);
  ck_below(truth, error);
  ck_below(error, number->most * truth);
}
END_TEST

/* Numbers of three meshes, each with half as many elements as the one before => (21.1) with factor F and order p. */
static double of_three(const double f[3], double F, int p) {
  return F * fmax(fabs(f[0] - f[1]) / 3, fabs(f[0] - f[2]) / (pow(4, p) - 1));
}

/* The estimate is what the numbers of the three meshes make of it, by (21.2) where a pull-in is approached from one
 * side (a ribbon of 100 um), else by (21.1) (the default one with few elements; releases and held forces always). */
START_TEST(estimate_is_that_of_three_meshes) {
  static const struct {
    const Number *number;
    double thickness, F;
    int nodes, p;
    bool monotonic;
  } cases[] = {{&numbers[0], 100e-6, 3, 41, 3, true},
               {&numbers[0], 50e-6, 3, 21, 3, false},
               {&numbers[2], 100e-6, 2, 41, 3, false},
               {&numbers[4], 100e-6, 2, 41, 2, false}};
  const Number *number = cases[_i].number;
  ZpActuatorDef def =
      DEF({"output.errors", 1}, {"ribbon.thickness", cases[_i].thickness}, {"mesh.nodes", cases[_i].nodes});
  double error = value_of(number->study, &def, number->error), f[3];
  def.output.errors = false;
  for (int mesh = 0; mesh < 3; mesh++, def.mesh.nodes = (def.mesh.nodes + 1) / 2)
    f[mesh] = value_of(number->study, &def, number->value);
  double ratio = (f[2] - f[1]) / (f[1] - f[0]);
  bool one_side = ratio >= 2 && ratio <= 32;
  printf("%s: %.9g, %.9g, %.9g, estimated %.3g\n", number->value, f[0], f[1], f[2], error);
  if (number == &numbers[0]) ck_assert(one_side == cases[_i].monotonic);
  ck_near(error, cases[_i].monotonic ? 1.25 * fabs(f[0] - f[1]) / 3 : of_three(f, cases[_i].F, cases[_i].p), 1e-9);
}
END_TEST

/* The curve's limits have the same estimates as the limits themselves. */
START_TEST(equilibrium_has_the_estimates_of_limits) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 31});
  for (size_t k = 0; k < 3; k++)
    ck_near(value_of(ZP_STUDY_EQUILIBRIUM, &def, numbers[k].error), value_of(ZP_STUDY_LIMITS, &def, numbers[k].error),
            1e-4);
}
END_TEST

/* output.errors changes nothing but the estimates themselves. */
START_TEST(estimates_leave_the_numbers_alone) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 31}), without = def;
  without.output.errors = false;
  const Number *number = &numbers[_i];
  ZpResult *both[2] = {study_of(number->study, &def), study_of(number->study, &without)};
  ck_assert(has(both[0], number->error));
  for (size_t i = 0; i < both[1]->scalars; i++) {
    ck_assert(!strstr(both[1]->scalar[i].name, "_error_"));
    ck_assert_str_eq(both[0]->scalar[i].name, both[1]->scalar[i].name);
    ck_assert(both[1]->scalar[i].timing ||
              memcmp(&both[0]->scalar[i].value, &both[1]->scalar[i].value, sizeof(double)) == 0);
  }
  zp_result_destroy(both[0]);
  zp_result_destroy(both[1]);
}
END_TEST

/* Three meshes that all miss where the ribbon turns at the clip agree, and all are wrong: of 14 um aluminium under 1 kg
 * by 26 times what they differ by. Elements may be as long as (9.5). */
START_TEST(unresolved_bending_has_no_estimate) {
  const double w = 10e-3, b = 15e-6, m = 0.1, EI = 70e9 * w * b * b * b / 12;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"ribbon.thickness", b}, {"ribbon.width", w}, {"load.mass", m},
                          {"ribbon.young_modulus", 70e9}, {"ribbon.plane", ZP_PLANE_STRESS}, {"ribbon.density", 0},
                          {"insulator.density", 0}, {"insulator.young_modulus", 0});
  double turns = sqrt(EI / (0.5 * m * def.gravity)), half = 0.5 * (def.ribbon.length - def.platform.length);
  def.mesh.nodes = 1 + (int)(half / turns);
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert(isnan(zp_result_get(result, "opening_error_m")));
  ck_assert_ptr_nonnull(strstr(result->note[result->notes - 1], "errors are not estimated"));
  zp_result_destroy(result);
  def.mesh.nodes++;
  ck_assert(!isnan(value_of(ZP_STUDY_STATIONARY, &def, "opening_error_m")));
}
END_TEST

/* Without a coarser mesh, or a number on it, an estimate is missing; the paper's chain has none. */
START_TEST(estimate_may_be_missing) {
  ZpActuatorDef coarse = DEF({"output.errors", 1}, {"mesh.nodes", 6}),
                chain = DEF({"output.errors", 1}, {"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21}),
                weak = DEF({"output.errors", 1}, {"drive.voltage", 1e3});
  ck_assert(isnan(value_of(ZP_STUDY_STATIONARY, &coarse, "stroke_error_m")));
  ck_assert(isnan(value_of(ZP_STUDY_LIMITS, &weak, "pull_in_voltage_error_V")));
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &chain);
  ck_assert(!has(result, "stroke_error_m"));
  zp_result_destroy(result);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("estimate");
  TCase *c = tcase_create("estimate");
  tcase_add_loop_test(c, cantilever_in_closed_form, 0, 3);
  if (!SANITIZED) tcase_add_loop_test(c, estimate_covers_the_error, 0, LENGTH_OF(numbers));
  tcase_add_loop_test(c, estimate_is_that_of_three_meshes, 0, 4);
  tcase_add_test(c, equilibrium_has_the_estimates_of_limits);
  tcase_add_loop_test(c, estimates_leave_the_numbers_alone, 0, LENGTH_OF(numbers));
  tcase_add_test(c, unresolved_bending_has_no_estimate);
  tcase_add_test(c, estimate_may_be_missing);
  suite_add_tcase(suite, c);
  return run_suite(suite);
}
