/* A result as plain Python values, for pickle, and back. Names stay in the memory of Python: the owner of the result
 * must keep these values. */
#include "binding.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Beyond the size of any study: sizes from a damaged pickle must not overflow. */
enum { MOST = 1 << 24 };

/* -- packing --------------------------------------------------------------------------------------- */

static PyObject *pack_doubles(const double *value, size_t count) {
  return PyBytes_FromStringAndSize((const char *)value, (Py_ssize_t)(count * sizeof *value));
}

/* (rows, numbers); the getter returns the words of the columns */
static PyObject *pack_table(const ZpTable *table) {
  if (!table) Py_RETURN_NONE;
  return Py_BuildValue("(nN)", (Py_ssize_t)table->rows, pack_doubles(table->value, table->rows * table->columns));
}

/* (ribbons, nodes, members, frames, facing, stressed, numbers) */
static PyObject *pack_shapes(const ZpShapes *film) {
  if (!film) Py_RETURN_NONE;
  return Py_BuildValue("(nnnniiN)", (Py_ssize_t)film->ribbons, (Py_ssize_t)film->nodes, (Py_ssize_t)film->members,
                       (Py_ssize_t)film->frames, (int)film->facing, (int)film->stressed,
                       pack_doubles(film->value, film->frames * film->frame_size));
}

/* (nx, ny, numbers of five arrays) */
static PyObject *pack_map(const ZpFieldMap *map) {
  if (!map) Py_RETURN_NONE;
  size_t nodes = map->nx * map->ny, cells = (map->nx - 1) * (map->ny - 1);
  return Py_BuildValue("(nnNNNNN)", (Py_ssize_t)map->nx, (Py_ssize_t)map->ny, pack_doubles(map->x, nodes),
                       pack_doubles(map->y, nodes), pack_doubles(map->potential, nodes),
                       pack_doubles(map->strength, cells), pack_doubles(map->permittivity, cells));
}

/* The bytes of its snapshot */
static PyObject *pack_checkpoint(const ZpCheckpoint *checkpoint) {
  if (!checkpoint) Py_RETURN_NONE;
  return PyBytes_FromStringAndSize((const char *)checkpoint->byte, (Py_ssize_t)checkpoint->size);
}

PyObject *result_pack(const ZpResult *result) {
  return Py_BuildValue("(siiNNNN)", ZP_VERSION, (int)result->study, (int)result->outcome, pack_table(result->series),
                       pack_shapes(result->shapes), pack_map(result->map), pack_checkpoint(result->checkpoint));
}

/* -- unpacking ------------------------------------------------------------------------------------- */

static bool no_memory(void) {
  PyErr_NoMemory();
  return false;
}

/* Copy `count` doubles; false if the buffer has another size. */
static bool copy_doubles(PyObject *bytes, double *value, size_t count) {
  char *data;
  Py_ssize_t size;
  if (PyBytes_AsStringAndSize(bytes, &data, &size) || (size_t)size != count * sizeof *value) return false;
  memcpy(value, data, (size_t)size);
  return true;
}

static bool in_bounds(Py_ssize_t size, Py_ssize_t least) {
  return size >= least && size <= MOST;
}

/* (name, unit, help) of a column; the texts are borrowed. */
static bool read_column(const State *state, PyObject *words, ZpColumn *column) {
  const char **const texts[] = {&column->name, &column->unit, &column->help};
  if (!PyTuple_Check(words) || PyTuple_Size(words) != 3) return false;
  for (Py_ssize_t i = 0; i < 3; i++)
    if (!(*texts[i] = text_of(state, PyTuple_GetItem(words, i), "column"))) return false;
  return true;
}

static bool unpack_table(const State *state, PyObject *part, PyObject *words, Unpacked *to) {
  Py_ssize_t rows, columns;
  PyObject *numbers;
  if (part == Py_None) return true;
  if (!PyTuple_Check(words) || !PyArg_ParseTuple(part, "nO!", &rows, &PyBytes_Type, &numbers)) return false;
  columns = PyTuple_Size(words);
  if (!in_bounds(rows, 0) || !in_bounds(columns, 1)) return false;
  to->column = calloc((size_t)columns, sizeof *to->column);
  for (Py_ssize_t i = 0; to->column && i < columns; i++)
    if (!read_column(state, PyTuple_GetItem(words, i), &to->column[i])) return false;
  ZpTable *table = to->column ? zp_table_create(to->column, (size_t)columns, (size_t)rows + 2) : NULL;
  to->result->series = table;
  if (!table) return no_memory();
  table->rows = table->offered = (size_t)rows;
  return copy_doubles(numbers, table->value, table->rows * table->columns);
}

static bool unpack_shapes(PyObject *part, ZpResult *result) {
  Py_ssize_t ribbons, nodes, members, frames;
  int facing, stressed;
  PyObject *numbers;
  if (part == Py_None) return true;
  if (!PyArg_ParseTuple(part, "nnnnppO!", &ribbons, &nodes, &members, &frames, &facing, &stressed, &PyBytes_Type,
                        &numbers))
    return false;
  if (members < 1 || nodes % members != 0) return false;
  if (!in_bounds(nodes, 1) || !in_bounds(frames, 0) || ribbons < 1 || ribbons > 2) return false;
  ZpShapes *film = result->shapes = zp_shapes_create((size_t)ribbons, (size_t)nodes, (size_t)frames + 2);
  if (!film) return no_memory();
  film->frames = film->offered = (size_t)frames;
  film->members = (size_t)members;
  film->facing = facing != 0;
  film->stressed = stressed != 0;
  return copy_doubles(numbers, film->value, film->frames * film->frame_size);
}

