/* A platform that may turn under a load off its centre, section 19 of docs/theory.md: the tilt of a small load in
 * closed form, mirror images, what a load in the middle does, energy in motion under voltage, and what is refused. */
#include "check_util.h"

static ZpActuatorDef turning(int nodes, double offset) {
  return DEF(TURNS, {"mesh.nodes", nodes}, {"load.offset", offset});
}

static double angle_of(ZpActuatorDef def) {
  return answered_value(ZP_STUDY_STATIONARY, &def, "angle_rad");
}

/* Eq. (19.5). */
static double small_tilt(const ZpActuatorDef *def) {
  double b = def->ribbon.thickness, nu = def->ribbon.poisson_ratio, a = def->platform.length;
  double EI = def->ribbon.young_modulus * def->ribbon.width * b * b * b / 12 / (1 - nu * nu);
  double L = 0.5 * (def->ribbon.length - a), stiffness = EI / (L * L * L) * (5 * L * L + 6 * L * a + 3 * a * a);
  return -(def->load.mass * def->gravity + def->load.force) * def->load.offset / stiffness;
}

/* Small weight, small deflections: second order in the element length, for any length of the platform. */
TESTS(small_tilt_is_that_of_its_closed_form, 0, 3) {
  static const double lengths[] = {2e-3, 10e-3, 40e-3};
  double off[3];
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = turning(10 * (1 << k) + 1, 0.4 * lengths[_i]);
    def.platform.length = lengths[_i];
    def.gravity = 1e-4, def.load.force = 2e-7;
    off[k] = angle_of(def) / small_tilt(&def) - 1;
  }
  ck_below(fabs(off[2]), 4e-4);      /* 3.6e-4 measured */
  ck_near(off[0] / off[1], 4, 2e-3); /* 6.4e-4 measured */
  ck_near(off[1] / off[2], 4, 2e-3); /* 4.7e-4 measured */
}

/* Eq. (19.6): opening and angle under a load in the middle, the left clip held. */
TESTS(small_load_beside_a_held_clip_is_as_its_closed_form, 0, 2) {
  double off[3], turned[3];
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = turning(10 * (1 << k) + 1, _i ? 2e-3 : 0);
    def.actuator.held_clip = ZP_HELD_LEFT;
    def.gravity = 0, def.load.force = 1e-6;
    double b = def.ribbon.thickness, nu = def.ribbon.poisson_ratio, a = def.platform.length;
    double EI = def.ribbon.young_modulus * def.ribbon.width * b * b * b / 12 / (1 - nu * nu);
    double L = 0.5 * (def.ribbon.length - a), W = def.load.force, e = def.load.offset;
    double k11 = 18, k12 = -3 * (a + L), k22 = 4.5 * a * a + 9 * L * a + 6.5 * L * L, unit = W * L * L * L / EI;
    double opening = unit * (k22 - k12 * e) / (k11 * k22 - k12 * k12);
    double angle = unit * (k12 - k11 * e) / (k11 * k22 - k12 * k12);
    off[k] = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m") / opening - 1;
    turned[k] = angle_of(def) / angle - 1;
  }
  ck_below(fabs(off[2]), 6e-4);    /* 4.3e-4 measured */
  ck_below(fabs(turned[2]), 6e-4); /* 6.1e-5 measured */
  ck_near(off[1] / off[2], 4, 5e-3);
  ck_near(turned[1] / turned[2], 4, 2e-2); /* of angles whose error is below 1e-4 */
}

/* A spring or a stop acts on the middle of the platform: with the stiffness K of the ribbons the opening is (F + k r) /
 * (K + k), eq. (27.3) or (27.5), and the load off the centre turns the platform as without it. */
TESTS(spring_acts_on_the_middle, 0, 2) {
  static const double stiff = 0.05, rest = 2e-6, load = 1e-6;
  ZpActuatorDef plain = turning(11, 3e-3);
  plain.gravity = 0, plain.load.force = load;
  ZpActuatorDef def = plain;
  if (_i)
    def.load.stop_stiffness = stiff, def.load.stop_opening = 0;
  else
    def.load.stiffness = stiff, def.load.rest_opening = rest;
  double own = load / answered_value(ZP_STUDY_STATIONARY, &plain, "opening_m");
  double opening = (load + (_i ? 0 : stiff * rest)) / (own + stiff);
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), opening, 7e-11); /* 2.3e-11 measured */
  ck_near(angle_of(def), angle_of(plain), 5.4e-9);                                 /* 1.8e-9 measured */
  def.load.offset = plain.load.offset = 0; /* the second mode is then that of the angle */
  double tilts = answered_value(ZP_STUDY_MODES, &plain, "frequency_2_Hz");
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_2_Hz"), tilts, 1e-9); /* 3.3e-10 measured */
}

