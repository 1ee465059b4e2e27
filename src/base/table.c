/* Tables and films of bounded size (zipact/table.h). */
#include "base/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* Thinning, common to both: rows of `size` doubles, of which every second is dropped when full. */
typedef struct Thinned {
  double *value;
  size_t size;
  size_t *rows, *stride, *offered;
  size_t capacity;
} Thinned;

static void drop_every_second(const Thinned *t) {
  size_t kept = (*t->rows + 1) / 2;
  for (size_t i = 1; i < kept; i++)
    memcpy(t->value + i * t->size, t->value + 2 * i * t->size, t->size * sizeof(double));
  *t->rows = kept;
  *t->stride *= 2;
}

/* The place for an offered row, or NULL if the thinning passes it over. */
static double *offer(const Thinned *t) {
  size_t index = (*t->offered)++;
  if (index % *t->stride) return NULL;
  if (*t->rows == t->capacity) {
    drop_every_second(t);
    if (index % *t->stride) return NULL;
  }
  return t->value + (*t->rows)++ * t->size;
}

/* The place for a row that must be the last, or NULL if the last row has this `mark` in its column 0. */
static double *keep_last(const Thinned *t, double mark) {
  if (*t->rows && t->value[(*t->rows - 1) * t->size] == mark) return NULL;
  if (*t->rows == t->capacity) return t->value + (*t->rows - 1) * t->size;
  return t->value + (*t->rows)++ * t->size;
}

static Thinned of_table(ZpTable *t) {
  return (Thinned){t->value, t->columns, &t->rows, &t->stride, &t->offered, t->capacity};
}

static Thinned of_shapes(ZpShapes *s) {
  return (Thinned){s->value, s->frame_size, &s->frames, &s->stride, &s->offered, s->capacity};
}

size_t zp_named(const char *pattern, const char *name, char *text) {
  size_t used = 0;
  for (; *pattern; pattern++) {
    const bool named = name && *pattern == '#';
    const size_t length = named ? strlen(name) : 1;
    if (text) memcpy(text + used, named ? name : pattern, length);
    used += length;
  }
  if (text) text[used] = 0;
  return used + 1;
}

static const char *name_of(const ZpColumnPart *part, size_t member, char text[ZP_MEMBER_TEXT]) {
  if (member == 0) return NULL;
  if (part->name) return part->name(part->of, member, text);
  snprintf(text, ZP_MEMBER_TEXT, "%zu", member);
  return text;
}

/* Columns, and their names and helps behind each other in a text. NULL, NULL: only count => columns and bytes. */
typedef struct Laid {
  size_t columns, bytes;
} Laid;

static void lay(const ZpColumnPart *part, ZpColumn *own, char *text, Laid *laid) {
  const size_t first = part->members > 0 ? 1 : 0;
  for (size_t member = first; member <= part->members; member++) {
    char room[ZP_MEMBER_TEXT];
    const char *called = name_of(part, member, room);
    for (size_t c = 0; c < part->count; c++) {
      const ZpColumn *from = &part->column[c];
      char *name = text ? text + laid->bytes : NULL;
      laid->bytes += zp_named(from->name, called, name);
      char *help = text ? text + laid->bytes : NULL;
      laid->bytes += from->help ? zp_named(from->help, called, help) : 0;
      if (own) own[laid->columns] = (ZpColumn){name, from->unit, from->help ? help : NULL};
      laid->columns++;
    }
  }
}

ZpTable *zp_table_of(const ZpColumnPart *part, size_t parts, size_t capacity) {
  Laid all = {0}, laid = {0};
  for (size_t k = 0; k < parts; k++)
    lay(&part[k], NULL, NULL, &all);
  ZpTable *table = zp_calloc(1, sizeof *table + all.columns * sizeof(ZpColumn) + all.bytes);
  if (!table) return NULL;
  ZpColumn *own = (ZpColumn *)(table + 1);
  for (size_t k = 0; k < parts; k++)
    lay(&part[k], own, (char *)(own + all.columns), &laid);
  *table = (ZpTable){.column = own, .columns = all.columns, .capacity = capacity, .stride = 1};
  table->value = zp_calloc(capacity, all.columns * sizeof(double));
  if (table->value) return table;
  zp_free(table);
  return NULL;
}

ZpTable *zp_table_create(const ZpColumn *column, size_t columns, size_t capacity) {
  return zp_table_of(&(ZpColumnPart){.column = column, .count = columns}, 1, capacity);
}

void zp_table_destroy(ZpTable *table) {
  if (!table) return;
  zp_free(table->value);
  zp_free(table);
}

bool zp_table_offer(ZpTable *table, const double *row) {
  Thinned t = of_table(table);
  double *place = offer(&t);
  if (place) memcpy(place, row, t.size * sizeof(double));
  return place != NULL;
}

void zp_table_keep_last(ZpTable *table, const double *row) {
  Thinned t = of_table(table);
  double *place = keep_last(&t, row[0]);
  if (place) memcpy(place, row, t.size * sizeof(double));
}

double zp_table_get(const ZpTable *table, size_t row, const char *name) {
  for (size_t c = 0; c < table->columns && row < table->rows; c++)
    if (strcmp(table->column[c].name, name) == 0) return table->value[row * table->columns + c];
  return NAN;
}

size_t zp_table_rows(const ZpTable *table) {
  return table->rows;
}

size_t zp_table_columns(const ZpTable *table) {
  return table->columns;
}

