/* Natural curvatures of a rod, with those that voltage drives. */
#ifndef ZP_TERM_CURVATURE_H
#define ZP_TERM_CURVATURE_H

#include "term/term.h"

/* Over a span, their mean, with the share that acts; [stride], valid until the next call. */
const double *zp_term_natural(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* Those of the state at an instant, as its ledger counts them; at rest those at the present voltage. */
const double *zp_term_natural_of_state(const ZpModel *model, const ZpSpan *now, ZpEval *eval);

/* F += derivative of the last force of a still span by the curvature of a driven segment, N m. */
void zp_term_curvature_by_place(const ZpModel *model, const ZpSpan *span, size_t place, ZpEval *eval, double *F);

#endif
