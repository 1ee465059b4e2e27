/* Letters of docs/theory.md, section 20: p the key, q coordinates, F forces, K = -dF/dq, m a branch's parameter. */
#include "rest/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "def/rule.h"
#include "math/vector.h"

/* -- what can be asked ----------------------------------------------------------------------------- */

/* Keys that determine how to compute, not what. */
static bool is_numerical(const char *name) {
  static const char *const groups[] = {"solver.", "calibrate.", "electro.refresh_"};
  for (size_t k = 0; k < sizeof groups / sizeof groups[0]; k++)
    if (strncmp(name, groups[k], strlen(groups[k])) == 0) return true;
  return false;
}

/* Names of bodies and ports are numbers to the table of keys; between bodies that move up and down a member is upright
 * or upside down. */
static bool key_is_of_place(const ZpActuatorDef *def, int key) {
  const int row = zp_key_instance(key).row;
  const bool fixed = !zp_def_plane(def) && (row == ZP_KEY(member_K.angle) || row == ZP_KEY(body_K.at.x));
  return zp_key_is_name(key) || fixed;
}

ZpStatus zp_rest_sensitivity_check(const ZpActuatorDef *def, int key, ZpError *err) {
  const ZpKey *k = zp_key(key);
  if (def->electro.model == ZP_ELECTRO_FIELD)
    return zp_fail(
        err, ZP_BAD_INPUT,
        "sensitivity.by: requires electro.model plates; the derivatives of a computed field are not available");
  if (k->type != ZP_KEY_REAL && k->type != ZP_KEY_REAL_AUTO)
    return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: %s is not a real number, so it has no derivative",
                   ZP_KEY_SHOWN(def, key));
  if (is_numerical(k->name))
    return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: %s is a setting of the computation, not a physical quantity",
                   ZP_KEY_SHOWN(def, key));
  if (key_is_of_place(def, key))
    return zp_fail(err, ZP_BAD_INPUT,
                   "sensitivity.by: %s says which bodies or ports are joined, so it has no derivative",
                   ZP_KEY_SHOWN(def, key));
  if (isnan(zp_def_get(def, key)))
    return zp_fail(err, ZP_BAD_INPUT, "sensitivity.by: %s is %s: give it a number", ZP_KEY_SHOWN(def, key), k->text);
  return ZP_OK;
}

/* The inputs that its definition sets. */
static void set_inputs(ZpStatics *s, int inputs) {
  const ZpActuatorDef *def = &s->member->model->def;
  if (inputs & ZP_SETS_LOAD) s->load = s->own_load;
  if (inputs & ZP_SETS_VOLTAGE) s->U = zp_drive_voltage(s->model);
  if (inputs & ZP_SETS_MODES_VOLTAGE) s->U = def->modes.voltage;
  if (inputs & ZP_SETS_OPENING) s->opening = zp_held_opening(s->model);
}

/* -- neighbouring actuators ----------------------------------------------------------------------- */

/* Far above the rounding of forces, far below the change over which any law varies. */
static const double part = 5e-5;

static size_t reserve(ZpRestSensitivity *p, void *block) {
  ZpArena arena = {block, 0};
  size_t lanes = p->at->members * zp_lanes(p->at->member->model), n = p->at->n;
  p->rate = zp_arena_take(&arena, 2 * lanes);
  p->motion = zp_arena_take(&arena, zp_coordinates(p->at->member->model));
  p->tension = zp_arena_take(&arena, lanes);
  p->squeezed = zp_arena_take(&arena, p->at->members);
  double **vectors[] = {&p->by_key, &p->by_parameter, &p->row};
  for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++)
    *vectors[k] = zp_arena_take(&arena, n);
  return arena.used;
}

/* A platform that is held carries no load, so nothing depends on its keys: there are no neighbours. */
static bool depends_on(const ZpStatics *at, int key) {
  static const ZpKeyGroup load = ZP_KEY_GROUP(load);
  return isnan(at->opening) || key < load.first || key >= load.end;
}

