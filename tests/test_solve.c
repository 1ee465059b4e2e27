/* Symplectic Euler and damped stepping on problems with known answers: harmonic oscillator, falling ball,
 * chains of springs. No actuator here. */
#include "check_util.h"

#include "solve/explicit.h"
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
START_TEST(test_order_one) {
  double error[4];
  for (int k = 0; k < 4; k++)
    error[k] = fabs(swing_to(2, 4e-3 / (1 << k), 1) - cos(2.0));
  for (int k = 0; k < 3; k++)
    ck_near(error[k] / error[k + 1], 2, 0.02);
}
END_TEST

/* The scheme keeps v^2 + w^2 q^2 - w^2 dt q v exactly, so energy swings within w dt / 2 and does not drift:
 * 10,000 periods, w dt = 0.1. */
START_TEST(test_no_drift) {
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
END_TEST

START_TEST(test_unstable_beyond_two) {
  ck_below(fabs(swing_to(1, 1.99, 2000)), 20); /* bounded */
  ck_assert_double_gt(fabs(swing_to(1, 2.01, 2000)), 1e3);
}
END_TEST

START_TEST(test_bounds) {
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
END_TEST

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

/* A ball dropped from 1 m lands exactly on the ground, at the time that the discrete motion takes; that
 * tends to sqrt(2 / g) with the first order of dt. */
START_TEST(test_event_cut) {
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
    ck_near(v, -G * t, 1e-11);
    /* n full steps: q = 1 - g dt^2 n (n + 1) / 2, then the rest */
    double n = steps - 1, before = 1 - G * dt * dt * n * (n + 1) / 2, rest = t - n * dt;
    ck_assert_double_eq_tol(before - G * n * dt * rest - G * rest * rest, 0, 1e-12);
    late[k] = t - sqrt(2.0 / G);
  }
  ck_near(late[0] / late[1], 2, 0.05);
  ck_near(late[1] / late[2], 2, 0.05);
}
END_TEST

/* An event beyond the step, or beyond the end, does not cut it. */
START_TEST(test_event_beyond) {
  double dt = 1e-3, q = 1, v = 0, a;
  ZpExplicitSystem system = {1, &dt, fall, ground};
  ck_assert_int_eq(zp_explicit_step(&system, 1, &q, &v, &a).limit, ZP_EXPLICIT_BOUND);
  q = 1e-9;
  v = -1;
  ck_assert_int_eq(zp_explicit_step(&system, 1e-10, &q, &v, &a).limit, ZP_EXPLICIT_END);
  ck_assert_double_gt(q, 0);
}
END_TEST

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

START_TEST(test_chain_rests) {
  Chain c;
  fill_chain(&c, stiffness[_i][0], stiffness[_i][1]);
  double q[CHAIN] = {0}, rest = 0;
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 10000000, q); /* measured 896, 11584, 380672, 896 steps */
  printf("chain, springs %g and %g: %lld steps\n", stiffness[_i][0], stiffness[_i][1], (long long)info.steps);
  ck_assert_int_eq(info.end, ZP_RELAX_AT_REST);
  ck_below(info.residual, 1e-9);
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
END_TEST

START_TEST(test_relax_at_rest_at_once) {
  Chain c;
  fill_chain(&c, 1, 1);
  double q[CHAIN], rest = 0;
  for (int i = 0; i < CHAIN; i++)
    q[i] = rest += CHAIN - i;
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 100, q);
  ck_assert_int_eq(info.end, ZP_RELAX_AT_REST);
  ck_assert_int_eq(info.steps, 0);
}
END_TEST

START_TEST(test_relax_step_limit) {
  Chain c;
  fill_chain(&c, 1, 1);
  double q[CHAIN] = {0};
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 10, q);
  ck_assert_int_eq(info.end, ZP_RELAX_STEP_LIMIT);
  ck_assert_int_eq(info.steps, 10);
}
END_TEST

START_TEST(test_relax_diverges) {
  Chain c;
  fill_chain(&c, 1, 1);
  c.pseudo_mass = 0.1; /* far beyond stability */
  double q[CHAIN] = {0};
  ZpRelaxInfo info = relax_chain(&c, 1e-9, 1000000, q);
  ck_assert_int_eq(info.end, ZP_RELAX_DIVERGED);
}
END_TEST

static bool stop_after_three(void *self, int64_t steps, double residual) {
  (void)steps;
  ck_assert(residual > 0);
  return ++((Chain *)self)->looks == 3;
}

START_TEST(test_relax_stops) {
  Chain c = {.looks = 0};
  fill_chain(&c, 1, 1);
  double q[CHAIN] = {0}, work[5 * CHAIN];
  ZpRelaxSystem system = {CHAIN, &c, pull, imbalance, stop_after_three};
  ck_assert_int_eq(zp_relax(&system, 1e-12, 1000000, q, work).end, ZP_RELAX_STOPPED);
  ck_assert_int_eq(c.looks, 3);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("solve");
  TCase *euler = tcase_create("explicit");
  tcase_set_timeout(euler, 60);
  tcase_add_test(euler, test_order_one);
  tcase_add_test(euler, test_no_drift);
  tcase_add_test(euler, test_unstable_beyond_two);
  tcase_add_test(euler, test_bounds);
  tcase_add_test(euler, test_event_cut);
  tcase_add_test(euler, test_event_beyond);
  suite_add_tcase(suite, euler);
  TCase *relax = tcase_create("relax");
  tcase_set_timeout(relax, 60);
  tcase_add_loop_test(relax, test_chain_rests, 0, LENGTH_OF(stiffness));
  tcase_add_test(relax, test_relax_at_rest_at_once);
  tcase_add_test(relax, test_relax_step_limit);
  tcase_add_test(relax, test_relax_diverges);
  tcase_add_test(relax, test_relax_stops);
  suite_add_tcase(suite, relax);
  return run_suite(suite);
}
