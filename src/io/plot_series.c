/* Pictures of one run over time: stroke.svg, zipped_length.svg, voltage.svg, source.svg, control.svg, loops.svg,
 * energies.svg, electric.svg, stress.svg, plastic.svg; of actuators in series members.svg, their openings over time,
 * the order in which they zip, or the voltages that are their limits. All read ../table.csv. */
#include <math.h>

#include "io/plot.h"

static bool is_film(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_motion && plot->single;
}

static bool is_ribbon(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON;
}

static const ZpTable *series(const ZpPlot *plot) {
  return plot->single->series;
}

/* What the templates of these pictures ask for. */
static void define_run(const ZpPlot *plot, FILE *file) {
  static const char *const key[] = {"actuator.kind", "source.model",        "control.signal", "control.noise",
                                    "drive.voltage", "ribbon.yield_stress", "stack.series",   "stack.parallel"};
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  for (size_t i = 0; i < sizeof key / sizeof key[0]; i++)
    zp_plot_define_key(plot, file, key[i]);
  zp_plot_define_scalar(plot, file, "zip_time_s");
  zp_plot_define_scalar(plot, file, "yield_margin");
  zp_plot_define_table(file, series(plot));
}

static bool has_stroke(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "stroke_m");
}

static bool has_zipped_length(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && zp_plot_has(series(plot), "zipped_length_m");
}

/* Only of a voltage that changes. */
static bool has_voltage(const ZpPlot *plot) {
  if (!is_film(plot) || is_ribbon(plot) || !zp_plot_has(series(plot), "opening_m")) return false;
  for (size_t i = 1; i < series(plot)->rows; i++)
    if (zp_table_get(series(plot), i, "voltage_V") != zp_table_get(series(plot), 0, "voltage_V")) return true;
  return false;
}

/* Of a source that is not ideal. */
static bool has_source(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && plot->def.source.model != ZP_SOURCE_IDEAL &&
         zp_plot_has(series(plot), "current_A");
}

/* Of what leaks. */
static bool has_interface(const ZpPlot *plot) {
  bool leaks = isfinite(plot->def.insulator.resistivity) || isfinite(plot->def.medium.resistivity);
  return leaks && is_film(plot) && zp_plot_has(series(plot), "interface_voltage_V");
}

/* Of a meter of the capacitance. */
static bool has_sense(const ZpPlot *plot) {
  return is_film(plot) && isfinite(plot->def.sense.frequency) && zp_plot_has(series(plot), "sensed_stroke_m");
}

/* Of a controller. */
static bool has_control(const ZpPlot *plot) {
  return is_film(plot) && plot->def.control.kind != ZP_CONTROL_NONE && zp_plot_has(series(plot), "command_V");
}

/* Of a cycle. */
static bool has_loops(const ZpPlot *plot) {
  return is_film(plot) && isfinite(zp_result_get(plot->single, "energy_per_cycle_J")) &&
         zp_plot_has(series(plot), "charge_C");
}

static bool has_energies(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "kinetic_energy_J");
}

static bool has_electric(const ZpPlot *plot) {
  return is_film(plot) && !is_ribbon(plot) && zp_plot_has(series(plot), "charge_C") &&
         zp_plot_has(series(plot), "force_N");
}

static bool has_stress(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "max_stress_Pa");
}

static bool has_plastic(const ZpPlot *plot) {
  return plot->def.ribbon.plasticity && is_film(plot) && zp_plot_has(series(plot), "permanent_curvature_per_m");
}

static bool has_members(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "member_1_opening_m");
}

static bool has_forces(const ZpPlot *plot) {
  return is_film(plot) && zp_plot_has(series(plot), "member_1_force_N");
}

static bool has_limits(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_limits && plot->single && plot->def.stack.series > 1 &&
         zp_plot_has(series(plot), "release_voltage_V");
}

const ZpPicture zp_series_pictures[] = {
    {"stroke", "svg", has_stroke, define_run, NULL, "stroke.gp"},
    {"zipped_length", "svg", has_zipped_length, define_run, NULL, "zipped_length.gp"},
    {"voltage", "svg", has_voltage, define_run, NULL, "voltage.gp"},
    {"source", "svg", has_source, define_run, NULL, "source.gp"},
    {"interface", "svg", has_interface, define_run, NULL, "interface.gp"},
    {"sense", "svg", has_sense, define_run, NULL, "sense.gp"},
    {"control", "svg", has_control, define_run, NULL, "control.gp"},
    {"loops", "svg", has_loops, define_run, NULL, "loops.gp"},
    {"energies", "svg", has_energies, define_run, NULL, "energies.gp"},
    {"electric", "svg", has_electric, define_run, NULL, "electric.gp"},
    {"stress", "svg", has_stress, define_run, NULL, "stress.gp"},
    {"plastic", "svg", has_plastic, define_run, NULL, "plastic.gp"},
    {"members", "svg", has_members, define_run, NULL, "members.gp"},
    {"members", "svg", has_forces, define_run, NULL, "members_forces.gp"},
    {"members", "svg", has_limits, define_run, NULL, "members_limits.gp"},
    {0},
};