ZpStatus zp_rest_sensitivity_open(ZpRestSensitivity *p, ZpStatics *at, int key, ZpError *err) {
  *p = (ZpRestSensitivity){.at = at, .key = key, .exact = true};
  p->memory = zp_calloc(1, reserve(p, NULL));
  if (!p->memory) return zp_fail_memory(err);
  reserve(p, p->memory);
  ZpStatus status = depends_on(at, key) ? zp_finite_difference_open(&p->by, at->model, key, part, err) : ZP_OK;
  for (int k = 0; k < p->by.count && status == ZP_OK; k++)
    if (!zp_statics_create(p->by.near[k].model, at->linked, &p->near[k])) status = zp_fail_memory(err);
  return status;
}

void zp_rest_sensitivity_close(ZpRestSensitivity *p) {
  for (int k = 0; k < p->by.count; k++)
    zp_statics_destroy(&p->near[k]);
  zp_finite_difference_close(&p->by);
  zp_free(p->memory);
  p->memory = NULL;
}

/* -- states of them ------------------------------------------------------------------------------- */

/* Member k of one in the present state of the other, with its coordinates scaled as its length. */
static void place_member(const ZpRestMember *at, ZpRestMember *near) {
  memcpy(near->q, at->q, zp_coordinates(at->model) * sizeof *near->q);
  near->closed = at->closed;
  near->tension[zp_pressure_place(near->model)] = at->tension[zp_pressure_place(at->model)];
  if (near->model->L != at->model->L) zp_stretch(near->model, near->model->L / at->model->L, near->q);
}

/* Bodies in the plane with the present unknowns, or with those that the last solution gives at an offset. */
static void stand(ZpRestSensitivity *p, ZpStatics *near, double offset) {
  const ZpStatics *at = p->at;
  zp_plane_gather(&at->plane, at->form.inner, at->pose, p->row);
  for (size_t i = at->form.inner; i < at->n && offset != 0; i++)
    p->row[i] += offset * p->by_key[i];
  zp_plane_poses(&near->plane, near->form.inner, p->row, near->pose);
  for (size_t which = 0; which < near->members; which++)
    zp_plane_put_platform(&near->plane, which, near->pose, 1, near->member[which].q);
}

/* Actuator k in the present state. */
static ZpStatics *place(ZpRestSensitivity *p, int k) {
  const ZpStatics *at = p->at;
  ZpStatics *near = &p->near[k];
  for (size_t which = 0; which < at->members; which++)
    place_member(&at->member[which], &near->member[which]);
  if (at->model->network->plane) stand(p, near, 0);
  zp_statics_rejoin(near);
  near->U = at->U;
  near->bias = at->bias;
  near->load = at->load;
  near->opening = at->opening;
  near->contact_acts = at->contact_acts;
  set_inputs(near, p->inputs);
  return near;
}

/* Where the numbers of a member begin, of `per_node` for each node. */
static double *of_member(const ZpRestSensitivity *p, double *numbers, size_t which, size_t per_node) {
  return numbers + which * per_node * zp_lanes(p->at->member->model);
}

/* Actuator k at the coordinates that the last solution gives. */
static ZpStatics *place_along(ZpRestSensitivity *p, int k) {
  ZpStatics *near = place(p, k);
  const double offset = p->by.near[k].offset;
  size_t lanes = zp_lanes(p->at->member->model);
  for (size_t which = 0; which < near->members; which++) {
    const ZpRestMember *at = &p->at->member[which];
    const double *rate = of_member(p, p->rate, which, 2), *tension = of_member(p, p->tension, which, 1);
    for (size_t i = 0; i < 2 * lanes; i++)
      near->member[which].q[i] = at->q[i] + offset * rate[i];
    for (size_t j = 0; j < lanes; j++)
      near->member[which].tension[j] = at->tension[j] + offset * tension[j];
  }
  if (near->model->network->plane) stand(p, near, offset);
  return near;
}

static void residual(ZpStatics *s, double *r) {
  zp_statics_system(s).residual(s, r, NULL);
}

/* Add a member's part of rate and tension, times `weight`. */
static void add_scaling(ZpRestSensitivity *p, size_t which, const ZpRestMember *near, double weight) {
  const ZpRestMember *at = &p->at->member[which];
  size_t lanes = zp_lanes(at->model), edges = at->model->count - at->model->s;
  double *rate = of_member(p, p->rate, which, 2), *tension = of_member(p, p->tension, which, 1);
  for (size_t i = 0; i < 2 * lanes; i++)
    rate[i] += weight * (near->q[i] - at->q[i]);
  for (size_t j = 0; j < edges; j++)
    tension[j] += weight * (near->eval.edges.T[j] - at->eval.edges.T[j]);
  p->squeezed[which] += weight * (near->eval.pressure - at->eval.pressure);
}

