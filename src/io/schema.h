/* The table of keys as a JSON schema. */
#ifndef ZP_IO_SCHEMA_H
#define ZP_IO_SCHEMA_H

#include <jansson.h>

/* A JSON schema (draft 7) of scenarios => the caller's; NULL if there is no memory. */
json_t *zp_schema_make(void);

#endif
