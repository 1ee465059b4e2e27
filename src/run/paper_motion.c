#include "run/paper_motion.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "def/rule.h"

static const ZpZipState clip_only = {0, false};

static bool is_sequential(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_SEQUENTIAL;
}

static bool is_unilateral(const ZpModel *model) {
  return model->field && model->def.contact.model == ZP_CONTACT_UNILATERAL;
}

bool zp_paper_motion_create(const ZpModel *model, ZpEval *eval, ZpPaperMotion *motion) {
  *motion = (ZpPaperMotion){.model = model, .eval = eval, .longest = INFINITY};
  motion->contact = zp_row_number(&model->ledger, &zp_row_contact_loss);
  motion->a = zp_calloc(2 * model->stride, sizeof *motion->a);
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
  const double *inverse = m->model->masses.y.inverse;
  double upper = inverse[2 * i], lower = inverse[2 * i + 1], both = upper + lower;
  if (both == 0) return 0;
  double apart = vy[2 * i] - vy[2 * i + 1];
  double lost = (1 - zp_contact_kept_at(&m->model->faces, m->eval->plates.gap[i], i, 1 / both, dt)) * apart;
  double other = (ay[2 * i] - ay[2 * i + 1]) / both - m->eval->faces.push[i];
  vy[2 * i] -= lost * upper / both;
  vy[2 * i + 1] += lost * lower / both;
  return 0.5 * ((apart - lost) + apart) * lost / both + 0.5 * dt * other * lost;
}

/* After a step dt: the loss is the work of the contact force at the mean velocity, and the loss of the damper. Updates
 * the closed length of the state. */
static void damp_faces(ZpPaperMotion *m, double dt) {
  const ZpModel *model = m->model;
  ZpState *state = m->state;
  const double *x = zp_state_q(model, state), *y = x + model->stride, *ay = m->a + model->stride;
  const double *push = m->eval->faces.push;
  double *vy = zp_state_v(model, state) + model->stride, *loss = zp_state_ledger(model, state) + m->contact;
  for (size_t i = 1; i < model->nodes; i++) {
    if (!(push[i] > 0)) continue;
    double apart = vy[2 * i] - vy[2 * i + 1] - 0.5 * dt * (ay[2 * i] - ay[2 * i + 1]);
    *loss -= push[i] * apart * dt;
    *loss += damp(m, i, ay, dt, vy);
  }
  zp_plates_gaps(&model->plates, x, y, &m->eval->plates);
  state->zip = zp_eval_touching(model, m->eval->plates.gap);
}

/* -- sequential zipping --------------------------------------------------------------------------- */

static double next_meeting(void *self, const double *q, const double *v, const double *a, double dt) {
  ZpPaperMotion *m = self;
  size_t stride = m->model->stride;
  return zp_zip_next(&m->state->zip, m->model->nodes, q + stride, v + stride, a + stride, dt, &m->met);
}

/* The pair that has met moves as one from now on, and a held electric force must be updated. */
static void meet(ZpPaperMotion *m) {
  const ZpModel *model = m->model;
  ZpState *state = m->state;
  double *v = zp_state_v(model, state), *loss = zp_state_row(model, state, &zp_row_contact_loss);
  *loss += zp_zip_merge(m->met, &model->masses.x, v);
  *loss += zp_zip_merge(m->met, &model->masses.y, v + model->stride);
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
  if (is_sequential(model) && m->state->U == 0) m->opened = zp_zip_open(m->opened, model->nodes, a + model->stride);
  zp_eval_share(model, &model->masses, is_unilateral(model) ? &clip_only : &m->state->zip, a);
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
  double *q = zp_state_q(model, state), *hangs = q + model->stride + zp_load_node(&model->topology);
  double load = zp_state_load(model, state, state->t), before = *hangs;
  ZpExplicitSystem system = {2 * model->stride, m, accelerate, is_sequential(model) ? next_meeting : NULL};
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