/* Do coordinates keep their places as the key changes? */
static bool stay(const ZpRestSensitivity *p, size_t which) {
  const ZpRestMember *at = &p->at->member[which], *near = &p->near[0].member[which];
  return memcmp(at->q, near->q, zp_coordinates(at->model) * sizeof *at->q) == 0;
}

/* Derivatives of a member's forces, at the coordinates that the neighbours are at, and of its tensions. */
static void add_forces(ZpRestSensitivity *p, size_t which) {
  ZpRestMember *at = &p->at->member[which];
  const ZpSpan here = zp_statics_span(p->at, which);
  ZpNear near[ZP_DIFFERENCE_POINTS] = {{0}};
  ZpSpan rate = {0}; /* of the inputs */
  for (int k = 0; k < p->by.count; k++) {
    const ZpRestMember *m = &p->near[k].member[which];
    const ZpSpan there = zp_statics_span(&p->near[k], which);
    const double weight = p->by.near[k].weight;
    near[k] = (ZpNear){m->model, &p->near[k].member[which].eval, m->q, weight, m->force};
    rate.U1 += weight * (there.U1 - here.U1);
    rate.hung += weight * (there.hung - here.hung);
    rate.load += weight * (there.load - here.load);
  }
  const int key = stay(p, which) ? zp_key_of_neighbour(at->model, near[0].model, p->by.near[0].offset) : -1;
  p->exact &= zp_system_by_key(at->model, &here, &at->eval, key, near, p->by.count, at->moved, at->force);
  zp_weight_by_load(at->model, rate.hung, rate.load, at->force);
  zp_assembly_add(&at->assembly, at->force, p->by_key);
  if (rate.U1 != 0) {
    ZpByVoltage by = {.force = at->force};
    zp_system_by_voltage(at->model, &here, &at->eval, &by);
    for (size_t i = 0; i < zp_coordinates(at->model); i++)
      at->force[i] *= rate.U1;
    zp_assembly_add(&at->assembly, at->force, p->by_key);
  }
  for (int k = 0; k < p->by.count; k++)
    add_scaling(p, which, &p->near[k].member[which], near[k].weight);
}

/* Springs between bodies, where the neighbours are. The weights of all sum to 0. */
static void add_springs(ZpRestSensitivity *p) {
  const size_t n = p->at->n;
  for (int k = 0; k < p->by.count; k++) {
    ZpStatics *near = &p->near[k];
    residual(near, p->row);
    memset(p->row, 0, n * sizeof *p->row);
    zp_springs_add_force(&near->springs, near->share, near->at, near->at, p->row);
    for (size_t i = 0; i < n; i++)
      p->by_key[i] += p->by.near[k].weight * p->row[i];
  }
}

/* Of bodies in the plane, on which members stand: all forces, where the neighbours are. */
static void add_all(ZpRestSensitivity *p) {
  p->exact = false;
  for (int k = 0; k < p->by.count; k++) {
    const double weight = p->by.near[k].weight;
    residual(&p->near[k], p->row);
    for (size_t i = 0; i < p->at->n; i++)
      p->by_key[i] += weight * p->row[i];
    for (size_t which = 0; which < p->at->members; which++)
      add_scaling(p, which, &p->near[k].member[which], weight);
  }
}

/* Derivatives by the key if nothing moves except by scaling: forces => by_key, coordinates => rate, tensions,
 * reaction. */
static void differentiate(ZpRestSensitivity *p) {
  ZpStatics *at = p->at;
  size_t lanes = at->members * zp_lanes(at->member->model);
  double away = 0; /* of the held platform from where it is held */
  memset(p->rate, 0, 2 * lanes * sizeof *p->rate);
  memset(p->tension, 0, lanes * sizeof *p->tension);
  memset(p->by_key, 0, at->n * sizeof *p->by_key);
  memset(p->squeezed, 0, at->members * sizeof *p->squeezed);
  for (int k = 0; k < p->by.count; k++)
    away += p->by.near[k].weight * zp_statics_away(place(p, k));
  if (at->model->network->plane) add_all(p);
  for (size_t which = 0; which < at->members && p->by.count > 0 && !at->model->network->plane; which++)
    add_forces(p, which);
  if (at->springs.count > 0) add_springs(p);
  p->reaction = zp_statics_hold_rate(at, away, p->by_key);
}

