/* The mass of what joins ribbons: clips and platforms; section 39 of docs/theory.md. */
#include "state_util.h"

#include "math/elementary.h"

/* Opened by a force, which has no mass, a little for the length of the ribbons and much for the range of contact. */
static ZpActuatorDef opened(double clip, double platform) {
  return DEF({"mesh.nodes", 41}, {"load.mass", 0}, {"load.force", 2e-3}, {"gravity", 0}, {"ribbon.density", 1e-3},
             {"clip.mass", clip}, {"platform.mass", platform}, {"drive.voltage", 0}, {"modes.count", 2});
}

/* Stiffness of a guided beam, which each ribbon of a half is, N/m. */
static double beam_of(const ZpActuatorDef *def) {
  double L = (def->ribbon.length - def->platform.length) / 2, b = def->ribbon.thickness, nu = def->ribbon.poisson_ratio;
  return def->ribbon.young_modulus * def->ribbon.width * b * b * b / (1 - nu * nu) / (L * L * L);
}

/* Both ribbons of a half end at the clip, so they shorten alike and are bent alike: as the clip moves by u, the
 * platform moves by 2 u. */
TEST(clip_and_platform_are_one_mass_on_two_beams) {
  ZpActuatorDef def = opened(3e-3, 5e-3);
  double mass = def.clip.mass + 4 * def.platform.mass / 2;
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), sqrt(2 * beam_of(&def) / mass) / (2 * zp_pi), 2e-3);
}

TEST(weights_open_both_beams) {
  ZpActuatorDef def = opened(0.1e-3, 0.2e-3);
  def.gravity = 9.81;
  def.ribbon.density = 0;
  double force = def.load.force / 2 + def.platform.mass / 2 * 9.81;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"), (2 * force + def.clip.mass * 9.81) / beam_of(&def),
          1e-3);
}

/* Without gravity a clip of a ton stays where it is while the actuator closes, and the platform meets its partner. */
TEST(heavy_clips_stay) {
  ZpActuatorDef def = opened(1e3, 0);
  def.ribbon.density = 7850;
  def.drive.voltage = 6e3;
  def.solver.end_time = 0.05;
  ZpSim *sim = sim_of(model_of(&def));
  run_to(sim, 0);
  double before = zp_state_motion(sim->model, sim->state).y[0], opening = zp_sim_get(sim, "opening");
  run_to(sim, def.solver.end_time);
  ck_below(fabs(zp_state_motion(sim->model, sim->state).y[0] - before), 1e-3 * opening);
  ck_below(fabs(zp_sim_get(sim, "energy_imbalance")), 1e-7 * zp_sim_get(sim, "electric_work"));
}

/* -- the lower platform is a load ------------------------------------------------------------------- */

enum { ALONE, TURNING, STACKED, SERIES, SYSTEMS };

/* With the mass m (kg) on each platform; or with as much as loads and links instead. */
static ZpActuatorDef weighed(int which, double m, bool as_loads) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"load.mass", as_loads ? 6e-3 + m : 6e-3},
                          {"platform.mass", as_loads ? 0 : m}, {"drive.voltage", 2e3}, {"modes.voltage", 1e3},
                          {"modes.count", 3}, {"clip.mass", 0.3e-3}, {"solver.end_time", 0.02});
  if (which == TURNING) def.actuator.symmetry = ZP_SYMMETRY_NONE, def.platform.rotates = true;
  if (which == TURNING) def.platform.electrode = false, def.actuator.held_clip = ZP_HELD_LEFT;
  if (which == STACKED) def.stack.parallel = 2, def.load.mass += as_loads ? m : 0;
  if (which == SERIES) def.stack.series = 3, def.stack.link_mass = as_loads ? 1e-3 + 2 * m : 1e-3;
  return def;
}

TESTS(lower_platform_is_a_load, 0, SYSTEMS) {
  static const double m = 1.7e-3;
  ZpActuatorDef own = weighed(_i, m, false), loads = weighed(_i, m, true);
  ck_near(answered_value(ZP_STUDY_STATIONARY, &own, "opening_m"),
          answered_value(ZP_STUDY_STATIONARY, &loads, "opening_m"), 1e-12);
  ZpResult *one = answer_of(ZP_STUDY_MODES, &own), *other = answer_of(ZP_STUDY_MODES, &loads);
  ck_near(zp_result_get(one, "frequency_1_Hz"), zp_result_get(other, "frequency_1_Hz"), 6e-9);
  ck_near(zp_result_get(one, "frequency_3_Hz"), zp_result_get(other, "frequency_3_Hz"), 5.4e-9);
  ck_near(settled_value(&own, "opening"), settled_value(&loads, "opening"), 1e-12);
  one = answer_of(ZP_STUDY_ACTUATE, &own), other = answer_of(ZP_STUDY_ACTUATE, &loads);
  ck_near(zp_result_get(one, "opening_m"), zp_result_get(other, "opening_m"), 1.8e-14);
  ck_near(zp_table_get(one->series, one->series->rows - 1, "kinetic_energy_J"),
          zp_table_get(other->series, other->series->rows - 1, "kinetic_energy_J"), 1e-9);
}

/* Clips and platforms are part of the actuator, which a load is not. */
TESTS(connections_are_mass_of_the_actuator, 0, 2) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF},
                          {"clip.mass", 1e-3}, {"platform.mass", 0.5e-3});
  double strips = 2 * 0.1 * 12.7e-3 * 50e-6 * 7850;
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "mass_kg"), strips + 2e-3 + 1e-3, 1e-12);
}

TEST(other_kinds_have_neither) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON});
  def.clip.mass = 1e-3;
  ck_refused(&def, "clip.mass = 0.001 kg: requires actuator.kind electro_ribbon");
  def.clip.mass = 0, def.platform.mass = 1e-3;
  ck_refused(&def, "use load.mass for what hangs on the end");
}
