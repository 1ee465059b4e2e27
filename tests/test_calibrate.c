/* Study calibrate: what synthetic data were made with is found again, wrong input is refused with the place where it
 * stands; Table I of the paper; the area between a shape and a reference curve. */
#include <time.h>

#include <zipact/rest.h>

#include "data_util.h"
#include "elastica.h"
#include "fit/fit.h"
#include "fit/reference.h"
#include "reproduce/parts.h"

static void set(ZpActuatorDef *def, const char *key, double value) {
  ck_ok(zp_def_set(def, zp_key_find(key), value, &err));
}

static void set_text(ZpActuatorDef *def, const char *key, const char *text) {
  ck_ok(zp_def_set_text(def, zp_key_find(key), text, &err));
}

static ZpActuatorDef calibration(const char *file, const char *keys) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.liquid.model = ZP_LIQUID_NONE;
  set_text(&def, "data.file", file);
  set_text(&def, "calibrate.fit", keys);
  set(&def, "mesh.nodes", FULL_OR(31, 15));
  return def;
}

static ZpResult *fit_to(ZpOutcome outcome, const ZpActuatorDef *def) {
  ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, def);
  ck_assert_msg(result->outcome == outcome, "%s: %s", zp_outcome_name(result->outcome), result->message);
  return result;
}

static ZpResult *fit(const ZpActuatorDef *def) {
  return fit_to(ZP_CONVERGED, def);
}

/* Stroke of the hanging default actuator, m. */
static double stroke(ZpActuatorDef def, double mass) {
  def.load.mass = mass;
  *def.data.file = 0;
  return zp_result_get(data_study_of(ZP_STUDY_STATIONARY, &def), "stroke_m");
}

/* Strokes at seven loads with an error of `noise` that alternates, +-. */
static const double loads[] = {0, 2, 5, 8, 15, 30, 60}; /* g */

static void make_data(const char *path, ZpActuatorDef truth, double noise) {
  FILE *file = fopen(path, "w");
  ck_assert_ptr_nonnull(file);
  fprintf(file, "# made by the test\nload_g, stroke_mm\n");
  for (int i = 0; i < 7; i++)
    fprintf(file, "%g, %.12g\n", loads[i], 1e3 * (stroke(truth, loads[i] / 1e3) + (i % 2 ? noise : -noise)));
  ck_assert_int_eq(fclose(file), 0);
}

/* A scalar of a study. */
static double scalar_of(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  return zp_result_get(data_study_of(study, def), name);
}

TEST(one_key_is_found) {
  ZpActuatorDef def = calibration("one.csv", "ribbon.young_modulus"), truth = def;
  truth.ribbon.young_modulus = 137e9;
  make_data("one.csv", truth, 0);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 137e9, 1e-10);                  /* 1.2e-13 measured */
  ck_below(zp_result_get(result, "ribbon.young_modulus_standard_error") / 137e9, 1e-10); /* 1e-12 measured */
  ck_below(zp_result_get(result, "residual_rms_m"), 1e-12);                              /* 2.2e-14 measured */
  ck_assert_uint_eq(result->series->rows, 7);
  ck_assert_double_eq(zp_result_get(result, "data_rows"), 7);
  ck_assert_str_eq(result->series->column[0].name, "load.mass_kg");
  ck_near(zp_table_get(result->series, 3, "load.mass_kg"), 0.008, 1e-12);
}

/* The correlation of two fitted keys, - J1 J2 / sqrt(J1 J1 J2 J2), with slopes of the strokes by differences. */
static double correlation_of(const ZpActuatorDef *truth) {
  static const double step = 1e-4;
  double product[3] = {0};
  for (int i = 0; i < 7; i++) {
    double slope[2];
    for (int k = 0; k < 2; k++) {
      ZpActuatorDef up = *truth, down = *truth;
      *(k ? &up.load.share : &up.ribbon.young_modulus) *= 1 + step;
      *(k ? &down.load.share : &down.ribbon.young_modulus) *= 1 - step;
      slope[k] = stroke(up, loads[i] / 1e3) - stroke(down, loads[i] / 1e3);
    }
    product[0] += slope[0] * slope[0];
    product[1] += slope[1] * slope[1];
    product[2] += slope[0] * slope[1];
  }
  return -product[2] / sqrt(product[0] * product[1]);
}

TEST(two_keys_are_found) {
  ZpActuatorDef def = calibration("two.csv", "ribbon.young_modulus, load.share"), truth = def;
  truth.ribbon.young_modulus = 150e9;
  truth.load.share = 0.4;
  make_data("two.csv", truth, 0);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 150e9,
          1e-10);                                           /* 1.6e-12, on a coarser mesh 1.8e-11 measured */
  ck_near(zp_result_get(result, "load.share"), 0.4, 1e-10); /* 1.2e-12 measured */
  ck_near(zp_result_get(result, "load.share_correlation_1"), correlation_of(&truth), 6e-10); /* 1.9e-10 measured */
}

/* Twice the noise: twice the standard error, which covers the error that was made. */
TEST(standard_error_follows_the_noise) {
  double error[2];
  for (int i = 0; i < 2; i++) {
    ZpActuatorDef def = calibration("noise.csv", "ribbon.young_modulus"), truth = def;
    truth.ribbon.young_modulus = 150e9;
    make_data("noise.csv", truth, (i + 1) * 2e-5);
    ZpResult *result = fit(&def);
    error[i] = zp_result_get(result, "ribbon.young_modulus_standard_error");
    ck_assert(fabs(zp_result_get(result, "ribbon.young_modulus") - 150e9) < 3 * error[i]);
    ck_assert(error[i] > 1e-5 * 150e9 && error[i] < 0.05 * 150e9);
    ck_near(zp_result_get(result, "residual_rms_m"), (i + 1) * 2e-5, 5e-3); /* 1e-3 measured */
  }
  ck_near(error[1], 2 * error[0], 5e-4); /* 1.1e-4 measured */
}

/* Opening against voltage, below pull-in: the permittivity of the liquid. */
/* Derivatives of rows of rest took an evaluation of all rows twice per key. */
static void derivatives_cost_one_evaluation_of(const ZpActuatorDef *def) {
  ZpFit one;
  ck_ok(zp_fit_open(def, &one, &err));
  double z[ZP_FIT_MOST] = {1, 1}, fitted[16], J[2 * 16], up, down;
  ck_assert_uint_le(one.rows, 16);
  ck_assert(zp_fit_evaluate(&one, z, fitted, J));
  ck_assert_int_eq(one.evaluations, 1);
  for (int k = 0; k < one.n; k++) {
    static const double step = 1e-5; /* wider ones cross corners of contact */
    double at[ZP_FIT_MOST] = {1, 1};
    at[k] = 1 + step;
    up = zp_fit_predict(&one, at, one.rows - 1);
    at[k] = 1 - step;
    down = zp_fit_predict(&one, at, one.rows - 1);
    ck_near(J[(one.rows - 1) * (size_t)one.n + (size_t)k], (up - down) / (2 * step), 1e-5); /* 4.1e-6 measured */
  }
  zp_fit_close(&one);
}

TEST(derivatives_cost_one_evaluation) {
  ZpActuatorDef truth = calibration("", ""), strokes = calibration("slopes.csv", "ribbon.young_modulus,ribbon.length");
  make_data("slopes.csv", truth, 0);
  derivatives_cost_one_evaluation_of(&strokes);
  write_file("slopes-openings.csv", "voltage_kV, opening_mm\n0, 20\n2, 19\n4, 18\n");
  ZpActuatorDef openings = calibration("slopes-openings.csv", "ribbon.young_modulus,medium.permittivity");
  derivatives_cost_one_evaluation_of(&openings);
  write_file("slopes-held.csv", "isometric.separation_mm, force_N\n1, 0.2\n2, 0.1\n3, 0.05\n");
  ZpActuatorDef forces = calibration("slopes-held.csv", "insulator.permittivity,drive.voltage");
  set(&forces, "drive.voltage", 3e3);
  set(&forces, "solver.tolerance", 1e-8);
  derivatives_cost_one_evaluation_of(&forces);
}

/* Of zip times, too: of runs with steps of one length, so that differences of runs are as sharp. */
TEST(zip_times_have_derivatives) {
  write_file("slopes-times.csv", "voltage_kV,zip_time_ms\n9,150\n10,120\n");
  ZpActuatorDef times = calibration("slopes-times.csv", "ribbon.young_modulus,insulator.thickness");
  set(&times, "mesh.nodes", 11);
  set(&times, "liquid.model", ZP_LIQUID_SUBMERGED);
  set(&times, "solver.time_step", 1e-4);
  set(&times, "solver.tolerance", 1e-7);
  derivatives_cost_one_evaluation_of(&times);
}

/* Values have the tolerance of their derivatives: data made with it are met exactly. */
TEST(zip_times_are_of_runs_with_derivatives) {
  ZpActuatorDef def = calibration("one-time.csv", "ribbon.young_modulus"), with = def;
  set(&def, "mesh.nodes", 11);
  set(&def, "liquid.model", ZP_LIQUID_SUBMERGED);
  with = def;
  set(&with, "solver.tolerance", 2.5e-5);
  set(&with, "solver.stop_when_zipped", ZP_WHEN_TRUE);
  set(&with, "output.errors", 0);
  double time = scalar_of(ZP_STUDY_ACTUATE, &with, "zip_time_s");
  char text[100];
  snprintf(text, sizeof text, "voltage_kV,zip_time_s\n10,%.17g\n", time);
  write_file("one-time.csv", text);
  ZpFit one;
  ZpError err;
  ck_assert_int_eq(zp_fit_open(&def, &one, &err), ZP_OK);
  ck_near(zp_fit_predict(&one, (double[ZP_FIT_MOST]){1}, 0), time, 1e-12);
  zp_fit_close(&one);
}

