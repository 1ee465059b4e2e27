/* A simulation that continues where one of another model was: the page changes its actuator so while it runs. */
#include "check_util.h"
#include "ribbon/rod_plastic.h"
#include "run/run.h"

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
  run.model = model_of(&run.def);
  run.sim = sim_of(run.model);
  return run;
}

static void expect_signals(const Run *run, const Run *from, double factor) {
  static const char *const lengths[] = {"stroke", "opening", "end_velocity"}, *const same[] = {"time", "voltage"};
  for (size_t k = 0; k < LENGTH_OF(lengths); k++)
    ck_assert_double_eq_tol(zp_sim_get(run->sim, lengths[k]), factor * zp_sim_get(from->sim, lengths[k]), 1e-12);
  for (size_t k = 0; k < LENGTH_OF(same); k++)
    ck_assert_double_eq(zp_sim_get(run->sim, same[k]), zp_sim_get(from->sim, same[k]));
}

/* What a run costs the source, and what of it is missing after a while, over the kinetic energy. */
static void expect_balance(Run *run, double allowed) {
  ck_assert_double_eq(zp_sim_get(run->sim, "electric_work"), 0);
  ck_assert_double_eq_tol(zp_sim_get(run->sim, "energy_imbalance"), 0, 1e-15);
  double until = zp_sim_get(run->sim, "time") + 5e-3;
  ck_assert_int_eq(zp_sim_run(run->sim, until, false, NULL, NULL), ZP_REACHED_END);
  double kinetic = zp_sim_get(run->sim, "kinetic_energy");
  ck_assert_double_gt(kinetic, 0);
  ck_below(fabs(zp_sim_get(run->sim, "energy_imbalance")) / kinetic, allowed);
}

TEST(test_goes_on_with_another_load) {
  Run first = start(0.1, 8e-3), next = start(0.1, 20e-3);
  double own = zp_sim_get(next.sim, "opening");
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  expect_signals(&next, &first, 1);
  /* contraction refers to the new load's own hanging shape */
  ck_assert_double_eq_tol(zp_sim_get(next.sim, "contraction"), 1 - zp_sim_get(next.sim, "opening") / own, 1e-12);
  expect_balance(&next, 1e-8); /* 1.3e-9 measured */
}

TEST(test_stretches_to_another_length) {
  Run first = start(0.1, 8e-3), next = start(0.12, 8e-3);
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  double axial = zp_sim_get(first.sim, "axial_energy");
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  expect_signals(&next, &first, 0.110 / 0.090); /* without the platform */
  /* no strain is added: the same tension, along more length */
  ck_assert_double_eq_tol(zp_sim_get(next.sim, "axial_energy"), axial * 0.110 / 0.090, 1e-6 * axial);
  expect_balance(&next, 1e-8); /* 1.3e-9 measured */
}

TEST(test_the_same_model_goes_on_as_if_nothing_was) {
  Run first = start(0.1, 8e-3), next = start(0.1, 8e-3);
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  zp_sim_run(first.sim, 0.06, false, NULL, NULL);
  zp_sim_run(next.sim, 0.06, false, NULL, NULL);
  expect_signals(&next, &first, 1);
}

TEST(test_another_mesh_is_refused) {
  Run first = start(0.1, 8e-3), next = {.def = first.def};
  next.def.mesh.nodes = 31;
  next.model = model_of(&next.def);
  next.sim = sim_of(next.model);
  ck_says(zp_sim_take_over(next.sim, first.sim, &err), ZP_BAD_INPUT, "mesh.nodes = 31");
}

static Run begin(ZpActuatorDef def) {
  Run run = {.def = def};
  run.model = model_of(&run.def);
  run.sim = sim_of(run.model);
  return run;
}

/* The whole stack continues; it took over the uppermost member only, at its own height. */
TEST(test_a_stack_continues_with_all_its_members) {
  Run first = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2})), next = begin(first.def);
  zp_sim_set_voltage(first.sim, 6e3, NULL);
  zp_sim_run(first.sim, 0.02, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  zp_sim_run(first.sim, 0.03, false, NULL, NULL);
  zp_sim_run(next.sim, 0.03, false, NULL, NULL);
  expect_signals(&next, &first, 1);
  ZpShape shape = zp_sim_shape(next.sim), other = zp_sim_shape(first.sim);
  for (size_t j = 0; j < 2 * next.model->count; j++)
    ck_assert_double_eq_tol(shape.y[j], other.y[j], 1e-12);
}

