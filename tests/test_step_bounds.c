/* Bounds of explicit steps: the largest stable step against the fastest vibration that there is, found by iteration;
 * the bounds of eq. (9) of the paper node by node; drag's bound in a run. */
#include "state_util.h"

#include "contact/contact.h"
#include "solve/explicit.h"
#include "system/system.h"

/* -- the fastest vibration ------------------------------------------------------------------------- */

/* A model at rest, straight and without stress, that is pushed a little. */
typedef struct Rest {
  ZpModel *model;
  ZpSim *sim;
  ZpState *state;
  ZpEval eval;
  double *q, *a0, *a;
  bool faces_press;
} Rest;

static Rest rest_of(const ZpActuatorDef *def, bool faces_press) {
  Rest r = {.model = model_of(def), .faces_press = faces_press};
  r.sim = sim_of(r.model);
  r.state = malloc(zp_state_size(r.model));
  copy_state(r.sim, r.state);
  ck_assert(zp_system_create(r.model, true, &r.eval));
  size_t n = 2 * r.model->stride;
  r.q = malloc(n * sizeof *r.q);
  r.a0 = malloc(n * sizeof *r.a0);
  r.a = malloc(n * sizeof *r.a);
  return r;
}

static void free_rest(Rest *r) {
  free(r->q);
  free(r->a0);
  free(r->a);
  free(r->state);
  zp_system_destroy(&r->eval);
}

/* Accelerations at q: of ribbons and weight, of faces that press on each other where they do. */
static void accelerate(Rest *r, const double *q, double *a) {
  const ZpModel *model = r->model;
  ZpSpan now = zp_span_of(model, r->state, q, zp_state_v(model, r->state));
  zp_system_accelerations(model, &now, &model->masses, &r->eval, a);
  static const ZpZipState clip_only = {0, false};
  zp_ties_share(model, &model->masses, &clip_only, a);
}

static double length_of(const double *v, size_t n) {
  double sum = 0;
  for (size_t k = 0; k < n; k++)
    sum += v[k] * v[k];
  return sqrt(sum);
}

/* Highest angular frequency of small vibrations, by iteration: a = -M^-1 K u grows by omega^2 a round. They are small
 * for elements and for the depth of contact, whose force is curved: vibrations of 6 % of the depth shifted the share by
 * 0.3 %. */
static double fastest(Rest *r) {
  enum { ROUNDS = 3000 };
  const ZpModel *model = r->model;
  size_t n = 2 * model->stride;
  double *at_rest = zp_state_q(model, r->state), growth = 0;
  const double small = r->faces_press ? fmin(1e-6 * model->l, 1e-3 * model->faces.depth) : 1e-6 * model->l;
  uint64_t seed = 7;
  for (size_t i = 1; r->faces_press && i < model->nodes; i++)
    at_rest[model->stride + 2 * i + 1] += 5 * model->faces.depth;
  accelerate(r, at_rest, r->a0);
  for (size_t k = 0; k < n; k++)
    r->a[k] = k % model->stride < model->count ? noise(&seed) : 0;
  for (int round = 0; round < ROUNDS; round++) {
    double scale = small / length_of(r->a, n);
    for (size_t k = 0; k < n; k++)
      r->q[k] = at_rest[k] + scale * r->a[k];
    accelerate(r, r->q, r->a);
    for (size_t k = 0; k < n; k++)
      r->a[k] -= r->a0[k];
    growth = length_of(r->a, n) / small;
  }
  return sqrt(growth);
}

#define ALONE                                                                                                          \
  {"actuator.kind", ZP_KIND_RIBBON}, {"initial.state", ZP_INITIAL_STRAIGHT}, {                                         \
    "solver.integrator", ZP_INTEGRATOR_EXPLICIT                                                                        \
  }
#define PAIR                                                                                                           \
  {"initial.state", ZP_INITIAL_STRAIGHT}, {"drive.voltage", 0}, {                                                      \
    "solver.integrator", ZP_INTEGRATOR_EXPLICIT                                                                        \
  }

/* Steel is stiffest along its length, but where elements are shorter than it is thick; there a segment may be that is
 * stiffer or lighter; springs of the paper; two ribbons; faces of stiff insulators on soft ribbons, with and without a
 * platform that is light. The step is this share of the one at which it gets unstable, but where stretching and contact
 * are as fast as each other: they do not add, and the step is shorter than it need be. */
typedef struct Vibration {
  Setting setting[12];
  size_t count;
  bool faces_press;
  double least, most;
} Vibration;
#define CASE(press, least, most, ...)                                                                                  \
  { {__VA_ARGS__}, sizeof((const Setting[]){__VA_ARGS__}) / sizeof(Setting), press, least, most }

