#include "study/notes.h"

#include <math.h>

#include "actuator/model.h"
#include "actuator/resolution.h"
#include "def/check.h"
#include "study/studies.h"

/* -- margins --------------------------------------------------------------------------------------- */

static void note_breakdown(ZpResult *result, const ZpModel *model, const ZpMargins *seen) {
  const ZpActuatorDef *def = &model->def;
  if (seen->insulator > seen->withstands)
    zp_result_note(result, "the insulator's field reaches %.3g MV/m, above its breakdown field of %.3g MV/m",
                   seen->insulator / 1e6, seen->withstands / 1e6);
  if (!def->electro.breakdown_cap && seen->liquid > def->medium.breakdown_field)
    zp_result_note(result,
                   "the liquid's field reaches %.3g MV/m, above its breakdown field of %.3g MV/m, and "
                   "electro.breakdown_cap is false: the force is not limited",
                   seen->liquid / 1e6, def->medium.breakdown_field / 1e6);
}

/* The voltage of the first member at which the first insulator of any breaks down, V; NAN: there is none. */
static double allowed_voltage(const ZpModel *first) {
  double least = NAN;
  for (const ZpModel *model = first; model < first + first->members; model++) {
    const double allowed = zp_series_allowed(&model->series);
    if (model->field && allowed > 0 && model->ratio > 0) least = fmin(least, allowed / model->ratio);
  }
  return least;
}

static void add_fields(ZpResult *result, const ZpModel *model, const ZpMargins *seen) {
  zp_result_add(result, "insulator_field_V_per_m", "V/m", seen->insulator);
  zp_result_add(result, "insulator_field_place_m", "m", seen->insulator_place);
  zp_result_add(result, "breakdown_margin", "1", seen->insulator > 0 ? seen->withstands / seen->insulator : NAN);
  zp_result_add(result, "allowed_voltage_V", "V", allowed_voltage(model));
  note_breakdown(result, model, seen);
}

/* A strip that yields without hardening bears its yield stress, to rounding. */
static bool has_yielded(const ZpModel *model, const ZpMargins *seen) {
  static const double rounding = 1e-12;
  return model->rod.plastic && seen->stress >= (1 - rounding) * seen->yields;
}

void zp_add_stress(ZpResult *result, const ZpModel *model, const ZpMargins *seen) {
  zp_result_add(result, "max_stress_Pa", "Pa", seen->stress);
  zp_result_add(result, "max_stress_place_m", "m", seen->stress_place);
  zp_result_add(result, "yield_margin", "1", seen->stress > 0 ? seen->yields / seen->stress : NAN);
  if (has_yielded(model, seen))
    zp_result_note(result, "the metal reaches its yield stress of %.4g MPa: it stays bent", seen->yields / 1e6);
  else if (seen->stress > seen->yields)
    zp_result_note(result,
                   "the ribbon's stress reaches %.4g MPa, above its yield stress of %.4g MPa: it would stay bent; set "
                   "ribbon.plasticity true to compute this",
                   seen->stress / 1e6, seen->yields / 1e6);
}

void zp_add_margins(ZpResult *result, const ZpModel *model, const ZpMargins *seen) {
  add_fields(result, model, seen);
  zp_add_stress(result, model, seen);
}

/* -- the mesh -------------------------------------------------------------------------------------- */

void zp_note_mesh(ZpResult *result, const ZpModel *model, double voltage) {
  static const double fewest = 6; /* elements: docs/theory.md, section 9, has what this and the other bound leave */
  double front = zp_front_length(model, voltage), elements = model->L / model->l;
  result->resolution = zp_mesh_resolution(model, voltage);
  if (zp_half_elements(&model->topology) == 0) return;
  if (elements < fewest)
    zp_result_note(result, "mesh.nodes = %d: with fewer than %g elements the error of a shape at rest may reach 8 %%",
                   model->def.mesh.nodes, fewest);
  if (model->l > front)
    zp_result_note(
        result,
        "mesh.nodes = %d: elements of %.3g mm are longer than the zip front, %.3g mm, so that closing voltage, "
        "largest load, zip time and force may be off by more than half; with mesh.nodes = %.0f the error of pull-in is "
        "usually less "
        "than 1 %%",
        model->def.mesh.nodes, 1e3 * model->l, 1e3 * front, 1 + ceil(2 * model->L / front));
}

void zp_result_note_model(ZpResult *result, const ZpModel *model, double highest) {
  ZpMargins seen = zp_margins_at_clip(model, highest);
  note_breakdown(result, model, &seen);
  zp_note_mesh(result, model, highest);
}

/* -- the liquid ------------------------------------------------------------------------------------ */

void zp_note_liquid(ZpResult *result, const ZpModel *model) {
  ZpError why;
  if (model->def.liquid.model != ZP_LIQUID_AUTO || model->has_film || !(model->def.medium.density > 0)) return;
  if (!zp_is_pair(&model->topology)) return;
  const bool possible = zp_check_bead(&model->def, &why) == ZP_OK;
  zp_result_note(result, "liquid.model auto means none here, liquid everywhere without drag: %s",
                 possible ? "electro.edges or a resistivity is given; liquid.model bead is possible beside it"
                          : why.message);
}

/* -- what rest leaves out -------------------------------------------------------------------------- */

void zp_note_rest(ZpResult *result, const ZpModel *model, bool at_voltages) {
  zp_note_liquid(result, model);
  if (model->supply.acts)
    zp_result_note(result, "source.model = amplifier is ignored: at rest the electrodes have drive.voltage; use study "
                           "actuate to include the supply");
  if (model->leaks)
    zp_result_note(result, "resistivities are ignored: these are states just after the voltage is switched on, before "
                           "charge accumulates between insulators and liquid; use study actuate to include it");
  if (at_voltages && model->control.kind != ZP_CONTROL_NONE)
    zp_result_note(result, "control.kind is ignored: these are states at given voltages; use study actuate to run the "
                           "controller, and modes to find out whether it holds a state");
}

/* -- the start ------------------------------------------------------------------------------------- */

void zp_note_start(ZpResult *result, const ZpModel *model, double opening) {
  double insulators = zp_insulation(&model->def);
  if (opening < insulators)
    zp_result_note(
        result,
        "the opening at the start, %.3g um, is less than the thickness of both insulators, %.3g um: the actuator "
        "is nearly closed, so zip_time_s says little about zipping",
        1e6 * opening, 1e6 * insulators);
}
