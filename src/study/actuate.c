/* Study `actuate`: the motion after the voltage is switched on at t = 0, or under its waveform, and the zip time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "actuator/shape.h"
#include "base/fail.h"
#include "drive/response.h"
#include "run/margins.h"
#include "run/run.h"
#include "study/notes.h"
#include "study/rates.h"
#include "study/sense.h"
#include "study/sensitivity.h"
#include "study/studies.h"

/* Largest size of a signal in the rows and at the end. */
static double largest(ZpSim *sim, const ZpResult *result, const char *signal, const char *column) {
  double most = fabs(zp_at_end(sim, result, signal));
  for (size_t i = 0; i < result->series->rows; i++)
    most = fmax(most, fabs(zp_table_get(result->series, i, column)));
  return most;
}

/* Largest imbalance over the sum of the largest works of source, driven curvature and load: how well energy balances.
 */
static double energy_error(ZpSim *sim, const ZpResult *result) {
  if (isnan(zp_at_end(sim, result, "energy_imbalance"))) return NAN;
  double work = largest(sim, result, "electric_work", "electric_work_J") +
                largest(sim, result, "curvature_work", "curvature_work_J") +
                largest(sim, result, "load_work", "load_work_J");
  return work > 0 ? largest(sim, result, "energy_imbalance", "energy_imbalance_J") / work : NAN;
}

/* The widest opening passed on the way: a sudden voltage makes the platform sag before it rises. */
static double widest_opening(const ZpTable *series) {
  double widest = NAN;
  for (size_t i = 0; i < series->rows; i++)
    widest = fmax(widest, zp_table_get(series, i, "opening_m"));
  return widest;
}

static void summarize_closing(ZpSim *sim, ZpStop stop, ZpResult *result) {
  bool until_end = zp_outcome_good(result->outcome) && !(result->outcome == ZP_ZIPPED && stop == ZP_STOP_CLOSED);
  zp_result_add(result, "contraction", "1", zp_at_end(sim, result, "contraction"));
  zp_result_add(result, "zip_time_s", "s", zp_sim_zip_time(sim));
  zp_result_add(result, "closed_from_s", "s", until_end ? zp_sim_closed_from(sim) : NAN);
  zp_result_add(result, "zipped_length_m", "m", zp_at_end(sim, result, "zipped_length"));
}

static void summarize_opening(ZpSim *sim, ZpResult *result) {
  zp_result_add(result, "opening_m", "m", zp_at_end(sim, result, "opening"));
  zp_result_add(result, "start_opening_m", "m", zp_table_get(result->series, 0, "opening_m"));
  zp_result_add(result, "widest_opening_m", "m", widest_opening(result->series));
  if (zp_tells_angle(sim->model)) zp_result_add(result, "angle_rad", "rad", zp_at_end(sim, result, "angle"));
}

/* Work on a caught mass from then on, or on a dropped mass until then, J; to be added to that on load.mass. */
static double work_on_change(const ZpSim *sim) {
  double work = 0;
  for (const ZpSim *m = sim; m < sim + sim->members; m++) {
    ZpMotion motion = zp_state_motion(m->model, m->state);
    size_t j = zp_load_node(&m->model->topology);
    double along = motion.x[j] - m->state->changed_x, up = motion.y[j] - m->state->changed_y;
    work -= m->model->parts * zp_state_hung(m->model, m->state) * (m->model->fall[0] * along + m->model->fall[1] * up);
  }
  return work;
}

/* Work before a run that resumes; of a network, where its bodies begin, J. */
typedef struct Booked {
  double energy, load_work, on_change;
  double lifted;
} Booked;

static Booked booked_before(ZpSim *sim, bool resumes) {
  const double lifted = zp_is_network(sim->model) ? zp_sim_lifted(sim) : 0;
  if (!resumes) return (Booked){.lifted = lifted};
  return (Booked){zp_sim_get(sim, "source_energy"), zp_sim_get(sim, "load_work"), work_on_change(sim), lifted};
}

/* Work on a load that does not only rise: at a free end, where a spring of a hinge is not part of it, and that of a
 * platform that turns, J. */
static double work_along_path(ZpSim *sim, const ZpModel *model, const ZpResult *result) {
  ZpMotion motion = zp_state_motion(model, sim->state);
  ZpShape start = zp_shapes_get(result->shapes, 0);
  double along = zp_load_at(model, motion.x) - zp_load_at(model, start.x),
         up = zp_load_at(model, motion.y) - zp_load_at(model, start.y);
  return zp_load_work(model, along, up);
}

