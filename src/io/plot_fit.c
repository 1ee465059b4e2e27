/* Pictures of a calibration: measurements and fit, below or beside them the residuals. fit.svg shows one kind of
 * measurement against one thing that was set, fits.svg several of these. */
#include <math.h>
#include <string.h>

#include "io/plot.h"
#include "io/report.h"
#include "io/units.h"

/* One of them: the column of what was set, and the first of those of what was measured. */
typedef struct Panel {
  size_t x, measured;
} Panel;

/* From that first one on; sigma only where there are several kinds. */
enum { MEASURED, COMPUTED, RESIDUAL, SIGMA };

static double value_at(const ZpTable *table, size_t row, size_t column) {
  return table->value[row * table->columns + column];
}

static bool begins(const ZpTable *table, size_t column, const char *with) {
  return column < table->columns && strncmp(table->column[column].name, with, strlen(with)) == 0;
}

static bool has_sigma(const ZpTable *table, Panel panel) {
  return begins(table, panel.measured + SIGMA, "sigma_");
}

/* Whether a row belongs to a panel. */
static bool is_of(const ZpTable *table, size_t row, Panel panel) {
  return isfinite(value_at(table, row, panel.x)) && isfinite(value_at(table, row, panel.measured));
}

/* Whether there is something to show in it. */
static bool has_panel(const ZpTable *table, Panel panel) {
  for (size_t row = 0; row < table->rows; row++)
    if (is_of(table, row, panel) && isfinite(value_at(table, row, panel.measured + COMPUTED))) return true;
  return false;
}

/* The panel after `panel`, x by x and in each kind by kind; the first after {0, 0}. False if there is none. */
static bool next_panel(const ZpTable *table, Panel *panel) {
  for (; !begins(table, panel->x, "measured_") && panel->x < table->columns; panel->x++, panel->measured = 0)
    while (++panel->measured < table->columns)
      if (begins(table, panel->measured, "measured_") && has_panel(table, *panel)) return true;
  return false;
}

static const ZpTable *table_of(const ZpPlot *plot, size_t run) {
  return zp_report_result(plot->report, run)->series;
}

static size_t count_panels(const ZpPlot *plot) {
  size_t count = 0;
  const ZpTable *table = plot->shows == ZP_SHOWS_fit && plot->report->count > 0 ? table_of(plot, 0) : NULL;
  for (Panel panel = {0, 0}; table && next_panel(table, &panel);)
    count++;
  return count;
}

static bool has_fit(const ZpPlot *plot) {
  return count_panels(plot) == 1;
}

static bool has_fits(const ZpPlot *plot) {
  return count_panels(plot) > 1;
}

static void put_panel(const ZpPlot *plot, Panel panel, FILE *file) {
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = table_of(plot, run);
    for (size_t row = 0; table && row < table->rows; row++) {
      if (!is_of(table, row, panel)) continue;
      zp_plot_put(file, value_at(table, row, panel.x), ' ');
      zp_plot_put(file, value_at(table, row, panel.measured), ' ');
      zp_plot_put(file, value_at(table, row, panel.measured + COMPUTED), has_sigma(table, panel) ? ' ' : '\n');
      if (has_sigma(table, panel)) zp_plot_put(file, value_at(table, row, panel.measured + SIGMA), '\n');
    }
  }
}

/* Two empty lines are between the panels. */
static void data_fit(const ZpPlot *plot, FILE *file) {
  const char *between = "";
  fputs(zp_report_result(plot->report, 0)->series && count_panels(plot) > 1 ? "# x measured fitted sigma\n"
                                                                            : "# x measured fitted\n",
        file);
  for (Panel panel = {0, 0}; next_panel(table_of(plot, 0), &panel); between = "\n\n") {
    fputs(between, file);
    put_panel(plot, panel, file);
  }
}

/* Of the only panel "NAME", else "NAME[k]". */
static ZpPlotEntry entry(const char *name, size_t k) {
  ZpPlotEntry alone;
  snprintf(alone.text, sizeof alone.text, "%s", name);
  return k == 0 ? alone : zp_plot_entry(name, k);
}

