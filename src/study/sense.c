#include "study/sense.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "drive/meter.h"
#include "rest/rest.h"

enum { MOST_SHAPES = 5000 };

/* Of one run. */
typedef struct Sensing {
  const ZpTable *trace, *path; /* of the run; of the equilibria */
  ZpMeter meter;
  ZpTable *readings;
  double zipped, released; /* when, s; INFINITY: never */
} Sensing;

static const ZpColumn columns[] = {
    {"time_s", "s", "end of the window of a reading"},
    {"capacitance_F", "F", "measured capacitance"},
    {"stroke_m", "m", "stroke at rest that has the measured capacitance"},
    {"true_capacitance_F", "F", "true capacitance in the middle of the window"},
    {"true_stroke_m", "m", "true stroke in the middle of the window"},
};
enum { TIME, CAPACITANCE, STROKE, TRUE_CAPACITANCE, TRUE_STROKE, COLUMNS };

bool zp_senses(const ZpActuatorDef *def) {
  return !isnan(def->sense.frequency);
}

ZpTable *zp_sense_trace(void) {
  enum { ROWS = 1 << 16 };
  size_t count;
  const ZpColumn *column = zp_trace_columns(&count);
  return zp_table_create(column, count, ROWS);
}

/* -- the trace ------------------------------------------------------------------------------------- */

/* The value of column `column` at time t in a table whose first column is the time; linear between rows. */
static double value_at(const ZpTable *table, double t, size_t column) {
  size_t low = 0, high = table->rows - 1, n = table->columns;
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    *(table->value[middle * n] <= t ? &low : &high) = middle;
  }
  const double *a = table->value + low * n, *b = table->value + high * n;
  double share = b[0] > a[0] ? fmin(fmax((t - a[0]) / (b[0] - a[0]), 0), 1) : 1;
  return a[column] + share * (b[column] - a[column]);
}

static double largest(const ZpTable *table, size_t column) {
  double most = 0;
  for (size_t k = 0; k < table->rows; k++)
    most = fmax(most, fabs(table->value[k * table->columns + column]));
  return most;
}

/* The readings of all windows that the run contains, which may have begun after 0. */
static bool read_all(Sensing *s) {
  static const double rounding = 1e-12;
  const ZpTable *trace = s->trace;
  size_t rows = trace->rows, n = trace->columns;
  double window = zp_meter_window(&s->meter), start = trace->value[0], end = trace->value[(rows - 1) * n];
  size_t first = (size_t)ceil(start / window * (1 - rounding)), last = (size_t)floor(end / window * (1 + rounding));
  size_t windows = last > first ? last - first : 0;
  double *block = zp_calloc(3 * rows + windows + 1, sizeof *block);
  s->readings = zp_table_create(columns, COLUMNS, windows > 2 ? windows : 2);
  if (!block || !s->readings) {
    zp_free(block);
    return false;
  }
  double *capacitance = block + 3 * rows;
  for (size_t k = 0; k < rows; k++) {
    block[k] = trace->value[k * n + ZP_TRACE_TIME];
    block[rows + k] = trace->value[k * n + ZP_TRACE_CHARGE];
    block[2 * rows + k] = trace->value[k * n + ZP_TRACE_CAPACITANCE];
  }
  ZpMeterTrace of = {rows, block, block + rows, block + 2 * rows};
  zp_meter_read(&s->meter, &of, first, windows, capacitance);
  for (size_t w = 0; w < windows; w++) {
    double from = (double)(first + w) * window, middle = from + 0.5 * window;
    zp_table_offer(s->readings, (double[COLUMNS]){[TIME] = from + window,
                                                  [CAPACITANCE] = capacitance[w],
                                                  [TRUE_CAPACITANCE] = value_at(trace, middle, ZP_TRACE_CAPACITANCE),
                                                  [TRUE_STROKE] = value_at(trace, middle, ZP_TRACE_STROKE)});
  }
  zp_free(block);
  return true;
}

/* -- the inverse ----------------------------------------------------------------------------------- */

