/* Pictures of a sweep: contraction.svg, all runs over time, and zip_time.svg, against the only list key. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "io/number.h"
#include "io/plot.h"
#include "io/units.h"

/* Curves that the legend names, and rows that all curves together may have: a picture of more is slow to
 * look at and shows no more. */
#define LEGEND 12
#define ROWS   200000

#define RIGHT 0.76

static bool is_sweep(const ZpPlot *plot) {
  return plot->study == ZP_STUDY_ACTUATE && !plot->single && plot->report->count > 0;
}

static bool is_ribbon(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON;
}

/* What is drawn over time. */
static const char *column(const ZpPlot *plot) {
  return is_ribbon(plot) ? "stroke_m" : "contraction";
}

static const ZpTable *series(const ZpPlot *plot, size_t run) {
  return plot->report->result[run]->series;
}

static bool has_contraction(const ZpPlot *plot) {
  for (size_t i = 0; is_sweep(plot) && i < plot->report->count; i++)
    if (zp_plot_has(series(plot, i), column(plot))) return true;
  return false;
}

/* Colour of a run: one of a few that differ much, or a place on a scale from dark to light. */
static unsigned colour_of(const ZpPlot *plot, size_t run) {
  static const double scale[][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {200, 208, 32}};
  unsigned colour = 0;
  if (plot->report->count <= ZP_COLOURS) {
    sscanf(zp_plot_colour(run), "#%x", &colour);
    return colour;
  }
  double place = 4 * (double)run / (double)(plot->report->count - 1);
  int from = place < 4 ? (int)place : 3;
  for (int i = 0; i < 3; i++) {
    double part = scale[from][i] + (place - from) * (scale[from + 1][i] - scale[from][i]);
    colour = colour << 8 | (unsigned)lround(part);
  }
  return colour;
}

static void put(FILE *file, double value, char after) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fprintf(file, "%s%c", text, after);
}

/* A block per run: time, value, colour; NaN between them (plot_shapes.c says why). */
static void data_contraction(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# time_s %s colour; NaN between runs\n", column(plot));
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = series(plot, run);
    size_t rows = table ? table->rows : 0, step = rows * plot->report->count / ROWS + 1;
    for (size_t row = 0; row < rows; row++) {
      double value = zp_table_get(table, row, column(plot));
      if (!isfinite(value) || (row % step && row + 1 < rows)) continue;
      put(file, zp_table_get(table, row, "time_s"), ' ');
      put(file, value, ' ');
      fprintf(file, "%u\n", colour_of(plot, run));
    }
    fprintf(file, "NaN NaN %u\n", colour_of(plot, run));
  }
}

/* Largest of a column over all runs, in its unit. */
static ZpPlotUnit common_unit(const ZpPlot *plot, const char *name, const char *unit) {
  ZpPlotUnit common = zp_plot_unit(0, unit);
  bool first = true;
  for (size_t run = 0; run < plot->report->count; run++) {
    if (!zp_plot_has(series(plot, run), name)) continue;
    ZpPlotUnit own = zp_plot_table_unit(series(plot, run), (const char *const[]){name, NULL}, unit);
    if (first || own.factor < common.factor) common = own;
    first = false;
  }
  return common;
}

/* "8 kV, 21": the values of the list keys of a run. */
static void run_name(const ZpPlot *plot, size_t run, char *text, size_t size) {
  size_t keys, used = 0;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  ZpActuatorDef def;
  text[0] = 0;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return;
  for (size_t i = 0; i < keys && used < size; i++) {
    char value[64];
    zp_value_print(key[i], zp_def_get(&def, key[i]), value, sizeof value);
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", value);
  }
}

/* The names of the list keys over the legend, each on a line so that it fits. */
static void legend_title(const ZpPlot *plot, FILE *file) {
  size_t keys;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  fputs("set key title \"", file);
  for (size_t i = 0; i < keys; i++) {
    fputs(i ? ",\\n" : "", file);
    for (const char *c = zp_key(key[i])->name; *c; c++)
      fprintf(file, "%s%c", *c == '_' ? "\\\\" : "", *c);
  }
  fputs("\" left font ',12'\n", file);
}

/* A legend entry for a curve that is drawn with many others. */
static void legend_entry(const ZpPlot *plot, FILE *file, size_t run) {
  char name[256];
  run_name(plot, run, name, sizeof name);
  fprintf(file, ", \\\n     NaN with lines lw 2 lc rgb '#%06x' title ", colour_of(plot, run));
  zp_plot_text(file, name);
}

