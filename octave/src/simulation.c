/* Stepping by hand. The interpreter holds a number; what it stands for is looked up among the simulations that are
 * open, so that a number of anything else is an error. */
#include "binding.h"

#include <stdlib.h>
#include <time.h>

typedef struct Simulation {
  struct Simulation *next;
  uint64_t handle;
  ZpModel *model;
  ZpSim *sim;
  bool ended; /* numbers are beyond use until a state is restored */
} Simulation;

static Simulation *simulations; /* that are open */

static void take_arguments(const char *command, int count, int least, int most) {
  if (count < least || count > most)
    fail_input("%s: takes %d to %d arguments after it, not %d", command, least, most, count);
}

static void free_simulation(Simulation *simulation) {
  zp_sim_destroy(simulation->sim);
  zp_model_destroy(simulation->model);
  free(simulation);
}

/* The place of the pointer to a simulation. */
static Simulation **find(const mxArray *value) {
  if (!mxIsUint64(value) || mxGetNumberOfElements(value) != 1 || mxIsSparse(value) || mxIsComplex(value))
    fail_input("simulation: takes what zipact('open', ...) returned");
  uint64_t handle = *(const uint64_t *)mxGetData(value);
  for (Simulation **place = &simulations; *place; place = &(*place)->next)
    if ((*place)->handle == handle) return place;
  fail_input("simulation: closed, or not one that zipact('open', ...) returned");
}

/* Numbers from the clock: none comes again, even where the function has been cleared and loaded anew. */
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
  ZpActuatorDef def;
  ZpError err;
  read_scenario(count, value);
  if (zp_scenario_count(call.scenario) != 1) fail_input("open: takes one actuator, no lists of values");
  if (zp_scenario_def(call.scenario, 0, &def, &err) != ZP_OK) fail(&err);
  Simulation made = {.next = simulations, .handle = new_handle()}, *simulation = malloc(sizeof made);
  if (!simulation) fail_memory();
  watch_begin();
  ZpStatus status = zp_data_sim_create(&def, &watch_hooks, &made.model, &made.sim, &err);
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
  Simulation *simulation = *find(value[0]);
  double dt = quantity_of("solver.end_time", "dt", value[1]);
  double voltage = count > 2 ? quantity_of("drive.voltage", "voltage", value[2]) : 0;
  ZpRunInfo info = {0};
  ZpError err;
  if (simulation->ended) fail_numerics("the simulation has diverged; restore a state to continue");
  if (count > 2 && zp_sim_set_voltage(simulation->sim, voltage, &err) != ZP_OK) fail(&err);
  watch_begin();
  ZpOutcome outcome = zp_sim_step(simulation->sim, dt, &watch_hooks, &info);
  watch_end();
  simulation->ended = outcome == ZP_DIVERGED;
  if (outcome == ZP_INTERRUPTED) fail_interrupted();
  if (outcome != ZP_REACHED_END) fail_numerics(info.message);
  return new_double(zp_sim_get(simulation->sim, "time"));
}

mxArray *simulation_read(int count, const mxArray *const *value) {
  take_arguments("read", count, 1, 1);
  Simulation *simulation = *find(value[0]);
  size_t signals;
  const ZpColumn *column = zp_signal_columns(&signals);
  double *row = mxCalloc(signals, sizeof *row);
  zp_sim_read(simulation->sim, row);
  mxArray *found = new_struct();
  for (size_t i = 0; i < signals; i++)
    set(found, 0, column[i].name, new_double(row[i]));
  return found;
}

mxArray *simulation_shape(int count, const mxArray *const *value) {
  take_arguments("shape", count, 1, 1);
  Simulation *simulation = *find(value[0]);
  ZpModelInfo info = zp_model_info(simulation->model);
  ZpShape shape = zp_sim_shape(simulation->sim);
  call.film = zp_shapes_create((size_t)info.ribbons, (size_t)info.nodes, 2);
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
  Simulation *simulation = *find(value[0]);
  ZpError err;
  if (!mxIsUint8(value[1]) || mxIsSparse(value[1]) || mxIsComplex(value[1]))
    fail_input("state: takes the bytes that zipact('save', ...) returned");
  if (zp_sim_restore(simulation->sim, mxGetData(value[1]), mxGetNumberOfElements(value[1]), &err) != ZP_OK) fail(&err);
  simulation->ended = false;
  return new_double(zp_sim_get(simulation->sim, "time"));
}

mxArray *simulation_close(int count, const mxArray *const *value) {
  take_arguments("close", count, 1, 1);
  Simulation **place = find(value[0]), *closed = *place;
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
