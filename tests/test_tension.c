/* Strips that are clamped with a tension: section 39 of docs/theory.md. */
#include "check_util.h"

#include "math/elementary.h"

/* -- vibration -------------------------------------------------------------------------------------- */

static ZpActuatorDef string_of(double tension) {
  return DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_CLAMPED}, {"ribbon.tension", tension},
             {"gravity", 0}, {"load.mass", 0}, {"modes.count", 3}, {"mesh.nodes", 201});
}

static double bending_of(const ZpActuatorDef *def) {
  double b = def->ribbon.thickness, nu = def->ribbon.poisson_ratio;
  return def->ribbon.young_modulus * def->ribbon.width * b * b * b / 12 / (1 - nu * nu);
}

/* Eq. (39.4), which is 0 at the frequencies of a clamped beam under tension: s is T L^2 / (2 EI), Omega the angular
 * frequency times L^2 sqrt(mu / EI). */
static double characteristic(double s, double Omega) {
  double root = sqrt(s * s + Omega * Omega), a = sqrt(root + s), b = sqrt(root - s);
  return 2 * a * b * (1 / cosh(a) - cos(b)) + 2 * s * tanh(a) * sin(b);
}

/* The k-th root from 0 on. */
static double root_of(double s, int k) {
  double step = 0.02, Omega = step;
  for (int found = 0;; Omega += step) {
    if ((characteristic(s, Omega) > 0) == (characteristic(s, Omega + step) > 0)) continue;
    if (++found == k) break;
  }
  for (int i = 0; i < 60; i++) {
    step *= 0.5;
    if ((characteristic(s, Omega) > 0) == (characteristic(s, Omega + step) > 0)) Omega += step;
  }
  return Omega;
}

static const double tensions[] = {0, 1e-3, 0.01, 0.1, 1, 10};

TESTS(frequencies_are_those_of_a_beam_under_tension, 0, LENGTH_OF(tensions)) {
  ZpActuatorDef def = string_of(tensions[_i]);
  double EI = bending_of(&def), L = def.ribbon.length, s = tensions[_i] * L * L / (2 * EI);
  double mu = def.ribbon.density * def.ribbon.width * def.ribbon.thickness,
         unit = sqrt(EI / mu) / (L * L) / (2 * zp_pi);
  ZpResult *result = answer_of(ZP_STUDY_MODES, &def);
  ck_near(zp_result_get(result, "frequency_1_Hz"), unit * root_of(s, 1), 1.5e-4);
  ck_near(zp_result_get(result, "frequency_2_Hz"), unit * root_of(s, 2), 2.8e-4);
  ck_near(zp_result_get(result, "frequency_3_Hz"), unit * root_of(s, 3), 6e-4);
}

/* A string, whose frequencies are multiples of sqrt(T / mu) / (2 L): the ends that bend shorten it by sqrt(EI / T). */
TEST(great_tension_makes_a_string) {
  ZpActuatorDef def = string_of(50);
  double EI = bending_of(&def), mu = def.ribbon.density * def.ribbon.width * def.ribbon.thickness;
  double free = def.ribbon.length - 2 * sqrt(EI / def.ribbon.tension);
  ZpResult *result = answer_of(ZP_STUDY_MODES, &def);
  for (int k = 1; k <= 3; k++) {
    char name[] = "frequency_#_Hz";
    *strchr(name, '#') = (char)('0' + k);
    ck_near(zp_result_get(result, name), k * sqrt(def.ribbon.tension / mu) / (2 * free), 7e-3);
  }
}

TEST(frequency_changes_with_tension_as_differences_say) {
  ZpActuatorDef def = string_of(0.1), more = string_of(0.1001), less = string_of(0.0999);
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("sensitivity.by"), "ribbon.tension", NULL), ZP_OK);
  double difference =
      answered_value(ZP_STUDY_MODES, &more, "frequency_1_Hz") - answered_value(ZP_STUDY_MODES, &less, "frequency_1_Hz");
  ck_near(slope_in(answer_of(ZP_STUDY_MODES, &def), "frequency_1_Hz", "ribbon.tension"), difference / 2e-4, 2e-6);
}

/* -- pull-in ---------------------------------------------------------------------------------------- */

