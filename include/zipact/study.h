/* A study: a Def goes in, numbers, a table and shapes come out. */
#ifndef ZIPACT_STUDY_H
#define ZIPACT_STUDY_H

#include <zipact/sim.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One number of a summary. */
typedef struct ZpScalar {
  const char *name; /* "zip_time_s" */
  const char *unit; /* "s"; "1" for a pure number; "count" for a whole number */
  double value;     /* NAN where it does not exist (null in JSON) */
  bool timing;      /* follows from wall time: differs from run to run */
} ZpScalar;

#define ZP_MAX_SCALARS  64
#define ZP_MAX_WARNINGS 8

/* What a study found. */
typedef struct ZpResult {
  ZpStudy study;
  ZpOutcome outcome;
  char message[256];                  /* one sentence on how it ended */
  char warning[ZP_MAX_WARNINGS][256]; /* sentences on limits of validity that were met */
  size_t warnings;
  ZpScalar scalar[ZP_MAX_SCALARS]; /* in the order of the summary */
  size_t scalars;
  ZpTable *series;  /* the study's table; NULL if it has none */
  ZpShapes *shapes; /* NULL if it has none */
} ZpResult;

/* Run def->study. On ZP_OK *result is new and the caller's, whatever its outcome; else it is NULL and
 * `err` says why. `hooks` may be NULL. */
ZpStatus zp_study_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result, ZpError *err);

/* The same, study actuate driven by the rows of `table` (NULL: none), as zp_model_create_driven. */
ZpStatus zp_study_run_driven(const ZpActuatorDef *def, const ZpDriveTable *table, const ZpHooks *hooks,
                             ZpResult **result, ZpError *err);

/* Free a result; NULL is allowed. */
void zp_result_destroy(ZpResult *result);

/* The scalar called `name`, NAN if there is none. */
double zp_result_get(const ZpResult *result, const char *name);

#ifdef __cplusplus
}
#endif

#endif
