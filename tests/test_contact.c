/* The zipping state machine: when pairs meet, what joining does, how the front moves; and its invariants
 * during runs of the actuator.
 *
 * Against: closed-form roots of the relative motion g + w s + c s^2 of one step, conservation of momentum and
 * the loss of an inelastic impact, m1 m2 / (m1 + m2) dv^2 / 2, rows of pairs that switch, and the invariants of
 * paper/zip.h. */
#include "state_util.h"

#include "actuator/ties.h"
#include "paper/zip.h"

/* -- meetings -------------------------------------------------------------------------------------- */

enum { NODES = 6 };

/* Relative motion of a pair: gap g, its velocity w and acceleration c, and when it closes, NAN: not in dt. */
typedef struct Motion {
  double g, w, c, dt, meets;
} Motion;

static const Motion motions[] = {
    {1, -1, 0, 2, 1},             /* steady */
    {1, -1, 0, 0.5, NAN},         /* too slow */
    {1, -2, 0, 0.5 + 1e-12, 0.5}, /* just in time */
    {1, 0, -1, 2, 1},             /* from rest */
    {1, 1, -2, 2, 1},             /* turns round first */
    {1, 1, -2, 0.9, NAN},
    {1, -3, 2, 2, 0.5},           /* first of two roots, 1/2 and 1 */
    {1, -1, 1, 5, NAN},           /* braked before it touches */
    {1, -2, 1, 5, 1},             /* touches tangentially */
    {1, -2, 1 + 1e-9, 5, NAN},    /* just does not */
    {1, 1, 1, 5, NAN},            /* parts */
    {1, 0, 0, 5, NAN},            /* rests */
    {1e-18, -1e-6, 0, 1, 1e-12},  /* the last bit */
    {1e-3, -1e-9, -1e3, 1, 1e-3}, /* hardly moving, hard pulled */
    {1e-3, -1, 1e-9, 1, 1e-3},    /* the other root is far off */
    {0, -1, 0, 1, 0},             /* touching and closing: at once */
    {0, 0, -1, 1, 0},
    {0, -1, 5, 1, 0},
    {-1e-9, -1, 0, 1, 0}, /* overlapping by rounding and closing */
    {0, 0, 0, 1, NAN},    /* touching at rest */
    {0, 1, 0, 1, NAN},    /* touching and parting */
    {0, 0, 1, 1, NAN},
    {-1e-9, 1, 0, 1, NAN},
};

/* All pairs far apart and at rest but pair i, whose motion is `m`, shared by its nodes. */
static void place(size_t i, Motion m, double *y, double *vy, double *ay) {
  for (size_t j = 0; j < 2 * NODES; j++) {
    y[j] = j % 2 ? -100 : 100;
    vy[j] = ay[j] = 3; /* common motion does not count */
  }
  y[2 * i] = 0.25 * m.g;
  y[2 * i + 1] = -0.75 * m.g;
  vy[2 * i] = 0.5 * m.w;
  vy[2 * i + 1] = -0.5 * m.w;
  ay[2 * i] = m.c;
  ay[2 * i + 1] = 0;
}

static void check_meeting(ZpZipState state, size_t i, Motion m) {
  double y[2 * NODES], vy[2 * NODES], ay[2 * NODES];
  place(i, m, y, vy, ay);
  size_t pair = 77;
  double s = zp_zip_next(&state, NODES, y, vy, ay, m.dt, &pair);
  if (isnan(m.meets)) {
    ck_assert_msg(s == m.dt && pair == 77, "g %g w %g c %g: meets at %g", m.g, m.w, m.c, s);
    return;
  }
  ck_assert_msg(pair == i, "g %g w %g c %g: no meeting", m.g, m.w, m.c);
  /* tangential: root of rounding, 1.5e-8; 5e-10 measured */
  ck_assert_double_eq_tol(s, m.meets, 2e-8 * m.meets + 1e-15);
}

TESTS(test_meeting_time, 0, LENGTH_OF(motions)) {
  check_meeting((ZpZipState){2, false}, 3, motions[_i]);         /* the next pair */
  check_meeting((ZpZipState){0, false}, 1, motions[_i]);         /* after the clip */
  check_meeting((ZpZipState){2, false}, NODES - 1, motions[_i]); /* the platform ahead of the front */
  check_meeting((ZpZipState){NODES - 2, false}, NODES - 1, motions[_i]);
}

