/* Controllers: one of the program's own, asked at equal intervals while the simulation runs, and the model's. */
#include "check_util.h"

#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <zipact/checkpoint.h>

#include "drive/control.h"
#include "drive/response.h"
#include "run/run.h"

/* -- the fixture ----------------------------------------------------------------------------------- */

enum { MOST = 4096 };

/* An integrating controller that keeps when it was asked, and what it saw. */
typedef struct Integrator {
  double wanted, gain, voltage; /* contraction, V, V */
  int samples;
  double time[MOST], seen[MOST];
} Integrator;

static double integrate(void *user, ZpSim *sim, double time) {
  Integrator *i = user;
  double contraction = zp_sim_get(sim, "contraction");
  i->time[i->samples % MOST] = time;
  i->seen[i->samples++ % MOST] = contraction;
  i->voltage = fmin(fmax(i->voltage + i->gain * (i->wanted - contraction), 0), 5e3);
  return i->voltage;
}

/* A damped actuator without a controller of its own, a simulation of it, and a controller that may be connected. */
static ZpModel *model;
static ZpSim *sim;
static Integrator one;

static void set_up(void) {
  ZpActuatorDef def = DEF({"mesh.nodes", 13}, {"drive.voltage", 1e3}, {"liquid.model", ZP_LIQUID_SUBMERGED});
  model = model_of(&def);
  sim = sim_of(model);
  one = (Integrator){.wanted = 0.02, .gain = 100, .voltage = 1e3};
}

AROUND_EACH(set_up, NULL)

static void connect(double period) {
  const ZpController controller = {period, &one, integrate};
  ck_assert_int_eq(zp_sim_set_controller(sim, &controller, NULL), ZP_OK);
}

/* -- of the program -------------------------------------------------------------------------------- */

/* It is asked at 0, T, 2 T ..., also where the run is cut into pieces that know nothing of T, and nothing depends on
 * how it is cut but rounding of the steps at the cuts. By hand, step by step, it is the same to the last bit. */
TEST(samples_at_equal_intervals) {
  static const double period = 1e-3;
  ZpSim *by_hand = sim_of(model);
  Integrator other = one;
  connect(period);
  run_to(sim, 50 * period);
  for (int k = 0; k < 50; k++) {
    double t = zp_sim_get(by_hand, "time");
    ck_assert_int_eq(zp_sim_set_voltage(by_hand, integrate(&other, by_hand, t), NULL), ZP_OK);
    run_to(by_hand, (k + 1) * period);
  }
  ck_assert_int_eq(one.samples, 50);
  for (int k = 0; k < 50; k++) {
    ck_assert_double_eq(one.time[k], k * period);
    ck_assert_double_eq(one.seen[k], other.seen[k]);
  }
  ck_assert_double_eq(zp_sim_get(sim, "opening"), zp_sim_get(by_hand, "opening"));
}

TEST(runs_in_pieces) {
  connect(1e-3);
  for (int k = 1; k <= 70; k++)
    run_to(sim, k * 0.7e-3);
  ck_assert_int_eq(one.samples, 49);
  for (int k = 0; k < one.samples; k++)
    ck_assert_double_eq_tol(one.time[k], k * 1e-3, 1e-15);
}

/* Without its controller a simulation keeps the last voltage. */
TEST(voltage_stays) {
  connect(2e-3);
  run_to(sim, 0.0111);
  ck_assert_int_eq(one.samples, 6);
  ck_assert_int_eq(zp_sim_set_controller(sim, NULL, NULL), ZP_OK);
  run_to(sim, 0.02);
  ck_assert_int_eq(one.samples, 6);
  ck_assert_double_eq(zp_sim_get(sim, "voltage"), one.voltage);
}

