/* Attraction between insulators and through a liquid that conduct: the plates law with the charge that has collected on
 * their faces, in place of `plates`. Eqs. (25.1) to (25.10). In equilibrium, where a span has no memory, there is
 * none. */
#include "term/term.h"

const ZpRow zp_row_leak_loss = ZP_LOST(leak_loss, "energy lost so far to conduction through insulators and liquid");

enum { CONDUCTION, OVERLAP };

static bool acts(const ZpModel *model) {
  return model->leaks;
}

/* Interface voltages. */
static size_t state(const ZpModel *model) {
  return zp_leak_state(&model->leak, &model->plates);
}

static bool create(const ZpModel *model, ZpEval *e) {
  e->leak.Z = e->memory_end + zp_law(model, &zp_term_leak)->at;
  return true;
}

static ZpLeakStep step_of(const ZpModel *model, const ZpSpan *span, const ZpEval *e) {
  const double *Z = zp_law_memory(model, &zp_term_leak, span->memory);
  const ZpPlatesEval *start = zp_span_is_still(span) ? &e->plates : &e->plates_start;
  return (ZpLeakStep){start, &e->plates, span->U0, span->U1, span->h, Z};
}

static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  zp_term_plates.begin(model, span, e);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (!span->memory) {
    zp_term_plates.force(model, span, e, F);
    return;
  }
  zp_term_gaps(model, span, e);
  ZpLeakStep step = step_of(model, span, e);
  zp_leak_step(&model->leak, &model->plates, &step, &e->leak);
  zp_leak_forces(&model->leak, &model->plates, &step, &e->leak, &e->attraction);
  zp_term_add(model, e->attraction.Fx, e->attraction.Fy, F);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  zp_term_plates.stiffness(model, span, assembly, e, K);
}

/* Faces have been corrected since the last force. */
static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  ZpLeakStep step = step_of(model, span, e);
  zp_leak_step(&model->leak, &model->plates, &step, &e->leak);
  ZpLeakHeat heat = zp_leak_heat(&model->leak, &step, &e->leak);
  row[CONDUCTION] += heat.conduction;
  row[OVERLAP] += heat.overlap;
}

static void electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U,
                     ZpElectric *sum) {
  if (!span->memory) {
    zp_term_plates.electric(model, span, e, at, U, sum);
    return;
  }
  bool later = at == ZP_SPAN_END && !zp_span_is_still(span);
  ZpLeakStep step = step_of(model, span, e);
  const ZpPlatesEval *gaps = at == ZP_SPAN_START ? step.start : step.end;
  ZpPlatesTotals totals = zp_leak_totals(&model->leak, &model->plates, gaps, U, later ? e->leak.Z : step.Z);
  sum->force += totals.force;
  sum->charge += totals.charge;
  sum->potential += totals.potential;
  sum->capacitance += zp_part_capacitance(model, totals.inverse_gap);
  if (later) sum->passed += zp_leak_passed(&e->leak);
}

static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  if (!span->memory || zp_span_is_still(span)) {
    zp_term_plates.by_voltage(model, span, e, sum);
    return;
  }
  ZpPlatesByVoltage *by = &e->by_voltage;
  ZpLeakStep step = step_of(model, span, e);
  zp_leak_by_voltage(&model->leak, &model->plates, &step, &e->leak, by);
  zp_term_add(model, by->Fx, by->Fy, sum->force);
  zp_term_add(model, by->Qx, by->Qy, sum->charge);
  sum->capacitance += by->capacitance;
}

static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  return !span->memory && zp_term_plates.by_key(model, span, e, key, F);
}

#define ZP_LEAK(resistivity)                                                                                           \
  ZP_RULE(PHYSICS, ZP_SET(resistivity), ZP_HAS(ELECTRODES), "a single ribbon has no electrodes"),                      \
      ZP_RULE(PHYSICS, ZP_SET(resistivity), ZP_ABOVE(insulator.thickness, 0),                                          \
              "charge accumulates on the face of an insulator"),                                                       \
      ZP_RULE(PHYSICS, ZP_SET(resistivity), ZP_UNSET(electro.force_scale), "charge and force have one energy"),        \
      ZP_RULE(PHYSICS, ZP_SET(resistivity), ZP_UNSET(electro.voltage_share), "charge and force have one energy"),      \
      ZP_RULE(PHYSICS, ZP_SET(resistivity), ZP_UNSET(electro.insulator_offset),                                        \
              "the insulator that charges has a thickness and a permittivity"),                                        \
      ZP_RULE(EQUATION, ZP_SET(resistivity), ZP_IS(electro.edges, false),                                              \
              "the charge of the faces at the lateral edges has no closed form"),                                      \
      ZP_RULES_EQUAL_INSULATORS(NOT_MODELLED, ZP_SET(resistivity),                                                     \
                                "unequal layers charge at two rates, and one is modelled"),                            \
      ZP_RULE(NOT_MODELLED, ZP_SET(resistivity), ZP_IS(electro.model, ZP_ELECTRO_PLATES),                              \
              "the charge of the faces enters the plates law"),                                                        \
      ZP_RULE(EQUATION, ZP_SET(resistivity), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),                              \
              "the charge of the faces belongs to places of the polyline"),                                            \
      ZP_MOTION_RULE(NOT_MODELLED, ZP_SET(resistivity), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),              \
                     "the charge of the faces is stepped with implicit steps")

static const ZpRule rule[] = {
    ZP_LEAK(insulator.resistivity),
    ZP_LEAK(medium.resistivity),
    ZP_RULE_IF(PHYSICS, ZP_ABOVE(electro.leak_share, 0), ZP_UNSET(insulator.resistivity), ZP_SET(medium.resistivity),
               "nothing conducts faster than what does not conduct"),
    ZP_RULE(PHYSICS, ZP_ABOVE(electro.leak_share, 0), ZP_SET(electro.leak_ratio), "these patches conduct faster by it"),
    ZP_RULE(PHYSICS, ZP_SET(electro.leak_ratio), ZP_ABOVE(electro.leak_share, 0),
            "without a share there are no such patches"),
};
#undef ZP_LEAK

const ZpTerm zp_term_leak = {.name = "leak",
                             .row = {[CONDUCTION] = &zp_row_leak_loss, [OVERLAP] = &zp_row_contact_loss},
                             .state = state,
                             .acts = acts,
                             .create = create,
                             .begin = begin,
                             .force = force,
                             .stiffness = stiffness,
                             .loss = loss,
                             .electric = electric,
                             .by_voltage = by_voltage,
                             .by_key = by_key,
                             .rules = ZP_RULES_OF(rule)};
