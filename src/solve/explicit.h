/* One step of symplectic Euler, eq. (1) of the paper, with a step bounded by the system and cut at events.
 * Knows no physics: q'' = a(t, q, v). */
#ifndef ZP_SOLVE_EXPLICIT_H
#define ZP_SOLVE_EXPLICIT_H

#include <stddef.h>

/* Interface of a problem to the stepping. */
typedef struct ZpExplicitSystem {
  size_t n;   /* coordinates */
  void *self; /* handed to the functions below */
  /* (q, v) => a; returns the largest step that accuracy and stability allow, s. */
  double (*accelerate)(void *self, const double *q, const double *v, double *a);
  /* Time to the first event if the step were `dt`, at most dt; NULL where there are no events. */
  double (*next_event)(void *self, const double *q, const double *v, const double *a, double dt);
} ZpExplicitSystem;

/* Limits of the size of a step. */
typedef enum ZpExplicitLimit { ZP_EXPLICIT_BOUND, ZP_EXPLICIT_END, ZP_EXPLICIT_EVENT } ZpExplicitLimit;

typedef struct ZpExplicitStep {
  double dt; /* taken, s; 0 for an event at the very start */
  ZpExplicitLimit limit;
} ZpExplicitStep;

/* Advance (q, v) by v += a dt; q += v dt, by at most `longest`; `a` is work space of n doubles. */
ZpExplicitStep zp_explicit_step(const ZpExplicitSystem *system, double longest, double *q, double *v, double *a);

#endif
