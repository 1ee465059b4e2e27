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

/* exp(-x) - 1 by its series, whose terms are below rounding from the 15th on; x at most ln 2. */
static double small_decay(double x) {
  enum { TERMS = 18 };
  double sum = 0;
  for (int k = TERMS; k > 0; k--)
    sum = -x / k * (1 + sum);
  return sum;
}

/* exp(-x) = 2^-n exp(-(x - n ln 2)), ln 2 in two parts, of which the first has zeros for its last digits. */
double zp_decay(double x) {
  static const double ln2 = 0x1.62e42feep-1, rest = 0x1.a39ef35793c76p-33, most = 745;
  if (x > most) return -1;
  int n = (int)(x / ln2);
  double left = x - n * ln2 - n * rest;
  return n == 0 ? small_decay(x) : ldexp(1 + small_decay(left), -n) - 1;
}

/* By its series where the difference would lose digits. */
double zp_decay_weight(double x) {
  double x2 = x * x;
  if (x < 0.5) return 0.5 + x / 12 * (1 - x2 / 60 * (1 - x2 / 42 * (1 - x2 / 40)));
  return -1 / zp_decay(x) - 1 / x;
}

/* By its series: of + and x only. */
double zp_sine_squared(double p) {
  enum { TERMS = 12 }; /* the first left out is below 1e-20 */
  p -= floor(p);
  double x = zp_pi * (p > 0.5 ? 1 - p : p), sum = 1;
  for (int k = TERMS; k > 0; k--)
    sum = 1 - x * x / (2 * k * (2 * k + 1)) * sum;
  return x * sum * (x * sum);
}

double zp_cosine_of(double p) {
  return 1 - 2 * zp_sine_squared(p + 1);
}

double zp_sine_of(double p) {
  return zp_cosine_of(p - 0.25);
}

/* x = 2^n m with m near 1, and ln m = 2 (z + z^3 / 3 + ...), z = (m - 1) / (m + 1), |z| < 0.18. */
double zp_logarithm(double x) {
  enum { TERMS = 12 };
  static const double ln2 = 0x1.62e42feep-1, rest = 0x1.a39ef35793c76p-33, root_of_half = 0.70710678118654752;
  int n;
  double m = frexp(x, &n);
  if (m < root_of_half) m *= 2, n--;
  double z = (m - 1) / (m + 1), sum = 0;
  for (int k = TERMS; k > 0; k--)
    sum = z * z * (1.0 / (2 * k + 1) + sum);
  return n * ln2 + (n * rest + 2 * z * (1 + sum));
}

double zp_power(double x, double p) {
  if (x == 0) return p == 0;
  return 1 + zp_decay(-p * zp_logarithm(x));
}

/* Of a vector within 45 degrees of an axis: a quarter of the angle by its series, its tangent being below 0.2. */
static double small_angle(double t) {
  enum { TERMS = 12 };
  for (int k = 0; k < 2; k++)
    t /= 1 + sqrt(1 + t * t);
  double sum = 0;
  for (int k = TERMS; k > 0; k--)
    sum = -t * t * (1.0 / (2 * k + 1) + sum);
  return 4 * t * (1 + sum);
}

double zp_angle(double y, double x) {
  double up = fabs(y), along = fabs(x);
  if (up == 0 && along == 0) return 0;
  double angle = up <= along ? small_angle(up / along) : 0.5 * zp_pi - small_angle(along / up);
  return copysign(x < 0 ? zp_pi - angle : angle, y);
}
