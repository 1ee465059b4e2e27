/* Where the table is in the text of an instrument's file: lines before the names of its columns, a line of units below
 * them, lines after the numbers. */
#ifndef ZP_IO_LAYOUT_H
#define ZP_IO_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>

/* Lines are counted from 0. */
typedef struct ZpLayout {
  char separator; /* semicolon, tab or comma */
  size_t columns; /* that have a name and numbers */
  size_t width;   /* cells of a row, of which those beyond the columns are empty or have no name */
  size_t names;   /* the line of names */
  bool units;     /* the next line has units */
  size_t first;   /* first row of numbers, */
  size_t end;     /* and the line after the last one */
} ZpLayout;

/* The largest table among lines without their ends: names, below them rows of as many cells, the first one with two
 * numbers, each with one. A file without such a table begins with its names. */
ZpLayout zp_layout_find(char *const *line, size_t lines);

/* End of the cell that starts at `text`: its separator or the end of the line; NULL if a quote is not closed. */
char *zp_cell_end(char *text, char separator);

/* Number of cells of a line, 0 if a quote is not closed. */
size_t zp_cells_count(char *line, char separator);

/* Next cell of a line, without blanks and quotes, in place; NULL as the line ends. */
char *zp_cell_next(char **line, char separator);

/* A copy of a number with a decimal point, at most `size` with its end. `grouped`: the character between groups of
 * three digits, 0: none. A decimal comma counts where the separator is none. False if the cell is no number. */
bool zp_cell_number(const char *cell, char separator, char grouped, char *copy, size_t size);

/* The unit of a cell such as "(mm)", "[mm]" or "mm", in place; NULL if it is none. */
char *zp_cell_unit(char *cell);

/* Is this a unit of a quantity that a bench has? */
bool zp_is_unit(const char *text);

#endif
