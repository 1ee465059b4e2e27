/* Results of the library => structs. */
#include "binding.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* -- structs ------------------------------------------------------------------------------------------- */

mxArray *new_struct(void) {
  return mxCreateStructMatrix(1, 1, 0, NULL);
}

void set(mxArray *structs, size_t index, const char *name, mxArray *value) {
  enum { LONGEST_NAME = 63 }; /* of MATLAB */
  char field[LONGEST_NAME + 1];
  snprintf(field, sizeof field, "%s", name);
  for (char *c = field; *c; c++)
    if (!isalnum((unsigned char)*c)) *c = '_';
  int number = mxGetFieldNumber(structs, field);
  if (number < 0) number = mxAddField(structs, field);
  mxDestroyArray(mxGetFieldByNumber(structs, index, number)); /* previous value, if any */
  mxSetFieldByNumber(structs, index, number, value);
}

mxArray *new_matrix(size_t rows, size_t columns, const double *value) {
  mxArray *matrix = mxCreateDoubleMatrix(rows, columns, mxREAL);
  if (value && rows && columns) memcpy(mxGetPr(matrix), value, rows * columns * sizeof *value);
  return matrix;
}

/* -- keys ---------------------------------------------------------------------------------------------- */

/* A value in a form that zipact accepts again. */
static mxArray *key_value(const ZpKey *key, double value, const char *text) {
  if (key->type == ZP_KEY_TEXT) return mxCreateString(text);
  if (key->type == ZP_KEY_ENUM) return mxCreateString(key->choices[(int)value].word);
  if (key->type == ZP_KEY_BOOL) return mxCreateLogicalScalar(value != 0);
  if (isnan(value)) return mxCreateString(key->text);
  return mxCreateDoubleScalar(value);
}

static mxArray *words_of(const ZpKey *key) {
  size_t count = key->type == ZP_KEY_ENUM ? (size_t)key->max + 1 : 0;
  mxArray *words = mxCreateCellMatrix(1, count);
  for (size_t i = 0; i < count; i++)
    mxSetCell(words, i, mxCreateString(key->choices[i].word));
  return words;
}

mxArray *keys_struct(void) {
  size_t count = (size_t)zp_key_count();
  mxArray *keys = mxCreateStructMatrix(count, 1, 0, NULL);
  for (size_t i = 0; i < count; i++) {
    const ZpKey *key = zp_key((int)i);
    set(keys, i, "name", mxCreateString(key->name));
    set(keys, i, "unit", mxCreateString(key->unit));
    set(keys, i, "default", key_value(key, key->def, key->text));
    set(keys, i, "min", mxCreateDoubleScalar(key->min));
    set(keys, i, "max", mxCreateDoubleScalar(key->max));
    set(keys, i, "choices", words_of(key));
    set(keys, i, "help", mxCreateString(key->help));
  }
  return keys;
}

/* Set what `name` says: "lower.ribbon.thickness" is a field of structs[index].lower.ribbon. */
static void set_inside(mxArray *structs, size_t index, const char *name, mxArray *value) {
  const char *dot;
  for (; (dot = strchr(name, '.')); name = dot + 1, index = 0) {
    char group[32];
    snprintf(group, sizeof group, "%.*s", (int)(dot - name), name);
    if (!mxGetField(structs, index, group)) set(structs, index, group, new_struct());
    structs = mxGetField(structs, index, group);
  }
  set(structs, index, name, value);
}

/* All keys, with groups as structs, in a form that zipact accepts, too. */
static mxArray *definition_struct(ZpStudy study, const ZpActuatorDef *def) {
  mxArray *all = new_struct();
  for (int i = zp_def_next_key(def, -1); i >= 0; i = zp_def_next_key(def, i)) {
    const ZpKey *key = zp_key(i);
    char name[ZP_KEY_NAME_SIZE];
    mxArray *value = key_value(key, zp_key_in_def(i) ? zp_def_get(def, i) : (double)study, zp_def_text(def, i));
    set_inside(all, 0, zp_key_name(i, name), value);
  }
  return all;
}

/* -- tables, shapes, maps ------------------------------------------------------------------------------- */

static mxArray *series_struct(const ZpTable *table) {
  mxArray *series = new_struct();
  for (size_t i = 0; i < zp_table_columns(table); i++) {
    mxArray *column = new_matrix(zp_table_rows(table), 1, NULL);
    for (size_t row = 0; row < zp_table_rows(table); row++)
      mxGetPr(column)[row] = zp_table_row(table, row)[i];
    set(series, 0, zp_table_column(table, i)->name, column);
  }
  return series;
}

/* [nodes x ribbons x frames] */
static mxArray *new_film(size_t nodes, size_t ribbons, size_t frames) {
  return mxCreateNumericArray(3, (mwSize[]){nodes, ribbons, frames}, mxDOUBLE_CLASS, mxREAL);
}

static void put_frame(mxArray *film, size_t frame, size_t nodes, size_t ribbons, const double *value) {
  double *to = mxGetPr(film) + frame * nodes * ribbons;
  for (size_t node = 0; node < nodes; node++)
    for (size_t ribbon = 0; ribbon < ribbons; ribbon++)
      to[ribbon * nodes + node] = value[node * ribbons + ribbon];
}

