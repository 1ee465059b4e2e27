#include "actuator/eval.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "def/device.h"

static void reserve_natural(const ZpModel *model, ZpNatural *n, ZpArena *arena) {
  n->kappa[ZP_NATURAL_START] = zp_arena_take(arena, model->driven.places);
  n->rate = zp_arena_take(arena, model->driven.places);
  n->by = zp_arena_take(arena, model->stride);
  double **const edges[] = {&n->Rx, &n->Ry};
  for (size_t k = 0; k < 2; k++) {
    double *array = zp_arena_take(arena, ZP_LANES + model->stride);
    *edges[k] = array ? array + ZP_LANES : NULL;
  }
  for (size_t k = 0; k < ZP_NATURAL_PLACES; k++)
    n->k0[k] = zp_arena_take(arena, model->stride);
}

static void reserve_space(const ZpModel *model, ZpEval *e, ZpArena *arena) {
  for (size_t r = 0; r < model->s; r++) {
    ZpSpaceRod *rod = &e->space[r];
    rod->at = zp_arena_take_of(arena, model->nodes, sizeof *rod->at);
    rod->edge = zp_arena_take_of(arena, model->nodes + 1, sizeof *rod->edge);
    rod->joint = zp_arena_take_of(arena, model->nodes, sizeof *rod->joint);
    rod->tension = zp_arena_take(arena, model->nodes);
    rod->sway = zp_arena_take(arena, model->nodes);
  }
  e->space_gradient = zp_arena_take(arena, ZP_SPACE_OF_NODE * model->nodes);
  e->space_K = zp_arena_take(arena, ZP_SPACE_OF_NODE * model->nodes * (ZP_SPACE_BAND + 1));
  e->space_coordinate = zp_arena_take_of(arena, ZP_SPACE_OF_NODE * model->nodes, sizeof *e->space_coordinate);
}

static void reserve_mechanics(const ZpModel *model, ZpEval *e, ZpArena *arena) {
  zp_rod_reserve(&model->rod, &e->rod_start, arena);
  zp_rod_reserve(&model->rod, &e->rod, arena);
  zp_rod_step_reserve(&model->rod, &e->rod_step, arena);
  e->k0 = zp_arena_take(arena, model->stride);
  if (model->driven.places > 0) reserve_natural(model, &e->natural, arena);
  const double *tension = model->rod.plastic ? e->rod_step.T : e->rod.T; /* less what yields */
  e->edges = (ZpEdges){e->rod.dpx, e->rod.dpy, e->rod.ux, e->rod.uy, tension, e->rod_step.Rx, e->rod_step.Ry};
  if (zp_is_in_space(model)) reserve_space(model, e, arena);
  if (model->is_rod) return;
  zp_massspring_reserve(&model->spring, &e->spring_start, arena);
  zp_massspring_reserve(&model->spring, &e->spring, arena);
  e->edges =
      (ZpEdges){e->spring.dpx, e->spring.dpy, e->spring.ux, e->spring.uy, e->spring.T, e->spring.Rx, e->spring.Ry};
}

static size_t reserve(const ZpModel *model, ZpEval *e, void *block) {
  ZpArena arena = {block, 0};
  reserve_mechanics(model, e, &arena);
  zp_plates_reserve(&model->plates, &e->plates_start, &arena);
  zp_plates_reserve(&model->plates, &e->plates, &arena);
  zp_plates_step_reserve(&model->plates, &e->attraction, &arena);
  zp_plates_by_voltage_reserve(&model->plates, &e->by_voltage, &arena);
  zp_film_reserve(&model->film, &e->film, &arena);
  e->cover.part = zp_arena_take(&arena, model->nodes);
  e->open = zp_arena_take(&arena, model->nodes);
  e->extra_residual = e->film.r;
  zp_leak_reserve(&model->leak, &model->plates, &e->leak, &arena);
  e->memory_end = zp_arena_take(&arena, model->kept);
  zp_contact_reserve(&model->faces, &e->faces, &arena);
  zp_surface_reserve(model->nodes, &e->surface, &arena);
  double **stations[] = {&e->gaps.own, &e->gaps.next, &e->gaps.along0, &e->gaps.along1};
  for (size_t k = 0; k < sizeof stations / sizeof stations[0]; k++)
    *stations[k] = zp_arena_take(&arena, model->nodes);
  e->D = zp_arena_take_of(&arena, 3 * model->stride, sizeof *e->D);
  e->mean_v = zp_arena_take(&arena, zp_coordinates(model));
  e->by_volume = zp_arena_take(&arena, model->pouch.w > 0 ? zp_coordinates(model) : 0);
  e->unused = zp_arena_take(&arena, zp_coordinates(model));
  e->none = zp_arena_take(&arena, model->stride);
  return arena.used;
}

