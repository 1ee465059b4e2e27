/* An actuator at rest as a static system: equations numbered, forces, exact stiffness, and how to move.
 * Contact is unilateral; the clip is joined. */
#ifndef ZP_ACTUATOR_STATICS_H
#define ZP_ACTUATOR_STATICS_H

#include "actuator/eval.h"
#include "contact/unilateral.h"
#include "solve/continuation.h"

typedef struct ZpStatics {
  const ZpModel *model;
  ZpEval eval;
  ZpUnilateralParams contact;
  double *q;              /* [2 stride] the present point */
  double U;               /* V */
  bool contact_acts;      /* faces push on each other; without, they may pass (to find a start) */
  int *equation;          /* [2 count] of x and y of node j at 2 j, 2 j + 1; -1 where held */
  size_t n, bandwidth;
  double scale;           /* force that a residual is relative to, N */
  double (*D)[4];         /* [3 edges] mechanics' stiffness */
  double *push, *own, *next, *along0, *along1; /* [N] contact and field, by stations */
  double *tension;        /* [edges] what the last step foresaw, N */
  double *moved;          /* [2 stride] work space of a move */
  double *force;          /* [2 stride] */
  double *r_up, *r_down;  /* [n] work space of the sensitivity */
  void *memory;
} ZpStatics;

/* Allocate and start straight, without voltage. False if there is no memory. */
bool zp_statics_create(const ZpModel *model, ZpStatics *statics);
void zp_statics_destroy(ZpStatics *statics);

/* The vtable for solve/newton.h. */
ZpStaticSystem zp_statics_system(ZpStatics *statics);

/* The same with the voltage as parameter. */
ZpBranchSystem zp_statics_branch(ZpStatics *statics);

/* Does it stay there when pushed? Of a rod: no negative eigenvalue of the stiffness. `work` [n (bandwidth + 1)]. */
bool zp_statics_stable(ZpStatics *statics, ZpNewtonWork *work);

/* Residual below which rounding takes over. */
double zp_statics_floor(const ZpStatics *statics);

#endif
