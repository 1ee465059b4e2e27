/* CSV files => sets of rows, one for each measured column of each file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <zipact/trace.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/fit.h"
#include "io/data.h"
#include "io/range.h"
#include "io/units.h"

enum { NAMES_MOST = 16 };

/* Names of columns in a key: "stroke_mm; frequency_Hz". */
typedef struct Names {
  const char *key;
  char text[ZP_TEXT_SIZE];
  const char *name[NAMES_MOST];
  int count;
  unsigned used; /* bits of those that a file has */
} Names;

/* A file, with its columns that were set and measured, and all that are used. */
typedef struct Measured {
  const ZpData *data;
  int x, y[NAMES_MOST], columns; /* y is -1 where a planned measurement has no column */
  const char *name[NAMES_MOST];  /* [columns] of what is measured */
  bool is_record;                /* x is time: the rows are of one run, */
  size_t run;                    /* this one */
  bool *used;                    /* [columns of the file] */
} Measured;

typedef struct Reading {
  ZpFit *fit;
  ZpDataFiles files;
  Measured *measured; /* [files.count] */
  size_t sets;        /* of all files */
  bool all;           /* each name must be one that a file has */
  Names x, y;
  double sigma[ZP_FIT_KINDS]; /* of calibrate.sigma, SI; NAN: not given */
  ZpError *err;
} Reading;

/* -- which columns --------------------------------------------------------------------------------- */

static ZpStatus split_names(Names *names, const char *key, const char *text, ZpError *err) {
  *names = (Names){.key = key};
  memcpy(names->text, text, sizeof names->text);
  char *rest = names->text;
  for (char *part = strsep(&rest, ";"); part; part = strsep(&rest, ";")) {
    part = zp_trim(part);
    if (!*part) continue;
    if (names->count == NAMES_MOST)
      return zp_fail(err, ZP_BAD_INPUT, "%s: names more than %d columns", key, NAMES_MOST);
    names->name[names->count++] = part;
  }
  return ZP_OK;
}

/* The columns of a file that have one of these names => columns [how many]. */
static int find_columns(const ZpData *data, Names *names, int *columns) {
  int found = 0;
  for (int i = 0; i < names->count; i++) {
    const int column = zp_data_column(data, names->name[i]);
    if (column < 0) continue;
    names->used |= 1u << i;
    columns[found++] = column;
  }
  return found;
}

static ZpStatus fail_column(const Names *names, const char *name, const char *path, ZpError *err) {
  return zp_fail(err, ZP_BAD_INPUT, "%s = \"%.60s\": no such column in %.200s", names->key, name, path);
}

static ZpStatus fail_measured(const ZpFit *fit, const Names *names, const char *name, const ZpData *data,
                              ZpError *err) {
  if (fit->planned)
    return zp_fail(err, ZP_BAD_INPUT,
                   "plan.candidates: %.200s: no column is measured; calibrate.y must name what is measured, such as "
                   "stroke_mm",
                   data->path);
  if (names->count > 0) return fail_column(names, name, data->path, err);
  return zp_fail(err, ZP_BAD_INPUT,
                 "%.200s:%d: no column of this record is measured: stroke, displacement, opening, capacitance or "
                 "current with its unit; give another name by data.columns: %.60s = stroke_mm",
                 data->path, zp_data_line(data, 0) - 1, data->cell[data->columns - 1]);
}

/* Refuse a name that no file has: it is misspelt. */
static ZpStatus check_names(const Reading *r, const Names *names) {
  for (int i = 0; i < names->count; i++)
    if (!(names->used >> i & 1))
      return fail_column(names, names->name[i], r->files.count > 1 ? "any file" : r->files.file->path, r->err);
  return ZP_OK;
}

static bool is_time(const char *name) {
  ZpUnitScale scale;
  return zp_data_unit(name, "time", "s", &scale);
}

/* Can a kind be measured against this quantity? Over time, only a quantity of a run; a current only so; against a
 * weight, not a force. */
static bool is_possible(bool over_time, int x_key, ZpFitKind kind) {
  if (over_time) return !zp_fit_number[kind].number;
  return kind != ZP_FIT_CURRENT && (kind != ZP_FIT_FORCE || x_key != zp_key_find("load.mass"));
}

/* Is a column named as a measurement, over time as one that a run has? */
static bool is_measurement(const char *name, bool over_time) {
  ZpUnitScale scale;
  for (int kind = 0; kind < ZP_FIT_KINDS; kind++)
    if (is_possible(over_time, -1, (ZpFitKind)kind) &&
        zp_data_unit(name, zp_fit_number[kind].column, zp_fit_number[kind].unit, &scale))
      return true;
  return false;
}

/* Without names in calibrate.x and .y: a column of time and all that a run has, otherwise the first column, and the
 * first of the others that is named as a measurement, or the second column. */
static int usual_x(const ZpData *data) {
  for (int column = 0; column < (int)data->columns; column++)
    if (is_time(data->cell[column])) return column;
  return 0;
}

static void take_usual_y(const ZpData *data, Measured *measured) {
  const int most = measured->is_record ? NAMES_MOST : 1;
  for (int column = measured->is_record ? 0 : 1; column < (int)data->columns && measured->columns < most; column++)
    if (is_measurement(data->cell[column], measured->is_record)) measured->y[measured->columns++] = column;
  if (!measured->is_record && measured->columns == 0 && data->columns > 1) measured->y[measured->columns++] = 1;
}

