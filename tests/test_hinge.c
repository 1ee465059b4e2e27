/* A fold: two ribbons on a hinge. Rigid plates have closed forms: capacitance and torque of a wedge, a weight against a
 * torsion spring, its swing; then energy in motion, and what is refused. Section 30 of docs/theory.md. */
#include "check_util.h"

#include "rest/rest.h"
#include "run/run.h"

static const double pi = 3.14159265358979323846, eps0 = 8.8541878128e-12;

/* Plates that hardly bend: 5 mm of the stiffest metal, 10 mm long, without weight, under a law without cap. Voltages
 * are so high that rounding in edges as stiff as that counts little, and so low that bending does. */
#define RIGID                                                                                                          \
  {"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 10e-3}, {"ribbon.thickness", 5e-3},                              \
      {"ribbon.young_modulus", 1e12}, {"load.mass", 0}, {"gravity", 0}, {                                              \
    "electro.breakdown_cap", 0                                                                                         \
  }

/* Eq. (30.4): capacitance of rigid plates at an angle, and the torque that closes them. */
typedef struct Wedge {
  double capacitance, torque;
} Wedge;

static Wedge wedge_of(const ZpActuatorDef *def, double angle) {
  double eps = eps0 * def->medium.permittivity * def->ribbon.width, L = def->ribbon.length;
  double d = 2 * def->insulator.thickness * def->medium.permittivity / def->insulator.permittivity;
  double t = tan(angle / 2), inside = 1 + L * sin(angle) / d, U = def->drive.voltage;
  double slope = L * cos(angle) / (d * inside) / (2 * t) - log(inside) * (1 + t * t) / (4 * t * t);
  return (Wedge){eps * log(inside) / (2 * t), -0.5 * U * U * eps * slope};
}

/* Held at angles from 0.2 to 40 degrees: the wedge, with gaps from thinner than the insulators to far larger. The
 * plates bend by at most 1e-5 of the angle. At small angles the wedge is that of eq. (30.5). */
TESTS(held_plates_are_a_wedge, 0, 4) {
  static const struct { double degrees, voltage; } at[] = {{0.2, 2e3}, {2, 16e3}, {10, 100e3}, {40, 200e3}};
  double angle = at[_i].degrees * pi / 180;
  ZpActuatorDef def = DEF(RIGID, {"mesh.nodes", 101}, {"drive.voltage", at[_i].voltage});
  def.isometric.separation = def.ribbon.length * sin(angle);
  Wedge wedge = wedge_of(&def, angle);
  ZpResult *result = answer_of(ZP_STUDY_ISOMETRIC, &def);
  ck_near(zp_result_get(result, "angle_rad"), angle, 1e-5); /* 6.6e-6 measured */
  ck_near(zp_result_get(result, "capacitance_F"), wedge.capacitance, 1e-5);
  ck_near(zp_result_get(result, "torque_N_m"), wedge.torque, 3e-5); /* 9.7e-6 measured */
  /* 9.6e-6 measured */
  ck_near(zp_result_get(result, "force_N"), wedge.torque / (def.ribbon.length * cos(angle)), 3e-5);
  double d = 2 * def.insulator.thickness * def.medium.permittivity / def.insulator.permittivity;
  double eps = eps0 * def.medium.permittivity * def.ribbon.width;
  if (angle < 0.05)
    ck_near(wedge.capacitance, eps / angle * log(1 + angle * def.ribbon.length / d), 1e-3); /* 2.2e-4 measured */
}

/* Convergence of the torque at 10 degrees with three Gauss points: a mesh twice as fine has at most a quarter of the
 * error. */
TEST(torque_converges) {
  double off[3], angle = 10 * pi / 180;
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = DEF(RIGID, {"mesh.nodes", 5 * (1 << k) + 1}, {"drive.voltage", 100e3});
    def.isometric.separation = def.ribbon.length * sin(angle);
    off[k] = fabs(answered_value(ZP_STUDY_ISOMETRIC, &def, "torque_N_m") / wedge_of(&def, angle).torque - 1);
    printf("%d elements: torque off by %.2e\n", def.mesh.nodes - 1, off[k]);
  }
  ck_below(off[1], off[0] / 4);
  ck_below(off[2], off[1] / 4);
}

