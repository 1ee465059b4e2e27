/* The default actuator in a bath of liquid: limits in closed form, what the energy does, meshes, steps and keys; docs/
 * theory.md, section 22. */
#include "check_util.h"

#include "rest/rest.h"
#include "run/run.h"
#include "system/system.h"
#include "term/term.h"

typedef struct Run {
  ZpOutcome outcome;
  double zip_time, energy_error, steps, film, zipped, viscous, jets, outer;
} Run;

static Run run_of(const ZpActuatorDef *def) {
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, def);
  Run run = {result->outcome,
             zp_result_get(result, "zip_time_s"),
             zp_result_get(result, "energy_error"),
             zp_result_get(result, "steps"),
             zp_result_get(result, "film_thickness_m"),
             zp_result_get(result, "zipped_length_m"),
             zp_result_get(result, "viscous_loss_J"),
             zp_result_get(result, "jet_loss_J"),
             zp_result_get(result, "outer_drag_loss_J")};
  return run;
}

static Run run_with(const Setting *list, size_t count) {
  ZpActuatorDef def = def_with(list, count);
  def.output.errors = false;
  def.liquid.model = ZP_LIQUID_SUBMERGED;
  def.solver.stop_when_zipped = ZP_WHEN_TRUE;
  return run_of(&def);
}
#define RUN(...) run_with((const Setting[]){__VA_ARGS__}, sizeof((const Setting[]){__VA_ARGS__}) / sizeof(Setting))

/* Viscosity alone, no mass of the liquid: no second code knows more of it than 131.4 ms on an endless mesh. */
#define FILM_ONLY                                                                                                      \
  {"liquid.inertia", 0}, {                                                                                             \
    "medium.drag_coefficient", 0                                                                                       \
  }

TEST(test_film_alone) {
  Run film = RUN(FILM_ONLY);
  printf("film only: %.2f ms\n", 1e3 * film.zip_time);
  ck_near(film.zip_time, 131.4e-3, 5e-3);
  ck_below(film.energy_error, 3e-9); /* 4.5e-10 measured */
  ck_assert_double_eq(film.jets, 0);
  ck_assert_double_eq(film.outer, 0);
}

/* In a bath of 50 mm2/s closing takes more than twice as long as without liquid; every loss is above 0. */
TEST(test_submerged) {
  Run run = RUN({"mesh.nodes", 121}, {"solver.tolerance", 3e-4});
  printf("submerged: %.2f ms, film %.1f um\n", 1e3 * run.zip_time, 1e6 * run.film);
  ck_assert_int_eq(run.outcome, ZP_ZIPPED);
  ck_near(run.zip_time, 191e-3, 0.03); /* of an independent code */
  ck_near(run.film, 60e-6, 0.02);      /* 4.3e-3 measured */
  ck_below(run.energy_error, 5e-8);    /* 7.2e-9 measured */
  ck_assert_double_gt(run.viscous, 1e-3);
  ck_assert_double_gt(run.jets, 1e-4);
  ck_assert_double_gt(run.outer, 1e-4);
}

/* A liquid without viscosity, mass and drag has no effect. */
TEST(test_nothing_of_the_liquid_is_dry) {
  ZpActuatorDef dry = DEF({"output.errors", 0}, {"drive.voltage", 7e3});
  Run none = run_of(&dry), thin = RUN(FILM_ONLY, {"drive.voltage", 7e3}, {"medium.kinematic_viscosity", 1e-8});
  printf("dry: %.3f ms, as good as dry: %.3f ms\n", 1e3 * none.zip_time, 1e3 * thin.zip_time);
  ck_near(thin.zip_time, none.zip_time, 2e-3); /* 4.6e-4 measured */
}

/* If viscosity dominates, doubling it doubles the time: other effects are 1.5 %, and half of that for each doubling. */
TESTS(test_time_is_linear_in_viscosity, 0, FULL_OR(1, 0)) {
  double time[3], nu = 500e-6;
  for (int k = 0; k < 3; k++, nu *= 2)
    time[k] = RUN({"mesh.nodes", 31}, {"medium.kinematic_viscosity", nu}, {"solver.end_time", 10}, FILM_ONLY).zip_time;
  printf("per doubling of the viscosity: %.4f, %.4f\n", time[1] / time[0], time[2] / time[1]);
  ck_near(time[1] / time[0], 2, 0.02);  /* 9.8e-3 measured */
  ck_near(time[2] / time[1], 2, 0.006); /* 1e-3 measured */
}

