/* Numbers in files as another program reads them (tests/read_back.py), against the result in memory: each value at its
 * place, with its name, unit and shape. The results are made up of numbers that are all different, so that no two can
 * be exchanged unnoticed; one is of an actual series. */
#include "files_util.h"

#include <jansson.h>

/* -- what was read ---------------------------------------------------------------------------------- */

static json_t *datasets; /* of results.h5, by path */
static size_t looked_at;

/* What the other program finds in the files. */
static json_t *read_back(void) {
  char command[512];
  json_error_t error;
  snprintf(command, sizeof command, ZP_PYTHON " " ZP_SOURCE_DIR "/tests/read_back.py %s", folder);
  FILE *pipe = popen(command, "r"); // NOLINT: the command is the test's own
  ck_assert_ptr_nonnull(pipe);
  json_t *found = json_loadf(pipe, 0, &error);
  ck_assert_int_eq(pclose(pipe), 0);
  ck_assert_msg(found != NULL, "%s", error.text);
  datasets = json_object_get(found, "results.h5");
  looked_at = 0;
  return found;
}

static void ck_same(const json_t *found, double expected, const char *what, size_t index) {
  if (isnan(expected))
    ck_assert_msg(json_is_null(found), "%s: value %zu should be missing", what, index);
  else
    ck_assert_msg(json_is_number(found) && json_number_value(found) == expected, "%s: value %zu is %.17g, not %.17g",
                  what, index, json_number_value(found), expected);
}

static void ck_text(const json_t *object, const char *name, const char *expected) {
  const char *found = json_string_value(json_object_get(object, name));
  ck_assert_msg(found && strcmp(found, expected) == 0, "%s: \"%s\", not \"%s\"", name, found ? found : "", expected);
}

/* A dataset "GROUP/NAME" with `unit`, of `rank` sizes => its values, one after the other. `help` may be NULL. */
static const json_t *values_of(const char *group, const char *name, const char *unit, const char *help, size_t rank,
                               const size_t *size) {
  char path[256];
  snprintf(path, sizeof path, "%s/%s", group, name);
  const json_t *set = json_object_get(datasets, path), *shape = json_object_get(set, "shape");
  ck_assert_msg(set != NULL, "no %s", path);
  if (unit) ck_text(set, "unit", unit);
  if (help) ck_text(set, "help", help);
  ck_assert_uint_eq(json_array_size(shape), rank);
  for (size_t i = 0; i < rank; i++)
    ck_assert_msg((size_t)json_integer_value(json_array_get(shape, i)) == size[i], "size %zu of %s", i, path);
  looked_at++;
  return json_object_get(set, "values");
}

static void check_all_were_looked_at(void) {
  const char *path;
  json_t *item;
  size_t sets = 0;
  json_object_foreach(datasets, path, item) {
    sets += json_object_get(item, "shape") != NULL;
  }
  ck_assert_uint_eq(sets, looked_at);
}

/* -- a run in results.h5 ----------------------------------------------------------------------------- */

static void check_series(const char *run, const ZpTable *table) {
  char group[64];
  snprintf(group, sizeof group, "%s/series", run);
  for (size_t c = 0; c < table->columns; c++) {
    const ZpColumn *column = &table->column[c];
    const json_t *values = values_of(group, column->name, column->unit, column->help, 1, &table->rows);
    for (size_t row = 0; row < table->rows; row++)
      ck_same(json_array_get(values, row), table->value[row * table->columns + c], column->name, row);
  }
}

/* A quantity of every node, [frame][ribbon][node], or of every pair of nodes, [frame][node]. */
typedef struct Quantity {
  const char *name, *unit;
  const double *(*of)(const ZpShape *shape);
} Quantity;

static const double *x_of(const ZpShape *shape) {
  return shape->x;
}
static const double *y_of(const ZpShape *shape) {
  return shape->y;
}
static const double *stress_of(const ZpShape *shape) {
  return shape->stress;
}
static const double *gap_of(const ZpShape *shape) {
  return shape->gap;
}
static const double *line_force_of(const ZpShape *shape) {
  return shape->line_force;
}
static const double *insulator_field_of(const ZpShape *shape) {
  return shape->insulator_field;
}
static const Quantity of_nodes[] = {{"x", "m", x_of}, {"y", "m", y_of}, {"stress", "Pa", stress_of}},
                      of_pairs[] = {{"gap", "m", gap_of},
                                    {"line_force", "N/m", line_force_of},
                                    {"insulator_field", "V/m", insulator_field_of}};

