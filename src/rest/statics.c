#include "rest/statics.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "actuator/resolution.h"
#include "base/kernel.h"
#include "def/check.h"
#include "def/tolerance.h"
#include "math/elementary.h"
#include "rest/crossing.h"
#include "solve/descend.h"

static size_t carve(const ZpModel *model, ZpStatics *s, void *block) {
  size_t stride = model->stride;
  ZpCarver carver = {block, 0};
  s->q = zp_carve(&carver, 2 * stride);
  s->moved = zp_carve(&carver, 2 * stride);
  s->force = zp_carve(&carver, 2 * stride);
  s->good = zp_carve(&carver, 2 * stride);
  s->tension = zp_carve(&carver, stride);
  s->k0_now = zp_carve(&carver, stride);
  s->rotation = zp_carve(&carver, stride);
  s->stretch = zp_carve(&carver, stride);
  s->model = (const ZpModel *)(void *)zp_carve(&carver, (sizeof *model + sizeof(double) - 1) / sizeof(double));
  return carver.used;
}

static void fill_model(const ZpModel *model, ZpStatics *s) {
  ZpModel *own = (ZpModel *)s->model;
  *own = *model;
  own->rod.k0 = s->k0_now;
  s->k0 = model->rod.k0;
}

static bool is_held(const ZpStatics *s) {
  return !isnan(s->opening);
}

/* Apply this share of weight and natural curvature. */
static void put_on(ZpStatics *s, double share) {
  s->share = share;
  for (size_t j = 0; j < s->model->stride; j++)
    s->k0_now[j] = share * s->k0[j];
}

static void lay_straight(ZpStatics *s) {
  const ZpModel *model = s->model;
  memset(s->q, 0, 2 * model->stride * sizeof *s->q);
  memset(s->tension, 0, model->stride * sizeof *s->tension);
  for (size_t j = 0; j < model->stride; j++)
    s->q[j] = zp_straight_x(model, j / model->s);
}

bool zp_statics_create(const ZpModel *model, ZpStatics *s) {
  memset(s, 0, sizeof *s);
  s->memory = zp_calloc(1, carve(model, s, NULL));
  if (s->memory) carve(model, s, s->memory);
  if (s->memory) fill_model(model, s);
  if (!s->memory || !zp_system_create(s->model, true, &s->eval) ||
      !zp_assembly_create(s->model, 0, model->is_rod, &s->assembly)) {
    zp_statics_destroy(s);
    return false;
  }
  s->form = (ZpBandForm){s->assembly.bandwidth, s->assembly.symmetric, zp_bead_rank(model), s->assembly.groups};
  s->scale = zp_eval_weight_scale(model);
  s->load = model->def.load.mass;
  put_on(s, 1);
  s->opening = NAN;
  lay_straight(s);
  return true;
}

void zp_statics_destroy(ZpStatics *s) {
  zp_system_destroy(&s->eval);
  zp_assembly_destroy(&s->assembly);
  zp_free(s->memory);
  s->memory = NULL;
}

double zp_statics_tolerance(const ZpStatics *s) {
  const ZpModel *model = s->model;
  return fmax(zp_tolerance_at_rest(&model->def), 4 * DBL_EPSILON * model->L * model->axial_stiffness / s->scale);
}

enum { MOST_ITERATIONS = 50, STEP_ITERATIONS = 30 };

/* Start from the straight shape and let the load that `put` sets grow to `whole`, first by the share `step`, if the
 * equilibrium is too far away for one step. A load 1e5 times the one that bends a ribbon by its length needs so small a
 * first share. */
static ZpNewtonInfo step_by_step(ZpStatics *s, void (*put)(ZpStatics *, double), double whole, double step,
                                 ZpNewtonWork *work) {
  static const double shortest = 1e-8;
  ZpStaticSystem system = zp_statics_system(s);
  size_t bytes = 2 * s->model->stride * sizeof *s->q;
  double reached = 0;
  ZpNewtonInfo info = {ZP_NEWTON_SLOW, 0, INFINITY};
  int iterations = 0;
  lay_straight(s);
  memcpy(s->good, s->q, bytes);
  while (reached < 1 && step > shortest) {
    double share = fmin(reached + step, 1);
    put(s, share * whole);
    info = zp_newton(&system, zp_statics_tolerance(s), STEP_ITERATIONS, work);
    iterations += info.iterations;
    if (zp_newton_good(info.end)) {
      reached = share;
      step *= 2;
      memcpy(s->good, s->q, bytes);
    } else {
      memcpy(s->q, s->good, bytes);
      memset(s->tension, 0, s->model->stride * sizeof *s->tension);
      step *= 0.25;
    }
  }
  put(s, whole);
  info.iterations = iterations;
  if (reached < 1) info.end = ZP_NEWTON_SLOW;
  return info;
}

/* Has any gap, insulators included, changed since the last good state by so large a share that this is another
 * branch? */