/* Without a column for it, a row of possible measurements is measured in all that calibrate.y names. */
static void take_absent_y(const Names *names, Measured *measured) {
  for (; measured->columns < names->count; measured->columns++) {
    measured->y[measured->columns] = -1;
    measured->name[measured->columns] = names->name[measured->columns];
  }
}

/* The columns of what was measured, or would be. */
static ZpStatus find_y(Reading *r, const ZpData *data, Measured *measured) {
  if (r->y.count > 0)
    measured->columns = find_columns(data, &r->y, measured->y);
  else
    take_usual_y(data, measured);
  for (int i = 0; i < measured->columns; i++)
    measured->name[i] = data->cell[measured->y[i]];
  if (measured->columns == 0 && r->fit->planned) {
    take_absent_y(&r->y, measured);
    r->y.used |= (1u << r->y.count) - 1;
  }
  if (measured->columns > 0) return ZP_OK;
  return fail_measured(r->fit, &r->y, r->fit->def->calibrate.y, data, r->err);
}

/* Find the columns in every file; of the names in calibrate.x each file takes the first that it has. */
static ZpStatus find_measured(Reading *r) {
  ZpFit *fit = r->fit;
  r->x.used = fit->named.x;
  r->y.used = fit->named.y;
  for (size_t i = 0; i < r->files.count; i++) {
    const ZpData *data = &r->files.file[i];
    Measured *measured = &r->measured[i];
    int x[NAMES_MOST];
    measured->data = data;
    measured->used = calloc(data->columns, sizeof *measured->used);
    if (!measured->used) return zp_fail_memory(r->err);
    x[0] = usual_x(data);
    if (r->x.count > 0 && find_columns(data, &r->x, x) == 0)
      return fail_column(&r->x, fit->def->calibrate.x, data->path, r->err);
    measured->x = x[0];
    measured->is_record = is_time(data->cell[x[0]]);
    ZpStatus status = find_y(r, data, measured);
    if (status != ZP_OK) return status;
    if (measured->is_record) measured->run = fit->runs++;
    if (measured->is_record && measured->columns > ZP_TRACE_SIGNALS)
      return zp_fail(r->err, ZP_BAD_INPUT, "%.200s: more than %d measured columns", data->path, ZP_TRACE_SIGNALS);
    if (data->rows == 0) return zp_fail(r->err, ZP_BAD_INPUT, "%.200s: 0 rows of data", data->path);
    fit->rows += data->rows * (size_t)measured->columns;
    r->sets += (size_t)measured->columns;
  }
  fit->named.x = r->x.used;
  fit->named.y = r->y.used;
  ZpStatus status = r->all ? check_names(r, &r->x) : ZP_OK;
  return status == ZP_OK && r->all ? check_names(r, &r->y) : status;
}

static bool is_measured(const Measured *measured, int column) {
  for (int i = 0; i < measured->columns; i++)
    if (measured->y[i] == column) return true;
  return false;
}

/* -- what was set ---------------------------------------------------------------------------------- */

/* zp_data_unit; remembers a column that has no unit. */
static bool take_unit(ZpFit *fit, const char *name, const char *stem, const char *unit, ZpUnitScale *scale) {
  char text[80];
  if (!zp_data_unit(name, stem, unit, scale)) return false;
  const bool bare = strlen(name) == strlen(stem) && *unit && strcmp(unit, "1") != 0;
  snprintf(text, sizeof text, "%.60s in %s", name, unit);
  const size_t used = strlen(fit->bare);
  if (bare && !strstr(fit->bare, text))
    snprintf(fit->bare + used, sizeof fit->bare - used, "%s%s", used ? ", " : "", text);
  return true;
}

/* Unit of the numbers in a column: a value is number * scale / per. */
typedef struct Unit {
  ZpUnitScale scale;
  double per;
} Unit;

/* The key and unit in the header of a column; -1 if it is not a key. */
static int key_of_header(ZpFit *fit, const char *name, Unit *unit) {
  const double gravity = fit->def->gravity;
  unit->per = 1;
  if (take_unit(fit, name, "load", "kg", &unit->scale)) return zp_key_find("load.mass");
  if (take_unit(fit, name, "voltage", "V", &unit->scale)) return zp_key_find("drive.voltage");
  for (int i = zp_key_next_field(-1); i >= 0; i = zp_key_next_field(i))
    if (zp_fit_takes(i) && take_unit(fit, name, ZP_KEY_NAME(i), zp_key(i)->unit, &unit->scale)) return i;
  if (gravity > 0 &&
      (take_unit(fit, name, "force", "N", &unit->scale) || take_unit(fit, name, "load", "N", &unit->scale))) {
    unit->per = gravity; /* the weight of a load */
    return zp_key_find("load.mass");
  }
  return -1;
}

