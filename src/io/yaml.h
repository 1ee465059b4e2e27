/* The part of YAML in scenarios: nested mappings, words, lists of words. */
#ifndef ZP_IO_YAML_H
#define ZP_IO_YAML_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include <zipact/error.h>

#include "io/source.h"

/* Largest text that is accepted, bytes. Scenarios that we write are always smaller. */
enum { ZP_YAML_LARGEST = 1 << 20 };

typedef enum ZpYamlKind {
  ZP_YAML_VALUE, /* one word */
  ZP_YAML_LIST,  /* a sequence of words */
  ZP_YAML_GROUP  /* a mapping, reported at its end: after its content */
} ZpYamlKind;

/* An item of a text. */
typedef struct ZpYamlItem {
  ZpYamlKind kind;
  const char *path; /* keys from the root, separated by points: "ribbon.length"; "" at the root */
  int line;         /* line of its key, from 1 */
  const char *word; /* `count` words, each followed by a 0 */
  size_t count;
} ZpYamlItem;

/* Takes an item; a status other than ZP_OK ends the reading. */
typedef ZpStatus (*ZpYamlVisit)(void *user, const ZpYamlItem *item, ZpError *err);

/* Visit all items of a text that is a mapping or empty, with `is_value` of one that is one word or one list.
 * ZP_BAD_INPUT gives the place where it is not YAML, or uses YAML that a scenario does not need. */
ZpStatus zp_yaml_read(const ZpSource *source, const char *text, size_t size, bool is_value, ZpYamlVisit visit,
                      void *user, ZpError *err);

/* Write the start of a line for the key `name`, "  length: ", and before it "ribbon:" where `before`, the
 * key written last or NULL, is of another group. Returns the width of what is on the line. */
int zp_yaml_write_key(FILE *file, const char *name, const char *before);

/* Write `text`, which has no control characters, between double quotes. */
void zp_yaml_write_text(FILE *file, const char *text);

#endif