static bool has_jumped(const ZpStatics *s) {
  static const double jump = 0.25;
  const ZpModel *model = s->model;
  const double *y = s->good + model->stride;
  for (size_t i = 0; i < model->nodes; i++) {
    double before = zp_plates_gap(&model->plates, y, i);
    if (!(fabs(s->eval.plates.gap[i] - before) < jump * (fabs(before) + model->plates.d))) return true;
  }
  return false;
}

/* Back to the last good state. */
static void go_back(ZpStatics *s, ZpNewtonWork *work) {
  ZpStaticSystem system = zp_statics_system(s);
  memcpy(s->q, s->good, 2 * s->model->stride * sizeof *s->q);
  system.residual(s, work->r, NULL);
  memcpy(s->tension, s->eval.edges.T, (s->model->count - s->model->s) * sizeof *s->tension);
}

/* Follow the branch from a stable equilibrium while `put(whole, share)` increases a load, in shares of at most
 * `longest`, to 1. False if the branch ends before; the present point is then its last equilibrium. */
static bool grow(ZpStatics *s, void (*put)(ZpStatics *, double, double), double whole, double longest,
                 ZpNewtonWork *work) {
  static const double shortest = 1e-6;
  ZpStaticSystem system = zp_statics_system(s);
  size_t bytes = 2 * s->model->stride * sizeof *s->q;
  double reached = 0, step = longest;
  memcpy(s->good, s->q, bytes);
  while (reached < 1 && step > shortest) {
    double share = fmin(reached + step, 1);
    put(s, whole, share);
    ZpNewtonEnd end = zp_newton(&system, zp_statics_tolerance(s), MOST_ITERATIONS, work).end;
    if (zp_newton_good(end) && zp_statics_stable(s, work) && !has_jumped(s)) {
      reached = share;
      step = fmin(2 * step, longest);
      memcpy(s->good, s->q, bytes);
    } else {
      go_back(s, work);
      step *= 0.5;
    }
  }
  return reached == 1;
}

/* Shares of the square of the voltage, to which the force is proportional. */
static void put_voltage(ZpStatics *s, double whole, double share) {
  s->U = whole * sqrt(share);
}

static void put_suction(ZpStatics *s, double whole, double share) {
  ((ZpModel *)s->model)->bead.suction = whole * share;
}

/* Continue from the equilibrium without suction at the menisci to the one with it. Where that branch ends, suction
 * draws the faces together. */
static ZpNewtonInfo let_menisci_draw(ZpStatics *s, double suction, ZpNewtonInfo info, ZpNewtonWork *work) {
  bool grown = zp_newton_good(info.end) && suction > 0 && grow(s, put_suction, suction, 1, work);
  put_suction(s, suction, 1);
  return grown || suction == 0 || !zp_newton_good(info.end) ? info : zp_statics_fall(s, 0, work);
}

/* Has Newton's method found an equilibrium without folded ribbons? Its last stiffness tells, or that of the equilibrium
 * itself. */
static bool is_found(ZpStatics *s, ZpNewtonInfo info, ZpNewtonWork *work) {
  if (!zp_newton_good(info.end)) return false;
  return info.iterations == 0 || zp_band_negative(&work->K) == 0 || zp_statics_stable(s, work);
}

/* Continue from the equilibrium without contact to the one with contact, if there are faces. If the faces have passed
 * through each other on the way, weight presses them together: they then lie on each other from the straight shape on,
 * unless the platform is held open. */
static ZpNewtonInfo let_faces_push(ZpStatics *s, ZpNewtonInfo info, ZpNewtonWork *work) {
  s->contact_acts = true;
  if (!zp_newton_good(info.end) || !s->model->field) return info;
  ZpStaticSystem system = zp_statics_system(s);
  memcpy(s->good, s->q, 2 * s->model->stride * sizeof *s->q);
  ZpNewtonInfo contact = zp_newton(&system, zp_statics_tolerance(s), MOST_ITERATIONS, work);
  if (!is_found(s, contact, work) || zp_statics_fault(s)) {
    memcpy(s->q, s->good, 2 * s->model->stride * sizeof *s->q);
    if (is_held(s))
      contact = zp_statics_fall(s, 0, work);
    else
      contact = zp_statics_close(s, 0, work);
  }
  contact.iterations += info.iterations;
  return contact;
}

ZpNewtonInfo zp_statics_hang(ZpStatics *s, ZpNewtonWork *work) {
  ZpStaticSystem system = zp_statics_system(s);
  double suction = s->model->bead.suction;
  s->U = 0;
  s->contact_acts = false;
  put_suction(s, 0, 1);
  ZpNewtonInfo info = zp_newton(&system, zp_statics_tolerance(s), MOST_ITERATIONS, work);
  if (!is_found(s, info, work)) info = step_by_step(s, put_on, 1, 0.01, work);
  if (s->model->is_rod && !is_found(s, info, work)) info = zp_statics_fall(s, 0, work); /* limp springs relax */
  info = let_faces_push(s, info, work);
  info = let_menisci_draw(s, suction, info, work);
  if (zp_newton_good(info.end) && zp_statics_fault(s)) info.end = ZP_NEWTON_REFUSED;
  return info;
}

