#include "io/packed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "base/pack.h"
#include "base/table.h"
#include "def/check.h"
#include "study/result.h"

static const ZpPackKind kind_of_names = {"result", 'N', 10}, kind_of_numbers = {"result", 'R', 10},
                        kind_of_arrays = {"result", 'A', 10};

/* -- writing --------------------------------------------------------------------------------------- */

static void add_text(ZpPack *p, const char *text) {
  zp_pack_add(p, text, strlen(text) + 1);
}

static void add_texts(ZpPack *p, const char *a, const char *b, const char *c) {
  add_text(p, a);
  add_text(p, b);
  add_text(p, c);
}

static void add_columns(ZpPack *p, const char *name, const ZpTable *table) {
  zp_pack_open(p, name, ZP_TEXT);
  for (size_t i = 0; table && i < table->columns; i++)
    add_texts(p, table->column[i].name, table->column[i].unit, table->column[i].help);
  zp_pack_close(p);
}

static void write_names(ZpPack *p, const ZpResult *r) {
  zp_pack_open(p, "study", ZP_TEXT);
  add_text(p, zp_study_name(r->study));
  zp_pack_close(p);
  zp_pack_open(p, "scalars", ZP_TEXT);
  for (const ZpScalar *s = r->scalar; s < r->scalar + r->scalars; s++)
    add_texts(p, s->name, s->unit, s->timing ? "timing" : "");
  zp_pack_close(p);
  zp_pack_open(p, "derivatives", ZP_TEXT);
  for (const ZpSensitivity *s = r->sensitivity; s < r->sensitivity + r->sensitivities; s++)
    add_texts(p, s->output, ZP_KEY_NAME(s->key), "");
  zp_pack_close(p);
  add_columns(p, "columns", r->series);
}

/* `sum`: the checksum of the names to which the numbers belong. */
static void write_numbers(ZpPack *p, const ZpResult *r, double sum) {
  zp_pack_open(p, "texts", ZP_TEXT);
  add_text(p, zp_outcome_name(r->outcome));
  add_text(p, r->message);
  for (size_t i = 0; i < r->notes; i++)
    add_text(p, r->note[i]);
  zp_pack_close(p);
  zp_pack_open(p, "numbers", ZP_REAL);
  zp_pack_add(p, &sum, 1);
  zp_pack_add(p, &r->resolution, 1);
  for (size_t i = 0; i < r->scalars; i++)
    zp_pack_add(p, &r->scalar[i].value, 1);
  for (size_t i = 0; i < r->sensitivities; i++)
    zp_pack_add(p, &r->sensitivity[i].value, 1);
  if (r->series) zp_pack_add(p, r->series->value, r->series->rows * r->series->columns);
  zp_pack_close(p);
}

/* Write both records to `byte`, NULL: count only. => their size, *names that of the first */
static size_t write_both(const ZpResult *r, unsigned char *byte, size_t *names) {
  ZpPack p = byte ? zp_pack_write(&kind_of_names, byte) : zp_pack_count();
  write_names(&p, r);
  if (byte) zp_pack_seal(&p);
  *names = p.used;
  p = byte ? zp_pack_write(&kind_of_numbers, byte + *names) : zp_pack_count();
  write_numbers(&p, r, byte ? zp_pack_sum(byte) : 0);
  if (byte) zp_pack_seal(&p);
  return *names + p.used;
}

ZpPacked *zp_packed_of(const ZpResult *result) {
  size_t names, size = write_both(result, NULL, &names);
  ZpPacked *packed = malloc(sizeof *packed + size);
  if (!packed) return NULL;
  *packed = (ZpPacked){result->outcome, names, size};
  write_both(result, packed->byte, &names);
  return packed;
}

/* -- reading names and numbers --------------------------------------------------------------------- */

/* The next text of several, each with its 0; NULL behind the last one. */
static const char *next_text(ZpTexts *texts) {
  const char *text = texts->at, *end = texts->size ? memchr(text, 0, texts->size) : NULL;
  if (!end) return NULL;
  texts->size -= (size_t)(end + 1 - text);
  texts->at = end + 1;
  return text;
}

/* => texts in the record, all of them ended */
static ZpTexts find_texts(ZpPack *p, const char *name) {
  ZpTexts texts;
  texts.at = (const char *)zp_pack_find(p, name, ZP_TEXT, &texts.size);
  if (texts.size && texts.at[texts.size - 1] != 0) p->lacks = name;
  return texts;
}

