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

#endif
