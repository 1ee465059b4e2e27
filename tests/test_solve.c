/* Symplectic Euler, the implicit midpoint rule and damped stepping on problems with known answers: harmonic
 * oscillators, falling ball, chains of springs. No actuator here. */
#include "arrow_util.h"

#include "solve/continuation.h"
#include "solve/explicit.h"
#include "solve/implicit.h"
#include "solve/newton.h"
#include "solve/relax.h"

/* -- symplectic Euler ------------------------------------------------------------------------------ */

typedef struct Oscillator {
  double omega2, dt;
  int calls;
} Oscillator;

static double swing(void *self, const double *q, const double *v, double *a) {
  (void)v;
  Oscillator *o = self;
  a[0] = -o->omega2 * q[0];
  o->calls++;
  return o->dt;
}

/* q(t_end) from q = 1, v = 0 with steps dt. */
static double swing_to(double omega, double dt, double t_end) {
  Oscillator o = {omega * omega, dt, 0};
  ZpExplicitSystem system = {1, &o, swing, NULL};
  double q = 1, v = 0, a, t = 0;
  while (t < t_end) {
    ZpExplicitStep step = zp_explicit_step(&system, t_end - t, &q, &v, &a);
    t = step.limit == ZP_EXPLICIT_END ? t_end : t + step.dt;
  }
  return q;
}

/* v += a dt; q += v dt from (1, 0): error of first order in dt. Measured ratios 1.99 to 2.01. */
TEST(test_order_one) {
  double error[4];
  for (int k = 0; k < 4; k++)
    error[k] = fabs(swing_to(2, 4e-3 / (1 << k), 1) - cos(2.0));
  for (int k = 0; k < 3; k++)
    ck_near(error[k] / error[k + 1], 2, 3e-3); /* 6.7e-4 measured */
}

/* The scheme conserves v^2 + w^2 q^2 - w^2 dt q v exactly, so the energy oscillates within w dt / 2 and does not drift:
 * 10,000 periods, w dt = 0.1. */
TEST(test_no_drift) {
  Oscillator o = {1, 0.1, 0};
  ZpExplicitSystem system = {1, &o, swing, NULL};
  double q = 1, v = 0, a, worst = 0, worst_kept = 0, kept = 1;
  for (int i = 0; i < 628319; i++) {
    zp_explicit_step(&system, 1, &q, &v, &a);
    worst = fmax(worst, fabs(q * q + v * v - 1));
    worst_kept = fmax(worst_kept, fabs(q * q + v * v - 0.1 * q * v - kept));
  }
  ck_below(worst, 0.05 / (1 - 0.05) * 1.001); /* extremes 1 / (1 +- w dt / 2) of the ellipse */
  ck_below(worst_kept, 1e-12);                /* rounding of 6e5 steps; measured 6e-14 */
  printf("oscillator, 10,000 periods: energy within %.3g, kept quantity within %.1e\n", worst, worst_kept);
  ck_assert_int_eq(o.calls, 628319);
}

TEST(test_unstable_beyond_two) {
  ck_below(fabs(swing_to(1, 1.99, 2000)), 5); /* bounded; 1.2 measured */
  ck_assert_double_gt(fabs(swing_to(1, 2.01, 2000)), 1e3);
}

TEST(test_bounds) {
  Oscillator o = {1, 0.1, 0};
  ZpExplicitSystem system = {1, &o, swing, NULL};
  double q = 1, v = 0, a;
  ZpExplicitStep step = zp_explicit_step(&system, 1, &q, &v, &a);
  ck_assert(step.dt == 0.1 && step.limit == ZP_EXPLICIT_BOUND);
  ck_assert_double_eq(v, -0.1);          /* v by the acceleration at the start */
  ck_assert_double_eq(q, 1 - 0.1 * 0.1); /* q by the new v */
  step = zp_explicit_step(&system, 0.03, &q, &v, &a);
  ck_assert(step.dt == 0.03 && step.limit == ZP_EXPLICIT_END);
}

