/* A model: built once from a Def and never changed, so threads may share it. */
#ifndef ZIPACT_MODEL_H
#define ZIPACT_MODEL_H

#include <zipact/api.h>
#include <zipact/def.h>
#include <zipact/drive.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpModel ZpModel;

/* Check `def` and build a model of it. On success *model is new and belongs to the caller; otherwise it is NULL and
 * `err` gives the reason (ZP_BAD_INPUT, or ZP_MACHINE if there is no memory). */
ZP_API ZpStatus zp_model_create(const ZpActuatorDef *def, ZpModel **model, ZpError *err);

/* A model that is driven by the rows of `table`, which are copied. They belong to drive.waveform, or with a controller
 * to setpoint.waveform, which must be table. NULL: as zp_model_create. ZP_BAD_INPUT with the fault of
 * zp_drive_table_fault. */
ZP_API ZpStatus zp_model_create_driven(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel **model,
                                       ZpError *err);

/* Free a model; NULL is allowed. Destroy everything that uses it first. */
ZP_API void zp_model_destroy(ZpModel *model);

/* The definition that the model was built from. */
ZP_API const ZpActuatorDef *zp_model_def(const ZpModel *model);

/* A constant of `model`, for a series that of its uppermost member, SI; NAN if there is none of that name:
 *   ribbons            1 or 2
 *   nodes              per ribbon
 *   flexible_length    L, of one modelled ribbon, m
 *   element_length     l = L / (N-1), m
 *   bending_stiffness  E I of a ribbon, N m^2
 *   axial_stiffness    E A of a ribbon, N
 *   line_mass          of a ribbon with its insulator, kg/m
 *   axial_spring       K_D, N/m
 *   shear_coefficient  K_S, N/m
 *   insulator_offset   d, m
 *   internal_damping   Kelvin-Voigt time, s
 *   closed_line_force  attraction per length of closed faces at the highest voltage, N/m
 *   stable_time_step   largest explicit step that is certainly stable, s */
ZP_API double zp_model_get(const ZpModel *model, const char *name);

#ifdef __cplusplus
}
#endif

#endif
