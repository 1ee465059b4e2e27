/* Study calibrate tells about its parameters: profiles, joint regions, shares of the information, against closed forms
 * of linear models; their files. */
#include <unistd.h>

#include "files_util.h"

#include "data_util.h"
#include "fit/fit.h"
#include "study/result.h"

/* -- a line y = a + b x, with its normal equations in closed form ---------------------------------------- */

enum { ROWS = 6, A = 0, B = 1, EDGE = 73, STROKES = 5 };

static const double x[ROWS] = {0, 1, 2, 4, 7, 9};

typedef struct Line {
  ZpFit fit;
  ZpFitSet set;
  ZpFitPoint best;
  double at[ROWS], y[ROWS], sigma[ROWS], fitted[ROWS], J[2 * ROWS], C[ZP_FIT_MOST][ZP_FIT_MOST];
  double mean, spread; /* of x, and its sum of squares about that */
} Line;

/* `known`: standard deviations are. a and b count in multiples of 2 and -5. */
static void open_line(Line *line, bool known) {
  static const double start[] = {2, -5};
  *line = (Line){.set = {.rows = ROWS, .x_key = -1}, .mean = 0};
  line->fit = (ZpFit){.n = 2, .rows = ROWS, .sets = 1, .set = &line->set, .x = line->at, .y = line->y, .horizon = 1};
  if (known) line->fit.sigma = line->sigma;
  for (int i = 0; i < ROWS; i++) {
    line->at[i] = x[i];
    line->sigma[i] = 1;
    line->J[2 * i + A] = start[A];
    line->J[2 * i + B] = start[B] * x[i];
    line->mean += x[i] / ROWS;
  }
  for (int i = 0; i < ROWS; i++)
    line->spread += (x[i] - line->mean) * (x[i] - line->mean);
  for (int k = 0; k < 2; k++) {
    line->fit.start[k] = start[k];
    line->fit.lower[k] = -1e3, line->fit.upper[k] = 1e3;
    line->fit.unit[k] = "m";
    snprintf(line->fit.name[k], sizeof line->fit.name[k], "%c", "ab"[k]);
  }
  line->best = (ZpFitPoint){.z = {3, 4}, .fitted = line->fitted, .J = line->J, .good = true, .ended = true};
  ck_assert(zp_fit_covariance(&line->fit, line->J, NULL, 0, 1e-10, line->C));
}

/* (12.12): of the slope (x - mean)^2 over their sum, of the value at 0 the square of its weight; both sum to 1. */
TEST(shares_of_a_line) {
  Line line;
  double sum[2] = {0, 0};
  open_line(&line, true);
  for (size_t i = 0; i < ROWS; i++) {
    const double off = x[i] - line.mean, weight = 1.0 / ROWS - line.mean * off / line.spread;
    const double all = 1.0 / ROWS + line.mean * line.mean / line.spread;
    const double a = zp_fit_share(&line.fit, line.J, line.C, i, A), b = zp_fit_share(&line.fit, line.J, line.C, i, B);
    ck_near(b, off * off / line.spread, 6e-14); /* 2e-14 measured */
    ck_near(a, weight * weight / all, 1.4e-14); /* 4.9e-15 measured */
    sum[A] += a, sum[B] += b;
  }
  ck_near(sum[A], 1, 2e-15); /* 6.7e-16 measured */
  ck_near(sum[B], 1, 1e-15); /* 2.2e-16 measured */
}

/* 2 F of 95 % with 2 and 4 degrees of freedom is 2 * 6.944, of tables; with known deviations chi-square of two. */
TEST(joint_level_is_that_of_tables) {
  Line line;
  open_line(&line, false);
  ck_near(zp_fit_joint_level(&line.fit), 2 * 6.944, 5e-5);
  open_line(&line, true);
  ck_near(zp_fit_joint_level(&line.fit), 5.991, 1e-4);
  ck_near(zp_fit_level(&line.fit), 3.841, 2e-4);
}

/* (12.11): on the edge of the region the sum of squares has risen by 5.991 times the variance; it reaches farther than
 * the interval of one parameter by the root of 5.991 over 3.841. */
TEST(region_of_a_line) {
  Line line;
  static const double variance = 0.25;
  open_line(&line, true);
  ZpTable *table = zp_fit_regions(&line.fit, &line.best, variance, line.C);
  ck_assert_uint_eq(table->rows, EDGE);
  double reach[2] = {0, 0};
  for (size_t i = 0; i < EDGE; i++) {
    const double a = zp_table_get(table, i, "a_m") - 6, b = zp_table_get(table, i, "b_m") + 20;
    double rise = 0;
    for (int k = 0; k < ROWS; k++)
      rise += (a + b * x[k]) * (a + b * x[k]);
    ck_near(rise, 5.991464547107982 * variance, 9e-14); /* 3.1e-14 measured */
    reach[A] = fmax(reach[A], a), reach[B] = fmax(reach[B], b);
  }
  const double error[] = {sqrt(variance * (1.0 / ROWS + line.mean * line.mean / line.spread)),
                          sqrt(variance / line.spread)};
  for (int k = 0; k < 2; k++)
    ck_near(reach[k], sqrt(zp_fit_level(&line.fit)) * error[k] * sqrt(5.991464547107982 / 3.841458820694124),
            1.3e-5); /* 4.4e-6 between two points measured */
  ck_near(zp_table_get(table, 0, "correlation"), -line.mean / sqrt(line.spread / ROWS + line.mean * line.mean), 1e-15);
  zp_table_destroy(table);
}

