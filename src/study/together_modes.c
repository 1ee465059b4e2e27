/* Study `modes` of actuators that share one load: small vibrations of all as one system, whose height of the load is
 * one coordinate of all. docs/theory.md, sections 29 and 31. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/together.h"
#include "study/modes.h"
#include "study/notes.h"
#include "study/together.h"

typedef struct Problem {
  const ZpModel *model; /* of the first one */
  const ZpTask *task;
  ZpTogether all;
  ZpVibration vibration;
  ZpManyShapes shapes;
  double *q[ZP_MOST_MEMBERS]; /* [2 stride] of the equilibrium of each */
  ZpMargins margins;          /* of the equilibrium */
} Problem;

static void carve(void *user, ZpCarver *carver) {
  Problem *p = user;
  zp_vibration_carve(&p->vibration, p->all.system.at_rest.n, ZP_MODES_SUBSPACE, carver);
  zp_many_carve(&p->shapes, p->all.count, p->model->count, p->model->nodes, carver);
  for (size_t which = 0; which < p->all.count; which++)
    p->q[which] = zp_carve(carver, 2 * p->model->stride);
}

/* Frame 0 is the equilibrium, frame j + 1 mode j. */
static void record_shape(Problem *p, double frame, size_t j, double amplitude, ZpShapes *shapes) {
  ZpShape shape = {0};
  zp_together_part(&p->all, p->vibration.u + j * p->vibration.n);
  for (size_t which = 0; which < p->all.count; which++) {
    ZpRest *rest = &p->all.of[which];
    zp_modes_move(&rest->statics, p->q[which], p->all.step[which], amplitude);
    ZpShape one = zp_statics_shape(&rest->statics, frame, &rest->shape_room);
    if (frame == 0) zp_margins_join(&p->margins, zp_margins_of(rest->statics.model, &one));
    double *y = zp_many_put(&p->shapes, which, &one);
    if (which == 0) shape = one;
    if (which == 1 && !p->model->abreast) zp_shape_turn_over(p->model->below, y);
  }
  zp_many_give(&p->shapes, &shape);
  zp_shapes_offer(shapes, &shape);
}

static void report(Problem *p, ZpResult *result) {
  for (size_t which = 0; which < p->all.count; which++)
    memcpy(p->q[which], p->all.of[which].statics.q, 2 * p->model->stride * sizeof *p->q[which]);
  record_shape(p, 0, 0, 0, result->shapes);
  for (size_t j = 0; j < zp_modes_count(&p->vibration); j++) {
    zp_modes_add(&p->vibration, j, result);
    record_shape(p, (double)(j + 1), j, zp_modes_amplitude(&p->vibration, j, p->model->L), result->shapes);
  }
}

static bool stop(void *task) {
  return zp_task_stops(task, "hanging", 0);
}

static void run(Problem *p, ZpResult *result) {
  double voltage = p->task->def->modes.voltage;
  ZpVibration *v = &p->vibration;
  zp_together_watch(&p->all, stop, (void *)p->task);
  bool found = zp_newton_good(zp_together_hang(&p->all).end);
  result->outcome = zp_together_stopped(&p->all) ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(result->message, sizeof result->message, "no equilibrium of all members found");
  if (!found) return;
  snprintf(result->message, sizeof result->message, "the lower one pulls in below stack.lower_voltage");
  if (!zp_together_bias(&p->all)) return;
  if (!zp_together_raise(&p->all, voltage)) {
    zp_modes_pulled_in(v, voltage, zp_together_stopped(&p->all) ? "interrupted" : NULL, result);
    return;
  }
  v->K = &p->all.branch.newton.K;
  zp_together_masses(&p->all, v->mass);
  if (zp_modes_solve(v, result)) report(p, result);
}

static void note(Problem *p, ZpResult *result) {
  for (size_t which = 0; which < p->all.count; which++) {
    const ZpStatics *s = &p->all.of[which].statics;
    zp_margins_join(&p->margins, zp_margins_at_clip(s->model, s->U));
  }
  zp_add_margins(result, p->model, &p->margins);
  zp_note_mesh(result, p->model, p->task->def->modes.voltage);
  zp_note_rest(result, p->model);
  zp_modes_note_bead(result, p->task->def);
}

ZpStatus zp_together_modes(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpActuatorDef def = zp_modes_def(task->def);
  ZpStatus status = zp_model_create(&def, &model, err);
  if (status != ZP_OK) return status;
  Problem *p = zp_calloc(1, sizeof *p);
  result->series = zp_modes_table();
  result->shapes = zp_shapes_create(model->s, zp_members(model) * model->nodes, ZP_MODES + 1);
  if (p) *p = (Problem){.model = model, .task = task, .margins = zp_margins_none()};
  if (p && result->series && result->shapes && zp_together_open(&p->all, model, carve, p)) {
    result->shapes->members = p->all.count;
    run(p, result);
    note(p, result);
  } else {
    status = zp_fail_memory(err);
  }
  if (p) zp_together_close(&p->all);
  zp_free(p);
  zp_model_destroy(model);
  return status;
}
