#include "io/drive_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/data.h"
#include "io/source.h"
#include "io/value.h"

void zp_drive_rows_free(ZpDriveRows *rows) {
  free(rows->time);
  free(rows->voltage);
  *rows = (ZpDriveRows){0};
}

ZpDriveTable zp_drive_rows_table(const ZpDriveRows *rows) {
  return (ZpDriveTable){rows->count, rows->time, rows->voltage};
}

static ZpStatus allocate(ZpDriveRows *rows, size_t count, ZpError *err) {
  rows->count = count;
  rows->time = calloc(count + 1, sizeof *rows->time);
  rows->voltage = calloc(count + 1, sizeof *rows->voltage);
  return rows->time && rows->voltage ? ZP_OK : zp_fail_memory(err);
}

/* -- drive.table: "0 ms = 0 kV, 10 ms = 8 kV" ------------------------------------------------------ */

static ZpStatus fail_row(size_t row, const char *reason, ZpError *err) {
  ZpSource source = {.name = "drive.table"};
  return zp_source_fail(&source, 0, err, "row %zu: %s", row + 1, reason);
}

/* One side of a row, read as the key of that name would be. */
static ZpStatus read_side(const char *key, const char *what, const char *text, size_t row, double *value,
                          ZpError *err) {
  ZpError reason;
  ZpStatus status = zp_value_read(zp_key_find(key), text, value, &reason);
  if (status == ZP_OK) return ZP_OK;
  if (status == ZP_MACHINE) return zp_fail(err, status, "%s", reason.message);
  char sentence[sizeof reason.message + 64];
  snprintf(sentence, sizeof sentence, "%s \"%.40s\": %s", what, text, reason.message);
  return fail_row(row, sentence, err);
}

static ZpStatus read_row(char *text, ZpDriveRows *rows, size_t row, ZpError *err) {
  char *between = strpbrk(text, "=:");
  if (!between) return fail_row(row, "give time = voltage, such as 10 ms = 8 kV", err);
  *between = 0;
  ZpStatus status = read_side("drive.rise_time", "time", text, row, &rows->time[row], err);
  return status == ZP_OK ? read_side("drive.offset", "voltage", between + 1, row, &rows->voltage[row], err) : status;
}

static ZpStatus read_text(const char *table, ZpDriveRows *rows, ZpError *err) {
  char text[ZP_TEXT_SIZE], *rest = text;
  size_t commas = 0;
  memcpy(text, table, strlen(table) + 1);
  for (const char *c = text; *c; c++)
    commas += *c == ',';
  ZpStatus status = allocate(rows, commas + 1, err);
  for (size_t i = 0; i < rows->count && status == ZP_OK; i++)
    status = read_row(strsep(&rest, ","), rows, i, err);
  size_t row;
  ZpDriveTable read = zp_drive_rows_table(rows);
  const char *fault = status == ZP_OK ? zp_drive_table_fault(&read, &row) : NULL;
  return fault ? fail_row(row, fault, err) : status;
}

/* -- drive.file ----------------------------------------------------------------------------------- */

static ZpStatus read_column(const ZpData *data, const char *stem, const char *unit, const char *example, double *value,
                            ZpError *err) {
  double factor = 1, divisor = 1;
  size_t column = 0;
  while (column < data->columns && !zp_data_unit(data->cell[column], stem, unit, &factor, &divisor))
    column++;
  if (column == data->columns)
    return zp_fail(err, ZP_BAD_INPUT, "drive.file: %.200s: no column %s_%s or %s", data->path, stem, unit, example);
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < data->rows && status == ZP_OK; i++) {
    status = zp_data_number(data, i, column, &value[i], err);
    value[i] = value[i] * factor / divisor;
  }
  return status;
}

static ZpStatus read_file(const char *path, ZpDriveRows *rows, ZpError *err) {
  ZpData data;
  ZpStatus status = zp_data_read("drive.file", path, &data, err);
  if (status == ZP_OK) status = allocate(rows, data.rows, err);
  if (status == ZP_OK) status = read_column(&data, "time", "s", "time_ms", rows->time, err);
  if (status == ZP_OK) status = read_column(&data, "voltage", "V", "voltage_kV", rows->voltage, err);
  size_t row;
  ZpDriveTable read = zp_drive_rows_table(rows);
  const char *fault = status == ZP_OK ? zp_drive_table_fault(&read, &row) : NULL;
  if (fault) {
    ZpSource source = {.name = path};
    int line = data.line[data.rows > row ? row + 1 : 0];
    status = zp_source_fail(&source, line, err, "%s", fault);
  }
  zp_data_destroy(&data);
  return status;
}

ZpStatus zp_drive_rows_read(const ZpActuatorDef *def, ZpDriveRows *rows, ZpError *err) {
  *rows = (ZpDriveRows){0};
  if (*def->drive.file) return read_file(def->drive.file, rows, err);
  if (*def->drive.table) return read_text(def->drive.table, rows, err);
  return zp_fail(err, ZP_BAD_INPUT, "drive.waveform = table: give drive.table or drive.file");
}