static void check_quantity(const char *group, const ZpShapes *shapes, const Quantity *quantity, bool of_pair) {
  const size_t ribbons = of_pair ? 1 : shapes->ribbons, nodes = shapes->nodes;
  const size_t three[] = {shapes->frames, ribbons, nodes}, two[] = {shapes->frames, nodes};
  const json_t *values = values_of(group, quantity->name, quantity->unit, NULL, of_pair ? 2 : 3, of_pair ? two : three);
  for (size_t f = 0, k = 0; f < shapes->frames; f++) {
    const ZpShape shape = zp_shapes_get(shapes, f);
    for (size_t r = 0; r < ribbons; r++)
      for (size_t n = 0; n < nodes; n++, k++)
        ck_same(json_array_get(values, k), quantity->of(&shape)[n * ribbons + r], quantity->name, k);
  }
}

static void check_shapes(const char *run, const ZpShapes *shapes, bool moves) {
  char group[64];
  snprintf(group, sizeof group, "%s/shapes", run);
  const json_t *time = values_of(group, "time", moves ? "s" : "1", NULL, 1, &shapes->frames),
               *voltage = values_of(group, "voltage", "V", NULL, 1, &shapes->frames),
               *zipped = values_of(group, "zipped", "1", NULL, 1, &shapes->frames);
  for (size_t f = 0; f < shapes->frames; f++) {
    const ZpShape shape = zp_shapes_get(shapes, f);
    ck_same(json_array_get(time, f), shape.time, "time", f);
    ck_same(json_array_get(voltage, f), shape.voltage, "voltage", f);
    ck_same(json_array_get(zipped, f), (double)shape.zipped, "zipped", f);
  }
  for (size_t k = 0; k < LENGTH_OF(of_nodes) - !shapes->stressed; k++)
    check_quantity(group, shapes, &of_nodes[k], false);
  for (size_t k = 0; k < LENGTH_OF(of_pairs) && shapes->facing; k++)
    check_quantity(group, shapes, &of_pairs[k], true);
}

static void check_map(const ZpFieldMap *map) {
  const size_t nodes[] = {map->nx, map->ny}, cells[] = {map->nx - 1, map->ny - 1};
  const struct {
    const char *name, *unit;
    const double *value;
    const size_t *size;
  } part[] = {{"x", "m", map->x, nodes},
              {"y", "m", map->y, nodes},
              {"potential", "V", map->potential, nodes},
              {"strength", "V/m", map->strength, cells},
              {"permittivity", "1", map->permittivity, cells}};
  for (size_t k = 0; k < LENGTH_OF(part); k++) {
    const json_t *values = values_of("/field", part[k].name, part[k].unit, NULL, 2, part[k].size);
    for (size_t i = 0; i < part[k].size[0] * part[k].size[1]; i++)
      ck_same(json_array_get(values, i), part[k].value[i], part[k].name, i);
  }
}

static void check_summary(const char *run, const ZpResult *result) {
  char group[64], path[192];
  snprintf(group, sizeof group, "%s/summary", run);
  ck_text(json_object_get(datasets, group), "outcome", zp_outcome_name(result->outcome));
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    snprintf(path, sizeof path, "%s/%s", group, scalar->name);
    if (scalar->timing) /* differs from run to run, and equal results are equal bytes */
      ck_assert_ptr_null(json_object_get(datasets, path));
    else
      ck_same(json_array_get(values_of(group, scalar->name, scalar->unit, NULL, 0, NULL), 0), scalar->value,
              scalar->name, 0);
  }
}

static void check_run(const char *run, const ZpResult *result, bool moves) {
  check_series(run, result->series);
  if (result->shapes) check_shapes(run, result->shapes, moves);
  if (result->map) check_map(result->map);
  check_summary(run, result);
}

/* -- files for ParaView and table.csv ---------------------------------------------------------------- */

/* A polyline for each ribbon of each member, the members one after the other along the ribbon's nodes. */
static void check_lines(const json_t *lines, const ZpShapes *shapes, const ZpShape *shape) {
  const size_t part = shapes->nodes / shapes->members;
  ck_assert_uint_eq(json_array_size(lines), shapes->ribbons * shapes->members);
  for (size_t l = 0; l < json_array_size(lines); l++) {
    const json_t *line = json_array_get(lines, l), *points = json_object_get(line, "points");
    const size_t ribbon = l / shapes->members, first = l % shapes->members * part;
    ck_assert_uint_eq(json_array_size(points), part);
    for (size_t i = 0; i < part; i++) {
      const size_t node = first + i, place = node * shapes->ribbons + ribbon;
      const json_t *point = json_array_get(points, i);
      ck_same(json_array_get(point, 0), shape->x[place], "x of a point", place);
      ck_same(json_array_get(point, 1), shape->y[place], "y of a point", place);
      ck_same(json_array_get(point, 2), 0, "z of a point", place);
      ck_same(json_array_get(json_object_get(line, "ribbon"), i), (double)ribbon, "ribbon", place);
      if (shape->stress)
        ck_same(json_array_get(json_object_get(line, "stress"), i), shape->stress[place], "stress", place);
      for (size_t k = 0; k < LENGTH_OF(of_pairs) && shape->gap; k++)
        ck_same(json_array_get(json_object_get(line, of_pairs[k].name), i), of_pairs[k].of(shape)[node],
                of_pairs[k].name, node);
    }
  }
}