/* Work against pull and springs of the load from start to end, J. */
static double work_on_load(ZpSim *sim, const ZpModel *model, Booked before, const ZpResult *result) {
  double risen = zp_table_get(result->series, 0, "opening_m") - zp_at_end(sim, result, "opening");
  double compressed = zp_at_end(sim, result, "spring_energy") - zp_table_get(result->series, 0, "spring_energy_J");
  return (zp_is_network(model) ? zp_sim_lifted(sim) - before.lifted : zp_total_pull(model) * risen) + compressed;
}

/* Work on the load over the energy from the source, J. */
static void add_efficiency(ZpResult *result, double work, double energy) {
  bool sound = energy > 0 && work >= 0 && work <= energy;
  zp_result_add(result, "efficiency", "1", sound ? work / energy : NAN);
  if (energy > 0 && work < 0)
    zp_result_note(result, "efficiency is null: the load ends lower than it began; the work on it is %.3g J", work);
  if (energy > 0 && work > energy)
    zp_result_note(
        result,
        "efficiency is null: the work on the load, %.3g J, is more than the source gave, %.3g J; the rest was stored "
        "before",
        work, energy);
}

/* The energy that the source delivered, and what became of it. The load input takes part in the work on the load. */
static void summarize_source(ZpSim *sim, const ZpModel *model, const ZpRunInfo *info, Booked before, ZpResult *result) {
  ZpCurrents currents = zp_sim_currents(sim, info->simulated_time);
  double energy = zp_at_end(sim, result, "source_energy");
  zp_result_add(result, "peak_current_A", "A", currents.peak);
  zp_result_add(result, "rms_current_A", "A", currents.rms);
  zp_result_add(result, "source_energy_J", "J", energy);
  double highest = zp_waveform_largest(&model->waveform), limit = model->def.source.voltage_limit;
  if (model->supply.acts && isfinite(limit) && highest > 0)
    zp_result_add(result, "source_voltage_margin", "1", limit / highest);
  if (!zp_is_pair(&model->topology)) return;
  bool rises = zp_is_network(model) || (zp_has_platform(&model->topology) && !zp_platform_turns(&model->topology));
  double work = rises ? work_on_load(sim, model, before, result) : work_along_path(sim, model, result);
  work += work_on_change(sim) - before.on_change - (zp_at_end(sim, result, "load_work") - before.load_work);
  zp_result_add(result, "mechanical_work_J", "J", work);
  add_efficiency(result, work, energy - before.energy);
}

static void summarize_steps(const ZpRunInfo *info, ZpResult *result) {
  static const char *const limited[ZP_LIMIT_COUNT] = {"steps_limited_by_time_step", "steps_limited_by_stability",
                                                      "steps_limited_by_drag",      "steps_limited_by_event",
                                                      "steps_limited_by_error",     "steps_limited_by_end"};
  static const char *const bound[3] = {"smallest_drag_bound_s", "smallest_axial_bound_s", "smallest_shear_bound_s"};
  zp_result_add(result, "steps", "count", (double)info->steps);
  zp_result_add(result, "mean_time_step_s", "s", info->steps ? info->simulated_time / (double)info->steps : NAN);
  zp_result_add(result, "simulated_time_s", "s", info->simulated_time);
  for (int k = 0; k < ZP_LIMIT_COUNT; k++)
    zp_result_add(result, limited[k], "count", (double)info->limited[k]);
  zp_result_add(result, "steps_rejected", "count", (double)info->rejected);
  zp_result_add(result, "newton_failures", "count", (double)info->failures);
  zp_result_add(result, "newton_iterations", "count", (double)info->iterations);
  for (int k = 0; k < 3; k++)
    zp_result_add(result, bound[k], "s", isfinite(info->smallest_bound[k]) ? info->smallest_bound[k] : NAN);
  zp_result_add(result, "settle_steps", "count", (double)info->settle_steps);
  zp_result_add(result, "settle_residual", "1", info->settle_residual);
  zp_result_add_timing(result, "real_time_factor", "1",
                       info->wall_time > 0 ? info->simulated_time / info->wall_time : NAN);
}

