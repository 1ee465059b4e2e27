/* Study plan: which measurements it chooses, against closed forms and all subsets of small lists, and whether a fit to
 * the chosen ones has the errors that it expects. */
#include <zipact/rest.h>

#include "data_util.h"
#include "fit/selection.h"

/* -- the choice, of linear models ------------------------------------------------------------------------ */

enum { ROWS_MOST = 40 };

/* A linear model: values are J z, with a standard deviation of 1. */
typedef struct Linear {
  double J[3 * ROWS_MOST];
  ZpMeasurement among[ROWS_MOST];
  ZpSelection selection;
} Linear;

/* `keys` of the `n` parameters are keys; `before`: information about each parameter. */
static void make(Linear *linear, int keys, int n, size_t rows, double before, ZpPlanCriterion criterion) {
  linear->selection = (ZpSelection){.keys = keys,
                                    .n = n,
                                    .criterion = criterion,
                                    .size = {1, 1, 1, 1, 1},
                                    .J = linear->J,
                                    .among = linear->among,
                                    .count = rows};
  for (int k = 0; k < n; k++)
    linear->selection.start.of[k][k] = before;
  for (size_t i = 0; i < rows; i++)
    linear->among[i] = (ZpMeasurement){i, 1, 1};
}

/* y = a + b x at x from -1 to 1. */
static void make_line(Linear *line, size_t rows, ZpPlanCriterion criterion) {
  make(line, 2, 2, rows, 1e-6, criterion);
  double *J = line->J;
  for (size_t i = 0; i < rows; i++)
    J[2 * i] = 1, J[2 * i + 1] = 2.0 * (double)i / ((double)rows - 1) - 1;
}

/* Random derivatives by all parameters. */
static void draw(Linear *linear, uint64_t seed) {
  double *J = linear->J;
  for (size_t i = 0; i < linear->selection.count * (size_t)linear->selection.n; i++)
    J[i] = noise(&seed);
}

/* The best two points of a line are its ends, then again its ends if they are listed twice; the variances of both
 * coefficients are 1/2 and 1/4. */
TESTS(ends_of_a_line, 0, 2) {
  Linear line;
  size_t chosen[4];
  ZpInformation sum, covariance;
  make_line(&line, 21, _i ? ZP_PLAN_A : ZP_PLAN_D);
  ck_assert(zp_selection_best(&line.selection, 2, chosen));
  ck_assert_uint_eq(chosen[0] + chosen[1], 20);
  ck_assert(chosen[0] == 0 || chosen[1] == 0);
  sum = line.selection.start;
  for (int k = 0; k < 2; k++)
    zp_selection_add(&line.selection, chosen[k], 1, &sum);
  ck_assert(zp_selection_covariance(&line.selection, &sum, &covariance));
  ck_near(covariance.of[0][0], 0.5, 1e-6);
  ck_near(covariance.of[1][1], 0.5, 1e-6);
  line.among[5] = line.among[0];
  line.among[9] = line.among[20];
  ck_assert(zp_selection_best(&line.selection, 4, chosen));
  for (int k = 0; k < 4; k++)
    ck_assert_uint_eq(line.among[chosen[k]].first % 20, 0);
  const double value = zp_selection_value_of(&line.selection, chosen, 4);
  ck_near(value, _i ? -0.5 : 2 * log(4), 7.5e-7);                   /* 2.5e-7 measured */
  ck_near(zp_selection_error(&line.selection, value), 0.5, 3.7e-7); /* 1.2e-7 measured */
}

/* A shift of all readings leaves of a line its slope: (12.8) with the centred sum of squares. */
TEST(shift_is_eliminated) {
  Linear line;
  size_t all[ROWS_MOST];
  make_line(&line, 5, ZP_PLAN_D);
  line.selection.keys = 1;
  line.selection.start.of[0][0] = line.selection.start.of[1][1] = 1e-9;
  for (size_t i = 0; i < 5; i++) { /* slope first, then the shift */
    line.J[2 * i] = 3 + 2.0 * (double)i;
    line.J[2 * i + 1] = 1;
    all[i] = i;
  }
  ck_near(zp_selection_value_of(&line.selection, all, 5), log(40), 1e-9);
}