/* -- events ---------------------------------------------------------------------------------------- */

enum { G = 10 };

static double fall(void *self, const double *q, const double *v, double *a) {
  (void)q, (void)v;
  a[0] = -G;
  return *(double *)self;
}

/* Ground at 0: first root of q + v s + a s^2, the motion of one step. */
static double ground(void *self, const double *q, const double *v, const double *a, double dt) {
  (void)self;
  double root = (v[0] + sqrt(v[0] * v[0] - 4 * a[0] * q[0])) / (-2 * a[0]);
  return root < dt ? root : dt;
}

/* A ball dropped from 1 m lands exactly on the ground, at the time of the discrete motion, which converges to sqrt(2 /
 * g) with the first order of dt. */
TEST(test_event_cut) {
  double late[3];
  for (int k = 0; k < 3; k++) {
    double dt = 1e-3 / (1 << k), q = 1, v = 0, a, t = 0;
    ZpExplicitSystem system = {1, &dt, fall, ground};
    ZpExplicitStep step = {0, ZP_EXPLICIT_BOUND};
    int steps = 0;
    while (step.limit != ZP_EXPLICIT_EVENT) {
      step = zp_explicit_step(&system, 1, &q, &v, &a);
      ck_assert(step.dt <= dt && step.dt >= 0);
      t += step.dt;
      steps++;
    }
    ck_assert_double_eq_tol(q, 0, 1e-14);
    ck_near(v, -G * t, 1e-12); /* 4.8e-14 measured */
    /* n full steps: q = 1 - g dt^2 n (n + 1) / 2, then the rest */
    double n = steps - 1, before = 1 - G * dt * dt * n * (n + 1) / 2, rest = t - n * dt;
    ck_assert_double_eq_tol(before - G * n * dt * rest - G * rest * rest, 0, 1e-12);
    late[k] = t - sqrt(2.0 / G);
  }
  ck_near(late[0] / late[1], 2, 2e-3); /* 6.6e-4 measured */
  ck_near(late[1] / late[2], 2, 3e-4); /* 8.7e-5 measured */
}

/* An event beyond the step, or beyond the end, does not cut it. */
TEST(test_event_beyond) {
  double dt = 1e-3, q = 1, v = 0, a;
  ZpExplicitSystem system = {1, &dt, fall, ground};
  ck_assert_int_eq(zp_explicit_step(&system, 1, &q, &v, &a).limit, ZP_EXPLICIT_BOUND);
  q = 1e-9;
  v = -1;
  ck_assert_int_eq(zp_explicit_step(&system, 1e-10, &q, &v, &a).limit, ZP_EXPLICIT_END);
  ck_assert_double_gt(q, 0);
}

/* -- damped stepping ------------------------------------------------------------------------------- */

/* A hanging chain: n masses of unit weight on springs k_i; rest: spring i carries what hangs below it. */
enum { CHAIN = 40 };

typedef struct Chain {
  double k[CHAIN], pseudo_mass;
  const double *a;
  int looks;
} Chain;

static void pull(void *self, const double *q, double *a) {
  Chain *c = self;
  for (int i = 0; i < CHAIN; i++) {
    double here = c->k[i] * (q[i] - (i ? q[i - 1] : 0));
    double below = i + 1 < CHAIN ? c->k[i + 1] * (q[i + 1] - q[i]) : 0;
    a[i] = (below - here + 1) / c->pseudo_mass;
  }
  c->a = a;
}

static double imbalance(void *self) {
  Chain *c = self;
  double largest = 0;
  for (int i = 0; i < CHAIN; i++)
    if (!(fabs(c->a[i]) <= largest)) largest = fabs(c->a[i]); /* NaN gets through */
  return largest * c->pseudo_mass / CHAIN;
}

static void fill_chain(Chain *c, double soft, double stiff) {
  double stiffest = fmax(soft, stiff);
  for (int i = 0; i < CHAIN; i++)
    c->k[i] = i % 4 == 3 ? soft : stiff;
  c->pseudo_mass = 4 * stiffest / (1.4 * 1.4);
}

