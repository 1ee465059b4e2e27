/* Implicit time stepping of M q'' = f by the midpoint rule with mean forces: over a step h
 *   q1 = q0 + h w,   v1 = 2 w - v0,   M (v1 - v0) / h = f(q0, q1, h)                                       (18.1)
 * of second order for any symmetric mean f; if f does exactly the work by which an energy changes, so does the step,
 * whatever its size. Beside positions there may be unknowns of first order, whose mean rates w are in the residual, and
 * algebraic ones, which belong to the step as a whole, (18.6). Newton's method on the banded Jacobian with a border,
 * steps controlled by the local error. Knows no physics.
 */
#ifndef ZP_SOLVE_IMPLICIT_H
#define ZP_SOLVE_IMPLICIT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/end.h"
#include "math/bordered.h"
#include "math/parts.h"

typedef enum ZpUnknown {
  ZP_SECOND_ORDER, /* a position, with a velocity */
  ZP_FIRST_ORDER,  /* as a charge behind a resistor: it has a mean rate over a step, and no velocity */
  ZP_ALGEBRAIC     /* as a pressure or a multiplier: of one step, without memory. Where its own diagonal is 0 it belongs
                    * to the border, or to a band that is not symmetric */
} ZpUnknown;

/* Rows of the residual are conjugate to their unknowns: row i times a change of unknown i is an energy, J. */
typedef struct ZpImplicitSystem {
  size_t n;              /* unknowns */
  size_t border;         /* the last of these, fewer than n, couple with all others; the rest is banded */
  size_t bandwidth;      /* diagonals of the matrix above the main one */
  size_t lower;          /* and below; 0: it is symmetric, and only the upper triangle is kept */
  ZpBandGroups groups;   /* of a symmetric one */
  const ZpUnknown *kind; /* [n]; NULL: all of second order */
  const double *scale;   /* [n] positive: what counts as much as 1 m of a position; NULL: all 1 */
  ZpParts parts;         /* like ones that it consists of, the first one's unknowns first; all 0: it is one */
  void *self;            /* handed to the functions below */
  const double *mass;    /* [n] 0 or more, the inertia that the stepper adds; 0 of what is not of second order */
  /* A step begins at y0 [n], with velocities v0 [n], 0 of what is not of second order; both stay valid until it ends =>
   * an energy of the system there, J, by which an imbalance is judged. */
  double (*begin)(void *self, const double *y0, const double *v0);
  /* What is left over a step of h that ends at y1, without M a => r [n]: mean forces; of other unknowns their equation,
   * with its rates (y1 - y0) / h. An inertia beyond `mass` is in r, too, at the mean acceleration 2 (w - v0) / h. */
  ZpEnd (*residual)(void *self, const double *y1, double h, double *r);
  /* -dr/dy1 at the last residual, or what is near it and cheaper => J. */
  void (*tangent)(void *self, ZpBordered *J);
  /* -dr/dy1 exactly there => J, with `bandwidth` diagonals on both sides. May be NULL. */
  void (*exact)(void *self, ZpBordered *J);
  /* f [n] += the inertia beyond `mass` times a [n]. NULL: there is none. */
  void (*inertia)(void *self, const double *a, double *f);
  /* The step is tried, from a first guess of its end, which may be made one that can be: nothing passes through
   * anything. May be NULL. */
  void (*attempt)(void *self, double *y1);
  /* The last correction has led to y1 => |work|, J, of the forces that the last tangent did not foresee there: those of
   * contacts that have closed or opened since. An accepted step ends at the last y1 seen here. May be NULL. */
  double (*unforeseen)(void *self, const double *y1);
} ZpImplicitSystem;

/* What evolves beside q and v: the last step, which the next one's guess and error follow from. */
typedef struct ZpImplicitHistory {
  double *w, *a;     /* [n] mean rate and mean acceleration of the last step; 0 of algebraic unknowns */
  double last, next; /* its length, 0 where there is none; that of the next to try, s */
} ZpImplicitHistory;

typedef struct ZpImplicitCounts {
  int64_t steps, rejected; /* taken; thrown away for their local error */
  int64_t failures;        /* thrown away because Newton's method found no end */
  int64_t iterations;
} ZpImplicitCounts;

typedef struct ZpImplicit {
  const ZpImplicitSystem *system;
  double accuracy; /* local error asked for, root mean square over all but algebraic unknowns in their scales, m */
  double balance;  /* work that the iteration may leave unbalanced in a step, of the energy there */
  double fixed;    /* length of all steps; 0: by the local error, s */
  double energy;   /* where the step under way begins, J */
  double reach;    /* largest unknown of the first part there, in its scale: all are rounded to its last digits */
  ZpEnd end;       /* how the last step ended; ZP_END_SHORTER: even the shortest was too long */
  ZpImplicitCounts counts;
  double *q, *r; /* [n] end of the step under way; what is left of its force, and more */
  double *x;     /* [n] work space */
  ZpBordered A;
} ZpImplicit;

/* Cut the arrays from `carver`. */
void zp_implicit_carve(ZpImplicit *stepper, const ZpImplicitSystem *system, ZpCarver *carver);

/* One step of at most `longest`: (q, v, history) at its start => at its end; v and history.a are 0 of algebraic
 * unknowns, v of first-order ones, too. => its length, 0 if none is found (see `end`); all is then as it was. */
double zp_implicit_step(ZpImplicit *stepper, double longest, double *q, double *v, ZpImplicitHistory *history);

/* A system that differs from one whose step is known by `offset` of some number: its step, of length h. */
typedef struct ZpNearStep {
  ZpImplicit *stepper;
  double offset, weight; /* where the system is, and how much it counts in the difference quotient by that number */
  double h;              /* s */
  double *q, *v;         /* as of zp_implicit_step */
  ZpImplicitHistory *history;
} ZpNearStep;

typedef struct ZpNearSteps {
  ZpNearStep near[4];
  int count;
  const double *q1;              /* [n] where the known step ends, */
  const ZpImplicitHistory *lead; /* with what rates */
  double *work;                  /* [6 n] */
} ZpNearSteps;

/* How the end of the known step moves with the number => rate [n], eq. (20.7), and all near steps, accepted at
 * q1 + offset rate. `with_matrix`: their Jacobians are factored there, for zp_implicit_smooth and zp_implicit_calm.
 * False: the rate is not found. */
bool zp_implicit_follow(const ZpNearSteps *steps, bool with_matrix, double *rate);

/* The share (x / (1 + x))^3 of what velocities v have beyond the mean rates w of the last step, by the inertia `mass`
 * alone: where a resistance is far above that, the step lets them turn round without end. */
void zp_implicit_calm(ZpImplicit *stepper, double h, const double *w, double *v);

/* -d(r - M a)/dy1 at the last residual of the system, exactly, for a step of h => J, whose arrays
 * zp_implicit_carve_exact cuts. False if the system has no `exact`. */
void zp_implicit_carve_exact(const ZpImplicitSystem *system, ZpBordered *J, ZpCarver *carver);
bool zp_implicit_exact(const ZpImplicitSystem *system, double h, ZpBordered *J);

/* Take out of velocities v what is too fast for the last step, of length h: the share (x / (1 + x))^5 of a mode of
 * angular frequency omega, x = (h omega / 2)^2, by the last factored matrix. (18.1) keeps such modes, turned round in
 * every step. */
void zp_implicit_smooth(ZpImplicit *stepper, double h, double *v);

#endif
