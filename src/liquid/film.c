#include "liquid/film.h"

#include <math.h>

void zp_film_modes(ZpFilmParams *p, bool lateral_flow) {
  static const double lowest = 0.81056946913870217, pi2 = 9.8696044010893586,
                      others = 157.141777614258; /* 8 / pi^2; a_1 / (1/12 - a_0 / pi^2) */
  double w2 = p->w * p->w;
  p->share[0] = lateral_flow ? lowest : 1;
  p->share[1] = 1 - p->share[0];
  p->kappa2[0] = lateral_flow ? pi2 / w2 : 0;
  p->kappa2[1] = lateral_flow ? others / w2 : 0;
  p->outlet = !lateral_flow;
}

void zp_film_carve(const ZpFilmParams *p, ZpFilmEval *e, ZpCarver *carver) {
  double **arrays[] = {&e->H, &e->rate, &e->secant, &e->force, &e->mean, &e->rise};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_carve(carver, p->nodes);
  e->r = zp_carve(carver, ZP_FILM_MODES * p->nodes);
}

/* A smooth step from g, far above the roughness, to nothing, far below 0. */
static double root(const ZpFilmParams *p, double gap) {
  return sqrt(gap * gap + 4 * p->roughness * p->roughness);
}

double zp_film_thickness(const ZpFilmParams *p, double gap) {
  double S = root(p, gap);
  return gap > 0 ? 0.5 * (gap + S) : S > gap ? 2 * p->roughness * p->roughness / (S - gap) : 0;
}

/* How the thickness in the middle is foreseen: it goes on as in the last step, but halves at most. */
static double middle(const ZpFilmParams *p, double gap, double rate, double h) {
  double H = zp_film_thickness(p, gap), foreseen = zp_film_thickness(p, gap + 0.5 * h * rate);
  return fmax(foreseen, 0.5 * H);
}

/* H^3 between stations i and i + 1. */
static double mobility(const ZpFilmEval *e, size_t i) {
  double H = 0.5 * (e->H[i] + e->H[i + 1]);
  return H * H * H;
}

/* Does mode k have an equation at station i? */
static bool is_free(const ZpFilmParams *p, size_t i, int k) {
  return p->share[k] > 0 && !(p->outlet && i + 1 == p->nodes);
}

/* What flows away from station i in mode k, over w and 12 mu, m^2 Pa. */
static double outflow(const ZpFilmParams *p, const double *pressure, const ZpFilmEval *e, size_t i, int k) {
  const double *at = pressure + ZP_FILM_MODES * i + k;
  double sum = zp_film_length(p, i) * p->kappa2[k] * e->H[i] * e->H[i] * e->H[i] * at[0];
  if (i > 0) sum += mobility(e, i - 1) * (at[0] - at[-ZP_FILM_MODES]) / p->l;
  if (i + 1 < p->nodes) sum += mobility(e, i) * (at[0] - at[ZP_FILM_MODES]) / p->l;
  return sum;
}

/* The integral of what is linear between stations over the cell of station i: half of each element beside it. */
static double over_cells(const ZpFilmParams *p, const double *x, size_t i) {
  double sum = zp_film_cell(p, i, i) * x[i];
  if (i > 0) sum += zp_film_cell(p, i, i - 1) * x[i - 1];
  if (i + 1 < p->nodes) sum += zp_film_cell(p, i, i + 1) * x[i + 1];
  return sum;
}

void zp_film_step(const ZpFilmParams *p, const double *g0, const double *g1, double h, const double *pressure,
                  const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    double both = root(p, g0[i]) + root(p, g1[i]);
    e->H[i] = middle(p, g0[i], e->rate[i], h);
    e->secant[i] = both > 0 ? 0.5 * (1 + (g0[i] + g1[i]) / both) : 0.5;
  }
  for (size_t i = 0; i < p->nodes; i++)
    e->mean[i] = p->share[0] * pressure[ZP_FILM_MODES * i] + p->share[1] * pressure[ZP_FILM_MODES * i + 1];
  for (size_t i = 0; i < p->nodes; i++)
    e->force[i] = p->w * e->secant[i] * over_cells(p, e->mean, i);
  for (size_t i = 0; i < p->nodes; i++)
    e->rise[i] = e->secant[i] * (g1[i] - g0[i]);
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      double grown = over_cells(p, e->rise, i), flows = outflow(p, pressure, e, i, k);
      e->r[ZP_FILM_MODES * i + (size_t)k] = is_free(p, i, k) ? p->share[k] * p->w * (grown + h / (12 * p->mu) * flows)
                                                             : -pressure[ZP_FILM_MODES * i + (size_t)k];
    }
}

double zp_film_loss(const ZpFilmParams *p, double h, const double *pressure, const ZpFilmEval *e) {
  double sum = 0;
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++)
      if (is_free(p, i, k))
        sum += p->share[k] * pressure[ZP_FILM_MODES * i + (size_t)k] * outflow(p, pressure, e, i, k);
  return sum * h * p->w / (12 * p->mu);
}

double zp_film_own(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k) {
  if (!is_free(p, i, k)) return 1;
  double sum = zp_film_length(p, i) * p->kappa2[k] * e->H[i] * e->H[i] * e->H[i];
  if (i > 0) sum += mobility(e, i - 1) / p->l;
  if (i + 1 < p->nodes) sum += mobility(e, i) / p->l;
  return -p->share[k] * h * p->w / (12 * p->mu) * sum;
}

double zp_film_next(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k) {
  if (!is_free(p, i, k) || !is_free(p, i + 1, k)) return 0;
  return p->share[k] * h * p->w / (12 * p->mu) * mobility(e, i) / p->l;
}

double zp_film_by_gap(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, size_t j, int k) {
  return is_free(p, i, k) ? p->share[k] * p->w * zp_film_cell(p, i, j) * e->secant[j] : 0;
}
