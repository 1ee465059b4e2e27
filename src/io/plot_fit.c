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

/* What was measured: "force in data.file" => "force". */
static void define_quantity(const ZpTable *table, FILE *file) {
  const char *help = table->column[MEASURED].help, *end = strstr(help, " in data.file");
  char quantity[128];
  snprintf(quantity, sizeof quantity, "%.*s", end ? (int)(end - help) : 127, help);
  zp_plot_define_text(file, "quantity", quantity);
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
static void define_x(const ZpColumn *column, FILE *file) {
  double factor = 1;
  char label[128];
  ZpUnitScale scale;
  snprintf(label, sizeof label, "%s", column->name);
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    size_t length = strlen(key->name);
    if (strncmp(column->name, key->name, length) != 0 || column->name[length] != '_') continue;
    bool shown = *key->shown && zp_unit_scale(key->shown, key->unit, &scale, NULL) == ZP_OK;
    if (shown) factor = scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor;
    snprintf(label, sizeof label, "%s%s%s", key->name, shown ? " / " : "", shown ? key->shown : "");
    break;
  }
  zp_plot_define(file, "x_factor", factor);
  zp_plot_define_text(file, "x_label", label);
}

static bool is_fitted(const ZpPlot *plot) {
  ZpActuatorDef def;
  bool resolved = zp_scenario_def(plot->report->scenario, 0, &def, NULL) == ZP_OK;
  return resolved && strspn(def.calibrate.fit, " ") < strlen(def.calibrate.fit);
}

/* NAME_low and NAME_high, of the numbers that there are. */
static void define_range(const ZpTable *table, size_t column, const char *name, FILE *file) {
  char variable[32];
  double low = NAN, high = NAN;
  for (size_t row = 0; row < table->rows; row++) {
    low = fmin(low, value_at(table, row, column));
    high = fmax(high, value_at(table, row, column));
  }
  snprintf(variable, sizeof variable, "%s_low", name);
  zp_plot_define(file, variable, low);
  snprintf(variable, sizeof variable, "%s_high", name);
  zp_plot_define(file, variable, high);
}

static void define_fit(const ZpPlot *plot, FILE *file) {
  static const char *const name[] = {"x", "measured", "computed", "residual"};
  const ZpTable *table = zp_report_result(plot->report, 0)->series;
  fputs("columns = ''\n", file);
  zp_plot_define_count(file, "fitted", is_fitted(plot));
  define_quantity(table, file);
  zp_plot_define_word(file, "si", table->column[MEASURED].unit);
  define_x(&table->column[X], file);
  for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
    define_range(table, i, name[i], file);
}

const ZpPicture zp_fit_pictures[] = {
    {"fit", "svg", has_fit, define_fit, data_fit, "fit.gp"},
    {0},
};
