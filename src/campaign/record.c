/* Layout, all little-endian: resolution; notes, each with its 0; scalars as number of the name and value; derivatives
 * as number of the output's name, key and value; then the series: columns, rows, numbers of the names, values row by
 * row. Counts have 4 bytes, values 8. */
#include "campaign/record.h"

#include <stdlib.h>
#include <string.h>

/* -- names ------------------------------------------------------------------------------------------ */

bool zp_names_add(ZpNames *names, const ZpName *name) {
  ZpName *item = realloc(names->item, (names->count + 1) * sizeof *item);
  if (!item) return false;
  names->item = item;
  ZpName *copy = &item[names->count++];
  *copy = (ZpName){strdup(name->name), strdup(name->unit), name->help ? strdup(name->help) : NULL, name->timing};
  return copy->name && copy->unit && (copy->help || !name->help);
}

void zp_names_free(ZpNames *names) {
  for (size_t i = 0; i < names->count; i++) {
    free(names->item[i].name);
    free(names->item[i].unit);
    free(names->item[i].help);
  }
  free(names->item);
  *names = (ZpNames){0};
}

static bool same_name(const ZpName *a, const ZpName *b) {
  if (strcmp(a->name, b->name) != 0 || strcmp(a->unit, b->unit) != 0 || a->timing != b->timing) return false;
  return a->help && b->help ? strcmp(a->help, b->help) == 0 : a->help == b->help;
}

size_t zp_names_number(ZpNames *names, const ZpName *name) {
  for (size_t i = 0; i < names->count; i++)
    if (same_name(&names->item[i], name)) return i;
  return zp_names_add(names, name) ? names->count - 1 : names->count;
}

/* -- writing ---------------------------------------------------------------------------------------- */

static unsigned char *make_room(ZpRecord *record, size_t size) {
  if (record->used + size > record->room) {
    const size_t room = 2 * (record->used + size);
    unsigned char *byte = record->bad ? NULL : realloc(record->byte, room);
    if (!byte) {
      record->bad = true;
      return NULL;
    }
    record->byte = byte;
    record->room = room;
  }
  record->used += size;
  return record->byte + record->used - size;
}

static void put(ZpRecord *record, size_t size, uint64_t value) {
  unsigned char *byte = make_room(record, size);
  for (size_t i = 0; byte && i < size; i++)
    byte[i] = (unsigned char)(value >> 8 * i);
}

static void put_count(ZpRecord *record, size_t count) {
  put(record, 4, count);
}

static void put_real(ZpRecord *record, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put(record, 8, bits);
}

static void put_name(ZpRecord *record, ZpNames *names, const char *name, const char *unit, const char *help,
                     bool timing) {
  const size_t number = zp_names_number(names, &(ZpName){(char *)name, (char *)unit, (char *)help, timing});
  record->bad = record->bad || number == names->count;
  put_count(record, number);
}

static void put_notes(ZpRecord *record, const ZpResult *result) {
  put_count(record, result->notes);
  for (size_t i = 0; i < result->notes; i++) {
    const size_t size = strlen(result->note[i]) + 1;
    unsigned char *byte = make_room(record, size);
    if (byte) memcpy(byte, result->note[i], size);
  }
}

static void put_series(ZpRecord *record, ZpNames *names, const ZpTable *table) {
  put_count(record, table ? table->columns : 0);
  if (!table) return;
  put_count(record, table->rows);
  for (size_t i = 0; i < table->columns; i++)
    put_name(record, names, table->column[i].name, table->column[i].unit, table->column[i].help, false);
  for (size_t i = 0; i < table->rows * table->columns; i++)
    put_real(record, table->value[i]);
}

bool zp_record_write(ZpRecord *record, ZpNames *names, const ZpResult *result) {
  record->used = 0;
  put_real(record, result->resolution);
  put_notes(record, result);
  put_count(record, result->scalars);
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *s = &result->scalar[i];
    put_name(record, names, s->name, s->unit, NULL, s->timing);
    put_real(record, s->value);
  }
  put_count(record, result->sensitivities);
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    put_name(record, names, s->output, "", NULL, false);
    put_count(record, (size_t)s->key);
    put_real(record, s->value);
  }
  put_series(record, names, result->series);
  return !record->bad;
}