TEST(voltage_data) {
  static const char *const volts[] = {"0", "2", "3", "4"};
  ZpActuatorDef def = calibration("volts.csv", "medium.permittivity"), truth = def;
  char text[400] = "opening_mm,remark,voltage_kV\n";
  truth.medium.permittivity = 2.2;
  set(&truth, "output.samples", 20000);
  ZpResult *result = data_study_of(ZP_STUDY_EQUILIBRIUM, &truth);
  for (int i = 0; i < 4; i++) {
    double at = 1e3 * atof(volts[i]);
    const ZpTable *t = result->series;
    size_t k = 1; /* the hanging branch comes first and its voltage rises */
    while (k + 1 < t->rows && zp_table_get(t, k, "voltage_V") < at)
      k++;
    double v0 = zp_table_get(t, k - 1, "voltage_V"), v1 = zp_table_get(t, k, "voltage_V");
    double o0 = zp_table_get(t, k - 1, "opening_m"), o1 = zp_table_get(t, k, "opening_m");
    double share = (at * at - v0 * v0) / (v1 * v1 - v0 * v0);
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%.9g,some text,%s\n", 1e3 * (o0 + share * (o1 - o0)), volts[i]);
  }
  write_file("volts.csv", text);
  set_text(&def, "calibrate.x", "voltage_kV");
  set_text(&def, "calibrate.y", "opening_mm");
  result = fit(&def);
  ck_near(zp_result_get(result, "medium.permittivity"), 2.2, 5e-3); /* 9.3e-4 measured */
  ck_assert_str_eq(result->series->column[0].name, "drive.voltage_V");
}

/* Zip times of an overdamped actuator grow without bound towards its static pull-in: five of them show where it is,
 * though none was measured below 1.1 times that, and though the modulus that they were made with is not known. */
NIGHTLY_TESTS(zip_times_show_the_pull_in, 0, FULL_OR(1, 0)) {
  static const double kilovolts[] = {6.2, 6.6, 7, 7.5, 8};
  ZpActuatorDef def = calibration("zip-times.csv", "ribbon.young_modulus");
  char text[512] = "voltage_kV,zip_time_ms\n";
  set(&def, "mesh.nodes", 15);
  set(&def, "liquid.model", ZP_LIQUID_SUBMERGED);
  set(&def, "medium.kinematic_viscosity", 2e-4);
  set(&def, "solver.end_time", 20);
  set(&def, "output.errors", 0);
  for (int k = 0; k < 5; k++) {
    ZpActuatorDef row = def;
    row.drive.voltage = 1e3 * kilovolts[k];
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%g,%.12g\n", kilovolts[k],
             1e3 * scalar_of(ZP_STUDY_ACTUATE, &row, "zip_time_s"));
  }
  write_file("zip-times.csv", text);
  double pull_in = scalar_of(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V");
  set(&def, "ribbon.young_modulus", 180e9);
  ZpResult *result = fit(&def);
  double found = zp_result_get(result, "pull_in_voltage_V");
  printf("pull-in %.2f V, from zip times %.2f V, %s, %g evaluations\n", pull_in, found, result->message,
         zp_result_get(result, "evaluations"));
  ck_near(found, pull_in, 1e-4); /* 2.3e-5 measured */
}

TEST(columns_without_units_are_told) {
  write_file("bare.csv", "load,stroke,sigma\n0.004,0.0061,0.0001\n0.008,0.0112,0.0001\n");
  ZpActuatorDef bare = calibration("bare.csv", "ribbon.young_modulus");
  ZpResult *result = fit(&bare);
  ck_assert_uint_eq(result->notes, 1);
  ck_assert_str_eq(result->note[0],
                   "columns without a unit in their name are read in SI: load in kg, stroke in m, sigma in m");
  write_file("bare.csv", "load_g,stroke_mm,sigma_mm\n4,6.1,0.1\n8,11.2,0.1\n");
  result = fit(&bare);
  ck_assert_uint_eq(result->notes, 0);
}

/* A column that was misspelt, or that calibrate.y did not name, was left out in silence. The names are those of the
 * file, also where data.columns renames others. */
TEST(columns_that_are_not_used_are_told) {
  write_file("idle.csv", "Datum;Gewicht [g];stroke (mm);\"Bem, kurz\";Sigma (mm);pull_in_voltage_kV;\n"
                         "1.2.;4;6,1;a;0,1;3;\n2.2.;8;11,2;;0,1;6;\n");
  write_file("all.csv", "load_g,drive.voltage_kV,stroke_mm,sigma_stroke_mm\n2,1,3,0.1\n");
  ZpActuatorDef def = calibration("idle.csv; all.csv", "ribbon.young_modulus");
  snprintf(def.data.columns, sizeof def.data.columns, "Gewicht (g) = load_g");
  snprintf(def.calibrate.x, sizeof def.calibrate.x, "load_g");
  snprintf(def.calibrate.y, sizeof def.calibrate.y, "stroke_mm");
  ZpResult *result = fit(&def);
  ck_assert_str_eq(result->note[0],
                   "columns that are not used: idle.csv: \"Datum\", \"Bem, kurz\", \"pull_in_voltage_kV\"");
}

TEST(bounds_are_kept) {
  ZpActuatorDef def = calibration("bounds.csv", "ribbon.young_modulus"), truth = def;
  truth.ribbon.young_modulus = 100e9;
  make_data("bounds.csv", truth, 0);
  set(&def, "calibrate.lower", 0.8);
  ZpResult *result = fit_to(ZP_AT_BOUND, &def);
  ck_assert(zp_outcome_good(ZP_AT_BOUND));
  ck_assert_str_eq(zp_outcome_name(ZP_AT_BOUND), "at_bound");
  ck_assert_ptr_nonnull(strstr(result->message, "at its bound: ribbon.young_modulus"));
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 160e9, 1e-11); /* 0 measured */
  ck_assert(zp_result_get(result, "ribbon.young_modulus") >= 160e9);
  ck_assert(isnan(zp_result_get(result, "ribbon.young_modulus_standard_error")));
  ck_assert_uint_eq(result->notes, 1);
  ck_assert_ptr_nonnull(strstr(result->note[0], "bound"));
  truth.load.share = 0.5;
  set_text(&def, "calibrate.fit", "load.share"); /* the key's own range ends at 1, not at 5 * 0.5 */
  result = fit_to(ZP_AT_BOUND, &def);
  ck_assert(zp_result_get(result, "load.share") <= 1);
}

/* Bounds in the key's unit, in place of multiples of the start. */
TEST(bounds_have_units) {
  const char *text[] = {"ribbon.young_modulus = 190 GPa .. 250 GPa", "ribbon.young_modulus = 50 GPa .. 0.25 TPa"};
  const double value[] = {190e9, 100e9};
  for (int i = 0; i < 2; i++) {
    ZpActuatorDef def = calibration("units.csv", "ribbon.young_modulus"), truth = def;
    truth.ribbon.young_modulus = 100e9;
    make_data("units.csv", truth, 0);
    set_text(&def, "calibrate.bounds", text[i]);
    ZpResult *result = fit_to(i ? ZP_CONVERGED : ZP_AT_BOUND, &def);
    ck_near(zp_result_get(result, "ribbon.young_modulus"), value[i], 1e-10); /* 6.7e-13 measured */
  }
}

/* A ribbon that is bowed at its clip, of curvature 0.2 1/m before the fit. */
static ZpActuatorDef bowed(const char *file) {
  ZpActuatorDef def = calibration(file, "segment_1.curvature");
  def.segment_K[0].length = 0.03;
  def.segment_K[0].curvature = 0.2;
  def.mesh.nodes = 15;
  set_text(&def, "calibrate.bounds", "segment_1.curvature = -0.5 1/m .. 0.5 1/m");
  return def;
}

/* A key may change its sign on the way, here by exact derivatives of strokes, and stop at a negative bound. */
TEST(negative_values_and_bounds) {
  static const double curvature[] = {-0.3, -0.8};
  for (int i = 0; i < 2; i++) {
    ZpActuatorDef def = bowed("bowed.csv"), truth = def;
    truth.segment_K[0].curvature = curvature[i];
    make_data("bowed.csv", truth, 1e-7);
    ZpResult *result = fit_to(i ? ZP_AT_BOUND : ZP_CONVERGED, &def);
    double error = zp_result_get(result, "segment_1.curvature_standard_error");
    ck_near(zp_result_get(result, "segment_1.curvature"), i ? -0.5 : -0.3, 1e-3); /* 2e-4 measured */
    ck_assert(isnan(error) == (i == 1));
  }
}

/* Capacitances of the hanging actuator, which have no exact derivatives: differences have a step at a negative value,
 * too. Polished, the fit is as near as they allow; the search before comes to some percent. */
