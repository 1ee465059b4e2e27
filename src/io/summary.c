/* summary.json: the results of a study, as one JSON object. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/cases.h"
#include "io/json.h"
#include "io/report.h"
#include "io/sampled.h"
#include "io/shows.h"
#include "io/summary.h"

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

static void put_list(ZpJson *json, const ZpResult *result, const List *list) {
  zp_json_open(json, list->name, '[');
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    if (is_of(list, scalar)) zp_json_number(json, NULL, scalar->value, scalar->unit);
  }
  zp_json_close(json, ']');
}

/* The derivatives of the output of derivative `first`, unless an earlier one has the same output. */
static void put_derivatives(ZpJson *json, const ZpResult *result, size_t first) {
  const char *output = result->sensitivity[first].output;
  for (size_t i = 0; i < first; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0) return;
  zp_json_open(json, output, '{');
  for (size_t i = first; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (strcmp(s->output, output) == 0) zp_json_number(json, zp_key(s->key)->name, s->value, "1");
  }
  zp_json_close(json, '}');
}

static void put_scalars(ZpJson *json, const ZpResult *result) {
  for (size_t k = 0; k < LISTS && zp_study_shows(result->study) == ZP_SHOWS_modes; k++)
    put_list(json, result, &lists[k]);
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    if (!is_listed(result, scalar)) zp_json_number(json, scalar->name, scalar->value, scalar->unit);
  }
  if (result->sensitivities == 0) return;
  zp_json_open(json, "sensitivity", '{');
  for (size_t i = 0; i < result->sensitivities; i++)
    put_derivatives(json, result, i);
  zp_json_close(json, '}');
}

/* Largest number of different notes of all runs in the summary: notes with numbers may all differ, and each note is
 * compared with all others. */
enum { NOTES_MOST = 50 };

/* The different notes of several runs, and whether there are more. */
typedef struct Notes {
  char note[NOTES_MOST][sizeof((ZpResult *)0)->note[0]];
  size_t count;
  bool more;
} Notes;

static void add_notes(Notes *notes, const ZpResult *result) {
  for (size_t i = 0; i < result->notes && !notes->more; i++) {
    size_t known = 0;
    while (known < notes->count && strcmp(notes->note[known], result->note[i]) != 0)
      known++;
    if (known < notes->count) continue;
    notes->more = known == NOTES_MOST;
    if (!notes->more) memcpy(notes->note[notes->count++], result->note[i], sizeof notes->note[0]);
  }
}

static void put_notes(ZpJson *json, const Notes *notes) {
  zp_json_open(json, "notes", '[');
  for (size_t i = 0; i < notes->count; i++)
    zp_json_text(json, NULL, notes->note[i]);
  if (notes->more) zp_json_text(json, NULL, "the rows have more notes");
  zp_json_close(json, ']');
}

void zp_json_key(ZpJson *json, const char *name, int key, double value) {
  const ZpKey *k = zp_key(key);
  if (k->type == ZP_KEY_BOOL)
    zp_json_bool(json, name, value != 0);
  else if (k->type == ZP_KEY_ENUM)
    zp_json_text(json, name, zp_key_word(key, value));
  else if (k->type == ZP_KEY_TEXT || (k->type == ZP_KEY_REAL_AUTO && isnan(value)))
    zp_json_text(json, name, k->text);
  else
    zp_json_number(json, name, value, k->type == ZP_KEY_INT ? "count" : k->unit);
}

/* One run of a sweep; `value` has room for its keys. */
static void put_row(ZpJson *json, const ZpReport *report, size_t run, double *value) {
  size_t keys;
  const int *key = zp_scenario_lists(report->scenario, &keys);
  const ZpResult *result = zp_report_result(report, run);
  Notes notes = {.count = 0};
  zp_scenario_values(report->scenario, run, value);
  zp_json_open(json, NULL, '{');
  for (size_t i = 0; i < keys; i++)
    zp_json_key(json, zp_key(key[i])->name, key[i], value[i]);
  zp_json_text(json, "outcome", zp_outcome_name(result->outcome));
  zp_json_text(json, "message", result->message);
  put_scalars(json, result);
  add_notes(&notes, result);
  put_notes(json, &notes);
  zp_json_close(json, '}');
}

/* The run that represents all: the first that failed, otherwise the first. NULL if there is none. Valid until the next
 * call. */
static const ZpResult *spokesman(const ZpReport *report) {
  for (size_t i = 0; i < report->count; i++)
    if (!zp_outcome_good(zp_report_result(report, i)->outcome)) return zp_report_result(report, i);
  return report->count > 0 ? zp_report_result(report, 0) : NULL;
}

