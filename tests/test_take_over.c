/* A simulation that continues where one of another model was: the page changes its actuator so while it runs. */
#include "check_util.h"

typedef struct Run {
  ZpActuatorDef def;
  ZpModel *model;
  ZpSim *sim;
} Run;

static Run start(double length, double load) {
  Run run = {.def = zp_actuator_def_default()};
  run.def.solver.integrator = ZP_INTEGRATOR_IMPLICIT;
  run.def.contact.model = ZP_CONTACT_UNILATERAL;
  run.def.liquid.model = ZP_LIQUID_NONE;
  run.def.mesh.nodes = 21;
  run.def.ribbon.length = length;
  run.def.load.mass = load;
  ck_assert_int_eq(zp_model_create(&run.def, &run.model, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_create(run.model, NULL, &run.sim, NULL), ZP_OK);
  return run;
}

static void end(Run *run) {
  zp_sim_destroy(run->sim);
  zp_model_destroy(run->model);
}

static void expect_signals(const Run *run, const Run *from, double factor) {
  static const char *const lengths[] = {"stroke", "opening", "end_velocity"}, *const same[] = {"time", "voltage"};
  for (size_t k = 0; k < LENGTH_OF(lengths); k++)
    ck_assert_double_eq_tol(zp_sim_get(run->sim, lengths[k]), factor * zp_sim_get(from->sim, lengths[k]), 1e-12);
  for (size_t k = 0; k < LENGTH_OF(same); k++)
    ck_assert_double_eq(zp_sim_get(run->sim, same[k]), zp_sim_get(from->sim, same[k]));
}

/* What a run costs the source, and what of it is missing after a while. */
static void expect_balance(Run *run) {
  ck_assert_double_eq(zp_sim_get(run->sim, "electric_work"), 0);
  ck_assert_double_eq_tol(zp_sim_get(run->sim, "energy_imbalance"), 0, 1e-15);
  double until = zp_sim_get(run->sim, "time") + 5e-3;
  ck_assert_int_eq(zp_sim_run(run->sim, until, false, NULL, NULL), ZP_REACHED_END);
  double kinetic = zp_sim_get(run->sim, "kinetic_energy");
  ck_assert_double_gt(kinetic, 0);
  ck_assert_double_lt(fabs(zp_sim_get(run->sim, "energy_imbalance")), 1e-5 * kinetic);
}

START_TEST(test_goes_on_with_another_load) {
  Run first = start(0.1, 8e-3), next = start(0.1, 20e-3);
  double own = zp_sim_get(next.sim, "opening");
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  expect_signals(&next, &first, 1);
  /* contraction refers to the new load's own hanging shape */
  ck_assert_double_eq_tol(zp_sim_get(next.sim, "contraction"), 1 - zp_sim_get(next.sim, "opening") / own, 1e-12);
  expect_balance(&next);
  end(&first);
  end(&next);
}
END_TEST

START_TEST(test_stretches_to_another_length) {
  Run first = start(0.1, 8e-3), next = start(0.12, 8e-3);
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  double axial = zp_sim_get(first.sim, "axial_energy");
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  expect_signals(&next, &first, 0.110 / 0.090); /* without the platform */
  /* no strain is added: the same tension, along more length */
  ck_assert_double_eq_tol(zp_sim_get(next.sim, "axial_energy"), axial * 0.110 / 0.090, 1e-6 * axial);
  expect_balance(&next);
  end(&first);
  end(&next);
}
END_TEST

START_TEST(test_the_same_model_goes_on_as_if_nothing_was) {
  Run first = start(0.1, 8e-3), next = start(0.1, 8e-3);
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  zp_sim_run(first.sim, 0.06, false, NULL, NULL);
  zp_sim_run(next.sim, 0.06, false, NULL, NULL);
  expect_signals(&next, &first, 1);
  end(&first);
  end(&next);
}
END_TEST

START_TEST(test_another_mesh_is_refused) {
  Run first = start(0.1, 8e-3), next = {.def = first.def};
  next.def.mesh.nodes = 31;
  ZpError err;
  zp_model_create(&next.def, &next.model, NULL);
  zp_sim_create(next.model, NULL, &next.sim, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, &err), ZP_BAD_INPUT);
  ck_assert_ptr_nonnull(strstr(err.message, "mesh.nodes = 31"));
  end(&first);
  end(&next);
}
END_TEST

static Run start_with(const Setting *set, size_t count) {
  Run run = {.def = def_with(set, count)};
  run.model = model_of(&run.def);
  run.sim = sim_of(run.model);
  return run;
}

/* A slow supply that replaces the ideal one starts at the present voltage; and vice versa. */
START_TEST(test_another_supply) {
  static const Setting ideal[] = {{"mesh.nodes", 21}, {"drive.voltage", 5e3}, {"liquid.model", ZP_LIQUID_NONE}},
                       slow[] = {{"mesh.nodes", 21},
                                 {"drive.voltage", 5e3},
                                 {"liquid.model", ZP_LIQUID_NONE},
                                 {"source.supply", ZP_SUPPLY_POCKET_6KV}};
  Run first = start_with(ideal, LENGTH_OF(ideal)), next = start_with(slow, LENGTH_OF(slow)),
      last = start_with(ideal, LENGTH_OF(ideal));
  zp_sim_run(first.sim, 0.01, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(next.sim, 0.011, false, NULL, NULL), ZP_REACHED_END);
  ck_near(zp_sim_get(next.sim, "voltage"), 5e3, 1e-9);
  ck_assert_int_eq(zp_sim_take_over(last.sim, next.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(last.sim, 0.02, false, NULL, NULL), ZP_REACHED_END);
  ck_near(zp_sim_get(last.sim, "voltage"), 5e3, 1e-9);
  end(&first);
  end(&next);
  end(&last);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("take over");
  TCase *all = tcase_create("take over");
  tcase_add_test(all, test_goes_on_with_another_load);
  tcase_add_test(all, test_stretches_to_another_length);
  tcase_add_test(all, test_the_same_model_goes_on_as_if_nothing_was);
  tcase_add_test(all, test_another_mesh_is_refused);
  tcase_add_test(all, test_another_supply);
  suite_add_tcase(suite, all);
  return run_suite(suite);
}