/* One node of the one and its image of the other, right clip to left clip. */
static void check_mirrored(const ZpTable *one, const ZpTable *other, double width) {
  for (size_t i = 0; i < one->rows; i++) {
    size_t image = one->rows - 1 - i;
    double straight = zp_table_get(one, i, "y_m") - zp_table_get(other, image, "y_m"),
           sideways = zp_table_get(one, i, "x_m") + zp_table_get(other, image, "x_m") - width;
    ck_below(fabs(straight), 1e-14);
    ck_below(fabs(sideways), 1e-14);
  }
}

/* With the load on the other side, or in the middle, or the other clip held, the state is the mirror image. */
TESTS(offset_on_the_other_side_is_a_mirror_image, 0, 3) {
  double offset = _i == 1 ? 3e-3 : 0;
  ZpActuatorDef right = turning(21, offset), left = turning(21, -offset);
  if (_i == 2) right.actuator.held_clip = ZP_HELD_LEFT, left.actuator.held_clip = ZP_HELD_RIGHT;
  ZpResult *one = study_of(ZP_STUDY_STATIONARY, &right), *other = study_of(ZP_STUDY_STATIONARY, &left);
  check_mirrored(one->series, other->series, right.ribbon.length);
  if (_i) ck_below(zp_result_get(one, "angle_rad"), -0.02);
  ck_near(zp_result_get(one, "opening_m"), zp_result_get(other, "opening_m"), 1e-13);
}

/* Both ends of the platform count for whether it is closed: limits do not depend on the side of the load. */
TEST(limits_of_a_mirrored_load_are_equal) {
  static const char *const limits[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "max_load_kg"};
  ZpActuatorDef right = turning(21, 3.22e-3);
  right.drive.voltage = 2600, right.load.mass = 6.92e-3, right.ribbon.thickness = 95e-6;
  right.ribbon.length = 86.5e-3, right.insulator.thickness = 107e-6;
  ZpActuatorDef left = right;
  left.load.offset *= -1;
  ZpResult *one = study_of(ZP_STUDY_LIMITS, &right), *other = study_of(ZP_STUDY_LIMITS, &left);
  for (size_t k = 0; k < LENGTH_OF(limits); k++)
    ck_near(zp_result_get(one, limits[k]), zp_result_get(other, limits[k]), 1e-13); /* 2.0e-14 measured */
}

/* Under a load in the middle it hangs like a guided platform, up to the second order of its joints; strips that curl or
 * yield, too. */
TESTS(load_in_the_middle_does_not_tilt, 0, 3) {
  static const double first[] = {5e-3, 5e-3, 6e-2}, next[] = {2e-4, 4e-3, 4e-2};
  double off[3];
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = turning(10 * (1 << k) + 1, 0);
    if (_i == 1) def.ribbon.plane = ZP_PLANE_ANTICLASTIC, def.ribbon.width = 30e-3;
    if (_i == 2) def.ribbon.plasticity = true, def.ribbon.yield_stress = 100e6, def.load.mass = 5e-3;
    double free_to_turn = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m");
    ck_below(fabs(angle_of(def)), 1e-11);
    def.platform.rotates = false;
    off[k] = free_to_turn / answered_value(ZP_STUDY_STATIONARY, &def, "opening_m") - 1;
  }
  ck_below(fabs(off[2]), 4e-4);
  ck_near(off[0] / off[1], 4, first[_i]); /* 2.5e-3, 2.6e-3, 3.1e-2 measured */
  ck_near(off[1] / off[2], 4, next[_i]);  /* 6.3e-5, 2.0e-3, 1.9e-2 measured */
}

/* On every mesh the platform keeps its length, except for the stretch of its ribbon, and the load its lever. */
TEST(platform_keeps_its_length) {
  ZpActuatorDef def = turning(21, 4e-3);
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  const ZpTable *t = result->series;
  double dx = zp_table_get(t, 21, "x_m") - zp_table_get(t, 20, "x_m"),
         dy = zp_table_get(t, 21, "y_m") - zp_table_get(t, 20, "y_m");
  ck_near(sqrt(dx * dx + dy * dy), def.platform.length, 2e-8); /* 9.6e-9 measured */
  ck_near(atan2(dy, dx), zp_result_get(result, "angle_rad"), 1e-12);
}

/* Largest imbalance of a run over the largest kinetic energy. */
static double imbalance_of(const ZpActuatorDef *def) {
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, def);
  double imbalance = 0, kinetic = 0;
  for (size_t row = 0; row < result->series->rows; row++) {
    imbalance = fmax(imbalance, fabs(zp_table_get(result->series, row, "energy_imbalance_J")));
    kinetic = fmax(kinetic, zp_table_get(result->series, row, "kinetic_energy_J"));
  }
  return imbalance / kinetic;
}

