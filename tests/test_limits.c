/* The limits of an actuator at rest: the extended system of a limit point, and study limits against study equilibrium,
 * which follows the curve, against closed forms, and against itself. */
#include "arrow_util.h"

#include "rest/limits.h"
#include "rest/rest.h"
#include "solve/track.h"

/* -- a limit point known in closed form --------------------------------------------------------------- */

/* E = q0^3 / 3 + q0^4 / 4 - 0.3 q0^2 q1 + q1^2 / 2 + s q2^2 / 2 - (m - 1) q0: a limit point at q = 0, m = 1. */
enum { EQUATIONS = 3, MOST = 32 };

typedef struct Toy {
  double q[EQUATIONS], m;
  double across;   /* s: what is across the null vector is stable where it is positive */
  double lean;     /* q0 pulls q1 by it, and nothing pulls back: a term of rank one, without an energy */
  double accuracy; /* that is asked for; 0: 1 */
  double seen[MOST];
  int visits;
} Toy;

static ZpEnd toy_residual(void *self, double *r, double *size) {
  const Toy *t = self;
  const double *q = t->q;
  r[0] = t->m - 1 - q[0] * q[0] - q[0] * q[0] * q[0] + 0.6 * q[0] * q[1];
  r[1] = -q[1] + 0.3 * q[0] * q[0] + t->lean * q[0];
  r[2] = -t->across * q[2];
  if (size) *size = fmax(fabs(r[0]), fmax(fabs(r[1]), fabs(r[2])));
  return ZP_END_FOUND;
}

static void toy_stiffness(void *self, ZpArrow *K, double *r) {
  (void)r;
  const double *q = ((const Toy *)self)->q;
  ZpBand *A = &K->part->A;
  zp_arrow_clear(K);
  *zp_band_at(A, 0, 0) = 2 * q[0] + 3 * q[0] * q[0] - 0.6 * q[1];
  *zp_band_at(A, 0, 1) = -0.6 * q[0];
  if (A->lower > 0) *zp_band_at(A, 1, 0) = -0.6 * q[0];
  *zp_band_at(A, 1, 1) = 1;
  *zp_band_at(A, 2, 2) = ((const Toy *)self)->across;
  if (A->rank == 0) return;
  memcpy(A->u, (const double[EQUATIONS]){0, 1, 0}, EQUATIONS * sizeof *A->u);
  memcpy(A->v, (const double[EQUATIONS]){-((const Toy *)self)->lean, 0, 0}, EQUATIONS * sizeof *A->v);
}

static double toy_length(void *self, const double *step) {
  (void)self;
  return fmax(fabs(step[0]), fmax(fabs(step[1]), fabs(step[2])));
}

static void toy_move(void *self, const double *step, double fraction) {
  for (int i = 0; i < EQUATIONS; i++)
    ((Toy *)self)->q[i] += fraction * step[i];
}

/* Asked once at each iterate, so it writes down how far that is from the limit point. */
static double toy_change(void *self, const double *step) {
  Toy *t = self;
  if (t->visits < MOST) t->seen[t->visits++] = fmax(fabs(t->m - 1), fmax(fabs(t->q[0]), fabs(t->q[1])));
  return toy_length(self, step) / (t->accuracy > 0 ? t->accuracy : 1);
}

static void toy_sensitivity(void *self, double *r_m) {
  (void)self;
  r_m[0] = 1;
  r_m[1] = r_m[2] = 0;
}

static void toy_position(void *self, double *q) {
  memcpy(q, ((const Toy *)self)->q, sizeof((const Toy *)self)->q);
}

static void toy_save(void *self, void *to) {
  const Toy *t = self;
  memcpy(to, t->q, sizeof t->q);
  ((double *)to)[EQUATIONS] = t->m;
}

static void toy_restore(void *self, const void *from) {
  Toy *t = self;
  memcpy(t->q, from, sizeof t->q);
  t->m = ((const double *)from)[EQUATIONS];
}

static ZpBranchSystem toy_system(Toy *t) {
  return (ZpBranchSystem){.at_rest = {.n = EQUATIONS,
                                      .self = t,
                                      .residual = toy_residual,
                                      .stiffness = toy_stiffness,
                                      .length = toy_length,
                                      .change = toy_change,
                                      .move = toy_move},
                          .input = &t->m,
                          .sensitivity = toy_sensitivity,
                          .position = toy_position,
                          .save = toy_save,
                          .restore = toy_restore,
                          .save_size = (EQUATIONS + 1) * sizeof(double),
                          .q_scale = 1,
                          .m_scale = 1};
}

typedef struct ToyMarch {
  ZpBranchSystem system;
  ZpArrowForm form;
  ZpNewtonWork newton;
  ZpTrack march;
  void *memory;
} ToyMarch;

static void open_toy(ToyMarch *f, Toy *t, bool symmetric) {
  ZpArena arena = {NULL, 0};
  *f = (ToyMarch){.system = toy_system(t)};
  f->form = form_of_block(EQUATIONS, (ZpBandForm){.bandwidth = 1, .symmetric = symmetric, .rank = t->lean != 0});
  for (int pass = 0; pass < 2; pass++) {
    if (pass) f->memory = zp_calloc(1, arena.used);
    arena = (ZpArena){f->memory, 0};
    zp_newton_reserve(&f->newton, &f->form, &arena);
    zp_track_reserve(&f->march, &f->system, &f->form, &f->newton, &arena);
  }
  f->march.fold.tolerance = 1e-12;
}

static void close_toy(ToyMarch *f) {
  zp_free(f->memory);
  zp_arrow_form_destroy(&f->form);
}

/* Errors are squared in each iteration, with the stiffness treated as symmetric or not, and with one that is not
 * because of a term of rank one on top of a symmetric band. */
TESTS(test_extended_system_converges_quadratically, 0, 3) {
  Toy t = {.q = {-0.2, 0.05, 0.1}, .m = 0.9, .across = 1, .lean = _i == 2 ? 0.5 : 0};
  ToyMarch f;
  open_toy(&f, &t, _i != 1);
  f.march.fold.null[0] = 0.8;
  f.march.fold.null[1] = 0.6;
  ck_assert(zp_fold_solve(&f.march.fold));
  ck_assert_uint_eq(f.march.fold.negative, 0);
  printf("distance from the limit point:");
  for (int k = 0; k < t.visits; k++)
    printf(" %.1e", t.seen[k]);
  printf("\n");
  ck_below(fabs(t.m - 1), 1e-12); /* 0 measured */
  ck_assert_int_ge(t.visits, 4);
  for (int k = 0; k + 1 < t.visits; k++)
    if (t.seen[k] < 0.1 && t.seen[k] > 1e-6) ck_below(t.seen[k + 1], 2 * t.seen[k] * t.seen[k]); /* measured 1.5 */
  close_toy(&f);
}

