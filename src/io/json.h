/* JSON of summaries: trees built with jansson, printed for people and programs. */
#ifndef ZP_IO_JSON_H
#define ZP_IO_JSON_H

#include <jansson.h>

#include <stdbool.h>

#include <zipact/error.h>

/* Put a member into an object, or an item into a list, which takes ownership of it. If there is no memory for one of
 * them, both are freed and the object or list becomes NULL: so a tree that is not NULL is complete. */
void zp_json_set(json_t **object, const char *name, json_t *value);
void zp_json_add(json_t **list, json_t *value);

/* A failure of another kind: free the tree, which becomes NULL. */
void zp_json_drop(json_t **tree);

/* A real number, an integer for the unit "count", null for NAN and infinity. */
json_t *zp_json_number(double value, const char *unit);

/* Creates item `index` of a list; NULL if there is no memory. */
typedef json_t *(*ZpJsonItem)(const void *user, size_t index);

/* Write the object `head` as zp_json_write does, with an additional last member `name`: a list of `count` items, of
 * which only one is in memory at a time. */
ZpStatus zp_json_write_list(json_t *head, const char *name, size_t count, ZpJsonItem item, const void *user, FILE *file,
                            ZpError *err);

/* Write the tree in lines or as a single line, with the shortest decimals that read back to the same bits (jansson
 * writes all 17 digits of 0.075). ZP_MACHINE if the file could not be written. */
ZpStatus zp_json_write(json_t *tree, bool flat, FILE *file, ZpError *err);

#endif
