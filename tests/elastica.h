/* The oracle of the tests of statics: the planar inextensible elastica under a dead vertical load at its end and
 * a uniform weight, clamped horizontally at the left. Shares nothing with the library.
 *
 * In units of the length and of EI / length^2: theta'' = -(p + q (1 - s)) cos theta, theta(0) = 0, and theta'(1) = 0
 * (free) or theta(1) = 0 (guided); theta is the slope downwards. Shooting on theta'(0) by Newton's method with the
 * variational equation, RK4, load by load from small ones; refined until two meshes agree to 1e-9. */
#ifndef ZP_TESTS_ELASTICA_H
#define ZP_TESTS_ELASTICA_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef struct Elastica {
  double p, q; /* P L^2 / EI, w L^3 / EI */
  bool guided; /* else free */
  double x, y; /* of the right end over L, y downwards */
  double root; /* theta'(0) L */
  bool found;  /* meshes agree */
} Elastica;

/* theta, theta', their derivatives by theta'(0), x, y */
enum { ELASTICA_STATE = 6 };

static inline void elastica_rates(double p, double q, double s, const double *u, double *rate) {
  double V = p + q * (1 - s);
  rate[0] = u[1];
  rate[1] = -V * cos(u[0]);
  rate[2] = u[3];
  rate[3] = V * sin(u[0]) * u[2];
  rate[4] = cos(u[0]);
  rate[5] = sin(u[0]);
}

/* u at s + h from u at s. */
static inline void elastica_step(double p, double q, double s, double h, double *u) {
  static const double at[4] = {0, 0.5, 0.5, 1}, part[4] = {1, 2, 2, 1};
  double sum[ELASTICA_STATE] = {0}, rate[ELASTICA_STATE] = {0}, tried[ELASTICA_STATE];
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < ELASTICA_STATE; i++)
      tried[i] = u[i] + at[k] * h * rate[i];
    elastica_rates(p, q, s + at[k] * h, tried, rate);
    for (int i = 0; i < ELASTICA_STATE; i++)
      sum[i] += part[k] * rate[i];
  }
  for (int i = 0; i < ELASTICA_STATE; i++)
    u[i] += h / 6 * sum[i];
}

/* The right end for a given theta'(0). */
static inline void elastica_shoot(double p, double q, double root, int steps, double *u) {
  memcpy(u, (double[ELASTICA_STATE]){0, root, 0, 1, 0, 0}, ELASTICA_STATE * sizeof *u);
  for (int k = 0; k < steps; k++)
    elastica_step(p, q, (double)k / steps, 1.0 / steps, u);
}

/* With `steps` steps of RK4, the load coming on in portions. */
static inline void elastica_on_mesh(Elastica *e, int steps) {
  enum { PORTIONS = 40, ITERATIONS = 8 };
  double u[ELASTICA_STATE];
  e->root = 0;
  for (int portion = 1; portion <= PORTIONS; portion++)
    for (int k = 0; k < ITERATIONS; k++) {
      double part = (double)portion / PORTIONS;
      elastica_shoot(part * e->p, part * e->q, e->root, steps, u);
      e->root -= e->guided ? u[0] / u[2] : u[1] / u[3];
    }
  elastica_shoot(e->p, e->q, e->root, steps, u);
  e->x = u[4];
  e->y = u[5];
}

static inline Elastica elastica(double p, double q, bool guided) {
  Elastica coarse = {.p = p, .q = q, .guided = guided};
  elastica_on_mesh(&coarse, 32);
  for (int steps = 64; steps <= 4096; steps *= 2) {
    Elastica fine = coarse;
    elastica_on_mesh(&fine, steps);
    fine.found = fabs(fine.x - coarse.x) < 1e-9 && fabs(fine.y - coarse.y) < 1e-9;
    coarse = fine;
    if (fine.found) break;
  }
  return coarse;
}

#endif