const ZpColumn *zp_table_column(const ZpTable *table, size_t column) {
  return column < table->columns ? &table->column[column] : NULL;
}

const double *zp_table_row(const ZpTable *table, size_t row) {
  return row < table->rows ? table->value + row * table->columns : NULL;
}

/* A frame: time, voltage, zipped; x, y, stress of all nodes; gap, line force and insulator's field of the stations. */
enum { FRAME_HEAD = 3, OF_NODES = 3, OF_STATIONS = 3 };

ZpShapes *zp_shapes_create(size_t ribbons, size_t nodes, size_t capacity) {
  ZpShapes *shapes = zp_calloc(1, sizeof *shapes);
  if (!shapes) return NULL;
  size_t frame_size = FRAME_HEAD + (OF_NODES * ribbons + OF_STATIONS) * nodes;
  *shapes = (ZpShapes){
      .ribbons = ribbons, .nodes = nodes, .capacity = capacity, .stride = 1, .frame_size = frame_size, .members = 1};
  shapes->value = zp_calloc(capacity, frame_size * sizeof(double));
  if (shapes->value) return shapes;
  zp_free(shapes);
  return NULL;
}

void zp_shapes_destroy(ZpShapes *shapes) {
  if (!shapes) return;
  zp_free(shapes->value);
  zp_free(shapes);
}

/* Copy what is there. => the place behind it */
static double *put_numbers(double *to, const double *from, size_t count) {
  if (from) memcpy(to, from, count * sizeof(double));
  return to + count;
}

static void fill_frame(ZpShapes *shapes, double *frame, const ZpShape *shape) {
  size_t all = shapes->ribbons * shapes->nodes;
  frame[0] = shape->time;
  frame[1] = shape->voltage;
  frame[2] = (double)shape->zipped;
  const double *const of_nodes[OF_NODES] = {shape->x, shape->y, shape->stress};
  const double *const of_stations[OF_STATIONS] = {shape->gap, shape->line_force, shape->insulator_field};
  double *to = frame + FRAME_HEAD;
  for (size_t k = 0; k < OF_NODES; k++)
    to = put_numbers(to, of_nodes[k], all);
  for (size_t k = 0; k < OF_STATIONS; k++)
    to = put_numbers(to, of_stations[k], shapes->nodes);
  shapes->facing = shape->gap != NULL;
  shapes->stressed = shape->stress != NULL;
}

bool zp_shapes_offer(ZpShapes *shapes, const ZpShape *shape) {
  Thinned t = of_shapes(shapes);
  double *frame = offer(&t);
  if (frame) fill_frame(shapes, frame, shape);
  return frame != NULL;
}

void zp_shapes_keep_last(ZpShapes *shapes, const ZpShape *shape) {
  Thinned t = of_shapes(shapes);
  double *frame = keep_last(&t, shape->time);
  if (frame) fill_frame(shapes, frame, shape);
}

static void mirror_frame(size_t axis, size_t nodes, const double *from, double *to) {
  memcpy(to, from, FRAME_HEAD * sizeof *to);
  from += FRAME_HEAD;
  to += FRAME_HEAD;
  for (size_t number = 0; number < OF_NODES; number++, from += nodes, to += 2 * nodes)
    for (size_t i = 0; i < nodes; i++) {
      to[2 * i] = number == axis ? 0 - from[i] : from[i];
      to[2 * i + 1] = from[i];
    }
  memcpy(to, from, OF_STATIONS * nodes * sizeof *to);
  for (size_t i = 0; i < nodes; i++)
    to[i] = 2 * from[i]; /* the gap */
}

ZpShapes *zp_shapes_mirrored(const ZpShapes *half, size_t axis) {
  ZpShapes *both = zp_shapes_create(2, half->nodes, half->capacity);
  if (!both) return NULL;
  double *value = both->value;
  const size_t size = both->frame_size;
  for (size_t k = 0; k < half->frames; k++)
    mirror_frame(axis, half->nodes, half->value + k * half->frame_size, value + k * size);
  *both = *half;
  both->ribbons = 2;
  both->frame_size = size;
  both->value = value;
  return both;
}

ZpShape zp_shapes_get(const ZpShapes *shapes, size_t frame) {
  const double *f = shapes->value + frame * shapes->frame_size, *x = f + FRAME_HEAD;
  size_t nodes = shapes->nodes, all = shapes->ribbons * nodes;
  const double *of_stations = shapes->facing ? x + OF_NODES * all : NULL;
  return (ZpShape){.time = f[0],
                   .voltage = f[1],
                   .zipped = (size_t)f[2],
                   .x = x,
                   .y = x + all,
                   .gap = of_stations,
                   .line_force = of_stations ? of_stations + nodes : NULL,
                   .insulator_field = of_stations ? of_stations + 2 * nodes : NULL,
                   .stress = shapes->stressed ? x + 2 * all : NULL};
}

size_t zp_shapes_frames(const ZpShapes *shapes) {
  return shapes->frames;
}

size_t zp_shapes_ribbons(const ZpShapes *shapes) {
  return shapes->ribbons;
}

size_t zp_shapes_nodes(const ZpShapes *shapes) {
  return shapes->nodes;
}

size_t zp_shapes_members(const ZpShapes *shapes) {
  return shapes->members;
}

size_t zp_shapes_stride(const ZpShapes *shapes) {
  return shapes->frame_size;
}