/* The limit point of a branch that is unstable across it is found, and told to be that. */
TEST(test_unstable_limit_point_is_told) {
  Toy t = {.q = {-0.2, 0.05, 0.1}, .m = 0.9, .across = -1};
  ToyMarch f;
  open_toy(&f, &t, true);
  f.march.fold.null[0] = 1;
  ck_assert(zp_fold_solve(&f.march.fold));
  ck_assert_uint_eq(f.march.fold.negative, 1);
  t = (Toy){.q = {0.5, 0.075, 0}, .m = 0, .across = -1};
  t.m = 1 + 0.25 + 0.125 - 0.6 * 0.5 * 0.075;
  ck_assert_int_eq(zp_track(&f.march, 1.2), ZP_TRACK_LOST);
  ck_assert_int_eq(zp_track(&f.march, 0), ZP_TRACK_LOST);
  close_toy(&f);
}

static double toy_event(void *self, double *row) {
  row[0] = 1;
  row[1] = row[2] = 0;
  return ((const Toy *)self)->q[0];
}

/* On the branch, where q0 is as given. */
static double toy_branch(double q0) {
  return 1 + q0 * q0 + q0 * q0 * q0 - 0.6 * q0 * (0.3 * q0 * q0);
}

/* Along the branch through its limit point: each point costs one factorisation and has the error of one Newton step, or
 * of a second one on request. */
TESTS(test_points_in_passing, 0, 2) {
  static const double step = 0.02;
  const bool exact = _i == 1;
  Toy t = {.q = {-0.3, 0.027, 0}, .m = toy_branch(-0.3), .across = 1, .accuracy = exact ? 1e-9 : 1};
  ToyMarch f;
  open_toy(&f, &t, true);
  int tries = 0;
  double worst = 0, worst_slope = 0;
  for (int k = 0; k <= 30; k++) {
    double here = -0.3 + k * step, m = 0, slope = 0;
    ZpPass end = ZP_PASS_AGAIN;
    for (; end == ZP_PASS_AGAIN && tries < 100; tries++)
      end = zp_fold_pass(&f.march.fold, toy_event, here, here + step, &m, &slope);
    ck_assert_int_eq(end, ZP_PASS_ON);
    worst = fmax(worst, fabs(m - toy_branch(here)));
    worst_slope = fmax(worst_slope, fabs(slope - (2 + (3 - 0.54) * here) * here));
  }
  printf("%d points in %d steps: m off by %.1e, its slope by %.1e\n", 31, tries, worst, worst_slope);
  ck_assert_int_eq(tries, exact ? 61 : 31);
  ck_below(worst, 1e-12);
  ck_below(worst_slope, exact ? 1e-12 : 3e-4); /* 1e-16 and 7.2e-5 measured */
  close_toy(&f);
}

/* From a stable state far away to the limit point, and past none to where it is asked for. */
TEST(test_march) {
  Toy t = {.q = {0.5, 0.075, 0}, .across = 1};
  ToyMarch f;
  t.m = 1 + 0.25 + 0.125 - 0.6 * 0.5 * 0.075;
  open_toy(&f, &t, true);
  Toy start = t;
  ck_assert_int_eq(zp_track(&f.march, 1.2), ZP_TRACK_ARRIVED);
  ck_assert_double_eq(t.m, 1.2);
  t = start;
  ck_assert_int_eq(zp_track(&f.march, 0.5), ZP_TRACK_FOLD);
  ck_assert_double_eq_tol(t.m, 1, 1e-12);                        /* 0 measured */
  ck_assert_double_eq_tol(fabs(f.march.fold.null[0]), 1, 1e-12); /* 0 measured */
  close_toy(&f);
}

/* -- running a study ------------------------------------------------------------------------------- */

static const char *const names[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "max_load_kg"};

static ZpResult *run(ZpStudy study, const ZpActuatorDef *def, const ZpResult *neighbour) {
  ZpStudyInput input = {.neighbour = neighbour};
  ZpResult *result = study_with(study, def, &input);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s: %s", zp_outcome_name(result->outcome), result->message);
  return result;
}

static ZpResult *limits_of(const ZpActuatorDef *def) {
  return run(ZP_STUDY_LIMITS, def, NULL);
}

/* The same number, or none, in both. */
static void same(const ZpResult *a, const ZpResult *b, const char *name, double tolerance) {
  double x = zp_result_get(a, name), y = zp_result_get(b, name);
  printf("  %s: %.10g, %.10g\n", name, x, y);
  if (isnan(x) && isnan(y)) return;
  ck_near(x, y, tolerance); /* 1.3e-11 and, of two meshes, 2.8e-4 measured */
}

/* -- against the curve ------------------------------------------------------------------------------- */

static ZpActuatorDef design(int k) {
  const ZpActuatorDef designs[] = {
      DEF({"output.errors", true}),
      DEF({"electro.breakdown_cap", false}),
      DEF({"mesh.nodes", 41}, {"load.mass", 1e-3}),
      DEF({"ribbon.thickness", 200e-6}), /* closes gradually, after a limit point */
      DEF({"ribbon.thickness", 172.5e-6}, {"ribbon.length", 92.5e-3}, {"load.mass", 1.241e-3},
          {"electro.breakdown_cap", false}, {"drive.voltage", 12e3}), /* closes gradually */
      DEF({"load.mass", 60e-3}),                                      /* hangs at drive.voltage */
      DEF({"ribbon.length", 120e-3}, {"ribbon.thickness", 40e-6}, {"load.mass", 3e-3}, {"platform.length", 10e-3}),
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"ribbon.length", 65e-3}, {"ribbon.thickness", 100e-6},
          {"load.mass", 5e-3}, {"electro.gap_offset", 0.3e-3}, {"drive.voltage", 3e3}),
      DEF({"load.mass", 0}),
  };
  return designs[k];
}
enum { DESIGNS = 9 };

