/* Pictures of actuators in series: members.svg, in motion their openings over time, the order in which they zip; of
 * their limits, the voltages of each. */
#include <stdio.h>

#include "io/plot.h"

/* Right edge of the plot area; the legend is to the right of it. */
#define RIGHT 0.76

static const ZpTable *series(const ZpPlot *plot) {
  return plot->single->series;
}

static bool is_of_series(const ZpPlot *plot, ZpShows shows) {
  return plot->shows == shows && plot->single && plot->def.stack.series > 1;
}

static bool has_openings(const ZpPlot *plot) {
  return is_of_series(plot, ZP_SHOWS_motion) && zp_plot_has(series(plot), "member_1_opening_m");
}

static void script_openings(const ZpPlot *plot, FILE *file) {
  ZpPlotUnit time = zp_plot_table_unit(series(plot), (const char *const[]){"time_s", NULL}, "s");
  ZpPlotUnit length =
      zp_plot_table_unit(series(plot), (const char *const[]){"member_1_opening_m", "member_2_opening_m", NULL}, "m");
  zp_plot_head(plot, file, "members", "Openings of the members over time", RIGHT);
  zp_plot_foot(plot, file, "member 1 is the uppermost");
  fprintf(file, "set datafile separator ','\nset xrange [0:*]\nset xlabel 'time / %s'\nset ylabel 'opening / %s'\n",
          time.text, length.text);
  for (int member = 1; member <= plot->def.stack.series; member++) {
    char expression[64], title[32];
    snprintf(expression, sizeof expression, "column('member_%d_opening_m')*%g", member, length.factor);
    snprintf(title, sizeof title, "member %d", member);
    zp_plot_curve(file, member == 1, time, expression, title, (size_t)member - 1);
  }
  fputc('\n', file);
}

static bool has_limits(const ZpPlot *plot) {
  return is_of_series(plot, ZP_SHOWS_limits) && zp_plot_has(series(plot), "release_voltage_V");
}

static void script_limits(const ZpPlot *plot, FILE *file) {
  static const char *const name[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V"};
  static const char *const title[] = {"pull-in", "closing", "release"};
  static const int point[] = {5, 6, 9}; /* closing: a ring, for it is often where pull-in is */
  static const double size[] = {1.2, 2.2, 1.5};
  ZpPlotUnit voltage = zp_plot_unit(plot->def.drive.voltage, "V");
  zp_plot_head(plot, file, "members", "Limits of the members", RIGHT);
  zp_plot_remark(file, "member 1 is the uppermost");
  fprintf(file,
          "set datafile separator ','\nset xrange [0.5:%d.5]\nset xtics 1\nset yrange [0:*]\n"
          "set xlabel 'member'\nset ylabel 'voltage / %s'\n",
          plot->def.stack.series, voltage.text);
  for (size_t k = 0; k < sizeof name / sizeof name[0]; k++)
    fprintf(
        file,
        "%s'../table.csv' using (column('member')):(column('%s')*%g) with points pt %d ps %g lc rgb '%s' title '%s'",
        k ? ", \\\n     " : "plot ", name[k], voltage.factor, point[k], size[k], zp_plot_colour(k), title[k]);
  fputc('\n', file);
}

const ZpPicture zp_member_pictures[] = {
    {"members", "svg", has_openings, script_openings, NULL},
    {"members", "svg", has_limits, script_limits, NULL},
    {0},
};