/* Advice where the energy of a run does not balance. */
static const char *remedy(const ZpActuatorDef *def) {
  if (def->electro.surface == ZP_SURFACE_BEZIER || def->ribbon.model == ZP_RIBBON_MASS_SPRING)
    return "mass_spring and bezier have no energy, so it cannot balance";
  if (def->electro.model == ZP_ELECTRO_FIELD)
    return "try a smaller electro.refresh_change together with a smaller solver.tolerance";
  return "try a smaller solver.tolerance or solver.time_step";
}

static void note_imbalance(const ZpActuatorDef *def, ZpResult *result) {
  static const double most = 1e-4;
  double error = zp_result_get(result, "energy_error");
  if (error > most)
    zp_result_note(result, "the error of the energy balance is %.2g of the work done, above %g; %s", error, most,
                   remedy(def));
}

static bool was_open(const ZpSim *sim) {
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    if (m->state->was_open) return true;
  return false;
}

/* Note an actuator that starts closed, or nearly so. */
static void note_start(const ZpSim *sim, const ZpModel *model, ZpResult *result) {
  double opening = zp_table_get(result->series, 0, "opening_m");
  if (model->field && sim->state->t > 0 && !was_open(sim))
    zp_result_note(result, "the actuator starts closed and does not open, so it does not zip: zip_time_s is null");
  else if (opening > 0)
    zp_note_start(result, model, opening);
}

static void note(const ZpSim *sim, const ZpModel *model, ZpResult *result) {
  double highest = zp_waveform_largest(&model->waveform);
  ZpMargins seen = zp_sim_margins(sim);
  note_imbalance(zp_model_def(model), result);
  if (model->field)
    zp_add_margins(result, model, &seen);
  else
    zp_add_stress(result, model, &seen);
  zp_note_mesh(result, model, highest);
  if (highest > 0) note_start(sim, model, result);
  zp_note_liquid(result, model);
  double starved = zp_result_get(result, "starved_time_s");
  if (isfinite(starved))
    zp_result_note(
        result,
        "the bead is too small: from %.3g ms on the zip front is beyond its liquid and closes in air; increase "
        "bead.volume",
        1e3 * starved);
  if (isfinite(zp_result_get(result, "zip_time_s")) && model->def.medium.density > 0)
    zp_result_note(result, model->has_film
                               ? "the zip time has not been compared with a measured one"
                               : "the zip time is not a prediction: the drag of the liquid is not modelled");
}

/* Add what these signals, up to NULL, are at the end. */
static void add_at_end(ZpSim *sim, ZpResult *result, const char *const *signal) {
  size_t count;
  const ZpColumn *column = zp_signal_columns(&count);
  for (; *signal; signal++)
    for (size_t k = 0; k < count; k++)
      if (strcmp(zp_signal_name(k), *signal) == 0)
        zp_result_add(result, column[k].name, column[k].unit, zp_at_end(sim, result, *signal));
}

static const char *const of_film[] =
    {"film_thickness", "viscous_loss", "film_along_loss", "film_across_loss", "jet_loss", "outer_drag_loss", NULL},
                         *const of_leak[] = {"leak_loss", "leak_current", "interface_voltage", NULL},
                         *const of_yielding[] = {"plastic_loss", "permanent_curvature", NULL},
                         *const of_catch[] = {"catch_loss", NULL},
                         *const of_bead[] = {"meniscus_loss", "wet_length", "bead_outside", "bead_lost", NULL};

/* Losses and signals of laws that signals.def does not list, but for what has stayed 0. */
static void summarize_laws(ZpSim *sim, ZpResult *result) {
  size_t count;
  const ZpColumn *column = zp_signal_columns(&count);
  for (size_t k = 0; zp_sim_next_row(sim, &k);) {
    const double value = zp_at_end(sim, result, zp_signal_name(k));
    if (value != 0) zp_result_add(result, column[k].name, column[k].unit, value);
  }
}

/* A number of the last row for a member or a body: "#.opening_m". */
static void add_last(const ZpResult *from, const char *group, const char *column, const char *called, const char *unit,
                     ZpResult *result) {
  char name[2 * ZP_NAME_SIZE], pattern[2 * ZP_NAME_SIZE];
  snprintf(name, sizeof name, "%s.%s", called, column);
  snprintf(pattern, sizeof pattern, "%s.#.%s", group, column);
  const size_t rows = from->series->rows;
  zp_result_add_of(result, pattern, called, unit, rows > 0 ? zp_table_get(from->series, rows - 1, name) : NAN);
}

