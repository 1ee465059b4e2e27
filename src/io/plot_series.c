/* Pictures of one run over time: stroke.svg, zipped_length.svg, voltage.svg, source.svg, control.svg, loops.svg,
 * energies.svg, electric.svg, stress.svg, plastic.svg. */
#include <math.h>
#include <string.h>

#include "io/plot.h"

/* Right edge of the plot area; the legend is to the right of it. */
#define RIGHT 0.76

static bool is_film(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_motion && plot->single;
}

static bool is_ribbon(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON;
}

static const ZpTable *series(const ZpPlot *plot) {
  return plot->single->series;
}

static ZpPlotUnit time_unit(const ZpPlot *plot) {
  return zp_plot_table_unit(series(plot), (const char *const[]){"time_s", NULL}, "s");
}

/* What follows the head of a picture that reads the table. */
static void begin(FILE *file, ZpPlotUnit time) {
  fputs("set datafile separator ','\nset key autotitle columnhead\nset xrange [0:*]\n", file);
  fprintf(file, "set xlabel 'time / %s'\n", time.text);
}

static void lower_panel(FILE *file, ZpPlotUnit time) {
  char label[32];
  snprintf(label, sizeof label, "time / %s", time.text);
  zp_plot_lower_panel(file, RIGHT, label);
}

/* A dashed line where the actuator has zipped. */
static void mark_zip(const ZpPlot *plot, FILE *file, ZpPlotUnit time) {
  double zip = zp_result_get(plot->single, "zip_time_s") * time.factor;
  if (isfinite(zip))
    fprintf(file, "set arrow 1 from %.17g, graph 0 to %.17g, graph 1 nohead dt 2 lw 1.5 lc rgb '#555555'\n", zip, zip);
}

static void name_zip(const ZpPlot *plot, FILE *file, ZpPlotUnit time) {
  double zip = zp_result_get(plot->single, "zip_time_s") * time.factor;
  if (isfinite(zip))
    fprintf(file,
            "set label 5 'zip time %.4g %s' at screen %g, screen 0.20 left font ',12' tc rgb '#555555'\n"
            "set arrow 2 from screen %g, screen 0.20 to screen %g, screen 0.20 nohead dt 2 lw 1.5 lc rgb '#555555'\n",
            zip, time.text, RIGHT + 0.06, RIGHT + 0.02, RIGHT + 0.052);
}

static bool has_stroke(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "stroke_m");
}

/* Curves of the columns that have numbers. `label` is of the y axis. */
static void plot_columns(const ZpPlot *plot, FILE *file, ZpPlotUnit time, ZpPlotUnit unit, const char *label,
                         const char *const (*curve)[2], size_t curves) {
  bool first = true;
  fprintf(file, "set ylabel '%s / %s' offset 0.5\n", label, unit.text);
  for (size_t i = 0; i < curves; i++) {
    char expression[128];
    if (!zp_plot_has(series(plot), curve[i][0])) continue;
    snprintf(expression, sizeof expression, "column('%s')*%g", curve[i][0], unit.factor);
    zp_plot_curve(file, first, time, expression, curve[i][1], i);
    first = false;
  }
  fputc('\n', file);
}

static void script_stroke(const ZpPlot *plot, FILE *file) {
  const char *const curve[][2] = {{"stroke_m", "stroke"}, {"opening_m", "opening"}};
  const bool contracts = zp_plot_has(series(plot), "contraction");
  const bool opens = zp_plot_has(series(plot), "opening_m");
  ZpPlotUnit time = time_unit(plot);
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"stroke_m", "opening_m", NULL}, "m");
  zp_plot_head(plot, file, "stroke", opens ? "Stroke and opening over time" : "Stroke over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  begin(file, time);
  if (contracts) zp_plot_upper_panel(file);
  mark_zip(plot, file, time);
  if (!contracts) name_zip(plot, file, time);
  plot_columns(plot, file, time, length, opens ? "length" : "stroke", curve, 2);
  if (!contracts) return;
  lower_panel(file, time);
  name_zip(plot, file, time);
  fputs("set ylabel 'contraction / %' offset 0.5\n", file);
  zp_plot_curve(file, true, time, "column('contraction')*100", "contraction", 2);
  fputs("\nunset multiplot\n", file);
}