static void script_contraction(const ZpPlot *plot, FILE *file) {
  const size_t count = plot->report->count, named = count < LEGEND ? count : LEGEND;
  ZpPlotUnit time = common_unit(plot, "time_s", "s");
  ZpPlotUnit shown = common_unit(plot, "stroke_m", "m");
  if (!is_ribbon(plot)) shown = (ZpPlotUnit){.factor = 100, .text = "%"};
  zp_plot_head(plot, file, "contraction", is_ribbon(plot) ? "Stroke over time" : "Contraction over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  legend_title(plot, file);
  fprintf(file,
          "set xrange [0:*]\nset xlabel 'time / %s'\nset ylabel '%s / %s' offset 0.5\n"
          "plot 'contraction.dat' using ($1*%g):($2*%g):3 with lines lw 2 lc rgb variable notitle",
          time.text, is_ribbon(plot) ? "stroke" : "contraction", shown.text, time.factor, shown.factor);
  for (size_t i = 0; i < named; i++)
    legend_entry(plot, file, named > 1 ? i * (count - 1) / (named - 1) : 0);
  fputc('\n', file);
}

/* The list key of a sweep along one number; -1 for any other sweep. */
static int only_key(const ZpPlot *plot) {
  size_t keys;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  if (keys != 1) return -1;
  ZpKeyType type = zp_key(key[0])->type;
  return type == ZP_KEY_REAL || type == ZP_KEY_REAL_AUTO || type == ZP_KEY_INT ? key[0] : -1;
}

/* Value of the list key in a run, SI; NAN for auto. */
static double key_value(const ZpPlot *plot, size_t run) {
  ZpActuatorDef def;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return NAN;
  return zp_def_get(&def, only_key(plot));
}

static double zip_time(const ZpPlot *plot, size_t run) {
  return zp_result_get(plot->report->result[run], "zip_time_s");
}

/* How many runs have a point in zip_time.svg. */
static size_t points(const ZpPlot *plot) {
  size_t count = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    count += isfinite(zip_time(plot, run)) && isfinite(key_value(plot, run));
  return count;
}

static bool has_zip_time(const ZpPlot *plot) {
  return is_sweep(plot) && only_key(plot) >= 0 && points(plot) >= 2;
}

static void data_zip_time(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# %s zip_time_s\n", zp_key(only_key(plot))->name);
  for (size_t run = 0; run < plot->report->count; run++) {
    if (!isfinite(zip_time(plot, run)) || !isfinite(key_value(plot, run))) continue;
    put(file, key_value(plot, run), ' ');
    put(file, zip_time(plot, run), '\n');
  }
}

/* What a number of the key in SI is to be multiplied with for its usual unit. */
static double key_factor(const ZpKey *key) {
  ZpUnitScale scale;
  if (!*key->shown || zp_unit_scale(key->shown, key->unit, &scale, NULL) != ZP_OK) return 1;
  return scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor;
}

static void script_zip_time(const ZpPlot *plot, FILE *file) {
  const ZpKey *key = zp_key(only_key(plot));
  char more[64], label[128];
  double largest = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    largest = fmax(largest, zip_time(plot, run));
  ZpPlotUnit time = zp_plot_unit(largest, "s");
  snprintf(more, sizeof more, "%zu of %zu runs zip", points(plot), plot->report->count);
  snprintf(label, sizeof label, *key->shown ? "%s / %s" : "%s", key->name, key->shown);
  zp_plot_head(plot, file, "zip_time", "Time to zip", 0.96);
  zp_plot_foot(plot, file, more);
  fputs("set xlabel ", file);
  zp_plot_text(file, label);
  fprintf(file,
          "\nset ylabel 'zip time / %s' offset 0.5\nset yrange [0:*]\n"
          "set offsets graph 0.03, graph 0.03, graph 0.05, 0\n"
          "plot 'zip_time.dat' using ($1*%g):($2*%g) with linespoints lw 2 pt 7 ps 0.8 lc rgb '%s' notitle\n",
          time.text, key_factor(key), time.factor, zp_plot_colour(0));
}

const ZpPicture zp_sweep_pictures[] = {
    {"contraction", "svg", has_contraction, script_contraction, data_contraction},
    {"zip_time", "svg", has_zip_time, script_zip_time, data_zip_time},
    {0},
};
