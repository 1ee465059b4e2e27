/* State => forces. The one place where mechanics, field, drag and weight meet. */
#include "actuator/eval.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "ribbon/drag.h"

static size_t carve(const ZpModel *model, ZpEval *e, void *block) {
  ZpCarver carver = {block, 0};
  zp_massspring_carve(&model->spring, &e->spring, &carver);
  zp_plates_carve(&model->plates, &e->plates, &carver);
  e->drag_x = zp_carve(&carver, model->count);
  e->drag_y = zp_carve(&carver, model->count);
  e->force = zp_carve(&carver, 2 * model->count);
  e->basis.B1 = zp_carve(&carver, 2 * model->nodes);
  e->basis.B2 = zp_carve(&carver, 2 * model->nodes);
  return carver.used;
}

bool zp_eval_create(const ZpModel *model, ZpEval *e) {
  memset(e, 0, sizeof *e);
  e->memory = zp_calloc(1, carve(model, e, NULL));
  if (!e->memory) return false;
  carve(model, e, e->memory);
  return true;
}

void zp_eval_destroy(ZpEval *e) {
  zp_free(e->memory);
  e->memory = NULL;
}

/* Direction of the closed part where it ends: that of the last closed link, horizontal at the clip. */
static void closed_direction(const ZpModel *model, size_t front, const ZpMassSpringEval *spring, double direction[2]) {
  direction[0] = 1;
  direction[1] = 0;
  if (front == 0) return;
  size_t j = model->s * (front - 1);
  double x = spring->ux[j] + spring->ux[j + 1], y = spring->uy[j] + spring->uy[j + 1];
  double length = sqrt(x * x + y * y);
  if (length == 0) return;
  direction[0] = x / length;
  direction[1] = y / length;
}

static void bezier_forces(const ZpModel *model, const ZpState *state, const double *q, ZpEval *e) {
  size_t front = state->zip.front, free_stations = model->nodes - front;
  if (free_stations >= 2 && e->basis.count != free_stations) zp_bezier_basis(&e->basis, free_stations);
  double direction[2];
  closed_direction(model, front, &e->spring, direction);
  zp_surface_bezier(&model->plates, &e->basis, q, q + model->count, front, direction, state->U, &e->plates);
}

static void electric_forces(const ZpModel *model, const ZpState *state, const double *q, ZpEval *e) {
  const ZpActuatorDef *def = &model->def;
  if (def->electro.surface == ZP_SURFACE_POLYLINE)
    zp_plates_polyline(&model->plates, q, q + model->count, state->U, &e->plates);
  else if (def->electro.refresh_period > 0)
    memcpy(e->plates.Fy, state->data + 4 * model->count, model->nodes * sizeof(double));
  else
    bezier_forces(model, state, q, e);
}

/* Elastic forces and weight on each node. */
ZP_KERNEL static void add_elastic_and_weight(size_t count, size_t s, const double *restrict Rx,
                                             const double *restrict Ry, const double *restrict weight,
                                             double *restrict fx, double *restrict fy) {
  const double *restrict Lx = Rx - s, *restrict Ly = Ry - s;
  ZP_SIMD
  for (size_t j = 0; j < count; j++) {
    fx[j] = Lx[j] - Rx[j];
    fy[j] = Ly[j] - Ry[j] - weight[j];
  }
}

ZP_KERNEL static void add_drag(size_t count, const double *restrict drag_x, const double *restrict drag_y,
                               double *restrict fx, double *restrict fy) {
  ZP_SIMD
  for (size_t j = 0; j < count; j++) {
    fx[j] += drag_x[j];
    fy[j] += drag_y[j];
  }
}

/* Attraction: downwards on the upper, upwards on the lower ribbon. */
ZP_KERNEL static void add_attraction(size_t nodes, const double *restrict Fx, const double *restrict Fy,
                                     double *restrict fx, double *restrict fy) {
  ZP_SIMD
  for (size_t i = 0; i < nodes; i++) {
    fx[2 * i] += Fx[i];
    fx[2 * i + 1] += Fx[i];
    fy[2 * i] -= Fy[i];
    fy[2 * i + 1] += Fy[i];
  }
}

