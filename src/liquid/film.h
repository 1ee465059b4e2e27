/* The film of liquid between two faces: lubrication, its pressure as unknowns. docs/theory.md, section 20.
 *
 * Letters: g gap of a station, m; H thickness of the film, g with a floor of the roughness, m; p pressure, Pa; s length
 * along the ribbon, m; mu viscosity, Pa s; w width, m. Across the width the pressure has two modes,
 *   d_s(H^3 d_s p_k) - kappa_k^2 H^3 p_k = 12 mu dH/dt,     mean pressure a_0 p_0 + a_1 p_1,
 * of which the first is the exact lowest one and the second all others. Over a step the film resists with a mobility
 * H^3 of its middle, foreseen, so that it is linear in what it resists to, and can only dissipate. */
#ifndef ZP_LIQUID_FILM_H
#define ZP_LIQUID_FILM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

enum { ZP_FILM_MODES = 2 };

typedef struct ZpFilmParams {
  size_t nodes;                 /* N stations */
  double l;                     /* element length, m */
  double end_length;            /* of flat faces beyond the last station, at its gap, m */
  double w, mu;                 /* width, m; viscosity, Pa s */
  double roughness;             /* thickness where g is 0, m; 0: none */
  double share[ZP_FILM_MODES];  /* a_k */
  double kappa2[ZP_FILM_MODES]; /* kappa_k^2, 1/m^2; 0: nothing flows out at the long edges */
  bool outlet;                  /* the pressure at the last station is 0 */
} ZpFilmParams;

/* Both modes of a strip of that width; without lateral flow one mode, and an outlet at the last station. */
void zp_film_modes(ZpFilmParams *params, bool lateral_flow);

/* Of a step; p [2 i + k] is mode k at station i. */
typedef struct ZpFilmEval {
  double *H;      /* [N] thickness in the middle of the step, foreseen, m */
  double *rate;   /* [N] at which the gaps changed over the last step, m/s */
  double *secant; /* [N] (H1 - H0) / (g1 - g0) */
  double *mean;   /* [N] mean pressure across the width, Pa */
  double *rise;   /* [N] H1 - H0, m */
  double *force;  /* [N] on each station, N, positive opens */
  double *r;      /* [2 N] what is left of the volume's balance, times its share of the width, m^3 */
} ZpFilmEval;

void zp_film_carve(const ZpFilmParams *params, ZpFilmEval *eval, ZpCarver *carver);

/* Thickness at a gap, which may be below 0 by rounding and contact, m. */
double zp_film_thickness(const ZpFilmParams *params, double gap);

/* (gaps at both ends of a step of h, pressures) => all of eval, with eval->rate as it is. */
void zp_film_step(const ZpFilmParams *params, const double *g0, const double *g1, double h, const double *p,
                  const ZpFilmEval *eval);

/* What the film dissipates over that step, J: lateral flow and all. */
double zp_film_loss(const ZpFilmParams *params, double h, const double *p, const ZpFilmEval *eval);

/* Length of the film at station i, m. */
static inline double zp_film_length(const ZpFilmParams *p, size_t i) {
  return (i == 0 || i + 1 == p->nodes ? 0.5 : 1) * p->l + (i + 1 == p->nodes ? p->end_length : 0);
}

/* What the thickness at station j, i - 1 .. i + 1, counts in the cell of station i, m: half of each element beside it.
 */
static inline double zp_film_cell(const ZpFilmParams *p, size_t i, size_t j) {
  if (i != j) return p->l / 8;
  return (i == 0 || i + 1 == p->nodes ? 1 : 2) * 3 * p->l / 8 + (i + 1 == p->nodes ? p->end_length : 0);
}

/* Derivative of r of mode k at station i by the gap of station j, i - 1 .. i + 1, at the end, as far as it goes with
 * the pressure's force; m^2. */
double zp_film_by_gap(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i, size_t j, int k);

/* Derivatives of -r of mode k: by its own pressure at station i, and by that of the next one, m^3/Pa. */
double zp_film_own(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i, int k);
double zp_film_next(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i, int k);

#endif
