/* Newton's method for an equilibrium r(q) = 0, and one step of arc-length continuation along a parameter. It contains
 * no physics; the system stores its point and moves it. */
#ifndef ZP_SOLVE_NEWTON_H
#define ZP_SOLVE_NEWTON_H

#include <stdbool.h>
#include <stddef.h>

#include "base/end.h"
#include "math/arrow.h"
#include "math/parts.h"

typedef struct ZpStaticSystem {
  size_t n;   /* equations */
  void *self; /* argument of the functions below */
  /* Unbalanced forces at the present point => r [n], and their size relative to the acting forces (NULL: not needed).
   */
  ZpEnd (*residual)(void *self, double *r, double *size);
  /* -dr/dq at the point of the last residual => K. If the motion of a coordinate is prescribed, its effect on the
   * others is added to r (NULL: it does not move), and its row and column are uncoupled. */
  void (*stiffness)(void *self, ZpArrow *K, double *r);
  /* Length of a step, in units of the longest step for which linearisation is valid. */
  double (*length)(void *self, const double *step);
  /* Change by a step, in units of the required accuracy. The residual alone does not show how close the equilibrium is:
   * the scale of forces may be far larger than the forces that matter, or rounding may hide these. */
  double (*change)(void *self, const double *step);
  /* Move the present point by fraction * step. */
  void (*move)(void *self, const double *step, double fraction);
  /* Recompute at the present point what is expensive and what the residual keeps constant while the point moves. NULL
   * if there is none. In an equilibrium nothing is out of date. */
  ZpEnd (*refresh)(void *self);
  ZpParts parts; /* equal parts of the system; all 0: there is one part */
} ZpStaticSystem;

/* Inner product of two changes of the coordinates, each part by itself. */
double zp_static_dot(const ZpStaticSystem *system, const double *a, const double *b);

/* The test that ended an iteration. */
typedef enum ZpNewtonEnd {
  ZP_NEWTON_CONVERGED, /* residual below tolerance, and the next correction below the accuracy */
  ZP_NEWTON_FLOOR,     /* residual and corrections are limited by rounding, below 100 times the tolerance */
  ZP_NEWTON_SINGULAR,  /* the stiffness is singular */
  ZP_NEWTON_DIVERGED,  /* there is no residual, or `refresh` failed */
  ZP_NEWTON_SLOW,      /* the largest number of iterations was reached */
  ZP_NEWTON_REFUSED    /* the caller refuses the point that was found */
} ZpNewtonEnd;

typedef struct ZpNewtonInfo {
  ZpNewtonEnd end;
  int iterations; /* linear solves */
  double residual;
} ZpNewtonInfo;

/* Work space. */
typedef struct ZpNewtonWork {
  ZpArrow K;
  double *r; /* [n] */
} ZpNewtonWork;

/* The convergence of an iteration. Start with zp_closing_start. */
typedef struct ZpClosing {
  double change, before; /* by the last correction and the one before it, see ZpStaticSystem; INFINITY: none yet */
  double least_residual, least_change;
  int stalled; /* number of residuals since either of these has halved */
} ZpClosing;

void zp_closing_start(ZpClosing *closing);

/* After a correction by `step`, before it is moved. */
void zp_closing_correct(ZpClosing *closing, const ZpStaticSystem *system, const double *step);

/* Examine the next residual: is it below the tolerance, and is the change by the next correction below the accuracy, as
 * predicted from the last two corrections? A residual of 0 is enough. */
bool zp_closing_done(ZpClosing *closing, double residual, double tolerance);

/* Does rounding prevent further progress, with residual and correction below 100 times their tolerances? */
bool zp_closing_stalled(const ZpClosing *closing, double residual, double tolerance);

/* After a refresh, when the residual may be larger again. */
void zp_closing_renew(ZpClosing *closing);

void zp_newton_reserve(ZpNewtonWork *work, const ZpArrowForm *form, ZpArena *arena);

/* Iterate from the present point. */
ZpNewtonInfo zp_newton(const ZpStaticSystem *system, double tolerance, int most, ZpNewtonWork *work);

bool zp_newton_good(ZpNewtonEnd end);

#endif
