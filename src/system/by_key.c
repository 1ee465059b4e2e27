#include "system/by_key.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"

/* -- neighbours ------------------------------------------------------------------------------------ */

/* Of the range, where value and default are 0. */
static const double part_of_range = 1e-6;

/* Step of a key of this value: a part of it, or where it is 0 of its default, which has the size of usual values. */
static double step_of(const ZpKey *row, double value, double part) {
  double size = value != 0 ? fabs(value) : fabs(row->def);
  return size > 0 ? part * size : part_of_range * row->max;
}

/* Difference quotients of fourth order: around the value, below it, above it. */
typedef struct Stencil {
  int first;                           /* place of the first point, in steps */
  double weight[ZP_DIFFERENCE_POINTS]; /* times 12 */
} Stencil;

static const Stencil stencils[] = {{-2, {1, -8, 0, 8, -1}}, {-4, {3, -16, 36, -48, 25}}, {0, {-25, 48, -36, 16, -3}}};
enum { STENCILS = sizeof stencils / sizeof stencils[0] };

void zp_finite_difference_close(ZpFiniteDifference *by) {
  for (int k = 0; k < by->count; k++)
    zp_model_destroy(by->near[k].model);
  by->count = 0;
}

static ZpStatus build(ZpFiniteDifference *by, const ZpModel *model, const Stencil *stencil, ZpError *err) {
  ZpDriveTable table = model->waveform.table;
  ZpStatus status = ZP_OK;
  for (int k = 0; k < ZP_DIFFERENCE_POINTS && status == ZP_OK; k++) {
    ZpActuatorDef def = *model->whole;
    ZpNeighbour *near = &by->near[by->count];
    *near = (ZpNeighbour){NULL, (stencil->first + k) * by->step, stencil->weight[k] / (12 * by->step)};
    if (stencil->weight[k] == 0) continue;
    status = zp_def_set(&def, by->key, zp_def_get(&def, by->key) + near->offset, err);
    if (status == ZP_OK) status = zp_model_create_driven(&def, table.rows > 0 ? &table : NULL, &near->model, err);
    zp_def_clear(&def);
    if (status != ZP_OK) continue;
    zp_model_take_laws(near->model, model);
    by->count++;
  }
  if (status != ZP_OK) zp_finite_difference_close(by);
  return status;
}

ZpStatus zp_finite_difference_open(ZpFiniteDifference *by, const ZpModel *model, int key, double part, ZpError *err) {
  enum { FARTHEST = 4, PERCENT = 100 };
  *by = (ZpFiniteDifference){.key = key};
  const ZpKey *row = zp_key(key);
  double value = zp_def_get(model->whole, key);
  ZpError reason = {ZP_OK, ""};
  ZpStatus status = ZP_BAD_INPUT;
  by->step = step_of(row, value, part);
  for (int k = 0; k < STENCILS && status == ZP_BAD_INPUT; k++)
    status = build(by, model, &stencils[k], &reason);
  if (status == ZP_MACHINE) return zp_fail_memory(err);
  if (status != ZP_OK)
    return zp_fail(err, status, "sensitivity.by: %s = %g %s cannot be changed by %g %% either way: %.200s",
                   ZP_KEY_SHOWN(model->whole, key), value, row->unit, PERCENT * FARTHEST * part, reason.message);
  return ZP_OK;
}

int zp_key_of_neighbour(const ZpModel *model, const ZpModel *neighbour, double offset) {
  static const double rounding = 1e-9; /* over the offset, which is a small part of the key */
  int found = -1;
  for (int key = zp_key_next_field(-1); key >= 0; key = zp_key_next_field(key)) {
    double a = zp_def_get(&model->def, key), b = zp_def_get(&neighbour->def, key);
    if (a == b || (isnan(a) && isnan(b))) continue;
    if (found >= 0 || !(fabs(b - a - offset) <= rounding * fabs(offset))) return -1;
    found = key;
  }
  return found;
}

/* -- forces ---------------------------------------------------------------------------------------- */

/* Add what laws say, and list these. */
static ZpTerms add_known(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *rate) {
  ZpTerms known = {.count = 0};
  for (const ZpLaw *law = model->law; key >= 0 && law < model->law + model->laws; law++)
    if (law->term->by_key && law->term->by_key(model, span, e, key, rate)) known.term[known.count++] = law->term;
  return known;
}

/* Differences are taken from the force here, so that a law that does not depend on the key adds exactly 0. */
bool zp_system_by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, const ZpNear *near, int count,
                      double *work, double *rate) {
  const size_t n = zp_coordinates(model);
  bool exact = true;
  zp_system_force(model, span, e, work);
  memset(rate, 0, n * sizeof *rate);
  const ZpTerms known = add_known(model, span, e, key, rate);
  zp_system_force_without(model, span, &known, e, work);
  for (const ZpNear *at = near; at < near + count; at++) {
    ZpSpan there = *span;
    there.start = there.end = at->q;
    zp_system_force_without(at->model, &there, &known, at->eval, at->force);
    for (size_t i = 0; i < n; i++) {
      double change = at->force[i] - work[i];
      rate[i] += at->weight * change;
      exact &= change == 0;
    }
  }
  return exact;
}