/* Members and bodies of a network at the end. */
static void summarize_network(const ZpSim *sim, const ZpModel *model, ZpResult *result) {
  char room[ZP_NAME_SIZE];
  for (size_t k = 0; k < model->members; k++) {
    const char *called = zp_member_called(model->whole, k + 1, room);
    add_last(result, "members", "opening_m", called, "m", result);
    add_last(result, "members", "zipped_length_m", called, "m", result);
    zp_result_add_of(result, "members.#.zip_time_s", called, "s", sim[k].state->zip_time);
    zp_result_add_of(result, "members.#.closed_from_s", called, "s", sim[k].state->closed_from);
  }
  size_t columns;
  const ZpColumn *column = zp_body_columns(model->network->plane, &columns);
  for (size_t body = 1; body < model->network->bodies; body++)
    for (size_t c = 0; c < columns; c++) /* "#.x_m" */
      add_last(result, "bodies", column[c].name + 2, zp_body_called(model->whole, body, room), column[c].unit, result);
}

/* When each member of a series has closed. */
static void summarize_members(const ZpSim *sim, const ZpModel *model, ZpResult *result) {
  char room[ZP_NAME_SIZE];
  if (zp_is_network(model)) {
    summarize_network(sim, model, result);
    return;
  }
  for (size_t k = 1; model->members > 1 && k <= model->members; k++)
    zp_result_add_of(result, "member_#_zip_time_s", zp_member_called(model->whole, k, room), "s",
                     zp_sim_member_zip_time(sim, k));
}

/* Of all members. */
static bool has_constant_drive(const ZpModel *first) {
  bool constant = true;
  for (const ZpModel *model = first; model < first + first->members; model++)
    constant &= zp_waveform_is_constant(&model->waveform) && model->def.control.kind == ZP_CONTROL_NONE;
  return constant;
}

static ZpStop stop_of(const ZpModel *model) {
  const ZpActuatorDef *def = zp_model_def(model);
  if (def->solver.stop_when_zipped == ZP_WHEN_TRUE) return ZP_STOP_CLOSED;
  bool ideal = def->source.model == ZP_SOURCE_IDEAL && !model->leaks;
  bool may = def->solver.stop_when_zipped == ZP_WHEN_AUTO && has_constant_drive(model) && ideal;
  return may ? ZP_STOP_HELD : ZP_STOP_AT_END;
}

/* Under a constant drive, whether an actuator that has closed is closed at the end, and since when. A run that stops
 * where it has closed, and sequential contact, which never opens, leave nothing to say. */
static void judge(const ZpSim *sim, const ZpModel *model, ZpStop stop, ZpRunInfo *info) {
  double zip = zp_sim_zip_time(sim), from = zp_sim_closed_from(sim), t = sim->state->t;
  bool at_once = stop == ZP_STOP_CLOSED || model->def.contact.model == ZP_CONTACT_SEQUENTIAL;
  bool ended = info->outcome == ZP_REACHED_END || (info->outcome == ZP_ZIPPED && !at_once);
  if (!ended || !has_constant_drive(model) || isnan(zip)) return;
  info->outcome = isnan(from) ? ZP_REOPENED : ZP_ZIPPED;
  char *text = info->message;
  size_t size = sizeof info->message;
  if (isnan(from))
    snprintf(text, size, "closed after %.4g ms, but is open at the end, at %.4g s", 1e3 * zip, t);
  else if (from > zip)
    snprintf(text, size, "closed after %.4g ms, stays closed from %.4g ms to the end, at %.4g s", 1e3 * zip, 1e3 * from,
             t);
  else
    snprintf(text, size, "closed after %.4g ms, stays closed to the end, at %.4g s", 1e3 * zip, t);
}

