/* The module: its exceptions, its types, the tables of keys and signals. */
#include "binding.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* -- failures -------------------------------------------------------------------------------------- */

PyObject *text_from(const char *text) {
  return PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace");
}

static PyObject *raise_text(PyObject *type, const char *message) {
  PyObject *text = text_from(message);
  if (text) PyErr_SetObject(type, text);
  Py_XDECREF(text);
  return NULL;
}

PyObject *raise_error(const State *state, const ZpError *err) {
  return raise_text(err->status == ZP_MACHINE ? state->machine_error : state->input_error, err->message);
}

PyObject *raise_input(const State *state, const char *format, ...) {
  char message[sizeof((ZpError *)0)->message];
  va_list values;
  va_start(values, format);
  vsnprintf(message, sizeof message, format, values);
  va_end(values);
  return raise_text(state->input_error, message);
}

const char *text_of(const State *state, PyObject *text, const char *what) {
  Py_ssize_t size = 0;
  const char *words = PyUnicode_Check(text) ? PyUnicode_AsUTF8AndSize(text, &size) : NULL;
  if (words && strlen(words) == (size_t)size) return words;
  PyErr_Clear();
  raise_input(state, "%s: not a text, or a text with invalid characters", what);
  return NULL;
}

/* -- types ----------------------------------------------------------------------------------------- */

State *state_of_type(PyTypeObject *type) {
  for (; type; type = PyType_GetSlot(type, Py_tp_base)) {
    State *state = PyType_GetModuleState(type);
    if (state) return state;
    PyErr_Clear(); /* a Python class derived from this type */
  }
  PyErr_SetString(PyExc_TypeError, "not a type of zipact");
  return NULL;
}

void free_object(PyObject *self) {
  PyTypeObject *type = Py_TYPE(self);
  freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
  release(self);
  Py_DECREF(type);
}

PyTypeObject *make_type(PyObject *module, PyType_Spec *spec) {
  PyTypeObject *type = (PyTypeObject *)PyType_FromModuleAndSpec(module, spec, NULL);
  return type && PyModule_AddType(module, type) == 0 ? type : NULL;
}

/* -- tables ---------------------------------------------------------------------------------------- */

static PyObject *choices_of(const ZpKey *key) {
  PyObject *list = PyTuple_New(key->choices ? (Py_ssize_t)key->max + 1 : 0);
  for (Py_ssize_t i = 0; list && i < PyTuple_Size(list); i++) {
    PyObject *item = Py_BuildValue("(ss)", key->choices[i].word, key->choices[i].help);
    if (!item || PyTuple_SetItem(list, i, item)) Py_CLEAR(list);
  }
  return list;
}

/* (name, kind, unit, default, min, max, help, ((word, help), ...)) of each key. */
static PyObject *keys(PyObject *module, PyObject *unused) {
  static const char *const kinds[] = {"real", "real or auto", "int", "bool", "word", "text"};
  (void)module, (void)unused;
  PyObject *list = PyTuple_New(zp_key_count());
  for (int i = 0; list && i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    char text[ZP_TEXT_SIZE];
    zp_value_print(i, key->def, text, sizeof text);
    PyObject *item = Py_BuildValue("(ssssddsN)", key->name, kinds[key->type], key->unit, text, key->min, key->max,
                                   key->help, choices_of(key));
    if (!item || PyTuple_SetItem(list, i, item)) Py_CLEAR(list);
  }
  return list;
}

/* (name, unit, help) of each signal. */
static PyObject *signals(PyObject *module, PyObject *unused) {
  (void)module, (void)unused;
  size_t columns;
  const ZpColumn *signal = zp_signal_columns(&columns);
  Py_ssize_t count = (Py_ssize_t)columns;
  PyObject *list = PyTuple_New(count);
  for (Py_ssize_t i = 0; list && i < count; i++) {
    PyObject *item = Py_BuildValue("(sss)", zp_signal_name((size_t)i), signal[i].unit, signal[i].help);
    if (!item || PyTuple_SetItem(list, i, item)) Py_CLEAR(list);
  }
  return list;
}

