/* Estimated errors of results. Against: the closed form of a cantilever, whose discretisation error is known; what
 * much finer meshes and shorter steps give. */
#include "check_util.h"

static double value_of(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  return zp_result_get(study_of(study, def), name);
}

static bool has(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, name) == 0) return true;
  return false;
}

/* A cantilever that bends little under its own weight sags by q L^4 / (8 EI) (1 + 1 / (3 n^3)) with n elements, by what
 * weight the clamped one hands on. The estimate comes from two thirds of the elements, by order two. */
TESTS(cantilever_in_closed_form, 0, 3) {
  static const int nodes[] = {22, 43, 61};
  const double n = nodes[_i] - 1, fewer = 2 * n / 3, cube = pow(n, 3), cubed = pow(fewer, 3);
  ZpActuatorDef def = DEF({"output.errors", 1}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE},
                          {"gravity", 1e-3}, {"load.mass", 0}, {"ribbon.length", 50e-3}, {"mesh.nodes", nodes[_i]});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  double exact = zp_result_get(result, "stroke_m") / (1 + 1 / (3 * cube));
  double expected = 2.5 * exact * (1 / cubed - 1 / cube) / 3 / (9.0 / 4 - 1);
  ck_near(zp_result_get(result, "stroke_error_m"), expected, 2e-9);
  ck_assert(!has(result, "opening_error_m"));
}

typedef struct Number {
  ZpStudy study;
  const char *value, *error;
  double most; /* times the error that the estimate may be */
  double safety;
  bool powers; /* errors of both orders */
} Number;

static const Number numbers[] = {
    {ZP_STUDY_LIMITS, "pull_in_voltage_V", "pull_in_voltage_error_V", 3, 2, false},
    {ZP_STUDY_LIMITS, "closing_voltage_V", "closing_voltage_error_V", 3, 2, false},
    {ZP_STUDY_LIMITS, "release_voltage_V", "release_voltage_error_V", 5, 2, false},
    {ZP_STUDY_STATIONARY, "opening_m", "opening_error_m", 5, 2.5, true},
    {ZP_STUDY_ISOMETRIC, "force_N", "force_error_N", 12, 2, false},
    {ZP_STUDY_MODES, "frequency_3_Hz", "frequency_3_error_Hz", 2.5, 1.75, true},
    {ZP_STUDY_ACTUATE, "zip_time_s", "zip_time_error_s", 20, 3, true},
    {ZP_STUDY_LIMITS, "max_load_kg", "max_load_error_kg", 12, 2, false},
};

/* The default actuator against four times as many elements, and in motion a hundredth of the tolerance: the estimate
 * covers the error. Measured: 1.2 times (pull-in, closing), 2.6 times (release, opening), 8 times (held force), 1.9
 * times (frequency), 6.4 times (zip time), 5 times (largest load), whose errors depend on where among the nodes the
 * front is. */
TESTS(estimate_covers_the_error, 0, FULL_OR(LENGTH_OF(numbers), 0)) {
  const Number *number = &numbers[_i];
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 61});
  ZpResult *result = study_of(number->study, &def);
  double value = zp_result_get(result, number->value), error = zp_result_get(result, number->error);
  def.output.errors = false;
  def.mesh.nodes = 241;
  if (number->study == ZP_STUDY_ACTUATE) def.solver.tolerance = 7e-5;
  double truth = fabs(value - value_of(number->study, &def, number->value));
  printf("%s: error %.3g, estimated %.3g, %.2f times\n", number->value, truth, error, error / truth);
  ck_below(truth, error);
  ck_below(error, number->most * truth);
}

/* What the meshes give, of n elements: that of the study, then the coarser ones. */
typedef struct Meshes {
  double f[3], n[3];
} Meshes;

