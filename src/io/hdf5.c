/* results.h5: all numbers of a report with their units.
 *
 *   /scenario                        text of scenario.yaml
 *   one run:  /series/COLUMN         one dataset per column of the table
 *             /shapes/...            time, voltage, zipped [frame]; x, y [frame][ribbon][node];
 *                                    gap, line_force [frame][node]
 *             /likelihood/COLUMN, /regions/COLUMN   likewise of the further tables of a fit
 *             /field/...             x, y, potential [i][j] of nodes; strength, permittivity of the cells between
 *             /summary/SCALAR        what does not follow from wall time
 *   a sweep:  /table/COLUMN          as table.csv, one value per run
 *             /runs/0000/series, summary of each run, where its results keep their series
 *
 * HDF5 builds the file in memory and a ZpAtomic takes its bytes: HDF5 never meets a full disk, from which
 * it does not recover, and the reason is the system's own. Results are read once, in order: a block of rows of all
 * columns is in memory besides the file. Times of objects are not kept and every NaN
 * has the same bits, so the same numbers give the same bytes. */
#include <hdf5.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/table.h"
#include "io/file.h"
#include "io/guard.h"
#include "io/report.h"
#include "study/result.h"

/* Increment of the file in memory, bytes. */
#define GROWTH (1 << 20)

/* The target of datasets and the properties of new objects. A call that fails sets `bad`, after which nothing is done,
 * so the result is only checked at the end. */
typedef struct Store {
  hid_t file;
  hid_t plain; /* creation of datasets: no times */
  bool bad;
} Store;

static bool is_bad(Store *store, hid_t result) {
  if (result < 0) store->bad = true;
  return store->bad;
}

/* A string type for exactly this text. */
static hid_t text_type(const char *text) {
  hid_t type = H5Tcopy(H5T_C_S1);
  if (type < 0) return type;
  if (H5Tset_size(type, strlen(text) + 1) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0) return type;
  H5Tclose(type);
  return -1;
}

static void put_attribute(Store *store, hid_t object, const char *name, const char *text) {
  if (store->bad || !text) return;
  hid_t type = text_type(text), space = H5Screate(H5S_SCALAR);
  hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (!is_bad(store, attribute)) is_bad(store, H5Awrite(attribute, type, text));
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

/* A dataset of `rank` dimensions (0: a single value) without values, to be closed. */
static hid_t open_array(Store *store, hid_t group, const ZpColumn *meaning, hid_t disk, int rank, const hsize_t *size) {
  if (store->bad) return -1;
  hid_t space = rank ? H5Screate_simple(rank, size, NULL) : H5Screate(H5S_SCALAR);
  hid_t set = H5Dcreate2(group, meaning->name, disk, space, H5P_DEFAULT, store->plain, H5P_DEFAULT);
  is_bad(store, set);
  put_attribute(store, set, "unit", meaning->unit);
  put_attribute(store, set, "help", meaning->help);
  H5Sclose(space);
  return set;
}

/* One dataset from `value` of the type `memory`. */
static void put_array(Store *store, hid_t group, const ZpColumn *meaning, hid_t disk, hid_t memory, int rank,
                      const hsize_t *size, const void *value) {
  hid_t set = open_array(store, group, meaning, disk, rank, size);
  if (!store->bad) is_bad(store, H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, value));
  if (set >= 0) H5Dclose(set);
}

static void put_reals(Store *store, hid_t group, const ZpColumn *meaning, int rank, const hsize_t *size,
                      const double *value) {
  put_array(store, group, meaning, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, rank, size, value);
}

static void put_text(Store *store, hid_t group, const char *name, const char *text) {
  hid_t type = text_type(text);
  if (!is_bad(store, type)) put_array(store, group, &(ZpColumn){.name = name}, type, type, 0, NULL, text);
  H5Tclose(type);
}

static hid_t open_group(Store *store, hid_t parent, const char *name) {
  hid_t group = store->bad ? -1 : H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  is_bad(store, group);
  return group;
}

/* Memory for `count` doubles, at least one; on failure the store is bad. */
static double *numbers(Store *store, size_t count) {
  double *value = store->bad ? NULL : calloc(count + 1, sizeof *value);
  if (!value) store->bad = true;
  return value;
}

static double clean(double value) {
  return isnan(value) ? (double)NAN : value;
}

