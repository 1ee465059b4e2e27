/* Equilibria against what is known of them: the elastica (elastica.h and published values), roots of frequency
 * equations, classical pull-in, converged finite elements, the paper's code; and what any answer must obey:
 * order of convergence, stability by branch, faces that do not pass through each other. */
#include "check_util.h"

#include "elastica.h"
#include "limit_util.h"

#define MM(x) ((x)*1e-3)

/* -- running a study ------------------------------------------------------------------------------- */

/* One number of a study that ends well. */
static double value_of(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  return zp_result_get(converged_of(study, def), name);
}

/* -- one ribbon ------------------------------------------------------------------------------------ */

static const double L = 0.1, width = 12.7e-3, thickness = 50e-6, E = 200e9, rho = 7850;

static double bending_stiffness(double b) {
  return E * width * b * b * b / 12;
}

/* A ribbon under P L^2 / EI = p and w L^3 / EI = q: without weight of its own p comes from the load, q from gravity. */
static ZpActuatorDef beam(ZpRightEnd end, double p, double q, int nodes) {
  double EI = bending_stiffness(thickness), mu = rho * width * thickness;
  double gravity = q > 0 ? q * EI / (mu * L * L * L) : 9.81;
  return DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", end}, {"ribbon.length", L},
             {"ribbon.plane", ZP_PLANE_STRESS}, {"ribbon.density", q > 0 ? rho : 0}, {"gravity", gravity},
             {"load.mass", p * EI / (L * L * gravity)}, {"mesh.nodes", nodes});
}

typedef struct BeamCase {
  ZpRightEnd end;
  double p, q;
  double y, x; /* published, over L; x NAN where it is not */
} BeamCase;

static const BeamCase beams[] = {
    {ZP_END_FREE, 1, 0, 0.301721, NAN},    {ZP_END_FREE, 2, 0, 0.493457, NAN},
    {ZP_END_FREE, 5, 0, 0.713792, NAN},    {ZP_END_FREE, 10, 0, 0.810609, NAN},
    {ZP_END_GUIDED, 4, 0, 0.301721, NAN},  {ZP_END_GUIDED, 16, 0, 0.669964, NAN},
    {ZP_END_FREE, 0, 1, 0.12347, 0.99125}, {ZP_END_FREE, 0, 10, 0.70020, 0.65635},
};

/* The oracle itself knows the published digits. */
TESTS(test_oracle, 0, LENGTH_OF(beams)) {
  const BeamCase *c = &beams[_i];
  Elastica e = elastica(c->p, c->q, c->end == ZP_END_GUIDED);
  ck_assert(e.found);
  ck_assert_double_eq_tol(e.y, c->y, 6e-6);                   /* 1.4e-6 measured */
  if (!isnan(c->x)) ck_assert_double_eq_tol(e.x, c->x, 6e-6); /* 3.8e-6 measured */
}

TESTS(test_elastica, 0, LENGTH_OF(beams)) {
  const BeamCase *c = &beams[_i];
  Elastica e = elastica(c->p, c->q, c->end == ZP_END_GUIDED);
  ZpActuatorDef def = beam(c->end, c->p, c->q, 61);
  ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
  double y = zp_result_get(result, "stroke_m") / L, x = zp_table_get(result->series, 60, "x_m") / L;
  printf("%s, p = %g, q = %g: y %+.1e, x %+.1e off the elastica\n", c->end == ZP_END_FREE ? "free" : "guided", c->p,
         c->q, y / e.y - 1, x / e.x - 1);
  ck_near(y, e.y, 1e-3);
  ck_near(x, e.x, 5e-5); /* 1.3e-5 measured */
}

/* -- the actuator's opening ------------------------------------------------------------------------ */

static ZpActuatorDef opening_def(double density, double mass, int nodes) {
  return DEF({"ribbon.plane", ZP_PLANE_STRESS}, {"ribbon.density", density}, {"load.mass", mass},
             {"mesh.nodes", nodes});
}

static double opening(double density, double mass, int nodes) {
  ZpActuatorDef def = opening_def(density, mass, nodes);
  return value_of(ZP_STUDY_STATIONARY, &def, "opening_m");
}

TEST(test_opening) {
  ck_near(opening(0, 8e-3, 61), MM(21.226), 1e-4);  /* 2.6e-5 measured */
  ck_near(opening(0, 30e-3, 61), MM(52.839), 3e-4); /* 8.6e-5 measured */
  ck_near(opening(rho, 8e-3, 61), MM(22.27), 1e-3);
}

/* -- order of convergence -------------------------------------------------------------------------- */

/* Relative errors of deflections under an end load and weight. */
static double beam_error(ZpRightEnd end, int nodes) {
  const double p = 0.4, q = 0.4;
  ZpActuatorDef def = beam(end, 0, q, nodes);
  def.load.mass = p / q * rho * width * thickness * L;
  return value_of(ZP_STUDY_STATIONARY, &def, "stroke_m") / L / elastica(p, q, end == ZP_END_GUIDED).y - 1;
}

static double opening_error(int nodes) {
  const double half = 45e-3, mass = 8e-3;
  double p = mass / 2 * 9.81 * half * half / bending_stiffness(thickness);
  return opening(0, mass, nodes) / (2 * half * elastica(p, 0, true).y) - 1;
}

/* The remaining error of second order is bending against the tension T, by T l^2 / 12 in addition to EI: for a strip
 * bent by an end load P at most P l^2 / (12 EI). A clamp that was a held slope over half an edge had 2 l^2 / L^2. */
