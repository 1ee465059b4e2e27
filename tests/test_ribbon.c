/* One ribbon: section constants, axial springs, the paper's shear law.
 *
 * Against: closed forms of a beam section (single layer; Timoshenko's formula of the bimetal strip), forces
 * as central differences of the axial energy, the moment law M = K_S l^2 sin(phi) cos(phi) of one joint, momentum
 * of a free ribbon, and the deflections P L^3 / (12 E I) of a guided and P L^3 / (3 E I) of a cantilever
 * beam. What has no potential is measured: the curl of the shear law. */
#include "check_util.h"

#include "base/kernel.h"
#include "base/memory.h"
#include "paper/massspring.h"
#include "ribbon/section.h"
#include "solve/explicit.h"

/* -- section --------------------------------------------------------------------------------------- */

static const ZpLayer steel = {50e-6, 200e9, 0.285, 7850}, tape = {130e-6, 3e9, 0.4, 1300};
static const double width = 12.7e-3;

TEST(test_single_layer) {
  double b = steel.thickness, I = width * b * b * b / 12;
  ZpSection strain = zp_section(&steel, 1, width, 1), stress = zp_section(&steel, 1, width, 0);
  ck_near(strain.EI, 200e9 * I / (1 - 0.285 * 0.285), 1e-14);
  ck_near(stress.EI, 200e9 * I, 1e-14);
  ck_near(strain.EA, 200e9 * width * b, 1e-14); /* plane strain stiffens bending only */
  ck_near(stress.EA, 200e9 * width * b, 1e-14);
  ck_near(strain.mu, 7850 * width * b, 1e-14);
}

/* Timoshenko 1925: bending stiffness per width of two layers on each other. */
static double bimetal(double E1, double h1, double E2, double h2) {
  double a = E1 * h1, b = E2 * h2;
  double sum = a * a * h1 * h1 + b * b * h2 * h2 + 2 * a * b * (2 * h1 * h1 + 3 * h1 * h2 + 2 * h2 * h2);
  return sum / (12 * (a + b));
}

TEST(test_two_layers) {
  const ZpLayer layers[2] = {steel, tape}, turned[2] = {tape, steel};
  ZpSection stress = zp_section(layers, 2, width, 0), strain = zp_section(layers, 2, width, 1);
  double h1 = steel.thickness, h2 = tape.thickness;
  ck_near(stress.EI, width * bimetal(200e9, h1, 3e9, h2), 1e-13);
  ck_near(strain.EI, width * bimetal(200e9 / (1 - 0.285 * 0.285), h1, 3e9 / (1 - 0.4 * 0.4), h2), 1e-13);
  ck_near(stress.EA, width * (200e9 * h1 + 3e9 * h2), 1e-14);
  ck_near(stress.mu, width * (7850 * h1 + 1300 * h2), 1e-14);
  ck_near(zp_section(turned, 2, width, 1).EI, strain.EI, 1e-13); /* whichever side the tape is on */
}

/* Two equal layers equal one of twice the thickness; a layer without stiffness adds weight only. */
TEST(test_section_limits) {
  const ZpLayer twice[2] = {steel, steel};
  ZpLayer thick = steel, limp = tape;
  thick.thickness *= 2;
  ck_near(zp_section(twice, 2, width, 1).EI, zp_section(&thick, 1, width, 1).EI, 1e-14);
  limp.young_modulus = 0;
  const ZpLayer pair[2] = {steel, limp};
  ZpSection section = zp_section(pair, 2, width, 1);
  ck_near(section.EI, zp_section(&steel, 1, width, 1).EI, 1e-14);
  ck_near(section.mu, width * (7850 * 50e-6 + 1300 * 130e-6), 1e-14);
  const ZpLayer nothing = {1e-4, 0, 0, 0};
  ck_assert_double_eq(zp_section(&nothing, 1, width, 1).EI, 0);
}

