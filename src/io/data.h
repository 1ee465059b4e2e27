/* A table of measurements from a CSV file. */
#ifndef ZP_IO_DATA_H
#define ZP_IO_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* A CSV file as read: a header row with names, then rows of cells. Empty lines and lines that start with # do not
 * count. */
typedef struct ZpData {
  const char *key; /* that names the file, for messages */
  const char *path;
  size_t columns, rows;
  char *text;  /* the file, cut into cells */
  char **cell; /* [1 + rows][columns]; row 0 has the names */
  int *line;   /* [1 + rows] from 1 */
} ZpData;

/* (key that names the file, its path; both must outlive the data) => data, to be destroyed whatever the status. */
ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err);
void zp_data_destroy(ZpData *data);

/* Place of the column called `name`, -1 if there is none. */
int zp_data_column(const ZpData *data, const char *name);

/* The number in a row (from 0) of a column. ZP_BAD_INPUT if there is text. */
ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err);

/* If the header `name` is `stem` or `stem` and a unit, "stroke_mm": true and the factor that makes it SI, as
 * number / divisor where that is exact. False if it is another stem, or the unit is none of `unit`. */
bool zp_data_unit(const char *name, const char *stem, const char *unit, double *factor, double *divisor);

#endif
