/* A ribbon on a curved electrode, docs/theory.md section 35: limit points and onsets of contact of the boundary-value
 * problem u'''' = beta / (eta + x^n - u)^2, and what any device must obey. */
#include "limit_util.h"

#include "actuator/resolution.h"
#include "run/run.h"

static const double L = 0.1, delta = 0.2e-3, width = 12.7e-3, thick = 1e-3, eps0 = 8.8541878128e-12;

/* Voltage at which beta = eps0 w U^2 L^4 / (2 EI delta^3) is 1. */
static double unit_voltage(void) {
  double EI = 200e9 * width * thick * thick * thick / 12;
  return sqrt(2 * EI * delta * delta * delta / (eps0 * width * L * L * L * L));
}

/* A bare strip on an electrode with an insulator that counts as eta delta of vacuum, up to a voltage of `beta`. */
static ZpActuatorDef curved_def(double n, double eta, double beta, int nodes) {
  return DEF({"actuator.kind", ZP_KIND_CURVED}, {"ribbon.length", L}, {"ribbon.plane", ZP_PLANE_STRESS},
             {"ribbon.thickness", thick}, {"medium.permittivity", 1}, {"insulator.thickness", 0},
             {"lower.insulator.thickness", 2 * eta * delta}, {"lower.insulator.permittivity", 2},
             {"counter.height", delta}, {"counter.power", n}, {"mesh.nodes", nodes},
             {"drive.voltage", unit_voltage() * sqrt(beta)});
}

static double value_of(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  return zp_result_get(converged_of(study, def), name);
}

static double beta_of(double voltage) {
  double share = voltage / unit_voltage();
  return share * share;
}

/* -- limit points ------------------------------------------------------------------------------------ */

typedef struct PullIn {
  double n, eta, beta, tip;
} PullIn;

static const PullIn pull_ins[] = {{0, 0, 1.680841, 0.4465}, {1, 0.2, 1.352355, 0.5201}, {1.5, 0.05, 0.285975, 0.3772}};

TESTS(limit_points_of_the_boundary_value_problem, 0, LENGTH_OF(pull_ins)) {
  const PullIn *of = &pull_ins[_i];
  ZpActuatorDef def = curved_def(of->n, of->eta, 1.2 * of->beta, 241);
  Point limit = limit_of(&def);
  printf("n %g, eta %g: beta %.6f, tip %.4f\n", of->n, of->eta, beta_of(limit.voltage), -limit.stroke / delta);
  ck_near(beta_of(limit.voltage), of->beta, 8e-5);
  ck_near(-limit.stroke / delta, of->tip, 4.5e-4);
}

TEST(limits_finds_them_and_its_errors_bound_what_is_missed) {
  static const double slopes = 4e-6; /* (delta / L)^2: the boundary-value problem is that of small ones */
  for (size_t i = 1; i < LENGTH_OF(pull_ins); i++) {
    const PullIn *of = &pull_ins[i];
    ZpActuatorDef def = curved_def(of->n, of->eta, 1.2 * of->beta, 61);
    def.output.errors = true;
    ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
    double found = zp_result_get(result, "pull_in_voltage_V"), exact = unit_voltage() * sqrt(of->beta);
    double error = zp_result_get(result, "pull_in_voltage_error_V");
    printf("n %g: %.4f V, %.4f V exact, error %.1e\n", of->n, found, exact, error / exact);
    ck_near(found, exact, 6e-4);
    ck_below(fabs(found - exact), 0.5 * error + slopes * exact);
  }
}

TEST(pull_in_converges_with_the_square_of_the_mesh) {
  double missed[3];
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = curved_def(1.5, 0.05, 0.35, 15 * (1 << k) + 1), fine = curved_def(1.5, 0.05, 0.35, 241);
    missed[k] = limit_of(&def).voltage / limit_of(&fine).voltage - 1;
  }
  double order = log2(missed[0] / missed[1]);
  printf("%.2e %.2e %.2e, order %.2f\n", missed[0], missed[1], missed[2], order);
  ck_assert_double_eq_tol(order, 2, 0.15);
}

