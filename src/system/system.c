#include "system/system.h"

#include <string.h>

#include "base/kernel.h"

bool zp_system_create(const ZpModel *model, bool solves, ZpEval *e) {
  if (!zp_eval_create(model, e)) return false;
  e->solves = solves;
  for (size_t k = 0; k < model->laws; k++) {
    const ZpTerm *term = model->law[k].term;
    if (term->create && !term->create(model, e)) return false;
  }
  return true;
}

void zp_system_destroy(ZpEval *e) {
  for (size_t k = 0; e->model && k < e->model->laws; k++)
    if (e->model->law[k].term->destroy) e->model->law[k].term->destroy(e);
  zp_eval_destroy(e);
}

ZpSpan zp_span_at(const double *q) {
  return (ZpSpan){.start = q, .end = q, .share = 1, .suction = 1, .modulus = zp_pouch_modulus};
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
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->begin) model->law[k].term->begin(model, span, e);
}

void zp_system_force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  memset(F, 0, zp_coordinates(model) * sizeof *F);
  for (const ZpLaw *law = model->law, *end = law + model->laws; law < end; law++)
    law->term->force(model, span, e, F);
}

static bool is_among(const ZpTerms *terms, const ZpTerm *term) {
  for (size_t k = 0; k < terms->count; k++)
    if (terms->term[k] == term) return true;
  return false;
}

void zp_system_force_without(const ZpModel *model, const ZpSpan *span, const ZpTerms *without, ZpEval *e, double *F) {
  memset(F, 0, zp_coordinates(model) * sizeof *F);
  memset(e->unused, 0, zp_coordinates(model) * sizeof *e->unused);
  for (const ZpLaw *law = model->law; law < model->law + model->laws; law++)
    law->term->force(model, span, e, is_among(without, law->term) ? e->unused : F);
}

static void clear_gaps(const ZpModel *model, const ZpGapDerivatives *gaps) {
  double *const all[] = {gaps->own, gaps->next, gaps->along0, gaps->along1};
  for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
    memset(all[k], 0, model->nodes * sizeof *all[k]);
}

static void add_stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, bool edges,
                          ZpBand *K) {
  clear_gaps(model, &e->gaps);
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->stiffness && (edges || !model->law[k].term->of_edges))
      model->law[k].term->stiffness(model, span, assembly, e, K);
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

ZP_KERNEL static void divide(size_t lanes, const double *mx, const double *my, double *restrict ax,
                             double *restrict ay) {
  ZP_SIMD
  for (size_t j = 0; j < lanes; j++) {
    ax[j] *= mx[j];
    ay[j] *= my[j];
  }
}

void zp_system_accelerations(const ZpModel *model, const ZpSpan *span, const ZpMasses *masses, ZpEval *e, double *a) {
  e->drag_power = e->drag_rate = 0;
  zp_system_force(model, span, e, a);
  ZpForces of = zp_forces(model, a);
  divide(zp_lanes(model), masses->x.inverse, masses->y.inverse, of.x, of.y);
}

/* Add the present values of a law's rows. */
static void add_rows(const ZpModel *model, const ZpLaw *law, const ZpSpan *now, ZpEval *e, double *ledger) {
  double row[ZP_ROWS_OF_TERM];
  for (size_t k = 0; k < law->rows; k++)
    row[k] = ledger[law->row[k]];
  law->term->now(model, now, e, row);
  for (size_t k = 0; k < law->rows; k++)
    ledger[law->row[k]] = row[k];
}

static double kinetic_energy(const ZpModel *model, const ZpState *state) {
  ZpMotion m = zp_state_motion(model, state);
  double sum = 0;
  for (size_t j = 0; j < model->count; j++)
    sum += 0.5 * model->mass[j] * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
  double added = zp_state_added(model, state);
  for (size_t i = model->topology.platform.first; added != 0 && i <= model->topology.platform.last; i++) {
    size_t j = zp_lower(&model->topology, i);
    sum += 0.5 * added * (m.vx[j] * m.vx[j] + m.vy[j] * m.vy[j]);
  }
  return sum;
}

