/* What the materials see: the stress of the metal and the field in the insulators, and how far that is from what they
 * withstand. Against: closed forms of beams and of a plane capacitor; the derivative of the bending energy; stresses
 * that an independent continuum code found. */
#include "check_util.h"

#include "actuator/eval.h"
#include "actuator/shape.h"
#include "electro/series.h"

/* -- stress of given shapes ------------------------------------------------------------------------------ */

enum { MOST = 2048 };

/* (model, positions of its nodes, which lie beyond the last as if the ribbon went on) => stress */
static void stress_of(const ZpModel *model, const double *x, const double *y, double *stress) {
  ck_assert_uint_le(model->stride, MOST);
  zp_stress(&model->stress, x, y, NULL, stress);
}

#define STRIP                                                                                                          \
  {"actuator.kind", ZP_KIND_RIBBON}, {"ribbon.density", 0}, {                                                          \
    "load.mass", 0                                                                                                     \
  }

/* Largest stress over the inner nodes of a strip on a circle, over E' kappa b / 2. */
static double stress_on_a_circle(int nodes) {
  static const double curvature = 20, L = 0.1; /* 1/m, m */
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", nodes}, {"ribbon.length", L});
  ZpModel *model = model_of(&def);
  double x[MOST] = {0}, y[MOST] = {0}, stress[MOST], angle = curvature * model->l;
  for (size_t i = 1; i < model->nodes; i++) { /* edges as long as at rest, each turned by the same angle */
    x[i] = x[i - 1] + model->l * cos(angle * ((double)i - 0.5));
    y[i] = y[i - 1] + model->l * sin(angle * ((double)i - 0.5));
  }
  stress_of(model, x, y, stress);
  double E = def.ribbon.young_modulus / (1 - def.ribbon.poisson_ratio * def.ribbon.poisson_ratio);
  return stress[model->nodes / 2] / (E * curvature * def.ribbon.thickness / 2);
}

TEST(bending_to_a_circle_is_fourth_order) {
  double coarse = stress_on_a_circle(21) - 1, fine = stress_on_a_circle(41) - 1;
  ck_near(coarse / fine, 16, 2e-3); /* 6e-4 measured */
  ck_below(fabs(coarse), 2e-5);     /* 5e-6 measured */
}

/* A strip under a strain has the stress E times this strain everywhere; tape bonded to it does not change that. */
TEST(stretching_is_youngs_modulus_times_strain) {
  static const double strain = 1e-3;
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 21}, {"insulator.young_modulus", 5e9});
  ZpModel *model = model_of(&def);
  double x[MOST], y[MOST] = {0}, stress[MOST];
  for (size_t j = 0; j < model->stride; j++)
    x[j] = (1 + strain) * (double)j * model->l;
  stress_of(model, x, y, stress);
  for (size_t j = 0; j < model->nodes; j++)
    ck_near(stress[j], 200e9 * strain, 5e-11); /* rounding of the length over the strain; 6.5e-12 measured */
}

/* A tension that increases linearly along the strip, as under its weight, is exact at the ends, too, half an edge
 * beyond the last known value. */
TEST(tension_at_the_ends_is_extrapolated) {
  static const double slope = 1e-2; /* of the strain, 1/m */
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 21});
  ZpModel *model = model_of(&def);
  double x[MOST], y[MOST] = {0}, stress[MOST];
  for (size_t j = 0; j < model->stride; j++) {
    double s = (double)j * model->l;
    x[j] = s + slope * s * s / 2;
  }
  stress_of(model, x, y, stress);
  ck_below(fabs(stress[0]) / stress[model->nodes - 1], 1e-12);        /* 0 measured */
  ck_near(stress[model->nodes - 1], 200e9 * slope * model->L, 1e-11); /* 1.9e-12 measured */
}

/* The moment of a joint is the derivative of the bending energy with respect to the rotation of all that is beyond it.
 */
TEST(moment_is_derivative_of_energy) {
  static const double step = 1e-5;
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 15}, {"actuator.right_end", ZP_END_FREE}, {"segment_1.length", 33e-3},
                          {"segment_1.thickness", 30e-6}, {"segment_1.curvature", 15});
  ZpModel *model = model_of(&def);
  ZpEval eval;
  ck_assert(zp_eval_create(model, &eval));
  double x[MOST] = {0}, y[MOST] = {0}, stress[MOST], energy[2];
  for (size_t joint = 0; joint + 1 < model->nodes; joint++) {
    for (int sign = 1; sign >= -1; sign -= 1) {
      double direction = 0;
      for (size_t i = 1; i < model->nodes; i++) {
        direction += 0.05 * sin((double)i) + (i - 1 == joint ? sign * step : 0);
        x[i] = x[i - 1] + model->l * cos(direction);
        y[i] = y[i - 1] + model->l * sin(direction);
      }
      zp_rod_eval(&model->rod, x, y, &eval.rod);
      if (sign == 0) stress_of(model, x, y, stress);
      if (sign != 0) energy[sign < 0] = zp_rod_bending_energy(&model->rod, &eval.rod);
    }
    double moment = fabs(energy[0] - energy[1]) / (2 * step);
    ck_near(stress[joint], moment * model->stress.per_moment[joint], 1e-9); /* 1.4e-10 measured */
  }
  zp_eval_destroy(&eval);
}

