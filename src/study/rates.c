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
  ZpStatus status = zp_sensitivity_keys(sim->model->whole, key, &keys, err);
  *rates = (ZpRunSensitivity){.sim = sim};
  return status == ZP_OK && keys > 0 ? zp_run_sensitivity_open(rates, sim, key, (size_t)keys, err) : status;
}

/* -- numbers --------------------------------------------------------------------------------------- */

/* Models that have a number. In a network bodies and members have places and openings of their own. */
typedef enum Of { LOADED, PAIRS, TURNING, WITH_FIELD, FED, WITH_FILM, WITH_BEAD, LEAKING, DAMPED, YIELDING } Of;

static bool is_of(const ZpModel *model, Of of) {
  const bool is[] = {[LOADED] = !zp_is_network(model),
                     [PAIRS] = zp_is_pair(&model->topology) && !zp_is_network(model),
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

/* Has any member a number? */
static bool has(const ZpSim *sim, Of of) {
  bool any = false;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    any |= is_of(m->model, of);
  return any;
}

/* Numbers at the end of a run: their name, the signal, of which models. */
typedef struct EndNumber {
  const char *name, *unit, *signal;
  Of of;
} EndNumber;

static const EndNumber at_end[] = {{"opening_m", "m", "opening", PAIRS},
                                   {"contraction", "1", "contraction", PAIRS},
                                   {"angle_rad", "rad", "angle", TURNING},
                                   {"stroke_m", "m", "stroke", LOADED},
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

/* Of a member, by its number. */
static double zip_time_of(ZpSim *sim, const void *which) {
  return sim[*(const size_t *)which].state->zip_time;
}

static double closed_from_of(ZpSim *sim, const void *which) {
  return sim[*(const size_t *)which].state->closed_from;
}

static double opening_of(ZpSim *sim, const void *which) {
  const ZpSim *m = sim + *(const size_t *)which;
  return zp_opening(&m->model->topology, zp_state_motion(m->model, m->state).y);
}

/* Of a body, along one way. */
typedef struct Place {
  size_t body;
  ZpWay way;
} Place;

static double place_of(ZpSim *sim, const void *place) {
  const Place *at = place;
  const ZpPose pose = zp_sim_place(sim, at->body);
  const double of[ZP_WAYS] = {pose.x, pose.y, pose.turn};
  return of[at->way];
}

typedef double Number(ZpSim *sim, const void *user);

/* A run that was interrupted, or has used up its steps, ends at an instant that no physics sets. */
static double rate_at_end(const ZpRunSensitivity *rates, size_t k, const ZpResult *result, Number *number,
                          const void *user) {
  bool none = isfinite(rates->key[k].lost) || !zp_outcome_good(result->outcome);
  return none ? NAN : zp_run_rate_of(rates, k, number, user);
}

/* An actuator that has closed before the derivatives were lost was open for no instant since then. */
static double rate_since(const ZpRunSensitivity *rates, size_t k, double from, double rate) {
  return from < rates->key[k].lost ? rate : NAN;
}

/* Of an instant of all members: that of the member whose instant it is. If it is that of several, and the key does not
 * move all of them alike, there is none. */
static double rate_of_all(const ZpRunSensitivity *rates, size_t k, Number *instant, double of_all) {
  static const double alike = 1e-4;
  double rate = NAN;
  for (size_t which = 0; which < rates->sim->members; which++) {
    if (instant(rates->sim, &which) != of_all) continue;
    const double own = zp_run_rate_of(rates, k, instant, &which);
    if (fabs(own - rate) > alike * fabs(own)) return NAN;
    rate = own;
  }
  return rate;
}

static void add_instants(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  const ZpSim *sim = rates->sim;
  const int key = rates->key[k].by.key;
  const double closed = rate_of_all(rates, k, closed_from_of, zp_sim_closed_from(sim));
  zp_result_add_sensitivity(result, "zip_time_s", key, rate_of_all(rates, k, zip_time_of, zp_sim_zip_time(sim)));
  zp_result_add_sensitivity(result, "closed_from_s", key,
                            rate_since(rates, k, zp_result_get(result, "closed_from_s"), closed));
}

static void add_currents(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  bool none = isfinite(rates->key[k].lost) || !zp_outcome_good(result->outcome);
  ZpCurrents rate = none ? (ZpCurrents){NAN, NAN} : zp_run_rate_of_currents(rates, k);
  zp_result_add_sensitivity(result, "peak_current_A", rates->key[k].by.key, rate.peak);
  zp_result_add_sensitivity(result, "rms_current_A", rates->key[k].by.key, rate.rms);
}

static void add_key(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  const ZpSim *sim = rates->sim;
  int key = rates->key[k].by.key;
  if (sim->model->field) add_instants(rates, k, result);
  for (size_t i = 0; i < AT_END; i++)
    if (has(sim, at_end[i].of))
      zp_result_add_sensitivity(result, at_end[i].name, key,
                                rate_at_end(rates, k, result, signal_of, at_end[i].signal));
  if (has(sim, FED)) add_currents(rates, k, result);
}

/* Of those numbers of a member that are in the summary. */
static void add_member(const ZpRunSensitivity *rates, size_t k, size_t which, ZpResult *result) {
  char room[ZP_NAME_SIZE];
  const int key = rates->key[k].by.key;
  const char *called = zp_member_called(rates->sim->model->whole, which + 1, room);
  const double zip = zp_run_rate_of(rates, k, zip_time_of, &which),
               closed = zp_run_rate_of(rates, k, closed_from_of, &which);
  zp_result_add_sensitivity_of(result, "member_#_zip_time_s", called, key, zip);
  zp_result_add_sensitivity_of(result, "members.#.opening_m", called, key,
                               rate_at_end(rates, k, result, opening_of, &which));
  zp_result_add_sensitivity_of(result, "members.#.zip_time_s", called, key, zip);
  zp_result_add_sensitivity_of(result, "members.#.closed_from_s", called, key,
                               rate_since(rates, k, closed_from_of(rates->sim, &which), closed));
}

static void add_body(const ZpRunSensitivity *rates, size_t k, size_t body, ZpResult *result) {
  const ZpModel *model = rates->sim->model;
  char room[ZP_NAME_SIZE], name[ZP_NAME_SIZE];
  const char *called = zp_body_called(model->whole, body, room);
  size_t columns;
  const ZpColumn *column = zp_body_columns(model->network->plane, &columns);
  for (size_t c = 0; c < columns; c++) {
    const Place place = {body, model->network->plane ? (ZpWay)c : ZP_WAY_UP};
    snprintf(name, sizeof name, "bodies.%s", column[c].name); /* "#.x_m" */
    zp_result_add_sensitivity_of(result, name, called, rates->key[k].by.key,
                                 rate_at_end(rates, k, result, place_of, &place));
  }
}

static void add_parts(const ZpRunSensitivity *rates, size_t k, ZpResult *result) {
  const ZpModel *model = rates->sim->model;
  for (size_t which = 0; which < model->members; which++)
    add_member(rates, k, which, result);
  for (size_t body = 1; body < model->network->bodies && zp_is_network(model); body++)
    add_body(rates, k, body, result);
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
                     ZP_KEY_SHOWN(rates->sim->model->whole, of->by.key), of->cause);
}

double zp_at_end(ZpSim *sim, const ZpResult *result, const char *signal) {
  ZpOutcome outcome = result->outcome;
  bool sound = outcome != ZP_DIVERGED && outcome != ZP_BEYOND_MODEL && outcome != ZP_NOT_SETTLED;
  return sound ? zp_sim_get(sim, signal) : NAN;
}

static void add_value(const ZpRunSensitivity *rates, const EndNumber *number, ZpResult *result) {
  if (!has(rates->sim, number->of) || zp_result_has(result, number->name)) return;
  zp_result_add(result, number->name, number->unit, zp_at_end(rates->sim, result, number->signal));
}

void zp_rates_add(const ZpRunSensitivity *rates, ZpResult *result) {
  if (rates->keys == 0) return;
  for (size_t i = 0; i < AT_END; i++)
    add_value(rates, &at_end[i], result);
  for (size_t k = 0; k < rates->keys; k++)
    add_key(rates, k, result);
  for (size_t k = 0; k < rates->keys; k++)
    add_parts(rates, k, result);
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
static void note_unsettled(const ZpActuatorDef *def, const ZpSensitivity *before, ZpResult *result) {
  enum { LIST = 128 };
  char list[LIST] = "";
  size_t count = 0, used = 0;
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &before[i];
    if (isnan(s->value) || !isnan(result->sensitivity[i].value)) continue;
    const char *comma = count++ > 0 ? ", " : "", *key = ZP_KEY_SHOWN(def, s->key);
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
  note_unsettled(task->def, before, result);
  zp_free(before);
  return status;
}
