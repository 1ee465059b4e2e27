#include "actuator/shape.h"

#include <math.h>

#include "actuator/ties.h"
#include "def/check.h"
#include "electro/series.h"

void zp_shape_reserve(const ZpModel *model, ZpShapeRoom *room, ZpArena *arena) {
  room->interface = room->strain = NULL;
  room->reach[0] = room->reach[1] = INFINITY;
  room->line_force = zp_arena_take(arena, model->nodes);
  room->insulator_field = zp_arena_take(arena, model->nodes);
  room->stress = zp_arena_take(arena, model->count);
}

bool zp_shape_is_wet(const ZpModel *model, const ZpShapeRoom *room, size_t i) {
  size_t from_clip = zp_topology_station_image(&model->topology, i);
  bool second = from_clip != i;
  return (double)from_clip * model->l <= room->reach[second];
}

/* The charge between insulators and liquid at station i, as a voltage: that of the nearest place. */
static double interface_at(const ZpModel *model, const ZpShapeRoom *room, size_t patch, size_t i) {
  bool last = i + 1 == model->nodes;
  if (!room->interface) return 0;
  return zp_leak_of_patch(&model->plates, room->interface,
                          patch)[last ? ZP_PLATES_PLACES * i - 2 : ZP_PLATES_PLACES * i];
}

/* Eqs. (4.10) and (25.2); beyond a bead with air between the faces. Of patches the force in all, and the strongest
 * field. */
static void fill_fields(const ZpModel *model, const ZpShapeRoom *room, const ZpShape *shape, size_t i) {
  bool wet = zp_shape_is_wet(model, room, i);
  ZpSeriesParams series = model->series;
  if (!wet) series.eps_m = 1;
  room->line_force[i] = 0;
  for (size_t k = 0; k < model->leak.patches; k++) {
    double Z = interface_at(model, room, k, i), Y = shape->voltage + Z, gap = shape->gap[i];
    double field = zp_series_at(&series, Y, gap).insulator;
    if (Z != 0) field = fabs(copysign(field, Y) - Z / zp_insulation(&model->def));
    room->line_force[i] += model->leak.patch[k].share * zp_plates_law(wet ? &model->plates : &model->air, Y, gap).W;
    room->insulator_field[i] = k == 0 ? field : fmax(room->insulator_field[i], field);
  }
}

void zp_shape_fill(const ZpModel *model, const ZpShapeRoom *room, ZpShape *shape) {
  ZpStressParams stress = model->stress;
  if (room->k0) stress.rod.k0 = room->k0;
  if (zp_is_in_space(model)) /* stresses of twisted strips are not known */
    for (size_t j = 0; j < model->count; j++)
      room->stress[j] = NAN;
  else
    zp_stress(&stress, shape->x, shape->y, room->strain, room->stress);
  shape->stress = room->stress;
  if (!model->field) return;
  for (size_t i = 0; i < model->nodes; i++)
    fill_fields(model, room, shape, i);
  shape->line_force = room->line_force;
  shape->insulator_field = room->insulator_field;
}

ZpMargins zp_margins_none(void) {
  return (ZpMargins){NAN, NAN, NAN, 0, NAN, NAN, NAN};
}

/* Is this more than the worst so far, or the first? Of equals the first counts. */
static bool is_worse(double value, double worst) {
  return value > worst || (isnan(worst) && !isnan(value));
}

void zp_margins_join(ZpMargins *worst, ZpMargins other) {
  worst->liquid = fmax(worst->liquid, other.liquid);
  if (is_worse(other.insulator / other.withstands, worst->insulator / worst->withstands)) {
    worst->insulator = other.insulator;
    worst->insulator_place = other.insulator_place;
    worst->withstands = other.withstands;
  }
  if (is_worse(other.stress / other.yields, worst->stress / worst->yields)) {
    worst->stress = other.stress;
    worst->stress_place = other.stress_place;
    worst->yields = other.yields;
  }
}

static ZpMargins fields_at(const ZpModel *model, double voltage, double gap, double place) {
  ZpSeries seen = zp_series_at(&model->series, voltage, gap);
  return (ZpMargins){seen.insulator, place, model->series.withstands, seen.liquid, NAN, NAN, NAN};
}

