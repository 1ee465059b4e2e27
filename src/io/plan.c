/* Limits: CASES_MOST cases, a bound against requests by mistake; VALUES_MOST values in all lists, so that the written
 * scenario stays below the size that can be read.
 *
 * A problem that a later --set may solve, such as lists of different lengths that vary together, is reported only when
 * a Def is requested. */
#include "io/plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "def/def.h"
#include "io/range.h"
#include "io/value.h"

enum { CASES_MOST = 1000000, VALUES_MOST = 20000 };

static bool varies(const ZpSlot *slot) {
  return slot->is_list || slot->spread.kind != ZP_DISTRIBUTION_NONE;
}

/* The given value of a key, otherwise its default. */
static double value_of(const ZpSlot *const *slot, const ZpActuatorDef *defaults, const char *name) {
  const int key = zp_key_find(name);
  return slot[key]->count ? slot[key]->value[0] : zp_def_get(defaults, key);
}

static void set_problem(ZpPlan *plan, int key, const char *what) {
  if (!plan->problem.status)
    zp_fail(&plan->problem, ZP_BAD_INPUT, "sampling.together: %s: %s", zp_key(key)->name, what);
}

static void tie(ZpPlan *plan, const ZpSlot *const *slot, int key) {
  size_t first = 0;
  if (!slot[key]->is_list) {
    set_problem(plan, key, "has no list of values");
    return;
  }
  while (first < ZP_KEYS && !plan->tied[first])
    first++;
  if (first < ZP_KEYS && slot[first]->count != slot[key]->count)
    set_problem(plan, key, "its list is not as long as those of the other keys");
  plan->tied[key] = true;
}

/* Read sampling.together. */
static void find_tied(ZpPlan *plan, const ZpSlot *const *slot) {
  const char *text = slot[zp_key_find("sampling.together")]->text;
  int key[ZP_KEYS], count;
  memset(plan->tied, 0, sizeof plan->tied);
  plan->problem = (ZpError){0};
  if (zp_keys_named("sampling.together", text ? text : "", ZP_KEYS, key, &count, &plan->problem) != ZP_OK) return;
  for (int k = 0; k < count; k++)
    tie(plan, slot, key[k]);
}

/* A list multiplies the number of cases; of lists that vary together only the shortest does. */
static void find_axes(ZpPlan *plan, const ZpSlot *const *slot) {
  size_t tied = 0, seen = 0;
  plan->axes = plan->variations = 0;
  plan->together = 1;
  for (size_t i = 0; i < ZP_KEYS; i++)
    if (plan->tied[i] && (tied++ == 0 || slot[i]->count < plan->together)) plan->together = slot[i]->count;
  for (size_t i = 0; i < ZP_KEYS; i++) {
    if (varies(slot[i])) plan->varied[plan->variations++] = (int)i;
    seen += plan->tied[i];
    if (slot[i]->is_list && (!plan->tied[i] || seen == tied)) plan->axis[plan->axes++] = (int)i;
  }
}

static void find_design(ZpPlan *plan, const ZpSlot *const *slot) {
  const ZpActuatorDef defaults = zp_actuator_def_default();
  plan->design = (ZpDesign){.method = (ZpSampling)value_of(slot, &defaults, "sampling.method"),
                            .count = (size_t)value_of(slot, &defaults, "sampling.count"),
                            .seed = (uint32_t)value_of(slot, &defaults, "sampling.seed"),
                            .indices = value_of(slot, &defaults, "sampling.indices") != 0};
  for (size_t i = 0; i < ZP_KEYS; i++)
    plan->design.dimensions += slot[i]->spread.kind != ZP_DISTRIBUTION_NONE;
  if (plan->design.dimensions == 0) plan->design = (ZpDesign){.count = 1};
}

static ZpStatus count_cases(ZpPlan *plan, const ZpSlot *const *slot, ZpError *err) {
  size_t values = 0, cases = 1;
  for (size_t i = 0; i < ZP_KEYS; i++)
    values += slot[i]->is_list ? slot[i]->count : 0;
  if (values > VALUES_MOST) return zp_fail(err, ZP_BAD_INPUT, "more than %d values in lists", VALUES_MOST);
  for (size_t i = 0; i < plan->axes; i++) {
    const size_t length = plan->tied[plan->axis[i]] ? plan->together : slot[plan->axis[i]]->count;
    if (cases > CASES_MOST / length)
      return zp_fail(err, ZP_BAD_INPUT, "more than %d combinations of the lists' values", CASES_MOST);
    cases *= length;
  }
  if (plan->design.dimensions > zp_design_most(&plan->design))
    return zp_fail(err, ZP_BAD_INPUT, "more than %d keys with a distribution", zp_design_most(&plan->design));
  const size_t samples = zp_design_samples(&plan->design);
  if (cases > CASES_MOST / samples)
    return zp_fail(err, ZP_BAD_INPUT, "more than %d cases: %zu samples of %zu combinations", CASES_MOST, samples,
                   cases);
  plan->count = cases * samples;
  return ZP_OK;
}

/* All cases have the same sampling. */
static ZpStatus check_sampling(const ZpSlot *const *slot, ZpError *err) {
  for (size_t i = 0; i < ZP_KEYS; i++) {
    const char *name = zp_key((int)i)->name;
    const bool common = strncmp(name, "sampling.", 9) == 0 || strncmp(name, "optimize.", 9) == 0;
    if (common && varies(slot[i])) return zp_fail(err, ZP_BAD_INPUT, "%s: takes one value, not a list", name);
  }
  return ZP_OK;
}

ZpStatus zp_plan_make(ZpPlan *plan, const ZpSlot *const *slot, ZpError *err) {
  ZpStatus status = check_sampling(slot, err);
  if (status != ZP_OK) return status;
  find_tied(plan, slot);
  find_axes(plan, slot);
  find_design(plan, slot);
  return count_cases(plan, slot, err);
}

void zp_plan_values(const ZpPlan *plan, const ZpSlot *const *slot, size_t index, double *value) {
  const size_t samples = zp_design_samples(&plan->design), sample = index % samples;
  size_t axis = plan->axes, together = 0;
  int dimension = plan->design.dimensions;
  index /= samples;
  for (size_t v = plan->variations; v-- > 0;) { /* backwards: the last list varies fastest */
    const int key = plan->varied[v];
    const ZpSlot *s = slot[key];
    if (s->spread.kind != ZP_DISTRIBUTION_NONE) {
      value[v] = zp_rounded(zp_quantile(&s->spread, zp_design_share(&plan->design, sample, --dimension)));
      continue;
    }
    const bool is_axis = axis > 0 && plan->axis[axis - 1] == key;
    const size_t length = plan->tied[key] ? plan->together : s->count, place = is_axis ? index % length : together;
    if (is_axis) index /= length, axis--;
    if (is_axis && plan->tied[key]) together = place;
    value[v] = s->value[place];
  }
}

size_t zp_plan_assign(const ZpPlan *plan, const ZpSlot *const *slot, const double *value, ZpAssignment *list) {
  size_t used = 0, v = plan->variations;
  for (size_t i = ZP_KEYS; i-- > 0;) {
    const ZpSlot *s = slot[i];
    const bool is_varied = v > 0 && plan->varied[v - 1] == (int)i;
    if (is_varied) v--;
    if (s->count == 0 || s->text || !zp_key_in_def((int)i)) continue;
    list[used++] = (ZpAssignment){(int)i, is_varied ? value[v] : s->value[0]};
  }
  return used;
}
