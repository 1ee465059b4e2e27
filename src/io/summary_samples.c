/* "statistics" of summary.json: the distributions of outputs over the samples of a campaign. */
#include <math.h>
#include <stdlib.h>

#include "def/def.h"
#include "io/cases.h"
#include "io/json.h"
#include "io/report.h"
#include "sample/statistics.h"

/* Number of outputs that are read at once: a campaign may have more rows than fit into memory, and reading them takes
 * time. */
enum { COLUMNS = 8 };

typedef struct Samples {
  ZpCases cases;
  const ZpDesign *design;
  size_t count;       /* number of samples of a combination */
  double *value;      /* [COLUMNS][count] */
  double *work;       /* [count] */
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
        zp_json_number(json, zp_key(key[i])->name, index->value, "1");
        continue;
      }
      zp_json_open(json, zp_key(key[i])->name, '[');
      zp_json_number(json, NULL, index->low, "1");
      zp_json_number(json, NULL, index->high, "1");
      zp_json_close(json, ']');
    }
    zp_json_close(json, '}');
  }
}

static void describe(ZpJson *json, const char *output, const Samples *s, const double *value) {
  static const char *const quantile[ZP_QUANTILES] = {"quantile_05", "quantile_25", "median", "quantile_75",
                                                     "quantile_95"};
  const ZpStatistics x = zp_statistics(s->design, value, s->work);
  zp_json_open(json, output, '{');
  zp_json_number(json, "count", (double)x.count, "count");
  zp_json_number(json, "missing", (double)x.missing, "count");
  zp_json_number(json, "mean", x.mean, "1");
  zp_json_number(json, "standard_deviation", x.deviation, "1");
  zp_json_number(json, "min", x.least, "1");
  for (int k = 0; k < ZP_QUANTILES; k++)
    zp_json_number(json, quantile[k], x.quantile[k], "1");
  zp_json_number(json, "max", x.most, "1");
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
      zp_json_key(json, zp_key(key[i])->name, key[i], cases->value[i]);
  zp_json_open(json, "outputs", '{');
  for (size_t first = cases->keys; first < cases->columns; first += COLUMNS) {
    read_columns(s, first, start);
    for (size_t k = 0; k < COLUMNS && first + k < cases->columns; k++)
      describe(json, cases->column[first + k].name, s, s->value + k * s->count);
  }
  zp_json_close(json, '}');
  zp_json_close(json, '}');
}

void zp_sample_statistics(ZpJson *json, const ZpReport *report) {
  const ZpDesign *design = zp_scenario_design(report->scenario);
  Samples s = {.design = design, .count = zp_design_samples(design)};
  s.value = calloc(COLUMNS * s.count, sizeof *s.value);
  s.work = calloc(s.count, sizeof *s.work);
  s.indices = calloc((size_t)design->dimensions, sizeof *s.indices);
  json->bad |= !zp_cases_open(report, NULL, &s.cases) || !s.value || !s.work || !s.indices;
  zp_json_open(json, "statistics", '[');
  for (size_t start = 0; start + s.count <= report->count && !json->bad; start += s.count)
    put_combination(json, &s, start);
  zp_json_close(json, ']');
  zp_cases_close(&s.cases);
  free(s.value);
  free(s.work);
  free(s.indices);
}
