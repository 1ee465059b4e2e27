/* Implicit time stepping of M q'' = f by the midpoint rule with mean forces: over a step h
 *   q1 = q0 + h w,   v1 = 2 w - v0,   M (v1 - v0) / h = f(q0, q1, h)                                       (18.1)
 * of second order for any symmetric mean f; if f does exactly the work by which an energy changes, so does the step,
 * whatever its size. Newton's method on the banded Jacobian, steps controlled by the local error. Knows no physics.
 */
#ifndef ZP_SOLVE_IMPLICIT_H
#define ZP_SOLVE_IMPLICIT_H

#include <stdbool.h>
#include <stdint.h>

#include "math/band.h"

typedef struct ZpImplicitSystem {
  size_t n, bandwidth;
  void *self;         /* handed to the functions below */
  const double *mass; /* [n], all positive */
  /* A step begins at q0 [n] => an energy of the system there, J, by which an imbalance is judged. */
  double (*begin)(void *self, const double *q0);
  /* Mean force over a step of h that ends at q1 => f [n], not finite where there is none. */
  void (*force)(void *self, const double *q1, double h, double *f);
  /* -df/dq1 at the last force => A, symmetric, upper triangle. */
  void (*tangent)(void *self, ZpBand *A);
  /* The step is tried, from a first guess of its end, which may be made one that can be: nothing passes through
   * anything. May be NULL. */
  void (*attempt)(void *self, double *q1);
  /* The last correction has led to q1 => |work|, J, of the forces that the last tangent did not foresee there: those of
   * contacts that have closed or opened since. An accepted step ends at the last q1 seen here. May be NULL. */
  double (*unforeseen)(void *self, const double *q1);
} ZpImplicitSystem;

/* What evolves beside q and v: the last step, which the next one's guess and error follow from. */
typedef struct ZpImplicitHistory {
  double *w, *a;     /* [n] mean velocity and mean acceleration of the last step */
  double last, next; /* its length, 0 where there is none; that of the next to try, s */
} ZpImplicitHistory;

typedef struct ZpImplicitCounts {
  int64_t steps, rejected; /* taken; thrown away for their local error */
  int64_t failures;        /* thrown away because Newton's method found no end */
  int64_t iterations;
} ZpImplicitCounts;

typedef struct ZpImplicit {
  const ZpImplicitSystem *system;
  double accuracy; /* local error asked for, root mean square over the coordinates, m */
  double balance;  /* work that the iteration may leave unbalanced in a step, of the energy there */
  double fixed;    /* length of all steps; 0: by the local error, s */
  double energy;   /* where the step under way begins, J */
  double reach;    /* largest coordinate there, m: all positions are rounded to its last digits */
  ZpImplicitCounts counts;
  double *q, *r; /* [n] end of the step under way; what is left of its force, and more */
  ZpBand A;
} ZpImplicit;

void zp_implicit_carve(ZpImplicit *stepper, const ZpImplicitSystem *system, ZpCarver *carver);

/* One step of at most `longest`: (q, v, history) at its start => at its end. => its length, 0 if even the shortest
 * fails; all is then as it was. */
double zp_implicit_step(ZpImplicit *stepper, double longest, double *q, double *v, ZpImplicitHistory *history);

/* Take out of velocities v what is too fast for the last step, of length h: the share (x / (1 + x))^3 of a mode of
 * angular frequency omega, x = (h omega / 2)^2, by the last factored matrix. (18.1) keeps such modes, turned round in
 * every step. */
void zp_implicit_smooth(ZpImplicit *stepper, double h, double *v);

#endif
