#include "study/sense.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/instances.h"
#include "drive/meter.h"
#include "rest/rest.h"

enum { MOST_SHAPES = 5000, NAME = 2 * ZP_NAME_SIZE };

/* Names of a port in columns and numbers: "left.", "members.#." and "left"; of the only port ""
 * and NULL. */
typedef struct Naming {
  char column[NAME];
  const char *number, *member;
  char room[ZP_NAME_SIZE];
} Naming;

/* Of one run and one port. */
typedef struct Sensing {
  const ZpTable *trace, *path; /* of the run; of the equilibria, NULL: the readings tell no stroke */
  Naming named;
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

static bool is_metered(const ZpModel *lead) {
  return !isnan(lead->def.sense.frequency);
}

bool zp_senses(const ZpModel *first) {
  bool any = false;
  for (const ZpModel *model = first; model < first + first->members; model++)
    any |= is_metered(model);
  return any;
}

bool zp_sense_begin(ZpSim *sim) {
  enum { ROWS = 1 << 16 };
  size_t count;
  const ZpColumn *column = zp_trace_columns(&count);
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    if (!is_metered(m->model)) continue;
    zp_sim_trace(m, zp_table_create(column, count, ROWS));
    if (!m->trace) return false;
  }
  return true;
}

void zp_sense_end(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    zp_table_destroy(m->trace);
    zp_sim_trace(m, NULL);
  }
}

/* Has each port its own names? */
static bool has_own_names(const ZpModel *first) {
  return zp_is_network(first) || zp_has_ports(first);
}

