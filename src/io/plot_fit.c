/* Pictures of a calibration: measurements and fit, below or beside them the residuals. fit.svg shows one kind of
 * measurement against one thing that was set, fits.svg several of these, a panel each. */
#include <math.h>
#include <string.h>

#include "io/plot.h"

/* A panel: the column of the quantity that was set, and the first of those of the measured quantity. After that one are
 * the computed value, the residual, and, if it is known, sigma. */
typedef struct Panel {
  size_t x, measured;
} Panel;

enum { COMPUTED = 1, SIGMA = 3 };

static const ZpTable *table_of(const ZpPlot *plot, size_t run) {
  return zp_report_result(plot->report, run)->series;
}

static bool begins(const ZpTable *table, size_t column, const char *with) {
  return column < table->columns && strncmp(table->column[column].name, with, strlen(with)) == 0;
}

/* Whether there is something to show in it. */
static bool has_panel(const ZpTable *table, Panel panel) {
  for (size_t row = 0; row < table->rows; row++) {
    const double *value = table->value + row * table->columns, *measured = value + panel.measured;
    if (isfinite(value[panel.x]) && isfinite(measured[0]) && isfinite(measured[COMPUTED])) return true;
  }
  return false;
}

/* The panel after `panel`, x by x and in each kind by kind; the first after {0, 0}. False if there is none. */
static bool next_panel(const ZpTable *table, Panel *panel) {
  for (; !begins(table, panel->x, "measured_") && panel->x < table->columns; panel->x++, panel->measured = 0)
    while (++panel->measured < table->columns)
      if (begins(table, panel->measured, "measured_") && has_panel(table, *panel)) return true;
  return false;
}

static size_t count_panels(const ZpPlot *plot) {
  size_t count = 0;
  for (Panel panel = {0, 0}; table_of(plot, 0) && next_panel(table_of(plot, 0), &panel);)
    count++;
  return count;
}

static bool has_fit(const ZpPlot *plot) {
  return count_panels(plot) == 1;
}

static bool has_fits(const ZpPlot *plot) {
  return count_panels(plot) > 1;
}

/* The tables of all runs, one below the other. */
static void data_fit(const ZpPlot *plot, FILE *file) {
  fputc('#', file);
  for (size_t i = 0; i < table_of(plot, 0)->columns; i++)
    fprintf(file, " %s", table_of(plot, 0)->column[i].name);
  fputc('\n', file);
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = table_of(plot, run);
    for (size_t i = 0; table && i < table->rows * table->columns; i++)
      zp_plot_put(file, table->value[i], (i + 1) % table->columns ? ' ' : '\n');
  }
}

/* The key that was set, load.mass of "load.mass_kg", load.share of "load.share"; -1: none, it is the time. */
static int key_of(const ZpColumn *column) {
  int found = -1;
  size_t longest = 0;
  for (int key = 0; key < zp_key_count(); key++) {
    const size_t length = strlen(zp_key(key)->name);
    if (length < longest || strncmp(column->name, zp_key(key)->name, length) != 0) continue;
    if (column->name[length] != '_' && column->name[length] != 0) continue;
    longest = length;
    found = key;
  }
  return found;
}

/* What was set. */
static void define_x(const ZpColumn *column, size_t k, FILE *file) {
  const int key = key_of(column);
  if (key >= 0) {
    zp_plot_define_key_axis(file, "x", k, key);
    return;
  }
  zp_plot_define_text(file, zp_plot_entry("x_name", k).text, "time");
  zp_plot_define_word(file, zp_plot_entry("x_unit", k).text, column->unit);
  zp_plot_define(file, zp_plot_entry("x_factor", k).text, 1);
}

/* The measured quantity: "force in data.file" => "force"; the columns of x and of it, from 1. */
static void define_panel(const ZpTable *table, Panel panel, size_t k, FILE *file) {
  const ZpColumn *measured = &table->column[panel.measured];
  const char *end = strstr(measured->help, " in data.file");
  char quantity[128];
  snprintf(quantity, sizeof quantity, "%.*s", end ? (int)(end - measured->help) : 127, measured->help);
  zp_plot_define_text(file, zp_plot_entry("quantity", k).text, quantity);
  zp_plot_define_word(file, zp_plot_entry("si", k).text, measured->unit);
  zp_plot_define_count(file, zp_plot_entry("x_in", k).text, panel.x + 1);
  zp_plot_define_count(file, zp_plot_entry("y_in", k).text, panel.measured + 1);
  define_x(&table->column[panel.x], k, file);
}

static void define_fit(const ZpPlot *plot, FILE *file) {
  static const char *const array[] = {"quantity", "si", "x_in", "y_in", "x_name", "x_unit", "x_factor"};
  const char *fitted = plot->def.calibrate.fit;
  const ZpTable *table = table_of(plot, 0);
  size_t k = 0;
  for (size_t i = 0; i < sizeof array / sizeof array[0]; i++)
    zp_plot_define_array(file, array[i], count_panels(plot));
  for (Panel panel = {0, 0}; next_panel(table, &panel);) {
    if (k++ == 0) zp_plot_define_count(file, "weighted", begins(table, panel.measured + SIGMA, "sigma_"));
    define_panel(table, panel, k, file);
  }
  zp_plot_define_count(file, "fitted", fitted[strspn(fitted, " ")] != 0);
}

const ZpPicture zp_fit_pictures[] = {
    {"fit", "svg", "fit.gp", ZP_OF(fit), ZP_OF(fit), .has = has_fit, .define = define_fit, .data = data_fit},
    {"fits", "svg", "fits.gp", ZP_OF(fit), ZP_OF(fit), .has = has_fits, .define = define_fit, .data = data_fit},
    {0},
};