/* Read a column of numbers that set `key` (any numbers if it is -1) => values [rows], SI. */
static ZpStatus read_column(const ZpFit *fit, const ZpData *data, int column, int key, const Unit *unit, double *values,
                            ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < data->rows && status == ZP_OK; i++) {
    ZpActuatorDef scratch = *fit->def;
    status = zp_data_number(data, i, (size_t)column, &values[i], err);
    values[i] = zp_unit_apply(&unit->scale, values[i], unit->per);
    if (status == ZP_OK && key >= 0) status = zp_def_set(&scratch, key, values[i], err);
  }
  return status;
}

static ZpStatus fail_fitted(const ZpFit *fit, int key, const char *column, ZpError *err) {
  for (int i = 0; i < fit->keys; i++)
    if (fit->key[i] == key)
      return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is given by column %.60s and cannot be fitted",
                     ZP_KEY_NAME(key), column);
  return ZP_OK;
}

/* A key that a column sets must not be fitted or set by another column. */
static ZpStatus check_set(const ZpFit *fit, const ZpFitSet *set, int key, const char *column, ZpError *err) {
  bool twice = set->others > 0 && set->x_key == key;
  for (int i = 0; i + 1 < set->others; i++)
    twice |= set->other_key[i] == key;
  if (twice)
    return zp_fail(err, ZP_BAD_INPUT, "%s: column %.60s: another column sets %s as well", fit->source, column,
                   ZP_KEY_NAME(key));
  return fail_fitted(fit, key, column, err);
}

/* Times of one run must not decrease; those of day count from the first row. */
static ZpStatus check_times(double *time, const ZpData *data, int column, ZpError *err) {
  const double first = zp_data_is_clock(data, (size_t)column) ? time[0] : 0;
  for (size_t i = 0; i < data->rows; i++) {
    time[i] -= first;
    if (i > 0 && time[i] < time[i - 1])
      return zp_fail(err, ZP_BAD_INPUT, "%.200s:%d: times must not decrease", data->path, zp_data_line(data, i));
  }
  return ZP_OK;
}

static ZpStatus read_x(ZpFit *fit, ZpFitSet *set, const ZpData *data, int column, ZpError *err) {
  Unit unit = {.per = 1};
  double *x = fit->x + set->first;
  const char *name = data->cell[column];
  const bool over_time = take_unit(fit, name, "time", "s", &unit.scale);
  set->x_key = over_time ? -1 : key_of_header(fit, name, &unit);
  if (!over_time && set->x_key < 0)
    return zp_fail(
        err, ZP_BAD_INPUT,
        "%.200s:%d: column %.60s: unknown; calibrate.x takes time, load, force, voltage or a numeric key, with its "
        "unit, such as load_g; give another name by data.columns: %.60s = load_g",
        data->path, data->line[0], name, name);
  ZpStatus status = check_set(fit, set, set->x_key, name, err);
  if (status == ZP_OK) status = read_column(fit, data, column, set->x_key, &unit, x, err);
  return status == ZP_OK && over_time ? check_times(x, data, column, err) : status;
}

/* The voltage that drove a record. */
static ZpStatus read_drive(ZpFit *fit, ZpFitRun *run, const ZpData *data, int column, const Unit *unit, ZpError *err) {
  if (run->rows > 0)
    return zp_fail(err, ZP_BAD_INPUT, "%s: column %.60s: another column sets drive.voltage as well", fit->source,
                   data->cell[column]);
  run->rows = data->rows;
  run->time = calloc(2 * data->rows, sizeof *run->time);
  if (!run->time) return zp_fail_memory(err);
  run->voltage = run->time + data->rows;
  return read_column(fit, data, column, -1, unit, run->voltage, err);
}

/* A column with one value all the time sets its key. */
static ZpStatus read_condition(ZpFit *fit, ZpFitRun *run, const ZpData *data, int column, int key, const Unit *unit,
                               ZpError *err) {
  double *values = calloc(data->rows, sizeof *values);
  ZpStatus status = values ? read_column(fit, data, column, key, unit, values, err) : zp_fail_memory(err);
  for (size_t i = 1; i < data->rows && status == ZP_OK; i++)
    if (values[i] != values[0])
      status = zp_fail(err, ZP_BAD_INPUT,
                       "%.200s:%d: column %.60s: rows over time belong to one run, in which no key can change",
                       data->path, zp_data_line(data, i), data->cell[column]);
  for (int i = 0; i < run->keys && status == ZP_OK; i++)
    if (run->key[i] == key)
      status = zp_fail(err, ZP_BAD_INPUT, "%s: column %.60s: another column sets %s as well", fit->source,
                       data->cell[column], ZP_KEY_NAME(key));
  if (status == ZP_OK && run->keys == ZP_FIT_OTHERS)
    status = zp_fail(err, ZP_BAD_INPUT, "%.200s: more than %d columns set keys", data->path, ZP_FIT_OTHERS);
  if (status == ZP_OK) status = fail_fitted(fit, key, data->cell[column], err);
  if (status == ZP_OK) {
    run->key[run->keys] = key;
    run->value[run->keys++] = values[0];
  }
  free(values);
  return status;
}

