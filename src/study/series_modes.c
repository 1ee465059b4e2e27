/* Study `modes` of actuators in series: each member is in equilibrium as if alone, and all move as one system, eq.
 * (29.3). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/chain.h"
#include "study/modes.h"
#include "study/notes.h"
#include "study/series.h"

typedef struct Problem {
  ZpChain chain;
  ZpVibration vibration;
  ZpManyShapes shapes;
  double *equilibrium[ZP_MOST_MEMBERS]; /* of each */
  ZpMargins margins;          /* of the equilibrium */
  void *memory;
} Problem;

static void carve(Problem *p, ZpCarver *carver) {
  const ZpModel *first = p->chain.alone[0];
  zp_vibration_carve(&p->vibration, p->chain.at[p->chain.count], ZP_MODES_SUBSPACE, carver);
  zp_many_carve(&p->shapes, p->chain.count, first->count, first->nodes, carver);
  for (size_t k = 0; k < p->chain.count; k++)
    p->equilibrium[k] = zp_carve(carver, zp_rest_save_size(&p->chain.of[k]));
}

static bool allocate(Problem *p) {
  ZpCarver carver = {NULL, 0};
  carve(p, &carver);
  p->memory = zp_calloc(1, carver.used);
  carver = (ZpCarver){p->memory, 0};
  carve(p, &carver);
  p->vibration.many = &p->chain.vibrating;
  return p->memory != NULL;
}

/* Frame 0 is the equilibrium, frame j + 1 mode j. */
static void record_shape(Problem *p, double frame, size_t j, double amplitude, ZpShapes *shapes) {
  ZpShape shape = {0};
  for (size_t k = 0; k < p->chain.count; k++) {
    ZpRest *rest = &p->chain.of[k];
    zp_modes_move(rest, p->equilibrium[k], p->vibration.u + j * p->vibration.n + p->chain.at[k], amplitude);
    ZpMargins margins;
    ZpShape one = zp_rest_shape(rest, frame, &margins);
    if (frame == 0) zp_margins_join(&p->margins, margins);
    zp_many_put(&p->shapes, k, &one);
    zp_many_hang(&p->shapes, k, rest->statics.member->model->s);
    if (k == 0) shape = one;
  }
  zp_many_give(&p->shapes, &shape);
  zp_shapes_offer(shapes, &shape);
}

static void report(Problem *p, ZpResult *result) {
  const ZpModel *first = p->chain.alone[0];
  for (size_t k = 0; k < p->chain.count; k++)
    p->chain.of[k].system.save(&p->chain.of[k].statics, p->equilibrium[k]);
  record_shape(p, 0, 0, 0, result->shapes);
  for (size_t j = 0; j < zp_modes_count(&p->vibration); j++) {
    zp_modes_add(&p->vibration, j, result);
    record_shape(p, (double)(j + 1), j, zp_modes_amplitude(&p->vibration, j, first->L), result->shapes);
  }
}

static bool stop(void *task) {
  return zp_task_stops(task, "hanging", 0);
}

static void run(Problem *p, const ZpTask *task, ZpResult *result) {
  double voltage = task->def->modes.voltage;
  zp_chain_watch(&p->chain, stop, (void *)task);
  bool hangs = zp_chain_hang(&p->chain);
  result->outcome = zp_chain_stopped(&p->chain) ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(result->message, sizeof result->message, "no hanging equilibrium found");
  if (!hangs) return;
  if (voltage > 0 && !zp_chain_raise(&p->chain, voltage))
    zp_modes_pulled_in(&p->vibration, voltage, zp_chain_stopped(&p->chain) ? "interrupted" : NULL, result);
  else if (zp_modes_solve(&p->vibration, result))
    report(p, result);
}

static void note(const Problem *p, const ZpTask *task, ZpMargins margins, ZpResult *result) {
  for (size_t k = 0; k < p->chain.count; k++)
    zp_margins_join(&margins, zp_margins_at_clip(p->chain.alone[k], task->def->modes.voltage));
  zp_add_margins(result, p->chain.alone[0], &margins);
  zp_note_mesh(result, p->chain.alone[0], task->def->modes.voltage);
  zp_note_rest(result, p->chain.alone[0]);
  zp_modes_note_bead(result, task->def);
}

ZpStatus zp_series_modes(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpActuatorDef def = zp_modes_def(task->def);
  ZpStatus status = zp_model_create(&def, &model, err);
  if (status != ZP_OK) return status;
  Problem *p = zp_calloc(1, sizeof *p);
  status = p ? zp_chain_open(&p->chain, model, err) : zp_fail_memory(err);
  result->series = zp_modes_table();
  result->shapes = zp_shapes_create(model->s, zp_members(model) * model->nodes, ZP_MODES + 1);
  bool has_room = status == ZP_OK && result->series && result->shapes && allocate(p);
  if (has_room) {
    result->shapes->members = p->chain.count;
    p->margins = zp_margins_none();
    run(p, task, result);
    note(p, task, p->margins, result);
  } else if (status == ZP_OK) {
    status = zp_fail_memory(err);
  }
  if (p) zp_chain_close(&p->chain);
  if (p) zp_free(p->memory);
  zp_free(p);
  zp_model_destroy(model);
  return status;
}
