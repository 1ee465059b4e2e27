/* Common functions of the writers of result files: reading a report. */
#ifndef ZP_IO_REPORT_H
#define ZP_IO_REPORT_H

#include <stdbool.h>

#include <zipact/io.h>

/* Size of the column name of a key: "drive.voltage_V". */
#define ZP_KEY_COLUMN_SIZE 144

/* Is the result a table of runs, not a single run? */
bool zp_report_is_sweep(const ZpReport *report);

/* The word of the study: "actuate". */
const char *zp_report_study(const ZpReport *report);

/* Result `index` of the report, below report->count; valid until the next call. */
const ZpResult *zp_report_result(const ZpReport *report, size_t index);

/* The run of a report without a sweep; NULL if it was interrupted before it started. */
const ZpResult *zp_report_single(const ZpReport *report);

/* A column of the table with a row per run. */
typedef struct ZpCaseColumn {
  char name[ZP_KEY_COLUMN_SIZE];
  const char *unit, *help; /* help NULL: none */
} ZpCaseColumn;

/* A table of results. Of all runs of a report, with a row per run: first the swept keys, where a choice is the number
 * of its word, then the scalars of all runs, in the order of the summary, except those that depend on wall time. Or the
 * series of one run. */
typedef struct ZpCases {
  const ZpReport *report;
  const ZpTable *series; /* NULL: of all runs */
  size_t keys, columns, rows;
  ZpCaseColumn *column; /* [columns] */
  double *value;        /* [columns] of the row that was read last */
} ZpCases;

/* `series`: of one run, NULL for all runs. False if there is no memory. To be closed in every case. */
bool zp_cases_open(const ZpReport *report, const ZpTable *series, ZpCases *cases);
void zp_cases_close(ZpCases *cases);

/* Read row `row`; NAN for a number that the run does not have. => its result, valid until the next call; NULL of a
 * series. */
const ZpResult *zp_cases_read(const ZpCases *cases, size_t row);

/* The numbers of a shape: of every node of each ribbon, or of every station. */
typedef struct ZpShapeArray {
  const char *name, *unit, *help;
  bool of_nodes;
  size_t offset; /* of its pointer in a ZpShape */
} ZpShapeArray;

extern const ZpShapeArray zp_shape_arrays[]; /* the last has no name */

/* NULL if the shape does not have it. */
const double *zp_shape_array(const ZpShape *shape, const ZpShapeArray *array);

/* Number of values in the series, shapes and field of a result. */
size_t zp_result_numbers(const ZpResult *result);

/* (runs, numbers of all their results) => upper estimate of the memory for writing their report, bytes. */
size_t zp_report_room(size_t runs, size_t numbers);

/* (key index) => its column name, with the names of members and the like that a scenario (may be NULL) has, and with
 * the unit in the form of interface names: "insulator.density_kg_per_m3". */
void zp_key_column(const ZpScenario *scenario, int key, char *text, size_t size);

/* The word of a choice key, or of true and false, for key `key` at `value`; NULL if it is a number. */
const char *zp_key_word(int key, double value);

/* scenario.yaml as text, to be freed by the caller; NULL on failure. */
ZpStatus zp_scenario_text(const ZpScenario *scenario, char **text, size_t *size, ZpError *err);

/* The kind of results of a study, from studies.def: it determines pictures and words in files. */
typedef enum ZpShows {
  ZP_SHOWS_motion,      /* rows and shapes over time */
  ZP_SHOWS_branch,      /* equilibria along the voltage */
  ZP_SHOWS_held_branch, /* the same with a held platform: a force instead of a load */
  ZP_SHOWS_shape,       /* one shape at rest */
  ZP_SHOWS_modes,       /* the shape at rest, then one shape per mode */
  ZP_SHOWS_field,       /* forces along one shape, and the field around it */
  ZP_SHOWS_fit,         /* measured and fitted values */
  ZP_SHOWS_limits,      /* single states, each of them a limit */
  ZP_SHOWS_plan         /* measurements to make, in order */
} ZpShows;

ZpShows zp_study_shows(ZpStudy study);

/* Its kind as a word: "held_branch". */
const char *zp_study_kind(ZpStudy study);

/* -- writers ------------------------------------------------------------------------------------------ */

/* The writers. Each replaces its own files in report->directory and removes those of an earlier report that this one
 * does not have. */
ZpStatus zp_csv_write(const ZpReport *report, ZpError *err);
ZpStatus zp_hdf5_write(const ZpReport *report, ZpError *err);
ZpStatus zp_vtk_write(const ZpReport *report, ZpError *err);
ZpStatus zp_checkpoint_report(const ZpReport *report, ZpError *err);
ZpStatus zp_fitted_report(const ZpReport *report, ZpError *err);

/* Pictures: first the pictures of an earlier report are removed, and scripts and data of this one are written. When all
 * numbers are on the disk, gnuplot draws. A notice reports pictures that cannot be drawn. */
ZpStatus zp_plots_prepare(const ZpReport *report, ZpError *err);
void zp_plots_write(const ZpReport *report, void (*notice)(const char *message));

#endif
