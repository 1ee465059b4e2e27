/* Pictures of the field: field.svg, and field_tip.svg where the ribbons separate. */
#include <math.h>

#include "io/plot.h"

/* Pixels of the field's colours, and the decades that they span. */
#define WIDE    480
#define HIGH    300
#define DECADES 2.5

static const ZpFieldMap *map_of(const ZpPlot *plot) {
  return plot->single->map;
}

static bool has_field(const ZpPlot *plot) {
  return map_of(plot) && plot->def.drive.voltage > 0;
}

static size_t node(const ZpFieldMap *map, size_t i, size_t j) {
  return i * map->ny + j;
}

static double permittivity(const ZpFieldMap *map, size_t i, size_t j) {
  return map->permittivity[i * (map->ny - 1) + j];
}

static size_t on_surface(const ZpFieldMap *map, size_t i, size_t surface) {
  return node(map, i, map->surface[surface]);
}

/* Columns of nodes at the ends of the ribbons. */
typedef struct Strips {
  size_t left, right;
} Strips;

static bool has_metal(const ZpFieldMap *map, size_t i) {
  return permittivity(map, i, map->surface[0]) == 0;
}

static Strips strips_of(const ZpFieldMap *map) {
  Strips s = {.right = map->nx - 1};
  while (s.left + 1 < s.right && !has_metal(map, s.left))
    s.left++;
  while (s.right > s.left + 1 && !has_metal(map, s.right - 1))
    s.right--;
  return s;
}

/* A part of the map. */
typedef struct View {
  ZpPlotBox box;             /* m */
  double weakest, strongest; /* field whose colours are at the ends of the scale, V/m */
  bool decades;              /* the scale is logarithmic */
} View;

static ZpPlotBox around(const ZpFieldMap *map, const Strips *s, size_t last) {
  ZpPlotBox box = {map->x[on_surface(map, s->left, 0)], map->x[on_surface(map, last, 0)], INFINITY, -INFINITY};
  for (size_t i = s->left; i <= last; i++) {
    box.bottom = fmin(box.bottom, map->y[on_surface(map, i, 0)]);
    box.top = fmax(box.top, map->y[on_surface(map, i, 5) + 1]);
  }
  return box;
}

static ZpPlotBox whole_box(const ZpFieldMap *map) {
  const Strips s = strips_of(map);
  ZpPlotBox box = around(map, &s, s.right);
  double margin = 0.12 * (box.top - box.bottom);
  box.left -= 0.04 * (box.right - box.left);
  box.right = map->x[on_surface(map, map->nx - 1, 0)];
  box.bottom -= margin;
  box.top += margin;
  return box;
}

/* From a little left of the clip's edge (x = 0) to where the gap is as wide as both insulators, but a fifth of the
 * ribbon at least. */
static ZpPlotBox tip_box(const ZpFieldMap *map) {
  const Strips s = strips_of(map);
  size_t last = s.left;
  double right = map->x[on_surface(map, s.right, 0)];
  for (; last < s.right; last++) {
    double low = map->y[on_surface(map, last, 1)], high = map->y[on_surface(map, last, 4) + 1];
    double closed = map->y[on_surface(map, s.left, 4) + 1] - map->y[on_surface(map, s.left, 1)];
    if (high - low > 2 * closed && map->x[on_surface(map, last, 0)] > 0.02 * right) break;
  }
  ZpPlotBox box = around(map, &s, last);
  box.left = fmax(box.left, -0.15 * box.right);
  double margin = 0.04 * (box.top - box.bottom);
  box.bottom -= margin;
  box.top += margin;
  return box;
}

/* Which side of the line from node a to node b a point lies on: positive on the left. */
static double side(const ZpFieldMap *map, size_t a, size_t b, double x, double y) {
  return (map->x[b] - map->x[a]) * (y - map->y[a]) - (map->y[b] - map->y[a]) * (x - map->x[a]);
}

