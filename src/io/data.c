/* CSV files, as written by spreadsheets of any country and by instruments: names in the first row, numbers below. A
 * cell is read only if its column is used, so columns of remarks are allowed. */
#include "io/data.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/fail.h"
#include "io/file.h"
#include "io/layout.h"
#include "io/number.h"
#include "io/range.h"
#include "io/source.h"
#include "io/units.h"

enum { LARGEST_FILE = 1 << 24 };

enum { LONGEST_NAME = 200, LONGEST_NUMBER = 64 };

void zp_data_destroy(ZpData *data) {
  free(data->text);
  free(data->names);
  free(data->plain);
  free(data->name);
  free(data->cell);
  free(data->line);
  *data = (ZpData){0};
}

void zp_data_files_destroy(ZpDataFiles *files) {
  for (size_t i = 0; i < files->count; i++)
    zp_data_destroy(&files->file[i]);
  free(files->file);
  free(files->paths);
  free(files->renamed);
  *files = (ZpDataFiles){0};
}

static ZpStatus read_text(const char *key, const char *path, char **text, ZpError *err) {
  size_t size;
  ZpError reason;
  ZpStatus status = zp_file_read(path, LARGEST_FILE, text, &size, &reason);
  if (status != ZP_OK)
    return zp_fail(err, status, "%s: %s%s", key, reason.message,
                   strchr(path, ',') ? "; several files are separated by semicolons" : "");
  if (size == LARGEST_FILE) return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: longer than 16 MB", key, path);
  if (size > 1 && (memcmp(*text, "\xFF\xFE", 2) == 0 || memcmp(*text, "\xFE\xFF", 2) == 0))
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: text in UTF-16; save it as CSV in UTF-8", key, path);
  if (strlen(*text) != size) return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: not a text file", key, path);
  return ZP_OK;
}

static size_t count_char(const char *text, char c) {
  size_t count = 0;
  for (; *text; text++)
    count += *text == c;
  return count;
}

/* -- names ------------------------------------------------------------------------------------------ */

/* The unit in a name, without what is around it, and the end of the name before it: of "Zip time (ms)", "Zip time
 * [ms]", "Zip time / ms", "Zip time in ms", "Time/ms", "Time, ms" and "Time ms". False if the name has no such unit. */
static bool find_unit(char *name, char **unit, char **end) {
  static const char *const before[] = {" / ", " in "};
  const size_t length = strlen(name);
  char *open = length > 1 && strchr(")]}>", name[length - 1]) ? name + length - 1 : name;
  while (open > name && !strchr("([{<", *open))
    open--;
  if (open > name) {
    name[length - 1] = 0;
    *unit = zp_trim(open + 1);
    *end = open;
    return true;
  }
  for (size_t i = 0; i < sizeof before / sizeof before[0]; i++) {
    char *found = strstr(name, before[i]);
    if (!found) continue;
    *unit = zp_trim(found + strlen(before[i]));
    *end = found;
    return true;
  }
  char *last = name + length;
  if (*end && zp_is_unit(*end + 1)) return false; /* "viscosity_mm2/s" */
  while (last > name && !strchr("/, ", last[-1]))
    last--;
  if (last <= name + 1 || !zp_is_unit(last)) return false;
  *unit = last;
  *end = last - 1;
  return true;
}

/* "Pull-in voltage (kV)" => Pull_in_voltage_kV, in place: not longer than before. */
static void plain_name(char *name) {
  char *unit = strrchr(name, '_'), *end = unit;
  const bool apart = find_unit(name, &unit, &end);
  if (!end) return;
  while (apart && end > name && strchr(" ,/:", end[-1]))
    end--;
  for (char *c = name; c < end; c++)
    if (*c == '-' || (apart && *c == ' ')) *c = '_';
  if (!apart) return;
  *end = 0;
  if (!*unit) return;
  *end = '_';
  memmove(end + 1, unit, strlen(unit) + 1);
}

