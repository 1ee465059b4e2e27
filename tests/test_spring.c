/* The spring beside the load: closed forms at rest, energy in motion, and the constant force that it becomes. */
#include "state_util.h"

#include "system/system.h"

/* Stiff weightless ribbons have the compliance c: under the weight W and a spring k to the opening r they open by o = c
 * (W + k (r - o)), whole actuator or half. */
TESTS(spring_and_weight_share_what_gives_way, 0, 2) {
  static const double k = 300, r = 4e-3;
  ZpActuatorDef def = DEF({"ribbon.thickness", 500e-6}, {"ribbon.density", 0}, {"drive.voltage", 0},
                          {"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF});
  double W = def.load.mass * def.gravity, c = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m") / W;
  def.load.stiffness = k, def.load.rest_opening = r;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), c * (W + k * r) / (1 + c * k),
          2e-5);                       /* 1.1e-5 measured */
  def.load.rest_opening = 0.5 * c * W; /* it hangs further open than that: nothing pushes, and nothing pulls */
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), c * W, 1e-12); /* 0 measured */
}

/* A long soft spring is a constant force: the limits are those of an equal load, except for the fraction 1e-3 of its
 * length by which it extends. */
TEST(long_spring_is_a_weight) {
  static const double extra = 4e-3, r = 10; /* kg, m */
  ZpActuatorDef heavy = DEF({"mesh.nodes", 31}), def = DEF({"mesh.nodes", 31});
  heavy.load.mass += extra;
  def.load.rest_opening = r;
  double middle = 0.5 * answered_value(ZP_STUDY_STATIONARY, &heavy, "opening_m");
  def.load.stiffness = extra * def.gravity / (r - middle);
  static const char *const names[] = {"pull_in_voltage_V", "release_voltage_V"};
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    ck_near(answered_value(ZP_STUDY_LIMITS, &def, names[i]), answered_value(ZP_STUDY_LIMITS, &heavy, names[i]),
            6e-4); /* 4.9e-4 measured */
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg") + extra,
          answered_value(ZP_STUDY_LIMITS, &heavy, "max_load_kg"), 1e-3); /* 3.3e-4 measured */
}

/* Ribbons that would open further than a stop rest on it, and open by o = c (W + k r) / (1 + c k). */
TESTS(stop_holds_the_platforms, 0, 2) {
  static const double k = 2e4, r = 1e-4;
  ZpActuatorDef def = DEF({"ribbon.thickness", 500e-6}, {"ribbon.density", 0}, {"drive.voltage", 0}, {"load.mass", 0.1},
                          {"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF});
  double W = def.load.mass * def.gravity, c = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m") / W;
  def.load.stop_stiffness = k, def.load.stop_opening = r;
  ck_assert_double_gt(c * W, r);
  /* 1e-6 measured */
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), c * (W + k * r) / (1 + c * k), 5e-6);
  def.load.stop_opening = 1.5 * c * W;                                           /* it is not reached */
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), c * W, 1e-12); /* 0 measured */
}

/* An actuator that swings open against a stop bounces: the depth is limited by its energy, none of which is lost. */
TESTS(energy_with_a_stop, 0, 2) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"load.stop_opening", 12e-3}, {"load.stop_stiffness", 300},
                          {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 4}, {"solver.end_time", 0.3},
                          {"liquid.model", ZP_LIQUID_NONE}, {"output.errors", false}, {"output.samples", 10000});
  if (_i == 1) def.actuator.symmetry = ZP_SYMMETRY_NONE;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  double most = 0;
  for (size_t row = 0; row < result->series->rows; row++) {
    double s = fmax(zp_table_get(result->series, row, "opening_m") - def.load.stop_opening, 0);
    double energy = zp_table_get(result->series, row, "spring_energy_J");
    ck_below(fabs(energy - 0.5 * def.load.stop_stiffness * s * s), 1e-18 + 1e-12 * energy); /* 0 measured */
    most = fmax(most, energy);
  }
  ck_assert_double_gt(most, 1e-6);
  ck_below(zp_result_get(result, "energy_error"), 5e-9); /* 7.2e-10 measured */
}

