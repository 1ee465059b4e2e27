/* What networks of equal members cost for each member: in series, side by side, and as a binary tree; 21 nodes, dry.
 *
 *   networks [MOST]    a step in time (of the first 0.1 s at 10 kV), hanging, modes, the first pull-in; µs of CPU time
 *                      a member, the least of several; memory of a run, KiB a member
 *   networks chain N   N in series: hanging, 20 modes, the first pull-in, s of CPU time
 *   networks run series|side_by_side|tree N   the run alone, for counts of instructions
 */
#include <zipact/io.h>
#include <zipact/zipact.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "rest/quasistatic.h"
#include "rest/vibration.h"

enum { MOST = 255, REPEATS = 5, BODY = 400 };

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void fail(const char *message) {
  fprintf(stderr, "networks: %s\n", message);
  exit(EXIT_FAILURE);
}

/* -- scenarios ---------------------------------------------------------------------------------------- */

typedef struct Text {
  char *of;
  size_t used;
} Text;

#define WRITE(text, ...) ((text)->used += (size_t)sprintf((text)->of + (text)->used, __VA_ARGS__))

static void series(int n, Text *text) {
  for (int k = 1; k <= n; k++)
    WRITE(text, "bodies.b%d.mass: %s\n", k, k == n ? "8 g" : "1 mg");
  for (int k = 1; k <= n; k++) {
    if (k == 1)
      WRITE(text, "members.m1: {upper: frame, lower: b1}\n");
    else
      WRITE(text, "members.m%d: {upper: b%d, lower: b%d}\n", k, k - 1, k);
  }
}

static void side_by_side(int n, Text *text) {
  WRITE(text, "bodies.bar.mass: %d g\n", 8 * n);
  for (int k = 1; k <= n; k++)
    WRITE(text, "members.m%d: {upper: frame, lower: bar}\n", k);
}

/* Member k hangs on the body of member k / 2. All are of one width, and the leaves together weigh 8 g. */
static void tree(int n, Text *text) {
  for (int k = 1; k <= n; k++)
    WRITE(text, "bodies.b%d.mass: %g g\n", k, 2 * k > n ? 16.0 / (n + 1) : 0.001);
  for (int k = 1; k <= n; k++) {
    if (k == 1)
      WRITE(text, "members.m1: {upper: frame, lower: b1}\n");
    else
      WRITE(text, "members.m%d: {upper: b%d, lower: b%d}\n", k, k / 2, k);
  }
}

typedef struct Shape {
  const char *name;
  void (*write)(int n, Text *text);
} Shape;

static const Shape shapes[] = {{"series", series}, {"side_by_side", side_by_side}, {"tree", tree}};

static ZpModel *model_of(const Shape *shape, int n) {
  Text text = {calloc((size_t)n + 1, BODY), 0};
  ZpScenario *scenario = zp_scenario_create();
  ZpActuatorDef *def = zp_def_create();
  ZpModel *model;
  ZpError err;
  if (!text.of || !scenario || !def) fail("no memory");
  shape->write(n, &text);
  WRITE(&text, "liquid.model: none\nmesh.nodes: 21\noutput.errors: false\n");
  if (zp_scenario_parse(scenario, text.of, text.used, shape->name, &err) != ZP_OK ||
      zp_scenario_def(scenario, 0, def, &err) != ZP_OK || zp_model_create(def, &model, &err) != ZP_OK)
    fail(err.message);
  zp_def_destroy(def);
  zp_scenario_destroy(scenario);
  free(text.of);
  return model;
}

/* -- what is measured --------------------------------------------------------------------------------- */

static double most_memory(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return (double)usage.ru_maxrss;
}

typedef struct Cost {
  double steps, iterations; /* of the 0.1 s */
  double cpu;               /* s */
} Cost;

/* A run up to 0.1 s; the start, which makes the model's memory known to the machine, is not counted. */
static Cost step(const ZpModel *model) {
  ZpSim *sim;
  ZpError err;
  ZpRunInfo *info = zp_run_info_create();
  if (zp_sim_create(model, NULL, &sim, &err) != ZP_OK) fail(err.message);
  zp_sim_run(sim, 0.002, false, NULL, info);
  double before = zp_run_info_get(info, "steps"), iterated = zp_run_info_get(info, "iterations"), start = now();
  if (zp_sim_run(sim, 0.1, false, NULL, info) != ZP_REACHED_END) fail(zp_run_info_message(info));
  Cost cost = {zp_run_info_get(info, "steps") - before, zp_run_info_get(info, "iterations") - iterated, now() - start};
  zp_run_info_destroy(info);
  zp_sim_destroy(sim);
  return cost;
}

/* At rest: hanging, modes about it, and the first limit point on the way up. */
typedef struct Rest {
  ZpRest rest;
  ZpVibration vibration;
  ZpLimit limit;
  size_t subspace;
} Rest;

