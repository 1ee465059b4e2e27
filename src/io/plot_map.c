/* map.svg: what a study answers over two list keys, as colours with contours; maps.svg: over three, a map for each
 * value of the third. */
#include <math.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"

/* Values of each key: fewer are better drawn as curves. */
static const size_t fewest = 3;

/* Maps in one picture: of more values of the third key they are chosen evenly. */
enum { PANELS_MOST = 9 };

/* The runs as a grid: x is the key that varies fastest. */
typedef struct Grid {
  int x, y, z; /* keys; z is -1 where there are two */
  size_t columns, rows, panels;
  const char *scalar, *title, *axis, *which, *unit, *count;
} Grid;

static void choose_scalar(const ZpPlot *plot, Grid *grid) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  grid->scalar = a ? a->scalar[0] : "force_N"; /* of the held platform, whose curves are another picture */
  bool fold = plot->def.actuator.kind == ZP_KIND_HINGE;
  grid->title = a ? a->title : fold ? "Force on the held end" : "Force on the held platform";
  grid->axis = a ? a->axis : "force";
  grid->which = a ? a->legend[0] : NULL;
  grid->unit = a ? a->unit : "N";
  grid->count = a ? a->count : "are drawn";
}

static double value_of(const ZpPlot *plot, const Grid *grid, size_t run) {
  return zp_result_get(zp_report_result(plot->report, run), grid->scalar);
}

/* Are the keys numbers that grow or fall along their lists? A surface needs no less. */
static bool is_monotonic(const ZpPlot *plot, int key, size_t count, size_t stride) {
  double first = zp_sweep_value(plot, 0, key), sign = zp_sweep_value(plot, stride, key) - first;
  for (size_t i = 0; i + 1 < count; i++) {
    double step = zp_sweep_value(plot, (i + 1) * stride, key) - zp_sweep_value(plot, i * stride, key);
    if (!(step * sign > 0)) return false;
  }
  return true;
}

/* Runs from the first on in which a key has one value. */
static size_t same_value(const ZpPlot *plot, int key, size_t count) {
  size_t length = 1;
  while (length < count && zp_sweep_value(plot, length, key) == zp_sweep_value(plot, 0, key))
    length++;
  return length;
}

/* False if the runs are no such grid. */
static bool find_grid(const ZpPlot *plot, Grid *grid) {
  size_t count = plot->report->count, found = 0;
  bool drawn = zp_sweep_answer(plot) || plot->shows == ZP_SHOWS_held_branch;
  if (plot->single || zp_scenario_design(plot->report->scenario) || plot->report->optimum || !drawn ||
      zp_sweep_key(plot, 1) < 0 || zp_sweep_key(plot, 3) >= 0)
    return false;
  *grid = (Grid){.x = zp_sweep_key(plot, 0), .y = zp_sweep_key(plot, 1), .z = zp_sweep_key(plot, 2)};
  const size_t panel = grid->z < 0 ? count : same_value(plot, grid->z, count);
  grid->columns = same_value(plot, grid->y, panel);
  grid->rows = panel / grid->columns;
  grid->panels = count / panel;
  if (grid->columns < fewest || grid->rows < fewest || grid->rows * grid->columns * grid->panels != count) return false;
  choose_scalar(plot, grid);
  for (size_t run = 0; run < count; run++)
    if (isfinite(value_of(plot, grid, run))) found++;
  return found >= fewest * fewest && is_monotonic(plot, grid->x, grid->columns, 1) &&
         is_monotonic(plot, grid->y, grid->rows, grid->columns);
}

static bool has_map(const ZpPlot *plot) {
  Grid grid;
  return find_grid(plot, &grid) && grid.z < 0;
}

/* The panel that is drawn as number `k` of all that are. */
static size_t chosen_panel(const Grid *grid, size_t k) {
  return grid->panels <= PANELS_MOST ? k : k * (grid->panels - 1) / (PANELS_MOST - 1);
}

static size_t drawn_panels(const Grid *grid) {
  return grid->panels < PANELS_MOST ? grid->panels : PANELS_MOST;
}

