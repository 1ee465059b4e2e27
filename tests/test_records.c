/* Records over time in study calibrate: what drove them, their shifts, intervals of the keys, and whether residuals are
 * noise. */
#include "data_util.h"

#include "fit/fit.h"

enum { FRAMES = 60 };

static const double late = 4e-3, zero = 2e-4, end = 0.12; /* s, m, s */

/* An actuator without liquid, at a coarse mesh. */
static ZpActuatorDef recorded(const char *keys) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 11;
  def.liquid.model = ZP_LIQUID_NONE;
  def.output.errors = false;
  def.solver.tolerance = 1e-5;
  snprintf(def.data.file, sizeof def.data.file, "record.csv");
  snprintf(def.calibrate.fit, sizeof def.calibrate.fit, "%s", keys);
  return def;
}

static double voltage_at(double t) {
  return t < 0.01 ? 0 : t < 0.02 ? 8e5 * (t - 0.01) : 8e3;
}

/* A record of its displacements under a voltage that it has, with shifts and an error that alternates, +-. */
static void write_record(const ZpActuatorDef *truth, double load, double noise) {
  ZpActuatorDef def = *truth;
  double time[FRAMES], voltage[FRAMES];
  for (int i = 0; i < FRAMES; i++)
    time[i] = end * i / (FRAMES - 1), voltage[i] = voltage_at(time[i]);
  const ZpDriveTable table = {FRAMES, time, voltage};
  const char *stroke = "stroke";
  ZpModel *model;
  ZpTrace *trace;
  ZpError err;
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  def.load.mass = load;
  ck_assert_int_eq(zp_model_create_driven(&def, &table, &model, &err), ZP_OK);
  ck_assert_int_eq(zp_trace_create(model, &stroke, 1, NULL, 0, end, NULL, &trace, &err), ZP_OK);
  FILE *file = fopen("record.csv", "w");
  fprintf(file, "Time (ms);Voltage [kV];Load [g];Displacement / mm\n");
  const double start = zp_trace_at(trace, 0, 0).value;
  for (int i = 0; i < FRAMES; i++) {
    const double moved = start - zp_trace_at(trace, 0, time[i] - late).value;
    fprintf(file, "%.17g;%.17g;%.17g;%.17g\n", 1e3 * time[i], 1e-3 * voltage[i], 1e3 * load,
            1e3 * (moved + zero + (i % 2 ? noise : -noise)));
  }
  ck_assert_int_eq(fclose(file), 0);
  zp_trace_destroy(trace);
  zp_model_destroy(model);
}

/* Modulus and shifts are found again from other values, and nothing else is asked of the file. */
TEST(record_has_all_that_a_run_needs) {
  ZpActuatorDef def = recorded("ribbon.young_modulus"), truth = def;
  def.calibrate.starts = 2;
  def.solver.tolerance = truth.solver.tolerance = 1e-4;
  truth.ribbon.young_modulus = 180e9;
  snprintf(def.calibrate.offsets, sizeof def.calibrate.offsets, "time; displacement");
  write_record(&truth, 9e-3, 0);
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  printf("modulus %.6g, late %.6g, zero %.6g, rms %.2g\n", zp_result_get(result, "ribbon.young_modulus"),
         zp_result_get(result, "time_offset"), zp_result_get(result, "displacement_offset"),
         zp_result_get(result, "residual_rms_m"));
  ck_near(zp_result_get(result, "ribbon.young_modulus"), 180e9, 7.5e-9); /* 2.5e-9 measured */
  ck_near(zp_result_get(result, "time_offset"), late, 2e-7);             /* 6.5e-8 measured */
  ck_near(zp_result_get(result, "displacement_offset"), zero, 1.7e-8);   /* 5.7e-9 measured */
}

/* A fit of two keys that trade against each other, from values that are 6 % off. */
static ZpActuatorDef in_a_valley(double noise) {
  ZpActuatorDef def = recorded("ribbon.young_modulus, medium.permittivity"), truth = def;
  def.solver.tolerance = NAN;
  def.calibrate.starts = 2;
  truth.ribbon.young_modulus = 188e9;
  truth.medium.permittivity = 2.6;
  snprintf(def.calibrate.offsets, sizeof def.calibrate.offsets, "time; displacement");
  write_record(&truth, 9e-3, noise);
  return def;
}