static void check_frames(const json_t *frames, const ZpShapes *shapes) {
  ck_assert_uint_eq(json_array_size(frames), shapes->frames);
  for (size_t f = 0; f < shapes->frames; f++) {
    const ZpShape shape = zp_shapes_get(shapes, f);
    const json_t *frame = json_array_get(frames, f);
    ck_same(json_object_get(frame, "time"), shape.time, "timestep", f);
    check_lines(json_object_get(frame, "lines"), shapes, &shape);
  }
}

/* Cells of the field, those across the ribbons first; a cell (i, j) is between the nodes (i, j) and (i + 1, j + 1). */
static void check_cells(const json_t *cells, const ZpFieldMap *map) {
  ck_assert_uint_eq(json_array_size(cells), (map->nx - 1) * (map->ny - 1));
  for (size_t k = 0; k < json_array_size(cells); k++) {
    const size_t node = k / (map->ny - 1) * map->ny + k % (map->ny - 1);
    const size_t around[] = {node, node + 1, node + 1 + map->ny, node + map->ny};
    const json_t *cell = json_array_get(cells, k);
    ck_same(json_object_get(cell, "field_strength"), map->strength[k], "strength", k);
    ck_same(json_object_get(cell, "permittivity"), map->permittivity[k], "permittivity", k);
    for (size_t c = 0; c < LENGTH_OF(around); c++) {
      const json_t *corner = json_array_get(json_object_get(cell, "corners"), c);
      ck_same(json_array_get(corner, 0), map->x[around[c]], "x of a corner", k);
      ck_same(json_array_get(corner, 1), map->y[around[c]], "y of a corner", k);
      ck_same(json_array_get(json_object_get(cell, "potential"), c), map->potential[around[c]], "potential", k);
    }
  }
}

/* A cell of table.csv; a value that is missing is empty. */
static void ck_cell(const json_t *rows, size_t row, size_t column, double expected) {
  const char *text = json_string_value(json_array_get(json_array_get(rows, row + 1), column));
  ck_assert_ptr_nonnull(text);
  if (isnan(expected))
    ck_assert_str_eq(text, "");
  else
    ck_assert_msg(*text && strtod(text, NULL) == expected, "row %zu, column %zu: %s, not %.17g", row, column, text,
                  expected);
}

static void ck_head(const json_t *rows, size_t column, const char *name) {
  ck_assert_str_eq(json_string_value(json_array_get(json_array_get(rows, 0), column)), name);
}

static void check_table(const json_t *rows, const ZpTable *table) {
  ck_assert_uint_eq(json_array_size(rows), table->rows + 1);
  for (size_t c = 0; c < table->columns; c++) {
    ck_head(rows, c, table->column[c].name);
    for (size_t row = 0; row < table->rows; row++)
      ck_cell(rows, row, c, table->value[row * table->columns + c]);
  }
}

/* -- results -------------------------------------------------------------------------------------- */

/* A number unlike all others, of a `kind` of value at a place; every 37th is missing. */
static double made_up(size_t kind, size_t place) {
  return place % 37 == 36 ? (double)NAN : (double)(kind + 1) + (double)(place + 1) * 0x1p-20;
}

static void fill(double *value, size_t count, size_t kind, size_t start) {
  for (size_t i = 0; i < count; i++)
    value[i] = made_up(kind, start + i);
}

enum { RIBBONS = 2, NODES = 8, MEMBERS = 2, FRAMES = 5, ROWS = 50, ACROSS = 4, ALONG = 7 };

