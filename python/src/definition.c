/* Python values => a checked definition, and back; its studies. */
#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* -- values --------------------------------------------------------------------------------------- */

static bool is_number_key(int key) {
  ZpKeyType type = zp_key(key)->type;
  return type == ZP_KEY_REAL || type == ZP_KEY_REAL_AUTO || type == ZP_KEY_INT;
}

/* A finite number other than True and False: a float, an int or a scalar of numpy. */
static bool is_plain_number(PyObject *object, double *value) {
  if (PyUnicode_Check(object) || PyBool_Check(object) || !PyNumber_Check(object)) return false;
  PyObject *number = PyNumber_Float(object);
  *value = number ? PyFloat_AsDouble(number) : NAN;
  Py_XDECREF(number);
  PyErr_Clear();
  return isfinite(*value);
}

/* A value that is not a number is passed as a text to the parser of the library, which has the best message. */
int number_of(const State *state, int key, PyObject *object, double *value) {
  if (is_number_key(key) && is_plain_number(object, value)) return 0;
  PyObject *text = PyObject_Str(object);
  char name[ZP_KEY_NAME_SIZE];
  const char *words = text ? text_of(state, text, zp_key_name(key, name)) : NULL;
  ZpError err;
  int status = -1;
  if (words) {
    status = zp_value_parse(key, words, value, &err) == ZP_OK ? 0 : -1;
    if (status) raise_error(state, &err);
  }
  Py_XDECREF(text);
  return status;
}

/* Messages start with the name of the key. */
static int fail_renamed(const State *state, int key, const char *name, const ZpError *err) {
  char own[ZP_KEY_NAME_SIZE];
  raise_input(state, "%s%s", name, err->message + strlen(zp_key_name(key, own)));
  return -1;
}

int quantity_of(const State *state, int key, const char *name, PyObject *object, double *value) {
  const ZpKey *of = zp_key(key);
  ZpError err;
  if (PyFloat_CheckExact(object)) {
    *value = PyFloat_AsDouble(object);
    if (*value >= of->min && *value <= of->max) return 0;
  } else if (PyUnicode_Check(object)) {
    const char *words = text_of(state, object, name);
    if (!words) return -1;
    return zp_value_parse(key, words, value, &err) == ZP_OK ? 0 : fail_renamed(state, key, name, &err);
  } else if (!is_plain_number(object, value)) {
    raise_input(state, "%s: not a finite number", name);
    return -1;
  }
  ZpActuatorDef *scratch = zp_def_create();
  ZpStatus status = zp_def_set(scratch, key, *value, &err);
  zp_def_destroy(scratch);
  if (status == ZP_MACHINE) raise_error(state, &err);
  return status == ZP_OK ? 0 : status == ZP_MACHINE ? -1 : fail_renamed(state, key, name, &err);
}

static int key_of(const State *state, PyObject *name) {
  const char *words = text_of(state, name, "key");
  int key = words ? zp_key_find(words) : -1;
  if (words && key < 0) {
    char reason[256];
    zp_key_unknown(words, reason, sizeof reason);
    raise_input(state, "%.80s: %s", words, reason);
  }
  return key;
}

/* -- creation ------------------------------------------------------------------------------------- */

static int set_text(const State *state, ZpActuatorDef *def, int key, PyObject *value) {
  ZpError err;
  ZpStatus status;
  if (!PyUnicode_Check(value)) {
    status = zp_def_set(def, key, 0, &err); /* reports that it takes a text */
  } else {
    const char *words = text_of(state, value, zp_key(key)->name);
    if (!words) return -1;
    status = zp_def_set_text(def, key, words, &err);
  }
  if (status == ZP_OK) return 0;
  raise_error(state, &err);
  return -1;
}

/* The key of the scenario that is not part of the Def. */
static bool is_study(int key) {
  return key == zp_key_find("study");
}

/* The dictionary `values` => assignments and the study; their number, or -1. Converting a value to a text may run
 * Python code, but no other code has access to this dictionary. */
static Py_ssize_t assignments(const State *state, PyObject *values, ZpAssignment *list, ZpStudy *study) {
  Py_ssize_t place = 0, used = 0;
  PyObject *name, *value;
  while (PyDict_Next(values, &place, &name, &value)) {
    int key = key_of(state, name);
    if (key < 0) return -1;
    if (zp_key(key)->type == ZP_KEY_TEXT) continue;
    double number;
    if (number_of(state, key, value, &number)) return -1;
    if (is_study(key))
      *study = (ZpStudy)number;
    else
      list[used++] = (ZpAssignment){key, number};
  }
  return used;
}

static int set_texts(const State *state, PyObject *values, ZpActuatorDef *def) {
  Py_ssize_t place = 0;
  PyObject *name, *value;
  while (PyDict_Next(values, &place, &name, &value)) {
    int key = key_of(state, name);
    if (key < 0 || (zp_key(key)->type == ZP_KEY_TEXT && set_text(state, def, key, value))) return -1;
  }
  return 0;
}

