/* The paper's attraction on a Bezier curve through the free stations, section 4.4; at an instant only. */
#include <math.h>

#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->field && model->def.electro.surface == ZP_SURFACE_BEZIER;
}

/* Direction of the end of the closed part: that of the last closed link, horizontal at the clip. */
static void closed_direction(const ZpModel *model, size_t front, const ZpEdges *edges, double direction[2]) {
  direction[0] = 1;
  direction[1] = 0;
  if (front == 0) return;
  size_t j = model->s * (front - 1);
  double x = edges->ux[j] + edges->ux[j + 1], y = edges->uy[j] + edges->uy[j + 1];
  double length = sqrt(x * x + y * y);
  if (length == 0) return;
  direction[0] = x / length;
  direction[1] = y / length;
}

void zp_bezier_attract(const ZpModel *model, const ZpState *state, const double *q, ZpEval *e) {
  size_t front = state->zip.front;
  if (front + 1 < model->nodes) zp_surface_prepare(&e->surface, model->nodes - front);
  double direction[2];
  closed_direction(model, front, &e->edges, direction);
  zp_surface_bezier(&model->plates, &e->surface, q, zp_nodes(model, q).y, front, direction, state->U, e->attraction.Fy);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (!span->paper) return;
  const double *Fy = zp_nodes(model, zp_held_force(model, span->paper)).y;
  if (!(model->def.electro.refresh_period > 0)) {
    zp_bezier_attract(model, span->paper, span->end, e);
    Fy = e->attraction.Fy;
  }
  zp_term_add(model, e->none, Fy, F);
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ABOVE(electro.switch_offset, 0), ZP_IS(electro.surface, ZP_SURFACE_BEZIER),
            "it is the breakdown switch of the paper's surface"),
    ZP_RULE(PHYSICS, ZP_ABOVE(electro.refresh_period, 0), ZP_IS(electro.surface, ZP_SURFACE_BEZIER),
            "the forces on the polyline are never held"),
};

const ZpTerm zp_term_bezier = {.name = "bezier", .acts = acts, .force = force, .rules = ZP_RULES_OF(rule)};
