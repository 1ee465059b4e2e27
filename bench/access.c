/* What it costs to control and watch a simulation from outside, CPU time per call => CSV.
 *
 *   access        the default actuator after 20 ms; setting an unchanged voltage also with electro.model field
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <zipact/zipact.h>

enum { CALLS = 200000 };

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void print_row(const char *model, const char *call, const char *what, double seconds) {
  printf("%s,%s,%s,%.1f\n", model, call, what, 1e9 * seconds / CALLS);
}

/* `a` and `b` by turns. */
static void measure_setting(const char *model, ZpSim *sim, const char *what, double a, double b) {
  zp_sim_set_voltage(sim, b, NULL);
  double start = now();
  for (int k = 0; k < CALLS; k++)
    zp_sim_set_voltage(sim, k % 2 ? b : a, NULL);
  print_row(model, "set", what, now() - start);
}

static void measure_reading(const char *model, ZpSim *sim) {
  static const char *const signal[] = {"time",           "voltage",      "stroke",      "opening",
                                       "charge",         "force",        "current",     "electric_work",
                                       "bending_energy", "field_energy", "capacitance", "energy_imbalance"};
  for (size_t i = 0; i < sizeof signal / sizeof signal[0]; i++) {
    double start = now(), sum = 0;
    for (int k = 0; k < CALLS; k++)
      sum += zp_sim_get(sim, signal[i]);
    double stop = now();
    if (sum != sum) exit(EXIT_FAILURE); /* so that the calls are needed */
    print_row(model, "read", signal[i], stop - start);
  }
}

static void measure(const char *name, ZpElectroModel model) {
  ZpActuatorDef *def = zp_def_create();
  zp_def_set_number(def, "electro.model", model, NULL);
  zp_def_set_number(def, "liquid.model", ZP_LIQUID_NONE, NULL);
  ZpModel *actuator;
  ZpSim *sim;
  ZpError err;
  if (zp_model_create(def, &actuator, &err) != ZP_OK || zp_sim_create(actuator, NULL, &sim, &err) != ZP_OK) {
    fprintf(stderr, "access: %s\n", err.message);
    exit(EXIT_FAILURE);
  }
  zp_sim_set_voltage(sim, 10e3, NULL);
  zp_sim_run(sim, 20e-3, false, NULL, NULL);
  measure_setting(name, sim, "unchanged voltage", 10e3, 10e3);
  if (model == ZP_ELECTRO_PLATES) measure_setting(name, sim, "another voltage", 9e3, 10e3);
  measure_reading(name, sim);
  zp_sim_destroy(sim);
  zp_model_destroy(actuator);
  zp_def_destroy(def);
}

static double same(void *user, ZpSim *sim, double time) {
  (void)sim, (void)time;
  return *(const double *)user;
}

/* CPU time of CALLS explicit steps of the paper's size, each of which begins with a sample where there is a controller.
 */
static double steps_with(const ZpController *controller, double size) {
  const ZpAssignment list[] = {{zp_key_find("preset"), ZP_PRESET_PAPER_CODE},
                               {zp_key_find("mesh.nodes"), 21},
                               {zp_key_find("drive.voltage"), 0},
                               {zp_key_find("solver.time_step"), size}};
  ZpActuatorDef *def = zp_def_create();
  ZpModel *actuator;
  ZpSim *sim;
  ZpError err;
  if (zp_def_resolve(def, list, sizeof list / sizeof list[0], &err) != ZP_OK ||
      zp_model_create(def, &actuator, &err) != ZP_OK || zp_sim_create(actuator, NULL, &sim, &err) != ZP_OK ||
      zp_sim_set_controller(sim, controller, &err) != ZP_OK) {
    fprintf(stderr, "access: %s\n", err.message);
    exit(EXIT_FAILURE);
  }
  double start = now();
  zp_sim_run(sim, CALLS * size, false, NULL, NULL);
  double stop = now();
  zp_sim_destroy(sim);
  zp_model_destroy(actuator);
  zp_def_destroy(def);
  return stop - start;
}

/* What a sample costs beside the controller itself: the difference. */
static void measure_control(void) {
  double voltage = 0, size = 1e-6;
  const ZpController controller = {size, &voltage, same};
  print_row("plates", "control", "a sample", steps_with(&controller, size) - steps_with(NULL, size));
}

int main(void) {
  printf("electro.model,call,what,ns\n");
  measure_control();
  measure("plates", ZP_ELECTRO_PLATES);
  measure("field", ZP_ELECTRO_FIELD);
  return EXIT_SUCCESS;
}