/* The voltage of a record, and its conditions. */
static ZpStatus read_run(ZpFit *fit, const Measured *measured, ZpError *err) {
  ZpFitRun *run = &fit->run[measured->run];
  const ZpData *data = measured->data;
  ZpStatus status = ZP_OK;
  run->late = -1;
  for (int column = 0; column < (int)data->columns && status == ZP_OK; column++) {
    Unit unit;
    const bool known = column == measured->x || is_measured(measured, column);
    const int key = known ? -1 : key_of_header(fit, data->cell[column], &unit);
    measured->used[column] |= known || key >= 0;
    if (key < 0) continue;
    if (key == zp_key_find("drive.voltage"))
      status = read_drive(fit, run, data, column, &unit, err);
    else
      status = read_condition(fit, run, data, column, key, &unit, err);
  }
  return status;
}

/* The run begins with the voltage, otherwise at time 0 of the file. */
static ZpStatus begin_run(ZpFitRun *run, const double *time, const ZpData *data, ZpError *err) {
  size_t row;
  if (run->rows == 0) return ZP_OK;
  run->from = time[0];
  for (size_t i = 0; i < run->rows; i++)
    run->time[i] = time[i] - run->from;
  const ZpDriveTable table = {run->rows, run->time, run->voltage};
  const char *fault = zp_drive_table_fault(&table, &row);
  if (!fault) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%.200s:%d: %s", data->path, zp_data_line(data, row), fault);
}

/* Take all other columns whose header is a key. */
static ZpStatus read_others(ZpFit *fit, ZpFitSet *set, const Measured *measured, int x, ZpError *err) {
  ZpStatus status = ZP_OK;
  const ZpData *data = measured->data;
  for (int column = 0; column < (int)data->columns && status == ZP_OK; column++) {
    Unit unit;
    const char *name = data->cell[column];
    const bool known = column == x || column == measured->x || is_measured(measured, column);
    int key = known ? -1 : key_of_header(fit, name, &unit);
    measured->used[column] |= known || key >= 0;
    if (key < 0) continue;
    if (set->others == ZP_FIT_OTHERS)
      return zp_fail(err, ZP_BAD_INPUT, "%.200s: more than %d columns set keys", data->path, ZP_FIT_OTHERS);
    set->other_key[set->others] = key;
    set->other[set->others] = calloc(data->rows, sizeof(double));
    if (!set->other[set->others++]) return zp_fail_memory(err);
    status = check_set(fit, set, key, name, err);
    if (status == ZP_OK) status = read_column(fit, data, column, key, &unit, set->other[set->others - 1], err);
  }
  return status;
}

/* -- are the rows possible ------------------------------------------------------------------------- */

/* Study limits searches for pull-in and release up to drive.voltage. */
static ZpStatus check_limit(ZpFitKind kind, const ZpActuatorDef *def, double measured, ZpError *reason) {
  bool is_limit = kind == ZP_FIT_PULL_IN || kind == ZP_FIT_RELEASE;
  if (!is_limit || isnan(measured) || measured < def->drive.voltage) return ZP_OK;
  return zp_fail(reason, ZP_BAD_INPUT,
                 "the measured %s is %g V, but the model searches up to drive.voltage = %g V; raise drive.voltage",
                 kind == ZP_FIT_PULL_IN ? "pull-in voltage" : "release voltage", measured, def->drive.voltage);
}

/* One run in time, over all rows. */
static ZpStatus check_run(const ZpFit *fit, const ZpFitRun *run, ZpError *err) {
  ZpActuatorDef def;
  double highest = fmax(fit->def->drive.voltage, fabs(fit->def->drive.offset)), first[ZP_FIT_MOST];
  memcpy(first, fit->first, sizeof first);
  zp_fit_run_def(fit, run, first, &def);
  ZpStatus status = zp_def_check_motion(&def, err);
  for (size_t i = 0; i < run->rows; i++)
    highest = fmax(i > 0 ? highest : 0, fabs(run->voltage[i]));
  return status == ZP_OK ? zp_def_check_voltage(&def, highest, err) : status;
}

/* Each row must be a valid case: by the check of the study that computes its number, otherwise by its voltage. */
static ZpStatus check_rows(const ZpFit *fit, const ZpFitSet *set, const ZpData *data, ZpError *err) {
  double start[ZP_FIT_MOST], voltage;
  memcpy(start, fit->first, sizeof start);
  if (set->x_key < 0) return check_run(fit, &fit->run[set->run], err);
  const ZpFitNumber *number = &zp_fit_number[set->kind];
  for (size_t i = 0; i < set->rows; i++) {
    ZpActuatorDef def;
    ZpError reason = {ZP_OK, ""};
    if (!zp_fit_row(fit, start, set->first + i, &def, &voltage)) continue; /* read_column has reported it */
    ZpStatus status =
        number->number ? zp_study_check(number->study, &def, &reason) : zp_def_check_voltage(&def, voltage, &reason);
    if (status == ZP_OK && check_limit(set->kind, &def, fit->y[set->first + i], &reason) == ZP_OK) continue;
    return zp_fail(err, ZP_BAD_INPUT, "%.120s:%d: %.300s", data->path, zp_data_line(data, i), reason.message);
  }
  return ZP_OK;
}

/* -- standard deviations --------------------------------------------------------------------------- */

static int kind_called(const char *name) {
  int kind = 0;
  while (kind < ZP_FIT_KINDS && strcmp(zp_fit_number[kind].column, name) != 0)
    kind++;
  return kind;
}

