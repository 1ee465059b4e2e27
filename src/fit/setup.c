/* Def => the fitted keys and their bounds; src/fit/sets.c reads the measurements. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/fit.h"
#include "io/range.h"
#include "io/value.h"

const ZpFitNumber zp_fit_number[ZP_FIT_KINDS] = {
    [ZP_FIT_STROKE] = {"stroke", "m", 0, NULL, true},    [ZP_FIT_DISPLACEMENT] = {"displacement", "m", 0, NULL, true},
    [ZP_FIT_OPENING] = {"opening", "m", 0, NULL, true},  [ZP_FIT_CAPACITANCE] = {"capacitance", "F", 0, NULL, false},
    [ZP_FIT_CURRENT] = {"current", "A", 0, NULL, false},
#define ZP_MEASURED(enumerator, kind, column, unit, scalar, has_slopes)                                                \
  [kind] = {column, unit, enumerator, scalar, has_slopes},
#include <zipact/studies.def>
};

void zp_fit_close(ZpFit *fit) {
  for (size_t i = 0; i < fit->sets; i++)
    for (int k = 0; k < fit->set[i].others; k++)
      free(fit->set[i].other[k]);
  for (size_t i = 0; i < fit->runs; i++)
    free(fit->run[i].time);
  free(fit->run);
  free(fit->set);
  free(fit->x);
  free(fit->y);
  free(fit->sigma);
  fit->x = fit->y = fit->sigma = NULL;
  fit->set = NULL;
  fit->run = NULL;
  fit->sets = fit->runs = 0;
}

const ZpFitSet *zp_fit_set_of(const ZpFit *fit, size_t row) {
  const ZpFitSet *set = fit->set;
  while (row >= set->first + set->rows)
    set++;
  return set;
}

size_t zp_fit_kinds(const ZpFit *fit) {
  bool has[ZP_FIT_KINDS] = {false};
  size_t kinds = 0;
  for (size_t i = 0; i < fit->sets; i++) {
    kinds += !has[fit->set[i].kind];
    has[fit->set[i].kind] = true;
  }
  return kinds;
}

/* Or of a body and the like. */
static bool is_of_member(int key) {
  return zp_key_instance(key).number > 0 && !zp_key_is_of_segment(key);
}

bool zp_fit_takes(int key) {
  if (!zp_key_in_def(key) || is_of_member(key)) return false; /* a fit is of one actuator */
  return zp_value_is_real(zp_key(key));
}

/* "ribbon.young_modulus = 100 GPa .. 250 GPa": bounds instead of multiples of the start value. */
static ZpStatus set_bounds(ZpFit *fit, char *text, ZpError *err) {
  ZpInterval bounds;
  ZpStatus status = zp_interval_read("calibrate.bounds", text, &bounds, err);
  if (status != ZP_OK) return status;
  int i = 0;
  while (i < fit->keys && fit->key[i] != bounds.key)
    i++;
  const char *name = ZP_KEY_NAME(bounds.key);
  if (i == fit->keys) return zp_fail(err, ZP_BAD_INPUT, "calibrate.bounds: %s is not in calibrate.fit", name);
  const double start = fit->start[i], from = bounds.from / start, to = bounds.to / start;
  fit->lower[i] = fmin(from, to);
  fit->upper[i] = fmax(from, to);
  if (fit->lower[i] <= 1 && fit->upper[i] >= 1) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "calibrate.bounds: %s: the bounds must enclose its start value, %g %s", name, start,
                 zp_key(bounds.key)->unit);
}

static ZpStatus read_bounds(ZpFit *fit, ZpError *err) {
  char list[ZP_TEXT_SIZE], *rest = list;
  ZpStatus status = ZP_OK;
  memcpy(list, fit->def->calibrate.bounds, sizeof list);
  for (char *part = strsep(&rest, ";"); part && status == ZP_OK; part = strsep(&rest, ";"))
    if (part[strspn(part, " \t")]) status = set_bounds(fit, part, err);
  return status;
}

static ZpStatus add_key(ZpFit *fit, int key, ZpError *err) {
  const char *name = ZP_KEY_NAME(key);
  if (!zp_fit_takes(key))
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is %s and cannot be fitted", name,
                   is_of_member(key) ? "of a member of a stack" : "not a real number");
  double start = zp_def_get(fit->def, key);
  if (isnan(start) || start == 0)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is %s: give a value to start from", name,
                   isnan(start) ? zp_key(key)->text : "0");
  double at_min = zp_key(key)->min / start, at_max = zp_key(key)->max / start;
  fit->key[fit->keys++] = key;
  snprintf(fit->name[fit->n], sizeof fit->name[0], "%s", name);
  fit->unit[fit->n] = zp_key(key)->unit;
  fit->start[fit->n] = start;
  fit->first[fit->n] = 1;
  fit->lower[fit->n] = fmax(fit->def->calibrate.lower, fmin(at_min, at_max));
  fit->upper[fit->n++] = fmin(fit->def->calibrate.upper, fmax(at_min, at_max));
  return ZP_OK;
}

/* If none is named, model and data are compared. */
static ZpStatus read_keys(ZpFit *fit, ZpError *err) {
  int key[ZP_FIT_KEYS], keys;
  ZpStatus status = zp_keys_named("calibrate.fit", fit->def->calibrate.fit, ZP_FIT_KEYS, key, &keys, err);
  for (int k = 0; k < keys && status == ZP_OK; k++)
    status = add_key(fit, key[k], err);
  return status;
}

static ZpStatus open_fit(ZpFit *fit, bool all, ZpError *err) {
  ZpStatus status = read_keys(fit, err);
  if (status == ZP_OK) status = read_bounds(fit, err);
  return status == ZP_OK ? zp_fit_read_sets(fit, all, err) : status;
}

static void start(const ZpActuatorDef *def, const char *source, ZpFit *fit, ZpError *err) {
  *fit = (ZpFit){.def = def, .source = source, .tolerance = NAN, .horizon = 1, .err = err};
  zp_fit_reset_ways(fit);
}

ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err) {
  start(def, "data.file", fit, err);
  if (*def->data.file == 0)
    return zp_fail(err, ZP_BAD_INPUT, "data.file: empty; study calibrate needs a CSV file of measurements");
  return open_fit(fit, true, err);
}

ZpStatus zp_fit_open_present(const ZpActuatorDef *def, ZpFit *fit, ZpError *err) {
  start(def, "data.file", fit, err);
  return open_fit(fit, false, err);
}

ZpStatus zp_fit_open_candidates(const ZpActuatorDef *def, const ZpFit *data, ZpFit *fit, ZpError *err) {
  start(def, "plan.candidates", fit, err);
  fit->planned = true;
  if (data) fit->named = data->named;
  if (*def->plan.candidates == 0)
    return zp_fail(err, ZP_BAD_INPUT, "plan.candidates: empty; study plan needs a CSV file of possible measurements");
  return open_fit(fit, true, err);
}
