/* The state of a simulation in its in-memory form: a copy to look into or to change, and back. */
#ifndef ZP_TESTS_STATE_UTIL_H
#define ZP_TESTS_STATE_UTIL_H

#include "check_util.h"

#include "run/run.h"

static inline void copy_state(const ZpSim *sim, void *state) {
  memcpy(state, sim->state, zp_state_size(sim->model));
}

static inline void put_state(ZpSim *sim, const void *state) {
  memcpy(sim->state, state, zp_state_size(sim->model));
  zp_sim_resume(sim);
}

#endif