void zp_system_now(const ZpModel *model, const ZpState *state, ZpEval *e, double *ledger) {
  ZpMotion m = zp_state_motion(model, state);
  ZpSpan now = zp_span_of(model, state, m.x, m.vx);
  for (size_t k = 0; k < model->ledger.rows; k++)
    if (model->ledger.row[k]->kind == ZP_ROW_STORED || model->ledger.row[k]->kind == ZP_ROW_SIGNAL) ledger[k] = 0;
  ledger[0] = kinetic_energy(model, state);
  for (const ZpLaw *law = model->law; law < model->law + model->laws; law++)
    if (law->term->now) add_rows(model, law, &now, e, ledger);
}

double zp_system_stored(const ZpModel *model, const double *ledger) {
  double sum = 0;
  for (size_t k = 0; k < model->ledger.rows; k++)
    if (model->ledger.row[k]->kind == ZP_ROW_STORED) sum += ledger[k];
  return sum;
}

double zp_system_taken(const ZpModel *model, const double *start, const double *now) {
  double sum = 0;
  for (size_t k = 0; k < model->ledger.rows; k++) {
    ZpRowKind kind = model->ledger.row[k]->kind;
    if (kind == ZP_ROW_STORED) sum += now[k] - start[k];
    if (kind == ZP_ROW_LOST) sum += now[k];
    if (kind == ZP_ROW_GAVE) sum -= now[k];
  }
  return sum;
}

void zp_system_book(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpState *state) {
  double *ledger = zp_state_ledger(model, state);
  for (size_t i = 0; i < model->losers; i++) {
    const ZpLaw *law = &model->law[model->losing[i]];
    double lost[ZP_ROWS_OF_TERM] = {0};
    law->term->loss(model, span, e, lost);
    for (size_t k = 0; k < law->rows; k++)
      ledger[law->row[k]] += lost[k];
  }
}

void zp_system_inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  memset(F, 0, zp_coordinates(model) * sizeof *F);
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->inertia) model->law[k].term->inertia(model, span, e, a, F);
}

ZpElectric zp_system_electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U) {
  ZpElectric sum = {0};
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->electric) model->law[k].term->electric(model, span, e, at, U, &sum);
  return sum;
}

ZpElectric zp_system_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *e) {
  ZpMotion m = zp_state_motion(model, state);
  ZpSpan now = zp_span_of(model, state, m.x, m.vx);
  if (model->field) zp_term_gaps(model, &now, e);
  return zp_system_electric(model, &now, e, ZP_SPAN_END, U);
}

bool zp_system_solve(const ZpModel *model, const double *q, double U, ZpEval *e) {
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->solve && !model->law[k].term->solve(model, q, U, e)) return false;
  return true;
}

void zp_system_by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  memset(sum->force, 0, zp_coordinates(model) * sizeof *sum->force);
  if (sum->charge) memset(sum->charge, 0, zp_coordinates(model) * sizeof *sum->charge);
  sum->capacitance = 0;
  for (size_t k = 0; k < model->laws; k++)
    if (model->law[k].term->by_voltage) model->law[k].term->by_voltage(model, span, e, sum);
}

void zp_system_internal_damping(const ZpModel *model, const double *q, ZpEval *e, double (*spare)[4]) {
  zp_rod_eval(&model->rod, q, zp_nodes(model, q).y, &e->rod_start);
  zp_rod_eval(&model->rod, q, zp_nodes(model, q).y, &e->rod);
  zp_rod_damping(&model->rod, &e->rod_start, &e->rod, &e->rod_step, spare, e->D);
  for (size_t k = 0; k < 3 * (model->count - model->s); k++)
    for (size_t c = 0; c < 4; c++)
      e->D[k][c] *= model->internal_damping;
}
