/* The cases of a scenario: the combinations of its lists, and the samples of its distributions. */
#ifndef ZP_IO_PLAN_H
#define ZP_IO_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/io.h>

#include "def/check.h"
#include "io/fitted.h"
#include "io/names.h"
#include "sample/design.h"
#include "sample/together.h"

/* Most cases of a scenario. */
enum { ZP_CASES_MOST = 1000000 };

/* The given value of a key. */
typedef struct ZpSlot {
  int key;
  int line;      /* in which it was given; 0: in none */
  double *value; /* [count], SI. A distribution has one, without meaning */
  size_t count;
  bool is_list;          /* it is a list, of any length: a column in the table */
  bool is_bare;          /* the key has a unit, the value was given without one */
  char *text;            /* value of a text key, whose number is NAN; otherwise NULL */
  bool is_fitted;        /* it is of base.file */
  ZpDistribution spread; /* distribution of a key whose values are drawn */
} ZpSlot;

/* The slots of all given keys, in the order of keys. */
typedef struct ZpGiven {
  const ZpSlot **slot;
  size_t count;
  const ZpFitted *fitted; /* the errors of its keys with `is_fitted` are correlated; NULL: there are none */
} ZpGiven;

/* The slot of a key; NULL: it is not given. */
const ZpSlot *zp_given(const ZpGiven *given, int key);

typedef struct ZpPlan {
  int *varied; /* [variations] keys with lists or distributions, in key order, */
  size_t *at;  /* [variations] and their places in ZpGiven */
  size_t variations;
  int *axis; /* [axes] keys whose lists are combined: of those that vary together the last one */
  size_t axes;
  bool *tied;       /* [given] varies together with others */
  size_t together;  /* length of their lists; 1: there are none */
  ZpDesign design;  /* of the distributions, */
  ZpTogether joint; /* and these, in key order */
  size_t count;     /* cases */
  ZpError problem;  /* the error of the scenario as a whole, otherwise all 0 */
  void *memory;
} ZpPlan;

/* Make the plan from the given values. ZP_BAD_INPUT if there are too many values or cases. Free it in any case. */
ZpStatus zp_plan_make(ZpPlan *plan, const ZpGiven *given, ZpError *err);
void zp_plan_free(ZpPlan *plan);

/* The values of the varied keys in case `index`, below plan->count => value [variations], in the order of plan->varied.
 */
void zp_plan_values(const ZpPlan *plan, const ZpGiven *given, size_t index, double *value);

/* The values of all given keys, with `value` for those that vary => list [given], and their number. */
size_t zp_plan_assign(const ZpPlan *plan, const ZpGiven *given, const double *value, ZpAssignment *list);

/* -- the cases of a scenario, for hashes and reports; to run one use zp_scenario_def, which checks it -- */

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
