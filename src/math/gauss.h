/* Gauss's three points on [0, 1]: exact for polynomials of degree 5. One table for all that is integrated inside
 * elements, so that what must balance there, attraction and contact, does so point by point. */
#ifndef ZP_MATH_GAUSS_H
#define ZP_MATH_GAUSS_H

#include "math/level.h"

enum { GAUSS = 3 };
static const double gauss_at[GAUSS] = {0.11270166537925831, 0.5, 0.88729833462074169};
static const double gauss_weight[GAUSS] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/* 6/5 of the square of gauss_at, and 1 less that of the distance from the right station. */
static const double gauss_level_left[GAUSS] = {0.015241998455109974, 0.3, 0.94475800154489};
static const double gauss_level_right[GAUSS] = {0.05524199845510997, 0.7, 0.98475800154489};

/* The share of its right station in what is sampled at each point of an element. */
static inline const double *zp_gauss_shares(const ZpLevelEnds *ends, size_t element) {
  for (size_t k = 0; k < ends->count; k++)
    if (ends->of[k].element == element) return ends->of[k].right ? gauss_level_right : gauss_level_left;
  return gauss_at;
}

/* Share at x where a line with a level end at its left or right station begins or ends inside an element, 0 .. 1. */
static inline double zp_gauss_share(const ZpLevelEnds *ends, size_t element, double x) {
  for (size_t k = 0; k < ends->count; k++)
    if (ends->of[k].element == element) return ends->of[k].right ? 1 - 1.2 * (1 - x) * (1 - x) : 1.2 * x * x;
  return x;
}

#endif