/* An index for each panel, a block in it for each row of the grid. A NaN marks a run without an answer and leaves a
 * hole. */
static void data_map(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  const size_t panel = grid.columns * grid.rows;
  fprintf(file, "# %s %s %s\n", zp_key(grid.x)->name, zp_key(grid.y)->name, grid.scalar);
  for (size_t k = 0; k < drawn_panels(&grid); k++) {
    for (size_t i = 0; i < panel; i++) {
      const size_t run = chosen_panel(&grid, k) * panel + i;
      zp_plot_put(file, zp_sweep_value(plot, run, grid.x), ' ');
      zp_plot_put(file, zp_sweep_value(plot, run, grid.y), ' ');
      zp_plot_put(file, value_of(plot, &grid, run), '\n');
      if ((i + 1) % grid.columns == 0) fputc('\n', file);
    }
    if (grid.z >= 0) fputc('\n', file);
  }
}

/* An axis whose key grows by factors, over more than a decade, is logarithmic, with tics at the values. */
static void put_scale(const ZpPlot *plot, FILE *file, char axis, int key, size_t count, size_t stride) {
  enum { MOST_TICS = 12 };
  double first = zp_sweep_value(plot, 0, key), last = zp_sweep_value(plot, (count - 1) * stride, key);
  double middle = zp_sweep_value(plot, (count - 1) / 2 * stride, key), low = fmin(first, last),
         high = fmax(first, last);
  if (!(low > 0) || high < 10 * low || middle > 0.35 * high) return;
  fprintf(file, "set logscale %c\n", axis);
  for (size_t i = 0; count <= MOST_TICS && i < count; i++)
    fprintf(file, "%s%g%s",
            i             ? ", "
            : axis == 'x' ? "set xtics ("
                          : "set ytics (",
            zp_sweep_value(plot, i * stride, key) * zp_sweep_factor(key), i + 1 < count ? "" : ")\n");
}

static void put_colours(FILE *file) {
  enum { STEPS = 4 };
  fputs("set palette defined (", file);
  for (int i = 0; i <= STEPS; i++)
    fprintf(file, "%s%d '#%06x'", i ? ", " : "", i, zp_plot_shade((double)i / STEPS));
  fputs(")\n", file);
}

static void put_axes(const ZpPlot *plot, FILE *file, const Grid *grid, ZpPlotUnit unit) {
  fputs("set xlabel ", file);
  zp_sweep_label(file, grid->x);
  fputs("\nset ylabel ", file);
  zp_sweep_label(file, grid->y);
  fprintf(file, " offset 0.5\nset autoscale xfix\nset autoscale yfix\nset cblabel '%s%s%s%s%s%s' offset 0.5\n",
          grid->axis, grid->which ? " (" : "", grid->which ? grid->which : "", grid->which ? ")" : "",
          grid->unit ? " / " : "", unit.text);
  put_scale(plot, file, 'x', grid->x, grid->columns, 1);
  put_scale(plot, file, 'y', grid->y, grid->rows, grid->columns);
}

/* Colours in cells so fine that they look smooth, contours and their values on them. */
static void put_surface(FILE *file, const Grid *grid, ZpPlotUnit unit, const char *name, size_t index, int levels) {
  enum { CELLS = 60 };
  static const char *const layers[] = {"with pm3d nocontour", "with lines lw 1.2 lc rgb '#ffffff' nosurface",
                                       "with labels tc rgb '#ffffff' nosurface"};
  fprintf(file,
          "unset grid\nunset key\nset view map\nset pm3d interpolate %zu,%zu\nset contour base\n"
          "set cntrparam levels auto %d\nset cntrlabel onecolor start 2 interval -1 font ',11'\n"
          "%s\n",
          1 + CELLS / grid->rows, 1 + CELLS / grid->columns, levels,
          index == 0 ? "set colorbox user origin 0.85,0.17 size 0.03,0.69" : "unset colorbox");
  for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++)
    fprintf(file, "%s'%s.dat' index %zu using ($1*%g):($2*%g):($3*%g) %s", i ? ", \\\n      " : "splot ", name, index,
            zp_sweep_factor(grid->x), zp_sweep_factor(grid->y), unit.factor, layers[i]);
  fputc('\n', file);
}

