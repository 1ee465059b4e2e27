/* The distributions of a scenario, for reports. */
#ifndef ZP_IO_SAMPLED_H
#define ZP_IO_SAMPLED_H

#include <zipact/io.h>

#include "sample/design.h"
#include "sample/distribution.h"

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
