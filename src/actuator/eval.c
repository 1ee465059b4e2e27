/* State => forces. The one place where mechanics, field, drag and weight meet. */
#include "actuator/eval.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"

static size_t carve(const ZpModel *model, ZpEval *e, void *block) {
  ZpCarver carver = {block, 0};
  if (model->is_rod) {
    zp_rod_carve(&model->rod, &e->rod, &carver);
    zp_rod_step_carve(&model->rod, &e->rod_forces, &carver);
    e->edges = (ZpEdges){e->rod.dpx, e->rod.dpy, e->rod.ux, e->rod.uy, e->rod.T, e->rod_forces.Rx, e->rod_forces.Ry};
  } else {
    zp_massspring_carve(&model->spring, &e->spring, &carver);
    e->edges =
        (ZpEdges){e->spring.dpx, e->spring.dpy, e->spring.ux, e->spring.uy, e->spring.T, e->spring.Rx, e->spring.Ry};
  }
  zp_plates_carve(&model->plates, &e->plates, &carver);
  zp_plates_step_carve(&model->plates, &e->attraction, &carver);
  zp_faces_carve(&model->faces, &e->faces, &carver);
  zp_surface_carve(model->nodes, &e->surface, &carver);
  e->none = zp_carve(&carver, model->stride);
  return carver.used;
}

bool zp_eval_create(const ZpModel *model, ZpEval *e) {
  memset(e, 0, sizeof *e);
  e->memory = zp_calloc(1, carve(model, e, NULL));
  if (!e->memory) return false;
  carve(model, e, e->memory);
  return !model->field_solved ||
         zp_surplus_create(&model->cross_section, &model->plates, model->field_scale, &e->surplus);
}

void zp_eval_destroy(ZpEval *e) {
  zp_surplus_destroy(&e->surplus);
  zp_free(e->memory);
  e->memory = NULL;
}

static void mechanics(const ZpModel *model, const double *q, ZpEval *e) {
  if (!model->is_rod) {
    zp_massspring_eval(&model->spring, q, q + model->stride, &e->spring);
    return;
  }
  zp_rod_eval(&model->rod, q, q + model->stride, &e->rod);
  zp_rod_step(&model->rod, &e->rod, &e->rod, 0, &e->rod_forces);
}

void zp_eval_stiffness(const ZpModel *model, const ZpEval *e, const double *tension, double (*D)[4]) {
  if (!model->is_rod) {
    zp_massspring_stiffness(&model->spring, &e->spring, tension, D);
    return;
  }
  zp_rod_stiffness(&model->rod, &e->rod, &e->rod, 0, &e->rod_forces, tension, D);
  for (size_t k = 0; k < 3 * (model->count - model->s); k++)
    for (size_t c = 0; c < 4; c++)
      D[k][c] *= 2; /* both ends move */
}

/* Direction of the closed part where it ends: that of the last closed link, horizontal at the clip. */
static void closed_direction(const ZpModel *model, size_t front, const ZpEdges *edges, double direction[2]) {
  direction[0] = 1;
  direction[1] = 0;
  if (front == 0) return;
  size_t j = model->s * (front - 1);
  double x = edges->ux[j] + edges->ux[j + 1], y = edges->uy[j] + edges->uy[j + 1];
  double length = sqrt(x * x + y * y);
  if (length == 0) return;
  direction[0] = x / length;
  direction[1] = y / length;
}

static void bezier_forces(const ZpModel *model, const ZpState *state, const double *q, ZpEval *e) {
  size_t front = state->zip.front;
  if (front + 1 < model->nodes) zp_surface_prepare(&e->surface, model->nodes - front);
  double direction[2];
  closed_direction(model, front, &e->edges, direction);
  zp_surface_bezier(&model->plates, &e->surface, q, q + model->stride, front, direction, state->U, e->attraction.Fy);
}

/* U^2 F added to the attraction by the plates law. */
static void add_beyond_plates(const ZpModel *model, const double *F, double U, ZpEval *e) {
  for (size_t j = 0; j < model->count; j++) {
    e->attraction.Fx[j] += U * U * F[j];
    e->attraction.Fy[j] += U * U * F[model->stride + j];
  }
}

/* Attraction of the ribbons into e->attraction; 0 where there is none. */
static void electric_forces(const ZpModel *model, const ZpState *state, const double *q, ZpEval *e) {
  const ZpActuatorDef *def = &model->def;
  if (def->electro.surface == ZP_SURFACE_POLYLINE)
    zp_plates_rest(&model->plates, q, q + model->stride, state->U, &e->plates, &e->attraction);
  else if (def->electro.refresh_period > 0)
    memcpy(e->attraction.Fy, state->data + 5 * model->stride, model->stride * sizeof(double));
  else
    bezier_forces(model, state, q, e);
  if (model->field_solved) add_beyond_plates(model, state->data + 4 * model->stride, state->U, e);
}

