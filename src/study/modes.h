/* What study `modes` says of vibrations, whatever vibrates. */
#ifndef ZP_STUDY_MODES_H
#define ZP_STUDY_MODES_H

#include <zipact/study.h>

#include "rest/rest.h"
#include "rest/vibration.h"

enum { ZP_MODES = 8, ZP_MODES_SUBSPACE = 16 };

/* What is looked at: frequencies are those without the mass of a liquid: of a bead, which lies near the clip, where
 * little moves. And a note on what that leaves out. */
ZpActuatorDef zp_modes_def(const ZpActuatorDef *def);
void zp_modes_note_bead(ZpResult *result, const ZpActuatorDef *def);

/* Name of the number that is the frequency of mode j. */
const char *zp_modes_name(size_t j);

/* How many are told of. */
size_t zp_modes_count(const ZpVibration *vibration);

/* NULL if there is no memory. */
ZpTable *zp_modes_table(void);

/* Find them; outcome and message of the result say what came of it. */
bool zp_modes_solve(ZpVibration *vibration, ZpResult *result);

/* Frequency and row of mode j, which was found. */
void zp_modes_add(ZpVibration *vibration, size_t j, ZpResult *result);

/* There is no hanging equilibrium at `voltage`, V: `trouble` says why, NULL that it pulls in below. */
void zp_modes_pulled_in(const ZpVibration *vibration, double voltage, const char *trouble, ZpResult *result);

/* From an equilibrium, saved, by `amplitude` times a mode u [n], gaps included. */
void zp_modes_move(ZpRest *rest, const double *equilibrium, const double *u, double amplitude);

/* What moves the equation that moves most in mode j by a tenth of `length`, m. */
double zp_modes_amplitude(const ZpVibration *vibration, size_t j, double length);

#endif
