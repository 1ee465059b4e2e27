/* The difference of a solved field from the plates law, held since the last solution. Eqs. (14.7) and (14.8). */
#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->field_solved;
}

static bool create(const ZpModel *model, ZpEval *e) {
  return !e->solves ||
         zp_field_correction_create(&model->cross_section, &model->plates, model->field_scale, &e->correction);
}

static void destroy(ZpEval *e) {
  zp_field_correction_destroy(&e->correction);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  double U2 = 0.5 * (span->U0 * span->U0 + span->U1 * span->U1);
  for (size_t k = 0; span->beyond.F && k < zp_coordinates(model); k++)
    F[k] += U2 * span->beyond.F[k];
}

/* Since the last solution its co-energy has changed by the work of the held force. */
static void electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U,
                     ZpElectric *sum) {
  (void)e;
  const ZpCachedField *held = &span->beyond;
  if (!held->F) return;
  const double *q = at == ZP_SPAN_START ? span->start : span->end, *Fy = zp_nodes(model, held->F).y;
  double work = 0;
  for (size_t k = 0; k < zp_coordinates(model); k++)
    work += held->F[k] * (q[k] - held->at[k]);
  for (size_t i = 0; i < model->nodes; i++)
    sum->force += 0.5 * U * U * (Fy[zp_lower(&model->topology, i)] - Fy[zp_upper(&model->topology, i)]);
  sum->charge += U * (held->charge + 2 * work);
  sum->potential -= U * U * (held->energy + work);
  sum->capacitance += held->capacitance + 2 * work / model->field_scale;
}

static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  (void)e;
  const ZpCachedField *held = &span->beyond;
  bool still = zp_span_is_still(span);
  if (!held->F) return;
  sum->capacitance += held->charge;
  for (size_t k = 0; k < zp_coordinates(model); k++) {
    sum->force[k] += (still ? 2 : 1) * span->U1 * held->F[k];
    if (still) continue;
    sum->charge[k] += 2 * span->U1 * held->F[k];
    sum->capacitance += 2 * held->F[k] * (span->end[k] - held->at[k]);
  }
}

static bool solve(const ZpModel *model, const double *q, double U, ZpEval *e) {
  (void)model;
  ZpFieldEnd end = zp_field_correction_solve(&e->correction, q, U, model->has_bead ? &e->cover : NULL);
  e->fault = end == ZP_FIELD_SOLVED ? NULL : zp_field_words(end);
  return !e->fault;
}

static const ZpRule rule[] = {
    ZP_RULE(NOT_MODELLED, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_HAS(PLATFORM),
            "its grid lies between two ribbons with a platform; use plates, which is accurate within 1 % if the gap "
            "changes slowly along the ribbon"),
    ZP_RULE(EQUATION, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's surface carries the plates law"),
    ZP_RULE(EQUATION, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_AT_LEAST(insulator.thickness, 1e-6),
            "its grid keeps closed faces a nanometre apart, which changes the force by less than 0.2 % then"),
    ZP_RULES_EQUAL_RIBBONS(NOT_MODELLED, ZP_IS(electro.model, ZP_ELECTRO_FIELD),
                           "its grid covers one half of the gap, whose middle plane is a mirror"),
};

const ZpTerm zp_term_field = {.name = "field",
                              .acts = acts,
                              .create = create,
                              .destroy = destroy,
                              .force = force,
                              .electric = electric,
                              .by_voltage = by_voltage,
                              .solve = solve,
                              .rules = ZP_RULES_OF(rule)};
