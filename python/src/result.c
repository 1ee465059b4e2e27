/* A result of a study, as plain Python values and buffers. */
#include "binding.h"

#include <string.h>

typedef struct Result {
  PyObject_HEAD State *state;
  ZpResult *result;
  PyObject *names; /* bytes that hold the names of an unpacked result; otherwise NULL */
} Result;

PyObject *result_new(State *state, ZpResult *found) {
  Result *self = PyObject_New(Result, state->result);
  if (!self) {
    zp_result_destroy(found);
    return NULL;
  }
  self->state = state;
  self->result = found;
  self->names = NULL;
  return (PyObject *)self;
}

PyObject *unpack_result(PyObject *module, PyObject *bytes) {
  State *state = PyModule_GetState(module);
  char *data;
  Py_ssize_t size;
  ZpResult *result;
  ZpError err;
  if (!PyBytes_Check(bytes)) return raise_input(state, "result: takes the bytes that pack() returned");
  if (PyBytes_AsStringAndSize(bytes, &data, &size)) return NULL;
  if (zp_result_load(data, (size_t)size, &result, &err) != ZP_OK) return raise_error(state, &err);
  Result *self = (Result *)result_new(state, result);
  if (self) self->names = Py_NewRef(bytes);
  return (PyObject *)self;
}

static void result_dealloc(PyObject *object) {
  Result *self = (Result *)object;
  zp_result_destroy(self->result);
  Py_XDECREF(self->names);
  free_object(object);
}

static const ZpResult *of(PyObject *object) {
  return ((Result *)object)->result;
}

/* -- words and numbers ------------------------------------------------------------------------------ */

static PyObject *get_study(PyObject *self, void *unused) {
  (void)unused;
  return text_from(zp_study_name(zp_result_study(of(self))));
}

static PyObject *get_outcome(PyObject *self, void *unused) {
  (void)unused;
  return text_from(zp_outcome_name(zp_result_outcome(of(self))));
}

static PyObject *get_good(PyObject *self, void *unused) {
  (void)unused;
  return PyBool_FromLong(zp_outcome_good(zp_result_outcome(of(self))));
}

static PyObject *get_message(PyObject *self, void *unused) {
  (void)unused;
  return text_from(zp_result_message(of(self)));
}

static PyObject *get_notes(PyObject *self, void *unused) {
  (void)unused;
  const ZpResult *result = of(self);
  PyObject *list = PyTuple_New((Py_ssize_t)zp_result_notes(result));
  for (size_t i = 0; list && i < zp_result_notes(result); i++) {
    PyObject *text = text_from(zp_result_note_text(result, i));
    if (!text || PyTuple_SetItem(list, (Py_ssize_t)i, text)) Py_CLEAR(list);
  }
  return list;
}

static PyObject *get_scalars(PyObject *self, void *unused) {
  (void)unused;
  const ZpResult *result = of(self);
  PyObject *list = PyTuple_New((Py_ssize_t)zp_result_scalars(result));
  for (size_t i = 0; list && i < zp_result_scalars(result); i++) {
    const ZpScalar *scalar = zp_result_scalar(result, i);
    PyObject *item =
        Py_BuildValue("(ssdN)", scalar->name, scalar->unit, scalar->value, PyBool_FromLong(scalar->timing));
    if (!item || PyTuple_SetItem(list, (Py_ssize_t)i, item)) Py_CLEAR(list);
  }
  return list;
}

/* -- arrays ---------------------------------------------------------------------------------------- */

PyObject *columns_of(const ZpTable *table) {
  PyObject *columns = PyTuple_New((Py_ssize_t)zp_table_columns(table));
  for (size_t i = 0; columns && i < zp_table_columns(table); i++) {
    const ZpColumn *column = zp_table_column(table, i);
    PyObject *item = Py_BuildValue("(sss)", column->name, column->unit, column->help);
    if (!item || PyTuple_SetItem(columns, (Py_ssize_t)i, item)) Py_CLEAR(columns);
  }
  return columns;
}

