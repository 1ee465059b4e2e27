/* State <=> numbers that mean the same on every machine, and which runs may go on from them. */
#include <zipact/checkpoint.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "sim/sim_internal.h"

/* The numbers of a state, in their order: these, then words, then its arrays. A new one raises the version of the file
 * (io/checkpoint.c). */
#define REAL(name) offsetof(ZpState, name)
static const size_t real[] = {REAL(t),
                              REAL(U),
                              REAL(zip_time),
                              REAL(opening0),
                              REAL(base_U),
                              REAL(base_charge),
                              REAL(base_energy),
                              REAL(base_field),
                              REAL(work),
                              REAL(charging_loss),
                              REAL(drag_loss),
                              REAL(contact_loss),
                              REAL(internal_loss),
                              REAL(last_step),
                              REAL(next_step),
                              REAL(refreshed),
                              REAL(held_U),
                              REAL(held_energy),
                              REAL(held_charge),
                              REAL(held_capacitance)};
#undef REAL

enum { REALS = sizeof real / sizeof real[0], BY_HAND = REALS, FRONT, PLATFORM, WAS_OPEN, ARRAYS };

_Static_assert(sizeof(void *) != 8 || sizeof(ZpState) == (REALS + 4) * sizeof(double),
               "a checkpoint holds all of a state");

ZpCheckpoint *zp_checkpoint_create(size_t count) {
  ZpCheckpoint *checkpoint = zp_calloc(1, sizeof *checkpoint);
  if (!checkpoint) return NULL;
  *checkpoint = (ZpCheckpoint){count, zp_calloc(count + 1, sizeof(double)), zp_actuator_def_default()};
  if (checkpoint->number) return checkpoint;
  zp_free(checkpoint);
  return NULL;
}

void zp_checkpoint_destroy(ZpCheckpoint *checkpoint) {
  if (!checkpoint) return;
  zp_free(checkpoint->number);
  zp_free(checkpoint);
}

static size_t array_numbers(const ZpModel *model) {
  return (zp_state_size(model) - sizeof(ZpState)) / sizeof(double);
}

static void pack(const ZpModel *model, const ZpState *state, double *number) {
  for (size_t k = 0; k < REALS; k++)
    memcpy(&number[k], (const char *)state + real[k], sizeof *number);
  number[BY_HAND] = state->by_hand;
  number[FRONT] = (double)state->zip.front;
  number[PLATFORM] = state->zip.platform;
  number[WAS_OPEN] = state->was_open;
  memcpy(number + ARRAYS, state->data, array_numbers(model) * sizeof *number);
}

static void unpack(const ZpModel *model, const double *number, ZpState *state) {
  for (size_t k = 0; k < REALS; k++)
    memcpy((char *)state + real[k], &number[k], sizeof *number);
  state->by_hand = number[BY_HAND] != 0;
  state->zip.front = (size_t)number[FRONT];
  state->zip.platform = number[PLATFORM] != 0;
  state->was_open = number[WAS_OPEN] != 0;
  memcpy(state->data, number + ARRAYS, array_numbers(model) * sizeof *number);
}

/* -- what it fits ---------------------------------------------------------------------------------- */

bool zp_checkpoint_holds(int index) {
  static const char *const may_change[] = {
      "preset", "drive.",     "solver.end_time", "solver.tolerance", "solver.time_step", "solver.max_steps", "initial.",
      "data.",  "calibrate.", "modes.",          "isometric.",       "profile.",         "output."};
  const char *name = zp_key(index)->name;
  if (zp_key(index)->offset == ZP_NO_FIELD) return false;
  for (size_t k = 0; k < sizeof may_change / sizeof may_change[0]; k++) {
    size_t length = strlen(may_change[k]);
    bool group = may_change[k][length - 1] == '.';
    if (group ? strncmp(name, may_change[k], length) == 0 : strcmp(name, may_change[k]) == 0) return false;
  }
  return true;
}

static void print_value(int index, double value, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  bool bare = strcmp(key->unit, "1") == 0;
  if (key->type == ZP_KEY_ENUM)
    snprintf(text, size, "%s", key->choices[(int)value].word);
  else if (key->type == ZP_KEY_BOOL)
    snprintf(text, size, "%s", value != 0 ? "true" : "false");
  else if (isnan(value))
    snprintf(text, size, "auto");
  else
    snprintf(text, size, "%.15g%s%s", value, bare ? "" : " ", bare ? "" : key->unit);
}

static ZpStatus check_keys(const ZpActuatorDef *then, const ZpActuatorDef *now, ZpError *err) {
  for (int i = 0; i < zp_key_count(); i++) {
    double before = zp_def_get(then, i), asked = zp_def_get(now, i);
    if (!zp_checkpoint_holds(i) || before == asked || (isnan(before) && isnan(asked))) continue;
    char text[2][64];
    print_value(i, before, text[0], sizeof text[0]);
    print_value(i, asked, text[1], sizeof text[1]);
    return zp_fail(err, ZP_BAD_INPUT, "of another model: %s is %s there, %s here", zp_key(i)->name, text[0], text[1]);
  }
  return ZP_OK;
}

static bool is_flag(double value) {
  return value == 0 || value == 1;
}

static bool is_state(const ZpCheckpoint *checkpoint) {
  const double *number = checkpoint->number;
  if (checkpoint->count < ARRAYS || !(number[0] >= 0)) return false;
  double front = number[FRONT];
  if (!(front >= 0 && front < checkpoint->def.mesh.nodes && front == floor(front))) return false;
  if (!is_flag(number[BY_HAND]) || !is_flag(number[PLATFORM]) || !is_flag(number[WAS_OPEN])) return false;
  bool finite = isfinite(number[0]) && isfinite(number[1]);
  for (size_t k = ARRAYS; k < checkpoint->count && finite; k++)
    finite = isfinite(number[k]);
  return finite;
}

ZpStatus zp_checkpoint_check(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_keys(&checkpoint->def, def, err);
  if (status != ZP_OK) return status;
  if (!is_state(checkpoint)) return zp_fail(err, ZP_BAD_INPUT, "its numbers are not a state of an actuator");
  double t = checkpoint->number[0];
  if (def->solver.end_time > t) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "it stands at %.9g s already; solver.end_time is %.9g s", t, def->solver.end_time);
}

/* -- of a simulation ------------------------------------------------------------------------------- */

ZpStatus zp_sim_checkpoint(const ZpSim *sim, ZpCheckpoint **out, ZpError *err) {
  *out = NULL;
  if (sim->settled != ZP_REACHED_END) return ZP_OK;
  ZpCheckpoint *checkpoint = zp_checkpoint_create(ARRAYS + array_numbers(sim->model));
  if (!checkpoint) return zp_fail_memory(err);
  checkpoint->def = sim->model->def;
  pack(sim->model, zp_sim_passed(sim), checkpoint->number);
  *out = checkpoint;
  return ZP_OK;
}

ZpStatus zp_sim_continue(ZpSim *sim, const ZpCheckpoint *checkpoint, ZpError *err) {
  const ZpModel *model = sim->model;
  ZpStatus status = zp_checkpoint_check(checkpoint, &model->def, err);
  if (status != ZP_OK) return status;
  size_t count = ARRAYS + array_numbers(model);
  if (checkpoint->count != count)
    return zp_fail(err, ZP_BAD_INPUT, "%zu numbers: a state of this model has %zu", checkpoint->count, count);
  unpack(model, checkpoint->number, sim->state);
  zp_sim_resume(sim);
  return ZP_OK;
}