/* Walk from cell (*i, *j) to the one that holds a point. False if that is not in the map. */
static bool walk_to(const ZpFieldMap *map, double x, double y, size_t *i, size_t *j) {
  for (size_t steps = 0; steps < map->nx * map->ny; steps++) {
    size_t a = node(map, *i, *j), b = a + map->ny; /* below left and right; above each the next node */
    if (side(map, a, a + 1, x, y) > 0) {
      if ((*i)-- == 0) break;
    } else if (side(map, b, b + 1, x, y) < 0) {
      if (++*i == map->nx - 1) break;
    } else if (side(map, a, b, x, y) < 0) {
      if ((*j)-- == 0) break;
    } else if (side(map, a + 1, b + 1, x, y) > 0) {
      if (++*j == map->ny - 1) break;
    } else {
      return true;
    }
  }
  *i = *j = 0;
  return false;
}

/* Largest field in a view, V/m. */
static double strongest(const ZpFieldMap *map, const ZpPlotBox *box) {
  double most = 0;
  for (size_t i = 0; i + 1 < map->nx; i++)
    for (size_t j = 0; j + 1 < map->ny; j++) {
      size_t k = node(map, i, j);
      bool inside = map->x[k] > box->left && map->x[k] < box->right && map->y[k] > box->bottom && map->y[k] < box->top;
      if (inside) most = fmax(most, map->strength[i * (map->ny - 1) + j]);
    }
  return most;
}

/* Part of the way from the line a0 a1 to the line b0 b1 on which a point between them lies. */
static double part(const ZpFieldMap *map, size_t a0, size_t a1, size_t b0, size_t b1, double x, double y) {
  double from = fabs(side(map, a0, a1, x, y)) / hypot(map->x[a1] - map->x[a0], map->y[a1] - map->y[a0]);
  double to = fabs(side(map, b0, b1, x, y)) / hypot(map->x[b1] - map->x[b0], map->y[b1] - map->y[b0]);
  return from + to > 0 ? from / (from + to) : 0.5;
}

/* Field in cell (i, j), or in (own_i, own_j) if that cell is of another material or outside. */
static double field_in(const ZpFieldMap *map, long i, long j, size_t own_i, size_t own_j) {
  bool inside = i >= 0 && j >= 0 && i + 1 < (long)map->nx && j + 1 < (long)map->ny;
  if (inside && permittivity(map, (size_t)i, (size_t)j) == permittivity(map, own_i, own_j)) {
    own_i = (size_t)i;
    own_j = (size_t)j;
  }
  return map->strength[own_i * (map->ny - 1) + own_j];
}

/* Field at a point of cell (i, j), between the middles of cells of the same material. */
static double field_at(const ZpFieldMap *map, size_t i, size_t j, double x, double y) {
  size_t a = node(map, i, j), b = a + map->ny;
  double u = part(map, a, a + 1, b, b + 1, x, y) - 0.5, v = part(map, a, b, a + 1, b + 1, x, y) - 0.5;
  long i2 = (long)i + (u < 0 ? -1 : 1), j2 = (long)j + (v < 0 ? -1 : 1);
  u = fabs(u);
  v = fabs(v);
  return (1 - u) * (1 - v) * field_in(map, (long)i, (long)j, i, j) + u * (1 - v) * field_in(map, i2, (long)j, i, j) +
         (1 - u) * v * field_in(map, (long)i, j2, i, j) + u * v * field_in(map, i2, j2, i, j);
}

/* A matrix of field strengths. */
static void put_pixels(FILE *file, const ZpFieldMap *map, const View *view) {
  const ZpPlotBox *box = &view->box;
  size_t i = 0, j = 0;
  for (size_t row = 0; row < HIGH; row++) {
    double y = box->bottom + (box->top - box->bottom) * ((double)row + 0.5) / HIGH;
    for (size_t column = 0; column < WIDE; column++) {
      double x = box->left + (box->right - box->left) * ((double)column + 0.5) / WIDE;
      double field = walk_to(map, x, y, &i, &j) ? field_at(map, i, j, x, y) : 0;
      fprintf(file, "%.3g ", fmax(field, view->weakest));
    }
    fputc('\n', file);
  }
}

