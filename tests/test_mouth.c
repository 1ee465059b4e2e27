/* A mouth: two ribbons in one clamp. Its tips are those of two cantilevers, and its pull-in is that of a fold whose
 * hinge does not turn. Section 30.1 of docs/theory.md. */
#include "check_util.h"

#include "state_util.h"

static const double pi = 3.14159265358979323846;

#define MOUTH                                                                                                          \
  {"actuator.kind", ZP_KIND_MOUTH}, {"ribbon.length", 45e-3}, {                                                        \
    "load.mass", 1e-3                                                                                                  \
  }

/* Eq. (30.9): under weights w per length and a force F on the lower tip the tips sink by w L^4 / 8 B, and by F L^3 / 3
 * B more. Half as thin a lower ribbon bends eight times as easily. */
TESTS(tips_are_those_of_cantilevers, 0, 2) {
  double L = 45e-3;
  ZpActuatorDef def = DEF(MOUTH, {"ribbon.thickness", 1e-3}, {"lower.ribbon.thickness", _i ? 0.5e-3 : NAN},
                          {"mesh.nodes", 61}, {"load.mass", 0.5e-3}, {"drive.voltage", 0});
  ZpModel *model = model_of(&def);
  double B[2], w[2], sunk[2];
  for (size_t k = 0; k < 2; k++) {
    ZpSection section = zp_ribbon_section(model, k);
    B[k] = section.EI, w[k] = section.mu * def.gravity;
    sunk[k] = w[k] * L * L * L * L / (8 * B[k]);
  }
  sunk[1] += def.load.mass * def.gravity * L * L * L / (3 * B[1]);
  ZpResult *result = answer_of(ZP_STUDY_STATIONARY, &def);
  double lower = zp_result_get(result, "stroke_m"), upper = lower - zp_result_get(result, "opening_m");
  printf("tips: lower %.2e, upper %.2e off\n", lower / sunk[1] - 1, upper / sunk[0] - 1);
  ck_near(lower, sunk[1], 4e-6); /* 1.2e-6 measured */
  ck_near(upper, sunk[0], 4e-6); /* 1.5e-6 measured */
}

static double pull_in(ZpActuatorKind kind, int nodes) {
  ZpActuatorDef def = DEF(MOUTH, {"actuator.kind", kind}, {"insulator.thickness", 1e-3}, {"insulator.density", 0},
                          {"insulator.young_modulus", 0}, {"drive.voltage", 20e3}, {"mesh.nodes", nodes});
  if (kind == ZP_KIND_HINGE) def.hinge.stiffness = zp_key(zp_key_find("hinge.stiffness"))->max;
  return answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V");
}

/* The stiffest hinge is a clamp. The joints there differ by an error of the second order in the length of an element,
 * eq. (31.2): what is left of the difference of both pull-ins without it. */
TEST(pull_in_is_that_of_a_fold_that_does_not_turn) {
  double missed[2];
  for (int k = 0; k < 2; k++) {
    double mouth = pull_in(ZP_KIND_MOUTH, 80 << k | 1), fold = pull_in(ZP_KIND_HINGE, 80 << k | 1);
    missed[k] = fold / mouth - 1;
  }
  double left = (4 * missed[1] - missed[0]) / 3;
  printf("pull-in of the fold over that of the mouth - 1: %.3e, %.3e; without the second order %.1e\n", missed[0],
         missed[1], left);
  ck_near(missed[0] / missed[1], 4, 0.05); /* 1.8e-2 measured */
  ck_below(fabs(left), 1e-6);              /* 5.6e-7 measured */
}

/* Dry faces that close: the energy balances, and the work on the load is its weight times its rise. */
TESTS(zips_and_keeps_the_books, 0, 2) {
  ZpActuatorDef def = DEF(MOUTH, {"mesh.nodes", 15}, {"drive.voltage", 2e3}, {"electro.edges", _i},
                          {"solver.end_time", 0.05}, {"solver.tolerance", 1e-4});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  printf("energy error %.1e\n", zp_result_get(result, "energy_error"));
  ck_below(zp_result_get(result, "energy_error"), 8e-9); /* 2.9e-9 measured */
  ck_assert(isfinite(zp_result_get(result, "zip_time_s")));
  double rise = zp_table_get(result->series, 0, "stroke_m") - zp_result_get(result, "stroke_m");
  ck_near(zp_result_get(result, "mechanical_work_J"), def.load.mass * def.gravity * rise, 1e-12);
}

