#include "system/system.h"

#include <string.h>

#include "base/kernel.h"

static const ZpTerm *const table[] = {
#define ZP_TERM(name) &zp_term_##name,
#include "term/terms.def"
#undef ZP_TERM
};
_Static_assert(sizeof table / sizeof table[0] < ZP_MOST_TERMS, "an eval has room for all terms, and one of a program");

bool zp_system_create(const ZpModel *model, bool solves, ZpEval *e) {
  if (!zp_eval_create(model, e)) return false;
  e->solves = solves;
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
    if (table[k]->acts && !table[k]->acts(model)) continue;
    e->term[e->terms++] = table[k];
    if (table[k]->create && !table[k]->create(model, e)) return false;
  }
  return true;
}

void zp_system_destroy(ZpEval *e) {
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->destroy) e->term[k]->destroy(e);
  zp_eval_destroy(e);
}

ZpSpan zp_span_at(const double *q) {
  return (ZpSpan){.start = q, .end = q, .share = 1};
}

ZpSpan zp_span_of(const ZpModel *model, const ZpState *state, const double *q, const double *v) {
  const ZpActuatorDef *def = &model->def;
  ZpSpan span = zp_span_at(q);
  span.v = v;
  span.U0 = span.U1 = state->U;
  span.load = zp_state_load(model, state, state->t);
  span.hung = zp_state_hung(model, state);
  span.hung_at[0] = state->changed_x;
  span.hung_at[1] = state->changed_y;
  span.faces_pass = def->contact.model != ZP_CONTACT_UNILATERAL;
  span.memory = zp_state_memory(model, state);
  span.bead = state->bead;
  span.beyond = zp_state_beyond(model, state);
  span.paper = def->electro.surface == ZP_SURFACE_POLYLINE ? NULL : state;
  return span;
}

void zp_system_begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->begin) e->term[k]->begin(model, span, e);
}

void zp_system_force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  memset(F, 0, 2 * model->stride * sizeof *F);
  for (size_t k = 0; k < e->terms; k++)
    e->term[k]->force(model, span, e, F);
}

static void clear_gaps(const ZpModel *model, const ZpGapDerivatives *gaps) {
  double *const all[] = {gaps->own, gaps->next, gaps->along0, gaps->along1};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
    memset(all[k], 0, model->nodes * sizeof *all[k]);
}

static void add_stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, bool edges,
                          ZpBand *K) {
  clear_gaps(model, &e->gaps);
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->stiffness && (edges || !e->term[k]->of_edges)) e->term[k]->stiffness(model, span, assembly, e, K);
  if (model->field) zp_assemble_gaps(assembly, &e->gaps, K);
}

void zp_system_add_stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e,
                             ZpBand *K) {
  add_stiffness(model, span, assembly, e, true, K);
}

void zp_system_add_stiffness_beside_edges(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly,
                                          ZpEval *e, ZpBand *K) {
  add_stiffness(model, span, assembly, e, false, K);
}

ZP_KERNEL static void divide(size_t stride, const double *mx, const double *my, double *restrict ax,
                             double *restrict ay) {
  ZP_SIMD
  for (size_t j = 0; j < stride; j++) {
    ax[j] *= mx[j];
    ay[j] *= my[j];
  }
}

void zp_system_accelerations(const ZpModel *model, const ZpSpan *span, const ZpMasses *masses, ZpEval *e, double *a) {
  e->drag_power = e->drag_rate = 0;
  zp_system_force(model, span, e, a);
  divide(model->stride, masses->x.inverse, masses->y.inverse, a, a + model->stride);
}

ZpEnergies zp_system_energies(const ZpModel *model, const ZpState *state, ZpEval *e) {
  ZpMotion m = zp_state_motion(model, state);
  ZpSpan now = zp_span_of(model, state, m.x, m.vx);
  ZpEnergies sum = {0};
  for (size_t j = 0; j < model->count; j++)
    sum.kinetic += 0.5 * model->mass[j] * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
  double added = zp_state_added(model, state);
  for (size_t i = model->topology.platform.first; added != 0 && i <= model->topology.platform.last; i++) {
    size_t j = zp_lower(&model->topology, i);
    sum.kinetic += 0.5 * added * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
  }
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->energy) e->term[k]->energy(model, &now, e, &sum);
  return sum;
}

ZpLosses zp_system_losses(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  ZpLosses sum = {0};
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->loss) e->term[k]->loss(model, span, e, &sum);
  return sum;
}

void zp_system_inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  memset(F, 0, 2 * model->stride * sizeof *F);
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->inertia) e->term[k]->inertia(model, span, e, a, F);
}

ZpElectric zp_system_electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U) {
  ZpElectric sum = {0};
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->electric) e->term[k]->electric(model, span, e, at, U, &sum);
  return sum;
}

ZpElectric zp_system_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *e) {
  ZpMotion m = zp_state_motion(model, state);
  ZpSpan now = zp_span_of(model, state, m.x, m.vx);
  if (model->field) zp_term_gaps(model, &now, e);
  return zp_system_electric(model, &now, e, ZP_SPAN_END, U);
}

bool zp_system_solve(const ZpModel *model, const double *q, double U, ZpEval *e) {
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->solve && !e->term[k]->solve(model, q, U, e)) return false;
  return true;
}

void zp_system_by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  memset(sum->force, 0, 2 * model->stride * sizeof *sum->force);
  if (sum->charge) memset(sum->charge, 0, 2 * model->stride * sizeof *sum->charge);
  sum->capacitance = 0;
  for (size_t k = 0; k < e->terms; k++)
    if (e->term[k]->by_voltage) e->term[k]->by_voltage(model, span, e, sum);
}