static void open_to(ZpStatics *s, double opening) {
  s->opening = opening;
}

/* The same while weight is applied too: ribbons that sag by more than the opening have no straight shape to start
 * from. */
static void open_and_put_on(ZpStatics *s, double opening) {
  s->opening = opening;
  put_on(s, opening / s->held_at);
}

ZpNewtonInfo zp_statics_hold(ZpStatics *s, double opening, ZpNewtonWork *work) {
  ZpStaticSystem system = zp_statics_system(s);
  double suction = s->model->bead.suction;
  s->U = 0;
  s->load = 0;
  s->opening = s->held_at = opening;
  s->contact_acts = false;
  put_suction(s, 0, 1);
  lay_straight(s);
  ZpNewtonInfo info = zp_newton(&system, zp_statics_tolerance(s), MOST_ITERATIONS, work);
  if (!is_found(s, info, work)) info = step_by_step(s, open_to, opening, 0.05, work);
  if (!is_found(s, info, work)) info = step_by_step(s, open_and_put_on, opening, 0.01, work);
  info = let_faces_push(s, info, work);
  return let_menisci_draw(s, suction, info, work);
}

bool zp_statics_raise(ZpStatics *s, double voltage, ZpNewtonWork *work) {
  return grow(s, put_voltage, voltage, 0.05, work) && !zp_statics_fault(s);
}

ZpNewtonInfo zp_statics_close(ZpStatics *s, double voltage, ZpNewtonWork *work) {
  ZpStaticSystem system = zp_statics_system(s);
  lay_straight(s);
  s->U = voltage;
  s->contact_acts = true;
  ZpNewtonInfo info = zp_newton(&system, zp_statics_tolerance(s), MOST_ITERATIONS, work);
  if (zp_newton_good(info.end) && zp_statics_stable(s, work)) return info;
  lay_straight(s);
  return zp_statics_fall(s, voltage, work);
}

double zp_statics_stroke(const ZpStatics *s) {
  return zp_stroke(&s->model->topology, s->q + s->model->stride);
}

double zp_statics_opening(const ZpStatics *s) {
  return zp_opening(&s->model->topology, s->q + s->model->stride);
}

double zp_statics_angle(const ZpStatics *s) {
  return zp_topology_angle(&s->model->topology, s->q, s->q + s->model->stride);
}

size_t zp_statics_front(const ZpStatics *s) {
  return s->model->field ? zp_faces_front(&s->model->faces, s->eval.plates.gap) : 0;
}

bool zp_statics_shorted(const ZpStatics *s) {
  const ZpModel *model = s->model;
  if (s->U == 0 || !model->field || zp_insulation(&model->def) > 0) return false;
  return zp_plates_least_gap(&model->plates, s->q + model->stride) < s->model->faces.depth;
}

const char *zp_statics_trouble(const ZpStatics *s) {
  return s->eval.fault;
}

static ZpElectric totals(const ZpStatics *s) {
  ZpSpan here = zp_span_at(s->q);
  here.beyond = zp_eval_beyond(&s->eval);
  return zp_system_electric(s->model, &here, &s->eval, ZP_SPAN_END, s->U);
}

double zp_statics_charge(const ZpStatics *s) {
  return s->model->parts * totals(s).charge;
}

double zp_statics_capacitance(const ZpStatics *s) {
  return s->model->parts * totals(s).capacitance;
}

/* Capacitance of closed faces, whole actuator, F. */
static double closed_capacitance(const ZpStatics *s) {
  const ZpActuatorDef *def = &s->model->def;
  double per_length =
      zp_plates_inverse_gap(&s->model->plates, 0) * ZP_EPS0 * def->medium.permittivity * def->ribbon.width;
  return per_length * zp_faces_length(s->model);
}

/* Force per length of faces, N/m, with which a load that falls upwards presses those of the platform together, or the
 * edge of a free end onto the other face. */
static double pressed_by_load(const ZpModel *model) {
  const ZpFacesParams *faces = &model->faces;
  double beside = zp_ends_free(&model->topology) ? 0 : 0.5 * faces->l;
  return zp_load_pull(model) < 0 ? model->total_weight / (faces->flat_length + beside) : 0;
}

/* The largest overlap that a state may have, m. By (9.1) the attraction at the breakdown of the insulators causes the
 * contact depth, and a stronger attraction or a load causes more. At a front the bent ribbons press on closed faces
 * like a lever. */
static double deepest_overlap(const ZpStatics *s) {
  static const double ranges = 2, of_insulators = 0.02, lever = 3;
  const ZpFacesParams *faces = &s->model->faces;
  double attraction = zp_plates_law(&s->model->plates, s->U, 0).W;
  double pull = (attraction + pressed_by_load(s->model)) / faces->push;
  double balanced = faces->depth * zp_cube_root(fmax(pull, 1));
  return fmax(fmax(ranges * faces->range, of_insulators * zp_insulation(&s->model->def)), lever * balanced);
}

/* Ribbons that slide along each other by a little are not parted by it, because the gap is that of heights. */
static double deepest_crossing(const ZpStatics *s) {
  static const double of_insulators = 0.5;
  return fmax(deepest_overlap(s), of_insulators * zp_insulation(&s->model->def));
}