/* The first voltage at which the followed curve turns; NAN: it does not. */
static double first_turn(const ZpResult *followed) {
  double before = 0;
  for (size_t i = 0; i < followed->series->rows; i++) {
    double voltage = zp_table_get(followed->series, i, "voltage_V");
    if (zp_table_get(followed->series, i, "branch") == 0 && voltage < before) return before;
    before = voltage;
  }
  return NAN;
}

/* Pull-in is the first limit point of the curve, which is followed independently. Its points are so close there. */
static void turns_at(const ZpResult *followed, double pull_in) {
  static const double spacing = 0.02;
  double turn = first_turn(followed);
  printf("  the curve turns first at %.6g V\n", turn);
  ck_assert_int_eq(isnan(turn), isnan(pull_in));
  if (isnan(turn)) return;
  ck_below(turn, pull_in * (1 + 1e-6));
  ck_below(pull_in, turn * (1 + spacing));
}

/* => pull-in */
static double agrees_with_the_curve(const ZpActuatorDef *def) {
  ZpResult *direct = limits_of(def), *followed = run(ZP_STUDY_EQUILIBRIUM, def, NULL);
  double pull_in = zp_result_get(direct, names[0]);
  printf("%s\n  %s\n", direct->message, followed->message);
  for (int k = 0; k < 3; k++)
    same(direct, followed, names[k], 1e-10);
  turns_at(followed, pull_in);
  return pull_in;
}

TESTS(test_limits_are_those_of_the_curve, 0, DESIGNS) {
  ZpActuatorDef def = design(_i);
  agrees_with_the_curve(&def);
}

/* Regression: with half-cell clamps next to straight pieces the pull-in with 61 nodes was 0.65 % below that of an
 * independent boundary-value code, without the breakdown cap 0.93 %. */
TESTS(pull_in_hardly_depends_on_the_mesh, 0, 2) {
  static const int nodes[] = {41, 61, 121};
  static const double continuum[] = {5107.7, 5661.4};
  for (size_t i = 0; i < LENGTH_OF(nodes); i++) {
    ZpActuatorDef def = DEF({"mesh.nodes", nodes[i]}, {"electro.breakdown_cap", _i});
    ZpResult *result = limits_of(&def);
    ck_near(zp_result_get(result, "pull_in_voltage_V"), continuum[_i], 5e-4); /* 2.8e-4 measured */
  }
}

/* Some nodes jump long before the actuator closes. A long step along the voltage once passed this limit point. */
TEST(snap_of_a_few_nodes_is_the_pull_in) {
  ZpActuatorDef def =
      DEF({"ribbon.thickness", 25e-6}, {"ribbon.length", 150e-3}, {"load.mass", 5e-3}, {"drive.voltage", 12e3});
  ck_near(agrees_with_the_curve(&def), 9922, 2e-4); /* 4.5e-5 measured */
}

/* How far the voltage of the hanging branch falls below what it has been on a curve, relative to that. */
static double fall_along(const ZpTable *curve) {
  double highest = 0, fall = 0;
  for (size_t i = 0; i < curve->rows && zp_table_get(curve, i, "branch") == 0; i++) {
    double U = zp_table_get(curve, i, "voltage_V");
    highest = fmax(highest, U);
    if (highest > 0) fall = fmax(fall, 1 - U / highest);
  }
  return fall;
}

/* A snap on the way to gradual closing: the curve turns back by less than the 0.5 % of a ripple, so that its limit
 * point is no pull-in. */
TEST(small_snap_is_no_pull_in) {
  ZpActuatorDef def = DEF({"mesh.nodes", 15}, {"drive.voltage", 400}, {"load.mass", 0.0017527291901765613},
                          {"ribbon.thickness", 4.9161614558160775e-05}, {"ribbon.length", 0.03363515595843682},
                          {"insulator.thickness", 8.915831978221488e-05}, {"output.errors", 0});
  ZpResult *direct = limits_of(&def), *followed = run(ZP_STUDY_EQUILIBRIUM, &def, NULL);
  double fall = fall_along(followed->series);
  printf("a snap of %.2e of the voltage\n", fall);
  ck_assert(fall > 1e-4 && fall < ZP_FOLD_RIPPLE);
  ck_assert(isnan(zp_result_get(direct, "pull_in_voltage_V")));
  ck_assert_ptr_nonnull(strstr(direct->message, "no pull-in: closes gradually at "));
  ck_assert_ptr_nonnull(strstr(followed->message, "no pull-in: closes gradually at "));
  ck_near(zp_result_get(direct, "closing_voltage_V"), zp_result_get(followed, "closing_voltage_V"),
          1e-12); /* 0 measured */
}

/* Where it closes gradually, one state lies at the mark on the way up and on the way down: it releases where it closes,
 * never above that. */
TEST(gradual_closing_is_also_the_release) {
  const ZpActuatorDef designs[] = {
      DEF({"mesh.nodes", 11}, {"drive.voltage", 499.516}, {"load.mass", 0.67972e-3}, {"ribbon.thickness", 27.17e-6},
          {"ribbon.length", 22.01e-3}, {"insulator.thickness", 38.09e-6}),
      DEF({"mesh.nodes", 11}, {"drive.voltage", 3011.62}, {"load.mass", 1.4327e-3}, {"ribbon.thickness", 192.4e-6},
          {"ribbon.length", 28.38e-3}, {"insulator.thickness", 40.62e-6}),
      DEF({"mesh.nodes", 11}, {"drive.voltage", 5783.74}, {"load.mass", 2.1176e-3}, {"ribbon.thickness", 84.51e-6},
          {"ribbon.length", 21.96e-3}, {"insulator.thickness", 112.2e-6})};
  for (size_t k = 0; k < LENGTH_OF(designs); k++) {
    ZpResult *result = limits_of(&designs[k]);
    double closing = zp_result_get(result, "closing_voltage_V"), release = zp_result_get(result, "release_voltage_V");
    ck_assert_double_le(release, closing);
    ck_near(release, closing, 1e-12);
  }
}

/* A strip between two clamps is closed, at 1 % of its opening, slightly before a limit point: this is the pull-in, as
 * on the curve. Limit points where it jumps and where it would jump back are some millivolts apart. They move smoothly
 * with the gap: a step along the voltage once passed both at most gaps. */
