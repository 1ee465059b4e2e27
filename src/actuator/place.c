#include "actuator/place.h"

void zp_place_straight(const ZpModel *model, double *nodes) {
  const ZpForces to = zp_forces(model, nodes);
  for (size_t j = 0; j < zp_lanes(model); j++) {
    to.x[j] = zp_straight_x(model, j / model->s);
    to.y[j] = 0;
  }
  for (size_t k = 2 * model->stride; k < zp_coordinates(model); k++)
    nodes[k] = 0;
  if (model->pouch.w > 0) zp_place_pouch(model, 0, nodes);
}

void zp_place_pouch(const ZpModel *model, double zipped, double *nodes) {
  const ZpForces to = zp_forces(model, nodes);
  for (size_t j = 0; j < model->count; j++) {
    zp_pouch_place(&model->pouch, zipped, (double)j * model->l, &to.x[j], &to.y[j]);
    to.y[j] = -to.y[j];
  }
}

/* Place the nodes from..to of one ribbon, to the right or to the left, at the ends of edges `d`, which point to the
 * right from their left nodes. */
static void lay(const double *d, size_t s, size_t from, size_t to, double *q) {
  for (size_t j = from; j < to; j += s)
    q[j + s] = q[j] + d[j];
  for (size_t j = from; j > to; j -= s)
    q[j - s] = q[j] - d[j - s];
}

/* A chain of nodes: along one ribbon from `start` to `turn`. If it `returns`, the latter is a clip, and the chain goes
 * on from the clip's lower node back to the one below its start. */
typedef struct Path {
  size_t start, turn;
  bool returns;
} Path;

/* The one that ends at the lower platform of the left or right half, or at the right end of the lower ribbon: from the
 * upper platform, or from a clip that is held or a clamp. */
static Path path_to_platform(const ZpTopology *t, const int *equation, bool right) {
  const size_t lower = t->ribbons - 1;
  size_t clip = right ? t->nodes - t->ribbons : 0, platform = zp_upper(t, right ? t->platform.last : t->platform.first);
  const bool held = !zp_has_platform(t) || equation[zp_x_of(clip)] < 0;
  return held ? (Path){clip + lower, platform + lower, false} : (Path){platform, clip, true};
}

enum { MOST_PATHS = 4 };

/* The paths that place all nodes => how many. */
static size_t paths_of(const ZpTopology *t, const int *equation, Path path[MOST_PATHS]) {
  size_t count = 0, last = t->nodes - t->ribbons;
  if (!zp_has_platform(t)) {
    for (; count < t->ribbons; count++)
      path[count] = (Path){count, last + count, false};
    return count;
  }
  for (size_t h = 0; h < zp_halves(t); h++) {
    Path end = path_to_platform(t, equation, h > 0);
    if (!end.returns) path[count++] = (Path){end.turn - 1, end.start - 1, false};
    path[count++] = end;
  }
  return count;
}

/* Place its nodes at the ends of edges `d`. */
static void walk(const ZpTopology *t, Path path, const double *d, double *q) {
  lay(d, t->ribbons, path.start, path.turn, q);
  if (!path.returns) return;
  q[path.turn + 1] = q[path.turn];
  lay(d, t->ribbons, path.turn + 1, path.start + 1, q);
}

/* Spread a closing error at its end along it. */
static void spread(const ZpTopology *t, Path path, double missed, double *q) {
  bool up = path.turn > path.start;
  size_t edges = (up ? path.turn - path.start : path.start - path.turn) / t->ribbons, all = (1 + path.returns) * edges;
  for (size_t k = 0; k <= edges; k++) {
    size_t j = up ? path.start + t->ribbons * k : path.start - t->ribbons * k;
    q[j] -= missed * ((double)k / (double)all);
    if (path.returns) q[j + 1] -= missed * ((double)(all - k) / (double)all);
  }
}

void zp_place_edges(const ZpModel *model, const ZpAssembly *assembly, const double *edges, double *nodes) {
  const ZpTopology *t = &model->topology;
  const int *equation = assembly->equation;
  size_t left = zp_lower(t, t->platform.first), right = zp_lower(t, t->platform.last);
  Path path[MOST_PATHS];
  size_t paths = paths_of(t, equation, path);
  for (size_t c = 0; c < zp_directions(model); c++) {
    const double *d = zp_read_axis(model, edges, c);
    double *q = zp_axis(model, nodes, c);
    for (size_t k = 0; k < paths; k++) {
      size_t end = path[k].returns ? path[k].start + 1 : path[k].turn;
      double last = q[end];
      walk(t, path[k], d, q);
      if (equation[zp_coordinate_of(model->count, end, c)] < 0) spread(t, path[k], q[end] - last, q);
    }
    if (zp_halves(t) == 1 || equation[zp_coordinate_of(model->count, left, c)] < 0) continue;
    double missed = q[right] - q[left] - d[left];
    spread(t, path_to_platform(t, equation, false), -0.5 * missed, q);
    spread(t, path_to_platform(t, equation, true), 0.5 * missed, q);
  }
}

void zp_place_platform(const ZpModel *model, const ZpAssembly *assembly, double height, double *nodes) {
  const ZpTopology *t = &model->topology;
  double *y = zp_pulled_of(model, nodes), missed = y[zp_load_node(t)] - height;
  for (size_t i = t->platform.first; i <= t->platform.last && zp_half_elements(t) == 0; i++)
    y[zp_lower(t, i)] = height;
  for (size_t h = 0; h < zp_halves(t) && zp_half_elements(t) > 0; h++)
    spread(t, path_to_platform(t, assembly->equation, h > 0), missed, y);
}

void zp_place_top(const ZpModel *model, double height, double *nodes) {
  const ZpTopology *t = &model->topology;
  double *y = zp_pulled_of(model, nodes), rise = height - y[zp_top_node(t)];
  for (size_t j = 0; j < zp_lanes(model); j++)
    y[j] += rise;
}

void zp_place_below(const ZpModel *above, const double *nodes_above, const ZpModel *model, double *nodes) {
  const ZpTopology *t = &above->topology;
  zp_place_top(model, zp_rises(t) * zp_lifted(t, zp_nodes(above, nodes_above), zp_load_node(t)), nodes);
}
