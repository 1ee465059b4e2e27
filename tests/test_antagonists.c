/* Two actuators that pull at one load: at rest against beams, symmetry and each of them alone; in motion against a mass
 * on a spring, and their energy. docs/theory.md, section 31. */
#include "check_util.h"

#include "rest/rest.h"

static const double pi = 3.14159265358979323846;

#define BOTH                                                                                                           \
  {"stack.series", 2}, {"stack.distance", 20e-3}, {                                                                    \
    "mesh.nodes", 31                                                                                                   \
  }

/* A number in the last row of a study's table. */
static double last_of(ZpStudy study, const ZpActuatorDef *def, const char *column) {
  ZpResult *result = answer_of(study, def);
  return zp_table_get(result->series, result->series->rows - 1, column);
}

/* -- at rest --------------------------------------------------------------------------------------- */

/* Two that are alike are at rest in the middle at any voltage that both have, and move neither way; the capacitance is
 * that of both. */
TEST(equal_ones_rest_in_the_middle) {
  ZpActuatorDef def = DEF(BOTH, {"gravity", 0}, {"load.mass", 1e-3}, {"drive.voltage", 2e3});
  ZpResult *result = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  size_t rows = result->series->rows;
  ck_assert_uint_ge(rows, 5);
  for (size_t row = 0; row < rows; row++) {
    ck_near(zp_table_get(result->series, row, "opening_m"), 10e-3, 1e-12);       /* 2.2e-16 measured */
    ck_near(zp_table_get(result->series, row, "lower_opening_m"), 10e-3, 1e-12); /* 4.4e-16 measured */
    ck_assert_double_eq(zp_table_get(result->series, row, "stable"), 1);
  }
  ZpActuatorDef one = def;
  one.stack.series = 1;
  one.stack.distance = NAN;
  one.isometric.separation = 10e-3;
  ck_near(zp_table_get(result->series, rows - 1, "capacitance_F"),
          2 * answered_value(ZP_STUDY_ISOMETRIC, &one, "capacitance_F"), 2e-10); /* 2.1e-11 measured */
  ZpShape shape = zp_shapes_get(result->shapes, result->shapes->frames - 1);
  size_t of_each = result->shapes->nodes * result->shapes->ribbons / 2;
  for (size_t j = 0; j < of_each; j++) /* the lower one is the mirror image */
    ck_below(fabs(shape.y[of_each + j] + shape.y[j] + def.stack.distance),
             1e-12 * def.stack.distance); /* 1.8e-16 measured */
}

/* Beams that hardly bend: each half of an actuator is two of them in a row, so both actuators hold the load by
 * 24 EI / L^3, which its weight deflects by m g over that. Eq. (31.4). */
TEST(small_stiffness_is_that_of_beams) {
  ZpActuatorDef def = DEF({"stack.series", 2}, {"stack.distance", 0.4e-3}, {"ribbon.density", 0},
                          {"insulator.density", 0}, {"insulator.young_modulus", 0}, {"load.mass", 0.01e-3});
  const double nu = def.ribbon.poisson_ratio, b = def.ribbon.thickness,
               L = 0.5 * (def.ribbon.length - def.platform.length);
  double EI = def.ribbon.young_modulus / (1 - nu * nu) * def.ribbon.width * b * b * b / 12;
  double stiffness = 24 * EI / (L * L * L), sag = def.load.mass * def.gravity / stiffness;
  ZpResult *result = answer_of(ZP_STUDY_STATIONARY, &def);
  ck_near(zp_result_get(result, "stiffness_N_per_m"), stiffness, 5e-5); /* 1.5e-5 measured */
  ck_near(zp_result_get(result, "opening_m") - 0.2e-3, sag, 5e-5);      /* 1.5e-5 measured */
  /* 0 measured */
  ck_near(zp_result_get(result, "opening_m") + zp_result_get(result, "lower_opening_m"), 0.4e-3, 1e-12);
}

/* The stiffness at a voltage is what a small force deflects the load by. */
TEST(stiffness_is_the_slope_of_the_force) {
  static const double force = 1e-6; /* N */
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 0.5e-3}, {"drive.voltage", 1.5e3}, {"stack.voltage_ratio", 0.6},
                          {"solver.tolerance", 1e-6}),
                more = def, less = def;
  more.load.force = force;
  less.load.force = -force;
  double moved = last_of(ZP_STUDY_EQUILIBRIUM, &more, "opening_m") - last_of(ZP_STUDY_EQUILIBRIUM, &less, "opening_m");
  ck_near(last_of(ZP_STUDY_EQUILIBRIUM, &def, "stiffness_N_per_m"), 2 * force / moved, 2e-9); /* 3.6e-10 measured */
}