/* "stroke = 20 um", in place. */
static ZpStatus read_sigma_of(Reading *r, char *part) {
  char *equals = strchr(part, '=');
  ZpError reason;
  if (!equals)
    return zp_fail(r->err, ZP_BAD_INPUT, "calibrate.sigma: \"%.80s\": write stroke = 20 um; frequency = 0.1 Hz", part);
  *equals = 0;
  const char *name = zp_trim(part), *text = zp_trim(equals + 1);
  const int kind = kind_called(name);
  if (kind == ZP_FIT_KINDS)
    return zp_fail(
        r->err, ZP_BAD_INPUT,
        "calibrate.sigma: %.60s: takes stroke, displacement, opening, capacitance, current, force, zip_time, "
        "pull_in_voltage, release_voltage or frequency",
        name);
  const char *unit = zp_fit_number[kind].unit;
  ZpStatus status = zp_quantity_read(text, unit, &r->sigma[kind], &reason);
  if (status == ZP_OK && !(r->sigma[kind] > 0 && isfinite(r->sigma[kind])))
    status = zp_fail(&reason, ZP_BAD_INPUT, "needs a number above 0 and its unit, %s", unit);
  if (status == ZP_OK) return ZP_OK;
  return zp_fail(r->err, status, "calibrate.sigma: %s = \"%.60s\": %.200s", name, text, reason.message);
}

static ZpStatus read_sigma_key(Reading *r) {
  char list[ZP_TEXT_SIZE], *rest = list;
  ZpStatus status = ZP_OK;
  memcpy(list, r->fit->def->calibrate.sigma, sizeof list);
  for (int kind = 0; kind < ZP_FIT_KINDS; kind++)
    r->sigma[kind] = NAN;
  for (char *part = strsep(&rest, ";"); part && status == ZP_OK; part = strsep(&rest, ";"))
    if (part[strspn(part, " \t")]) status = read_sigma_of(r, part);
  return status;
}

/* Is this the column of standard deviations of a kind, by its full name "sigma_stroke_mm"? */
static bool is_sigma_of(const char *name, int kind) {
  const char *stem = zp_fit_number[kind].column;
  const size_t length = strlen(stem);
  if (strncasecmp(name, "sigma_", 6) != 0 || strncasecmp(name + 6, stem, length) != 0) return false;
  return name[6 + length] == 0 || name[6 + length] == '_';
}

static bool is_sigma_of_any(const char *name) {
  for (int kind = 0; kind < ZP_FIT_KINDS; kind++)
    if (is_sigma_of(name, kind)) return true;
  return false;
}

/* The column with the standard deviations of a kind; -1 if there is none: "sigma_stroke_mm", or "sigma_mm". */
static int find_sigma(const ZpData *data, ZpFitKind kind) {
  int plain = -1;
  for (int column = (int)data->columns - 1; column >= 0; column--) {
    const char *name = data->cell[column];
    if (is_sigma_of(name, (int)kind)) return column;
    if (strncasecmp(name, "sigma", 5) == 0 && !is_sigma_of_any(name)) plain = column;
  }
  return plain;
}

/* The unit in the name of such a column; false if it is not a unit of the measured quantity. */
static bool find_sigma_unit(ZpFit *fit, const char *name, ZpFitKind kind, ZpUnitScale *scale) {
  const size_t length = strlen(zp_fit_number[kind].column);
  const bool named = is_sigma_of(name, (int)kind);
  if (named) name += 6 + length; /* "_mm" */
  return take_unit(fit, name, named ? "" : "sigma", zp_fit_number[kind].unit, scale);
}

static ZpStatus read_sigma_column(ZpFit *fit, const ZpFitSet *set, const ZpData *data, int column, double *sigma,
                                  ZpError *err) {
  const char *name = data->cell[column], *unit = zp_fit_number[set->kind].unit;
  ZpUnitScale scale;
  if (!find_sigma_unit(fit, name, set->kind, &scale))
    return zp_fail(err, ZP_BAD_INPUT, "%s: column %.60s: its unit must be one of the measured quantity, such as %s",
                   fit->source, name, unit);
  for (size_t i = 0; i < set->rows; i++) {
    ZpStatus status = zp_data_number(data, i, (size_t)column, &sigma[i], err);
    if (status != ZP_OK) return status;
    sigma[i] = zp_unit_apply(&scale, sigma[i], 1);
    if (!(sigma[i] > 0))
      return zp_fail(err, ZP_BAD_INPUT, "%.200s:%d: column %.60s: a standard deviation must be above 0", data->path,
                     zp_data_line(data, i), name);
  }
  return ZP_OK;
}

/* Standard deviations of a set: from a column of the file, otherwise from calibrate.sigma, otherwise NAN. */
static ZpStatus read_sigma(const Reading *r, const ZpFitSet *set, const Measured *measured) {
  const ZpData *data = measured->data;
  double *sigma = r->fit->sigma + set->first;
  const int column = find_sigma(data, set->kind);
  if (column >= 0 && measured->columns > 1 && !is_sigma_of(data->cell[column], (int)set->kind))
    return zp_fail(r->err, ZP_BAD_INPUT,
                   "%.200s: column %.60s: the file has several measured columns; name the one that it belongs to, as "
                   "in sigma_%s_%s",
                   data->path, data->cell[column], zp_fit_number[set->kind].column, zp_fit_number[set->kind].unit);
  if (column >= 0) {
    measured->used[column] = true;
    return read_sigma_column(r->fit, set, data, column, sigma, r->err);
  }
  for (size_t i = 0; i < set->rows; i++)
    sigma[i] = r->sigma[set->kind];
  return ZP_OK;
}