/* Runs on to 30 ms, goes back to now, and runs again: to the same bits. `kept` [size] is set back, too. */
static void expect_same_again(ZpSim *of, void *kept, size_t size) {
  char *bytes = memory_of(zp_sim_state_size(of)), *memory = memory_of(size + 1);
  if (kept) memcpy(memory, kept, size);
  zp_sim_save(of, bytes);
  run_to(of, 30e-3);
  double opening = zp_sim_get(of, "opening"), voltage = zp_sim_get(of, "voltage");
  ck_assert_int_eq(zp_sim_restore(of, bytes, zp_sim_state_size(of), NULL), ZP_OK);
  if (kept) memcpy(kept, memory, size);
  run_to(of, 30e-3);
  ck_assert_double_eq(zp_sim_get(of, "opening"), opening);
  ck_assert_double_eq(zp_sim_get(of, "voltage"), voltage);
}

/* From a snapshot, with the controller's own memory as it was then, at a sample and between two. */
TESTS(continues_from_a_snapshot, 0, 2) {
  connect(1e-3);
  run_to(sim, _i ? 10.3e-3 : 10e-3);
  expect_same_again(sim, &one, sizeof one);
  ck_assert_int_eq(one.samples, 30);
}

static double not_a_voltage(void *user, ZpSim *of, double time) {
  (void)of;
  return time >= 2e-3 ? *(const double *)user : 1e3;
}

