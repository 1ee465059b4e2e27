/* The inside of tables and sequences of shapes, which only the library and its tests see. */
#ifndef ZP_BASE_TABLE_H
#define ZP_BASE_TABLE_H

#include <zipact/table.h>

/* A table: rows of `columns` doubles, row after row. NAN stands for a value that does not exist. */
struct ZpTable {
  const ZpColumn *column; /* [columns] a copy of what it was created with */
  size_t columns;
  size_t rows;     /* filled */
  size_t capacity; /* rows at most */
  size_t stride;   /* one in `stride` offered rows is kept */
  size_t offered;  /* rows offered so far */
  double *value;   /* [capacity][columns] */
};

enum { ZP_MEMBER_TEXT = 32 }; /* bytes of a name or number of a member, with the final 0 */

/* Columns of a table, once or for each of several members. */
typedef struct ZpColumnPart {
  const ZpColumn *column;
  size_t count, members; /* of each member 1 .. members, with its number or name in the place of # in name and help; 0:
                            once */
  const char *(*name)(const void *of, size_t member, char text[ZP_MEMBER_TEXT]); /* NULL: numbers */
  const void *of;
} ZpColumnPart;

/* A table of the columns of all parts, else as zp_table_create. */
ZpTable *zp_table_of(const ZpColumnPart *part, size_t parts, size_t capacity);

/* The pattern with a name in the place of each #; as it is if that is NULL => bytes, the final 0 included. They are
 * only counted where `text` is NULL. */
size_t zp_named(const char *pattern, const char *name, char *text);

/* A sequence of shapes of one actuator. */
struct ZpShapes {
  size_t ribbons;  /* 1 or 2 */
  size_t nodes;    /* per ribbon; of a series, of all its members, the uppermost first */
  size_t frames;   /* filled */
  size_t capacity; /* frames at most */
  size_t stride;   /* as in ZpTable */
  size_t offered;
  size_t frame_size; /* doubles per frame */
  bool facing;       /* the shapes have gap, line_force and insulator_field */
  bool stressed;     /* the shapes have stress */
  double *value;     /* [capacity][frame_size] */
  size_t members;    /* of a series; otherwise 1 */
};

/* Shapes of one ribbon, with its gap to a line where x (axis 0) or y (1) is 0 => those of two, of which the first one
 * is its mirror image; NULL if there is no memory. */
ZpShapes *zp_shapes_mirrored(const ZpShapes *half, size_t axis);

#endif