static ZpRelaxInfo relax_chain(Chain *c, double tolerance, int64_t most, double *q) {
  double work[5 * CHAIN];
  ZpRelaxSystem system = {CHAIN, c, pull, imbalance, NULL};
  return zp_relax(&system, tolerance, most, q, work);
}

static const double stiffness[][2] = {{1, 1}, {1, 1e3}, {1e-3, 1e3}, {1e6, 1e6}};

TESTS(test_chain_rests, 0, LENGTH_OF(stiffness)) {
  Chain c;
  fill_chain(&c, stiffness[_i][0], stiffness[_i][1]);
  double q[CHAIN] = {0}, rest = 0;
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 10000000, q); /* measured 896, 11584, 380672, 896 steps */
  printf("chain, springs %g and %g: %lld steps\n", stiffness[_i][0], stiffness[_i][1], (long long)info.steps);
  ck_assert_int_eq(info.end, ZP_RELAX_AT_REST);
  ck_below(info.residual, 1e-9); /* 1e-9 measured */
  double error = 0;
  for (int i = 0; i < CHAIN; i++) {
    rest += (CHAIN - i) / c.k[i];
    error = fmax(error, fabs(q[i] - rest));
  }
  /* imbalance 1e-9 of the weight on every mass at worst: CHAIN times that of the elongation */
  ck_below(error, CHAIN * 1e-9 * rest);
  /* steps grow with the root of the condition: a few periods of the slowest mode, where every fourth spring
   * is soft, k over 4 masses, or all are */
  double lumps = stiffness[_i][0] < stiffness[_i][1] ? 4 : 1;
  double slowest = sqrt(stiffness[_i][0] / (lumps * c.pseudo_mass)) * M_PI / (2 * CHAIN / lumps);
  printf("that is %.1f periods\n", (double)info.steps * slowest / (2 * M_PI));
  ck_below((double)info.steps * slowest / (2 * M_PI), 8); /* measured 3.2 to 3.9 */
}

TEST(test_relax_at_rest_at_once) {
  Chain c;
  fill_chain(&c, 1, 1);
  double q[CHAIN], rest = 0;
  for (int i = 0; i < CHAIN; i++)
    q[i] = rest += CHAIN - i;
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 100, q);
  ck_assert_int_eq(info.end, ZP_RELAX_AT_REST);
  ck_assert_int_eq(info.steps, 0);
}

TEST(test_relax_step_limit) {
  Chain c;
  fill_chain(&c, 1, 1);
  double q[CHAIN] = {0};
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 10, q);
  ck_assert_int_eq(info.end, ZP_RELAX_STEP_LIMIT);
  ck_assert_int_eq(info.steps, 10);
}

TEST(test_relax_diverges) {
  Chain c;
  fill_chain(&c, 1, 1);
  c.pseudo_mass = 0.1; /* far beyond stability */
  double q[CHAIN] = {0};
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 1000000, q);
  ck_assert_int_eq(info.end, ZP_RELAX_DIVERGED);
}

static bool stop_after_three(void *self, int64_t steps, double residual) {
  (void)steps;
  ck_assert(residual > 0);
  return ++((Chain *)self)->looks == 3;
}

TEST(test_relax_stops) {
  Chain c = {.looks = 0};
  fill_chain(&c, 1, 1);
  double q[CHAIN] = {0}, work[5 * CHAIN];
  ZpRelaxSystem system = {CHAIN, &c, pull, imbalance, stop_after_three};
  ck_assert_int_eq(zp_relax(&system, 1e-12, 1000000, q, work).end, ZP_RELAX_STOPPED);
  ck_assert_int_eq(c.looks, 3);
}

/* -- implicit midpoint rule ------------------------------------------------------------------------ */

