/* The film of liquid between the faces, whose pressures are unknowns of the step. Eqs. (20.1) to (20.5). */
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

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) return;
  double *Fy = F + model->stride;
  zp_film_step(&model->film, e->plates_start.gap, e->plates.gap, span->h, span->own, &e->film);
  for (size_t i = 0; i < model->nodes; i++) {
    Fy[zp_upper(&model->topology, i)] += e->film.force[i];
    Fy[zp_lower(&model->topology, i)] -= e->film.force[i];
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  const ZpFilmParams *film = &model->film;
  if (zp_span_is_still(span)) return;
  for (size_t i = 0; i < model->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      size_t p = ZP_FILM_MODES * i + (size_t)k;
      zp_assemble_own(assembly, p, p, zp_film_own(film, span->h, &e->film, i, k), K);
      if (i + 1 < model->nodes)
        zp_assemble_own(assembly, p, p + ZP_FILM_MODES, zp_film_next(film, span->h, &e->film, i, k), K);
      for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < model->nodes; j++) {
        double by_gap = zp_film_by_gap(film, &e->film, i, j, k);
        zp_assemble_own_by(assembly, p, 2 * zp_upper(&model->topology, j) + 1, -by_gap, K);
        zp_assemble_own_by(assembly, p, 2 * zp_lower(&model->topology, j) + 1, by_gap, K);
      }
    }
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpLosses *sum) {
  sum->viscous += zp_film_loss(&model->film, span->h, span->own, &e->film);
}

const ZpTerm zp_term_film = {
    .name = "film", .acts = acts, .begin = begin, .force = force, .stiffness = stiffness, .loss = loss};
