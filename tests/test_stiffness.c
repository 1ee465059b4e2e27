/* The assembled stiffness of a whole actuator against differences of its forces, entry by entry. A wrong entry shows
 * nowhere else: equilibria are still found, in more iterations, and only their stability may come out wrong. */
#include "check_util.h"

#include "rest/rest.h"
#include "run/run.h"

enum { MOST = 60 }; /* equations */

typedef struct Case {
  const char *name;
  Setting setting[12];
  size_t count;
  double gap; /* of the faces, far from each other or within the range of contact, m */
  double U;   /* V */
  bool contact;
} Case;
#define SET(...) {__VA_ARGS__}, sizeof((const Setting[]){__VA_ARGS__}) / sizeof(Setting)

/* Ribbons so soft that attraction is as stiff as they are. */
#define SOFT                                                                                                           \
  {"mesh.nodes", 8}, {"ribbon.young_modulus", 1e6}, {                                                                  \
    "electro.breakdown_cap", 0                                                                                         \
  }
#define CAPPED                                                                                                         \
  {"mesh.nodes", 8}, {"ribbon.young_modulus", 1e6}, {                                                                  \
    "electro.breakdown_cap", 1                                                                                         \
  }
#define FLANGE                                                                                                         \
  {"actuator.kind", ZP_KIND_FLANGE}, {                                                                                 \
    "electro.gap_offset", 2e-4                                                                                         \
  }

#define CURVED                                                                                                         \
  {"actuator.kind", ZP_KIND_CURVED}, {"insulator.thickness", 0}, {                                                     \
    "lower.insulator.thickness", 2e-4                                                                                  \
  }
#define FOLD                                                                                                           \
  {"actuator.kind", ZP_KIND_HINGE}, {"hinge.stiffness", 1e-4}, {                                                       \
    "hinge.rest_angle", 0.5                                                                                            \
  }

static const Case cases[] = {
    {"two ribbons", SET(SOFT), 1e-4, 0, false},
    {"attraction", SET(SOFT), 1e-4, 5e3, false},
    {"attraction with cap", SET(CAPPED), 1e-4, 5e3, false},
    {"attraction with edges", SET(SOFT, {"electro.edges", 1}), 1e-4, 5e3, false},
    {"faces in touch", SET(SOFT, {"drive.voltage", 10}), 4.5e-7, 0, true},
    {"faces in touch under voltage", SET(SOFT, {"drive.voltage", 10}), 4.5e-7, 5e3, true},
    {"spring beside the load",
     SET(SOFT, {"insulator.young_modulus", 0}, {"load.stiffness", 1e3}, {"load.rest_opening", 1e-2}), 1e-4, 0, false},
    {"stop", SET(SOFT, {"insulator.young_modulus", 0}, {"load.stop_opening", 1e-6}, {"load.stop_stiffness", 1e3}), 1e-4,
     0, false},
    {"whole actuator", SET(SOFT, {"actuator.symmetry", ZP_SYMMETRY_NONE}), 1e-4, 5e3, false},
    {"whole actuator, faces in touch", SET(SOFT, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"drive.voltage", 10}),
     4.5e-7, 5e3, true},
    {"platform that turns", SET(SOFT, TURNS, {"load.offset", 2e-3}), 1e-4, 5e3, false},
    {"platform that turns, faces in touch", SET(SOFT, TURNS, {"drive.voltage", 10}), 4.5e-7, 5e3, true},
    {"particles", SET(SOFT, {"ribbon.model", ZP_RIBBON_MASS_SPRING}), 1e-4, 5e3, false},
    {"flange", SET(SOFT, FLANGE), 1e-4, 1e3, false},
    {"curved electrode", SET(SOFT, CURVED), 1e-4, 1e3, false},
    {"curved electrode, faces in touch", SET(SOFT, CURVED, {"drive.voltage", 10}), 4.5e-7, 1e3, true},
    {"clamped flange", SET(SOFT, FLANGE, {"actuator.right_end", ZP_END_CLAMPED}), 1e-4, 1e3, true},
    {"fold", SET(SOFT, FOLD), 1e-4, 5e3, false},
    {"fold of short thick strips, whose spring is as stiff as they are",
     SET(SOFT, FOLD, {"hinge.stiffness", 1}, {"ribbon.length", 10e-3}, {"ribbon.thickness", 1e-3},
         {"insulator.young_modulus", 0}),
     1e-4, 5e3, false},
    {"fold, faces in touch", SET(SOFT, FOLD, {"drive.voltage", 10}), 4.5e-7, 5e3, true},
    {"free ribbon", SET({"mesh.nodes", 8}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}), 0,
     0, false},
    {"yielding ribbon",
     SET({"mesh.nodes", 8}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE},
         {"ribbon.plasticity", 1}, {"ribbon.yield_stress", 1e6}, {"ribbon.hardening_modulus", 30e9}),
     0, 0, false},
    {"yielding ribbons with stiff tapes",
     SET({"mesh.nodes", 8}, {"ribbon.plasticity", 1}, {"ribbon.yield_stress", 1e6}, {"insulator.young_modulus", 5e9}),
     1e-4, 0, false},
    {"clamped ribbon",
     SET({"mesh.nodes", 8}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_CLAMPED}), 0, 0, false},
};

