/* Limit points and events of a branch r(q, m) = 0, solved as such instead of being approached along it: Newton's method
 * on the extended system of q, m and the null vector (Moore and Spence). Knows no physics.
 *
 * A limit point (fold) is where the stiffness has a null vector. An event is where a function of q has some value. */
#ifndef ZP_SOLVE_FOLD_H
#define ZP_SOLVE_FOLD_H

#include "solve/continuation.h"

/* What an event is told by: => its value at the point of the last residual, and its derivative by q => row [n]. */
typedef double (*ZpEvent)(void *self, double *row);

/* Work space. */
typedef struct ZpFold {
  const ZpBranchSystem *system;
  ZpNewtonWork *newton;   /* that of a branch serves */
  ZpBand beside;          /* the stiffness beside the point */
  double tolerance;       /* of the residual */
  double *null;           /* [n] null vector, of length 1; where a solution starts, a guess of it */
  double *along;          /* [n] dq/dm at the point of the last solution; at a limit point the null vector times much */
  double *a, *b, *x, *at; /* [n] */
  double *by_a, *by_n;    /* [n] */
  double test;            /* 0 at a limit point: the stiffness along the null vector */
  size_t negative;        /* eigenvalues below 0 of the stiffness; at a limit point of what is across the null vector */
  double left;            /* size of the forces where the last step began */
  double change, moved;   /* of its last step: relative to m; in units of the accuracy asked for */
  void *saved;
} ZpFold;

/* Two limit points closer than this, relative, are a ripple of the mesh: the front passing a node of an unstable
 * branch. Measured at N = 61 without breakdown cap, where it is largest: 0.35 %. */
#define ZP_FOLD_RIPPLE 5e-3

/* A solution is an answer, or a point on the way to one: near enough for its tangent. */
typedef enum ZpFoldTo { ZP_FOLD_EXACT, ZP_FOLD_ROUGH } ZpFoldTo;

void zp_fold_carve(ZpFold *fold, const ZpBranchSystem *system, ZpBandForm form, ZpNewtonWork *newton, ZpCarver *carver);

/* At the present point: forces left => newton->r, factored stiffness => newton->K, its negative pivots => negative,
 * dq/dm = K^-1 dr/dm => along. False if there are no forces or the stiffness is singular. */
bool zp_fold_tangent(ZpFold *fold);

/* A guess of the null vector near a limit point: the direction of `along`. */
void zp_fold_guess(ZpFold *fold);

/* From the present point, which is near, to the limit point, from `null`, near its null vector. False if there is none
 * near; the present point is then anywhere. */
bool zp_fold_solve(ZpFold *fold);

/* The same to the equilibrium where `event` has this value; limit points are no obstacle. */
bool zp_fold_event(ZpFold *fold, ZpEvent event, double value, ZpFoldTo to);

/* On along the branch with about one factorisation a point: from near the equilibrium where `event` has the value
 * `here`, one Newton step to that, whose parameter is m, and by the tangent on to the value `next`. Where the step was
 * too long for that it ends at `here`, to be tried again. */
typedef enum ZpPass { ZP_PASS_ON, ZP_PASS_AGAIN, ZP_PASS_LOST } ZpPass;
ZpPass zp_fold_pass(ZpFold *fold, ZpEvent event, double here, double next, double *m);

/* The same to the equilibrium at the present parameter, roughly. */
bool zp_fold_rest(ZpFold *fold);

#endif
