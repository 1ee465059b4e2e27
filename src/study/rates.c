#include "study/rates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/check.h"
#include "run/supply_coupling.h"
#include "study/sensitivity.h"

ZpStatus zp_rates_open(ZpRunSensitivity *rates, ZpSim *sim, ZpError *err) {
  int key[ZP_MAX_SENSITIVITY_KEYS], keys;
  ZpStatus status = zp_sensitivity_keys(zp_model_def(sim->model), key, &keys, err);
  *rates = (ZpRunSensitivity){.sim = sim};
  return status == ZP_OK && keys > 0 ? zp_run_sensitivity_open(rates, sim, key, (size_t)keys, err) : status;
}

/* -- numbers --------------------------------------------------------------------------------------- */

/* Models that have a number. */
typedef enum Of { ANY, PAIRS, TURNING, WITH_FIELD, FED, WITH_FILM, WITH_BEAD, LEAKING, DAMPED, YIELDING } Of;

static bool is_of(const ZpModel *model, Of of) {
  const bool is[] = {[ANY] = true,
                     [PAIRS] = zp_is_pair(&model->topology),
                     [TURNING] = zp_tells_angle(model),
                     [WITH_FIELD] = model->field,
                     [FED] = model->supply.acts,
                     [WITH_FILM] = model->has_film,
                     [WITH_BEAD] = model->has_bead,
                     [LEAKING] = model->leaks,
                     [DAMPED] = model->internal_damping > 0,
                     [YIELDING] = model->rod.plastic};
  return is[of];
}

/* Numbers at the end of a run: their name, the signal, of which models. */
typedef struct EndNumber {
  const char *name, *unit, *signal;
  Of of;
} EndNumber;

static const EndNumber at_end[] = {{"opening_m", "m", "opening", PAIRS},
                                   {"contraction", "1", "contraction", PAIRS},
                                   {"angle_rad", "rad", "angle", TURNING},
                                   {"stroke_m", "m", "stroke", ANY},
                                   {"internal_loss_J", "J", "internal_loss", DAMPED},
                                   {"plastic_loss_J", "J", "plastic_loss", YIELDING},
                                   {"contact_loss_J", "J", "contact_loss", WITH_FIELD},
                                   {"viscous_loss_J", "J", "viscous_loss", WITH_FILM},
                                   {"film_along_loss_J", "J", "film_along_loss", WITH_FILM},
                                   {"film_across_loss_J", "J", "film_across_loss", WITH_FILM},
                                   {"jet_loss_J", "J", "jet_loss", WITH_FILM},
                                   {"outer_drag_loss_J", "J", "outer_drag_loss", WITH_FILM},
                                   {"meniscus_loss_J", "J", "meniscus_loss", WITH_BEAD},
                                   {"wet_length_m", "m", "wet_length", WITH_BEAD},
                                   {"electric_work_J", "J", "electric_work", WITH_FIELD},
                                   {"charge_C", "C", "charge", WITH_FIELD},
                                   {"source_energy_J", "J", "source_energy", WITH_FIELD},
                                   {"source_loss_J", "J", "source_loss", FED},
                                   {"leak_loss_J", "J", "leak_loss", LEAKING}};
enum { AT_END = sizeof at_end / sizeof at_end[0] };

static double signal_of(ZpSim *sim, const void *name) {
  return zp_sim_get(sim, name);
}

static double zip_time_of(ZpSim *sim, const void *unused) {
  (void)unused;
  return sim->state->zip_time;
}

static double closed_from_of(ZpSim *sim, const void *unused) {
  (void)unused;
  return sim->state->closed_from;
}

/* A run that was interrupted, or has used up its steps, ends at an instant that no physics sets. */
static double rate_at_end(const ZpRunSensitivity *rates, size_t k, const ZpResult *result, const char *signal) {
  bool none = isfinite(rates->key[k].lost) || !zp_outcome_good(result->outcome);
  return none ? NAN : zp_run_rate_of(rates, k, signal_of, signal);
}