/* -- solutions ------------------------------------------------------------------------------------ */

/* The exact stiffness at the present point => K; the effect of the held platform's motion on the other equations, in
 * r. */
static void stiffness(ZpRestSensitivity *p, double *r) {
  ZpStatics *at = p->at;
  residual(at, p->at->newton.r);
  zp_statics_take_tensions(at);
  zp_statics_system(at).stiffness(at, &p->at->newton.K, r);
}

/* dq/dp less the scaling is in by_key. */
static void add_motion(ZpRestSensitivity *p, size_t which) {
  const ZpRestMember *m = &p->at->member[which];
  const ZpModel *model = m->model;
  const ZpEdges *e = &m->eval.edges;
  double *rate = of_member(p, p->rate, which, 2), *tension = of_member(p, p->tension, which, 1);
  const double *x = p->motion, *y = zp_nodes(model, x).y;
  zp_assembly_changes(&m->assembly, p->by_key, p->motion);
  for (size_t i = 0; i < zp_coordinates(model); i++)
    rate[i] += p->motion[i];
  for (size_t j = 0; j < model->count - model->s; j++) {
    double dx = x[j + model->s] - x[j], dy = y[j + model->s] - y[j];
    tension[j] += model->rod.S[j] * (e->ux[j] * dx + e->uy[j] * dy);
  }
}

/* The pressure of a pouch, kept behind the tensions, changes by what (40.6) leaves of the rate of its volume => the
 * forces of that, added to r; the change over the whole rate. */
static double add_pressure(ZpRestSensitivity *p, size_t which, double *r) {
  ZpRestMember *m = &p->at->member[which];
  const ZpModel *model = m->model;
  const ZpSpan span = zp_statics_span(p->at, which);
  if (zp_pouch_rank(model) == 0) return 0;
  zp_assembly_changes(&m->assembly, p->by_key, p->motion);
  double *rate = of_member(p, p->tension, which, 1) + zp_pressure_place(model);
  double change = p->squeezed[which] + zp_pouch_predicted(model, &span, &m->eval, p->motion, 1) - m->eval.pressure;
  *rate += change;
  for (size_t i = 0; i < zp_coordinates(model); i++)
    m->force[i] = change * m->eval.by_volume[i];
  zp_assembly_add(&m->assembly, m->force, r);
  return *rate != 0 ? fabs(change / *rate) : 0;
}

/* Forces => motion, which adds to that in by_key, and its reaction. */
static void solve(ZpRestSensitivity *p, double *r) {
  zp_arrow_solve(&p->at->newton.K, r);
  if (zp_statics_holds(p->at)) p->reaction -= zp_statics_lifts(p->at) * zp_dot(p->at->n, p->at->row, r);
  for (size_t i = 0; i < p->at->n && r != p->by_key; i++)
    p->by_key[i] += r[i];
}

/* Each pass leaves the stiffness of the films over that of (40.6), mostly a thousandth, of the last change. */
static bool solve_pressures(ZpRestSensitivity *p) {
  enum { MOST_PASSES = 100 };
  static const double enough = 1e-10;
  for (int pass = 0; pass < MOST_PASSES; pass++) {
    double change = 0;
    memset(p->row, 0, p->at->n * sizeof *p->row);
    for (size_t which = 0; which < p->at->members; which++)
      change = fmax(change, add_pressure(p, which, p->row));
    if (change <= enough) return true;
    p->reaction += zp_statics_hold_rate(p->at, 0, p->row);
    solve(p, p->row);
  }
  return false;
}

static void set_modulus(ZpRestSensitivity *p, double modulus) {
  for (size_t which = 0; which < p->at->members; which++) {
    p->at->member[which].modulus = modulus;
    for (int k = 0; k < p->by.count; k++)
      p->near[k].member[which].modulus = modulus;
  }
}

