/* Weight, of all that hangs, and the load input. */
#include "base/kernel.h"
#include "term/term.h"

ZP_KERNEL static void subtract(size_t stride, double share, const double *weight, double *restrict Fy) {
  ZP_SIMD
  for (size_t j = 0; j < stride; j++)
    Fy[j] -= share * weight[j];
}

static void add_load(const ZpModel *model, double load, double *F) {
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    F[model->stride + zp_lower(t, i)] -= load / (double)zp_load_ends(t);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  subtract(model->stride, span->share, model->weight, F + model->stride);
  add_load(model, span->load, F);
}

void zp_weight_by_load(const ZpModel *model, double *F) {
  add_load(model, 1, F);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, ZpEnergies *sum) {
  (void)e;
  for (size_t j = 0; j < model->count; j++)
    sum->gravity += model->weight[j] * now->end[model->stride + j];
}

const ZpTerm zp_term_weight = {.name = "weight", .force = force, .energy = energy};
