/* The cases of a scenario: the combinations of its lists, and the samples of its distributions. */
#ifndef ZP_IO_PLAN_H
#define ZP_IO_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include "def/def.h"

#include "sample/design.h"
#include "sample/distribution.h"

/* Number of keys. */
enum {
  ZP_KEYS = 0
#define ZP_EACH_KEY(path, field, text) +1
#include "def/keys.def"
};

/* The given value of a key. */
typedef struct ZpSlot {
  double *value; /* [count], SI; NULL if the key is not given. A distribution has one, without meaning */
  size_t count;
  bool is_list;          /* it is a list, of any length: a column in the table */
  bool is_bare;          /* the key has a unit, the value was given without one */
  char *text;            /* value of a text key, whose number is NAN; otherwise NULL */
  ZpDistribution spread; /* distribution of a key whose values are drawn */
} ZpSlot;

typedef struct ZpPlan {
  int varied[ZP_KEYS]; /* [variations] keys with lists or distributions, in key order */
  size_t variations;
  int axis[ZP_KEYS]; /* [axes] keys whose lists are combined: of those that vary together the last one */
  size_t axes;
  bool tied[ZP_KEYS]; /* varies together with others */
  size_t together;    /* length of their lists; 1: there are none */
  ZpDesign design;    /* of the distributions */
  size_t count;       /* cases */
  char problem[256];  /* the error of the scenario as a whole, otherwise empty */
} ZpPlan;

/* Make the plan from the given values of each key, slot [ZP_KEYS]. ZP_BAD_INPUT if there are too many values or cases.
 */
ZpStatus zp_plan_make(ZpPlan *plan, const ZpSlot *const *slot, ZpError *err);

/* The values of the varied keys in case `index`, below plan->count => value [variations], in the order of plan->varied.
 */
void zp_plan_values(const ZpPlan *plan, const ZpSlot *const *slot, size_t index, double *value);

/* The values of all given keys, with `value` for those that vary => their number, at most one per key. */
size_t zp_plan_assign(const ZpPlan *plan, const ZpSlot *const *slot, const double *value, ZpAssignment *list);

#endif
