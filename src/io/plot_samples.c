/* Pictures of a campaign whose cases were drawn from distributions: distribution.svg, how large a share of the samples
 * lies below a value; indices.svg, which share of the variance follows from which key. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"
#include "sample/statistics.h"

/* Curves of a picture. */
enum { CURVES = 8 };

/* What is drawn: the answers of the study for the first combinations of the lists' values. */
typedef struct Curve {
  const char *scalar, *legend;
  size_t start; /* the case with which its samples begin */
} Curve;

typedef struct Drawn {
  const ZpDesign *design; /* NULL: there is nothing to draw */
  size_t count;           /* samples of a combination */
  Curve curve[CURVES];
  size_t curves;
  const char *axis, *unit; /* no unit: a pure number */
} Drawn;

static double value_of(const ZpPlot *plot, const Curve *curve, size_t sample) {
  return zp_result_get(zp_report_result(plot->report, curve->start + sample), curve->scalar);
}

static void add_curve(const ZpPlot *plot, Drawn *d, Curve curve) {
  size_t found = 0;
  for (size_t i = 0; i < d->count; i++)
    found += isfinite(value_of(plot, &curve, i)) != 0;
  if (curve.scalar && found >= 2 && d->curves < CURVES) d->curve[d->curves++] = curve;
}

static Drawn look(const ZpPlot *plot) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  Drawn d = {.design = zp_scenario_design(plot->report->scenario), .axis = a ? a->axis : "force"};
  if (!d.design) return d;
  d.unit = a ? a->unit : "N";
  d.count = zp_design_samples(d.design);
  for (size_t start = 0; start + d.count <= plot->report->count; start += d.count)
    for (size_t i = 0; i < 2; i++) {
      const Curve curve = {a ? a->scalar[i] : i == 0 ? "force_N" : NULL, a ? a->legend[i] : NULL, start};
      if (curve.scalar) add_curve(plot, &d, curve);
    }
  return d;
}

/* "8 g, pull-in": the values of the lists, and the answer where the study has two. */
static void name_curve(const ZpPlot *plot, const Drawn *d, const Curve *curve, char text[256]) {
  size_t keys, used = 0;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  char value[64];
  text[0] = 0;
  ZpActuatorDef def;
  if (zp_scenario_def(plot->report->scenario, curve->start, &def, NULL) != ZP_OK) return;
  for (size_t i = 0; i < keys && used < 256; i++) {
    if (zp_scenario_spread(plot->report->scenario, key[i])) continue;
    zp_value_print(key[i], zp_def_get(&def, key[i]), value, sizeof value);
    used += (size_t)snprintf(text + used, 256 - used, "%s%s", used ? ", " : "", value);
  }
  if (used < 256)
    snprintf(text + used, 256 - used, "%s%s", used && curve->legend ? ", " : "",
             curve->legend ? curve->legend
             : used        ? ""
                           : d->axis);
}

static double largest_of(const ZpPlot *plot, const Drawn *d) {
  double largest = 0;
  for (size_t k = 0; k < d->curves; k++)
    for (size_t i = 0; i < d->count; i++)
      largest = fmax(largest, fabs(value_of(plot, &d->curve[k], i))); /* fmax leaves out what is not there */
  return largest;
}

/* -- distribution ----------------------------------------------------------------------------------- */

static bool has_distribution(const ZpPlot *plot) {
  return look(plot).curves > 0;
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The samples of a curve that are independent and have a value, in order => how many. */
static size_t sorted(const ZpPlot *plot, const Drawn *d, const Curve *curve, double *value) {
  size_t count = 0;
  for (size_t i = 0; i < d->count; i++) {
    const double one = value_of(plot, curve, i);
    if (isfinite(one) && i % zp_design_blocks(d->design) <= ZP_BLOCK_B) value[count++] = one;
  }
  qsort(value, count, sizeof *value, compare);
  return count;
}

/* An index per curve; without memory there are none, and gnuplot says so. */
static void data_distribution(const ZpPlot *plot, FILE *file) {
  const Drawn d = look(plot);
  double *value = calloc(d.count, sizeof *value);
  fputs("# value, share of the samples up to it / %; an index per curve\n", file);
  for (size_t k = 0; value && k < d.curves; k++) {
    const size_t count = sorted(plot, &d, &d.curve[k], value);
    for (size_t i = 0; i < count; i++) {
      zp_plot_put(file, value[i], ' ');
      zp_plot_put(file, 100 * ((double)i + 0.5) / (double)count, '\n');
    }
    fputs("\n\n", file);
  }
  free(value);
}

static void define_distribution(const ZpPlot *plot, FILE *file) {
  const Drawn d = look(plot);
  char name[256];
  zp_plot_define_text(file, "quantity", d.axis);
  zp_plot_define_word(file, "si", d.unit ? d.unit : "");
  zp_plot_define(file, "largest_value", largest_of(plot, &d));
  zp_plot_define_count(file, "samples", d.design->count * (d.design->indices ? ZP_BLOCK_FIRST : 1));
  zp_plot_define_array(file, "curve", d.curves);
  for (size_t k = 0; k < d.curves; k++) {
    name_curve(plot, &d, &d.curve[k], name);
    zp_plot_define_text(file, zp_plot_entry("curve", k + 1).text, name);
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
  double *value = calloc(d.count, sizeof *value);
  fprintf(file, "# row, share of the variance of %s / %%: first-order, then total\n", d.curve[0].scalar);
  for (size_t i = 0; value && i < d.count; i++)
    value[i] = value_of(plot, &d.curve[0], i);
  for (int total = 0; value && total < 2; total++) {
    for (size_t k = 0; k < keys; k++) {
      const ZpIndices indices = zp_sobol_indices(d.design, value, (int)k);
      fprintf(file, "%zu ", keys - k);
      zp_plot_put(file, 100 * (total ? indices.total : indices.first), '\n');
    }
    fputs("\n\n", file);
  }
  free(value);
}

/* The keys from the top: row `keys` down to row 1. */
static void define_indices(const ZpPlot *plot, FILE *file) {
  const Drawn d = look(plot);
  const int *all;
  int key[KEYS_MOST];
  const size_t keys = drawn_keys(plot, &all, key);
  char quantity[128];
  snprintf(quantity, sizeof quantity, "%s%s%s", d.curve[0].legend ? d.curve[0].legend : "",
           d.curve[0].legend ? " " : "", d.axis);
  zp_plot_define_text(file, "quantity", quantity);
  zp_plot_define_array(file, "key_name", keys);
  for (size_t k = 0; k < keys; k++)
    zp_plot_define_text(file, zp_plot_entry("key_name", k + 1).text, zp_key(key[k])->name);
}

const ZpPicture zp_sample_pictures[] = {
    {"distribution", "svg", has_distribution, define_distribution, data_distribution, "distribution.gp"},
    {"indices", "svg", has_indices, define_indices, data_indices, "indices.gp"},
    {0},
};