static void summarize(ZpSim *sim, const ZpModel *model, ZpStop stop, const ZpRunInfo *info, Booked before,
                      ZpResult *result) {
  result->outcome = info->outcome;
  memcpy(result->message, info->message, sizeof result->message);
  if (model->field) summarize_closing(sim, stop, result);
  if (zp_is_pair(&model->topology)) summarize_opening(sim, result);
  if (zp_follows_voltage(model)) zp_result_add(result, "energy_error", "1", energy_error(sim, result));
  if (model->has_film) add_at_end(sim, result, of_film);
  if (model->leaks) add_at_end(sim, result, of_leak);
  if (model->rod.plastic) add_at_end(sim, result, of_yielding);
  if (!isnan(model->whole->load.change_time)) add_at_end(sim, result, of_catch);
  if (model->has_bead) add_at_end(sim, result, of_bead);
  if (model->has_bead) zp_result_add(result, "starved_time_s", "s", zp_sim_starved_time(sim));
  summarize_laws(sim, result);
  summarize_members(sim, model, result);
  zp_result_add(result, "stroke_m", "m", zp_at_end(sim, result, "stroke"));
  zp_result_add(result, "start_stroke_m", "m", zp_table_get(result->series, 0, "stroke_m"));
  if (model->field) summarize_source(sim, model, info, before, result);
  summarize_steps(info, result);
}

static ZpStatus check_start(const ZpActuatorDef *def, const ZpCheckpoint *start, ZpError *err) {
  bool goes_on = def->initial.state == ZP_INITIAL_CHECKPOINT;
  if (goes_on && !start)
    return zp_fail(err, ZP_BAD_INPUT,
                   "initial.state = checkpoint: no checkpoint was given; the input of zp_study_run takes it");
  if (start && !goes_on)
    return zp_fail(err, ZP_BAD_INPUT, "initial.state: a checkpoint was given; it requires initial.state checkpoint");
  return ZP_OK;
}

/* -- under a controller ----------------------------------------------------------------------------- */

_Static_assert(sizeof(ZpResponseSample) == ZP_SAMPLE_COLUMNS * sizeof(double), "a row of the table is a sample");

/* From now on the simulation keeps all its samples here: its owner's; NULL if there is no memory. */
static ZpTable *watch_loop(ZpSim *sim) {
  const ZpActuatorDef *def = zp_model_def(sim->model);
  size_t columns;
  const ZpColumn *column = zp_sample_columns(&columns);
  ZpTable *samples = zp_table_create(column, columns, (size_t)(def->solver.end_time / def->control.period) + 4);
  zp_sim_keep_samples(sim, samples);
  return samples;
}

/* A setpoint that the controller asks for in vain. */
static void note_limit(const ZpSim *sim, const ZpResponse *response, ZpResult *result) {
  static const double little = 0.02; /* of the setpoint */
  double highest = sim->model->control.highest, command = zp_sim_is_fed(sim) ? zp_sim_command(sim) : sim->state->U;
  bool at_limit = command == 0 || command == highest;
  if (at_limit && fabs(response->error) > little * fabs(zp_sim_setpoint(sim)))
    zp_result_note(
        result,
        "the setpoint is not held: the run ends with the controller at its limit of %g V (its range is 0 V to "
        "drive.voltage)",
        command);
}

/* How the signal has answered, from the samples, at the end of the run. */
static void summarize_loop(ZpSim *sim, ZpTable *samples, ZpResult *result) {
  zp_table_offer(samples, (double[ZP_SAMPLE_COLUMNS]){sim->state->t, zp_sim_setpoint(sim), zp_sim_controlled(sim)});
  ZpResponse response = zp_response_of((const ZpResponseSample *)(const void *)samples->value, samples->rows);
  const char *unit = zp_control_unit(zp_model_def(sim->model));
  zp_result_add(result, "rise_time_s", "s", response.rise_time);
  zp_result_add(result, "overshoot", "1", response.overshoot);
  zp_result_add(result, "steady_state_error", unit, response.error);
  zp_result_add(result, "steady_state_ripple", unit, response.ripple);
  zp_result_add(result, "settling_time_s", "s", response.settling_time);
  note_limit(sim, &response, result);
}

/* -- the run -------------------------------------------------------------------------------------- */

