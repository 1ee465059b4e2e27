/* Margins of a result, and its notes: sentences on what a study went through that its materials, its model or its mesh
 * does not hold for. The one place that makes those which several studies share; what a study alone knows it adds by
 * zp_result_note. */
#ifndef ZP_STUDY_NOTES_H
#define ZP_STUDY_NOTES_H

#include "study/result.h"

#include "actuator/shape.h"

/* Add the stress of the metal, with a note where it yields. */
void zp_add_stress(ZpResult *result, const ZpModel *model, const ZpMargins *seen);

/* Add stresses and the fields in the insulators, with a note where these or, without cap, the liquid break down. */
void zp_add_margins(ZpResult *result, const ZpModel *model, const ZpMargins *seen);

/* The mesh for `voltage`, the highest (V), 0 for none => result->resolution, with a note where it is too coarse. */
void zp_note_mesh(ZpResult *result, const ZpModel *model, double voltage);

/* Note where liquid.model auto stands for none although there are two ribbons, and why. */
void zp_note_liquid(ZpResult *result, const ZpModel *model);

/* Note what studies of rest leave out: a bead that is not modelled, the supply's own limits, and charge that gathers;
 * and, if states are at given voltages (`at_voltages`), a controller. */
void zp_note_rest(ZpResult *result, const ZpModel *model, bool at_voltages);

/* Note a start that is nearly closed: opening of the platforms (m; NAN: there are none). */
void zp_note_start(ZpResult *result, const ZpModel *model, double opening);

#endif