/* Two unequal masses one after the other on springs, the first one held at its left: mean forces -k (q0 + q1) / 2, and
 * a cubic part of the first spring whose mean does exactly the work of its energy c q^4 / 4. */
typedef struct Springs {
  double k[2], c, mass[2], q0[2], q1[2];
  double longest; /* beyond steps of this length there is no force, s, */
  ZpEnd beyond;   /* but this answer */
  ZpArrowForm form;
  ZpImplicitSystem system;
  ZpImplicit stepper;
  ZpImplicitHistory history;
  double q[2], v[2], w[2], a[2];
  void *memory;
} Springs;

static double springs_begin(void *self, const double *q0, const double *v0) {
  Springs *s = self;
  (void)v0;
  memcpy(s->q0, q0, sizeof s->q0);
  return 0.5 * s->k[0] * q0[0] * q0[0] + 0.5 * s->k[1] * (q0[1] - q0[0]) * (q0[1] - q0[0]);
}

static double cubic(double a, double b) {
  return 0.25 * (a + b) * (a * a + b * b); /* (b^4 - a^4) / 4 over b - a */
}

static ZpEnd springs_force(void *self, const double *q1, double h, double *f) {
  Springs *s = self;
  memcpy(s->q1, q1, sizeof s->q1);
  double first = 0.5 * s->k[0] * (s->q0[0] + q1[0]) + s->c * cubic(s->q0[0], q1[0]);
  double second = 0.5 * s->k[1] * (s->q0[1] - s->q0[0] + q1[1] - q1[0]);
  f[0] = second - first;
  f[1] = -second;
  return h > s->longest ? s->beyond : ZP_END_FOUND;
}

static void springs_tangent(void *self, ZpArrow *J) {
  Springs *s = self;
  ZpBand *A = &J->part->A;
  double a = s->q0[0], b = s->q1[0];
  zp_band_clear(A);
  *zp_band_at(A, 0, 0) = 0.5 * (s->k[0] + s->k[1]) + s->c * 0.25 * (a * a + 2 * a * b + 3 * b * b);
  *zp_band_at(A, 0, 1) = -0.5 * s->k[1];
  *zp_band_at(A, 1, 1) = 0.5 * s->k[1];
}

static void free_springs(Springs *s) {
  zp_free(s->memory);
  zp_arrow_form_destroy(&s->form);
}

/* The first mass 1 off its rest, all still. */
static void make_springs(Springs *s, double k0, double k1, double c) {
  *s = (Springs){.k = {k0, k1}, .c = c, .mass = {1, 0.5}, .longest = 1, .beyond = ZP_END_SHORTER, .q = {1, 1}};
  s->form = form_of_block(2, (ZpBandForm){.bandwidth = 1, .symmetric = true});
  s->system = (ZpImplicitSystem){.n = 2,
                                 .form = &s->form,
                                 .self = s,
                                 .mass = s->mass,
                                 .begin = springs_begin,
                                 .residual = springs_force,
                                 .tangent = springs_tangent};
  ZpArena arena = {NULL, 0};
  zp_implicit_reserve(&s->stepper, &s->system, &arena);
  s->memory = zp_calloc(1, arena.used);
  arena = (ZpArena){s->memory, 0};
  zp_implicit_reserve(&s->stepper, &s->system, &arena);
  s->stepper.accuracy = 1e-9;
  s->stepper.balance = 1e-9;
  s->history = (ZpImplicitHistory){.w = s->w, .a = s->a};
}

static double springs_step(Springs *s, double longest) {
  return zp_implicit_step(&s->stepper, longest, s->q, s->v, &s->history);
}

static void springs_run(Springs *s, double end) {
  for (double t = 0; t < end;) {
    double left = end - t, h = springs_step(s, left);
    ck_assert_double_gt(h, 0);
    t = h == left ? end : t + h;
  }
}

static double springs_energy(const Springs *s) {
  double u = s->q[0], d = s->q[1] - u;
  return 0.5 * (s->mass[0] * s->v[0] * s->v[0] + s->mass[1] * s->v[1] * s->v[1] + s->k[0] * u * u + s->k[1] * d * d) +
         0.25 * s->c * u * u * u * u;
}

