/* The runs behind the page: scenarios of runs.def, run and reported like any other scenario. */
#ifndef ZP_REPRODUCE_RUNS_H
#define ZP_REPRODUCE_RUNS_H

#include <zipact/batch.h>

#define ZP_RUN(id, name, weight, scenario) id,
typedef enum ZpRunId {
#include "reproduce/runs.def"
  ZP_RUN_COUNT
} ZpRunId;
#undef ZP_RUN

typedef struct ZpRun {
  ZpScenario *scenario;
  ZpBatch batch; /* empty if it was not run */
} ZpRun;

typedef struct ZpRuns {
  ZpRun run[ZP_RUN_COUNT];
  ZpOutcome outcome; /* ZP_CONVERGED, ZP_INTERRUPTED, or the first failure */
} ZpRuns;

/* The folder of a run in the report: "table-1-0g". */
const char *zp_run_name(ZpRunId id);

/* Run all, each with its own report in `directory`/runs/NAME, until one is interrupted. To be freed whatever the status
 * is. */
ZpStatus zp_runs_make(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message), ZpRuns *runs,
                      ZpError *err);
void zp_runs_free(ZpRuns *runs);

/* Selects a case of a sweep; a value of 0 (the load: NAN) is ignored. */
typedef struct ZpWhich {
  double load; /* g */
  int nodes;
  double voltage;    /* V */
  double separation; /* m */
} ZpWhich;

/* The first result of a run with these values; NULL if there is none. */
const ZpResult *zp_runs_find(const ZpRuns *runs, ZpRunId id, ZpWhich which);

/* A scalar of that result; NAN if there is none. */
double zp_runs_get(const ZpRuns *runs, ZpRunId id, ZpWhich which, const char *scalar);

/* The Def of result `index` of a run. */
ZpActuatorDef zp_runs_def(const ZpRuns *runs, ZpRunId id, size_t index);

#endif