static Meshes meshes_of(const Number *number, ZpActuatorDef def) {
  static const double share[] = {1, 0.6, 0.4};
  double elements = def.mesh.nodes - 1;
  Meshes meshes;
  def.output.errors = false;
  for (int k = 0; k < 3; k++) {
    meshes.n[k] = floor(share[k] * elements + 0.5);
    def.mesh.nodes = (int)meshes.n[k] + 1;
    meshes.f[k] = value_of(number->study, &def, number->value);
  }
  return meshes;
}

/* (21.1): the error by mesh k. */
static double by_mesh(const Meshes *t, int k) {
  return (t->f[k] - t->f[0]) / (pow(t->n[0] / t->n[k], 2) - 1);
}

/* The error if f = c + A / n^2 + B / n^4 through all three. */
static double by_powers(const Meshes *t) {
  double x[3], c = 0;
  for (int k = 0; k < 3; k++)
    x[k] = pow(t->n[k], -2);
  for (int k = 0; k < 3; k++) { /* Lagrange's polynomial at elements of no length */
    int i = (k + 1) % 3, j = (k + 2) % 3;
    c += t->f[k] * x[i] * x[j] / ((x[i] - x[k]) * (x[j] - x[k]));
  }
  return t->f[0] - c;
}

/* (21.3) */
static double largest(const Meshes *t) {
  return fmax(fabs(by_mesh(t, 1)), fabs(by_mesh(t, 2)));
}

/* The estimate is what the numbers of the meshes make of it: (21.2) of frequencies, where both powers together give
 * most and where one mesh does; (21.3) of held forces. */
static const Number lowest = {ZP_STUDY_MODES, "frequency_1_Hz", "frequency_1_error_Hz", 2.5, 1.75, true};

TESTS(estimate_is_that_of_the_meshes, 0, 4) {
  static const struct {
    const Number *number;
    double thickness;
    int nodes;
    bool both; /* the powers together give most */
  } cases[] = {{&numbers[5], 30e-6, 21, false},
               {&lowest, 20e-6, 41, true},
               {&numbers[4], 100e-6, 41, false},
               {&numbers[4], 60e-6, 31, false}};
  const Number *number = cases[_i].number;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"liquid.model", ZP_LIQUID_NONE},
                          {"ribbon.thickness", cases[_i].thickness}, {"mesh.nodes", cases[_i].nodes});
  double error = value_of(number->study, &def, number->error);
  Meshes t = meshes_of(number, def);
  double expected = number->powers ? fmax(largest(&t), fabs(by_powers(&t))) : largest(&t);
  printf("%s: %.9g, %.9g, %.9g, estimated %.3g\n", number->value, t.f[0], t.f[1], t.f[2], error);
  ck_assert_int_eq(number->powers && fabs(by_powers(&t)) > largest(&t), cases[_i].both);
  ck_near(error, number->safety * expected, 1e-9); /* 1.8e-10 measured */
}

/* (21.4): from the number of the study to that on another mesh, from scratch. Two thirds of the elements of what only
 * hangs; four elements on the bend of a pull-in whose front is between other nodes there, where its ripple has several
 * crests (8.5e-3 measured); twice the elements of a pull-in and a release whose front is at about the same place
 * (2.7e-3 of the latter), of a gradual closing, and of the largest load. */
TESTS(estimate_is_that_of_another_mesh, 0, 7) {
  static const struct {
    const Number *number;
    double thickness;
    int nodes, others;
    double within;
  } cases[] = {{&numbers[3], 130e-6, 61, 41, 1e-4},  {&numbers[3], 30e-6, 16, 11, 1e-4},
               {&numbers[0], 50e-6, 21, 44, 0.02},   {&numbers[0], 200e-6, 31, 61, 1e-4},
               {&numbers[2], 100e-6, 61, 121, 8e-3}, {&numbers[1], 400e-6, 31, 61, 1e-4},
               {&numbers[7], 100e-6, 61, 121, 1e-4}};
  const Number *number = cases[_i].number;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"liquid.model", ZP_LIQUID_NONE},
                          {"ribbon.thickness", cases[_i].thickness}, {"mesh.nodes", cases[_i].nodes});
  ZpResult *result = study_of(number->study, &def);
  double value = zp_result_get(result, number->value), told = zp_result_get(result, number->error);
  def.output.errors = false;
  def.mesh.nodes = cases[_i].others;
  double change = value_of(number->study, &def, number->value) - value;
  double share = fabs(1 - pow((cases[_i].nodes - 1.0) / (cases[_i].others - 1), 2));
  printf("%s: %.12g, changes by %.6g, told %.6g, expected %.6g\n", number->value, value, change, told,
         number->safety * fabs(change) / share);
  ck_near(told, number->safety * fabs(change) / share, cases[_i].within);
}

