/* Faces that overlap push each other apart, as they lie at the end of the span. Eq. (9.1). */
#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->field;
}

/* Up on the upper ribbon, down on the lower or only one. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (span->faces_pass) return;
  size_t s = model->s;
  double *Fy = F + model->stride;
  zp_faces_eval(&model->faces, e->plates.gap, &e->faces);
  for (size_t i = 0; i < model->nodes; i++) {
    size_t lower = s * i + s - 1;
    Fy[lower] -= e->faces.push[i];
    if (s == 2) Fy[lower - 1] += e->faces.push[i];
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  (void)assembly, (void)K;
  for (size_t i = 0; !span->faces_pass && i < model->nodes; i++) {
    e->gaps.own[i] += e->faces.own[i];
    e->gaps.next[i] += e->faces.next[i];
  }
}

const ZpTerm zp_term_faces = {.name = "faces", .acts = acts, .force = force, .stiffness = stiffness};