TESTS(test_order_of_deflections, 0, 3) {
  static const int nodes[] = {16, 31, 61, 121};
  static const char *const names[] = {"guided", "free", "actuator"};
  double error[LENGTH_OF(nodes)];
  for (size_t i = 0; i < LENGTH_OF(nodes); i++) {
    error[i] = _i == 2 ? opening_error(nodes[i]) : beam_error(_i ? ZP_END_FREE : ZP_END_GUIDED, nodes[i]);
    printf("%s, N = %d: %+.2e\n", names[_i], nodes[i], error[i]);
  }
  static const double load[] = {0.8, 0.8, 1.5}, stretched = 3e-6; /* P L^2 / EI; the elastica does not stretch */
  for (size_t i = 0; i < LENGTH_OF(nodes); i++)
    ck_below(fabs(error[i]), load[_i] / 12 / pow(nodes[i] - 1, 2) + stretched);
}

/* Small deflections of clamped and guided strips under an end load are exact on any mesh. */
TESTS(test_small_deflections_are_exact, 0, 2) {
  static const ZpRightEnd ends[] = {ZP_END_GUIDED, ZP_END_FREE};
  static const int nodes[] = {4, 5, 21};
  for (size_t i = 0; i < LENGTH_OF(nodes); i++) {
    ZpActuatorDef def = beam(ends[_i], 1e-5, 0, nodes[i]);
    double exact = 1e-5 / (_i == 0 ? 12 : 3);
    ck_near(value_of(ZP_STUDY_STATIONARY, &def, "stroke_m") / L, exact, 1e-10); /* 1.2e-11 measured */
  }
}

/* -- natural curvature, segments ------------------------------------------------------------------- */

/* Curvature alone: an arc, its end at ((sin kL) / k, (1 - cos kL) / k). */
TEST(test_natural_curvature) {
  const double k = 8;
  ZpActuatorDef def = beam(ZP_END_FREE, 0, 0, 61);
  def.segment_K[0].length = L;
  def.segment_K[0].curvature = k;
  ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
  ck_near(zp_table_get(result->series, 60, "x_m"), sin(k * L) / k, 3e-5);       /* 7.5e-6 measured */
  ck_near(zp_table_get(result->series, 60, "y_m"), (1 - cos(k * L)) / k, 2e-4); /* 4.1e-5 measured */
  /* the end is above the clamp; 4.1e-5 measured */
  ck_near(zp_result_get(result, "stroke_m"), -(1 - cos(k * L)) / k, 2e-4);
}

/* Two thicknesses in series under a small load at the end: the compliances add. */
TEST(test_two_segments) {
  const double thick = 80e-6, a = 0.4 * L, b = L - a;
  ZpActuatorDef def = beam(ZP_END_FREE, 1e-3, 0, 61);
  def.segment_K[0].length = a;
  def.segment_K[0].thickness = thick;
  double P = def.load.mass * def.gravity;
  double beam_y =
      P * (L * L * L - b * b * b) / (3 * bending_stiffness(thick)) + P * b * b * b / (3 * bending_stiffness(thickness));
  double y = value_of(ZP_STUDY_STATIONARY, &def, "stroke_m");
  printf("two segments: %+.1e off\n", y / beam_y - 1);
  ck_near(y, beam_y, 1e-3); /* 1.5e-4 measured */
}

/* What a stepped cantilever is off by, its step at `a`, under a load so small that it stays straight. */
static double step_error(double a, int nodes) {
  const double thick = 80e-6, b = L - a;
  ZpActuatorDef def = beam(ZP_END_FREE, 1e-5, 0, nodes);
  def.segment_K[0].length = a;
  def.segment_K[0].thickness = thick;
  double P = def.load.mass * def.gravity;
  double y =
      P * (L * L * L - b * b * b) / (3 * bending_stiffness(thick)) + P * b * b * b / (3 * bending_stiffness(thickness));
  return value_of(ZP_STUDY_STATIONARY, &def, "stroke_m") / y - 1;
}

/* Regression: a segment that ended between nodes counted as if it ended at a node, with errors of +1.8 % and -2.2 % on
 * either side of it, 0.02 % on it. Wherever the step is, the error falls with l^2, and it changes smoothly as the step
 * moves. */
TEST(test_step_between_nodes) {
  double least = INFINITY, most = -INFINITY;
  for (int k = 0; k <= 16; k++) {
    double error = step_error((0.4 + k / 480.0) * L, 61); /* eighths of an element */
    least = fmin(least, error);
    most = fmax(most, error);
  }
  printf("step moved over two elements, N = 61: error %+.2e to %+.2e\n", least, most);
  ck_below(most - least, 5e-6); /* 1.3e-6 measured */
  double error[4];
  for (int i = 0; i < 4; i++)
    error[i] = step_error(0.4137 * L, 30 * (1 << i) + 1);
  printf("step at 0.4137 L: error %+.2e %+.2e %+.2e %+.2e\n", error[0], error[1], error[2], error[3]);
  for (int i = 0; i < 3; i++)
    ck_near(error[i] / error[i + 1], 4, 0.02); /* 5.1e-3 measured */
}

/* The angle of a joint whose curvature is k. */
static double turn_of(double k) {
  double turn = k;
  for (int i = 0; i < 20; i++)
    turn += k - zp_rod_curvature(tan(0.5 * turn));
  return turn;
}

/* How far joint j bends where all bear the same small moment, over that moment. */
static double bent_by_unit_moments(const ZpRodParams *rod, size_t j) {
  for (size_t k = 0; k < rod->ends; k++) {
    const ZpRodEnd *end = &rod->end[k];
    double both = rod->B[end->held] * rod->B[end->next] - end->B * end->B;
    if (j == end->held) return (rod->B[end->next] - end->B) / both;
    if (j == end->next) return (rod->B[end->held] - end->B) / both;
  }
  return 1 / rod->B[j];
}

