/* map.svg: the result of a study over two list keys, as colours with contours; maps.svg: over three, a map for each
 * value of the third. */
#include <math.h>
#include <string.h>

#include "io/plot.h"

/* Values of each key: fewer are better drawn as curves. */
static const size_t fewest = 3;

/* Maps in one picture: if the third key has more values, some are chosen evenly. */
enum { PANELS_MOST = 12 };

/* The runs as a grid: x is the key that varies fastest. */
typedef struct Grid {
  int x, y, z; /* keys; z is -1 where there are two */
  size_t columns, rows, panels;
  const char *scalar;
} Grid;

static double value_of(const ZpPlot *plot, const Grid *grid, size_t run) {
  return zp_table_get(plot->table, run, grid->scalar);
}

/* Are the keys numbers that increase or decrease along their lists? A surface needs this. */
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
  const char *scalar = plot->answer ? plot->answer->scalar[0] : "force_N"; /* of the held platform */
  if (!zp_sweep_has_axis(plot) || zp_sweep_key(plot, 1) < 0 || zp_sweep_key(plot, 3) >= 0) return false;
  *grid = (Grid){.x = zp_sweep_key(plot, 0), .y = zp_sweep_key(plot, 1), .z = zp_sweep_key(plot, 2), .scalar = scalar};
  const size_t panel = grid->z < 0 ? count : same_value(plot, grid->z, count);
  grid->columns = same_value(plot, grid->y, panel);
  grid->rows = panel / grid->columns;
  grid->panels = count / panel;
  if (grid->columns < fewest || grid->rows < fewest || grid->rows * grid->columns * grid->panels != count) return false;
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

/* NAME_log says whether the values of an axis grow by factors, over more than a decade; then NAME_tics are the values,
 * of which there are not many. */
static void define_axis(const ZpPlot *plot, FILE *file, const char *name, int key, size_t count, size_t stride) {
  enum { MOST_TICS = 12 };
  double first = zp_sweep_value(plot, 0, key), last = zp_sweep_value(plot, (count - 1) * stride, key);
  double middle = zp_sweep_value(plot, (count - 1) / 2 * stride, key), low = fmin(first, last),
         high = fmax(first, last);
  const bool log = low > 0 && high >= 10 * low && middle <= 0.35 * high;
  fprintf(file, "%s_log = %d\n%s_tics = '", name, log, name);
  for (size_t i = 0; log && count <= MOST_TICS && i < count; i++)
    fprintf(file, "%.8e ", zp_sweep_value(plot, i * stride, key));
  fputs("'\n", file);
}

static void define_map(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  zp_plot_define_word(file, "scalar", grid.scalar);
  zp_plot_define_count(file, "found", zp_plot_count(plot->table, grid.scalar));
  zp_plot_define_count(file, "rows", grid.rows);
  zp_plot_define_count(file, "columns_across", grid.columns);
  define_axis(plot, file, "x", grid.x, grid.columns, 1);
  define_axis(plot, file, "y", grid.y, grid.rows, grid.columns);
}

/* -- small multiples -------------------------------------------------------------------------------- */

static bool has_maps(const ZpPlot *plot) {
  Grid grid;
  return find_grid(plot, &grid) && grid.z >= 0;
}

/* A panel: panel_at[k], the value of the third key. */
static void define_maps(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  define_map(plot, file);
  zp_plot_define_count(file, "panels", grid.panels);
  zp_plot_define_array(file, "panel_at", drawn_panels(&grid));
  for (size_t k = 0; k < drawn_panels(&grid); k++)
    zp_plot_define(file, zp_plot_entry("panel_at", k + 1).text,
                   zp_sweep_value(plot, chosen_panel(&grid, k) * grid.rows * grid.columns, grid.z));
}

const ZpPicture zp_map_pictures[] = {
    {"map", "svg", "map.gp", .many = ZP_OF_ANY, .has = has_map, .define = define_map, .data = data_map},
    {"maps", "svg", "maps.gp", .many = ZP_OF_ANY, .has = has_maps, .define = define_maps, .data = data_map},
    {0},
};
