/* Stepping by hand. The interpreter holds a number, which is looked up among the open simulations, so that any other
 * number is an error. */
#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct Simulation {
  struct Simulation *next;
  uint64_t handle;
  ZpActuatorDef *def;
  ZpModel *model;
  ZpSim *sim;
  ZpRunInfo *info;  /* of the last step or run */
  ZpTable *columns; /* names of the signals */
  bool ended;       /* values are invalid until a state is restored */
  bool runs;        /* its controller is running: it can only be read */
} Simulation;

static Simulation *simulations; /* open simulations */

static void take_arguments(const char *command, int count, int least, int most) {
  if (count < least || count > most)
    fail_input("%s: takes %d to %d arguments after it, not %d", command, least, most, count);
}

static void free_simulation(Simulation *simulation) {
  zp_run_info_destroy(simulation->info);
  zp_table_destroy(simulation->columns);
  zp_sim_destroy(simulation->sim);
  zp_model_destroy(simulation->model);
  zp_def_destroy(simulation->def);
  free(simulation);
}

/* The pointer to a simulation. */
static Simulation **find(const mxArray *value) {
  if (!mxIsUint64(value) || mxGetNumberOfElements(value) != 1 || mxIsSparse(value) || mxIsComplex(value))
    fail_input("simulation: takes what zipact('open', ...) returned");
  uint64_t handle = *(const uint64_t *)mxGetData(value);
  for (Simulation **place = &simulations; *place; place = &(*place)->next)
    if ((*place)->handle == handle) return place;
  fail_input("simulation: is closed, or was not returned by zipact('open', ...)");
}

/* The same for a simulation that is to be stepped, changed or closed. */
static Simulation **find_free(const mxArray *value) {
  Simulation **place = find(value);
  if ((*place)->runs)
    fail_input("simulation: its controller is running; until it returns, the simulation can only be read");
  return place;
}

/* Numbers from the clock: no number occurs twice, even if the function has been cleared and loaded again. */
static uint64_t new_handle(void) {
  struct timespec now;
  timespec_get(&now, TIME_UTC);
  uint64_t handle = (uint64_t)now.tv_sec * UINT64_C(1000000000) + (uint64_t)now.tv_nsec;
  if (simulations && handle <= simulations->handle) handle = simulations->handle + 1;
  return handle;
}

static mxArray *new_double(double value) {
  return mxCreateDoubleScalar(value);
}

mxArray *simulation_open(int count, const mxArray *const *value) {
  ZpError err;
  read_scenario(count, value);
  if (zp_scenario_count(call.scenario) != 1) fail_input("open: takes one actuator or network, not lists of values");
  const ZpActuatorDef *def = read_def(0);
  Simulation made = {.next = simulations,
                     .handle = new_handle(),
                     .def = zp_def_copy(def),
                     .info = zp_run_info_create(),
                     .columns = zp_signal_table(def, 1)};
  Simulation *simulation = malloc(sizeof made);
  if (!simulation || !made.columns) fail_memory();
  watch_begin();
  ZpStatus status = zp_data_sim_create(def, &watch_hooks, &made.model, &made.sim, &err);
  bool interrupted = watch_end();
  *simulation = made;
  if (status != ZP_OK || interrupted) free_simulation(simulation);
  if (status != ZP_OK) fail(&err);
  if (interrupted) fail_interrupted();
  simulations = simulation;
  mxArray *handle = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
  *(uint64_t *)mxGetData(handle) = simulation->handle;
  return handle;
}

/* simulation, dt, voltage => time */
mxArray *simulation_step(int count, const mxArray *const *value) {
  take_arguments("step", count, 2, 3);
  Simulation *simulation = *find_free(value[0]);
  double dt = quantity_of("solver.end_time", "dt", value[1]);
  double voltage = count > 2 ? quantity_of("drive.voltage", "voltage", value[2]) : 0;
  ZpError err;
  if (simulation->ended) fail_numerics("the simulation has diverged; restore a state to continue");
  if (count > 2 && zp_sim_set_voltage(simulation->sim, voltage, &err) != ZP_OK) fail(&err);
  watch_begin();
  ZpOutcome outcome = zp_sim_step(simulation->sim, dt, &watch_hooks, simulation->info);
  watch_end();
  simulation->ended = outcome == ZP_DIVERGED || outcome == ZP_BEYOND_MODEL;
  if (outcome == ZP_INTERRUPTED) fail_interrupted();
  if (outcome != ZP_REACHED_END) fail_numerics(zp_run_info_message(simulation->info));
  return new_double(zp_sim_get(simulation->sim, "time"));
}