/* -- stress at rest --------------------------------------------------------------------------------------- */

/* The moment at the clamp is load times lever, whatever bends: the stress is 6 M / (w b^2) in plane strain and in plane
 * stress, of the rod and of the paper's springs. */
static const struct {
  ZpRibbonModel model;
  ZpPlane plane;
} cantilevers[] = {
    {ZP_RIBBON_ROD, ZP_PLANE_STRAIN}, {ZP_RIBBON_ROD, ZP_PLANE_STRESS}, {ZP_RIBBON_MASS_SPRING, ZP_PLANE_STRAIN}};

TESTS(stress_of_a_cantilever, 0, LENGTH_OF(cantilevers)) {
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 31}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 2e-6},
                          {"ribbon.model", cantilevers[_i].model}, {"ribbon.plane", cantilevers[_i].plane});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  double lever = zp_table_get(result->series, 30, "x_m"), M = 2e-6 * 9.81 * lever;
  double stress = 6 * M / (def.ribbon.width * def.ribbon.thickness * def.ribbon.thickness);
  ck_near(zp_result_get(result, "max_stress_Pa"), stress, 1e-5); /* 1.1e-6 measured */
  ck_assert_double_eq(zp_result_get(result, "max_stress_place_m"), 0);
  ck_near(zp_result_get(result, "yield_margin"), 1.1e9 / stress, 1e-5);
  ck_near(zp_table_get(result->series, 15, "stress_Pa"), stress / 2, 1e-5); /* half the lever; 1.7e-6 measured */
}

/* A naturally curved strip that is held straight is bent all along: the stress of its metal is E' kappa c, c the
 * distance of the outer fibre from the neutral axis, which a stiff tape shifts. */
TEST(stress_of_pure_bending) {
  static const double curvature = 10, tape = 20e9; /* 1/m, Pa */
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 201}, {"segment_1.length", 0.1}, {"segment_1.curvature", curvature});
  double b = def.ribbon.thickness, t = def.insulator.thickness, E = 200e9 / (1 - 0.285 * 0.285);
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_near(zp_result_get(result, "max_stress_Pa"), E * curvature * b / 2, 2e-10); /* 2.8e-11 measured */
  def.insulator.young_modulus = tape;
  result = study_of(ZP_STUDY_STATIONARY, &def);
  double c = (E * b * b / 2 + tape * t * (b + t / 2)) / (E * b + tape * t);
  ck_near(zp_result_get(result, "max_stress_Pa"), E * curvature * c, 1e-10); /* 1.8e-11 measured */
}

/* The free end of a limp strip that hangs down carries the load without bending: N / A. */
TEST(stress_of_a_hanging_strip) {
  ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 201}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 0.1},
                          {"ribbon.thickness", 10e-6});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_near(zp_table_get(result->series, 200, "stress_Pa"), 0.1 * 9.81 / (12.7e-3 * 10e-6), 2e-9); /* 3e-10 measured */
}

/* A moment acts on the thickness of each segment; where two segments meet, the thinner one has the higher stress. The
 * joint half an edge from the end of a segment between nodes has it, too. */
TEST(stress_of_segments) {
  static const double ends[] = {50e-3, 51.9e-3, 49.1e-3}; /* at a node; between, nearer to it */
  for (size_t k = 0; k < LENGTH_OF(ends); k++) {
    ZpActuatorDef def = DEF(STRIP, {"mesh.nodes", 21}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 1e-6},
                            {"segment_1.length", ends[k]}, {"segment_1.thickness", 25e-6});
    ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
    double M = 1e-6 * 9.81 * 0.1, thin = 6 * M / (12.7e-3 * 25e-6 * 25e-6), thick = thin / 4;
    ck_near(zp_table_get(result->series, 0, "stress_Pa"), thin, 2e-4);          /* 3.9e-5 measured */
    ck_near(zp_table_get(result->series, 10, "stress_Pa"), thin / 2, 2e-4);     /* 5.7e-5 measured */
    ck_near(zp_table_get(result->series, 11, "stress_Pa"), thick * 0.45, 2e-4); /* 5.6e-5 measured */
  }
}