/* The fit is better than the true values, which lie within its intervals. */
TEST(keys_in_a_valley_are_found) {
  const ZpActuatorDef def = in_a_valley(2e-5);
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  printf("modulus %.6g, permittivity %.6g, rms %.7g, %g runs\n", zp_result_get(result, "ribbon.young_modulus"),
         zp_result_get(result, "medium.permittivity"), zp_result_get(result, "residual_rms_m"),
         zp_result_get(result, "evaluations"));
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  ck_assert_double_le(zp_result_get(result, "residual_rms_m"), 2e-5);
  ck_assert_double_le(zp_result_get(result, "ribbon.young_modulus_interval_95_low"), 188e9);
  ck_assert_double_ge(zp_result_get(result, "ribbon.young_modulus_interval_95_high"), 188e9);
  ck_assert_double_le(zp_result_get(result, "medium.permittivity_interval_95_low"), 2.6);
  ck_assert_double_ge(zp_result_get(result, "medium.permittivity_interval_95_high"), 2.6);
}

static bool stop_at_last(void *user, const char *stage, double fraction) {
  int *calls = user;
  (void)stage, (void)fraction;
  return --*calls < 0;
}

/* A fit that is stopped while it seeks intervals has values, and does not claim to have ended. */
TEST(stopped_fit_has_not_converged) {
  const ZpActuatorDef def = in_a_valley(2e-5);
  ZpResult *result = NULL;
  ZpError err;
  int calls = 1 << 30;
  const ZpHooks count = {&calls, stop_at_last, NULL};
  ck_assert_int_eq(zp_data_study_run(ZP_STUDY_CALIBRATE, &def, &count, &result, &err), ZP_OK);
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  zp_result_destroy(result);
  calls = ((1 << 30) - calls) * 9 / 10;
  ck_assert_int_eq(zp_data_study_run(ZP_STUDY_CALIBRATE, &def, &count, &result, &err), ZP_OK);
  printf("%s: %s\n", zp_outcome_name(result->outcome), result->message);
  ck_assert_int_eq(result->outcome, ZP_INTERRUPTED);
  ck_assert(isfinite(zp_result_get(result, "ribbon.young_modulus")));
  zp_result_destroy(result);
}

/* A fit of two keys to three rows, without files, and a point of it. */
typedef struct Plain {
  ZpFitSet set;
  double y[3], fitted[3], J[6];
  ZpFit fit;
  ZpFitPoint at;
} Plain;

static void make_plain(Plain *p, double lower) {
  *p = (Plain){.set = {.rows = 3}};
  p->fit = (ZpFit){.n = 2, .keys = 2, .rows = 3, .sets = 1, .set = &p->set, .y = p->y, .horizon = 1};
  for (int k = 0; k < 2; k++)
    p->fit.lower[k] = lower, p->fit.upper[k] = 5;
  p->at = (ZpFitPoint){.z = {1, 1}, .fitted = p->fitted, .J = p->J, .good = true};
}

/* 2 s0 + s1, s0 - s1 and s1 are to be 3, 1 and 0.2. Without a box s0 = 1.34 and s1 = 0.29; where s0 is at its edge, the
 * others are best at s1 = (2.2 - s0) / 3. */
TEST(step_stays_in_its_box) {
  static const double J[] = {2, 1, 1, -1, 0, 1}, y[] = {3, 1, 0.2}, edge[] = {0.7, 0.3};
  for (int k = 0; k < 2; k++) {
    Plain p;
    double to[ZP_FIT_MOST], falls, left = 0;
    make_plain(&p, -9);
    if (k == 1) p.fit.upper[0] = 1.3;
    memcpy(p.J, J, sizeof J);
    memcpy(p.y, y, sizeof y);
    ck_assert(zp_fit_step(&p.fit, &p.at, NULL, to, &falls));
    ck_near(to[0], 1 + edge[k], 1e-15);
    ck_near(to[1], 1 + (2.2 - edge[k]) / 3, 1e-15);
    for (int i = 0; i < 3; i++)
      left += pow(y[i] - J[2 * i] * edge[k] - J[2 * i + 1] * (2.2 - edge[k]) / 3, 2);
    ck_near(falls, 9 + 1 + 0.04 - left, 1e-15);
  }
}

