/* The lowest vibrations about a state of rest, K u = omega^2 m u, by subspace iteration: of one actuator with a banded
 * stiffness and lumped masses, of several with what joins them. Of a state that is not stable the squares below 0 come
 * last. docs/theory.md, section 11. */
#ifndef ZP_REST_VIBRATION_H
#define ZP_REST_VIBRATION_H

#include <stdbool.h>

#include "math/band.h"

enum { ZP_VIBRATIONS = 24 }; /* most */

/* What vibrates where it is not one actuator. */
typedef struct ZpVibrating {
  void (*weigh)(const void *self, const double *u, double *mu); /* m u; all [n] */
  void (*solve)(const void *self, double *f);                   /* K^-1 f, in place */
  const void *self;
} ZpVibrating;

typedef struct ZpVibration {
  size_t n, m;             /* equations, vectors iterated */
  const ZpBand *K;         /* factored; the caller's */
  const ZpVibrating *many; /* in place of K and mass; NULL: one actuator */
  double *mass;            /* [n] by equation, for the caller to fill */
  double *weighed;         /* [n] work space */
  double *u, *next;        /* [m][n] the subspace, of length 1 in the mass's measure; K^-1 m of it */
  double reduced[ZP_VIBRATIONS * ZP_VIBRATIONS], turn[ZP_VIBRATIONS * ZP_VIBRATIONS];
  double omega2[ZP_VIBRATIONS];
} ZpVibration;

/* Cut the arrays for n equations and at most `most` vectors from `carver`. */
void zp_vibration_carve(ZpVibration *v, size_t n, size_t most, ZpCarver *carver);

/* a' m b, the measure of the mass. */
double zp_vibration_inner(const ZpVibration *v, const double *a, const double *b);

/* Take out of `row` what it has of `count` rows that are orthogonal and of length 1 in that measure. */
void zp_vibration_take_out(const ZpVibration *v, const double *rows, size_t count, double *row);

/* A start that has a part of every mode. */
void zp_vibration_start(ZpVibration *v);

/* One round: u => K^-1 m u, then turned to the best approximations of the modes inside that subspace. */
void zp_vibration_iterate(ZpVibration *v);

/* Residual of mode j after a round, eq. (11.2): |u - omega^2 K^-1 m u| in the mass's measure, relative to |u| = 1. An
 * exact omega_i^2 lies no further from omega^2 than this part of itself. Overwrites `next`. */
double zp_vibration_residual(ZpVibration *v, size_t j);

/* From a start until the first `modes` no longer change; false if they do after 200 rounds. */
bool zp_vibration_solve(ZpVibration *v, size_t modes);

#endif