/* An actuator that has closed before the derivatives were lost was open for no instant since then. */
static double rate_of_closed_from(const ZpRunSensitivity *rates, size_t k, const ZpResult *result) {
  double from = zp_result_get(result, "closed_from_s");
  return from < rates->key[k].lost ? zp_run_rate_of(rates, k, closed_from_of, NULL) : NAN;
}

static void add_currents(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  bool none = isfinite(rates->key[k].lost) || !zp_outcome_good(result->outcome);
  ZpCurrents rate = none ? (ZpCurrents){NAN, NAN} : zp_run_rate_of_currents(rates, k);
  zp_result_add_sensitivity(result, "peak_current_A", rates->key[k].by.key, rate.peak);
  zp_result_add_sensitivity(result, "rms_current_A", rates->key[k].by.key, rate.rms);
}

static void add_key(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  const ZpModel *model = rates->sim->model;
  int key = rates->key[k].by.key;
  if (is_of(model, PAIRS)) {
    zp_result_add_sensitivity(result, "zip_time_s", key, zp_run_rate_of(rates, k, zip_time_of, NULL));
    zp_result_add_sensitivity(result, "closed_from_s", key, rate_of_closed_from(rates, k, result));
  }
  for (size_t i = 0; i < AT_END; i++)
    if (is_of(model, at_end[i].of))
      zp_result_add_sensitivity(result, at_end[i].name, key, rate_at_end(rates, k, result, at_end[i].signal));
  if (is_of(model, FED)) add_currents(rates, k, result);
}

/* Has a failure ended the derivatives by all keys, which end at once? */
static bool all_lost(const ZpRunSensitivity *rates) {
  for (size_t k = 0; k < rates->keys; k++)
    if (rates->key[k].lost != rates->key[0].lost) return false;
  return isfinite(rates->key[0].lost);
}