TESTS(wrong_voltages, 0, 4) {
  static const double wrong[] = {NAN, INFINITY, -1, 2e6};
  double voltage = wrong[_i];
  const ZpController controller = {1e-3, &voltage, not_a_voltage};
  ZpRunInfo info;
  ck_assert_int_eq(zp_sim_set_controller(sim, &controller, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(sim, 1, false, NULL, &info), ZP_BAD_ARGUMENT);
  ck_assert_msg(strstr(info.message, "controller's voltage at 0.002 s") != NULL, "%s", info.message);
  ck_assert_double_eq(zp_sim_get(sim, "time"), 2e-3);
}

TEST(wrong_controllers) {
  static const double periods[] = {0, -1, NAN, INFINITY, 1e-12};
  ZpError err;
  for (size_t k = 0; k < LENGTH_OF(periods); k++) {
    const ZpController controller = {periods[k], NULL, not_a_voltage};
    ck_says(zp_sim_set_controller(sim, &controller, &err), ZP_BAD_INPUT, "period");
  }
  ck_assert_int_eq(zp_sim_set_controller(sim, &(ZpController){1e-3, NULL, NULL}, &err), ZP_BAD_INPUT);
  ck_says(zp_sim_set_input(sim, ZP_INPUT_SETPOINT, 1e-3, 0, &err), ZP_BAD_INPUT, "control.kind");
}

/* -- the law, alone -------------------------------------------------------------------------------- */

static ZpControl law(void) {
  return (ZpControl){.kind = ZP_CONTROL_PI,
                     .sense = 1,
                     .proportional = 1e6,
                     .integral = 1e7,
                     .period = 1e-3,
                     .band = 0.1,
                     .highest = 1e4,
                     .seed = 1};
}

/* One sample and its output. */
static double answer(const ZpControl *c, double setpoint, double signal, ZpControlState *state) {
  zp_control_sample(c, setpoint, signal, state);
  return zp_control_output(state);
}

/* Constant error e: the voltage is P e + k I T e at sample k from 1 on. */
TEST(law_is_proportional_and_integral) {
  ZpControl c = law();
  ZpControlState state = zp_control_start();
  for (int k = 1; k <= 20; k++)
    ck_near(answer(&c, 5e-3, 6e-3, &state), 1e6 * 1e-3 + k * 1e7 * 1e-3 * 1e-3, 1e-12);
  ck_assert_double_eq(answer(&c, 9e-3, 5e-3, &state), 0);
}

/* The error is positive where it should close further: openings and strokes that are too large, contractions and
 * capacitances that are too small. */
TEST(sign_of_the_error) {
  static const ZpControlSignal signal[] = {ZP_CONTROL_OPENING, ZP_CONTROL_STROKE, ZP_CONTROL_CONTRACTION,
                                           ZP_CONTROL_CAPACITANCE};
  static const bool closes_when_above[] = {true, true, false, false};
  for (int k = 0; k < 4; k++) {
    ZpActuatorDef def = DEF({"control.kind", ZP_CONTROL_PI}, {"control.proportional", 1e3}, {"setpoint.value", 0.5},
                            {"control.signal", (double)signal[k]});
    ZpControl c = zp_control_of(&def);
    ZpControlState state = zp_control_start();
    ck_assert_double_eq(answer(&c, 0.5, 0.75, &state), closes_when_above[k] ? 250 : 0);
    ck_assert_double_eq(answer(&c, 0.5, 0.25, &state), closes_when_above[k] ? 0 : 250);
  }
}

/* While the output is at a limit the integral stands still: after any time there the output leaves it at once. */
TEST(integral_does_not_wind_up) {
  ZpControl c = law();
  ZpControlState state = zp_control_start();
  for (int k = 0; k < 1000; k++)
    ck_assert_double_le(answer(&c, 0, 9.995e-3, &state), 1e4);
  ck_near(state.integral, 1e4 - 1e6 * 9.995e-3, 1e-12); /* which takes the output to the limit */
  ck_assert_double_lt(answer(&c, 0, 4e-3, &state), 1e4);
  state = zp_control_start();
  for (int k = 0; k < 1000; k++)
    ck_assert_double_eq(answer(&c, 5e-3, 0, &state), 0);
  ck_assert_double_eq(state.integral, 0);
}

/* Eq. (28.3): the boost is full beyond the band, proportional within it, and 0 if the actuator should open; with a
 * setpoint of 0 it is full. Kind pi has none. */
TEST(boost_inside_and_outside_its_band) {
  ZpActuatorDef def = DEF({"control.kind", ZP_CONTROL_BOOST_PI}, {"control.boost_voltage", 2e3},
                          {"control.boost_band", 0.2}, {"setpoint.value", 5e-3});
  ZpControl c = zp_control_of(&def);
  ZpControlState state = zp_control_start();
  ck_near(answer(&c, 5e-3, 7e-3, &state), 2e3, 1e-12);
  ck_near(answer(&c, 5e-3, 5.25e-3, &state), 0.25 * 2e3, 1e-12);
  state.integral = 5e3; /* so that a boost downwards would show */
  ck_assert_double_eq(answer(&c, 5e-3, 4e-3, &state), 5e3);
  state.integral = 0;
  ck_near(answer(&c, 0, 1e-6, &state), 2e3, 1e-12);
  ck_near(answer(&c, -5e-3, -4.75e-3, &state), 0.25 * 2e3, 1e-12); /* the band is that of the setpoint's magnitude */
  def.control.kind = ZP_CONTROL_PI;
  c = zp_control_of(&def);
  ck_assert_double_eq(answer(&c, 5e-3, 7e-3, &state), 0);
}

/* Output k takes effect at k T + delay, in order, for any delay; for whole periods exactly at a sample. */
TESTS(outputs_come_late, 0, 6) {
  static const double delays[] = {0, 0.3e-3, 1e-3, 2.5e-3, 3e-3, 8e-3};
  ZpControl c = law();
  c.delay = delays[_i];
  c.integral = 0;
  ZpControlState state = zp_control_start();
  int given = 0;
  for (int k = 0; k < 40;) {
    double sample = zp_control_sample_time(&c, &state), output = zp_control_output_time(&c, &state);
    if (sample <= output) {
      ck_assert_double_eq(sample, k * c.period);
      zp_control_sample(&c, 0, 1e-6 * k++, &state);
      continue;
    }
    double time = given * c.period + c.delay;
    ck_assert_double_eq_tol(output, time, 1e-15);
    ck_assert(fabs(c.delay / c.period - round(c.delay / c.period)) > 1e-6 ||
              output == round(time / c.period) * c.period);
    ck_near(1 + zp_control_output(&state), 1 + 1e6 * 1e-6 * given, 1e-12);
    given++;
  }
  ck_assert_int_ge(given, 30);
}

/* Noise: mean 0, the given standard deviation, no correlation; another seed gives other noise. */
TEST(noise_of_samples) {
  enum { COUNT = 20000 };
  ZpControl c = law();
  c.noise = 1e-4;
  ZpControlState state = zp_control_start(), other = state;
  ZpControl with = c;
  with.seed = 2;
  double sum = 0, squares = 0, products = 0, before = 0;
  bool differs = false;
  for (int k = 0; k < COUNT; k++) {
    answer(&c, 0, 5e-3, &state);
    answer(&with, 0, 5e-3, &other);
    double noise = (state.measured - 5e-3) / c.noise;
    differs = differs || state.measured != other.measured;
    sum += noise, squares += noise * noise, products += noise * before, before = noise;
  }
  /* the laws of chance allow four standard errors; 1.5, 0.4 and 1.5 measured with this seed */
  ck_assert_double_lt(fabs(sum / COUNT), 4 / sqrt(COUNT));
  ck_assert_double_lt(fabs(squares / COUNT - 1), 4 * sqrt(2.0 / COUNT));
  ck_assert_double_lt(fabs(products / COUNT), 4 / sqrt(COUNT));
  ck_assert(differs);
}

/* -- of the model ---------------------------------------------------------------------------------- */

/* The damped actuator with a controller of its keys. */
static ZpActuatorDef controlled(double delay, double noise) {
  return DEF({"mesh.nodes", 13}, {"drive.voltage", 9e3}, {"liquid.model", ZP_LIQUID_SUBMERGED},
             {"control.kind", ZP_CONTROL_PI}, {"control.signal", ZP_CONTROL_CONTRACTION}, {"setpoint.value", 0.25},
             {"control.proportional", 1e4}, {"control.integral", 3e4}, {"control.delay", delay},
             {"control.noise", noise}, {"solver.end_time", 1});
}

typedef struct Twin {
  ZpControl law;
  ZpControlState state;
} Twin;

static double ask_twin(void *user, ZpSim *of, double time) {
  Twin *twin = user;
  (void)time;
  return answer(&twin->law, 0.25, zp_sim_get(of, "contraction"), &twin->state);
}

/* The model's controller does what a program's own would do that has its law, to the last bit. */
TEST(is_one_of_the_program) {
  ZpActuatorDef def = controlled(0, 1e-4);
  ZpModel *with = model_of(&def);
  ZpSim *twins = sim_of(with);
  Twin twin = {zp_control_of(&def), zp_control_start()};
  def.control = zp_actuator_def_default().control;
  def.setpoint = zp_actuator_def_default().setpoint;
  ZpModel *without = model_of(&def);
  ZpSim *own = sim_of(without);
  ck_assert_int_eq(zp_sim_set_voltage(own, 0, NULL), ZP_OK);
  const ZpController controller = {twin.law.period, &twin, ask_twin};
  ck_assert_int_eq(zp_sim_set_controller(own, &controller, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_set_controller(twins, &controller, NULL), ZP_BAD_INPUT);
  run_to(own, 50e-3);
  run_to(twins, 50e-3);
  ck_assert_double_gt(zp_sim_get(own, "voltage"), 100);
  const char *const signals[] = {"voltage", "opening", "source_energy"};
  ck_same_signals((ZpSim *[]){own, twins}, (ZpModel *[]){without, with}, signals, 3, 0);
}

/* The voltage changes where outputs are due, and nowhere else, behind a delay of 1.4 periods. */
TEST(voltage_changes_behind_the_delay) {
  ZpActuatorDef def = controlled(1.4e-3, 0);
  ZpSim *of = sim_of(model_of(&def));
  run_to(of, 1.399e-3);
  ck_assert_double_eq(zp_sim_get(of, "voltage"), 0);
  for (int k = 0; k < 20; k++) {
    run_to(of, (k + 1.41) * 1e-3);
    double first = zp_sim_get(of, "voltage");
    run_to(of, (k + 2.39) * 1e-3);
    ck_assert_double_eq(zp_sim_get(of, "voltage"), first);
    ck_assert_double_ne(first, 0);
  }
}

/* All that the controller remembers is in a snapshot: outputs that are pending, its integral, its noise. */
TESTS(remembers_in_a_snapshot, 0, 2) {
  ZpActuatorDef def = controlled(2.5e-3, 1e-3);
  ZpSim *of = sim_of(model_of(&def));
  ck_assert_int_eq(zp_sim_set_input(of, ZP_INPUT_SETPOINT, 0.03, 0.1, NULL), ZP_OK);
  run_to(of, _i ? 10.3e-3 : 10e-3);
  expect_same_again(of, NULL, 0);
}

/* Explicit steps have the same controller: it is called at the same times with the same values, as far as both
 * integrators agree. */
TEST(explicit_steps_have_it_too) {
  double voltage[2][30];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = controlled(1.4e-3, 1e-4);
    def.liquid.model = ZP_LIQUID_NONE;
    def.damping.internal = 0;
    def.solver.integrator = k ? ZP_INTEGRATOR_EXPLICIT : ZP_INTEGRATOR_IMPLICIT;
    def.solver.tolerance = 1.6e-5;
    ZpSim *of = sim_of(model_of(&def));
    for (int sample = 0; sample < 30; sample++) {
      run_to(of, (sample + 1.45) * 1e-3);
      voltage[k][sample] = zp_sim_get(of, "voltage");
    }
    ck_assert_double_eq(of->state->control.taken, 31);
  }
  ck_assert_double_gt(voltage[0][29], 2e3);
  for (int sample = 0; sample < 30; sample++)
    ck_near(voltage[1][sample], voltage[0][sample], 3e-6); /* 8.8e-7 measured */
}

/* With a controller the setpoint is an input, the voltage is not. */
TEST(setpoint_by_hand) {
  ZpActuatorDef def = controlled(0, 0);
  ZpSim *of = sim_of(model_of(&def));
  ZpError err;
  double slope[128];
  ck_assert_double_eq(zp_sim_get(of, "setpoint"), 0.25);
  ck_assert(isnan(zp_sim_get(of, "measured")));
  ck_assert_int_eq(zp_sim_set_input(of, ZP_INPUT_SETPOINT, 0.01, 0.5, &err), ZP_OK);
  run_to(of, 10e-3);
  ck_near(zp_sim_get(of, "setpoint"), 0.015, 1e-12);
  ck_assert_int_eq(zp_sim_input_slopes(of, ZP_INPUT_SETPOINT, slope, &err), ZP_OK);
  ck_says(zp_sim_set_voltage(of, 1e3, &err), ZP_BAD_INPUT, "set the setpoint");
  ck_assert_int_eq(zp_sim_set_input(of, ZP_INPUT_SETPOINT, 2e3, 0, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_sim_set_input(of, ZP_INPUT_SETPOINT, NAN, 0, &err), ZP_BAD_INPUT);
}

enum { STEPPED = 0, UNSTEPPED = 1, UNTRIED = 2 };

/* In a process that the kernel kills at any system call but read, write and exit: 100 steps of 1 ms. */
static _Noreturn void step_without_system_calls(ZpSim *of) {
  ZpOutcome outcome = ZP_REACHED_END;
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT)) _exit(UNTRIED);
  for (int k = 0; k < 100 && outcome == ZP_REACHED_END; k++)
    outcome = zp_sim_step(of, 1e-3, NULL, NULL);
  syscall(SYS_exit, outcome == ZP_REACHED_END ? STEPPED : UNSTEPPED);
  abort();
}