const char *zp_statics_fault_of_stations(const ZpStatics *s) {
  static const double beyond_plates = 1.1; /* fields around the ends add less to plates */
  if (!s->model->field) return NULL;
  double least = INFINITY, most = deepest_overlap(s), capacitance = zp_statics_capacitance(s);
  for (size_t i = 0; i < s->model->nodes; i++)
    least = fmin(least, s->eval.plates.gap[i]);
  if (s->contact_acts && least < -most) return "the insulators' faces overlap";
  if (capacitance < 0) return "the capacitance is negative";
  if (capacitance > beyond_plates * closed_capacitance(s)) return "the capacitance is above that of closed faces";
  return NULL;
}

const char *zp_statics_fault(const ZpStatics *s) {
  bool apart = s->model->field && s->contact_acts; /* as contact wants them */
  if (apart && zp_crossing_depth(s->model, s->q) > deepest_crossing(s)) return "the faces cross each other";
  return zp_statics_fault_of_stations(s);
}

ZpShape zp_statics_shape(const ZpStatics *s, double time, const ZpShapeRoom *room) {
  ZpShape shape = {
      .time = time, .voltage = s->U, .zipped = zp_statics_front(s), .x = s->q, .y = s->q + s->model->stride};
  ZpShapeRoom here = *room;
  for (int half = 0; s->model->has_bead && half < zp_beads(&s->model->film); half++)
    here.reach[half] = s->eval.reach[half];
  if (s->model->field) shape.gap = s->eval.plates.gap;
  zp_shape_fill(s->model, &here, &shape);
  return shape;
}

/* -- the held platform ---------------------------------------------------------------------------- */

/* The equation of a held platform replaces its balance of forces: the platform is where it is held. A step moves it
 * there while the edges rotate, so there is no closing error to spread along the ribbons. */

size_t zp_statics_platform(const ZpStatics *s) {
  return (size_t)s->assembly.equation[2 * zp_load_node(&s->model->topology) + 1];
}

/* The equation has the form of a force, so that the tolerance of forces applies: a stiffness, of each half, times the
 * remaining distance. */
static double holding(const ZpStatics *s) {
  static const double soft = 1e-3; /* of the stiffest, so that the rounding of y does not count */
  const ZpModel *model = s->model;
  return soft * (double)model->topology.halves * model->axial_stiffness;
}

static void hold_platform(ZpStatics *s, double *r) {
  size_t row = zp_statics_platform(s);
  s->reaction = r[row];
  r[row] = holding(s) * (zp_drop(&s->model->topology, s->q + s->model->stride) - s->opening);
}

/* The same for the terms on top of the band. */
static void hold_top(ZpBand *K, size_t row, double move, double *r) {
  size_t n = K->n;
  for (size_t k = 0; k < K->rank; k++) {
    double *u = K->u + k * n, *v = K->v + k * n;
    u[row] = 0;
    for (size_t i = 0; r && i < n; i++)
      r[i] -= u[i] * v[row] * move;
    v[row] = 0;
  }
}

/* Its row and column are cleared, once the effect of its motion on the forces of the others is in r. */
static void hold_equation(const ZpStatics *s, ZpBand *K, double *r) {
  size_t row = zp_statics_platform(s), end = zp_band_end(K, row);
  double move = r ? r[row] / holding(s) : 0;
  hold_top(K, row, move, r);
  for (size_t i = row > K->upper ? row - K->upper : 0; i < end; i++) {
    if (i == row || zp_band_end(K, i) <= row) continue;
    bool kept = K->lower > 0 || i < row; /* only the upper triangle of a symmetric matrix is stored */
    double *in_column = kept ? zp_band_at(K, i, row) : zp_band_at(K, row, i);
    if (r) r[i] -= *in_column * move;
    *in_column = 0;
    if (K->lower > 0) *zp_band_at(K, row, i) = 0;
  }
  *zp_band_at(K, row, row) = holding(s);
}

/* -- residual ------------------------------------------------------------------------------------- */

/* The present point. */
static ZpSpan span_of(const ZpStatics *s) {
  const ZpActuatorDef *def = &s->model->def;
  ZpSpan span = zp_span_at(s->q);
  span.U0 = span.U1 = s->U;
  span.hung = zp_load_share(s->model) * (s->load - def->load.mass) * def->gravity;
  span.share = s->share;
  span.faces_pass = !s->contact_acts;
  span.beyond = zp_eval_beyond(&s->eval);
  span.tension = s->tension;
  return span;
}

/* Multiply the forces r on coordinates that both halves share by a factor. */
static void scale_common(const ZpParts *parts, double factor, double *r) {
  for (size_t k = 0; k < parts->count; k++)
    r[parts->common[k]] *= factor;
}

