#include "math/elementary.h"

#include <math.h>

/* Newton's method for a number between 1/2 and 4, of which six iterations leave nothing. */
double zp_cube_root(double x) {
  int exponent;
  if (isinf(x)) return x;
  double mantissa = frexp(x, &exponent), root = 1;
  int third = exponent / 3 - (exponent % 3 < 0);
  mantissa = ldexp(mantissa, exponent - 3 * third);
  for (int k = 0; k < 6; k++)
    root -= (root - mantissa / (root * root)) / 3;
  return ldexp(root, third);
}

/* Lambert's continued fraction for a quarter of the angle, then twice the angle, twice. */
double zp_tangent(double x) {
  double z = 0.25 * x, below = 19;
  for (int odd = 17; odd > 0; odd -= 2)
    below = odd - z * z / below;
  double t = z / below;
  for (int k = 0; k < 2; k++)
    t = 2 * t / (1 - t * t);
  return t;
}
