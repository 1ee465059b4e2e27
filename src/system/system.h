/* The one sum: all laws of an actuator over a span of time, at an instant, or at rest. Solvers ask nothing else. */
#ifndef ZP_SYSTEM_SYSTEM_H
#define ZP_SYSTEM_SYSTEM_H

#include "term/term.h"

/* Allocate the arrays of `eval` (and what finding held forces takes, if it is to) and find the terms that the model
 * has; false if there is no memory. */
bool zp_system_create(const ZpModel *model, bool solves, ZpEval *eval);
void zp_system_destroy(ZpEval *eval);

/* Still, without voltage and load, with all weight, at coordinates q: for callers to change. */
ZpSpan zp_span_at(const double *q);

/* A span that is not still begins: what the terms need of its start => eval. */
void zp_system_begin(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* (span) => F [2 stride], N: the sum of all terms. */
void zp_system_force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F);

/* At the last force: K = -dF/d(end's coordinates). At rest it is exact; over a span it is near that and symmetric. */
void zp_system_stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K);

/* The instant of a state, at coordinates q and velocities v (its own, or those on trial): its voltage, load, held
 * forces and front. */
ZpSpan zp_span_of(const ZpModel *model, const ZpState *state, const double *q, const double *v);

/* (span of an instant, masses) => accelerations a [2 stride] of nodes that no other is joined to; drag_power and
 * drag_rate of eval. */
void zp_system_accelerations(const ZpModel *model, const ZpSpan *span, const ZpMasses *masses, ZpEval *eval, double *a);

/* Energies of a state without the field. */
ZpEnergies zp_system_energies(const ZpModel *model, const ZpState *state, ZpEval *eval);

/* What the terms have lost over a span, at its last force. */
ZpLosses zp_system_losses(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* (span, accelerations a [2 stride]) => F [2 stride], N: the inertia of all terms beyond the masses of nodes. */
void zp_system_inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, const double *a, double *F);

/* Electric totals at the start or the end of a span, where gaps were found last, at voltage U. */
ZpElectric zp_system_electric(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, ZpSpanEnd at, double U);

/* The same where a state is. */
ZpElectric zp_system_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *eval);

/* At the last force: how it and the charge go with the voltage at the span's end => sum, whose arrays are the caller's.
 */
void zp_system_by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpByVoltage *sum);

/* Find the forces that are held at coordinates q and voltage U; false if they cannot be: eval->fault says why. */
bool zp_system_solve(const ZpModel *model, const double *q, double U, ZpEval *eval);

#endif