/* The largest residual force on one half, N; NAN if any is NAN. */
static double largest_of(const ZpAssembly *a, double *r) {
  double largest = 0, halves = (double)(1 + a->parts.more);
  scale_common(&a->parts, 1 / halves, r);
  for (size_t i = 0; i < a->n && !isnan(largest); i++)
    if (!(fabs(r[i]) <= largest)) largest = fabs(r[i]);
  scale_common(&a->parts, halves, r);
  return largest;
}

bool zp_statics_asked_to_stop(ZpStatics *s) {
  s->unasked = 0;
  s->stopped = s->stopped || (s->stop && s->stop(s->caller));
  return s->stopped;
}

static ZpEnd residual(void *self, double *r, double *size) {
  enum { BETWEEN = 64 }; /* residuals between two calls of `stop`: about a millisecond */
  ZpStatics *s = self;
  if (s->stopped || (++s->unasked >= BETWEEN && zp_statics_asked_to_stop(s))) return ZP_END_STOP;
  ZpSpan here = span_of(s);
  zp_system_force(s->model, &here, &s->eval, s->force);
  zp_assembly_sum(&s->assembly, s->force, r);
  if (is_held(s)) hold_platform(s, r);
  double largest = largest_of(&s->assembly, r);
  if (size) *size = largest / s->scale;
  return isfinite(largest) ? ZP_END_FOUND : ZP_END_SHORTER;
}

/* -- stiffness ------------------------------------------------------------------------------------ */

static void stiffness(void *self, ZpBand *K, double *r) {
  ZpStatics *s = self;
  ZpSpan here = span_of(s);
  zp_system_stiffness(s->model, &here, &s->assembly, &s->eval, K);
  if (is_held(s)) hold_equation(s, K, r);
}

/* The exact stiffness is that with the tensions of the present point. */
static void exact_residual(ZpStatics *s, double *r) {
  residual(s, r, NULL);
  memcpy(s->tension, s->eval.edges.T, (s->model->count - s->model->s) * sizeof *s->tension);
}

/* Decrease of the force on the platform in a step, as if it were free. */
static double fall_along(ZpStatics *s, const double *step, ZpBand *K) {
  double opening = s->opening;
  s->opening = NAN;
  stiffness(s, K, NULL);
  s->opening = opening;
  zp_band_multiply(K, step, s->force);
  return s->force[zp_statics_platform(s)];
}

double zp_statics_holding(ZpStatics *s, ZpNewtonWork *work) {
  exact_residual(s, work->r);
  stiffness(s, &work->K, work->r);
  if (!zp_band_factor(&work->K)) return s->reaction;
  zp_band_solve(&work->K, work->r);
  return s->reaction - fall_along(s, work->r, &work->K);
}

double zp_statics_stiffness_along(ZpStatics *s, const double *u, ZpBand *K, double *r) {
  residual(s, r, NULL);
  stiffness(s, K, NULL);
  double sum = zp_edges_along(&s->assembly, (const double(*)[4])s->eval.D, u);
  ZpSpan here = span_of(s);
  zp_system_stiffness_beside_edges(s->model, &here, &s->assembly, &s->eval, K);
  zp_band_multiply(K, u, r);
  for (size_t i = 0; i < s->assembly.n; i++)
    sum += u[i] * r[i];
  return sum;
}

/* -- moving --------------------------------------------------------------------------------------- */

static double part(const ZpStatics *s, const double *step, size_t k) {
  return s->assembly.equation[k] >= 0 ? step[s->assembly.equation[k]] : 0;
}

ZP_KERNEL static void edges_under_step(size_t edges, size_t ribbons, const double *restrict dx,
                                       const double *restrict dy, const ZpEdges *e, double *restrict rotation,
                                       double *restrict stretch) {
  const double *restrict x = e->dpx, *restrict y = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy;
  const double *restrict to_dx = dx + ribbons, *restrict to_dy = dy + ribbons;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double by_x = to_dx[j] - dx[j], by_y = to_dy[j] - dy[j], length = x[j] * ux[j] + y[j] * uy[j];
    rotation[j] = (ux[j] * by_y - uy[j] * by_x) / length;
    stretch[j] = ux[j] * by_x + uy[j] * by_y;
  }
}

static size_t edge_count(const ZpStatics *s) {
  return s->model->count - s->model->s;
}

/* Rotation and stretch of all edges under a step => s. */
static void turn(ZpStatics *s, const double *step) {
  const int *equation = s->assembly.equation;
  double *dx = s->moved, *dy = dx + s->model->stride;
  for (size_t j = 0; j < s->model->count; j++) {
    int x = equation[2 * j], y = equation[2 * j + 1];
    dx[j] = x >= 0 ? step[x] : 0;
    dy[j] = y >= 0 ? step[y] : 0;
  }
  edges_under_step(edge_count(s), s->model->s, dx, dy, &s->eval.edges, s->rotation, s->stretch);
}

/* The largest rotation of an edge in a step, rad; NAN if any is NAN. */
static double largest_rotation(ZpStatics *s, const double *step) {
  double most = 0;
  turn(s, step);
  for (size_t j = 0; j < edge_count(s) && !isnan(most); j++)
    if (!(fabs(s->rotation[j]) <= most)) most = fabs(s->rotation[j]);
  return most;
}

