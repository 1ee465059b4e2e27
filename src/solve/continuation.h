/* Following a branch of equilibria r(q, m) = 0 along a parameter m, through limit points, by arc length
 * (H. B. Keller's pseudo-arclength with a bordered Newton corrector). Knows no physics. */
#ifndef ZP_SOLVE_CONTINUATION_H
#define ZP_SOLVE_CONTINUATION_H

#include <math.h>

#include "solve/newton.h"

typedef struct ZpBranchSystem {
  ZpStaticSystem at_rest;
  double *input;                                /* of the present point: the parameter m is this, */
  bool square;                                  /* or its square */
  void (*sensitivity)(void *self, double *r_m); /* dr/dm [n] at the present point */
  void (*position)(void *self, double *q);      /* the present point by its coordinates [n] */
  void (*save)(void *self, void *to);           /* the whole present point, save_size bytes */
  void (*restore)(void *self, const void *from);
  size_t save_size;
  double q_scale, m_scale; /* coordinates and parameter are measured in these */
  size_t alike;            /* how many equal systems it consists of, one after the other, that move alike; 0: none */
} ZpBranchSystem;

/* The parameter m at a value of the input, and at the present point. */
static inline double zp_branch_parameter_at(const ZpBranchSystem *system, double input) {
  return system->square ? input * input : input;
}

static inline double zp_branch_parameter(const ZpBranchSystem *system) {
  return zp_branch_parameter_at(system, *system->input);
}

static inline void zp_branch_set(const ZpBranchSystem *system, double m) {
  *system->input = !system->square ? m : m > 0 ? sqrt(m) : 0;
}

/* A branch being followed. Direction in scaled units, length 1. */
typedef struct ZpBranch {
  const ZpBranchSystem *system;
  ZpNewtonWork *newton;                                                        /* the caller's */
  double *a, *b, *q, *q_start, *direction, *direction_saved, *direction_after; /* [n] */
  double a_m;         /* of the tangent found last, which is in `a`, along m */
  double direction_m; /* part of the direction along m: its sign changes at a limit point */
  bool along;         /* it has the sign of the stiffness's determinant, which changes there, too */
  bool reversed;      /* last looked at, it was the other way round: a turn into the way back, or a bifurcation */
  double step;        /* arc length to try next */
  double taken;       /* arc length of the last step */
  double longest_step;
  double longest_m_step; /* of m_scale, so that a branch along which little moves is not left with few points */
  double tolerance;
  void *saved, *saved_before;
} ZpBranch;

void zp_branch_reserve(ZpBranch *branch, const ZpBranchSystem *system, ZpNewtonWork *newton, ZpArena *arena);

/* Start at the present point, which must be an equilibrium, towards growing (or falling) m. False if the
 * stiffness is singular there. */
bool zp_branch_start(ZpBranch *branch, bool growing, double first_step, double longest_step, double tolerance);

/* Go one point further, with as short a step as it takes. False if even the shortest fails; the present
 * point is then the last good one. */
bool zp_branch_advance(ZpBranch *branch);

/* After a step over a limit point (direction_m has changed its sign): the parameter at the limit point, to about a
 * millionth. The present point stays where it is. */
double zp_branch_limit(ZpBranch *branch);

/* After a step within which `passed` (of `user`, who knows the present point) has become true: back to just before it
 * did, or before the limit point if that came first. */
void zp_branch_approach(ZpBranch *branch, bool (*passed)(void *user), void *user);

#endif
