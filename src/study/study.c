/* Which study is run, and the parts of a result that all studies share. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "study/studies.h"

ZpStatus zp_study_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err) {
  return zp_study_run_with(def, &(ZpStudyInput){0}, hooks, out, err);
}

ZpStatus zp_study_run_with(const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks, ZpResult **out,
                           ZpError *err) {
  *out = NULL;
  ZpStatus status = zp_def_check(def, err);
  if (status != ZP_OK) return status;
  ZpResult *result = zp_result_create();
  if (!result) return zp_fail_memory(err);
  result->study = def->study;
  switch (def->study) {
  case ZP_STUDY_STATIONARY:
    status = zp_study_stationary(def, hooks, result, err);
    break;
  case ZP_STUDY_EQUILIBRIUM:
    status = zp_study_equilibrium(def, hooks, result, err);
    break;
  case ZP_STUDY_MODES:
    status = zp_study_modes(def, hooks, result, err);
    break;
  case ZP_STUDY_ISOMETRIC:
    status = zp_study_isometric(def, hooks, result, err);
    break;
  case ZP_STUDY_PROFILE:
    status = zp_study_profile(def, hooks, result, err);
    break;
  case ZP_STUDY_CALIBRATE: /* needs a file */
    status = zp_fail(err, ZP_BAD_INPUT, "study = calibrate: run by zp_data_study_run of zipact/calibrate.h");
    break;
  case ZP_STUDY_ACTUATE:
  case ZpStudy_COUNT:
    status = zp_study_actuate(def, input, hooks, result, err);
    break;
  }
  if (status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}

ZpResult *zp_result_create(void) {
  return zp_calloc(1, sizeof(ZpResult));
}

void zp_result_destroy(ZpResult *result) {
  if (!result) return;
  zp_table_destroy(result->series);
  zp_shapes_destroy(result->shapes);
  zp_field_map_destroy(result->map);
  zp_checkpoint_destroy(result->checkpoint);
  zp_free(result);
}

static size_t carve_map(ZpFieldMap *map, void *block) {
  ZpCarver carver = {block, 0};
  size_t cells = (map->nx - 1) * (map->ny - 1);
  double **of_nodes[] = {&map->x, &map->y, &map->potential}, **of_cells[] = {&map->strength, &map->permittivity};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_carve(&carver, map->nx * map->ny);
  for (size_t k = 0; k < sizeof of_cells / sizeof of_cells[0]; k++)
    *of_cells[k] = zp_carve(&carver, cells);
  return carver.used;
}

ZpFieldMap *zp_field_map_create(size_t nx, size_t ny) {
  ZpFieldMap *map = zp_calloc(1, sizeof *map);
  if (!map) return NULL;
  *map = (ZpFieldMap){.nx = nx, .ny = ny};
  map->memory = zp_calloc(1, carve_map(map, NULL));
  if (!map->memory) {
    zp_free(map);
    return NULL;
  }
  carve_map(map, map->memory);
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

void zp_result_add(ZpResult *result, const char *name, const char *unit, double value) {
  result->scalar[result->scalars++] = (ZpScalar){name, unit, value, false};
}

void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value) {
  result->scalar[result->scalars++] = (ZpScalar){name, unit, value, true};
}

void zp_result_note(ZpResult *result, const char *format, ...) {
  if (result->notes == ZP_MAX_NOTES) return;
  va_list args;
  va_start(args, format);
  vsnprintf(result->note[result->notes++], sizeof result->note[0], format, args);
  va_end(args);
}
