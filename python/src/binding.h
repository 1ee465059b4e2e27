/* What the files of the extension share. Every type is a thin owner of one thing of the library; what is comfortable
 * is written in Python, above it. */
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

/* The state of the module that `type`, or the type that it is derived from, belongs to. */
State *state_of_type(PyTypeObject *type);

/* Free an object of a heap type. */
void free_object(PyObject *self);

/* -- failures (module.c): all return NULL with the exception set -- */

PyObject *raise_error(const State *state, const ZpError *err);
__attribute__((format(printf, 2, 3))) PyObject *raise_input(const State *state, const char *format, ...);

/* A text of the library; bytes that are no UTF-8, as of a name that was cut, are replaced. */
PyObject *text_from(const char *text);

/* UTF-8 of a str, valid as long as it; NULL with an exception that names `what` if it is none. */
const char *text_of(const State *state, PyObject *text, const char *what);

/* -- values (definition.c) -- */

/* (key, Python value) => value as in ZpAssignment; -1 with an exception. */
int number_of(const State *state, int key, PyObject *object, double *value);

/* The same for a quantity that has a key's unit and range but is called otherwise, as dt. */
int quantity_of(const State *state, int key, const char *name, PyObject *object, double *value);

/* -- long calls (watch.c) -- */

/* A call during which other Python threads run. The library's hooks look at signals and at the caller's progress
 * function some times a second, and stop the call if either raises, or progress returns true. */
typedef struct Watch {
  PyThreadState *thread;
  PyObject *progress; /* a function (stage, fraction), or NULL */
  double next;        /* wall clock of the next look, s */
  bool failed;        /* an exception is set: the result of the call does not count */
} Watch;

/* Release the interpreter, and take it again. Between the two no Python object may be touched. */
void watch_begin(Watch *watch, PyObject *progress);
void watch_end(Watch *watch);
ZpHooks watch_hooks(Watch *watch);

/* -- types: made once per module -- */

PyTypeObject *make_type(PyObject *module, PyType_Spec *spec);
extern PyType_Spec definition_spec, simulation_spec, result_spec, view_spec;

/* What a simulation is compiled from and a study run on: checked, never changed. */
typedef struct Definition {
  PyObject_HEAD State *state;
  ZpStudy study;
  ZpActuatorDef def;
  ZpDriveTable drive; /* rows of arrays that drive it; 0 rows: as def says */
} Definition;

/* One Definition per run of a scenario file. */
PyObject *read_scenario(PyObject *module, PyObject *path);

/* Takes `result` over. */
PyObject *result_new(State *state, ZpResult *result);

/* A result that was pickled, and what its names are kept in. */
typedef struct Unpacked {
  ZpResult *result;
  ZpColumn *column; /* of its series; malloc; NULL if it has none */
  PyObject *words;  /* owns the texts */
} Unpacked;

/* What the getters of a result do not give, as plain values. */
PyObject *result_pack(const ZpResult *result);

/* (what result_pack gave, message, notes, scalars, sensitivities, columns or None) => a result; false with an
 * exception. */
bool result_unpack(const State *state, PyObject *args, Unpacked *unpacked);

/* (as result_unpack) => Result. */
PyObject *unpack_result(PyObject *module, PyObject *args);

/* `count` doubles of `owner` as a read-only buffer of `ndim` <= 3 dimensions, without copying. */
PyObject *view_new(State *state, PyObject *owner, const double *data, int ndim, const Py_ssize_t *shape,
                   const Py_ssize_t *strides);

/* The same, rows after one another. */
PyObject *view_of_rows(State *state, PyObject *owner, const double *data, size_t rows, size_t columns);

#endif