/* ln (1 + v^T C v) of all parameters, less that of the shifts alone, (12.10). */
static double gain_of(const ZpSelection *of, const ZpInformation *before, size_t which) {
  ZpSelection all = *of, shifts = *of;
  ZpInformation C, only = {{{0}}};
  const size_t n = (size_t)of->n, keys = (size_t)of->keys;
  const double *v = of->J + which * n;
  double whole = 1, part = 1;
  all.keys = of->n;
  ck_assert(zp_selection_covariance(&all, before, &C));
  for (size_t a = 0; a < n; a++)
    for (size_t b = 0; b < n; b++)
      whole += v[a] * C.of[a][b] * v[b];
  for (size_t a = keys; a < n; a++)
    for (size_t b = keys; b < n; b++)
      only.of[a - keys][b - keys] = before->of[a][b];
  shifts.keys = shifts.n = (int)(n - keys);
  ck_assert(zp_selection_covariance(&shifts, &only, &C));
  for (size_t a = keys; a < n; a++)
    for (size_t b = keys; b < n; b++)
      part += v[a] * C.of[a - keys][b - keys] * v[b];
  return log(whole / part);
}

/* The gains are those of (12.10), the largest one of those chosen comes first, and the determinant afterwards is their
 * product. */
TESTS(determinant_is_the_product_of_gains, 0, 5) {
  enum { CHOSEN = 6 };
  Linear linear;
  size_t chosen[CHOSEN];
  double product = 0;
  make(&linear, 2, 3, 15, 0.1, ZP_PLAN_D);
  draw(&linear, (uint64_t)_i + 1);
  ck_assert(zp_selection_best(&linear.selection, CHOSEN, chosen));
  ZpInformation sum = linear.selection.start;
  for (size_t k = 1; k < CHOSEN; k++)
    ck_assert_double_ge(zp_selection_value_of(&linear.selection, chosen, 1),
                        zp_selection_value_of(&linear.selection, chosen + k, 1));
  for (size_t k = 0; k < CHOSEN; k++) {
    const double gain = gain_of(&linear.selection, &sum, chosen[k]),
                 before = zp_selection_value(&linear.selection, &sum);
    zp_selection_add(&linear.selection, chosen[k], 1, &sum);
    ck_assert_double_eq_tol(zp_selection_value(&linear.selection, &sum) - before, gain, 5e-15);
    product += gain;
  }
  ck_assert_double_eq_tol(zp_selection_value_of(&linear.selection, chosen, CHOSEN) -
                              zp_selection_value(&linear.selection, &linear.selection.start),
                          product, 5e-15);
}

/* The best value of the criterion over all subsets of four. */
static double best_of_all(const ZpSelection *of) {
  double best = -INFINITY;
  size_t s[4];
  for (s[0] = 0; s[0] < of->count; s[0]++)
    for (s[1] = s[0] + 1; s[1] < of->count; s[1]++)
      for (s[2] = s[1] + 1; s[2] < of->count; s[2]++)
        for (s[3] = s[2] + 1; s[3] < of->count; s[3]++)
          best = fmax(best, zp_selection_value_of(of, s, 4));
  return best;
}

/* Of 100 random lists of twelve, the four that are chosen are the best of all subsets in most, and the error is hardly
 * larger in the others. */
TESTS(best_of_all_subsets, 0, 2) {
  enum { LISTS = 100 };
  int found = 0;
  double worst = 1;
  for (uint64_t seed = 1; seed <= LISTS; seed++) {
    Linear linear;
    size_t chosen[4];
    make(&linear, 2, 3, 12, 1e-3, _i ? ZP_PLAN_A : ZP_PLAN_D);
    draw(&linear, seed);
    ck_assert(zp_selection_best(&linear.selection, 4, chosen));
    const double value = zp_selection_value_of(&linear.selection, chosen, 4), best = best_of_all(&linear.selection);
    const double ratio = zp_selection_error(&linear.selection, value) / zp_selection_error(&linear.selection, best);
    ck_assert_double_ge(ratio, 1 - 1e-12);
    found += ratio < 1 + 1e-9;
    worst = fmax(worst, ratio);
  }
  printf("best in %d of %d, worst ratio %g\n", found, LISTS, worst);
  ck_assert_int_ge(found, 90);
  ck_assert_double_le(worst, 1.2);
}

TEST(even_rows_have_the_ends) {
  static const size_t expected[] = {0, 3, 5, 8, 10};
  ZpSelection of = {.count = 11};
  size_t chosen[5];
  zp_selection_even(&of, 5, chosen);
  for (size_t k = 0; k < 5; k++)
    ck_assert_uint_eq(chosen[k], expected[k]);
  zp_selection_even(&of, 1, chosen);
  ck_assert_uint_eq(chosen[0], 5);
}