static const Vibration vibrations[] = {
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"load.mass", 0}),
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"ribbon.thickness", 5e-3}, {"ribbon.length", 10e-3},
         {"load.mass", 0}),
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"segment_1.length", 30e-3}, {"segment_2.length", 40e-3},
         {"segment_2.thickness", 100e-6}, {"insulator.density", 4000}),
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"segment_1.length", 30e-3}, {"segment_2.length", 40e-3},
         {"segment_2.thickness", 20e-6}, {"insulator.density", 4000}),
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"ribbon.model", ZP_RIBBON_MASS_SPRING}),
    CASE(false, 0.775, 0.8, ALONE, {"mesh.nodes", 21}, {"ribbon.model", ZP_RIBBON_MASS_SPRING},
         {"mass_spring.axial", ZP_AXIAL_CODE}, {"mass_spring.shear_coefficient", 1e6}),
    CASE(false, 0.775, 0.8, PAIR, {"mesh.nodes", 21}, {"contact.model", ZP_CONTACT_SEQUENTIAL}),
    CASE(true, 0.35, 0.5, PAIR, {"mesh.nodes", 21}),
    CASE(true, 0.49, 0.5, PAIR, {"mesh.nodes", 21}, {"ribbon.young_modulus", 1e6}, {"ribbon.thickness", 5e-6},
         {"insulator.thickness", 10e-6}, {"platform.length", 0}, {"load.mass", 1}),
    CASE(true, 0.49, 0.5, PAIR, {"mesh.nodes", 21}, {"ribbon.young_modulus", 1e6}, {"ribbon.thickness", 5e-6},
         {"insulator.thickness", 10e-6}, {"platform.length", 20e-3}, {"load.mass", 0}),
    CASE(true, 0.49, 0.5, PAIR, {"mesh.nodes", 21}, {"ribbon.young_modulus", 1e6}, {"ribbon.thickness", 5e-6},
         {"insulator.thickness", 10e-6}, {"platform.length", 20e-3}, {"load.mass", 20e-6}),
};

TESTS(stable_step_is_that_of_the_fastest_vibration, 0, LENGTH_OF(vibrations)) {
  const Vibration *v = &vibrations[_i];
  ZpActuatorDef def = def_with(v->setting, v->count);
  Rest r = rest_of(&def, v->faces_press);
  double share = 0.5 * fastest(&r) * r.model->stable_step;
  printf("vibration %d: steps of %.4f of the unstable one\n", _i, share);
  ck_assert_double_ge(share, v->least);
  ck_assert_double_le(share, v->most * (1 + 1e-6));
  free_rest(&r);
}

/* -- eq. (9) of the paper, node by node ------------------------------------------------------------- */

/* Bent and uneven, each node at a speed of its own; the platform's and the clip's, too. */
static void bend(const ZpModel *model, ZpState *state) {
  double *q = zp_state_q(model, state), *v = zp_state_v(model, state);
  uint64_t seed = 3;
  for (size_t j = 0; j < model->count; j++) {
    q[j] += 0.3 * model->l * noise(&seed);
    q[model->stride + j] += 0.3 * model->l * noise(&seed);
    v[j] = noise(&seed);
    v[model->stride + j] = noise(&seed);
  }
}

/* 2 m / (c |v|), 2 |dp| / |v|, 2 |dy| / |v| of node j and the edge on its right, dy seen from the edge on its left. */
static ZpStepBounds bounds_of(const ZpModel *model, const ZpState *state, size_t j) {
  ZpMotion m = zp_state_motion(model, state);
  size_t s = model->s;
  double v = sqrt(m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
  ZpStepBounds bounds = {2 * model->mass[j] / (model->def.damping.drag * v), INFINITY, INFINITY};
  if (j + s >= model->count) return bounds;
  double dx = m.x[j + s] - m.x[j], dy = m.y[j + s] - m.y[j], bx = 1, by = 0;
  if (j >= s) {
    bx = m.x[j] - m.x[j - s];
    by = m.y[j] - m.y[j - s];
  }
  bounds.axial = 2 * sqrt(dx * dx + dy * dy) / v;
  bounds.shear = 2 * fabs(bx * dy - by * dx) / sqrt(bx * bx + by * by) / v;
  return bounds;
}

static void check_bounds(const ZpActuatorDef *def) {
  Rest r = rest_of(def, false);
  const ZpModel *model = r.model;
  ZpStepBounds least = {INFINITY, INFINITY, INFINITY};
  double power = 0;
  bend(model, r.state);
  for (size_t j = 0; j < model->count; j++) {
    ZpStepBounds at = bounds_of(model, r.state, j);
    least.drag = fmin(least.drag, at.drag);
    least.axial = fmin(least.axial, at.axial);
    least.shear = fmin(least.shear, at.shear);
    power += def->damping.drag * pow(2 * model->mass[j] / (def->damping.drag * at.drag), 3);
  }
  ZpSpan now = zp_span_of(model, r.state, zp_state_q(model, r.state), zp_state_v(model, r.state));
  zp_system_accelerations(model, &now, &model->masses, &r.eval, r.a);
  ZpStepBounds bounds = zp_eval_step_bounds(model, r.state, &r.eval);
  ck_near(bounds.drag, least.drag, 1e-12);
  ck_near(bounds.axial, least.axial, 1e-12);
  ck_near(bounds.shear, least.shear, 1e-12); /* 2.2e-16 measured */
  ck_near(r.eval.drag_power, power, 1e-12);
  free_rest(&r);
}

TEST(bounds_are_the_least_of_all_nodes) {
  ZpActuatorDef one = DEF(ALONE, {"mesh.nodes", 21}, {"damping.drag", 3});
  ZpActuatorDef two = DEF(PAIR, {"mesh.nodes", 21}, {"damping.drag", 3});
  ZpActuatorDef particles = DEF(PAIR, {"mesh.nodes", 21}, {"damping.drag", 3}, {"ribbon.model", ZP_RIBBON_MASS_SPRING});
  check_bounds(&one);
  check_bounds(&two);
  check_bounds(&particles);
}

/* -- drag in a run --------------------------------------------------------------------------------- */

/* Run on to `end` with rows. */
static ZpRunInfo run_with_rows(ZpSim *sim, double end) {
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 100);
  ZpRunInfo info;
  zp_sim_record(sim, series, NULL);
  ck_assert_int_eq(zp_sim_run(sim, end, false, NULL, &info), ZP_REACHED_END);
  zp_sim_record(sim, NULL, NULL);
  zp_table_destroy(series);
  return info;
}

