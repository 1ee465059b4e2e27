#include "study/faces.h"

#include <stdbool.h>

/* Where station k of an odd number lies between clip and platform, 0 .. 1. Those of even k are twice as close at the
 * clip as in the middle, for there is the force of a wide wedge; the others lie midway, as Simpson's rule wants it. */
static double place(const ZpStations *s, size_t k) {
  if (k % 2) return 0.5 * (place(s, k - 1) + place(s, k + 1));
  double even = (double)k / (double)(s->count - 1);
  return 0.5 * even * (1 + even);
}

void zp_faces_cubic(double length, double separation, ZpStations *s) {
  for (size_t k = 0; k < s->count; k++) {
    double xi = place(s, k), half = 0.5 * separation * xi * xi * (3 - 2 * xi);
    s->x[2 * k] = s->x[2 * k + 1] = length * xi;
    s->y[2 * k] = half;
    s->y[2 * k + 1] = -half;
  }
}

/* Slope by node number at node i of a ribbon's coordinate; at the ends `flat` or of the parabola through three. */
static double slope(size_t nodes, const double *at, size_t i, bool flat) {
  size_t last = nodes - 1;
  if (i > 0 && i < last) return 0.5 * (at[2 * i + 2] - at[2 * i - 2]);
  if (flat) return 0;
  if (i == 0) return 0.5 * (-3 * at[0] + 4 * at[2] - at[4]);
  return 0.5 * (3 * at[2 * last] - 4 * at[2 * last - 2] + at[2 * last - 4]);
}

/* Cubic Hermite between node i and the next at u in [0, 1]. */
static double hermite(size_t nodes, const double *at, size_t i, double u, bool flat) {
  double v = 1 - u, left = slope(nodes, at, i, flat), right = slope(nodes, at, i + 1, flat);
  return v * v * ((1 + 2 * u) * at[2 * i] + u * left) + u * u * ((3 - 2 * u) * at[2 * i + 2] - v * right);
}

void zp_faces_smooth(size_t nodes, const double *x, const double *y, ZpStations *s) {
  double clip = x[0];
  for (size_t k = 0; k < s->count; k++) {
    double at = place(s, k) * (double)(nodes - 1);
    size_t i = at < (double)(nodes - 2) ? (size_t)at : nodes - 2;
    double u = at - (double)i;
    for (size_t r = 0; r < 2; r++) {
      s->x[2 * k + r] = hermite(nodes, x + r, i, u, false) - clip;
      s->y[2 * k + r] = hermite(nodes, y + r, i, u, true);
    }
  }
}
