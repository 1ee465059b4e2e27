/* summary.json: the results of a study, as one JSON object. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/cases.h"
#include "io/json.h"
#include "io/report.h"
#include "io/shows.h"
#include "io/summary.h"
#include "study/result.h"

/* frequency_1_Hz, frequency_2_Hz, ..., and their errors: scalars, so that a sweep has columns, but arrays in JSON. */
typedef struct List {
  const char *name, *pattern; /* format of its scalars, for sscanf */
} List;

static const List lists[] = {{"frequencies_Hz", "frequency_%d_Hz%n"},
                             {"frequencies_error_Hz", "frequency_%d_error_Hz%n"}};
enum { LISTS = sizeof lists / sizeof lists[0] };

static bool is_of(const List *list, const ZpScalar *scalar) {
  int mode, end = 0;
  return sscanf(scalar->name, list->pattern, &mode, &end) == 1 && end > 0 && !scalar->name[end];
}

static bool is_listed(const ZpResult *result, const ZpScalar *scalar) {
  bool any = false;
  for (size_t k = 0; k < LISTS && zp_study_shows(result->study) == ZP_SHOWS_modes; k++)
    any |= is_of(&lists[k], scalar);
  return any;
}

static json_t *list_of(const ZpResult *result, const List *list) {
  json_t *array = json_array();
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    if (is_of(list, scalar)) zp_json_add(&array, zp_json_number(scalar->value, scalar->unit));
  }
  return array;
}

/* {output: {key: derivative}} */
static json_t *sensitivity_of(const ZpResult *result) {
  json_t *all = json_object();
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (!json_object_get(all, s->output)) zp_json_set(&all, s->output, json_object());
    json_t *by = json_object_get(all, s->output);
    if (json_object_set_new(by, zp_key(s->key)->name, zp_json_number(s->value, "1"))) zp_json_drop(&all);
  }
  return all;
}

static void set_scalars(json_t **object, const ZpResult *result) {
  for (size_t k = 0; k < LISTS && zp_study_shows(result->study) == ZP_SHOWS_modes; k++)
    zp_json_set(object, lists[k].name, list_of(result, &lists[k]));
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    if (!is_listed(result, scalar)) zp_json_set(object, scalar->name, zp_json_number(scalar->value, scalar->unit));
  }
  if (result->sensitivities > 0) zp_json_set(object, "sensitivity", sensitivity_of(result));
}

/* Largest number of different notes of all runs in the summary: notes with numbers may all differ, and each note is
 * compared with all others. */
enum { NOTES_MOST = 50 };

/* Add the new notes of a run to the array, up to NOTES_MOST, and a last one that refers to the rows. */
static void add_notes(json_t **array, const ZpResult *result) {
  for (size_t i = 0; i < result->notes && json_array_size(*array) <= NOTES_MOST; i++) {
    bool known = false;
    for (size_t k = 0; k < json_array_size(*array) && !known; k++)
      known = strcmp(json_string_value(json_array_get(*array, k)), result->note[i]) == 0;
    const char *note = json_array_size(*array) < NOTES_MOST ? result->note[i] : "the rows have more notes";
    if (!known) zp_json_add(array, json_string(note));
  }
}

json_t *zp_json_key(int key, double value) {
  const ZpKey *k = zp_key(key);
  if (k->type == ZP_KEY_BOOL) return json_boolean(value != 0);
  if (k->type == ZP_KEY_ENUM) return json_string(zp_key_word(key, value));
  if (k->type == ZP_KEY_REAL_AUTO && isnan(value)) return json_string(k->text);
  return zp_json_number(value, k->type == ZP_KEY_INT ? "count" : k->unit);
}

/* One run of a sweep: a ZpJsonItem. */
static json_t *row_of(const void *user, size_t run) {
  const ZpReport *report = user;
  size_t keys;
  const int *key = zp_scenario_lists(report->scenario, &keys);
  const ZpResult *result = zp_report_result(report, run);
  double *value = calloc(keys + 1, sizeof *value);
  if (!value) return NULL;
  zp_scenario_values(report->scenario, run, value);
  json_t *row = json_object(), *notes = json_array();
  for (size_t i = 0; i < keys; i++)
    zp_json_set(&row, zp_key(key[i])->name, zp_json_key(key[i], value[i]));
  free(value);
  zp_json_set(&row, "outcome", json_string(zp_outcome_name(result->outcome)));
  zp_json_set(&row, "message", json_string(result->message));
  set_scalars(&row, result);
  add_notes(&notes, result);
  zp_json_set(&row, "notes", notes);
  return row;
}