static int resolve(const State *state, PyObject *values, ZpStudy *study, ZpActuatorDef *def) {
  ZpAssignment *list = calloc((size_t)PyDict_Size(values) + 1, sizeof *list);
  ZpError err = {.status = ZP_MACHINE, .message = "no memory"};
  Py_ssize_t count = list ? assignments(state, values, list, study) : 0;
  ZpStatus status = list && count >= 0 ? zp_def_resolve(def, list, (size_t)count, &err) : err.status;
  free(list);
  if (count < 0) return -1;
  if (status == ZP_OK && set_texts(state, values, def)) return -1;
  if (status == ZP_OK) status = zp_study_check(*study, def, &err);
  if (status == ZP_OK) return 0;
  raise_error(state, &err);
  return -1;
}

/* The doubles of a one-dimensional buffer, copied. */
static double *copy_doubles(const State *state, PyObject *array, size_t *count) {
  Py_buffer buffer;
  if (PyObject_GetBuffer(array, &buffer, PyBUF_CONTIG_RO | PyBUF_FORMAT)) return NULL;
  double *copy = NULL;
  if (buffer.ndim != 1 || !buffer.format || strcmp(buffer.format, "d") != 0) {
    raise_input(state, "drive: takes two arrays of numbers, times and voltages");
  } else {
    *count = (size_t)buffer.shape[0];
    copy = malloc((size_t)buffer.len + 1);
    if (copy)
      memcpy(copy, buffer.buf, (size_t)buffer.len);
    else
      PyErr_NoMemory();
  }
  PyBuffer_Release(&buffer);
  return copy;
}

/* `drive`: a tuple of two buffers, times and voltages. */
static int take_drive(Definition *self, PyObject *drive) {
  PyObject *time, *voltage;
  if (!PyArg_ParseTuple(drive, "OO", &time, &voltage)) return -1;
  size_t rows, others;
  self->drive.time = copy_doubles(self->state, time, &rows);
  self->drive.voltage = self->drive.time ? copy_doubles(self->state, voltage, &others) : NULL;
  if (!self->drive.voltage) return -1;
  self->drive.rows = rows;
  size_t row;
  const char *fault = rows == others ? zp_drive_table_fault(&self->drive, &row) : NULL;
  if (rows != others)
    raise_input(self->state, "drive: %zu times, but %zu voltages", rows, others);
  else if (zp_def_number(self->def, "initial.state") == ZP_INITIAL_CHECKPOINT)
    raise_input(self->state, "initial.state = checkpoint: requires drive.table or drive.file instead of arrays");
  else if (fault)
    raise_input(self->state, "drive: row %zu: %s", row + 1, fault);
  return PyErr_Occurred() ? -1 : 0;
}

static PyObject *definition_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
  (void)kwargs;
  State *state = state_of_type(type);
  PyObject *values, *drive = NULL;
  if (!state || !PyArg_ParseTuple(args, "O!|O!", &PyDict_Type, &values, &PyTuple_Type, &drive)) return NULL;
  Definition *self = (Definition *)((allocfunc)PyType_GetSlot(type, Py_tp_alloc))(type, 0);
  if (!self) return NULL;
  self->state = state;
  self->def = zp_def_create();
  PyObject *own = PyDict_Copy(values);
  if (!own || resolve(state, own, &self->study, self->def) || (drive && take_drive(self, drive))) Py_CLEAR(self);
  Py_XDECREF(own);
  return (PyObject *)self;
}

static void definition_dealloc(PyObject *object) {
  Definition *self = (Definition *)object;
  zp_def_destroy(self->def);
  free((void *)self->drive.time);
  free((void *)self->drive.voltage);
  free_object(object);
}

/* -- scenarios ------------------------------------------------------------------------------------ */

static PyObject *definitions_of(State *state, const ZpScenario *scenario) {
  PyObject *list = PyList_New(0);
  for (size_t row = 0; list && row < zp_scenario_count(scenario); row++) {
    Definition *definition =
        (Definition *)((allocfunc)PyType_GetSlot(state->definition, Py_tp_alloc))(state->definition, 0);
    ZpError err;
    bool good = definition != NULL;
    if (good) {
      definition->state = state;
      definition->study = zp_scenario_study(scenario);
      definition->def = zp_def_create();
      good = zp_scenario_def(scenario, row, definition->def, &err) == ZP_OK;
      if (!good) raise_error(state, &err);
    }
    if (!good || PyList_Append(list, (PyObject *)definition)) Py_CLEAR(list);
    Py_XDECREF((PyObject *)definition);
  }
  return list;
}