static double number_of(const char *name, const mxArray *value) {
  if (!mxIsDouble(value) || mxIsComplex(value) || mxIsSparse(value) || mxGetNumberOfElements(value) != 1)
    fail_input("%s: takes one number, SI", name);
  return mxGetScalar(value);
}

/* simulation, name, value, rate per second */
mxArray *simulation_input(int count, const mxArray *const *value) {
  take_arguments("input", count, 3, 4);
  Simulation *simulation = *find_free(value[0]);
  const char *name = text_of(value[1], "input");
  const double number = number_of("value", value[2]), rate = count > 3 ? number_of("rate", value[3]) : 0;
  ZpError err;
  if (zp_sim_set_input_named(simulation->sim, name, number, rate, &err) != ZP_OK) fail(&err);
  return NULL;
}

/* simulation => name and unit of each input */
mxArray *simulation_inputs(int count, const mxArray *const *value) {
  take_arguments("inputs", count, 1, 1);
  const ZpActuatorDef *def = (*find(value[0]))->def;
  size_t inputs = 0;
  for (int input = zp_def_input_next(def, -1); input >= 0; input = zp_def_input_next(def, input))
    inputs++;
  mxArray *found = mxCreateStructMatrix(1, inputs, 0, NULL);
  size_t at = 0;
  for (int input = zp_def_input_next(def, -1); input >= 0; input = zp_def_input_next(def, input), at++) {
    char name[ZP_INPUT_NAME_SIZE];
    set(found, at, "name", mxCreateString(zp_def_input_name(def, input, name)));
    set(found, at, "unit", mxCreateString(zp_def_input_unit(def, input)));
  }
  return found;
}

/* -- a controller of the user's own -------------------------------------------------------------------- */

/* The controller, and its error. zipact.m wraps the function of the user: it returns a voltage and a text, which is
 * empty without an error. */
typedef struct Controller {
  mxArray *function;
  const char *signal;
  bool failed;       /* it returned no voltage, */
  char trouble[400]; /* for this reason, if known */
} Controller;

/* A result that is not a number ends the run. */
static double ask(void *user, ZpSim *sim, double time) {
  Controller *controller = user;
  mxArray *given[3] = {controller->function, new_double(time), new_double(zp_sim_get(sim, controller->signal))};
  mxArray *answer[2] = {NULL, NULL};
  bool ran = mexCallMATLABWithTrap(2, answer, 3, given, "feval") == NULL;
  bool number = ran && answer[0] && mxIsDouble(answer[0]) && mxGetNumberOfElements(answer[0]) == 1;
  double voltage = number ? mxGetScalar(answer[0]) : NAN;
  if (ran && answer[1] && mxIsChar(answer[1])) mxGetString(answer[1], controller->trouble, sizeof controller->trouble);
  controller->failed = !number || *controller->trouble;
  for (int k = 0; k < 2; k++) {
    mxDestroyArray(given[k + 1]);
    if (answer[k]) mxDestroyArray(answer[k]);
  }
  return voltage;
}

static _Noreturn void fail_controller(const Controller *controller) {
  if (*controller->trouble) fail_input("controller: %s", controller->trouble);
  fail_input("controller: takes a function that returns one number, the voltage");
}

static void check_signal(const ZpTable *columns, const char *signal) {
  const size_t length = strlen(signal);
  for (size_t k = 0; k < zp_table_columns(columns) && length > 0; k++) {
    const char *name = zp_table_column(columns, k)->name;
    if (strncmp(name, signal, length) == 0 && (name[length] == 0 || name[length] == '_')) return;
  }
  fail_input("signal: unknown signal %.60s; use, for example, opening, contraction or capacitance, of a network "
             "left.opening or hand.y",
             signal);
}