/* Layers of one material are a beam of height h, whichever of them grows: EI grows by 3 EI / h. */
TEST(layer_between_others_grows) {
  ZpLayer layer[3] = {steel, steel, steel};
  layer[1].thickness = 20e-6;
  layer[2].thickness = 90e-6;
  for (int k = 0; k < 3; k++)
    ck_near(zp_section_by(layer, 3, width, 1, k, ZP_LAYER_THICKNESS).EI,
            3 * zp_section(layer, 3, width, 1).EI / (50e-6 + 20e-6 + 90e-6), 1e-14);
}

/* -- a ribbon of mass and springs, in units of order one -------------------------------------------- */

enum { MOST_NODES = 64, PLACES = 2 * MOST_NODES + 2 * ZP_LANES };

typedef struct Ribbon {
  ZpMassSpringParams p;
  ZpMassSpringEval e;
  double q[2 * PLACES], f[2 * PLACES]; /* all x, then all y, PLACES apart; force of every node */
  void *memory;
} Ribbon;

static void make_ribbon(Ribbon *r, size_t ribbons, size_t nodes, double K_D, double K_S, bool held) {
  memset(r, 0, sizeof *r);
  r->p = (ZpMassSpringParams){.ribbons = ribbons,
                              .nodes = nodes,
                              .lanes = PLACES,
                              .l = 1,
                              .K_D = K_D,
                              .K_S = K_S,
                              .left_slope = held,
                              .right_slope = held};
  ZpArena measure = {NULL, 0};
  zp_massspring_reserve(&r->p, &r->e, &measure);
  r->memory = zp_calloc(1, measure.used);
  ZpArena arena = {r->memory, 0};
  zp_massspring_reserve(&r->p, &r->e, &arena);
  for (size_t j = 0; j < PLACES; j++)
    r->q[j] = (double)(j / ribbons);
}

static void free_ribbon(Ribbon *r) {
  zp_free(r->memory);
}

static size_t node_count(const Ribbon *r) {
  return r->p.ribbons * r->p.nodes;
}

/* Move every node by up to `size`. */
static void shake(Ribbon *r, double size, uint64_t seed) {
  for (size_t j = 0; j < node_count(r); j++) {
    r->q[j] += size * noise(&seed);
    r->q[PLACES + j] += size * noise(&seed);
  }
}

static void eval_forces(Ribbon *r) {
  zp_massspring_eval(&r->p, r->q, r->q + PLACES, &r->e);
  ptrdiff_t s = (ptrdiff_t)r->p.ribbons, count = (ptrdiff_t)node_count(r);
  for (ptrdiff_t j = 0; j < count; j++) {
    r->f[j] = r->e.Rx[j - s] - r->e.Rx[j];
    r->f[PLACES + j] = r->e.Ry[j - s] - r->e.Ry[j];
  }
}

static double axial_energy(Ribbon *r) {
  zp_massspring_eval(&r->p, r->q, r->q + PLACES, &r->e);
  return zp_massspring_axial_energy(&r->p, &r->e);
}

/* Force = -dU/dq of the axial springs. Measured: 9e-11 of the largest force, what central differences
 * with h = 1e-5 leave (h^2 and rounding / h). */
TEST(test_axial_force_is_gradient) {
  const double h = 1e-5;
  Ribbon r;
  for (size_t ribbons = 1; ribbons <= 2; ribbons++) {
    make_ribbon(&r, ribbons, 21, 3, 0, ribbons == 2);
    shake(&r, 0.4, 7 + ribbons);
    eval_forces(&r);
    double largest = 0, worst = 0, f[2 * PLACES];
    memcpy(f, r.f, sizeof f);
    for (size_t k = 0; k < 2 * PLACES; k++) {
      if (k % PLACES >= node_count(&r)) continue;
      double q = r.q[k];
      r.q[k] = q + h;
      double above = axial_energy(&r);
      r.q[k] = q - h;
      double below = axial_energy(&r);
      r.q[k] = q;
      worst = fmax(worst, fabs(f[k] + (above - below) / (2 * h)));
      largest = fmax(largest, fabs(f[k]));
    }
    printf("axial force against -dU/dq, %zu ribbons: %.1e of the largest\n", ribbons, worst / largest);
    ck_below(worst / largest, 5e-10); /* 8.5e-11 measured */
    free_ribbon(&r);
  }
}