/* A plate of 1.5 mm with a mass at its end against a spring: the angle at which both moments balance, eq. (30.6). */
TESTS(plate_hangs_on_its_spring, 0, 3) {
  static const double rest[] = {0, 0.3, -0.2};
  double k = 5e-3, L = 50e-3, m = 4e-3;
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", L}, {"ribbon.thickness", 1.5e-3},
                          {"ribbon.young_modulus", 1e12}, {"ribbon.density", 1000}, {"load.mass", m},
                          {"hinge.stiffness", k}, {"hinge.rest_angle", rest[_i]}, {"mesh.nodes", 31});
  def.insulator.thickness = 0, def.drive.voltage = 0;
  double mu = def.ribbon.density * def.ribbon.width * def.ribbon.thickness, moment = (m + mu * L / 2) * def.gravity * L;
  double angle = rest[_i];
  for (int i = 0; i < 50; i++) /* Newton */
    angle -= (k * (angle - rest[_i]) - moment * cos(angle)) / (k + moment * sin(angle));
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "stroke_m"), L * sin(angle), 5e-5); /* it bends by some 1e-5 */
}

/* A flexible, naturally curved strip in series with its spring, eq. (30.1): small deflections by a small load are F L^3
 * / 3 EI + F L^2 / k + kappa L^2 / 2. Elements half as long leave a quarter of the error. */
TESTS(strip_stands_in_series_with_its_spring, 0, 2) {
  double k = 3e-3, L = 50e-3, b = 100e-6, kappa = _i ? 0.05 : 0, F = 1e-5, off[3];
  for (int n = 0; n < 3; n++) {
    ZpActuatorDef def =
        DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", L}, {"ribbon.thickness", b}, {"ribbon.density", 0},
            {"ribbon.plane", ZP_PLANE_STRESS}, {"load.mass", 0}, {"load.force", F}, {"hinge.stiffness", k},
            {"mesh.nodes", 5 * (1 << n) + 1}, {"segment_1.length", L}, {"segment_1.thickness", b},
            {"segment_1.curvature", kappa}, {"solver.tolerance", 1e-8}, {"drive.voltage", 0});
    double EI = def.ribbon.young_modulus * def.ribbon.width * b * b * b / 12;
    double expected = F * L * L * L / (3 * EI) + F * L * L / k + kappa * L * L / 2;
    off[n] = fabs(answered_value(ZP_STUDY_STATIONARY, &def, "stroke_m") / expected - 1);
    printf("%d elements: stroke off by %.2e\n", def.mesh.nodes - 1, off[n]);
  }
  ck_near(off[0] / off[1], 4, 0.02); /* 4.6e-3 measured */
  ck_near(off[1] / off[2], 4, 0.05);
}

/* Derivatives with respect to its keys equal finite differences: of the angle at rest, of the holding force, of the
 * pull-in. */
TESTS(derivatives_are_those_of_differences, 0, 4) {
  static const struct {
    ZpStudy study;
    const char *name, *key;
    double step;
  } of[] = {{ZP_STUDY_STATIONARY, "angle_rad", "hinge.stiffness", 1e-6},
            {ZP_STUDY_STATIONARY, "angle_rad", "hinge.rest_angle", 1e-4},
            {ZP_STUDY_ISOMETRIC, "force_N", "insulator.thickness", 1e-8},
            {ZP_STUDY_LIMITS, "pull_in_voltage_V", "hinge.stiffness", 1e-6}};
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 50e-3}, {"ribbon.thickness", 0.5e-3},
          {"load.mass", 0.1e-3}, {"hinge.stiffness", 3e-3}, {"hinge.rest_angle", 0.2}, {"mesh.nodes", 31},
          {"drive.voltage", 8e3}, {"isometric.separation", 5e-3}, {"solver.tolerance", 1e-7});
  int key = zp_key_find(of[_i].key);
  double at = zp_def_get(&def, key), value[2];
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(zp_def_set(&def, key, at + (k ? 1 : -1) * of[_i].step, NULL), ZP_OK);
    value[k] = answered_value(of[_i].study, &def, of[_i].name);
  }
  ck_assert_int_eq(zp_def_set(&def, key, at, NULL), ZP_OK);
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("sensitivity.by"), of[_i].key, NULL), ZP_OK);
  ZpResult *result = answer_of(of[_i].study, &def);
  double slope = NAN;
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, of[_i].name) == 0) slope = result->sensitivity[i].value;
  ck_near(slope, (value[1] - value[0]) / (2 * of[_i].step), 2e-6); /* 4e-7 measured */
}

/* Without a spring the lower ribbon hangs straight down: a right angle. */
TEST(free_hinge_hangs_straight_down) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 50e-3}, {"ribbon.thickness", 0.4e-3},
          {"ribbon.young_modulus", 1e12}, {"load.mass", 4e-3}, {"drive.voltage", 0}, {"mesh.nodes", 31});
  double stroke = answered_value(ZP_STUDY_STATIONARY, &def, "stroke_m");
  ck_near(stroke, def.ribbon.length, 5e-8); /* 9.6e-9 measured */
}

