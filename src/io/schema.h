/* The table of keys as a JSON schema. */
#ifndef ZP_IO_SCHEMA_H
#define ZP_IO_SCHEMA_H

#include "io/json.h"

/* Write a JSON schema (draft 7) of scenarios. */
void zp_schema_put(ZpJson *json);

#endif