/* On any mesh a rod has the compliance, the natural rotation, the mass and the centre of mass of its segments. */
TEST(test_segments_are_integrated) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"ribbon.length", L}, {"ribbon.plane", ZP_PLANE_STRESS},
                          {"mesh.nodes", 14}, {"load.mass", 0}, {"segment_1.length", 0.0113},
                          {"segment_1.thickness", 80e-6}, {"segment_1.curvature", 3}, {"segment_2.length", 0.0021},
                          {"segment_2.thickness", 30e-6}, {"segment_2.curvature", -40}, {"segment_3.length", 0.0519},
                          {"segment_3.thickness", 120e-6}, {"segment_3.curvature", 7});
  const double length[] = {0.0113, 0.0021, 0.0519, L - 0.0653}, thick[] = {80e-6, 30e-6, 120e-6, 50e-6},
               curvature[] = {3, -40, 7, 0};
  double axial = 0, bending = 0, turn = 0, mass = 0, moment = 0, from = 0;
  for (int k = 0; k < 4; k++) {
    axial += length[k] / (E * width * thick[k]);
    bending += length[k] / bending_stiffness(thick[k]);
    turn += length[k] * curvature[k];
    mass += length[k] * rho * width * thick[k];
    moment += length[k] * rho * width * thick[k] * (from + 0.5 * length[k]);
    from += length[k];
  }
  ZpModel *model = model_of(&def);
  for (size_t j = 0; j < model->nodes; j++) {
    if (j + 1 < model->nodes) axial -= 1 / model->rod.S[j];
    bending -= bent_by_unit_moments(&model->rod, j);
    turn -= turn_of(model->rod.k0[j]);
    mass -= model->mass[j];
    moment -= model->mass[j] * (double)j * model->l;
  }
  ck_below(fabs(axial), 1e-12 * L / (E * width * 50e-6));
  ck_below(fabs(bending) * bending_stiffness(50e-6) / L, 1e-12);
  ck_below(fabs(turn), 1e-12);
  ck_below(fabs(mass), 1e-12 * rho * width * 50e-6 * L);
  ck_below(fabs(moment), 1e-12 * rho * width * 50e-6 * L * L);
}

/* Each segment is an arc of its own curvature and continues the one before without a kink. */
TEST(test_curvature_of_each_segment) {
  const double k[] = {6, -9, 4, 0}, length[] = {0.021, 0.034, 0.017, 0.028};
  ZpActuatorDef def = beam(ZP_END_FREE, 0, 0, 121);
  def.segment_K[0].length = length[0];
  def.segment_K[0].curvature = k[0];
  def.segment_K[1].length = length[1];
  def.segment_K[1].curvature = k[1];
  def.segment_K[2].length = length[2];
  def.segment_K[2].curvature = k[2];
  double x = 0, y = 0, angle = 0;
  for (int i = 0; i < 4; i++) {
    double turned = k[i] * length[i], chord = length[i] * (turned == 0 ? 1 : sin(turned / 2) / (turned / 2));
    x += chord * cos(angle + turned / 2);
    y += chord * sin(angle + turned / 2);
    angle += turned;
  }
  ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
  double found_x = zp_table_get(result->series, 120, "x_m"), found_y = zp_table_get(result->series, 120, "y_m");
  printf("three arcs: x %+.1e, y %+.1e off\n", found_x / x - 1, found_y / y - 1);
  ck_near(found_x, x, 1e-5);
  ck_near(found_y, y, 3e-4); /* 6.7e-5 measured */
}

/* A strip that turns by `turn` from edge to edge is, unloaded, exactly the polygon of such edges, 5/12 of it at the
 * clamp and 13/12 beside it, (8.9). From 50/m on Newton's method did not come there from straight. */
TESTS(test_strong_curvature, 0, 4) {
  static const double curvatures[] = {-20, 40, 50, 100};
  enum { NODES = 11 };
  const double l = L / (NODES - 1), turn = curvatures[_i] * l;
  double x = 0, y = 0;
  for (int i = 0; i + 1 < NODES; i++) {
    double angle = turn * (i ? i + 0.5 : 5.0 / 12);
    x += l * cos(angle);
    y += l * sin(angle);
  }
  ZpActuatorDef def = beam(ZP_END_FREE, 0, 0, NODES);
  def.segment_K[0].length = L;
  def.segment_K[0].curvature = curvatures[_i];
  ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_double_eq_tol(zp_table_get(result->series, NODES - 1, "x_m"), x, 1e-9 * L);
  ck_assert_double_eq_tol(zp_table_get(result->series, NODES - 1, "y_m"), y, 1e-9 * L);
}

/* The same with a finer mesh, without load and with 8 g: an equilibrium exists. Without load the end is above the
 * clamp. */
TEST(test_curled_ribbon_is_found) {
  ZpActuatorDef def = beam(ZP_END_FREE, 0, 0, 61);
  def.segment_K[0].length = L;
  def.segment_K[0].curvature = 50;
  ck_near(value_of(ZP_STUDY_STATIONARY, &def, "stroke_m"), -(1 - cos(50 * L)) / 50, 2e-3); /* 5.2e-4 measured */
  def.load.mass = 8e-3;
  ck_assert(isfinite(value_of(ZP_STUDY_STATIONARY, &def, "stroke_m")));
}

/* -- published strokes ----------------------------------------------------------------------------- */

