/* Stepping by hand.
 *
 * A step lets other Python threads run, so a simulation may be called during its step, also by the progress function
 * and by signal handlers: `busy` refuses such calls. */
#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Simulation {
  PyObject_HEAD State *state;
  PyObject *definition; /* its definition */
  ZpModel *model;
  ZpSim *sim;
  ZpRunInfo *info;               /* of the last step */
  int end_time_key, voltage_key; /* keys with the units and ranges of dt and voltage */
  ZpTable *columns;              /* names and units of the signals */
  double time;                   /* s */
  double hand_voltage;           /* voltage last set by step, V; NAN: none yet */
  int64_t steps;                 /* steps so far */
  bool busy;                     /* within a call that lets other threads run */
  bool ended;                    /* values are invalid until a state is restored */
} Simulation;

/* -- creation --------------------------------------------------------------------------------------- */

static ZpStatus compile(Simulation *self, const ZpHooks *hooks, ZpError *err) {
  const Definition *definition = (Definition *)self->definition;
  const ZpActuatorDef *def = definition->def;
  if (!definition->drive.rows) return zp_data_sim_create(def, hooks, &self->model, &self->sim, err);
  ZpStatus status = zp_model_create_driven(def, &definition->drive, &self->model, err);
  return status == ZP_OK ? zp_sim_create(self->model, hooks, &self->sim, err) : status;
}

static PyObject *simulation_new(PyTypeObject *type, PyObject *args, PyObject *kwargs) {
  (void)kwargs;
  State *state = state_of_type(type);
  PyObject *definition;
  if (!state || !PyArg_ParseTuple(args, "O!", state->definition, &definition)) return NULL;
  Simulation *self = (Simulation *)((allocfunc)PyType_GetSlot(type, Py_tp_alloc))(type, 0);
  if (!self) return NULL;
  self->state = state;
  self->definition = Py_NewRef(definition);
  self->end_time_key = zp_key_find("solver.end_time");
  self->voltage_key = zp_key_find("drive.voltage");
  self->hand_voltage = NAN;
  self->info = zp_run_info_create();
  Watch watch;
  watch_begin(&watch, NULL);
  ZpHooks hooks = watch_hooks(&watch);
  ZpError err;
  ZpStatus status = compile(self, &hooks, &err);
  watch_end(&watch);
  if (!watch.failed && status == ZP_OK) {
    self->columns = zp_signal_table(((Definition *)definition)->def, 1);
    if (!self->columns) {
      Py_DECREF(self);
      return PyErr_NoMemory();
    }
    self->time = zp_sim_get(self->sim, "time"); /* not 0 if it starts from a checkpoint */
    return (PyObject *)self;
  }
  if (!watch.failed) raise_error(state, &err);
  Py_DECREF(self);
  return NULL;
}

static void simulation_dealloc(PyObject *object) {
  Simulation *self = (Simulation *)object;
  zp_run_info_destroy(self->info);
  zp_table_destroy(self->columns);
  zp_sim_destroy(self->sim);
  zp_model_destroy(self->model);
  Py_XDECREF(self->definition);
  free_object(object);
}

/* -- steps ------------------------------------------------------------------------------------------ */

static int refuse_busy(const Simulation *self) {
  if (!self->busy) return 0;
  raise_input(self->state, "the simulation is already in a step, in another thread or in the call that runs now");
  return -1;
}

/* (dt, voltage=None) */
static int step_arguments(const State *state, PyObject *const *args, Py_ssize_t count, PyObject *names,
                          PyObject *found[2]) {
  static const char *const known[] = {"dt", "voltage"};
  Py_ssize_t named = names ? PyTuple_Size(names) : 0;
  for (Py_ssize_t i = 0; i < count + named; i++) {
    Py_ssize_t place = i;
    if (i >= count)
      for (place = 0; place < 2; place++)
        if (PyUnicode_CompareWithASCIIString(PyTuple_GetItem(names, i - count), known[place]) == 0) break;
    if (place >= 2 || found[place]) {
      PyErr_SetString(PyExc_TypeError, "step takes dt and voltage, each once");
      return -1;
    }
    found[place] = args[i];
  }
  if (found[0]) return 0;
  raise_input(state, "dt: missing; give the length of the step, in s");
  return -1;
}