/* A control loop in real time: a liquid, a controller, and no system call. Sanitizers make calls of their own. */
TEST(steps_make_no_system_call) {
  ZpActuatorDef def = controlled(1.5e-3, 1e-3);
  def.liquid.model = ZP_LIQUID_BEAD;
  ZpSim *of = sim_of(model_of(&def));
  int status = 0;
  pid_t child = SANITIZED ? 0 : fork();
  if (!SANITIZED && child == 0) step_without_system_calls(of);
  if (child > 0) waitpid(child, &status, 0);
  ck_assert_msg(WIFEXITED(status), "killed by signal %d: a system call", WTERMSIG(status));
  ck_assert_int_ne(WEXITSTATUS(status), UNSTEPPED);
}

/* The first time (s) in the rows at which a column is at `level`, on straight lines. */
static double time_at(const ZpTable *rows, const char *column, double level) {
  for (size_t k = 1; k < rows->rows; k++) {
    double a = zp_table_get(rows, k - 1, column), b = zp_table_get(rows, k, column),
           t = zp_table_get(rows, k, "time_s");
    if (b >= level) return t - (b - level) / (b - a) * (t - zp_table_get(rows, k - 1, "time_s"));
  }
  return NAN;
}

/* The response of a run by its rows, which are not the controller's samples. */
static void check_response(const ZpResult *result, double setpoint) {
  const ZpTable *rows = result->series;
  double rise = time_at(rows, "contraction", 0.9 * setpoint) - time_at(rows, "contraction", 0.1 * setpoint);
  double end = zp_table_get(rows, rows->rows - 1, "time_s"), sum = 0, squares = 0, count = 0, settled = 0;
  for (size_t k = 0; k < rows->rows; k++) {
    double off = setpoint - zp_table_get(rows, k, "contraction"), t = zp_table_get(rows, k, "time_s");
    if (fabs(off) > 0.02 * setpoint) settled = t;
    if (t >= 0.9 * end) sum += off, squares += off * off, count++;
  }
  double mean = sum / count, ripple = sqrt(squares / count - mean * mean), most = largest_in(rows, "contraction");
  ck_near(zp_result_get(result, "rise_time_s"), rise, 2e-4); /* 5.4e-5 measured */
  ck_near(zp_result_get(result, "overshoot"), most / setpoint - 1,
          5e-4); /* 1.9e-4 measured; 3.1e-5 after other rounding */
  ck_below(fabs(zp_result_get(result, "steady_state_error") - mean), 6e-4); /* 1.9e-4 measured */
  ck_near(zp_result_get(result, "steady_state_ripple"), ripple, 5e-2);      /* 1.7e-2 measured */
  ck_below(fabs(zp_result_get(result, "settling_time_s") - settled), 3e-3); /* 9.7e-4 measured */
}

