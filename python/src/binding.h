/* Common declarations of the extension. Every type only owns an object of the library; convenience functions are
 * written in Python, above it. */
#ifndef ZIPACT_BINDING_H
#define ZIPACT_BINDING_H

#include <Python.h>

#include <zipact/calibrate.h>
#include <zipact/io.h>
#include <zipact/zipact.h>

/* The types and exceptions of the module: its only state. */
typedef struct State {
  PyObject *error, *input_error, *machine_error, *numerics_error;
  PyTypeObject *definition, *simulation, *result, *view;
} State;

/* The state of the module to which `type`, or its base type, belongs. */
State *state_of_type(PyTypeObject *type);

/* Free an object of a heap type. */
void free_object(PyObject *self);

/* -- failures (module.c): all return NULL with the exception set -- */

PyObject *raise_error(const State *state, const ZpError *err);
__attribute__((format(printf, 2, 3))) PyObject *raise_input(const State *state, const char *format, ...);

/* A text of the library; invalid UTF-8, as in a truncated name, is replaced. */
PyObject *text_from(const char *text);

/* UTF-8 of a str, valid as long as the str; NULL with an exception about `what` if it is not a str. */
const char *text_of(const State *state, PyObject *text, const char *what);

/* -- values (definition.c) -- */

/* (key, Python value) => value as in ZpAssignment; -1 with an exception. */
int number_of(const State *state, int key, PyObject *object, double *value);

/* The same for a quantity with the unit and range of a key but another name, such as dt. */
int quantity_of(const State *state, int key, const char *name, PyObject *object, double *value);

/* -- long calls (watch.c) -- */

/* A call during which other Python threads run. Some times a second the hooks of the library check signals and call the
 * progress function of the caller; they stop the call if either raises an exception, or progress returns true. */
typedef struct Watch {
  PyThreadState *thread;
  PyObject *progress; /* a function (stage, fraction), or NULL */
  double next;        /* wall time of the next check, s */
  bool failed;        /* an exception is set: the result of the call is discarded */
} Watch;

/* Release the interpreter lock, and acquire it again. No Python object may be used in between. */
void watch_begin(Watch *watch, PyObject *progress);
void watch_end(Watch *watch);
ZpHooks watch_hooks(Watch *watch);

/* -- types: made once per module -- */

PyTypeObject *make_type(PyObject *module, PyType_Spec *spec);
extern PyType_Spec definition_spec, simulation_spec, result_spec, view_spec;

/* The input of simulations and studies: checked, immutable. */
typedef struct Definition {
  PyObject_HEAD State *state;
  ZpStudy study;
  ZpActuatorDef *def;
  ZpDriveTable drive; /* rows of the drive given as arrays; 0 rows: the drive of def */
} Definition;

/* One Definition per run of a scenario file. */
PyObject *read_scenario(PyObject *module, PyObject *args);

/* Takes `result` over. */
PyObject *result_new(State *state, ZpResult *result);

/* (name, unit, help) of each column. */
PyObject *columns_of(const ZpTable *table);

/* (what Result.pack gave) => Result. */
PyObject *unpack_result(PyObject *module, PyObject *bytes);

/* `count` doubles of `owner` as a read-only buffer of `ndim` <= 3 dimensions, without copying. */
PyObject *view_new(State *state, PyObject *owner, const double *data, int ndim, const Py_ssize_t *shape,
                   const Py_ssize_t *strides);

/* The same, row after row. */
PyObject *view_of_rows(State *state, PyObject *owner, const double *data, size_t rows, size_t columns);

#endif
