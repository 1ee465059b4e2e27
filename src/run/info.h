/* The inside of what a run tells of itself, which only the library and its tests see. */
#ifndef ZP_RUN_INFO_H
#define ZP_RUN_INFO_H

#include <zipact/sim.h>

/* How a run went. */
struct ZpRunInfo {
  ZpOutcome outcome;
  char message[256];               /* one sentence for people */
  int64_t steps;                   /* taken */
  int64_t limited[ZP_LIMIT_COUNT]; /* number of steps that each limit set */
  int64_t rejected;                /* implicit: steps rejected for their local error */
  int64_t failures;                /* implicit: steps in which Newton's method did not converge */
  int64_t iterations;              /* implicit: iterations of Newton's method */
  double smallest_bound[3];        /* of eq. (9): drag, axial, shear; s; over the recorded rows */
  double simulated_time;           /* s */
  double wall_time;                /* of the stepping, s; NAN without a clock */
  int64_t settle_steps;            /* pseudo-time steps to the hanging equilibrium */
  double settle_residual;          /* largest unbalanced force there, over all weight */
};

#endif
