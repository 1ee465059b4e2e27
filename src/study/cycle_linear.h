/* The linear answer of study `cycle`: small periodic motion about the state at the mean of the squared voltage.
 * docs/theory.md, section 24. */
#ifndef ZP_STUDY_CYCLE_LINEAR_H
#define ZP_STUDY_CYCLE_LINEAR_H

#include "math/complex_solve.h"
#include "rest/plant.h"
#include "run/run.h"

enum { ZP_CYCLE_HARMONICS = 64 }; /* most */

typedef struct ZpLinearCycle {
  const ZpModel *model;
  ZpRest rest;                              /* at the mean */
  ZpSmallMotion small;                      /* about it */
  size_t harmonics;                         /* of the squared voltage, 1, 2, ... */
  double mean;                              /* of the squared voltage, V^2 */
  ZpComplex square[ZP_CYCLE_HARMONICS + 1]; /* its harmonics: the sum of Re(square e^(2 pi i n t / T)), V^2 */
  ZpComplex *moved;                         /* [harmonics + 1][rates] integrals of the rates, likewise */
  double energy;                            /* that a cycle loses, of the whole actuator, J */
  double curvature; /* amplitude of the motion of second order over that of the first; INFINITY: there is none */
  ZpComplex *matrix;
  double *x, *q, *force; /* work space */
  void *memory;
} ZpLinearCycle;

/* => whether there is a state at the mean; `failed`: there was no memory. To be closed in any case. */
bool zp_linear_cycle_open(const ZpModel *model, const ZpHooks *hooks, ZpLinearCycle *linear, bool *failed);
void zp_linear_cycle_close(ZpLinearCycle *linear);

/* Positions, velocities and liquid at the edges, `turns` after the start of a cycle, of a simulation of all members. */
void zp_linear_cycle_put(ZpLinearCycle *linear, double turns, ZpSim *sim);

#endif