static bool solve_all(ZpRestSensitivity *p) {
  differentiate(p);
  stiffness(p, p->by_key);
  if (!zp_arrow_factor(&p->at->newton.K)) return false;
  solve(p, p->by_key);
  if (!solve_pressures(p)) return false;
  for (size_t which = 0; which < p->at->members; which++)
    add_motion(p, which);
  return true;
}

bool zp_rest_sensitivity_solve(ZpRestSensitivity *p, int inputs) {
  p->inputs = inputs;
  set_modulus(p, zp_pouch_modulus_of_rates);
  const bool solved = solve_all(p);
  set_modulus(p, zp_pouch_modulus);
  return solved;
}

const double *zp_rest_sensitivity_member(const ZpRestSensitivity *p, size_t which) {
  return of_member(p, p->rate, which, 2);
}

const double *zp_rest_sensitivity_bodies(const ZpRestSensitivity *p) {
  return p->by_key + p->at->form.inner;
}

double zp_rest_sensitivity_of(ZpRestSensitivity *p, ZpOutput output, void *user) {
  double sum = 0;
  for (int k = 0; k < p->by.count; k++) {
    ZpStatics *near = place_along(p, k);
    residual(near, p->row);
    sum += p->by.near[k].weight * output(near, user);
  }
  return sum;
}

/* -- limits --------------------------------------------------------------------------------------- */

/* dF/dp and dF/dm, both multiplied by the inverse stiffness. */
static bool solve_both(ZpRestSensitivity *p, int inputs, const ZpBranchSystem *branch) {
  p->inputs = inputs;
  differentiate(p);
  stiffness(p, NULL);
  branch->sensitivity(p->at, p->by_parameter);
  if (!zp_arrow_factor(&p->at->newton.K)) return false;
  zp_arrow_solve(&p->at->newton.K, p->by_key);
  zp_arrow_solve(&p->at->newton.K, p->by_parameter);
  return true;
}

/* Is the stiffness singular here, as at a smooth limit point, or does the branch turn at a corner of a law? */
static bool is_smooth(const ZpRestSensitivity *p, const ZpBranchSystem *branch) {
  static const double least = 1e3; /* longest steps per change of the parameter by itself; a corner has about 1 */
  return branch->at_rest.length(p->at, p->by_parameter) * fabs(zp_branch_parameter(branch)) > least;
}

/* Near a limit point K^-1 is a large multiple of the null vector times the left null vector. So a quotient of two
 * solutions is a quotient of two products with the left null vector. Solved twice, other soft motions, as of members
 * that nearly reach their limit points together, are left out to second order. */
double zp_rest_sensitivity_of_fold(ZpRestSensitivity *p, int inputs, const ZpBranchSystem *branch, const double *null) {
  size_t n = p->at->n;
  if (!solve_both(p, inputs, branch)) return n == 1 ? -p->by_key[0] / p->by_parameter[0] : NAN; /* K is 0 */
  if (!is_smooth(p, branch)) return NAN;
  zp_arrow_solve(&p->at->newton.K, p->by_key);
  zp_arrow_solve(&p->at->newton.K, p->by_parameter);
  return -zp_dot(n, null, p->by_key) / zp_dot(n, null, p->by_parameter);
}

double zp_rest_sensitivity_of_event(ZpRestSensitivity *p, int inputs, const ZpBranchSystem *branch, ZpEvent event,
                                    double rate, double by_parameter) {
  size_t n = p->at->n;
  if (!solve_both(p, inputs, branch)) return NAN;
  double direct = 0;
  for (int k = 0; k < p->by.count; k++) {
    ZpStatics *near = place(p, k);
    residual(near, p->row);
    direct += p->by.near[k].weight * event(near, NULL);
  }
  event(p->at, p->row);
  return (rate - direct - zp_dot(n, p->row, p->by_key)) / (zp_dot(n, p->row, p->by_parameter) - by_parameter);
}

/* -- outputs -------------------------------------------------------------------------------------- */

double zp_output_stroke(ZpStatics *s, void *user) {
  (void)user;
  return zp_statics_stroke(s);
}

double zp_output_opening(ZpStatics *s, void *user) {
  (void)user;
  return zp_statics_opening(s);
}

double zp_output_angle(ZpStatics *s, void *user) {
  (void)user;
  return zp_statics_angle(s);
}
