/* What one explicit step costs: ours, and a plain kernel of the mechanics alone. */
#include <math.h>
#include <stdlib.h>

#include "bench.h"
#include "motion.h"
#include "plain_kernel.h"

enum { REPEATS = 5 };

/* What the paper says of its MATLAB code on one thread of an i7-8700: section III. */
typedef struct PaperCost {
  int nodes;
  double mean_step;   /* s */
  double cpu_seconds; /* per simulated second */
} PaperCost;
static const PaperCost paper[] = {{21, 5.04e-6, 386}, {61, 0.99e-6, 1022}, {130, 0.49e-6, 2596}};

static const PaperCost *cost_of(int nodes) {
  size_t k = 0;
  while (paper[k].nodes != nodes)
    k++;
  return &paper[k];
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(double *values) {
  qsort(values, REPEATS, sizeof *values, compare);
  return values[REPEATS / 2];
}

/* One run of `span` simulated seconds from equilibrium => seconds per step and mean step. */
static ZpStatus time_run(const ZpActuatorDef *def, double span, double *per_step, double *mean_step, ZpError *err) {
  ZpModel *model;
  ZpSim *sim = NULL;
  ZpStatus status = zp_model_create(def, &model, err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, err);
  if (status == ZP_OK) {
    double samples[REPEATS] = {0};
    *mean_step = NAN;
    for (int k = 0; k < REPEATS; k++) {
      ZpRunInfo info;
      double start = motion_clock();
      zp_sim_run(sim, span * (k + 1), false, NULL, &info);
      samples[k] = (motion_clock() - start) / (double)info.steps;
      *mean_step = info.simulated_time / (double)info.steps;
    }
    *per_step = median(samples);
  }
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return status;
}

/* The whole step of preset paper-code with the field found anew in every step. */
ZpStatus bench_paper_code(int nodes, Row *row, ZpError *err) {
  const PaperCost *cost = cost_of(nodes);
  ZpAssignment list[4];
  size_t count = 0;
  bench_set(list, &count, "preset", ZP_PRESET_PAPER_CODE);
  bench_set(list, &count, "mesh.nodes", nodes);
  bench_set(list, &count, "electro.refresh_period", 0);
  ZpActuatorDef def;
  ZpStatus status = zp_def_resolve(&def, list, count, err);
  double per_step = NAN, own_step, start = motion_clock();
  if (status == ZP_OK) status = time_run(&def, 4e-3, &per_step, &own_step, err);
  *row = (Row){.name = "explicit paper-code",
               .nodes = nodes,
               .ns_per_node_step = 1e9 * per_step / (2 * nodes),
               .steps = 1 / cost->mean_step,
               .seconds = per_step / cost->mean_step,
               .cpu = motion_clock() - start,
               .paper_ratio = cost->cpu_seconds / (per_step / cost->mean_step),
               .error = NAN};
  return status;
}

/* The default actuator at its own steps. */
ZpStatus bench_explicit(int nodes, Row *row, ZpError *err) {
  ZpActuatorDef def;
  double per_step = NAN, mean_step = NAN, start = motion_clock();
  ZpStatus status = motion_zip(nodes, false, &def, err);
  if (status == ZP_OK) status = time_run(&def, 4e-3, &per_step, &mean_step, err);
  *row = (Row){.name = "explicit default actuator",
               .nodes = nodes,
               .ns_per_node_step = 1e9 * per_step / (2 * nodes),
               .steps = 1 / mean_step,
               .seconds = per_step / mean_step,
               .cpu = motion_clock() - start,
               .paper_ratio = NAN,
               .error = NAN};
  return status;
}

ZpStatus bench_plain(int nodes, Row *row, ZpError *err) {
  static const long node_steps = 6000000; /* below 0.1 s */
  const PaperCost *cost = cost_of(nodes);
  long steps = node_steps / (2L * nodes);
  double l = 0.045 / (nodes - 1), samples[REPEATS], start = motion_clock();
  PlainKernel kernel = {l, 1e3, 10, 1e-5, 9.81, 0.1, 1e-6};
  for (int k = 0; k < REPEATS; k++) {
    double begin = motion_clock();
    if (isnan(plain_kernel_run(&kernel, nodes, steps))) {
      *err = (ZpError){ZP_MACHINE, "no memory"};
      return ZP_MACHINE;
    }
    samples[k] = (motion_clock() - begin) / (double)steps;
  }
  double per_step = median(samples);
  *row = (Row){.name = "plain mechanics kernel",
               .nodes = nodes,
               .ns_per_node_step = 1e9 * per_step / (2 * nodes),
               .steps = 1 / cost->mean_step,
               .seconds = per_step / cost->mean_step,
               .cpu = motion_clock() - start,
               .paper_ratio = cost->cpu_seconds / (per_step / cost->mean_step),
               .error = NAN};
  return ZP_OK;
}