/* What adds up on the nodes, all [stride]. L and R are the same array, s places apart. */
typedef struct Addends {
  const double *Lx, *Ly, *Rx, *Ry; /* forces of the edges left and right of a node */
  const double *weight;
  const double *Fx, *Fy; /* attraction */
  const double *mx, *my; /* 1 / mass */
  const double *vx, *vy; /* of the drag */
  double c;
} Addends;

static Addends addends(const ZpModel *model, const ZpMasses *masses, const ZpEval *e) {
  size_t s = model->s;
  return (Addends){.Lx = e->edges.Rx - s,
                   .Ly = e->edges.Ry - s,
                   .Rx = e->edges.Rx,
                   .Ry = e->edges.Ry,
                   .weight = model->weight,
                   .Fx = e->attraction.Fx,
                   .Fy = e->attraction.Fy,
                   .mx = masses->x.inverse,
                   .my = masses->y.inverse,
                   .c = model->def.damping.drag};
}

/* The sum of all forces over the mass, eq. (3.9), in two forms: without drag, and with it. */
ZP_KERNEL static void add_forces(size_t stride, const Addends *f, double *restrict ax, double *restrict ay) {
  const double *Lx = f->Lx, *Ly = f->Ly, *Rx = f->Rx, *Ry = f->Ry, *weight = f->weight, *Fx = f->Fx, *Fy = f->Fy,
               *mx = f->mx, *my = f->my;
  ZP_SIMD
  for (size_t j = 0; j < stride; j++) {
    ax[j] = (Lx[j] - Rx[j] + Fx[j]) * mx[j];
    ay[j] = (Ly[j] - Ry[j] + Fy[j] - weight[j]) * my[j];
  }
}

ZP_KERNEL static void add_forces_and_drag(size_t stride, const Addends *f, double *restrict ax, double *restrict ay,
                                          double *power, double *rate) {
  const double *Lx = f->Lx, *Ly = f->Ly, *Rx = f->Rx, *Ry = f->Ry, *weight = f->weight, *Fx = f->Fx, *Fy = f->Fy,
               *mx = f->mx, *my = f->my, *vx = f->vx, *vy = f->vy;
  double c = f->c, lost[ZP_LANES] = {0}, fastest[ZP_LANES] = {0};
  for (size_t block = 0; block < stride; block += ZP_LANES) {
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++) {
      size_t j = block + k;
      double v2 = vx[j] * vx[j] + vy[j] * vy[j], v = sqrt(v2), per_mass = v * my[j];
      ax[j] = (Lx[j] - Rx[j] + Fx[j] - c * v * vx[j]) * mx[j];
      ay[j] = (Ly[j] - Ry[j] + Fy[j] - weight[j] - c * v * vy[j]) * my[j];
      lost[k] += c * v * v2;
      fastest[k] = per_mass > fastest[k] ? per_mass : fastest[k];
    }
  }
  *power = zp_sum_lanes(lost);
  *rate = zp_max_lanes(fastest);
}

void zp_eval_accelerations(const ZpModel *model, const ZpState *state, const double *q, const double *v, ZpEval *e,
                           double *a) {
  size_t stride = model->stride;
  mechanics(model, q, e);
  if (model->field) electric_forces(model, state, q, e);
  Addends forces = addends(model, &model->masses, e);
  forces.vx = v;
  forces.vy = v + stride;
  e->drag_power = e->drag_rate = 0;
  if (forces.c > 0)
    add_forces_and_drag(stride, &forces, a, a + stride, &e->drag_power, &e->drag_rate);
  else
    add_forces(stride, &forces, a, a + stride);
}

void zp_eval_unpowered(const ZpModel *model, const double *q, ZpEval *e, double *a) {
  size_t stride = model->stride;
  mechanics(model, q, e);
  Addends forces = addends(model, &model->pseudo, e);
  forces.Fx = forces.Fy = e->none;
  add_forces(stride, &forces, a, a + stride);
}

bool zp_eval_solve_field(const ZpModel *model, const double *q, double U, ZpEval *e) {
  return !model->field_solved || zp_surplus_solve(&e->surplus, q, U) == ZP_FIELD_SOLVED;
}

void zp_eval_static_forces(const ZpModel *model, const double *q, double U, ZpEval *e, double *force) {
  size_t s = model->s, stride = model->stride;
  const double *Rx = e->edges.Rx, *Ry = e->edges.Ry, *Lx = Rx - s, *Ly = Ry - s;
  mechanics(model, q, e);
  if (model->field) zp_plates_rest(&model->plates, q, q + stride, U, &e->plates, &e->attraction);
  if (model->field_solved) add_beyond_plates(model, e->surplus.F, U, e);
  for (size_t j = 0; j < model->count; j++) {
    force[j] = Lx[j] - Rx[j] + e->attraction.Fx[j];
    force[stride + j] = Ly[j] - Ry[j] + e->attraction.Fy[j] - model->weight[j];
  }
}

