/* The cases of a scenario for hashes and reports. To run a case, use zp_scenario_def, which checks it. */
#ifndef ZP_IO_CASES_H
#define ZP_IO_CASES_H

#include <zipact/io.h>

/* The Def of case `index` with its given keys, unchecked. ZP_BAD_INPUT, ZP_MACHINE: it cannot be made, or there is no
 * such case. */
ZpStatus zp_scenario_given(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);

/* The values of the keys of zp_scenario_lists in case `index`, below zp_scenario_count => value, in the order of that
 * list. Requires a scenario whose cases can be made. */
void zp_scenario_values(const ZpScenario *scenario, size_t index, double *value);

#endif
