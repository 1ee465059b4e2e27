/* "statistics" of summary.json: the distributions of outputs over the samples of a campaign. */
#include <math.h>
#include <stdlib.h>

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
  size_t count;  /* number of samples of a combination */
  double *value; /* [COLUMNS][count] */
  double *work;  /* [count] */
} Samples;

/* Read columns `first` .. of the outputs for the cases from `start` on. */
static void read_columns(Samples *s, const ZpScalarNames *names, size_t first, size_t start) {
  for (size_t i = 0; i < s->count; i++) {
    const ZpResult *result = zp_report_result(s->report, start + i);
    for (size_t k = 0; k < COLUMNS && first + k < names->count; k++)
      s->value[k * s->count + i] = zp_result_get(result, names->item[first + k].name);
  }
}

/* Two bounds. */
static json_t *interval(const ZpIndex *index) {
  json_t *pair = json_array();
  bool done = pair && json_array_append_new(pair, zp_json_number(index->low, "1")) == 0;
  if (done && json_array_append_new(pair, zp_json_number(index->high, "1")) == 0) return pair;
  json_decref(pair);
  return NULL;
}

/* An object per index, and one of its intervals, each with an entry per key. */
static bool set_indices(json_t *object, const Samples *s, const double *value) {
  json_t *first = json_object(), *first_interval = json_object(), *total = json_object(),
         *total_interval = json_object();
  size_t keys;
  const int *key = zp_scenario_lists(s->report->scenario, &keys);
  bool done = true;
  int dimension = 0;
  for (size_t i = 0; i < keys; i++) {
    if (!zp_scenario_spread(s->report->scenario, key[i])) continue;
    const ZpIndices indices = zp_sobol_indices(s->design, value, dimension++);
    const char *name = zp_key(key[i])->name;
    done = zp_json_set(first, name, zp_json_number(indices.first.value, "1")) && done;
    done = zp_json_set(first_interval, name, interval(&indices.first)) && done;
    done = zp_json_set(total, name, zp_json_number(indices.total.value, "1")) && done;
    done = zp_json_set(total_interval, name, interval(&indices.total)) && done;
  }
  done = zp_json_set(object, "first_order_indices", first) && done;
  done = zp_json_set(object, "first_order_interval_95", first_interval) && done;
  done = zp_json_set(object, "total_indices", total) && done;
  return zp_json_set(object, "total_interval_95", total_interval) && done;
}

static json_t *describe(const Samples *s, const double *value) {
  static const char *const quantile[ZP_QUANTILES] = {"quantile_05", "quantile_25", "median", "quantile_75",
                                                     "quantile_95"};
  const ZpStatistics x = zp_statistics(s->design, value, s->work);
  json_t *object = json_object();
  bool done = zp_json_set(object, "count", zp_json_number((double)x.count, "count"));
  done = zp_json_set(object, "missing", zp_json_number((double)x.missing, "count")) && done;
  done = zp_json_set(object, "mean", zp_json_number(x.mean, "1")) && done;
  done = zp_json_set(object, "standard_deviation", zp_json_number(x.deviation, "1")) && done;
  done = zp_json_set(object, "min", zp_json_number(x.least, "1")) && done;
  for (int k = 0; k < ZP_QUANTILES; k++)
    done = zp_json_set(object, quantile[k], zp_json_number(x.quantile[k], "1")) && done;
  done = zp_json_set(object, "max", zp_json_number(x.most, "1")) && done;
  if (s->design->indices) done = set_indices(object, s, value) && done;
  if (done) return object;
  json_decref(object);
  return NULL;
}

/* Statistics of all outputs over the samples from case `start` on. */
static json_t *outputs_of(Samples *s, const ZpScalarNames *names, size_t start) {
  json_t *object = json_object();
  bool done = object != NULL;
  for (size_t first = 0; first < names->count && done; first += COLUMNS) {
    read_columns(s, names, first, start);
    for (size_t k = 0; k < COLUMNS && first + k < names->count && done; k++)
      done = zp_json_set(object, names->item[first + k].name, describe(s, s->value + k * s->count));
  }
  if (done) return object;
  json_decref(object);
  return NULL;
}

/* The object of the combination whose samples start with case `start`. */
static json_t *combination(Samples *s, const ZpScalarNames *names, size_t start) {
  size_t keys;
  const int *key = zp_scenario_lists(s->report->scenario, &keys);
  ZpActuatorDef def;
  json_t *object = json_object();
  bool done = object && zp_scenario_def(s->report->scenario, start, &def, NULL) == ZP_OK;
  for (size_t i = 0; i < keys && done; i++)
    if (!zp_scenario_spread(s->report->scenario, key[i]))
      done = zp_json_set(object, zp_key(key[i])->name, zp_json_key(key[i], zp_def_get(&def, key[i])));
  if (done && zp_json_set(object, "outputs", outputs_of(s, names, start))) return object;
  json_decref(object);
  return NULL;
}

json_t *zp_sample_statistics(const ZpReport *report) {
  const ZpDesign *design = zp_scenario_design(report->scenario);
  Samples s = {.report = report, .design = design, .count = zp_design_samples(design)};
  ZpScalarNames names = {0};
  json_t *list = json_array();
  s.value = calloc(COLUMNS * s.count, sizeof *s.value);
  s.work = calloc(s.count, sizeof *s.work);
  bool done = list && s.value && s.work && zp_report_scalars(report, false, &names);
  for (size_t start = 0; start + s.count <= report->count && done; start += s.count)
    done = json_array_append_new(list, combination(&s, &names, start)) == 0;
  free(names.item);
  free(s.value);
  free(s.work);
  if (done) return list;
  json_decref(list);
  return NULL;
}