static ZpOutcome advance(Simulation *self, double dt, double voltage, const ZpHooks *hooks, ZpError *err) {
  if (!isnan(voltage) && voltage != self->hand_voltage) {
    err->status = zp_sim_set_voltage(self->sim, voltage, err);
    if (err->status != ZP_OK) return ZP_REACHED_END;
    self->hand_voltage = voltage;
  }
  return zp_sim_step(self->sim, dt, hooks, self->info);
}

static PyObject *step(Simulation *self, double dt, double voltage) {
  Watch watch;
  ZpError err = {.status = ZP_OK};
  double end = self->time + dt;
  self->busy = true;
  watch_begin(&watch, NULL);
  ZpHooks hooks = watch_hooks(&watch);
  ZpOutcome outcome = advance(self, dt, voltage, &hooks, &err);
  watch_end(&watch);
  self->busy = false;
  self->steps += (int64_t)zp_run_info_get(self->info, "steps");
  self->time = outcome == ZP_REACHED_END && err.status == ZP_OK ? end : zp_sim_get(self->sim, "time");
  self->ended = outcome == ZP_DIVERGED || outcome == ZP_BEYOND_MODEL;
  if (watch.failed) return NULL;
  if (err.status != ZP_OK) return raise_error(self->state, &err);
  if (outcome == ZP_REACHED_END) Py_RETURN_NONE;
  PyErr_SetString(self->state->numerics_error, zp_run_info_message(self->info));
  return NULL;
}

static PyObject *simulation_step(PyObject *object, PyObject *const *args, Py_ssize_t count, PyObject *names) {
  Simulation *self = (Simulation *)object;
  PyObject *found[2] = {NULL, NULL};
  double dt, voltage = NAN;
  if (step_arguments(self->state, args, count, names, found)) return NULL;
  if (quantity_of(self->state, self->end_time_key, "dt", found[0], &dt)) return NULL;
  if (found[1] && found[1] != Py_None && quantity_of(self->state, self->voltage_key, "voltage", found[1], &voltage))
    return NULL;
  if (refuse_busy(self)) return NULL; /* not earlier: converting dt may have run Python code */
  if (!self->ended) return step(self, dt, voltage);
  PyErr_SetString(self->state->numerics_error, "the simulation has diverged; restore a state to continue");
  return NULL;
}

/* A number, or a text with a unit for an input that has one. */
static int value_of_input(const Simulation *self, const char *name, PyObject *object, double *value) {
  static const char *const like[] = {"drive.voltage", "body_K.force.y", "body_K.torque"}; /* keys of these units */
  const ZpActuatorDef *def = ((Definition *)self->definition)->def;
  const char *unit = zp_def_input_unit(def, zp_def_input_find(def, name));
  for (size_t k = 0; PyUnicode_Check(object) && unit && k < sizeof like / sizeof like[0]; k++) {
    const int key = zp_key_find(like[k]);
    if (strcmp(zp_key(key)->unit, unit) == 0) return quantity_of(self->state, key, name, object, value);
  }
  *value = PyFloat_AsDouble(object);
  if (!PyErr_Occurred()) return 0;
  PyErr_Clear();
  raise_input(self->state, "%.80s: takes a number", name);
  return -1;
}

static PyObject *simulation_set_input(PyObject *object, PyObject *args, PyObject *names) {
  static char *known[] = {"", "value", "rate", NULL};
  Simulation *self = (Simulation *)object;
  PyObject *word, *given;
  double value, rate = 0;
  if (!PyArg_ParseTupleAndKeywords(args, names, "UO|d", known, &word, &given, &rate)) return NULL;
  const char *name = text_of(self->state, word, "input");
  if (!name || value_of_input(self, name, given, &value) || refuse_busy(self)) return NULL;
  ZpError err;
  if (zp_sim_set_input_named(self->sim, name, value, rate, &err) != ZP_OK) return raise_error(self->state, &err);
  self->hand_voltage = NAN; /* of the next step's voltage none is a repetition */
  Py_RETURN_NONE;
}