/* Title and small print; the range of all values, for the colours. */
static ZpPlotUnit put_head(const ZpPlot *plot, FILE *file, const Grid *grid, const char *name, double *low,
                           double *high) {
  size_t found = 0;
  char more[96];
  *low = *high = NAN;
  for (size_t run = 0; run < plot->report->count; run++) {
    double value = value_of(plot, grid, run);
    found += isfinite(value) != 0;
    *low = fmin(*low, value);
    *high = fmax(*high, value);
  }
  const double largest = fmax(fabs(*low), fabs(*high));
  ZpPlotUnit unit = grid->unit ? zp_plot_unit(largest, grid->unit) : (ZpPlotUnit){.factor = 1};
  snprintf(more, sizeof more, "%zu of %zu runs %s; straight between them", found, plot->report->count, grid->count);
  zp_plot_head(plot, file, name, grid->title, 0.82);
  if (plot->shows == ZP_SHOWS_motion)
    zp_plot_foot(plot, file, more);
  else
    zp_plot_remark(file, more);
  put_axes(plot, file, grid, unit);
  put_colours(file);
  return unit;
}

static void script_map(const ZpPlot *plot, FILE *file) {
  Grid grid;
  double low, high;
  if (!find_grid(plot, &grid)) return;
  const ZpPlotUnit unit = put_head(plot, file, &grid, "map", &low, &high);
  put_surface(file, &grid, unit, "map", 0, 8);
}

/* -- small multiples -------------------------------------------------------------------------------- */

static bool has_maps(const ZpPlot *plot) {
  Grid grid;
  return find_grid(plot, &grid) && grid.z >= 0;
}

/* Where panel `k` is, with axes named at the edges of the picture only; over it the value of the third key. */
static void put_panel(const ZpPlot *plot, FILE *file, const Grid *grid, size_t k) {
  const size_t panels = drawn_panels(grid), across = panels <= 4 ? 2 : 3, down = (panels + across - 1) / across;
  const size_t row = k / across;
  const double width = 0.71 / (double)across, height = 0.70 / (double)down;
  const double left = 0.11 + width * (double)(k % across), top = 0.86 - height * (double)row;
  const double value = zp_sweep_value(plot, chosen_panel(grid, k) * grid->rows * grid->columns, grid->z);
  fprintf(file,
          "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n"
          "set label 5 '%s = %.4g %s' at graph 0.5, graph 1.08 center font ',11' noenhanced\n"
          "set xlabel font ',11' offset 0,0.5\nset ylabel font ',11' offset -0.3\n",
          left, left + width - 0.025, top - 0.035, top - height + 0.03, zp_key(grid->z)->name,
          value * zp_sweep_factor(grid->z), zp_key(grid->z)->shown);
  const bool lowest = k + across >= panels, first = k % across == 0;
  fprintf(file, "set format x '%s'\nset format y '%s'\n", lowest ? "%g" : "", first ? "%g" : "");
  if (!lowest) fputs("unset xlabel\n", file);
  if (!first) fputs("unset ylabel\n", file);
}

static void script_maps(const ZpPlot *plot, FILE *file) {
  Grid grid;
  double low, high;
  if (!find_grid(plot, &grid)) return;
  const ZpPlotUnit unit = put_head(plot, file, &grid, "maps", &low, &high);
  fprintf(file, "set tics font ',11' scale 0.4\nset cbrange [%.17g:%.17g]\nset multiplot\n", low * unit.factor,
          high * unit.factor);
  for (size_t k = 0; k < drawn_panels(&grid); k++) {
    put_axes(plot, file, &grid, unit);
    put_panel(plot, file, &grid, k);
    put_surface(file, &grid, unit, "maps", k, 4);
    fputs("unset label 1\nunset label 2\nunset label 3\nunset label 4\n", file);
  }
  fputs("unset multiplot\n", file);
}

const ZpPicture zp_map_pictures[] = {
    {"map", "svg", has_map, script_map, data_map}, {"maps", "svg", has_maps, script_maps, data_map}, {0}};