/* simulation, function, signal, period, end => time */
mxArray *simulation_control(int count, const mxArray *const *value) {
  take_arguments("control", count, 5, 5);
  Simulation *simulation = *find_free(value[0]);
  ZpError err;
  if (!mxIsFunctionHandle(value[1])) fail_input("controller: takes a function handle, @(time, signal) voltage");
  Controller controller = {.function = (mxArray *)value[1], .signal = text_of(value[2], "signal")};
  check_signal(simulation->columns, controller.signal);
  double period = quantity_of("control.period", "period", value[3]);
  double end = quantity_of("solver.end_time", "end time", value[4]);
  if (simulation->ended) fail_numerics("the simulation has diverged; restore a state to continue");
  if (zp_sim_set_controller(simulation->sim, &(ZpController){period, &controller, ask}, &err) != ZP_OK) fail(&err);
  simulation->runs = true;
  watch_begin();
  ZpOutcome outcome = zp_sim_run(simulation->sim, end, false, &watch_hooks, simulation->info);
  watch_end();
  simulation->runs = false;
  zp_sim_set_controller(simulation->sim, NULL, NULL);
  simulation->ended = outcome == ZP_DIVERGED || outcome == ZP_BEYOND_MODEL;
  if (controller.failed) fail_controller(&controller);
  if (outcome == ZP_INTERRUPTED) fail_interrupted();
  if (outcome == ZP_BAD_ARGUMENT) fail_input("%s", zp_run_info_message(simulation->info));
  if (outcome != ZP_REACHED_END) fail_numerics(zp_run_info_message(simulation->info));
  return new_double(zp_sim_get(simulation->sim, "time"));
}

mxArray *simulation_read(int count, const mxArray *const *value) {
  take_arguments("read", count, 1, 1);
  Simulation *simulation = *find(value[0]);
  const size_t signals = zp_table_columns(simulation->columns);
  double *row = mxCalloc(signals, sizeof *row);
  zp_sim_read_columns(simulation->sim, signals, row);
  mxArray *found = new_struct();
  for (size_t i = 0; i < signals; i++)
    set(found, 0, zp_table_column(simulation->columns, i)->name, new_double(row[i]));
  return found;
}

mxArray *simulation_shape(int count, const mxArray *const *value) {
  take_arguments("shape", count, 1, 1);
  Simulation *simulation = *find(value[0]);
  ZpShape shape = zp_sim_shape(simulation->sim);
  const size_t members = (size_t)zp_def_members(simulation->def);
  const size_t nodes = members * (size_t)zp_model_get(simulation->model, "nodes");
  call.film = zp_shapes_create((size_t)zp_model_get(simulation->model, "ribbons"), nodes, 2);
  if (!call.film) fail_memory();
  zp_shapes_offer(call.film, &shape);
  return shapes_struct(call.film);
}

mxArray *simulation_save(int count, const mxArray *const *value) {
  take_arguments("save", count, 1, 1);
  Simulation *simulation = *find(value[0]);
  mxArray *state = mxCreateNumericMatrix(zp_sim_state_size(simulation->sim), 1, mxUINT8_CLASS, mxREAL);
  zp_sim_save(simulation->sim, mxGetData(state));
  return state;
}

/* simulation, state => time */
mxArray *simulation_restore(int count, const mxArray *const *value) {
  take_arguments("restore", count, 2, 2);
  Simulation *simulation = *find_free(value[0]);
  ZpError err;
  if (!mxIsUint8(value[1]) || mxIsSparse(value[1]) || mxIsComplex(value[1]))
    fail_input("state: takes the bytes that zipact('save', ...) returned");
  if (zp_sim_restore(simulation->sim, mxGetData(value[1]), mxGetNumberOfElements(value[1]), &err) != ZP_OK) fail(&err);
  simulation->ended = false;
  return new_double(zp_sim_get(simulation->sim, "time"));
}

mxArray *simulation_close(int count, const mxArray *const *value) {
  take_arguments("close", count, 1, 1);
  Simulation **place = find_free(value[0]), *closed = *place;
  *place = closed->next;
  free_simulation(closed);
  return NULL;
}

void simulation_close_all(void) {
  while (simulations) {
    Simulation *closed = simulations;
    simulations = closed->next;
    free_simulation(closed);
  }
}
