/* table.csv: the time series of one run, or one row per run of a sweep.
 *
 * No field needs quotes: names and outcomes have no commas. A value that does not exist is an empty
 * cell. */
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/cases.h"
#include "io/number.h"
#include "io/report.h"
#include "io/writers.h"

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

static void write_head(FILE *file, const ZpReport *report, const ZpScalarNames *names) {
  size_t keys;
  const int *key = zp_scenario_lists(report->scenario, &keys);
  for (size_t i = 0; i < keys; i++) {
    char column[ZP_KEY_COLUMN_SIZE];
    zp_key_column(key[i], column, sizeof column);
    fprintf(file, "%s,", column);
  }
  fputs("outcome", file);
  for (size_t i = 0; i < names->count; i++)
    fprintf(file, ",%s", names->item[i].name);
  fputc('\n', file);
}

/* The values of the swept keys of this run, which are numbers: words take no lists. */
static void write_keys(FILE *file, const ZpReport *report, size_t run, double *value) {
  size_t keys;
  zp_scenario_lists(report->scenario, &keys);
  zp_scenario_values(report->scenario, run, value);
  for (size_t i = 0; i < keys; i++) {
    put_number(file, value[i]);
    fputc(',', file);
  }
}

static void write_row(FILE *file, const ZpResult *result, const ZpScalarNames *names) {
  fputs(zp_outcome_name(result->outcome), file);
  for (size_t i = 0; i < names->count; i++) {
    fputc(',', file);
    put_number(file, zp_scalar_at(result, names, i));
  }
  fputc('\n', file);
}

static ZpStatus write_sweep(FILE *file, const ZpReport *report, ZpError *err) {
  size_t keys;
  ZpScalarNames names;
  zp_scenario_lists(report->scenario, &keys);
  double *value = calloc(keys + 1, sizeof *value);
  if (!value || !zp_report_scalars(report, false, &names)) {
    free(value);
    return zp_fail_memory(err);
  }
  write_head(file, report, &names);
  for (size_t run = 0; run < report->count; run++) {
    write_keys(file, report, run, value);
    write_row(file, zp_report_result(report, run), &names);
  }
  free(names.item);
  free(value);
  return ZP_OK;
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
