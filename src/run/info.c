/* How a run went, read by calls. */
#include <math.h>
#include <string.h>

#include "run/info.h"

#include "base/memory.h"

ZpRunInfo *zp_run_info_create(void) {
  return zp_calloc(1, sizeof(ZpRunInfo));
}

void zp_run_info_destroy(ZpRunInfo *info) {
  zp_free(info);
}

ZpOutcome zp_run_info_outcome(const ZpRunInfo *info) {
  return info->outcome;
}

const char *zp_run_info_message(const ZpRunInfo *info) {
  return info->message;
}

int64_t zp_run_info_limited(const ZpRunInfo *info, ZpStepLimit limit) {
  return (size_t)limit < ZP_LIMIT_COUNT ? info->limited[limit] : 0;
}

double zp_run_info_get(const ZpRunInfo *info, const char *name) {
  const struct {
    const char *name;
    double value;
  } number[] = {{"steps", (double)info->steps},
                {"rejected", (double)info->rejected},
                {"failures", (double)info->failures},
                {"iterations", (double)info->iterations},
                {"drag_bound", info->smallest_bound[0]},
                {"axial_bound", info->smallest_bound[1]},
                {"shear_bound", info->smallest_bound[2]},
                {"simulated_time", info->simulated_time},
                {"wall_time", info->wall_time},
                {"settle_steps", (double)info->settle_steps},
                {"settle_residual", info->settle_residual}};
  for (size_t k = 0; k < sizeof number / sizeof number[0]; k++)
    if (strcmp(number[k].name, name) == 0) return number[k].value;
  return NAN;
}