TEST(test_paper_fe) {
  static const double grams[] = {0, 8, 40, 60, 61, 80, 100, 150, 200};
  static const double mm[] = {0.071, 2.592, 11.81, 16.39, 16.60, 20.04, 22.91, 27.75, 30.65};
  for (size_t i = 0; i < LENGTH_OF(grams); i++) {
    ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_FE}, {"load.mass", 1e-3 * grams[i]});
    double stroke = value_of(ZP_STUDY_STATIONARY, &def, "stroke_m");
    printf("paper-fe, %g g: %.4f mm, converged %.3f mm\n", grams[i], 1e3 * stroke, mm[i]);
    /* the last digit shown of 0.071 is worth 0.7 % */
    ck_assert_double_eq_tol(1e3 * stroke, mm[i], fmax(1.5e-3 * mm[i], 5e-4)); /* 6e-4 of them measured */
  }
}

/* What damped stepping of the authors' code came to rest at, by Newton's method. */
TESTS(test_paper_code, 0, 2) {
  static const double grams[] = {40, 60, 80, 100, 150, 200};
  static const double mm[2][6] = {{12.198, 16.833, 20.584, 23.580, 28.738, 31.890},
                                  {12.261, 16.827, 20.466, 23.338, 28.224, 31.189}};
  static const double shear[] = {6031, 146115};
  for (size_t i = 0; i < LENGTH_OF(grams); i++) {
    ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", _i ? 61 : 21},
                            {"mass_spring.shear_coefficient", shear[_i]}, {"load.mass", 1e-3 * grams[i]});
    ck_assert_double_eq_tol(1e3 * value_of(ZP_STUDY_STATIONARY, &def, "stroke_m"), mm[_i][i],
                            0.005); /* 7.6e-4 measured */
  }
}

/* -- modes ----------------------------------------------------------------------------------------- */

static ZpActuatorDef modes_def(ZpRightEnd end) {
  return DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", end}, {"ribbon.length", 45e-3},
             {"ribbon.plane", ZP_PLANE_STRESS}, {"gravity", 0}, {"load.mass", 0});
}

/* The roots beta L within 0.15 %, measured at most 0.006, 0.04, 0.09 %. Lumped masses and second differences lower a
 * root by (beta l)^2 / 24 at least, 0.09 % of the third; a frequency goes with its square. */
TESTS(test_modes, 0, 2) {
  static const double roots[2][3] = {{2.365020, 5.497804, 8.639380}, {1.875104, 4.694091, 7.854757}};
  static const char *const names[] = {"frequency_1_Hz", "frequency_2_Hz", "frequency_3_Hz"};
  ZpActuatorDef def = modes_def(_i ? ZP_END_FREE : ZP_END_GUIDED);
  ZpResult *result = converged_of(ZP_STUDY_MODES, &def);
  double unit = sqrt(bending_stiffness(thickness) / (rho * width * thickness)) / (2 * M_PI * 45e-3 * 45e-3);
  for (size_t k = 0; k < 3; k++) {
    double f = zp_result_get(result, names[k]), exact = roots[_i][k] * roots[_i][k] * unit;
    printf("%s, mode %zu: %.4f Hz, %+.1e off\n", _i ? "free" : "guided", k + 1, f, f / exact - 1);
    ck_near(sqrt(f / exact), 1, 1.5e-3);
  }
  if (_i == 0) ck_near(zp_result_get(result, names[0]), 32.03, 5e-4); /* 1.4e-4 measured */
}

/* A clamped strip swings in its k-th mode with k - 1 nodes: frame k of the shapes. */
TEST(shape_of_a_mode_has_its_nodes) {
  ZpActuatorDef def = modes_def(ZP_END_FREE);
  ZpResult *result = converged_of(ZP_STUDY_MODES, &def);
  for (size_t k = 1; k <= 4; k++) {
    ZpShape shape = zp_shapes_get(result->shapes, k), rest = zp_shapes_get(result->shapes, 0);
    size_t crossings = 0;
    for (size_t i = 2; i < result->shapes->nodes; i++)
      crossings += (shape.y[i - 1] - rest.y[i - 1]) * (shape.y[i] - rest.y[i]) < 0;
    ck_assert_uint_eq(crossings, k - 1);
  }
}

/* However few rows are kept, the last one of a branch is at the voltage that was asked for. */
TEST(last_row_is_at_the_voltage) {
  for (int samples = 10; samples <= 14; samples++) {
    ZpActuatorDef def = DEF({"mesh.nodes", 15}, {"drive.voltage", 4e3}, {"output.samples", samples});
    ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
    ck_assert_uint_le(result->series->rows, (size_t)samples);
    ck_assert_double_eq(zp_table_get(result->series, result->series->rows - 1, "voltage_V"), 4e3);
  }
}

/* Eq. (11.2): an exact squared frequency lies within the bound of the residual. The reference has thirty rounds more,
 * which derivatives ask for; what its residual leaves is rounding. */
TEST(residual_of_a_mode_bounds_its_error) {
  ZpActuatorDef def = DEF({"mesh.nodes", 61});
  ZpResult *found = converged_of(ZP_STUDY_MODES, &def);
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("sensitivity.by"), "load.mass", NULL), ZP_OK);
  ZpResult *exact = converged_of(ZP_STUDY_MODES, &def);
  ck_assert_uint_eq(found->series->rows, 8);
  for (size_t j = 0; j < found->series->rows; j++) {
    double ratio = zp_table_get(found->series, j, "frequency_Hz") / zp_table_get(exact->series, j, "frequency_Hz");
    double residual = zp_table_get(found->series, j, "residual"), rest = zp_table_get(exact->series, j, "residual");
    printf("mode %zu: residual %.1e, error %.1e; refined %.1e\n", j + 1, residual, fabs(ratio * ratio - 1), rest);
    ck_assert_double_gt(rest, 0);
    ck_assert_double_lt(fabs(ratio * ratio - 1), residual + rest + 1e-14); /* rounding of the ratio */
    ck_below(residual, 1e-6);
    ck_below(rest, 3e-11); /* 3.1e-12 measured */
  }
}

