/* Def and CSV file => what is fitted to what. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/fail.h"
#include "fit/fit.h"
#include "io/data.h"
#include "io/range.h"

const ZpFitNumber zp_fit_number[ZP_FIT_KINDS] = {
    [ZP_FIT_LENGTH] = {"stroke", "m", 0, NULL, false},
    [ZP_FIT_CAPACITANCE] = {"capacitance", "F", 0, NULL, false},
#define ZP_MEASURED(enumerator, kind, column, unit, scalar, has_slopes)                                                \
  [kind] = {column, unit, enumerator, scalar, has_slopes},
#include <zipact/studies.def>
};

void zp_fit_close(ZpFit *fit) {
  free(fit->x);
  free(fit->y);
  free(fit->sigma);
  for (int k = 0; k < fit->others; k++)
    free(fit->other[k]);
  fit->x = fit->y = fit->sigma = NULL;
  fit->others = 0;
}

static bool is_real(int key) {
  return zp_key(key)->type == ZP_KEY_REAL || zp_key(key)->type == ZP_KEY_REAL_AUTO;
}

/* Bounds of z: those of the scenario, and the range of the key. */
static void find_bounds(ZpFit *fit, int i) {
  const ZpKey *key = zp_key(fit->key[i]);
  double start = fit->start[i], at_min = key->min / start, at_max = key->max / start;
  fit->lower[i] = fmax(fit->def->calibrate.lower, fmin(at_min, at_max));
  fit->upper[i] = fmin(fit->def->calibrate.upper, fmax(at_min, at_max));
}

/* "ribbon.young_modulus = 100 GPa .. 250 GPa": in place of the multiples of the start. */
static ZpStatus set_bounds(ZpFit *fit, char *text, ZpError *err) {
  ZpInterval bounds;
  ZpStatus status = zp_interval_read("calibrate.bounds", text, &bounds, err);
  if (status != ZP_OK) return status;
  int i = 0;
  while (i < fit->n && fit->key[i] != bounds.key)
    i++;
  const char *name = zp_key(bounds.key)->name;
  if (i == fit->n) return zp_fail(err, ZP_BAD_INPUT, "calibrate.bounds: %s is not in calibrate.fit", name);
  const double start = fit->start[i], from = bounds.from / start, to = bounds.to / start;
  fit->lower[i] = fmin(from, to);
  fit->upper[i] = fmax(from, to);
  if (fit->lower[i] <= 1 && fit->upper[i] >= 1) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "calibrate.bounds: %s starts at %g %s, which is not within them", name, start,
                 zp_key(bounds.key)->unit);
}

static ZpStatus read_bounds(ZpFit *fit, ZpError *err) {
  char list[ZP_TEXT_SIZE], *rest = list;
  ZpStatus status = ZP_OK;
  memcpy(list, fit->def->calibrate.bounds, sizeof list);
  for (char *part = strsep(&rest, ";"); part && status == ZP_OK; part = strsep(&rest, ";"))
    if (part[strspn(part, " \t")]) status = set_bounds(fit, part, err);
  return status;
}

static ZpStatus add_key(ZpFit *fit, const char *name, ZpError *err) {
  int key = zp_key_find(name);
  if (key < 0)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %.80s: unknown key; did you mean %s?", name,
                   zp_key_nearest(name));
  if (!is_real(key))
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s: is not a real number and cannot be fitted", name);
  if (fit->n == ZP_FIT_MOST)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: more than %d keys; fit fewer at a time", ZP_FIT_MOST);
  for (int i = 0; i < fit->n; i++)
    if (fit->key[i] == key) return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is named twice", name);
  double start = zp_def_get(fit->def, key);
  if (isnan(start) || start == 0)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is %s: give a value to start from", name,
                   isnan(start) ? zp_key(key)->text : "0");
  fit->key[fit->n] = key;
  fit->start[fit->n] = start;
  find_bounds(fit, fit->n++);
  return ZP_OK;
}

/* "a, b" => keys. */
static ZpStatus read_keys(ZpFit *fit, ZpError *err) {
  char list[ZP_TEXT_SIZE], *rest = list;
  memcpy(list, fit->def->calibrate.fit, sizeof list);
  ZpStatus status = ZP_OK;
  if (strspn(list, " ") == strlen(list)) return ZP_OK; /* nothing is fitted: a comparison */
  for (char *name = strsep(&rest, ","); name && status == ZP_OK; name = strsep(&rest, ",")) {
    name += strspn(name, " ");
    name[strcspn(name, " ")] = 0;
    status = add_key(fit, name, err);
  }
  return status;
}

