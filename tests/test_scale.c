/* Pure scaling of length. If all lengths, the roughness, the surface tension and the voltage are c times larger, masses
 * and volumes c^3 times, and gravity is 1 / c of what it was, then stresses and fields stay, forces are c^2 times
 * larger, and a dry actuator at rest has the same shape. No length of the program's own is left in the results. */
#include "check_util.h"

static const struct {
  const char *key;
  int power;
} scaled_keys[] = {{"ribbon.length", 1},
                   {"ribbon.width", 1},
                   {"ribbon.thickness", 1},
                   {"platform.length", 1},
                   {"insulator.thickness", 1},
                   {"film.roughness", 1},
                   {"medium.surface_tension", 1},
                   {"drive.voltage", 1},
                   {"modes.voltage", 1},
                   {"isometric.separation", 1},
                   {"gravity", -1},
                   {"load.mass", 3},
                   {"bead.volume", 3}};

static double power_of(double c, int power) {
  return power < 0 ? 1 / power_of(c, -power) : power == 0 ? 1 : c * power_of(c, power - 1);
}

static ZpActuatorDef scaled(ZpActuatorDef def, double c) {
  for (size_t i = 0; i < LENGTH_OF(scaled_keys); i++) {
    int key = zp_key_find(scaled_keys[i].key);
    ck_assert_int_eq(zp_def_set(&def, key, power_of(c, scaled_keys[i].power) * zp_def_get(&def, key), NULL), ZP_OK);
  }
  return def;
}

/* A number of a study goes with this power of c. */
typedef struct Number {
  const char *name;
  int power;
} Number;

static const Number of_limits[] = {{"pull_in_voltage_V", 1}, {"closing_voltage_V", 1}, {"release_voltage_V", 1},
                                   {"max_load_kg", 3},       {"travel_m", 1},          {"max_stress_Pa", 0}},
                    of_hold[] = {{"force_N", 2}, {"capacitance_F", 1}, {"charge_C", 2}, {"zipped_length_m", 1}},
                    of_modes[] = {{"frequency_1_Hz", -1}, {"frequency_2_Hz", -1}},
                    of_profile[] = {{"field_force_N", 2}, {"capacitance_F", 1}, {"virtual_work_force_N", 2}};

static const struct {
  ZpStudy study;
  Setting setting[4];
  const Number *number;
  size_t numbers;
} cases[] = {
    {ZP_STUDY_LIMITS, {{0}}, of_limits, LENGTH_OF(of_limits)},
    {ZP_STUDY_LIMITS, {{"electro.breakdown_cap", 0}}, of_limits, LENGTH_OF(of_limits)},
    {ZP_STUDY_LIMITS, {{"insulator.thickness", 20e-6}, {"drive.voltage", 3e3}}, of_limits, LENGTH_OF(of_limits)},
    {ZP_STUDY_LIMITS, {{"load.mass", 0.1e-3}}, of_limits, LENGTH_OF(of_limits)},
    {ZP_STUDY_LIMITS,
     {{"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 1e-4}},
     of_limits,
     LENGTH_OF(of_limits)},
    {ZP_STUDY_LIMITS,
     {{"actuator.kind", ZP_KIND_HINGE}, {"ribbon.thickness", 200e-6}, {"load.mass", 1e-4}},
     of_limits,
     LENGTH_OF(of_limits)},
    {ZP_STUDY_EQUILIBRIUM, {{"medium.permittivity", 1}, {"medium.breakdown_field", 3e6}}, of_limits, 3},
    {ZP_STUDY_ISOMETRIC, {{0}}, of_hold, LENGTH_OF(of_hold)},
    {ZP_STUDY_ISOMETRIC, {{"electro.edges", 1}}, of_hold, LENGTH_OF(of_hold)},
    {ZP_STUDY_MODES, {{"modes.voltage", 5e3}}, of_modes, LENGTH_OF(of_modes)},
    {ZP_STUDY_PROFILE, {{0}}, of_profile, LENGTH_OF(of_profile)},
};

static ZpActuatorDef def_of(int i) {
  Setting list[8] = {{"mesh.nodes", 21}, {"solver.tolerance", 1e-6}};
  size_t count = 2;
  for (size_t k = 0; k < LENGTH_OF(cases[i].setting) && cases[i].setting[k].key; k++)
    list[count++] = cases[i].setting[k];
  return def_with(list, count);
}

TESTS(dry_actuator_at_rest_keeps_its_shape, 0, LENGTH_OF(cases)) {
  static const double factor[] = {1.6, 0.15};
  ZpActuatorDef def = def_of(_i);
  ZpResult *plain = answer_of(cases[_i].study, &def);
  for (size_t f = 0; f < LENGTH_OF(factor); f++) {
    ZpActuatorDef other = scaled(def, factor[f]);
    ZpResult *result = answer_of(cases[_i].study, &other);
    for (size_t k = 0; k < cases[_i].numbers; k++) {
      const Number *number = &cases[_i].number[k];
      double expected = zp_result_get(plain, number->name) * power_of(factor[f], number->power);
      double value = zp_result_get(result, number->name);
      ck_assert_int_eq(isnan(value), isnan(expected));
      if (!isnan(expected)) ck_near(value, expected, 2e-8); /* 3e-9 measured */
    }
  }
}
