/* The paper's drag, -c |v| v on each particle: at its velocity, or over a span at its mean velocity. Eq. (3.9). */
#include "base/kernel.h"
#include "term/term.h"

#include <math.h>

const ZpRow zp_row_drag_loss = ZP_LOST(drag_loss, "energy lost so far to drag");

static bool acts(const ZpModel *model) {
  return model->def.damping.drag > 0;
}

ZP_KERNEL static void drag(size_t lanes, double c, ZpNodes v, const double *inverse, double *restrict Fx,
                           double *restrict Fy, double *power, double *rate) {
  const double *vx = v.x, *vy = v.y;
  double lost[ZP_LANES] = {0}, fastest[ZP_LANES] = {0};
  for (size_t block = 0; block < lanes; block += ZP_LANES) {
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++) {
      size_t j = block + k;
      double v2 = vx[j] * vx[j] + vy[j] * vy[j], speed = sqrt(v2), per_mass = speed * inverse[j];
      Fx[j] -= c * speed * vx[j];
      Fy[j] -= c * speed * vy[j];
      lost[k] += c * speed * v2;
      fastest[k] = per_mass > fastest[k] ? per_mass : fastest[k];
    }
  }
  *power = zp_sum_lanes(lost);
  *rate = zp_max_lanes(fastest);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  const double *v = span->v;
  ZpForces to = zp_forces(model, F);
  if (!v && !(span->h > 0)) return;
  for (size_t k = 0; !v && k < zp_coordinates(model); k++)
    e->mean_v[k] = (span->end[k] - span->start[k]) / span->h;
  drag(zp_lanes(model), model->def.damping.drag, zp_nodes(model, v ? v : e->mean_v), model->masses.y.inverse, to.x,
       to.y, &e->drag_power, &e->drag_rate);
}

/* Derivative at its present speed; the change with direction is omitted. */
static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  ZpNodes v = zp_nodes(model, e->mean_v);
  for (size_t j = 0; span->h > 0 && j < model->count; j++) {
    double slope = 2 * model->def.damping.drag * sqrt(v.x[j] * v.x[j] + v.y[j] * v.y[j]) / span->h;
    zp_assemble_entry(assembly, zp_x_of(j), zp_x_of(j), slope, K);
    zp_assemble_entry(assembly, zp_y_of(j), zp_y_of(j), slope, K);
  }
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  (void)model;
  row[0] += e->drag_power * span->h;
}

const ZpTerm zp_term_drag = {
    .name = "drag", .row = {&zp_row_drag_loss}, .acts = acts, .force = force, .stiffness = stiffness, .loss = loss};
