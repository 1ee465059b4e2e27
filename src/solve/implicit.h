/* Implicit time stepping of M q'' = f by the midpoint rule with mean forces: over a step h
 *   q1 = q0 + h w,   v1 = 2 w - v0,   M (v1 - v0) / h = f(q0, q1, h)                                       (18.1)
 * It is of second order for any symmetric mean f. If the work of f is exactly the change of an energy, the step
 * conserves energy, whatever its size. Besides positions there may be unknowns of first order, whose mean rates w are
 * in the residual, and algebraic ones, which belong to the step as a whole, (18.6). Newton's method uses a
 * Jacobian of bands with a border; the local error controls the steps. This file contains no physics.
 */
#ifndef ZP_SOLVE_IMPLICIT_H
#define ZP_SOLVE_IMPLICIT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/end.h"
#include "math/arrow.h"
#include "math/parts.h"

typedef enum ZpUnknown {
  ZP_SECOND_ORDER, /* a position, with a velocity */
  ZP_FIRST_ORDER,  /* like a charge behind a resistor: it has a mean rate over a step, and no velocity */
  ZP_ALGEBRAIC /* like a pressure or a multiplier: of one step, without memory. If its diagonal is 0 it belongs in the
                * border, or in a band that is not symmetric */
} ZpUnknown;

/* Rows of the residual are conjugate to their unknowns: row i times a change of unknown i is an energy, J. */
typedef struct ZpImplicitSystem {
  size_t n;                /* unknowns */
  const ZpArrowForm *form; /* of the matrix */
  const ZpUnknown *kind;   /* [n]; NULL: all of second order */
  const double *scale;     /* [n] positive: the change that counts as much as 1 m of a position; NULL: all 1 */
  const double *sharers;   /* [n] above 0: how many bodies share a position, in each part; so often it counts in means.
                              NULL: none do */
  ZpParts parts;      /* equal parts of the system, in each block the unknowns of the first one first; all 0: there is
                         one part */
  void *self;         /* argument of the functions below */
  const double *mass; /* [n] 0 or more, the inertia that the stepper adds; 0 for unknowns not of second order */
  /* Begin a step at y0 [n], with velocities v0 [n], 0 for unknowns not of second order; both stay valid until it ends.
   * Returns an energy of the system there, J, to which an imbalance is compared. */
  double (*begin)(void *self, const double *y0, const double *v0);
  /* Residual of a step of length h that ends at y1, without M a => r [n]: mean forces, and for other unknowns their
   * equations, with the rates (y1 - y0) / h. r includes inertia beyond `mass` at the mean acceleration 2 (w - v0) / h.
   */
  ZpEnd (*residual)(void *self, const double *y1, double h, double *r);
  /* -dr/dy1 at the last residual, or a cheaper approximation => J. */
  void (*tangent)(void *self, ZpArrow *J);
  /* The matrix J of `tangent` may be T' (-dr/dy1) T, of unknowns x with changes y = T x, in which it is not nearly
   * singular: r [n] => T' r before a solution, x [n] => T x after. NULL: T is 1. */
  void (*turn)(void *self, double *r);
  void (*turn_back)(void *self, double *x);
  /* f [n] += inertia beyond `mass` times a [n]. NULL: there is none. */
  void (*inertia)(void *self, const double *a, double *f);
  /* Called before a step is tried from a first guess y1 of its end; may change y1 so that nothing passes through
   * anything. May be NULL. */
  void (*attempt)(void *self, double *y1);
  /* The share of the error (18.9) of first-order unknown i that counts, 0 to 1, at the last residual: less than 1 for
   * what decays within the step, if the equations have this decay exactly. NULL: all. */
  double (*resolved)(void *self, size_t i);
  /* e [n] += local errors of the step that the last residual is of, in its unknowns, which its accelerations do not
   * tell, such as of a force that turns around within it. May be NULL. */
  void (*overlooks)(void *self, const double *v0, double h, double *e);
  /* Called with each correction x [n], before the next residual: a multiplier that is no unknown changes as the linear
   * equations foresee. May be NULL. */
  void (*corrected)(void *self, const double *x);
  /* Called after each correction, which has led to y1: chooses the branches of kinked laws for the next residual. False
   * while they change one by one, which may take many iterations. May be NULL. */
  bool (*choose)(void *self, const double *y1);
  /* Called after the last correction has led to y1. Returns |work|, J, of the forces that the last tangent did not
   * predict there: those of contacts that have closed or opened since. An accepted step ends at the last y1 of these
   * calls. May be NULL. */
  double (*unforeseen)(void *self, const double *y1);
} ZpImplicitSystem;