/* What the branch is told of the voltage is how the forces go with it, of both. */
TEST(voltage_moves_the_residual) {
  static const double little = 1e-2; /* V */
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 0.5e-3}, {"stack.voltage_ratio", 0.6});
  ZpModel *model = model_of(&def);
  ZpRest both;
  ck_assert(zp_rest_open(&both, model, NULL, NULL));
  ck_assert(zp_newton_good(zp_statics_find_rest(&both.statics).end));
  ck_assert(zp_newton_good(zp_rest_settle(&both, 1500).end));
  const ZpBranchSystem *system = &both.system;
  ZpStatics *s = &both.statics;
  size_t n = system->at_rest.n;
  double *up = memory_of(3 * n * sizeof *up), *down = up + n, *by = down + n;
  system->at_rest.residual(s, by, NULL);
  system->sensitivity(s, by);
  zp_branch_set(system, 1500 + little);
  system->at_rest.residual(s, up, NULL);
  zp_branch_set(system, 1500 - little);
  system->at_rest.residual(s, down, NULL);
  double most = largest_of(by, n);
  for (size_t i = 0; i < n; i++)
    up[i] = (up[i] - down[i]) / (2 * little) - by[i];
  ck_below(largest_of(up, n) / most, 5e-11); /* 7e-12 measured */
  zp_rest_close(&both);
}

/* -- each of them alone ---------------------------------------------------------------------------- */

/* One of two antagonists alone; upside down if it is the lower one. */
static ZpActuatorDef alone(const ZpActuatorDef *both, bool lower) {
  ZpActuatorDef one = *both;
  one.stack.series = 1;
  one.stack.distance = one.stack.lower_voltage = NAN;
  one.stack.voltage_ratio = 1;
  double thickness = zp_def_number(both, "member_2.ribbon.thickness");
  if (lower && !isnan(thickness)) one.ribbon.thickness = thickness;
  set_member(&one, "member_2.ribbon.thickness", NAN);
  one.mount.tilt = lower ? pi : 0;
  one.load.mass = 0;
  return one;
}

/* The force that holds it open as far without voltage, N, found by trying. */
static double pull_without_voltage(ZpActuatorDef one, double opening) {
  double force[2] = {0.02, 0.05}, off[2];
  for (int k = 0; k < 60; k++) {
    one.load.force = force[k > 0];
    double found = answered_value(ZP_STUDY_STATIONARY, &one, "opening_m") - opening;
    if (k > 0 && fabs(found) < 1e-9 * opening) return force[1];
    off[k > 0] = found;
    if (k == 0) continue;
    double next = force[1] - off[1] * (force[1] - force[0]) / (off[1] - off[0]);
    force[0] = force[1];
    off[0] = off[1];
    force[1] = next;
  }
  ck_abort_msg("no force holds an opening of %g m", opening);
  return NAN;
}

/* And at a voltage: what study isometric adds. */
static double pull_of(ZpActuatorDef one, double opening, double voltage) {
  double without = pull_without_voltage(one, opening);
  one.isometric.separation = opening;
  one.drive.voltage = voltage;
  return without + answered_value(ZP_STUDY_ISOMETRIC, &one, "force_N");
}

/* Where the load is, one pulls as the other does and the load weighs: F1(x) = F2(d - x) + m g, with each force from
 * that one alone, by studies that know no antagonists. Unlike ones, with their own weight. Eq. (31.2). By night: with a
 * computed field for each. */
TEST(forces_of_each_alone_balance) {
  ZpActuatorDef def =
      DEF(BOTH, {"load.mass", 0.5e-3}, {"drive.voltage", 2e3}, {"stack.voltage_ratio", 0.7},
          {"member_2.ribbon.thickness", 60e-6}, {"electro.model", _i ? ZP_ELECTRO_FIELD : ZP_ELECTRO_PLATES});
  if (_i) def.mesh.nodes = 9;
  ZpActuatorDef upper = alone(&def, false), lower = alone(&def, true);
  ZpResult *result = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  size_t last = result->series->rows - 1;
  double x = zp_table_get(result->series, last, "opening_m"), y = zp_table_get(result->series, last, "lower_opening_m");
  ck_near(zp_table_get(result->series, last, "lower_voltage_V"), 1.4e3, 1e-12);                  /* 0 measured */
  ck_near(x + y, 20e-3, 1e-12);                                                                  /* 2.2e-16 measured */
  ck_near(pull_of(upper, x, 2e3) - pull_of(lower, y, 1.4e3), def.load.mass * def.gravity, 2e-9); /* 2.5e-10 measured */
}
ALSO_NIGHTLY(forces_of_each_alone_balance, 1, 2)