/* The run that represents all: the first that failed, otherwise the first. NULL if there is none. Valid until the next
 * call. */
static const ZpResult *spokesman(const ZpReport *report) {
  for (size_t i = 0; i < report->count; i++)
    if (!zp_outcome_good(zp_report_result(report, i)->outcome)) return zp_report_result(report, i);
  return report->count > 0 ? zp_report_result(report, 0) : NULL;
}

static void set_end(json_t **object, ZpOutcome outcome, const char *message, double wall_time) {
  zp_json_set(object, "outcome", json_string(zp_outcome_name(outcome)));
  zp_json_set(object, "message", json_string(message));
  zp_json_set(object, "wall_time_s", zp_json_number(wall_time, "s"));
}

static void set_outcome(json_t **object, const ZpReport *report) {
  const ZpResult *result = spokesman(report);
  const size_t cases = zp_scenario_count(report->scenario);
  char message[96] = "interrupted before the first run";
  if (result) snprintf(message, sizeof message, "stopped after %zu of %zu cases", report->count, cases);
  if (report->optimum)
    set_end(object, report->optimum->outcome, report->optimum->message, report->wall_time);
  else if (!result || report->count < cases)
    set_end(object, ZP_INTERRUPTED, message, report->wall_time);
  else
    set_end(object, result->outcome, result->message, report->wall_time);
}

/* {"feasible": true, "cases": [...]}: the best cases, in the form of the rows. */
static json_t *optimum_of(const ZpReport *report) {
  const ZpOptimum *optimum = report->optimum;
  json_t *object = json_object(), *cases = json_array();
  zp_json_set(&object, "feasible", json_boolean(optimum->feasible));
  zp_json_set(&object, "excluded_share", zp_json_number(optimum->excluded, "1"));
  for (size_t i = 0; i < optimum->count; i++)
    zp_json_add(&cases, row_of(report, optimum->row[i]));
  zp_json_set(&object, "cases", cases);
  return object;
}

/* The numbers of a sweep as a whole. */
static void set_largest(json_t **object, const ZpReport *report) {
  static const struct {
    ZpStudy study;
    const char *name, *scalar, *where, *unit;
  } largest[] = {
#define ZP_LARGEST(enumerator, name, scalar, where, words, unit) {enumerator, name, scalar, where, unit},
#include <zipact/studies.def>
  };
  for (size_t i = 0; i < sizeof largest / sizeof largest[0] && report->count > 0; i++)
    if (zp_report_result(report, 0)->study == largest[i].study) {
      double value = zp_report_largest(report, largest[i].scalar, largest[i].where);
      zp_json_set(object, largest[i].name, zp_json_number(value, largest[i].unit));
    }
}

static json_t *summary_of(const ZpReport *report) {
  const ZpResult *single = zp_report_single(report);
  json_t *object = json_object(), *notes = json_array();
  zp_json_set(&object, "version", json_string(ZP_VERSION));
  zp_json_set(&object, "study", json_string(zp_report_study(report)));
  set_outcome(&object, report);
  if (single) set_scalars(&object, single);
  if (zp_report_is_sweep(report)) set_largest(&object, report);
  for (size_t i = 0; i < report->count; i++)
    add_notes(&notes, zp_report_result(report, i));
  zp_json_set(&object, "notes", notes);
  if (zp_scenario_design(report->scenario)) zp_json_set(&object, "statistics", zp_sample_statistics(report));
  if (report->optimum) zp_json_set(&object, "optimum", optimum_of(report));
  return object;
}

static ZpStatus write_summary(const ZpReport *report, bool flat, FILE *file, ZpError *err) {
  json_t *summary = summary_of(report);
  if (!summary) return zp_fail_memory(err);
  ZpStatus status = !flat && zp_report_is_sweep(report)
                        ? zp_json_write_list(summary, "rows", report->count, row_of, report, file, err)
                        : zp_json_write(summary, flat, file, err);
  json_decref(summary);
  return status;
}

ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err) {
  ZpStatus status = write_summary(report, false, file, err);
  if (status != ZP_OK || !report->rows) return status;
  return report->rows->status(report->rows->user, err); /* status of all files so far */
}

ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err) {
  return write_summary(report, true, file, err);
}
