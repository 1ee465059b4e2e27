/* Natural curvature that voltage drives: arcs, blocked ends, lags, work, and a zipping pair at once; section 38 of
 * docs/theory.md. */
#include "check_util.h"

#include "rest/plant.h"
#include "rest/rest.h"
#include "run/run.h"
#include "system/system.h"

static const double L = 0.05;

/* A strip of 50 mm whose curvature is 10 1/m per volt. */
#define STRIP                                                                                                          \
  {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"ribbon.length", 0.05}, {"gravity", 0},     \
      {"load.mass", 0}, {"drive.voltage", 10}, {"segment_1.length", 0.05}, {                                           \
    "segment_1.curvature_per_volt", 10                                                                                 \
  }

/* A pair of ribbons of 30 mm that 2 g part; its segments curl the ribbons apart, or together. */
#define PAIR                                                                                                           \
  {"ribbon.length", 0.06}, {"platform.length", 5e-3}, {"load.mass", 2e-3}, {"mesh.nodes", 31}, {                       \
    "segment_1.length", 0.012                                                                                          \
  }

/* -- at rest --------------------------------------------------------------------------------------- */

static ZpRest *rest_of(const ZpActuatorDef *def) {
  ZpRest *rest;
  ck_ok(zp_rest_create(model_of(def), &rest, &err));
  return zp_test_owns(rest, (void (*)(void *))zp_rest_destroy);
}

/* Where the end of a strip is at a voltage. */
typedef struct Tip {
  double x, y;
} Tip;

static Tip tip_of(const ZpActuatorDef *def, double U) {
  ZpRest *rest = rest_of(def);
  ck_assert(zp_rest_hang(rest, U));
  const ZpRestMember *m = rest->statics.member;
  const size_t last = m->model->nodes - 1;
  return (Tip){m->q[last], zp_nodes(m->model, m->q).y[last]};
}

/* An arc of either sign, at ((sin kL) / k, (1 - cos kL) / k); the error falls with the square of the mesh. */
TESTS(tip_is_on_an_arc, 0, 3) {
  static const double U[] = {0.3, 3, -5};
  const double k = 10 * U[_i];
  double off[2];
  for (int mesh = 0; mesh < 2; mesh++) {
    const ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", mesh ? 121 : 61});
    const Tip tip = tip_of(&def, U[_i]);
    off[mesh] = hypot(tip.x - sin(k * L) / k, tip.y - (1 - cos(k * L)) / k) / L;
  }
  ck_below(off[1], 1e-5 * fabs(k * L));
  ck_near(off[0] / off[1], 4, 8e-2);
}

/* It is where the same strip is that has this curvature by nature, to rounding. */
TESTS(as_a_strip_that_is_bent, 0, 2) {
  const double U = _i ? -2 : 2, a = 10, b = 3;
  const ZpActuatorDef driven = DEF(STRIP, {"segment_1.curvature_per_volt_squared", b}, {"segment_1.curvature", 4}),
                      bent =
                          DEF(STRIP, {"segment_1.curvature_per_volt", 0}, {"segment_1.curvature", 4 + (a + b * U) * U});
  const Tip one = tip_of(&driven, U), other = tip_of(&bent, 0);
  ck_below(hypot(one.x - other.x, one.y - other.y) / L, 1e-12);
}

/* The force 3 E I k / (2 L) at the end brings it back to its height, while the strip bends little. */
TEST(blocked_force) {
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 121});
  const double U = 1e-3, k = 10 * U, EI = zp_ribbon_section(model_of(&def), 0).EI;
  const double free_y = tip_of(&def, U).y;
  def.load.force = 3 * EI * k / (2 * L);
  ck_near(free_y, k * L * L / 2, 3e-5);
  ck_below(fabs(tip_of(&def, U).y / free_y), 3e-5);
}