/* Where the load is held, the lower one takes from the pull of the upper one, each as it is alone at its opening and
 * voltage. Voltages of both in proportion, or a constant one of the lower one. */
TESTS(held_load_takes_the_difference, 0, 2) {
  static const char *const names[] = {"force_N", "force_unpowered_N", "charge_C", "capacitance_F"};
  ZpActuatorDef def = DEF(BOTH, {"drive.voltage", 4e3}, {"isometric.separation", 7e-3},
                          {"member_2.ribbon.thickness", 60e-6}, {"mesh.nodes", 21});
  zp_def_set(&def, zp_key_find(_i ? "stack.lower_voltage" : "stack.voltage_ratio"), _i ? 3e3 : 1.5, NULL);
  ZpActuatorDef one[] = {alone(&def, false), alone(&def, true)};
  one[1].isometric.separation = 13e-3;
  one[1].drive.voltage = _i ? 3e3 : 6e3;
  ZpResult *both = answer_of(ZP_STUDY_ISOMETRIC, &def);
  for (size_t k = 0; k < LENGTH_OF(names); k++) {
    double upper = answered_value(ZP_STUDY_ISOMETRIC, &one[0], names[k]),
           lower = answered_value(ZP_STUDY_ISOMETRIC, &one[1], names[k]);
    ck_near(zp_result_get(both, names[k]), k < 2 ? upper - lower : upper + lower, 1.8e-10); /* 6.3e-11 measured */
  }
  ck_near(zp_result_get(both, "lower_opening_m"), 13e-3, 1e-12); /* 3.4e-15 measured */
}

/* Each is closed from its clip as far as it is alone where it is held at its opening and voltage. */
TEST(each_is_closed_as_far_as_alone) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 0.5e-3}, {"drive.voltage", 4e3}, {"stack.voltage_ratio", 1.4});
  ZpActuatorDef one[] = {alone(&def, false), alone(&def, true)};
  static const char *const opening[] = {"opening_m", "lower_opening_m"},
                           *const voltage[] = {"voltage_V", "lower_voltage_V"},
                           *const closed[] = {"zipped_length_m", "lower_zipped_length_m"};
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  const ZpTable *t = result->series;
  int compared = 0;
  for (size_t row = 0; row < t->rows && compared < 3; row++) {
    if (zp_table_get(t, row, closed[1]) < 5e-3 * compared + 5e-3) continue;
    for (int k = 0; k < 2; k++) {
      one[k].isometric.separation = zp_table_get(t, row, opening[k]);
      one[k].drive.voltage = zp_table_get(t, row, voltage[k]);
      double length = answered_value(ZP_STUDY_ISOMETRIC, &one[k], "zipped_length_m");
      ck_assert_double_eq_tol(zp_table_get(t, row, closed[k]), length, 1e-12);
    }
    compared++;
  }
  ck_assert_int_eq(compared, 3);
}

/* Half the difference of the force of one alone over a small way (m), N/m. */
static double slope_over(const ZpActuatorDef *one, double opening, double voltage, double way) {
  return (pull_of(*one, opening + way, voltage) - pull_of(*one, opening - way, voltage)) / (2 * way);
}

static double slope_of(const ZpActuatorDef *one, double opening, double voltage) {
  return slope_over(one, opening, voltage, 20e-6);
}

/* In the middle the stiffness is the sum of both, less what the field takes: twice that of one alone, with the other
 * sign below and above the voltage at which the middle is lost. Eq. (31.5). */