/* A power of 0 is a flange with that gap, bit by bit. */
TEST(flat_electrode_is_a_flange) {
  ZpActuatorDef curved = curved_def(0, 0.1, 3, 41), flange = curved;
  flange.actuator.kind = ZP_KIND_FLANGE;
  flange.counter = zp_actuator_def_default().counter;
  flange.electro.gap_offset = delta;
  flange.insulator.thickness = curved.insulator.thickness = 0.05 * delta;
  curved.lower.insulator.thickness = curved.lower.insulator.permittivity = NAN;
  flange.lower.insulator = curved.lower.insulator;
  ck_assert_double_eq(zp_result_get(study_of(ZP_STUDY_LIMITS, &curved), "pull_in_voltage_V"),
                      zp_result_get(study_of(ZP_STUDY_LIMITS, &flange), "pull_in_voltage_V"));
}

/* -- contact ----------------------------------------------------------------------------------------- */

/* The gap over the height of a parabola next to the clamp: 1 less the curvature of the strip there over that of the
 * electrode, from three stations. */
static double apart_at_clamp(const ZpRest *rest) {
  const ZpModel *model = rest->statics.member->model;
  const double *gap = rest->statics.member->eval.plates.gap, *face = model->plates.face;
  const size_t step = model->nodes / 60;
  double share[4];
  for (size_t k = 1; k < 4; k++)
    share[k] = gap[k * step] / face[k * step];
  return 3 * share[1] - 3 * share[2] + share[3];
}

/* Where it vanishes as the voltage rises: on the parabola through the last three points before faces push. */
static Point onset_of(const ZpActuatorDef *def) {
  ZpRest rest;
  Point point[3] = {{0, 0}, {0, 0}, {0, 0}};
  double apart[3] = {0, 0, 0}, now = 1, share[3];
  start_at_rest(&rest, def, 0.005);
  while (now > 0) {
    memmove(apart, apart + 1, 2 * sizeof *apart);
    memmove(point, point + 1, 2 * sizeof *point);
    apart[2] = apart_at_clamp(&rest);
    point[2] = (Point){zp_statics_stroke(&rest.statics), rest.statics.U};
    ck_assert(zp_branch_advance(&rest.branch));
    now = apart_at_clamp(&rest);
  }
  zp_rest_close(&rest);
  Point onset = {0, 0};
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    share[k] = apart[i] * apart[j] / ((apart[k] - apart[i]) * (apart[k] - apart[j]));
    onset = (Point){onset.stroke + share[k] * point[k].stroke, onset.voltage + share[k] * point[k].voltage};
  }
  return onset;
}

typedef struct Onset {
  double eta, beta, tip;
} Onset;

/* On a parabola contact begins at the clamp, where the strip is as curved as the electrode. */
TESTS(contact_begins_at_the_clamp, 0, 2) {
  static const Onset onsets[] = {{0.2, 0.528392, 0.376906}, {0.05, 0.106719, 0.255889}};
  const Onset *of = &onsets[_i];
  ZpActuatorDef def = curved_def(2, of->eta, 1.2 * of->beta, 1201);
  Point onset = onset_of(&def);
  printf("eta %g: beta %.6f, tip %.6f\n", of->eta, beta_of(onset.voltage), -onset.stroke / delta);
  ck_near(beta_of(onset.voltage), of->beta, 3.6e-4);
  ck_near(-onset.stroke / delta, of->tip, 2e-3);
}

/* Does the voltage turn round below that of beta? => beta at its first crest and at the dip after it; NAN: no. */
static void snap_of(const ZpActuatorDef *def, double beta, double *crest, double *dip) {
  ZpRest rest;
  start_at_rest(&rest, def, 0.002);
  double before = 0, now = 0;
  *crest = *dip = NAN;
  while (beta_of(now) < beta) {
    before = now;
    ck_assert(zp_branch_advance(&rest.branch));
    now = rest.statics.U;
    if (isnan(*crest) && now < before) *crest = beta_of(before);
    if (!isnan(*crest) && isnan(*dip) && now > before) *dip = beta_of(before);
  }
  zp_rest_close(&rest);
}