TEST(pull_in_follows_a_gradual_closing) {
  enum { GAPS = 4 };
  double pull_in[GAPS];
  for (int k = 0; k < GAPS; k++) {
    ZpActuatorDef def =
        DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_CLAMPED}, {"mesh.nodes", 9},
            {"electro.gap_offset", (0.0391 + 0.0005 * k) * 1e-3}, {"drive.voltage", 3670},
            {"ribbon.thickness", 97.18e-6}, {"ribbon.length", 70.08e-3}, {"insulator.thickness", 68.64e-6});
    pull_in[k] = agrees_with_the_curve(&def);
    ck_assert_double_lt(answered_value(ZP_STUDY_LIMITS, &def, "closing_voltage_V"), pull_in[k]);
  }
  double third = pull_in[3] - 3 * pull_in[2] + 3 * pull_in[1] - pull_in[0];
  ck_assert_double_le(fabs(third), 2e-7 * pull_in[0]); /* 1.0e-7 measured */
}

/* Regression: two limit points 1 % apart, far below drive.voltage, were passed in one step, so the next one, at 445 V,
 * was reported as the pull-in. */
TEST(curve_meets_both_limit_points_of_a_small_snap) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_CLAMPED}, {"electro.gap_offset", 0.3e-3});
  ck_near(agrees_with_the_curve(&def), 257.6, 3e-4); /* 9.8e-5 measured */
}

/* -- against a staircase of the voltage -------------------------------------------------------------- */

/* The voltage changes by this part from one stair to the next, on each of which motion ends. */
static const double stair = 0.005;

/* From the present state at `voltage`, up or down to where it is closed, or is not. => the voltage there */
static double climb_stairs(ZpRest *rest, double voltage, bool up, double closed) {
  enum { MOST = 2000 };
  for (int k = 0; k < MOST; k++, voltage *= up ? 1 + stair : 1 - stair) {
    ck_assert(zp_newton_good(zp_statics_relax(&rest->statics, voltage).end));
    if ((zp_closing_gap(&rest->statics, NULL) <= closed) == up) return voltage;
  }
  return NAN;
}

/* => closing (up) or release */
static double by_stairs(const ZpActuatorDef *def, double start, bool up) {
  ZpModel *model = model_of(def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  ck_assert(zp_newton_good(zp_statics_find_rest(&rest.statics).end));
  double closed = zp_closed_opening(rest.statics.member->model, zp_closing_gap(&rest.statics, NULL));
  if (!up) ck_assert(zp_newton_good(zp_statics_close(&rest.statics, start).end));
  double found = climb_stairs(&rest, start, up, closed);
  zp_rest_close(&rest);
  return found;
}

/* After a jump of some nodes it rests, and closes at a higher voltage: 2 % with 27 nodes, where a fall in long steps
 * once passed the state between; 12 % of a stiff one, where faces that overlapped for a moment on the way once were
 * taken for closed. */
TESTS(closing_is_that_of_a_staircase, 0, 2) {
  const ZpActuatorDef designs[] = {
      DEF({"ribbon.length", 35.635e-3}, {"ribbon.width", 30.046e-3}, {"ribbon.thickness", 14.209e-6},
          {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38}, {"ribbon.density", 1390},
          {"platform.length", 3.5635e-3}, {"insulator.thickness", 28.069e-6}, {"medium.permittivity", 1},
          {"load.mass", 0.30432e-3}, {"mesh.nodes", 27}, {"electro.breakdown_cap", false}, {"drive.voltage", 5834}),
      DEF({"ribbon.length", 85.544e-3}, {"ribbon.width", 14.714e-3}, {"ribbon.thickness", 340.19e-6},
          {"ribbon.young_modulus", 70e9}, {"ribbon.poisson_ratio", 0.33}, {"ribbon.density", 2700},
          {"platform.length", 8.5544e-3}, {"insulator.thickness", 16.534e-6}, {"medium.permittivity", 1},
          {"load.mass", 0}, {"mesh.nodes", 107}, {"electro.breakdown_cap", false}, {"drive.voltage", 10312}),
  };
  ZpActuatorDef def = designs[_i];
  ZpResult *result = limits_of(&def);
  double closing = zp_result_get(result, "closing_voltage_V"), found = by_stairs(&def, 0.5 * closing, true);
  printf("closes at %.6g V, on the stair of %.6g V\n", closing, found);
  ck_near(found, closing, 0.1 * stair); /* of the same stair: 0.024 measured */
}

/* A load that the closed actuator just holds (the limit point is a corner of the breakdown cap, at which the state was
 * lost before); flanges without load. */
TESTS(release_is_that_of_a_staircase, 0, 4) {
  const ZpActuatorDef designs[] = {
      DEF({"load.mass", 120e-3}, {"drive.voltage", 12e3}),
      DEF({"load.mass", 100e-3}, {"drive.voltage", 12e3}),
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 1e-4}, {"load.mass", 0},
          {"ribbon.thickness", 100e-6}, {"drive.voltage", 3e3}),
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_FREE}, {"electro.gap_offset", 1e-4},
          {"load.mass", 0}, {"ribbon.thickness", 100e-6}, {"drive.voltage", 3e3}),
  };
  ZpActuatorDef def = designs[_i];
  ZpResult *result = limits_of(&def);
  double release = zp_result_get(result, "release_voltage_V"), found = by_stairs(&def, def.drive.voltage, false);
  printf("releases at %.6g V, on the stair of %.6g V\n", release, found);
  ck_near(found, release, 2 * stair); /* 4.9e-3 measured */
}

/* -- closed forms ------------------------------------------------------------------------------------ */

/* A guided ribbon over a flat electrode at a distance g far below its length: b = eps0 w U^2 L^4 / (2 EI g^3). */
TEST(test_classical_pull_in) {
  const double b = 4.38094, g = 1e-3, L = 0.1, width = 12.7e-3, thick = 1e-3, eps0 = 8.8541878128e-12;
  double EI = 200e9 * width * thick * thick * thick / 12,
         V = sqrt(2 * b * EI * g * g * g / (eps0 * width * L * L * L * L));
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_FLANGE}, {"actuator.right_end", ZP_END_GUIDED}, {"ribbon.length", L},
          {"ribbon.plane", ZP_PLANE_STRESS}, {"gravity", 0}, {"load.mass", 0}, {"ribbon.thickness", thick},
          {"insulator.thickness", 0}, {"medium.permittivity", 1}, {"medium.breakdown_field", V / (0.1 * g)},
          {"electro.gap_offset", g}, {"drive.voltage", 1.2 * V});
  ZpResult *result = limits_of(&def);
  double found = zp_result_get(result, "pull_in_voltage_V");
  printf("%s; %+.1e off in b\n", result->message, found * found / (V * V) - 1);
  ck_near(found * found / (V * V), 1, 3e-4);                        /* 8e-5 measured */
  ck_assert_double_nan(zp_result_get(result, "closing_voltage_V")); /* closed, bare electrodes touch */
  ck_assert_ptr_nonnull(strstr(result->message, "short circuit"));
}