/* One mass on a spring, the second one decoupled: q = cos(w t), error of second order. The rule turns by 2 atan(w h /
 * 2) a step, exactly. Measured ratios 4.00, off that phase by 5e-14. */
TEST(test_implicit_order_two) {
  const double omega = 2;
  double error[4];
  for (int k = 0; k < 4; k++) {
    Springs s;
    make_springs(&s, omega * omega, 0, 0);
    s.stepper.fixed = 0.02 / (1 << k);
    int steps = 50 << k;
    for (int i = 0; i < steps; i++)
      ck_assert_double_eq(springs_step(&s, 1), s.stepper.fixed);
    error[k] = fabs(s.q[0] - cos(omega * 1));
    ck_assert_double_eq_tol(s.q[0], cos(2 * steps * atan(0.5 * omega * s.stepper.fixed)), 1e-12);
    ck_assert_double_eq(s.q[1], 1);
    ck_assert_int_eq(s.stepper.counts.steps, steps);
    free_springs(&s);
  }
  for (int k = 0; k < 3; k++)
    ck_near(error[k] / error[k + 1], 4, 5e-4); /* 1.3e-4 measured */
}

/* 10,000 steps, w h = 0.4, also with a cubic spring: the energy is constant for any step. Its drift is that of rounding
 * and, where forces are not linear, of what Newton's method leaves. Measured: 1.3e-13, with the cubic part 8e-14. */
TEST(test_implicit_keeps_energy) {
  static const double cube[] = {0, 30};
  for (size_t i = 0; i < LENGTH_OF(cube); i++) {
    Springs s;
    make_springs(&s, 1, 2, cube[i]);
    s.stepper.fixed = 0.4;
    double start = springs_energy(&s), worst = 0;
    for (int k = 0; k < 10000; k++) {
      ck_assert_double_eq(springs_step(&s, 1), 0.4);
      worst = fmax(worst, fabs(springs_energy(&s) / start - 1));
    }
    printf("implicit, cubic part %g: energy within %.1e over 10,000 steps, %.2f iterations a step\n", cube[i], worst,
           (double)s.stepper.counts.iterations / 1e4);
    ck_below(worst, 1e-12);
    free_springs(&s);
  }
}

/* Slow mode of a pair joined by a spring 1e8 times stiffer: w = sqrt(1 / 1.5). Steps follow the slow mode, far beyond
 * what the stiff one (w = 1.7e4) allows an explicit rule, and the pair stays together. Measured: 0.027 s a step, 230
 * times 2 / 1.7e4, off by 4.4e-4. */
TEST(test_implicit_stiff) {
  Springs s;
  make_springs(&s, 1, 1e8, 0);
  s.stepper.accuracy = 1e-6;
  springs_run(&s, 10);
  double mean = 10 / (double)s.stepper.counts.steps, off = s.q[0] - cos(10 * sqrt(1 / 1.5));
  printf("implicit, stiff pair: %.2g s a step, off by %.1e, %lld rejected\n", mean, off,
         (long long)s.stepper.counts.rejected);
  ck_assert_double_gt(mean, 100 * 2 / 1.7e4);
  ck_below(fabs(off), 1e-3);
  ck_below(fabs(s.q[1] - s.q[0]), 3e-8);               /* 4.2e-9 measured */
  ck_below(fabs(springs_energy(&s) / 0.5 - 1), 1e-12); /* 3.3e-14 measured */
  free_springs(&s);
}

/* The local error is of order h^3, that of a run of order h^2: an eighth of the tolerance gives half the step and a
 * quarter of the error. Measured: ratios of errors 3.8, 3.8, 3.9, of steps 1.94, 1.97, 1.99. */
