/* A capacitance meter and the stroke that follows from it: readings in closed form, what drifts, resolution and noise
 * do to them, the inverse of the states of rest, refusals. */
#include "check_util.h"

#include <time.h>

#include "drive/meter.h"
#include "rest/rest.h"

static const double PI = 3.14159265358979323846;

#define METER                                                                                                          \
  {"sense.frequency", 1e3}, {"sense.amplitude", 50}, {                                                                 \
    "sense.sampling_rate", 16e3                                                                                        \
  }

/* Reading of `windows` windows of a charge and a capacitance that go straight over a second. */
static void read_line(const ZpMeter *meter, const double charge[2], const double C[2], size_t windows,
                      double *reading) {
  double time[] = {0, 1};
  ZpMeterTrace trace = {2, time, charge, C};
  zp_meter_read(meter, &trace, 0, windows, reading);
}

/* A constant capacitance is read to rounding, for any constant current beside it. One that grows evenly is read in the
 * middle of the window, but for what the last sample misses of it. */
TEST(test_reading) {
  ZpActuatorDef def = DEF(METER);
  ZpMeter meter = zp_meter_of(&def, 1e-9);
  double reading[3], window = zp_meter_window(&meter);
  ck_near(window, 0.022, 1e-12);
  read_line(&meter, (double[]){0, 1e-3}, (double[]){2e-10, 2e-10}, 3, reading);
  for (int i = 0; i < 3; i++)
    ck_near(reading[i], 2e-10, 1e-12); /* 3.2e-15 measured */
  read_line(&meter, (double[]){0, 0}, (double[]){1e-10, 2e-10}, 3, reading);
  for (int i = 0; i < 3; i++)
    ck_near(reading[i], 1e-10 * (1 + (i + 0.5) * window - 1 / 16e3), 1e-12); /* 2.2e-16 measured */
}

/* Other currents count as they are: one that begins within a period adds what its samples have in phase with the
 * sine's current, the sum of cos(2 pi k / N) from their first on. */
TEST(test_current_that_begins) {
  enum { N = 16, FIRST = 4 };
  const double begins = (FIRST - 0.5) / 16e3, I = 1e-6;
  ZpActuatorDef def = DEF(METER, {"sense.bandwidth", 1e3});
  ZpMeter meter = zp_meter_of(&def, 1e-9);
  double time[] = {0, begins, 1}, charge[] = {0, 0, I * (1 - begins)}, C[] = {1e-10, 1e-10, 1e-10}, reading;
  ZpMeterTrace trace = {3, time, charge, C};
  zp_meter_read(&meter, &trace, 0, 1, &reading);
  const double sum = -0.5 - 0.5 * sin((FIRST - 0.5) * 2 * PI / N) / sin(PI / N);
  ck_near(zp_meter_window(&meter), 1e-3, 1e-12);
  ck_near(reading, 1e-10 + 2 * I * sum / (N * 2 * PI * 1e3 * 50), 1e-12);
}

/* A current beyond the range of the samples is clipped: the reading for twice the current of the range is the first
 * harmonic of a clipped sine, 2/3 + sqrt(3) / pi of the range. */
TEST(test_range) {
  ZpActuatorDef def = DEF(METER, {"sense.bits", 24}, {"sense.sampling_rate", 4e6});
  double most = 2 * PI * 1e3 * 50 * 1e-10, reading;
  def.sense.range = most;
  ZpMeter meter = zp_meter_of(&def, 1);
  read_line(&meter, (double[]){0, 0}, (double[]){2e-10, 2e-10}, 1, &reading);
  ck_near(reading, 1e-10 * (2.0 / 3 + sqrt(3) / PI), 2e-7); /* 6.2e-8 measured */
}

static double spread(const ZpMeter *meter, double *first) {
  enum { WINDOWS = 40 };
  double reading[WINDOWS], sum = 0;
  read_line(meter, (double[]){0, 0}, (double[]){1e-10, 1e-10}, WINDOWS, reading);
  for (int i = 0; i < WINDOWS; i++)
    sum += (reading[i] - 1e-10) * (reading[i] - 1e-10) / WINDOWS;
  *first = reading[0];
  return sqrt(sum);
}

/* White noise in n samples gives the amplitude of the current a noise of sqrt(2 / n) of it. One seed gives one noise.
 */
TEST(test_noise) {
  ZpActuatorDef def = DEF(METER, {"sense.noise", 1e-7});
  ZpMeter meter = zp_meter_of(&def, 1e-9), other = meter;
  double first, again, different;
  other.seed = 2;
  const double expected = 1e-7 * sqrt(2.0 / (22 * 16)) / (2 * PI * 1e3 * 50);
  /* 2 % measured: the spread of 40 readings has a standard error of 1 / sqrt(80), of which two are allowed */
  ck_assert_double_lt(fabs(spread(&meter, &first) / expected - 1), 2 / sqrt(80));
  spread(&meter, &again);
  spread(&other, &different);
  ck_assert(first == again && first != different);
}