/* Of powers of two keys one step finds both. */
TEST(steps_follow_powers) {
  static const double power[] = {1, 3, -0.5, 1, 2, 0}, z[] = {0.8, 1.3}, true_z[] = {1.5, 1.2};
  Plain p;
  double to[ZP_FIT_MOST], falls;
  make_plain(&p, 0.2);
  for (int k = 0; k < 2; k++)
    p.at.z[k] = z[k];
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 2; k++) {
      p.fitted[i] += power[2 * i + k] * log(z[k]);
      p.y[i] += power[2 * i + k] * log(true_z[k]);
      p.J[2 * i + k] = power[2 * i + k] / z[k];
    }
  ck_assert(zp_fit_step(&p.fit, &p.at, NULL, to, &falls));
  ck_near(to[0], 1.5, 1e-14);
  ck_near(to[1], 1.2, 1e-14);
}

/* The steps of differences are independent of each other, two standard errors each, (12.14). */
TEST(ways_are_independent) {
  ZpActuatorDef def = in_a_valley(5e-8);
  def.calibrate.skip_after = 0.055; /* before faces touch and part */
  ZpError err;
  ZpFit fit;
  ZpFitPoint best;
  ZpFitStarts starts;
  ck_assert_int_eq(zp_fit_open(&def, &fit, &err), ZP_OK);
  ck_assert(zp_fit_open_point(&fit, &best));
  ck_assert(zp_fit_solve(&fit, &best, &starts));
  for (int a = 0; a < fit.keys; a++)
    for (int b = 0; b < fit.keys; b++) {
      double product = 0, variance = best.square / (double)fit.rows;
      for (size_t i = 0; i < fit.rows; i++) {
        double along[2] = {0};
        for (int k = 0; k < fit.keys; k++) {
          along[0] += best.J[i * (size_t)fit.n + (size_t)k] * fit.way[k][a];
          along[1] += best.J[i * (size_t)fit.n + (size_t)k] * fit.way[k][b];
        }
        product += along[0] * along[1];
      }
      printf("ways %d, %d: %g\n", a, b, product / (4 * variance));
      ck_assert_double_eq_tol(product / (4 * variance), a == b, 0.23); /* 0.077 measured */
    }
  free(best.fitted);
  zp_fit_close(&fit);
}

/* A point of any profile whose sum of squares is low enough lies within the intervals of all parameters. */
TEST(points_are_within_all_intervals) {
  const ZpActuatorDef def = in_a_valley(2e-5);
  ZpError err;
  ZpFit fit;
  ZpFitPoint best;
  ZpFitStarts starts;
  ZpFitInterval interval[ZP_FIT_MOST];
  static ZpFitProfiles points;
  ck_assert_int_eq(zp_fit_open(&def, &fit, &err), ZP_OK);
  ck_assert(zp_fit_open_point(&fit, &best));
  ck_assert(zp_fit_solve(&fit, &best, &starts));
  const double variance = zp_fit_judge(&fit, &best).variance;
  zp_fit_intervals(&fit, variance, &best, interval, &points);
  size_t within = 0;
  for (size_t i = 0; i < points.count; i++) {
    if (points.point[i].rise > 0.97 * variance * zp_fit_level(&fit)) continue;
    within++;
    for (int k = 0; k < fit.n; k++) {
      ck_assert(!(points.point[i].z[k] < interval[k].low));
      ck_assert(!(points.point[i].z[k] > interval[k].high));
    }
  }
  printf("%zu of %zu points are within\n", within, points.count);
  ck_assert_uint_ge(within, 4);
  free(best.fitted);
  zp_fit_close(&fit);
}

/* Rows that calibrate.skip_until and skip_after leave out do not count. */
TEST(rows_are_skipped) {
  ZpActuatorDef def = recorded("");
  write_record(&def, 9e-3, 0);
  def.calibrate.skip_until = 0.03;
  def.calibrate.skip_after = 0.06;
  size_t rows = 0;
  for (int i = 0; i < FRAMES; i++) {
    const double t = end * i / (FRAMES - 1);
    rows += t >= 0.03 && t <= 0.06;
  }
  ck_assert_double_eq(zp_result_get(data_study_of(ZP_STUDY_CALIBRATE, &def), "data_rows"), (double)rows);
}

/* Of a nearly linear fit an interval is Student's t standard errors to each side. */
TEST(interval_of_a_linear_fit) {
  ZpActuatorDef def = recorded("ribbon.young_modulus");
  def.calibrate.starts = 1;
  snprintf(def.calibrate.offsets, sizeof def.calibrate.offsets, "time; displacement");
  write_record(&def, 9e-3, 1e-6);
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  const double value = zp_result_get(result, "ribbon.young_modulus"),
               part = zp_fit_student(FRAMES - 3) * zp_result_get(result, "ribbon.young_modulus_standard_error");
  printf("%g: %g, %g over %g\n", value, zp_result_get(result, "ribbon.young_modulus_interval_95_low") - value,
         zp_result_get(result, "ribbon.young_modulus_interval_95_high") - value, part);
  ck_near(value - zp_result_get(result, "ribbon.young_modulus_interval_95_low"), part, 0.021);  /* 0.007 measured */
  ck_near(zp_result_get(result, "ribbon.young_modulus_interval_95_high") - value, part, 0.018); /* 0.0061 measured */
}

