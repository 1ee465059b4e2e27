/* What the files of this folder share: the runs behind the page, published numbers beside ours, the page. */
#ifndef ZP_REPRODUCE_PARTS_H
#define ZP_REPRODUCE_PARTS_H

#include <zipact/batch.h>

#include "io/drawing.h"
#include "reproduce/reproduce.h"

/* -- runs: scenarios of runs.def, run and reported like any other scenario --------------------------- */

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
  double breakdown;  /* V/m */
} ZpWhich;

/* The first result of a run with these values; NULL if there is none. */
const ZpResult *zp_runs_find(const ZpRuns *runs, ZpRunId id, ZpWhich which);

/* A scalar of that result; NAN if there is none. */
double zp_runs_get(const ZpRuns *runs, ZpRunId id, ZpWhich which, const char *scalar);

/* The Def of result `index` of a run. */
ZpActuatorDef zp_runs_def(const ZpRuns *runs, ZpRunId id, size_t index);

/* -- comparisons -------------------------------------------------------------------------------------- */

typedef struct ZpVerdictInfo {
  const char *word;  /* in files */
  bool judged;       /* determined by the tolerance; false: independent of the numbers */
  const char *title; /* text on the page, after the count */
} ZpVerdictInfo;

#define ZP_VERDICT(id, word, judged, title) id,
typedef enum ZpVerdict {
#include "reproduce/verdicts.def"
  ZP_VERDICT_COUNT
} ZpVerdict;
#undef ZP_VERDICT

extern const ZpVerdictInfo zp_verdicts[ZP_VERDICT_COUNT];

typedef struct ZpReason {
  ZpVerdict verdict; /* verdict on numbers that differ for this reason */
  const char *title, *section, *sentence;
} ZpReason;

#define ZP_REASON(id, verdict, title, section, sentence) id,
typedef enum ZpReasonId {
#include "reproduce/reasons.def"
  ZP_REASON_COUNT
} ZpReasonId;
#undef ZP_REASON

extern const ZpReason zp_reasons[ZP_REASON_COUNT];

#define ZP_SUBJECT(id, quantity, place, title, unit, source, reason, once) id,
typedef enum ZpSubjectId {
#include "reproduce/subjects.def"
  ZP_SUBJECT_COUNT
} ZpSubjectId;
#undef ZP_SUBJECT

/* A compared quantity: one table of the page. */
typedef struct ZpSubject {
  ZpQuantity quantity; /* published quantity */
  const char *place, *title, *unit, *source;
  ZpReasonId reason; /* possible reason of a difference */
  bool once;         /* independent of N, compared once for each load */
} ZpSubject;

extern const ZpSubject zp_subjects[ZP_SUBJECT_COUNT];

/* Our number agrees with the published one within this relative tolerance, or within the uncertainty of the printed
 * digits. */
#define ZP_AGREEMENT 0.005

/* One published number beside ours. */
typedef struct ZpComparison {
  const ZpSubject *subject;
  const ZpPublished *published;
  int nodes;         /* N; 0 if it does not matter */
  double ours;       /* in the unit of the published number; NAN: not run */
  double difference; /* ours / published - 1 */
  double tolerance; /* largest |ours - published| that counts as agreement, in the same unit; NAN if it is not judged */
  ZpVerdict verdict;
  const ZpReason *reason; /* that of its subject if it was run and does not agree; NULL: none is needed */
} ZpComparison;

/* All comparisons, subject after subject. */
typedef struct ZpComparisons {
  ZpComparison *item; /* [count] */
  size_t count;
  size_t of[ZP_VERDICT_COUNT]; /* number with each verdict */
} ZpComparisons;

/* (chain at rest, Def of the finite elements under the same load, their published stroke, m) => area between the chain
 * and the finite elements hung at that stroke, m2; NAN if there is none.
 *
 * The published curves are neither converged nor printed. The converged curve replaces them, with all weights scaled
 * such that it hangs at the published stroke. */
double zp_area_error(const ZpResult *chain, ZpActuatorDef elements, double stroke);

/* To be freed (item) whatever the status is. */
ZpStatus zp_compare(const ZpRuns *runs, ZpComparisons *comparisons, ZpError *err);

/* -- the page ----------------------------------------------------------------------------------------- */

/* Its content. */
typedef struct ZpPage {
  const char *directory; /* folder of the pictures */
  const ZpRuns *runs;
  const ZpComparisons *comparisons;
  double wall_time; /* s */
} ZpPage;

/* page.html, when this was built; the second has no name. */
extern const ZpTemplate zp_pages[];

/* report.html: page.html with numbers, tables and pictures where its marks are. It needs no other file. */
void zp_page_write(const ZpPage *page, FILE *file);

/* Draw figs. 6 to 8 in `directory`/plots; the other pictures belong to a single run and are in its folder. `hooks` are
 * called while gnuplot runs. */
ZpStatus zp_figures_draw(const char *directory, const ZpRuns *runs, const ZpHooks *hooks,
                         void (*notice)(const char *message), ZpError *err);

#endif