/* Few bits: the error of a sample is at most half a step, and so, approximately, is that of the amplitude; two more
 * bits reduce it to about a quarter. */
TEST(test_resolution) {
  double off[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = DEF(METER, {"sense.bits", 6 + 4 * k});
    ZpMeter meter = zp_meter_of(&def, 1e-10);
    double reading;
    ck_assert_double_eq(meter.step, 2 * meter.range / pow(2, 6 + 4 * k)); /* of both signs */
    read_line(&meter, (double[]){0, 0}, (double[]){0.731e-10, 0.731e-10}, 1, &reading);
    off[k] = fabs(reading - 0.731e-10);
    ck_below(off[k], 2 / PI * meter.step / (2 * PI * 1e3 * 50));
  }
  ck_below(off[1], off[0]);
}

/* Slowly up to below pull-in and back, damped: the actuator follows its equilibria, and the meter reads its stroke to
 * well below a thousandth, in the middle of its windows of 0.22 s. */
TEST(test_stroke_along_the_states_of_rest) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 15}, {"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.frequency", 0.2},
                          {"drive.voltage", 5e3}, {"solver.end_time", 5}, {"damping.internal", 5e-3},
                          {"sense.bits", 12}, {"sense.noise", 1e-9}, {"sense.bandwidth", 2});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  double off = zp_result_get(result, "sense_stroke_error"), moved = 0;
  for (size_t k = 0; k < result->series->rows; k++)
    moved = fmax(moved, zp_table_get(result->series, 0, "stroke_m") - zp_table_get(result->series, k, "stroke_m"));
  printf("stroke by capacitance: off by %.2e of the stroke, which changes by %.2g mm\n", off, 1e3 * moved);
  ck_assert(moved > 0.5e-3);
  ck_below(off, 4e-4); /* 3.5e-4 measured */
  ck_assert(isnan(zp_table_get(result->series, 0, "sensed_stroke_m")));
  ck_near(zp_table_get(result->series, result->series->rows - 1, "sensed_stroke_m"),
          zp_table_get(result->series, 0, "stroke_m"), 1e-4); /* 2.4e-5 measured */
}

/* Ribbons bowed twice, under a spring, are partly closed at 2 kV. Equilibria on the way back from closed ones have the
 * same capacitance at a fifth of the stroke. Readings give the stroke of those through which the actuator has come. */
TEST(test_stroke_of_the_branch_that_it_is_on) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 15}, {"liquid.model", ZP_LIQUID_NONE}, {"segment_1.length", 21e-3},
                          {"segment_1.curvature", -16}, {"segment_2.length", 10e-3}, {"segment_2.curvature", 15},
                          {"gravity", 0}, {"load.mass", 0}, {"load.stiffness", 2}, {"load.rest_opening", 15e-3},
                          {"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.frequency", 0.25}, {"drive.voltage", 2e3},
                          {"damping.internal", 20e-3}, {"solver.end_time", 4}, {"sense.bandwidth", 10});
  ck_below(zp_result_get(study_of(ZP_STUDY_ACTUATE, &def), "sense_stroke_error"), 8e-3); /* 3.1e-3 measured */
}

/* The error while it is held counts from the zip to the end of the voltage: what comes after does not change it. */
TEST(test_held_until_the_release) {
  double error[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = DEF(METER, {"mesh.nodes", 9}, {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 1},
                            {"drive.duty", 0.4}, {"drive.voltage", 10e3}, {"sense.bits", 12}, {"sense.noise", 1e-9},
                            {"solver.end_time", k ? 0.7 : 0.4}, {"solver.stop_when_zipped", ZP_WHEN_FALSE});
    ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
    ck_assert_double_lt(zp_result_get(result, "zip_time_s"), 0.2);
    error[k] = zp_result_get(result, "sense_hold_error_m");
  }
  ck_near(error[1], error[0], 1e-12);
}