TEST(middle_is_lost_where_both_slopes_vanish) {
  ZpActuatorDef def = DEF(BOTH, {"gravity", 0}, {"load.mass", 1e-3}, {"drive.voltage", 2e3}), one = alone(&def, false);
  /* 1.6e-6 measured */
  ck_near(last_of(ZP_STUDY_EQUILIBRIUM, &def, "stiffness_N_per_m"), 2 * slope_of(&one, 10e-3, 2e3), 5e-6);
  def.drive.voltage = 6e3;
  double lost = answered_value(ZP_STUDY_EQUILIBRIUM, &def, "pull_in_voltage_V");
  ck_assert_double_gt(slope_of(&one, 10e-3, 0.999 * lost), 0);
  ck_assert_double_lt(slope_of(&one, 10e-3, 1.001 * lost), 0);
}

/* The upper one closes at the highest voltage of all equilibria on the way there. */
TEST(one_closes_where_the_way_is_highest) {
  ZpActuatorDef def =
      DEF(BOTH, {"mesh.nodes", 121}, {"load.mass", 1e-3}, {"drive.voltage", 5e3}, {"stack.voltage_ratio", 0});
  ZpResult *result = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  double closing = zp_result_get(result, "closing_voltage_V"), highest = 0;
  ck_assert_double_gt(closing, zp_result_get(result, "pull_in_voltage_V"));
  for (size_t row = 0; zp_table_get(result->series, row, "opening_m") > 0.2e-3; row++)
    highest = fmax(highest, zp_table_get(result->series, row, "voltage_V"));
  ck_assert_double_ge(closing, highest);
  ck_near(closing, highest, 1e-3); /* 1.1e-4 measured */
}

/* While the upper one is closed the lower one hangs at the whole distance, and pulls as a constant force does: the
 * upper one opens where it would alone under that force, with the load. */
TEST(it_opens_as_alone_under_the_pull_of_the_other) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 1e-3}, {"drive.voltage", 5e3}, {"stack.voltage_ratio", 0}),
                upper = alone(&def, false);
  upper.load.mass = def.load.mass;
  upper.load.force = pull_without_voltage(alone(&def, true), 20e-3);
  ck_near(answered_value(ZP_STUDY_EQUILIBRIUM, &def, "release_voltage_V"),
          answered_value(ZP_STUDY_LIMITS, &upper, "release_voltage_V"), 1e-3); /* 4.5e-4 measured */
}

/* Limits are those of the curve. */
static void ck_as_curve(const ZpActuatorDef *def, const ZpResult *limits) {
  static const char *const names[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V"};
  ZpResult *curve = answer_of(ZP_STUDY_EQUILIBRIUM, def);
  for (size_t k = 0; k < LENGTH_OF(names); k++)
    ck_near(zp_result_get(limits, names[k]), zp_result_get(curve, names[k]), 1e-12);             /* 0 measured */
  ck_near(zp_result_get(limits, "max_stress_Pa"), zp_result_get(curve, "max_stress_Pa"), 8e-12); /* 2.3e-12 measured */
}

/* The load jumps where the forces of both, each of that one alone by study isometric, are equal and have slopes that
 * cancel: the pull-in of the upper one while the lower one has its own voltage. Eqs. (31.2), (31.4). */
TEST(pull_in_is_where_slopes_cancel) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 1e-3}, {"drive.voltage", 5e3}, {"stack.lower_voltage", 1.5e3},
                          {"member_2.ribbon.thickness", 60e-6}),
                upper = alone(&def, false), lower = alone(&def, true);
  ZpResult *result = answer_of(ZP_STUDY_LIMITS, &def);
  ck_as_curve(&def, result);
  double voltage = zp_table_get(result->series, 0, "voltage_V"), x = zp_table_get(result->series, 0, "opening_m"),
         y = zp_table_get(result->series, 0, "lower_opening_m");
  ck_assert_double_eq(voltage, zp_result_get(result, "pull_in_voltage_V"));
  ck_assert_double_eq(zp_table_get(result->series, 0, "lower_voltage_V"), 1.5e3);
  /* 2.1e-9 measured */
  ck_near(pull_of(upper, x, voltage) - pull_of(lower, y, 1.5e3), def.load.mass * def.gravity, 2e-8);
  static const double way = 1e-6; /* m: where one begins to zip the slope changes within a hundredth of a millimetre */
  ck_near(slope_over(&upper, x, voltage, way), -slope_over(&lower, y, 1.5e3, way), 1e-3); /* 1.6e-4 measured */
}