/* Split a line into the cells of the next row. */
static ZpStatus take_line(ZpData *data, char *line, int number, size_t width, size_t *rows, ZpError *err) {
  ZpSource source = {.name = data->path};
  size_t cells = zp_cells_count(line, data->separator);
  if (cells == 0) return zp_source_fail(&source, number, err, "a quote is not closed");
  if (cells != width && *rows > 0)
    return zp_source_fail(&source, number, err, "%zu cells; the header has %zu", cells, data->columns);
  char **cell = data->cell + *rows * data->columns;
  for (size_t i = 0; i < data->columns; i++) {
    cell[i] = zp_cell_next(&line, data->separator);
    if (*rows == 0 && !data->units) plain_name(cell[i]);
  }
  data->line[(*rows)++] = number;
  return ZP_OK;
}

static bool counts(const char *line) {
  line += strspn(line, " \t");
  return *line && *line != '#';
}

/* Keep the names as they are: those in the cells become plain or are replaced. */
static ZpStatus keep_names(ZpData *data, const char *names, ZpError *err) {
  data->names = strdup(names);
  data->name = calloc(data->columns + 1, sizeof *data->name);
  if (!data->names || !data->name) return zp_fail_memory(err);
  char *rest = data->names, number[LONGEST_NUMBER];
  size_t numbers = 0;
  for (size_t i = 0; i < data->columns; i++) {
    data->name[i] = zp_cell_next(&rest, data->separator);
    numbers += zp_cell_number(data->name[i], data->separator, 0, number, sizeof number);
  }
  if (numbers == 0 || numbers < data->columns) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: the first row has numbers; it needs names with units, such as load_g",
                 data->key, data->path);
}

/* "Time", "(ms)" => Time_ms, of all columns. */
static ZpStatus join_units(ZpData *data, char *names, char *units, ZpError *err) {
  const size_t size = strlen(names) + strlen(units) + 2 * data->columns + 1;
  char *to = data->plain = malloc(size);
  if (!to) return zp_fail_memory(err);
  for (size_t i = 0; i < data->columns; i++) {
    const char *name = zp_cell_next(&names, data->separator), *unit = NULL;
    char *cell = units ? zp_cell_next(&units, data->separator) : NULL;
    if (cell && strcmp(cell, "-") != 0) unit = zp_cell_unit(cell);
    const int used = snprintf(to, size - (size_t)(to - data->plain), unit ? "%s_%s" : "%s", name, unit);
    for (char *c = to; *c; c++)
      if ((*c == '-' || *c == ' ') && c < to + strlen(name)) *c = '_';
    data->cell[i] = to;
    to += used + 1;
  }
  return ZP_OK;
}

/* Allocate the rows of a table. */
static ZpStatus open_rows(ZpData *data, const ZpLayout *table, char *const *line, ZpError *err) {
  data->separator = table->separator;
  data->columns = table->columns;
  data->units = table->units;
  if (data->columns > 1000)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: more than 1000 columns", data->key, data->path);
  data->cell = calloc((table->end - table->first + 2) * (data->columns + 1), sizeof *data->cell);
  data->line = calloc(table->end - table->first + 2, sizeof *data->line);
  return data->cell && data->line ? keep_names(data, line[table->names], err) : zp_fail_memory(err);
}

/* Take the names, with their units, and the rows. `number`: of each line, from 1. */
static ZpStatus take_table(ZpData *data, const ZpLayout *table, char *const *line, const int *number, ZpError *err) {
  size_t rows = 0;
  ZpStatus status = open_rows(data, table, line, err);
  if (status == ZP_OK && table->units) {
    status = join_units(data, line[table->names], line[table->names + 1], err);
    data->line[rows++] = number[table->names];
  } else if (status == ZP_OK) {
    status = take_line(data, line[table->names], number[table->names], table->width, &rows, err);
  }
  for (size_t i = table->first; i < table->end && status == ZP_OK; i++)
    status = take_line(data, line[i], number[i], table->width, &rows, err);
  if (status == ZP_OK) data->rows = rows - 1;
  return status;
}

/* A line without its end; blanks at its ends may be empty cells and stay. */
static char *take_end(char *start) {
  char *end = strchr(start, '\n');
  if (!end) return NULL;
  *end = 0;
  if (end > start && end[-1] == '\r') end[-1] = 0;
  return end + 1;
}

