/* Purposes of keys beyond the description of an actuator. */
#ifndef ZP_DEF_PURPOSE_H
#define ZP_DEF_PURPOSE_H

#include "def/def.h"

typedef enum ZpPurpose {
  ZP_NO_PARAMETER = 1, /* of an FMU: its inputs or its tool replace the key, or other studies use it */
  ZP_MAY_CHANGE = 2,   /* between a run and the one that resumes from its checkpoint */
  ZP_NO_RESULT = 4     /* has no influence on the result of a case */
} ZpPurpose;

/* All purposes of key `index`, added. No names are compared. */
unsigned zp_key_purposes(int index);

#endif
