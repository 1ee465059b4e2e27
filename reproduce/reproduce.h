/* Tables and figures of the paper beside ours: every published number, and the page that shows them. Part of the
 * command, not of the library. */
#ifndef ZP_REPRODUCE_REPRODUCE_H
#define ZP_REPRODUCE_REPRODUCE_H

#include <zipact/batch.h>

/* Quantities for which the paper gives numbers. */
typedef enum ZpQuantity {
  ZP_TABLE_1_SHEAR,        /* K_S, N/m */
  ZP_TABLE_1_STROKE,       /* stroke of the finite elements in Table I, mm */
  ZP_TABLE_1_STROKE_ERROR, /* mm */
  ZP_TABLE_1_RELATIVE,     /* % */
  ZP_TABLE_1_AREA,         /* mm2 */
  ZP_TABLE_2_STROKE,       /* mm */
  ZP_TABLE_2_REFERENCE,    /* stroke of the finite elements, mm */
  ZP_TABLE_2_STROKE_ERROR, /* mm */
  ZP_TABLE_2_RELATIVE,     /* % */
  ZP_TABLE_2_AREA,         /* mm2 */
  ZP_AXIAL_SPRING,         /* K_D, N/um */
  ZP_COST,                 /* cost of a simulated second, min */
  ZP_MEAN_STEP,            /* us */
  ZP_FACTOR,               /* factor between finite elements and plates */
  ZP_FACTOR_DEVIATION,     /* its standard deviation */
  ZP_SAVED_SHEAR,          /* K_S of the authors' saved states, N/m */
  ZP_RERUN_ZIP_6_KV,       /* zip time of the authors' program, run again, ms */
  ZP_RERUN_ZIP_10_KV
} ZpQuantity;

/* A published number. */
typedef struct ZpPublished {
  ZpQuantity quantity;
  int nodes;        /* N; 0 if it does not matter */
  double load;      /* g */
  const char *text; /* as printed */
  double value;     /* the same as a number */
} ZpPublished;

/* All of them; *count. */
const ZpPublished *zp_published_list(size_t *count);

/* The value of `quantity` at N = `nodes` and `load` (g); NAN if it is not published. */
double zp_published(ZpQuantity quantity, int nodes, double load);

/* Reproduce the paper: run its scenarios in `directory`/runs, compare, and write report.html, comparison.csv,
 * summary.json and plots/ there. `hooks` and `notice` (see zp_report_write) may be NULL. *outcome: ZP_CONVERGED,
 * ZP_INTERRUPTED with the page of the finished runs, or the first failure. `summary`, unless NULL, gets the content of
 * summary.json. */
ZpStatus zp_reproduce(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message), FILE *summary,
                      ZpOutcome *outcome, ZpError *err);

#endif
