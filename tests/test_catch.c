/* A mass that is caught or dropped in motion: momentum, the loss of the impact, energy, where it comes to rest. Section
 * 27 of docs/theory.md. */
#include "state_util.h"

/* Several members on which the mass falls. */
#define UNLIKE_SIDE_BY_SIDE                                                                                            \
  {"stack.parallel", 2}, {                                                                                             \
    "member_2.insulator.thickness", 200e-6                                                                             \
  }
#define UNLIKE_SERIES                                                                                                  \
  {"stack.series", 2}, {                                                                                               \
    "member_2.ribbon.thickness", 60e-6                                                                                 \
  }
#define ANTAGONISTS                                                                                                    \
  {"stack.series", 2}, {                                                                                               \
    "stack.distance", 30e-3                                                                                            \
  }
static const Setting stacks[][2] = {{UNLIKE_SIDE_BY_SIDE}, {UNLIKE_SERIES}, {ANTAGONISTS}};

#define CAUGHT                                                                                                         \
  {"load.change_time", 20e-3}, {"load.change_mass", 4e-3}, {"load.drop_height", 10e-3}, {                              \
    "mesh.nodes", 21                                                                                                   \
  }

static const double fallen = 0.44294469180700207; /* m/s, from 10 mm */

static double value_at(ZpSim *sim, double end_time, const char *signal) {
  ZpRunInfo info;
  ck_assert_msg(zp_outcome_good(zp_sim_run(sim, end_time, false, NULL, &info)), "%s", info.message);
  return zp_sim_get(sim, signal);
}

/* A mass falls on a platform at rest: both continue with the common velocity of equal momentum, and the loss is known.
 * Of a half, of the whole, at the end of one ribbon, and of three side by side, which share the mass. */
TESTS(momentum_is_shared, 0, 4) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 0});
  if (_i == 1) def.actuator.symmetry = ZP_SYMMETRY_NONE;
  if (_i == 2) def.actuator.kind = ZP_KIND_RIBBON, def.load.share = 1;
  if (_i == 3) def.stack.parallel = 3;
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  size_t j = zp_load_node(&model->topology);
  double m = model->mass[j], comes = def.load.share * def.load.change_mass / def.stack.parallel,
         after = comes * fallen / (m + comes);
  double loss = 0.5 * m * comes / (m + comes) * fallen * fallen * model->parts * (double)zp_halves(&model->topology);
  ck_below(fabs(value_at(sim, 20e-3, "end_velocity")), 1e-12); /* 1.4e-14 measured */
  zp_sim_change_load(sim);
  ck_near(zp_sim_get(sim, "end_velocity"), -after, 1e-12); /* 6.6e-14 measured */
  ck_near(zp_sim_get(sim, "catch_loss"), loss, 1e-12);     /* 6.6e-14 measured */
  ck_assert(isinf(zp_sim_load_due(sim)));
}

/* Two platforms that move as one take the mass together: both side by side, both antagonists, the lowest of a series.
 */
TESTS(momentum_is_shared_by_members, 0, 3) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 0}, stacks[_i][0], stacks[_i][1]);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  double m = model[1].mass[zp_load_node(&model[1].topology)], comes = def.load.share * def.load.change_mass;
  if (_i != 1) m += model->mass[zp_load_node(&model->topology)];
  run_to(sim, 20e-3);
  ck_below(fabs(zp_sim_get(sim, "end_velocity")), 7e-15); /* 2.6e-15 measured */
  zp_sim_change_load(sim);
  ck_near(zp_sim_get(sim, "end_velocity"), -comes * fallen / (m + comes), 3.5e-14);           /* 1.2e-14 measured */
  ck_near(zp_sim_get(sim, "catch_loss"), m * comes / (m + comes) * fallen * fallen, 3.5e-14); /* 1.2e-14 measured */
}

/* Where faces meet after the catch, each platform is damped as what moves with it: the lower antagonist with the load
 * of the upper one and what that has caught; of two side by side each with half of all. */
TESTS(dampers_feel_what_others_have_caught, 0, 3) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 0}, stacks[_i][0], stacks[_i][1]);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  const ZpMovingMember *m = sim->dynamics.member;
  double one[2], all = 0;
  run_to(sim, 21e-3);
  for (int k = 0; k < 2; k++) {
    one[k] = model[k].mass[zp_load_node(&model[k].topology)] + m[k].added;
    all += one[k];
  }
  ck_assert_double_gt(m[0].added + m[1].added, 0.9e-3); /* a quarter of 4 g */
  if (_i == 0) ck_near(one[1] + m[1].with[1], 0.5 * all, 1e-14);
  if (_i == 1) ck_assert_double_eq(m[1].with[1], 0); /* the lowest of a series has no other below it */
  if (_i == 2) ck_near(one[1] + m[1].with[1], all, 1e-14);
}