/* A run that resumes where it would end continues to the end time. */
static ZpStatus simulate(ZpSim *sim, const ZpModel *model, const ZpCheckpoint *start, const ZpHooks *hooks,
                         ZpResult *result, ZpError *err) {
  zp_sim_record(sim, result->series, result->shapes);
  zp_sim_watch(sim);
  ZpStatus status = start ? zp_sim_continue(sim, start, err) : ZP_OK;
  if (status != ZP_OK) return status;
  const ZpActuatorDef *def = zp_model_def(model);
  const Booked before = booked_before(sim, start != NULL);
  const ZpStop stop = zp_sim_stops(sim, stop_of(model)) ? ZP_STOP_AT_END : stop_of(model);
  bool controlled = def->control.kind != ZP_CONTROL_NONE;
  ZpTable *samples = controlled ? watch_loop(sim) : NULL;
  if (controlled && !samples) return zp_fail_memory(err);
  ZpRunInfo info;
  ZpRunSensitivity rates;
  status = zp_rates_open(&rates, sim, err);
  if (status == ZP_OK) {
    zp_sim_run_until(sim, def->solver.end_time, stop, hooks, &info);
    judge(sim, model, stop, &info);
    summarize(sim, model, stop, &info, before, result);
    zp_rates_add(&rates, result);
  }
  zp_run_sensitivity_close(&rates);
  if (status != ZP_OK) return status;
  if (controlled) summarize_loop(sim, samples, result);
  zp_sim_keep_samples(sim, NULL);
  zp_table_destroy(samples);
  note(sim, model, result);
  return zp_sim_checkpoint(sim, &result->checkpoint, err);
}

/* With meters: their readings. */
static ZpStatus simulate_sensed(ZpSim *sim, const ZpTask *task, const ZpModel *model, ZpResult *result, ZpError *err) {
  ZpStatus status =
      zp_sense_begin(sim) ? simulate(sim, model, task->input.start, task->hooks, result, err) : zp_fail_memory(err);
  if (status == ZP_OK && zp_outcome_good(result->outcome)) status = zp_sense(task, sim, result, err);
  zp_sense_end(sim);
  return status;
}

static ZpStatus run(const ZpTask *task, const ZpModel *model, ZpResult *result, ZpError *err) {
  const ZpActuatorDef *def = zp_model_def(model);
  result->series = zp_signal_table(task->def, (size_t)def->output.samples);
  result->shapes = zp_model_shapes(model, (size_t)def->output.shapes);
  if (!result->series || !result->shapes) return zp_fail_memory(err);
  ZpSim *sim;
  ZpStatus status = zp_sim_create(model, task->hooks, &sim, err);
  if (status != ZP_OK) return status;
  if (zp_senses(model))
    status = simulate_sensed(sim, task, model, result, err);
  else
    status = simulate(sim, model, task->input.start, task->hooks, result, err);
  zp_sim_destroy(sim);
  return status;
}

static const ZpRule rule[] = {
    ZP_RULE(NOT_MODELLED, ZP_SET(sensitivity.by), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
            "the derivatives follow implicit steps"),
    ZP_RULE(NOT_MODELLED, ZP_SET(sensitivity.by), ZP_NOT(initial.state, ZP_INITIAL_CHECKPOINT),
            "a checkpoint does not contain its derivatives by a key"),
    ZP_RULE_DERIVATIVES,
};
const ZpRules zp_rules_actuate = ZP_RULES_OF(rule);

ZpStatus zp_check_actuate(const ZpActuatorDef *def, ZpError *err) {
  bool table = def->drive.waveform == ZP_WAVEFORM_TABLE; /* whose voltages are not in the Def */
  ZpStatus status = zp_check_sensitivity(def, err);
  if (status != ZP_OK || table) return status;
  return zp_def_check_voltage(def, fmax(fabs(def->drive.voltage), fabs(def->drive.offset)), err);
}

ZpStatus zp_study_actuate(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = check_start(task->def, task->input.start, err);
  if (status == ZP_OK) status = zp_model_create_driven(task->def, task->input.table, &model, err);
  if (status != ZP_OK) return status;
  status = run(task, model, result, err);
  zp_model_destroy(model);
  return status;
}

ZpStatus zp_study_zip_time(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpSim *sim;
  ZpStatus status = zp_model_create_driven(task->def, task->input.table, &model, err);
  if (status != ZP_OK) return status;
  status = zp_sim_create(model, task->hooks, &sim, err);
  if (status == ZP_OK) {
    zp_implicit_hasten(&sim->dynamics.stepper);
    result->outcome = zp_sim_run(sim, task->def->solver.end_time, true, task->hooks, NULL);
    zp_result_add(result, "zip_time_s", "s", zp_sim_zip_time(sim));
    zp_sim_destroy(sim);
  }
  zp_model_destroy(model);
  return status;
}
