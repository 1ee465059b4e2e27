/* Pictures of a campaign whose cases were drawn from distributions. distribution.svg: the share of the samples below a
 * value; indices.svg: the share of the variance that follows from each key. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/plot.h"
#include "io/sampled.h"
#include "sample/statistics.h"

/* Curves of a picture. */
enum { CURVES = 8 };

/* The answers of the study for the first combinations of the lists' values. */
typedef struct Curve {
  const char *scalar, *legend;
  size_t start, found; /* the case with which its samples begin; of how many independent ones there is a value */
} Curve;

typedef struct Drawn {
  const ZpDesign *design; /* NULL: there is nothing to draw */
  size_t count;           /* samples of a combination */
  Curve curve[CURVES];
  size_t curves;
} Drawn;

static double value_of(const ZpPlot *plot, const Curve *curve, size_t sample) {
  return zp_table_get(plot->table, curve->start + sample, curve->scalar);
}

static void add_curve(const ZpPlot *plot, Drawn *d, Curve curve) {
  for (size_t i = 0; i < d->count; i++)
    curve.found += isfinite(value_of(plot, &curve, i)) && i % zp_design_blocks(d->design) <= ZP_BLOCK_B;
  if (curve.found >= 2 && d->curves < CURVES) d->curve[d->curves++] = curve;
}

static Drawn look(const ZpPlot *plot) {
  static const ZpAnswer held = {.scalar = {"force_N"}}; /* of the held platform */
  const ZpAnswer *a = plot->answer ? plot->answer : &held;
  Drawn d = {.design = zp_scenario_design(plot->report->scenario)};
  d.count = d.design ? zp_design_samples(d.design) : 0;
  for (size_t start = 0; d.design && start + d.count <= plot->report->count; start += d.count)
    for (size_t i = 0; i < 2; i++)
      if (a->scalar[i]) add_curve(plot, &d, (Curve){a->scalar[i], a->legend[i], start, 0});
  return d;
}

/* -- distribution ----------------------------------------------------------------------------------- */

static bool has_distribution(const ZpPlot *plot) {
  return look(plot).curves > 0;
}

/* "8 g, pull-in": the values of the lists, and the answer where the study has two. */
static void define_name(const ZpPlot *plot, const Curve *curve, const char *entry, FILE *file) {
  char lists[200], name[256];
  zp_sweep_run_name(plot, curve->start, 0, lists, sizeof lists);
  snprintf(name, sizeof name, "%s%s%s", lists, *lists && curve->legend ? ", " : "", curve->legend ? curve->legend : "");
  zp_plot_define_text(file, entry, name);
}

/* Curve k: the column scalar[k] of the rows from start[k] on, `rows` of them. Of `blocks` successive rows the first
 * `independent` are independent. */
static void define_distribution(const ZpPlot *plot, FILE *file) {
  static const char *const array[] = {"curve", "scalar", "start", "found"};
  const Drawn d = look(plot);
  zp_plot_define_count(file, "samples", d.design->count * (d.design->indices ? ZP_BLOCK_FIRST : 1));
  zp_plot_define_count(file, "rows", d.count);
  zp_plot_define_count(file, "blocks", zp_design_blocks(d.design));
  zp_plot_define_count(file, "independent", ZP_BLOCK_B + 1);
  for (size_t i = 0; i < sizeof array / sizeof array[0]; i++)
    zp_plot_define_array(file, array[i], d.curves);
  for (size_t k = 0; k < d.curves; k++) {
    define_name(plot, &d.curve[k], zp_plot_entry("curve", k + 1).text, file);
    zp_plot_define_word(file, zp_plot_entry("scalar", k + 1).text, d.curve[k].scalar);
    zp_plot_define_count(file, zp_plot_entry("start", k + 1).text, d.curve[k].start);
    zp_plot_define_count(file, zp_plot_entry("found", k + 1).text, d.curve[k].found);
  }
}

/* -- indices ---------------------------------------------------------------------------------------- */

static bool has_indices(const ZpPlot *plot) {
  const Drawn d = look(plot);
  return d.curves > 0 && d.design->indices;
}

/* Keys with distributions, in key order => how many. */
static size_t drawn_keys(const ZpPlot *plot, const int **key, int *own) {
  size_t keys, count = 0;
  *key = zp_scenario_lists(plot->report->scenario, &keys);
  for (size_t i = 0; i < keys; i++)
    if (zp_scenario_spread(plot->report->scenario, (*key)[i])) own[count++] = (*key)[i];
  return count;
}

enum { KEYS_MOST = 64 };

/* Two blocks, first order and total: an index each, a line per key. */
static void data_indices(const ZpPlot *plot, FILE *file) {
  const Drawn d = look(plot);
  const int *all;
  int key[KEYS_MOST];
  const size_t keys = drawn_keys(plot, &all, key);
  double *value = calloc(d.count + 1, sizeof *value);
  fprintf(file, "# row, share of the variance of %s / %% and its 95 %% interval: first-order, then total\n",
          d.curve[0].scalar);
  for (size_t i = 0; value && i < d.count; i++)
    value[i] = value_of(plot, &d.curve[0], i);
  for (int total = 0; value && total < 2; total++) {
    for (size_t k = 0; k < keys; k++) {
      const ZpIndices indices = zp_sobol_indices(d.design, value, (int)k);
      const ZpIndex *index = total ? &indices.total : &indices.first;
      fprintf(file, "%zu ", keys - k);
      zp_plot_put(file, 100 * index->value, ' ');
      zp_plot_put(file, 100 * index->low, ' ');
      zp_plot_put(file, 100 * index->high, '\n');
    }
    fputs("\n\n", file);
  }
  free(value);
}

/* The keys from the top: row `keys` down to row 1. */
static void define_indices(const ZpPlot *plot, FILE *file) {
  const int *all;
  int key[KEYS_MOST];
  const size_t keys = drawn_keys(plot, &all, key);
  zp_plot_define_array(file, "key_name", keys);
  for (size_t k = 0; k < keys; k++)
    zp_plot_define_text(file, zp_plot_entry("key_name", k + 1).text, zp_key(key[k])->name);
}

const ZpPicture zp_sample_pictures[] = {
    {"distribution", "svg", "distribution.gp", .many = ZP_OF_ANY, .has = has_distribution,
     .define = define_distribution},
    {"indices", "svg", "indices.gp", .many = ZP_OF_ANY, .has = has_indices, .define = define_indices,
     .data = data_indices},
    {0},
};