void zp_eval_forces(const ZpModel *model, const ZpState *state, const double *q, const double *v, ZpActing acting,
                    ZpEval *e) {
  size_t count = model->count;
  double *fx = e->force, *fy = e->force + count;
  zp_massspring_eval(&model->spring, q, q + count, &e->spring);
  add_elastic_and_weight(count, model->s, e->spring.Rx, e->spring.Ry, model->weight, fx, fy);
  e->drag_power = e->drag_rate = 0;
  if (acting == ZP_ELASTIC_AND_WEIGHT) return;
  if (model->def.damping.drag > 0) {
    e->drag_rate = zp_drag(model->def.damping.drag, count, v, v + count, model->masses.x.single, e->drag_x, e->drag_y,
                           &e->drag_power);
    add_drag(count, e->drag_x, e->drag_y, fx, fy);
  }
  if (model->field && state->U > 0) {
    electric_forces(model, state, q, e);
    add_attraction(model->nodes, e->plates.Fx, e->plates.Fy, fx, fy);
  }
}

void zp_eval_accelerations(const ZpModel *model, const ZpMasses *masses, const ZpZipState *zip, const ZpEval *e,
                           double *a) {
  size_t count = model->count;
  if (model->s == 2) {
    zp_zip_accelerate(zip, model->nodes, &masses->x, e->force, a);
    zp_zip_accelerate(zip, model->nodes, &masses->y, e->force + count, a + count);
    return;
  }
  for (size_t j = 0; j < count; j++) {
    a[j] = e->force[j] * masses->x.single[j];
    a[count + j] = e->force[count + j] * masses->y.single[j];
  }
}

bool zp_eval_refresh_due(const ZpModel *model, const ZpState *state) {
  double period = model->def.electro.refresh_period;
  return period > 0 && !(state->t - state->refreshed < period);
}

void zp_eval_refresh(const ZpModel *model, ZpState *state, ZpEval *e) {
  double *q = zp_state_q(model, state);
  zp_massspring_eval(&model->spring, q, q + model->count, &e->spring);
  bezier_forces(model, state, q, e);
  memcpy(zp_state_held(model, state), e->plates.Fy, model->nodes * sizeof(double));
  state->refreshed = state->t;
}

static double ratio_bound(double length, double speed) {
  return speed > 0 ? 2 * length / speed : INFINITY;
}

ZpStepBounds zp_eval_step_bounds(const ZpModel *model, const double *v, const ZpEval *e) {
  ZpStepBounds bounds = {INFINITY, INFINITY, INFINITY};
  size_t s = model->s, count = model->count;
  const ZpMassSpringEval *spring = &e->spring;
  double c = model->def.damping.drag;
  const double *bx = spring->ux - s, *by = spring->uy - s;
  for (size_t j = 0; j < count; j++) {
    double speed = hypot(v[j], v[count + j]);
    bounds.drag = fmin(bounds.drag, ratio_bound(model->mass[j], c * speed));
    if (j + s >= count) continue;
    double shear = fabs(bx[j] * spring->dpy[j] - by[j] * spring->dpx[j]);
    bounds.axial = fmin(bounds.axial, ratio_bound(hypot(spring->dpx[j], spring->dpy[j]), speed));
    bounds.shear = fmin(bounds.shear, ratio_bound(shear, speed));
  }
  return bounds;
}

double zp_eval_imbalance(const ZpModel *model, const double *a) {
  static const double least_weight = 1e-3; /* N: a lone weightless ribbon still has a scale */
  double largest = 0;
  for (size_t k = 0; k < 2 * model->count; k++)
    if (!(fabs(a[k]) <= largest)) largest = fabs(a[k]);
  return largest * model->pseudo_mass / fmax(model->total_weight, least_weight);
}