/* Equal members side by side catch as one with a multiplicity does. */
TEST(equal_members_catch_as_one) {
  static const char *const name[] = {"opening_m", "catch_loss_J", "mechanical_work_J", "source_energy_J"};
  ZpActuatorDef all = DEF(CAUGHT, {"stack.parallel", 2}, {"load.mass", 16e-3}, {"mesh.nodes", 9},
                          {"drive.voltage", 6e3}, {"solver.end_time", 40e-3}, {"liquid.model", ZP_LIQUID_NONE});
  ZpActuatorDef equal = all;
  set_member(&all, "member_1.ribbon.thickness", nextafter(all.ribbon.thickness, 1));
  ZpResult *system = answer_of(ZP_STUDY_ACTUATE, &all), *one = answer_of(ZP_STUDY_ACTUATE, &equal);
  for (size_t k = 0; k < LENGTH_OF(name); k++)
    ck_near(zp_result_get(system, name[k]), zp_result_get(one, name[k]), 5.7e-12); /* 1.9e-12 measured */
}

/* Forces of unlike members carry the load and what it has caught, or what is left of it. Eq. (29.5). */
TESTS(forces_carry_what_is_caught, 0, 2) {
  ZpActuatorDef def = DEF(CAUGHT, UNLIKE_SIDE_BY_SIDE, {"drive.voltage", 6e3}, {"liquid.model", ZP_LIQUID_NONE},
                          {"mesh.nodes", 9}, {"solver.tolerance", 1e-6});
  if (_i == 1) def.load.change_mass = -2e-3, def.load.drop_height = 0;
  ZpTable *series = zp_signal_table(&def, 1000);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  zp_sim_record(sim, series, NULL);
  run_to(sim, 30e-3);
  double up = zp_nodes(model, zp_state_mean_a(model, sim->state)).y[zp_load_node(&model->topology)];
  ck_assert_double_gt(fabs(up), 3.2); /* 9.3 measured */
  ck_near(zp_table_get(series, series->rows - 1, "member_1_force_N") +
              zp_table_get(series, series->rows - 1, "member_2_force_N"),
          (def.load.mass + def.load.change_mass) * (def.gravity + up), 4.7e-8); /* 1.6e-8 measured */
  zp_table_destroy(series);
}

/* Energy balances over the impact on unlike members and after it, dry and with beads, and where the mass is dropped. */
TESTS(energy_of_members_that_catch, 0, 9) {
  ZpActuatorDef def =
      DEF(CAUGHT, {"drive.voltage", 6e3}, {"solver.end_time", 60e-3}, {"mesh.nodes", 9},
          {"liquid.model", _i / 3 == 1 ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE}, stacks[_i % 3][0], stacks[_i % 3][1]);
  if (_i / 3 == 2) def.load.change_mass = -2e-3, def.load.drop_height = 0;
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_below(zp_result_get(result, "energy_error"), 2.7e-7); /* 9.3e-8 measured */
  double loss = zp_result_get(result, "catch_loss_J");
  if (_i / 3 == 2)
    ck_below(fabs(loss), 1.3e-18); /* 4.3e-19 measured */
  else
    ck_assert_double_gt(loss, 1e-5); /* 1.03e-5 measured */
}

/* A run that resumes after the catch counts the work on the mass from where it resumes. */
TESTS(work_of_a_run_that_resumes, 0, 2) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 6e3}, {"solver.end_time", 40e-3}, {"mesh.nodes", 9},
                          {"liquid.model", ZP_LIQUID_NONE}, {"stack.series", 1 + _i});
  ZpResult *first = answer_of(ZP_STUDY_ACTUATE, &def);
  def.solver.end_time = 60e-3;
  def.initial.state = ZP_INITIAL_CHECKPOINT;
  ZpResult *rest = study_with(ZP_STUDY_ACTUATE, &def, &(ZpStudyInput){.start = first->checkpoint});
  double risen = zp_result_get(rest, "start_opening_m") - zp_result_get(rest, "opening_m");
  ck_near(zp_result_get(rest, "mechanical_work_J"), (def.load.mass + def.load.change_mass) * def.gravity * risen,
          6e-16); /* 2.2e-16 measured */
}

