#include "io/layout.h"

#include <stdio.h>
#include <string.h>

#include "io/range.h"
#include "io/units.h"

enum { LONGEST_CELL = 200, LONGEST_UNIT = 24 };

static const char separators[] = ";\t,";

/* -- cells ------------------------------------------------------------------------------------------ */

char *zp_cell_end(char *text, char separator) {
  bool quoted = false;
  for (; *text && (quoted || *text != separator); text++)
    quoted ^= *text == '"';
  return quoted ? NULL : text;
}

size_t zp_cells_count(char *line, char separator) {
  size_t count = 1;
  for (char *end = zp_cell_end(line, separator); !end || *end; end = zp_cell_end(end + 1, separator), count++)
    if (!end) return 0;
  return count;
}

/* "a ""b""" => a "b", in place. */
static char *unquote(char *cell) {
  size_t length = strlen(cell), used = 0;
  if (length < 2 || cell[0] != '"' || cell[length - 1] != '"') return cell;
  for (size_t i = 1; i + 1 < length; i++) {
    cell[used++] = cell[i];
    i += cell[i] == '"' && cell[i + 1] == '"' && i + 2 < length;
  }
  cell[used] = 0;
  return zp_trim(cell);
}

char *zp_cell_next(char **line, char separator) {
  char *cell = *line, *end = zp_cell_end(cell, separator);
  *line = *end ? end + 1 : NULL;
  *end = 0;
  return unquote(zp_trim(cell));
}

/* -- numbers ---------------------------------------------------------------------------------------- */

/* Take the characters between groups of three digits out, in place; false if one stands elsewhere. */
static bool ungroup(char *number, char grouped) {
  char *to = number;
  const char *point = number + strcspn(number, grouped == '.' ? ",eE" : ".eE");
  for (const char *c = number; *c; c++) {
    if (*c != grouped) {
      *to++ = *c;
      continue;
    }
    if (c > point || c == number || strspn(c + 1, "0123456789") != 3) return false;
  }
  *to = 0;
  return true;
}

bool zp_cell_number(const char *cell, char separator, char grouped, char *copy, size_t size) {
  const size_t length = strlen(cell);
  if (length == 0 || length >= size) return false;
  snprintf(copy, size, "%s", cell);
  if (grouped && !ungroup(copy, grouped)) return false;
  char *comma = separator != ',' && !strchr(copy, '.') ? strchr(copy, ',') : NULL;
  if (comma) *comma = '.';
  return strspn(copy, "+-.0123456789eE") == strlen(copy) && strpbrk(copy, "0123456789");
}

static bool is_number(const char *cell, char separator) {
  char copy[LONGEST_CELL];
  static const char groups[] = {0, '.', ',', '\'', ' '};
  for (size_t i = 0; i < sizeof groups; i++)
    if (zp_cell_number(cell, separator, groups[i], copy, sizeof copy)) return true;
  return strchr(cell, ':') && strspn(cell, "0123456789:.,") == strlen(cell); /* a time of day */
}

/* -- units ------------------------------------------------------------------------------------------ */

bool zp_is_unit(const char *text) {
  static const char *const of[] = {"s",   "m", "V",    "kg",   "N",     "F",   "A",   "Hz",  "Pa",
                                   "rad", "1", "m2/s", "Pa s", "kg/m3", "N/m", "V/m", "1/m", "m3"};
  static const char *const others[] = {"%", "C", "K", "\302\260C", "\302\260"};
  ZpUnitScale scale;
  for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
    if (strcmp(text, others[i]) == 0) return true;
  if (!*text || strlen(text) > LONGEST_UNIT) return false;
  for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
    if (zp_unit_scale(text, of[i], &scale, NULL) == ZP_OK) return true;
  return false;
}

char *zp_cell_unit(char *cell) {
  static const char open[] = "([{<", close[] = ")]}>";
  const char *bracket = *cell ? strchr(open, *cell) : NULL;
  const size_t length = strlen(cell);
  if (bracket && length > 2 && cell[length - 1] == close[bracket - open]) {
    cell[length - 1] = 0;
    cell = zp_trim(cell + 1);
  }
  return zp_is_unit(cell) ? cell : NULL;
}

