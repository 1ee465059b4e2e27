/* Data of pictures beside ../table.csv, as plain columns in SI. A row of NaN ends a curve, not an empty row: with an
 * empty one, gnuplot 5.4 uses a colour that was never set, and the picture varies. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/table.h"
#include "io/number.h"
#include "io/plan.h"
#include "io/plot.h"
#include "sample/statistics.h"
#include "study/result.h"

static void put(FILE *file, double value, char after) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fprintf(file, "%s%c", isfinite(value) ? text : "NaN", after);
}

/* -- shapes.dat: an index per frame, the members from the uppermost on ------------------------------- */

static bool has_shapes(const ZpPlot *plot) {
  const ZpShapes *shapes = plot->single ? plot->single->shapes : NULL;
  return shapes && shapes->frames > 0 && isfinite(zp_shapes_get(shapes, 0).x[0]);
}

static void put_shapes(const void *of, FILE *file) {
  const ZpShapes *shapes = ((const ZpPlot *)of)->single->shapes;
  const size_t nodes = shapes->nodes / shapes->members;
  fputs("# frame time_s voltage_V node, then x_m y_m of each ribbon, the upper first\n", file);
  for (size_t k = 0; k < shapes->frames; k++) {
    const ZpShape shape = zp_shapes_get(shapes, k);
    for (size_t i = 0; i < shapes->nodes; i++) {
      fprintf(file, "%zu %.9g ", k, shape.time);
      put(file, shape.voltage, ' ');
      fprintf(file, "%zu", i);
      for (size_t at = i * shapes->ribbons; at < (i + 1) * shapes->ribbons; at++)
        fprintf(file, isfinite(shape.x[at] + shape.y[at]) ? " %.12g %.12g" : " NaN NaN", shape.x[at], shape.y[at]);
      fprintf(file, "\n%s", (i + 1) % nodes ? "" : "NaN NaN NaN NaN NaN NaN NaN NaN\n");
    }
    fputs("\n\n", file);
  }
}

/* -- series.dat: the tables of all runs, one below the other ----------------------------------------- */

static bool is_fit(const ZpPlot *plot) {
  return zp_study_shows(plot->study) == ZP_SHOWS_fit;
}

static bool has_series(const ZpPlot *plot) {
  bool has = false;
  for (size_t run = 0; run < plot->report->count && !has; run++) {
    const ZpTable *table = zp_report_result(plot->report, run)->series;
    has = table && table->rows > (is_fit(plot) ? 0 : 1);
  }
  return has && (is_fit(plot) || (!plot->single && zp_study_shows(plot->study) == ZP_SHOWS_motion));
}

/* All columns of a fit; of motions time and one that shows how far they close. */
static void put_row(const ZpPlot *plot, const ZpTable *table, size_t row, FILE *file) {
  const char *travel = plot->def.actuator.kind == ZP_KIND_RIBBON ? "stroke_m" : "contraction";
  for (size_t i = 0; is_fit(plot) && i < table->columns; i++)
    put(file, table->value[row * table->columns + i], ' ');
  if (is_fit(plot)) return;
  put(file, zp_table_get(table, row, "time_s"), ' ');
  put(file, zp_table_get(table, row, travel), ' ');
}

/* At most ROWS_MOST rows: a picture of more is slow to view and shows no more. */
static void put_series(const void *of, FILE *file) {
  enum { ROWS_MOST = 200000 };
  const ZpPlot *plot = of;
  fputs("# run, then the columns of its table, or time_s and the contraction, or stroke_m, of its motion\n", file);
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = zp_report_result(plot->report, run)->series;
    const size_t rows = table ? table->rows : 0, step = rows * plot->report->count / ROWS_MOST + 1;
    for (size_t row = 0; row < rows; row++) {
      if (row % step && row + 1 < rows) continue;
      fprintf(file, "%zu ", run);
      put_row(plot, table, row, file);
      fputc('\n', file);
    }
    if (!is_fit(plot)) fprintf(file, "%zu NaN NaN\n", run);
  }
}

/* -- field.dat: the grid of the field ---------------------------------------------------------------- */

static bool has_field(const ZpPlot *plot) {
  return plot->single && plot->single->map;
}

/* Mean strength in rows `low` to `high` of the cells on both sides of column `i` of nodes. */
static double mean(const ZpFieldMap *map, size_t i, size_t low, size_t high) {
  double sum = 0;
  size_t count = 0;
  for (size_t k = i > 0 ? i - 1 : 0; k <= i && k + 1 < map->nx; k++)
    for (size_t j = low; j <= high; j++, count++)
      sum += map->strength[k * (map->ny - 1) + j];
  return sum / (double)count;
}