mxArray *shapes_struct(const ZpShapes *film) {
  size_t n = zp_shapes_nodes(film), ribbons = zp_shapes_ribbons(film), frames = zp_shapes_frames(film);
  mxArray *time = new_matrix(frames, 1, NULL), *voltage = new_matrix(frames, 1, NULL);
  mxArray *zipped = new_matrix(frames, 1, NULL);
  mxArray *x = new_film(n, ribbons, frames), *y = new_film(n, ribbons, frames);
  mxArray *gap = new_matrix(n, frames, NULL), *force = new_matrix(n, frames, NULL);
  mxArray *field = new_matrix(n, frames, NULL), *stress = new_film(n, ribbons, frames);
  ZpShape first = frames ? zp_shapes_get(film, 0) : (ZpShape){0}; /* all have the same arrays */
  for (size_t i = 0; i < frames; i++) {
    ZpShape shape = zp_shapes_get(film, i);
    mxGetPr(time)[i] = shape.time;
    mxGetPr(voltage)[i] = shape.voltage;
    mxGetPr(zipped)[i] = (double)shape.zipped;
    put_frame(x, i, n, ribbons, shape.x);
    put_frame(y, i, n, ribbons, shape.y);
    if (first.gap) put_frame(gap, i, n, 1, shape.gap);
    if (first.gap) put_frame(force, i, n, 1, shape.line_force);
    if (first.gap) put_frame(field, i, n, 1, shape.insulator_field);
    if (first.stress) put_frame(stress, i, n, ribbons, shape.stress);
  }
  mxArray *shapes = new_struct();
  set(shapes, 0, "time_s", time);
  set(shapes, 0, "voltage_V", voltage);
  set(shapes, 0, "zipped", zipped);
  set(shapes, 0, "x_m", x);
  set(shapes, 0, "y_m", y);
  if (first.gap) set(shapes, 0, "gap_m", gap);
  if (first.gap) set(shapes, 0, "line_force_N_per_m", force);
  if (first.gap) set(shapes, 0, "insulator_field_V_per_m", field);
  if (first.stress) set(shapes, 0, "stress_Pa", stress);
  return shapes;
}

/* Rows are upwards, columns along the ribbons, as in meshgrid. */
static mxArray *map_struct(const ZpFieldMap *map) {
  mxArray *field = new_struct();
  set(field, 0, "x_m", new_matrix(map->ny, map->nx, map->x));
  set(field, 0, "y_m", new_matrix(map->ny, map->nx, map->y));
  set(field, 0, "potential_V", new_matrix(map->ny, map->nx, map->potential));
  set(field, 0, "strength_V_per_m", new_matrix(map->ny - 1, map->nx - 1, map->strength));
  set(field, 0, "permittivity", new_matrix(map->ny - 1, map->nx - 1, map->permittivity));
  return field;
}

/* -- results ------------------------------------------------------------------------------------------- */

static mxArray *notes_cell(const ZpResult *result) {
  mxArray *notes = mxCreateCellMatrix(zp_result_notes(result), zp_result_notes(result) > 0);
  for (size_t i = 0; i < zp_result_notes(result); i++)
    mxSetCell(notes, i, mxCreateString(zp_result_note_text(result, i)));
  return notes;
}

/* For each output a struct of its derivatives. */
static mxArray *sensitivity_struct(const ZpResult *result) {
  mxArray *all = new_struct();
  for (size_t i = 0; i < zp_result_sensitivities(result); i++) {
    const ZpSensitivity *s = zp_result_sensitivity(result, i);
    if (mxGetFieldNumber(all, s->output) < 0) set(all, 0, s->output, new_struct());
    char key[ZP_KEY_NAME_SIZE];
    set(mxGetField(all, 0, s->output), 0, zp_key_name(s->key, key), mxCreateDoubleScalar(s->value));
  }
  return all;
}

/* frequency_1_Hz, ... together, as in summary.json; false if it is none of them. */
static bool set_frequency(mxArray *structs, size_t index, const ZpScalar *scalar) {
  static const char name[] = "frequencies_Hz";
  int mode, end = 0;
  if (sscanf(scalar->name, "frequency_%d_Hz%n", &mode, &end) != 1 || !end) return false;
  const mxArray *before = mxGetField(structs, index, name);
  size_t count = before ? mxGetNumberOfElements(before) : 0;
  mxArray *all = new_matrix(count + 1, 1, NULL);
  if (count) memcpy(mxGetPr(all), mxGetPr(before), count * sizeof(double));
  mxGetPr(all)[count] = scalar->value;
  set(structs, index, name, all);
  return true;
}

void set_result(mxArray *structs, size_t index, const ZpResult *result, const ZpActuatorDef *def) {
  set(structs, index, "study", mxCreateString(zp_study_name(zp_result_study(result))));
  set(structs, index, "outcome", mxCreateString(zp_outcome_name(zp_result_outcome(result))));
  set(structs, index, "good", mxCreateLogicalScalar(zp_outcome_good(zp_result_outcome(result))));
  set(structs, index, "message", mxCreateString(zp_result_message(result)));
  set(structs, index, "notes", notes_cell(result));
  for (size_t i = 0; i < zp_result_scalars(result); i++) {
    const ZpScalar *scalar = zp_result_scalar(result, i);
    if (!set_frequency(structs, index, scalar))
      set_inside(structs, index, scalar->name, mxCreateDoubleScalar(scalar->value));
  }
  if (zp_result_sensitivities(result) > 0) set(structs, index, "sensitivity", sensitivity_struct(result));
  if (zp_result_series(result)) set(structs, index, "series", series_struct(zp_result_series(result)));
  if (zp_result_shapes(result)) set(structs, index, "shapes", shapes_struct(zp_result_shapes(result)));
  if (zp_result_map(result)) set(structs, index, "field", map_struct(zp_result_map(result)));
  set(structs, index, "definition", definition_struct(zp_result_study(result), def));
}
