/* Def => the fitted keys and their bounds; src/fit/sets.c reads the measurements. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/def.h"
#include "fit/fit.h"
#include "io/range.h"

const ZpFitNumber zp_fit_number[ZP_FIT_KINDS] = {
    [ZP_FIT_STROKE] = {"stroke", "m", 0, NULL, true},
    [ZP_FIT_OPENING] = {"opening", "m", 0, NULL, true},
    [ZP_FIT_CAPACITANCE] = {"capacitance", "F", 0, NULL, false},
#define ZP_MEASURED(enumerator, kind, column, unit, scalar, has_slopes)                                                \
  [kind] = {column, unit, enumerator, scalar, has_slopes},
#include <zipact/studies.def>
};

void zp_fit_close(ZpFit *fit) {
  for (size_t i = 0; i < fit->sets; i++)
    for (int k = 0; k < fit->set[i].others; k++)
      free(fit->set[i].other[k]);
  free(fit->set);
  free(fit->x);
  free(fit->y);
  free(fit->sigma);
  fit->x = fit->y = fit->sigma = NULL;
  fit->set = NULL;
  fit->sets = 0;
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

bool zp_fit_takes(int key) {
  return zp_key(key)->type == ZP_KEY_REAL || zp_key(key)->type == ZP_KEY_REAL_AUTO;
}

/* Bounds of z: those of the scenario, within the range of the key. */
static void find_bounds(ZpFit *fit, int i) {
  const ZpKey *key = zp_key(fit->key[i]);
  double start = fit->start[i], at_min = key->min / start, at_max = key->max / start;
  fit->lower[i] = fmax(fit->def->calibrate.lower, fmin(at_min, at_max));
  fit->upper[i] = fmin(fit->def->calibrate.upper, fmax(at_min, at_max));
}

/* "ribbon.young_modulus = 100 GPa .. 250 GPa": bounds instead of multiples of the start value. */
static ZpStatus set_bounds(ZpFit *fit, char *text, ZpError *err) {
  ZpInterval bounds;
  ZpStatus status = zp_interval_read("calibrate.bounds", text, &bounds, err);
  if (status != ZP_OK) return status;
  int i = 0;
  while (i < fit->n && fit->key[i] != bounds.key)
    i++;
  const char *name = zp_key(bounds.key)->name;
  if (i == fit->n) return zp_fail(err, ZP_BAD_INPUT, "calibrate.bounds: %s is not in calibrate.fit", name);
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

static ZpStatus add_key(ZpFit *fit, const char *name, ZpError *err) {
  int key = zp_key_find(name);
  if (key < 0) {
    char reason[256];
    zp_key_unknown(name, reason, sizeof reason);
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %.80s: %s", name, reason);
  }
  if (!zp_fit_takes(key))
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is not a real number and cannot be fitted", name);
  if (fit->n == ZP_FIT_MOST)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: more than %d keys; fit fewer at a time", ZP_FIT_MOST);
  for (int i = 0; i < fit->n; i++)
    if (fit->key[i] == key) return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is named twice", name);
  double start = zp_def_get(fit->def, key);
  if (isnan(start) || start == 0)
    return zp_fail(err, ZP_BAD_INPUT, "calibrate.fit: %s is %s: give a value to start from", name,
                   isnan(start) ? zp_key(key)->text : "0");
  fit->key[fit->n] = key;
  fit->start[fit->n] = start;
  find_bounds(fit, fit->n++);
  return ZP_OK;
}

/* "a, b" => keys. */
static ZpStatus read_keys(ZpFit *fit, ZpError *err) {
  char list[ZP_TEXT_SIZE], *rest = list;
  memcpy(list, fit->def->calibrate.fit, sizeof list);
  ZpStatus status = ZP_OK;
  if (strspn(list, " ") == strlen(list)) return ZP_OK; /* nothing is fitted: model and data are compared */
  for (char *name = strsep(&rest, ","); name && status == ZP_OK; name = strsep(&rest, ",")) {
    name += strspn(name, " ");
    name[strcspn(name, " ")] = 0;
    status = add_key(fit, name, err);
  }
  return status;
}

ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err) {
  *fit = (ZpFit){.def = def, .err = err};
  if (*def->data.file == 0)
    return zp_fail(err, ZP_BAD_INPUT, "data.file: empty; study calibrate needs a CSV file of measurements");
  ZpStatus status = read_keys(fit, err);
  if (status == ZP_OK) status = read_bounds(fit, err);
  return status == ZP_OK ? zp_fit_read_sets(fit, err) : status;
}