/* A part of the path of equilibria that comes as near to a capacitance as any. */
typedef struct Near {
  double miss;   /* F */
  double stroke; /* m */
} Near;

/* On the piece between two rows. */
static Near nearest_on(double C, double C0, double C1, double stroke0, double stroke1) {
  double share = C1 != C0 ? fmin(fmax((C - C0) / (C1 - C0), 0), 1) : 0;
  return (Near){fabs(C - C0 - share * (C1 - C0)), stroke0 + share * (stroke1 - stroke0)};
}

/* The stroke of the equilibrium with this capacitance; if there are several, that of the actuator's branch, the nearest
 * to `last`. */
static double stroke_of(const ZpTable *path, double C, double last) {
  static const double alike = 1e-17; /* F */
  Near best = {INFINITY, NAN};
  for (size_t k = 0; k + 1 < path->rows; k++) {
    if (zp_table_get(path, k, "branch") != zp_table_get(path, k + 1, "branch")) continue;
    Near here = nearest_on(C, zp_table_get(path, k, "capacitance_F"), zp_table_get(path, k + 1, "capacitance_F"),
                           zp_table_get(path, k, "stroke_m"), zp_table_get(path, k + 1, "stroke_m"));
    bool tie = fabs(here.miss - best.miss) <= alike, nearer = fabs(here.stroke - last) < fabs(best.stroke - last);
    if (here.miss < best.miss - alike || (tie && nearer)) best = here;
  }
  return best.stroke;
}

static void invert(Sensing *s) {
  double last = s->trace->value[ZP_TRACE_STROKE];
  for (size_t k = 0; k < s->readings->rows; k++) {
    double *row = s->readings->value + k * COLUMNS;
    last = row[STROKE] = stroke_of(s->path, row[CAPACITANCE], last);
  }
}

/* -- results -------------------------------------------------------------------------------------- */

/* Root mean square of the error of the stroke in windows whose middle is in a time, m; NAN: there are none. */
static double rms_error(const Sensing *s, double from, double to) {
  double sum = 0, count = 0;
  for (size_t k = 0; k < s->readings->rows; k++) {
    const double *row = s->readings->value + k * COLUMNS;
    double middle = row[TIME] - 0.5 * zp_meter_window(&s->meter), off = row[STROKE] - row[TRUE_STROKE];
    if (middle < from || middle >= to) continue;
    sum += off * off;
    count++;
  }
  return count > 0 ? sqrt(sum / count) : NAN;
}

static double rms_capacitance(const Sensing *s) {
  double sum = 0;
  for (size_t k = 0; k < s->readings->rows; k++) {
    const double *row = s->readings->value + k * COLUMNS;
    double off = row[CAPACITANCE] - row[TRUE_CAPACITANCE];
    sum += off * off;
  }
  return s->readings->rows ? sqrt(sum / (double)s->readings->rows) : NAN;
}

/* When the voltage has fallen to half of its largest for good after the zip, s. */
static double released_at(const ZpTable *trace, double zipped) {
  double most = largest(trace, ZP_TRACE_VOLTAGE), t = INFINITY;
  for (size_t k = trace->rows; k-- > 0;) {
    const double *row = trace->value + k * trace->columns;
    if (fabs(row[ZP_TRACE_VOLTAGE]) > 0.5 * most || row[0] <= zipped) break;
    t = row[0];
  }
  return t;
}

static void summarize(const Sensing *s, ZpResult *result) {
  double all = rms_error(s, 0, INFINITY), range = largest(s->trace, ZP_TRACE_STROKE);
  zp_result_add(result, "sense_window_s", "s", zp_meter_window(&s->meter));
  zp_result_add(result, "sense_capacitance_error_F", "F", rms_capacitance(s));
  zp_result_add(result, "sense_stroke_error_m", "m", all);
  zp_result_add(result, "sense_stroke_error", "1", range > 0 ? all / range : NAN);
  zp_result_add(result, "sense_zip_error_m", "m", rms_error(s, 0, s->zipped));
  zp_result_add(result, "sense_hold_error_m", "m", rms_error(s, s->zipped, s->released));
  zp_result_add(result, "sense_release_error_m", "m", rms_error(s, s->released, INFINITY));
}

