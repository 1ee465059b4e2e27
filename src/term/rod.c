/* The rod: stretching, bending, internal damping, yielding, creeping. Eqs. (8.4), (8.12), (18.2) and (39.10). */
#include "term/curvature.h"

#include "ribbon/rod_maxwell.h"
#include "ribbon/rod_plastic.h"

const ZpRow zp_row_axial_energy = ZP_STORED(axial_energy, "stretching energy");
const ZpRow zp_row_bending_energy =
    ZP_STORED(bending_energy, "bending energy (mass_spring: energy of the shear springs)");
const ZpRow zp_row_internal_loss = ZP_LOST(internal_loss, "energy lost so far to internal damping");
const ZpRow zp_row_plastic_loss =
    ZP_LOST(plastic_loss, "energy lost so far to plastic bending and stretching; 0 without ribbon.plasticity");
const ZpRow zp_row_permanent_curvature =
    ZP_SHOWN(permanent_curvature, "1/m", "_per_m",
             "largest curvature of a ribbon that would remain without a moment; 0 without ribbon.plasticity");
const ZpRow zp_row_permanent_strain =
    ZP_SHOWN(permanent_strain, "1", "",
             "largest strain of a ribbon along that would remain without a force; 0 without "
             "ribbon.plasticity");
const ZpRow zp_row_relaxing_energy =
    ZP_STORED(relaxing_energy, "energy of layers that creep beyond that at rest; 0 without a relaxation modulus");
const ZpRow zp_row_relaxation_loss =
    ZP_LOST(relaxation_loss, "energy lost so far as layers creep; 0 without a relaxation modulus");

enum { AXIAL, BENDING, INTERNAL, PLASTIC, PERMANENT, ELONGATED, RELAXING, RELAXED };

static bool acts(const ZpModel *model) {
  return model->is_rod && !zp_is_in_space(model);
}

/* Plastic strains, fibre by fibre, then those of springs that relax. */
static size_t state(const ZpModel *model) {
  return zp_rod_plastic_count(&model->rod) + zp_rod_maxwell_count(&model->rod);
}

static bool create(const ZpModel *model, ZpEval *e) {
  e->rod_step.strain_end = e->memory_end + zp_law(model, &zp_term_rod)->at;
  e->rod_step.spring_end = e->rod_step.strain_end + zp_rod_plastic_count(&model->rod);
  return true;
}

static const ZpRodEval *start_of(const ZpSpan *span, const ZpEval *e) {
  return zp_span_is_still(span) ? &e->rod : &e->rod_start;
}

static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  zp_rod_eval(&model->rod, span->start, zp_nodes(model, span->start).y, &e->rod_start);
}

/* Plastic strains where the span starts. */
static const double *strain_of(const ZpModel *model, const ZpSpan *span) {
  return model->rod.plastic ? zp_law_memory(model, &zp_term_rod, span->memory) : NULL;
}

/* Strains of springs there. */
static const double *spring_of(const ZpModel *model, const ZpSpan *span) {
  const double *memory = zp_law_memory(model, &zp_term_rod, span->memory);
  return model->rod.branch && memory ? memory + zp_rod_plastic_count(&model->rod) : NULL;
}

/* State and length of a span. */
static void remember(const ZpModel *model, const ZpSpan *span, ZpRodStep *step) {
  step->strain_start = strain_of(model, span);
  step->spring_start = spring_of(model, span);
  step->h = span->h;
}