/* The angle of a fold has an estimate that covers its error. */
TEST(angle_has_an_estimate) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"actuator.kind", ZP_KIND_HINGE}, {"mesh.nodes", 31});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  double angle = zp_result_get(result, "angle_rad"), told = zp_result_get(result, "angle_error_rad");
  def.output.errors = false;
  def.mesh.nodes = 241;
  double error = fabs(angle - value_of(ZP_STUDY_STATIONARY, &def, "angle_rad"));
  printf("angle %.9g, error %.3g, estimated %.3g\n", angle, error, told);
  ck_assert_msg(told >= error && told < 8 * error, "told %g, true %g", told, error); /* 7.1 measured */
}

/* Zip times come from half and two fifths of the elements, with 4 and 6.25 times the tolerance. The estimate's own runs
 * solve their steps less exactly, which moves their times by up to an eighth of their tolerance. Measured: the estimate
 * differs by 13 % without liquid, by 0.6 % in a bath and with beads. */
TESTS(zip_time_is_estimated_by_half_and_two_fifths, 0, 3) {
  static const double liquids[] = {ZP_LIQUID_NONE, ZP_LIQUID_SUBMERGED, ZP_LIQUID_BEAD};
  static const double share[] = {1, 0.5, 0.4};
  const double elements = 40;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"liquid.model", liquids[_i]}, {"mesh.nodes", elements + 1},
                          {"solver.stop_when_zipped", ZP_WHEN_TRUE});
  double told = value_of(ZP_STUDY_ACTUATE, &def, "zip_time_error_s"), tolerance = zp_def_tolerance(&def);
  Meshes t;
  def.output.errors = false;
  for (int k = 0; k < 3; k++) {
    t.n[k] = share[k] * elements;
    def.mesh.nodes = (int)t.n[k] + 1;
    def.solver.tolerance = tolerance / (share[k] * share[k]);
    t.f[k] = value_of(ZP_STUDY_ACTUATE, &def, "zip_time_s");
  }
  double expected = 3 * fmax(largest(&t), fabs(by_powers(&t)));
  printf("zip time %.6g, %.6g, %.6g s, error estimated as %.3g, expected %.3g\n", t.f[0], t.f[1], t.f[2], told,
         expected);
  ck_near(told, expected, 0.25);
}

/* The curve's limits have the same estimates as the limits themselves. */
TEST(equilibrium_has_the_estimates_of_limits) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 31});
  for (size_t k = 0; k < 3; k++)
    ck_near(value_of(ZP_STUDY_EQUILIBRIUM, &def, numbers[k].error), value_of(ZP_STUDY_LIMITS, &def, numbers[k].error),
            1e-12); /* 0 measured */
}

/* output.errors changes nothing but the estimates themselves. */
TESTS(estimates_leave_the_numbers_alone, 0, LENGTH_OF(numbers)) {
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
}

/* A ribbon that turns at the clip over a length (9.5) that is shorter than an element: 15 um of aluminium under 0.1 kg.
 * All coarser meshes miss the turn and agree with each other, so that the error is told by finer ones. */
