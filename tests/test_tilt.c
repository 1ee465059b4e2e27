/* Gravity at an angle and a constant force: closed forms at rest, mirror images, buckling under a strip's own weight,
 * energy in motion; section 27 of docs/theory.md. */
#include "state_util.h"

static const double half_turn = 3.14159265358979323846;

/* Of the last frame: the y of node `station` of the lower ribbon, and its x; of a half or whole actuator or a ribbon.
 */
static double place_of(const ZpActuatorDef *def, const char *column, bool last) {
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, def);
  return zp_table_get(result->series, last ? result->series->rows - 1 : 0, column);
}

/* A ribbon upside down is its mirror image. */
TESTS(upside_down_is_a_mirror_image, 0, 3) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", _i}, {"load.mass", 2e-3},
                          {"ribbon.length", 0.05}, {"mesh.nodes", 21});
  double up, down = place_of(&def, "y_m", true);
  ZpStudy modes = ZP_STUDY_MODES;
  double frequency = answered_value(modes, &def, "frequency_1_Hz");
  def.mount.tilt = half_turn;
  up = place_of(&def, "y_m", true);
  ck_below(fabs(up + down), 1e-12 * 0.05); /* 2.8e-14 measured */
  /* what solver.tolerance leaves; 2e-9 measured */
  ck_near(answered_value(modes, &def, "frequency_1_Hz"), frequency, 1e-8);
}

/* Gravity along a hanging strip: its end moves by weight and load over the axial stiffness. */
TEST(gravity_along_a_strip_stretches_it) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 1},
                          {"ribbon.plane", ZP_PLANE_STRESS}, {"mount.tilt", 0.5 * half_turn}, {"mesh.nodes", 21});
  ZpActuatorDef straight = def;
  straight.gravity = 0;
  double L = def.ribbon.length, area = def.ribbon.width * def.ribbon.thickness, EA = def.ribbon.young_modulus * area;
  double weight = def.ribbon.density * area * L * def.gravity, load = def.load.mass * def.gravity;
  double moved = place_of(&def, "x_m", true) - place_of(&straight, "x_m", true);
  ck_near(moved, (load + 0.5 * weight) * L / EA, 3e-11); /* 4.5e-12 measured */
  def.mount.tilt = -0.5 * half_turn, def.load.mass = 0;
  def.ribbon.length = 0.02;
  ck_below(fabs(place_of(&def, "y_m", true)), 1e-12);
}

/* Greenhill: a strip upright on its clamp buckles under its own weight at m g L^3 = 7.8373 E I, where its frequency is
 * 0; the squared frequency falls nearly linearly before. */
TEST(standing_strip_buckles) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 0},
                          {"mount.tilt", -0.5 * half_turn}, {"mesh.nodes", 61}, {"output.errors", false});
  double b = def.ribbon.thickness, nu = def.ribbon.poisson_ratio, L = def.ribbon.length;
  double EI = def.ribbon.young_modulus * def.ribbon.width * b * b * b / 12 / (1 - nu * nu);
  double critical = 7.8373 * EI / (def.ribbon.density * def.ribbon.width * b * L * L * L), f2[2];
  static const double part[] = {0.98, 0.99};
  for (int k = 0; k < 2; k++) {
    def.gravity = part[k] * critical;
    double f = answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz");
    f2[k] = f * f;
  }
  ck_near(part[1] + (part[1] - part[0]) * f2[1] / (f2[0] - f2[1]), 1, 1e-3); /* 1.3e-4 measured */
  def.gravity = 1.01 * critical;
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  double f = zp_result_get(result, "frequency_1_Hz");
  ck_assert_msg(!(f * f > 0 && f * f < f2[0]) || !zp_outcome_good(result->outcome), "%g Hz beyond buckling", f);
}

/* Weightless ribbons upside down under a force of twice the load's weight open as they do under the load. */
TESTS(force_outweighs_the_load, 0, 2) {
  ZpActuatorDef def = DEF({"ribbon.density", 0}, {"drive.voltage", 0}, {"mesh.nodes", 31},
                          {"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF});
  double opening = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m");
  def.mount.tilt = half_turn;
  def.load.force = 2 * def.load.mass * def.gravity;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), opening, 1e-12);
  def.mount.tilt = 0;
  def.load.mass = 0, def.load.force *= 0.5;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), opening, 1e-12);
}

