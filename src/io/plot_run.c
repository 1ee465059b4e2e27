/* Pictures that read ../table.csv of one run, and need no more: over time, along the ribbon, and of members. */
#include <math.h>

#include "io/plot.h"

/* Only of a voltage that changes. */
static bool has_voltage(const ZpPlot *plot) {
  const ZpPlotRange range = zp_plot_range(plot->table, "voltage_V");
  return range.high > range.low;
}

static bool has_zipped_length(const ZpPlot *plot) {
  return zp_plot_range(plot->table, "zipped_length_m").high > 0;
}

static bool has_cycle(const ZpPlot *plot) {
  return isfinite(zp_result_get(plot->single, "energy_per_cycle_J"));
}

static bool has_power(const ZpPlot *plot) {
  return plot->def.drive.voltage > 0;
}

const ZpPicture zp_run_pictures[] = {
    {"stroke", "svg", "stroke.gp", ZP_OF(motion), .needs = "stroke_m"},
    {"zipped_length", "svg", "zipped_length.gp", ZP_OF(motion), .needs = "zipped_length_m opening_m",
     .has = has_zipped_length},
    {"voltage", "svg", "voltage.gp", ZP_OF(motion), .needs = "opening_m", .has = has_voltage},
    {"source", "svg", "source.gp", ZP_OF(motion), .needs = "current_A", .keys = "source.model"},
    {"interface", "svg", "interface.gp", ZP_OF(motion), .needs = "interface_voltage_V",
     .keys = "insulator.resistivity medium.resistivity"},
    {"sense", "svg", "sense.gp", ZP_OF(motion), .needs = "sensed_stroke_m", .keys = "sense.frequency"},
    {"control", "svg", "control.gp", ZP_OF(motion), .needs = "command_V", .keys = "control.kind"},
    {"loops", "svg", "loops.gp", ZP_OF(motion), .needs = "charge_C", .has = has_cycle},
    {"energies", "svg", "energies.gp", ZP_OF(motion), .needs = "kinetic_energy_J"},
    {"electric", "svg", "electric.gp", ZP_OF(motion), .needs = "charge_C force_N opening_m"},
    {"stress", "svg", "stress.gp", ZP_OF(motion), .needs = "max_stress_Pa"},
    {"plastic", "svg", "plastic.gp", ZP_OF(motion), .needs = "permanent_curvature_per_m", .keys = "ribbon.plasticity"},
    {"members", "svg", "members.gp", ZP_OF(motion), .needs = "member_1_opening_m", .keys = "stack.series"},
    {"members", "svg", "members_forces.gp", ZP_OF(motion), .needs = "member_1_force_N", .keys = "stack.parallel"},
    {"profile", "svg", "profile.gp", ZP_OF(field), .needs = "ratio", .has = has_power},
    {0},
};