/* -- the module ------------------------------------------------------------------------------------ */

static PyObject *add_exception(PyObject *module, const char *name, const char *help, PyObject *base,
                               PyObject *builtin) {
  PyObject *bases = builtin ? PyTuple_Pack(2, base, builtin) : PyTuple_Pack(1, base);
  PyObject *type = bases ? PyErr_NewExceptionWithDoc(name, help, bases, NULL) : NULL;
  Py_XDECREF(bases);
  if (type && PyModule_AddObjectRef(module, strrchr(name, '.') + 1, type) < 0) Py_CLEAR(type);
  return type;
}

static int add_exceptions(PyObject *module, State *state) {
  state->error = add_exception(module, "zipact.Error", "The base of all errors of zipact.", PyExc_Exception, NULL);
  if (!state->error) return -1;
  state->input_error = add_exception(module, "zipact.InputError", "A value, key, unit, file or argument is wrong.",
                                     state->error, PyExc_ValueError);
  state->machine_error = add_exception(module, "zipact.MachineError", "No memory, no permission, a disk is full.",
                                       state->error, PyExc_RuntimeError);
  state->numerics_error = add_exception(module, "zipact.NumericsError", "The solver failed in a step.", state->error,
                                        PyExc_ArithmeticError);
  return state->input_error && state->machine_error && state->numerics_error ? 0 : -1;
}

static int module_exec(PyObject *module) {
  State *state = PyModule_GetState(module);
  if (add_exceptions(module, state)) return -1;
  state->definition = make_type(module, &definition_spec);
  state->simulation = make_type(module, &simulation_spec);
  state->result = make_type(module, &result_spec);
  state->view = make_type(module, &view_spec);
  if (!state->definition || !state->simulation || !state->result || !state->view) return -1;
  return PyModule_AddStringConstant(module, "version", ZP_VERSION);
}

static int module_traverse(PyObject *module, visitproc visit, void *arg) {
  State *state = PyModule_GetState(module);
  Py_VISIT(state->error);
  Py_VISIT(state->input_error);
  Py_VISIT(state->machine_error);
  Py_VISIT(state->numerics_error);
  Py_VISIT(state->definition);
  Py_VISIT(state->simulation);
  Py_VISIT(state->result);
  Py_VISIT(state->view);
  return 0;
}

static int module_clear(PyObject *module) {
  State *state = PyModule_GetState(module);
  Py_CLEAR(state->error);
  Py_CLEAR(state->input_error);
  Py_CLEAR(state->machine_error);
  Py_CLEAR(state->numerics_error);
  Py_CLEAR(state->definition);
  Py_CLEAR(state->simulation);
  Py_CLEAR(state->result);
  Py_CLEAR(state->view);
  return 0;
}

static PyMethodDef methods[] = {
    {"keys", keys, METH_NOARGS, "(name, kind, unit, default, min, max, help, choices) of each key."},
    {"signals", signals, METH_NOARGS, "(name, unit, help) of each signal of a simulation."},
    {"read_scenario", read_scenario, METH_VARARGS,
     "read_scenario(path), read_scenario(name, text): one Definition per run, and the scenario as the command writes "
     "it."},
    {"unpack_result", unpack_result, METH_O, "The Result that was packed."},
    {NULL, NULL, 0, NULL},
};
static PyModuleDef_Slot slots[] = {
    {Py_mod_exec, module_exec},
    {0, NULL},
};
static struct PyModuleDef module_def = {
    PyModuleDef_HEAD_INIT, "_zipact", "The zipact library.", sizeof(State), methods, slots, module_traverse,
    module_clear,          NULL,
};

PyMODINIT_FUNC PyInit__zipact(void) {
  return PyModuleDef_Init(&module_def);
}
