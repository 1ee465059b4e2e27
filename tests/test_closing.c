/* When an actuator is closed: the first closing, bounces, and closing for good. */
#include "check_util.h"

#include <zipact/checkpoint.h>
#include <zipact/sim.h>

#include "run/still.h"

/* The default actuator, coarse, with all samples. `settings` as in DEF. */
#define COARSE                                                                                                         \
  {"mesh.nodes", 31}, {                                                                                                \
    "output.samples", 10000                                                                                            \
  }
#define BEAD(uL)                                                                                                       \
  {"liquid.model", ZP_LIQUID_BEAD}, {                                                                                  \
    "bead.volume", (uL)*1e-9                                                                                           \
  }
#define NEVER_EARLY                                                                                                    \
  { "solver.stop_when_zipped", ZP_WHEN_FALSE }

static double contraction(const ZpResult *result, size_t row) {
  return zp_table_get(result->series, row, "contraction");
}

static double time_at(const ZpResult *result, size_t row) {
  return zp_table_get(result->series, row, "time_s");
}

/* The last row below 99 %; the number of rows if there is none after it has closed. */
static size_t last_open(const ZpResult *result) {
  for (size_t row = result->series->rows; row-- > 0;)
    if (contraction(result, row) < 0.99) return row;
  return result->series->rows;
}

/* -- since when ------------------------------------------------------------------------------------ */

/* By definition the contraction is below 99 % just before closed_from_s and not below after it. Rows are records of the
 * run, so the last one below and the next one enclose it. */
TESTS(closed_from_is_where_the_contraction_last_reaches_99_percent, 0, 3) {
  const ZpActuatorDef cases[] = {
      DEF(COARSE, NEVER_EARLY, {"solver.end_time", 0.15}),
      DEF(COARSE, NEVER_EARLY, BEAD(300), {"solver.end_time", 0.4}),
      DEF(COARSE, NEVER_EARLY, {"drive.voltage", 9e3}, {"solver.end_time", 0.2}, {"solver.tolerance", 1e-4})};
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &cases[_i]);
  double zip = zp_result_get(result, "zip_time_s"), from = zp_result_get(result, "closed_from_s");
  size_t row = last_open(result);
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert_double_lt(zip + 1e-3, from); /* it bounces */
  ck_assert(time_at(result, row) <= from && from <= time_at(result, row + 1));
  ck_assert_double_lt(time_at(result, row + 1) - time_at(result, row), 1e-3);
  ck_assert_ptr_nonnull(strstr(result->message, "stays closed from"));
}

/* The end of a run lies within a step, which is tried again until it ends there. The run that ends at this known time
 * takes no trials: 25 iterations are measured; 32 trials took 256 with 61 nodes. */
TEST(a_run_lands_in_a_few_trials) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, {"output.errors", 0}, {"solver.stop_when_zipped", ZP_WHEN_TRUE});
  const ZpResult *lands = answer_of(ZP_STUDY_ACTUATE, &def);
  def.solver.stop_when_zipped = ZP_WHEN_FALSE;
  def.solver.end_time = zp_result_get(lands, "zip_time_s");
  const ZpResult *ends = study_of(ZP_STUDY_ACTUATE, &def);
  double more = zp_result_get(lands, "newton_iterations") - zp_result_get(ends, "newton_iterations");
  printf("%g iterations to land\n", more);
  ck_assert_double_ge(more, 8);
  ck_assert_double_le(more, 60);
}

/* A bead that is too small closes once and opens again. This is an answer, and the message says both. */
TEST(a_small_bead_reopens) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, BEAD(50), {"solver.end_time", 0.22});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_REOPENED);
  ck_assert_str_eq(zp_outcome_name(result->outcome), "reopened");
  ck_assert(zp_outcome_good(result->outcome));
  ck_assert_double_lt(zp_result_get(result, "zip_time_s"), 0.16);
  ck_assert(isnan(zp_result_get(result, "closed_from_s")));
  ck_assert_double_lt(zp_result_get(result, "contraction"), 0.99);
  ck_assert_double_eq(zp_result_get(result, "simulated_time_s"), 0.22);
  ck_assert_ptr_nonnull(strstr(result->message, "open at the end"));
}

/* Without any setting it lifts 8 g at 10 kV and stays closed, its front never without liquid; on other meshes, and
 * under a higher load and a lower voltage, as well. */
TESTS(the_default_actuator_stays_closed, 0, FULL_OR(4, 2)) {
  const Setting varied[] = {{"mesh.nodes", 61}, {"mesh.nodes", 31}, {"load.mass", 10e-3}, {"drive.voltage", 8e3}};
  ZpActuatorDef def = DEF({"liquid.model", ZP_LIQUID_AUTO}, {"mesh.nodes", 31}, {"solver.end_time", 0.5}, varied[_i]);
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(result->outcome == ZP_ZIPPED, "%s", result->message);
  ck_assert_double_lt(zp_result_get(result, "closed_from_s"), 0.35);
  ck_assert_double_gt(zp_result_get(result, "contraction"), 0.99);
  ck_assert(isnan(zp_result_get(result, "starved_time_s")));
}

