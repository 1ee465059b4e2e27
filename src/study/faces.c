#include "study/faces.h"

#include <math.h>

#include "base/pair.h"

/* Number of station k over that of the last, where no station is moved. */
static double number(const ZpStations *s, size_t k) {
  double even = (double)k / (double)(s->count - 1), front = (double)s->front / (double)(s->count - 1);
  if (s->front == 0) return even;
  return k <= s->front ? s->moved * (even / front) : 1 - (1 - s->moved) * ((1 - even) / (1 - front));
}

/* Place of station k of an odd number between clip and platform, 0 .. 1. Stations of even k are twice as close at the
 * clip as in the middle, because the force of a wide wedge is there. The others are midway, as Simpson's rule
 * requires. */
static double place(const ZpStations *s, size_t k) {
  if (k % 2) return 0.5 * (place(s, k - 1) + place(s, k + 1));
  double even = number(s, k);
  return 0.5 * even * (1 + even);
}

size_t zp_contact_move_front(ZpStations *s, size_t k, double share) {
  static const double least = 1e-3; /* of the number of all: closer to an end it is there */
  s->front = 0;
  double last = (double)(s->count - 1), at = place(s, k) + share * (place(s, k + 1) - place(s, k));
  s->moved = 0.5 * (sqrt(1 + 8 * at) - 1);
  if (s->moved < least) return 0;
  if (s->moved > 1 - least) return s->count - 1;
  s->front = (size_t)fmin(fmax(2 * round(0.5 * last * s->moved), 2), last - 2);
  return s->front;
}

void zp_contact_cubic(double length, double separation, ZpStations *s) {
  for (size_t k = 0; k < s->count; k++) {
    double xi = place(s, k), half = 0.5 * separation * xi * xi * (3 - 2 * xi);
    zp_set_pair(s->x, k, length * xi, length * xi);
    zp_set_pair(s->y, k, half, -half);
  }
}

/* One coordinate of the nodes of a ribbon. */
typedef struct Line {
  size_t nodes;
  bool rod, flat;   /* flat: level at both ends */
  const double *at; /* [2 nodes] every other one */
} Line;

/* The place of the ribbon at node i. Beside a level end the parabola of eq. (8.10) gives the place that a node would
 * have if it were not held: a fifth of the step to its neighbour further back. */
static double on_ribbon(const Line *line, size_t i) {
  static const double back = 0.2;
  const double *at = line->at + zp_up(i);
  size_t last = line->nodes - 1;
  if (!line->rod || i == 0 || i == last) return at[0];
  double left = at[-2], here = at[0], right = at[2];
  if (line->flat && i == 1) left -= back * (here - left);
  if (line->flat && i + 1 == last) right -= back * (here - right);
  return here + (left - 2 * here + right) / 12;
}

/* Slope by node number at node i; at ends that are not flat, that of the parabola through three nodes. */
static double slope(const Line *line, size_t i) {
  size_t last = line->nodes - 1;
  if (i > 0 && i < last) return 0.5 * (on_ribbon(line, i + 1) - on_ribbon(line, i - 1));
  if (line->flat) return 0;
  if (i == 0) return 0.5 * (-3 * on_ribbon(line, 0) + 4 * on_ribbon(line, 1) - on_ribbon(line, 2));
  return 0.5 * (3 * on_ribbon(line, last) - 4 * on_ribbon(line, last - 1) + on_ribbon(line, last - 2));
}

/* Cubic Hermite between node i and the next at u in [0, 1]. */
static double hermite(const Line *line, size_t i, double u) {
  double v = 1 - u, left = on_ribbon(line, i), right = on_ribbon(line, i + 1);
  return v * v * ((1 + 2 * u) * left + u * slope(line, i)) + u * u * ((3 - 2 * u) * right - v * slope(line, i + 1));
}

void zp_contact_smooth(size_t nodes, bool rods, const double *x, const double *y, ZpStations *s) {
  double clip = x[0];
  for (size_t k = 0; k < s->count; k++) {
    double at = place(s, k) * (double)(nodes - 1);
    size_t i = at < (double)(nodes - 2) ? (size_t)at : nodes - 2;
    double u = at - (double)i;
    for (size_t r = 0; r < 2; r++) {
      Line along = {nodes, rods, false, x + r}, across = {nodes, rods, true, y + r};
      s->x[zp_up(k) + r] = hermite(&along, i, u) - clip;
      s->y[zp_up(k) + r] = hermite(&across, i, u);
    }
  }
}