TEST(negative_values_by_differences) {
  ZpActuatorDef def = bowed("bowed-capacitance.csv"), truth = def;
  truth.segment_K[0].curvature = -0.3;
  FILE *file = fopen("bowed-capacitance.csv", "w");
  fputs("load_g,capacitance_pF\n", file);
  for (int g = 4; g <= 32; g *= 2) {
    truth.load.mass = 1e-3 * g;
    ZpRest *rest;
    ZpModel *model = model_of(&truth);
    ck_assert_int_eq(zp_rest_create(model, &rest, NULL), ZP_OK);
    ck_assert(zp_rest_hang(rest, 0));
    fprintf(file, "%d,%.17g\n", g, 1e12 * zp_rest_capacitance(rest));
    zp_rest_destroy(rest);
  }
  ck_assert_int_eq(fclose(file), 0);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "segment_1.curvature"), -0.3, 1.8e-9); /* 6e-10 measured */
  ck_assert(isfinite(zp_result_get(result, "segment_1.curvature_standard_error")));
}

/* -- files as spreadsheets and instruments write them ---------------------------------------------- */

/* Strokes of a ribbon of 180 GPa under these loads. */
static const double grams[] = {4, 8, 15, 30};

typedef void (*WriteRow)(FILE *file, double g, double mm);

static void write_german(FILE *file, double g, double mm) {
  char text[64];
  snprintf(text, sizeof text, "%.15g", mm);
  *strchr(text, '.') = ',';
  fprintf(file, "\"a; b \"\"c\"\"\";%g,0;\"%s\"\r\n", g, text);
}
static void write_tabs(FILE *file, double g, double mm) {
  fprintf(file, "%.17g\t%.17g\t\n", mm, g);
}
static void write_quoted(FILE *file, double g, double mm) {
  fprintf(file, "\"%g\",\"%.17g\"\n", g, mm);
}

/* Rows `from` to `to` in a format. */
static void write_measured(const char *path, const char *head, WriteRow write, int from, int to) {
  ZpActuatorDef truth = calibration(path, "ribbon.young_modulus");
  truth.ribbon.young_modulus = 180e9;
  FILE *file = fopen(path, "w");
  fputs(head, file);
  for (int i = from; i < to; i++)
    write(file, grams[i], 1e3 * stroke(truth, 1e-3 * grams[i]));
  ck_assert_int_eq(fclose(file), 0);
}

static void find_180_GPa(const char *files, const char *columns, size_t rows) {
  ZpActuatorDef def = calibration(files, "ribbon.young_modulus");
  set_text(&def, "data.columns", columns);
  set_text(&def, "calibrate.x", "load_g");
  set_text(&def, "calibrate.y", "Stroke (mm)");
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 180e9, 1e-11); /* 1.3e-15 measured */
  ck_assert_uint_eq(result->series->rows, rows);
}

TEST(files_of_all_kinds) {
  write_measured("german.csv", "\xEF\xBB\xBF\"Bemerkung\";\"Gewicht (g)\";\"Hub [mm]\"\r\n", write_german, 0, 4);
  write_measured("tabs.csv", "Stroke (mm)\tLoad [g]\tRemark\n", write_tabs, 0, 4);
  write_measured("quoted.csv", "\"Load (g)\",\"stroke_mm\"\n", write_quoted, 0, 4);
  find_180_GPa("german.csv", "Gewicht (g) = load_g; Hub_mm = stroke_mm", 4);
  find_180_GPa("tabs.csv", "", 4);
  find_180_GPa("quoted.csv", "", 4);
  write_measured("first.csv", "load_g,stroke_mm\n", write_quoted, 0, 2);
  write_measured("second.csv", "Stroke (mm)\tLoad (g)\twho\n", write_tabs, 2, 4);
  find_180_GPa("first.csv; second.csv", "", 4);
  find_180_GPa("first.csv;tabs.csv;german.csv", "Gewicht_g = load_g; Hub [mm] = stroke_mm", 10);
}

static void write_newtons(FILE *file, double g, double mm) {
  fprintf(file, "%.17g,%.17g\n", g * 1e-3 * calibration("", "").gravity, mm);
}

/* "Stroke / mm", as on the axes of pictures, "Stroke in mm" and "pull-in voltage" were unknown; so was a load in N. */
TEST(headings_with_a_slash_an_in_a_hyphen_or_newtons) {
  write_measured("slash.csv", "Load / g,Stroke / mm\n", write_quoted, 0, 4);
  find_180_GPa("slash.csv", "", 4);
  write_measured("in.csv", "Load in g,Stroke in mm\n", write_quoted, 0, 4);
  find_180_GPa("in.csv", "", 4);
  write_measured("newtons.csv", "Load (N),Stroke (mm)\n", write_newtons, 0, 4);
  ZpActuatorDef def = calibration("newtons.csv", "ribbon.young_modulus");
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 180e9, 4e-11); /* 1.4e-11 measured */
  write_file("hyphen.csv", "load (g),Pull-in voltage (kV)\n6,4.3\n8,6.2\n");
  def = calibration("hyphen.csv", "ribbon.young_modulus");
  ck_assert_int_eq(zp_data_check(ZP_STUDY_CALIBRATE, &def, NULL), ZP_OK);
}

/* Two groups of rows that contradict each other: the mean weighted by 1/sigma^2 comes out, and its standard error is
 * that of the sigmas, whatever the residuals are. */
TEST(standard_deviations_weigh) {
  ZpActuatorDef def = calibration("sigma.csv", "ribbon.young_modulus");
  const double low = stroke(def, 8e-3), s1 = 1e-5, s2 = 3e-5, y1 = low - 2e-5, y2 = low + 4e-5;
  const double mean = (y1 / (s1 * s1) + y2 / (s2 * s2)) / (1 / (s1 * s1) + 1 / (s2 * s2));
  char text[256];
  snprintf(text, sizeof text, "load_g,stroke_mm,Sigma (um)\n8,%.17g,%g\n8,%.17g,%g\n", 1e3 * y1, 1e6 * s1, 1e3 * y2,
           1e6 * s2);
  write_file("sigma.csv", text);
  set_text(&def, "calibrate.sigma", "stroke = 5 um"); /* for files without such a column */
  ZpResult *result = fit(&def);
  ZpActuatorDef found = def;
  found.ribbon.young_modulus = zp_result_get(result, "ribbon.young_modulus");
  ck_near(stroke(found, 8e-3), mean, 1e-11); /* 2.2e-16 measured */
  found.ribbon.young_modulus *= 1 + 1e-4;
  const double slope = (stroke(found, 8e-3) - mean) / (1e-4 * zp_result_get(result, "ribbon.young_modulus"));
  const double error = sqrt(1 / (1 / (s1 * s1) + 1 / (s2 * s2))) / fabs(slope);
  ck_near(zp_result_get(result, "ribbon.young_modulus_standard_error"), error, 3e-4); /* 8.5e-5 measured */
  /* 2.2e-16 measured */
  ck_near(zp_result_get(result, "reduced_chi_square"), (y2 - y1) * (y2 - y1) / (s1 * s1 + s2 * s2), 1e-11);
}

/* Two strokes under one load, 2 d apart: the fit lies between them, its variance is that of two rows and one key. */
TEST(residuals_make_the_standard_error) {
  ZpActuatorDef def = calibration("twice.csv", "ribbon.young_modulus"), stiff = def;
  const double y = stroke(def, 8e-3), d = 2e-5, step = 1e-4;
  char text[256];
  snprintf(text, sizeof text, "load_g,stroke_mm\n8,%.17g\n8,%.17g\n", 1e3 * (y - d), 1e3 * (y + d));
  write_file("twice.csv", text);
  ZpResult *result = fit(&def);
  stiff.ribbon.young_modulus *= 1 + step;
  const double slope = (stroke(stiff, 8e-3) - y) / (step * def.ribbon.young_modulus);
  ck_near(zp_result_get(result, "ribbon.young_modulus_standard_error"), d / fabs(slope), 3e-4); /* 8.5e-5 measured */
  ck_near(zp_table_get(result->series, 0, "residual_m"), d, 1e-12);                             /* 4.6e-14 measured */
  ck_near(zp_table_get(result->series, 1, "residual_m"), -d, 1e-12);                            /* 4.1e-14 measured */
}

/* -- several kinds of measurement in one fit ------------------------------------------------------- */

/* Stroke or capacitance of the actuator at rest on the branch that hangs. */
static double at_rest(ZpActuatorDef def, ZpFitKind kind, double mass, double voltage) {
  ZpRest *rest;
  def.load.mass = mass;
  ZpModel *model = model_of(&def);
  ck_assert_int_eq(zp_rest_create(model, &rest, NULL), ZP_OK);
  ck_assert(zp_rest_hang(rest, voltage));
  double value = kind == ZP_FIT_CAPACITANCE ? zp_rest_capacitance(rest)
                 : kind == ZP_FIT_OPENING   ? zp_rest_opening(rest)
                                            : zp_rest_stroke(rest);
  zp_rest_destroy(rest);
  return value;
}

/* A stroke and a capacitance that contradict each other. By (12.2) the modulus is off by sum(J r) / sum(J J) with
 * slopes J = (df/dE) / sigma, its standard error is 1 / sqrt(sum(J J)), and what remains is the part of r across J. */