/* While it is closed, and as it opens, the numbers of the limits are those of the states that they have. */
TEST(limits_have_their_states) {
  ZpActuatorDef def =
      DEF(BOTH, {"mesh.nodes", 61}, {"load.mass", 1e-3}, {"drive.voltage", 5e3}, {"stack.voltage_ratio", 0});
  ZpResult *result = answer_of(ZP_STUDY_LIMITS, &def);
  ck_as_curve(&def, result);
  ck_assert_uint_eq(result->series->rows, 3);
  ck_assert_double_eq(zp_table_get(result->series, 1, "voltage_V"), zp_result_get(result, "closing_voltage_V"));
  ck_assert_double_eq(zp_table_get(result->series, 2, "voltage_V"), zp_result_get(result, "release_voltage_V"));
  ck_assert_double_lt(zp_table_get(result->series, 2, "opening_m"), 0.2e-3);
  for (size_t row = 0; row < 3; row++)
    ck_near(zp_table_get(result->series, row, "opening_m") + zp_table_get(result->series, row, "lower_opening_m"),
            20e-3, 1e-12); /* 2.2e-16 measured */
  ck_assert_double_gt(zp_result_get(result, "travel_m"), 12e-3);
  ZpActuatorDef one = alone(&def, false);
  ck_near(zp_result_get(result, "mass_kg"), 2 * answered_value(ZP_STUDY_LIMITS, &one, "mass_kg"), 1e-12);
}

/* Thick ribbons close without a jump, the upper one or the lower one: where the opening is a hundredth of that without
 * voltage. */
TESTS(one_closes_gradually, 0, 2) {
  static const double ratio[] = {0, 3};
  ZpActuatorDef def =
      DEF({"stack.series", 2}, {"stack.distance", 0.2e-3}, {"ribbon.thickness", 300e-6}, {"load.mass", 1e-3},
          {"mesh.nodes", 31}, {"drive.voltage", 3e3}, {"stack.voltage_ratio", ratio[_i]});
  static const char *const names[] = {"opening_m", "lower_opening_m"};
  ZpResult *limits = answer_of(ZP_STUDY_LIMITS, &def);
  ck_assert_uint_eq(limits->series->rows, 2);
  ck_assert_double_eq(zp_table_get(limits->series, 0, "limit"), 1);
  ck_assert_double_eq(zp_table_get(limits->series, 1, "limit"), 2); /* it opens where it closes */
  /* 4.3e-14 measured */
  ck_near(zp_table_get(limits->series, 1, "voltage_V"), zp_table_get(limits->series, 0, "voltage_V"), 1e-12);
  ck_assert_double_eq(zp_table_get(limits->series, 0, "voltage_V"), zp_result_get(limits, "closing_voltage_V"));
  ck_near(zp_table_get(limits->series, 0, names[_i]), 0.01 * answered_value(ZP_STUDY_STATIONARY, &def, names[_i]),
          1e-12); /* 3e-14 measured */
}

/* -- small motions --------------------------------------------------------------------------------- */

/* Two alike in the middle move with the load as one does with half of it, held at that opening by a constant force:
 * without and with a voltage. */
TESTS(two_swing_as_one_with_half_the_load, 0, 2) {
  static const double voltage[] = {0, 2e3};
  ZpActuatorDef both = DEF(BOTH, {"gravity", 0}, {"load.mass", 1e-3}, {"liquid.model", ZP_LIQUID_NONE},
                           {"modes.voltage", voltage[_i]}),
                one = alone(&both, false);
  one.load.force = voltage[_i] > 0 ? pull_of(one, 10e-3, voltage[_i]) : pull_without_voltage(one, 10e-3);
  one.load.mass = 0.5 * both.load.mass;
  ck_near(answered_value(ZP_STUDY_MODES, &both, "frequency_1_Hz"),
          answered_value(ZP_STUDY_MODES, &one, "frequency_1_Hz"), 2e-9); /* 6.9e-10 measured */
}

/* A heavy load between unequal light ones is a mass on the stiffness that study equilibrium finds, whose two terms the
 * voltages reduce; for small openings it is that of beams. Eqs. (31.4), (31.6). */