static bool has_zipped_length(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && zp_plot_has(series(plot), "zipped_length_m");
}

static void script_zipped_length(const ZpPlot *plot, FILE *file) {
  const char *const curve[][2] = {{"zipped_length_m", "zipped length"}};
  ZpPlotUnit time = time_unit(plot);
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"zipped_length_m", NULL}, "m");
  zp_plot_head(plot, file, "zipped_length", "Closed length from the clip, one half, over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  begin(file, time);
  mark_zip(plot, file, time);
  name_zip(plot, file, time);
  plot_columns(plot, file, time, length, "zipped length", curve, 1);
}

/* Only of a voltage that changes. */
static bool has_voltage(const ZpPlot *plot) {
  if (!is_film(plot) || is_ribbon(plot) || !zp_plot_has(series(plot), "opening_m")) return false;
  for (size_t i = 1; i < series(plot)->rows; i++)
    if (zp_table_get(series(plot), i, "voltage_V") != zp_table_get(series(plot), 0, "voltage_V")) return true;
  return false;
}

static void script_voltage(const ZpPlot *plot, FILE *file) {
  const char *const voltages[][2] = {{"voltage_V", "voltage"}}, *const openings[][2] = {{"opening_m", "opening"}};
  ZpPlotUnit time = time_unit(plot);
  ZpPlotUnit voltage = zp_plot_table_unit(series(plot), (const char *const[]){"voltage_V", NULL}, "V");
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"opening_m", NULL}, "m");
  zp_plot_head(plot, file, "voltage", "Voltage and opening over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  begin(file, time);
  fputs("set yrange [*<0:0<*]\n", file);
  zp_plot_upper_panel(file);
  plot_columns(plot, file, time, voltage, "voltage", voltages, 1);
  lower_panel(file, time);
  plot_columns(plot, file, time, length, "opening", openings, 1);
  fputs("unset multiplot\n", file);
}

/* Curves of one panel. */
typedef struct Panel {
  const char *label;
  ZpPlotUnit unit;
  const char *const (*curve)[2];
  size_t curves;
} Panel;

/* Two panels over time, with the small print of motions. */
static void two_panels(const ZpPlot *plot, FILE *file, const char *name, const char *title, const Panel *upper,
                       const Panel *lower) {
  ZpPlotUnit time = time_unit(plot);
  zp_plot_head(plot, file, name, title, RIGHT);
  zp_plot_foot(plot, file, NULL);
  begin(file, time);
  zp_plot_upper_panel(file);
  plot_columns(plot, file, time, upper->unit, upper->label, upper->curve, upper->curves);
  lower_panel(file, time);
  plot_columns(plot, file, time, lower->unit, lower->label, lower->curve, lower->curves);
  fputs("unset multiplot\n", file);
}

/* Of a source that is not ideal. */
static bool has_source(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && plot->def.source.model != ZP_SOURCE_IDEAL &&
         zp_plot_has(series(plot), "current_A");
}

static void script_source(const ZpPlot *plot, FILE *file) {
  const char *const voltages[][2] = {{"command_V", "command"},
                                     {"source_voltage_V", "inner"},
                                     {"voltage_V", "electrodes"}},
                    *const currents[][2] = {{"current_A", "current"}};
  ZpPlotUnit voltage = zp_plot_table_unit(series(plot), (const char *const[]){"command_V", NULL}, "V");
  ZpPlotUnit current = zp_plot_table_unit(series(plot), (const char *const[]){"current_A", NULL}, "A");
  two_panels(plot, file, "source", "Voltages and current of the source over time",
             &(Panel){"voltage", voltage, voltages, 3}, &(Panel){"current", current, currents, 1});
}

/* Of what leaks. */
static bool has_interface(const ZpPlot *plot) {
  bool leaks = isfinite(plot->def.insulator.resistivity) || isfinite(plot->def.medium.resistivity);
  return leaks && is_film(plot) && zp_plot_has(series(plot), "interface_voltage_V");
}