/* Small oscillations: a plate with a mass at its end on a spring has the frequency sqrt(k / I) without gravity; a free
 * plate that hangs down is a physical pendulum, eq. (30.7). */
TESTS(swings_as_a_rigid_body, 0, 2) {
  double k = _i ? 0 : 5e-3, L = 50e-3, m = 4e-3;
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", L}, {"ribbon.thickness", 1e-3},
                          {"ribbon.young_modulus", 1e12}, {"load.mass", m}, {"hinge.stiffness", k}, {"mesh.nodes", 31},
                          {"gravity", _i ? 9.81 : 0});
  double mu = def.ribbon.density * def.ribbon.width * def.ribbon.thickness;
  double inertia = m * L * L + mu * L * L * L / 3, moment = (m + mu * L / 2) * def.gravity * L;
  double expected = sqrt((_i ? moment : k) / inertia) / (2 * pi);
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), expected, 5e-4); /* 1.1e-4 measured */
}

/* A large swing on the spring keeps its initial energy. Measured: off by 8e-9 of its largest kinetic energy. */
TEST(swing_keeps_energy) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 50e-3}, {"ribbon.thickness", 0.2e-3},
                          {"load.mass", 4e-3}, {"hinge.stiffness", 5e-3}, {"hinge.rest_angle", 0.5}, {"mesh.nodes", 21},
                          {"initial.state", ZP_INITIAL_STRAIGHT}, {"drive.voltage", 0}, {"solver.end_time", 0.5},
                          {"solver.tolerance", 1e-4});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  double most = 0, widest = 0, fastest = 0;
  for (size_t i = 0; i < result->series->rows; i++) {
    most = fmax(most, fabs(zp_table_get(result->series, i, "energy_imbalance_J")));
    widest = fmax(widest, zp_table_get(result->series, i, "angle_rad"));
    fastest = fmax(fastest, zp_table_get(result->series, i, "kinetic_energy_J"));
  }
  double stored = zp_table_get(result->series, 0, "spring_energy_J");
  ck_near(stored, 0.5 * 5e-3 * 0.25, 1e-2); /* in series with half an element */
  ck_assert_double_gt(widest, 0.5);
  ck_below(most, 1e-8 * fastest); /* 1.3e-9 measured */
}

/* It zips dry from the hinge outwards, lifts its load, and opens when the voltage is switched off: the energy balances,
 * and the work on the load is its weight times its rise. */
TESTS(zips_and_keeps_the_books, 0, 2) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 50e-3}, {"ribbon.thickness", 0.1e-3},
          {"load.mass", 0.2e-3}, {"hinge.stiffness", 2e-3}, {"hinge.rest_angle", 0.2}, {"mesh.nodes", 15},
          {"electro.edges", _i}, {"solver.end_time", _i ? 0.3 : 0.06}, {"solver.tolerance", 1e-4});
  if (_i) def.drive.waveform = ZP_WAVEFORM_SQUARE, def.drive.frequency = 4;
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_below(zp_result_get(result, "energy_error"), 7e-9); /* 2.3e-9 measured */
  ck_assert_double_gt(zp_table_get(result->series, 0, "angle_rad"), 0.2);
  if (_i == 0) {
    ck_assert_int_eq(result->outcome, ZP_ZIPPED);
    double longest = 0; /* dry faces that have closed still vibrate */
    for (size_t i = 0; i < result->series->rows; i++)
      longest = fmax(longest, zp_table_get(result->series, i, "zipped_length_m"));
    ck_near(longest, def.ribbon.length, 1e-12); /* 0 measured */
    double rise = zp_table_get(result->series, 0, "stroke_m") - zp_result_get(result, "stroke_m");
    ck_near(zp_result_get(result, "mechanical_work_J"), def.load.mass * def.gravity * rise, 1e-12); /* 0 measured */
  }
}

/* Pull-in of a fold from its held plates: the angle at which torque and spring moment are equal and equally steep, eq.
 * (30.8). */
