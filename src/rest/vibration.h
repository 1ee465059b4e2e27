/* The lowest vibrations about an equilibrium, K u = omega^2 m u, by subspace iteration: of one actuator with a banded
 * stiffness and lumped masses, or of several that are joined. If the equilibrium is unstable, squares below 0 come
 * last. docs/theory.md, section 11. */
#ifndef ZP_REST_VIBRATION_H
#define ZP_REST_VIBRATION_H

#include <stdbool.h>

#include "math/arrow.h"

enum { ZP_VIBRATIONS = 24 }; /* a usual number of vectors */

typedef struct ZpVibration {
  size_t n, m;                                            /* equations, vectors iterated */
  const ZpArrow *K;                                       /* factored; belongs to the caller */
  void (*weigh)(void *self, const double *u, double *mu); /* m u, both [n]; NULL: masses are lumped, in `mass` */
  void *self;
  double *mass;            /* [n] by equation, filled by the caller */
  double *weighed;         /* [n] work space */
  double *u, *mu;          /* [m][n] the subspace, with norm 1 in the inner product of the mass; m of it */
  double *next;            /* [m][n] K^-1 m of it */
  double *reduced, *turn;  /* [m][m] the inverse of the stiffness in the subspace, and what diagonalises it */
  double *omega2, *before; /* [m] squares of the angular frequencies, 1/s2, and those of the iteration before */
} ZpVibration;

/* Take the arrays for n equations and at most `most` vectors from `arena`. */
void zp_vibration_reserve(ZpVibration *v, size_t n, size_t most, ZpArena *arena);

/* a' m b, the inner product of the mass. */
double zp_vibration_inner(const ZpVibration *v, const double *a, const double *b);

/* Project `row` onto the complement of `count` rows, which are orthonormal in this inner product. */
void zp_vibration_take_out(const ZpVibration *v, const double *rows, size_t count, double *row);

/* Initial vectors with a component of every mode. */
void zp_vibration_start(ZpVibration *v);

/* One iteration: u => K^-1 m u, then rotated to the best approximations of the modes inside this subspace. */
void zp_vibration_iterate(ZpVibration *v);

/* Residual of mode j after an iteration, eq. (11.2): |u - omega^2 K^-1 m u| in the norm of the mass, with |u| = 1. It
 * bounds the distance of omega^2 from an exact omega_i^2, relative to omega_i^2. Overwrites `next`. */
double zp_vibration_residual(ZpVibration *v, size_t j);

/* Iterate from initial vectors until the first `modes` do not change any more; false if they still do after 200
 * iterations. */
bool zp_vibration_solve(ZpVibration *v, size_t modes);

#endif
