/* The values of keys of members, bodies, springs and joints in a Def: def/check.h has what others may know of them. */
#ifndef ZP_DEF_INSTANCES_H
#define ZP_DEF_INSTANCES_H

#include "def/check.h"

/* The value of such a key, its default where it is not given. Set it, or take it away by NAN; ZP_MACHINE: there is no
 * memory. */
double zp_instances_get(const ZpActuatorDef *def, int index);
ZpStatus zp_instances_set(ZpActuatorDef *def, int index, double value, ZpError *err);

/* Take the keys of these rows away from a member. */
ZpStatus zp_instances_take_away(ZpActuatorDef *def, int member, int first, int last, ZpError *err);

/* Of each row => whether a key is given. */
void zp_instances_find_set(const ZpActuatorDef *def, bool set[ZP_KEYS]);

/* The place in def->given of the first value whose key is `index` or a later one; their number: there is none. */
size_t zp_instances_from(const ZpActuatorDef *def, int index);

#endif
