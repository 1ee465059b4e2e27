/* Cost of an explicit step: of the library, and of a plain kernel of the mechanics alone. */
#include <math.h>
#include <stdlib.h>

#include "bench.h"
#include "motion.h"
#include "plain_kernel.h"
#include "reproduce/reproduce.h"

enum { REPEATS = 5 };

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

/* (CPU seconds per step, simulated seconds per step, start of the measurement) */
static Row row_of(const char *name, int nodes, double per_step, double step, double start) {
  return (Row){.name = name,
               .nodes = nodes,
               .ns_per_node_step = 1e9 * per_step / (2 * nodes),
               .steps = 1 / step,
               .seconds = per_step / step,
               .cpu = motion_clock() - start,
               .paper_ratio = NAN,
               .error = NAN};
}

/* The same with the mean step of the paper, for comparison with its cost, which is that of MATLAB code on one thread of
 * an i7-8700. */
static Row row_beside_paper(const char *name, int nodes, double per_step, double start) {
  Row row = row_of(name, nodes, per_step, 1e-6 * zp_published(ZP_MEAN_STEP, nodes, 0), start);
  row.paper_ratio = 60 * zp_published(ZP_COST, nodes, 0) / row.seconds;
  return row;
}

/* A whole step of preset paper-code, with the electric force computed in every step. */
ZpStatus bench_paper_code(int nodes, Row *row, ZpError *err) {
  ZpAssignment list[4];
  size_t count = 0;
  bench_set(list, &count, "preset", ZP_PRESET_PAPER_CODE);
  bench_set(list, &count, "mesh.nodes", nodes);
  bench_set(list, &count, "electro.refresh_period", 0);
  ZpActuatorDef def;
  ZpStatus status = zp_def_resolve(&def, list, count, err);
  double per_step = NAN, own_step, start = motion_clock();
  if (status == ZP_OK) status = time_run(&def, 4e-3, &per_step, &own_step, err);
  *row = row_beside_paper("explicit paper-code", nodes, per_step, start);
  return status;
}

/* The default actuator with its own step size. */
ZpStatus bench_explicit(int nodes, Row *row, ZpError *err) {
  ZpActuatorDef def;
  double per_step = NAN, mean_step = NAN, start = motion_clock();
  ZpStatus status = motion_zip(nodes, false, &def, err);
  if (status == ZP_OK) status = time_run(&def, 4e-3, &per_step, &mean_step, err);
  *row = row_of("explicit default actuator", nodes, per_step, mean_step, start);
  return status;
}

ZpStatus bench_plain(int nodes, Row *row, ZpError *err) {
  static const long node_steps = 6000000; /* below 0.1 s */
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
  *row = row_beside_paper("plain mechanics kernel", nodes, median(samples), start);
  return ZP_OK;
}