/* The error of the third mode is of order l^2: extrapolated, it is that of the beam. */
TEST(test_modes_converge) {
  static const int nodes[] = {61, 121};
  double f[2], unit = sqrt(bending_stiffness(thickness) / (rho * width * thickness)) / (2 * M_PI * 45e-3 * 45e-3);
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = modes_def(ZP_END_GUIDED);
    def.mesh.nodes = nodes[k];
    f[k] = value_of(ZP_STUDY_MODES, &def, "frequency_3_Hz");
  }
  ck_near((4 * f[1] - f[0]) / 3, 8.639380 * 8.639380 * unit, 2e-5); /* 4.9e-6 measured */
}

/* Its own outcome instead of "not settled". Newton's method alone would jump: at 5.7, 8 and 10 kV it finds closed
 * states, which are stable, too. */
TEST(test_modes_above_pull_in) {
  static const double above[] = {5663, 5700, 8e3, 10e3};
  ZpActuatorDef def = DEF({"modes.voltage", 5661.5});
  /* pull-in at 5662.0 V: the lowest frequency falls to 0 there */
  ck_below(value_of(ZP_STUDY_MODES, &def, "frequency_1_Hz"), 1.5);
  for (size_t i = 0; i < LENGTH_OF(above); i++) {
    def.modes.voltage = above[i];
    ZpResult *result = study_of(ZP_STUDY_MODES, &def);
    ck_assert_msg(result->outcome == ZP_PULLED_IN, "%g V: %s", above[i], result->message);
    ck_assert(zp_outcome_good(result->outcome));
    ck_assert_str_eq(zp_outcome_name(result->outcome), "pulled_in");
    ck_assert_double_nan(zp_result_get(result, "frequency_1_Hz"));
  }
}

/* -- pull-in --------------------------------------------------------------------------------------- */

/* A ribbon over a flat electrode at distance g << L, in a medium like vacuum, the cap far below the gaps met; thick,
 * so that its forces stand far above what rounding in stiff edges leaves. */
static ZpActuatorDef flange_def(ZpRightEnd end, double b, double g) {
  const double eps0 = 8.8541878128e-12, thick = 1e-3;
  double V = sqrt(2 * b * bending_stiffness(thick) * g * g * g / (eps0 * width * L * L * L * L));
  return DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", end}, {"ribbon.length", L},
             {"ribbon.plane", ZP_PLANE_STRESS}, {"gravity", 0}, {"load.mass", 0}, {"ribbon.thickness", thick},
             {"insulator.thickness", 0}, {"medium.permittivity", 1}, {"medium.breakdown_field", V / (0.1 * g)},
             {"electro.gap_offset", g}, {"drive.voltage", 1.2 * V}, {"output.samples", 20000});
}

TESTS(test_pull_in, 0, 2) {
  static const double b[] = {4.38094, 1.68084}, travel[] = {0.3967, 0.4465};
  const double g = 1e-3;
  ZpActuatorDef def = flange_def(_i ? ZP_END_FREE : ZP_END_GUIDED, b[_i], g);
  double V = def.drive.voltage / 1.2, found = zp_result_get(study_of(ZP_STUDY_EQUILIBRIUM, &def), "pull_in_voltage_V");
  Point limit = limit_of(&def);
  printf("%s: b %.5f, travel %.4f g\n", _i ? "free" : "guided", b[_i] * found * found / (V * V),
         -limit.stroke / g);                 /* drawn up */
  ck_near(found * found / (V * V), 1, 5e-4); /* 1.2e-4 measured */
  ck_near(limit.voltage, found, 1e-5);
  ck_near(-limit.stroke / g, travel[_i], 2e-3);
}

/* Regression: without weight the residual was relative to 1 mN, far above the forces of a thin flange: its pull-in
 * became worse with a finer mesh, for any tolerance: 63.41, 63.46, 63.79, 65.09 V for N = 61 to 481. */
TEST(test_weightless_flange_converges) {
  const double g = 0.2e-3, eps0 = 8.8541878128e-12, length = 45e-3;
  double exact = sqrt(2 * 4.38094 * bending_stiffness(thickness) * g * g * g / (eps0 * width * pow(length, 4)));
  double found[3];
  for (int i = 0; i < 3; i++) {
    ZpActuatorDef def = flange_def(ZP_END_GUIDED, 4.38094, g);
    def.ribbon.length = length;
    def.ribbon.thickness = thickness;
    def.medium.breakdown_field = 20e6;
    def.mesh.nodes = 120 * (1 << i) + 1;
    def.drive.voltage = 1.1 * exact;
    found[i] = limit_of(&def).voltage;
  }
  printf("weightless flange: %.4f, %.4f, %.4f V, classical %.4f V\n", found[0], found[1], found[2], exact);
  for (int i = 0; i < 3; i++)
    ck_near(found[i], exact, 3e-5); /* 1.9e-5 measured */
}