/* The energy balances over the impact and after it, at rest and in motion. */
TESTS(energy_with_a_caught_mass, 0, FULL_OR(6, 3)) {
  ZpActuatorDef def =
      DEF(CAUGHT, {"drive.voltage", 9e3}, {"solver.end_time", 0.15}, {"solver.stop_when_zipped", ZP_WHEN_FALSE});
  if (_i == 1) def.actuator.symmetry = ZP_SYMMETRY_NONE, def.mount.tilt = 0.5;
  if (_i == 2) def.liquid.model = ZP_LIQUID_BEAD;
  if (_i == 3) def.liquid.model = ZP_LIQUID_SUBMERGED;
  if (_i == 4) def.load.change_mass = -8e-3, def.load.drop_height = 0;
  if (_i == 5) def.load.change_time = 0.1; /* onto closed faces */
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_below(zp_result_get(result, "energy_error"), 1e-7); /* 2.9e-8 measured */
  double loss = zp_result_get(result, "catch_loss_J");
  if (_i == 4)
    ck_below(fabs(loss), 1e-12); /* what is dropped goes on as it was */
  else
    ck_assert_double_gt(loss, 1e-4);
}

/* With damping it comes to rest at the equilibrium of the changed load; the dropped mass is gone. A mass at the free
 * end of a tilted strip pulls along the strip, too. */
TESTS(rests_where_the_sum_hangs, 0, 3) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 0}, {"damping.internal", 30e-3}, {"solver.end_time", 20});
  if (_i == 1) def.load.change_mass = -5e-3, def.load.drop_height = 0;
  if (_i == 2)
    def.actuator.kind = ZP_KIND_RIBBON, def.actuator.right_end = ZP_END_FREE, def.mount.tilt = 0.5,
    def.load.change_mass = 1e-3, def.load.mass = 1e-3;
  const char *at = _i == 2 ? "stroke_m" : "opening_m";
  double found = answered_value(ZP_STUDY_ACTUATE, &def, at);
  def.load.mass += def.load.change_mass;
  def.load.change_mass = def.load.drop_height = 0, def.load.change_time = NAN;
  ck_near(found, answered_value(ZP_STUDY_STATIONARY, &def, at), 3e-5); /* 8.5e-6 measured */
}

/* The work on the load includes the caught mass from the place where it was caught. */
TEST(work_counts_the_mass) {
  ZpActuatorDef def = DEF(CAUGHT, {"drive.voltage", 9e3}, {"load.drop_height", 0}, {"solver.end_time", 0.3});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  size_t rows = result->series->rows, row = 0;
  while (row < rows && zp_table_get(result->series, row, "time_s") < def.load.change_time)
    row++;
  double start = zp_table_get(result->series, 0, "opening_m"), caught = zp_table_get(result->series, row, "opening_m"),
         end = zp_table_get(result->series, rows - 1, "opening_m");
  double work = def.gravity * (def.load.mass * (start - end) + def.load.change_mass * (caught - end));
  ck_near(zp_result_get(result, "mechanical_work_J"), work, 1e-12); /* 2.2e-16 measured */
}

TEST(what_it_lacks_is_said) {
  static const struct {
    ZpStudy study;
    Setting setting, other;
    const char *says;
  } refused[] = {
      {ZP_STUDY_ACTUATE, {"load.change_mass", 1e-3}, {"mesh.nodes", 21}, "load.change_time"},
      {ZP_STUDY_ACTUATE, {"load.change_time", 1e-3}, {"load.change_mass", -9e-3}, "cannot drop more than load.mass"},
      {ZP_STUDY_ACTUATE, {"load.drop_height", 1e-3}, {"mesh.nodes", 21}, "load.change_time"},
      {ZP_STUDY_CYCLE,
       {"load.change_time", 1e-3},
       {"load.change_mass", 1e-3},
       "study cycle requires 0 kg; the load is periodic, too"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF(refused[k].setting, refused[k].other);
    ck_refused_by(refused[k].study, &def, refused[k].says);
  }
  ZpActuatorDef def = DEF(UNLIKE_SIDE_BY_SIDE, {"load.change_time", 1e-3}, {"load.change_mass", -9e-3});
  ck_refused_by(ZP_STUDY_ACTUATE, &def, "load.change_mass = -0.009 kg: cannot drop more than load.mass = 0.008 kg");
}