/* Either all rows have a standard deviation, or none has one and all are of one kind: otherwise the relative weight of
 * a millimetre and a volt is unknown. */
static ZpStatus check_sigmas(Reading *r) {
  ZpFit *fit = r->fit;
  size_t missing = 0;
  const ZpFitSet *without = NULL;
  for (size_t i = 0; i < fit->sets; i++)
    if (isnan(fit->sigma[fit->set[i].first])) {
      without = without ? without : &fit->set[i];
      missing++;
    }
  if (missing == 0) return ZP_OK;
  if (missing == fit->sets && zp_fit_kinds(fit) == 1) {
    free(fit->sigma);
    fit->sigma = NULL;
    return ZP_OK;
  }
  const ZpFitNumber *of = &zp_fit_number[without->kind];
  return zp_fail(r->err, ZP_BAD_INPUT,
                 "%s: a fit to %s requires standard deviations of all, but %s of %.200s has none; add a column "
                 "sigma_%s_%s, or give calibrate.sigma = \"%s = ... %s\"",
                 fit->source, zp_fit_kinds(fit) > 1 ? "several kinds of measurement" : "several files", of->column,
                 r->measured[without->file].data->path, of->column, of->unit, of->column, of->unit);
}

/* Do these files have a kind of measurement, or may others have it? */
static bool may_have(const Reading *r, int kind) {
  return !r->all || r->fit->named.kinds >> kind & 1;
}

/* Refuse calibrate.sigma for a quantity that is not measured: its name is misspelt or left over. */
static ZpStatus check_sigma_key(const Reading *r) {
  for (int kind = 0; kind < ZP_FIT_KINDS; kind++) {
    if (!isnan(r->sigma[kind]) && !may_have(r, kind))
      return zp_fail(r->err, ZP_BAD_INPUT, "calibrate.sigma: %s is not measured: calibrate.y names no such column",
                     zp_fit_number[kind].column);
  }
  return ZP_OK;
}

/* -- what was measured ----------------------------------------------------------------------------- */

/* The kind of a column by its name, and its unit; false if it is none. */
static bool find_kind(ZpFit *fit, ZpFitSet *set, const char *name, ZpUnitScale *scale) {
  for (int kind = 0; kind < ZP_FIT_KINDS; kind++) {
    const ZpFitNumber *of = &zp_fit_number[kind];
    set->kind = (ZpFitKind)kind;
    if (is_possible(set->x_key < 0, set->x_key, set->kind) && take_unit(fit, name, of->column, of->unit, scale))
      return true;
  }
  return false;
}

/* `column` -1: none; it has not been measured. */
static ZpStatus read_y(ZpFit *fit, ZpFitSet *set, const ZpData *data, const char *name, int column, ZpError *err) {
  Unit unit = {.per = 1};
  if (!find_kind(fit, set, name, &unit.scale))
    return zp_fail(
        err, ZP_BAD_INPUT,
        "%.200s:%d: column %.60s: unknown; calibrate.y takes stroke, displacement, opening or capacitance with its "
        "unit; over time, also current; against a key, also zip_time, pull_in_voltage, release_voltage or frequency; "
        "against a key that is not the load, also force; give another name by data.columns: %.60s = stroke_mm",
        data->path, data->line[0], name, name);
  if (set->kind == ZP_FIT_OPENING && fit->def->actuator.kind != ZP_KIND_ELECTRO_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.y: column %.60s: only kind electro_ribbon has an opening", name);
  for (size_t i = 0; i < set->rows && fit->planned; i++)
    fit->y[set->first + i] = NAN;
  return fit->planned ? ZP_OK : read_column(fit, data, column, -1, &unit, fit->y + set->first, err);
}

static bool is_length(const char *name) {
  ZpUnitScale scale;
  return zp_data_unit(name, "stroke", "m", &scale) || zp_data_unit(name, "opening", "m", &scale);
}

static bool is_force(const char *name) {
  ZpUnitScale scale;
  return zp_data_unit(name, "force", "N", &scale) || zp_data_unit(name, "load", "kg", &scale) ||
         zp_data_unit(name, "load", "N", &scale);
}

/* Column `which` of what a file measures. */
static ZpStatus read_set(const Reading *r, ZpFitSet *set, const Measured *measured, int which) {
  const ZpData *data = measured->data;
  int x = measured->x, y = measured->y[which];
  const char *name = measured->name[which];
  const bool turned = is_length(data->cell[x]) && is_force(name);
  if (turned && r->fit->planned)
    return zp_fail(
        r->err, ZP_BAD_INPUT,
        "plan.candidates: %.200s: the model computes a stroke from a force, so a plan needs the forces: name "
        "their column in calibrate.x",
        data->path);
  if (turned) { /* whichever of the two was set on the bench */
    name = data->cell[x];
    x = y;
    y = measured->x;
  }
  ZpStatus status = read_x(r->fit, set, data, x, r->err);
  if (status == ZP_OK && measured->is_record)
    status = begin_run(&r->fit->run[set->run], r->fit->x + set->first, data, r->err);
  else if (status == ZP_OK)
    status = read_others(r->fit, set, measured, x, r->err);
  if (status == ZP_OK) status = read_y(r->fit, set, data, name, y, r->err);
  if (status == ZP_OK) status = read_sigma(r, set, measured);
  return status == ZP_OK ? check_rows(r->fit, set, data, r->err) : status;
}

/* Take the rows of a record out that are not fitted. */
static void skip_rows(ZpFit *fit, ZpFitSet *set) {
  const double from = fit->def->calibrate.skip_until, to = fit->def->calibrate.skip_after;
  size_t kept = set->first;
  while (set->before < set->rows && fit->x[set->first + set->before] < from)
    set->before++;
  for (size_t i = set->first; i < set->first + set->rows; i++) {
    if (fit->x[i] < from || fit->x[i] > to) continue;
    fit->x[kept] = fit->x[i];
    fit->y[kept] = fit->y[i];
    fit->sigma[kept++] = fit->sigma[i];
  }
  set->rows = kept - set->first;
}

static ZpStatus fail_skipped(const ZpFit *fit, const char *path, ZpError *err) {
  const double from = fit->def->calibrate.skip_until, to = fit->def->calibrate.skip_after;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%.200s: no row is between calibrate.skip_until = %g s and calibrate.skip_after = %g s", path,
                 isnan(from) ? -INFINITY : from, isnan(to) ? INFINITY : to);
}