/* Stress at the clamps of the actuators of 2018 under the largest published loads, against an independent continuum
 * code, three digits. */
TESTS(stress_of_published_actuators, 0, 3) {
  static const double thickness[] = {20e-6, 50e-6, 100e-6}, load[] = {15e-3, 30e-3, 50e-3};
  static const double stress[] = {589e6, 492e6, 280e6};
  ZpActuatorDef def = DEF({"ribbon.thickness", thickness[_i]}, {"load.mass", load[_i]}, {"platform.length", 0},
                          {"ribbon.density", 0}, {"ribbon.plane", ZP_PLANE_STRESS}, {"mesh.nodes", 241});
  ck_near(zp_result_get(study_of(ZP_STUDY_STATIONARY, &def), "max_stress_Pa"), stress[_i], 2e-3); /* 1.6e-3 measured */
}

/* -- the insulators' field -------------------------------------------------------------------------------- */

/* D is continuous: the charge per length of the uncapped law is eps0 eps_i w E, at every gap. */
TEST(field_in_insulators_carries_the_charge) {
  ZpActuatorDef def = DEF({"electro.breakdown_cap", 0});
  ZpModel *model = model_of(&def);
  for (double gap = 0; gap < 5e-3; gap += 0.5e-3) {
    double E = zp_series_at(&model->series, -7e3, gap).insulator;
    ck_near(E, 7e3 / (260e-6 + gap * 4.62 / 2.75), 1e-13);
    ck_near(ZP_EPS0 * 4.62 * 12.7e-3 * E, zp_plates_law(&model->plates, 7e3, gap).q, 1e-13);
    ck_near(zp_series_at(&model->series, 7e3, gap).liquid, E * 4.62 / 2.75, 1e-13);
  }
}

#define QUICK                                                                                                          \
  {"mesh.nodes", FULL_OR(31, 15)}, {                                                                                   \
    "solver.end_time", 5e-3                                                                                            \
  }

static const ZpStudy under_voltage[] = {ZP_STUDY_ACTUATE,   ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS,
                                        ZP_STUDY_ISOMETRIC, ZP_STUDY_PROFILE,     ZP_STUDY_MODES};

/* Two ribbons touch at the clip, so their insulators share the whole voltage there: every study gives U / 2t, the
 * margin to 40 MV/m, and an allowed voltage of 10.4 kV. */
TESTS(every_study_has_its_margins, 0, LENGTH_OF(under_voltage)) {
  bool modes = under_voltage[_i] == ZP_STUDY_MODES, solved = under_voltage[_i] == ZP_STUDY_PROFILE;
  double U = modes ? 3e3 : 10e3, tolerance = solved ? 1e-4 : 1e-13;
  ZpActuatorDef def = DEF(QUICK, {"modes.voltage", 3e3});
  ZpResult *result = study_of(under_voltage[_i], &def);
  ck_near(zp_result_get(result, "insulator_field_V_per_m"), U / 260e-6,
          tolerance); /* 1.2e-5 measured where 1e-4 is allowed */
  ck_assert_double_eq(zp_result_get(result, "insulator_field_place_m"), 0);
  ck_near(zp_result_get(result, "breakdown_margin"), 40e6 * 260e-6 / U,
          tolerance); /* 1.2e-5 measured where 1e-4 is allowed */
  ck_near(zp_result_get(result, "allowed_voltage_V"), 10400, 1e-13);
  double stress = zp_result_get(result, "max_stress_Pa");
  ck_assert(stress > 1e6 && stress < 1e9);
  ck_near(zp_result_get(result, "yield_margin"), 1.1e9 / stress, 1e-13);
  ck_assert(zp_result_get(result, "max_stress_place_m") <= 45.0001e-3);
  ck_assert_uint_eq(notes_with(result, "yield"), 0);
  def.ribbon.yield_stress = 0.99 * stress;
  result = study_of(under_voltage[_i], &def);
  ck_assert_uint_gt(notes_with(result, "above its yield stress"), 0);
  ck_near(zp_result_get(result, "yield_margin"), 0.99, 1e-13);
}

/* A flange that hangs open has a lower field than closed faces, highest at its smallest gap, the clamp; its allowed
 * voltage is that of closed faces. Without insulators there is no margin. */
