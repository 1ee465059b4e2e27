/* Derivatives of what a study finds by the keys of sensitivity.by. */
#ifndef ZP_STUDY_SENSITIVITY_H
#define ZP_STUDY_SENSITIVITY_H

#include <zipact/study.h>

#include "rest/slope.h"
#include "rest/slow.h"

/* Check sensitivity.by: real keys, each once, whose derivatives there are. ZP_BAD_INPUT names the key. */
ZpStatus zp_check_sensitivity(const ZpActuatorDef *def, ZpError *err);

/* The keys that sensitivity.by names => key [ZP_MAX_SENSITIVITY_KEYS], and how many. ZP_BAD_INPUT as above. */
ZpStatus zp_sensitivity_keys(const ZpActuatorDef *def, int *key, int *keys, ZpError *err);

/* A study that differentiates nothing notes that it was asked to. */
void zp_note_no_sensitivity(ZpResult *result, const ZpActuatorDef *def);

/* Call `derive` for each key of sensitivity.by, with derivatives of states of `rest` by it prepared. */
ZpStatus zp_sensitivity_of(ZpRest *rest, void (*derive)(void *user, ZpSlope *slope, ZpResult *result), void *user,
                           ZpResult *result, ZpError *err);

enum { ZP_MOST_LIMITS = 4 };

/* One limit by name; and the state that hangs without voltage, which says when an actuator is closed. */
typedef struct ZpNamedLimit {
  const char *output;
  const ZpLimit *limit;
  bool is_load; /* the limit is a load at drive.voltage, else a voltage */
} ZpNamedLimit;

typedef struct ZpLimitList {
  ZpSlow *slow;
  const double *hanging; /* its state */
  const double *hung;    /* the one under the largest load; NULL: that is not asked for */
  ZpNamedLimit item[ZP_MOST_LIMITS];
  size_t count;
} ZpLimitList;

/* Add the derivatives of these limits, an entry each: a `derive` of which `user` is a ZpLimitList. The present point is
 * then another. */
void zp_derive_limits(void *user, ZpSlope *slope, ZpResult *result);

#endif
