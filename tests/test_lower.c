/* Bowed ribbons, and a lower ribbon or insulator unlike the upper one, as the keys of segment_K and lower.* say.
 * tests/test_whole.c has unlike ribbons in motion. */
#include "check_util.h"

#include "def/check.h"
#include "rest/rest.h"

/* -- bowed ribbons ----------------------------------------------------------------------------------- */

/* Stiff ribbons of no weight without a load, so that nothing but their natural curvature opens them. */
#define BOWED                                                                                                          \
  {"ribbon.thickness", 500e-6}, {"segment_1.thickness", 500e-6}, {"gravity", 0}, {"load.mass", 0},                     \
      {"drive.voltage", 0}, {                                                                                          \
    "mesh.nodes", 61                                                                                                   \
  }

/* A strip held level at both ends, of natural curvature k over a length a from the clip, has the moment -k a / L of its
 * EI, so its other end rises by k a (L - a) / 2; the lower ribbon sinks by as much. Where curvature jumps by k the
 * corners of elements of length l lose k l^2 / 12, theory (8.8). (Both had the same sign once, and what they were bowed
 * by cancelled.) */
static double rises(const ZpActuatorDef *def, double k, double a) {
  double L = (def->ribbon.length - def->platform.length) / 2, l = L / (def->mesh.nodes - 1);
  return 0.5 * k * a * (L - a) - k * l * l / 12;
}

TESTS(bowed_ribbons_open, 0, 2) {
  static const double k = 0.2, a = 9e-3;
  ZpActuatorDef def = DEF(BOWED, {"segment_1.length", a}, {"segment_1.curvature", k});
  if (_i) def.actuator.symmetry = ZP_SYMMETRY_NONE;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), 2 * rises(&def, k, a), 1e-6); /* 1.7e-7 measured */
}

/* A bow in three segments, one after the other, is the same bow: of both ribbons, which are mirror images */
TEST(segments_follow_each_other) {
  static const double k = 0.2, a = 9e-3;
  ZpActuatorDef def = DEF(BOWED, {"segment_1.length", a / 3}, {"segment_1.curvature", k}, {"segment_2.length", a / 3},
                          {"segment_2.curvature", k}, {"segment_3.length", a / 3}, {"segment_3.curvature", k},
                          {"segment_2.thickness", 500e-6}, {"segment_3.thickness", 500e-6});
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), 2 * rises(&def, k, a), 1e-6); /* 1.7e-7 measured */
}

/* Each ribbon has its own curvature; a single curved one opens by half, and parallel ones do not part. (So little that
 * the clips need not pull the straight one.) */
