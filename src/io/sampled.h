/* What a scenario draws from distributions, for those who report it. */
#ifndef ZP_IO_SAMPLED_H
#define ZP_IO_SAMPLED_H

#include <zipact/io.h>

#include "sample/design.h"
#include "sample/distribution.h"

/* Keys whose lists are combined, in key order: of those that are walked through together only the last. */
const int *zp_scenario_axes(const ZpScenario *scenario, size_t *count);

/* How samples are drawn; NULL if no key has a distribution. The cases of one combination of the lists' values follow
 * each other: sample `i` of it is case i of them. */
const ZpDesign *zp_scenario_design(const ZpScenario *scenario);

/* The distribution of a key; NULL if it has none. */
const ZpDistribution *zp_scenario_spread(const ZpScenario *scenario, int key);

#endif