/* A beam 100 um long, 20 um wide and 2 um thick, 4 um below its electrode, a hundredfold in size, so that its voltages
 * are a hundredfold. `slender`: its thickness, its gap and the root of its stress are a tenth, which leaves the form of
 * its equation as it is, and its slopes small: voltages are then a thousandth. */
static ZpActuatorDef beam(double stress, bool slender) {
  double part = slender ? 0.1 : 1, b = 200e-6 * part, w = 2e-3;
  return DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_CLAMPED}, {"ribbon.length", 10e-3},
             {"ribbon.width", w}, {"ribbon.thickness", b}, {"ribbon.young_modulus", 169e9},
             {"ribbon.poisson_ratio", 0.066}, {"ribbon.plane", ZP_PLANE_STRESS}, {"ribbon.density", 2330},
             {"ribbon.tension", stress * part * part * b * w}, {"insulator.thickness", 0},
             {"electro.gap_offset", 400e-6 * part}, {"electro.breakdown_cap", false}, {"medium.permittivity", 1},
             {"gravity", 0}, {"load.mass", 0}, {"mesh.nodes", 161}, {"drive.voltage", slender ? 300 : 300e3});
}

static double pull_in_of(const ZpActuatorDef *def) {
  return answered_value(ZP_STUDY_LIMITS, def, "pull_in_voltage_V");
}

/* The strip has other forces by its tension as soon as it bends, and its modulus does not change that tension. */
TESTS(pull_in_changes_as_differences_say, 0, 2) {
  static const char *const keys[] = {"ribbon.tension", "ribbon.young_modulus"};
  ZpActuatorDef def = beam(100e6, true);
  const int key = zp_key_find(keys[_i]);
  const double value = zp_def_get(&def, key), by = 1e-4 * value;
  def.mesh.nodes = 41;
  ck_ok(zp_def_set_text(&def, zp_key_find("sensitivity.by"), keys[_i], &err));
  const double slope = slope_in(answer_of(ZP_STUDY_LIMITS, &def), "pull_in_voltage_V", keys[_i]);
  double pull_in[2];
  def.sensitivity.by[0] = 0;
  for (int k = 0; k < 2; k++) {
    ck_ok(zp_def_set(&def, key, value + (k ? -by : by), &err));
    pull_in[k] = pull_in_of(&def);
  }
  ck_near(slope, (pull_in[0] - pull_in[1]) / (2 * by), 3.4e-7); /* 1.2e-7 measured */
}

/* Numbers of the plates law without edges, for small slopes. Without stretching: the right half moves along freely. */
TEST(clamped_beam_pulls_in_where_it_should) {
  ZpActuatorDef loose = beam(0, true), stretched = beam(0, true), tense = beam(100e6, true);
  loose.ribbon.length *= 0.5, loose.actuator.right_end = ZP_END_GUIDED;
  ck_near(pull_in_of(&loose) * 10, 1068.5, 6e-5);
  ck_near(pull_in_of(&stretched) * 10, 1370.5, 4.8e-4);
  ck_near(pull_in_of(&tense) * 10, 1519.5, 2.6e-4);
}

/* As thick as it is, its slopes count: by a thousandth. */
TEST(thick_beam_pulls_in_where_it_should) {
  ZpActuatorDef stretched = beam(0, false), tense = beam(100e6, false);
  ck_near(pull_in_of(&stretched) / 100, 1370, 2e-3);
  ck_near(pull_in_of(&tense) / 100, 1519.5, 2e-3);
}

/* -- refused ---------------------------------------------------------------------------------------- */

TEST(tension_needs_two_clamps) {
  ZpActuatorDef def = string_of(1), pair = DEF({"mesh.nodes", 21}), springs = string_of(1), strong = string_of(1);
  def.actuator.right_end = ZP_END_GUIDED;
  ck_refused(&def, "an end that moves does not hold the tension of the strip");
  pair.ribbon.tension = 1;
  ck_refused(&pair, "ribbon.tension = 1 N: requires actuator.kind ribbon, flange or curved");
  springs.ribbon.model = ZP_RIBBON_MASS_SPRING;
  ck_refused(&springs, "ribbon.model rod");
  strong.ribbon.thickness = 10e-6, strong.ribbon.tension = 1e4;
  ck_refused(&strong, "which stretch the strip by 10 %");
}
