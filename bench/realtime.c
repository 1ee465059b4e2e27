/* What one step of 1 ms of a control loop costs, at its median and at its worst, CPU time of the thread => CSV.
 *
 *   realtime [STEPS]   the default actuator in its bead of liquid, 61 nodes, tolerance 1e-3: 10 kV for 250 ms, then 0 V
 * for as long, again and again; the largest cost of each share of the steps, a histogram, and what the slowest steps
 * did
 *
 * The first cycle is not counted: it meets every page of memory for the first time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <zipact/zipact.h>

enum { USUAL = 100000, CYCLE = 500, ON = 250, BINS = 40, SLOWEST = 10 };

static const double step_size = 1e-3, bin = 0.1e-3; /* s; s of CPU time */

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* A step: its CPU time, its place in the cycle, and what it took. */
typedef struct Cost {
  double cpu;
  int place;
  int64_t steps, rejected, iterations;
} Cost;

static int ascending(const void *a, const void *b) {
  double x = ((const Cost *)a)->cpu, y = ((const Cost *)b)->cpu;
  return (x > y) - (x < y);
}

static void fail(const char *message) {
  fprintf(stderr, "realtime: %s\n", message);
  exit(EXIT_FAILURE);
}

/* One step at the voltage of its place in the cycle. */
static Cost measure(ZpSim *sim, ZpRunInfo *info, int k) {
  double start = now();
  zp_sim_set_voltage(sim, k % CYCLE < ON ? 10e3 : 0, NULL);
  if (zp_sim_step(sim, step_size, NULL, info) != ZP_REACHED_END) fail(zp_run_info_message(info));
  return (Cost){now() - start, k % CYCLE, (int64_t)zp_run_info_get(info, "steps"),
                (int64_t)zp_run_info_get(info, "rejected"), (int64_t)zp_run_info_get(info, "iterations")};
}

/* How far it has closed and opened, as contraction. */
typedef struct Extremes {
  double least, most;
} Extremes;

static void print(Cost *cost, int steps) {
  static const double share[] = {0.5, 0.9, 0.99, 0.999, 1};
  int count[BINS + 1] = {0};
  qsort(cost, (size_t)steps, sizeof *cost, ascending);
  printf("share_of_steps,cpu_ms\n");
  for (size_t k = 0; k < sizeof share / sizeof share[0]; k++)
    printf("%g,%.3f\n", share[k], 1e3 * cost[(int)ceil(share[k] * steps) - 1].cpu);
  for (int k = 0; k < steps; k++)
    count[(int)fmin(cost[k].cpu / bin, BINS)]++;
  printf("\nfrom_ms,steps\n");
  for (int k = 0; k <= BINS; k++)
    if (count[k]) printf("%.1f,%d\n", 1e3 * bin * k, count[k]);
  printf("\ncpu_ms,place_in_cycle_ms,time_steps,rejected,newton_iterations\n");
  for (int k = steps - 1; k >= 0 && k >= steps - SLOWEST; k--)
    printf("%.3f,%d,%lld,%lld,%lld\n", 1e3 * cost[k].cpu, cost[k].place, (long long)cost[k].steps,
           (long long)cost[k].rejected, (long long)cost[k].iterations);
}

int main(int argc, char **argv) {
  const int steps = argc > 1 ? atoi(argv[1]) : USUAL;
  ZpError err;
  ZpModel *model;
  ZpSim *sim;
  ZpRunInfo *info = zp_run_info_create();
  ZpActuatorDef *def = zp_def_create();
  zp_def_set_number(def, "liquid.model", ZP_LIQUID_BEAD, NULL);
  zp_def_set_number(def, "solver.tolerance", 1e-3, NULL); /* times to 0.2 %: a controller corrects more than that */
  Cost *cost = steps > 0 ? malloc((size_t)steps * sizeof *cost) : NULL;
  if (!cost) fail("give a number of steps above 0");
  if (zp_model_create(def, &model, &err) != ZP_OK || zp_sim_create(model, NULL, &sim, &err) != ZP_OK) fail(err.message);
  for (int k = 0; k < CYCLE; k++)
    measure(sim, info, k);
  Extremes contraction = {INFINITY, -INFINITY};
  for (int k = 0; k < steps; k++) {
    cost[k] = measure(sim, info, k);
    contraction.least = fmin(contraction.least, zp_sim_get(sim, "contraction"));
    contraction.most = fmax(contraction.most, zp_sim_get(sim, "contraction"));
  }
  print(cost, steps);
  printf("\nleast_contraction,most_contraction\n%.3f,%.3f\n", contraction.least, contraction.most);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  zp_run_info_destroy(info);
  zp_def_destroy(def);
  free(cost);
  return EXIT_SUCCESS;
}
