/* Study `plan`: which further measurements limit the fitted keys most. */
#ifndef ZP_FIT_PLAN_H
#define ZP_FIT_PLAN_H

#include <zipact/calibrate.h>

/* Read and check the input of study plan and, unless `out` is NULL, run it. */
ZpStatus zp_plan_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err);

#endif
