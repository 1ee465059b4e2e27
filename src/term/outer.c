/* The liquid outside the gap of submerged ribbons. The mass that each outer face moves is in the masses of the nodes
 * (along y only). This term has the mass that the pair moves in addition, and the form drag. Eqs. (22.12) to
 * (22.14). */
#include <math.h>

#include "term/term.h"

const ZpRow zp_row_outer_drag_loss =
    ZP_LOST(outer_drag_loss, "energy lost so far to the form drag of the liquid outside the gap");

enum { STORED, DRAG };

static bool acts(const ZpModel *model) {
  return model->has_film && (model->outer.rho > 0 || model->outer.drag > 0);
}

/* One station over a step: its faces that have liquid outside, one of each ribbon; their mean velocities, and the
 * velocity of both together at start and end, m/s. A counter electrode holds the liquid on its side of the gap. */
typedef struct Faces {
  size_t count, node[2]; /* upper and lower, or the only one */
  double rate[2], Y0, Y1;
  double length; /* m */
} Faces;

static Faces faces_at(const ZpModel *model, size_t i) {
  return (Faces){.count = model->s,
                 .node = {zp_upper(&model->topology, i), zp_lower(&model->topology, i)},
                 .length = zp_film_length(&model->film, i)};
}

static Faces faces_over(const ZpModel *model, const ZpSpan *span, size_t i) {
  const double *from = zp_nodes(model, span->start).y, *to = zp_nodes(model, span->end).y,
               *v0 = zp_nodes(model, span->v0).y;
  Faces of = faces_at(model, i);
  for (size_t k = 0; k < of.count; k++)
    of.rate[k] = (to[of.node[k]] - from[of.node[k]]) / span->h;
  of.Y0 = 0.5 * (v0[of.node[0]] + v0[of.node[1]]);
  of.Y1 = of.rate[0] + of.rate[1] - of.Y0;
  return of;
}

/* Liquid that a pair moves beyond that of its faces, kg/m. */
static double moved_by_both(const ZpModel *model, double gap) {
  return model->s == 2 ? zp_outer_pair(&model->outer, gap) : 0;
}

static double drag(const ZpModel *model, double length, double v) {
  return -model->outer.drag * model->film.w * length * fabs(v) * v;
}

/* The pair has the momentum M(g) Y'; its kinetic energy also acts on the gap. Together their work is its change.
 * => force on each face, N. */
static void push_pair(const ZpModel *model, const ZpSpan *span, const Faces *of, double g0, double g1, double push[2]) {
  double before = zp_outer_pair(&model->outer, g0) * of->Y0, after = zp_outer_pair(&model->outer, g1) * of->Y1;
  double on_both = -0.5 * of->length * (after - before) / span->h;
  double on_gap = 0.5 * of->length * zp_outer_pair_slope(&model->outer, g0, g1) * of->Y0 * of->Y1;
  push[0] = on_both + on_gap;
  push[1] = on_both - on_gap;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) return;
  double *Fy = zp_forces(model, F).y;
  for (size_t i = 0; i < model->nodes; i++) {
    Faces of = faces_over(model, span, i);
    double push[2] = {0, 0};
    if (of.count == 2) push_pair(model, span, &of, e->plates_start.gap[i], e->plates.gap[i], push);
    for (size_t k = 0; k < 2 && k < of.count; k++)
      Fy[of.node[k]] += push[k] + drag(model, of.length, of.rate[k]);
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  if (zp_span_is_still(span)) return;
  for (size_t i = 0; i < model->nodes; i++) {
    Faces of = faces_over(model, span, i);
    double mass = 0.5 * of.length * moved_by_both(model, e->plates.gap[i]) / (span->h * span->h);
    double per_speed = 2 * model->outer.drag * model->film.w * of.length / span->h;
    double upper = of.count == 2 ? mass + per_speed * fabs(of.rate[0]) : 0;
    zp_assemble_heights(assembly, i, upper, mass + per_speed * fabs(of.rate[of.count - 1]), mass, K);
  }
}

static void inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  (void)span;
  const double *up = zp_nodes(model, a).y;
  double *Fy = zp_forces(model, F).y;
  for (size_t i = 0; i < model->nodes; i++) {
    Faces of = faces_at(model, i);
    double mass = of.length * moved_by_both(model, e->plates.gap[i]);
    for (size_t k = 0; k < of.count; k++)
      Fy[of.node[k]] += 0.25 * mass * (up[of.node[0]] + up[of.node[1]]);
  }
}

void zp_term_add_outside(const ZpModel *model, const ZpEval *e, const double *a, double *F) {
  const double *up = zp_nodes(model, a).y;
  double *Fy = zp_forces(model, F).y;
  inertia(model, NULL, e, a, F);
  for (size_t j = 0; j < model->count; j++)
    Fy[j] += zp_outer_side(&model->outer) * zp_film_length(&model->film, j / model->s) * up[j];
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  const double *v = zp_nodes(model, now->v).y;
  zp_plates_gaps(&model->plates, now->end, zp_nodes(model, now->end).y, &e->plates);
  for (size_t i = 0; i < model->nodes; i++) {
    Faces of = faces_at(model, i);
    double Y = 0.5 * (v[of.node[0]] + v[of.node[1]]), squares = 0;
    for (size_t k = 0; k < of.count; k++)
      squares += v[of.node[k]] * v[of.node[k]];
    double sides = zp_outer_side(&model->outer) * squares;
    row[STORED] += 0.5 * of.length * (sides + moved_by_both(model, e->plates.gap[i]) * Y * Y);
  }
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  (void)e;
  for (size_t i = 0; i < model->nodes; i++) {
    Faces of = faces_over(model, span, i);
    for (size_t k = 0; k < of.count; k++)
      row[DRAG] -= span->h * of.rate[k] * drag(model, of.length, of.rate[k]);
  }
}

const ZpTerm zp_term_outer = {.name = "outer",
                              .row = {[STORED] = &zp_row_liquid_energy, [DRAG] = &zp_row_outer_drag_loss},
                              .acts = acts,
                              .force = force,
                              .stiffness = stiffness,
                              .inertia = inertia,
                              .now = energy,
                              .loss = loss};