/* All lengths times c, weight per volume over c: the same shapes under c times the voltage and c^2 times the load's
 * weight. */
TEST(test_scaling) {
  const double c = 1.25;
  ZpActuatorDef def = DEF({"insulator.thickness", 25e-6}), large = def;
  large.ribbon.length *= c;
  large.ribbon.width *= c;
  large.ribbon.thickness *= c;
  large.insulator.thickness *= c;
  large.platform.length *= c;
  large.gravity /= c;
  large.load.mass *= c * c * c;
  large.drive.voltage *= c;
  ZpResult *one = limits_of(&def), *other = limits_of(&large);
  for (int k = 0; k < 3; k++)
    ck_near(zp_result_get(other, names[k]), c * zp_result_get(one, names[k]), 1e-12); /* 4.5e-14 measured */
  /* 2.2e-16 measured */
  ck_near(zp_result_get(other, "max_load_kg"), c * c * c * zp_result_get(one, "max_load_kg"), 1e-12);
}

/* -- the largest load -------------------------------------------------------------------------------- */

/* Under the largest load it closes at drive.voltage, for any load in the scenario. */
TEST(test_largest_load) {
  static const double masses[] = {1e-3, 8e-3, 20e-3, 60e-3};
  double largest[LENGTH_OF(masses)];
  for (size_t k = 0; k < LENGTH_OF(masses); k++) {
    ZpActuatorDef def = DEF({"load.mass", masses[k]});
    ZpResult *result = limits_of(&def);
    largest[k] = zp_result_get(result, "max_load_kg");
    ck_near(largest[k], largest[0], 1e-12); /* 4e-15 measured */
  }
  ZpActuatorDef def = DEF({"load.mass", largest[0]});
  double voltage = def.drive.voltage;
  def.drive.voltage *= 1.01;
  ZpResult *result = limits_of(&def);
  printf("%g kg: closes at %.9g V\n", largest[0], zp_result_get(result, "closing_voltage_V"));
  ck_near(zp_result_get(result, "closing_voltage_V"), voltage, 1e-12); /* 4.4e-16 measured */
}

/* Contact once got stiffer with the load: 0.6 % off without cap. */
TEST(largest_load_does_not_depend_on_the_load) {
  ZpActuatorDef light = DEF({"electro.breakdown_cap", false}), heavy = light;
  heavy.load.mass = 1000;
  ZpResult *of_light = limits_of(&light), *of_heavy = limits_of(&heavy);
  same(of_heavy, of_light, "max_load_kg", 1e-10);
}

/* The largest load by its definition: the voltage closes 0.999 of it, and none of some larger ones. No closing voltage
 * is above the voltage asked for: the march once climbed to a crest beyond it. */
static void check_definition(ZpActuatorDef def, double largest) {
  static const double share[] = {0.999, 1.001, 1.01, 1.03, 1.1, 1.3};
  for (size_t k = 0; k < LENGTH_OF(share); k++) {
    def.load.mass = share[k] * largest;
    ZpResult *result = limits_of(&def);
    double closing = zp_result_get(result, "closing_voltage_V");
    bool closes = !isnan(closing);
    ck_assert(!closes || closing <= def.drive.voltage);
    ck_assert_msg(closes == (share[k] < 1), "%g times %g kg: closing voltage %g V", share[k], largest, closing);
  }
}

/* The designs in turn: beyond the first limit point the front passes node by node, and the march stopped at a crest of
 * this ripple (5.33 and 6.60 g); it closes gradually, at a gap that depends on the load (132.6 g); jumps end at fronts
 * that a coarse mesh holds between nodes, so that the closing voltage is no monotonic function of the load. A front is
 * held in the neighbour, too; the highest crest is beyond the voltage; long steps of a fall passed over a held front; a
 * crest lies beside a corner of the breakdown cap, a third of a step away; the search ended at another crest if the
 * load itself was the largest; a light load that hung from the shape under a heavy one had its ribbons, which outweigh
 * it, on each other. */
TESTS(largest_load_is_the_largest_that_closes, 0, 10) {
  const ZpActuatorDef designs[] = {
      DEF({"drive.voltage", 3600}, {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", 50e-9}, {"mesh.nodes", 61}),
      DEF({"drive.voltage", 9100}, {"ribbon.length", 80e-3}, {"ribbon.thickness", 25e-6},
          {"insulator.thickness", 50e-6}, {"insulator.permittivity", 3.4}, {"liquid.model", ZP_LIQUID_BEAD},
          {"bead.volume", 40e-9}, {"mesh.nodes", 61}),
      DEF({"drive.voltage", 6900}, {"ribbon.length", 30e-3}, {"ribbon.thickness", 100e-6}, {"load.mass", 1},
          {"mesh.nodes", 31}),
      DEF({"ribbon.length", 0.01888528211665429}, {"ribbon.width", 0.0088206067348378832},
          {"ribbon.thickness", 1.1615138063745808e-05}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", 0.0018885282116654291},
          {"insulator.thickness", 5.9731927635211695e-05}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"load.mass", 0.058574621189102061}, {"mesh.nodes", 31}, {"electro.breakdown_cap", false},
          {"drive.voltage", 3088.8054199713247}),
      DEF({"ribbon.length", 0.023679981896155524}, {"ribbon.width", 0.0041381707499077106},
          {"ribbon.thickness", 1.0782791063337116e-05}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", 0.0023679981896155525},
          {"insulator.thickness", 2.0257873999779368e-05}, {"load.mass", 0.0040950709473358314}, {"mesh.nodes", 21},
          {"drive.voltage", 6741.7268747249027}),
      DEF({"ribbon.length", 0.081843174706400929}, {"ribbon.width", 0.015880422063732157},
          {"ribbon.thickness", 0.00020087708639572637}, {"ribbon.young_modulus", 70e9}, {"ribbon.poisson_ratio", 0.33},
          {"ribbon.density", 2700}, {"platform.length", 0.0081843174706400929},
          {"insulator.thickness", 1.2071981445200692e-05}, {"load.mass", 0.0013350133355630118}, {"mesh.nodes", 21},
          {"drive.voltage", 3456.2500596800728}),
      DEF({"ribbon.length", 0.17968038677095233}, {"ribbon.width", 0.0068481998464165941},
          {"ribbon.thickness", 8.1690059822008606e-05}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", 0.017968038677095233},
          {"insulator.thickness", 5.1231351783930109e-05}, {"load.mass", 0.00178700408585293}, {"mesh.nodes", 31},
          {"drive.voltage", 4390.3887903970244}),
      DEF({"drive.voltage", 9100}, {"ribbon.length", 80e-3}, {"ribbon.thickness", 25e-6},
          {"insulator.thickness", 50e-6}, {"insulator.permittivity", 3.4}, {"insulator.density", 0},
          {"insulator.young_modulus", 0}, {"mesh.nodes", 241}),
      DEF({"ribbon.length", 0.038082241252169066}, {"ribbon.width", 0.01791424838850006},
          {"ribbon.thickness", 4.9016109572993561e-05}, {"platform.length", 0.003808224125216907},
          {"insulator.thickness", 4.2545276332329279e-05}, {"load.mass", 0.021414823268059067}, {"mesh.nodes", 31},
          {"drive.voltage", 10384.068022575568}),
      DEF({"ribbon.length", 0.15026953388862371}, {"ribbon.width", 0.014388963226382901},
          {"ribbon.thickness", 4.2754055790085297e-05}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", 0.015026953388862372},
          {"insulator.thickness", 7.9499555068256636e-05}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"load.mass", 0.093334937712326899}, {"mesh.nodes", 24}, {"electro.breakdown_cap", false},
          {"drive.voltage", 938.1416492648101})};
  ZpActuatorDef def = designs[_i], slower = def, loaded = def;
  slower.drive.voltage *= 0.95;
  ZpResult *before = limits_of(&slower), *cold = limits_of(&def), *warm = run(ZP_STUDY_LIMITS, &def, before);
  double largest = zp_result_get(cold, "max_load_kg");
  printf("largest load %.9g kg\n", largest);
  same(warm, cold, "max_load_kg", 1e-10);
  check_definition(def, largest);
  loaded.load.mass = largest;
  ZpResult *of_loaded = limits_of(&loaded);
  same(of_loaded, cold, "max_load_kg", 1e-10);
}