/* The lines of a text that count => line, number [how many]. */
static size_t cut(char *text, char **line, int *number) {
  char *start = text + (strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0); /* a byte order mark */
  size_t lines = 0;
  for (int k = 1; start; k++) {
    char *next = take_end(start);
    if (counts(start)) {
      line[lines] = start;
      number[lines++] = k;
    }
    start = next;
  }
  return lines;
}

/* Signs of groups: "1.234,5" and "1,234.5" tell which character is between thousands. If no number tells, points are,
 * if others have decimal commas and all points are followed by three digits. */
static char groups_of(const ZpData *data) {
  bool comma = false, point = false, all = true;
  char copy[LONGEST_NUMBER];
  for (size_t i = data->columns; i < (data->rows + 1) * data->columns; i++) {
    const char *cell = data->cell[i], *first = strpbrk(cell, ".,'");
    if (!first) continue;
    const char other = *first == '.' ? ',' : '.';
    const bool both = strchr(first, other) || (strchr(first + 1, *first) && *first != other);
    if (both && zp_cell_number(cell, data->separator, *first, copy, sizeof copy)) return *first;
    if (*first == '\'' && zp_cell_number(cell, data->separator, '\'', copy, sizeof copy)) return '\'';
    if (!zp_cell_number(cell, data->separator, 0, copy, sizeof copy)) continue;
    comma |= *first == ',';
    point |= *first == '.';
    all &= *first != '.' || zp_cell_number(cell, data->separator, '.', copy, sizeof copy);
  }
  return comma && point && all && data->separator != ',' ? '.' : 0;
}

static ZpStatus take_text(ZpData *data, char *text, ZpError *err) {
  const size_t most = count_char(text, '\n') + 1;
  char **line = calloc(most, sizeof *line);
  int *number = calloc(most, sizeof *number);
  ZpStatus status = line && number ? ZP_OK : zp_fail_memory(err);
  const size_t lines = status == ZP_OK ? cut(text, line, number) : 0;
  if (status == ZP_OK && lines == 0)
    status = zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: empty; needs a row of names and rows of numbers", data->key,
                     data->path);
  if (status == ZP_OK) {
    const ZpLayout table = zp_layout_find(line, lines);
    status = take_table(data, &table, line, number, err);
    data->before = table.names;
    data->after = lines - table.end;
    if (status == ZP_OK) data->grouped = groups_of(data);
  }
  free(line);
  free(number);
  return status;
}

void zp_data_describe(const ZpData *data, char *text, size_t size) {
  char units[48] = "";
  *text = 0;
  if (data->units) snprintf(units, sizeof units, "units in line %d, ", data->line[0] + 1);
  if (data->before > 0 || data->after > 0 || data->units)
    snprintf(text, size, "names in line %d, %s%zu rows in lines %d to %d", data->line[0], units, data->rows,
             data->line[1], data->line[data->rows]);
}

static bool has_only_numbers(const ZpData *data, size_t column) {
  char number[LONGEST_NUMBER];
  for (size_t row = 1; row <= data->rows; row++)
    if (!zp_cell_number(data->cell[row * data->columns + column], data->separator, data->grouped, number,
                        sizeof number))
      return false;
  return data->rows > 0;
}

/* Is it a table of numbers? A scenario may name any file, and messages quote names and cells: those of a table, and
 * never what a file is that was not made for zipact. */
static ZpStatus check_table(const ZpData *data, size_t least, ZpError *err) {
  if (data->columns < least)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%s: %.300s:%d: not a table: one column; commas, semicolons or tabs must separate the columns",
                   data->key, data->path, data->line[0]);
  for (size_t column = 0; column < data->columns; column++)
    if (has_only_numbers(data, column)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s: %.300s: not a table: below the row of names, no column has a number in each row", data->key,
                 data->path);
}

