/* Newton's method for an equilibrium r(q) = 0, and one step of arc-length continuation along a parameter.
 * Knows no physics; the system keeps its own point and says how to move it. */
#ifndef ZP_SOLVE_NEWTON_H
#define ZP_SOLVE_NEWTON_H

#include <stdbool.h>
#include <stddef.h>

#include "math/band.h"

typedef struct ZpStaticSystem {
  size_t n;   /* equations */
  void *self; /* handed to the functions below */
  /* Forces left at the present point => r [n]; returns their size relative to what acts. */
  double (*residual)(void *self, double *r);
  /* -dr/dq at the point of the last residual. */
  void (*stiffness)(void *self, ZpBand *K);
  /* How far a step would go, in units of the longest step that linearisation stands. */
  double (*length)(void *self, const double *step);
  /* Move the present point by fraction * step. */
  void (*move)(void *self, const double *step, double fraction);
  /* Find anew, at the present point, what is dear and what the residual holds while a point moves; false if it cannot
   * be found. NULL where nothing is held. An equilibrium is one with nothing out of date. */
  bool (*refresh)(void *self);
} ZpStaticSystem;

/* By which test an iteration ended. */
typedef enum ZpNewtonEnd {
  ZP_NEWTON_CONVERGED, /* residual below tolerance */
  ZP_NEWTON_FLOOR,     /* residual stays where rounding leaves it, below 100 tolerances */
  ZP_NEWTON_SINGULAR,  /* stiffness without inverse */
  ZP_NEWTON_DIVERGED,  /* residual not finite, or what it holds cannot be found */
  ZP_NEWTON_SLOW       /* most iterations done */
} ZpNewtonEnd;

typedef struct ZpNewtonInfo {
  ZpNewtonEnd end;
  int iterations; /* linear solves */
  double residual;
} ZpNewtonInfo;

/* Work space: the stiffness and vectors of n doubles. */
typedef struct ZpNewtonWork {
  ZpBand K;
  double *r, *LDL;
} ZpNewtonWork;

void zp_newton_carve(ZpNewtonWork *work, size_t n, size_t bandwidth, ZpCarver *carver);

/* Iterate from the present point. */
ZpNewtonInfo zp_newton(const ZpStaticSystem *system, double tolerance, int most, ZpNewtonWork *work);

bool zp_newton_good(ZpNewtonEnd end);

#endif