static ZpShapes *made_up_shapes(void) {
  ZpShapes *shapes = zp_shapes_create(RIBBONS, NODES, FRAMES);
  ck_assert_ptr_nonnull(shapes);
  shapes->members = MEMBERS;
  for (size_t f = 0; f < FRAMES; f++) {
    double node[3][RIBBONS * NODES], pair[3][NODES];
    for (size_t k = 0; k < 3; k++) {
      fill(node[k], RIBBONS * NODES, k, f * RIBBONS * NODES);
      fill(pair[k], NODES, 3 + k, f * NODES);
    }
    zp_shapes_offer(shapes, &(ZpShape){.time = 0.25 * (double)(f + 1),
                                       .voltage = 1000 + (double)f,
                                       .zipped = 3 * f,
                                       .x = node[0],
                                       .y = node[1],
                                       .stress = node[2],
                                       .gap = pair[0],
                                       .line_force = pair[1],
                                       .insulator_field = pair[2]});
  }
  return shapes;
}

static ZpFieldMap *made_up_map(void) {
  ZpFieldMap *map = zp_field_map_create(ALONG, ACROSS);
  ck_assert_ptr_nonnull(map);
  double *const part[] = {map->x, map->y, map->potential, map->strength, map->permittivity};
  for (size_t k = 0; k < LENGTH_OF(part); k++)
    for (size_t i = 0; i < (k < 3 ? ALONG * ACROSS : (ALONG - 1) * (ACROSS - 1)); i++)
      part[k][i] = 20 + (double)k + (double)i * 0x1p-20;
  return map;
}

static ZpResult *made_up_result(size_t number) {
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  double row[64];
  ZpResult *result = new_result(ZP_STUDY_ACTUATE);
  ck_assert_ptr_nonnull(result);
  result->outcome = ZP_ZIPPED;
  zp_result_add(result, "contraction", "1", 0.1 + (double)number);
  zp_result_add(result, "zip_time_s", "s", made_up(7, 36));
  zp_result_add_timing(result, "real_time_factor", "1", 0.01);
  zp_result_add(result, "steps", "count", 123456789);
  result->series = zp_table_create(column, columns, ROWS);
  for (size_t i = 0; i < ROWS; i++) {
    fill(row, columns, number, i * columns);
    zp_table_offer(result->series, row);
  }
  return result;
}

/* -- tests ---------------------------------------------------------------------------------------- */

TEST(run_reads_back) {
  ZpScenario *scenario = SCENARIO("mesh.nodes=9");
  ZpResult *result = made_up_result(11);
  result->shapes = made_up_shapes();
  result->map = made_up_map();
  write_files(scenario, &result, 1);
  json_t *found = read_back();
  ck_text(json_object_get(datasets, "/"), "study", "actuate");
  const char *text = json_string_value(json_array_get(values_of("", "scenario", NULL, NULL, 0, NULL), 0));
  ck_assert_ptr_nonnull(strstr(text, "nodes: 9\n"));
  check_run("", result, true);
  check_all_were_looked_at();
  check_frames(json_object_get(found, "shapes.pvd"), result->shapes);
  check_cells(json_object_get(found, "field.vts"), result->map);
  check_table(json_object_get(found, "table.csv"), result->series);
  json_decref(found);
  zp_result_destroy(result);
}

/* Both members of an actual series at rest, whose frames are numbered, not timed. */
TEST(series_at_rest_reads_back) {
  ZpScenario *scenario =
      SCENARIO("study=stationary", "mesh.nodes=9", "stack.series=2", "liquid.model=none", "output.errors=false");
  ZpActuatorDef def = {0};
  ck_ok(zp_scenario_def(scenario, 0, &def, &err));
  ZpResult *result = answer_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_uint_eq(result->shapes->members, 2);
  ck_assert(result->shapes->facing && result->shapes->stressed);
  write_files(scenario, &result, 1);
  json_t *found = read_back();
  values_of("", "scenario", NULL, NULL, 0, NULL);
  check_run("", result, false);
  check_all_were_looked_at();
  check_frames(json_object_get(found, "shapes.pvd"), result->shapes);
  json_decref(found);
  zp_result_destroy(result);
  zp_scenario_destroy(scenario);
}

/* A sweep of more cases than are written at a time: 41 densities of 25 voltages each. Some cases lack a number, one has
 * a number that no other has, and their orders differ. */
enum { DENSITIES = 41, VOLTAGES = 25, CASES = DENSITIES * VOLTAGES, SINGULAR = 700 };

static double density_of(size_t run) {
  return 7000 + 10 * (double)(run / VOLTAGES);
}
static double voltage_of(size_t run) {
  return 1000 + 100 * (double)(run % VOLTAGES);
}
static double contraction_of(size_t run) {
  return run % 3 == 1 ? (double)NAN : (double)run + 0.125;
}
static double steps_of(size_t run) {
  return run % 5 == 2 ? (double)NAN : 100000 + (double)run;
}
static double force_of(size_t run) {
  return run == SINGULAR ? 0.75 : (double)NAN;
}
static double outcome_of(size_t run) {
  return run % 7 == 3 ? ZP_DIVERGED : ZP_ZIPPED;
}