/* Held against a spring: the final value is the setpoint, with an ideal source and an amplifier; the summary agrees. */
TESTS(holds_its_setpoint, 0, 2) {
  ZpActuatorDef def = controlled(0, 0);
  def.load.stiffness = 20;
  def.load.rest_opening = 20e-3;
  def.setpoint.value = 0.1;
  def.control.proportional = 1e4;
  def.control.integral = 4e5;
  if (_i == 1) def.source.model = ZP_SOURCE_AMPLIFIER, def.source.slew_rate = 1e6, def.source.resistance = 1e6;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_REACHED_END);
  ck_near(zp_result_get(result, "contraction"), 0.1, 2e-2);          /* 0.012 measured */
  ck_below(fabs(zp_result_get(result, "steady_state_error")), 2e-3); /* 1.2e-3 measured */
  ck_below(zp_result_get(result, "settling_time_s"), 1);
  ck_below(zp_result_get(result, "rise_time_s"), zp_result_get(result, "settling_time_s"));
  ck_assert_double_ge(zp_result_get(result, "overshoot"), 0);
  check_response(result, def.setpoint.value);
  ck_assert_double_eq(zp_table_get(result->series, result->series->rows - 1, "setpoint"), 0.1);
  ck_assert_double_gt(zp_result_get(result, "source_energy_J"), 0);
}