TEST(test_implicit_error_control) {
  double error[4];
  int64_t steps[4];
  for (int k = 0; k < 4; k++) {
    Springs s;
    make_springs(&s, 4, 0, 0);
    s.stepper.accuracy = 1e-5 / (1 << 3 * k);
    springs_run(&s, 10);
    error[k] = hypot(s.q[0] - cos(20.0), 0.5 * s.v[0] + sin(20.0));
    steps[k] = s.stepper.counts.steps;
    printf("implicit, accuracy %.1e: error %.2e in %lld steps\n", s.stepper.accuracy, error[k], (long long)steps[k]);
    free_springs(&s);
  }
  for (int k = 0; k < 3; k++) {
    ck_near(error[k] / error[k + 1], 4, 0.15);
    ck_near((double)steps[k + 1] / (double)steps[k], 2, 0.15);
  }
}

/* No force, no step: all as it was. */
TEST(test_implicit_no_force) {
  Springs s;
  make_springs(&s, 4, 1, 3);
  for (int i = 0; i < 20; i++)
    springs_step(&s, 1);
  Springs before = s;
  s.longest = 0;
  ck_assert_double_eq(springs_step(&s, 1), 0);
  ck_assert_mem_eq(s.q, before.q, sizeof s.q);
  ck_assert_mem_eq(s.v, before.v, sizeof s.v);
  ck_assert_mem_eq(s.w, before.w, sizeof s.w);
  ck_assert_mem_eq(s.a, before.a, sizeof s.a);
  ck_assert(s.history.last == before.history.last && s.history.next == before.history.next);
  ck_assert_int_eq(s.stepper.counts.steps, before.stepper.counts.steps);
  ck_assert_int_gt(s.stepper.counts.failures, before.stepper.counts.failures);
  ck_assert_int_eq(s.stepper.end, ZP_END_SHORTER);
  s.longest = 1; /* and goes on when the force is back */
  ck_assert_double_gt(springs_step(&s, 1), 0);
  free_springs(&s);
}

/* Where there is no force over long steps, they are halved until there is. */
TEST(test_implicit_shorter_step) {
  Springs s;
  make_springs(&s, 4, 0, 0);
  s.stepper.fixed = 0.1;
  s.longest = 0.02;
  ck_assert_double_eq(springs_step(&s, 1), 0.1 / 8);
  ck_assert_int_eq(s.stepper.counts.failures, 3);
  ck_assert_int_eq(s.stepper.counts.steps, 1);
  free_springs(&s);
}

/* A system that says that no shorter step would do is asked once, and left as it was. */
TEST(test_implicit_stops) {
  Springs s;
  make_springs(&s, 4, 0, 0);
  s.stepper.fixed = 0.1;
  s.longest = 0.02;
  s.beyond = ZP_END_STOP;
  ck_assert_double_eq(springs_step(&s, 1), 0);
  ck_assert_int_eq(s.stepper.end, ZP_END_STOP);
  ck_assert_int_eq(s.stepper.counts.failures, 0);
  ck_assert(s.q[0] == 1 && s.v[0] == 0 && s.history.last == 0);
  s.longest = 1;
  ck_assert_double_eq(springs_step(&s, 1), 0.1);
  ck_assert_int_eq(s.stepper.end, ZP_END_FOUND);
  free_springs(&s);
}

/* Positions, velocities and history are all that it remembers. */
TEST(test_implicit_restart) {
  Springs one, two;
  make_springs(&one, 4, 50, 3);
  make_springs(&two, 4, 50, 3);
  for (int i = 0; i < 50; i++)
    springs_step(&one, 1);
  memcpy(two.q, one.q, sizeof one.q);
  memcpy(two.v, one.v, sizeof one.v);
  memcpy(two.w, one.w, sizeof one.w);
  memcpy(two.a, one.a, sizeof one.a);
  two.history.last = one.history.last;
  two.history.next = one.history.next;
  for (int i = 0; i < 50; i++) {
    ck_assert_double_eq(springs_step(&one, 1), springs_step(&two, 1));
    ck_assert_mem_eq(one.q, two.q, sizeof one.q);
    ck_assert_mem_eq(one.v, two.v, sizeof one.v);
  }
  free_springs(&one);
  free_springs(&two);
}