static ZpOutcome outcome_of(const char *word) {
  for (int i = 0; word && strcmp(zp_outcome_name((ZpOutcome)i), "unknown") != 0; i++)
    if (strcmp(zp_outcome_name((ZpOutcome)i), word) == 0) return (ZpOutcome)i;
  return ZP_BAD_ARGUMENT;
}

/* ZpStudy_COUNT if there is none. */
static ZpStudy study_of(const char *word) {
  ZpStudy study = (ZpStudy)0;
  while ((int)study < ZpStudy_COUNT && !(word && strcmp(zp_study_name(study), word) == 0))
    study++;
  return study;
}

ZpStatus zp_names_read(const void *bytes, size_t size, ZpNames *names, ZpError *err) {
  ZpPack p;
  ZpStatus status = zp_pack_read(&kind_of_names, bytes, size, &p, err);
  if (status != ZP_OK) return status;
  ZpTexts study = find_texts(&p, "study");
  names->study = study_of(next_text(&study));
  names->scalars = find_texts(&p, "scalars");
  names->derivatives = find_texts(&p, "derivatives");
  names->columns = find_texts(&p, "columns");
  names->sum = zp_pack_sum(bytes);
  status = zp_pack_end(&p, err);
  if (status != ZP_OK || (int)names->study < ZpStudy_COUNT) return status;
  return zp_fail(err, ZP_BAD_INPUT, "of a study that zipact %s does not have", ZP_VERSION);
}

/* Numbers of a record, taken one after the other. */
typedef struct Numbers {
  const unsigned char *at;
  size_t left;
  bool bad; /* names and numbers do not fit */
} Numbers;

static double next_number(Numbers *numbers) {
  numbers->bad = numbers->bad || numbers->left == 0;
  if (numbers->bad) return 0;
  numbers->left--;
  numbers->at += 8;
  return zp_pack_real(numbers->at - 8, 0);
}

/* The next three texts; false behind the last ones. */
static bool next_texts(ZpTexts *texts, bool *bad, const char *text[3]) {
  for (int k = 0; k < 3; k++)
    text[k] = next_text(texts);
  *bad = *bad || (text[0] && !text[2]);
  return text[2] && !*bad;
}

static void read_scalars(ZpTexts texts, Numbers *numbers, ZpResult *result) {
  for (const char *text[3]; next_texts(&texts, &numbers->bad, text);) {
    const double value = next_number(numbers);
    if (*text[2])
      zp_result_add_timing(result, text[0], text[1], value);
    else
      zp_result_add(result, text[0], text[1], value);
  }
}

static void read_derivatives(ZpTexts texts, Numbers *numbers, ZpResult *result) {
  for (const char *text[3]; next_texts(&texts, &numbers->bad, text);) {
    const int key = zp_key_find(text[1]);
    const double value = next_number(numbers);
    numbers->bad = numbers->bad || key < 0;
    if (!numbers->bad) zp_result_add_sensitivity(result, text[0], key, value);
  }
}

/* A table with these columns and so many values, which it does not have yet. NULL if they do not fit, `bad`, or there
 * is no memory. */
static ZpTable *open_table(ZpTexts texts, size_t values, bool *bad) {
  size_t columns = 0;
  ZpColumn *column = calloc(texts.size + 1, sizeof *column);
  if (!column) return NULL;
  for (const char *text[3]; next_texts(&texts, bad, text);)
    column[columns++] = (ZpColumn){text[0], text[1], text[2]};
  if (columns == 0) *bad = true;
  const size_t rows = *bad ? 0 : values / columns;
  *bad = *bad || values != rows * columns;
  ZpTable *table = *bad ? NULL : zp_table_create(column, columns, rows < 2 ? 2 : rows);
  free(column);
  if (table) table->rows = table->offered = rows;
  return table;
}

/* The rest of the numbers are rows. False if there is no memory. */
static bool read_series(ZpTexts texts, Numbers *numbers, ZpResult *result) {
  if (texts.size == 0) return true;
  ZpTable *table = result->series = open_table(texts, numbers->left, &numbers->bad);
  if (!table) return numbers->bad;
  for (size_t i = 0; i < table->rows * table->columns; i++)
    table->value[i] = next_number(numbers);
  return true;
}

static void read_texts(ZpTexts texts, ZpResult *result) {
  result->outcome = outcome_of(next_text(&texts));
  const char *text = next_text(&texts);
  snprintf(result->message, sizeof result->message, "%s", text ? text : "");
  while ((text = next_text(&texts)))
    zp_result_note(result, "%s", text);
}

