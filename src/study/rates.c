#include "study/rates.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "sim/feed.h"
#include "study/sensitivity.h"

/* -- what can be asked ----------------------------------------------------------------------------- */

static ZpStatus refuse(const char *what, const char *why, ZpError *err) {
  return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: study actuate has no derivatives with %s: %s", what, why);
}

static ZpStatus check_model(const ZpActuatorDef *def, ZpError *err) {
  if (def->solver.integrator != ZP_INTEGRATOR_IMPLICIT)
    return refuse("solver.integrator explicit", "the derivatives follow implicit steps", err);
  if (def->control.kind != ZP_CONTROL_NONE)
    return refuse("control.kind", "a controller's samples and limits are not differentiated", err);
  if (def->ribbon.plasticity)
    return refuse("ribbon.plasticity", "the derivatives do not follow a strip that yields", err);
  if (def->initial.state == ZP_INITIAL_CHECKPOINT)
    return refuse("initial.state checkpoint", "a checkpoint does not contain its derivatives by a key", err);
  if (def->source.model != ZP_SOURCE_IDEAL && isfinite(def->source.slew_rate))
    return refuse("source.slew_rate",
                  "the derivatives do not follow the instants at which the slew rate is reached and left", err);
  return ZP_OK;
}

ZpStatus zp_check_rates(const ZpActuatorDef *def, ZpError *err) {
  int key[ZP_MAX_SENSITIVITY_KEYS], keys;
  ZpStatus status = zp_sensitivity_keys(def, key, &keys, err);
  return status == ZP_OK && keys > 0 ? check_model(def, err) : status;
}

ZpStatus zp_rates_open(ZpRunRates *rates, ZpSim *sim, ZpError *err) {
  int key[ZP_MAX_SENSITIVITY_KEYS], keys;
  ZpStatus status = zp_sensitivity_keys(zp_model_def(sim->model), key, &keys, err);
  *rates = (ZpRunRates){.sim = sim};
  return status == ZP_OK && keys > 0 ? zp_run_rates_open(rates, sim, key, (size_t)keys, err) : status;
}

/* -- numbers --------------------------------------------------------------------------------------- */

static bool any(const ZpModel *model) {
  (void)model;
  return true;
}

static bool is_pair(const ZpModel *model) {
  return zp_is_pair(&model->topology);
}

static bool turns(const ZpModel *model) {
  return zp_has_angle(&model->topology);
}

static bool has_field(const ZpModel *model) {
  return model->field;
}

static bool is_fed(const ZpModel *model) {
  return model->supply.acts;
}

static bool has_film(const ZpModel *model) {
  return model->has_film;
}

static bool has_bead(const ZpModel *model) {
  return model->has_bead;
}

static bool leaks(const ZpModel *model) {
  return model->leaks;
}

static bool is_damped(const ZpModel *model) {
  return model->internal_damping > 0;
}

/* Numbers at the end of a run: their name, the signal, of which models. */
typedef struct EndNumber {
  const char *name, *unit, *signal;
  bool (*has)(const ZpModel *model);
} EndNumber;

static const EndNumber at_end[] = {{"opening_m", "m", "opening", is_pair},
                                   {"contraction", "1", "contraction", is_pair},
                                   {"angle_rad", "rad", "angle", turns},
                                   {"stroke_m", "m", "stroke", any},
                                   {"internal_loss_J", "J", "internal_loss", is_damped},
                                   {"contact_loss_J", "J", "contact_loss", has_field},
                                   {"viscous_loss_J", "J", "viscous_loss", has_film},
                                   {"film_along_loss_J", "J", "film_along_loss", has_film},
                                   {"film_across_loss_J", "J", "film_across_loss", has_film},
                                   {"jet_loss_J", "J", "jet_loss", has_film},
                                   {"outer_drag_loss_J", "J", "outer_drag_loss", has_film},
                                   {"meniscus_loss_J", "J", "meniscus_loss", has_bead},
                                   {"wet_length_m", "m", "wet_length", has_bead},
                                   {"electric_work_J", "J", "electric_work", has_field},
                                   {"charge_C", "C", "charge", has_field},
                                   {"source_energy_J", "J", "source_energy", has_field},
                                   {"source_loss_J", "J", "source_loss", is_fed},
                                   {"leak_loss_J", "J", "leak_loss", leaks}};
enum { AT_END = sizeof at_end / sizeof at_end[0] };

static double signal_of(ZpSim *sim, void *name) {
  return zp_sim_get(sim, name);
}

static double zip_time_of(ZpSim *sim, void *unused) {
  (void)unused;
  return sim->state->zip_time;
}

static double peak_of(ZpSim *sim, void *unused) {
  (void)unused;
  return zp_sim_currents(sim, sim->state->t).peak;
}

static double rms_of(ZpSim *sim, void *unused) {
  (void)unused;
  return zp_sim_currents(sim, sim->state->t).rms;
}

static double rate_at_end(const ZpRunRates *rates, size_t k, double (*number)(ZpSim *sim, void *user), void *user) {
  return isfinite(rates->key[k].lost) ? NAN : zp_run_rate_of(rates, k, number, user);
}

static void add_key(const ZpRunRates *rates, size_t k, ZpResult *result) {
  const ZpModel *model = rates->sim->model;
  int key = rates->key[k].by.key;
  if (is_pair(model)) zp_result_add_sensitivity(result, "zip_time_s", key, zp_run_rate_of(rates, k, zip_time_of, NULL));
  for (size_t i = 0; i < AT_END; i++)
    if (at_end[i].has(model))
      zp_result_add_sensitivity(result, at_end[i].name, key,
                                rate_at_end(rates, k, signal_of, (void *)at_end[i].signal));
  if (!is_fed(model)) return;
  zp_result_add_sensitivity(result, "peak_current_A", key, rate_at_end(rates, k, peak_of, NULL));
  zp_result_add_sensitivity(result, "rms_current_A", key, rate_at_end(rates, k, rms_of, NULL));
}

/* What ends the derivatives by all keys ends them at once. */
static bool all_lost(const ZpRunRates *rates) {
  for (size_t k = 0; k < rates->keys; k++)
    if (rates->key[k].lost != rates->key[0].lost) return false;
  return isfinite(rates->key[0].lost);
}

static void note_lost(const ZpRunRates *rates, ZpResult *result) {
  if (all_lost(rates)) {
    zp_result_note(result, "sensitivity: from %.6g ms on there are no derivatives: %s", 1e3 * rates->key[0].lost,
                   rates->key[0].cause);
    return;
  }
  for (const ZpKeyRates *of = rates->key; of < rates->key + rates->keys; of++)
    if (isfinite(of->lost))
      zp_result_note(result, "sensitivity: from %.6g ms on there are no derivatives by %s: %s", 1e3 * of->lost,
                     zp_key(of->by.key)->name, of->cause);
}

void zp_rates_add(const ZpRunRates *rates, ZpResult *result) {
  for (size_t i = 0; rates->keys > 0 && i < AT_END; i++)
    if (at_end[i].has(rates->sim->model) && isnan(zp_result_get(result, at_end[i].name)))
      zp_result_add(result, at_end[i].name, at_end[i].unit, zp_sim_get(rates->sim, at_end[i].signal));
  for (size_t k = 0; k < rates->keys; k++)
    add_key(rates, k, result);
  if (rates->keys > 0) note_lost(rates, result);
}
