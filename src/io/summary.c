/* summary.json: the results of a study, as one JSON object. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "io/json.h"
#include "io/plan.h"
#include "io/report.h"
#include "sample/statistics.h"
#include "study/result.h"

/* frequency_1_Hz, frequency_2_Hz, ..., and the like: scalars, so that a sweep has columns, but arrays in JSON. */
typedef struct List {
  ZpShows of;
  const char *name, *pattern; /* format of its scalars, for sscanf */
} List;

static const List lists[] = {{ZP_SHOWS_modes, "frequencies_Hz", "frequency_%d_Hz%n"},
                             {ZP_SHOWS_modes, "frequencies_error_Hz", "frequency_%d_error_Hz%n"},
                             {ZP_SHOWS_plan, "chosen_rows", "row_%d%n"},
                             {ZP_SHOWS_plan, "chosen_files", "file_%d%n"}};
enum { LISTS = sizeof lists / sizeof lists[0] };

static bool is_of(const List *list, ZpStudy study, const ZpScalar *scalar) {
  int mode, end = 0;
  return zp_study_shows(study) == list->of && sscanf(scalar->name, list->pattern, &mode, &end) == 1 && end > 0 &&
         !scalar->name[end];
}

/* The name of a key, for as long as the block around it. */
#define NAMED(scenario, key) zp_scenario_key(scenario, key, (char[ZP_PATH_SIZE]){0})

/* {output: {key: derivative}} */
static void put_sensitivity(ZpJson *json, const ZpScenario *scenario, const ZpResult *result) {
  const ZpSensitivity *s = result->sensitivity, *end = s + result->sensitivities;
  zp_json_open(json, "sensitivity", '{');
  for (const ZpSensitivity *first = s; first < end; first++) {
    const ZpSensitivity *before = s;
    while (before < first && strcmp(before->output, first->output) != 0)
      before++;
    if (before < first) continue; /* written with that one */
    zp_json_open(json, first->output, '{');
    for (const ZpSensitivity *k = first; k < end; k++)
      if (strcmp(k->output, first->output) == 0) zp_json_number(json, NAMED(scenario, k->key), k->value, "1");
    zp_json_close(json, '}');
  }
  zp_json_close(json, '}');
}

/* Groups that are open: "members.left." */
typedef struct Open {
  char path[ZP_PATH_SIZE];
} Open;

/* Close those that a name does not begin with. */
static void close_groups(ZpJson *json, Open *open, const char *name) {
  while (*open->path && strncmp(open->path, name, strlen(open->path)) != 0) {
    zp_json_close(json, '}');
    open->path[strlen(open->path) - 1] = 0;
    char *point = strrchr(open->path, '.');
    (point ? point + 1 : open->path)[0] = 0;
  }
}

/* Both ends of an interval are scalars, so that a sweep has columns, but an array in JSON: "#_interval_95_low" is
 * followed by "#_interval_95_high". */
static const char low_end[] = "_low", high_end[] = "_high", interval[] = "_interval_95";

static bool ends_with(const char *name, const char *end) {
  const size_t length = strlen(name), ending = strlen(end);
  return length > ending && strcmp(name + length - ending, end) == 0;
}

static bool is_low_end(const ZpScalar *scalar) {
  return ends_with(scalar->name, low_end) && strstr(scalar->name, interval);
}

static bool is_high_end(const ZpScalar *scalar) {
  return ends_with(scalar->name, high_end) && strstr(scalar->name, interval);
}

/* A number with points in its name is in groups: {"members": {"left": {"opening_m": ...}}}. */
static void put_nested(ZpJson *json, Open *open, const ZpScalar *scalar) {
  close_groups(json, open, scalar->name);
  const char *rest = scalar->name + strlen(open->path);
  for (const char *point = strchr(rest, '.'); point; rest = point + 1, point = strchr(rest, '.')) {
    char group[ZP_PATH_SIZE];
    snprintf(group, sizeof group, "%.*s", (int)(point - rest), rest);
    zp_json_open(json, group, '{');
    snprintf(open->path, sizeof open->path, "%.*s", (int)(point + 1 - scalar->name), scalar->name);
  }
  if (is_low_end(scalar)) {
    char name[ZP_PATH_SIZE];
    snprintf(name, sizeof name, "%.*s", (int)(strlen(rest) - strlen(low_end)), rest);
    zp_json_open(json, name, '[');
    for (int end = 0; end < 2; end++)
      zp_json_number(json, NULL, scalar[end].value, scalar->unit);
    zp_json_close(json, ']');
  } else {
    zp_json_number(json, rest, scalar->value, scalar->unit);
  }
}

