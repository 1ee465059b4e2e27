#include "rest/finite_difference.h"

#include <math.h>

#include "base/fail.h"
#include "system/system.h"

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

void zp_finite_difference_close(ZpFiniteDifference *near) {
  for (int k = 0; k < ZP_DIFFERENCE_POINTS; k++) {
    zp_model_destroy(near->model[k]);
    near->model[k] = NULL;
  }
}

static ZpStatus build(ZpFiniteDifference *near, const ZpModel *model, const Stencil *stencil, ZpError *err) {
  ZpDriveTable table = model->waveform.table;
  ZpStatus status = ZP_OK;
  for (int k = 0; k < ZP_DIFFERENCE_POINTS && status == ZP_OK; k++) {
    ZpActuatorDef def = model->whole;
    near->offset[k] = (stencil->first + k) * near->step;
    near->weight[k] = stencil->weight[k] / (12 * near->step);
    if (stencil->weight[k] == 0) continue;
    status = zp_def_set(&def, near->key, zp_def_get(&def, near->key) + near->offset[k], err);
    if (status == ZP_OK) status = zp_model_create_driven(&def, table.rows > 0 ? &table : NULL, &near->model[k], err);
    if (status == ZP_OK) zp_model_take_laws(near->model[k], model);
  }
  if (status != ZP_OK) zp_finite_difference_close(near);
  return status;
}

ZpStatus zp_finite_difference_open(ZpFiniteDifference *near, const ZpModel *model, int key, double part, ZpError *err) {
  enum { FARTHEST = 4, PERCENT = 100 };
  *near = (ZpFiniteDifference){.key = key};
  const ZpKey *row = zp_key(key);
  double value = zp_def_get(&model->whole, key);
  ZpError reason = {ZP_OK, ""};
  ZpStatus status = ZP_BAD_INPUT;
  near->step = step_of(row, value, part);
  for (int k = 0; k < STENCILS && status == ZP_BAD_INPUT; k++)
    status = build(near, model, &stencils[k], &reason);
  if (status == ZP_MACHINE) return zp_fail_memory(err);
  if (status != ZP_OK)
    return zp_fail(err, status, "sensitivity.by: %s = %g %s cannot be changed by %g %% either way: %.200s", row->name,
                   value, row->unit, PERCENT * FARTHEST * part, reason.message);
  return ZP_OK;
}
