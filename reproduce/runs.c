/* The runs behind the page. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/fail.h"
#include "def/def.h"
#include "io/file.h"
#include "reproduce/parts.h"
#include "study/result.h"

typedef struct Spec {
  const char *name;
  int weight;
  const char *scenario;
} Spec;

#define ZP_RUN(id, name, weight, scenario) {name, weight, scenario},
static const Spec spec[ZP_RUN_COUNT] = {
#include "reproduce/runs.def"
};
#undef ZP_RUN

const char *zp_run_name(ZpRunId id) {
  return spec[id].name;
}

/* -- scenarios ------------------------------------------------------------------------------------- */

/* The stroke for the calibration of Table I, as a file for the study. */
static ZpStatus write_published_stroke(const char *folder, double load, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, folder, "published.csv", err);
  if (status != ZP_OK) return status;
  fprintf(out.file, "# The finite-element stroke of Table I of the paper.\nload_g,stroke_mm\n%g,%g\n", load,
          zp_published(ZP_TABLE_1_STROKE, 21, load));
  return zp_atomic_commit(&out, err);
}

static ZpStatus calibrate_at(ZpScenario *scenario, const char *folder, double load, ZpError *err) {
  char *assignment = NULL;
  ZpStatus status = write_published_stroke(folder, load, err);
  if (status != ZP_OK) return status;
  if (asprintf(&assignment, "data.file=%s/published.csv", folder) < 0) return zp_fail_memory(err);
  status = zp_scenario_set(scenario, assignment, err);
  free(assignment);
  return status;
}

/* The chain with the K_S in the saved states of the authors. */
static ZpStatus saved_chain(ZpScenario *scenario, int nodes, ZpError *err) {
  char text[80];
  snprintf(text, sizeof text, "mesh.nodes=%d", nodes);
  ZpStatus status = zp_scenario_set(scenario, text, err);
  snprintf(text, sizeof text, "mass_spring.shear_coefficient=%.17g", zp_published(ZP_SAVED_SHEAR, nodes, 61));
  return status == ZP_OK ? zp_scenario_set(scenario, text, err) : status;
}

static ZpStatus add_published(ZpRunId id, ZpScenario *scenario, const char *folder, ZpError *err) {
  static const double load[] = {0, 8, 61};  /* g, of the runs of Table I */
  static const int nodes[] = {21, 61, 130}; /* of those of Table II */
  if (id >= ZP_RUN_TABLE_1_0_G && id <= ZP_RUN_TABLE_1_61_G)
    return calibrate_at(scenario, folder, load[id - ZP_RUN_TABLE_1_0_G], err);
  if (id >= ZP_RUN_TABLE_2_21 && id <= ZP_RUN_TABLE_2_130)
    return saved_chain(scenario, nodes[id - ZP_RUN_TABLE_2_21], err);
  return ZP_OK;
}

/* -- running --------------------------------------------------------------------------------------- */

/* Hooks of a run within those of the whole. */
typedef struct Inner {
  const ZpHooks *outer;
  const char *name;
  double from, span; /* progress of the whole, 0 .. 1 */
} Inner;

static bool on_progress(void *user, const char *stage, double fraction) {
  const Inner *inner = user;
  (void)stage;
  if (!inner->outer || !inner->outer->progress) return false;
  return inner->outer->progress(inner->outer->user, inner->name, inner->from + inner->span * fraction);
}

static double read_clock(void *user) {
  const Inner *inner = user;
  return inner->outer && inner->outer->clock ? inner->outer->clock(inner->outer->user) : (double)NAN;
}

