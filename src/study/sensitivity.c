#include "study/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"

/* -- sensitivity.by --------------------------------------------------------------------------------- */

typedef struct KeyList {
  int key[ZP_MAX_SENSITIVITY_KEYS], count;
} KeyList;

static ZpStatus add_key(const ZpActuatorDef *def, const char *name, KeyList *list, ZpError *err) {
  int key = zp_key_find(name);
  if (key < 0) {
    char reason[256];
    zp_key_unknown(name, reason, sizeof reason);
    return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: %.80s: %s", name, reason);
  }
  if (list->count == ZP_MAX_SENSITIVITY_KEYS)
    return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: more than %d keys", ZP_MAX_SENSITIVITY_KEYS);
  for (int i = 0; i < list->count; i++)
    if (list->key[i] == key) return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: %s is named twice", name);
  list->key[list->count++] = key;
  return zp_slope_check(def, key, err);
}

/* "a, b" => keys. */
static ZpStatus read_keys(const ZpActuatorDef *def, KeyList *list, ZpError *err) {
  const char *text = def->sensitivity.by, *end = text + strlen(text);
  *list = (KeyList){.count = 0};
  if (strspn(text, " ") == strlen(text)) return ZP_OK;
  for (;;) {
    char name[ZP_TEXT_SIZE];
    text += strspn(text, " ");
    size_t piece = strcspn(text, ","), length = piece;
    while (length > 0 && text[length - 1] == ' ')
      length--;
    memcpy(name, text, length);
    name[length] = 0;
    ZpStatus status = add_key(def, name, list, err);
    text += piece;
    if (status != ZP_OK || text == end) return status;
    text++;
  }
}

ZpStatus zp_sensitivity_keys(const ZpActuatorDef *def, int *key, int *keys, ZpError *err) {
  KeyList list;
  ZpStatus status = read_keys(def, &list, err);
  memcpy(key, list.key, sizeof list.key);
  *keys = list.count;
  return status;
}

ZpStatus zp_check_sensitivity(const ZpActuatorDef *def, ZpError *err) {
  KeyList list;
  return read_keys(def, &list, err);
}

void zp_note_no_sensitivity(ZpResult *result, const ZpActuatorDef *def) {
  if (*def->sensitivity.by)
    zp_result_note(result,
                   "sensitivity.by is ignored: only stationary, equilibrium, limits, isometric, modes and actuate "
                   "compute derivatives");
}

ZpStatus zp_sensitivity_of(ZpRest *rest, void (*derive)(void *user, ZpSlope *slope, ZpResult *result), void *user,
                           ZpResult *result, ZpError *err) {
  KeyList list;
  ZpStatus status = read_keys(&rest->statics.model->def, &list, err);
  for (int k = 0; k < list.count && status == ZP_OK; k++) {
    ZpSlope slope;
    status = zp_slope_open(&slope, &rest->statics, &rest->branch.newton, list.key[k], err);
    if (status == ZP_OK) derive(user, &slope, result);
    zp_slope_close(&slope);
  }
  return status;
}

/* -- limits --------------------------------------------------------------------------------------- */

static double closing_gap(ZpStatics *s, void *user) {
  (void)user;
  return zp_closing_gap(s, NULL);
}

static void pose_voltage(const ZpActuatorDef *def, ZpStatics *s) {
  s->U = def->drive.voltage;
}

/* Derivative of the gap at which it counts as closed, from the hanging state. */
static double rate_of_closed(const ZpLimitList *list, ZpSlope *slope) {
  zp_slow_go_to(list->slow, list->hanging);
  double hanging = zp_closing_gap(list->slow->statics, NULL), rate, sum = 0;
  if (!zp_slope_solve(slope, zp_pose_load)) return NAN;
  rate = zp_slope_of(slope, zp_pose_load, closing_gap, NULL);
  for (int k = 0; k < ZP_NEAR_POINTS; k++)
    if (slope->by.model[k])
      sum += slope->by.weight[k] * zp_closing_limit(&slope->near[k], hanging + slope->by.offset[k] * rate);
  return sum;
}

static double derive_limit(const ZpLimitList *list, const ZpNamedLimit *item, double closed, ZpSlope *slope) {
  ZpSlow *slow = list->slow;
  ZpPose pose = item->is_load ? pose_voltage : zp_pose_load;
  const ZpBranchSystem *branch = item->is_load ? &slow->load : &slow->square;
  if (isnan(item->limit->value)) return NAN;
  zp_slow_go_to(slow, item->limit->state);
  double rate = item->limit->end == ZP_MARCH_FOLD ? zp_slope_of_fold(slope, pose, branch, item->limit->null)
                                                  : zp_slope_of_event(slope, pose, branch, zp_closing_gap, closed);
  return item->is_load ? rate : rate / (2 * item->limit->value);
}

/* Is it known that an output lacks a derivative? */
static bool has_none(const ZpResult *result, const char *output) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0 && isnan(result->sensitivity[i].value)) return true;
  return false;
}

void zp_derive_limits(void *user, ZpSlope *slope, ZpResult *result) {
  const ZpLimitList *list = user;
  double closed = rate_of_closed(list, slope), found[ZP_MOST_LIMITS];
  for (size_t k = 0; k < list->count; k++) {
    const ZpNamedLimit *item = &list->item[k];
    size_t same = 0; /* a release is at most the closing voltage, whatever its state says */
    while (same < k && list->item[same].limit->value != item->limit->value)
      same++;
    found[k] = same < k ? found[same] : derive_limit(list, item, closed, slope);
    if (isnan(found[k]) && !isnan(item->limit->value) && !has_none(result, item->output))
      zp_result_note(result, "%s has no derivatives: the slope of a force jumps at this state", item->output);
    zp_result_add_sensitivity(result, item->output, slope->key, found[k]);
  }
}