ZpStatus zp_numbers_read(const ZpNames *names, const void *bytes, size_t size, ZpResult *result, ZpError *err) {
  ZpPack p;
  Numbers numbers = {NULL, 0, false};
  zp_result_clear(result);
  ZpStatus status = zp_pack_read(&kind_of_numbers, bytes, size, &p, err);
  if (status != ZP_OK) return status;
  const ZpTexts texts = find_texts(&p, "texts");
  numbers.at = zp_pack_find(&p, "numbers", ZP_REAL, &numbers.left);
  status = zp_pack_end(&p, err);
  if (status != ZP_OK) return status;
  result->study = names->study;
  read_texts(texts, result);
  numbers.bad = next_number(&numbers) != names->sum;
  result->resolution = next_number(&numbers);
  read_scalars(names->scalars, &numbers, result);
  read_derivatives(names->derivatives, &numbers, result);
  const bool room = read_series(names->columns, &numbers, result) && !result->incomplete;
  if (room && !numbers.bad && numbers.left == 0) return ZP_OK;
  zp_result_clear(result);
  return room ? zp_fail(err, ZP_BAD_INPUT, "damaged: its numbers are not those of its names") : zp_fail_memory(err);
}

/* -- everything ------------------------------------------------------------------------------------ */

/* Shapes that are read are created when their size is known. */
static ZpStatus walk_shapes(ZpPack *p, ZpShapes **out) {
  ZpShapes *s = *out;
  size_t size[4] = {s ? s->ribbons : 0, s ? s->nodes : 0, s ? s->members : 0, s ? s->frames : 0};
  bool has[2] = {s && s->facing, s && s->stressed};
  zp_pack_field(p, "shapes.size", ZP_SIZE, size, 4);
  zp_pack_field(p, "shapes.has", ZP_FLAG, has, 2);
  if (p->in && size[0] > 0) {
    const bool possible =
        size[0] <= 2 && size[1] < p->size && size[3] < p->size && size[2] > 0 && size[1] % size[2] == 0;
    s = *out = possible ? zp_shapes_create(size[0], size[1], size[3] + 2) : NULL;
    if (!possible) p->lacks = "shapes.size";
    if (!s) return possible ? ZP_MACHINE : ZP_OK;
    s->members = size[2];
    s->frames = s->offered = size[3];
    s->facing = has[0];
    s->stressed = has[1];
  }
  zp_pack_field(p, "shapes", ZP_REAL, s ? s->value : NULL, s ? s->frames * s->frame_size : 0);
  return ZP_OK;
}

static ZpStatus walk_map(ZpPack *p, ZpFieldMap **out) {
  ZpFieldMap *m = *out;
  size_t size[2] = {m ? m->nx : 0, m ? m->ny : 0}, surface[6] = {0};
  if (m) memcpy(surface, m->surface, sizeof surface);
  zp_pack_field(p, "field.size", ZP_SIZE, size, 2);
  zp_pack_field(p, "field.surface", ZP_SIZE, surface, 6);
  if (p->in && size[0] > 0) {
    bool possible = size[0] > 1 && size[1] > 1 && size[0] < p->size && size[1] < p->size;
    for (size_t k = 0; k < 6; k++)
      possible = possible && surface[k] < size[1];
    m = *out = possible ? zp_field_map_create(size[0], size[1]) : NULL;
    if (!possible) p->lacks = "field.size";
    if (!m) return possible ? ZP_MACHINE : ZP_OK;
    memcpy(m->surface, surface, sizeof surface);
  }
  const size_t nodes = m ? m->nx * m->ny : 0, cells = m ? (m->nx - 1) * (m->ny - 1) : 0;
  zp_pack_field(p, "field.x", ZP_REAL, m ? m->x : NULL, nodes);
  zp_pack_field(p, "field.y", ZP_REAL, m ? m->y : NULL, nodes);
  zp_pack_field(p, "field.potential", ZP_REAL, m ? m->potential : NULL, nodes);
  zp_pack_field(p, "field.strength", ZP_REAL, m ? m->strength : NULL, cells);
  zp_pack_field(p, "field.permittivity", ZP_REAL, m ? m->permittivity : NULL, cells);
  return ZP_OK;
}

static ZpStatus walk_checkpoint(ZpPack *p, ZpCheckpoint **out, ZpError *err) {
  const ZpCheckpoint *c = *out;
  size_t size = c ? c->size : 0;
  if (!p->in) {
    zp_pack_open(p, "checkpoint", ZP_TEXT);
    zp_pack_add(p, c ? c->byte : NULL, size);
    zp_pack_close(p);
    return ZP_OK;
  }
  const unsigned char *byte = zp_pack_find(p, "checkpoint", ZP_TEXT, &size);
  return size > 0 ? zp_checkpoint_from(byte, size, out, err) : ZP_OK;
}