TEST(heavy_load_swings_on_both_stiffnesses) {
  ZpActuatorDef def = DEF(BOTH, {"gravity", 0}, {"ribbon.density", 1}, {"insulator.density", 0}, {"load.mass", 1},
                          {"drive.voltage", 1.5e3}, {"modes.voltage", 1.5e3}, {"stack.voltage_ratio", 0.6},
                          {"member_2.ribbon.thickness", 60e-6}, {"liquid.model", ZP_LIQUID_NONE});
  double stiffness = last_of(ZP_STUDY_EQUILIBRIUM, &def, "stiffness_N_per_m");
  /* 4.3e-8 measured */
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), sqrt(stiffness / def.load.mass) / (2 * pi), 2e-7);
  ZpActuatorDef beams = DEF({"stack.series", 2}, {"stack.distance", 0.4e-3}, {"ribbon.density", 1},
                            {"insulator.density", 0}, {"insulator.young_modulus", 0}, {"load.mass", 1}, {"gravity", 0});
  const double nu = beams.ribbon.poisson_ratio, b = beams.ribbon.thickness,
               L = 0.5 * (beams.ribbon.length - beams.platform.length);
  double EI = beams.ribbon.young_modulus / (1 - nu * nu) * beams.ribbon.width * b * b * b / 12;
  /* 7.6e-6 measured */
  ck_near(answered_value(ZP_STUDY_MODES, &beams, "frequency_1_Hz"), sqrt(24 * EI / (L * L * L)) / (2 * pi), 3e-5);
}

/* A small voltage makes the load swing about where it is then at rest: after one and a quarter periods of the lowest
 * mode it passes there. Ribbons and load have their masses, so the period is that of all. */
TEST(period_of_a_swing_is_that_of_the_mode) {
  ZpActuatorDef def =
      DEF(BOTH, {"load.mass", 1e-3}, {"drive.voltage", 500}, {"modes.voltage", 500}, {"stack.voltage_ratio", 0},
          {"member_2.ribbon.thickness", 60e-6}, {"liquid.model", ZP_LIQUID_NONE}, {"solver.tolerance", 1e-6});
  ZpResult *curve = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  double start = zp_table_get(curve->series, 0, "opening_m"),
         rest = zp_table_get(curve->series, curve->series->rows - 1, "opening_m");
  def.solver.end_time = 1.25 / answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz");
  ck_assert_double_eq_tol((answered_value(ZP_STUDY_ACTUATE, &def, "opening_m") - rest) / (rest - start), 0,
                          0.02); /* 0.015 measured */
}

/* Above the pull-in there are no modes, and the message names the voltage; below they fall towards it. */
TEST(voltage_softens_both) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 1e-3}, {"drive.voltage", 5e3}, {"stack.voltage_ratio", 0},
                          {"liquid.model", ZP_LIQUID_NONE});
  double without = answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"),
         pull_in = answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V");
  def.modes.voltage = 0.9999 * pull_in;
  ck_assert_double_lt(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), 0.5 * without);
  def.modes.voltage = 1.001 * pull_in;
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  ck_assert_int_eq(result->outcome, ZP_PULLED_IN);
  ck_assert_double_nan(zp_result_get(result, "frequency_1_Hz"));
  ck_assert_msg(strstr(result->message, "modes.voltage"), "%s", result->message);
}

/* Upside down both change their places. */
TEST(upside_down_they_change_places) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 0.7e-3}), turned = def;
  turned.mount.tilt = pi;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"),
          answered_value(ZP_STUDY_STATIONARY, &turned, "lower_opening_m"), 1e-12); /* 2.2e-16 measured */
}

/* A constant voltage of the lower one is as good as a ratio that makes it. */
TEST(constant_voltage_is_that_ratio) {
  ZpActuatorDef ratio = DEF(BOTH, {"load.mass", 0.5e-3}, {"drive.voltage", 2e3}, {"stack.voltage_ratio", 0.5}),
                constant = ratio;
  constant.stack.voltage_ratio = 1;
  constant.stack.lower_voltage = 1e3;
  ck_near(last_of(ZP_STUDY_EQUILIBRIUM, &constant, "opening_m"), last_of(ZP_STUDY_EQUILIBRIUM, &ratio, "opening_m"),
          1e-12); /* 0 measured */
  constant.stack.lower_voltage = 5e3;
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &constant);
  ck_assert_int_eq(result->outcome, ZP_NOT_SETTLED);
  ck_assert_msg(strstr(result->message, "stack.lower_voltage"), "%s", result->message);
}

