/* Natural curvature that voltage drives: segments whose kappa follows the voltage, with or without a lag. The term has
 * its state and the work of whatever drives it; the moments are those of the rod, which asks for the natural curvatures
 * here. Equations of docs/theory.md, section 38. */
#include "term/curvature.h"

#include <math.h>
#include <string.h>

const ZpRow zp_row_curvature_work =
    ZP_GAVE(curvature_work, "work so far of what drives natural curvatures (segment_K.curvature_per_volt)");

enum { WORK };

static bool acts(const ZpModel *model) {
  return model->driven.places > 0;
}

/* kappa of each driven segment, 1/m. */
static size_t state(const ZpModel *model) {
  return model->driven.places;
}

static bool create(const ZpModel *model, ZpEval *e) {
  ZpNatural *n = &e->natural;
  for (size_t k = 0; k < ZP_NATURAL_PLACES; k++)
    memcpy(n->k0[k], model->rod.k0, zp_lanes(model) * sizeof *n->k0[k]);
  n->kappa[ZP_NATURAL_END] = e->memory_end + zp_law(model, &zp_term_curvature)->at;
  return true;
}

/* kappa at an instant of a state, or at rest, where memory is NULL. */
static double now_of(const ZpDrivenPlace *place, const double *memory, size_t p, double U) {
  return memory && place->lag > 0 ? memory[p] : zp_driven_aim(place, U);
}

/* kappa at the start and the end of a span => natural curvatures of both. */
static void bend(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  const ZpDriven *d = &model->driven;
  const double *memory = zp_law_memory(model, &zp_term_curvature, span->memory);
  ZpNatural *n = &e->natural;
  for (size_t p = 0; p < d->places; p++) {
    const ZpDrivenPlace *place = &d->place[p];
    const double from = now_of(place, memory, p, span->U0), g0 = zp_driven_aim(place, span->U0),
                 g1 = zp_driven_aim(place, span->U1);
    n->kappa[ZP_NATURAL_START][p] = from;
    n->kappa[ZP_NATURAL_END][p] = span->h > 0 ? zp_driven_after(place, from, g0, g1, span->h) : from;
  }
  zp_driven_bend(d, n->kappa[ZP_NATURAL_START], n->k0[ZP_NATURAL_START]);
  zp_driven_bend(d, n->kappa[ZP_NATURAL_END], n->k0[ZP_NATURAL_END]);
}

const double *zp_term_natural(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  if (acts(model)) bend(model, span, e);
  const double *start = acts(model) ? e->natural.k0[ZP_NATURAL_START] : model->rod.k0,
               *end = acts(model) ? e->natural.k0[ZP_NATURAL_END] : model->rod.k0;
  if (span->share == 1 && start == end) return model->rod.k0;
  for (size_t j = 0; j < zp_lanes(model); j++)
    e->k0[j] = span->share * (start == end ? start[j] : 0.5 * (start[j] + end[j]));
  return e->k0;
}

const double *zp_term_natural_of_state(const ZpModel *model, const ZpSpan *now, ZpEval *e) {
  const double *memory = zp_law_memory(model, &zp_term_curvature, now->memory);
  if (!acts(model)) return model->rod.k0;
  if (!memory) return zp_term_natural(model, now, e);
  zp_driven_bend(&model->driven, memory, e->natural.k0[ZP_NATURAL_BEFORE]);
  return e->natural.k0[ZP_NATURAL_BEFORE];
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)model, (void)span, (void)e, (void)F; /* that of the rod has it */
}

/* A voltage that has jumped since the last step has moved what follows at once, while the ribbon stood still. */
static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  bend(model, span, e);
  const double *before = zp_term_natural_of_state(model, span, e), *start = e->natural.k0[ZP_NATURAL_START];
  row[WORK] += zp_driven_work(&model->rod, &e->rod_start, &e->rod_start, before, start) +
               zp_driven_work(&model->rod, &e->rod_start, &e->rod, start, e->natural.k0[ZP_NATURAL_END]);
}

/* F += a share of what `by` adds to the forces. */
static void add_rate(const ZpModel *model, ZpEval *e, double share, double *F) {
  const ZpNatural *n = &e->natural;
  zp_driven_edges(&model->rod, &e->rod_step, n->by, share, n->Rx, n->Ry);
  zp_term_add_edges(model, n->Rx, n->Ry, F);
}

static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  const ZpDriven *d = &model->driven;
  const bool still = zp_span_is_still(span);
  ZpNatural *n = &e->natural;
  if (sum->of_charge) return;
  bend(model, span, e);
  for (size_t p = 0; p < d->places; p++)
    n->rate[p] = zp_driven_aim_rate(&d->place[p], span->U1) * (still ? 1 : zp_driven_share(&d->place[p], span->h));
  zp_driven_bend_rate(d, n->kappa[ZP_NATURAL_END], n->rate, n->by);
  add_rate(model, e, still ? span->share : 0.5, sum->force);
}

void zp_term_curvature_by_place(const ZpModel *model, const ZpSpan *span, size_t place, ZpEval *e, double *F) {
  ZpNatural *n = &e->natural;
  bend(model, span, e);
  memset(n->rate, 0, model->driven.places * sizeof *n->rate);
  n->rate[place] = 1;
  zp_driven_bend_rate(&model->driven, n->kappa[ZP_NATURAL_END], n->rate, n->by);
  add_rate(model, e, span->share, F);
}

#define ZP_DRIVEN(key)                                                                                                 \
  ZP_RULE(NOT_MODELLED, ZP_SET(key), ZP_IS(ribbon.plasticity, false),                                                  \
          "a strip that yields has one natural curvature over a step"),                                                \
      ZP_RULE(EQUATION, ZP_SET(key), ZP_IS(hinge.stiffness, 0),                                                        \
              "the rest angle of the hinge's spring would move with the voltage"),                                     \
      ZP_MOTION_RULE(NOT_MODELLED, ZP_SET(key), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),                      \
                     "explicit steps are those of the paper, whose ribbons are straight by nature")

static const ZpRule rule[] = {ZP_DRIVEN(segment_K.curvature_per_volt), ZP_DRIVEN(segment_K.curvature_per_volt_squared),
                              ZP_DRIVEN(lower.segment_K.curvature_per_volt),
                              ZP_DRIVEN(lower.segment_K.curvature_per_volt_squared)};
#undef ZP_DRIVEN

const ZpTerm zp_term_curvature = {.name = "curvature",
                                  .row = {[WORK] = &zp_row_curvature_work},
                                  .state = state,
                                  .acts = acts,
                                  .create = create,
                                  .force = force,
                                  .loss = loss,
                                  .by_voltage = by_voltage,
                                  .rules = ZP_RULES_OF(rule)};