/* A table of at least so many columns. */
static ZpStatus read_table(const char *key, const char *path, size_t least, ZpData *data, ZpError *err) {
  *data = (ZpData){.key = key, .path = path};
  ZpStatus status = read_text(key, path, &data->text, err);
  if (status == ZP_OK) status = take_text(data, data->text, err);
  return status == ZP_OK ? check_table(data, least, err) : status;
}

ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err) {
  return read_table(key, path, 2, data, err);
}

/* -- names ------------------------------------------------------------------------------------------- */

/* Two names are equal if they differ only in the case of letters; the case of the unit counts. */
static int find_column(const ZpData *data, const char *plain) {
  for (size_t i = 0; i < data->columns; i++) {
    const char *name = data->cell[i], *unit = strrchr(name, '_');
    const size_t stem = unit ? (size_t)(unit - name) : strlen(name), length = strlen(plain);
    if (strncasecmp(name, plain, stem) == 0 && strcmp(name + stem, plain + (length < stem ? length : stem)) == 0)
      return (int)i;
  }
  return -1;
}

int zp_data_column(const ZpData *data, const char *name) {
  char plain[LONGEST_NAME];
  for (size_t i = 0; i < data->columns; i++)
    if (strcmp(data->name[i], name) == 0) return (int)i;
  snprintf(plain, sizeof plain, "%s", name);
  plain_name(plain);
  return find_column(data, plain);
}

/* -- several files ----------------------------------------------------------------------------------- */

static ZpStatus fail_renaming(const ZpDataFiles *files, const char *theirs, ZpError *err) {
  char names[LONGEST_NAME] = "";
  for (size_t i = 0; i < files->file->columns; i++) {
    const size_t used = strlen(names);
    snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", files->file->cell[i]);
  }
  return zp_fail(err, ZP_BAD_INPUT, "data.columns: %.80s: no such column in %s%.200s, which has %s", theirs,
                 files->count > 1 ? "any file; the first is " : "", files->file->path, names);
}

/* The column whose name, without its unit, is this one; -1 if there is none. */
static int find_stem(const ZpData *data, const char *stem) {
  const size_t length = strlen(stem);
  for (size_t i = 0; i < data->columns; i++) {
    const char *name = data->cell[i];
    if (strncasecmp(name, stem, length) == 0 && name[length] == '_' && zp_is_unit(name + length + 1)) return (int)i;
  }
  return -1;
}

/* Do both names have a unit, and not the same one? An instrument's line of units is that of its channels, before a
 * probe or a sensor, so the new name decides. */
static bool differ_in_unit(const ZpData *data, const char *theirs, const char *ours) {
  if (data->units) return false;
  const char *a = strrchr(theirs, '_'), *b = strrchr(ours, '_');
  return a && b && zp_is_unit(a + 1) && zp_is_unit(b + 1) && strcmp(a, b) != 0;
}

/* Rename a column: "Gewicht = load_g". `part` is modified and must outlive the data. */
static ZpStatus rename_column(const ZpDataFiles *files, char *part, bool measured, ZpError *err) {
  char *equals = strchr(part, '=');
  if (!equals)
    return zp_fail(err, ZP_BAD_INPUT,
                   "data.columns: \"%.80s\": write \"name in the file = name in zipact\", as in Gewicht = load_g",
                   part);
  *equals = 0;
  char *theirs = zp_trim(part), *ours = zp_trim(equals + 1);
  if (strchr(ours, '='))
    return zp_fail(err, ZP_BAD_INPUT, "data.columns: \"%.80s\": several names are separated by semicolons", ours);
  bool found = !measured;
  for (size_t i = 0; i < files->count; i++) {
    int column = zp_data_column(&files->file[i], theirs);
    const bool whole = column >= 0; /* with its unit */
    if (!whole) column = find_stem(&files->file[i], theirs);
    found = found || column >= 0 || find_column(&files->file[i], ours) >= 0;
    if (column < 0) continue;
    const char *unit = strrchr(files->file[i].cell[column], '_');
    if (!whole && differ_in_unit(&files->file[i], files->file[i].cell[column], ours))
      return zp_fail(err, ZP_BAD_INPUT, "data.columns: %.60s = %.60s: in %.200s the unit of that column is %.20s",
                     theirs, ours, files->file[i].path, unit + 1);
    files->file[i].cell[column] = ours;
  }
  return found ? ZP_OK : fail_renaming(files, theirs, err);
}

