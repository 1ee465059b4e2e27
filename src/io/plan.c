/* Limits: ZP_CASES_MOST cases, a bound against requests by mistake; VALUES_MOST values in all lists, so that the
 * written scenario stays below the size that can be read.
 *
 * A problem that a later --set may solve, such as lists of different lengths that vary together, is reported only when
 * a Def is requested. */
#include "io/plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "def/def.h"
#include "io/range.h"
#include "io/value.h"
#include "sample/sobol.h"

enum { VALUES_MOST = 20000 };

static bool varies(const ZpSlot *slot) {
  return slot->is_list || slot->spread.kind != ZP_DISTRIBUTION_NONE;
}

const ZpSlot *zp_given(const ZpGiven *given, int key) {
  size_t low = 0, high = given->count;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (zp_key_order(given->slot[middle]->key, key) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return low < given->count && given->slot[low]->key == key ? given->slot[low] : NULL;
}

/* The given value of a key, otherwise its default. */
static double value_of(const ZpGiven *given, const ZpActuatorDef *defaults, const char *name) {
  const int key = zp_key_find(name);
  const ZpSlot *slot = zp_given(given, key);
  return slot ? slot->value[0] : zp_def_get(defaults, key);
}

static void set_problem(ZpPlan *plan, int key, const char *what) {
  if (!plan->problem.status) zp_fail(&plan->problem, ZP_BAD_INPUT, "sampling.together: %s: %s", ZP_KEY_NAME(key), what);
}

static void tie(ZpPlan *plan, const ZpGiven *given, int key) {
  size_t first = 0, at = 0;
  while (at < given->count && given->slot[at]->key != key)
    at++;
  if (at == given->count || !given->slot[at]->is_list) {
    set_problem(plan, key, "has no list of values");
    return;
  }
  while (first < given->count && !plan->tied[first])
    first++;
  if (first < given->count && given->slot[first]->count != given->slot[at]->count)
    set_problem(plan, key, "its list is not as long as those of the other keys");
  plan->tied[at] = true;
}

/* Read sampling.together. */
static void find_tied(ZpPlan *plan, const ZpGiven *given) {
  const ZpSlot *slot = zp_given(given, zp_key_find("sampling.together"));
  int key[ZP_TEXT_SIZE], count; /* a text has room for fewer keys */
  if (zp_keys_named("sampling.together", slot ? slot->text : "", ZP_TEXT_SIZE, key, &count, &plan->problem) != ZP_OK)
    return;
  for (int k = 0; k < count; k++)
    tie(plan, given, key[k]);
}

/* A list multiplies the number of cases; of lists that vary together only the shortest does. */
static void find_axes(ZpPlan *plan, const ZpGiven *given) {
  size_t tied = 0, seen = 0;
  plan->together = 1;
  for (size_t i = 0; i < given->count; i++)
    if (plan->tied[i] && (tied++ == 0 || given->slot[i]->count < plan->together))
      plan->together = given->slot[i]->count;
  for (size_t i = 0; i < given->count; i++) {
    const ZpSlot *slot = given->slot[i];
    if (varies(slot)) {
      plan->at[plan->variations] = i;
      plan->varied[plan->variations++] = slot->key;
    }
    seen += plan->tied[i];
    if (slot->is_list && (!plan->tied[i] || seen == tied)) plan->axis[plan->axes++] = slot->key;
  }
}

static void find_design(ZpPlan *plan, const ZpGiven *given) {
  const ZpActuatorDef defaults = zp_actuator_def_default();
  plan->design = (ZpDesign){.method = (ZpSampling)value_of(given, &defaults, "sampling.method"),
                            .count = (size_t)value_of(given, &defaults, "sampling.count"),
                            .seed = (uint32_t)value_of(given, &defaults, "sampling.seed"),
                            .indices = value_of(given, &defaults, "sampling.indices") != 0};
  for (size_t i = 0; i < given->count; i++)
    plan->design.dimensions += given->slot[i]->spread.kind != ZP_DISTRIBUTION_NONE;
  if (plan->design.dimensions == 0) plan->design = (ZpDesign){.count = 1};
}

/* The correlation of the errors of two keys; 0 unless the same fit has found both. */
static double correlation_of(const ZpGiven *given, const ZpSlot *one, const ZpSlot *two) {
  if (one == two) return 1;
  if (!one->is_fitted || !two->is_fitted) return 0;
  const size_t a = zp_fitted_place(given->fitted, one->key), b = zp_fitted_place(given->fitted, two->key);
  const double known = zp_fitted_correlation(given->fitted, a, b);
  return isnan(known) ? 0 : known;
}

static void fail_joint(ZpPlan *plan, const char *what) {
  if (!plan->problem.status) zp_fail(&plan->problem, ZP_BAD_INPUT, "sampling.tolerances = base: %s", what);
}

static ZpStatus correlate(ZpPlan *plan, const double *R, ZpError *err) {
  bool memory;
  if (plan->design.indices)
    fail_joint(plan, "sampling.indices: Sobol indices are defined for independent keys; those of base.file are "
                     "correlated");
  else if (!zp_together_correlate(&plan->joint, R, &memory) && memory)
    fail_joint(plan, "the correlations in base.file are not those of any distribution, or a key follows from others");
  else if (!memory)
    return zp_fail_memory(err);
  return ZP_OK;
}

/* The distributions of all keys that have one. */
static ZpStatus find_joint(ZpPlan *plan, const ZpGiven *given, ZpError *err) {
  const size_t n = (size_t)plan->design.dimensions;
  double *R = calloc(n * n + 1, sizeof *R);
  bool correlated = false;
  const bool memory = zp_together_create(&plan->joint, plan->design.dimensions) && R;
  for (size_t v = 0, row = 0; memory && v < plan->variations; v++) {
    const ZpSlot *one = given->slot[plan->at[v]];
    if (one->spread.kind == ZP_DISTRIBUTION_NONE) continue;
    for (size_t w = 0, column = 0; w <= v; w++) {
      const ZpSlot *two = given->slot[plan->at[w]];
      if (two->spread.kind == ZP_DISTRIBUTION_NONE) continue;
      R[row * n + column] = correlation_of(given, one, two);
      correlated |= row != column && R[row * n + column] != 0;
      column++;
    }
    plan->joint.each[row++] = one->spread;
  }
  ZpStatus status = !memory ? zp_fail_memory(err) : correlated ? correlate(plan, R, err) : ZP_OK;
  free(R);
  return status;
}

static ZpStatus count_cases(ZpPlan *plan, const ZpGiven *given, ZpError *err) {
  size_t values = 0, cases = 1;
  for (size_t v = 0, axis = 0; v < plan->variations; v++) {
    const ZpSlot *slot = given->slot[plan->at[v]];
    values += slot->is_list ? slot->count : 0;
    if (values > VALUES_MOST) return zp_fail(err, ZP_BAD_INPUT, "more than %d values in lists", VALUES_MOST);
    if (axis == plan->axes || plan->axis[axis] != slot->key) continue;
    axis++;
    const size_t length = plan->tied[plan->at[v]] ? plan->together : slot->count;
    if (cases > ZP_CASES_MOST / length)
      return zp_fail(err, ZP_BAD_INPUT, "more than %d combinations of the lists' values", ZP_CASES_MOST);
    cases *= length;
  }
  if (plan->design.dimensions > zp_design_most(&plan->design))
    return zp_fail(err, ZP_BAD_INPUT, "more than %d keys with a distribution", zp_design_most(&plan->design));
  const size_t samples = zp_design_samples(&plan->design);
  if (cases > ZP_CASES_MOST / samples)
    return zp_fail(err, ZP_BAD_INPUT, "more than %d cases: %zu samples of %zu combinations", ZP_CASES_MOST, samples,
                   cases);
  plan->count = cases * samples;
  return ZP_OK;
}

/* All cases have the same sampling. */
static ZpStatus check_sampling(const ZpGiven *given, ZpError *err) {
  for (size_t i = 0; i < given->count; i++) {
    const char *name = zp_key(given->slot[i]->key)->name;
    const bool common = strncmp(name, "sampling.", 9) == 0 || strncmp(name, "optimize.", 9) == 0;
    if (common && varies(given->slot[i])) return zp_fail(err, ZP_BAD_INPUT, "%s: takes one value, not a list", name);
  }
  return ZP_OK;
}

/* Its arrays. */
static bool make_room(ZpPlan *plan, size_t given) {
  plan->memory = calloc(given + 1, sizeof *plan->at + sizeof *plan->varied + sizeof *plan->axis + sizeof *plan->tied);
  if (!plan->memory) return false;
  plan->at = plan->memory;
  plan->varied = (int *)(plan->at + given);
  plan->axis = plan->varied + given;
  plan->tied = (bool *)(plan->axis + given);
  return true;
}

ZpStatus zp_plan_make(ZpPlan *plan, const ZpGiven *given, ZpError *err) {
  *plan = (ZpPlan){0};
  ZpStatus status = make_room(plan, given->count) ? check_sampling(given, err) : zp_fail_memory(err);
  if (status != ZP_OK) return status;
  find_tied(plan, given);
  find_axes(plan, given);
  find_design(plan, given);
  status = count_cases(plan, given, err);
  return status == ZP_OK ? find_joint(plan, given, err) : status;
}

void zp_plan_free(ZpPlan *plan) {
  zp_together_destroy(&plan->joint);
  free(plan->memory);
  *plan = (ZpPlan){0};
}

void zp_plan_values(const ZpPlan *plan, const ZpGiven *given, size_t index, double *value) {
  const size_t samples = zp_design_samples(&plan->design), sample = index % samples;
  size_t axis = plan->axes, together = 0;
  double drawn[ZP_SOBOL_DIMENSIONS];
  int dimension = plan->joint.dimensions;
  zp_together_draw(&plan->joint, &plan->design, sample, drawn);
  index /= samples;
  for (size_t v = plan->variations; v-- > 0;) { /* backwards: the last list varies fastest */
    const ZpSlot *s = given->slot[plan->at[v]];
    const bool is_tied = plan->tied[plan->at[v]];
    if (s->spread.kind != ZP_DISTRIBUTION_NONE) {
      value[v] = zp_rounded(drawn[--dimension]);
      continue;
    }
    const bool is_axis = axis > 0 && plan->axis[axis - 1] == s->key;
    const size_t length = is_tied ? plan->together : s->count, place = is_axis ? index % length : together;
    if (is_axis) index /= length, axis--;
    if (is_axis && is_tied) together = place;
    value[v] = s->value[place];
  }
}

size_t zp_plan_assign(const ZpPlan *plan, const ZpGiven *given, const double *value, ZpAssignment *list) {
  size_t used = 0, v = plan->variations;
  for (size_t i = given->count; i-- > 0;) {
    const ZpSlot *s = given->slot[i];
    const bool is_varied = v > 0 && plan->at[v - 1] == i;
    if (is_varied) v--;
    if (s->text || !zp_key_in_def(s->key)) continue;
    list[used++] = (ZpAssignment){s->key, is_varied ? value[v] : s->value[0]};
  }
  return used;
}
