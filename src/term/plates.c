/* Attraction by the plates law on the polyline of the stations, lateral edges included. Eqs. (4.7) and (18.3). */
#include "term/term.h"

const ZpRow zp_row_field_energy =
    ZP_STORED(field_energy, "energy of the electric field, including what the breakdown cap absorbs");
const ZpRow zp_row_charging_loss =
    ZP_LOST(charging_loss, "part of electric_work, at jumps of the voltage, that the field did not store");

static bool acts(const ZpModel *model) {
  return model->field && !model->leaks;
}

static const ZpPlatesEval *start_of(const ZpSpan *span, const ZpEval *e) {
  return zp_span_is_still(span) ? &e->plates : &e->plates_start;
}

/* With the liquid where it is there. */
static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  const double reach[ZP_BEADS] = {span->bead ? span->bead[0].reach : 0, span->bead ? span->bead[1].reach : 0};
  zp_eval_cover(model, reach, e);
  zp_plates_gaps(&model->plates, span->start, zp_nodes(model, span->start).y, &e->plates_start);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (!span->paper || !span->faces_pass) zp_term_gaps(model, span, e);
  if (span->paper) return; /* its Bezier surface attracts instead */
  zp_plates_step(&model->plates, start_of(span, e), &e->plates, span->U0, span->U1, &e->attraction);
  zp_term_add(model, e->attraction.Fx, e->attraction.Fy, F);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  (void)assembly, (void)K;
  double both = zp_span_is_still(span) ? 2 : 1; /* at rest both ends of the span move */
  for (size_t i = 0; i < model->nodes; i++) {
    e->gaps.own[i] += both * e->attraction.own[i];
    e->gaps.next[i] += both * e->attraction.next[i];
    e->gaps.along0[i] += both * e->attraction.along0[i];
    e->gaps.along1[i] += both * e->attraction.along1[i];
  }
}

static void electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U,
                     ZpElectric *sum) {
  const ZpPlatesEval *gaps = at == ZP_SPAN_START ? start_of(span, e) : &e->plates;
  ZpPlatesTotals totals = zp_plates_totals(&model->plates, gaps, U);
  sum->force += totals.force;
  sum->charge += totals.charge;
  sum->potential += totals.potential;
  sum->capacitance += zp_part_capacitance(model, totals.inverse_gap);
}

static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  ZpPlatesByVoltage *by = &e->by_voltage;
  if (zp_span_is_still(span)) {
    zp_plates_rest_by_voltage(&model->plates, &e->plates, span->U1, &e->attraction, by->Fx, by->Fy);
    zp_term_add(model, by->Fx, by->Fy, sum->force);
    return;
  }
  zp_plates_by_voltage(&model->plates, start_of(span, e), &e->plates, span->U1, &e->attraction, by);
  zp_term_add(model, by->Fx, by->Fy, sum->force);
  zp_term_add(model, by->Qx, by->Qy, sum->charge);
  sum->capacitance += by->capacitance;
}

/* Derivatives of the law's coefficient, over it, and of its d by a key. */
typedef struct Rate {
  double k, d; /* 1 and m over the unit of the key */
} Rate;

/* Of the insulator of one ribbon. */
static double offset_by_insulator(const ZpModel *model, int ribbon, int key) {
  ZpActuatorDef room;
  const ZpActuatorDef *def = ribbon ? zp_def_lower(&model->def, &room) : &model->def;
  const double t = def->insulator.thickness, eps = def->insulator.permittivity;
  key = zp_def_key_of_ribbon(&model->def, ribbon, key);
  return key == ZP_KEY(insulator.thickness)      ? def->medium.permittivity / eps
         : key == ZP_KEY(insulator.permittivity) ? -def->medium.permittivity * t / (eps * eps)
                                                 : 0;
}

static Rate rate_of(const ZpModel *model, int key) {
  const ZpActuatorDef *def = &model->def;
  const bool insulated = isnan(def->electro.insulator_offset);
  Rate rate = {0, insulated ? offset_by_insulator(model, 0, key) + offset_by_insulator(model, 1, key) : 0};
  if (key == ZP_KEY(ribbon.width)) rate.k = 1 / def->ribbon.width;
  if (key == ZP_KEY(electro.force_scale)) rate.k = 1 / def->electro.force_scale;
  if (key == ZP_KEY(medium.permittivity))
    rate = (Rate){1 / def->medium.permittivity, insulated ? model->series.thickness : 0};
  return rate;
}

/* Of the law without lateral edges, air, and the authors' switch. */
static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  const Rate rate = rate_of(model, key);
  const ZpPlatesParams *p = &model->plates;
  ZpPlatesByVoltage *by = &e->by_voltage;
  if ((rate.k == 0 && rate.d == 0) || p->edges || p->air || p->h_switch_per_volt > 0 || span->paper) return false;
  zp_plates_rest_by_offset(p, &e->plates, span->U1, &e->attraction, by->Fx, by->Fy);
  for (size_t j = 0; j < zp_lanes(model); j++) {
    by->Fx[j] = rate.k * e->attraction.Fx[j] + rate.d * by->Fx[j];
    by->Fy[j] = rate.k * e->attraction.Fy[j] + rate.d * by->Fy[j];
  }
  zp_term_add(model, by->Fx, by->Fy, F);
  return true;
}

#define UNEQUAL "the field at the edges is computed for two equal strips, whose middle plane is a mirror"
static const ZpRule rule[] = {
    /* lateral edges */
    ZP_RULE(EQUATION, ZP_IS(electro.edges, true), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's surface has no edges"),
    ZP_RULE_IF(PHYSICS, ZP_IS(electro.edges, true), ZP_LACKS(COUNTER), ZP_ABOVE(insulator.thickness, 0),
               "the field at the edges of bare faces that touch is infinite"),
    ZP_RULE_IF(NOT_MODELLED, ZP_IS(electro.edges, true), ZP_LACKS(COUNTER), ZP_UNSET(lower.insulator.thickness),
               UNEQUAL),
    ZP_RULE_IF(NOT_MODELLED, ZP_IS(electro.edges, true), ZP_LACKS(COUNTER), ZP_UNSET(lower.insulator.permittivity),
               UNEQUAL),
    ZP_RULE_IF(NOT_MODELLED, ZP_IS(electro.edges, true), ZP_LACKS(COUNTER), ZP_UNSET(lower.ribbon.thickness), UNEQUAL),
    /* the paper's offset, which is that of both insulators */
    ZP_RULES_EQUAL_INSULATORS(PHYSICS, ZP_SET(electro.insulator_offset), "the offset stands for both insulators"),
};

#undef UNEQUAL

/* The rows are those of all electric terms together: run/energy_balance.c fills them. */
const ZpTerm zp_term_plates = {.name = "plates",
                               .row = {&zp_row_field_energy, &zp_row_charging_loss},
                               .acts = acts,
                               .begin = begin,
                               .force = force,
                               .stiffness = stiffness,
                               .electric = electric,
                               .by_voltage = by_voltage,
                               .by_key = by_key,
                               .rules = ZP_RULES_OF(rule)};
