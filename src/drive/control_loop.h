/* Eigenvalues of the loops that sampled controllers close around a linear system. docs/theory.md, section 28. */
#ifndef ZP_DRIVE_CONTROL_LOOP_H
#define ZP_DRIVE_CONTROL_LOOP_H

#include "drive/control.h"
#include "math/eigen_general.h"

/* x' = A x + the sum of b u, y = c x, of each of its inputs. */
typedef struct ZpLinear {
  size_t n, inputs;
  const double *A, *b, *c; /* [n n] row by row, [inputs][n], [inputs][n] */
} ZpLinear;

/* How fast and how a small motion grows. */
typedef struct ZpGrowth {
  double rate;      /* 1/s; below 0: it decays */
  double frequency; /* Hz; of a loop at most half of that of its samples */
  double factor;    /* from sample to sample: |z| */
} ZpGrowth;

/* States of a controller, at most. */
enum { ZP_LOOP_OWN = ZP_CONTROL_DELAY + 2 };

/* Eigenvalues, the one that grows fastest first: of the system alone, as a controller with a constant output leaves it,
 * [n], and of the loops, [n + inputs ZP_LOOP_OWN], of which controller k sets input k by signal k and acts at once by
 * proportional[k] (V per unit of the signal). All have the period of the first one. Conjugate eigenvalues are told
 * once; of each, as many as `neutral` says, which neither grow nor decay by nature, are left out. => how many there
 * are; 0 if they are not found: a motion grows beyond all numbers within a period, or the iteration does not converge.
 * `work` has room for zp_loop_work(n, inputs) doubles. */
size_t zp_loop_work(size_t n, size_t inputs);
size_t zp_open_loop(const ZpControl *control, const ZpLinear *system, size_t neutral, ZpGrowth *growth, double *work);
size_t zp_closed_loop(const ZpControl *control, const ZpLinear *system, const double *proportional, size_t neutral,
                      ZpGrowth *growth, double *work);

#endif