/* The electrodes of a pouch end; beyond them no law acts. */
static void cover_electrodes(const ZpModel *model, ZpEval *e) {
  for (size_t i = 0; i + 1 < model->nodes; i++)
    e->cover.part[i] = fmin(fmax(model->pouch.electrode / model->l - (double)i, 0), 1);
}

bool zp_eval_create(const ZpModel *model, ZpEval *e) {
  memset(e, 0, sizeof *e);
  e->model = model;
  e->memory = zp_calloc(1, reserve(model, e, NULL));
  if (!e->memory) return false;
  reserve(model, e, e->memory);
  if (model->plates.air) e->plates_start.cover = e->plates.cover = &e->cover;
  if (model->pouch.w > 0) cover_electrodes(model, e);
  return true;
}

void zp_eval_destroy(ZpEval *e) {
  zp_free(e->memory);
  e->memory = NULL;
}

ZpCachedField zp_state_beyond(const ZpModel *model, const ZpState *state) {
  if (!model->field_solved) return (ZpCachedField){0};
  const double *F = zp_held_force(model, state);
  return (ZpCachedField){F, F + zp_coordinates(model), state->held_energy, state->held_charge, state->held_capacitance};
}

ZpCachedField zp_eval_beyond(const ZpEval *e) {
  const ZpFieldCorrection *correction = &e->correction;
  if (correction->solutions == 0) return (ZpCachedField){0};
  return (ZpCachedField){correction->F, correction->q, correction->energy, correction->charge, correction->capacitance};
}

void zp_eval_cover(const ZpModel *model, const double reach[ZP_BEADS], ZpEval *e) {
  if (model->has_bead) zp_bead_cover(&model->film, reach, &e->cover);
}

void zp_eval_reach(const ZpModel *model, const double *gap, const ZpBead *bead, double reach[ZP_BEADS]) {
  for (int half = 0; half < zp_beads(&model->film); half++) {
    double gone = bead ? bead[half].outside + bead[half].lost : 0;
    reach[half] = zp_bead_reach(&model->film, gap, half, model->bead.volume - gone);
  }
}

ZpZipState zp_eval_touching(const ZpModel *model, const double *gap) {
  return (ZpZipState){zp_contact_front(&model->faces, gap), zp_contact_closed(&model->faces, gap)};
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
  static const double least_weight = 1e-3, bends = 1e3; /* N; of the force that bends a ribbon */
  const ZpActuatorDef *def = &model->def;
  const bool rigid = zp_def_has(def, ZP_DEVICE_RIGID);
  double small = bends * zp_ribbon_section(model, 0).EI / (model->L * model->L);
  if (rigid) return fmax(model->total_weight, zp_plate_share(model) * def->plate.stiffness * def->plate.gap);
  return fmax(model->total_weight, fmin(least_weight, small));
}

double zp_eval_imbalance(const ZpModel *model, const double *a) {
  double largest = 0;
  for (size_t k = 0; k < zp_coordinates(model); k++)
    if (!(fabs(a[k]) <= largest)) largest = fabs(a[k]);
  return largest * model->pseudo_mass / zp_eval_weight_scale(model);
}
