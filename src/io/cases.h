/* The cases of a scenario, its lists and its distributions, for hashes and reports. To run a case, use zp_scenario_def,
 * which checks it. */
#ifndef ZP_IO_CASES_H
#define ZP_IO_CASES_H

#include <zipact/io.h>

#include "io/plan.h"

/* The Def of case `index` with its given keys, unchecked. ZP_BAD_INPUT, ZP_MACHINE: it cannot be made, or there is no
 * such case. */
ZpStatus zp_scenario_given(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);

/* The values of the keys of zp_scenario_lists in case `index`, below zp_scenario_count => value, in the order of that
 * list. Requires a scenario whose cases can be made. */
void zp_scenario_values(const ZpScenario *scenario, size_t index, double *value);

/* Keys whose lists are combined, in key order: of those that vary together only the last one. */
const int *zp_scenario_axes(const ZpScenario *scenario, size_t *count);

/* The values of one of these keys, in SI => [count], in the order of the cases. */
const double *zp_scenario_axis(const ZpScenario *scenario, int key, size_t *count);

/* The sampling; NULL if no key has a distribution. The cases of one combination of the lists' values are consecutive:
 * sample `i` is case i of them. */
const ZpDesign *zp_scenario_design(const ZpScenario *scenario);

/* The distribution of a key; NULL if it has none. */
const ZpDistribution *zp_scenario_spread(const ZpScenario *scenario, int key);

#endif