/* A parameter at its bound has no region, and no parabola. */
TEST(parameter_at_a_bound_has_no_region) {
  Line line;
  open_line(&line, true);
  line.fit.upper[B] = line.best.z[B];
  ck_assert_ptr_null(zp_fit_regions(&line.fit, &line.best, 1, line.C));
  const ZpFitProfiles points = {2, {{B, 3, {3, 3}}, {A, 2, {3.5, 4}}}};
  ZpTable *table = zp_fit_likelihood(&line.fit, &line.best, 0.25, line.C, &points);
  ck_assert_uint_eq(table->rows, 4);
  ck_assert(zp_table_get(table, 1, "held") == 1 && zp_table_get(table, 2, "held") == 2);
  ck_near(zp_table_get(table, 1, "rise"), 8, 1e-15);
  ck_near(zp_table_get(table, 1, "parabola"), 4 / (1.0 / ROWS + line.mean * line.mean / line.spread), 1e-14);
  ck_assert(isnan(zp_table_get(table, 2, "parabola")) && zp_table_get(table, 2, "b_m") == -15);
  zp_table_destroy(table);
}

/* -- fits of actuators ---------------------------------------------------------------------------------- */

static const double off[STROKES] = {0.3, -1.2, 0.8, 0.5, -0.4}; /* of strokes, in standard deviations */

static double stroke(ZpActuatorDef def, double load) {
  def.load.mass = load;
  return zp_result_get(study_of(ZP_STUDY_STATIONARY, &def), "stroke_m");
}

/* Strokes and capacitances, 0.02 mm and 9 pF uncertain. */
static ZpActuatorDef measured(const char *keys, const char *offsets) {
  ZpActuatorDef def = zp_actuator_def_default(), plain;
  def.mesh.nodes = 11;
  def.liquid.model = ZP_LIQUID_NONE;
  def.output.errors = false;
  plain = def;
  FILE *file = fopen("strokes.csv", "w");
  ck_assert_ptr_nonnull(file);
  fprintf(file, "load_g,stroke_mm,sigma_mm\n");
  for (size_t i = 0; i < STROKES; i++)
    fprintf(file, "%g,%.15g,0.02\n", 4.0 * (double)(i + 1),
            1e3 * stroke(plain, 4e-3 * (double)(i + 1)) + 0.02 * off[i]);
  ck_assert_int_eq(fclose(file), 0);
  write_file("capacitances.csv", "load_g,capacitance_pF,sigma_pF\n4,20,9\n8,18,9\n");
  snprintf(def.data.file, sizeof def.data.file, "strokes.csv; capacitances.csv");
  snprintf(def.calibrate.fit, sizeof def.calibrate.fit, "%s", keys);
  snprintf(def.calibrate.offsets, sizeof def.calibrate.offsets, "%s", offsets);
  return def;
}

/* A reading of zero is a linear parameter: its profile is the parabola, each of its rows tells as much, the rows of the
 * other column nothing. */
TEST(profile_of_a_linear_model_is_the_parabola) {
  const ZpActuatorDef def = measured("", "stroke; capacitance");
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  const ZpTable *likelihood = result->further[ZP_FURTHER_LIKELIHOOD], *rows = result->series;
  const double best = zp_result_get(result, "stroke_offset"), error = 2e-5 / sqrt(STROKES);
  double sum = 0;
  ck_assert(likelihood && likelihood->rows >= 6);
  for (size_t i = 0; i < likelihood->rows; i++) {
    const double rise = zp_table_get(likelihood, i, "rise"),
                 way = zp_table_get(likelihood, i, "stroke_offset_m") - best;
    ck_below(fabs(rise - zp_table_get(likelihood, i, "parabola")), 6e-10); /* 2e-10 measured */
    if (zp_table_get(likelihood, i, "held") == 1) ck_below(fabs(rise - way * way / (error * error)), 6e-13);
    sum += rise;
  }
  ck_near(sum, 4 * 3.841458820694124, 3e-10); /* both ends of both; 1e-10 measured */
  for (size_t i = 0; i < rows->rows; i++) {
    const bool is_stroke = i < STROKES;
    ck_below(fabs(zp_table_get(rows, i, "information_stroke_offset") - (is_stroke ? 1.0 / STROKES : 0)), 1e-15);
    ck_below(fabs(zp_table_get(rows, i, "information_capacitance_offset") - (is_stroke ? 0 : 0.5)), 1e-15);
    const double residual = is_stroke ? zp_table_get(rows, i, "residual_stroke_m") / 2e-5
                                      : zp_table_get(rows, i, "residual_capacitance_F") / 9e-12;
    ck_near(zp_table_get(rows, i, "weighted_residual"), residual, 1e-15);
    ck_assert(zp_table_get(rows, i, "outlier") == 0);
  }
}