/* Eq. (28.5): without damping the eigenvalues of the loop add up to 0, and no gains hold anything. Half of the
 * contraction is neither reached nor held; with small gains it is not reached, with larger ones it swings. */
TEST(undamped_nothing_is_held) {
  static const double gains[][2] = {{3e3, 0}, {3e3, 3e3}, {1e4, 1e4}, {3e4, 1e4}};
  ZpActuatorDef def = controlled(0, 0);
  def.mesh.nodes = 7;
  def.liquid.model = ZP_LIQUID_NONE;
  def.damping.internal = 0;
  def.solver.tolerance = 1e-4; /* waves are resolved */
  def.setpoint.value = 0.5;
  def.control.proportional = gains[_i][0];
  def.control.integral = gains[_i][1];
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_REACHED_END);
  ck_assert(isnan(zp_result_get(result, "settling_time_s")));
  ck_assert_double_gt(fabs(zp_result_get(result, "steady_state_error")) + zp_result_get(result, "steady_state_ripple"),
                      0.1);
}
ALSO_NIGHTLY(undamped_nothing_is_held, 1, 4)

/* Out of reach of the voltage, which only closes: the run ends well, and a note says why. */
TESTS(out_of_reach, 0, 2) {
  ZpActuatorDef def = controlled(0, 0);
  if (_i == 1) def.setpoint.value = -0.1;
  def.drive.voltage = 500;
  def.solver.end_time = 0.2;
  def.control.integral = 1e5;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_REACHED_END);
  ck_assert(isnan(zp_result_get(result, "settling_time_s")));
  ck_assert_uint_ge(result->notes, 1);
  ck_assert_msg(strstr(result->note[0], _i ? "its limit of 0 V" : "its limit of 500 V") != NULL, "%s", result->note[0]);
}