void zp_eval_share(const ZpModel *model, const ZpMasses *masses, const ZpZipState *zip, double *a) {
  if (model->s < 2) return;
  zp_zip_share(zip, model->nodes, &masses->x, a);
  zp_zip_share(zip, model->nodes, &masses->y, a + model->stride);
}

/* Has any gap, with what stands for its insulators, changed by more than this share since the last refresh? */
static bool gaps_changed(const ZpModel *model, const ZpState *state, double share) {
  const double *y = state->data + model->stride, *then = state->data + 7 * model->stride;
  for (size_t i = 0; i < model->nodes; i++) {
    double gap = y[2 * i] - y[2 * i + 1], before = then[2 * i] - then[2 * i + 1];
    if (fabs(gap - before) > share * (before + model->plates.d)) return true;
  }
  return false;
}

/* A gap with its insulators stands for no less than where breakdown sets in: has that changed as much? */
static bool cap_changed(const ZpModel *model, const ZpState *state, double share) {
  double d = model->plates.d, before = fmax(d, zp_plates_least_h(&model->plates, state->held_U));
  return fabs(fmax(d, zp_plates_least_h(&model->plates, state->U)) - before) > share * before;
}

bool zp_eval_voltage_outdates(const ZpModel *model, const ZpState *state) {
  if (!model->field_solved) return model->def.electro.refresh_period > 0;
  return isnan(state->refreshed) || cap_changed(model, state, model->def.electro.refresh_change);
}

bool zp_eval_refresh_due(const ZpModel *model, const ZpState *state) {
  const ZpActuatorDef *def = &model->def;
  if (!model->field) return false;
  if (model->field_solved)
    return zp_eval_voltage_outdates(model, state) || gaps_changed(model, state, def->electro.refresh_change);
  return def->electro.refresh_period > 0 && !(state->t - state->refreshed < def->electro.refresh_period);
}

static ZpEnd refresh_beyond_plates(const ZpModel *model, ZpState *state, const double *q, ZpEval *e) {
  size_t bytes = 2 * model->stride * sizeof(double);
  if (!zp_eval_solve_field(model, q, state->U, e)) return ZP_END_STOP;
  state->refreshed = state->t;
  memcpy(zp_state_held(model, state), e->surplus.F, bytes);
  memcpy(zp_state_held_at(model, state), q, bytes);
  state->held_U = state->U;
  state->held_energy = e->surplus.energy;
  state->held_charge = e->surplus.charge;
  state->held_capacitance = e->surplus.capacitance;
  return ZP_END_FOUND;
}

ZpEnd zp_eval_refresh(const ZpModel *model, ZpState *state, ZpEval *e) {
  double *q = zp_state_q(model, state);
  if (model->field_solved) return refresh_beyond_plates(model, state, q, e);
  state->refreshed = state->t;
  mechanics(model, q, e);
  bezier_forces(model, state, q, e);
  memcpy(zp_state_held(model, state) + model->stride, e->attraction.Fy, model->stride * sizeof(double));
  return ZP_END_FOUND;
}

static double ratio_bound(double length, double speed) {
  return speed > 0 ? 2 * length / speed : INFINITY;
}

ZpStepBounds zp_eval_step_bounds(const ZpModel *model, const ZpState *state, const ZpEval *e) {
  ZpMotion motion = zp_state_motion(model, state);
  ZpStepBounds bounds = {INFINITY, INFINITY, INFINITY};
  size_t s = model->s, count = model->count;
  const ZpEdges *edges = &e->edges;
  double c = model->def.damping.drag;
  const double *bx = edges->ux - s, *by = edges->uy - s;
  for (size_t j = 0; j < count; j++) {
    double vx = motion.vx[j], vy = motion.vy[j], speed = sqrt(vx * vx + vy * vy);
    bounds.drag = fmin(bounds.drag, ratio_bound(model->mass[j], c * speed));
    if (j + s >= count) continue;
    double dx = edges->dpx[j], dy = edges->dpy[j], shear = fabs(bx[j] * dy - by[j] * dx);
    bounds.axial = fmin(bounds.axial, ratio_bound(sqrt(dx * dx + dy * dy), speed));
    bounds.shear = fmin(bounds.shear, ratio_bound(shear, speed));
  }
  return bounds;
}

double zp_eval_weight_scale(const ZpModel *model) {
  static const double least_weight = 1e-3; /* N */
  return fmax(model->total_weight, least_weight);
}

double zp_eval_imbalance(const ZpModel *model, const double *a) {
  double largest = 0;
  for (size_t k = 0; k < 2 * model->stride; k++)
    if (!(fabs(a[k]) <= largest)) largest = fabs(a[k]);
  return largest * model->pseudo_mass / zp_eval_weight_scale(model);
}
