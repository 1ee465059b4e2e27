/* Functions that read a report. */
#include "io/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/def.h"
#include "io/file.h"
#include "io/plan.h"
#include "study/result.h"

bool zp_report_is_sweep(const ZpReport *report) {
  size_t lists = 0;
  zp_scenario_lists(report->scenario, &lists);
  return lists > 0 || report->count > 1;
}

const ZpResult *zp_report_result(const ZpReport *report, size_t index) {
  return report->rows ? report->rows->get(report->rows->user, index) : report->result[index];
}

const ZpResult *zp_report_single(const ZpReport *report) {
  return report->count > 0 && !zp_report_is_sweep(report) ? zp_report_result(report, 0) : NULL;
}

double zp_report_largest(const ZpReport *report, const char *scalar, const char *where) {
  double largest = NAN;
  for (size_t i = 0; i < report->count; i++) {
    const ZpResult *row = zp_report_result(report, i);
    if (zp_result_get(row, where) == 1) largest = fmax(largest, zp_result_get(row, scalar));
  }
  return largest;
}

const char *zp_report_study(const ZpReport *report) {
  return zp_study_name(report->count > 0 ? zp_report_result(report, 0)->study : zp_scenario_study(report->scenario));
}

static void add_column(ZpCases *cases, const char *name, const char *unit, const char *help) {
  ZpCaseColumn *column = &cases->column[cases->columns++];
  *column = (ZpCaseColumn){.unit = unit, .help = help};
  snprintf(column->name, sizeof column->name, "%s", name);
}

/* Append the scalars of a result that are no columns yet. False if there is no memory. */
static bool add_scalars(ZpCases *cases, const ZpResult *result) {
  ZpCaseColumn *column = realloc(cases->column, (cases->columns + result->scalars + 1) * sizeof *column);
  if (!column) return false;
  cases->column = column;
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    size_t known = cases->keys;
    while (known < cases->columns && strcmp(column[known].name, scalar->name) != 0)
      known++;
    if (scalar->timing || known < cases->columns) continue;
    add_column(cases, scalar->name, scalar->unit, NULL);
  }
  return true;
}

bool zp_cases_open(const ZpReport *report, const ZpTable *series, ZpCases *cases) {
  *cases = (ZpCases){.report = report, .series = series, .rows = series ? series->rows : report->count};
  const int *key = zp_scenario_lists(report->scenario, &cases->keys);
  if (series) cases->keys = 0;
  const size_t first = series ? series->columns : cases->keys;
  cases->column = calloc(first + 1, sizeof *cases->column);
  bool done = cases->column != NULL;
  for (size_t i = 0; done && i < first; i++) {
    char name[ZP_KEY_COLUMN_SIZE];
    if (series) {
      add_column(cases, series->column[i].name, series->column[i].unit, series->column[i].help);
      continue;
    }
    zp_key_column(report->scenario, key[i], name, sizeof name);
    add_column(cases, name, zp_key(key[i])->unit, zp_key(key[i])->help);
  }
  for (size_t i = 0; i < report->count && done && !series; i++)
    done = add_scalars(cases, zp_report_result(report, i));
  cases->value = done ? calloc(cases->columns + 1, sizeof *cases->value) : NULL;
  return cases->value != NULL;
}

void zp_cases_close(ZpCases *cases) {
  free(cases->column);
  free(cases->value);
}

const ZpResult *zp_cases_read(const ZpCases *cases, size_t row) {
  if (cases->series) {
    memcpy(cases->value, zp_table_row(cases->series, row), cases->columns * sizeof *cases->value);
    return NULL;
  }
  const ZpResult *result = zp_report_result(cases->report, row);
  zp_scenario_values(cases->report->scenario, row, cases->value);
  for (size_t i = 0; i < cases->columns - cases->keys; i++) {
    const char *name = cases->column[cases->keys + i].name;
    const bool here = i < result->scalars && strcmp(result->scalar[i].name, name) == 0; /* in most results */
    cases->value[cases->keys + i] = here ? result->scalar[i].value : zp_result_get(result, name);
  }
  return result;
}

const ZpShapeArray zp_shape_arrays[] = {
    {"x", "m", "horizontal position of a node; [frame][ribbon][node]", true, offsetof(ZpShape, x)},
    {"y", "m", "height of a node; [frame][ribbon][node]", true, offsetof(ZpShape, y)},
    {"gap", "m", "distance between the faces; [frame][node]", false, offsetof(ZpShape, gap)},
    {"line_force", "N/m", "attraction per length; [frame][node]", false, offsetof(ZpShape, line_force)},
    {"insulator_field", "V/m", "field in the insulators; [frame][node]", false, offsetof(ZpShape, insulator_field)},
    {"stress", "Pa", "largest stress of the metal in the section; [frame][ribbon][node]", true,
     offsetof(ZpShape, stress)},
    {0},
};

const double *zp_shape_array(const ZpShape *shape, const ZpShapeArray *array) {
  return *(const double *const *)((const char *)shape + array->offset);
}

size_t zp_result_numbers(const ZpResult *result) {
  size_t numbers = 0;
  if (result->series) numbers += result->series->rows * result->series->columns;
  for (int k = 0; k < ZP_FURTHER; k++)
    if (result->further[k]) numbers += result->further[k]->rows * result->further[k]->columns;
  if (result->shapes) numbers += result->shapes->frames * result->shapes->frame_size;
  if (result->map) numbers += 5 * result->map->nx * result->map->ny;
  return numbers;
}

/* Measured for HDF5, which needs most: it keeps up to 32 MB of freed memory; for a run the offsets of its columns; and
 * all numbers as the file in memory, twice while that grows. */
size_t zp_report_room(size_t runs, size_t numbers) {
  const size_t base = 1 << 23, kept = 1 << 25, kept_of_run = 340000, places_of_run = 60000;
  return base + (runs < kept / kept_of_run ? runs * kept_of_run : kept) + runs * places_of_run +
         2 * sizeof(double) * numbers;
}

void zp_key_column(const ZpScenario *scenario, int key, char *text, size_t size) {
  const ZpKey *k = zp_key(key);
  bool bare = strcmp(k->unit, "1") == 0;
  size_t used = (size_t)snprintf(text, size, "%s%s",
                                 scenario ? zp_scenario_key(scenario, key, (char[ZP_PATH_SIZE]){0}) : ZP_KEY_NAME(key),
                                 bare ? "" : "_");
  for (const char *c = k->unit; !bare && *c && used + 6 < size; c++) {
    const char part[2] = {*c == ' ' ? '_' : *c, 0};
    used += (size_t)snprintf(text + used, size - used, "%s", *c == '/' ? "_per_" : part);
  }
}

const char *zp_key_word(int key, double value) {
  const ZpKey *k = zp_key(key);
  if (k->type == ZP_KEY_BOOL) return value != 0 ? "true" : "false";
  return k->type == ZP_KEY_ENUM ? k->choices[(int)value].word : NULL;
}

static ZpStatus put_scenario(const void *scenario, FILE *file, ZpError *err) {
  return zp_scenario_write(scenario, file, err);
}

ZpStatus zp_scenario_text(const ZpScenario *scenario, char **text, size_t *size, ZpError *err) {
  return zp_text_put(put_scenario, scenario, text, size, err);
}

static const struct {
  ZpShows shows;
  const char *word;
} of[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help) [enumerator] = {ZP_SHOWS_##shows, #shows},
#include <zipact/studies.def>
};

ZpShows zp_study_shows(ZpStudy study) {
  return of[study].shows;
}

const char *zp_study_kind(ZpStudy study) {
  return of[study].word;
}
