/* What the limits of an actuator cost: study limits from scratch, from a neighbour, and study equilibrium, which
 * follows the curve, dry and with a bead; ms of CPU time, median of many. `limits [NODES]`; counts by callgrind:
 * `limits NODES once|warm|pull_in [bead]`. */
#include <zipact/zipact.h>

#include "def/def.h"
#include "study/result.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "rest/quasistatic.h"

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

static void tell(const char *name, const ZpActuatorDef *def, double ms[RUNS]) {
  qsort(ms, RUNS, sizeof *ms, larger);
  printf("%-28s N = %d, %s: %.2f ms, least %.2f ms", name, def->mesh.nodes,
         def->liquid.model == ZP_LIQUID_BEAD ? "bead" : "dry", ms[RUNS / 2], ms[0]);
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
static void measure(const char *name, ZpStudy study, ZpActuatorDef def, int warm) {
  double ms[RUNS], limits = 0;
  ZpResult *before = run(study, &def, NULL);
  for (int k = 0; k < RUNS; k++) {
    def.load.mass *= 1.001;
    double start = cpu_ms();
    ZpResult *result = run(study, &def, warm ? before : NULL);
    ms[k] = cpu_ms() - start;
    if (warm) limits += zp_result_get(result, "warm_starts");
    zp_result_destroy(before);
    before = result;
  }
  zp_result_destroy(before);
  tell(name, &def, ms);
  printf(warm ? "; %.2f of 3 limits from the neighbour\n" : "\n", limits / RUNS);
}

/* -- the pull-in alone -------------------------------------------------------------------------------- */

typedef struct PullIn {
  ZpRest rest;
  ZpLimit limit;
} PullIn;

static void reserve(void *user, ZpArena *arena) {
  PullIn *p = user;
  zp_limit_reserve(&p->limit, zp_rest_save_size(&p->rest), p->rest.statics.n, arena);
}

/* From scratch, the model included: hang, go to the first limit point, look for other crests round it. => V */
static double pull_in(const ZpActuatorDef *def) {
  PullIn p = {.limit = {.value = 0}};
  ZpModel *model;
  if (zp_model_create(def, &model, NULL) != ZP_OK || !zp_rest_open(&p.rest, model, reserve, &p)) exit(1);
  zp_rest_hang(&p.rest, 0);
  zp_statics_stable(&p.rest.statics);
  zp_quasistatic_start(&p.rest);
  if (zp_quasistatic_first(&p.rest, def->drive.voltage, &p.limit) != ZP_TRACK_FOLD) exit(1);
  zp_quasistatic_look_around(&p.rest, &p.limit, 1);
  zp_rest_close(&p.rest);
  zp_model_destroy(model);
  return p.limit.value;
}

static void measure_pull_in(ZpActuatorDef def) {
  double ms[RUNS], value = 0;
  for (int k = 0; k < RUNS; k++) {
    def.load.mass *= 1.001;
    double start = cpu_ms();
    value = pull_in(&def);
    ms[k] = cpu_ms() - start;
  }
  tell("pull-in alone", &def, ms);
  printf("; the last at %.2f V\n", value);
}

/* -- the command -------------------------------------------------------------------------------------- */

static void count(const char *what, ZpActuatorDef def) {
  if (strcmp(what, "pull_in") == 0) {
    printf("%.6f V\n", pull_in(&def));
    return;
  }
  ZpResult *first = run(ZP_STUDY_LIMITS, &def, NULL);
  def.load.mass *= 1.001;
  if (strcmp(what, "warm") == 0) zp_result_destroy(run(ZP_STUDY_LIMITS, &def, first));
  zp_result_destroy(first);
}

int main(int argc, char **argv) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.output.errors = false;
  def.mesh.nodes = argc > 1 ? atoi(argv[1]) : 61;
  for (int bead = 0; bead < 2; bead++) {
    bool asked = argc > 3 && strcmp(argv[3], "bead") == 0;
    def.liquid.model = bead ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE;
    if (argc > 2 && asked == (bead == 1)) count(argv[2], def);
    if (argc > 2) continue;
    measure_pull_in(def);
    measure("limits from scratch", ZP_STUDY_LIMITS, def, 0);
    measure("limits from a neighbour", ZP_STUDY_LIMITS, def, 1);
    measure("equilibrium", ZP_STUDY_EQUILIBRIUM, def, 0);
  }
  return 0;
}
