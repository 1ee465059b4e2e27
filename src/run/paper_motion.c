#include "run/paper_motion.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "def/rule.h"

static bool is_sequential(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_SEQUENTIAL;
}

static bool is_unilateral(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_UNILATERAL;
}

bool zp_paper_motion_create(const ZpModel *model, ZpEval *eval, ZpPaperMotion *motion) {
  *motion = (ZpPaperMotion){.model = model, .eval = eval, .longest = INFINITY};
  motion->contact = zp_row_number(&model->ledger, &zp_row_contact_loss);
  motion->a = zp_calloc(zp_coordinates(model), sizeof *motion->a);
  motion->step.a = motion->a;
  return motion->a;
}

void zp_paper_motion_destroy(ZpPaperMotion *motion) {
  zp_free(motion->a);
  motion->a = NULL;
}

/* -- unilateral contact --------------------------------------------------------------------------- */

/* The damper removes relative velocity from station i => the loss, J: its kinetic energy, and half of the work of
 * attraction and ribbons over the step at the removed velocity, because symplectic steps conserve the energy of
 * velocities half a step later. */
static double damp(const ZpPaperMotion *m, size_t i, const double *ay, double dt, double *vy) {
  const ZpTopology *t = &m->model->topology;
  const double *inverse = m->model->masses.y.inverse;
  const size_t above = zp_upper(t, i), below = zp_lower(t, i);
  double upper = inverse[above], lower = inverse[below], both = upper + lower;
  if (both == 0) return 0;
  double apart = vy[above] - vy[below];
  double lost = (1 - zp_contact_kept_at(&m->model->faces, m->eval->plates.gap[i], i, 1 / both, dt)) * apart;
  double other = (ay[above] - ay[below]) / both - m->eval->faces.push[i];
  vy[above] -= lost * upper / both;
  vy[below] += lost * lower / both;
  return 0.5 * ((apart - lost) + apart) * lost / both + 0.5 * dt * other * lost;
}

/* After a step dt: the loss is the work of the contact force at the mean velocity, and the loss of the damper. Updates
 * the closed length of the state. */
static void damp_faces(ZpPaperMotion *m, double dt) {
  const ZpModel *model = m->model;
  ZpState *state = m->state;
  const ZpTopology *t = &model->topology;
  const ZpNodes at = zp_nodes(model, zp_state_q(model, state)), a = zp_nodes(model, m->a);
  const double *push = m->eval->faces.push;
  double *vy = zp_forces(model, zp_state_v(model, state)).y, *loss = zp_state_ledger(model, state) + m->contact;
  for (size_t i = 1; i < model->nodes; i++) {
    if (!(push[i] > 0)) continue;
    double apart = zp_gap_of(t, vy, i) - 0.5 * dt * zp_gap_of(t, a.y, i);
    *loss -= push[i] * apart * dt;
    *loss += damp(m, i, a.y, dt, vy);
  }
  zp_plates_gaps(&model->plates, at.x, at.y, &m->eval->plates);
  state->zip = zp_eval_touching(model, m->eval->plates.gap);
}

/* -- sequential zipping --------------------------------------------------------------------------- */

static double next_meeting(void *self, const double *q, const double *v, const double *a, double dt) {
  ZpPaperMotion *m = self;
  const ZpModel *model = m->model;
  return zp_zip_next(&m->state->zip, model->nodes, zp_nodes(model, q).y, zp_nodes(model, v).y, zp_nodes(model, a).y, dt,
                     &m->met);
}

/* The rows of the pair that has met act from now on, and a held electric force must be updated. */
static void meet(ZpPaperMotion *m) {
  const ZpModel *model = m->model;
  ZpState *state = m->state;
  ZpForces v = zp_forces(model, zp_state_v(model, state));
  double *loss = zp_state_row(model, state, &zp_row_contact_loss);
  const ZpTie along = zp_tie_of_pair(model, m->met, 0), up = zp_tie_of_pair(model, m->met, 1);
  *loss += zp_tie_join(&along, &model->masses.x, v.x);
  *loss += zp_tie_join(&up, &model->masses.y, v.y);
  state->zip = zp_zip_after(state->zip, model->nodes, m->met);
  state->refreshed = NAN;
}

