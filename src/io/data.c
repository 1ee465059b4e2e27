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
#include "io/number.h"
#include "io/range.h"
#include "io/source.h"
#include "io/units.h"

enum { LARGEST_FILE = 1 << 24 };

enum { LONGEST_NAME = 200, LONGEST_NUMBER = 64 };

void zp_data_destroy(ZpData *data) {
  free(data->text);
  free(data->names);
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

/* -- cells ------------------------------------------------------------------------------------------ */

/* End of the cell that starts at `text`: its separator or the end of the line; NULL if a quote is not closed. */
static char *cell_end(char *text, char separator) {
  bool quoted = false;
  for (; *text && (quoted || *text != separator); text++)
    quoted ^= *text == '"';
  return quoted ? NULL : text;
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

/* Split the next cell off a line, in place; NULL after the last one. */
static char *next_cell(char **line, char separator) {
  char *cell = *line, *end = cell_end(cell, separator);
  *line = *end ? end + 1 : NULL;
  *end = 0;
  return unquote(zp_trim(cell));
}

/* The separator: semicolon, tab or comma, the first of these that the row of names has outside of quotes. */
static char find_separator(char *names) {
  static const char separators[] = ";\t,";
  for (const char *c = separators; *c; c++) {
    char *end = cell_end(names, *c);
    if (end && *end) return *c;
  }
  return ',';
}

/* Number of cells of a line, 0 if a quote is not closed. */
static size_t count_cells(char *line, char separator) {
  size_t count = 1;
  for (char *end = cell_end(line, separator); !end || *end; end = cell_end(end + 1, separator), count++)
    if (!end) return 0;
  return count;
}

/* The unit in a name, without what is around it, and the end of the name before it: of "Zip time (ms)", "Zip time
 * [ms]", "Zip time / ms" and "Zip time in ms". False if the name has no such unit. */
static bool find_unit(char *name, char **unit, char **end) {
  static const char *const before[] = {" / ", " in "};
  const size_t length = strlen(name);
  char *open = strrchr(name, '[') ? strrchr(name, '[') : strrchr(name, '(');
  if (open && open > name && strchr(")]", name[length - 1])) {
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
  return false;
}

/* "Pull-in voltage (kV)" => Pull_in_voltage_kV, in place: not longer than before. */
static void plain_name(char *name) {
  char *unit = strrchr(name, '_'), *end = unit;
  const bool apart = find_unit(name, &unit, &end);
  if (!end) return;
  while (apart && end > name && end[-1] == ' ')
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
static ZpStatus take_line(ZpData *data, char *line, int number, size_t *rows, ZpError *err) {
  ZpSource source = {.name = data->path};
  size_t cells = count_cells(line, data->separator);
  if (cells == 0) return zp_source_fail(&source, number, err, "a quote is not closed");
  if (cells != data->columns)
    return zp_source_fail(&source, number, err, "%zu cells; the header has %zu", cells, data->columns);
  char **cell = data->cell + *rows * data->columns;
  for (size_t i = 0; i < cells; i++) {
    cell[i] = next_cell(&line, data->separator);
    if (*rows == 0) plain_name(cell[i]);
  }
  data->line[(*rows)++] = number;
  return ZP_OK;
}

/* A copy with a decimal point; false if it is no decimal. */
static bool plain_decimal(const char *text, char separator, char copy[LONGEST_NUMBER]) {
  snprintf(copy, LONGEST_NUMBER, "%s", text);
  char *comma = separator != ',' && !strchr(copy, '.') ? strchr(copy, ',') : NULL;
  if (comma) *comma = '.';
  return *text && strlen(text) < LONGEST_NUMBER && strspn(copy, "+-.0123456789eE") == strlen(copy);
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
    data->name[i] = next_cell(&rest, data->separator);
    numbers += plain_decimal(data->name[i], data->separator, number);
  }
  if (numbers == 0 || numbers < data->columns) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: the first row has numbers; it needs names with units, such as load_g",
                 data->key, data->path);
}

/* Allocate the rows of a text with so many lines, by its row of names. */
static ZpStatus open_rows(ZpData *data, char *names, size_t lines, ZpError *err) {
  data->separator = find_separator(names);
  data->columns = count_cells(names, data->separator);
  if (data->columns > 1000)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: more than 1000 columns", data->key, data->path);
  data->cell = calloc(lines * (data->columns + 1), sizeof *data->cell);
  return data->cell ? keep_names(data, names, err) : zp_fail_memory(err);
}

/* A line without its end; blanks at its ends may be empty cells and stay. */
static char *take_end(char *start) {
  char *end = strchr(start, '\n');
  if (!end) return NULL;
  *end = 0;
  if (end > start && end[-1] == '\r') end[-1] = 0;
  return end + 1;
}

static ZpStatus cut(ZpData *data, char *text, ZpError *err) {
  size_t lines = count_char(text, '\n') + 1, rows = 0;
  char *start = text + (strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0); /* a byte order mark */
  ZpStatus status = ZP_OK;
  int number = 0;
  data->line = calloc(lines, sizeof *data->line);
  if (!data->line) return zp_fail_memory(err);
  for (char *next; start && status == ZP_OK; start = next) {
    next = take_end(start);
    number++;
    if (!counts(start)) continue;
    if (!data->cell) status = open_rows(data, start, lines, err);
    if (status == ZP_OK) status = take_line(data, start, number, &rows, err);
  }
  if (status == ZP_OK && rows == 0)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: empty; needs a row of names and rows of numbers", data->key,
                   data->path);
  if (status == ZP_OK) data->rows = rows - 1;
  return status;
}

static bool has_only_numbers(const ZpData *data, size_t column) {
  char number[LONGEST_NUMBER];
  for (size_t row = 1; row <= data->rows; row++)
    if (!plain_decimal(data->cell[row * data->columns + column], data->separator, number)) return false;
  return data->rows > 0;
}

/* Is it a table of numbers? A scenario may name any file, and messages quote names and cells: those of a table, and
 * never what a file is that was not made for zipact. */
static ZpStatus check_table(const ZpData *data, ZpError *err) {
  if (data->columns < 2)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%s: %.300s:%d: not a table: one column; commas, semicolons or tabs must separate the columns",
                   data->key, data->path, data->line[0]);
  for (size_t column = 0; column < data->columns; column++)
    if (has_only_numbers(data, column)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s: %.300s: not a table: below the row of names, no column has a number in each row", data->key,
                 data->path);
}

ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err) {
  *data = (ZpData){.key = key, .path = path};
  ZpStatus status = read_text(key, path, &data->text, err);
  if (status == ZP_OK) status = cut(data, data->text, err);
  return status == ZP_OK ? check_table(data, err) : status;
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

/* Rename a column: "Gewicht = load_g". `part` is modified and must outlive the data. */
static ZpStatus rename_column(const ZpDataFiles *files, char *part, ZpError *err) {
  char *equals = strchr(part, '=');
  if (!equals)
    return zp_fail(err, ZP_BAD_INPUT,
                   "data.columns: \"%.80s\": write \"name in the file = name in zipact\", as in Gewicht = load_g",
                   part);
  *equals = 0;
  char *theirs = zp_trim(part), *ours = zp_trim(equals + 1);
  if (strchr(ours, '='))
    return zp_fail(err, ZP_BAD_INPUT, "data.columns: \"%.80s\": several names are separated by semicolons", ours);
  plain_name(theirs);
  bool found = false;
  for (size_t i = 0; i < files->count; i++) {
    const int column = find_column(&files->file[i], theirs);
    found = found || column >= 0 || find_column(&files->file[i], ours) >= 0;
    if (column >= 0) files->file[i].cell[column] = ours;
  }
  return found ? ZP_OK : fail_renaming(files, theirs, err);
}

static ZpStatus rename_columns(ZpDataFiles *files, const char *renamed, ZpError *err) {
  char *rest = files->renamed = strdup(renamed);
  ZpStatus status = rest ? ZP_OK : zp_fail_memory(err);
  for (char *part = rest ? strsep(&rest, ";") : NULL; part && status == ZP_OK; part = strsep(&rest, ";"))
    if (*zp_trim(part)) status = rename_column(files, part, err);
  return status;
}

ZpStatus zp_data_read_all(const char *key, const char *paths, const char *renamed, ZpDataFiles *files, ZpError *err) {
  *files = (ZpDataFiles){.paths = strdup(paths), .file = calloc(count_char(paths, ';') + 1, sizeof(ZpData))};
  if (!files->paths || !files->file) return zp_fail_memory(err);
  ZpStatus status = ZP_OK;
  for (char *rest = files->paths; rest && status == ZP_OK;)
    status = zp_data_read(key, zp_trim(strsep(&rest, ";")), &files->file[files->count++], err);
  return status == ZP_OK ? rename_columns(files, renamed, err) : status;
}

/* -- numbers ----------------------------------------------------------------------------------------- */

int zp_data_line(const ZpData *data, size_t row) {
  return data->line[row + 1];
}

ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err) {
  const char *text = data->cell[(row + 1) * data->columns + column];
  ZpSource source = {.name = data->path};
  char copy[LONGEST_NUMBER];
  *value = NAN;
  if (plain_decimal(text, data->separator, copy) && zp_number_read(copy, value) && isfinite(*value)) return ZP_OK;
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
