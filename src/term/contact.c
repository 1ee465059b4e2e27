/* Faces that overlap repel each other. Eqs. (9.1) and (18.11). */
#include "term/term.h"

const ZpRow zp_row_contact_loss = ZP_LOST(contact_loss, "energy lost so far in contact");

static bool acts(const ZpModel *model) {
  return model->field;
}

/* Up on the upper ribbon, down on the lower or only one. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (span->faces_pass) return;
  const double *start = zp_span_is_still(span) ? e->plates.gap : e->plates_start.gap;
  ZpContactSpan faces = zp_contact_span(&model->faces, start, e->plates.gap, span->h);
  zp_contact_eval(&model->faces, &faces, &e->faces);
  for (size_t i = 0; i < model->nodes; i++)
    zp_term_part(model, i, e->faces.push[i], F);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  (void)assembly, (void)K;
  double both = zp_span_is_still(span) ? 2 : 1; /* at rest both ends of the span move */
  for (size_t i = 0; !span->faces_pass && i < model->nodes; i++) {
    e->gaps.own[i] += both * e->faces.own[i];
    e->gaps.next[i] += both * e->faces.next[i];
  }
}

/* By the gap at which a plate is stopped. */
static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  if (key != ZP_KEY(plate.stop_gap)) return false;
  for (size_t i = 0; !span->faces_pass && i < model->nodes; i++)
    zp_term_part(model, i, 2 * e->faces.own[i], F);
  return true;
}

/* The code that makes the steps books the losses of impacts. */
const ZpTerm zp_term_contact = {.name = "contact",
                                .row = {&zp_row_contact_loss},
                                .acts = acts,
                                .force = force,
                                .stiffness = stiffness,
                                .by_key = by_key};
