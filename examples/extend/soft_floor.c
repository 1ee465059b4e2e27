/* A contact law of one's own beside the library's rod: a steel strip on a soft floor, pressed down at its free end.
 *
 * A model is a kernel: parameters and positions go in, forces come out. It does not know what else acts; forces of
 * different kinds are added in one place, here `accelerate`, in the program src/actuator/eval.c. Built against the
 * rooms of src/, not against an installed zipact. Checked: a long beam on such a floor sinks at its end by
 * 2 P lambda / k + q / k, lambda^4 = k / (4 EI) (Winkler and Hetenyi), as long as its weight keeps it on the floor. */
#include <math.h>
#include <stdio.h>

#include "base/kernel.h"
#include "ribbon/rod_step.h"
#include "solve/relax.h"

enum { N = 101, PLACES = 128, EDGES = N - 1 };
static const double l = 1e-3, EA = 1.27e5, EI = 2.88e-5; /* edge, m; strip of 12.7 mm x 50 um steel, N, N m^2 */
static const double q_line = 0.049, P = 1e-3;            /* its weight per length, N/m; what presses its end, N */
static const double k = 1.2e4;                           /* of the floor, per length and depth, N/m^2 */

/* The law: the floor pushes where a node is below it, and does not hold what rises. (y [N]) => push [N], N. */
static void floor_push(const double *y, double *push) {
  for (size_t i = 0; i < N; i++)
    push[i] = y[i] < 0 ? -k * l * (i == 0 || i == EDGES ? 0.5 : 1) * y[i] : 0;
}

typedef struct Strip {
  ZpRodParams rod;
  ZpRodEval eval;
  ZpRodStep forces; /* at rest: both ends of the step are one point */
  double worst; /* largest force left, N */
} Strip;

/* (x, then y) => forces over a pseudo-mass that slows the stiffest motion to the pace that zp_relax asks for. */
static void accelerate(void *self, const double *q, double *a) {
  Strip *s = self;
  double push[N], mass = 0.5 * (4 * EA / l + 16 * EI / (l * l * l) + k * l);
  zp_rod_eval(&s->rod, q, q + PLACES, &s->eval);
  zp_rod_step(&s->rod, &s->eval, &s->eval, 0, &s->forces);
  floor_push(q + PLACES, push);
  s->worst = 0;
  for (size_t i = 1; i < N; i++) { /* node 0 is clamped */
    double left = i < EDGES ? 1 : 0, weight = q_line * l * (i < EDGES ? 1 : 0.5);
    double Fx = s->forces.Rx[i - 1] - left * s->forces.Rx[i];
    double Fy = s->forces.Ry[i - 1] - left * s->forces.Ry[i] + push[i] - weight - (i == EDGES ? P : 0);
    s->worst = fmax(s->worst, fmax(fabs(Fx), fabs(Fy)));
    a[i] = Fx / mass;
    a[PLACES + i] = Fy / mass;
  }
}

static double residual(void *self) {
  return ((Strip *)self)->worst / P;
}

int main(void) {
  static _Alignas(ZP_ALIGNMENT) double block[40 * PLACES];
  static double rest[PLACES], S[PLACES], B[PLACES], k0[PLACES], q[2 * PLACES], work[10 * PLACES];
  for (size_t i = 0; i < PLACES; i++) {
    rest[i] = l;
    S[i] = i < EDGES ? EA / l : 0;
    B[i] = i == 0 ? 2 * EI / l : i < EDGES ? EI / l : 0; /* a clamp bends over half an edge; the end is free */
    q[i] = l * (double)i;
    q[PLACES + i] = -q_line / k;
  }
  Strip strip = {.rod = {1, N, PLACES, rest, S, B, k0}};
  ZpCarver carver = {(char *)block, 0};
  zp_rod_carve(&strip.rod, &strip.eval, &carver);
  zp_rod_step_carve(&strip.rod, &strip.forces, &carver);
  ZpRelaxSystem system = {2 * PLACES, &strip, accelerate, residual, NULL};
  ZpRelaxInfo info = zp_relax(&system, 1e-5, 2000000, q, work);
  double lambda = pow(k / (4 * EI), 0.25), expected = 2 * P * lambda / k + q_line / k, found = -q[PLACES + EDGES];
  printf("the end sinks by %.3f um, expected %.3f um; %ld steps\n", 1e6 * found, 1e6 * expected, (long)info.steps);
  return info.end == ZP_RELAX_AT_REST && fabs(found - expected) < 0.005 * expected ? 0 : 1;
}