/* The platform falls, turns and moves sideways; under voltage one half zips before the other. */
TESTS(energy_balances, 0, 4) {
  ZpActuatorDef def[] = {
      DEF(TURNS, {"mesh.nodes", 21}, {"load.offset", 2e-3}, {"drive.voltage", 0}, {"damping.internal", 0},
          {"initial.state", ZP_INITIAL_STRAIGHT}, {"solver.end_time", 0.1}),
      DEF(TURNS, {"mesh.nodes", 21}, {"load.offset", 2e-3}, {"mount.tilt", 0.5}, {"solver.end_time", 0.05}),
      DEF(TURNS, {"mesh.nodes", 21}, {"load.offset", 2e-3}, {"electro.edges", 1}, {"drive.voltage", 8e3}),
      DEF(TURNS, {"mesh.nodes", 21}, {"actuator.held_clip", ZP_HELD_LEFT}, {"drive.voltage", 8e3}),
  };
  def[_i].solver.tolerance = 1e-4;
  def[_i].solver.stop_when_zipped = ZP_WHEN_TRUE; /* later rounding of its impacts adds up */
  ck_below(imbalance_of(&def[_i]), 1e-9);         /* 7.8e-10 measured */
}

/* An equilibrium stays at rest in motion: both have the same laws. */
TEST(rest_stays_at_rest) {
  ZpActuatorDef def = DEF(TURNS, {"mesh.nodes", 21}, {"load.offset", 2e-3}, {"drive.voltage", 0});
  ZpSim *sim = sim_of(model_of(&def));
  ZpRunInfo info;
  ck_assert_int_eq(zp_sim_run(sim, 0.02, false, NULL, &info), ZP_REACHED_END);
  ck_near(zp_sim_get(sim, "angle"), angle_of(def), 1e-12); /* 1.3e-13 measured */
  ck_below(zp_sim_get(sim, "kinetic_energy"), 1e-24);
}

/* Massless ribbons whose platform rotates and swings on the masses at its ends: eqs. (19.4) and (19.5). */
TEST(frequency_of_the_tilt) {
  static const double half_turn = 3.14159265358979323846;
  ZpActuatorDef def = DEF(TURNS, {"mesh.nodes", 81}, {"ribbon.density", 1}, {"gravity", 0});
  ZpActuatorDef weighed = def;
  weighed.gravity = 1, weighed.load.offset = 1e-3;
  double a = def.platform.length, stiffness = -def.load.mass * 1e-3 / small_tilt(&weighed);
  double expected = sqrt(stiffness / (def.load.mass * a * a / 4)) / (2 * half_turn), nearest = INFINITY;
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  for (size_t k = 0; k < 4; k++)
    nearest = fmin(nearest, fabs(zp_table_get(result->series, k, "frequency_Hz") / expected - 1));
  ck_below(nearest, 2e-4); /* 7.7e-5 measured */
}

/* -- what is refused ---------------------------------------------------------------------------------- */

TEST(what_takes_the_platform_as_level_is_refused) {
  static const struct {
    Setting setting;
    const char *words;
  } refused[] = {
      {{"actuator.symmetry", ZP_SYMMETRY_HALF}, "platform.rotates = true: requires actuator.symmetry none"},
      {{"platform.length", 0}, "platform.rotates = true: requires platform.length above 0 m"},
      {{"platform.electrode", 1}, "platform.rotates = true: requires platform.electrode false"},
      {{"liquid.model", ZP_LIQUID_SUBMERGED},
       "requires liquid.model none, but it is submerged; the liquid between the platforms is modelled for level ones "
       "only"},
      {{"load.offset", 5.1e-3}, "load.offset = 0.0051 m: outside the platform; allowed are -0.005 to 0.005 m"},
      {{"platform.rotates", 0}, "load.offset = 0.001 m: requires platform.rotates true"},
  };
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF(TURNS, {"mesh.nodes", 21}, {"load.offset", 1e-3}, refused[k].setting);
    ck_refused(&def, refused[k].words);
  }
  ZpActuatorDef fixed = DEF({"actuator.symmetry", ZP_SYMMETRY_NONE}, {"actuator.held_clip", ZP_HELD_RIGHT});
  ck_refused(&fixed, "actuator.held_clip = right: requires platform.rotates true");
  ZpActuatorDef def = turning(21, 0);
  def.load.change_mass = 1e-3, def.load.change_time = 1e-3;
  ck_refused_by(ZP_STUDY_ACTUATE, &def, "platform.rotates = true: motion requires load.change_mass 0 kg");
  ZpActuatorDef held = turning(21, 0);
  ck_refused_by(ZP_STUDY_ISOMETRIC, &held, "platform.rotates = true: study isometric requires false");
}