/* Steps end where they must: never beyond `longest`, and a step that is cut leaves the length of the next as it was. */
TEST(test_implicit_cut) {
  Springs s;
  make_springs(&s, 4, 0, 0);
  for (int i = 0; i < 40; i++)
    springs_step(&s, 1);
  double next = s.history.next;
  ck_assert_double_eq(springs_step(&s, 0.1 * next), 0.1 * next);
  ck_assert_double_eq(s.history.next, next);
  free_springs(&s);
}

/* Fixed steps that fill a time but for rounding do so: no step is left that is too short to be taken. */
TEST(test_implicit_fills_time) {
  for (int n = 3; n < 2000; n += 97) {
    Springs s;
    make_springs(&s, 4, 0, 0);
    s.stepper.fixed = 1.0 / n;
    springs_run(&s, 1);
    ck_assert_int_eq(s.stepper.counts.steps, n);
    free_springs(&s);
  }
}

/* -- rest ------------------------------------------------------------------------------------------ */

/* A spring that only holds up to a stretch of 1: beyond there is no force. */
typedef struct Rest {
  double q, pull;
  int asked;
} Rest;

static ZpEnd rest_left(void *self, double *r, double *size) {
  Rest *rest = self;
  rest->asked++;
  if (rest->q > 1) return ZP_END_SHORTER;
  r[0] = rest->pull - rest->q;
  if (size) *size = fabs(r[0]);
  return ZP_END_FOUND;
}

static void rest_stiffness(void *self, ZpArrow *K, double *r) {
  (void)self, (void)r;
  *K->diagonal[0] = 1;
}

static double rest_length(void *self, const double *step) {
  (void)self, (void)step;
  return 0;
}

static double rest_change(void *self, const double *step) {
  (void)self;
  return fabs(step[0]) / 1e-9;
}

static void rest_move(void *self, const double *step, double fraction) {
  ((Rest *)self)->q += fraction * step[0];
}

/* Newton's method goes nowhere from a point that has no residual, and says so. */
TEST(test_newton_without_residual) {
  double r[1];
  ZpArrowForm form = form_of_block(1, (ZpBandForm){.symmetric = true});
  ZpNewtonWork work = {.r = r};
  void *memory = zero_arrow(&work.K, &form);
  Rest rest = {0, 0.5, 0};
  ZpStaticSystem system = {.n = 1,
                           .self = &rest,
                           .residual = rest_left,
                           .stiffness = rest_stiffness,
                           .length = rest_length,
                           .change = rest_change,
                           .move = rest_move};
  ck_assert_int_eq(zp_newton(&system, 1e-12, 20, &work).end, ZP_NEWTON_CONVERGED);
  ck_assert_double_eq(rest.q, 0.5);
  rest = (Rest){0, 2, 0};
  ZpNewtonInfo info = zp_newton(&system, 1e-12, 20, &work);
  ck_assert_int_eq(info.end, ZP_NEWTON_DIVERGED);
  ck_assert(isinf(info.residual));
  ck_assert_int_eq(rest.asked, 2);
  zp_free(memory);
  zp_arrow_form_destroy(&form);
}

/* The same spring, while half of its stretch, as it was when it was last looked at, pulls in addition. */
typedef struct Held {
  Rest rest;
  double held;
  int looked;
} Held;

static ZpEnd held_left(void *self, double *r, double *size) {
  Held *held = self;
  r[0] = held->rest.pull + held->held - held->rest.q;
  if (size) *size = fabs(r[0]);
  return ZP_END_FOUND;
}

static ZpEnd look_again(void *self) {
  Held *held = self;
  held->looked++;
  held->held = 0.5 * held->rest.q;
  return ZP_END_FOUND;
}

