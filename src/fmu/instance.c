/* The phases of an instance: when variables may be set, when its simulation is built, what a step does. */
#include "fmu/instance.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/instances.h"
#include "run/run.h"

/* -- life ------------------------------------------------------------------------------------------ */

ZpStatus zp_fmu_reset(ZpFmu *fmu, ZpError *err) {
  zp_def_clear(&fmu->def);
  ZpStatus status = zp_fmu_start_def(&fmu->start, &fmu->def, err);
  if (status != ZP_OK) return status;
  fmu->phase = ZP_FMU_INSTANTIATED;
  fmu->start_time = fmu->time = 0;
  memset(fmu->rate, 0, sizeof fmu->rate);
  memset(fmu->input, 0, sizeof fmu->input);
  for (int input = zp_def_input_next(&fmu->def, -1); input >= 0; input = zp_def_input_next(&fmu->def, input))
    fmu->input[input] = zp_fmu_first(&fmu->def, input);
  fmu->prepared = false;
  return ZP_OK;
}

ZpStatus zp_fmu_create(const ZpFmuStart *start, ZpFmu **out, ZpError *err) {
  *out = NULL;
  ZpFmu *fmu = zp_calloc(1, sizeof *fmu);
  if (!fmu) return zp_fail_memory(err);
  fmu->start = *start;
  ZpStatus status = zp_fmu_reset(fmu, err);
  if (status == ZP_OK)
    *out = fmu;
  else
    zp_fmu_destroy(fmu);
  return status;
}

static void drop_model(ZpFmu *fmu) {
  zp_sim_destroy(fmu->sim);
  zp_model_destroy(fmu->model);
  zp_free(fmu->origin);
  fmu->sim = NULL;
  fmu->model = NULL;
  fmu->origin = NULL;
}

void zp_fmu_destroy(ZpFmu *fmu) {
  if (!fmu) return;
  drop_model(fmu);
  zp_def_clear(&fmu->def);
  zp_free(fmu);
}

/* -- the simulation -------------------------------------------------------------------------------- */

/* Was the model built with these parameters? */
static bool is_built(const ZpFmu *fmu) {
  if (!fmu->sim) return false;
  for (int key = zp_key_next_field(-1); key >= 0; key = zp_key_next_field(key)) {
    double wanted = zp_def_get(&fmu->def, key), has = zp_def_get(fmu->model->whole, key);
    if (wanted != has && !(isnan(wanted) && isnan(has))) return false;
  }
  const ZpActuatorDef *whole = fmu->model->whole;
  for (size_t k = 0; fmu->def.given && k < fmu->def.given->count; k++)
    if (zp_def_get(whole, fmu->def.given->value[k].key) != fmu->def.given->value[k].value) return false;
  return true;
}

/* If the hanging equilibrium was not found, report it when the run starts. */
static ZpStatus check_start(ZpSim *sim, ZpError *err) {
  ZpRunInfo info;
  if (zp_sim_run(sim, 0, false, NULL, &info) == ZP_REACHED_END) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s", info.message);
}

static ZpStatus keep_origin(ZpFmu *fmu, ZpError *err) {
  fmu->origin = zp_calloc(1, zp_sim_state_size(fmu->sim));
  if (!fmu->origin) return zp_fail_memory(err);
  zp_sim_save(fmu->sim, fmu->origin);
  return ZP_OK;
}

static ZpStatus build(ZpFmu *fmu, ZpError *err) {
  drop_model(fmu);
  if (zp_def_members(&fmu->def) > 1 && !zp_def_network(&fmu->def))
    return zp_fail(err, ZP_BAD_INPUT, "a stack of %d members: an FMU contains a single actuator or a network",
                   zp_def_members(&fmu->def));
  ZpStatus status = zp_model_create(&fmu->def, &fmu->model, err);
  if (status == ZP_OK) status = zp_sim_create(fmu->model, NULL, &fmu->sim, err);
  if (status == ZP_OK) status = check_start(fmu->sim, err);
  if (status == ZP_OK) status = keep_origin(fmu, err);
  if (status != ZP_OK) drop_model(fmu);
  return status;
}

ZpStatus zp_fmu_need_model(ZpFmu *fmu, ZpError *err) {
  return is_built(fmu) ? ZP_OK : build(fmu, err);
}

static bool has_input(const ZpFmu *fmu, int input) {
  return zp_def_input_unit(&fmu->def, input) != NULL;
}

/* Read the current signals. */
static void read_row(ZpFmu *fmu) {
  zp_sim_read_columns(fmu->sim, (size_t)zp_fmu_outputs(&fmu->def), fmu->row);
  fmu->stale = false;
}

/* Read the signals without motion: mean current and power remain those of the last step, because a jump of an input now
 * counts in the next step. */
static void read_row_again(ZpFmu *fmu) {
  double current = fmu->row[ZP_FMU_SIGNAL_current], power = fmu->row[ZP_FMU_SIGNAL_power];
  read_row(fmu);
  fmu->row[ZP_FMU_SIGNAL_current] = current;
  fmu->row[ZP_FMU_SIGNAL_power] = power;
}