/* Student's distribution, of tables. */
TEST(student_is_that_of_tables) {
  static const double table[][2] = {{1, 12.706}, {2, 4.303},  {3, 3.182},  {5, 2.571},
                                    {10, 2.228}, {30, 2.042}, {1e9, 1.960}};
  for (size_t k = 0; k < LENGTH_OF(table); k++)
    ck_near(zp_fit_student(table[k][0]), table[k][1], 4e-3);
}

/* Eight positive residuals, then eight negative ones: two runs, where noise has 9 of variance 56/15, (12.5); and signs
 * that alternate. */
TEST(runs_of_one_sign_are_no_noise) {
  enum { ROWS = 16 };
  double y[ROWS] = {0}, fitted[ROWS], x[ROWS] = {0};
  ZpFitSet set = {.rows = ROWS};
  ZpFit fit = {.n = 1, .rows = ROWS, .sets = 1, .set = &set, .x = x, .y = y};
  ZpFitPoint best = {.square = ROWS, .fitted = fitted};
  for (int i = 0; i < ROWS; i++)
    fitted[i] = i < ROWS / 2 ? 1 : -1;
  ZpFitJudgement judgement = zp_fit_judge(&fit, &best);
  ck_near(judgement.runs, 0.5 * erfc((9 - 0.5 - 2) / sqrt(2 * 56.0 / 15)), 1e-12);
  ck_near(judgement.succession, 0.5 * erfc(13.0 / ROWS * sqrt(15 / 2.0)), 1e-12); /* 14 pairs are alike, one is not */
  ck_assert(!zp_fit_is_noise(&judgement));
  for (int i = 0; i < ROWS; i++)
    fitted[i] = i % 2 ? 1 : -1;
  judgement = zp_fit_judge(&fit, &best);
  ck_assert(zp_fit_is_noise(&judgement));
}

/* Data of insulators that leak, fitted with ones that do not: the note names the law, (12.6). Without a leak no law is
 * missing. */
TEST(missing_law_is_named) {
  ZpActuatorDef def = recorded("medium.permittivity"), truth = def;
  def.calibrate.starts = 1;
  def.solver.tolerance = 1e-4;
  snprintf(def.calibrate.offsets, sizeof def.calibrate.offsets, "time; displacement");
  write_record(&truth, 9e-3, 2e-5);
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  printf("clean: %g\n", zp_result_get(result, "law_test"));
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  ck_assert_double_ge(zp_result_get(result, "law_test"), 0.34); /* 1 measured */
  truth.insulator.resistivity = 5e9;
  write_record(&truth, 9e-3, 5e-6);
  result = data_study_of(ZP_STUDY_CALIBRATE, &def);
  printf("leak: %s, %g\n", result->message, zp_result_get(result, "law_test"));
  bool named = false;
  for (size_t i = 0; i < result->notes; i++) {
    printf("%s\n", result->note[i]);
    named |= strstr(result->note[i], "leakage through the insulators (insulator.resistivity)") != NULL;
  }
  ck_assert_int_eq(result->outcome, ZP_DOUBTFUL);
  ck_assert_double_lt(zp_result_get(result, "law_test"), 5e-20); /* 1.7e-20 measured */
  ck_assert(named);
}

/* -- materials that remember ------------------------------------------------------------------------- */

/* A record of the stroke of a run, whose rows have the same error in mean square as its size. */
static void write_run(const ZpActuatorDef *truth, double until, double error) {
  const char *stroke = "stroke";
  uint64_t seed = 11;
  ZpModel *model = model_of(truth);
  ZpTrace *trace;
  ZpError err;
  ck_assert_int_eq(zp_trace_create(model, &stroke, 1, NULL, 0, until, NULL, &trace, &err), ZP_OK);
  FILE *file = fopen("record.csv", "w");
  fprintf(file, "time_s,stroke_m\n");
  for (int i = 1; i <= FRAMES; i++) {
    const double t = until * i * i / (FRAMES * FRAMES);
    fprintf(file, "%.17g,%.17g\n", t, zp_trace_at(trace, 0, t).value + sqrt(3) * error * noise(&seed));
  }
  ck_assert_int_eq(fclose(file), 0);
  zp_trace_destroy(trace);
}

