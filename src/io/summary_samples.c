/* "statistics" of summary.json: the distributions of outputs over the samples of a campaign. */
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "io/cases.h"
#include "io/report.h"
#include "io/sampled.h"
#include "io/summary.h"
#include "sample/statistics.h"

/* Number of outputs that are read at once: a campaign may have more rows than fit into memory, and reading them takes
 * time. */
enum { COLUMNS = 8 };

typedef struct Samples {
  const ZpReport *report;
  const ZpDesign *design;
  size_t count;       /* number of samples of a combination */
  double *value;      /* [COLUMNS][count] */
  double *work;       /* [count] */
  double *key_value;  /* [lists of the scenario] of a combination */
  ZpIndices *indices; /* [dimensions of the design] of an output */
} Samples;

/* Read columns `first` .. of the outputs for the cases from `start` on. */
static void read_columns(Samples *s, const ZpScalarNames *names, size_t first, size_t start) {
  for (size_t i = 0; i < s->count; i++) {
    const ZpResult *result = zp_report_result(s->report, start + i);
    for (size_t k = 0; k < COLUMNS && first + k < names->count; k++)
      s->value[k * s->count + i] = zp_result_get(result, names->item[first + k].name);
  }
}

static void put_interval(ZpJson *json, const char *name, const ZpIndex *index) {
  zp_json_open(json, name, '[');
  zp_json_number(json, NULL, index->low, "1");
  zp_json_number(json, NULL, index->high, "1");
  zp_json_close(json, ']');
}

/* An object per index, and one of its intervals, each with an entry per key. */
static void put_indices(ZpJson *json, const Samples *s, const double *value) {
  static const char *const name[] = {"first_order_indices", "first_order_interval_95", "total_indices",
                                     "total_interval_95"};
  size_t keys;
  const int *key = zp_scenario_lists(s->report->scenario, &keys);
  for (int d = 0; d < s->design->dimensions; d++)
    s->indices[d] = zp_sobol_indices(s->design, value, d);
  for (int k = 0; k < 4; k++) {
    const ZpIndices *of = s->indices;
    zp_json_open(json, name[k], '{');
    for (size_t i = 0; i < keys; i++) {
      if (!zp_scenario_spread(s->report->scenario, key[i])) continue;
      const ZpIndex *index = k < 2 ? &of->first : &of->total;
      if (k % 2 == 0)
        zp_json_number(json, zp_key(key[i])->name, index->value, "1");
      else
        put_interval(json, zp_key(key[i])->name, index);
      of++;
    }
    zp_json_close(json, '}');
  }
}

static void put_output(ZpJson *json, const char *name, const Samples *s, const double *value) {
  static const char *const quantile[ZP_QUANTILES] = {"quantile_05", "quantile_25", "median", "quantile_75",
                                                     "quantile_95"};
  const ZpStatistics x = zp_statistics(s->design, value, s->work);
  zp_json_open(json, name, '{');
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

/* The combination whose samples start with case `start`. */
static void put_combination(ZpJson *json, Samples *s, const ZpScalarNames *names, size_t start) {
  size_t keys;
  const int *key = zp_scenario_lists(s->report->scenario, &keys);
  zp_scenario_values(s->report->scenario, start, s->key_value);
  zp_json_open(json, NULL, '{');
  for (size_t i = 0; i < keys; i++)
    if (!zp_scenario_spread(s->report->scenario, key[i]))
      zp_json_key(json, zp_key(key[i])->name, key[i], s->key_value[i]);
  zp_json_open(json, "outputs", '{');
  for (size_t first = 0; first < names->count; first += COLUMNS) {
    read_columns(s, names, first, start);
    for (size_t k = 0; k < COLUMNS && first + k < names->count; k++)
      put_output(json, names->item[first + k].name, s, s->value + k * s->count);
  }
  zp_json_close(json, '}');
  zp_json_close(json, '}');
}

ZpStatus zp_sample_statistics(ZpJson *json, const ZpReport *report, ZpError *err) {
  const ZpDesign *design = zp_scenario_design(report->scenario);
  Samples s = {.report = report, .design = design, .count = zp_design_samples(design)};
  ZpScalarNames names = {0};
  size_t keys;
  zp_scenario_lists(report->scenario, &keys);
  s.value = calloc(COLUMNS * s.count, sizeof *s.value);
  s.work = calloc(s.count, sizeof *s.work);
  s.key_value = calloc(keys, sizeof *s.key_value);
  s.indices = calloc((size_t)design->dimensions, sizeof *s.indices);
  const bool done = s.value && s.work && s.key_value && s.indices && zp_report_scalars(report, false, &names);
  zp_json_open(json, "statistics", '[');
  for (size_t start = 0; start + s.count <= report->count && done; start += s.count)
    put_combination(json, &s, &names, start);
  zp_json_close(json, ']');
  free(names.item);
  free(s.value);
  free(s.work);
  free(s.key_value);
  free(s.indices);
  return done ? ZP_OK : zp_fail_memory(err);
}
