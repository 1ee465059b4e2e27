#include "study/sensitivity.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "def/check.h"
#include "rest/refine.h"

/* -- sensitivity.by --------------------------------------------------------------------------------- */

ZpStatus zp_sensitivity_keys(const ZpActuatorDef *def, int *key, int *keys, ZpError *err) {
  ZpStatus status = zp_keys_named("sensitivity.by", def->sensitivity.by, ZP_MAX_SENSITIVITY_KEYS, key, keys, err);
  for (int k = 0; k < *keys && status == ZP_OK; k++)
    status = zp_rest_sensitivity_check(def, key[k], err);
  return status;
}

ZpStatus zp_check_sensitivity(const ZpActuatorDef *def, ZpError *err) {
  int key[ZP_MAX_SENSITIVITY_KEYS], keys;
  return zp_sensitivity_keys(def, key, &keys, err);
}

void zp_note_no_sensitivity(ZpResult *result, const ZpActuatorDef *def) {
  if (*def->sensitivity.by)
    zp_result_note(result,
                   "sensitivity.by is ignored: only stationary, equilibrium, limits, isometric, modes and actuate "
                   "compute derivatives");
}

/* The note of keys by which some forces have no derivative in closed form. */
static void note_differences(ZpResult *result, const ZpActuatorDef *def, const int key[], int keys) {
  enum { LONGEST = ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE + 2 };
  char names[ZP_MAX_SENSITIVITY_KEYS * LONGEST];
  for (int k = 0, length = 0; k < keys; k++)
    length +=
        snprintf(names + length, sizeof names - (size_t)length, "%s%s", k > 0 ? ", " : "", ZP_KEY_SHOWN(def, key[k]));
  if (keys > 0)
    zp_result_note(result, "sensitivity: differences of fourth order stand for derivatives of some forces, by %s",
                   names);
}

ZpStatus zp_sensitivity_of(ZpRest *rest, ZpDerive *derive, void *user, ZpResult *result, ZpError *err) {
  const ZpActuatorDef *def = rest->statics.model->whole;
  int key[ZP_MAX_SENSITIVITY_KEYS], by_difference[ZP_MAX_SENSITIVITY_KEYS], keys, differences = 0;
  ZpStatus status = zp_keys_named("sensitivity.by", def->sensitivity.by, ZP_MAX_SENSITIVITY_KEYS, key, &keys, err);
  for (int k = 0; k < keys && status == ZP_OK; k++) {
    ZpRestSensitivity slope;
    status = zp_rest_sensitivity_open(&slope, &rest->statics, key[k], err);
    if (status == ZP_OK) derive(user, &slope, result);
    if (status == ZP_OK && !slope.exact) by_difference[differences++] = key[k];
    zp_rest_sensitivity_close(&slope);
  }
  note_differences(result, def, by_difference, differences);
  return status;
}

/* -- limits --------------------------------------------------------------------------------------- */

static double gap_of(ZpStatics *s, void *which) {
  return zp_member_gap(s, *(const size_t *)which, NULL);
}

/* Derivative of the gap at which a member counts as closed, from the state that hangs. */
static double rate_of_closed(ZpRest *rest, ZpRestSensitivity *slope, size_t which, const double *hangs, int inputs) {
  zp_rest_go_to(rest, hangs);
  double hanging = zp_member_gap(&rest->statics, which, NULL), rate, sum = 0;
  if (!zp_rest_sensitivity_solve(slope, inputs)) return NAN;
  rate = zp_rest_sensitivity_of(slope, gap_of, &which);
  for (int k = 0; k < slope->by.count; k++) {
    const ZpNeighbour *near = &slope->by.near[k];
    sum += near->weight * zp_closed_opening(near->model + which, hanging + near->offset * rate);
  }
  return sum;
}

/* Of a gradual closing: the gap at which it counts as closed changes, too, with the key and with the largest load. */
static double derive_event(ZpRest *rest, const ZpLimits *limits, ZpLimitKind kind, ZpRestSensitivity *slope) {
  bool load = kind == ZP_LIMIT_LOAD;
  zp_rest_go_to(rest, limits->limit[kind].state);
  const size_t which = zp_quasistatic_deciding(&rest->statics);
  double by_load = 0, closed = load ? rate_of_closed(rest, slope, which, limits->hung, 0)
                                    : rate_of_closed(rest, slope, which, limits->start, ZP_SETS_LOAD);
  if (load) zp_rest_go_to(rest, limits->hung);
  if (load) by_load = zp_quasistatic_closed_by_load(rest, which);
  zp_rest_go_to(rest, limits->limit[kind].state);
  return zp_rest_sensitivity_of_event(slope, load ? ZP_SETS_VOLTAGE : ZP_SETS_LOAD, load ? &rest->load : &rest->square,
                                      zp_closing_gap, closed, by_load);
}