ZpMargins zp_margins_of(const ZpModel *model, const ZpShape *shape) {
  ZpMargins worst = zp_margins_none();
  for (size_t j = 0; j < model->count; j++)
    zp_margins_join(&worst, (ZpMargins){NAN, NAN, NAN, 0, shape->stress[j], zp_straight_x(model, j / model->s),
                                        model->ribbon[j % model->s].yields});
  for (size_t i = 0; model->field && i < model->nodes; i++) {
    ZpMargins at = fields_at(model, shape->voltage, shape->gap[i], zp_straight_x(model, i));
    at.insulator = shape->insulator_field[i];
    zp_margins_join(&worst, at);
  }
  return worst;
}

ZpMargins zp_margins_at_clip(const ZpModel *model, double voltage) {
  ZpMargins worst = zp_margins_none();
  if (model->s == 2) worst = fields_at(model, voltage, 0, 0);
  for (const ZpModel *m = model + 1; m < model + model->members; m++)
    zp_margins_join(&worst, fields_at(m, zp_member_voltage(m, voltage), 0, 0));
  return worst;
}

/* -- several ------------------------------------------------------------------------------------------ */

void zp_many_reserve(ZpManyShapes *all, size_t members, size_t nodes, size_t stations, ZpArena *arena) {
  all->nodes = nodes;
  all->stations = stations;
  for (size_t k = 0; k < ZP_SHAPE_ARRAYS; k++)
    all->array[k] = zp_arena_take(arena, members * (k < ZP_NODE_ARRAYS ? nodes : stations));
}

void zp_many_put(const ZpManyShapes *all, const ZpModel *first, size_t member, const ZpShape *one) {
  const double *const from[ZP_SHAPE_ARRAYS] = {one->x,   one->y,          one->stress,
                                               one->gap, one->line_force, one->insulator_field};
  for (size_t k = 0; k < ZP_SHAPE_ARRAYS; k++) {
    size_t size = k < ZP_NODE_ARRAYS ? all->nodes : all->stations;
    if (from[k]) memcpy(all->array[k] + member * size, from[k], size * sizeof *from[k]); /* without electrodes: none */
  }
  double *x = all->array[0] + member * all->nodes, *y = all->array[1] + member * all->nodes;
  const ZpSight above = zp_sight_of_end(first, member, true);
  for (size_t j = 0; j < all->nodes; j++) {
    const double up = first[member].topology.along ? x[j] : y[j];
    x[j] = first[member].topology.along ? y[j] : x[j];
    y[j] = above.origin + above.sign * up;
  }
}

void zp_many_hang(const ZpManyShapes *all, const ZpModel *first, size_t member) {
  const ZpTopology *t = &first[member].topology;
  const ZpBody *upper = &first->network->body[first->network->ends[member].upper];
  double *y = all->array[1] + member * all->nodes, fall = -y[zp_top_node(t)];
  if (!upper->held) fall += (all->array[1] + upper->leader * all->nodes)[zp_load_node(&first[upper->leader].topology)];
  for (size_t j = 0; j < all->nodes; j++)
    y[j] += fall;
}

void zp_many_stand(const ZpManyShapes *all, const ZpPlanar *plane, const ZpPose *pose, size_t member) {
  const size_t from = member * all->nodes;
  zp_plane_draw(plane, member, pose, all->nodes, all->array[0] + from, all->array[1] + from);
}

void zp_many_give(const ZpManyShapes *all, ZpShape *shape) {
  shape->x = all->array[0];
  shape->y = all->array[1];
  shape->stress = all->array[2];
  if (shape->gap) shape->gap = all->array[3];
  if (shape->line_force) shape->line_force = all->array[4];
  if (shape->insulator_field) shape->insulator_field = all->array[5];
}

ZpShapes *zp_model_shapes(const ZpModel *model, size_t capacity) {
  size_t members = model->members;
  ZpShapes *shapes = zp_shapes_create(model->s, members * model->nodes, capacity);
  if (shapes && members > 1) shapes->members = members;
  return shapes;
}