/* Without weight the stroke starts from 0, and any change of it counted as a jump to another branch. */
TEST(test_weightless_flange_is_raised) {
  ZpActuatorDef def = flange_def(ZP_END_GUIDED, 4.38094, 0.2e-3);
  double V = def.drive.voltage / 1.2;
  def.modes.voltage = 0.99 * V;
  ck_assert_double_gt(value_of(ZP_STUDY_MODES, &def, "frequency_1_Hz"), 0);
  def.modes.voltage = 1.01 * V;
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  ck_assert_int_eq(result->outcome, ZP_PULLED_IN);
}

/* -- the default actuator ---------------------------------------------------------------------------- */

static ZpActuatorDef voltage_def(double mass, int nodes) {
  return DEF({"load.mass", mass}, {"mesh.nodes", nodes}, {"output.samples", 20000}, {"output.shapes", 2000});
}

/* How often the voltage turns round along branch 0, be it ever so little. */
static int turns(const ZpTable *t) {
  int count = 0;
  for (size_t row = 1; row + 1 < t->rows && zp_table_get(t, row + 1, "branch") == 0; row++) {
    double U = zp_table_get(t, row, "voltage_V");
    double before = U - zp_table_get(t, row - 1, "voltage_V"), after = zp_table_get(t, row + 1, "voltage_V") - U;
    count += before * after < 0;
  }
  return count;
}

TESTS(test_mesh_independence, 0, FULL_OR(1, 0)) {
  double pull_in[2], release[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = voltage_def(8e-3, k ? 241 : 121);
    ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
    ck_assert_msg(result->outcome == ZP_FOLLOWED, "%s", result->message);
    pull_in[k] = zp_result_get(result, "pull_in_voltage_V");
    release[k] = zp_result_get(result, "release_voltage_V");
    printf("N = %d: %s\n", def.mesh.nodes, result->message);
  }
  ck_near(pull_in[0], pull_in[1], 5e-4); /* 1.4e-4 measured */
  ck_near(release[0], release[1], 5e-6); /* 1.5e-6 measured */
}

/* Hanging is stable up to pull-in, what connects it to closed is not, closed is. Where the first nodes touch, the
 * voltage along the middle leg may ripple by less than a thousandth and a point there be stable: measured 1 of 170. */
TEST(test_default_branches) {
  ZpActuatorDef def = voltage_def(8e-3, 61);
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  const ZpTable *t = result->series;
  ck_assert_msg(result->outcome == ZP_FOLLOWED, "%s", result->message);
  ck_assert_int_eq(turns(t), 2);
  double pull_in = zp_result_get(result, "pull_in_voltage_V"), release = zp_result_get(result, "release_voltage_V");
  int leg = 0, wrong[3] = {0}; /* 0 hanging, 1 in between, 2 closed */
  for (size_t row = 1; row < t->rows; row++) {
    double U = zp_table_get(t, row, "voltage_V"), before = zp_table_get(t, row - 1, "voltage_V");
    if ((leg == 0 && U < before) || (leg == 1 && U > before)) leg++;
    /* a point may lie on either side of a limit point that close to it */
    if (fabs(U / pull_in - 1) < 1e-3 || fabs(U / release - 1) < 1e-3) continue;
    wrong[leg] += (int)zp_table_get(t, row, "stable") != (leg != 1);
  }
  printf("8 g: %zu points; flags of stability off in %d, %d, %d\n", t->rows, wrong[0], wrong[1], wrong[2]);
  ck_assert_int_eq(leg, 2);
  ck_assert_int_eq(wrong[0], 0);
  ck_assert_int_eq(wrong[1], 0);
  ck_assert_int_eq(wrong[2], 0);
}

/* Under 61 g it hangs open at 10 kV, and stays closed if it is closed. */
TEST(test_heavy_load) {
  ZpActuatorDef def = voltage_def(61e-3, 61);
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  const ZpTable *t = result->series;
  ck_assert_double_nan(zp_result_get(result, "pull_in_voltage_V"));
  size_t closed = 0;
  while (closed < t->rows && zp_table_get(t, closed, "branch") == 0)
    closed++;
  ck_assert_uint_lt(closed, t->rows);
  ck_assert_double_eq(zp_table_get(t, closed, "stable"), 1);
  ck_assert_double_gt(zp_table_get(t, closed, "zipped_length_m"), 40e-3);
  ck_below(zp_result_get(result, "release_voltage_V"), 10e3);
  printf("61 g: %s, release %g V\n", result->message, zp_result_get(result, "release_voltage_V"));
}

TEST(test_faces_do_not_cross) {
  static const double grams[] = {8, 61};
  for (size_t i = 0; i < LENGTH_OF(grams); i++) {
    ZpActuatorDef def = voltage_def(1e-3 * grams[i], 61);
    ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
    double least = INFINITY;
    for (size_t f = 0; f < result->shapes->frames; f++) {
      ZpShape shape = zp_shapes_get(result->shapes, f);
      for (size_t k = 0; k < 61; k++)
        least = fmin(least, shape.gap[k]);
    }
    printf("%g g: faces overlap by %.3f um at most\n", grams[i], -1e6 * least);
    ck_assert_double_ge(least, -0.01 * 260e-6); /* of both insulators */
  }
}

/* -- release --------------------------------------------------------------------------------------- */

static double release_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = study_of(study, def);
  double release = zp_result_get(result, "release_voltage_V"), closing = zp_result_get(result, "closing_voltage_V");
  printf("%s; closes at %g V\n", result->message, closing);
  ck_assert_msg(result->outcome == ZP_FOLLOWED, "%s", result->message);
  ck_assert(!(release > closing));
  return release;
}

static ZpActuatorDef long_def(int nodes) {
  return DEF({"ribbon.length", 166e-3}, {"ribbon.thickness", 21e-6}, {"load.mass", 6e-3}, {"platform.length", 30e-3},
             {"drive.voltage", 15e3}, {"mesh.nodes", nodes});
}