/* Without a voltage nothing zips: a load that pushes the platform up closes the faces as well. */
TEST(pushing_is_not_zipping) {
  ZpActuatorDef def = DEF({"mesh.nodes", 9}, {"drive.voltage", 0}, {"damping.drag", 1});
  ZpSim *sim = sim_of(model_of(&def));
  ck_assert_int_eq(zp_sim_set_input(sim, ZP_INPUT_LOAD, -3 * def.load.mass * def.gravity, 0, NULL), ZP_OK);
  ck_assert(zp_outcome_good(zp_sim_run(sim, 0.5, false, NULL, NULL)));
  ck_assert_double_gt(zp_sim_get(sim, "contraction"), 0.99);
  ck_assert(isnan(zp_sim_zip_time(sim)));
}

/* All members of a series are closed from the time of the last one. */
TEST(a_series_is_closed_with_its_last_member) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"stack.series", 2}, {"solver.end_time", 0.5}, {"load.mass", 5e-3});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  double zip = zp_result_get(result, "zip_time_s");
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert_double_eq(zip,
                      fmax(zp_result_get(result, "member_1_zip_time_s"), zp_result_get(result, "member_2_zip_time_s")));
  ck_assert_double_ge(zp_result_get(result, "closed_from_s"), zip);
}

/* -- the end of a run ------------------------------------------------------------------------------ */

/* A run that ends early has been closed for 0.1 s, in which the contraction changed by less than 1e-4. */
TEST(a_run_ends_early_where_it_stays_closed) {
  ZpActuatorDef def = DEF(COARSE);
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  double end = zp_result_get(result, "simulated_time_s"), least = 2, most = -2;
  ck_assert_double_lt(end, 0.3);
  ck_assert_double_ge(end, zp_result_get(result, "closed_from_s") + 0.1);
  for (size_t row = 0; row < result->series->rows; row++)
    if (time_at(result, row) >= end - 0.1) {
      least = fmin(least, contraction(result, row));
      most = fmax(most, contraction(result, row));
    }
  ck_assert_double_ge(least, 0.99);
  ck_below(most - least, 1e-5); /* 2.1e-6 measured */
}

/* An opening that falls evenly changes by as much as it falls within the window, or since the closing. A line that
 * begins before the closing, as those of neighbours in derivatives may, counts from there on. */
TEST(the_window_slides) {
  static const double from = 0.3, late = 1e-6, slope = -2e-3;
  ZpStill still;
  ZpOpeningAt last = {from - late, 1e-3};
  zp_still_begin(&still, 1e-3);
  ck_assert_double_eq(zp_still_range(&still, from, from), 0);
  for (int k = 1; k <= 100; k++) {
    double t = from + 0.3 * (k + 0.4 * sin(k)) / 100;
    ZpOpeningAt now = {t, 1e-3 + slope * (t - from)};
    zp_still_follow(&still, from, last, now);
    double within = fmin(t - from, ZP_STILL_TIME);
    ck_near(zp_still_range(&still, from, t), -slope * within, 1e-12); /* 1.1e-14 measured */
    last = now;
  }
}

static double end_with(double thickness) {
  ZpActuatorDef def = DEF({"mesh.nodes", 11}, {"liquid.model", ZP_LIQUID_SUBMERGED}, {"solver.end_time", 10},
                          {"medium.kinematic_viscosity", 5e-6}, {"output.errors", false});
  def.ribbon.thickness = thickness;
  double end = answered_value(ZP_STUDY_ACTUATE, &def, "simulated_time_s");
  ck_assert_double_lt(end, 10);
  return end;
}

/* The actuator creeps towards rest, so the end of the run is a smooth function of a key: between six neighbouring
 * thicknesses it grows by nearly equal amounts. */
TEST(the_early_end_is_continuous_in_a_key) {
  enum { RUNS = 6 };
  double end[RUNS];
  for (int k = 0; k < RUNS; k++)
    end[k] = end_with(100e-6 + 0.01e-6 * k);
  double mean = (end[RUNS - 1] - end[0]) / (RUNS - 1);
  for (int k = 1; k < RUNS; k++)
    ck_assert_double_eq_tol(end[k] - end[k - 1], mean, 0.1 * fabs(mean));
}

/* An oscillation of more than 1e-4 about a closed state, or a film that still drains, ends at solver.end_time. */
TEST(a_run_that_creeps_ends_at_its_end_time) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"liquid.model", ZP_LIQUID_SUBMERGED}, {"solver.end_time", 0.35});
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert_double_eq(zp_result_get(result, "simulated_time_s"), 0.35);
  ck_assert_double_lt(zp_result_get(result, "closed_from_s"), 0.25);
}