static void script_interface(const ZpPlot *plot, FILE *file) {
  const char *const voltages[][2] = {{"voltage_V", "voltage"}, {"interface_voltage_V", "interface"}},
                    *const openings[][2] = {{"opening_m", "opening"}};
  ZpPlotUnit voltage =
      zp_plot_table_unit(series(plot), (const char *const[]){"voltage_V", "interface_voltage_V", NULL}, "V");
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"opening_m", "stroke_m", NULL}, "m");
  two_panels(plot, file, "interface", "Charge between insulators and liquid over time",
             &(Panel){"voltage", voltage, voltages, 2}, &(Panel){"length", length, openings, 1});
}

/* Of a meter of the capacitance. */
static bool has_sense(const ZpPlot *plot) {
  return is_film(plot) && isfinite(plot->def.sense.frequency) && zp_plot_has(series(plot), "sensed_stroke_m");
}

static void script_sense(const ZpPlot *plot, FILE *file) {
  const char *const strokes[][2] = {{"stroke_m", "stroke"}, {"sensed_stroke_m", "stroke by capacitance"}},
                    *const capacitances[][2] = {{"capacitance_F", "capacitance"},
                                                {"sensed_capacitance_F", "as it is read"}};
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"stroke_m", NULL}, "m");
  ZpPlotUnit farad = zp_plot_table_unit(series(plot), (const char *const[]){"capacitance_F", NULL}, "F");
  two_panels(plot, file, "sense", "Stroke by its capacitance over time", &(Panel){"stroke", length, strokes, 2},
             &(Panel){"capacitance", farad, capacitances, 2});
}

/* Of a controller. */
static bool has_control(const ZpPlot *plot) {
  return is_film(plot) && plot->def.control.kind != ZP_CONTROL_NONE && zp_plot_has(series(plot), "command_V");
}

static void script_control(const ZpPlot *plot, FILE *file) {
  static const struct {
    const char *column, *setpoint, *measured, *label;
  } of[ZpControlSignal_COUNT] = {
      [ZP_CONTROL_OPENING] = {"opening_m", "setpoint_m", "measured_m", "opening"},
      [ZP_CONTROL_STROKE] = {"stroke_m", "setpoint_m", "measured_m", "stroke"},
      [ZP_CONTROL_CONTRACTION] = {"contraction", "setpoint", "measured", "contraction"},
      [ZP_CONTROL_CAPACITANCE] = {"capacitance_F", "setpoint_F", "measured_F", "capacitance"}};
  size_t signal = (size_t)plot->def.control.signal;
  const char *si = zp_control_unit(&plot->def);
  const char *const curves[][2] = {{of[signal].measured, "measured"},
                                   {of[signal].setpoint, "setpoint"},
                                   {of[signal].column, of[signal].label}},
                    *const voltages[][2] = {{"command_V", "command"}, {"voltage_V", "electrodes"}};
  bool noisy = plot->def.control.noise > 0, ideal = plot->def.source.model == ZP_SOURCE_IDEAL;
  ZpPlotUnit unit = {100, "%"};
  if (strcmp(si, "1") != 0) unit = zp_plot_table_unit(series(plot), (const char *const[]){of[signal].column, NULL}, si);
  ZpPlotUnit voltage = zp_plot_table_unit(series(plot), (const char *const[]){"command_V", NULL}, "V");
  two_panels(plot, file, "control", "What is held, and the voltage that holds it",
             &(Panel){of[signal].label, unit, curves + !noisy, 2 + noisy},
             &(Panel){"voltage", voltage, voltages, ideal ? 1 : 2});
}

/* Of a cycle. */
static bool has_loops(const ZpPlot *plot) {
  return is_film(plot) && isfinite(zp_result_get(plot->single, "energy_per_cycle_J")) &&
         zp_plot_has(series(plot), "charge_C");
}

/* Tics of a panel of half the width: their labels stand side by side. */
static void few_tics(const ZpTable *table, const char *column, ZpPlotUnit unit, FILE *file) {
  enum { TICS = 6 };
  double least = INFINITY, largest = -INFINITY;
  for (size_t row = 0; row < table->rows; row++) {
    least = fmin(least, zp_table_get(table, row, column));
    largest = fmax(largest, zp_table_get(table, row, column));
  }
  double step = zp_plot_step((largest - least) * unit.factor, TICS);
  if (step > 0) fprintf(file, "set xtics %.6g\n", step);
}