static double length(void *self, const double *step) {
  static const double longest = 0.5; /* rad, up to which linearised rotations are valid */
  return largest_rotation(self, step) / longest;
}

/* The largest relative change of a gap, insulators included, in a step. */
static double gap_share(const ZpStatics *s, const double *step) {
  const ZpModel *model = s->model;
  const ZpPlatesParams *p = &model->plates;
  const ZpTopology *t = &model->topology;
  double most = 0, least_h = zp_plates_least_h(p, s->U);
  for (size_t i = 0; i < model->nodes; i++) {
    double upper = zp_is_pair(t) ? part(s, step, 2 * zp_upper(t, i) + 1) : 0;
    double dy = part(s, step, 2 * zp_lower(t, i) + 1) - upper;
    most = fmax(most, fabs(dy) / fmax(s->eval.plates.gap[i] + p->d, least_h));
  }
  return most;
}

/* The largest rotation of an edge, rad, and, under a voltage, the largest relative change of a gap, insulators
 * included. */
static double change(void *self, const double *step) {
  ZpStatics *s = self;
  const ZpModel *model = s->model;
  double most = largest_rotation(s, step);
  if (model->field && s->U != 0) most = fmax(most, gap_share(s, step));
  return most / zp_tolerance_at_rest(&model->def);
}

/* The axial stiffness of edge j is S[j], or `all` if S is NULL. => edge vectors in place of the displacements of their
 * nodes, and tensions */
ZP_KERNEL static void edges_turned(size_t edges, double fraction, const double *restrict S, double all,
                                   const ZpEdges *e, const double *restrict rotation, const double *restrict stretch,
                                   double *restrict tension, double *restrict to_x, double *restrict to_y) {
  const double *restrict x = e->dpx, *restrict y = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy,
                         *restrict T = e->T;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double axial = S ? S[j] : all, turned = fraction * rotation[j];
    tension[j] = T[j] + fraction * axial * stretch[j];
    double tx = ux[j] - turned * uy[j], ty = uy[j] + turned * ux[j];
    double l = (x[j] * ux[j] + y[j] * uy[j] + fraction * stretch[j]) / sqrt(tx * tx + ty * ty);
    to_x[j] = l * tx;
    to_y[j] = l * ty;
  }
}

/* Rotate and stretch each edge instead of moving its ends along straight lines. So a rotation does not stretch the
 * ribbon, whose axial stiffness is a million times its bending stiffness. The next stiffness uses the tensions that the
 * step predicts. Those of the rebuilt edges have an error of the square of the rotation times that million. => edge
 * vectors in s->moved. */
static void turn_edges(ZpStatics *s, const double *step, double fraction) {
  const ZpModel *model = s->model;
  turn(s, step);
  edges_turned(edge_count(s), fraction, model->is_rod ? model->rod.S : NULL, model->spring.K_D, &s->eval.edges,
               s->rotation, s->stretch, s->tension, s->moved, s->moved + model->stride);
}

/* Place the nodes from..to of one ribbon, to the right or to the left, at the ends of edges `d`, which point to the
 * right from their left nodes. */
static void lay(const double *d, size_t s, size_t from, size_t to, double *q) {
  for (size_t j = from; j < to; j += s)
    q[j + s] = q[j] + d[j];
  for (size_t j = from; j > to; j -= s)
    q[j - s] = q[j] - d[j - s];
}

/* Lay two ribbons from their hinge. */
static void lay_fold(ZpStatics *s) {
  const ZpModel *model = s->model;
  for (size_t c = 0; c < 2; c++)
    for (size_t ribbon = 0; ribbon < model->s; ribbon++)
      lay(s->moved + c * model->stride, model->s, ribbon, model->count - model->s + ribbon, s->q + c * model->stride);
}

/* Place one ribbon from its clamp; the closing error at a clamped right end is spread along it. */
static void lay_one(ZpStatics *s) {
  size_t stride = s->model->stride, end = s->model->count - 1;
  for (size_t c = 0; c < 2; c++) {
    double *q = s->q + c * stride, last = q[end];
    lay(s->moved + c * stride, 1, 0, end, q);
    if (s->assembly.equation[2 * end + c] >= 0) continue;
    double missed = q[end] - last;
    for (size_t j = 1; j <= end; j++)
      q[j] -= missed * (double)j / (double)end;
  }
}

/* Stations of a half. Its upper ribbon is placed from the platform to the clip, the lower one from there back. */
typedef struct Loop {
  size_t platform, clip;
  bool is_held; /* the clip */
} Loop;

static Loop loop_to(const ZpTopology *t, size_t platform, size_t clip) {
  return (Loop){platform, clip, zp_topology_is_held(t, 2 * zp_upper(t, clip))};
}

/* The station `k` elements from the platform. */
static size_t station_of(Loop loop, size_t k) {
  return loop.clip < loop.platform ? loop.platform - k : loop.platform + k;
}

