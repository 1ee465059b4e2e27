/* The values of members' keys in a Def: def/check.h has what others may know of them. */
#ifndef ZP_DEF_MEMBER_KEYS_H
#define ZP_DEF_MEMBER_KEYS_H

#include "def/check.h"

/* The value of a member's key; NAN: auto. Set it; ZP_MACHINE: there is no memory. */
double zp_member_keys_get(const ZpActuatorDef *def, int index);
ZpStatus zp_member_keys_set(ZpActuatorDef *def, int index, double value, ZpError *err);

/* The place in def->members of the first value whose key is `index` or a later one; their number: there is none. */
size_t zp_member_keys_from(const ZpActuatorDef *def, int index);

#endif