static void put_rows(Store *store, hid_t parent, const char *name, const ZpTable *table) {
  if (!table) return;
  hid_t group = open_group(store, parent, name);
  hsize_t rows = table->rows;
  double *value = numbers(store, table->rows);
  for (size_t i = 0; i < table->columns && !store->bad; i++) {
    for (size_t row = 0; row < table->rows; row++)
      value[row] = clean(table->value[row * table->columns + i]);
    put_reals(store, group, &table->column[i], 1, &rows, value);
  }
  free(value);
  H5Gclose(group);
}

/* Write time, voltage and number of closed pairs of each frame. */
static void put_frames(Store *store, hid_t group, const ZpShapes *shapes, ZpStudy study) {
  static const ZpColumn moment = {"time", "s", "time of the frame"},
                        mark = {"time", "1", "number of the frame's state"};
  const hsize_t size = shapes->frames;
  double *time = numbers(store, shapes->frames), *voltage = numbers(store, shapes->frames);
  long long *zipped = calloc(shapes->frames + 1, sizeof *zipped);
  if (!zipped) store->bad = true;
  for (size_t i = 0; i < shapes->frames && !store->bad; i++) {
    const ZpShape shape = zp_shapes_get(shapes, i);
    time[i] = clean(shape.time);
    voltage[i] = clean(shape.voltage);
    zipped[i] = (long long)shape.zipped;
  }
  put_reals(store, group, zp_study_shows(study) == ZP_SHOWS_motion ? &moment : &mark, 1, &size, time);
  put_reals(store, group, &(ZpColumn){"voltage", "V", "voltage between the electrodes"}, 1, &size, voltage);
  put_array(store, group, &(ZpColumn){"zipped", "1", "pairs 0 .. zipped are closed; the clip is pair 0"}, H5T_STD_I64LE,
            H5T_NATIVE_LLONG, 1, &size, zipped);
  free(time);
  free(voltage);
  free(zipped);
}

/* Write one quantity of all frames, ribbon after ribbon; nothing if the shapes do not have it. */
static void put_field(Store *store, hid_t group, const ZpShapes *shapes, const ZpShapeArray *field) {
  const size_t ribbons = field->of_nodes ? shapes->ribbons : 1, nodes = shapes->nodes;
  const hsize_t with_ribbons[] = {shapes->frames, ribbons, nodes}, without[] = {shapes->frames, nodes};
  const ZpShape first = zp_shapes_get(shapes, 0);
  if (!zp_shape_array(&first, field)) return;
  double *value = numbers(store, shapes->frames * ribbons * nodes), *next = value;
  for (size_t i = 0; i < shapes->frames && !store->bad; i++) {
    const ZpShape shape = zp_shapes_get(shapes, i);
    const double *from = zp_shape_array(&shape, field);
    for (size_t r = 0; r < ribbons; r++)
      for (size_t n = 0; n < nodes; n++)
        *next++ = clean(from[n * ribbons + r]);
  }
  put_reals(store, group, &(ZpColumn){field->name, field->unit, field->help}, field->of_nodes ? 3 : 2,
            field->of_nodes ? with_ribbons : without, value);
  free(value);
}

static void put_shapes(Store *store, hid_t parent, const ZpShapes *shapes, ZpStudy study) {
  if (!shapes) return;
  hid_t group = open_group(store, parent, "shapes");
  put_frames(store, group, shapes, study);
  for (const ZpShapeArray *field = zp_shape_arrays; field->name; field++)
    put_field(store, group, shapes, field);
  H5Gclose(group);
}

static void put_map(Store *store, hid_t parent, const ZpFieldMap *map) {
  if (!map) return;
  hid_t group = open_group(store, parent, "field");
  const hsize_t nodes[] = {map->nx, map->ny}, cells[] = {map->nx - 1, map->ny - 1};
  put_reals(
      store, group,
      &(ZpColumn){"x", "m", "horizontal position of a node, from the edge of the clip; [i][j], i along the ribbons"}, 2,
      nodes, map->x);
  put_reals(store, group, &(ZpColumn){"y", "m", "height of a node; [i][j]"}, 2, nodes, map->y);
  put_reals(store, group, &(ZpColumn){"potential", "V", "potential of a node; [i][j]"}, 2, nodes, map->potential);
  put_reals(store, group, &(ZpColumn){"strength", "V/m", "field strength in a cell; [i][j]"}, 2, cells, map->strength);
  put_reals(store, group, &(ZpColumn){"permittivity", "1", "relative permittivity of a cell, 0 in metal; [i][j]"}, 2,
            cells, map->permittivity);
  H5Gclose(group);
}

