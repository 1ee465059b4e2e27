/* "statistics" of summary.json: the distributions of outputs over the samples of a campaign. */
#include <math.h>
#include <stdlib.h>

#include "def/def.h"
#include "io/cases.h"
#include "io/report.h"
#include "io/summary.h"
#include "sample/statistics.h"

/* Number of outputs that are read at once: a campaign may have more rows than fit into memory, and reading them takes
 * time. */
enum { COLUMNS = 8 };

typedef struct Samples {
  ZpCases cases;
  const ZpDesign *design;
  size_t count;  /* number of samples of a combination */
  double *value; /* [COLUMNS][count] */
  double *work;  /* [count] */
} Samples;

/* Read columns `first` .. for the cases from `start` on. */
static void read_columns(Samples *s, size_t first, size_t start) {
  for (size_t i = 0; i < s->count; i++) {
    const ZpResult *result = zp_report_result(s->cases.report, start + i);
    for (size_t k = 0; k < COLUMNS && first + k < s->cases.columns; k++)
      s->value[k * s->count + i] = zp_result_get(result, s->cases.column[first + k].name);
  }
}

/* Two bounds. */
static json_t *interval(const ZpIndex *index) {
  json_t *pair = json_array();
  zp_json_add(&pair, zp_json_number(index->low, "1"));
  zp_json_add(&pair, zp_json_number(index->high, "1"));
  return pair;
}

/* An object per index, and one of its intervals, each with an entry per key. */
static void set_indices(json_t **object, const Samples *s, const double *value) {
  json_t *first = json_object(), *first_interval = json_object(), *total = json_object(),
         *total_interval = json_object();
  size_t keys;
  const int *key = zp_scenario_lists(s->cases.report->scenario, &keys);
  int dimension = 0;
  for (size_t i = 0; i < keys; i++) {
    if (!zp_scenario_spread(s->cases.report->scenario, key[i])) continue;
    const ZpIndices indices = zp_sobol_indices(s->design, value, dimension++);
    const char *name = zp_key(key[i])->name;
    zp_json_set(&first, name, zp_json_number(indices.first.value, "1"));
    zp_json_set(&first_interval, name, interval(&indices.first));
    zp_json_set(&total, name, zp_json_number(indices.total.value, "1"));
    zp_json_set(&total_interval, name, interval(&indices.total));
  }
  zp_json_set(object, "first_order_indices", first);
  zp_json_set(object, "first_order_interval_95", first_interval);
  zp_json_set(object, "total_indices", total);
  zp_json_set(object, "total_interval_95", total_interval);
}

static json_t *describe(const Samples *s, const double *value) {
  static const char *const quantile[ZP_QUANTILES] = {"quantile_05", "quantile_25", "median", "quantile_75",
                                                     "quantile_95"};
  const ZpStatistics x = zp_statistics(s->design, value, s->work);
  json_t *object = json_object();
  zp_json_set(&object, "count", zp_json_number((double)x.count, "count"));
  zp_json_set(&object, "missing", zp_json_number((double)x.missing, "count"));
  zp_json_set(&object, "mean", zp_json_number(x.mean, "1"));
  zp_json_set(&object, "standard_deviation", zp_json_number(x.deviation, "1"));
  zp_json_set(&object, "min", zp_json_number(x.least, "1"));
  for (int k = 0; k < ZP_QUANTILES; k++)
    zp_json_set(&object, quantile[k], zp_json_number(x.quantile[k], "1"));
  zp_json_set(&object, "max", zp_json_number(x.most, "1"));
  if (s->design->indices) set_indices(&object, s, value);
  return object;
}

/* Statistics of all outputs over the samples from case `start` on. */
static json_t *outputs_of(Samples *s, size_t start) {
  const ZpCases *cases = &s->cases;
  json_t *object = json_object();
  for (size_t first = cases->keys; first < cases->columns && object; first += COLUMNS) {
    read_columns(s, first, start);
    for (size_t k = 0; k < COLUMNS && first + k < cases->columns; k++)
      zp_json_set(&object, cases->column[first + k].name, describe(s, s->value + k * s->count));
  }
  return object;
}

/* The object of the combination whose samples start with case `start`. */
static json_t *combination(Samples *s, size_t start) {
  const ZpScenario *scenario = s->cases.report->scenario;
  size_t keys;
  const int *key = zp_scenario_lists(scenario, &keys);
  json_t *object = json_object();
  zp_scenario_values(scenario, start, s->cases.value);
  for (size_t i = 0; i < keys; i++)
    if (!zp_scenario_spread(scenario, key[i]))
      zp_json_set(&object, zp_key(key[i])->name, zp_json_key(key[i], s->cases.value[i]));
  zp_json_set(&object, "outputs", outputs_of(s, start));
  return object;
}

json_t *zp_sample_statistics(const ZpReport *report) {
  const ZpDesign *design = zp_scenario_design(report->scenario);
  Samples s = {.design = design, .count = zp_design_samples(design)};
  json_t *list = json_array();
  s.value = calloc(COLUMNS * s.count, sizeof *s.value);
  s.work = calloc(s.count, sizeof *s.work);
  if (!zp_cases_open(report, &s.cases) || !s.value || !s.work) zp_json_drop(&list);
  for (size_t start = 0; start + s.count <= report->count && list; start += s.count)
    zp_json_add(&list, combination(&s, start));
  zp_cases_close(&s.cases);
  free(s.value);
  free(s.work);
  return list;
}