/* -- the study --------------------------------------------------------------------------------------------- */

static void put(ZpActuatorDef *def, const char *key, const char *text) {
  ck_ok(zp_def_set_text(def, zp_key_find(key), text, &err));
}

static ZpActuatorDef planned(const char *keys, int budget) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 11;
  def.liquid.model = ZP_LIQUID_NONE;
  def.output.errors = false;
  def.plan.budget = budget;
  put(&def, "plan.candidates", "list.csv");
  put(&def, "calibrate.fit", keys);
  put(&def, "calibrate.sigma", "stroke = 5 um");
  return def;
}

static ZpResult *plan(const ZpActuatorDef *def) {
  ZpResult *result = data_study_of(ZP_STUDY_PLAN, def);
  printf("%s\n", result->message);
  return result;
}

static double number(const ZpResult *result, const char *name) {
  return zp_result_get(result, name);
}

static double stroke_at(const ZpActuatorDef *def, double load, double voltage) {
  ZpActuatorDef at = *def;
  ZpModel *model;
  ZpRest *rest;
  at.load.mass = load;
  ck_ok(zp_model_create(&at, &model, &err));
  ck_ok(zp_rest_create(model, &rest, &err));
  ck_assert(zp_rest_hang(rest, voltage));
  const double stroke = zp_rest_stroke(rest);
  zp_rest_destroy(rest);
  zp_model_destroy(model);
  return stroke;
}

/* Derivative of a stroke by the logarithm of a key, over the standard deviation. */
static double slope(const ZpActuatorDef *def, double *key, double voltage) {
  const double value = *key, step = 1e-3;
  *key = value * (1 + step);
  const double up = stroke_at(def, 8e-3, voltage);
  *key = value * (1 - step);
  const double down = stroke_at(def, 8e-3, voltage);
  *key = value;
  return (up - down) / (2 * step) / 5e-6;
}

/* Three strokes without and three with a voltage: one of each tells the modulus and the permittivity, and the
 * determinant of their relative covariance is 1 over that of the derivatives squared, up to what was assumed before. */
TEST(two_voltages_tell_two_keys) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 2);
  put(&def, "calibrate.y", "stroke_mm");
  write_file("list.csv", "load_g,voltage_kV,stroke_mm\n8,0,\n8,0,\n8,0,\n8,3,\n8,3,\n8,3,\n");
  const ZpResult *result = plan(&def);
  const double none =
      zp_table_get(result->series, 0, "drive.voltage_V") + zp_table_get(result->series, 1, "drive.voltage_V");
  ck_assert_double_eq(none, 3e3);
  double *E = &def.ribbon.young_modulus, *eps = &def.insulator.permittivity;
  const double a = slope(&def, E, 0), b = slope(&def, eps, 0), c = slope(&def, E, 3e3), d = slope(&def, eps, 3e3);
  const double determinant = (a * a + c * c + 1) * (b * b + d * d + 1) - (a * b + c * d) * (a * b + c * d);
  ck_near(number(result, "planned_relative_error"), pow(determinant, -0.25), 1.1e-6);
  ck_near(zp_table_get(result->series, 1, "predicted_stroke_m"),
          stroke_at(&def, 8e-3, zp_table_get(result->series, 1, "drive.voltage_V")), 1e-15); /* 0 measured */
  ck_assert_double_eq_tol(zp_table_get(result->series, 0, "share") + zp_table_get(result->series, 1, "share"), 1,
                          1e-12);
}

/* What was assumed: each key is known to its own size, and a note says so. */
TEST(nothing_is_known_before) {
  ZpActuatorDef def = planned("ribbon.young_modulus", 1);
  write_file("list.csv", "load_g,stroke_mm\n4,\n8,\n");
  const ZpResult *result = plan(&def);
  ck_near(number(result, "ribbon.young_modulus_standard_error"), 200e9, 1e-15); /* 0 measured */
  ck_near(number(result, "ribbon.young_modulus_half_width_95"), 1.959964 * 200e9, 2.3e-8);
  ck_assert_uint_eq(result->notes, 1);
  ck_assert_ptr_nonnull(strstr(result->note[0], "without data.file"));
}