/* -- reading ---------------------------------------------------------------------------------------- */

static PyObject *simulation_read_into(PyObject *object, PyObject *out) {
  Simulation *self = (Simulation *)object;
  Py_buffer buffer;
  if (refuse_busy(self) || PyObject_GetBuffer(out, &buffer, PyBUF_CONTIG | PyBUF_FORMAT)) return NULL;
  const size_t all = zp_table_columns(self->columns);
  size_t whole; /* without those of members and bodies */
  zp_signal_columns(&whole);
  const size_t count = buffer.ndim == 1 ? (size_t)buffer.shape[0] : 0;
  const bool fits = (count == all || count == whole) && buffer.format && strcmp(buffer.format, "d") == 0;
  if (fits) zp_sim_read_columns(self->sim, count, buffer.buf);
  PyBuffer_Release(&buffer);
  if (!fits) return raise_input(self->state, "out: takes an array of %zu float64, one per signal", all);
  Py_RETURN_NONE;
}

static PyObject *simulation_columns(PyObject *object, PyObject *unused) {
  (void)unused;
  return columns_of(((Simulation *)object)->columns);
}

/* (name, unit) of each input. */
static PyObject *simulation_inputs(PyObject *object, PyObject *unused) {
  (void)unused;
  const ZpActuatorDef *def = ((Definition *)((Simulation *)object)->definition)->def;
  PyObject *list = PyList_New(0);
  for (int input = zp_def_input_next(def, -1); list && input >= 0; input = zp_def_input_next(def, input)) {
    char name[ZP_INPUT_NAME_SIZE];
    PyObject *item = Py_BuildValue("(ss)", zp_def_input_name(def, input, name), zp_def_input_unit(def, input));
    if (!item || PyList_Append(list, item)) Py_CLEAR(list);
    Py_XDECREF(item);
  }
  return list;
}

static PyObject *simulation_get(PyObject *object, PyObject *name) {
  Simulation *self = (Simulation *)object;
  const char *words = text_of(self->state, name, "signal");
  if (!words || refuse_busy(self)) return NULL;
  return PyFloat_FromDouble(zp_sim_get(self->sim, words));
}

/* A view of `value` [rows, columns]; None if there is none. */
static PyObject *view_if_any(Simulation *self, const double *value, size_t rows, size_t columns) {
  return value ? view_of_rows(self->state, (PyObject *)self, value, rows, columns) : Py_NewRef(Py_None);
}

/* (zipped, x, y, gap, line_force, insulator_field, stress), the arrays valid until the simulation continues. */
static PyObject *simulation_shape(PyObject *object, PyObject *unused) {
  (void)unused;
  Simulation *self = (Simulation *)object;
  if (refuse_busy(self)) return NULL;
  ZpShape shape = zp_sim_shape(self->sim);
  const size_t members = (size_t)zp_def_members(((Definition *)self->definition)->def);
  const size_t nodes = members * (size_t)zp_model_get(self->model, "nodes");
  const size_t ribbons = (size_t)zp_model_get(self->model, "ribbons");
  return Py_BuildValue("(nNNNNNN)", (Py_ssize_t)shape.zipped, view_if_any(self, shape.x, nodes, ribbons),
                       view_if_any(self, shape.y, nodes, ribbons), view_if_any(self, shape.gap, 1, nodes),
                       view_if_any(self, shape.line_force, 1, nodes),
                       view_if_any(self, shape.insulator_field, 1, nodes),
                       view_if_any(self, shape.stress, nodes, ribbons));
}

/* -- states ----------------------------------------------------------------------------------------- */

static PyObject *simulation_save(PyObject *object, PyObject *unused) {
  (void)unused;
  Simulation *self = (Simulation *)object;
  if (refuse_busy(self)) return NULL;
  PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)zp_sim_state_size(self->sim));
  if (bytes) zp_sim_save(self->sim, PyBytes_AsString(bytes));
  return bytes;
}