/* Is it neither in a list nor the second number of an interval? */
static bool stands_alone(const ZpResult *result, const ZpScalar *scalar) {
  bool listed = false;
  for (size_t k = 0; k < LISTS; k++)
    listed |= is_of(&lists[k], result->study, scalar);
  return !listed && !is_high_end(scalar);
}

/* Has no scalar before it a name that begins with the same `length` letters? */
static bool is_first_of_group(const ZpResult *result, const ZpScalar *scalar, size_t length) {
  for (const ZpScalar *before = result->scalar; before < scalar; before++)
    if (strncmp(before->name, scalar->name, length) == 0) return false;
  return true;
}

/* All scalars of a group, the first one and those that follow: an object of JSON has each name once. */
static void put_group(ZpJson *json, Open *open, const ZpResult *result, const ZpScalar *first, size_t length) {
  for (const ZpScalar *scalar = first; scalar < result->scalar + result->scalars; scalar++)
    if (strncmp(scalar->name, first->name, length) == 0 && stands_alone(result, scalar)) put_nested(json, open, scalar);
}

static void put_scalars(ZpJson *json, const ZpScenario *scenario, const ZpResult *result) {
  const ZpScalar *end = result->scalar + result->scalars;
  for (size_t k = 0; k < LISTS; k++) {
    if (zp_study_shows(result->study) != lists[k].of) continue;
    zp_json_open(json, lists[k].name, '[');
    for (const ZpScalar *scalar = result->scalar; scalar < end; scalar++)
      if (is_of(&lists[k], result->study, scalar)) zp_json_number(json, NULL, scalar->value, scalar->unit);
    zp_json_close(json, ']');
  }
  Open open = {""};
  for (const ZpScalar *scalar = result->scalar; scalar < end; scalar++) {
    const size_t length = strcspn(scalar->name, ".");
    const bool grouped = scalar->name[length] != 0;
    if (!stands_alone(result, scalar)) continue;
    if (!grouped) put_nested(json, &open, scalar);
    if (grouped && is_first_of_group(result, scalar, length + 1)) put_group(json, &open, result, scalar, length + 1);
  }
  close_groups(json, &open, "");
  if (result->sensitivities > 0) put_sensitivity(json, scenario, result);
}

/* Largest number of different notes of all runs in the summary: notes with numbers may all differ, and each note is
 * compared with all others. */
enum { NOTES_MOST = 50 };

/* Different notes, copied. */
typedef struct Notes {
  char *text[NOTES_MOST + 1]; /* the last one refers to the rows */
  size_t count;
} Notes;

static void add_notes(ZpJson *json, Notes *notes, const ZpResult *result) {
  for (size_t i = 0; i < result->notes && notes->count <= NOTES_MOST; i++) {
    const char *note = notes->count < NOTES_MOST ? result->note[i] : "the rows have more notes";
    size_t known = 0;
    while (known < notes->count && strcmp(notes->text[known], result->note[i]) != 0)
      known++;
    if (known < notes->count) continue;
    notes->text[notes->count] = strdup(note);
    json->bad |= !notes->text[notes->count];
    notes->count += notes->text[notes->count] != NULL;
  }
}

static void put_notes(ZpJson *json, Notes *notes) {
  zp_json_open(json, "notes", '[');
  for (size_t i = 0; i < notes->count; i++) {
    zp_json_text(json, NULL, notes->text[i]);
    free(notes->text[i]);
  }
  zp_json_close(json, ']');
}

/* One run of a sweep. */
static void put_row(ZpJson *json, const ZpReport *report, size_t run) {
  size_t keys;
  const int *key = zp_scenario_lists(report->scenario, &keys);
  const ZpResult *result = zp_report_result(report, run);
  Notes notes = {.count = 0};
  double *value = calloc(keys + 1, sizeof *value);
  json->bad |= !value;
  if (value) zp_scenario_values(report->scenario, run, value);
  zp_json_open(json, NULL, '{');
  for (size_t i = 0; value && i < keys; i++)
    zp_json_key(json, NAMED(report->scenario, key[i]), key[i], value[i]);
  free(value);
  zp_json_text(json, "outcome", zp_outcome_name(result->outcome));
  zp_json_text(json, "message", result->message);
  put_scalars(json, report->scenario, result);
  add_notes(json, &notes, result);
  put_notes(json, &notes);
  zp_json_close(json, '}');
}