TEST(each_ribbon_has_its_own_curvature) {
  static const double k = 0.02, a = 9e-3;
  ZpActuatorDef def = DEF(BOWED, {"segment_1.length", a}, {"segment_1.curvature", k}, {"lower.segment_1.curvature", 0});
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), rises(&def, k, a), 1e-4); /* 1.5e-5 measured */
  def.lower.segment_K[0].curvature = -k;
  ck_below(fabs(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m")), 1e-12); /* 2e-19 measured */
}

/* Without weight and load the order of two ribbons does not matter. */
TEST(ribbons_can_be_exchanged) {
  ZpActuatorDef def =
      DEF({"gravity", 0}, {"load.mass", 0}, {"mesh.nodes", 61}, {"segment_1.length", 9e-3}, {"segment_1.curvature", 20},
          {"ribbon.thickness", 70e-6}, {"segment_1.thickness", 70e-6}, {"lower.ribbon.thickness", 50e-6},
          {"lower.segment_1.thickness", 50e-6}, {"insulator.permittivity", 3}, {"lower.insulator.permittivity", 5});
  ZpActuatorDef room, other = *zp_def_lower(&def, &room);
  other.lower.ribbon.thickness = other.lower.segment_K[0].thickness = 70e-6;
  other.lower.insulator.permittivity = 3;
  ck_assert_double_eq(other.ribbon.thickness, 50e-6);
  static const char *const names[] = {"pull_in_voltage_V", "release_voltage_V"};
  for (size_t k = 0; k < LENGTH_OF(names); k++) {
    double value = answered_value(ZP_STUDY_LIMITS, &def, names[k]);
    ck_assert_double_gt(value, 0);
    ck_near(answered_value(ZP_STUDY_LIMITS, &other, names[k]), value, 5e-11); /* 9.8e-12 measured */
  }
}

/* -- insulators -------------------------------------------------------------------------------------- */

/* Two unequal insulators are in series: 100 and 160 um attract as twice 130 um do, and 130 um of permittivity 6 and 3
 * as of 4. */
TEST(insulators_lie_in_series) {
  ZpActuatorDef def = DEF({"insulator.permittivity", 4});
  double alike = answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V");
  def.insulator.thickness = 100e-6, def.lower.insulator.thickness = 160e-6;
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V"), alike, 1e-12);
  def.insulator.thickness = 130e-6, def.lower.insulator.thickness = NAN;
  def.insulator.permittivity = 6, def.lower.insulator.permittivity = 3;
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V"), alike, 1e-12);
}

/* In closed faces D is the same in both insulators: the one with the smaller strength times permittivity breaks down
 * first; a single layer may insulate both faces. */
TEST(weaker_insulator_breaks_down_first) {
  ZpActuatorDef def = DEF({"insulator.thickness", 100e-6}, {"insulator.permittivity", 3},
                          {"insulator.breakdown_field", 100e6}, {"lower.insulator.thickness", 200e-6},
                          {"lower.insulator.permittivity", 5}, {"lower.insulator.breakdown_field", 40e6});
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "allowed_voltage_V"), 40e6 * 5 * (100e-6 / 3 + 200e-6 / 5), 1e-12);
  /* 0 measured */
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "insulator_field_V_per_m"), 10e3 / 5 / (100e-6 / 3 + 200e-6 / 5),
          1e-12);
  def.lower.insulator.thickness = 0;
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "allowed_voltage_V"), 100e6 * 100e-6, 1e-12);
}

/* -- stress ------------------------------------------------------------------------------------------ */

/* The yield margin is that of the metal nearest to its yield stress, in whichever ribbon. */
TEST(yield_is_of_each_ribbon) {
  ZpActuatorDef def = DEF({"drive.voltage", 0});
  double stress = answered_value(ZP_STUDY_STATIONARY, &def, "max_stress_Pa");
  def.lower.ribbon.yield_stress = 0.2 * def.ribbon.yield_stress;
  double margin = answered_value(ZP_STUDY_STATIONARY, &def, "yield_margin");
  ck_below(margin, 0.25 * def.ribbon.yield_stress / stress);
  ck_near(margin * answered_value(ZP_STUDY_STATIONARY, &def, "max_stress_Pa"), 0.2 * def.ribbon.yield_stress, 1e-12);
}

/* -- what cannot be ---------------------------------------------------------------------------------- */

TEST(what_needs_like_ribbons_is_refused) {
  static const struct {
    Setting lower, asks;
    const char *says;
  } refused[] = {
      {{"lower.ribbon.thickness", 60e-6}, {"actuator.kind", ZP_KIND_FLANGE}, "actuator.kind electro_ribbon"},
      {{"lower.ribbon.density", 60}, {"ribbon.model", ZP_RIBBON_MASS_SPRING}, "ribbon.model rod"},
      {{"lower.ribbon.thickness", 60e-6}, {"electro.model", ZP_ELECTRO_FIELD}, "lower.ribbon.thickness auto"},
      {{"lower.insulator.thickness", 60e-6}, {"electro.edges", 1}, "lower.insulator.thickness auto"},
      {{"lower.insulator.permittivity", 2}, {"medium.resistivity", 1e12}, "lower.insulator.permittivity auto"},
      {{"lower.insulator.permittivity", 2}, {"electro.insulator_offset", 1e-4}, "electro.insulator_offset"},
      {{"lower.segment_2.length", 0.05}, {"mesh.nodes", 31}, "lower.segment_2.length: 0.05 m together"},
  };
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF(refused[k].lower, refused[k].asks);
    ck_refused(&def, refused[k].says);
  }
}
