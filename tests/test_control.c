/* A controller of the program's own, asked at equal intervals while the simulation runs. */
#include "check_util.h"

#include <zipact/checkpoint.h>

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

static Integrator integrator(void) {
  return (Integrator){.wanted = 0.02, .gain = 100, .voltage = 1e3};
}

static ZpModel *damped(void) {
  ZpActuatorDef def = DEF({"mesh.nodes", 13}, {"drive.voltage", 1e3}, {"liquid.model", ZP_LIQUID_SUBMERGED});
  return model_of(&def);
}

static void connect(ZpSim *sim, Integrator *i, double period) {
  const ZpController controller = {period, i, integrate};
  ck_assert_int_eq(zp_sim_set_controller(sim, &controller, NULL), ZP_OK);
}

static void run(ZpSim *sim, double end_time) {
  ZpRunInfo info;
  ck_assert_msg(zp_sim_run(sim, end_time, false, NULL, &info) == ZP_REACHED_END, "%s", info.message);
}

/* It is asked at 0, T, 2 T ..., also where the run is cut into pieces that know nothing of T, and nothing depends on
 * how it is cut but rounding of the steps at the cuts. By hand, step by step, it is the same to the last bit. */
START_TEST(samples_at_equal_intervals) {
  static const double period = 1e-3;
  ZpModel *model = damped();
  ZpSim *sim = sim_of(model), *by_hand = sim_of(model);
  Integrator one = integrator(), other = integrator();
  connect(sim, &one, period);
  run(sim, 50 * period);
  for (int k = 0; k < 50; k++) {
    double t = zp_sim_get(by_hand, "time");
    ck_assert_int_eq(zp_sim_set_voltage(by_hand, integrate(&other, by_hand, t), NULL), ZP_OK);
    run(by_hand, (k + 1) * period);
  }
  ck_assert_int_eq(one.samples, 50);
  for (int k = 0; k < 50; k++) {
    ck_assert_double_eq(one.time[k], k * period);
    ck_assert_double_eq(one.seen[k], other.seen[k]);
  }
  ck_assert_double_eq(zp_sim_get(sim, "opening"), zp_sim_get(by_hand, "opening"));
  zp_sim_destroy(sim);
  zp_sim_destroy(by_hand);
  zp_model_destroy(model);
}
END_TEST

START_TEST(runs_in_pieces) {
  ZpModel *model = damped();
  ZpSim *sim = sim_of(model);
  Integrator i = integrator();
  connect(sim, &i, 1e-3);
  for (int k = 1; k <= 70; k++)
    run(sim, k * 0.7e-3);
  ck_assert_int_eq(i.samples, 49);
  for (int k = 0; k < i.samples; k++)
    ck_assert_double_eq_tol(i.time[k], k * 1e-3, 1e-15);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

/* Without its controller a simulation keeps the last voltage. */
START_TEST(voltage_stays) {
  ZpModel *model = damped();
  ZpSim *sim = sim_of(model);
  Integrator i = integrator();
  connect(sim, &i, 2e-3);
  run(sim, 0.0111);
  ck_assert_int_eq(i.samples, 6);
  ck_assert_int_eq(zp_sim_set_controller(sim, NULL, NULL), ZP_OK);
  run(sim, 0.02);
  ck_assert_int_eq(i.samples, 6);
  ck_assert_double_eq(zp_sim_get(sim, "voltage"), i.voltage);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

/* From a snapshot, with the controller's own memory as it was then, all goes on to the same bits, at a sample and
 * between two. */
START_TEST(continues_from_a_snapshot) {
  ZpModel *model = damped();
  ZpSim *sim = sim_of(model);
  Integrator i = integrator();
  connect(sim, &i, 1e-3);
  run(sim, _i ? 10.3e-3 : 10e-3);
  Integrator kept = i;
  char *bytes = malloc(zp_sim_state_size(sim));
  zp_sim_save(sim, bytes);
  run(sim, 30e-3);
  double opening = zp_sim_get(sim, "opening");
  const int samples = i.samples;
  ck_assert_int_eq(zp_sim_restore(sim, bytes, zp_sim_state_size(sim), NULL), ZP_OK);
  i = kept;
  run(sim, 30e-3);
  ck_assert_double_eq(zp_sim_get(sim, "opening"), opening);
  ck_assert_int_eq(i.samples, samples);
  free(bytes);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

static double not_a_voltage(void *user, ZpSim *sim, double time) {
  (void)sim;
  return time >= 2e-3 ? *(const double *)user : 1e3;
}

START_TEST(wrong_controllers) {
  static const double wrong[] = {NAN, INFINITY, -1, 2e6}, periods[] = {0, -1, NAN, INFINITY, 1e-12};
  ZpModel *model = damped();
  ZpRunInfo info;
  ZpError err;
  for (size_t k = 0; k < LENGTH_OF(wrong); k++) {
    double voltage = wrong[k];
    ZpSim *sim = sim_of(model);
    const ZpController controller = {1e-3, &voltage, not_a_voltage};
    ck_assert_int_eq(zp_sim_set_controller(sim, &controller, NULL), ZP_OK);
    ck_assert_int_eq(zp_sim_run(sim, 1, false, NULL, &info), ZP_BAD_ARGUMENT);
    ck_assert_msg(strstr(info.message, "controller's voltage at 0.002 s") != NULL, "%s", info.message);
    ck_assert_double_eq(zp_sim_get(sim, "time"), 2e-3);
    zp_sim_destroy(sim);
  }
  ZpSim *sim = sim_of(model);
  for (size_t k = 0; k < LENGTH_OF(periods); k++) {
    const ZpController controller = {periods[k], NULL, not_a_voltage};
    ck_assert_int_eq(zp_sim_set_controller(sim, &controller, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, "period") != NULL, "%s", err.message);
  }
  ck_assert_int_eq(zp_sim_set_controller(sim, &(ZpController){1e-3, NULL, NULL}, &err), ZP_BAD_INPUT);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("control");
  TCase *tcase = tcase_create("controller");
  suite_add_tcase(suite, tcase);
  tcase_add_test(tcase, samples_at_equal_intervals);
  tcase_add_test(tcase, runs_in_pieces);
  tcase_add_test(tcase, voltage_stays);
  tcase_add_loop_test(tcase, continues_from_a_snapshot, 0, 2);
  tcase_add_test(tcase, wrong_controllers);
  return run_suite(suite);
}