/* One closed curve: a column against another. */
static void plot_loop(const ZpTable *table, FILE *file, const char *x, ZpPlotUnit x_unit, const char *x_label,
                      const char *y, ZpPlotUnit y_unit, const char *y_label) {
  fprintf(file, "set xlabel '%s / %s'\nset ylabel '%s / %s' offset 0.5\n", x_label, x_unit.text, y_label, y_unit.text);
  few_tics(table, x, x_unit, file);
  fprintf(file, "plot '../table.csv' using (column('%s')*%g):(column('%s')*%g) with lines lw 2 lc rgb '%s' notitle\n",
          x, x_unit.factor, y, y_unit.factor, zp_plot_colour(0));
}

static void script_loops(const ZpPlot *plot, FILE *file) {
  const ZpTable *table = series(plot);
  ZpPlotUnit voltage = zp_plot_table_unit(table, (const char *const[]){"voltage_V", NULL}, "V"),
             charge = zp_plot_table_unit(table, (const char *const[]){"charge_C", NULL}, "C"),
             length = zp_plot_table_unit(table, (const char *const[]){"opening_m", NULL}, "m"),
             force = zp_plot_table_unit(table, (const char *const[]){"force_N", NULL}, "N");
  zp_plot_head(plot, file, "loops", "A cycle: the area of the left loop is what the source gives", 0.96);
  fputs("set datafile separator ','\nset key autotitle columnhead\n", file);
  fputs("set multiplot\nset lmargin at screen 0.10\nset rmargin at screen 0.47\n", file);
  plot_loop(table, file, "charge_C", charge, "charge", "voltage_V", voltage, "voltage");
  fputs("unset label\nset lmargin at screen 0.60\nset rmargin at screen 0.97\n", file);
  plot_loop(table, file, "opening_m", length, "opening", "force_N", force, "electric force");
  fputs("unset multiplot\n", file);
}

static bool has_energies(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "kinetic_energy_J");
}

/* A curve of energies: the sum of one or two columns. */
typedef struct Energy {
  const char *column, *second, *title;
  bool electric; /* always 0 for the kind ribbon */
} Energy;

static const Energy energies[] = {
    {"kinetic_energy_J", NULL, "kinetic", false},     {"axial_energy_J", "bending_energy_J", "axial + bending", false},
    {"gravity_energy_J", NULL, "gravity", false},     {"field_energy_J", NULL, "field", true},
    {"electric_work_J", NULL, "electric work", true}, {"drag_loss_J", "contact_loss_J", "losses", false},
    {"charging_loss_J", NULL, "charging loss", true}, {"energy_imbalance_J", NULL, "imbalance", false},
};

#define ENERGIES (sizeof energies / sizeof energies[0])

static void script_energies(const ZpPlot *plot, FILE *file) {
  const char *column[ENERGIES + 1] = {NULL};
  bool first = true;
  for (size_t i = 0; i < ENERGIES; i++)
    column[i] = energies[i].column;
  ZpPlotUnit time = time_unit(plot), energy = zp_plot_table_unit(series(plot), column, "J");
  zp_plot_head(plot, file, "energies", "Energies over time", RIGHT);
  begin(file, time);
  fprintf(file, "set ylabel 'energy / %s' offset 0.5\n", energy.text);
  for (size_t i = 0; i < ENERGIES; i++) {
    const Energy *e = &energies[i];
    char expression[192];
    if (!zp_plot_has(series(plot), e->column) || (e->electric && is_ribbon(plot))) continue;
    if (e->second && zp_plot_has(series(plot), e->second))
      snprintf(expression, sizeof expression, "(column('%s')+column('%s'))*%g", e->column, e->second, energy.factor);
    else
      snprintf(expression, sizeof expression, "column('%s')*%g", e->column, energy.factor);
    zp_plot_curve(file, first, time, expression, e->title, i);
    first = false;
  }
  fputc('\n', file);
}

static bool has_electric(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && zp_plot_has(series(plot), "charge_C") &&
         zp_plot_has(series(plot), "force_N");
}