TEST(thin_insulator_snaps_a_little_and_a_thick_one_does_not) {
  double crest, dip;
  ZpActuatorDef thin = curved_def(2, 0.05, 0.6, 241), thick_one = curved_def(2, 0.2, 1, 241);
  snap_of(&thin, 0.2, &crest, &dip);
  printf("eta 0.05: snaps at %.5f, back at %.5f\n", crest, dip);
  ck_near(crest, 0.10672, 6e-4);
  ck_near(dip, 0.106, 5e-3);
  snap_of(&thick_one, 0.9, &crest, &dip);
  ck_assert_double_nan(crest);
}

/* A cubic electrode is straighter than the strip at the clamp: contact from the start, and no jump. */
TESTS(cubic_electrode_closes_without_a_jump, 0, 2) {
  double crest, dip, eta = _i ? 0.2 : 0.05;
  ZpActuatorDef def = curved_def(3, eta, 3, 121);
  snap_of(&def, 2.5, &crest, &dip);
  ck_assert_double_nan(crest);
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  ck_assert_double_nan(zp_result_get(result, "pull_in_voltage_V"));
}

/* A ribbon that lies on a steep electrode is not stretched, and each of its stations is on the electrode: (35.2). */
TEST(closed_ribbon_lies_on_the_electrode) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_CURVED}, {"counter.height", 20e-3}, {"drive.voltage", 4e3});
  ZpRest rest;
  start_at_rest(&rest, &def, 0.02);
  while (rest.statics.U < def.drive.voltage)
    ck_assert(zp_branch_advance(&rest.branch));
  const ZpModel *model = rest.statics.member->model;
  const double *x = rest.statics.member->q, *y = x + model->stride;
  double off = 0, strain = 0;
  for (size_t i = 0; i < model->nodes; i++) {
    const double share = x[i] / model->L;
    off = fmax(off, fabs(y[i] - def.counter.height * share * share));
    if (i > 0) strain = fmax(strain, fabs(hypot(x[i] - x[i - 1], y[i] - y[i - 1]) / model->l - 1));
  }
  printf("off the electrode by %.2g um, strain %.1e, slope %.2f\n", 1e6 * off, strain,
         2 * def.counter.height / model->L);
  ck_below(off, 1e-6);
  ck_below(strain, 9e-7);
  zp_rest_close(&rest);
}

/* Length of the front of a strip that zips along the electrode, of d = eta delta of vacuum: the fourth root of twice EI
 * k / d over the root of k / d^2, k = eps0 w U^2 / 2. Electrodes that touch nowhere have no front. */
TEST(length_of_the_front) {
  const double d = 0.05 * delta;
  ZpActuatorDef zips = curved_def(2, 0.05, 1, 61), apart = zips;
  apart.electro.gap_offset = 1e-3;
  const double U = zips.drive.voltage, k = 0.5 * eps0 * width * U * U, EI = 200e9 * width * thick * thick * thick / 12;
  ck_near(zp_front_length(model_of(&zips), U), sqrt(sqrt(2 * EI * k / d)) / sqrt(k / (d * d)), 1e-12);
  ck_assert(isinf(zp_front_length(model_of(&apart), U)));
}

/* Both tapes yield where they touch, as those of two ribbons: layers so soft that they, and not what attracts, say how
 * stiff the contact is. */
TEST(tapes_of_strip_and_electrode_yield) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_CURVED}, {"insulator.young_modulus", 1e5},
                          {"lower.insulator.thickness", 60e-6}, {"lower.insulator.young_modulus", 2e5});
  const ZpContactParams *faces = &model_of(&def)->faces;
  const double layers = def.insulator.thickness / 1e5 + 60e-6 / 2e5;
  ck_near(faces->push, def.ribbon.width / layers * faces->depth / 3, 1e-12);
}

/* -- motion ------------------------------------------------------------------------------------------ */

/* A step of the voltage zips it; the energy is kept: free, with damping, in oil, with lateral edges. */
TESTS(energy_is_kept_while_it_zips, 0, 4) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_CURVED}, {"drive.voltage", _i == 2 ? 2000 : 600},
                          {"solver.end_time", 0.2}, {"mesh.nodes", 41}, {"damping.internal", _i ? 1e-4 : 0},
                          {"liquid.model", _i == 2 ? ZP_LIQUID_SUBMERGED : ZP_LIQUID_NONE}, {"electro.edges", _i == 3});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  size_t last = result->series->rows - 1;
  double off = zp_table_get(result->series, last, "energy_imbalance_J"),
         work = zp_table_get(result->series, last, "electric_work_J");
  printf("energy off by %.1e of the work, stroke %.3f mm\n", off / work, 1e3 * zp_result_get(result, "stroke_m"));
  ck_below(fabs(off), 1e-7 * work);
}