/* Regression: the last of all limit points, or of the first 256, was taken for the release: 529, 509, 683, 5764 V for N
 * = 31, 61, 91, 121 where a slow ramp opens at 493 V. */
TESTS(test_release_of_a_long_actuator, 0, FULL_OR(1, 0)) {
  ZpActuatorDef coarse = long_def(61), fine = long_def(91);
  double release[] = {release_of(ZP_STUDY_EQUILIBRIUM, &coarse), release_of(ZP_STUDY_EQUILIBRIUM, &fine)};
  ck_near(release[0], release[1], 0.01); /* 2.2e-3 measured */
  ck_near(release[1], 500, 0.015);       /* 1.6e-3 measured */
}

static ZpActuatorDef small_flange(double voltage) {
  return DEF({"actuator.kind", ZP_KIND_FLANGE}, {"ribbon.length", 65e-3}, {"ribbon.thickness", 100e-6},
             {"load.mass", 0}, {"electro.gap_offset", 0.1e-3}, {"insulator.thickness", 10e-6},
             {"drive.voltage", voltage});
}

/* The release of a flange does not depend on the voltage at which it was closed; before, at 300 V it was reported as
 * its pull-in. Across the sharp fold of its pull-in the branch is not followed back. */
TEST(test_release_whatever_closed_it) {
  static const double voltages[] = {300, 500, 1e3, 3e3};
  for (size_t i = 0; i < LENGTH_OF(voltages); i++) {
    ZpActuatorDef def = small_flange(voltages[i]);
    ck_near(release_of(ZP_STUDY_EQUILIBRIUM, &def), 21.162, 2e-4); /* 5.2e-5 measured */
  }
}

/* Voltage at which a slow fall from `high` V, closed, to `low` V opens what the study says it does; slow motion is
 * damped so that it does not shake itself open. Of ribbons that is 99 % of contraction, of a flange a tenth of the way
 * of its end. */
static double opened_by_ramp(ZpActuatorDef def, double closing, double high, double low) {
  enum { STEPS = 250 };
  const double slow = 2, end = 6;
  def.initial.state = ZP_INITIAL_STRAIGHT;
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  def.damping.internal = 1e-3;
  ZpSim *sim = sim_of(
      driven_model_of(&def, 5, (double[]){0, 0.2, 1, slow, end}, (double[]){closing, closing, 1.5 * high, high, low}));
  double voltage = high, closed = NAN;
  for (int k = 0; k <= STEPS; k++) {
    zp_sim_run(sim, slow + (end - slow) * k / STEPS, false, NULL, NULL);
    bool ribbons = def.actuator.kind == ZP_KIND_ELECTRO_RIBBON;
    double now = zp_sim_get(sim, ribbons ? "contraction" : "stroke");
    if (k == 0) closed = now;
    voltage = zp_sim_get(sim, "voltage");
    if (fabs(now / closed - 1) > (ribbons ? 0.01 : 0.1)) break;
  }
  return voltage;
}

/* The release of equilibria is the voltage at which a motion under slowly falling voltage opens. */
TESTS(test_release_is_that_of_a_slow_ramp, 0, 4) {
  const ZpActuatorDef defs[] = {
      voltage_def(8e-3, 61),
      DEF({"ribbon.length", 89e-3}, {"ribbon.thickness", 100e-6}, {"load.mass", 39e-3}, {"platform.length", 15e-3},
          {"insulator.thickness", 200e-6}),
      DEF({"ribbon.length", 151e-3}, {"load.mass", 29e-3}, {"platform.length", 7e-3}, {"insulator.thickness", 25e-6}),
      small_flange(500),
  };
  double release = release_of(ZP_STUDY_EQUILIBRIUM, &defs[_i]);
  bool flange = defs[_i].actuator.kind == ZP_KIND_FLANGE;
  double ramp = opened_by_ramp(defs[_i], flange ? 300 : 1.05 * release, 1.05 * release, 0.97 * release);
  printf("release %.4g V, by a ramp %+.2e off\n", release, ramp / release - 1);
  ck_near(ramp, release, 0.01); /* 2.2e-3 measured */
}

/* What is never closed has no release, and the message says why. */
TEST(test_no_release) {
  ZpActuatorDef low = DEF({"drive.voltage", 500});
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &low);
  ck_assert_double_nan(zp_result_get(result, "release_voltage_V"));
  ck_assert_double_nan(zp_result_get(result, "closing_voltage_V"));
  ck_assert_ptr_nonnull(strstr(result->message, "no release: it is not closed at drive.voltage"));
}

/* -- extremes -------------------------------------------------------------------------------------- */

/* Whatever is asked, an outcome and a message. */
TESTS(test_extremes, 0, 3) {
  static const ZpStudy studies[] = {ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_MODES};
  static const Setting extremes[] = {{"load.mass", 1e3}, {"mesh.nodes", 4}, {"drive.voltage", 0}};
  for (size_t i = 0; i < LENGTH_OF(extremes); i++) {
    ZpActuatorDef def = DEF(extremes[i]);
    ZpResult *result = study_of(studies[_i], &def);
    printf("%s = %g: %s, %s\n", extremes[i].key, extremes[i].value, zp_outcome_name(result->outcome), result->message);
    ck_assert(*result->message);
    bool good = zp_outcome_good(result->outcome);
    ck_assert(good || i == 0);
    for (size_t k = 0; k < result->scalars; k++)
      ck_assert(!isinf(result->scalar[k].value));
  }
}