/* (its columns, rows) */
static PyObject *get_series(PyObject *self, void *unused) {
  (void)unused;
  const ZpTable *table = zp_result_series(of(self));
  if (!table) Py_RETURN_NONE;
  PyObject *columns = columns_of(table);
  if (!columns) return NULL;
  PyObject *rows = view_of_rows(((Result *)self)->state, self, zp_table_row(table, 0), zp_table_rows(table),
                                zp_table_columns(table));
  return Py_BuildValue("(NN)", columns, rows);
}

/* An array over all frames of a film, by node (2 dimensions) or by node and ribbon (3); None if `first`, the array of
 * the first frame, is NULL. */
static PyObject *film(PyObject *self, const double *first, int ndim) {
  if (!first) Py_RETURN_NONE;
  const ZpShapes *shapes = zp_result_shapes(of(self));
  Py_ssize_t shape[] = {(Py_ssize_t)zp_shapes_frames(shapes), (Py_ssize_t)zp_shapes_nodes(shapes),
                        ndim == 3 ? (Py_ssize_t)zp_shapes_ribbons(shapes) : 1};
  Py_ssize_t size = sizeof(double);
  Py_ssize_t strides[] = {(Py_ssize_t)zp_shapes_stride(shapes) * size, shape[2] * size, size};
  return view_new(((Result *)self)->state, self, first, ndim, shape, strides);
}

/* (time, voltage, zipped) of each frame. */
static PyObject *frame_heads(const ZpShapes *shapes) {
  PyObject *list = PyTuple_New((Py_ssize_t)zp_shapes_frames(shapes));
  for (size_t i = 0; list && i < zp_shapes_frames(shapes); i++) {
    ZpShape shape = zp_shapes_get(shapes, i);
    PyObject *item = Py_BuildValue("(ddn)", shape.time, shape.voltage, (Py_ssize_t)shape.zipped);
    if (!item || PyTuple_SetItem(list, (Py_ssize_t)i, item)) Py_CLEAR(list);
  }
  return list;
}

static PyObject *get_shapes(PyObject *self, void *unused) {
  (void)unused;
  const ZpShapes *shapes = zp_result_shapes(of(self));
  if (!shapes || zp_shapes_frames(shapes) == 0) Py_RETURN_NONE;
  ZpShape first = zp_shapes_get(shapes, 0);
  return Py_BuildValue("{snsNsNsNsNsNsNsN}", "members", (Py_ssize_t)zp_shapes_members(shapes), "heads",
                       frame_heads(shapes), "x", film(self, first.x, 3), "y", film(self, first.y, 3), "gap",
                       film(self, first.gap, 2), "line_force", film(self, first.line_force, 2), "insulator_field",
                       film(self, first.insulator_field, 2), "stress", film(self, first.stress, 3));
}

static PyObject *get_field(PyObject *self, void *unused) {
  (void)unused;
  const ZpFieldMap *map = zp_result_map(of(self));
  if (!map) Py_RETURN_NONE;
  State *state = ((Result *)self)->state;
  size_t nx = map->nx, ny = map->ny;
  return Py_BuildValue("{sNsNsNsNsN}", "x", view_of_rows(state, self, map->x, nx, ny), "y",
                       view_of_rows(state, self, map->y, nx, ny), "potential",
                       view_of_rows(state, self, map->potential, nx, ny), "strength",
                       view_of_rows(state, self, map->strength, nx - 1, ny - 1), "permittivity",
                       view_of_rows(state, self, map->permittivity, nx - 1, ny - 1));
}

/* -- with a scenario ------------------------------------------------------------------------------- */

/* The scenario of this text; NULL with an error of Python's. */
static ZpScenario *scenario_of(State *state, PyObject *text) {
  const char *words = text_of(state, text, "scenario");
  ZpScenario *scenario = words ? zp_scenario_create() : NULL;
  ZpError err;
  if (!scenario) return words ? (ZpScenario *)PyErr_NoMemory() : NULL;
  if (zp_scenario_parse(scenario, words, strlen(words), "scenario", &err) == ZP_OK) return scenario;
  zp_scenario_destroy(scenario);
  return (ZpScenario *)raise_error(state, &err);
}

