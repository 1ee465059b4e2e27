/* Picture of the derivatives of a run, tornado.svg: the change of outputs in percent for a change of a key by one
 * percent. The key with the largest effect is on top. */
#include <math.h>
#include <string.h>

#include "io/plot.h"

/* Outputs drawn, a colour each. */
enum { OUTPUTS = 4 };

typedef struct Tornado {
  const char *output[OUTPUTS];
  size_t outputs;
  int key[ZP_MAX_SENSITIVITY_KEYS]; /* the one that counts most first */
  size_t keys;
} Tornado;

/* Percent of an output per percent of a key; NAN where either is 0 or not there. */
static double percent(const ZpPlot *plot, const ZpSensitivity *s) {
  double key = zp_def_get(&plot->def, s->key), output = zp_result_get(plot->single, s->output);
  double share = s->value * key / output;
  return key != 0 && output != 0 && isfinite(share) ? share : (double)NAN;
}

static double percent_of(const ZpPlot *plot, const char *output, int key) {
  for (size_t i = 0; i < plot->single->sensitivities; i++) {
    const ZpSensitivity *s = &plot->single->sensitivity[i];
    if (s->key == key && strcmp(s->output, output) == 0) return percent(plot, s);
  }
  return NAN;
}

/* The largest percentage of all outputs. */
static double weight(const ZpPlot *plot, const Tornado *t, int key) {
  double most = 0;
  for (size_t k = 0; k < t->outputs; k++)
    most = fmax(most, fabs(percent_of(plot, t->output[k], key)));
  return most;
}

static void add_output(Tornado *t, const char *name) {
  for (size_t k = 0; k < t->outputs; k++)
    if (strcmp(t->output[k], name) == 0) return;
  if (t->outputs < OUTPUTS) t->output[t->outputs++] = name;
}

/* In its place. */
static void add_key(const ZpPlot *plot, Tornado *t, int key) {
  for (size_t k = 0; k < t->keys; k++)
    if (t->key[k] == key) return;
  size_t place = t->keys++;
  for (; place > 0 && weight(plot, t, t->key[place - 1]) < weight(plot, t, key); place--)
    t->key[place] = t->key[place - 1];
  t->key[place] = key;
}

/* Is there something to draw for it? A run that has closed ends while openings and strokes pass 0. Their percentages
 * are useless there, and hide those of the zip time. */
static bool counts(const ZpPlot *plot, const ZpSensitivity *s) {
  bool passing = plot->single->outcome == ZP_ZIPPED && strcmp(s->output, "zip_time_s") != 0;
  return !passing && isfinite(percent(plot, s));
}

static Tornado tornado(const ZpPlot *plot) {
  Tornado t = {.outputs = 0};
  const ZpResult *result = plot->single;
  for (size_t i = 0; result && i < result->sensitivities; i++)
    if (counts(plot, &result->sensitivity[i])) add_output(&t, result->sensitivity[i].output);
  for (size_t i = 0; result && i < result->sensitivities; i++)
    if (counts(plot, &result->sensitivity[i])) add_key(plot, &t, result->sensitivity[i].key);
  return t;
}

static bool has_tornado(const ZpPlot *plot) {
  return tornado(plot).keys > 0;
}

static void data_tornado(const ZpPlot *plot, FILE *file) {
  const Tornado t = tornado(plot);
  fputs("# row, percent per percent of the key; an index per output\n", file);
  for (size_t k = 0; k < t.outputs; k++) {
    fprintf(file, "# %s\n", t.output[k]);
    for (size_t i = 0; i < t.keys; i++) {
      fprintf(file, "%zu ", t.keys - i);
      zp_plot_put(file, percent_of(plot, t.output[k], t.key[i]), '\n');
    }
    fputs("\n\n", file);
  }
}

/* "pull_in_voltage_V" => "pull in voltage" */
static void define_output(FILE *file, size_t k, const char *output) {
  char words[64];
  snprintf(words, sizeof words, "%s", output);
  char *unit = strrchr(words, '_');
  if (unit) *unit = 0;
  for (char *c = words; *c; c++)
    if (*c == '_') *c = ' ';
  zp_plot_define_text(file, zp_plot_entry("output", k).text, words);
}

/* The keys from the top: row `keys` down to row 1. */
static void define_tornado(const ZpPlot *plot, FILE *file) {
  const Tornado t = tornado(plot);
  zp_plot_define_array(file, "output", t.outputs);
  for (size_t k = 0; k < t.outputs; k++)
    define_output(file, k + 1, t.output[k]);
  zp_plot_define_array(file, "key_name", t.keys);
  for (size_t i = 0; i < t.keys; i++)
    zp_plot_define_text(file, zp_plot_entry("key_name", i + 1).text, zp_key(t.key[i])->name);
}

const ZpPicture zp_sensitivity_pictures[] = {
    {"tornado", "svg", "tornado.gp", .one = ZP_OF_ANY, .has = has_tornado, .define = define_tornado,
     .data = data_tornado},
    {0},
};
