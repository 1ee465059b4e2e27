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

/* One station over a step: mean velocities of its upper and lower node, and of both together at start and end, m/s. */
typedef struct Pair {
  size_t upper, lower;
  double rate[2], Y0, Y1;
  double length; /* m */
} Pair;

static Pair pair_of(const ZpModel *model, const ZpSpan *span, size_t i) {
  const double *from = zp_nodes(model, span->start).y, *to = zp_nodes(model, span->end).y,
               *v0 = zp_nodes(model, span->v0).y;
  Pair pair = {.upper = zp_upper(&model->topology, i),
               .lower = zp_lower(&model->topology, i),
               .length = zp_film_length(&model->film, i)};
  pair.rate[0] = (to[pair.upper] - from[pair.upper]) / span->h;
  pair.rate[1] = (to[pair.lower] - from[pair.lower]) / span->h;
  pair.Y0 = 0.5 * (v0[pair.upper] + v0[pair.lower]);
  pair.Y1 = pair.rate[0] + pair.rate[1] - pair.Y0;
  return pair;
}

static double drag(const ZpModel *model, double length, double v) {
  return -model->outer.drag * model->film.w * length * fabs(v) * v;
}

/* The pair has the momentum M(g) Y'; its kinetic energy also acts on the gap. Together their work is its change. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) return;
  const double *g0 = e->plates_start.gap, *g1 = e->plates.gap;
  double *Fy = zp_forces(model, F).y;
  for (size_t i = 0; i < model->nodes; i++) {
    Pair pair = pair_of(model, span, i);
    double before = zp_outer_pair(&model->outer, g0[i]) * pair.Y0,
           after = zp_outer_pair(&model->outer, g1[i]) * pair.Y1;
    double on_both = -0.5 * pair.length * (after - before) / span->h;
    double on_gap = 0.5 * pair.length * zp_outer_pair_slope(&model->outer, g0[i], g1[i]) * pair.Y0 * pair.Y1;
    Fy[pair.upper] += on_both + on_gap + drag(model, pair.length, pair.rate[0]);
    Fy[pair.lower] += on_both - on_gap + drag(model, pair.length, pair.rate[1]);
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  if (zp_span_is_still(span)) return;
  for (size_t i = 0; i < model->nodes; i++) {
    Pair pair = pair_of(model, span, i);
    double mass = 0.5 * pair.length * zp_outer_pair(&model->outer, e->plates.gap[i]) / (span->h * span->h);
    double per_speed = 2 * model->outer.drag * model->film.w * pair.length / span->h;
    zp_assemble_heights(assembly, i, mass + per_speed * fabs(pair.rate[0]), mass + per_speed * fabs(pair.rate[1]), mass,
                        K);
  }
}

static void inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  (void)span;
  const double *up = zp_nodes(model, a).y;
  double *Fy = zp_forces(model, F).y;
  for (size_t i = 0; i < model->nodes; i++) {
    size_t upper = zp_upper(&model->topology, i), lower = zp_lower(&model->topology, i);
    double mass = zp_film_length(&model->film, i) * zp_outer_pair(&model->outer, e->plates.gap[i]);
    Fy[upper] += 0.25 * mass * (up[upper] + up[lower]);
    Fy[lower] += 0.25 * mass * (up[upper] + up[lower]);
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
    double upper = v[zp_upper(&model->topology, i)], lower = v[zp_lower(&model->topology, i)],
           Y = 0.5 * (upper + lower);
    double sides = zp_outer_side(&model->outer) * (upper * upper + lower * lower);
    row[STORED] +=
        0.5 * zp_film_length(&model->film, i) * (sides + zp_outer_pair(&model->outer, e->plates.gap[i]) * Y * Y);
  }
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  (void)e;
  for (size_t i = 0; i < model->nodes; i++) {
    Pair pair = pair_of(model, span, i);
    for (int k = 0; k < 2; k++)
      row[DRAG] -= span->h * pair.rate[k] * drag(model, pair.length, pair.rate[k]);
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