/* The outcome of the run that represents all: the first that failed, otherwise the first. */
static void put_outcome(ZpJson *json, const ZpReport *report) {
  const size_t cases = zp_scenario_count(report->scenario);
  size_t failed = 0;
  while (failed < report->count && zp_outcome_good(zp_report_result(report, failed)->outcome))
    failed++;
  const ZpResult *result = report->count > 0 ? zp_report_result(report, failed < report->count ? failed : 0) : NULL;
  char stopped[96] = "interrupted before the first run";
  if (result) snprintf(stopped, sizeof stopped, "stopped after %zu of %zu cases", report->count, cases);
  const bool partly = !result || report->count < cases;
  const ZpOutcome outcome = report->optimum ? report->optimum->outcome : partly ? ZP_INTERRUPTED : result->outcome;
  zp_json_text(json, "outcome", zp_outcome_name(outcome));
  zp_json_text(json, "message", report->optimum ? report->optimum->message : partly ? stopped : result->message);
  zp_json_number(json, "wall_time_s", report->wall_time, "s");
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

/* -- distributions of outputs over the samples of a campaign ------------------------------------------- */

/* Number of outputs that are read at once: a campaign may have more rows than fit into memory, and reading them takes
 * time. */
enum { COLUMNS = 8 };

typedef struct Samples {
  ZpCases cases;
  const ZpDesign *design;
  size_t count;       /* number of samples of a combination */
  double *value;      /* [COLUMNS][count] */
  ZpSample *work;     /* [count] */
  ZpIndices *indices; /* [dimensions] of a column */
} Samples;

/* Read columns `first` .. for the cases from `start` on. */
static void read_columns(const Samples *s, size_t first, size_t start) {
  for (size_t i = 0; i < s->count; i++) {
    const ZpResult *result = zp_report_result(s->cases.report, start + i);
    for (size_t k = 0; k < COLUMNS && first + k < s->cases.columns; k++)
      s->value[k * s->count + i] = zp_result_get(result, s->cases.column[first + k].name);
  }
}

/* An object per index, and one of its intervals, each with an entry per key. */
static void put_indices(ZpJson *json, const Samples *s, const double *value) {
  static const char *const name[] = {"first_order_indices", "first_order_interval_95", "total_indices",
                                     "total_interval_95"};
  const ZpScenario *scenario = s->cases.report->scenario;
  size_t keys;
  const int *key = zp_scenario_lists(scenario, &keys);
  for (int dimension = 0; dimension < s->design->dimensions; dimension++)
    s->indices[dimension] = zp_sobol_indices(s->design, value, dimension);
  for (size_t part = 0; part < sizeof name / sizeof name[0]; part++) {
    zp_json_open(json, name[part], '{');
    for (size_t i = 0, dimension = 0; i < keys; i++) {
      if (!zp_scenario_spread(scenario, key[i])) continue;
      const ZpIndices *indices = &s->indices[dimension++];
      const ZpIndex *index = part < 2 ? &indices->first : &indices->total;
      if (part % 2 == 0) {
        zp_json_number(json, NAMED(scenario, key[i]), index->value, "1");
        continue;
      }
      zp_json_open(json, NAMED(scenario, key[i]), '[');
      zp_json_number(json, NULL, index->low, "1");
      zp_json_number(json, NULL, index->high, "1");
      zp_json_close(json, ']');
    }
    zp_json_close(json, '}');
  }
}

static void describe(ZpJson *json, const char *output, const Samples *s, const double *value) {
  const ZpStatistics x = zp_statistics(s->design, value, s->work);
  zp_json_open(json, output, '{');
  zp_json_number(json, "count", (double)x.count, "count");
  zp_json_number(json, "missing", (double)x.missing, "count");
  for (int k = 0; k < ZP_STATISTICS; k++)
    zp_json_number(json, zp_statistic_name[k], x.number[k], "1");
  if (s->design->indices) put_indices(json, s, value);
  zp_json_close(json, '}');
}

/* The object of the combination whose samples start with case `start`. */
static void put_combination(ZpJson *json, const Samples *s, size_t start) {
  const ZpCases *cases = &s->cases;
  size_t keys;
  const int *key = zp_scenario_lists(cases->report->scenario, &keys);
  zp_json_open(json, NULL, '{');
  zp_scenario_values(cases->report->scenario, start, cases->value);
  for (size_t i = 0; i < keys; i++)
    if (!zp_scenario_spread(cases->report->scenario, key[i]))
      zp_json_key(json, NAMED(cases->report->scenario, key[i]), key[i], cases->value[i]);
  zp_json_open(json, "outputs", '{');
  for (size_t first = cases->keys; first < cases->columns; first += COLUMNS) {
    read_columns(s, first, start);
    for (size_t k = 0; k < COLUMNS && first + k < cases->columns; k++)
      describe(json, cases->column[first + k].name, s, s->value + k * s->count);
  }
  zp_json_close(json, '}');
  zp_json_close(json, '}');
}

static void open_samples(ZpJson *json, const ZpReport *report, Samples *s) {
  const ZpDesign *design = zp_scenario_design(report->scenario);
  *s = (Samples){.design = design, .count = zp_design_samples(design)};
  s->value = calloc(COLUMNS * s->count, sizeof *s->value);
  s->work = calloc(s->count, sizeof *s->work);
  s->indices = calloc((size_t)design->dimensions, sizeof *s->indices);
  json->bad |= !zp_cases_open(report, NULL, &s->cases) || !s->value || !s->work || !s->indices;
}

static void close_samples(Samples *s) {
  zp_cases_close(&s->cases);
  free(s->value);
  free(s->work);
  free(s->indices);
}

/* For an interrupted report only complete combinations. */
static void put_statistics(ZpJson *json, const ZpReport *report) {
  Samples s;
  open_samples(json, report, &s);
  zp_json_open(json, "statistics", '[');
  for (size_t start = 0; start + s.count <= report->count && !json->bad; start += s.count)
    put_combination(json, &s, start);
  zp_json_close(json, ']');
  close_samples(&s);
}

/* -- the best cases --------------------------------------------------------------------------------- */

/* Designs with samples, in the form of the statistics. */
static void put_best_designs(ZpJson *json, const ZpReport *report) {
  Samples s;
  open_samples(json, report, &s);
  for (size_t i = 0; i < report->optimum->count && !json->bad; i++)
    put_combination(json, &s, report->optimum->row[i]);
  close_samples(&s);
}

/* {"feasible": true, "cases": [...]}: the best cases, in the form of the rows. */
static void put_optimum(ZpJson *json, const ZpReport *report) {
  const ZpOptimum *optimum = report->optimum;
  const bool samples = zp_scenario_design(report->scenario) != NULL;
  zp_json_open(json, "optimum", '{');
  zp_json_bool(json, "feasible", optimum->feasible);
  zp_json_number(json, "excluded_share", optimum->excluded, "1");
  zp_json_open(json, "cases", '[');
  for (size_t i = 0; i < optimum->count && !samples; i++)
    put_row(json, report, optimum->row[i]);
  if (samples) put_best_designs(json, report);
  zp_json_close(json, ']');
  zp_json_close(json, '}');
}

/* -- the whole -------------------------------------------------------------------------------------- */

static ZpStatus write_summary(const ZpReport *report, bool flat, FILE *file, ZpError *err) {
  ZpJson json = {.file = file, .flat = flat};
  const ZpResult *single = zp_report_single(report);
  const bool sweep = zp_report_is_sweep(report);
  Notes notes = {.count = 0};
  zp_json_open(&json, NULL, '{');
  zp_json_text(&json, "version", ZP_VERSION);
  zp_json_text(&json, "study", zp_report_study(report));
  put_outcome(&json, report);
  if (single) put_scalars(&json, report->scenario, single);
  if (sweep) put_largest(&json, report);
  for (size_t i = 0; i < report->count; i++)
    add_notes(&json, &notes, zp_report_result(report, i));
  put_notes(&json, &notes);
  if (zp_scenario_design(report->scenario)) put_statistics(&json, report);
  if (report->optimum) put_optimum(&json, report);
  if (!flat && sweep) zp_json_open(&json, "rows", '[');
  for (size_t i = 0; i < report->count && !flat && sweep && !ferror(file) && !json.bad; i++)
    put_row(&json, report, i);
  if (!flat && sweep) zp_json_close(&json, ']');
  zp_json_close(&json, '}');
  return zp_json_finish(&json, err);
}

ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err) {
  ZpStatus status = write_summary(report, false, file, err);
  if (status != ZP_OK || !report->rows) return status;
  return report->rows->status(report->rows->user, err); /* status of all files so far */
}

ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err) {
  return write_summary(report, true, file, err);
}