/* The closing error at a clip that is held is spread along the upper ribbon. */
static void spread_to_clip(const ZpTopology *t, Loop loop, double missed, double *q) {
  size_t elements = zp_half_elements(t);
  for (size_t k = 0; k <= elements; k++)
    q[zp_upper(t, station_of(loop, k))] -= missed * ((double)k / (double)elements);
}

static void lay_loop(const ZpTopology *t, Loop loop, const double *d, double *q) {
  size_t clip = zp_upper(t, loop.clip);
  double place = q[clip];
  lay(d, t->ribbons, zp_upper(t, loop.platform), clip, q);
  if (loop.is_held) spread_to_clip(t, loop, q[clip] - place, q);
  q[zp_lower(t, loop.clip)] = q[clip];
  lay(d, t->ribbons, zp_lower(t, loop.clip), zp_lower(t, loop.platform), q);
}

/* The closing error at the lower platform is spread along the loop, or along the lower ribbon alone if the clip is
 * held. */
static void spread(const ZpTopology *t, Loop loop, double missed, double *q) {
  size_t elements = zp_half_elements(t), path = loop.is_held ? elements : 2 * elements;
  for (size_t k = 0; k <= elements; k++) {
    size_t i = station_of(loop, k);
    if (!loop.is_held) q[zp_upper(t, i)] -= missed * ((double)k / (double)path);
    q[zp_lower(t, i)] -= missed * ((double)(path - k) / (double)path);
  }
}

/* A platform that turns is placed by its edge; half of the closing error is spread along each loop. */
static void lay_platform(ZpStatics *s, const Loop loops[2]) {
  const ZpTopology *t = &s->model->topology;
  size_t left = zp_lower(t, t->platform.first), right = zp_lower(t, t->platform.last);
  for (size_t c = 0; c < 2; c++) {
    double *q = s->q + c * s->model->stride, missed = q[right] - q[left] - s->moved[c * s->model->stride + left];
    spread(t, loops[0], -0.5 * missed, q);
    spread(t, loops[1], 0.5 * missed, q);
  }
}

/* A platform that does not turn keeps its x and, where two halves meet there, gets the mean of their y. */
static void lay_level_platform(ZpStatics *s, const Loop loops[2]) {
  const ZpTopology *t = &s->model->topology;
  double *x = s->q, *y = x + s->model->stride, sum = 0;
  for (size_t h = 0; h < t->halves; h++) {
    size_t upper = zp_upper(t, loops[h].platform), lower = zp_lower(t, loops[h].platform);
    spread(t, loops[h], x[lower] - x[upper], x);
    sum += y[lower];
  }
  double mean = sum / (double)t->halves;
  for (size_t h = 0; t->halves > 1 && h < t->halves; h++)
    spread(t, loops[h], y[zp_lower(t, loops[h].platform)] - mean, y);
}

/* Place two ribbons, from the upper platform on. */
static void lay_two(ZpStatics *s) {
  const ZpTopology *t = &s->model->topology;
  const Loop loops[2] = {loop_to(t, t->platform.first, 0), loop_to(t, t->platform.last, t->stations - 1)};
  for (size_t h = 0; h < t->halves; h++)
    for (size_t c = 0; c < 2; c++)
      lay_loop(t, loops[h], s->moved + c * s->model->stride, s->q + c * s->model->stride);
  if (zp_platform_turns(t))
    lay_platform(s, loops);
  else
    lay_level_platform(s, loops);
}

void zp_statics_put_platform(ZpStatics *s, double height) {
  const ZpTopology *t = &s->model->topology;
  double *y = s->q + s->model->stride;
  spread(t, loop_to(t, t->platform.first, 0), y[zp_load_node(t)] - height, y);
}

static void move(void *self, const double *step, double fraction) {
  ZpStatics *s = self;
  turn_edges(s, step, fraction);
  if (zp_is_hinge(&s->model->topology))
    lay_fold(s);
  else if (zp_is_pair(&s->model->topology))
    lay_two(s);
  else
    lay_one(s);
}

/* Where the liquid is at these positions, for the field that is solved there. */
static void lay_bead(ZpStatics *s) {
  const ZpModel *model = s->model;
  if (!model->has_bead) return;
  zp_plates_gaps(&model->plates, s->q, s->q + model->stride, &s->eval.plates);
  zp_eval_reach(model, s->eval.plates.gap, NULL, s->eval.reach);
  zp_eval_cover(model, s->eval.reach, &s->eval);
}

static ZpEnd refresh(void *self) {
  ZpStatics *s = self;
  if (s->U != 0) lay_bead(s);
  bool solved = s->U == 0 || zp_system_solve(s->model, s->q, s->U, &s->eval);
  return solved ? ZP_END_FOUND : ZP_END_SHORTER;
}

ZpStaticSystem zp_statics_system(ZpStatics *s) {
  return (ZpStaticSystem){.n = s->assembly.n,
                          .parts = s->assembly.parts,
                          .self = s,
                          .residual = residual,
                          .stiffness = stiffness,
                          .length = length,
                          .change = change,
                          .move = move,
                          .refresh = s->model->field_solved ? refresh : NULL};
}

/* -- falling -------------------------------------------------------------------------------------- */

