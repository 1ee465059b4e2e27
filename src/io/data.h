/* A table of measurements from a CSV file. */
#ifndef ZP_IO_DATA_H
#define ZP_IO_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include "io/units.h"

/* CSV files as read: a row of names, then rows of cells. Empty lines and lines that start with # are ignored, as are
 * lines of an instrument before the names and after the numbers. The separator is semicolon, tab or comma; if it is not
 * a comma, numbers may have a decimal comma, and points between thousands. Cells may be quoted. A name "Load (g)",
 * "Load [g]", "Load/g", "Load, g" or "Load in g" becomes "Load_g", "pull-in_voltage_V" pull_in_voltage_V; a row of
 * units below the names gives each name its unit. */
typedef struct ZpData {
  const char *key;  /* key that names the file, for messages */
  const char *path; /* path of the file */
  size_t columns, rows;
  char separator;
  char grouped;         /* between thousands; 0: nothing */
  bool units;           /* a line of units follows the names */
  char **cell;          /* [1 + rows][columns]; row 0 has the names */
  char **name;          /* [columns] the names as the file has them */
  int *line;            /* [1 + rows] from 1 */
  char *text;           /* text to which the cells point */
  char *names;          /* text to which the names as in the file point, */
  char *plain;          /* and text of those with units of a line of their own */
  size_t before, after; /* lines with text that do not belong to the table */
} ZpData;

/* Several of them. */
typedef struct ZpDataFiles {
  ZpData *file; /* [count] */
  size_t count;
  char *paths, *renamed; /* texts to which paths and names point */
} ZpDataFiles;

/* (key that names the file, its path; both must outlive the data) => data, to be destroyed whatever the status is. */
ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err);
void zp_data_destroy(ZpData *data);

/* Read several files whose paths are separated by semicolons. `renamed`, the value of data.columns: "name in the file =
 * name in zipact; ..."; each renames a column in all files that have it. `measured`: they have measured values;
 * otherwise one column suffices, and no file needs to have a renamed one. To be destroyed whatever the status is. */
ZpStatus zp_data_read_all(const char *key, const char *paths, const char *renamed, bool measured, ZpDataFiles *files,
                          ZpError *err);
void zp_data_files_destroy(ZpDataFiles *files);

/* Number of the column called `name`, in any form that a file may have, or so in the file; -1 if there is none. */
int zp_data_column(const ZpData *data, const char *name);

/* The line number of a row (from 0) in its file. */
int zp_data_line(const ZpData *data, size_t row);

/* Lines of the file that are the table, "names in line 3, units in line 4, 250 rows from line 5"; empty if it begins
 * with its names, which have their units. */
void zp_data_describe(const ZpData *data, char *text, size_t size);

/* Are the numbers of a column times of day, such as 12:03:04.250? */
bool zp_data_is_clock(const ZpData *data, size_t column);

/* The number in a row (from 0) of a column; of a time of day the seconds since midnight. ZP_BAD_INPUT if the cell is
 * not a number. */
ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err);

/* Is the header `name` equal to `stem`, in any case of its letters, or to `stem` and a unit, as "stroke_mm"? Then the
 * scale that converts it to SI. False if the stem differs or the unit is not one of `unit`. */
bool zp_data_unit(const char *name, const char *stem, const char *unit, ZpUnitScale *scale);

/* The column whose header is `stem` and a unit of `unit` => value [rows], SI. ZP_BAD_INPUT if there is none, with an
 * `example` of its header, or a cell is not a number. */
ZpStatus zp_data_read_column(const ZpData *data, const char *stem, const char *unit, const char *example, double *value,
                             ZpError *err);

#endif
