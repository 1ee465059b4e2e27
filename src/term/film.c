/* The film of liquid between the faces, whose heads are unknowns of the step. Eqs. (22.1) to (22.11). */
#include "term/term.h"

static bool acts(const ZpModel *model) {
  return model->has_film;
}

/* Gaps go on as they did over the last step. */
static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  for (size_t i = 0; i < model->nodes; i++) {
    const double *w = span->w ? span->w + model->stride : NULL;
    e->film.rate[i] = w ? w[zp_upper(&model->topology, i)] - w[zp_lower(&model->topology, i)] : 0;
  }
}

static void solve_step(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  zp_film_step(&model->film, e->plates_start.gap, e->plates.gap, span->h, span->memory, span->own, &e->film);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) return;
  double *Fy = F + model->stride;
  solve_step(model, span, e);
  for (size_t i = 0; i < model->nodes; i++) {
    Fy[zp_upper(&model->topology, i)] += e->film.force[i];
    Fy[zp_lower(&model->topology, i)] -= e->film.force[i];
  }
}

static void by_heads(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, const ZpFilmEval *e,
                     size_t i, ZpBand *K) {
  const ZpFilmParams *film = &model->film;
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t p = ZP_FILM_MODES * i + (size_t)k;
    for (int m = k; m < ZP_FILM_MODES; m++)
      zp_assemble_own(assembly, p, ZP_FILM_MODES * i + (size_t)m, zp_film_own(film, span->h, e, i, k, m), K);
    if (i + 1 < model->nodes) zp_assemble_own(assembly, p, p + ZP_FILM_MODES, zp_film_next(film, span->h, e, i, k), K);
  }
}

/* How the force goes with the head is how the volume goes with the gap, sign turned. What convection adds, which would
 * be of one sign there and of the other here, is left out. */
static void by_gaps(const ZpModel *model, const ZpAssembly *assembly, const ZpFilmEval *e, size_t i, ZpBand *K) {
  for (int k = 0; k < ZP_FILM_MODES; k++)
    for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < model->nodes; j++) {
      double by_gap = zp_film_by_gap(&model->film, e, i, j, k);
      size_t p = ZP_FILM_MODES * i + (size_t)k;
      zp_assemble_own_by(assembly, p, 2 * zp_upper(&model->topology, j) + 1, -by_gap, K);
      zp_assemble_own_by(assembly, p, 2 * zp_lower(&model->topology, j) + 1, by_gap, K);
    }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  if (zp_span_is_still(span)) return;
  for (size_t i = 0; i < model->nodes; i++) {
    by_heads(model, span, assembly, &e->film, i, K);
    by_gaps(model, assembly, &e->film, i, K);
  }
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, ZpEnergies *sum) {
  zp_plates_gaps(&model->plates, now->end, now->end + model->stride, &e->plates);
  sum->liquid += zp_film_energy(&model->film, e->plates.gap, now->memory);
}

/* The heads have been corrected since the last force. */
static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpLosses *sum) {
  solve_step(model, span, e);
  ZpFilmLoss lost = zp_film_loss(&model->film, span->h, span->memory, &e->film);
  sum->along += lost.along;
  sum->across += lost.across;
  sum->jets += lost.jets;
}

/* What resists to a change of the gap: not more than where all flows across. */
static void inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  for (size_t i = 0; i < model->nodes; i++) {
    size_t upper = zp_upper(&model->topology, i) + model->stride, lower = zp_lower(&model->topology, i) + model->stride;
    double push = zp_film_inertia(&model->film, span->h, &e->film, i) * (a[upper] - a[lower]);
    F[upper] += push;
    F[lower] -= push;
  }
}

const ZpTerm zp_term_film = {.name = "film",
                             .acts = acts,
                             .begin = begin,
                             .force = force,
                             .stiffness = stiffness,
                             .inertia = inertia,
                             .energy = energy,
                             .loss = loss};