/* Columns have the unit of the signal. */
TEST(units_of_the_signal) {
  static const char *const names[] = {"setpoint_m", "setpoint_m", "setpoint", "setpoint_F"};
  ZpActuatorDef def = controlled(0, 0);
  for (int k = 0; k < 4; k++) {
    size_t count, found = 0;
    def.control.signal = (ZpControlSignal)k;
    const ZpColumn *column = zp_signal_columns_of(&def, &count);
    for (size_t c = 0; c < count; c++)
      found += strcmp(column[c].name, names[k]) == 0;
    ck_assert_uint_eq(found, 1);
  }
}

/* -- what is refused ------------------------------------------------------------------------------- */

TESTS(wrong_keys, 0, 13) {
  static const struct {
    Setting setting;
    const char *says;
  } wrong[] = {{{"control.kind", ZP_CONTROL_NONE}, "requires control.kind"},
               {{"control.proportional", -1}, "control.proportional"},
               {{"control.period", 0}, "control.period"},
               {{"control.period", 2}, "longer than the run"},
               {{"control.delay", 9e-3}, "at most 8 periods"},
               {{"control.boost_band", 0}, "control.boost_band"},
               {{"solver.end_time", 2e3}, "more than 1e+06 samples"},
               {{"setpoint.value", 1.1}, "at most 1"},
               {{"setpoint.value", NAN}, "requires setpoint.value, which is missing"},
               {{"setpoint.frequency", 5}, "setpoint.waveform sine or square"},
               {{"drive.waveform", ZP_WAVEFORM_SINE}, "the controller sets the voltage"},
               {{"actuator.kind", ZP_KIND_FLANGE}, "control.signal = contraction"},
               {{"actuator.kind", ZP_KIND_RIBBON}, "a voltage does nothing to a single ribbon"}};
  const Setting list[] = {
      {"liquid.model", ZP_LIQUID_NONE}, {"control.kind", ZP_CONTROL_PI}, {"control.signal", ZP_CONTROL_CONTRACTION},
      {"control.proportional", 1e3},    {"setpoint.value", 0.5},         wrong[_i].setting};
  ZpActuatorDef def = {0};
  ZpError err = {ZP_OK, ""};
  ZpStatus status = resolve(&def, list, LENGTH_OF(list), &err);
  if (status == ZP_OK) status = zp_study_check(ZP_STUDY_ACTUATE, &def, &err);
  ck_assert_int_eq(status, ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, wrong[_i].says) != NULL, "%s", err.message);
}

TEST(no_controller_in_cycles) {
  ZpActuatorDef def = controlled(0, 0);
  ck_refused_by(ZP_STUDY_CYCLE, &def, "study cycle requires none");
}

/* -- numbers of a response ------------------------------------------------------------------------- */

enum { SAMPLES = 4001 };

static ZpResponseSample sample[SAMPLES];

