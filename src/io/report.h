/* Common functions of the writers of result files: reading a report. */
#ifndef ZP_IO_REPORT_H
#define ZP_IO_REPORT_H

#include <stdbool.h>

#include <zipact/io.h>

/* Size of the column name of a key: "drive.voltage_V". */
#define ZP_KEY_COLUMN_SIZE 96

/* The columns of a sweep besides its swept keys: every scalar of any run, in the order of the summary. Their values
 * have no meaning. */
typedef struct ZpScalarNames {
  ZpScalar *item;
  size_t count;
} ZpScalarNames;

/* Is the result a table of runs, not a single run? */
bool zp_report_is_sweep(const ZpReport *report);

/* The word of the study: "actuate". */
const char *zp_report_study(const ZpReport *report);

/* Result `index` of the report, below report->count; valid until the next call. */
const ZpResult *zp_report_result(const ZpReport *report, size_t index);

/* The run of a report without a sweep; NULL if it was interrupted before it started. */
const ZpResult *zp_report_single(const ZpReport *report);

/* The scalars of all runs; with `timing` including those that depend on wall time. The caller frees item. False if
 * there is no memory. */
bool zp_report_scalars(const ZpReport *report, bool timing, ZpScalarNames *names);

/* Scalar names->item[index] of a result; NAN if it does not have it. */
double zp_scalar_at(const ZpResult *result, const ZpScalarNames *names, size_t index);

/* Number of values in the series, shapes and field of a result. */
size_t zp_result_numbers(const ZpResult *result);

/* (runs, numbers of all their results) => upper estimate of the memory for writing their report, bytes. */
size_t zp_report_room(size_t runs, size_t numbers);

/* (key index) => its column name, with the unit in the form of interface names: "insulator.density_kg_per_m3". */
void zp_key_column(int key, char *text, size_t size);

/* The word of a choice key, or of true and false, for key `key` at `value`; NULL if it is a number. */
const char *zp_key_word(int key, double value);

/* scenario.yaml as text, to be freed by the caller. */
ZpStatus zp_scenario_text(const ZpReport *report, char **text, ZpError *err);

#endif