/* The measured columns of a file; over time, the record that they are of. */
static ZpStatus read_file(Reading *r, Measured *measured) {
  ZpFit *fit = r->fit;
  ZpStatus status = measured->is_record ? read_run(fit, measured, r->err) : ZP_OK;
  for (int c = 0; c < measured->columns && status == ZP_OK; c++) {
    ZpFitSet *set = &fit->set[fit->sets++];
    *set = (ZpFitSet){.first = fit->rows,
                      .rows = measured->data->rows,
                      .run = measured->run,
                      .zero = -1,
                      .file = (size_t)(measured - r->measured)};
    status = read_set(r, set, measured, c);
    if (status == ZP_OK && measured->is_record) skip_rows(fit, set);
    if (status == ZP_OK && set->rows == 0) status = fail_skipped(fit, measured->data->path, r->err);
    fit->rows += set->rows;
  }
  return status;
}

/* -- shifts ---------------------------------------------------------------------------------------- */

static ZpStatus add_shift(ZpFit *fit, const char *name, const char *unit, double size, int *place, ZpError *err) {
  if (fit->n - fit->keys == ZP_FIT_SHIFTS)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.offsets: more than %d shifts", ZP_FIT_SHIFTS);
  snprintf(fit->name[fit->n], sizeof fit->name[0], "%s", name);
  fit->unit[fit->n] = unit;
  fit->start[fit->n] = size;
  fit->lower[fit->n] = -1e3;
  fit->upper[fit->n] = 1e3;
  *place = fit->n++;
  return ZP_OK;
}

/* A hundredth of the range of these values, by which a shift counts. */
static double part_of_range(const double *value, size_t count) {
  double least = value[0], most = value[0];
  for (size_t i = 1; i < count; i++)
    least = fmin(least, value[i]), most = fmax(most, value[i]);
  return most > least ? 0.01 * (most - least) : fmax(0.01 * fabs(most), 1e-9);
}

/* The times of all records against their voltage: each has its own. */
static ZpStatus shift_times(Reading *r) {
  ZpFit *fit = r->fit;
  ZpStatus status =
      may_have(r, ZP_FIT_KINDS) ? ZP_OK : zp_fail(r->err, ZP_BAD_INPUT, "calibrate.offsets: time: no file has times");
  for (size_t i = 0; i < fit->sets && status == ZP_OK; i++) {
    const ZpFitSet *set = &fit->set[i];
    if (set->x_key >= 0 || fit->run[set->run].late >= 0) continue;
    char name[32] = "time_offset";
    if (fit->runs > 1) snprintf(name, sizeof name, "time_offset_%zu", set->run + 1);
    status = add_shift(fit, name, "s", part_of_range(fit->x + set->first, set->rows), &fit->run[set->run].late, r->err);
  }
  return status;
}

/* The zero of a measured quantity, one for each file that has it. */
static ZpStatus shift_zeros(Reading *r, const char *name) {
  ZpFit *fit = r->fit;
  ZpStatus status = ZP_OK;
  size_t found = 0, count = 0;
  const int kind = kind_called(name);
  for (size_t i = 0; i < fit->sets; i++)
    count += (int)fit->set[i].kind == kind;
  if (kind == ZP_FIT_KINDS || !may_have(r, kind))
    return zp_fail(r->err, ZP_BAD_INPUT, "calibrate.offsets: %.60s: takes time and names of measured columns", name);
  for (size_t i = 0; i < fit->sets && status == ZP_OK; i++) {
    ZpFitSet *set = &fit->set[i];
    char shift[40];
    if ((int)set->kind != kind) continue;
    snprintf(shift, sizeof shift, count > 1 ? "%s_offset_%zu" : "%s_offset", zp_fit_number[kind].column, ++found);
    status = add_shift(fit, shift, zp_fit_number[kind].unit, part_of_range(fit->y + set->first, set->rows), &set->zero,
                       r->err);
  }
  return status;
}

