/* Pictures of the electric force along the ribbons and of the field: profile.svg, field.svg, and field_tip.svg where
 * the ribbons part. */
#include <math.h>

#include "io/plot.h"

#define RIGHT 0.76

/* Pixels of the field's colours, and the decades that they span. */
#define WIDE    480
#define HIGH    300
#define DECADES 2.5

/* Lines of potential between the electrodes, which stand this many steps apart. */
#define STEPS 20

static bool has_profile(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_field && plot->single && zp_plot_has(plot->single->series, "ratio") &&
         plot->def.drive.voltage > 0;
}

static void curve(FILE *file, const char *before, ZpPlotUnit x, const char *column, double factor, const char *look,
                  const char *title) {
  fprintf(file, "%s'../table.csv' using (column('x_m')*%g):(column('%s')*%g) with lines %s title \"%s\"", before,
          x.factor, column, factor, look, title);
}

static void script_profile(const ZpPlot *plot, FILE *file) {
  const ZpTable *table = plot->single->series;
  const bool capped = zp_result_get(plot->single, "capped_length_m") > 0;
  ZpPlotUnit x = zp_plot_table_unit(table, (const char *const[]){"x_m", NULL}, "m");
  ZpPlotUnit line = zp_plot_table_unit(table, (const char *const[]){"plates_N_per_m", "field_N_per_m", NULL}, "N/m");
  char label[64];
  zp_plot_head(plot, file, "profile", "Electric force along a ribbon", RIGHT);
  fputs("set datafile separator ','\nset key autotitle columnhead\nset autoscale x noextend\n", file);
  zp_plot_upper_panel(file);
  fprintf(file, "set yrange [0:*]\nset ylabel 'force per length / %s' offset 0.5\n", line.text);
  curve(file, "plot ", x, "field_N_per_m", line.factor, "lw 4 lc rgb '#56b4e9'", "field");
  curve(file, ", \\\n     ", x, "plates_N_per_m", line.factor, "lw 1.5 dt 2 lc rgb '#000000'", "plates law");
  if (capped) curve(file, ", \\\n     ", x, "force_N_per_m", line.factor, "lw 2.5 lc rgb '#d55e00'", "with breakdown");
  snprintf(label, sizeof label, "x from the clip / %s", x.text);
  fputc('\n', file);
  zp_plot_lower_panel(file, RIGHT, label);
  fputs(
      "unset key\nset autoscale y\nset offsets 0, 0, graph 0.08, graph 0.05\nset ylabel 'field / plates' offset 2.2\n",
      file);
  curve(file, "plot ", x, "ratio", 1, "lw 2.5 lc rgb '#0072b2'", "");
  fputs("\nunset multiplot\n", file);
}

/* -- the field ------------------------------------------------------------------------------------- */

static const ZpFieldMap *map_of(const ZpPlot *plot) {
  return plot->single->map;
}

static bool has_field(const ZpPlot *plot) {
  return has_profile(plot) && map_of(plot);
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

/* Field in cell (i, j), or in (own_i, own_j) where that is of another material or outside. */
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

static void view_colours(FILE *file, const View *view, ZpPlotUnit field) {
  fprintf(file,
          "set palette defined (0 '#ffffff', 0.25 '#fee599', 0.5 '#fdb55f', 0.75 '#f2703f', 1 '#c81e3c')\n"
          "%sset cbrange [%.6g:%.6g]\nset cblabel 'field strength / %s' offset 0.5\n"
          "set colorbox user origin screen 0.85, screen 0.19 size screen 0.025, screen 0.67\n",
          view->decades ? "set logscale cb\n" : "", view->weakest * field.factor, view->strongest * field.factor,
          field.text);
}

static void view_axes(FILE *file, const ZpPlotBox *box, ZpPlotUnit mm) {
  fprintf(file,
          "unset grid\nunset key\nset bmargin at screen 0.19\nset lmargin at screen 0.125\nset tics front out\n"
          "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n"
          "set xlabel 'x from the clip / %s'\nset ylabel 'y / %s' offset 0.5\n",
          box->left * mm.factor, box->right * mm.factor, box->bottom * mm.factor, box->top * mm.factor, mm.text,
          mm.text);
}

static void plot_view(FILE *file, const char *name, const ZpPlotBox *box, ZpPlotUnit mm, ZpPlotUnit field) {
  const double dx = (box->right - box->left) / WIDE * mm.factor, dy = (box->top - box->bottom) / HIGH * mm.factor;
  fprintf(file,
          "plot '%s.dat' index 0 matrix using (%.8g+$1*%.8g):(%.8g+$2*%.8g):($3*%g) with image, \\\n"
          "     $lines using 1:2 with lines lw 0.6 lc rgb '#303030', \\\n"
          "     for [k=4:5] '%s.dat' index k using ($1*%g):($2*%g) with lines lw 1.6 lc rgb '#0060c0', \\\n"
          "     for [k=2:3] '%s.dat' index k using ($1*%g):($2*%g) with filledcurves closed fc rgb '#8c8c8c'\n",
          name, box->left * mm.factor + 0.5 * dx, dx, box->bottom * mm.factor + 0.5 * dy, dy, field.factor, name,
          mm.factor, mm.factor, name, mm.factor, mm.factor);
}

static void script_view(const ZpPlot *plot, FILE *file, const char *name, const char *title, const View *view) {
  const double U = plot->def.drive.voltage;
  ZpPlotUnit mm = zp_plot_unit(view->box.right, "m"), field = zp_plot_unit(view->strongest, "V/m");
  ZpPlotUnit step = zp_plot_unit(U / STEPS, "V");
  char remark[256];
  snprintf(
      remark, sizeof remark,
      "grey: metal; blue: the insulators' faces; black: potential, lines %.4g %s apart; x and y have different scales",
      U / STEPS * step.factor, step.text);
  zp_plot_head(plot, file, name, title, 0.83);
  zp_plot_remark(file, remark);
  view_colours(file, view, field);
  /* standalone: the picture is in the file, not beside it; the lines are drawn twice, first into a table */
  fprintf(file,
          "set terminal svg size 800,500 dynamic standalone enhanced font 'Helvetica,14' background '#ffffff'\n"
          "set contour base\nunset surface\nset cntrparam levels incremental %.17g,%.17g,%.17g\n"
          "set table $lines\nsplot '%s.dat' index 1 using ($1*%g):($2*%g):3 with lines nosurface\nunset table\n",
          -U / 2 + U / STEPS, U / STEPS, U / 2 - 0.5 * U / STEPS, name, mm.factor, mm.factor);
  view_axes(file, &view->box, mm);
  plot_view(file, name, &view->box, mm, field);
}

static void script_field(const ZpPlot *plot, FILE *file) {
  const View view = whole_view(plot);
  script_view(plot, file, "field", "Electric field around the ribbons, left half", &view);
}

static void script_tip(const ZpPlot *plot, FILE *file) {
  const View view = tip_view(plot);
  script_view(plot, file, "field_tip", "Electric field where the ribbons part", &view);
}

const ZpPicture zp_field_pictures[] = {
    {"profile", "svg", has_profile, script_profile, NULL},
    {"field", "svg", has_field, script_field, data_field},
    {"field_tip", "svg", has_field, script_tip, data_tip},
    {0},
};
