/* What a solved field has beyond the plates law, held since it was solved last. Eq. (14.9). */
#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->field_solved;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  double U2 = 0.5 * (span->U0 * span->U0 + span->U1 * span->U1);
  for (size_t k = 0; span->beyond && k < 2 * model->stride; k++)
    F[k] += U2 * span->beyond[k];
}

const ZpTerm zp_term_field = {"field", acts, NULL, force, NULL};