/* Each ribbon swings as a cantilever, both alike: the lowest frequency is there twice. */
TEST(swings_as_two_cantilevers) {
  static const double first = 1.8751040687119611; /* cos x cosh x = -1 */
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_MOUTH}, {"ribbon.length", 45e-3}, {"ribbon.thickness", 0.5e-3},
                          {"load.mass", 0}, {"load.force", 1e-3}, {"gravity", 0}, {"mesh.nodes", 81});
  ZpModel *model = model_of(&def);
  ZpSection section = zp_ribbon_section(model, 0);
  double frequency = first * first * sqrt(section.EI / section.mu) / (45e-3 * 45e-3) / (2 * pi);
  ZpResult *result = answer_of(ZP_STUDY_MODES, &def);
  for (int k = 0; k < 2; k++) {
    printf("frequency %d: %.2e off\n", k, result->scalar[k].value / frequency - 1);
    ck_near(result->scalar[k].value, frequency, 1.8e-4); /* 6.1e-5 measured */
  }
}

static const struct {
  ZpStudy study;
  Setting more[2]; /* the second one is what the first asks for */
  const char *why;
} refusals[] = {
    {ZP_STUDY_PROFILE, {{"output.errors", 0}}, "from a clip to a platform"},
    {ZP_STUDY_ACTUATE, {{"stack.series", 2}}, "joins its platforms"},
    {ZP_STUDY_ACTUATE, {{"hinge.stiffness", 1}}, "have no hinge"},
    {ZP_STUDY_ACTUATE, {{"load.stiffness", 1}, {"load.rest_opening", 1e-3}}, "acts on its platforms"},
    {ZP_STUDY_ACTUATE, {{"actuator.symmetry", ZP_SYMMETRY_NONE}}, "have no halves"},
    {ZP_STUDY_ACTUATE, {{"solver.integrator", ZP_INTEGRATOR_EXPLICIT}}, "requires solver.integrator implicit"},
    {ZP_STUDY_ACTUATE, {{"liquid.model", ZP_LIQUID_BEAD}}, "with a platform"}};

TESTS(what_it_does_not_have_is_refused, 0, LENGTH_OF(refusals)) {
  ZpActuatorDef def = DEF(MOUTH, refusals[_i].more[0]);
  const Setting also = refusals[_i].more[1];
  if (also.key) ck_assert_int_eq(zp_def_set_number(&def, also.key, also.value, NULL), ZP_OK);
  ck_refused_by(refusals[_i].study, &def, refusals[_i].why);
}

/* The load of a mouth or a fold hangs on the lower ribbon, whose tip rises by twice the amplitude in a cycle; the tip
 * of the upper one moves, too, and is not loaded. */
TESTS(work_of_a_cycle_is_that_on_the_load, 0, 2) {
  ZpActuatorDef def =
      DEF(MOUTH, {"actuator.kind", _i ? ZP_KIND_HINGE : ZP_KIND_MOUTH}, {"mesh.nodes", 11}, {"drive.voltage", 500},
          {"hinge.stiffness", _i ? 2e-3 : 0}, {"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.frequency", 0.01},
          {"cycle.method", ZP_CYCLE_LINEAR});
  ZpResult *result = answer_of(ZP_STUDY_CYCLE, &def);
  double weight = def.load.mass * def.gravity, risen = 2 * zp_result_get(result, "stroke_amplitude_m");
  printf("work: %.3e off\n", zp_result_get(result, "work_per_cycle_J") / (weight * risen) - 1);
  ck_near(zp_result_get(result, "work_per_cycle_J"), weight * risen, 6e-16); /* 2.2e-16 measured */
}

/* Steep faces of a mouth have slid into each other 3 ms after it closed: the model ends there, and how long it stays
 * closed is not known. */
TEST(a_run_that_ends_beyond_the_model_tells_no_closed_from) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_MOUTH}, {"drive.voltage", 8e3}, {"mesh.nodes", 15});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_BEYOND_MODEL);
  ck_assert_double_gt(zp_result_get(result, "zip_time_s"), 0.1); /* 0.111 measured */
  ck_assert_double_nan(zp_result_get(result, "closed_from_s"));
}