/* One joint between two edges of length 1, by hand: both frames act, each with its reaction, and give the
 * end nodes K_S l sin(phi) square to the *other* edge. That is a joint moment M = K_S l^2 sin(phi) cos(phi),
 * at small angles K_S l^2 phi: a discrete elastica with E I / l = K_S l^2. */
TEST(test_joint_moment) {
  const double K_S = 5;
  for (double phi = 1e-6; phi < 1.1; phi *= 10) {
    Ribbon r;
    make_ribbon(&r, 1, 3, 3, K_S, false);
    for (size_t j = 2; j < PLACES; j++) {
      r.q[j] = 1 + (double)(j - 1) * cos(phi);
      r.q[PLACES + j] = (double)(j - 1) * sin(phi);
    }
    eval_forces(&r);
    double *fx = r.f, *fy = r.f + PLACES;
    double moment_left = fy[0] * 1, moment_right = fx[2] * -sin(phi) + fy[2] * cos(phi);
    ck_near(hypot(fx[0], fy[0]), K_S * sin(phi), 1e-12);      /* 4.4e-16 measured */
    ck_near(hypot(fx[2], fy[2]), K_S * sin(phi), 1e-12);      /* 1.1e-16 measured */
    ck_near(moment_left, -K_S * sin(phi) * cos(phi), 1e-12);  /* 4.4e-16 measured */
    ck_near(moment_right, -K_S * sin(phi) * cos(phi), 1e-12); /* 0 measured */
    ck_assert_double_eq_tol(fx[0] + fx[1] + fx[2], 0, 1e-14);
    ck_assert_double_eq_tol(fy[0] + fy[1] + fy[2], 0, 1e-14);
    /* small angle: an energy M phi / 2 */
    if (phi < 1e-3) ck_near(zp_massspring_shear_energy(&r.p, &r.e), K_S * phi * phi / 2, 3e-8); /* 3.3e-9 measured */
    free_ribbon(&r);
  }
}

/* A held slope is a joint to a fixed edge: moment K_S l^2 sin(theta) at either end. */
TEST(test_held_slopes) {
  const double K_S = 5, theta = 0.3;
  Ribbon r;
  make_ribbon(&r, 1, 2, 3, K_S, true);
  for (size_t j = 1; j < PLACES; j++) {
    r.q[j] = (double)j * cos(theta);
    r.q[PLACES + j] = (double)j * sin(theta);
  }
  eval_forces(&r);
  /* one edge sees both frames: -2 K_S l sin(theta), along y, as the held frames are horizontal */
  ck_near(r.f[PLACES + 1], -2 * K_S * sin(theta), 1e-12);
  ck_near(r.f[PLACES], 2 * K_S * sin(theta), 1e-12);
  ck_assert_double_eq_tol(r.f[0], 0, 1e-14);
  free_ribbon(&r);
}

/* Uniform stretch and rigid motion. */
TEST(test_axial_law) {
  const double K_D = 3, stretch = 1.01, turn = 0.7;
  Ribbon r;
  make_ribbon(&r, 1, 9, K_D, 5, false);
  for (size_t j = 0; j < PLACES; j++) {
    r.q[j] = (double)j * stretch * cos(turn) + 4;
    r.q[PLACES + j] = (double)j * stretch * sin(turn) - 2;
  }
  eval_forces(&r);
  ck_near(r.f[8], -K_D * (stretch - 1) * cos(turn), 1e-12);
  ck_near(r.f[PLACES + 8], -K_D * (stretch - 1) * sin(turn), 1e-12);
  for (size_t j = 1; j < 8; j++)
    ck_assert_double_eq_tol(hypot(r.f[j], r.f[PLACES + j]), 0, 1e-13);
  ck_near(zp_massspring_axial_energy(&r.p, &r.e), 8 * 0.5 * K_D * (stretch - 1) * (stretch - 1), 1e-12);
  free_ribbon(&r);
}

