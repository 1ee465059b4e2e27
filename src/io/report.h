/* What the writers of result files share: how a report is read. */
#ifndef ZP_IO_REPORT_H
#define ZP_IO_REPORT_H

#include <stdbool.h>

#include <zipact/io.h>

/* Room for the column name of a key: "drive.voltage_V". */
#define ZP_KEY_COLUMN_SIZE 96

/* The columns that a sweep has besides its list keys: every scalar that some run has, in the order of
 * the summary. Values in it mean nothing. */
typedef struct ZpScalarNames {
  ZpScalar *item;
  size_t count;
} ZpScalarNames;

/* True if the scenario stands for a table of runs, not for one run. */
bool zp_report_is_sweep(const ZpReport *report);

/* The word of the study: "actuate". */
const char *zp_report_study(const ZpReport *report);

/* Result `index` of the report, below report->count; valid until the next call. */
const ZpResult *zp_report_result(const ZpReport *report, size_t index);

/* The only run of a report that is no sweep; NULL if it was interrupted before it began. */
const ZpResult *zp_report_single(const ZpReport *report);

/* The scalars of all runs; with `timing`, those that follow from wall time, too. item is the caller's to
 * free. False if there is no memory. */
bool zp_report_scalars(const ZpReport *report, bool timing, ZpScalarNames *names);

/* Scalar names->item[index] of a result; NAN if it has none of this name. */
double zp_scalar_at(const ZpResult *result, const ZpScalarNames *names, size_t index);

/* Numbers in the series, shapes and field of a result. */
size_t zp_result_numbers(const ZpResult *result);

/* (runs, numbers of all their results) => bytes of memory that writing their report takes, rather too many. */
size_t zp_report_room(size_t runs, size_t numbers);

/* (key index) => its column name, with the unit as interface names have it: "insulator.density_kg_per_m3". */
void zp_key_column(int key, char *text, size_t size);

/* The word of a choice, or of true and false, that key `key` takes at `value`; NULL if it is a number. */
const char *zp_key_word(int key, double value);

/* scenario.yaml as text, to be freed by the caller. */
ZpStatus zp_scenario_text(const ZpReport *report, char **text, ZpError *err);

#endif