TEST(kinds_weigh_by_their_standard_deviations) {
  const ZpFitKind kind[] = {ZP_FIT_STROKE, ZP_FIT_CAPACITANCE};
  const double sigma[] = {2e-6, 1e-14}, off[] = {1, -2}; /* off: in standard deviations */
  ZpActuatorDef def = calibration("two-kinds-1.csv; two-kinds-2.csv", "ribbon.young_modulus"), stiff = def, soft = def;
  const double E = def.ribbon.young_modulus, step = 1e-4;
  double J[2], y[2], JJ = 0, Jr = 0, rr = 0;
  char text[2][256];
  stiff.ribbon.young_modulus = E * (1 + step);
  soft.ribbon.young_modulus = E * (1 - step);
  for (int i = 0; i < 2; i++) {
    y[i] = at_rest(def, kind[i], 8e-3, 0) + off[i] * sigma[i];
    J[i] = (at_rest(stiff, kind[i], 8e-3, 0) - at_rest(soft, kind[i], 8e-3, 0)) / (2 * step * E * sigma[i]);
    JJ += J[i] * J[i];
    Jr += J[i] * off[i];
    rr += off[i] * off[i];
  }
  snprintf(text[0], sizeof text[0], "load_g,stroke_mm,sigma_um\n8,%.17g,%g\n", 1e3 * y[0], 1e6 * sigma[0]);
  snprintf(text[1], sizeof text[1], "voltage_V,load_g,capacitance_pF\n0,8,%.17g\n", 1e12 * y[1]);
  write_file("two-kinds-1.csv", text[0]);
  write_file("two-kinds-2.csv", text[1]);
  set_text(&def, "calibrate.x", "load_g; voltage_V");
  set_text(&def, "calibrate.y", "capacitance_pF; stroke_mm");
  set_text(&def, "calibrate.sigma", "capacitance = 0.01 pF");
  ZpResult *result = fit(&def);
  const double error = zp_result_get(result, "ribbon.young_modulus_standard_error");
  ck_near(error, 1 / sqrt(JJ), 1e-3);
  ck_below(fabs(zp_result_get(result, "ribbon.young_modulus") - E - Jr / JJ), 2e-3 * error); /* 4e-4 measured */
  ck_near(zp_result_get(result, "reduced_chi_square"), rr - Jr * Jr / JJ, 2e-4);             /* 3.8e-5 measured */
  ck_assert_str_eq(result->series->column[0].name, "load.mass_kg");
  ck_near(zp_table_get(result->series, 0, "measured_stroke_m"), y[0], 1e-12);
  ck_near(zp_table_get(result->series, 1, "measured_capacitance_F"), y[1], 1e-12);
  ck_near(zp_table_get(result->series, 1, "sigma_capacitance_F"), sigma[1], 1e-12);
  ck_assert(isnan(zp_table_get(result->series, 1, "measured_stroke_m")));
  const double left = zp_table_get(result->series, 1, "residual_capacitance_F");
  ck_near(zp_result_get(result, "capacitance_residual_rms_F"), fabs(left), 1e-11);          /* 0 measured */
  ck_near(zp_result_get(result, "capacitance_weighted_rms"), fabs(left) / sigma[1], 1e-11); /* 0 measured */
  ck_assert(isnan(zp_result_get(result, "residual_rms_m")));
}

/* A voltage in a second column acts on the row: strokes at rest under load and voltage are met exactly. The notes are
 * those of the highest voltage. */
TEST(voltage_in_a_second_column) {
  static const double kilovolts[] = {1, 4, 2};
  ZpActuatorDef def = calibration("second.csv", " ");
  set(&def, "mesh.nodes", 9);
  set(&def, "drive.voltage", 0);
  set(&def, "output.errors", 0);
  FILE *file = fopen("second.csv", "w");
  fputs("load_g,stroke_mm,voltage_kV\n", file);
  for (int i = 0; i < 3; i++)
    fprintf(file, "%d,%.17g,%g\n", 8 + i, 1e3 * at_rest(def, ZP_FIT_STROKE, 1e-3 * (8 + i), 1e3 * kilovolts[i]),
            kilovolts[i]);
  ck_assert_int_eq(fclose(file), 0);
  ck_assert_double_gt(fabs(at_rest(def, ZP_FIT_STROKE, 9e-3, 4e3) - at_rest(def, ZP_FIT_STROKE, 9e-3, 0)), 1e-5);
  ZpResult *result = fit(&def), *alone;
  ck_assert_double_lt(zp_result_get(result, "residual_rms_m"), 1e-15);
  def.drive.voltage = 4e3;
  def.load.mass = 9e-3;
  *def.data.file = 0;
  alone = data_study_of(ZP_STUDY_EQUILIBRIUM, &def);
  ck_assert_ptr_nonnull(strstr(result->note[0], "longer than the zip front"));
  ck_assert_str_eq(result->note[0], alone->note[0]);
}

/* Three openings, the last of them of another ribbon. */
static void write_openings(const ZpActuatorDef *first, const ZpActuatorDef *last, const double *kilovolts) {
  FILE *file = fopen("none.csv", "w");
  fputs("voltage_kV,opening_mm\n", file);
  for (int i = 0; i < 3; i++)
    fprintf(file, "%.17g,%.17g\n", kilovolts[i],
            1e3 * at_rest(i == 2 ? *last : *first, ZP_FIT_OPENING, first->load.mass, 1e3 * kilovolts[i]));
  ck_assert_int_eq(fclose(file), 0);
}

/* Without calibrate.y a column is found by its name, behind one that sets a voltage. */
TEST(measured_column_is_found_by_its_name) {
  ZpActuatorDef def = calibration("third.csv", "ribbon.young_modulus"), truth = def;
  FILE *file = fopen("third.csv", "w");
  fputs("load_g,voltage_kV,stroke_mm\n", file);
  for (int i = 1; i <= 3; i++)
    fprintf(file, "%d,0.5,%.17g\n", 2 * i, 1e3 * at_rest(truth, ZP_FIT_STROKE, 2e-3 * i, 500));
  ck_assert_int_eq(fclose(file), 0);
  def.ribbon.young_modulus *= 1.1;
  ck_near(zp_result_get(fit(&def), "ribbon.young_modulus"), truth.ribbon.young_modulus, 2.2e-13); /* 7.3e-14 measured */
}

/* A stiff ribbon hangs less open and pulls in sooner: one row has no equilibrium at the start of the fit. It counts as
 * twice the largest measured value, so that the fit goes to where all rows have one. */
TEST(row_without_an_equilibrium) {
  ZpActuatorDef def = calibration("none.csv", "ribbon.young_modulus"), truth = def;
  set(&def, "mesh.nodes", 9);
  set(&def, "output.errors", 0);
  truth = def;
  truth.ribbon.young_modulus = 180e9;
  const double pull_in[] = {scalar_of(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V"),
                            scalar_of(ZP_STUDY_LIMITS, &truth, "pull_in_voltage_V")};
  const double kilovolts[] = {0, 3, 0.5e-3 * (pull_in[0] + pull_in[1])};
  write_openings(&truth, &truth, kilovolts);
  ZpFit start;
  ck_assert_int_eq(zp_fit_open(&def, &start, NULL), ZP_OK);
  ck_assert(isnan(zp_fit_predict(&start, (double[ZP_FIT_MOST]){1}, 2)));
  zp_fit_close(&start);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 180e9, 4e-11); /* 1.4e-11 measured */
  write_openings(&def, &truth, kilovolts); /* the others alone are best where the last has none */
  result = fit(&def);
  double sum = 0, size = 0; /* of residual times slope: 0 at the least squares */
  ZpActuatorDef up = def, down = def;
  up.ribbon.young_modulus = (1 + 1e-5) * zp_result_get(result, "ribbon.young_modulus");
  down.ribbon.young_modulus = (1 - 1e-5) * zp_result_get(result, "ribbon.young_modulus");
  for (size_t i = 0; i < 3; i++) {
    const double slope = at_rest(up, ZP_FIT_OPENING, def.load.mass, 1e3 * kilovolts[i]) -
                         at_rest(down, ZP_FIT_OPENING, def.load.mass, 1e3 * kilovolts[i]);
    sum += slope * zp_table_get(result->series, i, "residual_m");
    size += fabs(slope * zp_table_get(result->series, i, "residual_m"));
  }
  printf("modulus %g, %g of %g\n", zp_result_get(result, "ribbon.young_modulus"), sum, size);
  ck_assert_double_lt(fabs(sum), 1e-4 * size);
  set_text(&def, "calibrate.fit", " ");
  result = fit_to(ZP_NOT_SETTLED, &def);
  ck_assert_str_eq(result->message, "the model gives no value for some rows within the bounds");
  ck_assert(isnan(zp_table_get(result->series, 2, "fitted_m")) && !isnan(zp_table_get(result->series, 1, "fitted_m")));
}

/* The slope of a capacitance by the share of the load that each half carries. No share is above 1: a difference there
 * is one of smaller shares. At the lower bound it is one of larger shares. */
