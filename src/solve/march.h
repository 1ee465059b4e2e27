/* To the end of a stable branch r(q, m) = 0 without following it: a few long steps, from which a limit point, an event
 * or what is asked for is near enough to be solved as such. Knows no physics.
 *
 * Near a limit point m_f the branch is a parabola: q_f - q = 2 (m_f - m) dq/dm, and 1 / |dq/dm|^2 falls to 0 like
 * m_f - m. The first is what an answer is checked with, the second says how far the limit point is. */
#ifndef ZP_SOLVE_MARCH_H
#define ZP_SOLVE_MARCH_H

#include "solve/fold.h"

typedef enum ZpMarchEnd {
  ZP_MARCH_ARRIVED, /* at the m that was asked for */
  ZP_MARCH_FOLD,    /* at a limit point, which `fold.null` belongs to */
  ZP_MARCH_EVENT,   /* where the event is */
  ZP_MARCH_LOST     /* neither was found: at the last good point */
} ZpMarchEnd;

typedef struct ZpMarch {
  ZpFold fold;
  ZpEvent event;  /* NULL: none */
  double limit;   /* its value where it is */
  double *q;      /* [n] at the last good point */
  double *before; /* [n] dq/dm there */
  double *guess;  /* [n] a step */
  void *good;     /* the last good point */
  void *start;    /* where the march began */
  ZpFoldTo to;    /* how near steps come to the branch: roughly first, exactly where that was lost */
  double m;       /* its parameter */
  double value;   /* of the event there */
  double slope;   /* of the event along m */
  double flat;    /* 1 / |dq/dm|^2 there */
  double to_fold; /* how far the limit point is, along m; INFINITY: none is in sight */
  bool tried;     /* to solve for it from there */
} ZpMarch;

void zp_march_carve(ZpMarch *march, const ZpBranchSystem *system, ZpBandForm form, ZpNewtonWork *newton,
                    ZpCarver *carver);

/* From the present point, a stable equilibrium, towards m = target. Every point on the way is stable. */
ZpMarchEnd zp_march(ZpMarch *march, double target);

#endif