/* Its members stay joined at another length. */
TEST(test_a_stack_of_another_length_stays_joined) {
  Run first = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2})),
      next = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"ribbon.length", 0.12}));
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  const size_t nodes = next.model->count; /* the last ones are those of the platforms */
  ZpShape shape = zp_sim_shape(next.sim);
  ck_near(shape.y[nodes - 1], shape.y[2 * nodes - 2], 1e-12);
  expect_balance(&next, 1e-8); /* 1.3e-9 measured */
}

/* Neither more of them, nor a single actuator, nor antagonists instead of a series. */
TESTS(test_other_members_are_refused, 0, 3) {
  const ZpActuatorDef others[] = {DEF({"mesh.nodes", 21}, {"stack.series", 3}), DEF({"mesh.nodes", 21}),
                                  DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"stack.distance", 0.03})};
  Run first = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2})), next = begin(others[_i]);
  double opening = zp_sim_get(next.sim, "opening");
  ck_says(zp_sim_take_over(next.sim, first.sim, &err), ZP_BAD_INPUT, "other members");
  ck_assert_double_eq(zp_sim_get(next.sim, "opening"), opening);
}

/* Antagonists fit between their mounts at one length only. */
TEST(test_antagonists_keep_their_lengths) {
  Run first = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"stack.distance", 0.03})),
      farther = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"stack.distance", 0.032})),
      heavier = begin(DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"stack.distance", 0.03}, {"load.mass", 0.01}));
  ZpError err;
  ck_says(zp_sim_take_over(farther.sim, first.sim, &err), ZP_BAD_INPUT, "stack.distance");
  ck_assert_int_eq(zp_sim_take_over(heavier.sim, first.sim, &err), ZP_OK);
  expect_signals(&heavier, &first, 1);
}

/* A ribbon actuator does not become a fold, whose nodes it has. */
TEST(test_other_ends_are_refused) {
  Run first = begin(DEF({"mesh.nodes", 21})), next = begin(DEF({"mesh.nodes", 21}, {"actuator.kind", ZP_KIND_HINGE}));
  ck_says(zp_sim_take_over(next.sim, first.sim, &err), ZP_BAD_INPUT, "the ends or the platforms differ");
}