/* A pair that touches, parts, and comes back within the step meets then: 0 + s - s^2 at s = 1. */
TEST(test_touching_pair_comes_back) {
  check_meeting((ZpZipState){2, false}, 3, (Motion){0, 1, -1, 5, 1});
  check_meeting((ZpZipState){2, false}, 3, (Motion){0, 1, -1, 0.9, NAN});
}

/* Only the next pair and the platform are looked at; pairs that are joined are not. */
TEST(test_who_may_meet) {
  Motion m = {1, -1, 0, 2, NAN};
  for (size_t i = 0; i < NODES; i++)
    if (i != 3 && i != NODES - 1) check_meeting((ZpZipState){2, false}, i, m);
  check_meeting((ZpZipState){2, true}, NODES - 1, m);
  for (size_t i = 0; i < NODES; i++)
    check_meeting((ZpZipState){NODES - 1, true}, i, m);
}

TEST(test_first_of_two) {
  double y[2 * NODES], vy[2 * NODES], ay[2 * NODES];
  for (int platform_first = 0; platform_first < 2; platform_first++) {
    place(3, (Motion){1, -1, 0, 0, 0}, y, vy, ay);
    y[2 * NODES - 2] = platform_first ? 0.5 : 1.5; /* and the platform at the same speed */
    y[2 * NODES - 1] = 0;
    vy[2 * NODES - 2] = -1;
    vy[2 * NODES - 1] = ay[2 * NODES - 2] = ay[2 * NODES - 1] = 0;
    size_t pair = 77;
    ZpZipState state = {2, false};
    ck_near(zp_zip_next(&state, NODES, y, vy, ay, 5, &pair), platform_first ? 0.5 : 1, 1e-14);
    ck_assert_uint_eq(pair, platform_first ? NODES - 1 : 3);
  }
}

/* The time found is where eq. (1) of the paper takes the pair: random motions, by stepping it. */
TEST(test_meeting_is_where_the_step_goes) {
  uint64_t seed = 1;
  int met = 0;
  for (int k = 0; k < 10000; k++) {
    Motion m = {1e-3 * (1 + noise(&seed)), noise(&seed), 1e3 * noise(&seed), 2e-3, 0};
    double y[2 * NODES], vy[2 * NODES], ay[2 * NODES];
    place(3, m, y, vy, ay);
    size_t pair = 77;
    ZpZipState state = {2, false};
    double s = zp_zip_next(&state, NODES, y, vy, ay, m.dt, &pair);
    double gap = m.g + (m.w + m.c * s) * s, lowest = gap;
    for (int i = 1; i < 64; i++) /* not closed on the way */
      lowest = fmin(lowest, m.g + (m.w + m.c * s * i / 64) * s * i / 64);
    ck_assert_double_ge(lowest, -1e-15);
    if (pair == 77) continue;
    met++;
    ck_below(fabs(gap), 1e-15);
    ck_assert_double_le(m.w + m.c * s, 1e-9);
  }
  ck_assert_int_gt(met, 1000);
}

/* -- joining --------------------------------------------------------------------------------------- */

/* Masses 2 and 3 kg of pair 1; in pair 2 the upper node is held; in pair 3 both are. */
static const double mass[2 * NODES] = {1, 1, 2, 3, 2, 3, 2, 3, 1, 1, 1, 1};
static const double inverse[2 * NODES] = {1, 1, 1 / 2.0, 1 / 3.0, 0, 1 / 3.0, 0, 0, 1, 1, 1, 1};
static const double together[NODES] = {1 / 2.0, 1 / 5.0, 0, 0, 1 / 2.0, 1 / 2.0};
static const ZpMasses masses = {{mass, inverse, together}, {mass, inverse, together}};
static const ZpModel two_ribbons = {.nodes = NODES, .stride = 2 * NODES, .topology = {.ribbons = 2}};

/* Pair i joins along x. */
static double join_pair(size_t i, double *v) {
  const ZpTie row = zp_tie_of_pair(&two_ribbons, i, 0);
  return zp_tie_join(&row, &masses.x, v);
}

