#include "rest/crossing.h"

#include <math.h>

typedef struct Point {
  double x, y;
} Point;

/* A node of one ribbon, 0 the upper one. */
static Point node(const ZpModel *model, const double *q, size_t ribbon, size_t station) {
  size_t j = model->s * station + ribbon;
  return (Point){q[j], zp_nodes(model, q).y[j]};
}

/* (b - a) x (c - a): positive where c is left of the way from a to b. */
static double side(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Where a corner is nearest, both of its edges have the same bits. */
static double distance_to_edge(Point a, Point b, Point c) {
  double x = b.x - a.x, y = b.y - a.y, along = ((c.x - a.x) * x + (c.y - a.y) * y) / (x * x + y * y);
  Point near = along >= 1 ? b : a;
  double at = along > 0 && along < 1 ? along : 0, dx = c.x - near.x - at * x, dy = c.y - near.y - at * y;
  return sqrt(dx * dx + dy * dy);
}

static double distance_to_line(Point a, Point b, Point c) {
  double x = b.x - a.x, y = b.y - a.y;
  return side(a, b, c) / sqrt(x * x + y * y);
}

/* By how much a node of the lower ribbon lies beyond the upper one, m, at least 0: on the left of its nearest edge.
 * Where that is a corner, the edge counts from whose line the node is farther. */
static double depth_of(const ZpModel *model, const double *q, size_t station) {
  double least = INFINITY, beyond = 0;
  Point at = node(model, q, 1, station);
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    Point a = node(model, q, 0, i), b = node(model, q, 0, i + 1);
    double distance = distance_to_edge(a, b, at), to_line = distance_to_line(a, b, at);
    bool corner = distance == least && fabs(to_line) > fabs(beyond);
    if (distance < least || corner) beyond = to_line;
    least = fmin(least, distance);
  }
  return beyond > 0 ? least : 0;
}

/* The lower ribbon passes above the upper one at its edge `station`, forwards or backwards: how deep it is there. */
static double depth_beyond(const ZpModel *model, const double *q, size_t station, bool forwards) {
  size_t first = forwards ? station + 1 : station;
  size_t next = forwards ? first + 1 : first - 1; /* wraps below 0 */
  double depth = depth_of(model, q, first);
  return next < model->nodes ? fmax(depth, depth_of(model, q, next)) : depth;
}

/* Do both ribbons run to the right everywhere? */
static bool runs_right(const ZpModel *model, const double *q) {
  for (size_t j = 0; j + model->s < model->count; j++)
    if (!(q[j + model->s] >= q[j])) return false;
  return true;
}

/* No node lies deeper in the other ribbon than this, m, if both run to the right: on the way to the node that faces it
 * the other ribbon passes its height. (What lies beside the end of the other ribbon lies in nothing.) */
static double deepest_possible(const ZpModel *model, const double *q) {
  double slid = 0, overlap = 0;
  for (size_t i = 0; i < model->nodes; i++) {
    Point upper = node(model, q, 0, i), lower = node(model, q, 1, i);
    slid = fmax(slid, fabs(upper.x - lower.x));
    overlap = fmax(overlap, lower.y - upper.y);
  }
  return slid + overlap;
}

double zp_crossing_depth(const ZpModel *model, const double *q) {
  double deepest = 0;
  bool sorted = runs_right(model, q);
  size_t from = 0; /* if sorted: edges of the upper ribbon before this one lie left of edge i */
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    Point a = node(model, q, 1, i), b = node(model, q, 1, i + 1);
    double left = fmin(a.x, b.x), right = fmax(a.x, b.x), bottom = fmin(a.y, b.y), top = fmax(a.y, b.y);
    while (sorted && from + 2 < model->nodes && node(model, q, 0, from + 1).x < left)
      from++;
    for (size_t k = from; k + 1 < model->nodes; k++) {
      Point c = node(model, q, 0, k), d = node(model, q, 0, k + 1);
      if (sorted && c.x > right) break;
      if (fmax(c.x, d.x) < left || fmin(c.x, d.x) > right || fmax(c.y, d.y) < bottom || fmin(c.y, d.y) > top) continue;
      double of_b = side(c, d, b);
      if (!(side(c, d, a) * of_b < 0 && side(a, b, c) * side(a, b, d) < 0)) continue;
      deepest = fmax(deepest, depth_beyond(model, q, i, of_b > 0));
    }
  }
  return deepest;
}

bool zp_crosses(const ZpModel *model, const double *q, double deeper) {
  if (!zp_is_pair(&model->topology)) return false;
  bool cannot = deepest_possible(model, q) <= deeper && runs_right(model, q);
  return !cannot && zp_crossing_depth(model, q) > deeper;
}