/* Strokes of the model for the chosen rows, as a bench would measure them. */
static void measure_rows(const ZpActuatorDef *def, const ZpResult *plan, const char *path) {
  FILE *file = fopen(path, "w");
  fputs("load_g,voltage_kV,stroke_mm\n", file);
  for (size_t k = 0; k < plan->series->rows; k++) {
    const double load = zp_table_get(plan->series, k, "load.mass_kg"),
                 voltage = zp_table_get(plan->series, k, "drive.voltage_V");
    fprintf(file, "%.17g,%.17g,%.17g\n", 1e3 * load, 1e-3 * voltage, 1e3 * stroke_at(def, load, voltage));
  }
  ck_assert_int_eq(fclose(file), 0);
}

static void write_grid(void) {
  FILE *file = fopen("list.csv", "w");
  fputs("load_g,voltage_kV\n", file);
  for (int load = 4; load <= 20; load += 4)
    for (int voltage = 0; voltage <= 3; voltage++)
      fprintf(file, "%d,%d\n", load, voltage);
  ck_assert_int_eq(fclose(file), 0);
}

/* A fit to the chosen rows has the standard errors that were expected; an absent column that calibrate.y names is one
 * that is empty. */
TEST(fit_has_the_expected_errors) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 5);
  write_grid();
  put(&def, "calibrate.y", "stroke_mm");
  const ZpResult *expected = plan(&def);
  measure_rows(&def, expected, "made.csv");
  put(&def, "data.file", "made.csv");
  const ZpResult *fitted = data_study_of(ZP_STUDY_CALIBRATE, &def);
  ck_near(number(expected, "ribbon.young_modulus_planned_standard_error"),
          number(fitted, "ribbon.young_modulus_standard_error"), 1.2e-4);
  ck_near(number(expected, "insulator.permittivity_planned_standard_error"),
          number(fitted, "insulator.permittivity_standard_error"), 7e-4);
}

/* The least number of even rows that limit the keys as much as a plan. */
TEST(even_rows_for_as_much) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 5);
  write_grid();
  put(&def, "calibrate.y", "stroke_mm");
  const ZpResult *few = plan(&def);
  def.plan.budget = 20;
  const ZpTable *all = plan(&def)->series;
  const double error = number(few, "planned_relative_error");
  const size_t even = (size_t)number(few, "even_rows");
  for (size_t k = 0; k + 1 < even; k++)
    ck_assert_double_gt(zp_table_get(all, k, "even_relative_error"), error);
  ck_assert_double_le(zp_table_get(all, even - 1, "even_relative_error"), error);
}

/* Likewise beside data, where the zero of each file is unknown: now as a fit to the data alone, then as one to both. */
TEST(fit_beside_data_has_the_expected_errors) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 4);
  write_grid();
  put(&def, "calibrate.y", "stroke_mm");
  put(&def, "calibrate.offsets", "stroke");
  FILE *file = fopen("data.csv", "w");
  fputs("load_g,voltage_kV,stroke_mm\n", file);
  for (int k = 0; k < 6; k++)
    fprintf(file, "%d,%d,%.17g\n", 4 + 3 * k, k % 2 * 3, 1e3 * stroke_at(&def, 1e-3 * (4 + 3 * k), k % 2 * 3e3));
  ck_assert_int_eq(fclose(file), 0);
  put(&def, "data.file", "data.csv");
  const ZpResult *expected = plan(&def), *before = data_study_of(ZP_STUDY_CALIBRATE, &def);
  ck_assert_int_eq(expected->outcome, ZP_CONVERGED);
  measure_rows(&def, expected, "made.csv");
  put(&def, "data.file", "data.csv; made.csv");
  const ZpResult *both = data_study_of(ZP_STUDY_CALIBRATE, &def);
  const char *const keys[] = {"ribbon.young_modulus", "insulator.permittivity"};
  for (int k = 0; k < 2; k++) {
    char now[64], then[64];
    snprintf(now, sizeof now, "%s_standard_error", keys[k]);
    snprintf(then, sizeof then, "%s_planned_standard_error", keys[k]);
    ck_near(number(expected, now), number(before, now), 1e-12);
    ck_near(number(expected, then), number(both, now), 1.8e-6);
  }
}