/* The lower one stays at its constant voltage under any waveform of the upper one, whose keys are not its own. */
TESTS(constant_voltage_under_any_waveform, 0, 3) {
  static const Setting of[][4] = {
      {{"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.frequency", 5}},
      {{"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 5}, {"drive.duty", 0.3}, {"drive.rise_time", 1e-3}},
      {{"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 1e-2}, {"drive.offset", 1e3}}};
  ZpActuatorDef def = DEF(BOTH, {"drive.voltage", 5e3}, {"stack.lower_voltage", 2e3}, {"solver.end_time", 1e-3});
  for (size_t k = 0; k < LENGTH_OF(of[_i]) && of[_i][k].key; k++)
    ck_assert_int_eq(zp_def_set(&def, zp_key_find(of[_i][k].key), of[_i][k].value, NULL), ZP_OK);
  ck_ok(zp_study_check(ZP_STUDY_ACTUATE, &def, &err));
  ZpModel *model = model_of(&def);
  ck_assert_double_eq(zp_waveform_largest(&model[1].waveform), 2e3);
  ck_assert_double_eq(zp_waveform_voltage(&model[1].waveform, 0.13), 2e3);
}

/* -- in motion ------------------------------------------------------------------------------------- */

/* Without voltage what is at rest stays. */
TESTS(at_rest_they_stay, 0, 2) {
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 1e-3}, {"drive.voltage", 0}, {"solver.end_time", 0.2},
                          {"liquid.model", _i ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_near(zp_result_get(result, "opening_m"), zp_result_get(result, "start_opening_m"), 1e-12); /* 1.2e-15 measured */
  /* 0 measured */
  ck_near(zp_result_get(result, "start_opening_m"), answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), 1e-12);
}

/* A heavy load between light ribbons is a mass on the spring of both: a small voltage of one makes it swing, and after
 * half a period it has gone twice as far as at rest. */
TEST(load_swings_on_both) {
  ZpActuatorDef def = DEF(BOTH, {"gravity", 0}, {"ribbon.density", 1}, {"insulator.density", 0}, {"load.mass", 1},
                          {"drive.voltage", 300}, {"stack.voltage_ratio", 0}, {"solver.tolerance", 1e-7});
  double stiffness = last_of(ZP_STUDY_EQUILIBRIUM, &def, "stiffness_N_per_m");
  double moved = last_of(ZP_STUDY_EQUILIBRIUM, &def, "opening_m") - 10e-3;
  def.solver.end_time = pi * sqrt(def.load.mass / stiffness);
  ck_near(answered_value(ZP_STUDY_ACTUATE, &def, "opening_m") - 10e-3, 2 * moved, 1e-4); /* 2.1e-5 measured */
}

/* What both sources give is stored or lost while the upper one closes against the lower one, dry, in a bath and with
 * beads; openings sum up to the distance, and platforms are where the load is. */
TESTS(energy_of_a_zip_against_the_other, 0, 3) {
  static const int liquid[] = {ZP_LIQUID_NONE, ZP_LIQUID_SUBMERGED, ZP_LIQUID_BEAD};
  ZpActuatorDef def = DEF(BOTH, {"load.mass", 0.5e-3}, {"drive.voltage", 10e3}, {"stack.voltage_ratio", 0.2},
                          {"liquid.model", liquid[_i]}, {"solver.end_time", 2}, {"bead.volume", 1e-6});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  const ZpShapes *film = result->shapes;
  size_t count = film->ribbons * film->nodes / film->members;
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_below(zp_result_get(result, "energy_error"), 2e-7); /* 5.5e-8 measured */
  ck_assert_double_eq(zp_result_get(result, "zip_time_s"), zp_result_get(result, "member_1_zip_time_s"));
  for (size_t row = 0; row < result->series->rows; row++) {
    double upper = zp_table_get(result->series, row, "member_1_opening_m");
    double lower = zp_table_get(result->series, row, "member_2_opening_m");
    ck_assert_double_eq_tol(upper + lower, 20e-3, 1e-15); /* 3.5e-18 measured */
    ck_assert_double_eq(zp_table_get(result->series, row, "opening_m"), upper);
  }
  for (size_t frame = 0; frame < film->frames; frame++) {
    ZpShape shape = zp_shapes_get(film, frame);
    ck_assert_double_eq_tol(shape.y[2 * count - 1], shape.y[count - 1], 1e-15); /* 1.7e-18 measured */
  }
}

/* Without weight either one closes in the same way, with the load and the other one behind it, and ends the run. */
TEST(either_one_may_close) {
  static const char *const name[] = {"member_1_zip_time_s", "member_2_zip_time_s"};
  double time[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def =
        DEF(BOTH, {"gravity", 0}, {"load.mass", 0.5e-3}, {"drive.voltage", k ? 2e3 : 10e3},
            {"stack.voltage_ratio", k ? 5 : 0.2}, {"solver.end_time", 2}, {"solver.stop_when_zipped", ZP_WHEN_TRUE});
    ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
    ck_assert_int_eq(result->outcome, ZP_ZIPPED);
    time[k] = zp_result_get(result, name[k]);
    ck_near(zp_result_get(result, "simulated_time_s"), time[k], 1e-12);
  }
  ck_near(time[1], time[0], 1e-12); /* 8.1e-14 measured */
}

/* Behind the damper of either one that closes are the load and the other's platform: both lose as much in the impact,
 * and are then as fast. */
TEST(either_one_hits_as_hard) {
  ZpActuatorDef upper = DEF(BOTH, {"gravity", 0}, {"load.mass", 5e-3}, {"drive.voltage", 10e3}, {"mesh.nodes", 11},
                            {"stack.voltage_ratio", 0.2}, {"solver.stop_when_zipped", ZP_WHEN_FALSE},
                            {"solver.tolerance", 1e-3}, {"solver.end_time", 0.1}),
                lower = upper;
  lower.drive.voltage = 2e3;
  lower.stack.voltage_ratio = 5;
  double lost = last_of(ZP_STUDY_ACTUATE, &upper, "contact_loss_J");
  ck_assert_double_gt(lost, 0);
  ck_near(last_of(ZP_STUDY_ACTUATE, &lower, "contact_loss_J"), lost, 2e-11); /* 2.1e-12 measured */
}

/* -- what is refused ------------------------------------------------------------------------------- */

TEST(what_antagonists_lack_is_said) {
  static const struct {
    Setting set[3];
    ZpStudy study;
    const char *says;
  } refused[] = {
      {{{"stack.distance", 0.02}, {"mesh.nodes", 21}}, ZP_STUDY_STATIONARY, "requires stack.series 2"},
      {{{"stack.lower_voltage", 1e3}, {"mesh.nodes", 21}}, ZP_STUDY_STATIONARY, "requires stack.distance"},
      {{{"stack.voltage_ratio", 0.5}, {"mesh.nodes", 21}}, ZP_STUDY_STATIONARY, "requires stack.distance"},
      {{{"stack.series", 2}, {"stack.distance", 0.2}}, ZP_STUDY_STATIONARY, "span at most"},
      {{{"stack.series", 2}, {"stack.distance", 0.02}, {"isometric.separation", 0.02}},
       ZP_STUDY_ISOMETRIC,
       "below stack.distance"},
      {{{"stack.series", 2}, {"stack.distance", 0.1}, {"isometric.separation", 11e-3}},
       ZP_STUDY_ISOMETRIC,
       "member 2 of the stack: isometric.separation = 0.089 m: out of reach"},
      {{{"stack.series", 2}, {"stack.distance", 0.02}, {"stack.link_mass", 1e-3}}, ZP_STUDY_ACTUATE, "load.mass"},
      {{{"stack.series", 2}, {"stack.distance", 0.02}, {"initial.state", ZP_INITIAL_STRAIGHT}},
       ZP_STUDY_ACTUATE,
       "initial.state equilibrium or checkpoint"},
      {{{"stack.series", 2}, {"stack.distance", 0.02}, {"load.stiffness", 1}}, ZP_STUDY_ACTUATE, "load"},
      {{{"stack.series", 2}, {"stack.distance", 0.02}, {"ribbon.model", ZP_RIBBON_MASS_SPRING}},
       ZP_STUDY_ACTUATE,
       "rod"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    size_t count = refused[k].set[2].key ? 3 : 2;
    ZpActuatorDef def = def_with(refused[k].set, count);
    ck_refused_by(refused[k].study, &def, refused[k].says);
  }
  ZpActuatorDef both = DEF(BOTH, {"stack.lower_voltage", 1e3}, {"stack.voltage_ratio", 0.5});
  ck_refused_by(ZP_STUDY_ACTUATE, &both, "not both");
  ZpActuatorDef far =
      DEF({"stack.series", 2}, {"stack.distance", 0.1}, {"isometric.separation", 12e-3}, {"mesh.nodes", 21});
  ck_ok(zp_study_check(ZP_STUDY_ISOMETRIC, &far, &err)); /* the lower one opens by 88 mm, of 88.2 */
}