TEST(differences_stay_inside_the_bounds) {
  static const double share[] = {0.5, 1, 0.6}, step = 1e-3;
  write_file("shares.csv", "load_g,capacitance_pF\n8,40\n20,30\n");
  for (int i = 0; i < 3; i++) {
    ZpActuatorDef def = calibration("shares.csv", "load.share");
    ZpFit one;
    double fitted[2], J[2], slope;
    set(&def, "load.share", share[i]);
    set(&def, "calibrate.lower", i == 2 ? 1 : 0.2);
    ck_assert_int_eq(zp_fit_open(&def, &one, NULL), ZP_OK);
    ck_assert(zp_fit_evaluate(&one, (double[ZP_FIT_MOST]){1}, fitted, J));
    const int side = i == 1 ? -1 : 1; /* of differences of second order that stay on one side */
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] = zp_fit_predict(&one, (double[ZP_FIT_MOST]){1 + side * k * step}, 0);
    slope = side * (-3 * at[0] + 4 * at[1] - at[2]) / (2 * step);
    /* 1.2e-6 measured; at a bound 8.2e-5, the error of first order of a step of 1e-4 to one side */
    ck_near(J[0], slope, i == 0 ? 4e-6 : 2.5e-4);
    zp_fit_close(&one);
  }
}

/* Normal errors, the same on every machine. */
static double normal(uint64_t *state) {
  double u[2];
  for (int i = 0; i < 2; i++) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    u[i] = ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
  }
  return sqrt(-2 * log(u[0])) * cos(8 * atan(1) * u[1]);
}

/* Strokes and capacitances of one file, openings of another, with noise: over 20 seeds the squares of what remains,
 * and of what the keys are off by over their standard errors, are those of normal numbers. */
TEST(intervals_hold_over_seeds) {
  enum { SEEDS = 20, LOADS = 4, VOLTS = 3, ROWS = 2 * LOADS + VOLTS, KEYS = 2 };
  ZpActuatorDef def = calibration("seed-1.csv; seed-2.csv", "ribbon.young_modulus, medium.permittivity"), truth;
  set(&def, "mesh.nodes", 9);
  truth = def;
  truth.ribbon.young_modulus = 185e9;
  truth.medium.permittivity = 2.5;
  double value[ROWS], chi_square = 0, pulls[KEYS] = {0};
  const double sigma[] = {3e-5, 2e-13, 5e-5};
  for (int i = 0; i < LOADS; i++) {
    value[2 * i] = at_rest(truth, ZP_FIT_STROKE, 3e-3 * (i + 1), 0);
    value[2 * i + 1] = at_rest(truth, ZP_FIT_CAPACITANCE, 3e-3 * (i + 1), 0);
  }
  for (int i = 0; i < VOLTS; i++)
    value[2 * LOADS + i] = at_rest(truth, ZP_FIT_OPENING, 8e-3, 2e3 * i);
  set_text(&def, "calibrate.x", "load_g; voltage_kV");
  set_text(&def, "calibrate.y", "stroke_mm; opening_mm; capacitance_pF");
  set_text(&def, "calibrate.sigma", "capacitance = 0.2 pF; opening = 50 um");
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    uint64_t state = seed;
    FILE *file = fopen("seed-1.csv", "w");
    fprintf(file, "load_g,capacitance_pF,stroke_mm,sigma_stroke_um\n");
    for (int i = 0; i < LOADS; i++) {
      const double stroke = value[2 * i] + sigma[0] * normal(&state);
      fprintf(file, "%d,%.12g,%.12g,%g\n", 3 * (i + 1), 1e12 * (value[2 * i + 1] + sigma[1] * normal(&state)),
              1e3 * stroke, 1e6 * sigma[0]);
    }
    fclose(file);
    file = fopen("seed-2.csv", "w");
    fprintf(file, "voltage_kV;opening_mm\n");
    for (int i = 0; i < VOLTS; i++)
      fprintf(file, "%d;%.12g\n", 2 * i, 1e3 * (value[2 * LOADS + i] + sigma[2] * normal(&state)));
    fclose(file);
    ZpResult *result = fit(&def);
    chi_square += zp_result_get(result, "reduced_chi_square") * (ROWS - KEYS);
    const double off[] = {zp_result_get(result, "ribbon.young_modulus") - 185e9,
                          zp_result_get(result, "medium.permittivity") - 2.5};
    pulls[0] += pow(off[0] / zp_result_get(result, "ribbon.young_modulus_standard_error"), 2);
    pulls[1] += pow(off[1] / zp_result_get(result, "medium.permittivity_standard_error"), 2);
  }
  ck_chi_square("chi-square", chi_square, SEEDS * (ROWS - KEYS));
  ck_chi_square("modulus over its standard error, squared", pulls[0], SEEDS);
  ck_chi_square("permittivity over its standard error, squared", pulls[1], SEEDS);
}

/* Saved states of the paper's authors at 8 and 61 g, published FE strokes: within 3 %. */
TEST(table_1_of_the_paper) {
  static const struct {
    const char *file;
    double value[3];
  } cases[] = {{"/examples/calibrate-table-1-8g.yaml", {6434, 1.586e5, 1.537e6}},
               {"/examples/calibrate-table-1-61g.yaml", {6031, 1.461e5, 1.408e6}}};
  for (int c = 0; c < 2; c++) {
    char path[1024];
    ZpError err = {0};
    snprintf(path, sizeof path, "%s%s", ZP_SOURCE_DIR, cases[c].file);
    ZpScenario *scenario = new_scenario();
    ck_ok(zp_scenario_read(scenario, path, &err));
    ck_assert_uint_eq(zp_scenario_count(scenario), 3);
    for (size_t i = 0; i < 3; i++) {
      ZpActuatorDef def = {0};
      ck_assert_int_eq(zp_scenario_def(scenario, i, &def, &err), ZP_OK);
      set(&def, "mass_spring.shear_coefficient", 2 * def.mass_spring.shear_coefficient); /* not from the answer */
      ZpResult *result = fit(&def);
      ck_near(zp_result_get(result, "mass_spring.shear_coefficient"), cases[c].value[i], 0.03); /* 0.016 measured */
      ck_assert(isnan(zp_result_get(result, "mass_spring.shear_coefficient_standard_error")));
    }
  }
}

static void refuse_file(const char *text, const char *keys, const char *words) {
  write_file("bad.csv", text);
  ZpActuatorDef def = calibration("bad.csv", keys);
  refuse_study(ZP_STUDY_CALIBRATE, &def, words);
}

TEST(bad_numbers_of_studies_are_refused) {
  const char *E = "ribbon.young_modulus";
  refuse_file("load_g,force_N\n8,2\n", E, "calibrate.y");
  refuse_file("load_g,frequency_mm\n8,2\n", E, "calibrate.y");
  refuse_file("time_ms,pull_in_voltage_V\n8,2\n", E, "no column of this record is measured: stroke, displacement");
  refuse_file("load_g,pull_in_voltage_kV\n8,12\n", E, "bad.csv:2: the measured pull-in voltage is 12000 V");
}

/* Names in data.file and in data.columns that have commas between them. */
TEST(commas_in_place_of_semicolons) {
  write_file("one.csv", "Gewicht,Hub\n4,6\n8,11\n");
  ZpActuatorDef def = calibration("one.csv, two.csv", "ribbon.young_modulus");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "one.csv, two.csv: cannot be opened");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "; several files are separated by semicolons");
  def = calibration("one.csv", "ribbon.young_modulus");
  set_text(&def, "data.columns", "Gewicht = load_g, Hub = stroke_mm");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "\"load_g, Hub = stroke_mm\": several names are separated by semicolons");
}

/* A mixed fit says what is missing, in which column. */
TEST(bad_mixtures_are_refused) {
  ZpActuatorDef def = calibration("kind-1.csv; kind-2.csv", "ribbon.young_modulus"), one;
  write_file("kind-1.csv", "load_g,stroke_mm,sigma_mm\n8,2,0.1\n");
  write_file("kind-2.csv", "load_g,frequency_Hz\n8,3\n");
  refuse_study(
      ZP_STUDY_CALIBRATE, &def,
      "a fit to several kinds of measurement requires standard deviations of all, but frequency of kind-2.csv has "
      "none; "
      "add a column sigma_frequency_Hz, or give calibrate.sigma = \"frequency = ... Hz\"");
  set_text(&def, "calibrate.sigma", "frequency = 1 mm");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "calibrate.sigma: frequency = \"1 mm\": not a frequency");
  set_text(&def, "calibrate.sigma", "frequency = -1 Hz");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "frequency = \"-1 Hz\": needs a number above 0 and its unit, Hz");
  set_text(&def, "calibrate.sigma", "frequency 1 Hz");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "write stroke = 20 um; frequency = 0.1 Hz");
  set_text(&def, "calibrate.sigma", "frequence = 1 Hz");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "calibrate.sigma: frequence: takes stroke, displacement");
  set_text(&def, "calibrate.sigma", "frequency = 1 Hz; opening = 1 mm");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "opening is not measured");
  set_text(&def, "calibrate.sigma", "frequency = 1 Hz");
  set_text(&def, "calibrate.y", "stroke_mm; frequency_Hz; capacitance_pF");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "calibrate.y = \"capacitance_pF\": no such column in any file");
  set_text(&def, "calibrate.y", "stroke_mm");
  refuse_study(ZP_STUDY_CALIBRATE, &def, "calibrate.y = \"stroke_mm\": no such column in kind-2.csv");
  write_file("kind-2.csv", "load_g,stroke_mm\n8,3\n");
  set_text(&def, "calibrate.sigma", "");
  refuse_study(ZP_STUDY_CALIBRATE, &def,
               "a fit to several files requires standard deviations of all, but stroke of kind-2.csv has none");
  one = calibration("kind-3.csv", "ribbon.young_modulus");
  set_text(&one, "calibrate.y", "stroke_mm; frequency_Hz");
  write_file("kind-3.csv", "load_g,stroke_mm,frequency_Hz,sigma_mm\n8,2,3,0.1\n");
  refuse_study(ZP_STUDY_CALIBRATE, &one,
               "column sigma_mm: the file has several measured columns; name the one that it belongs to");
  write_file("kind-3.csv", "load_g,stroke_mm,frequency_Hz,sigma_stroke_g,sigma_frequency_Hz\n8,2,3,0.1,0.1\n");
  refuse_study(ZP_STUDY_CALIBRATE, &one,
               "column sigma_stroke_g: its unit must be one of the measured quantity, such as m");
  write_file("kind-3.csv", "load_g,stroke_mm,frequency_mm,sigma_stroke_mm\n8,2,3,0.1\n");
  set_text(&one, "calibrate.y", "stroke_mm; frequency_mm");
  refuse_study(ZP_STUDY_CALIBRATE, &one,
               "kind-3.csv:1: column frequency_mm: unknown; calibrate.y takes stroke, displacement");
}

