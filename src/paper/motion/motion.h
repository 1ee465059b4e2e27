/* An actuator in motion as the paper steps it: symplectic Euler with the bounds of eq. (9), sequential zipping with its
 * meetings inside a step; and, for comparison, unilateral contact by such steps. docs/theory.md, sections 6 and 10. */
#ifndef ZP_PAPER_MOTION_MOTION_H
#define ZP_PAPER_MOTION_MOTION_H

#include "solve/explicit.h"
#include "system/system.h"

/* What set the size of a step. */
typedef enum ZpPaperLimit {
  ZP_PAPER_STABILITY, /* the stable step of the model */
  ZP_PAPER_ASKED,     /* solver.time_step */
  ZP_PAPER_DRAG,      /* half of the first bound of eq. (9) */
  ZP_PAPER_MEETING,   /* a pair has met */
  ZP_PAPER_END        /* the time at which it should end at the latest */
} ZpPaperLimit;

typedef struct ZpPaperMotion {
  const ZpModel *model;
  ZpEval *eval;
  ZpState *state; /* of the step under way */
  double *a;      /* [2 stride] accelerations */
  double longest; /* that a step may be, s */
  /* of the step under way */
  ZpPaperLimit limit; /* what set the largest step allowed */
  size_t met;         /* pair that meets inside it */
  ZpZipState opened;  /* what is joined after it if nothing meets */
} ZpPaperMotion;

/* With the work space `eval`, which is the caller's. False if there is no memory. */
bool zp_paper_motion_create(const ZpModel *model, ZpEval *eval, ZpPaperMotion *motion);
void zp_paper_motion_destroy(ZpPaperMotion *motion);

/* One step that ends at `latest`, s, or before => the state at its end: its time, its losses, what is joined; what set
 * its size. A meeting at its start makes it one of no length. The voltage is that of its start all the way. */
ZpPaperLimit zp_paper_motion_step(ZpPaperMotion *motion, ZpState *state, double latest);

#endif