TEST(open_flange_sees_the_series_law) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"mesh.nodes", 31}, {"ribbon.length", 45e-3}, {"electro.gap_offset", 1e-3},
          {"gravity", 1}, {"load.mass", 0}, {"insulator.thickness", 10e-6}, {"drive.voltage", 100});
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  double field = 100 / (2 * 10e-6 + 1e-3 * 4.62 / 2.75);
  ck_near(zp_result_get(result, "insulator_field_V_per_m"), field, 1e-12);
  ck_assert_double_eq(zp_result_get(result, "insulator_field_place_m"), 0);
  ck_near(zp_result_get(result, "breakdown_margin"), 40e6 / field, 1e-12);
  ck_near(zp_result_get(result, "allowed_voltage_V"), 2 * 10e-6 * 40e6, 1e-12);
  ZpShape last = zp_shapes_get(result->shapes, result->shapes->frames - 1);
  ck_assert_ptr_nonnull(last.insulator_field);
  for (size_t i = 0; i < 31; i++)
    ck_near(last.insulator_field[i], 100 / (2 * 10e-6 + last.gap[i] * 4.62 / 2.75), 1e-12);
  def.insulator.thickness = 0;
  result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  ck_assert(isnan(zp_result_get(result, "insulator_field_V_per_m")));
  ck_assert(isnan(zp_result_get(result, "breakdown_margin")) && isnan(zp_result_get(result, "allowed_voltage_V")));
  ck_assert(zp_result_get(result, "max_stress_Pa") > 0);
}

/* -- over time and along branches ------------------------------------------------------------------------- */

static size_t worst_row(const ZpTable *series) {
  size_t worst = 0;
  for (size_t i = 1; i < series->rows; i++)
    if (zp_table_get(series, i, "max_stress_Pa") > zp_table_get(series, worst, "max_stress_Pa")) worst = i;
  return worst;
}

/* Is this the first step in a tenth of a millisecond, of which a shorter table has a row? */
static bool is_sampled(const ZpTable *series, size_t row) {
  static const double interval = 1e-4; /* s */
  double before = row > 0 ? zp_table_get(series, row - 1, "time_s") : -interval;
  return floor(before / interval) < floor(zp_table_get(series, row, "time_s") / interval);
}

/* The summary has the worst of all steps: of those that are rows of a table long enough for all, and the same where few
 * are. */
TEST(worst_survives_thinning) {
  ZpActuatorDef def =
      DEF({"mesh.nodes", 23}, {"solver.end_time", 30e-3}, {"solver.tolerance", 1e-4}, {"output.samples", 1000000});
  ZpResult *fine = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_double_eq((double)fine->series->rows, zp_result_get(fine, "steps") + 1);
  ck_assert(!is_sampled(fine->series, worst_row(fine->series)));
  def.output.samples = 10;
  ZpResult *thin = study_of(ZP_STUDY_ACTUATE, &def);
  double worst = 0, of_thin = 0;
  for (size_t i = 0; i < fine->series->rows; i++)
    worst = fmax(worst, zp_table_get(fine->series, i, "max_stress_Pa"));
  for (size_t i = 0; i < thin->series->rows; i++)
    of_thin = fmax(of_thin, zp_table_get(thin->series, i, "max_stress_Pa"));
  ck_assert_double_eq(zp_result_get(fine, "max_stress_Pa"), worst);
  ck_assert_double_eq(zp_result_get(thin, "max_stress_Pa"), worst);
  ck_assert(of_thin < worst);
}

/* Column, shapes and signal agree at any instant. */
TEST(column_film_and_signal_agree) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"solver.end_time", 5e-3});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ZpShape last = zp_shapes_get(result->shapes, result->shapes->frames - 1);
  double of_film = 0;
  for (size_t j = 0; j < 42; j++)
    of_film = fmax(of_film, last.stress[j]);
  ck_assert_double_eq(zp_table_get(result->series, result->series->rows - 1, "max_stress_Pa"), of_film);
  ZpSim *sim = sim_of(model_of(&def));
  zp_sim_run(sim, 5e-3, false, NULL, NULL);
  ck_assert_double_eq(zp_sim_get(sim, "max_stress"), of_film);
  ck_near(zp_sim_get(sim, "insulator_field"), 10e3 / 260e-6, 1e-13);
}

/* Study limits gives the same if it starts from a neighbour. It looks at the closed state at drive.voltage, too. */
TEST(limits_see_the_same_from_a_neighbour) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}), near = DEF({"mesh.nodes", 31}, {"load.mass", 8.2e-3});
  ZpResult *cold = study_of(ZP_STUDY_LIMITS, &def), *neighbour = study_of(ZP_STUDY_LIMITS, &near), *warm = NULL;
  ZpStudyInput input = {.neighbour = neighbour};
  warm = study_with(ZP_STUDY_LIMITS, &def, &input);
  ck_assert(zp_result_get(warm, "warm_starts") > 0);
  ck_near(zp_result_get(warm, "max_stress_Pa"), zp_result_get(cold, "max_stress_Pa"), 5e-11); /* 7e-12 measured */
  ck_assert_double_eq(zp_result_get(warm, "breakdown_margin"), zp_result_get(cold, "breakdown_margin"));
}