/* Two ribbons interleaved are each what one is alone, bit for bit. */
TEST(test_two_ribbons_are_two) {
  Ribbon one, two;
  make_ribbon(&two, 2, 21, 3, 5, true);
  shake(&two, 0.3, 11);
  eval_forces(&two);
  for (size_t r = 0; r < 2; r++) {
    make_ribbon(&one, 1, 21, 3, 5, true);
    for (size_t i = 0; i < 21; i++) {
      one.q[i] = two.q[2 * i + r];
      one.q[PLACES + i] = two.q[PLACES + 2 * i + r];
    }
    eval_forces(&one);
    for (size_t i = 0; i < 21; i++) {
      /* two lengths share a division, another partner rounds otherwise: a few ulp */
      ck_assert_double_eq_tol(one.f[i], two.f[2 * i + r], 1e-13);
      ck_assert_double_eq_tol(one.f[PLACES + i], two.f[PLACES + 2 * i + r], 1e-13);
    }
    free_ribbon(&one);
  }
  free_ribbon(&two);
}

/* -- momentum -------------------------------------------------------------------------------------- */

typedef struct Sum {
  double x, y, scale;
} Sum;

static Sum sum_of(const Ribbon *r, const double *both) {
  Sum sum = {0, 0, 0};
  for (size_t j = 0; j < node_count(r); j++) {
    sum.x += both[j];
    sum.y += both[PLACES + j];
    sum.scale += fabs(both[j]) + fabs(both[PLACES + j]);
  }
  return sum;
}

TEST(test_forces_of_free_ribbon_sum_to_nothing) {
  for (uint64_t seed = 1; seed <= 100; seed++) {
    Ribbon r;
    make_ribbon(&r, 1 + seed % 2, 4 + seed % 40, 3, 5, false);
    shake(&r, 0.45, seed);
    eval_forces(&r);
    Sum sum = sum_of(&r, r.f);
    ck_below(fabs(sum.x) + fabs(sum.y), 1e-14 * sum.scale);
    free_ribbon(&r);
  }
}

static double accelerate_free(void *self, const double *q, const double *v, double *a) {
  (void)v;
  Ribbon *r = self;
  memcpy(r->q, q, sizeof r->q);
  eval_forces(r);
  memcpy(a, r->f, sizeof r->f);
  /* unit masses; 0.5 of the stability bound */
  return 1 / zp_massspring_frequency_bound(&r->p, 1);
}

/* 1000 steps of a free ribbon with random velocities: momentum is constant to rounding. Measured: 6e-16 of the sum of
 * speeds, random walk of rounding. */
TEST(test_momentum_of_free_ribbon) {
  Ribbon r;
  make_ribbon(&r, 1, 21, 3, 5, false);
  shake(&r, 0.05, 5);
  double q[2 * PLACES], v[2 * PLACES] = {0}, a[2 * PLACES];
  memcpy(q, r.q, sizeof q);
  uint64_t seed = 6;
  for (size_t j = 0; j < 21; j++) {
    v[j] = 0.1 * noise(&seed);
    v[PLACES + j] = 0.1 * noise(&seed);
  }
  Sum before = sum_of(&r, v);
  ZpExplicitSystem system = {2 * PLACES, &r, accelerate_free, NULL};
  for (int i = 0; i < 1000; i++)
    zp_explicit_step(&system, 1, q, v, a);
  Sum after = sum_of(&r, v);
  double drift = hypot(after.x - before.x, after.y - before.y) / before.scale;
  printf("momentum of a free ribbon after 1000 steps: off by %.1e of the sum of speeds\n", drift);
  ck_assert_double_gt(fabs(after.scale - before.scale), 1e-3); /* it did move */
  ck_below(drift, 2e-14);
  free_ribbon(&r);
}

