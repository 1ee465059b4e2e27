/* table.csv: the time series of one run, or one row per run of a sweep.
 *
 * No field needs quotes: names and outcomes have no commas. A value that does not exist is an empty
 * cell. */
#include <math.h>

#include "base/fail.h"
#include "base/table.h"
#include "io/atomic.h"
#include "io/number.h"
#include "io/report.h"
#include "io/writers.h"
#include "study/result.h"

static void put_number(FILE *file, double value) {
  char text[ZP_NUMBER_SIZE];
  if (isnan(value)) return;
  zp_number_print(value, text, sizeof text);
  fputs(text, file);
}

static void write_series(FILE *file, const ZpTable *table) {
  for (size_t i = 0; i < table->columns; i++)
    fprintf(file, "%s%s", i ? "," : "", table->column[i].name);
  fputc('\n', file);
  for (size_t row = 0; row < table->rows; row++) {
    for (size_t i = 0; i < table->columns; i++) {
      if (i) fputc(',', file);
      put_number(file, table->value[row * table->columns + i]);
    }
    fputc('\n', file);
  }
}

/* A row of names, or of a run if `result` is not NULL. The outcome is between the keys and the numbers. */
static void write_row(FILE *file, const ZpCases *cases, const ZpResult *result) {
  for (size_t i = 0; i <= cases->columns; i++) {
    const size_t column = i - (i > cases->keys);
    if (i) fputc(',', file);
    if (i == cases->keys)
      fputs(result ? zp_outcome_name(result->outcome) : "outcome", file);
    else if (result)
      put_number(file, cases->value[column]);
    else
      fputs(cases->column[column].name, file);
  }
  fputc('\n', file);
}

static ZpStatus write_sweep(FILE *file, const ZpReport *report, ZpError *err) {
  ZpCases cases;
  const bool open = zp_cases_open(report, &cases);
  if (open) write_row(file, &cases, NULL);
  for (size_t run = 0; open && run < report->count; run++)
    write_row(file, &cases, zp_cases_read(&cases, run));
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
  if (sweep)
    status = write_sweep(out.file, report, err);
  else
    write_series(out.file, single->series);
  return zp_atomic_finish(&out, status, err);
}
