/* table.csv: the time series of one run, or one row per run of a sweep; beside it the further tables of one run.
 *
 * No field needs quotes: names and outcomes have no commas. A value that does not exist is an empty
 * cell. */
#include <math.h>

#include "base/fail.h"
#include "base/table.h"
#include "io/file.h"
#include "io/number.h"
#include "io/report.h"
#include "study/result.h"

/* A row of names, or of numbers if there are any. In a table of runs, the outcome is between the keys and the numbers.
 */
static void write_row(FILE *file, const ZpCases *cases, const double *value, const char *outcome) {
  char text[ZP_NUMBER_SIZE];
  for (size_t i = 0; i < cases->columns || (!cases->series && i == cases->keys); i++) {
    if (i) fputc(',', file);
    if (!cases->series && i == cases->keys) fprintf(file, "%s%s", outcome, i < cases->columns ? "," : "");
    if (i == cases->columns) break;
    if (!value) fputs(cases->column[i].name, file);
    if (!value || isnan(value[i])) continue;
    zp_number_print(value[i], text, sizeof text);
    fputs(text, file);
  }
  fputc('\n', file);
}

static ZpStatus write_table(FILE *file, const ZpReport *report, const ZpTable *series, ZpError *err) {
  ZpCases cases;
  const bool open = zp_cases_open(report, series, &cases);
  if (open) write_row(file, &cases, NULL, "outcome");
  for (size_t row = 0; open && row < cases.rows; row++) {
    const ZpResult *result = zp_cases_read(&cases, row);
    write_row(file, &cases, cases.value, result ? zp_outcome_name(result->outcome) : NULL);
  }
  zp_cases_close(&cases);
  return open ? ZP_OK : zp_fail_memory(err);
}

/* `has`: there is such a file, of `series` or, if that is NULL, of all runs. */
static ZpStatus replace(const ZpReport *report, const char *name, bool has, const ZpTable *series, ZpError *err) {
  ZpAtomic out;
  if (!has) return zp_remove_file(report->directory, name, err);
  ZpStatus status = zp_atomic_open(&out, report->directory, name, err);
  return status == ZP_OK ? zp_atomic_finish(&out, write_table(out.file, report, series, err), err) : status;
}

ZpStatus zp_csv_write(const ZpReport *report, ZpError *err) {
  const bool sweep = zp_report_is_sweep(report);
  const ZpResult *single = sweep ? NULL : zp_report_single(report);
  const ZpTable *series = single ? single->series : NULL;
  ZpStatus status = replace(report, "table.csv", sweep || series, series, err);
  for (int k = 0; k < ZP_FURTHER && status == ZP_OK; k++) {
    const ZpTable *further = single ? single->further[k] : NULL;
    char name[32];
    snprintf(name, sizeof name, "%s.csv", zp_further_name[k]);
    status = replace(report, name, further != NULL, further, err);
  }
  return status;
}
