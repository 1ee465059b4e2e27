/* A table of measurements from a CSV file. */
#ifndef ZP_IO_DATA_H
#define ZP_IO_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* CSV files as read: a row of names, then rows of cells. Empty lines and lines that start with # do not count. Cells
 * are separated by semicolons, tabs or commas, whichever the row of names has; where it is no comma, numbers may have a
 * decimal comma. Cells may be quoted. A name "Load (g)" or "Load [g]" becomes "Load_g". */
typedef struct ZpData {
  const char *key;  /* that names the file, for messages */
  const char *path; /* the file */
  size_t columns, rows;
  char separator;
  char **cell; /* [1 + rows][columns]; row 0 has the names */
  int *line;   /* [1 + rows] from 1 */
  char *text;  /* into which cells point */
} ZpData;

/* Several of them. */
typedef struct ZpDataFiles {
  ZpData *file; /* [count] */
  size_t count;
  char *paths, *renamed; /* texts into which paths and names point */
} ZpDataFiles;

/* (key that names the file, its path; both must outlive the data) => data, to be destroyed whatever the status. */
ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err);
void zp_data_destroy(ZpData *data);

/* The same of files whose paths are separated by semicolons. `renamed`, of key data.columns: "their name = our name;
 * ..."; each renames a column in all files that have it. To be destroyed whatever the status. */
ZpStatus zp_data_read_all(const char *key, const char *paths, const char *renamed, ZpDataFiles *files, ZpError *err);
void zp_data_files_destroy(ZpDataFiles *files);

/* Place of the column called `name`, in any form that a file may have; -1 if there is none. */
int zp_data_column(const ZpData *data, const char *name);

/* The line of a row (from 0) in its file. */
int zp_data_line(const ZpData *data, size_t row);

/* The number in a row (from 0) of a column. ZP_BAD_INPUT if there is text. */
ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err);

/* If the header `name` is `stem`, in any case of its letters, or `stem` and a unit, "stroke_mm": true and the factor
 * that makes it SI, as number / divisor where that is exact. False if it is another stem, or the unit is none of
 * `unit`. */
bool zp_data_unit(const char *name, const char *stem, const char *unit, double *factor, double *divisor);

#endif