static ZpStatus walk_table(ZpPack *p, const char *columns, const char *values, ZpTable **out) {
  ZpTable *t = *out;
  size_t count = t ? t->rows * t->columns : 0;
  bool bad = false;
  if (!p->in) {
    add_columns(p, columns, t);
    zp_pack_field(p, values, ZP_REAL, t ? t->value : NULL, count);
    return ZP_OK;
  }
  const ZpTexts texts = find_texts(p, columns);
  const unsigned char *byte = zp_pack_find(p, values, ZP_REAL, &count);
  if (p->lacks || texts.size == 0) return ZP_OK;
  t = *out = open_table(texts, count, &bad);
  if (bad) p->lacks = values;
  for (size_t i = 0; t && i < count; i++)
    t->value[i] = zp_pack_real(byte, i);
  return t || bad ? ZP_OK : ZP_MACHINE;
}

static ZpStatus walk_further(ZpPack *p, ZpTable *further[ZP_FURTHER]) {
  static const char *const field[ZP_FURTHER][2] = {[ZP_FURTHER_LIKELIHOOD] = {"likelihood.columns", "likelihood"},
                                                   [ZP_FURTHER_REGIONS] = {"regions.columns", "regions"}};
  for (int k = 0; k < ZP_FURTHER; k++)
    if (walk_table(p, field[k][0], field[k][1], &further[k]) != ZP_OK) return ZP_MACHINE;
  return ZP_OK;
}

static ZpStatus walk_arrays(ZpPack *p, ZpShapes **shapes, ZpFieldMap **map, ZpTable *further[ZP_FURTHER],
                            ZpCheckpoint **checkpoint, ZpError *err) {
  if (walk_shapes(p, shapes) != ZP_OK || walk_map(p, map) != ZP_OK || walk_further(p, further) != ZP_OK)
    return zp_fail_memory(err);
  return walk_checkpoint(p, checkpoint, err);
}

size_t zp_result_save(const ZpResult *result, void *bytes) {
  unsigned char *byte = bytes;
  size_t names;
  const size_t used = write_both(result, byte, &names);
  ZpPack p = byte ? zp_pack_write(&kind_of_arrays, byte + used) : zp_pack_count();
  ZpShapes *shapes = result->shapes;
  ZpFieldMap *map = result->map;
  ZpCheckpoint *checkpoint = result->checkpoint;
  ZpTable *further[ZP_FURTHER];
  memcpy(further, result->further, sizeof further);
  walk_arrays(&p, &shapes, &map, further, &checkpoint, NULL);
  if (byte) zp_pack_seal(&p);
  return used + p.used;
}

ZpStatus zp_result_load(const void *bytes, size_t size, ZpResult **out, ZpError *err) {
  const unsigned char *byte = bytes;
  const size_t first = zp_pack_first(byte, size), second = zp_pack_first(byte + first, size - first),
               both = first + second;
  ZpNames names;
  ZpError why;
  ZpResult *result = *out = zp_result_create((ZpStudy)0);
  if (!result) return zp_fail_memory(err);
  ZpStatus status = zp_names_read(byte, first, &names, &why);
  if (status == ZP_OK) status = zp_numbers_read(&names, byte + first, second, result, &why);
  ZpPack p;
  const bool arrays = status == ZP_OK && both < size;
  if (arrays) status = zp_pack_read(&kind_of_arrays, byte + both, size - both, &p, &why);
  if (arrays && status == ZP_OK)
    status = walk_arrays(&p, &result->shapes, &result->map, result->further, &result->checkpoint, &why);
  if (arrays && status == ZP_OK) status = zp_pack_end(&p, &why);
  if (status == ZP_OK) return ZP_OK;
  zp_result_destroy(result);
  *out = NULL;
  return zp_fail(err, status, "result: %.480s", why.message);
}

bool zp_results_read(const unsigned char *byte, size_t size, ZpStudy study, size_t count, ZpResult **result) {
  size_t used = 0, read = 0;
  bool good = true;
  while (good && read < count) {
    const size_t names = zp_pack_first(byte + used, size - used),
                 both = names + zp_pack_first(byte + used + names, size - used - names);
    good = zp_result_load(byte + used, both, &result[read], NULL) == ZP_OK;
    read += good;
    used += both;
    good = good && result[read - 1]->study == study;
  }
  if (good && used == size) return true;
  while (read > 0)
    zp_result_destroy(result[--read]);
  return false;
}