static double derive_limit(ZpRest *rest, const ZpLimits *limits, ZpLimitKind kind, ZpRestSensitivity *slope) {
  const ZpLimit *limit = &limits->limit[kind];
  bool load = kind == ZP_LIMIT_LOAD;
  double rate = NAN;
  if (isnan(limit->value)) return NAN;
  if (limit->end == ZP_TRACK_FOLD) {
    zp_rest_go_to(rest, limit->state);
    rate = zp_rest_sensitivity_of_fold(slope, load ? ZP_SETS_VOLTAGE : ZP_SETS_LOAD, load ? &rest->load : &rest->square,
                                       limit->null);
  }
  if (limit->end == ZP_TRACK_EVENT) rate = derive_event(rest, limits, kind, slope);
  return !load && rest->square.square ? rate / (2 * limit->value) : rate;
}

/* Is it known that an output lacks a derivative? */
static bool has_none(const ZpResult *result, const char *output) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0 && isnan(result->sensitivity[i].value)) return true;
  return false;
}

/* Names and units of limits. */
static const ZpColumn number[ZP_LIMIT_KINDS] = {[ZP_LIMIT_PULL_IN] = {"pull_in_voltage_V", "V", NULL},
                                                [ZP_LIMIT_CLOSING] = {"closing_voltage_V", "V", NULL},
                                                [ZP_LIMIT_RELEASE] = {"release_voltage_V", "V", NULL},
                                                [ZP_LIMIT_LOAD] = {"max_load_kg", "kg", NULL}};

void zp_add_limits(const ZpLimits *limits, const ZpLimitKind order[], size_t count, ZpResult *result) {
  for (size_t k = 0; k < count; k++)
    zp_result_add(result, number[order[k]].name, number[order[k]].unit, limits->limit[order[k]].value);
}

/* Add words to the end of a message. */
__attribute__((format(printf, 2, 3))) static void say(ZpResult *r, const char *format, ...) {
  const size_t length = strlen(r->message);
  va_list values;
  va_start(values, format);
  vsnprintf(r->message + length, sizeof r->message - length, format, values);
  va_end(values);
}

void zp_describe_limits(const ZpStatics *statics, const ZpLimits *limits, bool load, ZpResult *r) {
  const ZpLimit *limit = limits->limit, *closing = &limit[ZP_LIMIT_CLOSING], *release = &limit[ZP_LIMIT_RELEASE],
                *largest = &limit[ZP_LIMIT_LOAD];
  const double pull_in = limit[ZP_LIMIT_PULL_IN].value;
  const char *trouble = zp_statics_trouble(statics);
  r->message[0] = 0;
  if (!isnan(pull_in))
    say(r, "pulls in at %.4g V", pull_in);
  else if (!isnan(closing->value))
    say(r, "no pull-in: closes gradually at %.4g V", closing->value);
  else
    say(r, "no pull-in up to %g V", zp_drive_voltage(statics->model));
  if (closing->end == ZP_TRACK_LOST)
    say(r, "; %s", closing->reason);
  else if (closing->value < pull_in || closing->value > pull_in)
    say(r, ", closes at %.4g V", closing->value);
  if (isnan(release->value))
    say(r, "; no release: %s", release->reason);
  else
    say(r, ", releases at %.4g V", release->value);
  if (load && isnan(largest->value)) say(r, "; no largest load: %s", largest->reason);
  if (load && !isnan(largest->value)) say(r, ", lifts at most %.4g kg", largest->value);
  if (trouble) say(r, ": %s", trouble);
}

/* Which of the first k limits is this one? A release is at most the closing voltage, whatever its state says. */
static size_t same_as(const ZpLimits *limits, const ZpLimitKind order[], size_t k) {
  size_t same = 0;
  while (same < k && limits->limit[order[same]].value != limits->limit[order[k]].value)
    same++;
  return same;
}

void zp_derive_limits(ZpRest *rest, const ZpLimits *limits, const ZpLimitKind order[], size_t count,
                      ZpRestSensitivity *slope, ZpResult *result) {
  double found[ZP_LIMIT_KINDS];
  for (size_t k = 0; k < count; k++) {
    const ZpLimit *limit = &limits->limit[order[k]];
    const char *output = number[order[k]].name;
    const size_t same = same_as(limits, order, k);
    found[k] = same < k ? found[same] : derive_limit(rest, limits, order[k], slope);
    if (isnan(found[k]) && !isnan(limit->value) && !has_none(result, output))
      zp_result_note(result, "%s has no derivatives: %s", output,
                     limit->end == ZP_TRACK_ARRIVED ? "beyond it the closing voltage jumps"
                                                    : "the slope of a force jumps at this state");
    zp_result_add_sensitivity(result, output, slope->key, found[k]);
  }
}

void zp_estimate_limits(ZpRest *rest, const ZpLimits *limits, const ZpLimitKind order[], size_t count,
                        const ZpOtherMesh *other) {
  double change[ZP_LIMIT_KINDS];
  for (size_t k = 0; k < count; k++) {
    const size_t same = same_as(limits, order, k);
    change[k] = same < k ? change[same] : zp_refine_limit(rest, limits, order[k], other->rest);
    zp_add_estimate(other, number[order[k]].name, change[k]);
  }
}