/* With these natural curvatures. */
static const ZpRodParams *bent_to(const ZpModel *model, const double *k0, ZpEval *e) {
  if (k0 == model->rod.k0) return &model->rod;
  e->bent = model->rod;
  e->bent.k0 = k0;
  return &e->bent;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  zp_rod_eval(&model->rod, span->end, zp_nodes(model, span->end).y, &e->rod);
  remember(model, span, &e->rod_step);
  zp_rod_step(bent_to(model, zp_term_natural(model, span, e), e), start_of(span, e), &e->rod,
              zp_span_damping(model, span), &e->rod_step);
  zp_term_add_edges(model, e->rod_step.Rx, e->rod_step.Ry, F);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  const double *tension = span->tension ? span->tension : e->rod_step.tension;
  zp_rod_stiffness(&model->rod, start_of(span, e), &e->rod, zp_span_damping(model, span), &e->rod_step, tension, e->D);
  for (size_t k = 0; zp_span_is_still(span) && k < 3 * (model->count - model->s); k++)
    for (size_t c = 0; c < 4; c++)
      e->D[k][c] *= 2; /* both ends of the span move */
  zp_assemble_edges(assembly, (const double(*)[4])e->D, K);
}

/* The tension of all edges changes as that with which the strip was clamped. */
static void by_tension(const ZpModel *model, ZpEval *e, double *F) {
  const double none[2] = {0, 0};
  for (size_t j = 0; j < zp_lanes(model); j++)
    e->rod_step.T[j] = 1;
  zp_rod_step_scale(&model->rod, (const double[]){1, 1}, none, &e->rod_step);
  zp_term_add_edges(model, e->rod_step.Rx, e->rod_step.Ry, F);
}

/* Stretching and bending are proportional to the stiffness of a ribbon, but for curling, yielding and the tension with
 * which a strip was clamped. */
static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  double axial[2], bending[2];
  (void)span;
  if (key == ZP_KEY(ribbon.tension) && !model->rod.plastic) {
    by_tension(model, e, F);
    return true;
  }
  if (model->def.ribbon.tension > 0) return false;
  for (size_t r = 0; r < model->s; r++) {
    const ZpSection section = zp_ribbon_section(model, r);
    ZpSection rate;
    if (model->ribbon[r].curl.EI > 0 || model->rod.plastic || !zp_ribbon_by_key(model, r, key, &rate)) return false;
    axial[r] = rate.EA / section.EA;
    bending[r] = rate.EI / section.EI;
  }
  zp_rod_step_scale(&model->rod, axial, bending, &e->rod_step);
  zp_term_add_edges(model, e->rod_step.Rx, e->rod_step.Ry, F);
  return true;
}

static void hold(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  zp_rod_eval(&model->rod, now->end, zp_nodes(model, now->end).y, &e->rod);
  row[AXIAL] += zp_rod_stretching_energy(&model->rod, &e->rod);
  row[BENDING] += zp_rod_bending_energy(bent_to(model, zp_term_natural_of_state(model, now, e), e), &e->rod) -
                  zp_rod_plastic_relief(&model->rod, &e->rod, strain_of(model, now));
  row[RELAXING] += zp_rod_maxwell_energy(&model->rod, spring_of(model, now));
  if (!strain_of(model, now)) return;
  row[PERMANENT] += zp_rod_plastic_set(&model->rod, strain_of(model, now));
  row[ELONGATED] += zp_rod_plastic_elongation(&model->rod, strain_of(model, now));
}

/* The edges are those at the end of the span, one correction after the last force. */
static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  row[INTERNAL] += zp_term_edges_loss(model, span, e);
  remember(model, span, &e->rod_step);
  row[PLASTIC] += zp_rod_plastic_heat(&model->rod, &e->rod_start, &e->rod, &e->rod_step);
  row[RELAXED] += zp_rod_maxwell_heat(&model->rod, &e->rod_start, &e->rod, &e->rod_step);
}

#define ZP_RULES_OF_A_LAYER(layer)                                                                                     \
  ZP_RULE(PHYSICS, ZP_ABOVE(layer.relaxation_modulus, 0), ZP_SET(layer.relaxation_time), "what creeps takes a time"),  \
      ZP_RULE(PHYSICS, ZP_SET(layer.relaxation_time), ZP_ABOVE(layer.relaxation_modulus, 0),                           \
              "without that modulus nothing creeps"),                                                                  \
      ZP_RULE(EQUATION, ZP_ABOVE(layer.relaxation_modulus, 0), ZP_IS(ribbon.model, ZP_RIBBON_ROD),                     \
              "the paper's springs and strips in space do not creep"),                                                 \
      ZP_RULE(EQUATION, ZP_ABOVE(layer.relaxation_modulus, 0), ZP_NOT(ribbon.plane, ZP_PLANE_ANTICLASTIC),             \
              "the creep of a strip that curls has no closed form; use strain or stress"),                             \
      ZP_MOTION_RULE(NOT_MODELLED, ZP_ABOVE(layer.relaxation_modulus, 0),                                              \
                     ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),                                                 \
                     "the state of layers that creep is stepped with implicit steps")