static void reserve(void *user, ZpArena *arena) {
  Rest *r = user;
  const size_t n = r->rest.statics.n;
  zp_vibration_reserve(&r->vibration, n, r->subspace, arena);
  zp_limit_reserve(&r->limit, zp_rest_save_size(&r->rest), n, arena);
}

static void hang(Rest *r, const ZpModel *model) {
  if (!zp_rest_open(&r->rest, model, reserve, r)) fail("no memory");
  zp_rest_hang(&r->rest, 0);
  if (!zp_statics_stable(&r->rest.statics)) fail("does not hang");
}

/* => the lowest frequency, Hz. */
static double vibrate(Rest *r, size_t modes) {
  ZpStatics *s = &r->rest.statics;
  ZpVibration *v = &r->vibration;
  v->K = &s->newton.K;
  v->weigh = zp_statics_weigh;
  v->self = s;
  zp_statics_masses(s, v->mass);
  zp_vibration_start(v);
  if (!zp_vibration_solve(v, modes)) fail("the modes have not converged");
  return sqrt(v->omega2[0]) / 6.283185307179586;
}

/* => V */
static double pull_in(Rest *r) {
  zp_quasistatic_start(&r->rest);
  if (zp_quasistatic_first(&r->rest, 10e3, &r->limit) != ZP_TRACK_FOLD) fail("no pull-in");
  return r->limit.value;
}

/* -- the command -------------------------------------------------------------------------------------- */

typedef struct AtRest {
  double hang, modes, pull_in; /* s of CPU time */
  double frequency, voltage;   /* Hz, V */
} AtRest;

static AtRest rest(const ZpModel *model, size_t modes, size_t subspace) {
  Rest r = {.subspace = subspace};
  AtRest cost;
  double start = now();
  hang(&r, model);
  cost.hang = now() - start;
  start = now();
  cost.frequency = vibrate(&r, modes);
  cost.modes = now() - start;
  start = now();
  cost.voltage = pull_in(&r);
  cost.pull_in = now() - start;
  zp_rest_close(&r.rest);
  return cost;
}

static double least(double a, double b) {
  return a < b ? a : b;
}

static void row(const Shape *shape, int n) {
  const int repeats = n < 64 ? 4 * REPEATS : REPEATS;
  double before = most_memory();
  ZpModel *model = model_of(shape, n);
  Cost run = step(model);
  AtRest at = rest(model, 1, 16);
  double memory = (most_memory() - before) / n;
  for (int k = 1; k < repeats; k++) {
    AtRest again = rest(model, 1, 16);
    run.cpu = least(run.cpu, step(model).cpu);
    at.hang = least(at.hang, again.hang);
    at.modes = least(at.modes, again.modes);
    at.pull_in = least(at.pull_in, again.pull_in);
  }
  const double per = 1e6 / n;
  printf("%-13s %5d %6.0f %6.2f %8.1f %8.1f %7.0f %7.0f %8.0f %6.0f\n", shape->name, n, run.steps,
         run.iterations / run.steps, run.cpu / run.steps * per, run.cpu / run.iterations * per, at.hang * per,
         at.modes * per, at.pull_in * per, memory);
  fflush(stdout);
  zp_model_destroy(model);
}

static void table(int most) {
  printf("%-13s %5s %6s %6s %8s %8s %7s %7s %8s %6s\n", "", "n", "steps", "it", "step", "iter.", "hang", "mode",
         "pull-in", "KiB");
  for (size_t k = 0; k < sizeof shapes / sizeof shapes[0]; k++)
    for (int n = 1; n <= most; n = 2 * n + 1)
      row(&shapes[k], n);
}

static void chain(int n) {
  ZpModel *model = model_of(&shapes[0], n);
  AtRest at = rest(model, 20, 24);
  printf("%d in series: hanging %.3f s, 20 modes %.3f s, the first pull-in %.3f s; %.6g Hz, %.6g V\n", n, at.hang,
         at.modes, at.pull_in, at.frequency, at.voltage);
  zp_model_destroy(model);
}

static void run(const char *name, int n) {
  size_t k = 0;
  while (strcmp(shapes[k].name, name) != 0)
    if (++k == sizeof shapes / sizeof shapes[0]) fail("no such shape");
  ZpModel *model = model_of(&shapes[k], n);
  Cost cost = step(model);
  printf("%.0f steps, %.0f iterations, %.4g s\n", cost.steps, cost.iterations, cost.cpu);
  zp_model_destroy(model);
}

int main(int argc, char **argv) {
  if (argc > 2 && strcmp(argv[1], "chain") == 0)
    chain(atoi(argv[2]));
  else if (argc > 3 && strcmp(argv[1], "run") == 0)
    run(argv[2], atoi(argv[3]));
  else
    table(argc > 1 ? atoi(argv[1]) : MOST);
  return EXIT_SUCCESS;
}
