/* Cubic Bezier curves in the plane: fit and coefficients. */
#ifndef ZP_PAPER_BEZIER_H
#define ZP_PAPER_BEZIER_H

#include <stddef.h>

/* A cubic in its power form: c[0] + c[1] t + c[2] t^2 + c[3] t^3, 0 <= t <= 1. */
typedef struct ZpCubic {
  double c[4];
} ZpCubic;

/* Power form of the cubic with these Bezier control values. */
ZpCubic zp_bezier_cubic(double p0, double p1, double p2, double p3);

/* Data of a least-squares fit to `count` points at t_i = i / (count - 1): the Bernstein weights B1 = 3 t (1-t)^2 and B2
 * = 3 t^2 (1-t) of each point, and their sums. It depends on `count` only. Each weight is stored twice, so that two
 * curves with interleaved points are summed in one pass. */
typedef struct ZpBezierBasis {
  size_t count;
  double *B1, *B2;           /* [2 * count] */
  double B11, B12, B22;      /* sums of B1 B1, B1 B2, B2 B2 */
  double B10, B13, B20, B23; /* sums of B1 (B0 + B1), B1 (B2 + B3), B2 (B0 + B1), B2 (B2 + B3) */
} ZpBezierBasis;

/* Compute the data for `count` >= 2 points; B1 and B2 have room for twice as many. */
void zp_bezier_basis(ZpBezierBasis *basis, size_t count);

/* Fit a cubic through both end points that starts along d0 and arrives along d3 (unit vectors): the handle lengths a, b
 * minimise the squared distance to the points. `moment` holds the sums over points of B1 x, B1 y, B2 x, B2 y. With
 * fewer than two inner points the handles are a third of the chord. => cubics of x and y. */
void zp_bezier_fit(const ZpBezierBasis *basis, const double moment[4], const double first[2], const double last[2],
                   const double d0[2], const double d3[2], ZpCubic *x, ZpCubic *y);

#endif
