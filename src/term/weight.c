/* Weight of all that has a mass, along gravity; load.force and the load input, downwards, of a pouch along its film.
 * Eq. (27.4). */
#include "base/kernel.h"
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

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  ZpForces to = zp_forces(model, F);
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

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  (void)e;
  const double *x = zp_nodes(model, now->end).x, *y = zp_nodes(model, now->end).y;
  for (size_t j = 0; j < model->count; j++) {
    double along = x[j] - zp_straight_x(model, j / model->s);
    row[0] -= model->weight[j] * (model->fall[0] * along + model->fall[1] * y[j]);
  }
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
                               .now = energy,
                               .by_key = by_key,
                               .rules = ZP_RULES_OF(rule)};
