/* To the end of a stable branch r(q, m) = 0 without following it: in a few long steps, until a limit point, an event or
 * the target is close enough to be solved directly. This file contains no physics.
 *
 * Near a limit point m_f the branch is a parabola: q_f - q = 2 (m_f - m) dq/dm, and 1 / |dq/dm|^2 falls to 0 like
 * m_f - m. The first relation checks a result; the second tells how far the limit point is. */
#ifndef ZP_SOLVE_TRACK_H
#define ZP_SOLVE_TRACK_H

#include "solve/fold.h"

typedef enum ZpTrackEnd {
  ZP_TRACK_ARRIVED, /* at the target m */
  ZP_TRACK_FOLD,    /* at a limit point, with the null vector `fold.null` */
  ZP_TRACK_EVENT,   /* at the event */
  ZP_TRACK_LOST     /* at the last good point: none of these was found */
} ZpTrackEnd;

typedef struct ZpTrack {
  ZpFold fold;
  ZpEvent event;   /* NULL: none */
  double limit;    /* value of its function at the event */
  double *q;       /* [n] at the last good point */
  double *before;  /* [n] dq/dm there */
  double *guess;   /* [n] a step */
  void *good;      /* the last good point */
  void *start;     /* the start of the track */
  ZpFoldTo to;     /* how accurate steps are: rough at first, exact if the branch was lost */
  double m;        /* parameter at the last good point */
  double value;    /* value of the event there */
  double slope;    /* derivative of the event along m there */
  double flat;     /* 1 / |dq/dm|^2 there */
  double to_fold;  /* distance of the limit point along m; INFINITY: none is expected */
  bool tried;      /* the solution for it from there has been tried */
  int short_steps; /* in a row, far shorter than the best estimate */
} ZpTrack;

void zp_track_reserve(ZpTrack *track, const ZpBranchSystem *system, const ZpArrowForm *form, ZpNewtonWork *newton,
                      ZpArena *arena);

/* From the present point, a stable equilibrium, towards m = target. Every point on the way is stable. */
ZpTrackEnd zp_track(ZpTrack *track, double target);

#endif