static void script_electric(const ZpPlot *plot, FILE *file) {
  const char *const charges[][2] = {{"charge_C", "charge"}}, *const forces[][2] = {{"force_N", "force"}};
  ZpPlotUnit time = time_unit(plot);
  ZpPlotUnit charge = zp_plot_table_unit(series(plot), (const char *const[]){"charge_C", NULL}, "C");
  ZpPlotUnit force = zp_plot_table_unit(series(plot), (const char *const[]){"force_N", NULL}, "N");
  zp_plot_head(plot, file, "electric", "Charge and electric force of the whole actuator over time", RIGHT);
  begin(file, time);
  zp_plot_upper_panel(file);
  plot_columns(plot, file, time, charge, "charge", charges, 1);
  lower_panel(file, time);
  plot_columns(plot, file, time, force, "force", forces, 1);
  fputs("unset multiplot\n", file);
}

static bool has_stress(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "max_stress_Pa");
}

/* With the yield stress where it is not far above. */
static void script_stress(const ZpPlot *plot, FILE *file) {
  static const double near = 2;
  const char *const curve[][2] = {{"max_stress_Pa", "stress"}};
  double yields = plot->def.ribbon.yield_stress, margin = zp_result_get(plot->single, "yield_margin");
  ZpPlotUnit time = time_unit(plot);
  ZpPlotUnit stress = zp_plot_table_unit(series(plot), (const char *const[]){"max_stress_Pa", NULL}, "Pa");
  zp_plot_head(plot, file, "stress", "Largest stress of the metal over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  begin(file, time);
  mark_zip(plot, file, time);
  name_zip(plot, file, time);
  fputs("set yrange [0:*]\n", file);
  if (margin < near)
    fprintf(file,
            "set arrow 3 from graph 0, first %.17g to graph 1, first %.17g nohead dt 4 lw 1.5 lc rgb '#d55e00' front\n"
            "set label 6 'yield stress' at graph 1, first %.17g left offset 0.5,0 font ',12' tc rgb '#d55e00'\n"
            "set yrange [0:%.17g<*]\n",
            yields * stress.factor, yields * stress.factor, yields * stress.factor, 1.1 * yields * stress.factor);
  plot_columns(plot, file, time, stress, "stress", curve, 1);
}

static bool has_plastic(const ZpPlot *plot) {
  return plot->def.ribbon.plasticity && is_film(plot) && zp_plot_has(series(plot), "permanent_curvature_per_m");
}

static void script_plastic(const ZpPlot *plot, FILE *file) {
  const char *const openings[][2] = {{"opening_m", "opening"}, {"stroke_m", "stroke"}},
                    *const curvatures[][2] = {{"permanent_curvature_per_m", "permanent"}};
  bool two = zp_plot_has(series(plot), "opening_m");
  ZpPlotUnit length = zp_plot_table_unit(series(plot), (const char *const[]){"opening_m", "stroke_m", NULL}, "m");
  ZpPlotUnit curvature =
      zp_plot_table_unit(series(plot), (const char *const[]){"permanent_curvature_per_m", NULL}, "1/m");
  two_panels(plot, file, "plastic", "What plastic bending has left over time",
             &(Panel){"length", length, two ? openings : openings + 1, 1},
             &(Panel){"curvature", curvature, curvatures, 1});
}

const ZpPicture zp_series_pictures[] = {
    {"stroke", "svg", has_stroke, script_stroke, NULL},
    {"zipped_length", "svg", has_zipped_length, script_zipped_length, NULL},
    {"voltage", "svg", has_voltage, script_voltage, NULL},
    {"source", "svg", has_source, script_source, NULL},
    {"interface", "svg", has_interface, script_interface, NULL},
    {"sense", "svg", has_sense, script_sense, NULL},
    {"control", "svg", has_control, script_control, NULL},
    {"loops", "svg", has_loops, script_loops, NULL},
    {"energies", "svg", has_energies, script_energies, NULL},
    {"electric", "svg", has_electric, script_electric, NULL},
    {"stress", "svg", has_stress, script_stress, NULL},
    {"plastic", "svg", has_plastic, script_plastic, NULL},
    {0},
};