ZpStatus zp_fmu_prepare(ZpFmu *fmu, ZpError *err) {
  if (fmu->prepared) return ZP_OK;
  ZpStatus status = zp_fmu_need_model(fmu, err);
  if (status == ZP_OK) status = zp_sim_restore(fmu->sim, fmu->origin, zp_sim_state_size(fmu->sim), err);
  for (int input = zp_def_input_next(&fmu->def, -1); input >= 0 && status == ZP_OK;
       input = zp_def_input_next(&fmu->def, input))
    status = zp_sim_set_input(fmu->sim, (ZpInput)input, fmu->input[input], fmu->rate[input], err);
  if (status != ZP_OK) return status;
  fmu->row[ZP_FMU_SIGNAL_current] = fmu->row[ZP_FMU_SIGNAL_power] = 0;
  read_row_again(fmu);
  fmu->prepared = true;
  return ZP_OK;
}

ZpStatus zp_fmu_begin(ZpFmu *fmu, ZpError *err) {
  ZpStatus status = zp_fmu_prepare(fmu, err);
  if (status == ZP_OK) zp_sim_start_row(fmu->sim);
  return status;
}

/* -- variables ------------------------------------------------------------------------------------- */

/* Keys of a network are parameters where they are given. */
static bool has_parameter(const ZpFmu *fmu, int key) {
  if (key < ZP_KEYS) return zp_fmu_is_parameter(key, fmu->start.value[key]);
  for (size_t k = 0; k < fmu->start.givens; k++)
    if (fmu->start.given[k].key == key) return zp_fmu_is_parameter(key, fmu->start.given[k].value);
  return false;
}

static ZpStatus find(const ZpFmu *fmu, uint32_t reference, ZpFmuVariable *variable, ZpError *err) {
  bool found = zp_fmu_find(reference, variable);
  if (found && variable->role == ZP_FMU_PARAMETER) found = has_parameter(fmu, variable->index);
  if (found && variable->role == ZP_FMU_INPUT) found = has_input(fmu, variable->index);
  if (found && variable->role == ZP_FMU_OUTPUT) found = variable->index < zp_fmu_outputs(&fmu->def);
  return found ? ZP_OK : zp_fail(err, ZP_BAD_INPUT, "value reference %u: there is no such variable", reference);
}

static ZpStatus find_typed(const ZpFmu *fmu, uint32_t reference, ZpKeyType type, ZpFmuVariable *variable,
                           ZpError *err) {
  ZpStatus status = find(fmu, reference, variable, err);
  if (status != ZP_OK || zp_fmu_type(*variable) == type) return status;
  return zp_fail(err, ZP_BAD_INPUT, "%s: this variable has another type", zp_fmu_text(&fmu->def, *variable).name);
}

static ZpStatus get_output(ZpFmu *fmu, int index, double *value, ZpError *err) {
  ZpStatus status = zp_fmu_prepare(fmu, err);
  if (status != ZP_OK) return status;
  if (fmu->stale) read_row_again(fmu);
  *value = fmu->row[index];
  return ZP_OK;
}

ZpStatus zp_fmu_get(ZpFmu *fmu, uint32_t reference, ZpKeyType type, double *value, ZpError *err) {
  ZpFmuVariable variable;
  ZpStatus status = find_typed(fmu, reference, type, &variable, err);
  if (status != ZP_OK) return status;
  if (variable.role == ZP_FMU_OUTPUT) return get_output(fmu, variable.index, value, err);
  if (variable.role == ZP_FMU_TIME)
    *value = fmu->time;
  else if (variable.role == ZP_FMU_INPUT)
    *value = fmu->input[variable.index];
  else
    *value = zp_def_get(&fmu->def, variable.index);
  return ZP_OK;
}

static ZpStatus set_input(ZpFmu *fmu, ZpInput input, double value, double rate, ZpError *err) {
  if (fmu->phase & (ZP_FMU_TERMINATED | ZP_FMU_FAILED))
    return zp_fail(err, ZP_BAD_INPUT, "%s: the simulation has ended",
                   zp_fmu_text(&fmu->def, (ZpFmuVariable){ZP_FMU_INPUT, (int)input}).name);
  ZpStatus status = fmu->prepared ? zp_sim_set_input(fmu->sim, input, value, rate, err) : ZP_OK;
  if (status != ZP_OK) return status;
  fmu->input[input] = value;
  fmu->rate[input] = rate;
  fmu->stale = true;
  return ZP_OK;
}

/* Continue the simulation in a model with another value of a key. On failure nothing changes. */
static ZpStatus tune(ZpFmu *fmu, int key, double value, ZpError *err) {
  size_t size = zp_fmu_state_size(fmu);
  unsigned char *before = zp_calloc(2, size);
  if (!before) return zp_fail_memory(err);
  unsigned char *after = before + size;
  zp_fmu_save(fmu, before);
  ZpStatus status = zp_def_set(&fmu->def, key, value, err);
  if (status == ZP_OK) {
    zp_fmu_save(fmu, after);
    status = zp_fmu_load(fmu, after, size, err);
    ZpError ignored;
    if (status != ZP_OK) zp_fmu_load(fmu, before, size, &ignored);
  }
  zp_free(before);
  return status;
}