static void put_summary(Store *store, hid_t parent, const ZpResult *result) {
  hid_t group = open_group(store, parent, "summary");
  put_attribute(store, group, "outcome", zp_outcome_name(result->outcome));
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *s = &result->scalar[i];
    const double value = clean(s->value);
    if (!s->timing) put_reals(store, group, &(ZpColumn){.name = s->name, .unit = s->unit}, 0, NULL, &value);
  }
  H5Gclose(group);
}

static void put_run(Store *store, hid_t parent, const ZpResult *result) {
  put_rows(store, parent, "series", result->series);
  for (int k = 0; k < ZP_FURTHER; k++)
    put_rows(store, parent, zp_further_name[k], result->further[k]);
  put_shapes(store, parent, result->shapes, result->study);
  put_map(store, parent, result->map);
  put_summary(store, parent, result);
}

/* All outcomes have the same size, as required for an array of strings in HDF5. */
#define OUTCOME_SIZE 16

/* Number of rows that are written at a time. */
enum { BLOCK = 1024 };

/* The table of a sweep, in HDF5: a set per column, and one of the outcomes. */
typedef struct Columns {
  ZpCases cases;
  hid_t type, outcomes;
  hid_t *set;    /* [columns] */
  double *value; /* [columns][BLOCK] */
  char outcome[BLOCK][OUTCOME_SIZE];
} Columns;

static void open_columns(Store *store, hid_t group, Columns *c) {
  const hsize_t rows = c->cases.report->count;
  const ZpColumn outcome = {.name = "outcome", .help = "outcome of the run"};
  c->type = H5Tcopy(H5T_C_S1);
  if (!is_bad(store, c->type)) is_bad(store, H5Tset_size(c->type, OUTCOME_SIZE));
  for (size_t i = 0; i <= c->cases.columns; i++) {
    const ZpCaseColumn *column = &c->cases.column[i];
    if (i == c->cases.keys) c->outcomes = open_array(store, group, &outcome, c->type, 1, &rows);
    if (i < c->cases.columns)
      c->set[i] =
          open_array(store, group, &(ZpColumn){column->name, column->unit, column->help}, H5T_IEEE_F64LE, 1, &rows);
  }
}

/* Copy row `run` to row `place` of the block. */
static void take_row(Columns *c, size_t run, size_t place) {
  const ZpResult *result = zp_cases_read(&c->cases, run);
  for (size_t i = 0; i < c->cases.columns; i++)
    c->value[i * BLOCK + place] = clean(c->cases.value[i]);
  memset(c->outcome[place], 0, OUTCOME_SIZE);
  snprintf(c->outcome[place], OUTCOME_SIZE, "%s", zp_outcome_name(result->outcome));
}

static void put_block(Store *store, const Columns *c, size_t from, hsize_t rows) {
  const hsize_t all = c->cases.report->count, start = from;
  hid_t here = H5Screate_simple(1, &rows, NULL), there = H5Screate_simple(1, &all, NULL);
  if (!is_bad(store, there)) is_bad(store, H5Sselect_hyperslab(there, H5S_SELECT_SET, &start, NULL, &rows, NULL));
  for (size_t i = 0; i < c->cases.columns && !store->bad; i++)
    is_bad(store, H5Dwrite(c->set[i], H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, c->value + i * BLOCK));
  if (!store->bad) is_bad(store, H5Dwrite(c->outcomes, c->type, here, there, H5P_DEFAULT, c->outcome));
  H5Sclose(here);
  H5Sclose(there);
}

static void put_columns(Store *store, hid_t group, Columns *c) {
  const size_t count = c->cases.report->count;
  open_columns(store, group, c);
  for (size_t from = 0; from < count && !store->bad; from += BLOCK) {
    const size_t rows = count - from < BLOCK ? count - from : BLOCK;
    for (size_t i = 0; i < rows; i++)
      take_row(c, from + i, i);
    put_block(store, c, from, rows);
  }
  for (size_t i = 0; i < c->cases.columns; i++)
    if (c->set[i] > 0) H5Dclose(c->set[i]);
  if (c->outcomes > 0) H5Dclose(c->outcomes);
  H5Tclose(c->type);
}

static void put_table(Store *store, const ZpReport *report) {
  Columns *c = calloc(1, sizeof *c);
  hid_t group = open_group(store, store->file, "table");
  if (c && zp_cases_open(report, NULL, &c->cases)) {
    c->set = calloc(c->cases.columns + 1, sizeof *c->set);
    c->value = calloc((c->cases.columns + 1) * BLOCK, sizeof *c->value);
  }
  if (!c || !c->set || !c->value) store->bad = true;
  if (!store->bad) put_columns(store, group, c);
  if (c) {
    zp_cases_close(&c->cases);
    free(c->set);
    free(c->value);
  }
  free(c);
  H5Gclose(group);
}