/* A block per row of nodes, from below. Surface 0 to 5 is on the lower metal's underside and top, the faces of the
 * insulators, the upper metal's underside and top; there the field jumps. -1 is no surface. */
static void put_field(const void *of, FILE *file) {
  const ZpFieldMap *map = ((const ZpPlot *)of)->single->map;
  const size_t cells = map->ny - 1;
  fputs("# x_m y_m potential_V, field_V_per_m below and above, relative permittivity above (0 in metal), surface\n",
        file);
  for (size_t j = 0; j < map->ny; j++) {
    const size_t below = j > 0 ? j - 1 : 0, above = j < cells ? j : cells - 1;
    int surface = 5;
    while (surface >= 0 && map->surface[surface] != j)
      surface--;
    for (size_t i = 0; i < map->nx; i++) {
      put(file, map->x[i * map->ny + j], ' ');
      put(file, map->y[i * map->ny + j], ' ');
      put(file, map->potential[i * map->ny + j], ' ');
      put(file, mean(map, i, below, surface < 0 ? above : below), ' ');
      put(file, mean(map, i, surface < 0 ? below : above, above), ' ');
      put(file, map->permittivity[(i + 1 < map->nx ? i : i - 1) * cells + above], ' ');
      fprintf(file, "%d\n", surface);
    }
    fputc('\n', file);
  }
}

/* -- sensitivity.dat and indices.dat ----------------------------------------------------------------- */

/* Percent of the output per percent of the key; NAN if one of them is 0 or useless: a run that has closed ends where
 * openings and strokes pass 0. */
static double percent(const ZpPlot *plot, const ZpSensitivity *s) {
  const double key = zp_def_get(&plot->def, s->key), output = zp_result_get(plot->single, s->output);
  const bool passing = plot->single->outcome == ZP_ZIPPED && strcmp(s->output, "zip_time_s") != 0;
  return key != 0 && output != 0 && !passing ? s->value * key / output : (double)NAN;
}

static bool has_sensitivity(const ZpPlot *plot) {
  for (size_t i = 0; plot->single && i < plot->single->sensitivities; i++)
    if (isfinite(percent(plot, &plot->single->sensitivity[i]))) return true;
  return false;
}

static void put_sensitivity(const void *of, FILE *file) {
  const ZpPlot *plot = of;
  fputs("# output, key, percent of the output per percent of the key\n", file);
  for (size_t i = 0; i < plot->single->sensitivities; i++) {
    const ZpSensitivity *s = &plot->single->sensitivity[i];
    if (isfinite(percent(plot, s)))
      fprintf(file, "%s %s %.12g\n", s->output,
              zp_scenario_key(plot->report->scenario, s->key, (char[ZP_PATH_SIZE]){0}), percent(plot, s));
  }
}

static bool has_indices(const ZpPlot *plot) {
  const ZpDesign *design = zp_scenario_design(plot->report->scenario);
  return design && design->indices && zp_design_samples(design) <= plot->report->count;
}

/* Those of an output, over the samples of the first combination of the lists' values. */
static void put_output(const ZpPlot *plot, const char *output, double *value, FILE *file) {
  const ZpDesign *design = zp_scenario_design(plot->report->scenario);
  size_t keys;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  int dimension = 0;
  for (size_t i = 0; i < zp_design_samples(design); i++)
    value[i] = zp_result_get(zp_report_result(plot->report, i), output);
  for (size_t k = 0; k < keys; k++) {
    if (!zp_scenario_spread(plot->report->scenario, key[k])) continue;
    const ZpIndices indices = zp_sobol_indices(design, value, dimension++);
    const ZpIndex first = indices.first, total = indices.total;
    fprintf(file, "%s %s %g %g %g %g %g %g\n", output,
            zp_scenario_key(plot->report->scenario, key[k], (char[ZP_PATH_SIZE]){0}), first.value, first.low,
            first.high, total.value, total.low, total.high);
  }
}

static void put_indices(const void *of, FILE *file) {
  const ZpPlot *plot = of;
  double *value = calloc(zp_design_samples(zp_scenario_design(plot->report->scenario)), sizeof *value);
  fputs("# output, key, share of the variance and its 95 % interval: by itself, then with interactions\n", file);
  for (size_t i = 0; value && i < plot->columns; i++)
    if (plot->column[i].key < 0 && plot->column[i].high > plot->column[i].low)
      put_output(plot, plot->column[i].name, value, file);
  free(value);
}

const ZpPlotData zp_plot_data[] = {
    {"shapes.dat", has_shapes, put_shapes},    {"series.dat", has_series, put_series},
    {"field.dat", has_field, put_field},       {"sensitivity.dat", has_sensitivity, put_sensitivity},
    {"indices.dat", has_indices, put_indices}, {0},
};