/* A system of second order with this damping ratio and angular frequency, of first order with the rate w if the ratio
 * is 0, from 1 to 3 at 0.1 s. */
static ZpResponse respond(double zeta, double w) {
  for (int k = 0; k < SAMPLES; k++) {
    double t = k * 1e-3, s = t - 0.1, wd = w * sqrt(1 - zeta * zeta);
    double left = zeta == 0 ? exp(-w * s) : exp(-zeta * w * s) * (cos(wd * s) + zeta * w / wd * sin(wd * s));
    sample[k] = (ZpResponseSample){t, s < 0 ? 1 : 3, s < 0 ? 1 : 3 - 2 * left};
  }
  return zp_response_of(sample, SAMPLES);
}

/* First-order response: rise time ln 9 and settling time ln 50 time constants; no overshoot. */
TEST(response_of_first_order) {
  ZpResponse r = respond(0, 5);
  ck_near(r.rise_time, log(9) / 5, 5e-6);      /* 1e-6 measured */
  ck_near(r.settling_time, log(50) / 5, 3e-6); /* 7.7e-7 measured */
  ck_assert_double_eq(r.overshoot, 0);
  ck_below(fabs(r.error), 1e-7); /* 2.1e-8 measured */
}

/* Second-order response: overshoot exp(-pi zeta / sqrt(1 - zeta^2)); it has settled after the last wave that exceeds 2
 * %. */
TEST(response_of_second_order) {
  double zeta = 0.4, w = 10;
  ZpResponse r = respond(zeta, w);
  ck_near(r.overshoot, exp(-acos(-1) * zeta / sqrt(1 - zeta * zeta)), 1e-5); /* 2.5e-6 measured */
  double level = 0, at = 0;
  for (double s = 0; s < 3; s += 1e-6) {
    double wd = w * sqrt(1 - zeta * zeta);
    level = exp(-zeta * w * s) * (cos(wd * s) + zeta * w / wd * sin(wd * s));
    if (fabs(level) > 0.02) at = s;
  }
  ck_near(r.settling_time, at, 5e-6); /* 1.2e-6 measured */
}

/* Without a step, a change or a settled end the numbers are missing. */
TEST(response_that_is_none) {
  for (int k = 0; k < SAMPLES; k++)
    sample[k] = (ZpResponseSample){k * 1e-3, fmin(k * 1e-3, 1), 0.5};
  ZpResponse r = zp_response_of(sample, SAMPLES);
  ck_assert(isnan(r.rise_time) && isnan(r.overshoot) && isnan(r.settling_time));
  ck_near(r.error, 0.5, 1e-12);
  for (int k = 0; k < SAMPLES; k++)
    sample[k] = (ZpResponseSample){k * 1e-3, 2, 1 + 0.5 * (k > 0)};
  r = zp_response_of(sample, SAMPLES);
  ck_assert(isnan(r.rise_time) && isnan(r.settling_time));
  ck_assert_double_eq(r.overshoot, 0);
  ck_near(r.error, 0.5, 1e-12);
  ck_assert_double_eq(r.ripple, 0);
  for (int k = 0; k < SAMPLES; k++)
    sample[k] = (ZpResponseSample){k * 1e-3, 2, k % 2 ? 1.75 : 2.25};
  r = zp_response_of(sample, SAMPLES);
  ck_near(r.ripple, 0.25, 1e-5); /* 3.1e-6 measured */
  ck_assert(isnan(zp_response_of(sample, 1).error));
}

/* Without gravity the actuator is closed at rest. Its controller integrated what is no number. */
TEST(no_contraction_is_controlled_without_an_opening) {
  ZpActuatorDef def = DEF({"mesh.nodes", 9}, {"gravity", 0}, {"control.kind", ZP_CONTROL_PI},
                          {"control.signal", ZP_CONTROL_CONTRACTION}, {"setpoint.value", 0.4});
  ZpModel *model = model_of(&def);
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_sim_create(model, NULL, &sim, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(sim);
  ck_assert_msg(strstr(err.message, "control.signal = contraction") != NULL, "%s", err.message);
}