/* The number of a case, in order or the other way round; a NAN is missing. */
static ZpResult *result_of_case(size_t run) {
  ZpResult *result = new_result(ZP_STUDY_ACTUATE);
  ck_assert_ptr_nonnull(result);
  result->outcome = (ZpOutcome)outcome_of(run);
  if (run % 2 == 0 && !isnan(contraction_of(run))) zp_result_add(result, "contraction", "1", contraction_of(run));
  if (!isnan(steps_of(run))) zp_result_add(result, "steps", "count", steps_of(run));
  if (run % 2 == 1 && !isnan(contraction_of(run))) zp_result_add(result, "contraction", "1", contraction_of(run));
  if (run == SINGULAR) zp_result_add(result, "force_N", "N", force_of(run));
  return result;
}

typedef struct Column {
  const char *in_csv, *in_hdf5, *unit, *key;
  double (*of)(size_t run);
} Column;
static const Column columns[] = {
    {"ribbon.density_kg_per_m3", "ribbon.density_kg_per_m3", "kg/m3", "ribbon.density", density_of},
    {"drive.voltage_V", "drive.voltage_V", "V", "drive.voltage", voltage_of},
    {"outcome", "outcome", NULL, NULL, outcome_of},
    {"contraction", "contraction", "1", NULL, contraction_of},
    {"steps", "steps", "count", NULL, steps_of},
    {"force_N", "force_N", "N", NULL, force_of}};

static void check_column(const json_t *rows, size_t place) {
  const Column *column = &columns[place];
  const size_t size = CASES;
  const char *help = column->key ? zp_key(zp_key_find(column->key))->help : NULL;
  const json_t *values = values_of("/table", column->in_hdf5, column->unit, help, 1, &size);
  ck_head(rows, place, column->in_csv);
  for (size_t run = 0; run < CASES; run++) {
    const json_t *value = json_array_get(values, run);
    if (column->of == outcome_of) {
      const char *word = zp_outcome_name((ZpOutcome)outcome_of(run));
      ck_assert_str_eq(json_string_value(value), word);
      ck_assert_str_eq(json_string_value(json_array_get(json_array_get(rows, run + 1), place)), word);
    } else {
      ck_same(value, column->of(run), column->in_hdf5, run);
      ck_cell(rows, run, place, column->of(run));
    }
  }
}

TEST(sweep_of_1025_cases_reads_back) {
  static ZpResult *result[CASES];
  ZpScenario *scenario = SCENARIO("ribbon.density=7000 kg/m3 .. 7400 kg/m3 : 41", "drive.voltage=1 kV .. 3.4 kV : 25");
  ck_assert_uint_eq(zp_scenario_count(scenario), CASES);
  for (size_t run = 0; run < CASES; run++)
    result[run] = result_of_case(run);
  write_files(scenario, result, CASES);
  json_t *found = read_back(), *rows = json_object_get(found, "table.csv");
  ck_assert_uint_eq(json_array_size(rows), CASES + 1);
  ck_assert_uint_eq(json_array_size(json_array_get(rows, 0)), LENGTH_OF(columns));
  values_of("", "scenario", NULL, NULL, 0, NULL);
  for (size_t c = 0; c < LENGTH_OF(columns); c++)
    check_column(rows, c);
  check_all_were_looked_at(); /* so many cases keep no series of their own */
  json_decref(found);
}

/* Few cases keep their series, each its own. */
TEST(series_of_a_sweep_read_back) {
  ZpScenario *scenario = SCENARIO("drive.voltage=[6 kV, 8 kV]");
  ZpResult *result[] = {made_up_result(3), made_up_result(4)};
  const size_t size = LENGTH_OF(result);
  result[1]->outcome = ZP_DIVERGED;
  write_files(scenario, result, size);
  json_t *found = read_back();
  values_of("", "scenario", NULL, NULL, 0, NULL);
  const json_t *voltage = values_of("/table", "drive.voltage_V", "V", NULL, 1, &size);
  ck_same(json_array_get(voltage, 0), 6e3, "voltage", 0);
  ck_same(json_array_get(voltage, 1), 8e3, "voltage", 1);
  const char *const other[] = {"outcome", "contraction", "zip_time_s", "steps"};
  for (size_t i = 0; i < LENGTH_OF(other); i++)
    values_of("/table", other[i], NULL, NULL, 1, &size);
  check_run("/runs/0000", result[0], true);
  check_run("/runs/0001", result[1], true);
  check_all_were_looked_at();
  json_decref(found);
}
