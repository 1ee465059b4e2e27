/* The torsion spring of a hinge turns the first element of the lower ribbon; what clamps the upper one takes its
 * moment. Eqs. (30.1) and (30.2). The angle is positive where that element points downwards. */
#include "math/elementary.h"
#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->hinge.stiffness > 0;
}

/* The first element of the lower ribbon. */
static size_t edge_of(const ZpModel *model) {
  return zp_lower(&model->topology, 0);
}

static double angle_of(const ZpModel *model, const double *q) {
  ZpNodes at = zp_nodes(model, q);
  size_t j = edge_of(model), next = j + model->s;
  return -zp_angle(at.y[next] - at.y[j], at.x[next] - at.x[j]);
}

/* Its mean moment over the span, N m, which closes an open fold. Like the natural curvature of ribbons, its rest angle
 * is applied in step with the weight on the way to an equilibrium. */
static double moment_of(const ZpModel *model, const ZpSpan *span, const ZpEval *e) {
  const ZpHingeParams *hinge = &model->hinge;
  double middle = angle_of(model, span->start) - 0.5 * e->rod_step.turn[edge_of(model)];
  return hinge->stiffness * (middle - span->share * hinge->rest);
}

/* The rod has computed the turn of the element over the span, and the mean derivative of the angle by the element's
 * vector. The work of their moment is exactly the decrease of the energy. */
static void add_moment(const ZpModel *model, const ZpEval *e, double moment, double *F) {
  size_t j = edge_of(model), next = j + model->s;
  double Fx = moment * e->rod_step.gx[j], Fy = moment * e->rod_step.gy[j];
  ZpForces to = zp_forces(model, F);
  to.x[next] += Fx;
  to.y[next] += Fy;
  to.x[j] -= Fx;
  to.y[j] -= Fy;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  add_moment(model, e, moment_of(model, span, e), F);
}

/* The spring of the key and half an element are in series. */
static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  const double k = model->hinge.stiffness, share = k / model->def.hinge.stiffness;
  if (key == ZP_KEY(hinge.stiffness))
    add_moment(model, e, share * share / k * moment_of(model, span, e), F);
  else if (key == ZP_KEY(hinge.rest_angle))
    add_moment(model, e, -k * span->share, F);
  else
    return false;
  return true;
}

/* Minus the derivative of R by the element's vector, eq. (30.3); at rest both ends of the span move. */
static void slope_of(const ZpModel *model, const ZpSpan *span, const ZpEval *e, double D[4]) {
  size_t j = edge_of(model);
  double both = zp_span_is_still(span) ? 2 : 1, gx = e->rod_step.gx[j], gy = e->rod_step.gy[j];
  double turn = 0.5 * both * model->hinge.stiffness, bend = 0.5 * both * moment_of(model, span, e);
  D[0] = turn * gx * gx + 2 * bend * gx * gy;
  D[1] = D[2] = turn * gx * gy + bend * (gy * gy - gx * gx);
  D[3] = turn * gy * gy - 2 * bend * gx * gy;
}

/* The hinge is held: of the element only its right node moves. */
static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  size_t next = edge_of(model) + model->s;
  double D[4];
  slope_of(model, span, e, D);
  for (size_t k = 0; k < 4; k++)
    zp_assemble_entry(assembly, zp_x_of(next) + k / 2, zp_x_of(next) + k % 2, D[k], K);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  (void)e;
  double turned = angle_of(model, now->end) - model->hinge.rest;
  row[0] += 0.5 * model->hinge.stiffness * turned * turned;
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET(hinge.stiffness), ZP_HAS(HINGE), "the other kinds have no hinge"),
    ZP_RULE(PHYSICS, ZP_SET(hinge.rest_angle), ZP_HAS(HINGE), "the other kinds have no hinge"),
    ZP_RULE(PHYSICS, ZP_SET(hinge.rest_angle), ZP_ABOVE(hinge.stiffness, 0),
            "a hinge without a spring has no angle of rest"),
};

const ZpTerm zp_term_hinge = {.name = "hinge",
                              .row = {&zp_row_spring_energy},
                              .acts = acts,
                              .force = force,
                              .stiffness = stiffness,
                              .now = energy,
                              .by_key = by_key,
                              .rules = ZP_RULES_OF(rule)};
