/* Motion of an actuator with the numerics of the paper: symplectic Euler with the bounds of eq. (9), and sequential
 * zipping with meetings inside a step; for comparison also unilateral contact. docs/theory.md, sections 6 and 10. */
#ifndef ZP_RUN_PAPER_MOTION_H
#define ZP_RUN_PAPER_MOTION_H

#include "solve/explicit.h"
#include "system/system.h"

/* Limits of the size of a step. */
typedef enum ZpPaperLimit {
  ZP_PAPER_STABILITY, /* the stable step of the model */
  ZP_PAPER_ASKED,     /* solver.time_step */
  ZP_PAPER_DRAG,      /* half of the first bound of eq. (9) */
  ZP_PAPER_MEETING,   /* a pair has met */
  ZP_PAPER_END        /* the latest time at which it may end */
} ZpPaperLimit;

typedef struct ZpPaperMotion {
  const ZpModel *model;
  ZpEval *eval;
  ZpState *state; /* of the current step */
  double *a;      /* [2 stride] accelerations */
  double longest; /* largest allowed step, s */
  size_t contact; /* number of the row of contact losses */
  /* of the current step: */
  ZpSpan step;        /* over which losses are booked */
  ZpPaperLimit limit; /* what limits the largest allowed step */
  size_t met;         /* pair that meets inside the step */
  ZpZipState opened;  /* joined pairs after the step if no pair meets */
} ZpPaperMotion;

/* Create with the work space `eval`, which the caller owns. False if there is no memory. */
bool zp_paper_motion_create(const ZpModel *model, ZpEval *eval, ZpPaperMotion *motion);
void zp_paper_motion_destroy(ZpPaperMotion *motion);

/* One step that ends at `latest`, s, or before => the state at its end, with its time, losses and joined pairs, and
 * what limited its size. A meeting at its start gives a step of length 0. The voltage is constant during the step. */
ZpPaperLimit zp_paper_motion_step(ZpPaperMotion *motion, ZpState *state, double latest);

#endif