TEST(test_merge) {
  double v[2 * NODES] = {0, 0, 4, -1, 0, 7, 0, 0};
  double before = 0.5 * 2 * 16 + 0.5 * 3 * 1, lost = join_pair(1, v);
  ck_assert_double_eq(v[2], v[3]);
  ck_near(5 * v[2], 2 * 4.0 - 3, 1e-14);                /* momentum */
  ck_near(lost, 0.5 * (2 * 3 / 5.0) * 25, 1e-14);       /* reduced mass */
  ck_near(lost, before - 0.5 * 5 * v[2] * v[2], 1e-14); /* what is missing */
  lost = join_pair(2, v);                               /* against a held node */
  ck_assert(v[4] == 0 && v[5] == 0);
  ck_near(lost, 0.5 * 3 * 49, 1e-14);
  ck_assert_double_eq(join_pair(3, v), 0); /* nothing moves */
  ck_assert(v[6] == 0 && v[7] == 0);
  v[2] = v[3] = 5;
  ck_assert_double_eq(join_pair(1, v), 0); /* already together */
}

TEST(test_share) {
  double a[4 * NODES];
  for (size_t j = 0; j < 2 * NODES; j++)
    a[j] = a[2 * NODES + j] = inverse[j] * (double)(j + 1); /* forces 1, 2, ... */
  ZpZipState state = {2, false};
  zp_ties_share(&two_ribbons, &masses, &state, a);
  ck_assert_mem_eq(a, a + 2 * NODES, 2 * NODES * sizeof *a); /* along y as along x */
  ck_assert(a[0] == a[1] && a[2] == a[3]);
  ck_near(a[2], (3 + 4) / 5.0, 1e-14);
  ck_assert(a[4] == 0 && a[5] == 0); /* held */
  ck_near(a[8], 9, 1e-14);           /* not joined */
  ck_near(a[11], 12, 1e-14);
  state.platform = true;
  zp_ties_share(&two_ribbons, &masses, &state, a);
  ck_near(a[10], (11 + 12) / 2.0, 1e-14);
  ck_assert_double_eq(a[10], a[11]);
  ck_near(a[8], 9, 1e-14);
}

/* -- transitions ----------------------------------------------------------------------------------- */

static void check_state(ZpZipState state, size_t front, bool platform) {
  ck_assert_msg(state.front == front && state.platform == platform, "front %zu platform %d, expected %zu %d",
                state.front, state.platform, front, platform);
}

TEST(test_closing) {
  ZpZipState state = {0, false};
  for (size_t i = 1; i < NODES - 1; i++) {
    state = zp_zip_after(state, NODES, i);
    check_state(state, i, false);
  }
  check_state(zp_zip_after(state, NODES, NODES - 1), NODES - 1, true); /* the last one closes all */
  state = zp_zip_after((ZpZipState){1, false}, NODES, NODES - 1);      /* the platform first */
  check_state(state, 1, true);
  state = zp_zip_after(state, NODES, 2);
  state = zp_zip_after(state, NODES, 3);
  check_state(state, 3, true);
  check_state(zp_zip_after(state, NODES, 4), NODES - 1, true);
}

/* Accelerations that pull pairs `from` and beyond apart, and press the others together. */
static ZpZipState open_with(ZpZipState state, size_t from) {
  double ay[2 * NODES];
  for (size_t i = 0; i < NODES; i++) {
    ay[2 * i] = i >= from ? 1 : -1;
    ay[2 * i + 1] = 0;
  }
  return zp_zip_open(state, NODES, ay);
}

TEST(test_opening) {
  check_state(open_with((ZpZipState){3, false}, 0), 2, false); /* one pair at a time */
  check_state(open_with((ZpZipState){3, false}, 3), 2, false);
  check_state(open_with((ZpZipState){3, false}, 4), 3, false); /* pressed together */
  check_state(open_with((ZpZipState){0, false}, 0), 0, false); /* the clip never opens */
  check_state(open_with((ZpZipState){3, true}, NODES), 3, true);
  ZpZipState closed = open_with((ZpZipState){NODES - 1, true}, NODES - 1);
  check_state(closed, NODES - 2, false); /* the platform, with the front behind it */
  check_state(open_with((ZpZipState){NODES - 1, true}, NODES), NODES - 1, true);
}

/* The front is pulled apart, the platform is pressed together: nothing opens while that is closed. */
TEST(test_front_stays_while_platform_is_closed) {
  double ay[2 * NODES] = {0};
  ay[2 * 3] = 1;
  ay[2 * (NODES - 1)] = -1;
  check_state(zp_zip_open((ZpZipState){3, true}, NODES, ay), 3, true);
  check_state(zp_zip_open((ZpZipState){3, false}, NODES, ay), 2, false);
}

/* -- invariants during a run ----------------------------------------------------------------------- */

