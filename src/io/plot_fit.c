/* Picture of a calibration, fit.svg: measurements and fit, below them the residuals. */
#include <math.h>
#include <string.h>

#include "io/plot.h"
#include "io/report.h"
#include "io/units.h"

/* The columns of a calibration: x, then measured, computed and their difference in the unit of what was measured. */
enum { X, MEASURED, COMPUTED, RESIDUAL };

static double value_at(const ZpTable *table, size_t row, size_t column) {
  return table->value[row * table->columns + column];
}

/* What was measured, "force in data.file" => "force / N" in a unit that suits. */
static void label_of_y(const ZpTable *table, const char *unit, FILE *file) {
  const char *help = table->column[MEASURED].help, *end = strstr(help, " in data.file");
  fprintf(file, "set ylabel '%.*s / %s' offset 0.5\n", end ? (int)(end - help) : (int)strlen(help), help, unit);
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

static bool is_fitted(const ZpPlot *plot) {
  ZpActuatorDef def;
  bool resolved = zp_scenario_def(plot->report->scenario, 0, &def, NULL) == ZP_OK;
  return resolved && strspn(def.calibrate.fit, " ") < strlen(def.calibrate.fit);
}

/* Few tics of a low panel. */
static void few_tics(const ZpTable *table, double factor, FILE *file) {
  enum { TICS = 4 };
  double least = 0, largest = 0;
  for (size_t row = 0; row < table->rows; row++) {
    least = fmin(least, value_at(table, row, RESIDUAL));
    largest = fmax(largest, value_at(table, row, RESIDUAL));
  }
  double step = zp_plot_step((largest - least) * factor, TICS);
  if (step > 0) fprintf(file, "set ytics %.6g\n", step);
}

/* The residuals, below: fitted minus measured, against the same x. */
static void script_residuals(const ZpTable *table, ZpPlotUnit x, const char *label, FILE *file) {
  const char *const shown[] = {table->column[RESIDUAL].name, NULL};
  const ZpPlotUnit y = zp_plot_table_unit(table, shown, table->column[RESIDUAL].unit);
  few_tics(table, y.factor, file);
  fputs("unset label\nset tmargin at screen 0.33\nset bmargin at screen 0.12\nset format x\nset xlabel ", file);
  zp_plot_text(file, label);
  fprintf(file,
          "\nset ylabel 'residual / %s' offset 0.5\nunset logscale y\nset yrange [*:*]\nset offsets %s\n"
          "set xzeroaxis lt 1 lw 1 lc rgb '#555555'\n"
          "plot 'fit.dat' using ($1*%g):(($3-$2)*%g) with impulses lw 1.5 lc rgb '%s' notitle, \\\n"
          "     'fit.dat' using ($1*%g):(($3-$2)*%g) with points pt 7 ps 0.6 lc rgb '%s' notitle\n"
          "unset multiplot\n",
          y.text, "graph 0.04, graph 0.04, graph 0.15, graph 0.15", x.factor, y.factor, zp_plot_colour(1), x.factor,
          y.factor, zp_plot_colour(1));
}

static void script_fit(const ZpPlot *plot, FILE *file) {
  const ZpTable *table = zp_report_result(plot->report, 0)->series;
  const char *const shown[] = {table->column[MEASURED].name, table->column[COMPUTED].name, NULL};
  char label[128];
  const ZpPlotUnit y = zp_plot_table_unit(table, shown, table->column[MEASURED].unit);
  const ZpPlotUnit x = unit_of_x(&table->column[0], label, sizeof label);
  bool fitted = is_fitted(plot);
  zp_plot_head(plot, file, "fit", fitted ? "Measured and fitted" : "Measured and computed", 0.82);
  label_of_y(table, y.text, file);
  fprintf(file,
          "%sset multiplot\nset bmargin at screen 0.38\nset format x ''\n"
          "plot 'fit.dat' using ($1*%g):($2*%g) with points pt 6 ps 1.2 lw 1.5 lc rgb '%s' title 'measured', \\\n"
          "     'fit.dat' using ($1*%g):($3*%g) with points pt 2 ps 0.8 lw 1.5 lc rgb '%s' title '%s'\n",
          axes(table), x.factor, y.factor, zp_plot_colour(0), x.factor, y.factor, zp_plot_colour(1),
          fitted ? "fitted" : "computed");
  script_residuals(table, x, label, file);
}

const ZpPicture zp_fit_pictures[] = {
    {"fit", "svg", has_fit, script_fit, data_fit},
    {NULL, NULL, NULL, NULL, NULL},
};