/* -- the shear law has no potential ---------------------------------------------------------------- */

/* |J - J^T| / |J| (Frobenius) of the shear force's Jacobian on an arc of `phi` per joint. */
static double curl(double phi) {
  enum { NODES = 11, N = 2 * NODES };
  static double J[N][N];
  Ribbon r;
  make_ribbon(&r, 1, NODES, 0, 5, false);
  double x = 0, y = 0;
  for (size_t j = 0; j < PLACES; j++) {
    r.q[j] = x;
    r.q[PLACES + j] = y;
    x += cos((double)j * phi);
    y += sin((double)j * phi);
  }
  const double h = 1e-5;
  for (size_t k = 0; k < N; k++) {
    size_t at = k < NODES ? k : PLACES + k - NODES;
    for (int sign = -1; sign <= 1; sign += 2) {
      r.q[at] += sign * h;
      eval_forces(&r);
      r.q[at] -= sign * h;
      for (size_t m = 0; m < N; m++)
        J[m][k] = (sign < 0 ? 0 : J[m][k]) + sign * r.f[m < NODES ? m : PLACES + m - NODES] / (2 * h);
    }
  }
  free_ribbon(&r);
  double odd = 0, all = 0;
  for (size_t m = 0; m < N; m++)
    for (size_t k = 0; k < N; k++) {
      odd += (J[m][k] - J[k][m]) * (J[m][k] - J[k][m]);
      all += J[m][k] * J[m][k];
    }
  return sqrt(odd / all);
}

/* The asymmetry is proportional to the angle of the joints: none in a straight ribbon. */
TEST(test_curl_of_shear_law) {
  static const double phi[] = {0, 0.01, 0.1, 0.3};
  double value[LENGTH_OF(phi)];
  for (size_t i = 0; i < LENGTH_OF(phi); i++) {
    value[i] = curl(phi[i]);
    printf("shear law, %g rad per joint: |J - J^T| / |J| = %.3g\n", phi[i], value[i]);
  }
  ck_below(value[0], 5e-11);              /* 8.2e-12 measured */
  ck_assert_double_gt(value[2], 0.01);    /* not conservative */
  ck_near(value[2] / value[1], 10, 1e-3); /* 1.9e-4 measured */
}

/* -- beams ----------------------------------------------------------------------------------------- */

static const double L = 45e-3;

/* Deflection per unit of load at small loads, m/N: the difference of two loads, so that the weight of the
 * ribbon itself drops out. Axial springs as soft as the choice allows, for the sake of rounding. */
static double compliance(int nodes, ZpRightEnd end, double *EI) {
  const double g = 9.81, light = 1e-5, heavy = 2e-5;
  double stroke[2];
  for (int i = 0; i < 2; i++) {
    ZpActuatorDef def =
        DEF({"ribbon.model", ZP_RIBBON_MASS_SPRING}, {"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", end},
            {"ribbon.length", L}, {"ribbon.density", 1}, {"mesh.nodes", nodes}, {"mass_spring.axial", ZP_AXIAL_CODE},
            {"solver.tolerance", 1e-9}, {"gravity", g}, {"load.mass", i ? heavy : light});
    stroke[i] = settled_value(&def, "stroke");
  }
  const ZpLayer layer = {50e-6, 200e9, 0.285, 7850};
  *EI = zp_section(&layer, 1, 12.7e-3, 1).EI;
  return (stroke[1] - stroke[0]) / ((heavy - light) * g);
}