/* The closing time does not depend on the roughness. */
TEST(test_time_does_not_depend_on_roughness) {
  double fine = RUN({"film.roughness", 0.5e-6}).zip_time, rough = RUN({"film.roughness", 10e-6}).zip_time;
  ck_near(rough, fine, 0.015); /* 5.7e-3 measured */
}

/* It depends on the mesh by at most a hundredth. */
TEST(test_time_does_not_depend_on_the_mesh) {
  double coarse = RUN({"mesh.nodes", 61}, {"solver.tolerance", 3e-4}).zip_time,
         fine = RUN({"mesh.nodes", 241}, {"solver.tolerance", 3e-4}).zip_time;
  printf("N = 61: %.2f ms, 241: %.2f ms\n", 1e3 * coarse, 1e3 * fine);
  ck_near(coarse, fine, 3e-4); /* 9.2e-5 measured */
}

/* Halving fixed steps: second order. */
TEST(test_second_order_in_time) {
  double time[3], step = 4e-4;
  for (int k = 0; k < 3; k++, step *= 0.5)
    time[k] = RUN({"mesh.nodes", 31}, {"solver.time_step", step}).zip_time;
  double order = (time[0] - time[1]) / (time[1] - time[2]);
  printf("steps of 400, 200, 100 us: %.4f %.4f %.4f ms\n", 1e3 * time[0], 1e3 * time[1], 1e3 * time[2]);
  ck_near(order, 4, 0.01); /* 3.2e-3 measured */
}

/* -- close to the static pull-in -------------------------------------------------------------------- */

/* At rest there all but exactly: what is left is a distance of 1e-5 of the way on which the fold is passed. */
static void raise_to(ZpRest *rest, double U) {
  ck_assert(zp_newton_good(zp_statics_find_rest(&rest->statics).end));
  ck_assert(zp_statics_ramp_voltage(&rest->statics, U * (1 - 1e-10)));
}

static double time_from(ZpActuatorDef def, const double *q, double U) {
  def.drive.voltage = U;
  def.solver.tolerance = 3e-4;
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  memcpy(zp_state_q(model, sim->state), q, 2 * model->stride * sizeof *q);
  ck_assert_int_eq(zp_sim_run(sim, 1e3, true, NULL, NULL), ZP_ZIPPED);
  return zp_sim_zip_time(sim);
}

/* Released at the fold, an actuator closes after a time proportional to the excess voltage to the power -1/4 if inertia
 * dominates, or -1/2 if viscosity dominates: this is the time near the fold; the time from there on is constant and
 * cancels in differences. */
