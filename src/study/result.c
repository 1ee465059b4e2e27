/* A result: what every study fills. */
#include "study/result.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "study/studies.h"

ZpResult *zp_result_create(ZpStudy study) {
  ZpResult *result = zp_calloc(1, sizeof *result);
  if (result) result->study = study;
  if (result) result->resolution = INFINITY;
  return result;
}

void zp_result_forget_states(ZpResult *result) {
  if (!result) return;
  zp_limits_destroy(result->limits);
  result->limits = NULL;
}

void zp_result_destroy(ZpResult *result) {
  if (!result) return;
  zp_result_clear(result);
  zp_result_forget_further(result);
  zp_shapes_destroy(result->shapes);
  zp_field_map_destroy(result->map);
  zp_checkpoint_destroy(result->checkpoint);
  zp_limits_destroy(result->limits);
  zp_free(result->scalar);
  zp_free(result);
}

static size_t reserve_map(ZpFieldMap *map, void *block) {
  ZpArena arena = {block, 0};
  size_t cells = (map->nx - 1) * (map->ny - 1);
  double **of_nodes[] = {&map->x, &map->y, &map->potential}, **of_cells[] = {&map->strength, &map->permittivity};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_arena_take(&arena, map->nx * map->ny);
  for (size_t k = 0; k < sizeof of_cells / sizeof of_cells[0]; k++)
    *of_cells[k] = zp_arena_take(&arena, cells);
  return arena.used;
}

ZpFieldMap *zp_field_map_create(size_t nx, size_t ny) {
  ZpFieldMap *map = zp_calloc(1, sizeof *map);
  if (!map) return NULL;
  *map = (ZpFieldMap){.nx = nx, .ny = ny};
  map->memory = zp_calloc(1, reserve_map(map, NULL));
  if (!map->memory) {
    zp_free(map);
    return NULL;
  }
  reserve_map(map, map->memory);
  return map;
}

void zp_field_map_destroy(ZpFieldMap *map) {
  if (!map) return;
  zp_free(map->memory);
  zp_free(map);
}

double zp_result_get(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, name) == 0) return result->scalar[i].value;
  return NAN;
}

bool zp_result_has(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, name) == 0) return true;
  return false;
}

/* Twice the room for scalars. False if there is no memory. */
static bool make_room(ZpResult *result) {
  const size_t room = result->scalar_room > 0 ? 2 * result->scalar_room : 64;
  ZpScalar *scalar = zp_calloc(room, sizeof *scalar);
  if (!scalar) return false;
  if (result->scalars > 0) memcpy(scalar, result->scalar, result->scalars * sizeof *scalar);
  zp_free(result->scalar);
  result->scalar = scalar;
  result->scalar_room = room;
  return true;
}

static void add(ZpResult *result, ZpScalar scalar) {
  if (result->scalars == result->scalar_room && !make_room(result))
    result->incomplete = true;
  else
    result->scalar[result->scalars++] = scalar;
}

void zp_result_add(ZpResult *result, const char *name, const char *unit, double value) {
  add(result, (ZpScalar){name, unit, value, false});
}

void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value) {
  add(result, (ZpScalar){name, unit, value, true});
}

void zp_result_add_of(ZpResult *result, const char *name, const char *called, const char *unit, double value) {
  ZpName *own = zp_calloc(1, sizeof *own + zp_named(name, called, NULL));
  if (!own) {
    result->incomplete = true;
    return;
  }
  zp_named(name, called, own->text);
  own->next = result->names;
  result->names = own;
  zp_result_add(result, own->text, unit, value);
}

void zp_result_add_sensitivity(ZpResult *result, const char *output, int key, double value) {
  if (result->sensitivities < ZP_MAX_SENSITIVITIES) {
    result->sensitivity[result->sensitivities++] = (ZpSensitivity){output, key, value};
    return;
  }
  if (!result->cut) zp_result_note(result, "sensitivity: only the first %d derivatives are kept", ZP_MAX_SENSITIVITIES);
  result->cut = true;
}

/* The name of a scalar that zp_result_add_of has added; NULL: there is none. */
static const char *name_of(const ZpResult *result, const char *pattern, const char *called) {
  char text[2 * ZP_NAME_SIZE];
  if (zp_named(pattern, called, NULL) > sizeof text) return NULL;
  zp_named(pattern, called, text);
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, text) == 0) return result->scalar[i].name;
  return NULL;
}

void zp_result_add_sensitivity_of(ZpResult *result, const char *output, const char *called, int key, double value) {
  const char *name = name_of(result, output, called);
  if (name) zp_result_add_sensitivity(result, name, key, value);
}

void zp_result_note(ZpResult *result, const char *format, ...) {
  va_list args, again;
  va_start(args, format);
  va_copy(again, args);
  const int length = vsnprintf(NULL, 0, format, again);
  char *note = length >= 0 && result->notes < ZP_MAX_NOTES ? zp_calloc((size_t)length + 1, 1) : NULL;
  if (note) {
    vsnprintf(note, (size_t)length + 1, format, args);
    result->note[result->notes++] = note;
  } else if (result->notes < ZP_MAX_NOTES) {
    result->incomplete = true;
  }
  va_end(again);
  va_end(args);
}

ZpStudy zp_result_study(const ZpResult *result) {
  return result->study;
}

ZpOutcome zp_result_outcome(const ZpResult *result) {
  return result->outcome;
}

const char *zp_result_message(const ZpResult *result) {
  return result->message;
}

size_t zp_result_notes(const ZpResult *result) {
  return result->notes;
}

const char *zp_result_note_text(const ZpResult *result, size_t index) {
  return index < result->notes ? result->note[index] : NULL;
}

double zp_result_resolution(const ZpResult *result) {
  return result->resolution;
}

size_t zp_result_scalars(const ZpResult *result) {
  return result->scalars;
}

const ZpScalar *zp_result_scalar(const ZpResult *result, size_t index) {
  return index < result->scalars ? &result->scalar[index] : NULL;
}

size_t zp_result_sensitivities(const ZpResult *result) {
  return result->sensitivities;
}

const ZpSensitivity *zp_result_sensitivity(const ZpResult *result, size_t index) {
  return index < result->sensitivities ? &result->sensitivity[index] : NULL;
}

const ZpTable *zp_result_series(const ZpResult *result) {
  return result->series;
}

const ZpShapes *zp_result_shapes(const ZpResult *result) {
  return result->shapes;
}

const ZpFieldMap *zp_result_map(const ZpResult *result) {
  return result->map;
}

const ZpCheckpoint *zp_result_checkpoint(const ZpResult *result) {
  return result->checkpoint;
}