/* What cannot be read, with the key that says why. */
TESTS(test_refused, 0, 7) {
  static const struct {
    Setting with[3];
    const char *says;
  } of[] = {{{{"sense.frequency", 1e3}}, "sense.frequency = 1000 Hz: requires sense.amplitude, which is missing"},
            {{{"sense.frequency", 1e3}, {"sense.amplitude", 1}},
             "sense.frequency = 1000 Hz: requires sense.sampling_rate, which is missing"},
            {{{"sense.noise", 1e-9}}, "sense.noise = 1e-09 A: requires sense.frequency"},
            {{{"sense.frequency", 1e3}, {"sense.amplitude", 1}, {"sense.sampling_rate", 3e3}}, "at least 4"},
            {{{"sense.frequency", 1e3}, {"sense.amplitude", 1}, {"sense.sampling_rate", 4500}}, "a whole multiple"},
            {{{"sense.frequency", 1e3}, {"sense.amplitude", 1}, {"sense.sampling_rate", 1e9}}, "samples until"},
            {{{"sense.frequency", 10}, {"sense.amplitude", 1}, {"sense.sampling_rate", 100}}, "sense.bandwidth"}};
  ZpActuatorDef def = {0};
  size_t count = 0;
  while (count < 3 && of[_i].with[count].key)
    count++;
  ck_ok(resolve(&def, of[_i].with, count, &err));
  ck_says(zp_def_check(&def, &err), ZP_BAD_INPUT, of[_i].says);
}

/* Close to rest at 3 kV the field's capacitance gives the stroke, though the shapes of the path are those of the plates
 * law; the path of fields gives 10.1211 mm. */
TEST(test_stroke_by_the_field) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 9}, {"electro.model", ZP_ELECTRO_FIELD}, {"drive.voltage", 3e3},
                          {"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 0.02}, {"damping.drag", 3},
                          {"solver.end_time", 0.574});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  size_t last = result->series->rows - 1;
  double sensed = zp_table_get(result->series, last, "sensed_stroke_m");
  printf("stroke by the field: %.6g mm, true %.6g mm\n", 1e3 * sensed,
         1e3 * zp_table_get(result->series, last, "stroke_m"));
  ck_near(sensed, 10.1211e-3, 3e-4); /* 2.4e-4 measured */
}

/* The capacitance of the field about the ribbons of a shape, F. */
static double field_of(ZpRest *rest, const ZpShape *shape) {
  ZpRestMember *m = rest->statics.member;
  double *force = memory_of(rest->statics.n * sizeof *force);
  memcpy(m->q, shape->x, m->model->count * sizeof *m->q);
  memcpy(zp_forces(m->model, m->q).y, shape->y, m->model->count * sizeof *m->q);
  rest->statics.U = shape->voltage;
  ck_assert_int_eq(rest->system.at_rest.refresh(&rest->statics), ZP_END_FOUND);
  ck_assert_int_eq(rest->system.at_rest.residual(&rest->statics, force, NULL), ZP_END_FOUND);
  return zp_statics_capacitance(&rest->statics);
}

/* Fields of a few states of rest stand for those of all: the stroke that is read lies between two states whose fields,
 * computed here, have the capacitance that is read. */
TEST(test_fields_between_those_that_are_computed) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 9}, {"electro.model", ZP_ELECTRO_FIELD}, {"drive.voltage", 3e3},
                          {"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 0.02}, {"damping.drag", 3},
                          {"solver.end_time", 0.2}),
                rests = DEF({"mesh.nodes", 9}, {"drive.voltage", 3.3e3}, {"output.shapes", 5000});
  ZpResult *run = study_of(ZP_STUDY_ACTUATE, &def), *path = study_of(ZP_STUDY_EQUILIBRIUM, &rests);
  double off = 0, last = 0;
  ZpRest *rest;
  ck_ok(zp_rest_create(model_of(&def), &rest, &err));
  for (size_t row = 0; row < run->series->rows; row++) {
    double read = zp_table_get(run->series, row, "sensed_capacitance_F"),
           stroke = zp_table_get(run->series, row, "sensed_stroke_m"), s[2], C[2];
    size_t k = 0;
    if (isnan(read) || read == last) continue;
    while (zp_table_get(path->series, k + 1, "stroke_m") > stroke)
      k++;
    for (size_t i = 0; i < 2; i++) {
      ZpShape shape = zp_shapes_get(path->shapes, k + i);
      s[i] = zp_table_get(path->series, k + i, "stroke_m");
      C[i] = field_of(rest, &shape);
    }
    off = fmax(off, fabs(read / (C[0] + (C[1] - C[0]) * (stroke - s[0]) / (s[1] - s[0])) - 1));
    last = read;
  }
  zp_rest_destroy(rest);
  ck_assert_double_gt(last, 0);
  ck_below(off, 1e-4); /* 4.8e-5 measured; with the left one of two fields, 2.9e-4 */
}

/* The equilibria of a meter take no field for each of their steps: 1 ms took 20 s of CPU time, measured 0.04 s. */
TEST(test_field_and_meter_are_quick) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 9}, {"electro.model", ZP_ELECTRO_FIELD}, {"solver.end_time", 1e-3});
  clock_t start = clock();
  study_of(ZP_STUDY_ACTUATE, &def);
  if (!SANITIZED) ck_assert_double_lt((double)(clock() - start) / CLOCKS_PER_SEC, 2);
}