/* The keys of `def` are fitted to the record of the truth, which lies within their intervals, and these are narrow. */
static void expect_found(const ZpActuatorDef *def, const ZpActuatorDef *truth, double width) {
  const ZpResult *result = data_study_of(ZP_STUDY_CALIBRATE, def);
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  char keys[sizeof def->calibrate.fit], name[96];
  snprintf(keys, sizeof keys, "%s", def->calibrate.fit);
  for (char *key = strtok(keys, ", "); key; key = strtok(NULL, ", ")) {
    const double value = zp_def_get(truth, zp_key_find(key));
    snprintf(name, sizeof name, "%s_interval_95_low", key);
    const double low = zp_result_get(result, name);
    snprintf(name, sizeof name, "%s_interval_95_high", key);
    const double high = zp_result_get(result, name);
    printf("%s: %g of %g .. %g\n", key, value, low, high);
    ck_assert(low < value && value < high);
    ck_below((high - low) / value, width);
  }
}

/* A held tape on a foil is released and creeps: moduli and time of a standard linear solid are found from others. */
TEST(creep_of_a_tape_is_found) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"ribbon.length", 0.02},
          {"ribbon.thickness", 1e-6}, {"ribbon.density", 100}, {"insulator.young_modulus", 30e6},
          {"insulator.relaxation_modulus", 60e6}, {"insulator.relaxation_time", 100}, {"load.mass", 10e-6},
          {"mesh.nodes", 9}, {"damping.internal", 0.05}, {"initial.state", ZP_INITIAL_STRAIGHT});
  ZpActuatorDef truth = def;
  write_run(&truth, 400, 5e-6);
  snprintf(def.data.file, sizeof def.data.file, "record.csv");
  snprintf(def.calibrate.fit, sizeof def.calibrate.fit,
           "insulator.young_modulus, insulator.relaxation_modulus, insulator.relaxation_time");
  def.insulator.young_modulus = 40e6;
  def.insulator.relaxation_modulus = 40e6;
  def.insulator.relaxation_time = 50;
  def.calibrate.starts = 1;
  expect_found(&def, &truth, 0.25); /* 0.083 measured */
}

/* An actuator of few elements whose material remembers a step of the voltage below pull-in. */
static ZpActuatorDef after_a_step(const char *keys, double voltage) {
  ZpActuatorDef def = recorded(keys);
  def.drive.voltage = voltage;
  def.mesh.nodes = 7;
  def.calibrate.starts = 1;
  def.solver.tolerance = 1e-3;
  def.damping.internal = 0.02;
  return def;
}

/* Strips that creep. */
TEST(creep_of_strips_is_found) {
  ZpActuatorDef def = after_a_step("ribbon.relaxation_modulus, ribbon.relaxation_time", 4e3), truth;
  def.ribbon.relaxation_modulus = 60e9;
  def.ribbon.relaxation_time = 0.2;
  truth = def;
  write_run(&truth, 1, 5e-6);
  def.ribbon.relaxation_modulus = 40e9;
  def.ribbon.relaxation_time = 0.1;
  expect_found(&def, &truth, 0.43); /* 0.145 measured */
}

/* Charge that patches retain for a short and the rest for a long time: resistivity, share and ratio. */
TEST(retention_of_two_times_is_found) {
  ZpActuatorDef def = after_a_step("medium.resistivity, electro.leak_share, electro.leak_ratio", 5e3), truth;
  def.medium.resistivity = 1e11;
  def.electro.leak_share = 0.3;
  def.electro.leak_ratio = 20;
  truth = def;
  write_run(&truth, 4, 5e-6);
  def.medium.resistivity = 2e11;
  def.electro.leak_share = 0.5;
  def.electro.leak_ratio = 10;
  expect_found(&def, &truth, 0.39); /* 0.13 measured */
}

TEST(record_without_rows_is_refused) {
  ZpActuatorDef def = recorded("medium.permittivity");
  write_record(&def, 0, 0);
  def.calibrate.skip_until = 100;
  refuse_study(ZP_STUDY_CALIBRATE, &def,
               "no row is between calibrate.skip_until = 100 s and calibrate.skip_after = inf s");
}