/* A scenario as the command writes it. */
static PyObject *text_of_scenario(const State *state, const ZpScenario *scenario) {
  char *text = NULL;
  size_t size;
  ZpError err;
  FILE *file = open_memstream(&text, &size);
  if (!file) return PyErr_NoMemory();
  ZpStatus status = zp_scenario_write(scenario, file, &err);
  const bool closed = fclose(file) == 0;
  PyObject *written = status != ZP_OK ? raise_error(state, &err) : closed ? text_from(text) : PyErr_NoMemory();
  free(text);
  return written;
}

static PyObject *definitions_and_text(State *state, const ZpScenario *scenario) {
  PyObject *list = definitions_of(state, scenario), *text = list ? text_of_scenario(state, scenario) : NULL;
  if (text) return Py_BuildValue("(NN)", list, text);
  Py_XDECREF(list);
  return NULL;
}

PyObject *read_scenario(PyObject *module, PyObject *args) {
  State *state = PyModule_GetState(module);
  PyObject *name, *text = NULL, *found = NULL;
  if (!PyArg_ParseTuple(args, "O|O", &name, &text)) return NULL;
  const char *path = text_of(state, name, "path"), *words = path && text ? text_of(state, text, "scenario") : NULL;
  if (!path || (text && !words)) return NULL;
  ZpScenario *scenario = zp_scenario_create();
  ZpError err;
  ZpStatus status = !scenario ? ZP_MACHINE
                    : words   ? zp_scenario_parse(scenario, words, strlen(words), path, &err)
                              : zp_scenario_read(scenario, path, &err);
  if (!scenario)
    PyErr_NoMemory();
  else if (status != ZP_OK)
    raise_error(state, &err);
  else
    found = definitions_and_text(state, scenario);
  zp_scenario_destroy(scenario);
  return found;
}

/* -- use ------------------------------------------------------------------------------------------ */

static PyObject *definition_get(PyObject *object, PyObject *name) {
  Definition *self = (Definition *)object;
  int key = key_of(self->state, name);
  if (key < 0) return NULL;
  double value = is_study(key) ? (double)self->study : zp_def_get(self->def, key);
  switch (zp_key(key)->type) {
  case ZP_KEY_TEXT:
    return text_from(zp_def_text(self->def, key));
  case ZP_KEY_BOOL:
    return PyBool_FromLong(value != 0);
  case ZP_KEY_INT:
    return PyLong_FromDouble(value);
  case ZP_KEY_ENUM:
    return text_from(zp_key(key)->choices[(int)value].word);
  case ZP_KEY_REAL_AUTO:
  case ZP_KEY_REAL:
    break;
  }
  return isnan(value) ? text_from(zp_key(key)->text) : PyFloat_FromDouble(value);
}

/* All keys, of members of a stack those that are given. */
static PyObject *definition_keys(PyObject *object, PyObject *unused) {
  const ZpActuatorDef *def = ((Definition *)object)->def;
  PyObject *list = PyList_New(0);
  (void)unused;
  for (int key = zp_def_next_key(def, -1); list && key >= 0; key = zp_def_next_key(def, key)) {
    char text[ZP_KEY_NAME_SIZE];
    PyObject *name = text_from(zp_key_name(key, text));
    if (!name || PyList_Append(list, name)) Py_CLEAR(list);
    Py_XDECREF(name);
  }
  return list;
}

static PyObject *definition_run(PyObject *object, PyObject *progress) {
  Definition *self = (Definition *)object;
  Watch watch;
  watch_begin(&watch, progress == Py_None ? NULL : progress);
  ZpHooks hooks = watch_hooks(&watch);
  ZpResult *result = NULL;
  ZpError err;
  ZpStudyInput arrays = {.table = &self->drive};
  ZpStatus status = self->drive.rows ? zp_study_run_limited(self->study, self->def, &arrays, &hooks, &result, &err)
                                     : zp_data_study_run(self->study, self->def, &hooks, &result, &err);
  watch_end(&watch);
  if (watch.failed) {
    zp_result_destroy(result);
    return NULL;
  }
  return status == ZP_OK ? result_new(self->state, result) : raise_error(self->state, &err);
}

static PyMethodDef methods[] = {
    {"keys", definition_keys, METH_NOARGS, "Names of its keys, of members of a stack those that are given."},
    {"get", definition_get, METH_O, "Value of a key: float, int, bool or str; SI."},
    {"run", definition_run, METH_O, "Run its study; takes a function (stage, fraction) or None."},
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {
    {Py_tp_doc, "Definition(values, drive=None): a checked definition of an actuator and a study."},
    {Py_tp_new, definition_new},
    {Py_tp_dealloc, definition_dealloc},
    {Py_tp_methods, methods},
    {0, NULL},
};
PyType_Spec definition_spec = {"zipact._zipact.Definition", sizeof(Definition), 0, Py_TPFLAGS_DEFAULT, slots};