/* -- main ------------------------------------------------------------------------------------------ */

/* Both ends clamped, sagging under its own weight: w L^4 / (384 EI). The nodes are corners of a polygon around the
 * ribbon, (8.8); what weight the edges at the clamps hand on makes an error that goes with l^3. */
TEST(test_order_between_clamps) {
  static const int nodes[] = {17, 31, 61};
  double gravity = 1e-3, scaled[3];
  for (int i = 0; i < 3; i++) {
    ZpActuatorDef def =
        DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_CLAMPED}, {"ribbon.length", L},
            {"ribbon.plane", ZP_PLANE_STRESS}, {"gravity", gravity}, {"load.mass", 0}, {"mesh.nodes", nodes[i]});
    double exact = rho * width * thickness * gravity * L * L * L * L / (384 * bending_stiffness(thickness));
    ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
    size_t middle = (size_t)(nodes[i] - 1) / 2;
    double at = zp_table_get(result->series, middle, "y_m"), beside = zp_table_get(result->series, middle - 1, "y_m");
    double sag = -(at + (beside - at) / 6); /* its neighbours are alike */
    scaled[i] = (sag / exact - 1) * pow(nodes[i] - 1, 3);
  }
  printf("between clamps: error times (N-1)^3 %.4f, %.4f, %.4f\n", scaled[0], scaled[1], scaled[2]);
  ck_near(scaled[0], scaled[2], 0.05); /* 0.039 measured */
  ck_near(scaled[1], scaled[2], 0.05); /* 0.035 measured */
}

/* -- a saved point --------------------------------------------------------------------------------- */

/* What a branch goes back to holds its load and its voltage. */
TEST(test_restored_with_load_and_voltage) {
  ZpActuatorDef def = zp_actuator_def_default();
  ZpModel *model = model_of(&def);
  ZpStatics statics;
  ck_assert(zp_statics_create(model, false, &statics));
  ZpBranchSystem system = zp_statics_branch(&statics, ZP_ALONG_LOAD);
  void *saved = zp_calloc(1, system.save_size);
  statics.U = 123;
  statics.load = 0.02;
  statics.member->q[7] = 0.5;
  system.save(&statics, saved);
  statics.U = statics.load = statics.member->q[7] = 0;
  system.restore(&statics, saved);
  ck_assert(statics.U == 123 && statics.load == 0.02 && statics.member->q[7] == 0.5);
  zp_free(saved);
  zp_statics_destroy(&statics);
}

/* -- along the load -------------------------------------------------------------------------------- */

/* The branch along the load passes through the equilibria found from straight, and is stable everywhere. */
TEST(test_branch_along_the_load) {
  ZpActuatorDef def = DEF({"load.mass", 0.008});
  ZpModel *model = model_of(&def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  rest.system = zp_statics_branch(&rest.statics, ZP_ALONG_LOAD);
  ZpStatics *s = &rest.statics;
  ck_assert(zp_newton_good(zp_statics_find_rest(s).end));
  ck_assert(zp_rest_follow_by(&rest, true, 0.01, 1));
  int points = 0;
  for (; s->load < 0.03 && points < 2000; points++) {
    ck_assert(zp_branch_advance(&rest.branch));
    ck_assert(rest.branch.direction_m > 0);
    ck_assert(zp_statics_stable(s));
  }
  ck_assert_double_ge(s->load, 0.03);
  def.load.mass = s->load;
  printf("along the load: %d points to %.4g g, stroke %.6f mm\n", points, 1e3 * s->load, 1e3 * zp_statics_stroke(s));
  /* both to a residual of 1e-7; 2.2e-16 measured */
  ck_near(zp_statics_stroke(s), value_of(ZP_STUDY_STATIONARY, &def, "stroke_m"), 1e-12);
  zp_rest_close(&rest);
}

/* Each half of weightless ribbons carries half of the load straight down, and nothing pulls a clip sideways: along the
 * lower ribbon that load and a constant force across it make the tension of each edge. The force across is 0 between
 * equal ribbons; a thicker lower one is pressed together. */
TESTS(tension_carries_the_load_along_the_slope, 0, 2) {
  static const double load = 0.1;
  ZpActuatorDef def = DEF({"mesh.nodes", 15}, {"gravity", 0}, {"load.force", load});
  if (_i == 1) def.lower.ribbon.thickness = 2 * def.ribbon.thickness;
  ZpResult *result = converged_of(ZP_STUDY_STATIONARY, &def);
  const ZpTable *t = result->series;
  int edges = 0;
  double across = 0, worst = 0;
  for (size_t k = 0; k + 1 < t->rows; k++) {
    double tension = zp_table_get(t, k, "tension_N"), dx = zp_table_get(t, k + 1, "x_m") - zp_table_get(t, k, "x_m"),
           dy = zp_table_get(t, k + 1, "y_m") - zp_table_get(t, k, "y_m");
    if (_i == 0) ck_near(zp_table_get(t, k, "upper_stress_Pa"), zp_table_get(t, k, "stress_Pa"), 1e-9);
    if (isnan(tension)) continue; /* the platform is rigid */
    double force = (tension * hypot(dx, dy) + 0.5 * load * dy) / dx;
    if (edges++ == 0 && _i == 1) across = force;
    worst = fmax(worst, fabs(force - across) / load);
  }
  printf("%d edges, force across of %.3g mN, apart by %.1e of the load\n", edges, 1e3 * across, worst);
  ck_assert_int_eq(edges, def.mesh.nodes - 1);
  ck_assert(_i == 0 || across < -1e-2 * load);
  ck_below(worst, 1e-8); /* 3.2e-9 measured */
}
