/* Which cases a scenario stands for: the combinations of its lists, and the samples of its distributions. */
#ifndef ZP_IO_PLAN_H
#define ZP_IO_PLAN_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/def.h>

#include "sample/design.h"
#include "sample/distribution.h"

/* What is given for a key. */
typedef struct ZpSlot {
  double *value; /* [count], SI; NULL if the key is not given. Of a distribution one, which means nothing */
  size_t count;
  bool is_list;          /* a list of one is a list: it makes a row in the table */
  bool is_bare;          /* of a key with a unit a value was given without one */
  char *text;            /* of a text key, whose value is NAN; else NULL */
  ZpDistribution spread; /* of a key whose values are drawn */
} ZpSlot;

typedef struct ZpPlan {
  int *varied; /* [variations] keys with lists or distributions, in key order */
  size_t variations;
  int *axis; /* [axes] keys whose lists are combined: of those that are walked through together the last */
  size_t axes;
  bool *tied;        /* [keys] is walked through together with others */
  size_t together;   /* how long their lists are; 1: there are none */
  ZpDesign design;   /* of the distributions */
  size_t count;      /* cases */
  char problem[256]; /* what is wrong with the scenario as a whole, else empty */
} ZpPlan;

/* Room for the plan of a scenario; false if there is no memory. To be freed whatever it returns. */
bool zp_plan_create(ZpPlan *plan);
void zp_plan_free(ZpPlan *plan);

/* Make the plan of what is given for each key, slot [keys]. ZP_BAD_INPUT where there are too many values or cases. */
ZpStatus zp_plan_make(ZpPlan *plan, const ZpSlot *const *slot, ZpError *err);

/* The values that case `index`, below plan->count, gives the keys that vary => value [variations], as in plan->varied.
 */
void zp_plan_values(const ZpPlan *plan, const ZpSlot *const *slot, size_t index, double *value);

/* The values of all keys that are given, with `value` for those that vary => how many, most of them per key. */
size_t zp_plan_assign(const ZpPlan *plan, const ZpSlot *const *slot, const double *value, ZpAssignment *list);

#endif