/* Evolving part besides q and v: the last step, from which the guess and the error of the next one follow. */
typedef struct ZpImplicitHistory {
  double *w, *a;     /* [n] mean rate and mean acceleration of the last step; 0 for algebraic unknowns */
  double last, next; /* length of the last step, 0 if there is none; length of the next step to try, s */
} ZpImplicitHistory;

typedef struct ZpImplicitCounts {
  int64_t steps, rejected; /* accepted; rejected for their local error */
  int64_t failures;        /* rejected because Newton's method did not converge */
  int64_t iterations;
} ZpImplicitCounts;

typedef struct ZpImplicit {
  const ZpImplicitSystem *system;
  double accuracy; /* required local error, root mean square over all but algebraic unknowns in their scales, m */
  double balance;  /* work that the iteration may leave unbalanced in a step, as a fraction of the energy there */
  double share;    /* of the accuracy: the error that the iteration may leave */
  double fixed;    /* length of all steps, s; 0: by the local error */
  double first;    /* length of the first one that is tried, s; the owner may shorten it. A step that is much shorter is
                      short for algebraic unknowns */
  double energy;   /* at the start of the present step, J */
  double reach;    /* largest unknown of the first part there, in its scale: all are rounded to its last digits */
  ZpEnd end;       /* how the last step ended; ZP_END_SHORTER: even the shortest was too long */
  ZpImplicitCounts counts;
  double *q, *r; /* [n] end of the present step; its residual, and more */
  double *x;     /* [n] work space */
  ZpArrow A;
} ZpImplicit;

/* Take the arrays from `arena`. */
void zp_implicit_reserve(ZpImplicit *stepper, const ZpImplicitSystem *system, ZpArena *arena);

/* From now on the iteration leaves more of the error and of the energy: for runs of which only times are asked. */
void zp_implicit_hasten(ZpImplicit *stepper);

/* Take one step of at most `longest`: (q, v, history) at its start => at its end. v and history.a are 0 for algebraic
 * unknowns; v is also 0 for unknowns of first order. Returns its length; 0 if no step succeeded (see `end`), and then
 * nothing has changed. */
double zp_implicit_step(ZpImplicit *stepper, double longest, double *q, double *v, ZpImplicitHistory *history);

/* A step of length h of a system that differs by `offset` in some number from a system whose step is known. */
typedef struct ZpDifferenceStep {
  ZpImplicit *stepper;
  double offset, weight; /* difference of the number, and the weight in the difference quotient by the number */
  double h;              /* s */
  double *q, *v;         /* as in zp_implicit_step */
  ZpImplicitHistory *history;
} ZpDifferenceStep;

enum { ZP_DIFFERENCE_STEPS = 5 };

typedef struct ZpDifferenceSteps {
  ZpDifferenceStep near[ZP_DIFFERENCE_STEPS];
  int count;
  const double *q1;              /* [n] end of the known step */
  const ZpImplicitHistory *lead; /* rates of the known step */
  double *work;                  /* [6 n] */
} ZpDifferenceSteps;

/* Derivative of the end of the known step by the number => rate [n], eq. (20.7); all near steps are accepted at
 * q1 + offset rate. With `with_matrix` their Jacobians are factored there, for zp_implicit_smooth and
 * zp_implicit_filter. False if the rate was not found. */
bool zp_implicit_follow(const ZpDifferenceSteps *steps, bool with_matrix, double *rate);

/* Remove from velocities v the share (x / (1 + x))^3 of their difference from the mean rates w of the last step, by the
 * inertia `mass` alone: where a resistance is far larger than this inertia, they would change sign in every step. */
void zp_implicit_filter(ZpImplicit *stepper, double h, const double *w, double *v);

/* Remove from velocities v what is too fast for the last step, of length h: the share (x / (1 + x))^5 of a mode of
 * angular frequency omega, x = (h omega / 2)^2, by the last factored matrix. (18.1) would keep such modes, with their
 * sign changed in every step. */
void zp_implicit_smooth(ZpImplicit *stepper, double h, double *v);

#endif
