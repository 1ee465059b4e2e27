/* A reed against closed forms. In the library: tests/test_reed.c, which the build finds by its name. */
#include "check_util.h"

#include "run/run.h"

#define REED                                                                                                           \
  {"actuator.kind", ZP_KIND_REED}, {"ribbon.plane", ZP_PLANE_STRESS}, {                                                \
    "mesh.nodes", 41                                                                                                   \
  }

/* Stiffness of the free end of a clamped strip without insulator, 3 E I / L^3, N/m. */
static double of_the_end(const ZpActuatorDef *def) {
  const double h = def->ribbon.thickness, L = def->ribbon.length;
  return 0.25 * def->ribbon.young_modulus * def->ribbon.width * h * h * h / (L * L * L);
}

/* Weights m g at the end and q L along the strip sink it by (m g + 3/8 q L) / (k + 3 E I / L^3). */
TESTS(end_sinks_by_its_weights, 0, 3) {
  static const double k[] = {0, 0.5, 50}, m = 20e-6;
  ZpActuatorDef def = DEF(REED, {"drive.voltage", 0}, {"load.mass", m}, {"reed.stiffness", k[_i]});
  const double strip = def.ribbon.density * def.ribbon.length * def.ribbon.width * def.ribbon.thickness;
  const double expected = def.gravity * (m + 0.375 * strip) / (k[_i] + of_the_end(&def));
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "stroke_m"), expected, 7e-6); /* 2.5e-6 measured */
}

/* A heavy end swings at the root of (k + 3 E I / L^3) / m. */
TEST(heavy_end_swings) {
  ZpActuatorDef def = DEF(REED, {"drive.voltage", 0}, {"gravity", 0}, {"load.mass", 10e-3}, {"reed.stiffness", 5});
  const double strip = def.ribbon.density * def.ribbon.length * def.ribbon.width * def.ribbon.thickness;
  const double expected = sqrt((5 + of_the_end(&def)) / (10e-3 + 33.0 / 140 * strip)) / (2 * 3.14159265358979);
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), expected, 1.5e-7); /* 5e-8 measured */
}

/* It closes and opens again, and no energy appears or vanishes. */
TEST(energy_is_kept) {
  ZpActuatorDef def =
      DEF(REED, {"reed.stiffness", 5}, {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 100});
  ZpSim *sim = sim_of(model_of(&def));
  double most = 0;
  for (int k = 1; k <= 20; k++) {
    ck_assert(zp_outcome_good(zp_sim_run(sim, 1e-3 * k, false, NULL, NULL)));
    most = fmax(most, fabs(zp_sim_get(sim, "energy_imbalance")));
  }
  ck_assert_double_gt(zp_sim_get(sim, "contact_loss"), 0);
  ck_below(most / zp_sim_get(sim, "electric_work"), 1.1e-9); /* 3.9e-10 measured */
}

TEST(springs_without_effect_are_refused) {
  ZpActuatorDef flange = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"reed.stiffness", 1});
  ZpActuatorDef clamped = DEF(REED, {"actuator.right_end", ZP_END_CLAMPED}, {"reed.stiffness", 1});
  ck_refused_by(ZP_STUDY_STATIONARY, &flange, "the other kinds have no return spring");
  ck_refused_by(ZP_STUDY_STATIONARY, &clamped, "a clamped end moves no spring");
}
