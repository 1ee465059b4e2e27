/* The time of a processor that a case may take: solver.max_cpu_time. The core has no clock; its hooks have one here. */
#ifndef ZP_FIT_TIME_LIMIT_H
#define ZP_FIT_TIME_LIMIT_H

#include "study/result.h"

typedef struct ZpTimeLimit {
  const ZpHooks *asked; /* hooks of the caller; may be NULL */
  ZpHooks hooks;        /* those of the run */
  double most, end;     /* s: of the case; of the clock of its thread */
  bool over;
} ZpTimeLimit;

/* (limit, which must outlive the run) => hooks of a run of `def` that begins now. */
const ZpHooks *zp_time_limit_begin(ZpTimeLimit *limit, const ZpActuatorDef *def, const ZpHooks *hooks);

/* After the run: if the limit has stopped it, its outcome is ZP_TIME_LIMIT and its numbers are none. */
void zp_time_limit_end(const ZpTimeLimit *limit, ZpResult *result);

#endif