/* A column, by its name or, if that is empty, by its place. */
static ZpStatus find_column(const ZpData *data, const char *key, const char *name, int place, int *column,
                            ZpError *err) {
  *column = *name ? zp_data_column(data, name) : place < (int)data->columns ? place : -1;
  if (*column >= 0) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s = \"%.60s\": no such column in %.200s", key, name, data->path);
}

/* The key that a column header stands for and the unit, -1 if none. */
static int key_of_header(const ZpFit *fit, const char *name, double *factor, double *divisor) {
  if (zp_data_unit(name, "force", "N", factor, divisor) && fit->def->gravity > 0) { /* the weight of a load */
    *divisor *= fit->def->gravity;
    return zp_key_find("load.mass");
  }
  if (zp_data_unit(name, "load", "kg", factor, divisor)) return zp_key_find("load.mass");
  if (zp_data_unit(name, "voltage", "V", factor, divisor)) return zp_key_find("drive.voltage");
  for (int i = 0; i < zp_key_count(); i++)
    if (is_real(i) && zp_data_unit(name, zp_key(i)->name, zp_key(i)->unit, factor, divisor)) return i;
  return -1;
}

/* A column of numbers that set `key` (any number, if -1) => values [rows], SI. */
static ZpStatus read_column(const ZpFit *fit, const ZpData *data, int column, int key, double factor, double divisor,
                            double *values, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < fit->rows && status == ZP_OK; i++) {
    ZpActuatorDef scratch = *fit->def;
    status = zp_data_number(data, i, (size_t)column, &values[i], err);
    values[i] = values[i] * factor / divisor;
    if (status == ZP_OK && key >= 0) status = zp_def_set(&scratch, key, values[i], err);
  }
  return status;
}

/* A key that a column sets cannot be fitted as well, nor set by another column. */
static ZpStatus check_set(const ZpFit *fit, int key, const char *column, ZpError *err) {
  bool twice = fit->others > 0 && fit->x_key == key;
  for (int i = 0; i + 1 < fit->others; i++)
    twice |= fit->other_key[i] == key;
  if (twice)
    return zp_fail(err, ZP_BAD_INPUT, "data.file: column %.60s: another column sets %s as well", column,
                   zp_key(key)->name);
  for (int i = 0; i < fit->n; i++)
    if (fit->key[i] == key)
      return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is given by column %.60s and cannot be fitted",
                     zp_key(key)->name, column);
  return ZP_OK;
}

/* Times of one run must rise from 0 on. */
static ZpStatus check_times(const ZpFit *fit, const ZpData *data, ZpError *err) {
  for (size_t i = 0; i < fit->rows; i++) {
    int line;
    const char *path = zp_data_place(data, i, &line);
    if (!(fit->x[i] >= (i ? fit->x[i - 1] : 0)))
      return zp_fail(err, ZP_BAD_INPUT, "%.200s:%d: times must not be negative and must not decrease", path, line);
  }
  return ZP_OK;
}

static ZpStatus read_x(ZpFit *fit, const ZpData *data, int column, ZpError *err) {
  double factor, divisor;
  const char *name = data->cell[column];
  bool is_time = zp_data_unit(name, "time", "s", &factor, &divisor);
  fit->x_key = is_time ? -1 : key_of_header(fit, name, &factor, &divisor);
  if (!is_time && fit->x_key < 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "calibrate.x: column %.60s: is not time, load, force, voltage or a numeric key, with its unit",
                   name);
  ZpStatus status = check_set(fit, fit->x_key, name, err);
  if (status == ZP_OK) status = read_column(fit, data, column, fit->x_key, factor, divisor, fit->x, err);
  return status == ZP_OK && is_time ? check_times(fit, data, err) : status;
}