/* 64 segments whose curvatures rise like the arc length: the slope at the end is the sum of their turns. */
TEST(sixty_four_segments) {
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 65});
  double turn = 0;
  for (int k = 0; k < ZP_MOST_SEGMENTS; k++) {
    char name[ZP_KEY_NAME_SIZE];
    snprintf(name, sizeof name, "segment_%d.length", k + 1);
    ck_ok(zp_def_set_number(&def, name, L / ZP_MOST_SEGMENTS, &err));
    snprintf(name, sizeof name, "segment_%d.curvature_per_volt", k + 1);
    ck_ok(zp_def_set_number(&def, name, 0.5 * (k + 1), &err));
    turn += 0.5 * (k + 1) * L / ZP_MOST_SEGMENTS;
  }
  ZpRest *rest = rest_of(&def);
  ck_assert(zp_rest_hang(rest, 1));
  const ZpRestMember *m = rest->statics.member;
  const double *x = m->q, *y = zp_nodes(m->model, m->q).y;
  const double left = 32 * L / ZP_MOST_SEGMENTS / 2; /* the last joint is half an edge before the end */
  ck_near(atan2(y[64] - y[63], x[64] - x[63]), turn - left, 7e-9);
  ck_assert_int_eq(zp_key_find("segment_65.length"), -1);
  ck_assert_int_eq(zp_key_find("segment_0.length"), -1);
}

/* -- a zipping pair at once -------------------------------------------------------------------------- */

/* At a voltage below pull-in a pair whose ribbons it curls is where one is that has these curvatures by nature; so it
 * is if the curvature is that of one ribbon alone, and below a flat electrode. */
TESTS(pair_as_one_that_is_bent, 0, 3) {
  static const char *const per_volt[] = {"segment_1.curvature_per_volt", "lower.segment_1.curvature_per_volt",
                                         "segment_1.curvature_per_volt"},
                           *const curvature[] = {"segment_1.curvature", "lower.segment_1.curvature",
                                                 "segment_1.curvature"};
  const double U = 300, a = 1e-3;
  ZpActuatorDef driven = DEF(PAIR, {"actuator.kind", _i == 2 ? ZP_KIND_FLANGE : ZP_KIND_ELECTRO_RIBBON}), bent = driven;
  ck_ok(zp_def_set_number(&driven, per_volt[_i], a, &err));
  ck_ok(zp_def_set_number(&bent, curvature[_i], a * U, &err));
  ZpRest *one = rest_of(&driven), *other = rest_of(&bent);
  ck_assert(zp_rest_hang(one, U) && zp_rest_hang(other, U));
  ck_near(zp_rest_stroke(one), zp_rest_stroke(other), 1e-13);
  ck_near(zp_rest_capacitance(one), zp_rest_capacitance(other), 1e-13);
  ck_assert(zp_rest_hang(other, 0)); /* which is not where it hangs without voltage */
  ck_assert_double_gt(fabs(zp_rest_stroke(one) / zp_rest_stroke(other) - 1), 1e-3);
}

