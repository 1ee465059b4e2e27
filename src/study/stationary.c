/* Study `stationary`: the loaded shape at rest, without voltage. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "rest/refine.h"
#include "study/sensitivity.h"

static const ZpColumn columns[] = {
    {"station", "1", "number of the node, from the clip or clamp"},
    {"x_m", "m", "horizontal position of the lower or only ribbon"},
    {"y_m", "m", "height of the lower or only ribbon"},
    {"tension_N", "N", "tension in the edge to the right of the node"},
    {"upper_x_m", "m", "horizontal position of the upper ribbon"},
    {"upper_y_m", "m", "height of the upper ribbon"},
    {"stress_Pa", "Pa", "largest stress of the metal in the section of the lower or only ribbon"},
    {"upper_stress_Pa", "Pa", "largest stress of the metal in the section of the upper ribbon"},
    {"member", "1", "number of the member; 1 is the uppermost"}, /* of several */
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

/* In space. */
static const ZpColumn columns_in_space[] = {
    {"station", "1", "number of the node, from the clamp"},
    {"x_m", "m", "horizontal position of the middle of the ribbon"},
    {"y_m", "m", "height of it"},
    {"z_m", "m", "its position towards the viewer"},
    {"roll_rad", "rad",
     "angle of the edge to the right of the node about its tangent, from the frame that the shortest "
     "rotation carries there from the clamp"},
    {"tension_N", "N", "tension in that edge"},
    {"twist_per_m", "1/m", "twist of the ribbon at the node"},
};
enum { COLUMNS_IN_SPACE = sizeof columns_in_space / sizeof columns_in_space[0] };

static void fill_rows_in_space(const ZpStatics *s, ZpTable *table) {
  const ZpRestMember *m = s->member;
  const size_t last = m->model->nodes - 1;
  const ZpNodes n = zp_nodes(m->model, m->q);
  for (size_t i = 0; i <= last; i++) {
    const bool inside = i > 0 && i < last;
    const double twist = m->eval.space->joint[i].strain[ZP_SPACE_TWIST] / m->model->l;
    const double row[COLUMNS_IN_SPACE] = {(double)i,
                                          n.x[i],
                                          n.y[i],
                                          zp_read_axis(m->model, m->q, ZP_AXIS_Z)[i],
                                          i < last ? zp_read_axis(m->model, m->q, ZP_AXIS_ROLL)[i] : NAN,
                                          i < last ? m->eval.edges.T[i] : NAN,
                                          inside ? twist : NAN};
    zp_table_offer(table, row);
  }
}

static void fill_rows(const ZpStatics *s, size_t which, const ZpShape *shape, ZpTable *table) {
  const ZpRestMember *m = &s->member[which];
  const ZpTopology *t = &m->model->topology;
  size_t first = which * m->model->count; /* of its nodes in the shape */
  for (size_t i = 0; i < t->stations; i++) {
    size_t upper = first + zp_upper(t, i), lower = first + zp_lower(t, i);
    bool edge = i + 1 < t->stations && (i < t->platform.first || i >= t->platform.last), two = zp_is_pair(t);
    double row[COLUMNS] = {(double)i,
                           shape->x[lower],
                           shape->y[lower],
                           edge ? m->eval.edges.T[zp_lower(t, i)] : NAN,
                           two ? shape->x[upper] : NAN,
                           two ? shape->y[upper] : NAN,
                           shape->stress[lower],
                           two ? shape->stress[upper] : NAN,
                           (double)(which + 1)};
    zp_table_offer(table, row);
  }
}

static const char *words_of(ZpStatics *s, ZpNewtonEnd end, char text[ZP_NO_REST_SIZE]) {
  const bool ended = zp_newton_good(end) || end == ZP_NEWTON_REFUSED;
  const char *fallen = ended ? NULL : zp_statics_fallen(s, text);
  if (fallen) return fallen;
  switch (end) {
  case ZP_NEWTON_CONVERGED:
    return "residual below tolerance";
  case ZP_NEWTON_FLOOR:
    return "residual at rounding level";
  case ZP_NEWTON_SINGULAR:
    return "no equilibrium found: the stiffness matrix is singular";
  case ZP_NEWTON_DIVERGED:
    return "no equilibrium found: the iteration diverged";
  case ZP_NEWTON_REFUSED:
    return zp_statics_fault(s);
  case ZP_NEWTON_SLOW:
    break;
  }
  return "no equilibrium found within the largest number of iterations";
}

/* Number 0, 1 .. of the places of bodies, as they stand in the result. */
static double place_of(ZpStatics *s, void *number) {
  const bool plane = s->model->network->plane;
  const size_t at = *(const size_t *)number, body = 1 + (plane ? at / ZP_WAYS : at);
  const ZpPose place = zp_statics_places(s)[body];
  const double of[ZP_WAYS] = {place.x, place.y, place.turn};
  return of[plane ? at % ZP_WAYS : ZP_WAY_UP];
}

/* The places of all bodies, which are numbers of the result already. */
static void derive_places(ZpRestSensitivity *slope, ZpResult *result) {
  const bool found = zp_rest_sensitivity_solve(slope, ZP_SETS_LOAD);
  size_t number = 0;
  for (size_t k = 0; k < result->scalars; k++) {
    const char *name = result->scalar[k].name;
    if (strncmp(name, "bodies.", 7) != 0) continue;
    zp_result_add_sensitivity(result, name, slope->key, found ? zp_rest_sensitivity_of(slope, place_of, &number) : NAN);
    number++;
  }
}