/* What is held does not feel it: the force of `isometric` is the actuator's. */
TEST(held_platform_does_not_feel_it) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, {"isometric.separation", 2e-3});
  double force = answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N");
  def.load.stiffness = 10, def.load.rest_opening = 20e-3;
  ck_assert_double_eq(answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N"), force);
}

/* Zip, release and swings through the opening at which the spring ends: the energy balances, including that of the
 * spring. Dry, in a bath and by explicit steps. */
TESTS(energy_with_a_spring, 0, 4) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"load.stiffness", 3}, {"load.rest_opening", 18e-3},
                          {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 4}, {"solver.end_time", 0.4});
  if (_i == 1) def.liquid.model = ZP_LIQUID_SUBMERGED, def.drive.frequency = 1, def.solver.end_time = 1.5;
  if (_i == 2) def.solver.integrator = ZP_INTEGRATOR_EXPLICIT, def.solver.end_time = 0.15;
  if (_i == 3) def.actuator.symmetry = ZP_SYMMETRY_NONE;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  double most = 0, least = INFINITY;
  for (size_t row = 0; row < result->series->rows; row++) {
    double s = fmax(def.load.rest_opening - zp_table_get(result->series, row, "opening_m"), 0);
    double energy = zp_table_get(result->series, row, "spring_energy_J");
    ck_below(fabs(energy - 0.5 * def.load.stiffness * s * s), 1e-18 + 1e-12 * energy); /* 0 measured */
    most = fmax(most, energy), least = fmin(least, energy);
  }
  ck_assert_double_gt(most, 0.9 * 0.5 * def.load.stiffness * 18e-3 * 18e-3);
  double start = zp_table_get(result->series, 0, "opening_m"), end = zp_result_get(result, "opening_m");
  double s0 = fmax(def.load.rest_opening - start, 0), s1 = fmax(def.load.rest_opening - end, 0);
  ck_near(zp_result_get(result, "mechanical_work_J"),
          def.load.mass * def.gravity * (start - end) + 0.5 * def.load.stiffness * (s1 * s1 - s0 * s0),
          1e-12); /* 0 measured */
  double work = zp_result_get(result, "mechanical_work_J"), source = zp_result_get(result, "source_energy_J");
  ck_near(zp_result_get(result, "efficiency"), work / source, 1e-12);
  ck_assert(least == 0);
  ck_below(zp_result_get(result, "energy_error"), _i == 2 ? 1e-4 : 5e-8); /* 4.6e-5 and 1.1e-8 measured */
}

/* The mean force over a span does the work of the energy change, also if the spring ends within it, and the stiffness
 * is its derivative. */
TESTS(force_does_the_work_of_the_spring, 0, 8) {
  static const double opening[][2] = {{1e-3, 2e-3}, {1e-3, 7e-3}, {7e-3, 2e-3}, {6e-3, 8e-3}};
  const double sign = _i < 4 ? 1 : -1;
  ZpActuatorDef def = DEF({"mesh.nodes", 4}, {"gravity", 0}, {"ribbon.young_modulus", 1e6}, {"drive.voltage", 0});
  if (sign > 0)
    def.load.stiffness = 3, def.load.rest_opening = 5e-3;
  else
    def.load.stop_stiffness = 3, def.load.stop_opening = 5e-3;
  ZpModel *model = model_of(&def);
  ZpEval e;
  ck_assert(zp_system_create(model, false, &e));
  const ZpTerm *spring = &zp_term_spring;
  size_t stride = model->stride, node = zp_load_node(&model->topology);
  double *q0 = memory_of(2 * stride * sizeof *q0), *q1 = memory_of(2 * stride * sizeof *q1), F[2] = {0, 0};
  double *force = memory_of(2 * stride * sizeof *force);
  const double *o = opening[_i % 4], k = 0.5 * 3, s0 = fmax(sign * (5e-3 - o[0]), 0);
  for (int side = 0; side < 2; side++) { /* a little before and behind the end */
    double end = o[1] + (side ? 1e-8 : -1e-8), s1 = fmax(sign * (5e-3 - end), 0);
    q0[stride + node] = -o[0], q1[stride + node] = -end;
    memset(force, 0, 2 * stride * sizeof *force);
    spring->force(model, &(ZpSpan){.start = q0, .end = q1, .h = 1e-3, .share = 1}, &e, force);
    F[side] = -force[stride + node];
    ck_below(fabs(F[side] * (end - o[0]) - 0.5 * k * (s0 * s0 - s1 * s1)), 1e-15);
  }
  ZpAssembly assembly;
  const ZpTies ties = zp_ties_of(model, 1, 0);
  ck_assert(zp_assembly_create(&ties, 0, true, &assembly));
  ZpBand K;
  ZpArena size = {NULL, 0};
  zp_band_reserve(&K, assembly.n, 0, assembly.block.band.bandwidth, &size);
  void *block = memory_of(size.used * sizeof(double));
  ZpArena arena = {block, 0};
  zp_band_reserve(&K, assembly.n, 0, assembly.block.band.bandwidth, &arena);
  q1[stride + node] = -o[1];
  spring->stiffness(model, &(ZpSpan){.start = q0, .end = q1, .h = 1e-3, .share = 1}, &assembly, &e, &K);
  size_t row = (size_t)assembly.equation[2 * node + 1];
  ck_below(fabs(*zp_band_at(&K, row, row) + (F[1] - F[0]) / 2e-8), 5e-11 * k); /* 5.9e-12 measured */
  zp_assembly_destroy(&assembly);
  zp_system_destroy(&e);
}