TEST(unresolved_bending_is_estimated_by_finer_meshes) {
  const double w = 10e-3, b = 15e-6, m = 0.1, EI = 70e9 * w * b * b * b / 12;
  ZpActuatorDef def = DEF({"output.errors", 1}, {"ribbon.thickness", b}, {"ribbon.width", w}, {"load.mass", m},
                          {"ribbon.young_modulus", 70e9}, {"ribbon.plane", ZP_PLANE_STRESS}, {"ribbon.density", 0},
                          {"insulator.density", 0}, {"insulator.young_modulus", 0});
  double turns = sqrt(EI / (0.5 * m * def.gravity)), half = 0.5 * (def.ribbon.length - def.platform.length);
  for (int share = 1; share <= 4; share *= 2) {
    def.mesh.nodes = 1 + (int)(half / turns / share);
    ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
    ck_assert_ptr_nonnull(note_of(result, "a mesh that resolves the bend"));
    double told = zp_result_get(result, "opening_error_m"), opening = zp_result_get(result, "opening_m");
    ZpActuatorDef fine = def;
    fine.mesh.nodes = 961;
    fine.output.errors = false;
    double error = fabs(opening - value_of(ZP_STUDY_STATIONARY, &fine, "opening_m"));
    ck_assert_msg(told >= error && told < 6 * error, "1/%d of the nodes: told %g, true %g", share, told, error);
    printf("1/%d of the nodes: told %g, true %g, %.2f times\n", share, told, error, told / error);
  }
}

/* In motion, a mesh that does not resolve the bend has long steps, too. Those of the finer meshes are shorter, so that
 * the estimate tells the error of both. 126 mm of aluminium of 29 um that closes in 5 ms; measured: 1.2 times the
 * error. */
TEST(finer_meshes_tell_the_error_of_steps) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"liquid.model", ZP_LIQUID_NONE}, {"ribbon.length", 126.4e-3},
                          {"ribbon.width", 13.6e-3}, {"ribbon.thickness", 28.6e-6}, {"ribbon.young_modulus", 70e9},
                          {"ribbon.poisson_ratio", 0.33}, {"ribbon.density", 2700}, {"platform.length", 12.6e-3},
                          {"insulator.thickness", 201e-6}, {"load.mass", 0}, {"electro.breakdown_cap", 0},
                          {"drive.voltage", 7535}, {"mesh.nodes", 37}, {"solver.stop_when_zipped", ZP_WHEN_TRUE});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  double told = zp_result_get(result, "zip_time_error_s"), time = zp_result_get(result, "zip_time_s");
  def.output.errors = false;
  def.mesh.nodes = 181;
  def.solver.tolerance = 2e-5;
  double error = fabs(time - value_of(ZP_STUDY_ACTUATE, &def, "zip_time_s"));
  printf("zip time %.6g s, error %.3g, estimated %.3g\n", time, error, told);
  ck_assert_msg(told >= error && told < 2 * error, "told %g, true %g", told, error);
}

/* Meshes that would need thousands of elements are not tried: a note says so. */
TEST(hopeless_mesh_has_no_estimate) {
  ZpActuatorDef def = DEF({"output.errors", 1}, {"mesh.nodes", 11}, {"ribbon.thickness", 2e-6}, {"load.mass", 1});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert(isnan(zp_result_get(result, "opening_error_m")));
  ck_assert_ptr_nonnull(note_of(result, "errors are not estimated"));
}

/* Without a coarser mesh, or a number on it, an estimate is missing; the paper's chain has none. */
TEST(estimate_may_be_missing) {
  ZpActuatorDef coarse = DEF({"output.errors", 1}, {"mesh.nodes", 6}),
                chain = DEF({"output.errors", 1}, {"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21}),
                weak = DEF({"output.errors", 1}, {"drive.voltage", 1e3});
  ck_assert(isnan(value_of(ZP_STUDY_MODES, &coarse, "frequency_1_error_Hz")));
  ck_assert(isnan(value_of(ZP_STUDY_LIMITS, &weak, "pull_in_voltage_error_V")));
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &chain);
  ck_assert(!has(result, "stroke_error_m"));
}
