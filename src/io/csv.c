/* table.csv: the time series of one run, or one row per run of a sweep.
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

ZpStatus zp_csv_write(const ZpReport *report, ZpError *err) {
  const ZpResult *single = zp_report_single(report);
  bool sweep = zp_report_is_sweep(report);
  if (!sweep && (!single || !single->series)) return zp_remove_file(report->directory, "table.csv", err);
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, "table.csv", err);
  if (status != ZP_OK) return status;
  return zp_atomic_finish(&out, write_table(out.file, report, sweep ? NULL : single->series, err), err);
}