static ZpActuatorDef zipping_def(void) {
  return DEF({"solver.integrator", ZP_INTEGRATOR_EXPLICIT}, {"contact.model", ZP_CONTACT_SEQUENTIAL},
             {"ribbon.model", ZP_RIBBON_MASS_SPRING}, {"mesh.nodes", 21}, {"mass_spring.axial", ZP_AXIAL_CODE},
             {"damping.drag", 0.01});
}

typedef struct Run {
  ZpModel *model;
  ZpSim *sim;
  char *saved;
  size_t front; /* at the last look */
  bool platform;
  double offset[21]; /* x of upper - x of lower node when last seen joined */
  double contact_loss;
} Run;

static double lost(const Run *run) {
  return *zp_state_row(run->model, (ZpState *)(void *)run->saved, &zp_row_contact_loss);
}

static Run start_run(const ZpActuatorDef *def) {
  Run run = {.model = model_of(def)};
  run.sim = sim_of(run.model);
  run.saved = memory_of(zp_state_size(run.model));
  return run;
}

/* How far faces may overlap. With voltage: the meeting is found to rounding of positions, and each step may add
 * some, 1e-17 m. Without: a pair behind the opening front is not looked at (invariant 4) and may pass through
 * and join so; measured 1.3e-8 m. */
static double overlap(bool powered) {
  return powered ? 1e-12 : 1e-6;
}

static void check_joined(Run *run, const ZpState *state, const ZpShape *shape, size_t i, bool was_joined) {
  ZpMotion m = zp_state_motion(run->model, state);
  ck_assert(m.vx[2 * i] == m.vx[2 * i + 1] && m.vy[2 * i] == m.vy[2 * i + 1]);
  ck_below(shape->gap[i], 1e-12);
  ck_assert_double_ge(shape->gap[i], -overlap(state->U != 0));
  double offset = shape->x[2 * i] - shape->x[2 * i + 1];
  if (was_joined) ck_assert_double_le(fabs(offset - run->offset[i]), 1e-12);
  run->offset[i] = offset;
}

/* Invariants 1 and 3, and that gaps of the next pair and the platform do not turn negative. */
static void check_invariants(Run *run, bool powered) {
  ZpState *state = (ZpState *)(void *)run->saved;
  copy_state(run->sim, state);
  ZpShape shape = zp_sim_shape(run->sim);
  size_t nodes = run->model->nodes, front = shape.zipped;
  ck_assert_uint_eq(front, state->zip.front);
  ck_assert_double_eq(zp_sim_get(run->sim, "zipped_length"), (double)front * run->model->l);
  if (powered) ck_assert_uint_ge(front, run->front);
  /* without voltage a pair may have opened and met again since */
  bool same = powered || lost(run) == run->contact_loss;
  for (size_t i = 0; i <= front; i++)
    check_joined(run, state, &shape, i, same && i <= run->front);
  if (state->zip.platform) check_joined(run, state, &shape, nodes - 1, same && run->platform);
  if (front + 1 < nodes) ck_assert_double_ge(shape.gap[front + 1], -overlap(powered));
  ck_assert_double_ge(shape.gap[nodes - 1], -overlap(powered));
  ck_assert_double_ge(lost(run), run->contact_loss);
  if (powered && front == run->front && state->zip.platform == run->platform)
    ck_assert_double_eq(lost(run), run->contact_loss);
  run->contact_loss = lost(run);
  run->front = front;
  run->platform = state->zip.platform;
}

/* Run on in small stretches up to `end`, or until the front has gone `zipped` pairs. */
static void run_and_check(Run *run, double end, size_t zipped, bool powered) {
  double t = zp_sim_get(run->sim, "time");
  while (t < end && run->front < zipped) {
    t = fmin(t + 1e-4, end);
    ck_assert_int_eq(zp_sim_run(run->sim, t, false, NULL, NULL), ZP_REACHED_END);
    check_invariants(run, powered);
  }
}

TEST(test_invariants_while_zipping) {
  ZpActuatorDef def = zipping_def();
  Run run = start_run(&def);
  check_invariants(&run, true);
  run_and_check(&run, 0.15, 99, true);
  ck_assert_uint_ge(run.front, 19); /* it did zip; the last pair may stay away from the cap's front */
  ck_assert_double_gt(run.contact_loss, 0);
  ck_assert_double_gt(zp_sim_get(run.sim, "contraction"), 0.99);
}