/* solver.stop_when_zipped true ends at the first 99 %, and knows nothing of what follows. */
TEST(a_run_may_end_at_the_first_closing) {
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, BEAD(50)), first = def;
  first.solver.stop_when_zipped = ZP_WHEN_TRUE;
  def.solver.end_time = 0.2;
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &first), *held = answer_of(ZP_STUDY_ACTUATE, &def);
  double zip = zp_result_get(result, "zip_time_s");
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert(isnan(zp_result_get(result, "closed_from_s")));
  ck_assert_double_lt(zp_result_get(result, "simulated_time_s"), zip + 1e-3);
  ck_near(zip, zp_result_get(held, "zip_time_s"), 3e-7); /* a step ends there; it is interpolated in a step */
}

/* Sequential contact never opens: closing once is closing for good, and ends a run. */
TEST(sequential_contact_ends_where_it_closes) {
  ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21}), first = def;
  first.solver.stop_when_zipped = ZP_WHEN_TRUE;
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def), *stopped = answer_of(ZP_STUDY_ACTUATE, &first);
  double zip = zp_result_get(result, "zip_time_s");
  ck_assert_int_eq(result->outcome, ZP_ZIPPED);
  ck_assert_double_eq(zip, zp_result_get(result, "closed_from_s"));
  ck_assert(isnan(zp_result_get(stopped, "closed_from_s")));
  ck_assert_double_eq(zp_result_get(result, "simulated_time_s"), zp_result_get(stopped, "simulated_time_s"));
  ck_assert_double_eq(zp_result_get(result, "contraction"), zp_result_get(stopped, "contraction"));
  ck_assert_str_eq(result->message, stopped->message);
}

/* A drive that varies, or a controller, keeps the outcome end_time; a supply under a constant drive does not. */
TESTS(other_drives_reach_their_end_time, 0, 2) {
  const ZpActuatorDef cases[] = {
      DEF({"mesh.nodes", 21}, {"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 0.02},
          {"solver.end_time", 0.2}),
      DEF({"mesh.nodes", 21}, {"source.model", ZP_SOURCE_AMPLIFIER}, {"solver.end_time", 0.2})};
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &cases[_i]);
  ck_assert_int_eq(result->outcome, _i == 0 ? ZP_REACHED_END : ZP_ZIPPED);
  ck_assert_double_eq(zp_result_get(result, "simulated_time_s"), 0.2);
  ck_assert_double_lt(zp_result_get(result, "closed_from_s"), 0.15);
}

/* -- in steps and in two parts --------------------------------------------------------------------- */

/* What a program reads while it steps. */
TEST(a_program_sees_it_open_again) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21});
  ZpSim *sim = sim_of(model_of(&def));
  bool opened = false;
  double from = NAN;
  for (double t = 0; t < 0.1; t += 1e-4) {
    ck_assert_int_eq(zp_sim_step(sim, 1e-4, NULL, NULL), ZP_REACHED_END);
    const bool closed = zp_sim_get(sim, "contraction") >= 0.99;
    ck_assert_int_eq(!isnan(zp_sim_closed_from(sim)), closed);
    if (!isnan(from) && !closed) opened = true;
    from = zp_sim_closed_from(sim);
  }
  ck_assert(opened && from > zp_sim_zip_time(sim));
}

/* A run that is cut after it has closed and resumed ends where the whole run ends, to the same bits. A run that is
 * resumed where it has ended goes on. */
TEST(a_resumed_run_ends_where_the_whole_one_ends) {
  ZpActuatorDef whole = DEF({"mesh.nodes", 21}), cut = whole, rest = whole;
  cut.solver.end_time = 0.1;
  rest.initial.state = ZP_INITIAL_CHECKPOINT;
  ZpResult *all = answer_of(ZP_STUDY_ACTUATE, &whole), *part = answer_of(ZP_STUDY_ACTUATE, &cut), *end = NULL;
  ZpStudyInput input = {.start = part->checkpoint};
  end = study_with(ZP_STUDY_ACTUATE, &rest, &input);
  ck_assert_double_eq(zp_checkpoint_time(all->checkpoint), zp_checkpoint_time(end->checkpoint));
  ck_assert_double_eq(zp_result_get(all, "closed_from_s"), zp_result_get(end, "closed_from_s"));
  ck_assert_double_eq(zp_result_get(all, "contraction"), zp_result_get(end, "contraction"));
  input.start = all->checkpoint;
  rest.solver.end_time = zp_checkpoint_time(all->checkpoint) + 0.05;
  end = study_with(ZP_STUDY_ACTUATE, &rest, &input);
  ck_near(zp_result_get(end, "simulated_time_s"), 0.05, 1e-12); /* 2.2e-16 measured */
  ck_assert_int_eq(end->outcome, ZP_ZIPPED);
}