/* -- the table -------------------------------------------------------------------------------------- */

/* A copy of the next cell of a line, cut where it is too long to be a number or a unit; NULL follows the last one. */
static char *copy_cell(char **line, char separator, char copy[LONGEST_CELL]) {
  char *end = zp_cell_end(*line, separator);
  const size_t length = end ? (size_t)(end - *line) : strlen(*line);
  snprintf(copy, LONGEST_CELL, "%.*s", (int)(length < LONGEST_CELL ? length : LONGEST_CELL - 1), *line);
  *line = end && *end ? end + 1 : NULL;
  return unquote(zp_trim(copy));
}

/* How many cells a line has, those with a text, with a number, and empty ones at its end. */
typedef struct Cells {
  size_t count, filled, numbers, trailing;
} Cells;

static Cells cells_of(char *line, char separator) {
  Cells cells = {.count = zp_cells_count(line, separator)};
  char copy[LONGEST_CELL];
  while (line && cells.count > 1) {
    const char *cell = copy_cell(&line, separator, copy);
    cells.filled += *cell != 0;
    cells.numbers += is_number(cell, separator);
    cells.trailing = *cell ? 0 : cells.trailing + 1;
  }
  return cells;
}

/* Does a line have units and empty cells only? */
static bool has_units(char *line, char separator) {
  char copy[LONGEST_CELL];
  size_t units = 0, others = 0;
  while (line) {
    char *cell = copy_cell(&line, separator, copy);
    if (!*cell || strcmp(cell, "-") == 0) continue;
    if (zp_cell_unit(cell))
      units++;
    else
      others++;
  }
  return units > 0 && others == 0;
}

/* The table whose names are in this line; without rows if they are not. */
static ZpLayout table_at(char *const *line, size_t lines, size_t names, char separator) {
  ZpLayout table = {.separator = separator, .names = names, .first = names + 1, .end = names};
  const Cells head = cells_of(line[names], separator);
  if (head.filled < 2 || head.numbers > 0 || table.first == lines) return table;
  Cells next = cells_of(line[table.first], separator);
  table.units = next.numbers == 0 && table.first + 1 < lines && has_units(line[table.first], separator);
  if (table.units) next = cells_of(line[++table.first], separator);
  table.width = next.count;
  table.columns = next.count < head.count ? next.count : head.count;
  if (next.numbers < 2 || next.count - next.trailing > head.count) return table;
  table.end = table.first;
  for (; table.end < lines; table.end++) {
    const Cells row = cells_of(line[table.end], separator);
    if (row.count != table.width || row.numbers == 0) break;
  }
  return table;
}

/* The separator of a line: semicolon, tab or comma, the first of these that it has outside of quotes. */
static char separator_of(char *line) {
  for (const char *c = separators; *c; c++) {
    char *end = zp_cell_end(line, *c);
    if (end && *end) return *c;
  }
  return ',';
}

/* Lines that are not of the table: none has as many cells, or a number in one of several. */
static bool is_foot(char *const *line, size_t from, size_t lines, const ZpLayout *table) {
  for (; from < lines; from++) {
    const Cells cells = cells_of(line[from], table->separator);
    if (cells.count == table->width || cells.numbers > 0) return false;
  }
  return true;
}

ZpLayout zp_layout_find(char *const *line, size_t lines) {
  ZpLayout best = {.separator = separator_of(line[0]), .first = 1};
  size_t most = 0;
  best.columns = best.width = zp_cells_count(line[0], best.separator);
  for (const char *separator = separators; *separator; separator++)
    for (size_t names = 0; names < lines;) {
      const ZpLayout table = table_at(line, lines, names, *separator);
      const size_t rows = table.end > table.first ? table.end - table.first : 0;
      if (rows > most) most = rows, best = table;
      names = rows > 0 ? table.end : names + 1;
    }
  if (most == 0 || !is_foot(line, best.end, lines, &best)) best.end = lines;
  return best;
}