static void put_runs(Store *store, const ZpReport *report) {
  hid_t runs = open_group(store, store->file, "runs");
  for (size_t i = 0; i < report->count; i++) {
    char name[32];
    snprintf(name, sizeof name, "%04zu", i);
    hid_t group = open_group(store, runs, name);
    put_run(store, group, zp_report_result(report, i));
    H5Gclose(group);
  }
  H5Gclose(runs);
}

static void put_all(Store *store, const ZpReport *report, const char *scenario) {
  const ZpResult *single = zp_report_single(report);
  put_text(store, store->file, "scenario", scenario);
  put_attribute(store, store->file, "study", zp_report_study(report));
  if (single) put_run(store, store->file, single);
  if (zp_report_is_sweep(report)) {
    put_table(store, report);
    if (zp_scenario_keeps_series(report->scenario)) put_runs(store, report);
  }
}

/* A file in memory only. HDF5 first checks whether a file of this name exists, so the name is an impossible one. */
static hid_t open_memory_file(void) {
  hid_t file = -1, access = H5Pcreate(H5P_FILE_ACCESS);
  if (access >= 0 && H5Pset_fapl_core(access, GROWTH, 0) >= 0)
    file = H5Fcreate("/dev/null/results.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  return file;
}

/* Write the bytes of the file, which HDF5 has in memory, to `out`; its commit reports write errors. False if HDF5
 * failed. */
static bool write_image(hid_t file, FILE *out) {
  void **image = NULL;
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) return false;
  const ssize_t size = H5Fget_file_image(file, NULL, 0);
  if (size <= 0 || H5Fget_vfd_handle(file, H5P_DEFAULT, (void **)&image) < 0) return false;
  fwrite(*image, 1, (size_t)size, out);
  return true;
}

/* HDF5 prints its own error stack to stderr unless this is disabled; the setting of the caller is restored. */
static bool build(const ZpReport *report, const char *scenario, FILE *out) {
  H5E_auto2_t print = NULL;
  void *data = NULL;
  bool saved = H5Eget_auto2(H5E_DEFAULT, &print, &data) >= 0;
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  Store store = {.file = open_memory_file(), .plain = H5Pcreate(H5P_DATASET_CREATE)};
  is_bad(&store, store.file);
  if (!is_bad(&store, store.plain)) is_bad(&store, H5Pset_obj_track_times(store.plain, false));
  put_all(&store, report, scenario);
  bool done = !store.bad && write_image(store.file, out);
  H5Pclose(store.plain);
  H5Fclose(store.file);
  if (saved) H5Eset_auto2(H5E_DEFAULT, print, data);
  return done;
}

/* Upper estimate of the bytes of the file in memory: for a sweep without series the table only. */
static size_t room_of(const ZpReport *report) {
  size_t numbers = 0, keys;
  zp_scenario_lists(report->scenario, &keys);
  if (report->count > 0 && zp_report_is_sweep(report) && !zp_scenario_keeps_series(report->scenario))
    return zp_report_room(0, report->count * (keys + 2 + zp_report_result(report, 0)->scalars));
  for (size_t i = 0; i < report->count; i++)
    numbers += zp_result_numbers(zp_report_result(report, i));
  return zp_report_room(report->count, numbers);
}

static ZpStatus build_guarded(const ZpReport *report, const char *scenario, FILE *out, ZpError *err) {
  ZpGuard guard;
  ZpStatus status = zp_guard_enter(&guard, "HDF5", room_of(report), err);
  if (status != ZP_OK) return status;
  bool done = build(report, scenario, out);
  zp_guard_leave(&guard);
  if (done) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "cannot create %s/results.h5: HDF5 could not build it in memory", report->directory);
}

ZpStatus zp_hdf5_write(const ZpReport *report, ZpError *err) {
  char *scenario;
  size_t size;
  ZpAtomic out;
  ZpStatus status = zp_scenario_text(report->scenario, &scenario, &size, err);
  if (status != ZP_OK) return status;
  status = zp_atomic_open(&out, report->directory, "results.h5", err);
  if (status == ZP_OK) status = zp_atomic_finish(&out, build_guarded(report, scenario, out.file, err), err);
  free(scenario);
  return status;
}

ZpStatus zp_hdf5_skip_exit(ZpError *err) {
  ZpGuard guard;
  ZpStatus status = zp_guard_enter(&guard, "HDF5", 1 << 16, err);
  if (status != ZP_OK) return status;
  H5dont_atexit();
  zp_guard_leave(&guard);
  return ZP_OK;
}