/* All other columns whose header is a key. */
static ZpStatus read_others(ZpFit *fit, const ZpData *data, int x, int y, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int column = 0; column < (int)data->columns && status == ZP_OK; column++) {
    double factor, divisor;
    const char *name = data->cell[column];
    int key = column == x || column == y ? -1 : key_of_header(fit, name, &factor, &divisor);
    if (key < 0) continue;
    if (fit->x_key < 0)
      return zp_fail(err, ZP_BAD_INPUT,
                     "%.200s: column %.60s: rows over time belong to one run, in which no key can change", data->path,
                     name);
    if (fit->others == ZP_FIT_OTHERS)
      return zp_fail(err, ZP_BAD_INPUT, "%.200s: more than %d columns set keys", data->path, ZP_FIT_OTHERS);
    fit->other_key[fit->others] = key;
    fit->other[fit->others] = calloc(fit->rows, sizeof(double));
    if (!fit->other[fit->others++]) return zp_fail_memory(err);
    status = check_set(fit, key, name, err);
    if (status == ZP_OK)
      status = read_column(fit, data, column, key, factor, divisor, fit->other[fit->others - 1], err);
  }
  return status;
}

/* One run in time, through all rows. */
static ZpStatus check_run(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_def_check_motion(def, err);
  if (status != ZP_OK) return status;
  return zp_def_check_voltage(def, fmax(def->drive.voltage, fabs(def->drive.offset)), err);
}

/* Rows must be possible ones: numbers of a study as the study says, others in their voltage. */
static ZpStatus check_row(const ZpFit *fit, const ZpActuatorDef *def, double voltage, ZpError *reason) {
  if (!zp_fit_number[fit->kind].number) return zp_def_check_voltage(def, voltage, reason);
  return zp_study_check(zp_fit_number[fit->kind].study, def, reason);
}

/* Study limits looks for pull-in and release up to drive.voltage. */
static ZpStatus check_limit(const ZpFit *fit, const ZpActuatorDef *def, size_t row, ZpError *reason) {
  bool is_limit = fit->kind == ZP_FIT_PULL_IN || fit->kind == ZP_FIT_RELEASE;
  if (!is_limit || fit->y[row] < def->drive.voltage) return ZP_OK;
  return zp_fail(reason, ZP_BAD_INPUT,
                 "a %s of %g V was measured; the model looks for it below drive.voltage = %g V: raise drive.voltage",
                 fit->kind == ZP_FIT_PULL_IN ? "pull-in voltage" : "release voltage", fit->y[row], def->drive.voltage);
}

static ZpStatus check_rows(const ZpFit *fit, const ZpData *data, ZpError *err) {
  double start[ZP_FIT_MOST], voltage;
  for (int k = 0; k < ZP_FIT_MOST; k++)
    start[k] = 1;
  if (fit->x_key < 0) return check_run(fit->def, err);
  for (size_t i = 0; i < fit->rows; i++) {
    ZpActuatorDef def;
    ZpError reason = {ZP_OK, ""};
    if (!zp_fit_row(fit, start, i, &def, &voltage)) continue; /* read_column has said it */
    if (check_row(fit, &def, voltage, &reason) == ZP_OK && check_limit(fit, &def, i, &reason) == ZP_OK) continue;
    int line;
    const char *path = zp_data_place(data, i, &line);
    return zp_fail(err, ZP_BAD_INPUT, "%.120s:%d: %.300s", path, line, reason.message);
  }
  return ZP_OK;
}

/* The standard deviations of what is measured, where a column has them: "sigma_mm". */
static ZpStatus read_sigma(ZpFit *fit, const ZpData *data, ZpError *err) {
  const char *unit = zp_fit_number[fit->kind].unit;
  double factor, divisor;
  size_t column = 0;
  while (column < data->columns && strncasecmp(data->cell[column], "sigma", 5) != 0)
    column++;
  if (column == data->columns || fit->rows == 0) return ZP_OK;
  if (!zp_data_unit(data->cell[column], "sigma", unit, &factor, &divisor))
    return zp_fail(err, ZP_BAD_INPUT, "data.file: column %.60s: not in a unit of what is measured, %s",
                   data->cell[column], unit);
  fit->sigma = calloc(fit->rows, sizeof *fit->sigma);
  if (!fit->sigma) return zp_fail_memory(err);
  for (size_t i = 0; i < fit->rows; i++) {
    int line;
    const char *path = zp_data_place(data, i, &line);
    ZpStatus status = zp_data_number(data, i, column, &fit->sigma[i], err);
    if (status != ZP_OK) return status;
    fit->sigma[i] = fit->sigma[i] * factor / divisor;
    if (!(fit->sigma[i] > 0))
      return zp_fail(err, ZP_BAD_INPUT, "%.200s:%d: column %.60s: a standard deviation must be above 0", path, line,
                     data->cell[column]);
  }
  return ZP_OK;
}