/* Each row gets the reading of the last window that has ended by then. */
static void fill_columns(const Sensing *s, ZpTable *series) {
  size_t next = 0, at_capacitance = 0, at_stroke = 0;
  for (size_t c = 0; c < series->columns; c++) {
    if (strcmp(series->column[c].name, "sensed_capacitance_F") == 0) at_capacitance = c;
    if (strcmp(series->column[c].name, "sensed_stroke_m") == 0) at_stroke = c;
  }
  for (size_t k = 0; k < series->rows; k++) {
    double *row = series->value + k * series->columns;
    while (next < s->readings->rows && s->readings->value[next * COLUMNS + TIME] <= row[0])
      next++;
    const double *reading = next > 0 ? s->readings->value + (next - 1) * COLUMNS : NULL;
    row[at_capacitance] = reading ? reading[CAPACITANCE] : NAN;
    row[at_stroke] = reading ? reading[STROKE] : NAN;
  }
}

/* The equilibria up to the largest voltage of the run, of ribbons that have not yielded. With the field their shapes
 * are those of the plates law, up to a somewhat higher voltage: shapes of one stroke hardly differ, and a field for
 * each of a path's steps would take minutes. */
static ZpStatus find_path(const ZpTask *task, const ZpModel *model, ZpResult **path, ZpError *err) {
  static const double beyond = 1.1;
  ZpActuatorDef def = *task->def, fresh = zp_actuator_def_default();
  def.drive = fresh.drive;
  def.drive.voltage = zp_waveform_largest(&model->waveform);
  def.source = fresh.source;
  def.sense = fresh.sense;
  def.control = fresh.control;
  def.setpoint = fresh.setpoint;
  def.sensitivity = fresh.sensitivity;
  def.initial = fresh.initial;
  def.insulator.resistivity = def.medium.resistivity = NAN;
  def.ribbon.plasticity = false;
  def.ribbon.hardening_modulus = fresh.ribbon.hardening_modulus;
  def.lower.ribbon.hardening_modulus = fresh.lower.ribbon.hardening_modulus;
  def.output.errors = false;
  def.output.shapes = MOST_SHAPES;
  if (def.electro.model == ZP_ELECTRO_FIELD) def.drive.voltage *= beyond;
  def.electro.model = ZP_ELECTRO_PLATES;
  return zp_study_run(ZP_STUDY_EQUILIBRIUM, &def, NULL, task->hooks, path, err);
}

/* The field's capacitance of one shape, F. */
static double capacitance_of(ZpRest *rest, const ZpShape *shape, double *force) {
  const ZpModel *model = rest->statics.member->model;
  ZpStaticSystem system = zp_statics_system(&rest->statics);
  memcpy(rest->statics.member->q, shape->x, model->count * sizeof(double));
  memcpy(zp_forces(model, rest->statics.member->q).y, shape->y, model->count * sizeof(double));
  rest->statics.U = shape->voltage;
  bool solved = !system.refresh || system.refresh(&rest->statics) == ZP_END_FOUND;
  return solved && system.residual(&rest->statics, force, NULL) == ZP_END_FOUND ? zp_statics_capacitance(&rest->statics)
                                                                                : NAN;
}

/* The path by the field: of each row the ratio of the field's capacitance to that of the plates law. */
typedef struct FieldPath {
  ZpRest *rest;
  const ZpResult *path;
  double *ratio, *force;
  size_t capacitance, branch; /* columns */
} FieldPath;

static double *cell(const FieldPath *p, size_t row, size_t column) {
  return &p->path->series->value[row * p->path->series->columns + column];
}

static void solve_row(FieldPath *p, size_t row) {
  ZpShape shape = zp_shapes_get(p->path->shapes, row);
  p->ratio[row] = capacitance_of(p->rest, &shape, p->force) / *cell(p, row, p->capacitance);
}

/* Row k of the line through two solved ones. */
static double on_line(const FieldPath *p, size_t from, size_t to, size_t k) {
  double share = (double)(k - from) / (double)(to - from);
  return p->ratio[from] + share * (p->ratio[to] - p->ratio[from]);
}