/* A slow supply that replaces the ideal one starts at the present voltage; and vice versa. */
TEST(test_another_supply) {
  const ZpActuatorDef ideal = DEF({"mesh.nodes", 21}, {"drive.voltage", 5e3}),
                      slow = DEF({"mesh.nodes", 21}, {"drive.voltage", 5e3}, {"source.supply", ZP_SUPPLY_POCKET_6KV});
  Run first = begin(ideal), next = begin(slow), last = begin(ideal);
  zp_sim_run(first.sim, 0.01, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(next.sim, 0.011, false, NULL, NULL), ZP_REACHED_END);
  ck_near(zp_sim_get(next.sim, "voltage"), 5e3, 1e-12); /* 0 measured */
  ck_assert_int_eq(zp_sim_take_over(last.sim, next.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(last.sim, 0.02, false, NULL, NULL), ZP_REACHED_END);
  ck_near(zp_sim_get(last.sim, "voltage"), 5e3, 1e-12); /* 0 measured */
}

/* One that replaces the ideal one at 0 V has been off, and waits; one at another voltage runs. */
TESTS(test_supply_with_a_dead_time, 0, 2) {
  const ZpActuatorDef ideal = DEF({"mesh.nodes", 9}, {"drive.voltage", _i ? 500 : 0}),
                      waits = DEF({"mesh.nodes", 9}, {"source.model", ZP_SOURCE_AMPLIFIER}, {"source.dead_time", 5e-3});
  ZpSim *first = sim_of(model_of(&ideal)), *next = sim_of(model_of(&waits));
  run_to(first, 1e-3);
  ck_ok(zp_sim_take_over(next, first, &err));
  ck_ok(zp_sim_set_voltage(next, 1e3, &err));
  run_to(next, 5.9e-3);
  ck_assert_double_eq(zp_sim_get(next, "voltage"), _i ? 1e3 : 0);
  run_to(next, 6.1e-3);
  ck_assert_double_eq(zp_sim_get(next, "voltage"), 1e3);
}

/* A supply that is slewing continues from its present voltage after the load has changed. */
TEST(test_slewing_supply_goes_on) {
  ZpActuatorDef def =
      DEF({"mesh.nodes", 9}, {"drive.voltage", 5e3}, {"source.model", ZP_SOURCE_AMPLIFIER}, {"source.slew_rate", 1e5});
  Run first = begin(def);
  def.load.mass *= 2;
  Run next = begin(def);
  ck_assert_int_eq(zp_sim_run(first.sim, 0.02, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_near(zp_sim_get(next.sim, "command"), 5e3, 1e-15);
  for (int k = 2; k <= 7; k++) {
    ck_assert_int_eq(zp_sim_run(next.sim, 0.01 * k, false, NULL, NULL), ZP_REACHED_END);
    ck_near(zp_sim_get(next.sim, "source_voltage"), fmin(1e3 * k, 5e3), 1e-12);
    ck_near(zp_sim_get(next.sim, "voltage"), fmin(1e3 * k, 5e3), 1e-12);
  }
}

/* An ideal source that replaces it jumps to the command: U dQ, of which C dU^2 / 2 is lost. One that slews and replaces
 * an ideal source begins where that was. */
TEST(test_slewing_supply_comes_and_goes) {
  ZpActuatorDef ideal = DEF({"mesh.nodes", 9}, {"drive.voltage", 5e3}, {"electro.breakdown_cap", 0}), slow = ideal;
  slow.source.model = ZP_SOURCE_AMPLIFIER;
  slow.source.slew_rate = 1e5;
  Run first = begin(slow), next = begin(ideal), last = begin(slow);
  ck_assert_int_eq(zp_sim_run(first.sim, 0.02, false, NULL, NULL), ZP_REACHED_END);
  const double C = zp_sim_get(first.sim, "charge") / 2e3;
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_near(zp_sim_get(next.sim, "voltage"), 5e3, 1e-15);
  ck_near(zp_sim_get(next.sim, "electric_work"), 5e3 * C * 3e3, 1e-12);
  ck_near(zp_sim_get(next.sim, "charging_loss"), 0.5 * C * 3e3 * 3e3, 1e-12);
  ck_assert_int_eq(zp_sim_run(next.sim, 0.03, false, NULL, NULL), ZP_REACHED_END);
  ck_below(fabs(zp_sim_get(next.sim, "energy_imbalance")), 1e-8 * zp_sim_get(next.sim, "electric_work"));
  ck_assert_int_eq(zp_sim_take_over(last.sim, next.sim, NULL), ZP_OK);
  ck_near(zp_sim_get(last.sim, "source_voltage"), 5e3, 1e-15);
  ck_assert_int_eq(zp_sim_run(last.sim, 0.031, false, NULL, NULL), ZP_REACHED_END);
  ck_near(zp_sim_get(last.sim, "voltage"), 5e3, 1e-12);
}

/* Energies and losses count from the take-over on, those of the load and of the supply too. */
TEST(test_books_begin_anew) {
  static const char *const books[] = {"load_work",    "internal_loss", "source_energy", "source_loss",
                                      "bleeder_loss", "drag_loss",     "leak_loss",     "electric_work",
                                      "contact_loss", "plastic_loss",  "catch_loss",    "charging_loss"};
  enum { ALWAYS = 8 }; /* these are not 0 before */
  ZpActuatorDef def =
      DEF({"mesh.nodes", 9}, {"drive.voltage", 8e3}, {"source.model", ZP_SOURCE_AMPLIFIER}, {"source.resistance", 1e7},
          {"source.bleeder", 1e10}, {"insulator.resistivity", 1e12}, {"damping.drag", 0.1}, {"damping.internal", 1e-4});
  Run first = begin(def);
  def.load.mass *= 1.1;
  Run next = begin(def);
  ck_assert_int_eq(zp_sim_set_input(first.sim, ZP_INPUT_LOAD, 0.02, 0, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(first.sim, 0.03, false, NULL, NULL), ZP_REACHED_END);
  for (size_t k = 0; k < ALWAYS; k++)
    ck_assert_msg(zp_sim_get(first.sim, books[k]) != 0, "%s", books[k]);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  for (size_t k = 0; k < LENGTH_OF(books); k++)
    ck_assert_double_eq(zp_sim_get(next.sim, books[k]), 0);
  expect_balance(&next, 5e-6); /* 1.6e-6 measured */
}

/* A force that is held over several steps is at once that of the new model, whenever the old one was refreshed: twice
 * as wide, under twice the load, it goes on as one that is like the old one. */
TEST(test_held_force_is_that_of_the_new_model) {
  ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_TEXT}, {"mesh.nodes", 21}, {"electro.surface", ZP_SURFACE_BEZIER},
                          {"electro.refresh_period", 1e-3});
  Run first = begin(def), alike = begin(def);
  def.ribbon.width *= 2;
  def.load.mass *= 2;
  def.damping.drag *= 2;
  Run next = begin(def);
  const double between = 0.5 * def.electro.refresh_period;
  zp_sim_run(first.sim, between, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_take_over(alike.sim, first.sim, NULL), ZP_OK);
  zp_sim_run(alike.sim, between + 1e-5, false, NULL, NULL);
  zp_sim_run(next.sim, between + 1e-5, false, NULL, NULL);
  ck_near(zp_sim_get(next.sim, "end_velocity"), zp_sim_get(alike.sim, "end_velocity"), 1e-12);
}

/* A controller with another period takes its next sample at the first multiple of that at or after the present time. */
TEST(test_samples_at_the_new_period) {
  ZpActuatorDef def = DEF({"mesh.nodes", 9}, {"control.kind", ZP_CONTROL_PI}, {"control.proportional", 1e5},
                          {"control.period", 1e-3}, {"setpoint.value", 0.01});
  Run first = begin(def);
  def.control.period = 0.3e-3;
  Run next = begin(def);
  zp_sim_run(first.sim, 0.01, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_near(zp_sim_control_due(next.sim), 34 * 0.3e-3, 1e-12); /* 33 periods are 9.9 ms */
  const double voltage = zp_sim_get(next.sim, "voltage");
  zp_sim_run(next.sim, 10.1e-3, false, NULL, NULL);
  ck_assert_double_eq(zp_sim_get(next.sim, "voltage"), voltage);
  zp_sim_run(next.sim, 10.3e-3, false, NULL, NULL);
  ck_assert_double_ne(zp_sim_get(next.sim, "voltage"), voltage);
}

/* A larger bead reaches farther at once: without surface tension it leaves the shape of rest, and is as that of an
 * actuator that began with it. */
TEST(test_another_bead_reaches_farther) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", 50e-9},
                          {"medium.surface_tension", 0}, {"drive.voltage", 0});
  Run first = begin(def);
  def.bead.volume = 100e-9;
  Run next = begin(def), large = begin(def);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_near(zp_sim_get(next.sim, "wet_length"), zp_sim_get(large.sim, "wet_length"), 1e-12); /* 0 measured */
  ck_assert_double_gt(zp_sim_get(next.sim, "wet_length"), 1.1 * zp_sim_get(first.sim, "wet_length"));
}

/* Liquid that has left for good does not come back: what lies between the faces lacks it, in the model that goes on as
 * in the one before, with a bead of the same size or a larger one. */
TESTS(test_lost_liquid_stays_lost, 0, 2) {
  const double volume = 50e-9, more = _i ? 20e-9 : 0;
  ZpActuatorDef def = DEF({"mesh.nodes", 11}, {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", volume},
                          {"bead.return", 0}, {"drive.voltage", 8e3});
  Run first = begin(def);
  def.bead.volume += more;
  Run next = begin(def);
  ck_assert_int_eq(zp_sim_run(first.sim, 0.1, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  double lost = zp_sim_get(next.sim, "bead_lost");
  ck_assert_double_eq(lost, zp_sim_get(first.sim, "bead_lost"));
  ck_assert_double_gt(lost, 0.05 * volume);
  ZpShape shape = zp_sim_shape(next.sim);
  double between = zp_bead_volume(&next.model->film, shape.gap, 0, zp_sim_get(next.sim, "wet_length"));
  ck_near(between + lost, volume + more, 1e-13);
  if (more == 0) ck_near(zp_sim_get(next.sim, "wet_length"), zp_sim_get(first.sim, "wet_length"), 1e-12);
}

/* Kinds of the laws' own numbers that an actuator has. */
typedef struct Own {
  ZpLiquidModel liquid;
  bool leaks, yields;
} Own;

static ZpActuatorDef with_own(Own own) {
  return DEF({"mesh.nodes", 21}, {"bead.volume", 50e-9}, {"liquid.model", own.liquid},
             {"insulator.resistivity", own.leaks ? 1e12 : NAN}, {"ribbon.plasticity", own.yields});
}

/* Each kind goes on where both models have it, wherever it stands in their states, and begins at 0 where it comes: a
 * strip that has yielded stays bent when a liquid comes or insulators conduct. */
TESTS(test_laws_keep_their_own_numbers, 0, 6) {
  static const Own pairs[][2] = {{{ZP_LIQUID_NONE, false, true}, {ZP_LIQUID_BEAD, false, true}},
                                 {{ZP_LIQUID_BEAD, false, true}, {ZP_LIQUID_NONE, false, true}},
                                 {{ZP_LIQUID_NONE, false, true}, {ZP_LIQUID_NONE, true, true}},
                                 {{ZP_LIQUID_NONE, true, true}, {ZP_LIQUID_NONE, false, true}},
                                 {{ZP_LIQUID_NONE, true, true}, {ZP_LIQUID_SUBMERGED, true, true}},
                                 {{ZP_LIQUID_SUBMERGED, true, true}, {ZP_LIQUID_NONE, true, false}}};
  const Own *old = &pairs[_i][0], *new = &pairs[_i][1];
  Run first = begin(with_own(*old)), next = begin(with_own(*new));
  ZpState *from = first.sim->state, *to = next.sim->state;
  const size_t faces = ZP_PLATES_PLACES * next.model->nodes;
  const ZpLaw *film = zp_law(next.model, &zp_term_film);
  const size_t strains = zp_rod_plastic_count(&first.model->rod);
  for (size_t i = 0; i < strains; i++)
    zp_law_state(first.model, &zp_term_rod, from)[i] = 1e-5 * (double)(1 + i % 7);
  for (size_t i = 0; old->leaks && i < faces; i++)
    zp_law_state(first.model, &zp_term_leak, from)[i] = 1 + (double)(i % 5);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  for (size_t i = 0; new->yields &&i < strains; i++)
    ck_assert_double_eq(zp_law_state(next.model, &zp_term_rod, to)[i], 1e-5 * (double)(1 + i % 7));
  const double *Z = zp_law_state(next.model, &zp_term_leak, to), *flows = zp_law_state(next.model, &zp_term_film, to);
  for (size_t i = 0; new->leaks &&i < faces; i++)
    ck_assert_double_eq(Z[i], old->leaks ? 1 + (double)(i % 5) : 0);
  for (size_t i = 0; i < zp_extra_unknowns(next.model); i++)
    ck_assert_double_eq(zp_state_own(next.model, to)[i], 0);
  for (size_t i = 0; film && i < film->state; i++)
    ck_assert_double_eq(flows[i], 0);
}

/* After a take-over a run can be saved and restored, with a controller and without one. */
TESTS(test_taken_over_is_saved_and_restored, 0, 4) {
  const ZpActuatorDef alone = DEF({"mesh.nodes", 21}),
                      controlled =
                          DEF({"mesh.nodes", 21}, {"control.kind", ZP_CONTROL_PI}, {"control.proportional", 1e5},
                              {"control.period", 1e-3}, {"setpoint.value", 0.01});
  Run first = begin(_i & 1 ? controlled : alone), next = begin(_i & 2 ? controlled : alone), again = begin(next.def);
  const size_t size = zp_sim_state_size(next.sim);
  void *snapshot = memory_of(size);
  zp_sim_run(first.sim, 0.01, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_take_over(next.sim, first.sim, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(next.sim, 0.012, false, NULL, NULL), ZP_REACHED_END);
  zp_sim_save(next.sim, snapshot);
  ck_ok(zp_sim_restore(again.sim, snapshot, size, &err));
  expect_signals(&again, &next, 1);
}
