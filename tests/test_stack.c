/* Actuators in series and in parallel: at rest against one alone, in motion against what springs in series do, energy,
 * links, and what is refused. docs/theory.md, section 29. */
#include "check_util.h"

/* Members without weight are alike: their limits are those of one, their openings add up. */
START_TEST(weightless_series_pulls_in_as_one) {
  ZpActuatorDef one = DEF({"ribbon.density", 0}, {"mesh.nodes", 31}), five = one;
  five.stack.series = 5;
  static const char *const same[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "max_load_kg"};
  ZpResult *alone = answer_of(ZP_STUDY_LIMITS, &one), *all = answer_of(ZP_STUDY_LIMITS, &five);
  for (size_t k = 0; k < LENGTH_OF(same); k++)
    ck_near(zp_result_get(all, same[k]), zp_result_get(alone, same[k]), 1e-9);
  ck_near(zp_result_get(all, "travel_m"), 5 * zp_result_get(alone, "travel_m"), 1e-9);
  zp_result_destroy(alone);
  zp_result_destroy(all);
  ck_near(answered_value(ZP_STUDY_STATIONARY, &five, "opening_m"),
          5 * answered_value(ZP_STUDY_STATIONARY, &one, "opening_m"), 1e-9);
}
END_TEST

/* Each member carries those below, their links and the load: it hangs as one alone under so much. */
START_TEST(members_carry_those_below) {
  ZpActuatorDef series = DEF({"stack.series", 3}, {"stack.link_mass", 0.5e-3}, {"mesh.nodes", 31}), one = series;
  one.stack.series = 1;
  one.stack.link_mass = 0;
  double own = answered_value(ZP_STUDY_LIMITS, &one, "mass_kg"), openings = 0;
  const ZpActuatorDef *def = &one;
  /* the platforms' strips are in the mass, but without weight */
  own -= 2 * def->ribbon.density * def->ribbon.width * def->ribbon.thickness * def->platform.length;
  own -= 2 * def->insulator.density * def->ribbon.width * def->insulator.thickness * def->platform.length;
  ZpResult *all = answer_of(ZP_STUDY_STATIONARY, &series);
  for (size_t k = 0; k < 3; k++) {
    one.load.mass = series.load.mass + (double)(2 - k) * (own + series.stack.link_mass);
    double opening = answered_value(ZP_STUDY_STATIONARY, &one, "opening_m");
    ck_near(zp_table_get(all->series, k, "opening_m"), opening, 1e-9);
    openings += opening;
  }
  ck_near(zp_result_get(all, "opening_m"), openings, 1e-9);
  zp_result_destroy(all);
}
END_TEST

/* So many in parallel under so many loads are one under one, at rest, in their limits and in motion. */
START_TEST(parallel_shares_the_load) {
  ZpActuatorDef one = DEF({"mesh.nodes", 21}, {"solver.end_time", 0.1}), three = one;
  three.stack.parallel = 3;
  three.load.mass *= 3;
  static const struct {
    ZpStudy study;
    const char *name;
    double times;
  } expected[] = {{ZP_STUDY_STATIONARY, "opening_m", 1},
                  {ZP_STUDY_LIMITS, "pull_in_voltage_V", 1},
                  {ZP_STUDY_LIMITS, "max_load_kg", 3},
                  {ZP_STUDY_LIMITS, "mass_kg", 3},
                  {ZP_STUDY_ISOMETRIC, "force_N", 3},
                  {ZP_STUDY_MODES, "frequency_1_Hz", 1},
                  {ZP_STUDY_EQUILIBRIUM, "pull_in_voltage_V", 1},
                  {ZP_STUDY_ACTUATE, "zip_time_s", 1},
                  {ZP_STUDY_ACTUATE, "source_energy_J", 3}};
  for (size_t k = 0; k < LENGTH_OF(expected); k++)
    ck_near(answered_value(expected[k].study, &three, expected[k].name),
            expected[k].times * answered_value(expected[k].study, &one, expected[k].name), 1e-6);
}
END_TEST