static void note_lost(const ZpRunSensitivity *rates, ZpResult *result) {
  if (!zp_outcome_good(result->outcome))
    zp_result_note(result,
                   "sensitivity: numbers at the end have no derivatives, because the run did not reach its end");
  if (all_lost(rates)) {
    zp_result_note(result, "sensitivity: from %.6g ms on there are no derivatives: %s", 1e3 * rates->key[0].lost,
                   rates->key[0].cause);
    return;
  }
  for (const ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    if (isfinite(of->lost))
      zp_result_note(result, "sensitivity: from %.6g ms on there are no derivatives by %s: %s", 1e3 * of->lost,
                     ZP_KEY_NAME(of->by.key), of->cause);
}

double zp_at_end(ZpSim *sim, const ZpResult *result, const char *signal) {
  ZpOutcome outcome = result->outcome;
  bool sound = outcome != ZP_DIVERGED && outcome != ZP_BEYOND_MODEL && outcome != ZP_NOT_SETTLED;
  return sound ? zp_sim_get(sim, signal) : NAN;
}

static void add_value(const ZpRunSensitivity *rates, const EndNumber *number, ZpResult *result) {
  if (!is_of(rates->sim->model, number->of) || zp_result_has(result, number->name)) return;
  zp_result_add(result, number->name, number->unit, zp_at_end(rates->sim, result, number->signal));
}

void zp_rates_add(const ZpRunSensitivity *rates, ZpResult *result) {
  if (rates->keys == 0) return;
  for (size_t i = 0; i < AT_END; i++)
    add_value(rates, &at_end[i], result);
  for (size_t k = 0; k < rates->keys; k++)
    add_key(rates, k, result);
  note_lost(rates, result);
}

/* -- are they settled? ----------------------------------------------------------------------------- */

/* A run with other steps, and the error of a derivative over its change in that run. */
typedef struct Other {
  ZpActuatorDef def;
  double error;
} Other;

/* Errors are proportional to the tolerance, eq. (20.11): with four and sixteen times the tolerance, a third and a
 * fifteenth of the change. More of it is counted on. */
static Other with_tolerance(const ZpActuatorDef *def, double times, double error) {
  static const double largest = 0.1;
  Other c = {*def, error};
  c.def.solver.tolerance = fmin(times * zp_def_tolerance(def), largest);
  return c;
}

/* Errors are proportional to the square of equal steps. These are shorter, because the drive limits longer ones. */
static Other with_steps(const ZpActuatorDef *def, const ZpResult *result) {
  Other c = {*def, 4.0 / 3};
  c.def.solver.time_step = 0.5 * zp_result_get(result, "mean_time_step_s");
  return c;
}

/* Is the error at most 1 % of the derivative, or rounding of the number over the key? */
static bool is_settled(const Other *c, const ZpResult *result, const ZpSensitivity *own, const ZpSensitivity *other) {
  static const double most = 0.01, rounding = 1e-7;
  double key = fabs(zp_def_get(&c->def, own->key)), error = c->error * fabs(other->value - own->value);
  double number = key > 0 ? fabs(zp_result_get(result, own->output)) / key : 0;
  return error <= fmax(most * fabs(own->value), isfinite(number) ? rounding * number : 0);
}

/* Derivatives that are not settled become null. The other run has the same ones, in the same order. */
static void withdraw(const Other *c, const ZpResult *other, ZpResult *result) {
  for (size_t i = 0; i < result->sensitivities; i++) {
    ZpSensitivity *s = &result->sensitivity[i];
    if (i >= other->sensitivities || !is_settled(c, result, s, &other->sensitivity[i])) s->value = NAN;
  }
}

/* Compare with another run => the share of steps that it has taken. */
static ZpStatus settle(const ZpTask *task, ZpStudyRun run, const Other *c, ZpResult *result, double *share,
                       ZpError *err) {
  const ZpTask again = {&c->def, task->input, task->hooks};
  ZpError reason;
  ZpResult *other = zp_result_create(result->study);
  if (!other) return zp_fail_memory(err);
  ZpStatus status = run(&again, other, &reason);
  withdraw(c, other, result);
  *share = zp_result_get(other, "steps") / zp_result_get(result, "steps");
  zp_result_destroy(other);
  return status == ZP_MACHINE ? zp_fail(err, status, "%s", reason.message) : ZP_OK;
}

/* Name as many as fit of the derivatives that were there before. */
static void note_unsettled(const ZpSensitivity *before, ZpResult *result) {
  enum { LIST = 128 };
  char list[LIST] = "";
  size_t count = 0, used = 0;
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &before[i];
    if (isnan(s->value) || !isnan(result->sensitivity[i].value)) continue;
    const char *comma = count++ > 0 ? ", " : "", *key = ZP_KEY_NAME(s->key);
    size_t needed = strlen(comma) + strlen(s->output) + strlen(" by ") + strlen(key);
    if (used + needed < LIST) used += (size_t)snprintf(list + used, LIST - used, "%s%s by %s", comma, s->output, key);
  }
  if (count > 0)
    zp_result_note(result,
                   "sensitivity: null because other steps change it by more than 1 %%: %s%s; reduce solver.tolerance",
                   list, count > 1 ? ", ..." : "");
}

static bool has_any(const ZpResult *result) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (!isnan(result->sensitivity[i].value)) return true;
  return false;
}

ZpStatus zp_rates_settle(const ZpTask *task, ZpStudyRun run, ZpResult *result, ZpError *err) {
  static const double same = 0.55; /* share of the steps: the drive, not the tolerance, has set most of them */
  if (!has_any(result) || !isnan(task->def->solver.time_step)) return ZP_OK;
  ZpSensitivity *before = zp_calloc(result->sensitivities, sizeof *before);
  if (!before) return zp_fail_memory(err);
  memcpy(before, result->sensitivity, result->sensitivities * sizeof *before);
  double share;
  Other c = with_tolerance(task->def, 16, 0.2);
  ZpStatus status = settle(task, run, &c, result, &share, err);
  c = with_tolerance(task->def, 4, 0.75);
  if (status == ZP_OK) status = settle(task, run, &c, result, &share, err);
  c = with_steps(task->def, result);
  if (status == ZP_OK && share > same) status = settle(task, run, &c, result, &share, err);
  note_unsettled(before, result);
  zp_free(before);
  return status;
}
