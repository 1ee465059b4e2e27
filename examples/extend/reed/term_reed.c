/* The return spring of a reed acts on its right end, and is relaxed where that is as high as the clamp:
 *   F = -k (y_end - y_clamp),   energy 1/2 k (y_end - y_clamp)^2
 * In the library: src/term/reed.c. */
#include "term/term.h"

const ZpRow zp_row_reed_energy = ZP_STORED(reed_energy, "energy of the return spring of a reed");

static bool acts(const ZpModel *model) {
  return model->def.reed.stiffness > 0;
}

/* By how much the right end is above the clamp, m. */
static double raised(const ZpModel *model, const double *q) {
  return -zp_hangs_by(&model->topology, zp_nodes(model, q));
}

/* The mean over the span: its work is exactly the decrease of the energy. At rest start and end are the same. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F) {
  (void)eval;
  const double mean = 0.5 * (raised(model, span->start) + raised(model, span->end));
  zp_forces(model, F).y[zp_load_node(&model->topology)] -= model->def.reed.stiffness * mean;
}

/* Minus the derivative of the force by the coordinates at the end of the span; at rest the start moves with it. */
static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K) {
  (void)eval;
  const size_t end = zp_y_of(zp_load_node(&model->topology));
  const double share = zp_span_is_still(span) ? 1 : 0.5;
  zp_assemble_entry(assembly, end, end, share * model->def.reed.stiffness, K);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *eval, double *row) {
  (void)eval;
  const double y = raised(model, now->end);
  row[0] += 0.5 * model->def.reed.stiffness * y * y;
}

const ZpTerm zp_term_reed = {
    .name = "reed", .row = {&zp_row_reed_energy}, .acts = acts, .force = force, .stiffness = stiffness, .now = energy};