static void name(const ZpSim *sim, const ZpSim *lead, Naming *named) {
  *named = (Naming){.number = ""};
  if (!has_own_names(sim->model)) return;
  const bool network = zp_is_network(sim->model);
  named->member = zp_member_called(sim->model->whole, lead->model->number + 1, named->room);
  named->number = network ? "members.#." : "member_#_";
  snprintf(named->column, sizeof named->column, network ? "%s." : "member_%s_", named->member);
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

static double *cell(const ZpTable *table, size_t row, size_t column) {
  return &table->value[row * table->columns + column];
}

static size_t column_named(const ZpTable *table, const char *before, const char *name) {
  char whole[2 * NAME];
  size_t column = 0;
  snprintf(whole, sizeof whole, "%s%s", before, name);
  while (strcmp(table->column[column].name, whole) != 0)
    column++;
  return column;
}

/* Columns of the path: what the meter reads, and what it tells. */
typedef struct Inverse {
  const ZpTable *path;
  size_t branch, capacitance, stroke;
} Inverse;

static Inverse inverse_of(const Sensing *s) {
  return (Inverse){s->path, column_named(s->path, "", "branch"),
                   column_named(s->path, s->named.column, "capacitance_F"),
                   column_named(s->path, s->named.column, "stroke_m")};
}

/* The stroke of the equilibrium with this capacitance; if there are several, that of the actuator's branch, the nearest
 * to `last`. */
static double stroke_of(const Inverse *by, double C, double last) {
  static const double alike = 1e-17; /* F */
  const ZpTable *path = by->path;
  Near best = {INFINITY, NAN};
  for (size_t k = 0; k + 1 < path->rows; k++) {
    if (*cell(path, k, by->branch) != *cell(path, k + 1, by->branch)) continue;
    Near here = nearest_on(C, *cell(path, k, by->capacitance), *cell(path, k + 1, by->capacitance),
                           *cell(path, k, by->stroke), *cell(path, k + 1, by->stroke));
    bool tie = fabs(here.miss - best.miss) <= alike, nearer = fabs(here.stroke - last) < fabs(best.stroke - last);
    if (here.miss < best.miss - alike || (tie && nearer)) best = here;
  }
  return best.stroke;
}

static void invert(Sensing *s) {
  double last = s->trace->value[ZP_TRACE_STROKE];
  const Inverse by = s->path ? inverse_of(s) : (Inverse){0};
  for (size_t k = 0; k < s->readings->rows; k++) {
    double *row = s->readings->value + k * COLUMNS;
    last = row[STROKE] = s->path ? stroke_of(&by, row[CAPACITANCE], last) : (double)NAN;
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

static void add(const Sensing *s, ZpResult *result, const char *number, const char *unit, double value) {
  char pattern[NAME];
  snprintf(pattern, sizeof pattern, "%s%s", s->named.number, number);
  zp_result_add_of(result, pattern, s->named.member, unit, value);
}

static void summarize(const Sensing *s, ZpResult *result) {
  double all = rms_error(s, 0, INFINITY), range = largest(s->trace, ZP_TRACE_STROKE);
  add(s, result, "sense_window_s", "s", zp_meter_window(&s->meter));
  add(s, result, "sense_capacitance_error_F", "F", rms_capacitance(s));
  if (!s->path) return;
  add(s, result, "sense_stroke_error_m", "m", all);
  add(s, result, "sense_stroke_error", "1", range > 0 ? all / range : NAN);
  add(s, result, "sense_zip_error_m", "m", rms_error(s, 0, s->zipped));
  add(s, result, "sense_hold_error_m", "m", rms_error(s, s->zipped, s->released));
  add(s, result, "sense_release_error_m", "m", rms_error(s, s->released, INFINITY));
}

/* Each row gets the reading of the last window that has ended by then. */
static void fill_columns(const Sensing *s, ZpTable *series) {
  size_t next = 0;
  const size_t at_capacitance = column_named(series, s->named.column, "sensed_capacitance_F"),
               at_stroke = column_named(series, s->named.column, "sensed_stroke_m");
  for (size_t k = 0; k < series->rows; k++) {
    double *row = series->value + k * series->columns;
    while (next < s->readings->rows && s->readings->value[next * COLUMNS + TIME] <= row[0])
      next++;
    const double *reading = next > 0 ? s->readings->value + (next - 1) * COLUMNS : NULL;
    row[at_capacitance] = reading ? reading[CAPACITANCE] : NAN;
    row[at_stroke] = reading ? reading[STROKE] : NAN;
  }
}

/* A port keeps its voltage alone. */
static ZpStatus leave_voltage(ZpActuatorDef *def, int lead, ZpError *err) {
  const int scaled = zp_key_of_instance(ZP_KEY(member_K.drive.scaled), lead);
  const double scales = zp_def_get(def, scaled);
  ZpStatus status =
      zp_instances_take_away(def, lead, ZP_KEY(member_K.drive.waveform), ZP_KEY(member_K.setpoint.duty), err);
  return status == ZP_OK ? zp_instances_set(def, scaled, scales, err) : status; /* which makes it a port */
}

/* Nothing drives, measures or controls: in equilibria all voltages rise together. */
static ZpStatus leave_voltages(ZpActuatorDef *def, ZpError *err) {
  const ZpActuatorDef fresh = zp_actuator_def_default();
  ZpStatus status = ZP_OK;
  for (int k = 1; k <= zp_def_members(def) && status == ZP_OK; k++)
    if (zp_def_port(def, k) == k) status = leave_voltage(def, k, err);
  def->drive = fresh.drive;
  def->source = fresh.source;
  def->sense = fresh.sense;
  def->control = fresh.control;
  def->setpoint = fresh.setpoint;
  return status;
}

/* The value of drive.voltage of all at which each port has at least the largest voltage of the run, V. */
static double highest(const ZpModel *first) {
  double most = 0;
  for (const ZpModel *model = first; model < first + first->members; model++) {
    const double alone = zp_waveform_largest(&model->waveform);
    if (!zp_leads_port(model) || (model->apart && model->ratio == 0)) continue;
    most = fmax(most, model->apart ? alone / model->ratio : alone);
  }
  return most;
}

/* The equilibria up to the largest voltage of the run, of ribbons that have not yielded. With the field their shapes
 * are those of the plates law, up to a somewhat higher voltage: shapes of one stroke hardly differ, and a field for
 * each of a path's steps would take minutes. */
static ZpStatus find_path(const ZpTask *task, const ZpModel *model, ZpResult **path, ZpError *err) {
  static const double beyond = 1.1;
  ZpActuatorDef def = {0}, fresh = zp_actuator_def_default();
  ZpStatus status = zp_def_assign(&def, task->def, err);
  if (status == ZP_OK) status = leave_voltages(&def, err);
  def.drive.voltage = highest(model);
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
  if (status == ZP_OK) status = zp_study_run(ZP_STUDY_EQUILIBRIUM, &def, NULL, task->hooks, path, err);
  zp_def_clear(&def);
  return status;
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

static void solve_row(FieldPath *p, size_t row) {
  ZpShape shape = zp_shapes_get(p->path->shapes, row);
  p->ratio[row] = capacitance_of(p->rest, &shape, p->force) / *cell(p->path->series, row, p->capacitance);
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
  while (end < rows && *cell(p->path->series, end, p->branch) == *cell(p->path->series, first, p->branch) &&
         *cell(p->path->series, end, p->capacitance) > range[0] &&
         *cell(p->path->series, end, p->capacitance) < range[1])
    end++;
  if (end == first) return first + 1;
  solve_row(p, first);
  if (end - 1 > first) solve_row(p, end - 1);
  refine(p, first, end - 1);
  for (size_t k = first; k < end; k++)
    *cell(p->path->series, k, p->capacitance) *= p->ratio[k];
  return end;
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
                 column_named(path->series, "", "capacitance_F"),
                 column_named(path->series, "", "branch")};
  for (size_t k = 0; opened && k < rows;)
    k = take_branch(&p, k, rows, range);
  zp_rest_close(&rest);
  zp_free(block);
  return opened;
}

/* Does a reading of the port tell a stroke: of its only member, or of a whole stack? */
static bool tells_stroke(const ZpSim *sim, const ZpSim *lead) {
  return zp_sim_next(lead) == 0 || !has_own_names(sim->model);
}

/* The meter of one port. False if there is no memory. */
static bool sense_port(const ZpTask *task, const ZpSim *sim, const ZpSim *lead, const ZpResult *path,
                       ZpResult *result) {
  Sensing s = {.trace = lead->trace, .path = path && tells_stroke(sim, lead) ? path->series : NULL};
  name(sim, lead, &s.named);
  const double zipped = s.named.member ? lead->state->zip_time : zp_result_get(result, "zip_time_s");
  s.zipped = isfinite(zipped) ? zipped : INFINITY;
  s.released = released_at(s.trace, s.zipped);
  s.meter = zp_meter_of(&lead->model->def, largest(s.trace, ZP_TRACE_CAPACITANCE));
  bool read = s.trace->rows > 1 && (!s.path || s.path->rows > 1) && read_all(&s);
  if (read && s.path && task->def->electro.model == ZP_ELECTRO_FIELD) read = take_field(&s, sim->model, path);
  if (read) {
    invert(&s);
    summarize(&s, result);
    fill_columns(&s, result->series);
  }
  zp_table_destroy(s.readings);
  return read;
}

ZpStatus zp_sense(const ZpTask *task, const ZpSim *sim, ZpResult *result, ZpError *err) {
  ZpResult *path = NULL;
  ZpStatus status = ZP_OK;
  for (const ZpSim *m = sim; m < sim + sim->members && !path && status == ZP_OK; m++)
    if (m->trace && tells_stroke(sim, m)) status = find_path(task, sim->model, &path, err);
  for (const ZpSim *m = sim; m < sim + sim->members && status == ZP_OK; m++)
    if (m->trace && !sense_port(task, sim, m, path, result)) status = zp_fail_memory(err);
  zp_result_destroy(path);
  return status;
}