/* Elements are 18 times as long as the front, which passes 91 nodes in 34,664 steps of a fall. Where such a fall ended
 * after 20,000 steps, this load was 0.50 g. */
NIGHTLY_TEST(front_passes_every_node_of_a_coarse_mesh) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.29133597482441054}, {"ribbon.width", 0.018681133350026146},
          {"ribbon.thickness", 1.8127693362754846e-05}, {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38},
          {"ribbon.density", 1390}, {"platform.length", 0.029133597482441057},
          {"insulator.thickness", 1.6673562179830768e-05}, {"load.mass", 0.00032966619580438551}, {"mesh.nodes", 92},
          {"electro.breakdown_cap", false}, {"drive.voltage", 6236.4389796081914});
  double largest = answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg");
  check_definition(def, largest);
  def.load.mass = 0.9999 * largest;
  ck_assert_double_lt(answered_value(ZP_STUDY_LIMITS, &def, "closing_voltage_V"), def.drive.voltage);
  ck_near(answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg"), largest, 1e-10);
}

/* Just above 1.0193 g, where the voltage is a limit point, it does not close; it closes again up to 1.0385 g, above
 * which its closing voltage jumps. */
TEST(larger_load_that_closes_again) {
  ZpActuatorDef def = DEF({"ribbon.length", 0.1574917229260947}, {"ribbon.width", 0.004515478370925754},
                          {"ribbon.thickness", 7.463166966632059e-05}, {"platform.length", 0.01574917229260947},
                          {"insulator.thickness", 3.482150568880197e-05}, {"load.mass", 0.004062378575871861},
                          {"mesh.nodes", 21}, {"drive.voltage", 9921.195981628765}, {"liquid.model", ZP_LIQUID_BEAD},
                          {"bead.volume", 50e-9}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6});
  double largest = answered_value(ZP_STUDY_LIMITS, &def, "max_load_kg");
  def.load.mass = 1.0375e-3;
  ck_assert_double_lt(answered_value(ZP_STUDY_LIMITS, &def, "closing_voltage_V"), def.drive.voltage);
  ck_assert_double_gt(largest, def.load.mass);
}

/* Its closed state is open by more than 1 % of the opening with which it hangs, even without load. A candidate that no
 * voltage confirmed was once given as the answer. */
TEST(no_largest_load) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.12634218193225474}, {"ribbon.width", 0.025633153752887272},
          {"ribbon.thickness", 0.00020709320866311656}, {"platform.length", 0.012634218193225475},
          {"insulator.thickness", 0.00010858961875747558}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"load.mass", 0.98691099757668199}, {"mesh.nodes", 31}, {"drive.voltage", 527.35321457904172});
  ZpResult *result = limits_of(&def);
  ck_assert_double_nan(zp_result_get(result, "max_load_kg"));
}

/* A sweep of 49 voltages around it, and meshes of 31 and 121 nodes, gave 5.179 to 5.180 g. */
TEST(largest_load_hardly_depends_on_the_mesh) {
  ZpActuatorDef coarse = DEF({"drive.voltage", 3600}, {"mesh.nodes", 31}), fine = coarse;
  fine.mesh.nodes = 61;
  ZpResult *of_coarse = limits_of(&coarse), *of_fine = limits_of(&fine);
  same(of_fine, of_coarse, "max_load_kg", 1e-3);
}

/* It closes gradually, where the gap is 1 % of the one with which it hangs under the largest load, not under its own.
 */
TEST(gradual_largest_load_does_not_depend_on_the_load) {
  ZpActuatorDef light = DEF({"drive.voltage", 6900}, {"ribbon.length", 30e-3}, {"ribbon.thickness", 100e-6},
                            {"load.mass", 10e-3}, {"mesh.nodes", 31}),
                heavy = light;
  heavy.load.mass = 1;
  ZpResult *of_light = limits_of(&light), *of_heavy = limits_of(&heavy);
  printf("%g kg\n", zp_result_get(of_light, "max_load_kg"));
  same(of_heavy, of_light, "max_load_kg", 1e-10);
}

/* Loads slightly above the largest one: the way up to drive.voltage is nearly vertical, and the largest load is that of
 * an actuator with half of it. The march once gave up where a step went past drive.voltage. */