/* Strokes of four loads without voltage, alternately off by this much, mm => data.csv. */
static void measure_strokes(const ZpActuatorDef *def, double off) {
  FILE *file = fopen("data.csv", "w");
  fputs("load_g,stroke_mm\n", file);
  for (int k = 0; k < 4; k++)
    fprintf(file, "%d,%.17g\n", 4 + 3 * k, 1e3 * stroke_at(def, 1e-3 * (4 + 3 * k), 0) + (k % 2 ? off : -off));
  ck_assert_int_eq(fclose(file), 0);
}

/* Without standard deviations that of the residuals counts, with Student's factor for their number. */
TEST(residuals_tell_the_deviation) {
  ZpActuatorDef def = planned("ribbon.young_modulus", 2);
  put(&def, "calibrate.sigma", "");
  put(&def, "data.file", "data.csv");
  write_file("list.csv", "load_g,stroke_mm\n4,\n8,\n12,\n");
  measure_strokes(&def, 0.01);
  const ZpResult *expected = plan(&def), *before = data_study_of(ZP_STUDY_CALIBRATE, &def);
  const char *now = "ribbon.young_modulus_standard_error";
  ck_near(number(expected, now), number(before, now), 1e-15); /* 2.2e-16 measured */
  ck_near(number(expected, "ribbon.young_modulus_half_width_95"), zp_fit_student(3) * number(before, now),
          1e-15); /* 3.3e-16 measured */
  ck_near(number(expected, "ribbon.young_modulus_planned_half_width_95"),
          zp_fit_student(5) * number(expected, "ribbon.young_modulus_planned_standard_error"), 1e-15); /* 0 measured */
  char sigma[64];
  snprintf(sigma, sizeof sigma, "stroke = %.17g m", sqrt(4.0 / 3) * number(before, "residual_rms_m"));
  put(&def, "calibrate.sigma", sigma);
  ck_near(number(plan(&def), "ribbon.young_modulus_planned_standard_error"),
          number(expected, "ribbon.young_modulus_planned_standard_error"), 1.2e-11); /* 3.8e-12 measured */
}

/* Strokes without voltage tell the modulus; the permittivity keeps its given value, and counts as known to it. */
TEST(key_that_data_do_not_limit_keeps_its_value) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 2);
  put(&def, "data.file", "data.csv");
  put(&def, "calibrate.y", "stroke_mm");
  write_file("list.csv", "load_g,voltage_kV,stroke_mm\n8,0,\n8,2,\n8,3,\n");
  measure_strokes(&def, 0);
  def.ribbon.young_modulus = 170e9;
  const ZpResult *result = plan(&def);
  ck_near(number(result, "ribbon.young_modulus"), 200e9, 4.4e-8);                /* 1.5e-8 measured */
  ck_near(number(result, "insulator.permittivity"), 4.62, 4.2e-13);              /* 1.4e-13 measured */
  ck_near(number(result, "insulator.permittivity_standard_error"), 4.62, 1e-15); /* 0 measured */
  ck_near(number(result, "relative_error"),
          sqrt(number(result, "ribbon.young_modulus_standard_error") / number(result, "ribbon.young_modulus")),
          2.1e-13); /* 6.9e-14 measured */
  ck_assert_ptr_nonnull(strstr(result->note[0], "do not limit all keys"));
}

/* Several files: strokes, and pull-in voltages; what is beyond drive.voltage or closed has no value and is left out. */
TEST(rows_without_a_value_count_for_nothing) {
  ZpActuatorDef def = planned("ribbon.young_modulus, insulator.permittivity", 4);
  put(&def, "plan.candidates", "list.csv; pull-ins.csv");
  put(&def, "calibrate.y", "stroke_mm; pull_in_voltage_V");
  put(&def, "calibrate.sigma", "stroke = 20 um; pull_in_voltage = 30 V");
  def.drive.voltage = 7e3;
  write_file("list.csv", "load_g,voltage_kV,stroke_mm\n8,0,\n8,2,\n");
  write_file("pull-ins.csv", "load_g,pull_in_voltage_V\n8,\n60,\n");
  const ZpResult *result = plan(&def);
  ck_assert_uint_eq(result->series->rows, 3);
  ck_assert_double_eq(number(result, "candidates"), 4);
  for (size_t k = 0; k < 3; k++)
    ck_assert(zp_table_get(result->series, k, "file") == 1 || zp_table_get(result->series, k, "row") == 1);
  ck_assert_ptr_nonnull(strstr(result->note[1], "without a value at these values of the keys: 1"));
}