static void put_outcome(ZpJson *json, ZpOutcome outcome, const char *message) {
  zp_json_text(json, "outcome", zp_outcome_name(outcome));
  zp_json_text(json, "message", message);
}

static void put_end(ZpJson *json, const ZpReport *report) {
  const ZpResult *result = spokesman(report);
  const size_t cases = zp_scenario_count(report->scenario);
  char message[96] = "interrupted before the first run";
  if (result) snprintf(message, sizeof message, "stopped after %zu of %zu cases", report->count, cases);
  if (report->optimum)
    put_outcome(json, report->optimum->outcome, report->optimum->message);
  else if (!result || report->count < cases)
    put_outcome(json, ZP_INTERRUPTED, message);
  else
    put_outcome(json, result->outcome, result->message);
  zp_json_number(json, "wall_time_s", report->wall_time, "s");
}

/* {"feasible": true, "cases": [...]}: the best cases, in the form of the rows. */
static void put_optimum(ZpJson *json, const ZpReport *report, double *value) {
  const ZpOptimum *optimum = report->optimum;
  zp_json_open(json, "optimum", '{');
  zp_json_bool(json, "feasible", optimum->feasible);
  zp_json_number(json, "excluded_share", optimum->excluded, "1");
  zp_json_open(json, "cases", '[');
  for (size_t i = 0; i < optimum->count; i++)
    put_row(json, report, optimum->row[i], value);
  zp_json_close(json, ']');
  zp_json_close(json, '}');
}

/* The numbers of a sweep as a whole. */
static void put_largest(ZpJson *json, const ZpReport *report) {
  static const struct {
    ZpStudy study;
    const char *name, *scalar, *where, *unit;
  } largest[] = {
#define ZP_LARGEST(enumerator, name, scalar, where, words, unit) {enumerator, name, scalar, where, unit},
#include <zipact/studies.def>
  };
  for (size_t i = 0; i < sizeof largest / sizeof largest[0] && report->count > 0; i++)
    if (zp_report_result(report, 0)->study == largest[i].study)
      zp_json_number(json, largest[i].name, zp_report_largest(report, largest[i].scalar, largest[i].where),
                     largest[i].unit);
}

static void put_all_notes(ZpJson *json, const ZpReport *report) {
  Notes notes = {.count = 0};
  for (size_t i = 0; i < report->count; i++)
    add_notes(&notes, zp_report_result(report, i));
  put_notes(json, &notes);
}

/* `rows`: with the rows of a sweep. `value` has room for its keys. */
static ZpStatus put_summary(ZpJson *json, const ZpReport *report, bool rows, double *value, ZpError *err) {
  const ZpResult *single = zp_report_single(report);
  ZpStatus status = ZP_OK;
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "version", ZP_VERSION);
  zp_json_text(json, "study", zp_report_study(report));
  put_end(json, report);
  if (single) put_scalars(json, single);
  if (zp_report_is_sweep(report)) put_largest(json, report);
  put_all_notes(json, report);
  if (zp_scenario_design(report->scenario)) status = zp_sample_statistics(json, report, err);
  if (report->optimum) put_optimum(json, report, value);
  if (rows) {
    zp_json_open(json, "rows", '[');
    for (size_t i = 0; i < report->count; i++)
      put_row(json, report, i, value);
    zp_json_close(json, ']');
  }
  zp_json_close(json, '}');
  return status;
}

static ZpStatus write_summary(const ZpReport *report, bool line, FILE *file, ZpError *err) {
  size_t keys;
  ZpJson json = {.file = file, .flat = line};
  zp_scenario_lists(report->scenario, &keys);
  double *value = calloc(keys + 1, sizeof *value);
  if (!value) return zp_fail_memory(err);
  ZpStatus status = put_summary(&json, report, !line && zp_report_is_sweep(report), value, err);
  free(value);
  return status == ZP_OK ? zp_json_end(&json, "summary.json", err) : status;
}

ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err) {
  ZpStatus status = write_summary(report, false, file, err);
  if (status == ZP_OK && report->rows)
    status = report->rows->status(report->rows->user, err); /* status of all files so far */
  return status;
}

ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err) {
  return write_summary(report, true, file, err);
}

ZpStatus zp_error_write_line(const ZpError *error, FILE *file, ZpError *err) {
  ZpJson json = {.file = file, .flat = true};
  zp_json_open(&json, NULL, '{');
  zp_json_text(&json, "error", error->message);
  zp_json_close(&json, '}');
  return zp_json_end(&json, "the error", err);
}