/* Limits of a step of motion with resistance: it must not pass over a nearby state, nor move faces through each
 * other. */
static double fall_length(void *self, const double *step) {
  static const double longest = 0.04, share = 0.25; /* 20 mrad; of a gap with its insulators */
  const ZpStatics *s = self;
  bool meets = s->model->field && (s->U != 0 || s->contact_acts);
  return s->careful * fmax(length(self, step) / longest, meets ? gap_share(s, step) / share : 0);
}

/* A mesh with few elements on the zip front may hold it between any two nodes, which a long step passes over. */
static double care(const ZpStatics *s) {
  static const double few = 3, shorter = 4;
  return zp_front_length(s->model, s->U) < few * s->model->l ? shorter : 1;
}

ZpNewtonInfo zp_statics_fall_until(ZpStatics *s, bool (*enough)(void *user), void *user, ZpNewtonWork *work) {
  enum { MOST = 20000 };
  ZpStaticSystem system = zp_statics_system(s);
  s->careful = care(s);
  system.length = fall_length;
  return zp_descend_until(&system, 1, zp_statics_tolerance(s), MOST, enough, user, work);
}

ZpNewtonInfo zp_statics_fall(ZpStatics *s, double voltage, ZpNewtonWork *work) {
  s->U = voltage;
  return zp_statics_fall_until(s, NULL, NULL, work);
}

/* -- along a parameter ---------------------------------------------------------------------------- */

static double get_voltage(void *self) {
  return ((const ZpStatics *)self)->U;
}

static void set_voltage(void *self, double U) {
  ((ZpStatics *)self)->U = U;
}

static double get_load(void *self) {
  return ((const ZpStatics *)self)->load;
}

static void set_load(void *self, double load) {
  ((ZpStatics *)self)->load = load;
}

/* Forces on nodes per unit of a parameter => r_m. A platform that is held stays where it is. */
static void sum_by(const ZpStatics *s, const double *force, double *r_m) {
  zp_assembly_sum(&s->assembly, force, r_m);
  if (is_held(s)) r_m[zp_statics_platform(s)] = 0;
}

void zp_statics_by_voltage(ZpStatics *s, double U, double *r_m) {
  ZpSpan here = span_of(s);
  ZpByVoltage by = {.force = s->force};
  here.U0 = here.U1 = U;
  zp_system_by_voltage(s->model, &here, &s->eval, &by);
  sum_by(s, s->force, r_m);
}

static void by_voltage(void *self, double *r_m) {
  ZpStatics *s = self;
  zp_statics_by_voltage(s, s->U, r_m);
}

static void by_load(void *self, double *r_m) {
  ZpStatics *s = self;
  const ZpModel *model = s->model;
  double per_mass = zp_load_share(model) * model->def.gravity;
  memset(s->force, 0, 2 * model->stride * sizeof *s->force);
  zp_weight_by_hung(model, s->force);
  for (size_t k = 0; k < 2 * model->stride; k++)
    s->force[k] *= per_mass;
  sum_by(s, s->force, r_m);
}

static void position(void *self, double *q) {
  const ZpStatics *s = self;
  zp_assembly_gather(&s->assembly, s->q, q);
}

/* q, tensions, voltage, load. */
static void save(void *self, void *to) {
  const ZpStatics *s = self;
  size_t stride = s->model->stride;
  double *place = to;
  memcpy(place, s->q, 2 * stride * sizeof *place);
  memcpy(place + 2 * stride, s->tension, stride * sizeof *place);
  place[3 * stride] = s->U;
  place[3 * stride + 1] = s->load;
}

static void restore(void *self, const void *from) {
  ZpStatics *s = self;
  size_t stride = s->model->stride;
  const double *place = from;
  memcpy(s->q, place, 2 * stride * sizeof *place);
  memcpy(s->tension, place + 2 * stride, stride * sizeof *place);
  s->U = place[3 * stride];
  s->load = place[3 * stride + 1];
}

ZpBranchSystem zp_statics_branch(ZpStatics *s, ZpAlong along) {
  const ZpModel *model = s->model;
  bool voltage = along == ZP_ALONG_VOLTAGE;
  return (ZpBranchSystem){.at_rest = zp_statics_system(s),
                          .get = voltage ? get_voltage : get_load,
                          .set = voltage ? set_voltage : set_load,
                          .sensitivity = voltage ? by_voltage : by_load,
                          .position = position,
                          .save = save,
                          .restore = restore,
                          .save_size = (3 * model->stride + 2) * sizeof(double),
                          .q_scale = 0.01 * model->L * sqrt(zp_parts_unknowns(&s->assembly.parts, s->assembly.n)),
                          .m_scale = voltage ? fmax(model->def.drive.voltage, 1) : fmax(model->def.load.mass, 1e-3)};
}

bool zp_statics_stable(ZpStatics *s, ZpNewtonWork *work) {
  exact_residual(s, work->r);
  stiffness(s, &work->K, NULL);
  return zp_band_factor(&work->K) && zp_band_negative(&work->K) == 0;
}