TESTS(load_slightly_above_the_largest, 0, 2) {
  const ZpActuatorDef designs[] = {
      DEF({"ribbon.thickness", 40e-6}, {"mesh.nodes", 21}, {"load.mass", 9.04347826087e-3}),
      DEF({"ribbon.thickness", 50e-6}, {"mesh.nodes", 21}, {"load.mass", 12.1739130435e-3})};
  ZpActuatorDef heavy = designs[_i], light = heavy;
  light.load.mass *= 0.5;
  ZpResult *of_heavy = limits_of(&heavy), *of_light = limits_of(&light);
  ck_assert_double_nan(zp_result_get(of_heavy, "closing_voltage_V"));
  ck_assert_double_lt(zp_result_get(of_heavy, "max_load_kg"), heavy.load.mass);
  same(of_heavy, of_light, "max_load_kg", 1e-10);
}

/* -- what it is for ---------------------------------------------------------------------------------- */

/* mass_kg counts strips and insulators from clip to clip, for a half and a whole actuator alike. */
TESTS(mass_in_closed_form, 0, 2) {
  ZpActuatorDef def = DEF({"insulator.density", 1390}, {"mesh.nodes", 31},
                          {"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF});
  ZpResult *result = limits_of(&def);
  ck_near(zp_result_get(result, "mass_kg"), 2 * 0.1 * 12.7e-3 * (50e-6 * 7850 + 130e-6 * 1390), 1e-12);
}

static double travel_at(const ZpActuatorDef *def, int key, double value) {
  ZpActuatorDef other = *def;
  ck_assert_int_eq(zp_def_set(&other, key, value, NULL), ZP_OK);
  ZpResult *result = limits_of(&other);
  return zp_result_get(result, "travel_m");
}

/* travel_m is the decrease of the opening, and its derivatives equal finite differences. */
TEST(travel_and_its_derivatives) {
  static const char *const keys[] = {"ribbon.thickness", "ribbon.length", "load.mass", "insulator.thickness"};
  ZpActuatorDef def = DEF({"mesh.nodes", 31}, {"output.errors", 0}, {"solver.tolerance", 1e-9}), hung = def;
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by,
           "ribbon.thickness, ribbon.length, load.mass, insulator.thickness");
  hung.drive.voltage = 0;
  ZpResult *result = limits_of(&def), *open = run(ZP_STUDY_STATIONARY, &hung, NULL);
  ck_near(zp_result_get(result, "travel_m"), zp_result_get(open, "opening_m"),
          1e-4); /* closed, contact gives by less than 1 um */
  size_t found = 0;
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (strcmp(s->output, "travel_m") != 0) continue;
    const double value = zp_def_get(&def, s->key), step = 1e-3 * value;
    const double slope = (travel_at(&def, s->key, value + step) - travel_at(&def, s->key, value - step)) / (2 * step);
    ck_assert_int_eq(s->key, zp_key_find(keys[found++]));
    ck_assert_double_eq_tol(s->value * value, slope * value, 1e-5 * zp_result_get(result, "travel_m"));
  }
  ck_assert_uint_eq(found, LENGTH_OF(keys));
}

/* -- from a neighbour -------------------------------------------------------------------------------- */

/* From a neighbour (NULL: none) and from scratch: the same limits. => the former */
static ZpResult *same_limits(const ZpActuatorDef *def, const ZpResult *near, double tolerance) {
  ZpResult *warm = run(ZP_STUDY_LIMITS, def, near), *cold = limits_of(def);
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    same(warm, cold, names[i], tolerance);
  return warm;
}

/* Where a search begins does not change what it finds. */
TESTS(test_limits_from_a_neighbour, 1, 2) {
  static const char *const keys[] = {"load.mass", "ribbon.thickness", "ribbon.length", "drive.voltage"};
  ZpActuatorDef def = DEF({"output.errors", true});
  ZpResult *near = limits_of(&def);
  double starts = 0;
  for (int k = 0; k < 6; k++) {
    int key = zp_key_find(keys[_i]);
    ck_assert_int_eq(zp_def_set(&def, key, zp_def_get(&def, key) * 1.01, NULL), ZP_OK);
    near = same_limits(&def, near, 1e-10);
    starts += zp_result_get(near, "warm_starts");
  }
  printf("%s: %g of 18 limits from the neighbour\n", keys[_i], starts);
  ck_assert_double_ge(starts, 9);
}
ALSO_NIGHTLY(test_limits_from_a_neighbour, 0, 1)
ALSO_NIGHTLY(test_limits_from_a_neighbour, 2, 4)

/* Keys that differ by up to a third. Newton's method on the limit points diverges from there, so what the neighbour's
 * states lack to balance is taken away in parts. */
TEST(limits_from_a_far_neighbour) {
  static const double load[] = {4e-3, 5.3e-3, 5.3e-3, 4e-3}, thickness[] = {60e-6, 60e-6, 68e-6, 68e-6};
  ZpResult *near = NULL;
  double starts = 0;
  for (size_t k = 0; k < LENGTH_OF(load); k++) {
    ZpActuatorDef def = DEF({"load.mass", load[k]}, {"ribbon.thickness", thickness[k]}, {"mesh.nodes", 61},
                            {"liquid.model", ZP_LIQUID_NONE}, {"output.errors", false});
    near = same_limits(&def, near, 1e-9);
    starts += zp_result_get(near, "warm_starts");
  }
  printf("%g of 9 limits from the neighbour\n", starts);
  ck_assert_double_ge(starts, 8);
}

/* The limit point that is the neighbour's release is here beyond the gap at which the actuator counts as closed. */
TEST(opens_before_the_limit_point_of_its_neighbour) {
  ZpActuatorDef def = DEF({"ribbon.thickness", 130e-6}, {"load.mass", 0.0183721}, {"mesh.nodes", 31},
                          {"liquid.model", ZP_LIQUID_BEAD}, {"output.errors", false});
  ZpResult *near = limits_of(&def);
  def.load.mass = 0.0165349;
  ZpResult *warm = run(ZP_STUDY_LIMITS, &def, near), *cold = limits_of(&def);
  same(warm, cold, "release_voltage_V", 1e-9);
}

