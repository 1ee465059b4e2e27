/* The spring of the load: beside what hangs there it pushes the platforms apart while they are nearer than
 * load.rest_opening, and never pulls. Eq. (27.3). */
#include <math.h>

#include "term/term.h"

static bool acts(const ZpModel *model) {
  return zp_is_pair(&model->topology) && model->def.load.stiffness > 0;
}

/* The spring of one end that the load hangs on, N/m. */
static double stiffness_of(const ZpModel *model) {
  return model->def.load.share * model->def.load.stiffness;
}

/* How far it is compressed at these coordinates, m. */
static double compressed(const ZpModel *model, const double *q) {
  return fmax(model->def.load.rest_opening - zp_opening(&model->topology, q + model->stride), 0);
}

/* Over a span: opening at start and end, and how far it is compressed there, m. */
typedef struct Way {
  double s0, s1, opened;
} Way;

/* It does not end on the way. */
static bool is_even(Way way) {
  return (way.s0 > 0) == (way.s1 > 0);
}

static Way way_of(const ZpModel *model, const ZpSpan *span) {
  const ZpTopology *t = &model->topology;
  double from = zp_opening(t, span->start + model->stride), to = zp_opening(t, span->end + model->stride);
  return (Way){compressed(model, span->start), compressed(model, span->end), to - from};
}

/* The mean push over the way, N: it does the work by which the energy falls. */
static double push_of(const ZpModel *model, Way way) {
  double k = stiffness_of(model);
  if (is_even(way)) return 0.5 * k * (way.s0 + way.s1);
  return 0.5 * k * (way.s0 * way.s0 - way.s1 * way.s1) / way.opened;
}

/* Minus its derivative by the opening at the end, N/m; at rest both ends move. */
static double slope_of(const ZpModel *model, const ZpSpan *span) {
  double k = stiffness_of(model);
  Way way = way_of(model, span);
  if (zp_span_is_still(span)) return way.s1 > 0 ? k : 0;
  if (is_even(way)) return way.s1 > 0 ? 0.5 * k : 0;
  return (push_of(model, way) - k * way.s1) / way.opened;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  const ZpTopology *t = &model->topology;
  double push = span->share * push_of(model, way_of(model, span));
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    F[model->stride + zp_upper(t, i)] += push;
    F[model->stride + zp_lower(t, i)] -= push;
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  (void)e;
  const ZpTopology *t = &model->topology;
  double k = span->share * slope_of(model, span);
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    zp_assemble_heights(assembly, i, k, k, -k, K);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, ZpEnergies *sum) {
  (void)e;
  double s = compressed(model, now->end);
  sum->spring += 0.5 * (double)zp_load_ends(&model->topology) * stiffness_of(model) * s * s;
}

const ZpTerm zp_term_spring = {
    .name = "spring", .acts = acts, .force = force, .stiffness = stiffness, .energy = energy};
