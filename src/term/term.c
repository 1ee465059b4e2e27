#include "term/term.h"

#include <math.h>

#include "base/kernel.h"

/* Over a step the wet length is that predicted for its middle: it changes as in the last step, by an element at
 * most. */
static double reach_in_middle(const ZpModel *model, const ZpBead *bead, double h) {
  double moved = fmin(fmax(0.5 * h * bead->rate, -model->l), model->l);
  return fmin(fmax(bead->reach + moved, 0), zp_bead_longest(&model->film));
}

void zp_term_gaps(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  ZpNodes at = zp_nodes(model, span->end);
  zp_plates_gaps(&model->plates, at.x, at.y, &e->plates);
  if (!model->has_bead) return;
  for (int half = 0; span->bead && half < ZP_BEADS; half++)
    e->reach[half] = reach_in_middle(model, &span->bead[half], span->h);
  if (!span->bead) zp_eval_reach(model, e->plates.gap, NULL, e->reach);
  zp_eval_cover(model, e->reach, e);
}

double zp_term_level(const ZpModel *model, const ZpBeadPlace *end, const double *x) {
  const ZpTopology *t = &model->topology;
  if (end->near == end->far) return 1;
  double along =
      x[zp_upper(t, end->far)] - x[zp_upper(t, end->near)] + x[zp_lower(t, end->far)] - x[zp_lower(t, end->near)];
  return (end->near < end->far ? along : -along) / (2 * model->film.l);
}

double zp_term_electric_head(const ZpModel *model, double suction, double U, double g, double H) {
  double released = zp_plates_law(&model->air, U, g).P - zp_plates_law(&model->plates, U, g).P;
  return -suction * released / (model->film.w * H);
}

double zp_term_meniscus_head(const ZpModel *model, double suction, double U, double g, double H, double level) {
  double head = level * zp_term_electric_head(model, suction, U, g, H) - 2 * suction * model->bead.tension / H;
  return fmax(head, -zp_film_tension);
}

ZpRoom zp_term_meniscus_room(const ZpModel *model, double reach) {
  static const double usual = 100e-6, of_length = 1e-2; /* m: short beside a ribbon, and long enough to be found */
  const double last = fmin(usual, of_length * model->L);
  double share = (zp_bead_longest(&model->film) - reach) / last;
  return share < 1 ? (ZpRoom){share, -1 / last} : (ZpRoom){1, 0};
}

ZP_KERNEL static void add(size_t lanes, const double *Gx, const double *Gy, double *restrict Fx, double *restrict Fy) {
  ZP_SIMD
  for (size_t j = 0; j < lanes; j++) {
    Fx[j] += Gx[j];
    Fy[j] += Gy[j];
  }
}

void zp_term_add(const ZpModel *model, const double *Gx, const double *Gy, double *F) {
  ZpForces to = zp_forces(model, F);
  add(zp_lanes(model), Gx, Gy, to.x, to.y);
}

ZP_KERNEL static void add_edges(size_t lanes, size_t s, const double *Rx, const double *Ry, double *restrict Fx,
                                double *restrict Fy) {
  const double *Lx = Rx - s, *Ly = Ry - s;
  ZP_SIMD
  for (size_t j = 0; j < lanes; j++) {
    Fx[j] += Lx[j] - Rx[j];
    Fy[j] += Ly[j] - Ry[j];
  }
}

double zp_term_edges_loss(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  ZpNodes at = zp_nodes(model, span->end);
  zp_rod_eval(&model->rod, at.x, at.y, &e->rod);
  return zp_rod_step_loss(&model->rod, &e->rod_start, &e->rod, zp_span_damping(model, span));
}

void zp_term_add_edges(const ZpModel *model, const double *Rx, const double *Ry, double *F) {
  ZpForces to = zp_forces(model, F);
  add_edges(zp_lanes(model), model->s, Rx, Ry, to.x, to.y);
}

const ZpRules *const zp_rules_of_terms[] = {
#define ZP_TERM(name) &zp_term_##name.rules,
#include "term/terms.def"
#undef ZP_TERM
    NULL};