TEST(what_a_spring_lacks_is_said) {
  static const struct {
    Setting one, other;
    const char *says;
  } refused[] = {{{"load.stiffness", 3},
                  {"mesh.nodes", 21},
                  "load.stiffness = 3 N/m: requires load.rest_opening, which is missing"},
                 {{"load.stop_stiffness", 3}, {"mesh.nodes", 21}, "requires load.stop_opening"},
                 {{"load.stop_opening", 3e-3}, {"actuator.kind", ZP_KIND_RIBBON}, "electro_ribbon"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF(refused[k].one, refused[k].other);
    ck_refused(&def, refused[k].says);
  }
  ZpActuatorDef def = DEF({"load.stiffness", 3}, {"load.rest_opening", 3e-3}, {"actuator.kind", ZP_KIND_FLANGE});
  ck_refused(&def, "actuator.kind electro_ribbon");
}

/* A sweep may begin at 0: a key that does nothing there asks for nothing, and what belongs to it may stay. */
TEST(keys_do_nothing_at_zero) {
  static const struct {
    Setting zero, beside;
  } neutral[] = {{{"load.rest_opening", 15e-3}, {"load.stiffness", 0}},
                 {{"load.stop_stiffness", 0}, {"mesh.nodes", 11}},
                 {{"load.stop_stiffness", 0}, {"load.stop_opening", 5e-3}},
                 {{"load.change_mass", 0}, {"load.change_time", 1e-3}},
                 {{"ribbon.hardening_modulus", 0}, {"lower.ribbon.hardening_modulus", 0}},
                 {{"sense.noise", 0}, {"mesh.nodes", 11}}};
  ZpActuatorDef plain = DEF({"mesh.nodes", 11}, {"solver.end_time", 3e-3}, {"liquid.model", ZP_LIQUID_NONE});
  const double opening = answered_value(ZP_STUDY_ACTUATE, &plain, "opening_m");
  for (size_t k = 0; k < LENGTH_OF(neutral); k++) {
    ZpActuatorDef def = plain;
    zp_def_set(&def, zp_key_find(neutral[k].zero.key), neutral[k].zero.value, NULL);
    zp_def_set(&def, zp_key_find(neutral[k].beside.key), neutral[k].beside.value, NULL);
    ck_assert_msg(answered_value(ZP_STUDY_ACTUATE, &def, "opening_m") == opening, "%s", neutral[k].zero.key);
  }
  ZpActuatorDef falls = plain; /* from a height that counts only with a mass */
  falls.load.change_time = 1e-3, falls.load.drop_height = 10e-3;
  ck_assert_double_eq(answered_value(ZP_STUDY_ACTUATE, &falls, "opening_m"), opening);
}
