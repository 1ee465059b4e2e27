/* What the limits of an actuator cost: study limits from scratch, from a neighbour, and study equilibrium, which
 * follows the curve; ms of CPU time, median of many. `limits [NODES]`; counts by callgrind: `limits NODES once|warm`.
 */
#include <zipact/zipact.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RUNS = 41 };

static double cpu_ms(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int larger(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static ZpResult *run(ZpStudy study, const ZpActuatorDef *def, const ZpResult *neighbour) {
  ZpResult *result;
  ZpError err;
  const ZpStudyInput input = {.neighbour = neighbour};
  if (zp_study_run(study, def, &input, NULL, &result, &err) == ZP_OK) return result;
  fprintf(stderr, "%s\n", err.message);
  exit(1);
}

/* A sweep over the load, 8 g and then 0.1 % more from run to run; warm: each from the run before it. */
static void measure(const char *name, ZpStudy study, ZpActuatorDef def, int runs, int warm) {
  double ms[RUNS], limits = 0;
  ZpResult *before = run(study, &def, NULL);
  for (int k = 0; k < runs; k++) {
    def.load.mass *= 1.001;
    double start = cpu_ms();
    ZpResult *result = run(study, &def, warm ? before : NULL);
    ms[k] = cpu_ms() - start;
    if (warm) limits += zp_result_get(result, "warm_starts");
    zp_result_destroy(before);
    before = result;
  }
  zp_result_destroy(before);
  qsort(ms, (size_t)runs, sizeof *ms, larger);
  printf("%-28s N = %d: %.2f ms, least %.2f ms", name, def.mesh.nodes, ms[runs / 2], ms[0]);
  printf(warm ? "; %.2f of 3 limits from the neighbour\n" : "\n", limits / runs);
}

int main(int argc, char **argv) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.output.errors = false;
  def.liquid.model = ZP_LIQUID_NONE;
  def.mesh.nodes = argc > 1 ? atoi(argv[1]) : 61;
  if (argc > 2) {
    ZpResult *first = run(ZP_STUDY_LIMITS, &def, NULL);
    def.load.mass *= 1.001;
    if (strcmp(argv[2], "warm") == 0) zp_result_destroy(run(ZP_STUDY_LIMITS, &def, first));
    zp_result_destroy(first);
    return 0;
  }
  measure("limits from scratch", ZP_STUDY_LIMITS, def, RUNS, 0);
  measure("limits from a neighbour", ZP_STUDY_LIMITS, def, RUNS, 1);
  measure("equilibrium", ZP_STUDY_EQUILIBRIUM, def, RUNS, 0);
  return 0;
}