/* Keys as the scenario calls them. */
static PyObject *result_sensitivities(PyObject *self, PyObject *text) {
  const ZpResult *result = of(self);
  const size_t count = zp_result_sensitivities(result);
  ZpScenario *scenario = count > 0 ? scenario_of(((Result *)self)->state, text) : NULL;
  if (count > 0 && !scenario) return NULL;
  PyObject *list = PyTuple_New((Py_ssize_t)count);
  for (size_t i = 0; list && i < count; i++) {
    const ZpSensitivity *s = zp_result_sensitivity(result, i);
    char key[ZP_SCENARIO_KEY_SIZE];
    PyObject *item = Py_BuildValue("(ssd)", s->output, zp_scenario_key(scenario, s->key, key), s->value);
    if (!item || PyTuple_SetItem(list, (Py_ssize_t)i, item)) Py_CLEAR(list);
  }
  zp_scenario_destroy(scenario);
  return list;
}

/* -- files ----------------------------------------------------------------------------------------- */

/* Keeps the interpreter lock, because HDF5 does not support several threads. */
static PyObject *result_save(PyObject *object, PyObject *args) {
  Result *self = (Result *)object;
  PyObject *directory, *text, *folder;
  if (!PyArg_ParseTuple(args, "UUU", &directory, &text, &folder)) return NULL;
  const char *where = text_of(self->state, directory, "directory");
  const char *templates = where ? text_of(self->state, folder, "templates") : NULL;
  ZpScenario *scenario = templates ? scenario_of(self->state, text) : NULL;
  if (!scenario) return NULL;
  const ZpReport report = {.directory = where,
                           .scenario = scenario,
                           .result = &self->result,
                           .count = 1,
                           .wall_time = zp_result_get(self->result, "wall_time_s"),
                           .templates = *templates ? templates : NULL};
  ZpError err;
  const ZpStatus status = zp_report_write(&report, NULL, &err);
  zp_scenario_destroy(scenario);
  if (status != ZP_OK) return raise_error(self->state, &err);
  Py_RETURN_NONE;
}

static PyObject *result_pack(PyObject *self, PyObject *unused) {
  (void)unused;
  PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)zp_result_save(of(self), NULL));
  if (bytes) zp_result_save(of(self), PyBytes_AsString(bytes));
  return bytes;
}

static PyGetSetDef getters[] = {
    {"study", get_study, NULL, "Name of the study.", NULL},
    {"outcome", get_outcome, NULL, "Outcome: a word.", NULL},
    {"good", get_good, NULL, "Whether the run completed; false if the solver failed or the run was interrupted.", NULL},
    {"message", get_message, NULL, "One sentence about the outcome.", NULL},
    {"notes", get_notes, NULL, "Notes: sentences about breakdown, yield, and limits of the model and of the mesh.",
     NULL},
    {"scalars", get_scalars, NULL, "(name, unit, value, follows from wall time) of each number.", NULL},
    {"series", get_series, NULL, "((name, unit, help) of each column, rows), or None.", NULL},
    {"shapes", get_shapes, NULL, "Arrays of a film of shapes, or None.", NULL},
    {"field", get_field, NULL, "Arrays of a map of the field, or None.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};
static PyMethodDef methods[] = {
    {"sensitivities", result_sensitivities, METH_O,
     "sensitivities(scenario): (output, key as the scenario calls it, derivative) of each derivative."},
    {"save", result_save, METH_VARARGS, "save(directory, scenario, templates): write the files of the command."},
    {"pack", result_pack, METH_NOARGS, "Everything as bytes, for unpack_result."},
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {
    {Py_tp_doc, "Result of a study."},
    {Py_tp_dealloc, result_dealloc},
    {Py_tp_getset, getters},
    {Py_tp_methods, methods},
    {0, NULL},
};
PyType_Spec result_spec = {"zipact._zipact.Result", sizeof(Result), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};