/* K_S auto has the factor N (N + 1) / (N - 1)^2, with which the linear chain between two held slopes is exactly as
 * stiff as the beam. Measured: 1.3e-6, 5e-7, 6e-7 off, of the order (deflection / L)^2 = 1.6e-6 of geometry at these
 * loads. */
TEST(test_guided_beam_exact) {
  static const int nodes[] = {5, 21, 61};
  for (size_t i = 0; i < LENGTH_OF(nodes); i++) {
    double EI, measured = compliance(nodes[i], ZP_END_GUIDED, &EI), beam = L * L * L / (12 * EI);
    printf("guided beam, N = %d: %.2e off P L^3 / (12 E I)\n", nodes[i], measured / beam - 1);
    ck_near(measured, beam, 1e-5);
  }
}

/* The same K_S in a cantilever: the held slope acts one cell before the clamp and the factor assumes two such ends, so
 * it converges with the first order of l. Measured: 21, 12.5, 6.8, 3.6 % too stiff. */
TEST(test_cantilever_converges) {
  static const int nodes[] = {6, 11, 21, 41};
  double error[LENGTH_OF(nodes)];
  for (size_t i = 0; i < LENGTH_OF(nodes); i++) {
    double EI, measured = compliance(nodes[i], ZP_END_FREE, &EI);
    error[i] = measured / (L * L * L / (3 * EI)) - 1;
    printf("cantilever, N = %d: %.3e off P L^3 / (3 E I)\n", nodes[i], error[i]);
  }
  for (size_t i = 0; i + 1 < LENGTH_OF(nodes); i++)
    ck_near(error[i] / error[i + 1], 2, 0.15);
  ck_below(fabs(error[LENGTH_OF(nodes) - 1]), 0.04);
}

TEST(test_frequency_bound) {
  /* a straight chain's axial waves end at 4 K_D / m, its bending waves at 16 K_S / m */
  ZpMassSpringParams axial = {.K_D = 3, .K_S = 0}, shear = {.K_D = 0, .K_S = 5};
  ck_near(zp_massspring_frequency_bound(&axial, 2), sqrt(4 * 3 / 2.0), 1e-14);
  ck_near(zp_massspring_frequency_bound(&shear, 2), sqrt(16 * 5 / 2.0), 1e-14);
}

/* The frequency bound holds: the largest eigenvalue of the symmetric part of -J / m of a deformed ribbon, by power
 * iteration, is below it. */
TEST(test_frequency_bound_holds) {
  Ribbon r;
  make_ribbon(&r, 1, 21, 3, 5, true);
  double q[2 * PLACES], d[2 * PLACES] = {0}, largest = 0;
  memcpy(q, r.q, sizeof q);
  uint64_t seed = 3;
  for (size_t j = 0; j < 21; j++) {
    d[j] = noise(&seed);
    d[PLACES + j] = noise(&seed);
  }
  for (int i = 0; i < 500; i++) {
    double norm = 0, h = 1e-5;
    for (size_t k = 0; k < 2 * PLACES; k++)
      norm += d[k] * d[k];
    norm = sqrt(norm);
    for (size_t k = 0; k < 2 * PLACES; k++)
      r.q[k] = q[k] + h * d[k] / norm;
    eval_forces(&r);
    largest = 0;
    for (size_t j = 0; j < 21; j++) {
      d[j] = -r.f[j] / h;
      d[PLACES + j] = -r.f[PLACES + j] / h;
      largest += d[j] * d[j] + d[PLACES + j] * d[PLACES + j];
    }
    largest = sqrt(largest);
  }
  double bound = zp_massspring_frequency_bound(&r.p, 1);
  printf("fastest motion of a straight ribbon: %.4f of the bound\n", sqrt(largest) / bound);
  ck_below(sqrt(largest), bound);
  ck_assert_double_gt(sqrt(largest), 0.8 * bound); /* and the bound is not idle: 80 = 16 K_S of 92 */
  free_ribbon(&r);
}
