/* Electric forces that are held between refreshes: what a solved field has beyond plates, and the attraction on the
 * paper's Bezier surface where electro.refresh_period says so. */
#ifndef ZP_SYSTEM_CACHED_FIELD_H
#define ZP_SYSTEM_CACHED_FIELD_H

#include "actuator/eval.h"
#include "base/end.h"

/* Should it be recomputed at this state? What a solved field has beyond plates is due when a gap with its insulators,
 * or the one where breakdown sets in, has changed by more than electro.refresh_change. */
bool zp_cached_field_due(const ZpModel *model, const ZpState *state);

/* Is it due for the sake of a voltage that has just become another? */
bool zp_cached_field_outdated(const ZpModel *model, const ZpState *state);

/* Recompute it, into the state. ZP_END_STOP where the field cannot be solved: the state is then as it was, the refresh
 * still due. */
ZpEnd zp_cached_field_refresh(const ZpModel *model, ZpState *state, ZpEval *eval);

#endif