/* Without voltage a series stays where its members are at rest one by one: eq. (29.1) is that of the whole. */
START_TEST(series_at_rest_stays) {
  ZpActuatorDef def = DEF({"stack.series", 3}, {"mesh.nodes", 21}, {"drive.voltage", 0}, {"solver.end_time", 0.2},
                          {"member_2.ribbon.thickness", 60e-6}, {"stack.link_mass", 1e-3},
                          {"liquid.model", _i ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_near(zp_result_get(result, "opening_m"), zp_result_get(result, "start_opening_m"), 1e-6);
  zp_result_destroy(result);
}
END_TEST

/* Stiff light ribbons below a heavy load are a spring: released from straight, two in series open twice as far in
 * sqrt(2) times the time, whatever part of the swing is looked at. */
START_TEST(two_in_series_are_half_as_stiff) {
  static const double part[] = {2e-3, 4e-3, 6e-3}; /* s */
  ZpActuatorDef one =
      DEF({"ribbon.thickness", 500e-6}, {"ribbon.density", 1}, {"insulator.density", 0}, {"load.mass", 0.1},
          {"drive.voltage", 0}, {"initial.state", ZP_INITIAL_STRAIGHT}, {"mesh.nodes", 21}, {"solver.tolerance", 7e-5});
  for (size_t k = 0; k < LENGTH_OF(part); k++) {
    ZpActuatorDef two = one;
    one.solver.end_time = part[k];
    two.solver.end_time = sqrt(2) * part[k];
    two.stack.series = 2;
    ck_near(answered_value(ZP_STUDY_ACTUATE, &two, "opening_m"),
            2 * answered_value(ZP_STUDY_ACTUATE, &one, "opening_m"), 1e-3);
  }
}
END_TEST

/* What the source gives is stored or lost over a zip of unlike members, in air, in a bath and with beads; rigid links
 * keep the platforms together. */
START_TEST(energy_and_links_of_a_zip) {
  static const int liquid[] = {ZP_LIQUID_NONE, ZP_LIQUID_SUBMERGED, ZP_LIQUID_BEAD};
  ZpActuatorDef def = DEF({"stack.series", 3}, {"stack.link_mass", 0.2e-3}, {"load.mass", 3e-3}, {"mesh.nodes", 21},
                          {"member_1.insulator.thickness", 120e-6}, {"member_3.ribbon.thickness", 60e-6},
                          {"liquid.model", liquid[_i]}, {"solver.end_time", 2});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  const ZpShapes *film = result->shapes;
  size_t count = film->ribbons * film->nodes / film->members;
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert_double_lt(zp_result_get(result, "energy_error"), 1e-6);
  ck_assert_uint_eq(film->members, 3);
  for (size_t frame = 0; frame < film->frames; frame++)
    for (size_t k = 1; k < film->members; k++) {
      ZpShape shape = zp_shapes_get(film, frame);
      ck_assert_double_eq_tol(shape.y[(k + 1) * count - 2], shape.y[k * count - 1], 1e-11);
    }
  for (size_t row = 0; row < result->series->rows; row++) {
    double sum = 0;
    for (size_t k = 1; k <= 3; k++) {
      char name[32];
      snprintf(name, sizeof name, "member_%zu_opening_m", k);
      sum += zp_table_get(result->series, row, name);
    }
    ck_assert_double_eq_tol(sum, zp_table_get(result->series, row, "opening_m"), 1e-12);
  }
  zp_result_destroy(result);
}
END_TEST

START_TEST(what_a_stack_lacks_is_said) {
  static const struct {
    Setting one, other;
    ZpStudy study;
    const char *says;
  } refused[] = {
      {{"stack.series", 2}, {"actuator.kind", ZP_KIND_FLANGE}, ZP_STUDY_STATIONARY, "actuator.kind electro_ribbon"},
      {{"stack.parallel", 2}, {"actuator.kind", ZP_KIND_RIBBON}, ZP_STUDY_STATIONARY, "actuator.kind electro_ribbon"},
      {{"stack.series", 2}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, ZP_STUDY_ACTUATE, "actuator.symmetry half"},
      {{"stack.series", 2}, {"source.model", ZP_SOURCE_AMPLIFIER}, ZP_STUDY_ACTUATE, "source.model ideal"},
      {{"stack.series", 2}, {"load.share", 0.4}, ZP_STUDY_ACTUATE, "load.share 0.5"},
      {{"stack.series", 2}, {"mesh.nodes", 21}, ZP_STUDY_MODES, "study modes"},
      {{"stack.series", 2}, {"mesh.nodes", 21}, ZP_STUDY_CYCLE, "study cycle"},
      {{"stack.series", 2}, {"member_3.ribbon.thickness", 60e-6}, ZP_STUDY_LIMITS, "stack.series of at least 3"},
      {{"stack.link_mass", 2}, {"mesh.nodes", 21}, ZP_STUDY_LIMITS, "stack.series of at least 2"},
      {{"member_1.ribbon.thickness", 60e-6}, {"mesh.nodes", 21}, ZP_STUDY_LIMITS, "stack.series of at least 2"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF(refused[k].one, refused[k].other);
    ck_refused_by(refused[k].study, &def, refused[k].says);
  }
}
END_TEST

START_TEST(what_a_series_does_not_take_is_said) {
  ZpActuatorDef def = DEF({"stack.series", 2}, {"mesh.nodes", 11});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_sim_set_input(sim, ZP_INPUT_LOAD, 1, 0, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, "series"), "%s", err.message);
  ck_assert_int_eq(zp_sim_restore(sim, NULL, 0, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, "series"), "%s", err.message);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("stack");
  TCase *rest = tcase_create("rest");
  tcase_add_test(rest, weightless_series_pulls_in_as_one);
  tcase_add_test(rest, members_carry_those_below);
  tcase_add_test(rest, parallel_shares_the_load);
  tcase_add_test(rest, what_a_stack_lacks_is_said);
  suite_add_tcase(suite, rest);
  TCase *motion = tcase_create("motion");
  tcase_add_loop_test(motion, series_at_rest_stays, 0, 2);
  tcase_add_test(motion, two_in_series_are_half_as_stiff);
  tcase_add_loop_test(motion, energy_and_links_of_a_zip, 0, 3);
  tcase_add_test(motion, what_a_series_does_not_take_is_said);
  suite_add_tcase(suite, motion);
  return run_suite(suite);
}
