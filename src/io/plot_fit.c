/* Picture of a calibration, fit.svg: measurements against the fit. */
#include <math.h>
#include <string.h>

#include "io/plot.h"
#include "io/report.h"
#include "io/units.h"

/* The columns of a calibration: x, measured and computed, both in the unit of what was measured. */
enum { X, MEASURED, COMPUTED };

static double value_at(const ZpTable *table, size_t row, size_t column) {
  return table->value[row * table->columns + column];
}

/* What was measured, by its unit. */
static const char *quantity(const ZpTable *table) {
  static const struct { const char *unit, *name; } of[] = {{"N", "force"}, {"s", "zip time"}, {"F", "capacitance"}};
  for (size_t k = 0; k < sizeof of / sizeof of[0]; k++)
    if (strcmp(table->column[MEASURED].unit, of[k].unit) == 0) return of[k].name;
  return "stroke or opening";
}

static bool has_fit(const ZpPlot *plot) {
  if (plot->shows != ZP_SHOWS_fit) return false;
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = zp_report_result(plot->report, run)->series;
    for (size_t row = 0; table && row < table->rows; row++)
      if (isfinite(value_at(table, row, COMPUTED))) return true;
  }
  return false;
}

static void data_fit(const ZpPlot *plot, FILE *file) {
  fputs("# x measured fitted\n", file);
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = zp_report_result(plot->report, run)->series;
    for (size_t row = 0; table && row < table->rows; row++) {
      zp_plot_put(file, value_at(table, row, X), ' ');
      zp_plot_put(file, value_at(table, row, MEASURED), ' ');
      zp_plot_put(file, value_at(table, row, COMPUTED), '\n');
    }
  }
}

/* What is on the x axis: the key that the first column has the name of, in its usual unit. */
static ZpPlotUnit unit_of_x(const ZpColumn *column, char *label, size_t size) {
  ZpPlotUnit unit = {1, ""};
  ZpUnitScale scale;
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    size_t length = strlen(key->name);
    if (strncmp(column->name, key->name, length) != 0 || column->name[length] != '_') continue;
    bool shown = *key->shown && zp_unit_scale(key->shown, key->unit, &scale, NULL) == ZP_OK;
    if (shown) unit.factor = scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor;
    snprintf(label, size, "%s%s%s", key->name, shown ? " / " : "", shown ? key->shown : "");
    return unit;
  }
  snprintf(label, size, "%s", column->name);
  return unit;
}

/* Does a column reach over more than a decade, all of it positive? */
static bool spans_decades(const ZpTable *table, const char *name) {
  double least = INFINITY, largest = 0;
  for (size_t row = 0; row < table->rows; row++) {
    double value = zp_table_get(table, row, name);
    if (isnan(value)) continue;
    least = fmin(least, value);
    largest = fmax(largest, value);
  }
  return least > 0 && largest > 20 * least;
}

/* Axes from 0, or logarithmic where linear ones would hide most points in a corner. */
static const char *axes(const ZpTable *table) {
  if (spans_decades(table, table->column[0].name) && spans_decades(table, table->column[1].name))
    return "set logscale xy\nset offsets graph 0.1, graph 0.1, graph 0.1, graph 0.1\n";
  return "set autoscale noextend\nset yrange [0:*]\nset offsets graph 0.04, graph 0.04, graph 0.06, 0\n";
}

static void script_fit(const ZpPlot *plot, FILE *file) {
  const ZpTable *table = zp_report_result(plot->report, 0)->series;
  const char *const shown[] = {table->column[MEASURED].name, table->column[COMPUTED].name, NULL};
  char label[128];
  const ZpPlotUnit y = zp_plot_table_unit(table, shown, table->column[MEASURED].unit);
  const ZpPlotUnit x = unit_of_x(&table->column[0], label, sizeof label);
  ZpActuatorDef def;
  bool resolved = zp_scenario_def(plot->report->scenario, 0, &def, NULL) == ZP_OK;
  bool fitted = resolved && strspn(def.calibrate.fit, " ") < strlen(def.calibrate.fit);
  zp_plot_head(plot, file, "fit", fitted ? "Measured and fitted" : "Measured and computed", 0.82);
  fputs("set xlabel ", file);
  zp_plot_text(file, label);
  fprintf(file,
          "\nset ylabel '%s / %s' offset 0.5\n%s"
          "plot 'fit.dat' using ($1*%g):($2*%g) with points pt 6 ps 1.2 lw 1.5 lc rgb '%s' title 'measured', \\\n"
          "     'fit.dat' using ($1*%g):($3*%g) with points pt 2 ps 0.8 lw 1.5 lc rgb '%s' title '%s'\n",
          quantity(table), y.text, axes(table), x.factor, y.factor, zp_plot_colour(0), x.factor, y.factor,
          zp_plot_colour(1), fitted ? "fitted" : "computed");
}

const ZpPicture zp_fit_pictures[] = {
    {"fit", "svg", has_fit, script_fit, data_fit},
    {NULL, NULL, NULL, NULL, NULL},
};
