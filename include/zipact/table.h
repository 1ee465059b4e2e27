/* Results: a table of numbers with named columns, and a sequence of shapes.
 *
 * Both have a bounded size: when they are full, every second row is dropped, and from then on only every second,
 * fourth, ... offered row is kept. The first row stays; zp_table_keep_last keeps the last one.
 */
#ifndef ZIPACT_TABLE_H
#define ZIPACT_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A column of a table. The table copies name and help; `unit` must outlive it. */
typedef struct ZpColumn {
  const char *name; /* with its unit, "stroke_m" */
  const char *unit; /* "m"; "1" for a pure number */
  const char *help; /* one line */
} ZpColumn;

/* A table: rows of numbers, one per column. NAN stands for a value that does not exist. */
typedef struct ZpTable ZpTable;

/* A new empty table of at most `capacity` rows (2 or more), or NULL if there is no memory. */
ZP_API ZpTable *zp_table_create(const ZpColumn *column, size_t columns, size_t capacity);
ZP_API void zp_table_destroy(ZpTable *table);

/* Offer a row of zp_table_columns values; true if it was kept. */
ZP_API bool zp_table_offer(ZpTable *table, const double *row);

/* Make `row` the last row, even if thinning would drop it; do nothing if it is already the last row (same value in
 * column 0). In a full table it replaces the last row. */
ZP_API void zp_table_keep_last(ZpTable *table, const double *row);

/* Value in row `row` of the column called `name`; NAN if there is none. */
ZP_API double zp_table_get(const ZpTable *table, size_t row, const char *name);

/* Numbers of rows and of columns. */
ZP_API size_t zp_table_rows(const ZpTable *table);
ZP_API size_t zp_table_columns(const ZpTable *table);

/* Column `column`; NULL from zp_table_columns on. */
ZP_API const ZpColumn *zp_table_column(const ZpTable *table, size_t column);

/* Row `row`: zp_table_columns numbers, valid until the table changes. Rows follow each other in memory. NULL if there
 * is no such row. */
ZP_API const double *zp_table_row(const ZpTable *table, size_t row);

/* One shape: values at every node. Station i of ribbon r is at [i * ribbons + r]; ribbon 0 is the upper one (kind
 * ribbon: the only one). Positions are those of the insulators' faces, m: x to the right from the clip of the straight
 * actuator, y upwards from the upper platform (kind ribbon: from the clamp). */
typedef struct ZpShape {
  double time;              /* s */
  double voltage;           /* V */
  size_t zipped;            /* pairs 0 .. zipped are closed (the clip is pair 0) */
  const double *x;          /* [nodes * ribbons] m */
  const double *y;          /* [nodes * ribbons] m */
  const double *gap;        /* [nodes] m, distance between the faces; NULL for the kind ribbon */
  const double *line_force; /* [nodes] N/m, attraction per length; NULL for the kind ribbon */
  const double
      *insulator_field; /* [nodes] V/m, by the series law, 0 or more; NULL for the kind ribbon; NAN: no insulator */
  const double
      *stress; /* [nodes * ribbons] Pa, largest in the section of the metal, 0 or more; NULL if it is not known */
} ZpShape;

/* A sequence of shapes of one actuator. */
typedef struct ZpShapes ZpShapes;

/* A new empty sequence of at most `capacity` frames (2 or more), or NULL if there is no memory. */
ZP_API ZpShapes *zp_shapes_create(size_t ribbons, size_t nodes, size_t capacity);
ZP_API void zp_shapes_destroy(ZpShapes *shapes);

/* Offer a shape; true if it was kept (copied). */
ZP_API bool zp_shapes_offer(ZpShapes *shapes, const ZpShape *shape);

/* As zp_table_keep_last; equal times mean the same shape. */
ZP_API void zp_shapes_keep_last(ZpShapes *shapes, const ZpShape *shape);

/* Frame `frame` of the sequence; its pointers are valid until the sequence changes. */
ZP_API ZpShape zp_shapes_get(const ZpShapes *shapes, size_t frame);

/* Numbers of frames; of ribbons, 1 or 2; of nodes per ribbon, of a series those of all its members, the uppermost
 * first; of members of a series, otherwise 1. */
ZP_API size_t zp_shapes_frames(const ZpShapes *shapes);
ZP_API size_t zp_shapes_ribbons(const ZpShapes *shapes);
ZP_API size_t zp_shapes_nodes(const ZpShapes *shapes);
ZP_API size_t zp_shapes_members(const ZpShapes *shapes);

/* Distance in memory, in doubles, between a number of one frame and the same number of the next. */
ZP_API size_t zp_shapes_stride(const ZpShapes *shapes);

#ifdef __cplusplus
}
#endif

#endif