/* Frames of a record are rows; those that calibrate.skip_until leaves out keep their numbers, and a shift of time is
 * not a key. */
TEST(frames_of_a_record) {
  ZpActuatorDef def = planned("ribbon.young_modulus", 3);
  def.damping.internal = 1e-4;
  put(&def, "calibrate.sigma", "displacement = 50 um");
  put(&def, "calibrate.offsets", "time; displacement");
  FILE *file = fopen("list.csv", "w");
  fputs("Time (ms),Voltage [kV],Displacement / mm\n", file);
  for (int k = 0; k < 40; k++)
    fprintf(file, "%d,%d,\n", 2 * k, k > 2 ? 8 : 0);
  ck_assert_int_eq(fclose(file), 0);
  const ZpResult *all = plan(&def);
  def.calibrate.skip_until = 0.031;
  const ZpResult *late = plan(&def);
  for (size_t k = 0; k < 3; k++) {
    ck_assert_double_eq_tol(zp_table_get(all->series, k, "time_s"), 2e-3 * (zp_table_get(all->series, k, "row") - 1),
                            1e-12);
    ck_assert_double_eq_tol(zp_table_get(late->series, k, "time_s"), 2e-3 * (zp_table_get(late->series, k, "row") - 1),
                            1e-12);
    ck_assert_double_gt(zp_table_get(late->series, k, "time_s"), 0.031);
  }
  ck_assert_double_ge(number(late, "planned_relative_error"), number(all, "planned_relative_error"));
}

/* -- wrong input --------------------------------------------------------------------------------------------- */

static void refuse(const ZpActuatorDef *def, const char *words) {
  refuse_study(ZP_STUDY_PLAN, def, words);
}

/* The plan of the first test of the study with one key changed. */
static void refuse_with(const char *key, const char *text, const char *words) {
  ZpActuatorDef def = planned("ribbon.young_modulus", 2);
  put(&def, key, text);
  refuse(&def, words);
}

TEST(bad_plans_are_refused) {
  write_file("list.csv", "load_g,stroke_mm\n4,\n8,\n12,\n");
  write_file("loads.csv", "load_g\n4\n8\n12\n");
  write_file("turned.csv", "stroke_mm,force_N\n4,\n8,\n12,\n");
  write_file("holes.csv", "load_g,stroke_mm,ribbon.width_mm\n4,,12\n,,13\n");
  write_file("data.csv", "load_g,stroke_mm\n4,5\n");
  write_file("known.csv", "load_g,stroke_mm,sigma_mm\n4,6,0.1\n");
  ZpActuatorDef def = planned("ribbon.young_modulus", 4);
  refuse(&def, "plan.budget = 4: plan.candidates has 3 rows; give at most as many");
  refuse_with("plan.candidates", "", "plan.candidates: empty; study plan needs a CSV file of possible measurements");
  refuse_with("plan.candidates", "none.csv", "plan.candidates: none.csv: cannot be opened");
  refuse_with("plan.candidates", "loads.csv", "no column is measured; calibrate.y must name what is measured");
  refuse_with("plan.candidates", "turned.csv", "a plan needs the forces: name their column in calibrate.x");
  refuse_with("plan.candidates", "holes.csv", "an empty cell");
  refuse_with("calibrate.fit", "", "calibrate.fit: empty; study plan needs the keys that the measurements are for");
  refuse_with("calibrate.fit", "load.mass", "load.mass is given by column load_g and cannot be fitted");
  refuse_with("calibrate.y", "strok_mm", "column strok_mm: unknown");
  refuse_with("calibrate.x", "lod_g", "calibrate.x = \"lod_g\": no such column in list.csv");
  refuse_with("calibrate.offsets", "time", "calibrate.offsets: time: no file has times");
  refuse_with("calibrate.sigma", "", "plan.candidates: the standard deviation of stroke is not known; add a column");
  def = planned("ribbon.young_modulus", 2);
  put(&def, "calibrate.sigma", "");
  put(&def, "data.file", "data.csv");
  refuse(&def, "data.file: 1 rows for 1 fitted values tell no standard deviation");
  put(&def, "data.file", "known.csv");
  refuse(&def, "the standard deviation of stroke is not known");
  put(&def, "calibrate.sigma", "stroke = 5 um");
  put(&def, "calibrate.y", "stroke_mm; frequency_Hz");
  refuse(&def, "calibrate.y = \"frequency_Hz\": no such column");
}