static ZpStatus rename_columns(ZpDataFiles *files, const char *renamed, bool measured, ZpError *err) {
  char *rest = files->renamed = strdup(renamed);
  ZpStatus status = rest ? ZP_OK : zp_fail_memory(err);
  for (char *part = rest ? strsep(&rest, ";") : NULL; part && status == ZP_OK; part = strsep(&rest, ";"))
    if (*zp_trim(part)) status = rename_column(files, part, measured, err);
  return status;
}

ZpStatus zp_data_read_all(const char *key, const char *paths, const char *renamed, bool measured, ZpDataFiles *files,
                          ZpError *err) {
  *files = (ZpDataFiles){.paths = strdup(paths), .file = calloc(count_char(paths, ';') + 1, sizeof(ZpData))};
  if (!files->paths || !files->file) return zp_fail_memory(err);
  ZpStatus status = ZP_OK;
  for (char *rest = files->paths; rest && status == ZP_OK;)
    status = read_table(key, zp_trim(strsep(&rest, ";")), measured ? 2 : 1, &files->file[files->count++], err);
  return status == ZP_OK ? rename_columns(files, renamed, measured, err) : status;
}

/* -- numbers ----------------------------------------------------------------------------------------- */

int zp_data_line(const ZpData *data, size_t row) {
  return data->line[row + 1];
}

/* "12:03:04.250" => s since midnight; false if it is no time of day. */
static bool clock_time(const char *text, double *value) {
  int hours, minutes, used = 0;
  if (sscanf(text, "%d:%d%n", &hours, &minutes, &used) != 2 || hours < 0 || minutes < 0) return false;
  double seconds = 0;
  char copy[LONGEST_NUMBER];
  if (text[used] == ':') {
    if (!zp_cell_number(text + used + 1, ';', 0, copy, sizeof copy) || !zp_number_read(copy, &seconds)) return false;
  } else if (text[used]) {
    return false;
  }
  *value = 3600.0 * hours + 60.0 * minutes + seconds;
  return true;
}

bool zp_data_is_clock(const ZpData *data, size_t column) {
  double value;
  return data->rows > 0 && clock_time(data->cell[data->columns + column], &value);
}

ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err) {
  const char *text = data->cell[(row + 1) * data->columns + column];
  ZpSource source = {.name = data->path};
  char copy[LONGEST_NUMBER];
  *value = NAN;
  if (zp_cell_number(text, data->separator, data->grouped, copy, sizeof copy) && zp_number_read(copy, value) &&
      isfinite(*value))
    return ZP_OK;
  if (clock_time(text, value)) return ZP_OK;
  if (!*text)
    return zp_source_fail(&source, zp_data_line(data, row), err, "column %.60s: an empty cell; remove the row",
                          data->cell[column]);
  return zp_source_fail(&source, zp_data_line(data, row), err, "column %.60s: \"%.60s\": text in a number column",
                        data->cell[column], text);
}

bool zp_data_unit(const char *name, const char *stem, const char *unit, ZpUnitScale *scale) {
  size_t length = strlen(stem);
  *scale = (ZpUnitScale){.decimal = true};
  if (strncasecmp(name, stem, length) != 0) return false;
  if (name[length] == 0) return true;
  return name[length] == '_' && name[length + 1] != 0 && zp_unit_scale(name + length + 1, unit, scale, NULL) == ZP_OK;
}

ZpStatus zp_data_read_column(const ZpData *data, const char *stem, const char *unit, const char *example, double *value,
                             ZpError *err) {
  ZpUnitScale scale;
  size_t column = 0;
  while (column < data->columns && !zp_data_unit(data->cell[column], stem, unit, &scale))
    column++;
  if (column == data->columns)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.200s: no column %s_%s or %s", data->key, data->path, stem, unit, example);
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < data->rows && status == ZP_OK; i++) {
    status = zp_data_number(data, i, column, &value[i], err);
    value[i] = zp_unit_apply(&scale, value[i], 1);
  }
  return status;
}
