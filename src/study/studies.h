/* The studies: each fills a result from a Def that has been checked. */
#ifndef ZP_STUDY_STUDIES_H
#define ZP_STUDY_STUDIES_H

#include <zipact/study.h>

#include "base/memory.h"

/* Motion under a voltage: constant from t = 0 on until closed, any other until end_time. */
ZpStatus zp_study_actuate(const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks, ZpResult *result,
                          ZpError *err);

/* The loaded shape at rest, no voltage. */
ZpStatus zp_study_stationary(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err);

/* All states of rest up to drive.voltage. */
ZpStatus zp_study_equilibrium(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err);

/* The platform held at isometric.separation, the voltage raised to drive.voltage. */
ZpStatus zp_study_isometric(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err);

/* Frequencies and mode shapes about the loaded equilibrium. */
ZpStatus zp_study_modes(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err);

/* Electric force along the ribbons of one shape, by plates and by the field. */
ZpStatus zp_study_profile(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult *result, ZpError *err);

/* Append a number to the summary; one that follows from wall time; a sentence of note. */
void zp_result_add(ZpResult *result, const char *name, const char *unit, double value);
void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value);
__attribute__((format(printf, 2, 3))) void zp_result_note(ZpResult *result, const char *format, ...);

#endif
