#include "io/drive_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/sim.h>

#include "base/fail.h"
#include "def/def.h"
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

/* Keys and words for the rows of a drive or of a setpoint. */
typedef struct Kind {
  const char *table, *file; /* keys that contain the rows, and their values */
  const char *text, *path;
  const char *time_key, *value_key; /* keys whose units and ranges apply to the rows */
  const char *what, *stem, *unit, *example,
      *row; /* words, the column and its unit, examples of a column and of a row */
} Kind;

static Kind kind_of(const ZpActuatorDef *def) {
  if (def->control.kind == ZP_CONTROL_NONE)
    return (Kind){
        "drive.table", "drive.file", def->drive.table, def->drive.file, "drive.rise_time", "drive.offset", "voltage",
        "voltage",     "V",          "voltage_kV",     "10 ms = 8 kV"};
  return (Kind){"setpoint.table",     "setpoint.file",   def->setpoint.table, def->setpoint.file,
                "setpoint.rise_time", "setpoint.offset", "setpoint",          "setpoint",
                zp_control_unit(def), "setpoint_mm",     "10 ms = 5 mm"};
}

/* -- drive.table: "0 ms = 0 kV, 10 ms = 8 kV" ------------------------------------------------------ */

static ZpStatus fail_row(const Kind *kind, size_t row, const char *reason, ZpError *err) {
  ZpSource source = {.name = kind->table};
  return zp_source_fail(&source, 0, err, "row %zu: %s", row + 1, reason);
}

/* One side of a row, read as a value of that key. */
static ZpStatus read_side(const Kind *kind, bool time, const char *text, size_t row, double *value, ZpError *err) {
  ZpError reason;
  ZpStatus status = zp_value_read(zp_key_find(time ? kind->time_key : kind->value_key), text, value, &reason);
  if (status == ZP_OK) return ZP_OK;
  if (status == ZP_MACHINE) return zp_fail(err, status, "%s", reason.message);
  char sentence[sizeof reason.message + 64];
  snprintf(sentence, sizeof sentence, "%s \"%.40s\": %s", time ? "time" : kind->what, text, reason.message);
  return fail_row(kind, row, sentence, err);
}

static ZpStatus read_row(const Kind *kind, char *text, ZpDriveRows *rows, size_t row, ZpError *err) {
  char sentence[80];
  char *between = strpbrk(text, "=:");
  if (!between) {
    snprintf(sentence, sizeof sentence, "give time = %s, such as %s", kind->what, kind->row);
    return fail_row(kind, row, sentence, err);
  }
  *between = 0;
  ZpStatus status = read_side(kind, true, text, row, &rows->time[row], err);
  return status == ZP_OK ? read_side(kind, false, between + 1, row, &rows->voltage[row], err) : status;
}

static ZpStatus read_text(const Kind *kind, ZpDriveRows *rows, ZpError *err) {
  char text[ZP_TEXT_SIZE], *rest = text;
  size_t commas = 0;
  memcpy(text, kind->text, strlen(kind->text) + 1);
  for (const char *c = text; *c; c++)
    commas += *c == ',';
  ZpStatus status = allocate(rows, commas + 1, err);
  for (size_t i = 0; i < rows->count && status == ZP_OK; i++)
    status = read_row(kind, strsep(&rest, ","), rows, i, err);
  size_t row;
  ZpDriveTable read = zp_drive_rows_table(rows);
  const char *fault = status == ZP_OK ? zp_drive_table_fault(&read, &row) : NULL;
  return fault ? fail_row(kind, row, fault, err) : status;
}

/* -- drive.file ----------------------------------------------------------------------------------- */

static ZpStatus read_file(const Kind *kind, ZpDriveRows *rows, ZpError *err) {
  ZpData data;
  ZpStatus status = zp_data_read(kind->file, kind->path, &data, err);
  if (status == ZP_OK) status = allocate(rows, data.rows, err);
  if (status == ZP_OK) status = zp_data_read_column(&data, "time", "s", "time_ms", rows->time, err);
  if (status == ZP_OK) status = zp_data_read_column(&data, kind->stem, kind->unit, kind->example, rows->voltage, err);
  size_t row;
  ZpDriveTable read = zp_drive_rows_table(rows);
  const char *fault = status == ZP_OK ? zp_drive_table_fault(&read, &row) : NULL;
  if (fault) {
    ZpSource source = {.name = kind->path};
    int line = data.line[data.rows > row ? row + 1 : 0];
    status = zp_source_fail(&source, line, err, "%s", fault);
  }
  zp_data_destroy(&data);
  return status;
}

ZpStatus zp_drive_rows_read(const ZpActuatorDef *def, ZpDriveRows *rows, ZpError *err) {
  *rows = (ZpDriveRows){0};
  Kind kind = kind_of(def);
  if (*kind.path) return read_file(&kind, rows, err);
  if (*kind.text) return read_text(&kind, rows, err);
  return zp_fail(err, ZP_BAD_INPUT, "%.*s.waveform = table: give %s or %s", (int)strcspn(kind.table, "."), kind.table,
                 kind.table, kind.file);
}