TEST(files_that_are_no_tables_are_refused) {
  const char *E = "ribbon.young_modulus";
  refuse_file("load_g\n8\n", E, "bad.csv:1: not a table: one column; commas, semicolons or tabs");
  refuse_file("load_g,stroke_mm\n8,\n", E, "bad.csv:2: column stroke_mm: an empty cell; remove the row");
  refuse_file("load_g stroke_mm\n8 2\n", E, "bad.csv:1: not a table: one column");
  refuse_file("8,2\n9,3\n", E, "bad.csv: the first row has numbers; it needs names with units, such as load_g");
  refuse_file("\xFF\xFEl", E, "bad.csv: text in UTF-16; save it as CSV in UTF-8");
}

TEST(bad_input_is_refused) {
  const char *E = "ribbon.young_modulus", *good = "load_g,stroke_mm\n8,2\n9,3\n";
  ZpActuatorDef missing = calibration("no such file.csv", E), nameless = calibration("", E);
  refuse_study(ZP_STUDY_CALIBRATE, &missing, "cannot be opened");
  refuse_study(ZP_STUDY_CALIBRATE, &nameless, "data.file: empty");
  refuse_file("", E, "empty");
  refuse_file("# only a remark\n\n", E, "empty");
  refuse_file("load_g,stroke_mm\n", E, "not a table: below the row of names, no column has a number");
  refuse_file("load_g,stroke_mm\n\n8,abc\n", E, "bad.csv:3: column stroke_mm: \"abc\": text in a number column");
  refuse_file("load_g,stroke_mm\n8,nan\n", E, "text in a number column");
  refuse_file("load_g,stroke_mm\n8,0x10\n", E, "text in a number column");
  refuse_file("load_g,stroke_mm\n8,1e999\n", E, "text in a number column");
  refuse_file("load_g,stroke_mm\n8,2,3\n", E, "bad.csv:2: 3 cells; the header has 2");
  refuse_file("load_s,stroke_mm\n8,2\n", E, "bad.csv:1: column load_s: unknown; calibrate.x takes");
  refuse_file("load_g,stroke_kg\n8,2\n", E, "bad.csv:1: column stroke_kg: unknown; calibrate.y takes");
  refuse_file("isometric.separation_mm,force_N\n2,1\n89,2\n", E, "bad.csv:3: isometric.separation = 0.089 m");
  refuse_file("load_g,stroke_mm\n-8,2\n", E, "load.mass");
  refuse_file(good, "ribbon.young_modulos", "did you mean ribbon.young_modulus?");
  refuse_file(good, "ribbon.model", "ribbon.model");
  refuse_file(good, "mesh.nodes", "mesh.nodes");
  refuse_file(good, "data.file", "data.file");
  refuse_file(good, "ribbon.width, ribbon.width", "named twice");
  refuse_file(good, "ribbon.width,", "a comma has no key");
  refuse_file("load_g,load.mass_g,stroke_mm\n8,9,2\n9,9,3\n", "load.mass", "cannot be fitted");
  refuse_file("time_ms,stroke_mm\n2,2\n1,3\n", E, "bad.csv:3: times must not decrease");
  refuse_file("time_ms,stroke_mm,load_g\n1,2,8\n2,3,9\n", E, "bad.csv:3: column load_g: rows over time");
  refuse_file("load_g,stroke_mm,load.mass_kg\n8,2,0.008\n9,3,0.009\n", E,
              "column load.mass_kg: another column sets load.mass");
  refuse_file("load_g,stroke_mm,voltage_kV,drive.voltage_V\n8,2,1,1\n", E, "another column sets drive.voltage");
  refuse_file("load_g,stroke_mm\n8,\"2\n", E, "bad.csv:2: a quote is not closed");
  refuse_file("load_g;stroke_mm\n8;1.23,5\n", E, "text in a number column");
  refuse_file("load_g,stroke_mm\n8,\"1,5\"\n", E, "text in a number column");
  refuse_file("load_g,stroke_mm,sigma_mm\n8,2,0\n", E,
              "bad.csv:2: column sigma_mm: a standard deviation must be above 0");
  refuse_file("load_g,stroke_mm,sigma_g\n8,2,1\n", E, "column sigma_g: its unit must be one of the measured quantity");
  write_file("good.csv", good);
  ZpActuatorDef several = calibration("good.csv; bad.csv", E), renamed = calibration("good.csv", E), bounded = renamed;
  write_file("bad.csv", "load_g,opening_mm\n8,2\n");
  refuse_study(ZP_STUDY_CALIBRATE, &several,
               "measurement requires standard deviations of all, but stroke of good.csv has none");
  write_file("bad.csv", "load_g,stroke_mm\n8,x\n");
  refuse_study(ZP_STUDY_CALIBRATE, &several, "bad.csv:2: column stroke_mm");
  set_text(&renamed, "data.columns", "Masse = voltage_kV");
  refuse_study(ZP_STUDY_CALIBRATE, &renamed, "Masse: no such column in good.csv, which has load_g, stroke_mm");
  set_text(&renamed, "data.columns", "load_g");
  refuse_study(ZP_STUDY_CALIBRATE, &renamed, "name in the file = name in zipact");
  set_text(&bounded, "calibrate.bounds", "ribbon.thickness = 40 um .. 60 um");
  refuse_study(ZP_STUDY_CALIBRATE, &bounded, "ribbon.thickness is not in calibrate.fit");
  set_text(&bounded, "calibrate.bounds", "ribbon.young_modulus = 210 GPa .. 250 GPa");
  refuse_study(ZP_STUDY_CALIBRATE, &bounded, "the bounds must enclose its start value, 2e+11 Pa");
  set_text(&bounded, "calibrate.bounds", "ribbon.young_modulus = 210 mm .. 250 GPa");
  refuse_study(ZP_STUDY_CALIBRATE, &bounded, "calibrate.bounds: ribbon.young_modulus = \"210 mm\": not a pressure");
  refuse_file(good, "load.mass", "cannot be fitted");
  refuse_file(good, "mass_spring.shear_coefficient", "is auto");
  refuse_file(good, "damping.drag", "is 0");
  refuse_file(good, "ribbon.width, ribbon.thickness, load.share", "fewer than the 3 keys");
}

/* A triangle of height h against the axis, and two lines that cross. */
TEST(area_of_known_curves) {
  static const ZpColumn columns[] = {{"x_m", "m", ""}, {"y_m", "m", ""}};
  ZpTable *table = zp_table_create(columns, 2, 8);
  zp_table_offer(table, (double[]){0, 0});
  zp_table_offer(table, (double[]){0.01, 0});
  zp_table_offer(table, (double[]){0.02, 0.002});
  ZpReference reference;
  write_file("curve.csv", "x_mm,y_mm\n-5,0\n5,1\n10,0\n15,0\n");
  ck_assert_int_eq(zp_reference_read("curve.csv", &reference, NULL), ZP_OK);
  /* 2.2e-16 measured */
  ck_near(zp_reference_area(&reference, table), (0.75e-3 * 5e-3) + 0.5e-3 * 5e-3 + 0.5e-3 * 5e-3, 1e-11);
  zp_reference_free(&reference);
  write_file("curve.csv", "x_m,y_m\n0.01,0.001\n0.02,0.001\n");
  ck_assert_int_eq(zp_reference_read("curve.csv", &reference, NULL), ZP_OK);
  ck_near(zp_reference_area(&reference, table), 0.5e-3 * 1e-2, 1e-11); /* 0 measured */
  zp_reference_free(&reference);
  write_file("curve.csv", "x_m,y_m\n0.05,0.001\n0.06,0.001\n");
  ck_assert_int_eq(zp_reference_read("curve.csv", &reference, NULL), ZP_OK);
  ck_assert(isnan(zp_reference_area(&reference, table)));
  zp_reference_free(&reference);
  zp_table_destroy(table);
}

