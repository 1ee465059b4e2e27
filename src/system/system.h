/* The only sum of all laws of an actuator: over a span of time, at an instant, or at rest. Solvers use nothing else. */
#ifndef ZP_SYSTEM_SYSTEM_H
#define ZP_SYSTEM_SYSTEM_H

#include "term/term.h"

/* Add a law of a program's own to a model, before states and evals of it are created. False if there is no room. */
bool zp_model_add_term(ZpModel *model, const ZpTerm *term);

/* Add to a model and its members those laws of another that a program has added. */
void zp_model_take_laws(ZpModel *model, const ZpModel *from);

/* A model of the same actuator with so many nodes, which mesh.nodes allows, without a table of voltages. ZP_MACHINE: no
 * memory. */
ZpStatus zp_model_create_on_mesh(const ZpModel *model, int nodes, ZpModel **out, ZpError *err);

/* Allocate the arrays of `eval`, with `solves` also those for held forces; false if there is no memory. */
bool zp_system_create(const ZpModel *model, bool solves, ZpEval *eval);
void zp_system_destroy(ZpEval *eval);

/* A still span at coordinates q, without voltage and load, with all weight. Callers may change it. */
ZpSpan zp_span_at(const double *q);

/* Compute in eval what the terms need of the start of a span that is not still. */
void zp_system_begin(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* F = sum of the forces of all terms over the span, N. */
void zp_system_force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F);

/* Some laws. */
typedef struct ZpTerms {
  const ZpTerm *term[ZP_MOST_TERMS];
  size_t count;
} ZpTerms;

/* Forces of all terms without some laws, which are evaluated nevertheless, because others may need what they find. */
void zp_system_force_without(const ZpModel *model, const ZpSpan *span, const ZpTerms *without, ZpEval *eval, double *F);

/* Stiffness of edges that internal damping would add over a step of 1 s, at coordinates q => eval->D, N s/m; `spare` is
 * as long. */
void zp_system_internal_damping(const ZpModel *model, const double *q, ZpEval *eval, double (*spare)[4]);

/* K += -dF/d(coordinates at the end), at the last force. It is exact at rest; over a span it is close to that, and
 * symmetric. */
void zp_system_add_stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval,
                             ZpBand *K);

/* Stiffness of all terms but those of edges (ZpTerm.of_edges). */
void zp_system_add_stiffness_beside_edges(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly,
                                          ZpEval *eval, ZpBand *K);

/* The instant of a state, with its voltage, load, held forces and front, at coordinates q and velocities v (its own, or
 * trial values). */
ZpSpan zp_span_of(const ZpModel *model, const ZpState *state, const double *q, const double *v);

/* Compute for an instant the accelerations a of nodes that are not joined to others, and drag_power and
 * drag_rate of eval. */
void zp_system_accelerations(const ZpModel *model, const ZpSpan *span, const ZpMasses *masses, ZpEval *eval, double *a);

/* ledger [rows] = energies of a state in their rows, J, 0 in that of the field, and signals; losses stay. */
void zp_system_now(const ZpModel *model, const ZpState *state, ZpEval *eval, double *ledger);

/* Sum of all energies in a ledger, J. */
double zp_system_stored(const ZpModel *model, const double *ledger);

/* Energy that one part has taken since its ledger was opened, J: the rise of all energies, and all losses, without what
 * its rows say that others gave. It is the work of source and load if the energy balances. */
double zp_system_taken(const ZpModel *model, const double *start, const double *now);

/* Add what the terms have lost over a span, at its last force, to the ledger of the state. Edges are damped in implicit
 * steps only. */
void zp_system_book(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpState *state);

/* F = inertia of all terms beyond the masses of nodes, at accelerations a, N. */
void zp_system_inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, const double *a, double *F);

/* Electric totals at the start or the end of a span, with the gaps found last, at voltage U. */
ZpElectric zp_system_electric(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, ZpSpanEnd at, double U);

/* Electric quantities of a state. */
ZpElectric zp_system_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *eval);

/* Derivatives of the last force and of the charge by the voltage at the end of the span => sum, whose arrays belong to
 * the caller. */
void zp_system_by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpByVoltage *sum);

/* Compute the held forces at coordinates q and voltage U; if this fails, return false, and eval->fault gives the
 * reason.
 */
bool zp_system_solve(const ZpModel *model, const double *q, double U, ZpEval *eval);

#endif