/* A limp strand that falls at v_t = sqrt(m g / c), with steps so short that drag does not limit them: a run reports the
 * first bounds of eq. (9), the smallest over its rows. From there on without these steps: half of the bound, m / (c
 * v_t), each. */
TEST(drag_bounds_the_steps) {
  const double c = 1e6, time = 1e-4, m = 7850 * 12.7e-3 * 50e-6 * 45e-3 / 21, v_t = sqrt(m * 9.81 / c);
  ZpActuatorDef def = DEF(ALONE, {"actuator.right_end", ZP_END_FREE}, {"ribbon.length", 45e-3}, {"mesh.nodes", 21},
                          {"ribbon.model", ZP_RIBBON_MASS_SPRING}, {"mass_spring.axial", ZP_AXIAL_CODE},
                          {"mass_spring.shear_coefficient", 0}, {"load.mass", 0}, {"damping.drag", c},
                          {"solver.end_time", time}); /* rows are as many for any */
  ZpModel *model = model_of(&def);
  def.solver.time_step = 1e-7;
  ZpSim *sim = sim_of(model), *start = sim_of(model_of(&def));
  size_t size = zp_sim_state_size(start);
  void *state = memory_of(size);
  run_with_rows(start, time);
  ZpRunInfo info = run_with_rows(start, 2 * time);
  ck_near(info.smallest_bound[0], 2 * m / (c * v_t), 1e-12);  /* 4.5e-14 measured */
  ck_near(info.smallest_bound[1], 2 * model->l / v_t, 1e-12); /* 4.6e-14 measured */
  ck_assert_double_eq(info.smallest_bound[2], 0);             /* straight */
  zp_sim_save(start, state);
  ck_assert_int_eq(zp_sim_restore(sim, state, size, NULL), ZP_OK);
  info = run_with_rows(sim, 3 * time);
  ck_assert_double_le(fabs((double)info.steps - ceil(time * c * v_t / m)), 1); /* step */
  ck_assert_int_ge(info.limited[ZP_LIMIT_DRAG], info.steps - 1);
}

/* A strip released from straight is fastest half way and at rest at the end: the smallest bound is that half way. */
TEST(bounds_are_the_least_of_all_rows) {
  const double c = 1e-4, m = 7850 * 12.7e-3 * 50e-6 * 45e-3 / 21;
  ZpActuatorDef def = DEF(ALONE, {"ribbon.length", 45e-3}, {"mesh.nodes", 21}, {"ribbon.model", ZP_RIBBON_MASS_SPRING},
                          {"mass_spring.axial", ZP_AXIAL_CODE}, {"load.mass", 0}, {"damping.drag", c});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  double fastest = 0;
  ZpRunInfo info;
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 1000);
  zp_sim_record(sim, series, NULL);
  ck_assert_int_eq(zp_sim_run(sim, 15e-3, false, NULL, &info), ZP_REACHED_END);
  for (size_t i = 0; i < series->rows; i++)
    fastest = fmax(fastest, fabs(zp_table_get(series, i, "end_velocity_m_per_s")));
  double last = fabs(zp_table_get(series, series->rows - 1, "end_velocity_m_per_s"));
  ck_below(last, 0.3 * fastest);
  ck_near(info.smallest_bound[0], 2 * m / (c * fastest), 2e-4);  /* 5e-5 measured */
  ck_near(info.smallest_bound[1], 2 * model->l / fastest, 2e-2); /* by the node before the end */
  zp_table_destroy(series);
}

/* -- the end of a run ------------------------------------------------------------------------------ */

static double two_seconds(void *self, const double *q, const double *v, double *a) {
  (void)self, (void)q, (void)v;
  a[0] = 0;
  return 2;
}

/* A bound that is just what is left until the end: the end, so that its time is reached exactly. */
TEST(bound_at_the_end_is_the_end) {
  ZpExplicitSystem system = {1, NULL, two_seconds, NULL};
  double q = 0, v = 1, a;
  ZpExplicitStep step = zp_explicit_step(&system, 2, &q, &v, &a);
  ck_assert(step.dt == 2 && step.limit == ZP_EXPLICIT_END);
}