static const ZpRule rule[] = {
    ZP_RULE(EQUATION, ZP_IS(ribbon.plane, ZP_PLANE_ANTICLASTIC), ZP_NOT(ribbon.model, ZP_RIBBON_MASS_SPRING),
            "the paper's springs have one bending stiffness"),
    ZP_RULE(PHYSICS, ZP_ABOVE(ribbon.tension, 0), ZP_LACKS(ENDS),
            "clips, platforms and free ends do not hold the tension of two ribbons or films"),
    ZP_RULE(PHYSICS, ZP_ABOVE(ribbon.tension, 0), ZP_IS(actuator.right_end, ZP_END_CLAMPED),
            "an end that moves does not hold the tension of the strip"),
    ZP_RULE(NOT_MODELLED, ZP_ABOVE(ribbon.tension, 0), ZP_IS(ribbon.plasticity, false),
            "the fibres of a strip that yields begin without tension"),
    ZP_RULE(EQUATION, ZP_ABOVE(ribbon.tension, 0), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the paper's springs and strips in space have their lengths while nothing loads them"),
    ZP_RULE(PHYSICS, ZP_ABOVE(ribbon.hardening_modulus, 0), ZP_IS(ribbon.plasticity, true),
            "an elastic strip does not harden"),
    ZP_RULE(PHYSICS, ZP_ABOVE(lower.ribbon.hardening_modulus, 0), ZP_IS(ribbon.plasticity, true),
            "an elastic strip does not harden"),
    ZP_RULE(EQUATION, ZP_IS(ribbon.plasticity, true), ZP_NOT(ribbon.plane, ZP_PLANE_ANTICLASTIC),
            "the moment of a strip that yields while it curls has no closed form; use strain or stress"),
    ZP_RULE(EQUATION, ZP_IS(ribbon.plasticity, true), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the paper's springs and strips in space are elastic; use ribbon.plasticity false"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_IS(ribbon.plasticity, true), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "the state of a strip that yields is stepped with implicit steps"),
    ZP_RULES_OF_A_LAYER(ribbon),
    ZP_RULES_OF_A_LAYER(insulator),
    ZP_RULE(EQUATION, ZP_ABOVE(ribbon.relaxation_modulus, 0), ZP_IS(ribbon.plasticity, false),
            "what creeps of a strip that yields is not known; its insulators may creep"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_ABOVE(damping.internal, 0), ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of the paper, which has no internal damping"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_ABOVE(damping.internal, 0), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
                   "the paper's springs have no damping"),
};

const ZpTerm zp_term_rod = {.name = "rod",
                            .of_edges = true,
                            .row = {[AXIAL] = &zp_row_axial_energy,
                                    [BENDING] = &zp_row_bending_energy,
                                    [INTERNAL] = &zp_row_internal_loss,
                                    [PLASTIC] = &zp_row_plastic_loss,
                                    [PERMANENT] = &zp_row_permanent_curvature,
                                    [ELONGATED] = &zp_row_permanent_strain,
                                    [RELAXING] = &zp_row_relaxing_energy,
                                    [RELAXED] = &zp_row_relaxation_loss},
                            .state = state,
                            .state_at_rest = true,
                            .acts = acts,
                            .create = create,
                            .begin = begin,
                            .force = force,
                            .stiffness = stiffness,
                            .now = hold,
                            .loss = loss,
                            .by_key = by_key,
                            .rules = ZP_RULES_OF(rule)};