static bool unpack_map(PyObject *part, ZpResult *result) {
  Py_ssize_t nx, ny;
  PyObject *array[5];
  if (part == Py_None) return true;
  if (!PyArg_ParseTuple(part, "nnOOOOO", &nx, &ny, &array[0], &array[1], &array[2], &array[3], &array[4])) return false;
  if (!in_bounds(nx, 2) || !in_bounds(ny, 2)) return false;
  ZpFieldMap *map = result->map = zp_field_map_create((size_t)nx, (size_t)ny);
  if (!map) return no_memory();
  size_t nodes = map->nx * map->ny, cells = (map->nx - 1) * (map->ny - 1);
  return copy_doubles(array[0], map->x, nodes) && copy_doubles(array[1], map->y, nodes) &&
         copy_doubles(array[2], map->potential, nodes) && copy_doubles(array[3], map->strength, cells) &&
         copy_doubles(array[4], map->permittivity, cells);
}

static bool unpack_checkpoint(PyObject *part, ZpResult *result) {
  if (part == Py_None) return true;
  char *bytes;
  Py_ssize_t size;
  if (PyBytes_AsStringAndSize(part, &bytes, &size)) return false;
  ZpStatus status = zp_checkpoint_from(bytes, (size_t)size, &result->checkpoint, NULL);
  return status == ZP_MACHINE ? no_memory() : status == ZP_OK;
}

/* (name, unit, value, timing) of each number; the texts are borrowed. */
static bool unpack_scalars(const State *state, PyObject *list, ZpResult *result) {
  if (!PyTuple_Check(list) || PyTuple_Size(list) > ZP_MAX_SCALARS) return false;
  for (Py_ssize_t i = 0; i < PyTuple_Size(list); i++) {
    ZpScalar *scalar = &result->scalar[i];
    PyObject *name, *unit;
    int timing;
    if (!PyArg_ParseTuple(PyTuple_GetItem(list, i), "UUdp", &name, &unit, &scalar->value, &timing)) return false;
    scalar->name = text_of(state, name, "number");
    scalar->unit = scalar->name ? text_of(state, unit, "unit") : NULL;
    if (!scalar->unit) return false;
    scalar->timing = timing != 0;
    result->scalars++;
  }
  return true;
}

/* (output, key, derivative) of each; the texts are borrowed. */
static bool unpack_sensitivities(const State *state, PyObject *list, ZpResult *result) {
  if (!PyTuple_Check(list) || PyTuple_Size(list) > ZP_MAX_SENSITIVITIES) return false;
  for (Py_ssize_t i = 0; i < PyTuple_Size(list); i++) {
    PyObject *output, *name;
    double value;
    if (!PyArg_ParseTuple(PyTuple_GetItem(list, i), "UUd", &output, &name, &value)) return false;
    const char *words = text_of(state, output, "output"), *key = words ? text_of(state, name, "key") : NULL;
    int index = key ? zp_key_find(key) : -1;
    if (index < 0) return false;
    zp_result_add_sensitivity(result, words, index, value);
  }
  return true;
}

static bool unpack_words(const State *state, PyObject *message, PyObject *notes, ZpResult *result) {
  const char *text = text_of(state, message, "message");
  if (!text || !PyTuple_Check(notes) || PyTuple_Size(notes) > ZP_MAX_NOTES) return false;
  snprintf(result->message, sizeof result->message, "%s", text);
  for (Py_ssize_t i = 0; i < PyTuple_Size(notes); i++) {
    text = text_of(state, PyTuple_GetItem(notes, i), "note");
    if (!text) return false;
    snprintf(result->note[result->notes++], sizeof result->note[0], "%s", text);
  }
  return true;
}

static bool unpack_parts(const State *state, PyObject *parts, PyObject *columns, Unpacked *to) {
  const char *version;
  int study, outcome;
  PyObject *series, *shapes, *map, *checkpoint;
  if (!PyArg_ParseTuple(parts, "siiOOOO", &version, &study, &outcome, &series, &shapes, &map, &checkpoint))
    return false;
  if (strcmp(version, ZP_VERSION) != 0)
    return raise_input(state, "result: pickled by zipact %.20s, but this is zipact %s", version, ZP_VERSION) != NULL;
  if (study < 0 || study >= ZpStudy_COUNT) return false;
  to->result->study = (ZpStudy)study;
  to->result->outcome = (ZpOutcome)outcome;
  return unpack_table(state, series, columns, to) && unpack_shapes(shapes, to->result) && unpack_map(map, to->result) &&
         unpack_checkpoint(checkpoint, to->result);
}

bool result_unpack(const State *state, PyObject *args, Unpacked *to) {
  PyObject *parts, *message, *notes, *scalars, *sensitivities, *columns;
  *to = (Unpacked){.result = zp_result_create((ZpStudy)0)};
  if (!to->result) return no_memory();
  bool done = PyArg_ParseTuple(args, "O!UO!O!O!O", &PyTuple_Type, &parts, &message, &PyTuple_Type, &notes,
                               &PyTuple_Type, &scalars, &PyTuple_Type, &sensitivities, &columns) &&
              unpack_words(state, message, notes, to->result) && unpack_scalars(state, scalars, to->result) &&
              unpack_sensitivities(state, sensitivities, to->result) && unpack_parts(state, parts, columns, to);
  to->words = done ? PyTuple_Pack(3, scalars, sensitivities, columns) : NULL;
  if (to->words) return true;
  if (!PyErr_Occurred()) raise_input(state, "result: damaged");
  zp_result_destroy(to->result);
  free(to->column);
  return false;
}
