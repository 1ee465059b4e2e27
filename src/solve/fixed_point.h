/* A fixed point of a map x -> G(x) that is dear to evaluate: Anderson's acceleration. From the last few pairs (x, G(x))
 * it foresees where G(x) - x would be 0 if the map were linear between them. The first unknowns decide; the others are
 * only carried along, by the same combination. Knows no physics. */
#ifndef ZP_SOLVE_FIXED_POINT_H
#define ZP_SOLVE_FIXED_POINT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

enum { ZP_FIXED_POINT_DEPTH = 28 };

typedef struct ZpFixedPoint {
  size_t n, judged;                      /* unknowns; how many of them, the first, decide */
  int pairs;                             /* differences that are known */
  double *x, *left;                      /* [n] of the last pair: x and G(x) - x */
  double *moved[ZP_FIXED_POINT_DEPTH];   /* [n] differences of G(x) between pairs, the newest first */
  double *changed[ZP_FIXED_POINT_DEPTH]; /* [n] and of G(x) - x */
  double *q[ZP_FIXED_POINT_DEPTH];       /* [judged] work space: changed, made orthogonal */
  double *rest;                          /* [judged] work space */
} ZpFixedPoint;

/* Cut the arrays for n unknowns, of which the first `judged` decide, from `arena`. */
void zp_fixed_point_reserve(ZpFixedPoint *f, size_t n, size_t judged, ZpArena *arena);

/* (x, G(x)) => next [n], where to try it next; `next` may not be one of both. Those that decide are in like units. */
void zp_fixed_point_next(ZpFixedPoint *f, const double *x, const double *mapped, double *next);

/* Forget all pairs: the map has become another. */
void zp_fixed_point_forget(ZpFixedPoint *f);

#endif
