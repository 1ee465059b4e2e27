/* Derivatives of what a study finds by the keys of sensitivity.by. */
#ifndef ZP_STUDY_SENSITIVITY_H
#define ZP_STUDY_SENSITIVITY_H

#include "study/result.h"

#include "rest/limits.h"
#include "rest/sensitivity.h"
#include "study/estimate.h"

/* Check sensitivity.by: real keys, each once, whose derivatives there are. ZP_BAD_INPUT names the key. */
ZpStatus zp_check_sensitivity(const ZpActuatorDef *def, ZpError *err);

/* The keys that sensitivity.by names => key [ZP_MAX_SENSITIVITY_KEYS], and how many. ZP_BAD_INPUT as above. */
ZpStatus zp_sensitivity_keys(const ZpActuatorDef *def, int *key, int *keys, ZpError *err);

/* A study that differentiates nothing notes that it was asked to. */
void zp_note_no_sensitivity(ZpResult *result, const ZpActuatorDef *def);

/* Adds the derivatives by a key. */
typedef void ZpDerive(void *user, ZpRestSensitivity *slope, ZpResult *result);

/* For each key of sensitivity.by, which has been checked, call `derive` with derivatives of states of `rest` prepared.
 */
ZpStatus zp_sensitivity_of(ZpRest *rest, ZpDerive *derive, void *user, ZpResult *result, ZpError *err);

/* Add limits as numbers of a result, in this order. Say in its message what they are, with or without the largest load.
 * Add their derivatives by a key, an entry each; the present point is then another. */
void zp_add_limits(const ZpLimits *limits, const ZpLimitKind order[], size_t count, ZpResult *result);
void zp_describe_limits(const ZpStatics *statics, const ZpLimits *limits, bool load, ZpResult *result);
void zp_derive_limits(ZpRest *rest, const ZpLimits *limits, const ZpLimitKind order[], size_t count,
                      ZpRestSensitivity *slope, ZpResult *result);

/* Add the estimated errors of limits by another mesh. */
void zp_estimate_limits(ZpRest *rest, const ZpLimits *limits, const ZpLimitKind order[], size_t count,
                        const ZpOtherMesh *other);

#endif
