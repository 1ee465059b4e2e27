/* The cases of a scenario for those who hash or report them. Who runs one takes zp_scenario_def, which checks it. */
#ifndef ZP_IO_CASES_H
#define ZP_IO_CASES_H

#include <zipact/io.h>

/* The Def of case `index` as its keys are given: it need not be one that can be run. ZP_BAD_INPUT, ZP_MACHINE: it
 * cannot be made, or there is no such case. */
ZpStatus zp_scenario_given(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);

/* The values that case `index`, below zp_scenario_count, has of the keys of zp_scenario_lists => value, as in that
 * list. Of a scenario whose cases can be made. */
void zp_scenario_values(const ZpScenario *scenario, size_t index, double *value);

#endif