/* Bent at random, gaps about `gap`: the present point of `s`. */
static void bend(ZpStatics *s, double gap) {
  const ZpModel *model = s->member->model;
  uint64_t seed = 5;
  double *x = s->member->q, *y = s->member->q + model->stride;
  for (size_t j = 0; j < model->count; j++) {
    size_t upper = model->s == 2 ? j - j % 2 : j;
    bool lower = j != upper;
    if (s->member->assembly.equation[2 * j] >= 0) x[j] += 0.1 * model->l * noise(&seed);
    double rise = gap > 0 ? 0.3 * gap * noise(&seed) : 0.1 * model->l * noise(&seed);
    double from = model->flat ? model->plates.face[j] - gap : 0;
    y[j] = lower ? y[upper] - gap - rise : from + rise;
  }
  const ZpTies ties = zp_ties_of(model, 1, 0);
  for (const ZpTie *tie = ties.tie; tie < ties.tie + ties.count; tie++) {
    double *q = tie->to % 2 ? y : x;
    q[tie->coordinate / 2] = tie->factor * q[tie->to / 2] + tie->offset;
  }
}

/* Move what equation `row` stands for. */
static void shift(ZpStatics *s, size_t row, double by) {
  for (size_t k = 0; k < 2 * s->member->model->count; k++)
    if (s->member->assembly.equation[k] == (int)row) s->member->q[k / 2 + (k % 2) * s->member->model->stride] += by;
}

/* Largest difference between the stiffness K and forces r, column by column, over the largest entry. */
static double worst_entry(ZpStatics *s, const ZpStaticSystem *system, const ZpBand *K, double by) {
  double worst = 0, largest = 0, up[MOST], down[MOST];
  for (size_t j = 0; j < system->n; j++) {
    shift(s, j, by);
    system->residual(s, up, NULL);
    shift(s, j, -2 * by);
    system->residual(s, down, NULL);
    shift(s, j, by);
    for (size_t i = 0; i < system->n; i++) {
      bool below = K->lower == 0 && i > j; /* a symmetric matrix has its upper triangle only */
      size_t row = below ? j : i, column = below ? i : j;
      bool inside = column < zp_band_end(K, row) && column + K->lower >= row;
      double entry = inside ? *zp_band_at(K, row, column) : 0;
      worst = fmax(worst, fabs(entry - (down[i] - up[i]) / (2 * by)));
      largest = fmax(largest, fabs(entry));
    }
  }
  return worst / largest;
}

