/* Trees of JSON, and the table of keys as a JSON schema. */
#ifndef ZP_IO_SCHEMA_H
#define ZP_IO_SCHEMA_H

#include <jansson.h>

/* Put a member into an object, or an item into a list, which takes ownership of it. If there is no memory for one of
 * them, both are freed and the object or list becomes NULL: so a tree that is not NULL is complete. */
void zp_json_set(json_t **object, const char *name, json_t *value);
void zp_json_add(json_t **list, json_t *value);

/* A JSON schema (draft 7) of scenarios => the caller's; NULL if there is no memory. */
json_t *zp_schema_make(void);

#endif