/* The own shape as reference leaves no area; other columns do no harm. */
TEST(area_error_of_stationary) {
  ZpActuatorDef def = zp_actuator_def_default();
  ZpResult *result = data_study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert(isnan(zp_result_get(result, "area_error_m2")));
  FILE *file = fopen("shape.csv", "w");
  fprintf(file, "station,x_m,y_m\n");
  for (size_t i = 0; i < result->series->rows; i++)
    fprintf(file, "-,%.17g,%.17g\n", zp_table_get(result->series, i, "x_m"), zp_table_get(result->series, i, "y_m"));
  fclose(file);
  set_text(&def, "data.file", "shape.csv");
  result = data_study_of(ZP_STUDY_STATIONARY, &def);
  ck_below(zp_result_get(result, "area_error_m2"), 1e-12);
  write_file("shape.csv", "x_mm,y_mm\n1,2\n1,3\n");
  refuse_study(ZP_STUDY_STATIONARY, &def, "x must increase");
  write_file("shape.csv", "x_mm,height_mm\n1,2\n1,3\n");
  refuse_study(ZP_STUDY_STATIONARY, &def, "no column y_m");
}

/* Elements that hang under another load, and are drawn beside it, lie on those of the area error, which hang at the
 * same stroke by another gravity. */
TEST(area_error_at_a_stroke) {
  ZpActuatorDef def = zp_actuator_def_default(), heavy;
  set(&def, "ribbon.density", 0);
  set(&def, "insulator.density", 0);
  set(&def, "mesh.nodes", 15);
  set(&def, "output.errors", 0);
  heavy = def;
  heavy.load.mass = 3 * def.load.mass;
  ZpResult *chain = data_study_of(ZP_STUDY_STATIONARY, &heavy);
  ZpTable *shape = chain->series;
  const double whole = fabs(zp_table_get(shape, shape->rows - 1, "x_m") * zp_table_get(shape, shape->rows - 1, "y_m"));
  size_t x = 0;
  while (strcmp(shape->column[x].name, "x_m") != 0)
    x++;
  for (size_t i = 0; i < shape->rows; i++)
    shape->value[i * shape->columns + x] += 5e-3;
  double area = zp_area_error(chain, def, zp_result_get(chain, "stroke_m"));
  printf("area error %.2g of %.2g m2\n", area, whole);
  ck_assert_double_lt(area, 1e-5 * whole);
}

/* Columns that are keys set them for their row; with nothing to fit the rows are only compared. */
TEST(rows_of_different_actuators_are_compared) {
  ZpActuatorDef def = calibration("rows.csv", " "), thick = def;
  thick.ribbon.thickness = 100e-6;
  char text[256];
  snprintf(text, sizeof text, "force_N,ribbon.thickness_um,remark,stroke_mm\n%.17g,50,a,%.17g\n%.17g,100,b,%.17g\n",
           0.008 * def.gravity, 1e3 * stroke(def, 0.008), 0.03 * def.gravity, 1e3 * stroke(thick, 0.03));
  write_file("rows.csv", text);
  set_text(&def, "calibrate.y", "stroke_mm");
  ZpResult *result = fit(&def);
  ck_below(zp_result_get(result, "residual_rms_m"), 1e-12);
  ck_assert_uint_eq(result->series->rows, 2);
}

/* Of the published experiments only those of thickness were compared, not the rows of length and width, three of which
 * are far off. All rows are there, as they were read; weightless, ours is twice the guided elastica of half the length
 * under half of the load. (Not so for 20 um, first: at p = 109 the oracle finds another branch.) */
TEST(published_experiments_of_length_and_width_are_compared) {
  static const struct {
    double thickness, length, width, load, opening; /* um, mm, mm, g, mm */
  } row[] = {{20, 100, 12.7, 15, 85},  {50, 100, 12.7, 30, 55},    {100, 100, 12.7, 50, 29},
             {200, 100, 12.7, 100, 7}, {500, 100, 12.7, 500, 2.1}, {1000, 100, 12.7, 1200, 0.8},
             {50, 10, 12.7, 290, 0.8}, {50, 20, 12.7, 110, 3},     {50, 50, 12.7, 43, 19},
             {50, 100, 12.7, 30, 60},  {50, 200, 12.7, 9, 120},    {50, 100, 6, 7, 35},
             {50, 100, 12.7, 30, 60},  {50, 100, 25, 40, 55}};
  const size_t rows = sizeof row / sizeof row[0];
  ZpScenario *scenario = new_scenario();
  ZpActuatorDef def = zp_actuator_def_default();
  ck_assert_int_eq(zp_scenario_read(scenario, ZP_SOURCE_DIR "/examples/experiments.yaml", NULL), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(scenario, "ribbon.density=0", NULL), ZP_OK);
  ck_assert_int_eq(zp_scenario_def(scenario, 0, &def, NULL), ZP_OK);
  ZpResult *result = fit(&def);
  ck_assert_uint_eq(result->series->rows, rows);
  for (size_t i = 0; i < rows; i++) {
    const double half = 0.5e-3 * row[i].length, b = 1e-6 * row[i].thickness, w = 1e-3 * row[i].width;
    const double EI = def.ribbon.young_modulus * w * b * b * b / 12;
    const Elastica exact = elastica(0.5e-3 * row[i].load * def.gravity * half * half / EI, 0, true);
    ck_near(zp_table_get(result->series, i, "measured_m"), 1e-3 * row[i].opening, 1e-12);
    ck_assert(exact.found);
    if (i > 0) ck_near(zp_table_get(result->series, i, "fitted_m"), 2 * half * exact.y, 1e-3);
  }
}

/* Force against stroke is stroke against force. */
TEST(force_against_stroke) {
  ZpActuatorDef def = calibration("force.csv", "ribbon.young_modulus"), truth = def;
  truth.ribbon.young_modulus = 170e9;
  FILE *file = fopen("force.csv", "w");
  fputs("stroke_mm,force_N\n", file);
  for (int i = 1; i <= 4; i++)
    fprintf(file, "%.17g,%.17g\n", 1e3 * stroke(truth, 0.004 * i), 0.004 * i * def.gravity);
  ck_assert_int_eq(fclose(file), 0);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 170e9, 1e-11); /* 4.4e-16 measured */
  ck_assert_str_eq(result->series->column[0].name, "load.mass_kg");
}

/* The force on a held platform against voltage and separation: the permittivity of the liquid. */
TEST(held_force_data) {
  static const double volts[] = {2000, 4000, 6000, 3000, 5000}, mm[] = {1, 2, 4, 6, 3};
  for (int by_separation = 0; by_separation < 2; by_separation++) {
    ZpActuatorDef def = calibration("held.csv", "medium.permittivity"), truth;
    ZpResult *result;
    set(&def, "mesh.nodes", 11);
    truth = def;
    truth.medium.permittivity = 2.2;
    FILE *file = fopen("held.csv", "w");
    fputs(by_separation ? "isometric.separation_mm,force_mN,voltage_kV\n"
                        : "voltage_kV,force_mN,isometric.separation_mm\n",
          file);
    for (size_t i = 0; i < 5; i += FULL_OR(2, 4)) {
      truth.drive.voltage = volts[i];
      truth.isometric.separation = 1e-3 * mm[i];
      result = data_study_of(ZP_STUDY_ISOMETRIC, &truth);
      double mN = 1e3 * zp_result_get(result, "force_N"), kV = 1e-3 * volts[i];
      fprintf(file, "%.17g,%.17g,%.17g\n", by_separation ? mm[i] : kV, mN, by_separation ? kV : mm[i]);
    }
    ck_assert_int_eq(fclose(file), 0);
    result = fit(&def);
    ck_near(zp_result_get(result, "medium.permittivity"), 2.2, 1e-11); /* 0 measured */
    ck_below(zp_result_get(result, "residual_rms_N"), 1e-11);          /* 1.2e-17 measured */
    ck_assert_str_eq(result->series->column[0].name, by_separation ? "isometric.separation_m" : "drive.voltage_V");
    ck_assert_str_eq(result->series->column[1].name, "measured_N");
  }
}

/* A number of a study against the load: what the data were made with is found again. */
static void find_again(const char *column, const char *key, double truth, ZpStudy study, const char *number) {
  ZpActuatorDef def = calibration("number.csv", key);
  char text[512];
  set(&def, "mesh.nodes", 9);
  set(&def, "drive.voltage", 12e3);
  int used = snprintf(text, sizeof text, "load_g,%s\n", column);
  for (int grams = 4; grams <= 8; grams += 4) {
    ZpActuatorDef row = def;
    set(&row, key, truth);
    set(&row, "load.mass", 1e-3 * grams);
    set(&row, "output.errors", 0);
    used += snprintf(text + used, sizeof text - (size_t)used, "%d,%.12g\n", grams, scalar_of(study, &row, number));
  }
  write_file("number.csv", text);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, key), truth, 1e-9); /* 4.7e-10 measured */
}

TEST(limits_and_frequencies) {
  find_again("pull_in_voltage_V", "insulator.permittivity", 4.1, ZP_STUDY_LIMITS, "pull_in_voltage_V");
  find_again("release_voltage_V", "insulator.permittivity", 4.1, ZP_STUDY_LIMITS, "release_voltage_V");
  find_again("frequency_Hz", "ribbon.young_modulus", 185e9, ZP_STUDY_MODES, "frequency_1_Hz");
}

/* Frequencies of a cantilever by the formula of Euler and Bernoulli, f = 1.8751^2 / (2 pi L^2) sqrt(E t^2 / (12 rho)),
 * with 190 GPa. */