/* Only the vertical component of the load opens weightless ribbons, and limits what they can lift. */
TEST(guide_takes_what_is_not_vertical) {
  ZpActuatorDef def = DEF({"ribbon.density", 0}, {"mesh.nodes", 21}, {"actuator.symmetry", ZP_SYMMETRY_NONE},
                          {"liquid.model", ZP_LIQUID_NONE}, {"output.errors", false});
  double most = answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg");
  double opening = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m");
  def.mount.tilt = half_turn / 3;
  def.load.mass *= 2;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), opening, 1e-12);
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg"), 2 * most, 1e-12); /* 4.4e-16 measured */
  def.mount.tilt = 0.5 * half_turn;
  ck_assert(isnan(answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg")));
  def.mount.tilt = 0.7 * half_turn; /* the mass falls towards the upper platform, the force opens */
  def.load.force = def.load.mass * def.gravity;
  ZpResult *falls = answer_of(ZP_STUDY_LIMITS, &def);
  ck_assert(isnan(zp_result_get(falls, "max_load_kg")));
  ck_assert_msg(strstr(falls->message, "a mass is no load") || note_of(falls, "a mass is no load"), "%s",
                falls->message);
}

/* A whole actuator tilted left is the mirror image of one tilted right; upside down it equals its half. */
TEST(leaning_left_mirrors_leaning_right) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"ribbon.thickness", 20e-6},
                          {"mount.tilt", half_turn / 4}, {"drive.voltage", 0}, {"output.errors", false});
  ZpActuatorDef other = def;
  other.mount.tilt = -def.mount.tilt;
  ZpResult *right = study_of(ZP_STUDY_STATIONARY, &def), *left = study_of(ZP_STUDY_STATIONARY, &other);
  size_t rows = right->series->rows;
  double leans = 0;
  ck_assert_uint_eq(rows, left->series->rows);
  for (size_t i = 0; i < rows; i++) {
    double here = zp_table_get(right->series, i, "y_m"), image = zp_table_get(left->series, rows - 1 - i, "y_m");
    ck_below(fabs(here - image), 1e-12); /* 6.9e-18 measured */
    leans = fmax(leans, fabs(here - zp_table_get(right->series, rows - 1 - i, "y_m")));
  }
  ck_assert_double_gt(leans, 1e-5);
  def.mount.tilt = half_turn, def.load.force = 0.2;
  other = def;
  other.actuator.symmetry = ZP_SYMMETRY_HALF;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"),
          answered_value(ZP_STUDY_STATIONARY, &other, "opening_m"), 1e-12);
}

/* Largest difference of an array from the mirror image of another, relative to the largest value. */
static double unlike_image(const double *a, const double *image, size_t n) {
  double apart = 0, most = 0;
  for (size_t i = 0; i < n; i++) {
    apart = fmax(apart, fabs(a[i] - image[n - 1 - i]));
    most = fmax(most, fabs(a[i]));
  }
  return apart / most;
}

/* In motion as well: gaps, attraction and field along the ribbons; the bead of one half is that of the other half of
 * the image. */
TESTS(motion_mirrors_with_beads_and_fields, 0, 2) {
  static const double volume[] = {50e-9, 16e-6}; /* to between the stations, to between the platforms */
  ZpActuatorDef def = DEF({"mesh.nodes", 11}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"ribbon.thickness", 30e-6},
                          {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", volume[_i]}, {"drive.voltage", 6e3});
  ZpModel *model[2];
  ZpSim *sim[2];
  ZpShape shape[2];
  for (int k = 0; k < 2; k++) {
    def.mount.tilt = (k ? -1 : 1) * half_turn / 4;
    model[k] = model_of(&def);
    sim[k] = sim_of(model[k]);
    ck_assert(zp_outcome_good(zp_sim_run(sim[k], 20e-3, false, NULL, NULL)));
    shape[k] = zp_sim_shape(sim[k]);
  }
  size_t n = model[0]->nodes;
  ck_below(unlike_image(shape[0].gap, shape[1].gap, n), 1e-12);
  ck_below(unlike_image(shape[0].line_force, shape[1].line_force, n), 1e-12);
  ck_below(unlike_image(shape[0].insulator_field, shape[1].insulator_field, n), 1e-12);
  const ZpBead *bead = sim[0]->state->bead, *image = sim[1]->state->bead;
  for (int half = 0; half < 2; half++)
    ck_near(bead[half].reach, image[1 - half].reach, 3e-12);
  ck_assert_double_gt(fabs(bead[1].reach / bead[0].reach - 1), 1e-4); /* the halves do not move alike */
  ck_assert_msg((bead[0].reach > model[0]->L) == (_i == 1) && bead[0].reach < model[0]->L + 0.5 * def.platform.length,
                "%g of %g", bead[0].reach, model[0]->L);
  for (int k = 0; k < 2; k++) {
  }
}

/* Behind a resistance the charge that the electrodes take in each step sets their voltage: with beads that reach unlike
 * far it is that of the mirror image as well. */
TEST(charging_mirrors_with_beads) {
  ZpActuatorDef def = DEF({"mesh.nodes", 11}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"ribbon.thickness", 30e-6},
                          {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", 20e-9}, {"drive.voltage", 6e3},
                          {"source.model", ZP_SOURCE_AMPLIFIER}, {"source.resistance", 1e8});
  static const char *const signals[] = {"voltage", "charge", "electric_work", "source_loss"};
  ZpModel *model[2];
  ZpSim *sim[2];
  for (int k = 0; k < 2; k++) {
    def.mount.tilt = (k ? -1 : 1) * half_turn / 4;
    model[k] = model_of(&def);
    sim[k] = sim_of(model[k]);
    ck_assert(zp_outcome_good(zp_sim_run(sim[k], 20e-3, false, NULL, NULL)));
  }
  const ZpBead *bead = sim[0]->state->bead;
  ck_assert_double_gt(fabs(bead[1].reach / bead[0].reach - 1), 1e-3);
  ck_same_signals(sim, model, signals, LENGTH_OF(signals), 1e-12);
}

/* The energy balances while a tilted actuator zips, opens and swings under weight and force, dry and in a bath. */
TESTS(energy_at_an_angle, 0, 2) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"mount.tilt", half_turn / 4},
                          {"load.force", 0.02}, {"liquid.model", _i ? ZP_LIQUID_SUBMERGED : ZP_LIQUID_NONE},
                          {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", _i ? 2 : 4},
                          {"solver.end_time", _i ? 0.4 : 0.2}, {"output.errors", false});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  ck_below(zp_result_get(result, "energy_error"), 5e-8); /* 1.1e-8 measured */
  double pull = def.load.force + def.load.mass * def.gravity * sqrt(0.5);
  double risen = zp_table_get(result->series, 0, "opening_m") - zp_result_get(result, "opening_m");
  ck_near(zp_result_get(result, "mechanical_work_J"), pull * risen, 1e-12); /* 0 measured */
}