/* Whether a kind can be measured against what was set: over time only what a run shows; a weight is no force. */
static bool is_possible(const ZpFit *fit, ZpFitKind kind) {
  if (fit->x_key < 0) return !zp_fit_number[kind].number;
  return kind != ZP_FIT_FORCE || fit->x_key != zp_key_find("load.mass");
}

/* The kind of a column by its name, and the unit; false if it is none. */
static bool find_kind(ZpFit *fit, const char *name, double *factor, double *divisor) {
  fit->kind = ZP_FIT_LENGTH;
  fit->opening = zp_data_unit(name, "opening", "m", factor, divisor);
  for (int kind = 0; kind < ZP_FIT_KINDS && !fit->opening; kind++) {
    const ZpFitNumber *of = &zp_fit_number[kind];
    fit->kind = (ZpFitKind)kind;
    if (is_possible(fit, fit->kind) && zp_data_unit(name, of->column, of->unit, factor, divisor)) return true;
  }
  return fit->opening;
}

static ZpStatus read_y(ZpFit *fit, const ZpData *data, int column, ZpError *err) {
  double factor, divisor;
  const char *name = data->cell[column];
  if (!find_kind(fit, name, &factor, &divisor))
    return zp_fail(err, ZP_BAD_INPUT,
                   "calibrate.y: column %.60s: takes stroke, opening or capacitance with its unit; against a key, not "
                   "over time, also zip_time, pull_in_voltage, release_voltage or frequency; against a key that is not "
                   "the load, also force",
                   name);
  if (fit->opening && fit->def->actuator.kind != ZP_KIND_ELECTRO_RIBBON)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.y: column %.60s: only kind electro_ribbon has an opening", name);
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < fit->rows && status == ZP_OK; i++) {
    status = zp_data_number(data, i, (size_t)column, &fit->y[i], err);
    fit->y[i] = fit->y[i] * factor / divisor;
  }
  if (status == ZP_OK) status = read_sigma(fit, data, err);
  return status == ZP_OK ? check_rows(fit, data, err) : status;
}

static bool is_length(const char *name) {
  double factor, divisor;
  return zp_data_unit(name, "stroke", "m", &factor, &divisor) || zp_data_unit(name, "opening", "m", &factor, &divisor);
}

static bool is_force(const char *name) {
  double factor, divisor;
  return zp_data_unit(name, "force", "N", &factor, &divisor) || zp_data_unit(name, "load", "kg", &factor, &divisor);
}

static bool is_force_against_stroke(const ZpData *data, int x, int y) {
  return is_length(data->cell[x]) && is_force(data->cell[y]);
}

static ZpStatus read_data(ZpFit *fit, const ZpData *data, ZpError *err) {
  int x, y;
  const ZpActuatorDef *def = fit->def;
  fit->rows = data->rows;
  if (fit->rows < (size_t)fit->n || fit->rows == 0)
    return zp_fail(err, ZP_BAD_INPUT, "%.200s: %zu rows of data, fewer than the %d keys of calibrate.fit", data->path,
                   fit->rows, fit->n);
  fit->x = calloc(fit->rows, sizeof *fit->x);
  fit->y = calloc(fit->rows, sizeof *fit->y);
  if (!fit->x || !fit->y) return zp_fail_memory(err);
  ZpStatus status = find_column(data, "calibrate.x", def->calibrate.x, 0, &x, err);
  if (status == ZP_OK) status = find_column(data, "calibrate.y", def->calibrate.y, 1, &y, err);
  if (status == ZP_OK && is_force_against_stroke(data, x, y)) {
    int stroke = x; /* the model takes a force and gives a stroke, whichever of them was set on the bench */
    x = y;
    y = stroke;
  }
  if (status == ZP_OK) status = read_x(fit, data, x, err);
  if (status == ZP_OK) status = read_others(fit, data, x, y, err);
  return status == ZP_OK ? read_y(fit, data, y, err) : status;
}

ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err) {
  *fit = (ZpFit){.def = def, .err = err};
  if (*def->data.file == 0)
    return zp_fail(err, ZP_BAD_INPUT, "data.file: empty; study calibrate needs a CSV file of measurements");
  ZpStatus status = read_keys(fit, err);
  if (status == ZP_OK) status = read_bounds(fit, err);
  if (status != ZP_OK) return status;
  ZpData data;
  status = zp_data_read_all("data.file", def->data.file, def->data.columns, &data, err);
  if (status == ZP_OK) status = read_data(fit, &data, err);
  zp_data_destroy(&data);
  return status;
}