static void put_node(FILE *file, const ZpFieldMap *map, size_t k) {
  zp_plot_put(file, map->x[k], ' ');
  zp_plot_put(file, map->y[k], '\n');
}

/* Both metals as closed lines, then both insulator faces. */
static void put_strips(FILE *file, const ZpFieldMap *map) {
  const Strips s = strips_of(map);
  const size_t metal[2][2] = {{map->surface[0], map->surface[1]}, {map->surface[4], map->surface[5]}};
  for (size_t m = 0; m < 2; m++) {
    for (size_t i = s.left; i <= s.right; i++)
      put_node(file, map, node(map, i, metal[m][0]));
    for (size_t i = s.right + 1; i-- > s.left;)
      put_node(file, map, node(map, i, metal[m][1]));
    fputs("\n\n", file);
  }
  for (size_t m = 0; m < 2; m++) {
    for (size_t i = s.left; i <= s.right; i++)
      put_node(file, map, on_surface(map, i, 2 + m));
    fputs("\n\n", file);
  }
}

static void put_potential(FILE *file, const ZpFieldMap *map) {
  for (size_t i = 0; i < map->nx; i++) {
    for (size_t j = 0; j < map->ny; j++) {
      zp_plot_put(file, map->x[node(map, i, j)], ' ');
      zp_plot_put(file, map->y[node(map, i, j)], ' ');
      zp_plot_put(file, map->potential[node(map, i, j)], '\n');
    }
    fputc('\n', file);
  }
  fputs("\n", file);
}

static View whole_view(const ZpPlot *plot) {
  View view = {.box = whole_box(map_of(plot)), .decades = true};
  view.strongest = strongest(map_of(plot), &view.box);
  view.weakest = view.strongest * pow(10, -DECADES);
  return view;
}

static View tip_view(const ZpPlot *plot) {
  View view = {.box = tip_box(map_of(plot))};
  view.strongest = strongest(map_of(plot), &view.box);
  return view;
}

static void put_view(const ZpPlot *plot, FILE *file, const View *view) {
  fputs("# 0: matrix of field strengths, V/m; 1: x_m y_m potential_V on the grid; 2, 3: metals, 4, 5: insulator faces, "
        "x_m y_m\n",
        file);
  put_pixels(file, map_of(plot), view);
  fputs("\n\n", file);
  put_potential(file, map_of(plot));
  put_strips(file, map_of(plot));
}

static void data_field(const ZpPlot *plot, FILE *file) {
  const View view = whole_view(plot);
  put_view(plot, file, &view);
}

static void data_tip(const ZpPlot *plot, FILE *file) {
  const View view = tip_view(plot);
  put_view(plot, file, &view);
}

static void define_view(FILE *file, const View *view) {
  zp_plot_define_box(file, &view->box);
  zp_plot_define(file, "weakest", view->weakest);
  zp_plot_define(file, "strongest", view->strongest);
  zp_plot_define_count(file, "decades", view->decades);
  zp_plot_define_count(file, "pixels_across", WIDE);
  zp_plot_define_count(file, "pixels_up", HIGH);
}

static void define_field(const ZpPlot *plot, FILE *file) {
  const View view = whole_view(plot);
  define_view(file, &view);
}

static void define_tip(const ZpPlot *plot, FILE *file) {
  const View view = tip_view(plot);
  define_view(file, &view);
}

const ZpPicture zp_field_pictures[] = {
    {"field", "svg", "field.gp", ZP_OF(field), .needs = "ratio", .has = has_field, .define = define_field,
     .data = data_field},
    {"field_tip", "svg", "field_tip.gp", ZP_OF(field), .needs = "ratio", .has = has_field, .define = define_tip,
     .data = data_tip},
    {0},
};