static void derive(void *user, ZpRestSensitivity *slope, ZpResult *result) {
  (void)user;
  if (zp_is_network(slope->at->model)) {
    derive_places(slope, result);
    return;
  }
  bool found = zp_rest_sensitivity_solve(slope, ZP_SETS_LOAD), two = zp_is_pair(&slope->at->member->model->topology);
  zp_result_add_sensitivity(result, "stroke_m", slope->key,
                            found ? zp_rest_sensitivity_of(slope, zp_output_stroke, NULL) : NAN);
  if (two)
    zp_result_add_sensitivity(result, "opening_m", slope->key,
                              found ? zp_rest_sensitivity_of(slope, zp_output_opening, NULL) : NAN);
  if (zp_tells_angle(slope->at->member->model))
    zp_result_add_sensitivity(result, "angle_rad", slope->key,
                              found ? zp_rest_sensitivity_of(slope, zp_output_angle, NULL) : NAN);
}

/* Estimated errors; `user` is a ZpEquilibria. */
static void estimate(void *user, const ZpOtherMesh *other) {
  const ZpStatics *at = &((ZpEquilibria *)user)->rest.statics, *to = &other->rest->statics;
  const bool found = zp_refine_rest(at, other->rest);
  zp_add_estimate(other, "stroke_m", found ? zp_statics_stroke(to) - zp_statics_stroke(at) : NAN);
  if (zp_is_pair(&at->model->topology))
    zp_add_estimate(other, "opening_m", found ? zp_statics_opening(to) - zp_statics_opening(at) : NAN);
  if (zp_tells_angle(at->model))
    zp_add_estimate(other, "angle_rad", found ? zp_statics_angle(to) - zp_statics_angle(at) : NAN);
  if (!zp_is_in_space(at->model)) return;
  zp_add_estimate(other, "lateral_m", found ? zp_statics_lateral(to) - zp_statics_lateral(at) : NAN);
  zp_add_estimate(other, "skew_rad", found ? zp_statics_skew(to) - zp_statics_skew(at) : NAN);
}

static void run(ZpEquilibria *at) {
  ZpResult *result = at->result;
  ZpStatics *s = &at->rest.statics;
  const ZpTopology *t = &at->model->topology;
  ZpNewtonInfo info = zp_statics_find_rest(s);
  bool found = zp_newton_good(info.end);
  result->outcome = found ? ZP_CONVERGED : s->stopped ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(result->message, sizeof result->message, "%s%s",
           info.end == ZP_NEWTON_REFUSED ? "the equilibrium found is impossible: " : "",
           s->stopped ? "interrupted" : words_of(s, info.end, (char[ZP_NO_REST_SIZE]){0}));
  zp_result_add(result, "stroke_m", "m", found ? zp_statics_stroke(s) : NAN);
  if (zp_is_pair(t)) zp_result_add(result, "opening_m", "m", found ? zp_statics_opening(s) : NAN);
  if (zp_tells_angle(at->model)) zp_result_add(result, "angle_rad", "rad", found ? zp_statics_angle(s) : NAN);
  if (zp_is_in_space(at->model)) {
    zp_result_add(result, "lateral_m", "m", found ? zp_statics_lateral(s) : NAN);
    zp_result_add(result, "skew_rad", "rad", found ? zp_statics_skew(s) : NAN);
  }
  if (found) zp_equilibria_add_members(at);
  zp_result_add(result, "iterations", "count", info.iterations);
  zp_result_add(result, "residual", "1", isfinite(info.residual) ? info.residual : NAN);
  ZpShape shape = zp_rest_shape(&at->rest, 0, &at->margins);
  if (!found) at->margins = zp_margins_none();
  zp_add_stress(result, at->model, &at->margins);
  zp_note_mesh(result, at->model, 0);
  if (!found) return;
  if (zp_is_in_space(at->model)) fill_rows_in_space(s, result->series);
  for (size_t which = 0; !zp_is_in_space(at->model) && which < s->members; which++)
    fill_rows(s, which, &shape, result->series);
  zp_shapes_offer(result->shapes, &shape);
}

/* Study stationary has no voltage. */
static const ZpRule rule[] = {
    ZP_RULE_STARTS,
    ZP_RULE_DERIVATIVES,
};
const ZpRules zp_rules_stationary = ZP_RULES_OF(rule);

ZpStatus zp_check_stationary(const ZpActuatorDef *def, ZpError *err) {
  return zp_check_sensitivity(def, err);
}

/* Without voltage a bead acts only by the suction of its menisci. Without suction it is omitted, because equations with
 * a bead take five times the work. It is kept for derivatives, one of which may be by the suction. */
ZpStatus zp_study_stationary(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpActuatorDef def = *task->def;
  bool pulls = def.bead.suction > 0 || *def.sensitivity.by != 0;
  if (zp_def_liquid(&def) == ZP_LIQUID_BEAD && !pulls) def.liquid.model = ZP_LIQUID_NONE;
  ZpEquilibria at = {.task = task, .result = result, .stage = "hanging", .shapes = 2};
  ZpStatus status = zp_equilibria_open(&at, &def, NULL, NULL, err);
  size_t members = status == ZP_OK ? at.model->members : 0;
  if (status == ZP_OK)
    result->series = zp_is_in_space(at.model)
                         ? zp_table_create(columns_in_space, COLUMNS_IN_SPACE, at.model->nodes)
                         : zp_table_create(columns, members > 1 ? COLUMNS : COLUMNS - 1, members * at.model->nodes);
  if (status == ZP_OK && !result->series) status = zp_fail_memory(err);
  if (status == ZP_OK) run(&at);
  if (status == ZP_OK && result->outcome == ZP_CONVERGED)
    status = zp_sensitivity_of(&at.rest, derive, NULL, result, err);
  if (status == ZP_OK && result->outcome == ZP_CONVERGED)
    status = zp_estimate_from_there(&at, false, estimate, &at, err);
  zp_equilibria_close(&at);
  return status;
}