/* It zips, is held, and opens again while the voltage falls evenly from 8 kV at 0.5 s to 0 at 1.48 s; then it hangs.
 * The zip ends when it has closed, the hold with half of the largest voltage, at 0.99 s. Squared errors of the windows
 * of zip, hold and release add up to those of all. Readings come from the branch on which the actuator is: closed, and
 * open again after the release. */
TEST(test_zip_hold_and_release) {
  static const double t[] = {0, 0.5, 1.48, 2}, U[] = {8e3, 8e3, 0, 0};
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 9}, {"drive.waveform", ZP_WAVEFORM_TABLE}, {"damping.drag", 0.4},
                          {"solver.end_time", t[3]});
  const ZpDriveTable table = {4, t, U};
  ZpStudyInput input = {.table = &table};
  ZpResult *result = study_with(ZP_STUDY_ACTUATE, &def, &input);
  static const char *const part[] = {"sense_zip_error_m", "sense_hold_error_m", "sense_release_error_m"};
  const double window = zp_result_get(result, "sense_window_s"), zipped = zp_result_get(result, "zip_time_s");
  const double until[] = {zipped, 0.99, t[3]};
  double sum = 0, before = 0, all = floor(t[3] / window * (1 + 1e-12));
  for (int k = 0; k < 3; k++) {
    double count = fmin(floor(until[k] / window + 0.5), all), error = zp_result_get(result, part[k]);
    sum += (count - before) * error * error;
    before = count;
  }
  ck_near(zp_result_get(result, "sense_stroke_error_m"), sqrt(sum / all), 1e-12);
  double held = 0, hanging = 0, hangs = zp_table_get(result->series, 0, "stroke_m");
  for (size_t k = 0; k < result->series->rows; k++) {
    const double now = zp_table_get(result->series, k, "time_s");
    const double read = zp_table_get(result->series, k, "sensed_stroke_m");
    if (now > 0.3 && now < 1) held = fmax(held, fabs(read - zp_table_get(result->series, k, "stroke_m")));
    if (now > 1.75) hanging = fmax(hanging, fabs(read - hangs));
  }
  printf("stroke of %.3g mm by capacitance: off by %.2g mm while held, %.2g mm when it hangs again\n", 1e3 * hangs,
         1e3 * held, 1e3 * hanging);
  ck_below(held, 2e-5);    /* 1.3e-5 measured */
  ck_below(hanging, 2e-4); /* the swing that is left */
}

static ZpResult *sensed(double end_time, const ZpCheckpoint *start) {
  ZpActuatorDef def = DEF(METER, {"mesh.nodes", 15}, {"drive.voltage", 5e3}, {"drive.waveform", ZP_WAVEFORM_RAMP},
                          {"drive.rise_time", 0.1}, {"sense.noise", 1e-9}, {"solver.end_time", end_time},
                          {"initial.state", start ? ZP_INITIAL_CHECKPOINT : ZP_INITIAL_EQUILIBRIUM});
  ZpStudyInput input = {.start = start};
  return study_with(ZP_STUDY_ACTUATE, &def, &input);
}

/* A run that resumes at 40 ms has the readings of the windows of 22 ms that begin afterwards, and they are those of the
 * whole run: the third ends at 66 ms. Errors are those of these windows: their squares are a part of the sum of all
 * four. */
TEST(test_resumed_run_reads_its_own_windows) {
  ZpResult *part = sensed(0.04, NULL), *whole = sensed(0.1, NULL), *rest = sensed(0.1, part->checkpoint);
  for (size_t k = 0; k < rest->series->rows; k++) {
    double t = zp_table_get(rest->series, k, "time_s"), C = zp_table_get(rest->series, k, "sensed_capacitance_F");
    ck_assert_msg(isnan(C) == (t < 0.066), "%g s: %g F", t, C);
  }
  const size_t last[] = {rest->series->rows - 1, whole->series->rows - 1};
  ck_near(zp_table_get(rest->series, last[0], "sensed_capacitance_F"),
          zp_table_get(whole->series, last[1], "sensed_capacitance_F"), 1e-12); /* 0 measured */
  static const char *const errors[] = {"sense_capacitance_error_F", "sense_stroke_error_m"};
  for (size_t k = 0; k < LENGTH_OF(errors); k++)
    ck_below(zp_result_get(rest, errors[k]), sqrt(4 / 2) * zp_result_get(whole, errors[k]) * (1 + 1e-6));
  ZpResult *none = sensed(0.06, part->checkpoint); /* no window begins and ends in it */
  ck_assert(isnan(zp_result_get(none, "sense_capacitance_error_F")));
}
