/* The paper's springs, eqs. (3.1) to (3.8). Over a span the axial springs act as those of a rod, whose work is the
 * change of their energy. Shear springs have no energy, so their force is the mean of both ends. */
#include "term/term.h"

enum { AXIAL, SHEAR, INTERNAL };

static bool acts(const ZpModel *model) {
  return !model->is_rod;
}

static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  zp_rod_eval(&model->rod, span->start, zp_nodes(model, span->start).y, &e->rod_start);
  zp_massspring_eval(&model->shear, span->start, zp_nodes(model, span->start).y, &e->spring_start);
}

static void add_shear(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  zp_massspring_eval(&model->shear, span->end, zp_nodes(model, span->end).y, &e->spring);
  for (size_t j = 0; j + model->s < model->count; j++) {
    e->rod_step.Rx[j] += 0.5 * (e->spring_start.Rx[j] + e->spring.Rx[j]);
    e->rod_step.Ry[j] += 0.5 * (e->spring_start.Ry[j] + e->spring.Ry[j]);
  }
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) {
    zp_massspring_eval(&model->spring, span->end, zp_nodes(model, span->end).y, &e->spring);
    zp_term_add_edges(model, e->spring.Rx, e->spring.Ry, F);
    return;
  }
  zp_rod_eval(&model->rod, span->end, zp_nodes(model, span->end).y, &e->rod);
  zp_rod_step(&model->rod, &e->rod_start, &e->rod, zp_span_damping(model, span), &e->rod_step);
  add_shear(model, span, e);
  zp_term_add_edges(model, e->rod_step.Rx, e->rod_step.Ry, F);
}

/* Half of the derivative at the span's end; a symmetric matrix keeps its upper triangle. */
static void add_shear_stiffness(const ZpModel *model, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  zp_massspring_stiffness(&model->shear, &e->spring, e->spring.T, e->D);
  for (size_t k = 0; k < 3 * (model->count - model->s); k++)
    for (size_t c = 0; c < 4; c++)
      e->D[k][c] *= 0.5;
  zp_assemble_edges(assembly, (const double(*)[4])e->D, K);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  if (zp_span_is_still(span)) {
    zp_massspring_stiffness(&model->spring, &e->spring, span->tension ? span->tension : e->spring.T, e->D);
    zp_assemble_edges(assembly, (const double(*)[4])e->D, K);
    return;
  }
  zp_rod_stiffness(&model->rod, &e->rod_start, &e->rod, zp_span_damping(model, span), &e->rod_step, e->rod_step.tension,
                   e->D);
  zp_assemble_edges(assembly, (const double(*)[4])e->D, K);
  add_shear_stiffness(model, assembly, e, K);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  zp_massspring_eval(&model->spring, now->end, zp_nodes(model, now->end).y, &e->spring);
  row[AXIAL] += zp_massspring_axial_energy(&model->spring, &e->spring);
  row[SHEAR] += zp_massspring_shear_energy(&model->spring, &e->spring);
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  row[INTERNAL] += zp_term_edges_loss(model, span, e);
}

const ZpTerm zp_term_mass_spring = {
    .name = "mass_spring",
    .of_edges = true,
    .row = {[AXIAL] = &zp_row_axial_energy, [SHEAR] = &zp_row_bending_energy, [INTERNAL] = &zp_row_internal_loss},
    .acts = acts,
    .begin = begin,
    .force = force,
    .stiffness = stiffness,
    .now = energy,
    .loss = loss};