TEST(pull_in_is_that_of_the_wedge) {
  double k = 0.05, rest = 5 * pi / 180, lowest = 0, step = 1e-4;
  ZpActuatorDef def =
      DEF(RIGID, {"hinge.stiffness", k}, {"hinge.rest_angle", rest}, {"mesh.nodes", 101}, {"drive.voltage", 20e3});
  ZpActuatorDef unit = def;
  unit.drive.voltage = 1;
  for (double angle = rest - step; angle > 0.1 * rest; angle -= step) {
    double square = k * (rest - angle) / wedge_of(&unit, angle).torque;
    if (square < lowest) break;
    lowest = square;
  }
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V"), sqrt(lowest), 3e-6); /* 9.3e-7 measured */
}

/* -- forces --------------------------------------------------------------------------------------- */

/* The mean force of the spring over a step does the work of its energy change, for any rotation of the first element.
 */
TEST(mean_force_does_the_work) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_HINGE}, {"hinge.stiffness", 3e-3}, {"hinge.rest_angle", 0.4}, {"mesh.nodes", 5});
  ZpModel *model = model_of(&def);
  ZpEval eval;
  ck_assert(zp_system_create(model, false, &eval));
  size_t n = 2 * model->stride;
  double *q = zp_calloc(4 * n, sizeof *q), *q1 = q + n, *F = q + 2 * n, *bare = q + 3 * n;
  uint64_t seed = 11;
  for (size_t j = 0; j < model->stride; j++)
    q[j] = q1[j] = zp_straight_x(model, j / 2);
  q[3] = 0.8 * model->l, q[model->stride + 3] = -0.6 * model->l;
  q1[3] = 0.5 * model->l, q1[model->stride + 3] = 0.9 * model->l * noise(&seed);
  ZpSpan span = zp_span_at(q), end = zp_span_at(q1);
  double before = 0, after = 0;
  zp_term_hinge.now(model, &span, &eval, &before);
  zp_term_hinge.now(model, &end, &eval, &after);
  span.end = q1, span.h = 1;
  zp_system_begin(model, &span, &eval);
  zp_term_rod.force(model, &span, &eval, bare);
  zp_term_hinge.force(model, &span, &eval, F);
  double work = F[3] * (q1[3] - q[3]) + F[model->stride + 3] * (q1[model->stride + 3] - q[model->stride + 3]);
  ck_assert_double_gt(fabs(work), 1e-5);
  ck_near(work, before - after, 1e-12);
  zp_free(q);
  zp_system_destroy(&eval);
}

/* -- what is refused ------------------------------------------------------------------------------ */

static const struct {
  ZpStudy study;
  Setting setting;
  const char *named;
} refusals[] = {
    {ZP_STUDY_ACTUATE, {"solver.integrator", ZP_INTEGRATOR_EXPLICIT}, "solver.integrator implicit"},
    {ZP_STUDY_STATIONARY, {"ribbon.model", ZP_RIBBON_MASS_SPRING}, "ribbon.model rod"},
    {ZP_STUDY_STATIONARY, {"electro.surface", ZP_SURFACE_BEZIER}, "electro.surface polyline"},
    {ZP_STUDY_STATIONARY, {"contact.model", ZP_CONTACT_SEQUENTIAL}, "contact.model unilateral"},
    {ZP_STUDY_STATIONARY, {"hinge.rest_angle", 0.1}, "hinge.stiffness above 0 N m/rad"},
    {ZP_STUDY_STATIONARY,
     {"actuator.kind", ZP_KIND_RIBBON},
     "hinge.stiffness = 0.001 N m/rad: requires actuator.kind hinge"},
    {ZP_STUDY_STATIONARY, {"liquid.model", ZP_LIQUID_BEAD}, "liquid.model = bead"},
    {ZP_STUDY_STATIONARY, {"electro.model", ZP_ELECTRO_FIELD}, "electro.model = field"},
    {ZP_STUDY_STATIONARY, {"stack.parallel", 2}, "stack.parallel"},
    {ZP_STUDY_ACTUATE, {"insulator.thickness", 0}, "short circuit, because the electrodes touch at the hinge"},
    {ZP_STUDY_ISOMETRIC, {"isometric.separation", 99e-3}, "0.98 ribbon.length"},
    {ZP_STUDY_PROFILE, {"mesh.nodes", 21}, "actuator.kind = hinge"},
};

TESTS(what_does_not_go_is_refused, 0, LENGTH_OF(refusals)) {
  bool spring = strstr(refusals[_i].named, "hinge.stiffness =") != NULL;
  Setting list[] = {{"actuator.kind", ZP_KIND_HINGE}, refusals[_i].setting, {"hinge.stiffness", spring ? 1e-3 : 0}};
  ZpActuatorDef def = def_with(list, LENGTH_OF(list));
  ck_refused_by(refusals[_i].study, &def, refusals[_i].named);
}
