/* Weight of all that has a mass, along gravity; load.force and the load input, downwards, of a pouch along its film.
 * Eq. (27.4). */
#include "base/kernel.h"
#include "math/vector.h"
#include "ribbon/space_angle.h"
#include "term/term.h"

const ZpRow zp_row_gravity_energy =
    ZP_STORED(gravity_energy, "potential energy of all weights and of load.force, 0 when the ribbons are straight");
const ZpRow zp_row_catch_loss =
    ZP_LOST(catch_loss, "energy lost in the impact of a mass that was caught; 0 without load.change_mass");

ZP_KERNEL static void add(size_t lanes, double share, const double *weight, double *restrict F) {
  ZP_SIMD
  for (size_t j = 0; j < lanes; j++)
    F[j] += share * weight[j];
}

/* Weight that hangs on the load's nodes, and a force down, N, both of the modelled part. */
static void add_load(const ZpModel *model, double hung, double down, double *F) {
  const ZpTopology *t = &model->topology;
  double ends = (double)zp_halves(t);
  ZpForces to = zp_forces(model, F);
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    double part = zp_load_part(model, i) / ends;
    to.x[zp_lower(t, i)] += part * (hung * model->fall[0] + down * model->pull[0]);
    to.y[zp_lower(t, i)] += part * (hung * model->fall[1] + down * model->pull[1]);
  }
}

/* load.force of the modelled part, N. */
static double constant_of(const ZpModel *model) {
  return zp_load_share(model) * model->def.load.force;
}

/* The force of all of the load, N. */
static void whole_load(const ZpModel *model, const ZpSpan *span, double out[3]) {
  const double weight = span->share * zp_load_share(model) * model->def.load.mass * model->def.gravity + span->hung,
               down = span->load + span->share * constant_of(model);
  for (int k = 0; k < 3; k++)
    out[k] = weight * model->fall[k] + (k < 2 ? down * model->pull[k] : 0);
}

/* Does the load turn the end that it hangs on, beside its middle? An end that is guided bears it. */
static bool turns_end(const ZpModel *model) {
  return zp_is_in_space(model) && model->def.load.across != 0 && zp_ends_free(&model->topology);
}

static const ZpSpaceEdge *last_edge(const ZpModel *model, const ZpEval *e) {
  return &e->space[model->s - 1].edge[model->nodes - 1];
}

/* The load turns the last edge, eq. (41.8), whose angle is counted from the straight ribbon. */
static void load_beside(const ZpModel *model, const ZpSpan *span, const ZpEval *e, double first[ZP_SPACE_OF_EDGE],
                        double second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE]) {
  const ZpSpaceAngle angle = zp_space_angle(zp_space_along_x, last_edge(model, e));
  double load[3];
  whole_load(model, span, load);
  zp_space_beside(last_edge(model, e), load, model->def.load.across, first, second);
  zp_space_count_from(&angle, first, second);
}

/* The node at its left end. */
static size_t left_of_last(const ZpModel *model) {
  return model->count - 1 - model->s;
}

static void add_beside(const ZpModel *model, const ZpSpan *span, const ZpEval *e, double *F) {
  const size_t left = left_of_last(model), right = left + model->s;
  double first[ZP_SPACE_OF_EDGE];
  load_beside(model, span, e, first, NULL);
  for (size_t c = 0; c < 3; c++) {
    zp_axis(model, F, c)[right] += first[c];
    zp_axis(model, F, c)[left] -= first[c];
  }
  zp_axis(model, F, ZP_AXIS_ROLL)[left] += first[ZP_AXIS_ROLL];
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  enum { OF_ENDS = 7 }; /* x, y, z of the edge's left node and of its right one, then its angle */
  double first[ZP_SPACE_OF_EDGE], second[ZP_SPACE_OF_EDGE][ZP_SPACE_OF_EDGE], value[OF_ENDS * OF_ENDS] = {0};
  size_t coordinate[OF_ENDS];
  if (!turns_end(model)) return;
  load_beside(model, span, e, first, second);
  for (size_t k = 0; k < OF_ENDS; k++) {
    const size_t axis = k < OF_ENDS - 1 ? k % 3 : ZP_AXIS_ROLL, right = k / 3 == 1;
    coordinate[k] = zp_coordinate_of(model->count, left_of_last(model) + right * model->s, axis);
    for (size_t m = k; m < OF_ENDS; m++) {
      const double sign = (k < 3) == (m < 3) ? 1 : -1; /* the edge goes from the left to the right */
      value[OF_ENDS * k + m - k] = -sign * second[axis][m < OF_ENDS - 1 ? m % 3 : ZP_AXIS_ROLL];
    }
  }
  zp_assemble_chain(assembly, OF_ENDS, coordinate, OF_ENDS, value, K);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  ZpForces to = zp_forces(model, F);
  if (zp_is_in_space(model))
    add(zp_lanes(model), span->share * model->fall[2], model->weight, zp_axis(model, F, ZP_AXIS_Z));
  if (turns_end(model)) add_beside(model, span, e, F);
  if (model->fall[0] != 0) add(zp_lanes(model), span->share * model->fall[0], model->weight, to.x);
  add(zp_lanes(model), span->share * model->fall[1], model->weight, to.y);
  add_load(model, span->hung, span->load + span->share * constant_of(model), F);
}