/* -- reading ---------------------------------------------------------------------------------------- */

/* The remaining bytes; `bad` if more was read than there is. */
typedef struct Reader {
  const unsigned char *byte;
  size_t left;
  const ZpNames *names;
  bool bad;
} Reader;

static uint64_t get(Reader *reader, size_t size) {
  uint64_t value = 0;
  reader->bad = reader->bad || reader->left < size;
  if (reader->bad) return 0;
  for (size_t i = 0; i < size; i++)
    value |= (uint64_t)reader->byte[i] << 8 * i;
  reader->byte += size;
  reader->left -= size;
  return value;
}

/* Read a count of at most `most`. */
static size_t get_count(Reader *reader, size_t most) {
  const size_t count = (size_t)get(reader, 4);
  reader->bad = reader->bad || count > most;
  return reader->bad ? 0 : count;
}

static double get_real(Reader *reader) {
  const uint64_t bits = get(reader, 8);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* NULL if the record is bad. */
static const ZpName *get_name(Reader *reader) {
  const size_t number = (size_t)get(reader, 4);
  reader->bad = reader->bad || number >= reader->names->count;
  return reader->bad ? NULL : &reader->names->item[number];
}

static void get_notes(Reader *reader, ZpResult *result) {
  result->notes = get_count(reader, ZP_MAX_NOTES);
  for (size_t i = 0; i < result->notes && !reader->bad; i++) {
    const size_t size = strnlen((const char *)reader->byte, reader->left) + 1;
    reader->bad = size > reader->left || size > sizeof result->note[i];
    if (reader->bad) return;
    memcpy(result->note[i], reader->byte, size);
    reader->byte += size;
    reader->left -= size;
  }
}

static void get_scalars(Reader *reader, ZpResult *result) {
  const size_t count = get_count(reader, ZP_MAX_SCALARS);
  for (size_t i = 0; i < count && !reader->bad; i++) {
    const ZpName *name = get_name(reader);
    const double value = get_real(reader);
    if (reader->bad) return;
    result->scalar[result->scalars++] = (ZpScalar){name->name, name->unit, value, name->timing};
  }
}

static void get_sensitivities(Reader *reader, ZpResult *result) {
  const size_t count = get_count(reader, ZP_MAX_SENSITIVITIES);
  for (size_t i = 0; i < count && !reader->bad; i++) {
    const ZpName *output = get_name(reader);
    const size_t key = get_count(reader, (size_t)zp_key_count() - 1);
    const double value = get_real(reader);
    if (!reader->bad) zp_result_add_sensitivity(result, output->name, (int)key, value);
  }
}

static bool make_series(Reader *reader, size_t columns, size_t rows, ZpResult *row) {
  ZpColumn *column = calloc(columns, sizeof *column);
  for (size_t i = 0; column && i < columns && !reader->bad; i++) {
    const ZpName *name = get_name(reader);
    if (name) column[i] = (ZpColumn){name->name, name->unit, name->help};
  }
  if (column && !reader->bad) row->series = zp_table_create(column, columns, rows < 2 ? 2 : rows);
  free(column);
  return row->series != NULL;
}

static void get_series(Reader *reader, ZpResult *row) {
  const size_t columns = get_count(reader, reader->names->count), rows = columns ? (size_t)get(reader, 4) : 0;
  if (columns == 0 || reader->bad) return;
  reader->bad = reader->left < columns * (4 + 8 * rows) || !make_series(reader, columns, rows, row);
  if (reader->bad) return;
  for (size_t i = 0; i < rows * columns; i++)
    row->series->value[i] = get_real(reader);
  row->series->rows = rows;
}

bool zp_record_read(const unsigned char *byte, size_t size, const ZpNames *names, ZpResult *row) {
  Reader reader = {byte, size, names, false};
  zp_record_clear(row);
  row->resolution = get_real(&reader);
  get_notes(&reader, row);
  get_scalars(&reader, row);
  get_sensitivities(&reader, row);
  get_series(&reader, row);
  return !reader.bad && reader.left == 0;
}

void zp_record_clear(ZpResult *row) {
  zp_table_destroy(row->series);
  row->series = NULL;
  row->notes = row->scalars = row->sensitivities = 0;
}