TESTS(stiffness_is_the_derivative_of_the_forces, 0, LENGTH_OF(cases)) {
  const Case *c = &cases[_i];
  ZpActuatorDef def = def_with(c->setting, c->count);
  ZpModel *model = model_of(&def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  ZpStatics *s = &rest.statics;
  ZpNewtonWork *work = &rest.statics.newton;
  ZpStaticSystem system = zp_statics_system(s);
  ck_assert_uint_le(system.n, MOST);
  bend(s, c->gap);
  s->U = c->U;
  s->contact_acts = c->contact;
  system.residual(s, work->r, NULL);
  memcpy(s->member->tension, s->member->eval.edges.T, (model->count - model->s) * sizeof *s->member->tension);
  system.stiffness(s, &work->K, NULL);
  double worst = worst_entry(s, &system, &work->K.part->A, 1e-4 * (c->gap > 0 ? c->gap : 0.01 * model->l));
  printf("%s: stiffness off by %.1e\n", c->name, worst);
  ck_below(worst, 5e-8); /* 1.4e-8 measured */
  zp_rest_close(&rest);
}

/* -- over a step ------------------------------------------------------------------------------------- */

typedef struct Moving {
  const char *name;
  Setting setting[14];
  size_t count;
  double from, h; /* when the step begins, and how long it is, s */
} Moving;

#define CREEPING                                                                                                       \
  {"mesh.nodes", 8}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {                         \
    "initial.state", ZP_INITIAL_STRAIGHT                                                                               \
  }
#define PLATE                                                                                                          \
  {"actuator.kind", ZP_KIND_PLATE}, {"plate.back_gap", 6e-6}, {"plate.back_stop_gap", 1e-6}, {"plate.gap", 5e-6}, {    \
    "drive.voltage", 40                                                                                                \
  }

static const Moving moving[] = {
    {"strip and tape that creep",
     SET(CREEPING, {"insulator.young_modulus", 1e9}, {"insulator.relaxation_modulus", 50e9},
         {"insulator.relaxation_time", 1e-5}),
     1e-4, 2e-5},
    {"plate between electrodes", SET(PLATE), 1e-5, 1e-6},
    {"film behind a plate", SET(PLATE, {"liquid.model", ZP_LIQUID_SUBMERGED}, {"liquid.inertia", 0}), 1e-5, 1e-6},
};

/* Where a step turns little, its matrix is the derivative of its residual, too. */
TESTS(tangent_is_the_derivative_of_the_residual, 0, LENGTH_OF(moving)) {
  const Moving *c = &moving[_i];
  ZpActuatorDef def = def_with(c->setting, c->count);
  ZpSim *sim = sim_of(model_of(&def));
  run_to(sim, c->from);
  ZpDynamics *d = &sim->dynamics;
  const ZpImplicitSystem *system = &d->system;
  const size_t n = system->n;
  double *y = memory_of(n * sizeof *y), *unit = memory_of(n * sizeof *unit), *column = memory_of(n * sizeof *column),
         *up = memory_of(n * sizeof *up), *down = memory_of(n * sizeof *down), worst = 0, largest = 0;
  zp_dynamics_begin(d, sim->states, c->from + c->h);
  system->begin(d, d->q, d->v);
  for (size_t i = 0; i < n; i++)
    y[i] = d->q[i] + c->h * d->v[i];
  for (int twice = 0; twice < 2; twice++)
    system->residual(d, y, c->h, up);
  system->tangent(d, &d->stepper.A);
  for (size_t j = 0; j < n; j++) {
    const double by = 1e-9 * (system->scale ? system->scale[j] : 1), at = y[j];
    memset(unit, 0, n * sizeof *unit);
    unit[j] = 1;
    zp_arrow_multiply(&d->stepper.A, unit, column);
    y[j] = at + by;
    system->residual(d, y, c->h, up);
    y[j] = at - by;
    system->residual(d, y, c->h, down);
    y[j] = at;
    for (size_t i = 0; i < n; i++) {
      worst = fmax(worst, fabs(column[i] - (down[i] - up[i]) / (2 * by)));
      largest = fmax(largest, fabs(column[i]));
    }
  }
  printf("%s: tangent off by %.1e\n", c->name, worst / largest);
  ck_below(worst / largest, 1.8e-6); /* 5.9e-7 measured */
}
