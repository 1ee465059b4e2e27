#include "rest/crossing.h"

#include <math.h>

typedef struct Point {
  double x, y;
} Point;

/* A node of one ribbon, 0 the upper one. */
static Point node(const ZpModel *model, const double *q, size_t ribbon, size_t station) {
  size_t j = model->s * station + ribbon;
  return (Point){q[j], q[model->stride + j]};
}

/* (b - a) x (c - a): positive where c is left of the way from a to b. */
static double side(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static double distance_to_edge(Point a, Point b, Point c) {
  double x = b.x - a.x, y = b.y - a.y, along = ((c.x - a.x) * x + (c.y - a.y) * y) / (x * x + y * y);
  double at = fmin(fmax(along, 0), 1), dx = c.x - a.x - at * x, dy = c.y - a.y - at * y;
  return sqrt(dx * dx + dy * dy);
}

/* From a node of the lower ribbon to the upper one. */
static double distance_to_upper(const ZpModel *model, const double *q, size_t station) {
  double least = INFINITY;
  Point at = node(model, q, 1, station);
  for (size_t i = 0; i + 1 < model->nodes; i++)
    least = fmin(least, distance_to_edge(node(model, q, 0, i), node(model, q, 0, i + 1), at));
  return least;
}

static bool cross(Point a, Point b, Point c, Point d) {
  return side(c, d, a) * side(c, d, b) < 0 && side(a, b, c) * side(a, b, d) < 0;
}

/* Does this edge of the lower ribbon cross the upper one? */
static bool edge_crosses(const ZpModel *model, const double *q, size_t station) {
  Point a = node(model, q, 1, station), b = node(model, q, 1, station + 1);
  for (size_t i = 0; i + 1 < model->nodes; i++)
    if (cross(a, b, node(model, q, 0, i), node(model, q, 0, i + 1))) return true;
  return false;
}

/* The lower ribbon passes above the upper one at its edge `station`, forwards or backwards: how deep it is there, by the
 * next two nodes, or by one if it comes back behind that. */
static double depth_beyond(const ZpModel *model, const double *q, size_t station, bool forwards) {
  size_t first = forwards ? station + 1 : station;
  size_t next = forwards ? first + 1 : first - 1; /* wraps below 0 */
  double depth = distance_to_upper(model, q, first);
  if (next >= model->nodes || edge_crosses(model, q, forwards ? first : next)) return depth;
  return fmax(depth, distance_to_upper(model, q, next));
}

/* Do both ribbons run to the right everywhere? */
static bool runs_right(const ZpModel *model, const double *q) {
  for (size_t j = 0; j + model->s < model->count; j++)
    if (!(q[j + model->s] >= q[j])) return false;
  return true;
}

double zp_crossing_depth(const ZpModel *model, const double *q) {
  double deepest = 0;
  bool sorted = runs_right(model, q);
  size_t from = 0; /* if sorted: edges of the upper ribbon before this one lie left of edge i */
  for (size_t i = 0; zp_is_pair(&model->topology) && i + 1 < model->nodes; i++) {
    Point a = node(model, q, 1, i), b = node(model, q, 1, i + 1);
    double left = fmin(a.x, b.x), right = fmax(a.x, b.x), bottom = fmin(a.y, b.y), top = fmax(a.y, b.y);
    while (sorted && from + 2 < model->nodes && node(model, q, 0, from + 1).x < left)
      from++;
    for (size_t k = from; k + 1 < model->nodes; k++) {
      Point c = node(model, q, 0, k), d = node(model, q, 0, k + 1);
      if (sorted && c.x > right) break;
      if (fmax(c.x, d.x) < left || fmin(c.x, d.x) > right || fmax(c.y, d.y) < bottom || fmin(c.y, d.y) > top) continue;
      if (!cross(a, b, c, d)) continue;
      deepest = fmax(deepest, depth_beyond(model, q, i, side(c, d, b) > 0));
    }
  }
  return deepest;
}