TESTS(test_time_close_to_pull_in, 0, 2) {
  static const struct { double model, power; } row[] = {{ZP_LIQUID_NONE, -0.25}, {ZP_LIQUID_SUBMERGED, -0.5}};
  ZpActuatorDef def = DEF({"mesh.nodes", 15}, {"liquid.model", row[_i].model}, {"medium.kinematic_viscosity", 1e-3},
                          FILM_ONLY, {"film.roughness", 1e-3}, {"solver.tolerance", 3.5e-6});
  double U = zp_result_get(study_of(ZP_STUDY_LIMITS, &def), "pull_in_voltage_V"), time[3], excess = 1e-4;
  ZpModel *model = model_of(&def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  raise_to(&rest, U);
  for (int k = 0; k < 3; k++, excess *= 0.1)
    time[k] = time_from(def, rest.statics.member->q, U * (1 + excess));
  double power = -log10((time[2] - time[1]) / (time[1] - time[0]));
  printf("%g, %g, %g s: power %.4f\n", time[0], time[1], time[2], power);
  ck_below(fabs(power - row[_i].power), 0.01); /* 1.4e-3 measured */
  zp_rest_close(&rest);
}

/* -- zip, hold, release ---------------------------------------------------------------------------- */

static ZpSim *zip_hold_release(ZpModel **model, double viscosity, const char *symmetry) {
  ZpActuatorDef def = DEF({"medium.kinematic_viscosity", viscosity}, {"mesh.nodes", 31});
  def.liquid.model = ZP_LIQUID_SUBMERGED;
  def.actuator.symmetry = strcmp(symmetry, "none") == 0 ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF;
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  snprintf(def.drive.table, sizeof def.drive.table, "0 s = 10 kV, 0.3 s = 10 kV, 0.3 s = 0 kV");
  static const double time[] = {0, 0.3, 0.3}, voltage[] = {10e3, 10e3, 0};
  *model = driven_model_of(&def, 3, time, voltage);
  return sim_of(*model);
}

/* The energy balances over closing, holding and opening, in thin and thick liquids, and no film is lost. A film that
 * has been pressed out holds the platform for seconds before it opens. */
TESTS(test_energy_of_zip_hold_and_release, 0, FULL_OR(3, 1)) {
  static const double viscosity[] = {1e-6, 50e-6, 1000e-6};
  ZpModel *model;
  ZpSim *sim = zip_hold_release(&model, viscosity[_i], "half");
  double worst = 0;
  for (int k = 1; k <= 40; k++) {
    ck_assert_int_eq(zp_sim_run(sim, 0.2 * k, false, NULL, NULL), ZP_REACHED_END);
    worst = fmax(worst, fabs(zp_sim_get(sim, "energy_imbalance")) / zp_sim_get(sim, "electric_work"));
    ck_assert_double_gt(zp_sim_get(sim, "film_thickness"), 0);
  }
  printf("%g mm2/s: energy off by %.1e of the work at most, opening %.2f mm\n", 1e6 * viscosity[_i], worst,
         1e3 * zp_sim_get(sim, "opening"));
  ck_below(worst, 2e-7); /* 4e-8 measured */
  ck_assert_double_gt(zp_sim_get(sim, "opening"), 15e-3);
}

/* The whole actuator is two halves in the liquid, too. */
TEST(test_whole_is_two_halves) {
  ZpModel *models[2];
  ZpSim *sims[2] = {zip_hold_release(&models[0], 50e-6, "half"), zip_hold_release(&models[1], 50e-6, "none")};
  static const char *const signals[] = {"opening", "film_across_loss", "jet_loss", "liquid_energy", "outer_drag_loss"};
  for (int k = 0; k < 2; k++)
    ck_assert_int_eq(zp_sim_run(sims[k], 0.5, false, NULL, NULL), ZP_REACHED_END);
  ck_same_signals(sims, models, signals, LENGTH_OF(signals), 1e-8); /* 1.2e-9 measured */
}

/* What rows say of the film: its thickness at a quarter of the flexible length, between two stations, and what
 * viscosity takes along and across together. */
TEST(test_rows_of_the_film) {
  ZpActuatorDef def = DEF({"mesh.nodes", 12}, {"liquid.model", ZP_LIQUID_SUBMERGED});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ck_assert_int_eq(zp_sim_run(sim, 0.05, false, NULL, NULL), ZP_REACHED_END);
  const double quarter = 0.25 * (double)zp_half_elements(&model->topology);
  const size_t i = (size_t)quarter;
  const double *thickness = zp_sim_liquid(sim).thickness, share = quarter - (double)i;
  ck_assert(share > 0 && thickness[i] != thickness[i + 1]);
  ck_near(zp_sim_get(sim, "film_thickness"), (1 - share) * thickness[i] + share * thickness[i + 1], 1e-12);
  const double along = zp_sim_get(sim, "film_along_loss"), across = zp_sim_get(sim, "film_across_loss");
  ck_assert(along > 0 && across > 0);
  ck_near(zp_sim_get(sim, "viscous_loss"), along + across, 1e-12);
}

/* A run that is saved and restored on the way takes the same steps as one that is not: what the liquid has is a state.
 */
TEST(test_state_of_the_liquid_is_kept) {
  ZpModel *model;
  ZpSim *sim = zip_hold_release(&model, 50e-6, "half");
  run_to(sim, 0.12);
  ck_continues(sim, model, 0.16);
}

/* A simulation continues with liquid where one without it was, and vice versa: the liquid starts at rest. */
TESTS(test_liquid_comes_and_goes, 0, 2) {
  ZpActuatorDef def[2] = {DEF({"mesh.nodes", 31}), DEF({"mesh.nodes", 31})};
  def[1].liquid.model = ZP_LIQUID_SUBMERGED;
  ZpModel *models[2] = {model_of(&def[0]), model_of(&def[1])};
  ZpSim *from = sim_of(models[_i]), *sim = sim_of(models[1 - _i]);
  ZpError err;
  ck_assert_int_eq(zp_sim_run(from, 0.02, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_take_over(sim, from, &err), ZP_OK);
  ck_assert_double_eq(zp_sim_get(sim, "opening"), zp_sim_get(from, "opening"));
  ck_assert_int_eq(zp_sim_run(sim, 0.04, false, NULL, NULL), ZP_REACHED_END);
  ck_below(fabs(zp_sim_get(sim, "energy_imbalance")), 5e-7 * zp_sim_get(sim, "field_energy"));
}

/* -- keys ------------------------------------------------------------------------------------------ */

/* Both ribbons move at one velocity as stiff plates do: each is dragged by c_d rho v^2 / 2 on its face. */
TEST(test_form_drag_of_moving_plates) {
  static const double v = 0.3, h = 1e-3, drag = 1.7;
  ZpActuatorDef def = DEF({"liquid.model", ZP_LIQUID_SUBMERGED}, {"mesh.nodes", 9}, {"medium.drag_coefficient", drag});
  ZpModel *model = model_of(&def);
  ZpEval e;
  ck_assert(zp_system_create(model, false, &e));
  size_t stride = model->stride;
  double *q0 = memory_of(8 * stride * sizeof *q0), *q1 = q0 + 2 * stride, *v0 = q0 + 4 * stride, *F = q0 + 6 * stride;
  double sum = 0;
  for (size_t j = 0; j < model->count; j++) {
    q1[stride + j] = v * h;
    v0[stride + j] = v;
  }
  for (size_t i = 0; i < model->nodes; i++) {
    e.plates_start.gap[i] = e.plates.gap[i] = 1e-3;
  }
  zp_term_outer.force(model, &(ZpSpan){.start = q0, .end = q1, .v0 = v0, .h = h, .share = 1}, &e, F);
  for (size_t j = 0; j < model->count; j++)
    sum += F[stride + j];
  ck_near(sum, -2 * 0.5 * drag * def.medium.density * v * v * def.ribbon.width * (model->L + 0.5 * def.platform.length),
          1e-12);
  zp_system_destroy(&e);
}

/* What the film does not know is refused, by the name of the key. */
TESTS(test_what_is_refused, 0, 4) {
  static const struct {
    const char *key;
    double value;
  } other[] = {{"ribbon.model", ZP_RIBBON_MASS_SPRING},
               {"solver.integrator", ZP_INTEGRATOR_EXPLICIT},
               {"contact.model", ZP_CONTACT_SEQUENTIAL},
               {"actuator.kind", ZP_KIND_HINGE}};
  ZpActuatorDef def = DEF({other[_i].key, other[_i].value});
  def.liquid.model = ZP_LIQUID_SUBMERGED;
  ck_refused_by(ZP_STUDY_ACTUATE, &def, "liquid.model = submerged");
  ck_refused_by(ZP_STUDY_ACTUATE, &def, other[_i].key);
}

TEST(test_modes_are_refused) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.liquid.model = ZP_LIQUID_SUBMERGED;
  ck_refused_by(ZP_STUDY_MODES, &def, "liquid.model");
}

/* Random liquids and voltages: every run ends with a result, and its energy balances. */
TEST(test_random_designs) {
  enum { DESIGNS = FULL_OR(40, 6) };
  uint64_t seed = 17;
  double worst = 0;
  int ended = 0;
  for (int k = 0; k < DESIGNS; k++) {
    Run run = RUN({"mesh.nodes", 31}, {"solver.end_time", 0.5},
                  {"medium.kinematic_viscosity", 5e-5 * exp(4.6 * noise(&seed))},
                  {"medium.density", 1000 + 300 * noise(&seed)}, {"drive.voltage", 8500 + 6500 * noise(&seed)},
                  {"ribbon.width", 13e-3 * exp(noise(&seed))}, {"ribbon.thickness", 60e-6 * exp(0.7 * noise(&seed))},
                  {"load.mass", 8e-3 * exp(noise(&seed))}, {"film.roughness", 2e-6 * exp(1.5 * noise(&seed))});
    if (run.outcome == ZP_ZIPPED || run.outcome == ZP_REACHED_END) ended++;
    if (run.energy_error > 1e-6) printf("design %d: energy off by %.1e\n", k, run.energy_error);
    worst = fmax(worst, run.energy_error);
  }
  printf("%d of %d end with an answer; energy off by %.1e at most\n", ended, DESIGNS, worst);
  ck_assert_int_eq(ended, DESIGNS);
  ck_below(worst, 5e-7); /* 1e-7 measured */
}