/* The voltage is switched off during the zip: the front returns to the clip and the platform to its hanging height.
 * Drag -c |v| v damps as 1 / t; measured: open after 20 ms, after 2 s 1.2e-4 of the opening from rest. */
TEST(test_opens_without_voltage) {
  ZpActuatorDef def = zipping_def();
  def.damping.drag = 10;
  Run run = start_run(&def);
  double opening = zp_sim_get(run.sim, "opening");
  run_and_check(&run, 1, 8, true);
  ck_assert_uint_eq(run.front, 8);
  ck_assert_double_gt(zp_sim_get(run.sim, "contraction"), 0.05);
  ck_assert_int_eq(zp_sim_set_voltage(run.sim, 0, NULL), ZP_OK);
  double start = zp_sim_get(run.sim, "time"), free_at = NAN;
  for (int k = 1; k <= 20000 && run.front > 0; k++) {
    zp_sim_run(run.sim, start + 1e-4 * k, false, NULL, NULL);
    check_invariants(&run, false);
    free_at = 1e-4 * k;
  }
  ck_assert_uint_eq(run.front, 0);
  ck_assert_int_eq(zp_sim_run(run.sim, start + 2, false, NULL, NULL), ZP_REACHED_END);
  double left = zp_sim_get(run.sim, "opening") / opening - 1;
  printf("opened after %.1f ms; after 2 s %.1e of the opening from rest\n", 1e3 * free_at, left);
  ck_assert_double_eq(zp_sim_get(run.sim, "zipped_length"), 0);
  ck_below(fabs(left), 1e-3);
}

/* The same from fully closed, and the joined clip: pair 0 stays. */
TEST(test_opens_from_closed) {
  ZpActuatorDef def = zipping_def();
  Run run = start_run(&def);
  run_and_check(&run, 0.15, 99, true);
  ck_assert_double_gt(zp_sim_get(run.sim, "contraction"), 0.99);
  zp_sim_set_voltage(run.sim, 0, NULL);
  run_and_check(&run, zp_sim_get(run.sim, "time") + 0.1, 99, false);
  ck_assert_uint_eq(run.front, 0);
  ck_assert_double_gt(zp_sim_get(run.sim, "opening"), 5e-3);
}

/* A run ends when the pair joins that is so many places before the last one. */
TEST(test_margin_of_pairs) {
  ZpActuatorDef def =
      DEF({"mesh.nodes", 11}, {"ribbon.model", ZP_RIBBON_MASS_SPRING}, {"solver.integrator", ZP_INTEGRATOR_EXPLICIT},
          {"contact.model", ZP_CONTACT_SEQUENTIAL}, {"electro.breakdown_cap", 0}, {"drive.voltage", 15e3},
          {"contact.complete_margin", 4}, {"solver.stop_when_zipped", ZP_WHEN_TRUE}, {"solver.end_time", 0.3});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ck_assert_int_eq(zp_sim_run(sim, 0.3, true, NULL, NULL), ZP_ZIPPED);
  ck_assert_uint_eq(sim->state->zip.front, model->topology.platform.first - 4);
}

/* Joining within a run loses the relative motion along both axes: m / 2 (dvx^2 + dvy^2) / 2 for two equal masses.
 * Within 1 %, as springs act on the way; one axis alone would be half. */
TEST(test_loss_of_joining) {
  const double speed = 10, gap = 1e-6; /* m/s, each node, and m: springs have no time */
  ZpActuatorDef def = zipping_def();
  def.damping.drag = 0;
  Run run = start_run(&def);
  ZpState *state = (ZpState *)(void *)run.saved;
  copy_state(run.sim, state);
  double *vx = zp_state_v(run.model, state), *vy = vx + run.model->stride;
  vx[2] = vy[3] = speed;
  vx[3] = vy[2] = -speed;
  double *y = zp_state_q(run.model, state) + run.model->stride;
  y[3] = y[2] - gap;
  put_state(run.sim, state);
  zp_sim_run(run.sim, 1.5 * gap / (2 * speed), false, NULL, NULL);
  copy_state(run.sim, state);
  ck_assert_uint_eq(state->zip.front, 1);
  double m = run.model->mass[2], dv = 2 * speed;
  ck_near(lost(&run), 0.5 * (m / 2) * (dv * dv + dv * dv), 0.01);      /* 2.9e-3 measured */
  ck_near(zp_sim_get(run.sim, "contact_loss"), 2 * lost(&run), 1e-14); /* both halves */
}
