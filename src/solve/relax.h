/* Damped stepping to rest: dynamic relaxation with pseudo-masses and damping that follows the slowest
 * motion left. Finds a stable equilibrium of a = f(q) = 0. Knows no physics. */
#ifndef ZP_SOLVE_RELAX_H
#define ZP_SOLVE_RELAX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ZpRelaxSystem {
  size_t n;   /* coordinates */
  void *self; /* handed to the functions below */
  /* q => pseudo-acceleration, scaled so that the fastest motion has a frequency below 1.5 / unit step. */
  void (*accelerate)(void *self, const double *q, double *a);
  /* Imbalance left at the last accelerate, relative to what acts; below `tolerance` is rest. */
  double (*residual)(void *self);
  /* Asked now and then with steps done: stop? May be NULL. */
  bool (*stop)(void *self, int64_t steps, double residual);
} ZpRelaxSystem;

typedef enum ZpRelaxEnd { ZP_RELAX_AT_REST, ZP_RELAX_STOPPED, ZP_RELAX_DIVERGED, ZP_RELAX_STEP_LIMIT } ZpRelaxEnd;

typedef struct ZpRelaxInfo {
  ZpRelaxEnd end;
  int64_t steps;
  double residual;
} ZpRelaxInfo;

/* Relax q (n doubles) in at most `most_steps`; work: 5 n doubles. */
ZpRelaxInfo zp_relax(const ZpRelaxSystem *system, double tolerance, int64_t most_steps, double *q, double *work);

#endif