/* A cantilever over a flat electrode, which curls away from it or towards it. */
#define OVER                                                                                                           \
  {"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_FREE}, {"ribbon.length", 0.03},                     \
      {"electro.gap_offset", 1e-3}, {"load.mass", 0}, {"gravity", 0}, {"drive.voltage", 6e3},                          \
      {"segment_1.length", 0.03}, {                                                                                    \
    "mesh.nodes", 31                                                                                                   \
  }

/* A limit point is one at fixed curvatures, too: the stiffness is singular there whatever changes. */
TESTS(limits_as_of_one_that_is_bent, 0, 4) {
  const double a = (_i % 2 ? -1 : 1) * 2e-4, b = _i / 2 * 1e-7;
  const ZpActuatorDef driven =
      DEF(OVER, {"segment_1.curvature_per_volt", a}, {"segment_1.curvature_per_volt_squared", b});
  const double U = answered_value(ZP_STUDY_LIMITS, &driven, "pull_in_voltage_V");
  ZpActuatorDef bent = driven, straight = driven;
  bent.segment_K[0].curvature_per_volt = bent.segment_K[0].curvature_per_volt_squared = 0;
  straight = bent;
  bent.segment_K[0].curvature = (a + b * U) * U;
  ck_near(answered_value(ZP_STUDY_LIMITS, &bent, "pull_in_voltage_V"), U, 1e-12);
  ck_assert_double_gt(fabs(answered_value(ZP_STUDY_LIMITS, &straight, "pull_in_voltage_V") / U - 1), 1e-2);
}

/* -- in motion --------------------------------------------------------------------------------------- */

/* k (1 - exp(-t / lag)) at any time, whatever the steps. The strip follows it, later by damping.internal. */
TEST(step_response_with_a_lag) {
  const ZpActuatorDef def = DEF(STRIP, {"drive.voltage", 1}, {"segment_1.curvature_lag", 0.5},
                                {"damping.internal", 3e-4}, {"ribbon.thickness", 2e-4}, {"segment_1.thickness", 2e-4});
  const ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  for (int k = 1; k <= 4; k++) {
    const double t = 0.25 * k, kappa = 10 * (1 - exp(-t / 0.5));
    run_to(sim, t);
    ck_near(zp_law_state(model, &zp_term_curvature, sim->state)[0], kappa, 1e-12);
    const double k_seen = kappa - 3e-4 * (10 - kappa) / 0.5;
    ck_near(-zp_sim_get(sim, "stroke"), (1 - cos(k_seen * L)) / k_seen, 1.2e-4);
  }
}

/* Work without a load: the strip bends to its new natural curvature and stores nothing. With one, what lifts it: of
 * slow motion the work is the rise of all energies. */
TESTS(work_of_slow_curling, 0, 3) {
  const ZpActuatorDef def = DEF(
      STRIP, {"gravity", 9.81}, {"load.mass", _i > 0 ? 2e-3 : 0}, {"drive.voltage", 1}, {"ribbon.thickness", 2e-4},
      {"segment_1.thickness", 2e-4}, {"segment_1.curvature_lag", _i == 2 ? 0.5 : 0}, {"damping.internal", 1e-3},
      {"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 2}, {"solver.end_time", 4}, {"solver.tolerance", 1e-6});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  const ZpTable *rows = result->series;
  const double work = zp_table_get(rows, rows->rows - 1, "curvature_work_J"),
               lost = zp_table_get(rows, rows->rows - 1, "internal_loss_J");
  double rise = 0;
  static const char *const stored[] = {"bending_energy_J", "axial_energy_J", "gravity_energy_J", "kinetic_energy_J"};
  for (size_t k = 0; k < LENGTH_OF(stored); k++)
    rise += zp_table_get(rows, rows->rows - 1, stored[k]) - zp_table_get(rows, 0, stored[k]);
  ck_assert_double_gt(work, 0);
  ck_near(work, rise + lost, 3e-12);
  if (_i > 0) ck_below(lost / work, 2e-2);
  ck_below(zp_result_get(result, "energy_error"), 3e-12);
}

/* Energy balances to the accuracy of the iteration, whatever drives: a jump, one more jump while nothing has moved, a
 * sine of both signs, a zipping pair. */
TESTS(energy_balances, 0, 4) {
  ZpActuatorDef def = DEF(STRIP, {"drive.voltage", -2}, {"damping.drag", 0.1}, {"solver.end_time", 0.1},
                          {"segment_1.curvature_lag", 0}, {"segment_1.curvature_per_volt_squared", 1});
  if (_i == 1) def.segment_K[0].curvature_lag = 0.02;
  if (_i == 2) {
    def.drive.waveform = ZP_WAVEFORM_SINE;
    def.drive.offset = 2;
    def.drive.frequency = 40;
  }
  if (_i == 3)
    def = DEF(PAIR, {"drive.voltage", 2e3}, {"segment_1.curvature_per_volt", 1e-4}, {"segment_1.curvature_lag", 5e-3},
              {"lower.segment_1.curvature_per_volt", -2e-4}, {"lower.segment_1.curvature_lag", 0},
              {"solver.end_time", 0.1});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_double_gt(largest_in(result->series, "curvature_work_J"), 0);
  ck_below(zp_result_get(result, "energy_error"), 1e-7);
}

/* A voltage that another one replaces before anything moves does no work. */
TEST(jumps_at_one_time) {
  const ZpActuatorDef def = DEF(STRIP, {"drive.voltage", 1}, {"damping.drag", 0.1});
  ZpSim *once = sim_of(model_of(&def)), *twice = sim_of(model_of(&def));
  run_to(once, 0.01);
  run_to(twice, 0.01);
  zp_sim_set_voltage(twice, -3, NULL);
  zp_sim_set_voltage(twice, 2, NULL);
  zp_sim_set_voltage(once, 2, NULL);
  run_to(once, 0.02);
  run_to(twice, 0.02);
  ck_same_signal(once, twice, "curvature_work");
  ck_same_signal(once, twice, "stroke");
}

/* Steps of a jump and of a lag converge as those of a swing: errors fall with the square of the steps. */
TESTS(order_in_time, 0, 2) {
  ZpActuatorDef def = DEF(STRIP, {"drive.voltage", 0.1}, {"segment_1.curvature_lag", _i ? 3e-3 : 0}, {"mesh.nodes", 9},
                          {"solver.tolerance", 1e-1}, {"damping.internal", _i ? 0 : 5e-3});
  double y[3];
  for (int k = 0; k < 3; k++) {
    def.solver.time_step = 2e-4 / (1 << k);
    ZpSim *sim = sim_of(model_of(&def));
    run_to(sim, 0.01);
    y[k] = zp_sim_get(sim, "stroke");
  }
  ck_near((y[0] - y[1]) / (y[1] - y[2]), 4, 0.3);
}

/* -- derivatives ------------------------------------------------------------------------------------- */

/* Of the forces by the voltage, at rest and over a step, against differences. */
TESTS(forces_by_voltage, 0, 2) {
  const ZpActuatorDef def = DEF(PAIR, {"segment_1.curvature_per_volt", 2e-3}, {"segment_1.curvature", 5},
                                {"segment_1.curvature_per_volt_squared", 1e-6}, {"segment_1.curvature_lag", 2e-3},
                                {"lower.segment_1.curvature_per_volt", -1e-3}, {"lower.segment_1.curvature_lag", 0});
  const ZpModel *model = model_of(&def);
  ZpRest *rest = rest_of(&def);
  ck_assert(zp_rest_hang(rest, 200));
  ZpEval *eval = &rest->statics.member->eval;
  const size_t n = zp_coordinates(model);
  double *F = memory_of(3 * n * sizeof *F), memory[2] = {0.3, 0.1};
  ZpSpan span = zp_statics_span(&rest->statics, 0);
  double *start = memory_of(n * sizeof *start);
  memcpy(start, span.end, n * sizeof *start);
  start[n / 2] += 1e-6;
  double *v0 = memory_of(n * sizeof *v0);
  if (_i)
    span = (ZpSpan){
        .start = start, .end = span.end, .h = 1e-3, .U0 = 150, .U1 = 200, .share = 1, .memory = memory, .v0 = v0};
  if (_i) zp_system_begin(model, &span, eval);
  ZpByVoltage by = {.force = F, .charge = memory_of(n * sizeof *F)};
  zp_system_force(model, &span, eval, F + n);
  zp_system_by_voltage(model, &span, eval, &by);
  for (int side = 0; side < 2; side++) {
    ZpSpan there = span;
    there.U1 += side ? -1e-2 : 1e-2;
    if (!_i) there.U0 = there.U1;
    zp_system_force(model, &there, eval, F + (size_t)(side + 1) * n);
  }
  double most = 0, off = 0;
  for (size_t k = 0; k < n; k++) {
    most = fmax(most, fabs(F[k]));
    off = fmax(off, fabs((F[n + k] - F[2 * n + k]) / 2e-2 - F[k]));
  }
  ck_below(off / most, 2e-9);
  /* without the curvature they are those of electrodes alone */
  double *all = memory_of(2 * n * sizeof *all);
  ZpByVoltage of_charge = {.force = all, .charge = by.charge, .of_charge = true},
              alone = {.force = all + n, .charge = memory_of(n * sizeof *all)};
  zp_system_force(model, &span, eval, F + n);
  zp_system_by_voltage(model, &span, eval, &of_charge);
  zp_term_plates.by_voltage(model, &span, eval, &alone);
  ck_assert_mem_eq(all, all + n, n * sizeof *all);
}

/* At rest, of joints that turn by half a radian, where moments and turns are no longer proportional. */
TEST(forces_by_voltage_of_large_turns) {
  const ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 11}, {"segment_1.curvature_per_volt_squared", 0.1});
  const ZpModel *model = model_of(&def);
  ZpRest *rest = rest_of(&def);
  ck_assert(zp_rest_hang(rest, 9));
  ZpEval *eval = &rest->statics.member->eval;
  const size_t n = zp_coordinates(model);
  double *F = memory_of(3 * n * sizeof *F), off = 0;
  ZpSpan span = zp_statics_span(&rest->statics, 0);
  ZpByVoltage by = {.force = F, .charge = memory_of(n * sizeof *F)};
  zp_system_force(model, &span, eval, F + n);
  zp_system_by_voltage(model, &span, eval, &by);
  for (int side = 0; side < 2; side++) {
    span.U0 = span.U1 = side ? 9 - 1e-4 : 9 + 1e-4;
    zp_system_force(model, &span, eval, F + (size_t)(side + 1) * n);
  }
  for (size_t k = 0; k < n; k++)
    off = fmax(off, fabs((F[n + k] - F[2 * n + k]) / 2e-4 - F[k]));
  ck_below(off / largest_of(F, n), 6e-11); /* 2.1e-11 measured */
}

/* Of results by the keys of a segment, against differences of studies. */
TESTS(results_by_keys, 0, 5) {
  static const struct {
    ZpStudy study;
    const char *output, *key;
    double step;
  } of[] = {{ZP_STUDY_LIMITS, "pull_in_voltage_V", "segment_1.curvature_per_volt", 1e-6},
            {ZP_STUDY_EQUILIBRIUM, "pull_in_voltage_V", "segment_1.curvature_per_volt_squared", 1e-9},
            {ZP_STUDY_ISOMETRIC, "force_N", "segment_1.curvature_per_volt", 1e-6},
            {ZP_STUDY_ACTUATE, "opening_m", "segment_1.curvature_per_volt", 1e-6},
            {ZP_STUDY_ACTUATE, "opening_m", "segment_1.curvature_lag", 1e-6}};
  ZpActuatorDef def = DEF(PAIR, {"drive.voltage", 4e2}, {"segment_1.curvature_per_volt", 1e-4},
                          {"segment_1.curvature_per_volt_squared", 1e-7}, {"segment_1.curvature_lag", 5e-3},
                          {"isometric.separation", 2e-3}, {"solver.tolerance", 1e-6}, {"mesh.nodes", 15},
                          {"solver.end_time", 5e-3}, {"damping.internal", 1e-4});
  if (of[_i].study == ZP_STUDY_LIMITS || of[_i].study == ZP_STUDY_EQUILIBRIUM)
    def = DEF(OVER, {"segment_1.curvature_per_volt", 1e-4}, {"segment_1.curvature_per_volt_squared", 1e-7});
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", of[_i].key);
  const double slope = slope_in(answer_of(of[_i].study, &def), of[_i].output, of[_i].key);
  double side[2];
  def.sensitivity.by[0] = 0;
  const double value = zp_def_get(&def, zp_key_find(of[_i].key));
  for (int k = 0; k < 2; k++) {
    ck_ok(zp_def_set_number(&def, of[_i].key, value + (k ? -1 : 1) * of[_i].step, &err));
    side[k] = answered_value(of[_i].study, &def, of[_i].output);
  }
  ck_near(slope, (side[0] - side[1]) / (2 * of[_i].step), 3.4e-4);
}

/* -- control ------------------------------------------------------------------------------------------- */

/* The plant of a strip whose curvature lags has that pole, and its gain at rest is the slope of the equilibria. */
TESTS(plant_of_a_lag, 0, 2) {
  const ZpActuatorDef def = DEF(STRIP, {"drive.voltage", 1}, {"segment_1.curvature_lag", _i ? 0.1 : 0},
                                {"damping.internal", 1e-4}, {"mesh.nodes", 31});
  ZpRest *rest = rest_of(&def);
  ck_assert(zp_rest_hang(rest, 0.5));
  ZpPlant plant;
  const ZpSetpointSignal signal = {.kind = ZP_CONTROL_STROKE};
  ck_assert(zp_plant_create(rest, &signal, &plant));
  const size_t n = plant.n;
  double *A = memory_of(n * n * sizeof *A), *b = memory_of(n * sizeof *b), gain = 0;
  memcpy(A, plant.A, n * n * sizeof *A);
  memcpy(b, plant.b, n * sizeof *b);
  for (size_t k = 0; k < n; k++) { /* Gauss with pivots: x = -A^-1 b */
    size_t p = k;
    for (size_t i = k; i < n; i++)
      if (fabs(A[i * n + k]) > fabs(A[p * n + k])) p = i;
    for (size_t j = 0; j < n; j++) {
      const double a = A[k * n + j];
      A[k * n + j] = A[p * n + j];
      A[p * n + j] = a;
    }
    const double c = b[k];
    b[k] = b[p];
    b[p] = c;
    for (size_t i = 0; i < n; i++) {
      const double factor = i == k ? 0 : A[i * n + k] / A[k * n + k];
      for (size_t j = k; factor != 0 && j < n; j++)
        A[i * n + j] -= factor * A[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (size_t k = 0; k < n; k++)
    gain -= plant.c[k] * b[k] / A[k * n + k];
  if (_i) ck_near(plant.A[(n - 1) * n + n - 1], -10, 1e-12);
  zp_plant_destroy(&plant);
  const double h = 1e-4;
  ck_near(gain, (-tip_of(&def, 0.5 + h).y + tip_of(&def, 0.5 - h).y) / (2 * h), 1e-8);
}

/* A periodic motion loses what electrodes and curvature have given it. */
TEST(cycle_loses_what_it_was_given) {
  const ZpActuatorDef def =
      DEF(PAIR, {"drive.voltage", 300}, {"drive.offset", -300}, {"drive.waveform", ZP_WAVEFORM_SINE},
          {"drive.frequency", 30}, {"damping.drag", 0.5}, {"segment_1.curvature_per_volt", 5e-3},
          {"segment_1.curvature_lag", 5e-3}, {"mesh.nodes", 15}, {"cycle.tolerance", 1e-4});
  ZpResult *result = answer_of(ZP_STUDY_CYCLE, &def);
  const ZpTable *rows = result->series;
  const double lost =
      zp_table_get(rows, rows->rows - 1, "drag_loss_J") + zp_table_get(rows, rows->rows - 1, "internal_loss_J") +
      zp_table_get(rows, rows->rows - 1, "contact_loss_J") + zp_table_get(rows, rows->rows - 1, "charging_loss_J");
  ck_assert_double_eq(zp_result_get(result, "linear"), 0);
  ck_assert_double_gt(zp_result_get(result, "curvature_work_per_cycle_J"), 0);
  ck_near(zp_result_get(result, "energy_per_cycle_J"), lost, 5e-5);
}

/* A controller holds a strip whose curvature lags, as the eigenvalues of its loop say. */
TEST(controlled_strip) {
  const ZpActuatorDef def =
      DEF(STRIP, {"drive.voltage", 3}, {"segment_1.curvature_lag", 0.05}, {"damping.internal", 2e-3},
          {"ribbon.thickness", 2e-4}, {"segment_1.thickness", 2e-4}, {"control.kind", ZP_CONTROL_PI},
          {"control.signal", ZP_CONTROL_STROKE}, {"control.proportional", 20}, {"control.integral", 400},
          {"control.period", 2e-3}, {"setpoint.value", -5e-3}, {"solver.end_time", 2});
  ZpResult *loop = answer_of(ZP_STUDY_MODES, &def), *run = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_double_lt(zp_result_get(loop, "loop_growth_1_per_s"), -4);
  ck_near(zp_result_get(run, "stroke_m"), -5e-3, 1.4e-4);
}

/* -- refusals ------------------------------------------------------------------------------------------ */

TEST(refused) {
  ZpActuatorDef plain = DEF({"drive.voltage", -5});
  ck_refused(&plain, "drive.voltage = -5 V: must be at least 0 V, because nothing here depends on its sign");
  plain.drive.voltage = 5;
  plain.modes.voltage = -1;
  ck_refused(&plain, "modes.voltage = -1 V");
  ZpActuatorDef squared = DEF(STRIP, {"segment_1.curvature_per_volt", 0}, {"segment_1.curvature_per_volt_squared", 1},
                              {"drive.voltage", -5});
  ck_refused(&squared, "depends on its sign");
  ZpActuatorDef curled = DEF(STRIP, {"drive.voltage", 1e4});
  ck_refused(&curled, "segment_1.curvature_per_volt: 10000 V would bend the segment to 100000 1/m");
  ZpActuatorDef yields = DEF(STRIP, {"ribbon.plasticity", 1});
  ck_refused(&yields, "ribbon.plasticity");
  ZpActuatorDef lag = DEF(STRIP);
  ck_says(zp_def_set_number(&lag, "segment_1.curvature_lag", -1e-3, &err), ZP_BAD_INPUT,
          "segment_1.curvature_lag = -0.001 s: out of range; 0 to 10000 s");
  ck_says(zp_def_set_number(&lag, "segment_65.length", 1e-3, &err), ZP_BAD_INPUT, "segments have the numbers 1 to 64");
  ck_says(zp_def_set_number(&lag, "segment_K.length", 1e-3, &err), ZP_BAD_INPUT, "1 to 64");
}