static PyObject *simulation_restore(PyObject *object, PyObject *state) {
  Simulation *self = (Simulation *)object;
  char *bytes;
  Py_ssize_t size;
  if (refuse_busy(self)) return NULL;
  if (!PyBytes_Check(state)) return raise_input(self->state, "state: takes the bytes that save() returned");
  if (PyBytes_AsStringAndSize(state, &bytes, &size)) return NULL;
  ZpError err;
  if (zp_sim_restore(self->sim, bytes, (size_t)size, &err) != ZP_OK) return raise_error(self->state, &err);
  self->time = zp_sim_get(self->sim, "time");
  self->hand_voltage = NAN;
  self->ended = false;
  Py_RETURN_NONE;
}

/* -- numbers that are at hand ------------------------------------------------------------------------ */

static PyObject *get_time(PyObject *self, void *unused) {
  (void)unused;
  return PyFloat_FromDouble(((Simulation *)self)->time);
}

static PyObject *get_steps(PyObject *self, void *unused) {
  (void)unused;
  return PyLong_FromLongLong(((Simulation *)self)->steps);
}

static PyObject *get_zip_time(PyObject *object, void *unused) {
  (void)unused;
  Simulation *self = (Simulation *)object;
  return refuse_busy(self) ? NULL : PyFloat_FromDouble(zp_sim_zip_time(self->sim));
}

static PyObject *get_closed_from(PyObject *object, void *unused) {
  (void)unused;
  Simulation *self = (Simulation *)object;
  return refuse_busy(self) ? NULL : PyFloat_FromDouble(zp_sim_closed_from(self->sim));
}

static PyGetSetDef getters[] = {
    {"time", get_time, NULL, "Time reached, s.", NULL},
    {"steps", get_steps, NULL, "Steps of the integrator so far.", NULL},
    {"zip_time", get_zip_time, NULL, "Time at which the actuator had closed, s; nan if not yet.", NULL},
    {"closed_from", get_closed_from, NULL, "Time from which it has stayed closed until now, s; nan if it is open.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL},
};
static PyMethodDef methods[] = {
    {"step", (PyCFunction)(void (*)(void))simulation_step, METH_FASTCALL | METH_KEYWORDS,
     "step(dt, voltage=None)\n--\n\n"
     "Advance by dt: s, or a text with a unit. A voltage (V, or a text with a unit) holds from now on;\n"
     "until one is given, drive.waveform applies. Raises NumericsError if the solver fails."},
    {"set_input", (PyCFunction)(void (*)(void))simulation_set_input, METH_VARARGS | METH_KEYWORDS,
     "set_input(name, value, rate=0.0)\n--\n\n"
     "From now on an input has this value (SI, or a text with a unit) and changes with rate per second, until it is "
     "set again or the end of\n"
     "its range is reached: 'voltage' (V), or 'load', a force that pulls the lower platform down (N); of a network\n"
     "one of its `inputs`, as 'left.voltage' or 'hand.force_y'."},
    {"input_units", simulation_inputs, METH_NOARGS, "(name, unit) of each input."},
    {"columns", simulation_columns, METH_NOARGS, "(column, unit, help) of each signal."},
    {"get", simulation_get, METH_O, "Present value of a signal, SI; nan for an unknown name."},
    {"read_into", simulation_read_into, METH_O, "Fill an array of float64 with the present values of all signals."},
    {"shape", simulation_shape, METH_NOARGS,
     "(zipped, x, y, gap, line_force, insulator_field, stress); valid until the next step."},
    {"save", simulation_save, METH_NOARGS, "save()\n--\n\nThe complete state, as bytes for restore()."},
    {"restore", simulation_restore, METH_O,
     "restore(state)\n--\n\nReturn to a state that a simulation of the same actuator saved."},
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {
    {Py_tp_doc, "Simulation(definition): a simulation in time."},
    {Py_tp_new, simulation_new},
    {Py_tp_dealloc, simulation_dealloc},
    {Py_tp_getset, getters},
    {Py_tp_methods, methods},
    {0, NULL},
};
PyType_Spec simulation_spec = {"zipact._zipact.Simulation", sizeof(Simulation), 0,
                               Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots};