void zp_weight_by_load(const ZpModel *model, double hung, double load, double *F) {
  add_load(model, hung, load, F);
}

/* Of the ribbons, by a key of their sections; a node's mass is proportional to its ribbon's. */
static bool add_ribbons(const ZpModel *model, double share, int key, double *F) {
  ZpForces to = zp_forces(model, F);
  ZpSection rate[2] = {{0}};
  for (size_t r = 0; r < model->s; r++)
    if (zp_ribbon_section(model, r).mu == 0 || !zp_ribbon_by_key(model, r, key, &rate[r])) return false;
  for (size_t r = 0; r < model->s; r++)
    for (size_t j = r; j < model->count; j += model->s) {
      double weight = zp_ribbon_mass(model, j) * model->def.gravity * rate[r].mu / zp_ribbon_section(model, r).mu;
      to.x[j] += share * model->fall[0] * weight;
      to.y[j] += share * model->fall[1] * weight;
    }
  return true;
}

/* Of clips or platforms: `part` is that of their mass at a node. */
static void add_connections(const ZpModel *model, double share, double (*part)(const ZpModel *, size_t), double *F) {
  ZpForces to = zp_forces(model, F);
  for (size_t j = 0; j < model->count; j++) {
    double weight = share * part(model, j) * model->def.gravity;
    to.x[j] += weight * model->fall[0];
    to.y[j] += weight * model->fall[1];
  }
}

static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  (void)e;
  if (zp_is_in_space(model)) return false;
  const double carried = span->share * zp_load_share(model);
  ZpForces to = zp_forces(model, F);
  if (key == ZP_KEY(gravity)) {
    add(zp_lanes(model), span->share * model->fall[0], model->mass, to.x);
    add(zp_lanes(model), span->share * model->fall[1], model->mass, to.y);
    add_load(model, -span->share * zp_series_inertia(model), 0, F);
  } else if (key == ZP_KEY(load.mass)) {
    add_load(model, carried * model->def.gravity, 0, F);
  } else if (key == ZP_KEY(clip.mass) || key == ZP_KEY(platform.mass)) {
    add_connections(model, span->share, key == ZP_KEY(clip.mass) ? zp_clip_part : zp_platform_part, F);
  } else if (key == ZP_KEY(load.force)) {
    add_load(model, 0, carried, F);
  } else {
    return add_ribbons(model, span->share, key, F);
  }
  return true;
}

/* Work of the load on its way beside the middle of the end, J. */
static double work_beside(const ZpModel *model, const ZpSpan *now, const ZpEval *e) {
  double load[3];
  whole_load(model, now, load);
  return model->def.load.across * zp_space_dot(load, last_edge(model, e)->width);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  const double *x = zp_nodes(model, now->end).x, *y = zp_nodes(model, now->end).y;
  for (size_t j = 0; j < model->count; j++) {
    double along = x[j] - zp_straight_x(model, j / model->s);
    row[0] -= model->weight[j] * (model->fall[0] * along + model->fall[1] * y[j]);
  }
  for (size_t j = 0; zp_is_in_space(model) && j < model->count; j++)
    row[0] -= model->weight[j] * model->fall[2] * zp_read_axis(model, now->end, ZP_AXIS_Z)[j];
  if (turns_end(model)) row[0] -= work_beside(model, now, e);
  row[0] -= constant_of(model) * zp_load_down(model, zp_nodes(model, now->end));
  row[0] -= now->hung * (model->fall[0] * (zp_load_at(model, x) - now->hung_at[0]) +
                         model->fall[1] * (zp_load_at(model, y) - now->hung_at[1]));
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET(load.change_mass), ZP_SET(load.change_time), "a change of mass has a time"),
    ZP_RULE(PHYSICS, ZP_ABOVE(load.drop_height, 0), ZP_SET(load.change_time),
            "what falls is caught at load.change_time"),
    ZP_RULE(PHYSICS, ZP_ABOVE(load.drop_height, 0), ZP_AT_LEAST(load.change_mass, 0),
            "only a mass that is caught has fallen"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_SET(load.change_mass), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of the paper, whose load is constant"),
};

/* The impact is booked where it happens, run/load_change.c. */
const ZpTerm zp_term_weight = {.name = "weight",
                               .row = {&zp_row_gravity_energy, &zp_row_catch_loss},
                               .force = force,
                               .stiffness = stiffness,
                               .now = energy,
                               .by_key = by_key,
                               .rules = ZP_RULES_OF(rule)};