/* The liquid also leaves through a free end, where its head is 0; not so where the end is clamped. */
TESTS(liquid_leaves_at_a_free_end, 0, 2) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 1e-3}, {"drive.voltage", 1e3},
                          {"actuator.right_end", _i ? ZP_END_CLAMPED : ZP_END_FREE}, {"mesh.nodes", 21},
                          {"liquid.model", ZP_LIQUID_SUBMERGED});
  ZpSim *sim = sim_of(model_of(&def));
  run_to(sim, 1e-3);
  const double *head = zp_state_own(sim->model, sim->state) + zp_film_mode_at(sim->model->nodes - 1, 0);
  if (_i) ck_assert_double_gt(fabs(head[0]), 1e-3);
  if (!_i) ck_assert(head[0] == 0 && head[1] == 0);
  ck_assert_double_gt(fabs(head[-ZP_FILM_MODES]), 1e-3);
}

/* -- derivatives ------------------------------------------------------------------------------------- */

TESTS(derivatives_by_the_shape_are_those_of_differences, 0, 3) {
  static const char *const keys[] = {"counter.height", "counter.power", "lower.insulator.thickness"};
  ZpActuatorDef def = curved_def(1.5, 0.05, 0.4, 61);
  int key = zp_key_find(keys[_i]);
  ck_ok(zp_def_set_text(&def, zp_key_find("sensitivity.by"), keys[_i], &err));
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  const double at = zp_def_get(&def, key), by = 1e-4 * at;
  double found[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef beside = def;
    memset(beside.sensitivity.by, 0, sizeof beside.sensitivity.by);
    ck_ok(zp_def_set(&beside, key, at + (k ? by : -by), &err));
    found[k] = zp_result_get(study_of(ZP_STUDY_LIMITS, &beside), "pull_in_voltage_V");
  }
  double slope = derivative_of(result, "pull_in_voltage_V", key), difference = (found[1] - found[0]) / (2 * by);
  printf("%s: %.8g, by difference %.8g\n", keys[_i], slope, difference);
  ck_near(slope, difference, 1.3e-8);
}

/* -- small devices ----------------------------------------------------------------------------------- */

/* Every length times c under c times the voltage: the same shapes, frequencies over c, times times c. */
static ZpActuatorDef scaled(ZpActuatorDef def, double c) {
  double *const lengths[] = {&def.ribbon.length,   &def.ribbon.width,        &def.ribbon.thickness,
                             &def.counter.height,  &def.insulator.thickness, &def.electro.gap_offset,
                             &def.platform.length, &def.drive.voltage,       &def.modes.voltage,
                             &def.solver.end_time, &def.damping.internal,    &def.isometric.separation};
  for (size_t k = 0; k < LENGTH_OF(lengths); k++)
    *lengths[k] *= c;
  def.gravity /= c;
  def.load.mass *= c * c * c;
  return def;
}