/* Of a model that is nearly linear, with keys and a shift: shares sum to 1; the region of two reaches farther than the
 * interval of one, by the root of 5.991 over 3.841. */
TEST(region_touches_the_interval) {
  const ZpActuatorDef def = measured("ribbon.young_modulus, insulator.permittivity", "stroke");
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  const ZpTable *regions = result->further[ZP_FURTHER_REGIONS], *rows = result->series;
  static const char *const share[] = {"information_ribbon.young_modulus", "information_insulator.permittivity",
                                      "information_stroke_offset"};
  for (size_t k = 0; k < LENGTH_OF(share); k++) {
    double sum = 0;
    for (size_t i = 0; i < rows->rows; i++)
      sum += zp_table_get(rows, i, share[k]);
    ck_near(sum, 1, 2e-14); /* 7e-15 measured */
  }
  double low = INFINITY, high = -INFINITY;
  ck_assert_uint_eq(regions->rows, (size_t)3 * EDGE);
  for (size_t i = 0; i < regions->rows; i++) {
    const double value = zp_table_get(regions, i, "ribbon.young_modulus_Pa");
    low = fmin(low, value), high = fmax(high, value);
    const bool is_of = zp_table_get(regions, i, "first") == 1;
    ck_assert(is_of == !isnan(value));
    ck_assert(i == 0 ||
              fabs(zp_table_get(regions, i, "correlation")) <= fabs(zp_table_get(regions, i - 1, "correlation")));
  }
  const double half = 0.5 * (zp_result_get(result, "ribbon.young_modulus_interval_95_high") -
                             zp_result_get(result, "ribbon.young_modulus_interval_95_low"));
  ck_near(0.5 * (high - low), half * sqrt(5.991464547107982 / 3.841458820694124), 2.2e-4); /* 7.5e-5 measured */
  ck_near(zp_result_get(result, "rise_95"), 3.841458820694124, 1e-15);
}

/* Without standard deviations a residual is over that of all: their squares add up to the degrees of freedom. */
TEST(residuals_are_over_that_of_all) {
  ZpActuatorDef def = measured("", "stroke");
  double sum = 0;
  write_file("plain.csv", "load_g,stroke_mm\n4,1\n4,2\n4,3\n4,5\n");
  snprintf(def.data.file, sizeof def.data.file, "plain.csv");
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  for (size_t i = 0; i < result->series->rows; i++)
    sum += pow(zp_table_get(result->series, i, "weighted_residual"), 2);
  ck_near(sum, 3, 1e-15);
}

/* One row that is far off is marked, and no other. */
TEST(outlier_is_marked) {
  const ZpActuatorDef def = measured("", "capacitance");
  write_file("capacitances.csv", "load_g,capacitance_pF,sigma_pF\n4,20,9\n4,20,9\n4,20,9\n4,20,9\n4,80,9\n");
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  for (size_t i = 0; i < result->series->rows; i++)
    ck_assert(zp_table_get(result->series, i, "outlier") == (i == STROKES + 4));
}

static bool is_file(const char *name) {
  return access(path_of(name), R_OK) == 0;
}

/* Tables come back from the bytes of a result, and each has a file and a group of results.h5, which go with it. */
TEST(tables_are_files) {
  const ZpActuatorDef def = measured("ribbon.young_modulus, insulator.permittivity", "");
  ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def), *back = NULL;
  const size_t size = zp_result_save(result, NULL);
  unsigned char *byte = memory_of(size), *again = memory_of(size);
  zp_result_save(result, byte);
  ck_ok(zp_result_load(byte, size, &back, NULL));
  ck_assert_uint_eq(zp_result_save(back, NULL), size);
  zp_result_save(back, again);
  ck_assert_mem_eq(byte, again, size);
  for (int k = 0; k < ZP_FURTHER; k++)
    ck_assert(back->further[k] && back->further[k]->rows == result->further[k]->rows);
  ZpScenario *scenario = SCENARIO("study=calibrate");
  write_files(scenario, &result, 1);
  char head[128] = "";
  FILE *file = fopen(path_of("likelihood.csv"), "r");
  ck_assert(file && fgets(head, sizeof head, file));
  fclose(file);
  ck_assert_str_eq(head, "held,rise,parabola,ribbon.young_modulus_Pa,insulator.permittivity\n");
  ck_assert(is_file("regions.csv"));
  zp_result_forget_further(back);
  write_files(scenario, &back, 1);
  ck_assert(is_file("table.csv") && !is_file("likelihood.csv") && !is_file("regions.csv"));
  zp_result_destroy(back);
}
