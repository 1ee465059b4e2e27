/* JSON, written member by member. Errors of the stream show at the end. */
#ifndef ZP_IO_JSON_H
#define ZP_IO_JSON_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/error.h>

typedef struct ZpJson {
  FILE *file;
  bool flat;  /* all on one line */
  bool terse; /* exponents without a plus sign and leading zeros: 1e-5 */
  int depth;
  bool begun; /* the innermost object or list has a member */
} ZpJson;

/* Each function takes the name of the member; NULL in a list and at the root. Names need no escapes. */

/* Open an object, '{', or a list, '['; close it by '}' or ']'. */
void zp_json_open(ZpJson *json, const char *name, char bracket);
void zp_json_close(ZpJson *json, char bracket);

/* A real number, with the shortest decimal that reads back to the same bits; a whole number for the unit "count"; null
 * for NAN and infinity. */
void zp_json_number(ZpJson *json, const char *name, double value, const char *unit);

/* A string; null for NULL. Bytes that are no text become question marks. */
void zp_json_text(ZpJson *json, const char *name, const char *text);

void zp_json_bool(ZpJson *json, const char *name, bool value);

/* End the line and bring everything to the stream. ZP_MACHINE: `what` could not be written. */
ZpStatus zp_json_end(ZpJson *json, const char *what, ZpError *err);

#endif
