/* Cost of a case of a sweep, including everything except files and journal. */
#include <math.h>
#include <string.h>

#include <zipact/batch.h>

#include "bench.h"
#include "cli.h"
#include "motion.h"

/* CPU time per case of a scenario, the best of some repetitions. */
static ZpStatus time_cases(const ZpScenario *scenario, double *best, ZpError *err) {
  enum { TRIES = 3 };
  ZpStatus status = ZP_OK;
  *best = INFINITY;
  for (int k = 0; k < TRIES && status == ZP_OK; k++) {
    ZpBatch batch;
    status = zp_batch_create(scenario, &batch, err);
    const double start = motion_clock();
    while (status == ZP_OK && zp_batch_open(&batch))
      status = zp_batch_next(&batch, NULL, err);
    if (status == ZP_OK) *best = fmin(*best, (motion_clock() - start) / (double)batch.count);
    zp_batch_free(&batch);
  }
  return status;
}

static ZpStatus bench_cases(const char *name, const char *sweep, int nodes, Row *row, ZpError *err) {
  char text[256];
  double best = NAN;
  ZpScenario *scenario = zp_scenario_create();
  *err = (ZpError){ZP_MACHINE, "no memory"};
  if (!scenario) return ZP_MACHINE;
  snprintf(text, sizeof text, "%s\nmesh.nodes: %d\noutput.errors: false\n", sweep, nodes);
  ZpStatus status = zp_scenario_parse(scenario, text, strlen(text), "bench", err);
  if (status == ZP_OK) status = time_cases(scenario, &best, err);
  zp_scenario_destroy(scenario);
  *row = (Row){name, nodes, NAN, NAN, NAN, best, NAN, NAN};
  return status;
}

/* Stationary: loads and thicknesses of a design chart. */
ZpStatus bench_rests(int nodes, Row *row, ZpError *err) {
  return bench_cases("case of stationary",
                     "study: stationary\nload.mass: {from: 2 g, to: 40 g, count: 40}\n"
                     "ribbon.thickness: {from: 40 um, to: 100 um, count: 10}",
                     nodes, row, err);
}

/* Limits: one case in 8 starts from scratch, the others from the case before; small sweeps have short chunks. */
ZpStatus bench_limits(int nodes, Row *row, ZpError *err) {
  return bench_cases("case of limits",
                     "study: limits\nliquid.model: none\nload.mass: {from: 2 g, to: 12 g, count: 32}\n"
                     "ribbon.thickness: [50 um, 60 um]",
                     nodes, row, err);
}

/* Zips from the hanging equilibrium, without liquid, zip times to 0.1 %. */
ZpStatus bench_zips(int nodes, Row *row, ZpError *err) {
  return bench_cases("case of actuate, dry",
                     "study: actuate\nliquid.model: none\nsolver.tolerance: 1e-3\n"
                     "drive.voltage: {from: 7 kV, to: 10 kV, count: 6}",
                     nodes, row, err);
}
