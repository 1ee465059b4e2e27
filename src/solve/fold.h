/* Limit points and events of a branch r(q, m) = 0, solved directly instead of being approached along the branch, by
 * Newton's method on the extended system of q, m and the null vector (Moore and Spence). This file contains no physics.
 *
 * A limit point (fold) is where the stiffness has a null vector. An event is where a function of q has some value. */
#ifndef ZP_SOLVE_FOLD_H
#define ZP_SOLVE_FOLD_H

#include "solve/continuation.h"

/* The function of an event: returns its value at the point of the last residual; its derivative by q => row [n]. */
typedef double (*ZpEvent)(void *self, double *row);

/* Work space. */
typedef struct ZpFold {
  const ZpBranchSystem *system;
  ZpNewtonWork *newton;   /* may be that of a branch */
  ZpArrow beside;         /* the stiffness at a neighbouring point */
  double tolerance;       /* of the residual */
  double *null;           /* [n] null vector, of length 1; at the start of a solution, a guess of it */
  double *along;          /* [n] dq/dm at the point of the last solution; at a limit point a large multiple of `null` */
  double *a, *b, *x, *at; /* [n] */
  double *by_a, *by_n;    /* [n] */
  double test;            /* 0 at a limit point: the stiffness along the null vector */
  size_t negative;        /* eigenvalues below 0 of the stiffness; at a limit point without that of the null vector */
  double *excess;         /* [n] forces that are missing to balance at the start of a solution from far away, */
  double share;           /* and the share of them that is still added: 0, or more on the way */
  double left;            /* size of the forces at the start of the last step */
  double change, moved;   /* by the last step: of m, relative; of q, in units of the required accuracy */
  void *saved, *start;    /* points to return to */
  double *null_at_start;  /* [n] */
} ZpFold;

/* Two limit points closer than this, relative, are a ripple of the mesh: the front passing a node of an unstable
 * branch. Measured at N = 61 without breakdown cap, where it is largest: 0.35 %. */
#define ZP_FOLD_RIPPLE 5e-3

/* Accuracy of a solution: a result, or an intermediate point, which is only accurate enough for its tangent. */
typedef enum ZpFoldTo { ZP_FOLD_EXACT, ZP_FOLD_ROUGH } ZpFoldTo;

void zp_fold_reserve(ZpFold *fold, const ZpBranchSystem *system, const ZpArrowForm *form, ZpNewtonWork *newton,
                     ZpArena *arena);

/* At the present point: unbalanced forces => newton->r, factored stiffness => newton->K, number of its negative pivots
 * => negative, dq/dm = K^-1 dr/dm => along. False if there is no residual or the stiffness is singular. */
bool zp_fold_tangent(ZpFold *fold);

/* A guess of the null vector near a limit point: the direction of `along`. */
void zp_fold_guess(ZpFold *fold);

/* From the present point, which is close, to the limit point; `null` must be close to its null vector. False if there
 * is none nearby; the present point is then undefined. */
bool zp_fold_solve(ZpFold *fold);

/* zp_fold_solve from a point that is no equilibrium and may be far away, as the limit point of a neighbour. What it
 * lacks to balance acts as a dead force, and is taken away in parts. */
bool zp_fold_approach(ZpFold *fold);

/* Solve for the equilibrium where `event` has this value. The way there may pass limit points. */
bool zp_fold_event(ZpFold *fold, ZpEvent event, double value, ZpFoldTo to);

/* Leave the limit point at the present point along its null vector, so far that `event` changes by `change`, but by one
 * move at most. */
void zp_fold_leave(ZpFold *fold, const double *null, ZpEvent event, double change);

/* Continue along the branch with about one factorisation per point: from close to the equilibrium where `event` has the
 * value `here`, one Newton step to it, where the parameter is m, with the derivative `slope` by the event's value, and
 * then along the tangent to the value `next`. If the Newton step was too long for this, it ends at `here`, to be tried
 * again. */
typedef enum ZpPass { ZP_PASS_ON, ZP_PASS_AGAIN, ZP_PASS_LOST } ZpPass;
ZpPass zp_fold_pass(ZpFold *fold, ZpEvent event, double here, double next, double *m, double *slope);

/* Solve roughly for the equilibrium at the present parameter. */
bool zp_fold_rest(ZpFold *fold);

#endif