/* Other programs may use this machine, too, so the cost of a run is its CPU time. */
static double read_processor_clock(void *user) {
  struct timespec now;
  (void)user;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Share of the runs before `id` in the whole. */
static double share_before(unsigned id) {
  int before = 0, all = 0;
  for (unsigned i = 0; i < ZP_RUN_COUNT; i++) {
    before += i < id ? spec[i].weight : 0;
    all += spec[i].weight;
  }
  return (double)before / all;
}

static ZpStatus run_batch(ZpRunId id, ZpRun *run, const ZpHooks *outer, double *wall_time, ZpError *err) {
  ZpStatus status = zp_batch_create(run->scenario, &run->batch, err);
  Inner inner = {outer, spec[id].name, 0, (share_before(id + 1) - share_before(id)) / (double)run->batch.count};
  ZpHooks hooks = {
      .user = &inner, .progress = on_progress, .clock = id == ZP_RUN_COST ? read_processor_clock : read_clock};
  double start = read_clock(&inner);
  while (status == ZP_OK && zp_batch_open(&run->batch)) {
    inner.from = share_before(id) + inner.span * (double)run->batch.done;
    status = zp_batch_next(&run->batch, &hooks, err);
    if (on_progress(&inner, "", 1)) run->batch.interrupted = true;
  }
  *wall_time = read_clock(&inner) - start;
  return status;
}

/* Run and report in the open folder `where`. */
static ZpStatus run_and_report(ZpRunId id, const char *where, const ZpFolder *folder, const ZpHooks *hooks,
                               void (*notice)(const char *message), ZpRun *run, ZpError *err) {
  double wall_time;
  ZpStatus status = zp_scenario_parse(run->scenario, spec[id].scenario, strlen(spec[id].scenario), spec[id].name, err);
  if (status == ZP_OK) status = add_published(id, run->scenario, where, err);
  if (status == ZP_OK) status = run_batch(id, run, hooks, &wall_time, err);
  if (status != ZP_OK) return status;
  Inner done = {hooks, spec[id].name, share_before(id + 1), 0};
  const ZpHooks drawing = {.user = &done, .progress = on_progress};
  const ZpReport report = {.directory = where,
                           .scenario = run->scenario,
                           .result = run->batch.result,
                           .count = run->batch.done,
                           .wall_time = wall_time,
                           .folder = folder,
                           .hooks = &drawing};
  return zp_report_write(&report, notice, err);
}

static ZpStatus make_run(ZpRunId id, const char *where, const ZpHooks *hooks, void (*notice)(const char *message),
                         ZpRun *run, ZpError *err) {
  ZpFolder *folder;
  run->scenario = zp_scenario_create();
  if (!run->scenario) return zp_fail_memory(err);
  ZpStatus status = zp_folder_open(where, &folder, err);
  if (status != ZP_OK) return status;
  status = run_and_report(id, where, folder, hooks, notice, run, err);
  zp_folder_close(folder);
  return status;
}

static ZpOutcome outcome_of(const ZpBatch *batch) {
  for (size_t i = 0; i < batch->done; i++)
    if (!zp_outcome_good(batch->result[i]->outcome)) return batch->result[i]->outcome;
  return batch->interrupted ? ZP_INTERRUPTED : ZP_CONVERGED;
}

ZpStatus zp_runs_make(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message), ZpRuns *runs,
                      ZpError *err) {
  ZpStatus status = ZP_OK;
  *runs = (ZpRuns){.outcome = ZP_CONVERGED};
  for (int id = 0; id < ZP_RUN_COUNT && status == ZP_OK && runs->outcome != ZP_INTERRUPTED; id++) {
    ZpRun *run = &runs->run[id];
    char *folder = NULL;
    if (asprintf(&folder, "%s/runs/%s", directory, spec[id].name) < 0) return zp_fail_memory(err);
    status = make_run((ZpRunId)id, folder, hooks, notice, run, err);
    free(folder);
    ZpOutcome outcome = outcome_of(&run->batch);
    if (runs->outcome == ZP_CONVERGED || outcome == ZP_INTERRUPTED) runs->outcome = outcome;
  }
  return status;
}

void zp_runs_free(ZpRuns *runs) {
  for (int id = 0; id < ZP_RUN_COUNT; id++) {
    zp_batch_free(&runs->run[id].batch);
    zp_scenario_destroy(runs->run[id].scenario);
  }
}

/* -- looking up ------------------------------------------------------------------------------------ */

ZpActuatorDef zp_runs_def(const ZpRuns *runs, ZpRunId id, size_t index) {
  ZpActuatorDef def = zp_actuator_def_default();
  zp_scenario_def(runs->run[id].scenario, index, &def, NULL); /* checked before the run */
  return def;
}

/* Both values come from the same decimals, but by different arithmetic. */
static bool same(double value, double wanted) {
  return fabs(value - wanted) <= 1e-9 * fabs(wanted);
}

static bool fits(const ZpActuatorDef *def, ZpWhich which) {
  return (isnan(which.load) || same(1e3 * def->load.mass, which.load)) &&
         (which.nodes == 0 || def->mesh.nodes == which.nodes) &&
         (which.voltage == 0 || same(def->drive.voltage, which.voltage)) &&
         (which.separation == 0 || same(def->isometric.separation, which.separation)) &&
         (which.breakdown == 0 || same(def->medium.breakdown_field, which.breakdown));
}

const ZpResult *zp_runs_find(const ZpRuns *runs, ZpRunId id, ZpWhich which) {
  const ZpBatch *batch = &runs->run[id].batch;
  for (size_t i = 0; i < batch->done; i++) {
    ZpActuatorDef def = zp_runs_def(runs, id, i);
    if (fits(&def, which)) return batch->result[i];
  }
  return NULL;
}

double zp_runs_get(const ZpRuns *runs, ZpRunId id, ZpWhich which, const char *scalar) {
  const ZpResult *result = zp_runs_find(runs, id, which);
  return result ? zp_result_get(result, scalar) : (double)NAN;
}
