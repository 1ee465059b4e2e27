/* Letters of docs/theory.md, section 15:
 *   E_t   field in the tape at the metal, V/m       g   gap of the faces, m
 *   d     liquid thickness that stands for both tapes, m
 * Everything at 1 V, over the flexible part of one ribbon. */
#include "study/bookkeeping.h"

#include <math.h>

#include "electro/plates.h"

/* Permittivities in the authors' programs, of liquid and tape: in the finite-element model, in the plates law, and of
 * the tape in the expression for the finite-element force. */
static const double fe_liquid = 2.7, fe_tape = 4.6, law_liquid = 2.75, law_tape = 4.62, expression_tape = 4.65;

/* Share of the voltage in their law. */
static const double share = 0.5;

/* E_t^2 at xi of element column c, mean of both ribbons. */
static double tape_field(const ZpField *f, size_t c, double xi) {
  const ZpFieldMesh *m = &f->params.mesh;
  size_t lower = m->outside + m->strip, upper = f->grid.rows - lower - 1;
  double E[2], sum = 0;
  zp_grid_gradient(&f->grid, c, lower, xi, -1, E);
  sum += E[0] * E[0] + E[1] * E[1];
  zp_grid_gradient(&f->grid, c, upper, xi, 1, E);
  sum += E[0] * E[0] + E[1] * E[1];
  return 0.5 * sum;
}

/* Their finite-element force: eps0 eps w E_t^2 without 1/2, by Simpson's rule. */
static double reading(const ZpField *f) {
  double sum = 0;
  for (size_t i = f->first; i + 2 <= f->last; i += 2) {
    const ZpFieldProfile *p = f->profile + (i - f->first);
    sum += (p[2].x - p[0].x) / 6 * (tape_field(f, i / 2, -1) + 4 * tape_field(f, i / 2, 0) + tape_field(f, i / 2, 1));
  }
  return ZP_EPS0 * expression_tape * f->params.w * sum;
}

static double law_at(const ZpField *f, double d, double g) {
  return 0.5 * ZP_EPS0 * law_liquid * f->params.w / ((g + d) * (g + d));
}

/* Force by their plates law with this d, without their share. */
static double law(const ZpField *f, double d) {
  double sum = 0;
  for (size_t i = f->first; i + 2 <= f->last; i += 2) {
    const ZpFieldProfile *p = f->profile + (i - f->first);
    sum += (p[2].x - p[0].x) / 6 * (law_at(f, d, p[0].gap) + 4 * law_at(f, d, p[1].gap) + law_at(f, d, p[2].gap));
  }
  return sum;
}

bool zp_paper_factor(const ZpFieldParams *params, const ZpContact *faces, ZpPaperFactor *factor) {
  ZpField field;
  ZpFieldParams theirs = *params;
  theirs.eps_m = theirs.eps_out = fe_liquid;
  theirs.eps_i = fe_tape;
  *factor = (ZpPaperFactor){NAN, NAN, NAN, NAN};
  if (!zp_field_create(&theirs, &field)) return false;
  if (zp_field_solve(&field, faces) == ZP_FIELD_SOLVED) {
    double t = params->t, right = 2 * t * fe_liquid / fe_tape, slipped = 2 * t - t * law_liquid / law_tape;
    zp_field_profile(&field);
    *factor = (ZpPaperFactor){.voltage = 1 / (share * share),
                              .half = 2,
                              .tape = 0.5 * reading(&field) / law(&field, right),
                              .gap = law(&field, right) / law(&field, slipped)};
  }
  zp_field_destroy(&field);
  return true;
}

double zp_paper_factor_product(const ZpPaperFactor *factor) {
  return factor->voltage * factor->half * factor->tape * factor->gap;
}