TEST(modulus_from_the_frequencies_of_a_cantilever) {
  ZpActuatorDef def = calibration("cantilever.csv", "ribbon.young_modulus");
  def.actuator.kind = ZP_KIND_RIBBON;
  def.actuator.right_end = ZP_END_FREE;
  set(&def, "mesh.nodes", 61);
  set(&def, "ribbon.plane", ZP_PLANE_STRESS);
  set(&def, "load.mass", 0);
  set(&def, "gravity", 0);
  set(&def, "insulator.density", 0);
  set(&def, "insulator.young_modulus", 0);
  FILE *file = fopen("cantilever.csv", "w");
  fputs("ribbon.length_mm,frequency_Hz\n", file);
  for (int mm = 40; mm <= 80; mm += 20) {
    double L = 1e-3 * mm, t = def.ribbon.thickness;
    double f = pow(1.8751040687 / L, 2) * sqrt(190e9 * t * t / 12 / def.ribbon.density) / (8 * atan(1));
    fprintf(file, "%d,%.12g\n", mm, f);
  }
  ck_assert_int_eq(fclose(file), 0);
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 190e9, 1e-3); /* the mesh's */
}

/* The capacitance at rest below pull-in is that of the branch of study equilibrium. */
TEST(capacitances_at_rest) {
  ZpActuatorDef def = calibration("capacitance.csv", "medium.permittivity"), truth;
  set(&def, "mesh.nodes", 15);
  truth = def;
  truth.medium.permittivity = 2.4;
  *truth.data.file = 0;
  ZpResult *result = data_study_of(ZP_STUDY_EQUILIBRIUM, &truth);
  double pull_in = zp_result_get(result, "pull_in_voltage_V");
  FILE *file = fopen("capacitance.csv", "w");
  fputs("voltage_V,capacitance_pF\n", file);
  for (size_t row = 1; row < result->series->rows && zp_table_get(result->series, row, "voltage_V") < 0.99 * pull_in;
       row++)
    fprintf(file, "%.17g,%.17g\n", zp_table_get(result->series, row, "voltage_V"),
            1e12 * zp_table_get(result->series, row, "capacitance_F"));
  ck_assert_int_eq(fclose(file), 0);
  result = fit(&def);
  ck_assert_uint_gt(result->series->rows, 3);
  ck_near(zp_result_get(result, "medium.permittivity"), 2.4, 3e-10); /* 4.2e-11 measured */
  ck_assert_str_eq(result->series->column[1].name, "measured_F");
}

/* A ribbon that swings, slowed by drag, from straight. */
static ZpActuatorDef swinging(const char *files, const char *keys) {
  ZpActuatorDef def = calibration(files, keys);
  def.actuator.kind = ZP_KIND_RIBBON;
  def.actuator.right_end = ZP_END_FREE;
  def.ribbon.length = 0.045;
  def.ribbon.thickness = 100e-6;
  def.load.mass = 0.002;
  def.load.share = 1;
  def.initial.state = ZP_INITIAL_STRAIGHT;
  def.mesh.nodes = 9;
  def.solver.tolerance = 1e-7; /* steps that end at the rows and others agree */
  return def;
}

/* Its strokes over time. */
static void write_swing(const char *path, const ZpActuatorDef *def) {
  ZpSim *sim = sim_of(model_of(def));
  FILE *file = fopen(path, "w");
  fputs("time_ms,stroke_mm\n", file);
  for (int i = 0; i <= 8; i++) {
    if (i) zp_sim_run(sim, 0.01 * i, false, NULL, NULL);
    fprintf(file, "%d,%.17g\n", 10 * i, 1e3 * zp_sim_get(sim, "stroke"));
  }
  ck_assert_int_eq(fclose(file), 0);
}

/* The drag is found again from the stroke over time. */
TEST(drag_is_found_from_a_swing) {
  ZpActuatorDef def = swinging("swing.csv", "damping.drag");
  def.damping.drag = 0.03;
  write_swing("swing.csv", &def);
  def.damping.drag = 0.05;
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "damping.drag"), 0.03, 3e-9); /* 1.0e-9 measured */
  ck_assert_str_eq(result->series->column[0].name, "time_s");
}

/* A capacitance over time is that of the run, row by row. */
TEST(capacitance_of_a_run) {
  ZpActuatorDef def = calibration("charging.csv", " ");
  set(&def, "mesh.nodes", 9);
  set(&def, "solver.tolerance", 1e-7);
  ZpSim *sim = sim_of(model_of(&def));
  FILE *file = fopen("charging.csv", "w");
  fputs("time_ms,capacitance_pF\n", file);
  for (int ms = 1; ms <= 3; ms++) {
    zp_sim_run(sim, 1e-3 * ms, false, NULL, NULL);
    fprintf(file, "%d,%.17g\n", ms, 1e12 * zp_sim_get(sim, "capacitance"));
  }
  ck_assert_int_eq(fclose(file), 0);
  ZpResult *result = fit(&def);
  ck_below(zp_result_get(result, "residual_rms_F"), 1.5e-21); /* 5.3e-22 measured */
}

/* Zip times under two loads: the pull-in that is shown is that of the last one. */
TEST(pull_in_of_the_last_zip_time) {
  ZpActuatorDef def = calibration("last.csv", " "), last = def;
  set(&def, "mesh.nodes", 9);
  write_file("last.csv", "load_g,zip_time_ms\n4,10\n6,10\n");
  ZpResult *result = fit(&def);
  last = def;
  last.load.mass = 6e-3;
  last.output.errors = false;
  ck_near(zp_result_get(result, "pull_in_voltage_V"), scalar_of(ZP_STUDY_LIMITS, &last, "pull_in_voltage_V"), 1e-12);
}

/* A simulation of a definition that names a checkpoint begins where that was taken, and only for its own model. */
TEST(simulation_begins_at_its_checkpoint) {
  ZpActuatorDef def = zp_actuator_def_default();
  ZpModel *model;
  ZpCheckpoint *checkpoint;
  set(&def, "mesh.nodes", 9);
  ZpSim *sim = data_sim_of(&def);
  zp_sim_run(sim, 2e-3, false, NULL, NULL);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &checkpoint, NULL), ZP_OK);
  const double taken = zp_checkpoint_time(checkpoint);
  ck_assert(taken > 1e-3 && taken <= 2e-3);
  FILE *file = fopen("begins.zps", "w");
  ck_assert_int_eq(zp_checkpoint_write(checkpoint, file, NULL), ZP_OK);
  ck_assert_int_eq(fclose(file), 0);
  zp_checkpoint_destroy(checkpoint);
  zp_sim_run(sim, 4e-3, false, NULL, NULL);
  const double stroke = zp_sim_get(sim, "stroke");
  set(&def, "initial.state", ZP_INITIAL_CHECKPOINT);
  set_text(&def, "initial.file", "begins.zps");
  sim = data_sim_of(&def);
  ck_assert_double_eq(zp_sim_get(sim, "time"), taken); /* the last step before 2 ms */
  zp_sim_run(sim, 4e-3, false, NULL, NULL);
  ck_near(zp_sim_get(sim, "stroke"), stroke, 3e-7); /* 7e-8: the next step has another length */
  set(&def, "ribbon.thickness", 60e-6);
  ck_says(zp_data_sim_create(&def, NULL, &model, &sim, &err), ZP_BAD_INPUT,
          "ribbon.thickness is 5e-05 m there, 6e-05 m here");
}

/* A limit of CPU time counts from the start of the study, not from that of the thread. */
TEST(time_limit_counts_from_the_start_of_a_study) {
  ZpActuatorDef def = zp_actuator_def_default();
  set(&def, "mesh.nodes", 9);
  set(&def, "output.errors", 0);
  set(&def, "solver.max_cpu_time", FULL_OR(0.05, 0.5));
  while ((double)clock() < FULL_OR(0.1, 1) * CLOCKS_PER_SEC)
    continue;
  ck_assert_double_gt(scalar_of(ZP_STUDY_LIMITS, &def, "pull_in_voltage_V"), 1e3);
}

/* Drag and modulus from two runs in time and strokes at rest, all of one kind: they need no standard deviations. */
NIGHTLY_TEST(rest_and_motion_in_one_fit) {
  ZpActuatorDef def = swinging("motion.csv; sag.csv; motion.csv", "damping.drag, ribbon.young_modulus");
  def.damping.drag = 0.03;
  write_swing("motion.csv", &def);
  FILE *file = fopen("sag.csv", "w");
  fputs("load_g,stroke_mm\n", file);
  for (int i = 1; i <= 3; i++)
    fprintf(file, "%d,%.17g\n", i, 1e3 * at_rest(def, ZP_FIT_STROKE, 1e-3 * i, 0));
  ck_assert_int_eq(fclose(file), 0);
  def.damping.drag = 0.05;
  def.ribbon.young_modulus *= 0.9;
  ZpResult *result = fit(&def);
  ck_near(zp_result_get(result, "damping.drag"), 0.03, 8.9e-10);        /* 3e-10 measured */
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 200e9, 1e-10); /* 1.3e-13 measured */
  ck_assert_uint_eq(result->series->rows, 21);
  ck_assert_uint_eq(result->series->columns, 5 + 2 + 2); /* those of all kinds, and one for each key */
  ck_assert(isnan(zp_table_get(result->series, 10, "time_s")));
  ck_near(zp_table_get(result->series, 10, "load.mass_kg"), 2e-3, 1e-12);
}
