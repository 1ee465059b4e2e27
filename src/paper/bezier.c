/* Least-squares fit of a cubic Bezier with fixed ends and end directions: control points p0,
 * p0 + a d0, p3 - b d3, p3; a and b solve a 2 x 2 linear problem. */
#include "paper/bezier.h"

#include <math.h>

#include "base/pair.h"

ZpCubic zp_bezier_cubic(double p0, double p1, double p2, double p3) {
  return (ZpCubic){{p0, 3 * (p1 - p0), 3 * (p0 - 2 * p1 + p2), p3 - p0 + 3 * (p1 - p2)}};
}

void zp_bezier_basis(ZpBezierBasis *basis, size_t count) {
  basis->count = count;
  basis->B11 = basis->B12 = basis->B22 = basis->B10 = basis->B13 = basis->B20 = basis->B23 = 0;
  for (size_t i = 0; i < count; i++) {
    double t = (double)i / (double)(count - 1), u = 1 - t;
    double B0 = u * u * u, B1 = 3 * t * u * u, B2 = 3 * t * t * u, B3 = t * t * t;
    zp_set_pair(basis->B1, i, B1, B1);
    zp_set_pair(basis->B2, i, B2, B2);
    basis->B11 += B1 * B1;
    basis->B12 += B1 * B2;
    basis->B22 += B2 * B2;
    basis->B10 += B1 * (B0 + B1);
    basis->B13 += B1 * (B2 + B3);
    basis->B20 += B2 * (B0 + B1);
    basis->B23 += B2 * (B2 + B3);
  }
}

void zp_bezier_fit(const ZpBezierBasis *basis, const double moment[4], const double first[2], const double last[2],
                   const double d0[2], const double d3[2], ZpCubic *x, ZpCubic *y) {
  double a, b;
  if (basis->count < 4) {
    double dx = last[0] - first[0], dy = last[1] - first[1];
    a = b = sqrt(dx * dx + dy * dy) / 3;
  } else {
    /* residual of point i for handles of length 0: r = p_i - p0 (B0 + B1) - p3 (B2 + B3) */
    double r1 = 0, r2 = 0, cosine = d0[0] * d3[0] + d0[1] * d3[1];
    for (int k = 0; k < 2; k++) {
      r1 += d0[k] * (moment[k] - first[k] * basis->B10 - last[k] * basis->B13);
      r2 -= d3[k] * (moment[2 + k] - first[k] * basis->B20 - last[k] * basis->B23);
    }
    double m12 = -basis->B12 * cosine, inverse = 1 / (basis->B11 * basis->B22 - m12 * m12);
    a = (r1 * basis->B22 - r2 * m12) * inverse;
    b = (r2 * basis->B11 - r1 * m12) * inverse;
  }
  *x = zp_bezier_cubic(first[0], first[0] + a * d0[0], last[0] - b * d3[0], last[0]);
  *y = zp_bezier_cubic(first[1], first[1] + a * d0[1], last[1] - b * d3[1], last[1]);
}
