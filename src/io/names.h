/* Names of members, bodies and springs in a scenario: a path with a name, members.left.ribbon.thickness, stands for the
 * key with the number that the name has, member_1.ribbon.thickness. */
#ifndef ZP_IO_NAMES_H
#define ZP_IO_NAMES_H

#include <zipact/io.h>

#include "def/check.h"

enum { ZP_PATH_SIZE = ZP_SCENARIO_KEY_SIZE }; /* bytes of a key with a name, with the final 0 */

typedef struct ZpGivenNames {
  ZpGivenName *name;
  size_t count;
} ZpGivenNames;

/* A copy, to be freed by zp_names_free; false if there is no memory. */
bool zp_names_copy(const ZpGivenNames *from, ZpGivenNames *names);
void zp_names_free(ZpGivenNames *names);

/* A path as a text writes it => as keys are called. A name that is not known gets the next number. ZP_BAD_INPUT: it is
 * none, or it belongs to another group. */
ZpStatus zp_names_path(ZpGivenNames *names, const char *path, char *text, size_t size, ZpError *err);

/* The member, body or port that the value of a key names => its number, 0 of the frame, as above. Else a value of that
 * key. `known`: the name must be, unless it is that of a port. */
ZpStatus zp_names_value(ZpGivenNames *names, bool known, int key, const char *word, double *number, ZpError *err);

/* A text in which keys are named => with numbers in the place of names, to be freed; NULL: there is no memory. */
char *zp_names_text(ZpGivenNames *names, const char *text);

/* "members" and the like. */
const char *zp_names_plural(ZpInstanceKind kind);

/* The group of a path of one name or less: "members", "bodies", "springs"; ZP_CALLED_KINDS: it is none. */
ZpInstanceKind zp_names_group(const char *path);

/* The name of a key, with the name of its member, body or spring, if that has one. */
const char *zp_names_key(const ZpGivenNames *names, int key, char text[ZP_PATH_SIZE]);

/* Put names in the place of numbers in a message: members.left for member_1. */
void zp_names_tell(const ZpGivenNames *names, ZpError *err);

/* The name that the value of a key stands for, or the value as a word. */
const char *zp_names_word(const ZpGivenNames *names, int key, double number, char text[ZP_NAME_SIZE]);

/* Give them to a Def. */
ZpStatus zp_names_give(const ZpGivenNames *names, ZpActuatorDef *def, ZpError *err);

#endif