static ZpStatus set_parameter(ZpFmu *fmu, int key, double value, ZpError *err) {
  bool running = fmu->phase & (ZP_FMU_STEPPING | ZP_FMU_AT_EVENT);
  if (running && zp_fmu_is_tunable(key)) return tune(fmu, key, value, err);
  if (!(fmu->phase & (ZP_FMU_INSTANTIATED | ZP_FMU_INITIALIZING)))
    return zp_fail(err, ZP_BAD_INPUT, "%s: a fixed parameter can be set until initialization ends",
                   zp_fmu_text(&fmu->def, (ZpFmuVariable){ZP_FMU_PARAMETER, key}).name);
  ZpStatus status = zp_def_set(&fmu->def, key, value, err);
  if (status == ZP_OK) fmu->prepared = false;
  return status;
}

ZpStatus zp_fmu_set(ZpFmu *fmu, uint32_t reference, ZpKeyType type, double value, ZpError *err) {
  ZpFmuVariable variable;
  ZpStatus status = find_typed(fmu, reference, type, &variable, err);
  if (status != ZP_OK) return status;
  if (variable.role == ZP_FMU_INPUT) return set_input(fmu, (ZpInput)variable.index, value, 0, err);
  if (variable.role == ZP_FMU_PARAMETER) return set_parameter(fmu, variable.index, value, err);
  return zp_fail(err, ZP_BAD_INPUT, "%s: only inputs and parameters can be set", zp_fmu_text(&fmu->def, variable).name);
}

ZpStatus zp_fmu_set_rate(ZpFmu *fmu, uint32_t reference, double rate, ZpError *err) {
  ZpFmuVariable variable;
  ZpStatus status = find(fmu, reference, &variable, err);
  if (status != ZP_OK) return status;
  if (variable.role != ZP_FMU_INPUT)
    return zp_fail(err, ZP_BAD_INPUT, "%s: not an input", zp_fmu_text(&fmu->def, variable).name);
  return set_input(fmu, (ZpInput)variable.index, fmu->input[variable.index], rate, err);
}

/* -- steps ----------------------------------------------------------------------------------------- */

ZpStatus zp_fmu_step(ZpFmu *fmu, double end, bool to_event, ZpFmuStep *step, ZpError *err) {
  *step = (ZpFmuStep){false, false};
  double before = zp_sim_get(fmu->sim, "time"), dt = end - fmu->start_time - before;
  if (!(dt > 0) || isinf(dt))
    return zp_fail(err, ZP_BAD_INPUT, "a step cannot end at %.17g s: the simulation is at %.17g s already", end,
                   fmu->time);
  ZpRunInfo info;
  ZpOutcome outcome =
      to_event ? zp_sim_step_to_event(fmu->sim, dt, NULL, &info) : zp_sim_step(fmu->sim, dt, NULL, &info);
  read_row(fmu);
  double reached = fmu->row[ZP_FMU_SIGNAL_time];
  fmu->time = reached < before + dt ? fmu->start_time + reached : end;
  step->event = outcome == ZP_EVENT;
  step->terminate = outcome == ZP_SHORT_CIRCUIT;
  if (outcome == ZP_REACHED_END || step->event || step->terminate) return ZP_OK;
  fmu->phase = ZP_FMU_FAILED;
  return zp_fail(err, ZP_MACHINE, "%s", info.message);
}

ZpStatus zp_fmu_slopes(ZpFmu *fmu, uint32_t by, double slope[ZP_FMU_OUTPUTS], ZpError *err) {
  ZpFmuVariable input;
  ZpStatus status = find(fmu, by, &input, err);
  if (status == ZP_OK && input.role != ZP_FMU_INPUT)
    status = zp_fail(err, ZP_BAD_INPUT, "derivatives with respect to %s: available for inputs only",
                     zp_fmu_text(&fmu->def, input).name);
  if (status == ZP_OK) status = zp_fmu_prepare(fmu, err);
  const int outputs = zp_fmu_outputs(&fmu->def);
  if (status == ZP_OK) status = zp_sim_column_slopes(fmu->sim, (ZpInput)input.index, (size_t)outputs, slope, err);
  for (int k = 0; k < outputs && status == ZP_OK; k++)
    if (!zp_fmu_follows(&fmu->def, k, input.index)) slope[k] = 0;
  return status;
}

ZpStatus zp_fmu_signal(const ZpFmu *fmu, uint32_t reference, int *signal, ZpError *err) {
  ZpFmuVariable output;
  ZpStatus status = find(fmu, reference, &output, err);
  if (status == ZP_OK && output.role != ZP_FMU_OUTPUT)
    status = zp_fail(err, ZP_BAD_INPUT, "derivatives of %s: available for outputs only",
                     zp_fmu_text(&fmu->def, output).name);
  if (status == ZP_OK) *signal = output.index;
  return status;
}
