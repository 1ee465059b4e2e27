#include "fit/time_limit.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#include <zipact/calibrate.h>

#include "def/def.h"
#include "run/hooks.h"

/* Of this thread, s. */
static double cpu_time(void) {
  struct timespec now;
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0;
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool on_progress(void *user, const char *stage, double fraction) {
  ZpTimeLimit *limit = user;
  if (zp_hooks_stop(limit->asked, stage, fraction)) return true;
  limit->over = limit->over || cpu_time() > limit->end;
  return limit->over;
}

static double read_clock(void *user) {
  const ZpHooks *asked = ((ZpTimeLimit *)user)->asked;
  return asked->clock(asked->user);
}

const ZpHooks *zp_time_limit_begin(ZpTimeLimit *limit, const ZpActuatorDef *def, const ZpHooks *hooks) {
  const double most = def->solver.max_cpu_time;
  *limit = (ZpTimeLimit){.asked = hooks, .most = most, .end = cpu_time() + most};
  limit->hooks = (ZpHooks){limit, on_progress, hooks && hooks->clock ? read_clock : NULL};
  return isnan(most) ? hooks : &limit->hooks;
}

void zp_time_limit_end(const ZpTimeLimit *limit, ZpResult *result) {
  if (!limit->over) return;
  result->outcome = ZP_TIME_LIMIT;
  snprintf(result->message, sizeof result->message, "stopped by solver.max_cpu_time = %g s before it had a result",
           limit->most);
  zp_result_forget_notes(result);
  for (size_t k = 0; k < result->scalars; k++)
    if (!result->scalar[k].timing) result->scalar[k].value = NAN;
  for (size_t k = 0; k < result->sensitivities; k++)
    result->sensitivity[k].value = NAN;
  zp_result_forget_states(result); /* where the next case would begin */
}

ZpStatus zp_study_run_limited(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                              ZpResult **result, ZpError *err) {
  ZpTimeLimit limit;
  const ZpHooks *own = zp_time_limit_begin(&limit, def, hooks);
  ZpStatus status = zp_study_run(study, def, input, own, result, err);
  if (status == ZP_OK) zp_time_limit_end(&limit, *result);
  return status;
}