/* A curved electrode, a clamped strip over a flange with edges, and two ribbons: from 0.1 m to 0.1 mm. */
TESTS(a_device_a_thousand_times_smaller, 0, 3) {
  const double c = 1e-3;
  const ZpActuatorDef devices[] = {
      DEF({"actuator.kind", ZP_KIND_CURVED}, {"ribbon.thickness", 1e-3}, {"insulator.thickness", 1e-3},
          {"drive.voltage", 3e5}, {"modes.voltage", 1e4}),
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_CLAMPED}, {"ribbon.thickness", 2e-3},
          {"electro.gap_offset", 2e-3}, {"insulator.thickness", 1e-3}, {"electro.breakdown_cap", 0},
          {"electro.edges", 1}, {"gravity", 0}, {"load.mass", 0}, {"drive.voltage", 1e6}, {"modes.voltage", 4e5}),
      DEF({"gravity", 0.5}, {"ribbon.thickness", 1e-3}, {"insulator.thickness", 1e-3}, {"electro.breakdown_cap", 0},
          {"liquid.model", ZP_LIQUID_NONE}, {"load.mass", 20}, {"drive.voltage", 5e5}, {"damping.internal", 1e-4},
          {"solver.end_time", 0.5}),
  };
  ZpActuatorDef large = devices[_i], small = scaled(large, c);
  ZpResult *of = study_of(ZP_STUDY_LIMITS, &large), *its = study_of(ZP_STUDY_LIMITS, &small);
  printf("%s\n%s\n", of->message, its->message);
  ck_near(zp_result_get(its, "closing_voltage_V"), c * zp_result_get(of, "closing_voltage_V"), 1e-12);
  ck_near(zp_result_get(its, "release_voltage_V"), c * zp_result_get(of, "release_voltage_V"), 1e-12);
  ck_near(value_of(ZP_STUDY_MODES, &small, "frequency_1_Hz"), value_of(ZP_STUDY_MODES, &large, "frequency_1_Hz") / c,
          3e-10);
  of = study_of(ZP_STUDY_ACTUATE, &large);
  its = study_of(ZP_STUDY_ACTUATE, &small);
  ck_assert_int_eq(of->outcome, its->outcome);
  if (_i == 2) ck_near(zp_result_get(its, "zip_time_s"), c * zp_result_get(of, "zip_time_s"), 1e-5);
}

/* -- refused ----------------------------------------------------------------------------------------- */

typedef struct Refused {
  Setting setting[4];
  const char *says;
} Refused;

static const Refused refused[] = {
    {{{"actuator.kind", ZP_KIND_CURVED}, {"counter.height", -1e-3}}, "the counter electrode cuts the ribbon"},
    {{{"actuator.kind", ZP_KIND_CURVED}, {"counter.height", 0.2}}, "too steep for a ribbon to lie on it"},
    {{{"actuator.kind", ZP_KIND_FLANGE}, {"counter.height", 1e-3}}, "no counter electrode with a shape"},
    {{{"actuator.kind", ZP_KIND_FLANGE}, {"lower.insulator.thickness", 1e-5}}, "one insulator or two equal ones"},
    {{{"actuator.kind", ZP_KIND_CURVED}, {"lower.ribbon.thickness", 1e-5}}, "no lower ribbon"},
    {{{"actuator.kind", ZP_KIND_CURVED}, {"lower.insulator.density", 1e3}}, "does not matter"},
    {{{"actuator.kind", ZP_KIND_CURVED}, {"liquid.model", ZP_LIQUID_BEAD}}, "the bead is modelled"},
    {{{"actuator.kind", ZP_KIND_CURVED}, {"electro.edges", 1}, {"insulator.thickness", 0}},
     "the edges of bare faces that touch is infinite"},
};

TESTS(what_has_no_meaning_is_refused, 0, LENGTH_OF(refused)) {
  ZpActuatorDef def;
  const Refused *of = &refused[_i];
  size_t count = 0;
  while (count < LENGTH_OF(of->setting) && of->setting[count].key)
    count++;
  memset(&def, 0, sizeof def);
  ck_ok(resolve(&def, of->setting, count, &err));
  ck_says(zp_def_check(&def, &err), ZP_BAD_INPUT, of->says);
}

/* Electrodes that lean towards the ribbon, and bare ones that touch nowhere at rest, are none of these. */
TEST(what_has_a_meaning_is_not) {
  ZpActuatorDef leans = DEF({"actuator.kind", ZP_KIND_CURVED}, {"counter.height", -1e-3}, {"electro.gap_offset", 2e-3});
  ZpActuatorDef bare = DEF({"actuator.kind", ZP_KIND_CURVED}, {"electro.gap_offset", 2e-3}, {"insulator.thickness", 0},
                           {"electro.edges", 1}, {"drive.voltage", 10});
  ck_ok(zp_def_check(&leans, &err));
  ck_ok(zp_def_check(&bare, &err));
  ck_assert_int_eq(study_of(ZP_STUDY_STATIONARY, &bare)->outcome, ZP_CONVERGED);
}