/* An equilibrium counts once what is held between iterations is that of the equilibrium itself. */
TEST(newton_ends_with_what_it_holds) {
  double r[1];
  ZpArrowForm form = form_of_block(1, (ZpBandForm){.symmetric = true});
  ZpNewtonWork work = {.r = r};
  void *memory = zero_arrow(&work.K, &form);
  Held held = {{0, 0.5, 0}, 0, 0};
  ZpStaticSystem system = {.n = 1,
                           .self = &held,
                           .residual = held_left,
                           .stiffness = rest_stiffness,
                           .length = rest_length,
                           .change = rest_change,
                           .move = rest_move,
                           .refresh = look_again};
  ck_assert(zp_newton_good(zp_newton(&system, 1e-12, 200, &work).end));
  ck_below(fabs(held.rest.q - 1), 1e-11); /* 1.8e-12 measured */
  ck_assert_int_gt(held.looked, 10);
  zp_free(memory);
  zp_arrow_form_destroy(&form);
}

/* -- a branch that turns twice ----------------------------------------------------------------------- */

/* m = q - 3 w tanh((q - 1) / w) turns back and forth within about w of q = 1. */
typedef struct Curve {
  double q, m, w;
} Curve;

static ZpEnd curve_left(void *self, double *r, double *size) {
  const Curve *c = self;
  r[0] = c->m - (c->q - 3 * c->w * tanh((c->q - 1) / c->w));
  if (size) *size = fabs(r[0]);
  return ZP_END_FOUND;
}

static void curve_stiffness(void *self, ZpArrow *K, double *r) {
  const Curve *c = self;
  const double cosine = cosh((c->q - 1) / c->w);
  (void)r;
  *K->diagonal[0] = 1 - 3 / (cosine * cosine);
}

static void curve_move(void *self, const double *step, double fraction) {
  ((Curve *)self)->q += fraction * step[0];
}

static void curve_by_m(void *self, double *r_m) {
  (void)self;
  r_m[0] = 1;
}

static void curve_at(void *self, double *q) {
  q[0] = ((Curve *)self)->q;
}

static void curve_save(void *self, void *to) {
  *(Curve *)to = *(Curve *)self;
}

static void curve_restore(void *self, const void *from) {
  *(Curve *)self = *(const Curve *)from;
}

/* Steps that could pass over both turns find the part between them, where the branch goes back. */
TESTS(branch_that_turns_twice_is_followed, 1, 8) {
  Curve curve = {0, 0, 0.004 * pow(1.5, _i)};
  curve.m = 3 * curve.w; /* tanh is -1 so far away */
  ZpArrowForm form = form_of_block(1, (ZpBandForm){.symmetric = true});
  ZpBranchSystem system = {.at_rest = {.n = 1,
                                       .self = &curve,
                                       .residual = curve_left,
                                       .stiffness = curve_stiffness,
                                       .length = rest_length,
                                       .change = rest_change,
                                       .move = curve_move},
                           .input = &curve.m,
                           .sensitivity = curve_by_m,
                           .position = curve_at,
                           .save = curve_save,
                           .restore = curve_restore,
                           .save_size = sizeof curve,
                           .q_scale = 1,
                           .m_scale = 1};
  ZpNewtonWork work;
  ZpBranch branch;
  ZpArena arena = {NULL, 0};
  void *memory = NULL;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) arena = (ZpArena){memory = zp_calloc(1, arena.used), 0};
    zp_newton_reserve(&work, &form, &arena);
    zp_branch_reserve(&branch, &system, &work, &arena);
  }
  int back = 0;
  ck_assert(zp_branch_start(&branch, true, 0.01, 0.12, 1e-10));
  while (curve.q < 2 && zp_branch_advance(&branch))
    back += branch.direction_m < 0;
  printf("w = %.4f: %d points on the way back\n", curve.w, back);
  ck_assert_double_gt(curve.q, 2);
  ck_assert_int_gt(back, 0);
  zp_free(memory);
  zp_arrow_form_destroy(&form);
}