static void interpolate(FieldPath *p, size_t from, size_t to) {
  for (size_t k = from + 1; k < to; k++)
    p->ratio[k] = on_line(p, from, to, k);
}

/* The rows between two solved ones. The ratio is smooth along a branch, so it is linear where the row in the middle
 * lies on the line. */
static void refine(FieldPath *p, size_t from, size_t to) {
  enum { LONGEST = 32 }; /* rows that one row in the middle may speak for */
  static const double straight = 3e-4;
  size_t middle = (from + to) / 2;
  if (middle == from) return;
  solve_row(p, middle);
  double off = p->ratio[middle] - on_line(p, from, to, middle);
  if (to - from <= LONGEST && fabs(off) < straight * p->ratio[middle]) {
    interpolate(p, from, middle);
    interpolate(p, middle, to);
  } else {
    refine(p, from, middle);
    refine(p, middle, to);
  }
}

/* The rows of one branch from `first` whose capacitance is within the range of the readings => the row after them. */
static size_t take_branch(FieldPath *p, size_t first, size_t rows, const double range[2]) {
  size_t end = first;
  while (end < rows && *cell(p, end, p->branch) == *cell(p, first, p->branch) &&
         *cell(p, end, p->capacitance) > range[0] && *cell(p, end, p->capacitance) < range[1])
    end++;
  if (end == first) return first + 1;
  solve_row(p, first);
  if (end - 1 > first) solve_row(p, end - 1);
  refine(p, first, end - 1);
  for (size_t k = first; k < end; k++)
    *cell(p, k, p->capacitance) *= p->ratio[k];
  return end;
}

static size_t column_named(const ZpTable *table, const char *name) {
  size_t column = 0;
  while (strcmp(table->column[column].name, name) != 0)
    column++;
  return column;
}

/* The path's capacitances by the field, as far as readings come near them. */
static bool take_field(const Sensing *s, const ZpModel *model, const ZpResult *path) {
  static const double near = 2;
  ZpRest rest;
  size_t rows = path->series->rows < path->shapes->frames ? path->series->rows : path->shapes->frames;
  double range[2] = {INFINITY, 0}, *block = zp_calloc(2 * zp_coordinates(model) + rows, sizeof *block);
  bool opened = zp_rest_open(&rest, model, NULL, NULL) && block;
  for (size_t k = 0; k < s->readings->rows; k++) {
    double C = s->readings->value[k * COLUMNS + CAPACITANCE];
    range[0] = fmin(range[0], C / near);
    range[1] = fmax(range[1], C * near);
  }
  FieldPath p = {&rest,
                 path,
                 block,
                 block ? block + rows : NULL,
                 column_named(path->series, "capacitance_F"),
                 column_named(path->series, "branch")};
  for (size_t k = 0; opened && k < rows;)
    k = take_branch(&p, k, rows, range);
  zp_rest_close(&rest);
  zp_free(block);
  return opened;
}

ZpStatus zp_sense(const ZpTask *task, const ZpModel *model, const ZpTable *trace, ZpResult *result, ZpError *err) {
  ZpResult *path = NULL;
  ZpStatus status = find_path(task, model, &path, err);
  if (status != ZP_OK) return status;
  double zipped = zp_result_get(result, "zip_time_s");
  Sensing s = {.trace = trace, .path = path->series, .zipped = isfinite(zipped) ? zipped : INFINITY};
  s.released = released_at(trace, s.zipped);
  s.meter = zp_meter_of(task->def, largest(trace, ZP_TRACE_CAPACITANCE));
  bool read = trace->rows > 1 && path->series->rows > 1 && read_all(&s);
  if (read && task->def->electro.model == ZP_ELECTRO_FIELD) read = take_field(&s, model, path);
  if (read) {
    invert(&s);
    summarize(&s, result);
    fill_columns(&s, result->series);
  } else
    status = zp_fail_memory(err);
  zp_table_destroy(s.readings);
  zp_result_destroy(path);
  return status;
}