static ZpStatus read_shifts(Reading *r) {
  char list[ZP_TEXT_SIZE], *rest = list;
  ZpStatus status = ZP_OK;
  memcpy(list, r->fit->def->calibrate.offsets, sizeof list);
  for (char *part = strsep(&rest, ";"); part && status == ZP_OK; part = strsep(&rest, ";")) {
    part = zp_trim(part);
    if (!*part) continue;
    char *unit = strrchr(part, '_'); /* stroke_mm is stroke */
    if (unit && kind_called(part) == ZP_FIT_KINDS) *unit = 0;
    status = strcmp(part, "time") == 0 ? shift_times(r) : shift_zeros(r, part);
  }
  return status;
}

/* -- all of it ------------------------------------------------------------------------------------- */

static ZpStatus read_sets(Reading *r) {
  ZpFit *fit = r->fit;
  ZpStatus status = ZP_OK;
  fit->run = calloc(fit->runs + 1, sizeof *fit->run);
  fit->set = calloc(r->sets, sizeof *fit->set);
  fit->x = calloc(fit->rows, sizeof *fit->x);
  fit->y = calloc(fit->rows, sizeof *fit->y);
  fit->sigma = calloc(fit->rows, sizeof *fit->sigma);
  if (!fit->run || !fit->set || !fit->x || !fit->y || !fit->sigma) return zp_fail_memory(r->err);
  fit->rows = 0;
  for (size_t i = 0; i < r->files.count && status == ZP_OK; i++)
    status = read_file(r, &r->measured[i]);
  for (size_t i = 0; i < fit->sets; i++)
    fit->named.kinds |= 1u << fit->set[i].kind | (fit->set[i].x_key < 0 ? 1u << ZP_FIT_KINDS : 0);
  if (status == ZP_OK) status = read_shifts(r);
  if (status == ZP_OK && !fit->planned && fit->rows < (size_t)fit->n)
    status = zp_fail(r->err, ZP_BAD_INPUT,
                     "data.file: %zu rows of data, fewer than the %d keys of calibrate.fit and shifts of "
                     "calibrate.offsets",
                     fit->rows, fit->n);
  if (status == ZP_OK) status = check_sigma_key(r);
  return status == ZP_OK ? check_sigmas(r) : status;
}

/* Remember the columns of a file that are not used, by the names that the file has; one without a name is an empty one
 * of a spreadsheet. */
static void note_idle(ZpFit *fit, const Measured *measured) {
  const char *folder = strrchr(measured->data->path, '/'), *file = folder ? folder + 1 : measured->data->path;
  bool first = true;
  for (size_t i = 0; i < measured->data->columns; i++) {
    const size_t used = strlen(fit->idle), room = sizeof fit->idle - used;
    if (measured->used[i] || !*measured->data->name[i]) continue;
    if (first)
      snprintf(fit->idle + used, room, "%s%.60s: \"%.60s\"", used ? "; " : "", file, measured->data->name[i]);
    else
      snprintf(fit->idle + used, room, ", \"%.60s\"", measured->data->name[i]);
    first = false;
  }
}

/* Remember which lines of a file were taken for what. */
static void note_layout(ZpFit *fit, const Measured *measured) {
  const char *folder = strrchr(measured->data->path, '/'), *file = folder ? folder + 1 : measured->data->path;
  const size_t used = strlen(fit->layout);
  char text[160];
  zp_data_describe(measured->data, text, sizeof text);
  if (*text) snprintf(fit->layout + used, sizeof fit->layout - used, "%s%.60s: %s", used ? "; " : "", file, text);
}

static ZpStatus read_files(Reading *r) {
  const ZpActuatorDef *def = r->fit->def;
  const char *paths = r->fit->planned ? def->plan.candidates : def->data.file;
  ZpStatus status = zp_data_read_all(r->fit->source, paths, def->data.columns, !r->fit->planned, &r->files, r->err);
  if (status == ZP_OK) status = read_sigma_key(r);
  if (status == ZP_OK) status = split_names(&r->x, "calibrate.x", def->calibrate.x, r->err);
  if (status == ZP_OK) status = split_names(&r->y, "calibrate.y", def->calibrate.y, r->err);
  if (status != ZP_OK) return status;
  r->measured = calloc(r->files.count, sizeof *r->measured);
  return r->measured ? ZP_OK : zp_fail_memory(r->err);
}

ZpStatus zp_fit_read_sets(ZpFit *fit, bool all, ZpError *err) {
  Reading reading = {.fit = fit, .all = all, .err = err};
  ZpStatus status = read_files(&reading);
  if (status == ZP_OK) status = find_measured(&reading);
  if (status == ZP_OK) status = read_sets(&reading);
  for (size_t i = 0; reading.measured && i < reading.files.count; i++) {
    if (status == ZP_OK) note_idle(fit, &reading.measured[i]);
    if (status == ZP_OK) note_layout(fit, &reading.measured[i]);
    free(reading.measured[i].used);
  }
  free(reading.measured);
  zp_data_files_destroy(&reading.files);
  return status;
}
