/* Hooks of a caller, asked. */
#ifndef ZP_RUN_HOOKS_H
#define ZP_RUN_HOOKS_H

#include <math.h>

#include "run/info.h"

/* Tell the caller how far a stage is, 0 .. 1 (more is 1). => Is it to stop? `hooks` may be NULL. */
static inline bool zp_hooks_stop(const ZpHooks *hooks, const char *stage, double fraction) {
  return hooks && hooks->progress && hooks->progress(hooks->user, stage, fmin(fraction, 1));
}

#endif
