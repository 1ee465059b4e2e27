/* CSV: names in the first row, numbers below. A cell is looked at only when its column is used, so that columns
 * of remarks do no harm. Quoted cells are not known. */
#include "io/data.h"

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/source.h"
#include "io/units.h"

enum { LARGEST_FILE = 1 << 24 };

void zp_data_destroy(ZpData *data) {
  free(data->text);
  free(data->cell);
  free(data->line);
  *data = (ZpData){0};
}

static ZpStatus read_text(const char *key, const char *path, char **text, ZpError *err) {
  FILE *file = fopen(path, "rb");
  if (!file)
    return zp_fail(err, errno == ENOENT || errno == ENOTDIR ? ZP_BAD_INPUT : ZP_MACHINE,
                   "%s: %.300s: cannot be opened: %s", key, path, strerror(errno));
  *text = malloc(LARGEST_FILE + 1);
  size_t size = *text ? fread(*text, 1, LARGEST_FILE, file) : 0;
  bool failed = ferror(file) != 0;
  fclose(file); /* nothing was written */
  if (!*text) return zp_fail_memory(err);
  (*text)[size] = 0;
  if (failed) return zp_fail(err, ZP_MACHINE, "%s: %.300s: cannot be read: %s", key, path, strerror(errno));
  if (size == LARGEST_FILE) return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: longer than 16 MB", key, path);
  if (strlen(*text) != size) return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: not a text", key, path);
  return ZP_OK;
}

/* Cut white space off both ends, in place. */
static char *trim(char *text) {
  while (isspace((unsigned char)*text))
    text++;
  size_t length = strlen(text);
  while (length && isspace((unsigned char)text[length - 1]))
    text[--length] = 0;
  return text;
}

static size_t count_char(const char *text, char c) {
  size_t count = 0;
  for (; *text; text++)
    count += *text == c;
  return count;
}

/* Cut a line into the cells of the next row. */
static ZpStatus take_line(ZpData *data, char *line, int number, size_t *rows, ZpError *err) {
  ZpSource source = {.name = data->path};
  size_t cells = count_char(line, ',') + 1;
  if (cells != data->columns)
    return zp_source_fail(&source, number, err, "%zu cells; the header has %zu", cells, data->columns);
  char **cell = data->cell + *rows * data->columns;
  for (size_t i = 0; i < cells; i++) {
    char *comma = strchr(line, ',');
    if (comma) *comma = 0;
    cell[i] = trim(line);
    if (comma) line = comma + 1;
  }
  data->line[(*rows)++] = number;
  return ZP_OK;
}

static bool counts(const char *line) {
  return *line && *line != '#';
}

static ZpStatus cut(ZpData *data, ZpError *err) {
  size_t lines = count_char(data->text, '\n') + 1, rows = 0;
  char *start = data->text + (strncmp(data->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0); /* a byte order mark */
  ZpStatus status = ZP_OK;
  int number = 0;
  data->line = calloc(lines, sizeof *data->line);
  if (!data->line) return zp_fail_memory(err);
  for (char *next; start && status == ZP_OK; start = next) {
    char *end = strchr(start, '\n');
    if (end) *end = 0;
    next = end ? end + 1 : NULL;
    number++;
    char *line = trim(start);
    if (!counts(line)) continue;
    if (!data->cell) {
      data->columns = count_char(line, ',') + 1;
      if (data->columns > 1000)
        return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: more than 1000 columns", data->key, data->path);
      data->cell = calloc(lines * data->columns, sizeof *data->cell);
      if (!data->cell) return zp_fail_memory(err);
    }
    status = take_line(data, line, number, &rows, err);
  }
  if (status == ZP_OK && rows == 0)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %.300s: empty; needs a row of names and rows of numbers", data->key,
                   data->path);
  if (status == ZP_OK) data->rows = rows - 1;
  return status;
}

ZpStatus zp_data_read(const char *key, const char *path, ZpData *data, ZpError *err) {
  *data = (ZpData){.key = key, .path = path};
  ZpStatus status = read_text(key, path, &data->text, err);
  return status == ZP_OK ? cut(data, err) : status;
}

int zp_data_column(const ZpData *data, const char *name) {
  for (size_t i = 0; i < data->columns; i++)
    if (strcmp(data->cell[i], name) == 0) return (int)i;
  return -1;
}

ZpStatus zp_data_number(const ZpData *data, size_t row, size_t column, double *value, ZpError *err) {
  const char *text = data->cell[(row + 1) * data->columns + column];
  ZpSource source = {.name = data->path};
  char *end = NULL;
  *value = NAN;
  locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!c_locale) return zp_fail_memory(err);
  if (*text && strspn(text, "+-.0123456789eE") == strlen(text)) *value = strtod_l(text, &end, c_locale);
  freelocale(c_locale);
  if (end && end > text && *end == 0 && isfinite(*value)) return ZP_OK;
  return zp_source_fail(&source, data->line[row + 1], err, "column %.60s: \"%.60s\": text in a number column",
                        data->cell[column], text);
}

bool zp_data_unit(const char *name, const char *stem, const char *unit, double *factor, double *divisor) {
  size_t length = strlen(stem);
  ZpUnitScale scale;
  *factor = *divisor = 1;
  if (strncmp(name, stem, length) != 0) return false;
  if (name[length] == 0) return true;
  if (name[length] != '_' || name[length + 1] == 0) return false;
  if (zp_unit_scale(name + length + 1, unit, &scale, NULL) != ZP_OK) return false;
  if (!scale.decimal)
    *factor = scale.factor;
  else if (scale.exponent < 0)
    *divisor = pow(10, -scale.exponent);
  else
    *factor = pow(10, scale.exponent);
  return true;
}