/* What was measured: "force in data.file" => "force". */
static void define_quantity(const ZpColumn *column, size_t k, FILE *file) {
  const char *end = strstr(column->help, " in data.file");
  char quantity[128];
  snprintf(quantity, sizeof quantity, "%.*s", end ? (int)(end - column->help) : 127, column->help);
  zp_plot_define_text(file, entry("quantity", k).text, quantity);
}

/* What is on the x axis: the key that the column has the name of, in its usual unit. */
static void define_x(const ZpColumn *column, size_t k, FILE *file) {
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
  zp_plot_define(file, entry("x_factor", k).text, factor);
  zp_plot_define_text(file, entry("x_label", k).text, label);
}

static bool is_fitted(const ZpPlot *plot) {
  ZpActuatorDef def;
  bool resolved = zp_scenario_def(plot->report->scenario, 0, &def, NULL) == ZP_OK;
  return resolved && strspn(def.calibrate.fit, " ") < strlen(def.calibrate.fit);
}

/* NAME_low and NAME_high, of the numbers of a panel that there are. */
static void define_range(const ZpTable *table, Panel panel, size_t column, const char *name, size_t k, FILE *file) {
  char variable[32];
  double low = NAN, high = NAN;
  for (size_t row = 0; row < table->rows; row++) {
    if (!is_of(table, row, panel)) continue;
    low = fmin(low, value_at(table, row, column));
    high = fmax(high, value_at(table, row, column));
  }
  snprintf(variable, sizeof variable, "%s_low", name);
  zp_plot_define(file, entry(variable, k).text, low);
  snprintf(variable, sizeof variable, "%s_high", name);
  zp_plot_define(file, entry(variable, k).text, high);
}

/* The largest residual over its standard deviation; NaN where there are none. */
static void define_weighted(const ZpTable *table, Panel panel, size_t k, FILE *file) {
  double most = NAN;
  for (size_t row = 0; row < table->rows && has_sigma(table, panel); row++)
    if (is_of(table, row, panel))
      most = fmax(most,
                  fabs(value_at(table, row, panel.measured + RESIDUAL)) / value_at(table, row, panel.measured + SIGMA));
  zp_plot_define(file, entry("weighted_most", k).text, most);
}

static void define_panel(const ZpTable *table, Panel panel, size_t k, FILE *file) {
  static const char *const name[] = {"measured", "computed", "residual"};
  define_quantity(&table->column[panel.measured], k, file);
  zp_plot_define_word(file, entry("si", k).text, table->column[panel.measured].unit);
  define_x(&table->column[panel.x], k, file);
  define_range(table, panel, panel.x, "x", k, file);
  for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
    define_range(table, panel, panel.measured + i, name[i], k, file);
  if (k > 0) define_weighted(table, panel, k, file);
}

static void define_fit(const ZpPlot *plot, FILE *file) {
  static const char *const array[] = {
      "quantity",      "si",           "x_factor",      "x_label",      "x_low",         "x_high",       "measured_low",
      "measured_high", "computed_low", "computed_high", "residual_low", "residual_high", "weighted_most"};
  const size_t panels = count_panels(plot);
  const ZpTable *table = table_of(plot, 0);
  size_t k = panels > 1;
  fputs("columns = ''\n", file);
  zp_plot_define_count(file, "fitted", is_fitted(plot));
  for (size_t i = 0; i < sizeof array / sizeof array[0] && panels > 1; i++)
    zp_plot_define_array(file, array[i], panels);
  for (Panel panel = {0, 0}; next_panel(table, &panel); k++)
    define_panel(table, panel, k, file);
}

static void define_fits(const ZpPlot *plot, FILE *file) {
  Panel first = {0, 0};
  define_fit(plot, file);
  zp_plot_define_count(file, "weighted", next_panel(table_of(plot, 0), &first) && has_sigma(table_of(plot, 0), first));
}

const ZpPicture zp_fit_pictures[] = {
    {"fit", "svg", has_fit, define_fit, data_fit, "fit.gp"},
    {"fits", "svg", has_fits, define_fits, data_fit, "fits.gp"},
    {0},
};
