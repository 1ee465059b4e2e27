/* Newton's method for an equilibrium r(q) = 0, and one step of arc-length continuation along a parameter.
 * Knows no physics; the system keeps its own point and says how to move it. */
#ifndef ZP_SOLVE_NEWTON_H
#define ZP_SOLVE_NEWTON_H

#include <stdbool.h>
#include <stddef.h>

#include "base/end.h"
#include "math/band.h"
#include "math/parts.h"

typedef struct ZpStaticSystem {
  size_t n;   /* equations */
  void *self; /* handed to the functions below */
  /* Forces left at the present point => r [n], and their size relative to what acts (NULL: not asked for). */
  ZpEnd (*residual)(void *self, double *r, double *size);
  /* -dr/dq at the point of the last residual => K. Where a coordinate moves as prescribed, what that does to the others
   * is taken into r (NULL: it does not move), and its row and column are those of no other. */
  void (*stiffness)(void *self, ZpBand *K, double *r);
  /* How far a step would go, in units of the longest step that linearisation stands. */
  double (*length)(void *self, const double *step);
  /* What a step would change, in units of the accuracy asked for. The residual alone does not say how near the
   * equilibrium is: the scale of forces may be far above those that decide, or rounding hide them. */
  double (*change)(void *self, const double *step);
  /* Move the present point by fraction * step. */
  void (*move)(void *self, const double *step, double fraction);
  /* Find again, at the present point, what is dear and what the residual holds while a point moves. NULL where nothing
   * is held. An equilibrium is one with nothing out of date. */
  ZpEnd (*refresh)(void *self);
  ZpParts parts; /* like ones that it consists of; all 0: it is one */
} ZpStaticSystem;

/* Inner product of two changes of the coordinates, each part by itself. */
double zp_static_dot(const ZpStaticSystem *system, const double *a, const double *b);

/* By which test an iteration ended. */
typedef enum ZpNewtonEnd {
  ZP_NEWTON_CONVERGED, /* residual below tolerance, and the next correction below the accuracy */
  ZP_NEWTON_FLOOR,     /* residual and corrections stay where rounding leaves them, below 100 times what is asked */
  ZP_NEWTON_SINGULAR,  /* stiffness without inverse */
  ZP_NEWTON_DIVERGED,  /* there is no residual, or what it holds cannot be found */
  ZP_NEWTON_SLOW       /* most iterations done */
} ZpNewtonEnd;

typedef struct ZpNewtonInfo {
  ZpNewtonEnd end;
  int iterations; /* linear solves */
  double residual;
} ZpNewtonInfo;

/* Work space. */
typedef struct ZpNewtonWork {
  ZpBand K;
  double *r; /* [n] */
} ZpNewtonWork;

/* How an iteration closes in. Start with zp_closing_start. */
typedef struct ZpClosing {
  double change, before; /* of the last correction and of the one before it, see ZpStaticSystem; INFINITY: none yet */
  double least_residual, least_change;
  int stalled; /* residuals looked at since either has halved */
} ZpClosing;

void zp_closing_start(ZpClosing *closing);

/* After a correction by `step`, before it is moved. */
void zp_closing_correct(ZpClosing *closing, const ZpStaticSystem *system, const double *step);

/* Take in the next residual. => Is it below tolerance, and what the next correction would change below the accuracy, as
 * the last two corrections foretell? A residual of 0 is enough. */
bool zp_closing_done(ZpClosing *closing, double residual, double tolerance);

/* Does nothing get better any more, for rounding, with residual and correction below 100 times what is asked for? */
bool zp_closing_stalled(const ZpClosing *closing, double residual, double tolerance);

/* What was held has been recomputed: the residual may be larger again. */
void zp_closing_renew(ZpClosing *closing);

void zp_newton_carve(ZpNewtonWork *work, size_t n, ZpBandForm form, ZpCarver *carver);

/* Iterate from the present point. */
ZpNewtonInfo zp_newton(const ZpStaticSystem *system, double tolerance, int most, ZpNewtonWork *work);

bool zp_newton_good(ZpNewtonEnd end);

#endif