/* At low voltages it closes gradually, at high ones by a jump. */
TEST(largest_load_from_gradual_neighbours) {
  enum { STEPS = 9 };
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.048412202990474329}, {"ribbon.width", 0.010002352939080739},
          {"ribbon.thickness", 0.00039471274888573595}, {"ribbon.young_modulus", 70e9}, {"ribbon.poisson_ratio", 0.33},
          {"ribbon.density", 2700}, {"platform.length", 0.0048412202990474329},
          {"insulator.thickness", 0.00015023640093267249}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"load.mass", 0.017619527755016118}, {"mesh.nodes", 31}, {"electro.breakdown_cap", false});
  ZpResult *near = NULL;
  for (int k = 0; k < STEPS; k++) {
    def.drive.voltage = 2329.301621870031 * (0.55 + 0.05 * k);
    ZpResult *warm = run(ZP_STUDY_LIMITS, &def, near), *cold = limits_of(&def);
    same(warm, cold, "max_load_kg", 1e-10);
    near = warm;
  }
}

/* Thick ribbons open gradually: their release is no limit point, but it is followed, too. */
TEST(gradual_release_of_a_neighbour) {
  ZpActuatorDef def =
      DEF({"ribbon.thickness", 110e-6}, {"mesh.nodes", 61}, {"liquid.model", ZP_LIQUID_NONE}, {"output.errors", false});
  ZpResult *near = limits_of(&def);
  def.load.mass *= 1.01;
  ck_assert_double_eq(zp_result_get(same_limits(&def, near, 1e-9), "warm_starts"), 3);
}

/* Ribbons of 195 um close at their pull-in, those of 234 um fall from it to a state that closes gradually above. */
TEST(closes_above_the_pull_in_of_its_neighbour) {
  ZpActuatorDef def = DEF({"ribbon.width", 9.18193761e-3}, {"ribbon.thickness", 0.195035222e-3}, {"mesh.nodes", 61},
                          {"liquid.model", ZP_LIQUID_BEAD}, {"output.errors", false});
  ZpResult *near = limits_of(&def);
  def.ribbon.thickness = 0.234042267e-3;
  same_limits(&def, near, 1e-9);
}

/* The limit point of the neighbour's largest load is not the first that the voltage meets here. */
TEST(largest_load_is_not_at_the_limit_point_of_its_neighbour) {
  ZpActuatorDef def = DEF({"ribbon.width", 7.73756955e-3}, {"ribbon.length", 0.139473575}, {"mesh.nodes", 61},
                          {"liquid.model", ZP_LIQUID_NONE}, {"output.errors", false});
  ZpResult *near = limits_of(&def);
  def.ribbon.length = 0.16736829;
  ZpResult *warm = run(ZP_STUDY_LIMITS, &def, near), *cold = limits_of(&def);
  same(warm, cold, "max_load_kg", 1e-9);
}

static void check_no_neighbour(const ZpActuatorDef *def, const ZpActuatorDef *other) {
  ZpResult *near = limits_of(other), *warm = run(ZP_STUDY_LIMITS, def, near), *cold = limits_of(def);
  ck_assert_double_eq(zp_result_get(warm, "warm_starts"), 0);
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    same(warm, cold, names[i], 0);
}

/* One of another mesh, with other halves or with other joints is no neighbour. */
TEST(test_no_neighbour) {
  ZpActuatorDef fine = DEF({"mesh.nodes", 41}), coarse = DEF({"mesh.nodes", 31}), half = DEF({"mesh.nodes", 22}),
                whole = DEF({"mesh.nodes", 11}, {"actuator.symmetry", ZP_SYMMETRY_NONE}),
                parallel = DEF({"mesh.nodes", 11}, {"stack.parallel", 2}, {"member_1.ribbon.thickness", 51e-6}),
                series = DEF({"mesh.nodes", 11}, {"stack.series", 2});
  check_no_neighbour(&fine, &coarse);
  check_no_neighbour(&whole, &half);
  check_no_neighbour(&parallel, &series);
}

/* The table of study equilibrium follows whole branches, but its voltages do not depend on them, nor does the mesh. */
TESTS(coarse_mesh_has_one_answer, 0, 6) {
  ZpActuatorDef def = DEF({"mesh.nodes", 5 + _i / 2}, {"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", 100e-9},
                          {"bead.suction", _i % 2}, {"output.errors", 0});
  ZpResult *alone = run(ZP_STUDY_LIMITS, &def, NULL), *beside = run(ZP_STUDY_EQUILIBRIUM, &def, NULL);
  for (int k = 0; k < 3; k++)
    same(alone, beside, names[k], 0);
  ck_assert_uint_eq(notes_with(alone, "solved with"), notes_with(beside, "solved with"));
}

/* -- where there is none ----------------------------------------------------------------------------- */

static bool count_and_go_on(const void *calls) {
  ++*(int *)(size_t)calls;
  return false;
}

/* A computed field hides the limit point of a falling load on a very coarse mesh. The track towards it is given up, and
 * the largest load follows from its definition. */
NIGHTLY_TEST(a_track_that_creeps_is_given_up) {
  ZpActuatorDef def = DEF({"electro.model", ZP_ELECTRO_FIELD}, {"mesh.nodes", 5});
  ZpModel *model = model_of(&def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  int calls = 0;
  rest.statics.stop = count_and_go_on;
  rest.statics.caller = &calls;
  ZpLimits *limits = zp_limits_create(&rest);
  zp_limits_find(&rest, NULL, true, limits);
  printf("64 residuals %d times, largest load %.10g kg\n", calls, limits->limit[ZP_LIMIT_LOAD].value);
  ck_near(limits->limit[ZP_LIMIT_LOAD].value, 0.01029370505, 1.2e-9); /* 4.1e-10 measured */
  ck_assert_int_lt(calls, 160);                                       /* 83 measured; 316 without giving up */
  zp_limits_destroy(limits);
  zp_rest_close(&rest);
}

/* What does not exist is null, and the message says why. */
TEST(test_no_limit) {
  ZpActuatorDef low = DEF({"drive.voltage", 300}), none = DEF({"drive.voltage", 0}), light = DEF({"gravity", 0});
  ZpResult *result = limits_of(&low);
  ck_assert_double_nan(zp_result_get(result, "pull_in_voltage_V"));
  ck_assert_double_nan(zp_result_get(result, "closing_voltage_V"));
  ck_assert_ptr_nonnull(strstr(result->message, "no pull-in up to 300 V"));
  result = limits_of(&none);
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    ck_assert_double_nan(zp_result_get(result, names[i]));
  (void)light;
  ZpActuatorDef ribbon = DEF({"actuator.kind", ZP_KIND_RIBBON});
  ck_refused_by(ZP_STUDY_LIMITS, &ribbon, "actuator.kind");
}