/* -- a step --------------------------------------------------------------------------------------- */

/* => the largest step allowed, s. */
static double bound_step(ZpPaperMotion *m) {
  const ZpActuatorDef *def = &m->model->def;
  double dt = fmin(m->model->stable_step, m->longest);
  /* Half of the first bound of eq. (9): at the bound itself drag would reverse a velocity without reducing it. Infinite
   * without drag. */
  double drag = 1 / (def->damping.drag * m->eval->drag_rate);
  m->limit = ZP_PAPER_STABILITY;
  if (def->solver.time_step < dt) {
    dt = def->solver.time_step;
    m->limit = ZP_PAPER_ASKED;
  }
  if (drag < dt) {
    dt = drag;
    m->limit = ZP_PAPER_DRAG;
  }
  return dt;
}

static double accelerate(void *self, const double *q, const double *v, double *a) {
  ZpPaperMotion *m = self;
  const ZpModel *model = m->model;
  ZpSpan now = zp_span_of(model, m->state, q, v);
  zp_system_accelerations(model, &now, &model->masses, m->eval, a);
  m->opened = m->state->zip;
  if (is_sequential(model) && m->state->U == 0) m->opened = zp_zip_open(m->opened, model->nodes, zp_nodes(model, a).y);
  const ZpZipState act = is_sequential(model) ? m->state->zip : (ZpZipState){0, false}; /* else the clip's alone */
  zp_ties_share(model, &model->masses, &act, a);
  return bound_step(m);
}

static ZpPaperLimit limit_of(const ZpPaperMotion *m, ZpExplicitLimit limit) {
  if (limit == ZP_EXPLICIT_EVENT) return ZP_PAPER_MEETING;
  return limit == ZP_EXPLICIT_END ? ZP_PAPER_END : m->limit;
}

/* Book the losses of the terms over a step, and keep their state at its end. */
static void book(ZpPaperMotion *m, double dt) {
  const ZpModel *model = m->model;
  ZpState *state = m->state;
  ZpSpan *step = &m->step;
  step->start = step->end = zp_state_q(model, state);
  step->v = zp_state_v(model, state);
  step->memory = zp_state_memory(model, state);
  step->h = dt;
  zp_system_book(model, step, m->eval, state);
  if (model->kept == 0) return;
  memcpy(zp_state_own(model, state) + zp_extra_unknowns(model), m->eval->memory_end, model->kept * sizeof(double));
}

ZpPaperLimit zp_paper_motion_step(ZpPaperMotion *m, ZpState *state, double latest) {
  const ZpModel *model = m->model;
  double *q = zp_state_q(model, state);
  const double *hangs = zp_nodes(model, q).y + zp_load_node(&model->topology);
  double load = zp_state_load(model, state, state->t), before = *hangs;
  ZpExplicitSystem system = {zp_coordinates(model), m, accelerate, is_sequential(model) ? next_meeting : NULL};
  m->state = state;
  ZpExplicitStep taken = zp_explicit_step(&system, latest - state->t, q, zp_state_v(model, state), m->a);
  state->t = taken.limit == ZP_EXPLICIT_END ? latest : state->t + taken.dt;
  book(m, taken.dt);
  state->load_work += load * (before - *hangs);
  if (taken.limit == ZP_EXPLICIT_EVENT)
    meet(m);
  else if (is_sequential(model))
    state->zip = m->opened;
  else if (is_unilateral(model))
    damp_faces(m, taken.dt);
  return limit_of(m, taken.limit);
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const ZpRule rule[] = {
    ZP_MOTION_RULE_IF(EQUATION, ZP_IS(contact.model, ZP_CONTACT_SEQUENTIAL), ZP_HAS(PLATFORM),
                      ZP_IS(solver.integrator, ZP_INTEGRATOR_EXPLICIT), "pairs meet inside the paper's explicit steps"),
    ZP_MOTION_RULE_IF(EQUATION, ZP_IS(electro.surface, ZP_SURFACE_BEZIER), ZP_HAS(PLATFORM),
                      ZP_IS(contact.model, ZP_CONTACT_SEQUENTIAL),
                      "the surface begins at the zip front, and moves in steps of solver.integrator explicit"),
};

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_explicit_steps[] = {&rules, NULL};