/* Weight that presses the faces together: equal ribbons lie on each other from the platform to the clip. Each carries
 * itself, as one ribbon that is clamped there and guided at its end. The overlap of the faces parts them by less than
 * 1e-4 of their length. */
TESTS(ribbons_lie_on_each_other, 0, 4) {
  static const struct {
    double tilt, length, thickness, width, young_modulus, density, mass;
  } of[] = {{153, 130e-3, 15e-6, 3e-3, 4e9, 1390, 0.1e-3},
            {150, 150e-3, 30e-6, 12.7e-3, 200e9, 7850, 0.1},
            {95, 100e-3, 50e-6, 12.7e-3, 200e9, 7850, 8e-3},
            {-121.3, 142.5e-3, 33.6e-6, 5.74e-3, 120e9, 8960, 0.198}};
  ZpActuatorDef def = DEF({"actuator.symmetry", ZP_SYMMETRY_NONE}, {"mount.tilt", of[_i].tilt / 180 * half_turn},
                          {"ribbon.length", of[_i].length}, {"ribbon.thickness", of[_i].thickness},
                          {"ribbon.width", of[_i].width}, {"ribbon.young_modulus", of[_i].young_modulus},
                          {"ribbon.density", of[_i].density}, {"load.mass", of[_i].mass}, {"mesh.nodes", 31});
  ZpActuatorDef one = def;
  one.actuator.kind = ZP_KIND_RIBBON, one.actuator.right_end = ZP_END_GUIDED, one.actuator.symmetry = ZP_SYMMETRY_HALF;
  one.ribbon.length = 0.5 * (def.ribbon.length - def.platform.length), one.load.mass = 0;
  ZpResult *whole = answer_of(ZP_STUDY_STATIONARY, &def), *ribbon = answer_of(ZP_STUDY_STATIONARY, &one);
  size_t clip = whole->series->rows - 1, platform = whole->series->rows / 2, end = ribbon->series->rows - 1;
  static const char *const column[] = {"x_m", "y_m", "upper_x_m", "upper_y_m"};
  for (int k = 0; k < 4; k++) {
    double moved = zp_table_get(whole->series, clip, column[k]) - zp_table_get(whole->series, platform, column[k]);
    double expected = zp_table_get(ribbon->series, end, column[k % 2]) - zp_table_get(ribbon->series, 0, column[k % 2]);
    ck_below(fabs(moved - expected), 2e-5 * one.ribbon.length); /* 6.6e-6 measured */
  }
  ck_below(fabs(zp_result_get(whole, "opening_m")), 2e-6);
}

TEST(half_is_vertical) {
  ZpActuatorDef def = DEF({"mount.tilt", 0.1});
  ck_refused(&def, "requires actuator.symmetry none");
  def.mount.tilt = -half_turn;
  ck_assert_int_eq(zp_def_check(&def, NULL), ZP_OK);
}
