/* JSON of summaries, written as it comes: in lines, or as a single line. Numbers have the shortest decimals that read
 * back to the same bits. */
#ifndef ZP_IO_JSON_H
#define ZP_IO_JSON_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/error.h>

typedef struct ZpJson {
  FILE *file;
  bool flat;  /* a single line */
  int depth;  /* of open objects and lists */
  bool begun; /* the one that was opened last has a member */
  bool bad;   /* there was no memory for a text */
} ZpJson;

/* Begin and end an object, '{' and '}', or a list, '[' and ']'. `name`: of the member, without anything to escape; NULL
 * for an item of a list and for the whole. */
void zp_json_open(ZpJson *json, const char *name, char bracket);
void zp_json_close(ZpJson *json, char bracket);

/* A real number, an integer for the unit "count", null for NAN and infinity. */
void zp_json_number(ZpJson *json, const char *name, double value, const char *unit);

/* A text; null for NULL. */
void zp_json_text(ZpJson *json, const char *name, const char *text);
void zp_json_bool(ZpJson *json, const char *name, bool value);

/* The value of a key: a number, a word, true or false. */
void zp_json_key(ZpJson *json, const char *name, int key, double value);

/* End the last line. ZP_MACHINE if something could not be written. */
ZpStatus zp_json_finish(ZpJson *json, ZpError *err);

#endif
